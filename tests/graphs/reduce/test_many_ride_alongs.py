"""Thousands of ride-alongs on one pair of links: time and memory that grow with their number.

Nothing is timed: what looked at all pairs of ten thousand loops would take minutes and more memory than there is, and
eliminations are not allowed where none is needed.
"""

import json
import random

import pytest
from commands import run
from sizes import slow

from graphs.answer.mobility import counts_and_ranks
from graphs.files.formats import write
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.reduce.ride_alongs import reduce


def on_one_pair(number: int, *, after: bool = False, centre: str = "finite", at: str | None = None) -> SCGraph:
    """Ride-alongs on links 0 and 1: each closes a loop with the joint between them, or with the one before it."""
    joints, loops, path = {0: (0, 1)}, [], (0,)
    for k in range(number):
        before = path if after else (0,)
        u, v = 2 * k + 2, 2 * k + 3
        path = (3 * k + 1, 3 * k + 2, 3 * k + 3)
        joints |= dict(zip(path, ((0, u), (u, v), (v, 1)), strict=True))
        loops.append(Loop((*before, *path), centre, at=at))
    return SCGraph(2 * number + 2, joints, loops)


@pytest.mark.parametrize("number", [1_000, slow(10_000)])
def test_thousands_on_one_pair(number):
    sc = on_one_pair(number)
    answer = counts_and_ranks(sc)
    assert (answer.mobility, answer.centres, answer.joints) == (1, number, 3 * number + 1)
    reduction = reduce(sc)
    assert (len(reduction.graph), len(reduction.steps)) == (4, number - 1)


@pytest.mark.parametrize("options", [{}, {"at": "O"}, {"centre": "infinite"}], ids=str)
def test_each_closing_with_the_one_before_it_in_any_order(options, monkeypatch):
    """Of one class, and most ride-alongs pass two loops: which is to go is seen once those after them are gone."""

    def eliminated(*_):
        raise AssertionError("an elimination")

    monkeypatch.setattr("graphs.reduce.working_graph.in_span_of", eliminated)
    sc = on_one_pair(500, after=True, **options)
    rng = random.Random(3)
    joints, loops = list(sc.joints), list(sc.loops)
    rng.shuffle(joints)
    rng.shuffle(loops)
    shuffled = SCGraph(sc.nodes, {joint: sc.joints[joint] for joint in joints}, loops)
    assert len(shuffled.centre_classes()) == 1
    assert len(reduce(shuffled).graph) == 4


@pytest.mark.parametrize("number", [200, pytest.param(10_000, marks=pytest.mark.slow)])
def test_the_commands_answer_too(number, tmp_path):
    file = tmp_path / "many.json"
    write(on_one_pair(number), file)
    (told,) = json.loads(run("mobility", "--json", "--no-exact", file).stdout)
    assert (told["mobility"], told["centres"]) == (1, number)
    assert json.loads(run("reduce", "--json", file).stdout)["after"] == {"links": 4, "joints": 4, "mobility": 1}
    assert f"{number - 1} steps in {number - 1} adjunct addenda" in run("reduce", file).stdout
