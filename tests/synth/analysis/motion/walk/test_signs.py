"""Fold angles that keep their signs: of several freedoms those rates are taken at which no crease turns over."""

from __future__ import annotations

from dataclasses import replace
from math import radians, sqrt

import numpy as np
import pytest
from scipy.optimize import minimize
from sizes import slow_but

from graphs.mechanism.sheet import Sheet
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.motion.driven_motion import MotionOptions
from synth.analysis.motion.motion import motion_of
from synth.analysis.motion.walk.walking import _least_change
from synth.catalogue.patterns import generate
from synth.catalogue.patterns.panels import sheet_of_panels


def fish_base() -> Sheet:
    """Two points where bisectors of half a square meet, with the lines from them to its sides: five freedoms."""
    r = 1.0 - 1.0 / sqrt(2.0)
    a, b, c, e, f = (0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (1.0, r), (1.0 - r, 0.0)
    one, other = (1.0 - r, r), (r, 1.0 - r)
    half = [[a, f, one], [f, b, one], [b, e, one], [e, c, one]]
    mirrored = [[(y, x) for x, y in reversed(panel)] for panel in half]
    return sheet_of_panels([*half, *mirrored, [a, one, other], [one, c, other]], "fish base")


def assigned_by_branches(sheet: Sheet) -> list[Sheet]:
    """Return the sheet with the assignment of each branch on which all creases move."""
    at = configuration_of_sheet(sheet)
    place = {joint: number for number, joint in enumerate(at.joints)}
    signs = sorted({branch.signs for branch in at.branches.branches if "0" not in branch.signs})
    return [
        replace(
            sheet,
            assignments="".join(
                ("M" if one[place[edge]] == "-" else "V") if edge in place else letter
                for edge, letter in enumerate(sheet.assignments)
            ),
        )
        for one in signs
    ]


PATTERNS = {
    "fish base": fish_base(),
    "Yoshimura": generate("yoshimura").mechanism,
    "waterbomb 1 x 2": generate("waterbomb", rows=1, columns=2).mechanism,
}


@pytest.mark.parametrize("name", slow_but(["fish base"], PATTERNS))
def test_every_frame_is_as_assigned_whichever_crease_is_driven(name):
    """The least rates alone turned a crease over in 8 of 24 foldings of the fish base."""
    for sheet in assigned_by_branches(PATTERNS[name])[:1]:
        at = configuration_of_sheet(sheet)
        for place, joint in list(enumerate(at.joints))[::3]:
            drive = {joint: radians(100.0) * at.marks[place]}
            motion = motion_of(at, MotionOptions(drive=drive, frames=5))
            folds = motion.path.angles[1:] * at.marks
            assert folds.min() > 0.0, (name, joint)
            assert np.degrees(np.abs(motion.path.angles[-1]).max()) >= 30.0
            assert motion.closure < 1e-12
            assert motion.apart < 1e-9


def test_a_crease_that_has_to_turn_over_is_named():
    """Two creases of a vertex of five are driven: nothing is left to choose."""
    rim = [(np.cos(angle), np.sin(angle)) for angle in (0.0, 1.1, 2.5, 3.7, 5.0)]
    faces = tuple((0, one + 1, (one + 1) % 5 + 1) for one in range(5))
    flat = configuration_of_sheet(Sheet(6, (), "", faces, ((0.0, 0.0), *rim)))
    folded = configuration_of_sheet(motion_of(flat, MotionOptions(frames=6)).frames()[3])
    start, joints, found = folded.linkage.angles, folded.joints, []
    for turns in ((0.8, -0.5), (-0.5, 0.8), (0.6, 0.6), (-0.6, -0.6)):
        drive = {joints[place]: float(start[place] + turn) for place, turn in enumerate(turns)}
        motion = motion_of(folded, MotionOptions(drive=drive, frames=3))
        named = {joint for event in motion.path.events if event.kind == "turns over" for joint in event.joints}
        crossed = np.flatnonzero(start * motion.path.angles[-1] < -1e-9)
        assert named >= set(crossed.tolist()) - {0, 1}  # others turned over and came back
        found += sorted(named)
        for event in motion.path.events:
            if event.kind == "turns over":
                assert np.abs(event.angles[list(event.joints)]).max() < 1e-6
    assert found


def test_the_least_change_is_the_least():
    """By a second method: sequential quadratic programming."""
    chance = np.random.default_rng(3)
    for _ in range(10):
        moves, wanted = chance.normal(size=(4, 6)), chance.normal(size=4)
        change, _ = _least_change(moves, wanted)
        rule = {"type": "ineq", "fun": lambda x, m=moves, w=wanted: m @ x - w, "jac": lambda x, m=moves: m}
        other = minimize(lambda x: x @ x, np.zeros(6), jac=lambda x: 2 * x, constraints=rule, method="SLSQP")
        assert change is not None
        assert np.abs(change - other.x).max() < 1e-5


def test_a_contradiction_is_found():
    moves = np.array([[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0]])
    change, blamed = _least_change(moves, np.array([1.0, 1.0, 1.0]))
    assert change is None
    assert blamed[:2].all()
