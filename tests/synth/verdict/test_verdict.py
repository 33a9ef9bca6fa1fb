"""Verdicts: the sentence, the numbers, how they are known, and what they are never to say."""

import json
import re
from dataclasses import replace

import networkx as nx
import numpy as np
import pytest
from commands import run

import synth
from graphs.files.formats import read, write
from graphs.mechanism.sheet import Sheet
from synth.patterns.creases import fan, miura
from synth.verdict.judged import mobility, mobility_of_type

KEYS = {
    "freedoms",
    "basis",
    "certainty",
    "branches",
    "exhaustive",
    "not_followed",
    "stiff_joints",
    "stiff_places",
    "clusters",
    "as_written",
    "within_precision",
    "text",
}


def told(sheet, **more):
    return mobility(sheet, exact=False, **more).verdict


def unmarked(sheet):
    return replace(sheet, assignments="".join(letter if letter == "B" else "U" for letter in sheet.assignments))


def test_a_miura_sheet_folds_though_its_type_is_rigid():
    """Four by four: M = -3, six rates, eight ways, one freedom on the one that is marked."""
    answer = mobility(miura(4, 4, 1.0))
    assert (answer.mobility, answer.exact.mobility, answer.pose.dof) == (-3, 0, 6)
    assert (answer.verdict.freedoms, answer.verdict.basis, answer.verdict.certainty) == (1, "motion", "proved")
    assert answer.verdict.text == (
        "Rigid-foldable from the flat state with the given mountain-valley assignment: 1 degree of freedom. "
        "8 folding branches: 1 with 3 DOF, 7 with 1 DOF. "
        "Overconstrained: a generic realisation is rigid (M = -3, h = 4)."
    )
    assert str(answer).startswith("Rigid-foldable from the flat state")


def test_without_marks_the_freest_way_is_told():
    """Along its three straight lines."""
    verdict = told(unmarked(miura(4, 4, 1.0)))
    assert verdict.freedoms == 3
    assert "from the flat state: up to 3 degrees of freedom." in verdict.text
    assert "assignment" not in verdict.text


def test_marks_that_no_way_has_are_said():
    sheet = miura(2, 2, 1.0)
    inner = [i for i, letter in enumerate(sheet.assignments) if letter != "B"]
    letters = list(sheet.assignments)
    for i in inner:
        letters[i] = "V"
    verdict = told(replace(sheet, assignments="".join(letters)))
    assert verdict.freedoms == 1
    assert "1 degree of freedom, but not with the given assignment (proved)." in verdict.text


@pytest.mark.parametrize("mirrored", [False, True])
def test_marks_choose_up_to_the_sign_of_all(mirrored):
    sheet = miura(3, 4, 1.0)
    if mirrored:
        sheet = replace(sheet, assignments=sheet.assignments.translate(str.maketrans("MV", "VM")))
    assert "with the given mountain-valley assignment: 1 degree" in told(sheet).text


def test_a_rigid_thing_is_proved_rigid():
    verdict = told(fan(np.radians([0, 120, 240])))
    assert (verdict.freedoms, verdict.certainty, verdict.text) == (0, "proved", "Rigid.")
    assert len(verdict.stiff_joints) == 3
    assert verdict.clusters == ((0, 1, 2),)
    assert set(verdict.places) == set(verdict.stiff_joints)


def test_a_flap_on_a_rigid_thing_is_its_one_freedom():
    corners = ((0, 0), (1, 0), (-0.5, 0.9), (-0.5, -0.9), (1.5, 1.5))
    faces = ((0, 1, 2), (0, 2, 3), (0, 3, 1), (1, 4, 2))
    verdict = told(Sheet(5, (), "", faces, corners))
    assert verdict.freedoms == 1
    assert verdict.text.startswith("Rigid except for flaps: 1 degree of freedom, at the flap joint ")
    assert ". Immobile joints: " in verdict.text
    assert len(verdict.stiff_joints) == 3


def test_a_sector_of_180_degrees_leaves_the_others_stiff():
    """The straight line folds, and carries the half with three creases."""
    verdict = told(fan(np.radians([0, 180, 230, 300])))
    assert verdict.freedoms == 1
    assert len(verdict.stiff_joints) == 2
    assert "Immobile joints: " in verdict.text
    assert len(verdict.clusters) == 1


def test_what_moves_is_never_said_not_to():
    """Of every way each joint that moves at its sample is among no stiff joints."""
    rng = np.random.default_rng(5)
    for _ in range(10):
        headings = np.sort(rng.uniform(0, 2 * np.pi, rng.integers(4, 7)))
        answer = mobility(fan(headings), exact=False)
        stiff = set(answer.verdict.stiff_joints)
        for way in answer.verdict.branches:
            moving = {joint for joint, sign in zip(range(len(headings)), way.signs, strict=True) if sign != "0"}
            assert not moving & stiff
            assert stiff <= set(way.stiff_joints)


def test_folded_poses_are_regular():
    sheet = fan(np.radians([0, 60, 180, 300]), "MVVV")
    folded = synth.fold(sheet, drive={1: 1.0}, frames=1).frames()[-1]
    verdict = told(folded)
    assert (verdict.freedoms, verdict.basis, verdict.certainty) == (1, "pose", "proved")
    assert verdict.text == "Rigid-foldable from this configuration: 1 degree of freedom."


def test_types_without_coordinates_have_their_generic_mobility(data):
    verdict = mobility(nx.cycle_graph(5)).verdict
    assert (verdict.freedoms, verdict.basis, verdict.certainty) == (2, "generic", "proved")
    rigid = mobility(read(data / "wiener" / "concentric-loops.json")).verdict
    assert rigid.freedoms == 0
    assert rigid.text.startswith("A generic realisation is rigid")
    counted = mobility(nx.cycle_graph(5), exact=False).verdict
    assert (counted.freedoms, counted.basis, counted.certainty) == (2, "count", "not known")


def test_motion_is_left_out_on_request():
    sheet = miura(2, 2, 1.0)
    verdict = mobility(sheet, motion=False).verdict
    assert verdict.basis == "generic"
    assert "its motion was not analysed" in verdict.text
    assert mobility_of_type(sheet).verdict.basis == "generic"


def test_the_command_gives_the_verdict_first(tmp_path, data):
    file = tmp_path / "miura.fold"
    write(miura(3, 3, 1.0), file)
    lines = run("mobility", file).stdout.splitlines()
    assert lines[1].startswith("Rigid-foldable from the flat state")
    [report] = json.loads(run("mobility", "--json", file).stdout)
    assert report["verdict"].keys() == KEYS
    assert [way["freedoms"] for way in report["verdict"]["branches"]].count(1) == 3
    assert run("mobility", "--no-motion", file).stdout.splitlines()[1].startswith("A generic realisation")
    table = run("mobility", file, data / "wiener" / "watt.json").stdout
    assert "DOF" in table


def test_the_table_of_equations_is_printed_on_request(data):
    """The line names those that apply; the table has all of them, as the data have."""
    file = data / "wiener" / "watt.json"
    short, long = run("mobility", file).stdout, run("mobility", "--verbose", file).stdout
    answer = mobility(read(file))
    [line] = [line for line in short.splitlines() if line.startswith("equations that apply: ")]
    rows = [line for line in long.splitlines() if re.search(r" (yes|no)  ", line)]
    assert len(rows) == len(answer.equations) == len(answer.to_json()["equations"])
    assert not any(equation.why in short for equation in answer.equations.values())
    assert all(equation.why in long for equation in answer.equations.values())
    named = line.removeprefix("equations that apply: ").partition("   ")[0].split("; ")
    assert len(named) == sum(one.applies and one.value is not None for one in answer.equations.values())


def test_a_large_sheet_is_judged_by_one_motion_along_its_assignment():
    """More panels than were once analysed at all: the freedoms are those of the source."""
    verdict = told(miura(36, 36, 1.0))
    assert (verdict.freedoms, verdict.basis, verdict.certainty) == (1, "motion", "numerical")
    assert "with the given mountain-valley assignment" in verdict.text
