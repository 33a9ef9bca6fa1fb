"""The verdict on a mechanism: by its branches, by one motion, by rank or by count, with its supporting results.

Theory: docs/theory/verdict.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, Literal, NamedTuple

import networkx as nx
import numpy as np

from graphs.answer.mechanisms import mobility as counted, sheet_in_frame
from graphs.answer.report import MobilityAnswer
from graphs.convert.table import Mechanism
from graphs.errors import SynthedraError, UnsolvableError
from graphs.files.accepted import MechanismLike, mechanism_for
from graphs.mechanism.precision import BY_DIGITS, ESTIMATED
from graphs.mechanism.sheet import Sheet
from graphs.printing import Block
from graphs.tolerances import DOUBLE
from graphs.types import Floats, JointId
from synth.folding.configuration import SheetConfiguration
from synth.motion.branches import Branch, Branches, Certainty, signs_of
from synth.motion.configuration import EXACT, Configuration
from synth.motion.linkage import PosedLinkage
from synth.motion.marked import Marked
from synth.motion.singular.sampling import walked
from synth.motion.walk.events import free_rates
from synth.moving.made import configuration_of, with_precision
from synth.verdict.verdict import (
    AsWritten,
    Basis,
    MotionFindings,
    Verdict,
    Way,
    WithinPrecision,
    clusters_of,
    in_words,
    text_of_motion,
)

__all__ = ["MOST_PANELS", "JudgedMobility", "mobility", "verdict_of_motion"]


def verdict_of_large(configuration: Configuration, generic: int | None = None) -> Verdict:
    """Trace one motion, near the assignment, and return its degrees of freedom at its end.

    The sentence compares with the mobility of the type, `generic`.
    """
    linkage, closure = configuration.linkage, configuration.closure
    joints = list(linkage.graph.joints)
    if not linkage.loops:
        loose = Way("+" * len(joints), len(joints), "proved", (), 0.0, configuration.misfit)
        findings = MotionFindings(configuration, (loose,), None, True, generic, (), loose)
        text = text_of_motion(findings, len(joints), "proved")
        return Verdict(len(joints), "pose", "proved", text, (loose,), True)
    begun = configuration.begun
    rates = begun.rates
    end = linkage.angles if rates is None else walked(linkage.angles, closure, rates)[0]
    far = float(np.abs(end - linkage.angles).max())
    if rates is None or far <= DOUBLE.moved:
        return _unmoved_of_large(configuration, begun.rigid, generic)
    moving = np.flatnonzero((np.abs(rates) > DOUBLE.zero_rate) | (np.abs(end - linkage.angles) > DOUBLE.immobile))
    basis = free_rates(closure, end, moving)
    freedoms = None if basis is None else basis.shape[1]
    turning = set(moving.tolist())
    still = tuple(joint for place, joint in enumerate(joints) if place not in turning)
    from_folded = None if begun.folded is None else (begun.folded.found_at, begun.folded.back_to)
    way = Way(signs_of(rates), freedoms, "numerical", still, far, configuration.misfit, from_folded)
    stiff = still if freedoms == 1 and not configuration.flat else ()
    marked = _as_marked(configuration.marks, rates)
    findings = MotionFindings(configuration, (way,), marked, False, generic, stiff, way)
    text = text_of_motion(findings, freedoms, "numerical")
    clusters = clusters_of(linkage.graph, stiff)
    return Verdict(freedoms, "motion", "numerical", text, (way,), False, stiff, clusters)


def _unmoved_of_large(configuration: Configuration, rigid: bool, generic: int | None) -> Verdict:
    """Return the verdict where no motion was seen: rigid, if that is proved and coordinates are exact.

    No mechanism nearby is looked for in so large a sheet, so that one remains possible where the digits alone say
    that the coordinates are exact.
    """
    written = AsWritten(0, "proved") if rigid else None
    settled = rigid and configuration.exact
    freedoms = 0 if settled else None
    by_digits = isinstance(configuration, SheetConfiguration) and configuration.precision.evidence == BY_DIGITS
    certainty: Certainty = ("numerical" if by_digits else "proved") if settled else "not known"
    findings = MotionFindings(configuration, (), None, rigid, generic, (), None, written)
    text = text_of_motion(findings, freedoms, certainty)
    stiff = tuple(configuration.linkage.graph.joints) if settled else ()
    clusters = clusters_of(configuration.linkage.graph, stiff)
    return Verdict(freedoms, "motion", certainty, text, (), settled, stiff, clusters, as_written=written)


def _as_marked(marks: Floats, rates: Floats) -> Marked | None:
    """Tell whether all marked joints turn as they are marked, or all against it; None where nothing is marked."""
    turned = (marks * rates)[marks != 0.0]
    if not len(turned):
        return None
    return "has" if (turned > DOUBLE.zero_rate).all() or (turned < -DOUBLE.zero_rate).all() else "none found"


def verdict_of_motion(configuration: Configuration, generic: int | None = None) -> Verdict:
    """Return the verdict on a mechanism at a configuration.

    Parameters
    ----------
    configuration : Configuration
    generic : int, optional
        The mobility of its type, with which the sentence compares.

    Returns
    -------
    Verdict

    Examples
    --------
    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.folding.configuration import configuration_of_sheet
    >>> corners = ((0, 0), (1, 0), (.5, 1), (-1, 0), (.5, -1))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> print(verdict_of_motion(configuration_of_sheet(Sheet(5, (), "", faces, corners)), 1))
    Rigid-foldable from the flat state: 1 degree of freedom. 2 folding branches.
    """
    if not configuration.joints:
        lacking = "creases between panels" if configuration.limited else "joints"
        return Verdict(0, "motion", "proved", f"Rigid: there are no {lacking}.")
    verdict = _verdict(configuration, generic)
    return replace(verdict, places=configuration.ends_of(verdict.stiff_joints))


def _verdict(configuration: Configuration, generic: int | None) -> Verdict:
    found = configuration.branches
    if found is None or configuration.one_way:
        verdict = verdict_of_large(configuration, generic)
    else:
        verdict = _of_branches(configuration, found, generic)
    known = verdict.as_written or _as_written(configuration)
    written = known or AsWritten(verdict.freedoms, verdict.certainty)
    if not isinstance(configuration, SheetConfiguration):
        return replace(verdict, as_written=written)
    nearest = None if verdict.ways else configuration.nearest
    misfit = configuration.misfit if nearest is None else nearest.moved
    moves = bool(verdict.ways) or nearest is not None
    size = configuration.precision.size
    within = WithinPrecision(verdict.freedoms, verdict.certainty, misfit if moves else None, size)
    return replace(verdict, as_written=written, within_precision=within)


def _as_written(configuration: Configuration) -> AsWritten | None:
    """Return what holds where no vertex is moved; None if the verdict says the same."""
    if not isinstance(configuration, SheetConfiguration):
        return None
    found = configuration.branches
    if configuration.written is None:
        return AsWritten(0, "proved") if found is not None and found.no_motion == "proved" else None
    return _of_written(configuration.written)


def _of_written(written: SheetConfiguration) -> AsWritten:
    """Return what holds at the coordinates of a configuration; if it is large no motion was looked for."""
    found = written.branches
    if found is None:
        return AsWritten(None, "not known")
    way = _stated_way(_ways_of(written, found), written.marked.number)
    if way is None:
        return AsWritten(0, "proved") if found.no_motion == "proved" else AsWritten(None, "not known")
    return AsWritten(way.freedoms, way.certainty)


def _of_branches(configuration: Configuration, found: Branches, generic: int | None) -> Verdict:
    linkage = configuration.linkage
    ways = _ways_of(configuration, found)
    further = None if found.complete else len(found.branches) - len(ways)
    number, marked = _marked(configuration, len(ways))
    ways += tuple(_way_elsewhere(*one) for one in configuration.elsewhere)
    known = found.complete and all(way.freedoms is not None for way in ways)
    still = _common(linkage, ways) if known else ()
    way = _stated_way(ways, number)
    if way is None:
        freedoms, certainty = _unmoved(configuration, found)
    else:
        freedoms, certainty = way.freedoms, way.certainty
    if not ways and freedoms is None:
        still = ()
    written = _as_written(configuration)
    findings = MotionFindings(configuration, ways, marked, found.complete, generic, still, way, written)
    basis: Basis = "pose" if found.regular and certainty == "proved" else "motion"
    text = text_of_motion(findings, freedoms, certainty)
    clusters = clusters_of(linkage.graph, still)
    exhaustive = found.exhaustive and not configuration.unsettled
    return Verdict(freedoms, basis, certainty, text, ways, exhaustive, still, clusters, further=further)


def _unmoved(configuration: Configuration, found: Branches) -> tuple[int | None, Certainty]:
    """Return the freedoms where nothing moves, with the evidence: proved if nothing nearly moves either.

    Where the digits alone give the precision, coordinates may have larger errors that nothing shows: a mechanism
    nearby may then be the intended one.
    """
    if not found.exhaustive or configuration.unsettled:
        return None, "not known"
    precision = configuration.precision
    nearby = isinstance(configuration, SheetConfiguration) and configuration.nearest is not None
    doubtful = precision.source == ESTIMATED or (precision.evidence == BY_DIGITS and nearby)
    return 0, "numerical" if configuration.nearly or doubtful else "proved"


def _marked(configuration: Configuration, ways: int) -> tuple[int | None, Marked | None]:
    """Return the number of the branch that the assignment chooses, of all mechanisms, and whether one has it."""
    chosen = configuration.marked
    if chosen.marked not in (None, "has"):
        for place, (other, number) in enumerate(configuration.elsewhere):
            if other.marked.number == number:
                return ways + place, "has"
    return chosen.number, chosen.marked


def _ways_of(configuration: Configuration, found: Branches) -> tuple[Way, ...]:
    """Return the branches that were followed, which come first; of a longer search all."""
    return tuple(_way(configuration, branch) for branch in found.branches if branch.begun or configuration.more)


def _way_elsewhere(other: Configuration, number: int) -> Way:
    branch = other.branch(number)
    assert branch is not None
    return _way(other, branch)


def _way(configuration: Configuration, branch: Branch) -> Way:
    linkage = configuration.linkage
    joints = list(linkage.graph.joints)
    apart = np.abs(branch.sample - linkage.angles) > DOUBLE.immobile
    still = [joint for place, joint in enumerate(joints) if place in branch.still and not apart[place]]
    freedoms, certainty, misfit = branch.freedoms, branch.certainty, configuration.misfit
    return Way(branch.signs, freedoms, certainty, tuple(still), branch.followed, misfit)


def _stated_way(ways: Sequence[Way], chosen: int | None) -> Way | None:
    """Return the branch whose freedoms are stated: the assigned one, or the freest; None if there is none."""
    if chosen is not None and chosen < len(ways):
        return ways[chosen]
    return max(ways, key=lambda way: (way.certainty != "not known", way.freedoms or 0), default=None)


def _common(linkage: PosedLinkage, ways: Sequence[Way]) -> tuple[JointId, ...]:
    """Return the joints that are immobile on every branch."""
    if not ways:
        return tuple(linkage.graph.joints)
    still = set(ways[0].stiff_joints).intersection(*(way.stiff_joints for way in ways))
    return tuple(joint for joint in linkage.graph.joints if joint in still)


def verdict_of_type(answer: MobilityAnswer, left_out: str = "") -> Verdict:
    """Return the verdict that counts and ranks allow, with the reason why motion was not looked for.

    A configuration at which all closure equations are independent is regular: its rates are motions. Where the
    exact rank of a type is as large as its number of equations it is proved, since no realisation has more.
    """
    pose, exact = answer.pose, answer.exact
    if pose is not None and pose.dof is not None and pose.self_stresses == 0:
        text = f"Mobile from this configuration: {in_words(pose.dof)}." if pose.dof else "Rigid."
        return Verdict(pose.dof, "pose", "proved", text)
    special = pose is not None and pose.self_stresses != 0  # what holds in general says nothing of this one
    end = f"; {left_out}" if left_out else ""
    if exact is not None:
        certainty: Certainty = "proved" if exact.mobility == answer.mobility else "numerical"
        how = "exact rank" if certainty == "proved" else "exact rank of random realisations, modulo two primes"
        freedoms = None if special else exact.mobility
        return Verdict(freedoms, "generic", certainty, _generic(exact.mobility, how, end))
    if (member := answer.counts.get("general_member")) is not None:  # of joints of all kinds
        return Verdict(member, "generic", "numerical", _generic(member, "rank of a random realisation", end))
    if answer.mobility is None:
        return Verdict(None, "count", "not known", f"Mobility unknown{end}.")
    freedoms = None if special else max(answer.mobility, 0)
    return Verdict(freedoms, "count", "not known", _generic(answer.mobility, "by count", end))


def _generic(freedoms: int, how: str, end: str) -> str:
    if freedoms <= 0:
        count = f", M = {freedoms}" if freedoms < 0 else ""
        return f"A generic realisation is rigid ({how}{count}){end}."
    return f"A generic realisation has {in_words(freedoms)} ({how}){end}."


MOST_PANELS = 1200
"""The motion of larger sheets is looked for on request only."""


@dataclass(frozen=True, slots=True, repr=False)
class JudgedMobility(MobilityAnswer):
    """The mobility of one mechanism, its verdict first.

    Attributes
    ----------
    verdict : Verdict
    configuration : Configuration or None
        Where it moves from; None for a type, and where its motion was not looked for.

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
        at, mended = self.configuration, {"mended": list(self.mended)}
        first = {
            "verdict": None if self.verdict is None else self.verdict.to_json(),
            "configuration": None if at is None else at.to_json(at.branch(at.chosen)),
            "assignment": None if at is None else at.nearest_to_json(),
        }
        return {**first, **super(JudgedMobility, self).to_json(), **mended}

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
        """The repairs of rounded coordinates before the motion was computed."""
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
    mechanism: Configuration | MechanismLike | nx.Graph,
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
        Look for the motion of a crease pattern from its configuration; by default unless it is too large.
    precision : float, optional
        The error that a coordinate may have, in their unit; by default as they are written, or as the geometry
        shows. A Configuration has its own.
    more : bool, optional
        Look for motion branches with a hundred times the usual allowance, and list all that are found.

    Returns
    -------
    JudgedMobility

    Raises
    ------
    UnsolvableError, FileError, InvariantError
        As in counting; and if a motion is demanded of a mechanism without coordinates.

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
    mechanism = mechanism_for("mobility", mechanism, Configuration | Mechanism | nx.Graph)
    if precision is not None and isinstance(mechanism, Mechanism):
        mechanism = with_precision(mechanism, precision)
    counted_from = mechanism.given if isinstance(mechanism, Configuration) else mechanism
    if counted_from is None:
        raise UnsolvableError(f"mobility requires a mechanism to count, and {mechanism!r} has only axes")
    question = _MotionQuestion(mechanism, pose, hinge_flat, demanded=bool(motion))
    at, reason = None, "its motion was not analysed" if motion is False else ""
    looked_for = pose is not False and motion is not False
    if looked_for and isinstance(counted_from, Sheet):
        at, reason = question.of_sheet(sheet_in_frame(counted_from, pose))
    dual = at.dual if isinstance(at, SheetConfiguration) and geometry else None
    answer = counted(counted_from, exact=exact, hinge_flat=hinge_flat, pose=pose, geometry=geometry, dual=dual)
    if looked_for and not isinstance(counted_from, Sheet) and (answer.pose is not None or motion):
        at, reason = question.made()
    if at is None:
        return JudgedMobility.judged(answer, verdict_of_type(answer, reason if answer.pose is not None else ""))
    at = replace(at, more=True) if more else at
    return JudgedMobility.judged(answer, verdict_of_motion(at, answer.mobility), at)


class _MotionQuestion(NamedTuple):
    """A mechanism whose motion is to be judged; `demanded` raises an error where that is not possible."""

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
