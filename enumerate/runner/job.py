"""What the runner works on: queries, jobs, units, columns of rows, and sinks that take rows.

A *query* says which mechanisms are to be enumerated, with limits of their numbers. A *job* splits that into units;
a *unit* is enumerated by one worker and gives some thousands of rows; a *sink* takes the rows of unit after unit.
A column of rows holds numbers or text, or lists: a list is a tuple in a row, of numbers or text, or of tuples of
them. JSON and Parquet get it as a list, a store as JSON text, and a table as the text that its column makes of it.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from types import MappingProxyType
from typing import Any, ClassVar, Generic, Protocol, TypeVar

from graphs.errors import InvariantError
from graphs.printing import plain
from graphs.types import Bytes, Flags, Ints

Row = tuple[Any, ...]
Rows = TypeVar("Rows", Bytes, list[Any])


@dataclass(frozen=True)
class Query:
    """What queries have in common: they are as JSON values what their fields say."""

    @property
    def key(self) -> dict[str, Any]:
        """The query in JSON values; limits are least and greatest value."""
        return {field.name: _key_of(getattr(self, field.name)) for field in fields(self)}


def _key_of(value: object) -> object:
    if isinstance(value, Limits):
        return [value.least, value.most]
    return list(value) if isinstance(value, tuple) else value


Q_co = TypeVar("Q_co", bound=Query, covariant=True)


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
    >>> from enumerate.runner._run import rows_of
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

    A job may have more columns, which say what the number is a part of.

    Attributes
    ----------
    columns : dict of str to type

    Examples
    --------
    >>> from enumerate.chains import ChainQuery, count_job
    >>> list(count_job(ChainQuery(6, 1), "orbits").columns)
    ['count', 'contracted_links']
    """

    columns: Mapping[str, Column] = MappingProxyType({"count": int})


@dataclass(frozen=True)
class QueryJob(Generic[Q_co]):
    """What jobs that list the mechanisms of a query have in common; `listed` says what these are."""

    query: Q_co
    listed: ClassVar[str]

    @property
    def key(self) -> dict[str, Any]:
        """What the job is, in JSON values."""
        return {"enumerate": self.listed, **self.query.key}


@dataclass(frozen=True)
class QueryCount(Counting, Generic[Q_co]):
    """What jobs that count the mechanisms of a query have in common; `counted` says what these are."""

    query: Q_co
    method: str
    counted: ClassVar[str]

    @property
    def details(self) -> dict[str, Any]:
        """What the job is besides query and method, in JSON values."""
        return {}

    @property
    def key(self) -> dict[str, Any]:
        """What the job is, in JSON values."""
        return {"count": self.counted, "method": self.method, **self.details, **self.query.key}


class Listing(Job, Protocol):
    """A job that says how many rows a unit has, and makes them only as far as that needs."""

    def number(self, payload: Any) -> int:
        """Return the number of rows of a unit."""

    def interpreted(self, weight: int) -> float:
        """Return about how many seconds the job takes with kernels interpreted, its units having so much weight.

        Before there are units, weight is 0. A job without this method is taken to need no kernels.
        """


@dataclass(frozen=True)
class RowCount(Counting):
    """The number of rows of a job, where rows have to be made to be counted; `key` says what the count is."""

    rows: Listing
    key: dict[str, Any]

    def units(self) -> Sequence[Unit]:
        """Return those of the job."""
        return self.rows.units()

    def work(self, payload: Any) -> list[Row]:
        """Return the number of rows of a unit."""
        return [(self.rows.number(payload),)]

    def interpreted(self, weight: int) -> float:
        """Return what the job says."""
        return self.rows.interpreted(weight)


def packed(
    parts: Iterable[tuple[Any, int]], size: int, number_in: Callable[[Any], int] = lambda part: 0, most: int = 0
) -> Iterator[Unit]:
    """Yield units of parts, which come with their weights: tuples of at most so much weight, or of one part.

    Where a part stands for a number of things, a unit has so many of these at most.
    """
    held: list[Any] = []
    weight = number = 0
    for part, count in parts:
        if held and (weight + count > size or number + number_in(part) > most):
            yield Unit(tuple(held), weight)
            held, weight, number = [], 0, 0
        held.append(part)
        weight, number = weight + count, number + number_in(part)
    if held:
        yield Unit(tuple(held), weight)


def batches(rows: Rows, size: int) -> Iterator[Rows]:
    """Yield slices of so many rows of a list or an array; the last may be shorter."""
    for start in range(0, len(rows), size):
        yield rows[start : start + size]


class Sink(Protocol):
    """Where rows go.

    Examples
    --------
    `run` starts a sink, hands it units, and finishes or aborts it:

    >>> from enumerate.chains import ChainJob, ChainQuery
    >>> from enumerate.runner._run import run
    >>> from enumerate.runner.sinks import RowSink
    >>> class Lengths(RowSink):
    ...     def take(self, number, rows, seconds):
    ...         print("unit", number, "rows", len(rows))
    >>> _ = run(ChainJob(ChainQuery(6, 1), bare=True), Lengths(print))
    unit 0 rows 2
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


@dataclass(frozen=True, slots=True)
class ListColumn:
    """A column of lists; `between` parts the items in a table.

    Where the items are lists themselves, `within` parts their values, else it is empty; `before_last` stands
    before the last of these, if it is something else: the name before a number. `kind` is the type of all values,
    None where they differ.

    >>> ListColumn(" ", "-", ":", None).text((("a", "b", 28.15), ("b", "c", 30.0)))
    'a-b:28.15 b-c:30'
    """

    between: str
    within: str = ""
    before_last: str = ""
    kind: type | None = int

    def text(self, values: tuple[Any, ...]) -> str:
        """Return how a table shows a list."""
        return self.between.join(map(self.item_text, values))

    def item_text(self, item: Any) -> str:
        """Return how a table shows an item; names come from files, so they may be long."""
        if not isinstance(item, tuple):
            return f"{item:.12g}" if isinstance(item, float) else plain(item)
        *first, last = map(self.item_text, item)
        return self.within.join(first) + (self.before_last or self.within) + last


@dataclass(frozen=True, slots=True)
class JoinColumn(ListColumn):
    """A column of lists of joints, each with the links that it joins: the name first, then what it joins.

    >>> JoinColumn(" ", "-", ":", str).text((("a", "1", "2"), ("b", "2", "3")))
    'a:1-2 b:2-3'
    """

    def item_text(self, item: Any) -> str:
        """Return how a table shows a joint and its links."""
        if not isinstance(item, tuple):
            return plain(item)
        name, *links = map(str, item)
        return plain(name) + self.before_last + self.within.join(map(plain, links))


@dataclass(frozen=True, slots=True)
class RangeColumn(ListColumn):
    """A column of lists of (least, greatest); a table shows those that are equal once.

    >>> RangeColumn(" ", "..").text(((0, 1), (1, 1)))
    '0..1 1'
    """

    def item_text(self, item: Any) -> str:
        """Return how a table shows least and greatest."""
        least, greatest = item
        return str(least) if least == greatest else f"{least}{self.within}{greatest}"


Column = type | ListColumn
"""int, str, bool or float; or a column of lists."""


def row_as_dict(columns: Iterable[str], row: tuple[Any, ...]) -> dict[str, Any]:
    """Return a row as a dictionary of its columns, with lists for tuples."""
    return {
        name: _as_list(value) if isinstance(value, tuple) else value for name, value in zip(columns, row, strict=True)
    }


def _as_list(value: Any) -> Any:
    return [_as_list(item) for item in value] if isinstance(value, tuple) else value


def stored(values: tuple[Any, ...] | None) -> str | None:
    """Return a list as compact JSON text; None where a row has none."""
    return None if values is None else json.dumps(values, separators=(",", ":"))


def unstored(text: str | None) -> tuple[Any, ...] | None:
    """Return the list of a JSON text, as it stands in a row."""
    return None if text is None else tuple(_as_tuple(item) for item in json.loads(text))


def _as_tuple(value: Any) -> Any:
    return tuple(map(_as_tuple, value)) if isinstance(value, list) else value


@dataclass(frozen=True, slots=True)
class Limits:
    """A least and a greatest value.

    Attributes
    ----------
    least : int
    most : int or None
        None: there is no greatest value.

    Examples
    --------
    >>> 3 in Limits(2), 3 in Limits(0, 2)
    (True, False)
    """

    least: int = 0
    most: int | None = None

    def __contains__(self, value: int) -> bool:
        """Tell whether a value is within the limits."""
        return value >= self.least and (self.most is None or value <= self.most)

    def admitted(self, values: Ints) -> Flags:
        """Tell which of some values are within the limits."""
        enough: Flags = values >= self.least
        return enough if self.most is None else enough & (values <= self.most)


ANY_NUMBER = Limits(0)
ONE_OR_MORE = Limits(1)

LimitsLike = Limits | tuple[int, int | None] | int
"""Limits, the least and the greatest value, or the one value."""


class LimitField:
    """A field of a query that holds limits, whatever stands for them; the smaller number must come first."""

    def __init__(self, default: Limits) -> None:
        self._default = default

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, query: object | None, owner: type | None = None) -> Limits:
        limits: Limits = self._default if query is None else query.__dict__[self._name]
        return limits

    def __set__(self, query: object, value: LimitsLike) -> None:
        pair = (value, value) if isinstance(value, int) else value
        limits = Limits(*pair) if isinstance(pair, Sequence) else pair
        if limits.most is not None and limits.most < limits.least:
            wrong = f"the range {limits.least} to {limits.most}"
            raise InvariantError(self._name.replace("_", " "), wrong, "the smaller number first")
        query.__dict__[self._name] = limits
