"""Freedoms of a linkage with resting members rigid and active ones released, for each set of active members.

Theory: docs/theory/compliance.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import networkx as nx

from graphs.errors import UnsolvableError, numbered
from graphs.rank.singular_values import spectrum
from graphs.tolerances import DOUBLE
from synth.compliance.members import Members, released
from synth.motion.branches import MOST_JOINTS, Certainty, branches_of, search_for
from synth.motion.closure import ClosureEquations
from synth.motion.linkage import PosedLinkage

__all__ = ["Kind", "State", "state_of", "states_of_sets"]

MOST_MEMBERS = 10
"""Of more members not all sets are looked at: there are a thousand."""
_OF_A_BODY = 6
"""Freedoms of a part that hangs on active links only."""

Kind = Literal["rigid immobile", "rigid mobile", "compliant immobile", "compliant mobile", "not known"]


@dataclass(frozen=True, slots=True)
class State:
    """A linkage with some of its compliant members active, the others at rest.

    Attributes
    ----------
    active : Members
    freedoms : int or None
        Of finite motion, with resting members rigid and active ones released; on the freest way. None where it is
        not known.
    certainty : {"proved", "numerical", "not known"}
        Proved: no rates close to first order, or the equations are independent; or as `synth.motion.branches_of`
        says.

    Examples
    --------
    >>> State(Members((0,)), 1, "proved").kind
    'compliant mobile'
    """

    active: Members
    freedoms: int | None
    certainty: Certainty

    @property
    def kind(self) -> Kind:
        """Rigid while all members are at rest, else compliant; mobile with a freedom or more."""
        if self.freedoms is None:
            return "not known"
        if len(self.active):
            return "compliant mobile" if self.freedoms else "compliant immobile"
        return "rigid mobile" if self.freedoms else "rigid immobile"

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "active": self.active.to_json(),
            "freedoms": self.freedoms,
            "kind": self.kind,
            "certainty": self.certainty,
        }


def state_of(linkage: PosedLinkage, compliant: Members, active: Members) -> State:
    """Return the state of a linkage at its pose with some of its compliant members active.

    The linkage is closed at its pose. Raises `UnsolvableError` if equations depend on each other and there are too
    many joints to search for branches.
    """
    left = released(linkage, compliant, active)
    apart = _OF_A_BODY * (nx.number_connected_components(left.graph) - 1)
    freedoms, certainty = _freedoms(left)
    return State(active, None if freedoms is None else freedoms + apart, certainty)


def states_of_sets(linkage: PosedLinkage, compliant: Members) -> list[State]:
    """Return the state for each set of active members, smaller sets first.

    Raises `UnsolvableError` if there are more than `MOST_MEMBERS`, or as :func:`state_of` does.
    """
    if len(compliant) > MOST_MEMBERS:
        told = numbered(len(compliant), "compliant member")
        raise UnsolvableError(f"{told} have too many sets of active ones: expected {MOST_MEMBERS} at most")
    return [state_of(linkage, compliant, active) for active in compliant.subsets()]


def _freedoms(linkage: PosedLinkage) -> tuple[int | None, Certainty]:
    """Return the finite freedoms from a pose, on the freest way."""
    joints = len(linkage.angles)
    closure = ClosureEquations(linkage)
    rank = spectrum(closure.at(linkage.angles)[1].toarray(), DOUBLE.derivative).rank
    if rank in (joints, closure.rows):
        return joints - rank, "proved"
    if joints > MOST_JOINTS:
        raise UnsolvableError(
            f"the ways to move of {joints} joints are not looked for: expected {MOST_JOINTS} at most"
        )
    found = branches_of(linkage, closure, search_for(joints, None))
    if found.no_motion == "proved":
        return 0, "proved"
    known = [
        branch for branch in found.branches if branch.freedoms is not None and branch.certainty != "not known"
    ]
    if not known:
        return None, "not known"
    freest = max(known, key=lambda branch: branch.freedoms or 0)
    return freest.freedoms, freest.certainty
