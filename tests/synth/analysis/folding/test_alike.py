"""Motions on which creases that look alike fold alike, against spherical trigonometry and rigid panels."""

from dataclasses import replace
from math import cos, degrees, pi, radians, tan

import numpy as np
import pytest
from sizes import slow

from graphs.errors import UnsolvableError
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.folding.symmetric_motion import AlikeClosure, alike_classes, fold_to
from synth.analysis.motion.singular.second_order import rates_at
from synth.catalogue.patterns import generate
from synth.catalogue.patterns.creases import fan, preliminary_base, waterbomb_base

ASKED = [
    ("waterbomb-base", {}, 30),
    ("preliminary-base", {}, 90),
    ("webbed-tray", {}, 60),
    ("yoshimura", {}, 60),
    ("waterbomb", {"rows": 2, "columns": 1}, 70.623),
    ("waterbomb", {}, 60),
]


def line_crease(diagonal, sector):
    """Of a vertex with two creases in line and four at a sector from them, all four folded alike.

    A triangle of two equal sides, the sector, with the fold angle of a diagonal between them: half the fold angle of
    the line is the complement of an angle at its base.
    """
    return 2 * np.arctan(cos(sector) * tan(diagonal / 2))


@pytest.mark.parametrize(("name", "parameters", "goal"), ASKED)
def test_patterns_fold_to_an_angle_with_rigid_panels(name, parameters, goal):
    flat = generate(name, **parameters).mechanism
    motion = fold_to(flat, radians(goal))
    (driven,) = motion.driven
    assert motion.branch is None  # creases that look alike fold alike: no branch was looked for
    assert motion.path.stopped == ""
    end = motion.path.angles[-1, motion.joints.index(driven)]
    assert degrees(abs(end)) == pytest.approx(goal, abs=1e-9)
    assert max(motion.closure, motion.apart) < 1e-11
    letters = {"M": -1.0, "V": 1.0}
    last = motion.frames()[-1]
    for letter, angle in zip(last.assignments, last.fold_angles, strict=True):
        assert letter not in letters or letters[letter] * angle > radians(0.1)
    before, after = (np.array(sheet.coordinates) for sheet in (flat, last))
    for face in flat.faces:
        sides = [np.linalg.norm(p[list(face), None, : p.shape[1]] - p[list(face)], axis=2) for p in (before, after)]
        np.testing.assert_allclose(*sides, atol=1e-10)


@pytest.mark.parametrize("goal", [30, 41.54, 90, 170])
def test_the_waterbomb_base_agrees_with_a_spherical_triangle(goal):
    angles = fold_to(waterbomb_base(), radians(goal)).path.angles[-1]
    line = -line_crease(radians(goal), pi / 4)
    np.testing.assert_allclose(angles, [line, radians(goal), radians(goal)] * 2, atol=1e-10)
    # The angles that the issue of this motion gives, in degrees.
    for line, diagonal in ((30, 41.5), (60, 78.5), (90, 109.5)):
        assert degrees(line_crease(radians(diagonal), pi / 4)) == pytest.approx(line, abs=0.1)


@pytest.mark.parametrize(("rows", "columns"), [(3, 2), slow(4, 5)])
def test_yoshimuras_pattern_rolls_up_with_one_angle_for_all_mountains(rows, columns):
    sheet = generate("yoshimura", rows=rows, columns=columns, fold=radians(80)).mechanism
    angles = {letter: [] for letter in "MV"}
    for letter, angle in zip(sheet.assignments, sheet.fold_angles, strict=True):
        angles.get(letter, []).append(angle)
    np.testing.assert_allclose(angles["M"], -radians(80), atol=1e-10)
    np.testing.assert_allclose(angles["V"], line_crease(radians(80), np.arctan2(0.6, 0.5)), atol=1e-10)


def test_the_preliminary_base_keeps_its_open_diagonal_nearly_flat():
    """Without that diagonal it is a waterbomb base, to which the motion is near."""
    angles = np.degrees(fold_to(preliminary_base(), pi / 2).path.angles[-1])
    np.testing.assert_allclose(angles[::2], 90, atol=1e-8)
    np.testing.assert_allclose(angles[1::4], angles[1], atol=1e-8)
    assert abs(angles[1]) < 10
    assert angles[3] == pytest.approx(-degrees(line_crease(pi / 2, pi / 4)), abs=5)


@pytest.mark.parametrize(
    ("name", "parameters", "classes", "tangent"),
    [
        ("waterbomb-base", {}, 2, 2),
        ("yoshimura", {"rows": 4, "columns": 3}, 2, 2),
        ("waterbomb", {"rows": 3, "columns": 2}, 4, 3),
        ("map", {}, 2, 2),
        ("chickenwire", {}, 3, 2),
        ("huffman-grid", {}, 4, 2),
        ("resch", {}, 3, 3),
    ],
)
def test_classes_are_those_of_the_tessellation(name, parameters, classes, tangent):
    pattern = configuration_of_sheet(generate(name, **parameters).mechanism)
    first = alike_classes(pattern.sheet, pattern.linkage, pattern.marks)[0]
    assert first.max() + 1 == classes
    for group in range(classes):
        assert len(set(pattern.marks[first == group])) == 1
    assert rates_at(AlikeClosure(pattern.linkage, first), pattern.linkage.angles).shape[1] == tangent


def test_what_has_no_symmetry_has_no_classes():
    sheet = fan([0.0, 0.9, 2.2, 3.7, 4.4])
    pattern = configuration_of_sheet(sheet)
    assert alike_classes(sheet, pattern.linkage, pattern.marks) == []


def test_a_turned_and_rounded_pattern_folds_to_the_same_angles():
    """Noise far above rounding leaves the classes and the motion as they are."""
    flat, random = generate("waterbomb").mechanism, np.random.default_rng(36)
    exact = fold_to(flat, radians(60)).path.angles[-1]
    turn = np.array([[cos(1.0), -np.sin(1.0)], [np.sin(1.0), cos(1.0)]])
    places = np.array(flat.coordinates) @ turn.T + random.normal(scale=1e-13, size=(flat.vertices, 2))
    again = fold_to(replace(flat, coordinates=tuple(map(tuple, places.tolist()))), radians(60))
    np.testing.assert_allclose(again.path.angles[-1], exact, atol=1e-6)


def test_a_path_that_ends_is_told_as_that():
    storey = generate("kresling", sides=4, ends=1, turn=pi / 4).mechanism
    with pytest.raises(
        UnsolvableError, match=r"^the pattern folds to 149\.5\d*°; expected 175°: panels lie on each other"
    ):
        fold_to(storey, radians(175))
