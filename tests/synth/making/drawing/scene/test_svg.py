"""SVG of scenes: valid, inert, equal for equal scenes."""

import os
import subprocess
import sys
from xml.etree import ElementTree

import pytest

from graphs.errors import InvariantError
from graphs.mechanism.sc import SCGraph
from synth.making.drawing.mechanisms.pictures import draw
from synth.making.drawing.scene.shapes import Disc, Label, Layer, Line, Polygon
from synth.making.drawing.scene.writing import Scene, svg_text


def test_joints_and_links_can_be_found():
    root = ElementTree.fromstring(svg_text(draw(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)]))))
    assert {element.get("data-joint") for element in root.iter()} - {None} == set("0123")
    assert {element.get("data-link") for element in root.iter()} - {None} == set("0123")


@pytest.mark.slow
def test_equal_input_gives_equal_bytes_in_every_process():
    """Neither sets nor hashes of names decide on anything."""
    code = (
        "from synth.making.drawing import draw, svg_text; from graphs.files.formats import read; import sys;"
        "sys.stdout.write(svg_text(draw(read('k1:I??Cfe[wo'))))"
    )
    written = {
        subprocess.run(
            [sys.executable, "-c", code], env={**os.environ, "PYTHONHASHSEED": seed}, capture_output=True, check=True
        ).stdout
        for seed in ("1", "2")
    }
    assert len(written) == 1


def test_papers_differ_in_colours_only():
    scene = draw(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)]))
    light, dark = svg_text(scene), svg_text(scene, paper="dark")
    assert light != dark
    assert [e.tag for e in ElementTree.fromstring(light).iter()] == [e.tag for e in ElementTree.fromstring(dark).iter()]


@pytest.mark.parametrize("shape", [Line([(0, 0), (float("nan"), 1)]), Disc((float("inf"), 0), 1)])
def test_places_that_are_none(shape):
    with pytest.raises(InvariantError, match="coordinate"):
        svg_text(Scene(9, 9, (Layer("a", (shape,)),)))


@pytest.mark.parametrize("shape", [Label((0, 0), "a", colour="no"), Polygon([(0, 0)], "no"), Disc((0, 0), 1, "no")])
def test_colours_that_are_none(shape):
    with pytest.raises(InvariantError, match="unknown colour 'no'"):
        svg_text(Scene(9, 9, (Layer("a", (shape,)),)))


def test_a_paper_that_is_none():
    with pytest.raises(InvariantError, match="unknown paper 'blue'; expected light or dark"):
        svg_text(Scene(9, 9, ()), paper="blue")
