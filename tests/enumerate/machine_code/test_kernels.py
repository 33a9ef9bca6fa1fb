"""Kernels: the same interpreted and as machine code; small commands need no numba."""

import importlib.metadata
import json
import os
import subprocess
import sys

import numpy as np
import pytest
from commands import run as run_command
from toy_kernels import ROOT, make_toy, run

import synth
from enumerate.kernel import words
from enumerate.machine_code import weights
from enumerate.machine_code.folders import INTERPRETED
from enumerate.runner._run import rows_of
from enumerate.runner.job import Unit

ALL = (1 << 64) - 1
SWITCH = """
import json, sys
from toy import outer
from toy.outer import outer as named
from enumerate.machine_code.kernels import compiled_here, use_machine_code, uses_machine_code
before = [named(4), uses_machine_code(), "numba" in sys.modules]
use_machine_code()
import toy.inner
print(json.dumps([before, named(4), uses_machine_code(), "numba" in sys.modules, named is outer.outer,
    hasattr(named, "py_func"), hasattr(toy.inner.inner, "py_func"), compiled_here()]))
"""
SMALL = [
    "chains --links 8 --dof 1 --count",
    "chains --links 8 --dof 1 --json",
    "sc --links 6 --dof 1 --json",
    "scd --links 6 --dof 1 --max-degree 4 --count",
    "scd --links 4 --dof 1 --max-degree 4 --json",
    "conical --chain watt --ground 0 --slots 8 --count",
    "conical --chain four-bar --ground 0 --slots 8 --json",
]
SEVERAL = """
import hashlib, json, sys
import numpy as np
from enumerate.chains import ChainJob, ChainQuery, count_job
from enumerate.conical import ConicalQuery, count_conical_orders
from enumerate.conical.rounds import fewest_layers
from enumerate.runner._run import tuples_of
from enumerate.sc import SCJob, SCQuery, sc_count_job, sc_graphs
from enumerate.scd import SCDJob, all_mechanisms, scd_count_job, simplest_scd_graph

def word(rows):
    return hashlib.sha256(json.dumps(rows).encode()).hexdigest()

four_bar = tuple(zip("OABC", [(0, 1), (1, 2), (2, 3), (3, 0)]))
query = SCQuery(6, 1, infinite=True)
jobs = [
    ChainJob(ChainQuery(8, 1)), ChainJob(ChainQuery(9, 2, inputs=True)), ChainJob(ChainQuery(8, 1, inversions=True)),
    count_job(ChainQuery(10, 1), "burnside"), count_job(ChainQuery(10, 1), "orbits"),
    count_job(ChainQuery(9, 2, inversions=True), "orbits"),
    SCJob(SCQuery(8, 1)), SCJob(query), sc_count_job(SCQuery(8, 1), "burnside"), sc_count_job(SCQuery(8, 1), "orbits"),
    SCDJob(all_mechanisms(4, 3, 4)), SCDJob(all_mechanisms(6, 1, 4)), scd_count_job(all_mechanisms(6, 1, 4), "burnside"),
]
dice = np.random.default_rng(1)
print(json.dumps([
    *(word(list(tuples_of(job))) for job in jobs),
    count_conical_orders(ConicalQuery(four_bar, (0,), slots=9), "orbits"),
    fewest_layers(dice.integers(1, 63, (20, 6, 2))).tolist(),
    [simplest_scd_graph(graph, 6).graph["code"] for graph in sc_graphs(6, 1)],
    "numba" in sys.modules,
]))
"""


def answer(code, way, cache, **more):
    """Run Python with kernels interpreted or as machine code; return what it printed as JSON."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "SYNTHEDRA_MACHINE_CODE": way, "SYNTHEDRA_CACHE": str(cache)}
    done = subprocess.run(
        [sys.executable, "-c", code], env={**environment, **more}, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_machine_code_takes_the_place_of_kernels_wherever_they_are_named(tmp_path):
    make_toy(tmp_path)
    found, _ = run(SWITCH, tmp_path, tmp_path / "cache", "auto")
    assert found == [[50, False, False], 50, True, True, True, True, True, 2]


@pytest.mark.slow
def test_jobs_are_the_same_both_ways():
    """With the kernels of every module; numbers of JSON are Python's numbers."""
    cache = os.environ.get("SYNTHEDRA_CACHE", "")
    interpreted, machine_code = answer(SEVERAL, "never", cache), answer(SEVERAL, "always", cache)
    assert interpreted[:-1] == machine_code[:-1]
    assert [interpreted[-1], machine_code[-1]] == [False, True]


@pytest.mark.parametrize("command", SMALL)
def test_a_small_command_needs_no_numba(tmp_path, command):
    """The same process with a numba that cannot be imported, and with one that can."""
    (tmp_path / "numba.py").write_text("raise ImportError('numba is imported')\n")
    line = [sys.executable, "-W", "error::RuntimeWarning", "-m", "synth.cli", "enumerate", *command.split()]
    environment = {**os.environ, "SYNTHEDRA_CACHE": str(tmp_path / "cache"), "SYNTHEDRA_MACHINE_CODE": "auto"}
    environment["PYTHONPATH"] = os.pathsep.join([str(tmp_path), str(ROOT)])
    done = subprocess.run(line, env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert json.loads(done.stdout)
    assert not (tmp_path / "cache").exists()


WITHOUT_NUMBA = """
import sys

class Without:
    def __init__(self, finder):
        self.finder = finder

    def find_spec(self, name, *more):
        return None if name.partition(".")[0] in ("numba", "llvmlite") else self.finder.find_spec(name, *more)

sys.meta_path[:] = map(Without, sys.meta_path)
"""


def test_all_works_where_numba_is_not_installed(tmp_path):
    """Where machine code would pay, one line says why there is none; the answers are the same."""
    (tmp_path / "hidden").mkdir()
    (tmp_path / "hidden" / "sitecustomize.py").write_text(WITHOUT_NUMBA)
    environment = {**os.environ, "SYNTHEDRA_MACHINE_CODE": "always", "SYNTHEDRA_COMPILED": "never"}
    environment |= {"PYTHONPATH": os.pathsep.join([str(tmp_path / "hidden"), str(ROOT)])}
    ring = tmp_path / "ring.json"
    synth.write(synth.generate("four-bar").mechanism, ring)
    positions = ["positions", str(ring), "--drive", "0=60", "--no-circuits", "--json"]
    count = ["enumerate", "chains", "--links", "8", "--dof", "1", "--count"]
    for command, said in ((count, ""), (positions, f"synth: {INTERPRETED}\n")):
        line = [sys.executable, "-m", "synth.cli", *command]
        done = subprocess.run(line, env=environment, capture_output=True, text=True, check=True)
        assert done.stderr == said
        assert json.loads(done.stdout) == json.loads(run_command(*command).stdout)


def test_the_version_says_that_numba_is_not_installed(monkeypatch):
    def version(name):
        if name == "numba":
            raise importlib.metadata.PackageNotFoundError(name)
        return "1.0"

    monkeypatch.setattr(importlib.metadata, "version", version)
    assert "numba not installed, shapely 1.0" in run_command("--version").stdout


@pytest.mark.parametrize("seed", range(20))
def test_words_are_cut_to_64_bits(seed):
    dice = np.random.default_rng(seed)
    a, b, c = (np.uint64(x) for x in dice.integers(0, ALL, 3, np.uint64, endpoint=True))
    x, y, z = int(a), int(b), int(c)
    product = ((x ^ y) * 0x9E3779B97F4A7C15 + z) & ALL
    assert words._plus(a, b) == (x + y) & ALL
    assert words._minus(a, b) == (x - y) & ALL
    assert words._times(a, b) == (x * y) & ALL
    assert words._mixed(a, b, c, np.uint64(29)) == product ^ (product >> 29)
    members = x >> 2
    assert words._number_in(np.int64(members)) == f"{members:b}".count("1")
    assert words._lowest_in(np.int64(members)) == len(f"{members:b}") - len(f"{members:b}".rstrip("0"))


def test_sets_of_words():
    assert [bool(words._has_several(np.uint64(word))) for word in (0, 1, 3, 1 << 63, ALL)] == [
        False,
        False,
        True,
        False,
        True,
    ]


class Weighty:
    """A job that says what it takes."""

    def __init__(self, seconds):
        self.columns, self.key = {"number": int}, {"enumerate": "numbers"}
        self.seconds, self.weights = seconds, []

    def interpreted(self, weight):
        self.weights.append(weight)
        return self.seconds * weight

    def units(self):
        return [Unit(0, 2), Unit(1, 3)]

    def work(self, payload):
        return [(payload,)]


@pytest.mark.parametrize(
    ("seconds", "kept", "switched"), [(0.5, True, 0), (0.7, True, 1), (0.7, False, 0), (5.0, False, 0), (7.0, False, 1)]
)
def test_a_heavy_job_begins_machine_code(monkeypatch, seconds, kept, switched):
    calls = []
    monkeypatch.setattr(weights, "holds_code", lambda: kept)
    monkeypatch.setattr(weights, "use_machine_code", lambda: calls.append(1))
    monkeypatch.setattr(weights._Units, "seconds", 0.0)
    job = Weighty(seconds)
    assert [row["number"] for row in rows_of(job)] == [0, 1]
    assert (job.weights, len(calls)) == ([0, 5], switched)


@pytest.mark.parametrize(("kept", "least"), [(True, 10.0), (False, 40.0)])
def test_units_that_take_long_begin_machine_code(monkeypatch, kept, least):
    calls = []
    monkeypatch.setattr(weights, "holds_code", lambda: kept)
    monkeypatch.setattr(weights, "use_machine_code", lambda: calls.append(1))
    monkeypatch.setattr(weights, "uses_machine_code", lambda: False)
    for seconds, switched in ((least - 1.0, 0), (least + 1.0, 1)):
        monkeypatch.setattr(weights._Units, "seconds", seconds)
        with weights.interpreting():
            assert len(calls) == switched
        assert weights._Units.seconds >= seconds


def test_what_needs_no_kernels_does_not_count(monkeypatch):
    clock = iter([0.0, 1.0, 6.0, 8.0])
    monkeypatch.setattr(weights.time, "thread_time", lambda: next(clock))
    monkeypatch.setattr(weights, "uses_machine_code", lambda: False)
    monkeypatch.setattr(weights._Units, "seconds", 2.0)
    with weights.interpreting(), weights.without_kernels():
        pass
    assert weights._Units.seconds == 2.0 + 8.0 - 5.0


def test_what_jobs_weigh_grows_with_loops_and_freedoms():
    rising = [weights.placing(loops, 1) for loops in range(1, 7)]
    assert rising == sorted(rising)
    assert weights.placing(5, 1) < weights._KEPT.expected < weights.placing(6, 1)
    assert weights.placing(3, 9) > weights.placing(3, 1)
    assert weights.placing(-1, 3) == 0.0
    assert weights.drawing(100, plain=False) > weights.drawing(100, plain=True)
    assert weights.growing(9) < weights._KEPT.expected < weights.growing(13)
    assert weights.layering(6) < weights._KEPT.expected < weights.layering(21)


def test_functions_on_lists_do_what_is_compiled():
    calls = answer(
        "from both_ways import main; main()", "never", "", PYTHONPATH=f"{ROOT}{os.pathsep}{ROOT}/tests/support"
    )
    assert set(calls) == {"refine", "step", "_slot"}
    assert min(calls.values()) > 100
