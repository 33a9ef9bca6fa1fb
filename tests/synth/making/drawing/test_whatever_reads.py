"""Whatever reads is drawn: each file that is there, one of each enumeration; valid, equal, soon."""

from pathlib import Path
from time import process_time
from xml.etree import ElementTree

import pytest
from commands import run
from real_patterns import folder_of_patterns

from graphs.errors import FileError, InvariantError, SynthedraError, UnsolvableError
from graphs.files.formats import read_all
from graphs.mechanism.sheet import Sheet
from synth.making.drawing.list_pages import catalogue_entries
from synth.making.drawing.mechanisms.pictures import draw
from synth.making.drawing.scene.writing import svg_text

DATA = Path(__file__).resolve().parents[4] / "data"
FILES = [*sorted(DATA.rglob("*.fold")), *sorted(DATA.rglob("*.json"))]
MANY_PANELS, MANY_SECONDS = 300, 1.0

ENUMERATIONS = {
    "chains": ("chains", "--links", 6, "--dof", 1),
    "sc": ("sc", "--links", 4, "--dof", 1, "--infinite"),
    "hybrids": ("sc", "--links", 7, "--dof", 1, "--spatial", 1),
    "scd": ("scd", "--links", 4, "--dof", 1, "--max-degree", 4),
    "open scd": ("scd", "--links", 4, "--dof", 3, "--max-degree", 3),
    "addenda": ("addenda", "--of", DATA / "wiener" / "watt.json"),
    "orders": ("conical", "--chain", "four-bar"),
    "opposites": ("conical", "--chain", "four-bar", "--ground", 0, "--opposites"),
    "slots": ("conical", "--chain", "four-bar", "--ground", 0, "--slots", 6),
    "samples": ("conical", "--chain", "watt", "--ground", 0, "--sample", 1, "--open", 3),
    "strings": ("strings", "--max-dof", 3),
    "modes": ("strings", "--max-dof", 3, "--modes"),
}
ALWAYS = [("chains", "parquet"), ("strings", "jsonl")]
EVERY = [
    (name, form)
    for name in ENUMERATIONS
    for form in ("jsonl", "sqlite", "parquet", "folder", "g6")
    if (form == "jsonl" or ENUMERATIONS[name][0] != "strings") and (form != "g6" or name == "chains")
]


def mechanisms_of(files):
    for file in files:
        try:
            yield from read_all(file)
        except SynthedraError:
            continue


def assert_drawn_well(files):
    """Each is valid XML, the same when it is read and drawn again, and up to 300 panels takes no second."""
    refused = []
    for entry, again in zip(mechanisms_of(files), mechanisms_of(files), strict=True):
        start = process_time()
        try:
            text = svg_text(draw(entry.mechanism))
        except InvariantError as error:
            refused.append(str(error))
            continue
        spent = process_time() - start
        ElementTree.fromstring(text)
        assert text == svg_text(draw(again.mechanism)), entry.label
        if not isinstance(entry.mechanism, Sheet) or len(entry.mechanism.faces) <= MANY_PANELS:
            assert spent < MANY_SECONDS, (entry.label, spent)
    return refused


def test_every_tenth_file_is_drawn():
    assert assert_drawn_well(FILES[::10]) == []


@pytest.mark.slow
def test_every_file_is_drawn():
    """All that reads, but a sheet with an edge of four faces, which is no mechanism."""
    patterns = sorted(folder_of_patterns().glob("*.*")) if folder_of_patterns().is_dir() else []
    refused = assert_drawn_well([*FILES, *patterns])
    assert all("belongs to 4 faces" in reason for reason in refused)


@pytest.mark.parametrize(
    ("name", "form"),
    [pytest.param(*one, marks=[] if one in ALWAYS else [pytest.mark.slow], id=" ".join(one)) for one in EVERY],
)
def test_what_an_enumeration_wrote_is_drawn(tmp_path, name, form):
    """Every mechanism that was listed, once; and again the same."""
    pytest.importorskip("pyarrow" if form == "parquet" else "xml")
    rows = tmp_path / ("listed" if form == "folder" else f"listed.{form}")
    how = () if ENUMERATIONS[name][0] == "strings" else ("--workers", 1, "--quiet")
    run("enumerate", *ENUMERATIONS[name], *how, "-o", rows)
    for picture in ("a", "b"):
        (tmp_path / picture).mkdir()
        run("draw", rows, "-o", tmp_path / picture / "x.svg")
    pages = sorted((tmp_path / "a").iterdir())
    bold = [
        element.text
        for page in pages
        for element in ElementTree.parse(page).iter()
        if element.get("font-weight") == "bold" and element.get("text-anchor") == "start"
    ]
    listed = sum(1 for _ in catalogue_entries(rows))
    assert listed > 0
    assert sum(text.isdecimal() for text in bold) == listed
    for page in pages:
        assert page.read_bytes() == (tmp_path / "b" / page.name).read_bytes()


@pytest.mark.parametrize("form", ["svg", "pdf"])
def test_of_nothing_there_is_no_picture(tmp_path, form):
    """No blank page that is said to be written."""
    pytest.importorskip({"svg": "xml", "pdf": "reportlab"}[form])
    (tmp_path / "a.jsonl").write_text("")
    result = run("draw", tmp_path / "a.jsonl", "-o", tmp_path / f"a.{form}")
    assert result.output == "nothing to draw\n"
    assert not (tmp_path / f"a.{form}").exists()


def test_parquet_that_is_none(tmp_path, monkeypatch):
    pytest.importorskip("pyarrow")
    place = tmp_path / "a.parquet"
    with pytest.raises(FileError, match="No such file"):
        list(catalogue_entries(place))
    place.write_text("junk")
    with pytest.raises(FileError, match="is not Parquet"):
        list(catalogue_entries(place))
    monkeypatch.setitem(__import__("sys").modules, "pyarrow", None)
    with pytest.raises(UnsolvableError, match=r"pip install 'synthedra\[parquet\]'"):
        list(catalogue_entries(place))
