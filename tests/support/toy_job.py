"""A job for tests of the runner: squares, and units that misbehave on request."""

from __future__ import annotations

import os
import signal
from dataclasses import dataclass
from pathlib import Path

from enumerate.runner.job import Unit


@dataclass(frozen=True)
class Squares:
    """Rows (n, n^2) of n = 0 .. size - 1, ten a unit."""

    size: int = 200
    deadly: int | None = None  # the unit whose worker kills itself ...
    note: str | None = None  # ... until this file is there
    weight: int = 1000

    columns = {"n": int, "square": int}  # noqa: RUF012

    @property
    def key(self):
        return {"squares": self.size}

    def units(self):
        return [Unit(start, self.weight) for start in range(0, self.size, 10)]

    def work(self, start):
        if self.deadly == start // 10 and not (self.note and Path(self.note).exists()):
            if self.note:
                Path(self.note).touch()
            os.kill(os.getpid(), signal.SIGKILL)
        return [(n, n * n) for n in range(start, min(start + 10, self.size))]
