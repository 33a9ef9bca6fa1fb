"""Tabs to glue: outside the outline of a net, hinged at the edge that is glued, inside the panel that they go on.

A tab takes the place that the panel across the edge has where both lie in one plane. It is glued on that panel, so
it must lie within it, off what is glued there already: then it passes no crease, and hinders no folding.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Any

import numpy as np
import shapely

from graphs.errors import InvariantError
from graphs.geometry import unit
from graphs.types import Floats
from synth.templates.pieces.overlaps import lies_over, lies_within

__all__ = ["Joins", "slot_of", "tab_at", "tab_shapes"]

_DEPTHS = (1.0, 0.7, 0.5, 0.35)
_SLANTS = (0.6, 1.0, 2.0, 4.0)
"""How far the ends of a tab run in, in units of its depth."""
_MOST_SLANT = 0.42
"""Part of the edge that each end may run in."""
_LEAST = 2.0
"""Millimetres: what is less deep holds no glue."""
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

    >>> next(tab_shapes(np.array([0, 0.0]), np.array([0, 40.0]), 8)).tolist()
    [[0.0, 0.0], [0.0, 40.0], [8.0, 35.2], [8.0, 4.8]]
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
                yield np.array(
                    [start, end, end - inset * along + deep * right, start + inset * along + deep * right]
                )


def slot_of(shape: Floats) -> Floats:
    """Return the slot that a tab goes through half its depth from its fold, as the ends of a cut, float[2, 2].

    >>> slot_of(np.array([[0.0, 0.0], [0.0, 40.0], [8.0, 36.0], [8.0, 4.0]])).tolist()
    [[4.0, 38.5], [4.0, 1.5]]
    """
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
    taken: Sequence[Any] = (),
    slotted: bool = False,
) -> Floats | None:
    """Return the tab, float[4, 2], at an edge of a net; None if there is no room.

    The panel lies to the left of the edge; `depth` is the desired one, millimetres. `material` are the net's
    panels and tabs, `panel` is where the panel across the edge would lie, `taken` are the areas in use on that
    panel (all shapely polygons); `slotted`: the tab goes through a slot of that panel.
    """
    for shape in tab_shapes(start, end, depth):
        polygon = shapely.Polygon(shape)
        if not lies_within(polygon, panel) or lies_over(polygon, taken):
            continue
        if slotted and not _has_rim(slot_of(shape), panel, taken):
            continue
        if not lies_over(polygon, material) and not lies_over(_surroundings(shape), material):
            return shape
    return None


def _has_rim(slot: Floats, panel: Any, taken: Sequence[Any]) -> bool:
    """Tell whether there is material round a slot: within its panel, and off what is there already."""
    around = shapely.LineString(slot).buffer(_RIM)
    return lies_within(around, panel) and not lies_over(around, taken)


def _surroundings(shape: Floats) -> Any:
    """Return a tab without its foot, and what lies so near that a knife would not part it."""
    start, end, after, before = shape
    (x, y), (left, up) = end - start, before - start
    part = _FOOT * float(np.hypot(x, y)) / abs(x * up - y * left)  # of the depth
    feet = [start + part * (before - start), end + part * (after - end)]
    return shapely.Polygon([feet[0], feet[1], after, before]).buffer(_CLEAR)
