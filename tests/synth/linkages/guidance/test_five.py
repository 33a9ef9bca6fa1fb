"""Dyads of five orientations: all of them, against known dyads and by a second method."""

import numpy as np
import pytest
from cranks import lines_apart, problem, random_orientations
from scipy.spatial.transform import Rotation
from sizes import slow, slow_but

from graphs.errors import UnsolvableError
from synth.linkages.guidance.dyads import centre_axes
from synth.linkages.guidance.orientations import Orientations
from synth.linkages.guidance.synthesis import dyads_by_least_squares, dyads_of_five


def distance(dyad, fixed, moving):
    return max(lines_apart(dyad.fixed, fixed), lines_apart(dyad.moving, moving))


def worst_distance(cases, seed):
    """How far the known dyad of random problems is from the nearest one found, at most."""
    worst, numbers = 0.0, set()
    for case in range(cases):
        made = problem(5, np.random.default_rng([seed, case]))
        found = dyads_of_five(made.orientations)
        assert found.residual < 1e-12
        assert max(dyad.residual for dyad in found.dyads) < 1e-12
        assert len(found.dyads) + found.complex_solutions == 6
        worst = max(worst, min(distance(dyad, made.fixed, made.moving) for dyad in found.dyads))
        numbers.add(len(found.dyads))
    assert numbers == {2, 4, 6}
    return worst


@pytest.mark.parametrize("cases", [50, slow(200)])
def test_a_known_dyad_is_always_found(cases):
    assert worst_distance(cases, 21) < 1e-8


@pytest.mark.slow
def test_a_known_dyad_is_always_found_in_ten_thousand_cases():
    assert worst_distance(10_000, 22) < 1e-8


@pytest.mark.parametrize("cases", [15, slow(50)])
def test_two_known_dyads_are_found(cases):
    """The coupler of a four-bar at five crank angles lies on both its dyads."""
    rng = np.random.default_rng(23)
    g, h = np.eye(3)[2], np.array([np.sin(1.0), 0.0, np.cos(1.0)])
    for _ in range(cases):
        frames = []
        for turn in np.sort(rng.uniform(0.0, 2.0 * np.pi, 5)):  # crank 20, coupler 55, rocker 50 degrees
            w = Rotation.from_rotvec(turn * g).apply([np.sin(0.35), 0.0, np.cos(0.35)])
            k = w @ h
            x, y = np.linalg.solve([[1.0, k], [k, 1.0]], np.cos([0.87, 0.96]))
            v = x * h + y * w + np.sqrt((1 - x * x - y * y - 2 * k * x * y) / (1 - k * k)) * np.cross(h, w)
            n = np.cross(w, v) / np.linalg.norm(np.cross(w, v))
            frames.append(np.stack([w, np.cross(n, w), n], axis=1))
        found = dyads_of_five(Orientations.from_matrices(frames)).dyads
        moving = [1.0, 0.0, 0.0], [np.cos(0.96), np.sin(0.96), 0.0]
        for fixed, body in zip((g, h), moving, strict=True):
            assert min(distance(dyad, fixed, body) for dyad in found) < 1e-8


@pytest.mark.parametrize("cases", [3, slow(40)])
def test_as_many_as_where_two_curves_cross(cases):
    """A second method: along the curve of orientations 1 2 3 4 the fifth condition changes its sign at each dyad."""
    rng = np.random.default_rng(24)
    for _ in range(cases):
        given = random_orientations(5, rng)
        found = dyads_of_five(given).dyads
        m = given.matrices
        crossings = []
        for curve in centre_axes(given.subset([1, 2, 3, 4]), 4000):
            condition = np.einsum("mi,ij,mj->m", curve.fixed, m[4] - m[0], curve.moving)
            ends = np.sign((curve.fixed[0] @ curve.fixed[-1]) * (curve.moving[0] @ curve.moving[-1]))
            closed = np.append(condition, ends * condition[0])
            crossings += [curve.fixed[k] for k in np.flatnonzero(closed[:-1] * closed[1:] < 0.0)]
        assert len(crossings) == len(found)
        for dyad in found:
            assert min(lines_apart(dyad.fixed, axis) for axis in crossings) < 0.01


@pytest.mark.parametrize("cases", [4, slow(30)])
def test_least_squares_find_no_other(cases):
    """A third method: every perfect fit is among the six, and nearly all of the six are found by it."""
    rng = np.random.default_rng(25)
    missed = 0
    for _ in range(cases):
        given = random_orientations(5, rng)
        found = dyads_of_five(given).dyads
        fitted = [dyad for dyad in dyads_by_least_squares(given) if dyad.misfit < 1e-8]
        for dyad in fitted:
            assert min(distance(one, dyad.fixed, dyad.moving) for one in found) < 1e-5
        missed += len(found) - len(fitted)
    assert missed <= 3


def test_the_frame_does_not_matter():
    """Turned as a whole, and with another body frame, the same orientations have the same dyads."""
    rng = np.random.default_rng(26)
    for _ in range(30):
        given = random_orientations(5, rng)
        outer, inner = Rotation.from_quat(rng.normal(size=(2, 4)))
        turned = dyads_of_five(Orientations.from_rotation(outer * given.to_rotation() * inner)).dyads
        found = dyads_of_five(given).dyads
        assert len(turned) == len(found)
        for dyad in found:
            due = outer.apply(dyad.fixed), inner.inv().apply(dyad.moving)
            assert min(distance(one, *due) for one in turned) < 1e-7


def test_the_inverse_motion_has_the_same_dyads():
    """Body and frame changed round: fixed and moving axes change round."""
    given = random_orientations(5, np.random.default_rng(27))
    found = dyads_of_five(given).dyads
    inverse = dyads_of_five(Orientations.from_rotation(given.to_rotation().inv())).dyads
    assert len(found) == len(inverse)
    for dyad in found:
        assert min(distance(one, dyad.moving, dyad.fixed) for one in inverse) < 1e-8


@pytest.mark.parametrize("size", slow_but([1e-2], [1e-1, 1e-2, 1e-3]))
def test_orientations_that_are_nearly_one(size):
    """Small displacements lose digits of the conditions, and the dyad is found to what is left."""
    rng = np.random.default_rng(28)
    for _ in range(20):
        g, w = rng.normal(size=(2, 3))
        turns = size * rng.uniform(-1.0, 1.0, (5, 2))
        body = Rotation.from_rotvec(np.outer(turns[:, 0], g)) * Rotation.from_rotvec(np.outer(turns[:, 1], w))
        found = dyads_of_five(Orientations.from_rotation(body)).dyads
        assert min((distance(dyad, g / np.linalg.norm(g), w / np.linalg.norm(w)) for dyad in found), default=1) < 1e-3


@pytest.mark.parametrize("cases", [2, slow(12)])
def test_two_dyads_that_nearly_coincide_are_both_found(cases):
    """On the way to where a pair becomes complex the pair is told apart as long as it is 1e-5 apart, and never lost."""
    rng = np.random.default_rng(29)
    distances = []
    for _ in range(cases):
        ends = [random_orientations(5, rng).quaternions for _ in range(2)]
        numbers = [6 - dyads_of_five(Orientations(q)).complex_solutions for q in ends]
        if numbers[0] == numbers[1]:
            continue
        for _ in range(50):  # halve the way to where the number changes
            middle = ends[0] + ends[1]
            middle /= np.linalg.norm(middle, axis=1, keepdims=True)
            found = dyads_of_five(Orientations(middle))
            assert max((dyad.residual for dyad in found.dyads), default=0.0) < 1e-12
            assert found.complex_solutions % 2 == 0
            pairs = [distance(a, b.fixed, b.moving) for k, a in enumerate(found.dyads) for b in found.dyads[:k]]
            distances += pairs
            assert len(found.dyads) in (6 - found.complex_solutions, 5 - found.complex_solutions)
            ends[0 if 6 - found.complex_solutions == numbers[0] else 1] = middle
    assert 1e-6 < min(distances) < 1e-5


@pytest.mark.parametrize("cases", [6, slow(60)])
def test_quarter_turns_are_all_solved_or_refused(cases):
    """Rotations of a cube: often infinitely many dyads. Where not, least squares find no dyad that is not among all."""
    rng = np.random.default_rng(30)
    cube, refused, compared = Rotation.create_group("O"), 0, 0
    for _ in range(cases):
        given = Orientations.from_rotation(cube[rng.choice(24, 5, replace=False)])
        try:
            found = dyads_of_five(given)
        except UnsolvableError as error:
            assert "infinitely many dyads" in str(error)
            refused += 1
            continue
        assert found.smallest_singular_value > 1e-4
        assert max((dyad.residual for dyad in found.dyads), default=0.0) < 1e-12
        for dyad in dyads_by_least_squares(given):
            if dyad.misfit < 1e-8:
                assert min(distance(one, dyad.fixed, dyad.moving) for one in found.dyads) < 1e-3
                compared += 1
    assert refused > cases // 20
    assert compared > 5 * cases // 3


def test_four_of_five_turns_about_one_axis_have_dyads_without_number():
    turns = Rotation.from_rotvec(np.outer([0.0, 0.3, 0.9, 1.4], [1, 2, 3]))
    given = Orientations.from_rotation(Rotation.concatenate([turns, Rotation.from_rotvec([0.4, -0.2, 1.0])]))
    with pytest.raises(UnsolvableError, match="infinitely many dyads"):
        dyads_of_five(given)


def test_turns_about_one_axis_have_dyads_without_number():
    with pytest.raises(UnsolvableError, match="infinitely many dyads, complex ones counted, take these orientations"):
        dyads_of_five(Orientations.from_axis_angles([(1, 2, 3)] * 5, [0.0, 0.3, 0.9, 1.4, 2.2]))


@pytest.mark.parametrize("n", [3, 4, 6])
def test_five_are_needed(n):
    with pytest.raises(UnsolvableError, match=f"{n} orientations; six dyads require 5"):
        dyads_of_five(random_orientations(n, np.random.default_rng(1)))
