"""Spherical RR dyads that guide a body through orientations.

A dyad has a fixed axis G and a moving axis W of the body; it guides the body through orientations M_1, ..., M_n if
the angle between G and M_i W, that of its link, stays the same: G . (M_i - M_1) W = 0. Of three orientations the
fixed axis may be chosen; four leave a curve (``synth.guidance.four``), five at most six dyads
(``synth.guidance.five``), and more are met by least squares (``synth.guidance.many``). Theory:
docs/theory/dyads.md.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import degrees
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.errors import UnsolvableError
from graphs.geometry import facing, principal_axes
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.guidance.hoop_method import Direction
from synth.guidance.order import crank_angles, nearest_moving_axis, order_by_crank_angles
from synth.guidance.orientations import Orientations, unit_vector

__all__ = ["Dyad", "dyad_of", "dyads_of_three"]


@dataclass(frozen=True, slots=True, eq=False)
class Dyad:
    """A dyad and how it takes the orientations.

    Attributes
    ----------
    fixed : float[3]
        G, in the fixed frame. Of the two ends of the axis the one whose largest component is positive.
    moving : float[3]
        W, in the body, chosen likewise.
    residual : float
        Largest ``|G . (M_i - M_1) W|``, of unit vectors.
    link_angle : float
        Mean angle between the axes, radians.
    misfit : float
        Largest difference between that angle at an orientation and its mean, radians.
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
        """Return the keys of a dyad that scripts rely on (docs/command-json.md)."""
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
    """Return the dyad with given axes, with its residual and its order.

    Parameters
    ----------
    orientations : Orientations
    fixed : float[3]
        G, in the fixed frame.
    moving : float[3]
        W, in the body.

    Raises
    ------
    InvariantError
        If an axis has no direction.

    Examples
    --------
    >>> turns = Orientations.from_axis_angles([(0, 0, 1)] * 3, [0, 1.0, 4.0])
    >>> dyad = dyad_of(turns, (0, 0, -1), (0, 3, 4))
    >>> dyad.fixed.tolist(), dyad.direction, dyad.residual < 1e-15
    ([0.0, 0.0, 1.0], 'ccw', True)
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
    """Return the dyads of three orientations whose fixed axes are chosen; there is one for each.

    Parameters
    ----------
    orientations : Orientations
        Three of them.
    fixed_axes : iterable of float[3]
        Of any length but zero.

    Returns
    -------
    tuple of Dyad
        In the order of the axes.

    Raises
    ------
    InvariantError
        If an axis has no direction.
    UnsolvableError
        If there are not three orientations, or if a fixed axis lies on a relative axis: a whole plane of moving
        axes keeps its angle with it.

    Examples
    --------
    >>> orientations = Orientations.from_axis_angles(np.eye(3), [0.0, 0.5, 0.7])
    >>> [dyad] = dyads_of_three(orientations, [(1, 2, 3)])
    >>> dyad.residual < 1e-15
    True
    """
    if len(orientations) != 3:
        raise UnsolvableError(f"{len(orientations)} orientations do not leave the fixed axis to be chosen; 3 do")
    found = []
    for axis in fixed_axes:
        g = unit_vector(axis, "fixed axis")
        seen = orientations.matrices.transpose(0, 2, 1) @ g
        if principal_axes(seen)[0][1] < DOUBLE.same_point:
            raise UnsolvableError(
                "the fixed axis leaves its moving axis open: it lies on a relative axis; move the axis off it"
            )
        found.append(dyad_of(orientations, g, nearest_moving_axis(orientations, g)))
    return tuple(found)
