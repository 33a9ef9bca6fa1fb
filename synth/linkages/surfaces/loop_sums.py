"""Loop sums: every circle on which the joints of a loop can lie, for any number of links.

A loop closes where its signed steps sum to 360 k degrees (Hyatt et al. 2020, Eq. 12; Hyatt et al. 2021, Eq. 20). A
link is its *reach* C, the surface its *size* z: C = cot(angle / 2)^2, z = tan(lambda)^2, base 1 on a cone; C = 1 /
length^2, z = 1 / (2 R)^2, base 0 on a cylinder. Half a step is atan2(sqrt(base + z), sqrt(C - z)), and along z the
derivative of a loop sum has the sign of g = sum s_i (C_i - z)^(-1/2). No root is missed: a tower of functions,
each with one sign change fewer, brackets the zeros of g, and these the roots, found by bisection: by loop_sums.c,
or by numpy where it was not built. A loop sum is compared with its own rounding (`sum_rounding`), nothing absolute.
Four links have closed forms (Hyatt et al. 2021, Eqs. 4, 5, 11 to 14). Theory: docs/theory/loop-sums.md,
docs/theory/mapping.md, docs/theory/rounding.md.
"""

from collections.abc import Callable, Iterator
from ctypes import c_int64, c_void_p
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from graphs.c_libraries import library
from graphs.errors import UnsolvableError
from graphs.tolerances import EPSILON
from graphs.types import Flags, Floats, Ints
from synth.linkages.fourbar.closing import rounding_of

SOURCE = Path(__file__).with_name("loop_sums.c")
Columns = tuple[Ints, Ints, Ints, Floats, Floats, Ints, Ints]
"""Loop, pattern, turns, size, residual, and 1 where double, of each root; loop, pattern, 1 where exact of families."""
_ROOTS_OF_A_LOOP = 8
"""For so many roots there is room at first."""


def roots_in_library(reaches: Floats, patterns: npt.NDArray[np.int8], first_loop: int, base: int) -> Columns | None:
    """Return the roots and families of loops with reaches float[B, n]; None where there is no library."""
    found = library(SOURCE)
    if found is None:
        return None
    if found.all_roots.argtypes is None:
        found.all_roots.restype = None
        found.all_roots.argtypes = [*[c_int64] * 4, *[c_void_p] * 2, *[c_int64] * 2, *[c_void_p] * 8]
    loops, links = reaches.shape
    reaches, patterns = np.ascontiguousarray(reaches), np.ascontiguousarray(patterns)
    room = _ROOTS_OF_A_LOOP * loops + len(patterns)
    while True:
        columns = _columns(room)
        counts = np.zeros(2, dtype=np.int64)
        sizes = (loops, links, len(patterns), base)
        given = (reaches.ctypes.data, patterns.ctypes.data, first_loop, room)
        found.all_roots(*sizes, *given, *(column.ctypes.data for column in columns), counts.ctypes.data)
        roots, families = counts.tolist()
        if max(roots, families) <= room:
            *of_roots, family = columns
            return (*(column[:roots] for column in of_roots), family[:families])  # type: ignore[return-value]
        room = max(roots, families)


def _columns(room: int) -> Columns:
    loop, pattern, turns, double = (np.empty(room, dtype=np.int64) for _ in range(4))
    return loop, pattern, turns, np.empty(room), np.empty(room), double, np.empty((room, 3), dtype=np.int64)


Base = Literal[0, 1]

MOST_LINKS = 16
"""Most links of a loop: it has 2^15 sign patterns then."""
_MOST_STEPS = 200
_ROWS = 200_000
"""Sign patterns treated at a time."""
_MOST_SENSITIVE = 1.0 / np.sqrt(8.0 * np.finfo(float).eps)
"""Last digits of a link that nearly is half a turn count for so much in its step: there, it is their root."""


@dataclass(frozen=True, slots=True)
class LoopRoots:
    """All circles of many loops, in the order of loops and sign patterns: M roots, and F families.

    A root has the number of its ``loop``, the ``signs`` of its steps, int8[M, n], the first +, ``turns`` k, its
    ``size`` z, and the ``residual``, the loop sum less 2 pi k, radians. It is ``double`` where the sum, within its
    rounding, touches 2 pi k without crossing it, or is there at an end of the interval. Families are sums that
    vanish for every z, exactly if links pair off with equal ones of the other sign, else within rounding.
    """

    loop: npt.NDArray[np.intp]
    signs: npt.NDArray[np.int8]
    turns: npt.NDArray[np.int64]
    size: Floats
    residual: Floats
    double: npt.NDArray[np.bool_]
    family_loop: npt.NDArray[np.intp]
    family_signs: npt.NDArray[np.int8]
    family_exact: npt.NDArray[np.bool_]


def half_steps(size: npt.ArrayLike, reach: npt.ArrayLike, base: Base) -> Floats:
    """Return half of the steps that links span, in [0, pi/2], on a cylinder (base 0) or a cone (base 1).

    `size` is z, at most the reach C, against which it is broadcast (more is taken as equal, for rounding).
    """
    z, c = np.asarray(size, dtype=float), np.asarray(reach, dtype=float)
    return np.asarray(np.arctan2(np.sqrt(base + z), np.sqrt(np.maximum(c - z, 0.0))))


def loop_sum(size: npt.ArrayLike, reach: npt.ArrayLike, signs: npt.ArrayLike, base: Base) -> Floats:
    """Return the sum of signed steps, radians, float[...] (Hyatt et al. 2020, Eq. 12; 2021, Eq. 20).

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


def sum_rounding(size: npt.ArrayLike, reach: npt.ArrayLike, weights: npt.ArrayLike, base: Base) -> Floats:
    """Return how far the rounding of the links may change loop sums, radians: what is less is zero.

    A last digit of a link changes its step by as much, relatively, while it is small, but the more the nearer it
    is to half a turn: by tan(half a step), up to the root of a last digit. The longest link is half a turn where
    the interval ends, whatever its last digit. Reach and weights are float[..., n]; weights are the signs, those
    of equal reaches added up or not.
    """
    z = np.asarray(size, dtype=float)[..., np.newaxis]
    c = np.asarray(reach, dtype=float)
    steps = 2.0 * half_steps(z, c, base)
    left = np.maximum(c - z, c / _MOST_SENSITIVE**2)
    change = 2.0 * np.sqrt(c / (base + c) * (base + z) / left)
    return rounding_of(np.abs(weights) * np.where(c <= z, steps, np.maximum(steps, change)))


def put_together(signs: npt.ArrayLike, reach: npt.ArrayLike) -> tuple[Floats, Floats]:
    """Return the weights of one loop, the signs of equal links added up, and their reaches in rising order."""
    distinct, which = np.unique(np.asarray(reach, dtype=float), return_inverse=True)
    weights: Floats = np.bincount(which, weights=np.asarray(signs, dtype=float)).astype(float)
    return weights, distinct


def sign_patterns(links: int) -> npt.NDArray[np.int8]:
    """Return all sign patterns with first sign +: int8[2^(links - 1), links], the pattern of all + first."""
    bits = np.arange(2 ** (links - 1))[:, np.newaxis] >> np.arange(links - 1)[::-1] & 1
    return np.concatenate([np.ones((len(bits), 1), np.int8), (1 - 2 * bits).astype(np.int8)], axis=1)


def loop_roots(reach: npt.ArrayLike, base: Base) -> LoopRoots:
    """Return every circle on which each of many loops closes, for all sign patterns and all k.

    Reaches, float[n] or float[B, n], are in loop order. On a cylinder (base 0) z = 0, an infinite radius, is no
    root; on a cone (base 1) z = 0 is the flat one and is a root. Raises `UnsolvableError` if the loops have fewer
    than three links, or more than MOST_LINKS.
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
    families = families[np.lexsort((families[:, 1], families[:, 0]))]
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
        families[:, 2].astype(bool),
    )


def _roots_of_chunk(
    reaches: Floats, patterns: npt.NDArray[np.int8], first_loop: int, base: Base
) -> tuple[npt.NDArray[np.generic], ...]:
    """Return columns loop, pattern, turns, size, residual, double; loop, pattern, exact of families."""
    by_library = roots_in_library(reaches, patterns, first_loop, base)
    if by_library is not None:
        return by_library
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
    weights = _merged(signs.astype(float), reach)
    vanishing = ~weights.any(axis=1)
    changes = _sign_changes(weights)
    roots: list[tuple[npt.NDArray[np.generic], ...]] = []
    families = [np.column_stack([of[vanishing], np.ones(vanishing.sum(), np.intp)])]
    for count in range(n):
        rows = np.flatnonzero((changes == count) & ~vanishing)
        if len(rows):
            nodes = _nodes(weights[rows], reach[rows], count)
            sums = _SumsAtNodes(nodes, weights[rows], reach[rows], base)
            nowhere_else = of[rows[sums.vanish]]
            families.append(np.column_stack([nowhere_else, np.zeros(len(nowhere_else), np.intp)]))
            for turns, row, size, residual, double in _crossings(sums, base):
                whole = np.full(len(row), turns)
                roots.append((*of[rows[row]].T, whole, size, residual, double))
    columns = [np.concatenate([part[i] for part in roots]) if roots else np.zeros(0) for i in range(6)]
    return (*columns, np.concatenate(families))


def _merged(signs: Floats, reach: Floats) -> Floats:
    """Put the signs of equal reaches together; return weights, 0 where a neighbour took them."""
    weights = signs.copy()
    for i in range(1, signs.shape[1]):
        same = reach[:, i] == reach[:, i - 1]
        weights[:, i] += np.where(same, weights[:, i - 1], 0.0)
        weights[:, i - 1] = np.where(same, 0.0, weights[:, i - 1])
    return weights


def _sign_changes(weights: Floats) -> npt.NDArray[np.int64]:
    """Count the sign changes along each row, zeros left out."""
    last = np.zeros(len(weights))
    changes = np.zeros(len(weights), dtype=np.int64)
    for column in np.sign(weights).T:
        changes += column * last < 0
        last = np.where(column != 0, column, last)
    return changes


def _nodes(weights: Floats, reach: Floats, changes: int) -> Floats:
    """Return 0, the zeros of g, and the least reach (repeated if zeros lack) of rows: float[rows, changes + 2]."""
    tower = [weights]
    for _ in range(changes):
        tower.append(_one_change_fewer(tower[-1], reach))
    end = reach[:, :1]
    nodes = np.concatenate([np.zeros_like(end), end], axis=1)
    for level in range(changes - 1, -1, -1):  # back from the function without zeros to g itself
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
    fewer = weights * (np.take_along_axis(reach, place[:, np.newaxis], axis=1) - reach)
    return np.asarray(fewer / np.abs(fewer).max(axis=1, keepdims=True))


def _between_zeros(nodes: Floats, weights: Floats, reach: Floats, level: int) -> Floats:
    """Add the zeros of a function of the tower to its ends; between the given nodes it has at most one each."""
    there = weights != 0
    first = np.argmax(there, axis=1)[:, np.newaxis]
    nearest = np.take_along_axis(reach, first, axis=1)
    values = np.stack([_of_tower(z, level, nearest, weights, reach) for z in nodes.T], axis=1)
    row, left = np.nonzero(values[:, :-1] * values[:, 1:] < 0)
    zeros = np.broadcast_to(nodes[:, -1:], (len(nodes), nodes.shape[1] - 1)).copy()
    if len(row):

        def value(z: Floats, at: npt.NDArray[np.intp]) -> Floats:
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


class _SumsAtNodes:
    """Loop sums of many rows where their monotone pieces meet, and their rounding, where they are near 2 pi k.

    `vanish`, bool[rows]: the sums of a row are 0 at all nodes within rounding, and so between them.
    """

    def __init__(self, nodes: Floats, weights: Floats, reach: Floats, base: Base) -> None:
        self.nodes, self.weights, self.reach = nodes, weights, reach
        self.sums = np.stack([loop_sum(z, reach, weights, base) for z in nodes.T], axis=1)
        self.noise = np.zeros_like(self.sums)
        most = rounding_of(2.0 * _MOST_SENSITIVE * weights)  # elsewhere rounding decides nothing
        near = np.abs(np.remainder(self.sums + np.pi, 2.0 * np.pi) - np.pi) <= most[:, np.newaxis]
        row, node = np.nonzero(near)
        self.noise[row, node] = sum_rounding(nodes[row, node], reach[row], weights[row], base)
        self.vanish: Flags = np.asarray((np.abs(self.sums) <= self.noise).all(axis=1))


def _crossings(
    at: _SumsAtNodes, base: Base
) -> Iterator[tuple[int, npt.NDArray[np.intp], Floats, Floats, npt.NDArray[np.bool_]]]:
    """Yield k, and row, size, residual and double of each root, where monotone pieces of the sums cross 2 pi k."""
    low, high = (at.sums - at.noise).min(axis=1), (at.sums + at.noise).max(axis=1)
    most = at.weights.shape[1] // 2

    for turns in range(-most, most + 1):
        goal = 2.0 * np.pi * turns
        rows = np.flatnonzero((low <= goal) & (high >= goal) & ~(at.vanish & (turns == 0)))
        if not len(rows):
            continue
        over = at.sums[rows] - goal
        side = np.where(np.abs(over) <= at.noise[rows], 0.0, np.sign(over))
        row, left = np.nonzero(side[:, :-1] * side[:, 1:] < 0)
        if len(row):

            def value(
                z: Floats, at_row: npt.NDArray[np.intp], rows: npt.NDArray[np.intp] = rows, goal: float = goal
            ) -> Floats:
                of = rows[at_row]
                return loop_sum(z, at.reach[of], at.weights[of], base) - goal

            size = _bisected(value, at.nodes[rows[row], left], at.nodes[rows[row], left + 1], row)
            yield turns, rows[row], size, value(size, row), np.zeros(len(row), dtype=bool)
        touching = side == 0
        touching[:, 1:] &= side[:, :-1] != 0  # neighbouring nodes may be the same root
        if base == 0 and turns == 0:
            touching[:, 0] = False  # an infinite radius
        row, node = np.nonzero(touching)
        if len(row):
            yield turns, rows[row], at.nodes[rows[row], node], over[row, node], np.ones(len(row), dtype=bool)


_Rows = npt.NDArray[np.intp]


def _bisected(value: Callable[[Floats, _Rows], Floats], low: Floats, high: Floats, number: _Rows) -> Floats:
    """Return the root of each row between two points where its values differ in sign: Chandrupatla's method.

    As `scipy.optimize.elementwise.find_root`, which spends ten times as long on the few rows of one linkage.
    """
    first, second = low.copy(), high.copy()
    at_first, at_second = value(first, number), value(second, number)
    part = np.full(len(number), 0.5)
    for _ in range(_MOST_STEPS):
        tried = first + part * (second - first)
        at_tried = value(tried, number)
        same = np.sign(at_tried) == np.sign(at_first)
        third, at_third = np.where(same, first, second), np.where(same, at_first, at_second)
        second, at_second = np.where(same, second, first), np.where(same, at_second, at_first)
        first, at_first = tried, at_tried
        best = np.where(np.abs(at_first) < np.abs(at_second), first, second)
        width = np.abs(second - first)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            least = (4.0 * EPSILON * np.abs(best) + np.finfo(float).tiny) / width
            along, up = (first - second) / (third - second), (at_first - at_second) / (at_third - at_second)
            curved = at_first / (at_second - at_first) * at_third / (at_second - at_third)
            slope = at_first / (at_third - at_first) * at_second / (at_third - at_second)
            curved += (third - first) / (second - first) * slope
        found = (least > 0.5) | (at_first == 0.0) | (at_second == 0.0) | (width == 0.0)
        if found.all():
            break
        part = np.where((up**2 < along) & ((1.0 - up) ** 2 < 1.0 - along), curved, 0.5)
        part = np.clip(part, np.minimum(least, 0.5), np.maximum(1.0 - least, 0.5))
        part[found] = 0.0  # what is found stays, whatever rows are beside it
    return best


@dataclass(frozen=True, slots=True)
class Quadrilaterals:
    """Circumradii, or cone angles in [0, pi/2), float[...], of open and crossed four-bars; or nan.

    Links, float[..., 4], are lengths, or angles (`angular`).
    """

    open: Floats
    crossed: Floats
    links: Floats
    angular: bool

    @property
    def ill_conditioned(self) -> Flags:
        """Whether links with signs, or angles less a turn, sum to zero within rounding, which decides."""
        turn = 2.0 * np.pi * np.eye(8)[0] if self.angular else np.zeros(8)  # the first pattern is that of all +
        sums = self.links @ sign_patterns(4).T - turn
        return np.asarray((np.abs(sums) <= rounding_of(self.links)[..., np.newaxis]).any(axis=-1))


def _sides(values: npt.ArrayLike) -> tuple[Floats, Floats, Floats, Floats]:
    a, b, c, d = np.moveaxis(np.asarray(values, dtype=float), -1, 0)
    return a, b, c, d


def _numerator(a: Floats, b: Floats, c: Floats, d: Floats, mu: int) -> Floats:
    """Return (ab + mu cd)(ac + mu bd)(bc + mu ad), the numerator of Eq. 12."""
    return np.asarray((a * b + mu * c * d) * (a * c + mu * b * d) * (b * c + mu * a * d))


def _sixteen_area_squared(a: Floats, b: Floats, c: Floats, d: Floats, mu: int) -> Floats:
    """Return 16 K^2, the product of the sums of sides with one subtracted (Brahmagupta; Eq. 11)."""
    d = mu * d
    return np.asarray((b + c + d - a) * (a + c + d - b) * (a + b + d - c) * (a + b + c - d))


def circumradii(sides: npt.ArrayLike) -> Quadrilaterals:
    """Return the circles of planar quadrilaterals (Hyatt et al. 2021, Eq. 12; Eqs. 4 and 5).

    Eq. 12 with mu = -1 also gives real radii where numerator and denominator are both negative; no quadrilateral
    has them. Where both vanish (two pairs of equal sides) there are infinitely many crossed circles: nan.

    Parameters
    ----------
    sides : float[..., 4]
        Positive lengths; their order does not matter.

    Examples
    --------
    >>> circles = circumradii([4, 3, 5, 1])
    >>> float(circles.open.round(4)), float(circles.crossed.round(4))
    (2.5361, 2.5909)
    """
    lengths = np.asarray(sides, dtype=float)
    a, b, c, d = _sides(lengths)
    radii = []
    for mu in (1, -1):
        numerator, denominator = _numerator(a, b, c, d, mu), _sixteen_area_squared(a, b, c, d, mu)
        with np.errstate(invalid="ignore", divide="ignore"):
            there = (numerator > 0) & (denominator > 0)
            radii.append(np.where(there, np.sqrt(numerator / denominator), np.nan))
    return Quadrilaterals(radii[0], radii[1], lengths, angular=False)


def cone_angles(angles: npt.ArrayLike) -> Quadrilaterals:
    """Return the cones on which spherical four-bars lie (Hyatt et al. 2021, Eqs. 12 to 14).

    lambda = 0 where a crossed linkage folds flat; nan where two pairs of angles are equal and there are infinitely
    many crossed cones.

    Parameters
    ----------
    angles : float[..., 4]
        Link angles, radians, between 0 and pi; their order does not matter.

    Examples
    --------
    >>> cones = cone_angles(np.radians([120, 95, 45, 85]))  # Hyatt et al. 2020, Fig. 10(a)
    >>> float(np.degrees(cones.open).round(3)), float(np.degrees(cones.crossed).round(3))
    (13.998, 29.044)
    """
    links = np.asarray(angles, dtype=float)
    half = [angle / 2.0 for angle in _sides(links)]
    x, y, z, w = half
    chords = [2.0 * np.sin(angle) for angle in half]
    middle = (x + y + z + w) / 2.0
    pairs = [(x + y - z - w) / 2.0, (x + z - y - w) / 2.0, (y + z - x - w) / 2.0]
    less = [middle - angle for angle in half]
    # 16 K^2 (1 - R^2) / 256 as products of half angles, which near lambda = 0 lose no digits, as a cosine would
    convex: Any = np.cos(middle)
    crossed: Any = np.sin(middle)
    for angle in less:
        convex, crossed = convex * np.sin(angle), crossed * np.cos(angle)
    for angle in pairs:
        convex, crossed = convex * np.cos(angle), crossed * np.sin(angle)
    cones = []
    for mu, product in ((1, convex), (-1, crossed)):
        numerator = _numerator(chords[0], chords[1], chords[2], chords[3], mu)
        with np.errstate(invalid="ignore", divide="ignore"):
            there = (numerator > 0) & (product >= 0)
            cones.append(np.where(there, np.arctan(np.sqrt(256.0 * product / numerator)), np.nan))
    return Quadrilaterals(cones[0], cones[1], links, angular=True)


def crossed_area(sides: npt.ArrayLike) -> Floats:
    """Return the area, float[...], of crossed cyclic quadrilaterals with sides float[..., 4] (Eq. 11); or nan.

    Triangles of opposite sense are subtracted.
    """
    with np.errstate(invalid="ignore"):
        return np.asarray(np.sqrt(_sixteen_area_squared(*_sides(sides), -1)) / 4.0)
