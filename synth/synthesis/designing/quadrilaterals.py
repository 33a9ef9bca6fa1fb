"""Sheets of flat-foldable quadrilaterals in closed form: from the creases of two sides to all vertices, flat or folded.

Every vertex (i, j) has four creases and corners a (up and right), b (up and left), pi - a, pi - b (below, opposite).
Folded, all creases of a row have one half-angle tangent up to signs, and so have those of a column; their ratio at
the vertex is (1 - q) / (1 + q) with q = tan(a / 2) tan(b / 2). So ratios are products of one number for the row and one
for the column, and with the sum of the corners of each panel two sides fix all corners: the marching construction
of F. Feng, X. Dang, R. D. James and P. Plucinsky, "The designs and deformations of rigidly and flat-foldable
quadrilateral mesh origami" (2020), written with q. Whatever the numbers of the sides are, the sheet folds rigidly with
1 degree of freedom. All functions are analytic, so imaginary steps give exact derivatives. Theory:
docs/theory/design.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
import scipy

from graphs.errors import InvariantError, UnsolvableError
from graphs.mechanism.sheet import Sheet
from graphs.types import Floats
from synth.catalogue.patterns.panels import sheet_of_faces

IMAGINARY = 1e-40
"""Imaginary step of numbers, of which derivatives are exact."""


@dataclass(frozen=True)
class QuadrilateralSides:
    """The numbers of a flat-foldable sheet of m x n quadrilaterals: corners and lengths on its left and lower side.

    Arrays may have further axes, one sheet for each.

    Attributes
    ----------
    left : float[2, m + 1]
        Corners a and b at the vertices of the left side, radians, from below.
    lower : float[2, n]
        Those at the vertices of the lower side, but the first.
    heights, widths : float[m], float[n]
        Lengths of the creases of the left and of the lower side.
    fold : float
        Half-angle tangent of the lowest row of creases where the sheet is folded.

    Examples
    --------
    >>> sides = miura_sides(4, 6, 1.2, 1.0, 1.0, 0.5)
    >>> sides.left.shape, sides.lower.shape, sides.numbers.shape
    ((2, 5), (2, 6), (33,))
    """

    left: Floats
    lower: Floats
    heights: Floats
    widths: Floats
    fold: Any

    @property
    def numbers(self) -> Floats:
        """All numbers in one row."""
        parts = (self.left, self.lower, self.heights, self.widths)
        return np.concatenate([*(part.ravel() for part in parts), [self.fold]])

    def at(self, numbers: Floats) -> QuadrilateralSides:
        """Return sides of the same counts with numbers float[k] or float[k, ...]."""
        rows, columns = len(self.heights), len(self.widths)
        ends = np.cumsum([2 * (rows + 1), 2 * columns, rows, columns])
        left, lower, heights, widths, fold = np.split(numbers, ends)
        rest = numbers.shape[1:]
        return QuadrilateralSides(
            left.reshape(2, rows + 1, *rest), lower.reshape(2, columns, *rest), heights, widths, fold[0]
        )


def miura_sides(rows: int, columns: int, sector: float, height: float, width: float, fold: float) -> QuadrilateralSides:
    """Return the sides of a Miura sheet of rows x columns panels; sector in radians, height and width of a panel.

    Examples
    --------
    >>> flat, _ = marched(miura_sides(2, 2, np.pi / 3, 1.0, 1.0, 0.5))
    >>> flat[2, 2].round(6).tolist()
    [1.732051, 2.0]
    """
    corners = np.where(np.arange(columns + 1) % 2 == 0, sector, np.pi - sector)
    left, lower = np.full((2, rows + 1), sector), np.tile(corners[1:], (2, 1))
    return QuadrilateralSides(left, lower, np.full(rows, height), np.full(columns, width), fold)


def marched(sides: QuadrilateralSides) -> tuple[Floats, Floats]:
    """Return the flat vertices [m + 1, n + 1, 2, ...], and the corners a and b of all vertices [2, m + 1, n + 1, ...].

    Vertices that do not exist where sides cannot be continued come out as no sensible places: `checked_sheet` refuses
    panels that are not convex.
    """
    rows, columns = len(sides.heights), len(sides.widths)
    a = np.empty((rows + 1, columns + 1, *sides.heights.shape[1:]), dtype=sides.left.dtype)
    b = np.empty_like(a)
    a[:, 0], b[:, 0] = sides.left
    a[0, 1:], b[0, 1:] = sides.lower
    ratio = _ratios(a, b)
    for i, j in product(range(rows), range(columns)):
        a[i + 1, j + 1] = a[i, j] + b[i, j + 1] - b[i + 1, j]
        q = (1.0 - ratio[i + 1, j + 1]) / (1.0 + ratio[i + 1, j + 1])
        b[i + 1, j + 1] = 2.0 * np.arctan(q / np.tan(a[i + 1, j + 1] / 2.0))
    return _placed(sides, a, b), np.stack([a, b])


def _ratios(a: Floats, b: Floats) -> Floats:
    """Return the ratios of tangents of columns to rows at all vertices, from those of the left and lower side."""
    q_left, q_lower = (np.tan(a[part] / 2.0) * np.tan(b[part] / 2.0) for part in (np.s_[:, 0], np.s_[0, :]))
    left, lower = ((1.0 - q) / (1.0 + q) for q in (q_left, q_lower))
    return np.asarray(left[:, None] * lower[None] / lower[0])


def _placed(sides: QuadrilateralSides, a: Floats, b: Floats) -> Floats:
    """Return flat vertices from corners, and lengths on two sides; the first crease of the left side goes up."""
    rows, columns = len(sides.heights), len(sides.widths)
    places = np.zeros((rows + 1, columns + 1, 2, *a.shape[2:]), dtype=a.dtype)
    # Directions: to the right of a vertex is its corner a below up; along the left side up turns by b - a.
    up, right = np.empty_like(a[:-1]), np.empty_like(a[:, :-1])
    up[0, 0] = np.pi / 2.0
    for i in range(1, rows):
        up[i, 0] = up[i - 1, 0] - b[i, 0] + a[i, 0]
    right[:-1, 0] = up[:, 0] - a[:-1, 0]
    right[-1, 0] = up[-1, 0] - b[-1, 0]
    for j in range(1, columns):
        right[:, j] = right[:, j - 1] + np.pi - a[:, j] - b[:, j]
    up[:, 1:] = right[:-1] + np.pi - b[:-1, 1:]
    along, across = (np.stack([np.cos(way), np.sin(way)], axis=2) for way in (right, up))
    for j in range(columns):
        places[0, j + 1] = places[0, j] + sides.widths[j] * along[0, j]
    for i in range(rows):
        places[i + 1, 0] = places[i, 0] + sides.heights[i] * across[i, 0]
    for i, j in product(range(rows), range(columns)):
        # The last vertex of a panel is where its upper and right sides meet.
        start, end, first, second = places[i + 1, j], places[i, j + 1], along[i + 1, j], across[i, j + 1]
        off = end - start
        part = (off[0] * second[1] - off[1] * second[0]) / (first[0] * second[1] - first[1] * second[0])
        places[i + 1, j + 1] = start + part * first
    return places


def folded(sides: QuadrilateralSides) -> Floats:
    """Return the vertices [m + 1, n + 1, 3, ...] where the lowest row of creases has the tangent `fold`.

    Examples
    --------
    >>> sides = miura_sides(2, 2, np.pi / 3, 1.0, 1.0, 0.5)
    >>> flat, _ = marched(sides)
    >>> lengths = np.linalg.norm(np.diff(folded(sides), axis=1), axis=2)
    >>> bool(np.allclose(lengths, np.linalg.norm(np.diff(flat, axis=1), axis=2)))
    True
    """
    flat, (a, b) = marched(sides)
    rows, columns = flat.shape[0] - 1, flat.shape[1] - 1
    ratio = (1.0 - np.tan(a / 2.0) * np.tan(b / 2.0)) / (1.0 + np.tan(a / 2.0) * np.tan(b / 2.0))
    # Creases of a column change sign at each vertex, those of a row keep it: T of rows, times ratio, alternates.
    of_rows = sides.fold * ratio[0, 0] / ratio[:, 0] * ((-1.0) ** np.arange(rows + 1)).reshape(-1, *[1] * (a.ndim - 2))
    of_columns = sides.fold * ratio[0, :]
    whole = np.concatenate([flat, np.zeros_like(flat[:, :, :1])], axis=2)
    along, across = np.diff(whole, axis=1), np.diff(whole, axis=0)
    # Frames of panels: from each to the next in the lowest row, then up all columns at once.
    frames = np.zeros((rows, columns, 3, 3, *a.shape[2:]), dtype=a.dtype)
    frames[0, 0] = np.eye(3).reshape(3, 3, *[1] * (a.ndim - 2))
    for j in range(1, columns):
        frames[0, j] = _after(frames[0, j - 1], _turn(across[0, j], of_columns[j]))
    for i in range(1, rows):
        tangent = np.broadcast_to(of_rows[i], of_columns[:-1].shape)
        turns = np.stack([_turn(along[i, j], tangent[j]) for j in range(columns)])
        frames[i] = np.einsum("jkl...,jlm...->jkm...", frames[i - 1], turns)
    raised = np.einsum("ijkl...,ijl...->ijk...", frames, across[:, :-1])
    last = np.einsum("ikl...,il...->ik...", frames[:, -1], across[:, -1])
    level = np.einsum("jkl...,jl...->jk...", frames[0], along[0])
    places = np.zeros_like(whole)
    places[0, 1:] = np.cumsum(level, axis=0)
    places[1:, :-1] = places[:1, :-1] + np.cumsum(raised, axis=0)
    places[1:, -1] = places[:1, -1] + np.cumsum(last, axis=0)
    return places


def _after(first: Floats, second: Floats) -> Floats:
    return np.asarray(np.einsum("kl...,lm...->km...", first, second))


def _turn(axis: Floats, tangent: Floats) -> Floats:
    """Return rotations [3, 3, ...] about axes [3, ...] by angles with half-angle tangents."""
    # Imaginary parts are derivatives, so lengths are roots of squares, never of absolute values.
    x, y, z = axis / np.sqrt((axis * axis).sum(axis=0))
    none = np.zeros_like(x)
    cross = np.stack([np.stack([none, -z, y]), np.stack([z, none, -x]), np.stack([-y, x, none])])
    size = 1.0 + tangent * tangent
    unity = np.eye(3).reshape(3, 3, *[1] * (axis.ndim - 1))
    return np.asarray(unity + 2.0 * tangent / size * cross + 2.0 * tangent * tangent / size * _after(cross, cross))


def cell_curvatures(places: Floats) -> tuple[Floats, Floats]:
    """Return Gaussian and mean curvatures of the unit cells of 2 x 2 panels, by the discrete shape operator.

    Parameters
    ----------
    places : float[m + 1, n + 1, 3, ...]
        Vertices of a folded sheet; every second one of every second row is on the surface.

    Returns
    -------
    gaussian, mean : float[m / 2 - 1, n / 2 - 1, ...]
        Of the first differences of neighbouring cells and their second ones along the normal: A. Sardas, M. Moshe and
        C. Maor, "A continuum geometric approach for inverse design of origami structures" (2024), arXiv 2405.07249.

    Examples
    --------
    >>> x, y = np.meshgrid(np.linspace(-0.1, 0.1, 9), np.linspace(-0.1, 0.1, 9))
    >>> gaussian, mean = cell_curvatures(np.stack([x, y, (x**2 - y**2) / 2], axis=2))
    >>> bool(abs(gaussian + 1).max() < 0.1)
    True
    """
    corners = places[::2, ::2]
    along, across = np.diff(corners, axis=1), np.diff(corners, axis=0)
    u, v = along[:-2, :-1], across[:-1, :-2]
    normal = np.cross(u, v, axis=2)
    normal = normal / np.sqrt((normal * normal).sum(axis=2, keepdims=True))
    bent = (np.diff(along, axis=1)[:-2], np.diff(along, axis=0)[:-1, :-1], np.diff(across, axis=0)[:, :-2])
    e, f, g = ((part * normal).sum(axis=2) for part in bent)
    uu, uv, vv = (u * u).sum(axis=2), (u * v).sum(axis=2), (v * v).sum(axis=2)
    det = uu * vv - uv * uv
    return (e * g - f * f) / det, (e * vv - 2.0 * f * uv + g * uu) / (2.0 * det)


@dataclass(frozen=True)
class CurvedSheet:
    """A sheet of quadrilaterals that folds to a surface of given curvatures.

    Attributes
    ----------
    sides : QuadrilateralSides
    gaussian, mean : float[r, c]
        Measured by `cell_curvatures` where it is folded.
    """

    sides: QuadrilateralSides
    gaussian: Floats
    mean: Floats


def curved_sheet(
    sides: QuadrilateralSides, curvatures: tuple[float, float], *, stay: float = 0.01, rounds: int = 12
) -> CurvedSheet:
    """Change the numbers of two sides until the folded sheet has the principal curvatures, which keep it foldable.

    Parameters
    ----------
    sides : QuadrilateralSides
        The start, with some curvature, of an even number of rows and columns.
    curvatures : (float, float)
        Principal curvatures, one over the unit of length.
    stay : float
        Weight with which numbers stay where they are, and the fold with them: it keeps panels convex.
    rounds : int
        Steps of least squares.

    Raises
    ------
    UnsolvableError
        If panels of the best sheet overlap.
    """
    first = sides.numbers
    gaussian, mean = curvatures[0] * curvatures[1], (curvatures[0] + curvatures[1]) / 2.0
    scale = max(map(abs, curvatures))

    def missed(numbers: Floats) -> Floats:
        k, h = cell_curvatures(folded(sides.at(numbers)))
        rest = stay * (numbers - first.reshape(-1, *[1] * (numbers.ndim - 1)))
        parts = ((k - gaussian) / scale**2, (h - mean) / scale)
        return np.concatenate([*(part.reshape(-1, *numbers.shape[1:]) for part in parts), rest])

    def slopes(numbers: Floats) -> Floats:
        count = len(numbers)
        return np.asarray(missed(numbers[:, None] + 1j * IMAGINARY * np.eye(count)).imag / IMAGINARY)

    found = scipy.optimize.least_squares(missed, first, slopes, method="lm", max_nfev=rounds)
    best = sides.at(found.x)
    sheet_of_sides(best)
    return CurvedSheet(best, *cell_curvatures(folded(best)))


def sheet_of_sides(sides: QuadrilateralSides) -> Sheet:
    """Return the flat sheet with its mountains and valleys.

    Raises
    ------
    UnsolvableError
        If the sides cannot be continued to panels that are convex.
    InvariantError
        If the sides are those of several sheets.

    Examples
    --------
    >>> sheet = sheet_of_sides(miura_sides(2, 2, 1.2, 1.0, 1.0, 0.5))
    >>> len(sheet.faces), "".join(sheet.assignments).count("V")
    (4, 1)
    """
    if sides.heights.ndim > 1:
        raise InvariantError("sides", "numbers of several sheets", "those of one sheet")
    places, (a, b) = marched(sides)
    rows, columns = places.shape[0] - 1, places.shape[1] - 1
    number = np.arange((rows + 1) * (columns + 1)).reshape(rows + 1, columns + 1)
    faces = [
        (int(number[i, j]), int(number[i, j + 1]), int(number[i + 1, j + 1]), int(number[i + 1, j]))
        for i, j in product(range(rows), range(columns))
    ]
    corners = places.reshape(-1, 2)[np.array(faces)]
    after, before = (np.roll(corners, step, axis=1) - corners for step in (-1, 1))
    if not (after[..., 0] * before[..., 1] - after[..., 1] * before[..., 0] > 0.0).all():
        raise UnsolvableError("panels of the sheet are not convex; try smaller curvatures, or more panels")
    valleys = np.cos((a + b) / 2.0) * np.cos((a - b) / 2.0) < 0.0
    letters = {}
    for i, j in product(range(rows + 1), range(columns + 1)):
        if j < columns:
            letters[frozenset((int(number[i, j]), int(number[i, j + 1])))] = "VM"[i % 2]
        if i < rows:
            letters[frozenset((int(number[i, j]), int(number[i + 1, j])))] = "MV"[(i + int(valleys[0, j])) % 2]
    title = f"Flat-foldable quadrilaterals {rows} x {columns}"
    return sheet_of_faces([tuple(place) for place in places.reshape(-1, 2).tolist()], faces, title, letters)
