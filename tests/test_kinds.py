"""The tests themselves: their kinds, and the time they may take on two cores."""

from pathlib import Path

from kinds import KINDS, LAW, NIGHT, WORLD, is_below, stored

ROOT = Path(__file__).resolve().parent.parent
UNIT, QUICK, SLOW = 30, 180, 90 * 60
"""Seconds that the tests of `make test-unit`, `make test` and `make test-slow` may take on two cores.

To collect them takes each process some 15 seconds of processor time more, which nothing here counts.
"""
CORES = 2


def test_places_of_kinds_are_there():
    assert [place for place in (*WORLD, *LAW) if not (ROOT / place).exists()] == []


def test_a_test_knows_its_kind(request):
    assert ("kind", "unit") in request.node.user_properties


def test_a_place_holds_what_is_below_it():
    assert is_below("tests/machines/test_machines.py", WORLD)
    assert not is_below("tests/machines" + "_of_old", WORLD)


def test_stored_durations_are_of_tests_that_exist():
    files = {test.partition("::")[0] for test in stored()["tests"]}
    assert sorted(file for file in files if not (ROOT / file).exists()) == []


def test_stored_durations_keep_the_limits():
    kinds = stored()["kinds"]
    assert set(kinds) == set(KINDS)
    assert kinds["unit"] <= CORES * UNIT
    assert sum(kinds.values()) <= CORES * QUICK
    assert sum(seconds for seconds in stored()["tests"].values() if seconds <= NIGHT) <= CORES * SLOW
