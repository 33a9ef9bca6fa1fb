"""Workbenches that end with the test."""

import shutil

import pytest
from workbench import SOFTWARE, Served

from synth.making.viewer.building import BUILT


@pytest.fixture
def served():
    pytest.importorskip("uvicorn", reason="the workbench is not installed")
    if not (BUILT / "page.js").is_file():
        pytest.skip("the script of the page was not built")
    made = []

    def serve(*files):
        made.append(Served(*files))
        return made[-1]

    yield serve
    for one in made:
        one.end()


@pytest.fixture
def tab():
    sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    place = shutil.which("chromium")
    if place is None:
        pytest.skip("Chromium is not installed")
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=place, args=SOFTWARE)
        yield browser.new_page()
        browser.close()
