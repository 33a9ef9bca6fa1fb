"""Panels tapered, stepped away by layers, and at hinge strips: the fold angle at which they meet, refusals, the best."""

import numpy as np
import pytest
from overlaps import check_overlaps

import synth
from graphs.errors import SynthedraError
from graphs.mechanism.sheet import Sheet
from synth.analysis.moving._configuration_of import configuration_of
from synth.making.thickening.solid_collisions import FoldCourse, MovingPieces
from synth.making.thickening.techniques import strip_plates, tapered_plates


def card(letter="V"):
    """Two squares of side 10 at a crease."""
    corners = ((0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0), (20.0, 0.0), (20.0, 10.0))
    return Sheet(6, ((1, 2),), letter, ((0, 1, 2, 3), (1, 4, 5, 2)), corners)


@pytest.mark.parametrize("letter", ["V", "M"])
@pytest.mark.parametrize("how", ["tapered", "hinge"])
def test_panels_meet_at_twice_the_arc_tangent_of_the_width_over_half_the_thickness(how, letter):
    at = configuration_of(card(letter))
    thickness, width = 1.2, 1.5
    trims = {0: width / (thickness / 2.0)}
    plates = (
        tapered_plates(at, trims, thickness, 1.0, 0.1, 2.0) if how == "tapered"
        else strip_plates(at, trims, thickness, 1.0, 2.0)
    )  # fmt: skip
    sign = 1.0 if letter == "V" else -1.0
    pair, (point, along) = next(iter(at.mechanism.sc.joints.values())), (np.array([[10.0, 0, 0]]), np.eye(3)[[1]])
    # Panel 1 turns about the y axis: upwards with a negative angle.
    turned = -sign if tuple(pair) == (0, 1) else sign
    frames = turned * np.linspace(0.0, np.radians(175.0), 8)[:, None]
    moving = MovingPieces(plates.pieces()[0], [tuple(pair)], point, along, FoldCourse(None, frames))
    expected = 2.0 * np.arctan(width / (thickness / 2.0))
    assert moving.clear_of_hinges(np.array([0]), np.array([1]))[0] == pytest.approx(expected, abs=1e-9)
    meeting = moving.first_meeting()
    assert meeting.panels == (0, 1)
    assert meeting.angle == pytest.approx(expected, abs=1e-6)
    assert moving.overlaps(np.array([meeting.place - 1e-3]))[0] == 0.0
    assert moving.overlaps(np.array([meeting.place + 1e-2]))[0] > 0.0


@pytest.mark.parametrize("how", ["tapered", "hinge"])
def test_panels_reach_the_angle_that_is_wanted(how):
    thick = synth.thicken(card(), thickness=1.0, how=how, angle=np.radians(140.0), hinges="tape")
    assert thick.collisions.meeting.panels is None
    assert np.degrees(thick.collisions.meeting.angle) == pytest.approx(140.0, abs=1e-6)
    volume = {
        "tapered": 200.0 - 10.0 * np.tan(np.radians(70.0)) / 4.0,
        "hinge": 200.0 - 10.0 * np.tan(np.radians(70.0)),
    }
    assert thick.plates.volume == pytest.approx(volume[how])


def test_offset_panels_fold_the_whole_range_with_notches():
    pytest.importorskip("manifold3d")
    thick = synth.thicken(synth.generate("miura", rows=2, columns=2).mechanism, thickness=0.05, how="offset")
    assert thick.keeps_angles
    assert thick.plates.cut
    check_overlaps(thick)


@pytest.mark.parametrize(
    ("how", "words"),
    [
        ("tapered", r"thickness 9 mm: panel 0 allows less than 5.3589\d* mm at 150 degrees"),
        ("hinge", r"thickness 9 mm: panel 0 allows less than 5.3589\d* mm at 150 degrees"),
    ],
)
def test_a_panel_that_is_too_narrow_is_named(how, words):
    with pytest.raises(SynthedraError, match=words):
        synth.thicken(card(), thickness=9.0, how=how)


def test_a_sheet_that_does_not_fold_flat_has_no_offset_panels():
    sheet = synth.generate("waterbomb-base").mechanism
    bad = Sheet(sheet.vertices, sheet.edges, "MVMVMV", sheet.faces, sheet.coordinates)
    with pytest.raises(SynthedraError, match="no layer order"):
        synth.thicken(bad, thickness=0.01, how="offset")


def test_the_best_technique_has_the_greatest_angle_then_the_smallest_box():
    thick = synth.thicken(card(), thickness=1.0, how="best")
    assert [one.how for one in thick.comparison] == ["spatial", "tapered", "offset", "hinge"]
    assert thick.how == min(thick.comparison, key=lambda one: one.rank).how
    # Flat on each other two squares of 10 mm are 2 mm high; a tapered card stays open.
    by_name = {one.how: one for one in thick.comparison}
    assert np.prod(by_name["spatial"].stowed) == pytest.approx(10.0 * 10.0 * 2.0, rel=0.1)
    assert np.degrees(by_name["tapered"].angle) == pytest.approx(150.0)
    assert by_name["spatial"].mass == pytest.approx(200.0 * 700e-6, rel=2e-3)  # less the bores for screws


def test_input_that_no_technique_takes():
    for arguments, words in (
        ({"how": "glued"}, "one of spatial, tapered, offset, hinge and best"),
        ({"angle": 3.5}, "angle 200.535 degrees; expected more than 0 and less than 180"),
        ({"clearance": 2.0}, "clearance 2.0; expected a positive number, at most the thickness"),
    ):
        with pytest.raises(SynthedraError, match=words):
            synth.thicken(card(), thickness=1.0, **arguments)
