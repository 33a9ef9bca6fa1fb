"""The folded image of a crease pattern: panels reflected one after the other, and the cells that their edges part.

Every crease is folded by 180 degrees. Folded vertices that nearly coincide are welded, edges are cut where they meet,
and each edge of the sheet becomes a path of *segments* between *nodes* of the image; so the boundary of each panel is
a closed walk, and the panels above a *cell* are those round which it winds. Theory: docs/theory/layer-orders.md.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import dist

import networkx as nx
import numpy as np
import shapely
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import breadth_first_order, connected_components

from graphs.convert.duality import SheetMechanism
from graphs.errors import NumericalError, UnsolvableError
from graphs.geometry import signed_area
from graphs.input_limits import check_work
from graphs.mechanism.sheet import Sheet, sides_of_face
from graphs.types import Flags, Floats, Ints

OUTSIDE = -1
"""The cell beyond the silhouette."""
_HALVINGS, _ALIKE = 30, 3
"""Welding distances are halved so often at most, until so many in a row give one image."""
_COARSE = 64.0
"""The first of them is so many times the least, so that creases which the coordinates tell apart stay apart."""


@dataclass(frozen=True, eq=False)
class FoldedPanels:
    """Panels folded flat.

    `places`, float[V, 2], are the folded vertices, `flipped` says which panels show their back; `misfit` is how far
    apart, in the unit of the coordinates, two panels put a vertex that they share, and `vertex` which one.
    """

    sheet: Sheet
    mechanism: SheetMechanism
    places: Floats
    flipped: Flags
    misfit: float
    vertex: int

    @cached_property
    def panel_of_face(self) -> list[int]:
        """The panel of each face."""
        of = {face: panel for panel, faces in enumerate(self.mechanism.panels) for face in faces}
        return [of[face] for face in range(len(self.sheet.faces))]

    @cached_property
    def unturned(self) -> int | None:
        """A crease both panels of which show the same side, so that it is not folded; None if there is none."""
        edges = self.mechanism.sc.edges(keys=True)
        return min((joint for a, b, joint in edges if self.flipped[a] == self.flipped[b]), default=None)

    @cached_property
    def faces_up(self) -> list[bool]:
        """Whether the folded corners of each face turn counter-clockwise: its normal points up."""
        return [float(signed_area(self.places[list(face)])) > 0.0 for face in self.sheet.faces]


def folded(sheet: Sheet, mechanism: SheetMechanism, points: Floats) -> FoldedPanels:
    """Return the panels of a sheet reflected along a tree of its longest creases.

    `points`, float[V, 2], are the places of the vertices in the pattern. Raises `UnsolvableError` for a pattern in
    several parts.
    """
    plane = points[:, 0] + 1j * points[:, 1]
    tree = nx.Graph()
    tree.add_nodes_from(range(len(mechanism.panels)))
    for a, b, joint in mechanism.sc.edges(keys=True):
        u, v = mechanism.hinges[joint]
        length = float(abs(plane[u] - plane[v]))
        if not tree.has_edge(a, b) or tree[a][b]["weight"] < length:
            tree.add_edge(a, b, weight=length, line=(u, v))
    parts = nx.number_connected_components(tree)
    if parts > 1:
        raise UnsolvableError(f"the pattern has {parts} parts that no crease joins; expected one sheet")
    spanning = nx.maximum_spanning_tree(tree)
    turn = np.ones(len(mechanism.panels), dtype=complex)  # a point w goes to turn * w + shift, or to that of its
    shift = np.zeros(len(mechanism.panels), dtype=complex)  # conjugate where the panel is flipped
    flipped = np.zeros(len(mechanism.panels), dtype=bool)
    for one, other in nx.bfs_edges(spanning, 0):
        u, v = spanning[one][other]["line"]
        along = (plane[v] - plane[u]) / abs(plane[v] - plane[u])
        twice = along * along
        offset = plane[u] - twice * np.conj(plane[u])
        if flipped[one]:
            twice, offset = np.conj(twice), np.conj(offset)
        turn[other], shift[other] = turn[one] * twice, turn[one] * offset + shift[one]
        flipped[other] = not flipped[one]
    where: dict[int, complex] = {}
    misfit, worst = 0.0, 0
    for panel, faces in enumerate(mechanism.panels):
        for vertex in {vertex for face in faces for vertex in sheet.faces[face]}:
            start = np.conj(plane[vertex]) if flipped[panel] else plane[vertex]
            there = complex(turn[panel] * start + shift[panel])
            off = abs(there - where.setdefault(vertex, there))
            if off > misfit:
                misfit, worst = off, vertex
    places = np.zeros((sheet.vertices, 2))
    for vertex, there in where.items():
        places[vertex] = there.real, there.imag
    return FoldedPanels(sheet, mechanism, places, flipped, misfit, worst)


@dataclass(frozen=True, eq=False)
class FoldedImage:
    """The cells of the folded image.

    Attributes
    ----------
    panels : FoldedPanels
    nodes : float[N, 2]
    segments : int[S, 2]
        The nodes of each segment, the lower number first.
    sides : int[S, 2]
        The cells to the left and to the right of each segment; `OUTSIDE` beyond the silhouette.
    cells : tuple of node cycles
        Counter-clockwise.
    above : tuple of int arrays
        The panels over each cell, in the order of their numbers.
    paths : mapping of edge of the sheet to tuple of int
        The segments that each edge runs along.
    welded : float
        The distance within which points are one, in the unit of the coordinates.
    bundles : tuple of (cell, panel, panel, cell, panel, panel)
        Creases at which two panels leave a plane for another together: in the first cell the first panel is over the
        second exactly if in the other cell the first of those beyond is over the second.
    """

    panels: FoldedPanels
    nodes: Floats
    segments: Ints
    sides: Ints
    cells: tuple[tuple[int, ...], ...]
    above: tuple[Ints, ...]
    paths: dict[frozenset[int], tuple[int, ...]]
    welded: float
    bundles: tuple[tuple[int, int, int, int, int, int], ...] = ()

    @property
    def depth(self) -> int:
        """The largest number of panels over a cell."""
        return max(map(len, self.above), default=0)

    @cached_property
    def areas(self) -> Floats:
        """The area of each cell."""
        return np.array([float(signed_area(self.nodes[list(cell)])) for cell in self.cells])

    @cached_property
    def strands(self) -> tuple[SegmentStrands, ...]:
        """What runs across or turns back at each segment."""
        sheet, of = self.panels.sheet, self.panels.panel_of_face
        letters = {frozenset(edge): letter for edge, letter in zip(sheet.edges, sheet.assignments, strict=True)}
        joint_of = {frozenset(edge): joint for joint, pieces in self.panels.mechanism.pieces.items() for edge in pieces}
        beside: dict[frozenset[int], list[int]] = defaultdict(list)
        for face, around in enumerate(sheet.faces):
            for side in sides_of_face(around):
                beside[frozenset(side)].append(of[face])
        folds: list[dict[tuple[int, int], int]] = [{} for _ in self.segments]
        ending: list[set[int]] = [set() for _ in self.segments]
        for edge, path in self.paths.items():
            here = beside[edge]
            folded_here = edge in joint_of and len(here) == 2 and here[0] != here[1]
            for segment in path:
                if folded_here:
                    folds[segment][min(here), max(here)] = joint_of[edge]
                elif letters.get(edge, "B") in "BC":
                    ending[segment].update(here)
        strands = []
        for number, (left, right) in enumerate(self.sides.tolist()):
            there = [set() if cell == OUTSIDE else set(self.above[cell].tolist()) for cell in (left, right)]
            through = tuple(sorted((there[0] & there[1]) - ending[number]))
            turning: tuple[list[tuple[int, int, int]], ...] = ([], [])
            for (one, other), joint in sorted(folds[number].items()):
                place = 0 if one in there[0] and other in there[0] else 1
                turning[place].append((one, other, joint))
            strands.append(SegmentStrands(left, right, through, (tuple(turning[0]), tuple(turning[1]))))
        return tuple(strands)

    @property
    def turns_back(self) -> bool:
        """Whether both panels of each crease lie over the cell on one side of it: none is lost by welding."""
        over = [set(panels.tolist()) for panels in self.above]
        return all(
            cell != OUTSIDE and one in over[cell] and other in over[cell]
            for strand in self.strands
            for cell, turning in zip((strand.left, strand.right), strand.turning, strict=True)
            for one, other, _ in turning
        )


@dataclass(frozen=True, slots=True)
class LeavingPanel:
    """A panel that ends at a segment, at a crease beyond which the paper leaves the plane.

    `turn` is the angle, 0 to 2 pi, from the panel to the one beyond about the segment, from below to above on the left
    and from above to below on the right; `plane` is the plane of the panel beyond, by its number.
    """

    panel: int
    joint: int
    turn: float
    plane: int


@dataclass(frozen=True, slots=True)
class SegmentStrands:
    """The panels at a segment: those that run across, and those that turn back at a crease, on its left and right.

    Turning back are triples of two panels, the lower number first, and the crease that joins them. Leaving are panels
    that go on in another plane, which only a configuration in space has.
    """

    left: int
    right: int
    through: tuple[int, ...]
    turning: tuple[tuple[tuple[int, int, int], ...], tuple[tuple[int, int, int], ...]]
    leaving: tuple[tuple[LeavingPanel, ...], tuple[LeavingPanel, ...]] = ((), ())


def image_of(panels: FoldedPanels, least: float, more: Sequence[tuple[int, int]] = ()) -> FoldedImage:
    """Return the image of folded panels, welded by the coarsest distance near the `least` that holds.

    `more` are lines between vertices that join parts of the image that would not touch each other.

    Distances are halved, from 64 times the `least` on and down to it, until three in a row give as many nodes and
    segments, and each panel lies over cells of its own area; where none does, from an eighth of the shortest edge on.
    Raises `NumericalError` if none of these does.
    """
    edges, lengths = _distinct_edges(panels, more)
    coarsest = float(lengths.min()) / 8.0
    for start in sorted({min(coarsest, _COARSE * least), coarsest}):
        image = _welded_alike(panels, edges, start, least)
        if image is not None:
            return image
    raise NumericalError("no welding distance gives a consistent folded image; try --precision")


def _welded_alike(
    panels: FoldedPanels, edges: Sequence[tuple[int, int]], distance: float, least: float
) -> FoldedImage | None:
    """Return the image for the first of halved distances at which it stays as it is, else for the last that holds."""
    before: list[FoldedImage] = []
    for _ in range(_HALVINGS):
        image = _welded_image(panels, edges, distance)
        if image is None:
            before = []
        else:
            sizes = (len(image.nodes), len(image.segments))
            if before and sizes != (len(before[0].nodes), len(before[0].segments)):
                before = []
            before.append(image)
            if len(before) == _ALIKE:
                return before[_ALIKE // 2]
        distance /= 2.0
        if distance < least:
            break
    return before[-1] if before else None


def _distinct_edges(panels: FoldedPanels, more: Sequence[tuple[int, int]]) -> tuple[list[tuple[int, int]], Floats]:
    sides = [side for face in panels.sheet.faces for side in sides_of_face(face)]
    edges = sorted({(min(side), max(side)) for side in (*sides, *more)})
    ends = panels.places[np.array(edges)]
    return edges, np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)


def _welded_image(panels: FoldedPanels, edges: Sequence[tuple[int, int]], distance: float) -> FoldedImage | None:
    """Return the image for one welding distance; None if it is inconsistent there."""
    nodes, of_vertex = _welded(panels.places, distance)
    lines, line_of = np.unique(np.sort(of_vertex[np.array(edges)], axis=1), axis=0, return_inverse=True)
    if (lines[:, 0] == lines[:, 1]).any():
        return None
    nodes = _with_crossings(nodes, lines, distance)
    walks = _walks(nodes, lines, distance)
    steps = np.array([step for walk in walks for step in pairwise(walk)])
    segments, of_step = np.unique(np.sort(steps, axis=1), axis=0, return_inverse=True)
    paths_of_line, place = [], 0
    for walk in walks:
        paths_of_line.append(tuple(of_step[place : place + len(walk) - 1].tolist()))
        place += len(walk) - 1
    around = _cells(nodes, segments)
    if around is None:
        return None
    cells, sides = around
    ahead = {edge: int(line) for edge, line in zip(edges, line_of.ravel().tolist(), strict=True)}
    above = _covering(panels, nodes, segments, sides, cells, _Walked(of_vertex, ahead, walks, paths_of_line), distance)
    if above is None:
        return None
    paths = {frozenset(edge): paths_of_line[line] for edge, line in ahead.items()}
    image = FoldedImage(panels, nodes, segments, sides, cells, above, paths, distance)
    return image if image.turns_back else None


def _welded(points: Floats, distance: float) -> tuple[Floats, Ints]:
    """Return one node for each cluster of points, the first of them, and the node of each point."""
    geometry = shapely.points(points)
    pairs = shapely.STRtree(geometry).query(geometry, predicate="dwithin", distance=distance)
    near = coo_array((np.ones(len(pairs[0]), dtype=np.int8), tuple(pairs)), shape=(len(points), len(points)))
    _, part = connected_components(near, directed=False)
    _, first, place = np.unique(part, return_index=True, return_inverse=True)
    order = np.argsort(first)
    return points[first[order]], np.argsort(order)[place.ravel()]


def _with_crossings(nodes: Floats, lines: Ints, distance: float) -> Floats:
    """Return the nodes and, after them, the points where lines cross away from all nodes."""
    ends = nodes[lines]
    segments = shapely.linestrings(ends)
    one, two = shapely.STRtree(segments).query(segments, predicate="intersects")
    one, two = one[one < two], two[one < two]
    apart = ~(lines[one][:, :, None] == lines[two][:, None, :]).any(axis=(1, 2))
    one, two = one[apart], two[apart]
    check_work("meetings", len(one), "pairs of edges that meet in the folded image")
    p, r = ends[one, 0], ends[one, 1] - ends[one, 0]
    q, s = ends[two, 0], ends[two, 1] - ends[two, 0]
    area = r[:, 0] * s[:, 1] - r[:, 1] * s[:, 0]
    lengths = np.linalg.norm(r, axis=1), np.linalg.norm(s, axis=1)
    slanted = np.abs(area) > distance * np.maximum(*lengths)  # nearer to parallel, an end lies on the other line
    p, r, q, s, area = (array[slanted] for array in (p, r, q, s, area))
    gap = q - p
    t = (gap[:, 0] * s[:, 1] - gap[:, 1] * s[:, 0]) / area
    met = p + t[:, None] * r
    if not len(met):
        return nodes
    _, first = np.unique(_welded(met, distance)[1], return_index=True)
    met = met[np.sort(first)]
    free = shapely.STRtree(shapely.points(nodes)).query(shapely.points(met), predicate="dwithin", distance=distance)
    return np.concatenate([nodes, np.delete(met, np.unique(free[0]), axis=0)])


def _walks(nodes: Floats, lines: Ints, distance: float) -> list[list[int]]:
    """Return the nodes along each line, in order: all that are within the welding distance of it."""
    which, line = shapely.STRtree(shapely.linestrings(nodes[lines])).query(
        shapely.points(nodes), predicate="dwithin", distance=distance
    )
    start, end = lines[line, 0], lines[line, 1]
    along = ((nodes[which] - nodes[start]) * (nodes[end] - nodes[start])).sum(axis=1)
    along[which == start], along[which == end] = -np.inf, np.inf
    order = np.lexsort((along, line))
    cuts = np.flatnonzero(np.diff(line[order])) + 1
    return [part.tolist() for part in np.split(which[order], cuts)]


def _cells(nodes: Floats, segments: Ints) -> tuple[tuple[tuple[int, ...], ...], Ints] | None:
    """Return the cells, and which lie on the left and right of each segment; None if segments cross."""
    count = len(segments)
    darts = np.concatenate([segments, segments[:, ::-1]])  # dart d turned round is d + count, modulo 2 count
    arms = nodes[darts[:, 1]] - nodes[darts[:, 0]]
    order = np.lexsort((np.arctan2(arms[:, 1], arms[:, 0]), darts[:, 0]))
    starts = darts[order, 0]
    first = np.searchsorted(starts, starts)  # where the darts of the node begin
    place = np.empty(2 * count, dtype=np.int64)
    place[order] = np.arange(2 * count)
    last = np.searchsorted(starts, starts, side="right") - 1
    before = np.where(np.arange(2 * count) == first, last, np.arange(2 * count) - 1)
    back = (np.arange(2 * count) + count) % (2 * count)
    after = order[before[place[back]]]  # clockwise next of the reversed dart: the cell is on the left
    of_dart = np.full(2 * count, OUTSIDE, dtype=np.int64)
    following, starting = after.tolist(), darts[:, 0].tolist()
    seen = bytearray(2 * count)
    cells: list[tuple[int, ...]] = []
    outer = faces = 0
    for first_dart in range(2 * count):
        walk, dart = [], first_dart
        while not seen[dart]:
            seen[dart] = 1
            walk.append(dart)
            dart = following[dart]
        if not walk:
            continue
        faces += 1
        around = tuple(starting[dart] for dart in walk)
        if signed_area(nodes[list(around)]) > 0.0:
            of_dart[walk] = len(cells)
            cells.append(around)
        else:
            outer += 1
    if outer != 1 or len(np.unique(segments)) - count + faces != 2:
        return None
    return tuple(cells), np.column_stack([of_dart[:count], of_dart[count:]])


@dataclass(frozen=True, slots=True)
class _Walked:
    """Where edges of a sheet run: the node of each vertex, the line of each edge, the nodes and segments of a line."""

    node_of: Ints
    line_of: dict[tuple[int, int], int]
    walks: Sequence[Sequence[int]]
    paths: Sequence[tuple[int, ...]]

    def along(self, one: int, other: int) -> tuple[tuple[int, ...], list[int]]:
        """Return the segments from a vertex to the next, and for each 1 if it is run from its lower node, else -1."""
        line = self.line_of[min(one, other), max(one, other)]
        walk = self.walks[line]
        same = walk[0] == self.node_of[one]
        return self.paths[line], [1 if (a < b) == same else -1 for a, b in pairwise(walk)]


def _covering(
    panels: FoldedPanels,
    nodes: Floats,
    segments: Ints,
    sides: Ints,
    cells: Sequence[tuple[int, ...]],
    walked: _Walked,
    distance: float,
) -> tuple[Ints, ...] | None:
    """Return the panels over each cell, by winding numbers; None if a panel winds round a cell in another way."""
    sheet = panels.sheet
    rows, columns, turns = list[int](), list[int](), list[int]()
    size = np.zeros(len(panels.mechanism.panels))
    rim = np.zeros(len(panels.mechanism.panels))
    for face, corners in enumerate(sheet.faces):
        area = float(signed_area(panels.places[list(corners)]))
        panel = panels.panel_of_face[face]
        size[panel] += abs(area)
        for one, other in sides_of_face(corners):
            path, ways = walked.along(one, other)
            rows += path
            columns += [panel] * len(path)
            turns += ways if area > 0.0 else [-way for way in ways]
            rim[panel] += dist(panels.places[one], panels.places[other])
    crossing = csr_array((turns, (rows, columns)), shape=(len(segments), len(size)))
    crossing.sum_duplicates()
    # the dual graph, its tree from the outside: one step changes the windings by what runs along one segment
    count = len(cells)
    left_of, right_of = np.where(sides == OUTSIDE, count, sides).T
    steps = np.arange(len(segments)) + 1
    dual = coo_array((steps, (left_of, right_of)), shape=(count + 1, count + 1)).tocsr()
    number: dict[tuple[int, int], int] = {}
    for segment, pair in enumerate(zip(left_of.tolist(), right_of.tolist(), strict=True)):
        number.setdefault(pair, segment)
    order, parent = breadth_first_order(dual + dual.T, count, directed=False)
    winding = np.zeros((count + 1, len(size)), dtype=np.int8)
    for cell in order[1:].tolist():
        from_ = int(parent[cell])
        left = number.get((cell, from_))
        segment = left if left is not None else number[from_, cell]
        winding[cell] = winding[from_]
        begin, end = crossing.indptr[segment : segment + 2]
        winding[cell, crossing.indices[begin:end]] += (1 if left is not None else -1) * crossing.data[begin:end].astype(
            np.int8
        )
    if winding.min() < 0 or winding.max() > 1:
        return None
    areas = np.array([float(signed_area(nodes[list(cell)])) for cell in cells])
    if (np.abs(areas @ winding[:count] - size) > 4.0 * distance * rim).any() or not winding[:count, size > 0.0].any(
        axis=0
    ).all():
        return None
    return tuple(np.flatnonzero(row) for row in winding[:count])
