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
    """What an enumerator hands to the runner. A job is pickled to the workers: keep it small."""

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
    """What jobs that count have in common: the first value of each row is a number to be added."""

    @property
    def columns(self) -> dict[str, type]:
        """The number; a job may have more columns, which say what it is a part of."""
        return {"count": int}


class Sink(Protocol):
    """Where rows go."""

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
    """How far a run has come."""

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
