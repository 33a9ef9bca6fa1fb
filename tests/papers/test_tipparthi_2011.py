"""Tipparthi and Larochelle 2011 (hoop method): the type of its linkage, both case studies, all dyads."""

from pathlib import Path

import numpy as np
import pytest
from second_methods import hoop_sequence

from graphs.count.report import mobility_report
from graphs.files.formats import read
from graphs.reduce.ride_alongs import reduce
from synth.linkages.guidance.order import analyse_order, hoop, pair_name
from synth.linkages.guidance.orientations import read_orientations
from synth.linkages.guidance.synthesis import dyads_of_five

DATA = Path(__file__).resolve().parents[2] / "data" / "tipparthi"


def test_two_rr_dyads_make_a_spherical_four_bar(golden):
    """Each dyad has one freedom beside the coupler's three; taken off as a dyad it leaves the mobility."""
    assert "hoop_case1" in golden["002"]
    sc = read(DATA / "spherical-4r.json")
    report = mobility_report(sc)
    assert (report.mechanism_class, report.mobility, sc.ground) == ("spherical", 1, 0)
    assert not reduce(sc).steps
    assert not reduce(sc, keep=[2]).steps


# Order of orientations. Quaternions as printed give the printed hoop angles; with the sign of 002-1 mended the printed
# fixed axes are those of dyads.

PRINTED = read_orientations(DATA.parent / "orientations" / "tipparthi-as-printed.json")
CORRECTED = read_orientations(DATA.parent / "orientations" / "tipparthi.json")
CASES = ("hoop_case1", "hoop_case2")


def names(pairs):
    return [pair_name(pair) for pair in pairs]


def test_the_orientations_are_those_of_table_1(golden):
    """Digits as printed are not quite of norm one; 002-1 is one sign."""
    listed = np.array(golden["002"]["table1"]["inputs"]["M"])
    norms = golden["002"]["table1"]["computed"]["norms"]
    assert np.linalg.norm(listed, axis=1) == pytest.approx(norms, abs=1e-9)
    assert PRINTED.quaternions == pytest.approx(listed / np.array(norms)[:, None], abs=1e-9)
    mended = listed.copy()
    mended[2, 1] *= -1
    assert CORRECTED.quaternions == pytest.approx(mended / np.array(norms)[:, None], abs=1e-9)


@pytest.mark.parametrize(("entry", "given"), [("printed", PRINTED), ("corrected", CORRECTED)])
def test_relative_axes(entry, given, golden):
    due = golden["002"][f"relative_axes_{entry}"]["computed"]
    for pair, axis in given.relative_axes().items():
        assert np.abs(axis @ due[pair_name(pair)]) == pytest.approx(1.0, abs=1e-10)
        assert np.linalg.norm(np.cross(axis, due[pair_name(pair)])) < 1e-10


@pytest.mark.parametrize("case", CASES)
def test_every_printed_hoop_angle_to_its_digits(case, golden):
    entry = golden["002"][case]
    turned = hoop(PRINTED, entry["inputs"]["G"], entry["inputs"]["direction"])
    found = {pair_name(c.pair): float(np.degrees(c.angle)) for c in turned.crossings}
    assert {name: round(angle, 1) for name, angle in found.items()} == entry["printed"]
    assert found == pytest.approx(entry["computed"], abs=entry["tol"])


@pytest.mark.parametrize("case", CASES)
def test_sequences_and_verdicts(case, golden):
    inputs, entry = golden["002"][case]["inputs"], golden["002"][f"{case}_sequence"]
    found = analyse_order(PRINTED, inputs["G"], inputs["direction"])
    assert names(found.hoop.sequence) == entry["computed"]["full_sequence"]
    assert hoop_sequence(PRINTED, inputs["G"], inputs["direction"]) == found.hoop.sequence
    met = [pair for pair in found.hoop.sequence if pair in found.hoop.required]
    assert names(met) == entry["computed"]["required_subsequence"]
    assert (not found.in_order) is entry["printed"]["order_defect"]
    assert found.agree


def test_case_1_with_the_sign_mended(golden):
    """002-2: angles with index 3 move, the verdict does not."""
    entry = golden["002"]["hoop_case1_corrected_M3"]
    found = analyse_order(CORRECTED, entry["inputs"]["G"], entry["inputs"]["direction"])
    angles = {pair_name(c.pair): float(np.degrees(c.angle)) for c in found.hoop.crossings}
    assert angles == pytest.approx(entry["computed"]["angles"], abs=entry["tol"])
    assert names(found.hoop.sequence) == entry["computed"]["full_sequence"]
    assert (not found.in_order) is entry["computed"]["order_defect"]
    assert {name for name in angles if abs(angles[name] - entry["printed"][name]) > 0.05} == {
        "S13",
        "S23",
        "S34",
        "S35",
    }


def test_case_2_with_the_sign_mended(golden):
    """docs/misprints.md, 002-2."""
    inputs = golden["002"]["hoop_case2"]["inputs"]
    found = analyse_order(CORRECTED, inputs["G"], inputs["direction"])
    angles = {pair_name(c.pair): round(float(np.degrees(c.angle)), 3) for c in found.hoop.crossings}
    due = {"S13": 16.824, "S23": 82.336, "S34": 151.224, "S35": 179.339}
    assert {name: angles[name] for name in due} == due
    assert found.in_order
    assert found.agree
    assert np.degrees(found.misfit) < 1e-3


def test_six_real_dyads_from_the_five_orientations(golden):
    """Synthesis from the orientations alone finds all six dyads; both printed fixed axes are among them."""
    entry = golden["002"]["burmester_corrected"]
    found = dyads_of_five(CORRECTED)
    assert (len(found.dyads), found.complex_solutions) == (entry["computed"]["n_real"], 0)
    assert found.residual < 1e-14
    left = list(found.dyads)
    for due in entry["computed"]["solutions"]:
        dyad = min(left, key=lambda one: np.linalg.norm(np.cross(one.fixed, due["G"])))
        left.remove(dyad)
        sign = np.sign(dyad.fixed @ due["G"])
        assert sign * dyad.fixed == pytest.approx(due["G"], abs=entry["tol"])
        assert np.linalg.norm(np.cross(dyad.moving, due["W"])) < entry["tol"]
        link = np.degrees(dyad.link_angle)
        assert min(abs(link - due["link_angle"]), abs(180 - link - due["link_angle"])) < 1e-6
        turned = np.mod(sign * np.degrees(dyad.crank_angles), 360.0)
        assert turned == pytest.approx(due["crank_angles_from_1"], abs=1e-5)
        ways = {"none": None, "cw": "cw" if sign > 0 else "ccw", "ccw": "ccw" if sign > 0 else "cw"}
        assert dyad.direction == ways[due["in_order_direction"]]
    assert [dyad.in_order for dyad in found.dyads].count(True) == 1
    for name, printed in entry["printed"].items():
        off = min(np.degrees(np.linalg.norm(np.cross(dyad.fixed, printed))) for dyad in found.dyads)
        assert off == pytest.approx(entry["computed"]["distance_of_printed_G_deg"][name], abs=1e-6)


def test_only_the_third_orientation_is_misprinted(golden):
    """002-1: the printed axes are those of dyads of the other four, and of all five with the sign mended."""
    for name, fits in golden["002"]["m3_diagnosis"]["computed"].items():
        axis = golden["002"]["burmester_corrected"]["printed"][name]
        for k in range(1, 6):
            four = [number for number in range(1, 6) if number != k]
            assert misses(PRINTED.subset(four), axis) == pytest.approx(fits[f"drop_M{k}"], abs=1e-6)
        assert misses(PRINTED, axis) == pytest.approx(fits["all_five_printed"], abs=1e-6)
        assert misses(CORRECTED, axis) == pytest.approx(fits["all_five_corrected"], abs=1e-6)


def misses(given, axis):
    """Least singular value of the rows (M_i - M_ref)^T G, with the first as reference."""
    m = given.matrices
    return float(np.linalg.svd(np.array(axis) @ (m[1:] - m[0]), compute_uv=False)[-1])


def test_the_centre_axis_theorem(golden):
    """The angle S_12 G S_23 is half the crank angle from 1 to 3, modulo 180 degrees (hoop_theorem_mc)."""
    assert golden["002"]["hoop_theorem_mc"]["status"] == "agree"
    for dyad in dyads_of_five(CORRECTED).dyads:
        angle = next(c.angle for c in hoop(CORRECTED, dyad.fixed).crossings if c.pair == (2, 3))
        assert abs(np.sin(angle - dyad.crank_angles[2] / 2.0)) < 1e-9
