"""Paths of closed configurations with driven joints, and circuits: closed curves past all dead points.

With one freedom turning points of the driver are passed. A path ends where its driven joints cannot come nearer to
their angles, and says why; of a sheet, also in which frames panels pass through each other, and how they lie at its
end. A circuit has no driver: the walk goes along the curve until it comes back to where it began. How steps are taken:
`synth.analysis.motion.walk`. Theory: docs/theory/folding.md, docs/theory/moving.md, docs/theory/layer-orders.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import degrees
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from graphs.errors import UnsolvableError, numbered
from graphs.tolerances import trailing
from graphs.types import Flags, Floats, JointId
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.singular.second_order import rates_at
from synth.analysis.motion.walk.events import Limit, RankDeficiency, Return, TurningPoint
from synth.analysis.motion.walk.step import WATCHED, Allowance, PathEvent, RankWatch
from synth.analysis.motion.walk.walking import DrivenGoal, Event, KeptSigns, Walk

_MOST_PAST = 1_000
"""Steps past a turning point."""


@dataclass(frozen=True, slots=True)
class PathOptions:
    """How a path is followed.

    Attributes
    ----------
    direction : float[J], optional
        Rates to begin with, where the configuration is singular: a flat sheet has several ways to fold. By default
        the least ones that move the driven joints.
    limited : bool[J] or False, optional
        Joints that do not turn beyond 180 degrees: panels lie on each other there.
    straight : bool, optional
        With several freedoms, go on in the direction it began as far as that is possible; by default by the
        least rates that move the driven joints.
    report : callable, optional
        Called with the number of frames after each.
    names : sequence of J joint ids, optional
        How messages call the joints; by default by their places.
    allowance : Allowance, optional
        Steps that may be taken, by this path and others that share it.
    locked : sequence of int, optional
        Places of joints that keep their angles: those that do not move on the branch. Their closure equations may
        be squares there, which tell angles to the root of their error only.
    events : sequence of Event, optional
        What else is looked for on the way.
    signs : float[J], optional
        Signs that joint angles keep as long as there is a motion on which they do; 0 where any will do.
    """

    direction: Floats | None = None
    limited: Flags | bool = False
    straight: bool = False
    report: Callable[[int], None] | None = None
    names: Sequence[JointId] | None = None
    allowance: Allowance | None = None
    locked: Sequence[int] = ()
    events: Sequence[Event] = ()
    signs: Floats | None = None


@dataclass(frozen=True, slots=True)
class Path:
    """Configurations that a linkage passes through: while joints are driven, or round a circuit.

    Attributes
    ----------
    angles : float[F, J]
        Joint angles of each frame, radians; the first is where it began.
    errors : float[F]
        Loop-closure residuals, in radians and units of the extent.
    stopped : str
        Why it ended before its goal, and how far it came; empty if it reached it.
    events : tuple of PathEvent
        Turning points of the driver, panels on each other, ranks that drop, in their order.
    watched : bool
        Whether ranks were watched: for linkages of many joints they are not.
    """

    angles: Floats
    errors: Floats
    stopped: str
    events: tuple[PathEvent, ...] = ()
    watched: bool = True

    @property
    def error(self) -> float:
        """The largest loop-closure residual of all frames."""
        return float(self.errors.max(initial=0.0))

    @property
    def meets(self) -> tuple[Floats, ...]:
        """Singular configurations on it, float[J], where another curve meets it."""
        return tuple(event.angles for event in self.events if event.kind == "rank drop")

    @property
    def turning(self) -> list[int]:
        """Numbers of its frames that are turning points of a joint, if these were looked for."""
        return [event.frame for event in self.events if event.kind == "turning point"]

    def __repr__(self) -> str:
        return f"<Path: {numbered(len(self.angles), 'frame')}, {numbered(len(self.events), 'event')}>"

    def up_to(self, frames: int) -> Path:
        """Return the first frames, and the events before the last of them."""
        events = tuple(event for event in self.events if event.frame < frames - 1)
        return replace(self, angles=self.angles[:frames], errors=self.errors[:frames], events=events)


def driven_path(
    closure: ClosureEquations,
    start: Floats,
    drivers: Sequence[int],
    values: npt.ArrayLike,
    *,
    options: PathOptions | None = None,
) -> Path:
    """Return the closed configurations at which driven joints have some angles, one after the other.

    Parameters
    ----------
    closure : ClosureEquations
    start : float[J]
        A closed configuration, radians.
    drivers : sequence of int
        Places of the joints that are driven.
    values : float[F, D]
        Their angles in each frame, radians.
    options : PathOptions, optional

    Examples
    --------
    A Bennett linkage, its first joint turned by 90 degrees:

    >>> from synth.analysis.moving._configuration_of import configuration_of
    >>> from synth.catalogue.patterns import generate
    >>> linkage = configuration_of(generate("bennett").mechanism).linkage
    >>> path = driven_path(ClosureEquations(linkage), linkage.angles, [0], [[np.pi / 4], [np.pi / 2]])
    >>> np.degrees(path.angles[:, 0]).round(3).tolist(), path.stopped
    ([0.0, 45.0, 90.0], '')
    """
    drive = Drive(closure, start, drivers, options or PathOptions())
    stopped = ""
    for value in np.asarray(values, dtype=float).reshape(-1, len(drivers)):
        stopped = drive.to(value)
        if stopped:
            break
    return drive.path(stopped)


class Drive:
    """Joints driven from one goal to the next; with one freedom past the turning points of the driven joint."""

    def __init__(self, closure: ClosureEquations, start: Floats, drivers: Sequence[int], options: PathOptions) -> None:
        moving = closure.locked(options.locked) if options.locked else closure
        watch = RankWatch(closure) if 0 < closure.joints <= WATCHED and closure.rows else None
        self._walk = Walk(
            moving,
            start,
            options.direction,
            straight=options.straight,
            allowance=options.allowance,
            watch=watch,
            kept=None if options.signs is None else KeptSigns(options.signs),
        )
        self._frames = self._walk.frames
        self._drivers, self._report = list(drivers), options.report
        self._names: Sequence[JointId] = range(closure.joints) if options.names is None else options.names
        self._events: list[Event] = [RankDeficiency(closure)] if watch is not None else []
        if np.any(options.limited):
            self._events.append(Limit(np.broadcast_to(options.limited, closure.joints), self._names))
        self._others = options.events
        self._watched = watch is not None or not closure.rows

    def to(self, value: Floats) -> str:
        """Go on until the driven joints have given angles float[D], radians; return why they come no nearer."""
        walk, first, met = self._walk, len(self._frames), len(self._walk.met)
        goal = DrivenGoal(self._drivers, value, walk.here, self._names)
        turning = TurningPoint(goal.joint, goal.way)
        walk.towards(goal, [*self._events, *([] if goal.several else [turning]), goal, *self._others])
        while goal.ahead(walk.here) and (step := next(walk, None)) is not None:
            if step.after is turning.last:
                self._frames.append(step.after)
                if len(self._frames) == first + 1:
                    home = Return(step.after.angles, step.arriving, "the path comes round to there", _MOST_PAST)
                    walk.events.append(home)
        if walk.ended and walk.met[met:] and walk.met[-1].kind == "collision":
            return walk.ended
        stuck = walk.ended and np.array_equal(walk.here.angles, self._frames[-1].angles)
        if not stuck and walk.here is not turning.last:
            self._frames.append(walk.here)
        if walk.ended and goal.turned:
            return self._nearest(goal, first, met)
        if not walk.ended and self._report is not None:
            self._report(len(self._frames))
        return walk.ended

    def path(self, stopped: str) -> Path:
        """Return the frames, with why there are no more."""
        angles = np.array([frame.angles for frame in self._frames])
        errors = np.array([frame.error for frame in self._frames])
        return Path(angles, errors, stopped, tuple(self._walk.met), self._watched)

    def _nearest(self, goal: DrivenGoal, first: int, met: int) -> str:
        """Take back the frames beyond the turning point at which the driver came nearest to its goal."""
        walk, frames = self._walk, self._frames
        best = first + trailing(np.array([goal.ahead(frame) for frame in frames[first:]]), scale=1.0)
        turns = [at for at in range(met, len(walk.met)) if walk.met[at].kind == "turning point"]
        if best == len(frames) - 1:
            return walk.ended
        del walk.met[turns[best - first] + 1 :]
        stopped = f"{goal.turns_back(frames[best])}; past that, {walk.ended}"
        del frames[best + 1 :]
        return stopped


def circuit_through(
    closure: ClosureEquations, start: Floats, *, towards: Floats | None = None, events: Sequence[Event] = ()
) -> Path:
    """Follow the configurations of a linkage of one freedom from one of them, in one sense.

    Angles of the path are not wrapped: the last configuration of a closed circuit is the first, but for whole
    turns.

    Parameters
    ----------
    closure : ClosureEquations
    start : float[J]
        A closed configuration, radians.
    towards : float[J], optional
        Rates whose sense the circuit takes.
    events : sequence of Event, optional
        Events to record. The frames of the walk are the configurations of the circuit.

    Raises
    ------
    UnsolvableError
        If the rates there do not have just one freedom.

    Examples
    --------
    All joints of a Bennett linkage turn all round:

    >>> from synth.analysis.moving._configuration_of import configuration_of
    >>> from synth.catalogue.patterns import generate
    >>> linkage = configuration_of(generate("bennett").mechanism).linkage
    >>> circuit = circuit_through(ClosureEquations(linkage), linkage.angles)
    >>> circuit.stopped, (np.abs(circuit.angles[-1] - circuit.angles[0]) / (2 * np.pi)).round(9).tolist()
    ('', [1.0, 1.0, 1.0, 1.0])
    """
    rates = rates_at(closure, start)
    if rates.shape[1] != 1:
        freedoms = numbered(rates.shape[1], "infinitesimal degree of freedom", "infinitesimal degrees of freedom")
        raise UnsolvableError(f"the linkage has {freedoms} at this configuration, expected 1 for a single curve")
    tangent = -rates[:, 0] if towards is not None and rates[:, 0] @ towards < 0.0 else rates[:, 0]
    watched = closure.joints <= WATCHED
    walk = Walk(closure, start, tangent, watch=RankWatch(closure) if watched else None)
    walk.events = [RankDeficiency(closure), *events, Return(start, tangent)]
    for step in walk:
        walk.frames.append(step.after)
    angles = np.array([frame.angles for frame in walk.frames])
    stopped = "" if walk.ended == Return.ROUND else walk.ended
    if stopped:
        stopped += f" where a joint has turned {degrees(float(np.abs(angles[-1] - start).max())):.6g}°"
    return Path(angles, np.array([frame.error for frame in walk.frames]), stopped, tuple(walk.met), watched)


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
