"""Motion signatures: 64 numbers of the relative motion of two links, and the exact comparison of two motions.

A motion is a curve R(s) of rotations of one link in the frame of another, s its arc length (the angle turned
through), or the path p(s) of a point of one link on the sphere of the other. Frames fixed in the two links make A
R(s) B of it, and the angle between R(s) and R(t), that of the rotation R(s)^-1 R(t), is the same for all A and B; so
is that of two points of a path. It is the same too for R^-1, so the order of the links has no meaning, and for the
mirror image. Arc length does away with speed.

A circuit of length L has 16 numbers: L / 4 pi, and magnitudes of Fourier coefficients of f(s) = sin^2 of half the
angle between R(s) and R(s + d), which is smooth, for d of one, two, three and four eighths of L. Where the circuit
begins, and which way it goes, changes phases alone. 48 more are for arcs of it: for each of 24 places the angles to
the places 3 and 6 later, divided by the arc lengths between; the ratio is 1 where the motion turns about one axis.
An arc of which the circuit would have some length L is laid on the 24 places in 8 phases, both ways; of a third of
the circuit that are 8 places, so 5 and 2 angles are compared. Signatures that agree are not yet motions that agree:
candidates are compared by `difference`; with a few single orientations or points, between which nothing is known, by
`differences_in_order`.

Theory: docs/theory/atlas.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError
from graphs.tolerances import DOUBLE, MARGIN
from graphs.types import Floats, Ints

CIRCUIT = 16
"""Numbers of a circuit: its length, and the Fourier coefficients of `_HARMONICS`."""
ROUND = 24
"""Places round a circuit: an arc of a third of it has eight, enough to tell arcs apart."""
SPANS = (3, 6)
"""Numbers of places from each to those to which it has angles: an eighth and a quarter of a circuit."""
_PLACES = 2 * ROUND
"""Places of a circuit whose angles are taken for Fourier coefficients: many more than those that are kept."""
_PHASES = 8
"""Phases in which an arc is laid on the places of a circuit: where it begins is not known."""
_LADDER = 48
"""Lengths of circuits that are tried, for each factor of 2: the next one is longer by 1.5 per cent."""
_PART = 3.05
"""The longest circuit in which an arc is looked for, in lengths of the arc: three, and a margin."""
_HARMONICS = {24: (0, 2, 4), 12: (0, 1, 2, 3), 6: (0, 1, 2, 3), 18: (0, 1, 2, 3)}
"""Fourier coefficients that are kept, for each distance in places; odd ones of half a circuit vanish."""
_SHORTEST = 1e-2
"""A motion of fewer radians has no signature: the links hardly move against each other."""
_SLACK = 2e-3
"""More than sums and products in single precision are off, as a distance."""
FAR = np.float32(1e3)
"""The numbers of a motion that has no signature: it is far from all others."""

FEW = 12
"""Rows below which they are single orientations or points, and chords the parameter of a spline through them."""
COMPARED = 24
"""Places of a motion that are compared with another: chords between them are a few degrees long."""
_SHIFTS = 8
"""Shifts of the other motion between two of them, from which the best one is found."""


class Signatures(NamedTuple):
    """Numbers of circuits, float32[n, 16], and ratios of angles to arc lengths round them, float32[n, 24, 2]."""

    circuits: npt.NDArray[np.float32]
    spans: npt.NDArray[np.float32]


NO_SPANS = np.zeros((0, ROUND, len(SPANS)), np.float32)


def joined(arrays: Sequence[Signatures], memory: list[npt.NDArray[np.float32]]) -> Signatures:
    """Return the signatures of units as one, in memory that is used again."""
    joined = []
    for number, parts in enumerate(zip(*arrays, strict=True)):
        size = sum(map(len, parts))
        if size > len(memory[number]):
            memory[number] = np.empty((size + size // 4, *parts[0].shape[1:]), np.float32)
        joined.append(np.concatenate(parts, out=memory[number][:size]))
    return Signatures(*joined)


def angles_between(first: Floats, second: Floats) -> Floats:
    """Return the angles between rotations, float[..., 4], or unit vectors, float[..., 3], radians."""
    gap, whole = first - second, 2.0
    square = np.einsum("...i,...i->...", gap, gap)
    if first.shape[-1] == 4:
        gap, whole = first + second, 4.0
        square = np.minimum(square, np.einsum("...i,...i->...", gap, gap))
    return np.asarray(whole * np.arcsin(np.minimum(np.sqrt(square) / 2.0, 1.0)))


def signatures_of(rows: Floats) -> Signatures:
    """Return the signatures of circuits by frames: unit quaternions float[n, M, 4], or points float[n, M, 3].

    Frames are equally far apart by any smooth parameter, 24 or more, and the last one is not the first one again.

    Examples
    --------
    >>> turn = np.linspace(0, 2 * np.pi, 256, endpoint=False)
    >>> about_z = np.stack([np.cos(turn / 2), 0 * turn, 0 * turn, np.sin(turn / 2)], axis=1)
    >>> numbers = signatures_of(about_z[None]).circuits[0]
    >>> numbers[:2].round(4).tolist()  # half a turn, and at half the circuit the angle 180 degrees
    [0.5, 1.0]
    """
    around = Around(rows)
    moving = around.lengths >= _SHORTEST
    lengths = np.where(moving, around.lengths, 1.0)
    at = around.at(np.broadcast_to(np.arange(_PLACES) / _PLACES, (len(lengths), _PLACES)))
    circuits = _circuit_numbers(lengths, at)
    coarse = at[:, :: _PLACES // ROUND]
    turns = [angles_between(coarse, np.roll(coarse, -apart, axis=1)) / apart for apart in SPANS]
    spans = np.stack(turns, axis=-1) * (ROUND / lengths)[:, None, None]
    circuits[~moving], spans[~moving] = FAR, FAR
    return Signatures(circuits.astype(np.float32), spans.astype(np.float32))


def _circuit_numbers(lengths: Floats, at: Floats) -> Floats:
    """Return the numbers of circuits by equidistant places, float[n, 48, d]."""
    columns = [lengths / (4.0 * np.pi)]
    for apart, harmonics in _HARMONICS.items():
        dots = (at * np.roll(at, -apart, axis=1)).sum(axis=-1)
        halves = 1.0 - dots * dots if at.shape[-1] == 4 else (1.0 - dots) / 2.0
        sizes = np.abs(np.fft.rfft(halves, axis=1)) / _PLACES
        columns += [sizes[:, number] * (2.0 if number else 1.0) for number in harmonics]
    return np.stack(columns, axis=1)


class Around:
    """Circuits by frames float[n, M, d], read at parts of their lengths."""

    def __init__(self, rows: Floats) -> None:
        self._rows, self._frames = rows, rows.shape[1]
        derivative = np.zeros_like(rows)
        for apart, factor in ((1, 0.75), (2, -0.15), (3, 1.0 / 60.0)):
            derivative += factor * (self._beside(apart) - self._beside(-apart))
        self._speed = np.linalg.norm(derivative, axis=-1) * (2.0 if rows.shape[-1] == 4 else 1.0)
        before, after = np.roll(self._speed, 1, axis=1), np.roll(self._speed, -1, axis=1)
        later = np.roll(self._speed, -2, axis=1)
        steps = np.maximum((13.0 * (self._speed + after) - before - later) / 24.0, (self._speed + after) / 8.0)
        self._along = np.concatenate([np.zeros((len(rows), 1)), np.cumsum(steps, axis=1)], axis=1)
        self.lengths = self._along[:, -1]

    def _beside(self, apart: int) -> Floats:
        """Return the frames some places on, of two quaternions of a rotation the nearer one."""
        other = np.roll(self._rows, -apart, axis=1)
        if self._rows.shape[-1] == 4:
            other = np.where((other * self._rows).sum(axis=-1, keepdims=True) < 0.0, -other, other)
        return other

    def at(self, parts: Floats) -> Floats:
        """Return unit vectors at parts of the lengths, float[n, P]: by cubics in time, by quintics in place."""
        count = len(parts)
        member = np.arange(count)[:, None]
        scale = np.maximum(self.lengths, DOUBLE.precision)[:, None]
        parts = np.remainder(parts, 1.0)
        knots = (self._along[:, :-1] / scale + member).ravel()
        place = np.searchsorted(knots, (parts + member).ravel(), side="right").reshape(parts.shape)
        place = np.clip(place - 1 - member * self._frames, 0, self._frames - 1)
        after = (place + 1) % self._frames
        low, high = self._along[member, place], self._along[member, place + 1]
        first, last, want = self._speed[member, place], self._speed[member, after], parts * scale
        rise = np.maximum(high - low, DOUBLE.precision)
        time = np.clip((want - low) / rise, 0.0, 1.0)
        for _ in range(3):
            square, cube = time * time, time * time * time
            value = low + rise * (3 * square - 2 * cube) + first * (cube - 2 * square + time) + last * (cube - square)
            slope = 6 * rise * (time - square) + first * (3 * square - 4 * time + 1) + last * (3 * square - 2 * time)
            time = np.clip(time - (value - want) / np.maximum(slope, 0.05 * rise), 0.0, 1.0)
        return self._between(member, place, time)

    def _between(self, member: Ints, place: Ints, time: Floats) -> Floats:
        """Return unit vectors a part of the way from a frame to the next, by polynomials through six frames."""
        nodes = np.arange(-2, 4)
        total = np.zeros((*place.shape, self._rows.shape[-1]))
        middle = self._rows[member, place]
        for node in nodes.tolist():
            others = nodes[nodes != node]
            weight = np.prod([(time - other) / (node - other) for other in others.tolist()], axis=0)
            row = self._rows[member, (place + node) % self._frames]
            if row.shape[-1] == 4:
                weight = weight * np.where((row * middle).sum(axis=-1) < 0.0, -1.0, 1.0)
            total += weight[..., None] * row
        return np.asarray(total / np.linalg.norm(total, axis=-1, keepdims=True))


@dataclass(frozen=True, slots=True, eq=False)
class MotionCurve:
    """A relative motion as a curve by arc length.

    Attributes
    ----------
    rows : float[n, 4] or float[n, 3]
        Unit quaternions, scalar first, of rotations; or unit vectors of the path of a point. Of a circuit the last
        row is not the first one again.
    closed : bool
        Whether it is a circuit.
    """

    rows: Floats
    closed: bool
    _along: tuple[Floats, Floats]
    _spline: object
    _length: float

    @classmethod
    def of(cls, rows: Floats, *, closed: bool | None = None, even: bool = False) -> MotionCurve:
        """Return the curve through rotations, float[n, 4], or points of a sphere, float[n, 3], of any lengths.

        Equal rows that follow each other are one. Without `closed` the curve is a circuit if its last row is its
        first one again. Rows are `even` at equal steps of a smooth parameter; otherwise it is found out whether their
        numbers are one. InvariantError if there are fewer than three different rows, or one of them is zero.
        """
        vectors = np.array(rows, dtype=float)
        if vectors.ndim != 2 or vectors.shape[1] not in (3, 4) or not np.isfinite(vectors).all():
            expected = "finite numbers: n quaternions, scalar first, or n points of a sphere"
            raise InvariantError("motion", f"an array of shape {vectors.shape}", expected)
        sizes = np.linalg.norm(vectors, axis=1)
        if (sizes == 0.0).any():
            raise InvariantError("motion", f"row {int(sizes.argmin()) + 1} is zero", "a rotation or a direction")
        vectors /= sizes[:, None]
        again = np.concatenate([[np.inf], angles_between(vectors[:-1], vectors[1:])]) <= DOUBLE.parallel
        vectors, even = vectors[~again], even and not again.any()
        ends_meet = len(vectors) > 1 and bool(angles_between(vectors[0], vectors[-1]) <= DOUBLE.same_configuration)
        whole = ends_meet if closed is None else closed
        if whole and ends_meet:
            vectors = vectors[:-1]
        if len(vectors) < 3:
            raise InvariantError("motion", f"{len(vectors)} different rows", "3 or more")
        return cls(vectors, whole, *_by_arc_length(vectors, closed=whole, even=even))

    @property
    def length(self) -> float:
        """Arc length, radians."""
        return self._length

    @property
    def rotates(self) -> bool:
        """Whether it is a motion of two links; else it is the path of a point."""
        return bool(self.rows.shape[1] == 4)

    def at(self, along: Floats) -> Floats:
        """Return unit vectors at arc lengths; of a circuit they may be of any size."""
        if self.closed:
            along = np.remainder(along, self._length)
        where = np.clip(along, 0.0, self._length)
        rows = self._spline(np.interp(where, *self._along))  # type: ignore[operator]
        return np.asarray(rows / np.linalg.norm(rows, axis=-1, keepdims=True))

    def circuit_numbers(self) -> Floats:
        """Return the 16 numbers of a circuit."""
        at = self.at(self._length * np.arange(_PLACES) / _PLACES)
        return np.asarray(_circuit_numbers(np.array([self._length]), at[None])[0])

    def goals(self) -> list[ArcGoal]:
        """Return what an arc has in common with circuits of all lengths of which it is a third or more."""
        steps = np.arange(
            np.floor(_LADDER * np.log2(self._length)), np.ceil(_LADDER * np.log2(_PART * self._length)) + 1
        )
        return [self._goal(float(length)) for length in 2.0 ** (steps / _LADDER)]

    def _goal(self, length: float) -> ArcGoal:
        gap = length / ROUND
        count = min(ROUND, int(self._length / gap))  # places that it holds in any phase
        begin = np.linspace(0.0, min(gap, self._length - gap * (count - 1)), _PHASES)
        points = self.at(begin[:, None] + gap * np.arange(count))
        points = np.concatenate([points, points[:, ::-1]])
        numbers, places = [], []
        for column, apart in enumerate(SPANS):
            numbers.append(angles_between(points[:, : count - apart], points[:, apart:]) / (gap * apart))
            places += [(place, column) for place in range(count - apart)]
        half = 0.5 / _LADDER
        return ArcGoal(length * 2.0**-half, length * 2.0**half, np.concatenate(numbers, axis=1), np.array(places))


def _by_arc_length(rows: Floats, *, closed: bool, even: bool) -> tuple[tuple[Floats, Floats], object, float]:
    """Return arc lengths with the parameter there, a spline by that parameter, and the whole length."""
    from scipy.interpolate import CubicSpline

    vectors = rows
    if rows.shape[1] == 4:  # of the two quaternions of a rotation that nearer to the last one
        signs = np.where((rows[1:] * rows[:-1]).sum(axis=1) < 0.0, -1.0, 1.0)
        vectors = rows * np.cumprod(np.concatenate([[1.0], signs]))[:, None]
    if closed:
        if rows.shape[1] == 4 and vectors[-1] @ vectors[0] < 0.0:  # back after two rounds only
            vectors = np.concatenate([vectors, -vectors])
        vectors = np.concatenate([vectors, vectors[:1]])
    knots = np.arange(len(vectors), dtype=float) if even else _knots(vectors, closed=closed)
    spline = CubicSpline(knots, vectors, bc_type="periodic" if closed else "not-a-knot")
    end = knots[len(rows) if closed else -1]
    fine = np.linspace(0.0, end, max(4096, 8 * len(rows)) + 1)
    middle = (fine[:-1] + fine[1:]) / 2.0
    ends, between = (_speeds(spline, at) for at in (fine, middle))
    arcs = (ends[:-1] + 4.0 * between + ends[1:]) * np.diff(fine) / 6.0 * (2.0 if rows.shape[1] == 4 else 1.0)
    along = np.concatenate([[0.0], np.cumsum(arcs)])
    return (along, fine), spline, float(along[-1])


def _knots(vectors: Floats, *, closed: bool) -> Floats:
    """Return the parameter of a spline: numbers of rows, or sums of chords, whichever foretells left-out rows better.

    Frames at equal times are smooth by their numbers, also where the motion stops and turns back, which by chords is
    a corner; rows at any distances are smooth by chords.
    """
    from scipy.interpolate import CubicSpline

    chords = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(vectors, axis=0), axis=1))])
    if len(vectors) < FEW:
        return chords
    kept = np.arange(len(vectors)) % 2 == 0
    kept[-1] = True
    off = []
    for knots in (chords, np.arange(len(vectors), dtype=float)):
        spline = CubicSpline(knots[kept], vectors[kept], bc_type="periodic" if closed else "not-a-knot")
        off.append(float(np.abs(spline(knots[~kept]) - vectors[~kept]).max()))
    return np.arange(len(vectors), dtype=float) if off[1] < (1.0 - MARGIN) * off[0] else chords


def _speeds(spline: object, at: Floats) -> Floats:
    """Return the lengths of derivatives less their parts along the vectors themselves, which turn nothing."""
    vectors, rates = spline(at), spline(at, 1)  # type: ignore[operator]
    along = np.einsum("ni,ni->n", vectors, rates) / np.einsum("ni,ni->n", vectors, vectors)
    return np.asarray(np.linalg.norm(rates - along[:, None] * vectors, axis=1))


def difference(motion: MotionCurve, circuit: MotionCurve) -> float:
    """Return by how much a motion differs from the best arc of a circuit: radians, root mean square.

    What is compared are angles between all pairs of 24 places of the motion, equally far apart, with those of an arc
    of the same length, which begins anywhere and goes either way; a circuit is compared with the whole of another.
    For an arc it is infinite if the circuit is shorter, by more than a hundredth.

    Examples
    --------
    >>> turn = np.linspace(0, 4, 50)
    >>> path = np.stack([np.cos(turn), np.sin(turn), 0.5 * np.cos(2 * turn)], axis=1)
    >>> circle = MotionCurve.of(np.stack([np.cos(turn), np.sin(turn), 0 * turn + 1], axis=1)[:30])
    >>> whole, part = MotionCurve.of(path), MotionCurve.of(path[5:30])
    >>> difference(part, whole) < 1e-5 < 1e-3 < difference(circle, whole)
    True
    """
    from scipy.optimize import minimize_scalar

    whole = motion.closed and circuit.closed
    if not whole and motion.length > 1.01 * circuit.length:
        return float("inf")
    places = np.arange(COMPARED) / (COMPARED if whole else COMPARED - 1)
    one, other = np.triu_indices(COMPARED, 1)
    mine = motion.at(motion.length * places)
    reach = circuit.length if whole else min(motion.length, circuit.length)
    free = circuit.length if circuit.closed else circuit.length - reach
    count = COMPARED * _SHIFTS
    gap, begin = free / count, np.linspace(0.0, free, count + 1)
    at = circuit.at(begin[:, None] + reach * places)
    cosines = np.clip((at @ at.swapaxes(1, 2))[:, one, other], -1.0, 1.0)
    angles = 2.0 * np.arccos(np.abs(cosines)) if circuit.rotates else np.arccos(cosines)
    starts = []
    for way in (1, -1):
        wanted = angles_between(mine[::way][one], mine[::way][other])
        coarse = np.sqrt(((angles - wanted) ** 2).mean(axis=1))
        starts.append((float(coarse.min()), float(begin[coarse.argmin()]), wanted))
    best = np.inf
    for least, start, wanted in sorted(starts, key=lambda each: each[0]):
        if least - 2.0 * gap >= best:  # no angle changes by more than twice the shift
            break

        def square(begin: float, wanted: Floats = wanted) -> float:  # smooth where it is zero
            at = circuit.at(begin + reach * places)
            return float(((angles_between(at[one], at[other]) - wanted) ** 2).mean())

        squares = [square(start)]
        if gap > 0.0:
            options = {"xatol": 1e-9 * circuit.length}
            bounds = (start - gap, start + gap)
            squares.append(minimize_scalar(square, bounds=bounds, method="bounded", options=options).fun)
        best = min(best, float(np.sqrt(min(squares))))
    return float(best)


@dataclass(frozen=True)
class ArcGoal:
    """An arc laid on circuits of lengths from `least` to `most`: ratios float[Q, m], of places and spans int[m, 2]."""

    least: float
    most: float
    numbers: Floats
    places: Ints

    @cached_property
    def middle(self) -> np.float32:
        """Mean of all ratios; differences from it keep their digits."""
        return np.float32(self.numbers.mean())

    @cached_property
    def within(self) -> npt.NDArray[np.bool_]:
        """Which of the 48 ratios round a circuit are of the arc, if it begins at each place: bool[48, 24]."""
        within = np.zeros((ROUND, len(SPANS), ROUND), dtype=bool)
        begin = np.arange(ROUND)[:, None]
        within[(begin + self.places[:, 0]) % ROUND, self.places[:, 1], begin] = True
        return within.reshape(-1, ROUND)

    @cached_property
    def laid(self) -> npt.NDArray[np.float32]:
        """The ratios less their middle where they are then, elsewhere 0: float32[Q * 24, 48]."""
        laid = np.zeros((len(self.numbers), ROUND, ROUND, len(SPANS)), np.float32)
        begin = np.arange(ROUND)[:, None]
        laid[:, begin, (begin + self.places[:, 0]) % ROUND, self.places[:, 1]] = (self.numbers - self.middle)[:, None]
        return laid.reshape(-1, ROUND * len(SPANS))

    @cached_property
    def ranges(self) -> Floats:
        """Middles and halves of the ranges of sums of ratios over the roots of their counts: float[2, spans]."""
        own = [self.numbers[:, self.places[:, 1] == column] for column in range(len(SPANS))]
        sums = np.array([numbers.sum(axis=1) / np.sqrt(numbers.shape[1]) for numbers in own])
        least, most = sums.min(axis=1), sums.max(axis=1)
        return np.stack([(most + least) / 2.0, (most - least) / 2.0])


def arc_distances(signatures: Signatures, goals: Sequence[ArcGoal], limit: float = np.inf) -> Floats:
    """Return how far each circuit, in its nearest place, is from holding an arc: root mean square, float[n].

    Circuits that are farther than a limit may have infinity instead: means along the arc prove it, or products in
    single precision.
    """
    lengths = signatures.circuits[:, 0] * 4.0 * np.pi
    edges = [*(goal.least for goal in goals), goals[-1].most]
    who = np.flatnonzero((lengths >= edges[0]) & (lengths < edges[-1]))
    who = who[np.argsort(lengths[who])]
    ends = np.searchsorted(lengths[who], edges)
    spans, found = signatures.spans.reshape(len(lengths), -1), np.full(len(lengths), np.inf)
    sizes = [len(goal.places) for goal in goals]
    for size in dict.fromkeys(sizes):
        first, last = sizes.index(size), sizes.index(size) + sizes.count(size)  # goals of a size follow each other
        own = who[ends[first] : ends[last]]
        goal_of = np.repeat(np.arange(last - first), np.diff(ends[first : last + 1]))
        found[own] = _distances(spans[own], goals[first:last], goal_of, limit)
    return found


_Ratios = npt.NDArray[np.float32]
"""Ratios of circuits, float32[n, 48]."""


def _distances(spans: _Ratios, goals: Sequence[ArcGoal], goal_of: Ints, limit: float) -> Floats:
    """Return the distances of circuits, each from one of goals of as many places, in the order of goals."""
    found, near = np.full(len(spans), np.inf), np.arange(len(spans))
    if limit < np.inf:
        for bound in (_by_means, _by_products):
            kept = np.flatnonzero(bound(spans, goals, goal_of) <= limit + _SLACK)
            near, spans, goal_of = near[kept], spans[kept], goal_of[kept]
    for goal, rows in _each(goals, goal_of):
        place, column = goal.places.T
        there = spans[rows].reshape(-1, ROUND, len(SPANS))[:, (np.arange(ROUND)[:, None] + place) % ROUND, column]
        misses = nearest(there.reshape(-1, len(place)), goal.numbers).reshape(-1, ROUND)
        found[near[rows]] = misses.min(axis=1) / np.sqrt(len(place))
    return found


def _each(goals: Sequence[ArcGoal], goal_of: Ints) -> Iterator[tuple[ArcGoal, slice]]:
    """Yield the goals of some circuits, and which circuits these are."""
    ends = np.searchsorted(goal_of, np.arange(len(goals) + 1)).tolist()
    for goal, first, last in zip(goals, ends[:-1], ends[1:], strict=True):
        if last > first:
            yield goal, slice(first, last)


def _by_means(spans: _Ratios, goals: Sequence[ArcGoal], goal_of: Ints) -> Floats:
    """Return what arcs are at least off circuits, by the means of their ratios for each span.

    Of n numbers x and y with the means a and b, |x - y|^2 is at least n (a - b)^2. Means are those of windows round the
    circuit; of all phases of the arc the nearest b is taken.
    """
    within = goals[0].within.reshape(ROUND, len(SPANS), 1, ROUND) * np.eye(len(SPANS))[None, :, :, None]
    windows = (within / np.sqrt(within.sum(axis=(0, 1)))).reshape(ROUND * len(SPANS), -1).astype(np.float32)
    middles, halves = np.stack([goal.ranges for goal in goals]).astype(np.float32).transpose(1, 2, 0)[..., goal_of]
    sums = (windows.T @ spans.T).reshape(len(SPANS), ROUND, -1)
    sums -= middles[:, None]
    beyond = np.abs(sums, out=sums)
    beyond -= halves[:, None]
    np.maximum(beyond, 0.0, out=beyond)
    beyond *= beyond
    return np.asarray(np.sqrt(beyond.sum(axis=0).min(axis=0) / len(goals[0].places)))


def _by_products(spans: _Ratios, goals: Sequence[ArcGoal], goal_of: Ints) -> Floats:
    """Return the distances of circuits but for the rounding of |x|^2 - 2 x y + |y|^2 in single precision."""
    squares = np.zeros(len(spans))
    for goal, rows in _each(goals, goal_of):
        shifted = spans[rows] - goal.middle
        mixed = (-2.0 * goal.laid) @ shifted.T
        mixed += (goal.laid * goal.laid).sum(axis=1)[:, None]
        own = goal.within.T.astype(np.float32) @ (shifted * shifted).T
        squares[rows] = (mixed.reshape(-1, ROUND, len(shifted)).min(axis=0) + own).min(axis=0) / len(goal.places)
    return np.sqrt(np.maximum(squares, 0.0))


def nearest(numbers: npt.NDArray[np.float32], goals: Floats) -> Floats:
    """Return the distance of each signature, float32[n, d], to the nearest of some goals, float[Q, d]: float[n]."""
    shifted = numbers - goals[0].astype(np.float32)  # near goals only differences keep their digits
    others = (goals - goals[0]).astype(np.float32)
    squares = (shifted * shifted).sum(axis=1)
    if len(others) > 1:
        mixed = shifted @ others.T
        mixed *= -2.0
        mixed += (others * others).sum(axis=1)
        squares += mixed.min(axis=1)
    return np.asarray(np.sqrt(np.maximum(squares, 0.0)))
