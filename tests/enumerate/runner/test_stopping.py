"""Runs that are stopped: by Ctrl-C, a request to end, a terminal that closes."""

import os
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import pytest
from toy_job import Squares

from enumerate.runner._run import run
from enumerate.runner.sinks import FolderSink, JsonLinesSink, RowSink
from enumerate.runner.stopping import Interrupted
from enumerate.runner.store import SqliteSink, read_rows
from graphs.files import atomic
from graphs.files.atomic import FolderBeside

SIGNALS = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]


@dataclass(frozen=True)
class Slow(Squares):
    """Squares, of which unit 5 takes a minute; a file says that it has begun."""

    begun: str = ""

    def work(self, start):
        if start == 50:
            Path(self.begun).touch()
            time.sleep(60)
        return super().work(start)

    def mechanism_text(self, row):
        return f"{row['n']}"


def sink(path):
    kinds = {".sqlite": SqliteSink, ".jsonl": JsonLinesSink, "": FolderSink}
    return kinds[path.suffix](path)


PROGRAM = """
import sys
from pathlib import Path
from test_stopping import Interrupted, Slow, run, sink
try:
    run(Slow(begun=sys.argv[2]), sink(Path(sys.argv[1])), workers=int(sys.argv[3]))
except Interrupted as stop:
    sys.exit(stop.status)
"""


@pytest.mark.parametrize(
    ("name", "number", "workers"),
    [
        ("s.sqlite", signal.SIGTERM, 2),
        ("folder", signal.SIGINT, 1),
        *(
            pytest.param(name, number, workers, marks=pytest.mark.slow)
            for name in ("s.sqlite", "s.jsonl", "folder")
            for number in SIGNALS
            for workers in (1, 2)
        ),
    ],
)
def test_a_run_stops_inside_a_unit_and_leaves_nothing_half_written(tmp_path, name, number, workers):
    out, begun = tmp_path / "out", tmp_path / "begun"
    out.mkdir()
    paths = os.pathsep.join([str(Path(__file__).parent), *sys.path])
    process = subprocess.Popen(
        [sys.executable, "-c", PROGRAM, out / name, begun, str(workers)],
        env={**os.environ, "PYTHONPATH": paths},
        stderr=subprocess.PIPE,
    )
    while not begun.exists():
        assert process.poll() is None
        time.sleep(0.01)
    process.send_signal(number)
    _, errors = process.communicate(timeout=30)  # the unit takes a minute
    assert (process.returncode, errors) == (128 + number, b"")
    assert [path.name for path in out.iterdir()] == ([name] if name.endswith(".sqlite") else [])
    if name.endswith(".sqlite"):
        stored = len(rows := list(read_rows(out / name)))  # unit 5 may have begun before others came back
        assert rows == [(n, n * n) for n in range(stored)]
        assert stored == 50 or (workers == 2 and stored in range(0, 50, 10))


@pytest.mark.parametrize("number", SIGNALS)
def test_each_signal_stops_and_handlers_come_back(number):
    before = [signal.getsignal(n) for n in SIGNALS]
    with pytest.raises(Interrupted) as stop:
        run(Squares(), RowSink(lambda columns, rows: os.kill(os.getpid(), number)))
    assert stop.value.status == 128 + number
    assert [signal.getsignal(n) for n in SIGNALS] == before


def test_what_is_ignored_stays_ignored():
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        done = run(Squares(), RowSink(lambda columns, rows: os.kill(os.getpid(), signal.SIGHUP)))
    finally:
        signal.signal(signal.SIGHUP, before)
    assert done.rows == 200


def test_a_second_signal_does_not_disturb_cleaning_up(tmp_path):
    class Disturbed(JsonLinesSink):
        def abort(self):
            os.kill(os.getpid(), signal.SIGHUP)
            super().abort()

    with pytest.raises(Interrupted):
        run(Squares(), Disturbed(tmp_path / "rows.jsonl"), report=lambda progress: os.kill(os.getpid(), signal.SIGTERM))
    assert list(tmp_path.iterdir()) == []


def test_a_folder_of_many_files_is_removed_by_another_process(tmp_path, monkeypatch):
    monkeypatch.setattr(atomic, "_PATIENCE", 0.0)
    folder = FolderBeside(tmp_path / "folder")
    for number in range(50):
        (folder.path / f"{number}.json").touch()
    folder.discard()
    (remover,) = atomic._removers
    assert remover.wait(timeout=60) == 0
    assert list(tmp_path.iterdir()) == []
    atomic._removers.clear()
