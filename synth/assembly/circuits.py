"""The circuits and branches that positions belong to.

Positions of one *circuit* are reached from each other without taking the linkage apart; those of one *branch* of
it without the driven joint turning back. Theory: docs/theory/positions.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from graphs.arrays import Floats, Ints
from graphs.tolerances import DOUBLE
from synth.motion.closure import ClosureEquations
from synth.motion.newton import corrected
from synth.motion.second_order import rates_at
from synth.moving.circuits import Circuit, circuit_through

__all__ = ["Members", "members_of_circuits"]

_NEARINGS = 4


@dataclass(frozen=True, slots=True)
class Members:
    """Where positions belong.

    Attributes
    ----------
    places : tuple of (int, int)
        Circuit and branch of each position, from 0; branches are counted in each circuit.
    notes : tuple of str
    """

    places: tuple[tuple[int, int], ...]
    notes: tuple[str, ...]


def members_of_circuits(closure: ClosureEquations, positions: Sequence[Floats], driver: int) -> Members:
    """Return which positions of a linkage of one freedom are on one circuit, and on one branch of it.

    Parameters
    ----------
    closure : ClosureEquations
    positions : sequence of float[J]
        Closed ones, radians.
    driver : int
        Place of the driven joint.

    Raises
    ------
    UnsolvableError
        If a position has not just one infinitesimal freedom.
    """
    places: dict[int, tuple[int, int]] = {}
    notes: list[str] = []
    circuits = 0
    for number, start in enumerate(positions):
        if number in places:
            continue
        circuit = circuit_through(closure, start)
        if not circuit.closed:
            notes.append(f"circuit {circuits + 1} was not followed all round: {circuit.stopped}")
        if circuit.meets:
            notes.append(f"circuit {circuits + 1} meets another one; it was followed straight on")
        segments = _segments(circuit, driver)
        places[number] = circuits, int(segments[0])
        for other in range(number + 1, len(positions)):
            where = _on(closure, circuit, positions[other]) if other not in places else None
            if where is not None:
                places[other] = circuits, _branch(closure, circuit, segments, (where, driver), positions[other])
        circuits += 1
    return Members(tuple(places[number] for number in range(len(positions))), tuple(notes))


def _segments(circuit: Circuit, driver: int) -> Ints:
    """Return the branch of each pose of a circuit: another where the driven joint turns back."""
    signs = np.sign(circuit.rates[:, driver])
    segments = np.concatenate([[0], np.cumsum(signs[1:] * signs[:-1] < 0.0)])
    last = int(segments[-1])
    if circuit.closed and last and signs[-1] == signs[0]:  # the last is the first again
        segments[segments == last] = 0
    return np.asarray(segments, dtype=np.int64)


def _on(closure: ClosureEquations, circuit: Circuit, position: Floats) -> int | None:
    """Return after which pose of a circuit it passes a position; None if it does not."""
    off = position - circuit.angles
    off -= 2 * np.pi * np.rint(off / (2 * np.pi))
    nearest = int(np.linalg.norm(off, axis=1).argmin())
    for pose in (nearest, nearest - 1):
        if 0 <= pose < len(circuit.angles) - 1 and _passes(closure, circuit, pose, off[pose]):
            return pose
    return None


def _passes(closure: ClosureEquations, circuit: Circuit, pose: int, off: Floats) -> bool:
    """Tell whether a circuit passes, between a pose and the next, what is so far from the pose."""
    first = circuit.angles[pose]
    along = circuit.angles[pose + 1] - first
    part = float(off @ along) / float(along @ along)
    if not -0.5 <= part <= 1.5:
        return False
    target, here = first + off, first + part * along
    for _ in range(_NEARINGS):
        here = corrected(closure, here).angles
        here = here + (target - here) @ along / (along @ along) * along
    return float(np.abs(corrected(closure, here).angles - target).max()) <= DOUBLE.same_configuration


def _branch(
    closure: ClosureEquations, circuit: Circuit, segments: Ints, where: tuple[int, int], position: Floats
) -> int:
    """Return the branch of a position that a circuit passes after a pose."""
    pose, driver = where
    if segments[pose] == segments[pose + 1]:
        return int(segments[pose])
    rates = rates_at(closure, position)[:, 0]
    rate = rates[driver] * np.sign(rates @ circuit.rates[pose])
    return int(segments[pose] if rate * circuit.rates[pose, driver] > 0.0 else segments[pose + 1])
