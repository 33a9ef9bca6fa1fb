"""Realisations that move although counts say no: families of special geometry, tried one after the other.

Each member of a family is followed by a finite motion; `SpecialSearch` reports the families and the members that
move. Theory: docs/theory/realisation.md.
"""

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from math import degrees
from typing import Any

import numpy as np

from graphs.convert.conversions import Mechanism, to_sc, to_scd
from graphs.errors import InvariantError, SynthedraError, UnsolvableError, check_argument, numbered, shown
from graphs.identity.drawings import map_id
from graphs.loops.loop import Centre
from graphs.mechanism.sc import SCGraph, SpecialGeometry
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.printing import Block, Printed
from graphs.rank.exact import exact_mobility, independent_cycles
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.analysis.motion.branches import first_branch, search_for
from synth.analysis.motion.configuration import Configuration
from synth.analysis.motion.germ import Branch
from synth.analysis.motion.linkage import moved
from synth.analysis.motion.walk.step import Allowance
from synth.analysis.moving._configuration_of import configuration_of
from synth.analysis.overconstraint.explanation import explain
from synth.catalogue.realisation.pattern import Pattern, check_holes, check_search, pattern_of
from synth.catalogue.realisation.special import families

_SHARE = 0.02
"""A joint that turns by less than this part of the largest turn hardly moves."""
OTHER_TYPE = "axes of a loop meet although they do not in the type"
"""Why a drawing is of another type when it is read back."""


def _least_share(at: Configuration, branch: Branch) -> float:
    """Return the least turn of a joint, up to where the branch was followed, as a part of the largest."""
    turned = np.abs(branch.sample - at.linkage.angles)
    return float(turned.min(initial=np.inf) / turned.max(initial=0.0))


def turns_all(rates: Floats) -> bool:
    """Check that no joint rate is zero."""
    return bool(np.abs(rates).min(initial=1.0) > DOUBLE.zero_rate)


def _degrees_of_freedom(number: int) -> str:
    return numbered(number, "degree of freedom", "degrees of freedom")


@dataclass(frozen=True)
class SpecialMember:
    """A member with special dimensions that moves.

    `family` names the conditions that it obeys, `start` is the number of the random start in its family, from 0,
    `number` that of its branch. `h` is the number of redundant closure equations on the branch, ten degrees from
    where it begins; `reasons` are those that `synth.explain` recognises there.
    """

    family: str
    start: int
    configuration: Configuration = field(repr=False)
    number: int
    h: int
    reasons: tuple[str, ...]

    @property
    def branch(self) -> Branch:
        """The branch that it moves on."""
        branch = self.configuration.branch(self.number)
        assert branch is not None
        return branch

    @property
    def mechanism(self) -> Mechanism:
        """A flat sheet with the mountains and valleys of its branch, or hinged solids."""
        mechanism = self.configuration.given
        assert isinstance(mechanism, Sheet | HingedSolids)
        if isinstance(mechanism, HingedSolids):
            return mechanism
        signs = self.branch.signs  # creases come first among the edges of the drawing
        letters = "".join({"+": "V", "-": "M"}.get(sign, "U") for sign in signs)
        return replace(mechanism, assignments=letters + mechanism.assignments[len(letters) :])

    @property
    def freedoms(self) -> int:
        """Degrees of freedom of the finite motion."""
        return self.branch.freedoms or 0

    @property
    def residual(self) -> float:
        """Loop-closure residual after ten degrees."""
        return self.branch.error

    @property
    def mark(self) -> SpecialGeometry:
        """The mark for the type."""
        return SpecialGeometry(self.freedoms, (self.family, *self.reasons))

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on."""
        branch = self.branch
        return {
            "family": self.family,
            "start": self.start,
            "kind": "sheet" if isinstance(self.mechanism, Sheet) else "axes",
            "configuration": self.configuration.to_json(branch),
            "freedoms": self.freedoms,
            "certainty": branch.certainty,
            "followed_deg": degrees(branch.followed),
            "closure": self.residual,
            "h": self.h,
            "reasons": list(self.reasons),
        }

    def lines(self) -> list[Block]:
        """Return the lines that are printed."""
        branch = self.branch
        return [
            f"found: {self.family} (start {self.start + 1})",
            f"  {_degrees_of_freedom(self.freedoms)}, {branch.certainty}: traced to "
            f"{degrees(branch.followed):.0f}°, loop-closure residual {self.residual:.0e}, h = {self.h}",
            f"  reasons: {', '.join(self.reasons) or 'none recognised'}",
        ]


@dataclass(frozen=True)
class FamilyTrial:
    """The result of one family.

    `starts` are the random starts; `work` counts steps of least squares with 60 unknowns, and of improved
    drawings. `member` is the first that moves as required, `reasons` are those against other starts, with their
    numbers; `used_up`: the allowance of work ended the search.
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
        return f"none: {self.name}, {numbered(self.starts, 'start')}: {why or 'no member was made'}{ended}"


@dataclass(frozen=True)
class SpecialSearch(Printed):
    """The members of a type that move although counts say no, and every family that was tried.

    Attributes
    ----------
    graph : SCGraph
        The type.
    freedoms : int
        The degrees of freedom that members need.
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
        """The members that were found, one per family."""
        return tuple(trial.member for trial in self.trials if trial.member is not None)

    @property
    def work(self) -> float:
        """The work of all families together."""
        return sum(trial.work for trial in self.trials)

    @property
    def type_with_mark(self) -> SCGraph:
        """The type with a mark of the first member; unchanged if there is none."""
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
        freedoms = _degrees_of_freedom(self.freedoms)
        if self.proof is not None:
            return [f"No realisation moves with {freedoms} in all joints: {self.proof}."]
        members, count = self.members, f"although M = {self.mobility} by count"
        kinds = f"{numbered(len(members), 'kind')} of special geometry {'moves' if len(members) == 1 else 'move'}"
        head = (
            f"{kinds} with {freedoms}, {count}."
            if members
            else f"No realisation was found that moves with {freedoms}, {count}. This proves nothing."
        )
        lines: list[Block] = [head]
        for trial in self.trials:
            lines += [trial.line()] if trial.member is None else trial.member.lines()
        starts = numbered(sum(trial.starts for trial in self.trials), "start")
        lines.append(f"tried: {numbered(len(self.trials), 'family', 'families')}, {starts}, work {self.work:.0f}")
        return lines

    def __repr__(self) -> str:
        return f"<SpecialSearch: {numbered(len(self.members), 'member')} of {self.graph!r}>"


_WORK, _DRAWING = 200.0, 1000.0
"""Units of work of one family: steps of least squares with 60 unknowns; steps that improve drawings."""


@dataclass(frozen=True, slots=True)
class SpecialWishes:
    """Which members to search for, and how long.

    Members move with `freedoms`, in `all_joints` or in some; `flat` says whether flat sheets are tried, before
    axes in space, `geometry` is part of the names of the families. Each has up to `tries` random starts; with
    `every` the search continues after the first that moves.
    """

    freedoms: int
    flat: bool = True
    seed: int = 0
    tries: int = 12
    geometry: str = ""
    every: bool = False
    all_joints: bool = True


def search_special(mechanism: Mechanism, wishes: SpecialWishes) -> SpecialSearch:
    """Search for members of a type that move with more freedoms than a generic realisation has.

    Flat sheets are tried for an SCD graph only. That none moves proves nothing, unless the `proof` of the result
    says so. Raises `InvariantError` if a generic realisation has so many freedoms, or an option is out of its
    range, `UnsolvableError` if no family has the name in `wishes`, or the type has no loop.
    """
    check_argument("realise", mechanism, Mechanism)
    converted = to_sc if isinstance(mechanism, HingedSolids) else to_scd
    graph = mechanism if isinstance(mechanism, SCGraph) else converted(mechanism)
    if wishes.freedoms < 1:
        raise InvariantError("freedoms", f"{wishes.freedoms} freedoms", "1 or more")
    check_search(wishes.seed, wishes.tries)
    if not graph.independent_loops:
        raise UnsolvableError("the type has no loops, so every realisation moves; expected a type with a loop")
    if graph.components > 1:
        raise UnsolvableError(f"the type has {graph.components} parts; expected a connected type")
    general = exact_mobility(graph).mobility
    if general >= wishes.freedoms:
        freedoms = numbered(general, "degree of freedom", "degrees of freedom")
        what = f"a generic realisation of the type already has {freedoms}"
        raise InvariantError("freedoms", what, f"more than {general}")
    equations = sum(6 if loop.centre is Centre.NONE else 3 for loop in independent_cycles(graph))
    proof = _rigid_loop(graph) if wishes.all_joints else None
    trials: list[FamilyTrial] = []
    if proof is None:
        for trial in _trials(graph, wishes):
            trials.append(trial)
            if trial.member is not None and not wishes.every:
                break
        if not trials:
            raise UnsolvableError(f"no family of special geometry has {shown(wishes.geometry)} in its name")
    mobility = len(graph.joints) - equations
    return SpecialSearch(graph, wishes.freedoms, mobility, wishes.seed, tuple(trials), proof)


def _rigid_loop(graph: SCGraph) -> str | None:
    """Return the loop of three joints that no geometry moves, if there is one."""
    # three distinct axes about a point, or parallel, close one triangle; three skew axes close one too
    for loop in independent_cycles(graph):
        if len(loop.joints) <= 3:
            names = ", ".join(shown(joint) for joint in loop.joints)
            kind = {Centre.FINITE: "about a point", Centre.INFINITE: "that are parallel", Centre.NONE: "in space"}
            return f"joints {names} are three axes {kind[loop.centre]} in one loop: these never move"
    return None


def _trials(graph: SCGraph, wishes: SpecialWishes) -> Iterator[FamilyTrial]:
    """Yield the result of each family with the name in `wishes`: flat sheets first, then axes in space."""
    pattern = _pattern(graph) if wishes.flat else None
    for family in [] if pattern is None else families.sheet_families(pattern):
        if pattern is not None and wishes.geometry in family.name:
            work = Allowance(_DRAWING)
            sheets = family.members(pattern, wishes.seed, wishes.tries, work)
            # of a drawing with further conditions the type may be another: it is read back
            read = (
                (number, sheet if map_id(to_scd(sheet)) == map_id(graph) else OTHER_TYPE) for number, sheet in sheets
            )
            yield _trial(f"flat sheet: {family.name}", read, work, wishes)
    of = families.type_of_axes(graph if not isinstance(graph, SCDGraph) else graph.sc_graph())
    for axis_family in families.axis_families(of):
        if wishes.geometry in axis_family.name:
            work = Allowance(_WORK)
            members = _members(of, axis_family, work, wishes)
            yield _trial(f"axes in space: {axis_family.name}", members, work, wishes)


def _members(
    of: families.TypeOfAxes, family: families.AxisFamily, work: Allowance, wishes: SpecialWishes
) -> Iterator[tuple[int, HingedSolids | str]]:
    """Yield the number of each start with the member that it led to, or why it led to none."""
    for number in range(wishes.tries):
        axes = family.member(of, np.random.default_rng((wishes.seed, number)), work)
        if axes is None:
            yield number, "conditions were not met"
        else:
            why = families.degenerate(of, axes)
            yield number, families.solids_of(of, axes) if why is None else why
        if work.used_up:
            return


def _pattern(graph: SCGraph) -> Pattern | None:
    """Return the pattern of an SCD graph that has a flat sheet; None for others."""
    if not isinstance(graph, SCDGraph):
        return None
    try:
        pattern = pattern_of(graph)
        check_holes(pattern)
    except UnsolvableError:
        return None
    return pattern


def _trial(
    name: str, members: Iterable[tuple[int, Sheet | HingedSolids | str]], work: Allowance, wishes: SpecialWishes
) -> FamilyTrial:
    """Return the result of a family: its first member that moves as required, or why there is none."""
    begun = work.left
    reasons: Counter[str] = Counter()
    starts = 0
    for number, member in members:
        starts = number + 1
        verdict = member if isinstance(member, str) else _judged(member, name, number, wishes)
        if isinstance(verdict, SpecialMember):
            return FamilyTrial(name, starts, begun - work.left, verdict, tuple(reasons.items()))
        reasons[verdict] += 1
    missing = wishes.tries - sum(reasons.values())
    if missing > 0 and not work.used_up:
        reasons["no drawing was found"] += missing
    starts = max(starts, wishes.tries)
    return FamilyTrial(name, starts, begun - work.left, None, tuple(reasons.items()), work.used_up)


def _judged(realisation: Sheet | HingedSolids, family: str, start: int, wishes: SpecialWishes) -> SpecialMember | str:
    """Return a member that moves as required, or why it does not.

    Only branches count that were followed by a finite motion and have the freedoms there; of those the first on
    which all joints turn is chosen.
    """
    try:
        at = configuration_of(realisation, mend=False)  # coordinates are exact
        search = search_for(len(at.joints), None)
        if wishes.all_joints and first_branch(at.linkage, turns_all, search) is None:
            return "no motion of all joints"  # without a proof that nothing moves, which would take long
        if at.branches is None:
            return "too large to look for all branches"
        branches = at.branches.branches
        places = [place for place, branch in enumerate(branches) if branch.certainty != "not known"]
        if not places:
            return "nothing moves"
        if wishes.all_joints:
            places = [place for place in places if not branches[place].immobile]
            if not places:
                return "some joints do not move"
            places = [place for place in places if _least_share(at, branches[place]) >= _SHARE]
            if not places:
                return "some joints hardly move"
        fitting = [place for place in places if branches[place].freedoms == wishes.freedoms]
        if not fitting:
            least = min((branches[place].freedoms or 0 for place in places), default=0)
            return f"moves with {numbered(least, 'freedom')}"
        explanation = explain(moved(at.linkage, branches[fitting[0]].sample))
        reasons = dict.fromkeys(reason for equations in explanation.sets for reason in equations.reasons)
        return SpecialMember(family, start, at, fitting[0], explanation.idle, tuple(reasons))
    except SynthedraError as error:
        return str(error)
