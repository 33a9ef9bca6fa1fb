"""Crease patterns in the colours of what moves: by the verdict, and branch by branch."""

from dataclasses import replace

import pytest
from commands import run

from graphs.errors import InvariantError
from graphs.files.formats import write
from graphs.mechanism.sheet import Sheet
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.verdict._mobility import verdict_of_motion
from synth.making.drawing.mechanisms.creases import motions_by_verdict, motions_on_branch
from synth.making.drawing.mechanisms.pictures import draw

CORNERS = ((0, 0), (1, 0), (0.5, 1), (-1, 0), (0.5, -1))
VERTEX = Sheet(5, ((0, 1), (0, 2), (0, 3), (0, 4)), "MVVV", ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)), CORNERS)


def creases(scene):
    shapes = next(layer.shapes for layer in scene.layers if layer.name == "creases")
    return {int(dict(shape.data)["joint"]): shape for shape in shapes if shape.data}


def said(scene):
    return " ".join(label.text for label in scene.layers[-1].shapes)


def test_panels_that_move_as_one():
    """A vertex of three creases holds its panels together; a flap beside it moves."""
    corners = ((0, 0), (2, 0), (-1, 2), (-1, -2), (3, 3))
    sheet = Sheet(5, (), "", ((0, 1, 2), (0, 2, 3), (0, 3, 1), (1, 4, 2)), corners)
    scene = draw(sheet, colour="verdict", numbers=False)
    panels, creases = (
        next(layer.shapes for layer in scene.layers if layer.name == name) for name in ("panels", "creases")
    )
    assert [panel.fill for panel in panels] == ["class0", "class0", "class0", "body"]
    looks = {(shape.colour, bool(shape.dash)) for shape in creases if shape.data}
    assert looks == {("grey", True), ("class1", False)}
    assert "1 crease moves (orange); 3 immobile (grey, dotted; " in said(scene)


def test_what_is_not_known_is_neither_still_nor_moving(monkeypatch):
    """Of creases that no known way moves nothing is told, where the verdict does not know either."""
    monkeypatch.setattr(
        "synth.making.drawing.mechanisms.creases.verdict_of_motion",
        lambda pattern: replace(
            verdict_of_motion(pattern), branches=(), certainty="not known", immobile_joints=(0, 1, 2, 3)
        ),
    )
    assert set(motions_by_verdict(VERTEX).of.values()) == {"unknown"}
    scene = draw(VERTEX, colour="verdict")
    assert {shape.colour for shape in creases(scene).values()} == {"unassigned"}
    assert "which creases move is not known" in said(scene)


def test_each_branch_has_its_mountains_and_valleys():
    branches = configuration_of_sheet(VERTEX).branches.branches
    assert len(branches) > 1
    colour_of = {"+": "valley", "-": "mountain", "0": "grey"}
    for number, branch in enumerate(branches):
        by_number, by_signs = (draw(VERTEX, colour="branch", branch=one) for one in (number, branch.signs))
        assert [shape.colour for shape in creases(by_number).values()] == [colour_of[one] for one in branch.signs]
        assert by_number == by_signs
        assert f"way {number} of {len(branches)}" in said(by_number)


def test_the_branch_of_the_marks_comes_by_itself():
    assert list(motions_on_branch(VERTEX).of.values()) == ["mountain", "valley", "valley", "valley"]
    opposite = replace(VERTEX, assignments="".join({"M": "V", "V": "M"}.get(a, a) for a in VERTEX.assignments))
    assert list(motions_on_branch(opposite).of.values()) == ["valley", "mountain", "mountain", "mountain"]


def test_branches_that_are_none():
    with pytest.raises(InvariantError, match="no branch 9; expected one from 0 to 1"):
        draw(VERTEX, colour="branch", branch=9)
    with pytest.raises(InvariantError, match="the colouring 'letters' shows no branch"):
        draw(VERTEX, branch=0)


def test_the_command_takes_numbers_and_signs(tmp_path):
    pattern = tmp_path / "vertex.fold"
    write(VERTEX, pattern)
    signs = configuration_of_sheet(VERTEX).branches.branches[1].signs
    for name, branch in (("number", "1"), ("signs", signs)):
        run("draw", pattern, "--colour", "branch", f"--branch={branch}", "-o", tmp_path / f"{name}.svg")
    assert (tmp_path / "number.svg").read_bytes() == (tmp_path / "signs.svg").read_bytes()
