"""Running a job: units of work, worker processes, and rows that arrive in order.

Units are worked on in any order and handed to the
sink in theirs, so that two runs give equal files and a store holds exactly the units 0 to k - 1 whatever killed
the run. Only a fixed number of units is in the air at any time: memory does not grow with the number of rows.
"""

from __future__ import annotations

import os
import signal
import socket
import threading
import time
from collections import deque
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import closing, contextmanager
from typing import Any

from enumerate.machine_code.notice import heard_by, to_workers
from enumerate.runner.columns import row_as_dict
from enumerate.runner.job import Job, Progress, Row, Sink, Unit
from graphs.errors import StoreError

__all__ = ["Interrupted", "rows_of", "run", "total_of", "tuples_of"]

_AHEAD = 4
"""Units in the air for each worker."""

_SMALL = 5_000
"""Weight that is not worth starting processes for."""

_PATIENCE = 3
"""How often workers may die on one unit before the run gives up."""


class Interrupted(Exception):
    """The user stopped the run; all units handed to the sink are safe."""


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

    Raises
    ------
    Interrupted
        If the user pressed Ctrl-C: what was handed to the sink stays there.
    StoreError
        If the sink cannot take the rows, workers die again and again, or the cluster is not reached.
    """
    try:
        stored = sink.start(job)
        with _interruptible() as stopped:
            units = job.units()
            weights = sum(unit.weight for unit in units[:stored])
            progress = Progress(
                len(units), stored, weights, sum(unit.weight for unit in units), skipped_weight=weights
            )
            begin = time.monotonic()
            for number, rows, seconds in _results(job, units, stored, workers, scheduler, stopped):
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


def rows_of(job: Job, *, workers: int = 1) -> Iterator[dict[str, Any]]:
    """Yield the rows of a job as dictionaries, in order, unit after unit as they are ready.

    Parameters
    ----------
    job : Job
    workers : int
        Local processes; 1 works in this one. They end with the last row, or when the generator is closed.

    Raises
    ------
    StoreError
        If workers die again and again.
    """
    columns = job.columns
    for row in tuples_of(job, workers=workers):
        yield row_as_dict(columns, row)


def total_of(job: Job, *, workers: int = 1) -> int:
    """Return the sum of the first values of all rows: what a `Counting` job counts. Arguments: `rows_of`."""
    return sum(row[0] for row in tuples_of(job, workers=workers))


def tuples_of(job: Job, *, workers: int = 1) -> Iterator[Row]:
    """Yield the rows of a job as they are, in order. Arguments: `rows_of`."""
    with closing(_results(job, job.units(), 0, workers, None, lambda: None)) as results:
        for _, rows, _ in results:
            yield from rows


@contextmanager
def _interruptible() -> Iterator[Callable[[], None]]:
    """Turn the first Ctrl-C into `Interrupted`, raised between units; a second one interrupts at once."""
    asked = threading.Event()

    def check() -> None:
        if asked.is_set():
            raise Interrupted

    def ask(number: int, frame: object) -> None:
        if asked.is_set():
            raise KeyboardInterrupt
        asked.set()

    if threading.current_thread() is not threading.main_thread():
        yield check
        return
    before = signal.signal(signal.SIGINT, ask)
    try:
        yield check
    finally:
        signal.signal(signal.SIGINT, before)


def _results(
    job: Job,
    units: Sequence[Unit],
    stored: int,
    workers: int,
    scheduler: str | None,
    check: Callable[[], None],
) -> Generator[tuple[int, list[Row], float]]:
    """Yield number, rows and seconds of each unit, in order."""
    left = units[stored:]
    small = len(left) <= 1 or sum(unit.weight for unit in left) < _SMALL
    if scheduler is None and (workers <= 1 or small):
        for number in range(stored, len(units)):
            check()
            yield number, *_timed(job, units[number].payload)
        return
    with closing(_Pool(workers) if scheduler is None else _Cluster(scheduler)) as pool:
        waiting: deque[tuple[int, Any]] = deque()
        following, deaths = stored, 0
        while following < len(units) or waiting:
            check()
            try:
                while following < len(units) and len(waiting) < _AHEAD * pool.workers:
                    waiting.append((following, pool.submit(job, units[following].payload)))
                    following += 1
                number, future = waiting[0]
                rows, seconds = _wait(future, check)
            except pool.deaths:
                deaths += 1
                if deaths >= _PATIENCE:
                    raise StoreError(
                        f"worker processes died {deaths} times at unit {stored}; is there enough memory?"
                    ) from None
                pool.restart()
                following = stored
                waiting.clear()
                continue
            waiting.popleft()
            stored, deaths = number + 1, 0
            yield number, rows, seconds


def _wait(future: Any, check: Callable[[], None]) -> Any:
    """Return a future's result; look up now and then whether the user wants to stop."""
    while True:
        check()
        try:
            return future.result(timeout=0.2)
        except TimeoutError:
            if future.done():  # it ended just now, or the unit itself raised this
                return future.result()


def _timed(job: Job, payload: Any) -> tuple[list[Row], float]:
    begin = time.perf_counter()
    rows = job.work(payload)
    return rows, time.perf_counter() - begin


class _Pool:
    """Local worker processes; dead ones can be replaced."""

    deaths: tuple[type[BaseException], ...] = (BrokenProcessPool,)

    def __init__(self, workers: int) -> None:
        self.workers = workers
        self._executor = self._make()

    def _make(self) -> ProcessPoolExecutor:
        return ProcessPoolExecutor(self.workers, initializer=_become_worker, initargs=(os.getpid(), to_workers()))

    def submit(self, job: Job, payload: Any) -> Future[tuple[list[Row], float]]:
        return self._executor.submit(_timed, job, payload)

    def restart(self) -> None:
        self._executor.shutdown(wait=False, cancel_futures=True)
        self._executor = self._make()

    def close(self) -> None:
        self._executor.shutdown(cancel_futures=True)


class _Cluster:
    """The workers of a Dask cluster, which replaces dead ones, or gives their units to others, by itself."""

    def __init__(self, scheduler: str) -> None:
        try:
            from distributed import Client, KilledWorker
        except ImportError:
            raise StoreError("--scheduler needs Dask: pip install 'synthedra[dask]'") from None
        make: Any = Client
        try:  # a client that finds no scheduler takes its time and prints a traceback
            host, _, port = scheduler.removeprefix("tcp://").rpartition(":")
            socket.create_connection((host, int(port)), timeout=10).close()
            self._client = make(scheduler, timeout="10s", set_as_default=False)
        except (OSError, ValueError) as error:
            raise StoreError(
                f"no Dask scheduler at {scheduler!r}: {error}; expected an address such as tcp://127.0.0.1:8786"
            ) from None
        self.deaths: tuple[type[BaseException], ...] = (KilledWorker,)
        self.workers = max(len(self._client.scheduler_info(n_workers=-1)["workers"]), 1)

    def submit(self, job: Job, payload: Any) -> Any:
        return self._client.submit(_timed, job, payload, pure=False)

    def restart(self) -> None:
        """Nothing is to be done: the cluster's workers are not ours."""

    def close(self) -> None:
        self._client.close()


def _become_worker(parent: int, shared: Any) -> None:
    """Leave Ctrl-C to the parent, and do not outlive it; tell the user what only one process should."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    heard_by(shared)

    def watch() -> None:
        while os.getppid() == parent:
            time.sleep(0.5)
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
