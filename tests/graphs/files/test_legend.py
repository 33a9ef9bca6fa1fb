"""What lines of a drawing are: stated, by names of layers and groups, by colours of drawing programs, by dashes."""

from colorsys import hsv_to_rgb

import pytest

from graphs.errors import FileError, InvariantError
from graphs.files.formats import read, read_all
from graphs.files.patterns.legend import Legend, letter_of_colour, rgb_of_css

INKSCAPE = 'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
RED = 'stroke="red"'
BORDER = '<rect width="4" height="4" fill="none" stroke="#000"/>'
ONE, OTHER = '<line x2="4" y2="4" {}/>', '<line x1="4" y2="4" {}/>'


def svg(folder, body):
    path = folder / "a.svg"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" {INKSCAPE}>{body}</svg>', encoding="utf-8")
    return path


def letters(path, **stated):
    """The assignments of the two diagonals, by their directions."""
    sheet = read(path, **stated)
    found = {}
    for (a, b), letter in zip(sheet.edges, sheet.assignments, strict=True):
        (ax, ay), (bx, by) = sheet.coordinates[a], sheet.coordinates[b]
        if ax != bx and ay != by:
            found.setdefault((bx - ax) * (by - ay) < 0, set()).add(letter)  # y points down in SVG
    return "".join("".join(found.get(key, "?")) for key in (True, False))


SWATCHES = {
    "M": "#ed1c24 #c1272d red #da251d #e31e24 crimson firebrick #f44336 #d62728 hsl(355,80%,45%)",
    "V": "#0071bc #29abe2 #2e3192 #1b1464 blue #00aeef #3e4095 navy royalblue rgb(10%,20%,90%) hsl(0.6turn_80%_40%)",
    "B": "black #231f20 #373435 #000 #333 rgb(0,0,0)",
    "C": "#009245 #39b54a lime green #00a859",
    "F": "yellow #fcee21 #fff200",
    "U": "magenta fuchsia #f0f",
    None: "orange #808080 pink #ec008c cyan #f7931e purple #400000 teal white olive",
}


@pytest.mark.parametrize("letter", SWATCHES)
def test_swatches_of_drawing_programs_are_understood(letter):
    for text in SWATCHES[letter].split():
        assert (text, letter_of_colour(*rgb_of_css(text.replace("_", " ")))) == (text, letter)


def test_no_hue_is_two_things_and_reds_are_not_blue():
    """Round the circle of hues at full strength each assignment is one arc, and what lies between is nothing."""
    row = [letter_of_colour(*(round(255 * x) for x in hsv_to_rgb(step / 720, 1.0, 1.0))) for step in range(720)]
    begins = [now for before, now in zip(row[-1:] + row, row, strict=False) if now != before]
    assert sorted(map(str, begins)) == sorted(["None"] * 5 + ["C", "F", "M", "U", "V"])


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        (f'<g stroke="#ED1C24">{ONE.format("")}</g><g style="stroke:#29ABE2">{OTHER.format("")}</g>', "MV"),
        (
            "<style>.st0,.st1{fill:none;stroke:#C1272D;} .st1{stroke:#0071BC}</style>"
            + ONE.format('class="st0"') + OTHER.format('class="st1"'),
            "MV",
        ),
        (ONE.format('stroke="hsl(0deg 80% 40%)"') + OTHER.format('style="stroke: rgb(0 40 250)"'), "MV"),
        (f'<g id="Mountain_x5F_1" stroke="#777">{ONE.format("")}</g>'
         f'<g inkscape:label="Valley folds"><g id="g7">{OTHER.format(RED)}'
         "</g></g>", "MV"),
        (f'<g data-name="cuts">{ONE.format(RED)}</g>'
         + OTHER.format('stroke="blue"'), "CV"),
        (ONE.format('stroke="#000" stroke-dasharray="8 2 1 2"') + OTHER.format('stroke="#222" stroke-dasharray="4,2"'),
         "MV"),
    ],
    ids=["inherited", "classes", "css", "groups", "laser", "yoshizawa"],
)  # fmt: skip
def test_what_lines_are_is_seen(body, expected, tmp_path):
    assert letters(svg(tmp_path, BORDER + body)) == expected


def test_a_name_that_all_lines_have_says_nothing(tmp_path):
    body = BORDER + ONE.format('stroke="red"') + OTHER.format('stroke="blue"')
    assert letters(svg(tmp_path, f'<g id="cut">{body}</g>')) == "MV"


def test_colours_that_are_none_are_no_borders(tmp_path):
    odd = ONE.format('stroke="url(#gradient)"') + OTHER.format('stroke="blue"')
    path = svg(tmp_path, BORDER + odd)
    assert letters(path) == "?V"
    assert read(path).repairs[-1].endswith("left out: 1 stroke url(#gradient)")


def test_what_is_stated_comes_first(tmp_path):
    path = svg(
        tmp_path,
        BORDER
        + f'<g id="Layer_3" stroke="#7a5230">{ONE.format("")}</g>'
        + OTHER.format('stroke="#7a5230" stroke-dasharray="3 1"')
        + '<line x2="4" y1="1" y2="1" stroke="#7a5230" stroke-dasharray="0 3"/>',
    )
    assert letters(path) == "??"  # 3 of 7 lines left out
    assert letters(path, colours={"M": "#7a5230", "V": "dashed #7a5331", "-": "dotted #7a5230"}) == "MV"
    stated = {"colours": {"M": ["#7a5230", "gold"], "V": "dashed", "-": "dotted #7a5230"}}
    assert letters(path, **stated) == "MV"
    assert letters(path, **stated, layers={"U": ["layer_3", "other"]}) == "UV"


def test_a_drawing_most_of_which_is_not_understood_is_refused_with_the_way_out(tmp_path):
    brown = "".join(f'<line x1="{x}" x2="{x}" y2="4" stroke="#7a5230"/>' for x in (1, 2, 3))
    path = svg(tmp_path, f'{BORDER}<path d="M0 1h4M0 2h4M0 3h4" stroke="#123" stroke-dasharray="2"/>{brown}')
    with pytest.raises(FileError) as error:
        read(path)
    assert "6 of 10 lines have strokes that are not understood: 3 #7a5230, 1 dashed #112233" in str(error.value)
    assert "--colour M=#c1272d" in str(error.value)
    assert "\n" not in str(error.value)
    sheet = read(path, colours={"M": "#7a5230", "V": "dashed #112233"})
    assert (len(sheet.faces), set(sheet.assignments)) == (16, {"B", "M", "V"})
    assert read(path, colours={"-": ["#7a5230", "#112233"]}).assignments == "BBBB"
    [entry] = read_all(path, colours={"M": "#7a5230"})
    assert len(entry.mechanism.faces) == 4


def test_what_cannot_be_stated_is_told_of(tmp_path):
    with pytest.raises(InvariantError, match="the assignment 'Q'"):
        Legend.of({"Q": "red"})
    with pytest.raises(InvariantError, match="the look 'reddish'"):
        Legend.of({"M": "reddish"})
    (tmp_path / "a.cp").write_text("1 0 0 1 0\n")
    with pytest.raises(FileError, match=r"no colours or layers; expected an \.svg or \.dxf file"):
        read(tmp_path / "a.cp", colours={"M": "red"})
