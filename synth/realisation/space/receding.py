"""Centres at infinity in space: a pose whose centres are points, mapped so that these recede to infinity.

A projective map keeps planes plane, axes that meet meeting, and first-order freedoms. One that takes a plane
through centres to infinity makes the axes through each of them parallel; panels stay bounded if the plane meets
none. Whether a drawing has such a lift is a linear program: heights of vertices and centres are linear in it.

Source of what projective maps do to freedoms: H. Crapo and W. Whiteley, Statics of frameworks and motions of panel
structures, Structural Topology 6 (1982). Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy.optimize

from graphs.errors import UnsolvableError
from graphs.geometry import area_vector, lines_meet
from graphs.types import Floats
from synth.realisation.pattern import Pattern, Pointing
from synth.realisation.space.lifting import evenly_folded, folds_of, planes_over

__all__ = ["receded", "with_finite_centres"]

_MIXED = (1.0, 0.5, 0.25, 0.1)
"""Parts of another lift that are added to the one farthest below the plane, the largest first."""
_OTHERS = 4
"""Other lifts that are added, even ones and others at random."""
_WIDER = 1e-3
"""Part by which the border must go round a larger area than a hole: it is known by that when it is read back."""
_ROOM = 0.25
"""Part of the largest distance from the plane that a lift must keep."""


def with_finite_centres(pattern: Pattern) -> Pattern:
    """Return the same panels, their creases through points where they are to be parallel."""
    return replace(pattern, pointings=tuple(replace(one, infinite=False) for one in pattern.pointings))


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

        Lifts are float[K, L]. Returns weights float[L], at most 1; the plane, float[3]; and its room over the
        vertex that is nearest below it, 0 if no plane goes through the centres.
        """
        size = lifts.shape[1]
        over = np.hstack([self.of_vertices @ lifts, -self.vertices, np.ones((len(self.vertices), 1))])
        through = np.hstack([self.of_centres @ lifts, -self.centres, np.zeros((len(self.centres), 1))])
        bounds = [(-1.0, 1.0)] * size + [(None, None)] * 3 + [(None, 1.0)]
        aim = np.zeros(size + 4)
        aim[-1] = -1.0
        found = scipy.optimize.linprog(aim, over, np.zeros(len(over)), through, np.zeros(len(through)), bounds)
        if not found.success:
            return np.zeros(size), np.zeros(3), 0.0
        return found.x[:size], found.x[size : size + 3], float(found.x[-1])


def receded(
    pattern: Pattern, centres: Sequence[Pointing], places: Floats, random: np.random.Generator
) -> tuple[Floats, Floats]:
    """Return places in space of panels drawn with centres that are points, these centres at infinity.

    Parameters
    ----------
    pattern : Pattern
        As it is drawn.
    centres : sequence of Pointing
        Those that are to recede.
    places : float[V, 2]
    random : Generator

    Returns
    -------
    places : float[V, 3]
        With an extent of 1 in each direction.
    turns : float[J]
        Above 0 at valleys, as of `synth.realisation.space.lifting.lifted`: such maps keep the sign.

    Raises
    ------
    UnsolvableError
        If no plane through the centres meets no panel, or a hole becomes wider than the border.
    """
    places = (places - places.mean(axis=0)) / np.ptp(places, axis=0).max()
    planes = planes_over(pattern, places)
    folds = folds_of(pattern, places, planes)
    heights = _heights(pattern, centres, places, planes)
    best, _, most = heights.plane(np.eye(planes.shape[1]))
    if most <= 0.0:
        raise UnsolvableError("no plane through the centres that are to be at infinity misses all panels")
    for weights in _around(best, folds, random):
        scale, plane, room = heights.plane(weights[:, None])
        if room >= _ROOM * most:
            mapped = _mapped(heights, heights.vertices @ plane - heights.of_vertices @ (weights * scale))
            if _is_widest(mapped, pattern):
                return mapped, folds @ (weights * scale)
    raise UnsolvableError("with centres at infinity a hole is wider than the border")


def _around(best: Floats, folds: Floats, random: np.random.Generator) -> Iterator[Floats]:
    """Yield lifts about one, more and less evenly folded."""
    others = [evenly_folded(folds, random), *random.standard_normal((_OTHERS, len(best)))]
    for other in others:
        for part in _MIXED:
            for sign in (1.0, -1.0):
                yield best + sign * part * other / np.abs(other).max()
    yield best


def _is_widest(places: Floats, pattern: Pattern) -> bool:
    """Tell whether the border goes round a larger area than every hole."""
    border, *holes = (
        float(np.linalg.norm(area_vector(places[list(ring)]))) for ring in (pattern.outer, *pattern.holes)
    )
    return all(hole * (1.0 + _WIDER) < border for hole in holes)


def _heights(pattern: Pattern, centres: Sequence[Pointing], places: Floats, planes: Floats) -> _Heights:
    over = planes.reshape(len(pattern.panels), 3, -1)
    of_panel = {vertex: panel for panel, around in enumerate(pattern.panels) for vertex in around}
    vertices = np.column_stack([places, np.ones(len(places))])
    points = np.array([[*_meeting(pattern, one, places), 1.0] for one in centres])
    at = [_panel_of_crease(pattern, one.creases[0]) for one in centres]
    return _Heights(
        vertices,
        points,
        np.array([vertices[vertex] @ over[of_panel[vertex]] for vertex in range(len(places))]),
        np.array([point @ over[panel] for point, panel in zip(points, at, strict=True)]),
    )


def _panel_of_crease(pattern: Pattern, crease: int) -> int:
    ends = set(pattern.creases[crease])
    return next(panel for panel, around in enumerate(pattern.panels) if ends <= set(around))


def _meeting(pattern: Pattern, one: Pointing, places: Floats) -> Floats:
    """Return the point in which creases meet."""
    ends = places[[pattern.creases[crease] for crease in one.creases]]
    return lines_meet(ends[:, 0], ends[:, 1] - ends[:, 0]).point


def _mapped(heights: _Heights, below: Floats) -> Floats:
    """Return vertices so far below a plane, the plane at infinity, each direction scaled to an extent of 1."""
    across = (heights.vertices[:, :2] - heights.centres[0, :2]) / below[:, None]
    mapped = np.column_stack([across, 1.0 / below])
    scaled: Floats = (mapped - mapped.min(axis=0)) / np.ptp(mapped, axis=0)
    return scaled
