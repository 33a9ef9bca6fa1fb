"""Panels that come to lie on each other on a path: in which orders, and whether they pass through each other there.

Shortly before two panels lie on each other, and shortly after, one is above the other: that says how they lie. Panels
that go on lying on each other keep their order. Where no layer order agrees with all of that and with the creases,
panels pass through each other. Theory: docs/theory/layer-orders.md.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from graphs.errors import NumericalError
from graphs.geometry import rigid_motion, unit
from graphs.mechanism.precision import extent_of
from graphs.types import Floats
from synth.analysis.layering.constraints import PairTable
from synth.analysis.layering.counting.problem import LayerProblem
from synth.analysis.layering.counting.propagation import counted
from synth.analysis.layering.space.orders import Height, LayersInSpace, layers_of_stacked
from synth.analysis.layering.space.planes import FoldedState, PlaneOfPanels, StackedPanels, stacked_panels
from synth.analysis.motion.closure import ClosureEquations, corrected
from synth.analysis.motion.path import RestingPanels

_SHEET, _PANELS, _PAIRS, _VARIABLES = 3000, 300, 20_000, 60
"""Panels of a sheet, panels that lie on others, pairs of them over cells, and variables of a problem up to which layers
are looked at on a path."""
_SHORTLY = 1.0 / 16.0
"""Of the way to the frame before, or after."""


class _TooLargeError(Exception):
    """More would have to be counted than takes a moment."""


@dataclass(frozen=True, slots=True)
class LayersOnPath:
    """What the layers on a path are.

    `resting` is about the last frame, None if no panels lie on each other there; `wrong` are frames in which they
    pass through each other, at first `panels`.
    """

    resting: RestingPanels | None
    wrong: tuple[int, ...] = ()
    panels: tuple[int, ...] = ()


def layers_on_path(
    state: Callable[[Floats, Floats | None], FoldedState], closure: ClosureEquations, angles: Floats, points: Floats
) -> LayersOnPath:
    """Return the layers in the frames of a path, of joint angles float[F, J] and vertices float[F, V, 3].

    `state` gives the sheet at angles, with its vertices or without.
    """
    if len(angles) == 0 or len(state(angles[0], points[0]).mechanism.panels) > _SHEET:
        return LayersOnPath(None)
    wrong, panels = list[int](), tuple[int, ...]()
    resting: RestingPanels | None = None
    kept: dict[tuple[int, int], bool] = {}
    for frame, here in enumerate(angles):
        there = state(here, points[frame])
        stacked = _stacked(there)
        resting = None
        if stacked is None:
            kept = {}
            continue
        planes = tuple(plane.plates for plane in stacked.planes)
        if sum(map(len, planes)) > _PANELS or sum(len(a) * (len(a) - 1) // 2 for a in stacked.image.above) > _PAIRS:
            resting, kept = RestingPanels(planes, None), {}
            continue
        pairs = _Pairs(stacked, there)
        heights = list(pairs.as_before(kept))
        for other in (frame - 1, frame + 1):
            if 0 <= other < len(angles):
                near = corrected(closure, here + _SHORTLY * (angles[other] - here))
                heights += pairs.by_motion(state(near.angles, None)) if near.closed else ()
        last = frame == len(angles) - 1
        try:
            layers = layers_of_stacked(there, stacked, _count if last else _any, heights, explain=not wrong)
        except _TooLargeError:
            resting, kept = RestingPanels(planes, None), {}
            continue
        resting, kept = RestingPanels(planes, layers.orders), dict(pairs.decided(layers))
        if not layers.orders:
            wrong.append(frame)
            panels = panels or _panels_of(layers)
    return LayersOnPath(resting, tuple(wrong), panels)


def _stacked(state: FoldedState) -> StackedPanels | None:
    """Return the panels that lie on each other; None where none do, or their image cannot be made."""
    try:
        return stacked_panels(state)
    except NumericalError:
        return None


def _count(problems: Sequence[LayerProblem]) -> Sequence[int]:
    if max((problem.variables for problem in problems), default=0) > _VARIABLES:
        raise _TooLargeError
    return list(map(counted, problems))


def _any(problems: Sequence[LayerProblem]) -> Sequence[int]:
    """Return 1 for problems that have a solution, or are large."""
    return [1 if problem.variables > _VARIABLES else min(counted(problem), 1) for problem in problems]


def _panels_of(layers: LayersInSpace) -> tuple[int, ...]:
    """Return two panels of a contradiction: of a motion if there is one in it."""
    if layers.core is None:
        return ()
    several = [condition.panels[:2] for condition in layers.core.conditions]
    low, high = sorted(several[0] if several else layers.core.panels[:2])
    return low, high


class _Pairs:
    """Pairs of plates that lie on each other: for each variable the largest cell of its region."""

    def __init__(self, stacked: StackedPanels, state: FoldedState) -> None:
        self.stacked, self.state = stacked, state
        table = PairTable(stacked.image)
        cell_of = np.repeat(np.arange(len(table.sizes)), np.diff(table.first))
        order = np.lexsort((-stacked.image.areas[cell_of], table.variable))
        _, first = np.unique(table.variable[order], return_index=True)
        rows = order[first]
        self.variables, self.cells = table.variable[rows], cell_of[rows]
        self.pairs = [(int(one), int(other)) for one, other in table.panels[rows]]
        self._touching = 4.0 * state.tolerances.same_point * (extent_of(state.points) or 1.0)

    def as_before(self, kept: Mapping[tuple[int, int], bool]) -> Iterator[Height]:
        """Yield the heights of plates that lay on each other in the frame before."""
        flipped = self.stacked.image.panels.flipped
        for cell, (one, other) in zip(self.cells.tolist(), self.pairs, strict=True):
            if (one, other) in kept:
                one_above = kept[one, other] == bool(flipped[one])
                yield (cell, one, other) if one_above else (cell, other, one)

    def decided(self, layers: LayersInSpace) -> Iterator[tuple[tuple[int, int], bool]]:
        """Yield pairs whose order is decided: whether the second is on the side of the normal of the first."""
        flipped = self.stacked.image.panels.flipped
        values = layers.decided(self.variables)
        several: dict[tuple[int, int], set[bool]] = {}
        for pair, value in zip(self.pairs, values, strict=True):
            if value is not None:
                several.setdefault(pair, set()).add(value == bool(flipped[pair[0]]))
        yield from ((pair, sides.pop()) for pair, sides in several.items() if len(sides) == 1)

    def by_motion(self, near: FoldedState) -> Iterator[Height]:
        """Yield the heights that plates have at a configuration near this one, where they are apart."""
        motions: dict[int, tuple[Floats, Floats]] = {}
        for cell, (one, other) in zip(self.cells.tolist(), self.pairs, strict=True):
            plane = self.stacked.planes[self.stacked.plane_of_cell[cell]]
            place = _inside(self.stacked.image.nodes[list(self.stacked.image.cells[cell])])
            point = plane.lifted(place[None])[0]
            (turn, shift), (other_turn, other_shift) = (
                self._motion(self._panel_at(plate, plane, place), near, motions) for plate in (one, other)
            )
            normal = unit((turn + other_turn) @ plane.frame[2])
            height = float((turn @ point + shift - other_turn @ point - other_shift) @ normal)
            if abs(height) > self._touching:
                yield (cell, one, other) if height > 0.0 else (cell, other, one)

    def _panel_at(self, plate: int, plane: PlaneOfPanels, place: Floats) -> int:
        """Return the panel of a plate that is nearest to a point of a plane: the creases between them may open."""
        panels = self.stacked.plates[plate]
        if len(panels) == 1:
            return panels[0]
        point = shapely.Point(place)
        faces = self.state.mechanism.panels
        far = [
            min(shapely.Polygon(plane.flat(self._corners(face))).distance(point) for face in faces[panel])
            for panel in panels
        ]
        return panels[int(np.argmin(far))]

    def _corners(self, face: int) -> Floats:
        return self.state.points[list(self.state.sheet.faces[face])]

    def _motion(self, panel: int, near: FoldedState, known: dict[int, tuple[Floats, Floats]]) -> tuple[Floats, Floats]:
        """Return how a panel moves to a configuration near this one."""
        if panel not in known:
            faces = self.state.mechanism.panels[panel]
            corners = sorted({vertex for face in faces for vertex in self.state.sheet.faces[face]})
            known[panel] = rigid_motion(self.state.points[corners], near.points[corners])
        return known[panel]


def _inside(corners: Floats) -> Floats:
    """Return a point of a polygon, float[2], away from its outline."""
    middle = shapely.Polygon(corners).buffer(0.0).representative_point()
    return np.array([middle.x, middle.y])
