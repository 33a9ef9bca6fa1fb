"""Whether a member moves: followed by a finite motion, with the freedoms asked for, all joints turning.

Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from graphs.arrays import Floats
from graphs.errors import SynthedraError, numbered
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.tolerances import DOUBLE
from synth.motion.branches import Branch, first_branch, search_for
from synth.motion.configuration import Configuration
from synth.motion.placement import moved
from synth.moving.made import configuration_of
from synth.overconstraint.explanation import explain

__all__ = ["Moving", "judged"]


@dataclass(frozen=True)
class Moving:
    """A member that moves: its configuration, the number of its branch, and what is special there.

    `h` is the number of redundant closure equations on the branch, ten degrees from where it begins; `reasons` are
    those that were recognised there.
    """

    configuration: Configuration
    number: int
    h: int
    reasons: tuple[str, ...]

    @property
    def branch(self) -> Branch:
        """The branch that it moves on."""
        found = self.configuration.branch(self.number)
        assert found is not None
        return found


_SHARE = 0.02
"""A joint that turns by less than this part of the largest turn hardly moves."""


def judged(member: Sheet | HingedSolids, freedoms: int, *, all_joints: bool = True) -> Moving | str:
    """Return how a member moves, or why it does not do.

    Branches count that were followed by a finite motion and have the freedoms there; of those the first on which
    all joints turn is taken.

    >>> from synth.patterns import generate
    >>> judged(generate("bennett").mechanism, 1).reasons[0]
    'opposite links equal, lengths proportional to the sines of the twists (Bennett)'
    """
    try:
        at = configuration_of(member, mend=False)  # coordinates are exact
        search = search_for(len(at.joints), None)
        if all_joints and first_branch(at.linkage, _turns_all, search) is None:
            return "no motion of all joints"  # without a proof that nothing moves, which would take long
        found = at.branches
        if found is None:
            return "too large to look for all branches"
        moving = [place for place, one in enumerate(found.branches) if one.certainty != "not known"]
        if not moving:
            return "nothing moves"
        whole = [place for place in moving if not (all_joints and found.branches[place].still)]
        if not whole:
            return "some joints do not move"
        whole = [one for one in whole if not all_joints or _least_share(at, found.branches[one]) >= _SHARE]
        if not whole:
            return "some joints hardly move"
        fitting = [place for place in whole if found.branches[place].freedoms == freedoms]
        if not fitting:
            least = min((found.branches[place].freedoms or 0 for place in whole), default=0)
            return f"moves with {numbered(least, 'freedom')}"
        return _explained(at, fitting)
    except SynthedraError as error:
        return str(error)


def _turns_all(rates: Floats) -> bool:
    return bool(np.abs(rates).min(initial=1.0) > DOUBLE.zero_rate)


def _least_share(at: Configuration, branch: Branch) -> float:
    """Return the least turn of a joint where the branch was followed to, as a part of the largest."""
    turned = np.abs(branch.sample - at.linkage.angles)
    return float(turned.min(initial=np.inf) / turned.max(initial=0.0))


def _explained(at: Configuration, fitting: Sequence[int]) -> Moving:
    number = fitting[0]
    found = at.branch(number)
    assert found is not None
    explanation = explain(moved(at.linkage, found.sample))
    reasons = dict.fromkeys(reason for one in explanation.sets for reason in one.reasons)
    return Moving(at, number, explanation.idle, tuple(reasons))
