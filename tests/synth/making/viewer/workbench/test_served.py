"""The workbench as it is served: in Chromium, and to who should not ask."""

import json
import re
from itertools import combinations

import numpy as np
import pytest
from workbench import DROP, DROP_ALL, WAIT, opened, status

import synth
from graphs.creasing.edits import crease_sheet, lock_crease
from graphs.errors import SynthedraError
from graphs.files.formats import read
from synth.catalogue.patterns.creases import miura
from synth.making.drawing.mechanisms.creases import places_on_page
from synth.making.viewer.workbench.reading import edited

pytestmark = pytest.mark.web


def test_an_empty_one_fills_the_window(served, tab):
    opened(tab, served())
    box = tab.locator(".bench").bounding_box()
    height, window = tab.evaluate("[document.documentElement.scrollHeight, innerHeight]")
    assert height <= window
    assert box["y"] + box["height"] > 0.95 * window


def test_several_files_are_dropped_at_once_and_all_undone(served, tab, data):
    opened(tab, served())
    names = ["patterns/four-bar-vertex.fold", "linkages/bennett.json", "wiener/six-bar.json"]
    places = [data / name for name in names]
    tab.evaluate(DROP_ALL, [[place.name, place.read_text()] for place in places])
    listed = tab.get_by_label("Mechanism").locator("option")
    listed.nth(2).wait_for(state="attached", timeout=WAIT)
    assert listed.all_inner_texts() == [place.name for place in places]
    for number in (2, 1):
        tab.get_by_role("button", name="Undo").click()
        listed.nth(number).wait_for(state="detached", timeout=WAIT)
    tab.get_by_role("button", name="Undo").click()
    tab.get_by_role("button", name="Miura sheet").wait_for(timeout=WAIT)


def test_two_files_are_judged_at_once_and_shown_in_their_order(served, tab):
    """The status names both; a third waits; Stop ends all of them."""
    opened(tab, served())
    files = [
        [f"{name}.fold", json.dumps(fold_document(miura(n, n, 1.2)))] for name, n in zip("abc", (16, 4, 6), strict=True)
    ]
    tab.evaluate(DROP_ALL, files)
    tab.locator(".bench [role=status]", has_text=re.compile(r"a\.fold: .*; b\.fold: .*1 more waits")).wait_for(
        timeout=WAIT
    )
    listed = tab.get_by_label("Mechanism").locator("option")
    listed.nth(2).wait_for(state="attached", timeout=WAIT)
    assert listed.all_inner_texts() == ["a.fold", "b.fold", "c.fold"]
    tab.locator(".bench [role=status]", has_text="Drop a crease pattern").wait_for(timeout=WAIT)
    assert tab.get_by_role("button", name="Stop").count() == 0
    tab.evaluate(DROP_ALL, files)
    tab.get_by_role("button", name="Stop").click()
    tab.locator(".bench [role=status]", has_text="a.fold: stopped").wait_for(timeout=WAIT)
    assert listed.count() == 3


def fold_document(sheet):
    return {
        "file_spec": 1.2,
        "vertices_coords": sheet.coordinates,
        "faces_vertices": sheet.faces,
        "edges_vertices": sheet.edges,
        "edges_assignment": list(sheet.assignments),
    }


def test_what_is_dropped_is_shown_and_folds_and_what_cannot_be_read_is_told(served, tab, data):
    bench, said = served(), []
    tab.on("pageerror", lambda error: said.append(str(error)))
    opened(tab, bench)
    place = data / "wiener" / "square-twist.fold"
    tab.evaluate(DROP, [place.name, place.read_text()])
    verdict = synth.mobility(read(place)).verdict.text
    tab.locator(".verdict", has_text=verdict).wait_for(timeout=WAIT)
    field = tab.locator(".sliders input[type=number]").first
    field.fill("-30")
    field.press("Enter")
    angle = tab.locator(".sliders input[type=range]").first
    assert abs(float(angle.input_value())) == pytest.approx(30, abs=1e-6)
    tab.evaluate(DROP, ["broken.fold", "{"])
    tab.locator(".bench", has_text="broken.fold: line 1").wait_for(timeout=WAIT)
    tab.get_by_label("Files to open").set_input_files(data / "linkages" / "bennett.json")
    tab.locator(".verdict", has_text="Mobile from this configuration: 1 degree of freedom").wait_for(timeout=WAIT)
    assert tab.get_by_label("Mechanism").locator("option").all_inner_texts() == [place.name, "bennett.json"]
    assert said == []


def test_a_crease_is_locked_and_that_undone(served, tab, data):
    place = data / "patterns" / "four-bar-vertex.fold"
    opened(tab, served(place))
    first = synth.mobility(read(place)).verdict.text
    locked = synth.mobility(lock_crease(read(place), 0).sheet).verdict.text
    assert locked != first
    assert tab.get_by_role("button", name="Lock joint").is_disabled()
    tab.locator(".pattern path[data-joint='0']").first.click(force=True)
    tab.get_by_role("button", name="Lock joint").click()
    tab.locator(".verdict", has_text=locked).wait_for(timeout=WAIT)
    tab.get_by_role("button", name="Undo").click()
    tab.locator(".verdict", has_text=first).wait_for(timeout=WAIT)
    assert tab.get_by_role("button", name="Undo").is_disabled()


def verdict_is(tab, mechanism):
    tab.locator(".verdict", has_text=synth.mobility(mechanism).verdict.text).wait_for(timeout=WAIT)


def test_a_crease_is_added_between_places_that_are_clicked(served, tab, data):
    place = data / "wiener" / "square-twist.fold"
    opened(tab, served(place))
    sheet = read(place)
    at = places_on_page(sheet, (420.0, 420.0))
    tab.get_by_role("button", name="Add crease").click()
    ends = next((a, b) for a, b in combinations(range(sheet.vertices), 2) if is_new(sheet, a, b))
    for vertex in ends:
        spot = tab.evaluate(
            """([x, y]) => {
                 const at = new DOMPoint(x, y).matrixTransform(document.querySelector(".pattern svg").getScreenCTM());
                 return [at.x, at.y];
               }""",
            at[vertex],
        )
        tab.mouse.click(*spot)
    assert tab.get_by_label("Crease from").input_value() == str(ends[0])
    assert tab.get_by_label("Crease to").input_value() == str(ends[1])
    tab.get_by_role("button", name="Crease", exact=True).click()
    after = crease_sheet(sheet, *ends).sheet
    verdict_is(tab, after)
    tab.get_by_role("button", name="Undo").click()
    verdict_is(tab, sheet)


def is_new(sheet, start, end):
    try:
        crease_sheet(sheet, start, end)
    except SynthedraError:
        return False
    return True


def panels_are(tab, number):
    """Wait until so many panels are drawn."""
    drawn = "number => document.querySelectorAll('.pattern path[data-link]').length === number"
    tab.wait_for_function(drawn, arg=number, timeout=WAIT)


def test_ride_alongs_are_taken_off_and_put_back(served, tab, data):
    place = data / "patterns" / "bird-base.fold"
    opened(tab, served(place))
    assert tab.locator(".pattern path[data-link]").count() == 16
    tab.get_by_role("button", name="Ride-alongs off").click()
    verdict_is(tab, edited(read(place), ["ride-alongs"]))  # it may read as before
    panels_are(tab, 8)
    tab.get_by_role("button", name="Ride-alongs off").click()
    tab.locator(".bench", has_text="the mechanism has no ride-alongs that can be removed").wait_for(timeout=WAIT)
    tab.get_by_role("button", name="Undo").click()
    verdict_is(tab, read(place))
    panels_are(tab, 16)


@pytest.mark.parametrize(("kind", "begins"), [("PDF", b"%PDF-"), ("SVG", b"<svg"), ("DXF", b"999\nmillimetres")])
def test_templates_are_downloaded(served, tab, data, kind, begins):
    opened(tab, served(data / "patterns" / "bird-base.fold"))
    with tab.expect_download(timeout=WAIT) as got:
        tab.locator(".edits").get_by_role("button", name=kind).click()
    assert got.value.suggested_filename == f"bird-base.{kind.lower()}"
    content = got.value.path().read_bytes().replace(b"\r\n", b"\n")
    assert content.lstrip().startswith(begins)


def test_the_answer_and_the_drawing_are_downloaded(served, tab, data):
    place = data / "patterns" / "bird-base.fold"
    opened(tab, served(place))
    with tab.expect_download() as got:
        tab.get_by_role("button", name="JSON").click()
    assert json.loads(got.value.path().read_text()) == json.loads(json.dumps(synth.mobility(read(place)).to_json()))
    with tab.expect_download() as got:
        tab.locator("main > .row").get_by_role("button", name="SVG").click()
    assert got.value.path().read_text().startswith("<svg")


def test_long_work_tells_how_far_it_is_and_is_stopped(served, tab):
    opened(tab, served())
    tab.evaluate(DROP, ["large.fold", json.dumps(fold_document(miura(24, 24, np.radians(60.0))))])
    tab.locator("progress").wait_for(timeout=WAIT)
    tab.locator(".bench", has_text="%)").wait_for(timeout=WAIT)
    tab.get_by_role("button", name="Stop").click()
    tab.locator(".bench", has_text="large.fold: stopped").wait_for(timeout=WAIT)
    assert not tab.locator("progress").is_visible()
    tab.evaluate(DROP, ["broken.fold", "{"])
    tab.locator(".bench", has_text="broken.fold: line 1").wait_for(timeout=WAIT)


def test_large_sheets_are_shown_at_once_and_their_motion_on_request(served, tab):
    opened(tab, served())
    sheet = miura(30, 41, np.radians(60.0))
    tab.evaluate(DROP, ["large.fold", json.dumps(fold_document(sheet))])
    tab.locator(".verdict", has_text="is analysed on request").wait_for(timeout=WAIT)
    assert tab.locator(".model canvas").is_visible()
    assert tab.get_by_role("button", name="Play").is_disabled()
    tab.get_by_role("button", name="Look for its motion").click()
    tab.locator(".verdict", has_text="1 degree of freedom").wait_for(timeout=WAIT)
    assert tab.locator(".sliders input[type=range]").count() == 2


def test_what_claims_too_much_is_refused_and_what_hangs_nobody(served, tab):
    """A million faces, entities, deep nesting, script in every name: a message, and the page goes on."""
    bench, said = served(), []
    tab.on("pageerror", lambda error: said.append(str(error)))
    tab.on("dialog", lambda dialog: said.append(dialog.message))
    opened(tab, bench)
    script = "</script><img src=x onerror=alert(1)><script>alert(2)</script>"
    corners = [[0, 0], [1, 0], [1, 1], [0, 1]]
    hostile = {
        "million.fold": json.dumps({"vertices_coords": corners, "faces_vertices": [[0, 1, 2]] * 1_000_000}),
        "deep.fold": "[" * 100_000,
        "entities.svg": '<!DOCTYPE s [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;">]><svg>&b;</svg>',
        "huge.fold": json.dumps({"vertices_coords": [[1e308, -1e308]] * 3, "faces_vertices": [[0, 1, 2]]}),
        f"{script}.fold": "{",
    }
    for name, text in hostile.items():
        tab.evaluate(DROP, [name, text])
        refused = re.compile(rf"\.{name.rpartition('.')[2]}: (?!waiting|reading|finding|drawing)")
        tab.locator(".bench [role=status]", has_text=refused).wait_for(timeout=WAIT)
        assert tab.locator(".verdict").text_content() == ""
    names = {"edges_vertices": [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]], "edges_assignment": [*"BBBBV"]}
    sheet = {"file_title": script, "vertices_coords": corners, "faces_vertices": [[0, 1, 2], [0, 2, 3]], **names}
    tab.evaluate(DROP, [f"{script}.fold", json.dumps(sheet)])
    tab.locator(".verdict", has_text="1 degree of freedom").wait_for(timeout=WAIT)
    assert said == []
    assert tab.locator("img").count() == 0


def test_others_get_nothing_and_ctrl_c_ends_it(served, data):
    first, second = served(data / "patterns" / "four-bar-vertex.fold"), served()
    assert status(first.address) == status(second.address) == 200
    assert status(first.address + "given?number=0") == 200
    for wrong in ("1", "-1", "x", "9" * 30, "../0"):
        assert status(f"{first.address}given?number={wrong}") == 404
    host = first.address.split("/")[2]
    assert status(f"http://{host}/") == status(f"http://{host}/{second.address.split('/')[3]}/") == 404
    assert status(first.address + "../../etc/passwd") == 404
    assert status(first.address, Origin="http://evil.example") == status(first.address, Host="evil.example") == 403
    assert first.end() == 130
    assert status(second.address) == 200


def test_it_ends_when_its_page_was_closed(served, tab):
    bench = served()
    opened(tab, bench)
    tab.reload()
    tab.wait_for_selector("main[data-ready]", timeout=WAIT)
    tab.close()
    assert bench.process.wait(timeout=40) == 0
