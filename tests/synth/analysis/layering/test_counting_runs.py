"""Counts as a job: cases that add up, equal problems once, stores that are continued, workers."""

import json

import numpy as np
import pytest
from clusters import cluster
from commands import run as command
from folded_sheets import unassigned_map

import synth
from enumerate.runner._run import run
from enumerate.runner.store import SqliteSink, read_rows
from graphs.files.formats import write
from synth.analysis.layering import LayerCountJob, counted, numbers_of


def job_of(rows, columns):
    parts = synth.layers(unassigned_map(rows, columns)).parts
    return LayerCountJob(tuple(problem for part in parts for problem, _ in part.problems))


def test_cases_add_up_and_equal_problems_are_counted_once():
    job = job_of(2, 6)
    assert 1 < len(job.units()) <= 16
    assert numbers_of(job) == [10512]
    twice = LayerCountJob(job.problems * 2)
    assert len(twice.units()) == len(job.units())
    assert numbers_of(twice) == [10512, 10512]
    assert twice.key == job.key


def test_a_stopped_count_is_continued(tmp_path, monkeypatch):
    job, store = job_of(2, 6), tmp_path / "counts.sqlite"
    done = []

    def fails_later(self, payload):
        if len(done) == 5:
            raise MemoryError("no memory")
        done.append(payload)
        return [(payload[0], payload[1], str(counted(self.problems[payload[0]], payload[2])))]

    with monkeypatch.context() as patched:
        patched.setattr(LayerCountJob, "work", fails_later)
        with pytest.raises(MemoryError):
            run(job, SqliteSink(store))
    assert len(list(read_rows(store))) == 5
    write(unassigned_map(2, 6), tmp_path / "map.fold")
    answer = json.loads(command("layers", tmp_path / "map.fold", "--counts", store, "--resume", "--json").stdout)
    assert answer["orders"] == 10512
    assert len(list(read_rows(store))) == len(job.units())
    assert sum(int(number) for *_, number in read_rows(store)) == 10512
    write(unassigned_map(2, 7), tmp_path / "other.fold")
    told = command("layers", tmp_path / "other.fold", "--counts", store, "--resume", code=2).stderr
    assert "counts.sqlite" in told
    assert "--resume requires --counts STORE" in command("layers", tmp_path / "map.fold", "--resume", code=2).stderr


def test_workers_count_the_same():
    assert synth.layers(unassigned_map(2, 6), workers=2).orders == 10512


@pytest.mark.slow
def test_a_cluster_that_loses_a_worker_counts_the_same(tmp_path):
    pytest.importorskip("distributed", reason="needs Dask: pip install 'synthedra[dask]'")
    job, store = job_of(2, 6), tmp_path / "counts.sqlite"
    write(unassigned_map(2, 5), tmp_path / "map.fold")
    with cluster(tmp_path, 2) as (address, processes):

        def kill(progress):
            if progress.done == 3:
                processes[2].kill()

        run(job, SqliteSink(store), scheduler=address, report=kill)
        words = (
            "layers",
            tmp_path / "map.fold",
            "--counts",
            tmp_path / "more.sqlite",
            "--scheduler",
            address,
            "--json",
        )
        assert json.loads(command(*words).stdout)["orders"] == 1980
    rows = list(read_rows(store))
    assert len(rows) == len(job.units())
    assert numbers_of(job, rows) == [10512]


def test_numbers_of_any_size():
    free = np.empty((0, 2), dtype=np.int64), np.empty((0, 4), dtype=np.int64)
    from synth.analysis.layering.counting.problem import LayerProblem

    pairs = np.array([[4 * k, 4 * k + 2, 4 * k + 4] for k in range(80)])
    assert numbers_of(LayerCountJob((LayerProblem(162, pairs, *free),)))[0] > 2**128
