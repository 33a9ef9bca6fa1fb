"""Flat sheets whose vertices move: rules that keep them flat-foldable and rigid-foldable, and sheets that do not fold."""

from types import SimpleNamespace

import numpy as np
import pytest
from sizes import slow

from graphs.errors import UnsolvableError
from synth.analysis.folding.motion import fold
from synth.catalogue.patterns import generate
from synth.synthesis.designing import Formula, Goal, JointAngle, PointsOn, WishedConfiguration, Wishes, design
from synth.synthesis.designing.dimensions import dimensions_of
from synth.synthesis.designing.problem import DesignProblem
from synth.synthesis.designing.search import closed
from synth.synthesis.designing.sheet_rules import _corners_kept

SADDLE = Formula("z - 0.1*x**2 + 0.1*y**2")


def curved(rows, columns, **how):
    """A Miura sheet, and the wish that its vertices lie on a saddle where it is folded by a quarter of a turn."""
    sheet = generate("miura", rows=rows, columns=columns).mechanism
    path = fold(sheet, frames=2).path.angles
    place = int(np.abs(path[1]).argmax())
    joint = str(list(dimensions_of(sheet).linkage(dimensions_of(sheet).start).linkage.graph.joints)[place])
    folded = WishedConfiguration("folded", {joint: float(path[1, place])})
    return sheet, Wishes((PointsOn(at="folded", target=SADDLE),), (folded,), flat_foldable=True, **how)


@pytest.mark.parametrize("rows", [3, slow(4), slow(5)])
def test_a_miura_sheet_becomes_curved_and_still_folds(rows):
    sheet, wishes = curved(rows, rows)
    start = DesignProblem(dimensions_of(sheet), wishes)
    assert np.abs(start.evaluated(start.start).rules).max() < 1e-12  # it is flat-foldable, and moves
    found = design(sheet, wishes, starts=1)
    (one,) = (*found.pareto, *found.failures)
    assert one.error < 1e-12
    assert one.freedoms == 1
    begun = closed(start, start.joined(start.family.start, [start.held(0, start.folded(0)[0])]))
    assert begun.error < 1e-12
    assert one.figures[0].miss < 0.6 * begun.miss


def test_rules_have_exact_derivatives(rng):
    problem = DesignProblem(dimensions_of(curved(3, 4)[0]), curved(3, 4)[1])
    at, along = problem.start + 0.02 * rng.normal(size=problem.size), rng.normal(size=problem.size)
    expected = [
        (problem.evaluated(at + h * along).rules - problem.evaluated(at - h * along).rules) / (2 * h)
        for h in (1e-3, 5e-4)
    ]
    np.testing.assert_allclose(problem.evaluated(at).by_rules @ along, (4 * expected[1] - expected[0]) / 3, atol=1e-6)


def test_corners_are_kept_from_turning_over_and_straight_ones_are_free():
    """Places of a square with a vertex on one side; then its upper right corner pulled to the left."""
    corners = np.array([(4, 0, 1), (0, 1, 2), (1, 2, 3), (2, 3, 4), (3, 4, 0)])
    pattern = SimpleNamespace(corners=corners, widest=np.full(5, np.pi))
    places = np.array([(0, 0), (1, 0), (2, 0), (2, 2), (0, 2)], dtype=float)
    condition = _corners_kept(pattern, places)
    bulging, narrow = places.copy(), places.copy()
    bulging[1, 1], narrow[3, 0] = -0.05, 20.0
    assert not condition(places)[0].any()
    assert not condition(bulging)[0].any()
    off, by = condition(narrow)
    assert np.flatnonzero(off).tolist() == [2, 3]  # the one is too wide, the other too narrow
    along = np.random.default_rng(1).normal(size=(5, 2))
    slope = (condition(narrow + 1e-6 * along)[0] - condition(narrow - 1e-6 * along)[0]) / 2e-6
    np.testing.assert_allclose(by @ along.ravel(), slope, atol=1e-7)


def test_without_rules_a_sheet_that_does_not_fold_is_no_success():
    sheet, wishes = curved(3, 3)
    bent = Wishes(wishes.wishes, wishes.configurations)
    found = design(sheet, bent, starts=1)
    assert not found.pareto
    assert found.failures[0].faults


def test_rules_of_sheets_are_refused_where_there_is_none():
    wish = (JointAngle(at="open", joint="2", goal=Goal(equals=0.3)),)
    with pytest.raises(UnsolvableError, match="flat_foldable is for flat sheets"):
        design(generate("bennett").mechanism, Wishes(wish, (WishedConfiguration("open"),), flat_foldable=True))
