import pytest
from hypothesis import given, strategies as st
from read_strings import string_of_chain

from enumerate.strings.panel_strings import ChainString, chain_scd, strings
from graphs.convert.panels import scd_from_panels
from graphs.count.report import mobility_report
from graphs.errors import InvariantError, UnsolvableError
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph


@st.composite
def chains_with_modes(draw):
    chain = ChainString(tuple(draw(st.lists(st.integers(1, 4), min_size=1, max_size=5))))
    gaps = max(sum(k >= 2 for k in chain.clusters) - 1, 0)
    return chain, "".join(draw(st.lists(st.sampled_from("SD"), min_size=gaps, max_size=gaps)))


@given(chains_with_modes(), st.integers(3, 6), st.integers(3, 6))
def test_a_chain_is_read_back_with_its_mode(chain_and_mode, n, m):
    chain, mode = chain_and_mode
    scd = chain_scd(chain, mode, (n, m))
    assert string_of_chain(scd) == (chain, mode)
    report = mobility_report(scd)
    assert report.mobility == report.equations["polyhedron"].value == chain.creases
    creases = [(i, i + 1) for i in range(chain.creases)]
    assert scd.sc_graph().is_identical(SCGraph(chain.creases + 1, creases))


@given(chains_with_modes())
def test_creases_of_a_cluster_meet_in_one_vertex_and_panels_part_clusters(chain_and_mode):
    chain, mode = chain_and_mode
    scd = chain_scd(chain, mode)
    crease = 0
    for k in chain.clusters:
        ends = [set(scd.drawing.ends_of_joint(j)) for j in range(crease, crease + k)]
        assert k == 1 or len(set.intersection(*ends)) == 1
        if crease:
            assert not set(scd.drawing.ends_of_joint(crease - 1)) & ends[0]
        crease += k


def test_modes_are_different_drawings():
    for chain in strings(6):
        drawings = {tuple(map(tuple, chain_scd(chain, mode).rotation.values())) for mode in chain.modes()}
        assert len(drawings) == chain.count_modes()


@pytest.mark.parametrize("mode", ["", "SS", "X", "s"])
def test_odd_modes_are_refused(mode):
    with pytest.raises(InvariantError, match="expected 1 letter S or D"):
        chain_scd(ChainString.parse("RR-RR"), mode)


def test_a_body_has_three_sides_or_more():
    with pytest.raises(InvariantError, match=r"link 0 has 2 sides"):
        chain_scd(ChainString((1,)), ends=(2, 3))


def test_what_is_no_chain():
    fan = scd_from_panels([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)])
    star = scd_from_panels([(0, 1, 2), (0, 1, 3), (1, 2, 4), (2, 0, 5)])
    alone = SCDGraph(1, [], rotation={0: [None] * 3})
    for scd in (fan, star, alone):
        with pytest.raises(UnsolvableError, match="not an open chain between two bodies"):
            string_of_chain(scd)
    zigzag = scd_from_panels([(0, 1, 2), (1, 2, 3), (2, 3, 4), (3, 4, 5), (4, 5, 6)])
    with pytest.raises(UnsolvableError, match="meets the joints on its two sides in different points"):
        string_of_chain(zigzag)
