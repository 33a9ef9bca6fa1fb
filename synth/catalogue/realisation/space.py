"""From drawings to configurations in space: lifts, and projective maps by which centres recede to infinity.

A lift gives every vertex a height, and keeps every panel planar: the plane z = a x + b y + c over its drawing. Two
panels agree along their crease; so round a centre all axes meet above the point where the creases of the drawing
meet, and are parallel above parallel creases. The lifts of a drawing are a linear space, its first-order flexes.

A projective map keeps planar panels planar, axes that meet meeting, and first-order freedoms. One that takes a
plane through centres to infinity makes the axes through each of them parallel; panels stay bounded if the plane
meets none. Whether a drawing has such a lift is a linear program.

Source: H. Crapo and W. Whiteley, Statics of frameworks and motions of panel structures, Structural Topology 6
(1982). Theory: docs/theory/realisation.md.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy

from graphs.errors import UnsolvableError
from graphs.geometry import area_vector, lines_meet, unit
from graphs.rank.singular_values import null_space
from graphs.tolerances import DOUBLE, MARGIN
from graphs.types import Floats
from synth.catalogue.realisation.pattern import Pattern, Pointing, listed

_STEEPEST = 0.8
"""Difference in slope of the two panels at the crease that is folded most: 39 degrees if one is level."""
_STARTS, _ROUNDS = 12, 12


def lifted(pattern: Pattern, places: Floats, random: np.random.Generator) -> tuple[Floats, Floats]:
    """Return places in space above a drawing, float[V, 3], every crease folded as evenly as was found, and folds.

    Places in the drawing are float[V, 2]. The folds, float[J], are the differences of slope of the panels at each
    crease; above 0 at valleys, seen from above. Raises `UnsolvableError` if creases stay straight in every lift.
    """
    middle = places.mean(axis=0)
    planes = planes_over(pattern, places - middle)
    folds = folds_of(pattern, places, planes)
    coplanar = np.flatnonzero(np.abs(folds).max(axis=1, initial=0.0) <= DOUBLE.zero_rate)
    if len(coplanar):
        joints = listed("joint", (pattern.joints[place] for place in coplanar))
        raise UnsolvableError(f"in every configuration above this drawing the panels at {joints} are coplanar")
    weights = evenly_folded(folds, random)
    weights *= _STEEPEST / np.abs(folds @ weights).max(initial=DOUBLE.zero_rate)
    chosen = (planes @ weights).reshape(-1, 3)
    heights, count = np.zeros((2, pattern.vertices))  # the mean of the panels that meet there
    for panel, plane in zip(pattern.panels, chosen, strict=True):
        around = list(panel)
        heights[around] += (places - middle)[around] @ plane[:2] + plane[2]
        count[around] += 1
    return np.column_stack([places, heights / count]), folds @ weights


def planes_over(pattern: Pattern, places: Floats) -> Floats:
    """Return float[3 N, K]: planes of the panels that agree along creases, the first panel level."""
    matrix = np.zeros((2 * len(pattern.creases), 3 * len(pattern.panels)))
    for row, (a, b) in enumerate(pattern.creases):
        left, right = pattern.panel_of_side[a, b], pattern.panel_of_side[b, a]
        for end, vertex in enumerate((a, b)):
            point = [*places[vertex], 1.0]
            matrix[2 * row + end, 3 * left : 3 * left + 3] = point
            matrix[2 * row + end, 3 * right : 3 * right + 3] = [-value for value in point]
    level = np.eye(3, matrix.shape[1])
    return null_space(np.vstack([matrix, level]))


def folds_of(pattern: Pattern, places: Floats, planes: Floats) -> Floats:
    """Return float[J, K]: across each crease, the difference of slope of its panels, for each lift."""
    panel_at = pattern.panel_of_side
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
    that are 0 but for rounding are valleys, and of weights that are as good the first are chosen.
    """
    best: Floats = np.zeros(folds.shape[1])
    weights: Floats
    most, inverse = -1.0, np.linalg.pinv(folds, rcond=DOUBLE.zero)
    for _ in range(_STARTS):
        weights = np.asarray(random.standard_normal(folds.shape[1]), dtype=np.float64)
        for _ in range(_ROUNDS):
            turns = folds @ weights
            least = float(np.abs(turns).min(initial=np.inf)) / float(np.abs(turns).max(initial=DOUBLE.zero_rate))
            if least > most + MARGIN:
                best, most = weights, least
            signs = np.where(turns < -MARGIN * np.abs(turns).max(initial=0.0), -1.0, 1.0)
            weights = np.asarray(inverse @ signs, dtype=np.float64)
    return best


_MIXED = (1.0, 0.5, 0.25, 0.1)
"""Parts of another lift that are added to the one farthest below the plane, the largest first."""
_OTHERS = 4
"""Other lifts that are added, even ones and others at random."""
_WIDER = 1e-3
"""Part by which the border must enclose a larger area than a hole: readers recognise it by that."""
_ROOM = 0.25
"""Part of the largest distance from the plane that a lift must keep."""


def with_finite_centres(pattern: Pattern) -> Pattern:
    """Return the same panels, their creases through points where they are to be parallel."""
    return replace(pattern, pointings=tuple(replace(pointing, infinite=False) for pointing in pattern.pointings))


@dataclass(frozen=True, slots=True)
class _Heights:
    """Heights over a drawing, for each of K lifts: of vertices, and of centres that are to recede.

    Vertices and centres, float[V, 3] and float[C, 3], are places in the drawing, and 1.
    """

    vertices: Floats
    centres: Floats
    of_vertices: Floats
    of_centres: Floats

    def plane(self, lifts: Floats) -> tuple[Floats, Floats, float]:
        """Return the combination of some lifts, and the plane through its centres, that is farthest above it.

        Lifts are float[K, L]. Returns weights float[L], at most 1; the plane, float[3]; and its distance above the
        highest vertex, 0 if no plane goes through the centres.
        """
        size = lifts.shape[1]
        over = np.hstack([self.of_vertices @ lifts, -self.vertices, np.ones((len(self.vertices), 1))])
        through = np.hstack([self.of_centres @ lifts, -self.centres, np.zeros((len(self.centres), 1))])
        bounds = [(-1.0, 1.0)] * size + [(None, None)] * 3 + [(None, 1.0)]
        aim = np.zeros(size + 4)
        aim[-1] = -1.0
        program = scipy.optimize.linprog(aim, over, np.zeros(len(over)), through, np.zeros(len(through)), bounds)
        if not program.success:
            return np.zeros(size), np.zeros(3), 0.0
        return program.x[:size], program.x[size : size + 3], float(program.x[-1])


def receded(
    centres: Sequence[Pointing], pattern: Pattern, places: Floats, random: np.random.Generator
) -> tuple[Floats, Floats]:
    """Return places in space of panels drawn with centres that are points, these centres at infinity.

    Places in space, float[V, 3], have an extent of 1 in each direction. The folds, float[J], are above 0 at
    valleys, as those of `lifted`: such maps keep the sign. Raises `UnsolvableError` if no plane through the
    centres misses all panels, or a hole becomes wider than the border.
    """
    places = (places - places.mean(axis=0)) / np.ptp(places, axis=0).max()
    planes = planes_over(pattern, places)
    folds = folds_of(pattern, places, planes)
    heights = _heights(pattern, centres, places, planes)
    best, _, most = heights.plane(np.eye(planes.shape[1]))
    if most <= 0.0:
        raise UnsolvableError("each plane through the centres that are to be at infinity meets a panel")
    for weights in _around(best, folds, random):
        scale, plane, room = heights.plane(weights[:, None])
        if room >= _ROOM * most:
            below = heights.vertices @ plane - heights.of_vertices @ (weights * scale)
            across = (heights.vertices[:, :2] - heights.centres[0, :2]) / below[:, None]
            mapped = np.column_stack([across, 1.0 / below])
            mapped = (mapped - mapped.min(axis=0)) / np.ptp(mapped, axis=0)
            if _is_widest(mapped, pattern):
                return mapped, folds @ (weights * scale)
    raise UnsolvableError("with centres at infinity a hole is wider than the border")


def _around(best: Floats, folds: Floats, random: np.random.Generator) -> Iterator[Floats]:
    """Yield lifts about one, more and less evenly folded, and that one last."""
    others = [evenly_folded(folds, random), *random.standard_normal((_OTHERS, len(best)))]
    for other in others:
        for part in _MIXED:
            for sign in (1.0, -1.0):
                yield best + sign * part * other / np.abs(other).max()
    yield best


def _is_widest(places: Floats, pattern: Pattern) -> bool:
    """Check that the border encloses a larger area than every hole."""
    rings = (pattern.outer, *pattern.holes)
    border, *holes = (float(np.linalg.norm(area_vector(places[list(ring)]))) for ring in rings)
    return all(hole * (1.0 + _WIDER) < border for hole in holes)


def _heights(pattern: Pattern, centres: Sequence[Pointing], places: Floats, planes: Floats) -> _Heights:
    over = planes.reshape(len(pattern.panels), 3, -1)
    of_panel = {vertex: panel for panel, around in enumerate(pattern.panels) for vertex in around}
    vertices = np.column_stack([places, np.ones(len(places))])
    ends = [places[[pattern.creases[crease] for crease in pointing.creases]] for pointing in centres]
    points = np.array([[*lines_meet(pair[:, 0], pair[:, 1] - pair[:, 0]).point, 1.0] for pair in ends])
    first_creases = [set(pattern.creases[pointing.creases[0]]) for pointing in centres]
    at = [next(i for i, around in enumerate(pattern.panels) if ends <= set(around)) for ends in first_creases]
    return _Heights(
        vertices,
        points,
        np.array([vertices[vertex] @ over[of_panel[vertex]] for vertex in range(len(places))]),
        np.array([point @ over[panel] for point, panel in zip(points, at, strict=True)]),
    )
