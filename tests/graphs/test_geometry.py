"""Geometry of points, directions and rotations, where points coincide, lie in a line, are huge and tiny."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from graphs.geometry import (
    across,
    angles_between,
    area_vector,
    best_line,
    best_plane,
    common_direction,
    crossing,
    frame_about,
    lines_meet,
    nearest_rotation,
    principal_axes,
    rigid_motion,
    rotated,
    rotations,
    sectors,
    signed_area,
    unit,
)

RANDOM = np.random.default_rng(0)
SCALES = [1.0, 1e40, 1e-40]


def random_rotations(count):
    return Rotation.random(count, random_state=1).as_matrix()


@pytest.mark.parametrize("scale", SCALES)
def test_unit_vectors_of_any_length(scale):
    vectors = RANDOM.normal(size=(4, 5, 3)) * scale
    assert np.linalg.norm(unit(vectors), axis=-1) == pytest.approx(1.0)
    assert not unit(np.zeros((2, 3))).any()


@pytest.mark.parametrize("scale", SCALES)
def test_parts_across(scale):
    vectors, axes = RANDOM.normal(size=(2, 7, 3)) * scale
    assert (across(vectors, axes) * axes).sum(axis=1) == pytest.approx(0.0, abs=1e-14 * scale**2)
    assert across(vectors, np.zeros(3)).tolist() == vectors.tolist()


def test_frames_are_right_handed_and_do_not_hang_on_the_last_bit():
    directions = RANDOM.normal(size=(20, 3)) * 1e40
    frames = frame_about(directions)
    assert np.linalg.det(frames) == pytest.approx(1.0)
    assert frames @ np.swapaxes(frames, 1, 2) == pytest.approx(np.broadcast_to(np.eye(3), (20, 3, 3)))
    assert frames[:, 2] == pytest.approx(unit(directions))
    even = np.ones(3)
    for bit in np.eye(3) * 1e-15:
        assert frame_about(even - bit) == pytest.approx(frame_about(even))


def test_rotations_agree_with_scipy_in_both_forms():
    axes, angles = unit(RANDOM.normal(size=(4, 6, 3))), RANDOM.uniform(-4, 4, (4, 6))
    vectors = RANDOM.normal(size=(4, 6, 3))
    matrices = rotations(axes, angles)
    expected = Rotation.from_rotvec((angles[..., None] * axes).reshape(-1, 3)).as_matrix()
    assert matrices.reshape(-1, 3, 3) == pytest.approx(expected)
    assert (matrices @ vectors[..., None])[..., 0] == pytest.approx(rotated(vectors, axes, angles))


def test_small_angles_have_all_their_digits():
    angles = np.array([1e-40, 1e-12, 1.0, np.pi - 1e-9])
    directions = np.stack([np.cos(angles), np.sin(angles), np.zeros(4)], axis=1)
    assert angles_between(directions * 1e40, np.eye(3)[0] * 1e-40) == pytest.approx(angles, rel=1e-12)
    assert float(angles_between(np.zeros(3), np.eye(3)[0])) == 0.0


def test_sectors_of_a_flat_vertex_make_a_full_turn():
    azimuths = np.sort(RANDOM.uniform(0, 2 * np.pi, (10, 6)), axis=1)
    directions = np.stack([np.cos(azimuths), np.sin(azimuths), 0 * azimuths], axis=-1) @ random_rotations(1)[0]
    narrow = np.diff(np.hstack([azimuths, azimuths[:, :1] + 2 * np.pi]), axis=1).max(axis=1) < np.pi
    assert narrow.any()
    assert sectors(directions)[narrow].sum(axis=1) == pytest.approx(2 * np.pi)


@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("dimensions", [2, 3])
def test_no_orthogonal_matrix_is_nearer(dimensions, mirrored):
    matrices = RANDOM.normal(size=(50, dimensions, dimensions))
    nearest = nearest_rotation(matrices, mirrored=mirrored)
    assert np.linalg.det(nearest) == pytest.approx(-1.0 if mirrored else 1.0)
    others = np.linalg.qr(RANDOM.normal(size=(2000, dimensions, dimensions)))[0]
    others[:, 0] *= np.sign(np.linalg.det(others) * (-1.0 if mirrored else 1.0))[:, None]
    alike = np.einsum("nij,mij->nm", matrices, others).max(axis=1)
    assert (np.einsum("nij,nij->n", matrices, nearest) >= alike - 1e-12).all()


def test_nearest_rotation_of_points_agrees_with_scipy():
    before, after = RANDOM.normal(size=(2, 9, 3))
    expected, _ = Rotation.align_vectors(after - after.mean(axis=0), before - before.mean(axis=0))
    assert rigid_motion(before, after)[0] == pytest.approx(expected.as_matrix())


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("kind", ["in space", "in a plane", "in a line"])
def test_a_motion_of_points_is_found_again(kind, scale):
    flat = {"in space": (1, 1, 1), "in a plane": (1, 1, 0), "in a line": (1, 0, 0)}[kind]
    before = RANDOM.normal(size=(30, 6, 3)) * flat @ random_rotations(1)[0] * scale
    turns, shifts = random_rotations(30), RANDOM.normal(size=(30, 3)) * scale
    after = before @ np.swapaxes(turns, 1, 2) + shifts[:, None]
    rotation, shift = rigid_motion(before, after)
    assert np.linalg.det(rotation) == pytest.approx(1.0)
    assert before @ np.swapaxes(rotation, 1, 2) + shift[:, None] == pytest.approx(after, abs=1e-13 * scale)
    if kind != "in a line":
        assert rotation == pytest.approx(turns)


def test_points_in_a_line_turn_least():
    before = np.outer([-1.0, 0.0, 2.0], [1.0, 2.0, 2.0])
    after = np.outer([-1.0, 0.0, 2.0], [2.0, 1.0, 2.0])
    rotation, _ = rigid_motion(before, after)
    least = float(angles_between(before[2], after[2]))
    assert float(np.trace(rotation)) == pytest.approx(1 + 2 * np.cos(least))
    back, _ = rigid_motion(before, -before)  # half a turn about any line across: any of them, but always one
    again, _ = rigid_motion(before, -before @ rotations([0.0, 0.0, 1.0], 1e-15).T)
    assert back == pytest.approx(again)
    assert before @ back.T == pytest.approx(-before)


def test_points_in_one_place_do_not_turn():
    place = np.full((4, 3), 1e40)
    rotation, shift = rigid_motion(place, 2 * place)
    assert rotation.tolist() == np.eye(3).tolist()
    assert shift.tolist() == [1e40] * 3
    assert nearest_rotation(np.zeros((3, 3)), mirrored=True).tolist() == np.diag([1.0, 1.0, -1.0]).tolist()


@pytest.mark.parametrize("scale", SCALES)
def test_a_plane_is_found_again(scale):
    frames = random_rotations(40)
    flat = RANDOM.normal(size=(40, 5, 3)) * (3.0, 1.0, 0.0)
    points = (flat @ frames + RANDOM.normal(size=(40, 1, 3))) * scale
    plane = best_plane(points)
    assert np.abs((plane.direction * frames[:, 2]).sum(axis=1)) == pytest.approx(1.0)
    assert plane.off == pytest.approx(0.0, abs=1e-14 * scale)
    assert (plane.direction.max(axis=1) >= 0.99 * np.abs(plane.direction).max(axis=1)).all()
    one = best_plane(points[3])
    assert one.direction == pytest.approx(plane.direction[3])


@pytest.mark.parametrize("scale", SCALES)
def test_a_sliver_still_has_its_plane(scale):
    """What is a millionth as wide as long is no line."""
    frame = random_rotations(1)[0]
    points = RANDOM.normal(size=(6, 3)) * (1.0, 1e-7, 0.0) @ frame * scale
    assert abs(float(best_plane(points).direction @ frame[2])) == pytest.approx(1.0)


def test_how_far_points_are_off_a_plane_and_a_line():
    corners = np.array([[1.0, 0, 0.5], [0, 1, -0.5], [-1, 0, 0.5], [0, -1, -0.5]])
    assert float(best_plane(corners).off) == pytest.approx(0.5)
    assert float(best_line([[0, 0], [1, 1], [2, 0.0]]).off) == pytest.approx(2 / 3)


@pytest.mark.parametrize("scale", SCALES)
def test_the_planes_of_a_line_and_of_a_place_are_always_the_same(scale):
    line = np.outer([0.0, 1.0, 3.0], [1.0, 1.0, 0.0]) * scale
    expected = best_plane(line).direction
    assert abs(float(expected @ line[2])) <= 1e-15 * scale
    for turn in range(1, 4):
        shaken = line * (1 + 1e-15 * RANDOM.normal(size=line.shape))
        assert best_plane(np.roll(shaken, turn, axis=0)).direction == pytest.approx(expected, abs=1e-12)
    assert best_plane(np.full((3, 3), scale)).direction.tolist() == [0.0, 0.0, 1.0]
    assert best_line(np.full((3, 3), scale)).direction.tolist() == [1.0, 0.0, 0.0]


def test_the_axes_of_a_square_and_of_a_cube_are_always_the_same():
    square = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    cube = np.array(list(np.ndindex(2, 2, 2)), dtype=float)
    for points in (square, cube):
        sizes, axes = principal_axes(points)
        for _ in range(5):
            shaken = points + 1e-15 * RANDOM.normal(size=points.shape)
            assert principal_axes(shaken)[1] == pytest.approx(axes, abs=1e-12)
        assert axes.tolist() == np.eye(3).tolist()
        assert sizes[0] == pytest.approx(sizes[1])
    assert best_line(square).direction.tolist() == [1.0, 0.0, 0.0]


@pytest.mark.parametrize("scale", SCALES)
def test_lines_that_are_nearly_parallel_have_a_common_direction(scale):
    wanted = unit(RANDOM.normal(size=(30, 1, 3)))
    signs = RANDOM.choice([-1.0, 1.0], size=(30, 5, 1))
    found = common_direction(scale * signs * (wanted + 1e-9 * RANDOM.normal(size=(30, 5, 3))))
    assert np.linalg.norm(np.cross(found, wanted[:, 0]), axis=1) == pytest.approx(0.0, abs=1e-8)
    assert common_direction([[0.0, 0.0, scale], [0.0, -scale, 0.0]]).tolist() == [0.0, 1.0, 0.0]


def test_fewer_points_than_dimensions_have_all_axes():
    sizes, axes = principal_axes(np.array([[[0.0, 0, 0], [0, 2, 0]], [[1.0, 1, 1], [1, 1, 1]]]))
    assert sizes == pytest.approx(np.array([[2**0.5, 0, 0], [0, 0, 0]]))
    assert axes @ np.swapaxes(axes, 1, 2) == pytest.approx(np.broadcast_to(np.eye(3), (2, 3, 3)))
    assert axes[0, 0] == pytest.approx([0.0, 1.0, 0.0])


@pytest.mark.parametrize("scale", SCALES)
def test_lines_meet_where_they_were_drawn_from(scale):
    place = RANDOM.normal(size=(20, 3)) * scale
    along = RANDOM.normal(size=(20, 4, 3))
    points = place[:, None] + along * RANDOM.normal(size=(20, 4, 1)) * scale
    meeting = lines_meet(points, along / scale)
    assert meeting.point == pytest.approx(place, abs=1e-11 * scale)
    assert meeting.off == pytest.approx(0.0, abs=1e-11 * scale)


def test_lines_that_do_not_meet():
    points = np.array([[0.0, 0, 0], [0, 0, 2.0]])
    skew = lines_meet(points, [[1.0, 0, 0], [0, 1, 0]])
    assert skew.point == pytest.approx([0.0, 0, 1])
    assert skew.off == pytest.approx([1.0, 1.0])
    parallel = lines_meet(points + np.array([5.0, 0, 0]), [[1.0, 0, 0], [-2.0, 0, 0]])
    assert parallel.point == pytest.approx([5.0, 0, 1])
    assert float(parallel.spread) == pytest.approx(0.0, abs=1e-15)
    assert float(skew.spread) == pytest.approx(0.5**0.5)


@pytest.mark.parametrize("scale", SCALES)
def test_areas(scale):
    azimuths = np.linspace(0, 2 * np.pi, 12, endpoint=False)
    ring = np.stack([np.cos(azimuths), np.sin(azimuths)], axis=1) * scale + 7.0 * scale
    assert float(signed_area(ring)) == pytest.approx(3.0 * scale**2)
    assert float(signed_area(ring[::-1])) == pytest.approx(-3.0 * scale**2)
    frame = random_rotations(1)[0]
    assert area_vector(ring @ frame[:2]) == pytest.approx(3.0 * scale**2 * frame[2])
    assert float(signed_area(ring[:2])) == 0.0
    assert not area_vector(np.full((5, 3), scale)).any()
    assert signed_area(np.stack([ring, ring[::-1]])).tolist() == [
        float(signed_area(ring)),
        float(signed_area(ring[::-1])),
    ]


def test_nothing_has_no_area():
    assert float(signed_area(np.zeros((0, 2)))) == 0.0
    assert area_vector(np.zeros((4, 0, 3))).shape == (4, 3)


def test_matrices_of_cross_products_over_any_leading_axes(rng):
    vectors, others = rng.normal(size=(2, 4, 5, 3))
    np.testing.assert_allclose((crossing(vectors) @ others[..., None])[..., 0], np.cross(vectors, others), atol=1e-14)
