"""The counter in C, the counter in Python, and all values tried one after the other."""

import _thread
import signal
import weakref
from itertools import product
from threading import Event

import numpy as np
import pytest
from folded_sheets import folded_sheet, unassigned_map

import synth
from synth.analysis.layering.counting import propagation
from synth.analysis.layering.counting.problem import LayerProblem, count_in_python, probe_in_python, solutions
from synth.analysis.layering.counting.propagation import ProblemInLibrary, kernel

needs_library = pytest.mark.skipif(kernel() is None, reason="there is no library: no compiler was at hand")


def random_problem(rng):
    count = int(rng.integers(3, 10))

    def rows(number, width):
        variables = [rng.permutation(count)[:width] for _ in range(number)]
        return np.array([2 * row + rng.integers(0, 2, width) for row in variables], dtype=np.int64).reshape(-1, width)

    four = rows(int(rng.integers(0, 3)), min(4, count))
    parities = np.full((len(four), 4), -1)
    parities[:, : four.shape[1]] = four
    return LayerProblem(count, rows(int(rng.integers(0, 8)), 3), rows(int(rng.integers(0, 4)), 2), parities)


def keeps(problem, values):
    def truths(row):
        return [values[literal >> 1] ^ literal & 1 for literal in row if literal >= 0]

    return (
        all(0 < sum(truths(row)) < 3 for row in problem.triples.tolist())
        and all(any(truths(row)) for row in problem.clauses.tolist())
        and all(sum(truths(row)) % 2 == 0 for row in problem.parities.tolist())
    )


@pytest.mark.parametrize("seed", range(60))
def test_counts_of_random_problems(seed):
    problem = random_problem(np.random.default_rng(seed))
    every = [list(values) for values in product((0, 1), repeat=problem.variables) if keeps(problem, values)]
    assert count_in_python(problem) == len(every)
    assert sorted(solutions(problem)) == every
    given = (2, 5)
    assert count_in_python(problem, given) == sum(values[1] == 1 and values[2] == 0 for values in every)
    if kernel() is not None:
        in_library = ProblemInLibrary(kernel(), problem)
        assert in_library.count(()) == len(every)
        assert in_library.count(given) == count_in_python(problem, given)
        assert in_library.probed().tolist() == probe_in_python(problem).tolist()
    fails = probe_in_python(problem)
    for literal in np.flatnonzero(fails).tolist():
        assert not any(values[literal >> 1] ^ literal & 1 for values in every)


@needs_library
@pytest.mark.parametrize("seed", [0, 1])
def test_whole_answers_with_and_without_the_library(seed, monkeypatch):
    sheet, _ = folded_sheet(np.random.default_rng(seed), 4, 30)
    with_it = [synth.layers(sheet).to_json(), synth.layers(unassigned_map(2, 4)).to_json()]
    monkeypatch.setattr(propagation, "kernel", lambda: None)
    assert [synth.layers(sheet).to_json(), synth.layers(unassigned_map(2, 4)).to_json()] == with_it


@needs_library
def test_more_than_128_bits_are_counted_in_python():
    free = np.empty((0, 2), dtype=np.int64)
    pairs = np.array([[4 * k, 4 * k + 2, 4 * k + 4] for k in range(80)])
    problem = LayerProblem(162, pairs, free, np.empty((0, 4), dtype=np.int64))
    assert ProblemInLibrary(kernel(), problem).count(()) is None
    assert propagation.counted(problem) > 2**128


@pytest.fixture
def ctrl_c():
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield _thread.interrupt_main
    signal.signal(signal.SIGINT, before)


def test_an_interrupted_count_is_stopped_and_keeps_its_memory_until_it_ends(ctrl_c, monkeypatch):
    arrays, left, ended, seen = [], Event(), Event(), []

    def zeros(*size, **kind):
        array = np.empty(*size, **kind)
        array[...] = 0
        arrays.append(weakref.ref(array))
        return array

    class Library:
        def counted(self, *_):
            ctrl_c()
            left.wait(60)  # the caller has gone
            seen.extend(None if array() is None else array()[0] for array in arrays)
            ended.set()
            return 1

    problem = ProblemInLibrary(Library(), random_problem(np.random.default_rng(0)))
    monkeypatch.setattr(propagation.np, "zeros", zeros)
    interrupted = False
    try:
        problem.count(())
    except KeyboardInterrupt:
        interrupted = True
    monkeypatch.undo()
    left.set()
    assert interrupted
    assert ended.wait(60)
    assert seen == [1, 0, 0]
