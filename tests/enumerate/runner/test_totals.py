"""Counts that are kept while they grow: runs that are stopped or killed, and go on."""

import json
import os
import random
import signal
import sqlite3
import subprocess
import sys
from contextlib import closing
from pathlib import Path

import pytest
from commands import run as command_line
from runs import contents, enumerating, kill, units_in, wait_for

from enumerate.chains.jobs import CountJob, count_job
from enumerate.chains.query import ChainQuery
from enumerate.runner._run import run
from enumerate.runner.sinks import CountSink
from enumerate.runner.stopping import Interrupted
from enumerate.runner.store import SqliteSink, read_meta, read_rows
from graphs.errors import StoreError

TWELVE = ("enumerate", "chains", "--links", 12, "--dof", 1, "--count")
BY_SIZE = {8: 410, 7: 1873, 6: 2845, 5: 1413, 4: 293, 3: 20, 2: 2}

_KILLED = """
import os, signal, sys
from enumerate.chains.jobs import count_job
from enumerate.chains.query import ChainQuery
from enumerate.runner._run import run
from enumerate.runner.store import SqliteSink
from enumerate.runner.sinks import CountSink

def report(progress):
    if progress.done == int(sys.argv[2]):
        os.kill(os.getpid(), signal.SIGKILL)

run(count_job(ChainQuery(12, 1), "burnside"), CountSink(SqliteSink(sys.argv[1], resume=True)), report=report)
"""
"""A process that counts, and is killed when the store has so many units."""


def test_a_count_that_is_killed_goes_on(tmp_path):
    job, store = count_job(ChainQuery(12, 1), "burnside"), tmp_path / "counts.sqlite"
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    script = [sys.executable, "-c", _KILLED, str(store), "4"]
    assert subprocess.run(script, env=environment, check=False).returncode == -signal.SIGKILL
    assert units_in(store) == 4 < len(job.units())
    assert read_meta(store)["complete"] is False
    told = []
    sink = CountSink(SqliteSink(store, resume=True))
    run(job, sink, report=lambda progress: told.append(progress.done))
    assert told == list(range(5, len(job.units()) + 1))  # no unit again
    assert sink.total == 6856
    assert sink.by("contracted_links") == BY_SIZE
    assert len(list(read_rows(store))) == len(job.units())


def test_the_command_goes_on_and_prints_the_number(tmp_path):
    store, whole = tmp_path / "counts.sqlite", tmp_path / "whole.sqlite"
    assert command_line(*TWELVE, "-o", whole).stdout == "6856\n"

    def press(progress):
        if progress.done == 3:
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(Interrupted):
        run(count_job(ChainQuery(12, 1), "orbits"), CountSink(SqliteSink(store)), report=press)
    assert units_in(store) == 3
    document = json.loads(command_line(*TWELVE, "--json", "-o", store, "--resume").stdout)
    assert document["count"] == 6856
    assert {int(links): count for links, count in document["by_size"].items()} == BY_SIZE
    assert contents(store) == contents(whole)
    assert command_line(*TWELVE, "-o", store, "--resume").stdout == "6856\n"  # complete: read, not counted
    assert "exists already" in command_line(*TWELVE, "-o", store, code=2).stderr


@pytest.mark.parametrize("method", ["orbits", "burnside"])
@pytest.mark.parametrize("options", [{}, {"assortment": (7, 2, 3)}, {"planar": True}, {"longest_string": (1, 1)}])
def test_units_that_make_their_graphs_count_the_same(method, options):
    """As from nine loops on; here with five."""
    query, counted = ChainQuery(12, 1, **options), []
    for streamed in (False, True):
        sink = CountSink()
        run(CountJob(query, method, streamed), sink)
        counted.append({links: count for links, count in sink.by("contracted_links").items() if count})
    assert counted[0] == counted[1] != {}
    if not options:
        assert counted[1] == BY_SIZE


def test_a_store_with_units_of_graphs_goes_on_with_them():
    query = ChainQuery(20, 1)
    assert count_job(query, "orbits").streamed
    assert count_job(query, "orbits", CountJob(query, "orbits", True).key).streamed
    assert not count_job(query, "orbits", CountJob(query, "orbits").key).streamed
    assert not count_job(ChainQuery(16, 1), "orbits").streamed  # 17 133 graphs are soon made


@pytest.mark.slow
def test_the_command_goes_on_with_units_of_graphs(tmp_path):
    store = tmp_path / "counts.sqlite"

    def press(progress):
        if progress.done == 3:
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(Interrupted):
        run(CountJob(ChainQuery(18, 1), "burnside"), CountSink(SqliteSink(store)), report=press)
    words = ("enumerate", "chains", "--links", 18, "--dof", 1, "--count", "--method", "burnside", "--workers", 2)
    assert command_line(*words, "-o", store, "--resume").stdout == "1535380884\n"
    assert "graphs_of_a_unit" in read_meta(store)["job"]


def test_a_store_that_says_nothing_yet_goes_on(tmp_path):
    """A run may be killed before it has written what it is."""
    store = tmp_path / "counts.sqlite"
    store.touch()
    assert command_line(*TWELVE, "-o", store, "--resume").stdout == "6856\n"


@pytest.mark.parametrize("other", [("--method", "burnside"), ("--inversions",)])
def test_a_store_of_another_count_is_refused(tmp_path, other):
    store = tmp_path / "counts.sqlite"
    run(count_job(ChainQuery(8, 1), "orbits"), CountSink(SqliteSink(store)))
    words = ("enumerate", "chains", "--links", 8, "--dof", 1, "--count", *other, "-o", store, "--resume")
    assert "holds another run" in command_line(*words, code=2).stderr
    assert sum(count for count, _ in read_rows(store)) == 16


def test_a_number_that_was_altered_is_counted_again(tmp_path):
    store = tmp_path / "counts.sqlite"
    job = count_job(ChainQuery(10, 1), "orbits")
    run(job, CountSink(SqliteSink(store)))
    with closing(sqlite3.connect(store)) as connection, connection:
        connection.execute("UPDATE type SET count = count + 1 WHERE rowid = 2")
    with pytest.raises(StoreError, match="damaged at unit 1"):
        list(read_rows(store))
    told = []
    sink = CountSink(SqliteSink(store, resume=True, tell=told.append))
    run(job, sink)
    assert sink.total == 230
    assert ["repaired a damaged store" in line for line in told] == [True]


@pytest.mark.parametrize(
    "words",
    [
        ("sc", "--links", 8, "--dof", 1),
        ("scd", "--links", 6, "--dof", 1, "--max-degree", 4),
        ("conical", "--chain", "watt", "--ground", "0", "--slots", 8),
    ],
    ids=lambda words: words[0],
)
def test_every_count_can_be_kept(tmp_path, words):
    store = tmp_path / "counts.sqlite"
    printed = command_line("enumerate", *words, "--count").stdout
    assert int(printed) > 0
    for _ in range(2):
        assert command_line("enumerate", *words, "--count", "-o", store, "--resume").stdout == printed


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="looks for worker processes in /proc")
@pytest.mark.parametrize("method", ["orbits", "burnside"])
@pytest.mark.parametrize(("links", "longest", "number"), [(16, 0.02, 19_819_281), (18, 0.5, 1_535_380_884)])
def test_a_count_that_is_killed_ten_times_is_the_same(tmp_path, links, longest, number, method):
    store = tmp_path / "counts.sqlite"
    words = enumerating("chains", "--links", links, "--dof", 1, "--count", "--method", method, "--workers", 2)
    words += ["-o", str(store), "--resume"]
    dice = random.Random(links)
    for _ in range(10):
        before = units_in(store)
        process = subprocess.Popen(words, stdout=subprocess.DEVNULL)
        wait_for(lambda held=before, going=process: units_in(store) > held or going.poll() is not None)
        kill(process, dice, longest)
    assert not read_meta(store)["complete"]
    done = subprocess.run(words, stdout=subprocess.PIPE, text=True, check=True)
    assert done.stdout == f"{number}\n"
    numbers = [unit for (unit, *_) in contents(store)[0]]
    assert numbers == list(range(len(numbers)))
    assert read_meta(store)["complete"] is True
