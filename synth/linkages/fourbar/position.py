"""Positions of four-bars: input and output angles, limits, transmission angle, of many at a time.

Links are ground, input, coupler, output; angles as in McCarthy: theta at O from the ground link O C to the input
link O A; psi at C from the ground link prolonged to the output link C B. On the sphere they are dihedral angles,
right-handed about the outward axes (Hyatt et al. 2020, section 6, put right: docs/misprints.md 000-5). A position
has two branches, which are the circuits of linkages whose input turns fully. Theory: docs/theory/four-bars.md.
"""

import numpy as np
import numpy.typing as npt

from graphs.tolerances import DOUBLE
from graphs.types import Floats


def output_planar(lengths: npt.ArrayLike, theta: npt.ArrayLike, branch: npt.ArrayLike = 1) -> Floats:
    """Return the output angle of planar four-bars: psi in (-pi, pi], float[...]; nan out of reach.

    Parameters
    ----------
    lengths, theta : float[..., 4], float[...]
        g, a, h, b; input angle, radians.
    branch : {1, -1} [...]
        Which of the two positions.

    Examples
    --------
    >>> np.degrees(output_planar([2, 1, 2, 1], np.pi / 3, [-1, 1])).round(6).tolist()  # a parallelogram
    [60.0, -120.0]
    """
    g, a, h, b = np.moveaxis(np.asarray(lengths, dtype=float), -1, 0)
    theta = np.asarray(theta, dtype=float)
    x, y = a * np.cos(theta) - g, a * np.sin(theta)  # A as seen from C
    return _two_branches(x, y, (x**2 + y**2 + b**2 - h**2) / (2 * b), branch)


def output_spherical(angles: npt.ArrayLike, theta: npt.ArrayLike, branch: npt.ArrayLike = 1) -> Floats:
    """Return the output angle of spherical four-bars (Hyatt et al. 2020, section 6), as `output_planar` does.

    Parameters
    ----------
    angles : float[..., 4]
        gamma, alpha, eta, beta, radians.
    theta, branch : float[...], {1, -1} [...]

    Examples
    --------
    >>> np.degrees(output_spherical(np.radians([70, 60, 80, 75]), np.radians(50), [-1, 1])).round(4).tolist()
    [22.3481, -156.663]
    """
    gamma, alpha, eta, beta = np.moveaxis(np.asarray(angles, dtype=float), -1, 0)
    theta = np.asarray(theta, dtype=float)
    along, z = np.sin(alpha) * np.cos(theta), np.cos(alpha)
    x, y = np.cos(gamma) * along - np.sin(gamma) * z, np.sin(alpha) * np.sin(theta)  # A as seen from C
    height = np.sin(gamma) * along + np.cos(gamma) * z
    return _two_branches(x, y, (np.cos(eta) - np.cos(beta) * height) / np.sin(beta), branch)


def _two_branches(x: Floats, y: Floats, c: Floats, branch: npt.ArrayLike) -> Floats:
    """Solve x cos(psi) + y sin(psi) = c."""
    psi = np.arctan2(y, x) + np.asarray(branch) * _within(c / np.hypot(x, y))
    return np.asarray(np.pi - np.remainder(np.pi - psi, 2 * np.pi))


def input_limits_spherical(angles: npt.ArrayLike) -> Floats:
    """Return where the input of spherical four-bars ends: with coupler and output folded, and stretched.

    float[..., 2], theta_min and theta_max in [0, pi]: theta and -theta are reached from theta_min to theta_max;
    nan where there is no such end, and the input passes 0 or pi.

    Parameters
    ----------
    angles : float[..., 4]
        Radians.

    Examples
    --------
    >>> np.degrees(input_limits_spherical(np.radians([85, 120, 95, 45]))).round(3).tolist()
    [37.29, 146.869]
    """
    gamma, alpha, eta, beta = np.moveaxis(np.asarray(angles, dtype=float), -1, 0)
    flat = np.cos(alpha) * np.cos(gamma)
    ends = [(np.cos(reach) - flat) / (np.sin(alpha) * np.sin(gamma)) for reach in (eta - beta, eta + beta)]
    return _ends(ends)


def _ends(cosines: list[Floats]) -> Floats:
    """Return the angles of the cosines that are some angle's, but for the ends of the range themselves."""
    both = np.stack(cosines, axis=-1)
    return np.arccos(np.where(np.abs(both) < 1 - DOUBLE.closed, both, np.nan))


def transmission_spherical(angles: npt.ArrayLike, theta: npt.ArrayLike) -> Floats:
    """Return the dihedral angle between coupler and output of spherical four-bars, in [0, pi], float[...].

    Force is passed on best at pi / 2, not at all at 0 and pi; nan out of reach.

    Parameters
    ----------
    angles, theta : float[..., 4], float[...]
        Radians.

    Examples
    --------
    >>> float(np.degrees(transmission_spherical([np.pi / 2] * 4, np.radians(50))).round(6))
    50.0
    """
    gamma, alpha, eta, beta = np.moveaxis(np.asarray(angles, dtype=float), -1, 0)
    across = np.sin(alpha) * np.sin(gamma) * np.cos(np.asarray(theta, dtype=float))
    height = np.cos(alpha) * np.cos(gamma) + across
    return _within((height - np.cos(eta) * np.cos(beta)) / (np.sin(eta) * np.sin(beta)))


def _within(cosine: Floats) -> Floats:
    return np.arccos(np.where(np.abs(cosine) <= 1 + DOUBLE.closed, np.clip(cosine, -1, 1), np.nan))
