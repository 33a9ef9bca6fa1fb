"""A store that others read, or write, while a run goes on and when it ends."""

import sqlite3
import subprocess
import sys
from contextlib import closing

import pytest
from runs import complaints, contents, enumerating, units_in, wait_for
from toy_job import Squares

from enumerate.chains.jobs import ChainJob
from enumerate.chains.query import ChainQuery
from enumerate.runner._run import run
from enumerate.runner.store import SqliteSink, read_meta, read_rows
from graphs.errors import StoreError

ROWS = [(n, n * n) for n in range(200)]


def files(folder):
    return sorted(path.name for path in folder.iterdir())


def test_a_reader_does_not_hinder_the_end(tmp_path):
    store = tmp_path / "squares.sqlite"
    told, readers = [], []

    def read(progress):
        if progress.done == 5:
            readers.append(read_rows(store))
            assert next(readers[0]) == (0, 0)

    run(Squares(), SqliteSink(store, tell=told.append), report=read)
    wal = f"{store}: complete, but another process has it open: squares.sqlite-wal belongs to it; "
    assert told == [wal + "try --resume to make it one file"]
    assert read_meta(store)["complete"] is True
    assert list(read_rows(store)) == ROWS
    assert len(list(readers[0])) == 49  # what was there when it began
    again = []
    assert run(Squares(), SqliteSink(store, resume=True, tell=again.append)).rows == 0
    assert again == []
    assert files(tmp_path) == ["squares.sqlite"]
    assert list(read_rows(store)) == ROWS


def test_without_anybody_to_tell_there_is_a_warning(tmp_path):
    store = tmp_path / "squares.sqlite"
    sink = SqliteSink(store)
    sink.start(Squares(10))
    sink.take(0, ROWS[:10], 0.0)
    with closing(read_rows(store)) as rows:
        next(rows)
        with pytest.warns(UserWarning, match="another process has it open"):
            sink.finish()


def test_a_complete_store_that_is_read_can_be_resumed(tmp_path):
    store = tmp_path / "squares.sqlite"
    run(Squares(), SqliteSink(store))
    with closing(read_rows(store)) as rows:
        next(rows)
        assert run(Squares(), SqliteSink(store, resume=True)).rows == 0
    assert files(tmp_path) == ["squares.sqlite"]


def test_a_reader_in_another_process(tmp_path):
    store = tmp_path / "squares.sqlite"
    program = "import sqlite3, sys; c = sqlite3.connect(sys.argv[1]); c.execute('BEGIN'); "
    program += "print(len(c.execute('SELECT * FROM type').fetchall()), flush=True); input()"
    started = []

    def read(progress):
        if progress.done == 5:
            started.append(
                subprocess.Popen(
                    [sys.executable, "-c", program, store], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
                )
            )
            assert started[0].stdout.readline() == "50\n"

    told = []
    run(Squares(), SqliteSink(store, tell=told.append), report=read)
    assert len(told) == 1
    assert list(read_rows(store)) == ROWS
    started[0].communicate("\n")
    run(Squares(), SqliteSink(store, resume=True))
    assert files(tmp_path) == ["squares.sqlite"]


def test_a_store_that_stays_locked_is_told_in_one_line(tmp_path, monkeypatch):
    store = tmp_path / "squares.sqlite"
    monkeypatch.setattr("enumerate.runner.store_units.PATIENCE", 0.1)
    sink = SqliteSink(store)
    sink.start(Squares())
    sink.take(0, ROWS[:10], 0.0)
    with closing(sqlite3.connect(store, isolation_level=None)) as other:
        other.execute("BEGIN IMMEDIATE")
        with pytest.raises(StoreError, match="database is locked: another process holds it; try --resume"):
            sink.take(1, ROWS[10:20], 0.0)
        other.execute("ROLLBACK")
    sink.take(1, ROWS[10:20], 0.0)
    sink.abort()
    assert list(read_rows(store)) == ROWS[:20]


def test_two_runs_and_a_reader_on_one_store(tmp_path):
    store = tmp_path / "squares.sqlite"
    one, other = SqliteSink(store), SqliteSink(store, resume=True)
    one.start(Squares(20))
    assert list(other.start(Squares(20))) == []
    one.take(0, ROWS[:10], 0.0)
    with closing(read_rows(store)) as rows:
        next(rows)
        with pytest.raises(StoreError, match="another run is writing"):
            other.take(0, ROWS[:10], 0.0)
        other.abort()
        one.take(1, ROWS[10:20], 0.0)
        with pytest.warns(UserWarning, match="complete, but another process"):
            one.finish()
    assert list(read_rows(store)) == ROWS[:20]


@pytest.mark.slow
@pytest.mark.parametrize(("later", "links", "dof"), [(False, 14, 1), (True, 15, 2)])
def test_two_runs_of_chains_and_a_reader_in_processes_of_their_own(tmp_path, later, links, dof):
    """The later run comes to a list so long that it begins while the first still writes."""
    job, store = ChainJob(ChainQuery(links, dof)), tmp_path / "chains.sqlite"
    run(job, SqliteSink(tmp_path / "whole.sqlite"), workers=2)
    whole = list(read_rows(tmp_path / "whole.sqlite"))
    words = enumerating("chains", "--links", links, "--dof", dof, "--workers", 1, "-o", store, "--resume")
    runs = [subprocess.Popen(words, stderr=subprocess.PIPE, text=True)]
    wait_for(lambda: units_in(store) >= 2 * later)
    runs.append(subprocess.Popen(words, stderr=subprocess.PIPE, text=True))
    wait_for(lambda: units_in(store) >= 1)
    held = 0
    while any(one.poll() is None for one in runs):
        rows = list(read_rows(store))
        assert held <= len(rows)
        assert rows == whole[: len(rows)]
        held = len(rows)
    told = [complaints(one.communicate()[1]) for one in runs]
    assert sorted(one.returncode for one in runs) == [0, 2]
    for one, lines in zip(runs, told, strict=True):
        if one.returncode:
            assert lines == [f"{store}: another run is writing to it"]
        else:
            assert all("complete, but another process has it open" in line for line in lines)
            assert len(lines) <= 1
    assert run(job, SqliteSink(store, resume=True)).rows == 0
    assert contents(store) == contents(tmp_path / "whole.sqlite")
    assert files(tmp_path) == ["chains.sqlite", "whole.sqlite"]
