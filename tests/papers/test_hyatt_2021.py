"""Hyatt et al. 2021 (mapping methods, cylinders): every number of the paper, and its misprints put right."""

from itertools import permutations
from pathlib import Path

import numpy as np
import pytest
from by_coordinates import cone_angles_by_coordinates, quadrilaterals_by_coordinates
from conical import FOUR_BAR, crosses, random_lengths, random_link_angles, random_linkages
from golden_numbers import golden_numbers
from paper_formulas import central_angles, projected_angles
from second_methods import shadow_allows

from enumerate.conical.rounds import Rounds, count_rounds_by_burnside, placements
from graphs.count.report import mobility_report
from graphs.edit.analogues import planar_analogue
from graphs.files.formats import read
from synth.linkages.conformed.behaviours import COLUMNS, ROWS, behaviour, table4, table_row
from synth.linkages.conformed.rates import ConformedChain
from synth.linkages.fourbar.closing import grashof_class, kind_of_spherical, planar_differences, spherical_differences
from synth.linkages.fourbar.position import output_planar
from synth.linkages.surfaces.circuit import link_angles
from synth.linkages.surfaces.loop_maps import chords, cone_reach, largest_cone_angle, map_to_cones, map_to_cylinders
from synth.linkages.surfaces.loop_sums import circumradii, cone_angles, crossed_area, loop_roots
from synth.synthesis.candidates.job import CandidateJob

DATA = Path(__file__).resolve().parents[2] / "data"
PAPER = golden_numbers()["001"]


def printed_crossed(a, b, c, d):
    """Eq. 5 as printed, and with its third factor put right: R^2."""
    denominator = (b + c - d - a) * (a + c - d - b) * (a + b - d - c) * (a + b + c + d)
    same = (a * b - c * d) * (a * c - b * d)
    return same * (a * d - b * c) / denominator, same * (b * c - a * d) / denominator


def random_quadrilaterals(rng, count):
    """Points on the unit circle in loop order, sides, and which are crossed."""
    places = rng.uniform(-np.pi, np.pi, (count, 4))
    points = np.stack([np.sin(places), np.cos(places)], -1)
    sides = np.linalg.norm(np.roll(points, -1, axis=1) - points, axis=-1)
    return points, sides, crosses(points)


def test_four_bars_on_cylinders_are_planar_four_bars(golden):
    """Parallel axes: the planar analogue of the four-bar on a cone."""
    assert "table1_eq1_3" in golden["001"]
    planar = read(DATA / "hyatt" / "planar-four-bar.json")
    report = mobility_report(planar)
    assert (report.mechanism_class, report.mobility, report.centres) == ("planar", 1, 1)
    cone = planar_analogue(read(DATA / "hyatt" / "spherical-four-bar.json"))
    assert mobility_report(cone).to_json() == report.to_json()


def test_table_1_and_equations_1_to_3(rng):
    """T1 T2 T3 >= 0 exactly if shortest and longest are no longer than the other two; the order does not matter."""
    entry = PAPER["table1_eq1_3"]
    sides = np.array(list(entry["inputs"].values()), dtype=float)
    t = planar_differences(sides)
    assert t.tolist() == [entry["computed"][f"T{i}"] for i in (1, 2, 3)]
    assert t.prod() == entry["computed"]["product"]
    assert str(grashof_class(t, sides.sum())) == entry["computed"]["cls"]
    lengths = random_lengths(rng, 50_000)
    ordered = np.sort(lengths, axis=1)
    grashof = ordered[:, 0] + ordered[:, 3] <= ordered[:, 1] + ordered[:, 2]
    assert ((planar_differences(lengths).prod(axis=1) >= 0) == grashof).all()


def test_equations_4_and_12_give_the_circle(rng):
    """mu = 1 on convex quadrilaterals, mu = -1 on crossed ones, all drawn on the unit circle."""
    for name in ("eq4", "eq12_mu_minus"):
        assert PAPER[name]["status"] == "agree"
    _, sides, crossed = random_quadrilaterals(rng, 20_000)
    found = circumradii(sides)
    assert np.abs(found.open[~crossed] - 1).max() < 1e-9
    assert np.abs(found.crossed[crossed] - 1).max() < 1e-6
    assert np.median(np.abs(found.crossed[crossed] - 1)) < 1e-15 * 4


def test_equation_5_is_printed_with_the_wrong_sign(rng):
    """001-1: as printed, R^2 is negative for every crossed quadrilateral."""
    entry = PAPER["eq5"]
    as_printed, right = printed_crossed(*entry["inputs"].values())
    assert as_printed == pytest.approx(entry["computed"]["radicand_as_printed"])
    assert right == pytest.approx(entry["computed"]["radicand_correct"])
    found = circumradii(list(entry["inputs"].values()))
    assert found.crossed == pytest.approx(entry["computed"]["R"], abs=entry["tol"])
    _, sides, crossed = random_quadrilaterals(rng, 5000)
    assert (printed_crossed(*sides[crossed].T)[0] < 0).all()


def test_equation_11(rng):
    """The area is that of the two triangles, one of them negative."""
    assert PAPER["eq11"]["status"] == "agree"
    points, sides, crossed = random_quadrilaterals(rng, 5000)
    x, y = points[..., 0], points[..., 1]
    area = (x * np.roll(y, -1, axis=1) - np.roll(x, -1, axis=1) * y).sum(axis=1) / 2
    assert np.abs(crossed_area(sides[crossed]) - np.abs(area[crossed])).max() < 1e-6


def test_the_order_of_the_links_does_not_matter():
    sides = PAPER["eq12_permutation"]["inputs"]["sides"]
    every = circumradii(list(permutations(sides)))
    assert np.ptp(every.open) < 1e-12
    assert np.ptp(every.crossed) < 1e-12


def test_equation_12_gives_circles_of_no_quadrilateral():
    """001-2: numerator and denominator both negative."""
    for sides in ([9, 5, 4, 3], (2 * np.sin(np.radians([155, 50, 65, 80]) / 2)).tolist()):
        _, squared = printed_crossed(*sorted(sides, reverse=True))
        assert squared > 0
        assert 2 * np.sqrt(squared) < max(sides)
        assert np.isnan(circumradii(sides).crossed)


def test_table_2():
    entry = PAPER["table2"]
    wanted = entry["computed"]
    angles = np.radians(entry["inputs"]["angles"])
    legs = chords(angles, 1.0)
    np.testing.assert_allclose(legs, wanted["legs"], atol=entry["tol"])
    np.testing.assert_allclose(legs, entry["printed"]["legs"], atol=entry["tol_printed"])
    found = circumradii(legs)
    assert found.open == pytest.approx(wanted["R_open"], abs=entry["tol"])
    assert found.crossed == pytest.approx(wanted["R_crossed"], abs=entry["tol"])
    assert found.open == pytest.approx(entry["printed"]["R_open"], abs=entry["tol_printed"])
    assert found.crossed == pytest.approx(entry["printed"]["R_crossed"], abs=entry["tol_printed"])
    assert np.isnan(cone_angles(angles).crossed)  # R > 1: no cone
    kind = kind_of_spherical(angles)
    np.testing.assert_allclose(np.degrees(kind.differences), wanted["T"], atol=1e-9)
    assert np.prod(np.degrees(kind.differences)) == pytest.approx(wanted["product"])
    assert kind.grashof == entry["printed"]["spherical"].replace("Non", "non")
    ordered = np.sort(legs)
    assert ordered[0] + ordered[3] == pytest.approx(wanted["planar_s_plus_l"])
    assert ordered[1] + ordered[2] == pytest.approx(wanted["planar_p_plus_q"])
    assert str(grashof_class(planar_differences(legs), 1)) == entry["printed"]["planar"]


def test_fig_3():
    entry = PAPER["fig3"]
    (one,) = map_to_cones(np.radians(entry["inputs"]["angles"])).cones
    (root,) = entry["computed"]["loop_sum"]
    assert (list(one.signs), one.turns, one.circuit) == (root["signs"], root["k"], "open")
    assert np.degrees(one.size) == pytest.approx(entry["computed"]["lambda_deg"], abs=entry["tol"])
    assert np.degrees(one.size) == pytest.approx(entry["printed"], abs=entry["tol_printed"])


def test_equation_9_is_that_of_2020():
    """001-4: phi stands inside, not alpha."""
    assert PAPER["eq9"]["computed"] == "cos(phi)"
    phi, lam = np.radians(70), np.radians(25)
    wanted = np.arccos((np.cos(phi) - np.sin(lam) ** 2) / np.cos(lam) ** 2)
    assert projected_angles(phi, lam) == pytest.approx(wanted)


def test_fig_10():
    entry = PAPER["fig10"]
    found = map_to_cylinders(entry["inputs"]["links"])
    mine = {(one.signs, one.turns): one.size for one in found.cylinders}
    theirs = {(tuple(one["signs"]), one["k"]): one["R"] for one in entry["computed"]["loop_sum"]}
    assert mine == pytest.approx(theirs, abs=entry["tol"])
    np.testing.assert_allclose(sorted(mine.values()), entry["printed"], atol=entry["tol_printed"])
    radii = {one.circuit: one.size for one in found.cylinders}
    assert radii["open"] == pytest.approx(entry["computed"]["R_open"], abs=entry["tol"])
    assert radii["crossed"] == pytest.approx(entry["computed"]["R_crossed"], abs=entry["tol"])


def test_equation_20_has_every_link_once():
    """001-5: psi_g, psi_a, psi_h, psi_b; with psi_a twice the roots of Fig. 10 do not close."""
    assert "first psi_a should be psi_g" in PAPER["eq20"]["note"]
    for one in map_to_cylinders([4, 3, 5, 1]).cylinders:
        psi = central_angles([4, 3, 5, 1], one.size)
        assert np.dot(one.signs, psi) == pytest.approx(2 * np.pi * one.turns, abs=1e-12)
        psi[0] = psi[1]
        assert abs(np.dot(one.signs, psi) - 2 * np.pi * one.turns) > 0.1


def test_an_open_quadrilateral_without_the_centre():
    """001-7: it closes as (+, -, -, -), k = 0."""
    angles = link_angles(np.radians([120, -30, -40, -50]), 0.4)
    signs = {one.signs: one for one in map_to_cones(angles).cones}
    assert (signs[1, -1, -1, -1].circuit, signs[1, -1, -1, -1].turns) == ("open", 0)


def test_equations_6_to_8():
    """001-3: the system is right, the list of unknowns ends with y3."""
    entry = PAPER["eq6_8_fig10"]
    sides = list(entry["inputs"].values())
    found = quadrilaterals_by_coordinates(sides)
    assert found.residual.max() < 1e-13
    mine = []
    for unknowns, centre, radius in zip(found.unknowns, found.centre, found.radius, strict=True):
        mirrored = unknowns * [1, -1, 1, -1, 1, -1]
        mine += [[*unknowns, centre, radius], [*mirrored, -centre, radius]]
    keys = ("x1", "y1", "x2", "y2", "x3", "y3", "K", "R_normalised")
    theirs = [[one[key] for key in keys] for one in entry["computed"]["solutions"]]
    assert len(theirs) == entry["computed"]["n_solutions"]
    np.testing.assert_allclose(sorted(mine), sorted(theirs), atol=entry["tol"])
    np.testing.assert_allclose(
        sorted(sides[0] * found.radius), sorted({one["R"] for one in entry["computed"]["solutions"]}), atol=1e-8
    )


def test_equations_17_and_18():
    entry = PAPER["eq17_18"]
    angles = np.radians(list(entry["inputs"].values()))
    found = quadrilaterals_by_coordinates(chords(angles, 1.0))
    wanted = {(abs(one["K"]), one["R"]) for one in entry["computed"]["solutions"]}
    np.testing.assert_allclose(sorted(zip(found.centre, found.radius, strict=True)), sorted(wanted), atol=entry["tol"])
    assert 1 / (2 * np.sin(angles[0] / 2)) == pytest.approx(entry["computed"]["solutions"][0]["d"])
    lam = np.degrees(cone_angles_by_coordinates(angles))
    assert lam[0] == pytest.approx(entry["computed"]["solutions"][0]["lambda_deg"], abs=entry["tol"])
    assert lam[0] == pytest.approx(entry["printed"], abs=entry["tol_printed"])
    assert np.isnan(lam[1])


def test_equations_15_and_16():
    entry = PAPER["eq15_16"]
    lam = largest_cone_angle(np.radians(entry["inputs"]["phi_max"]))
    assert np.degrees(lam) == pytest.approx(entry["computed"]["lambda_max"])
    assert np.cos(lam) == pytest.approx(entry["computed"]["R_min"])


def test_folding_spherical_linkages_have_radius_one(rng):
    """Section 3.2.3: crossed on the flat cone."""
    entry = PAPER["folding_R1"]
    legs = chords(np.radians(entry["inputs"]["angles"]), 1.0)
    assert circumradii(legs).crossed == pytest.approx(entry["computed"]["R_crossed"], abs=entry["tol"])
    assert PAPER["folding_R1_mc"]["status"] == "agree"
    a, b, c = rng.uniform(0.3, 1.2, (3, PAPER["folding_R1_mc"]["inputs"]["samples"]))
    angles = np.stack([a, b, c, a + b - c], -1)[(a + b - c > 0.1)]
    angles = angles[np.abs(angles[:, :2] - angles[:, 2:3]).min(axis=1) > 0.01]
    assert np.abs(circumradii(chords(angles, 1.0)).crossed - 1).max() < 1e-9
    roots = loop_roots(cone_reach(angles), 1)
    flat = roots.loop[roots.size == 0]
    assert (np.unique(flat) == np.arange(len(angles))).all()


def test_two_pairs_of_equal_lengths():
    """Section 3.1.3: crossed parallelogram and stacked kite, for every radius from half the longest link on."""
    entry = PAPER["parallelogram_range"]
    long, short = entry["inputs"]["l"], entry["inputs"]["s"]
    for sides in ([long, short, long, short], [long, long, short, short]):
        found = map_to_cylinders(sides)
        assert {one.interval for one in found.families} == {(entry["computed"]["R_min"], np.inf)}
        assert len(found.families) == 2
        for one in found.families:
            for radius in np.geomspace(2.5, 60, 20):
                steps = np.array(one.signs) * central_angles(sides, radius)
                places = np.cumsum(steps)
                points = radius * np.stack([np.sin(places), np.cos(places)], -1)
                assert np.abs(np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1) - sides).max() < 1e-12
        assert np.isnan(circumradii(sides).crossed)


def test_table_4(rng):
    """By the table, by velocities, by the shadow: all twelve rows."""
    for entry in PAPER["table4"]["computed"]:
        row = ROWS[entry["case"], {"crossed1": "crossed 1", "crossed2": "crossed 2"}.get(
            entry["configuration"], entry["configuration"]), entry["column"]]  # fmt: skip
        assert row == (entry["intramobility"], entry["extramobility"])
        assert row[0].startswith("Y") == entry["generic_capable"]
    places, _, _, _ = random_linkages(rng, 3000)
    found = behaviour(ConformedChain.of(FOUR_BAR), places)
    rows = [table_row(one) for one in places]
    assert {(row.case, row.configuration, row.column) for row in rows} == ROWS.keys()
    assert [row.intramobile for row in rows] == found.one_way.tolist()
    assert [row.extramobile for row in rows] == found.one_way.tolist()
    assert (shadow_allows(places) == found.one_way).all()


LABELS = {"openA": ("open", "A"), "openB": ("open", "B"), "crossed1A": ("crossed 1", "A"),
          "crossed1B": ("crossed 1", "B"), "crossed2A": ("crossed 2", "A"), "crossed2B": ("crossed 2", "B")}  # fmt: skip


def loop_of(places, configuration, column):
    """Azimuths of O, A, B, C for labelled points P1 to P4."""
    ground, coupler = sorted(map(sorted, COLUMNS[configuration, column]))
    c, o = ground
    sides = {"open": {12, 23, 34, 14}, "crossed 1": {12, 24, 34, 13}, "crossed 2": {13, 23, 24, 14}}[configuration]
    a, b = coupler if 10 * min(o, coupler[0]) + max(o, coupler[0]) in sides else coupler[::-1]
    return np.array([places[i - 1] for i in (o, a, b, c)])


def finite_ways(places, turn):
    """Whether all arcs of the links are inside, or outside, the circle after a true displacement of the linkage."""
    points = np.stack([np.sin(places), np.cos(places)], -1)
    o, a, b, c = points
    lengths = [np.linalg.norm(x - y) for x, y in ((c, o), (o, a), (a, b), (b, c))]
    frame = np.arctan2(*(c - o)[::-1])

    def heading(v):
        return np.arctan2(v[1], v[0]) - frame

    theta, psi = heading(a - o), heading(b - c)
    branch = min((1, -1), key=lambda s: abs(np.remainder(output_planar(lengths, theta, s) - psi + np.pi, 2 * np.pi) - np.pi))  # fmt: skip
    psi_new = output_planar(lengths, theta + turn, branch)
    a2 = o + lengths[1] * np.array([np.cos(theta + turn + frame), np.sin(theta + turn + frame)])
    b2 = c + lengths[3] * np.array([np.cos(psi_new + frame), np.sin(psi_new + frame)])
    inside = outside = True
    for (p, q), (p2, q2) in (((o, a), (o, a2)), ((a, b), (a2, b2)), ((b, c), (b2, c))):
        start, end = np.arctan2(*p), np.arctan2(*q)
        step = np.remainder(end - start + np.pi, 2 * np.pi) - np.pi
        ways = []
        for arc in [step] if abs(abs(step) - np.pi) > 1e-9 else [np.pi, -np.pi]:
            t = start + arc * np.linspace(0, 1, 101)
            rotation = np.arctan2(*(q2 - p2)[::-1]) - np.arctan2(*(q - p)[::-1])
            rel = np.stack([np.sin(t), np.cos(t)], -1) - p
            cs, sn = np.cos(rotation), np.sin(rotation)
            moved = p2 + np.stack([cs * rel[:, 0] - sn * rel[:, 1], sn * rel[:, 0] + cs * rel[:, 1]], -1)
            off = np.linalg.norm(moved, axis=1) - 1
            ways.append(((off < 1e-12).all(), (off > -1e-12).all()))
        inside &= any(one[0] for one in ways)
        outside &= any(one[1] for one in ways)
    return inside, outside


@pytest.mark.parametrize("name", PAPER["table4_finite_motion"]["computed"])
def test_table_4_by_true_displacements(name):
    """Section 5.2 with its special conditions: a chord that is a diameter."""
    entry = PAPER["table4_finite_motion"]
    one, turn = entry["computed"][name], entry["inputs"]["input_rotation_rad"]
    for label, wanted in one["result"].items():
        configuration, column = LABELS[label]
        places = loop_of(np.radians(one["azimuths"]), configuration, column)
        moved = [finite_ways(places, way * turn) for way in (1, -1)]
        found = {"intramobility": any(x for x, _ in moved), "extramobility": any(y for _, y in moved)}
        assert found == wanted, label
        row = table_row(places)
        assert {"intramobility": row.intramobile, "extramobility": row.extramobile} == wanted, label
        assert (row.intramobile, row.extramobile) == table4(
            row.case, row.configuration, row.column, diameter="diameter" in name
        )


def test_the_twelve_cases_come_out_of_the_enumeration_of_candidates():
    """Tables 3 and 4: the orders with opposites of a four-bar with a ground link are the cases, and no others.

    Up to an exchange of ground and coupler, which the tables do not tell apart, there are twelve.
    """
    job = CandidateJob(FOUR_BAR, (0,), opposites=True)
    rows = job.rows()
    found = {}
    for row in rows:
        one = table_row(job.places(row))  # O, A, B, C; the ground link is C O
        assert (row["linkage"] == "one way") == one.intramobile == one.extramobile
        assert row["linkage"] in ("one way", "both ways")
        assert (row["circuits"] == ["open"]) == (one.configuration == "open")
        found.setdefault((one.case, one.configuration, one.column), []).append(row["linkage"])
    assert found.keys() == ROWS.keys()
    assert len(rows) == 16
    for case, told in found.items():
        assert set(told) == {"one way" if ROWS[case][0].startswith("Y") else "both ways"}
    pair = np.array([[0, 1, 2, 3], [3, 2, 1, 0], [1, 0, 3, 2], [2, 3, 0, 1]])  # symmetries that keep {CO, AB}
    assert count_rounds_by_burnside(Rounds(4, 2 * 4, 4), pair) == len(placements(Rounds(4, 2 * 4, 4), pair)[0]) == 12
    # the same by angles: all four-bars on 11 slots, none of which lies opposite to another
    placed = CandidateJob(FOUR_BAR, (0,), slots=11)
    seen = set()
    for row in placed.rows():
        one = table_row(placed.places(row))
        assert (row["linkage"] == "one way") == one.intramobile
        seen.add((one.case, one.configuration, one.column))
    assert seen == ROWS.keys()


def test_crossed_on_a_cylinder_is_grashof(golden, rng):
    """Sections 3.1.2 and 6: holds in the plane. On cones it fails where T4 < 0 (000-6)."""
    assert golden["001"]["grashof_claim_planar"]["computed"]["counterexamples"] == 0
    _, sides, crossed = random_quadrilaterals(rng, 20_000)
    assert (planar_differences(sides[crossed]).prod(axis=1) > 0).all()
    angles = random_link_angles(rng, 20_000)
    t = spherical_differences(angles)
    some = np.isfinite(cone_angles(angles).crossed)
    assert (t[some & (t[:, 3] > 0)].prod(axis=1) > 0).all()
    assert (t[some & (t[:, 3] < 0)].prod(axis=1) < 0).all()


def test_equations_13_and_14():
    entry = PAPER["eq13_14"]
    np.testing.assert_allclose(chords(np.radians(entry["inputs"]["alpha"]), 1.0), entry["computed"]["r"], atol=1e-9)
