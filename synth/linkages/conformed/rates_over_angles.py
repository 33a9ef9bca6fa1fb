"""What an order of the joints alone decides, and what is left to the angles.

An order *with opposites* says how the joints and the points opposite to them follow each other round the circle; a
cyclic order of J joints is that of 2^(J-1) of them. It fixes the sign of every step, how often loops wind, and how
many layers of links there are. Ways of links follow from the signs of outward rates
(`synth.linkages.conformed.outward_rate`): certain where a formula decides, or other signs refute the opposite; else
samples are tried. Theory: docs/theory/conical-candidates.md.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from enum import IntEnum
from functools import cache
from itertools import combinations
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from enumerate.conical.rounds import fewest_layers, layers_of_links
from enumerate.machine_code.weights import SIGNS, expect
from graphs.errors import NumericalError, UnsolvableError
from graphs.tolerances import DOUBLE
from graphs.types import Flags, Floats, Ints, Signs
from synth.linkages.conformed.outward_rate import OutwardRate, SignRelations, joint_rates, outward_rates
from synth.linkages.conformed.rates import ConformedChain
from synth.linkages.surfaces.circuit import HALF_TURN

_SAMPLES = 64
_ROWS = 500
"""Orders for which angles are sampled together."""
_BY_CHORDS = 16
"""Formulas whose terms are compared with each other."""


class Allowed(IntEnum):
    """What an order allows a link, or the whole linkage.

    Attributes
    ----------
    BOTH, ONE
        Both ways, whatever the angles (transmobile); or one way (intra- or extramobile, by the sense of the
        motion).
    ANGLES, UNKNOWN
        Either, by the angles, with examples of both; or one of these that samples did not contradict, not proved.
    """

    BOTH = 0
    ONE = 1
    ANGLES = 2
    UNKNOWN = 3


class RateFormulas:
    """A chain of one freedom with all that does not depend on the order of its joints.

    `formulas` are those of the outward rate of each joint, `rates` those of its rate; `moving` holds the joints of
    each link that are not the ground's. Raise `UnsolvableError` if it has not one freedom by its count.
    """

    def __init__(self, chain: ConformedChain) -> None:
        self.chain = chain
        self.formulas, self.rates = outward_rates(chain), joint_rates(chain)
        self.relations = SignRelations(chain)
        self.moving = tuple(tuple(joint for joint in each if self.formulas[joint]) for each in chain.joints_of)


@dataclass(frozen=True, slots=True)
class OverAngles:
    """What orders with opposites allow.

    Attributes
    ----------
    links, linkage : int8[..., N], int8[...]
        `Allowed` for each link of the chain (the ground link is ONE), and for the whole: whether all moving links
        can go the same way.
    signs : int8[..., J]
        Certain signs of the outward rates of joints, for one sense of the motion; 0 if not certain, or of the
        ground.
    """

    links: npt.NDArray[np.int8]
    linkage: npt.NDArray[np.int8]
    signs: npt.NDArray[np.int8]


def orders_with_opposites(order: npt.ArrayLike) -> Ints:
    """Return all orders with opposites of cyclic orders, as places on 2 J slots: int64[..., 2^(J - 1), J].

    An order is the place of each joint in the cycle, 0 to J - 1; the joint at place 0 stays there.
    """
    places = np.asarray(order, dtype=np.int64)
    return np.moveaxis(np.take(_sorted_places(places.shape[-1]), places, axis=1), 0, -2)


@cache
def _sorted_places(joints: int) -> Ints:
    """Return all choices of one of each two opposite slots of 2 J, in rising order: int64[2^(J - 1), J]."""
    sides = (np.arange(2 ** (joints - 1))[:, np.newaxis] >> np.arange(joints - 2, -1, -1)) & 1
    far = np.arange(1, joints) + joints * sides
    return np.array(sorted([0, *sorted(row)] for row in far.tolist()), np.int64)


def sampled(places: npt.ArrayLike, samples: int = _SAMPLES, seed: int = 0) -> Floats:
    """Return random azimuths in orders with opposites, on 2 J slots: radians in [0, 2 pi), float[..., samples, J].

    The random gaps are the same for all orders, some even, some very uneven.
    """
    slots = np.asarray(places, dtype=np.int64)
    joints = slots.shape[-1]
    rng = np.random.default_rng(seed)
    shape = np.geomspace(0.15, 6.0, samples)[:, np.newaxis]
    gaps = rng.gamma(shape, size=(samples, joints)) + 1e-4
    half = np.cumsum(gaps, axis=1) - gaps[:, :1]
    half = np.pi * (half + gaps[:, :1]) / gaps.sum(axis=1, keepdims=True)
    half = np.concatenate([np.zeros((samples, 1)), half[:, :-1]], axis=1)
    azimuths = half[:, slots % joints] + np.pi * (slots >= joints)
    return np.moveaxis(azimuths, 0, -2)


def over_angles(chain: ConformedChain | RateFormulas, places: npt.ArrayLike, samples: int = _SAMPLES) -> OverAngles:
    """Return what orders with opposites allow the links of a chain of one freedom.

    Parameters
    ----------
    chain : ConformedChain or RateFormulas
        `UnsolvableError` if it has not one freedom by its count.
    places : int64[..., J]
        Orders with opposites: places on 2 J slots.
    samples : int, optional
        Sets of angles for signs that are not certain; sixteen times as many where these are alike.

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> chain = ConformedChain.of(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)]))
    >>> [Allowed(allowed).name for allowed in over_angles(chain, [[1, 2, 3, 0], [0, 1, 2, 3]]).linkage]
    ['ONE', 'BOTH']
    """
    slots = np.asarray(places, dtype=np.int64)
    shape = slots.shape[:-1]
    formulas = chain if isinstance(chain, RateFormulas) else RateFormulas(chain)
    answer = _over_angles(formulas, slots.reshape(-1, slots.shape[-1]), samples)
    return OverAngles(
        answer.links.reshape(*shape, -1), answer.linkage.reshape(shape), answer.signs.reshape(*shape, slots.shape[-1])
    )


def _over_angles(formulas: RateFormulas, slots: Ints, samples: int) -> OverAngles:
    """Return what orders with opposites int64[r, J] allow: by signs that are certain, by refuting, by samples."""
    expect(len(slots) * SIGNS)
    relations, moving = formulas.relations, formulas.moving
    middle = slots * (np.pi / slots.shape[-1])
    sines = np.sign(np.sin(middle[:, :, np.newaxis] - middle[:, np.newaxis, :]).round(9)).astype(np.int8)
    known = relations.start(len(slots))
    for joint in range(slots.shape[-1]):
        known[:, relations.rate(joint)] = _certain(formulas.rates[joint], slots)
        if formulas.formulas[joint]:
            sign = _certain(formulas.formulas[joint], slots)
            for number in range(1, len(moving)):
                if joint in moving[number]:
                    known[:, relations.rho(number, joint)] = sign
    if relations.follow(known, sines).any():
        raise NumericalError("signs of outward rates contradict each other")
    round_ = _goes_round(formulas.chain, slots)
    links = np.full((len(slots), len(moving)), Allowed.ONE, np.int8)
    for number in range(1, len(moving)):
        parts = [relations.rho(number, joint) for joint in moving[number]]
        links[:, number] = _by_reason(relations, known, sines, parts, round_[:, number])
    owner = {joint: number for number in range(1, len(moving)) for joint in moving[number]}
    parts = [relations.rho(number, joint) for joint, number in owner.items()]
    linkage = _by_reason(relations, known, sines, parts, (links[:, 1:] == Allowed.BOTH).any(axis=1))
    for number in (samples, 16 * samples):  # many sets of angles only for what a few do not settle
        open_ = np.flatnonzero((links == Allowed.UNKNOWN).any(axis=1) | (linkage == Allowed.UNKNOWN))
        for begin in range(0, len(open_), _ROWS):
            mine = open_[begin : begin + _ROWS]
            links[mine], linkage[mine] = _looked_for(formulas, slots[mine], links[mine], linkage[mine], number)
    signs = np.zeros(slots.shape, np.int8)
    for joint, number in owner.items():
        signs[:, joint] = known[:, relations.rho(number, joint)]
    return OverAngles(links, linkage, signs)


def _by_reason(
    relations: SignRelations, known: Signs, sines: Signs, parts: list[int], both: Flags
) -> npt.NDArray[np.int8]:
    """Return what certain outward rates allow, else UNKNOWN; sets of signs that are refuted do not count."""
    allowed = _from_signs(known[:, parts], both)
    left = np.flatnonzero(allowed == Allowed.UNKNOWN)
    if not len(left):
        return allowed
    one_sign, two_signs = _possible(relations, known[left], sines[left], parts)
    allowed[left] = np.where(one_sign & two_signs, Allowed.UNKNOWN, np.where(one_sign, Allowed.ONE, Allowed.BOTH))
    return allowed


def _possible(relations: SignRelations, known: Signs, sines: Signs, parts: list[int]) -> tuple[Flags, Flags]:
    """Check whether all of some rates can have one sign, and whether two of them can have different ones."""

    def refuted(assumed: dict[int, int]) -> Flags:
        trial = known.copy()
        wrong = np.zeros(len(known), bool)
        for part, sign in assumed.items():
            wrong |= (trial[:, part] != 0) & (trial[:, part] != sign)
            trial[:, part] = sign
        return wrong | relations.follow(trial, sines)

    one_sign = ~refuted(dict.fromkeys(parts, 1)) | ~refuted(dict.fromkeys(parts, -1))
    two_signs = np.zeros(len(known), bool)
    for a, b in combinations(parts, 2):
        two_signs |= ~refuted({a: 1, b: -1}) | ~refuted({a: -1, b: 1})
    return one_sign, two_signs


def never_singular(chain: ConformedChain | RateFormulas, places: npt.ArrayLike) -> npt.NDArray[np.bool_]:
    """Check which cyclic orders certainly have full rank at the conformed position for all angles: bool[...].

    Some minor of the closure equations has terms of one sign only there. False: not certain.

    Parameters
    ----------
    chain : ConformedChain or RateFormulas
        Of one freedom.
    places : float[..., J]
        Azimuths between 0 and 2 pi in these orders.

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> four_bar = ConformedChain.of(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)]))
    >>> never_singular(four_bar, [[0.0, 1, 2, 3], [0, 2, 1, 3]]).tolist()
    [True, True]
    """
    t = np.asarray(places, dtype=float)
    sure = np.zeros(t.shape[:-1], bool)
    given = chain if isinstance(chain, RateFormulas) else RateFormulas(chain)
    for formulas in given.rates:
        for formula in formulas:
            sure |= formula.signs(t) != 0
    return sure


def _certain(formulas: tuple[OutwardRate, ...], slots: Ints) -> npt.NDArray[np.int8]:
    """Return the sign of a joint's outward rate where one of its formulas decides, else 0."""
    middle = slots * (np.pi / slots.shape[-1])
    signs = np.zeros(len(slots), np.int8)
    tests: list[tuple[Callable[..., npt.NDArray[np.int8]], Floats | Ints]] = [(one.signs, middle) for one in formulas]
    for signs_of, places in [*tests, *((one.signs_by_chords, slots) for one in formulas[:_BY_CHORDS])]:
        left = signs == 0
        if not left.any():
            break
        signs[left] = signs_of(places[left])
    return signs


def _goes_round(chain: ConformedChain, slots: Ints) -> Flags:
    """Check which links have joints on no half of the circle: bool[..., N]."""
    half = slots.shape[-1]
    goes_round = []
    for joints in chain.joints_of:
        mine = np.sort(slots[..., list(joints)], axis=-1)
        gaps = np.roll(mine, -1, axis=-1) - mine
        gaps[..., -1] += 2 * half
        goes_round.append(gaps.max(axis=-1) < half)
    return np.stack(goes_round, axis=-1)


def _from_signs(signs: npt.NDArray[np.int8], goes_round: Flags) -> npt.NDArray[np.int8]:
    """Return what certain signs of the moving joints of a link allow it."""
    plus, minus = (signs > 0).any(axis=-1), (signs < 0).any(axis=-1)
    one_sign = (signs > 0).all(axis=-1) | (signs < 0).all(axis=-1) | (signs.shape[-1] == 1)
    allowed = np.where(one_sign, Allowed.ONE, Allowed.UNKNOWN)
    return np.where(goes_round | (plus & minus), Allowed.BOTH, allowed).astype(np.int8)


def _looked_for(
    formulas: RateFormulas, slots: Ints, links: npt.NDArray[np.int8], linkage: npt.NDArray[np.int8], samples: int
) -> tuple[npt.NDArray[np.int8], npt.NDArray[np.int8]]:
    """Look for angles with which links of unknown ways go one way, and others with which they go both."""
    t = sampled(slots, samples)
    rates = np.zeros(t.shape)
    every = sorted({joint for joints in formulas.moving for joint in joints})
    for joint in every:
        rates[..., joint] = formulas.formulas[joint][0].values(t)

    def seen(joints: Sequence[int], before: npt.NDArray[np.int8]) -> npt.NDArray[np.int8]:
        mine = rates[..., list(joints)]
        clear = np.abs(mine).min(axis=-1) > DOUBLE.zero_rate * np.abs(rates).max(axis=-1)
        one_sign = (mine > 0).all(axis=-1) | (mine < 0).all(axis=-1)
        either = (one_sign & clear).any(axis=-1) & (~one_sign & clear).any(axis=-1)
        return np.where((before == Allowed.UNKNOWN) & either, Allowed.ANGLES, before).astype(np.int8)

    links_seen = links.copy()
    for number in range(1, links.shape[1]):
        links_seen[:, number] = seen(formulas.moving[number], links[:, number])
    return links_seen, seen(every, linkage)


_MOST_JOINTS = 62
"""Gaps that the bits of a mask have room for."""


class LinksInLayers(NamedTuple):
    """Links of one linkage as arcs in layers.

    Attributes
    ----------
    arcs : float[N, 2]
        Start and length of the arc of each link, radians.
    layers : int64[N]
        The layer of each link, from 0 on.
    """

    arcs: Floats
    layers: Ints


def arc_choices(chain: ConformedChain, places: npt.ArrayLike) -> Ints:
    """Return the arcs that links can take, as masks of the gaps between neighbouring joints: int64[r, N, o].

    A link takes all the circle but one gap between its joints: the one that is half the circle or wider, either of
    two halves, or, where none is so wide, any. Azimuths, float[r, J], are between 0 and 2 pi, all different. Bit i
    is the gap after the joint that comes i-th from azimuth 0 on; a mask is 0 where a link has fewer choices.
    """
    t = np.asarray(places, dtype=float)
    joints = t.shape[-1]
    rank = t.argsort(axis=-1).argsort(axis=-1)
    every = (1 << joints) - 1
    most = max(map(len, chain.joints_of))
    masks = np.zeros((len(t), len(chain.joints_of), most), np.int64)
    for number, mine in enumerate(chain.joints_of):
        ranks = np.sort(rank[:, list(mine)], axis=-1)
        ends = np.sort(t[:, list(mine)], axis=-1)
        widths = np.roll(ends, -1, axis=-1) - ends
        widths[:, -1] += 2 * np.pi
        after = np.roll(ranks, -1, axis=-1)
        gaps = (1 << after) - (1 << ranks)  # bits from one rank to below the next
        gaps[:, -1] += every  # the last goes past azimuth 0
        wide = widths >= HALF_TURN
        allowed = wide | ~wide.any(axis=-1, keepdims=True)
        masks[:, number, : len(mine)] = np.where(allowed, every ^ gaps, 0)
    return masks


def layers(chain: ConformedChain, places: npt.ArrayLike) -> Ints:
    """Return the fewest layers in which no two links overlap, at azimuths float[r, J]: int64[r]."""
    t = np.remainder(np.asarray(places, dtype=float), 2 * np.pi)
    return fewest_layers(arc_choices(chain, t))


def links_in_layers(
    chain: ConformedChain, places: npt.ArrayLike, begins: Mapping[int, int] | None = None
) -> LinksInLayers:
    """Put the links of a linkage into the fewest layers in which none overlaps another.

    Parameters
    ----------
    chain : ConformedChain
    places : float[J]
        Azimuths, radians; `UnsolvableError` if there are more than 62 joints.
    begins : mapping of int to int, optional
        Number of a link that spans half a turn to the number of the joint at which its arc begins.

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> chain = ConformedChain.of(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)]))
    >>> links_in_layers(chain, np.radians([0, 40, 90, 140])).layers.tolist()
    [0, 1, 1, 1]
    """
    t = np.remainder(np.asarray(places, dtype=float), 2 * np.pi)
    if len(t) > _MOST_JOINTS:
        raise UnsolvableError(f"{len(t)} joints; expected {_MOST_JOINTS} at most to put links in layers")
    choices = arc_choices(chain, t[np.newaxis])[0]
    for number, joint in (begins or {}).items():
        mine = sorted(chain.joints_of[number], key=lambda one: float(t[one]))
        left_out = (mine.index(joint) - 1) % len(mine)
        choices[number, [gap for gap in range(choices.shape[1]) if gap != left_out]] = 0
    chosen, layer_of = layers_of_links(choices)
    arcs = np.empty((len(chain.joints_of), 2))
    for number, (joints, left_out) in enumerate(zip(chain.joints_of, chosen.tolist(), strict=True)):
        ends = np.sort(t[list(joints)])
        start = ends[(left_out + 1) % len(ends)]
        arcs[number] = start, np.remainder(ends[left_out] - start, 2 * np.pi)
    return LinksInLayers(arcs, layer_of)
