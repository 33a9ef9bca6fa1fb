"""Behaviour: which links leave the surface outward, inward, or both ways.

A link that keeps to the inside of the reference surface is intramobile, to the outside extramobile, one that does
both transmobile; a linkage is what all its moving links are for one sense of its motion. Methods: velocities; the
ICRL, the line through the centre of the circle and the link's instant centre, which parts inward from outward
motion; for four-bars Table 4 of Hyatt et al. 2021, by where their joints P1 to P4 lie round the circle. In case 1
the centre is outside their polygon, P4 P1 the longest chord; in case 2 inside, in the sector of side 23 or 41 cut
by the two diagonals. Crossed 1 has sides 12 and 34, crossed 2 has 23 and 41; column A or B is which pair of
opposite links is ground and coupler (names of which the paper has figures only). Theory: docs/theory/behaviour.md.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import IntEnum

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.linkages.conformed.rates import ConformedChain, FirstOrder, first_order
from synth.linkages.surfaces.circuit import HALF_TURN


class Way(IntEnum):
    """Which way a link moves, for one sense of the linkage's motion.

    Attributes
    ----------
    INWARD, OUTWARD, BOTH
        All of it that moves moves towards the axis, or away from it; or some in, some out (transmobile).
    STILL, UNKNOWN
        Immobile to first order (the ground link, or one that turns about the axis); not one freedom in all.

    Examples
    --------
    >>> Way(-Way.OUTWARD).name
    'INWARD'
    """

    INWARD = -1
    STILL = 0
    OUTWARD = 1
    BOTH = 2
    UNKNOWN = 3


@dataclass(frozen=True, slots=True)
class Behaviour:
    """First-order behaviour of many linkages of one chain.

    Attributes
    ----------
    ways : int8[..., N]
        `Way` of each link of the chain, in the sense in which the first link that moves one way moves outward. The
        other sense has INWARD and OUTWARD exchanged.
    one_way : bool[...]
        Whether all moving links move the same way: intramobile or extramobile, by the sense; else transmobile.
    tangent : bool[..., J]
        Joints that move along the surface to first order. A joint half a turn away from a fixed joint of its link
        goes outward to second order, in both senses.
    ranges : float[..., N, 2]
        Least and greatest outward rate over each link, per unit distance from the apex or axis.
    motion : FirstOrder
        In the same sense.
    """

    ways: npt.NDArray[np.int8]
    one_way: npt.NDArray[np.bool_]
    tangent: npt.NDArray[np.bool_]
    ranges: Floats
    motion: FirstOrder


def behaviour(chain: ConformedChain, places: npt.ArrayLike, arcs: npt.ArrayLike | None = None) -> Behaviour:
    """Return the first-order behaviour of every link of linkages at their conformed position, by velocities.

    The cone angle does not matter, and a cylinder behaves alike (`synth.linkages.conformed.rates`).

    Parameters
    ----------
    chain : ConformedChain
    places : float[..., J]
        Azimuths of the joints, radians.
    arcs : float[..., N, 2], optional
        Start and length of each link's arc, radians. By default the shortest arc over its joints.

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> chain = SCGraph(4, {"O": (0, 1), "A": (1, 2), "B": (2, 3), "C": (3, 0)})
    >>> moving = behaviour(ConformedChain.of(chain), np.radians([40, 90, 140, 0]))  # Table 4, case 1
    >>> [Way(way).name for way in moving.ways], bool(moving.one_way)
    (['STILL', 'OUTWARD', 'OUTWARD', 'OUTWARD'], True)
    """
    motion = first_order(chain, places)
    spans = link_arcs(chain, places) if arcs is None else np.asarray(arcs, dtype=float)
    return behaviour_of_motion(chain, places, motion, spans)


def behaviour_of_motion(
    chain: ConformedChain, places: npt.ArrayLike, motion: FirstOrder, arcs: npt.ArrayLike
) -> Behaviour:
    """Return the behaviour that a motion at places float[..., J] gives to links on arcs, float[..., N, 2]."""
    t = np.asarray(places, dtype=float)
    ways, ranges, small = _ways_and_ranges(motion.motions, np.asarray(arcs, dtype=float))
    one_sided = np.abs(ways) == 1
    first = np.take_along_axis(ways, one_sided.argmax(axis=-1)[..., np.newaxis], -1)
    turn = np.where(one_sided.any(axis=-1, keepdims=True) & (first == -1), -1, 1)
    ways = np.where(one_sided, ways * turn, ways).astype(np.int8)
    known = (motion.freedoms == 1) & (motion.undecided == 0)
    ways = np.where(known[..., np.newaxis], ways, np.int8(Way.UNKNOWN))
    one_way = known & one_sided.any(axis=-1) & np.isin(ways, (Way.STILL, Way.OUTWARD)).all(axis=-1)
    ranges = np.where((turn == -1)[..., np.newaxis], -ranges[..., ::-1], ranges)
    turned = replace(motion, rates=motion.rates * turn, motions=motion.motions * turn[..., np.newaxis])
    return Behaviour(ways, one_way, _tangent(chain, t, motion, small), ranges, turned)


def ways_over(motions: Floats, arcs: npt.ArrayLike) -> npt.NDArray[np.int8]:
    """Return the `Way` of links over arcs, float[..., N, 2], in the sense of motions, float[..., N, 3]."""
    return _ways_and_ranges(motions, np.asarray(arcs, dtype=float))[0]


def _ways_and_ranges(motions: Floats, arcs: Floats) -> tuple[npt.NDArray[np.int8], Floats, Floats]:
    """Return ways, least and greatest outward rates, and the rate below which a link is still."""
    ranges = _outward_ranges(motions, arcs)
    scale = np.abs(motions[..., ::2]).max(axis=(-2, -1))
    small = (DOUBLE.zero_rate * np.where(np.isfinite(scale), scale, 0.0))[..., np.newaxis]
    out, into = ranges[..., 1] > small, ranges[..., 0] < -small
    ways = np.where(out & into, Way.BOTH, out.astype(int) - into.astype(int)).astype(np.int8)
    return ways, ranges, small


def _outward_ranges(motions: Floats, arcs: Floats) -> Floats:
    """Return least and greatest outward rate over arcs: it is A sin(t - t_I), with t_I the azimuth of the ICRL."""
    size = np.hypot(motions[..., 0], motions[..., 2])
    node = np.arctan2(motions[..., 0], motions[..., 2])
    begin, length = arcs[..., 0] - node, arcs[..., 1]
    ends = np.sin(begin), np.sin(begin + length)
    top = np.remainder(np.pi / 2 - begin, 2 * np.pi) < length
    bottom = np.remainder(-np.pi / 2 - begin, 2 * np.pi) < length
    high = np.where(top, 1.0, np.maximum(*ends))
    low = np.where(bottom, -1.0, np.minimum(*ends))
    return np.stack([size * low, size * high], axis=-1)


def _tangent(chain: ConformedChain, t: Floats, motion: FirstOrder, small: Floats) -> npt.NDArray[np.bool_]:
    """Find the joints that move along the surface."""
    tangent = np.zeros(t.shape, dtype=bool)
    for joint in range(len(chain.joints)):
        link = next(n for n, joints in enumerate(chain.joints_of) if joint in joints)
        w = motion.motions[..., link, :]
        s, c = np.sin(t[..., joint]), np.cos(t[..., joint])
        outward = w[..., 2] * s - w[..., 0] * c
        along = np.maximum(np.abs(w[..., 0] - w[..., 1] * s), np.abs(w[..., 2] - w[..., 1] * c))
        tangent[..., joint] = (np.abs(outward) <= small[..., 0]) & (along > 10 * small[..., 0])
    return tangent


def link_arcs(chain: ConformedChain, places: npt.ArrayLike, begins: Mapping[int, int] | None = None) -> Floats:
    """Return the shortest arc over the joints of each link: all the circle but the largest gap between them.

    Start and length in radians, float[..., N, 2], at places float[..., J]. A binary link has its minor arc; of two
    halves, either (`half_turn_arcs`), or the one that ``begins`` names: number of the link to that of the joint at
    which its arc begins.
    """
    t = np.asarray(places, dtype=float)
    arcs = []
    for number, joints in enumerate(chain.joints_of):
        mine = np.sort(np.remainder(t[..., list(joints)], 2 * np.pi), axis=-1)
        gaps = np.roll(mine, -1, axis=-1) - mine
        gaps[..., -1] += 2 * np.pi
        widest = gaps.argmax(axis=-1)[..., np.newaxis]
        start = np.take_along_axis(np.roll(mine, -1, axis=-1), widest, -1)[..., 0]
        length = 2 * np.pi - np.take_along_axis(gaps, widest, -1)[..., 0]
        if begins is not None and number in begins:
            start = np.remainder(t[..., begins[number]], 2 * np.pi)
        arcs.append(np.stack([start, length], axis=-1))
    return np.stack(arcs, axis=-2)


def half_turn_arcs(chain: ConformedChain, places: npt.ArrayLike) -> dict[int, tuple[tuple[int, int], tuple[int, int]]]:
    """Return the links that span half a turn and may curve either way, at places float[J]: each with its two arcs.

    An arc is the numbers of the joints at which it begins and ends, azimuths growing.
    """
    t = np.remainder(np.asarray(places, dtype=float), 2 * np.pi)
    halves = {}
    for number, joints in enumerate(chain.joints_of):
        mine = sorted(joints, key=lambda joint: float(t[joint]))
        gaps = np.diff(t[mine], append=t[mine[0]] + 2 * np.pi) if mine else np.zeros(0)
        wide = np.flatnonzero(gaps >= HALF_TURN).tolist()
        if len(wide) == 2:
            # an arc that leaves out a gap begins where the gap ends
            ends = [(mine[(gap + 1) % len(mine)], mine[gap]) for gap in wide]
            halves[number] = (ends[1], ends[0])
    return halves


def icrl(motions: npt.ArrayLike) -> Floats:
    """Return the azimuth of the ICRL of links, the line through circle centre and instant centre: float[..., N].

    In (-pi, pi]. Right of it (azimuths up to half a turn larger) the link moves outward. On a cone the line is the
    projection of the pole axis. nan where the link does not move, or turns about the centre.

    Parameters
    ----------
    motions : float[..., N, 3]
        w of each link.

    Examples
    --------
    >>> float(icrl([[1.0, 0.5, 0.0]])[0].round(6))
    1.570796
    """
    w = np.asarray(motions, dtype=float)
    size = np.hypot(w[..., 0], w[..., 2])
    scale = np.abs(w).max(axis=(-2, -1), initial=0.0)[..., np.newaxis]
    return np.where(size > DOUBLE.zero_rate * scale, np.arctan2(w[..., 0], w[..., 2]), np.nan)


def instant_centres(motions: npt.ArrayLike) -> Floats:
    """Return the instant centres of links with respect to the ground, in radii: float[..., N, 2].

    Pole axes meet the circle's plane there; the point at azimuth t is (sin t, cos t). Infinite without rotation.

    Parameters
    ----------
    motions : float[..., N, 3]
        w; differences of two give relative centres.

    Examples
    --------
    >>> instant_centres([[1.0, 0.5, 0.0]]).tolist()
    [[2.0, 0.0]]
    """
    w = np.asarray(motions, dtype=float)
    turning = np.where(np.abs(w[..., 1:2]) > DOUBLE.zero_rate * np.abs(w).max(axis=-1, keepdims=True), w[..., 1:2], 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(w[..., ::2] / turning)


ROWS: dict[tuple[int, str, str], tuple[str, str]] = {
    (1, "open", "A"): ("Y*", "Y"),
    (1, "open", "B"): ("N", "N"),
    (1, "crossed 1", "A"): ("Y", "Y"),
    (1, "crossed 1", "B"): ("N", "N"),
    (1, "crossed 2", "A"): ("N", "N"),
    (1, "crossed 2", "B"): ("Y*", "Y"),
    (2, "open", "A"): ("N", "N"),
    (2, "open", "B"): ("N", "N"),
    (2, "crossed 1", "A"): ("Y*", "Y"),
    (2, "crossed 1", "B"): ("N", "N"),
    (2, "crossed 2", "A"): ("N", "N*"),
    (2, "crossed 2", "B"): ("N", "N"),
}
"""(case, configuration, column) to intra- and extramobility; *: the other way where a chord is a diameter."""

COLUMNS: dict[tuple[str, str], frozenset[frozenset[int]]] = {
    key: frozenset(map(frozenset, pair))
    for key, pair in {
        ("open", "A"): ((1, 2), (3, 4)),
        ("open", "B"): ((2, 3), (4, 1)),
        ("crossed 1", "A"): ((1, 2), (3, 4)),
        ("crossed 1", "B"): ((1, 3), (2, 4)),
        ("crossed 2", "A"): ((2, 3), (4, 1)),
        ("crossed 2", "B"): ((1, 3), (2, 4)),
    }.items()
}
"""(configuration, column) to ground and coupler, each as the labels of its two joints."""

_SIDES = {
    "open": ((1, 2), (2, 3), (3, 4), (4, 1)),
    "crossed 1": ((1, 2), (2, 4), (4, 3), (3, 1)),
    "crossed 2": ((1, 3), (3, 2), (2, 4), (4, 1)),
}


@dataclass(frozen=True, slots=True)
class TableRow:
    """A four-bar's row of Table 4.

    Attributes
    ----------
    case : {1, 2}
    configuration : {"open", "crossed 1", "crossed 2"}
    column : {"A", "B"}
    labels : tuple of int
        Label (1 to 4) of each joint O, A, B, C.
    intramobile, extramobile : bool
        Whether the linkage can move so that all its links stay inside, or outside.
    special : bool
        Whether a chord is a diameter and the starred entries hold the other way.
    """

    case: int
    configuration: str
    column: str
    labels: tuple[int, ...]
    intramobile: bool
    extramobile: bool
    special: bool


def table4(case: int, configuration: str, column: str, *, diameter: bool = False) -> tuple[bool, bool]:
    """Return an entry of Table 4: intramobility and extramobility; `InvariantError` if there is no such entry.

    Parameters
    ----------
    case : {1, 2}
    configuration : {"open", "crossed 1", "crossed 2"}
    column : {"A", "B"}
    diameter : bool, optional
        Whether P4 P1 (case 1) or a diagonal (case 2) is a diameter. A joint half a turn from the fixed joint of
        its link then moves outward to second order: intramobility is lost, or extramobility gained.

    Examples
    --------
    >>> table4(1, "open", "A"), table4(1, "open", "A", diameter=True)
    ((True, True), (False, True))
    """
    if (case, configuration, column) not in ROWS:
        raise InvariantError("Table 4", f"no entry {case}, {configuration!r}, {column!r}", "one of the twelve")
    intra, extra = (
        entry.startswith("Y") != (diameter and entry.endswith("*")) for entry in ROWS[case, configuration, column]
    )
    return intra, extra


def table_row(places: npt.ArrayLike) -> TableRow:
    """Return a four-bar's row of Table 4.

    Parameters
    ----------
    places : float[4]
        Azimuths of O, A, B, C, radians, all different, else `InvariantError`; the ground link is C O, the coupler
        A B.

    Examples
    --------
    >>> row = table_row(np.radians([40, 90, 140, 0]))
    >>> row.case, row.configuration, row.column, row.intramobile
    (1, 'open', 'A', True)
    """
    t = np.asarray(places, dtype=float)
    if t.shape != (4,):
        raise InvariantError("azimuths", f"{t.size} azimuths", "four, of O, A, B, C")
    round_ = np.remainder(t, 2 * np.pi)
    order = np.argsort(round_)
    sorted_places = round_[order]
    gaps = np.remainder(np.roll(sorted_places, -1) - sorted_places, 2 * np.pi)
    if gaps.min() <= DOUBLE.parallel:
        raise InvariantError("azimuths", "two joints lie on one ruling line", "four different azimuths")
    widest = int(gaps.argmax())
    case = 1 if gaps[widest] >= np.pi - DOUBLE.parallel else 2
    first = (widest + 1) % 4 if case == 1 else _first_of_case_2(sorted_places)
    rank = np.empty(4, dtype=int)
    rank[order] = (np.arange(4) - first) % 4 + 1
    labels = tuple(rank.tolist())
    o, a, b, c = labels
    sides = frozenset(map(frozenset, ((o, a), (a, b), (b, c), (c, o))))
    configuration = next(name for name, links in _SIDES.items() if frozenset(map(frozenset, links)) == sides)
    pair = frozenset((frozenset((c, o)), frozenset((a, b))))
    column = "A" if COLUMNS[configuration, "A"] == pair else "B"
    if case == 1:
        special = bool(abs(gaps[widest] - np.pi) <= DOUBLE.parallel)
    else:
        across = sorted_places[2:] - sorted_places[:2]
        special = bool((np.abs(across - np.pi) <= DOUBLE.parallel).any())
    intra, extra = table4(case, configuration, column, diameter=special)
    return TableRow(case, configuration, column, labels, intra, extra, special)


def _first_of_case_2(places: Floats) -> int:
    """Return which joint is P1 where the centre is inside: it is in the sector of side 23 or 41 of the diagonals.

    The centre is on the left of the diagonal from i to i + 2 if that one spans less than half a turn. With P1
    first, it is in the sector of 41 or 23 if it is right of one of 13 and 24 and left of the other.
    """
    left_13 = places[2] - places[0] < np.pi
    left_24 = places[3] - places[1] < np.pi
    return 0 if left_13 == left_24 else 1
