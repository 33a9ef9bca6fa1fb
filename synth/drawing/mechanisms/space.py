"""Sheets and models in space: seen from a little above, panels shaded, what lies in front drawn last.

Panels that overlap in the picture are compared where they do: the one nearer to the eye there is drawn later.
Where that goes round in a circle, which it can among three panels, the one whose middle is farthest is drawn
first.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from graphs.arrays import Floats
from graphs.convert.duality import mechanism_of_sheet
from graphs.errors import UnsolvableError
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sheet import Sheet, with_all_edges
from synth.drawing.layout.mechanisms import layout_of
from synth.drawing.mechanisms.frame import COLUMN, captions_of, framed, page_of
from synth.drawing.mechanisms.labelling import Obstacles, beside, placed
from synth.drawing.scene.palette import FINE, NORMAL, SMALL, STRONG
from synth.drawing.scene.shapes import Disc, Label, Layer, Line, Point, Polygon, Scene, Shape

__all__ = ["drawn_order", "folded_scene", "model_scene", "seen_from_above"]

_EYE = np.array([0.40, 0.62, 0.68])
"""Where the eye is, along the axes in which the thing is long, less long, and short."""
_THIN = 1e-9
_LETTERS = {"M": "mountain", "V": "valley", "U": "ink", "C": "cut", "B": "ink"}
_MANY = 60


@dataclass(frozen=True, slots=True)
class _Seen:
    """Places as they are seen: float[n, 2], x to the right and y upwards; and how near they are: float[n]."""

    places: Floats
    near: Floats


def seen_from_above(points: Floats) -> _Seen:
    """Return points as an eye far away sees them.

    Parameters
    ----------
    points : float[n, 3]

    Examples
    --------
    >>> seen_from_above(np.eye(3)).places.shape
    (3, 2)
    """
    centred = points - points.mean(axis=0)
    _, sizes, axes = np.linalg.svd(centred, full_matrices=False)
    if len(axes) < 3:
        axes, sizes = np.eye(3), np.ones(3)
    axes = axes * np.where(axes[np.arange(3), np.abs(axes).argmax(axis=1)] < 0, -1.0, 1.0)[:, None]
    if np.linalg.det(axes) < 0:
        axes[1] = -axes[1]
    flat = sizes[2] < 1e-6 * max(sizes[0], 1e-300)
    eye = axes.T @ (np.array([0.0, 0.0, 1.0]) if flat else _EYE / np.linalg.norm(_EYE))
    up = axes[1] if flat else axes[2] - (axes[2] @ eye) * eye
    up = up / np.linalg.norm(up)
    right = np.cross(up, eye)
    return _Seen(centred @ np.column_stack([right, up]), centred @ eye)


def folded_scene(
    sheet: Sheet, *, numbers: bool = True, box: tuple[float, float] = (COLUMN, COLUMN), caption: str | None = ""
) -> Scene:
    """Return a picture of a folded sheet: panels shaded, creases in the colours of their letters.

    Parameters
    ----------
    sheet : Sheet
    numbers : bool, optional
        Write the numbers of links on panels that are not covered.
    box : (width, height), optional
    caption : str, optional

    Raises
    ------
    UnsolvableError
        If the sheet has no coordinates.

    Examples
    --------
    >>> roof = Sheet(4, ((0, 1),), "M", ((0, 1, 2), (1, 0, 3)), ((0, 0, 1), (0, 2, 1), (1, 1, 0), (-1, 1, 0)))
    >>> [layer.name for layer in folded_scene(roof).layers]
    ['panels', 'labels', 'caption']
    """
    whole = with_all_edges(sheet)
    if whole.coordinates is None:
        raise UnsolvableError("a sheet without coordinates has no picture in space")
    points = np.asarray(whole.coordinates, dtype=float)
    points = np.pad(points, ((0, 0), (0, 3 - points.shape[1])))
    seen = seen_from_above(points)
    extent = float(np.ptp(seen.places, axis=0).max()) or 1.0
    frame = framed(seen.places.tolist(), min(box) / extent, box)
    page = frame.row(seen.places.tolist())
    mechanism = mechanism_of_sheet(sheet)
    link_of = {face: link for link, faces in enumerate(mechanism.panels) for face in faces}
    joint_of = {frozenset(edge): joint for joint, edges in mechanism.pieces.items() for edge in edges}
    letters = {frozenset(edge): letter for edge, letter in zip(whole.edges, whole.assignments, strict=True)}
    shapes: list[Shape] = []
    visible: dict[int, list[Point]] = {}
    for face in drawn_order(seen.places, seen.near, whole.faces):
        row = whole.faces[face]
        data = (
            (
                "link",
                str(link_of.get(face, "")),
            ),
        )
        light = _light(points[list(row)])
        shapes.append(Polygon([page[v] for v in row], "ground", None, data=data))
        shapes.append(Polygon([page[v] for v in row], "paper", None, opacity=light))
        for a, b in zip(row, (*row[1:], row[0]), strict=True):
            side = frozenset((a, b))
            letter = letters.get(side, "B")
            joint = joint_of.get(side)
            mark = () if joint is None else (("joint", str(joint)),)
            width = NORMAL if joint is not None else FINE
            shapes.append(Line([page[a], page[b]], _LETTERS.get(letter, "grey"), width, data=mark))
        visible[face] = [page[v] for v in row]
    labels = _numbers(visible, link_of) if numbers and len(visible) <= _MANY else []
    said = f"{len(mechanism.sc)} links, {len(mechanism.sc.joints)} joints; in space, seen from above"
    layers = [Layer("panels", tuple(shapes)), Layer("labels", tuple(labels))]
    return page_of(frame, layers, captions_of(caption, said))


def _light(corners: Floats) -> float:
    """Return how light a panel is: by the angle at which it meets the light, from either side."""
    normal = np.cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0)
    size = float(np.linalg.norm(normal))
    if size < _THIN:
        return 0.5
    return 0.15 + 0.75 * abs(float(normal @ np.array([0.35, -0.45, 0.82]))) / size


def _numbers(visible: Mapping[int, list[Point]], link_of: Mapping[int, int]) -> list[Label]:
    """Return the numbers of links on the parts of panels that later panels do not cover."""
    from shapely import union_all
    from shapely.geometry import Polygon as Area

    wishes: list[tuple[Label, list[Point]]] = []
    above: list[object] = []
    told: set[int] = set()
    for face, row in reversed(list(visible.items())):
        area = Area(row).buffer(0)
        free = area.difference(union_all(above)) if above else area
        above.append(area)
        link = link_of.get(face)
        if link is None or link in told or free.area < max(0.25 * area.area, 30):
            continue
        told.add(link)
        point = free.centroid if free.contains(free.centroid) else free.representative_point()
        label = Label((0, 0), str(link), SMALL, bold=True, halo=False, data=(("link", str(link)),))
        wishes.append((label, [(point.x, point.y), *beside((point.x, point.y), 4)]))
    return placed(wishes, Obstacles([], []))


def drawn_order(places: Floats, near: Floats, faces: Sequence[Sequence[int]]) -> list[int]:
    """Return the faces in the order in which they are drawn: what is behind first.

    Parameters
    ----------
    places : float[n, 2]
        The vertices as they are seen.
    near : float[n]
        How near each is to the eye.
    faces : sequence of vertex cycles

    Examples
    --------
    Two squares, the second nearer:

    >>> places = np.array([[0, 0], [1, 0], [1, 1], [0, 1]] * 2, dtype=float)
    >>> drawn_order(places, np.array([5.0] * 4 + [7.0] * 4), [(4, 5, 6, 7), (0, 1, 2, 3)])
    [1, 0]
    """
    from shapely import STRtree
    from shapely.geometry import Polygon as Area

    areas = [Area(places[list(face)]).buffer(0) for face in faces]
    behind: dict[int, set[int]] = {i: set() for i in range(len(faces))}
    least = 1e-6 * float(np.ptp(places, axis=0).max() or 1.0) ** 2
    for a, b in zip(*STRtree(areas).query(areas, predicate="intersects"), strict=True):
        if a >= b:
            continue
        common = areas[a].intersection(areas[b])
        if common.area <= least:
            continue
        spot = common.representative_point()
        at = np.array([spot.x, spot.y])
        heights = [_height(at, places[list(faces[i])], near[list(faces[i])]) for i in (a, b)]
        if abs(heights[0] - heights[1]) > 1e-9 * max(1.0, abs(heights[0])):
            front, back = (int(a), int(b)) if heights[0] > heights[1] else (int(b), int(a))
            behind[front].add(back)
    order: list[int] = []
    left = sorted(behind, key=lambda i: (float(near[list(faces[i])].mean()), i))
    done: set[int] = set()
    while left:
        ready = next((i for i in left if behind[i] <= done), left[0])
        left.remove(ready)
        done.add(ready)
        order.append(ready)
    return order


def _height(at: Floats, corners: Floats, near: Floats) -> float:
    """Return how near a panel is to the eye at a place, by the plane through its corners."""
    terms = np.column_stack([corners, np.ones(len(corners))])
    plane = np.linalg.lstsq(terms, near, rcond=None)[0]
    return float(plane @ np.array([*at, 1.0]))


def model_scene(
    model: PolyhedronModel, *, box: tuple[float, float] = (COLUMN, COLUMN), caption: str | None = ""
) -> Scene:
    """Return a picture of a polyhedron model: vertices, rods, remote centres and what else it has, in words.

    With coordinates it is seen from a little above; without, it is drawn as a graph.

    Examples
    --------
    >>> hinge = PolyhedronModel(4, [(0, 1), (1, 2), (2, 0), (1, 3), (2, 3)])
    >>> [layer.name for layer in model_scene(hinge).layers]
    ['rods', 'vertices', 'labels', 'caption']
    """
    vertices = list(model.nodes)
    pairs = [*model.edges, *_sides_of_scissors(model)]
    if model.coordinates:
        seen = seen_from_above(np.array([model.coordinates[v] for v in vertices]))
        places = dict(zip(vertices, seen.places.tolist(), strict=True))
        unit = 0.7 * min(box) / (float(np.ptp(seen.places, axis=0).max()) or 1.0)
    else:
        layout = layout_of(vertices, dict(enumerate(pairs)), as_bodies=False)
        places, unit = {vertex: list(place) for vertex, place in layout.links.items()}, 52.0
    frame = framed(places.values(), unit, box)
    page = {vertex: frame.at(place) for vertex, place in places.items()}
    ground = model.ground or frozenset()
    rods: list[Shape] = []
    for a, b in model.edges:
        fixed = a in ground and b in ground
        rods.append(Line([page[a], page[b]], "grey" if fixed else "ink", STRONG if fixed else NORMAL))
    rods += [Line([page[a], page[b]], "class1", NORMAL, (3.0, 2.0)) for a, b in _sides_of_scissors(model)]
    dots = [Disc(page[v], 2.6, "ground" if v in ground else "paper", "ink") for v in vertices]
    lines = [(page[a], page[b]) for a, b in pairs]
    wishes = [(Label((0, 0), str(v), SMALL, widest=10), beside(page[v], 8)) for v in vertices]
    labels = placed(wishes, Obstacles([(*page[v], 3.4) for v in vertices], lines if len(lines) < 200 else []))
    layers = [Layer("rods", tuple(rods)), Layer("vertices", tuple(dots)), Layer("labels", tuple(labels))]
    return page_of(frame, layers, captions_of(caption, *_terms(model)))


def _sides_of_scissors(model: PolyhedronModel) -> list[tuple[object, object]]:
    return [(four[i], four[(i + 1) % 4]) for four in model.scissors for i in range(4)]


def _terms(model: PolyhedronModel) -> list[str]:
    said = f"{len(model)} vertices, {model.number_of_edges()} rods"
    if model.scissors:
        said += f", {len(model.scissors)} scissors (dashed)"
    if model.ground:
        said += f"; ground link grey, {len(model.ground)} vertices"
    lines = [said]
    if model.centres:
        lines.append("remote centres: " + ", ".join(f"S+{one.k}" for one in model.centres))
    if model.on_line or model.on_plane:
        lines.append(f"{len(model.on_line)} points on lines, {len(model.on_plane)} on planes")
    return lines
