"""Cones and cylinders of any size against 60 digits: what is there is found, what rounding decides says so."""

from __future__ import annotations

from math import fsum

import flint
import numpy as np
import pytest
from conical import WATT
from many_digits import DIGITS, at_most, crossed_cone, loop_on_a_cone, over, root, signed_sums
from sizes import slow

from synth.linkages.fourbar.closing import can_close, kind_of_planar, kind_of_spherical
from synth.linkages.surfaces.circuit import link_angles, link_pairs
from synth.linkages.surfaces.linkage_maps import common_surfaces
from synth.linkages.surfaces.loop_maps import map_to_cones, map_to_cylinders
from synth.linkages.surfaces.loop_sums import circumradii, cone_angles, loop_roots

EPS = np.finfo(float).eps
SMALL = np.radians([0.05300576331063594, 0.028607593438264384, 0.028193704947699714, 0.052591874821408154])
NEARLY_PARALLEL = np.radians([5.989154148123322, 5.9891541483655, 101.40900325209661, 101.40900325185983])


@pytest.fixture(autouse=True)
def _many_digits():
    before, flint.ctx.dps = flint.ctx.dps, DIGITS
    yield
    flint.ctx.dps = before


@pytest.mark.parametrize(("links", "told", "within"), [(SMALL, 11.69107, 1e-4), (NEARLY_PARALLEL, 9.76, 0.02)])
def test_a_crossed_cone_of_which_the_differences_are_small(links, told, within):
    """Differences of 1e-14 radians are many times what rounding makes of these links."""
    found = map_to_cones(links)
    (one,) = [one for one in found.cones if one.circuit == "crossed"]
    assert np.degrees(one.size) == pytest.approx(told, abs=within)
    assert float(crossed_cone(links).mid()) == pytest.approx(one.size, rel=1e-2)
    assert one.bounds[0] < float(crossed_cone(links).mid()) < one.bounds[1]
    assert "few digits" in one.caution
    assert (found.solutions, found.kind.grashof, found.kind.caution) == ("a", "Grashof", "")
    assert found.flat == ()


def random_loop(rng):
    """A loop of short links on a short arc of any cone, or all round a needle."""
    count, scale = int(rng.integers(3, 9)), 10.0 ** rng.uniform(-7.5, 0)
    short = rng.random() < 0.5
    lam = rng.uniform(0.05, 1.45) if short else np.pi / 2 - scale * rng.uniform(0.3, 1)
    return lam, *loop_on_a_cone(rng, count, lam, np.pi * scale if short else np.pi)


def separated(links, signs, turns, lam):
    """Sizes round a cone at which its loop sum is proved to be 40 times the rounding of data, either side of 0."""
    centre, far = flint.arb(lam), flint.arb.pi() / 2 - flint.arb(lam)
    for part in (1e-10, 1e-6, 1e-3, 1e-2):
        ends = [centre + sign * part * min(lam, float(far.mid())) for sign in (-1, 1)]
        if at_most(ends[1], links):
            sums = [over(links, signs, turns, end) for end in ends]
            steps = [sum(abs(over([x], [1], 0, end)) for x in links) for end in ends]
            clear = [bool(abs(s) > 40 * EPS * rough) for s, rough in zip(sums, steps, strict=True)]
            if all(clear) and sums[0] * sums[1] < 0:
                return ends
    return None


@pytest.mark.parametrize("count", [4, pytest.param(200, marks=pytest.mark.slow)])
def test_loops_of_any_size_are_found(count):
    rng = np.random.default_rng(8)
    hits = 0
    for _ in range(count):
        lam, links, signs, turns = random_loop(rng)
        ends = separated(links, signs, turns, lam)
        if ends is None or links.min() < 1e-8:
            continue
        exact = float(root(links, signs, turns, *ends).mid())
        mine = [one for one in map_to_cones(links).cones if (one.signs, one.turns) == (signs, turns)]
        (hit,) = [one for one in mine if one.bounds[0] <= exact <= one.bounds[1]]
        assert not hit.double
        hits += 1
    assert hits >= count / 2


@pytest.mark.parametrize("count", [3, pytest.param(200, marks=pytest.mark.slow)])
def test_what_is_told_without_a_caution_is_there(count):
    """The loop sum has two signs, proved, within ten times the bounds."""
    rng = np.random.default_rng(9)
    seen = 0
    for _ in range(count):
        _, links, _, _ = random_loop(rng)
        if links.min() < 1e-8:
            continue
        for one in map_to_cones(links).cones[:2]:
            ends = [flint.arb(end) for end in one.bounds]
            wider = [ends[0] - 4 * (ends[1] - ends[0]), ends[1] + 4 * (ends[1] - ends[0])]
            if one.caution or one.half_turns or not at_most(wider[1], links):
                continue
            assert over(links, one.signs, one.turns, wider[0]) * over(links, one.signs, one.turns, wider[1]) < 0
            seen += 1
    assert seen >= count


def nearly_equal_pairs(rng):
    """A near-parallelogram or a near-kite, of any size, off by 1e-6 of itself to nothing."""
    a, b = rng.uniform(0.1, 3.0, 2)
    ideal = np.array([a, b, a, b] if rng.random() < 0.5 else [a, a, b, b])
    off = 10.0 ** rng.uniform(-17, -6) * rng.uniform(-1, 1, 4)
    return (ideal + off) * 10.0 ** rng.uniform(-4, 0)


@pytest.mark.parametrize("count", [8, slow(600)])
def test_nearly_equal_pairs_of_links(count):
    """The crossed cone by its closed form to 60 digits: found where rounding does not decide, else a caution."""
    rng = np.random.default_rng(10)
    seen = {True: 0, False: 0}
    for _ in range(count):
        links = nearly_equal_pairs(rng)
        if not can_close(links):
            continue
        clear = np.abs(signed_sums(links)).min() > 40 * EPS * links.sum()
        exact, found = crossed_cone(links), map_to_cones(links)
        crossed = [one for one in found.cones if one.circuit == "crossed"]
        if clear:
            assert len(crossed) == (exact is not None)
            assert found.families == ()
            closed = cone_angles(links)
            assert not closed.ill_conditioned
            assert np.isfinite(closed.crossed) == (exact is not None)
            for one in crossed:
                assert one.bounds[0] <= float(exact.mid()) <= one.bounds[1]
        elif exact is None:
            assert not [one for one in crossed if not one.caution]
        elif not crossed:
            assert found.cautions()
        seen[bool(clear)] += 1
    assert min(seen.values()) > 1


def test_a_parallelogram_up_to_its_rounding_says_so():
    for off in (0.0, EPS):
        links = np.array([1.2, 0.5 * (1 + off), 1.2 * (1 - off), 0.5])
        found = map_to_cones(links)
        assert len(found.families) == 2
        assert found.solutions == "d"
        assert bool(found.cautions()) == (off > 0)
        assert found.to_json()["cautions"] == list(found.cautions())
        assert all(bool(one.caution) == (off > 0) for one in found.families)
        assert cone_angles(links).ill_conditioned
        plane = map_to_cylinders(links)
        assert len(plane.families) == 2
        assert bool(plane.cautions()) == (off > 0)
        assert circumradii(links).ill_conditioned
    assert all("ill-conditioned" in caution for caution in found.cautions())


def test_a_linkage_that_folds_up_to_its_rounding_says_so():
    exact, off = np.array([1.0, 0.75, 0.875, 0.625]), np.array([1.0, 0.75, 0.875, 0.625 * (1 + EPS)])
    assert map_to_cones(exact).cautions() == ()
    assert map_to_cylinders(exact).cautions() == ()
    assert len(map_to_cones(exact).flat) == len(map_to_cones(off).flat) == 1
    assert any("touches 360 k" in caution for caution in map_to_cones(off).cautions())
    assert any("stretched out" in caution for caution in map_to_cylinders(off).cautions())
    for kind in (kind_of_spherical(off), kind_of_planar(off)):
        assert (kind.grashof, kind.caution.split(":")[0]) == ("folding", "ill-conditioned")
    by_more = exact * [1, 1, 1, 1 + 100 * EPS]
    assert map_to_cones(by_more).solutions in ("a", "b")
    assert kind_of_planar(by_more).caution == ""
    assert "T1 is within" in kind_of_planar([4, 3, 5, np.nextafter(2, 3)]).caution  # 5 + it is 7 to the last digit


def test_the_residual_is_that_of_the_steps():
    for links in (SMALL, NEARLY_PARALLEL, [1.2, 0.5, 1.2 * (1 - 1e-13), 0.5], [1.0, 0.9, 0.7, 0.4, 0.3]):
        found = map_to_cones(links)
        for one in (*found.cones, *found.flat, *map_to_cylinders(links).cylinders):
            assert one.residual == fsum([*one.steps, -2 * np.pi * one.turns])
    (flat,) = map_to_cones([1.0, 0.75, 0.875, 0.625]).flat
    assert (np.abs(flat.steps) == [1.0, 0.75, 0.875, 0.625]).all()


@pytest.mark.parametrize("unit", [slow(1e-9), 1e9])
@pytest.mark.parametrize("links", [[4.0, 3.0, 5.0, 1.0], [4.0, 3.0, 5.0, 2.0 - 1e-11], [1.0, 0.7, 0.6, 0.9, 0.2]])
def test_cylinders_do_not_depend_on_the_unit(links, unit):
    one, other = map_to_cylinders(links), map_to_cylinders(np.multiply(links, unit))
    assert [(x.signs, x.turns, x.circuit) for x in one.cylinders] == [
        (x.signs, x.turns, x.circuit) for x in other.cylinders
    ]
    for x, y in zip(one.cylinders, other.cylinders, strict=True):
        assert y.bounds[0] <= x.size * unit <= y.bounds[1] or y.size == pytest.approx(x.size * unit, rel=1e-12)
        exact = root(links, x.signs, x.turns, *(flint.arb(max(e, max(links) / 2)) for e in wider(x)), planar=True)
        assert exact is None or float(exact.mid()) == pytest.approx(x.size, rel=1e-4)
    assert len(one.cylinders) > 1
    if one.kind is not None:
        assert (one.kind.grashof, one.kind.name) == (other.kind.grashof, other.kind.name)


def wider(one):
    return one.size * (1 - 1e-3), one.size * (1 + 1e-3)


def test_small_links_that_cannot_close_are_told_from_those_that_do():
    links = 1e-6 * np.array([1.0, 0.5, 0.25, 0.25])
    off = np.array([1e-9, 0, 0, 0])
    assert can_close([links, links * (1 - off), links * (1 + off)]).tolist() == [True, True, False]


def test_small_linkages_of_several_loops():
    """What closes is measured by the steps: links of 1e-8 do not close with any signs."""
    rng = np.random.default_rng(3)
    for scale in (1.0, 1e-4):
        places, lam = rng.uniform(-np.pi, np.pi, 7), np.pi / 2 - scale
        at = dict(zip(WATT.joints, places, strict=True))
        angles = {(a, b): float(link_angles(at[b] - at[a], lam)) for a, b in link_pairs(WATT)}
        cones, families = common_surfaces(WATT, angles)
        (one,) = cones
        assert (one.surface.angle, one.caution) == (pytest.approx(lam, rel=1e-6), "")
        assert families == ()
    # on a short arc the loops close nearly flat: the tolerance lets them close on any cone
    at = dict(zip(WATT.joints, 1e-4 * places, strict=True))
    angles = {(a, b): float(link_angles(at[b] - at[a], 0.7)) for a, b in link_pairs(WATT)}
    cones, families = common_surfaces(WATT, angles)
    assert cones
    assert all("lambda is undetermined" in one.caution for one in cones)


def test_a_family_of_several_loops_within_rounding_says_so():
    known = link_pairs(WATT)
    ends = [(a, b) for loop in WATT.loops for a, b in zip(loop.joints, np.roll(loop.joints, -1), strict=True)]
    pairs = [(a, b) if (a, b) in known else (b, a) for a, b in ends]
    angles = dict(zip(pairs, [1.0, 0.6] * 4, strict=True))
    off = {**angles, pairs[0]: 1.0 + EPS}
    for given, told in ((angles, False), (off, True)):
        families = common_surfaces(WATT, given)[1]
        assert len(families) > 1
        assert [bool(family.caution) for family in families] == [told] * len(families)


def test_roots_do_not_depend_on_how_small_the_other_loops_are():
    """Many loops at a time: a large one beside a small one changes nothing."""
    reach = np.tan(np.stack([SMALL, NEARLY_PARALLEL]) / 2) ** -2
    both, apart = loop_roots(reach, 1), [loop_roots(one, 1) for one in reach]
    assert both.size.tolist() == [size for one in apart for size in one.size.tolist()]
    assert both.loop.tolist() == [0, 0, 1, 1]


def test_longest_links_that_differ_by_a_last_digit():
    """The crossed cone is nearer to the end than rounding can tell: it is told once, its bounds hold it."""
    links = np.array([1.5, 0.6 * (1 - 1e-13), 1.5 * (1 - EPS / 2), 0.6])
    exact = crossed_cone(links)
    (one,) = [one for one in map_to_cones(links).cones if one.circuit == "crossed"]
    assert one.bounds[0] < float(exact.mid()) < one.bounds[1]
    assert one.half_turns == (0, 2)
    assert "several links" in one.caution
