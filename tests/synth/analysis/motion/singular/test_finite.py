"""Motions of flat sheets found at folded states and followed back."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from real_patterns import folder_of_patterns
from sizes import slow_but

from graphs.files.formats import read
from graphs.mechanism.sheet import Sheet
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.motion.driven_motion import MotionOptions, driven_from
from synth.analysis.motion.singular.motion_near_rates import folded_start
from synth.analysis.motion.singular.second_order import quadrics_of
from synth.analysis.verdict._mobility import verdict_of_motion
from synth.catalogue.patterns.creases import freedoms_of_triangles, resch, waterbomb

TESSELLATIONS = {"Resch 5 x 6, 262 panels": resch(5, 6), "waterbomb 4 x 5, 120 panels": waterbomb(4, 5)}


@pytest.mark.parametrize("name", slow_but(["waterbomb 4 x 5, 120 panels"], TESSELLATIONS))
def test_a_tessellation_of_triangles_folds_as_assigned_with_all_its_freedoms(name):
    """The freedoms of a disc of triangles are known by counting; all creases turn as they are marked."""
    sheet = TESSELLATIONS[name]
    at = configuration_of_sheet(sheet)
    verdict = verdict_of_motion(at)
    assert verdict.freedoms == freedoms_of_triangles(sheet)
    assert verdict.certainty == "numerical"
    assert "with the given mountain-valley assignment" in verdict.text
    assert "traced back" in verdict.text
    (way,) = verdict.branches
    assert way.signs == "".join("+" if mark > 0 else "-" for mark in at.marks)
    found, small = way.from_folded
    assert found > np.radians(5.0) > np.radians(1.5) > small


@pytest.mark.parametrize("name", slow_but(["waterbomb 4 x 5, 120 panels"], TESSELLATIONS))
def test_the_way_back_ends_at_rates_of_the_flat_state(name):
    """They close loops to first order, and agree with the equations of second order, to the size of the angles."""
    at = configuration_of_sheet(TESSELLATIONS[name])
    found = folded_start(at.closure, at.wanted)
    _, jacobian = at.closure.at(at.linkage.angles)
    off = [one.form @ found.rates[list(one.joints)] @ found.rates[list(one.joints)] for one in quadrics_of(at.linkage)]
    assert np.abs(jacobian @ found.rates).max() < found.back_to
    assert np.abs(off).max() < 3.0 * found.back_to**2
    angles = found.back_to * found.rates
    assert at.placed(angles[None]).apart.max() < 1e-10  # panels placed one by one agree on shared vertices
    assert at.closure.error(angles) < 1e-12


def _vertex(angles: list[float], letters: str) -> Sheet:
    rim = [(np.cos(angle), np.sin(angle)) for angle in angles]
    count = len(rim)
    faces = tuple((0, one + 1, (one + 1) % count + 1) for one in range(count))
    return Sheet(count + 1, tuple((0, one + 1) for one in range(count)), letters, faces, ((0.0, 0.0), *rim))


def test_three_creases_fold_nowhere():
    at = configuration_of_sheet(_vertex([0.0, 2.0, 4.0], "VVM"))
    assert folded_start(at.closure, at.wanted) is None


def test_an_assignment_that_no_motion_has_is_kept_in_part():
    """Of four creases three fold one way: two mountains and two valleys in turn do not."""
    at = configuration_of_sheet(_vertex([0.0, 1.2, pi - 0.3, 4.4], "VMVM"))
    found = folded_start(at.closure, at.wanted)
    assert found is None or found.agree < 4


def test_small_sheets_are_split_into_all_their_ways():
    """One way stands for all only where the ways are too many."""
    assert configuration_of_sheet(waterbomb(1, 1)).branches is not None
    assert configuration_of_sheet(waterbomb(4, 5)).branches is None


@pytest.mark.slow
@pytest.mark.parametrize("name", ["Resch 5 x 6, 262 panels", "ossvg_triPerfTess.svg"])
def test_freedoms_of_the_verdict_are_those_of_folded_states(name):
    """Ten singular values of the file's sheet are up to 1e-5 one degree from flat, and 2e-3 at 30 degrees."""
    if name not in TESSELLATIONS and not (folder_of_patterns() / name).is_file():
        pytest.skip("no crease patterns by other people")
    sheet = TESSELLATIONS[name] if name in TESSELLATIONS else read(folder_of_patterns() / name)
    at = configuration_of_sheet(sheet)
    path = driven_from(at, MotionOptions(frames=5)).path
    joints = len(at.joints)
    nullities = {joints - np.linalg.matrix_rank(at.closure.at(angles)[1].toarray(), 1e-7) for angles in path.angles[1:]}
    assert nullities == {verdict_of_motion(at).freedoms}
