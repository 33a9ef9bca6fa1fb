import pytest
from rigidity import chains_by_geng
from scd_oracle import code, scd_codes
from sizes import slow

from enumerate.runner._run import run
from enumerate.runner.job import row_as_dict
from enumerate.runner.sinks import CountSink, RowSink
from enumerate.sc.jobs import sc_rows
from enumerate.scd.jobs import (
    SCDJob,
    all_mechanisms,
    count_scd_graphs,
    mechanism_of,
    scd_count_job,
    scd_graphs,
    scd_graphs_of,
    scd_rows,
)
from enumerate.scd.patterns import number_of_placements
from enumerate.scd.query import PlacementQuery, SCDQuery
from graphs.convert.conversions import to_sc
from graphs.convert.panels import polyhedron_of
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read
from graphs.files.native import dumps
from graphs.identity.drawings import map_id, mechanism_from_map_id
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.drawing import FaceKind
from graphs.mechanism.sc import SCGraph
from graphs.rank.exact import exact_mobility
from graphs.rank.rods import exact_mobility_of_model

COUNTS = [
    (4, 1, 3, 1),
    (4, 1, 4, 7),
    (4, 1, 5, 42),
    (6, 1, 3, 1),
    (6, 1, 4, 27),
    (8, 1, 3, 2),
    (8, 1, 4, 260),
    (10, 1, 3, 6),
    (7, 2, 4, 81),
    (2, 1, 3, 1),
    (4, 3, 3, 3),
]


@pytest.mark.parametrize("method", ["orbits", "burnside"])
@pytest.mark.parametrize(("links", "dof", "most", "count"), COUNTS)
def test_counts(links, dof, most, count, method):
    assert count_scd_graphs(links, dof, most, method) == count


@pytest.mark.parametrize(
    ("links", "dof", "most", "options"),
    [(4, 1, 7, {}), (6, 1, 6, {}), (8, 1, 5, {}), (9, 2, 4, {}), (10, 1, 4, {}), (6, 5, 5, {}), pytest.param(8, 7, 4, {}, marks=pytest.mark.slow), (10, 9, 3, {}),
     (8, 1, 5, {"sheets": True}), slow(9, 1, 4, {"spatial": 1}), (9, 1, 3, {"spatial": 1}), (6, 1, 5, {"infinite": True})],
    ids=str,
)  # fmt: skip
def test_both_methods_agree(links, dof, most, options):
    found = [count_scd_graphs(links, dof, most, method, **options) for method in ("orbits", "burnside")]
    assert found[0] == found[1] > 0


@pytest.mark.parametrize(
    ("links", "dof", "most"),
    [(4, 1, 3), (4, 1, 4), slow(4, 1, 5), slow(5, 2, 4), (6, 1, 3), (7, 2, 3), slow(8, 1, 3),
     pytest.param(6, 1, 4, marks=pytest.mark.slow), pytest.param(7, 2, 4, marks=pytest.mark.slow),
     pytest.param(9, 2, 3, marks=pytest.mark.slow), pytest.param(10, 1, 3, marks=pytest.mark.slow)],
)  # fmt: skip
def test_against_all_placements(links, dof, most):
    """The oracle: nauty's chains, every rotation, outer face and placement that the constructor lets through."""
    expected = set()
    for graph in chains_by_geng(links, dof):
        expected |= scd_codes(list(graph.edges()), most)
    assert {code(scd) for scd in scd_graphs(links, dof, most)} == expected


@pytest.mark.parametrize(
    ("links", "most", "joints"), [(2, 4, [(0, 1)]), (3, 4, [(0, 1), (1, 2)]), (4, 3, None), (4, 4, None), (5, 3, None)]
)
def test_trees_against_all_placements(links, most, joints):
    trees = [joints] if joints else _trees(links)
    expected = set().union(*(scd_codes(tree, most) for tree in trees))
    assert {code(scd) for scd in scd_graphs(links, links - 1, most)} == expected


def _trees(links):
    import networkx as nx

    return [list(tree.edges()) for tree in nx.nonisomorphic_trees(links)]


def check(row, scd, tmp_path=None):
    """It reads back, it reconstructs, and by both roads it has the mobility it should have."""
    assert map_id(scd) == row["code"]
    assert not scd.loops or map_id(scd.sc_graph()) == row["sc"]
    result = exact_mobility(scd)
    assert (result.mobility, result.forced) == (row["exact_dof"], True)
    assert row["exact_dof"] == row["dof"]
    model = polyhedron_of(scd)
    assert exact_mobility_of_model(model).mobility == row["dof"]
    assert len(model) == scd.counts.vertices == row["vertices"]
    kinds = [scd.drawing.kind_of_face(face.index) for face in scd.faces]
    assert (kinds.count(FaceKind.EXPLICIT), kinds.count(FaceKind.IMPLICIT)) == (row["explicit"], row["implicit"])
    assert scd.counts.open_edges == row["open_edges"]
    degrees = [len(sides) for sides in scd.rotation.values()]
    assert row["sides"] == [degrees.count(d) for d in range(3, max(degrees) + 1)]
    if tmp_path is not None:
        file = tmp_path / "scd.json"
        file.write_text(dumps(scd), encoding="utf-8")
        assert read(file).is_identical(scd)


@pytest.mark.parametrize(
    ("links", "dof", "most", "every", "options"),
    [
        (4, 1, 4, 1, {}),
        slow(4, 1, 6, 5, {}),
        (6, 1, 4, 1, {}),
        slow(6, 1, 5, 10, {}),
        pytest.param(6, 1, 6, 100, {}, marks=pytest.mark.slow),
        (8, 1, 3, 1, {}),
        slow(8, 1, 4, 4, {}),
        (10, 1, 3, 1, {}),
        slow(10, 1, 4, 150, {}),
        (7, 2, 4, 3, {}),
        (10, 3, 4, 240, {}),
        pytest.param(10, 3, 4, 60, {}, marks=pytest.mark.slow),
        (9, 1, 3, 1, {"spatial": 1}),
        pytest.param(9, 1, 4, 4000, {"spatial": 1}, marks=pytest.mark.slow),
        pytest.param(12, 1, 3, 4, {"spatial": 2}, marks=pytest.mark.slow),
        (4, 1, 5, 3, {"infinite": True}),
        (6, 1, 4, 5, {"infinite": True}),
        (5, 4, 4, 20, {}),
        (7, 6, 3, 3, {}),
    ],
    ids=str,
)
def test_every_graph_reads_back_and_reconstructs(links, dof, most, every, options, tmp_path):
    codes = set()
    for number, row in enumerate(scd_rows(links, dof, most, **options)):
        codes.add(row["code"])
        if number % every == 0:
            check(row, mechanism_from_map_id(row["code"]), tmp_path)
    assert len(codes) == number + 1


@pytest.mark.slow
@pytest.mark.parametrize(("links", "dof", "most"), [(8, 1, 4), (10, 1, 4), (6, 1, 6), (10, 3, 4)])
def test_every_single_graph_reads_back_and_reconstructs(links, dof, most):
    for row in scd_rows(links, dof, most):
        check(row, mechanism_from_map_id(row["code"]))


def test_filters():
    rows = list(scd_rows(6, 1, 4))
    for options, keep in [
        ({"sheets": True}, lambda row: row["implicit"] == 0),
        ({"symmetric": True}, lambda row: row["symmetry"] > 1),
        ({"vertices": (8, 9)}, lambda row: 8 <= row["vertices"] <= 9),
    ]:
        expected = [row for row in rows if keep(row)]
        assert 0 < len(expected) < len(rows)
        assert list(scd_rows(6, 1, 4, **options)) == expected
        assert count_scd_graphs(6, 1, 4, **options) == len(expected)


def test_units_of_ranges():
    """A mechanism with more placements than fit a unit is taken in ranges of their numbers."""
    expected = list(scd_rows(6, 1, 5))
    job = SCDJob(all_mechanisms(6, 1, 5), unit_rows=20)
    assert len(job.units()) > 30
    found = []
    run(job, RowSink(lambda columns, rows: found.extend(rows)), workers=2)
    assert [row_as_dict(job.columns, row) for row in found] == expected


def test_of_a_mechanism(data):
    watt = read(data / "wiener" / "watt.json")
    every = [row["code"] for row in scd_rows(6, 1, 4)]
    found = [scd.graph["code"] for scd in scd_graphs_of(watt, 4)]
    assert len(set(found)) == len(found) == 27
    assert set(found) <= set(every)
    strange = watt.relabel({0: "a", 1: "zz"}, {3: "crease"})
    assert [scd.graph["code"] for scd in scd_graphs_of(strange, 4)] == found
    again = [scd.graph["code"] for scd in scd_graphs_of(next(scd_graphs_of(watt, 4)), 4)]
    assert again == found
    miura = to_sc(read(data / "wiener" / "miura-2x3.fold"))
    counted, listed = CountSink(), []
    run(scd_count_job(mechanism_of(miura, 5)), counted)
    run(SCDJob(mechanism_of(miura, 5)), RowSink(lambda columns, rows: listed.extend(rows)))
    assert counted.total == len(listed) == 621
    planar = watt.with_loops([Loop(loop.joints, Centre.INFINITE) for loop in watt.loops])
    assert all(row.graph["explicit"] == 0 for row in scd_graphs_of(planar, 5))


def test_what_cannot_be():
    for bad in ({"max_degree": 2}, {"max_degree": 90}, {"max_degree": 4, "vertices": (9, 3)}):
        with pytest.raises(InvariantError):
            PlacementQuery(**bad)
    with pytest.raises(InvariantError, match="links"):
        SCDQuery(1, 0, PlacementQuery(3))
    with pytest.raises(UnsolvableError, match="Burnside"):
        count_scd_graphs(6, 1, 4, "burnside", symmetric=True)
    with pytest.raises(UnsolvableError, match="placements of open edges"):
        list(scd_rows(16, 13, 60))
    ring = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2)]
    with pytest.raises(UnsolvableError, match="faces of a drawing"):
        mechanism_of(SCGraph(4, ring, [Loop((0, 1, 4))]), 4)
    big = SCGraph(70, [(i, (i + 1) % 70) for i in range(70)], [Loop(range(70))])
    with pytest.raises(InvariantError, match="64 in all"):
        mechanism_of(big, 4)


@pytest.mark.parametrize(("links", "dof", "most"), [(4, 1, 6), (6, 1, 5), (8, 1, 4), (7, 2, 4), (8, 3, 4)])
def test_orbits_have_the_sizes_that_symmetries_say(links, dof, most):
    """An SC graph with s symmetries has s / (symmetries of the SCD graph) placements in an orbit: all of them in sum."""
    symmetries = {row["code"]: row["symmetry"] for row in sc_rows(links, dof)}
    placements = dict.fromkeys(symmetries, 0)
    for row in scd_rows(links, dof, most):
        size, rest = divmod(symmetries[row["sc"]], row["symmetry"])
        assert rest == 0
        placements[row["sc"]] += size
    for sc, number in placements.items():
        source = mechanism_of(mechanism_from_map_id(sc), most).source
        assert number_of_placements(source.codes[0], source.labels[0], most) == number
