"""Whether shapes lie over each other, and overlays of them that are to be trusted.

Where edges all but coincide, as those of a tab and of the panel that it is glued on do, the overlay of GEOS in
floating point was seen to give a difference without area that has seven square millimetres, and a union without
one of its parts. Predicates are decided by exact signs; overlays on a grid, of shapes rounded to it, go well.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import shapely

__all__ = ["GRID", "lies_over", "lies_within", "united"]

GRID = 1e-7
"""Millimetres, to which corners of overlays are rounded."""

_INSIDE = 1e-4
"""Millimetres by which a shape is made smaller: what is so close to an edge is on it."""


def united(shapes: Sequence[Any]) -> Any:
    """Return the area that shapes cover, its corners rounded to the grid."""
    return shapely.union_all(shapely.set_precision(list(shapes), GRID), grid_size=GRID)


def lies_over(shape: Any, others: Sequence[Any]) -> bool:
    """Say whether a shapely polygon (millimetres) shares more than an edge with one of others.

    >>> square = shapely.box(0, 0, 9, 9)
    >>> lies_over(square, [shapely.box(9, 0, 20, 9)]), lies_over(square, [shapely.box(8.9, 0, 20, 9)])
    (False, True)
    """
    return bool(shapely.intersects(shape.buffer(-_INSIDE), list(others)).any())


def lies_within(shape: Any, area: Any) -> bool:
    """Say whether a shape lies within an area, up to its edge.

    >>> lies_within(shapely.box(0, 0, 9, 9), shapely.box(0, 0, 9, 20))
    True
    >>> lies_within(shapely.box(0, 0, 9, 9), shapely.box(0, 0, 8.9, 20))
    False
    """
    return bool(shapely.covers(area, shape.buffer(-_INSIDE)))
