"""Panels as thin solids, their hinges left open, for printers and viewers.

A panel is a plate about its plane. Two plates of thickness t, folded by an angle f, meet within t/2 tan(f/2) of
their hinge; half the gap that is asked for is left away of each. Theory: docs/theory/templates.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely

from graphs.errors import InvariantError, UnsolvableError
from graphs.files.solids.mesh import Mesh
from graphs.geometry import rigid_motion
from graphs.mechanism.sheet import FLAT, Sheet
from graphs.types import Floats
from synth.templates.pieces.overlaps import GRID, united
from synth.templates.pieces.planes import Plane
from synth.templates.pieces.unfolding import Panels, panels_of
from synth.templates.scale import GREATEST

__all__ = ["Plates", "plates_in_space", "plates_of"]

_RIGID = 1e-4
"""A panel that moves keeps its shape but for this part of its extent."""
_STRAIGHT = 1e-6
"""Corners this close to a straight line, in millimetres, are none."""


@dataclass(frozen=True)
class Plates:
    """Panels as solids, each in the frame of its plane at the pose from which the plates are made.

    `faces` gives the panel of each mesh: a panel whose middle is cut off by its hinges has several.
    """

    meshes: tuple[Mesh, ...]
    faces: tuple[int, ...]
    planes: tuple[Plane, ...]

    def motions(self, sheet: Sheet, poses: Floats) -> tuple[Floats, Floats]:
        """Return rotations, float[poses, meshes, 3, 3], and translations, float[poses, meshes, 3], of plates.

        Poses are float[poses, vertices, 3], millimetres. Raise UnsolvableError if a panel has another shape in a
        pose.
        """
        turns = np.empty((len(poses), len(self.faces), 3, 3))
        shifts = np.empty((len(poses), len(self.faces), 3))
        for pose, places in enumerate(poses):
            for mesh, face in enumerate(self.faces):
                corners = places[list(sheet.faces[face])]
                turns[pose, mesh], shifts[pose, mesh] = _frame(
                    corners, self.planes[face], f"{face} in pose {pose}"
                )
        return turns, shifts


def plates_of(sheet: Sheet, places: Floats, *, thickness: float, gap: float) -> Plates:
    """Return the panels of a sheet with all edges listed as plates of a thickness, with a gap at each hinge.

    The places are float[vertices, 3]; all in millimetres. Raise InvariantError if the thickness is not positive,
    the gap negative, or one of them larger than 1e6 mm; UnsolvableError if a panel is not planar, or narrower than
    the gap.
    """
    if not 0 < thickness <= GREATEST:
        raise InvariantError("thickness", f"thickness {thickness!r}", f"a positive number, at most {GREATEST:g}")
    if not 0 <= gap <= GREATEST:
        raise InvariantError("gap", f"gap {gap!r}", f"a number from 0 to {GREATEST:g}")
    panels = panels_of(sheet, places)
    meshes, faces = [], []
    for face in range(len(sheet.faces)):
        for number, polygon in enumerate(_without_hinges(panels, face, gap / 2)):
            name = f"panel {face}" + (f" part {number}" if number else "")
            meshes.append(_plate(polygon, thickness, name))
            faces.append(face)
    return Plates(tuple(meshes), tuple(faces), panels.planes)


def plates_in_space(plates: Plates) -> list[Mesh]:
    """Return plates where their panels stand."""
    placed = zip(plates.meshes, plates.faces, strict=True)
    return [
        Mesh(mesh.name, mesh.corners @ plates.planes[face].axes.T + plates.planes[face].origin, mesh.triangles)
        for mesh, face in placed
    ]


def _without_hinges(panels: Panels, face: int, width: float) -> list[Any]:
    """Return a panel without the strips along its sides where another hangs that moves, or is cut off."""
    corners = panels.planes[face].flat
    rest = shapely.Polygon(corners)
    whole = rest.area
    strips = [
        shapely.LineString(corners[list(panels.ends(face, edge))]).buffer(width, cap_style="square")
        for edge in panels.shared_by(face)
        if panels.sheet.assignments[edge] not in FLAT
    ]
    if width and strips:
        taken = united(strips)
        rest = shapely.difference(rest, taken, grid_size=GRID).simplify(_STRAIGHT)
    parts = [part for part in getattr(rest, "geoms", [rest]) if part.area > _STRAIGHT * whole]
    if not parts:
        raise UnsolvableError(f"panel {face} is narrower than the gap of {2 * width:g} mm at its hinges")
    return parts


def _plate(polygon: Any, thickness: float, name: str) -> Mesh:
    """Return a plate about the plane of a polygon."""
    ring = np.array(shapely.orient_polygons(polygon).exterior.coords)[:-1]
    index = {tuple(corner): number for number, corner in enumerate(ring.tolist())}
    count = len(ring)
    top = [
        [index[tuple(corner)] for corner in shapely.orient_polygons(one).exterior.coords[:-1]]
        for one in shapely.constrained_delaunay_triangles(polygon).geoms
    ]
    triangles = [[corner + count for corner in one] for one in top] + [one[::-1] for one in top]
    for here in range(count):
        after = (here + 1) % count
        triangles += [[here, after, after + count], [here, after + count, here + count]]
    heights = np.repeat([-thickness / 2, thickness / 2], count)
    return Mesh(name, np.column_stack([np.tile(ring, (2, 1)), heights]), np.array(triangles))


def _frame(corners: Floats, plane: Plane, where: str) -> tuple[Floats, Floats]:
    """Return how the frame of a panel stands where its corners are now: its rotation, and its origin."""
    was = np.column_stack([plane.flat, np.zeros(len(plane.flat))])
    turn, shift = rigid_motion(was, corners)
    apart = float(np.abs(was @ turn.T + shift - corners).max())
    if apart > _RIGID * float(np.abs(plane.flat).max()):
        raise UnsolvableError(f"panel {where} has another shape: it is {apart:.3g} mm off")
    return turn, shift
