"""Pictures of loop sums: dots where a sum is a multiple of a turn, on its curve; nothing but the project is needed."""

import sys
from itertools import pairwise

import numpy as np
import pytest
from commands import run

from synth.linkages.surfaces.loop_maps import map_to_cones, map_to_cylinders
from synth.making.drawing.scene.shapes import Disc, Line
from synth.making.drawing.sums import draw_loop_sums

MAPS = {
    "spherical": map_to_cones(np.radians([70, 80, 120, 40])),
    "five links": map_to_cones(np.radians([60, 70, 80, 50, 90])),
    "two families": map_to_cones(np.radians([120, 50, 120, 50])),
    "planar": map_to_cylinders([4, 3, 5, 1]),
}


def layer(scene, name):
    return next(layer.shapes for layer in scene.layers if layer.name == name)


def distance(spot, row):
    """How far a point is from a row of straight pieces."""
    found = []
    for a, b in pairwise(np.asarray(row)):
        along = b - a
        part = np.clip((np.asarray(spot) - a) @ along / max(along @ along, 1e-30), 0, 1)
        found.append(np.linalg.norm(a + part * along - spot))
    return min(found)


@pytest.mark.parametrize("name", MAPS)
def test_dots_lie_on_their_curve_and_on_a_turn(name):
    mapped, scene = MAPS[name], draw_loop_sums(MAPS[name])
    dots = [shape for shape in layer(scene, "sums") if isinstance(shape, Disc)]
    lines = [shape for shape in layer(scene, "sums") if isinstance(shape, Line)]
    roots = len(mapped.cylinders) if name == "planar" else len(mapped.flat) + len(mapped.cones)
    assert len(dots) == roots > 0
    for dot in dots:
        (curve,) = [line for line in lines if line.colour == dot.fill]
        assert distance(dot.centre, curve.points) < 0.2
        assert min(abs(dot.centre[1] - turn.points[0][1]) for turn in layer(scene, "turns")) < 1e-6


def test_families_that_lie_on_one_another_are_seen_in_turn():
    lines = [shape for shape in layer(draw_loop_sums(MAPS["two families"]), "sums") if isinstance(shape, Line)]
    one, other = (line for line in lines if line.colour in ("class1", "class2"))
    assert np.allclose(one.points, other.points, atol=1e-6)
    assert (one.dash, other.dash) == ((), (7.0, 7.0))


def test_every_curve_lies_in_the_frame():
    for mapped in MAPS.values():
        scene = draw_loop_sums(mapped)
        places = np.concatenate([np.asarray(line.points) for line in layer(scene, "sums") if isinstance(line, Line)])
        assert (places > 0).all()
        assert (places < (scene.width, scene.height)).all()


def test_svg_needs_no_matplotlib(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    for name in "ab":
        run("cone", "map", "--angles", "70,80,120,40", "-o", tmp_path / f"{name}.svg")
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()
