"""Conditions on variables, and how many of their values keep all of them.

The counter sets a variable, follows what is implied, parts what is left into independent problems, and keeps the count
of each that it has met: its key is which variables are open, and what the others make of the conditions on them.
`kernel.c` does the same, faster. Sources: J. R. Bayardo Jr. and J. D. Pehoushek, Counting models using connected
components (2000); M. Thurley, sharpSAT (2006). Theory: docs/theory/layer-orders.md.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from graphs.types import Ints, Signs

UNKNOWN = -1


@dataclass(frozen=True, eq=False)
class LayerProblem:
    """Conditions on some variables: literals are 2 v, and 2 v + 1 for the opposite.

    Attributes
    ----------
    variables : int
    triples : int[n, 3]
        Literals that are not all equal.
    clauses : int[n, 2]
        Literals of which one is true.
    parities : int[n, 4]
        Literals of which an even number is true, each of another variable; -1 fills up.
    """

    variables: int
    triples: Ints
    clauses: Ints
    parities: Ints

    @cached_property
    def conditions(self) -> list[tuple[int, tuple[int, ...]]]:
        """All conditions, each with its kind: 3 a triple, 2 a clause, 4 a parity."""
        parts = ((3, self.triples), (2, self.clauses), (4, self.parities))
        return [(kind, tuple(x for x in row if x >= 0)) for kind, rows in parts for row in rows.tolist()]

    @cached_property
    def conditions_of(self) -> list[list[int]]:
        """The conditions on each variable."""
        of: list[list[int]] = [[] for _ in range(self.variables)]
        for number, (_, literals) in enumerate(self.conditions):
            for literal in literals:
                of[literal >> 1].append(number)
        return of


Counter = Callable[[Sequence[LayerProblem]], Sequence[int]]
"""What counts the solutions of each of some problems."""


class Values:
    """Values of the variables of a problem, -1 where open, and what follows from them."""

    def __init__(self, problem: LayerProblem) -> None:
        self.problem = problem
        self.value = [UNKNOWN] * problem.variables
        self.trail: list[int] = []

    def truth(self, literal: int) -> int:
        """Return 1 if a literal is true, 0 if it is not, -1 if it is open."""
        here = self.value[literal >> 1]
        return here if here < 0 else here ^ literal & 1

    def assign(self, literals: Iterable[int]) -> bool:
        """Make literals true, with what follows; return whether that is consistent."""
        start = len(self.trail)
        if not all(self._set(literal) for literal in literals):
            return False
        while start < len(self.trail):
            for number in self.problem.conditions_of[self.trail[start]]:
                implied = self._implied(*self.problem.conditions[number])
                if implied is None or not all(self._set(literal) for literal in implied):
                    return False
            start += 1
        return True

    def undo(self, to: int) -> None:
        """Open all variables that were set after so many."""
        while len(self.trail) > to:
            self.value[self.trail.pop()] = UNKNOWN

    def _set(self, literal: int) -> bool:
        truth = self.truth(literal)
        if truth == UNKNOWN:
            self.value[literal >> 1] = 1 - (literal & 1)
            self.trail.append(literal >> 1)
        return truth != 0

    def _implied(self, kind: int, literals: tuple[int, ...]) -> tuple[int, ...] | None:
        """Return what a condition implies; None if it is broken."""
        truths = [self.truth(literal) for literal in literals]
        left = [literal for literal, truth in zip(literals, truths, strict=True) if truth == UNKNOWN]
        if kind == 4:
            if len(left) > 1:
                return ()
            odd = truths.count(1) % 2
            return (left[0] ^ 1 - odd,) if left else (None if odd else ())
        if kind == 2:
            if 1 in truths:
                return ()
            return None if not left else tuple(left) if len(left) == 1 else ()
        if (0 in truths and 1 in truths) or len(left) > 1:
            return ()
        return (left[0] ^ int(1 in truths),) if left else None

    def open_in(self, kind: int, literals: tuple[int, ...]) -> list[int]:
        """Return the open variables of a condition; none if it is kept whatever they are."""
        truths = [self.truth(literal) for literal in literals]
        if (kind == 3 and 0 in truths and 1 in truths) or (kind == 2 and 1 in truths):
            return []
        return [literal >> 1 for literal, truth in zip(literals, truths, strict=True) if truth == UNKNOWN]

    def parts(self, variables: Iterable[int]) -> Iterator[list[int]]:
        """Yield the independent parts of the open ones of some variables, each in order."""
        seen: set[int] = set()
        for start in variables:
            if start in seen or self.value[start] != UNKNOWN:
                continue
            part = [start]
            seen.add(start)
            for variable in part:
                for number in self.problem.conditions_of[variable]:
                    others = self.open_in(*self.problem.conditions[number])
                    part += [other for other in others if other not in seen]
                    seen.update(others)
            yield sorted(part)

    def choice(self, part: Sequence[int]) -> int:
        """Return the variable that most conditions speak of; those that nearly decide count more."""
        weights = (0, 0, 4, 1, 1)

        def weight(variable: int) -> int:
            numbers = self.problem.conditions_of[variable]
            return sum(weights[len(self.open_in(*self.problem.conditions[number]))] for number in numbers)

        return max(part, key=lambda variable: (weight(variable), -variable))


class _Counter(Values):
    """Counts in Python, with the cache of one problem."""

    def __init__(self, problem: LayerProblem) -> None:
        super().__init__(problem)
        self._counts: dict[tuple[tuple[int, ...], tuple[int, ...]], int] = {}

    def count(self, variables: Iterable[int]) -> int:
        """Return in how many ways open ones of some variables can be set."""
        product = 1
        for part in list(self.parts(variables)):
            product *= 2 if len(part) == 1 else self._count_part(part)
            if not product:
                break
        return product

    def _count_part(self, part: list[int]) -> int:
        key = tuple(part), self._made_by_others(part)
        if key in self._counts:
            return self._counts[key]
        variable, total, to = self.choice(part), 0, len(self.trail)
        for literal in (2 * variable, 2 * variable + 1):
            if self.assign([literal]):
                total += self.count(part)
            self.undo(to)
        self._counts[key] = total
        return total

    def _made_by_others(self, part: Sequence[int]) -> tuple[int, ...]:
        numbers = dict.fromkeys(number for v in part for number in self.problem.conditions_of[v])
        odd = []
        for number in numbers:
            kind, literals = self.problem.conditions[number]
            truths = [self.truth(literal) for literal in literals]
            if kind != 2 and 2 <= truths.count(UNKNOWN) < len(truths):
                odd.append(truths.count(1) % 2)
        return tuple(odd)


def count_in_python(problem: LayerProblem, literals: Sequence[int] = ()) -> int:
    """Return in how many ways the variables of a problem can be set where some literals are true.

    Examples
    --------
    >>> none = np.empty((0, 2), dtype=np.int64), np.empty((0, 4), dtype=np.int64)
    >>> count_in_python(LayerProblem(3, np.array([[0, 2, 4]]), *none))
    6
    """
    counter = _Counter(problem)
    return counter.count(range(problem.variables)) if counter.assign(literals) else 0


def probe_in_python(problem: LayerProblem) -> Signs:
    """Return for each literal whether it leads to a contradiction by itself, int8[2 n]."""
    values, fails = Values(problem), np.zeros(2 * problem.variables, dtype=np.int8)
    for literal in range(2 * problem.variables):
        fails[literal] = not values.assign([literal])
        values.undo(0)
    return fails


def solutions(problem: LayerProblem, literals: Sequence[int] = ()) -> Iterator[list[int]]:
    """Yield the values of all variables that keep all conditions, 0 or 1 each, in an order that is always the same."""
    values = Values(problem)
    if not values.assign(literals):
        return

    def below() -> Iterator[list[int]]:
        if UNKNOWN not in values.value:
            yield list(values.value)
            return
        variable, to = values.value.index(UNKNOWN), len(values.trail)
        for literal in (2 * variable, 2 * variable + 1):
            if values.assign([literal]):
                yield from below()
            values.undo(to)

    yield from below()
