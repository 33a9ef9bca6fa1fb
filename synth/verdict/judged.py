"""How does it move: the verdict, and what supports it.

Theory: docs/theory/verdict.md.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Any, Literal, NamedTuple

import networkx as nx

from graphs.answer.mechanisms import mobility as counted, sheet_in_frame
from graphs.answer.report import MobilityAnswer
from graphs.convert.table import Mechanism
from graphs.errors import SynthedraError, UnsolvableError, check_argument
from graphs.mechanism.precision import BY_DIGITS
from graphs.mechanism.sheet import Sheet
from graphs.printing import Block
from synth.folding.configuration import SheetConfiguration
from synth.motion.configuration import Configuration
from synth.motion.misfit import EXACT
from synth.moving.made import configuration_of, with_precision
from synth.verdict.of_motion import verdict_of_motion
from synth.verdict.of_type import verdict_of_type
from synth.verdict.verdict import Verdict

__all__ = ["MOST_PANELS", "JudgedMobility", "mobility"]

MOST_PANELS = 1200
"""The motion of larger sheets is looked for on request only."""


@dataclass(frozen=True, slots=True, repr=False)
class JudgedMobility(MobilityAnswer):
    """The mobility of one mechanism, its verdict first.

    Attributes
    ----------
    verdict : Verdict
    configuration : Configuration or None
        Where it moves from; None of a type, and where its motion was not looked for.

    Notes
    -----
    The other attributes are those of :class:`graphs.answer.report.MobilityAnswer`.
    """

    verdict: Verdict | None = None
    configuration: Configuration | None = None

    @classmethod
    def judged(
        cls, answer: MobilityAnswer, verdict: Verdict, configuration: Configuration | None = None
    ) -> JudgedMobility:
        """Return an answer with its verdict."""
        parts = {part.name: getattr(answer, part.name) for part in fields(MobilityAnswer)}
        return cls(**parts, verdict=verdict, configuration=configuration)

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        counted = super(JudgedMobility, self).to_json()
        verdict = None if self.verdict is None else self.verdict.to_json()
        at = self.configuration
        here = None if at is None else at.to_json(at.branch(at.chosen))
        marks = None if at is None else at.nearest_to_json()
        return {
            "verdict": verdict,
            "configuration": here,
            "assignment": marks,
            **counted,
            "mended": list(self.mended),
        }

    def _precision(self) -> list[Block]:
        """Return the line on the precision of coordinates that are not exact, or are so by their digits alone."""
        if self.configuration is None or not self.configuration.precision.size:
            return []
        precision = self.configuration.precision
        if precision.evidence == BY_DIGITS:
            return [f"coordinates precise to {precision}, by {precision.evidence}"]
        return [f"coordinates precise to {precision}"] if precision.size > EXACT else []

    @property
    def mended(self) -> tuple[str, ...]:
        """What was done to rounded coordinates before anything was moved."""
        return () if self.configuration is None else self.configuration.mended

    def blocks(self, *, verbose: bool = False) -> list[Block]:
        """Return the lines that are printed, the verdict first; verbose adds the table of all equations."""
        lines: list[Block] = [] if self.verdict is None else [self.verdict.text]
        if self.configuration is not None and self.configuration.disagreeing:
            lines.append(self.configuration.disagreeing)
        repaired: list[Block] = [f"repaired: {note}" for note in self.mended]
        return [*self.unread(), *lines, *self.evidence(verbose=verbose), *self._precision(), *repaired]

    def __repr__(self) -> str:
        text = "" if self.verdict is None else f": {self.verdict.text}"
        return f"<JudgedMobility{text}>"


def mobility(
    mechanism: Configuration | Mechanism | nx.Graph,
    *,
    exact: bool | None = None,
    hinge_flat: bool = False,
    pose: int | Literal[False] | None = None,
    geometry: bool = True,
    motion: bool | None = None,
    precision: float | None = None,
    more: bool = False,
) -> JudgedMobility:
    """Report whether a mechanism moves, its degrees of freedom, its motion branches, and the evidence.

    Parameters
    ----------
    mechanism, exact, hinge_flat, pose, geometry
        As in :func:`graphs.answer.mechanisms.mobility`, which counts. A Configuration is judged where it is.
    motion : bool, optional
        Look for the motion of a crease pattern from its pose; by default of what is not too large.
    precision : float, optional
        The error that a coordinate may have, in their unit; by default as they are written, or as the geometry
        shows. A Configuration has its own.
    more : bool, optional
        Look for ways to move with a hundred times the usual allowance, and list all that are found.

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
    Rigid-foldable from the flat state: 1 degree of freedom. 2 folding branches.
    >>> answer.mobility, answer.pose.dof
    (1, 2)
    """
    check_argument("mobility", mechanism, Configuration | Mechanism | nx.Graph)
    if precision is not None and isinstance(mechanism, Mechanism):
        mechanism = with_precision(mechanism, precision)
    given = mechanism.given if isinstance(mechanism, Configuration) else mechanism
    if given is None:
        raise UnsolvableError(f"mobility counts what a mechanism is made of, which {mechanism!r} does not say")
    asked = _Asked(mechanism, pose, hinge_flat, demanded=bool(motion))
    at, reason = None, "its motion was not analysed" if motion is False else ""
    looked_for = pose is not False and motion is not False
    if looked_for and isinstance(given, Sheet):
        at, reason = asked.of_sheet(sheet_in_frame(given, pose))
    dual = at.dual if isinstance(at, SheetConfiguration) and geometry else None
    answer = counted(given, exact=exact, hinge_flat=hinge_flat, pose=pose, geometry=geometry, dual=dual)
    if looked_for and not isinstance(given, Sheet) and (answer.pose is not None or motion):
        at, reason = asked.made()
    if at is None:
        return JudgedMobility.judged(answer, verdict_of_type(answer, reason if answer.pose is not None else ""))
    at = replace(at, more=True) if more else at
    return JudgedMobility.judged(answer, verdict_of_motion(at, answer.mobility), at)


class _Asked(NamedTuple):
    """A mechanism whose motion is to be judged.

    Attributes
    ----------
    mechanism : Configuration, or what one is made of
    frame : int or None
    hinge_flat : bool
    demanded : bool
        Whether to raise an error where its motion cannot be looked for; else the reason is given.
    """

    mechanism: Configuration | Mechanism | nx.Graph
    frame: int | None
    hinge_flat: bool
    demanded: bool

    def of_sheet(self, placed: Sheet) -> tuple[Configuration | None, str]:
        """Return the configuration of a sheet, or why there is none."""
        if isinstance(self.mechanism, Configuration):
            return self.mechanism, ""
        if placed.coordinates is None and not self.demanded:
            return None, ""
        if len(placed.faces) > MOST_PANELS and not self.demanded:
            return None, f"the motion of {len(placed.faces)} panels is analysed on request (--motion)"
        return self.made()

    def made(self) -> tuple[Configuration | None, str]:
        """Return the configuration, or why there is none."""
        try:
            return configuration_of(self.mechanism, frame=self.frame, hinge_flat=self.hinge_flat), ""
        except SynthedraError as error:
            if self.demanded:
                raise
            return None, f"its motion was not analysed: {error}"
