"""Members of a type that move although counts say no: families of special geometry, tried one after the other.

Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from graphs.convert.table import Mechanism, to_sc, to_scd
from graphs.errors import InvariantError, UnsolvableError, check_argument, shown
from graphs.identity.drawings import map_id
from graphs.loops.loop import Centre
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.rank.exact import exact_mobility, independent_cycles
from synth.motion.walk.allowance import Allowance
from synth.realisation.pattern import Pattern, pattern_of
from synth.realisation.refusing import check_holes
from synth.realisation.special.answer import FamilyTrial, SpecialMember, SpecialSearch
from synth.realisation.special.families import (
    AxisFamily,
    TypeOfAxes,
    axis_families,
    degenerate,
    solids_of,
    type_of_axes,
)
from synth.realisation.special.judging import Moving, judged
from synth.realisation.special.sheets import sheet_families

__all__ = ["SpecialWishes", "search_special"]

_WORK, _DRAWING = 200.0, 1000.0
"""Units of work of one family: steps of least squares with 60 unknowns; steps that improve drawings."""


@dataclass(frozen=True, slots=True)
class SpecialWishes:
    """What is looked for, and how long.

    Attributes
    ----------
    freedoms : int
        Of finite motion.
    flat : bool
        Whether flat sheets are tried, before axes in space.
    seed : int
    tries : int
        Random starts of each family, at most.
    geometry : str
        Only families with this in their name.
    every : bool
        Go on through all families after the first that moves.
    all_joints : bool
        Whether all joints have to move.
    """

    freedoms: int
    flat: bool = True
    seed: int = 0
    tries: int = 12
    geometry: str = ""
    every: bool = False
    all_joints: bool = True


def search_special(mechanism: Mechanism, wishes: SpecialWishes) -> SpecialSearch:
    """Look for members of a type that move with more freedoms than a general member has.

    Parameters
    ----------
    mechanism : SCGraph, SCDGraph, or what has one
        A type. Flat sheets are tried of an SCD graph only.
    wishes : SpecialWishes

    Returns
    -------
    SpecialSearch
        With every family that was tried; that none moves proves nothing, but where `proof` says so.

    Raises
    ------
    InvariantError
        If a general member has so many freedoms, or an option is out of its range.
    UnsolvableError
        If no family has the name that is asked for, or the type has no loop.

    Examples
    --------
    >>> ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
    >>> found = search_special(ring, SpecialWishes(1))
    >>> found.members[0].reasons[0]
    'opposite links equal, lengths proportional to the sines of the twists (Bennett)'
    """
    check_argument("realise", mechanism, Mechanism)
    graph = mechanism if isinstance(mechanism, SCGraph) else _type_of(mechanism)
    _check(graph, wishes)
    general = exact_mobility(graph).mobility
    if general >= wishes.freedoms:
        told = f"a general member of the type has {general} already"
        raise InvariantError("freedoms", told, f"more than {general}, or none asked for")
    mobility = len(graph.joints) - sum(6 if one.centre is Centre.NONE else 3 for one in independent_cycles(graph))
    proof = _rigid_loop(graph) if wishes.all_joints else None
    trials: list[FamilyTrial] = []
    if proof is None:
        for trial in _trials(graph, wishes):
            trials.append(trial)
            if trial.member is not None and not wishes.every:
                break
        if not trials:
            raise UnsolvableError(f"no family of special geometry has {shown(wishes.geometry)} in its name")
    return SpecialSearch(graph, wishes.freedoms, mobility, wishes.seed, tuple(trials), proof)


def _type_of(mechanism: Mechanism) -> SCGraph:
    """Return the SCD graph of what has panels, the SC graph of other things."""
    return to_sc(mechanism) if isinstance(mechanism, HingedSolids) else to_scd(mechanism)


def _check(graph: SCGraph, wishes: SpecialWishes) -> None:
    if wishes.freedoms < 1:
        raise InvariantError("freedoms", f"{wishes.freedoms} freedoms", "1 or more")
    if wishes.seed < 0 or wishes.tries < 1:
        told = f"seed {wishes.seed}, tries {wishes.tries}"
        raise InvariantError("tries", told, "a seed of 0 or more, one try or more")
    if not graph.independent_loops:
        raise UnsolvableError("a type without loops moves in general: no geometry is special")
    if graph.components > 1:
        raise UnsolvableError("special geometry is looked for in types of one part")


def _rigid_loop(graph: SCGraph) -> str | None:
    """Return the loop of three joints that no geometry moves, if there is one.

    Three distinct axes about a point, or parallel, close one triangle; three skew axes close one too.
    """
    for loop in independent_cycles(graph):
        if len(loop.joints) <= 3:
            names = ", ".join(shown(joint) for joint in loop.joints)
            kind = {Centre.FINITE: "about a point", Centre.INFINITE: "that are parallel", Centre.NONE: "in space"}
            return f"joints {names} are three axes {kind[loop.centre]} in one loop: these never move"
    return None


def _trials(graph: SCGraph, wishes: SpecialWishes) -> Iterator[FamilyTrial]:
    pattern = _pattern(graph) if wishes.flat else None
    if pattern is not None:
        for family in sheet_families(pattern):
            if wishes.geometry in family.name:
                work = Allowance(_DRAWING)
                sheets = family.members(pattern, wishes.seed, wishes.tries, work)
                read = ((number, _read_back(graph, sheet)) for number, sheet in sheets)
                yield _trial(f"flat sheet: {family.name}", read, work, wishes)
    of = type_of_axes(graph if not isinstance(graph, SCDGraph) else graph.sc_graph())
    for axis_family in axis_families(of):
        if wishes.geometry in axis_family.name:
            work = Allowance(_WORK)

            members = _members(of, axis_family, work, wishes)
            yield _trial(f"axes in space: {axis_family.name}", members, work, wishes)


def _read_back(graph: SCGraph, sheet: Sheet) -> Sheet | str:
    """Return a sheet that is of the type when its coordinates are read, or that it is not."""
    same = map_id(to_scd(sheet)) == map_id(graph)
    return sheet if same else "the axes of a loop meet that the type does not ask to"


def _members(
    of: TypeOfAxes, family: AxisFamily, work: Allowance, wishes: SpecialWishes
) -> Iterator[tuple[int, HingedSolids | str]]:
    """Yield the number of each start with the member that it led to, or why it led to none."""
    for number in range(wishes.tries):
        axes = family.member(of, np.random.default_rng((wishes.seed, number)), work)
        if axes is None:
            yield number, "conditions were not met"
        else:
            why = degenerate(of, axes)
            yield number, solids_of(of, axes) if why is None else why
        if work.used_up:
            return


def _pattern(graph: SCGraph) -> Pattern | None:
    """Return the pattern of an SCD graph that has a flat sheet; None of others."""
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
    """Return what became of a family: its first member that moves as asked, or why there is none."""
    begun = work.left
    reasons: Counter[str] = Counter()
    starts = 0
    for number, member in members:
        starts = number + 1
        found = (
            member if isinstance(member, str) else judged(member, wishes.freedoms, all_joints=wishes.all_joints)
        )
        if isinstance(found, Moving):
            made = SpecialMember(name, number, found)
            return FamilyTrial(name, starts, begun - work.left, made, tuple(reasons.items()))
        reasons[found] += 1
    missing = wishes.tries - sum(reasons.values())
    if missing > 0 and not work.used_up:
        reasons["no drawing was found"] += missing
    starts = max(starts, wishes.tries)
    return FamilyTrial(name, starts, begun - work.left, None, tuple(reasons.items()), work.used_up)
