"""Wrong marks and repairs on the crease pattern: a sign for each, where it belongs, and told below."""

from dataclasses import replace

import numpy as np
import pytest

import synth
from graphs.convert.tracing import Lines, trace_sheet
from graphs.mechanism.sheet import with_all_edges
from synth.making.drawing.mechanisms.creases import places_on_page
from synth.making.drawing.scene.shapes import Disc, Line


def layer(scene, name):
    return next(one for one in scene.layers if one.name == name).shapes


def told(scene):
    return " ".join(label.text for label in layer(scene, "caption"))


def with_marks_turned(sheet, number):
    """The sheet with the last creases turned over."""
    whole = with_all_edges(sheet)
    letters = list(whole.assignments)
    turned = [edge for edge, letter in enumerate(letters) if letter in "MV"][-number:]
    for edge in turned:
        letters[edge] = {"M": "V", "V": "M"}[letters[edge]]
    return replace(whole, assignments="".join(letters)), turned


def test_creases_that_disagree_have_bands_below_them():
    sheet, turned = with_marks_turned(synth.generate("miura", rows=3, columns=3).mechanism, 2)
    scene = synth.draw(sheet, "marks")
    bands = layer(scene, "marks")
    assert {dict(band.data)["joint"] for band in bands} == set(map(str, turned))
    assert all(band.colour == "marked" and not band.dash for band in bands)
    assert "2 of 12 assigned creases disagree with branch" in told(scene)
    assert [one.name for one in scene.layers].index("marks") < [one.name for one in scene.layers].index("creases")
    number = synth.mobility(sheet).to_json()["assignment"]["nearest_branch"]
    others = [n for n in range(len(synth.mobility(sheet).verdict.branches)) if n != number]
    more = layer(synth.draw(sheet, "marks", branch=others[0]), "marks")
    assert len(more) > len(bands)


def test_creases_that_do_not_move_are_told_apart():
    """Four creases at right angles fold two and two: a third and a fourth that are marked stay."""
    cross = synth.generate("map", rows=2, columns=2).mechanism
    whole = with_all_edges(cross)
    marked = replace(whole, assignments=whole.assignments.replace("V", "M").replace("U", "M"))
    scene = synth.draw(marked, "marks")
    bands = layer(scene, "marks")
    assert len(bands) == 2
    assert all(band.dash for band in bands)
    assert "2 are immobile (light blue dots)" in told(scene)


def test_a_pattern_as_it_folds_has_no_bands_and_one_without_marks_is_refused():
    sheet = synth.generate("miura").mechanism
    scene = synth.draw(sheet, "marks")
    assert layer(scene, "marks") == ()
    assert "all creases are marked as branch" in told(scene)
    blank = with_all_edges(sheet)
    letters = "".join("U" if letter in "MV" else letter for letter in blank.assignments)
    with pytest.raises(synth.UnsolvableError, match="marks require a flat crease pattern"):
        synth.draw(replace(blank, assignments=letters), "marks")


def test_repairs_are_drawn_at_their_places_and_within_the_picture():
    drawn = {
        "B": [((0, 0), (8, 0)), ((8, 0), (8, 8)), ((8, 8), (0, 8)), ((0, 8), (0, 0))],
        "M": [((0, 0), (8, 8)), ((8, 8), (0, 0)), ((4, 8), (4, 12))],
        "V": [((8, 0), (0, 8))],
    }
    letters = "".join(letter * len(lines) for letter, lines in drawn.items())
    ends = np.array([line for lines in drawn.values() for line in lines], dtype=float)
    sheet = trace_sheet(Lines(ends, letters))
    scene = synth.draw(sheet, "repairs")
    [ring] = [shape for shape in layer(scene, "repairs") if isinstance(shape, Disc)]
    creases = [shape.points for shape in layer(scene, "creases") if shape.colour in ("mountain", "valley")]
    (middle,) = {end for line in creases for end in line if sum(end in other for other in creases) == 4}
    assert ring.centre == pytest.approx(middle)
    lines = {shape.colour: shape.points for shape in layer(scene, "repairs") if isinstance(shape, Line)}
    assert len(lines) == 2  # drawn twice, and pruned
    assert all(0 <= y <= scene.height for points in lines.values() for _, y in points)
    [upper] = [min(y for _, y in points) for colour, points in lines.items() if colour == "class3"]
    assert upper < min(y for line in creases for _, y in line)
    for what in ("1 crossing split (green rings)", "1 line drawn twice (light blue bands)"):
        assert what in told(scene)
    assert len(places_on_page(sheet)) == sheet.vertices


def test_what_was_not_repaired_is_told():
    assert "nothing was repaired" in told(synth.draw(synth.generate("miura").mechanism, "repairs"))
