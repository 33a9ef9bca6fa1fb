"""Pages in Chromium, from files, without a network: they load, move, and say what is the case."""

import json
import shutil

import numpy as np
import pytest

import synth
from graphs.files.formats import read
from synth.viewer.building import BUILT
from synth.viewer.pages import page
from synth.viewer.shown import shown_of

pytestmark = pytest.mark.web

sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")

SOFTWARE = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-sandbox"]
HOSTILE = "</script><script>document.title='taken'</script>"
WAIT = 20_000

PANELS = {
    "Miura": lambda data: read(data / "wiener" / "miura-4x4.fold"),
    "bird base": lambda data: read(data / "patterns" / "bird-base.fold"),
    "pop-up": lambda _: synth.generate("slit-array").mechanism,
    "square twist": lambda data: read(data / "wiener" / "square-twist.fold"),
}
OTHERS = {
    "Bennett": lambda data: read(data / "linkages" / "bennett.json"),
    "conical six-bar": lambda data: read(data / "surfaces" / "fig11-stephenson.json"),
}


def chromium(playwright, *options):
    place = shutil.which("chromium")
    return playwright.chromium.launch(executable_path=place, args=[*SOFTWARE, *options])


@pytest.fixture(scope="module")
def playwright():
    if not (BUILT / "page.js").is_file():
        pytest.skip("the script of the page was not built")
    with sync_api.sync_playwright() as one:
        yield one


@pytest.fixture(scope="module")
def browser(playwright):
    if shutil.which("chromium") is None:
        pytest.skip("Chromium is not installed")
    one = chromium(playwright)
    yield one
    one.close()


class Opened:
    """A page in a window of its own, with what it said and asked for."""

    def __init__(self, browser, place, width=1280, scheme="light"):
        self.context = browser.new_context(
            viewport={"width": width, "height": 900}, offline=True, color_scheme=scheme, accept_downloads=True
        )
        self.tab = self.context.new_page()
        self.said, self.asked = [], []
        self.tab.on("console", lambda message: self.said.append(message.text))
        self.tab.on("pageerror", lambda error: self.said.append(str(error)))
        self.tab.on("request", lambda request: self.asked.append(request.url))
        self.tab.goto(place.as_uri())
        self.tab.wait_for_selector("main[data-ready]", timeout=WAIT)

    def to(self, degrees):
        self.tab.get_by_label("Angle, degrees").fill(str(degrees))
        self.tab.get_by_label("Angle, degrees").press("Enter")

    def angle(self):
        return float(self.tab.get_by_label("Angle of the driven joint, degrees").input_value())

    def status(self):
        return self.tab.locator(".status").text_content()

    def closure(self):
        return float(self.status().rsplit(" ", 1)[1])

    def pose(self):
        with self.tab.expect_download() as got:
            self.tab.get_by_role("button", name="FOLD").click()
        return json.loads(got.value.path().read_text())

    def close(self):
        assert [url for url in self.asked if not url.startswith(("file:", "blob:"))] == []
        assert len([url for url in self.asked if url.startswith("file:")]) == 1
        assert self.said == []
        self.context.close()


@pytest.fixture
def opened(browser, tmp_path):
    windows = []

    def open_(*things, name="a", **look):
        place = tmp_path / "page.html"
        place.write_text(
            page([shown_of(thing, f"{name} {n}") for n, thing in enumerate(things)]), encoding="utf-8"
        )
        windows.append(Opened(browser, place, **look))
        return windows[-1]

    yield open_
    for window in windows:
        window.close()


def spans(pose):
    """Distances of all pairs of corners of each face."""
    places = np.array(pose["vertices_coords"])
    return [
        np.linalg.norm(places[face][:, None] - places[face][None], axis=-1).ravel()
        for face in pose["faces_vertices"]
    ]


@pytest.mark.parametrize("name", [*PANELS, *OTHERS])
def test_the_slider_moves_it_and_links_stay_rigid(opened, data, name):
    window = opened((PANELS | OTHERS)[name](data))
    first, before = window.pose(), window.angle()
    window.to(before + (-20 if before > 0 else 20))
    second = window.pose()
    assert abs(window.angle() - before) == pytest.approx(20, abs=1e-6)
    assert window.closure() <= 1e-10
    extent = np.ptp(first["vertices_coords"], axis=0).max()
    moved = np.abs(np.array(second["vertices_coords"]) - first["vertices_coords"]).max()
    assert moved > 0.01 * extent
    for here, there in zip(spans(first), spans(second), strict=True):
        np.testing.assert_allclose(there, here, rtol=0, atol=1e-9 * extent)


def test_what_is_saved_is_read_and_closes(opened, data, tmp_path):
    window = opened(PANELS["bird base"](data))
    window.to(50)
    place = tmp_path / "pose.fold"
    place.write_text(json.dumps(window.pose()))
    answer = synth.mobility(read(place))
    assert "5 freedoms from its pose" in answer.verdict.text


def test_a_panel_that_is_dragged_takes_the_others_with_it(opened, data):
    window = opened(PANELS["Miura"](data))
    box = window.tab.locator(".model canvas").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    before = window.angle()
    window.tab.mouse.move(x, y)
    window.tab.mouse.down()
    for step in range(1, 8):
        window.tab.mouse.move(x + 9 * step, y + 4 * step)
    window.tab.mouse.up()
    assert abs(window.angle() - before) > 1
    assert window.closure() <= 1e-10


def test_it_plays_and_stops(opened, data):
    window = opened(PANELS["bird base"](data))
    before = window.angle()
    window.tab.get_by_role("button", name="Play").click()
    window.tab.wait_for_function(
        "before => Math.abs(document.querySelector('input[type=range]').value - before) > 3",
        arg=before,
        timeout=WAIT,
    )
    window.tab.get_by_role("button", name="Pause").click()
    here = window.angle()
    window.tab.wait_for_timeout(100)
    assert window.angle() == here


def test_a_click_in_the_drawing_tells_the_number(opened, data):
    window = opened(PANELS["square twist"](data))
    window.tab.locator(".pattern path[data-link='4']").click(force=True)
    assert window.tab.locator(".part").text_content().startswith("Link 4")
    window.tab.locator(".pattern path[data-joint='16']").click(force=True)
    assert window.tab.locator(".part").text_content().startswith("Joint 16 between links")


def test_ways_and_mechanisms_are_chosen(opened, data):
    window = opened(PANELS["bird base"](data), OTHERS["Bennett"](data))
    window.tab.get_by_label("Way to move").select_option("0")
    window.to(20)
    assert window.angle() == pytest.approx(20)
    window.tab.get_by_label("Mechanism").select_option("1")
    assert "Moves with 1 freedom" in window.tab.locator(".verdict").text_content()
    assert not window.tab.get_by_label("Way to move").is_visible()


def test_panels_on_each_other_stop_it(opened, data):
    window = opened(PANELS["square twist"](data))
    window.to(180)
    stopped = window.angle()
    assert abs(stopped) <= 180
    assert window.closure() <= 1e-10


def test_what_is_rigid_and_what_has_no_pose_is_said(opened, data):
    window = opened(read(data / "linkages" / "wampler-cube-locked.json"), read(data / "wiener" / "six-bar.json"))
    assert "Nothing moves" in window.status()
    assert window.tab.get_by_role("button", name="Play").is_disabled()
    window.tab.get_by_label("Mechanism").select_option("1")
    assert "has none" in window.tab.locator(".notes").text_content()
    assert window.tab.locator(".pattern svg").is_visible()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_is_cut_off_at_390_pixels(opened, data, scheme):
    window = opened(PANELS["bird base"](data), width=390, scheme=scheme)
    assert window.tab.evaluate("document.documentElement.scrollWidth") <= 390
    box = window.tab.locator(".model canvas").bounding_box()
    assert box["width"] > 300
    assert box["height"] > 250


def test_a_hostile_name_does_nothing(opened, data):
    window = opened(PANELS["square twist"](data), OTHERS["Bennett"](data), name=HOSTILE)
    assert window.tab.title() != "taken"
    assert HOSTILE in window.tab.get_by_label("Mechanism").inner_text()


def test_without_webgl_there_is_a_message_and_the_drawing(playwright, browser, tmp_path, data):
    place = tmp_path / "page.html"
    place.write_text(page([shown_of(PANELS["Miura"](data))]), encoding="utf-8")
    without = chromium(playwright, "--disable-3d-apis")
    try:
        tab = without.new_page()
        tab.goto(place.as_uri())
        tab.wait_for_selector("main[data-ready]", timeout=WAIT)
        assert "no WebGL" in tab.locator(".model").text_content()
        assert tab.locator(".pattern svg").is_visible()
    finally:
        without.close()
