"""Which axes of a figure form which loop: namings of the joints of a chain that fit a printed run of steps.

Theory: docs/theory/multiloop.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import networkx as nx

from graphs.errors import InvariantError
from graphs.mechanism.sc import SCGraph
from graphs.types import JointId

__all__ = ["memberships"]


def memberships(chain: SCGraph, names: Sequence[JointId]) -> tuple[SCGraph, ...]:
    """Return all ways to name the joints of a chain such that joints named one after the other share a link.

    Hyatt et al. 2020, Fig. 11 prints the steps along such a run through all seven axes, and not which axes form
    the loops.

    Parameters
    ----------
    chain : SCGraph
        Without parallel joints.
    names : sequence of joint ids
        As many as the chain has joints.

    Returns
    -------
    tuple of SCGraph
        The chain with its joints named, one for each class under its symmetries.

    Raises
    ------
    InvariantError
        If there are more or fewer names than joints.

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> len(memberships(four_bar, "OABC"))
    1
    """
    joints = list(chain.joints)
    if len(names) != len(joints):
        raise InvariantError("names", f"{len(names)} names for {len(joints)} joints", "one for each")
    ends = [frozenset(chain.joints[joint]) for joint in joints]
    near = [[j for j, other in enumerate(ends) if j != i and one & other] for i, one in enumerate(ends)]
    plain = nx.Graph(chain)
    symmetries = [
        tuple(ends.index(frozenset(turned[link] for link in one)) for one in ends)
        for turned in nx.isomorphism.GraphMatcher(plain, plain).isomorphisms_iter()
    ]
    found: dict[tuple[int, ...], None] = {}
    for run in _runs(near):
        found.setdefault(min(tuple(symmetry[i] for i in run) for symmetry in symmetries))
    return tuple(_renamed(chain, {joints[i]: name for i, name in zip(run, names, strict=True)}) for run in found)


def _runs(near: Sequence[Sequence[int]]) -> Iterator[tuple[int, ...]]:
    """Yield all paths through all nodes of a graph."""

    def longer(path: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
        if len(path) == len(near):
            yield path
            return
        for node in near[path[-1]]:
            if node not in path:
                yield from longer((*path, node))

    for start in range(len(near)):
        yield from longer((start,))


def _renamed(chain: SCGraph, name: Mapping[JointId, JointId]) -> SCGraph:
    joints = {name[joint]: ends for joint, ends in chain.joints.items()}
    loops = [replace(loop, joints=tuple(name[joint] for joint in loop.joints)) for loop in chain.loops]
    order = sorted(joints, key=lambda joint: list(name.values()).index(joint))
    return SCGraph(list(chain), {joint: joints[joint] for joint in order}, loops, ground=chain.ground)
