"""Symmetric drawings: their coordinates are mapped to themselves by turns and mirrors."""

import networkx as nx
import numpy as np
import pytest

from enumerate.scd.jobs import scd_graphs
from graphs.convert.conversions import to_scd
from graphs.errors import UnsolvableError
from graphs.files.formats import read
from graphs.identity.drawings import map_id, mechanism_from_map_id
from graphs.mechanism.drawing import FaceKind
from synth.catalogue.realisation._realise import realise
from synth.catalogue.realisation.conditions import symmetries
from synth.catalogue.realisation.pattern import pattern_of

VERTEX, ROUND_A_HOLE = "m1:a-b.ac-.b-d.cd-", "m1:a-b-.a-c-.b-d-.c-d-"
"""Four panels about a vertex, and about a centre across a hole."""


def _maps(sheet) -> int:
    """How many turns and mirrors of the plane, the identity among them, take vertices and creases to themselves.

    Each that does takes the vertex farthest from the middle to one as far, and the middle to itself.
    """
    points = np.array(sheet.coordinates) @ [1.0, 1.0j]
    points -= points.mean()
    first = points[np.abs(points).argmax()]
    creases = {frozenset(edge) for edge in sheet.edges}
    count = 0
    for other in points[np.abs(np.abs(points) - abs(first)) < 1e-9]:
        for image in (points * other / first, points.conjugate() * other / first.conjugate()):
            gaps = np.abs(image[:, None] - points[None])
            goes = gaps.argmin(axis=1)
            count += gaps.min(axis=1).max() < 1e-12 and {frozenset(goes[list(edge)]) for edge in creases} == creases
    return count


@pytest.mark.parametrize(
    ("name", "order"),
    [
        pytest.param("fortune-teller", 8, marks=pytest.mark.slow),
        ("ride-along", 4),
        ("remote-5-bar", 10),
        ("eight-bar", 2),
    ],
)
def test_coordinates_are_mapped_to_themselves(name, order, data):
    scd = read(data / "wiener" / f"{name}.json")
    found = realise(scd, symmetric=True, tries=1)
    assert _maps(found.sheet) == order
    assert found.condition_errors.off_symmetry < 1e-13
    assert map_id(to_scd(found.sheet)) == map_id(scd)
    assert found.condition_errors.symmetry in str(found)


def test_without_it_they_are_not(data):
    assert _maps(realise(read(data / "wiener" / "ride-along.json"), seed=1, tries=1).sheet) == 1


@pytest.mark.parametrize("code", [VERTEX, pytest.param(ROUND_A_HOLE, marks=pytest.mark.slow)])
def test_a_smaller_group_is_taken_where_the_largest_does_not_fold(code):
    """Two lines that cross cannot both fold: no half turn, no two mirrors, but one."""
    found = realise(mechanism_from_map_id(code), symmetric=True, flat_foldable=True, tries=2)
    assert found.folds
    assert _maps(found.sheet) == 2


def test_the_first_mirror_stands_upright(data):
    points = np.array(realise(read(data / "wiener" / "eight-bar.json"), symmetric=True, tries=1).sheet.coordinates)
    middle = (points[:, 0].min() + points[:, 0].max()) / 2
    mirrored = np.column_stack([2 * middle - points[:, 0], points[:, 1]])
    assert np.linalg.norm(points[:, None] - mirrored[None], axis=2).min(axis=1).max() < 1e-12


def test_a_type_without_symmetry_is_refused(data):
    with pytest.raises(UnsolvableError, match="no symmetry"):
        realise(read(data / "wiener" / "six-bar.json"), symmetric=True)


def _automorphisms(scd) -> int:
    """Maps of vertices, panels and joints that keep who is at whom and which face is outside: by search."""
    pattern = pattern_of(scd)
    graph = nx.Graph()
    for panel, around in enumerate(pattern.panels):
        graph.add_node(("panel", panel), kind=len(around))
        graph.add_edges_from((("panel", panel), ("vertex", v)) for v in around)
        graph.add_edges_from(
            (("vertex", v), ("vertex", w)) for v, w in zip(around, (*around[1:], around[0]), strict=True)
        )
    for vertex in range(pattern.vertices):
        graph.nodes["vertex", vertex]["kind"] = "outside" if vertex in pattern.outer else "inside"
    matcher = nx.isomorphism.GraphMatcher(graph, graph, node_match=lambda one, other: one["kind"] == other["kind"])
    return sum(1 for _ in matcher.isomorphisms_iter())


def _is_explicit(scd) -> bool:
    return all(scd.drawing.kind_of_face(face.index) is not FaceKind.IMPLICIT for face in scd.faces)


@pytest.mark.parametrize(
    ("links", "most"), [(4, 4), pytest.param(6, 4, marks=pytest.mark.slow), pytest.param(4, 6, marks=pytest.mark.slow)]
)
def test_the_largest_group_is_that_of_a_search(links, most):
    """With a centre across a hole too, as long as it is finite."""
    types = [
        scd for scd in scd_graphs(links, 1, most) if all(one.centre.value == "finite" for one in scd.centre_classes())
    ]
    orders = []
    for scd in types:
        groups = symmetries(pattern_of(scd))
        orders.append(groups[0].turns + groups[0].mirrors if groups else 1)
        assert orders[-1] == _automorphisms(scd), map_id(scd)
    assert len(set(orders)) > 2


def test_parallel_creases_leave_half_turns_and_mirrors():
    """Six panels round a hole: with a centre in a point the symmetries of a hexagon, of a rectangle without."""
    ring = "m1:a-b-.a-c-.b-d-.c-e-.d-f-.e-f-"
    largest = [symmetries(pattern_of(mechanism_from_map_id(code)))[0] for code in (ring, ring + ";i", ring + ";s")]
    assert [(one.turns, one.mirrors) for one in largest] == [(6, 6), (2, 2), (6, 6)]
