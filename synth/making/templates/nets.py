"""Nets as pieces of a template: what is cut, folded and glued, with a tab and a number where two edges meet."""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import isfinite
from typing import Any, NamedTuple

import numpy as np
import shapely

from graphs.errors import InvariantError
from graphs.geometry import across, unit
from graphs.mechanism.sheet import FLAT, Sheet, sides_of_face
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.making.templates.pieces import (
    FOLDS,
    Kind,
    Piece,
    Point,
    TemplateLine,
    Text,
    cut_once,
    lies_over,
    lies_within,
    point_of,
    put_together,
)
from synth.making.templates.unfolding import Net, Panels, laid_across, nets_of

_DEPTHS = (1.0, 0.7, 0.5, 0.35)
_SLANTS = (0.6, 1.0, 2.0, 4.0)
"""How far the ends of a tab run in, in units of its depth."""
_MOST_SLANT = 0.42
"""Part of the edge that each end may run in."""
_LEAST = 2.0
"""Least depth of a tab in millimetres: less holds no glue."""
_CLEAR, _FOOT = 0.3, 1.0
"""Millimetres from a tab to all else, but for its foot: at the ends of its fold it has neighbours."""
_PLAY = 0.5
"""Millimetres by which a slot is longer than its tab, at each end."""
_RIM = 1.5
"""Millimetres of material round a slot, or it tears."""


@dataclass(frozen=True)
class Joins:
    """How edges are joined: by tabs of a depth in millimetres (0 for none), glued, or put through slots.

    Raise InvariantError if the depth is negative or no number.
    """

    depth: float
    slotted: bool = False

    def __post_init__(self) -> None:
        if not (isfinite(self.depth) and self.depth >= 0):
            raise InvariantError("tabs", f"tabs {self.depth!r}", "a number from 0 on")


def tab_shapes(start: Floats, end: Floats, depth: float) -> Iterator[Floats]:
    """Yield tabs, float[4, 2], to try at an edge, the best first: to its right, the ends their first two corners.

    The ends are float[2] and `depth` is the desired one, millimetres.
    """
    length = float(np.linalg.norm(end - start))
    along = (end - start) / length
    right = np.array([along[1], -along[0]])
    for part in _DEPTHS:
        deep = min(part * depth, part * length)
        if deep < _LEAST:
            return
        for slant in _SLANTS:
            if (inset := slant * deep) <= _MOST_SLANT * length:
                yield np.array([start, end, end - inset * along + deep * right, start + inset * along + deep * right])


def slot_of(shape: Floats) -> Floats:
    """Return the slot that a tab goes through half its depth from its fold, as the ends of a cut, float[2, 2]."""
    start, end, after, before = shape
    first, last = (end + after) / 2, (start + before) / 2
    along = unit(first - last)
    return np.array([first + _PLAY * along, last - _PLAY * along])


def tab_at(
    start: Floats,
    end: Floats,
    depth: float,
    material: Sequence[Any],
    panel: Any,
    *,
    in_use: Sequence[Any] = (),
    slotted: bool = False,
) -> Floats | None:
    """Return the tab, float[4, 2], at an edge of a net; None if there is no room.

    The panel lies to the left of the edge; `depth` is the desired one, millimetres. `material` are the net's
    panels and tabs, `panel` is where the panel across the edge would lie, `in_use` are the areas in use on that
    panel (all shapely polygons); `slotted`: the tab goes through a slot of that panel.
    """
    for shape in tab_shapes(start, end, depth):
        polygon = shapely.Polygon(shape)
        if not lies_within(polygon, panel) or lies_over(polygon, in_use):
            continue
        if slotted:
            rim = shapely.LineString(slot_of(shape)).buffer(_RIM)
            if not lies_within(rim, panel) or lies_over(rim, in_use):
                continue
        if not lies_over(polygon, material) and not lies_over(_surroundings(shape), material):
            return shape
    return None


def _surroundings(shape: Floats) -> Any:
    """Return a tab without its foot, and what lies so near that a knife would not part it."""
    start, end, after, before = shape
    (x, y), (left, up) = end - start, before - start
    part = _FOOT * float(np.hypot(x, y)) / abs(x * up - y * left)  # of the depth
    feet = [start + part * (before - start), end + part * (after - end)]
    return shapely.Polygon([feet[0], feet[1], after, before]).buffer(_CLEAR)


_SAME = 1e-6
"""Two laid edges are one if their ends are this close, in millimetres."""
_OFF_SLOT = 0.5
"""Millimetres round a slot in which no other tab lies."""
_OUT = 0.75
"""Where on its edge a name stands."""
_IN = 3.0
"""Millimetres from a glued edge to its number on a panel."""


@dataclass
class _Work:
    """A net on the way to a piece."""

    net: Net
    strokes: list[TemplateLine] = field(default_factory=list)
    texts: list[Text] = field(default_factory=list)
    tabs: list[Any] = field(default_factory=list)
    met: list[TemplateLine] = field(default_factory=list)


@dataclass
class _Glue:
    """The edges glued so far: `numbers` of them, `missing` of these without a tab.

    `on_panel` has the tabs on each panel, and what surrounds its slots, float[4, 2] in the panel's own plane.
    """

    joins: Joins
    on_panel: dict[int, list[Floats]] = field(default_factory=lambda: defaultdict(list))
    numbers: int = 0
    missing: int = 0


class _Side:
    """A panel's side at an edge, as it is laid: the net, the face, its ends with the panel to the left."""

    def __init__(self, panels: Panels, work: _Work, face: int, edge: int) -> None:
        self.work, self.face = work, face
        corners = work.net.corners[face][list(panels.ends(face, edge))]
        self.start, self.end = corners[::-1] if work.net.turned[face] else corners

    def inside(self, depth: float) -> Point:
        """Return a place on the panel, so deep from the middle of the side."""
        along = unit(self.end - self.start)
        place = (self.start + self.end) / 2 + depth * np.array([-along[1], along[0]])
        return point_of(place)


class CutNets(NamedTuple):
    """Nets as pieces, with the edges of each that meet others; how many meet, and of these have no tab."""

    pieces: tuple[Piece, ...]
    met: tuple[tuple[TemplateLine, ...], ...]
    numbers: int
    without_tab: int


def pieces_of_panels(
    sheet: Sheet, places: Floats, joins: Joins, names: Mapping[tuple[int, int], str] | None = None
) -> CutNets:
    """Return the pieces of panels that stand in space, or lie over each other.

    All edges of the sheet are listed; the places are float[vertices, 3], millimetres; names stand beside edges, nearer
    to their second end. Raise UnsolvableError if a panel is not planar, or more than two meet in an edge.
    """
    panels = Panels(sheet, places)
    works = [_Work(net) for net in nets_of(panels)]
    of_face = {face: work for work in works for face in work.net.corners}
    glue = _Glue(joins)
    for edge in panels.joins:
        first, second = (_Side(panels, of_face[face], face, edge) for face in panels.joins[edge])
        apart = float(np.abs([first.start - second.end, first.end - second.start]).max())
        if first.work is second.work and apart <= _SAME:  # the panels lie side by side
            if kind := _kind(panels, edge, first):
                first.work.strokes.append(TemplateLine(kind, point_of(first.start), point_of(first.end)))
            continue
        _glue(panels, edge, (first, second), glue)
    _cut_borders(panels, of_face)
    _name(panels, of_face, names or {})
    met = tuple(tuple(work.met) for work in works)
    return CutNets(tuple(_piece(work) for work in works), met, glue.numbers, glue.missing)


def _kind(panels: Panels, edge: int, side: _Side) -> Kind | None:
    """Return the kind of fold at an edge, seen from the printed side; None for a flat edge.

    It follows from the letter, else from the fold angle of the configuration; a flat one leaves it open.
    """
    letter = panels.sheet.assignments[edge]
    if letter in FLAT:
        return None
    if letter not in "MV":
        angle = panels.fold_angle(edge)
        if panels.joins[edge][0] != side.face and panels.go_one_way(edge):
            angle = -angle
        letter = "U" if abs(angle) < DOUBLE.same_configuration else "V" if angle > 0 else "M"
    if side.work.net.turned[side.face] and letter in "MV":
        letter = "M" if letter == "V" else "V"
    return FOLDS[letter]


def _glue(panels: Panels, edge: int, sides: tuple[_Side, _Side], glue: _Glue) -> None:
    """Put a tab at one of two sides that meet, and a number at both."""
    glue.numbers += 1
    number = str(glue.numbers)
    for here, there in (sides, sides[::-1]):
        net = here.work.net
        laid, _ = laid_across(panels, edge, here.face, net.corners[here.face], turned=net.turned[here.face])
        own = panels.planes[there.face].flat
        in_use = [shapely.Polygon(_carried(shape, own, laid)) for shape in glue.on_panel[there.face]]
        panel = shapely.Polygon(laid)
        material = [*net.polygons(), *here.work.tabs]
        joins = glue.joins
        shape = tab_at(here.start, here.end, joins.depth, material, panel, in_use=in_use, slotted=joins.slotted)
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
    """Return a shape that moves with a panel, whose corners move from `was` to `now`."""
    motion = np.linalg.lstsq(np.column_stack([was, np.ones(len(was))]), now)[0]
    carried: Floats = np.column_stack([shape, np.ones(len(shape))]) @ motion
    return carried


def _add_tab(side: _Side, shape: Floats, kind: Kind | None, number: str) -> None:
    """Add a tab to the piece of a side: fold its base, cut its other sides."""
    work = side.work
    work.tabs.append(shapely.Polygon(shape))
    start, end, after, before = map(point_of, shape)
    if kind is not None:
        work.strokes.append(TemplateLine(kind, start, end))
    work.strokes += [TemplateLine("CUT", *ends) for ends in ((start, before), (before, after), (after, end))]
    work.texts.append(Text(point_of(shape.mean(axis=0)), number))


def _add_slot(side: _Side, slot: Floats, laid: Floats, own: Floats, glue: _Glue) -> None:
    """Cut a slot, given where its panel lies across the edge and in its own plane, and keep other tabs off it."""
    start, end = _carried(slot, laid, side.work.net.corners[side.face])
    side.work.strokes.append(TemplateLine("CUT", point_of(start), point_of(end)))
    round_it = shapely.LineString(slot).buffer(_OFF_SLOT, cap_style="square")
    glue.on_panel[side.face].append(_carried(np.array(round_it.exterior.coords[:-1]), laid, own))


def _cut(side: _Side, number: str, *, beyond: float = 0.0) -> None:
    """Cut along a side that is joined to another, and put its number inside, beyond a tab's depth."""
    side.work.met.append(TemplateLine("CUT", point_of(side.start), point_of(side.end)))
    side.work.strokes.append(side.work.met[-1])
    side.work.texts.append(Text(side.inside(_IN + beyond), number))


def _cut_borders(panels: Panels, of_face: dict[int, _Work]) -> None:
    """Cut along sides of panels without a neighbour."""
    joined = {frozenset(panels.sheet.edges[edge]) for edge in panels.joins}
    for face, work in of_face.items():
        for corner, side in enumerate(sides_of_face(panels.sheet.faces[face])):
            if frozenset(side) not in joined:
                corners = work.net.corners[face]
                ends = point_of(corners[corner]), point_of(corners[(corner + 1) % len(corners)])
                work.strokes.append(TemplateLine("CUT", *ends))


def _name(panels: Panels, of_face: dict[int, _Work], names: Mapping[tuple[int, int], str]) -> None:
    """Write names beside edges on all panels that they border."""
    for (first, second), name in names.items():
        for face, around in enumerate(panels.sheet.faces):
            if first in around and second in around:
                corners = of_face[face].net.corners[face]
                start, end = corners[around.index(first)], corners[around.index(second)]
                place = start + _OUT * (end - start)
                inwards = across(corners.mean(axis=0) - place, unit(end - start))
                of_face[face].texts.append(Text(point_of(place + _IN * unit(inwards)), name))


def _piece(work: _Work) -> Piece:
    covered = put_together([*work.net.polygons(), *work.tabs])
    return Piece(tuple(cut_once(work.strokes)), tuple(work.texts), covered)
