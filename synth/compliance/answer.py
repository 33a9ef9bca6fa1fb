"""Compliance states, as data and in print. Theory: docs/theory/compliance.md."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees
from typing import Any

import numpy as np

from graphs.errors import numbered, shown
from graphs.printing import Block, Printed, TableBlock
from graphs.tolerances import DOUBLE, canonical_order
from graphs.types import Floats, JointId
from synth.compliance.equilibrium import Equilibrium
from synth.compliance.freedoms import State
from synth.compliance.members import Members
from synth.compliance.small_motions import SmallMotion
from synth.motion.configuration import Configuration

__all__ = ["Elastic", "PathPose", "RestPassed", "States", "Transition"]

_LISTED = 20
"""Sets, transitions, poses and modes that are printed; data has all."""

_OTHER_QUESTION = "states asks of each set of active members which freedoms it has, on the freest branch"


@dataclass(frozen=True, slots=True)
class Transition:
    """A change of state that makes a mechanism one of a class, by the class's name."""

    name: str
    before: State
    after: State

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {"class": self.name, "before": self.before.to_json(), "after": self.after.to_json()}

    def told(self) -> str:
        """Return the transition as a line."""
        return f"{self.name}: {_told(self.before)} to {_told(self.after)}"


@dataclass(frozen=True, slots=True)
class PathPose:
    """A pose of the load path, and the state of the mechanism there."""

    pose: Equilibrium
    state: State


@dataclass(frozen=True, slots=True)
class RestPassed:
    """A compliant joint that comes to its rest angle between two poses of the load path, or at one.

    `driven` is the angle of the driven joint there, radians.
    """

    joint: JointId
    driven: float


@dataclass(frozen=True, slots=True)
class Elastic:
    """What springs do: the pose at which they and moments are in balance, and a path that begins there.

    `joints` are the columns of angles and rates; `path` holds the poses while the driver is driven, `stopped` says
    why they end before the goal. `modes` are those about the equilibrium; None where no masses were given.
    """

    joints: tuple[JointId, ...]
    pose: Equilibrium
    driver: JointId | None = None
    path: tuple[PathPose, ...] = ()
    passed: tuple[RestPassed, ...] = ()
    stopped: str = ""
    modes: tuple[SmallMotion, ...] | None = None

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        modes = [
            {"frequency": one.frequency, "growth": one.growth, "rates": self._named(one.rates)}
            for one in self.modes or ()
        ]
        return {
            "equilibrium": self._pose(self.pose),
            "driver": self.driver,
            "path": [
                {
                    "driven_deg": degrees(float(one.pose.angles[self._column])),
                    "moment": float(one.pose.held[0]),
                    **self._pose(one.pose),
                    "state": one.state.to_json(),
                }
                for one in self.path
            ],
            "rest_passed": [{"joint": one.joint, "driven_deg": degrees(one.driven)} for one in self.passed],
            "stopped": self.stopped or None,
            "modes": None if self.modes is None else modes,
        }

    @property
    def _column(self) -> int:
        assert self.driver is not None
        return self.joints.index(self.driver)

    def _named(self, values: Floats) -> dict[str, float]:
        return {str(joint): value for joint, value in zip(self.joints, values.tolist(), strict=True)}

    def _pose(self, pose: Equilibrium) -> dict[str, Any]:
        return {
            "angles_deg": self._named(np.degrees(pose.angles)),
            "energy": pose.energy,
            "stable": pose.stable,
            "least_curvature": pose.least,
            "unbalanced": pose.unbalanced,
            "closure": pose.error,
        }

    def blocks(self) -> list[Block]:
        """Return the lines and tables that are printed."""
        how = "stable" if self.pose.stable else "not stable"
        ends = ", ".join(
            f"{shown(joint)} at {degrees(angle):.6g}"
            for joint, angle in zip(self.joints, self.pose.angles.tolist(), strict=True)
        )
        found = f"springs in balance, {how}, energy {self.pose.energy:.6g}"
        evidence = f"moments of {self.pose.unbalanced:.0e} left, loops close to {self.pose.error:.0e}"
        return [f"{found}   ({evidence})", f"joints: {ends}", *self._load_path(), *self._small_motions()]

    def _load_path(self) -> list[Block]:
        if self.driver is None:
            return []
        level = DOUBLE.zero * max(abs(float(one.pose.held[0])) for one in self.path)
        step = -(-len(self.path) // _LISTED)
        shown_poses = [*self.path[:-1:step], self.path[-1]]
        rows = [self._row(one, level) for one in shown_poses]
        columns = ("driven, degrees", "moment", "energy", "stable", "freedoms", "state")
        lines: list[Block] = [
            f"load path of joint {shown(self.driver)}:",
            TableBlock(columns, rows, ("driven, degrees", "moment", "energy", "freedoms")),
        ]
        if len(rows) < len(self.path):
            lines.append(f"{len(rows)} of {len(self.path)} poses")
        lines += [
            f"joint {shown(one.joint)} comes to rest at {degrees(one.driven):.6g} degrees of the driven joint"
            for one in self.passed
        ]
        return [*lines, *([f"stopped: {self.stopped}"] if self.stopped else [])]

    def _row(self, one: PathPose, level: float) -> tuple[str, ...]:
        moment = float(one.pose.held[0])
        return (
            f"{degrees(float(one.pose.angles[self._column])):.6g}",
            f"{moment:.6g}" if abs(moment) > level else "0",
            f"{one.pose.energy:.6g}",
            "yes" if one.pose.stable else "no",
            _number(one.state.freedoms),
            one.state.kind,
        )

    def _small_motions(self) -> list[Block]:
        if self.modes is None:
            return []
        rows = []
        for mode in self.modes[:_LISTED]:
            told = f"{mode.frequency:.6g}" if mode.frequency is not None else f"grows at {mode.growth:.6g}"
            largest = canonical_order(list(-np.abs(mode.rates)[:, None]))[:6]
            moves = ", ".join(f"{shown(self.joints[place])}: {mode.rates[place]:.3g}" for place in largest)
            rows.append((told, moves))
        table = TableBlock(("frequency", "joints that move most"), rows, ("frequency",))
        more = len(self.modes) - len(rows)
        return ["small motions about it:", table, *([f"and {more} faster ones"] if more else [])]


@dataclass(frozen=True, slots=True, repr=False)
class States(Printed):
    """The compliance states of a mechanism at its pose. It prints as ``synth states`` does.

    Attributes
    ----------
    configuration : Configuration
        Where it was asked.
    compliant : Members
    now : State
        Members are active whose springs are not at rest.
    sets : tuple of State
        For each set of active members, smaller ones first.
    transitions : tuple of Transition
        The smallest that make it a mechanism of each class.
    elastic : Elastic or None
        What springs do, where there are any.

    Examples
    --------
    >>> from synth.compliance import states
    >>> from synth.patterns import generate
    >>> states(generate("four-bar").mechanism, [0])
    <States: rigid immobile; compliant mechanism>
    """

    configuration: Configuration
    compliant: Members
    now: State
    sets: tuple[State, ...]
    transitions: tuple[Transition, ...]
    elastic: Elastic | None = None

    @property
    def classes(self) -> tuple[str, ...]:
        """The classes that transitions at this pose make it one of."""
        return tuple(dict.fromkeys(one.name for one in self.transitions))

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return {
            "configuration": self.configuration.to_json(other_question=_OTHER_QUESTION),
            "compliant": self.compliant.to_json(),
            "state": self.now.to_json(),
            "sets": [one.to_json() for one in self.sets],
            "classes": list(self.classes),
            "transitions": [one.to_json() for one in self.transitions],
            "elastic": None if self.elastic is None else self.elastic.to_json(),
        }

    def blocks(self) -> list[Block]:
        """Return the lines and tables that are printed."""
        lines: list[Block] = [
            f"compliant: {self.compliant}",
            f"now {_told(self.now)}   ({self.now.certainty})",
        ]
        chosen = _telling(self.sets)
        rows = [(str(one.active), _number(one.freedoms), one.kind, one.certainty) for one in chosen[:_LISTED]]
        lines.append(TableBlock(("active", "freedoms", "state", "how known"), rows, ("freedoms",)))
        if len(self.sets) > len(rows):
            first = "" if len(rows) == len(chosen) else "the first of "
            lines.append(
                f"{len(rows)} of {numbered(len(self.sets), 'set')}: {first}those to which one member less gives "
                "other freedoms"
            )
        lines += [one.told() for one in self.transitions[:_LISTED]] or ["no transition of a class at this pose"]
        if len(self.transitions) > _LISTED:
            lines.append(f"and {len(self.transitions) - _LISTED} more transitions")
        return [*lines, *([] if self.elastic is None else self.elastic.blocks())]

    def __repr__(self) -> str:
        return f"<States: {self.now.kind}; {', '.join(self.classes) or 'no class'}>"


def _telling(sets: Sequence[State]) -> list[State]:
    """Return the states whose freedoms every set with a member less has not."""
    return [
        one
        for one in sets
        if not len(one.active)
        or all(
            other.freedoms != one.freedoms
            for other in sets
            if len(other.active) == len(one.active) - 1 and other.active.within(one.active)
        )
    ]


def _told(state: State) -> str:
    active = f", active: {state.active}" if len(state.active) else ""
    freedoms = "freedoms not known" if state.freedoms is None else numbered(state.freedoms, "freedom")
    return f"{state.kind} ({freedoms}{active})"


def _number(number: int | None) -> str:
    return "?" if number is None else str(number)
