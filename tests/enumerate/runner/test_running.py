import os
import signal
import sqlite3
import subprocess
import time
from contextlib import contextmanager

import pytest
from commands import run as command_line
from runs import SYNTH, complaints, enumerating
from sizes import slow
from toy_job import Squares

from enumerate.chains.jobs import ChainJob
from enumerate.chains.query import ChainQuery
from enumerate.runner._run import run
from enumerate.runner.sinks import CountSink, RowSink, SortedSink
from enumerate.runner.stopping import Interrupted
from enumerate.runner.store import SqliteSink, read_meta, read_rows
from graphs.errors import FileError, StoreError


def rows_of(job, **options):
    found = []
    progress = run(job, RowSink(lambda columns, rows: found.extend(rows)), **options)
    assert progress.rows == len(found)
    assert progress.done == progress.units == len(job.units())
    return found


@pytest.mark.parametrize("workers", [1, 2, 5])
def test_rows_come_in_order(workers):
    assert rows_of(Squares(), workers=workers) == [(n, n * n) for n in range(200)]


def test_progress_is_told():
    told = []
    run(Squares(), CountSink(), workers=2, report=lambda p: told.append((p.done, p.rows, p.weight, p.seconds_left)))
    assert [(done, rows, weight) for done, rows, weight, _ in told] == [(k, 10 * k, 1000 * k) for k in range(1, 21)]
    assert told[-1][3] == 0 <= told[5][3]


def test_a_worker_that_dies_is_replaced(tmp_path):
    job = Squares(deadly=7, note=str(tmp_path / "died"))
    assert rows_of(job, workers=2) == rows_of(Squares())
    assert (tmp_path / "died").exists()


def test_a_unit_that_always_kills_its_worker_stops_the_run(tmp_path):
    store = tmp_path / "squares.sqlite"
    with pytest.raises(StoreError, match="died 3 times at unit 7"):
        run(Squares(deadly=7), SqliteSink(store), workers=2)
    assert list(read_rows(store)) == [(n, n * n) for n in range(70)]
    assert read_meta(store)["complete"] is False
    run(Squares(), SqliteSink(store, resume=True))
    assert list(read_rows(store)) == rows_of(Squares())
    assert read_meta(store)["complete"] is True


def test_ctrl_c_stops_between_units_and_leaves_the_store_whole(tmp_path):
    store = tmp_path / "squares.sqlite"
    before = signal.getsignal(signal.SIGINT)  # ignored, where the tests run in the background of a shell

    def press(progress):
        if progress.done == 5:
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(Interrupted):
        run(Squares(), SqliteSink(store), report=press)
    assert list(read_rows(store)) == [(n, n * n) for n in range(50)]
    run(Squares(), SqliteSink(store, resume=True), workers=2)
    assert list(read_rows(store)) == rows_of(Squares())
    assert signal.getsignal(signal.SIGINT) is before


def chains_command(links, dof, *words):
    """The command line that lists chains, in a process of its own."""
    return enumerating("chains", "--links", links, "--dof", dof, *words)


@pytest.mark.parametrize(
    ("name", "words", "links", "dof"),
    [
        pytest.param("chains.sqlite", "go on with --resume", 15, 4, marks=pytest.mark.slow),
        pytest.param("chains.sqlite", "go on with --resume", 16, 1, marks=pytest.mark.slow),
        pytest.param("chains.g6", "nothing was written", 16, 1, marks=pytest.mark.slow),
    ],
)
def test_ctrl_c_at_the_command_line(tmp_path, links, dof, name, words):
    command = chains_command(links, dof, "--workers", 2, "-o", tmp_path / name)
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    deadline = time.monotonic() + 120
    while sum(path.stat().st_size for path in tmp_path.iterdir()) < 100_000:  # some units have been written
        assert time.monotonic() < deadline
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 130
    assert complaints(errors) == [f"stopped; {words}"]
    left = {path.name for path in tmp_path.iterdir()}
    assert left == ({name} if name.endswith(".sqlite") else set())
    if left:
        assert read_meta(tmp_path / name)["complete"] is False
        assert next(read_rows(tmp_path / name))[1] == links


def test_a_complete_store_can_be_resumed_and_has_nothing_to_do(tmp_path):
    store = tmp_path / "squares.sqlite"
    run(Squares(), SqliteSink(store))
    assert run(Squares(), SqliteSink(store, resume=True)).rows == 0
    assert len(list(read_rows(store))) == 200


class _Asked(Squares):
    """A job that notes how often it is asked for its units."""

    times = 0

    def units(self):
        type(self).times += 1
        return super().units()


def test_the_units_of_a_job_are_found_once_and_not_for_a_store_that_is_refused(tmp_path, monkeypatch):
    store = tmp_path / "squares.sqlite"
    monkeypatch.setattr(_Asked, "times", 0)
    run(_Asked(), SqliteSink(store))
    assert _Asked.times == 1
    run(_Asked(), SqliteSink(store, resume=True))
    assert _Asked.times == 2
    run(_Asked(), SortedSink(SqliteSink(tmp_path / "sorted.sqlite"), "n"))
    assert _Asked.times == 3
    with pytest.raises(StoreError, match="exists already"):
        run(_Asked(), SqliteSink(store))
    assert _Asked.times == 3


def test_stores_that_are_refused(tmp_path):
    store = tmp_path / "squares.sqlite"
    run(Squares(), SqliteSink(store))
    before = store.read_bytes()
    with pytest.raises(StoreError, match="exists already"):
        run(Squares(), SqliteSink(store))
    with pytest.raises(StoreError, match=r"holds another run \(squares=200\)"):
        run(Squares(100), SqliteSink(store, resume=True))
    assert store.read_bytes() == before
    text = tmp_path / "text.sqlite"
    text.write_text("no database at all, only words" * 100)
    with pytest.raises(StoreError, match="not a database"):
        run(Squares(), SqliteSink(text, resume=True))
    other = tmp_path / "other.sqlite"
    with sqlite3.connect(other) as connection:
        connection.execute("CREATE TABLE meta (key TEXT, value TEXT)")
    connection.close()
    with pytest.raises(StoreError, match="not a store that can be read here"):
        run(Squares(), SqliteSink(other, resume=True))
    with pytest.raises(FileError, match="there is no folder"):
        run(Squares(), SqliteSink(tmp_path / "no" / "store.sqlite"))
    with pytest.raises(StoreError, match="unable to open"):
        run(Squares(), SqliteSink("/proc/store.sqlite"))
    with pytest.raises(StoreError, match="no such file"):
        list(read_rows(tmp_path / "no.sqlite"))


def test_two_runs_on_one_store(tmp_path):
    store = tmp_path / "squares.sqlite"
    one = SqliteSink(store)
    one.start(Squares())
    other = SqliteSink(store, resume=True)
    assert len(other.start(Squares())) == 0
    one.take(0, [(0, 0)], 0.0)
    with pytest.raises(StoreError, match="another run is writing"):
        other.take(0, [(0, 0)], 0.0)
    one.abort()
    other.abort()
    assert list(read_rows(store)) == [(0, 0)]


@contextmanager
def small_disk(path, size):
    made = subprocess.run(
        ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", path], capture_output=True, check=False
    )
    if made.returncode:
        pytest.skip("a small disk cannot be mounted here")
    try:
        yield
    finally:
        subprocess.run(["umount", path], check=True)


@pytest.mark.parametrize(
    "name", ["chains.g6", *(slow(f"chains{end}") for end in (".sqlite", ".jsonl", ".parquet", ""))]
)
def test_a_full_disk_gives_one_line_and_loses_nothing(tmp_path, name):
    disk = tmp_path / "disk"
    disk.mkdir()
    with small_disk(disk, "200k"):
        command = chains_command(12, 1, "-o", disk / name)
        if name in ("chains.g6", "chains.parquet"):
            (disk / "ballast").write_bytes(bytes(180_000))
        if name == "chains.sqlite":  # a process of its own: an open store keeps the small disk busy
            first = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
            assert first.returncode == 2
        else:
            first = command_line(*command[len(SYNTH) :], code=2)
        assert len(complaints(first.stderr)) == 1
        assert name in first.stderr
        if name == "chains.sqlite":
            assert "try --resume when there is room" in first.stderr
            subprocess.run(["mount", "-o", "remount,size=20m", disk], check=True)
            subprocess.run([*command, "--resume"], check=True, timeout=120)
            assert [row[0] for row in read_rows(disk / name)] == ids(12)
        else:
            assert {p.name for p in disk.iterdir()} <= {"ballast"}


def ids(links):
    job = ChainJob(ChainQuery(links, 1), bare=True)
    return [code for unit in job.units() for (code,) in job.work(unit.payload)]


def test_no_scheduler_there():
    pytest.importorskip("distributed", reason="needs Dask: pip install 'synthedra[dask]'")
    result = command_line("enumerate", "chains", "--links", 8, "--dof", 1, "--scheduler", "nonsense", code=2)
    assert "no Dask scheduler at 'nonsense'" in result.stderr
    assert len(complaints(result.stderr)) == 1
