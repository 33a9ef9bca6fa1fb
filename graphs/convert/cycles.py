"""Cycles of joints in a sheet: round interior vertices, along boundaries; the centres that geometry gives them.

Round a hole or a cut the creases that end there make a loop of panels about no vertex. Where their lines are
parallel it is planar, where they meet in one point spherical, at this configuration and folded: adjacent lines
belong to one panel and keep their place to each other. Theory: docs/theory/crease-patterns.md.
"""

from collections import defaultdict
from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from graphs.geometry import common_direction, lines_meet
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.precision import extent_of, in_space, precision_as_written
from graphs.mechanism.sheet import Edge, Sheet, sides_of_face
from graphs.tolerances import DOUBLE, Tolerances
from graphs.types import Floats

# Units of the extent. Lines that meet farther off differ from parallel ones by less than a thousandth of a radian over
# the sheet, and errors of 1e-6 in their directions move the point by the extent: it is no centre that anybody meant.
_FARTHEST = 1e3


def loops_with_centres(sheet: Sheet, cycles: Sequence[tuple[int, ...]], hinges: Mapping[int, Edge]) -> list[Loop]:
    """Return those cycles of joints whose axes are parallel or meet in a point, by the coordinates, as loops."""
    points = in_space(sheet.coordinates or ())
    points = (points - points.mean(axis=0)) / (extent_of(points) or 1.0)
    tolerance = Tolerances.of(precision_as_written(sheet).size).meant
    loops = (Loop(cycle, axes_meet(points, [hinges[joint] for joint in cycle], tolerance)) for cycle in cycles)
    return [loop for loop in loops if loop.has_centre]


def axes_meet(points: Floats, hinges: Sequence[Edge], tolerance: float) -> Centre:
    """Return the centre of two or more lines, each through two points, float[n, 3], with a tolerance for each."""
    ends = np.array(hinges)
    start, along = points[ends[:, 0]], points[ends[:, 1]] - points[ends[:, 0]]
    lengths = np.linalg.norm(along, axis=1)
    if not lengths.all():
        return Centre.NONE
    if (np.linalg.norm(np.cross(along, common_direction(along)), axis=1) <= 2 * tolerance).all():
        return Centre.INFINITE
    meeting = lines_meet(start, along)
    if meeting.spread <= DOUBLE.parallel or np.abs(meeting.point).max() > _FARTHEST:
        return Centre.NONE
    reach = np.linalg.norm(meeting.point - (start + along / 2), axis=1)
    return Centre.FINITE if (meeting.off <= tolerance * (1 + 2 * reach / lengths)).all() else Centre.NONE


@dataclass(frozen=True)
class HingedFaces:
    """The faces of a sheet at each edge, and the panel of each face.

    `joint_of_edge` has the hinges, None for one inside a panel; other edges inside a panel are not in it.
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


def vertex_cycles(sheet: Sheet, hinged: HingedFaces) -> dict[tuple[int, ...], int]:
    """Return the cycles of joints round the interior vertices, and the vertex of each.

    Where a panel comes back to the vertex (its faces are merged elsewhere) the walk falls into several cycles.
    """
    cycles: list[tuple[tuple[int, ...], int]] = []
    for vertex, fan in _closed_fans(sheet, hinged.faces_at):
        walk: list[tuple[int, int]] = []  # (panel entered, joint crossed into it)
        for edge, face in fan:
            if edge in hinged.joint_of_edge:
                joint = hinged.joint_of_edge[edge]
                if joint is not None:
                    walk.append((hinged.panel_of_face[face], joint))
            elif len({hinged.panel_of_face[f] for f in hinged.faces_at[edge]}) > 1:
                break  # a cut: the fan is open after all
        else:
            cycles += [(cycle, vertex) for cycle in simple_cycles(walk)]
    # Hinges that are one joint may meet another joint twice; the loop of the two is one loop.
    distinct = {frozenset(cycle): (cycle, vertex) for cycle, vertex in reversed(cycles)}
    return dict(list(distinct.values())[::-1])


def _sides_in_order(around: Sequence[int]) -> list[Edge]:
    """Return the sides of a face, each with the lesser vertex first; that before a vertex stands before it."""
    return [(a, b) if a < b else (b, a) for a, b in sides_of_face(around)]


def _sides_of_corners(sheet: Sheet) -> dict[tuple[int, int], tuple[Edge, Edge]]:
    """Return the two edges of each face, by its number, at each of its vertices."""
    corners = {}
    for index, around in enumerate(sheet.faces):
        sides = _sides_in_order(around)
        corners.update({(index, vertex): (sides[i - 1], sides[i]) for i, vertex in enumerate(around)})
    return corners


def _closed_fans(sheet: Sheet, faces_at: Mapping[Edge, Sequence[int]]) -> list[tuple[int, list[tuple[Edge, int]]]]:
    """Return each vertex with faces all round, with its edges and the faces entered across them, in order."""
    at_vertex: dict[int, dict[int, tuple[Edge, Edge]]] = defaultdict(dict)
    for index, around in enumerate(sheet.faces):
        sides = _sides_in_order(around)
        for vertex, before, after in zip(around, (sides[-1], *sides), sides, strict=False):
            at_vertex[vertex][index] = before, after
    fans = []
    for centre, sides_of in at_vertex.items():
        left = dict.fromkeys(sides_of)
        while left:
            start = next(iter(left))
            fan = list(_fan(start, sides_of[start][1], sides_of, faces_at))
            if fan and fan[-1][1] == start:
                fans.append((centre, fan))
                if len(fan) == len(sides_of):
                    break
            else:  # its other half is no fan of its own
                fan += _fan(start, sides_of[start][0], sides_of, faces_at)
            for face in (start, *(face for _, face in fan)):
                left.pop(face, None)
    return fans


def _fan(
    start: int, edge: Edge, sides_of: Mapping[int, tuple[Edge, Edge]], faces_at: Mapping[Edge, Sequence[int]]
) -> Iterator[tuple[Edge, int]]:
    """Walk from a face at a vertex across an edge, up to a border or back; yield edges and the faces entered."""
    face = start
    while len(here := faces_at[edge]) == 2:
        face = here[0] if here[1] == face else here[1]
        yield edge, face
        if face == start:
            return
        one, two = sides_of[face]
        edge = two if edge == one else one


def simple_cycles(walk: Sequence[tuple[int, int]]) -> list[tuple[int, ...]]:
    """Cut a closed walk of (panel entered, joint crossed) into cycles that visit each panel once."""
    if len({panel for panel, _ in walk}) == len(walk):
        around = tuple(joint for _, joint in walk)
        return [around] if len(set(around)) == len(around) > 1 else []
    cycles: list[tuple[int, ...]] = []
    path: list[tuple[int, int]] = []
    entered: dict[Hashable, int] = {walk[-1][0]: 0}  # the walk starts in the panel it ends in
    for panel, joint in walk:
        path.append((panel, joint))
        if panel in entered:
            start = entered[panel]
            part = path[start:]
            del path[start:]
            for inner, _ in part:
                if inner != panel:
                    entered.pop(inner, None)
            around = tuple(j for _, j in part)
            if len(set(around)) == len(around) > 1:
                cycles.append(around)
        else:
            entered[panel] = len(path)
    return cycles


def boundary_cycles(sheet: Sheet, hinged: HingedFaces) -> list[tuple[int, ...]]:
    """Return the cycles of joints along boundaries, of holes, cuts and the whole, those of few joints first."""
    edges_at = _sides_of_corners(sheet)
    cycles = []
    seen: set[tuple[int, Edge]] = set()
    for edge, faces in hinged.faces_at.items():
        for face in faces:
            if (face, edge) not in seen and hinged.across(edge, face) is None:
                walk = _along(face, edge, edges_at, hinged, seen)
                cycles += simple_cycles(walk) if walk else []
    distinct = {frozenset(cycle): cycle for cycle in reversed(cycles)}
    return sorted(distinct.values(), key=len)


def _along(
    face: int,
    edge: Edge,
    edges_at: Mapping[tuple[int, int], tuple[Edge, Edge]],
    hinged: HingedFaces,
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
