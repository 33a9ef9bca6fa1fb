"""Loops round the boundaries of a sheet, and the centres that geometry gives them.

Round a hole or a cut the creases that end there make a loop of panels that no vertex is the centre of. Where their
lines are parallel it is planar, where they meet in one point spherical, as they lie and as they fold: adjacent
lines belong to one panel and keep their place to each other. Theory: docs/theory/crease-patterns.md.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from graphs.arrays import Floats
from graphs.loops.loop import Centre
from graphs.mechanism.precision import extent_of, precision_of_sheet
from graphs.mechanism.sheet import Edge, Sheet, sides_of_face

__all__ = ["Hinged", "axes_meet", "boundary_walks", "centre_of_axes"]

_MEANT = 1e-6
"""Lines that are off by less than this, in units of the extent, are meant to be parallel or to meet."""
_NOISE = 6.0
_FARTHEST = 1e3
"""A point where lines meet that is farther than this, in units of the extent, is not told from infinity."""


@dataclass(frozen=True)
class Hinged:
    """What hangs on what in a sheet.

    Attributes
    ----------
    faces_at : mapping of edge to faces
    joint_of_edge : mapping of edge to joint id or None
        Of the hinges; None for one inside a panel. Edges inside a panel that are no hinges are not in it.
    panel_of_face : sequence of int
    """

    faces_at: Mapping[Edge, Sequence[int]]
    joint_of_edge: Mapping[Edge, int | None]
    panel_of_face: Sequence[int]

    def across(self, edge: Edge, face: int) -> int | None:
        """Return the face beyond an edge, or None at a border or a cut."""
        here = self.faces_at[edge]
        if len(here) < 2:
            return None
        other = here[0] if here[1] == face else here[1]
        joined = edge in self.joint_of_edge or self.panel_of_face[other] == self.panel_of_face[face]
        return other if joined else None


def boundary_walks(sheet: Sheet, hinged: Hinged) -> list[list[tuple[int, int]]]:
    """Return a walk along each boundary, of a hole, a cut or the whole: the creases that end there, in order.

    Returns
    -------
    list of list of (panel entered, joint crossed)

    Examples
    --------
    Two squares side by side; along their border the crease between them is passed twice:

    >>> sheet = Sheet(6, (), "", ((0, 1, 4, 3), (1, 2, 5, 4)))
    >>> faces_at = {side: [0] for side in ((0, 1), (3, 4), (0, 3))} | {side: [1] for side in ((1, 2), (2, 5), (4, 5))}
    >>> boundary_walks(sheet, Hinged(faces_at | {(1, 4): [0, 1]}, {(1, 4): 7}, (0, 1)))
    [[(1, 7), (0, 7)]]
    """
    edges_at: dict[tuple[int, int], tuple[Edge, Edge]] = {}
    for index, face in enumerate(sheet.faces):
        sides = [(a, b) if a < b else (b, a) for a, b in sides_of_face(face)]
        for i, vertex in enumerate(face):
            edges_at[index, vertex] = sides[i - 1], sides[i]
    walks = []
    seen: set[tuple[int, Edge]] = set()
    for edge, faces in hinged.faces_at.items():
        for face in faces:
            if (face, edge) not in seen and hinged.across(edge, face) is None:
                walks.append(_along(face, edge, edges_at, hinged, seen))
    return walks


def _along(
    face: int,
    edge: Edge,
    edges_at: Mapping[tuple[int, int], tuple[Edge, Edge]],
    hinged: Hinged,
    seen: set[tuple[int, Edge]],
) -> list[tuple[int, int]]:
    """Walk along a boundary from one of its sides, and mark the sides that are passed."""
    walk: list[tuple[int, int]] = []
    ahead = edge[1]
    while (face, edge) not in seen:
        seen.add((face, edge))
        while True:
            one, two = edges_at[face, ahead]
            edge = two if edge == one else one
            beyond = hinged.across(edge, face)
            if beyond is None:
                break
            face = beyond
            joint = hinged.joint_of_edge.get(edge)
            if joint is not None:
                walk.append((hinged.panel_of_face[face], joint))
        ahead = edge[0] if edge[1] == ahead else edge[1]
    return walk


def centre_of_axes(sheet: Sheet, hinges: Sequence[Edge]) -> Centre:
    """Return where the lines of hinges meet, as far as the coordinates tell: in a point, at infinity, or nowhere.

    Parameters
    ----------
    sheet : Sheet
        With coordinates.
    hinges : sequence of (vertex, vertex)
        Two at least.

    Examples
    --------
    >>> sheet = Sheet(6, (), "", (), ((0, 0), (1, 0), (0, 1), (2, 1), (0, 3), (1, 3)))
    >>> centre_of_axes(sheet, [(0, 1), (2, 3), (4, 5)])
    <Centre.INFINITE: 'infinite'>
    """
    points = np.zeros((sheet.vertices, 3))
    given = np.asarray(sheet.coordinates, dtype=float)
    points[:, : given.shape[1]] = given
    tolerance = _NOISE * max(precision_of_sheet(sheet).size, _MEANT / _NOISE)
    return axes_meet((points - points.mean(axis=0)) / extent_of(points), hinges, tolerance)


def axes_meet(points: Floats, hinges: Sequence[Edge], tolerance: float) -> Centre:
    """Return where lines through pairs of points meet, within a tolerance for each point."""
    ends = np.array(hinges)
    start, along = points[ends[:, 0]], points[ends[:, 1]] - points[ends[:, 0]]
    lengths = np.linalg.norm(along, axis=1)
    if not lengths.all():
        return Centre.NONE
    direction = np.linalg.svd(along)[2][0]
    if (np.linalg.norm(np.cross(along, direction), axis=1) <= 2 * tolerance).all():
        return Centre.INFINITE
    units = along / lengths[:, None]
    across = np.eye(3) - units[:, :, None] * units[:, None, :]
    solved, _, rank, _ = np.linalg.lstsq(
        across.reshape(-1, 3), np.einsum("jab,jb->ja", across, start).ravel(), rcond=1e-9
    )
    if rank < 3 or np.abs(solved).max() > _FARTHEST:
        return Centre.NONE
    off = np.linalg.norm(np.einsum("jab,jb->ja", across, solved - start), axis=1)
    reach = np.linalg.norm(solved - (start + along / 2), axis=1)
    return Centre.FINITE if (off <= tolerance * (1 + 2 * reach / lengths)).all() else Centre.NONE
