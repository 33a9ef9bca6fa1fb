"""Dask clusters that are not there, or go while a run works on them."""

import socket
import threading
from contextlib import closing

import pytest
from clusters import cluster, free_port
from commands import run as command_line
from toy_job import Squares

from enumerate.runner._run import run
from enumerate.runner.sinks import RowSink
from enumerate.runner.store import SqliteSink, read_meta, read_rows
from graphs.errors import StoreError

distributed = pytest.importorskip("distributed", reason="needs Dask: pip install 'synthedra[dask]'")
ROWS = [(n, n * n) for n in range(200)]


@pytest.mark.parametrize("name", ["chains.sqlite", "chains.jsonl", "chains"])
def test_a_scheduler_that_is_not_there_leaves_nothing_behind(tmp_path, name):
    command = ("enumerate", "chains", "--links", 8, "--dof", 1, "-o", tmp_path / name)
    for address in (f"tcp://127.0.0.1:{free_port()}", "127.0.0.1:99999"):
        told = command_line(*command, "--scheduler", address, code=2).stderr.splitlines()
        assert len(told) == 1
        assert f"no Dask scheduler at '{address}'" in told[0]
    assert list(tmp_path.iterdir()) == []


def test_a_scheduler_that_is_killed_gives_one_line_and_the_store_stays(tmp_path, capfd):
    store = tmp_path / "squares.sqlite"
    with cluster(tmp_path, 1) as (address, processes):

        def kill(progress):
            if progress.done == 3:
                processes[0].kill()

        with pytest.raises(StoreError, match=r"lost the Dask scheduler at .*; try --resume"):
            run(Squares(10_000), SqliteSink(store), scheduler=address, report=kill)
    assert capfd.readouterr() == ("", "")
    stored = len(list(read_rows(store)))
    assert 30 <= stored < 10_000
    assert read_meta(store)["complete"] is False
    assert run(Squares(10_000), SqliteSink(store, resume=True)).rows == 10_000 - stored
    assert list(read_rows(store)) == [(n, n * n) for n in range(10_000)]


class _Future:
    """A future of Dask as the runner may use it: asked when it is done, and not before."""

    def __init__(self, value):
        self._value, self._done = value, threading.Event()

    def add_done_callback(self, function):
        def end():
            self._done.set()
            function(self)

        threading.Timer(0.001, end).start()

    def done(self):
        return self._done.is_set()

    def result(self, timeout=None):
        assert timeout is None, "a race in Dask: its result may end by the timeout and be lost"
        assert self._done.is_set()
        return self._value


class _Client:
    """A client of Dask with one worker, which is this process."""

    status = "running"

    def __init__(self, address, **options):
        pass

    def scheduler_info(self, n_workers):
        return {"workers": {"one": {}}}

    def submit(self, function, *arguments, pure):
        return _Future(function(*arguments))

    def close(self, timeout=None):
        pass


def test_results_are_taken_when_they_are_there(monkeypatch):
    monkeypatch.setattr(distributed, "Client", _Client)
    found = []
    with closing(socket.create_server(("127.0.0.1", 0))) as scheduler:
        address = f"tcp://127.0.0.1:{scheduler.getsockname()[1]}"
        run(Squares(), RowSink(lambda columns, rows: found.extend(rows)), scheduler=address)
    assert found == ROWS
