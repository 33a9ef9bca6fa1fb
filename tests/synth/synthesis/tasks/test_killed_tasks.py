"""Tasks with several workers, and killed at random moments: the report of one worker that nobody disturbed."""

import json
import random
import signal
import subprocess
from pathlib import Path

import pytest
from clusters import cluster
from runs import SYNTH, contents, kill, units_in, wait_for

import synth

pytestmark = pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="looks for worker processes in /proc")

KILLS = 5
ROUNDS = 2


def command(data, folder, name, workers, *words):
    store, report = folder / name, folder / f"{name}.html"
    options = ["--starts", "1", "--rounds", str(ROUNDS), "--store", str(store), "--report", str(report)]
    task = data / "tasks" / "on-a-cone.json"
    return [*SYNTH, "task", str(task), *options, "--workers", str(workers), "--json", *words]


def units(store):
    return sum(units_in(store / f"round-{number}.sqlite") for number in range(ROUNDS))


def finished(words):
    done = subprocess.run(words, check=True, timeout=600, capture_output=True)
    answer = json.loads(done.stdout)
    del answer["written"]
    return answer


@pytest.mark.slow
def test_a_task_that_is_killed_five_times_gives_the_same_report(data, tmp_path):
    alone = finished(command(data, tmp_path, "alone", 1))
    assert finished(command(data, tmp_path, "two", 2)) == alone
    dice, held = random.Random(45), []
    store = tmp_path / "killed"
    for _ in range(KILLS):
        held.append(units(store))
        words = ("--resume",) if store.exists() else ()
        process = subprocess.Popen(command(data, tmp_path, "killed", 2, *words), stdout=subprocess.DEVNULL)
        wait_for(lambda before=held[-1], run=process: units(store) > before or run.poll() is not None)
        kill(process, dice, longest=1.0)
        assert process.returncode in (-signal.SIGKILL, 0)
    assert held == sorted(held)
    assert held[-1] > 0
    assert finished(command(data, tmp_path, "killed", 2, "--resume", "--force")) == alone
    reports = {(tmp_path / f"{name}.html").read_bytes() for name in ("alone", "two", "killed")}
    assert len(reports) == 1
    for number in range(ROUNDS):
        stores = [contents(tmp_path / name / f"round-{number}.sqlite") for name in ("alone", "two", "killed")]
        assert stores[0] == stores[1] == stores[2]


@pytest.mark.slow
def test_a_cluster_that_loses_a_worker_gives_the_same_answer(data, tmp_path):
    pytest.importorskip("distributed", reason="needs Dask: pip install 'synthedra[dask]'")
    task, starts = data / "tasks" / "lid.json", {"starts": 6, "rounds": 1}
    alone = synth.task(task, **starts)
    with cluster(tmp_path, 2) as (address, processes):

        def lose(_round, progress):
            if progress.done == 1:
                processes[1].kill()

        found = synth.task(task, **starts, store=tmp_path / "store", scheduler=address, report=lose)
    assert found.to_json() == alone.to_json()
    assert units_in(tmp_path / "store" / "round-0.sqlite") == 6
