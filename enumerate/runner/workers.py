"""Who works on units: processes of this machine, the workers of a Dask cluster, or whatever else gives futures."""

import gc
import logging
import os
import signal
import socket
import threading
import time
from concurrent.futures import CancelledError, Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from multiprocessing.connection import wait
from multiprocessing.process import BaseProcess
from typing import Any, Protocol

from enumerate.machine_code.folders import heard_by, to_workers
from enumerate.machine_code.kernels import use_machine_code, uses_machine_code
from enumerate.machine_code.weights import interpreting
from enumerate.runner.job import Job, Row
from enumerate.runner.stopping import heard_again, unheard
from graphs.errors import StoreError


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


def timed(job: Job, payload: Any, machine_code: bool) -> tuple[list[Row], float]:
    """Return the rows of a unit and the seconds they took; with machine code if whoever started the job has it."""
    if machine_code:
        use_machine_code()
    begin = time.perf_counter()
    with interpreting():
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
            return self._executor.submit(timed, job, payload, uses_machine_code())

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
    """Leave Ctrl-C to the parent, and do not outlive it; notify the user only of what no other process has."""
    gc.freeze()  # what was inherited stays, and is not looked through while rows are made
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    if hasattr(signal, "SIGHUP"):  # sent to all processes when a terminal closes
        signal.signal(signal.SIGHUP, signal.SIG_IGN)
    heard_again()
    heard_by(shared)

    def watch() -> None:
        while os.getppid() == parent:
            time.sleep(0.5)
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


_TO_CONNECT = 10
"""Seconds to reach a scheduler: a person waits, and an address with a typing error never answers."""

_LOGS = ("distributed", "distributed.client")
"""Loggers of Dask with a level of their own."""

_TO_LEAVE = 1
"""Seconds to take leave of it: all results are there by then, and a scheduler that is gone does not answer."""


class Cluster:
    """The workers of a Dask cluster, which replaces dead ones, or gives their units to others, by itself.

    Results come by callbacks: no future of Dask is waited for. The scheduler is an address such as
    ``tcp://host:8786``. Raises `StoreError` if Dask is not installed, or there is no scheduler.
    """

    def __init__(self, scheduler: str) -> None:
        try:
            from distributed import Client, KilledWorker
        except ImportError:
            raise StoreError("--scheduler requires Dask; try pip install 'synthedra[dask]'") from None
        make: Any = Client
        self._address = scheduler
        self._levels = {name: logging.getLogger(name).level for name in _LOGS}
        for name in _LOGS:  # of a lost scheduler we report in one line ourselves
            logging.getLogger(name).setLevel(logging.CRITICAL)
        try:  # a client that finds no scheduler takes its time and prints a traceback
            host, _, port = scheduler.removeprefix("tcp://").rpartition(":")
            socket.create_connection((host, int(port)), timeout=_TO_CONNECT).close()
            self._client = make(scheduler, timeout=f"{_TO_CONNECT}s", set_as_default=False)
        except (OSError, ValueError, OverflowError) as error:
            self._log_again()
            raise StoreError(
                f"no Dask scheduler at {scheduler!r}: {error}; expected an address such as tcp://127.0.0.1:8786"
            ) from None
        self.deaths: tuple[type[BaseException], ...] = (KilledWorker,)
        self.number = max(len(self._client.scheduler_info(n_workers=-1)["workers"]), 1)

    def submit(self, job: Job, payload: Any) -> Future[tuple[list[Row], float]]:
        """Give a unit to the cluster."""
        self.check()
        answer: Future[tuple[list[Row], float]] = Future()

        def hand_over(done: Any) -> None:  # called in a thread of Dask
            try:
                answer.set_result(done.result())
            except BaseException as error:  # whatever it is, it belongs to whoever waits
                lost = isinstance(error, (CancelledError, OSError)) and done.status != "error"
                answer.set_exception(self._lost() if lost else error)  # "error": the unit itself raised it

        self._client.submit(timed, job, payload, uses_machine_code(), pure=False).add_done_callback(hand_over)
        return answer

    def check(self) -> None:
        """Raise `StoreError` if the scheduler was lost."""
        if self._client.status != "running":
            raise self._lost()

    def _lost(self) -> StoreError:
        return StoreError(f"lost the Dask scheduler at {self._address!r}; try --resume: stored units are kept")

    def restart(self) -> None:
        """Do nothing: the cluster replaces its workers itself."""

    def close(self, *, at_once: bool) -> None:
        """Take leave; units that are not done are given up."""
        self._client.close(timeout=_TO_LEAVE)
        self._log_again()

    def _log_again(self) -> None:
        for name, level in self._levels.items():
            logging.getLogger(name).setLevel(level)
