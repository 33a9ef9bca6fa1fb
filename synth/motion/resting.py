"""What a motion of a sheet says of its panels: frames in which they pass through each other, how they lie at its end.

Theory: docs/theory/folding.md, docs/theory/layer-orders.md.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple

from graphs.errors import numbered
from synth.motion.path import Path


@dataclass(frozen=True, slots=True)
class RestingPanels:
    """Panels that lie on each other in the last frame of a motion.

    Attributes
    ----------
    planes : tuple of tuple of int
        The panels in each plane; those that unfolded creases join count as one, by the lowest number.
    orders : int or None
        The number of layer orders with which the motion can end; None if there are too many panels to count them.

    Examples
    --------
    >>> RestingPanels(((0, 1), (2, 3)), 1).line()
    'ends with panels on each other in 2 planes, in 1 layer order'
    """

    planes: tuple[tuple[int, ...], ...]
    orders: int | None

    def line(self) -> str:
        """Return it in one line."""
        where = f"ends with panels on each other in {numbered(len(self.planes), 'plane')}"
        if self.orders is None:
            return f"{where}; their layer orders were not counted"
        return f"{where}, in {numbered(self.orders, 'layer order')}" if self.orders else f"{where}, in no layer order"

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {"planes": [list(plane) for plane in self.planes], "orders": self.orders}


class PassedPanels(NamedTuple):
    """A path with the event that panels pass through each other, frames in which they do, how they lie at its end."""

    path: Path
    frames: tuple[int, ...] = ()
    resting: RestingPanels | None = None
