import numpy as np
import pytest
from hypothesis import given, strategies as st
from sizes import slow

from enumerate.strings.panel_strings import ChainString, count_strings, joint_chain, strings
from graphs.errors import InvariantError

chains = st.lists(st.integers(1, 5), min_size=1, max_size=6).map(lambda parts: ChainString(tuple(parts)))


@given(chains)
def test_parsing_reverses_and_canonical_forms(chain):
    assert ChainString.parse(chain.text) == chain
    assert chain.reverse.text == chain.text[::-1]
    assert chain.reverse.reverse == chain
    assert chain.canonical == chain.reverse.canonical
    assert chain.canonical in (chain, chain.reverse)
    assert chain.creases == chain.text.count("R")
    assert chain.panels == chain.text.count("-")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "has a panel without a crease"),
        ("-", "has a panel without a crease; expected R on both sides of -"),
        ("R--R", "has a panel without a crease"),
        ("RX", "has 'X' at position 2; expected R and - only"),
        ("R\nR", "at position 2"),
        ("R-R\n", "at position 4"),
        ("r", "has 'r' at position 1"),
    ],
)
def test_what_is_no_string(text, message):
    with pytest.raises(InvariantError, match=message):
        ChainString.parse(text)


@pytest.mark.parametrize("clusters", [(), (0,), (1, -1), (True,), (1.0,)])
def test_what_are_no_clusters(clusters):
    with pytest.raises(InvariantError, match="expected numbers of 1 or more"):
        ChainString(clusters)


@given(chains)
def test_modes_by_listing_and_by_formula(chain):
    modes = chain.modes()
    assert len(modes) == len(set(modes)) == chain.count_modes()
    gaps = max(sum(k >= 2 for k in chain.clusters) - 1, 0)
    assert all(len(mode) == gaps for mode in modes)
    if chain.is_palindrome:
        assert all(mode[::-1] == mode or mode[::-1] not in modes for mode in modes)


def numeric_dof(chain: ChainString, seed: int) -> int:
    """Second method: the same placement over the reals."""
    rng = np.random.default_rng(seed)
    rows, first = [], rng.normal(size=3)
    for k in chain.clusters:
        point, directions = rng.normal(size=3), [first, *rng.normal(size=(k - 1, 3))]
        first = directions[-1]
        rows += [np.concatenate([u, np.cross(point, u)]) for u in directions]
    return int(np.linalg.matrix_rank(np.array(rows), tol=1e-9))


@given(chains, st.integers(0, 10))
def test_freedoms_by_a_rank_over_the_reals(chain, seed):
    assert chain.dof == numeric_dof(chain, seed)
    assert chain.dof == chain.reverse.dof <= min(6, chain.creases)
    assert ("creases" in chain.comment or "rotation" in chain.comment) == (chain.dof < chain.creases)


def test_clusters_over_three_have_fewer_freedoms_than_creases():
    assert [(c.text, c.creases, c.dof) for c in strings(5, max_panels=1, max_cluster=None)] == [
        ("RRRRR", 5, 3),
        ("R-RRRR", 5, 4),
        ("RR-RRR", 5, 5),
    ]
    assert ChainString.parse("RRRR").mechanism == "(4R)"
    assert ChainString.parse("RRRR").comment == "3 freedoms between the bodies, 4 creases"


@pytest.mark.parametrize("limits", [(2, 3), (None, 3), (None, None), (0, None), (3, 1), (4, 2), (1, 5)])
def test_listing_and_generating_function_agree(limits):
    panels, cluster = limits
    for n in range(1, 15):
        listed = list(strings(n, max_panels=panels, max_cluster=cluster))
        assert len(listed) == count_strings(n, max_panels=panels, max_cluster=cluster)
        assert len(set(listed)) == len(listed)
        for chain in listed:
            assert chain == chain.canonical
            assert chain.creases == n
            assert panels is None or chain.panels <= panels
            assert cluster is None or max(chain.clusters) <= cluster


@pytest.mark.parametrize("most", [21, slow(30)])
def test_listing_and_generating_function_agree_to_thirty(most):
    for panels, cluster in ((2, 3), (2, None), (5, None), (9, 3), (None, 1)):
        for n in range(15, most + 1):
            listed = sum(1 for _ in strings(n, max_panels=panels, max_cluster=cluster))
            assert listed == count_strings(n, max_panels=panels, max_cluster=cluster)


@pytest.mark.slow
def test_listing_and_generating_function_agree_without_limit_on_panels():
    """To 24 creases, 600 000 strings; there are 26 903 492 of thirty."""
    for n in range(15, 25):
        listed = sum(1 for _ in strings(n, max_panels=None))
        assert listed == count_strings(n, max_panels=None)


def test_order_is_by_panels_then_by_clusters():
    for n in range(1, 10):
        keys = [(chain.panels, chain.clusters) for chain in strings(n, max_panels=None, max_cluster=None)]
        assert keys == sorted(keys)


@pytest.mark.parametrize(
    "options", [{"creases": 0}, {"creases": 3, "max_panels": -1}, {"creases": 3, "max_cluster": 0}]
)
def test_odd_limits_are_refused(options):
    with pytest.raises(InvariantError, match="or more"):
        list(strings(options.pop("creases"), **options))


def test_joint_chains_and_back():
    for n in range(1, 7):
        for chain in strings(n):
            if chain.mechanism == "RR" and chain.clusters == (1, 1):
                assert joint_chain("RR") == chain
            assert joint_chain(chain.mechanism) == chain


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("PRR", "position 1: P at an end"),
        ("RRR", "position 2: R between panels; expected P"),
        ("RCS", "position 2: 'C'; expected R, U, S or P"),
        ("UP", "position 2: P at an end"),
        ("", "expected numbers of 1 or more"),
    ],
)
def test_joint_chains_that_panels_cannot_make(text, message):
    with pytest.raises(InvariantError, match=message):
        joint_chain(text)


def test_table_8_notes_which_axes_are_parallel():
    """A single crease between panels is parallel to those beside it: it stands for a slide."""
    noted = {chain.text: chain.comment for n in range(1, 7) for chain in strings(n) if "parallel" in chain.comment}
    assert noted == {
        "R-R": "all axes parallel", "R-R-R": "all axes parallel", "R-R-RR": "3 axes parallel",
        "R-R-RRR": "3 axes parallel", "RR-R-RR": "3 axes parallel", "RR-R-RRR": "3 axes parallel",
    }  # fmt: skip
    assert all("P" in ChainString.parse(text).mechanism for text in noted if text != "R-R")
    assert ChainString.parse("R-R-RR-R-R").comment.startswith("3 axes parallel, 3 axes parallel")
