"""The roads to canonical numbers: the library of C, bliss, Python. Ids do not depend on which is there."""

import json
import random
import subprocess
import sys
from pathlib import Path

import networkx as nx
import numpy as np
import pytest
from hypothesis import given, strategies as st

import graphs.identity.numbering as numbering
from enumerate.chains.jobs import chain_rows
from graphs.convert.conversions import to_sc
from graphs.errors import SynthedraError
from graphs.files.formats import READERS, read
from graphs.identity.chains import automorphisms_of, chain_from_id, chain_id, class_code, symmetries_of_links
from graphs.identity.leaves import ColouredGraph, greatest_leaf
from graphs.identity.numbering import labels_by_bliss, numbers_of_rows

GOLDEN = Path(__file__).parents[2] / "enumerate" / "chains" / "chain_ids.json"


def take_road(monkeypatch, road):
    """Let numbers come by one road alone; skip the test where it is not there."""
    if road == "library":
        if numbering._library() is None:
            pytest.skip("no library of C")
        return
    monkeypatch.setattr(numbering, "_library", lambda: None)
    if road == "bliss":
        pytest.importorskip("bliss_bind")
    else:
        monkeypatch.setattr(numbering, "labels_by_bliss", lambda graph: None)


ROADS = pytest.mark.parametrize("road", ["library", "bliss", "python"])


@ROADS
def test_golden_ids_come_by_each_road(road, monkeypatch):
    take_road(monkeypatch, road)
    chance = random.Random(4)
    ids = [code for codes in json.loads(GOLDEN.read_text()).values() for code in codes]
    assert len(ids) > 400
    for code in ids:
        named = chain_from_id(code)
        names = dict(zip(named, chance.sample(list(named), len(named)), strict=True))
        graph = nx.empty_graph(len(named))
        graph.add_edges_from(chance.sample([(names[a], names[b]) for a, b in named.edges()], named.number_of_edges()))
        assert chain_id(graph) == code


def test_ids_and_codes_of_the_data_come_by_each_road(data, monkeypatch):
    """Every file of links and joints: the id, the code of its centre classes, its symmetries."""
    mechanisms = []
    for file in sorted(file for file in data.rglob("*") if file.suffix in READERS):
        try:
            mechanisms.append(to_sc(read(file)))
        except SynthedraError:
            continue
    assert len(mechanisms) > 100
    codes = [(chain_id(mechanism), class_code(mechanism)) for mechanism in mechanisms]
    symmetries = [symmetries_of_links(mechanism) for mechanism in mechanisms]
    monkeypatch.setattr(numbering, "_library", lambda: None)
    assert [(chain_id(mechanism), class_code(mechanism)) for mechanism in mechanisms] == codes
    assert [symmetries_of_links(mechanism) for mechanism in mechanisms] == symmetries
    monkeypatch.setattr(numbering, "labels_by_bliss", lambda graph: None)
    assert [(chain_id(mechanism), class_code(mechanism)) for mechanism in mechanisms] == codes


def test_nothing_needs_bliss():
    """A process in which bliss cannot be imported, as after an installation without extras."""
    program = (
        "import sys; sys.modules['bliss_bind'] = None\n"
        "import networkx as nx\n"
        "from graphs.identity import chain_id\n"
        "from enumerate.chains.jobs import chain_rows\n"
        "print(chain_id(nx.cycle_graph(4)), len(list(chain_rows(8, 1))))\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["k1:Cr", "16"]


def renamed_chains(links, dof, seed=1):
    """Joints, with links named by chance, and numbers of automorphisms of all chains."""
    chance = np.random.default_rng(seed)
    rows = list(chain_rows(links, dof))
    chains = [np.array(chain_from_id(row["code"]).edges()) for row in rows]
    return np.array([chance.permutation(links)[chain] for chain in chains]), np.array([row["symmetry"] for row in rows])


@ROADS
@pytest.mark.parametrize(("links", "dof"), [(8, 1), (10, 1), (10, 3), pytest.param(12, 1, marks=pytest.mark.slow)])
def test_many_chains_get_the_numbers_of_each(links, dof, road, monkeypatch):
    joints, automorphisms = renamed_chains(links, dof)
    expected = [greatest_leaf(ColouredGraph(links, chain)).labels for chain in joints.tolist()]
    take_road(monkeypatch, road)
    if road == "bliss":
        expected = [labels_by_bliss(ColouredGraph(links, chain)) for chain in joints.tolist()]
    for known in (automorphisms, None):
        assert numbers_of_rows(links, joints, known).tolist() == expected


@given(st.integers(2, 9), st.data())
def test_any_graph_gets_its_numbers_with_or_without_the_number_of_its_symmetries(n, data):
    pairs = [(a, b) for a in range(n) for b in range(a)]
    joints = data.draw(st.lists(st.sampled_from(pairs), min_size=1, unique=True))
    expected, _, size = automorphisms_of(n, joints)
    for known in (size, 1, 2 * size):  # what is said of symmetries may shorten the way, not change where it leads
        assert numbers_of_rows(n, np.array([joints]), np.array([known])).tolist() == [expected]


def test_no_rows_have_no_numbers(monkeypatch):
    for road in ("library", "python"):
        with monkeypatch.context() as patch:
            if road == "python":
                take_road(patch, road)
            assert numbers_of_rows(5, np.zeros((0, 4, 2), np.int64)).shape == (0, 5)
