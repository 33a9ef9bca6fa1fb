"""Drawings of a pattern in the plane, one after the other: each from another start, to other lengths.

The start is barycentric, with a convex border, by Tutte's theorem. Then the shape is improved: corners neither
sharp nor flat, edges alike, creases to their centres. The unknowns are the vertices, the centres across holes (a
point for a finite centre, a direction for an infinite one), and *hubs* of panels that cannot be convex. The cost of a
drawing is computed by kernel.c, or by numpy where it was not built.

Source: W. T. Tutte, How to draw a graph, Proc. London Math. Soc. 13 (1963). Theory: docs/theory/realisation.md.
"""

import ctypes
from collections.abc import Iterator, Sequence
from ctypes import c_int, c_void_p
from dataclasses import astuple, dataclass
from functools import cached_property, partial
from pathlib import Path
from weakref import finalize

import numpy as np
import numpy.typing as npt

from graphs.c_libraries import library
from graphs.geometry import common_direction, unit
from graphs.least_squares.gauss_newton import GaussNewton, find_root
from graphs.least_squares.levenberg_marquardt import LevenbergMarquardt, Trial, minimise
from graphs.least_squares.steps import damped_step, minimum_norm_step
from graphs.least_squares.stop_reason import StopReason
from graphs.rank.singular_values import split
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.analysis.motion.walk.step import Allowance
from synth.catalogue.realisation import measures
from synth.catalogue.realisation.conditions import Condition, DrawingConditions, together
from synth.catalogue.realisation.pattern import Pattern

SOURCE = Path(__file__).with_name("kernel.c")
_P = c_void_p


def kernel() -> ctypes.CDLL | None:
    """Return the library with the types of its functions; None where there is none."""
    found = library(SOURCE)
    if found is not None and found.drawing_new.argtypes is None:
        found.drawing_new.restype, found.drawing_new.argtypes = _P, (_P,) * 13
        found.drawing_free.restype, found.drawing_free.argtypes = None, (_P,)
        found.drawing_cost.restype, found.drawing_cost.argtypes = c_int, (_P, _P, _P, c_int, _P, _P, _P)
    return found


@dataclass(frozen=True, slots=True)
class Sizes:
    """Sizes below which corners, turns of the border and seen sides cost more than they should, and that of lengths."""

    sharp: float
    length: float
    border: float
    seen: float


class KernelDrawing:
    """The cost of drawings of a pattern in the library."""

    def __init__(self, library: ctypes.CDLL, pattern: Pattern, points: int, sizes: Sizes) -> None:
        corners, rings = pattern.corners, (pattern.outer, *pattern.holes)
        apex = corners[:, 1]
        numbers = [points, pattern.vertices, len(pattern.panels), len(corners), len(pattern.edges)]
        numbers += [len(pattern.seen_from_hubs), len(rings), len(pattern.inner), len(pattern.hubs)]
        arrays: list[npt.NDArray[np.int32]] = [
            np.ascontiguousarray(values, dtype=np.int32)
            for values in (
                corners,
                pattern.edges,
                pattern.seen_from_hubs,
                pattern.panel_of_corner,
                np.searchsorted(np.sort(apex), np.arange(pattern.vertices + 1)),
                np.argsort(apex, kind="stable"),
                np.cumsum([0, *map(len, rings)]),
                [vertex for ring in rings for vertex in ring],
                pattern.inner,
                [len(panel) for panel in pattern.panels],
            )
        ]
        first, widest = np.array(numbers, np.int64), np.ascontiguousarray(pattern.widest)
        zeros = np.array([*astuple(sizes), DOUBLE.same_point, DOUBLE.same_configuration])
        places = [first.ctypes.data, *(array.ctypes.data for array in arrays), widest.ctypes.data, zeros.ctypes.data]
        self._handle = library.drawing_new(*places)
        if not self._handle:
            raise MemoryError("no memory for a drawing of so many panels")
        finalize(self, library.drawing_free, self._handle)
        rows = 2 * len(corners) + len(pattern.edges) + sum(map(len, rings)) + len(pattern.seen_from_hubs)
        self._library, self._shape = library, (rows, 2 * points)
        self._room = np.empty(7 * len(corners) + len(pattern.panels) + pattern.vertices)

    def cost(self, unknowns: Floats, lengths: Floats, *, convex: bool) -> tuple[Floats, Floats] | None:
        """Return residuals, float[R], and their derivatives; None where it is no drawing. One thread at a time."""
        residuals, derivatives = np.empty(self._shape[0]), np.empty(self._shape)
        unknowns, lengths = np.ascontiguousarray(unknowns), np.ascontiguousarray(lengths)
        arrays = (residuals, derivatives, self._room)
        places = (unknowns.ctypes.data, lengths.ctypes.data, int(convex), *(array.ctypes.data for array in arrays))
        return (residuals, derivatives) if self._library.drawing_cost(self._handle, *places) else None


_SPREAD = 0.5


def barycentric_start(pattern: Pattern, random: np.random.Generator | None = None) -> tuple[Floats, Floats, Floats]:
    """Return places of the vertices, hubs of holes, and hubs of panels that cannot be convex.

    Edges are about 1 long. The generator gives every edge a weight; without it all weights are equal.
    """
    # Tutte: in a convex border, with every other vertex in a weighted mean of its neighbours, the panels of a
    # 3-connected pattern are strictly convex and none overlap. Rules S1 and S2 of SCD graphs say that patterns
    # are, with a hub in each hole joined to all vertices round it, where the centre across the hole begins. A
    # panel that cannot be convex gets a hub too, and is a star round it.
    rings = [*pattern.holes, *(panel for place, panel in enumerate(pattern.panels) if pattern.bent[place])]
    spokes = [(v, pattern.vertices + hub) for hub, ring in enumerate(rings) for v in ring]
    pairs = np.concatenate([pattern.edges, np.array(spokes, np.int64).reshape(-1, 2)])
    weights = np.ones(len(pairs)) if random is None else np.exp(_SPREAD * random.standard_normal(len(pairs)))
    count = pattern.vertices + len(rings)
    matrix = np.zeros((count, count))
    both = np.repeat(weights, 2)
    np.add.at(matrix, (pairs.ravel(), pairs.ravel()), both)
    np.subtract.at(matrix, (pairs.ravel(), pairs[:, ::-1].ravel()), both)
    around = np.array(pattern.outer)
    angles = 2 * np.pi * np.arange(len(around)) / len(around)
    places = np.zeros((count, 2))
    places[around] = np.column_stack([np.cos(angles), np.sin(angles)])
    inner = np.setdiff1d(np.arange(count), around)
    if len(inner):
        right = -matrix[np.ix_(inner, around)] @ places[around]
        places[inner] = np.linalg.solve(matrix[np.ix_(inner, inner)], right)
    ends = places[pattern.edges]
    places /= np.exp(np.log(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)).mean())
    in_panels = pattern.vertices + len(pattern.holes)
    return places[: pattern.vertices], places[pattern.vertices : in_panels], places[in_panels:]


_LEFT, _RIGHT = np.array([-1.0, 1.0]), np.array([1.0, -1.0])
"""Signs of (y, x), by which a vector (x, y) is turned to the left, to the right."""


def first_unknowns(pattern: Pattern, places: Floats, in_holes: Floats, in_panels: Floats) -> Floats:
    """Return the unknowns of a drawing, float[V + C + B, 2], from what `barycentric_start` returns.

    Vertices, a point for each centre that is no vertex, hubs of bent panels; the point of an infinite centre is
    its direction, of length 1, the mean of its creases whichever way they run.
    """
    points = []
    for pointing in pattern.free_centres:
        if pointing.infinite:
            ends = places[[pattern.creases[crease] for crease in pointing.creases]]
            points.append(common_direction(unit(ends[:, 1] - ends[:, 0])))
        else:
            points.append(in_holes[list(pointing.holes)].mean(axis=0))
    return np.concatenate([places, np.array(points).reshape(-1, 2), in_panels])


def centre_residual(pattern: Pattern, unknowns: Floats) -> tuple[Floats, Floats]:
    """Return the sine of the angle by which each crease misses its centre, and the derivatives.

    A value for each row of `Pattern.aims`, then by how much the direction of each infinite centre is longer than
    1: float[A + D], with derivatives float[A + D, 2 (V + C + B)]; in these lengths are taken as constant, so that
    they are exact where nothing is off.
    """
    if not len(pattern.aims):
        return np.zeros(0), np.zeros((0, unknowns.size))
    a, b, centre, infinite = pattern.aims.T
    along = unknowns[b] - unknowns[a]
    reach = (1 - infinite)[:, None] / 2
    to = unknowns[centre] - reach * (unknowns[a] + unknowns[b])
    sizes = np.sqrt((along**2).sum(axis=1) * (to**2).sum(axis=1))
    scale = np.maximum(sizes, DOUBLE.same_point)  # in the middle of a crease a centre has no direction from there
    by_along, by_to = to[:, ::-1] * _RIGHT / scale[:, None], along[:, ::-1] * _LEFT / scale[:, None]
    half = reach * by_to
    rows, directions = np.arange(len(pattern.aims)), pattern.directions
    derivatives = np.zeros((len(rows) + len(directions), *unknowns.shape))
    derivatives[rows, b] = by_along - half
    derivatives[rows, a] = -by_along - half
    derivatives[rows, centre] += by_to
    derivatives[len(rows) + np.arange(len(directions)), directions] = unknowns[directions]
    sines = (along[:, 0] * to[:, 1] - along[:, 1] * to[:, 0]) / scale
    longer = ((unknowns[directions] ** 2).sum(axis=1) - 1.0) / 2
    return np.concatenate([sines, longer]), derivatives.reshape(len(derivatives), unknowns.size)


SHAPE = Sizes(
    sharp=float(np.radians(35.0)),  # corners sharper than this, or as near to 180 degrees, are hard to fold
    length=1.1,  # weight of logarithms of lengths: a little more than of corners, so that no edge is short
    border=0.15,  # part of the mean turn at a vertex of the border below which the border is nearly straight there
    seen=float(np.radians(6.0)),  # sides of bent panels seen from the hub under less: they may be narrow, not closed
)
"""Of the cost of a shape."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Shaping(LevenbergMarquardt):
    """How shapes are searched: which gain is the last depends on the creases."""

    missed: float
    near: float
    enough: float
    creeping: float
    digits: int
    idle: float

    def least_gain_at(self, there: "_DrawingIterate") -> float:
        """Return the reduction of the cost that is the last: creases far from their centres may creep to them."""
        return self.enough if np.abs(there.missed).max(initial=0.0) < self.near else self.creeping


_SHAPING = _Shaping(
    first=1e-2,  # the start is even already
    least=1e-6,  # motions of the whole plane change nothing, and need some damping
    most=1e8,  # steps are then below the decimals that are kept
    raised=6.0,
    lowered=(10.0,),
    cautious=2.0,  # where a panel would have turned over, the next step might turn it too
    required=1e-9,  # a step that gains less may gain by rounding alone
    most_steps=40,  # bounds the time of large drawings: a shape need not be the best one
    missed=30.0,  # cost of a crease off its centre, per sine of the angle: more than a better shape gains by it
    near=1e-4,  # creases off their centres by less are near: the last steps put them there
    enough=1e-3,  # a step that gains less is the last, where creases are near: no eye sees more
    creeping=1e-5,  # the same where they are not near yet
    digits=6,  # decimals kept, edges being about 1 long: symmetric drawings else lose symmetry, as rounding grows
    idle=1e-6,  # motions of the plane of length 1 by which conditions change by less than this change nothing
)
"""Shapes."""

_MEETING = GaussNewton(
    most_steps=12  # errors are squared, or halved where conditions become dependent
)
"""To where creases meet their centres."""


@dataclass(frozen=True)
class _Goal:
    """What a drawing of a pattern is to have: logarithms of lengths, and exact conditions; maybe a convex border.

    The library computes the cost, if there is one.
    """

    pattern: Pattern
    convex: bool
    lengths: Floats
    exactly: Condition
    library: KernelDrawing | None

    def at(self, unknowns: Floats) -> "_DrawingIterate | None":
        """Return the drawing; None where vertices coincide, a panel is turned over or the border is bent."""
        if self.library is None:
            shape = shape_cost(self.pattern, unknowns, self.lengths, convex=self.convex)
        else:
            shape = self.library.cost(unknowns, self.lengths, convex=self.convex)
        if shape is None:
            return None
        missed, missed_jacobian = self.exactly(unknowns)
        if not (np.isfinite(missed).all() and np.isfinite(missed_jacobian).all()):
            return None
        return _DrawingIterate(self, unknowns, *shape, missed, missed_jacobian)


@dataclass(frozen=True)
class _DrawingIterate:
    """A drawing with the residual of its shape, by how much it misses the exact conditions, and both Jacobians."""

    goal: _Goal
    unknowns: Floats
    residual: Floats
    jacobian: Floats
    missed: Floats
    missed_jacobian: Floats
    solved: bool = False

    @cached_property
    def cost(self) -> float:
        """The sum of squares, with an exact penalty for creases off their centres."""
        return float(self.residual @ self.residual + _SHAPING.missed * np.abs(self.missed).sum())

    @cached_property
    def _parts(self) -> tuple[Floats, Floats, Floats]:
        """The shortest steps by which creases turn to their centres, and steps by which none turns off its own.

        Both in columns, then the Jacobian of the shape along the second.
        """
        parts = split(self.missed_jacobian)
        rank, right = parts.rank, parts.right
        back = (right[:rank].T / parts.values[:rank]) @ parts.left[:, :rank].T
        return back, right[rank:].T, self.jacobian @ right[rank:].T

    def trial(self, damping: float) -> Trial["_DrawingIterate"]:
        """Return the step to the better shape, and a part of the way to where all conditions are met."""
        step = self._without_idle(self._stepped(damping) - self.unknowns)
        return Trial(self.goal.at(np.round(self.unknowns + step, _SHAPING.digits)), damping)

    def _stepped(self, damping: float) -> Floats:
        unknowns = self.unknowns
        if not len(self.missed):
            return unknowns + damped_step(self.jacobian, self.residual, damping).reshape(unknowns.shape)
        part = 1.0 / (1.0 + damping)
        back, free, jacobian = self._parts
        there = -part * (back @ self.missed)
        within = free @ damped_step(jacobian, self.residual + self.jacobian @ there, damping)
        trial = unknowns + (there + within).reshape(unknowns.shape)
        # Second-order correction: creases turn on the way, so that the step misses their centres in second order.
        # Else the gain in shape would have to outweigh it, and steps would be short.
        missed = self.goal.exactly(trial)[0] - (1.0 - part) * self.missed
        return np.asarray(trial - (back @ missed).reshape(unknowns.shape))

    def _without_idle(self, step: Floats) -> Floats:
        """Return a step without the motions of the whole plane that change nothing.

        Only rounding puts them there, but the damping alone keeps it small, and it would grow from step to step.
        """
        unknowns = self.unknowns
        points = np.ones(len(unknowns))
        points[self.goal.pattern.directions] = 0.0
        middle = points[:, None] * (points @ unknowns / points.sum())
        motions = np.zeros((3, *unknowns.shape))
        motions[0, :, 0] = motions[1, :, 1] = points
        motions[2] = (unknowns - middle)[:, ::-1] * (-1.0, 1.0)
        rows = unit(motions.reshape(3, -1))  # at right angles to each other, since they are about the middle
        moved = np.abs(self.missed_jacobian @ rows.T).max(axis=0, initial=0.0)
        idle = rows[moved < _SHAPING.idle]
        within: Floats = (idle @ step.ravel()) @ idle
        return step - within.reshape(step.shape)


@np.errstate(divide="ignore", invalid="ignore")  # steps on which vertices coincide are not taken
def improved(
    pattern: Pattern,
    start: Floats,
    *,
    convex: bool = True,
    aims: Floats | None = None,
    conditions: Sequence[Condition] = (),
    allowance: Allowance | None = None,
) -> Floats | None:
    """Return a drawing of better shape in which creases point to their centres; None if none was found.

    Drawings are float[V + C + B, 2], the first one with panels that are convex, or seen from their hubs; edges of
    the result have the mean length 1, or that of the aims, float[E], logarithms of lengths. Conditions are met
    exactly too. The allowance counts steps: where it is used up the shape that was reached is returned.
    """
    # The cost is a sum of squares that grow without bound where a corner closes or opens; no step may turn a panel
    # over. Each step goes to where creases meet their centres, as far as derivatives tell, and within that to the
    # better shape; it is accepted if the cost with its penalty for creases off their centres falls.
    exactly = together(partial(centre_residual, pattern), *conditions)
    lengths = np.zeros(len(pattern.edges)) if aims is None else aims
    first = _Goal(pattern, convex, lengths, exactly, _library(pattern, len(start))).at(start)
    if first is None:
        return None
    may_try = (lambda: True) if allowance is None else allowance.take
    end = minimise(first, _SHAPING, may_try=may_try, least_gain=_SHAPING.least_gain_at)
    return _met(pattern, end.at.unknowns, exactly)


@dataclass(frozen=True)
class _MeetingIterate:
    """A drawing in which conditions are to be met exactly."""

    exactly: Condition
    unknowns: Floats

    @cached_property
    def _residual(self) -> tuple[Floats, Floats]:
        return self.exactly(self.unknowns)

    @property
    def error(self) -> float:
        """By how much a condition is missed at most."""
        return float(np.abs(self._residual[0]).max(initial=0.0))

    def onwards(self) -> "_MeetingIterate | None":
        """Return the drawing moved as little as may be to where conditions are met; None where vertices coincide."""
        residual, jacobian = self._residual
        if not np.isfinite(jacobian).all():
            return None
        step = minimum_norm_step(jacobian, residual)
        return _MeetingIterate(self.exactly, self.unknowns + step.reshape(self.unknowns.shape))


def _met(pattern: Pattern, unknowns: Floats, exactly: Condition) -> Floats | None:
    """Return the drawing with all creases on their centres and all conditions met, moved as little as possible."""
    end = find_root(_MeetingIterate(exactly, unknowns), _MEETING)
    if end.reason is StopReason.UNDEFINED or end.at.error > DOUBLE.closed:
        return None
    angles, _ = measures.opened_angles(pattern, end.at.unknowns[: pattern.vertices])
    return end.at.unknowns if measures.is_drawn(pattern, angles) else None


def _library(pattern: Pattern, points: int) -> KernelDrawing | None:
    """Return what the library does for drawings of so many points; None where there is no library."""
    found = kernel()
    return None if found is None else KernelDrawing(found, pattern, points, SHAPE)


def shape_cost(pattern: Pattern, unknowns: Floats, aims: Floats, *, convex: bool) -> tuple[Floats, Floats] | None:
    """Return the residuals of corners, lengths, turns of the border and seen sides, with derivatives, or None.

    Aims, float[E], are logarithms of lengths. The library does the same (`KernelDrawing`).
    """
    places = unknowns[: pattern.vertices]
    points = np.concatenate([places, unknowns[len(unknowns) - len(pattern.hubs) :]])
    if len(set(map(tuple, points.tolist()))) < len(points):
        return None
    angles, jacobian = measures.opened_angles(pattern, places)
    if not measures.is_drawn(pattern, angles):
        return None
    lengths, by_lengths = measures.edge_lengths(places, pattern.edges)
    lengths = lengths - aims
    rows = [
        *_near(angles, jacobian, SHAPE.sharp, 1.0),
        *_near(pattern.widest - angles, jacobian, SHAPE.sharp, -1.0),
        SHAPE.length * (lengths + lengths**3),
        SHAPE.length * (1 + 3 * lengths[:, None] ** 2) * by_lengths,
    ]
    for place, sums in enumerate(pattern.sums_at_rings):  # the border first
        left = (np.pi if convex and not place else 2 * np.pi) - sums @ angles
        if left.min() <= 0.0:
            return None
        rows += _near(left, sums @ jacobian, SHAPE.border * 2 * np.pi / len(left), -1.0)
    if pattern.hubs:
        seen, by_seen = _seen(pattern, unknowns)
        if seen.min() <= 0.0 or measures.crossings(pattern, places):
            return None
        rows += [seen, by_seen]
    residuals = np.concatenate(rows[::2])
    derivatives, start = np.zeros((len(residuals), unknowns.size)), 0
    for part in rows[1::2]:
        derivatives[start : start + len(part), : part.shape[1]] = part
        start += len(part)
    return residuals, derivatives


def _seen(pattern: Pattern, unknowns: Floats) -> tuple[Floats, Floats]:
    """Return the cost of sides of bent panels that are hardly seen from their hub; negative if one is not seen."""
    angles, jacobian = measures.corner_angles(unknowns, pattern.seen_from_hubs)
    costs, by_costs = _near(angles, jacobian, SHAPE.seen, 1.0)
    return np.where(angles > 0.0, costs, -1.0), by_costs


def _near(angles: Floats, jacobian: Floats, size: float, sign: float) -> tuple[Floats, Floats]:
    """Return residuals that grow as angles come near to 0, and derivatives; ``sign`` is that of their own."""
    residuals = (size / angles) ** 2
    return residuals, (-2.0 * sign * residuals / angles)[:, None] * jacobian


_VARIED = 0.35
_APART = 1e-3
"""Centres nearer to each other or to a vertex than this, in units of the extent, count as the same point."""


@dataclass(frozen=True, slots=True)
class PanelDrawing:
    """A drawing: places of the vertices, edges about 1 long, and angles of the corners of panels, radians.

    `convex` says whether the border was kept convex, `number` which try it is.
    """

    places: Floats
    angles: Floats
    convex: bool
    number: int


def drawings(
    pattern: Pattern,
    seed: int,
    tries: int,
    wishes: DrawingConditions | None = None,
    allowance: Allowance | None = None,
    *,
    first: int = 0,
) -> Iterator[PanelDrawing]:
    """Yield drawings without crossings, each panel strictly convex where it can be, creases to their centres.

    The first is as even as possible, every other aims at random lengths. The border is convex; where creases point
    to centres across holes every third drawing may have another. The allowance counts steps of improvement, of all
    drawings: where it is used up there is no other drawing. Tries are numbered from `first`.
    """
    conditions = [] if wishes is None else wishes.conditions(pattern)
    symmetry = None if wishes is None else wishes.symmetry
    for number in range(first, first + tries):
        if allowance is not None and number > first and allowance.left <= 0:
            return
        random = np.random.default_rng((seed, number))
        convex = not pattern.pointings or number % 3 < 2
        start = barycentric_start(pattern, random if number and symmetry is None else None)
        aims = _VARIED * random.standard_normal(len(pattern.edges)) if number or seed else None
        if aims is not None and symmetry is not None:
            aims = symmetry.evened(aims)
        unknowns = first_unknowns(pattern, *start)
        shaped = improved(pattern, unknowns, convex=convex, aims=aims, conditions=conditions, allowance=allowance)
        if shaped is None:
            continue
        places = shaped[: pattern.vertices]
        if measures.crossings(pattern, places) or not _are_apart(pattern, shaped):
            continue
        if symmetry is not None:
            places = symmetry.upright(places)
        yield PanelDrawing(places, measures.opened_angles(pattern, places)[0], convex, number)


def _are_apart(pattern: Pattern, unknowns: Floats) -> bool:
    """Check that centres across holes are different from each other and from the vertices."""
    free = pattern.free_centres
    points = unknowns[: pattern.vertices + len(free)]
    least = _APART * np.ptp(unknowns[: pattern.vertices], axis=0).max()
    finite = [pattern.vertices + place for place, pointing in enumerate(free) if not pointing.infinite]
    return all(
        np.linalg.norm(np.delete(points, place, axis=0) - points[place], axis=1).min() >= least for place in finite
    )
