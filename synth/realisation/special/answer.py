"""What a search for special geometry found, as data and in print. Theory: docs/theory/realisation.md."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import degrees
from typing import Any

from graphs.convert.table import Mechanism
from graphs.errors import numbered, shown
from graphs.identity.drawings import map_id
from graphs.mechanism.sc import SCGraph, SpecialGeometry
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.printing import Block, Printed
from synth.motion.configuration import Configuration
from synth.realisation.special.judging import Moving

__all__ = ["FamilyTrial", "SpecialMember", "SpecialSearch"]


@dataclass(frozen=True)
class SpecialMember:
    """A member of special dimensions that moves.

    Attributes
    ----------
    family : str
        The conditions it was made by.
    start : int
        Number of the random start in its family, from 0.
    moving : Moving
        Its configuration and the branch it moves on.
    """

    family: str
    start: int
    moving: Moving

    @property
    def configuration(self) -> Configuration:
        """The member where it lies."""
        return self.moving.configuration

    @property
    def mechanism(self) -> Mechanism:
        """A flat sheet with the mountains and valleys of its branch, or hinged solids."""
        given = self.configuration.given
        assert isinstance(given, Sheet | HingedSolids)
        if isinstance(given, HingedSolids):
            return given
        signs = self.moving.branch.signs  # creases come first among the edges of what was drawn
        letters = "".join({"+": "V", "-": "M"}.get(sign, "U") for sign in signs)
        return replace(given, assignments=letters + given.assignments[len(letters) :])

    @property
    def freedoms(self) -> int:
        """Of finite motion."""
        return self.moving.branch.freedoms or 0

    @property
    def reasons(self) -> tuple[str, ...]:
        """What `synth.explain` recognises on the branch."""
        return self.moving.reasons

    @property
    def residual(self) -> float:
        """By how much loops do not close ten degrees on."""
        return self.moving.branch.error

    @property
    def mark(self) -> SpecialGeometry:
        """What is marked on the type."""
        return SpecialGeometry(self.freedoms, (self.family, *self.reasons))

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on."""
        branch = self.moving.branch
        return {
            "family": self.family,
            "start": self.start,
            "kind": "sheet" if isinstance(self.mechanism, Sheet) else "axes",
            "configuration": self.configuration.to_json(branch),
            "freedoms": self.freedoms,
            "certainty": branch.certainty,
            "followed_deg": degrees(branch.followed),
            "closure": self.residual,
            "h": self.moving.h,
            "reasons": list(self.reasons),
        }

    def lines(self) -> list[Block]:
        """Return the lines that are printed."""
        branch = self.moving.branch
        return [
            f"found: {self.family} (start {self.start + 1})",
            f"  {numbered(self.freedoms, 'freedom')}, {branch.certainty}: followed to "
            f"{degrees(branch.followed):.0f} degrees, loops close to {self.residual:.0e}, h = {self.moving.h}",
            f"  why: {', '.join(self.reasons) or 'no reason that is known here'}",
        ]


@dataclass(frozen=True)
class FamilyTrial:
    """What became of one family.

    Attributes
    ----------
    name : str
    starts : int
        Random starts that were made.
    work : float
        Steps of least squares, counted as of 60 unknowns, and of improved drawings.
    member : SpecialMember or None
        The first that moves as asked.
    reasons : tuple of (str, int)
        Why other starts do not do, and how many.
    used_up : bool
        Whether the allowance of work ended the search.
    """

    name: str
    starts: int
    work: float
    member: SpecialMember | None
    reasons: tuple[tuple[str, int], ...]
    used_up: bool = False

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on."""
        return {
            "name": self.name,
            "starts": self.starts,
            "work": round(self.work),
            "moves": self.member is not None,
            "reasons": dict(self.reasons),
            "used_up": self.used_up,
        }

    def line(self) -> str:
        """Return the line that is printed where nothing was found."""
        why = "; ".join(f"{number} x {shown(reason)}" for reason, number in self.reasons)
        ended = "; the allowance of work was used up" if self.used_up else ""
        return f"none: {self.name}, {numbered(self.starts, 'start')}: {why or 'nothing was made'}{ended}"


@dataclass(frozen=True)
class SpecialSearch(Printed):
    """Members of a type that move although counts say no, and every family that was tried.

    Attributes
    ----------
    graph : SCGraph
        The type.
    freedoms : int
        What was asked for.
    mobility : int
        M of the type by count, joints less closure equations.
    seed : int
    trials : tuple of FamilyTrial
    proof : str or None
        Why no member moves in all joints, where that is proved.
    """

    graph: SCGraph
    freedoms: int
    mobility: int
    seed: int
    trials: tuple[FamilyTrial, ...]
    proof: str | None = None

    @property
    def members(self) -> tuple[SpecialMember, ...]:
        """What was found, one of a family."""
        return tuple(trial.member for trial in self.trials if trial.member is not None)

    @property
    def work(self) -> float:
        """All work that was done."""
        return sum(trial.work for trial in self.trials)

    @property
    def type_with_mark(self) -> SCGraph:
        """The type with a mark of the first member; as it was where none was found."""
        return self.graph.marked(self.members[0].mark) if self.members else self.graph

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on (docs/command-json.md)."""
        return {
            "found": bool(self.members),
            "drawing": map_id(self.graph) if isinstance(self.graph, SCDGraph) else None,
            "freedoms_asked": self.freedoms,
            "mobility": self.mobility,
            "seed": self.seed,
            "proof": self.proof,
            "members": [member.to_json() for member in self.members],
            "families": [trial.to_json() for trial in self.trials],
            "work": round(self.work),
        }

    def blocks(self) -> list[Block]:
        """Return the lines that are printed."""
        asked = numbered(self.freedoms, "freedom")
        if self.proof is not None:
            return [f"No member moves with {asked} in all joints: {self.proof}."]
        members, count = self.members, f"though M = {self.mobility} by count"
        head = (
            f"Special geometry of {numbered(len(members), 'kind')} moves with {asked}, {count}."
            if members
            else f"No member found that moves with {asked}, {count}. This proves nothing."
        )
        lines: list[Block] = [head]
        for trial in self.trials:
            lines += [trial.line()] if trial.member is None else trial.member.lines()
        starts = numbered(sum(trial.starts for trial in self.trials), "start")
        lines.append(f"tried: {numbered(len(self.trials), 'family', 'families')}, {starts}, work {self.work:.0f}")
        return lines

    def __repr__(self) -> str:
        return f"<SpecialSearch: {numbered(len(self.members), 'member')} of {self.graph!r}>"
