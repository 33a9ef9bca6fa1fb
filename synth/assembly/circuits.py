"""The circuits and branches that positions belong to.

Positions of one *circuit* are reached from each other without taking the linkage apart; those of one *branch* of
it without the driven joint turning back. Theory: docs/theory/positions.md.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass

from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.motion.closure import ClosureEquations
from synth.motion.walk.circuits import circuit_through
from synth.motion.walk.events import TurningPoint
from synth.motion.walk.step import Step
from synth.motion.walk.walking import Event, Walk

__all__ = ["Members", "members_of_circuits"]


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

    Positions are closed, float[J], radians; the driver is the place of the driven joint. Raises `UnsolvableError`
    if a position has not exactly one infinitesimal freedom.
    """
    places: dict[int, tuple[int, int]] = {}
    notes: list[str] = []
    circuits = 0
    for number, start in enumerate(positions):
        if number in places:
            continue
        passed = _Passed({other: positions[other] for other in range(len(positions)) if other not in places})
        circuit = circuit_through(closure, start, events=[TurningPoint(driver), passed])
        if circuit.stopped:
            notes.append(f"circuit {circuits + 1} was not traced all round: {circuit.stopped}")
        if circuit.meets:
            notes.append(f"circuit {circuits + 1} meets another one; it was traced straight on")
        branches = len(circuit.turning) if not circuit.stopped and circuit.turning else len(circuit.turning) + 1
        for other, frame in {**passed.frames, number: 0}.items():
            places[other] = circuits, bisect_right(circuit.turning, frame) % branches
        circuits += 1
    return Members(tuple(places[number] for number in range(len(positions))), tuple(notes))


class _Passed(Event):
    """Where a walk passes some positions, float[J] each: `frames` are those before them."""

    def __init__(self, positions: dict[int, Floats]) -> None:
        self._positions = positions
        self.frames: dict[int, int] = {}

    def after(self, walk: Walk, step: Step) -> None:
        for number, position in self._positions.items():
            if number not in self.frames and step.passing(position, DOUBLE.same_configuration) is not None:
                self.frames[number] = len(walk.frames) - 1
