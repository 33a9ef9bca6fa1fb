"""Where the links, joints and loops of a link-joint graph are drawn."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import inf

import networkx as nx
import numpy as np

from graphs.geometry import best_line
from graphs.types import Floats, JointId, Joints, LinkId
from synth.making.drawing.layout import embedding
from synth.making.drawing.layout.plane import PlaneGraph, barycentric, pulled

Place = tuple[float, float]
_GAP = 1.0
_MOST_CHOICES = 2
"""Largest number of mirrored drawings that are compared: there are many where there are many symmetries."""
_SHORT, _MOST_OUTSIDE = 0.1, 6
"""Length below which a side is invisible, in units of their mean; faces that are then tried outside."""


@dataclass(frozen=True, slots=True)
class PlacedFace:
    """A bounded face: the joints round it, counter-clockwise, and a place inside from which all are seen."""

    joints: tuple[JointId, ...]
    at: Place


@dataclass(frozen=True, slots=True)
class Layout:
    """Places in the plane, (x, y), y upwards, in units of the length of a side.

    `links` are the middles of links, `outlines` the corners of bodies, counter-clockwise (empty where links are
    dots); `ways` are then the places that the line of a joint passes, from its first link to its second. `faces`
    are those inside (none of a drawing with crossings); `plane`: no two lines cross. `mirror` maps each link to
    its image by the symmetry that is seen as an upright mirror, or is None.
    """

    links: dict[LinkId, Place]
    joints: dict[JointId, Place]
    outlines: dict[LinkId, tuple[Place, ...]]
    ways: dict[JointId, tuple[Place, ...]]
    faces: tuple[PlacedFace, ...]
    plane: bool
    mirror: dict[LinkId, LinkId] | None


def layout_of(
    links: Iterable[LinkId],
    joints: Joints,
    *,
    as_bodies: bool = True,
    rotation: Mapping[LinkId, Sequence[JointId]] | None = None,
    outer: Sequence[JointId] = (),
) -> Layout:
    """Return a layout of a link-joint graph: without crossings if it is planar, mirrored if possible.

    Joints map to pairs of links. With `as_bodies` links are polygons of their joints; else they are dots.
    `rotation`, the joints of each link counter-clockwise, is a drawing to keep; without it one is chosen. `outer`
    are the joints of the face to be outside, walked round with it on the left; by default it is one with most
    joints.

    >>> square = layout_of(range(4), {0: (0, 1), 1: (1, 2), 2: (2, 3), 3: (3, 0)})
    >>> square.plane, len(square.faces), square.mirror is not None
    (True, 1, True)
    """
    graph = nx.Graph()
    graph.add_nodes_from(("link", link) for link in links)
    for joint, ends in joints.items():
        graph.add_edges_from((("joint", joint), ("link", end)) for end in ends)
    parts = []
    for nodes in nx.connected_components(graph):
        part = embedding.part_of(graph, nodes)
        kept = None
        if rotation is not None:
            kept = {
                (kind, name): tuple(("joint", joint) for joint in rotation[name])
                if kind == "link"
                else tuple(("link", end) for end in joints[name])
                for kind, name in part
            }
        parts.append(_placed(part, joints, as_bodies, kept, tuple(outer)))
    return _side_by_side(parts, joints)


@dataclass(frozen=True, slots=True)
class _Part:
    """A connected part with the places of its nodes."""

    nodes: list[embedding.Node]
    places: Floats
    skeleton: embedding.Skeleton
    faces: list[tuple[tuple[embedding.Node, ...], Floats]]
    plane: bool
    shortest: float = inf
    """The length of the shortest side."""


def _placed(
    part: nx.Graph, joints: Joints, as_bodies: bool, kept: embedding.Neighbours | None, outer: Sequence[JointId]
) -> _Part:
    if len(part) == 1:
        node = next(iter(part))
        return _Part([node], np.zeros((1, 2)), embedding.Skeleton({node: ()}, {}, None), [], True)
    skeleton_of = embedding.bodies if as_bodies else embedding.dots
    plain = kept if kept is not None else embedding.embedded(part)
    if plain is None:
        return _drawn_crossing(part, as_bodies)
    choices = []
    for rotations, swap in _drawings(part, joints, plain, kept is not None):
        skeleton = skeleton_of(rotations, swap)
        faces = _outer_faces(skeleton, joints, outer)
        if faces:
            choices.append((skeleton, faces))
        if len(choices) == _MOST_CHOICES or swap is None:
            break
    if not choices:
        return _drawn_filled(skeleton_of(plain), joints, outer)
    skeleton, faces = max(choices, key=lambda choice: (choice[0].mirror is not None, len(choice[1][0])))
    best = _drawn_plane(skeleton, faces[0])
    for face in faces[1:_MOST_OUTSIDE]:  # as long as a side is too short to be seen
        if best.shortest >= _SHORT:
            break
        best = max(best, _drawn_plane(skeleton, face), key=lambda drawing: drawing.shortest)
    return best


def _drawings(
    part: nx.Graph, joints: Joints, plain: embedding.Neighbours, kept: bool
) -> Iterator[tuple[embedding.Neighbours, dict[embedding.Node, embedding.Node] | None]]:
    """Yield rotations, each with the symmetry that it mirrors, the plain ones last."""
    if nx.is_biconnected(part):
        links = [name for kind, name in part if kind == "link"]
        own = {name: joints[name] for kind, name in part if kind == "joint"}
        for swap in embedding.swaps_of(links, own):
            if all(swap["link", link] == ("link", link) for link in links):
                continue
            rotations = _if_reversed(plain, swap) if kept else embedding.mirrored(part, swap)
            if rotations is not None:
                yield rotations, swap
    yield plain, None


def _if_reversed(
    kept: embedding.Neighbours, swap: Mapping[embedding.Node, embedding.Node]
) -> embedding.Neighbours | None:
    """Return rotations if a symmetry reverses them all."""
    images = (([swap[other] for other in reversed(row)], kept[swap[node]]) for node, row in kept.items() if row)
    return kept if all(embedding.same_cycle(*both) for both in images) else None


def _outer_faces(
    skeleton: embedding.Skeleton, joints: Joints, outer: Sequence[JointId]
) -> list[tuple[embedding.Node, ...]]:
    """Return the faces that can be outside, their own mirror images, the one with most corners first.

    There are none if in one of them a node comes twice. In a ring of binary links both faces have the same
    joints: the one walked round as the requested face comes first.
    """
    faces = [face for face in embedding.faces_of(skeleton.around) if not _is_body(face, skeleton)]
    if any(len(set(face)) < len(face) for face in faces):
        return []
    if skeleton.mirror is not None:
        images = [[skeleton.mirror[node] for node in face] for face in faces]
        faces = [
            face
            for face, image in zip(faces, images, strict=True)
            if len(face) > 2 and (embedding.same_cycle(image[::-1], face) or embedding.same_cycle(image, face))
        ]
    fit = [face for face in faces if _shared(face, joints, skeleton, outer) == len(outer)]
    keys = [(embedding.same_cycle(_joints_of_face(face, joints, skeleton), outer), len(face)) for face in fit]
    return [fit[i] for i in sorted(range(len(fit)), key=keys.__getitem__, reverse=True)]


def _shared(
    face: Sequence[embedding.Node], joints: Joints, skeleton: embedding.Skeleton, outer: Sequence[JointId]
) -> int:
    """Return the number of joints of the requested outer face that lie round a face."""
    return len(set(outer) & set(_joints_of_face(face, joints, skeleton))) if outer else 0


def _is_body(face: Sequence[embedding.Node], skeleton: embedding.Skeleton) -> bool:
    return any(len(row) > 2 and embedding.same_cycle(row, face) for row in skeleton.outlines.values())


def _drawn_plane(skeleton: embedding.Skeleton, outer: tuple[embedding.Node, ...]) -> _Part:
    graph = PlaneGraph(skeleton.around, outer)
    number = {node: i for i, node in enumerate(graph.nodes)}
    bodies_of = [[number[node] for node in row] for row in skeleton.outlines.values() if len(row) > 2]
    inside = {
        pair for body in bodies_of for i, a in enumerate(body) for b in body[i + 1 :] for pair in [(a, b), (b, a)]
    }
    sides = [(a, b) for a, b in graph.edges.tolist() if (a, b) not in inside]
    start = barycentric(graph, skeleton.mirror)
    places = pulled(graph, start, sides, bodies_of, skeleton.mirror)
    faces = []
    for face, hub in zip(graph.faces, graph.hub_of, strict=True):
        row = tuple(graph.nodes[i] for i in face)
        if not _is_body(row, skeleton):
            faces.append((row, places[hub] if hub is not None else places[list(face)].mean(axis=0)))
    own = graph.own
    if skeleton.mirror is None:
        turn = _lying(places[:own])
        places = places @ turn
        faces = [(row, at @ turn) for row, at in faces]
    shortest = float(np.linalg.norm(places[graph.edges[:, 0]] - places[graph.edges[:, 1]], axis=1).min())
    return _Part(graph.nodes[:own], places[:own], skeleton, faces, True, shortest)


def _drawn_filled(skeleton: embedding.Skeleton, joints: Joints, outer: Sequence[JointId]) -> _Part:
    """Draw a graph that a node cuts in two, with nodes that close it, which then are left out."""
    around = embedding.made_biconnected(skeleton.around)
    filled = embedding.Skeleton(around, skeleton.outlines, None)
    faces = [face for face in embedding.faces_of(around) if not _is_body(face, filled)]
    best = max(faces, key=lambda face: (_shared(face, joints, skeleton, outer), len(face)))
    part = _drawn_plane(filled, best)
    kept = [i for i, node in enumerate(part.nodes) if node in skeleton.around]
    real = [(face, at) for face, at in part.faces if all(node in skeleton.around for node in face)]
    return _Part([part.nodes[i] for i in kept], part.places[kept], skeleton, real, True)


def _drawn_crossing(part: nx.Graph, as_bodies: bool) -> _Part:
    """Draw a graph that is not planar: distances approximate those along the graph."""
    incidence = {node: tuple(part[node]) for node in part}
    if as_bodies:
        skeleton = embedding.bodies(incidence)
        graph = nx.Graph((a, b) for row in skeleton.outlines.values() for i, a in enumerate(row) for b in row[i + 1 :])
    else:
        skeleton = embedding.dots(incidence)
        graph = nx.Graph((a, b) for a, row in skeleton.around.items() for b in row)
    place_of = nx.kamada_kawai_layout(graph, pos=nx.circular_layout(graph))
    nodes = list(graph)
    places = np.array([place_of[node] for node in nodes])
    ends = np.array([(nodes.index(a), nodes.index(b)) for a, b in graph.edges])
    places = places / np.median(np.linalg.norm(places[ends[:, 0]] - places[ends[:, 1]], axis=1))
    at = dict(zip(nodes, places, strict=True))
    outlines = {link: _round(row, at) for link, row in skeleton.outlines.items()}
    return _Part(nodes, places @ _lying(places), embedding.Skeleton(skeleton.around, outlines, None), [], False)


def _round(row: Sequence[embedding.Node], at: Mapping[embedding.Node, Floats]) -> tuple[embedding.Node, ...]:
    """Return the corners of a body in their order round their middle."""
    if len(row) < 4:
        return tuple(row)
    middle = np.mean([at[node] for node in row], axis=0)
    return tuple(sorted(row, key=lambda node: float(np.arctan2(*(at[node] - middle)[::-1]))))


def _lying(places: Floats) -> Floats:
    """Return the rotation after which places spread most from left to right."""
    along = best_line(places).direction
    along = along * (1 if along[0] >= 0 else -1)
    return np.array([[along[0], -along[1]], [along[1], along[0]]])


def _side_by_side(parts: Sequence[_Part], joints: Joints) -> Layout:
    """Put the parts in a row, and enter their places by name."""
    layout = Layout({}, {}, {}, {}, (), all(part.plane for part in parts), None)
    faces: list[PlacedFace] = []
    right = 0.0
    for part in parts:
        shift = np.array([right - part.places[:, 0].min(), -(part.places[:, 1].min() + part.places[:, 1].max()) / 2])
        right += float(np.ptp(part.places[:, 0])) + _GAP
        _name(part, shift, joints, layout)
        for row, at in part.faces:
            x, y = (at + shift).tolist()
            faces.append(PlacedFace(_joints_of_face(row, joints, part.skeleton), (x, y)))
    mirror = parts[0].skeleton.mirror if len(parts) == 1 else None
    links = None if mirror is None else {a[1]: b[1] for a, b in mirror.items() if a[0] == "link"}
    return Layout(layout.links, layout.joints, layout.outlines, layout.ways, tuple(faces), layout.plane, links)


def _name(part: _Part, shift: Floats, joints: Joints, layout: Layout) -> None:
    """Enter the places of a part in a layout."""
    at: dict[embedding.Node, Place] = {}
    for node, place in zip(part.nodes, (part.places + shift).tolist(), strict=True):
        at[node] = (place[0], place[1])
    for link, row in part.skeleton.outlines.items():
        layout.outlines[link[1]] = tuple(at[node] for node in row)
        layout.links[link[1]] = _middle([at[node] for node in row])
    for node, place in at.items():
        kind, name = node[0], node[1]
        if kind == "link":
            layout.links.setdefault(name, place)
        elif kind == "joint":
            layout.joints[name] = place
    if part.skeleton.outlines:
        return
    for joint, (a, b) in joints.items():
        if joint in layout.ways or a not in layout.links or b not in layout.links:
            continue
        middle = layout.joints.get(joint)
        ends = (layout.links[a], layout.links[b])
        layout.ways[joint] = ends if middle is None else (ends[0], middle, ends[1])
        layout.joints.setdefault(joint, _middle(ends))


def _middle(places: Sequence[Place]) -> Place:
    return sum(x for x, _ in places) / len(places), sum(y for _, y in places) / len(places)


def _joints_of_face(row: Sequence[embedding.Node], joints: Joints, skeleton: embedding.Skeleton) -> tuple[JointId, ...]:
    """Return the joints round a face, from the nodes round it."""
    if skeleton.outlines:
        return tuple(node[1] for node in row if node[0] == "joint")
    on_edges: list[JointId] = []
    between = {frozenset(ends): joint for joint, ends in joints.items()}
    for a, b in zip(row, (*row[1:], row[0]), strict=True):
        if a[0] == "joint":
            on_edges.append(a[1])
        elif a[0] == b[0] == "link":
            on_edges.append(between[frozenset((a[1], b[1]))])
    return tuple(on_edges)
