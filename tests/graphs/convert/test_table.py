import random

import networkx as nx
import pytest
from hypothesis import given
from strategies import scd_graphs

from graphs.convert.conversions import CONVERSIONS, to_polyhedron, to_sc, to_scd, to_sheet, to_vertex_edge
from graphs.convert.panels import oriented_panels, scd_from_panels
from graphs.count.report import mobility_report
from graphs.errors import InvariantError, UnsolvableError
from graphs.loops.loop import Loop
from graphs.mechanism.polyhedron import PolyhedronModel, RemoteCentre
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.vertex_edge import VertexEdgeGraph, sc_from_vertex_edge, vertex_edge_from_sc

GRID = VertexEdgeGraph(
    {"A": ("ab", "a1", "a2", "ac"), "B": ("b1", "b2", "ab", "bd"), "C": ("cd", "ac", "c1", "c2"),
     "D": ("d1", "bd", "cd", "d2")}
)  # fmt: skip
"""Four vertices of degree four in a square: the nine-bar mesh."""


def test_the_vertex_edge_graph_of_the_nine_bar_mesh():
    sc = sc_from_vertex_edge(GRID)
    assert (len(sc), len(sc.joints), len(sc.loops), sc.spatial_loops) == (9, 12, 4, 0)
    mesh = scd_from_panels(
        [(4 * i + j, 4 * i + j + 1, 4 * i + j + 5, 4 * i + j + 4) for i in range(3) for j in range(3)]
    )
    assert nx.is_isomorphic(nx.Graph(sc), nx.Graph(mesh))
    assert vertex_edge_from_sc(sc).is_identical(GRID)
    assert sorted(dict(GRID.to_networkx().degree()).values()) == [2, 2, 2, 2]


def test_a_closed_vertex_edge_graph_has_a_closing_loop():
    tetrahedron = VertexEdgeGraph({"A": "abc", "B": "aed", "C": "bdf", "D": "cfe"})
    sc = sc_from_vertex_edge(tetrahedron)
    assert (len(sc), len(sc.joints), len(sc.loops), len(sc.closing)) == (4, 6, 3, 1)
    assert mobility_report(sc).mobility == 6 - 3 * 4 + 6
    assert vertex_edge_from_sc(sc).is_identical(tetrahedron) or _mirrored(vertex_edge_from_sc(sc), tetrahedron)


def _mirrored(one, two):
    return one.is_identical(VertexEdgeGraph({v: creases[::-1] for v, creases in two.vertices.items()}))


@pytest.mark.parametrize(
    ("vertices", "message"),
    [
        ({"A": "a"}, "vertex 'A' has the creases"),
        ({"A": "aab"}, "expected two or more, each once"),
        ({"A": "ab", "B": "ac", "C": "ad"}, "crease 'a' ends in 3 vertices; expected two at most"),
    ],
)
def test_what_is_no_vertex_edge_graph(vertices, message):
    with pytest.raises(InvariantError, match=message):
        VertexEdgeGraph(vertices)


@pytest.mark.parametrize(
    ("sc", "message"),
    [
        (SCGraph(3, [(0, 1), (1, 2), (2, 0)], [Loop((0, 1, 2), "infinite")]), "a finite centre in every loop"),
        (SCGraph(3, [(0, 1), (1, 2), (2, 0)]), "a finite centre in every loop"),
        (SCGraph(4, [(0, 1), (1, 2), (2, 0), (2, 3)], [Loop((0, 1, 2))]), "joint 3 lies in 0 loops"),
    ],
)
def test_what_has_no_vertex_edge_graph(sc, message):
    with pytest.raises(UnsolvableError, match=message):
        vertex_edge_from_sc(sc)


def test_panels_are_turned_alike_whichever_way_they_come():
    faces = {k: (0, k + 1, (k + 1) % 5 + 1) for k in range(5)}
    rng = random.Random(3)
    for _ in range(20):
        mixed = {k: tuple(reversed(f)) if rng.random() < 0.5 else f for k, f in faces.items()}
        scd = scd_from_panels(mixed)
        assert (scd.counts.vertices, len(scd.loops)) == (6, 1)


def test_a_moebius_band_of_panels_is_refused():
    with pytest.raises(InvariantError, match="expected a surface with two sides"):
        oriented_panels({0: (0, 1, 2, 3), 1: (3, 2, 4, 5), 2: (5, 4, 0, 1)})


@pytest.mark.parametrize(
    ("panels", "message"),
    [
        ([(0, 1, 1)], "names a vertex twice"),
        ([(0, 1, 2), (0, 1, 3), (0, 1, 4)], "belongs to 3 panels; expected two at most"),
        ([(0, 1, 2), (3, 4, 5)], "the graph has 2 parts; expected one"),
        ([(0, 1)], "panel 0 has 2 vertices; expected three or more"),
    ],
)
def test_odd_panels_are_refused(panels, message):
    with pytest.raises(InvariantError, match=message):
        scd_from_panels(panels)


def test_a_tetrahedron_of_panels_is_closed():
    scd = scd_from_panels([(0, 1, 2), (0, 2, 3), (0, 3, 1), (1, 3, 2)])
    report = mobility_report(scd)
    assert (report.mechanism_class, report.mobility, scd.counts.vertices) == ("closed", 0, 4)
    assert report.equations["polyhedron"].value == 3 * 4 - 6 - 6


def test_the_outer_boundary_may_be_named():
    ring = [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    for side in ((0, 1), (4, 5)):
        scd = scd_from_panels(ring, outer=side)
        on_outer = {v for face in [scd.faces[scd.drawing.outer_face]] for c in face.corners for v in [c.link]}
        assert on_outer == {0, 1, 2, 3}
    assert scd_from_panels(ring, outer=(0, 1)).outer != scd_from_panels(ring, outer=(4, 5)).outer


def test_conversions_tell_what_stands_in_the_way():
    bare = SCGraph(2, [(0, 1)])
    model = PolyhedronModel(4, [(0, 1)], centres=[RemoteCentre(3)], links={0: (0, 1, 2)})
    flat = Sheet(4, ((0, 2),), "F", ((0, 1, 2), (0, 2, 3)))
    cut = Sheet(4, ((0, 2),), "B", ((0, 1, 2), (0, 2, 3)))
    for convert, thing, message in [
        (to_scd, bare, "the order of the sides of the links is not known"),
        (to_scd, PolyhedronModel(1), "no rods that show its links"),
        (to_scd, PolyhedronModel(2, [(0, 1)]), "vertices 0, 1 are ambiguous: the rod between them lies in no triangle"),
        (to_scd, model, "remote centre 0 is no implicit centre"),
        (to_sheet, PolyhedronModel(1), "does not say which vertices"),
        (to_scd, flat, "the sheet has flat edges"),
        (to_scd, cut, "the sheet has cuts"),
        (to_vertex_edge, bare, "needs|lies in 0 loops"),
    ]:
        with pytest.raises(UnsolvableError, match=message):
            convert(thing)


@given(scd_graphs)
def test_every_road_from_an_scd_graph_ends_at_the_same_links_and_joints(scd):
    for kind in ("sc", "scd", "polyhedron", "sheet"):
        there = CONVERSIONS[kind](scd)
        if isinstance(there, PolyhedronModel) and there.centres:
            with pytest.raises(UnsolvableError, match="more than panels"):
                to_sc(there)
            continue
        sc = to_sc(there)
        assert (len(sc), len(sc.joints)) == (len(scd), len(scd.joints))


def test_coordinates_go_with_the_polyhedron_model():
    sheet = Sheet(4, (), "", ((0, 1, 2), (0, 3, 2)), ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)))
    model = to_polyhedron(sheet)
    for link, face in enumerate(sheet.faces):
        assert {model.coordinates[v][:2] for v in model.links[link]} == {sheet.coordinates[v] for v in face}
    for a, b in model.edges:
        assert model.coordinates[a] != model.coordinates[b]
