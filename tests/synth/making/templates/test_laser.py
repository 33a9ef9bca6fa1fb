"""Templates for laser cutters: what the beam leaves has the stated size, and layers have their colours."""

import re

import pytest
import shapely
from commands import run
from shapely.ops import polygonize

from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read
from graphs.mechanism.sheet import Sheet
from synth.making.drawing.scene.shapes import text_width
from synth.making.templates.hinges import Hinges
from synth.making.templates.laser import with_kerf
from synth.making.templates.template import template_of
from synth.making.templates.writing import write_template

KERF = 0.4


@pytest.fixture(scope="module")
def bird(data):
    return read(data / "patterns" / "bird-base.fold")


def cut_lines(piece):
    return [shapely.LineString([s.start, s.end]) for s in piece.strokes if s.kind == "CUT"]


def outline(piece):
    """The material inside closed cuts, by tracing them."""
    lines = shapely.union_all(cut_lines(piece), grid_size=1e-6)
    parts = [part for part in polygonize(lines.geoms) if part.representative_point().within(piece.covered.buffer(1))]
    kept = [part for part in parts if part.intersection(piece.covered).area > part.area / 2]
    return shapely.union_all(kept)


def frame():
    """A square with a square hole, of four panels."""
    corners = ((0, 0), (3, 0), (3, 3), (0, 3), (1, 1), (2, 1), (2, 2), (1, 2))
    faces = ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
    return Sheet(8, ((0, 4), (1, 5), (2, 6), (3, 7)), "MVMV", faces, corners)


@pytest.mark.parametrize("hinges", [None, Hinges("gap", 8.0), Hinges("offset", 8.0), Hinges("living", 8.0)])
def test_the_beam_leaves_the_stated_size(bird, hinges):
    for sheet in (bird, frame()):
        template = template_of(sheet, size=300, hinges=hinges)
        for before, after in zip(template.pieces, with_kerf(template, KERF).pieces, strict=True):
            wanted, cut = outline(before), outline(after)
            left = cut.difference(shapely.buffer(cut.boundary, KERF / 2, quad_segs=64))
            assert left.symmetric_difference(wanted).area < 2e-3 * KERF * wanted.length
            assert cut.area > wanted.area
            assert len(after.texts) == len(before.texts)
            kinds = [[s for s in piece.strokes if s.kind != "CUT"] for piece in (before, after)]
            assert kinds[0] == kinds[1]


def test_holes_become_smaller():
    piece, wider = (with_kerf(template_of(frame(), size=300), kerf).pieces[0] for kerf in (0.0, KERF))
    holes = [shapely.Polygon(outline(one).interiors[0]).bounds for one in (piece, wider)]
    sides = [high - low for low, _, high, _ in holes]
    assert sides[0] - sides[1] == pytest.approx(KERF)
    assert wider.size[0] - piece.size[0] == pytest.approx(KERF)


def test_what_a_kerf_may_not_be(bird):
    template = template_of(bird, size=300, hinges=Hinges("gap", 2.0))
    with pytest.raises(UnsolvableError, match="wider than the gap"):
        with_kerf(template, 3.0)
    for kerf in (-0.1, 6.0, float("nan")):
        with pytest.raises(InvariantError, match="kerf"):
            with_kerf(template, kerf)


def test_layers_have_the_colours_of_laser_cutters(data, tmp_path):
    bird = data / "patterns" / "bird-base.fold"
    run("template", bird, "--size", 300, "--laser", "--kerf", KERF, "-o", tmp_path / "bird.dxf")
    text = (tmp_path / "bird.dxf").read_text()
    table = dict(re.findall(r"\n2\n(\w+)\n70\n *\d+\n62\n *(\d+)\n", text.replace("\r", "").replace("\n  ", "\n")))
    table.pop("0")
    assert table == {"CUT": "1", "SCORE": "5", "ENGRAVE": "7"}
    numbers = [float(x) for x in re.findall(r"\n1[01]\n([-\d.]+)", text.replace("\n ", "\n").replace("\n ", "\n"))]
    assert max(numbers) - min(numbers) == pytest.approx(300 + KERF)
    run("template", bird, "--size", 300, "--laser", "--hinges", "living", "--hinge-width", 8, "-o", tmp_path / "b.svg")
    svg = (tmp_path / "b.svg").read_text()
    groups = dict(re.findall(r'<g id="(\w+)"[^>]*>(.*?)</g>', svg, re.DOTALL))
    assert set(groups) == {"CUT", "ENGRAVE"}
    assert set(re.findall(r"#[0-9a-f]{6}", groups["CUT"])) == {"#ff0000"}
    assert "dasharray" not in svg
    run("template", bird, "--size", 300, "--laser", "-o", tmp_path / "c.svg")
    svg = (tmp_path / "c.svg").read_text()
    groups = dict(re.findall(r'<g id="(\w+)"[^>]*>(.*?)</g>', svg, re.DOTALL))
    assert set(re.findall(r"#[0-9a-f]{6}", groups["SCORE"])) == {"#0000ff"}
    assert "gauge" not in svg


def extents_of(path):
    """Width and height, millimetres, of the lines of each layer of a DXF or SVG, read as text alone."""
    text = path.read_text()
    points: dict[str, list[tuple[float, float]]] = {}
    if path.suffix == ".dxf":
        codes = [line.strip() for line in text[text.index("ENTITIES") :].splitlines()]
        pairs = list(zip(codes[1::2], codes[2::2], strict=False))
        for place, (code, layer) in enumerate(pairs):
            if code == "8" and pairs[place - 1] == ("0", "LINE"):
                of_line = dict(pairs[place : place + 7])
                ends = [(float(of_line[x]), float(of_line[y])) for x, y in (("10", "20"), ("11", "21"))]
                points.setdefault(layer, []).extend(ends)
    else:
        for layer, group in re.findall(r'<g id="(\w+)"[^>]*>(.*?)</g>', text, re.DOTALL):
            for way in re.findall(r'd="([^"]+)"', group):
                numbers = [float(number) for number in re.findall(r"-?[\d.]+", way)]
                points.setdefault(layer, []).extend(zip(numbers[::2], numbers[1::2], strict=True))
    return {
        layer: tuple(max(values) - min(values) for values in zip(*ends, strict=True)) for layer, ends in points.items()
    }


@pytest.mark.parametrize("suffix", [".dxf", ".svg"])
def test_kerf_and_layers_as_they_are_measured_in_files(data, tmp_path, suffix):
    bird = data / "patterns" / "bird-base.fold"
    for kerf in (0.0, KERF):
        out = tmp_path / f"bird-{kerf}{suffix}"
        run("template", bird, "--size", 300, "--laser", "--kerf", kerf, "-o", out)
        extents = extents_of(out)
        assert set(extents) == {"CUT", "SCORE"}
        assert extents["CUT"] == pytest.approx((300 + kerf, 300 + kerf))
        assert extents["SCORE"] == pytest.approx((300, 300))


def test_no_letter_lies_on_a_cut(bird):
    for hinges in (Hinges("living", 8.0), Hinges("gap", 8.0)):
        (piece,) = template_of(bird, size=300, hinges=hinges).pieces
        cuts = shapely.union_all(cut_lines(piece))
        assert piece.texts
        for text in piece.texts:
            half, (x, y) = text_width(text.words, text.size) / 2, text.at
            assert not shapely.box(x - half, y - text.size / 2, x + half, y + text.size / 2).intersects(cuts)


def test_a_drawing_for_a_laser_is_one_file(bird, tmp_path):
    template = template_of(bird, size=900)
    assert write_template(template, tmp_path / "a.svg", laser=True) == (tmp_path / "a.svg",)
    sizes = re.search(r'width="([\d.]+)mm" height="([\d.]+)mm"', (tmp_path / "a.svg").read_text()).groups()
    assert [float(size) for size in sizes] == pytest.approx([900, 900])
