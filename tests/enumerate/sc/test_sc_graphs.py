import random
import re
from collections import Counter, defaultdict
from fractions import Fraction

import networkx as nx
import pytest
from embeddings import face_code, spherical_embeddings
from rigidity import chains_by_geng
from sizes import slow

from enumerate.chains.jobs import chain_rows
from enumerate.runner._run import rows_of, run
from enumerate.runner.sinks import RowSink
from enumerate.sc.jobs import FormJob, SCJob, count_sc_graphs, sc_graphs, sc_rows
from enumerate.sc.query import SCQuery
from graphs.errors import InvariantError, UnsolvableError
from graphs.identity.chains import automorphisms_of, chain_id
from graphs.identity.drawings import map_id, mechanism_from_map_id
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.sc import SCGraph
from graphs.rank.exact import diagnose, exact_mobility
from graphs.reduce.ride_alongs import reduce

COUNTS = {
    1: {4: 1, 6: 4, 8: 54, 10: 1564, 12: 66594, 14: 3404097},
    2: {5: 1, 7: 7, 9: 150, 11: 6006, 13: 312047},
    3: {6: 1, 8: 11, 10: 333, 12: 16768},
}
EMBEDDINGS = {4: 1, 6: 2, 8: 20, 10: 339, 12: 11366}


LARGE = 100_000
"""Counts that only one method confirms in every run."""


@pytest.mark.parametrize(
    ("links", "dof", "count", "method"),
    [
        pytest.param(n, m, c, method, marks=[pytest.mark.slow] if c > LARGE and method == "orbits" else [])
        for m, row in COUNTS.items()
        for n, c in row.items()
        for method in ("orbits", "burnside")
    ],
)
def test_counts(links, dof, count, method):
    assert count_sc_graphs(links, dof, method) == count


@pytest.mark.parametrize("method", ["orbits", "burnside"])
def test_counts_of_embeddings(method):
    found = {links: count_sc_graphs(links, 1, method, outside=False) for links in EMBEDDINGS}
    assert found == EMBEDDINGS


@pytest.mark.parametrize(
    ("links", "dof"), [(4, 1), (6, 1), (8, 1), (10, 1), (7, 2), (9, 2), (8, 3), (10, 3), slow(11, 2)]
)
def test_as_many_are_listed_as_counted(links, dof):
    codes = [row["code"] for row in sc_rows(links, dof)]
    assert len(set(codes)) == len(codes) == count_sc_graphs(links, dof)


@pytest.mark.parametrize(
    ("links", "dof"),
    [(4, 1), (6, 1), (8, 1), (5, 2), (7, 2), (8, 3), pytest.param(10, 1, marks=pytest.mark.slow),
     pytest.param(9, 2, marks=pytest.mark.slow), pytest.param(10, 3, marks=pytest.mark.slow)],
)  # fmt: skip
def test_against_all_rotation_systems(links, dof):
    """The oracle: nauty's chains, every rotation system, every face outside; and the sum of 1 / symmetries."""
    expected, masses = set(), {}
    for graph in chains_by_geng(links, dof):
        joints = list(graph.edges())
        pairs = 0
        for faces in spherical_embeddings(graph):
            expected.update(face_code(links, joints, faces, outer) for outer in range(len(faces)))
            pairs += len(faces)
        mirrored = 2 if len(joints) > links else 1  # the drawing of a ring is its own mirror image
        if pairs:
            symmetries = automorphisms_of(links, joints)[2]
            masses[chain_id(graph)] = Fraction(mirrored * pairs, 2 * symmetries)
    found, sums = set(), defaultdict(Fraction)
    for row in sc_rows(links, dof):
        sc = mechanism_from_map_id(row["code"])
        outer = tuple(joint for joint in sc.joints if sum(joint in loop.joints for loop in sc.loops) == 1)
        faces = [loop.joints for loop in sc.loops] + [outer]
        found.add(face_code(links, list(sc.joints.values()), faces, len(faces) - 1))
        sums[row["chain"]] += Fraction(1, row["symmetry"])
    assert found == expected
    assert sums == masses


def check_row(row, sc):
    """Every attribute by another road: the Python classes, the exact rank of graphs/, reduction, canonical ids."""
    assert chain_id(nx.Graph(sc)) == row["chain"]
    assert (len(sc), len(sc.joints), len(sc.loops)) == (row["links"], row["joints"], row["loops"])
    classes = sc.centre_classes()
    assert len(classes) == row["centres"]
    assert sum(one.centre is Centre.INFINITE for one in classes) == row["infinite"]
    assert sum(loop.centre is Centre.NONE for loop in sc.loops) == row["spatial"]
    assert exact_mobility(sc).mobility == row["exact_dof"] == row["dof"]
    assert chain_id(nx.Graph(reduce(sc).graph)) == row["reduced"]
    degrees = Counter(degree for _, degree in sc.degree())
    assert row["assortment"] == [degrees[d] for d in range(2, max(degrees) + 1)]
    sizes = sorted(len(loop.joints) for loop in sc.loops)
    assert row["loop_sizes"] == list(sizes)
    assert row["outer_size"] == 2 * len(sc.joints) - sum(sizes)


def renamed(sc, rng):
    links, joints = list(sc.nodes), list(sc.joints)
    rng.shuffle(links)
    rng.shuffle(joints)
    return sc.relabel({a: f"l{b}" for a, b in enumerate(links)}, {a: f"j{b}" for a, b in enumerate(joints)})


@pytest.mark.parametrize(
    ("links", "dof", "options", "every"),
    [
        (4, 1, {}, 1),
        (6, 1, {}, 1),
        (8, 1, {}, 1),
        (9, 2, {}, 4),
        slow(10, 1, {}, 20),
        pytest.param(9, 2, {}, 1, marks=pytest.mark.slow),
        pytest.param(10, 1, {}, 5, marks=pytest.mark.slow),
        pytest.param(12, 1, {}, 400, marks=pytest.mark.slow),
        (6, 1, {"infinite": True}, 1),
        (8, 1, {"infinite": True}, 4),
        slow(8, 1, {"infinite": True}, 1),
        (9, 1, {"spatial": 1}, 1),
        (12, 1, {"spatial": 2}, 1),
        slow(11, 1, {"spatial": 1}, 1),
        pytest.param(11, 1, {"spatial": 1, "infinite": True}, 3, marks=pytest.mark.slow),
        (7, 1, {"spatial": 1}, 1),
        (7, 1, {"spatial": 1, "infinite": True}, 1),
    ],
    ids=str,
)
def test_rows(links, dof, options, every):
    rng = random.Random(7)
    codes = set()
    for number, row in enumerate(sc_rows(links, dof, **options)):
        codes.add(row["code"])
        if number % every == 0:
            sc = mechanism_from_map_id(row["code"])
            check_row(row, sc)
            assert map_id(renamed(sc, rng)) == row["code"]
    assert len(codes) == number + 1


def test_centres_of_the_design():
    assert Counter(row["centres"] for row in sc_rows(8, 1)) == {1: 44, 2: 7, 3: 3}
    for centres, count in {1: 44, 2: 7, 3: 3}.items():
        assert count_sc_graphs(8, 1, centres=(centres, centres)) == count


@pytest.mark.slow
def test_centres_of_all_twelve_link_graphs():
    for row in sc_rows(12, 1):
        assert len(mechanism_from_map_id(row["code"]).centre_classes()) == row["centres"]


def test_most_general_forms():
    forms = {links: list(rows_of(FormJob(SCQuery(links, 1)))) for links in (4, 6, 8, 10)}
    assert [(row["name"], row["centres"]) for row in forms[6]] == [("watt", 2), ("stephenson", 1)]
    assert Counter(row["centres"] for row in forms[8]) == {1: 9, 2: 4, 3: 3}
    for links, rows in forms.items():
        planar = {row["code"] for row in chain_rows(links, 1, planar=True)}
        assert {row["chain"] for row in rows} == planar
        assert len(rows) == len(planar)
        assert sum(row["sc_graphs"] for row in rows) == COUNTS[1][links]
        for row in rows:
            sc = mechanism_from_map_id(row["code"])
            assert (chain_id(nx.Graph(sc)), len(sc.centre_classes())) == (row["chain"], row["centres"])
    assert len(forms[10]) == 219


def simple_planar_labellings(links, joints, spatial):
    """Labelled drawings of all simple 2-connected planar graphs of a size: (SC graph, canonical code)."""
    found = {}
    for graph in (g for g in chains_of_any_kind(links, joints)):
        pairs = list(graph.edges())
        for faces in spherical_embeddings(graph):
            for outer in range(len(faces)):
                rest = [face for i, face in enumerate(faces) if i != outer]
                for choice in choices(len(rest), spatial):
                    loops = [Loop(f, "none" if i in choice else "finite") for i, f in enumerate(rest)]
                    sc = SCGraph(links, pairs, loops)
                    found[map_id(sc)] = sc
    return found


def chains_of_any_kind(links, joints):
    from rigidity import geng

    return geng("-C", "-d2", str(links), f"{joints}:{joints}")


def choices(number, size):
    from itertools import combinations

    return [set(choice) for choice in combinations(range(number), size)]


def test_hybrids_of_the_design():
    """Of 33 labellings that fit the count, 14 have the rank and 6 are mechanisms: those that are listed."""
    all_of_them = simple_planar_labellings(9, 10, 1)
    ranked = {code: sc for code, sc in all_of_them.items() if exact_mobility(sc).mobility == 1}
    moving = {code for code, sc in ranked.items() if not diagnose(sc).immobile}
    assert (len(all_of_them), len(ranked), len(moving)) == (33, 14, 6)
    assert {row["code"] for row in sc_rows(9, 1, spatial=1)} == moving
    assert len(list(sc_rows(12, 1, spatial=2))) == 12
    assert count_sc_graphs(8, 1, spatial=1) == count_sc_graphs(10, 1, spatial=1) == 0


@pytest.mark.parametrize(
    ("links", "joints", "dof", "spatial"),
    [(7, 8, 0, 1), (10, 11, 2, 1), (12, 13, 1, 2), pytest.param(11, 13, 1, 1, marks=pytest.mark.slow)],
)
def test_hybrids_against_all_labellings(links, joints, dof, spatial):
    moving = {
        code
        for code, sc in simple_planar_labellings(links, joints, spatial).items()
        if exact_mobility(sc).mobility == dof and not diagnose(sc).immobile
    }
    listed = {row["code"] for row in sc_rows(links, dof, spatial=spatial)} if dof else set()
    assert listed == (moving if dof else set())


def test_filters():
    rows = list(sc_rows(10, 1))
    for options, keep in [
        ({"centres": (2, 3)}, lambda row: 2 <= row["centres"] <= 3),
        ({"symmetry": (2, None)}, lambda row: row["symmetry"] >= 2),
        ({"assortment": (5, 4, 1)}, lambda row: row["assortment"] == [5, 4, 1]),
    ]:
        expected = [row for row in rows if keep(row)]
        assert 0 < len(expected) < len(rows)
        assert list(sc_rows(10, 1, **options)) == expected
        assert count_sc_graphs(10, 1, **options) == len(expected)
    assert count_sc_graphs(10, 1, "burnside", assortment=(5, 4, 1)) == count_sc_graphs(10, 1, assortment=(5, 4, 1))
    by_string = [count_sc_graphs(10, 1, longest_string=(k, k)) for k in range(4)]
    assert sum(by_string) == len(rows)
    assert [len(list(sc_rows(10, 1, longest_string=(k, k)))) for k in range(4)] == by_string


def test_what_cannot_be():
    assert list(sc_rows(7, 1)) == []
    for options in ({"centres": (3, 1)}, {"spatial": -1}, {"dof": 0}, {"links": 3}, {"links": 24}):
        with pytest.raises(InvariantError):
            SCQuery(**({"links": 8, "dof": 1} | options))
    with pytest.raises(InvariantError, match="64 at most"):
        SCQuery(70, 65)
    for options in ({"centres": (2, 2)}, {"spatial": 1, "links": 9}, {"symmetry": (2, None)}):
        with pytest.raises(UnsolvableError, match="Burnside"):
            count_sc_graphs(**({"links": 8, "dof": 1, "method": "burnside"} | options))
    with pytest.raises(UnsolvableError, match="outer face"):
        count_sc_graphs(8, 1, outside=False, centres=(2, 2))


def test_rings():
    for dof in (1, 2, 5):
        [row] = sc_rows(dof + 3, dof)
        check_row(row, mechanism_from_map_id(row["code"]))
        assert row["symmetry"] == 2 * (dof + 3)
    assert [row["infinite"] for row in sc_rows(4, 1, infinite=True)] == [0, 1]
    [row] = sc_rows(7, 1, spatial=1)
    assert re.fullmatch("m1:.*;s", row["code"])


def test_large_units_are_split():
    """A map with more SC graphs than fit a unit is taken in parts, in the same order with any number of workers."""
    whole = list(sc_rows(10, 1))
    job = SCJob(SCQuery(10, 1), unit_rows=5)
    assert len(job.units()) > 100
    found = []
    run(job, RowSink(lambda columns, rows: found.extend(rows)), workers=2)
    assert {row[0] for row in found} == {row["code"] for row in whole}
    assert len(found) == len(whole)
    assert found == [row for unit in job.units() for row in job.work(unit.payload)]


def test_graphs_carry_their_rows():
    for sc in sc_graphs(6, 1):
        assert sc.graph["centres"] == len(sc.centre_classes())
