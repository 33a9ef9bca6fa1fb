"""The contracted graphs checked by the sums of their weights 1 / |Aut|.

A graph with n links has n! / |Aut| labellings, where |Aut| counts permutations of links and of parallel joints. So
the sum of the weights is a coefficient of a generating function of labelled multigraphs, and no graph is looked at.
A graph that a list lacks, or has twice, or whose symmetries are wrong, changes the sum. Theory:
docs/theory/chains.md.
"""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from math import comb, factorial, prod

from enumerate.contracted.graphs import decode
from enumerate.kernel.labelling import canonical_labels
from graphs.types import Bytes

Series = list[list[Fraction]]
"""Coefficients of x^n y^m: links and joints."""


def total_weights(loops: int) -> dict[int, Fraction]:
    """Return the sum of 1 / |Aut| over the contracted graphs with L >= 2 loops, for each number of links.

    With x for a link and y for a joint, multigraphs without self-joints have the generating function G = sum x^n
    e^(y n (n - 1) / 2) / n!, connected ones C = log G, 2-connected ones B with B'(x C') = log C' (a connected
    graph with a root is a set of 2-connected ones at the root, with connected graphs at their other links; Harary
    and Palmer, Graphical Enumeration, 1973, chapter 1). A 2-connected graph with two loops or more is a contracted
    one with joints replaced by paths: H(x, y / (1 - x y)) = B(x, y), so H(x, s) = B(x, s / (1 + x s)). Two links
    with three joints have 12 automorphisms:

    >>> {links: str(weight) for links, weight in total_weights(2).items()}
    {2: '1/12'}
    """
    most = 2 * (loops - 1)
    blocks = _two_connected(most, most + loops - 1)
    totals = {}
    for links in range(most, 1, -1):
        terms = (
            (-1) ** paths * comb(links + loops - 2, paths) * blocks[links - paths][links - paths + loops - 1]
            for paths in range(links - 1)
        )
        totals[links] = sum(terms, Fraction(0))
    return totals


def weight_of(codes: Bytes, n: int) -> Fraction:
    """Return the sum of 1 / |Aut| over contracted graphs of n links, by their codes uint8[k, m]."""
    orders = Counter(_order(code, n) for code in codes)
    return sum((Fraction(times, order) for order, times in orders.items()), Fraction(0))


def _order(code: Bytes, n: int) -> int:
    """Return the number of automorphisms of a graph, those of parallel joints among them."""
    swaps = prod(map(factorial, Counter(code.tolist()).values()))
    return swaps * len(canonical_labels(decode(code, n), n)[1])


def _two_connected(links: int, joints: int) -> Series:
    """Return the generating function of 2-connected multigraphs without self-joints, up to a size."""
    every = [
        [Fraction(comb(n, 2) ** m, factorial(m) * factorial(n)) for m in range(joints + 1)] for n in range(links + 1)
    ]
    connected = _logarithm(every)
    rooted = [[n * value for value in row] for n, row in enumerate(connected)]
    left = _logarithm(rooted[1:])
    blocks = [[Fraction(0)] * (joints + 1) for _ in range(links + 1)]
    power = rooted
    for k in range(1, links):
        coefficient = list(left[k])
        blocks[k + 1] = [value / (k + 1) for value in coefficient]
        for n in range(k, links):
            left[n] = [a - b for a, b in zip(left[n], _product(coefficient, power[n]), strict=True)]
        power = [_sum_of_products(power, rooted, n, joints) for n in range(links + 1)]
    return blocks


def _logarithm(series: Series) -> Series:
    """Return the logarithm of a series that begins with 1: n l_n = n a_n - sum k l_k a_(n - k)."""
    logarithm = [[Fraction(0)] * len(series[0])]
    for n in range(1, len(series)):
        row = [n * value for value in series[n]]
        for k in range(1, n):
            term = _product(logarithm[k], series[n - k])
            row = [value - k * other for value, other in zip(row, term, strict=True)]
        logarithm.append([value / n for value in row])
    return logarithm


def _sum_of_products(one: Series, other: Series, n: int, joints: int) -> list[Fraction]:
    total = [Fraction(0)] * (joints + 1)
    for k in range(1, n):
        total = [a + b for a, b in zip(total, _product(one[k], other[n - k]), strict=True)]
    return total


def _product(one: list[Fraction], other: list[Fraction]) -> list[Fraction]:
    """Return the product of two polynomials in y, cut off where they are."""
    product = [Fraction(0)] * len(one)
    for i, a in enumerate(one):
        if a:
            for j in range(len(one) - i):
                product[i + j] += a * other[j]
    return product
