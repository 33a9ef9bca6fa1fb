"""Linkages of closed form: what gives a linkage its axes, though its file or its record holds none."""

from abc import ABC, abstractmethod
from typing import NamedTuple

from graphs.loops.loop import Centre
from graphs.mechanism.sc import SCGraph
from graphs.types import Floats


class PlacedChain(NamedTuple):
    """A chain with its axes, points and directions float[J, 3], which all meet in a point, or are all parallel."""

    chain: SCGraph
    points: Floats
    directions: Floats
    centre: Centre


class ClosedFormLinkage(ABC):
    """A linkage whose axes follow from a few numbers; what takes mechanisms with coordinates takes it too.

    A class of such linkages derives from this one, and so need not be known where it is placed.
    """

    __slots__ = ()

    @abstractmethod
    def placed_chain(self, body: Floats | None = None) -> PlacedChain:
        """Return its axes, of a guided linkage with its body turned by float[3, 3]; or raise `UnsolvableError`."""
