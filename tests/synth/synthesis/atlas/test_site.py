"""A site of an atlas: its files, and what is in them."""

from __future__ import annotations

import json
import re
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

import pytest
from sites import write_site

import synth.synthesis.atlas.site_pages as writing
from graphs.errors import FileError, UnsolvableError
from graphs.files.formats import read
from synth.synthesis.atlas.atlas_file import Atlas
from synth.synthesis.atlas.site_pages import SEARCHED, data_script, index_page, site_of

HOSTILE = "</script><script>document.title='taken'</script><img src=x onerror=alert(1)>"


@pytest.fixture
def built(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Scripts that are built already; the real ones are tested in a browser."""
    folder = tmp_path / "built"
    folder.mkdir()
    for name in ("page.js", "page.css", "gallery.js", "gallery.css", "LICENSES.txt"):
        (folder / name).write_text(f"/* {name} */")
    monkeypatch.setattr(writing, "BUILT", folder)
    monkeypatch.setattr(writing, "check_built", lambda: None)


class Links(HTMLParser):
    """Where a page points to."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.found: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found += [value for name, value in attrs if name in ("href", "src") and value]


@pytest.mark.usefixtures("built")
def test_every_type_has_its_files_and_every_link_leads_somewhere(real_atlas: Atlas, tmp_path: Path) -> None:
    first = write_site(real_atlas, tmp_path / "site", title="Small")
    folder = first.parent
    rows = real_atlas.query(limit=100).rows
    pages = sorted((folder / "types").glob("*.html"))
    assert len(pages) == len(rows)
    for page in (first, *pages):
        text = page.read_text(encoding="utf-8")
        links = Links(text).found
        assert links
        assert all((page.parent / link).is_file() for link in links), page
        assert "http" not in re.sub(r"http://www\.w3\.org/\S+|charset|http-equiv", "", text)
    for picture in (folder / "pictures").iterdir():
        ElementTree.parse(picture)
    text = (folder / "data.js").read_text(encoding="utf-8")
    data = json.loads(text.removeprefix("window.atlasData = ").removesuffix(";\n"))
    assert data["columns"]["id"] == [row["id"] for row in rows]
    realised = [number for number, row in enumerate(rows, start=1) if row["realised"]]
    assert len(realised) == 7
    for number in realised:
        file = f"{number:0{data['digits']}d}"
        assert read(folder / "types" / f"{file}.fold") is not None
        assert "template" in (folder / "types" / f"{file}.html").read_text(encoding="utf-8")
        assert '"shown":' in (folder / "types" / f"{file}.html").read_text(encoding="utf-8")


@pytest.mark.usefixtures("built")
def test_types_take_little_room(real_atlas: Atlas, tmp_path: Path) -> None:
    folder = write_site(real_atlas, tmp_path / "site").parent
    number = len(real_atlas.query(limit=100))
    sizes = sum(file.stat().st_size for name in ("types", "pictures") for file in (folder / name).iterdir())
    assert sizes < 60_000 * number


@pytest.mark.usefixtures("built")
def test_what_is_there_is_not_replaced_and_nothing_half_written_stays(
    real_atlas: Atlas, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "there").mkdir()
    with pytest.raises(FileError, match="exists already"):
        write_site(real_atlas, tmp_path / "there")

    def failing(*_: object) -> None:
        raise UnsolvableError("stopped here")

    monkeypatch.setattr(writing, "files_of_type", failing)
    with pytest.raises(UnsolvableError, match="stopped here"):
        write_site(real_atlas, tmp_path / "site")
    assert not any("site" in entry.name for entry in tmp_path.iterdir())


@pytest.mark.usefixtures("built")
def test_a_condition_chooses_types(real_atlas: Atlas) -> None:
    site, _ = site_of(real_atlas, "kind = 'sc'")
    assert site.ids == ("m1:ab.ac.bd.cd",)
    with pytest.raises(UnsolvableError, match="no types for a site"):
        site_of(real_atlas, "links > 99")


def test_names_cannot_leave_their_place() -> None:
    assert HOSTILE not in index_page(HOSTILE, HOSTILE)
    row = dict.fromkeys(SEARCHED) | {"id": HOSTILE, "name": HOSTILE}
    script = data_script([row], HOSTILE, HOSTILE, 1)
    assert "<" not in script
    data = json.loads(script.removeprefix("window.atlasData = ").removesuffix(";\n"))
    assert data["columns"]["id"] == [HOSTILE]
