"""Mountains and valleys as they are marked, and the ways to move that begin so.

Theory: docs/theory/verdict.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np
from scipy.optimize import linprog

from graphs.arrays import Floats
from graphs.tolerances import DOUBLE
from synth.motion.branches import Branch, Branches
from synth.motion.closure import ClosureEquations
from synth.motion.linkage import PosedLinkage
from synth.motion.second_order import RateSpace, rates_at
from synth.motion.singular.sampling import rates_towards, same_part

__all__ = ["Marked", "MarkedWay", "agreeing_best", "marked_way", "rates_as_marked"]

Marked = Literal["has", "none has", "none found"]

_STARTS, _LEAST, _TOGETHER = 40, 4, 600
"""Starts from which rates with all marks are looked for where equations are left: at most and at least on one
space, and on all together."""


class MarkedWay(NamedTuple):
    """The branch that the assignment chooses: of several that begin with it the freest, None if there is none.

    "none has" is proved, by linear programming on the rates that close to first order, or on all branches; "none
    found" is not. `marked` is None where nothing is assigned. `rates`, float[J], begin the branch as assigned.
    """

    number: int | None
    marked: Marked | None
    rates: Floats | None = None


def marked_way(found: Branches, linkage: PosedLinkage, marks: Floats) -> MarkedWay:
    """Return the way that begins with all marked joints as they are marked, or all against it.

    Marks are 1 for valleys, -1 for mountains, 0 for joints without; the branches begin at the linkage's pose.
    """
    if not marks.any() or not found.branches:
        return MarkedWay(None, None)
    spaces = {id(branch.space): branch.space for branch in found.branches}
    starts = min(_STARTS, max(_LEAST, _TOGETHER // len(spaces)))
    begun = {number: _marked_rates(space, marks, starts) for number, space in spaces.items()}
    agree = {
        number: rates
        for number, branch in enumerate(found.branches)
        if (rates := _on_part(branch, begun[id(branch.space)])) is not None
    }
    if agree:
        freest = max(agree, key=lambda number: (found.branches[number].freedoms or 0, -number))
        return MarkedWay(freest, "has", _begun_as_marked(found.branches[freest], agree[freest], marks))
    tangent = rates_at(ClosureEquations(linkage), linkage.angles)
    sure = found.exhaustive or _rates_with(tangent, marks) is None
    return MarkedWay(None, "none has" if sure else "none found")


def rates_as_marked(branch: Branch, marks: Floats) -> Floats:
    """Return rates near to what is marked, on the part of the space that the branch is."""
    rates = rates_towards(branch.space, marks)
    if rates.any() and same_part(branch.space, rates, branch.rates):
        return rates
    return -branch.rates if branch.rates @ marks < -DOUBLE.zero_rate else branch.rates


def agreeing_best(found: Branches, marks: Floats) -> int:
    """Return the number of the branch on which most joints begin as they are assigned, less those that do not."""

    def agreement(branch: Branch) -> int:
        rates = rates_as_marked(branch, marks)
        return int((np.sign(np.where(np.abs(rates) > DOUBLE.zero_rate, rates, 0.0)) * marks).sum())

    return max(range(len(found.branches)), key=lambda number: (agreement(found.branches[number]), -number))


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


def _marked_rates(space: RateSpace, marks: Floats, starts: int) -> list[Floats]:
    """Return rates of a space that have all marks, of every part that a few starts come to; else none."""
    inside = _rates_with(space.basis, marks)
    if inside is None or not space.left:
        return [] if inside is None else [inside]
    marked, largest, found = marks != 0.0, np.abs(inside).max(), list[Floats]()
    for number in range(starts):
        start = (marks * largest, inside)[number % 2]
        if number > 1:  # other sizes, the same signs
            start = start * np.random.default_rng((len(marks), number)).uniform(0.0, 2.0, len(marks))
        rates = rates_towards(space, start)
        turned = (rates * marks)[marked]
        if (turned > DOUBLE.zero_rate).all() or (turned < -DOUBLE.zero_rate).all():
            found.append(rates)
    return found


def _rates_with(basis: Floats, marks: Floats) -> Floats | None:
    """Return rates within a space, columns of float[J, s], that have all marks; None if there are none.

    Each marked joint has a rate of 1 at least, their sum is least.
    """
    marked = marks != 0.0
    rows = -marks[marked, None] * basis[marked]
    inside = linprog(-rows.sum(axis=0), A_ub=rows, b_ub=-np.ones(len(rows)), bounds=(None, None), method="highs")
    return np.asarray(basis @ inside.x) if inside.status == 0 else None
