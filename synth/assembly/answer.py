"""Positions of a linkage, as data and in print. Theory: docs/theory/positions.md."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import degrees
from typing import Any

import numpy as np

from graphs.arrays import Floats
from graphs.errors import numbered
from graphs.ids import JointId
from graphs.printing import Block, Printed, TableBlock, plain
from synth.motion.configuration import Configuration

__all__ = ["Position", "Positions"]

_OTHER_QUESTION = "positions finds all configurations at angles of driven joints, whatever branch they are on"


@dataclass(frozen=True, slots=True)
class Position:
    """One position.

    Attributes
    ----------
    angles : float[J]
        Of all joints, radians, from -pi to pi; creases from flat, other joints from the pose given.
    circuit, branch : int or None
        From 0; positions of one circuit are reached from each other, those of one branch without the driven joint
        turning back. None where they are not told.
    """

    angles: Floats
    circuit: int | None = None
    branch: int | None = None


@dataclass(frozen=True, slots=True, repr=False)
class Positions(Printed):
    """All positions at given angles of driven joints. It prints as ``synth positions`` does.

    Attributes
    ----------
    configuration : Configuration
        Where it was asked.
    joints : tuple of joint ids
    driven : mapping of joint id to float
        Radians.
    positions : tuple of Position
        Real ones.
    general : int
        How many a general member of the family has, real or not.
    imaginary : int
        Those of this one that are not real.
    far : int
        Those that are gone to infinity, for its proportions are special.
    lost : int
        Those that are not known: lost on the way, or together with others in one place.
    curves : int
        Closed curves of members that were walked to count those of a general member.
    notes : tuple of str
    """

    configuration: Configuration
    joints: tuple[JointId, ...]
    driven: Mapping[JointId, float]
    positions: tuple[Position, ...]
    general: int
    imaginary: int
    far: int
    lost: int
    curves: int
    notes: tuple[str, ...] = ()

    @property
    def exhaustive(self) -> bool:
        """Whether every position of the general member was followed here."""
        return not self.lost

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return {
            "configuration": self.configuration.to_json(other_question=_OTHER_QUESTION),
            "driven_deg": {str(joint): degrees(angle) for joint, angle in self.driven.items()},
            "positions": [
                {
                    "angles_deg": {
                        str(joint): float(np.degrees(angle))
                        for joint, angle in zip(self.joints, one.angles, strict=True)
                    },
                    "circuit": one.circuit,
                    "branch": one.branch,
                }
                for one in self.positions
            ],
            "general": self.general,
            "imaginary": self.imaginary,
            "at_infinity": self.far,
            "lost": self.lost,
            "exhaustive": self.exhaustive,
            "curves": self.curves,
            "notes": list(self.notes),
        }

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        inputs = ", ".join(f"joint {plain(joint)} at {degrees(angle):g}" for joint, angle in self.driven.items())
        blocks: list[Block] = [f"{numbered(len(self.positions), 'position')} with {inputs} degrees"]
        if self.positions:
            titles = ("position", "circuit", "branch", *map(plain, self.joints))
            rows = [
                (
                    str(number),
                    _one_more(one.circuit),
                    _one_more(one.branch),
                    *(f"{float(np.degrees(angle)) + 0.0:.4f}" for angle in one.angles),
                )
                for number, one in enumerate(self.positions, start=1)
            ]
            blocks.append(TableBlock(titles, rows, titles))
        return [*blocks, self._evidence(), *(f"note: {note}" for note in self.notes)]

    def _evidence(self) -> str:
        """Say how it is known that these are all."""
        parts = [f"{len(self.positions)} real", f"{self.imaginary} not"]
        if self.far:
            parts.append(f"{self.far} gone to infinity")
        if self.lost:
            parts.append(f"{self.lost} not known: lost on the way, or together with others")
        counted = f"a general member has {self.general}, counted over {numbered(self.curves, 'closed curve')}"
        return f"{'all' if self.exhaustive else 'not all'} of them followed: {counted}; here {', '.join(parts)}"

    def __repr__(self) -> str:
        return f"<Positions: {len(self.positions)} of {self.general}>"


def _one_more(number: int | None) -> str:
    return "-" if number is None else str(number + 1)
