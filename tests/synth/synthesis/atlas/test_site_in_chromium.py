"""A site of an atlas in Chromium, from files, without a network."""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from sites import write_site

from synth.making.viewer.building import BUILT
from synth.synthesis.atlas.atlas_file import open_atlas
from synth.synthesis.atlas.building import AtlasPlan, build_atlas
from synth.synthesis.atlas.site_pages import SEARCHED, data_script

pytestmark = pytest.mark.web

sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
expect = sync_api.expect

MANY = 10_000
SOFTWARE = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-sandbox"]


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the first page of a site of types with coordinates."""
    if not (BUILT / "gallery.js").is_file():
        pytest.skip("the scripts of pages were not built")
    folder = tmp_path_factory.mktemp("atlas")
    build_atlas(folder / "atlas.sqlite", AtlasPlan(4, creases=3, orders_of=()))
    return write_site(open_atlas(folder / "atlas.sqlite"), folder / "site")


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    if shutil.which("chromium") is None:
        pytest.skip("Chromium is not installed")
    with sync_api.sync_playwright() as playwright:
        one = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=SOFTWARE)
        yield one
        one.close()


@pytest.fixture
def tab(browser: Any) -> Iterator[Any]:
    """Return a window that notes what is said and asked for."""
    context = browser.new_context(viewport={"width": 1280, "height": 900}, offline=True)
    page = context.new_page()
    page.said, page.asked = [], []
    page.on("console", lambda message: page.said.append(message.text) if message.type == "error" else None)
    page.on("pageerror", lambda error: page.said.append(str(error)))
    page.on("request", lambda request: page.asked.append(request.url))
    yield page
    assert page.said == []
    assert [url for url in page.asked if not url.startswith(("file:", "data:", "blob:"))] == []
    context.close()


def test_search_filter_sort_and_deep_links(site: Path, tab: Any) -> None:
    tab.goto(site.as_uri())
    tab.wait_for_selector(".card")
    every = tab.locator(".status").text_content()
    tab.get_by_label("Search").fill("four-bar")
    assert tab.locator(".status").text_content() == f"2 of {every}"  # the chain, and the spherical four-bar
    assert tab.url.endswith("#text=four-bar")
    tab.goto(f"{site.as_uri()}#kind=scd&realised=yes&sort=-fold_deg")
    expect(tab.locator(".status")).to_have_text(re.compile("^7 of"))
    assert tab.get_by_label("Kind").input_value() == "scd"
    assert tab.locator(".card").count() == 7
    assert tab.evaluate("document.documentElement.scrollWidth <= innerWidth")
    tab.get_by_role("button", name="All types").click()
    expect(tab.locator(".status")).to_have_text(every)


def test_a_type_has_a_page_on_which_it_folds(site: Path, tab: Any) -> None:
    tab.goto(f"{site.as_uri()}#kind=scd&realised=yes")
    tab.locator(".card").first.click()
    tab.wait_for_selector("main[data-ready]", timeout=20_000)
    angle = tab.locator(".sliders input[type=number]").first
    angle.fill("40")
    angle.press("Enter")
    expect(tab.locator(".status")).to_have_text(re.compile("residual"))
    assert tab.get_by_role("link", name="template to print").count() == 1
    tab.get_by_role("link", name="k1:Cr").first.click()
    tab.wait_for_selector("h1:has-text('four-bar chain')")
    assert tab.evaluate("document.querySelector('img.drawing').naturalWidth") > 0


def test_it_fits_a_narrow_window(site: Path, browser: Any) -> None:
    context = browser.new_context(viewport={"width": 390, "height": 844}, offline=True, color_scheme="dark")
    page = context.new_page()
    for place in (site, *sorted((site.parent / "types").glob("*.html"))[:12:4]):
        page.goto(place.as_uri())
        page.wait_for_timeout(300)
        assert page.evaluate("document.documentElement.scrollWidth") <= 390, place
    context.close()


def test_ten_thousand_types(site: Path, tab: Any, tmp_path: Path) -> None:
    atlas = open_atlas(site.parent.parent / "atlas.sqlite")
    rows = atlas.query(columns=SEARCHED).rows
    many = [{**rows[number % len(rows)], "id": f"m1:{number}", "name": None} for number in range(MANY)]
    folder = tmp_path / "many"
    folder.mkdir()
    for name in ("index.html", "gallery.js", "gallery.css"):
        shutil.copy(site.parent / name, folder)
    (folder / "pictures").mkdir()
    picture = next((site.parent / "pictures").iterdir())
    for number in range(1, MANY + 1):
        (folder / "pictures" / f"{number:05d}.svg").hardlink_to(picture)
    (folder / "data.js").write_text(data_script(many, "many", "", 5), encoding="utf-8")
    tab.goto((folder / "index.html").as_uri())
    tab.wait_for_selector(".card")
    there = tab.locator(".card").count()
    assert 0 < there < 1000  # a window of them at a time
    tab.mouse.wheel(0, 20_000)
    expect(tab.locator(".card").nth(there)).to_be_attached()
    tab.get_by_label("Search").fill("m1:9999")
    expect(tab.locator(".card")).to_have_count(1)
