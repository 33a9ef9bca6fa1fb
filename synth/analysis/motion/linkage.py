"""A linkage at a configuration: links, joint axes, loops that have to close, and links at other joint angles.

Joint angles count from a zero of their own: of a crease, from flat, with valley folds positive, as in FOLD files;
of other joints, from this configuration. Lengths are in units of the extent, about the middle of all points.
Theory: docs/theory/folding.md.
"""

from collections import deque
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import NamedTuple

import networkx as nx
import numpy as np

from graphs.convert.duality import SheetMechanism, mechanism_of_sheet
from graphs.errors import InvariantError, UnsolvableError
from graphs.geometry import lines_meet, rotations, unit
from graphs.loops.loop import Centre, signed_cycle
from graphs.mechanism.precision import extent_of, in_space
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet, corners_of_faces, panel_of_faces, sides_of_face
from graphs.rank.exact import independent_cycles
from graphs.tolerances import DOUBLE, Tolerances
from graphs.types import Floats, Ints, JointId, LinkId


@dataclass(frozen=True, slots=True)
class LinkageLoop:
    """A loop of a linkage at a configuration: places of its joints in loop order, and the centre of their axes.

    A sign is 1 where the loop goes from a joint's first link to its second.
    """

    joints: tuple[int, ...]
    signs: tuple[int, ...]
    centre: Centre


@dataclass(frozen=True, slots=True, repr=False)
class Linkage:
    """Links and joint axes in space.

    Attributes
    ----------
    graph : SCGraph
        Links and joints; columns of all arrays are its joints, in order.
    points : float[J, 3]
        A point on each axis, of a crease its middle, in units of the extent, about the middle of all.
    directions : float[J, 3]
        Unit vectors. A positive angle turns the second link of a joint against the first, right-handed.
    angles : float[J]
        Joint angles at the configuration, radians.
    loops : tuple of LinkageLoop
        A basis of the cycles.
    extent : float
        Unit of length of the points, in that of the coordinates.
    middle : float[3]
        Their origin.
    slides : tuple of int, optional
        Places of joints that slide along their direction instead of turning about it; their angles are lengths, in
        units of the extent.
    """

    graph: SCGraph
    points: Floats
    directions: Floats
    angles: Floats
    loops: tuple[LinkageLoop, ...]
    extent: float
    middle: Floats
    slides: tuple[int, ...] = ()

    def __repr__(self) -> str:
        return f"<Linkage: {len(self.graph)} links, {len(self.graph.joints)} joints, {len(self.loops)} loops>"


def linkage_of_axes(
    graph: SCGraph, axes: Mapping[JointId, tuple[Sequence[float], Sequence[float]]], *, slides: Collection[JointId] = ()
) -> Linkage:
    """Return a linkage with joint axes in space.

    Loops that the graph gives a centre close about it; all others close with six equations.

    Parameters
    ----------
    graph : SCGraph
    axes : mapping of joint id to (point, direction)
        Three coordinates each, any unit of length.
    slides : collection of joint id, optional
        Joints that slide along their direction.

    Raises
    ------
    InvariantError
        If an axis is missing or has no direction.

    Examples
    --------
    >>> square = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
    >>> corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    >>> linkage_of_axes(square, {joint: (corners[joint], (0, 0, 2)) for joint in range(4)})
    <Linkage: 4 links, 4 joints, 1 loops>
    """
    for joint in graph.joints:
        if joint not in axes:
            raise InvariantError("axis", f"joint {joint!r} has no axis", "one for each joint")
        if not np.any(axes[joint][1]):
            raise InvariantError("axis", f"the axis of joint {joint!r} has no direction", "a nonzero vector")
    points = np.array([axes[joint][0] for joint in graph.joints], dtype=float).reshape(-1, 3)
    directions = np.array([axes[joint][1] for joint in graph.joints], dtype=float).reshape(-1, 3)
    places = tuple(place for place, joint in enumerate(graph.joints) if joint in slides)
    return replace(_linkage(graph, points, unit(directions), np.zeros(len(points)), points), slides=places)


def linkage_of_sheet(sheet: Sheet, mechanism: SheetMechanism | None = None, tolerances: Tolerances = DOUBLE) -> Linkage:
    """Return the linkage of a crease pattern in its configuration: panels are links, creases are joints.

    Joint angles are fold angles. Where panels lie on each other, the fold angles of the file say to which side, or
    else the letters of its edges.

    Parameters
    ----------
    sheet : Sheet
        With coordinates, flat or folded.
    mechanism : SheetMechanism, optional
        Of this sheet, if already computed.
    tolerances : Tolerances, optional
        Of its coordinates: panels whose fold is 180 degrees but for rounding lie on each other.

    Raises
    ------
    UnsolvableError
        If the sheet has no coordinates.
    InvariantError
        If a crease has no length.

    Examples
    --------
    Two squares at a right angle, a valley:

    >>> corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1))
    >>> book = Sheet(6, ((0, 1),), "V", ((0, 1, 2, 3), (1, 0, 4, 5)), corners)
    >>> linkage = linkage_of_sheet(book)
    >>> linkage.angles.round(6).tolist(), (linkage.directions + 0.0).tolist()
    ([1.570796], [[-1.0, 0.0, 0.0]])
    """
    if sheet.coordinates is None:
        raise UnsolvableError("folding needs coordinates, and the sheet has none")
    dual = mechanism or mechanism_of_sheet(sheet)
    corners = in_space(sheet.coordinates)
    creases = creases_of(sheet, dual)
    edges = creases.ends
    directions = creases.directions(corners)
    areas = creases.area_vectors(corners)
    first, second = unit(areas[creases.sides.T])
    angles = np.arctan2((np.cross(first, second) * directions).sum(axis=1), (first * second).sum(axis=1))
    lengths = np.linalg.norm(corners[edges[:, 1]] - corners[edges[:, 0]], axis=1)
    widths = np.linalg.norm(areas[creases.sides], axis=2).min(axis=1, initial=np.inf) / (2.0 * lengths)
    # rounding turns a panel about a crease by as much as it moves points, over the width of the panel
    within = tolerances.same_configuration * widths + tolerances.parallel * extent_of(corners)
    on_each_other = (np.pi - np.abs(angles)) * widths < within
    if on_each_other.any():
        marks = _marks(sheet)
        marked = np.array([marks.get((min(a, b), max(a, b)), 0.0) for a, b in edges.tolist()])
        angles = np.where(on_each_other & (marked != 0.0), np.copysign(np.pi, marked), angles)
    return _linkage(dual.sc, corners[edges].mean(axis=1), directions, angles, corners)


def centre_of(linkage: Linkage, loop: LinkageLoop, tolerances: Tolerances = DOUBLE) -> Centre:
    """Return the centre of a loop: where it is not declared, by its axes, which meet or are parallel as drawn."""
    if loop.centre is not Centre.NONE:
        return loop.centre
    turning = [joint for joint in loop.joints if joint not in linkage.slides]
    sliding = [joint for joint in loop.joints if joint in linkage.slides]
    axes, along = linkage.directions[turning], linkage.directions[sliding]
    if len(axes):  # parallel axes, and slides across them
        off = max(np.abs(np.cross(axes, axes[0])).max(), np.abs(along @ axes[0]).max(initial=0.0))
        if off <= tolerances.meant:
            return Centre.INFINITE
    if not sliding and float(lines_meet(linkage.points[turning], axes).off.max()) <= tolerances.meant:
        return Centre.FINITE
    return Centre.NONE


class LinkagePart(NamedTuple):
    """A part of a linkage: places of its joints, int[n], and of its loops, and these alone as a linkage."""

    joints: Ints
    loops: tuple[int, ...]
    linkage: Linkage


def parts_of(linkage: Linkage) -> list[LinkagePart]:
    """Return the parts of a linkage whose loops share no joint, and last the joints in no loop, if there are several.

    Loops that share a link alone do not constrain each other: closure equations are about joints. One part is
    returned where all loops are connected; joints in no loop belong to it then.

    Parameters
    ----------
    linkage : Linkage

    Examples
    --------
    Two four-bars that hang on one link:

    >>> graph = SCGraph(7, [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (4, 5), (5, 6), (6, 0)])
    >>> axes = {joint: ((joint % 4 // 2, joint % 4 in (1, 2), joint // 4), (0, 0, 1)) for joint in range(8)}
    >>> [part.joints.tolist() for part in parts_of(linkage_of_axes(graph, axes))]
    [[0, 1, 2, 3], [4, 5, 6, 7]]
    """
    joints = nx.Graph()
    joints.add_nodes_from(joint for loop in linkage.loops for joint in loop.joints)
    joints.add_edges_from(pair for loop in linkage.loops for pair in pairwise(loop.joints))
    groups = sorted(map(sorted, nx.connected_components(joints)))
    whole = np.arange(len(linkage.angles))
    if len(groups) < 2:
        return [LinkagePart(whole, tuple(range(len(linkage.loops))), linkage)]
    loose = np.setdiff1d(whole, [joint for group in groups for joint in group]).tolist()
    number = {joint: place for place, group in enumerate(groups) for joint in group}
    loops_of: list[list[int]] = [[] for _ in groups]
    for place, loop in enumerate(linkage.loops):
        loops_of[number[loop.joints[0]]].append(place)
    if loose:
        groups, loops_of = [*groups, loose], [*loops_of, []]
    return [part_of(linkage, group, loops) for group, loops in zip(groups, loops_of, strict=True)]


def part_of(linkage: Linkage, group: Sequence[int], loops: Sequence[int]) -> LinkagePart:
    """Return some joints with some loops that pass no others, by their places, as a linkage of its own."""
    joints, names = np.array(group), list(linkage.graph.joints)
    place = {joint: own for own, joint in enumerate(group)}
    of_loops = [linkage.loops[loop] for loop in loops]
    renumbered = tuple(replace(loop, joints=tuple(map(place.__getitem__, loop.joints))) for loop in of_loops)
    pairs = {names[joint]: linkage.graph.joints[names[joint]] for joint in group}
    moving = {link for pair in pairs.values() for link in pair}
    alone = replace(
        linkage,
        graph=SCGraph([link for link in linkage.graph if link in moving], pairs),
        points=linkage.points[joints],
        directions=linkage.directions[joints],
        angles=linkage.angles[joints],
        loops=renumbered,
        slides=tuple(place[joint] for joint in linkage.slides if joint in place),
    )
    return LinkagePart(joints, tuple(loops), alone)


def axis_lengths(linkage: Linkage) -> Floats:
    """Return the lengths, in extents, by which axes are known: of creases from their vertex, of others 1."""
    lengths = np.ones(len(linkage.angles))
    for loop in linkage.loops:
        joints = list(loop.joints)
        if loop.centre is Centre.FINITE:
            points = linkage.points[joints]
            off = 2.0 * np.linalg.norm(points - lines_meet(points, linkage.directions[joints]).point, axis=1)
            lengths[joints] = np.where(off > DOUBLE.same_point, off, 1.0)
    return lengths


def _linkage(graph: SCGraph, points: Floats, directions: Floats, angles: Floats, all_points: Floats) -> Linkage:
    column = {joint: place for place, joint in enumerate(graph.joints)}
    loops = []
    for loop in independent_cycles(graph):
        order, signs = zip(*signed_cycle(loop.joints, graph.joints), strict=True)
        loops.append(LinkageLoop(tuple(map(column.__getitem__, order)), signs, loop.centre))
    middle = all_points.mean(axis=0) if len(all_points) else np.zeros(3)
    extent = extent_of(all_points) or 1.0
    return Linkage(graph, (points - middle) / extent, directions, angles, tuple(loops), extent, middle)


@dataclass(frozen=True, slots=True)
class Creases:
    """Where the creases of a sheet are between its panels: what fold angles are counted from.

    `ends`, int[J, 2], are vertices; `ways` is 1 where the axis goes from the first end to the second, else -1;
    `sides`, int[J, 2], are the faces beside it, that of the second link last. `faces` are turned so that two that
    share a side pass it in opposite directions, where that is possible.
    """

    joints: tuple[JointId, ...]
    ends: Ints
    ways: Floats
    sides: Ints
    faces: tuple[tuple[int, ...], ...]

    def directions(self, corners: Floats) -> Floats:
        """Return the unit vectors along the axes with vertices at float[V, 3]; an error if one has no length."""
        along = corners[self.ends[:, 1]] - corners[self.ends[:, 0]]
        lengths = np.linalg.norm(along, axis=1)
        for place in np.flatnonzero(lengths == 0.0):
            (first, second), part = self.ends[place].tolist(), ("edges", self.joints[place])
            no_length = f"the crease between vertices {first} and {second} has no length"
            raise InvariantError("hinge", no_length, part=part)
        return np.asarray(along / lengths[:, None] * self.ways[:, None])

    def area_vectors(self, corners: Floats) -> Floats:
        """Return twice the area vectors of the faces (Newell): float[faces, 3]."""
        vertex, after, of = corners_of_faces(self.faces)
        vectors = np.zeros((len(self.faces), 3))
        np.add.at(vectors, of, np.cross(corners[vertex], corners[vertex[after]]))
        return vectors


def creases_of(sheet: Sheet, mechanism: SheetMechanism) -> Creases:
    """Return where the creases of a sheet are between its panels."""
    vertex, after, face = corners_of_faces(sheet.faces)
    faces: Sequence[tuple[int, ...]] = sheet.faces
    if len(np.unique(vertex * sheet.vertices + vertex[after])) < len(vertex):  # two faces pass a side in one direction
        faces = _turned(sheet)
        vertex, after, face = corners_of_faces(faces)
    joints = mechanism.sc.joints
    ends = np.array([mechanism.hinges[joint] for joint in joints], dtype=np.int64).reshape(-1, 2)  # type: ignore[index]
    second = np.array([links[1] for links in joints.values()], dtype=np.int64)
    sides = np.minimum(vertex, vertex[after]) * sheet.vertices + np.maximum(vertex, vertex[after])
    order = np.argsort(sides, kind="stable")
    at = np.searchsorted(sides, ends.min(axis=1) * sheet.vertices + ends.max(axis=1), sorter=order)
    one, other = order[at], order[at + 1]  # the corners at which the two faces of each hinge pass it
    swapped = panel_of_faces(mechanism.panels)[face[other]] != second
    one, other = np.where(swapped, other, one), np.where(swapped, one, other)
    ways = np.where(vertex[other] == ends[:, 0], 1.0, -1.0)
    return Creases(tuple(joints), ends, ways, face[np.stack([one, other], axis=1)], tuple(faces))


def _turned(sheet: Sheet) -> list[tuple[int, ...]]:
    """Return the faces, some of them reversed: two that share a side pass it in opposite directions."""
    faces = list(sheet.faces)
    beside: dict[tuple[int, int], list[int]] = {}
    for number, face in enumerate(faces):
        for a, b in sides_of_face(face):
            beside.setdefault((min(a, b), max(a, b)), []).append(number)
    neighbours = nx.Graph()
    neighbours.add_nodes_from(range(len(faces)))
    neighbours.add_edges_from(pair for pair in beside.values() if len(pair) == 2)
    for first, second in nx.dfs_edges(neighbours):  # of all parts
        if set(sides_of_face(faces[first])) & set(sides_of_face(faces[second])):
            faces[second] = faces[second][::-1]
    return faces


def _marks(sheet: Sheet) -> dict[tuple[int, int], float]:
    """Return the fold angle that a sheet gives for each edge, radians, or 1 for a valley and -1 for a mountain."""
    marks = {}
    for number, (a, b) in enumerate(sheet.edges):
        angle = None if sheet.fold_angles is None else sheet.fold_angles[number]
        letter = {"V": 1.0, "M": -1.0}.get(sheet.assignments[number], 0.0)
        marks[min(a, b), max(a, b)] = angle or letter
    return marks


def link_motions(linkage: Linkage, angles: Floats, ground: LinkId | None = None) -> dict[LinkId, tuple[Floats, Floats]]:
    """Return how each link has moved from the configuration, along a tree of joints from a link that stays.

    Parameters
    ----------
    linkage : Linkage
    angles : float[F, J]
        Joint angles of many configurations, radians.
    ground : link, optional
        The link that stays; by default the first. Of a linkage in several parts, each has one.

    Returns
    -------
    dict of link to (float[F, 3, 3], float[F, 3])
        Rotation R and shift t: a point x of the link comes to R x + t, in units of the extent, about the middle.

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> hinge = linkage_of_axes(SCGraph(2, [(0, 1)]), {0: ((0, 0, 0), (0, 0, 1))})
    >>> rotation, _ = link_motions(hinge, np.array([[np.pi / 2]]))[1]
    >>> (rotation[0] @ [1.0, 0.0, 0.0]).round(12).tolist()
    [0.0, 1.0, 0.0]
    """
    rotations_of, shifts = placed_links(linkage, angles, ground)
    return {link: (rotations_of[:, place], shifts[:, place]) for place, link in enumerate(linkage.graph.nodes)}


def placed_links(linkage: Linkage, angles: Floats, ground: LinkId | None = None) -> tuple[Floats, Floats]:
    """Return the motions of `link_motions` as arrays, links in order: float[F, N, 3, 3] and float[F, N, 3]."""
    number = {link: place for place, link in enumerate(linkage.graph.nodes)}
    carried = list(joints_outwards(linkage, ground))
    ends = np.array([(number[near], number[far], place) for near, far, place, _ in carried], dtype=np.int64)
    senses = np.array([sense for *_, sense in carried], dtype=float)
    shape = (len(angles), len(number))
    rotation, shift = np.broadcast_to(np.eye(3), (*shape, 3, 3)).copy(), np.zeros((*shape, 3))
    depth = [0] * len(number)
    levels: list[list[int]] = []  # joints that are as far out
    for row, (inner, outer, _) in enumerate(ends.tolist()):
        depth[outer] = depth[inner] + 1
        if depth[outer] > len(levels):
            levels.append([])
        levels[depth[outer] - 1].append(row)
    for rows in levels:
        (near, far, place), sense = ends[rows].T, senses[rows]
        value = sense * (angles[:, place] - linkage.angles[place])
        slides = np.isin(place, linkage.slides)
        turn = rotations(linkage.directions[place], np.where(slides, 0.0, value))
        point = linkage.points[place]
        step = point - (turn @ point[..., None])[..., 0]
        step = np.where(slides[:, None], value[..., None] * linkage.directions[place], step)
        rotation[:, far] = rotation[:, near] @ turn
        shift[:, far] = shift[:, near] + (rotation[:, near] @ step[..., None])[..., 0]
    return rotation, shift


def joints_outwards(linkage: Linkage, ground: LinkId | None = None) -> Iterator[tuple[LinkId, LinkId, int, float]]:
    """Yield from the fixed link outwards: a link, the one it carries, the place of their joint, and its sense."""
    graph = linkage.graph
    column = {joint: place for place, joint in enumerate(graph.joints)}
    beside: dict[LinkId, dict[LinkId, JointId]] = {link: {} for link in graph.nodes}
    for joint, (first, second) in graph.joints.items():
        beside[first][second] = beside[second][first] = joint
    carried: set[LinkId] = set()
    for root in [*([] if ground is None else [ground]), *graph.nodes]:
        if root in carried:
            continue
        carried.add(root)
        waiting = deque([root])
        while waiting:
            near = waiting.popleft()
            for far, joint in beside[near].items():
                if far not in carried:
                    carried.add(far)
                    waiting.append(far)
                    yield near, far, column[joint], 1.0 if graph.joints[joint][0] == near else -1.0


def moved(linkage: Linkage, angles: Floats) -> Linkage:
    """Return the linkage with its axes where they are at joint angles float[J], radians: that is its configuration."""
    number = {link: place for place, link in enumerate(linkage.graph.nodes)}
    first = [number[link] for link, _ in linkage.graph.joints.values()]
    rotation, shift = (part[0, first] for part in placed_links(linkage, angles[None]))
    points = (rotation @ linkage.points[..., None])[..., 0] + shift
    directions = (rotation @ linkage.directions[..., None])[..., 0]
    return replace(linkage, points=points, directions=directions, angles=angles)
