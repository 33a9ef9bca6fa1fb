"""Pictures of every kind of mechanism: what is in them."""

from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from commands import run
from sizes import slow

from graphs.convert.panels import scd_from_panels
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.reduce import reduce
from synth.making.drawing.mechanisms.creases import COLOURINGS
from synth.making.drawing.mechanisms.pictures import KINDS, draw
from synth.making.drawing.scene.shapes import Disc, Line
from synth.making.drawing.scene.writing import svg_text
from synth.making.drawing.space.panels import drawn_order

DATA = Path(__file__).resolve().parents[5] / "data"


def drawn(mechanism, *kinds, **look):
    """A picture as an element, after it was found to be XML."""
    return ElementTree.fromstring(svg_text(draw(mechanism, *kinds, **look)))


def values(root, key):
    return {element.get(key) for element in root.iter()} - {None}


def test_numbers_of_messages_are_found_in_a_crease_pattern():
    sheet = read(DATA / "patterns" / "bird-base.fold")
    from graphs.convert.duality import mechanism_of_sheet

    sc = mechanism_of_sheet(sheet).sc
    root = drawn(sheet)
    assert values(root, "data-joint") == set(map(str, sc.joints))
    assert values(root, "data-link") == set(map(str, sc.nodes))
    texts = {element.text for element in root.iter() if element.tag.endswith("text")}
    assert set(map(str, [*sc.joints, *sc.nodes])) <= texts


def test_letters_differ_in_colour_and_dash():
    """Mountains, valleys, what is unassigned, and borders, in this order; a reader without colours tells them apart."""
    places = ((0, 0), (1, 0), (1, 1), (0, 1), (0.4, 0.5))
    edges = ((0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4))
    sheet = Sheet(5, edges, "BBBBMVUM", ((0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)), places)
    scene = draw(sheet, numbers=False)
    lines = {shape.data: shape for shape in scene.shapes() if isinstance(shape, Line)}
    looks = [(lines[("joint", str(joint)),].colour, bool(lines[("joint", str(joint)),].dash)) for joint in (4, 5, 6)]
    assert [colour for colour, _ in looks] == ["mountain", "valley", "unassigned"]
    assert [dashed for _, dashed in looks] == [False, True, True]
    assert lines[("joint", "5"),].dash != lines[("joint", "6"),].dash


def test_dashes_of_cuts_shrink_as_those_of_creases_do():
    """On a dense pattern a valley and a cut of one length have about as many dashes as on one that is not."""
    shrunk = {}
    for wide in (2, 40):
        places = tuple((x, y) for y in (0, 1) for x in range(wide + 1))
        faces = tuple((i, i + 1, i + wide + 2, i + wide + 1) for i in range(wide))
        edges = [(i, i + wide + 1) for i in range(1, wide)]
        scene = draw(Sheet(len(places), (*edges[1:], edges[0]), "V" * (wide - 2) + "C", faces, places), numbers=False)
        dashes = [shape.dash for shape in scene.shapes() if isinstance(shape, Line) and shape.colour == "cut"]
        shrunk[wide] = dashes[0][0]
    assert shrunk[40] == pytest.approx(0.6 * shrunk[2])


def test_creases_by_centre_class_have_the_colours_of_their_ends():
    sheet = read(DATA / "patterns" / "bird-base.fold")
    scene = draw(sheet, colour="centres", graph=True)
    creases = next(layer for layer in scene.layers if layer.name == "creases")
    colours = {shape.colour for shape in creases.shapes if shape.data}
    assert {f"class{i}" for i in range(5)} <= colours
    assert any(layer.name == "graph" for layer in scene.layers)


def test_numbers_of_links_and_joints_have_room_beside_each_other():
    """In a grid of panels the number of a panel does not touch those of the creases to its left and right."""
    wide = 14
    places = tuple((x, 1.2 * y) for y in range(wide + 1) for x in range(wide + 1))
    first = [i for i in range(wide * (wide + 1)) if i % (wide + 1) < wide]
    faces = tuple((i, i + 1, i + wide + 2, i + wide + 1) for i in first)
    labels = draw(Sheet(len(places), (), "", faces, places)).layers[2].shapes
    assert len(labels) == wide**2 + 2 * wide * (wide - 1)
    rows = sorted((round(label.at[1], 3), label.box) for label in labels)
    gaps = [after[0] - before[2] for (high, before), (low, after) in pairwise(rows) if high == low]
    assert min(gaps) > 0.2 * labels[0].size


def test_signs_of_centres():
    """A circled dot, a lying eight, nothing."""
    joints = [(0, 1), (1, 2), (2, 3), (3, 0)]
    of = {centre: draw(SCGraph(4, joints, [Loop((0, 1, 2, 3), centre)])) for centre in Centre}
    signs = {
        centre: next(layer for layer in scene.layers if layer.name == "centres").shapes for centre, scene in of.items()
    }
    assert [type(shape) for shape in signs[Centre.FINITE]] == [Disc, Disc]
    assert [type(shape) for shape in signs[Centre.INFINITE]] == [Line, Line]
    assert signs[Centre.NONE] == ()


def test_ride_alongs_lie_on_bands():
    """Those that `synth reduce` takes off, and no others; a four-bar has none."""
    fortune_teller = read(DATA / "wiener" / "fortune-teller.json")
    steps = reduce(fortune_teller).steps
    scene = draw(fortune_teller)
    below, joints, discs = (
        next(layer for layer in scene.layers if layer.name == name).shapes
        for name in ("ride-alongs", "joints", "links")
    )
    rows = {tuple(shape.points) for shape in below if isinstance(shape, Line)}
    off = {dict(shape.data)["joint"] for shape in joints if tuple(shape.points) in rows}
    assert off == {str(joint) for step in steps for joint in step.joints}
    spots = {shape.centre for shape in below if isinstance(shape, Disc)}
    taken = {dict(shape.data)["link"] for shape in discs if isinstance(shape, Disc) and shape.centre in spots}
    assert taken == {str(link) for step in steps for link in step.removed}
    assert any("4 ride-alongs (yellow band); without, 8 links stay" in label.text for label in scene.labels())
    assert draw(read("k1:Cr"), "graph").layers[0].shapes == ()


def test_open_edges_are_stubs():
    scd = read(DATA / "wiener" / "fortune-teller.json")
    joints = next(layer for layer in draw(scd).layers if layer.name == "joints").shapes
    stubs = [shape for shape in joints if dict(shape.data).get("link") is not None]
    assert len(stubs) == scd.counts.open_edges > 0


@pytest.mark.parametrize("links", [4, 5, 9])
@pytest.mark.parametrize("turn", [1, -1])
def test_open_edges_of_a_ring_are_outside_the_face_with_its_centre(links, turn):
    """Both faces have the same joints: only the way round tells which is outside."""
    panels = [(0, one + 1, (one + 1) % links + 1)[::turn] for one in range(links)]
    layers = draw(scd_from_panels(panels)).layers
    stubs = next(layer for layer in layers if layer.name == "joints").shapes[:links]
    near, far = np.array([stub.points for stub in stubs]).swapaxes(0, 1)
    middle = near.mean(axis=0)
    assert (np.hypot(*(far - middle).T) > np.hypot(*(near - middle).T)).all()


def test_loops_that_are_no_faces_are_listed():
    said = " ".join(label.text for label in draw(read(DATA / "wiener" / "concentric-loops.json")).labels())
    assert "not a face inside: centre" in said


def test_what_is_in_front_is_drawn_last():
    """Three strips, each over the next: two that overlap are in order wherever that can be."""
    places = np.array(
        [[0, 0], [4, 0], [4, 1], [0, 1], [1, -1], [2, -1], [2, 3], [1, 3], [9, 9], [10, 9], [10, 10], [9, 10]]
    )
    near = np.array([1.0] * 4 + [2.0] * 4 + [-5.0] * 4)
    faces = [(4, 5, 6, 7), (0, 1, 2, 3), (8, 9, 10, 11)]
    order = drawn_order(places.astype(float), near, faces)
    assert order.index(1) < order.index(0)


def test_a_slanted_panel_in_front_though_its_middle_is_behind():
    """Depth is compared where panels overlap, not at their middles."""
    places = np.array([[0, 0], [10, 0], [10, 1], [0, 1], [0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
    near = np.array([5, -20, -20, 5, 1, 1, 1, 1], dtype=float)
    assert drawn_order(places, near, [(0, 1, 2, 3), (4, 5, 6, 7)]) == [1, 0]


@pytest.mark.parametrize("kind", ["pattern", "folded"])
def test_only_sheets_are_patterns(kind):
    with pytest.raises(UnsolvableError, match="requires a crease pattern"):
        draw(read("k1:Cr"), kind)


def test_kinds_and_colourings_that_are_none():
    with pytest.raises(InvariantError, match="unknown kind 'x'; expected pattern, marks, repairs, flat-folded, folded"):
        draw(read("k1:Cr"), "x")
    with pytest.raises(InvariantError, match="unknown colouring 'x'; expected letters"):
        draw(read(DATA / "patterns" / "bird-base.fold"), colour="x")


@pytest.mark.parametrize("look", [{"colour": "verdict"}, {"graph": True}])
def test_colours_of_a_pattern_are_not_left_out_in_silence(look):
    with pytest.raises(UnsolvableError, match="require a picture of kind pattern, not chain"):
        draw(read("k1:Cr"), **look)


def test_a_linkage_on_the_other_surface_is_named():
    with pytest.raises(UnsolvableError, match="lies on a cylinder, not on a cone; try --as cylinder"):
        draw(read(DATA / "surfaces" / "fig10-four-bar.json"), "cone")
    with pytest.raises(UnsolvableError, match="requires a linkage defined by links or angles round a cone"):
        draw(read("k1:Cr"), "cone")


def test_long_captions_are_broken_and_not_cut():
    words = " ".join(f"word{i}" for i in range(30))
    lines = [label.text for label in draw(read("k1:Cr"), caption=words).layers[-1].shapes]
    assert len(lines) > 2
    assert " ".join(lines).startswith(words)


def test_a_linkage_round_a_cone_lies_on_it():
    linkage = read(DATA / "surfaces" / "fig11-stephenson.json")
    scene = draw(linkage, "cone")
    assert {"circle", "cone"} <= {layer.name for layer in scene.layers}
    assert values(drawn(linkage, "cone"), "data-joint") == set(map(str, linkage.chain.joints))
    with pytest.raises(UnsolvableError, match="requires a linkage defined by links or angles round a cone"):
        draw(read("k1:Cr"), "cone")


@pytest.mark.parametrize("name", ["tipparthi", slow("crank-rocker")])
def test_files_of_orientations_are_drawn_as_maps_of_the_sphere(tmp_path, name):
    run("draw", DATA / "orientations" / f"{name}.json", "-o", tmp_path / "a.svg")
    root = ElementTree.parse(tmp_path / "a.svg").getroot()
    assert {"regions", "axes"} <= values(root, "class")
    with pytest.raises(UnsolvableError, match="requires orientations"):
        draw(read("k1:Cr"), "sphere")


def test_the_command_knows_all_kinds(tmp_path):
    from synth.cli.commands import drawing as command

    assert tuple(KINDS) == command._KINDS
    assert COLOURINGS == command._COLOURS


@pytest.mark.parametrize("kind", ["svg", "png", "pdf"])
def test_the_command_writes_equal_files(tmp_path, kind):
    pytest.importorskip({"svg": "xml", "png": "matplotlib", "pdf": "reportlab"}[kind])
    for name in "ab":
        run("draw", "k1:Cr", "-o", tmp_path / f"{name}.{kind}", "--paper", "dark")
    assert (tmp_path / f"a.{kind}").read_bytes() == (tmp_path / f"b.{kind}").read_bytes()
    result = run("draw", "k1:Cr", "-o", tmp_path / f"a.{kind}", code=2)
    assert "exists already" in result.stderr
