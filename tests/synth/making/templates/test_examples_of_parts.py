"""Small parts of the room, each by an example."""

from itertools import pairwise

import numpy as np
import shapely

from graphs.mechanism.sheet import Sheet
from graphs.mechanism.surfaces import Cone
from synth.linkages.conformed.linkage_behaviour import loop_of_steps
from synth.making.templates.hinges import Hinges, with_hinges
from synth.making.templates.nets import slot_of, tab_shapes
from synth.making.templates.on_surface import LayeredLinkage, TemplateSizes
from synth.making.templates.pages import Paper, clipped, gauge, note_page, tiles_across
from synth.making.templates.pieces import (
    Piece,
    TemplateLine,
    common_spans,
    cut_once,
    is_laid_out,
    lies_over,
    lies_within,
    put_together,
    uncovered,
)
from synth.making.templates.template import millimetres, steps_of_folds
from synth.making.templates.unfolding import Plane


def test_example_of_with_hinges():
    outline = [(0, 0), (50, 0), (100, 0), (100, 40), (50, 40), (0, 40)]
    cuts = [TemplateLine("CUT", *ends) for ends in pairwise([*outline, outline[0]])]
    card = Piece((*cuts, TemplateLine("VALLEY", (50, 0), (50, 40))), (), shapely.Polygon(outline))
    hinged = with_hinges(card, (), Hinges("offset", 3))
    assert [stroke.start[0] for stroke in hinged.strokes if stroke.kind == "VALLEY"] == [51.5, 48.5]


def test_example_of_tab_shapes():
    assert next(tab_shapes(np.array([0, 0.0]), np.array([0, 40.0]), 8)).tolist() == [
        [0.0, 0.0],
        [0.0, 40.0],
        [8.0, 35.2],
        [8.0, 4.8],
    ]


def test_example_of_slot_of():
    assert slot_of(np.array([[0.0, 0.0], [0.0, 40.0], [8.0, 36.0], [8.0, 4.0]])).tolist() == [[4.0, 38.5], [4.0, 1.5]]


def test_example_of_layered():
    made = LayeredLinkage(loop_of_steps(np.radians([40, 50, 50])), Cone(0.5), TemplateSizes())
    assert [(link.layer, round(np.degrees(link.width))) for link in made.links] == [(0, 40), (0, 50), (0, 50), (1, 140)]


def test_example_of_gauge():
    assert gauge((10, 20))[0][0] == TemplateLine(kind="MARKS", start=(10, 20), end=(110.0, 20))


def test_example_of_tiles_across():
    assert tiles_across((500, 100), (190, 261)) == (3, 1)


def test_example_of_clipped():
    assert clipped(TemplateLine("CUT", (-5, 0), (5, 10)), (0, 0, 20, 8)) == TemplateLine(
        kind="CUT", start=(0.0, 5.0), end=(3.0, 8.0)
    )


def test_example_of_note_page():
    page = note_page(Paper(210, 297), "bird base", ["Cut it out.", "Fold it."], None)
    assert [text.words for text in page.texts] == ["bird base", "1. Cut it out.", "2. Fold it."]


def test_example_of_cut_once():
    assert cut_once(
        [
            TemplateLine("CUT", (0, 0), (30, 0)),
            TemplateLine("CUT", (50, 0), (10, 0)),
            TemplateLine("CUT", (30, 0), (0, 0)),
        ]
    ) == [
        TemplateLine(kind="CUT", start=(0, 0), end=(30, 0)),
        TemplateLine(kind="CUT", start=(50.0, 0.0), end=(30.0, 0.0)),
    ]


def test_example_of_uncovered():
    assert uncovered(TemplateLine("CUT", (0, 0), (9, 0)), np.array([[[4, 0], [20, 0.0]]])) == [
        TemplateLine(kind="CUT", start=(0.0, 0.0), end=(4.0, 0.0))
    ]


def test_example_of_common_spans():
    assert common_spans([(0, 5), (8, 12)], [(3, 10)]) == [(3, 5), (8, 10)]


def test_example_of_lies_over():
    square = shapely.box(0, 0, 9, 9)
    assert (lies_over(square, [shapely.box(9, 0, 20, 9)]), lies_over(square, [shapely.box(8.9, 0, 20, 9)])) == (
        False,
        True,
    )


def test_example_of_lies_within():
    assert lies_within(shapely.box(0, 0, 9, 9), shapely.box(0, 0, 9, 20))
    assert not lies_within(shapely.box(0, 0, 9, 9), shapely.box(0, 0, 8.9, 20))


def test_example_of_is_laid_out():
    folded = Sheet(4, (), "", ((0, 1, 2), (2, 1, 3)))
    assert is_laid_out(folded, np.array([[0, 0], [1, 0], [0, 1], [1, 1.0]]))
    assert not is_laid_out(folded, np.array([[0, 0], [1, 0], [0, 1], [0.1, 0.1]]))


def test_example_of_put_together():
    assert put_together([shapely.box(0, 0, 9, 9), shapely.box(9 + 1e-12, 0, 20, 9)]).geom_type == "Polygon"


def test_example_of_millimetres():
    assert millimetres(np.array([[0, 0], [2, 1.0]]), size=100) == 50.0


def test_example_of_steps_of_folds():
    assert (
        steps_of_folds(
            [Piece((TemplateLine("CUT", (0, 0), (9, 0)), TemplateLine("VALLEY", (0, 5), (9, 5))), (), None)]
        )[1]
        == "Fold 1 valley (blue, dashes: towards you). You see the printed side."
    )


def test_example_of_Plane():
    assert Plane(np.array([[0, 0, 5], [1, 0, 5], [0, 1, 5.0]]), 0).normal.tolist() == [0.0, 0.0, 1.0]
