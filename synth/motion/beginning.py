"""Which way a folding begins: the branch that is asked for, or that marks of creases choose, and rates on it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from graphs.arrays import Floats
from graphs.canonical import canonical_basis
from graphs.edit.named import known
from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.rank.spaces import null_space
from graphs.tolerances import DOUBLE
from synth.motion.branches import Branch, Branches, Search
from synth.motion.closure import ClosureEquations
from synth.motion.linkage import PosedLinkage
from synth.motion.second_order import RateSpace
from synth.motion.singular.nearest import begun_near
from synth.motion.singular.sampling import rates_towards, same_part

__all__ = ["MOST_BRANCHES", "MOST_JOINTS", "Wanted", "beginning", "rates_as_marked", "search_for"]

MOST_JOINTS = 600
"""Of larger linkages the branches are not looked for: matrices are dense."""

MOST_BRANCHES, MOST_WORK = 128, 1e10
"""So many are looked for at most, with so many products of numbers (a minute): there may be twice as many for each
row of panels more."""

_FOLLOWED = 2500
"""Joints of all branches that are followed, together: a few seconds. A number, so that answers do not depend on
how fast a machine is."""

_LARGE = 10**9
_DIGITS = 6
"""Of a cosine: branches that point along rates alike are told apart by their order."""


def search_for(joints: int, towards: Floats | None) -> Search:
    """Return how far branches of a linkage of so many joints are looked for in a few seconds."""
    return Search(MOST_BRANCHES, MOST_WORK, follow=max(4, _FOLLOWED // max(joints, 1)), towards=towards)


@dataclass(frozen=True, slots=True)
class Wanted:
    """What is asked of a folding.

    Attributes
    ----------
    branch : int, str or None
        Number or signs of a branch.
    marks : float[J]
        1 for valleys, -1 for mountains, 0 for what is not marked.
    driven : sequence of int
        Places of the joints that are driven.
    turns : float[D]
        How far each is to turn, radians.
    doubt : str
        What is to be said beside "no": coordinates may be rounded. Empty if they are not.
    along : bool
        Whether the turns are rates, of which the marks are what they are made of: the branch that they point along
        best is taken.
    """

    branch: int | str | None
    marks: Floats
    driven: Sequence[int]
    turns: Floats
    doubt: str = ""
    along: bool = False


def beginning(
    closure: ClosureEquations, linkage: PosedLinkage, found: Branches | None, wanted: Wanted
) -> tuple[int | None, Floats]:
    """Return the branch to take, None where there is no choice, and rates on it, near to what is marked.

    Parameters
    ----------
    closure : ClosureEquations
    linkage : PosedLinkage
    found : Branches or None
        The branches, where they were looked for.
    wanted : Wanted

    Raises
    ------
    UnsolvableError
        If no motion begins at the pose, or none with the driven joints.
    InvariantError
        If there is no such branch.
    """
    if found is None:
        if wanted.branch is not None:
            raise UnsolvableError(f"branches of more than {MOST_JOINTS} joints are not looked for")
        near = begun_near(closure, linkage, wanted.marks).rates
        if near is None:
            raise UnsolvableError(
                f"no motion near to how the edges are marked was found at this pose{wanted.doubt}"
            )
        return None, near
    if not found.branches:
        raise UnsolvableError(f"{_how_surely(found)}: no motion begins at this pose{wanted.doubt}")
    number = _chosen(found, wanted)
    taken = found.branches[number]
    return None if found.regular else number, _rates(taken, wanted)


def _how_surely(found: Branches) -> str:
    """Return how it is known that nothing folds."""
    told = {
        "no rates": "no rates close even to first order",
        "definite stress": "a self-stress is definite on all flexes",
        "cases": "no rates agree to second order",
    }
    proof = found.rigidity.proof if found.rigidity is not None else None
    return f"nothing folds, which is proved ({told[proof]})" if proof else "nothing that folds was found"


def _chosen(found: Branches, wanted: Wanted) -> int:
    every, asked = found.branches, wanted.branch
    if isinstance(asked, int):
        if not 0 <= asked < len(every):
            name = str(asked) if abs(asked) < _LARGE else "of so large a number"
            raise InvariantError("branch", f"there is no branch {name}", f"one from 0 to {len(every) - 1}")
        return asked
    if isinstance(asked, str):
        mirrored = asked.translate(str.maketrans("+-", "-+"))
        for number, one in enumerate(every):
            if one.signs in (asked, mirrored):
                return number
        signs = known([one.signs for one in every], asked)
        raise InvariantError("branch", f"no branch has the signs {shown(asked)}", signs)
    return max(range(len(every)), key=lambda number: (_agreement(every[number], wanted), -number))


def _agreement(branch: Branch, wanted: Wanted) -> float:
    """Return how many marked joints begin on a branch as they are marked, less those that do not.

    Where rates are wanted: the cosine between these and the nearest ones of the branch, of the joints that have
    any.
    """
    marks = wanted.marks
    if wanted.along:
        begun = rates_towards(branch.space, marks)[list(wanted.driven)]
        sizes = float(np.linalg.norm(begun) * np.linalg.norm(wanted.turns))
        return round(float(begun @ wanted.turns) / sizes, _DIGITS) if sizes else -1.0
    rates = rates_as_marked(branch, marks)
    return int((np.sign(np.where(np.abs(rates) > DOUBLE.zero_rate, rates, 0.0)) * marks).sum())


def rates_as_marked(branch: Branch, marks: Floats) -> Floats:
    """Return rates near to what is marked, on the part of the space that the branch is."""
    rates = rates_towards(branch.space, marks)
    if rates.any() and same_part(branch.space, rates, branch.rates):
        return rates
    return -branch.rates if branch.rates @ marks < -DOUBLE.zero_rate else branch.rates


def _rates(branch: Branch, wanted: Wanted) -> Floats:
    """Return rates of a branch at which several driven joints begin in the proportions they are to turn in."""
    space = _in_proportion(branch.space, wanted) if len(wanted.driven) > 1 else branch.space
    if len(wanted.driven) < 2 and not wanted.along:
        return rates_as_marked(branch, wanted.marks) if wanted.branch is None else branch.rates
    for start in (wanted.marks, space.basis.sum(axis=1)):
        towards = rates_towards(space, start)
        if np.abs(towards[list(wanted.driven)]).max() > DOUBLE.zero_rate:
            return towards
    which = "joints" if wanted.along else "driven joints"
    raise UnsolvableError(f"the {which} cannot begin to turn in these proportions on this branch")


def _in_proportion(space: RateSpace, wanted: Wanted) -> RateSpace:
    """Return the part of a space in which driven joints turn in proportion."""
    across = null_space(wanted.turns[None])
    normals = space.basis[list(wanted.driven)].T @ across  # of unit vectors: what is small beside 1 is none
    return replace(space, basis=canonical_basis(space.basis @ null_space(normals.T, scale=1.0)))
