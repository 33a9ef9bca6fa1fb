"""Curves that come near each other are not confused: ovals of Cassini, whose two halves all but meet."""

from itertools import islice

import numpy as np
import pytest
import scipy.sparse
from sizes import slow

from graphs.mechanism.sheet import Sheet
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.motion.closure import corrected
from synth.analysis.motion.path import PathOptions, driven_path
from synth.analysis.motion.tangent import TangentSpace
from synth.analysis.motion.walk import Walk
from synth.analysis.motion.walk.events import Return


class Cassini:
    """Points whose distances from (a, 0) and (-a, 0) have the product b^2: two ovals if b < a, one if b > a."""

    joints, rows = 2, 1

    def __init__(self, a, b):
        self.a, self.b = a, b

    matrix, space = staticmethod(lambda entries: entries), staticmethod(TangentSpace)
    corrected = walked = staticmethod(lambda *_: None)

    def evaluated(self, place):
        x, y = place
        a, scale = self.a, 4 * self.a**3
        square = x * x + y * y
        value = square**2 - 2 * a * a * (x * x - y * y) + a**4 - self.b**4
        slopes = np.array([[4 * x * (square - a * a), 4 * y * (square + a * a)]])
        return np.array([value]) / scale, scipy.sparse.csr_matrix(slopes / scale)


def walked(a, apart, side):
    """The places of a walk from beside the right end, all the way round; the curves are `apart` in the middle."""
    curve = Cassini(a, a * np.sqrt(1 - side * apart**2))
    start = corrected(curve, np.array([np.hypot(a, curve.b), 0.02 * a])).angles
    tangent = corrected(curve, start).space.projected(np.array([0.0, 1.0]))
    walk = Walk(curve, start, tangent)
    walk.events = [Return(start, tangent)]
    places = np.array([step.after.angles for step in islice(walk, 300)])
    return walk.ended, places


SIZES = np.linspace(0.3, 1.5, 9)
QUICK = SIZES[::4]


@pytest.mark.parametrize(("apart", "sizes"), [(0.3, QUICK), slow(0.3, SIZES), slow(0.1, SIZES)])
def test_a_walk_stays_on_its_oval(apart, sizes):
    for a in sizes:
        ended, places = walked(a, apart, 1)
        assert ended == "it comes round"
        assert places[:, 0].min() > 0.0, a


@pytest.mark.parametrize(("apart", "sizes"), [(0.3, QUICK), slow(0.3, SIZES), slow(0.1, SIZES)])
def test_a_walk_goes_all_round_where_the_ovals_are_one(apart, sizes):
    for a in sizes:
        ended, places = walked(a, apart, -1)
        assert ended == "it comes round"
        assert places[:, 0].min() < -a, a


def test_rates_beside_a_branch_lead_on_it():
    """A flat vertex folds in two ways; rates between them, which agree to first order, are chosen to begin with."""
    corners = ((0, 0), (1, 0), (0.5, 0.9), (-1, 0), (-0.5, -0.7))
    at = configuration_of_sheet(Sheet(5, (), "", ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)), corners))
    line, fold = np.array([1.0, 0.0, 1.0, 0.0]), next(one.rates for one in at.branches.branches if one.rates.all())
    for part in (0.2, 0.4):
        rates = fold + part * line
        path = driven_path(at.closure, at.linkage.angles, [3], 0.17, options=PathOptions(rates, straight=True))
        assert path.stopped == ""
        assert np.abs(path.angles[-1] / 0.17 - fold / fold[3]).max() < 1e-3
