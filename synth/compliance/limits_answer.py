"""What ride-alongs leave, as data and in print. Theory: docs/theory/activating-constraints.md."""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees
from typing import Any, Literal

from graphs.errors import numbered, shown
from graphs.printing import Block, Printed, TableBlock
from graphs.types import JointId
from synth.motion.configuration import Configuration

__all__ = ["End", "Limits", "RideAlong", "Truss"]

_LISTED = 40

_OTHER_QUESTION = "limits looks at ride-alongs, each with the links that it sits on, and at no branch"


@dataclass(frozen=True, slots=True)
class End:
    """An end of a range of angles, radians: the links of a ride-along are in line there.

    One is beyond the other ("stretched"), or on it ("folded").
    """

    angle: float
    how: Literal["stretched", "folded"]

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {"at_deg": degrees(self.angle), "how": self.how}


@dataclass(frozen=True, slots=True)
class RideAlong:
    """A ride-along, and the angles it leaves to the joint it sits on.

    The second of its own `joints` is between its links. `angle`, radians, is that of `joint` at the pose; `lower`
    and `upper` end the range of this that holds the pose, None where it may turn round. `freedoms` are those of
    the mechanism with the ride-along rigid; None where they are not known.
    """

    joints: tuple[JointId, JointId, JointId]
    joint: JointId
    angle: float
    lower: End | None
    upper: End | None
    freedoms: int | None

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "joints": list(self.joints),
            "joint": self.joint,
            "angle_deg": degrees(self.angle),
            "lower": None if self.lower is None else self.lower.to_json(),
            "upper": None if self.upper is None else self.upper.to_json(),
            "freedoms": self.freedoms,
        }


@dataclass(frozen=True, slots=True)
class Truss:
    """What remains with all ride-alongs rigid: `locked` are the joints between their links.

    Rank is that of the closure equations at the pose, `redundant` counts those that follow from others, `freedoms`
    are those of finite motion; None where they are not known.
    """

    locked: tuple[JointId, ...]
    links: int
    joints: int
    rank: int | None
    redundant: int | None
    freedoms: int | None

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "locked": list(self.locked),
            "links": self.links,
            "joints": self.joints,
            "rank": self.rank,
            "redundant": self.redundant,
            "freedoms": self.freedoms,
        }


@dataclass(frozen=True, slots=True, repr=False)
class Limits(Printed):
    """What the ride-alongs of a mechanism leave. It prints as ``synth limits`` does.

    Attributes
    ----------
    configuration : Configuration
        Where it was asked.
    ride_alongs : tuple of RideAlong
        Those that sit on others come before these.
    truss : Truss

    Examples
    --------
    >>> from synth.compliance import limits
    >>> from synth.patterns import generate
    >>> limits(generate("deployable-cylinder", pleats=3).mechanism).truss.freedoms
    0
    """

    configuration: Configuration
    ride_alongs: tuple[RideAlong, ...]
    truss: Truss

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return {
            "configuration": self.configuration.to_json(other_question=_OTHER_QUESTION),
            "ride_alongs": [one.to_json() for one in self.ride_alongs],
            "truss": self.truss.to_json(),
        }

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        rows = [
            (
                shown(one.joint),
                " ".join(map(shown, one.joints)),
                _told(one.lower),
                f"{degrees(one.angle):.6g}",
                _told(one.upper),
                _number(one.freedoms),
            )
            for one in self.ride_alongs[:_LISTED]
        ]
        columns = ("on joint", "joints", "from, degrees", "now", "to, degrees", "freedoms when rigid")
        lines: list[Block] = [
            numbered(len(self.ride_alongs), "ride-along"),
            TableBlock(columns, rows, ("now", "freedoms when rigid")),
        ]
        if len(rows) < len(self.ride_alongs):
            lines.append(f"and {len(self.ride_alongs) - len(rows)} more")
        truss = self.truss
        freedoms = "freedoms not known" if truss.freedoms is None else numbered(truss.freedoms, "freedom")
        parts = f"{numbered(truss.links, 'link')}, {numbered(truss.joints, 'joint')}"
        evidence = f"rank {_number(truss.rank)}, {_number(truss.redundant)} redundant"
        return [*lines, f"with all of them rigid at this pose: {freedoms} ({parts}; {evidence})"]

    def __repr__(self) -> str:
        return f"<Limits: {numbered(len(self.ride_alongs), 'ride-along')}>"


def _told(end: End | None) -> str:
    return "any" if end is None else f"{degrees(end.angle):.6g}, {end.how}"


def _number(number: int | None) -> str:
    return "?" if number is None else str(number)
