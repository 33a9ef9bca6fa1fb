"""The word to the user: once in a run."""

import re

import pytest
from toy_kernels import make_toy, run

from enumerate.machine_code import kernels
from enumerate.machine_code.folders import INTERPRETED, compiled, compiling, heard_by, on_compiling, to_workers

WORKERS = """
import json, sys
from concurrent.futures import ProcessPoolExecutor
from enumerate.machine_code.folders import heard_by, on_compiling, to_workers
from toy.outer import outer

def tell(folder, possible):
    print("compiling", folder is not None, possible, file=sys.stderr, flush=True)

on_compiling(tell)
with ProcessPoolExecutor(2, initializer=heard_by, initargs=(to_workers(),)) as pool:
    values = list(pool.map(outer, [4, 4.5]))
print(json.dumps([*values, outer(4)]))
"""


def test_the_user_is_told_once():
    told = []
    on_compiling(lambda *word: told.append(word))
    try:
        compiling()
        compiling()
    finally:
        on_compiling(None)
    compiling()
    assert len(told) == 1


def test_a_worker_tells_if_nobody_has():
    told = []
    on_compiling(lambda *word: told.append(word))
    try:
        shared = to_workers()
        for _ in range(3):  # as if in three workers
            heard_by(shared)
            compiling()
        assert len(told) == 1
        on_compiling(lambda *word: told.append(word))
        compiling()
        heard_by(to_workers())
        compiling()
        assert len(told) == 2
    finally:
        on_compiling(None)
    assert to_workers() is None


def test_progress_is_shown_by_the_process_that_tells():
    """Also of functions that are compiled on the way of others; not by those that did not tell."""
    told, steps = [], []
    on_compiling(lambda *word: told.append(word), lambda *counts: steps.append(counts))
    try:
        shared = to_workers()
        heard_by(shared)
        compiling()
        compiling()
        compiled()
        compiled()
        heard_by(shared)  # as if in another worker
        compiling()
        compiled()
    finally:
        on_compiling(None)
    compiling()
    compiled()
    assert (len(told), steps) == (1, [(1, 0), (2, 0), (2, 1), (2, 2)])


@pytest.mark.slow
def test_each_function_that_is_compiled_is_counted(tmp_path):
    make_toy(tmp_path)
    counted = """
import json, sys
from enumerate.machine_code.folders import on_compiling
from toy.outer import outer

steps = []
on_compiling(lambda *word: None, lambda *counts: steps.append(counts))
outer(4)
begun, done = steps[-1]
print(json.dumps([begun == done, begun == sum(1 for one, other in zip([(0, 0), *steps], steps) if other[1] > one[1])]))
"""
    values, _ = run(counted, tmp_path, tmp_path / "cache")
    assert values == [True, True]


def test_without_numba_kernels_stay_interpreted_and_the_user_is_told_once(monkeypatch):
    monkeypatch.setattr(kernels, "can_compile", lambda: False)
    monkeypatch.setattr(kernels, "_dispatcher", lambda function: pytest.fail(f"{function} is compiled"))
    monkeypatch.setattr(kernels._kernels, "used", False)
    told = []
    on_compiling(lambda *word: told.append(word))
    try:
        kernels.use_machine_code()
        kernels.use_machine_code()
    finally:
        on_compiling(None)
    assert (told, kernels.uses_machine_code()) == ([(None, False)], False)
    with pytest.warns(UserWarning, match=re.escape(INTERPRETED)):  # where nobody is to be notified
        kernels.use_machine_code()
    kernels.use_machine_code()  # a second warning would be an error
    on_compiling(None)


@pytest.mark.slow
def test_one_process_of_several_tells(tmp_path):
    make_toy(tmp_path)
    values, told = run(WORKERS, tmp_path, tmp_path / "cache")
    assert values == [50, 55, 50]
    assert told == "compiling True True\n"
