"""Panels that come to lie on each other on a path: the orders it can end with, and wrong orders told as crossing."""

import json
from dataclasses import replace
from math import pi

import numpy as np
import pytest
from commands import run
from folded_sheets import unassigned_map
from posed_sheets import box_with_flaps, half_folded_map

import synth
import synth.analysis.moving
from graphs.files.formats import write
from graphs.mechanism.sheet import Sheet
from synth.analysis.folding.configuration import layers_at
from synth.analysis.layering import read_face_orders, wishes_of

RIGHT = pi / 2


@pytest.mark.parametrize("name", ["miura", "waterbomb", "preliminary-base", "square-twist", "crash-lock"])
def test_paths_that_end_flat(name):
    """The way there leaves one order, which is among those that the creases leave; no panels pass through others."""
    sheet = synth.generate(name).mechanism
    short = synth.fold(sheet, frames=2)
    [(joint, angle)] = short.driven.items()
    motion = synth.fold(sheet, drive={joint: float(np.copysign(pi, angle))}, frames=8)
    assert not motion.crossing
    assert motion.resting.orders == 1
    assert "in 1 layer order" in str(motion)
    at = motion.configuration
    there = layers_at(replace(at.at(motion.path.angles[-1], motion.places[-1]), assignments=at.sheet.assignments))
    assert there.orders >= 1
    if name == "miura":
        assert there.orders == synth.layers(sheet).orders


def test_what_crosses_before_ends_in_no_order():
    """Panels of a chicken wire enter each other before it is flat, where no layer order is left."""
    sheet = synth.generate("chickenwire").mechanism
    [(joint, angle)] = synth.fold(sheet, frames=2).driven.items()
    motion = synth.fold(sheet, drive={joint: float(np.copysign(pi, angle))})
    assert motion.resting.orders == 0
    assert motion.crossing[-1] == len(motion.path.angles) - 1
    assert [event.kind for event in motion.path.events].count("collision") == 1


def strip_over_its_crease():
    """A strip of panels 2, 1 and 1 long, the first folded over the second: it reaches over the third, still flat."""
    places = tuple((x, y, 0.0) for y in (0.0, 1.0) for x in (2.0, 0.0, 1.0, 2.0))
    faces = ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6))
    return Sheet(8, ((1, 5), (2, 6)), "VU", faces, places, fold_angles=(pi, 0.0))


def test_a_wrong_order_is_a_collision():
    """The third panel would turn up through the first, which touches its plane but is on no two sides of it."""
    up = synth.fold(strip_over_its_crease(), drive={1: RIGHT}, frames=4)
    assert up.crossing == (0, 1, 2, 3, 4)
    [event] = [event for event in up.path.events if event.kind == "collision"]
    assert event.panels == (0, 1)
    assert up.resting.orders == 0
    stopped = synth.fold(strip_over_its_crease(), drive={1: RIGHT}, frames=4, collisions=True)
    assert "panels pass through each other at the start" in stopped.path.stopped
    assert stopped.crossing == ()
    down = synth.fold(strip_over_its_crease(), drive={1: -pi}, frames=4, collisions=True)
    assert (down.crossing, down.path.stopped, down.resting.orders) == ((), "", 1)


@pytest.mark.parametrize(("letters", "orders"), [("VV", 1), ("MM", 1), ("UU", 2), ("VM", 0)])
def test_a_map_folded_half_and_then_flat(letters, orders):
    """2 x 2, its columns closed: the rows follow. Without letters, either column can be on top."""
    sheet = half_folded_map(2, [RIGHT], letters)
    motion = synth.fold(sheet, drive={2: pi}, frames=4)
    assert motion.resting.orders == orders
    assert motion.resting.planes == ((0, 1, 2, 3),)
    assert motion.crossing == (() if orders else (0, 1, 2, 3, 4))


def test_flaps_that_close_one_after_the_other():
    """The flap that comes last lies on top; together they would enter each other at the corner."""
    half = box_with_flaps((0.45, 0.45, 0.45, 0.45), closed=-0.2)
    at = synth.analysis.moving.configuration_of(half)
    hinges = {joint for joint, (a, b) in at.mechanism.hinges.items() if min(a, b) >= 4}
    first, second = sorted(hinges)[:2]
    closed = at.at(motion_to(half, {first: -RIGHT, second: -0.9 * RIGHT}).path.angles[-1])
    assert layers_at(closed).stacked is None
    last = motion_to(closed, {second: -RIGHT})
    assert last.resting.orders == 1
    assert not last.crossing
    assert layers_at(last.frames()[-1]).orders == 2  # of themselves they could lie either way


def motion_to(sheet, drive):
    return synth.move(sheet, drive=drive, frames=4)


def test_command_on_frames(tmp_path):
    """A frame that is folded: its orders, one written with faceOrders, and read again."""
    path = tmp_path / "half.fold"
    write(half_folded_map(3, [RIGHT]), path)
    told = json.loads(run("layers", path, "--json").stdout)
    assert told["orders"] == 6
    assert sorted(len(plane["panels"]) for plane in told["planes"]) == [3, 3]
    run("layers", path, "--order", "4", "-o", tmp_path / "ordered.fold")
    rows = read_face_orders(tmp_path / "ordered.fold")
    answer = layers_at(tmp_path / "ordered.fold")
    assert rows == answer.order(4).face_orders()
    assert len(rows) == 6
    nearest, unmet = answer.nearest(wishes_of(answer, rows))
    assert (nearest.stacks, unmet) == (answer.order(4).stacks, ())
    assert "not met" not in run("layers", tmp_path / "ordered.fold", "--face-orders").stdout
    f, g, side = rows[0]
    document = json.loads((tmp_path / "ordered.fold").read_text())
    document["faceOrders"][0] = [f, g, -side]
    (tmp_path / "wrong.fold").write_text(json.dumps(document))
    assert "wish not met" in run("layers", tmp_path / "wrong.fold", "--face-orders").stdout
    assert "take a pattern" in run("layers", path, "--fix", code=2).stderr
    assert "as .fold" in run("layers", path, "-o", tmp_path / "x.svg", code=2).stderr
    write(half_folded_map(2, [RIGHT], "VM"), tmp_path / "wrong.fold", force=True)
    assert "Panels pass through each other" in run("layers", tmp_path / "wrong.fold", code=1).stdout


def test_command_on_a_frame_that_is_folded_flat(tmp_path):
    """What `synth layers -o` writes: the pattern, and a frame of it folded flat with its order."""
    write(unassigned_map(2, 2), tmp_path / "map.fold")
    run("layers", tmp_path / "map.fold", "--order", "3", "-o", tmp_path / "folded.fold")
    told = json.loads(run("layers", tmp_path / "folded.fold", "--frame", "1", "--face-orders", "--json").stdout)
    assert told["orders"] == 8
    assert told["unmet"] == []
