"""What a mechanism is: graphs, their drawings, centres, models."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import replace
from math import dist

import synth
from drawings.altered import DASH, mirrored, over, plain_graph, without
from drawings.examples import generated_sheet, sheet_of_file
from drawings.patterned import Patterned
from drawings.together import above, beside, said
from graphs.identity.drawings import map_id, mechanism_from_map_id
from graphs.loops.loop import Centre
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.vertex_edge import vertex_edge_from_sc
from graphs.types import JointId
from synth.making.drawing import Scene
from synth.making.drawing.mechanisms.labelling import centre_sign
from synth.making.drawing.mechanisms.sc_graphs import class_numbers
from synth.making.drawing.scene.shapes import (
    FINE,
    NORMAL,
    SMALL,
    STRONG,
    Disc,
    Label,
    Line,
    Point,
    Shape,
    colour_of_class,
)

__all__ = ["DRAWINGS"]

_FREE = 22.0
"""Points that are drawn of a crease which runs to the border."""
_TWO_DRAWINGS = ("m1:a--b.ac-.bde.cef.d--g.fg-", "m1:a--b.ac-.bde.cef.d-g.fg--")
"""Of Watt's chain, with as many open edges."""


def sc_graphs() -> Scene:
    """A panel mechanism beside its link-joint graph with the centres of its loops."""
    teller = Patterned(sheet_of_file("realised/fortune-teller.fold"), 200.0)
    return beside(
        said(teller.scene(), "panels and creases"),
        said(
            _graph(teller.mechanism.sc, 200.0),
            "links (discs), joints (lines),",
            "the centre of each loop (circled dot)",
        ),
    )


def scd_graphs() -> Scene:
    """Six links about a vertex, and six round a hole: explicit and implicit centre, as panels and as drawings."""
    return beside(
        said(_panels_and_drawing("six-bar-loop-spherical"), "explicit centre: a vertex, all links reach it"),
        said(_panels_and_drawing("remote-6-bar"), "implicit centre: open edges (stubs) on the face"),
        gap=30.0,
    )


def _panels_and_drawing(name: str) -> Scene:
    """Return the panels of one loop, its creases drawn on to where they meet, above its SCD graph."""
    pattern = Patterned(sheet_of_file(f"realised/{name}.fold"), 150.0)
    scd = synth.convert(pattern.sheet, "scd")
    assert isinstance(scd, SCDGraph)
    return above(over(pattern.scene(), _meeting(pattern, pattern.joints, 0)), _graph(scd, 150.0), gap=2.0)


def _meeting(pattern: Patterned, joints: Sequence[JointId], number: int) -> list[Shape]:
    """Return dashes from creases to the point where they meet, and the sign of a finite centre there."""
    centre = pattern.meeting(joints)
    dashes: list[Shape] = [Line(pattern.towards(joint, centre), "grey", FINE, DASH) for joint in joints]
    return [*dashes, *centre_sign(centre, Centre.FINITE, colour_of_class(number))]


def centre_classes() -> Scene:
    """Two loops that share one crease, and two that share two: two centres, and one."""
    return beside(
        said(_two_loops("watt"), "loops that share one crease (thick):", "two centres"),
        said(
            _two_loops("stephenson"),
            "loops that share two creases (thick):",
            "one centre, of the vertex and of the hole",
        ),
    )


def _two_loops(name: str) -> Scene:
    """Return a mechanism of two loops, their shared creases thick, all creases drawn on to their centres."""
    pattern = Patterned(sheet_of_file(f"realised/{name}.fold"), 200.0)
    sc = pattern.mechanism.sc
    numbers = class_numbers(sc)
    thick: list[Shape] = [Line(pattern.crease(joint), "ink", 1.5 * STRONG) for joint in pattern.shared(0, 1)]
    signs = [shape for place, loop in enumerate(sc.loops) for shape in _meeting(pattern, loop.joints, numbers[place])]
    return over(pattern.scene(), [*thick, *signs])


def polyhedron_model() -> Scene:
    """Four folded panels beside the vertices and rods that stand for them."""
    sheet = generated_sheet("miura", rows=2, columns=2, fold=1.2)
    model = synth.convert(sheet, "polyhedron")
    assert isinstance(model, PolyhedronModel)
    panels = synth.draw(sheet, numbers=False, box=(210.0, 210.0), caption=None)
    vertices, rods = len(model), model.number_of_edges()
    return beside(
        said(panels, "four links, each of four sides"),
        said(
            _rods_of(model),
            f"{vertices} vertices, {rods} rods (dashed: inside a link)",
            f"M = 3 × {vertices} − {rods} − 6 = {3 * vertices - rods - 6}",
        ),
    )


def _rods_of(model: PolyhedronModel) -> Scene:
    """Return the picture of a model, the rods inside links dashed."""
    corners = (model.links or {}).values()
    sides = {frozenset(side) for row in corners for side in zip(row, (*row[1:], row[0]), strict=True)}
    scene = without(synth.draw(model, box=(210.0, 210.0), caption=None), "labels")
    rods, *others = scene.layers
    drawn = [
        line if frozenset(ends) in sides else Line(line.points, "class0", FINE, DASH)
        for ends, line in zip(model.edges, rods.shapes, strict=True)
        if isinstance(line, Line)
    ]
    return replace(scene, layers=(replace(rods, shapes=tuple(drawn)), *others))


def vertex_edge_graphs() -> Scene:
    """A crease pattern and the vertex-edge graph that lies in it."""
    pattern = Patterned(sheet_of_file("patterns/bird-base.fold"), 200.0)
    return beside(
        said(pattern.scene(colour="letters"), "crease pattern"),
        said(
            _vertex_edge(pattern), "vertex-edge graph: a vertex for each centre,", "an edge for each crease between two"
        ),
    )


def _vertex_edge(pattern: Patterned) -> Scene:
    """Return the vertex-edge graph of a pattern, where its centres lie; creases to the border end free."""
    graph = vertex_edge_from_sc(pattern.mechanism.sc)
    places = [pattern.places[vertex] for vertex in pattern.mechanism.loop_vertices]
    at: dict[Hashable, Point] = dict(enumerate(places))
    edges: list[Shape] = []
    for joint, ends in graph.creases.items():
        if len(ends) == 2:
            edges.append(Line([at[end] for end in ends], "ink", STRONG))
        else:
            edges.append(Line(_begun(at[ends[0]], pattern.crease(joint)), "grey", NORMAL))
    vertices: list[Shape] = [Disc(place, 4.0, "paper", "ink", STRONG) for place in at.values()]
    return over(replace(pattern.scene(), layers=()), [*edges, *vertices])


def _begun(start: Point, crease: list[Point]) -> list[Point]:
    """Return the beginning of a crease from one of its ends."""
    x, y = max(crease, key=lambda end: dist(end, start))
    part = _FREE / dist((x, y), start)
    return [start, (start[0] + part * (x - start[0]), start[1] + part * (y - start[1]))]


def crease_patterns() -> Scene:
    """A pattern with a vertex and a hole, and its mechanism: what the faces and creases become."""
    pattern = Patterned(sheet_of_file("realised/hybrid-ten-bar.fold"), 200.0)
    sc = pattern.mechanism.sc
    x, y = pattern.middle_of_hole()
    words: list[Shape] = [
        Label((x, y + line * SMALL), text, SMALL, halo=False) for line, text in ((-0.7, "hole:"), (0.7, "no centre"))
    ]
    joints, freedoms = len(sc.joints), len(sc.joints) - 3 * len(sc.centred_loops) - 6 * sc.spatial_loops
    return beside(
        said(pattern.scene(), "crease pattern"),
        said(
            over(plain_graph(pattern.scene(graph=True, colour="centres")), words),
            "a link in each panel, a joint across each crease,",
            f"a centre at each inner vertex: M = {joints} − 3 − 6 = {freedoms}",
        ),
    )


def map_codes() -> Scene:
    """A drawing, its mirror image, and another drawing of the same links and joints, with their ids."""
    one, other = map(mechanism_from_map_id, _TWO_DRAWINGS)
    assert isinstance(one, SCDGraph)
    return beside(
        said(_graph(one, 150.0), "a drawing", map_id(one)),
        said(mirrored(_graph(one, 150.0)), "its mirror image: the same id", map_id(_mirror_image(one))),
        said(_graph(other, 150.0), "another drawing: another id", map_id(other)),
    )


def _mirror_image(scd: SCDGraph) -> SCDGraph:
    """Return the drawing turned over: sides clockwise, the outer face on the other side of its joint."""
    assert scd.outer is not None
    joint, side = scd.outer
    outer = (joint, "right" if side == "left" else "left")
    rotation = {link: sides[::-1] for link, sides in scd.rotation.items()}
    return SCDGraph(scd.nodes, scd.joints, scd.loops, rotation=rotation, outer=outer)


def _graph(graph: SCGraph, side: float) -> Scene:
    return plain_graph(synth.draw(graph, kind="graph", box=(side, side), caption=None))


DRAWINGS: dict[str, Callable[[], Scene]] = {
    "sc-graphs": sc_graphs,
    "scd-graphs": scd_graphs,
    "centre-classes": centre_classes,
    "polyhedron-model": polyhedron_model,
    "vertex-edge-graphs": vertex_edge_graphs,
    "crease-patterns": crease_patterns,
    "map-codes": map_codes,
}
"""Theory page to what draws its picture."""
