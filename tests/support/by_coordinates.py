"""The coordinate method: joints as points of the plane, lengths and a common circle as equations.

For a planar four-bar with its ground link from (0, 0) to (1, 0), Hyatt et al. 2021, Eqs. 6 to 8: six equations
in the coordinates of A = (x1, y1), B = (1 + x2, y2) and B - A = (x3, y3); the centre of the circle is (1/2, K).
On a cone the lengths are the chords of the link angles (Eqs. 17, 18). The four-bar is solved by elimination.
Loops of any number of links have the same kind of equations; they are solved by Newton's method from all
polygons on a circle that nearly close. Theory: docs/theory/mapping.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from graphs.types import Floats
from synth.linkages.surfaces.loop_sums import sign_patterns

__all__ = [
    "PolygonSolutions",
    "QuadrilateralSolutions",
    "cone_angles_by_coordinates",
    "polygons_by_coordinates",
    "quadrilaterals_by_coordinates",
]

_GRID = 400
_NEWTON = 60


@dataclass(frozen=True, slots=True)
class QuadrilateralSolutions:
    """Solutions of Eq. 6 for many quadrilaterals, open ones first, in units of the ground link; else nan.

    Attributes
    ----------
    unknowns : float[..., 2, 6]
        x1, y1, x2, y2, x3, y3 of one of the two mirror images (K >= 0).
    centre : float[..., 2]
        K.
    residual : float[..., 2]
        Largest residual of the six equations.
    """

    unknowns: Floats
    centre: Floats
    residual: Floats

    @property
    def radius(self) -> Floats:
        """Return R = sqrt(1/4 + K^2), in units of the ground link: float[..., 2]."""
        return np.asarray(np.hypot(0.5, self.centre))


@dataclass(frozen=True, slots=True)
class PolygonSolutions:
    """Circles of one polygon, found from coordinates.

    Attributes
    ----------
    points : float[M, n, 2]
        Joints, the first side from (0, 0) to (1, 0).
    centre : float[M]
        K >= 0: the centre is (1/2, K).
    radius : float[M]
        In units of the first side.
    residual : float[M]
        Largest residual of the equations.
    """

    points: Floats
    centre: Floats
    radius: Floats
    residual: Floats

    @property
    def steps(self) -> Floats:
        """Return the signed angles between successive joints, seen from the centre: float[M, n]."""
        arms = self.points - np.stack([np.full_like(self.centre, 0.5), self.centre], -1)[:, np.newaxis]
        after = np.roll(arms, -1, axis=1)
        cross = arms[..., 0] * after[..., 1] - arms[..., 1] * after[..., 0]
        return np.asarray(np.arctan2(cross, (arms * after).sum(axis=-1)))


def quadrilaterals_by_coordinates(sides: npt.ArrayLike) -> QuadrilateralSolutions:
    """Solve Hyatt et al. 2021, Eq. 6.

    Parameters
    ----------
    sides : float[..., 4]
        g, a, h, b.

    Returns
    -------
    QuadrilateralSolutions

    Notes
    -----
    The triangles O A B and O C B stand on the diagonal O B, whose square is E, and share a circle: their angles
    at A and C are equal (crossed) or supplementary (open). By the cosine rule both are linear equations in E. B
    and A follow, A on the side of O B that the sign of the angle asks for, and K from either of its expressions.

    Examples
    --------
    >>> found = quadrilaterals_by_coordinates([4, 3, 5, 1])
    >>> (4 * found.radius).round(4).tolist(), bool(found.residual.max() < 1e-12)
    ([2.5361, 2.5909], True)
    """
    s = np.asarray(sides, dtype=float)
    g = s[..., 0]
    a, h, b = (s[..., i] / g for i in (1, 2, 3))
    found = [_quadrilateral(a, h, b, crossed) for crossed in (False, True)]
    return QuadrilateralSolutions(*(np.stack([one[i] for one in found], axis=-1 if i else -2) for i in range(3)))


def _quadrilateral(a: Floats, h: Floats, b: Floats, crossed: bool) -> tuple[Floats, Floats, Floats]:
    """Return unknowns, K and residual of the open or the crossed quadrilaterals, with g = 1."""
    sign = 1.0 if crossed else -1.0
    with np.errstate(invalid="ignore", divide="ignore"):
        # (a^2 + h^2 - E) / (2 a h) = sign (1 + b^2 - E) / (2 b)
        square = (b * (a**2 + h**2) - sign * a * h * (1 + b**2)) / (b - sign * a * h)
        # B, above or on the x axis; its angle at C is that of the triangle
        bx = (1 + square - b**2) / 2
        by = np.sqrt(square - bx**2)
        # A: foot on O B, then to the one side (crossed: that of C) or the other
        along = (square + a**2 - h**2) / (2 * square)
        across = np.sqrt(np.maximum(a**2 / square - along**2, 0.0)) * np.where(crossed, -1.0, 1.0)
        ax, ay = along * bx - across * by, along * by + across * bx
        k_of_a, k_of_b = (a**2 - ax) / (2 * ay), (b**2 + bx - 1) / (2 * by)
        k = np.where(np.abs(ay) > np.abs(by), k_of_a, k_of_b)
        equations = [
            k_of_a * ay - k * ay,
            k_of_b * by - k * by,
            np.hypot(ax, ay) - a,
            np.hypot(bx - 1, by) - b,
            np.hypot(bx - ax, by - ay) - h,
        ]
    mirrored = np.where(k < 0, -1.0, 1.0)
    unknowns = np.stack([ax, ay * mirrored, bx - 1, by * mirrored, bx - ax, (by - ay) * mirrored], axis=-1)
    residual = np.max(np.abs(equations), axis=0)
    there = np.isfinite(residual) & (residual < 1e-6)
    return (
        np.where(there[..., np.newaxis], unknowns, np.nan),
        np.where(there, k * mirrored, np.nan),
        np.where(there, residual, np.nan),
    )


def cone_angles_by_coordinates(angles: npt.ArrayLike) -> Floats:
    """Return the cones of spherical four-bars from coordinates (Hyatt et al. 2021, Eqs. 17 and 18).

    Parameters
    ----------
    angles : float[..., 4]
        Link angles, radians; the first is the ground link's.

    Returns
    -------
    float[..., 2]
        lambda of the open and of the crossed linkage, radians; nan where there is none.

    Notes
    -----
    In units of the ground chord the sphere has radius d = 1 / (2 sin(gamma / 2)), and cos(lambda) = R / d. R > d
    is no cone.

    Examples
    --------
    >>> found = cone_angles_by_coordinates(np.radians([70, 80, 120, 40]))
    >>> np.degrees(found).round(4).tolist()
    [25.2093, nan]
    """
    half = np.asarray(angles, dtype=float) / 2
    found = quadrilaterals_by_coordinates(2 * np.sin(half))
    sine, cosine = np.sin(half[..., :1]), np.cos(half[..., :1])
    with np.errstate(invalid="ignore"):
        height = (cosine - 2 * found.centre * sine) * (cosine + 2 * found.centre * sine)
        height = np.where(np.abs(height) < 1e-14, 0.0, height)
        return np.asarray(np.arctan2(np.sqrt(height), 2 * sine * found.radius))


def polygons_by_coordinates(sides: npt.ArrayLike, largest: float = np.inf) -> PolygonSolutions:
    """Find the circles of one polygon of any number of sides from the coordinates of its corners.

    Parameters
    ----------
    sides : float[n]
        In order.
    largest : float, optional
        Largest radius, in the unit of the sides: 1 for chords of the unit sphere. By default 1000 perimeters.

    Returns
    -------
    PolygonSolutions
        In rising order of radius.

    Notes
    -----
    Starting polygons are drawn on circles of a grid of radii, for every sign pattern, and kept where the gap
    changes sides between neighbours. Two roots of one pattern in one cell may be missed, and double roots are;
    loop sums (`synth.linkages.surfaces.loop_sums`) miss none. Newton's method then solves for all coordinates and K at
    once.

    Examples
    --------
    >>> found = polygons_by_coordinates([4, 3, 5, 1])
    >>> (4 * found.radius).round(4).tolist()
    [2.5361, 2.5909]
    """
    given = np.asarray(sides, dtype=float)
    unit = given / given[0]
    starts, signs = _starts(unit, min(largest, 1000 * given.sum()) / given[0])
    found = [_newton(points, centre, unit) for points, centre in starts]
    kept: list[int] = []
    for i, (points, centre, residual) in enumerate(found):
        same = any((signs[i] == signs[j]).all() and abs(centre - found[j][1]) < 1e-8 * (1 + abs(centre)) for j in kept)
        if residual < 1e-10 and not same and np.isfinite(points).all():
            kept.append(i)
    kept.sort(key=lambda i: abs(found[i][1]))
    points = np.array([found[i][0] for i in kept]).reshape(-1, len(unit), 2)
    centres = np.array([found[i][1] for i in kept])
    points[..., 1] *= np.where(centres < 0, -1.0, 1.0)[:, np.newaxis]
    return PolygonSolutions(points, np.abs(centres), np.hypot(0.5, centres), np.array([found[i][2] for i in kept]))


def _starts(unit: Floats, largest: float) -> tuple[list[tuple[Floats, float]], list[Floats]]:
    """Return polygons that nearly close, as points and K, and their sign patterns."""
    # the longest side seen from the centre: from half a turn down to what the largest circle leaves
    least = np.arcsin(min(1.0, unit.max() / (2 * largest)))
    seen = least + (np.pi / 2 - least) * np.sin(np.linspace(0, np.pi / 2, _GRID)) ** 2
    ratio = np.minimum(np.sin(seen)[:, np.newaxis] * unit / unit.max(), 1.0)
    steps = 2 * np.arcsin(ratio)
    patterns = sign_patterns(len(unit)).astype(float)
    turned = steps @ patterns.T
    gap = np.sin(turned / 2)
    near, which = np.nonzero((gap[:-1] * gap[1:] <= 0) & (np.abs(turned[:-1] - turned[1:]) < np.pi))
    starts, signs = [], []
    for i, k in zip(near, which, strict=True):
        share = gap[i, k] / (gap[i, k] - gap[i + 1, k]) if gap[i, k] != gap[i + 1, k] else 0.5
        angle = seen[i] + share * (seen[i + 1] - seen[i])
        radius = unit.max() / (2 * np.sin(angle))
        one = 2 * np.arcsin(np.minimum(unit / (2 * radius), 1.0)) * patterns[k]
        places = -np.pi / 2 - one[0] / 2 + np.concatenate([[0.0], np.cumsum(one)[:-1]])
        centre = np.array([0.5, np.sqrt(max(radius**2 - 0.25, 0.0))])
        starts.append((centre + radius * np.stack([np.cos(places), np.sin(places)], -1), float(centre[1])))
        signs.append(patterns[k])
    return starts, signs


def _newton(points: Floats, centre: float, unit: Floats) -> tuple[Floats, float, float]:
    """Solve for corners 2 to n - 1 and K: squared lengths of sides, and the circle through all corners."""
    n = len(unit)
    x = np.concatenate([points[2:].ravel(), [centre]])
    residual = float("inf")
    for _ in range(_NEWTON):
        corners = np.concatenate([[[0.0, 0.0], [1.0, 0.0]], x[:-1].reshape(-1, 2)])
        sides = np.roll(corners, -1, axis=0) - corners
        lengths = (sides**2).sum(axis=1) - unit**2
        circle = (corners**2).sum(axis=1) - corners[:, 0] - 2 * x[-1] * corners[:, 1]
        values = np.concatenate([lengths[1:], circle[2:]])
        residual = float(np.abs(values).max(initial=0.0))
        matrix = np.zeros((len(values), len(x)))
        for i in range(1, n):
            for corner, side in ((i, -sides[i]), ((i + 1) % n, sides[i])):
                if corner >= 2:
                    matrix[i - 1, 2 * corner - 4 : 2 * corner - 2] += 2 * side
        for i in range(2, n):
            row = n - 1 + i - 2
            matrix[row, 2 * i - 4 : 2 * i - 2] = 2 * corners[i] - [1.0, 2 * x[-1]]
            matrix[row, -1] = -2 * corners[i, 1]
        change = np.linalg.lstsq(matrix, values, rcond=None)[0]
        x = x - change
        if np.abs(change).max() < 1e-15 * (1 + np.abs(x).max()):
            break
    return np.concatenate([[[0.0, 0.0], [1.0, 0.0]], x[:-1].reshape(-1, 2)]), float(x[-1]), residual
