"""Conical candidates: every way the joint axes of a chain can lie round one cone, up to what changes nothing.

Projected angles always fit, so a chain lies on a cone with its joints in any cyclic order; what is the same up to
a turn, a mirror image or a symmetry of the chain (one that keeps the ground link, if there is one) counts once.
What the candidates do is worked out in `synth.synthesis.candidates.job`. Source: Hyatt et al. 2020, section 7. Theory:
docs/theory/conical-candidates.md.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, Literal

import numpy as np

from enumerate.conical.rounds import Rounds, count_rounds_by_burnside, count_rounds_by_orbits, placements, prefixes
from enumerate.contracted.binary_links import orbits_of
from enumerate.machine_code.weights import ROUND
from enumerate.runner._run import total_of, tuples_of
from enumerate.runner.job import Column, Query, QueryCount, QueryJob, Row, Unit
from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.identity.chains import subdivided
from graphs.identity.numbering import symmetries_of
from graphs.types import Ints, JointId, LinkId

_PLACEMENTS = 2_000_000
"""Placements of a unit that counts, at most; symmetric ones apart. A unit is what a stopped run does again."""

_LISTED = 10**11
"""Placements that are listed at most: interpreted, at 10 000 a second, they take four months."""
_PORTIONS = 200_000
"""Portions into which placements are cut, about: each is known beforehand, so there must not be millions in memory."""

Chain = tuple[tuple[JointId, tuple[LinkId, LinkId]], ...]


@dataclass(frozen=True, slots=True)
class Portion:
    """The candidates of one ground link whose first joints lie on the slots of a prefix.

    Attributes
    ----------
    ground : link id or None
    prefix : tuple of int
    """

    ground: LinkId | None
    prefix: tuple[int, ...]


@dataclass(frozen=True)
class ConicalQuery(Query):
    """Which candidates are to be enumerated.

    Attributes
    ----------
    chain : tuple of (joint id, (link, link))
    grounds : tuple of (link id or None)
        The fixed links, each with candidates of its own; None: no link is fixed.
    slots : int, optional
        Joints on so many equal slots of the circle; without it, cyclic orders.
    opposites : bool
        Cyclic orders of the joints and of the points opposite to them.

    Raises
    ------
    InvariantError
        If there are fewer slots than joints, or fewer than three joints, or both slots and opposites.

    Examples
    --------
    >>> four_bar = tuple(zip("OABC", [(0, 1), (1, 2), (2, 3), (3, 0)]))
    >>> ConicalQuery(four_bar, slots=12).rounds
    Rounds(joints=4, slots=12, classes=12)
    """

    chain: Chain
    grounds: tuple[LinkId | None, ...] = (None,)
    slots: int | None = None
    opposites: bool = False

    def __post_init__(self) -> None:
        if self.slots is not None and self.opposites:
            raise InvariantError("slots", "slots and opposites", "one of them: slots say where the opposites are")
        _ = self.rounds

    @property
    def rounds(self) -> Rounds:
        """What the enumeration runs over."""
        joints = len(self.chain)
        if self.slots is not None:
            return Rounds(joints, self.slots, self.slots)
        return Rounds(joints, 2 * joints if self.opposites else joints, joints)

    @property
    def key(self) -> dict[str, Any]:
        """The query in JSON values."""
        return super().key | {"chain": [[joint, *ends] for joint, ends in self.chain]}

    def symmetries(self, ground: LinkId | None) -> Ints:
        """Return the symmetries of the chain that leave the ground where it is: int64[g, J]."""
        return _symmetries(self.chain, ground)

    def portions(self, most: int) -> Iterator[tuple[Portion, int]]:
        """Yield portions of at most so many placements, symmetric ones apart, if possible; and the numbers.

        Raises `UnsolvableError` if there are too many to list.
        """
        rounds = self.rounds
        if rounds.completions(1) > _LISTED:
            raise UnsolvableError(
                f"{rounds.joints} joints have {rounds.completions(1):.2g} placements, symmetric ones apart; "
                f"more than {_LISTED:.0g} can only be counted; try --count"
            )
        most = max(most, rounds.completions(1) // _PORTIONS)
        for ground in self.grounds:
            for prefix in prefixes(rounds, most):
                yield Portion(ground, prefix), rounds.completions(len(prefix))

    def placements(self, portion: Portion) -> tuple[Ints, Ints]:
        """Return the candidates of a portion and their symmetries (`enumerate.conical.rounds.placements`)."""
        return placements(self.rounds, self.symmetries(portion.ground), portion.prefix)


@cache
def _symmetries(chain: Chain, ground: LinkId | None) -> Ints:
    return joint_symmetries(dict(chain), ground)


def conical_orders(query: ConicalQuery, *, workers: int = 1) -> Iterator[tuple[LinkId | None, tuple[int, ...]]]:
    """Yield ground link and slot of each joint of every candidate, in a fixed order.

    Parameters
    ----------
    query : ConicalQuery
    workers : int
        Processes.

    Examples
    --------
    >>> four_bar = tuple(zip("OABC", [(0, 1), (1, 2), (2, 3), (3, 0)]))
    >>> [row for _, row in conical_orders(ConicalQuery(four_bar))]
    [(0, 1, 2, 3), (0, 1, 3, 2)]
    """
    yield from tuples_of(_OrderJob(query), workers=workers)


def count_conical_orders(
    query: ConicalQuery, method: Literal["burnside", "orbits"] = "burnside", *, workers: int = 1
) -> int:
    """Return the number of candidates.

    Parameters
    ----------
    query : ConicalQuery
    method : {"burnside", "orbits"}
        ``orbits`` compares each placement with its images, ``burnside`` makes none.
    workers : int
        Processes.

    Examples
    --------
    >>> four_bar = tuple(zip("OABC", [(0, 1), (1, 2), (2, 3), (3, 0)]))
    >>> [count_conical_orders(ConicalQuery(four_bar, (0,)), method) for method in ("orbits", "burnside")]
    [3, 3]
    """
    return total_of(ConicalCountJob(query, method), workers=workers)


_ORDER_COLUMNS: dict[str, Column] = {"ground": object, "slots": tuple}


@dataclass(frozen=True)
class _OrderJob(QueryJob[ConicalQuery]):
    """The candidates as rows for this process: a ground link may be of any kind, so no file takes them."""

    columns = _ORDER_COLUMNS
    listed = "conical orders"

    def units(self) -> Sequence[Unit]:
        """A unit for each portion."""
        return [Unit(portion, weight) for portion, weight in self.query.portions(_PLACEMENTS)]

    def interpreted(self, weight: int) -> float:
        """Return about how many seconds the job takes with kernels interpreted, for so many placements."""
        return ROUND * weight

    def work(self, payload: Portion) -> list[Row]:
        """Return the rows of a unit."""
        return [(payload.ground, tuple(row)) for row in self.query.placements(payload)[0].tolist()]


@dataclass(frozen=True)
class ConicalCountJob(QueryCount[ConicalQuery]):
    """The number of candidates; rows are numbers to be added.

    Attributes
    ----------
    query : ConicalQuery
    method : {"burnside", "orbits"}
    """

    counted = "conical"

    def units(self) -> Sequence[Unit]:
        """A unit for each ground link, or for each portion."""
        if self.method == "burnside":
            return [Unit(Portion(ground, (0,))) for ground in self.query.grounds]
        return [Unit(portion, weight) for portion, weight in self.query.portions(_PLACEMENTS)]

    def interpreted(self, weight: int) -> float:
        """Return about how many seconds the job takes with kernels interpreted, for so many placements."""
        return ROUND * weight

    def work(self, payload: Portion) -> list[Row]:
        """Return the number of candidates of a unit."""
        rounds, symmetries = self.query.rounds, self.query.symmetries(payload.ground)
        if self.method == "burnside":
            return [(count_rounds_by_burnside(rounds, symmetries),)]
        return [(count_rounds_by_orbits(rounds, symmetries, payload.prefix),)]


_MOST = 100_000
"""Symmetries beyond this number are not listed: each is held as a permutation of joints and tried on each placement."""


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
        raise UnsolvableError(f"the chain has {size:.3g} symmetries; expected at most {_MOST}")
    count = len(joints)
    moves = {tuple(move[len(links) + i] - len(links) for i in range(count)) for move in generators}
    group = {tuple(range(count))}
    new = group
    while new:  # products of the generators, longer by one each time, until there are no others
        new = {tuple(move[i] for i in symmetry) for symmetry in new for move in moves} - group
        group = group | new
    return np.array(sorted(group), np.int64).reshape(-1, count)


def links_apart(joints: Mapping[JointId, tuple[LinkId, LinkId]]) -> list[LinkId]:
    """Return one link of each set of links that symmetries exchange: the different ground links of a chain."""
    generators, links, _ = _generators(joints, None)
    moves = np.array([range(len(links) + len(joints)), *generators], np.int64)
    return [link for i, (link, least) in enumerate(zip(links, orbits_of(moves), strict=False)) if least == i]


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
