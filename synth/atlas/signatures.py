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

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError
from graphs.tolerances import DOUBLE, MARGIN
from graphs.types import Floats, Ints

CIRCUIT, ROUND, SPANS = 16, 24, (3, 6)
"""Numbers of a circuit; places round it, and numbers of places from each to those to which it has angles."""
_PLACES = 2 * ROUND
"""Places of a circuit whose angles are taken for Fourier coefficients."""
_PHASES, _LADDER, _PART = 8, 48, 3.05
"""Phases in which an arc is laid on the places of a circuit; lengths of circuits that are tried, for each factor of 2;
the longest circuit in which an arc is looked for, in lengths of the arc."""
_HARMONICS = {24: (0, 2, 4), 12: (0, 1, 2, 3), 6: (0, 1, 2, 3), 18: (0, 1, 2, 3)}
"""Fourier coefficients that are kept, for each distance in places; odd ones of half a circuit vanish."""
_SHORTEST = 1e-2
"""A motion of fewer radians has no signature: the links hardly move against each other."""
_SLACK = 2e-3
"""More than running sums in single precision are off, as a distance."""
FAR = np.float32(1e3)
"""The numbers of a motion that has no signature: it is far from all others."""

FEW = 12
"""Rows below which they are single orientations or points, and chords the parameter of a spline through them."""
_COMPARED, _SHIFTS = 24, 8
"""Places of a motion that are compared with another; shifts of the other between two of them."""
_AT_ONCE, _EVEN, _DAMPED, _NUDGE = 32, 256, 0.01, 3e-4
"""Circuits that are compared with single orientations at once; places round each that are joined by cubics; damping
of least squares at first; parts of a circuit by which differences are taken."""


class Effort(NamedTuple):
    """How hard places for single orientations are looked for, in each direction of travel round a circuit.

    Places of which some are chosen, choices that are kept, those of them that are refined, and with how many steps;
    the best quarter of these is refined by twice as many steps again.
    """

    places: int
    choices: int
    starts: int
    steps: int


QUICK, THOROUGH = Effort(36, 128, 8, 5), Effort(54, 256, 24, 8)


class Signatures(NamedTuple):
    """Numbers of circuits, float32[n, 16], and ratios of angles to arc lengths round them, float32[n, 24, 2]."""

    circuits: npt.NDArray[np.float32]
    spans: npt.NDArray[np.float32]


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
    around = _Around(rows)
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


class _Around:
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
    def of(cls, rows: Floats, *, closed: bool | None = None) -> MotionCurve:
        """Return the curve through rotations, float[n, 4], or points of a sphere, float[n, 3], of any lengths.

        Equal rows that follow each other are one. Without `closed` the curve is a circuit if its last row is its
        first one again. InvariantError if there are fewer than three different rows, or one of them is zero.
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
        vectors = vectors[~again]
        ends_meet = len(vectors) > 1 and bool(angles_between(vectors[0], vectors[-1]) <= DOUBLE.same_configuration)
        whole = ends_meet if closed is None else closed
        if whole and ends_meet:
            vectors = vectors[:-1]
        if len(vectors) < 3:
            raise InvariantError("motion", f"{len(vectors)} different rows", "3 or more")
        return cls(vectors, whole, *_by_arc_length(vectors, closed=whole))

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


def _by_arc_length(rows: Floats, *, closed: bool) -> tuple[tuple[Floats, Floats], object, float]:
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
    knots = _knots(vectors, closed=closed)
    spline = CubicSpline(knots, vectors, bc_type="periodic" if closed else "not-a-knot")
    end = knots[len(rows) if closed else -1]
    fine = np.linspace(0.0, end, max(4096, 8 * len(rows)) + 1)
    middle = (fine[:-1] + fine[1:]) / 2.0
    speeds = [np.linalg.norm(spline(at, 1) - _radial(spline, at), axis=1) for at in (fine[:-1], middle, fine[1:])]
    arcs = (speeds[0] + 4.0 * speeds[1] + speeds[2]) * np.diff(fine) / 6.0 * (2.0 if rows.shape[1] == 4 else 1.0)
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


def _radial(spline: object, at: Floats) -> Floats:
    """Return the part of derivatives along the vectors themselves, which turns nothing."""
    vectors, rates = spline(at), spline(at, 1)  # type: ignore[operator]
    return np.asarray(vectors * (vectors * rates).sum(axis=1, keepdims=True) / (vectors**2).sum(axis=1, keepdims=True))


def difference(motion: MotionCurve, circuit: MotionCurve) -> float:
    """Return by how much a motion differs from the best arc of a circuit: radians, root mean square.

    What is compared are angles between all pairs of 24 places of the motion, equally far apart, with those of an arc
    of the same length, which begins anywhere and goes either way; a circuit is compared with the whole of another.
    It is infinite if the circuit is shorter than the motion, by more than a hundredth.

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

    if motion.length > 1.01 * circuit.length:
        return float("inf")
    whole = motion.closed and circuit.closed
    places = np.arange(_COMPARED) / (_COMPARED if whole else _COMPARED - 1)
    one, other = np.triu_indices(_COMPARED, 1)
    mine = motion.at(motion.length * places)
    wanted = angles_between(mine[one], mine[other])
    reach = circuit.length if whole else min(motion.length, circuit.length)
    free = circuit.length if circuit.closed else circuit.length - reach

    def off(begin: Floats, way: float) -> Floats:
        at = circuit.at(begin[:, None] + way * reach * places)
        return np.asarray(np.sqrt(((angles_between(at[:, one], at[:, other]) - wanted) ** 2).mean(axis=1)))

    count = _COMPARED * _SHIFTS
    gap = free / count
    best = np.inf
    for way in (1.0, -1.0):
        begin = gap * np.arange(count + 1) + (0.0 if way > 0.0 or circuit.closed else reach)
        coarse = off(np.asarray(begin, dtype=float), way)
        start = float(begin[int(coarse.argmin())])
        refined = minimize_scalar(
            lambda at, way=way: float(off(np.array([at]), way)[0]),
            bounds=(start - gap, start + gap), method="bounded", options={"xatol": 1e-9 * circuit.length},
        ) if gap > 0.0 else None  # fmt: skip
        best = min(best, float(coarse.min()), np.inf if refined is None else float(refined.fun))
    return float(best)


def differences_in_order(circuits: Floats, rows: Floats, effort: Effort = THOROUGH) -> tuple[Floats, Floats]:
    """Return by how much circuits miss single orientations or points in order, and where they come nearest to these.

    Compared are the angles between all pairs of `rows`, float[k, d], k at least 3, and those between k places that
    follow each other within one round of a circuit, either way: frames of reference have no meaning. Choices among
    places of equal distances are refined by least squares; a nearer choice may be missed. Circuits, float[n, M, d],
    are as for `signatures_of`. The differences, float[n], are root mean squares in radians, the places, float[n, k],
    parts of the circuits.

    Examples
    --------
    >>> turn = np.linspace(0, 2 * np.pi, 256, endpoint=False)
    >>> path = np.stack([np.cos(turn), np.sin(turn), 0.5 * np.cos(2 * turn)], axis=1)
    >>> path /= np.linalg.norm(path, axis=1)[:, None]
    >>> circle = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)
    >>> off, _ = differences_in_order(np.stack([circle, path]), path[[200, 130, 100, 40, 10]][:, [1, 2, 0]])
    >>> bool(off[1] < 1e-6 < 0.1 < off[0])
    True
    """
    wanted = angles_between(rows[:, None], rows[None])
    count = len(wanted)
    widest = [min(wanted[i, i - 1], wanted[i, i - 2], wanted[i - 1, i - 2]) for i in range(count)]
    first = int(np.argmax(np.round(widest, 6))) - 2  # the first three, which are chosen together, are far apart
    order = np.arange(first, first + count) % count
    wanted = wanted[np.ix_(order, order)]
    found = []
    for begin in range(0, len(circuits), _AT_ONCE):
        evenly = _Evenly(circuits[begin : begin + _AT_ONCE])
        parts = np.concatenate([way * _choices(evenly, wanted, way, effort) for way in (1, -1)], axis=1)
        ways = np.broadcast_to(np.repeat([1.0, -1.0], effort.starts), parts.shape[:2])
        for steps, kept in ((effort.steps, max(1, effort.starts // 4)), (2 * effort.steps, 1)):
            off, parts = _refined(evenly, parts, ways, wanted, steps)
            best = np.argsort(off, axis=1, kind="stable")[:, :kept]
            parts, ways = np.take_along_axis(parts, best[..., None], axis=1), np.take_along_axis(ways, best, axis=1)
        found.append((off.min(axis=1), parts[:, 0]))
    off, places = (np.concatenate(some) for some in zip(*found, strict=True))
    return off, np.remainder(places[:, np.argsort(order)], 1.0)


class _Evenly:
    """Circuits at places of equal distances, read between these by cubics: faster than by `_Around`."""

    def __init__(self, circuits: Floats) -> None:
        at = _Around(circuits).at(np.broadcast_to(np.arange(-1, _EVEN + 2) / _EVEN, (len(circuits), _EVEN + 3)))
        if at.shape[2] == 4:  # of two quaternions of a rotation the nearer one
            dots = (at[:, 1:] * at[:, :-1]).sum(axis=2)
            at[:, 1:] *= np.cumprod(np.where(dots < 0.0, -1.0, 1.0), axis=1)[..., None]
        self._rows, self.count = at, len(circuits)

    def at(self, parts: Floats) -> Floats:
        """Return unit vectors at parts of the lengths, float[n, ..., d]."""
        along = np.remainder(parts, 1.0) * _EVEN
        place = np.minimum(along.astype(np.int64), _EVEN - 1)
        t = along - place
        a, b, c = t + 1.0, t - 1.0, t - 2.0
        who = np.arange(self.count).reshape(-1, *(1,) * (parts.ndim - 1))
        total = np.zeros((*parts.shape, self._rows.shape[2]))
        for node, weight in enumerate((-t * b * c / 6.0, a * b * c / 2.0, -a * t * c / 2.0, a * t * b / 6.0)):
            total += weight[..., None] * self._rows[who, place + node]
        return np.asarray(total / np.linalg.norm(total, axis=-1, keepdims=True))


def _choices(evenly: _Evenly, wanted: Floats, way: int, effort: Effort) -> Floats:
    """Return choices of places in one direction that miss angles float[k, k] least: parts of circuits float[n, S, k].

    Three places are chosen together, from all, then one after the other; the least sums of squares are kept.
    """
    circuits, size, count = evenly.count, effort.places, len(wanted)
    at = evenly.at(np.broadcast_to(way * np.arange(size) / size, (circuits, size)))
    table = angles_between(at[:, :, None], at[:, None]).astype(np.float32)
    squares = {pair: (table - np.float32(wanted[pair])) ** 2 for pair in combinations(range(count), 2)}
    later = np.array(np.triu_indices(size))  # how far the second and third place are after the first
    first = np.repeat(np.arange(size), later.shape[1])
    second, third = ((first + np.tile(each, size)) % size for each in later)
    sums = np.zeros((circuits, len(first)), np.float32)
    three = (first, second, third)
    for one, other in combinations(range(3), 2):
        sums += np.take(squares[one, other].reshape(circuits, -1), three[one] * size + three[other], axis=1)
    who = np.arange(circuits)[:, None]
    kept = np.argpartition(sums, effort.choices, axis=1)[:, : effort.choices]
    sums, places = sums[who, kept], np.stack(three, axis=1)[kept]
    for number in range(3, count):
        more = np.repeat(sums[:, :, None], size, axis=2)
        for before in range(number):
            more += squares[before, number][who, places[:, :, before]]
        offset = (np.arange(size) - places[:, :, :1]) % size
        more[offset < offset[who, np.arange(effort.choices), places[:, :, -1]][:, :, None]] = np.inf
        more = more.reshape(circuits, -1)
        kept = np.argpartition(more, effort.choices, axis=1)[:, : effort.choices]
        sums = more[who, kept]
        places = np.concatenate([places[who, kept // size], (kept % size)[:, :, None]], axis=2)
    return _apart(sums, places, effort)


def _apart(sums: npt.NDArray[np.float32], places: Ints, effort: Effort) -> Floats:
    """Return the best choices that differ by two places or more, as parts of circuits that never decrease."""
    size, who, chosen = effort.places, np.arange(len(sums)), []
    for _ in range(effort.starts):
        chosen.append(places[who, sums.argmin(axis=1)])
        gap = np.abs((places - chosen[-1][:, None] + size // 2) % size - size // 2).max(axis=2)
        sums = np.where(gap < 2, np.inf, sums)
    starts = np.stack(chosen, axis=1)
    offsets = (starts - starts[:, :, :1]) % size
    spread = 0.5 * np.arange(starts.shape[2]) / starts.shape[2]  # equal places are no start for least squares
    return np.asarray((starts[:, :, :1] + offsets + spread) / size)


def _refined(evenly: _Evenly, parts: Floats, ways: Floats, wanted: Floats, steps: int) -> tuple[Floats, Floats]:
    """Return how much parts of circuits, float[n, B, k], miss angles float[k, k] once they are refined, and the parts.

    The method is that of Levenberg and Marquardt; parts keep their order, each in its way, float[n, B].
    """
    at, way = evenly.at, ways[..., None]
    one, other = np.triu_indices(len(wanted), 1)
    angles, pairs = wanted[one, other], np.arange(len(one))

    def misses(some: Floats, others: Floats) -> Floats:
        return angles_between(some[:, :, one], others[:, :, other]) - angles

    here = at(parts)
    miss = misses(here, here)
    damping, nudge = np.full(parts.shape[:2], _DAMPED), _NUDGE * way
    for _ in range(steps):
        behind, ahead = at(parts - nudge), at(parts + nudge)  # of two equal places neither may overtake the other
        rates = np.zeros((*parts.shape[:2], len(pairs), parts.shape[2]))
        rates[:, :, pairs, one] = (miss - misses(behind, here)) / nudge
        rates[:, :, pairs, other] = (misses(here, ahead) - miss) / nudge
        gram = np.swapaxes(rates, 2, 3) @ rates
        sizes = np.einsum("...ii->...i", gram)
        damped = damping[..., None] * sizes + DOUBLE.clear * sizes.sum(axis=2, keepdims=True)
        gram += np.eye(len(wanted)) * damped[..., None]
        step = np.linalg.solve(gram, np.swapaxes(rates, 2, 3) @ miss[..., None])[..., 0]
        along = np.maximum.accumulate(way * (parts - step), axis=2)
        trial = way * np.minimum(along, along[:, :, :1] + 1.0)
        there = at(trial)
        off = misses(there, there)
        better = (off**2).sum(axis=2) < (miss**2).sum(axis=2)
        parts, miss = (np.where(better[..., None], *pair) for pair in ((trial, parts), (off, miss)))
        here = np.where(better[..., None, None], there, here)
        damping = np.where(better, damping / 5.0, damping * 5.0)
    return np.sqrt((miss**2).mean(axis=2)), parts


class ArcGoal(NamedTuple):
    """An arc laid on circuits of lengths from `least` to `most`: ratios float[Q, m], of places and spans int[m, 2]."""

    least: float
    most: float
    numbers: Floats
    places: Ints


def arc_distances(signatures: Signatures, goals: Sequence[ArcGoal], limit: float = np.inf) -> Floats:
    """Return how far each circuit, in its nearest place, is from holding an arc: root mean square, float[n].

    Circuits that are farther than a limit may have infinity instead: means and spreads along the arc prove it.
    """
    lengths = signatures.circuits[:, 0] * 4.0 * np.pi
    order = np.argsort(lengths)
    ordered, found = lengths[order], np.full(len(lengths), np.inf)
    for goal in goals:
        who = order[np.searchsorted(ordered, goal.least) : np.searchsorted(ordered, goal.most)]
        spans = signatures.spans[who]
        if limit < np.inf:
            near = np.flatnonzero(_least_distances(spans, goal) <= limit + _SLACK)
            who, spans = who[near], spans[near]
        if not len(who):
            continue
        place, column = goal.places.T
        there = spans[:, (np.arange(ROUND)[:, None] + place) % ROUND, column]
        misses = nearest(there.reshape(-1, len(place)), goal.numbers).reshape(len(who), ROUND)
        found[who] = misses.min(axis=1) / np.sqrt(len(place))
    return found


def _least_distances(spans: npt.NDArray[np.float32], goal: ArcGoal) -> Floats:
    """Return what an arc is at least off each circuit, from spans float32[n, 24, 2]: float[n].

    Of numbers x and y let a and b be the means, s and t the distances from these: |x - y|^2 is n (a - b)^2 plus the
    square of a distance between vectors of the lengths s and t, so at least n (a - b)^2 + (s - t)^2. Both are those
    of windows round the circuit, sums of which are differences of running sums; of all phases of the arc the
    nearest a and s are taken, each by itself.
    """
    if not len(spans):
        return np.zeros(0)
    squares = np.zeros((len(spans), ROUND), np.float32)
    places = np.arange(ROUND)
    for column in range(len(SPANS)):
        own = goal.places[:, 1] == column
        count = int(own.sum())
        if not count:
            continue
        wanted = goal.numbers[:, own]
        middle = np.float32(wanted.mean())  # near it squares keep their digits
        means = wanted.mean(axis=1)
        spreads = np.linalg.norm(wanted - means[:, None], axis=1)
        window = ((places[:, None] - places) % ROUND < count).astype(np.float32) / np.float32(np.sqrt(count))
        here = spans[:, :, column] - middle
        mean = here @ window  # times the root of the count
        here *= here
        spread = here @ (window * np.float32(np.sqrt(count)))
        spread -= mean * mean
        np.sqrt(np.maximum(spread, 0.0, out=spread), out=spread)
        for numbers, off in ((mean, (means - middle) * np.sqrt(count)), (spread, spreads)):
            beyond = numbers - np.clip(numbers, np.float32(off.min()), np.float32(off.max()))
            squares += beyond * beyond
    return np.asarray(np.sqrt(squares.min(axis=1) / len(goal.places)))


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
