"""Linkages of several loops on one cone: from projected angles always, from link angles where a cone is common."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from conical import FOUR_BAR, STEPHENSON, WATT, wrap
from memberships import memberships
from sizes import slow

from graphs.errors import FileError, InvariantError, UnsolvableError
from graphs.files.formats import read_linkage, write
from graphs.geometry import angles_between
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.surfaces import SurfaceLinkage, joint_axes, places_of_steps
from synth.linkages.surfaces.circuit import link_angles, link_pairs, loop_steps
from synth.linkages.surfaces.linkage_maps import common_surfaces
from synth.linkages.surfaces.loop_maps import map_to_cones

ROOT = Path(__file__).resolve().parents[4]
FIG_11 = ROOT / "data" / "surfaces" / "fig11-stephenson.json"


def angles_of(chain, places, lam, pairs=None):
    at = dict(zip(chain.joints, places, strict=True))
    return {(a, b): float(link_angles(at[b] - at[a], lam)) for a, b in pairs or link_pairs(chain)}


def pairs_in_loops(chain):
    """Only the pairs that follow each other in a loop."""
    known = link_pairs(chain)
    found = {}
    for loop in chain.loops:
        for a, b in zip(loop.joints, [*loop.joints[1:], loop.joints[0]], strict=True):
            found[(a, b) if (a, b) in known else (b, a)] = None
    return list(found)


@pytest.mark.parametrize("chain", [FOUR_BAR, WATT, STEPHENSON], ids=["four-bar", "watt", "stephenson"])
def test_projected_angles_always_fit(chain, rng):
    places = rng.uniform(-np.pi, np.pi, (2000, len(chain.joints)))
    lam = rng.uniform(0.05, 1.4, 2000)
    axes = joint_axes(places, lam)
    column = {joint: i for i, joint in enumerate(chain.joints)}
    for loop in loop_steps(chain, places):
        n = len(loop.joints)
        assert np.abs(loop.circuits.residual).max() < 1e-12
        assert np.abs(loop.circuits.turns).max() <= n // 2
        mine = axes[:, [column[joint] for joint in loop.joints]]
        np.testing.assert_allclose(loop.angles(lam), angles_between(mine, np.roll(mine, -1, axis=1)), atol=1e-12)


@pytest.mark.parametrize("chain", [WATT, STEPHENSON], ids=["watt", "stephenson"])
@pytest.mark.parametrize("whole", [True, False], ids=["all angles", "angles in loops"])
@pytest.mark.parametrize("cases", [3, slow(60)])
def test_link_angles_from_a_cone_give_it_back(chain, whole, cases, rng):
    for _ in range(cases):
        places, lam = rng.uniform(-np.pi, np.pi, 7), rng.uniform(0.1, 1.3)
        angles = angles_of(chain, places, lam, None if whole else pairs_in_loops(chain))
        cones, families = common_surfaces(chain, angles)
        assert not families
        signs = [np.sign(loop.steps) for loop in loop_steps(chain, places)]
        mirror = signs[0][0]
        wanted = tuple(tuple((one * mirror).astype(int).tolist()) for one in signs)
        (hit,) = [cone for cone in cones if abs(cone.surface.angle - lam) < 1e-6 and cone.signs == wanted]
        assert hit.residual < 1e-6
        # its azimuths are ours, but for where they begin and the mirror
        shown = np.array([hit.places[joint] for joint in chain.joints])
        first = list(chain.joints).index(chain.loops[0].joints[0])
        assert np.abs(wrap(shown - mirror * (places - places[first]))).max() < 1e-5
        for cone in cones:
            own = np.array([cone.places[joint] for joint in chain.joints])
            again = angles_of(chain, own, cone.surface.angle, list(angles))
            assert again == pytest.approx(angles, abs=1e-6)


@pytest.mark.parametrize("chain", [WATT, slow(STEPHENSON)], ids=["watt", "stephenson"])
def test_link_angles_seldom_have_a_common_cone(chain, rng):
    places, lam = rng.uniform(-np.pi, np.pi, 7), 0.6
    angles = angles_of(chain, places, lam)
    one = next(iter(angles))
    for change in (1e-3, -1e-3):
        assert common_surfaces(chain, {**angles, one: angles[one] + change}) == ((), ())
    # a looser tolerance takes it
    assert common_surfaces(chain, {**angles, one: angles[one] + 1e-6}, tolerance=1e-3)[0]


@pytest.mark.parametrize("cases", [3, slow(50)])
def test_one_loop_is_what_the_mapping_says(cases, rng):
    """The general machinery on the four-bar: the same cones, signs, k and circuits."""
    pairs = [("O", "A"), ("A", "B"), ("B", "C"), ("C", "O")]
    for _ in range(cases):
        places, lam = rng.uniform(-np.pi, np.pi, 4), rng.uniform(0.1, 1.3)
        angles = angles_of(FOUR_BAR, places, lam, pairs)
        mine, _ = common_surfaces(FOUR_BAR, angles)
        theirs = map_to_cones(list(angles.values())).cones
        assert [(one.signs[0], one.turns[0], one.circuits[0]) for one in mine] == [
            (one.signs, one.turns, one.circuit) for one in theirs
        ]
        np.testing.assert_allclose([one.surface.angle for one in mine], [one.size for one in theirs], atol=1e-12)


def test_families_of_several_loops():
    """Two crossed parallelograms that share a joint lie together on every cone."""
    a, b = np.radians([60, 35])
    pairs = pairs_in_loops(WATT)
    angles = dict(zip(pairs, [a, b, a, b, a, b, a, b], strict=True))
    cones, families = common_surfaces(WATT, angles)
    assert families
    assert all(one.interval == (0.0, pytest.approx(np.pi / 2 - a / 2)) for one in families)
    for one in families:
        for lam in (0.2, 0.7):
            for loop, signs in zip(WATT.loops, one.signs, strict=True):
                del loop
                steps = 2 * np.arcsin(np.sin(np.array([a, b, a, b]) / 2) / np.cos(lam))
                assert abs(np.dot(signs, steps)) < 1e-12
    # and open, both at once
    assert any(set(cone.circuits) == {"open"} for cone in cones)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda x: {**x, (0, 5): 1.0}, "no link carries both"),
        (lambda x: {**x, (1, 0): 1.0}, "occurs twice"),
        (lambda x: {**x, (0, 1): -1.0}, "is -57.2957795131 degrees; expected between 0 and 180"),
        (lambda x: {k: v for k, v in x.items() if k != (0, 1)}, "no angle between joints 0 and 1"),
    ],
)
def test_link_angles_that_do_not_do(change, message, rng):
    angles = angles_of(WATT, rng.uniform(-3, 3, 7), 0.5)
    with pytest.raises(InvariantError) as error:
        common_surfaces(WATT, change(angles))
    assert message in str(error.value)


def test_a_chain_without_loops_is_refused():
    with pytest.raises(UnsolvableError, match="no loops"):
        common_surfaces(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)]), {})


def test_steps_may_lead_any_way():
    placed = places_of_steps({("C", "D"): 0.1, ("A", "B"): 0.5, ("D", "A"): -0.2, ("C", "A"): -0.1 + 2 * np.pi})
    assert placed["B"] - placed["C"] == pytest.approx(0.4)
    with pytest.raises(InvariantError, match="from 'C' to 'A' misses by"):
        places_of_steps({("C", "D"): 0.1, ("D", "A"): -0.2, ("C", "A"): 0.3})
    with pytest.raises(InvariantError, match="no steps lead from joint 'A' to 'C'"):
        places_of_steps({("A", "B"): 0.1, ("C", "D"): 0.1})
    assert places_of_steps({}) == {}


def test_memberships_need_a_name_for_each_joint():
    with pytest.raises(InvariantError, match="6 names for 7 joints"):
        memberships(STEPHENSON, "OABCDE")
    for chain in memberships(WATT, "OABCDEF"):
        pairs = {frozenset(pair) for pair in link_pairs(chain)}
        assert all({a, b} in pairs for a, b in zip("OABCDE", "ABCDEF", strict=True))


def test_half_turns_are_marked():
    (loop,) = loop_steps(FOUR_BAR, np.radians([[0, 180, 230, 300], [0, 179, 230, 300]]))
    assert loop.half_turns.tolist() == [[True, False, False, False], [False] * 4]
    assert np.degrees(loop.steps[0, 0]) == 180


def test_azimuths_must_be_those_of_the_joints():
    with pytest.raises(InvariantError, match="3 azimuths; expected 4, one per joint"):
        loop_steps(FOUR_BAR, [0.0, 1.0, 2.0])


# ---- files --------------------------------------------------------------------------------------------------


def schema():
    return json.loads((ROOT / "graphs" / "schema" / "conical.schema.json").read_text(encoding="utf-8"))


def test_files_come_back_as_they_were(tmp_path, rng):
    places = rng.uniform(-np.pi, np.pi, 7)
    linkage = SurfaceLinkage(WATT, angles=angles_of(WATT, places, 0.5))
    write(linkage, tmp_path / "a.json")
    jsonschema.validate(json.loads((tmp_path / "a.json").read_text()), schema())
    again = read_linkage(tmp_path / "a.json")
    assert again.angles == pytest.approx(linkage.angles, abs=1e-11)
    assert again.chain.joints == WATT.joints
    cones, _ = common_surfaces(again.chain, again.angles)
    assert any(abs(cone.surface.angle - 0.5) < 1e-6 for cone in cones)
    fig = read_linkage(FIG_11)
    write(fig, tmp_path / "b.json")
    assert (tmp_path / "b.json").read_text() == FIG_11.read_text()
    jsonschema.validate(json.loads(FIG_11.read_text()), schema())


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"format": "synthedra/none"}, "format: 'synthedra/none'; expected one of synthedra/conical"),
        ({"version": 2}, "version: 2; expected 1"),
        ({"loops": []}, "loops: no loops"),
        ({"angles": []}, "both or neither of 'angles' and 'steps'"),
        ({"lambda_deg": 90}, "lambda_deg: 90; expected 0 or more, and less than 90"),
        ({"lambda_deg": "x"}, "lambda_deg: 'x'; expected a number"),
        ({"steps": [["O", "A", 10]]}, "steps: no step leads to joint 'B'"),
        ({"steps": [["O", "A", 400]]}, "steps[0][2]: 400; expected between -360 and 360 degrees"),
        ({"steps": [["O", "Z", 40]]}, "steps[0][1]: 'Z' is no joint"),
        ({"steps": [["O", "O", 40]]}, "steps[0]: joint 'O' twice"),
        ({"steps": [["O", "A", 40], ["A", "O", 40]]}, "steps[1]: joints 'A' and 'O' again"),
        ({"steps": [["O", "A"]]}, "steps[0]: a list of 2; expected [joint, joint, degrees]"),
        ({"steps": {}}, "steps: an object; expected a list"),
        ({"extra": 1}, "unknown key 'extra'"),
    ],
)  # fmt: skip
def test_bad_files_are_named_with_the_place(change, message, tmp_path):
    path = tmp_path / "bad.json"
    path.write_text(json.dumps({**json.loads(FIG_11.read_text()), **change}))
    with pytest.raises(FileError) as error:
        read_linkage(path)
    assert str(error.value).startswith(f"{path}: ")
    assert message in str(error.value)
    if "extra" not in change and "loops" not in change and "steps" not in change:
        assert not jsonschema.Draft202012Validator(schema()).is_valid(json.loads(path.read_text()))


def test_link_angles_with_a_cone_angle_are_refused(tmp_path):
    document = json.loads(FIG_11.read_text())
    document["angles"] = document.pop("steps")
    path = tmp_path / "bad.json"
    path.write_text(json.dumps({**document, "angles": [["O", "A", 40]]}))
    with pytest.raises(FileError, match="lambda_deg: a cone with angles"):
        read_linkage(path)


def test_a_loop_may_be_named_from_any_joint(rng):
    """Turning a loop's list round changes nothing but the signs' order."""
    turned = SCGraph(6, dict(WATT.joints), [Loop((2, 1, 0, 3)), Loop((5, 6, 3, 4))])
    places = rng.uniform(-np.pi, np.pi, 7)
    angles = angles_of(WATT, places, 0.4)
    one, two = (common_surfaces(chain, angles)[0] for chain in (WATT, turned))
    np.testing.assert_allclose([c.surface.angle for c in one], [c.surface.angle for c in two], atol=1e-9)
    assert [sorted(c.circuits) for c in one] == [sorted(c.circuits) for c in two]
