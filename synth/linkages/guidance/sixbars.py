"""Watt's six-bars that guide a body through five orientations, by one driven joint that turns one way.

A chain of three joints leads from the ground by links 1 and 2 to the body; its arcs and the two axes at its ends
decide the angles at which it takes five orientations. Two bars leave it one freedom: bar 4 from the ground to link 2,
a dyad of the five orientations of link 2, and bar 5 from link 1 or bar 4 to the body, a dyad of the five orientations
of the body relative to that (Soh and McCarthy 2008, six-bars as constrained 3R chains). Of the six solutions of
either one is a link of the linkage already, so that another is real.

The linkage is two four-bars in a row, the first driven at the ground. It takes the orientations on one circuit and
one branch if neither bar gets in line with the link that it steers, from orientation 1 to 5. Chains have six
parameters; populations of them are changed at random as long as they get nearer to that. Exchanging ground and body
gives linkages that are driven at the body. Theory: docs/theory/guidance.md.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from math import degrees
from typing import Any, Literal, NamedTuple, TypeAlias, TypeVar

import numpy as np
from scipy.spatial.transform import Rotation

from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.geometry import across, angles_between, crossing, rotated, rotations, unit
from graphs.joints.linkage import plain_vector
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from graphs.printing import Block, Printed, TableBlock
from graphs.tolerances import DOUBLE
from graphs.types import Flags, Floats
from synth.linkages.guidance.dyad_tables import dyads_of_sets
from synth.linkages.guidance.dyads import facing_on
from synth.linkages.guidance.fourbars import BodyMotion, turned
from synth.linkages.guidance.orientations import Orientations

Carrier: TypeAlias = Literal["ground", "body"]

_TURN = 2.0 * np.pi
_CARRIERS: tuple[Carrier, Carrier] = ("ground", "body")
_ANCHORS = (1, 4)
_FOUR_BARS = {1: ((0, 1, 4, 3), (1, 2, 6, 5)), 4: ((0, 1, 4, 3), (4, 2, 6, 5))}
"""The links that may carry bar 5, and the joints of both four-bars by that link."""
_JOINTS = {"ground": "0, on the ground", "body": "0, on the body"}

_DRAWS, _DRAWN, _STARTS = 4, 100_000, 1500
"""How many times so many chains are drawn for a population, and how many that take the orientations in order start
it."""
_KEPT, _STEPS, _LONGER = (60, 40, 26, 17, 12), 30, 60
"""Chains that are kept for each round of steps, and steps by which what was found is improved."""
_BETWEEN, _CLOSER, _FINE = 6, 24, 60
"""Points between two orientations in the search, in the improvement, and where a motion is traced."""
_SHORTEST, _REACH, _LEAST_TURN = 0.15, 0.003, 0.03
"""What chains and bars keep: sines of their arcs, how far links 1 and 2 are from stretched, and the angle by which
the driven joint turns between orientations, in radians."""
_SAFE, _ENOUGH = 0.03, 0.1
"""Sine of the angle between a bar and its link at the orientations before the motion between them is looked at, and
that beyond which more does not count."""
_OPEN, _ROOMY = 5e-4, 0.01
"""Room of a four-bar that closes, 1 - |cos| of that angle, and that beyond which more does not count."""
_FIRST, _LARGEST, _SMALLEST, _GROWS, _SHRINKS = 0.1, 0.4, 1e-3, 1.5, 0.87
"""Size of a change of each parameter, in radians, and how it follows success and failure."""
_UNUSABLE = -1.0
"""Sine of a bar that is none, or too short."""
_SOLVED = 3.0
"""Score of a chain whose linkage takes the orientations without a defect."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class GuidedSixBar:
    """A spherical six-bar of Watt that guides a body through five orientations without a defect.

    Attributes
    ----------
    orientations : Orientations
    driven : "ground" or "body"
        The link that carries the driven joint, joint 0.
    anchor : 1 or 4
        The link that carries bar 5: the driven one, or bar 4.
    axes : float[7, 3]
        Directions of the joints of `linkage`, at orientation 1.
    inputs : float[5]
        Angles of the driven joint from orientation 1, radians, growing or falling.
    transmission : float
        Least angle, radians, between a bar and the link that it steers, or its supplement, from orientation 1 to 5:
        zero is a dead point.
    residual : float
        Largest miss of an orientation by the traced linkage, radians.
    motion : BodyMotion
        From orientation 1 to 5, by angles of the driven joint.

    Examples
    --------
    >>> from synth.linkages.guidance import read_orientations, six_bars
    >>> five = read_orientations("data/orientations/crank-rocker.json")
    >>> [found] = six_bars(five, driven="ground").six_bars
    >>> found.linkage, found.driven, found.residual < 1e-10
    (<HingedSolids: 6 links, 7 joints>, 'ground', True)
    """

    orientations: Orientations
    driven: Carrier
    anchor: int
    axes: Floats
    inputs: Floats
    transmission: float
    residual: float
    motion: BodyMotion

    @property
    def links(self) -> tuple[tuple[int, int], ...]:
        """The links of each joint: 0 the ground, 3 the body, 4 and 5 bars."""
        return links_of(self.driven, self.anchor)

    @property
    def linkage(self) -> HingedSolids:
        """The linkage at orientation 1: link 0 is the ground, link 3 the body."""
        loops = [Loop(joints, Centre.FINITE) for joints in _FOUR_BARS[self.anchor]]
        chain = SCGraph(6, list(self.links), loops)
        return HingedSolids(chain, {joint: ((0.0, 0.0, 0.0), plain_vector(self.axes[joint])) for joint in range(7)})

    def __repr__(self) -> str:
        return f"<GuidedSixBar: driven on the {self.driven}, transmission {degrees(self.transmission):.1f} degrees>"

    def to_json(self) -> dict[str, Any]:
        """Return the six-bar as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return {
            "driven": self.driven,
            "joints": [list(pair) for pair in self.links],
            "axes": self.axes.tolist(),
            "inputs_deg": np.degrees(self.inputs).tolist(),
            "transmission_deg": degrees(self.transmission),
            "residual": self.residual,
        }


@dataclass(frozen=True, slots=True, eq=False)
class GuidedSixBars(Printed):
    """Six-bars that guide a body through five orientations, the largest transmission angle first.

    Attributes
    ----------
    orientations : Orientations
    six_bars : tuple of GuidedSixBar
    tried : int
        How many populations were searched.

    Examples
    --------
    >>> GuidedSixBars(Orientations.from_axis_angles(np.eye(3), [0.0, 0.5, 0.7]), (), 0)
    <GuidedSixBars: 0 six-bars without defects>
    """

    orientations: Orientations
    six_bars: tuple[GuidedSixBar, ...]
    tried: int

    def __repr__(self) -> str:
        return f"<GuidedSixBars: {numbered(len(self.six_bars), 'six-bar')} without defects>"

    def to_json(self) -> dict[str, Any]:
        """Return the six-bars as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return {
            "orientations": len(self.orientations),
            "sixbars": [six_bar.to_json() for six_bar in self.six_bars],
            "tried": self.tried,
        }

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        heads = ("six-bar", "driven joint", "turns by", "its axis", "bar on the same link", "transmission", "residual")
        rows = [
            (
                str(number),
                _JOINTS[each.driven],
                f"{degrees(each.inputs[-1]):.1f}",
                *(" ".join(f"{x:7.4f}" for x in each.axes[joint]) for joint in (0, 3)),
                f"{degrees(each.transmission):.2f}",
                f"{each.residual:.0e}",
            )
            for number, each in enumerate(self.six_bars, start=1)
        ]
        found = f"{len(self.orientations)} orientations: {numbered(len(self.six_bars), 'six-bar')} without defects"
        tried = f"{numbered(self.tried, 'population')} of chains searched"
        return [f"{found}; {tried}", *([TableBlock(heads, rows, ["turns by", "transmission"])] if rows else [])]


def links_of(driven: Carrier, anchor: int) -> tuple[tuple[int, int], ...]:
    """Return the links of each joint: 0 the ground, 3 the body, 4 and 5 bars.

    Parameters
    ----------
    driven : "ground" or "body"
        The link that carries the driven joint, joint 0.
    anchor : 1 or 4
        The link that carries bar 5.

    Examples
    --------
    >>> links_of("ground", 1)
    ((0, 1), (1, 2), (2, 3), (0, 4), (4, 2), (1, 5), (5, 3))
    """
    near, far = (0, 3) if driven == "ground" else (3, 0)
    return ((near, 1), (1, 2), (2, far), (near, 4), (4, 2), (anchor, 5), (5, far))


def six_bars(
    orientations: Orientations, *, most: int = 1, tries: int = 60, driven: Carrier | None = None, first: int = 0
) -> GuidedSixBars:
    """Find Watt's six-bars that guide a body through five orientations in order, on one circuit and one branch.

    Parameters
    ----------
    orientations : Orientations
        Five of them.
    most : int, optional
        Number of six-bars after which the search ends.
    tries : int, optional
        Largest number of populations of chains that are searched; each takes some seconds.
    driven : "ground" or "body", optional
        The link that carries the driven joint; by default populations take turns, the ground first.
    first : int, optional
        Number of the first population: a search goes on from where another one ended.

    Returns
    -------
    GuidedSixBars
        Each was traced from the first orientation to the last. None means that none was found, not that there is
        none.

    Raises
    ------
    UnsolvableError
        If there are not five orientations.
    InvariantError
        If `driven` is neither link, `most` or `tries` are not positive, or `first` is negative.

    Examples
    --------
    >>> from synth.linkages.guidance import read_orientations
    >>> found = six_bars(read_orientations("data/orientations/crank-rocker.json"))
    >>> found.six_bars[0].driven, found.tried
    ('ground', 1)
    """
    if driven is not None and driven not in _CARRIERS:
        raise InvariantError("driven", shown(driven), "'ground' or 'body'")
    for name, number, least in (("most", most, 1), ("tries", tries, 1), ("first", first, 0)):
        if number < least:
            raise InvariantError(name, shown(number), f"{least} or more")
    if len(orientations) != 5:
        raise UnsolvableError(f"{len(orientations)} orientations; six-bars are found for 5")
    kinds = list(product(_ANCHORS, _CARRIERS if driven is None else (driven,)))
    found: list[GuidedSixBar] = []
    tried = 0
    while tried < tries and len(found) < most:
        number, place = divmod(first + tried, len(kinds))
        anchor, carrier = kinds[place]
        found += _found(orientations, _Wanted.of(orientations, carrier, anchor), number)
        tried += 1
    found.sort(key=lambda each: -round(each.transmission, 6))
    return GuidedSixBars(orientations, tuple(found[:most]), tried)


class _Wanted(NamedTuple):
    """The orientations that chains are to take, and the kind of linkage."""

    matrices: Floats
    """Of the body relative to the ground, or the other way round if the driven joint is on the body."""
    driven: Carrier
    anchor: int

    @classmethod
    def of(cls, orientations: Orientations, driven: Carrier, anchor: int) -> "_Wanted":
        m = orientations.matrices
        return cls(m if driven == "ground" else np.swapaxes(m, 1, 2), driven, anchor)


class _Chains(NamedTuple):
    """Chains of three joints: n of them."""

    fixed: Floats
    """Axes of the joints with the ground, unit vectors float[n, 3]."""
    moving: Floats
    """Axes of the joints with the body, in the body, float[n, 3]."""
    arcs: Floats
    """Of links 1 and 2, radians, float[n, 2]."""
    elbows: Floats
    """To which side of the plane of these axes the middle joint lies at each orientation, 1 or -1: float[n, 5]."""
    senses: Floats
    """Of the driven joint, 1 or -1: float[n]."""

    def changed(self, random: np.random.Generator, sizes: Floats) -> "_Chains":
        """Return chains with every axis and arc changed at random."""
        fixed, moving, arcs = (values + sizes[:, None] * random.normal(size=values.shape) for values in self[:3])
        return self._replace(fixed=unit(fixed), moving=unit(moving), arcs=arcs)

    def replaced(self, other: "_Chains", where: Flags) -> "_Chains":
        """Return these chains, and the other ones where a flag is set."""
        fixed, moving, arcs = (np.where(where[:, None], b, a) for a, b in zip(self[:3], other[:3], strict=True))
        return self._replace(fixed=fixed, moving=moving, arcs=arcs)


class _Placed(NamedTuple):
    """Chains at the five orientations: axes of their second and third joints, and angles of the driven one."""

    fixed: Floats
    moving: Floats
    second: Floats
    third: Floats
    inputs: Floats


class _Bars(NamedTuple):
    """A bar of each linkage: its axes in the link that carries it and in the one that it steers, float[n, 3].

    Its arcs, float[n, 2], are its own and that from its end to the joint that it is opposite to; its side is that of
    its end from the plane through its beginning and that joint; the sine is that of the angle at its end, the least
    at the five orientations, negative where the side is another.
    """

    carried: Floats
    steered: Floats
    arcs: Floats
    side: Floats
    sine: Floats

    def cosines(self, carried: Floats, joint: Floats) -> Floats:
        """Return the cosines of the angle at its end, beyond 1 where it does not reach: float[n, K]."""
        one, other = self.arcs[:, 0, None], self.arcs[:, 1, None]
        along = (carried * joint).sum(axis=-1)
        return np.asarray((along - np.cos(one) * np.cos(other)) / (np.sin(one) * np.sin(other)))

    def ends(self, carried: Floats, joint: Floats) -> Floats:
        """Return where its end is, float[n, K, 3]."""
        return _beside(carried, joint, self.arcs[:, None], self.side[:, None])[0]


_Many = TypeVar("_Many", _Chains, _Placed, _Bars)


def _only(values: _Many, which: Any) -> _Many:
    return type(values)(*(value[which] for value in values))


def _beside(one: Floats, other: Floats, arcs: Floats, side: Floats) -> tuple[Floats, Floats]:
    """Return the points at two arcs, float[..., 2], from two points, on a side of their plane, and its room.

    The room is negative where there is none; the point is then in the plane.
    """
    along = (one * other).sum(axis=-1)
    square = np.maximum(1.0 - along * along, DOUBLE.zero)
    first, second = np.cos(arcs[..., 0]), np.cos(arcs[..., 1])
    by_one, by_other = (first - second * along) / square, (second - first * along) / square
    room = 1.0 - by_one**2 - by_other**2 - 2.0 * by_one * by_other * along
    up = side * np.sqrt(np.maximum(room / square, DOUBLE.zero))
    return unit(by_one[..., None] * one + by_other[..., None] * other + up[..., None] * np.cross(one, other)), room


def _drawn(wanted: _Wanted, random: np.random.Generator) -> _Chains:
    """Return the smoothest of many random chains that take the orientations in their order within one turn."""
    found = []
    for _ in range(_DRAWS):
        chains = _Chains(
            unit(random.normal(size=(_DRAWN, 3))), unit(random.normal(size=(_DRAWN, 3))),
            random.uniform(2.0 * _SHORTEST, np.pi - 2.0 * _SHORTEST, (_DRAWN, 2)),
            random.choice([-1.0, 1.0], (_DRAWN, 5)), random.choice([-1.0, 1.0], _DRAWN),
        )  # fmt: skip
        found.append(_only(chains, np.flatnonzero(_placed(wanted, chains)[1])))
    chains = _Chains(*(np.concatenate(values) for values in zip(*found, strict=True)))
    return _only(chains, np.argsort(_roughness(wanted, _placed(wanted, chains)[0]), kind="stable")[:_STARTS])


def _roughness(wanted: _Wanted, placed: _Placed) -> Floats:
    """Return how far the angles of each joint of chains are from a first harmonic in those of the joint before it.

    A four-bar makes functions that are near one, the joint turning with the one before, against it or neither.
    """
    first, second = rotations(placed.fixed[:, None], placed.inputs), _steered(placed)
    middle = _angles_about(placed.second[:, 0], np.swapaxes(first, -1, -2) @ second)
    off = _off_harmonic(placed.inputs, middle)
    if wanted.anchor != 1:  # the angles that the second four-bar makes a function of are not known yet
        return off
    body = wanted.matrices @ wanted.matrices[0].T
    return np.hypot(off, _off_harmonic(middle, _angles_about(placed.third[:, 0], np.swapaxes(second, -1, -2) @ body)))


def _steered(placed: _Placed) -> Floats:
    """Return the rotations of link 2 from orientation 1: float[n, 5, 3, 3]."""
    return turned((placed.second[:, :1], placed.third[:, :1]), (placed.second, placed.third))


def _angles_about(axes: Floats, turns: Floats) -> Floats:
    """Return the angles of rotations, float[n, K, 3, 3], about axes, float[n, 3]."""
    sines = (crossing(axes)[:, None] * turns).sum(axis=(-1, -2)) / 2.0
    return np.asarray(np.arctan2(sines, (np.trace(turns, axis1=-2, axis2=-1) - 1.0) / 2.0))


def _off_harmonic(angles: Floats, others: Floats) -> Floats:
    """Return the least root mean square of a + b cos x + c sin x + k x - y, k one of 0, 1, -1; all are float[n, 5].

    y goes from each x to the next by less than half a turn.
    """
    order = np.argsort(angles, axis=1, kind="stable")
    x, y = np.take_along_axis(angles, order, axis=1), np.unwrap(np.take_along_axis(others, order, axis=1), axis=1)
    basis = np.linalg.qr(np.stack([np.ones_like(x), np.cos(x), np.sin(x)], axis=-1))[0]
    wished = np.stack([y, y - x, y + x], axis=-1)
    off = wished - basis @ (np.swapaxes(basis, 1, 2) @ wished)
    return np.asarray(np.sqrt((off * off).mean(axis=1)).min(axis=1))


def _placed(wanted: _Wanted, chains: _Chains) -> tuple[_Placed, Flags]:
    """Return chains at the five orientations, and which of them take these, in order and within one turn."""
    third = np.einsum("iab,nb->nia", wanted.matrices, chains.moving)
    second, room = _beside(chains.fixed[:, None], third, chains.arcs[:, None], chains.elbows)
    out = unit(across(second, chains.fixed[:, None]))
    sines = (np.cross(out[:, :-1], out[:, 1:]) * chains.fixed[:, None]).sum(axis=-1)
    steps = np.mod(chains.senses[:, None] * np.arctan2(sines, (out[:, :-1] * out[:, 1:]).sum(axis=-1)), _TURN)
    inputs = np.zeros((len(steps), 5))
    inputs[:, 1:] = chains.senses[:, None] * np.cumsum(steps, axis=1)
    takes = (room > _REACH).all(axis=1) & (np.sin(chains.arcs) > _SHORTEST).all(axis=1)
    in_order = (steps > _LEAST_TURN).all(axis=1) & (np.abs(inputs[:, -1]) < _TURN)
    return _Placed(chains.fixed, chains.moving, second, third, inputs), takes & in_order


def _bars(wanted: _Wanted, placed: _Placed) -> tuple[_Bars, _Bars]:
    """Return the bars of each chain that steer link 2 and the body, the best of their dyads."""
    first, second = rotations(placed.fixed[:, None], placed.inputs), _steered(placed)
    ground, body = np.broadcast_to(np.eye(3), second.shape), np.broadcast_to(wanted.matrices, second.shape)
    over = _best_bars((ground, second), placed.second, placed.fixed)
    ends = np.einsum("niab,nb->nia", second, over.steered)
    carrier = np.where((over.sine > _UNUSABLE)[:, None, None, None], _carrier(wanted, over, first, ends), ground)
    own = placed.second[:, 0] if wanted.anchor == 1 else over.steered
    return over, _best_bars((carrier, body), placed.third, own)


def _carrier(wanted: _Wanted, over: _Bars, first: Floats, ends: Floats) -> Floats:
    """Return the rotations of the link that carries bar 5, by those of link 1 and where the end of bar 4 is."""
    if wanted.anchor == 1:
        return first
    fixed = over.carried[:, None]
    return turned((fixed, over.steered[:, None]), (np.broadcast_to(fixed, ends.shape), ends))


def _best_bars(links: tuple[Floats, Floats], joint: Floats, own: Floats) -> _Bars:
    """Return the dyads from one link to another that are farthest from being in line with what they steer.

    Links are the orientations, float[n, 5, 3, 3], of the one that carries a bar, and of the one that is steered; the
    joint, float[n, 5, 3], is that of the chain on the latter; own, float[n, 3], the axis on the former of the link of
    the chain that is such a dyad itself.
    """
    number = len(joint)
    table = dyads_of_sets(np.swapaxes(links[0], -1, -2) @ links[1])
    there = np.arange(table.fixed.shape[1]) < table.count[:, None]
    dyads = np.where(there[:, :, None], [table.fixed, table.moving], 0.0)
    starts, ends = (np.einsum("niab,nvb->nvia", link, axes) for link, axes in zip(links, dyads, strict=True))
    arcs = np.stack([angles_between(one[:, :, 0], ends[:, :, 0]) for one in (starts, joint[:, None])], axis=-1)
    sizes = np.sin(arcs).prod(axis=-1)
    usable = (np.sin(arcs) > _SHORTEST).all(axis=-1) & (np.sin(angles_between(dyads[0], own[:, None])) > _SHORTEST)
    sines = (np.cross(starts, joint[:, None]) * ends).sum(axis=-1) / np.where(usable, sizes, 1.0)[..., None]
    sides = np.where(usable[..., None], np.stack([sines.min(axis=-1), -sines.max(axis=-1)], -1), _UNUSABLE)
    best = sides.reshape(number, -1).argmax(axis=1)
    every, dyad = np.arange(number), best // 2
    return _Bars(dyads[0, every, dyad], dyads[1, every, dyad], arcs[every, dyad],
                 np.where(best % 2 == 0, 1.0, -1.0), sides.reshape(number, -1)[every, best])  # fmt: skip


def _moved(wanted: _Wanted, placed: _Placed, bars: tuple[_Bars, _Bars], inputs: Floats) -> tuple[Floats, Floats]:
    """Return the least room of both four-bars, float[n, 2], and matrices of the body, float[n, K, 3, 3].

    Inputs are angles of the driven joint, float[n, K].
    """
    over, under = bars
    first = rotations(placed.fixed[:, None], inputs)
    second = rotated(placed.second[:, :1], placed.fixed[:, None], inputs)
    fixed = np.broadcast_to(over.carried[:, None], second.shape)
    ends = over.ends(fixed, second)
    steered = turned((placed.second[:, :1], over.steered[:, None]), (second, ends))
    third = np.einsum("nkab,nb->nka", steered, placed.third[:, 0])
    carried = np.einsum("nkab,nb->nka", _carrier(wanted, over, first, ends), under.carried)
    body = turned((placed.moving[:, None], under.steered[:, None]), (third, under.ends(carried, third)))
    cosines = np.stack([over.cosines(fixed, second), under.cosines(carried, third)], axis=1)
    return 1.0 - np.abs(cosines).max(axis=2), body


def _scores(wanted: _Wanted, chains: _Chains, between: int) -> Floats:
    """Return how near the linkages of chains are to taking the orientations without a defect: float[n].

    First bars come to lie on one side at all orientations; then the first four-bar closes between these, then the
    second; beyond `_SOLVED` the transmission angle counts. What does not take the orientations has minus infinity.
    """
    placed, takes = _placed(wanted, chains)
    scores = np.full(len(takes), -np.inf)
    if not takes.any():
        return scores
    placed = _only(placed, takes)
    bars = _bars(wanted, placed)
    score = np.minimum(bars[0].sine, _ENOUGH) + np.minimum(bars[1].sine, _ENOUGH)
    safe = np.flatnonzero((bars[0].sine > _SAFE) & (bars[1].sine > _SAFE))
    placed, bars = _only(placed, safe), (_only(bars[0], safe), _only(bars[1], safe))
    rooms, _ = _moved(wanted, placed, bars, _between(placed.inputs, between))
    parts = 1.0 + np.clip(rooms, -1.0, _ROOMY)
    solved = (rooms > _OPEN).all(axis=1)
    score[safe] += parts[:, 0] + np.where(rooms[:, 0] > _OPEN, parts[:, 1], 0.0)
    score[safe] += np.where(solved, 1.0 + np.arccos(np.clip(1.0 - rooms.min(axis=1), 0.0, 1.0)), 0.0)
    scores[takes] = score
    return scores


def _between(inputs: Floats, parts: int) -> Floats:
    """Return the angles at equal parts from each orientation to the next, and the last: float[n, 4 parts + 1]."""
    steps = np.diff(inputs, axis=1)[..., None] * np.arange(parts) / parts
    inner = (inputs[:, :-1, None] + steps).reshape(len(inputs), 4 * parts)
    return np.concatenate([inner, inputs[:, -1:]], axis=1)


class _Population:
    """Chains, each changed at random as long as its score grows."""

    def __init__(self, wanted: _Wanted, random: np.random.Generator) -> None:
        self._wanted, self._random, self._points = wanted, random, _BETWEEN
        self.chains = _drawn(wanted, random)
        self.scores = _scores(wanted, self.chains, self._points)
        self._sizes = np.full(len(self.scores), _FIRST)

    def keep(self, count: int) -> None:
        """Keep the best."""
        best = np.argsort(-self.scores, kind="stable")[:count]
        self.chains, self.scores, self._sizes = _only(self.chains, best), self.scores[best], self._sizes[best]

    def look_closer(self) -> None:
        """Score chains anew, by more points between orientations."""
        self._points = _CLOSER
        self.scores = _scores(self._wanted, self.chains, self._points)

    def step(self) -> None:
        """Change every chain, and keep the changes that raise its score."""
        changed = self.chains.changed(self._random, self._sizes)
        scores = _scores(self._wanted, changed, self._points)
        better = scores > self.scores
        self.chains, self.scores = self.chains.replaced(changed, better), np.where(better, scores, self.scores)
        self._sizes = np.clip(self._sizes * np.where(better, _GROWS, _SHRINKS), _SMALLEST, _LARGEST)


def _found(orientations: Orientations, wanted: _Wanted, number: int) -> Iterator[GuidedSixBar]:
    """Yield the linkages of a population that take the orientations without a defect, the best first."""
    kind = _CARRIERS.index(wanted.driven), wanted.anchor
    population = _Population(wanted, np.random.default_rng([number, *kind]))
    for count in _KEPT:
        population.keep(count)
        for _ in range(_STEPS):
            population.step()
        solved = int((population.scores > _SOLVED).sum())
        if solved:
            population.keep(solved)
            population.look_closer()
            for _ in range(_LONGER):
                population.step()
            population.keep(solved)
            for place in range(solved):
                yield from _traced(orientations, wanted, _only(population.chains, [place]))
            return


def _traced(orientations: Orientations, wanted: _Wanted, chain: _Chains) -> Iterator[GuidedSixBar]:
    """Yield the linkage of a chain, if it moves from the first orientation to the last."""
    placed, _ = _placed(wanted, chain)
    over, under = _bars(wanted, placed)
    inputs = _between(placed.inputs, _FINE)
    rooms, [body] = _moved(wanted, placed, (over, under), inputs)
    if rooms.min() <= _OPEN:
        return
    steered = under.steered @ wanted.matrices[0].T
    axes = np.vstack([chain.fixed, placed.second[:, 0], placed.third[:, 0], *over[:2], under.carried, steered])
    if wanted.driven == "body":
        axes, body = axes @ orientations.matrices[0].T, np.swapaxes(body, 1, 2)
    keys = tuple(range(0, len(body), _FINE))
    missed = Rotation.from_matrix(np.swapaxes(orientations.matrices, 1, 2) @ body[list(keys)]).magnitude()
    quaternions = facing_on(Orientations.from_matrices(body).quaternions)
    yield GuidedSixBar(
        orientations, wanted.driven, wanted.anchor, axes, placed.inputs[0], float(np.arccos(1.0 - rooms.min())),
        float(missed.max()), BodyMotion(inputs[0], quaternions, keys),
    )  # fmt: skip
