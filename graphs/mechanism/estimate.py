"""How precise a drawing is, estimated from its geometry.

Each relation that a sheet may have been drawn to hold (straight lines, right angles, Kawasaki's theorem, equal
angles and lengths, planes) comes with its deviation, as the displacement of one coordinate that would make it
exact. The deviations of relations that were meant are alike, those of relations that hold by chance are of any
size; so the former are a cluster far below the others. Theory: docs/theory/precision.md.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import log, log2, pi, sqrt
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt
import scipy

from graphs.mechanism.sheet import Sheet
from graphs.tolerances import DOUBLE, EPSILON
from graphs.types import Floats

Numbers = npt.NDArray[np.int64]
Rows: TypeAlias = "scipy.sparse.csr_array | Floats"
"""A matrix, sparse or dense."""

OF_45 = "multiples of 45 degrees"
_EIGHTH = pi / 4
_FINE = np.radians([15.0, 22.5, 30.0])
"""Angles that drawings have between multiples of 45 degrees: parts of 90 degrees by six, and by four."""
_LONGEST_RUN = 6
"""So many neighbouring corners make up an angle, at most."""
_BENT = 0.3
"""A panel that is planar by no more than chance is off its plane by this part of its size."""
_MOST_CREASES = 32
"""Alternating sums are taken of vertices of no more creases."""
_DENSE = 30_000
"""Matrices of so many entries, zeros included, are dense."""


class Relations(NamedTuple):
    """Relations of one kind: how far each is off, and how far off one would be by chance at most.

    Both are displacements of a coordinate, in units of the extent; by chance all up to `reach` are alike. A row of
    `between` has entries at the three coordinates of each vertex that the relation is between.
    """

    kind: str
    off: Floats
    reach: Floats
    between: Rows


class _Runs(NamedTuple):
    """Sums of neighbouring corners at a vertex: which, and how much, radians."""

    rows: Rows
    sums: Floats


@dataclass(frozen=True)
class Corners:
    """The corners of the faces of a sheet: angles between a side and the next, and where they are.

    The points, float[n, 3], are in units of the extent.
    """

    sheet: Sheet
    points: Floats

    @cached_property
    def _listed(self) -> tuple[Numbers, Numbers, Numbers, Numbers]:
        """Of each corner its vertex, the one after and before it in the face, and the number of the face."""
        faces = self.sheet.faces
        apex = np.array([v for face in faces for v in face], dtype=np.int64)
        after = np.array([v for face in faces for v in (*face[1:], face[0])], dtype=np.int64)
        before = np.array([v for face in faces for v in (face[-1], *face[:-1])], dtype=np.int64)
        number = np.repeat(np.arange(len(faces)), [len(face) for face in faces])
        return apex, after, before, number

    @property
    def apex(self) -> Numbers:
        """The vertex of each corner."""
        return self._listed[0]

    @cached_property
    def sides(self) -> Numbers:
        """How many sides the face of each corner has."""
        number = self._listed[3]
        return np.bincount(number)[number]

    @cached_property
    def after_in_face(self) -> Numbers:
        """The next corner of the same face."""
        number = self._listed[3]
        following = np.arange(1, len(number) + 1)
        starts = np.searchsorted(number, number)
        ends = np.searchsorted(number, number, side="right")
        return np.where(following == ends, starts, following)

    def _at(self, vertex: Numbers, after: Numbers) -> Numbers:
        """Return the corner at each vertex whose first side goes to another; -1 where there is none."""
        many = len(self.points)
        keys = self.apex * many + self._listed[1]
        order = np.argsort(keys, kind="stable")
        sought = vertex * many + after
        place = np.minimum(np.searchsorted(keys[order], sought), len(order) - 1)
        corner = order[place]
        return np.where(keys[corner] == sought, corner, -1)

    @cached_property
    def following(self) -> Numbers:
        """The next corner round the vertex, -1 at the border."""
        return self._at(self.apex, self._listed[2])

    @cached_property
    def across(self) -> Numbers:
        """The corner at the other end of the first side, in the face beyond it; -1 at the border."""
        return self._at(self._listed[1], self.apex)

    @cached_property
    def degree(self) -> Numbers:
        """How many corners the vertex of each has, where they go all round; else 0."""
        many = np.bincount(self.apex, minlength=len(self.points))
        open_ones = np.zeros(len(self.points), dtype=bool)
        open_ones[self.apex[self.following < 0]] = True
        return np.where(open_ones, 0, many)[self.apex]

    @cached_property
    def _turned(self) -> tuple[Floats, Floats, Floats, Floats]:
        """Angles, radians, and how fast the two sides turn with their far ends; lengths of the first sides."""
        apex, after, before, number = self._listed
        out, back = self.points[after] - self.points[apex], self.points[before] - self.points[apex]
        area = np.zeros((len(self.sheet.faces), 3))
        middle = self.points.mean(axis=0)
        np.add.at(area, number, np.cross(self.points[apex] - middle, self.points[after] - middle))
        size = np.linalg.norm(area, axis=1, keepdims=True)
        normal = (area / np.where(size == 0.0, 1.0, size))[number]
        angles = np.arctan2((np.cross(out, back) * normal).sum(axis=1), (out * back).sum(axis=1)) % (2 * pi)
        first, last = (out**2).sum(axis=1), (back**2).sum(axis=1)
        first[first == 0.0], last[last == 0.0] = np.inf, np.inf
        return angles, -np.cross(normal, out) / first[:, None], np.cross(normal, back) / last[:, None], first

    @property
    def angles(self) -> Floats:
        """The angle of each corner, radians, from 0 to a whole turn."""
        return self._turned[0]

    @cached_property
    def runs(self) -> _Runs:
        """The sums of neighbouring corners."""
        return _sums(self)

    @cached_property
    def slopes(self) -> Rows:
        """The derivatives of angles by coordinates: corners by 3 n."""
        apex, after, before, _ = self._listed
        _, first, last, _ = self._turned
        return _derivatives([(after, first), (before, last), (apex, -first - last)], len(self.points))

    def relations(self, kind: str, rows: Rows, off: Floats, reach: float | Floats) -> Relations:
        """Return relations between angles, whose sums rows name, with how far they are off in radians."""
        return _relations(kind, rows @ self.slopes, off, reach)

    def lengths_alike(self, beside: Numbers, second: Numbers, whole: npt.NDArray[np.bool_]) -> Relations:
        """Return how nearly a side of a face is as long as the next one, or as the opposite one."""
        apex, after, _, _ = self._listed
        squares = self._turned[3]
        rates = (self.points[after] - self.points[apex]) / squares[:, None]
        slopes = _derivatives([(after, rates), (apex, -rates)], len(self.points))
        own = np.arange(len(beside))
        pairs = np.concatenate([np.stack([own, beside], axis=1), np.stack([own, second], axis=1)[whole]])
        rows = _rows(pairs, np.array([1.0, -1.0]), len(beside))
        logarithms = 0.5 * np.log(squares)[pairs]
        known = np.isfinite(logarithms).all(axis=1)  # others are of sides that have no length
        off = np.full(len(pairs), np.inf)
        off[known] = logarithms[known] @ [1.0, -1.0]
        return _relations("equal lengths", rows @ slopes, off, 1.0)


def nearly_exact(corners: Corners) -> list[Relations]:
    """Return relations that hardly any drawing has nearly and not exactly: lines, right angles, sums, planes."""
    if not len(corners.apex):
        return []
    sheet, points, runs = corners.sheet, corners.points, corners.runs
    turns = np.rint(runs.sums / _EIGHTH)
    off = runs.sums - turns * _EIGHTH
    straight = turns == 4
    found = [
        corners.relations("straight lines", runs.rows[straight], off[straight], _EIGHTH / 2),
        corners.relations(OF_45, runs.rows[~straight], off[~straight], _EIGHTH / 2),
        *_round_vertices(corners),
    ]
    if np.ptp(points[:, 2]) > 0.0:
        found.append(_planes(sheet, points))
    return found


def nearly_fine(corners: Corners) -> Relations:
    """Return angles near multiples of 15 and 22.5 degrees that are none of 45."""
    runs = corners.runs
    rest = runs.sums % _EIGHTH
    off = rest[:, None] - _FINE
    nearest = np.abs(off).argmin(axis=1)
    reach = np.array([11.25, 7.5, 11.25])[nearest]
    picked = off[np.arange(len(off)), nearest]
    return corners.relations("multiples of 15 and 22.5 degrees", runs.rows, picked, np.radians(reach))


def nearly_soft(corners: Corners) -> list[Relations]:
    """Return relations of neighbours that patterns of slowly changing cells have nearly: equals and parallels."""
    beside = corners.after_in_face
    second = beside[beside]
    whole = corners.sides > 3
    pairs = [np.stack([np.arange(len(beside)), beside], axis=1)]
    pairs.append(np.stack([np.arange(len(beside)), second], axis=1)[whole])
    here = np.flatnonzero(corners.following >= 0)
    pairs.append(np.stack([here, corners.following[here]], axis=1))
    across = corners.across
    there = np.flatnonzero(across > np.arange(len(across)))
    pairs.append(np.stack([there, across[there]], axis=1))
    both = np.concatenate(pairs)
    rows = _rows(both, np.array([1.0, -1.0]), len(beside))
    equal = corners.relations("equal angles", rows, rows @ corners.angles, pi / 2)
    sides = np.stack([np.arange(len(beside)), beside], axis=1)[whole]
    rows = _rows(sides, np.array([1.0, 1.0]), len(beside))
    parallel = corners.relations("parallel sides", rows, rows @ corners.angles - pi, pi / 2)
    return [equal, parallel, corners.lengths_alike(beside, second, whole)]


def _matrix(held: Floats, at: Numbers, to: Numbers, shape: tuple[int, int]) -> Rows:
    """Return a matrix with some entries, dense if it is small: a sparse one takes longer to make than to fill."""
    if shape[0] * shape[1] > _DENSE:
        return scipy.sparse.csr_array((held, (at, to)), shape=shape)
    matrix = np.zeros(shape)
    np.add.at(matrix, (at, to), held)
    return matrix


def _derivatives(parts: list[tuple[Numbers, Floats]], many: int) -> Rows:
    """Return derivatives by coordinates, rows by 3 n: of each row by some points, float[rows, 3] each."""
    rows = np.arange(len(parts[0][0]))
    held = np.concatenate([rate.ravel() for _, rate in parts])
    at = np.concatenate([np.repeat(rows, 3) for _ in parts])
    to = np.concatenate([(3 * vertex[:, None] + np.arange(3)).ravel() for vertex, _ in parts])
    return _matrix(held, at, to, (len(rows), 3 * many))


def _rows(columns: Numbers, signs: Floats, width: int) -> Rows:
    """Return rows of a sum each: which corners, int[n, k], with which signs, float[k]."""
    many, each = columns.shape
    at = np.repeat(np.arange(many), each)
    return _matrix(np.tile(signs, many), at, columns.ravel(), (many, width))


def _steepness(slopes: Rows) -> Floats:
    """Return the sizes of rows of derivatives."""
    sizes: Floats = np.sqrt(np.asarray((slopes * slopes).sum(axis=1)).ravel())
    return sizes


def _relations(kind: str, slopes: Rows, off: Floats, reach: float | Floats) -> Relations:
    steep = _steepness(slopes)
    moved = steep > 0.0
    reaches = (reach + np.zeros_like(off))[moved] / steep[moved]
    return Relations(kind, np.abs(off[moved]) / steep[moved], reaches, slopes[np.flatnonzero(moved)])


def _sums(corners: Corners) -> _Runs:
    """Return the sums of one, two, ... neighbouring corners; of the two parts of a whole turn the smaller one."""
    starts = np.arange(len(corners.apex))
    ends, columns, sums, widths = starts, [starts], [], []
    at, to = [], []
    total, rows = corners.angles.copy(), 0
    for run in range(1, _LONGEST_RUN + 1):
        degree = corners.degree[starts]
        # All at the border (degree 0); of the two parts of a whole turn the smaller one, of two halves one.
        kept = (degree == 0) | (2 * run < degree) | ((2 * run == degree) & (starts < corners.following[ends]))
        picked = [column[kept] for column in columns]
        many = int(kept.sum())
        at.append(np.tile(np.arange(rows, rows + many), run))
        to.append(np.concatenate(picked))
        sums.append(total[kept])
        widths.append(many)
        rows += many
        ends = corners.following[ends]
        going = (ends >= 0) & ((degree == 0) | (2 * (run + 1) <= degree))
        if not going.any():
            break
        starts, ends, total = starts[going], ends[going], total[going] + corners.angles[ends[going]]
        columns = [*(column[going] for column in columns), ends]
    ends, of_corners = np.concatenate(at), np.concatenate(to)
    return _Runs(_matrix(np.ones(len(ends)), ends, of_corners, (rows, len(corners.apex))), np.concatenate(sums))


def _round_vertices(corners: Corners) -> Iterator[Relations]:
    """Yield alternating sums at inner vertices, zero if the paper folds flat; of folded ones whole turns too."""
    _, first = np.unique(corners.apex, return_index=True)
    degrees = corners.degree[first]
    folded = bool(np.ptp(corners.points[:, 2]) > 0.0)
    for degree in np.unique(degrees[(degrees >= 3) & (degrees <= _MOST_CREASES)]).tolist():
        here = first[degrees == degree]
        columns = [here]
        for _ in range(degree - 1):
            columns.append(corners.following[columns[-1]])
        whole = np.stack(columns, axis=1)
        if degree % 2 == 0 and degree > 2:
            rows = _rows(whole, np.resize([1.0, -1.0], degree), len(corners.apex))
            yield corners.relations("Kawasaki's sums", rows, rows @ corners.angles, 1.0)
        if folded:
            rows = _rows(whole, np.ones(degree), len(corners.apex))
            yield corners.relations("whole turns of paper", rows, rows @ corners.angles - 2 * pi, 1.0)


def _planes(sheet: Sheet, points: Floats) -> Relations:
    """Return how nearly four vertices of a panel in turn lie in one plane."""
    fours = [
        (face[k], *(face[(k + step) % len(face)] for step in (1, 2, 3)))
        for face in sheet.faces
        if len(face) > 3
        for k in range(1 if len(face) == 4 else len(face))
    ]
    if not fours:
        return Relations("planar panels", np.zeros(0), np.zeros(0), scipy.sparse.csr_array((0, points.size)))
    around = np.array(fours, dtype=np.int64).T
    a, b, c, d = points[around]
    volume = (np.cross(b - a, c - a) * (d - a)).sum(axis=1)
    areas = [np.cross(d - b, c - b), np.cross(c - a, d - a), np.cross(d - a, b - a), np.cross(b - a, c - a)]
    slopes = _derivatives(list(zip(around, areas, strict=True)), len(points))
    size = (np.linalg.norm(c - a, axis=1) + np.linalg.norm(d - b, axis=1)) / 2.0
    return _relations("planar panels", slopes, volume, _BENT * size * _steepness(slopes))


_WIDE = 16.0
"""The deviations of a cluster are looked for between a largest one and this part of it."""
_LEAST = 4
"""Of fewer relations nothing is estimated."""
_LEAST_SOFT = 12
"""Of fewer equal angles and lengths neither: a search for coordinates ends near them."""
_BY_CHANCE = 0.05
"""No more of a cluster may be expected by chance, as part of its size,"""
_BY_CHANCE_SOFT = 0.01
"""of relations that neighbours may have nearly on purpose, fewer still,"""
_UNLIKELY = log(1e6)
"""and it is as unlikely by chance as this, at least."""
_SHARE = 0.15
"""A cluster above what is exact is this part of both, at least."""
_TOP = 4.0
"""Largest deviation of a cluster, in root mean squares."""
_BULK = 2.0
"""So many root mean squares hold most errors."""
_ROUNDS = 30
_ALIKE = 0.7
"""Errors differ: a quarter of them is a third of another quarter. Angles of a curve are all off by the same."""
_SMALL, _FEW = 8.0, 0.02
"""A tenth of errors is smaller than this part of their root mean square: less than a fiftieth if they are none."""
_ENOUGH, _MANY = 8, 60
"""So many deviations show whether they differ, and whether some are small."""
_FIGURES = 3
"""More figures of an estimate would be those of rounding."""
_COARSEST = 3e-3
"""As a precision of drawings nothing coarser is estimated, in units of the extent."""


@dataclass(frozen=True, slots=True)
class Estimate:
    """An estimated precision.

    ``size`` is the error of a coordinate, in units of the extent, to which a number of ``relations`` hold, of
    ``kinds``, the most frequent first; ``by_chance`` is how many would hold by chance. ``margin`` is how many
    times the largest deviation of them the next larger one is; None if there is none.
    """

    size: float
    relations: int
    kinds: tuple[str, ...]
    by_chance: float
    margin: float | None

    def __str__(self) -> str:
        named = ", ".join(self.kinds[:2])
        return f"{self.relations} relations ({named}) hold to {self.size:.0e}, {self.by_chance:.1g} by chance"


def estimate_of(sheet: Sheet) -> Estimate | None:
    """Return how precise the coordinates of a sheet are by its geometry; None where nothing can be estimated."""
    if sheet.coordinates is None or not sheet.faces:
        return None
    points = np.zeros((len(sheet.coordinates), 3))
    points[:, : len(sheet.coordinates[0])] = sheet.coordinates
    points -= points.mean(axis=0)
    extent = float(np.abs(points).max())
    if extent == 0.0:
        return None
    points /= extent
    corners = Corners(sheet, points)
    exact = nearly_exact(corners)
    # Where many angles are near multiples of 45 degrees by chance the others may show a cluster without them.
    found = _estimated(exact) or _estimated([one for one in exact if one.kind != OF_45])
    found = found or _estimated([*exact, nearly_fine(corners)])
    if found is not None and found.size > DOUBLE.closed:
        return found
    soft = _estimated(nearly_soft(corners), _BY_CHANCE_SOFT)
    # A few exact relations, as of the corners of a border, say nothing of the vertices inside.
    few = 0 if found is None else 2 * found.relations
    return found if soft is None or soft.relations < max(_LEAST_SOFT, few) else soft


def _estimated(relations: Sequence[Relations], by_chance: float = _BY_CHANCE) -> Estimate | None:
    """Return what relations say; None if no cluster of them is more than chance.

    Of clusters above what is exact it is the finest that has half as many relations as the largest: of a finer one
    it may be the tail, and a coarser one may hold what is nearly so on purpose.
    """
    off = np.concatenate([one.off for one in relations]) if relations else np.zeros(0)
    if len(off) < _LEAST:
        return None
    density = float((1.0 / np.concatenate([one.reach for one in relations])).sum())
    clusters = {_settled(off, top) for top in _tops(np.sort(off), density)}
    meant = {rms: _held(off, rms) for rms in sorted(clusters) if _is_meant(off, rms, density, by_chance)}
    above = [rms for rms in meant if sqrt(3.0) * rms > DOUBLE.closed]
    most = max((len(meant[rms]) for rms in above), default=0)
    chosen = next((rms for rms in above if 2 * len(meant[rms]) >= most), None)
    if chosen is not None and _of_one_vertex(relations, off, chosen):
        chosen = None
    if chosen is None:
        chosen = next((rms for rms in meant if rms not in above), None)
    return None if chosen is None else _described(relations, off, chosen, density)


def _of_one_vertex(relations: Sequence[Relations], off: Floats, rms: float) -> bool:
    """Return whether what is not exact is so for one vertex: that is off, and not the drawing imprecise."""
    exact = sqrt(3.0) * off <= DOUBLE.closed
    wrong = (off <= _TOP * rms) & ~exact
    if exact.sum() < _SHARE * wrong.sum():
        return False
    parts = [scipy.sparse.csr_array(one.between) for one in relations]
    between = scipy.sparse.vstack(parts).tocsr()[np.flatnonzero(wrong)]
    rows, columns = between.nonzero()
    pairs = np.unique(np.stack([rows, columns // 3]), axis=1)
    often = np.bincount(pairs[1])
    return bool(often.max(initial=0) == wrong.sum())


def _held(off: Floats, rms: float) -> Floats:
    """Return the deviations of a cluster that are neither far above it nor exact."""
    held: Floats = off[(off <= _TOP * rms) & (off > rms / _WIDE)]
    return held


def _is_meant(off: Floats, rms: float, density: float, by_chance: float) -> bool:
    """Return whether a cluster is no chance, no coarser than drawings are, and as uneven as errors are."""
    if sqrt(3.0) * rms > _COARSEST or _BULK * rms * density > by_chance * int((off <= _BULK * rms).sum()):
        return False
    held = _held(off, rms)
    if len(held) < _ENOUGH or rms <= _SMALL**2 * DOUBLE.closed:
        return True
    low, high = np.quantile(held, [0.25, 0.75])
    if low > _ALIKE * high:
        return False
    small = int(((off <= rms / _SMALL) & (off > max(rms / _SMALL**2, DOUBLE.closed))).sum())
    return len(held) < _MANY or small >= _FEW * len(held)


def _tops(off: Floats, density: float) -> list[float]:
    """Return largest deviations of clusters that are more than chance, the finest first; deviations are sorted."""
    powers = np.arange(int(log2(EPSILON)) - 4, -3)
    tops = np.exp2(powers.astype(float))
    below = np.searchsorted(off, tops, side="right")
    within = below - np.searchsorted(off, tops / _WIDE, side="right")
    chance = tops * density
    within[0] = below[0]  # all that is exact
    # Minus the logarithm of the chance of so many, by the bound of Chernoff for a Poisson distribution.
    unlikely = within * np.log(np.maximum(within, 1) / chance) - within + chance
    good = (within >= _LEAST) & (chance <= _BY_CHANCE * within) & (unlikely >= _UNLIKELY) & (within >= _SHARE * below)
    return [float(top) for top in tops[good]]


def _settled(off: Floats, top: float) -> float:
    """Return the root mean square of the errors in a cluster: of those that are neither far above nor exact."""
    rms = top
    for _ in range(_ROUNDS):
        held = _held(off, rms)
        now = float(np.sqrt((held**2).mean())) if len(held) else 0.0
        if now == rms or not now:
            break
        rms = now
    return max(rms, EPSILON)


def _described(relations: Sequence[Relations], off: Floats, rms: float, density: float) -> Estimate:
    top = _TOP * rms
    numbers = {one.kind: 0 for one in relations}
    for one in relations:
        numbers[one.kind] += int((one.off <= top).sum())
    kinds = sorted((kind for kind, number in numbers.items() if number), key=lambda kind: -numbers[kind])
    above, held = off[off > top], off[off <= top]
    largest = float(held.max(initial=0.0))
    margin = float(above.min()) / max(largest, EPSILON) if len(above) else None
    size, by_chance = (float(f"{number:.{_FIGURES}g}") for number in (sqrt(3.0) * rms, top * density))
    margin = None if margin is None else float(f"{margin:.{_FIGURES}g}")
    return Estimate(size, sum(numbers.values()), tuple(kinds), by_chance, margin)
