"""Hyatt, Magleby, Howell 2020 (linkages on right cones): every number of the paper, and its misprints put right."""

import json
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from conical import FOUR_BAR, crosses, random_link_angles, random_linkages
from conical_rows import canonical_row
from four_bar_configurations import configurations_from_conformed
from golden_numbers import golden_numbers
from memberships import memberships
from paper_formulas import projected_angles, table1
from second_methods import pole_axes
from sizes import slow

from enumerate.conical.query import Portion
from graphs.count.report import mobility_report
from graphs.files.formats import read, read_linkage
from graphs.geometry import rotated
from graphs.mechanism.surfaces import Cone, joint_axes
from synth.linkages.conformed.dihedrals import dihedral_angles
from synth.linkages.conformed.rates import ConformedChain, first_order
from synth.linkages.fourbar.closing import grashof_class, kind_of_spherical, spherical_differences, supplementary
from synth.linkages.surfaces.circuit import azimuths, circuits, link_angles, link_pairs, loop_steps
from synth.linkages.surfaces.loop_maps import largest_cone_angle, map_to_cones
from synth.linkages.surfaces.loop_sums import circumradii, cone_angles, loop_roots
from synth.synthesis.candidates.job import CandidateJob

DATA = Path(__file__).resolve().parents[2] / "data"
PAPER = golden_numbers()["000"]
LOOP_ORDER = ("alpha", "eta", "beta", "gamma")


def degrees_of(entry, order=LOOP_ORDER):
    return np.array([entry["inputs"][name] for name in order], dtype=float)


def test_four_bars_on_cones_are_spherical_four_bars(golden):
    """Fig. 10: four sets of link angles, one type. Angles and cones are no part of a type."""
    assert all(f"fig10{case}_T" in golden["000"] for case in "abcd")
    report = mobility_report(read(DATA / "hyatt" / "spherical-four-bar.json"))
    assert (report.mechanism_class, report.mobility) == ("spherical", 1)
    assert report.equations["traditional_cgk"].applies


def test_fig_11_is_a_stephenson_chain(golden):
    """000-8: six steps are an open spanning chain through the seven axes; one more closes it."""
    sc = read(DATA / "hyatt" / "fig11-stephenson.json")
    steps = golden["000"]["fig11_stephenson2"]["printed"]["projected"]
    assert len(steps) + 1 == len(sc.joints)
    assert len(sc.centre_classes()) == 1
    assert mobility_report(sc).mobility == 1


@pytest.mark.parametrize("case", "abcd")
def test_fig_10_types(case):
    entry = PAPER[f"fig10{case}_T"]
    angles = np.radians(degrees_of(entry, ("gamma", "alpha", "eta", "beta")))
    t = np.degrees(spherical_differences(angles))
    wanted = entry["computed"]
    np.testing.assert_allclose(t, [wanted[f"T{i}"] for i in (1, 2, 3, 4)], atol=1e-12)
    assert np.prod(t.round(9)) == pytest.approx(wanted["product"])
    told = {"Grashof": "Grashof", "nonGrashof": "non-Grashof", "folding": "folding"}[wanted["cls"]]
    assert str(grashof_class(np.radians(t))) == told == kind_of_spherical(angles).grashof
    assert map_to_cones(angles).solutions == case


@pytest.mark.parametrize("case", "abc")
def test_fig_10_cones(case):
    entry = PAPER[f"fig10{case}_cones"]
    angles = np.radians(degrees_of(entry))
    wanted, tol = entry["computed"], np.radians(entry["tol"])
    assert np.degrees(largest_cone_angle(angles.max())) == pytest.approx(wanted["lambda_max_domain"])
    found = map_to_cones(angles)
    mine = {(one.signs, one.turns): one.size for one in (*found.cones, *found.flat)}
    theirs = {(tuple(one["signs"]), one["k"]): np.radians(one["lambda_deg"]) for one in wanted["loop_sum"]}
    assert mine.keys() == theirs.keys()
    assert all(abs(mine[key] - theirs[key]) < tol for key in mine)
    closed = cone_angles(angles)
    chords = circumradii(2 * np.sin(angles / 2))
    for name in ("open", "crossed"):
        one, lam, radius = wanted["closed_form"][name], getattr(closed, name), getattr(chords, name)
        if one["valid"]:
            assert abs(lam - np.radians(one["lambda_deg"])) < tol
            assert radius == pytest.approx(one["R"], abs=1e-10)
            assert 2 * radius / (2 * np.sin(angles / 2)).max() == pytest.approx(one["two_R_over_longest"])
        else:
            assert np.isnan(lam)
            assert np.isnan(radius)  # a real number comes out of Eq. 12, of no quadrilateral (001-2)


def test_fig_10c_folds_flat_at_exactly_zero():
    """A double root at lambda = 0, where finders of sign changes report about 1e-6."""
    found = map_to_cones(np.radians(degrees_of(PAPER["fig10c_cones"])))
    (flat,) = found.flat
    assert (flat.size, flat.circuit, flat.double) == (0.0, "crossed", True)
    assert cone_angles(found.angles).crossed == pytest.approx(0.0, abs=1e-8)


def test_fig_10d_has_two_sums_that_vanish_identically():
    found = map_to_cones(np.radians(degrees_of(PAPER["fig10d_T"])))
    assert {one.signs for one in found.families} == {(1, 1, -1, -1), (1, -1, -1, 1)}
    for one in found.families:
        assert one.interval == (0.0, pytest.approx(np.radians(30)))
        for lam in np.linspace(0.01, 0.52, 7):
            steps = np.array(one.signs) * projected_angles(found.angles, lam)
            assert abs(steps.sum()) < 1e-14
    assert [one.circuit for one in found.cones] == ["open"]


def test_equation_5(golden):
    entry = golden["000"]["eq5"]
    lam, steps = np.radians(entry["inputs"]["lambda_phi0"]).T
    np.testing.assert_allclose(np.degrees(link_angles(steps, lam)), entry["computed"], atol=entry["tol"])


def test_domain_of_equation_7(golden):
    """000-10: projected angles are real up to lambda = 90 - phi / 2."""
    entry = golden["000"]["eq7_domain"]
    phi = np.radians(entry["inputs"]["phi_max"])
    end = largest_cone_angle(phi)
    np.testing.assert_allclose(np.degrees(end), entry["computed"], atol=1e-12)
    np.testing.assert_allclose(projected_angles(phi, end), np.pi, atol=1e-7)


def test_equation_17(golden):
    entry = golden["000"]["eq17"]
    lam = np.radians(entry["inputs"]["lambda_deg"])
    np.testing.assert_allclose(joint_axes([0.0], lam)[0], entry["computed"], atol=entry["tol"])


@pytest.mark.parametrize("name", [name for name in PAPER if name.startswith("table1_ex")])
def test_examples_of_table_1(name):
    entry = PAPER[name]
    steps = np.radians(entry["inputs"]["steps"])
    assert np.sign(steps).prod() == entry["computed"]["product_sign"]
    assert str(circuits(steps).names()) == entry["computed"]["circuit"]
    assert bool(table1(steps)) == (entry["computed"]["circuit"] == "open")


def test_table_1_is_printed_with_every_row_inverted(golden, rng):
    """000-1, against crossing sides."""
    entry = golden["000"]["table1"]
    assert entry["computed"]["rule"] == {
        key: {"open": "crossed", "crossed": "open"}[value] for key, value in entry["printed"].items()
    }
    places, steps, _, _ = random_linkages(rng, entry["inputs"]["samples"])
    truth = ~crosses(np.stack([np.sin(places), np.cos(places)], -1))
    found = circuits(steps)
    assert (found.open == truth).all()
    assert (table1(steps) == truth).all()
    assert np.abs(found.turns).max() == 1
    product = np.sign(steps).prod(axis=1) > 0
    for key, value in entry["computed"]["rule"].items():
        rows = (product == ("prod>0" in key)) & ((found.turns == 0) == key.endswith("sum=0"))
        assert rows.sum() > 100
        assert (truth[rows] == (value == "open")).all()


def test_table_2_and_equations_13_and_14(golden, rng):
    """000-3, 000-4: the sign is that of a b (a + b), the opposite of what is printed."""
    entry = golden["000"]["table2_eq13_14"]
    for (lam, a, b), theta, m in zip(
        entry["inputs"]["lam_a_b"], entry["computed"]["theta_deg"], entry["computed"]["m"], strict=True
    ):
        steps = np.radians([a, b, -a - b])
        found = np.degrees(dihedral_angles(steps, np.radians(lam))[1])
        assert found == pytest.approx(theta, abs=entry["tol"])
        assert np.sign(found) == m == np.sign(a * b * (a + b))
    _, steps, lam, angles = random_linkages(rng, 1000)
    theta = dihedral_angles(steps, lam)
    before = np.roll(angles, 1, axis=1)
    across = np.sin(lam[:, None]) ** 2 + np.cos(lam[:, None]) ** 2 * np.cos(steps + np.roll(steps, 1, axis=1))
    cosine = (across - np.cos(before) * np.cos(angles)) / (np.sin(before) * np.sin(angles))
    np.testing.assert_allclose(np.cos(theta), cosine, atol=1e-7)


@pytest.mark.parametrize("name", ["pos_open_sample", "pos_open_no_centre_sample"])
def test_positions(name):
    """Eqs. 15 to 24 put right."""
    entry = PAPER[name]
    steps = np.radians(list(entry["inputs"]["loop_convention_steps"].values()))
    lam, wanted = np.radians(entry["inputs"]["lambda_deg"]), entry["computed"]
    angles = dict(zip(("alpha", "eta", "beta", "gamma"), np.degrees(link_angles(steps, lam)), strict=True))
    assert angles == pytest.approx(wanted["link_angles"], abs=1e-9)
    turns = np.array(entry["inputs"]["dtheta"], dtype=float)
    found = configurations_from_conformed(steps, lam, np.radians(turns))
    conformed = np.degrees(found.conformed)
    np.testing.assert_allclose(conformed, [wanted[k] for k in ("theta0", "psi0", "xi0")], atol=entry["tol"])
    start = joint_axes(azimuths(steps), lam)
    np.testing.assert_allclose(start[0], wanted["O"], atol=1e-11)
    np.testing.assert_allclose(start[3], wanted["C"], atol=1e-11)
    rows = {row["dtheta"]: row for row in wanted["rows"]}
    for i, turn in enumerate(turns):
        if turn not in rows:
            assert np.isnan(found.psi[i])  # not reached
            continue
        row = rows[turn]
        assert np.degrees(found.psi[i]) - conformed[1] == pytest.approx(row["dpsi"], abs=entry["tol"])
        assert np.degrees(found.xi[i]) - conformed[2] == pytest.approx(row["dxi"], abs=entry["tol"])
        np.testing.assert_allclose(found.axes[i, 1:3], [row["A"], row["B"]], atol=entry["tol"])
        assert found.residual[i] < 1e-12


@pytest.mark.parametrize("number", [100, slow(400)])
def test_equations_21_and_23_agree_as_put_right_only(number, rng):
    """000-2, 000-4 on random linkages: with the printed gamma_0 and beta_0 they are a radius apart."""
    _, steps, lam, angles = random_linkages(rng, number)
    far = []
    for one, tilt, links in zip(steps, lam, angles, strict=True):
        found = configurations_from_conformed(one, tilt, np.radians([-2, -0.5, 0.5, 2]))
        good = np.isfinite(found.psi)
        assert (found.residual[good] < 1e-7).all()
        lengths = np.arccos(np.clip((found.axes * np.roll(found.axes, -1, axis=1)).sum(-1), -1, 1))
        np.testing.assert_allclose(lengths[good], np.broadcast_to(links, lengths[good].shape), atol=1e-6)
        o = joint_axes([0.0], tilt)[0]
        far.append(np.abs(rotated(o, [0, 1.0, 0], one[3]) - joint_axes(azimuths(one), tilt)[3]).max())
    sampled = PAPER["pos_monte_carlo"]["computed"]
    assert sampled["corrected"]["max"] < 1e-9
    as_printed = sampled["eq22_23_as_printed"]
    assert min(np.median(far), as_printed["median"]) > 0.5  # C = R_y(gamma_0) O, as printed
    assert max(far) <= 2.0
    assert as_printed["max"] <= 2.0  # axes are unit vectors


def test_counts_of_cones(golden, rng):
    """000-6, 001-6: with T4 < 0 a non-Grashof linkage has one cone, crossed; a Grashof linkage none."""
    angles = random_link_angles(rng, golden["000"]["cone_count_claim"]["inputs"]["samples"])
    t = spherical_differences(angles)
    grashof, positive = t.prod(axis=1) > 0, t[:, 3] > 0
    found = cone_angles(angles)
    number = np.isfinite(found.open).astype(int) + 2 * np.isfinite(found.crossed)
    assert (number[positive & grashof] == 3).all()
    assert (number[positive & ~grashof] == 1).all()
    assert (number[~positive & grashof] == 0).all()
    assert (number[~positive & ~grashof] == 2).all()
    assert min(np.bincount(2 * positive + grashof)) > 1000


def test_a_crossed_cone_with_t4_below_zero(golden):
    entry = golden["000"]["counterexample_T4neg_crossed"]
    wanted = entry["computed"]
    lam = np.radians(entry["inputs"]["lambda_deg"])
    angles = link_angles(np.radians(entry["inputs"]["steps"]), lam)
    np.testing.assert_allclose(np.degrees(angles), wanted["link_angles"], atol=entry["tol"])
    # their T1 to T3 name the sides in loop order from alpha; ours from the ground link, gamma
    t = np.degrees(spherical_differences(np.roll(angles, 1)))
    np.testing.assert_allclose(sorted(np.abs(t)), sorted(abs(wanted[f"T{i}"]) for i in (1, 2, 3, 4)), atol=entry["tol"])
    assert t[3] == pytest.approx(wanted["T4"])
    assert t.prod() == pytest.approx(wanted["product"], rel=1e-9)
    found = map_to_cones(angles)
    (one,) = found.cones
    (root,) = wanted["loop_sum_roots"]
    assert (list(one.signs), one.turns) == (root["signs"], root["k"])
    assert np.degrees(one.size) == pytest.approx(root["lambda_deg"], abs=entry["tol"])
    assert np.cos(one.size) == pytest.approx(wanted["R_crossed"])
    assert found.solutions == "crossed only"
    kinds = [kind_of_spherical(np.roll(angles, i)) for i in range(4)]
    assert not any("crank" in (kind.input, kind.output) for kind in kinds)


def test_fifteen_other_linkages_are_seven():
    """000-7: 16 choices of ends, 8 different linkages; T4 runs through plus and minus T1 to T4."""
    angles = np.radians([85, 120, 95, 45])
    every = supplementary(angles)
    assert every.shape == (16, 4)
    assert len(np.unique(every.round(9), axis=0)) == 8
    t = spherical_differences(angles)
    np.testing.assert_allclose(spherical_differences(every).prod(axis=1), t.prod(), rtol=1e-9)
    np.testing.assert_allclose(np.unique(spherical_differences(every)[:, 3].round(9)),
                               np.unique(np.concatenate([t, -t]).round(9)), atol=1e-8)  # fmt: skip


def test_fig_11(golden):
    """000-8: azimuths, link angles of all pairs of axes, the step that closes; every membership of the loops."""
    entry = golden["000"]["fig11_stephenson2"]
    wanted = entry["computed"]
    linkage = read_linkage(DATA / "surfaces" / "fig11-stephenson.json")
    places = dict(zip(linkage.chain.joints, linkage.places(), strict=True))
    assert np.degrees(linkage.surface.angle) == pytest.approx(entry["inputs"]["lambda_deg"])
    assert {j: float(np.degrees(t)) for j, t in places.items()} == pytest.approx(wanted["azimuths"])
    for pair, one in wanted["all_pairs"].items():
        step = places[pair[1]] - places[pair[0]]
        assert np.degrees(step) == pytest.approx(one["projected"])
        found = np.degrees(link_angles(step, linkage.surface.angle))
        assert found == pytest.approx(one["link_angle"], abs=entry["tol"])
    assert np.degrees(places["O"] - places["F"]) == pytest.approx(wanted["closing_FO_projected"])
    printed = entry["printed"]["projected"]
    choices = [np.dot(signs, printed) % 360 == 0 for signs in product((1, -1), repeat=6)]
    assert sum(choices) == wanted["n_sign_choices_summing_to_360k_for_all_six"]
    listed = json.loads((DATA / "surfaces" / "fig11-memberships.json").read_text())["memberships"]
    chains = memberships(linkage.chain, "OABCDEF")
    assert len(listed) == len(chains) == 15
    assert {frozenset(map(frozenset, loops)) for loops in listed} == {
        frozenset(frozenset(loop.joints) for loop in chain.loops) for chain in chains
    }
    for chain in chains:
        pairs = {frozenset(pair) for pair in link_pairs(chain)}
        assert all(frozenset(run) in pairs for run in entry["inputs"]["projected"])
        loops = loop_steps(chain, [places[joint] for joint in chain.joints])
        assert all(abs(loop.circuits.residual) < 1e-12 and abs(loop.circuits.turns) <= 1 for loop in loops)


@pytest.mark.parametrize("every", [5, slow(1)])
def test_fig_11_is_a_stephenson_candidate(every, golden):
    """The seven axes in their cyclic order are among the 102, whatever the loops; the link angles agree."""
    wanted = golden["000"]["fig11_stephenson2"]["computed"]
    linkage = read_linkage(DATA / "surfaces" / "fig11-stephenson.json")
    lam, places = linkage.surface.angle, np.radians(list(wanted["azimuths"].values()))
    assert list(wanted["azimuths"]) == list("OABCDEF")
    order = np.remainder(places, 2 * np.pi).argsort().argsort()
    for chain in memberships(linkage.chain, "OABCDEF")[::every]:
        column = ["OABCDEF".index(joint) for joint in chain.joints]
        job = CandidateJob(chain, surface=None)
        symmetries = job.query.symmetries(None)
        assert len(symmetries) == 4
        listed = [row["slots"] for row in job.rows()]
        assert len(listed) == 102
        assert listed.count(list(canonical_row(order[column], symmetries, 7))) == 1
        # on whole degrees the printed axes are a candidate on 360 slots: every link angle is the golden one
        slots = np.rint(np.degrees(places[column])).astype(int) % 360
        placed = CandidateJob(chain, slots=360, surface=Cone(lam))
        [row] = placed.work(Portion(None, canonical_row(slots, symmetries, 360)))
        told = dict(zip(placed.columns, row, strict=True))
        found = sorted(angle for _, _, angle in told["link_angles_deg"])
        pairs = wanted["all_pairs"]
        golden_angles = [
            pairs[a + b]["link_angle"] if a + b in pairs else pairs[b + a]["link_angle"] for a, b in link_pairs(chain)
        ]
        np.testing.assert_allclose(found, sorted(golden_angles), atol=1e-6)
        assert told["rank"] == 6
        assert told["half_turn_steps"] == 0


def test_memberships_of_fig_11_by_brute_force():
    """All 5040 namings of the seven joints, up to the chain's four symmetries."""
    from itertools import permutations

    ends = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (4, 5), (5, 2)]
    fits = sum(
        all(set(ends[a]) & set(ends[b]) for a, b in zip(run, run[1:], strict=False)) for run in permutations(range(7))
    )
    assert fits == 15 * 4


def test_projection_of_the_pole_axis(golden, rng):
    """Fig. 9: it passes through the circle's centre and the planar instant centre; outward is along y."""
    assert golden["000"]["icrl_projection"]["computed"]["sign_violations"] == 0
    places, _, lam, _ = random_linkages(rng, 5000)
    o, a, b, c = np.moveaxis(joint_axes(places, lam), -2, 0)
    pole = np.cross(np.cross(o, a), np.cross(c, b))
    motion = first_order(ConformedChain.of(FOUR_BAR), places)
    omega = pole_axes(motion.motions, lam)[:, 2]
    unit = [v / np.linalg.norm(v, axis=1, keepdims=True) for v in (pole, omega)]
    assert np.abs(np.cross(*unit)).max() < 1e-6
    # the planar instant centre: where the lines O A and C B of the circle meet
    p = np.stack([np.sin(places), np.cos(places)], -1)
    q = [np.concatenate([p[:, i], np.ones((5000, 1))], 1) for i in range(4)]
    centre = np.cross(np.cross(q[0], q[1]), np.cross(q[3], q[2]))[:, :2]
    along = pole[:, ::2]
    sine = (centre[:, 0] * along[:, 1] - centre[:, 1] * along[:, 0]) / (
        np.linalg.norm(centre, axis=1) * np.linalg.norm(along, axis=1)
    )
    assert np.abs(sine).max() < 1e-6
    # radially outward of the cone and along y: the same sign
    velocity = np.cross(omega, a)
    normal = np.stack([np.sin(lam) * np.sin(places[:, 1]), np.cos(lam), np.sin(lam) * np.cos(places[:, 1])], -1)
    assert (np.sign((velocity * normal).sum(-1)) == np.sign(velocity[:, 1])).all()


def test_loop_sums_find_what_is_printed_only():
    """Fig. 10: no other sign pattern closes."""
    for case, count in zip("abc", (2, 1, 2), strict=True):
        angles = np.radians(degrees_of(PAPER[f"fig10{case}_cones"]))
        assert len(loop_roots(np.tan(angles / 2) ** -2, 1).size) == count
