"""What follows from orders that are known, by transitivity in all cells and by creases that do not interleave.

Each newly known order of two panels over a cell is compared with those of both to every third panel there.
"""

import numpy as np

from graphs.types import Ints, Signs
from synth.layering.constraints import PairTable
from synth.layering.counting.kernel import ProblemInLibrary, kernel, settled_in_library
from synth.layering.counting.problem import UNKNOWN, LayerProblem, count_in_python, probe_in_python


def settled(table: PairTable, rows: Ints, classes: int, parities: Ints) -> Signs | None:
    """Return the values of classes that follow from that of class 0, which is true; None if they contradict.

    `rows` has the literal of each row of the table. -1 stands for what is left open.
    """
    values = np.full(classes, UNKNOWN, dtype=np.int8)
    values[0] = 1
    found = kernel()
    if found is not None:
        good, _ = settled_in_library(found, table.sizes, table.first, rows, parities, values)
    else:
        good = _settled(table, rows, parities, values)
    return values if good else None


def contradicting(table: PairTable, rows: Ints, known: Ints, classes: int, parities: Ints) -> Ints | None:
    """Return classes whose values contradict each other where some literals are true; None where it is not known."""
    values = np.full(classes, UNKNOWN, dtype=np.int8)
    values[known >> 1] = 1 - (known & 1)
    wrong = np.flatnonzero(_truths(values, known) == 0)
    if len(wrong):
        return known[wrong[:1]] >> 1
    found = kernel()
    if found is None:
        return None
    good, why = settled_in_library(found, table.sizes, table.first, rows, parities, values)
    if good:
        return None
    classes_met: set[int] = set()
    left = set(why[-1].tolist()) - {-1}
    while left:
        number = left.pop()
        classes_met.add(number)
        left |= set(why[number].tolist()) - {-1} - classes_met
    return np.array(sorted(classes_met), dtype=np.int64)


def _truths(values: Signs, literals: Ints) -> Signs:
    here = values[literals >> 1]
    found: Signs = np.where(here < 0, here, here ^ (literals & 1).astype(np.int8))
    return found


def _settled(table: PairTable, rows: Ints, parities: Ints, values: Signs) -> bool:
    """Extend values by what follows, one level after the other."""
    cell_of = np.repeat(np.arange(len(table.sizes)), np.diff(table.first))
    pairs = [np.triu_indices(size, 1) for size in table.sizes.tolist()]
    one = np.concatenate([pair[0] for pair in pairs]) if pairs else np.empty(0, dtype=np.int64)
    other = np.concatenate([pair[1] for pair in pairs]) if pairs else np.empty(0, dtype=np.int64)
    order = np.argsort(rows >> 1, kind="stable")
    begin = np.searchsorted(rows[order] >> 1, np.arange(len(values) + 1))
    new = np.flatnonzero(values >= 0)
    while len(new):
        implied = [_implied_by_parities(parities, values)]
        for row in np.concatenate([order[begin[v] : begin[v + 1]] for v in new]).tolist():
            implied.append(_implied_in_cell(table, rows, values, int(cell_of[row]), int(one[row]), int(other[row])))
        literals = np.unique(np.concatenate(implied))
        if (literals[:-1] ^ 1 == literals[1:])[literals[:-1] % 2 == 0].any() or (_truths(values, literals) == 0).any():
            return False
        literals = literals[_truths(values, literals) == UNKNOWN]
        new = literals >> 1
        values[new] = 1 - (literals & 1)
    return True


def _implied_in_cell(table: PairTable, rows: Ints, values: Signs, cell: int, one: int, other: int) -> Ints:
    """Return literals that the known order of two panels implies by transitivity."""
    size = int(table.sizes[cell])
    thirds = np.array([k for k in range(size) if k not in (one, other)], dtype=np.int64)

    def over(i: Ints, j: Ints) -> Ints:
        found: Ints = rows[table.rows(cell, np.minimum(i, j), np.maximum(i, j))] ^ (i > j)
        return found

    first = int(_truths(values, over(np.array([one]), np.array([other])))[0])
    after, back = over(np.full_like(thirds, other), thirds), over(thirds, np.full_like(thirds, one))
    return np.concatenate([back[_truths(values, after) == first], after[_truths(values, back) == first]]) ^ first


def _implied_by_parities(parities: Ints, values: Signs) -> Ints:
    implied = []
    for row in parities.tolist():
        odd, left = 0, set[int]()
        for literal in row:
            if literal < 0:
                continue
            truth = int(values[literal >> 1])
            odd ^= literal & 1
            if truth == UNKNOWN:
                left ^= {literal & ~1}
            else:
                odd ^= truth
        if len(left) == 1:
            implied.append(left.pop() ^ 1 - odd)
        elif not left and odd:
            implied += [0, 1]  # a contradiction
    return np.array(implied, dtype=np.int64)


def probed(problem: LayerProblem) -> Signs:
    """Return for each literal whether it leads to a contradiction by itself, int8[2 n]."""
    found = kernel()
    return probe_in_python(problem) if found is None else ProblemInLibrary(found, problem).probed()


def counted(problem: LayerProblem, literals: tuple[int, ...] = ()) -> int:
    """Return in how many ways the variables of a problem can be set where some literals are true.

    Parameters
    ----------
    problem : LayerProblem
    literals : tuple of int, optional

    Examples
    --------
    >>> none = np.empty((0, 2), dtype=np.int64), np.empty((0, 4), dtype=np.int64)
    >>> problem = LayerProblem(3, np.array([[0, 2, 4]]), *none)
    >>> counted(problem), counted(problem, (0, 2))
    (6, 1)
    """
    found = kernel()
    number = None if found is None else ProblemInLibrary(found, problem).count(literals)
    return count_in_python(problem, literals) if number is None else number
