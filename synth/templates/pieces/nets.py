"""Nets as pieces of a template: what is cut, folded and glued, with a tab and a number where two edges meet.

Theory: docs/theory/templates.md.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
import shapely

from graphs.geometry import unit
from graphs.mechanism.sheet import FLAT, Sheet, sides_of_face
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.templates.lines import Kind, Piece, Point, Stroke, Text
from synth.templates.pieces.cuts import cut_once
from synth.templates.pieces.flat import FOLDS, put_together
from synth.templates.pieces.tabs import Joins, slot_of, tab_at
from synth.templates.pieces.unfolding import Net, Panels, across, nets_of, panels_of

__all__ = ["CutNets", "pieces_of_panels"]

_SAME = 1e-6
"""Two laid edges are one if their ends are this close, in millimetres."""
_OFF_SLOT = 0.5
"""Millimetres round a slot in which no other tab lies."""
_IN = 3.0
"""Millimetres from a glued edge to its number on a panel."""


@dataclass
class _Work:
    """A net on the way to a piece."""

    net: Net
    strokes: list[Stroke] = field(default_factory=list)
    texts: list[Text] = field(default_factory=list)
    tabs: list[Any] = field(default_factory=list)
    met: list[Stroke] = field(default_factory=list)


@dataclass
class _Glue:
    """The edges glued so far: `numbers` of them, `missing` of these without a tab.

    `on_panel` has the tabs on each panel, and what surrounds its slots, float[4, 2] in the panel's own plane.
    """

    joins: Joins
    on_panel: dict[int, list[Floats]] = field(default_factory=lambda: defaultdict(list))
    numbers: int = 0
    missing: int = 0

    def next_number(self) -> str:
        """Return the number of the next edge that is glued."""
        self.numbers += 1
        return str(self.numbers)


@dataclass(frozen=True)
class _Side:
    """A panel's side that is glued: the net, the face, its ends with the panel to the left."""

    work: _Work
    face: int
    start: Floats
    end: Floats

    def inside(self, depth: float) -> Point:
        """Return a place on the panel, so deep from the middle of the side."""
        along = unit(self.end - self.start)
        place = (self.start + self.end) / 2 + depth * np.array([-along[1], along[0]])
        return _point(place)


class CutNets(NamedTuple):
    """Nets as pieces, with the edges of each that meet others; how many meet, and of these have no tab."""

    pieces: tuple[Piece, ...]
    met: tuple[tuple[Stroke, ...], ...]
    numbers: int
    without_tab: int


def pieces_of_panels(sheet: Sheet, places: Floats, joins: Joins) -> CutNets:
    """Return the pieces of panels that stand in space, or lie over each other.

    All edges of the sheet are listed; the places are float[vertices, 3], millimetres. Raise UnsolvableError if a
    panel is not planar, or more than two meet in an edge.
    """
    panels = panels_of(sheet, places)
    works = [_Work(net) for net in nets_of(panels)]
    of_face = {face: work for work in works for face in work.net.corners}
    glue = _Glue(joins)
    for edge in panels.joins:
        first, second = (_side(panels, of_face[face], face, edge) for face in panels.joins[edge])
        if _are_one(first, second):
            if kind := _kind(panels, edge, first):
                first.work.strokes.append(Stroke(kind, _point(first.start), _point(first.end)))
            continue
        _glue(panels, edge, (first, second), glue)
    _cut_borders(panels, of_face)
    met = tuple(tuple(work.met) for work in works)
    return CutNets(tuple(_piece(work) for work in works), met, glue.numbers, glue.missing)


def _side(panels: Panels, work: _Work, face: int, edge: int) -> _Side:
    """Return the side of a panel at an edge, as it is laid."""
    a, b = panels.ends(face, edge)
    if work.net.turned[face]:
        a, b = b, a
    corners = work.net.corners[face]
    return _Side(work, face, corners[a], corners[b])


def _are_one(first: _Side, second: _Side) -> bool:
    """Tell whether the panels lie side by side at an edge."""
    if first.work is not second.work:
        return False
    apart = np.abs([first.start - second.end, first.end - second.start])
    return float(apart.max()) <= _SAME


def _kind(panels: Panels, edge: int, side: _Side) -> Kind | None:
    """Return how an edge is folded, seen from the side that is printed; None where it is not.

    A letter says it, and where there is none the pose: a flat pose says nothing.
    """
    letter = panels.sheet.assignments[edge]
    if letter in FLAT:
        return None
    if letter not in "MV":
        angle = panels.fold_angle(edge)
        if panels.joins[edge][0] != side.face and _differ(panels, edge):
            angle = -angle
        letter = "U" if abs(angle) < DOUBLE.same_configuration else "V" if angle > 0 else "M"
    if side.work.net.turned[side.face] and letter in "MV":
        letter = "M" if letter == "V" else "V"
    return FOLDS[letter]


def _differ(panels: Panels, edge: int) -> bool:
    """Tell whether the corners of the two panels at an edge go round in different ways."""
    first, second = panels.joins[edge]
    a, _ = panels.ends(first, edge)
    c, _ = panels.ends(second, edge)
    return panels.sheet.faces[first][a] == panels.sheet.faces[second][c]


def _glue(panels: Panels, edge: int, sides: tuple[_Side, _Side], glue: _Glue) -> None:
    """Put a tab at one of two sides that meet, and a number at both."""
    number = glue.next_number()
    for here, there in (sides, sides[::-1]):
        net = here.work.net
        laid, _ = across(panels, edge, here.face, net.corners[here.face], turned=net.turned[here.face])
        own = panels.planes[there.face].flat
        taken = [shapely.Polygon(_carried(shape, own, laid)) for shape in glue.on_panel[there.face]]
        panel = shapely.Polygon(laid)
        material = [*net.polygons(), *here.work.tabs]
        joins = glue.joins
        shape = None
        if joins.depth:
            shape = tab_at(here.start, here.end, joins.depth, material, panel, taken=taken, slotted=joins.slotted)
        if shape is None:
            continue
        glue.on_panel[there.face].append(_carried(shape, laid, own))
        _add_tab(here, shape, _kind(panels, edge, here), number)
        if joins.slotted:
            _add_slot(there, slot_of(shape), laid, own, glue)
        _cut(there, number, beyond=joins.depth if joins.slotted else 0.0)
        return
    glue.missing += 1
    for side in sides:
        _cut(side, number)


def _carried(shape: Floats, was: Floats, now: Floats) -> Floats:
    """Return a shape that moves with a panel, from where its corners were to where they are now."""
    motion = np.linalg.lstsq(np.column_stack([was, np.ones(len(was))]), now)[0]
    carried: Floats = np.column_stack([shape, np.ones(len(shape))]) @ motion
    return carried


def _add_tab(side: _Side, shape: Floats, kind: Kind | None, number: str) -> None:
    """Add a tab to the piece of a side: its base is folded, its other sides are cut."""
    work = side.work
    work.tabs.append(shapely.Polygon(shape))
    start, end, after, before = map(_point, shape)
    if kind is not None:
        work.strokes.append(Stroke(kind, start, end))
    work.strokes += [Stroke("CUT", *ends) for ends in ((start, before), (before, after), (after, end))]
    work.texts.append(Text(_point(shape.mean(axis=0)), number))


def _add_slot(side: _Side, slot: Floats, laid: Floats, own: Floats, glue: _Glue) -> None:
    """Cut a slot, given where its panel lies across the edge and in its own plane, and keep other tabs off it."""
    start, end = _carried(slot, laid, side.work.net.corners[side.face])
    side.work.strokes.append(Stroke("CUT", _point(start), _point(end)))
    round_it = shapely.LineString(slot).buffer(_OFF_SLOT, cap_style="square")
    glue.on_panel[side.face].append(_carried(np.array(round_it.exterior.coords[:-1]), laid, own))


def _cut(side: _Side, number: str, *, beyond: float = 0.0) -> None:
    """Cut along a side that is joined to another, and put its number inside, beyond a tab's depth."""
    side.work.met.append(Stroke("CUT", _point(side.start), _point(side.end)))
    side.work.strokes.append(side.work.met[-1])
    side.work.texts.append(Text(side.inside(_IN + beyond), number))


def _cut_borders(panels: Panels, of_face: dict[int, _Work]) -> None:
    """Cut along sides of panels at which nothing hangs."""
    joined = {frozenset(panels.sheet.edges[edge]) for edge in panels.joins}
    for face, work in of_face.items():
        for corner, side in enumerate(sides_of_face(panels.sheet.faces[face])):
            if frozenset(side) not in joined:
                corners = work.net.corners[face]
                ends = _point(corners[corner]), _point(corners[(corner + 1) % len(corners)])
                work.strokes.append(Stroke("CUT", *ends))


def _piece(work: _Work) -> Piece:
    covered = put_together([*work.net.polygons(), *work.tabs])
    return Piece(tuple(cut_once(work.strokes)), tuple(work.texts), covered)


def _point(place: Floats) -> Point:
    return float(place[0]), float(place[1])
