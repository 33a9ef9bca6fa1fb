"""Curves against an axis: a frame with ticks in which numbers have places on the page."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import ceil, floor, log10

from graphs.types import Floats
from synth.drawing.scene.palette import FINE, NORMAL, SMALL
from synth.drawing.scene.shapes import Label, Line, Point, Shape

__all__ = ["Plot", "round_steps", "signed"]

_TICK = 3.0
_STEPS = (1.0, 2.0, 5.0, 10.0)


@dataclass(frozen=True, slots=True)
class Plot:
    """A rectangle of the page, in points, on which numbers are drawn against each other.

    `x` and `y` are the numbers at its edges: left and right, below and above.
    """

    left: float
    top: float
    width: float
    height: float
    x: tuple[float, float]
    y: tuple[float, float]

    def at(self, x: float, y: float) -> Point:
        """Return where a pair of numbers lies."""
        across = (x - self.x[0]) / (self.x[1] - self.x[0])
        up = (y - self.y[0]) / (self.y[1] - self.y[0])
        return self.left + across * self.width, self.top + (1 - up) * self.height

    def row(self, x: Floats, y: Floats) -> list[Point]:
        """Return the points of a curve on the page.

        >>> import numpy as np
        >>> Plot(0, 0, 10, 10, (0, 1), (0, 2)).row(np.array([0, 1]), np.array([0, 1]))
        [(0.0, 10.0), (10.0, 5.0)]
        """
        return [self.at(*pair) for pair in zip(x.tolist(), y.tolist(), strict=True)]

    def below(self, ticks: Iterable[float], name: str) -> list[Shape]:
        """Return the axis below with its ticks, their numbers and its name."""
        floor_ = self.top + self.height
        shapes: list[Shape] = [Line([(self.left, floor_), (self.left + self.width, floor_)], "ink", NORMAL)]
        for tick in ticks:
            x, _ = self.at(tick, self.y[0])
            shapes.append(Line([(x, floor_), (x, floor_ + _TICK)], "ink", FINE))
            shapes.append(Label((x, floor_ + 2.2 * SMALL / 2 + 2), signed(tick), SMALL, halo=False))
        shapes.append(Label((self.left + self.width / 2, floor_ + 2.9 * SMALL), name, SMALL, halo=False))
        return shapes

    def beside(self, ticks: Iterable[float], name: str) -> list[Shape]:
        """Return the axis on the left with its ticks and their numbers; its name stands above it."""
        shapes: list[Shape] = [Line([(self.left, self.top), (self.left, self.top + self.height)], "ink", NORMAL)]
        for tick in ticks:
            _, y = self.at(self.x[0], tick)
            shapes.append(Line([(self.left - _TICK, y), (self.left, y)], "ink", FINE))
            text = signed(tick)
            shapes.append(Label((self.left - 2 * _TICK - 0.31 * SMALL * len(text), y), text, SMALL, halo=False))
        shapes.append(Label((2.0, self.top - 1.5 * SMALL), name, SMALL, anchor="start", halo=False))
        return shapes


def round_steps(low: float, high: float, most: int = 7) -> list[float]:
    """Return at most so many round numbers from low to high (not equal), equally far from each other.

    >>> round_steps(0, 30.2), round_steps(2.51, 3.74)
    ([0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0], [2.6, 2.8, 3.0, 3.2, 3.4, 3.6])
    """
    rough = (high - low) / most
    size = 10.0 ** floor(log10(rough))
    step = next(size * factor for factor in _STEPS if size * factor >= rough * (1 - 1e-9))
    first, last = ceil(low / step - 1e-9), floor(high / step + 1e-9)
    return [float(f"{number * step:.12g}") for number in range(first, last + 1)]


def signed(number: float) -> str:
    """Return a number as axes and legends show it, with a minus as long as a plus.

    >>> signed(-180.0), signed(2.5)
    ('−180', '2.5')
    """
    return f"{number:.6g}".replace("-", "−")
