"""The number of connected chains, fractionated ones too, from the cycle indices of the blocks.

A chain rooted at a link is that link with a set of blocks hung on it, each other link of a block again a rooted
chain (Robinson 1970). With Z the sum of y^M Z(B) over all blocks B, Z' its derivative by p_1 and p_k read as
R(x^k, y^k),

    R = x exp( sum over k of Z'[R](x^k, y^k) / k ),

x marking links and y freedoms; a bridge joint takes part with y (R - x), since no leaf of the tree is one. The
dissymmetry theorem (chains = rooted at a link + rooted at a block - rooted at a block and one of its links) takes
the roots away. The cycle index of the blocks comes from placements fixed by each automorphism: nothing is listed
and compared. Theory: docs/theory/chains.md.

Source: R. W. Robinson, *Enumeration of non-separable graphs*, J. Combin. Theory 9 (1970); Bergeron, Labelle and
Leroux, *Combinatorial Species and Tree-like Structures* (1998), section 4.1.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import reduce
from itertools import product
from math import factorial

import numpy as np

from enumerate.contracted.binary_links import Units, conditions, place, rigid_sets
from enumerate.contracted.graphs import contracted_graphs, decode
from enumerate.contracted.listing import frame_of
from graphs.types import Bytes, Ints

__all__ = ["block_cycle_index", "count_connected"]

Monomial = tuple[tuple[int, int], ...]
"""Lengths of cycles of links, with how many there are of each."""

Series = dict[tuple[int, int], Fraction]
"""Numbers of links and of freedoms to a coefficient."""


def count_connected(links: int, dof: int) -> int:
    """Return the number of chains of N links and M freedoms without rigid sub-chains, fractionated ones included.

    Parameters
    ----------
    links, dof : int
        N, and M from 1 on.

    Returns
    -------
    int

    Examples
    --------
    >>> [count_connected(links, 2) for links in (5, 7, 9)]
    [1, 4, 40]
    """
    blocks = {
        (n, m): block_cycle_index(n, m)
        for m in range(1, dof + 1)
        for n in range(m + 3, links + 1, 2)
        if links - n >= dof - m and n - m <= links - dof  # the other blocks have M_i <= N_i - 1
    }
    limits = links, dof
    derivative = {size: _derivative(index) for size, index in blocks.items()}
    link: Series = {(1, 0): Fraction(1)}
    rooted, last = link, None
    while rooted != last:
        last = rooted
        planted = _sum([_at(_substituted(derivative, rooted, limits), 0, 0), _at(_minus(rooted, link), 0, 1)])
        rooted = _product(link, _exponential(_cut(planted, limits), limits), limits)
    away = _minus(rooted, link)
    bridge: Series = {(0, 1): Fraction(1)}
    at_link = _minus(away, _product(_product(link, bridge, limits), away, limits))
    squares = {(2 * n, 2 * m): value for (n, m), value in away.items()}
    pairs = _scaled(_sum([_product(away, away, limits), squares]), Fraction(1, 2))
    at_block = _sum([_substituted(blocks, rooted, limits), _product(bridge, pairs, limits)])
    at_both = _sum(
        [
            _product(rooted, _substituted(derivative, rooted, limits), limits),
            _product(bridge, _product(away, away, limits), limits),
        ]
    )
    total = _minus(_sum([at_link, at_block]), at_both).get(limits, Fraction(0))
    assert total.denominator == 1
    return total.numerator


def block_cycle_index(links: int, dof: int) -> dict[Monomial, Fraction]:
    """Return the sum of the cycle indices, over links, of all chains that nothing cuts.

    >>> index = block_cycle_index(4, 1)  # the dihedral group of a four-bar
    >>> index[((1, 4),)], index[((4, 1),)], index[((2, 2),)]
    (Fraction(1, 8), Fraction(1, 4), Fraction(3, 8))
    """
    total: dict[Monomial, Fraction] = defaultdict(Fraction)
    loops = (links - 1 - dof) // 2
    if loops == 1:
        for turn in range(links):
            for flip in (1, -1):
                image = [(turn + flip * i) % links for i in range(links)]
                total[_monomial(Counter(_cycle_lengths(image)))] += Fraction(1, 2 * links)
        return dict(total)
    for n, codes in contracted_graphs(loops):
        if n <= links:
            for code in codes:
                for monomial, value in _index_of_graph(code, n, links):
                    total[monomial] += value
    return dict(total)


def _index_of_graph(code: Bytes, n: int, links: int) -> Iterator[tuple[Monomial, Fraction]]:
    """Yield the terms of the cycle index of the chains of a contracted graph."""
    ends, first, moved, automorphisms = frame_of(code, n)
    sets, needs = rigid_sets(decode(code, n), n)
    for move, automorphism in zip(moved, automorphisms, strict=True):
        base = Counter(_cycle_lengths(automorphism.tolist()))
        classes = list(_class_cycles(ends, first, move, automorphism))
        for types in product(*(list(_partitions(len(cycle[0]))) for cycle, _ in classes)):
            share = Fraction(1, len(moved))
            joints, turned = [], []  # of each cycle of strings: its joints, and whether it comes back turned round
            for (cycle, flips), parts in zip(classes, types, strict=True):
                share /= _centraliser(parts)
                taken = 0
                for part in parts:
                    joints.append([e for step in cycle for e in step[taken : taken + part]])
                    turned.append(flips and part % 2 == 1)
                    taken += part
            for x in _placements(ends, sets, needs, joints, links - n):
                lengths = base.copy()
                for value, string, turns in zip(x, joints, turned, strict=True):
                    lengths[len(string)] += value % 2 if turns else value
                    lengths[2 * len(string)] += value // 2 if turns else 0
                yield _monomial(lengths), share


def _class_cycles(
    ends: Bytes, first: Ints, move: Bytes, automorphism: Bytes
) -> Iterator[tuple[list[list[int]], bool]]:
    """Yield the cycles of classes of parallel joints, and whether a class comes back with its ends exchanged."""
    members: dict[int, list[int]] = defaultdict(list)
    for e, start in zip(range(len(first)), first.tolist(), strict=True):
        members[start].append(e)
    left = set(members)
    while left:
        start = min(left)
        cycle, e, end = [], start, int(ends[start, 0])
        while e in left:
            left.remove(e)
            cycle.append(members[e])
            e, end = int(move[e]), int(automorphism[end])
        yield cycle, end != int(ends[start, 0])


def _placements(ends: Bytes, sets: Ints, needs: Ints, joints: list[list[int]], units: int) -> Iterator[list[int]]:
    """Yield the placements in which the joints of each cycle hold equally many binary links."""
    cost = np.array([len(cycle) for cycle in joints], np.int64)
    alone, identity = np.arange(len(cost)), np.arange(len(cost), dtype=np.uint8)[None]
    for bound in range(max(int(needs[-1]), 0), min(units, 2 * len(ends)) + 1):
        room, weight = conditions(ends, sets, needs, bound)
        shares = np.array([weight[cycle].sum(axis=0) for cycle in joints], np.uint64).reshape(
            len(joints), len(room)
        )
        left = Units(bound, units - bound, units)
        problem = room, shares, cost, alone, left, identity, np.zeros(0, np.int64)
        count = place(*problem, np.zeros((0, len(cost)), np.uint8), np.zeros(0, np.int64))
        if count:
            x = np.zeros((count, len(cost)), np.uint8)
            place(*problem, x, np.zeros(count, np.int64))
            yield from x.tolist()


def _cycle_lengths(image: Sequence[int]) -> list[int]:
    seen, lengths = set(), []
    for start in image:
        length, here = 0, start
        while here not in seen:
            seen.add(here)
            here = image[here]
            length += 1
        if length:
            lengths.append(length)
    return lengths


def _monomial(lengths: Counter[int]) -> Monomial:
    return tuple(sorted((length, count) for length, count in lengths.items() if count))


def _partitions(k: int, most: int | None = None) -> Iterator[tuple[int, ...]]:
    if k == 0:
        yield ()
    for part in range(min(k, most or k), 0, -1):
        for rest in _partitions(k - part, part):
            yield (part, *rest)


def _centraliser(parts: Sequence[int]) -> int:
    """Return how many permutations commute with one of this cycle type: the inverse of its share of the group."""
    size = 1
    for part, count in Counter(parts).items():
        size *= part**count * factorial(count)
    return size


def _derivative(index: dict[Monomial, Fraction]) -> dict[Monomial, Fraction]:
    """Return the derivative by p_1."""
    found = {}
    for monomial, value in index.items():
        lengths = Counter(dict(monomial))
        if lengths[1]:
            factor = lengths[1]
            lengths[1] -= 1
            found[_monomial(lengths)] = value * factor
    return found


def _substituted(
    blocks: dict[tuple[int, int], dict[Monomial, Fraction]], rooted: Series, limits: tuple[int, int]
) -> Series:
    """Return the sum over the blocks of y^M times the cycle index with p_k read as R(x^k, y^k)."""
    powers: dict[tuple[int, int], Series] = {}

    def power(length: int, count: int) -> Series:
        if (length, count) not in powers:
            if count == 1:
                raised = {(length * n, length * m): value for (n, m), value in rooted.items()}
                powers[length, 1] = _cut(raised, limits)
            else:
                powers[length, count] = _product(power(length, count - 1), power(length, 1), limits)
        return powers[length, count]

    total: dict[tuple[int, int], Fraction] = defaultdict(Fraction)
    for (_, dof), index in blocks.items():
        for monomial, value in index.items():
            factors = [power(length, count) for length, count in monomial]
            result = reduce(lambda a, b: _product(a, b, limits), factors, {(0, dof): value})
            for key, coefficient in result.items():
                total[key] += coefficient
    return dict(total)


def _exponential(series: Series, limits: tuple[int, int]) -> Series:
    """Return exp(sum over k of series(x^k, y^k) / k)."""
    total: dict[tuple[int, int], Fraction] = defaultdict(Fraction)
    for k in range(1, max(limits) + 1):
        for (n, m), value in series.items():
            total[k * n, k * m] += value / k
    exponent = _cut(dict(total), limits)
    result: Series = {(0, 0): Fraction(1)}
    term, k = result, 0
    while term:
        k += 1
        term = _scaled(_product(term, exponent, limits), Fraction(1, k))
        result = _sum([result, term])
    return result


def _product(a: Series, b: Series, limits: tuple[int, int]) -> Series:
    total: dict[tuple[int, int], Fraction] = defaultdict(Fraction)
    for (n, m), value in a.items():
        for (i, j), other in b.items():
            if n + i <= limits[0] and m + j <= limits[1]:
                total[n + i, m + j] += value * other
    return dict(total)


def _sum(parts: Sequence[Series]) -> Series:
    total: dict[tuple[int, int], Fraction] = defaultdict(Fraction)
    for part in parts:
        for key, value in part.items():
            total[key] += value
    return {key: value for key, value in total.items() if value}


def _minus(a: Series, b: Series) -> Series:
    return _sum([a, _scaled(b, Fraction(-1))])


def _scaled(series: Series, factor: Fraction) -> Series:
    return {key: value * factor for key, value in series.items()}


def _at(series: Series, links: int, dof: int) -> Series:
    """Return a series times x^links y^dof."""
    return {(n + links, m + dof): value for (n, m), value in series.items()}


def _cut(series: Series, limits: tuple[int, int]) -> Series:
    return {(n, m): value for (n, m), value in series.items() if n <= limits[0] and m <= limits[1]}
