"""Verdicts: the sentence, the numbers, how they are known, and what they are never to say."""

import json
import re
from dataclasses import replace

import networkx as nx
import numpy as np
import pytest
from commands import run
from sizes import slow

import synth
from graphs.files.formats import read, write
from graphs.mechanism.sheet import Sheet
from graphs.rank.dissection import number_below
from synth.analysis.motion import configuration as configurations
from synth.analysis.motion.flat_vertices import straight_folds
from synth.analysis.motion.singular.sampling import closes_along_general_rates
from synth.analysis.moving._configuration_of import configuration_of
from synth.analysis.verdict import _mobility
from synth.analysis.verdict._mobility import mobility, mobility_of_type, verdict_of_motion
from synth.analysis.verdict.verdict import FreedomBounds
from synth.catalogue.patterns.creases import fan, miura

KEYS = {
    "freedoms",
    "basis",
    "certainty",
    "branches",
    "exhaustive",
    "count",
    "at_least",
    "proved",
    "not_followed",
    "bounds",
    "immobile_joints",
    "immobile_places",
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
    assert (answer.mobility, answer.exact.mobility, answer.infinitesimal.dof) == (-3, 0, 6)
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
    assert len(verdict.immobile_joints) == 3
    assert verdict.clusters == ((0, 1, 2),)
    assert set(verdict.places) == set(verdict.immobile_joints)


def test_a_flap_on_a_rigid_thing_is_its_one_freedom():
    corners = ((0, 0), (1, 0), (-0.5, 0.9), (-0.5, -0.9), (1.5, 1.5))
    faces = ((0, 1, 2), (0, 2, 3), (0, 3, 1), (1, 4, 2))
    verdict = told(Sheet(5, (), "", faces, corners))
    assert verdict.freedoms == 1
    assert verdict.text.startswith("Rigid except for flaps: 1 degree of freedom, at the flap joint ")
    assert ". Immobile joints: " in verdict.text
    assert len(verdict.immobile_joints) == 3


def test_a_sector_of_180_degrees_leaves_the_others_immobile():
    """The straight line folds, and carries the half with three creases."""
    verdict = told(fan(np.radians([0, 180, 230, 300])))
    assert verdict.freedoms == 1
    assert len(verdict.immobile_joints) == 2
    assert "Immobile joints: " in verdict.text
    assert len(verdict.clusters) == 1


def test_what_moves_is_never_said_not_to():
    """Of every way each joint that moves at its sample is among no immobile joints."""
    rng = np.random.default_rng(5)
    for _ in range(10):
        headings = np.sort(rng.uniform(0, 2 * np.pi, rng.integers(4, 7)))
        answer = mobility(fan(headings), exact=False)
        immobile = set(answer.verdict.immobile_joints)
        for way in answer.verdict.branches:
            moving = {joint for joint, sign in zip(range(len(headings)), way.signs, strict=True) if sign != "0"}
            assert not moving & immobile
            assert immobile <= set(way.immobile_joints)


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


def test_a_large_sheet_has_bounds_of_what_was_not_searched_for(monkeypatch):
    """The straight lines are another branch; rates at the flat state are those of both families of creases."""
    verdict = told(miura(22, 20, 1.0))
    assert verdict.bounds == FreedomBounds(branches=2, stated=(1, 1), freest=(19, 19 + 21))
    assert f": 1 degree of freedom. {2**21} folding branches: 1 with 19 DOF, {2**21 - 1} with 1 DOF. " in verdict.text
    monkeypatch.setattr(_mobility, "count_of_modes", lambda *_: None)
    assert (
        ": 1 degree of freedom. Not all folding branches were searched for: there are at least 2, "
        "and the freest has at least 19 and at most 40 degrees of freedom. Numerical" in told(miura(22, 20, 1.0)).text
    )
    assert verdict.to_json()["bounds"] == {
        "branches_at_least": 2, "freedoms_at_least": 1, "freedoms_at_most": 1,
        "freest_at_least": 19, "freest_at_most": 40,
    }  # fmt: skip


@pytest.mark.parametrize(
    ("name", "rows", "columns"),
    [("miura", 4, 5), ("map", 4, 3), slow("miura", 6, 6), slow("waterbomb", 2, 2), slow("chickenwire", 4, 4)],
)
def test_bounds_hold_for_all_branches_of_a_sheet_small_enough_to_list_them(name, rows, columns, monkeypatch):
    sheet = synth.generate(name, rows=rows, columns=columns).mechanism
    at = configuration_of(sheet)
    listed = at.branches
    values = np.linalg.svd(at.closure.dense(at.linkage.angles), compute_uv=False)
    monkeypatch.setattr(configurations, "MOST_JOINTS", 3)
    monkeypatch.setattr(configurations, "all_branches_of_many", lambda *_: None)
    bounds = verdict_of_motion(configuration_of(sheet)).bounds
    freest = max(branch.freedoms for branch in listed.branches)
    assert listed.complete
    assert bounds.branches <= len(listed.branches)
    assert bounds.freest[0] <= freest <= bounds.freest[1] == len(at.joints) - (values > 1e-9).sum()
    assert bounds.stated == (verdict_of_motion(at).freedoms,) * 2


def test_rates_at_the_flat_state_are_not_all_of_motions():
    at = configuration_of(miura(5, 5, 1.0))
    every = np.arange(len(at.joints))
    assert not closes_along_general_rates(at.closure, at.linkage.angles, every)
    assert closes_along_general_rates(at.closure, at.branches.branches[0].sample, every)
    assert number_below(at.closure.at(at.linkage.angles)[1], 1e-5) == 8


def test_freedoms_between_bounds_are_said_to_be_so(monkeypatch):
    """Where general rates do not close, the rates at the end are only a bound."""
    monkeypatch.setattr(_mobility, "closes_along_general_rates", lambda *_: False)
    verdict = told(synth.generate("map", rows=26, columns=14).mechanism)
    least, most = verdict.bounds.stated
    assert (verdict.freedoms, verdict.certainty, least) == (None, "numerical", 1)
    assert f"assignment: at least 1 and at most {most} degrees of freedom. At least 2 folding" in verdict.text


RING = tuple((x, y) for y in range(4) for x in range(4))
"""Corners of three by three squares; panels leave the middle one open."""


@pytest.mark.parametrize(
    ("top", "lines"), [(((8, 9, 13, 12), (9, 10, 14, 13)), [2, 2]), (((8, 9, 10, 14, 13, 12),), [1, 2])]
)
def test_lines_go_on_beyond_a_hole_or_end_there(top, lines):
    """Above the hole the first line goes on between two panels, or ends at one."""
    faces = ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (4, 5, 9, 8), (6, 7, 11, 10), (10, 11, 15, 14), *top)
    at = configuration_of(Sheet(16, (), "", faces, tuple((float(x), float(y)) for x, y in RING)))
    families = straight_folds(at.linkage)
    assert sorted(int(family.max()) + 1 for family in families) == lines
    for family in families:
        angles = np.where(family < 0, 0.0, np.array([0.7, 0.4])[family])
        assert at.closure.error(angles) < 1e-12
