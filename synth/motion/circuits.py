"""Circuits: the closed curve of configurations that a linkage of one freedom passes through, past all dead points.

A path of driven joints (`synth.motion.path`) ends where they cannot come nearer to their angles. A circuit has no
driver: the walk goes along the curve itself, until it comes back to where it began. Theory: docs/theory/moving.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees

import numpy as np

from graphs.arrays import Floats
from graphs.errors import UnsolvableError, numbered
from synth.motion.closure import ClosureEquations
from synth.motion.second_order import rates_at
from synth.motion.walk.event import PathEvent
from synth.motion.walk.events import RankDeficiency, Return
from synth.motion.walk.rank import WATCHED, RankWatch
from synth.motion.walk.walking import Event, Walk

__all__ = ["Circuit", "circuit_through"]


@dataclass(frozen=True, slots=True)
class Circuit:
    """Configurations along a curve, from one on.

    Attributes
    ----------
    angles : float[F, J]
        Joint angles, radians, of each; not wrapped. Of a closed one the last is the first, but for whole turns.
    error : float
        By how much loops do not close, at most.
    stopped : str
        Why it ended before it was closed; empty if it did not.
    events : tuple of PathEvent
        What was met on it.
    """

    angles: Floats
    error: float
    stopped: str
    events: tuple[PathEvent, ...] = ()

    @property
    def closed(self) -> bool:
        """Whether it comes back to where it began."""
        return not self.stopped

    @property
    def meets(self) -> tuple[Floats, ...]:
        """Singular configurations on it, float[J], where another curve meets it; it was followed straight on."""
        return tuple(event.angles for event in self.events if event.kind == "rank drop")

    @property
    def turning(self) -> list[int]:
        """Numbers of its configurations that are turning points of a joint, if these were looked for."""
        return [event.frame for event in self.events if event.kind == "turning point"]


def circuit_through(
    closure: ClosureEquations, start: Floats, towards: Floats | None = None, events: Sequence[Event] = ()
) -> Circuit:
    """Follow the configurations of a linkage of one freedom from one of them, one way.

    Parameters
    ----------
    closure : ClosureEquations
    start : float[J]
        A closed configuration, radians.
    towards : float[J], optional
        Which of the two ways.
    events : sequence of Event, optional
        What is looked for on the way. The frames of the walk are the configurations of the circuit.

    Raises
    ------
    UnsolvableError
        If there are not just one freedom's rates there.

    Examples
    --------
    A four-bar in the plane whose first joint turns all round:

    >>> from graphs.loops.loop import Loop
    >>> from graphs.mechanism.sc import SCGraph
    >>> from synth.motion.linkage import linkage_of_axes
    >>> ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop(range(4), "infinite")])
    >>> linkage = linkage_of_axes(ring, {i: (p, (0, 0, 1)) for i, p in enumerate([(0, 0), (0, 1), (3, 2), (3, 0)])
    ...                                  for p in [(*p, 0)]})
    >>> circuit = circuit_through(ClosureEquations(linkage), linkage.angles)
    >>> circuit.closed, (np.abs(circuit.angles[-1] - circuit.angles[0]) / (2 * np.pi)).round(9).tolist()
    (True, [1.0, 1.0, 0.0, 0.0])
    """
    rates = rates_at(closure, start)
    if rates.shape[1] != 1:
        freedoms = numbered(rates.shape[1], "infinitesimal freedom")
        raise UnsolvableError(f"the linkage has {freedoms} at the pose, expected one: no one curve leads on")
    tangent = -rates[:, 0] if towards is not None and rates[:, 0] @ towards < 0.0 else rates[:, 0]
    walk = Walk(closure, start, tangent, watch=RankWatch(closure) if closure.joints <= WATCHED else None)
    walk.events = [RankDeficiency(closure), *events, Return(start, tangent)]
    for step in walk:
        walk.frames.append(step.after)
    angles = np.array([frame.angles for frame in walk.frames])
    stopped = "" if walk.ended == Return.ROUND else walk.ended
    if stopped:
        stopped += f" where a joint has turned {degrees(float(np.abs(angles[-1] - start).max())):.6g} degrees"
    return Circuit(angles, max(frame.error for frame in walk.frames), stopped, tuple(walk.met))
