"""From a drawing in the plane to a pose in space: every vertex gets a height, every panel stays plane.

A panel is the plane z = a x + b y + c over its drawing. Two panels agree along their crease; so round a centre all
axes meet above the point where the creases of the drawing meet, and are parallel above parallel creases. What is
left is linear: the lifts of a drawing are its first-order flexes, J - 2 C - 3 S of them or more, C the number of
centres and S of spatial loops. Source: H. Crapo and W. Whiteley, Statics of frameworks and motions of panel
structures, Structural Topology 6 (1982). Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

import numpy as np

from graphs.errors import UnsolvableError, shown
from graphs.geometry import unit
from graphs.rank.singular_values import null_space
from graphs.tolerances import DOUBLE, MARGIN
from graphs.types import Floats
from synth.realisation.pattern import Pattern

__all__ = ["evenly_folded", "folds_of", "lifted", "planes_over"]

_STEEPEST = 0.8
"""Difference in slope of the two panels at the crease that is folded most: 39 degrees if one is level."""
_STARTS, _ROUNDS = 12, 12


def lifted(pattern: Pattern, places: Floats, random: np.random.Generator) -> tuple[Floats, Floats]:
    """Return places in space above a drawing, every crease folded, as evenly as was found.

    Parameters
    ----------
    pattern : Pattern
    places : float[V, 2]
    random : Generator

    Returns
    -------
    places : float[V, 3]
    turns : float[J]
        Difference of slope of the panels at each crease; above 0 at valleys, seen from above.

    Raises
    ------
    UnsolvableError
        If creases stay straight in every lift.
    """
    middle = places.mean(axis=0)
    planes = planes_over(pattern, places - middle)
    folds = folds_of(pattern, places, planes)
    still = np.abs(folds).max(axis=1, initial=0.0) <= DOUBLE.zero_rate
    if still.any():
        names = ", ".join(shown(pattern.joints[place]) for place in np.flatnonzero(still))
        raise UnsolvableError(f"in every pose above this drawing the panels at joint(s) {names} are one plane")
    weights = evenly_folded(folds, random)
    weights *= _STEEPEST / np.abs(folds @ weights).max(initial=DOUBLE.zero_rate)
    chosen = (planes @ weights).reshape(-1, 3)
    return _above(pattern, places, places - middle, chosen), folds @ weights


def planes_over(pattern: Pattern, places: Floats) -> Floats:
    """Return float[3 N, K]: planes of the panels that agree along creases, the first panel level."""
    panel_at = {(a, b): i for i, p in enumerate(pattern.panels) for a, b in zip(p, (*p[1:], p[0]), strict=True)}
    matrix = np.zeros((2 * len(pattern.creases), 3 * len(pattern.panels)))
    for row, (a, b) in enumerate(pattern.creases):
        one, other = panel_at[a, b], panel_at[b, a]
        for end, vertex in enumerate((a, b)):
            point = [*places[vertex], 1.0]
            matrix[2 * row + end, 3 * one : 3 * one + 3] = point
            matrix[2 * row + end, 3 * other : 3 * other + 3] = [-value for value in point]
    level = np.eye(3, matrix.shape[1])
    return null_space(np.vstack([matrix, level]))


def folds_of(pattern: Pattern, places: Floats, planes: Floats) -> Floats:
    """Return float[J, K]: across each crease, the difference of slope of its panels, for each lift."""
    panel_at = {(a, b): i for i, p in enumerate(pattern.panels) for a, b in zip(p, (*p[1:], p[0]), strict=True)}
    slopes = planes.reshape(len(pattern.panels), 3, -1)[:, :2]
    rows = []
    for a, b in pattern.creases:
        along = places[b] - places[a]
        across = unit([-along[1], along[0]])
        rows.append(across @ (slopes[panel_at[a, b]] - slopes[panel_at[b, a]]))
    return np.array(rows).reshape(len(pattern.creases), -1)


def evenly_folded(folds: Floats, random: np.random.Generator) -> Floats:
    """Return weights of the lifts with which the crease folded least is folded most, of some that are tried.

    From random weights the folds are brought near to 1 or -1, as their signs are, in the mean of squares. Folds
    that are 0 but for rounding are valleys, and of weights that are as good the first are taken.
    """
    best: Floats = np.zeros(folds.shape[1])
    weights: Floats
    most, inverse = -1.0, np.linalg.pinv(folds, rcond=DOUBLE.zero)
    for _ in range(_STARTS):
        weights = np.asarray(random.standard_normal(folds.shape[1]), dtype=np.float64)
        for _ in range(_ROUNDS):
            turns = folds @ weights
            least = _evenness(turns)
            if least > most + MARGIN:
                best, most = weights, least
            signs = np.where(turns < -MARGIN * np.abs(turns).max(initial=0.0), -1.0, 1.0)
            weights = np.asarray(inverse @ signs, dtype=np.float64)
    return best


def _evenness(turns: Floats) -> float:
    """Return the least turn by the largest."""
    return float(np.abs(turns).min(initial=np.inf)) / float(np.abs(turns).max(initial=DOUBLE.zero_rate))


def _above(pattern: Pattern, places: Floats, centred: Floats, planes: Floats) -> Floats:
    """Return the vertices at the height of their panels, in the mean of those that meet there."""
    heights, count = np.zeros(pattern.vertices), np.zeros(pattern.vertices)
    for panel, plane in zip(pattern.panels, planes, strict=True):
        around = list(panel)
        heights[around] += centred[around] @ plane[:2] + plane[2]
        count[around] += 1
    return np.column_stack([places, heights / count])
