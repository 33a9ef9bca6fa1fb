"""The precision with which a refused crease pattern would fold flat: how far its vertices are from where it does.

The alternating sums of all vertices are closed by the least displacement. What is stated has to allow both that, and
each sum as it is. Theory: docs/theory/layer-orders.md.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, floor, log10

import numpy as np

from graphs.errors import numbered
from graphs.mechanism.precision import extent_of
from graphs.plain_data import fields_to_json
from graphs.tolerances import DOUBLE, EPSILON, Tolerances
from graphs.types import Floats
from synth.analysis.layering.local import FlatVertex, closing_points, sums_off

COARSEST = 1e-3
"""A coarser precision is not proposed, in units of the extent: with it another pattern is as near as this one."""


@dataclass(frozen=True, slots=True)
class NeededPrecision:
    """A precision that would do.

    Attributes
    ----------
    precision : float
        The least that would, rounded up to one digit, in the unit of the coordinates: the value of ``--precision``.
    moved : float
        How far the vertex that moves most is displaced, in units of the extent.
    orders : int
        The number of layer orders with it.

    Examples
    --------
    >>> str(NeededPrecision(1e-4, 3e-5, 544))
    'with --precision 0.0001: 544 layer orders'
    """

    precision: float
    moved: float
    orders: int

    def __str__(self) -> str:
        return f"with --precision {self.precision:g}: {numbered(self.orders, 'layer order')}"

    def to_json(self) -> dict[str, float]:
        """Return plain data."""
        return fields_to_json(self)


def needed_precision(points: Floats, vertices: Sequence[FlatVertex]) -> tuple[float, float] | None:
    """Return the precision with which all alternating sums are 0, and the displacement, in units of the extent.

    None for a vertex of an odd number of creases, which no precision closes, where the sums are closed by no vertices
    nearby, and where it would be too coarse.
    """
    if any(len(vertex.creases) % 2 for vertex in vertices):
        return None
    extent = extent_of(points)
    closed = closing_points(points, vertices)
    if np.abs(sums_off(closed, vertices)).max(initial=0.0) > DOUBLE.derivative:
        return None
    moved = float(np.linalg.norm(closed - points, axis=1).max(initial=0.0)) / extent
    # both allowances are multiples of the precision, as long as it is far above the rounding of double precision
    times = Tolerances.of(COARSEST).same_point / COARSEST
    sums = max((vertex.off / vertex.allowed_by(points, times * extent) for vertex in vertices), default=0.0)
    needed = max(moved / times, sums)
    return None if needed > COARSEST else (needed, moved)


def rounded_up(number: float) -> float:
    """Return a positive number rounded up to one digit."""
    power = floor(log10(number))
    return float(f"{ceil(number / 10.0**power * (1.0 - 4.0 * EPSILON))}e{power}")
