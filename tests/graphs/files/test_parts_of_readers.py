"""Small functions of the readers and writers: names, colours, dashes, ids, records, what files lose."""

from collections import Counter
from dataclasses import replace
from json import loads
from math import pi
from pathlib import Path

import numpy as np
import pytest

from graphs.convert.tracing import Lines
from graphs.errors import FileError
from graphs.files import bare, formats, losses
from graphs.files.patterns import dxf, legend
from graphs.files.patterns.fold import fold_text_of_frames
from graphs.files.patterns.lines import traced_sheet
from graphs.files.patterns.obj import obj_text
from graphs.files.text import Checker
from graphs.joints.linkage import JointedLinkage
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet

TRIANGLE = Sheet(3, (), "", ((0, 1, 2),), ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0)))


def test_names_are_integers_if_all_are_written_as_integers():
    assert bare.names_from_text(["3", "-1"]) == {"3": 3, "-1": -1}
    assert bare.names_from_text(["3", "a"]) == {"3": "3", "a": "a"}
    assert bare.names_from_text(["01", "1"]) == {"01": "01", "1": "1"}
    assert [bare.are_kept(names) for names in ([1, 2], ["1", "2"], [1, "a"])] == [True, False, False]


def test_ids_and_lines_of_files_are_seen():
    assert formats.is_id("k1:Cr")
    assert not formats.is_id("./k1:Cr")
    assert formats.line_named("chains.g6:7") == (Path("chains.g6"), "7")


@pytest.mark.parametrize(
    ("text", "rgb"),
    [
        ("#C1272D", (193, 39, 45)),
        ("hsl(240deg 100% 50% / 0.5)", (0, 0, 255)),
        ("crimson !important", (220, 20, 60)),
        ("url(#gradient)", None),
        ("none", None),
    ],
)
def test_colours_of_css(text, rgb):
    assert legend.rgb_of_css(text) == rgb


@pytest.mark.parametrize(
    ("rgb", "letter"),
    [
        ((230, 10, 10), "M"),
        ((128, 128, 128), None),
        ((255, 165, 0), None),
        ((193, 39, 45), "M"),  # Illustrator
        ((0, 113, 188), "V"),
        ((41, 171, 226), "V"),
        ((55, 52, 53), "B"),  # CorelDRAW
    ],
)
def test_letters_of_colours(rgb, letter):
    assert legend.letter_of_colour(*rgb) == letter


def test_letters_of_names_and_kinds_of_dashes():
    names = ["Mountain_x5F_folds-2", "valley folds", "mountain + valley"]
    assert [legend.letter_of_name(name) for name in names] == ["M", "V", None]
    lengths = [[], [4, 2], [6, 2, 1, 2], [0, 3]]
    assert [legend.dash_of_lengths(row) for row in lengths] == ["solid", "dashed", "dash-dot", "dotted"]
    types = ["Continuous", "HIDDEN2", "ACAD_ISO10W100"]
    assert [legend.dash_of_line_type(name) for name in types] == ["solid", "dashed", "dash-dot"]


def test_a_legend_is_read():
    stated = legend.Legend.of({"M": "#c1272d", "V": ["teal", "dashed #000000"]})
    strokes = [legend.Stroke((0, 128, 128)), legend.Stroke((0, 0, 0), "dashed"), legend.Stroke((0, 0, 0))]
    assert stated.understood(strokes).letters == ("V", "V", "B")
    kinds = Counter({"#ffa500": 3, "dashed #000000": 12})
    described = "15 shapes with strokes not understood left out: 12 dashed #000000, 3 #ffa500"
    assert legend.described_strokes(kinds) == described


def test_numbered_colours_and_records_of_dxf():
    colours = [dxf.rgb_of_number(number) for number in (7, 30, 174, 300)]
    assert colours == [(0, 0, 0), (255, 128, 0), (0, 0, 128), None]
    text = "\n".join(
        ["0", "SECTION", "2", "ENTITIES", "0", "POINT", "8", "CUT", "10", "1.5", "0", "ENDSEC", "0", "EOF"]
    )
    [record] = dxf.records(text, Path("a.dxf"))
    assert (record.section, record.name, record.number(10)) == ("ENTITIES", "POINT", 1.5)
    line = dxf.Record("ENTITIES", "LINE", ((10, "0"), (20, "0"), (11, "3"), (21, "4")), Path("a.dxf"), 1)
    assert [pieces for _, pieces in dxf.drawn_shapes([line])] == [[((0.0, 0.0), (3.0, 4.0))]]


def test_lines_are_written_as_dxf_and_obj():
    text = dxf.dxf_of([dxf.DxfLayer("CUT", 7)], [dxf.DxfLine("CUT", (0.0, 0.0), (30.5, 0.0))])
    assert text.split("ENTITIES")[1].split()[:10] == ["0", "LINE", "8", "CUT", "10", "0.0", "20", "0.0", "30", "0.0"]
    text = dxf.dxf_text(Sheet(2, ((0, 1),), "M", (), ((0.0, 0.0), (1.0, 0.5))))
    assert text.split("ENTITIES")[1].split()[:4] == ["0", "LINE", "8", "MOUNTAIN"]
    assert obj_text(TRIANGLE).splitlines()[-1] == "f 1 2 3"


def test_poses_are_frames_of_fold():
    pose = replace(TRIANGLE, coordinates=((0, 0, 0), (1, 0, 0), (0, 0, 1)))
    [frame] = loads(fold_text_of_frames(TRIANGLE, [pose]))["file_frames"]
    assert frame["vertices_coords"] == [[0, 0, 0], [1, 0, 0], [0, 0, 1]]


def test_a_pattern_without_a_border_is_refused():
    ends = np.array([[[0, 0], [1, 0]], [[1, 0], [0, 1]], [[0, 1], [0, 0]]], dtype=float)
    with pytest.raises(FileError, match=r"a\.cp: no border among 3 lines; expected border lines \(type 1\)"):
        traced_sheet(Lines(ends, "MMM"), Checker(Path("a.cp")), border="border lines (type 1)")


def test_what_files_lose():
    kite = replace(TRIANGLE, edges=((0, 1),), assignments="B", title="Kite")
    assert losses.lost_as_json(kite) == ("the title", "coordinates of 3 vertices", "the shape of 1 face")
    assert losses.lost_as_fold(SCGraph(["A", "B"], [("A", "B")])) == ("names of 2 links",)
    bounds = "which lines bound which of 1 face"
    cut = Sheet(3, ((0, 1), (1, 2)), "CU", ((0, 1, 2),), fold_angles=(None, pi / 2))
    lost = ("1 cut: as borders", "1 unassigned crease: as valleys", "1 fold angle", bounds)
    assert losses.lost_as_cp(cut) == lost
    joined = replace(cut, assignments="JM")
    assert losses.lost_as_dxf(joined) == ("1 fold angle", bounds)
    assert losses.lost_as_svg(joined) == ("1 join: as flat edges", "1 fold angle", bounds)
    ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop(range(4))])
    assert losses.lost_as_nameless_graph(ring) == ("1 loop and its centre",)
    assert losses.lost_as_graphml(JointedLinkage(SCGraph(2, [(0, 1)], ground=0), {})) == ("the ground link",)
