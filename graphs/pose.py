"""Mobility at a pose: infinitesimal freedoms where the coordinates are, with the evidence.

The closure equations at the axes as they lie have a rank that special geometry may lower: what is gained over the
generic mobility is the overconstraint h = M_actual - M (Wiener 2016, Eq. 8). Freedoms found here are
infinitesimal; a flat sheet has more of them than it can use. Theory: docs/theory/pose.md.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.closure import Closure, closure_of
from graphs.duality import SheetMechanism, mechanism_of_sheet
from graphs.errors import InvariantError, UnsolvableError
from graphs.fields import Reals
from graphs.loops import JointId
from graphs.mobility import overconstraint
from graphs.realisation import Line, join
from graphs.sheet import Sheet
from graphs.spectrum import Spectrum, spectrum

__all__ = ["PoseMobility", "closure_at_pose", "pose_mobility"]


@dataclass(frozen=True, slots=True)
class PoseMobility:
    """Freedoms at a pose.

    Attributes
    ----------
    dof : int or None
        Infinitesimal freedoms; None where the singular values do not tell: indeterminate.
    self_stresses : int or None
        Equations minus rank: how many closure equations are idle here.
    spectrum : Spectrum
    flat : bool
        Whether all vertices lie in one plane.
    """

    dof: int | None
    self_stresses: int | None
    spectrum: Spectrum
    flat: bool

    def to_json(self, count: int | None) -> dict[str, Any]:
        """Return the keys that scripts rely on; h = M_actual - M is the overconstraint against a count (Eq. 8)."""
        return {
            "dof": self.dof,
            "gap": self.spectrum.gap if np.isfinite(self.spectrum.gap) else None,
            "h": None if self.dof is None or count is None else overconstraint(self.dof, count),
            "self_stresses": self.self_stresses,
            "nearly_mobile": self.spectrum.nearly,
            "flat": self.flat,
        }


def pose_mobility(sheet: Sheet, *, hinge_flat: bool = False) -> PoseMobility:
    """Return the infinitesimal freedoms of a crease pattern as it lies.

    Parameters
    ----------
    sheet : Sheet
        With coordinates, any unit of length.
    hinge_flat : bool, optional
        Make hinges of flat edges too.

    Raises
    ------
    UnsolvableError
        If the sheet has no coordinates.
    InvariantError
        If a hinge has no length.

    Examples
    --------
    A vertex of four creases, folded: three freedoms are taken by its loop.

    >>> sheet = Sheet(5, ((0, 1), (0, 2), (0, 3), (0, 4)), "MVVV", ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)),
    ...               ((0, 0, 0), (1, 0, 0), (0, 1, .2), (-1, 0, .1), (0, -1, .3)))
    >>> pose_mobility(sheet).dof
    1
    """
    found = mechanism_of_sheet(sheet, hinge_flat=hinge_flat)
    closure = closure_at_pose(sheet, found)
    evidence = spectrum(dense(closure))
    rank = evidence.rank
    assert sheet.coordinates is not None
    return PoseMobility(
        None if rank is None else len(closure.joints) - rank,
        None if rank is None else len(closure.rows) - rank,
        evidence,
        is_flat(np.asarray(_in_space(sheet.coordinates))),
    )


def closure_at_pose(sheet: Sheet, found: SheetMechanism) -> Closure:
    """Return the closure equations of a sheet's mechanism as it lies.

    Raises
    ------
    UnsolvableError
        If the sheet has no coordinates.
    InvariantError
        If a hinge has no length.
    """
    if sheet.coordinates is None:
        raise UnsolvableError("the freedoms at a pose need coordinates, and the sheet has none")
    places = _in_space(sheet.coordinates)
    axes = _axes(places, found)
    centres = {
        loop: (*places[vertex], 1.0)
        for loop, vertex in zip(range(len(found.sc.loops)), found.loop_vertices, strict=True)
    }
    return closure_of(found.sc, axes, centres, Reals())


def _in_space(coordinates: tuple[tuple[float, ...], ...]) -> list[tuple[float, float, float]]:
    """Return coordinates in space, in units of their extent, about their middle."""
    points = np.zeros((len(coordinates), 3))
    if coordinates:
        points[:, : len(coordinates[0])] = coordinates
        points -= points.mean(axis=0)
    extent = np.abs(points).max(initial=0.0)
    return [(x, y, z) for x, y, z in (points / (extent or 1.0)).tolist()]


def _axes(places: list[tuple[float, float, float]], found: SheetMechanism) -> Mapping[JointId, Line]:
    axes: dict[JointId, Line] = {}
    for joint, (a, b) in found.hinges.items():
        p, q = np.array(places[a]), np.array(places[b])
        length = float(np.linalg.norm(q - p))
        if length == 0.0:
            raise InvariantError(
                "hinge", f"the crease between vertices {a} and {b} has no length", part=("edges", joint)
            )
        u = (q - p) / length
        axes[joint] = join((*p, 1.0), (*(p + u), 1.0), Reals())
    return axes


def dense(closure: Closure) -> npt.NDArray[np.float64]:
    """Return the matrix of closure equations: float[rows, joints]."""
    matrix = np.zeros((len(closure.rows), len(closure.joints)))
    for i, row in enumerate(closure.rows):
        for j, value in row.items():
            matrix[i, j] = value
    return matrix


def is_flat(points: npt.NDArray[np.float64]) -> bool:
    """Tell whether points lie in one plane, but for a millionth of their extent."""
    if not len(points):
        return True
    sizes = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    return bool(len(sizes) < 3 or sizes[2] <= 1e-6 * max(sizes[0], 1e-300))
