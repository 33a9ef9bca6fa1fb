"""Formulas of the papers that the product does without, as second methods: ends of planar four-bars, hemispheres, steps."""

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError, UnsolvableError
from graphs.mechanism.surfaces import checked_cone_angle
from graphs.types import Floats
from synth.linkages.fourbar.closing import rounding_of
from synth.linkages.fourbar.position import _ends, _within
from synth.linkages.surfaces.loop_maps import largest_cone_angle


def transmission_planar(lengths: npt.ArrayLike, theta: npt.ArrayLike) -> Floats:
    """Return the angle between coupler and output of planar four-bars, in [0, pi], float[...]; nan out of reach.

    Force is passed on best at pi / 2, not at all at 0 and pi.
    """
    g, a, h, b = np.moveaxis(np.asarray(lengths, dtype=float), -1, 0)
    square = g**2 + a**2 - 2 * g * a * np.cos(np.asarray(theta, dtype=float))
    return _within((h**2 + b**2 - square) / (2 * h * b))


def input_limits_planar(lengths: npt.ArrayLike) -> Floats:
    """Return where the input of planar four-bars ends: with coupler and output folded, and stretched.

    float[..., 2], theta_min and theta_max in [0, pi]: theta and -theta are reached from theta_min to theta_max;
    nan where there is no such end, and the input passes 0 or pi.
    """
    g, a, h, b = np.moveaxis(np.asarray(lengths, dtype=float), -1, 0)
    with np.errstate(invalid="ignore"):
        ends = [(g**2 + a**2 - reach**2) / (2 * g * a) for reach in (h - b, h + b)]
    return _ends(ends)


def in_a_hemisphere(axes: npt.ArrayLike) -> npt.NDArray[np.bool_]:
    """Check whether the joint axes of spherical four-bars point into one hemisphere (Hyatt et al. 2020, 2.3).

    Four vectors lie in an open hemisphere unless a combination of them with weights >= 0 vanishes. In space the
    weights are the 3 x 3 minors with alternating sign, unique up to a factor where the vectors span space. Where
    they do not, in a linkage that lies flat, the answer is no.
    """
    vectors = np.asarray(axes, dtype=float)
    minors = np.stack([(-1) ** i * np.linalg.det(np.delete(vectors, i, axis=-2)) for i in range(4)], axis=-1)
    size = np.abs(minors).max(axis=-1, keepdims=True)
    noise = 1e-12 * np.maximum(size, np.linalg.norm(vectors, axis=-1).prod(axis=-1)[..., np.newaxis])
    some = (minors > noise).any(axis=-1), (minors < -noise).any(axis=-1)
    return np.asarray(some[0] & some[1])


def table1(steps: npt.ArrayLike) -> npt.NDArray[np.bool_]:
    """Check whether four-bars are open, by signs and sum of their steps (Hyatt et al. 2020, Table 1).

    Open (the table put right): all signs multiply to + and the sum is +-360 degrees, or to - and it is 0.
    """
    steps = np.asarray(steps, dtype=float)
    even = np.sign(steps).prod(axis=-1) > 0
    return np.asarray(even == (np.abs(steps.sum(axis=-1)) > np.pi))


def central_angles(lengths: npt.ArrayLike, radius: npt.ArrayLike) -> Floats:
    """Return the angles that links span round the axis, psi = 2 asin(length / 2 R) (Hyatt et al. 2021, Eq. 19)."""
    ratio = np.asarray(lengths, dtype=float) / (2.0 * np.asarray(radius, dtype=float))
    if not ((ratio >= 0) & (ratio <= 1)).all():
        raise InvariantError(
            "radius", "a link is longer than the diameter, or the radius is not positive", "2 R >= every length"
        )
    return np.asarray(2.0 * np.arcsin(ratio))


def projected_angles(angles: npt.ArrayLike, cone_angle: npt.ArrayLike) -> Floats:
    """Return the unsigned projected angles of links, phi_0 in [0, pi] (Hyatt et al. 2020, Eq. 7; 2021, Eq. 9).

    cos(phi_0) = (cos(phi) - sin(lambda)^2) / cos(lambda)^2, float[...].
    """
    phi, lam = np.broadcast_arrays(np.asarray(angles, dtype=float), checked_cone_angle(cone_angle))
    beyond = lam - largest_cone_angle(phi)
    if (beyond > rounding_of(np.stack([lam, phi / 2, np.full_like(phi, np.pi / 2)], axis=-1))).any():
        worst = np.unravel_index(beyond.argmax(), beyond.shape)
        numbers = [f"{np.degrees(value[worst]).round(9):.12g}" for value in (phi, lam, largest_cone_angle(phi))]
        raise UnsolvableError(
            f"a link of {numbers[0]} degrees does not fit on a cone of {numbers[1]}; "
            f"{numbers[2]} is the largest cone angle"
        )
    other = np.maximum(np.sin((np.pi - phi) / 2 - lam) * np.sin((np.pi - phi) / 2 + lam), 0.0)
    return np.asarray(2.0 * np.arctan2(np.sin(phi / 2), np.sqrt(other)))
