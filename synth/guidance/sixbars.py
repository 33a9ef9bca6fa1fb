"""Spherical six-bars that guide a body through five orientations, by one driven joint that turns one way.

A dyad that takes all five orientations (`synth.guidance.synthesis`) holds the body with two freedoms: u, the angle of
the joint that is driven, and v, that of its other joint. The orientations are five points of the torus of u and v.
A point b of the body is hinged to the coupler of a four-bar on the ground, whose coupler curve is one equation
F(u, v) = 0. The linkage takes the orientations in order, on one circuit and one branch, if and only if a graph v(u)
of solutions leads through the five points with u growing, or falling, and dF/dv is not zero along it. Of curves
F = 0 through the five points there is a family of six parameters; one is looked for that stays near a smooth graph.

Exchanging ground and body gives linkages whose four-bar is on the body. Both have two links of three joints that are
not neighbours: Stephenson's six-bar, its third and second form. Theory: docs/theory/guidance.md.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import product
from math import degrees
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np
from scipy.spatial.transform import Rotation

from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.geometry import across, facing, frame_about, rotated, rotations, unit
from graphs.joints.linkage import plain_vector
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from graphs.printing import Block, Printed, TableBlock
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.guidance.dyads import Dyad, facing_on
from synth.guidance.fourbars import BodyMotion
from synth.guidance.orientations import Orientations
from synth.guidance.synthesis import dyads_of_five

Carrier: TypeAlias = Literal["ground", "body"]

_TURN = 2.0 * np.pi
_CARRIERS: tuple[Carrier, Carrier] = ("ground", "body")
_LINKS = {"ground": ((0, 1), (1, 2), (0, 3), (3, 4), (4, 2), (4, 5), (5, 0)),
          "body": ((0, 1), (1, 2), (2, 3), (3, 4), (4, 0), (4, 5), (5, 2))}  # fmt: skip
"""Joints of the linkage, by the link that carries the four-bar: 0 the ground, 1 the link of the dyad, 2 the body, 3
and 5 the cranks of the four-bar, 4 its coupler."""
_MOST_TURNS = 2.0
"""Turns of a driven joint; in one of its senses any takes five orientations in order in so many."""
_JOINTS = {"ground": "0, on the ground", "body": "1, on the body"}
_FORMS = {"ground": "Stephenson III", "body": "Stephenson II"}

_FOUR_BAR, _POINT, _BUMPS = 9, 2, 3
"""Unknowns of a four-bar with a coupler point; of the point of the body; and, of the graph, between two
orientations."""
_BETWEEN, _CLOSER, _FINE = 6, 20, 60
"""Points of a graph between two orientations in the search, in its last round, and where it is traced."""
_DRAWN, _STARTS, _KEPT, _LAST, _CHOSEN = 4000, 80, 16, 6, 3
_ROUNDS = ((25, 2.0, 0.2, 0.3), (60, 5.0, 0.5, 0.3), (100, 5.0, 1.0, 0.3), (100, 5.0, 0.3, 1.0))
"""Linkages that are drawn, how many of them are starts of a search, and how many are kept after its first, second and
third round; of each round the steps, and the weights of the five orientations, of the points between, and of dF/dv."""
_SHORTEST, _APART, _OFF_AXIS, _REACH = 0.3, 0.1, 0.15, 0.01
"""What is kept away from: sines of arcs; squared sines between the fixed axes, and between the point and the axis of
the body; and how far the coupler is from stretched."""
_CROSSINGS, _LONGER = (0.05, 0.1, 0.2, 0.3, 0.4), 300
"""What dF/dv is to be at least, in the search and afterwards; and steps of each improvement."""
_ALIKE = 1e-3
"""Joint lines of two improved linkages that differ by less, in radians, are those of one."""
_SMOOTH = 0.01
"""Weight of the graph's bumps."""
_DIFFERENCE, _BESIDE = 1e-6, 1e-4
"""Radians by which derivatives are taken; and those that are derived once more."""
_LONGEST, _NEWTON_STEPS, _STRAY = 0.3, 12, 0.3
"""Longest step of an unknown, steps of Newton's method, and by how much neighbours on a traced graph may differ from
what derivatives foretell: radians."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class GuidedSixBar:
    """A spherical six-bar that guides a body through five orientations without a defect.

    Attributes
    ----------
    orientations : Orientations
    dyad : Dyad
        Through all orientations.
    four_bar_on : "ground" or "body"
        The link that carries the four-bar.
    driven : "ground" or "body"
        The driven joint: that of the dyad on the ground, joint 0, or that on the body, joint 1.
    axes : float[7, 3]
        Directions of the joints of `linkage`, at orientation 1.
    inputs : float[5]
        Angles of the driven joint from orientation 1, radians, growing or falling.
    transmission : float
        Least angle, radians, between the coupler curve and the circle on which the driven joint, held fast, leaves
        the point of the body, from orientation 1 to 5: zero is a dead point.
    residual : float
        Largest miss of an orientation by the traced linkage, radians.
    motion : BodyMotion
        From orientation 1 to 5, by angles of the driven joint.

    Examples
    --------
    >>> from synth.guidance import read_orientations, six_bars
    >>> [found] = six_bars(read_orientations("data/orientations/tipparthi.json"), driven="body").six_bars
    >>> found.linkage, found.driven, np.degrees(found.inputs).round().tolist()
    (<HingedSolids: 6 links, 7 joints>, 'body', [0.0, 121.0, 175.0, 258.0, 312.0])
    """

    orientations: Orientations
    dyad: Dyad
    four_bar_on: Carrier
    driven: Carrier
    axes: Floats
    inputs: Floats
    transmission: float
    residual: float
    motion: BodyMotion

    @property
    def form(self) -> str:
        """Name of the six-bar."""
        return _FORMS[self.four_bar_on]

    @property
    def linkage(self) -> HingedSolids:
        """The linkage at orientation 1: link 0 is the ground, link 2 the body."""
        around = (0, 1, 4, 3, 2) if self.four_bar_on == "ground" else (0, 1, 2, 3, 4)
        loops = [Loop(joints, Centre.FINITE) for joints in ((2, 3, 5, 6), around)]
        chain = SCGraph(6, list(_LINKS[self.four_bar_on]), loops)
        return HingedSolids(chain, {joint: ((0.0, 0.0, 0.0), plain_vector(self.axes[joint])) for joint in range(7)})

    def __repr__(self) -> str:
        crossing = f"transmission {degrees(self.transmission):.1f} degrees"
        return f"<GuidedSixBar: {self.form}, driven on the {self.driven}, {crossing}>"

    def to_json(self) -> dict[str, Any]:
        """Return the six-bar as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return {
            "form": self.form,
            "four_bar_on": self.four_bar_on,
            "dyad": self.dyad.to_json(),
            "driven": self.driven,
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
    tried, ways : int
        How many ways through the five points of a torus were tried, and how many there are.

    Examples
    --------
    >>> GuidedSixBars(Orientations.from_axis_angles(np.eye(3), [0.0, 0.5, 0.7]), (), 0, 0)
    <GuidedSixBars: 0 six-bars without defects>
    """

    orientations: Orientations
    six_bars: tuple[GuidedSixBar, ...]
    tried: int
    ways: int

    def __repr__(self) -> str:
        return f"<GuidedSixBars: {numbered(len(self.six_bars), 'six-bar')} without defects>"

    def to_json(self) -> dict[str, Any]:
        """Return the six-bars as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return {
            "orientations": len(self.orientations),
            "sixbars": [six_bar.to_json() for six_bar in self.six_bars],
            "tried": self.tried,
            "ways": self.ways,
        }

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        heads = ("six-bar", "form", "dyad G", "dyad W (body)", "driven joint", "turns by", "transmission", "residual")
        rows = [
            (
                str(number),
                each.form,
                *(" ".join(f"{x:7.4f}" for x in axis) for axis in (each.dyad.fixed, each.dyad.moving)),
                _JOINTS[each.driven],
                f"{degrees(each.inputs[-1]):.1f}",
                f"{degrees(each.transmission):.2f}",
                f"{each.residual:.0e}",
            )
            for number, each in enumerate(self.six_bars, start=1)
        ]
        found = f"{len(self.orientations)} orientations: {numbered(len(self.six_bars), 'six-bar')} without defects"
        tried = f"{self.tried} of {numbered(self.ways, 'way')} from orientation to orientation tried"
        return [f"{found}; {tried}", *([TableBlock(heads, rows, ["turns by", "transmission"])] if rows else [])]


def six_bars(
    orientations: Orientations, *, most: int = 1, tries: int = 200, driven: Carrier | None = None
) -> GuidedSixBars:
    """Find six-bars that guide a body through five orientations in order, on one circuit and one branch.

    Parameters
    ----------
    orientations : Orientations
        Five of them.
    most : int, optional
        Number of six-bars after which the search ends.
    tries : int, optional
        Largest number of ways from orientation to orientation that are tried, the smoothest first; a way takes some
        seconds.
    driven : "ground" or "body", optional
        The joint of the dyad that is driven; by default either.

    Returns
    -------
    GuidedSixBars
        Each was traced from the first orientation to the last. None means that none was found, not that there is
        none.

    Raises
    ------
    UnsolvableError
        If there are not five, or no dyad, or infinitely many, take them.
    InvariantError
        If `driven` is neither link, or `most` or `tries` are not positive.

    Examples
    --------
    >>> from synth.guidance import read_orientations
    >>> five = read_orientations("data/orientations/tipparthi.json")  # no four-bar takes these without a defect
    >>> [found] = six_bars(five).six_bars
    >>> found.form, found.residual < 1e-12
    ('Stephenson III', True)
    """
    if driven is not None and driven not in _CARRIERS:
        raise InvariantError("driven", shown(driven), "'ground' or 'body'")
    for name, number in (("most", most), ("tries", tries)):
        if number < 1:
            raise InvariantError(name, shown(number), "1 or more")
    dyads = dyads_of_five(orientations).dyads
    if not dyads:
        raise UnsolvableError("no dyad takes these orientations: all six solutions are complex")
    graphs = _graphs(orientations, dyads, _CARRIERS if driven is None else (driven,))
    found: list[GuidedSixBar] = []
    tried = 0
    for number, graph in enumerate(graphs[:tries]):
        found += _six_bars_along(orientations, graph, np.random.default_rng([number, len(graphs)]))
        tried += 1
        if len(found) >= most:
            break
    found.sort(key=lambda each: -round(each.transmission, 6))
    return GuidedSixBars(orientations, tuple(found[:most]), tried, len(graphs))


class _Held(NamedTuple):
    """A body held by a dyad: R = (turn about `fixed` by one angle) `first` (turn about `moving` by another).

    For a four-bar on the body it is the ground that is held, in the frame of the body.
    """

    dyad: Dyad
    carrier: Carrier
    driven: Carrier
    fixed: Floats
    moving: Floats
    first: Floats
    angles: tuple[Floats, Floats]

    def _both(self, driven: Floats, other: Floats) -> tuple[Floats, Floats]:
        """Return the angles about the fixed and the moving axis."""
        return (driven, other) if self.driven == self.carrier else (other, driven)

    def points(self, driven: Floats, other: Floats, body: Floats) -> Floats:
        """Return where points of the body, unit vectors float[..., 3], are: float[..., K, 3]."""
        about_fixed, about_moving = self._both(driven, other)
        return rotated(rotated(body[..., None, :], self.moving, about_moving) @ self.first.T, self.fixed, about_fixed)

    def matrices(self, driven: Floats, other: Floats) -> Floats:
        """Return rotation matrices of the guided body, float[K, 3, 3]."""
        about_fixed, about_moving = self._both(driven, other)
        matrices = rotations(self.fixed, about_fixed) @ self.first @ rotations(self.moving, about_moving)
        return matrices if self.carrier == "ground" else np.swapaxes(matrices, 1, 2)


class _Graph(NamedTuple):
    """A way through the five points of a torus: angles of the driven and of the other joint, not wrapped."""

    held: _Held
    driven: Floats
    other: Floats

    @property
    def steepness(self) -> float:
        """How fast the other joint turns against the driven one, and how suddenly that changes."""
        step, rise = np.abs(np.diff(self.driven)), np.diff(self.other)
        slopes = rise / np.diff(self.driven)
        return float((np.hypot(step, rise) / np.minimum(step, 1.0)).max() + np.abs(np.diff(slopes)).max() / 2.0)


def _graphs(orientations: Orientations, dyads: Sequence[Dyad], driven: Sequence[Carrier]) -> list[_Graph]:
    """Return all ways, the smoothest first, those of at most one turn of the driven joint before the others."""
    graphs = [
        graph
        for dyad, carrier, joint in product(dyads, _CARRIERS, driven)
        for graph in _graphs_of(_held(orientations, dyad, carrier, joint))
    ]
    return sorted(graphs, key=lambda graph: (np.abs(graph.driven[-1]) > _TURN, round(graph.steepness, 6)))


def _held(orientations: Orientations, dyad: Dyad, carrier: Carrier, driven: Carrier) -> _Held:
    m = orientations.matrices
    spins = m[0].T @ rotations(dyad.fixed, -dyad.crank_angles) @ m  # turns about the moving axis
    beside = frame_about(dyad.moving)[0]
    turned = spins @ beside
    angles = (dyad.crank_angles, np.arctan2(turned @ np.cross(dyad.moving, beside), turned @ beside))
    inputs, outputs = angles if driven == "ground" else angles[::-1]
    if carrier == "ground":
        return _Held(dyad, carrier, driven, dyad.fixed, dyad.moving, m[0], (inputs, outputs))
    return _Held(dyad, carrier, driven, dyad.moving, dyad.fixed, m[0].T, (-inputs, -outputs))


def _graphs_of(held: _Held) -> Iterator[_Graph]:
    """Yield the ways of a held body: either sense of the driven joint, and either of the other between orientations."""
    driven, other = (np.diff(angles) for angles in held.angles)
    for sense in (1.0, -1.0):
        inputs = sense * np.concatenate([[0.0], np.cumsum(np.mod(sense * driven, _TURN))])
        if np.abs(inputs[-1]) >= _MOST_TURNS * _TURN or np.abs(np.diff(inputs)).min() < DOUBLE.same_configuration:
            continue
        for turns in product((0.0, _TURN), repeat=4):
            yield _Graph(held, inputs, np.concatenate([[0.0], np.cumsum(np.mod(other, _TURN) - turns)]))


def _axis(azimuth: Floats, elevation: Floats) -> Floats:
    level = np.cos(elevation)
    return np.stack([np.cos(azimuth) * level, np.sin(azimuth) * level, np.sin(elevation)], axis=-1)


def _coupler(four_bar: Floats, points: Floats, side: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the axes A and C of a coupler with its point at points, float[..., K, 3], and its room.

    A four-bar is float[..., 9]: azimuth and elevation of the fixed axes G and H, the arcs from G to A, from A to the
    point and from A to C, the angle at A between these two, and the arc from C to H. The side, float[..., 1], is the
    sign of A . (G x point); the room is zero where G, A and the point are in one plane.
    """
    fixed = _axis(four_bar[..., 0], four_bar[..., 1])[..., None, :]
    crank, reach, arm, corner = (four_bar[..., k, None] for k in range(4, 8))
    dot = (fixed * points).sum(axis=-1)
    square = np.maximum(1.0 - dot * dot, DOUBLE.zero)
    one, other = np.cos(crank), np.cos(reach)
    by_fixed, by_point = (one - other * dot) / square, (other - one * dot) / square
    room = 1.0 - by_fixed**2 - by_point**2 - 2.0 * by_fixed * by_point * dot
    beside = side * np.sqrt(np.maximum(room / square, DOUBLE.zero))
    a = unit(by_fixed[..., None] * fixed + by_point[..., None] * points + beside[..., None] * np.cross(fixed, points))
    ahead = unit(points - a * (a * points).sum(axis=-1, keepdims=True))
    left = np.cross(a, ahead)
    towards = np.cos(corner)[..., None] * ahead + np.sin(corner)[..., None] * left
    return a, np.cos(arm)[..., None] * a + np.sin(arm)[..., None] * towards, room


def _off_curve(four_bar: Floats, points: Floats, side: Floats) -> tuple[Floats, Floats]:
    """Return by how much points miss the coupler curve, as an angle of the second crank, and the room of `_coupler`."""
    _, c, room = _coupler(four_bar, points, side)
    cosine = (c * _axis(four_bar[..., 2], four_bar[..., 3])[..., None, :]).sum(axis=-1)
    return np.arccos(np.clip(cosine, DOUBLE.zero - 1.0, 1.0 - DOUBLE.zero)) - four_bar[..., 8, None], room


class _Fit:
    """The residuals of linkages whose curve is to be a given graph, or near it: those of a search."""

    def __init__(self, graph: _Graph, between: int = _BETWEEN) -> None:
        self.graph = graph
        self._driven = np.concatenate([graph.driven, _between(graph.driven, between + 1)[:, 1:].ravel()])
        self._smooth, self._bumps = self._parts(self._driven)
        self.weights, self.slope, self.crossing = np.ones(len(self._driven)), 1.0, _CROSSINGS[0]

    def weigh(self, of_orientations: float, between: float, slope: float) -> None:
        """Set the weights of the five orientations, of the points between, and of dF/dv."""
        self.slope = slope
        self.weights[:5], self.weights[5:] = of_orientations, between

    def _parts(self, driven: Floats) -> tuple[Floats, Floats]:
        """Return a smooth graph at some angles, float[K], and the bumps that are added to it, float[K, 12]."""
        from scipy.interpolate import PchipInterpolator

        graph = self.graph
        ends = np.abs(graph.driven)
        smooth = PchipInterpolator(ends, graph.other)(np.abs(driven))
        interval = np.clip(np.searchsorted(ends, np.abs(driven), side="right") - 1, 0, 3)
        part = (np.abs(driven) - ends[interval]) / np.diff(ends)[interval]
        bumps = np.zeros((len(driven), 4, _BUMPS))
        bumps[np.arange(len(driven)), interval] = np.sin(np.pi * np.arange(1, _BUMPS + 1) * part[:, None])
        return smooth, bumps.reshape(len(driven), 4 * _BUMPS)

    def at(self, driven: Floats, bumps: Floats) -> Floats:
        """Return a fitted graph at some angles, float[K]."""
        smooth, shapes = self._parts(driven)
        return np.asarray(smooth + shapes @ bumps)

    def second_crank(self, unknowns: Floats, sides: Floats) -> tuple[Floats, Floats]:
        """Return the mean arc of the second crank, float[n], and the mean of dF/dv, of linkages without that arc."""
        body = _axis(unknowns[..., 9], unknowns[..., 10])
        arcs, _ = _off_curve(unknowns[..., :_FOUR_BAR], self.graph.held.points(self._driven, self._smooth, body), sides)
        beside, _ = _off_curve(
            unknowns[..., :_FOUR_BAR], self.graph.held.points(self._driven, self._smooth + _DIFFERENCE, body), sides
        )
        return arcs.mean(axis=-1), (beside - arcs).mean(axis=-1) / _DIFFERENCE

    def off(self, unknowns: Floats, signs: Floats) -> Floats:
        """Return the misses of all points, and how far each linkage is inside what is kept away from."""
        four_bar, body = unknowns[..., :_FOUR_BAR], _axis(unknowns[..., 9], unknowns[..., 10])
        bumps = unknowns[..., _FOUR_BAR + _POINT :]
        other = self._smooth + (bumps @ self._bumps.T if bumps.shape[-1] else 0.0)
        held, side = self.graph.held, signs[..., :1]
        miss, room = _off_curve(four_bar, held.points(self._driven, other, body), side)
        beside, _ = _off_curve(four_bar, held.points(self._driven, other + _BESIDE, body), side)
        crossing = signs[..., 1:] * (beside - miss) / _BESIDE
        one, two = _axis(four_bar[..., 0], four_bar[..., 1]), _axis(four_bar[..., 2], four_bar[..., 3])
        apart = np.stack(
            [1.0 - (one * two).sum(axis=-1) ** 2 - _APART, 1.0 - (body @ held.moving) ** 2 - _OFF_AXIS], -1
        )
        inside = [
            3.0 * np.minimum(self.weights, 1.0) * np.minimum(room - _REACH, 0.0),
            self.slope * np.minimum(crossing - self.crossing, 0.0),
            np.minimum(np.abs(np.sin(four_bar[..., [4, 5, 6, 8]])) - _SHORTEST, 0.0),
            2.0 * np.minimum(apart, 0.0),
        ]
        return np.concatenate([self.weights * miss, *inside, _SMOOTH * bumps], axis=-1)


def _between(driven: Floats, parts: int) -> Floats:
    """Return the angles at equal parts from each orientation to the next: float[4, parts]."""
    return np.asarray(driven[:-1, None] + np.diff(driven)[:, None] * np.arange(parts) / parts)


_System: TypeAlias = Callable[[Floats], Floats]
"""Residuals, float[..., n, r], of n linkages by their unknowns, float[..., n, m]."""


def _drawn(fit: _Fit, random: np.random.Generator) -> tuple[Floats, Floats]:
    """Return the best of many random linkages, float[n, 11], with the signs of the side and of dF/dv, float[n, 2]."""
    count = _DRAWN
    unknowns = np.column_stack(
        [random.uniform(0.0, _TURN, count), np.arcsin(random.uniform(-1.0, 1.0, count)),
         random.uniform(0.0, _TURN, count), np.arcsin(random.uniform(-1.0, 1.0, count)),
         random.uniform(_SHORTEST, np.pi - _SHORTEST, (count, 3)), random.uniform(0.0, _TURN, count), np.zeros(count),
         random.uniform(0.0, _TURN, count), np.arcsin(random.uniform(-1.0, 1.0, count))]
    )  # fmt: skip
    sides = random.choice([-1.0, 1.0], (count, 1))
    unknowns[:, 8], slopes = fit.second_crank(unknowns, sides)
    signs = np.column_stack([sides, np.where(slopes < 0.0, -1.0, 1.0)])
    fit.weigh(*_ROUNDS[0][1:])
    best = np.argsort((fit.off(unknowns, signs) ** 2).sum(axis=-1), kind="stable")[:_STARTS]
    return unknowns[best], signs[best]


def _searched(graph: _Graph, random: np.random.Generator) -> tuple[Floats, Floats, _Fit]:
    """Return the best linkages of a search, float[n, 23], their signs, float[n, 2], and the last fit."""
    fit = _Fit(graph)
    unknowns, signs = _drawn(fit, random)
    for keep, (steps, *weights) in zip((_STARTS, _KEPT, _LAST, _CHOSEN), _ROUNDS, strict=True):
        unknowns, signs = unknowns[:keep], signs[:keep]
        if keep == _CHOSEN:
            fit = _Fit(graph, _CLOSER)
        if keep == _KEPT:
            unknowns = np.column_stack([unknowns, np.zeros((keep, 4 * _BUMPS))])
        fit.weigh(*weights)
        unknowns, costs = _least(partial(fit.off, signs=signs), unknowns, steps)
        order = np.argsort(costs, kind="stable")
        unknowns, signs = unknowns[order], signs[order]
    return unknowns, signs, fit


def _least(system: _System, unknowns: Floats, steps: int) -> tuple[Floats, Floats]:
    """Return unknowns, float[n, m], after steps of Levenberg and Marquardt's method, and their sums of squares."""
    damping = np.full(len(unknowns), 1e-2)
    off = system(unknowns)
    costs = (off * off).sum(axis=1)
    for _ in range(steps):
        by = _derivatives(system, unknowns, off)
        normal, pull = np.einsum("nij,nik->njk", by, by), np.einsum("nij,ni->nj", by, off)
        size = np.maximum(np.trace(normal, axis1=1, axis2=2) / normal.shape[1], DOUBLE.zero)
        normal += (damping * size)[:, None, None] * np.eye(normal.shape[1])
        step = np.linalg.solve(normal, -pull[..., None])[..., 0]
        step *= np.minimum(1.0, _LONGEST / np.maximum(np.abs(step).max(axis=1), _LONGEST))[:, None]
        moved = unknowns + step
        there = system(moved)
        reached = (there * there).sum(axis=1)
        better = reached < costs
        unknowns, off = np.where(better[:, None], moved, unknowns), np.where(better[:, None], there, off)
        costs = np.where(better, reached, costs)
        damping = np.clip(damping * np.where(better, 0.4, 4.0), 1e-9, 1e6)
    return unknowns, costs


def _derivatives(system: _System, unknowns: Floats, off: Floats) -> Floats:
    """Return the derivatives of residuals, float[n, r, m], by differences."""
    moved = unknowns + _DIFFERENCE * np.eye(unknowns.shape[1])[:, None]
    return np.moveaxis((system(moved) - off) / _DIFFERENCE, 0, -1)


def _exact(graph: _Graph, unknowns: Floats, side: Floats) -> Floats:
    """Return linkages, float[n, 11], that take the five orientations, by Newton's shortest steps."""

    def misses(there: Floats) -> Floats:
        points = graph.held.points(graph.driven, graph.other, _axis(there[..., 9], there[..., 10]))
        return _off_curve(there[..., :_FOUR_BAR], points, side)[0]

    for _ in range(_NEWTON_STEPS):
        off = misses(unknowns)
        by = _derivatives(misses, unknowns, off)
        back = np.swapaxes(by, 1, 2)
        step = -(back @ np.linalg.solve(by @ back + DOUBLE.zero * np.eye(5), off[..., None]))[..., 0]
        step *= np.minimum(1.0, _LONGEST / np.maximum(np.abs(step).max(axis=1), _LONGEST))[:, None]
        unknowns = unknowns + step
    return unknowns


class _Way(NamedTuple):
    """A traced linkage: angles of both joints from orientation 1 to 5, float[K], and angles of crossing, float[K]."""

    driven: Floats
    other: Floats
    crossings: Floats


def _traced(fit: _Fit, unknowns: Floats, near: Floats, side: Floats) -> _Way | None:
    """Return the graph of solutions through the five points near a fitted one; None if it does not lead through them.

    All its points are found by Newton's method. They are one graph if neighbours differ by what dF/dv foretells, and
    dF/dv keeps its sign, as does the side of the coupler.
    """
    graph = fit.graph
    driven = np.append(_between(graph.driven, _FINE).ravel(), graph.driven[-1])
    four_bar, body = unknowns[None, :_FOUR_BAR], _axis(unknowns[9], unknowns[10])[None]

    def misses(other: Floats, beside: float = 0.0) -> tuple[Floats, Floats]:
        off, room = _off_curve(four_bar, graph.held.points(driven + beside, other, body), side[None])
        return off[0], room[0]

    other = fit.at(driven, near)
    for _ in range(_NEWTON_STEPS):
        off, _ = misses(other)
        slope = (misses(other + _DIFFERENCE)[0] - off) / _DIFFERENCE
        other = other - np.clip(off / np.where(np.abs(slope) > DOUBLE.zero, slope, np.inf), -0.1, 0.1)
    off, room = misses(other)
    slope = (misses(other + _DIFFERENCE)[0] - misses(other - _DIFFERENCE)[0]) / (2.0 * _DIFFERENCE)
    along = (misses(other, _DIFFERENCE)[0] - misses(other, -_DIFFERENCE)[0]) / (2.0 * _DIFFERENCE)
    if np.abs(off).max() > DOUBLE.closed or room.min() <= DOUBLE.clear or np.abs(np.diff(np.sign(slope))).any():
        return None
    rates = -along / slope
    foretold = (rates[1:] + rates[:-1]) / 2.0 * np.diff(driven)
    keys = np.arange(5) * _FINE
    strays = np.abs(np.diff(other) - foretold).max() > _STRAY
    if strays or np.abs(other[keys] - graph.other).max() > DOUBLE.same_configuration:
        return None
    places = [graph.held.points(driven, other + step, body)[0] for step in (0.0, _DIFFERENCE, -_DIFFERENCE)]
    circles = unit(across(places[1] - places[2], places[0]))
    return _Way(
        driven, other, _crossings(lambda at: _off_curve(four_bar, at[None], side[None])[0][0], places[0], circles)
    )


def _crossings(curve: Callable[[Floats], Floats], points: Floats, circles: Floats) -> Floats:
    """Return the angles, 0 to 90 degrees, at which circles cross the curve where a function of points is zero.

    Points are unit vectors, float[K, 3], circles the directions of theirs there.
    """
    beside = np.cross(points, circles)
    slopes = [
        (curve(unit(points + _DIFFERENCE * way)) - curve(unit(points - _DIFFERENCE * way))) for way in (circles, beside)
    ]
    return np.asarray(np.arctan2(np.abs(slopes[0]), np.abs(slopes[1])))


def _six_bars_along(orientations: Orientations, graph: _Graph, random: np.random.Generator) -> list[GuidedSixBar]:
    """Return the linkages found whose motion is near a way, the best that each search came to.

    What leads through all orientations is improved: dF/dv is to stay farther from zero, by and by, as long as the
    least angle of crossing grows.
    """
    unknowns, signs, fit = _searched(graph, random)
    best: dict[int, GuidedSixBar] = {}
    active = np.arange(len(unknowns))
    for crossing in _CROSSINGS:
        if crossing > fit.crossing:
            fit.crossing = crossing
            unknowns[active], _ = _least(partial(fit.off, signs=signs[active]), unknowns[active], _LONGER)

        sides = signs[active, :1]
        numbers = _exact(graph, unknowns[active, : _FOUR_BAR + _POINT], sides)
        better = []
        for place, each, side in zip(active.tolist(), numbers, sides, strict=True):
            way = _traced(fit, each, unknowns[place, _FOUR_BAR + _POINT :], side)
            if way is not None and (place not in best or way.crossings.min() > best[place].transmission):
                best[place] = _six_bar(orientations, graph, each, side, way)
                better.append(place)
        active = np.array(better, dtype=int)
        if not better:
            break
    return _different(sorted(best.values(), key=lambda each: -round(each.transmission, 6)))


def _different(six_bars: Sequence[GuidedSixBar]) -> list[GuidedSixBar]:
    """Return one of those with the same joint lines, whichever ends of them the arcs were taken to."""
    different: list[GuidedSixBar] = []
    for each in six_bars:
        lines = facing(each.axes)
        if all(np.abs(lines - facing(other.axes)).max() > _ALIKE for other in different):
            different.append(each)
    return different


def _six_bar(orientations: Orientations, graph: _Graph, numbers: Floats, side: Floats, way: _Way) -> GuidedSixBar:
    """Return a traced linkage with its axes at orientation 1."""
    held = graph.held
    body = _axis(numbers[9], numbers[10])
    point = held.points(graph.driven[:1], graph.other[:1], body[None])[0]
    a, c, _ = _coupler(numbers[None, :_FOUR_BAR], point[None], side[None])
    fixed, other = _axis(numbers[[0, 2]], numbers[[1, 3]])
    first = orientations.matrices[0]
    into_ground = np.eye(3) if held.carrier == "ground" else first
    steering = facing(np.array([fixed, a[0, 0], point[0], c[0, 0], other]) @ into_ground.T)
    matrices = held.matrices(way.driven, way.other)
    keys = tuple(range(0, len(matrices), _FINE))
    missed = Rotation.from_matrix(np.swapaxes(orientations.matrices, 1, 2) @ matrices[list(keys)]).magnitude()
    quaternions = facing_on(Orientations.from_matrices(matrices).quaternions)
    return GuidedSixBar(
        orientations, held.dyad, held.carrier, held.driven,
        np.vstack([held.dyad.fixed, first @ held.dyad.moving, steering]), _seen_by_ground(held, graph.driven),
        float(way.crossings.min()), float(missed.max()),
        BodyMotion(_seen_by_ground(held, way.driven), quaternions, keys),
    )  # fmt: skip


def _seen_by_ground(held: _Held, driven: Floats) -> Floats:
    """Return angles of the driven joint as they are counted from the ground to the body."""
    return driven if held.carrier == "ground" else -driven
