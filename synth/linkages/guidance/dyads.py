"""Spherical RR dyads that guide a body through orientations: one dyad, and those of three and four orientations.

A dyad with fixed axis G and moving axis W of the body guides it through orientations M_1, ..., M_n if the angle of
its link stays the same: G . (M_i - M_1) W = 0. Of three orientations the fixed axis may be chosen. Of four, G is on a
cubic cone, where the determinant of the vectors (M_i - M_1)^T G vanishes; planes through the relative axis S_12 meet
it in two more lines each, and find the whole cone. Five and more: ``synth.linkages.guidance.synthesis``. Theory:
docs/theory/dyads.md.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from math import degrees
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.errors import UnsolvableError
from graphs.geometry import best_plane, facing, frame_about, principal_axes, unit
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.linkages.guidance.order import (
    Direction,
    crank_angles,
    nearest_moving_axis,
    order_by_crank_angles,
    order_verdicts,
)
from synth.linkages.guidance.orientations import Orientations, unit_vector


@dataclass(frozen=True, slots=True, eq=False)
class Dyad:
    """A dyad and how it takes the orientations.

    Attributes
    ----------
    fixed, moving : float[3]
        G, in the fixed frame, and W, in the body; of the two ends of each axis the one whose largest component is
        positive.
    residual : float
        Largest ``|G . (M_i - M_1) W|``, of unit vectors.
    link_angle, misfit : float
        Mean angle between the axes, and the largest difference of that angle at an orientation from it, radians.
    crank_angles : float[n]
        From orientation 1, counter-clockwise about G, radians in [0, 2 pi).
    direction : "ccw", "cw" or None
        The direction of a crank that takes the orientations in their order, if there is one.

    Examples
    --------
    >>> orientations = Orientations.from_axis_angles(np.eye(3), [0.0, 0.5, 0.7])
    >>> [dyad] = dyads_of_three(orientations, [(3, 1, 2)])
    >>> round(float(np.degrees(dyad.link_angle)), 2), dyad.direction
    (21.81, 'ccw')
    """

    fixed: Floats
    moving: Floats
    residual: float
    link_angle: float
    misfit: float
    crank_angles: Floats
    direction: Direction | None

    @property
    def in_order(self) -> bool:
        """Whether the crank takes the orientations in their order, turning one way."""
        return self.direction is not None

    def to_json(self) -> dict[str, Any]:
        """Return a dyad as plain data (docs/command-json.md)."""
        return {
            "G": self.fixed.tolist(),
            "W": self.moving.tolist(),
            "residual": self.residual,
            "in_order": self.in_order,
            "direction": self.direction,
            "link_angle_deg": degrees(self.link_angle),
            "misfit_deg": degrees(self.misfit),
            "crank_angles_deg": [degrees(angle) for angle in self.crank_angles],
        }


def dyad_of(orientations: Orientations, fixed: npt.ArrayLike, moving: npt.ArrayLike) -> Dyad:
    """Return the dyad with two axes, with its residual and its order.

    Parameters
    ----------
    orientations : Orientations
    fixed, moving : float[3]
        G, in the fixed frame, and W, in the body, not zero.

    Examples
    --------
    >>> turns = Orientations.from_axis_angles([(0, 0, 1)] * 3, [0, 1.0, 4.0])
    >>> dyad_of(turns, (0, 0, -1), (0, 3, 4)).direction
    'ccw'
    """
    g, w = facing(unit_vector(fixed, "fixed axis")), facing(unit_vector(moving, "moving axis"))
    cosines = orientations.matrices @ w @ g
    link_angles = np.arccos(np.clip(cosines, -1.0, 1.0))
    angles = crank_angles(orientations, g, w)
    return Dyad(
        g,
        w,
        float(np.abs(cosines - cosines[0]).max()),
        float(link_angles.mean()),
        float(np.abs(link_angles - link_angles.mean()).max()),
        angles,
        order_by_crank_angles(angles),
    )


def dyads_of_three(orientations: Orientations, fixed_axes: Iterable[npt.ArrayLike]) -> tuple[Dyad, ...]:
    """Return the dyads of three orientations with chosen fixed axes: one for each, in their order.

    Parameters
    ----------
    orientations : Orientations
        Three of them.
    fixed_axes : iterable of float[3]
        Of any length but zero; `UnsolvableError` if one lies on a relative axis: a whole plane of moving axes
        keeps its angle with it.

    Examples
    --------
    >>> orientations = Orientations.from_axis_angles(np.eye(3), [0.0, 0.5, 0.7])
    >>> dyads_of_three(orientations, [(1, 2, 3)])[0].residual < 1e-15
    True
    """
    if len(orientations) != 3:
        raise UnsolvableError(f"{len(orientations)} orientations; chosen fixed axes require 3")
    dyads = []
    for axis in fixed_axes:
        g = unit_vector(axis, "fixed axis")
        seen = orientations.matrices.transpose(0, 2, 1) @ g
        if principal_axes(seen)[0][1] < DOUBLE.same_point:
            raise UnsolvableError(
                "the fixed axis leaves its moving axis open: it lies on a relative axis; move the axis off it"
            )
        dyads.append(dyad_of(orientations, g, nearest_moving_axis(orientations, g)))
    return tuple(dyads)


_UNIT = 1e-6
"""How far from the unit circle a root may lie to be tried as an end of an interval; trying one too many does no
harm."""
_HALVINGS = 20
_POLISHINGS = 2
_EIGHTHS: Floats = np.linspace(0.0, np.pi, 8, endpoint=False)


@dataclass(frozen=True, slots=True, eq=False)
class AxisCurve:
    """A closed curve of dyads, sampled.

    Attributes
    ----------
    fixed, moving : float[m, 3]
        Unit vectors along the fixed axes, in order along the curve, each next one the nearer end of its axis; and
        the moving axis of each, in the body.
    residuals : float[m]
        Largest ``|G . (M_i - M_1) W|`` of each.
    verdicts : int8[m]
        1 where a counter-clockwise crank keeps the order, -1 a clockwise one, 0 neither
        (:func:`synth.linkages.guidance.order.order_verdicts`).
    """

    fixed: Floats
    moving: Floats
    residuals: Floats
    verdicts: npt.NDArray[np.int8]


def centre_axes(orientations: Orientations, samples: int = 360) -> tuple[AxisCurve, ...]:
    """Return the cones of fixed and moving axes of all dyads of four orientations, as sampled curves.

    One or two closed curves, opposite points of the sphere taken as one; there are more pieces if the cone crosses
    itself, as it does where it holds a plane (orientations of high symmetry).

    Parameters
    ----------
    orientations : Orientations
        Four; `UnsolvableError` if every axis is that of a dyad (as where all are turns about one axis).
    samples : int, optional
        Least number of points of a curve; successive ones are not further apart than 4 pi / samples.

    Examples
    --------
    >>> from scipy.spatial.transform import Rotation
    >>> turned = Rotation.from_euler("ZX", [(0, 0), (40, 10), (70, 60), (120, 100)], degrees=True)
    >>> all(curve.residuals.max() < 1e-12 for curve in centre_axes(Orientations.from_rotation(turned)))
    True
    """
    if len(orientations) != 4:
        raise UnsolvableError(f"{len(orientations)} orientations; a curve of dyads requires 4")
    pencil = _Pencil(orientations)
    pieces = [piece for start, end in pencil.intervals() for piece in _pieces(pencil, start, end)]
    pieces += [_great_circle(*plane) for plane in pencil.whole_planes()]
    curves = [_sampled(piece, samples) for piece in pieces]
    return tuple(_curve(orientations, facing_on(points)) for points in curves if len(points) > 1)


def dyads_of_four(orientations: Orientations, samples: int = 36) -> tuple[Dyad, ...]:
    """Return dyads of four orientations, spread over the curves of their axes.

    Parameters
    ----------
    orientations : Orientations
        Four of them.
    samples : int, optional
        As of :func:`centre_axes`, and so the errors.

    Examples
    --------
    >>> from scipy.spatial.transform import Rotation
    >>> turned = Rotation.from_euler("ZX", [(0, 0), (40, 10), (70, 60), (120, 100)], degrees=True)
    >>> len(dyads_of_four(Orientations.from_rotation(turned), 12)) >= 12
    True
    """
    return tuple(
        dyad_of(orientations, g, w)
        for curve in centre_axes(orientations, samples)
        for g, w in zip(curve.fixed, curve.moving, strict=True)
    )


class _Pencil:
    """The planes through S_12 and the two lines in which each meets the cubic cone.

    In the plane through P = S_12 and a direction U at right angles to it the cubic form at s P + t U is
    t (q0 s^2 + q1 s t + q2 t^2).
    """

    def __init__(self, orientations: Orientations) -> None:
        m = orientations.matrices
        self._conditions = (m[1:] - m[0]).transpose(0, 2, 1)
        self._base = orientations.relative_axis(1, 2)
        self._across = frame_about(self._base)[:2]
        *forms, _ = self._coefficients(_EIGHTHS)
        self._size = float(np.abs(forms).max())  # the largest coefficient, about

    def _coefficients(self, turns: Floats) -> tuple[Floats, Floats, Floats, Floats]:
        u = np.stack([np.cos(turns), np.sin(turns)], axis=1) @ self._across
        a, b, c = (u @ condition.T for condition in self._conditions)
        _, b_base, c_base = (np.broadcast_to(condition @ self._base, u.shape) for condition in self._conditions)
        q1 = _determinants(a, b_base, c) + _determinants(a, b, c_base)
        return _determinants(a, b_base, c_base), q1, _determinants(a, b, c), u

    def whole_planes(self) -> list[tuple[Floats, Floats]]:
        """Return the planes through S_12 that lie on the cone whole, each as two directions at right angles.

        There all coefficients vanish. They are forms of degree one, two and three in cos and sin of the plane's
        angle: the common roots are among those of the first that is not zero everywhere.
        """
        small = DOUBLE.zero * self._size
        forms = [*self._coefficients(_EIGHTHS)[:3]]
        degree = next((k for k, q in enumerate(forms, start=1) if np.abs(q).max() > small), 0)
        if not degree:
            return []
        powers = [np.cos(_EIGHTHS) ** (degree - k) * np.sin(_EIGHTHS) ** k for k in range(degree + 1)]
        form = np.linalg.lstsq(np.stack(powers, axis=1), forms[degree - 1], rcond=None)[0]
        roots = [np.pi / 2.0] if abs(form[-1]) < small else []
        roots += [float(np.arctan(root.real)) for root in np.roots(form[::-1]) if abs(root.imag) < _UNIT]
        *there, directions = self._coefficients(np.array(roots))
        whole = np.max(np.abs(there), axis=0) < np.sqrt(DOUBLE.zero) * self._size
        return [(self._base, u) for u in directions[whole]]

    def _discriminant(self, turns: Floats) -> Floats:
        q0, q1, q2, _ = self._coefficients(turns)
        return q1 * q1 - 4.0 * q0 * q2

    def intervals(self) -> list[tuple[float, float]]:
        """Return the intervals of the angle of the plane in which the two lines are real.

        The discriminant is a form of degree four in cos and sin of the angle, so it has five Fourier terms.
        """
        terms = np.fft.fft(self._discriminant(_EIGHTHS)) / 8.0
        if self._size < DOUBLE.zero:
            raise UnsolvableError("every axis is that of a dyad of these orientations (are they turns about one axis?)")
        if np.abs(terms).max() < (DOUBLE.zero * self._size) ** 2:  # the two lines are one in every plane
            return [(0.0, np.pi)]
        roots = np.roots(terms[[2, 1, 0, -1, -2]])
        ends = np.sort(np.angle(roots[np.abs(np.abs(roots) - 1.0) < _UNIT]) / 2.0)
        if not len(ends):
            return [(0.0, np.pi)] if terms[0].real > 0.0 else []
        spans = zip(ends, [*ends[1:], ends[0] + np.pi], strict=True)
        return [(a, b) for a, b in spans if self._discriminant(np.array([(a + b) / 2.0]))[0] > 0.0 and a < b]

    def points(self, turns: Floats, sheet: Floats) -> Floats:
        """Return one of the two lines in each plane, by the sign of the root: unit vectors float[m, 3].

        They are nan where the whole plane is on the cone.
        """
        q0, q1, q2, u = self._coefficients(turns)
        root = sheet * np.sqrt(np.maximum(q1 * q1 - 4.0 * q0 * q2, 0.0))
        one, other = np.stack([root - q1, 2.0 * q0]), np.stack([2.0 * q2, -q1 - root])
        # The same ratio s : t twice; the larger pair has not lost its digits.
        s, t = np.where(np.hypot(*one) > np.hypot(*other), one, other)
        sizes = np.hypot(s, t)
        sizes[sizes < DOUBLE.zero * self._size] = np.nan
        return np.asarray((s[:, None] * self._base + t[:, None] * u) / sizes[:, None])


def _pieces(pencil: _Pencil, start: float, end: float) -> list[Callable[[Floats], Floats]]:
    """Return the closed curves of an interval, as functions of a parameter from 0 to 1."""
    if end - start >= np.pi:  # both sheets go round and close on themselves
        return [
            lambda t: pencil.points(start + np.pi * t, np.ones_like(t)),
            lambda t: pencil.points(start + np.pi * t, -np.ones_like(t)),
        ]

    def there_and_back(t: Floats) -> Floats:  # the sheets meet at both ends
        turns = (start + end - (end - start) * np.cos(2.0 * np.pi * t)) / 2.0
        return pencil.points(turns, np.where(t < 0.5, 1.0, -1.0))

    return [there_and_back]


def _great_circle(base: Floats, across: Floats) -> Callable[[Floats], Floats]:
    return lambda t: np.outer(np.cos(np.pi * t), base) + np.outer(np.sin(np.pi * t), across)


def _sampled(curve: Callable[[Floats], Floats], samples: int) -> Floats:
    """Return points of a closed curve, closer where it runs fast, without repeating any."""
    t = np.linspace(0.0, 1.0, samples + 1)
    for _ in range(_HALVINGS):
        points = curve(t)
        there = ~np.isnan(points[:, 0])
        t, points = t[there], points[there]
        steps = np.linalg.norm(np.cross(points[1:], points[:-1]), axis=1)
        wide = np.flatnonzero(steps > np.sin(min(4.0 * np.pi / samples, np.pi / 2.0)))
        if not len(wide):
            break
        t = np.insert(t, wide + 1, (t[wide] + t[wide + 1]) / 2.0)
    points = curve(t[t < 1.0])
    points = points[~np.isnan(points[:, 0])]
    moved = np.linalg.norm(np.cross(points[1:], points[:-1]), axis=1) > DOUBLE.closed
    return np.asarray(points[np.concatenate([[True], moved])[: len(points)]])


def _determinants(a: Floats, b: Floats, c: Floats) -> Floats:
    return np.asarray(np.einsum("ij,ij->i", a, np.cross(b, c)))


def facing_on(points: Floats) -> Floats:
    """Return unit vectors, float[m, n], with those ends of their axes that follow each other."""
    turned_back = np.einsum("ij,ij->i", points[1:], points[:-1]) < 0.0
    signs = np.cumprod(np.where(np.concatenate([[False], turned_back]), -1.0, 1.0))
    return points * signs[:, None]


def _curve(orientations: Orientations, fixed: Floats) -> AxisCurve:
    m = orientations.matrices
    seen = np.einsum("nij,mi->mnj", m, fixed)
    moving = best_plane(seen).direction
    conditions = m[1:] - m[0]
    for _ in range(_POLISHINGS):
        fixed, moving = _polished(conditions, fixed, moving)
    residuals = np.abs(np.einsum("mi,nij,mj->mn", fixed, conditions, moving)).max(axis=1)
    return AxisCurve(fixed, facing_on(moving), residuals, order_verdicts(orientations, fixed))


def _polished(conditions: Floats, fixed: Floats, moving: Floats) -> tuple[Floats, Floats]:
    """Move axes to fulfil the conditions, as little as can be; where curves cross, half the digits were lost."""
    by_fixed, by_moving = np.einsum("nij,mj->mni", conditions, moving), np.einsum("mi,nij->mnj", fixed, conditions)
    values = np.einsum("mni,mi->mn", by_fixed, fixed)
    inverse = np.linalg.pinv(np.concatenate([by_fixed, by_moving], axis=2), rcond=1e-6)
    steps = np.einsum("mkn,mn->mk", inverse, values)
    return unit(fixed - steps[:, :3]), unit(moving - steps[:, 3:])
