"""The conformed pose in space: joint axes, dihedral angles, points of links, and a check of it all in 3-D.

Frame of Hyatt et al. 2020: apex at the origin, the y axis along the cone's axis, away from the cone. The joint
at azimuth t has the axis R_y(t) O with O = (0, -sin lambda, cos lambda) (Eq. 17), outward from the apex. At this
pose Eqs. 17 to 24 need no more; what happens away from it is in `synth.fourbar.position`. Theory:
docs/theory/conformed.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from graphs.geometry import across, sectors, unit
from graphs.mechanism.surfaces import checked_cone_angle, joint_axes
from graphs.types import Floats
from synth.surfaces.circuit import azimuths

__all__ = [
    "PoseCheck",
    "check_pose",
    "dihedral_angles",
    "joint_axes",
    "measured_dihedral_angles",
]


@dataclass(frozen=True, slots=True)
class PoseCheck:
    """How well loops rebuilt in space are what they should be; all in radians.

    Attributes
    ----------
    link_angles : float[...]
        Largest difference between a link angle measured between axes and the one asked for.
    on_cone : float[...]
        Largest difference between an axis' angle with the plane across the cone's axis and lambda.
    """

    link_angles: Floats
    on_cone: Floats


def dihedral_angles(steps: npt.ArrayLike, cone_angle: npt.ArrayLike) -> Floats:
    """Return the dihedral angle at each joint of loops (Hyatt et al. 2020, Eqs. 13, 14 and Table 2, put right).

    Parameters
    ----------
    steps : float[..., n]
        Signed projected angles in loop order, radians; joint i lies between steps i - 1 and i.
    cone_angle : float[...]

    Returns
    -------
    float[..., n]
        Right-handed about the outward joint axis, from the plane of link i - 1 to that of link i, in (-pi, pi].

    Notes
    -----
    With a and b the two steps, cos(theta) = (cos e - cos f1 cos f2) / (sin f1 sin f2), e being the link angle of
    a + b, and the sign is that of a b (a + b) (docs/misprints.md 000-3, 000-4). sin(theta) is here the volume of
    the three axes, 4 sin(lambda) cos(lambda)^2 sin(a/2) sin(b/2) sin((a + b)/2), by the same denominator; so no
    digits are lost.

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
    """Return the dihedral angles of closed loops of axes in space, measured.

    Parameters
    ----------
    axes : float[..., n, 3]
        Joint axes in loop order, in any pose.

    Returns
    -------
    float[..., n]
        As in `dihedral_angles`.

    Examples
    --------
    >>> corner = np.eye(3)
    >>> np.degrees(measured_dihedral_angles(corner)).tolist()
    [-90.0, -90.0, -90.0]
    """
    e = np.asarray(axes, dtype=float)
    u, v = across(np.roll(e, 1, axis=-2), e), across(np.roll(e, -1, axis=-2), e)
    return np.asarray(np.arctan2((np.cross(u, v) * unit(e)).sum(axis=-1), (u * v).sum(axis=-1)))


def check_pose(angles: npt.ArrayLike, steps: npt.ArrayLike, cone_angle: npt.ArrayLike) -> PoseCheck:
    """Build mapped loops in space and measure them.

    Parameters
    ----------
    angles : float[..., n]
        Link angles that are asked for, radians.
    steps : float[..., n]
        Signed projected angles.
    cone_angle : float[...]

    Examples
    --------
    >>> from synth.surfaces.cone import map_to_cones
    >>> angles = np.radians([120, 95, 45, 85])
    >>> (first, _) = map_to_cones(angles).cones
    >>> check = check_pose(angles, first.steps, first.size)
    >>> bool(check.link_angles < 1e-12), bool(check.on_cone < 1e-15)
    (True, True)
    """
    axes = joint_axes(azimuths(steps), cone_angle)
    measured = sectors(axes)
    lam = np.asarray(cone_angle, dtype=float)[..., np.newaxis]
    tilt = np.arctan2(-axes[..., 1], np.hypot(axes[..., 0], axes[..., 2]))
    return PoseCheck(
        np.abs(measured - np.asarray(angles, dtype=float)).max(axis=-1), np.abs(tilt - lam).max(axis=-1)
    )
