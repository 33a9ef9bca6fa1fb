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
from graphs.rank.singular_values import NOISE, ZERO_SPECTRUM, Spectrum, judged, rounding, verdict
from graphs.types import Flags, Floats, Ints

_LEAF = 192
"""Rows of a part that is not halved. Speed alone depends on it: dense factors of a few hundred rows are quick."""
_PIVOT = 0.03
"""A combination of columns is taken out if its singular value is at least this part of the largest: far above noise, so
that dividing by it makes noise larger by a factor of 33 at most; lower, errors grow, higher, less is taken out."""
_CHECKED = (1e-6, 1e-2)
"""The number of singular values is counted a second time below some part of the largest between these: squares of what
is above the first are 1e-12 or more, which rounding of the squared matrix, 1e-16, leaves alone."""


def sparse_spectrum(matrix: scipy.sparse.csr_matrix, places: Floats, error: Floats, nearly: Floats) -> Spectrum:
    """Return the numerical rank of a large sparse matrix; indeterminate where two counts of small values differ.

    Places, float[m, d], say where each row is; rows that share columns are close. Error and nearly, float[n], are
    as for :func:`~graphs.rank.singular_values.spectrum`.
    """
    if not matrix.nnz:
        return ZERO_SPECTRUM
    state = _Elimination(matrix.tocsr(), places, error)
    state.eliminate(np.arange(matrix.shape[0]), top=True)
    values, floors = (np.concatenate(found) for found in zip(*state.found, strict=True))
    found = judged(values, floors, np.zeros(len(values)), state.pivots)
    part = _widest_gap(values)
    unused = np.flatnonzero(state.rows_of == 0)
    order = np.concatenate([*state.order, unused])
    matrix = matrix[:, order]
    agree = number_below(matrix, part * state.largest, ordered=True) == (values < part).sum() + len(unused)
    judged_zero = verdict(values, floors)
    zeros = int((judged_zero.noise | judged_zero.undecided).sum()) + len(unused)
    near = _number_nearly(matrix, nearly[order]) - zeros
    return replace(found, rank=found.rank if agree else None, nearly=max(near, 0))


def _number_nearly(matrix: scipy.sparse.csr_matrix, nearly: Floats) -> int:
    """Return how many independent combinations of columns such errors would make zero, zero ones among them.

    They are counted in columns that are divided by their errors, since a part of the elimination does not know them:
    what is large in its rows may be small in all.
    """
    if not nearly.all():
        return 0
    return number_below(matrix @ scipy.sparse.diags(1.0 / nearly), NOISE, ordered=True)


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
    weights of the elimination, are forms of these values, float[2, columns, columns].
    """

    block: Floats
    columns: Ints
    seen: Ints
    squares: Floats


@dataclass
class _Elimination:
    """The state of one elimination. Columns are those of the matrix, then those that were handed up.

    `pivots` counts the large singular values, `found` holds the values and floors of the others, `order`
    the columns of the matrix as they were taken out.
    """

    matrix: scipy.sparse.csr_matrix
    places: Floats
    error: Floats
    pivots: int = 0
    found: list[tuple[Floats, Floats]] = field(default_factory=list)
    order: list[Ints] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.largest = _norm(self.matrix)
        self.columns = self.matrix.shape[1]
        self.rows_of = np.bincount(self.matrix.indices, minlength=self.columns)
        self.named = self.columns
        self._weights = np.array([np.ones(self.columns), self.error**2])

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
            return _Part(block, columns, seen, np.zeros((2, len(columns), len(columns))))
        spread = np.ptp(self.places[rows], axis=0)
        order = rows[np.argsort(self.places[rows, int(np.argmax(spread))], kind="stable")]
        halves = [self.eliminate(half) for half in np.array_split(order, 2)]
        columns = np.unique(np.concatenate([half.columns for half in halves]))
        block = np.zeros((sum(len(half.block) for half in halves), len(columns)))
        seen, squares = np.zeros(len(columns), dtype=np.int64), np.zeros((2, len(columns), len(columns)))
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

        Each is continued to a vector of all columns, whose sums of squares are float[2, combinations].
        """
        sizes, errors = np.sqrt(np.maximum(squares, 0.0))
        scale = sizes * self.largest
        parts, floors = values / scale, rounding(self.matrix.shape) + errors / scale
        done = np.ones(len(values), dtype=bool) if top else verdict(parts, floors).noise
        self.found.append((parts[done], floors[done]))
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
"""Rows of a matrix modulo a prime that is not taken apart. Ranks do not depend on it, only speed."""
_EXACT_LEAF = 64
"""Rows of a part that is not halved, of a matrix modulo a prime. Ranks do not depend on it, only speed."""


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
        halves = [self.eliminate(half, places) for half in _halves(numbers, places)]
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


@dataclass(slots=True)
class _Front:
    """What a part of an exact elimination leaves. Its lines have the numbers of the rows they stand for.

    `pivots` are lines that are independent on the `own` columns, the first of `columns`; `solved` is their reduced
    form, nmod[pivots, columns], with a one at each of the places `ones`. Lines that are `handed` up were freed of the
    own columns by `shares` of the pivots, nmod[pivots, handed], and are `left` on the other columns.
    """

    parts: tuple[_Front, ...]
    columns: list[int]
    own: int
    pivots: list[int]
    solved: Any
    ones: list[int]
    handed: list[int]
    shares: Any
    left: Any
    seen: Counter[int]


class KernelsModulo:
    """What solves a large sparse matrix modulo a prime, and which of its rows depend on each other.

    The elimination is that of `rank_modulo`, with what each part did kept. A line that is handed up stands for the row
    in it that was not used up. So dependent lines that a part finds are followed down into the parts it was made of,
    each of which adds the pivots that the lines contain. Most are found in small parts, and are few rows.

    Attributes
    ----------
    rank : int
    circuits : list of list of int
        Smallest dependent sets of rows, as many as there are rows too many; the first row of each is in none after it.
    """

    def __init__(self, rows: Sequence[Mapping[int, int]], columns: int, prime: int) -> None:
        self._rows, self._columns, self._prime = rows, columns, prime
        self._rows_of = Counter(column for row in rows for column in row)
        self._fronts: list[_Front] = []
        self.circuits = [[number] for number, row in enumerate(rows) if not row]
        filled = np.array([number for number, row in enumerate(rows) if row], dtype=np.int64)
        if len(filled):
            places = np.zeros((len(rows), 2))
            places[filled] = _places_of_rows([rows[number] for number in filled.tolist()], columns)
            self._eliminate(filled, places)
        self.rank = sum(len(front.pivots) for front in self._fronts)

    def general_solution(self, seed: int = 0) -> list[int]:
        """Return random numbers, one for each column, that the matrix maps to zero.

        A number is zero where it is so in all solutions; elsewhere with a probability of one over the prime.
        """
        values = np.random.default_rng(seed).integers(0, self._prime, self._columns).astype(object)
        for front in reversed(self._fronts):  # the other columns of a part are those of parts above it
            pivots = np.array(front.columns)[front.ones]
            values[pivots] = 0
            if len(pivots):
                values[pivots] = _entries(-(front.solved * self._matrix(values[front.columns][:, None])))[:, 0]
        return [int(value) for value in values]

    def _eliminate(self, numbers: Ints, places: Floats) -> _Front:
        """Take out the columns that only these rows have; add the dependent sets that this shows."""
        parts, names, columns, block, seen = self._assembled(numbers, places)
        mine = np.array([seen[column] == self._rows_of[column] for column in columns.tolist()], dtype=bool)
        own = int(mine.sum())
        block = np.concatenate([block[:, mine], block[:, ~mine]], axis=1)
        pivots, others, shares = self._independent(block[:, :own])
        solved = self._matrix(block[pivots]).rref()[0]
        taken = self._matrix(shares).transpose() * self._matrix(block[pivots][:, own:])
        left = _entries(self._matrix(block[others][:, own:]) - taken)
        kept, idle, sums = self._independent(left)
        front = _Front(
            parts=parts,
            columns=[*columns[mine].tolist(), *columns[~mine].tolist()],
            own=own,
            pivots=names[pivots].tolist(),
            solved=solved,
            ones=[int(np.argmax(line)) for line in _entries(solved) != 0],
            handed=names[others][kept].tolist(),
            shares=self._matrix(shares[:, kept]),
            left=left[kept],
            seen=seen,
        )
        self._fronts.append(front)
        for part in parts:  # what was handed up is in the block
            part.left, part.seen = None, Counter()
        if idle:
            sets = np.arange(len(self.circuits), len(self.circuits) + len(idle))
            self.circuits += [[row] for row in names[others][idle].tolist()]
            self._list(sets, front.handed, -sums)
            weights = np.concatenate([-sums % self._prime, np.eye(len(idle), dtype=np.int64).astype(object)])
            both = self._matrix(shares[:, [*kept, *idle]])
            self._descend(sets, front, [*front.handed, *names[others][idle].tolist()], both, weights)
        return front

    def _descend(self, sets: Ints, front: _Front, lines: Sequence[int], shares: Any, weights: Any) -> None:
        """Add to sets the rows that some lines of a part contain below, by the weights of lines: [lines, sets]."""
        pivots = _entries(-(shares * self._matrix(weights)))
        self._list(sets, front.pivots, pivots)
        weight_of = dict(zip([*lines, *front.pivots], [*weights, *pivots], strict=True))
        none = np.zeros(len(sets), dtype=object)  # of lines that followed from others here, and went no further up
        for part in front.parts:
            if not part.handed:
                continue
            below = np.array([weight_of.get(line, none) for line in part.handed], dtype=object)
            there = (below != 0).any(axis=0)
            if there.any():
                self._descend(sets[there], part, part.handed, part.shares, below[:, there])

    def _list(self, sets: Ints, rows: Sequence[int], weights: Any) -> None:
        """Add to sets the rows whose weight there, [rows, sets], is not zero."""
        for row, place in np.argwhere(weights != 0).tolist():
            self.circuits[sets[place]].append(rows[row])

    def _independent(self, lines: Any) -> tuple[list[int], list[int], Any]:
        """Return the first independent lines, the others, and the shares of the first in these, [first, others]."""
        reduced, rank = self._matrix(lines).transpose().rref()
        table = _entries(reduced)[:rank]
        first = [int(np.argmax(line)) for line in table != 0]
        others = [line for line in range(len(lines)) if line not in set(first)]
        return first, others, table[:, others]

    def _assembled(self, numbers: Ints, places: Floats) -> tuple[tuple[_Front, ...], Ints, Ints, Any, Counter[int]]:
        """Return the parts of some rows, the lines and columns, the lines in full, and in how many rows columns are."""
        if len(numbers) <= _EXACT_LEAF:
            rows = [self._rows[number] for number in numbers.tolist()]
            seen = Counter(column for row in rows for column in row)
            columns = np.array(sorted(seen), dtype=np.int64)
            leaf = np.array([[row.get(column, 0) for column in columns.tolist()] for row in rows], dtype=object)
            return (), numbers, columns, leaf, seen
        parts = tuple(self._eliminate(half, places) for half in _halves(numbers, places))
        beside = [np.array(part.columns[part.own :], dtype=np.int64) for part in parts]
        columns = np.unique(np.concatenate(beside))
        names = np.array([line for part in parts for line in part.handed], dtype=np.int64)
        block = np.zeros((len(names), len(columns)), dtype=object)
        start = 0
        for part, of_part in zip(parts, beside, strict=True):
            block[start : start + len(part.handed), np.searchsorted(columns, of_part)] = part.left
            start += len(part.handed)
        return parts, names, columns, block, parts[0].seen + parts[1].seen

    def _matrix(self, lines: Any) -> Any:
        """Return lines, numbers [m, n], as a matrix modulo the prime."""
        return matrices()(*lines.shape, lines.ravel().tolist(), self._prime)


def _entries(matrix: Any) -> Any:
    """Return a matrix modulo a prime as numbers of any size: object[m, n]."""
    values = np.array([int(value) for value in matrix.entries()], dtype=object)
    return values.reshape(matrix.nrows(), matrix.ncols())


def _halves(numbers: Ints, places: Floats) -> list[Ints]:
    """Return rows by halves, those on either side of the middle of the direction in which they spread most."""
    spread = np.ptp(places[numbers], axis=0)
    return np.array_split(numbers[np.argsort(places[numbers, int(np.argmax(spread))], kind="stable")], 2)


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
