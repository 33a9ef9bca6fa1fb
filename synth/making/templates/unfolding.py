"""Panels in space laid out in the plane: in nets, as large as they can be without a panel over another.

Links of a spherical linkage become panels here too, from its centre out along the axes.

Theory: docs/theory/templates.md.
"""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from heapq import heappop, heappush
from itertools import combinations, pairwise, product
from math import atan2
from typing import Any

import numpy as np
import shapely

from graphs.errors import UnsolvableError, shown
from graphs.geometry import across, angles_between, area_vector, frame_about, lines_meet, unit
from graphs.mechanism.sheet import COLLINEAR, FLAT, Sheet, sides_of_face
from graphs.mechanism.solids import HingedSolids
from graphs.tolerances import DOUBLE, leading, trailing
from graphs.types import Floats, JointId
from synth.making.templates.pieces import edges_once, lies_over


class Plane:
    """A frame in the plane of a panel with corners float[corners, 3]; its origin is the mean of the corners.

    The columns of `axes`, float[3, 3], are two axes in the plane and the unit normal, round which the corners go
    counter-clockwise; `flat`, float[corners, 2], are the corners in the frame. Raise UnsolvableError, with the
    number of the panel, if the corners lie in no plane or in a line, a side has no length, or sides cross.
    """

    def __init__(self, corners: Floats, face: int) -> None:
        self.origin: Floats = corners.mean(axis=0)
        arms = corners - self.origin
        area = 2 * area_vector(corners)
        size = float(np.abs(arms).max())
        if np.linalg.norm(area) <= COLLINEAR * size**2:
            raise UnsolvableError(f"panel {face} has no area")
        normal = unit(area)
        if float(np.abs(arms @ normal).max()) > DOUBLE.flat * size:
            raise UnsolvableError(f"panel {face} is not planar, so it cannot be cut from a sheet")
        along = unit(across(np.eye(3)[trailing(np.abs(normal))], normal))
        self.axes: Floats = np.column_stack([along, np.cross(normal, along), normal])
        self.flat: Floats = arms @ self.axes[:, :2]
        self.normal: Floats = self.axes[:, 2]
        if np.linalg.norm(self.flat - np.roll(self.flat, -1, axis=0), axis=1).min() <= DOUBLE.same_point * size:
            raise UnsolvableError(f"panel {face} has a side without length")
        if not shapely.Polygon(self.flat).is_valid:
            raise UnsolvableError(f"the border of panel {face} crosses or touches itself, so it cannot be cut out")


_CUT = "BC"


class Panels:
    """The panels of a sheet with all edges listed, each in its own plane, at places float[vertices, 3].

    `joins` maps each edge at which two panels hang together to these, `slits` each edge between two that is cut.
    Raise UnsolvableError if a panel is not planar, or more than two meet in an edge.
    """

    def __init__(self, sheet: Sheet, places: Floats) -> None:
        self.sheet, self.places = sheet, places
        self.planes = tuple(Plane(places[list(around)], face) for face, around in enumerate(sheet.faces))
        faces: dict[frozenset[int], list[int]] = defaultdict(list)
        for face, around in enumerate(sheet.faces):
            for side in sides_of_face(around):
                faces[frozenset(side)].append(face)
        self.joins: dict[int, tuple[int, int]] = {}
        self.slits: dict[int, tuple[int, int]] = {}
        for edge, letter in edges_once(sheet):
            a, b = sheet.edges[edge]
            at = faces[frozenset((a, b))]
            if len(at) > 2:
                panels = f"{len(at)} panels meet in the edge from vertex {a} to {b}"
                raise UnsolvableError(f"{panels}; expected at most 2")
            if len(at) == 2:
                (self.slits if letter in _CUT else self.joins)[edge] = (at[0], at[1])

    def ends(self, face: int, edge: int) -> tuple[int, int]:
        """Return which corners of a face the ends of an edge are, in the order of the face."""
        around = self.sheet.faces[face]
        a, b = (around.index(vertex) for vertex in self.sheet.edges[edge])
        return (a, b) if (a + 1) % len(around) == b else (b, a)

    def go_one_way(self, edge: int) -> bool:
        """Check whether both panels at an edge pass it from the same end: one of them is seen from behind then."""
        first, second = (self.sheet.faces[face][self.ends(face, edge)[0]] for face in self.joins[edge])
        return first == second

    def fold_angle(self, edge: int) -> float:
        """Return how far two panels are folded, radians, valleys positive."""
        first, second = self.joins[edge]
        a, b = (self.sheet.faces[first][corner] for corner in self.ends(first, edge))
        along = unit(self.places[b] - self.places[a])
        normal = self.planes[first].normal
        other = self.planes[second].normal * (-1 if self.go_one_way(edge) else 1)
        return -atan2(along @ np.cross(normal, other), normal @ other)


class Net:
    """Panels laid out beside each other, from one on over those that are left: the corners of each face.

    `corners` are float[corners, 2]; `turned`: the face is seen from behind, as one whose corners go the other way
    round than its neighbour's.
    """

    def __init__(self, panels: Panels, root: int, left: set[int], edges_at: Mapping[int, Sequence[int]]) -> None:
        self.corners, self.turned = {root: panels.planes[root].flat}, {root: False}
        polygons = self.polygons()
        waiting: list[tuple[tuple[bool, float, int], int, int]] = []

        def reach(face: int) -> None:
            for edge in edges_at[face]:
                heappush(waiting, (_rank(panels, edge), edge, face))

        reach(root)
        while waiting:
            _, edge, face = heappop(waiting)
            other = sum(panels.joins[edge]) - face
            if other not in left or other in self.corners:
                continue
            laid, flipped = laid_across(panels, edge, face, self.corners[face], turned=self.turned[face])
            polygon = shapely.Polygon(laid)
            if lies_over(polygon, polygons):
                continue
            self.corners[other], self.turned[other] = laid, flipped
            polygons.append(polygon)
            reach(other)

    def polygons(self) -> list[Any]:
        """Return the panels as shapely polygons."""
        return [shapely.Polygon(corners) for corners in self.corners.values()]


def nets_of(panels: Panels) -> list[Net]:
    """Return nets of all panels: each begins with the largest panel left, and grows over the longest edges.

    A panel that would lie over another waits for another of its edges, and else begins a net of its own. Panels
    that hang together flat are laid first, so that no rigid part is cut where that can be helped.
    """
    edges_at: dict[int, list[int]] = defaultdict(list)
    for edge, faces in panels.joins.items():
        for face in faces:
            edges_at[face].append(edge)
    areas = np.array([shapely.Polygon(plane.flat).area for plane in panels.planes])
    left = set(range(len(panels.planes)))
    nets = []
    while left:
        faces_left = sorted(left)
        root = faces_left[leading(areas[faces_left])]
        net = Net(panels, root, left, edges_at)
        left -= set(net.corners)
        nets.append(net)
    return nets


def _rank(panels: Panels, edge: int) -> tuple[bool, float, int]:
    """Order edges: those that are flat first, then the longest."""
    a, b = panels.sheet.edges[edge]
    length = float(np.linalg.norm(panels.places[a] - panels.places[b]))
    return panels.sheet.assignments[edge] not in FLAT, -round(length, 9), edge


def laid_across(panels: Panels, edge: int, face: int, laid: Floats, *, turned: bool) -> tuple[Floats, bool]:
    """Return the laid corners of the panel across an edge, and whether it is seen from behind.

    `face` is the panel already laid, `laid` its corners, float[corners, 2]; `turned`: it is seen from behind.
    """
    other = sum(panels.joins[edge]) - face
    a, b = panels.ends(face, edge)
    c, d = panels.ends(other, edge)
    same_way = panels.go_one_way(edge)
    flipped = turned != same_way
    flat = panels.planes[other].flat * ((-1, 1) if flipped else (1, 1))
    if not same_way:
        c, d = d, c
    was, now = flat[d] - flat[c], laid[b] - laid[a]
    # As complex numbers, the turn that takes one side to the other.
    turn = complex(*now) / complex(*was)
    turn /= abs(turn)
    matrix = np.array([[turn.real, turn.imag], [-turn.imag, turn.real]])
    moved: Floats = (flat - flat[c]) @ matrix + laid[a]
    return moved, flipped


_CHOSEN = 12
"""Most joints of which all choices of ends are tried."""


def panels_about_centre(linkage: HingedSolids) -> tuple[Sheet, dict[tuple[int, int], JointId]]:
    """Return the links of a spherical linkage as panels in space, and the joint of each edge along an axis.

    A link of two joints is a triangle at the centre, one of more a pyramid without a base, which is rigid; no two
    links share a vertex. Edges go from the centre outwards. Of each axis the end is taken that keeps the angles at
    the centre small. Raise UnsolvableError if the axes do not meet in one point, or a link has less than two joints.
    """
    chain = linkage.chain
    points, directions = np.array(list(linkage.axes.values())).swapaxes(0, 1)
    meeting = lines_meet(points, directions)
    extent = float(np.abs(points - meeting.point).max())
    if extent <= DOUBLE.same_point:  # all axes are given by the centre: a unit is as good as any
        extent = 1.0
    if not meeting.off.max() <= DOUBLE.meant * extent or meeting.spread <= DOUBLE.zero:
        axes = "of links without panels only those whose axes meet in one point have a template"
        raise UnsolvableError(f"a template requires panels, and {linkage!r} has none; {axes}")
    joints_of = {link: [place for place, ends in enumerate(chain.joints.values()) if link in ends] for link in chain}
    for link, joints in joints_of.items():
        if len(joints) < 2:
            raise UnsolvableError(f"link {shown(link)} has less than two joints, and no panel between axes")
    tips = extent * _near_ends(unit(directions), list(joints_of.values()))
    names, places, faces = list(chain.joints), list[Floats](), list[tuple[int, int, int]]()
    along: dict[tuple[int, int], JointId] = {}
    for joints in joints_of.values():
        centre = len(places)
        ordered = _around(tips, joints)
        places += [meeting.point, *(meeting.point + tips[joint] for joint in ordered)]
        along |= {(centre, centre + 1 + place): names[joint] for place, joint in enumerate(ordered)}
        ends = range(centre + 1, len(places))
        faces += [(centre, one, other) for one, other in pairwise((*ends, ends[0])[: 2 if len(ends) == 2 else None])]
    corners = tuple(map(tuple, np.array(places).tolist()))
    return Sheet(len(corners), tuple(along), "U" * len(along), tuple(faces), corners), along


def _near_ends(directions: Floats, joints_of: Sequence[Sequence[int]]) -> Floats:
    """Return axes, float[J, 3], by those of their ends that are nearest to each other in links."""
    if len(directions) > _CHOSEN:
        return directions
    pairs = np.array([pair for joints in joints_of for pair in combinations(joints, 2)])
    signs = np.array([(1.0, *rest) for rest in product((1.0, -1.0), repeat=len(directions) - 1)])
    one, other = pairs.T
    angles = angles_between(directions[one], directions[other])
    turned = signs[:, one] * signs[:, other] < 0.0
    sums = np.where(turned, np.pi - angles, angles).sum(axis=1)
    return np.asarray(directions * signs[trailing(sums)][:, None])


def _around(tips: Floats, joints: Sequence[int]) -> list[int]:
    """Return joints of a link in their order round the mean of its axes."""
    first, second, _ = frame_about(tips[list(joints)].sum(axis=0))
    return sorted(joints, key=lambda joint: (round(atan2(tips[joint] @ second, tips[joint] @ first), 9), joint))
