"""How does it move: the verdict, and what supports it.

Theory: docs/theory/verdict.md.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any, Literal

import networkx as nx

from graphs.answer.mechanisms import lying
from graphs.answer.mechanisms import mobility as counted
from graphs.answer.report import MobilityAnswer
from graphs.convert.table import Mechanism
from graphs.errors import SynthedraError
from graphs.given import check_given
from graphs.mechanism.precision import Precision
from graphs.mechanism.sheet import Sheet
from graphs.printing import Block
from synth.folding.prepared import Prepared, prepared
from synth.moving.linkages import linkage_of
from synth.verdict.of_motion import verdict_of_linkage, verdict_of_motion
from synth.verdict.of_type import verdict_of_type
from synth.verdict.verdict import Verdict

__all__ = ["MOST_PANELS", "JudgedMobility", "mobility"]

_EXACTLY = Precision(0.0, "exact")

MOST_PANELS = 1200
"""The motion of larger sheets is looked for on request only."""


@dataclass(frozen=True, slots=True, repr=False)
class JudgedMobility(MobilityAnswer):
    """The mobility of one mechanism, its verdict first.

    Attributes
    ----------
    verdict : Verdict
    mended : tuple of str
        What was done to rounded coordinates before anything was moved.

    Notes
    -----
    The other attributes are those of :class:`graphs.answer.report.MobilityAnswer`.
    """

    verdict: Verdict | None = None
    mended: tuple[str, ...] = ()

    @classmethod
    def judged(cls, answer: MobilityAnswer, verdict: Verdict, mended: tuple[str, ...] = ()) -> JudgedMobility:
        """Return an answer with its verdict."""
        parts = {part.name: getattr(answer, part.name) for part in fields(MobilityAnswer)}
        return cls(**parts, verdict=verdict, mended=mended)

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        told = super(JudgedMobility, self).to_json()
        verdict = None if self.verdict is None else self.verdict.to_json()
        return {"verdict": verdict, **told, "mended": list(self.mended)}

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        lines: list[Block] = [] if self.verdict is None else [self.verdict.text]
        mended: list[Block] = [f"mended: {note}" for note in self.mended]
        return [*lines, *mended, *super(JudgedMobility, self).blocks()]

    def __repr__(self) -> str:
        text = "" if self.verdict is None else f": {self.verdict.text}"
        return f"<JudgedMobility{text}>"


def mobility(
    mechanism: Mechanism | nx.Graph,
    *,
    exact: bool | None = None,
    hinge_flat: bool = False,
    pose: int | Literal[False] | None = None,
    geometry: bool = True,
    motion: bool | None = None,
    pattern: Prepared | None = None,
) -> JudgedMobility:
    """Say how a mechanism moves, with how many freedoms, and how that is known.

    Parameters
    ----------
    mechanism, exact, hinge_flat, pose, geometry
        As in :func:`graphs.answer.mechanisms.mobility`, which counts.
    motion : bool, optional
        Look for the motion of a crease pattern from its pose; by default of what is not too large.
    pattern : Prepared, optional
        The crease pattern made ready to move, where it is at hand.

    Returns
    -------
    JudgedMobility

    Raises
    ------
    UnsolvableError, FileError, InvariantError
        As in counting; and if a motion is demanded of what has no coordinates.

    Examples
    --------
    >>> sheet = Sheet(5, (), "", ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)),
    ...               ((0, 0), (1, 0), (0, 1), (-1, 0), (0, -1)))
    >>> answer = mobility(sheet)
    >>> print(answer.verdict)
    Folds with 1 freedom from flat, in 2 ways.
    >>> answer.mobility, answer.pose.dof
    (1, 2)
    """
    check_given("mobility", mechanism, Mechanism | nx.Graph)
    answer = counted(mechanism, exact=exact, hinge_flat=hinge_flat, pose=pose, geometry=geometry)
    if pose is False or motion is False:
        left_out = "its motion was left out" if motion is False and answer.pose is not None else ""
        return JudgedMobility.judged(answer, verdict_of_type(answer, left_out))
    if not isinstance(mechanism, Sheet):
        return JudgedMobility.judged(answer, _of_other(mechanism, answer, demanded=bool(motion)))
    drawn = lying(mechanism, pose)
    if drawn.coordinates is None and not motion:
        return JudgedMobility.judged(answer, verdict_of_type(answer))
    if len(drawn.faces) > MOST_PANELS and not motion:
        told = f"the motion of {len(drawn.faces)} panels is looked for on request (--motion)"
        return JudgedMobility.judged(answer, verdict_of_type(answer, told))
    try:
        pattern = pattern or prepared(drawn, hinge_flat=hinge_flat)
    except SynthedraError as error:
        if motion:
            raise
        return JudgedMobility.judged(answer, verdict_of_type(answer, f"its motion was not looked for: {error}"))
    verdict = verdict_of_motion(pattern, answer.mobility)
    return JudgedMobility.judged(answer, verdict, tuple(map(str, pattern.repairs)))


def _of_other(mechanism: Mechanism | nx.Graph, answer: MobilityAnswer, *, demanded: bool) -> Verdict:
    """Return the verdict on what is no crease pattern: solids, rods, a linkage on its cone, or a type."""
    if answer.pose is None and not demanded:
        return verdict_of_type(answer)
    try:
        linkage = linkage_of(mechanism)
        precision = _EXACTLY if answer.pose is None else answer.pose.precision
        return verdict_of_linkage(linkage, precision, answer.mobility)
    except SynthedraError as error:
        if demanded:
            raise
        return verdict_of_type(answer, f"its motion was not looked for: {error}")
