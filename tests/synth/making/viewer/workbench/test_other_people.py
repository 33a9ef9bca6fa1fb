"""Crease patterns by other people, all of them, on one workbench: judged as the command does, or refused so."""

import os

import pytest
from real_patterns import names_of_patterns
from workbench import DROP, WAIT, Served, opened

import synth
from graphs.errors import SynthedraError
from graphs.files.formats import read
from tests.support.commands import run

pytestmark = [pytest.mark.web, pytest.mark.slow]

pytest.importorskip("uvicorn", reason="the workbench is not installed")

SAMPLE = [
    "oefold_invalid.fold", "fold_squaretwist.fold", "osbo_birdBase.fold", "ossvg_flappingBird.svg", "oe_birdbase.cp",
    "bx_pyramid.obj", "rk_two_line.fold", "os_BoxPleatPyramid.fold",
]  # fmt: skip


@pytest.fixture(scope="module")
def bench():
    one = Served()
    yield one
    one.end()


def as_the_command(place):
    """The verdict of a file, or in what words it is refused."""
    try:
        return "verdict", synth.mobility(read(place)).verdict.text
    except SynthedraError:
        return "error", run("mobility", place, code=2).output.strip().replace(f"{place.parent}{os.sep}", "")


@pytest.mark.parametrize("name", names_of_patterns())
def test_each_is_judged_or_refused_as_the_command_does(bench, fold_folder, name):
    place = fold_folder / name
    kind, words = as_the_command(place)
    told = bench.asked(name, place.read_bytes())
    if kind == "error":
        assert told["error"] == words
    else:
        if told["shown"]["verdict"].endswith("on request (--motion)."):  # so large that the page comes first
            told = bench.asked(name, place.read_bytes(), motion=True)
        assert told["shown"]["verdict"] == words
        assert told["shown"]["pictures"]["light"].startswith("<svg")


def test_dropped_one_after_the_other(served, tab, fold_folder):
    said = []
    tab.on("pageerror", lambda error: said.append(str(error)))
    opened(tab, served())
    for name in SAMPLE:
        place = fold_folder / name
        tab.evaluate(DROP, [name, place.read_text(errors="surrogateescape")])
        kind, words = as_the_command(place)
        tab.locator(".verdict" if kind == "verdict" else ".bench", has_text=words).wait_for(timeout=WAIT)
    shown = [name for name in SAMPLE if as_the_command(fold_folder / name)[0] == "verdict"]
    assert tab.get_by_label("Mechanism").locator("option").all_inner_texts() == shown
    assert said == []
