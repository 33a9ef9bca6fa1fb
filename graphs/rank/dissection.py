"""The rank of large sparse matrices: nested dissection with singular values.

The rows are halved by place again and again. From the smallest parts up, the columns that only a part's rows have
are taken out: combinations with large singular values are pivots, those that are noise are freedoms, the rest is
handed up. Each candidate is continued to a vector of all columns, so that its singular value is that of the whole
matrix. It is multifrontal QR with delayed pivots (Davis 2011), two-sided; how many values are small is counted a
second time, by the inertia of the normal equations. Theory: docs/theory/pose.md.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
import scipy

from graphs.rank.singular_values import ZERO_SPECTRUM, Spectrum, judged, rounding, verdict
from graphs.types import Flags, Floats, Ints

_LEAF = 96
"""Rows of a part that is not halved."""
_PIVOT = 0.03
"""A combination of columns is taken out if its singular value is at least this part of the largest."""
_CHECKED = (1e-5, 1e-2)
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
    unused = int((state.rows_of == 0).sum())
    agree = number_below(matrix, part * state.largest) == int((values < part).sum()) + unused
    return found if agree else replace(found, rank=None)


def number_below(matrix: scipy.sparse.csr_matrix, bound: float) -> int:
    """Return how many singular values are below a bound, of as many as there are columns, by Sylvester's inertia.

    The bound is well above the root of the rounding error, 1e-8 of the largest singular value.
    """
    from scipy.sparse.linalg import splu  # slow to load

    normal = (matrix.T @ matrix - bound**2 * scipy.sparse.identity(matrix.shape[1])).tocsc()
    factors = splu(normal, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    return int((factors.U.diagonal() < 0).sum())


def _widest_gap(values: Floats) -> float:
    """Return a bound in the widest gap between small values, where squares are still precise."""
    low, high = _CHECKED
    inside = np.sort(np.log([low, high, *values[(values > low) & (values < high)]]))
    widest = int(np.argmax(np.diff(inside)))
    return float(np.exp((inside[widest] + inside[widest + 1]) / 2))


@dataclass
class _Step:
    """How the columns that were taken out follow from those that were left, in one part and the parts in it."""

    columns: Ints
    pivots: Floats
    from_rest: Floats
    rest: Ints
    handed: Floats
    names: Ints
    inner: tuple[_Step, ...]

    def continue_to(self, vectors: Floats) -> None:
        """Fill in the rows of the columns that were taken out, from those that were left: float[columns, k]."""
        out = self.pivots @ (self.from_rest @ vectors[self.rest]) + self.handed @ vectors[self.names]
        vectors[self.columns] = out
        for step in self.inner:
            step.continue_to(vectors)


@dataclass
class _Elimination:
    """The state of one elimination. Columns are those of the matrix, then those that were handed up.

    `pivots` counts the large singular values, `found` holds the values, floors and nearly of the others.
    """

    matrix: scipy.sparse.csr_matrix
    places: Floats
    error: Floats
    nearly: Floats
    pivots: int = 0
    found: list[tuple[Floats, Floats, Floats]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.largest = _norm(self.matrix)
        self.rows_of = np.bincount(self.matrix.indices, minlength=self.matrix.shape[1])
        self.named = self.matrix.shape[1]

    def eliminate(self, rows: Ints, *, top: bool = False) -> tuple[Floats, Ints, _Step]:
        """Take out the columns that only these rows have; return what is left, its columns, and how to go back."""
        block, columns, inner = self._assembled(rows)
        own = self._own(rows, columns)
        taken, rest = columns[own], columns[~own]
        # QR first, where that makes the block lower: singular values and right singular vectors stay the same.
        triangle = block[block.any(axis=1)]
        if len(triangle) > len(columns):
            (whole,) = scipy.linalg.qr(triangle, mode="r", check_finite=False, overwrite_a=True)
            triangle = whole[: len(columns)]
        left, values, right = np.linalg.svd(triangle[:, own], full_matrices=True)
        # Combinations of own columns with large values are pivots: their rows determine them by the other columns.
        large = int((values >= _PIVOT * self.largest).sum())
        self.pivots += large
        step = _Step(
            taken,
            right[:large].T,
            -(left[:, :large].T @ triangle[:, ~own]) / values[:large, None],
            rest,
            np.zeros((len(taken), 0)),
            np.zeros(0, dtype=np.int64),
            inner,
        )
        smaller = np.zeros(len(taken) - large)
        smaller[: len(values) - large] = values[large:]
        # The others are noise, and recorded, or too large for noise, and handed up under new column numbers.
        handed = self._judge(smaller, right[large:].T, step, top=top)
        step.handed = right[large:].T[:, handed]
        step.names = np.arange(self.named, self.named + int(handed.sum()))
        self.named += len(step.names)
        below = left[:, large:].T
        kept = np.zeros((len(below), len(step.names)))
        for column, position in enumerate(np.flatnonzero(handed)):
            kept[position, column] = smaller[position]
        return np.hstack([kept, below @ triangle[:, ~own]]), np.concatenate([step.names, rest]), step

    def _assembled(self, rows: Ints) -> tuple[Floats, Ints, tuple[_Step, ...]]:
        """Return a part as a dense block: a leaf of the matrix, or what is left of two halves."""
        if len(rows) <= _LEAF:
            part = self.matrix[rows]
            columns = np.unique(part.indices)
            return np.asarray(part[:, columns].todense()), columns, ()
        spread = np.ptp(self.places[rows], axis=0)
        order = rows[np.argsort(self.places[rows, int(np.argmax(spread))], kind="stable")]
        halves = [self.eliminate(half) for half in np.array_split(order, 2)]
        columns = np.unique(np.concatenate([names for _, names, _ in halves]))
        block = np.zeros((sum(len(part) for part, _, _ in halves), len(columns)))
        start = 0
        for part, names, _ in halves:
            block[start : start + len(part), np.searchsorted(columns, names)] = part
            start += len(part)
        return block, columns, tuple(step for _, _, step in halves)

    def _own(self, rows: Ints, columns: Ints) -> Flags:
        """Return which columns no other row has."""
        count = self.matrix.shape[1]
        here = np.bincount(self.matrix[rows].indices, minlength=count)
        matrix_columns = columns < count
        own = ~matrix_columns
        own[matrix_columns] = here[columns[matrix_columns]] == self.rows_of[columns[matrix_columns]]
        return np.asarray(own)

    def _judge(self, values: Floats, combinations: Floats, step: _Step, *, top: bool) -> Flags:
        """Record the combinations that are noise, at the top all; return which are handed up."""
        vectors = np.zeros((self.named, combinations.shape[1]))
        vectors[step.columns] = combinations
        for inner in step.inner:
            inner.continue_to(vectors)
        vectors = vectors[: self.matrix.shape[1]]
        sizes = np.linalg.norm(vectors, axis=0)
        parts = values / sizes / self.largest
        floors = rounding(self.matrix.shape) + np.linalg.norm(vectors * self.error[:, None], axis=0) / (
            sizes * self.largest
        )
        near = np.linalg.norm(vectors * self.nearly[:, None], axis=0) / (sizes * self.largest)
        done = np.ones(len(values), dtype=bool) if top else verdict(parts, floors).noise
        self.found.append((parts[done], floors[done], near[done]))
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
