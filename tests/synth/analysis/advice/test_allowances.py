"""Searches for advice that end when their allowance of work is used up, and say so."""

from dataclasses import replace

import numpy as np
import pytest

from graphs.mechanism.sheet import Sheet
from synth.analysis.advice.advice import advise
from synth.analysis.advice.diagonals import Bounds, Candidates, Diagonal, smallest_sets
from synth.analysis.advice.locks import cheapest_sets
from synth.analysis.motion.walk.step import Allowance
from synth.catalogue.patterns.creases import miura


def strip(panels):
    """A strip of squares, each of which can be folded by itself."""
    corners = tuple((float(x), float(y)) for y in (0, 1) for x in range(panels + 1))
    up = panels + 1
    creases = tuple((x, x + up) for x in range(1, panels))
    faces = tuple((x, x + 1, x + 1 + up, x + up) for x in range(panels))
    return Sheet(2 * up, creases, "V" * len(creases), faces, corners)


def test_the_sets_found_are_the_first_of_all():
    rates = np.linalg.qr(np.random.default_rng(4).normal(size=(9, 5)))[0]
    costs = [(float(joint % 3),) for joint in range(9)]
    every = list(cheapest_sets(rates, 3, costs, range(9)))
    lengths = set()
    for steps in (0, 10, 100, 10_000):
        allowance = Allowance(steps)
        some = list(cheapest_sets(rates, 3, costs, range(9), allowance))
        assert some == every[: len(some)]
        assert (len(some) < len(every)) == (allowance.left < 0)
        lengths.add(len(some))
    assert min(lengths) == 1
    assert max(lengths) == len(every)


def test_what_an_allowance_ended_says_so():
    whole = advise(strip(8), 3, limit=1)
    assert (whole.more, whole.used_up) == (True, False)
    assert "lock 4 joints: the first set\n" in str(whole)
    advice = replace(whole, used_up=True)
    assert advice.to_json()["used_up"]
    assert "lock 4 joints: the first set; the search ended at its work limit" in str(advice)


def test_no_set_of_diagonals_within_the_allowance():
    diagonals = [Diagonal(panel, panel, (0, 2), (0, 2)) for panel in range(30)]
    candidates = Candidates(diagonals, np.eye(30), Allowance(20))
    found = smallest_sets(miura(3, 3, 1.0), candidates, Bounds(1, 1, 3, 3), 5)
    assert (found.sets, found.more, found.used_up) == ((), True, True)


@pytest.mark.slow
def test_a_strip_of_400_panels():
    """Some seconds of a processor; sets of 199 joints were over a minute's work."""
    advice = advise(strip(400), 200)
    assert advice.used_up
    assert advice.locks[0].freedoms == 200
    assert not advise(strip(400), 0).more
