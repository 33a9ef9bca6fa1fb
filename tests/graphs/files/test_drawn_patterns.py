"""Drawings: .cp, SVG, ORIPA; what makes no pattern, and strokes that are not understood."""

from collections import Counter

import pytest
from oripa import opx_text

from graphs.convert.duality import mechanism_of_sheet
from graphs.errors import FileError
from graphs.files.formats import read

BORDER = ((0, 0, 1, 0), (1, 0, 1, 1), (1, 1, 0, 1), (0, 1, 0, 0))
CROSS = ((0, 0, 1, 1), (0, 1, 1, 0))


def cp(path, *kinds_and_lines):
    rows = [f"{kind} {' '.join(map(str, line))}" for kind, lines in kinds_and_lines for line in lines]
    path.write_text("\n".join(rows), encoding="utf-8")
    return path


def svg(path, *strokes_and_lines):
    rows = [
        f'<line x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}" {stroke}/>'
        for stroke, lines in strokes_and_lines
        for x1, y1, x2, y2 in lines
    ]
    text = f'<svg xmlns="http://www.w3.org/2000/svg">{"".join(rows)}</svg>'
    path.write_text(text, encoding="utf-8")
    return path


BLACK, RED = 'stroke="#000"', 'stroke="#f00"'
NO_PATTERNS = {
    "no border": (((2, BORDER), (3, CROSS)), "no border among 6 lines; expected border lines"),
    "open border": (((1, BORDER[:3]),), "3 lines enclose no face; expected a closed border"),
    "all black": (((1, BORDER), (1, CROSS)), "4 faces and no crease; expected mountains or valleys"),
    "nothing left": (
        ((1, BORDER), (2, [(0.2, 0.2, 0.8, 0.8), (0.3, 0.2, 0.5, 0.3)])),
        "none of 2 crease lines lies between two faces; expected creases that reach the border",
    ),
}


@pytest.mark.parametrize("name", NO_PATTERNS)
def test_what_makes_no_pattern_is_bad_input(name, tmp_path):
    drawn, message = NO_PATTERNS[name]
    colour = {1: BLACK, 2: RED, 3: 'stroke="#00f"'}
    files = [
        cp(tmp_path / "a.cp", *drawn),
        svg(tmp_path / "a.svg", *((colour[kind], lines) for kind, lines in drawn)),
        tmp_path / "a.opx",
    ]
    files[2].write_text(opx_text((kind, *line) for kind, lines in drawn for line in lines), encoding="utf-8")
    for file in files:
        with pytest.raises(FileError) as error:
            read(file)
        assert message in str(error.value)


def test_a_border_with_nothing_in_it_is_one_panel(tmp_path):
    for flat in ((), ((4, CROSS),)):
        mechanism = mechanism_of_sheet(read(cp(tmp_path / "a.cp", (1, BORDER), *flat)))
        assert (len(mechanism.sc), len(mechanism.sc.joints)) == (1, 0)
        assert "one panel: no crease joins it to another" in mechanism.warnings


def test_fold_without_faces_and_creases_that_join_none_is_refused(tmp_path):
    path = tmp_path / "a.fold"
    path.write_text(
        '{"vertices_coords": [[0,0],[1,0],[0,1]], "edges_vertices": [[0,1],[1,2],[2,0]], '
        '"edges_assignment": ["M","M","V"]}',
        encoding="utf-8",
    )
    with pytest.raises(FileError, match="none of 3 crease line"):
        read(path)
    path.write_text(path.read_text().replace('"M"', "null").replace('"V"', '"U"'), encoding="utf-8")
    assert len(read(path).faces) == 1  # unassigned lines may be the border


def test_strokes_that_are_not_understood_are_told_by_kind_and_number(tmp_path):
    dashed = f'{BLACK} stroke-dasharray="4 1"'
    file = svg(
        tmp_path / "a.svg",
        (BLACK, BORDER),
        (f'{RED} stroke-dasharray="4 1"', CROSS[:1]),
        (f'{RED} stroke-dasharray="none"', CROSS[1:]),
        (dashed, [(0, 0.5, 1, 0.5), (0.5, 0, 0.5, 1)]),
        ('stroke="orange"', [(0, 0.25, 1, 0.25)]),
        ('stroke="#400000"', [(0, 0.75, 1, 0.75)]),
    )
    sheet = read(file)
    told = "4 shapes with strokes not understood left out: 2 dashed #000000, 1 #ffa500, 1 #400000"
    assert told in sheet.repairs
    assert (len(sheet.faces), Counter(sheet.assignments)) == (4, {"B": 4, "M": 4})
    svg(file, (BLACK, BORDER), (dashed, CROSS))
    assert len(read(file).faces) == 1
    svg(file, (dashed, BORDER), ('stroke="orange"', CROSS))
    with pytest.raises(FileError, match=r"6 of 6 lines have strokes that are not understood: 4 dashed #000000, 2 #ffa"):
        read(file)
    svg(file, (dashed, BORDER), (RED, CROSS * 2))
    with pytest.raises(FileError, match=r"no border among 4 lines; 4 shape.* 4 dashed #000000"):
        read(file)


@pytest.mark.parametrize("new", [False, True])
def test_oripa_files(new, tmp_path):
    lines = [(1, *line) for line in BORDER] + [(2, *CROSS[0]), (3, 0, 1, 0.5, 0.5), (4, 0.5, 0.5, 1, 0)]
    lines += [(0, 0, 0.5, 0.5, 0.5)]
    (tmp_path / "a.opx").write_text(opx_text(lines, new=new), encoding="utf-8")
    sheet = read(tmp_path / "a.opx")
    assert Counter(sheet.assignments) == {"B": 5, "M": 2, "V": 1, "U": 1, "F": 1}
    assert {sheet.coordinates[v] for edge in sheet.edges for v in edge} == {
        (0, 0), (1, 0), (1, 1), (0, 1), (0, 0.5), (0.5, 0.5)
    }  # fmt: skip
    mechanism = mechanism_of_sheet(sheet)
    assert (len(mechanism.sc), len(mechanism.sc.joints), mechanism.interior_vertices) == (4, 4, 1)
