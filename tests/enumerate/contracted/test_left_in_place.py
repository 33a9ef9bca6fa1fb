"""Placements that a permutation leaves as they are, counted by states, against all placements made one by one."""

from itertools import product

import numpy as np
import pytest
from placements import is_moving

from enumerate.chains.counting import count_by_burnside, count_by_orbits, count_fixed
from enumerate.contracted.binary_links import frame_of
from enumerate.contracted.graphs import contracted_graphs


def fixed_ones(frame, moved, units, most):
    found = 0
    ends, first = frame.ends, frame.first
    for x in product(range(most + 1), repeat=len(ends)):
        if sum(x) != units or any(first[e] != e and x[e] > x[e - 1] for e in range(len(ends))):
            continue
        if tuple(np.array(x)[moved]) != x:
            continue
        found += is_moving(x, ends, frame.sets, frame.needs)
    return found


@pytest.mark.parametrize(("loops", "dof"), [(2, 1), (2, 5), (3, 1), (3, 2), pytest.param(4, 1, marks=pytest.mark.slow)])
def test_of_every_automorphism(loops, dof):
    links = dof + 2 * loops + 1
    for n, codes in contracted_graphs(loops):
        for code in codes:
            frame = frame_of(code, n)
            for image in frame.moved[:4]:
                for most in (1, 2, dof + 1):
                    assert count_fixed(frame, image, links, most) == fixed_ones(frame, image, links - n, most)


@pytest.mark.parametrize(
    ("loops", "dof", "sample"), [(6, 1, 12), (5, 4, 6), (4, 9, 5), pytest.param(7, 1, 400, marks=pytest.mark.slow)]
)
def test_the_two_methods_agree_graph_by_graph(loops, dof, sample):
    links = dof + 2 * loops + 1
    dice = np.random.default_rng(loops)
    for n, codes in contracted_graphs(loops):
        for code in codes[dice.permutation(len(codes))[:sample]]:
            for most in (1, 2, dof + 1):
                one = count_by_orbits(code[None], n, links, most, False)
                assert one == count_by_burnside(code[None], n, links, most, False)
