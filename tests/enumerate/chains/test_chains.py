import json
from collections import Counter
from itertools import combinations, permutations
from pathlib import Path

import networkx as nx
import pytest
from rigidity import chains_by_geng
from sizes import slow

from enumerate.chains.fractionated import glued, shapes
from enumerate.chains.jobs import chain_rows, chains, count_chains, count_job
from enumerate.chains.query import ChainQuery
from enumerate.chains.rows import are_inputs, input_choices
from enumerate.runner._run import run
from enumerate.runner.sinks import CountSink
from graphs.errors import InvariantError, UnsolvableError
from graphs.identity.chains import automorphisms_of, chain_id

COUNTS = {
    1: {4: 1, 6: 2, 8: 16, 10: 230, 12: 6856, 14: 318162},
    2: {5: 1, 7: 3, 9: 35, 11: 753},
    3: {6: 1, 8: 5, 10: 74, 12: 1962},
    4: {7: 1, 9: 6, 11: 126},
}
FRACTIONATED = {2: {5: 1, 7: 4, 9: 40, 11: 839}, 3: {6: 1, 8: 7, 10: 98, 12: 2422}, 4: {7: 1, 9: 10, 11: 189}}
INVERSIONS = {6: 5, 8: 71, 10: 1834, 12: 75397}


def flat(table):
    return [(links, dof, count) for dof, row in table.items() for links, count in row.items()]


@pytest.mark.parametrize("method", ["orbits", "burnside"])
@pytest.mark.parametrize(("links", "dof", "count"), flat(COUNTS))
def test_counts(links, dof, count, method):
    assert count_chains(links, dof, method) == count


@pytest.mark.parametrize("method", ["orbits", "burnside"])
@pytest.mark.parametrize(
    ("links", "dof", "count"), [case if case[0] < 11 else slow(*case) for case in flat(FRACTIONATED)]
)
def test_counts_with_fractionated_chains(links, dof, count, method):
    assert count_chains(links, dof, method, fractionated=True) == count


@pytest.mark.parametrize("method", ["orbits", "burnside"])
@pytest.mark.parametrize(("links", "count"), INVERSIONS.items())
def test_counts_of_inversions(links, count, method):
    assert count_chains(links, 1, method, inversions=True) == count


def by_size(query, method):
    sink = CountSink()
    run(count_job(query, method), sink)
    return {links: count for links, count in sink.by("contracted_links").items() if count}


def inversions_in_list(links, dof):
    """Links that differ, of all chains of a list, by the number of links that are not binary and by assortment."""
    sizes, assortments = Counter(), Counter()
    for row in chain_rows(links, dof):
        assortment = tuple(row["assortment"])
        sizes[links - assortment[0]] += row["inversions"]
        assortments[assortment] += row["inversions"]
    return sizes, assortments


@pytest.mark.parametrize(
    ("links", "dof"),
    [
        *[(6, 1), (8, 1), (10, 1), (9, 2), (11, 2), (10, 3), (11, 4), (14, 9)],
        *(pytest.param(*size, marks=pytest.mark.slow) for size in [(12, 1), (14, 1), (13, 2), (14, 3)]),
    ],
)
def test_inversions_are_counted_as_they_are_listed(links, dof):
    sizes, assortments = inversions_in_list(links, dof)
    for method in ("orbits", "burnside"):
        assert by_size(ChainQuery(links, dof, inversions=True), method) == sizes
        for assortment in sorted(assortments)[::3]:
            query = ChainQuery(links, dof, inversions=True, assortment=assortment)
            assert by_size(query, method) == {links - assortment[0]: assortments[assortment]}


def test_inversions_with_strings_of_some_length():
    for longest in [(0, 1), (2, 2), (2, None)]:
        listed = sum(row["inversions"] for row in chain_rows(11, 2, longest_string=longest))
        for method in ("orbits", "burnside"):
            assert count_chains(11, 2, method, inversions=True, longest_string=longest) == listed


@pytest.mark.slow
@pytest.mark.parametrize("method", ["orbits", "burnside"])
def test_inversions_of_sixteen_links(method):
    assert count_chains(16, 1, method, inversions=True, workers=2) == 308823067


@pytest.mark.slow
@pytest.mark.parametrize("method", ["orbits", "burnside"])
@pytest.mark.parametrize(("links", "count"), [(16, 19819281), (18, 1535380884)])
def test_large_counts(links, count, method):
    assert count_chains(links, 1, method, workers=2) == count


def test_ids_are_as_they_always_were():
    golden = json.loads((Path(__file__).parent / "chain_ids.json").read_text())
    assert len(golden) == 16
    for sizes, ids in golden.items():
        links, dof = map(int, sizes.split(","))
        assert sorted(row["code"] for row in chain_rows(links, dof, fractionated=True)) == ids


@pytest.mark.parametrize(
    ("links", "dof", "fractionated"),
    [
        *((links, dof, False) for links, dof in [(4, 1), (6, 1), (8, 1), (10, 1), (7, 2), (9, 2)]),
        slow(11, 2, False),
        *((links, dof, True) for links, dof in [(7, 2), (9, 2), (8, 3), (10, 3), (9, 4), (10, 5)]),
        (8, 3, False),
        (10, 3, False),
        (11, 4, False),
        pytest.param(12, 1, False, marks=pytest.mark.slow),
    ],
)
def test_the_sets_are_those_of_nauty(links, dof, fractionated):
    expected = {chain_id(graph) for graph in chains_by_geng(links, dof, fractionated)}
    found = [row["code"] for row in chain_rows(links, dof, fractionated=fractionated)]
    assert len(set(found)) == len(found)
    assert set(found) == expected


@pytest.mark.parametrize(
    ("links", "dof", "fractionated"), [(8, 1, False), slow(10, 1, False), (10, 3, True), (6, 3, True)]
)
def test_attributes(links, dof, fractionated):
    for graph in chains(links, dof, fractionated=fractionated):
        row = graph.graph
        assert chain_id(graph) == row["code"]
        assert (len(graph), graph.number_of_edges()) == (row["links"], row["joints"]) == (links, row["joints"])
        assert 3 * (links - 1) - 2 * row["joints"] == dof == row["dof"]
        assert row["loops"] == row["joints"] - links + 1
        degrees = Counter(degree for _, degree in graph.degree())
        assert row["assortment"] == [degrees[d] for d in range(2, max(degrees) + 1)]
        _, generators, size = automorphisms_of(links, list(graph.edges()))
        assert row["symmetry"] == size
        orbits = nx.utils.UnionFind(range(links))
        for generator in generators:
            for v in range(links):
                orbits.union(v, generator[v])
        assert row["inversions"] == len(list(orbits.to_sets()))
        assert row["planar"] == nx.check_planarity(graph)[0]
        assert row["fractionated"] == (not nx.is_biconnected(graph))
        binary = graph.subgraph([v for v in graph if graph.degree(v) == 2])
        assert row["longest_string"] == max((len(c) for c in nx.connected_components(binary)), default=0)


@pytest.mark.parametrize(
    ("options", "keep"),
    [
        ({"assortment": (4, 4)}, lambda row: row["assortment"] == [4, 4]),
        ({"assortment": (5, 2, 1)}, lambda row: row["assortment"] == [5, 2, 1]),
        ({"assortment": (5, 2, 1, 0, 0)}, lambda row: row["assortment"] == [5, 2, 1]),
        ({"longest_string": (0, 1)}, lambda row: row["longest_string"] <= 1),
        ({"longest_string": (2, 2)}, lambda row: row["longest_string"] == 2),
        ({"longest_string": (2, None)}, lambda row: row["longest_string"] >= 2),
        ({"symmetry": (4, None)}, lambda row: row["symmetry"] >= 4),
        ({"symmetry": (1, 1)}, lambda row: row["symmetry"] == 1),
        ({"planar": False}, lambda row: not row["planar"]),
        ({"planar": True, "symmetry": (2, 2)}, lambda row: row["planar"] and row["symmetry"] == 2),
    ],
)
@pytest.mark.parametrize(("links", "dof"), [(8, 1), (10, 1), slow(10, 3)])
def test_filters(links, dof, options, keep):
    for fractionated in (False, True):
        everything = list(chain_rows(links, dof, fractionated=fractionated))
        expected = [row for row in everything if keep(row)]
        assert list(chain_rows(links, dof, fractionated=fractionated, **options)) == expected
        assert count_chains(links, dof, fractionated=fractionated, **options) == len(expected)
    if "symmetry" not in options:
        expected = [row for row in expected if not row["fractionated"]]
        assert count_chains(links, dof, "burnside", **options) == len(expected)


def test_eleven_of_the_ten_link_chains_are_not_planar():
    assert count_chains(10, 1, planar=True) == 219


def test_inversions_are_the_links_that_differ():
    """A ground link told apart by two more links that hang on it, and canonical ids of that."""
    for links, dof in [(6, 1), (8, 1), (8, 3), (9, 2)]:
        rows = list(chain_rows(links, dof, inversions=True, fractionated=True))
        marked = set()
        for graph in chains(links, dof, fractionated=True):
            for ground in graph:
                marked.add(chain_id(nx.Graph([*graph.edges(), (ground, "a"), ("a", "b"), ("a", "c")])))
        assert len(rows) == len(marked) == len({(row["code"], row["ground"]) for row in rows})


@pytest.mark.parametrize(
    "sizes", [[(5, 2), (6, 1), (6, 3)], pytest.param([(7, 2), (8, 3)], marks=pytest.mark.slow)], ids=["small", "large"]
)
def test_inputs_of_small_chains_by_brute_force(sizes):
    for links, dof in sizes:
        rows = Counter(row["code"] for row in chain_rows(links, dof, inputs=True, fractionated=True))
        for graph in chains(links, dof, fractionated=True):
            joints = [tuple(sorted(joint)) for joint in graph.edges()]
            choices = {
                (ground, chosen)
                for chosen in combinations(sorted(joints), dof)
                if all_lock(links, joints, chosen)
                for ground in range(links)
            }
            group = [p for p in permutations(range(links)) if all(image(p, j) in joints for j in joints)]
            orbits = {min((p[g], tuple(sorted(image(p, j) for j in c))) for p in group) for g, c in choices}
            assert rows[graph.graph["code"]] == len(orbits)


def image(permutation, joint):
    return tuple(sorted(permutation[link] for link in joint))


def all_lock(links, joints, chosen):
    """No set of links holds more inputs than it has freedoms."""
    for size in range(2, links + 1):
        for part in combinations(range(links), size):
            inside = [j for j in joints if set(j) <= set(part)]
            if sum(j in chosen for j in inside) > 3 * (size - 1) - 2 * len(inside):
                return False
    return True


def test_every_joint_of_a_chain_with_one_freedom_can_be_an_input():
    for graph in chains(8, 1):
        joints = list(graph.edges())
        assert all(are_inputs(8, joints, [i]) for i in range(len(joints)))
        assert not any(are_inputs(8, joints, pair) for pair in combinations(range(len(joints)), 2))
    assert len(list(input_choices(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [], 1))) == 16


@pytest.mark.parametrize(
    "sizes", [[(9, 2), (9, 4)], pytest.param([(10, 3), (12, 5)], marks=pytest.mark.slow)], ids=["small", "large"]
)
def test_shapes_hold_every_fractionated_chain(sizes):
    for links, dof in sizes:
        sizes = set()
        for graph in chains(links, dof, fractionated=True):
            blocks = [graph.subgraph(nodes) for nodes in nx.biconnected_components(graph)]
            if len(blocks) > 1:
                found = ((len(b), 3 * (len(b) - 1) - 2 * b.number_of_edges()) for b in blocks)
                sizes.add(tuple(sorted(found, reverse=True)))
        assert sizes == set(shapes(links, dof))


def test_glued_chains_of_three_rings():
    ring = (4, ((0, 1), (0, 3), (1, 2), (2, 3)))
    assert len(glued([ring] * 3)) == 3  # all on one link, or on two joined, or two opposite links of the middle one


@pytest.mark.parametrize(
    ("links", "dof", "options", "message"),
    [
        (3, 1, {}, "3 links; expected 4 or more"),
        (8, 0, {}, "0 degrees of freedom; expected 1 or more"),
        (26, 1, {}, "26 links with M = 1 have 12 loops; expected 11 at most"),
        (8, 1, {"symmetry": (3, 2)}, "the range 3 to 2"),
        (8, 1, {"assortment": (-1,)}, "the assortment"),
    ],
)
def test_numbers_out_of_range(links, dof, options, message):
    with pytest.raises(InvariantError, match=message):
        next(chains(links, dof, **options))


@pytest.mark.parametrize(("links", "dof"), [(5, 1), (4, 2), (8, 2), (4, 3), (5, 7)])
def test_impossible_numbers_give_nothing(links, dof):
    assert list(chains(links, dof, fractionated=True)) == []
    assert count_chains(links, dof) == count_chains(links, dof, "burnside") == 0


@pytest.mark.parametrize("options", [{"inputs": True}, {"symmetry": (2, None)}, {"fractionated": True, "planar": True}])
def test_what_burnside_does_not_count(options):
    with pytest.raises(UnsolvableError, match="Burnside"):
        count_chains(8, 3, "burnside", **options)


@pytest.mark.parametrize(("links", "dof"), [(11, 6), slow(15, 10)])
def test_many_links_few_loops(links, dof):
    """Long strings: placements beyond two binary links, links beyond the one byte of graph6."""
    assert count_chains(70, 67, fractionated=True) == 1
    assert count_chains(links, dof, fractionated=True) == count_chains(links, dof, "burnside", fractionated=True)
    rows = list(chain_rows(70, 65))
    assert len(rows) == count_chains(70, 65, "burnside") == len({row["code"] for row in rows})
    assert all(chain_id(graph) == graph.graph["code"] for graph in chains(70, 65, symmetry=(4, None)))
