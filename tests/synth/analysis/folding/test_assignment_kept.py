"""Foldings that keep the assignment: a second search, by linear programmes, says how far that can be done."""

from __future__ import annotations

import os
from math import radians
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import linprog
from sizes import slow

from graphs.errors import FileError, InvariantError, UnsolvableError
from graphs.files.formats import read
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.motion.driven_motion import BranchChoice, MotionOptions, beginning
from synth.analysis.motion.motion import motion_of
from synth.catalogue.patterns import generate

FAR, STEP = radians(30.0), 0.03
FOLDERS = [Path(os.environ["SYNTHEDRA_FOLD"])] if "SYNTHEDRA_FOLD" in os.environ else []
FOLDERS += [folder.parent / "layers" for folder in FOLDERS]
FILES = sorted(path for folder in FOLDERS for path in folder.glob("*") if path.suffix in (".fold", ".cp", ".svg"))
MOST = 120


def reaches(at):
    """Whether steps along rates that all creases agree with, found by linear programmes, come to 30 degrees."""
    _, rates = beginning(at, BranchChoice())
    signs = np.sign(rates) * (np.abs(rates) > 1e-7)
    angles, rates = 0.0 * rates, rates / np.abs(rates).max()
    for _ in range(80):
        moved = angles + STEP * rates
        for _ in range(12):
            off, jacobian = at.closure.at(moved)
            moved = moved - np.linalg.lstsq(jacobian.toarray(), off, rcond=1e-9)[0]
        if np.abs(at.closure.at(moved)[0]).max() > 1e-10 or (moved * signs < -1e-9).any():
            return False
        angles = moved
        if np.abs(angles).max() >= FAR:
            return True
        _, _, rows = np.linalg.svd(at.closure.at(angles)[1].toarray())
        rank = np.linalg.matrix_rank(at.closure.at(angles)[1].toarray(), tol=1e-6)
        basis = rows[rank:].T
        near = np.abs(angles) < 2.0 * STEP
        bounds = np.concatenate([basis, -basis, -signs[near, None] * basis[near]])
        most = np.concatenate([np.ones(2 * len(angles)), np.zeros(int(near.sum()))])
        found = linprog(-(signs @ basis), A_ub=bounds, b_ub=most, bounds=(None, None), method="highs")
        if found.status != 0 or -found.fun < 1e-6:
            return False
        rates = basis @ found.x
    return False


def check(at):
    """Frames keep the signs to 30 degrees, or the creases that turn over are named."""
    motion = motion_of(at, MotionOptions(frames=20))
    marks = at.marks
    marks = marks if (motion.path.angles[-1] * marks).sum() > 0.0 else -marks
    named = {joint for event in motion.path.events if event.kind == "turns over" for joint in event.joints}
    for frame in motion.path.angles[1:]:
        against = set(np.flatnonzero(frame * marks < -1e-7).tolist())
        assert against <= named
        if np.abs(frame).max() >= FAR:
            return
    assert named or motion.path.stopped


@pytest.mark.parametrize("name", ["miura", "waterbomb-base", slow("bird-base"), slow("yoshimura"), "resch"])
def test_generated_patterns_fold_as_assigned(name):
    at = configuration_of_sheet(generate(name).mechanism)
    assert reaches(at)
    check(at)


@pytest.mark.slow
@pytest.mark.skipif(not FILES, reason="no folder of crease patterns")
@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_patterns_of_the_folders_fold_as_assigned(path):
    try:
        at = configuration_of_sheet(read(path))
    except (FileError, InvariantError, UnsolvableError, AttributeError) as why:
        pytest.skip(str(why)[:60])
    if not (at.flat and at.marks.any() and at.linkage.loops and len(at.joints) <= MOST):
        pytest.skip("folded, without an assignment or loops, or too large")
    as_marked = at.marked.marked == "has" if at.branches is not None else at.begun.rates is not None
    if not as_marked or not reaches(at):
        pytest.skip("no path with all signs is found")
    check(at)
