"""What the runner works on: jobs, units, and sinks that take rows.

A *job* says what is enumerated and splits it into units; a *unit* is enumerated by one worker and gives some
thousands of rows; a *sink* takes the rows of unit after unit.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from enumerate.runner.columns import Column

__all__ = ["Counting", "Job", "Progress", "Row", "Sink", "Unit"]

Row = tuple[Any, ...]


@dataclass(frozen=True, slots=True)
class Unit:
    """A piece of work.

    Attributes
    ----------
    payload : object
        What a worker needs to know; small, and picklable.
    weight : int
        Expected work, in rows or whatever the job counts; progress is measured by it.
    """

    payload: Any
    weight: int = 1


class Job(Protocol):
    """What an enumerator hands to the runner. A job is pickled to the workers: keep it small.

    Attributes
    ----------
    columns : mapping of str to type or column
    key : dict of str to object

    Examples
    --------
    Numbers from 0 to 5, in units of two:

    >>> class Numbers:
    ...     columns = {"number": int}
    ...     key = {"enumerate": "numbers"}
    ...     def units(self):
    ...         return [Unit(first) for first in (0, 2, 4)]
    ...     def work(self, payload):
    ...         return [(payload,), (payload + 1,)]
    >>> from enumerate.runner.running import rows_of
    >>> [row["number"] for row in rows_of(Numbers())]
    [0, 1, 2, 3, 4, 5]
    """

    @property
    def columns(self) -> Mapping[str, Column]:
        """Names of the values of a row, and their types: int, str, bool, float, or a column of lists."""

    @property
    def key(self) -> dict[str, Any]:
        """What the job is, in JSON values: equal keys give equal rows."""

    def units(self) -> Sequence[Unit]:
        """All units, in order, always the same."""

    def work(self, payload: Any) -> list[Row]:
        """Return the rows of a unit, always the same."""


class Counting:
    """What jobs that count have in common: the first value of each row is a number to be added.

    Attributes
    ----------
    columns : dict of str to type

    Examples
    --------
    >>> class Squares(Counting):
    ...     key = {"count": "squares"}
    ...     def units(self):
    ...         return [Unit(1), Unit(2)]
    ...     def work(self, payload):
    ...         return [(payload**2,)]
    >>> from enumerate.runner.running import total_of
    >>> total_of(Squares())
    5
    """

    @property
    def columns(self) -> dict[str, type]:
        """The number; a job may have more columns, which say what it is a part of."""
        return {"count": int}


class Sink(Protocol):
    """Where rows go.

    Examples
    --------
    `run` starts a sink, hands it units, and finishes or aborts it:

    >>> from enumerate.chains.jobs import ChainJob
    >>> from enumerate.chains.query import ChainQuery
    >>> from enumerate.runner.running import run
    >>> class Lengths:
    ...     def start(self, job):
    ...         return ()
    ...     def take(self, number, rows, seconds):
    ...         print("unit", number, "rows", len(rows))
    ...     def finish(self):
    ...         print("done")
    ...     def abort(self):
    ...         print("stopped")
    >>> _ = run(ChainJob(ChainQuery(6, 1), bare=True), Lengths())
    unit 0 rows 2
    done
    """

    def start(self, job: Job) -> Collection[int]:
        """Prepare for a job; return the numbers of its units that are there already."""

    def take(self, number: int, rows: list[Row], seconds: float) -> None:
        """Keep the rows of a unit, all or none of them."""

    def finish(self) -> None:
        """All units were taken."""

    def abort(self) -> None:
        """There will be no more units, though some are missing; also where `start` failed."""


@dataclass(slots=True)
class Progress:
    """How far a run has come.

    Attributes
    ----------
    units, done : int
        Units in all, and those that are there.
    weight, total_weight : int
        Weight of the units done, and of all.
    rows : int
        Made in this run.
    seconds : float
        Since the run began.
    skipped_weight : int
        Weight of the units that were there when it began.

    Examples
    --------
    >>> half = Progress(units=4, done=2, weight=50, total_weight=100, rows=900, seconds=3.0)
    >>> half.rate, half.seconds_left
    (300.0, 3.0)
    """

    units: int
    done: int = 0
    weight: int = 0
    total_weight: int = 0
    rows: int = 0
    seconds: float = 0.0
    skipped_weight: int = 0

    @property
    def rate(self) -> float:
        """Rows a second."""
        return self.rows / self.seconds if self.seconds else 0.0

    @property
    def seconds_left(self) -> float:
        """What is left, if the rest goes as fast as what is done."""
        done = self.weight - self.skipped_weight
        return self.seconds * (self.total_weight - self.weight) / done if done else float("inf")
