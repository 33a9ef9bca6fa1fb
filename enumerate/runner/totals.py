"""Numbers added up, of a run in one go or of one that is stopped and goes on."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection
from typing import Any

from enumerate.runner.job import Job, Row
from enumerate.runner.store import SqliteSink, read_rows

__all__ = ["CountSink"]


class CountSink:
    """A sink that adds up the first value of every row, apart for rows whose other values differ.

    Parameters
    ----------
    store : SqliteSink, optional
        Keeps the rows too. The numbers are then those of the store when it is complete: units that a run before
        this one has counted are among them, and each is there once.

    Attributes
    ----------
    total : int
        The sum of all; of a run with a store, once it is finished.
    parts : mapping
        The sums by the other values of the rows, in the order in which these first came.

    Examples
    --------
    >>> from enumerate.chains.jobs import count_job
    >>> from enumerate.chains.query import ChainQuery
    >>> from enumerate.runner.running import run
    >>> sink = CountSink()
    >>> _ = run(count_job(ChainQuery(8, 1), "burnside"), sink)
    >>> sink.total
    16
    """

    def __init__(self, store: SqliteSink | None = None) -> None:
        self._store = store
        self._names: tuple[str, ...] = ()
        self.parts: Counter[Row] = Counter()

    @property
    def total(self) -> int:
        """The sum of all."""
        return self.parts.total()

    def start(self, job: Job) -> Collection[int]:
        """Open the store, if there is one; return the units that it holds."""
        self._names = tuple(job.columns)
        return () if self._store is None else self._store.start(job)

    def take(self, number: int, rows: list[Row], seconds: float) -> None:
        """Add, or store."""
        if self._store is None:
            self._add(rows)
        else:
            self._store.take(number, rows, seconds)

    def finish(self) -> None:
        """Complete the store, and add up what it holds."""
        if self._store is not None:
            self._store.finish()
            self._add(read_rows(self._store.path))

    def abort(self) -> None:
        """Close the store; what it holds stays."""
        if self._store is not None:
            self._store.abort()

    def _add(self, rows: Any) -> None:
        for count, *rest in rows:
            self.parts[tuple(rest)] += count

    def by(self, column: str) -> dict[Any, int]:
        """Return the sums by the values of a column, the largest value first; none if the job has no such column.

        Examples
        --------
        >>> from enumerate.chains.jobs import count_job
        >>> from enumerate.chains.query import ChainQuery
        >>> from enumerate.runner.running import run
        >>> sink = CountSink()
        >>> progress = run(count_job(ChainQuery(8, 1), "orbits"), sink)
        >>> sink.by("contracted_links")
        {4: 9, 3: 5, 2: 2}
        """
        if column not in self._names[1:]:
            return {}
        place = self._names.index(column) - 1
        sums: Counter[Any] = Counter()
        for values, count in self.parts.items():
            sums[values[place]] += count
        return dict(sorted(sums.items(), reverse=True))
