"""Running a job: units of work, worker processes, and rows that arrive in order.

Units are worked on in any order and handed to the sink in theirs, so that two runs give equal files and a store
holds exactly the units 0 to k - 1 whatever killed the run. Only a fixed number of units is in the air at any time:
memory does not grow with the number of rows.
"""

import time
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future
from contextlib import closing, contextmanager, nullcontext
from typing import Any, TypeVar

import networkx as nx

from enumerate.machine_code.kernels import uses_machine_code
from enumerate.machine_code.weights import expect
from enumerate.runner.job import Job, Progress, Row, Sink, Unit, row_as_dict
from enumerate.runner.stopping import interruptible
from enumerate.runner.workers import Cluster, LocalWorkers, Workers, timed
from graphs.errors import StoreError
from graphs.garbage import set_aside

G = TypeVar("G", bound=nx.Graph)

_AHEAD = 4
"""Units in the air for each worker: one it works on, others it need not wait for; more would hold results in memory."""

_SMALL = 5_000
"""Weight that is not worth starting processes for: so many rows take about as long as a process takes to start."""

_PATIENCE = 3
"""How often workers may die on one unit before the run gives up: once may be chance, or memory that others took; a unit
that kills each of three workers would kill them all."""

_LOOK = 0.1
"""Seconds between two looks whether a unit that is waited for can still come, and is still wanted: nobody notices,
and it is no load."""


def run(
    job: Job,
    sink: Sink,
    *,
    workers: int = 1,
    scheduler: str | None = None,
    report: Callable[[Progress], None] | None = None,
) -> Progress:
    """Run all units of a job that the sink does not hold yet.

    Parameters
    ----------
    job : Job
    sink : Sink
    workers : int
        Local processes; 1 works in this one.
    scheduler : str, optional
        Address of a Dask scheduler, such as ``tcp://host:8786``, whose workers do the work instead. They need
        synthedra installed.
    report : callable, optional
        Called with the progress after each unit.

    Returns
    -------
    Progress
        At the end; units that the sink held already are not among its rows.

    Raises
    ------
    Interrupted
        If the user pressed Ctrl-C, or the process got a signal to end. What was handed to a store stays there.
    StoreError
        If the sink cannot take the rows, workers die again and again, or the cluster is not reached, or lost.

    Examples
    --------
    >>> from enumerate.chains import ChainJob, ChainQuery
    >>> from enumerate.runner.sinks import RowSink
    >>> done = run(ChainJob(ChainQuery(6, 1), bare=True), RowSink(lambda columns, rows: print(columns, rows)))
    ('code',) [('k1:E`hW',), ('k1:E@zO',)]
    >>> done.rows
    2
    """
    with interruptible() as check, nullcontext() if scheduler is None else _closing(Cluster(scheduler)) as cluster:
        try:
            units, progress = _begun(job, sink)
            begin = time.monotonic()
            with set_aside():
                for number, rows, seconds in _results(job, units, workers, cluster, check):
                    sink.take(number, rows, seconds)
                    progress.done += 1
                    progress.rows += len(rows)
                    progress.weight += units[number].weight
                    progress.seconds = time.monotonic() - begin
                    if report is not None:
                        report(progress)
            sink.finish()
        except BaseException:  # Ctrl-C and the like too: nothing half written stays
            sink.abort()
            raise
    return progress


def _begun(job: Job, sink: Sink) -> tuple[dict[int, Unit], Progress]:
    """Open the sink; return the units that it has not, by their numbers, and how far it is."""
    known = _UnitsOnce(job)
    there = sink.start(known)
    units = known.units()
    left = {number: unit for number, unit in enumerate(units) if number not in there}
    total = sum(unit.weight for unit in units)
    done = total - sum(unit.weight for unit in left.values())
    return left, Progress(len(units), len(units) - len(left), done, total, skipped_weight=done)


class _UnitsOnce:
    """A job that remembers its units: a large one takes long to find them, and a sink asks for them too."""

    def __init__(self, job: Job) -> None:
        self._job = job
        self._units: Sequence[Unit] | None = None

    def __getattr__(self, name: str) -> Any:
        return getattr(self._job, name)

    def units(self) -> Sequence[Unit]:
        """Return the units of the job, worked out when they are first needed."""
        if self._units is None:
            self._units = _units_of(self._job)
        return self._units


def _units_of(job: Job) -> Sequence[Unit]:
    """Return the units of a job, with machine code where that pays, for them or for what is done with them."""
    interpreted: Callable[[int], float] = getattr(job, "interpreted", lambda weight: 0.0)
    expect(interpreted(0))
    units = job.units()
    expect(interpreted(sum(unit.weight for unit in units)))
    return units


def rows_of(job: Job, *, workers: int = 1) -> Iterator[dict[str, Any]]:
    """Yield the rows of a job as dictionaries, in order, unit after unit as they are ready.

    Parameters
    ----------
    job : Job
    workers : int
        Local processes; 1 works in this one. They end with the last row, or when the generator is closed.
        StoreError if they die again and again.

    Examples
    --------
    >>> from enumerate.chains import ChainJob, ChainQuery
    >>> list(rows_of(ChainJob(ChainQuery(6, 1), bare=True)))
    [{'code': 'k1:E`hW'}, {'code': 'k1:E@zO'}]
    """
    columns = job.columns
    for row in tuples_of(job, workers=workers):
        yield row_as_dict(columns, row)


def graphs_of(rows: Iterable[Mapping[str, Any]], graph_of: Callable[[str], G]) -> Iterator[G]:
    """Yield the graph of the code of each row, the row in its graph attributes."""
    for row in rows:
        graph = graph_of(row["code"])
        graph.graph.update(row)
        yield graph


def total_of(job: Job, *, workers: int = 1) -> int:
    """Return the sum of the first values of all rows: what a `Counting` job counts.

    Parameters
    ----------
    job : Job
    workers : int
        As for `rows_of`.

    Examples
    --------
    Chains of eight links and one freedom, as Burnside's lemma counts them:

    >>> from enumerate.chains import ChainQuery, count_job
    >>> total_of(count_job(ChainQuery(8, 1), "burnside"))
    16
    """
    return sum(row[0] for row in tuples_of(job, workers=workers))


def tuples_of(job: Job, *, workers: int = 1) -> Iterator[Row]:
    """Yield the rows of a job as they are, in order. Arguments: `rows_of`."""
    with closing(_results(job, dict(enumerate(_units_of(job))), workers, None, lambda: None)) as results:
        for _, rows, _ in results:
            yield from rows


def _results(
    job: Job, units: dict[int, Unit], workers: int, cluster: Cluster | None, check: Callable[[], None]
) -> Generator[tuple[int, list[Row], float]]:
    """Yield number, rows and seconds of each unit, in order."""
    small = len(units) <= 1 or sum(unit.weight for unit in units.values()) < _SMALL
    if cluster is None and (workers <= 1 or small):
        for number, unit in units.items():
            check()
            yield number, *timed(job, unit.payload, uses_machine_code())
    elif cluster is not None:
        yield from _in_order(job, units, cluster, check)
    else:
        with _closing(LocalWorkers(workers)) as processes:
            yield from _in_order(job, units, processes, check)


def _in_order(
    job: Job, units: dict[int, Unit], workers: Workers, check: Callable[[], None]
) -> Generator[tuple[int, list[Row], float]]:
    """Yield what others work out, in order; begin again with the first unit that is missing where workers die."""
    numbers = list(units)
    submitted = done = deaths = 0
    waiting: deque[Future[tuple[list[Row], float]]] = deque()
    while done < len(numbers):
        check()
        try:
            while submitted < len(numbers) and len(waiting) < _AHEAD * workers.number:
                waiting.append(workers.submit(job, units[numbers[submitted]].payload))
                submitted += 1
            rows, seconds = _waited_for(waiting[0], workers, check)
        except workers.deaths:
            check()  # whoever stops a run may stop its workers too
            deaths += 1
            if deaths >= _PATIENCE:
                raise StoreError(
                    f"worker processes died {deaths} times at unit {numbers[done]}; is there enough memory?"
                ) from None
            workers.restart()
            submitted = done
            waiting.clear()
            continue
        waiting.popleft()
        done, deaths = done + 1, 0
        yield numbers[done - 1], rows, seconds


def _waited_for(
    future: Future[tuple[list[Row], float]], workers: Workers, check: Callable[[], None]
) -> tuple[list[Row], float]:
    """Return a future's result as soon as it is there."""
    while True:
        try:
            return future.result(timeout=_LOOK)
        except TimeoutError:
            if future.done():  # it ended just now, or the unit itself raised this
                return future.result()
        check()
        workers.check()


@contextmanager
def _closing(workers: Any) -> Iterator[Any]:
    """Let workers go at the end; at once, if it is not the end of their work."""
    at_once = True
    try:
        yield workers
        at_once = False
    finally:
        workers.close(at_once=at_once)
