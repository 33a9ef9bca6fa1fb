"""The answer to "how does it move?": counts, exact rank, freedoms at the pose, and what was noticed."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

from graphs.count.equations import overconstraint
from graphs.count.report import MobilityReport
from graphs.printing import Block, Printed, TableBlock, plain
from graphs.rank.generic import ExactMobility
from graphs.rank.pose import PoseMobility

__all__ = ["MobilityAnswer"]

_TITLES = {
    "traditional_cgk": "C-G-K (Wiener Eq. 1)",
    "modified_cgk": "modified C-G-K (Wiener Eq. 2)",
    "spherical_system": "spherical system (Wiener Eq. 3)",
    "polyhedron": "polyhedron (Wiener Eq. 4)",
    "loop_form": "loop form",
    "closed_surface": "closed surface",
    "wampler_eq5": "Wampler Eq. 5, rods",
    "wampler_eq6": "Wampler Eq. 6, points",
    "wampler_eq7": "Wampler Eq. 7, S+3",
    "wampler_eq8": "Wampler Eq. 8, S+k",
    "wampler_eq9": "Wampler Eq. 9, scissors",
    "wampler_eq10": "Wampler Eq. 10, no ground",
}

_COUNTS = {
    "vertices": "vertices V",
    "implicit_centres": "implicit centres C",
    "edges": "rods E",
    "external_edges": "external edges",
    "internal_edges": "internal edges",
    "spatial_loops": "spatial loops",
    "flaps": "flaps",
    "interior_vertices": "interior vertices",
    "parts": "parts",
    "passive": "passive freedoms",
    "remote": "sum of k over remote centres",
    "on_plane": "points on planes P",
    "on_line": "points on lines L",
    "scissors": "scissors X",
}


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
        blocks: list[Block] = [f"mobility M = {plain(self.mobility)}   ({self.mechanism_class})"]
        if self.exact is not None:
            exact = self.exact
            blocks.append(f"exact generic mobility {exact.mobility}   (rank {exact.rank} modulo two primes)")
        if self.pose is not None:
            blocks.append(_pose_line(self))
        known = [
            ("links N", self.links),
            ("joints J", self.joints),
            ("loops L", self.loops),
            ("centres", self.centres),
            *((title, self.counts.get(key)) for key, title in _COUNTS.items()),
        ]
        blocks.append(", ".join(f"{title} {value}" for title, value in known if value is not None))
        rows = [
            (_TITLES[name], plain(result.value), "yes" if result.applies else "no", result.why)
            for name, result in self.equations.items()
        ]
        blocks.append(TableBlock(("equation", "M", "applies", "why"), rows, ["M"]))
        blocks += [f"repaired: {note}" for note in self.repairs]
        blocks += [f"note: {note}" for note in self.warnings]
        return blocks

    def __repr__(self) -> str:
        return f"<MobilityAnswer: M = {self.mobility}, {self.mechanism_class}>"


def _pose_line(answer: MobilityAnswer) -> str:
    """Say in a line how a mechanism can move as it lies."""
    pose = answer.pose
    assert pose is not None
    if pose.dof is None:
        return "as it lies: indeterminate"
    gap = pose.to_json()["gap"]
    evidence = "no zero singular value" if gap is None else f"gap {gap:.0e}"
    state = "flat state: more infinitesimal freedoms than when folded; " if _is_only_flat(answer) else ""
    over = "" if answer.overconstraint is None else f"h = {answer.overconstraint}, "
    return f"as it lies: {pose.dof} infinitesimal freedom(s)   ({state}{over}{evidence})"


def _is_only_flat(answer: MobilityAnswer) -> bool:
    """Tell whether a sheet owes freedoms to lying flat."""
    pose, over = answer.pose, answer.overconstraint
    return pose is not None and pose.flat and bool(pose.flat_loops) and (over is None or over > 0)
