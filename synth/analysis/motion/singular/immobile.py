"""Joints that are immobile on every branch, for a reason that a few loops give.

A flat vertex of three creases is rigid, and so is whatever is creased inside a triangle of creases. Of the forms of
these loops each is a square, or they vanish together at zero only: they count twice and more among the solutions of
all forms, which are then singular. So such joints are taken out first. Theory: docs/theory/branches.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from graphs.tolerances import DOUBLE
from graphs.types import Floats, Ints
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.linkage import Linkage, LinkagePart, part_of
from synth.analysis.motion.singular.second_order import local_forms, quadrics_of, rates_at, rigidity_of

_MOST_LOOPS = 12
"""Proofs are looked for in so many loops together, at most."""
_FIGURES = 1e-6
"""A loop takes part in a relation between slopes if its share is at least this part of the largest."""


def immobile_joints(linkage: Linkage, zero: float = DOUBLE.zero) -> list[int]:
    """Return places of joints that a few loops alone prove to be immobile, and then a few loops of the rest."""
    immobile: set[int] = set()
    while True:
        rest = without(linkage, immobile)
        if rest is None:
            return sorted(immobile)
        more: set[int] = set()
        for loops in _candidates(rest.linkage, zero):
            joints = sorted({joint for loop in loops for joint in rest.linkage.loops[loop].joints})
            if more.issuperset(rest.joints[joints].tolist()):
                continue
            if rigidity_of(part_of(rest.linkage, joints, loops).linkage, zero=zero).proof is not None:
                more.update(rest.joints[joints].tolist())
        if not more:
            return sorted(immobile)
        immobile |= more


def without(linkage: Linkage, immobile: set[int]) -> LinkagePart | None:
    """Return what is left where joints are taken out of their loops, held at their angles; None if no joint is."""
    left = [joint for joint in range(len(linkage.angles)) if joint not in immobile]
    if not left:
        return None
    shorter = []
    numbers = []
    for number, loop in enumerate(linkage.loops):
        kept = [place for place, joint in enumerate(loop.joints) if joint not in immobile]
        if kept:
            joints, signs = (tuple(values[place] for place in kept) for values in (loop.joints, loop.signs))
            shorter.append(replace(loop, joints=joints, signs=signs))
            numbers.append(number)
    held = replace(linkage, loops=tuple(shorter))
    part = part_of(held, left, range(len(shorter)))
    return part._replace(loops=tuple(numbers))


def _candidates(linkage: Linkage, zero: float) -> Iterator[list[int]]:
    """Yield sets of loops that may be rigid by themselves, the smallest first.

    Forms of a set of loops that depend on no more rates than they are have slopes that span no more than that. So a
    second general slope of one of them is a sum of one slope of each, and those with a share are the set.
    """
    tangent = rates_at(ClosureEquations(linkage), linkage.angles, zero)
    quadrics, loop_of = quadrics_of(linkage, zero), {loop.joints: place for place, loop in enumerate(linkage.loops)}
    if not tangent.shape[1] or not quadrics:
        return
    forms = local_forms(tangent, quadrics)
    chance = np.random.default_rng(forms.shape)
    slopes = forms @ chance.normal(size=forms.shape[1])
    again = forms @ chance.normal(size=forms.shape[1])
    shares = np.linalg.lstsq(slopes.T, again.T, rcond=DOUBLE.zero)[0]
    off = np.abs(slopes.T @ shares - again.T).max(axis=0)
    sets = {tuple(_with_share(column)) for column in shares[:, off <= DOUBLE.clear * np.abs(again).max()].T}
    for numbers in sorted(sets, key=lambda one: (len(one), one)):
        if len(numbers) <= _MOST_LOOPS:
            yield sorted({loop_of[quadrics[number].joints] for number in numbers})


def _with_share(shares: Floats) -> list[int]:
    sizes = np.abs(shares)
    places: Ints = np.flatnonzero(sizes > _FIGURES * sizes.max(initial=0.0))
    return [int(place) for place in places]
