"""The drawings of the theory pages: each where it is shown, legible, and the same whenever it is made."""

import re
from importlib import import_module
from pathlib import Path
from xml.etree import ElementTree

import pytest

from synth.drawing.scene.palette import SMALL

ROOT = Path(__file__).resolve().parent.parent
PAGES = ROOT / "docs" / "theory"
DRAWINGS = sorted((ROOT / "docs" / "pictures" / "theory").glob("*.svg"))
WIDEST, LARGEST = 480.0, 60_000
"""Points across; bytes of a file."""
PARTS = ["What a mechanism is", "Mobility", "Motion"]
WITHOUT = {"viewer"}


def pages_of(part):
    """The pages that the index lists in a part."""
    _, after = (PAGES / "index.md").read_text(encoding="utf-8").split(f":caption: {part}\n")
    return set(after.split("```")[0].split()) - WITHOUT


@pytest.fixture
def pages(monkeypatch):
    """The program that writes them."""
    monkeypatch.syspath_prepend(ROOT / "docs")
    return import_module("drawings.pages")


@pytest.mark.parametrize("part", PARTS)
def test_each_page_shows_its_drawing_and_says_what_is_seen(part):
    for page in sorted(pages_of(part)):
        text = (PAGES / f"{page}.md").read_text(encoding="utf-8")
        shown = re.findall(rf"!\[(.+)\]\(\.\./pictures/theory/{page}\.svg\)", text)
        assert len(shown) == 1, page
        assert len(shown[0].split()) > 5, page


def test_each_drawing_is_named_by_its_page(pages):
    assert {path.stem for path in DRAWINGS} == set(pages.DRAWINGS)
    for path in DRAWINGS:
        assert f"(../pictures/theory/{path.name})" in (PAGES / f"{path.stem}.md").read_text(encoding="utf-8"), (
            path.stem
        )


@pytest.mark.parametrize("path", DRAWINGS, ids=lambda path: path.stem)
def test_a_drawing_is_legible_and_not_large(path):
    root = ElementTree.fromstring(path.read_text(encoding="utf-8"))
    assert float(root.get("viewBox").split()[2]) <= WIDEST
    assert path.stat().st_size <= LARGEST
    assert root.findtext("{http://www.w3.org/2000/svg}title"), "no title"
    sizes = [float(element.get("font-size")) for element in root.iter() if element.get("font-size")]
    assert min(sizes, default=SMALL) >= SMALL


@pytest.mark.parametrize("page", ["edits", "overconstraint"])
def test_a_drawing_made_again_is_the_same(pages, monkeypatch, tmp_path, page):
    monkeypatch.setattr(pages, "FOLDER", tmp_path)
    monkeypatch.setattr("sys.argv", ["pages.py", page])
    pages.main()
    made = (tmp_path / f"{page}.svg").read_bytes()
    assert made == (ROOT / "docs" / "pictures" / "theory" / f"{page}.svg").read_bytes()
