"""How a linkage may begin to move, as the page lets one choose: found in Python, followed in the page.

Theory: docs/theory/viewer.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from graphs.tolerances import DOUBLE, leading
from graphs.types import Floats, Ints
from synth.motion.beginning import Wanted, beginning
from synth.motion.branches import Branch
from synth.motion.closure import ClosureEquations
from synth.motion.configuration import Configuration
from synth.motion.linkage import PosedLinkage
from synth.motion.singular.sampling import walked
from synth.motion.walk.freedoms import free_rates, independent_joints

__all__ = ["Ways", "ways_of"]

_NEAREST = "near to the marks"
_MOST_DRIVERS = 40
"""Joints with a slider of their own, at most; others can be dragged."""


@dataclass(frozen=True, slots=True)
class Beginning:
    """One start of a motion, and its name, `told`.

    `rates`, float[J], are those at the configuration, the largest 1 or -1. `drivers` are the indices of the
    driven joints, one for each degree of freedom, the fastest first; `still` are those of the joints that do not
    move on it. `freedoms` is None if unknown.
    """

    told: str
    rates: Floats
    drivers: tuple[int, ...]
    still: tuple[int, ...] = ()
    freedoms: int | None = None

    def to_json(self) -> dict[str, Any]:
        """Return plain data: `WayData` of web/src/page/types.js."""
        return {
            "told": self.told,
            "rates": self.rates.tolist(),
            "drivers": list(self.drivers),
            "still": list(self.still),
            "freedoms": self.freedoms,
        }


@dataclass(frozen=True, slots=True)
class Ways:
    """All starts of a motion to choose from; `taken` is the index of the first choice.

    `singular`: the configuration has to be left at the rates of one of them; else the least rates do.
    """

    all: tuple[Beginning, ...]
    singular: bool
    taken: int

    def to_json(self) -> dict[str, Any]:
        """Return plain data: `WaysData` of web/src/page/types.js."""
        return {"all": [one.to_json() for one in self.all], "singular": self.singular, "taken": self.taken}


def ways_of(configuration: Configuration) -> Ways:
    """Return the ways in which a mechanism with joints can start to move.

    Raise UnsolvableError if no motion starts there, or none was found.

    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.folding.configuration import configuration_of_sheet
    >>> corners = ((0, 0), (1, 0), (.5, 1), (-1, 0), (.5, -1))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> ways = ways_of(configuration_of_sheet(Sheet(5, (), "", faces, corners)))
    >>> [one.told for one in ways.all], ways.singular
    (['way 0: 1 freedom, proved', 'way 1: 1 freedom, proved'], True)
    """
    linkage, closure, found = configuration.linkage, configuration.closure, configuration.branches
    number, rates = beginning(configuration, Wanted())
    rates = rates / np.abs(rates).max()
    if found is None:
        return Ways((_nearest(linkage, closure, rates),), singular=True, taken=0)
    if number is None:
        return Ways((_beginning(0, found.branches[0], rates, closure),), singular=False, taken=0)
    every = [
        _beginning(place, branch, rates if place == number else branch.rates, closure)
        for place, branch in enumerate(found.branches)
    ]
    return Ways(tuple(every), singular=True, taken=number)


def _nearest(linkage: PosedLinkage, closure: ClosureEquations, rates: Floats) -> Beginning:
    """Return the one way of a linkage whose branches are not looked for."""
    first, end = leading(rates), walked(linkage.angles, closure, rates)[0]
    moving = np.flatnonzero(np.maximum(np.abs(rates), np.abs(end - linkage.angles)) > DOUBLE.immobile)
    freedoms, drivers = _driven(closure, end, moving, first)
    return Beginning(_NEAREST, rates, drivers, freedoms=freedoms)


def _beginning(number: int, branch: Branch, rates: Floats, closure: ClosureEquations) -> Beginning:
    freedoms, first = branch.freedoms, leading(rates)
    told = "freedoms not known" if freedoms is None else f"{freedoms} freedom{'s' * (freedoms != 1)}"
    moving = np.setdiff1d(np.arange(len(rates)), np.array(branch.still, dtype=np.int64))
    # rates that close to first order may be more than the freedoms, which are those to second order
    drivers = (first,) if not freedoms else _driven(closure, branch.sample, moving, first)[1][:freedoms]
    return Beginning(f"way {number}: {told}, {branch.certainty}", rates, drivers, branch.still, freedoms)


def _driven(
    closure: ClosureEquations, angles: Floats, moving: Ints, first: int
) -> tuple[int | None, tuple[int, ...]]:
    """Return how many freedoms a pose has, and the places of joints that drive it: one for each, not too many."""
    basis = free_rates(closure, angles, moving)
    if basis is None or first not in moving:
        return None, (first,)
    rows = independent_joints(basis, int(np.searchsorted(moving, first)))
    return basis.shape[1], tuple(int(moving[row]) for row in rows[:_MOST_DRIVERS])
