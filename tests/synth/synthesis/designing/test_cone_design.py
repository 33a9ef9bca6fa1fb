"""Linkages designed for a cone: what is listed keeps to its side, by the places of points in space."""

import json

import numpy as np
import pytest
from commands import run

import synth
from graphs.errors import InvariantError
from graphs.files.formats import read
from synth.analysis.moving.on_surface import LinkPoint, move_on_surface
from synth.synthesis.designing.cone_design import ConeSide
from synth.synthesis.designing.dimensions import ConeDimensions
from synth.synthesis.designing.problem import DesignProblem
from synth.synthesis.designing.wishes import Goal, WishedConfiguration, Wishes


def heights(design, half_angle, link, azimuths, turns):
    """By how much points of a link lie outside the cone, as angles from its axis at the apex."""
    motion = move_on_surface(
        design.linkage,
        design.motion.chain.links[0],
        at=turns,
        points=[LinkPoint(link, float(azimuth)) for azimuth in azimuths],
    )
    direct = [place for place, each in enumerate(motion.positions) if each.direct]
    places = np.stack([motion.places_of(point)[direct] for point in motion.points])
    from_axis = np.arccos(-places[..., 1] / np.linalg.norm(places, axis=-1))
    return from_axis - half_angle


@pytest.mark.parametrize(("side", "turn"), [("outside", 60), ("inside", 20)])
def test_links_keep_to_their_side_by_points_in_space(side, turn):
    half_angle = np.radians(25)
    designs = synth.design_on_cone(half_angle, np.radians(turn), side=side, tries=6, count=2).designs
    assert designs
    for design in designs:
        chain, places = design.motion.chain, np.array(design.linkage.places)
        assert abs(design.reach) >= np.radians(turn)
        sign = 1 if side == "outside" else -1
        for link, joints in zip(chain.links[1:], chain.joints_of[1:], strict=True):
            begin = places[list(joints)]
            step = np.remainder(begin[1] - begin[0] + np.pi, 2 * np.pi) - np.pi
            azimuths = begin[0] + step * np.linspace(0, 1, 5)
            turns = np.sign(design.reach) * np.linspace(0.1, 0.98, 4) * min(abs(design.reach), np.radians(170))
            off = sign * heights(design, half_angle, link, azimuths, turns)
            assert off.min() > -1e-9
            assert off.max() > 1e-3


@pytest.mark.slow
def test_azimuths_change_until_links_keep_to_the_side_where_the_grid_has_none():
    half_angle, turn = np.radians(25), np.radians(40)
    answer = synth.design_on_cone(half_angle, turn, side="inside", tries=6)
    assert answer.changed == len(answer.designs) > 0
    for design in answer.designs:
        places, chain = np.array(design.linkage.places), design.motion.chain
        assert abs(design.reach) >= turn
        assert np.abs(places / np.radians(10) - np.round(places / np.radians(10))).max() > 0.01
        for link, (first, last) in zip(chain.links[1:], chain.joints_of[1:], strict=True):
            step = np.remainder(places[last] - places[first] + np.pi, 2 * np.pi) - np.pi
            azimuths = places[first] + step * np.linspace(0, 1, 5)
            turns = np.sign(design.reach) * turn * np.linspace(0.1, 0.99, 5)
            assert heights(design, half_angle, link, azimuths, turns).max() < 1e-9


def test_the_side_of_a_link_has_exact_derivatives(rng):
    family = ConeDimensions(synth.design_on_cone(np.radians(25), 1.0, tries=2).designs[0].linkage, fixed=["cone_angle"])
    joints = [str(joint) for joint in family.chain.joints]
    wish = ConeSide(at="turned", link="2", ends=(joints[0], joints[1]), parts=(0.2, 0.7), goal=Goal(at_least=3.0))
    problem = DesignProblem(family, Wishes((wish,), (WishedConfiguration("turned", {joints[0]: 0.4}),)))
    at, along = problem.start + 0.1 * rng.normal(size=problem.size), rng.normal(size=problem.size)
    slopes = [
        (problem.evaluated(at + h * along).wishes - problem.evaluated(at - h * along).wishes) / (2 * h)
        for h in (1e-3, 5e-4)
    ]
    np.testing.assert_allclose(problem.evaluated(at).by_wishes @ along, (4 * slopes[1] - slopes[0]) / 3, atol=1e-8)


def test_margins_and_sizes():
    answer = synth.design_on_cone(np.radians(25), np.radians(60), tries=4, size=120.0)
    assert answer.rim == pytest.approx(120 * np.sin(np.radians(25)))
    for design, row in zip(answer.designs, answer.to_json()["designs"], strict=True):
        places = np.sort(np.remainder(design.linkage.places, 2 * np.pi))
        gaps = np.diff(places, append=places[0] + 2 * np.pi)
        assert row["joints_apart"] == pytest.approx(answer.rim * gaps.min())
        steps = np.diff(design.linkage.places, prepend=design.linkage.places[-1])
        around = np.abs(np.remainder(steps + np.pi, 2 * np.pi) - np.pi)
        assert sorted(row["rim_sizes"].values()) == pytest.approx(sorted(answer.rim * around))
    assert synth.design_on_cone(np.radians(25), np.radians(60), tries=4).to_json() == answer.to_json()


def test_a_range_and_a_link_are_wishes():
    wide = synth.design_on_cone(np.radians(40), np.radians(30), least_range=2 * np.pi, tries=8)
    assert wide.designs
    assert all(design.motion.turns_fully for design in wide.designs)
    one = synth.design_on_cone(np.radians(40), np.radians(200), keeping=["3"], tries=6)
    all_of_them = synth.design_on_cone(np.radians(40), np.radians(200), tries=6)
    assert len(one.designs) > len(all_of_them.designs)


def test_what_is_refused():
    for values, said in (
        ((2.0, 1.0, {}), "half angle"),
        ((0.5, 0.0, {}), "turn"),
        ((0.5, 1.0, {"links": 5}), "5 links"),
        ((0.5, 1.0, {"side": "above"}), "no side"),
        ((0.5, 1.0, {"size": -1.0}), "ruling lines"),
        ((0.5, 1.0, {"keeping": ["7"]}), "7"),
        ((0.5, 1.0, {"tries": 0}), "0 linkages"),
    ):
        half_angle, turn, others = values
        with pytest.raises(InvariantError, match=said):
            synth.design_on_cone(half_angle, turn, **others)


def test_the_command_writes_a_linkage_that_moves_so(tmp_path):
    place = tmp_path / "design.json"
    words = ("cone", "design", "--half-angle", "25deg", "--outside", "60deg", "--tries", 4)
    table = run(*words, "-o", place).stdout
    assert "half angle 25 degrees" in table
    document = json.loads(run(*words, "--json").stdout)
    motion = json.loads(run("cone", "move", place, "--json").stdout)["linkages"][0]
    ends = [motion[sense]["one_way"] for sense in ("backward", "forward")]
    reach = document["designs"][0]["reach_deg"]
    assert any(one and one["way"] == "outward" and one["to_deg"] == pytest.approx(reach) for one in ends)
    assert motion["half_angle_deg"] == pytest.approx(25)
    assert read(place).kind == "cone"
    run("cone", "design", "--half-angle", 25, "--outside", 350, "--tries", 1, code=1)
    assert "is required" in run("cone", "design", "--half-angle", 25, code=2).output


def test_six_links_have_their_chains():
    answer = synth.design_on_cone(np.radians(25), np.radians(40), links=6, tries=10)
    assert {design.chain for design in answer.designs} <= {"watt", "stephenson"}
    assert all(len(design.arcs) == 6 for design in answer.designs)
    assert answer.designs


def test_half_angles_are_read_and_printed():
    by_lambda = run("cone", "behaviour", "--steps", "40,50,50", "--lambda", 65).stdout
    assert by_lambda == run("cone", "behaviour", "--steps", "40,50,50", "--half-angle", 25).stdout
    assert "lambda 65 degrees (half angle 25 degrees)" in by_lambda
    assert "exclude" in run("cone", "move", "--steps", "40,50,50", "--lambda", 65, "--half-angle", 2, code=2).output


def test_both_views_are_turned_alike():
    from graphs.mechanism.surfaces import Cone
    from synth.linkages.conformed.rates import ConformedChain
    from synth.making.drawing.conformed import draw_conformed

    chain = ConformedChain.of(synth.SurfaceLinkage.loop(np.radians([120, 95, 45, 85])).chain)
    scene = draw_conformed(chain, np.radians([0, 80, 250, 160]), Cone(np.radians(65)))
    labels = [label for label in scene.labels() if label.data and label.data[0][0] == "joint"]
    around = {}
    for label in labels:  # where a joint is, from the middle of its view
        x, y = label.at[0] % 240 - 120, 120 - label.at[1]
        around.setdefault(label.text, []).append(np.arctan2(y, x))
    for first, second in around.values():
        assert abs(np.remainder(first - second + np.pi, 2 * np.pi) - np.pi) < np.radians(40)
    assert "link 2 (joints 2, 3): out" in [label.text for label in scene.labels()]
