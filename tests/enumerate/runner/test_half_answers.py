"""Workers that end in the middle of an answer: whoever reads it must not wait for the rest."""

import os
import signal
import subprocess
import sys
import threading
import time
from dataclasses import dataclass
from pathlib import Path

import pytest
from sizes import slow
from toy_job import Squares

from enumerate.runner._run import run
from enumerate.runner.sinks import RowSink
from graphs.errors import StoreError

LONG = 30_000_000
"""Characters of an answer that no pipe holds."""


@dataclass(frozen=True)
class Halved(Squares):
    """Squares; the worker of the third unit gets a signal while it sends a long answer."""

    number: int = signal.SIGKILL
    sent: str = ""

    def work(self, start):
        if start != 20 or Path(self.sent).exists():
            return super().work(start)
        threading.Thread(target=self._wait_and_send, args=(threading.get_ident(),), daemon=True).start()
        return [(1, "x" * LONG)]

    def _wait_and_send(self, thread):
        while not is_sending(sys._current_frames()[thread]):
            time.sleep(0.001)
        Path(self.sent).touch()
        os.kill(os.getpid(), self.number)


def is_sending(frame):
    """Whether a thread is writing more than a pipe holds."""
    while frame is not None:
        if frame.f_code.co_name == "_send" and frame.f_locals.get("remaining", 0) > LONG / 2:
            return True
        frame = frame.f_back
    return False


class FullDisk(RowSink):
    """A sink that has no place any more, as soon as a worker is stopped in the middle of an answer."""

    def __init__(self, sent):
        super().__init__(lambda columns, rows: None)
        self._sent = sent

    def take(self, number, rows, seconds):
        while not self._sent.exists():
            time.sleep(0.001)
        time.sleep(0.1)
        raise StoreError("no space left")


def killed(sent):
    rows = []
    run(Halved(sent=str(sent)), RowSink(lambda columns, some: rows.extend(some)), workers=2)
    assert rows == [(n, n * n) for n in range(200)]


def aborted(sent):
    with pytest.raises(StoreError, match="no space left"):
        run(Halved(number=signal.SIGSTOP, sent=str(sent)), FullDisk(sent), workers=2)


@pytest.mark.skipif(not hasattr(signal, "SIGSTOP"), reason="needs signals that stop a process")
@pytest.mark.parametrize("name", ["killed", slow("aborted")])
def test_half_an_answer_is_not_waited_for(tmp_path, name):
    program = f"import sys, pathlib, test_half_answers as t; t.{name}(pathlib.Path(sys.argv[1]))"
    places = [Path(__file__).parent, Path(__file__).parents[2] / "support", Path(__file__).parents[3]]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, places))}
    sent = tmp_path / "sent"
    subprocess.run([sys.executable, "-c", program, sent], check=True, timeout=60, env=environment)
    assert sent.exists()
