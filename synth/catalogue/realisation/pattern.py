"""The panels, creases and borders of a type in numbers, and which creases point to which centre.

A bounded face without open edges is an inner vertex; one with open edges is a hole; the outer face is the border.
Theory: docs/theory/realisation.md.
"""

from collections.abc import Hashable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import networkx as nx
import numpy as np

from enumerate.scd.jobs import simplest_scd_graph
from graphs.convert.conversions import Mechanism, to_scd
from graphs.convert.panels import rings_of
from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.loops.loop import Centre
from graphs.mechanism.drawing import FaceKind
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Edge, Sheet, sides_of_face
from graphs.types import Flags, Floats, Ints, JointId, LinkId


@dataclass(frozen=True, slots=True)
class Pointing:
    """Creases (places in ``Pattern.creases``) that point to a centre which they do not reach.

    They are parallel if it is infinite. `vertex` is the vertex that the centre is, where another loop of its class
    has it explicit; `holes` are the places in ``Pattern.holes`` of the holes that it lies across.
    """

    creases: tuple[int, ...]
    infinite: bool
    vertex: int | None
    holes: tuple[int, ...]


class Sides(NamedTuple):
    """Which side follows which along its panel, counter-clockwise (`after`) and clockwise (`before`).

    A side is a pair of vertices, directed so that its panel is on the left. `creases` gives the crease that a side
    is, in both directions; sides of the border are not in it.
    """

    after: dict[Edge, Edge]
    before: dict[Edge, Edge]
    creases: dict[Edge, int]


@dataclass(frozen=True)
class Pattern:
    """The panels of a type, without coordinates.

    `panels` are the vertices of each link, `outer` those of the border and `holes` those round each hole, all
    counter-clockwise; `creases` are the two vertices of each joint.
    """

    links: tuple[LinkId, ...]
    joints: tuple[JointId, ...]
    panels: tuple[tuple[int, ...], ...]
    vertices: int
    creases: tuple[Edge, ...]
    outer: tuple[int, ...]
    holes: tuple[tuple[int, ...], ...]
    pointings: tuple[Pointing, ...]

    @cached_property
    def corners(self) -> Ints:
        """int64[K, 3]: the vertices before, at and after each corner of a panel, panel by panel."""
        rows = [(p[i - 1], p[i], p[(i + 1) % len(p)]) for p in self.panels for i in range(len(p))]
        return np.array(rows, np.int64)

    @cached_property
    def panel_of_corner(self) -> Ints:
        """int64[K]: the panel of each corner."""
        return np.repeat(np.arange(len(self.panels)), [len(panel) for panel in self.panels])

    @cached_property
    def bent(self) -> Flags:
        """bool[P]: which panels cannot be convex.

        At most two sides of a convex panel have lines through a point outside it, or through one of its vertices:
        a link with three axes through a centre is no convex panel.
        """
        sides = [{frozenset(side) for side in sides_of_face(panel)} for panel in self.panels]
        bent = np.zeros(len(self.panels), dtype=bool)
        for pointing in self.pointings:
            through = [frozenset(self.creases[crease]) for crease in pointing.creases]
            through += [frozenset(crease) for crease in self.creases if pointing.vertex in crease]
            bent |= np.array([sum(crease in row for crease in through) > 2 for row in sides])
        return bent

    @property
    def free_centres(self) -> list[Pointing]:
        """The pointings to centres that are no vertices, in the order of their numbers."""
        return [pointing for pointing in self.pointings if pointing.vertex is None]

    @cached_property
    def panel_of_side(self) -> dict[Edge, int]:
        """The panel on the left of each directed side."""
        return {side: number for number, panel in enumerate(self.panels) for side in sides_of_face(panel)}

    @cached_property
    def widest(self) -> Floats:
        """float[K]: upper bounds of the angles of corners: pi, or 2 pi in a panel that cannot be convex."""
        return np.asarray(np.where(self.bent[self.panel_of_corner], 2 * np.pi, np.pi))

    @cached_property
    def edges(self) -> Ints:
        """int64[E, 2]: creases, then borders of the sheet and its holes."""
        borders = [side for ring in (self.outer, *self.holes) for side in sides_of_face(ring)]
        return np.array([*self.creases, *borders], np.int64)

    @cached_property
    def hubs(self) -> tuple[int, ...]:
        """The places of the panels that cannot be convex, each of which has a hub."""
        return tuple(np.flatnonzero(self.bent).tolist())

    @cached_property
    def seen_from_hubs(self) -> Ints:
        """int64[S, 3]: each side of a panel that cannot be convex, its hub between the ends.

        Hubs have the numbers after those of the centres that are no vertices.
        """
        first = self.vertices + len(self.free_centres)
        panels = [self.panels[place] for place in self.hubs]
        rows = [(b, hub, a) for hub, panel in enumerate(panels, first) for a, b in sides_of_face(panel)]
        return np.array(rows, np.int64).reshape(-1, 3)

    @cached_property
    def aims(self) -> Ints:
        """int64[A, 4]: the ends of each crease that points to a centre, the centre, and whether it is infinite.

        Centres that are no vertices have the numbers after those of the vertices.
        """
        rows, free = [], self.vertices
        for pointing in self.pointings:
            centre = free if pointing.vertex is None else pointing.vertex
            free += pointing.vertex is None
            rows += [(*self.creases[crease], centre, pointing.infinite) for crease in pointing.creases]
        return np.array(rows, np.int64).reshape(-1, 4)

    @cached_property
    def directions(self) -> Ints:
        """int64[D]: the numbers of the infinite centres."""
        return np.unique(self.aims[self.aims[:, 3] == 1, 2])

    @cached_property
    def inner(self) -> Ints:
        """int64[I]: the vertices with panels all round."""
        border = {vertex for ring in (self.outer, *self.holes) for vertex in ring}
        return np.array([v for v in range(self.vertices) if v not in border], np.int64)

    @cached_property
    def turns_of_panels(self) -> Floats:
        """float[P]: the sums of the corners of each panel, radians."""
        return np.pi * (np.array([len(panel) for panel in self.panels]) - 2)

    def sums_at(self, vertices: Sequence[int] | Ints) -> Floats:
        """Return float[n, K], which sums the corners at each of some vertices."""
        return np.asarray(self.corners[None, :, 1] == np.array(vertices, np.int64)[:, None], dtype=np.float64)

    @cached_property
    def sums_at_inner(self) -> Floats:
        """float[I, K]: what sums the corners at each inner vertex."""
        return self.sums_at(self.inner)

    @cached_property
    def sums_at_rings(self) -> tuple[Floats, ...]:
        """float[n, K]: what sums the corners at each vertex of the border, then of each hole."""
        return tuple(self.sums_at(ring) for ring in (self.outer, *self.holes))

    @cached_property
    def pairs_of_edges(self) -> tuple[Ints, Ints]:
        """int64[Q], int64[Q]: all pairs of edges without a vertex in common."""
        first, second = np.triu_indices(len(self.edges), 1)
        apart = (self.edges[first][:, :, None] != self.edges[second][:, None, :]).all(axis=(1, 2))
        return first[apart], second[apart]

    @cached_property
    def vertices_off_edges(self) -> tuple[Ints, Ints]:
        """int64[Q], int64[Q]: vertices, and edges that do not end there."""
        off = (self.edges[None] != np.arange(self.vertices)[:, None, None]).all(axis=2)
        vertex, edge = np.nonzero(off)
        return vertex, edge

    @cached_property
    def sides(self) -> Sides:
        """Which side of a panel follows which."""
        after: dict[Edge, Edge] = {}
        for panel in self.panels:
            sides = list(sides_of_face(panel))
            after.update(zip(sides, [*sides[1:], sides[0]], strict=True))
        creases = {side: number for number, (a, b) in enumerate(self.creases) for side in ((a, b), (b, a))}
        return Sides(after, {second: first for first, second in after.items()}, creases)

    @cached_property
    def rounds(self) -> list[tuple[int, ...]]:
        """The creases in the order in which a walk meets them, round each inner vertex, then each hole."""
        after, creases = self.sides.after, self.sides.creases
        starts = [next(side for side in after if side[0] == vertex) for vertex in self.inner.tolist()]
        starts += [next(side for side in sides_of_face(ring[::-1]) if side in after) for ring in self.holes]
        rounds = []
        for start in starts:
            met, side = [], start
            while True:
                if side in creases:
                    met.append(creases[side])
                    side = side[::-1]  # the same crease, seen from the next panel
                side = after[side]
                if side == start:
                    break
            rounds.append(tuple(met))
        return rounds

    def far_end(self, vertex: int, crease: int) -> int:
        """Return the other end of a crease from a vertex."""
        a, b = self.creases[crease]
        return b if a == vertex else a

    @cached_property
    def _corner_of_side(self) -> dict[Edge, int]:
        return {(int(at), int(after)): number for number, (_, at, after) in enumerate(self.corners)}

    def corner_before(self, vertex: int, crease: int) -> int:
        """Return the corner at a vertex whose second side is a crease."""
        return self._corner_of_side[vertex, self.far_end(vertex, crease)]


def pattern_of(scd: SCDGraph) -> Pattern:
    """Return the pattern of a type.

    Raises `UnsolvableError` if the panels close to a surface without a border.
    """
    # the vertices along each face with open edges, the face on the left
    after = {}
    for link, sides in scd.rotation.items():
        around = scd.vertices[link]
        after.update({around[i]: around[i - 1] for i, side in enumerate(sides) if side is None})
    rings = rings_of(after)
    outer_vertex = _border_vertex(scd, scd.drawing.outer_face)
    if outer_vertex is None:
        raise UnsolvableError("the panels form a closed surface without a border, which cannot lie flat")
    outer = next(ring for ring in rings if outer_vertex in ring)
    holes = tuple(ring for ring in rings if ring is not outer)
    return Pattern(
        tuple(scd.nodes),
        tuple(scd.joints),
        tuple(scd.vertices[link] for link in scd.nodes),
        scd.drawing.vertex_count,
        tuple(scd.drawing.ends_of_joint(joint) for joint in scd.joints),
        outer[::-1],
        holes,
        tuple(_pointings(scd, holes)),
    )


def listed(word: str, names: Iterable[Hashable]) -> str:
    """Return names after a word for them: "panel 1", "panels 1, 2"."""
    texts = [shown(name) for name in names]
    return f"{word if len(texts) == 1 else word + 's'} {', '.join(texts)}"


def check_search(seed: int, tries: int) -> None:
    """Raise `InvariantError` for a seed or a number of tries that a search cannot have."""
    if seed < 0 or tries < 1:
        raise InvariantError("tries", f"seed {seed}, tries {tries}", "a seed of 0 or more, 1 try or more")


def sheet_of_places(pattern: Pattern, places: Floats) -> Sheet:
    """Return the panels of a pattern at places, float[V, 2] or float[V, 3], their creases unassigned."""
    creases = len(pattern.creases)
    return Sheet(
        pattern.vertices,
        tuple((int(a), int(b)) for a, b in pattern.edges),
        "U" * creases + "B" * (len(pattern.edges) - creases),
        pattern.panels,
        tuple(tuple(map(float, row)) for row in places),
    )


def _border_vertex(scd: SCDGraph, face: int) -> int | None:
    """Return a vertex of a face with open edges; None if it has none."""
    for corner in scd.faces[face].corners:
        if corner.open_edges:
            around = scd.vertices[corner.link]
            return around[(corner.first_side - 1) % len(around)]
    return None


def _pointings(scd: SCDGraph, holes: tuple[tuple[int, ...], ...]) -> list[Pointing]:
    """Return the creases of each centre class that do not end in its centre."""
    number = {joint: place for place, joint in enumerate(scd.joints)}
    faces_of: dict[frozenset[JointId], list[int]] = {}
    for face in scd.faces:
        loop = scd.drawing.loop_of_face(face.index)
        if loop is not None:
            faces_of.setdefault(frozenset(loop.joints), []).append(face.index)
    pointings = []
    for centre_class in scd.centre_classes():
        loops = [frozenset(scd.drawing.loops[loop].joints) for loop in centre_class.loops]
        faces = [face for joints in loops for face in faces_of[joints]]
        implicit = [face for face in faces if scd.drawing.kind_of_face(face) is FaceKind.IMPLICIT]
        explicit = [face for face in faces if scd.drawing.kind_of_face(face) is FaceKind.EXPLICIT]
        corners = [scd.faces[face].corners[0] for face in explicit[:1]]
        vertex = scd.vertices[corners[0].link][corners[0].last_side] if corners else None
        ends = {joint: scd.drawing.ends_of_joint(joint) for joint in centre_class.joints}
        creases = tuple(sorted(number[joint] for joint in centre_class.joints if vertex not in ends[joint]))
        if not creases:
            continue
        across = [_border_vertex(scd, face) for face in implicit]
        places = tuple(place for place, ring in enumerate(holes) if any(v in ring for v in across))
        pointings.append(Pointing(creases, centre_class.centre is Centre.INFINITE, vertex, places))
    return pointings


def check_holes(pattern: Pattern) -> None:
    """Raise `UnsolvableError` for a hole round which creases cannot turn once, their centre being outside it.

    The message names the panels round the hole and by how many half turns creases can turn in each.
    """
    # Round a hole the directions in which creases leave it turn once, against the rays from a centre outside it
    # too. In a panel with k sides between two such creases, away from the hole, they turn by at most k - 1 half
    # turns against the rays, and by none where they meet in the centre: along a side the direction crosses rays
    # one way, at each corner it turns by less than half a turn.
    for pointing in pattern.pointings:
        turns_round = (half_turns(pattern, pointing, hole) for hole in pointing.holes)
        short = [turns for turns in turns_round if turns is not None and sum(turns.values()) < 2]
        # A finite centre that is no vertex may lie in one of the holes.
        if len(short) > (not pointing.infinite and pointing.vertex is None):
            turns = short[-1]
            panels = listed("panel", (pattern.links[panel] for panel in turns))
            parts = " + ".join(map(str, turns.values()))
            raise UnsolvableError(
                "in a flat sheet the directions of creases would turn by 2 half turns round the hole between "
                f"{panels}, whose centre is outside it; they can turn by {sum(turns.values())} there: by {parts}"
            )


def half_turns(pattern: Pattern, pointing: Pointing, hole: int) -> dict[int, int] | None:
    """Return by how many half turns at most creases turn in each panel round a hole, whose centre is outside it.

    The hole is a place in `Pattern.holes`. None where something hangs into it: the panels round it are not just
    those between its creases.
    """
    ring = pattern.holes[hole]
    border = {frozenset(side) for side in sides_of_face(ring)}
    open_edges = (sum(frozenset(side) in border for side in sides_of_face(panel)) for panel in pattern.panels)
    inside = {panel: sides for panel, sides in enumerate(open_edges) if sides}
    reaching = [place for place, ends in enumerate(pattern.creases) if pointing.vertex in ends]
    creases = [crease for crease in (*pointing.creases, *reaching) if set(pattern.creases[crease]) & set(ring)]
    if len(creases) != len(inside):
        return None
    return {panel: max(len(pattern.panels[panel]) - 2 - sides - 1, 0) for panel, sides in inside.items()}


_MORE_SIDES = 4
"""Links have at most so many more sides than the link with the most joints has joints."""


def simplest_drawn(mechanism: Mechanism) -> tuple[SCDGraph, tuple[str, ...]]:
    """Return the SCD graph of a mechanism, with notes: for an SC graph the first with the fewest open edges.

    Raises `UnsolvableError` if it has no drawing, or no valid placement of open edges.
    """
    if isinstance(mechanism, SCDGraph) or not isinstance(mechanism, SCGraph):
        return to_scd(mechanism), ()
    if not nx.check_planarity(nx.Graph(mechanism))[0]:
        raise UnsolvableError("the chain is not planar: its panels cannot be drawn without crossings")
    widest = max(dict(mechanism.degree).values(), default=0)
    for most in range(max(3, widest), widest + _MORE_SIDES + 1):
        scd = simplest_scd_graph(mechanism, most)
        if scd is not None:
            number = numbered(scd.counts.open_edges, "open edge")
            return scd, (f"an SCD graph of the fewest open edges was taken: {number}",)
    raise UnsolvableError(f"no placement of open edges with links of up to {widest + _MORE_SIDES} sides is valid")
