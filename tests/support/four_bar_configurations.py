"""Conformed linkages rebuilt in space: measured angles, and poses of four-bars away from it, as a second method.

Frame of Hyatt et al. 2020: apex at the origin, the y axis along the cone's axis, away from the cone.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError
from graphs.geometry import across, rotated, sectors, unit
from graphs.mechanism.surfaces import checked_cone_angle, joint_axes
from graphs.types import Floats
from synth.linkages.conformed.dihedrals import dihedral_angles
from synth.linkages.fourbar.position import output_spherical
from synth.linkages.surfaces.circuit import azimuths, link_angles, wrapped


@dataclass(frozen=True, slots=True)
class ConfigurationCheck:
    """How well loops rebuilt in space are what they should be; all in radians.

    Attributes
    ----------
    link_angles : float[...]
        Largest difference between a link angle measured between axes and the required one.
    on_cone : float[...]
        Largest difference between an axis' angle with the plane across the cone's axis and lambda.
    """

    link_angles: Floats
    on_cone: Floats


def measured_dihedral_angles(axes: npt.ArrayLike) -> Floats:
    """Return the measured dihedral angles of closed loops of axes in space, as `dihedral_angles`: float[..., n]."""
    e = np.asarray(axes, dtype=float)
    u, v = across(np.roll(e, 1, axis=-2), e), across(np.roll(e, -1, axis=-2), e)
    return np.asarray(np.arctan2((np.cross(u, v) * unit(e)).sum(axis=-1), (u * v).sum(axis=-1)))


def check_configuration(angles: npt.ArrayLike, steps: npt.ArrayLike, cone_angle: npt.ArrayLike) -> ConfigurationCheck:
    """Build mapped loops in space and measure them."""
    axes = joint_axes(azimuths(steps), cone_angle)
    measured = sectors(axes)
    lam = np.asarray(cone_angle, dtype=float)[..., np.newaxis]
    tilt = np.arctan2(-axes[..., 1], np.hypot(axes[..., 0], axes[..., 2]))
    return ConfigurationCheck(
        np.abs(measured - np.asarray(angles, dtype=float)).max(axis=-1), np.abs(tilt - lam).max(axis=-1)
    )


@dataclass(frozen=True, slots=True)
class FourBarConfigurations:
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


def configurations_from_conformed(
    steps: npt.ArrayLike, cone_angle: float, turns: npt.ArrayLike
) -> FourBarConfigurations:
    """Turn the input of a conical four-bar from its conformed pose (Hyatt et al. 2020, Eqs. 15 to 24).

    Eqs. 22 and 23 take gamma_0 and beta_0 the other way round; in one loop direction C = R_y(-gamma_0) O
    (docs/misprints.md 000-2). The branch is that of the conformed pose.
    """
    signed = np.asarray(steps, dtype=float)
    lam = float(checked_cone_angle(cone_angle))
    total = signed.sum()
    if signed.shape != (4,) or abs(total - 2 * np.pi * np.rint(total / (2 * np.pi))) > 1e-9:
        raise InvariantError("closed loop", "the steps do not close", "four that sum to a multiple of 360 degrees")
    if lam == 0.0:
        raise InvariantError("cone angle", "at lambda = 0 the linkage is at a dead point", "a cone angle above 0")
    start = joint_axes(azimuths(signed), lam)
    o, a0, b0, c = start
    dihedral = dihedral_angles(signed, lam)
    theta0, xi0, psi0 = float(dihedral[0]), float(dihedral[1]), float(np.pi - dihedral[3])
    links = link_angles(np.roll(signed, 1), lam)
    both = np.array([output_spherical(links, theta0, branch) for branch in (1, -1)])
    branch = 1 if abs(wrapped(both[0] - psi0)) <= abs(wrapped(both[1] - psi0)) else -1
    theta = theta0 + np.asarray(turns, dtype=float)
    psi = psi0 + wrapped(output_spherical(links, theta, branch) - psi0)
    a = rotated(a0, o, theta - theta0)
    b_by_output = rotated(b0, c, psi - psi0)
    loop = np.stack(np.broadcast_arrays(o, a, b_by_output, c), axis=-2)
    xi = xi0 + wrapped(measured_dihedral_angles(loop)[..., 1] - xi0)
    b = rotated(rotated(b0, o, theta - theta0), a, xi - xi0)
    axes = np.stack(np.broadcast_arrays(o, a, b, c), axis=-2)
    axes = np.where(np.isnan(psi)[..., np.newaxis, np.newaxis], np.nan, axes)
    residual = np.linalg.norm(b - b_by_output, axis=-1)
    return FourBarConfigurations(theta, psi, xi, (theta0, psi0, xi0), axes, residual)
