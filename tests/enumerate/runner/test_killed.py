"""Runs that are killed, or lose a worker, at random moments: what they leave, and how they go on."""

import os
import random
import signal
import sqlite3
import subprocess
import sys
from contextlib import closing, contextmanager
from pathlib import Path

import pytest
from clusters import cluster
from runs import complaints, contents, enumerating, kill, units_in, wait_for
from toy_job import Squares

from enumerate.chains.jobs import ChainJob, count_chains
from enumerate.chains.query import ChainQuery
from enumerate.runner._run import run
from enumerate.runner.sinks import sink_for
from enumerate.runner.store import SqliteSink, read_meta

pytestmark = pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="looks for worker processes in /proc")

RUNS = {
    "chains": ("chains", "--links", 13, "--dof", 2, "--symmetry", "4.."),
    "sc": ("sc", "--links", 12, "--dof", 1, "--symmetry", "2.."),
    "scd": ("scd", "--links", 8, "--dof", 1, "--max-degree", 5, "--symmetric"),
    "conical": ("conical", "--chain", "watt", "--ground", "0", "--slots", 8),
}
"""Runs of two and more units, and some seconds; of their rows few enough are kept for a folder."""

FILES = ("rows.jsonl", "rows.parquet", "rows")


def command(name, place, *words):
    return enumerating(*RUNS[name], "--workers", 2, "-o", place, *words)


def resuming(words, store):
    return [*words, *(["--resume"] if store.exists() else [])]


def bytes_at(place):
    """All bytes of a file, or of the files of a folder by their names."""
    return {path.name: path.read_bytes() for path in (place.iterdir() if place.is_dir() else [place])}


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    """What a run that nobody kills writes, by its name and the name of what it writes."""
    made = {}

    def place_of(name, output):
        if (name, output) not in made:
            place = tmp_path_factory.mktemp(name) / output
            subprocess.run(command(name, place), check=True, timeout=600)
            made[name, output] = place
        return made[name, output]

    return place_of


@pytest.mark.slow
@pytest.mark.parametrize("name", RUNS)
def test_a_store_of_runs_that_are_killed_is_that_of_one_that_is_not(tmp_path, undisturbed, name):
    store, dice = tmp_path / "rows.sqlite", random.Random(name)
    held = []
    for _ in range(20):
        before = units_in(store)
        held.append(before)
        process = subprocess.Popen(resuming(command(name, store), store))
        if dice.random() < 0.5:
            wait_for(lambda held=before, run=process: units_in(store) > held or run.poll() is not None)
            kill(process, dice, longest=0.3)
        else:
            kill(process, dice, longest=2.0)
        assert process.returncode in (-signal.SIGKILL, 0)
    assert held == sorted(held)
    subprocess.run(resuming(command(name, store), store), check=True, timeout=600)
    assert contents(store) == contents(undisturbed(name, store.name))
    assert read_meta(store)["complete"] is True
    assert [path.name for path in tmp_path.iterdir()] == [store.name]


@pytest.mark.slow
@pytest.mark.parametrize("output", FILES)
@pytest.mark.parametrize("name", RUNS)
def test_runs_that_are_killed_leave_nothing_at_the_place(tmp_path, undisturbed, name, output):
    killed_until_one_is_left(tmp_path / output, undisturbed(name, output), name)


@pytest.mark.slow
def test_runs_to_graph6_that_are_killed_leave_nothing_at_the_place(tmp_path, undisturbed):
    killed_until_one_is_left(tmp_path / "rows.g6", undisturbed("chains", "rows.g6"), "chains")


def killed_until_one_is_left(place, whole, name):
    """Kill runs to one place again and again; look what is there, and that the next one is not hindered."""
    dice = random.Random(f"{name} {place.name}")
    for _ in range(5):
        process = subprocess.Popen(command(name, place))
        kill(process, dice, longest=4.0)
        assert process.returncode in (-signal.SIGKILL, 0)
        if process.returncode == 0:
            assert place.exists()
        if place.exists():  # it was killed when it had moved it there, at the earliest
            assert bytes_at(place) == bytes_at(whole)
            remove(place)
        left = [path.name for path in place.parent.iterdir()]
        assert len(left) <= 1  # that of this run: those of the runs before have been removed
        assert all(name.startswith(f".{place.name}.") and name.endswith(".unfinished") for name in left)
    subprocess.run(command(name, place), check=True, timeout=600)
    assert bytes_at(place) == bytes_at(whole)
    assert [path.name for path in place.parent.iterdir()] == [place.name]


def remove(place):
    for path in place.iterdir() if place.is_dir() else [place]:
        path.unlink()
    if place.is_dir():
        place.rmdir()


_HALF = """
import os, signal, sys
from enumerate.runner.sinks import sink_for
from toy_job import Squares

for place in sys.argv[1:]:
    sink = sink_for(place)
    sink.start(Squares())
    sink.take(0, Squares().work(0), 0.0)
os.kill(os.getpid(), signal.SIGKILL)
"""
"""A process that is killed with one unit in each of some sinks."""


def test_the_next_run_removes_what_a_killed_one_left(tmp_path):
    places = [tmp_path / name for name in ("rows.jsonl", "rows.parquet", "rows.sqlite")]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    done = subprocess.run([sys.executable, "-c", _HALF, *places], env=environment, check=False)
    assert done.returncode == -signal.SIGKILL
    assert [place.exists() for place in places] == [False, False, True]
    assert len(list(tmp_path.glob(".rows.*"))) == 2
    for place in places:
        whole = tmp_path / f"whole{place.suffix}"
        run(Squares(), sink_for(place, resume=place.exists()))
        run(Squares(), sink_for(whole))
        if place.suffix == ".sqlite":
            assert contents(place) == contents(whole)
        else:
            assert place.read_bytes() == whole.read_bytes()
        whole.unlink()
    assert sorted(tmp_path.iterdir()) == places


def killed_and_resumed(store, links, dof, kills, longest):
    """Kill a run, or one of its workers, at random moments after it stored something; go on until it ends by itself.

    Return how often.
    """
    words = enumerating("chains", "--links", links, "--dof", dof, "--workers", 2, "-o", store)
    dice = random.Random(links)
    done = 0
    while True:
        before = units_in(store)
        process = subprocess.Popen(resuming(words, store))
        if done < kills:
            wait_for(lambda held=before, run=process: units_in(store) > held or run.poll() is not None)
            kill(process, dice, longest)
        code = process.wait(timeout=1800)
        if code == 0:
            return done
        assert code == -signal.SIGKILL
        done += 1


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The store of a run that nobody stopped."""
    store = tmp_path_factory.mktemp("whole") / "whole.sqlite"
    run(ChainJob(ChainQuery(13, 2)), SqliteSink(store), workers=2)
    return contents(store)


def test_killed_runs_lose_nothing(tmp_path, whole):
    store = tmp_path / "chains.sqlite"
    assert killed_and_resumed(store, 13, 2, kills=1, longest=0.3) >= 1
    assert contents(store) == whole
    assert len({row[2] for row in whole[1]}) == count_chains(13, 2, "burnside") == 27_496


@pytest.mark.slow
def test_a_cluster_that_loses_a_worker_gives_the_same_rows(tmp_path, whole):
    pytest.importorskip("distributed", reason="needs Dask: pip install 'synthedra[dask]'")
    store = tmp_path / "chains.sqlite"
    with cluster(tmp_path, 2) as (address, processes), on_cluster(address, store, 13, 2) as running:
        wait_for(lambda: units_in(store) or running.poll() is not None)
        assert running.poll() is None
        processes[1].kill()
        assert complaints(running.communicate(timeout=120)[1]) == []
        assert running.returncode == 0
    assert contents(store) == whole


@contextmanager
def on_cluster(address, store, links, dof):
    """A run on a cluster, which ends here at the latest."""
    words = enumerating("chains", "--links", links, "--dof", dof, "--scheduler", address, "-o", store)
    with subprocess.Popen(resuming(words, store), stderr=subprocess.PIPE, text=True) as running:
        try:
            yield running
        finally:
            running.kill()


@pytest.mark.slow
@pytest.mark.parametrize("again", ["locally", "on another cluster"])
def test_a_cluster_that_loses_a_worker_and_then_its_scheduler(tmp_path, again):
    pytest.importorskip("distributed", reason="needs Dask: pip install 'synthedra[dask]'")
    store, undisturbed = tmp_path / "chains.sqlite", tmp_path / "undisturbed.sqlite"
    with cluster(tmp_path, 2) as (address, processes), on_cluster(address, store, 14, 1) as running:
        wait_for(lambda: units_in(store) or running.poll() is not None)
        processes[1].kill()
        held = units_in(store)
        wait_for(lambda: units_in(store) >= held + 3 or running.poll() is not None)  # on the worker that is left
        assert running.poll() is None
        processes[0].kill()
        [told] = complaints(running.communicate(timeout=120)[1])
        assert told == f"lost the Dask scheduler at {address!r}; try --resume: stored units are kept"
        assert running.returncode == 2
    assert held + 3 <= units_in(store) < 22
    assert read_meta(store)["complete"] is False
    if again == "locally":
        run(ChainJob(ChainQuery(14, 1)), SqliteSink(store, resume=True), workers=2)
    else:
        with cluster(tmp_path, 2) as (address, _), on_cluster(address, store, 14, 1) as running:
            assert complaints(running.communicate(timeout=600)[1]) == []
            assert running.returncode == 0
    run(ChainJob(ChainQuery(14, 1)), SqliteSink(undisturbed), workers=2)
    assert contents(store) == contents(undisturbed)
    assert read_meta(store)["complete"] is True


@pytest.mark.slow
def test_a_long_run_on_a_cluster(tmp_path):
    pytest.importorskip("distributed", reason="needs Dask: pip install 'synthedra[dask]'")
    store = tmp_path / "chains.sqlite"
    with cluster(tmp_path, 2) as (address, _), on_cluster(address, store, 15, 2) as running:
        assert complaints(running.communicate(timeout=3000)[1]) == []
        assert running.returncode == 0
    with closing(sqlite3.connect(store)) as connection:
        assert connection.execute("SELECT count(*), count(DISTINCT code) FROM type").fetchone() == (1_432_730,) * 2
    assert read_meta(store)["complete"] is True


@pytest.mark.slow
@pytest.mark.parametrize(("links", "dof", "longest", "number"), [(15, 2, 0.5, 1_432_730), (16, 1, 10.0, 19_819_281)])
def test_long_runs_that_are_killed_lose_nothing(tmp_path, links, dof, longest, number):
    whole = tmp_path / "whole.sqlite"
    run(ChainJob(ChainQuery(links, dof)), SqliteSink(whole), workers=2)
    store = tmp_path / "chains.sqlite"
    assert killed_and_resumed(store, links, dof, kills=10, longest=longest) == 10
    with closing(sqlite3.connect(store)) as connection:
        connection.execute("ATTACH ? AS whole", (str(whole),))
        for table in ("type", "unit"):
            columns = "rowid, *" if table == "type" else "id, state, first, rows"
            one, other = f"SELECT {columns} FROM main.{table}", f"SELECT {columns} FROM whole.{table}"
            assert connection.execute(f"SELECT count(*) FROM ({one} EXCEPT {other})").fetchone() == (0,)
            assert connection.execute(f"SELECT count(*) FROM ({other} EXCEPT {one})").fetchone() == (0,)
        assert connection.execute("SELECT count(*), count(DISTINCT code) FROM type").fetchone() == (number,) * 2
