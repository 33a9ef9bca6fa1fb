"""Wampler's conjecture, M = J - 3 L for every spherical system: all SC graphs of chains without rigid parts."""

import pytest
from embeddings import face_code, spherical_embeddings
from rigidity import chains_by_geng
from sizes import slow

from graphs.identity.chains import class_code
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.rank.exact import diagnose


def sc_graphs(links, dof):
    """Every embedding of every planar chain, every outer face, the other faces loops with centres."""
    for graph in chains_by_geng(links, dof):
        joints = list(graph.edges())
        for faces in spherical_embeddings(graph):
            for outer in range(len(faces)):
                yield SCGraph(links, joints, [Loop(face) for i, face in enumerate(faces) if i != outer])


def check(links, dof):
    """Count the SC graphs, isomorphic ones too; each has the rank that its count says, and every joint moves."""
    found = 0
    for sc in sc_graphs(links, dof):
        result = diagnose(sc)
        assert (result.mobility, result.idle, result.immobile) == (dof, 0, ())
        found += 1
    return found


@pytest.mark.parametrize(
    ("links", "dof"), [(4, 1), (6, 1), (8, 1), (5, 2), (7, 2), (9, 2), (6, 3), (8, 3), slow(10, 3)]
)
def test_count_is_rank(links, dof):
    assert check(links, dof) > 0


@pytest.mark.slow
@pytest.mark.parametrize(("links", "dof"), [(10, 1), (12, 1), (11, 2), (12, 3)])
def test_count_is_rank_to_twelve_links(links, dof):
    assert check(links, dof) > 0


@pytest.mark.parametrize(("links", "dof", "count"), [(4, 1, 1), (6, 1, 4), (8, 1, 54), (7, 2, 7), (8, 3, 11)])
def test_number_of_sc_graphs(links, dof, count):
    """The numbers of the design: up to isomorphism, the plane's two sides not told apart."""
    codes = set()
    for graph in chains_by_geng(links, dof):
        joints = list(graph.edges())
        for faces in spherical_embeddings(graph):
            for outer in range(len(faces)):
                codes.add(face_code(links, joints, faces, outer))
    assert len(codes) == count


def test_canonical_codes_tell_no_more_than_the_loops():
    assert len({class_code(sc) for sc in sc_graphs(6, 1)}) <= 4
