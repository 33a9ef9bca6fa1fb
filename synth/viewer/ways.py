"""How a linkage may begin to move, as the page lets one choose: found in Python, followed in the page.

Theory: docs/theory/viewer.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from graphs.arrays import Floats
from synth.folding.beginning import MOST_JOINTS, Wanted, beginning, search_for
from synth.folding.branches import Branch, Branches, branches_of
from synth.folding.closure import ClosureEquations
from synth.folding.linkage import PosedLinkage
from synth.folding.prepared import Prepared

__all__ = ["Ways", "ways_of_linkage", "ways_of_pattern"]

_NEAREST = "near to the marks"


@dataclass(frozen=True, slots=True)
class Beginning:
    """One way to begin.

    Attributes
    ----------
    told : str
        What it is called.
    rates : float[J]
        At the pose; the largest is 1 or -1.
    still : tuple of int
        Places of the joints that do not move on it.
    """

    told: str
    rates: Floats
    still: tuple[int, ...] = ()

    def to_json(self) -> dict[str, Any]:
        """Return plain data; `driver` is the joint that begins fastest."""
        return {
            "told": self.told,
            "rates": self.rates.tolist(),
            "still": list(self.still),
            "driver": int(np.abs(self.rates).argmax()),
        }


@dataclass(frozen=True, slots=True)
class Ways:
    """All ways that can be chosen.

    Attributes
    ----------
    all : tuple of Beginning
    singular : bool
        Whether the pose has to be left at the rates of one of them; else the least rates do.
    taken : int
        The one that is taken first.
    """

    all: tuple[Beginning, ...]
    singular: bool
    taken: int

    def to_json(self) -> dict[str, Any]:
        """Return plain data: `WaysData` of web/src/page/types.js."""
        return {"all": [one.to_json() for one in self.all], "singular": self.singular, "taken": self.taken}


def ways_of_pattern(pattern: Prepared) -> Ways:
    """Return the ways in which a crease pattern can begin to fold.

    Parameters
    ----------
    pattern : Prepared
        With creases.

    Raises
    ------
    UnsolvableError
        If no motion begins at its pose, or none was found.

    Examples
    --------
    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.folding.prepared import prepared
    >>> corners = ((0, 0), (1, 0), (.5, 1), (-1, 0), (.5, -1))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> ways = ways_of_pattern(prepared(Sheet(5, (), "", faces, corners)))
    >>> [one.told for one in ways.all], ways.singular
    (['way 0: 1 freedom, proved', 'way 1: 1 freedom, proved'], True)
    """
    marks = pattern.wanted
    return _ways(
        pattern.linkage, pattern.closure, pattern.branches, Wanted(None, marks, [], np.zeros(0), pattern.doubt)
    )


def ways_of_linkage(linkage: PosedLinkage) -> Ways:
    """Return the ways in which any linkage can begin to move from its pose.

    Parameters
    ----------
    linkage : PosedLinkage
        Closed at its pose, with joints.

    Raises
    ------
    UnsolvableError
        If no motion begins at its pose, or none was found.

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> from synth.folding.linkage import linkage_of_axes
    >>> hinge = linkage_of_axes(SCGraph(2, [(0, 1)]), {0: ((0, 0, 0), (0, 0, 1))})
    >>> ways_of_linkage(hinge).singular
    False
    """
    closure = ClosureEquations(linkage)
    joints = len(linkage.angles)
    found = branches_of(linkage, closure, search_for(joints, None)) if joints <= MOST_JOINTS else None
    return _ways(linkage, closure, found, Wanted(None, np.ones(joints), [], np.zeros(0)))


def _ways(linkage: PosedLinkage, closure: ClosureEquations, found: Branches | None, wanted: Wanted) -> Ways:
    number, rates = beginning(closure, linkage, found, wanted)
    rates = rates / np.abs(rates).max()
    if found is None:
        return Ways((Beginning(_NEAREST, rates),), singular=True, taken=0)
    if number is None:
        return Ways((_beginning(0, found.branches[0], rates),), singular=False, taken=0)
    every = [
        _beginning(place, branch, rates if place == number else branch.rates)
        for place, branch in enumerate(found.branches)
    ]
    return Ways(tuple(every), singular=True, taken=number)


def _beginning(number: int, branch: Branch, rates: Floats) -> Beginning:
    freedoms = branch.freedoms
    told = "freedoms not known" if freedoms is None else f"{freedoms} freedom{'s' * (freedoms != 1)}"
    return Beginning(f"way {number}: {told}, {branch.certainty}", rates, branch.still)
