"""What a path meets: turning points of a driver, panels on each other, poses at which a rank drops."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees
from typing import Any, Literal

from graphs.errors import numbered, shown
from graphs.types import Floats, JointId

__all__ = ["EventKind", "PathEvent", "in_degrees", "named"]

EventKind = Literal["turning point", "limit", "rank drop", "collision", "turns over"]


_DIGITS: dict[EventKind, int] = {"turning point": 6, "limit": 4, "rank drop": 3, "collision": 6, "turns over": 2}
"""Decimals of a degree: a singular value of zero, and panels that lie flat on each other, are found to the root of
rounding."""


@dataclass(frozen=True, slots=True)
class PathEvent:
    """Something that a path met.

    Attributes
    ----------
    kind : {"turning point", "limit", "rank drop", "collision", "turns over"}
        Turning point: the driven joint has its extreme angle there. Limit: panels lie on each other. Rank drop:
        the closure equations leave more rates than before and after; branches may part there. Collision: panels
        begin to pass through each other. Turns over: the angle of a crease changes its sign.
    frame : int
        The last frame before it, or at it.
    driver : int
        Place of the driven joint; of several, of the one that has farthest to go.
    joints : tuple of int
        Places of the joints that lie at 180 degrees, or turn over; of other kinds, the driver.
    angles : float[J]
        Joint angles there, radians: a turning point closes as frames do, a limit is bracketed to 1e-9 of a step,
        and at a rank drop, where Newton's method would not keep to the path, they are interpolated.
    drop : int
        By how much the rank is less than beside it; 0 of other kinds.
    other_ways : int or None
        Of a rank drop, ways to go on, to second order, besides that of the path; None where that does not tell.
    panels : tuple of int
        Of a collision, the two links.
    """

    kind: EventKind
    frame: int
    driver: int
    joints: tuple[int, ...]
    angles: Floats
    drop: int = 0
    other_ways: int | None = None
    panels: tuple[int, ...] = ()

    def to_json(self, names: Sequence[JointId]) -> dict[str, Any]:
        """Return the event as plain data, angles in degrees."""
        return {
            "kind": self.kind,
            "frame": self.frame,
            "driver": names[self.driver],
            "at_deg": self._at_deg,
            "joints": [names[joint] for joint in self.joints],
            "drop": self.drop,
            "other_ways": self.other_ways,
            "panels": list(self.panels),
        }

    @property
    def _at_deg(self) -> float:
        """The angle of the driver in degrees, to the digits that the place of the event is known to."""
        return round(degrees(float(self.angles[self.driver])), _DIGITS[self.kind]) + 0.0

    def line(self, names: Sequence[JointId]) -> str:
        """Return the event in one line, joints called by names: sequence of J ids."""
        at = f"at joint {shown(names[self.driver])} = {self._at_deg:.6g}°"
        if self.kind == "turning point":
            return f"turning point {at}"
        if self.kind == "limit":
            return f"limit {at}: panels lie on each other at {named(self.joints, names)}"
        if self.kind == "collision":
            return f"collision {at}: panels {self.panels[0]} and {self.panels[1]}"
        if self.kind == "turns over":
            return f"sign change {at}: {named(self.joints, names, 'crease')}, since no motion keeps all signs"
        others = self.other_ways
        lower = f"rank of the closure equations {self.drop} lower"
        branches = "branches may meet"
        if others is not None:
            branches = f"{numbered(others, 'other motion branch', 'other motion branches')} (second order)"
        return f"singular configuration {at}: {lower}; {branches}"


def in_degrees(angle: float, decimals: int = 6) -> str:
    """Return an angle, radians, in words.

    Examples
    --------
    >>> in_degrees(1.0471975511966), in_degrees(-1e-12), in_degrees(1.0458, decimals=1)
    ('60°', '0°', '59.9°')
    """
    return f"{round(degrees(angle), decimals) + 0.0:.6g}°"


def named(joints: Sequence[int], names: Sequence[JointId], noun: str = "joint") -> str:
    """Return some joints by their names, after what they are.

    Examples
    --------
    >>> named([0, 2], ["a", "b", "c"])
    "joints 'a', 'c'"
    """
    return f"{noun}{'s' * (len(joints) != 1)} " + ", ".join(shown(names[joint]) for joint in joints)
