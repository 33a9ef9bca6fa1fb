"""Mountains and valleys as they are marked, and the ways to move that begin so.

Theory: docs/theory/verdict.md.
"""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np
from scipy.optimize import linprog

from graphs.arrays import Floats
from synth.folding.branches import Branch, Branches
from synth.folding.singular.sampling import rates_towards

__all__ = ["Marked", "MarkedWay", "marked_way"]

Marked = Literal["has", "none has", "none found"]

_STILL = 1e-9
_STARTS = 40
"""Starts from which rates with all marks are looked for where equations are left."""


class MarkedWay(NamedTuple):
    """The way that marks choose.

    Attributes
    ----------
    number : int or None
        Among the branches; of several that begin as it is marked the freest. None if there is none.
    marked : {"has", "none has", "none found"} or None
        Whether there is one. None has: that is proved, by linear programming on the rates that close to first
        order, or on all branches. None found: it is not. None where nothing is marked.
    """

    number: int | None
    marked: Marked | None


def marked_way(found: Branches, tangent: Floats, marks: Floats) -> MarkedWay:
    """Return the way that begins with all marked joints as they are marked, or all against it.

    Parameters
    ----------
    found : Branches
    tangent : float[J, s]
        The rates that close to first order: columns.
    marks : float[J]
        1 for valleys, -1 for mountains, 0 for what is not marked.

    Examples
    --------
    >>> from synth.folding.prepared import prepared
    >>> from synth.folding.second_order import rates_at
    >>> from synth.patterns.creases.tessellations import miura
    >>> pattern = prepared(miura(2, 2, 1.0))
    >>> tangent = rates_at(pattern.closure, pattern.linkage.angles)
    >>> marked_way(pattern.branches, tangent, pattern.marks)
    MarkedWay(number=0, marked='has')
    >>> marked_way(pattern.branches, tangent, abs(pattern.marks))
    MarkedWay(number=None, marked='none has')
    """
    if not marks.any() or not found.branches:
        return MarkedWay(None, None)
    agree = [number for number, branch in enumerate(found.branches) if _begins(branch, marks)]
    if agree:
        return MarkedWay(max(agree, key=lambda number: (found.branches[number].freedoms or 0, -number)), "has")
    sure = found.exhaustive or _rates_with(tangent, marks) is None
    return MarkedWay(None, "none has" if sure else "none found")


def _begins(branch: Branch, marks: Floats) -> bool:
    """Tell whether rates of a branch with all marks were found; with no equations left, whether there are any."""
    inside = _rates_with(branch.space.basis, marks)
    if inside is None or not branch.space.left:
        return inside is not None
    chance = np.random.default_rng(len(marks))
    marked = marks != 0.0
    largest = np.abs(inside).max()
    for number in range(_STARTS):
        start = (marks * largest, inside)[number % 2]
        if number > 1:  # other sizes, the same signs
            start = start * chance.uniform(0.0, 2.0, len(marks))
        rates = rates_towards(branch.space, start) * marks
        if (rates[marked] > _STILL).all() or (rates[marked] < -_STILL).all():
            return True
    return False


def _rates_with(basis: Floats, marks: Floats) -> Floats | None:
    """Return rates within a space, columns of float[J, s], that have all marks; None if there are none."""
    marked = marks != 0.0
    rows = -marks[marked, None] * basis[marked]
    inside = linprog(
        np.zeros(rows.shape[1]), A_ub=rows, b_ub=-np.ones(len(rows)), bounds=(None, None), method="highs"
    )
    return np.asarray(basis @ inside.x) if inside.status == 0 else None
