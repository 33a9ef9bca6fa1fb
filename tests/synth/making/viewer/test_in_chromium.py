"""Pages in Chromium, from files, without a network: they load, move, and say what is the case."""

import json
import shutil

import numpy as np
import pytest
from folded_sheets import unassigned_map

import synth
from graphs.files.formats import read
from graphs.mechanism.sheet import Sheet
from synth.making.viewer.building import BUILT
from synth.making.viewer.page_data import shown_of
from synth.making.viewer.pages import page

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
    "hybrid": lambda data: synth.realise(read(data / "wiener" / "hybrid-ten-bar.json")).sheet,
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

    def __init__(self, browser, place, width=1280, height=900, scheme="light"):
        self.context = browser.new_context(
            viewport={"width": width, "height": height}, offline=True, color_scheme=scheme, accept_downloads=True
        )
        self.tab = self.context.new_page()
        self.said, self.asked = [], []
        self.tab.on("console", lambda message: self.said.append(message.text))
        self.tab.on("pageerror", lambda error: self.said.append(str(error)))
        self.tab.on("request", lambda request: self.asked.append(request.url))
        self.tab.goto(place.as_uri())
        self.tab.wait_for_selector("main[data-ready]", timeout=WAIT)

    def to(self, degrees, slider=0):
        field = self.tab.locator(".sliders input[type=number]").nth(slider)
        field.fill(str(degrees))
        field.press("Enter")

    def angles(self):
        """Degrees at the sliders, one for each freedom; the last slider is that of the path."""
        sliders = self.tab.locator(".sliders .drive:not(.path) input[type=range]")
        return [float(slider.input_value()) for slider in sliders.all()]

    def angle(self):
        return self.angles()[0]

    def travelled(self):
        return float(self.tab.get_by_label("Along the path").input_value())

    def along(self, degrees):
        """Go to a place along the path."""
        self.tab.get_by_label("Along the path").fill(str(degrees))

    def status(self):
        """The line below the model, once the page is where it was sent: it goes there in parts of a moment each."""
        sync_api.expect(self.tab.locator(".status")).not_to_contain_text("is on its way", timeout=WAIT)
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
        place.write_text(page([shown_of(thing, f"{name} {n}") for n, thing in enumerate(things)]), encoding="utf-8")
        windows.append(Opened(browser, place, **look))
        return windows[-1]

    yield open_
    for window in windows:
        window.close()


def test_sliders_of_five_freedoms_are_in_reach_at_850_pixels(opened, data):
    window = opened(read(data / "patterns" / "bird-base.fold"), height=850)
    sliders = window.tab.locator(".sliders input[type=range]")
    sync_api.expect(sliders).to_have_count(6)  # the path too
    boxes = [one.bounding_box() for one in sliders.all()]
    pane = window.tab.locator(".sliders").bounding_box()
    assert all(box["y"] >= pane["y"] and box["y"] + box["height"] <= pane["y"] + pane["height"] + 1 for box in boxes)
    assert window.tab.get_by_role("button", name="Play").bounding_box()["y"] < 850 - 36


def spans(pose):
    """Distances of all pairs of corners of each face."""
    places = np.array(pose["vertices_coords"])
    return [
        np.linalg.norm(places[face][:, None] - places[face][None], axis=-1).ravel() for face in pose["faces_vertices"]
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
    assert "from this configuration: 5 degrees of freedom" in answer.verdict.text


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
        "before => Math.abs(document.querySelector('.sliders input[type=range]').value - before) > 3",
        arg=before,
        timeout=WAIT,
    )
    window.tab.get_by_role("button", name="Pause").click()
    here = window.angle()
    window.tab.wait_for_timeout(100)
    assert window.angle() == here


def test_there_is_a_slider_for_each_freedom_and_the_others_stay(opened, data):
    window = opened(PANELS["bird base"](data), name="bird base")
    assert len(window.angles()) == 5
    window.to(40)  # the first leaves the flat sheet, and the others with it
    for slider, turn in ((3, 4), (1, 2), (4, -2)):
        before = window.angles()
        degrees = before[slider] + turn
        window.to(degrees, slider)
        after = window.angles()
        assert after[slider] == pytest.approx(degrees, abs=1e-6)
        assert [a for n, a in enumerate(after) if n != slider] == [b for n, b in enumerate(before) if n != slider]
        assert window.closure() <= 1e-10


def test_sliders_pulled_in_another_order_lead_to_the_same_pose(opened, data):
    window, found = opened(PANELS["bird base"](data)), []
    for order in ((1, 3, 4), (4, 1, 3)):
        window.tab.get_by_role("button", name="Reset").click()
        window.to(40)
        begun = window.angles()
        for slider in order:
            window.to(begun[slider] + {1: 2, 3: 4, 4: -0.5}[slider], slider)  # none turns back before
        found.append(window.pose()["vertices_coords"])
    np.testing.assert_allclose(found[1], found[0], atol=1e-6)


def test_along_the_path_it_goes_past_where_the_driven_joint_turns_back(opened, data):
    window = opened(PANELS["bird base"](data))
    window.to(150)
    assert "turns back here" in window.status()
    top, travelled = window.angle(), window.travelled()
    window.along(travelled + 40)
    assert window.angle() < top - 1
    assert window.closure() <= 1e-10
    window.along(travelled)
    assert window.angle() == pytest.approx(top, abs=0.1)


def test_any_joint_gets_a_slider(opened, data):
    window = opened(PANELS["bird base"](data))
    window.tab.get_by_label("Driven joint").select_option(label="joint 3")
    names = window.tab.locator(".sliders .name").all_inner_texts()
    assert len(names) == 6
    assert "joint 3" in names
    assert window.tab.locator(".sliders .driven .name").inner_text() == "joint 3"


def test_panels_that_pass_through_each_other_are_told(opened):
    corners = ((0, 0), (1, 0), (1, 1), (0, 1), (-1.5, 0), (-1.5, 1), (2.5, 0), (2.5, 1))
    strip = Sheet(8, ((0, 3), (1, 2)), "VV", ((0, 1, 2, 3), (4, 0, 3, 5), (1, 6, 7, 2)), corners)
    window = opened(strip)
    crossed = window.tab.locator(".crossed")
    window.to(120, 0)
    assert crossed.text_content() == ""
    window.to(130, 1)
    assert crossed.text_content() == "Panels pass through each other: 1 and 2"
    window.to(20, 1)
    assert crossed.text_content() == ""


def test_a_limit_is_told_in_words(opened):
    corners = ((0, 0), (1, 0), (1, 1), (0, 1), (2, 0), (2, 1))
    window = opened(Sheet(6, ((1, 2),), "V", ((0, 1, 2, 3), (1, 4, 5, 2)), corners))
    window.along(200)
    assert "panels lie on each other at joint 0" in window.status()
    assert window.angle() == pytest.approx(180)


def test_a_centre_that_is_clicked_tells_what_it_is(opened, data):
    window = opened(PANELS["bird base"](data))
    assert not window.tab.get_by_label("centres").is_checked()  # on a sheet they hide creases
    window.tab.get_by_label("centres").check()
    window.tab.locator(".model canvas").click()
    told = window.tab.locator(".part").text_content()
    assert told.startswith("Centre 0, explicit: a vertex of panels; of joints ")
    window.tab.get_by_label("centres").uncheck()
    window.tab.locator(".model canvas").click()
    assert window.tab.locator(".part").text_content().startswith("Joint ")


def test_a_click_in_the_drawing_tells_the_number(opened, data):
    window = opened(PANELS["square twist"](data))
    window.tab.locator(".pattern path[data-link='4']").click(force=True)
    assert window.tab.locator(".part").text_content().startswith("Link 4")
    window.tab.locator(".pattern path[data-joint='16']").click(force=True)
    assert window.tab.locator(".part").text_content().startswith("Joint 16 between links")


def test_ways_and_mechanisms_are_chosen(opened, data):
    window = opened(PANELS["bird base"](data), OTHERS["Bennett"](data))
    window.tab.get_by_label("Motion branch").select_option("0")
    window.to(20)
    assert window.angle() == pytest.approx(20)
    window.tab.get_by_label("Mechanism").select_option("1")
    assert "Mobile from this configuration: 1 degree of freedom" in window.tab.locator(".verdict").text_content()
    assert not window.tab.get_by_label("Motion branch").is_visible()


def test_orders_of_the_folded_sheet_are_gone_through(opened, data):
    window = opened(unassigned_map(2, 2), PANELS["bird base"](data), OTHERS["Bennett"](data))
    flat = window.tab.locator(".flat")
    assert flat.locator(".flat-told").text_content() == "Folds flat, in 8 layer orders."
    orders = set()
    for number in range(1, 9):
        assert flat.locator(".order").text_content() == f"order {number} of 8"
        orders.add(flat.locator(".stack").text_content())
        window.tab.get_by_role("button", name="Next order").click()
    assert flat.locator(".order").text_content() == "order 1 of 8"
    assert orders == {
        f"Layers there, from below: {', '.join(map(str, order.stacks[0]))}"
        for order in synth.layers(unassigned_map(2, 2)).orders_of(0)
    }
    window.tab.get_by_label("Mechanism").select_option("1")
    shapes = []
    for view in ("front", "back", "x-ray", "light", "exploded"):
        window.tab.get_by_label("View of the folded sheet").select_option(label=view)
        shapes.append(flat.locator("path[data-panel]").count())
        assert flat.get_by_label("Height of the layers").is_visible() == (view == "exploded")
    assert shapes[:4] == [len(synth.layers(PANELS["bird base"](data)).order().stacks)] * 4
    assert shapes[4] == sum(map(len, synth.layers(PANELS["bird base"](data)).order().stacks))
    flat.locator("path[data-panel]").last.click()
    assert window.tab.locator(".part").text_content().startswith("Link ")
    assert flat.locator(".stack").text_content().startswith("Layers there, from below: ")
    window.tab.get_by_label("Mechanism").select_option("2")
    assert not flat.is_visible()


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


@pytest.mark.parametrize("name", [*PANELS, *OTHERS])
def test_what_is_dragged_moves(opened, data, name):
    window = opened((PANELS | OTHERS)[name](data))
    window.to(window.angle() + 10)
    before = np.array(window.pose()["vertices_coords"])
    moved = 0.0
    # A part goes where its joints let it: across to one of these directions at most.
    for right, up in ((6, 9), (9, -6)):
        x, y = somewhere_on_it(window)
        window.tab.mouse.move(x, y)
        window.tab.mouse.down()
        for step in range(1, 8):
            window.tab.mouse.move(x + right * step, y - up * step)
        window.tab.mouse.up()
        after = np.array(window.pose()["vertices_coords"])
        moved = max(moved, float(np.abs(after - before).max()))
    assert moved > 1e-3 * np.ptp(before, axis=0).max()
    assert window.closure() <= 1e-10


def somewhere_on_it(window):
    """A place of the page at which a click hits a link or a joint."""
    window.tab.locator(".model canvas").scroll_into_view_if_needed()
    box = window.tab.locator(".model canvas").bounding_box()
    for part in (0.5, 0.45, 0.55, 0.4, 0.6, 0.35, 0.65):
        for other in (0.5, 0.4, 0.6):
            x, y = box["x"] + part * box["width"], box["y"] + other * box["height"]
            window.tab.mouse.click(x, y)
            if window.tab.locator(".part").text_content().startswith(("Link", "Joint")):
                return x, y
    raise AssertionError("nothing was hit")


def test_a_finger_drags_it(browser, tmp_path, data):
    place = tmp_path / "page.html"
    place.write_text(page([shown_of(PANELS["Miura"](data))]), encoding="utf-8")
    context = browser.new_context(viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True)
    tab = context.new_page()
    tab.goto(place.as_uri())
    tab.wait_for_selector("main[data-ready]", timeout=WAIT)
    slider = tab.locator(".sliders input[type=range]").first
    before = float(slider.input_value())
    box = tab.locator(".model canvas").bounding_box()
    touch = context.new_cdp_session(tab)
    at = {"x": box["x"] + box["width"] / 2, "y": box["y"] + box["height"] / 2}
    touch.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [at]})
    for step in range(1, 8):
        moved = {"x": at["x"] + 7 * step, "y": at["y"] + 3 * step}
        touch.send("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": [moved]})
    touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    assert abs(float(slider.input_value()) - before) > 1
    context.close()


def test_it_is_used_by_keyboard_and_every_control_has_a_name(opened, data):
    window = opened(PANELS["bird base"](data), OTHERS["Bennett"](data))
    before = window.angle()
    window.tab.locator(".sliders input[type=range]").first.focus()
    window.tab.keyboard.press("PageUp")
    assert window.angle() != before
    window.tab.locator(".model canvas").focus()
    window.tab.keyboard.press("ArrowLeft")
    reached = set()
    for _ in range(60):
        window.tab.keyboard.press("Tab")
        reached.add(window.tab.evaluate("document.activeElement.tagName"))
    assert {"SELECT", "BUTTON", "INPUT", "CANVAS", "SUMMARY"} <= reached
    controls = window.tab.locator("button, select, input, canvas, summary, progress")
    nameless = controls.evaluate_all(
        """all => all.filter(one => !(one.ariaLabel || one.textContent.trim() || one.labels?.length))
                      .map(one => one.outerHTML)"""
    )
    assert nameless == []


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
