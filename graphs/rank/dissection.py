"""The rank of large sparse matrices: nested dissection with singular values.

The rows are halved by place again and again. From the smallest parts up, the columns that only a part's rows have
are taken out: combinations with large singular values are pivots, those that are noise are freedoms, the rest is
handed up. Each candidate is continued to a vector of all columns, so that its singular value is that of the whole
matrix. It is multifrontal QR with delayed pivots (Davis 2011), two-sided; how many values are small is counted a
second time, by the inertia of the normal equations. Theory: docs/theory/pose.md.

Modulo a prime the same is exact, and simpler: in the columns that only a part's rows have, each pivot is one of the
rank, and the rows without one are handed up. Theory: docs/theory/exact-mobility.md.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import scipy

from graphs.errors import UnsolvableError
from graphs.rank.singular_values import ZERO_SPECTRUM, Spectrum, judged, rounding, verdict
from graphs.types import Flags, Floats, Ints

_LEAF = 192
"""Rows of a part that is not halved."""
_PIVOT = 0.03
"""A combination of columns is taken out if its singular value is at least this part of the largest."""
_CHECKED = (1e-6, 1e-2)
"""The number of singular values is counted a second time below some part of the largest between these."""


def sparse_spectrum(matrix: scipy.sparse.csr_matrix, places: Floats, error: Floats, nearly: Floats) -> Spectrum:
    """Return the numerical rank of a large sparse matrix; indeterminate where two counts of small values differ.

    Places, float[m, d], say where each row is; rows that share columns are close. Error and nearly, float[n], are
    as for :func:`~graphs.rank.singular_values.spectrum`.
    """
    if not matrix.nnz:
        return ZERO_SPECTRUM
    state = _Elimination(matrix.tocsr(), places, error, nearly)
    state.eliminate(np.arange(matrix.shape[0]), top=True)
    values, floors, near = (np.concatenate(found) for found in zip(*state.found, strict=True))
    found = judged(values, floors, near, state.pivots)
    part = _widest_gap(values)
    unused = np.flatnonzero(state.rows_of == 0)
    order = np.concatenate([*state.order, unused])
    agree = number_below(matrix[:, order], part * state.largest, ordered=True) == (values < part).sum() + len(unused)
    return found if agree else replace(found, rank=None)


def number_below(matrix: scipy.sparse.csr_matrix, bound: float, *, ordered: bool = False) -> int:
    """Return how many singular values are below a bound, of as many as there are columns, by Sylvester's inertia.

    The bound is well above the root of the rounding error, 1e-8 of the largest singular value. Where the columns
    are `ordered`, they are eliminated as they stand.
    """
    from scipy.sparse.linalg import splu  # slow to load

    normal = (matrix.T @ matrix - bound**2 * scipy.sparse.identity(matrix.shape[1])).tocsc()
    order = "NATURAL" if ordered else "MMD_AT_PLUS_A"
    factors = splu(normal, permc_spec=order, diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    return int((factors.U.diagonal() < 0).sum())


def _widest_gap(values: Floats) -> float:
    """Return a bound in the widest gap between small values, where squares are still precise."""
    low, high = _CHECKED
    inside = np.sort(np.log([low, high, *values[(values > low) & (values < high)]]))
    widest = int(np.argmax(np.diff(inside)))
    return float(np.exp((inside[widest] + inside[widest + 1]) / 2))


@dataclass(frozen=True, slots=True)
class _Part:
    """What is left of some rows: a dense block, its columns, how many of the rows each of these is in.

    Values at the columns determine those at the columns that were taken out; the sums of their squares, with the
    weights of the elimination, are forms of these values, float[3, columns, columns].
    """

    block: Floats
    columns: Ints
    seen: Ints
    squares: Floats


@dataclass
class _Elimination:
    """The state of one elimination. Columns are those of the matrix, then those that were handed up.

    `pivots` counts the large singular values, `found` holds the values, floors and nearly of the others, `order`
    the columns of the matrix as they were taken out.
    """

    matrix: scipy.sparse.csr_matrix
    places: Floats
    error: Floats
    nearly: Floats
    pivots: int = 0
    found: list[tuple[Floats, Floats, Floats]] = field(default_factory=list)
    order: list[Ints] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.largest = _norm(self.matrix)
        self.columns = self.matrix.shape[1]
        self.rows_of = np.bincount(self.matrix.indices, minlength=self.columns)
        self.named = self.columns
        self._weights = np.array([np.ones(self.columns), self.error**2, self.nearly**2])

    def eliminate(self, rows: Ints, *, top: bool = False) -> _Part:
        """Take out the columns that only these rows have; return what is left."""
        part = self._assembled(rows)
        own = part.columns >= self.columns  # columns that were handed up are in no other part
        own[~own] = part.seen[~own] == self.rows_of[part.columns[~own]]
        taken, rest = part.columns[own], part.columns[~own]
        of_matrix = taken < self.columns
        self.order.append(taken[of_matrix])
        # QR first, where that makes the block lower: singular values and right singular vectors stay the same.
        triangle = part.block[part.block.any(axis=1)]
        if len(triangle) > len(part.columns):
            (whole,) = scipy.linalg.qr(triangle, mode="r", check_finite=False, overwrite_a=True)
            triangle = whole[: len(part.columns)]
        left, values, right = np.linalg.svd(triangle[:, own], full_matrices=True)
        # Combinations of own columns with large values are pivots: their rows determine them by the other columns.
        large = int((values >= _PIVOT * self.largest).sum())
        self.pivots += large
        smaller = np.zeros(len(taken) - large)
        smaller[: len(values) - large] = values[large:]
        squares, combinations = part.squares, right[large:].T
        within = squares[:, own][:, :, own]
        diagonal = np.einsum("kii->ki", within)
        diagonal[:, of_matrix] += self._weights[:, taken[of_matrix]]
        # The others are noise, and recorded, or too large for noise, and handed up under new column numbers.
        handed = self._judge(smaller, ((within @ combinations) * combinations).sum(axis=1), top=top)
        names = np.arange(self.named, self.named + int(handed.sum()))
        self.named += len(names)
        determined = -right[:large].T @ ((left[:, :large].T @ triangle[:, ~own]) / values[:large, None])
        back = np.hstack([combinations[:, handed], determined])
        crossing, beside = back.T @ squares[:, own][:, :, ~own], squares[:, ~own][:, :, ~own]
        squares = back.T @ within @ back
        squares[:, :, len(names) :] += crossing
        squares[:, len(names) :, :] += crossing.transpose(0, 2, 1)
        squares[:, len(names) :, len(names) :] += beside
        below = left[:, large:].T
        kept = np.zeros((len(below), len(names)))
        kept[np.flatnonzero(handed), np.arange(len(names))] = smaller[handed]
        block = np.hstack([kept, below @ triangle[:, ~own]])
        seen = np.concatenate([np.zeros(len(names), dtype=np.int64), part.seen[~own]])
        return _Part(block, np.concatenate([names, rest]), seen, squares)

    def _assembled(self, rows: Ints) -> _Part:
        """Return a part as a dense block: a leaf of the matrix, or what is left of two halves."""
        if len(rows) <= _LEAF:
            leaf = self.matrix[rows]
            columns, places, seen = np.unique(leaf.indices, return_inverse=True, return_counts=True)
            block = np.zeros((len(rows), len(columns)))
            block[np.repeat(np.arange(len(rows)), np.diff(leaf.indptr)), places] = leaf.data
            return _Part(block, columns, seen, np.zeros((3, len(columns), len(columns))))
        spread = np.ptp(self.places[rows], axis=0)
        order = rows[np.argsort(self.places[rows, int(np.argmax(spread))], kind="stable")]
        halves = [self.eliminate(half) for half in np.array_split(order, 2)]
        columns = np.unique(np.concatenate([half.columns for half in halves]))
        block = np.zeros((sum(len(half.block) for half in halves), len(columns)))
        seen, squares = np.zeros(len(columns), dtype=np.int64), np.zeros((3, len(columns), len(columns)))
        start = 0
        for half in halves:
            at = np.searchsorted(columns, half.columns)
            block[start : start + len(half.block), at] = half.block
            seen[at] += half.seen
            squares[:, at[:, None], at] += half.squares
            start += len(half.block)
        return _Part(block, columns, seen, squares)

    def _judge(self, values: Floats, squares: Floats, *, top: bool) -> Flags:
        """Record the combinations that are noise, at the top all; return which are handed up.

        Each is continued to a vector of all columns, whose sums of squares are float[3, combinations].
        """
        sizes, errors, near = np.sqrt(np.maximum(squares, 0.0))
        scale = sizes * self.largest
        parts, floors = values / scale, rounding(self.matrix.shape) + errors / scale
        done = np.ones(len(values), dtype=bool) if top else verdict(parts, floors).noise
        self.found.append((parts[done], floors[done], near[done] / scale[done]))
        return np.asarray(~done)


def _norm(matrix: scipy.sparse.csr_matrix) -> float:
    """Return the largest singular value, by power iteration to a few figures."""
    vector = np.random.default_rng(0).normal(size=matrix.shape[1])
    size = 0.0
    for _ in range(30):
        vector = matrix.T @ (matrix @ vector)
        size = float(np.linalg.norm(vector))
        vector /= size
    return float(np.sqrt(size))


def rank_modulo(rows: Sequence[Mapping[int, int]], columns: int, prime: int) -> int:
    """Return the rank modulo a prime of a sparse matrix by its rows, which map columns to their nonzeros."""
    if len(rows) <= _WHOLE:
        return int(sparse_modulo(rows, columns, prime).rank())
    filled = [row for row in rows if row]
    elimination = _ExactElimination(filled, prime)
    if filled:
        elimination.eliminate(np.arange(len(filled)), _places_of_rows(filled, columns))
    return elimination.rank


def sparse_modulo(rows: Sequence[Mapping[int, int]], columns: int, prime: int) -> Any:
    """Return a matrix by its nonzeros modulo a prime: to set them in an empty one is the fast way."""
    matrix = matrices()(max(len(rows), 1), max(columns, 1), prime)
    for i, row in enumerate(rows):
        for j, value in row.items():
            matrix[i, j] = value
    return matrix


def matrices() -> type[Any]:
    """Return the class of matrices modulo a prime, loaded when a rank is asked for: motions do without it."""
    try:
        from flint import nmod_mat
    except ImportError:
        raise UnsolvableError("exact ranks require python-flint; try pip install python-flint") from None
    return nmod_mat


_WHOLE = 250
"""Rows of a matrix modulo a prime that is not taken apart."""
_EXACT_LEAF = 64
"""Rows of a part that is not halved, of a matrix modulo a prime."""


class _ExactElimination:
    """The state of an elimination modulo a prime; `rank` counts the pivots so far."""

    def __init__(self, rows: Sequence[Mapping[int, int]], prime: int) -> None:
        self.rows, self.prime, self.rank = rows, prime, 0
        self.rows_of = Counter(column for row in rows for column in row)

    def eliminate(self, numbers: Ints, places: Floats) -> tuple[list[int], list[list[int]], Counter[int]]:
        """Take out the columns that only these rows have; return the others, what is left of the rows, and counts.

        The counts say in how many of these rows a column is.
        """
        columns, block, seen = self._assembled(numbers, places)
        own = [column for column in columns if seen[column] == self.rows_of[column]]
        rest = [column for column in columns if seen[column] != self.rows_of[column]]
        at = {column: place for place, column in enumerate(columns)}
        order = [at[column] for column in (*own, *rest)]
        entries = [row[place] for row in block for place in order]
        reduced, rank = matrices()(len(block), len(columns), entries, self.prime).rref()
        values = [int(value) for value in reduced.entries()]
        width = len(columns)
        lines = [values[start : start + width] for start in range(0, rank * width, width)]
        pivots = sum(any(line[: len(own)]) for line in lines)
        self.rank += pivots
        return rest, [line[len(own) :] for line in lines[pivots:]], seen

    def _assembled(self, numbers: Ints, places: Floats) -> tuple[list[int], list[list[int]], Counter[int]]:
        """Return the columns of some rows and the rows as a full matrix: a leaf, or what is left of two halves."""
        if len(numbers) <= _EXACT_LEAF:
            rows = [self.rows[number] for number in numbers.tolist()]
            seen = Counter(column for row in rows for column in row)
            columns = sorted(seen)
            return columns, [[row.get(column, 0) for column in columns] for row in rows], seen
        spread = np.ptp(places[numbers], axis=0)
        order = numbers[np.argsort(places[numbers, int(np.argmax(spread))], kind="stable")]
        halves = [self.eliminate(half, places) for half in np.array_split(order, 2)]
        columns = sorted({column for half in halves for column in half[0]})
        at = {column: place for place, column in enumerate(columns)}
        block = []
        for of_half, lines, _ in halves:
            to = [at[column] for column in of_half]
            for line in lines:
                block.append([0] * len(columns))
                for place, value in zip(to, line, strict=True):
                    block[-1][place] = value
        return columns, block, halves[0][2] + halves[1][2]


def _places_of_rows(rows: Sequence[Mapping[int, int]], columns: int) -> Floats:
    """Return places of rows such that those that share columns are close, float[m, 2], by steps from one to the next.

    These are differences of the steps to two rows far apart, and to two more that are far from both.
    """
    sizes = [len(row) for row in rows]
    indices = np.fromiter((column for row in rows for column in row), dtype=np.int64, count=sum(sizes))
    pattern = scipy.sparse.csr_matrix(
        (np.ones(len(indices)), indices, np.cumsum([0, *sizes])), shape=(len(rows), columns)
    )
    beside = (pattern @ pattern.T).tocsr()

    def steps(start: int) -> Floats:
        found = scipy.sparse.csgraph.dijkstra(beside, indices=start, unweighted=True)
        return np.where(np.isfinite(found), found, len(rows))

    one = steps(int(steps(0).argmax()))
    other = steps(int(one.argmax()))
    third = steps(int(np.minimum(one, other).argmax()))
    last = steps(int(np.minimum(np.minimum(one, other), third).argmax()))
    return np.stack([one - other, third - last], axis=1)
