"""Four-bars: types, limits and positions against closure in the plane and on the sphere."""

from __future__ import annotations

import numpy as np
import pytest
from conical import random_lengths, random_link_angles, random_linkages
from four_bar_configurations import configurations_from_conformed, measured_dihedral_angles
from paper_formulas import in_a_hemisphere, input_limits_planar, transmission_planar
from sizes import slow

from graphs.errors import InvariantError
from graphs.geometry import angles_between
from graphs.mechanism.surfaces import joint_axes
from synth.linkages.conformed.dihedrals import dihedral_angles
from synth.linkages.fourbar.closing import (
    kind_of_planar,
    kind_of_spherical,
    minimal_supplementary,
    planar_differences,
    spherical_differences,
    supplementary,
)
from synth.linkages.fourbar.position import (
    input_limits_spherical,
    output_planar,
    output_spherical,
    transmission_spherical,
)
from synth.linkages.surfaces.loop_sums import cone_angles

THETA = np.radians(np.arange(-180, 180, 0.5) + 0.25)


def planar_points(lengths, theta, psi):
    g, a, _, b = lengths.T[..., None]
    zero = np.zeros_like(theta)
    return (np.stack([zero, zero], -1), a[..., None] * np.stack([np.cos(theta), np.sin(theta)], -1),
            np.stack([g + b * np.cos(psi), b * np.sin(psi)], -1), np.stack([g + zero, zero], -1))  # fmt: skip


def spherical_axes(angles, theta, psi):
    gamma, alpha, _, beta = angles.T[..., None]
    a = np.stack([np.sin(alpha) * np.cos(theta), np.sin(alpha) * np.sin(theta), np.cos(alpha) + 0 * theta], -1)
    x, y, z = np.sin(beta) * np.cos(psi), np.sin(beta) * np.sin(psi), np.cos(beta)
    b = np.stack([np.cos(gamma) * x + np.sin(gamma) * z, y, np.cos(gamma) * z - np.sin(gamma) * x], -1)
    return a, b


@pytest.mark.parametrize("branch", [1, -1])
def test_output_angles_close_the_loop(branch, rng):
    lengths, angles = random_lengths(rng, 200), random_link_angles(rng, 200)
    theta = np.broadcast_to(THETA[::20], (200, 36))
    psi = output_planar(lengths[:, None], theta, branch)
    _, a, b, _ = planar_points(lengths, theta, psi)
    there = np.isfinite(psi)
    assert there.sum() > 1000
    gap = np.linalg.norm(b - a, axis=-1) - lengths[:, 2:3]
    assert np.abs(gap[there]).max() < 1e-7
    psi = output_spherical(angles[:, None], theta, branch)
    a, b = spherical_axes(angles, theta, psi)
    there = np.isfinite(psi)
    assert there.sum() > 1000
    gap = angles_between(a, b) - angles[:, 2:3]
    assert np.abs(gap[there]).max() < 1e-6


def test_reach_is_what_the_limits_say(rng):
    lengths, angles = random_lengths(rng, 500), random_link_angles(rng, 500)
    theta = np.broadcast_to(THETA, (500, len(THETA)))
    for given, output, limits in (
        (lengths, output_planar, input_limits_planar),
        (angles, output_spherical, input_limits_spherical),
    ):
        there = np.isfinite(output(given[:, None], theta))
        ends = limits(given)
        low, high = np.nan_to_num(ends[:, :1], nan=-1.0), np.nan_to_num(ends[:, 1:], nan=9.0)
        far = np.abs(theta)
        inside = (far > low) & (far < high)
        near = np.minimum(np.abs(far - low), np.abs(far - high)) < 1e-6
        assert (there == inside)[~near].all()


def swing(there):
    """What a link does, from where it gets: 0 is in the middle of THETA, pi at its ends."""
    middle, ends = there[len(there) // 2], there[0]
    if there.all():
        return "crank"
    return {(True, False): "0-rocker", (False, True): "pi-rocker", (False, False): "rocker"}[middle, ends]


def test_types_are_what_input_and_output_reach(rng):
    """Every type occurs, planar and spherical, by looking which angles are reached."""
    names = {"plane": set(), "sphere": set()}
    for kind, given, name, output, differences in (
        ("plane", random_lengths(rng, 400), kind_of_planar, output_planar, planar_differences),
        ("sphere", random_link_angles(rng, 400), kind_of_spherical, output_spherical, spherical_differences),
    ):
        for links in given:
            if np.abs(differences(links)).min() < 0.02:
                continue  # a range may end between two angles of the grid
            found = name(links)
            # the output is the input of the linkage turned round, where psi is 180 degrees less theta
            back = links[[0, 3, 2, 1]]
            reach_in = np.isfinite(output(links, THETA))
            reach_out = np.isfinite(output(back, np.pi - THETA))
            assert (found.input, found.output) == (swing(reach_in), swing(reach_out))
            assert ("crank" in (found.input, found.output) or found.name == "double-rocker") == (
                found.grashof == "Grashof"
            )
            names[kind].add(found.name)
    eight = {"crank-rocker", "rocker-crank", "double-crank", "double-rocker", "0-0 double-rocker", "0-pi double-rocker",
             "pi-0 double-rocker", "pi-pi double-rocker"}  # fmt: skip
    assert names == {"plane": eight, "sphere": eight}


def test_transmission_angles(rng):
    lengths, angles = random_lengths(rng, 100), random_link_angles(rng, 100)
    theta = np.broadcast_to(THETA[::15], (100, 48))
    psi = output_planar(lengths[:, None], theta)
    _, a, b, c = planar_points(lengths, theta, psi)
    pad = np.zeros((*theta.shape, 1))
    measured = angles_between(np.concatenate([a - b, pad], -1), np.concatenate([c - b, pad], -1))
    there = np.isfinite(psi)
    np.testing.assert_allclose(transmission_planar(lengths[:, None], theta)[there], measured[there], atol=1e-6)
    psi = output_spherical(angles[:, None], theta)
    a, b = spherical_axes(angles, theta, psi)
    c = np.stack([np.sin(angles[:, 0]), 0 * angles[:, 0], np.cos(angles[:, 0])], -1)[:, None] + 0 * b
    measured = np.abs(measured_dihedral_angles(np.stack([a, b, c], -2))[..., 1])
    there = np.isfinite(psi)
    np.testing.assert_allclose(transmission_spherical(angles[:, None], theta)[there], measured[there], atol=1e-5)


def test_motion_from_the_conformed_pose_keeps_the_links(rng):
    for i, (_, steps, lam, angles) in enumerate(zip(*random_linkages(rng, 200), strict=True)):
        found = configurations_from_conformed(steps, lam, np.linspace(-0.3, 0.3, 7))
        there = np.isfinite(found.psi)
        assert there[3], i
        lengths = angles_between(found.axes, np.roll(found.axes, -1, axis=1))
        assert np.abs(lengths - angles)[there].max() < 1e-6
        assert found.residual[there].max() < 1e-6


@pytest.mark.parametrize(("steps", "lam", "message"), [
    ([50, 110, 80, 100], 20, "the steps do not close"), ([50, 110, 80, 120], 0, "dead point"),
    ([50, 110, 80, 120], 90, "cone angle is 90 degrees"), ([50, 110, 80], 20, "do not close"),
])  # fmt: skip
def test_poses_that_cannot_be(steps, lam, message):
    with pytest.raises(InvariantError, match=message):
        configurations_from_conformed(np.radians(steps), np.radians(lam), [0.0])


def test_dihedral_angles_measured_in_space(rng):
    for links in (3, 4, 5, 6):
        places, steps, lam, _ = random_linkages(rng, 2000, links)
        measured = measured_dihedral_angles(joint_axes(places, lam))
        assert np.abs(np.angle(np.exp(1j * (measured - dihedral_angles(steps, lam))))).max() < 1e-6


def test_supplementary_linkages_have_the_same_joint_lines(rng):
    """Turning axes round in space gives the 16 tuples of angles."""
    places, _, lam, angles = random_linkages(rng, 100)
    axes = joint_axes(places, lam)
    every = supplementary(angles)
    from itertools import product

    for number, ends in enumerate(product((1, -1), repeat=4)):
        turned = axes * np.array(ends)[:, None]
        measured = angles_between(turned, np.roll(turned, -1, axis=1))
        np.testing.assert_allclose(every[:, number], measured, atol=1e-12)
    least = minimal_supplementary(angles)
    t = spherical_differences(angles)
    np.testing.assert_allclose(spherical_differences(least)[:, 3], np.abs(t).max(axis=1), atol=1e-12)
    np.testing.assert_allclose(least.sum(axis=1), every.sum(axis=2).min(axis=1), atol=1e-12)
    # with the same circle's other caps: a Grashof linkage with T4 < 0 has a supplementary one with two cones
    grashof = t.prod(axis=1) > 1e-6
    found = cone_angles(least[grashof])
    assert np.isfinite(found.open).all()
    assert np.isfinite(found.crossed).all()


@pytest.mark.parametrize("number", [100, slow(500)])
def test_hemispheres_against_many_directions(number, rng):
    axes = rng.normal(size=(number, 4, 3))
    axes /= np.linalg.norm(axes, axis=-1, keepdims=True)
    poles = rng.normal(size=(20_000, 3))
    by_search = ((axes @ poles.T) > 0).all(axis=1).any(axis=1)
    found = in_a_hemisphere(axes)
    assert not (by_search & ~found).any()
    assert (found != by_search).mean() < 0.02  # the search misses thin cones of poles
    places, _, lam, _ = random_linkages(rng, 200)
    assert in_a_hemisphere(joint_axes(places, lam)).all()  # the cone's axis is a pole of all


@pytest.mark.parametrize("links", [[1, 2], [1, 2, 3, 4, 5]])
def test_a_four_bar_has_four_links(links):
    with pytest.raises(InvariantError, match="expected 4 in loop order"):
        kind_of_planar(links)
