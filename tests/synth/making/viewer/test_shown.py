"""What pages show: data of things that move, of what is rigid, of types without a pose."""

import json
import re

import numpy as np
import pytest
from folded_sheets import unassigned_map

import synth
from graphs.files.formats import read
from graphs.mechanism.sheet import Sheet
from synth.analysis.motion.linkage import linkage_of_sheet
from synth.catalogue.patterns.creases import miura
from synth.linkages.conformed.linkage_behaviour import loop_on_cones, loop_on_cylinders
from synth.making.viewer.linkage import factor_order, hull_faces, solver_data
from synth.making.viewer.page_data import shown_of


@pytest.fixture(scope="module")
def bird_base(data):
    return shown_of(read(data / "patterns" / "bird-base.fold"), "bird base")


def test_a_pattern_has_its_ways_and_the_marked_one_is_taken(bird_base):
    shown = bird_base
    told = json.loads(json.dumps(shown.to_json(), allow_nan=False))
    ways = told["moving"]["ways"]
    assert len(ways["all"]) == 16
    assert ways["singular"]
    assert ways["all"][ways["taken"]]["told"] == f"branch {ways['taken']}: 5 DOF, numerical"
    assert told["verdict"] in told["report"]
    assert {"light", "dark"} == set(told["pictures"])
    assert len(told["moving"]["between"]) == len(told["moving"]["joints"]) == 20


def test_what_a_page_moves_is_at_the_configuration_it_names(bird_base):
    told = bird_base.to_json()
    at, moving = told["configuration"], told["moving"]
    assert (at["joints"], at["links"]) == ([str(joint) for joint in moving["joints"]], len(moving["links"]))
    assert at == json.loads(bird_base.answer)["configuration"]
    way = moving["ways"]["all"][moving["ways"]["taken"]]
    assert (at["freedoms"], at["immobile_joints"]) == (way["freedoms"], way["immobile"])


def test_each_way_has_a_driver_for_each_freedom_the_fastest_first(bird_base):
    for way in bird_base.moving.ways.all:
        assert len(set(way.drivers)) == len(way.drivers) == way.freedoms == 5
        assert abs(way.rates[way.drivers[0]]) == pytest.approx(1.0, abs=1e-6)
        assert not set(way.drivers) & set(way.immobile)


def test_a_pattern_is_told_where_it_is_drawn(bird_base):
    shape = re.search(r'data-link="0" d="([^"]*)"', bird_base.pictures["light"]).group(1)
    corners = np.array(re.findall(r"-?[0-9.]+", shape), dtype=float).reshape(-1, 2)
    places = np.array(bird_base.drawn.places)
    assert len(corners) >= 3
    assert np.linalg.norm(corners[:, None] - places, axis=-1).min(axis=1).max() < 0.02


def test_what_is_rigid_is_shown_with_the_reason(data):
    shown = shown_of(read(data / "linkages" / "wampler-cube-locked.json"))
    assert shown.moving.ways is None
    assert len(shown.moving.bodies.faces) > 20
    assert "no motion begins at this configuration (proved: " in shown.notes[0]
    assert len(shown.immobile) == len(shown.moving.linkage.angles)


def test_a_type_is_a_drawing(data):
    shown = shown_of(read(data / "wiener" / "six-bar.json"))
    assert shown.moving is None
    assert shown.pictures["light"].startswith("<svg")
    assert "has none" in shown.notes[0]


def test_immobile_creases_and_clusters_are_told():
    """Three creases about a point hold each other; the flap beside them moves."""
    corners = ((0, 0), (2, 0), (-1, 2), (-1, -2), (3, 3))
    faces = ((0, 1, 2), (0, 2, 3), (0, 3, 1), (1, 4, 2))
    shown = shown_of(Sheet(5, (), "", faces, corners))
    assert len(shown.immobile) == 3
    assert shown.clusters == (("0", "1", "2"),)


def test_links_without_panels_are_hulls_of_their_axes(data):
    moving = shown_of(read(data / "linkages" / "kaleidocycle-6.json")).moving
    faces = [sum(1 for link, _ in moving.bodies.faces if link == one) for one in range(6)]
    assert faces == [4] * 6  # tetrahedra
    assert sorted(joint for *_, joint in moving.bodies.edges if joint >= 0) == list(range(6))


@pytest.mark.parametrize("corners", [[], [(0, 0, 0), (1, 1, 1)], [(0, 0, 0), (1, 1, 1), (2, 2, 2)]])
def test_points_on_a_line_have_no_faces(corners):
    assert hull_faces(np.array(corners, dtype=float).reshape(-1, 3)) == []


def filled_in(order, loops):
    """Entries of a factor, by elimination one joint after the other."""
    joints = len(order)
    beside = [set() for _ in range(joints)]
    for loop in loops:
        for one in loop:
            beside[one] |= set(loop) - {one}
    entries = 0
    for joint in sorted(range(joints), key=lambda joint: order[joint]):
        entries += len(beside[joint]) + 1
        for one in beside[joint]:
            beside[one] = (beside[one] | beside[joint]) - {one, joint}
    return entries


def test_the_order_of_factors_keeps_them_sparse():
    linkage = linkage_of_sheet(miura(8, 8, np.radians(60.0)))
    loops = [loop.joints for loop in linkage.loops]
    order = factor_order(len(linkage.angles), loops)
    assert sorted(order) == list(range(len(order)))
    others = [np.arange(len(order)), np.argsort(order), np.random.default_rng(1).permutation(len(order))]
    assert filled_in(order, loops) < 0.85 * min(filled_in(other, loops) for other in others)


def test_joints_that_carry_links_come_after_those_that_carry_them(bird_base):
    linkage = bird_base.moving.linkage
    told = solver_data(linkage, limited=True, ground=3)
    carried = {3}
    for near, far, joint, sign in told["tree"]:
        assert near in carried
        assert far not in carried
        pair = list(linkage.graph.joints.values())[joint]
        assert pair == ((near, far) if sign == 1 else (far, near))
        carried.add(far)
    assert carried == set(range(told["links"]))


def test_a_pattern_that_folds_flat_has_its_orders(data):
    """Each listed order has all panels over each cell once, the first changes nothing, and no two are alike."""
    bird = read(data / "patterns" / "bird-base.fold")
    flat = shown_of(bird).to_json()["flat"]
    order = synth.layers(bird).order()
    assert flat["told"] == "Folds flat, in 2 layer orders."
    assert flat["stacks"] == [list(stack) for stack in order.stacks]
    assert np.ptp(flat["nodes"], axis=0).max() == pytest.approx(1.0)
    [component] = flat["components"]
    assert component["orders"] == "2"
    first, second = component["listed"]
    assert first == {}
    assert second != {}
    for cell, stack in second.items():
        assert sorted(stack) == sorted(flat["stacks"][int(cell)])
        assert stack != flat["stacks"][int(cell)]


def test_of_many_orders_some_are_listed():
    flat = shown_of(unassigned_map(4, 4)).flat
    assert [component.orders for component in flat.components] == ["300608"]
    assert len(flat.components[0].listed) == 24
    assert shown_of(unassigned_map(5, 5)).flat is None


def test_what_does_not_fold_flat_has_no_layers(data):
    assert shown_of(read(data / "linkages" / "bennett.json")).flat is None
    corners = ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (-1.0, -1.0))
    assert shown_of(Sheet(4, (), "", ((0, 1, 2), (0, 2, 3), (0, 3, 1)), corners)).flat is None


@pytest.mark.parametrize("kind", ["cone", "cylinder"])
def test_links_on_a_surface_are_curved_shells_over_it(kind):
    if kind == "cone":
        linkage = loop_on_cones(np.radians([120, 95, 45, 85]))[0].linkage()
    else:
        linkage = loop_on_cylinders([4.0, 3.0, 5.0, 1.0])[0].linkage()
    moving = shown_of(linkage).moving
    bodies, posed, surface = moving.bodies, moving.linkage, linkage.surface
    places = posed.middle + posed.extent * bodies.vertices
    across = np.hypot(places[:, 0], places[:, 2])  # from the axis, y
    if kind == "cone":  # outside of the cone, by at most four layers
        off = across * np.sin(surface.angle) + places[:, 1] * np.cos(surface.angle)
    else:
        off = across - surface.radius
    size = np.ptp(surface.spans)
    assert off.min() > 0
    assert off.max() < 0.05 * size
    for a, b, letter, joint in bodies.edges:
        if letter == "-":  # axes are ruling lines: parallel to those of the linkage
            along = bodies.vertices[b] - bodies.vertices[a]
            assert np.linalg.norm(np.cross(along, posed.directions[joint])) < 1e-9
    assert {owner for owner, _ in bodies.faces} == set(range(4))
    assert len(bodies.faces) > 100  # shells are curved


def test_panels_of_a_flat_pattern_all_show_their_front(bird_base):
    bodies = bird_base.moving.bodies
    for _, face in bodies.faces:
        x, y = bodies.vertices[face, :2].T
        assert x @ np.roll(y, -1) - y @ np.roll(x, -1) > 0
