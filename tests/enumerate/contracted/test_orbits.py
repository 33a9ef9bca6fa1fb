"""Placements counted by states, against placements that are made and compared one by one."""

from functools import lru_cache
from itertools import combinations_with_replacement, product

import numpy as np
import pytest
from placements import is_moving

from enumerate.chains.counting import count_in
from enumerate.contracted.binary_links import EVERY, PlacementRange, frame_of, no_prefix
from enumerate.contracted.graphs import contracted_graphs
from enumerate.contracted.orbits import count_orbits
from enumerate.contracted.states import strings_of_classes


@lru_cache
def graphs(loops):
    return list(contracted_graphs(loops))


def subgroups(moved):
    """The trivial group, the whole one, and those that one of some elements generates."""
    yield moved[:1]
    yield moved
    for element in moved[1:6]:
        powers, image = [moved[0]], element
        while (image != moved[0]).any():
            powers.append(image)
            image = element[image]
        yield np.array(powers, np.uint8)


def largest_ones(frame, units, most):
    """Number of placements that are moving, in falling order on parallel joints, and that no symmetry makes larger."""
    found = 0
    ends, first = frame.ends, frame.first
    for x in product(range(most + 1), repeat=len(ends)):
        if sum(x) != units or any(first[e] != e and x[e] > x[e - 1] for e in range(len(ends))):
            continue
        if not is_moving(x, ends, frame.sets, frame.needs):
            continue
        found += all(tuple(np.array(x)[image]) <= x for image in frame.moved)
    return found


@pytest.mark.parametrize(("loops", "dof"), [(2, 1), (2, 5), (3, 1), (3, 2), pytest.param(4, 1, marks=pytest.mark.slow)])
def test_of_every_orbit_the_largest(loops, dof):
    links = dof + 2 * loops + 1
    for n, codes in graphs(loops):
        for code in codes:
            frame = frame_of(code, n)
            for group in subgroups(frame.moved):
                problem = frame._replace(moved=group), links - n
                for most in (1, 2, dof + 1):
                    assert count_orbits(*problem, most) == largest_ones(*problem, most)


@pytest.mark.parametrize(
    ("loops", "dof", "step"), [(5, 1, 3), (4, 4, 5), pytest.param(6, 3, 7, marks=pytest.mark.slow)]
)
def test_counted_as_they_are_listed(loops, dof, step):
    """For groups that are not the whole one too, and parallel joints that are told apart."""
    links = dof + 2 * loops + 1
    for n, codes in graphs(loops):
        for code in codes[::step]:
            frame = frame_of(code, n)
            for group in subgroups(frame.moved):
                for alike in (frame.first, np.arange(len(frame.ends))):
                    problem = frame._replace(first=alike, moved=group)
                    parts = [
                        count_in(problem, PlacementRange(links, dof + 1, only), no_prefix())
                        for only in range(links - n + 1)
                    ]
                    assert count_in(problem, PlacementRange(links, dof + 1, EVERY), no_prefix()) == sum(parts)


@pytest.mark.parametrize("most", [0, 1, 2, 3, 6])
def test_strings_on_parallel_joints(most):
    start, ways = strings_of_classes(4, 6, most)
    for size in range(5):
        expected = {}
        for x in combinations_with_replacement(range(most + 1), size):
            key = sum(x), sum(min(value, 2) for value in x)
            if key[0] <= 6:
                number, links = expected.get(key, (0, 0))
                expected[key] = number + 1, links + sum(set(x))
        rows = ways[start[size] : start[size + 1]].tolist()
        assert {(units, counted): (number, links) for units, counted, number, links in rows} == expected
        assert len(rows) == len(expected)
