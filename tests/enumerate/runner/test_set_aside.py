import gc
from dataclasses import dataclass

import pytest
from sizes import slow

from enumerate.runner._run import run
from enumerate.runner.job import Counting, Unit
from enumerate.runner.sinks import RowSink


@pytest.fixture(autouse=True)
def _nothing_is_set_aside():
    """Let the collector look through what the tests themselves set aside, and set it aside again."""
    gc.unfreeze()
    yield
    gc.freeze()


@dataclass(frozen=True)
class Frozen(Counting):
    """How many objects garbage collections do not look through where units are worked on."""

    @property
    def key(self):
        return {"frozen": True}

    def units(self):
        return [Unit(None, 5_000)] * 3

    def work(self, payload):
        return [(gc.get_freeze_count(),)]


def numbers(taken=lambda: None, **options):
    found = []

    def take(columns, rows):
        taken()
        found.extend(rows)

    run(Frozen(), RowSink(take), **options)
    return [number for (number,) in found]


@pytest.mark.parametrize("workers", [1, slow(2)])
def test_collections_do_not_look_through_what_was_there_before_the_rows(workers):
    here = []
    assert min(numbers(lambda: here.append(gc.get_freeze_count()), workers=workers)) > 1000
    assert min(here) > 1000
    assert gc.get_freeze_count() == 0


def test_afterwards_all_is_as_before_when_a_run_fails():
    with pytest.raises(ZeroDivisionError):
        numbers(lambda: 1 // 0)
    assert gc.get_freeze_count() == 0


def test_what_the_caller_has_set_aside_stays_so():
    gc.freeze()
    try:
        before = gc.get_freeze_count()
        numbers()
        assert gc.get_freeze_count() == pytest.approx(before, rel=0.1)
    finally:
        gc.unfreeze()
