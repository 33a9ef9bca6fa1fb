"""Panels that pass through each other: found at each configuration, and how far a path leads before the first time.

Two plane convex pieces cross if each has corners on both sides of the other's plane and the stretches that they
cut out of the line of both planes overlap. Panels that share a crease, lie on each other or touch do not cross.
Pairs are sorted out by bounding boxes first. Theory: docs/theory/folding.md.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from math import ceil, radians

import numpy as np

from graphs.convert.duality import SheetMechanism
from graphs.geometry import area_vector, frame_about, unit
from graphs.mechanism.precision import extent_of
from graphs.mechanism.sheet import Sheet
from graphs.tolerances import DOUBLE, Tolerances
from graphs.types import Flags, Floats, Ints
from synth.analysis.motion.closure import ClosureEquations, corrected
from synth.analysis.motion.path import Path
from synth.analysis.motion.walk.step import PathEvent, Step
from synth.analysis.motion.walk.walking import Event, Walk

_APART = radians(3.0)
"""Between configurations that are looked at no joint turns by more."""
_REFINED = 10
"""Halvings of the way between two frames."""
_PAIRS = 1_000_000
"""Pairs of pieces whose boxes are compared at a time, about."""
_WIDER = 1.25
"""Strips are so many times as wide as the widest piece: rounding puts none into the next but one."""


class PanelShapes:
    """Panels as planar convex pieces, from the vertices round each face and the panel that each face is part of.

    `flat`, float[vertices, 3], are places of the vertices in a configuration in which faces are planar. Panels
    that enter each other no deeper than the tolerances tell points apart touch.
    """

    def __init__(
        self, faces: Sequence[Sequence[int]], panel_of: Sequence[int], flat: Floats, tolerances: Tolerances = DOUBLE
    ) -> None:
        pieces = _pieces_of(faces, flat)
        corners = [piece for pieces_of_face in pieces for piece in pieces_of_face]
        most = max(map(len, corners), default=3)
        filled = [[*piece, *[piece[-1]] * (most - len(piece))] for piece in corners]
        self._corners = np.array(filled, dtype=np.int64)
        self._panel = np.repeat(np.array(panel_of, dtype=np.int64), list(map(len, pieces)))
        self._touching = tolerances.same_point * (extent_of(flat) or 1.0)

    def crossing(self, places: Floats) -> tuple[int, int] | None:
        """Return two panels that cross where vertices are at float[vertices, 3]; None if there are none."""
        if len(self._panel) < 2:
            return None
        corners = places[self._corners]
        normals = unit(area_vector(corners))
        crossing: list[tuple[int, int]] = []
        for first, second in self._near(corners):
            crossed = self._cross(corners, normals, first, second)
            crossing += zip(first[crossed].tolist(), second[crossed].tolist(), strict=True)
        if not crossing:
            return None
        low, high = sorted(int(self._panel[piece]) for piece in min(crossing))
        return low, high

    def _near(self, corners: Floats) -> Iterator[tuple[Ints, Ints]]:
        """Yield pairs of pieces of different panels whose boxes meet, the lesser panel first, some at a time.

        Pieces lie in strips across one axis, wider than the largest of them, in each of which they stand in the order
        in which they begin along another axis. One meets none beyond the next strip on either side, and in these
        none that begins where it has ended; of two the one that begins first looks for the other.
        """
        low, high = corners.min(axis=1) - self._touching, corners.max(axis=1)
        across, along = np.argsort(np.ptp(low, axis=0), kind="stable")[1:]
        width = float((high - low)[:, across].max()) * _WIDER
        strip = ((low[:, across] - low[:, across].min()) / width).astype(np.int64) + 1
        count = len(strip)
        begins = np.argsort(low[:, along], kind="stable")
        rank = np.empty(count, dtype=np.int64)  # the place of each in the order along
        rank[begins] = np.arange(count)
        ended = np.searchsorted(low[begins, along], high[:, along], side="right")
        places = strip * count + rank
        order = np.argsort(places)
        places = places[order]
        for beside in (-1, 0, 1):
            row = (strip + beside) * count
            first = np.searchsorted(places, row + rank + 1)
            others = np.searchsorted(places, row + ended) - first
            for pieces in _in_parts(others):
                one = np.repeat(pieces, others[pieces])
                begun = np.cumsum(others[pieces]) - others[pieces]
                other = order[np.arange(len(one)) + np.repeat(first[pieces] - begun, others[pieces])]
                meet = (low[one] <= high[other]).all(axis=1) & (low[other] <= high[one]).all(axis=1)
                meet &= self._panel[one] != self._panel[other]
                one, other = one[meet], other[meet]
                swapped = self._panel[one] > self._panel[other]
                yield np.where(swapped, other, one), np.where(swapped, one, other)

    def _cross(self, corners: Floats, normals: Floats, first: Ints, second: Ints) -> Flags:
        """Tell which pairs of pieces cross: bool[pairs]. Most stand on one side of the other's plane, and are done."""
        crossed = np.zeros(len(first), dtype=bool)
        pairs = np.arange(len(first))
        heights: list[Floats] = []
        for one, other in ((first, second), (second, first)):
            off = corners[one[pairs]] - corners[other[pairs], :1]
            above = (off * normals[other[pairs]][:, None]).sum(axis=-1)
            both = (above.max(axis=1) > self._touching) & (above.min(axis=1) < -self._touching)
            pairs, heights = pairs[both], [*(known[both] for known in heights), above[both]]
        line = unit(np.cross(normals[first[pairs]], normals[second[pairs]]))
        origin = corners[first[pairs], :1]
        ends = []
        for one, above in zip((first, second), heights, strict=True):
            along = ((corners[one[pairs]] - origin) * line[:, None]).sum(axis=-1)
            ends.append(self._stretch(above, along))
        (low, high), (other_low, other_high) = ends
        crossed[pairs] = np.minimum(high, other_high) - np.maximum(low, other_low) > self._touching
        return crossed

    def _stretch(self, heights: Floats, along: Floats) -> tuple[Floats, Floats]:
        """Return the ends, along both planes' line, of where pieces on both sides of the other's plane meet it."""
        after, along_after = np.roll(heights, -1, axis=1), np.roll(along, -1, axis=1)
        passes = heights * after < 0.0
        part = heights / np.where(passes, heights - after, 1.0)
        at = along + part * (along_after - along)
        in_plane = np.abs(heights) <= self._touching
        low = np.minimum(np.where(passes, at, np.inf), np.where(in_plane, along, np.inf)).min(axis=1)
        high = np.maximum(np.where(passes, at, -np.inf), np.where(in_plane, along, -np.inf)).max(axis=1)
        return low, high


def _in_parts(numbers: Ints) -> Iterator[Ints]:
    """Yield the places of numbers that are not zero, in order, by parts that add up to `_PAIRS` or little more."""
    kept = np.flatnonzero(numbers > 0)
    parts = np.cumsum(numbers[kept]) // _PAIRS
    yield from np.split(kept, np.flatnonzero(np.diff(parts)) + 1)


def shapes_of_panels(sheet: Sheet, mechanism: SheetMechanism, flat: Floats, tolerances: Tolerances) -> PanelShapes:
    """Return the panels of a sheet as shapes; faces of one panel do not cross each other."""
    panel_of = {face: panel for panel, faces in enumerate(mechanism.panels) for face in faces}
    return PanelShapes(sheet.faces, [panel_of[face] for face in range(len(sheet.faces))], flat, tolerances)


class Collision(Event):
    """Panels begin to pass through each other: a walk ends before, at its last frame.

    No joint turns by more than three degrees between configurations that are looked at: what passes through in
    less is not seen. `places` gives the vertices, float[F, vertices, 3], at joint angles float[F, J].
    """

    def __init__(self, panels: PanelShapes, places: Callable[[Floats], Floats]) -> None:
        self._panels, self._places = panels, places
        self._met: Floats | None = None

    def before(self, walk: Walk, rates: Floats) -> str:
        """Return which panels cross where the walk begins."""
        start = walk.here.angles
        if walk.here is not walk.frames[0] or self.crossing(start) is None:
            return ""
        return f"panels pass through each other at the start: {self._record(walk, start)}"

    def within(self, walk: Walk, step: Step) -> tuple[Step, str] | None:
        """End at the last place of a step at which no panels cross."""
        self._met = None
        count = max(ceil(float(np.abs(step.chord).max(initial=0.0)) / _APART), 1)
        ends = [(part, step.at(part)) for part in (number / count for number in range(1, count + 1))]
        ends = [(part, place) for part, place in ends if place.closed]
        free, every = 0.0, self._places(np.array([place.angles for _, place in ends]))
        for (part, _), places in zip(ends, every, strict=True):
            if self._panels.crossing(places) is not None:
                kept, beyond = step.piece(free, part).last(lambda angles: self.crossing(angles) is None)
                self._met = beyond.angles
                return step.up_to(kept), "panels pass through each other"
            free = part
        return None

    def after(self, walk: Walk, step: Step) -> None:
        """Record which panels cross."""
        if self._met is not None:
            walk.ended = self._record(walk, self._met)

    def among(self, closure: ClosureEquations, path: Path, places: Floats, driver: int) -> tuple[Path, tuple[int, ...]]:
        """Return a path with the event that panels begin to cross, and the frames in which they do.

        Vertices in its frames are float[F, V, 3]. It is known to a thousandth of the way between two.
        """
        crossing = [self._panels.crossing(vertices) for vertices in places]
        frames = [frame for frame, pair in enumerate(crossing) if pair is not None]
        if not frames:
            return path, ()
        before = max(frames[0] - 1, 0)
        panels, angles = self._begun(closure, path.angles[before], path.angles[frames[0]])
        event = PathEvent("collision", before, driver, (driver,), angles, panels=panels)
        events = sorted((*path.events, event), key=lambda event: event.frame)
        return replace(path, events=tuple(events)), tuple(frames)

    def _begun(self, closure: ClosureEquations, free: Floats, crossed: Floats) -> tuple[tuple[int, ...], Floats]:
        """Return which panels first cross between two frames, and joint angles there: by halves."""
        panels: tuple[int, ...] = self.crossing(crossed) or ()
        for _ in range(_REFINED):
            middle = corrected(closure, (free + crossed) / 2.0)
            if not middle.closed:
                break
            pair = self.crossing(middle.angles)
            if pair is None:
                free = middle.angles
            else:
                crossed, panels = middle.angles, pair
        return panels, crossed

    def _record(self, walk: Walk, angles: Floats) -> str:
        walk.record("collision", angles, panels=self.crossing(angles) or ())
        return walk.met[-1].line(range(walk.closure.joints) if walk.goal is None else walk.goal.names)

    def crossing(self, angles: Floats) -> tuple[int, int] | None:
        """Return two panels that cross at joint angles float[J]; None if there are none."""
        return self._panels.crossing(self._places(angles[None])[0])


def _pieces_of(faces: Sequence[Sequence[int]], flat: Floats) -> list[list[list[int]]]:
    """Return each face as convex pieces."""
    sizes = np.array([len(face) for face in faces], dtype=np.int64)
    pieces = [[list(face)] for face in faces]
    for size in np.unique(sizes).tolist():
        numbers = np.flatnonzero(sizes == size)
        places = flat[np.array([faces[number] for number in numbers.tolist()])]
        normals = area_vector(places)
        plane = places @ frame_about(normals)[:, :2].swapaxes(1, 2)
        steps = np.roll(plane, -1, axis=1) - plane
        after = np.roll(steps, -1, axis=1)
        bends = steps[..., 0] * after[..., 1] - steps[..., 1] * after[..., 0]
        concave = (bends < -DOUBLE.same_point * np.abs(normals).max(axis=1, keepdims=True)).any(axis=1)
        for number in numbers[concave].tolist():
            pieces[number] = _convex(faces[number], flat)
    return pieces


def _convex(face: Sequence[int], flat: Floats) -> list[list[int]]:
    """Return a face as convex pieces: itself, or triangles."""
    corners = list(face)
    places = flat[corners]
    normal = area_vector(places)
    across = frame_about(normal)[:2]
    plane = {corner: across @ place for corner, place in zip(corners, places, strict=True)}

    def bend(a: int, b: int, c: int) -> float:
        (x, y), (u, v) = plane[b] - plane[a], plane[c] - plane[b]
        return float(x * v - y * u)

    def is_ear(k: int) -> bool:
        a, b, c = corners[k - 1], corners[k], corners[(k + 1) % len(corners)]
        inside = (all(bend(p, q, d) > 0.0 for p, q in ((a, b), (b, c), (c, a))) for d in {*corners} - {a, b, c})
        return bend(a, b, c) > 0.0 and not any(inside)

    rounding = -DOUBLE.same_point * float(np.abs(normal).max(initial=0.0))
    if all(bend(corners[k - 2], corners[k - 1], corners[k]) >= rounding for k in range(len(corners))):
        return [corners]
    pieces = []
    while len(corners) > 3:
        # only where corners are in line but for rounding there is no ear
        ear = next((k for k in range(len(corners)) if is_ear(k)), 0)
        pieces.append([corners[ear - 1], corners[ear], corners[(ear + 1) % len(corners)]])
        del corners[ear]
    return [*pieces, corners]
