"""Who works on units: processes of this machine, or anything else that takes units and gives futures."""

from __future__ import annotations

import gc
import os
import signal
import threading
import time
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from multiprocessing.connection import wait
from multiprocessing.process import BaseProcess
from typing import Any, Protocol

from enumerate.machine_code.notice import heard_by, to_workers
from enumerate.runner.job import Job, Row
from enumerate.runner.stopping import heard_again, unheard

__all__ = ["LocalWorkers", "Workers", "timed"]


class Workers(Protocol):
    """Processes or machines that work on units, `number` of them at the same time.

    `deaths` are the exceptions that a future raises if a worker died.
    """

    number: int
    deaths: tuple[type[BaseException], ...]

    def submit(self, job: Job, payload: Any) -> Future[tuple[list[Row], float]]:
        """Give a unit to a worker; return its rows and seconds, to come."""

    def check(self) -> None:
        """Raise if nothing will come any more."""

    def restart(self) -> None:
        """Replace dead workers."""

    def close(self, *, at_once: bool) -> None:
        """Let them go; at once, if nobody waits for what they work on."""


def timed(job: Job, payload: Any) -> tuple[list[Row], float]:
    """Return the rows of a unit, and the seconds they took."""
    begin = time.perf_counter()
    rows = job.work(payload)
    return rows, time.perf_counter() - begin


class LocalWorkers:
    """Processes of this machine; dead ones can be replaced.

    An executor reads the answers of all its processes from one pipe. Where one dies in the middle of an answer, it
    waits for the rest, for ever, since the others, and this process too, could still write it. So deaths are
    looked for here, and processes end by `_end`.
    """

    deaths: tuple[type[BaseException], ...] = (BrokenProcessPool,)

    def __init__(self, number: int) -> None:
        self.number = number
        self._executor = self._make()

    def _make(self) -> ProcessPoolExecutor:
        return ProcessPoolExecutor(self.number, initializer=_become_worker, initargs=(os.getpid(), to_workers()))

    def submit(self, job: Job, payload: Any) -> Future[tuple[list[Row], float]]:
        """Give a unit to a process."""
        with unheard():  # the processes, which start with the first units, have our handlers for a moment
            return self._executor.submit(timed, job, payload)

    def check(self) -> None:
        """Raise `BrokenProcessPool` if a process died."""
        if wait([process.sentinel for process in self._processes()], timeout=0):
            raise BrokenProcessPool("a worker process died")

    def restart(self) -> None:
        """Start other processes."""
        self._end()
        self._executor = self._make()

    def close(self, *, at_once: bool) -> None:
        """End the processes, or wait until they have done what they work on."""
        if at_once:
            self._end()
        else:
            self._executor.shutdown(cancel_futures=True)

    def _processes(self) -> list[BaseProcess]:
        return list((self._executor._processes or {}).values())

    def _end(self) -> None:
        """End the processes at once, whatever they do (3.14 has kill_workers, which waits for half an answer)."""
        answers = self._executor._result_queue
        for process in self._processes():
            process.kill()
        if answers is not None:  # it is None where the executor found out by itself and has ended
            answers._writer.close()  # type: ignore[attr-defined]  # the last that could write: half an answer ends
        self._executor.shutdown(cancel_futures=True)


def _become_worker(parent: int, shared: Any) -> None:
    """Leave Ctrl-C to the parent, and do not outlive it; tell the user what only one process should."""
    gc.freeze()  # what was inherited stays, and is not looked through while rows are made
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    if hasattr(signal, "SIGHUP"):  # a terminal tells all processes that it closes
        signal.signal(signal.SIGHUP, signal.SIG_IGN)
    heard_again()
    heard_by(shared)

    def watch() -> None:
        while os.getppid() == parent:
            time.sleep(0.5)
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
