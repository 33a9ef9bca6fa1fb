"""What is seen of a linkage: corners carried by links, faces, lines of joints.

A crease pattern shows its panels. Of other linkages nothing is given but the axes: each joint shows a piece of its
axis, each link the hull of the pieces of its joints, the least body that carries them. Theory:
docs/theory/viewer.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.spatial import ConvexHull

from graphs.convert.duality import SheetMechanism
from graphs.geometry import principal_axes
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import Sheet, sides_of_face
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.motion.linkage import PosedLinkage

__all__ = ["Bodies", "bodies_of_linkage", "bodies_of_sheet", "hull_faces"]

_HALF = 0.2
"""Of the piece of an axis that is shown, in mean distances between the joints of a link."""
_FROM_APEX = (0.35, 1.0)
"""Where all axes pass through one point: from where to where they are shown."""
_AXIS, _BODY = "-", "|"
"""Letters of lines that are no edges of a crease pattern: pieces of axes, sides of bodies."""


@dataclass(frozen=True, slots=True)
class Bodies:
    """Corners, float[V, 3], faces and lines at the configuration, in units of the extent, about the middle.

    Links and joints are indices, -1 for none: the owner of a corner is the link that carries it, a face is (link,
    vertices), and an edge (vertex, vertex, letter of the crease pattern's edge, joint).
    """

    vertices: Floats
    owners: list[int]
    faces: list[tuple[int, list[int]]]
    edges: list[tuple[int, int, str, int]]

    def to_json(self) -> dict[str, Any]:
        """Return plain data: `BodyData` of web/src/page/types.js."""
        return {
            "vertices": self.vertices.tolist(),
            "owners": self.owners,
            "faces": [{"link": link, "vertices": around} for link, around in self.faces],
            "edges": [{"ends": [a, b], "letter": letter, "joint": joint} for a, b, letter, joint in self.edges],
        }


def bodies_of_sheet(sheet: Sheet, mechanism: SheetMechanism, linkage: PosedLinkage) -> Bodies:
    """Return the panels of a crease pattern with coordinates and all its edges, with its mechanism and linkage.

    >>> from graphs.convert.duality import mechanism_of_sheet
    >>> from synth.motion.linkage import linkage_of_sheet
    >>> corners = ((0, 0), (1, 0), (1, 1), (0, 1))
    >>> sheet = Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3)), corners)
    >>> bodies = bodies_of_sheet(sheet, mechanism_of_sheet(sheet), linkage_of_sheet(sheet))
    >>> bodies.owners, bodies.edges
    ([0, 0, 0, 1], [(0, 2, 'V', 0)])
    """
    assert sheet.coordinates is not None
    column = {joint: place for place, joint in enumerate(linkage.graph.joints)}
    joint_at = {frozenset(edge): column[joint] for joint, edges in mechanism.pieces.items() for edge in edges}
    owners = [-1] * sheet.vertices
    faces = []
    for link, panel in enumerate(mechanism.panels):
        for face in panel:
            faces.append((link, list(sheet.faces[face])))
            for vertex in sheet.faces[face]:
                owners[vertex] = link if owners[vertex] < 0 else owners[vertex]
    edges = [
        (a, b, letter, joint_at.get(frozenset((a, b)), -1))
        for (a, b), letter in zip(sheet.edges, sheet.assignments, strict=True)
    ]
    local = (in_space(sheet.coordinates) - linkage.middle) / linkage.extent
    return Bodies(local, owners, faces, edges)


def bodies_of_linkage(linkage: PosedLinkage) -> Bodies:
    """Return bodies that carry the axes of a linkage.

    A link with two skew axes is a tetrahedron:

    A link with two skew axes is a tetrahedron:

    >>> from graphs.mechanism.sc import SCGraph
    >>> from synth.motion.linkage import linkage_of_axes
    >>> axes = {0: ((0, 0, 0), (0, 0, 1)), 1: ((1, 0, 0), (0, 1, 0))}
    >>> bodies = bodies_of_linkage(linkage_of_axes(SCGraph(3, [(0, 1), (1, 2)]), axes))
    >>> [len([link for link, _ in bodies.faces if link == one]) for one in range(3)]
    [0, 4, 0]
    """
    number = {link: place for place, link in enumerate(linkage.graph.nodes)}
    ends = _pieces(linkage)
    vertices: list[Floats] = []
    owners: list[int] = []
    faces: list[tuple[int, list[int]]] = []
    edges: list[tuple[int, int, str, int]] = []
    shown: set[int] = set()
    for link in linkage.graph.nodes:
        joints = [place for place, pair in enumerate(linkage.graph.joints.values()) if link in pair]
        first = len(owners)
        corners = ends[joints].reshape(-1, 3)
        vertices.append(corners)
        owners += [number[link]] * len(corners)
        for place, joint in enumerate(joints):
            if joint not in shown:
                edges.append((first + 2 * place, first + 2 * place + 1, _AXIS, joint))
                shown.add(joint)
        hull = [[first + corner for corner in face] for face in hull_faces(corners)]
        faces += [(number[link], face) for face in hull]
        sides = {(min(side), max(side)) for face in hull for side in sides_of_face(face)}
        sides -= {(first + 2 * place, first + 2 * place + 1) for place in range(len(joints))}  # those are axes
        edges += [(a, b, _BODY, -1) for a, b in sorted(sides)]
    return Bodies(np.concatenate([np.zeros((0, 3)), *vertices]), owners, faces, edges)


def hull_faces(corners: Floats) -> list[list[int]]:
    """Return the faces of the convex hull of points, float[n, 3].

    There is one polygon for planar points, none for points on a line.
    """
    if len(corners) < 3:
        return []
    sizes, axes = principal_axes(corners)
    spread = sizes > DOUBLE.same_point * max(float(sizes[0]), DOUBLE.same_point)
    if not spread[1]:
        return []
    if spread[2]:
        return [[int(corner) for corner in face] for face in ConvexHull(corners).simplices]
    around = [int(corner) for corner in ConvexHull(corners @ axes[:2].T).vertices]
    at = around.index(min(around))
    around = around[at:] + around[:at]
    return [around if around[1] < around[-1] else [around[0], *around[:0:-1]]]


def _pieces(linkage: PosedLinkage) -> Floats:
    """Return the ends of the pieces of the axes that are shown: float[J, 2, 3]."""
    points, directions = linkage.points, linkage.directions
    if np.abs(points - points.mean(axis=0)).max(initial=0.0) <= DOUBLE.same_point:
        return points[:, None] + np.array(_FROM_APEX)[:, None] * directions[:, None]
    apart = np.array([np.linalg.norm(points[one] - points[other]) for one, other in _together(linkage)])
    apart = apart[apart > DOUBLE.same_point]
    half = _HALF * (float(apart.mean()) if len(apart) else 1.0)
    return points[:, None] + np.array([-half, half])[:, None] * directions[:, None]


def _together(linkage: PosedLinkage) -> list[tuple[int, int]]:
    """Return pairs of places of joints that a link has next to each other in its list."""
    of: dict[Any, list[int]] = {link: [] for link in linkage.graph.nodes}
    for place, pair in enumerate(linkage.graph.joints.values()):
        for link in pair:
            of[link].append(place)
    return [(one, other) for places in of.values() for one, other in pairwise(places)]
