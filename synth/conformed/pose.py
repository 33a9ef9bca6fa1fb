"""The conformed pose in space: joint axes, dihedral angles, a check in 3-D; poses of four-bars away from it.

Frame of Hyatt et al. 2020: apex at the origin, the y axis along the cone's axis, away from the cone. The joint
at azimuth t has the axis R_y(t) O with O = (0, -sin lambda, cos lambda) (Eq. 17), outward from the apex. Theory:
docs/theory/conformed.md, docs/theory/four-bars.md.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError
from graphs.geometry import across, rotated, sectors, unit
from graphs.mechanism.surfaces import checked_cone_angle, joint_axes
from graphs.types import Floats
from synth.fourbar.position import output_spherical
from synth.surfaces.circuit import azimuths, link_angles, wrapped


@dataclass(frozen=True, slots=True)
class PoseCheck:
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


def dihedral_angles(steps: npt.ArrayLike, cone_angle: npt.ArrayLike) -> Floats:
    """Return the dihedral angle at each joint of loops: float[..., n].

    Hyatt et al. 2020, Eqs. 13, 14 and Table 2, put right. Right-handed about the outward joint axis, from the
    plane of link i - 1 to that of link i, in (-pi, pi]. With a and b the two steps, cos(theta) = (cos e - cos f1
    cos f2) / (sin f1 sin f2), e being the link angle of a + b, and the sign is that of a b (a + b)
    (docs/misprints.md 000-3, 000-4). sin(theta) is here the volume of the three axes by the same denominator; so
    no digits are lost.

    Parameters
    ----------
    steps : float[..., n]
        Signed projected angles in loop order, radians; joint i lies between steps i - 1 and i.
    cone_angle : float[...]

    Examples
    --------
    >>> theta = dihedral_angles(np.radians([40, 60, -100]), np.radians(20))
    >>> float(np.degrees(theta[1]).round(6))
    161.733801
    """
    b = np.asarray(steps, dtype=float)
    a = np.roll(b, 1, axis=-1)
    lam = checked_cone_angle(cone_angle)[..., np.newaxis]
    half = np.sin(a / 2), np.sin(b / 2), np.sin((a + b) / 2)
    c2 = np.cos(lam) ** 2
    volume = 4 * np.sin(lam) * c2 * half[0] * half[1] * half[2]
    # cos e - cos f1 cos f2 with cos f = 1 - 2 c2 sin(f_0 / 2)^2
    flat = 2 * c2 * (half[0] ** 2 + half[1] ** 2 - half[2] ** 2) - 4 * (c2 * half[0] * half[1]) ** 2
    return np.asarray(np.arctan2(volume, flat))


def measured_dihedral_angles(axes: npt.ArrayLike) -> Floats:
    """Return the measured dihedral angles of closed loops of axes in space, as `dihedral_angles`: float[..., n].

    Parameters
    ----------
    axes : float[..., n, 3]
        Joint axes in loop order, in any pose.

    Examples
    --------
    >>> np.degrees(measured_dihedral_angles(np.eye(3))).tolist()
    [-90.0, -90.0, -90.0]
    """
    e = np.asarray(axes, dtype=float)
    u, v = across(np.roll(e, 1, axis=-2), e), across(np.roll(e, -1, axis=-2), e)
    return np.asarray(np.arctan2((np.cross(u, v) * unit(e)).sum(axis=-1), (u * v).sum(axis=-1)))


def check_pose(angles: npt.ArrayLike, steps: npt.ArrayLike, cone_angle: npt.ArrayLike) -> PoseCheck:
    """Build mapped loops in space and measure them.

    Parameters
    ----------
    angles, steps : float[..., n]
        Required link angles, and signed projected angles, radians.
    cone_angle : float[...]

    Examples
    --------
    >>> from synth.surfaces import map_to_cones
    >>> angles = np.radians([120, 95, 45, 85])
    >>> cone = map_to_cones(angles).cones[0]
    >>> bool(check_pose(angles, cone.steps, cone.size).link_angles < 1e-12)
    True
    """
    axes = joint_axes(azimuths(steps), cone_angle)
    measured = sectors(axes)
    lam = np.asarray(cone_angle, dtype=float)[..., np.newaxis]
    tilt = np.arctan2(-axes[..., 1], np.hypot(axes[..., 0], axes[..., 2]))
    return PoseCheck(
        np.abs(measured - np.asarray(angles, dtype=float)).max(axis=-1), np.abs(tilt - lam).max(axis=-1)
    )


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

    Eqs. 22 and 23 take gamma_0 and beta_0 the other way round; in one loop direction C = R_y(-gamma_0) O
    (docs/misprints.md 000-2). The branch is that of the conformed pose.

    Parameters
    ----------
    steps : float[4]
        Projected angles in loop order alpha_0 (O to A), eta_0, beta_0, gamma_0 (C to O), radians; their sum is a
        multiple of 2 pi, else `InvariantError`.
    cone_angle : float
        lambda > 0: at 0 the linkage is at a dead point.
    turns : float[M]
        Input angles from the conformed pose, radians.

    Examples
    --------
    >>> poses = poses_from_conformed(np.radians([50, 110, 80, 120]), np.radians(20), np.radians([-30, 30]))
    >>> np.degrees(poses.psi - poses.conformed[1]).round(4).tolist()
    [-11.1118, 34.9421]
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
    return FourBarPoses(theta, psi, xi, (theta0, psi0, xi0), axes, residual)
