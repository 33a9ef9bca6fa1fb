"""The verdict on a mechanism: by its branches, by one motion, by rank or by count, with its supporting results.

Theory: docs/theory/verdict.md.
"""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import networkx as nx
import numpy as np

from graphs.answer.mobility import counts_and_ranks, sheet_in_frame
from graphs.answer.report import RODS_ALONE, MobilityAnswer
from graphs.convert.conversions import Mechanism
from graphs.count.applicability import EquationResult
from graphs.errors import SynthedraError, UnsolvableError
from graphs.files.mechanism_like import MechanismLike, mechanism_for
from graphs.mechanism.precision import BY_DIGITS, ESTIMATED
from graphs.mechanism.sc import Arrangement
from graphs.mechanism.sheet import Reading, Sheet
from graphs.printing import Block, Printed, html_of
from graphs.rank.dissection import number_below
from graphs.rank.exact import ExactMobility
from graphs.rank.infinitesimal import InfinitesimalMobility
from graphs.tolerances import DOUBLE
from graphs.types import Floats, Ints, JointId
from synth.analysis.folding.configuration import SheetConfiguration
from synth.analysis.layering.summary import FlatFoldability, flat_foldability
from synth.analysis.motion.assigned_branch import Marked
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.configuration import EXACT, Configuration
from synth.analysis.motion.flat_vertices import FlatVertices, straight_folds
from synth.analysis.motion.germ import Branch, Branches, Certainty, signs_of
from synth.analysis.motion.singular.mode_count import count_of_modes
from synth.analysis.motion.singular.sampling import closes_along_general_rates, walked
from synth.analysis.motion.walk.events import number_of_free_rates
from synth.analysis.moving._configuration_of import configuration_of, with_precision
from synth.analysis.overconstraint.herve import HerveClass, herve_class
from synth.analysis.verdict.verdict import (
    AsWritten,
    Basis,
    BranchCount,
    FreedomBounds,
    MotionBranch,
    MotionFindings,
    Verdict,
    WithinPrecision,
    clusters_of,
    in_words,
    text_of_motion,
)


def verdict_of_motion(configuration: Configuration, generic: int | None = None) -> Verdict:
    """Return the verdict on a mechanism at a configuration.

    Parameters
    ----------
    configuration : Configuration
    generic : int, optional
        The mobility of its type, with which the sentence compares.

    Examples
    --------
    >>> from synth.analysis.folding.configuration import configuration_of_sheet
    >>> corners = ((0, 0), (1, 0), (.5, 1), (-1, 0), (.5, -1))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> print(verdict_of_motion(configuration_of_sheet(Sheet(5, (), "", faces, corners)), 1))
    Rigid-foldable from the flat state: 1 degree of freedom. 2 folding branches.
    """
    if not configuration.joints:
        lacking = "creases between panels" if configuration.has_panels else "joints"
        return Verdict(0, "motion", "proved", f"Rigid: there are no {lacking}.")
    branches = configuration.branches
    if branches is None or configuration.one_way:
        verdict = _of_one_motion(configuration, generic)
    else:
        verdict = _of_branches(configuration, branches, generic)
    written = verdict.as_written or _as_written(configuration) or AsWritten(verdict.freedoms, verdict.certainty)
    verdict = replace(verdict, as_written=written)
    if not isinstance(configuration, SheetConfiguration):
        return verdict
    nearest = None if verdict.branches else configuration.nearest
    misfit = configuration.misfit if nearest is None else nearest.moved
    moves = bool(verdict.branches) or nearest is not None
    size = configuration.precision.size
    searched = None if moves else configuration.searched
    within = WithinPrecision(verdict.freedoms, verdict.certainty, misfit if moves else None, size, searched)
    return replace(verdict, within_precision=within, places=configuration.ends_of(verdict.immobile_joints))


def _worded(findings: MotionFindings, basis: Basis, *, exhaustive: bool = False, further: int | None = None) -> Verdict:
    """Return a verdict with its sentences, and with the links that move as one."""
    clusters = clusters_of(findings.at.linkage.graph, findings.immobile)
    return Verdict(
        findings.freedoms,
        basis,
        findings.certainty,
        text_of_motion(findings),
        findings.branches,
        exhaustive,
        findings.immobile,
        clusters,
        as_written=findings.written,
        further=further,
        bounds=findings.bounds,
        count=findings.count,
    )


def _of_one_motion(configuration: Configuration, generic: int | None) -> Verdict:
    """Trace one motion, near the assignment, and return its degrees of freedom at its end."""
    linkage, closure = configuration.linkage, configuration.closure
    joints, misfit = configuration.joints, configuration.misfit
    if not linkage.loops:  # no equation binds the joints, so all rates together are the one branch there is
        loose = MotionBranch("+" * len(joints), len(joints), "proved", (), 0.0, misfit)
        findings = MotionFindings(configuration, (loose,), loose, len(joints), "proved", True, generic)
        return _worded(findings, "pose", exhaustive=True)
    begun = configuration.begun
    rates = begun.rates
    end = linkage.angles if rates is None else walked(linkage.angles, closure, rates)[0]
    far = float(np.abs(end - linkage.angles).max())
    if rates is None or far <= DOUBLE.moved:
        return _of_no_motion(configuration, generic, rigid=begun.rigid)
    moving = np.flatnonzero((np.abs(rates) > DOUBLE.zero_rate) | (np.abs(end - linkage.angles) > DOUBLE.immobile))
    # near the flat state singular values fall with the fold angle: freedoms are read where the motion is folded most
    folded = begun.folded
    place = folded.folded if folded is not None and folded.found_at > far else end
    bounds = _bounds_of_one(configuration, place, moving)
    least, most = bounds.stated
    freedoms = most if least == most else None
    turning = set(moving.tolist())
    unmoved = tuple(joint for place, joint in enumerate(joints) if place not in turning)
    from_folded = None if begun.folded is None else (begun.folded.found_at, begun.folded.back_to)
    branch = MotionBranch(signs_of(rates), freedoms, "numerical", unmoved, far, misfit, from_folded)
    immobile = unmoved if freedoms == 1 and not configuration.flat else ()
    marked = _as_marked(configuration.marks, rates)
    count = _counted_by_modes(configuration, bounds)
    known = count is not None and not count.at_least
    if count is not None and marked != "has":
        freedoms = max(freedoms or 0, *(more or 0 for more in count.kinds))
    evidence = (known, generic, immobile, marked, None, bounds, count)
    findings = MotionFindings(configuration, (branch,), branch, freedoms, "numerical", *evidence)
    return _worded(findings, "motion")


_MOST_COUNTED = 2500
"""Modes of so many vertices are counted: a sheet of 50 x 50 panels takes two seconds."""


def _counted_by_modes(configuration: Configuration, bounds: FreedomBounds) -> BranchCount | None:
    """Return how many branches a large flat sheet of degree-4 vertices has; None for others."""
    linkage = configuration.linkage
    if not configuration.flat or len(linkage.loops) > _MOST_COUNTED or not FlatVertices(linkage).linear:
        return None
    modes = count_of_modes(linkage)
    if modes is None or modes.kinds.total() < bounds.branches:
        return None
    return BranchCount(modes.kinds, not modes.all, False)


def _bounds_of_one(configuration: Configuration, end: Floats, moving: Ints) -> FreedomBounds:
    """Return bounds of freedoms and of the number of branches, by one that leads to a folded state, float[J].

    There, the freedoms of joints that move, int[n], are at most their infinitesimal ones. They are as many if
    general rates close; otherwise at least as many as there are more joints than equations, and one. Straight folds
    are other branches if nothing else begins where they are folded, or one of them has more freedoms than there are
    rates at the end.
    """
    closure, start = configuration.closure, configuration.linkage.angles
    matrix = closure.at(end)[1]
    own = matrix[:, moving]
    most = number_of_free_rates(closure, end, moving)
    most = number_below(own, DOUBLE.singular) if most is None else most
    counted = len(moving) - int((np.diff(own.indptr) > 0).sum())
    least = most if closes_along_general_rates(closure, end, moving) else min(most, max(counted, 1))
    here = number_below(closure.at(start)[1], DOUBLE.singular)
    there = most if len(moving) == len(end) else number_below(matrix, DOUBLE.singular)
    families = straight_folds(configuration.linkage) if configuration.flat else ()
    folds = [_StraightFold(closure, lines) for lines in sorted(families, key=lambda one: -one.max())[:_FAMILIES]]
    folds = [fold for fold in folds if fold.closes]
    lines = max((fold.lines for fold in folds), default=0)
    others = sum(fold.is_branch for fold in folds if not fold.has(moving))
    freest = max(least, lines)
    return FreedomBounds(1 + max(others, int(lines > there)), (least, most), (freest, max(here, freest)))


_FOLDED = (0.3, 1.0)
"""Radians between which random fold angles of lines show whether loops close at any."""
_FAMILIES = 8
"""Of so many families of parallel lines bounds are made, those of most lines first."""


class _StraightFold:
    """A flat sheet folded along parallel lines only, at angles in general position; the line of each joint, or -1."""

    def __init__(self, closure: ClosureEquations, lines: Ints) -> None:
        self.lines = int(lines.max()) + 1
        folds = np.random.default_rng(self.lines).uniform(*_FOLDED, self.lines)
        self._closure, self._on_line, self._angles = closure, lines >= 0, np.where(lines < 0, 0.0, folds[lines])
        self.closes = closure.error(self._angles) <= DOUBLE.closed

    def has(self, moving: Ints) -> bool:
        """Tell whether joints that move are on lines only."""
        return bool(self._on_line[moving].all())

    @property
    def is_branch(self) -> bool:
        """Whether nothing else begins where it is folded: there are no more rates than lines."""
        return number_below(self._closure.at(self._angles)[1], DOUBLE.singular) == self.lines


def _of_no_motion(configuration: Configuration, generic: int | None, *, rigid: bool) -> Verdict:
    """Return the verdict where no motion was seen: rigid, if that is proved and coordinates are exact.

    No mechanism nearby is looked for in so large a sheet, so that one remains possible where the digits alone say
    that the coordinates are exact.
    """
    settled = rigid and configuration.exact
    by_digits = isinstance(configuration, SheetConfiguration) and configuration.precision.evidence == BY_DIGITS
    certainty: Certainty = ("numerical" if by_digits else "proved") if settled else "not known"
    freedoms, immobile = (0, configuration.joints) if settled else (None, ())
    written = AsWritten(0, "proved") if rigid else None
    findings = MotionFindings(configuration, (), None, freedoms, certainty, rigid, generic, immobile, written=written)
    return _worded(findings, "motion", exhaustive=settled)


def _as_marked(marks: Floats, rates: Floats) -> Marked | None:
    """Tell whether all marked joints turn as they are marked, or all against it; None where nothing is marked."""
    turned = (marks * rates)[marks != 0.0]
    if not len(turned):
        return None
    return "has" if (turned > DOUBLE.zero_rate).all() or (turned < -DOUBLE.zero_rate).all() else "none found"


def _as_written(configuration: Configuration) -> AsWritten | None:
    """Return what holds where no vertex is moved; None if the verdict says the same."""
    if not isinstance(configuration, SheetConfiguration):
        return None
    written = configuration.written
    branches = configuration.branches if written is None else written.branches
    if written is not None and branches is not None:
        branch = _stated(written, _branches_of(written, branches), written.marked.number)
        if branch is not None:
            return AsWritten(branch.freedoms, branch.certainty)
    if branches is not None and branches.no_motion == "proved":
        return AsWritten(0, "proved")
    return None if written is None else AsWritten(None, "not known")  # if it is large no motion was looked for


def _of_branches(configuration: Configuration, search: Branches, generic: int | None) -> Verdict:
    own = _branches_of(configuration, search)
    further = None if search.complete else search.numbered - len(own)
    number, marked = _marked(configuration)
    elsewhere = tuple(_branch(other, branch) for other, branch in _branches_elsewhere(configuration))
    branches, kinds = own + elsewhere, search.kinds + Counter(branch.freedoms for branch in elsewhere)
    known = search.complete and all(branch.freedoms is not None for branch in branches) and None not in kinds
    stated = _stated(configuration, branches, number)
    freedoms, certainty = _unmoved(configuration, search) if stated is None else (stated.freedoms, stated.certainty)
    immobile: tuple[JointId, ...] = ()
    if known and (branches or freedoms is not None):
        on_all = _immobile_on_all(configuration, search) if own else set(configuration.joints)
        on_all = on_all.intersection(*(branch.immobile_joints for branch in elsewhere))
        immobile = tuple(joint for joint in configuration.joints if joint in on_all)
    written = _as_written(configuration)
    counted = search.complete or not search.at_least
    bounds = None if counted or stated is None else _bounds_of_search(configuration, kinds, stated)
    proved = search.proved and not elsewhere and not configuration.unsettled
    count = BranchCount(kinds, search.at_least and bool(branches), proved)
    evidence = (certainty, counted, generic, immobile, marked, written, bounds, count)
    findings = MotionFindings(configuration, branches, stated, freedoms, *evidence)
    exhaustive = search.exhaustive and not configuration.unsettled
    basis: Basis = "pose" if search.regular and certainty == "proved" else "motion"
    return _worded(findings, basis, exhaustive=exhaustive, further=further)


def _branches_elsewhere(configuration: Configuration) -> Iterator[tuple[Configuration, Branch]]:
    """Yield the branches of other mechanisms within the precision, each with its configuration."""
    for other, place in configuration.elsewhere:
        branch = other.branch(place)
        assert branch is not None
        yield other, branch


def _immobile_on_all(configuration: Configuration, search: Branches) -> set[JointId]:
    """Return the joints that are immobile on every branch, also of those that are not listed."""
    if not search.parts:
        branches = [branch for branch in search.branches if branch.begun or configuration.more]
        each = [_immobile_places(branch, configuration.linkage.angles) for branch in branches]
        return {configuration.joints[place] for place in set(range(len(configuration.joints))).intersection(*each)}
    immobile = set[JointId]()
    for part in search.parts:
        each = [_immobile_places(branch, part.linkage.angles) for branch in part.choices]
        on_all = set(range(len(part.joints))).intersection(*each)
        immobile |= {configuration.joints[part.joints[place]] for place in on_all}
    return immobile


def _bounds_of_search(configuration: Configuration, kinds: Counter[int | None], stated: MotionBranch) -> FreedomBounds:
    """Return the same where a search for branches ended early: those that were traced have their freedoms."""
    here = number_below(configuration.closure.at(configuration.linkage.angles)[1], DOUBLE.singular)
    least = 1 if stated.freedoms is None else stated.freedoms
    most = here if stated.freedoms is None else stated.freedoms
    freest = max([least, *(freedoms or 0 for freedoms in kinds)])
    return FreedomBounds(max(kinds.total(), 1), (least, most), (freest, max(here, freest)))


def _unmoved(configuration: Configuration, branches: Branches) -> tuple[int | None, Certainty]:
    """Return the freedoms where nothing moves, with the evidence: proved if nothing nearly moves either.

    Where the digits alone give the precision, coordinates may have larger errors that nothing shows: a mechanism
    nearby may then be the intended one.
    """
    if not branches.exhaustive or configuration.unsettled:
        return None, "not known"
    precision = configuration.precision
    nearby = isinstance(configuration, SheetConfiguration) and configuration.nearest is not None
    doubtful = precision.source == ESTIMATED or (precision.evidence == BY_DIGITS and nearby)
    return 0, "numerical" if configuration.nearly or doubtful else "proved"


def _marked(configuration: Configuration) -> tuple[int | None, Marked | None]:
    """Return the number of the branch that the assignment chooses, of all mechanisms, and whether one has it."""
    chosen = configuration.marked
    own = 0 if configuration.branches is None else configuration.branches.numbered
    if chosen.marked not in (None, "has"):
        for place, (other, number) in enumerate(configuration.elsewhere):
            if other.marked.number == number:
                return own + place, "has"
    return chosen.number, chosen.marked


def _branches_of(configuration: Configuration, branches: Branches) -> tuple[MotionBranch, ...]:
    """Return the branches that were followed, which come first; of a longer search all."""
    followed = [branch for branch in branches.branches if branch.begun or configuration.more]
    return tuple(_branch(configuration, branch) for branch in followed)


def _immobile_places(branch: Branch, angles: Floats) -> list[int]:
    """Return the places of the joints that have not moved where a branch was followed to."""
    apart = np.abs(branch.sample - angles) > DOUBLE.immobile
    return [place for place in branch.immobile if not apart[place]]


def _branch(configuration: Configuration, branch: Branch) -> MotionBranch:
    immobile = tuple(configuration.joints[place] for place in _immobile_places(branch, configuration.linkage.angles))
    freedoms, certainty, misfit = branch.freedoms, branch.certainty, configuration.misfit
    return MotionBranch(branch.signs, freedoms, certainty, immobile, branch.followed, misfit)


def _stated(configuration: Configuration, branches: Sequence[MotionBranch], chosen: int | None) -> MotionBranch | None:
    """Return the branch whose freedoms are stated: the assigned one, or the freest; None if there is none."""
    if chosen is not None:
        at, number = configuration.of_branch(chosen)
        branch = at.branch(number) if isinstance(number, int) else None
        if branch is not None and branch.begun:
            return _branch(at, branch)
    return max(branches, key=lambda one: (one.certainty != "not known", one.freedoms or 0), default=None)


def verdict_of_type(answer: MobilityAnswer, left_out: str = "") -> Verdict:
    """Return the verdict that counts and ranks allow, with the reason why motion was not looked for.

    A configuration at which all closure equations are independent is regular: its rates are motions. Where the
    exact rank of a type is as large as its number of equations it is proved, since no realisation has more.
    """
    here, exact = answer.infinitesimal, answer.exact
    if here is not None and here.dof is not None and here.self_stresses == 0:
        text = f"Mobile from this configuration: {in_words(here.dof)}." if here.dof else "Rigid."
        return Verdict(here.dof, "pose", "proved", text)
    special = here is not None and here.self_stresses != 0  # what holds in general says nothing of this one
    end = f"; {left_out}" if left_out else ""
    if exact is not None and not _is_of_rods_alone(answer):
        certainty: Certainty = "proved" if exact.mobility == answer.mobility else "numerical"
        how = "exact rank" if certainty == "proved" else "exact rank of random realisations, modulo two primes"
        freedoms = None if special else max(exact.mobility, 0)
        return Verdict(freedoms, "generic", certainty, _generic(exact.mobility, how, end))
    if (member := answer.counts.get("general_member")) is not None:  # of joints of all kinds
        return Verdict(member, "generic", "numerical", _generic(member, "rank of a random realisation", end))
    if answer.mobility is None:
        return Verdict(None, "count", "not known", f"Mobility unknown{end}.")
    freedoms = None if special else max(answer.mobility, 0)
    return Verdict(freedoms, "count", "not known", _generic(answer.mobility, "by count", end))


def _is_of_rods_alone(answer: MobilityAnswer) -> bool:
    """Check whether a rank is of rods to remote centres, which is not the mobility: then the count answers."""
    return any(note.endswith(RODS_ALONE) for note in answer.warnings)


def _generic(freedoms: int, how: str, end: str) -> str:
    if freedoms <= 0:
        count = f", M = {freedoms}" if freedoms < 0 else ""
        return f"A generic realisation is rigid ({how}{count}){end}."
    return f"A generic realisation has {in_words(freedoms)} ({how}){end}."


MOST_PANELS = 12_000
"""The motion of larger sheets is looked for on request only."""


def on_request(sheet: Sheet) -> str:
    """Return why the motion of a large sheet was not looked for."""
    return f"the motion of {len(sheet.faces)} panels is analysed on request (--motion)"


@dataclass(frozen=True, slots=True, repr=False)
class JudgedMobility(Printed):
    """The verdict on one mechanism with the report that supports it. It prints as ``synth mobility`` does.

    Attributes
    ----------
    verdict : Verdict
    report : MobilityAnswer
        Ranks and counts; its values are attributes here too: `mechanism_class`, `links`, `joints`, `loops`,
        `centres`, `mobility`, `equations`, `counts`, `repairs`, `warnings`, `arrangement`, `exact`, `infinitesimal`,
        `reading`, `overconstraint`.
    configuration : Configuration or None
        Where it moves from; None for a type, and where its motion was not looked for.
    flat_folding : FlatFoldability or None
        Whether a flat pattern folds flat, panels bending on the way; None for others, and for large ones.
    """

    verdict: Verdict
    report: MobilityAnswer
    configuration: Configuration | None = None
    flat_folding: FlatFoldability | None = None

    @property
    def mechanism_class(self) -> str:
        """The class by Wiener's Fig. 37."""
        return self.report.mechanism_class

    @property
    def links(self) -> int | None:
        """N."""
        return self.report.links

    @property
    def joints(self) -> int | None:
        """J."""
        return self.report.joints

    @property
    def loops(self) -> int | None:
        """L, independent loops."""
        return self.report.loops

    @property
    def centres(self) -> int:
        """Distinct centres."""
        return self.report.centres

    @property
    def mobility(self) -> int | None:
        """Generic mobility M by count."""
        return self.report.mobility

    @property
    def equations(self) -> Mapping[str, EquationResult]:
        """The equations of mobility, by name."""
        return self.report.equations

    @property
    def counts(self) -> Mapping[str, int]:
        """Further counts, by name."""
        return self.report.counts

    @property
    def repairs(self) -> tuple[str, ...]:
        """What was repaired when the mechanism was read."""
        return self.report.repairs

    @property
    def warnings(self) -> tuple[str, ...]:
        """Notes on the evidence."""
        return self.report.warnings

    @property
    def arrangement(self) -> Arrangement | None:
        """How the centres are arranged."""
        return self.report.arrangement

    @property
    def exact(self) -> ExactMobility | None:
        """The generic mobility by rank."""
        return self.report.exact

    @property
    def infinitesimal(self) -> InfinitesimalMobility | None:
        """The infinitesimal degrees of freedom at the coordinates."""
        return self.report.infinitesimal

    @property
    def reading(self) -> Reading | None:
        """What was done to a drawing when it was read."""
        return self.report.reading

    @property
    def overconstraint(self) -> int | None:
        """H = degrees of freedom at the configuration - M."""
        return self.report.overconstraint

    @property
    def _states_another_h(self) -> bool:
        """Whether the verdict states h of its motion, which is not that at this configuration."""
        freedoms, mobility = self.verdict.freedoms, self.mobility
        if self.verdict.basis != "motion" or freedoms is None or mobility is None or freedoms <= mobility:
            return False
        return freedoms - mobility != self.overconstraint

    @property
    def herve(self) -> HerveClass | None:
        """Hervé's class of the motion that the verdict states; None if there is none, or it was not told."""
        if self.configuration is None or not self.verdict.freedoms:
            return None
        told = herve_class(self.configuration)
        return told if told is not None and told.freedoms == self.verdict.freedoms else None

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        herve = self.herve
        at, mended = self.configuration, {"mended": list(self.mended)}
        first = {
            "verdict": self.verdict.to_json(),
            "configuration": None if at is None else at.to_json(at.branch(at.chosen)),
            "assignment": None if at is None else at.nearest_to_json(),
            "flat_folding": None if self.flat_folding is None else self.flat_folding.to_json(),
        }
        last = {**mended, "herve": None if herve is None else herve.to_json()}
        return {**first, **self.report.to_json(), **last}

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
        lines: list[Block] = [self.verdict.text]
        if self.configuration is not None and self.configuration.disagreeing:
            lines.append(self.configuration.disagreeing)
        if self.flat_folding is not None:
            lines.append(str(self.flat_folding))
        repaired: list[Block] = [f"repaired: {note}" for note in self.mended]
        herve = self.herve
        told: list[Block] = [] if herve is None else [str(herve)]
        evidence = self.report.evidence(verbose=verbose, with_h=not self._states_another_h)
        return [*self.report.unread(), *lines, *evidence, *told, *self._precision(), *repaired]

    def _repr_html_(self) -> str:
        return html_of(self.blocks(verbose=True))

    def __repr__(self) -> str:
        return f"<JudgedMobility: {self.verdict.summary}>"


def mobility(
    mechanism: Configuration | MechanismLike,
    *,
    exact: bool | None = None,
    hinge_flat: bool = False,
    frame: int | None = None,
    geometry: bool = True,
    motion: bool | None = None,
    precision: float | None = None,
    more: bool = False,
) -> JudgedMobility:
    """Report whether a mechanism moves, its degrees of freedom, its motion branches, and the evidence.

    Parameters
    ----------
    mechanism : Mechanism, str, Path, networkx graph or Configuration
        A mechanism, its file or id. A plain graph is a link-joint graph: each face of a drawing of it gets a finite
        centre. A Configuration is judged where it is.
    exact : bool, optional
        Find the exact generic rank; by default unless the mechanism is too large.
    hinge_flat : bool, optional
        Make hinges of the flat (F) edges of a crease pattern too.
    frame : int, optional
        The frame of a FOLD file that all numbers are those of; by default the pattern as it was read, or if that
        has no coordinates, the first frame that has.
    geometry : bool, optional
        Give loops round holes and cuts of a crease pattern the centre where their axes meet or are parallel.
    motion : bool, optional
        Look for the motion of a crease pattern from its configuration; by default unless it is too large.
    precision : float, optional
        The error that a coordinate may have, in their unit; by default as they are written, or as the geometry
        shows. A Configuration has its own.
    more : bool, optional
        Look for motion branches with a hundred times the usual allowance, and list all that are found.

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
    >>> answer.mobility, answer.infinitesimal.dof
    (1, 2)
    """
    mechanism = mechanism_for("mobility", mechanism, Configuration | Mechanism)
    if precision is not None and isinstance(mechanism, Mechanism):
        mechanism = with_precision(mechanism, precision)
    source = _counted_from(mechanism)
    at, reason = None, "its motion was not analysed" if motion is False else ""
    demanded = bool(motion)
    if motion is not False and isinstance(source, Sheet):
        placed = sheet_in_frame(source, frame)
        if isinstance(mechanism, Configuration):
            at = mechanism
        elif placed.coordinates is not None and len(placed.faces) > MOST_PANELS and not demanded:
            reason = on_request(placed)
        elif placed.coordinates is not None or demanded:
            at, reason = _configuration(mechanism, frame, hinge_flat, demanded=demanded)
    dual = at.dual if isinstance(at, SheetConfiguration) and geometry else None
    answer = counts_and_ranks(source, exact=exact, hinge_flat=hinge_flat, frame=frame, geometry=geometry, dual=dual)
    if motion is not False and not isinstance(source, Sheet) and (answer.infinitesimal is not None or motion):
        at, reason = _configuration(mechanism, frame, hinge_flat, demanded=demanded)
    if at is None:
        return _judged(answer, verdict_of_type(answer, reason if answer.infinitesimal is not None else ""))
    at = replace(at, more=True) if more else at
    judged = _judged(answer, verdict_of_motion(at, answer.mobility), at)
    if hinge_flat or not isinstance(at, SheetConfiguration) or not at.flat:
        return judged
    return replace(judged, flat_folding=flat_foldability(at.drawn))


def mobility_of_type(
    mechanism: Configuration | Mechanism | nx.Graph,
    *,
    exact: bool | None = None,
    hinge_flat: bool = False,
    geometry: bool = True,
) -> JudgedMobility:
    """Report the mobility of the type of a mechanism, without what holds at its configuration.

    Parameters
    ----------
    mechanism, exact, hinge_flat, geometry
        As in `mobility`.

    Examples
    --------
    >>> from synth.catalogue.patterns import generate
    >>> print(mobility_of_type(generate("miura").mechanism).verdict)
    A generic realisation is rigid (exact rank).
    """
    source = _counted_from(mechanism)
    answer = counts_and_ranks(source, exact=exact, hinge_flat=hinge_flat, infinitesimal=False, geometry=geometry)
    return _judged(answer, verdict_of_type(answer))


def _counted_from(mechanism: Configuration | Mechanism | nx.Graph) -> Mechanism | nx.Graph:
    """Return what is counted: of a configuration, the mechanism that was read."""
    if not isinstance(mechanism, Configuration):
        return mechanism
    if mechanism.given is None:
        raise UnsolvableError(f"mobility requires a mechanism to count, and {mechanism!r} has only axes")
    return mechanism.given


def _configuration(
    mechanism: Configuration | Mechanism | nx.Graph, frame: int | None, hinge_flat: bool, *, demanded: bool
) -> tuple[Configuration | None, str]:
    """Return the configuration whose motion is judged, or why there is none; an error if it is demanded."""
    try:
        return configuration_of(mechanism, frame=frame, hinge_flat=hinge_flat), ""
    except SynthedraError as error:
        if demanded:
            raise
        return None, f"its motion was not analysed: {error}"


def _judged(answer: MobilityAnswer, verdict: Verdict, at: Configuration | None = None) -> JudgedMobility:
    return JudgedMobility(verdict, answer, at)
