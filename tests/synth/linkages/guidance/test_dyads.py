"""Dyads of three, four, and more than five orientations."""

import numpy as np
import pytest
from cranks import direction, lines_apart, problem, random_orientations
from scipy.spatial.transform import Rotation
from sizes import slow

from graphs.errors import InvariantError, UnsolvableError
from synth.linkages.guidance.dyads import centre_axes, dyad_of, dyads_of_four, dyads_of_three
from synth.linkages.guidance.orientations import Orientations
from synth.linkages.guidance.synthesis import dyads_by_least_squares, dyads_of_five


@pytest.mark.parametrize("cases", [50, slow(200)])
def test_three_orientations_have_a_dyad_about_any_axis(cases):
    rng = np.random.default_rng(31)
    for _ in range(cases):
        given = random_orientations(3, rng)
        axes = rng.normal(size=(4, 3))
        found = dyads_of_three(given, axes)
        assert max(dyad.residual for dyad in found) < 1e-12
        assert all(lines_apart(dyad.fixed, axis / np.linalg.norm(axis)) < 1e-12
                   for dyad, axis in zip(found, axes, strict=True))  # fmt: skip
        assert all(dyad.in_order for dyad in found)  # three are always in order one way


def test_three_orientations_of_a_known_dyad():
    rng = np.random.default_rng(32)
    for order in ("ccw", "cw"):
        for _ in range(50):
            made = problem(3, rng, order)
            [dyad] = dyads_of_three(made.orientations, [made.fixed])
            assert lines_apart(dyad.moving, made.moving) < 1e-6
            # the end of the axis may be the other one: then the turning is the other way too
            assert (dyad.direction == order) is bool(dyad.fixed @ made.fixed > 0.0)


def test_three_orientations_and_an_axis_that_leaves_the_other_open():
    given = random_orientations(3, np.random.default_rng(33))
    with pytest.raises(UnsolvableError, match="leaves its moving axis open"):
        dyads_of_three(given, [given.relative_axis(2, 3)])
    with pytest.raises(InvariantError, match="the fixed axis is zero"):
        dyads_of_three(given, [(0, 0, 0)])
    with pytest.raises(UnsolvableError, match="4 orientations; chosen fixed axes require 3"):
        dyads_of_three(random_orientations(4, np.random.default_rng(1)), [(0, 0, 1)])


def nearest(points, axis):
    return min(float(np.linalg.norm(np.cross(points, axis), axis=1).min()), 1.0)


@pytest.mark.parametrize("cases", [8, slow(60)])
def test_the_curves_of_four_orientations(cases):
    """All samples are dyads; S_ij and the dyads of any fifth orientation lie on the curves; steps are short."""
    rng = np.random.default_rng(34)
    pieces = set()
    for _ in range(cases):
        given = random_orientations(5, rng)
        four = given.subset([1, 2, 3, 4])
        curves = centre_axes(four, 1000)
        pieces.add(len(curves))
        assert max(curve.residuals.max() for curve in curves) < 1e-12
        points = np.concatenate([curve.fixed for curve in curves])
        bodies = np.concatenate([curve.moving for curve in curves])
        assert np.allclose(np.linalg.norm(points, axis=1), 1.0)
        for axis in four.relative_axes().values():
            assert nearest(points, axis) < 0.01
        for dyad in dyads_of_five(given).dyads:
            assert nearest(points, dyad.fixed) < 0.01
            assert nearest(bodies, dyad.moving) < 0.2  # the moving axis may run faster than the fixed one
        for curve in curves:
            assert np.linalg.norm(np.cross(curve.fixed, np.roll(curve.fixed, 1, axis=0)), axis=1).max() < 0.0127
    assert pieces == {1, 2}


@pytest.mark.parametrize("cases", [5, slow(20)])
def test_the_curves_hold_every_zero_of_the_cubic(cases):
    """On random great circles, every sign change of the cubic form is near a sample."""
    rng = np.random.default_rng(35)
    turn = np.linspace(0.0, np.pi, 2001)[:, None]
    for _ in range(cases):
        four = random_orientations(4, rng)
        points = np.concatenate([curve.fixed for curve in centre_axes(four, 1000)])
        m = four.matrices
        for _ in range(20):
            a, b = np.linalg.qr(rng.normal(size=(3, 2)))[0].T
            circle = np.cos(turn) * a + np.sin(turn) * b
            cubic = np.linalg.det(np.stack([circle @ (m[k] - m[0]) for k in (1, 2, 3)], axis=1))
            places = np.flatnonzero(cubic[:-1] * cubic[1:] < 0.0)
            assert len(places) % 2 == 1  # a form of odd degree
            for place in places:
                assert nearest(points, circle[place]) < 0.02


def test_dyads_sampled_from_the_curves_are_dyads():
    made = problem(4, np.random.default_rng(36))
    found = dyads_of_four(made.orientations, 200)
    assert len(found) >= 200
    assert max(dyad.residual for dyad in found) < 1e-12
    assert min(lines_apart(dyad.fixed, made.fixed) for dyad in found) < 0.05


@pytest.mark.parametrize("cases", [10, slow(60)])
def test_the_curves_of_quarter_turns(cases):
    """Rotations of a cube: the cone may hold planes and cross itself, and is found whole all the same."""
    rng = np.random.default_rng(41)
    cube = Rotation.create_group("O")
    turn = np.linspace(0.0, np.pi, 1001)[:, None]
    pieces = set()
    for _ in range(cases):
        four = Orientations.from_rotation(cube[rng.choice(24, 4, replace=False)])
        m = four.matrices
        turns_about_one = np.linalg.matrix_rank(np.array(list(four.relative_axes().values())), tol=1e-9) == 1
        if turns_about_one:
            continue
        curves = centre_axes(four)
        pieces.add(len(curves))
        assert max(curve.residuals.max() for curve in curves) < 1e-12
        points = np.concatenate([curve.fixed for curve in curves])
        for _ in range(5):
            a, b = np.linalg.qr(rng.normal(size=(3, 2)))[0].T
            circle = np.cos(turn) * a + np.sin(turn) * b
            cubic = np.linalg.det(np.stack([circle @ (m[k] - m[0]) for k in (1, 2, 3)], axis=1))
            for place in np.flatnonzero(cubic[:-1] * cubic[1:] < 0.0):
                assert nearest(points, circle[place]) < 0.05
    assert len(pieces) > 2


def test_four_turns_about_one_axis_have_no_curve():
    given = Orientations.from_axis_angles([(1, 2, 3)] * 4, [0.0, 0.3, 0.9, 1.4])
    with pytest.raises(UnsolvableError, match="every axis is that of a dyad"):
        centre_axes(given)
    with pytest.raises(UnsolvableError, match="3 orientations; a curve of dyads requires 4"):
        centre_axes(given.subset([1, 2, 3]))


@pytest.mark.parametrize("n", [slow(6), 7, 12])
def test_more_orientations_on_a_dyad_fit_it(n):
    rng = np.random.default_rng([37, n])
    for _ in range(5):
        made = problem(n, rng)
        best = dyads_by_least_squares(made.orientations)[0]
        assert lines_apart(best.fixed, made.fixed) < 1e-6
        assert lines_apart(best.moving, made.moving) < 1e-6
        assert best.misfit < 1e-7


def test_a_dyad_is_fitted_through_noise():
    rng = np.random.default_rng(38)
    made = problem(20, rng)
    noise = Rotation.from_rotvec(1e-3 * rng.normal(size=(20, 3)))
    fitted = dyads_by_least_squares(Orientations.from_rotation(noise * made.orientations.to_rotation()))
    best = fitted[0]
    assert lines_apart(best.fixed, made.fixed) < 0.01
    assert 1e-4 < best.misfit < 5e-3
    errors = [np.linalg.norm(link_errors(made, noise, dyad)) for dyad in fitted]
    assert errors == sorted(errors)


def link_errors(made, noise, dyad):
    m = (noise * made.orientations.to_rotation()).as_matrix()
    angles = np.arccos(m @ dyad.moving @ dyad.fixed)
    return angles - angles.mean()


def test_a_fit_is_a_local_minimum():
    rng = np.random.default_rng(39)

    def error(m, g, w):
        angles = np.arccos(m @ (w / np.linalg.norm(w)) @ (g / np.linalg.norm(g)))
        return float(np.square(angles - angles.mean()).sum())

    numbers = []
    for n in (5, 6, 6, 8):
        given = random_orientations(n, rng)
        m, fitted = given.matrices, dyads_by_least_squares(given)
        numbers.append(len(fitted))
        for dyad in fitted:
            least = error(m, dyad.fixed, dyad.moving)
            for _ in range(50):
                near = error(m, dyad.fixed + 1e-3 * direction(rng), dyad.moving + 1e-3 * direction(rng))
                assert near >= least - 1e-12
    assert min(numbers) >= 1
    assert max(numbers) > 1


@pytest.mark.parametrize("n", [5, 6, 40])
def test_turns_about_one_axis_fit_dyads_without_number(n):
    given = Orientations.from_axis_angles([(1, 2, 3)] * n, np.linspace(0.0, 2.0, n))
    with pytest.raises(UnsolvableError, match="infinitely many dyads take these orientations"):
        dyads_by_least_squares(given)


def test_least_squares_need_five():
    with pytest.raises(UnsolvableError, match="4 orientations have dyads without error"):
        dyads_by_least_squares(random_orientations(4, np.random.default_rng(1)))


def test_the_ends_of_axes_are_chosen():
    made = problem(5, np.random.default_rng(40))
    dyad = dyad_of(made.orientations, -made.fixed, -made.moving)
    for axis in (dyad.fixed, dyad.moving):
        assert axis[np.argmax(np.abs(axis))] > 0.0
    with pytest.raises(InvariantError, match="the moving axis is zero"):
        dyad_of(made.orientations, made.fixed, (0, 0, 0))
