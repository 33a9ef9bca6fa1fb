"""Searches: the steps of least squares along a curved valley."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from drawings.altered import cropped, thinned
from drawings.pieces import of_shapes
from drawings.together import beside, said
from graphs.least_squares.levenberg_marquardt import LevenbergMarquardt, Minimum, least_squares
from graphs.types import Floats
from synth.making.drawing import Scene
from synth.making.drawing.scene.shapes import FINE, NORMAL, Disc, Line, Point, Shape

__all__ = ["DRAWINGS", "in_a_valley"]

_RADIUS = 80.0
_STEEP = 300.0
"""How much steeper the valley is across than along."""
_BEGIN = 2.4
"""Radians from the solution to the start."""
_RULE = LevenbergMarquardt(
    first=1e-2, raised=16.0, lowered=(25.0, 6.25, 2.25), poor=0.25, good=0.5, longest=1.0, most_trials=3000
)


def valley() -> Scene:
    """Least squares along a curved valley: with second-order corrections, and without."""
    return beside(*(_search(corrections) for corrections in (2, 0)), gap=40.0)


def in_a_valley(corrections: int, most_steps: int | None = None) -> Minimum:
    """Return the search along a circle, float[2], to its end at (1, 0), or after so many steps."""
    start = np.array([np.cos(_BEGIN), np.sin(_BEGIN)])
    found = least_squares(_valley, start, replace(_RULE, corrections=corrections, most_steps=most_steps))
    assert found is not None
    return found


def _valley(x: Floats) -> tuple[Floats, Floats]:
    radius, turn = np.hypot(*x), np.arctan2(x[1], x[0])
    across, along = x / radius, np.array([-x[1], x[0]]) / radius**2
    return np.array([_STEEP * (radius - 1.0), turn]), np.array([_STEEP * across, along])


def _search(corrections: int) -> Scene:
    end = in_a_valley(corrections)
    places = [_on_page(in_a_valley(corrections, steps).at.unknowns) for steps in range(end.steps + 1)]
    ground = [_on_page(np.array([np.cos(turn), np.sin(turn)])) for turn in np.linspace(-0.3, 2.7, 90)]
    shapes: list[Shape] = [Line(ground, "faint", 6.0), Line(places, "class0", NORMAL)]
    shapes += [Disc(place, 1.8, "class0") for place in places]
    shapes.append(Disc(_on_page(np.array([1.0, 0.0])), 4.0, None, "ink", FINE))
    name = "with corrections" if corrections else "without"
    return said(cropped(thinned(of_shapes(1.0, 1.0, shapes))), name, f"{end.steps} steps, {end.trials} trials")


def _on_page(place: Floats) -> Point:
    return _RADIUS * float(place[0]), -_RADIUS * float(place[1])


DRAWINGS: dict[str, Callable[[], Scene]] = {"least-squares": valley}
