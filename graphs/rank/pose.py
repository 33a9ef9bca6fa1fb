"""Mobility at a pose: infinitesimal freedoms where the coordinates are, with the evidence.

The closure equations at the axes as they lie have a rank that special geometry may lower: what is gained over the
generic mobility is the overconstraint h = M_actual - M (Wiener 2016, Eq. 8). Freedoms found here are
infinitesimal; a flat sheet has more of them than it can use. Theory: docs/theory/pose.md.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.convert.duality import SheetMechanism, mechanism_of_sheet
from graphs.errors import InvariantError, UnsolvableError
from graphs.ids import JointId
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet, in_one_plane
from graphs.rank.closure import Closure, closure_of
from graphs.rank.fields import Reals
from graphs.rank.general_member import Line, join
from graphs.rank.rods import velocity_constraints
from graphs.rank.singular_values import Spectrum, spectrum

__all__ = [
    "PoseMobility",
    "closure_at_pose",
    "pose_mobility",
    "pose_mobility_of_axes",
    "pose_mobility_of_model",
]


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

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on; a report adds h, the overconstraint against its count."""
        return {
            "dof": self.dof,
            "gap": self.spectrum.gap if np.isfinite(self.spectrum.gap) else None,
            "self_stresses": self.self_stresses,
            "nearly_mobile": self.spectrum.nearly,
            "flat": self.flat,
        }


def pose_mobility(
    sheet: Sheet, mechanism: SheetMechanism | None = None, *, hinge_flat: bool = False
) -> PoseMobility:
    """Return the infinitesimal freedoms of a crease pattern as it lies.

    Parameters
    ----------
    sheet : Sheet
        With coordinates, any unit of length.
    mechanism : SheetMechanism, optional
        Of this sheet, where it is at hand.
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
    closure = closure_at_pose(sheet, mechanism or mechanism_of_sheet(sheet, hinge_flat=hinge_flat))
    evidence = spectrum(dense(closure))
    assert sheet.coordinates is not None
    return _mobility(evidence, len(closure.joints), len(closure.rows), np.asarray(_in_space(sheet.coordinates)))


def pose_mobility_of_axes(
    sc: SCGraph, axes: Mapping[JointId, tuple[Sequence[float], Sequence[float]]]
) -> PoseMobility:
    """Return the infinitesimal freedoms of a linkage whose joint axes are given.

    Every loop closes with six equations here, so centres need not be exact.

    Parameters
    ----------
    sc : SCGraph
    axes : mapping of joint id to (point, direction)
        Three coordinates each, any unit of length.

    Raises
    ------
    InvariantError
        If an axis has no direction.

    Examples
    --------
    A planar four-bar:

    >>> four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
    >>> places = [(0, 0, 0), (3, 0, 0), (4, 2, 0), (0, 1, 0)]
    >>> pose_mobility_of_axes(four_bar, {i: (place, (0, 0, 1)) for i, place in zip(range(4), places)}).dof
    1
    """
    points = np.array([axes[joint][0] for joint in sc.joints], dtype=float).reshape(-1, 3)
    near = _in_space(tuple(map(tuple, points.tolist())))
    lines = {}
    for joint, p in zip(sc.joints, near, strict=True):
        u = np.asarray(axes[joint][1], dtype=float)
        size = float(np.linalg.norm(u))
        if size == 0.0:
            raise InvariantError(
                "axis", f"the axis of joint {joint!r} has no direction", "a vector that is not zero"
            )
        lines[joint] = join((*p, 1.0), (*(np.array(p) + u / size), 1.0), Reals())
    evidence = spectrum(dense(closure_of(SCGraph(sc.nodes, sc.joints), lines, {}, Reals())))
    return _mobility(evidence, len(sc.joints), 6 * sc.independent_loops, points)


def pose_mobility_of_model(model: PolyhedronModel) -> PoseMobility:
    """Return the infinitesimal freedoms of a polyhedron model at its coordinates.

    Links of four vertices or more get a virtual apex, since their vertices may be coplanar.

    Parameters
    ----------
    model : PolyhedronModel
        With coordinates.

    Raises
    ------
    UnsolvableError
        If it has no coordinates, or the bars of a scissors element do not cross there.
    InvariantError
        If a rod has no length.
    """
    if not model.coordinates:
        raise UnsolvableError("the freedoms at a pose need coordinates, and the model has none")
    near = dict(zip(model.coordinates, _in_space(tuple(model.coordinates.values())), strict=True))
    for a, b in model.edges:
        if near[a] == near[b]:
            raise InvariantError("rod", f"the rod between vertices {a!r} and {b!r} has no length")
    rows, points = velocity_constraints(model, near, Reals())
    column: dict[Any, int] = {}
    for row in rows:
        for key in row:
            column.setdefault(key, len(column))
    matrix = np.zeros((len(rows), max(len(column), 1)))
    for i, row in enumerate(rows):
        for key, value in row.items():
            matrix[i, column[key]] = value
    whole = 6 if model.ground is None else 0
    return _mobility(spectrum(matrix), 3 * points - whole, len(rows), np.array(list(near.values())))


def _mobility(evidence: Spectrum, unknowns: int, equations: int, points: npt.NDArray[np.float64]) -> PoseMobility:
    rank = evidence.rank
    return PoseMobility(
        None if rank is None else unknowns - rank,
        None if rank is None else equations - rank,
        evidence,
        in_one_plane(points.tolist()),
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
