"""Names are hostile: nothing that is printed, drawn or told in an error carries more than printable letters."""

import json
import xml.etree.ElementTree as ET
from io import StringIO

import pytest
from commands import run
from rich.tree import Tree

from graphs.answer.mobility import counts_and_ranks
from graphs.errors import FileError, InvariantError, StoreError, SynthedraError, UnsolvableError, shown
from graphs.files.patterns.svg import svg_text
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.printing import TableBlock, console_for, html_of, plain, plain_lines, text_of

HOSTILE = "\x1b[2J\r\u202egnirts\x07\u2066\x9b31m\ud83d$x^$\n"
LONG = "n" * 2_000_000


def harmless(text):
    return all(letter.isprintable() for line in text.split("\n") for letter in line)


def four_bar(names):
    loops = [{"joints": list(names), "centre": "finite"}]
    joints = [{"id": name, "links": [i, (i + 1) % 4]} for i, name in enumerate(names)]
    return {"format": "synthedra/sc", "version": 1, "links": 4, "joints": joints, "loops": loops}


@pytest.mark.parametrize("clean", [plain, shown])
def test_one_line_of_printable_letters(clean):
    assert harmless(clean(HOSTILE))
    assert "\n" not in clean(HOSTILE)
    assert len(clean(LONG)) == 60
    assert clean("Gelenk ä, 関節").strip("'") == "Gelenk ä, 関節"


def test_lines_stay_lines():
    assert plain_lines("a\nb") == "a\nb"
    assert harmless(plain_lines(HOSTILE))


@pytest.mark.parametrize(
    "error",
    [
        FileError(f"a{HOSTILE}.json", f"key {HOSTILE}", f"found {HOSTILE}", f"other than {HOSTILE}"),
        FileError("a.json", LONG, LONG, LONG),
        InvariantError("rule", f"link {HOSTILE}", HOSTILE),
        InvariantError("rule", LONG),
        UnsolvableError(HOSTILE),
        StoreError(LONG),
    ],
)
def test_errors_are_one_short_line(error):
    assert isinstance(error, SynthedraError)
    assert harmless(str(error))
    assert "\n" not in str(error)
    assert len(str(error)) < 9_000


def test_answers_carry_no_control_characters():
    blocks = [f"note: {HOSTILE}", TableBlock(("name",), [(HOSTILE,)])]
    assert harmless(text_of(blocks))
    assert harmless(html_of(blocks))


def test_the_console_cleans_whatever_is_printed():
    stream = StringIO()
    console_for(stream, 80).print(Tree(HOSTILE), f"[{HOSTILE}]")
    assert harmless(stream.getvalue())


@pytest.mark.parametrize("command", ["addenda", "conical"])
def test_listings_clean_the_names_of_files(tmp_path, command):
    """Names of joints are cells of these tables."""
    path = tmp_path / "four-bar.json"
    path.write_text(json.dumps(four_bar([HOSTILE[:-8], "b\x1b]0;t\x07", "c\rd", "n" * 200_000])))
    words = ["--of", path, "--delta-dof", 1] if command == "addenda" else ["--chain", path, "--ground", 0]
    told = run("enumerate", command, *words).output
    assert harmless(told)
    assert "c\\rd" in told
    assert len(told) < 100_000


def test_formulas_and_reports_clean_names(tmp_path):
    path = tmp_path / "four-bar.json"
    path.write_text(json.dumps(four_bar(["a\x1b[1m", "b", "c", "d"])))
    assert harmless(run("enumerate", "conical", "--chain", path, "--ground", 0, "--formulas").output)
    assert harmless(run("mobility", path).output)
    assert harmless(str(counts_and_ranks(SCGraph(["\x1b", "b"], [("\x1b", "b")]))))


def test_the_title_of_an_svg_is_xml():
    sheet = Sheet(
        3, ((0, 1), (1, 2), (2, 0)), "BBB", ((0, 1, 2),), ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0)), HOSTILE + LONG
    )
    text = svg_text(sheet)
    (title,) = (one.text for one in ET.fromstring(text) if one.tag.endswith("title"))
    assert harmless(title)
    assert len(text) < 3_000


def test_a_key_of_millions_of_letters_is_shortened(tmp_path):
    path = tmp_path / "a.json"
    path.write_text(f'{{"{LONG}": 1, "{LONG}": 2}}')
    assert len(run("mobility", path, code=2).output) < 1_000
