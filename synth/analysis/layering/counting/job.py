"""Counts of independent problems on layers: a job for the runner of every enumerator (`enumerate.runner._run`).

Equal problems are counted once. A large problem is parted into cases: values of a few variables.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from hashlib import sha256
from typing import Any

import numpy as np

from enumerate.runner._run import tuples_of
from enumerate.runner.job import Column, Row, Unit
from synth.analysis.layering.counting.problem import LayerProblem, Values
from synth.analysis.layering.counting.propagation import counted

_LARGE, _CASES, _WORK = 64, 16, 10_000
"""Variables from which on a problem is parted, into how many cases at most, and the weight of one: others have 1."""


@dataclass(frozen=True, eq=False)
class LayerCountJob:
    """The numbers of solutions of problems; a row has the place of a problem, a case of it, and its number as text.

    Attributes
    ----------
    problems : tuple of LayerProblem

    Examples
    --------
    >>> import synth
    >>> parts = synth.layers("data/patterns/bird-base.fold").parts
    >>> numbers_of(LayerCountJob(tuple(problem for part in parts for problem, _ in part.problems)))
    [2]
    """

    problems: tuple[LayerProblem, ...]

    @property
    def columns(self) -> Mapping[str, Column]:
        """Names and types of the values of a row."""
        return {"problem": int, "case": int, "orders": str}

    @cached_property
    def _digests(self) -> list[str]:
        found = []
        for problem in self.problems:
            arrays = (problem.triples, problem.clauses, problem.parities)
            rows = [np.array([problem.variables]), *(np.array([len(array)]) for array in arrays), *arrays]
            found.append(sha256(b"".join(row.astype("<i8").tobytes() for row in rows)).hexdigest())
        return found

    @property
    def key(self) -> dict[str, Any]:
        """What the job is, in JSON values."""
        return {"count": "layer orders", "problems": list(dict.fromkeys(self._digests))}

    @cached_property
    def first(self) -> list[int]:
        """For each problem the place of the first that is equal."""
        places: dict[str, int] = {}
        return [places.setdefault(digest, place) for place, digest in enumerate(self._digests)]

    def units(self) -> list[Unit]:
        """Return a unit for each case of each problem that is another."""
        return [
            Unit((place, number, case), _WORK if self.problems[place].variables >= _LARGE else 1)
            for place in sorted(set(self.first))
            for number, case in enumerate(_cases(self.problems[place]))
        ]

    def work(self, payload: Any) -> list[Row]:
        """Return the row of a case."""
        place, number, case = payload
        return [(place, number, str(counted(self.problems[place], case)))]


def _cases(problem: LayerProblem) -> list[tuple[int, ...]]:
    """Return literals, those of each case, whose numbers add up to that of the problem."""
    cases: list[tuple[int, ...]] = [()]
    if problem.variables < _LARGE:
        return cases
    values = Values(problem)
    while 2 * len(cases) <= _CASES:
        parted = []
        for case in cases:
            parts = max(values.parts(range(problem.variables)), key=len, default=[]) if values.assign(case) else []
            variable = values.choice(parts) if parts else None
            values.undo(0)
            for literal in () if variable is None else (2 * variable, 2 * variable + 1):
                possible = values.assign((*case, literal))
                values.undo(0)
                if possible:
                    parted.append((*case, literal))
            if variable is None:
                parted.append(case)
        if len(parted) == len(cases):
            break
        cases = parted
    return cases


def numbers_of(job: LayerCountJob, rows: Iterable[Row] | None = None, *, workers: int = 1) -> list[int]:
    """Return the number of solutions of each problem.

    Parameters
    ----------
    job : LayerCountJob
    rows : iterable of rows, optional
        All rows of the job, from a store, say; by default they are made.
    workers : int, optional
        Processes that make them; 1 makes them in this one.

    Examples
    --------
    >>> none = np.empty((0, 2), dtype=np.int64), np.empty((0, 4), dtype=np.int64)
    >>> numbers_of(LayerCountJob((LayerProblem(3, np.array([[0, 2, 4]]), *none),)))
    [6]
    """
    sums: dict[int, int] = {}
    for place, _, number in tuples_of(job, workers=workers) if rows is None else rows:
        sums[place] = sums.get(place, 0) + int(number)
    return [sums.get(place, 0) for place in job.first]
