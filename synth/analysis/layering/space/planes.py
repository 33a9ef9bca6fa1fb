"""A sheet at a configuration in space: panels that lie in one plane, and the images of all planes as one.

Panels that a crease joins without a fold are one *plate*. In each plane that several plates overlap in, the image is
made as that of a pattern folded flat. At a segment a panel can leave its plane too: round the segment the strands are
chords of a circle, from one ray to another, and no two cross. Theory: docs/theory/layer-orders.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, pairwise
from math import pi

import networkx as nx
import numpy as np
import shapely

from graphs.convert.duality import SheetMechanism
from graphs.geometry import frame_about, unit
from graphs.mechanism.precision import Precision, extent_of
from graphs.mechanism.sheet import Sheet, sides_of_face
from graphs.tolerances import Tolerances
from graphs.types import Floats, Ints
from synth.analysis.layering.image import FoldedImage, FoldedPanels, LeavingPanel, SegmentStrands, image_of
from synth.analysis.motion.linkage import Creases


@dataclass(frozen=True, eq=False)
class FoldedState:
    """A sheet at a configuration.

    Attributes
    ----------
    sheet : Sheet
    mechanism : SheetMechanism
    creases : Creases
        Where they are between its panels.
    precision : Precision
    tolerances : Tolerances
    points : float[V, 3]
        The places of the vertices, in the unit of the coordinates.
    angles : float[J]
        The fold angles, radians, in the order of the joints.
    signs : mapping of joint id to bool
        Whether each crease is a valley, where that is known of those folded by 180 degrees.
    """

    sheet: Sheet
    mechanism: SheetMechanism
    creases: Creases
    precision: Precision
    tolerances: Tolerances
    points: Floats
    angles: Floats
    signs: Mapping[int, bool]


_NEARLY = 1e3
"""Planes whose normals and heights, in units of the extent, differ by more than so many times the distance of points
that are one are looked at no further."""


@dataclass(frozen=True, eq=False)
class PlaneOfPanels:
    """A plane in which panels lie on each other.

    `frame`, float[3, 3], are two directions in it and its normal, `origin` a point of it; `plates` are the numbers of
    the plates that lie in it, each the lowest number of its panels.
    """

    frame: Floats
    origin: Floats
    plates: tuple[int, ...]

    def flat(self, points: Floats) -> Floats:
        """Return points, float[n, 3], in the plane, float[n, 2]."""
        return np.asarray((points - self.origin) @ self.frame[:2].T)

    def lifted(self, places: Floats) -> Floats:
        """Return points of the plane, float[n, 2], in space, float[n, 3]."""
        return np.asarray(places @ self.frame[:2] + self.origin)


@dataclass(frozen=True, eq=False)
class StackedPanels:
    """Panels of a sheet that lie on each other.

    Attributes
    ----------
    planes : tuple of PlaneOfPanels
    image : FoldedImage
        Those of all planes, one after the other; the panels are plates.
    plane_of_cell : tuple of int
    plates : tuple of tuple of int
        The panels of each plate, at the lowest number of them; empty at other numbers.
    creases : tuple of int
        The joints at which two plates lie on each other.
    """

    planes: tuple[PlaneOfPanels, ...]
    image: FoldedImage
    plane_of_cell: tuple[int, ...]
    plates: tuple[tuple[int, ...], ...]
    creases: tuple[int, ...]


class _Plates:
    """A sheet at a configuration: the normals of its faces, its plates, and the creases that are closed."""

    def __init__(self, state: FoldedState) -> None:
        sheet, mechanism, points, tolerances = state.sheet, state.mechanism, state.points, state.tolerances
        self.sheet, self.mechanism, self.points = sheet, mechanism, points
        creases = state.creases
        self.normals = unit(creases.area_vectors(points))
        listed = np.array(
            [1.0 if turned == face else -1.0 for turned, face in zip(creases.faces, sheet.faces, strict=True)]
        )
        self.listed = self.normals * listed[:, None]
        self.touching = tolerances.same_point * (extent_of(points) or 1.0)
        near = max(tolerances.same_configuration, tolerances.parallel)
        size = np.abs(state.angles)
        unfolded = nx.Graph()
        unfolded.add_nodes_from(range(len(mechanism.panels)))
        ends = mechanism.sc.joints
        unfolded.add_edges_from(ends[joint] for joint, angle in zip(creases.joints, size, strict=True) if angle <= near)
        self.plates: list[tuple[int, ...]] = [()] * len(mechanism.panels)
        for together in nx.connected_components(unfolded):
            self.plates[min(together)] = tuple(sorted(together))
        self.plate_of_face = [0] * len(sheet.faces)
        for plate, panels in enumerate(self.plates):
            for face in (face for panel in panels for face in mechanism.panels[panel]):
                self.plate_of_face[face] = plate
        self.faces_of_plate = [
            tuple(face for panel in panels for face in mechanism.panels[panel]) for panels in self.plates
        ]
        self.closed = {joint for joint, angle in zip(creases.joints, size.tolist(), strict=True) if angle >= pi - near}
        self.joint_of = {frozenset(edge): joint for joint, pieces in mechanism.pieces.items() for edge in pieces}

    def planes(self) -> Iterator[PlaneOfPanels]:
        """Yield the planes in which plates overlap."""
        plates = np.array([plate for plate, faces in enumerate(self.faces_of_plate) if faces])
        plates = self._with_parallel_ones_near(plates)
        if len(plates) < 2:
            return
        corners = [
            sorted({v for face in self.faces_of_plate[plate] for v in self.sheet.faces[face]}) for plate in plates
        ]
        begin = np.cumsum([0, *map(len, corners[:-1])])
        every = np.concatenate(corners)
        left = np.ones(len(plates), dtype=bool)
        for first in range(len(plates)):
            if not left[first]:
                continue
            normal = self.normals[self.faces_of_plate[plates[first]][0]]
            origin = self.points[corners[first]].mean(axis=0)
            far = np.maximum.reduceat(np.abs((self.points - origin) @ normal)[every], begin)
            together = left & (far <= 4.0 * self.touching)
            together[first] = True
            left &= ~together
            if together.sum() > 1:
                plane = PlaneOfPanels(frame_about(normal), origin, tuple(plates[together].tolist()))
                kept = self._overlapping(plane)
                if kept:
                    yield replace(plane, plates=kept)

    def _with_parallel_ones_near(self, plates: Ints) -> Ints:
        """Return the plates whose plane is nearly that of another: those that are looked at more closely."""
        if len(plates) < 2:
            return plates
        from scipy.spatial import cKDTree  # not at the head: a question about one vertex would wait for it

        first = [self.faces_of_plate[plate][0] for plate in plates]
        normals = self.normals[first]
        corners = np.array([self.sheet.faces[face][0] for face in first])
        middle = self.points.mean(axis=0)
        heights = ((self.points[corners] - middle) * normals).sum(axis=1) / (extent_of(self.points) or 1.0)
        planes = np.column_stack([normals, heights])
        near, _ = cKDTree(np.concatenate([planes, -planes])).query(planes, k=2)
        kept: Ints = plates[near[:, 1] <= _NEARLY * self.touching / (extent_of(self.points) or 1.0)]
        return kept

    def _overlapping(self, plane: PlaneOfPanels) -> tuple[int, ...]:
        """Return the plates of a plane that overlap others."""
        faces = [face for plate in plane.plates for face in self.faces_of_plate[plate]]
        shapes = shapely.polygons(
            [shapely.linearrings(plane.flat(self.points[list(self.sheet.faces[f])])) for f in faces]
        )
        one, other = shapely.STRtree(shapes).query(shapes, predicate="intersects")
        plates = np.array([self.plate_of_face[face] for face in faces])
        apart = (one < other) & (plates[one] != plates[other])
        one, other = one[apart], other[apart]
        common = shapely.intersection(shapes[one], shapes[other])
        wide = shapely.area(common) > self.touching * shapely.length(common)
        return tuple(sorted({*plates[one[wide]].tolist(), *plates[other[wide]].tolist()}))

    def sub_sheet(self, plane: PlaneOfPanels) -> tuple[FoldedPanels, list[tuple[int, int]]]:
        """Return the panels of a plane as if folded flat, and lines that join parts that do not share vertices."""
        faces = [face for plate in plane.plates for face in self.faces_of_plate[plate]]
        number = {face: place for place, face in enumerate(faces)}
        places = plane.flat(self.points)
        beside: dict[frozenset[int], list[int]] = {}
        for face in faces:
            for side in sides_of_face(self.sheet.faces[face]):
                beside.setdefault(frozenset(side), []).append(self.plate_of_face[face])
        edges, letters, pieces = [], "", dict[int, list[tuple[int, int]]]()
        for edge, plates in beside.items():
            a, b = sorted(edge)
            joint = self.joint_of.get(edge)
            edges.append((a, b))
            if len(plates) == 2 and plates[0] == plates[1]:
                letters += "F"
            elif len(plates) == 2 and joint in self.closed:
                letters += "U"
                pieces.setdefault(joint, []).append((a, b))  # type: ignore[arg-type]
            else:
                letters += "B"
        panels = tuple(tuple(number[face] for face in some if face in number) for some in self.faces_of_plate)
        sheet = Sheet(
            self.sheet.vertices, tuple(edges), letters, tuple(self.sheet.faces[face] for face in faces),
            tuple(map(tuple, places.tolist())),
        )  # fmt: skip
        kept = {joint: tuple(some) for joint, some in pieces.items()}
        mechanism = replace(self.mechanism, panels=panels, pieces=kept)
        flipped = np.array(
            [bool(some) and self.normals[some[0]] @ plane.frame[2] < 0.0 for some in self.faces_of_plate]
        )
        return FoldedPanels(sheet, mechanism, places, flipped, 0.0, 0), list(_bridges(edges, places))

    def leaving(self, plane: PlaneOfPanels, image: FoldedImage) -> list[tuple[int, int, _Leaving]]:
        """Return segments of an image, their sides, and the panels that leave the plane there."""
        inside = {face for plate in plane.plates for face in self.faces_of_plate[plate]}
        beside: dict[frozenset[int], list[tuple[int, tuple[int, int]]]] = {}
        for face, around in enumerate(self.sheet.faces):
            for side in sides_of_face(around):
                beside.setdefault(frozenset(side), []).append((face, side))
        found = []
        for edge, path in image.paths.items():
            joint, faces = self.joint_of.get(edge), beside.get(edge, [])
            if joint is None or len(faces) != 2:
                continue
            for (face, side), (beyond, back) in (faces, faces[::-1]):
                if face not in inside or beyond in inside:
                    continue
                one, other = self.plate_of_face[face], self.plate_of_face[beyond]
                if one == other:
                    continue
                inward, outward = self._inward(face, side), self._inward(beyond, back)
                for segment in path:
                    ends = image.nodes[image.segments[segment]]
                    along = unit(ends[1] - ends[0]) @ plane.frame[:2]
                    left = np.cross(plane.frame[2], along)
                    place = 0 if inward @ left > 0.0 else 1
                    turn = np.arctan2(outward @ plane.frame[2], outward @ left) - (0.0 if place == 0 else pi)
                    span, length = self._span(edge, plane.lifted(ends))
                    there = _Leaving(one, joint, float(turn % (2.0 * pi)), beyond, edge, span, length)
                    found.append((segment, place, there))
        return found

    def _inward(self, face: int, side: tuple[int, int]) -> Floats:
        """Return the direction in a face that leads away from its side."""
        return unit(np.cross(self.listed[face], self.points[side[1]] - self.points[side[0]]))

    def _span(self, edge: frozenset[int], ends: Floats) -> tuple[tuple[float, float], float]:
        """Return where two points lie on an edge, from 0 at its lower vertex to 1, and its length."""
        a, b = sorted(edge)
        along = self.points[b] - self.points[a]
        length = float(np.linalg.norm(along))
        start, end = ((ends - self.points[a]) @ along / length**2).tolist()
        return (start, end), length


@dataclass(frozen=True, slots=True)
class _Leaving:
    """A plate that leaves its plane at a segment, the face beyond, and where the ends of the segment are on its edge.

    `along` goes from 0 at the lower vertex of the edge to 1, `length` is that of the edge.
    """

    plate: int
    joint: int
    turn: float
    beyond: int
    edge: frozenset[int]
    along: tuple[float, float]
    length: float

    @property
    def span(self) -> tuple[float, float]:
        """The lower and the upper end on the edge."""
        return min(self.along), max(self.along)

    @property
    def forward(self) -> bool:
        """Whether the segment leads away from the lower vertex of the edge."""
        return self.along[0] < self.along[1]


def _bridges(edges: Sequence[tuple[int, int]], places: Floats) -> Iterator[tuple[int, int]]:
    """Yield pairs of vertices, far from each other, that join the parts of a graph of edges in a row."""
    parts = sorted(map(sorted, nx.connected_components(nx.Graph(edges))))
    for one, other in pairwise(parts):
        far = np.linalg.norm(places[other] - places[one[0]], axis=1)
        yield one[0], other[int(np.argmax(far))]


def stacked_panels(state: FoldedState) -> StackedPanels | None:
    """Return the panels of a sheet that lie on each other at a configuration; None if none do."""
    stacking = _Plates(state)
    planes = tuple(stacking.planes())
    if not planes:
        return None
    images = []
    for plane in planes:
        panels, bridges = stacking.sub_sheet(plane)
        images.append(image_of(panels, stacking.touching, bridges))
    leaving = [stacking.leaving(plane, image) for plane, image in zip(planes, images, strict=True)]
    return _joined(stacking, planes, images, leaving)


def _joined(
    stacking: _Plates,
    planes: tuple[PlaneOfPanels, ...],
    images: Sequence[FoldedImage],
    leaving: Sequence[Sequence[tuple[int, int, _Leaving]]],
) -> StackedPanels:
    """Return the images of all planes as one, with what leaves each plane."""
    plane_of_face = {
        face: number
        for number, plane in enumerate(planes)
        for plate in plane.plates
        for face in stacking.faces_of_plate[plate]
    }
    first_cell = np.cumsum([0, *(len(image.cells) for image in images)]).tolist()
    first_node = np.cumsum([0, *(len(image.nodes) for image in images[:-1])]).tolist()
    strands: list[SegmentStrands] = []
    for number, image in enumerate(images):
        mine: dict[tuple[int, int], list[LeavingPanel]] = {}
        for segment, side, there in leaving[number]:
            plane = plane_of_face.get(there.beyond, -2 - there.beyond)
            mine.setdefault((segment, side), []).append(LeavingPanel(there.plate, there.joint, there.turn, plane))
        for segment, strand in enumerate(image.strands):
            left, right = (cell + first_cell[number] if cell >= 0 else cell for cell in (strand.left, strand.right))
            out = tuple(tuple(mine.get((segment, side), ())) for side in (0, 1))
            strands.append(replace(strand, left=left, right=right, leaving=out))  # type: ignore[arg-type]
    flipped = np.zeros(len(stacking.plates), dtype=bool)
    faces_up = [False] * len(stacking.sheet.faces)
    for lain, image in zip(planes, images, strict=True):
        for plate in lain.plates:
            flipped[plate] = image.panels.flipped[plate]
            for face in stacking.faces_of_plate[plate]:
                faces_up[face] = bool(stacking.listed[face] @ lain.frame[2] > 0.0)
    panels = FoldedPanels(
        stacking.sheet,
        replace(stacking.mechanism, panels=tuple(stacking.faces_of_plate)),
        np.zeros((0, 2)),
        flipped,
        0.0,
        0,
    )
    panels.__dict__["faces_up"] = faces_up
    whole = FoldedImage(
        panels,
        np.concatenate([image.nodes for image in images]),
        np.concatenate([image.segments + start for image, start in zip(images, first_node, strict=True)]),
        np.array([(strand.left, strand.right) for strand in strands]),
        tuple(
            tuple(node + start for node in cell)
            for image, start in zip(images, first_node, strict=True)
            for cell in image.cells
        ),
        tuple(above for image in images for above in image.above),
        {},
        max(image.welded for image in images),
        tuple(dict.fromkeys(_bundles(stacking, plane_of_face, images, leaving, first_cell))),
    )
    whole.__dict__["strands"] = tuple(strands)
    plane_of_cell = tuple(number for number, image in enumerate(images) for _ in image.cells)
    creases = sorted({joint for strand in strands for side in strand.turning for *_, joint in side})
    return StackedPanels(planes, whole, plane_of_cell, tuple(stacking.plates), tuple(creases))


def _bundles(
    stacking: _Plates,
    plane_of_face: dict[int, int],
    images: Sequence[FoldedImage],
    leaving: Sequence[Sequence[tuple[int, int, _Leaving]]],
    first_cell: Sequence[int],
) -> Iterator[tuple[int, int, int, int, int, int]]:
    """Yield what two panels that leave a plane together for another say of the orders in both."""
    there_at: dict[tuple[int, frozenset[int]], list[tuple[int, int, _Leaving]]] = {}
    for number, rows in enumerate(leaving):
        for segment, side, there in rows:
            there_at.setdefault((number, there.edge), []).append((segment, side, there))
    for number, rows in enumerate(leaving):
        together: dict[tuple[int, int, int], list[_Leaving]] = {}
        for segment, side, there in rows:
            beyond = plane_of_face.get(there.beyond, -1)
            if beyond > number:  # each pair of planes once
                together.setdefault((segment, side, beyond), []).append(there)
        for (segment, side, beyond), several in together.items():
            cell = int(images[number].sides[segment][side]) + first_cell[number]
            least = 4.0 * max(images[number].welded, images[beyond].welded)
            for one, other in combinations(several, 2):
                theirs = {(s, k): second.plate for s, k, second in there_at.get((beyond, other.edge), ())}
                for s, k, first in there_at.get((beyond, one.edge), ()):
                    common = min(one.span[1], first.span[1]) - max(one.span[0], first.span[0])
                    if (s, k) not in theirs or common * first.length <= least:
                        continue
                    pair = (first.plate, theirs[s, k])
                    # the first of two at one ray is the second at the other, round one direction of the segment
                    alike = (side != k) == (one.forward == first.forward)
                    there_cell = int(images[beyond].sides[s][k]) + first_cell[beyond]
                    yield cell, one.plate, other.plate, there_cell, *(pair if alike else pair[::-1])
