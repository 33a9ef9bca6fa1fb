"""Planar graphs are drawn without crossings, and symmetries as mirrors: looked at as geometry alone."""

from itertools import combinations, islice

import networkx as nx
import pytest
from shapely.geometry import LineString, Point, Polygon

from enumerate.chains.jobs import chains
from graphs.identity.chains import chain_from_id
from synth.making.drawing.layout.mechanisms import layout_of


def shape_of(row):
    return Polygon(row) if len(row) > 2 else LineString(row)


def assert_bodies_meet_at_joints_only(graph, layout):
    """Two links have their joint in common and nothing else; each is simple, and has some width."""
    shapes = {link: shape_of(row) for link, row in layout.outlines.items()}
    at = {frozenset(ends): layout.joints[joint] for joint, ends in enumerate(graph.edges)}
    for link, shape in shapes.items():
        assert shape.is_valid, link
        assert shape.length > 0.1, link
    for a, b in combinations(shapes, 2):
        common = shapes[a].intersection(shapes[b])
        joint = at.get(frozenset((a, b)))
        if joint is None:
            assert common.is_empty, (a, b)
        else:
            assert common.distance(LineString([joint, joint])) < 1e-9, (a, b)
            assert common.buffer(1e-9).area < 1e-12, (a, b)


def assert_links_as_dots_do_not_cross(graph):
    layout = layout_of(graph.nodes, dict(enumerate(graph.edges)), as_bodies=False)
    lines = {joint: LineString(row) for joint, row in layout.ways.items()}
    ends = dict(enumerate(graph.edges))
    for one, other in combinations(lines, 2):
        if not set(ends[one]) & set(ends[other]):
            assert not lines[one].intersects(lines[other]), (one, other)
        else:
            assert lines[one].intersection(lines[other]).length < 1e-9


def check(graph):
    """Return whether a chain was drawn plane, and mirrored."""
    layout = layout_of(graph.nodes, dict(enumerate(graph.edges)))
    assert layout.plane == nx.check_planarity(graph)[0] == graph.graph.get("planar", layout.plane)
    if layout.plane:
        assert_bodies_meet_at_joints_only(graph, layout)
        assert len(layout.faces) == len(graph.edges) - len(graph) + 1
    if layout.mirror is not None:
        assert_mirrored(graph, layout)
    return layout.plane, layout.mirror is not None


def assert_mirrored(graph, layout):
    """The symmetry is one of the graph, and takes each place to its image in an upright line."""
    mirror = layout.mirror
    assert any(mirror[link] != link for link in graph)
    assert {frozenset((mirror[a], mirror[b])) for a, b in graph.edges} == set(map(frozenset, graph.edges))
    axis = sum(x for x, _ in layout.links.values()) / len(layout.links)
    for link, image in mirror.items():
        (x, y), (u, v) = layout.links[link], layout.links[image]
        assert x + u == pytest.approx(2 * axis, abs=1e-6)
        assert y == pytest.approx(v, abs=1e-6)


def test_some_chains_of_eight_links():
    found = [check(graph) for graph in islice(chains(8, 1), 0, 16, 4)]
    assert found == [(True, True), (True, True), (True, True), (True, False)]


def clearance(layout):
    """The least distance of a joint from a link that does not have it, or from the opposite side of its own link."""
    sides = [
        (row[i], row[(i + 1) % len(row)])
        for row in layout.outlines.values()
        for i in range(len(row) if len(row) > 2 else 1)
    ]
    return min(
        LineString(side).distance(Point(at)) for side in sides for at in layout.joints.values() if at not in side
    )


def test_links_of_eight_link_chains_are_wide_and_apart():
    """No joint is near a link without it, and no link is a needle."""
    graphs = [graph for number, graph in enumerate(chains(8, 1), 1) if number in (4, 5, 15, 16)]
    apart = [clearance(layout_of(graph.nodes, dict(enumerate(graph.edges)))) for graph in graphs]
    assert min(apart) > 0.25
    assert min(apart[1:]) > 0.6


@pytest.mark.slow
def test_chains_of_eight_links():
    """Of 16 chains 11 can be drawn so that a symmetry is a mirror."""
    found = [check(graph) for graph in chains(8, 1)]
    assert all(plane for plane, _ in found)
    assert sum(mirror for _, mirror in found) == 11


def test_links_as_dots():
    for graph in chains(6, 1):
        assert_links_as_dots_do_not_cross(graph)


def test_a_chain_that_is_not_planar():
    graph = nx.complete_bipartite_graph(3, 3)
    layout = layout_of(graph.nodes, dict(enumerate(graph.edges)))
    assert not layout.plane
    assert not layout.faces


@pytest.mark.parametrize(
    "graph", [nx.path_graph(2), nx.path_graph(5), nx.star_graph(4), nx.barbell_graph(4, 2), nx.empty_graph(2)]
)
@pytest.mark.parametrize("as_bodies", [True, False])
def test_graphs_that_a_link_cuts(graph, as_bodies):
    """Trees, chains that hang on a link, graphs in pieces: every link and joint has a place of its own."""
    layout = layout_of(graph.nodes, dict(enumerate(graph.edges)), as_bodies=as_bodies)
    assert layout.plane
    assert len(set(layout.links.values())) == len(graph)
    assert len(set(layout.joints.values())) == len(graph.edges)


@pytest.mark.parametrize("as_bodies", [True, False])
def test_links_that_share_two_joints(as_bodies):
    joints = {0: (0, 1), 1: (0, 1), 2: (1, 2), 3: (2, 0)}
    layout = layout_of(range(3), joints, as_bodies=as_bodies)
    assert layout.plane
    assert len(set(layout.joints.values())) == 4


def test_a_given_drawing_is_kept():
    """The rotation that is asked for, counter-clockwise as it is seen."""
    joints = {i: (0, i + 1) for i in range(3)} | {i + 3: (i + 1, (i + 1) % 3 + 1) for i in range(3)}
    for turn in ((0, 1, 2), (0, 2, 1)):
        around = {0: turn}
        for i in range(3):
            sides = (i, 3 + i, 3 + (i + 2) % 3)
            around[i + 1] = sides if turn == (0, 2, 1) else sides[::-1]
        layout = layout_of(range(4), joints, as_bodies=False, rotation=around, outer=(3, 4, 5))
        a, b, c = (layout.links[joint + 1] for joint in turn)
        assert (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0


def test_a_side_too_short_to_be_seen_is_opened_by_another_outer_face():
    """Of the planar chains of twelve links the one that, with its largest face outside, has two bars of no length."""
    check(chain_from_id("k1:K@?K?SDS@CwD"))


@pytest.mark.slow
def test_planar_chains_of_ten_links():
    found = [check(graph) for graph in chains(10, 1)]
    assert sum(plane for plane, _ in found) == 219
    assert sum(mirror for _, mirror in found) == 58


@pytest.mark.slow
def test_planar_chains_of_twelve_links():
    found = [check(graph) for graph in chains(12, 1, planar=True)]
    assert len(found) == 5918
    assert sum(mirror for _, mirror in found) == 393
