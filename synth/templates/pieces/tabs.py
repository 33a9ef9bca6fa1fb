"""Tabs to glue: outside the outline of a net, hinged at the edge that is glued, inside the panel that they go on.

A tab takes the place that the panel across the edge has where both lie in one plane. It is glued on that panel, so
it must lie within it, off what is glued there already: then it passes no crease, and hinders no folding.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import isfinite
from typing import Any

import numpy as np
import shapely

from graphs.arrays import Floats
from graphs.errors import InvariantError

__all__ = ["Joins", "slot_of", "tab_at", "tab_shapes"]

_DEPTHS = (1.0, 0.7, 0.5, 0.35)
_SLANTS = (0.6, 1.0, 2.0, 4.0)
"""How far the ends of a tab run in, in units of its depth."""
_MOST_SLANT = 0.42
"""Part of the edge that each end may run in."""
_LEAST = 2.0
"""Millimetres: what is less deep holds no glue."""
_TINY = 1e-6
_PLAY = 0.5
"""Millimetres by which a slot is longer than its tab, at each end."""
_RIM = 1.5
"""Millimetres of material round a slot, or it tears."""


@dataclass(frozen=True)
class Joins:
    """How edges are joined.

    Parameters
    ----------
    depth : float
        Of tabs, millimetres; 0 for none.
    slotted : bool
        Whether tabs go through slots; else they are glued.

    Raises
    ------
    InvariantError
        If the depth is no number from 0 on.
    """

    depth: float
    slotted: bool = False

    def __post_init__(self) -> None:
        if not (isfinite(self.depth) and self.depth >= 0):
            raise InvariantError("tabs", f"tabs {self.depth!r}", "a number from 0 on")


def tab_shapes(start: Floats, end: Floats, depth: float) -> Iterator[Floats]:
    """Yield tabs at an edge to try, the best ones first: to the right of it, its first two corners the ends.

    Parameters
    ----------
    start, end : float[2]
        Millimetres.
    depth : float
        That is asked for.

    Yields
    ------
    float[4, 2]

    Examples
    --------
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

    Examples
    --------
    >>> slot_of(np.array([[0.0, 0.0], [0.0, 40.0], [8.0, 36.0], [8.0, 4.0]])).tolist()
    [[4.0, 38.5], [4.0, 1.5]]
    """
    start, end, after, before = shape
    first, last = (end + after) / 2, (start + before) / 2
    along = (first - last) / np.linalg.norm(first - last)
    return np.array([first + _PLAY * along, last - _PLAY * along])


def tab_at(
    start: Floats, end: Floats, depth: float, material: list[Any], across: Any, *, slotted: bool = False
) -> Floats | None:
    """Return the tab at an edge of a net, None if there is no room.

    Parameters
    ----------
    start, end : float[2]
        The panel lies to the left.
    depth : float
        That is asked for, millimetres.
    material : list of shapely polygon
        The net's panels and tabs.
    across : shapely geometry
        Where the panel across the edge would lie, without what is glued on it already.
    slotted : bool, optional
        Whether the tab goes through a slot of that panel.
    """
    for shape in tab_shapes(start, end, depth):
        polygon = shapely.Polygon(shape)
        least = _TINY * polygon.area
        if shapely.area(shapely.difference(polygon, across)) > least:
            continue
        if slotted and not across.contains(shapely.LineString(slot_of(shape)).buffer(_RIM)):
            continue
        if float(np.max(shapely.area(shapely.intersection(polygon, material)))) <= least:
            return shape
    return None
