"""The first look: what it says is what the other commands answer, and the commands it names work."""

import json
import shlex
from pathlib import Path

import pytest
from commands import run

import synth
from synth.making.viewer import pages

ROOT = Path(__file__).resolve().parents[2]
MECHANISMS = {
    "data/patterns/bird-base.fold": "A flat crease pattern: 16 panels",
    "data/wiener/miura-3x3.fold": "A crease pattern folded in space: 9 panels; lines: 6 mountain, 6 valley",
    "data/linkages/bennett.json": "Rigid bodies in space, hinged along axes: 4 links, 4 joints.",
    "data/linkages/stewart.json": "A linkage of several kinds of joints",
    "data/surfaces/fig11-stephenson.json": "A linkage on a cone: 6 links, 7 joints; all axes meet at its apex; its chain is named stephenson.",
    "data/wiener/six-bar.json": "An SCD graph, a type without coordinates: 6 links, 7 joints, 2 centres; its chain is named watt.",
    "data/wampler/crs-platform.json": "A polyhedron model, a type without coordinates: 10 vertices",
    "k1:Cr": "A kinematic chain, a type without coordinates and centres: 4 links, 4 joints; its chain is named four-bar.",
}


def place_of(mechanism):
    return mechanism if mechanism.startswith("k1:") else str(ROOT / mechanism)


@pytest.mark.parametrize(("mechanism", "kind"), MECHANISMS.items())
def test_it_says_what_it_is_and_what_the_verdict_is(mechanism, kind):
    seen = synth.look(place_of(mechanism))
    assert seen.kind.startswith(kind)
    answer = synth.mobility(place_of(mechanism))
    assert seen.motion.startswith(answer.verdict.text)
    assert ("layer orders" in seen.motion) == (answer.flat_folding is not None)
    assert seen.drawing == "Nothing had to be repaired."


@pytest.mark.parametrize("mechanism", MECHANISMS)
def test_the_commands_it_names_are_answered(mechanism, tmp_path, monkeypatch):
    for name in ("page.js", "page.css"):  # the script of the page, which may not be built
        (tmp_path / name).write_text("")
    monkeypatch.setattr(pages, "BUILT", tmp_path)
    monkeypatch.setattr(pages.page, "__kwdefaults__", {**pages.page.__kwdefaults__, "built": tmp_path})
    monkeypatch.setattr(pages, "check_built", lambda: None)
    monkeypatch.chdir(tmp_path)
    for row in json.loads(run("look", place_of(mechanism), "--json").stdout)["next"]:
        words = shlex.split(row["command"])
        assert words[0] == "synth"
        run(*words[1:])
        if "-o" in words:
            assert (tmp_path / words[words.index("-o") + 1]).exists(), row


DRAWING = """<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100">
<path stroke="black" d="M0 0H100V100H0Z"/><path stroke="red" d="M0 0L49.97 49.98M100 0L50 50"/>
<path stroke="blue" d="M0 100L50 50L100 100"/></svg>"""


def test_repairs_and_marks_that_disagree_have_places_and_a_command(tmp_path):
    drawing = tmp_path / "my pattern.svg"
    drawing.write_text(DRAWING)
    seen = synth.look(drawing)
    assert "weld" in seen.drawing or "extended" in seen.drawing
    assert "(" in seen.drawing  # the place of the repair
    assert "disagree" in seen.drawing
    commands = [command for command, _ in seen.commands]
    assert f"synth draw '{drawing}' --as repairs -o repairs.svg" in commands
    assert f"synth edit '{drawing}' --assign-branch" in " ".join(commands)


def test_a_picture_is_written_with_it(tmp_path):
    picture = tmp_path / "bird.svg"
    out = run("look", ROOT / "data/patterns/bird-base.fold", "-o", picture).output
    assert "<svg" in picture.read_text()
    assert out.rstrip().endswith(f"written: {picture}")


def test_the_precision_is_that_which_is_stated(tmp_path):
    pattern = ROOT / "data/patterns/bird-base.fold"
    assert synth.look(pattern, precision=0.01).mobility.configuration.precision.size > 1e-3
    assert "degrees of freedom" in run("look", pattern, "--precision", "0.01").output
