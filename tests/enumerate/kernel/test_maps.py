from fractions import Fraction
from itertools import pairwise
from math import comb, factorial

import numpy as np
import pytest

from enumerate.contracted.maps import MOST_MAP_LOOPS, contracted_maps, map_symmetries, plane_trees
from enumerate.kernel.maps import decode_map, faces_of
from graphs.errors import InvariantError


def weight(codes):
    """Sum of 1 / (number of symmetries): every drawing with a chosen joint, end and side counts equally often."""
    return sum(Fraction(1, len(map_symmetries(*decode_map(code)[:2])[0])) for code in codes)


def rooted(i, j):
    """Rooted non-separable planar maps with i + 1 vertices and j + 1 faces (Brown and Tutte 1964)."""
    top = factorial(2 * i + j - 2) * factorial(2 * j + i - 2)
    return top // (factorial(i) * factorial(j) * factorial(2 * i - 1) * factorial(2 * j - 1))


@pytest.mark.parametrize("loops", [2, 3, 4, 5, 6, pytest.param(7, marks=pytest.mark.slow)])
def test_all_maps_are_there(loops):
    """Each non-separable map is a contracted map with binary links on its joints: Tutte's numbers come out."""
    weights = {n: weight(codes) for n, codes in contracted_maps(loops)}
    for joints in range(3 * (loops - 1), 3 * (loops - 1) + 6):
        total = sum(w * comb(joints - 1, n + loops - 2) for n, w in weights.items())
        assert 4 * joints * total == rooted(joints - loops, loops)


@pytest.mark.parametrize("loops", [2, 3, 4, 5, 6, 7])
def test_cubic_maps(loops):
    """Rooted loopless triangulations with 2 n faces: 2^n (3n)! / ((n+1)! (2n+1)!) (Mullin 1965)."""
    n = loops - 1
    expected = 2**n * factorial(3 * n) // (factorial(n + 1) * factorial(2 * n + 1))
    links, cubic = next(contracted_maps(loops))
    assert links == 2 * n
    assert 12 * n * weight(cubic) == expected


def test_codes_are_distinct_and_drawn_on_the_sphere():
    for n, codes in contracted_maps(5):
        assert len(np.unique(codes, axis=0)) == len(codes)
        for code in codes:
            turn, vertex, open_edges = decode_map(code)
            assert not open_edges.any()
            assert sorted(turn[0]) == list(range(len(vertex)))
            assert (turn[1][turn[0]] == np.arange(len(vertex))).all()
            assert (vertex[turn[0]] == vertex).all()
            assert n - len(vertex) // 2 + faces_of(turn)[1] == 2
            assert np.bincount(vertex).min() >= 3


def test_symmetries_are_symmetries():
    for _, codes in contracted_maps(4):
        for code in codes:
            turn, vertex, _ = decode_map(code)
            darts, corners = map_symmetries(turn, vertex)
            assert (darts[0] == np.arange(len(vertex))).all()
            for moved, corner in zip(darts, corners, strict=True):
                assert (moved ^ 1 == moved[np.arange(len(vertex)) ^ 1]).all()
                same = (moved[turn[0]] == turn[0][moved]).all()
                assert same or (moved[turn[0]] == turn[1][moved]).all()
                face, _ = faces_of(turn)
                image = {}
                for d in range(len(vertex)):
                    assert image.setdefault(face[d], face[corner[d]]) == face[corner[d]]


def test_plane_trees():
    """OEIS A006082: plane trees up to mirror images; with three joints at most, against a count of all."""
    assert [len(plane_trees(links, 20)) for links in range(2, 12)] == [1, 1, 2, 3, 6, 12, 27, 65, 175, 490]
    for links in range(2, 10):
        limited = plane_trees(links, 3)
        degrees = [max(np.bincount(decode_map(code)[1])) for code in plane_trees(links, 20)]
        assert len(limited) == sum(degree <= 3 for degree in degrees)


def test_limits():
    with pytest.raises(InvariantError, match="loops"):
        next(contracted_maps(1))
    with pytest.raises(InvariantError, match="loops"):
        next(contracted_maps(MOST_MAP_LOOPS + 1))


def test_levels_come_down_by_one():
    links = [n for n, _ in contracted_maps(6)]
    assert all(a - b == 1 for a, b in pairwise(links))
    assert links[0] == 10
    assert links[-1] == 2
