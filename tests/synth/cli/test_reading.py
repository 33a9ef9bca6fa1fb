"""Options on how a drawing is read: wherever one is read, and in the same words."""

import gc
import json

import click
import pytest
from click.testing import CliRunner

from graphs.files.formats import read
from graphs.garbage import set_aside
from synth.cli.main import main

SVG = (
    '<svg xmlns="http://www.w3.org/2000/svg"><rect width="10" height="10" stroke="black"/><g id="folds">'
    '<path d="M0 0L10 10" stroke="#804000"/><path d="M10 0L0 10" stroke="#804000" stroke-dasharray="3 2"/></g>'
    '<path d="M0 5h10" stroke="#999"/></svg>'
)
STATED = ("--colour", "M=rgb(128, 64, 0),V=dashed #804000", "--colour", "-=#999")


@pytest.fixture
def drawing(tmp_path):
    path = tmp_path / "a.svg"
    path.write_text(SVG)
    return path


def run(*words):
    return CliRunner().invoke(main, list(map(str, words)))


def commands():
    context = click.Context(main)
    return {name: main.get_command(context, name) for name in main.list_commands(context)}


def test_the_options_are_those_of_every_command_that_reads_a_pattern():
    having = {name for name, one in commands().items() if any("--layer" in option.opts for option in one.params)}
    assert having == {
        "look", "mobility", "fold", "positions", "explain", "advise", "states", "limits", "draw", "view", "template",
        "reduce", "edit", "convert", "reconstruct", "id", "layers", "thicken",
    }  # fmt: skip
    for name in having:
        assert any("--colour" in option.opts for option in commands()[name].params), name


@pytest.mark.parametrize(
    ("command", "after"),
    [
        (("mobility",), ("--json",)),
        (("fold",), ("--json", "--frames", 1)),
        (("convert",), ("out.fold", "--json")),
        (("draw",), ("-o", "out.svg")),
        (("template",), ("-o", "out.dxf", "--no-note")),
        (("edit",), ("--lock", 4, "-o", "out.fold")),
        (("id",), ()),
        (("explain",), ()),
    ],
    ids=lambda words: words[0] if words else "",
)
def test_what_is_stated_is_what_is_read(command, after, drawing, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = run(*command, drawing, *STATED, *after)
    assert result.exit_code == 0, result.output
    assert "not understood" not in result.output
    if command == ("convert",):
        assert (
            read("out.fold").assignments
            == read(drawing, colours={"M": "#804000", "V": "dashed", "-": "#999"}).assignments
        )
    if command == ("mobility",):
        assert json.loads(result.stdout)[0]["links"] == 4


def test_what_is_left_out_is_the_first_line(drawing, tmp_path):
    drawing.write_text(SVG.replace("#804000", "red"))
    for words in (("mobility", drawing), ("fold", drawing, "--frames", 1)):
        lines = run(*words).stdout.splitlines()
        first = lines[words[0] == "mobility"]  # the name of the file stands above
        assert first.startswith("1 shape with strokes not understood left out: 1 #999999; state what")
    result = run("id", drawing)
    assert "1 #999999; state" in result.stderr
    assert "999" not in result.stdout
    shown = json.loads(run("fold", drawing, "--frames", 1, "--json").stdout)["reading"]
    assert shown["left_out"].endswith("1 #999999")


def test_a_drawing_that_is_not_understood_is_refused_everywhere(drawing):
    drawing.write_text(SVG.replace("black", "#aaa"))
    for words in (("mobility",), ("fold",), ("id",), ("explain",)):
        result = run(*words, drawing)
        assert result.exit_code == 2
        assert "7 of 7 lines have strokes that are not understood" in result.stderr


@pytest.mark.parametrize("word", ["red", "M=", "Q=red", "M=reddish", "=red"])
def test_what_cannot_be_stated_is_bad_usage(word, drawing):
    for command in ("mobility", "draw"):
        result = run(command, drawing, "--colour", word, *(("-o", "a.svg") if command == "draw" else ()))
        assert result.exit_code == 2, result.output


@pytest.fixture
def nothing_set_aside():
    """No objects are out of garbage collections; afterwards those are again that were."""
    before = gc.get_freeze_count()
    gc.unfreeze()
    yield
    if before:
        gc.freeze()


@pytest.mark.usefixtures("nothing_set_aside")
def test_what_is_read_is_set_aside_until_the_command_ends(data):
    with click.Context(main) as context:
        with set_aside(context.call_on_close):
            assert not gc.isenabled()
        assert gc.isenabled()
        aside = gc.get_freeze_count()
        with set_aside(context.call_on_close):  # once is enough
            assert gc.isenabled()
        assert 0 < gc.get_freeze_count() <= aside
    assert gc.get_freeze_count() == 0
    with click.Context(main) as context, pytest.raises(KeyError), set_aside(context.call_on_close):
        raise KeyError
    assert (gc.isenabled(), gc.get_freeze_count()) == (True, 0)
    assert run("fold", data / "patterns" / "four-bar-vertex.fold", "--frames", 1).exit_code == 0
    assert (gc.isenabled(), gc.get_freeze_count()) == (True, 0)
    assert run("fold", data / "index.json").exit_code == 2
    assert (gc.isenabled(), gc.get_freeze_count()) == (True, 0)
