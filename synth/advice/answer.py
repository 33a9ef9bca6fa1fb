"""Advice, as data and in print.

Theory: docs/theory/advice.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from graphs.errors import numbered, shown
from graphs.printing import Block, Printed, TableBlock
from graphs.types import JointId
from synth.advice.diagonals import Diagonal
from synth.motion.branches import Branch
from synth.motion.configuration import Configuration

__all__ = ["Advice", "Creased", "Locked"]

_USED_UP = "; the search ended at its work limit"
_LOOSE = 1e4
"""Play that is made so many times larger is told as more."""


@dataclass(frozen=True, slots=True)
class Locked:
    """Joints to lock.

    Attributes
    ----------
    joints : tuple of joint ids
    weight : float
        Sum of their weights.
    flaps : tuple of joint ids
        Those of them that are in no loop: they stop a flap, and nothing else.
    still : tuple of joint ids
        Joints that stand still then, besides.
    play : float
        How much larger, at most, the play of the rest is than that of the locked joints (root of summed squares).
    freedoms : int or None
        By the rank of the closure equations without these joints; None where singular values do not tell.
    left_out : int or None
        Of the flat sheet without these creases, on its freest way; None where that was not asked, or is not known.
    """

    joints: tuple[JointId, ...]
    weight: float
    flaps: tuple[JointId, ...]
    still: tuple[JointId, ...]
    play: float
    freedoms: int | None
    left_out: int | None = None

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "joints": list(self.joints),
            "weight": self.weight,
            "flaps": list(self.flaps),
            "still": list(self.still),
            "play": self.play,
            "freedoms": self.freedoms,
            "left_out": self.left_out,
        }


@dataclass(frozen=True, slots=True)
class Creased:
    """Diagonals of panels to crease.

    Attributes
    ----------
    diagonals : tuple of Diagonal
    flaps : int
        How many only cut a corner off, which hangs on them.
    freedoms : int
        Of the sheet with them, folded.
    """

    diagonals: tuple[Diagonal, ...]
    flaps: int
    freedoms: int

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        diagonals = [{"panel": one.panel, "face": one.face, "vertices": list(one.ends)} for one in self.diagonals]
        return {"diagonals": diagonals, "flaps": self.flaps, "freedoms": self.freedoms}


@dataclass(frozen=True, slots=True, repr=False)
class Advice(Printed):
    """What to lock or to crease. It prints as ``synth advise`` does.

    Attributes
    ----------
    configuration : Configuration
        Where it was asked.
    freedoms : int
        That there are, M.
    wanted : int
        K.
    branch : int or None
        The way to move on which that holds; None where the pose given is a general one.
    flaps : tuple of joint ids
        Joints in no loop: each a freedom by itself.
    locks : tuple of Locked
        Where there are too many freedoms: sets of M - K joints, cheapest first, of equal weight those with fewest
        flaps, then those whose joints move most.
    creases : tuple of Creased
        Where there are too few: the smallest sets of diagonals.
    more : bool
        Whether there are, or may be, more sets as small.
    used_up : bool
        Whether the search ended because its allowance of work was used up.
    searched : int or None
        The largest number of diagonals that was looked through.
    refused : int
        Sets of diagonals that have the rates and, folded, not the freedoms.
    """

    configuration: Configuration
    freedoms: int
    wanted: int
    branch: int | None
    flaps: tuple[JointId, ...] = ()
    locks: tuple[Locked, ...] = ()
    creases: tuple[Creased, ...] = ()
    more: bool = False
    used_up: bool = False
    searched: int | None = None
    refused: int = 0

    @property
    def taken(self) -> Branch | None:
        """The way to move on which that holds; None where nothing moves."""
        return self.configuration.branch(self.branch or 0)

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return {
            "configuration": self.configuration.to_json(self.taken),
            "freedoms": self.freedoms,
            "wanted": self.wanted,
            "branch": self.branch,
            "flaps": list(self.flaps),
            "locks": [one.to_json() for one in self.locks],
            "creases": [one.to_json() for one in self.creases],
            "more": self.more,
            "used_up": self.used_up,
            "searched": self.searched,
            "refused": self.refused,
            "mended": list(self.configuration.mended),
        }

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        where = (
            "at this configuration" if self.branch is None else f"near this configuration, on branch {self.branch}"
        )
        freedoms = numbered(self.freedoms, "degree of freedom", "degrees of freedom")
        lines: list[Block] = [f"{freedoms} {where}; required: {self.wanted}"]
        if self.wanted < self.freedoms:
            lines += self._locking()
        else:
            lines += self._creasing() if self.wanted > self.freedoms else ["nothing to change"]
        if self.flaps:
            joints = ", ".join(map(shown, self.flaps))
            lines.append(f"flap joints (in no loop, 1 degree of freedom each): {joints}")
        return [*lines, *(f"repaired: {repair}" for repair in self.configuration.mended)]

    def _locking(self) -> list[Block]:
        size = numbered(self.freedoms - self.wanted, "joint")
        rows: list[tuple[str, ...]] = [
            (
                _names(one.joints),
                f"{one.weight:g}",
                _names(one.flaps),
                _names(one.still),
                _play(one.play),
                _number(one.freedoms),
                _number(one.left_out),
            )
            for one in self.locks
        ]
        columns: tuple[str, ...] = ("lock", "weight", "flaps", "then immobile", "play", "DOF", "DOF if left out")
        if all(one.left_out is None for one in self.locks):
            columns, rows = columns[:-1], [row[:-1] for row in rows]
        heading = f"lock {size}: " + self._how_many(len(self.locks))
        return [heading, TableBlock(columns, rows, ["weight", "play", "DOF", "DOF if left out"])]

    def _creasing(self) -> list[Block]:
        lines: list[Block] = []
        if self.refused:
            rejected = f"rejected {numbered(self.refused, 'set')} of diagonals"
            lines.append(f"{rejected}: enough DOF to first order, too few when folded")
        if not self.creases:
            ended = "all were checked"
            if self.more:
                ended = "the search ended at a limit" + (_USED_UP if self.used_up else "")
            return [f"no set of {numbered(self.searched or 0, 'diagonal')} or fewer was found: {ended}", *lines]
        size = numbered(len(self.creases[0].diagonals), "diagonal")
        rows = [
            (
                ", ".join(f"{one.ends[0]}-{one.ends[1]} (panel {one.panel})" for one in creased.diagonals),
                str(creased.flaps),
                str(creased.freedoms),
            )
            for creased in self.creases
        ]
        heading = f"crease {size}: " + self._how_many(len(self.creases))
        return [heading, TableBlock(("from vertex to vertex", "flaps", "DOF"), rows, ["flaps", "DOF"]), *lines]

    def _how_many(self, listed: int) -> str:
        ended = _USED_UP if self.used_up else ""
        if self.more:
            return ("the first set" if listed == 1 else f"the first {listed} sets") + ended
        return f"{numbered(listed, 'set')}, all there are"

    def __repr__(self) -> str:
        return f"<Advice: {self.freedoms} to {self.wanted} freedoms, {len(self.locks) + len(self.creases)} sets>"


def _names(joints: tuple[JointId, ...]) -> str:
    return " ".join(map(shown, joints)) or "-"


def _number(number: int | None) -> str:
    return "?" if number is None else str(number)


def _play(play: float) -> str:
    return f"> {_LOOSE:.0f}" if play > _LOOSE else f"{play:.3g}"
