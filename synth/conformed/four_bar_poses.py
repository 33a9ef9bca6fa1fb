"""Poses of a conical four-bar away from the conformed one (Hyatt et al. 2020, section 6).

Theory: docs/theory/four-bars.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError
from graphs.geometry import rotated
from graphs.mechanism.surfaces import checked_cone_angle
from graphs.types import Floats
from synth.conformed.pose import dihedral_angles, joint_axes, measured_dihedral_angles
from synth.fourbar.position import output_spherical
from synth.surfaces.circuit import azimuths
from synth.surfaces.cone import link_angles

__all__ = ["FourBarPoses", "poses_from_conformed"]


@dataclass(frozen=True, slots=True)
class FourBarPoses:
    """Poses of a conical four-bar about its conformed one; nan where it does not reach.

    Attributes
    ----------
    theta, psi, xi : float[M]
        Angles at O, C and A (xi = theta_{alpha, eta}), radians.
    conformed : (float, float, float)
        theta, psi and xi at the conformed pose.
    axes : float[M, 4, 3]
        O, A, B, C. B is reached from the input (Eq. 21).
    residual : float[M]
        Distance of that B from the one reached from the output (Eq. 23).
    """

    theta: Floats
    psi: Floats
    xi: Floats
    conformed: tuple[float, float, float]
    axes: Floats
    residual: Floats


def poses_from_conformed(steps: npt.ArrayLike, cone_angle: float, turns: npt.ArrayLike) -> FourBarPoses:
    """Turn the input of a conical four-bar from its conformed pose (Hyatt et al. 2020, Eqs. 15 to 24).

    Parameters
    ----------
    steps : float[4]
        Projected angles in loop order alpha_0 (O to A), eta_0, beta_0, gamma_0 (C to O), radians; their sum is a
        multiple of 2 pi.
    cone_angle : float
        lambda > 0.
    turns : float[M]
        How far the input has turned from the conformed pose.

    Returns
    -------
    FourBarPoses

    Raises
    ------
    InvariantError
        If the steps do not close, or lambda is 0, where the linkage is at a dead point.

    Notes
    -----
    Eqs. 22 and 23 take gamma_0 and beta_0 the other way round; in one loop direction C = R_y(-gamma_0) O
    (docs/misprints.md 000-2). The branch is that of the conformed pose.

    Examples
    --------
    >>> poses = poses_from_conformed(np.radians([50, 110, 80, 120]), np.radians(20), np.radians([-30, 30]))
    >>> np.degrees(poses.psi - poses.conformed[1]).round(4).tolist()
    [-11.1118, 34.9421]
    """
    given = np.asarray(steps, dtype=float)
    lam = float(checked_cone_angle(cone_angle))
    total = given.sum()
    if given.shape != (4,) or abs(total - 2 * np.pi * np.rint(total / (2 * np.pi))) > 1e-9:
        raise InvariantError("closed loop", "the steps do not close", "four that sum to a multiple of 360 degrees")
    if lam == 0.0:
        raise InvariantError("cone angle", "at lambda = 0 the linkage is at a dead point", "a cone angle above 0")
    start = joint_axes(azimuths(given), lam)
    o, a0, b0, c = start
    dihedral = dihedral_angles(given, lam)
    theta0, xi0, psi0 = float(dihedral[0]), float(dihedral[1]), float(np.pi - dihedral[3])
    links = link_angles(np.roll(given, 1), lam)
    both = np.array([output_spherical(links, theta0, branch) for branch in (1, -1)])
    branch = 1 if abs(_turned(both[0] - psi0)) <= abs(_turned(both[1] - psi0)) else -1
    theta = theta0 + np.asarray(turns, dtype=float)
    psi = psi0 + _turned(output_spherical(links, theta, branch) - psi0)
    a = rotated(a0, o, theta - theta0)
    b_by_output = rotated(b0, c, psi - psi0)
    loop = np.stack(np.broadcast_arrays(o, a, b_by_output, c), axis=-2)
    xi = xi0 + _turned(measured_dihedral_angles(loop)[..., 1] - xi0)
    b = rotated(rotated(b0, o, theta - theta0), a, xi - xi0)
    axes = np.stack(np.broadcast_arrays(o, a, b, c), axis=-2)
    axes = np.where(np.isnan(psi)[..., np.newaxis, np.newaxis], np.nan, axes)
    residual = np.linalg.norm(b - b_by_output, axis=-1)
    return FourBarPoses(theta, psi, xi, (theta0, psi0, xi0), axes, residual)


def _turned(angle: npt.ArrayLike) -> Floats:
    return np.asarray(np.remainder(np.asarray(angle) + np.pi, 2 * np.pi) - np.pi)
