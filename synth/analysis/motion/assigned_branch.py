"""Mountains and valleys as they are marked, and the ways to move that begin so.

Theory: docs/theory/verdict.md.
"""

from collections.abc import Sequence
from typing import Any, Literal, NamedTuple

import numpy as np

from graphs.tolerances import DOUBLE, signed
from graphs.types import Floats
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.germ import Branch, Branches
from synth.analysis.motion.linkage import Linkage
from synth.analysis.motion.singular.sampling import rates_towards, same_part
from synth.analysis.motion.singular.second_order import RateSpace, rates_at

Marked = Literal["has", "none has", "none found"]

_REFINED, _TRIED = 4, 60
"""So many of the branches nearest to the assignment are looked at closely, if at most so many joints disagree."""

_STARTS, _LEAST, _TOGETHER = 40, 4, 600
"""Starts from which rates with all marks are looked for where equations are left: at most and at least on one
space, and on all together."""


class AssignedBranch(NamedTuple):
    """The branch that the assignment chooses: of several that begin with it the freest, None if there is none.

    "none has" is proved, by linear programming on the rates that close to first order, or on all branches; "none
    found" is not. `marked` is None where nothing is assigned. `rates`, float[J], begin the branch as assigned.
    """

    number: int | None
    marked: Marked | None
    rates: Floats | None = None


class Disagreement(NamedTuple):
    """How the assignment differs from a branch, by its number, at the rates float[J] nearest to it.

    `opposite` and `immobile` are places of joints: those assigned the other way than they turn there, up to the
    sign of all; and those assigned that stay as they are.
    """

    number: int
    opposite: tuple[int, ...]
    immobile: tuple[int, ...]
    rates: Floats

    @property
    def size(self) -> int:
        """How many joints disagree."""
        return len(self.opposite) + len(self.immobile)


def assigned_branch(branches: Branches, linkage: Linkage, marks: Floats, first: Floats | None = None) -> AssignedBranch:
    """Return the branch that begins with all marked joints as they are marked, or all against it.

    Marks are 1 for valleys, -1 for mountains, 0 for joints without; those of a branch are looked for first from
    the rates `first`, float[J], that have all marks.
    """
    if not marks.any() or not branches.branches:
        return AssignedBranch(None, None)
    if branches.parts:
        return _assigned_of_parts(branches, marks, first)
    spaces = {id(branch.space): branch.space for branch in branches.branches}
    starts = min(_STARTS, max(_LEAST, _TOGETHER // len(spaces)))
    order = np.array(branches.order, dtype=np.int64)
    in_order = signed(marks[order])
    turn, place = float(np.sign(in_order @ marks[order])), np.argsort(order)
    begin = None if first is None else turn * first[order]
    begun = {}
    for number, space in spaces.items():
        ordered = marked_rates(space.in_order(order), in_order, starts, begin)
        begun[number] = [turn * rates[place] for rates in ordered]
    parts = [_on_part(branch, begun[id(branch.space)]) for branch in branches.branches]
    agree = {number: rates for number, rates in enumerate(parts) if rates is not None}
    if agree:
        freest = max(agree, key=lambda number: (branches.branches[number].freedoms or 0, -number))
        return AssignedBranch(freest, "has", _begun_as_marked(branches.branches[freest], agree[freest], marks))
    tangent = rates_at(ClosureEquations(linkage), linkage.angles)
    linear = branches.exhaustive and not any(branch.space.left for branch in branches.branches)
    sure = linear or _rates_with(tangent, marks) is None
    return AssignedBranch(None, "none has" if sure else "none found")


def _assigned_of_parts(branches: Branches, marks: Floats, first: Floats | None) -> AssignedBranch:
    """Return the branch of several parts that begins as assigned: each part may turn over without the others."""
    places, rates, known = [], np.zeros(len(marks)), list[Marked]()
    for part in branches.parts:
        own = marks[part.joints]
        begin = None if first is None else first[part.joints]
        way = assigned_branch(part.branches, part.linkage, own, begin)
        if own.any():
            none: Marked = "none has" if part.branches.no_motion == "proved" else "none found"
            known.append(way.marked or none)
        choices = part.choices
        number = _freest(choices) if way.number is None or way.number >= len(choices) else way.number
        places.append(number)
        if choices:
            rates[part.joints] = choices[number].rates if way.rates is None else way.rates
    if all(marked == "has" for marked in known):
        return AssignedBranch(branches.number_of_choice(places), "has", rates)
    return AssignedBranch(None, "none has" if "none has" in known else "none found")


def _freest(choices: Sequence[Branch]) -> int:
    """Return the number of the branch with most freedoms, the first of several; 0 of none."""
    return max(range(len(choices)), key=lambda number: (choices[number].freedoms or 0, -number), default=0)


def rates_as_marked(branch: Branch, marks: Floats) -> Floats:
    """Return rates near to the marks, on the part of the space that the branch is."""
    rates = rates_towards(branch.space, marks)
    if rates.any() and same_part(branch.space, rates, branch.rates):
        return rates
    return -branch.rates if branch.rates @ marks < -DOUBLE.zero_rate else branch.rates


def agreeing_best(branches: Branches, marks: Floats) -> int:
    """Return the number of the branch on which most joints begin as they are assigned, less those that do not."""
    if branches.parts:
        parts = [(part, marks[part.joints]) for part in branches.parts]
        places = [agreeing_best(part.branches, own) if part.choices else 0 for part, own in parts]
        return branches.number_of_choice(places)

    def agreement(branch: Branch) -> int:
        rates = rates_as_marked(branch, marks)
        return int((np.sign(np.where(np.abs(rates) > DOUBLE.zero_rate, rates, 0.0)) * marks).sum())

    return max(range(len(branches.branches)), key=lambda number: (agreement(branches.branches[number]), -number))


def nearest_branch(branches: Branches, marks: Floats) -> Disagreement:
    """Return how the assignment differs from the branch with which the fewest joints disagree.

    Of several, that with which fewest turn the other way, then the freest, then the first. On a branch of one
    freedom the number is exact. On a larger linear one the disagreements are fewest in sum of rates, and of those
    of the best branches none can be left out; where equations are left, they are those of the rates nearest to the
    marks.
    """
    if branches.parts:
        return _nearest_of_parts(branches, marks)
    near = [disagreement_with(number, branch, marks) for number, branch in enumerate(branches.branches)]

    def order(one: Disagreement) -> tuple[int, int, int, int]:
        return one.size, len(one.opposite), -(branches.branches[one.number].freedoms or 0), one.number

    best = sorted(near, key=order)[:_REFINED]
    return min((_fewer(one, branches.branches[one.number].space, marks) for one in best), key=order)


def _nearest_of_parts(branches: Branches, marks: Floats) -> Disagreement:
    """Return how the assignment differs from the nearest branch of several parts: from that of each."""
    places, rates = list[int](), np.zeros(len(marks))
    opposite, immobile = list[int](), list[int]()
    for part in branches.parts:
        own, joints = marks[part.joints], part.joints
        if part.choices and own.any():
            near = nearest_branch(part.branches, own)
            turned = -1.0 if (near.rates * own)[own != 0.0].sum() < 0.0 else 1.0
            near = near._replace(rates=turned * near.rates)
        else:
            number = _freest(part.choices)
            at = part.choices[number].rates if part.choices else np.zeros(len(joints))
            near = Disagreement(number, (), () if part.choices else tuple(np.flatnonzero(own).tolist()), at)
        places.append(near.number)
        opposite += joints[list(near.opposite)].tolist()
        immobile += joints[list(near.immobile)].tolist()
        rates[joints] = near.rates
    return Disagreement(branches.number_of_choice(places), tuple(sorted(opposite)), tuple(sorted(immobile)), rates)


def disagreement_with(number: int, branch: Branch, marks: Floats) -> Disagreement:
    """Return how the assignment differs from a branch."""
    tried = [rates_as_marked(branch, marks), branch.rates, -branch.rates]
    if branch.space.basis.shape[1] > 1 and not branch.space.left:
        tried.append(_least_against(branch.space.basis, marks))
    every = [_differing(number, rates, marks) for rates in tried]
    return min(every, key=lambda one: (one.size, len(one.opposite)))


def _differing(number: int, rates: Floats, marks: Floats) -> Disagreement:
    moves = np.abs(rates) > DOUBLE.zero_rate * np.abs(rates).max(initial=0.0)
    opposite = np.flatnonzero(moves & (rates * marks < 0.0))
    immobile = np.flatnonzero(~moves & (marks != 0.0))
    return Disagreement(number, tuple(opposite.tolist()), tuple(immobile.tolist()), rates)


def _cheapest(cost: Floats, rows: Floats, most: Floats, bounds: Any) -> Any:
    """Return scipy's result for the x within bounds with ``rows @ x <= most`` that costs least."""
    from scipy.optimize import linprog  # takes a third of a second to load

    return linprog(cost, A_ub=rows, b_ub=most, bounds=bounds, method="highs")


def _least_against(basis: Floats, marks: Floats) -> Floats:
    """Return rates that miss the marks least: each joint by how far its rate is below 1 along its mark, in sum."""
    marked = np.flatnonzero(marks)
    rows = np.hstack([-marks[marked, None] * basis[marked], -np.eye(len(marked))])
    cost = np.repeat([0.0, 1.0], [basis.shape[1], len(marked)])
    bounds = [(None, None)] * basis.shape[1] + [(0.0, None)] * len(marked)
    solution = _cheapest(cost, rows, -np.ones(len(marked)), bounds)
    return np.asarray(basis @ solution.x[: basis.shape[1]])


def _fewer(one: Disagreement, space: RateSpace, marks: Floats) -> Disagreement:
    """Let joints that disagree agree, in turn, that can while others go on to; the rest gets room to turn."""
    against = [*one.opposite, *one.immobile][:_TRIED]
    if space.left or space.basis.shape[1] == 1 or one.size > _TRIED:
        return one
    kept = np.where(np.isin(np.arange(len(marks)), against), 0.0, marks)
    for joint in against:
        kept[joint] = marks[joint]
        if _rates_with(space.basis, kept) is None:
            kept[joint] = 0.0
    left = np.flatnonzero(marks - kept)
    agree = np.flatnonzero(kept)
    if not len(left) or not len(agree):
        return one
    free, room = space.basis.shape[1], len(left)
    keep, turn = -kept[agree, None] * space.basis[agree], marks[left, None] * space.basis[left]
    rows = np.block([[keep, np.zeros((len(agree), room))], [turn, np.eye(room)]])
    most = np.repeat([-1.0, 0.0], [len(agree), room])
    bounds = [(None, None)] * free + [(0.0, 1.0)] * room
    solution = _cheapest(np.repeat([0.0, -1.0], [free, room]), rows, most, bounds)
    return one if solution.x is None else _differing(one.number, space.basis @ solution.x[:free], marks)


def _on_part(branch: Branch, begun: Sequence[Floats]) -> Floats | None:
    """Return the first of some rates of its space that is on the part of it that a branch is."""
    on_it = (rates for rates in begun if not branch.space.left or same_part(branch.space, rates, branch.rates))
    return next(on_it, None)


def _begun_as_marked(branch: Branch, otherwise: Floats, marks: Floats) -> Floats:
    """Return the rates nearest to the marks if they have them all, or else others that do; the largest 1 or -1."""
    nearest = rates_as_marked(branch, marks)
    if (nearest * marks)[marks != 0.0].min() > DOUBLE.zero_rate:
        return nearest
    rates = otherwise * np.sign(otherwise @ marks)
    return np.asarray(rates / np.abs(rates).max())


def marked_rates(space: RateSpace, marks: Floats, starts: int, first: Floats | None = None) -> list[Floats]:
    """Return rates of a space that have all marks, of every part that a few starts come to; else none."""
    inside = _rates_with(space.basis, marks)
    if inside is None or not space.left:
        return [] if inside is None else [inside]
    marked, largest, begun = marks != 0.0, np.abs(inside).max(), list[Floats]()
    for number in range(starts):
        start = (marks * largest if first is None else first, inside)[number % 2]
        if number > 1:  # other sizes, the same signs
            start = start * np.random.default_rng((len(marks), number)).uniform(0.0, 2.0, len(marks))
        rates = rates_towards(space, start)
        turned = (rates * marks)[marked]
        if (turned > DOUBLE.zero_rate).all() or (turned < -DOUBLE.zero_rate).all():
            begun.append(rates)
    return begun


def _rates_with(basis: Floats, marks: Floats) -> Floats | None:
    """Return rates within a space, float[J, s], of 1 at least along each mark, least in sum; else None."""
    marked = marks != 0.0
    if not basis.shape[1]:
        return None
    if basis.shape[1] == 1:  # one ray or its opposite: no programme is needed
        along = marks[marked] * basis[marked, 0]
        least = float(np.abs(along).min()) if (along > 0.0).all() or (along < 0.0).all() else 0.0
        clear = least > DOUBLE.zero_rate * float(np.abs(basis).max())
        return np.asarray(np.sign(along[0]) * basis[:, 0] / least) if clear else None
    rows = -marks[marked, None] * basis[marked]
    inside = _cheapest(-rows.sum(axis=0), rows, -np.ones(len(rows)), (None, None))
    return np.asarray(basis @ inside.x) if inside.status == 0 else None
