"""Crease patterns as DXF: layers and colours, shapes, what is left out; and what other people's code makes of ours."""

from math import atan2, cos, hypot, pi, radians, sin, tan

import numpy as np
import pytest
from commands import run

from graphs.answer.mobility import counts_and_ranks
from graphs.errors import FileError
from graphs.files.formats import read, write

SQUARE = [(0, 0), (10, 0), (10, 10), (0, 10)]


def record(name, *groups):
    return "".join(f"{code}\n{value}\n" for code, value in ((0, name), *groups))


def line(start, end, *groups):
    return record("LINE", *groups, (10, start[0]), (20, start[1]), (11, end[0]), (21, end[1]))


def outline(*groups, name="LWPOLYLINE"):
    return record(name, *groups, (70, 1), *((code + 10 * k, at[k]) for at in SQUARE for code in (10,) for k in (0, 1)))


def drawing(*entities, layers=()):
    tables = "".join(record("LAYER", (2, name), *groups) for name, *groups in layers)
    sections = [("TABLES", tables), ("ENTITIES", "".join(entities))]
    return "".join(record("SECTION", (2, name)) + held + record("ENDSEC") for name, held in sections) + record("EOF")


def sheet_of(text, folder):
    (folder / "a.dxf").write_text(text, encoding="utf-8")
    return read(folder / "a.dxf")


@pytest.mark.parametrize(
    ("groups", "letter"),
    [
        ([(8, "Mountain")], "M"),
        ([(8, "VALLEY"), (62, 1)], "V"),  # a name says more than a colour
        ([(8, "score")], "U"),
        ([(8, "0"), (62, 1)], "M"),
        ([(8, "0"), (62, 5)], "V"),
        ([(8, "red")], "M"),  # by the colour of the layer
        ([(8, "red"), (62, 256)], "M"),
        ([(8, "red"), (62, 2)], "F"),
        ([(8, "0"), (420, 0x1010F0)], "V"),
    ],
    ids=str,
)
def test_what_a_line_is_is_told_by_its_layer_or_else_its_colour(groups, letter, tmp_path):
    text = drawing(outline((8, "CUT")), line((0, 0), (10, 10), *groups), layers=[("red", (62, 1))])
    sheet = sheet_of(text, tmp_path)
    assert sorted(sheet.assignments) == sorted("CCCC" + letter)
    assert len(sheet.faces) == 2


@pytest.mark.parametrize(
    ("entity", "told"),
    [
        (line((0, 10), (10, 0), (62, 4)), "1 LINE of colour 4 on layer 0"),
        (line((0, 10), (10, 0), (6, "DASHED")), "1 dashed LINE of colour 7 on layer 0"),
        (line((0, 10), (10, 0), (8, "off")), "1 LINE of colour -7 on layer off"),
        (line((0, 10), (10, 0), (67, 1), (62, 1)), "1 LINE of colour 1 on layer 0"),
        (record("INSERT", (2, "A")), "1 INSERT"),
        (record("ARC", (230, -1)), "1 ARC"),
        (record("POLYLINE", (70, 16)) + record("VERTEX", (10, 0), (20, 0)) + record("SEQEND"), "1 POLYLINE"),
    ],
    ids=lambda value: value if isinstance(value, str) and value[0] == "1" else "",
)
def test_what_is_not_understood_is_left_out_and_told(entity, told, tmp_path):
    sheet = sheet_of(drawing(outline(), line((0, 0), (10, 10), (62, 1)), entity, layers=[("off", (62, -7))]), tmp_path)
    assert sorted(sheet.assignments) == sorted("BBBBM")
    assert sheet.repairs[-1].endswith(told)


def test_polylines_of_vertices_are_read_and_closed(tmp_path):
    corners = "".join(record("VERTEX", (10, x), (20, y)) for x, y in SQUARE)
    sheet = sheet_of(drawing(record("POLYLINE", (70, 1)) + corners + record("SEQEND")), tmp_path)
    assert (sheet.assignments, len(sheet.faces)) == ("BBBB", 1)


@pytest.mark.parametrize("turn", [pi / 3, pi, 1.7 * pi, -pi / 2])
def test_bulges_are_arcs(turn, tmp_path):
    """Points of the arc lie on a circle, at equal steps of the angle that the bulge says."""
    start, end = np.array((2.0, 1.0)), np.array((5.0, 7.0))
    ends = [(10, start[0]), (20, start[1]), (42, tan(turn / 4)), (10, end[0]), (20, end[1]), (42, 0)]
    sheet = sheet_of(drawing(record("LWPOLYLINE", (70, 1), *ends), line(start, end)), tmp_path)
    chord = end - start
    middle = (start + end) / 2 + np.array((-chord[1], chord[0])) / (2 * tan(turn / 2))
    arms = np.array(sheet.coordinates) - middle
    radius = hypot(*chord) / 2 / abs(sin(turn / 2))
    np.testing.assert_allclose(np.hypot(*arms.T), radius, rtol=1e-12)
    from_start = [(atan2(y, x) - atan2(*(start - middle)[::-1])) * np.sign(turn) % (2 * pi) for x, y in arms]
    steps = np.sort((np.array(from_start) + 1e-9) % (2 * pi))
    np.testing.assert_allclose(steps, np.linspace(0, abs(turn), 9), atol=1e-8)


def test_arcs_and_circles_are_turned_counter_clockwise(tmp_path):
    arc = record("ARC", (10, 3), (20, 4), (40, 5), (50, 350), (51, 80))
    ends = [(3 + 5 * cos(radians(angle)), 4 + 5 * sin(radians(angle))) for angle in (350, 80)]
    sheet = sheet_of(drawing(arc, line(*ends)), tmp_path)
    arms = np.array(sheet.coordinates) - (3, 4)
    assert len(arms) == 9
    np.testing.assert_allclose(np.hypot(*arms.T), 5, rtol=1e-12)
    assert min(x for x, _ in arms) > 0
    circle = sheet_of(drawing(record("CIRCLE", (10, 3), (20, 4), (40, 5))), tmp_path)
    assert (circle.vertices, len(circle.faces)) == (32, 1)


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("LINE\n", "line 1: 'LINE'; expected a group code"),
        ("0\nSECTION\n2\n", "line 3: a group code without a value"),
        ("0\nSECTION\n2\nENTITIES\n0\nENDSEC\n", "does not end with EOF"),
        (drawing(line((0, 0), ("x", 0))), "LINE at line 11: group 11 is 'x'; expected a number"),
        (drawing(line((0, 0), ("1e999", 0))), "not finite, or too large"),
        (drawing(record("LINE", (10, 0))), "no group 20"),
        (drawing(line((0, 0), (1, 0), (30, 2))), "a point at height 2"),
        (drawing(line((0, 0), (1, 0), (62, "red"))), "group 62 is 'red'; expected a whole number"),
        (drawing(line((0, 0), (1, 0), (62, 1))), "no border among 1 line"),
        (drawing(record("TEXT")), "no line of any length; 1 shape with strokes not understood left out: 1 TEXT"),
    ],
)
def test_broken_files_are_told_of_in_a_line(text, found, tmp_path):
    with pytest.raises(FileError) as caught:
        sheet_of(text, tmp_path)
    assert found in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_template_is_read_back_as_the_mechanism_it_is_of(data, tmp_path):
    bird = data / "patterns" / "bird-base.fold"
    run("template", bird, "--size", 150, "-o", tmp_path / "a.dxf")
    given, again = counts_and_ranks(read(bird)).to_json(), counts_and_ranks(read(tmp_path / "a.dxf")).to_json()
    for key in ("class", "links", "joints", "loops", "centres", "mobility"):
        assert again[key] == given[key]


def test_other_peoples_code_reads_what_is_written_without_a_fault(data, tmp_path):
    ezdxf = pytest.importorskip("ezdxf")
    sheet = read(data / "patterns" / "bird-base.fold")
    write(sheet, tmp_path / "a.dxf")
    drawing_of_theirs = ezdxf.readfile(tmp_path / "a.dxf")
    auditor = drawing_of_theirs.audit()
    assert not auditor.errors
    assert not auditor.fixes
    lines = list(drawing_of_theirs.modelspace().query("LINE"))
    assert [(one.dxf.start.x, one.dxf.start.y) for one in lines] == [
        tuple(sheet.coordinates[a][:2]) for a, _ in sheet.edges
    ]


@pytest.mark.parametrize("version", ["R12", "R2010"])
def test_what_other_peoples_code_writes_is_read(version, tmp_path):
    ezdxf = pytest.importorskip("ezdxf")
    theirs = ezdxf.new(version)
    space = theirs.modelspace()
    theirs.layers.add("Valley", color=3)
    space.add_polyline2d(SQUARE, close=True) if version == "R12" else space.add_lwpolyline(SQUARE, close=True)
    space.add_line((0, 0), (10, 10), dxfattribs={"layer": "Valley"})
    space.add_line((0, 10), (10, 0), dxfattribs={"color": 1})
    theirs.saveas(tmp_path / "a.dxf")
    sheet = read(tmp_path / "a.dxf")
    assert sorted(sheet.assignments) == sorted("BBBBVVMM")


def test_a_group_code_has_no_control_characters(tmp_path):
    path = tmp_path / "a.dxf"
    path.write_bytes(b"0\nSECTION\n6\x1e\nDASHED\n0\nEOF\n")
    with pytest.raises(FileError, match=r"line 3: '6.*expected a group code of DXF"):
        read(path)
