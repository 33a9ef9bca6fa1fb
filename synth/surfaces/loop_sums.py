"""Loop sums: every circle on which the joints of a loop can lie, for any number of links.

Seen along its axis, a cone or a cylinder is a circle, and a link spans a signed *step* of it. A loop closes where
its steps sum to 360 k degrees (Hyatt et al. 2020, Eq. 12; Hyatt et al. 2021, Eq. 20). Both surfaces have one
form. Write a link by its *reach* C and the surface by its *size* z:

    cone       C = cot(angle / 2)^2,   z = tan(lambda)^2,   base 1
    cylinder   C = 1 / length^2,       z = 1 / (2 R)^2,     base 0

Then half a step is atan2(sqrt(base + z), sqrt(C - z)), real for 0 <= z <= min C, and along z the derivative of a
loop sum has the sign of g = sum s_i (C_i - z)^(-1/2).

No root is missed. With the reaches in rising order, multiply g by (C_j - z)^(1/2), where the sign changes
between s_j and the next, and differentiate: the result has the sign of sum s_i (C_j - C_i) (C_i - z)^(-3/2), one
sign change fewer. After as many steps as there are sign changes no zero is left; going back, each function is
monotone (up to a positive factor) between the zeros of the one after it. So g has at most as many zeros as there
are sign changes, and a loop sum at most one root more, all found by bisection. Theory: docs/theory/loop-sums.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from graphs.arrays import Floats
from graphs.errors import UnsolvableError

__all__ = ["MOST_LINKS", "LoopRoots", "half_steps", "loop_roots", "loop_sum", "sign_patterns"]

Base = Literal[0, 1]

MOST_LINKS = 16
"""Most links of a loop: it has 2^15 sign patterns then."""
_SAME = 1e-12
"""Reaches that differ by less, relatively, are one: their terms cancel exactly."""
_ZERO = 2e-13
"""A loop sum this near to a multiple of 360 degrees (radians) at a node is there: double roots, roots at ends."""
_ROWS = 200_000
"""Sign patterns treated at a time."""


@dataclass(frozen=True, slots=True)
class LoopRoots:
    """All circles of many loops, in the order of loops and sign patterns.

    Attributes
    ----------
    loop : int[M]
        Which loop.
    signs : int8[M, n]
        Signs of its steps; the first is +.
    turns : int[M]
        k: the steps sum to 2 pi k.
    size : float[M]
        z, with z = tan(lambda)^2 on a cone and 1 / (2 R)^2 on a cylinder.
    residual : float[M]
        Loop sum less 2 pi k, radians.
    double : bool[M]
        Whether the sum touches 2 pi k without crossing it, or is there at an end of the interval.
    family_loop, family_signs : int[F], int8[F, n]
        Sums that vanish for every z (k = 0): links pair off with equal ones of the other sign.
    """

    loop: npt.NDArray[np.intp]
    signs: npt.NDArray[np.int8]
    turns: npt.NDArray[np.int64]
    size: Floats
    residual: Floats
    double: npt.NDArray[np.bool_]
    family_loop: npt.NDArray[np.intp]
    family_signs: npt.NDArray[np.int8]


def half_steps(size: npt.ArrayLike, reach: npt.ArrayLike, base: Base) -> Floats:
    """Return half of the steps that links span, in [0, pi/2].

    Parameters
    ----------
    size : float[...]
        z; at most the reach (more is taken as equal, for rounding).
    reach : float[...]
        C, broadcast against z.
    base : {0, 1}
        0 on a cylinder, 1 on a cone.

    Examples
    --------
    A link of 60 degrees on the flat cone, lambda = 0, and at the largest lambda, where it spans half the circle:

    >>> np.degrees(2 * half_steps([0, 3], 3.0, 1)).round(9)
    array([ 60., 180.])
    """
    z, c = np.asarray(size, dtype=float), np.asarray(reach, dtype=float)
    return np.asarray(np.arctan2(np.sqrt(base + z), np.sqrt(np.maximum(c - z, 0.0))))


def loop_sum(size: npt.ArrayLike, reach: npt.ArrayLike, signs: npt.ArrayLike, base: Base) -> Floats:
    """Return the sum of signed steps, radians (Hyatt et al. 2020, Eq. 12; 2021, Eq. 20).

    Parameters
    ----------
    size : float[...]
    reach, signs : float[..., n]
    base : {0, 1}

    Examples
    --------
    >>> float(np.degrees(loop_sum(0.0, [3.0, 3.0, 3.0], [1, 1, -1], 1)).round(9))
    60.0
    """
    z = np.asarray(size, dtype=float)[..., np.newaxis]
    total = (np.asarray(signs) * half_steps(z, reach, base)).sum(axis=-1)
    return np.asarray(2.0 * total)


def sign_patterns(links: int) -> npt.NDArray[np.int8]:
    """Return all sign patterns with first sign +: int8[2^(links - 1), links], the pattern of all + first.

    Examples
    --------
    >>> sign_patterns(3).tolist()
    [[1, 1, 1], [1, 1, -1], [1, -1, 1], [1, -1, -1]]
    """
    bits = np.arange(2 ** (links - 1))[:, np.newaxis] >> np.arange(links - 1)[::-1] & 1
    return np.concatenate([np.ones((len(bits), 1), np.int8), (1 - 2 * bits).astype(np.int8)], axis=1)


def loop_roots(reach: npt.ArrayLike, base: Base) -> LoopRoots:
    """Return every circle on which each of many loops closes, for all sign patterns and all k.

    Parameters
    ----------
    reach : float[n] or float[B, n]
        Reaches of the links of each loop, in loop order.
    base : {0, 1}
        0 on a cylinder (z = 0, an infinite radius, is no root), 1 on a cone (z = 0 is the flat one and is a root).

    Returns
    -------
    LoopRoots

    Raises
    ------
    UnsolvableError
        If the loops have fewer than three links, or more than MOST_LINKS.

    Examples
    --------
    Hyatt et al. 2021, Fig. 10: links 4, 3, 5, 1 on a cylinder.

    >>> roots = loop_roots(1 / np.array([4.0, 3, 5, 1]) ** 2, 0)
    >>> roots.signs.tolist(), roots.turns.tolist(), (0.5 / np.sqrt(roots.size)).round(2).tolist()
    ([[1, 1, 1, 1], [1, 1, -1, -1]], [1, 0], [2.54, 2.59])
    """
    reaches = np.atleast_2d(np.asarray(reach, dtype=float))
    n = reaches.shape[1]
    if not 3 <= n <= MOST_LINKS:
        raise UnsolvableError(f"a loop of {n} links; expected 3 to {MOST_LINKS}")
    patterns = sign_patterns(n)
    at_once = max(1, _ROWS // len(patterns))
    parts = [
        _roots_of_chunk(reaches[start : start + at_once], patterns, start, base)
        for start in range(0, max(len(reaches), 1), at_once)
    ]
    joined = [np.concatenate([part[i] for part in parts]) for i in range(6)]
    families = np.concatenate([part[6] for part in parts])
    order = np.lexsort((joined[3], joined[2], joined[1], joined[0]))
    loop, pattern, turns, size, residual, double = (column[order] for column in joined)
    return LoopRoots(
        loop.astype(np.intp),
        patterns[pattern.astype(np.intp)],
        turns.astype(np.int64),
        size,
        residual,
        double.astype(bool),
        families[:, 0],
        patterns[families[:, 1]],
    )


def _roots_of_chunk(
    reaches: Floats, patterns: npt.NDArray[np.int8], first_loop: int, base: Base
) -> tuple[npt.NDArray[np.generic], ...]:
    """Return columns loop, pattern, turns, size, residual, double, and families (loop, pattern) of some loops."""
    loops, n = reaches.shape
    order = np.argsort(reaches, axis=1)
    sorted_reach = np.take_along_axis(reaches, order, axis=1)
    reach = np.repeat(sorted_reach, len(patterns), axis=0)
    signs = np.take_along_axis(
        np.broadcast_to(patterns, (loops, *patterns.shape)), order[:, np.newaxis, :], axis=2
    ).reshape(-1, n)
    of = np.stack(
        [np.repeat(np.arange(loops) + first_loop, len(patterns)), np.tile(np.arange(len(patterns)), loops)], 1
    )
    weights, reach = _merged(signs.astype(float), reach, base)
    vanishing = ~weights.any(axis=1)
    changes = _sign_changes(weights)
    found: list[tuple[npt.NDArray[np.generic], ...]] = []
    for count in range(n):
        rows = np.flatnonzero((changes == count) & ~vanishing)
        if len(rows):
            nodes = _nodes(weights[rows], reach[rows], count)
            for turns, row, size, residual, double in _crossings(nodes, weights[rows], reach[rows], base):
                whole = np.full(len(row), turns)
                found.append((*of[rows[row]].T, whole, size, residual, double))
    columns = [np.concatenate([part[i] for part in found]) if found else np.zeros(0) for i in range(6)]
    return (*columns, of[vanishing])


def _merged(signs: Floats, reach: Floats, base: Base) -> tuple[Floats, Floats]:
    """Put the signs of equal reaches together; return weights (0 where a neighbour took them) and reaches."""
    weights, reach = signs.copy(), reach.copy()
    for i in range(1, signs.shape[1]):
        # of angles near 180 degrees the reach is the square of what they lack, and the root tells them apart
        scale = np.maximum(reach[:, i], np.sqrt(reach[:, i])) if base else reach[:, i]
        same = reach[:, i] - reach[:, i - 1] <= _SAME * scale
        reach[:, i] = np.where(same, reach[:, i - 1], reach[:, i])
        weights[:, i] += np.where(same, weights[:, i - 1], 0.0)
        weights[:, i - 1] = np.where(same, 0.0, weights[:, i - 1])
    return weights, reach


def _sign_changes(weights: Floats) -> npt.NDArray[np.int64]:
    """Count the sign changes along each row, zeros left out."""
    last = np.zeros(len(weights))
    changes = np.zeros(len(weights), dtype=np.int64)
    for column in np.sign(weights).T:
        changes += column * last < 0
        last = np.where(column != 0, column, last)
    return changes


def _nodes(weights: Floats, reach: Floats, changes: int) -> Floats:
    """Return 0, the zeros of g and the least reach of each row, in rising order: float[rows, changes + 2].

    Where g has fewer zeros than sign changes, the last node is repeated.
    """
    tower = [weights]
    for _ in range(changes):
        tower.append(_one_change_fewer(tower[-1], reach))
    end = reach[:, :1]
    nodes = np.concatenate([np.zeros_like(end), end], axis=1)
    for level in range(changes - 1, -1, -1):
        nodes = _between_zeros(nodes, tower[level], reach, level)
    return nodes


def _one_change_fewer(weights: Floats, reach: Floats) -> Floats:
    """Return the weights of the next function of the tower: times C_j - C_i, j before the first sign change."""
    last = np.zeros(len(weights))
    before = np.zeros(len(weights), dtype=np.intp)
    place = np.zeros(len(weights), dtype=np.intp)
    open_ = np.ones(len(weights), dtype=bool)
    for i, column in enumerate(np.sign(weights).T):
        here = open_ & (column * last < 0)
        place[here] = before[here]
        open_ &= ~here
        before[column != 0] = i
        last = np.where(column != 0, column, last)
    made = weights * (np.take_along_axis(reach, place[:, np.newaxis], axis=1) - reach)
    return np.asarray(made / np.abs(made).max(axis=1, keepdims=True))


def _between_zeros(nodes: Floats, weights: Floats, reach: Floats, level: int) -> Floats:
    """Add the zeros of a function of the tower to its ends; between the given nodes it has at most one each."""
    there = weights != 0
    first = np.argmax(there, axis=1)[:, np.newaxis]
    nearest = np.take_along_axis(reach, first, axis=1)
    values = np.stack([_of_tower(z, level, nearest, weights, reach) for z in nodes.T], axis=1)
    row, left = np.nonzero(values[:, :-1] * values[:, 1:] < 0)
    zeros = np.broadcast_to(nodes[:, -1:], (len(nodes), nodes.shape[1] - 1)).copy()
    if len(row):

        def value(z: Floats, number: Floats) -> Floats:
            at = number.astype(np.intp)
            return _of_tower(z, level, nearest[at], weights[at], reach[at])

        zeros[row, left] = _bisected(value, nodes[row, left], nodes[row, left + 1], row)
        zeros.sort(axis=1)
    return np.concatenate([nodes[:, :1], zeros, nodes[:, -1:]], axis=1)


def _of_tower(z: Floats, level: int, nearest: Floats, weights: Floats, reach: Floats) -> Floats:
    """Return sum w_i ((C - z) / (C_i - z))^(level + 1/2), with C the least reach that has a weight."""
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = (nearest - z[:, np.newaxis]) / (reach - z[:, np.newaxis])
    ratio = np.where(reach == nearest, 1.0, np.where(weights == 0, 0.0, ratio))
    return np.asarray((weights * np.sqrt(ratio) * ratio**level).sum(axis=1))


def _crossings(
    nodes: Floats, weights: Floats, reach: Floats, base: Base
) -> Iterator[tuple[int, npt.NDArray[np.intp], Floats, Floats, npt.NDArray[np.bool_]]]:
    """Yield k, and row, size, residual and double of each root, where monotone pieces of the sums cross 2 pi k."""
    sums = np.stack([loop_sum(z, reach, weights, base) for z in nodes.T], axis=1)
    low, high = sums.min(axis=1), sums.max(axis=1)
    most = weights.shape[1] // 2

    for turns in range(-most, most + 1):
        goal = 2.0 * np.pi * turns
        rows = np.flatnonzero((low <= goal + _ZERO) & (high >= goal - _ZERO))
        if not len(rows):
            continue
        over = sums[rows] - goal
        side = np.where(np.abs(over) <= _ZERO, 0.0, np.sign(over))
        row, left = np.nonzero(side[:, :-1] * side[:, 1:] < 0)
        if len(row):

            def value(z: Floats, number: Floats, rows: npt.NDArray[np.intp] = rows, goal: float = goal) -> Floats:
                at = rows[number.astype(np.intp)]
                return loop_sum(z, reach[at], weights[at], base) - goal

            size = _bisected(value, nodes[rows[row], left], nodes[rows[row], left + 1], row)
            yield turns, rows[row], size, value(size, row.astype(float)), np.zeros(len(row), dtype=bool)
        touching = side == 0
        touching[:, 1:] &= side[:, :-1] != 0  # neighbouring nodes may be the same root
        if base == 0 and turns == 0:
            touching[:, 0] = False  # an infinite radius
        row, at_node = np.nonzero(touching)
        if len(row):
            yield turns, rows[row], nodes[rows[row], at_node], over[row, at_node], np.ones(len(row), dtype=bool)


def _bisected(value: object, low: Floats, high: Floats, number: npt.NDArray[np.intp]) -> Floats:
    """Return the root of each row between two points where its values differ in sign."""
    from scipy.optimize import elementwise

    return np.asarray(elementwise.find_root(value, (low, high), args=(number.astype(float),)).x)
