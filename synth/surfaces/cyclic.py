"""Cyclic quadrilaterals: the circle through the four joints in closed form.

Four sides fit on two circles at most: one with the quadrilateral open (convex), one with it crossed (Hyatt et
al. 2021, Eqs. 4, 5 and 12). On a cylinder the sides are the links; on a cone they are the chords 2 sin(angle /
2) of the unit sphere, and R = cos(lambda) (Eqs. 13, 14). The circle does not depend on the order of the links.

Near lambda = 0 a cosine tells little. With half angles x_i, their sum S and T_j the three differences of pairs
of them,

    open     16 K^2 (1 - R^2) = 256 cos(S/2) prod sin(S/2 - x_i) prod cos(T_j / 2)
    crossed  16 K^2 (1 - R^2) = 256 sin(S/2) prod cos(S/2 - x_i) prod sin(T_j / 2)

which loses no digits: tan(lambda)^2 is this by the numerator of Eq. 12. Theory: docs/theory/mapping.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.types import Flags, Floats
from synth.fourbar.rounding import rounding_of
from synth.surfaces.loop_sums import sign_patterns

__all__ = ["ConicalQuadrilaterals", "CyclicQuadrilaterals", "circumradii", "cone_angles", "crossed_area"]


@dataclass(frozen=True, slots=True)
class CyclicQuadrilaterals:
    """Circumradii, float[...], of open and crossed quadrilaterals; nan where there is none.

    They are in the unit of the sides, float[..., 4].
    """

    open: Floats
    crossed: Floats
    sides: Floats

    @property
    def ill_conditioned(self) -> Flags:
        """bool[...]: whether a sum of sides with signs is within their rounding of zero, and so decides."""
        return _nearly_zero(self.sides, angular=False)


@dataclass(frozen=True, slots=True)
class ConicalQuadrilaterals:
    """Cones of open and crossed spherical four-bars with link angles float[..., 4], radians.

    Cone angles are float[...], lambda in [0, pi/2), radians; nan where there is none.
    """

    open: Floats
    crossed: Floats
    angles: Floats

    @property
    def ill_conditioned(self) -> Flags:
        """bool[...]: whether a sum of angles with signs, or all less a turn, is within rounding of zero."""
        return _nearly_zero(self.angles, angular=True)


def _sides(values: npt.ArrayLike) -> tuple[Floats, Floats, Floats, Floats]:
    a, b, c, d = np.moveaxis(np.asarray(values, dtype=float), -1, 0)
    return a, b, c, d


def _numerator(a: Floats, b: Floats, c: Floats, d: Floats, mu: int) -> Floats:
    """Return (ab + mu cd)(ac + mu bd)(bc + mu ad), the numerator of Eq. 12."""
    return np.asarray((a * b + mu * c * d) * (a * c + mu * b * d) * (b * c + mu * a * d))


def _sixteen_area_squared(a: Floats, b: Floats, c: Floats, d: Floats, mu: int) -> Floats:
    """Return 16 K^2, the product of the sums of sides with one subtracted (Brahmagupta; Eq. 11)."""
    d = mu * d
    return np.asarray((b + c + d - a) * (a + c + d - b) * (a + b + d - c) * (a + b + c - d))


def _nearly_zero(links: Floats, *, angular: bool) -> Flags:
    """Tell whether links with signs, or angles less a turn, sum to less than their rounding."""
    turn = 2.0 * np.pi * np.eye(8)[0] if angular else np.zeros(8)  # the first pattern is that of all +
    sums = links @ sign_patterns(4).T - turn
    return np.asarray((np.abs(sums) <= rounding_of(links)[..., np.newaxis]).any(axis=-1))


def circumradii(sides: npt.ArrayLike) -> CyclicQuadrilaterals:
    """Return the circles of planar quadrilaterals (Hyatt et al. 2021, Eq. 12; Eqs. 4 and 5).

    Parameters
    ----------
    sides : float[..., 4]
        Positive lengths; their order does not matter.

    Returns
    -------
    CyclicQuadrilaterals

    Notes
    -----
    Eq. 12 with mu = -1 also gives real radii where numerator and denominator are both negative; no quadrilateral
    has them. Where both vanish (two pairs of equal sides) there are infinitely many crossed circles, and nan is
    returned.

    Examples
    --------
    >>> found = circumradii([4, 3, 5, 1])
    >>> float(found.open.round(4)), float(found.crossed.round(4))
    (2.5361, 2.5909)
    """
    given = np.asarray(sides, dtype=float)
    a, b, c, d = _sides(given)
    radii = []
    for mu in (1, -1):
        numerator, denominator = _numerator(a, b, c, d, mu), _sixteen_area_squared(a, b, c, d, mu)
        with np.errstate(invalid="ignore", divide="ignore"):
            there = (numerator > 0) & (denominator > 0)
            radii.append(np.where(there, np.sqrt(numerator / denominator), np.nan))
    return CyclicQuadrilaterals(radii[0], radii[1], given)


def cone_angles(angles: npt.ArrayLike) -> ConicalQuadrilaterals:
    """Return the cones on which spherical four-bars lie (Hyatt et al. 2021, Eqs. 12 to 14).

    Parameters
    ----------
    angles : float[..., 4]
        Link angles, radians, between 0 and pi; their order does not matter.

    Returns
    -------
    ConicalQuadrilaterals
        lambda = 0 where a crossed linkage folds flat; nan where two pairs of angles are equal and there are
        infinitely many crossed cones.

    Examples
    --------
    Hyatt et al. 2020, Fig. 10(a) and (b):

    >>> found = cone_angles(np.radians([[120, 95, 45, 85], [155, 50, 65, 80]]))
    >>> np.degrees(found.open).round(3), np.degrees(found.crossed).round(3)
    (array([13.998,  8.864]), array([29.044,    nan]))
    """
    given = np.asarray(angles, dtype=float)
    half = [angle / 2.0 for angle in _sides(given)]
    x, y, z, w = half
    chords = [2.0 * np.sin(angle) for angle in half]
    middle = (x + y + z + w) / 2.0
    pairs = [(x + y - z - w) / 2.0, (x + z - y - w) / 2.0, (y + z - x - w) / 2.0]
    less = [middle - angle for angle in half]
    convex: Any = np.cos(middle)
    crossed: Any = np.sin(middle)
    for angle in less:
        convex, crossed = convex * np.sin(angle), crossed * np.cos(angle)
    for angle in pairs:
        convex, crossed = convex * np.cos(angle), crossed * np.sin(angle)
    found = []
    for mu, product in ((1, convex), (-1, crossed)):
        numerator = _numerator(chords[0], chords[1], chords[2], chords[3], mu)
        with np.errstate(invalid="ignore", divide="ignore"):
            there = (numerator > 0) & (product >= 0)
            found.append(np.where(there, np.arctan(np.sqrt(256.0 * product / numerator)), np.nan))
    return ConicalQuadrilaterals(found[0], found[1], given)


def crossed_area(sides: npt.ArrayLike) -> Floats:
    """Return the area, float[...], of crossed cyclic quadrilaterals with sides float[..., 4] (Eq. 11).

    Triangles of opposite sense are subtracted; nan where no crossed quadrilateral has a circle.
    """
    with np.errstate(invalid="ignore"):
        return np.asarray(np.sqrt(_sixteen_area_squared(*_sides(sides), -1)) / 4.0)
