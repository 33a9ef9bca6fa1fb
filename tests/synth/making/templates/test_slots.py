"""Tabs that go through slots: where they are, how long, and off all else."""

import numpy as np
import pytest
import shapely

from synth.catalogue.patterns._generate import generate
from synth.making.templates.template import template_of

THINGS = {
    "carton": generate("crash-lock").mechanism,
    "tube": generate("miura-tube").mechanism,
    "storey": generate("kresling").mechanism,
}


@pytest.fixture(params=THINGS.values(), ids=THINGS.keys())
def made(request):
    return [template_of(request.param, size=160, tabs=12, slots=slots) for slots in (False, True)]


def slots_of(template):
    """Cuts that meet no other line."""
    found = []
    for piece in template.pieces:
        lines = [shapely.LineString([s.start, s.end]) for s in piece.strokes]
        for stroke, line in zip(piece.strokes, lines, strict=True):
            if stroke.kind == "CUT" and all(line is other or line.distance(other) > 0.1 for other in lines):
                found.append((line, piece))
    return found


def tabs_of(template):
    """Number to the tab with it: a part of the material with four sides, one of them folded, the others cut."""
    tabs = {}
    for piece in template.pieces:
        every = shapely.union_all([shapely.LineString([s.start, s.end]) for s in piece.strokes], grid_size=1e-7)
        folds = shapely.union_all(
            [shapely.LineString([s.start, s.end]) for s in piece.strokes if s.kind != "CUT"]
        ).buffer(1e-4)
        for area in shapely.polygonize([every]).geoms:
            corners = np.array(area.exterior.coords[:-1])
            words = [t.words for t in piece.texts if np.abs(corners.mean(axis=0) - t.at).max() < 1e-3]
            if words and area.boundary.intersection(folds).length > 0:
                tabs[words[0]] = area
    return tabs


def test_each_tab_has_a_slot_a_millimetre_longer_than_it_is_half_way(made):
    _, slotted = made
    slots, tabs = slots_of(made[1]), tabs_of(slotted)
    assert len(slots) == len(tabs) > 0
    wide = []
    for tab in tabs.values():
        corners = np.array(tab.exterior.coords[:-1])
        sides = sorted(np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=1))
        base = sides[-1]
        # of a trapezoid with base and top parallel, half way it is as wide as their mean
        tops = [side for side in sides[:-1] if side != base]
        wide.append([(base + top) / 2 + 1.0 for top in tops])
    lengths = sorted(slot.length for slot, _ in slots)
    for length in lengths:
        assert min(abs(length - one) for row in wide for one in row) < 1e-6


def test_slots_lie_within_panels_with_a_rim_and_off_each_other(made):
    slots = slots_of(made[1])
    for slot, piece in slots:
        folds = [shapely.LineString([s.start, s.end]) for s in piece.strokes if s.kind != "CUT"]
        assert piece.covered.contains(slot.buffer(1.4))
        assert min(fold.distance(slot) for fold in folds) >= 1.4
        for other, where in slots:
            if where is piece and other is not slot:
                assert other.distance(slot) >= 0.9


def test_the_steps_say_how_tabs_hold(made):
    glued, slotted = made
    assert any("through slots" in step for step in slotted.steps)
    assert any(step.startswith("Glue") for step in glued.steps)
    assert not any("through slots" in step for step in glued.steps)
    assert slots_of(glued) == []
