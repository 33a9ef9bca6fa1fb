"""Positions of a linkage, as data and in print. Theory: docs/theory/positions.md."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import degrees
from typing import Any

from graphs.errors import numbered
from graphs.printing import Block, Printed, TableBlock, plain
from graphs.types import Floats, JointId
from synth.motion.configuration import Configuration

__all__ = ["Position", "Positions"]

_OTHER_QUESTION = "positions finds all configurations at given angles of driven joints, on all branches"


@dataclass(frozen=True, slots=True)
class Position:
    """One position.

    Attributes
    ----------
    angles : float[J]
        Of all joints, radians, from -pi to pi; creases from flat, other joints from the pose given. Of prismatic
        joints lengths, in the unit of the coordinates.
    regular : bool
        Whether the linkage is rigid there while its driven joints are held, by the rank of its closure equations.
    circuit, branch : int or None
        From 0; positions of one circuit are reached from each other, those of one branch without the driven joint
        turning back. None where they are not told.
    """

    angles: Floats
    regular: bool = True
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
        Radians; of prismatic joints lengths.
    positions : tuple of Position
        Real ones.
    general : int
        How many a generic realisation of the family has, real or not.
    imaginary : int
        Those of this one that are not real.
    far : int
        Those that are gone to infinity, for its proportions are special.
    singular : int
        Those that end at singular configurations: where the linkage moves though its driven joints are held, or
        where positions come together.
    lost : int
        Those that are not known: lost on the way.
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
    singular: int
    lost: int
    curves: int
    notes: tuple[str, ...] = ()

    @property
    def exhaustive(self) -> bool:
        """Whether each position of the general member was followed to one that is listed, or to infinity."""
        return not self.lost and not self.singular

    @property
    def slides(self) -> frozenset[JointId]:
        """The prismatic joints."""
        return frozenset(self.joints[place] for place in self.configuration.linkage.slides)

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return {
            "configuration": self.configuration.to_json(other_question=_OTHER_QUESTION),
            **self._values(self.driven.items(), "driven_deg", "driven_lengths"),
            "positions": [
                {
                    **self._values(zip(self.joints, one.angles.tolist(), strict=True), "angles_deg", "lengths"),
                    "regular": one.regular,
                    "circuit": one.circuit,
                    "branch": one.branch,
                }
                for one in self.positions
            ],
            "general": self.general,
            "imaginary": self.imaginary,
            "at_infinity": self.far,
            "singular": self.singular,
            "lost": self.lost,
            "exhaustive": self.exhaustive,
            "curves": self.curves,
            "notes": list(self.notes),
        }

    def _values(self, values: Iterable[tuple[JointId, float]], angles: str, lengths: str) -> dict[str, Any]:
        """Return angles in degrees under one key, and where joints slide lengths under another."""
        slides, values = self.slides, list(values)
        turned = {str(joint): degrees(value) for joint, value in values if joint not in slides}
        slid = {str(joint): value for joint, value in values if joint in slides}
        return {angles: turned, lengths: slid} if slides else {angles: turned}

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        inputs = " and ".join(
            f"joint {plain(joint)} at {value:g}"
            if joint in self.slides
            else f"joint {plain(joint)} at {degrees(value):g}°"
            for joint, value in self.driven.items()
        )
        number = numbered(len(self.positions), "position")
        blocks: list[Block] = [f"{number} with {inputs}" if inputs else number]
        if self.positions:
            all_rigid = all(position.regular for position in self.positions)
            titles = (
                "position",
                *(() if all_rigid else ("rigid",)),
                "circuit",
                "branch",
                *map(plain, self.joints),
            )
            rows = [
                (
                    str(number),
                    *(() if all_rigid else ("yes" if one.regular else "no",)),
                    _one_more(one.circuit),
                    _one_more(one.branch),
                    *(
                        f"{(value if joint in self.slides else degrees(value)) + 0.0:.4f}"
                        for joint, value in zip(self.joints, one.angles.tolist(), strict=True)
                    ),
                )
                for number, one in enumerate(self.positions, start=1)
            ]
            blocks.append(TableBlock(titles, rows, titles))
        return [*blocks, self._evidence(), *(f"note: {note}" for note in self.notes)]

    def _evidence(self) -> str:
        """Say how it is known that these are all."""
        parts = [f"{len(self.positions)} real", f"{self.imaginary} complex"]
        if self.far:
            parts.append(f"{self.far} at infinity")
        movable = sum(not one.regular for one in self.positions)
        if movable:
            parts[0] += f" ({movable} of them singular)"
        if self.singular:
            parts.append(
                f"{self.singular} at singular configurations, where the linkage moves or positions coincide"
            )
        if self.lost:
            parts.append(f"{self.lost} lost in tracking")
        counted = f"a generic realisation has {self.general}, counted over {numbered(self.curves, 'closed curve')}"
        tracked = "all solutions tracked" if self.exhaustive else "not all solutions tracked"
        return f"{tracked}: {counted}; here {', '.join(parts)}"

    def __repr__(self) -> str:
        return f"<Positions: {len(self.positions)} of {self.general}>"


def _one_more(number: int | None) -> str:
    return "-" if number is None else str(number + 1)
