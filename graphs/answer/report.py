"""The answer to "how does it move?": counts, exact rank, freedoms at the pose, and what was noticed."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

from graphs.answer.printed import blocks_of
from graphs.count.equations import overconstraint
from graphs.count.report import MobilityReport
from graphs.printing import Block, Printed
from graphs.rank.generic import ExactMobility
from graphs.rank.pose import PoseMobility

__all__ = ["MobilityAnswer"]


@dataclass(frozen=True, slots=True, repr=False)
class MobilityAnswer(MobilityReport, Printed):
    """The mobility of one mechanism, with its evidence.

    It prints as ``synth mobility`` does, and shows itself as a table in a notebook.

    Attributes
    ----------
    exact : ExactMobility or None
        The generic mobility by rank, with its primes; None where it was not asked for or could not be found (a
        warning says why).
    pose : PoseMobility or None
        The first-order freedoms where the coordinates are, with the gap of the singular values; None without
        coordinates.
    overconstraint : int or None
        h = freedoms at the pose - M (Wiener 2016, Eq. 8).

    Notes
    -----
    The other attributes are those of :class:`graphs.count.report.MobilityReport`, the answer by count.

    Examples
    --------
    >>> from graphs.answer.mechanisms import mobility
    >>> from graphs.mechanism.sheet import Sheet
    >>> answer = mobility(Sheet(5, (), "", ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))))
    >>> answer.mobility, answer.exact.mobility, answer.pose
    (1, 1, None)
    """

    exact: ExactMobility | None = None
    pose: PoseMobility | None = None

    @classmethod
    def of(cls, report: MobilityReport) -> MobilityAnswer:
        """Return the answer that a report by count begins."""
        return cls(**{part.name: getattr(report, part.name) for part in fields(MobilityReport)})

    @property
    def overconstraint(self) -> int | None:
        """H = freedoms at the pose - M, where both are known."""
        if self.pose is None or self.pose.dof is None or self.mobility is None:
            return None
        return overconstraint(self.pose.dof, self.mobility)

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        counted = super(MobilityAnswer, self).to_json()
        notes = {key: counted.pop(key) for key in ("repairs", "warnings")}
        pose = None
        if self.pose is not None:
            told = self.pose.to_json()
            pose = {"dof": told.pop("dof"), "gap": told.pop("gap"), "h": self.overconstraint, **told}
        return {**counted, "exact": None if self.exact is None else self.exact.to_json(), "pose": pose, **notes}

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        return blocks_of(self)

    def __repr__(self) -> str:
        return f"<MobilityAnswer: M = {self.mobility}, {self.mechanism_class}>"
