"""Solids that move on hinges: distances, wedges on hinges, the first place at which two meet; against manifold3d."""

import numpy as np
import pytest
from overlaps import check_overlaps
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation

import synth
from synth.analysis.moving._configuration_of import configuration_of
from synth.making.thickening.solid_collisions import FoldCourse, MovingPieces, distances, overlap, pieces_of

BOX = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])


def test_distances_are_those_of_a_minimisation():
    random = np.random.default_rng(4)
    pieces = pieces_of([BOX, random.normal(size=(9, 3))], [0, 1])
    apart = 0
    for _ in range(20):
        turn, shift = Rotation.random(random_state=random).as_matrix(), 3.0 * random.normal(size=3)
        told = distances(pieces, np.array([0]), np.array([1]), turn[None], shift[None])[0]
        corners = pieces.corners[1] @ turn.T + shift

        def square(weights, there=corners):
            between = weights[:3] - weights[3:] @ there
            return between @ between

        count = len(corners)
        whole = {"type": "eq", "fun": lambda weights: weights[3:].sum() - 1.0}
        start = np.concatenate([np.full(3, 0.5), np.full(count, 1.0 / count)])
        best = minimize(square, start, bounds=[(0, 1)] * (3 + count), constraints=[whole], options={"ftol": 1e-15})
        assert told == pytest.approx(np.sqrt(best.fun), abs=1e-4)
        apart += told > 0.0
    assert 5 < apart < 20


def test_common_volumes_of_boxes():
    turn = Rotation.from_euler("z", 45, degrees=True).as_matrix()
    assert overlap(BOX, BOX + np.array([0.5, 0.25, 0.0])) == pytest.approx(0.375)
    # A square on its corner in the middle of another's: the regular octagon.
    turned = (BOX - 0.5) @ turn.T + 0.5
    assert overlap(BOX, turned) == pytest.approx(2.0 * (np.sqrt(2.0) - 1.0))
    assert overlap(BOX, BOX + np.array([1.0, 0.0, 0.0])) < 1e-9
    assert overlap(BOX, BOX + 3.0) == 0.0


def two_flaps(far, angle):
    """Boxes on the outer sides of two hinges of a plate, folded to the same side at once."""
    plate = BOX * np.array([2.0, 1.0, 0.1])
    right = BOX * np.array([far, 1.0, 0.1]) + np.array([2.0, 0.0, 0.0])
    left = BOX * np.array([-1.2, 1.0, 0.1])
    points = np.array([[2.0, 0.0, 0.1], [0.0, 0.0, 0.1]])
    along = np.array([[0.0, 1.0, 0.0], [0.0, -1.0, 0.0]])
    frames = -np.linspace(0.0, np.radians(angle), 5)[:, None] * np.ones(2)
    pieces = pieces_of([plate, right, left], [0, 1, 2])
    return MovingPieces(pieces, [(0, 1), (0, 2)], points, along, FoldCourse(None, frames))


def test_the_place_at_which_two_flaps_meet_is_that_of_a_bisection():
    # Corners at height 0.1 over the plate meet in its middle plane if both flaps are as long.
    moving = two_flaps(1.2, 170.0)
    meeting = moving.first_meeting()
    assert meeting.panels == (1, 2)
    assert np.degrees(meeting.angle) == pytest.approx(np.degrees(np.pi - np.arccos(1.0 / 1.2)), abs=0.01)
    assert moving.overlaps(np.array([0.0]))[0] == 0.0
    assert moving.overlaps(np.array([meeting.place + 0.1]))[0] > 0.0
    assert two_flaps(0.7, 170.0).first_meeting().panels is None


def test_no_gap_between_frames_hides_a_meeting():
    # A wall on a hinge comes down on a narrow post, between two frames at which it is upright and lies flat.
    base = BOX * np.array([4.0, 1.0, 0.1])
    sweeping = BOX * np.array([0.01, 1.0, 3.0]) + np.array([0.99, 0.0, 0.1])
    post = BOX * np.array([0.01, 1.0, 0.2]) + np.array([1.0 + 2.0, 0.0, 0.1])
    pieces = pieces_of([base, post, sweeping], [0, 0, 1])
    frames = np.array([[0.0], [np.radians(89.9)]])
    moving = MovingPieces(
        pieces, [(0, 1)], np.array([[1.0, 0.0, 0.1]]), np.array([[0.0, 1.0, 0.0]]), FoldCourse(None, frames)
    )
    meeting = moving.first_meeting()
    assert meeting.panels == (0, 1)
    assert np.degrees(meeting.angle) == pytest.approx(np.degrees(np.arctan2(2.0, 0.2)), abs=0.01)


@pytest.mark.parametrize("name", ["miura"])
def test_solids_cut_back_fold_to_179_degrees_and_do_not_overlap_by_manifold3d(name):
    pytest.importorskip("manifold3d")
    thick = synth.thicken(synth.generate(name, rows=2, columns=2).mechanism, thickness=0.05)
    check_overlaps(thick)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "options"), [("miura", {"rows": 4, "columns": 4}), ("square-twist", {})])
def test_sheets_cut_back_fold_to_179_degrees_by_manifold3d(name, options):
    pytest.importorskip("manifold3d")
    check_overlaps(synth.thicken(synth.generate(name, **options).mechanism, thickness=0.05))


def test_angles_between_frames_close_the_loops():
    thick = synth.thicken(synth.generate("miura").mechanism, thickness=0.05, collisions=False)
    closure = configuration_of(thick.solids).closure
    course = FoldCourse(closure, thick.angles)
    places = np.linspace(0.0, course.end, 57)
    for angles in course.at(places):
        assert abs(closure.at(angles)[0]).max() < 1e-11
    # The bounds of rates hold: no stretch is left by more than its ends and its middle say.
    low, high = places[:-1], places[1:]
    turned, bent = course.bounds(low, high)
    for part in np.linspace(0.0, 1.0, 9):
        at = course.at(low + part * (high - low))
        chord = (1.0 - part) * course.at(low) + part * course.at(high)
        assert (abs(at - chord) <= bent + 1e-12).all()
        assert (abs(at - course.at(low)) <= turned + 1e-12).all()
    assert np.degrees(abs(course.up_to(np.radians(100.0)).frames).max()) == pytest.approx(100.0)
