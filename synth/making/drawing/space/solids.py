"""Shapes of the links of hinged solids: plane faces, the edges between them, and those that lie on hinges."""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, replace

import networkx as nx
import numpy as np

from graphs.geometry import unit
from graphs.mechanism.sheet import sides_of_face
from graphs.mechanism.solids import HingedSolids, LinkShape
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.analysis.motion.linkage import Linkage, placed_links
from synth.making.drawing.space.panels import HINGE, INNER, SpatialPanels


@dataclass(frozen=True, eq=False)
class SolidFaces:
    """The faces of shapes of links, with corners in units of the extent about the middle of the linkage.

    Attributes
    ----------
    corners : float[n, 3]
    owners : list of int
        The place of the link that carries each corner.
    faces : list of (int, list of int)
        Link and corners, counter-clockwise seen from outside: a polygon where a plane face has no holes, else
        triangles.
    sides : list of (int, int)
        Edges between faces that are not in one plane.
    inner : list of (int, int)
        Sides of triangles inside a face.
    hinges : mapping of (int, int) to int
        Sides that lie on the axis of a joint of their link, by the place of the joint.

    Examples
    --------
    >>> import synth
    >>> from synth.analysis.moving._configuration_of import configuration_of
    >>> thick = synth.thicken(synth.generate("miura").mechanism, thickness=0.05, collisions=False).solids
    >>> shown = faces_of_shapes(thick, configuration_of(thick).linkage)
    >>> len(set(shown.hinges.values()))
    12
    """

    corners: Floats
    owners: list[int]
    faces: list[tuple[int, list[int]]]
    sides: list[tuple[int, int]]
    inner: list[tuple[int, int]]
    hinges: dict[tuple[int, int], int]

    def panels(self, linkage: Linkage) -> SpatialPanels:
        """Return the faces as pictures take them."""
        links, joints = list(linkage.graph.nodes), list(linkage.graph.joints)
        letters = dict.fromkeys((frozenset(side) for side in self.inner), INNER)
        joint_of = {frozenset(side): joints[joint] for side, joint in self.hinges.items()}
        return SpatialPanels(
            [tuple(around) for _, around in self.faces],
            {number: links[link] for number, (link, _) in enumerate(self.faces)},
            joint_of, letters | dict.fromkeys(joint_of, HINGE), solid=True,
        )  # fmt: skip

    def places(self, linkage: Linkage, angles: Floats) -> Floats:
        """Return the corners at joint angles float[F, J], radians: float[F, n, 3]."""
        rotations, shifts = placed_links(linkage, angles)
        return np.asarray(np.einsum("fnij,nj->fni", rotations[:, self.owners], self.corners) + shifts[:, self.owners])


def faces_of_shapes(solids: HingedSolids, linkage: Linkage) -> SolidFaces:
    """Return the faces of the shapes of hinged solids, with the linkage of their axes."""
    number = {link: place for place, link in enumerate(linkage.graph.nodes)}
    joints_of: dict[int, list[int]] = defaultdict(list)
    for joint, links in enumerate(linkage.graph.joints.values()):
        for link in links:
            joints_of[number[link]].append(joint)
    shown = SolidFaces(np.zeros((0, 3)), [], [], [], [], {})
    corners = [shown.corners]
    for shape in solids.shapes:
        first, link = len(shown.owners), number[shape.link]
        here = (np.array(shape.corners, dtype=float) - linkage.middle) / linkage.extent
        corners.append(here)
        shown.owners.extend([link] * len(here))
        for group in _plane_groups(shape, here):
            loop = _outline(group)
            shown.faces.extend((link, [first + corner for corner in face]) for face in ([loop] if loop else group))
            around = _border(group)
            shown.sides.extend((first + a, first + b) for a, b in around if a < b)
            if not loop:
                crossed = {side for face in group for side in sides_of_face(face)} - set(around)
                shown.inner.extend((first + a, first + b) for a, b in sorted(crossed) if a < b)
            for joint in joints_of[link]:
                shown.hinges.update({
                    (first + min(side), first + max(side)): joint
                    for side in around if _on_axis(here[list(side)], linkage, joint)
                })  # fmt: skip
    return replace(shown, corners=np.concatenate(corners))


def _plane_groups(shape: LinkShape, corners: Floats) -> list[list[tuple[int, ...]]]:
    """Return the triangles of a shape by the plane faces that they are parts of."""
    triangles = np.array(shape.triangles)
    sides = corners[triangles]
    normals = unit(np.cross(sides[:, 1] - sides[:, 0], sides[:, 2] - sides[:, 0]))
    at: dict[tuple[int, int], int] = {
        side: place for place, triangle in enumerate(shape.triangles) for side in sides_of_face(triangle)
    }
    beside = nx.Graph()
    beside.add_nodes_from(range(len(triangles)))
    for (a, b), place in at.items():
        other = at.get((b, a))
        if other is not None and np.abs(normals[place] - normals[other]).max() <= DOUBLE.meant:
            beside.add_edge(place, other)
    return [[shape.triangles[place] for place in sorted(part)] for part in nx.connected_components(beside)]


def _border(faces: Sequence[Sequence[int]]) -> list[tuple[int, int]]:
    """Return the sides of faces, as they are passed, that no other of them passes the other way."""
    passed = [side for face in faces for side in sides_of_face(face)]
    there = set(passed)
    return [(a, b) for a, b in passed if (b, a) not in there]


def _outline(faces: Sequence[Sequence[int]]) -> list[int]:
    """Return the corners round faces that lie in a plane; none if there are holes, or they touch in a corner."""
    border = _border(faces)
    after = dict(border)
    loop = [min(after)]
    while (following := after[loop[-1]]) != loop[0]:
        if following in loop or following not in after:
            return []
        loop.append(following)
    return loop if len(loop) == len(border) else []


def _on_axis(ends: Floats, linkage: Linkage, joint: int) -> bool:
    """Check whether both ends of a side lie on the axis of a joint."""
    off = np.cross(ends - linkage.points[joint], linkage.directions[joint])
    return bool(np.abs(off).max() <= DOUBLE.meant)
