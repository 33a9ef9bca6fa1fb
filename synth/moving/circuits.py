"""Circuits: the closed curve of poses that a linkage of one freedom passes through, past all dead points.

A path of a driven joint (`synth.motion.path`) ends where it turns back. A circuit has no driver: each step goes
along the curve itself, until it comes back to where it began. Theory: docs/theory/moving.md.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import degrees

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from graphs.arrays import Floats
from graphs.errors import UnsolvableError, numbered
from synth.motion.closure import ClosureEquations
from synth.motion.newton import Corrected, corrected
from synth.motion.second_order import rates_at

__all__ = ["Circuit", "circuit_through", "place_between"]

_FIRST, _LARGEST, _LEAST = 0.01, 0.1, 1e-7
"""Steps, radians of the joint that moves most."""
_STRAY, _BEND = 0.1, 0.98
"""A corrected pose is at most this part of its step from where it was expected; cosine between its rates and those
before, at least."""
_HOME = 1e-9
_NEAR, _SINGULAR = 0.1, 1e-6
"""Singular values at poses that may be near a singular one, and at one."""
_MOST = 20_000
_ROUNDED = 1e-10


@dataclass(frozen=True, slots=True)
class Circuit:
    """Poses along a curve, from one on.

    Attributes
    ----------
    angles : float[F, J]
        Joint angles, radians, of each; not wrapped. Of a closed one the last is the first, but for whole turns.
    rates : float[F, J]
        The way on, the largest 1 or -1.
    error : float
        By how much loops do not close, at most.
    stopped : str
        Why it ended before it was closed; empty if it did not.
    meets : tuple of float[J]
        Singular poses on it, where another curve meets it; it was followed straight on.
    """

    angles: Floats
    rates: Floats
    error: float
    stopped: str
    meets: tuple[Floats, ...] = ()

    @property
    def closed(self) -> bool:
        """Whether it comes back to where it began."""
        return not self.stopped


def circuit_through(closure: ClosureEquations, start: Floats, towards: Floats | None = None) -> Circuit:
    """Follow the poses of a linkage of one freedom from one of them, one way.

    Parameters
    ----------
    closure : ClosureEquations
    start : float[J]
        A closed pose, radians.
    towards : float[J], optional
        Which of the two ways.

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
    rates = _begin(closure, start, towards)
    here = corrected(closure, start)
    poses, ways, length = [here], [rates], _FIRST
    for _ in range(_MOST):
        home = _home(closure, poses, ways, length)
        if home is not None:
            return _made(closure, [*poses, home], [*ways, ways[0]], "")
        step = _step(closure, poses[-1], ways[-1], length)
        if step is None:
            told = degrees(float(np.abs(poses[-1].angles - start).max()))
            return _made(closure, poses, ways, f"no one way leads on where a joint has turned {told:.6g} degrees")
        end, onwards, length = step
        poses.append(end)
        ways.append(onwards)
    return _made(closure, poses, ways, f"not closed after {_MOST} steps")


def place_between(
    closure: ClosureEquations, circuit: Circuit, number: int, value: Callable[[Corrected], float]
) -> Floats:
    """Return the closed pose between two successive ones of a circuit at which a value is zero.

    Parameters
    ----------
    closure : ClosureEquations
    circuit : Circuit
    number : int
        Of the earlier pose.
    value : callable
        Of a pose; of different signs at the two, or zero.
    """
    first, last = circuit.angles[number], circuit.angles[number + 1]
    poses: dict[float, Floats] = {}

    def at(part: float) -> float:
        pose = corrected(closure, first + part * (last - first))
        poses[part] = pose.angles
        return value(pose)

    ends = at(0.0), at(1.0)
    if ends[0] * ends[1] >= 0.0:  # zero at an end, but for rounding
        return poses[0.0 if abs(ends[0]) <= abs(ends[1]) else 1.0]
    part = brentq(at, 0.0, 1.0, xtol=_ROUNDED, rtol=_ROUNDED)
    return poses[part] if part in poses else corrected(closure, first + part * (last - first)).angles


def _begin(closure: ClosureEquations, start: Floats, towards: Floats | None) -> Floats:
    rates = rates_at(closure, start)
    if rates.shape[1] != 1:
        told = numbered(rates.shape[1], "infinitesimal freedom")
        raise UnsolvableError(f"the linkage has {told} at the pose, expected one: no one curve leads on")
    way = _scaled(rates[:, 0])
    return -way if towards is not None and way @ towards < 0.0 else way


def _step(
    closure: ClosureEquations, here: Corrected, rates: Floats, length: float
) -> tuple[Corrected, Floats, float] | None:
    """Take one step of the length that can be trusted; return the pose, the way on, and the next length."""
    while length >= _LEAST:
        expected = here.angles + length * rates
        end = corrected(closure, expected)
        if end.closed and np.abs(end.angles - expected).max() <= _STRAY * length:
            onwards = _scaled(end.space.projected(rates))
            if onwards @ rates >= _BEND * np.linalg.norm(onwards) * np.linalg.norm(rates):
                return end, onwards, min(1.5 * length, _LARGEST)
        length /= 2.0
    return None


def _home(
    closure: ClosureEquations, poses: list[Corrected], ways: list[Floats], length: float
) -> Corrected | None:
    """Return the first pose, whole turns on, if the next step would pass it."""
    start, here, rates = poses[0].angles, poses[-1].angles, ways[-1]
    if len(poses) < 3 or ways[0] @ rates < _BEND * np.linalg.norm(ways[0]) * np.linalg.norm(rates):
        return None
    gap = start - here
    turned = start - 2.0 * np.pi * np.rint(gap / (2.0 * np.pi))
    along = (turned - here) @ rates / (rates @ rates)
    if not 0.0 < along <= length or np.abs(turned - here - along * rates).max() > _STRAY * length:
        return None
    pose = here
    for _ in range(4):  # the pose beside it on this curve, and whether it is the one
        pose = corrected(closure, pose + (turned - pose) @ rates / (rates @ rates) * rates).angles
    return corrected(closure, turned) if np.abs(pose - turned).max() <= _HOME else None


def _made(closure: ClosureEquations, poses: list[Corrected], ways: list[Floats], stopped: str) -> Circuit:
    angles = np.array([pose.angles for pose in poses])
    margins = np.array([_margin(pose) for pose in poses])
    lowest = 1 + np.flatnonzero((margins[1:-1] <= margins[:-2]) & (margins[1:-1] < margins[2:]))
    near = [number for number in lowest.tolist() if margins[number] < _NEAR]
    meets = [_singular(closure, angles[number - 1], angles[number + 1]) for number in near]
    found = tuple(pose for pose in meets if pose is not None)
    return Circuit(angles, np.array(ways), max(pose.error for pose in poses), stopped, found)


def _margin(pose: Corrected) -> float:
    """Return how far the equations are from having one freedom more: a singular value."""
    size = pose.jacobian.shape[1]
    values = np.linalg.svd(pose.jacobian.toarray(), compute_uv=False)
    return float(values[size - 2]) if 2 <= size <= len(values) + 1 else 0.0


def _singular(closure: ClosureEquations, first: Floats, last: Floats) -> Floats | None:
    """Return the pose between two near each other where there is a freedom more, if there is one."""

    def margin(part: float) -> float:
        return _margin(corrected(closure, first + part * (last - first)))

    lowest = minimize_scalar(margin, bounds=(0.0, 1.0), method="bounded", options={"xatol": _HOME})
    return corrected(closure, first + lowest.x * (last - first)).angles if lowest.fun < _SINGULAR else None


def _scaled(rates: Floats) -> Floats:
    return np.asarray(rates / (np.abs(rates).max() or 1.0))
