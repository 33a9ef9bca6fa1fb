"""The drawings of the theory pages: each where it is shown, legible, and the same whenever it is made."""

import re
from importlib import import_module
from pathlib import Path
from xml.etree import ElementTree

import pytest

from synth.making.drawing import svg_text
from synth.making.drawing.scene.shapes import SMALL

ROOT = Path(__file__).resolve().parent.parent
THEORY, KEPT = ROOT / "docs" / "theory", ROOT / "docs" / "pictures" / "theory"
WIDEST, LARGEST = 500.0, 60_000
"""Points across; bytes of a file."""
GALLERY = 700_000
"""Bytes of the pictures of the gallery that no other document shows."""
PAGES = sorted(path.stem for path in THEORY.glob("*.md") if path.stem != "index")
QUICK = ("edits", "overconstraint", "map-codes", "reduction", "strings", "four-bars", "behaviour", "rounding")


@pytest.fixture
def drawings(monkeypatch):
    """The program that writes them."""
    monkeypatch.syspath_prepend(ROOT / "docs")
    return import_module("drawings.pages")


def test_each_drawing_is_shown_by_its_page(drawings):
    assert {path.stem for path in KEPT.glob("*.svg")} == set(drawings.DRAWINGS) == set(PAGES)
    for page in drawings.DRAWINGS:
        assert f"(../pictures/theory/{page}.svg)" in (THEORY / f"{page}.md").read_text(encoding="utf-8"), page


@pytest.mark.parametrize("page", PAGES)
def test_a_page_shows_its_drawing_near_its_top_and_says_what_is_seen(page):
    head = (THEORY / f"{page}.md").read_text(encoding="utf-8").split("\n\n")[:4]
    said = re.findall(rf"!\[(.+)\]\(\.\./pictures/theory/{page}\.svg\)", "\n".join(head))
    assert [len(words.split()) > 5 for words in said] == [True]


@pytest.mark.parametrize("page", PAGES)
def test_a_drawing_that_is_kept_is_legible_and_not_large(page):
    path = KEPT / f"{page}.svg"
    root = ElementTree.parse(path).getroot()
    assert float(root.get("viewBox").split()[2]) <= WIDEST
    assert path.stat().st_size <= LARGEST
    assert root.findtext("{*}title")
    assert all(float(element.get("font-size")) >= SMALL for element in root.iter("{*}text"))


@pytest.mark.parametrize("page", QUICK)
def test_letters_lie_within_the_picture_and_not_on_one_another(drawings, page):
    scene = drawings.drawing_of(page)
    boxes = [label.box for label in scene.labels()]
    for number, (left, top, right, low) in enumerate(boxes):
        assert min(left, top) > -1.0
        assert right < scene.width + 1.0
        assert low < scene.height + 1.0
        for other_left, other_top, other_right, other_low in boxes[:number]:
            apart = max(other_left - right, left - other_right, other_top - low, top - other_low)
            assert apart > -1.0


@pytest.mark.parametrize("page", QUICK)
def test_a_drawing_is_the_same_each_time_and_what_is_kept_says_the_same(drawings, page):
    """What is kept is compared by words and shapes: last digits of numbers are those of a machine."""
    once, again = (svg_text(drawings.drawing_of(page)) for _ in range(2))
    assert once == again
    made, kept = (ElementTree.fromstring(text) for text in (once, (KEPT / f"{page}.svg").read_text(encoding="utf-8")))
    assert [(one.tag, one.text) for one in made.iter()] == [(one.tag, one.text) for one in kept.iter()]


@pytest.fixture
def gallery(monkeypatch):
    """The program that writes the gallery."""
    monkeypatch.syspath_prepend(ROOT / "docs")
    return import_module("gallery")


def test_the_gallery_has_forty_things_with_their_pictures(gallery):
    assert len(gallery.THINGS) == 40
    assert (ROOT / "docs" / "gallery.md").read_text(encoding="utf-8") == gallery.document()
    places = {thing.place for thing in gallery.THINGS.values()}
    kept = {path.relative_to(gallery.PICTURES).as_posix() for path in (gallery.PICTURES / "gallery").glob("*.svg")}
    assert kept == {place for place in places if place.startswith("gallery/")}
    assert all((gallery.PICTURES / place).is_file() for place in places)
    assert sum((gallery.PICTURES / place).stat().st_size for place in kept) < GALLERY


@pytest.mark.parametrize("name", ["map", "kaleidocycle", "bird-base-template", "laser"])
def test_commands_of_the_gallery_make_what_is_kept(gallery, name):
    thing = gallery.THINGS[name]
    with gallery.beside_data() as folder:
        gallery.make(thing)
        made = ElementTree.fromstring((folder / f"{name}.svg").read_text(encoding="utf-8"))
    kept = ElementTree.parse(gallery.PICTURES / thing.place).getroot()
    assert [(one.tag, one.text) for one in made.iter()] == [(one.tag, one.text) for one in kept.iter()]


@pytest.mark.slow
def test_all_commands_of_the_gallery_run_and_so_do_those_of_pages_and_templates(gallery):
    for thing in gallery.THINGS.values():
        with gallery.beside_data() as folder:
            gallery.make(thing)
            assert (folder / f"{thing.name}.svg").stat().st_size > 1000
            for file, _, words in gallery.files_of(thing):
                gallery.run(words)
                assert (folder / file).stat().st_size > 1000


def test_the_site_leads_from_the_gallery_to_pages_and_templates(gallery):
    source = [gallery.document()]
    gallery.add_links(None, "gallery", source)
    linked = re.findall(r'<a href="gallery/([^"]+)">', source[0])
    assert linked == [file for thing in gallery.THINGS.values() for file, _, _ in gallery.files_of(thing)]
    assert sum(file.endswith(".pdf") for file in linked) >= 20
