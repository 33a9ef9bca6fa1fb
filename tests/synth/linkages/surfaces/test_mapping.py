"""Three methods of mapping against each other, and against the linkage rebuilt in space."""

from __future__ import annotations

import numpy as np
import pytest
from by_coordinates import cone_angles_by_coordinates, polygons_by_coordinates, quadrilaterals_by_coordinates
from conical import random_lengths, random_link_angles, random_linkages
from four_bar_configurations import check_configuration
from paper_formulas import central_angles, projected_angles
from scipy.optimize import brentq, minimize_scalar
from sizes import first_quick, slow, slow_but

from graphs.errors import InvariantError, UnsolvableError
from synth.linkages.fourbar.closing import can_close, planar_differences, spherical_differences
from synth.linkages.surfaces.circuit import circuits, link_angles
from synth.linkages.surfaces.loop_maps import (
    chords,
    cone_reach,
    cylinder_reach,
    map_to_cones,
    map_to_cylinders,
    solution_class,
)
from synth.linkages.surfaces.loop_sums import (
    MOST_LINKS,
    circumradii,
    cone_angles,
    half_steps,
    loop_roots,
    loop_sum,
    sign_patterns,
)

COUNT = 10_000


def by_loop_sum(reach, base):
    """Sizes of the open and the crossed circle of each four-bar, nan where there is none."""
    found = loop_roots(reach, base)
    steps = 2 * found.signs * half_steps(found.size[:, None], reach[found.loop], base)
    sizes = np.full((len(reach), 2), np.nan)
    column = np.where(circuits(steps).open, 0, 1)
    assert len(set(zip(found.loop.tolist(), column.tolist(), strict=True))) == len(column)
    sizes[found.loop, column] = found.size
    return sizes


def agree(first, second, tolerance):
    assert (np.isnan(first) == np.isnan(second)).all()
    there = ~np.isnan(first)
    assert (np.abs(first - second)[there] <= np.broadcast_to(tolerance, first.shape)[there]).all()


@pytest.mark.parametrize("count", [3_000, slow(COUNT)])
def test_three_methods_agree_on_cones(count, rng):
    angles = random_link_angles(rng, count)
    assert len(angles) == count
    near = np.abs(spherical_differences(angles)).min(axis=1, keepdims=True) < 1e-6
    tolerance = np.where(near, 1e-5, 1e-9)
    closed = cone_angles(angles)
    closed = np.stack([closed.open, closed.crossed], axis=1)
    agree(np.arctan(np.sqrt(by_loop_sum(cone_reach(angles), 1))), closed, tolerance)
    agree(cone_angles_by_coordinates(angles), closed, tolerance)


@pytest.mark.parametrize("which", first_quick(1, range(4)))
def test_three_methods_agree_near_folding(which, rng):
    """Within 1e-6 of folding lambda is near 0, where it is the root of a small number."""
    angles = random_link_angles(rng, 2000)
    off = spherical_differences(angles)[:, which]
    wanted = rng.choice([-1, 1], len(angles)) * 10 ** rng.uniform(-9, -6, len(angles))
    angles[:, 3] += (wanted - off) * [-1, 1, 1, -1][which]
    keep = (angles[:, 3] > 0.05) & (angles[:, 3] < np.pi - 0.05) & can_close(angles)
    others = np.delete(spherical_differences(angles), which, axis=1)
    angles = angles[keep & (np.abs(others).min(axis=1) > 0.05)]
    assert len(angles) > 200
    np.testing.assert_array_less(np.abs(spherical_differences(angles)[:, which]), 1.01e-6)
    closed = cone_angles(angles)
    closed = np.stack([closed.open, closed.crossed], axis=1)
    agree(np.arctan(np.sqrt(by_loop_sum(cone_reach(angles), 1))), closed, 1e-5)
    agree(cone_angles_by_coordinates(angles), closed, 1e-5)


@pytest.mark.parametrize("count", [3_000, slow(COUNT)])
def test_three_methods_agree_on_cylinders(count, rng):
    lengths = random_lengths(rng, count)
    assert len(lengths) == count
    near = np.abs(planar_differences(lengths)).min(axis=1, keepdims=True) < 1e-6
    closed = circumradii(lengths)
    closed = np.stack([closed.open, closed.crossed], axis=1)
    # a radius is large where the linkage nearly folds: relative errors
    radii = 0.5 / np.sqrt(by_loop_sum(cylinder_reach(lengths), 0))
    agree(radii / closed, closed / closed, np.where(near, 1e-5, 1e-9))
    others = quadrilaterals_by_coordinates(lengths).radius * lengths[:, :1]
    agree(others / closed, closed / closed, np.where(near, 1e-5, 1e-9))


@pytest.mark.parametrize("count", [3_000, slow(COUNT)])
def test_non_grashof_linkages_are_never_crossed_but_for_cones_with_t4_below_zero(count, rng):
    lengths = random_lengths(rng, count)
    grashof = planar_differences(lengths).prod(axis=1) > 0
    crossed = ~np.isnan(by_loop_sum(cylinder_reach(lengths), 0)[:, 1])
    assert (crossed == grashof).all()
    angles = random_link_angles(rng, count)
    t = spherical_differences(angles)
    crossed = ~np.isnan(by_loop_sum(cone_reach(angles), 1)[:, 1])
    grashof, positive = t.prod(axis=1) > 0, t[:, 3] > 0
    assert (crossed == (grashof == positive)).all()


@pytest.mark.parametrize("links", slow_but([3, 5], range(3, 7)))
def test_mapped_linkages_rebuilt_in_space(links, rng):
    """Link angles to 1e-12, every axis on the cone."""
    angles = random_link_angles(rng, {4: COUNT}.get(links, 1000), links)
    found = loop_roots(cone_reach(angles), 1)
    assert len(found.loop) > 400
    steps = 2 * found.signs * half_steps(found.size[:, None], cone_reach(angles)[found.loop], 1)
    lam = np.arctan(np.sqrt(found.size))
    check = check_configuration(angles[found.loop], steps, lam)
    assert check.link_angles.max() < 1e-12
    assert check.on_cone.max() < 1e-12


@pytest.mark.parametrize(("links", "count"), [(4, 4000), slow(5, 2000), slow(6, 1000), slow(7, 300), slow(8, 100)])
def test_loops_drawn_on_cones_are_found_again(links, count, rng):
    _, steps, lam, angles = random_linkages(rng, count, links)
    found = loop_roots(cone_reach(angles), 1)
    signs = np.sign(steps) * np.sign(steps[:, :1])
    hit = (np.abs(np.arctan(np.sqrt(found.size)) - lam[found.loop]) < 1e-6) & (found.signs == signs[found.loop]).all(1)
    assert set(found.loop[hit].tolist()) == set(range(count))
    assert np.abs(found.residual).max() < 1e-7


@pytest.mark.parametrize(("links", "count"), [(3, 1000), (4, 4000), slow(5, 2000), slow(6, 1000), slow(8, 100)])
def test_loops_drawn_on_cylinders_are_found_again(links, count, rng):
    """Radius 1; other circles of the same loop close too."""
    _, steps, _, _ = random_linkages(rng, count, links)
    lengths = chords(steps, 1.0)
    found = loop_roots(cylinder_reach(lengths), 0)
    radius = 0.5 / np.sqrt(found.size)
    signs = np.sign(steps) * np.sign(steps[:, :1])
    hit = (np.abs(radius - 1) < 1e-6) & (found.signs == signs[found.loop]).all(1)
    assert set(found.loop[hit].tolist()) == set(range(count))
    psi = central_angles(lengths[found.loop], np.maximum(radius, lengths[found.loop].max(1) / 2)[:, None])
    gap = (found.signs * psi).sum(axis=1) - 2 * np.pi * found.turns
    assert np.abs(gap).max() < 1e-6
    assert np.isfinite(radius).all()


def test_no_loops_have_no_circles():
    found = loop_roots(np.zeros((0, 4)), 1)
    assert found.size.shape == (0,)
    assert found.signs.shape == (0, 4)


@pytest.mark.parametrize("links", [5, slow(6)])
def test_loop_sums_against_a_dense_scan(links, rng):
    """No crossing of a fine grid is missed, and no root is between points that do not cross."""
    angles = random_link_angles(rng, 150, links)
    reach = cone_reach(angles)
    found = loop_roots(reach, 1)
    patterns = sign_patterns(links)
    grid = np.sin(np.linspace(0, np.pi / 2, 3001)) ** 2
    for loop in range(len(angles)):
        size = reach[loop].min() * grid
        sums = loop_sum(size[None, :], reach[loop], patterns[:, None, :], 1) / (2 * np.pi)
        low, high = np.minimum(sums[:, 1:], sums[:, :-1]), np.maximum(sums[:, 1:], sums[:, :-1])
        cross = int((np.floor(high) - np.floor(low)).sum())
        mine = found.loop == loop
        assert mine.sum() >= cross
        assert (mine.sum() - cross) % 2 == 0  # what a scan misses comes in pairs
        for signs, turns, size_ in zip(found.signs[mine], found.turns[mine], found.size[mine], strict=True):
            assert abs(loop_sum(size_, reach[loop], signs, 1) - 2 * np.pi * turns) < 1e-7


def top_of_sum(angles, signs):
    """Where along [0, end] a loop sum is greatest, as a part of it, and how great."""
    reach = cone_reach(angles)
    found = minimize_scalar(
        lambda part: -loop_sum(part * reach.min(), reach, signs, 1), bounds=(0, 1), options={"xatol": 1e-12}
    )
    return found.x, -found.fun


def touching_loops(over, wanted):
    """Six-bar loops with a sum whose top is inside, and as much as told over a multiple of 360 degrees."""
    rng = np.random.default_rng(5)
    while wanted:
        angles = rng.uniform(0.3, 2.2, 6)
        signs = rng.choice(np.array([1, -1], np.int8), 6)
        signs[0] = 1
        goal = 2 * np.pi * round(top_of_sum(angles, signs)[1] / (2 * np.pi)) + over

        def excess(last, angles=angles, signs=signs, goal=goal):
            return top_of_sum([*angles[:5], last], signs)[1] - goal

        if excess(0.05) * excess(angles[:5].max()) < 0:
            angles[5] = brentq(excess, 0.05, angles[:5].max(), xtol=1e-15, rtol=1e-15)
            if 0.1 < top_of_sum(angles, signs)[0] < 0.9 and abs(excess(angles[5])) < 1e-14:
                wanted -= 1
                yield angles, signs, round(goal / (2 * np.pi))


@pytest.mark.parametrize(
    ("over", "count", "loops"),
    [
        slow(-1e-7, 0, 1),
        (1e-10, 2, 1),
        *(pytest.param(*case, 4, marks=pytest.mark.slow) for case in ((-1e-7, 0), (0.0, 1), (1e-7, 2), (1e-10, 2))),
    ],
)
def test_a_sum_that_touches_a_multiple_of_360_degrees(over, count, loops):
    """Below it, there, and over it by so little that no scan sees the two roots."""
    for angles, signs, turns in touching_loops(over, loops):
        found = loop_roots(cone_reach(angles), 1)
        mine = (found.signs == signs).all(axis=1) & (found.turns == turns)
        part = found.size[mine] / cone_reach(angles).min()
        near = np.abs(part - top_of_sum(angles, signs)[0]) < 0.05
        assert near.sum() == count
        assert (found.double[mine][near] == (over == 0.0)).all()


@pytest.mark.parametrize("links", first_quick(1, range(4, 8)))
def test_coordinates_find_the_circles_of_loop_sums(links, rng):
    for angles in random_link_angles(rng, 25, links):
        chord = 2 * np.sin(angles / 2)
        found = polygons_by_coordinates(chord, 1.0)
        assert found.residual.max(initial=0.0) < 1e-10
        sizes = loop_roots(cone_reach(angles), 1).size
        radii = np.cos(np.arctan(np.sqrt(sizes)))
        mine = found.radius * chord[0]
        inside = mine <= 1
        np.testing.assert_allclose(np.sort(mine[inside]), np.sort(radii), atol=1e-9)
        for steps in found.steps[inside]:
            assert circuits(steps).residual == pytest.approx(0, abs=1e-9)


def test_equal_links_make_families_of_any_size():
    found = map_to_cones(np.radians([50, 70, 50, 90, 70, 90]))
    assert (1, 1, -1, 1, -1, -1) in {one.signs for one in found.families}
    for one in found.families:
        for lam in np.linspace(0.05, 0.7, 4):
            assert abs(np.dot(one.signs, projected_angles(found.angles, lam))) < 1e-13
    assert len(map_to_cylinders([3, 3, 3, 3, 3, 3]).families) == 10


def test_half_turns_have_no_sign():
    """Steps 180, 60, 50, 70: the link of half a turn is marked, and the pattern listed once."""
    angles = link_angles(np.radians([180, 60, 50, 70]), 0.5)
    found = map_to_cones(angles)
    (one,) = [one for one in found.cones if abs(one.size - 0.5) < 1e-9]
    assert one.half_turns == (0,)
    assert (one.signs, one.turns, one.circuit) == ((1, 1, 1, 1), 1, "open")
    # on a family's last cone the long links span half the circle: it is not listed by itself
    assert [one.circuit for one in map_to_cones(np.radians([120, 50, 120, 50])).cones] == ["open"]


def test_angles_near_180_degrees_are_told_apart():
    """Their reaches are squares of small numbers."""
    steps = np.array([np.pi - 1e-3, 1e-3 - np.pi + 4e-4, 0.5, -0.5 - 4e-4])
    angles = link_angles(steps, 1e-3)
    found = map_to_cones(angles)
    assert not found.families
    assert min(abs(one.size - 1e-3) for one in found.cones) < 1e-9


def test_a_step_that_is_nearly_half_a_turn_has_a_sign():
    angles = link_angles(np.radians([60, -180 + 1e-5, 50, 70 - 1e-5]), 0.5)
    (one,) = [one for one in map_to_cones(angles).cones if one.signs == (1, -1, 1, 1)]
    assert (one.half_turns, one.turns) == ((), 0)
    assert abs(one.size - 0.5) < 1e-9


@pytest.mark.parametrize("lack", [1e-9, 1e-12])
def test_a_step_of_which_no_float_can_tell_half_a_turn_has_its_sign(lack):
    """The circle is the last before the end, to the last digit of its size; the loop sum has proved its sign there."""
    angles = link_angles(np.add(np.radians([60, -180, 50, 70]), [0, lack, 0, -lack]), 0.5)
    (one,) = [one for one in map_to_cones(angles).cones if abs(one.size - 0.5) < 1e-9]
    assert (one.signs, one.turns, one.half_turns) == ((1, -1, 1, 1), 0, ())
    assert abs(one.residual) < 2 * lack


def test_angles_over_180_are_the_other_way_round():
    assert map_to_cones(np.radians([300, 60, 60])).angles == pytest.approx(np.radians([60, 60, 60]))


def test_why_there_is_no_cone():
    assert map_to_cones(np.radians([170, 160, 150, 145])).why.startswith("T4 < 0")
    assert "180 degrees fits on no cone" in map_to_cones(np.radians([180, 60, 120, 60])).why
    assert "in a plane only" in map_to_cones(np.radians([60, 50, 110])).why
    assert "infinite radius" in map_to_cylinders([3, 1, 1, 1]).why
    pentagon = map_to_cones(np.radians([100, 100, 100, 100, 100]))
    assert pentagon.kind is None
    assert pentagon.supplementary is None
    assert "no loop sum" in map_to_cones(np.radians([144.3, 103.8, 36.7, 172.3, 53.4])).why


@pytest.mark.parametrize("count", [15, slow(300)])
def test_supplementary_linkage_is_offered_where_t4_is_below_zero(count, rng):
    offered = 0
    for angles in random_link_angles(rng, count):
        found = map_to_cones(angles)
        none = spherical_differences(angles)[3] < 0 and solution_class(angles) == "none"
        assert (found.supplementary is not None) == none == (not found.cones)
        if none:
            assert len(found.supplementary.cones) == 2
            offered += 1
    assert offered > count / 6


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e9])
def test_cylinders_have_no_unit(scale):
    radii = [one.size for one in map_to_cylinders(np.array([4, 3, 5, 1, 2.5]) * scale).cylinders]
    plain = [one.size for one in map_to_cylinders([4, 3, 5, 1, 2.5]).cylinders]
    np.testing.assert_allclose(radii, np.array(plain) * scale, rtol=1e-12)


@pytest.mark.parametrize(
    ("angles", "message"),
    [
        ([-10, 20, 30], "link angle 1 is -10 degrees; expected between 0 and 360"),
        ([10, 361, 30], "link angle 2 is 361 degrees"),
        ([0, 10, 10], "link angle 1 is 0 degrees"),
        ([10, 20, 50], "10, 20, 50 cannot close: the longest is longer"),
        ([150, 150, 150], "cannot close: they are too long for the sphere"),
        ([10, 20], "2 link angles; expected three or more"),
        ([10, float("nan"), 20], "not all numbers"),
        ([10, 10, 1e-200], "link angle 3 is 1e-200 degrees; expected one that can be told from 0"),
    ],
)
def test_link_angles_that_no_loop_has(angles, message):
    with pytest.raises(InvariantError) as error:
        map_to_cones(np.radians(angles))
    assert message in str(error.value)


@pytest.mark.parametrize(
    ("lengths", "message"),
    [
        ([1, 1, 1e-200], "length 3 is 1e-200, the longest 1; expected lengths within"),
        ([1, -2, 2], "length 2 is -2"),
        ([1, 2, 4], "1, 2, 4 cannot close"),
        ([1, 0, 1], "length 2 is 0"),
    ],
)
def test_lengths_that_no_loop_has(lengths, message):
    with pytest.raises(InvariantError) as error:
        map_to_cylinders(lengths)
    assert message in str(error.value)


def test_loops_of_too_many_links():
    with pytest.raises(UnsolvableError, match=f"a loop of {MOST_LINKS + 1} links; expected 3 to {MOST_LINKS}"):
        loop_roots(np.ones(MOST_LINKS + 1), 0)
    with pytest.raises(UnsolvableError, match="a loop of 2 links"):
        loop_roots(np.ones(2), 0)


@pytest.mark.parametrize("cone_angle", [np.pi / 2, -0.1, np.nan, 2.0])
def test_cone_angles_that_no_cone_has(cone_angle):
    for call in (link_angles, projected_angles):
        with pytest.raises(InvariantError, match="expected 0 or more, and less than 90"):
            call(1.0, cone_angle)


def test_projected_and_link_angles_undo_each_other(rng):
    steps, lam = rng.uniform(0, np.pi, 5000), rng.uniform(0, 1.5, 5000)
    np.testing.assert_allclose(projected_angles(link_angles(steps, lam), lam), steps, atol=2e-7)


@pytest.mark.slow
def test_sixteen_links():
    """All 32 768 sign patterns of a loop of 16 links."""
    rng = np.random.default_rng(0)
    _, steps, lam, angles = random_linkages(rng, 1, 16)
    found = loop_roots(cone_reach(angles), 1)
    signs = np.sign(steps[0]) * np.sign(steps[0, 0])
    near = np.abs(np.arctan(np.sqrt(found.size)) - lam[0]) < 1e-6
    assert (found.signs[near] == signs).all(axis=1).any()
