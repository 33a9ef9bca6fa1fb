"""Symmetries of chains as permutations of their joints.

Theory: docs/theory/conical-candidates.md.
"""

from __future__ import annotations

from collections.abc import Mapping

import networkx as nx
import numpy as np

from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.identity.chains import subdivided, symmetries_of
from graphs.types import Ints, JointId, LinkId

__all__ = ["joint_symmetries", "links_apart"]

_MOST = 100_000
"""Symmetries beyond this number are not listed."""


def joint_symmetries(joints: Mapping[JointId, tuple[LinkId, LinkId]], ground: LinkId | None = None) -> Ints:
    """Return all symmetries of a chain, as permutations of its joints.

    Parameters
    ----------
    joints : mapping of joint id to (link, link)
        Parallel joints may change places.
    ground : link id, optional
        A link that stays where it is.

    Returns
    -------
    int64[g, J]
        Row s takes joint i to joint ``s[i]``; the identity first, then in lexicographic order.

    Raises
    ------
    InvariantError
        If the ground carries no joint.
    UnsolvableError
        If there are more than 100 000.

    Examples
    --------
    >>> four_bar = dict(enumerate([(0, 1), (1, 2), (2, 3), (3, 0)]))
    >>> len(joint_symmetries(four_bar)), joint_symmetries(four_bar, ground=0).tolist()
    (8, [[0, 1, 2, 3], [3, 2, 1, 0]])
    """
    generators, links, size = _generators(joints, ground)
    if ground is not None and ground not in links:
        raise InvariantError("ground", f"the ground link {shown(ground)}", "a link with a joint")
    if size > _MOST:
        raise UnsolvableError(f"the chain has {size:.3g} symmetries; expected {_MOST} at most")
    count = len(joints)
    moves = {tuple(one[len(links) + i] - len(links) for i in range(count)) for one in generators}
    found = {tuple(range(count))}
    new = found
    while new:
        new = {tuple(move[i] for i in one) for one in new for move in moves} - found
        found = found | new
    return np.array(sorted(found), np.int64).reshape(-1, count)


def links_apart(joints: Mapping[JointId, tuple[LinkId, LinkId]]) -> list[LinkId]:
    """Return one link of each set of links that symmetries exchange: the different ground links of a chain."""
    generators, links, _ = _generators(joints, None)
    orbits = nx.utils.UnionFind(range(len(links)))
    for one in generators:
        for i in range(len(links)):
            orbits.union(i, one[i])
    first: dict[int, LinkId] = {}
    for i, link in enumerate(links):
        first.setdefault(orbits[i], link)
    return list(first.values())


def _generators(
    joints: Mapping[JointId, tuple[LinkId, LinkId]], ground: LinkId | None
) -> tuple[list[list[int]], list[LinkId], float]:
    """Return generators on links, then joints; the links in their order; how many symmetries there are.

    Joints are nodes of their own: so symmetries that exchange parallel joints are found too.
    """
    links = list(dict.fromkeys(link for ends in joints.values() for link in ends))
    number = dict(zip(links, range(len(links)), strict=True))
    pairs = [(number[a], number[b]) for a, b in joints.values()]
    marked = None if ground is None else number.get(ground)
    symmetries = symmetries_of(subdivided(len(links), pairs, marked))
    return symmetries.generators, links, symmetries.size
