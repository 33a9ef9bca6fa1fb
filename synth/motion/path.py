"""Paths of closed poses: joints driven to angles that are asked for, one frame after the other.

With one freedom turning points of the driver are passed. Where a path ends before its goal it says why and how far
it came; what it meets on the way is named. How steps are taken: `synth.motion.walk`. Theory:
docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from graphs.arrays import Floats
from synth.motion.closure import ClosureEquations
from synth.motion.newton import corrected
from synth.motion.walk.event import PathEvent
from synth.motion.walk.leg import Legs
from synth.motion.walk.stepping import PathOptions

__all__ = ["DrivenPath", "PathOptions", "driven_path"]


@dataclass(frozen=True, slots=True)
class DrivenPath:
    """Poses that a linkage passes through while one joint is driven.

    Attributes
    ----------
    angles : float[F, J]
        Joint angles of each frame, radians; the first is where it began.
    errors : float[F]
        By how much loops do not close, at most, in radians and units of the extent.
    stopped : str
        Why it ended before its goal, and how far it came; empty if it reached it.
    events : tuple of PathEvent
        What it met on the way: turning points of the driver, panels on each other, ranks that drop.
    watched : bool
        Whether ranks were watched: of linkages of many joints they are not.
    """

    angles: Floats
    errors: Floats
    stopped: str
    events: tuple[PathEvent, ...] = ()
    watched: bool = True

    def up_to(self, frames: int) -> DrivenPath:
        """Return the first frames, and what was met before the last of them."""
        events = tuple(event for event in self.events if event.frame < frames - 1)
        return replace(self, angles=self.angles[:frames], errors=self.errors[:frames], events=events)


def driven_path(
    closure: ClosureEquations,
    start: Floats,
    drivers: Sequence[int],
    values: npt.ArrayLike,
    *,
    options: PathOptions | None = None,
) -> DrivenPath:
    """Return the closed poses at which some joints have given angles, one after the other.

    Parameters
    ----------
    closure : ClosureEquations
    start : float[J]
        A closed pose, radians.
    drivers : sequence of int
        Places of the joints that are driven.
    values : float[F, D]
        Their angles in each frame, radians.
    options : PathOptions, optional

    Examples
    --------
    A parallelogram in the plane, its first joint turned by 90 degrees:

    >>> from graphs.loops.loop import Loop
    >>> from graphs.mechanism.sc import SCGraph
    >>> from synth.motion.linkage import linkage_of_axes
    >>> four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3), "infinite")])
    >>> corners = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)]
    >>> linkage = linkage_of_axes(four_bar, {joint: (corners[joint], (0, 0, 1)) for joint in range(4)})
    >>> path = driven_path(ClosureEquations(linkage), linkage.angles, [0], [[np.pi / 4], [np.pi / 2 - 1e-3]])
    >>> np.degrees(path.angles[-1]).round(3).tolist(), path.stopped
    ([89.943, -89.943, 89.943, -89.943], '')
    """
    options = options or PathOptions()
    legs = Legs(closure, list(drivers), options)
    frames, events, stopped = [corrected(legs.moving, start)], list[PathEvent](), ""
    for value in np.asarray(values, dtype=float).reshape(-1, len(drivers)):
        leg = legs.to(frames[-1], value)
        events += [replace(event, frame=event.frame + len(frames) - 1) for event in leg.events]
        stopped = leg.stopped
        if stopped and np.array_equal(leg.poses[-1].angles, frames[-1].angles):
            break
        frames += leg.poses
        if stopped:
            break
        if options.report is not None:
            options.report(len(frames))
    angles, errors = np.array([f.angles for f in frames]), np.array([f.error for f in frames])
    return DrivenPath(angles, errors, stopped, tuple(events), legs.watch is not None or not closure.rows)
