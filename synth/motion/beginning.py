"""Which way a folding begins: the branch that is asked for, or that marks of creases choose, and rates on it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from graphs.edit.named import known
from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.rank.singular_values import null_space
from graphs.tolerances import DOUBLE, canonical_basis
from graphs.types import Floats
from synth.motion.branches import MOST_JOINTS, Branch, Branches
from synth.motion.configuration import Configuration
from synth.motion.marked import marked_rates, rates_as_marked
from synth.motion.second_order import RateSpace
from synth.motion.singular.nearest import begun_near
from synth.motion.singular.sampling import rates_towards

__all__ = ["Wanted", "beginning"]

_LARGE = 10**9
_STARTS = 8
"""Of the search for rates with all marks at which several joints are driven."""
_DIGITS = 6
"""Of a cosine: branches that point along rates alike are told apart by their order."""


@dataclass(frozen=True, slots=True)
class Wanted:
    """The options for the beginning of a motion.

    The branch is given by its number or signs; by default the configuration chooses it. `turns` says how far each
    driven joint (by its place) is to turn, radians; with `along` they are rates, and the branch that points along
    them best is taken.
    """

    branch: int | str | None = None
    driven: Sequence[int] = ()
    turns: Floats = field(default_factory=lambda: np.zeros(0))
    along: bool = False

    def towards(self, configuration: Configuration) -> Floats:
        """Return the rates that are wanted, float[J]: those given, or as joints are assigned."""
        if not self.along:
            return configuration.wanted
        rates = np.zeros(len(configuration.joints))
        rates[list(self.driven)] = self.turns
        return rates


def beginning(configuration: Configuration, wanted: Wanted) -> tuple[int | None, Floats]:
    """Return the branch to take, None where there is no choice, and rates on it, near to what is assigned.

    Raises `UnsolvableError` if no motion begins there, or none with the driven joints, `InvariantError` if there
    is no such branch.
    """
    found, towards = configuration.branches, wanted.towards(configuration)
    if found is None or (configuration.one_way and wanted.branch is None):
        if wanted.branch is not None:
            raise UnsolvableError(
                f"branches of more than {MOST_JOINTS} joints are not looked for, nor of large sheets with many "
                "vertices of more than four creases"
            )
        near = (
            begun_near(configuration.closure, configuration.linkage, towards).rates
            if wanted.along
            else configuration.begun.rates
        )
        if near is None:
            raise UnsolvableError(
                f"no motion near the given assignment was found at this configuration{configuration.doubt}"
            )
        return None, near
    if not found.branches:
        written = "exactly as written, " if configuration.nearly else ""
        raise UnsolvableError(f"{written}{_no_motion(found)}{configuration.doubt}")
    number = _chosen(configuration, found, wanted)
    marked = configuration.marked.rates
    if marked is not None and wanted.branch is None and len(wanted.driven) < 2 and not wanted.along:
        return None if found.regular else number, marked
    rates = _rates(found.branches[number], wanted, towards, configuration.marks)
    return None if found.regular else number, rates


def _no_motion(found: Branches) -> str:
    """Return that nothing moves from here, with the proof if there is one."""
    proofs = {
        "no rates": "no rates close the loops to first order",
        "definite stress": "a self-stress is definite on all flexes",
        "cases": "no rates agree to second order",
    }
    proof = found.rigidity.proof if found.rigidity is not None else None
    if proof:
        return f"no motion begins at this configuration (proved: {proofs[proof]})"
    return "no motion was found at this configuration"


def _chosen(configuration: Configuration, found: Branches, wanted: Wanted) -> int:
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
    if not wanted.along:
        return configuration.chosen or 0
    towards = wanted.towards(configuration)
    return max(range(len(every)), key=lambda number: (_cosine(every[number], wanted, towards), -number))


def _cosine(branch: Branch, wanted: Wanted, towards: Floats) -> float:
    """Return the cosine between wanted rates and the nearest ones of a branch, of the joints that have any."""
    begun = rates_towards(branch.space, towards)[list(wanted.driven)]
    sizes = float(np.linalg.norm(begun) * np.linalg.norm(wanted.turns))
    return round(float(begun @ wanted.turns) / sizes, _DIGITS) if sizes else -1.0


def _rates(branch: Branch, wanted: Wanted, towards: Floats, marks: Floats) -> Floats:
    """Return rates of a branch at which several driven joints begin in the proportions they are to turn in.

    With all marks, if there are such.
    """
    space = _in_proportion(branch.space, wanted) if len(wanted.driven) > 1 else branch.space
    if len(wanted.driven) < 2 and not wanted.along:
        return rates_as_marked(branch, towards) if wanted.branch is None else branch.rates
    assigned = marked_rates(space, marks, _STARTS) if marks.any() and not wanted.along else []
    for begun in assigned:
        if np.abs(begun[list(wanted.driven)]).max() > DOUBLE.zero_rate:
            return np.asarray(begun / np.abs(begun).max())
    for start in (towards, space.basis.sum(axis=1)):
        begun = rates_towards(space, start)
        if np.abs(begun[list(wanted.driven)]).max() > DOUBLE.zero_rate:
            return begun
    which = "joints" if wanted.along else "driven joints"
    raise UnsolvableError(f"the {which} cannot begin to turn in these proportions on this branch")


def _in_proportion(space: RateSpace, wanted: Wanted) -> RateSpace:
    """Return the part of a space in which driven joints turn in proportion."""
    across = null_space(wanted.turns[None])
    normals = space.basis[list(wanted.driven)].T @ across  # of unit vectors: what is small beside 1 is none
    return replace(space, basis=canonical_basis(space.basis @ null_space(normals.T, scale=1.0)))
