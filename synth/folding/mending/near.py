"""Branches that a crease pattern nearly has: rates that agree but for what its coordinates cannot tell.

Theory: docs/theory/mending.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import islice

import numpy as np

from graphs.tolerances import DOUBLE, MARGIN, Tolerances
from graphs.types import Floats
from synth.motion.closure import ClosureEquations
from synth.motion.linkage import PosedLinkage
from synth.motion.second_order import RateSpace, largest_only, rates_at, spaces_within
from synth.motion.singular.quadrics import quadrics_of
from synth.motion.singular.sampling import rates_towards
from synth.motion.walk.allowance import Allowance

__all__ = ["NearBranch", "covers", "near_branches", "spaces_at", "zeros_of"]

_SHORT = 10.0
"""Of the lengths of the creases, in per cent: so many are shorter than what directions are judged by."""
_LIKE = 0.15
"""Rates of two spaces are those of one branch, one of them of coordinates with errors, up to this part of the
largest."""
_WIDER = (1.0, 10.0, 0.15)
"""What nearly agrees is looked for at errors so many times those of one direction."""
_WORK = 3e8
"""Of one search for spaces of rates, in products of numbers: about a second."""
_HARDLY, _ERRORS = 0.02, 30.0
"""A rate may be an error that is no larger than the first, of the largest, and than this times what is zero."""
_SLOW = 0.1
"""Joints with smaller rates may be still where errors grew from vertex to vertex."""
_BESIDE = 3
"""Further motions along a branch with several freedoms, at most."""


@dataclass(frozen=True, slots=True)
class NearBranch:
    """A branch that a pattern nearly has.

    Attributes
    ----------
    space : RateSpace
        The rates that nearly agree.
    motions : tuple of float[J]
        Some of them, general ones, that nearest to the assignment first; the largest rate of each is 1 or -1.
    small : float
        Rates that may be errors: joints whose rates are no larger may be still on the branch that is meant.
    """

    space: RateSpace
    motions: tuple[Floats, ...]
    small: float

    @property
    def begun(self) -> list[list[Floats]]:
        """Rates of the motions: with joints still that hardly move, as they are, and with slow joints still."""
        largest = np.abs(self.motions).max(axis=0)
        found = [list(self.motions)]
        for place, small in ((0, self.small), (2, _SLOW)):
            hardly = (largest <= small) & (largest > 0.0)
            if hardly.any():
                found.insert(place, [np.where(largest > small, rates, 0.0) for rates in self.motions])
        return found

    def agreement(self, wanted: Floats) -> float:
        """Return how many joints begin as is wanted, less those that do not."""
        return float(np.sign(self.motions[0]) @ wanted)


def zeros_of(precision: float, lengths: Floats) -> list[float]:
    """Return below which parts of the largest values count as zero: what nearly agrees, the most likely first.

    Errors of directions are those of short creases. They grow from vertex to vertex, by as much as rates differ;
    and where lengths differ or errors are large, a zero that is too wide takes branches for one that are several.
    """
    length = float(np.percentile(lengths, _SHORT)) if len(lengths) else 1.0
    return list(dict.fromkeys(Tolerances.nearly(part * precision, length) for part in _WIDER))


def near_branches(
    linkage: PosedLinkage, zero: float, wanted: Floats, most: int, known: Sequence[NearBranch] = ()
) -> tuple[list[NearBranch], bool]:
    """Return the branches that a linkage nearly has, but for known ones, and whether these are all.

    Those nearest to wanted rates come first.

    Values below the zero count as none. The search ends after `most` spaces of rates.
    """
    found: list[NearBranch] = []
    spaces, complete = spaces_at(linkage, most, zero)
    for space in spaces:
        motions = _motions(space, wanted)
        if motions and not any(_alike(space, one.space) for one in (*known, *found)):
            found.append(NearBranch(space, motions, min(_HARDLY, _ERRORS * zero)))
    return sorted(found, key=lambda one: -one.agreement(wanted)), complete


def spaces_at(linkage: PosedLinkage, most: int, zero: float = DOUBLE.zero) -> tuple[list[RateSpace], bool]:
    """Return the spaces of rates that agree to second order, and whether these are all, as far as is known."""
    tangent, allowance = rates_at(ClosureEquations(linkage), linkage.angles, zero), Allowance(_WORK)
    spaces = spaces_within(tangent, quadrics_of(linkage), zero, allowance)
    found = list(islice(spaces, most + 1))
    return largest_only(found[:most], zero), len(found) <= most and not allowance.used_up


def covers(space: RateSpace, near: RateSpace) -> bool:
    """Tell whether rates that agree exactly are those of a branch that nearly agreed, with all its freedoms."""
    if space.basis.shape[1] < near.basis.shape[1] or len(space.left) > len(near.left):
        return False
    off = near.basis - space.basis @ (space.basis.T @ near.basis)
    return bool(np.abs(off).max() <= _LIKE * np.abs(near.basis).max())


def _alike(space: RateSpace, other: RateSpace) -> bool:
    return space.basis.shape == other.basis.shape and covers(space, other) and covers(other, space)


def _motions(space: RateSpace, wanted: Floats) -> tuple[Floats, ...]:
    """Return general rates of a space, those nearest to wanted ones first; none where there are none."""
    size = space.basis.shape[1]
    starts = [wanted]
    for number in range(min(size, _BESIDE) if size > 1 else 1):
        chance = np.random.default_rng((*space.basis.shape, number))
        starts.append(space.basis @ (chance.uniform(0.5, 1.0, size) * chance.choice([-1.0, 1.0], size)))
    found: list[Floats] = []
    for start in starts:
        rates = rates_towards(space, start) if space.left else space.basis @ (space.basis.T @ start)
        largest = float(np.abs(rates).max())
        if largest > DOUBLE.zero_rate:
            scaled = rates / largest
            found.append(np.where(np.abs(scaled) > MARGIN, scaled, 0.0))
    return tuple(found if size > 1 else found[:1])
