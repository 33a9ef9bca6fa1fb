"""Linkages on cylinders: maps from lengths against coordinates, files, several loops, what is printed of them."""

import json

import numpy as np
import pytest
from commands import run
from conical import WATT
from sizes import slow

from graphs.errors import FileError, InvariantError, UnsolvableError
from graphs.files.formats import read, read_linkage, write
from graphs.loops.loop import Centre
from graphs.mechanism.surfaces import Cylinder, SurfaceLinkage
from synth.linkages.surfaces.circuit import link_pairs
from synth.linkages.surfaces.linkage_maps import (
    by_sizes,
    common_surfaces,
    map_linkage,
    sizes_on,
    supplementary_linkages,
)
from synth.linkages.surfaces.loop_maps import chords, joint_coordinates, map_to_cylinders


def lengths_of(chain, places, radius):
    at = dict(zip(chain.joints, places, strict=True))
    return {(a, b): float(chords(at[b] - at[a], radius)) for a, b in link_pairs(chain)}


def told(*words):
    return json.loads(run(*words, "--json").stdout)


def test_coordinates_are_those_of_the_printed_radii():
    """Hyatt et al. 2021, Fig. 10: R 2.54 and 2.59; the joints lie on the circle, as far from each other as links."""
    found = told("cylinder", "map", "--lengths", "4,3,5,1")["cylinders"]
    assert [round(one["radius"], 2) for one in found] == [2.54, 2.59]
    for one in found:
        corners = np.array(one["coordinates"])
        np.testing.assert_allclose(np.hypot(*corners.T), one["radius"], rtol=1e-11)
        np.testing.assert_allclose(
            np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1), [4, 3, 5, 1], rtol=1e-11
        )
    out = run("cylinder", "map", "--lengths", "4,3,5,1").stdout
    assert "joints on cylinder 2" in out


@pytest.mark.parametrize(("cases", "least"), [(2, 12), slow(10, 60)])
def test_a_loop_in_a_file_lies_on_the_cylinders_of_its_lengths(cases, least, rng):
    seen = 0
    for links in (3, 4, 5, 6):
        for _ in range(cases):
            lengths = rng.uniform(1, 5, links)
            if 2 * lengths.max() >= lengths.sum():
                continue
            mine = map_linkage(SurfaceLinkage.loop(lengths, "cylinder")).surfaces
            theirs = [one.size for one in map_to_cylinders(lengths).cylinders if not one.half_turns]
            np.testing.assert_allclose([one.surface.radius for one in mine], theirs, rtol=1e-9)
            for one in mine:
                corners = joint_coordinates(one.surface.radius, list(one.places.values()))
                sides = np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1)
                np.testing.assert_allclose(sides, lengths, rtol=1e-8)
                seen += 1
    assert seen > least


@pytest.mark.parametrize("unit", [slow(1.0), slow(1e-6), 1e6])
def test_several_loops_have_their_cylinder_back(unit, rng):
    for _ in range(6):
        places, radius = rng.uniform(-np.pi, np.pi, 7), unit * rng.uniform(0.5, 4)
        lengths = lengths_of(WATT, places, radius)
        found, families = common_surfaces(WATT, lengths, lengths=True)
        assert families == ()
        (hit,) = [one for one in found if abs(one.surface.radius - radius) < 1e-6 * radius]
        again = sizes_on(SurfaceLinkage(WATT, lengths=lengths), hit.surface, hit.places)
        for pair, length in lengths.items():
            assert again.get(pair, again.get(pair[::-1])) == pytest.approx(length, rel=1e-6)
        assert hit.caution == ""
    changed = {**lengths, next(iter(lengths)): 1.01 * lengths[next(iter(lengths))]}
    assert common_surfaces(WATT, changed, lengths=True) == ((), ())


def test_a_short_arc_does_not_tell_the_radius(rng):
    lengths = lengths_of(WATT, 1e-4 * rng.uniform(-np.pi, np.pi, 7), 3.0)
    found, _ = common_surfaces(WATT, lengths, lengths=True)
    assert found
    assert all("radius is undetermined" in one.caution for one in found)


def test_parallelograms_lie_on_every_cylinder_from_one_on():
    found = map_linkage(SurfaceLinkage.loop([5, 3, 5, 3], "cylinder"))
    assert [family.interval for family in found.families] == [(2.5, np.inf)] * 2
    assert [one.circuits for one in found.surfaces] == [("open",)]
    assert "every radius from 2.5 on" in str(found)
    assert found.to_json()["families"][0]["radius"] == [2.5, None]


def test_files_keep_lengths_steps_and_radius(tmp_path):
    file = tmp_path / "a.json"
    given = SurfaceLinkage.loop([4, 3, 5, 1], "cylinder")
    write(given, file)
    again = read_linkage(file)
    assert (dict(again.lengths), again.kind, again.chain.loops[0].centre) == (
        dict(given.lengths), "cylinder", Centre.INFINITE
    )  # fmt: skip
    assert "synthedra/cylindrical" in file.read_text()
    run("cylinder", "map", file, "--cylinder", 2, "-o", tmp_path / "b.json")
    placed = read(tmp_path / "b.json")
    assert placed.surface.radius == pytest.approx(2.590911135653)
    assert sorted(by_sizes(placed).lengths.values()) == pytest.approx([1, 3, 4, 5], abs=1e-9)
    with pytest.raises(UnsolvableError, match="expected 'radius'"):
        by_sizes(SurfaceLinkage(placed.chain, steps=placed.steps))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda d: d.update(radius=2), "a cylinder with lengths"),
        (lambda d: d.update(lambda_deg=2), "lambda_deg"),
        (lambda d: d["lengths"][0].__setitem__(2, -1), "expected a number above 0"),
        (lambda d: (d.pop("lengths"), d.update(steps=[["1", "2", 40]])), "no step leads to joint"),
        (lambda d: (d.pop("lengths"), d.update(steps=[["1", "2", 40]], radius=0)), "expected a number above 0"),
    ],
)
def test_bad_files_are_refused(change, message, tmp_path):
    file = tmp_path / "a.json"
    write(SurfaceLinkage.loop([4, 3, 5, 1], "cylinder"), file)
    document = json.loads(file.read_text())
    change(document)
    file.write_text(json.dumps(document))
    with pytest.raises(FileError, match=message):
        read(file)


def test_bad_lengths_are_refused():
    with pytest.raises(InvariantError, match="length 2 is -3"):
        SurfaceLinkage.loop([4, -3, 5], "cylinder")
    with pytest.raises(InvariantError, match="a radius of 0"):
        Cylinder(0)
    with pytest.raises(InvariantError, match="above 0"):
        common_surfaces(WATT, {**lengths_of(WATT, np.arange(7), 1.0), (0, 1): -1.0}, lengths=True)


def test_the_chords_and_the_radius_of_a_cone_are_the_printed_ones():
    """Hyatt et al. 2021, Table 2 and Fig. 3: chords (Eq. 13), R (Eq. 14), lambda 25.21."""
    found = told("cone", "map", "--angles", "70,80,120,40")
    assert np.round(found["chords"], 3).tolist() == [1.147, 1.286, 1.732, 0.684]
    assert round(found["cones"][0]["R"], 5) == 0.90476
    assert round(found["cones"][0]["lambda_deg"], 2) == 25.21
    out = run("cone", "map", "--angles", "70,80,120,40").stdout
    assert "1.14715, 1.28558, 1.73205, 0.68404" in out
    assert "0.904758" in out


def test_steps_and_lambda_are_the_papers_own_parameters(golden, tmp_path):
    """Hyatt et al. 2020, Eq. 5: link angles from steps and lambda; the last step closes the loop."""
    entry = golden["000"]["pos_open_sample"]
    steps, angles = entry["inputs"]["loop_convention_steps"], entry["computed"]["link_angles"]
    given = ",".join(str(steps[name]) for name in ("alpha0", "eta0", "beta0"))
    file = tmp_path / "steps.json"
    words = ("cone", "map", "--steps", given, "--lambda", entry["inputs"]["lambda_deg"])
    (cone,) = told(*words, "-o", file)["cones"]
    by_pair = {(a, b): angle for a, b, angle in cone["link_angles_deg"]}
    for pair, name in ((("1", "2"), "alpha"), (("2", "3"), "eta"), (("3", "4"), "beta"), (("1", "4"), "gamma")):
        assert by_pair[pair] == pytest.approx(angles[name], abs=1e-9)
    assert cone["R"] == pytest.approx(np.cos(np.radians(20)))
    assert told("cone", "map", file)["cones"][0]["link_angles_deg"] == cone["link_angles_deg"]
    assert told("cone", "map", *words[2:], "--by-angles")["cones"]
    assert "every lambda between 0 and 90" in run("cone", "map", "--steps", "40,50,50").stdout
    assert "every radius from 0 on" in run("cylinder", "map", "--steps", "40,50,50").stdout


@pytest.mark.slow
def test_the_fifteen_others_are_printed_with_the_joints_turned():
    assert "joints turned" in str(supplementary_linkages(np.radians([85, 120, 95, 45])))


def test_the_fifteen_others_share_the_joint_lines(golden):
    """Hyatt et al. 2020, section 2.3: supplements at the joints turned; T1 T2 T3 T4 the same, T4 of eight values."""
    found = told("cone", "map", "--angles", "85,120,95,45", "--supplementary")
    assert (len(found["linkages"]), found["different"]) == (16, 8)
    ends = golden["000"]["fig10a_T"]["computed"]
    assert {round(abs(one["T4_deg"]), 9) for one in found["linkages"]} == {abs(ends[f"T{i}"]) for i in range(1, 5)}
    for one in found["linkages"]:
        turned = [joint in one["joints_turned"] for joint in range(1, 5)]
        for link, (angle, given) in enumerate(zip(one["angles_deg"], (85, 120, 95, 45), strict=True)):
            supplement = turned[link] != turned[(link + 1) % 4]
            assert angle == pytest.approx(180 - given if supplement else given)
    assert "Usage:" in run("cone", "map", "--steps", "40,50,50", "--supplementary", code=2).output
