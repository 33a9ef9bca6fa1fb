"""The workers of a Dask cluster."""

from __future__ import annotations

import logging
import socket
from concurrent.futures import CancelledError, Future
from typing import Any

from enumerate.runner.job import Job, Row
from enumerate.runner.workers import timed
from graphs.errors import StoreError

__all__ = ["Cluster"]

_TO_CONNECT = 10
"""Seconds to reach a scheduler."""

_LOGS = ("distributed", "distributed.client")
"""Loggers of Dask with a level of their own."""

_TO_LEAVE = 1
"""Seconds to take leave of it."""


class Cluster:
    """The workers of a Dask cluster, which replaces dead ones, or gives their units to others, by itself.

    Results come by callbacks: nobody asks a future of Dask that may not be done. The scheduler is an address such
    as ``tcp://host:8786``. Raises `StoreError` if Dask is not installed, or there is no scheduler.
    """

    def __init__(self, scheduler: str) -> None:
        try:
            from distributed import Client, KilledWorker
        except ImportError:
            raise StoreError("--scheduler needs Dask: pip install 'synthedra[dask]'") from None
        make: Any = Client
        self._address = scheduler
        self._levels = {name: logging.getLogger(name).level for name in _LOGS}
        for name in _LOGS:  # what is logged of a lost scheduler is told in one line, by us
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

        self._client.submit(timed, job, payload, pure=False).add_done_callback(hand_over)
        return answer

    def check(self) -> None:
        """Raise `StoreError` if the scheduler was lost."""
        if self._client.status != "running":
            raise self._lost()

    def _lost(self) -> StoreError:
        return StoreError(
            f"lost the Dask scheduler at {self._address!r}; what was stored stays: go on with --resume"
        )

    def restart(self) -> None:
        """Nothing is to be done: the cluster's workers are not ours."""

    def close(self, *, at_once: bool) -> None:
        """Take leave; units that are not done are given up."""
        self._client.close(timeout=_TO_LEAVE)
        self._log_again()

    def _log_again(self) -> None:
        for name, level in self._levels.items():
            logging.getLogger(name).setLevel(level)
