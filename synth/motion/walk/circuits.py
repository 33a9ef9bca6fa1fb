"""Circuits: the closed curve of configurations that a linkage of one freedom passes through, past all dead points.

A path of driven joints (`synth.motion.path`) ends where they cannot come nearer to their angles. A circuit has no
driver: the walk goes along the curve itself, until it comes back to where it began. Theory: docs/theory/moving.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees

import numpy as np

from graphs.errors import UnsolvableError, numbered
from graphs.types import Floats
from synth.motion.closure import ClosureEquations
from synth.motion.path import Path
from synth.motion.second_order import rates_at
from synth.motion.walk.events import RankDeficiency, Return
from synth.motion.walk.rank import WATCHED, RankWatch
from synth.motion.walk.walking import Event, Walk

__all__ = ["circuit_through"]


def circuit_through(
    closure: ClosureEquations, start: Floats, towards: Floats | None = None, events: Sequence[Event] = ()
) -> Path:
    """Follow the configurations of a linkage of one freedom from one of them, one way.

    Angles of the path are not wrapped: of a closed circuit, which nothing stopped, the last configuration is the
    first, but for whole turns.

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
    >>> circuit.stopped, (np.abs(circuit.angles[-1] - circuit.angles[0]) / (2 * np.pi)).round(9).tolist()
    ('', [1.0, 1.0, 0.0, 0.0])
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
