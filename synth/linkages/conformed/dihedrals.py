"""Dihedral angles of loops at their conformed position.

Frame of Hyatt et al. 2020: apex at the origin, the y axis along the cone's axis, away from the cone. The joint
at azimuth t has the axis R_y(t) O with O = (0, -sin lambda, cos lambda) (Eq. 17), outward from the apex. Theory:
docs/theory/conformed.md, docs/theory/four-bars.md.
"""

import numpy as np
import numpy.typing as npt

from graphs.mechanism.surfaces import checked_cone_angle
from graphs.types import Floats


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
