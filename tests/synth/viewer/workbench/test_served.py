"""The workbench as it is served: in Chromium, and to who should not ask."""

import os
import shutil
import signal
import subprocess
import sys
import urllib.error
import urllib.request

import pytest

import synth
from graphs.creasing.edits import lock_crease
from graphs.files.formats import read
from synth.viewer.building import BUILT

pytestmark = pytest.mark.web

pytest.importorskip("uvicorn", reason="the workbench is not installed")
sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")

WAIT = 60_000
DROP = """([name, text]) => {
  const carried = new DataTransfer();
  carried.items.add(new File([text], name));
  document.dispatchEvent(new DragEvent("drop", { dataTransfer: carried, bubbles: true, cancelable: true }));
}"""


class Served:
    """A workbench in a process of its own; its address is what it printed."""

    def __init__(self, *files):
        command = [sys.executable, "-u", "-m", "synth.cli", "view", *map(str, files)]
        quiet = {**os.environ, "BROWSER": shutil.which("true") or "true"}
        self.process = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=quiet
        )
        self.address = self.process.stdout.readline().split()[1]

    def end(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        try:
            return self.process.wait(timeout=20)
        finally:
            self.process.kill()
            self.process.communicate()


@pytest.fixture
def served():
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
    place = shutil.which("chromium")
    if place is None:
        pytest.skip("Chromium is not installed")
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=place, args=["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-sandbox"]
        )
        yield browser.new_page()
        browser.close()


def status(address, **headers):
    try:
        with urllib.request.urlopen(urllib.request.Request(address, headers=headers), timeout=20) as answer:
            return answer.status
    except urllib.error.HTTPError as error:
        return error.code


def test_what_is_dropped_is_shown_and_folds_and_what_cannot_be_read_is_told(served, tab, data):
    bench, said = served(), []
    tab.on("pageerror", lambda error: said.append(str(error)))
    tab.goto(bench.address)
    tab.wait_for_selector("main[data-ready]", timeout=WAIT)
    place = data / "wiener" / "square-twist.fold"
    tab.evaluate(DROP, [place.name, place.read_text()])
    verdict = synth.mobility(read(place)).verdict.text
    tab.locator(".verdict", has_text=verdict).wait_for(timeout=WAIT)
    tab.get_by_label("Angle, degrees").fill("-30")
    tab.get_by_label("Angle, degrees").press("Enter")
    angle = tab.get_by_label("Angle of the driven joint, degrees")
    assert abs(float(angle.input_value())) == pytest.approx(30, abs=1e-6)
    tab.evaluate(DROP, ["broken.fold", "{"])
    tab.locator(".bench", has_text="broken.fold: line 1").wait_for(timeout=WAIT)
    tab.get_by_label("Files to open").set_input_files(data / "linkages" / "bennett.json")
    tab.locator(".verdict", has_text="Moves with 1 freedom").wait_for(timeout=WAIT)
    assert tab.get_by_label("Mechanism").locator("option").all_inner_texts() == [place.name, "bennett.json"]
    assert said == []


def test_a_crease_is_locked_and_that_undone(served, tab, data):
    place = data / "patterns" / "four-bar-vertex.fold"
    bench = served(place)
    tab.goto(bench.address)
    tab.wait_for_selector("main[data-ready]", timeout=WAIT)
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
    tab.goto(bench.address)
    tab.wait_for_selector("main[data-ready]", timeout=WAIT)
    tab.reload()
    tab.wait_for_selector("main[data-ready]", timeout=WAIT)
    tab.close()
    assert bench.process.wait(timeout=40) == 0
