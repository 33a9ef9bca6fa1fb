"""Which joints to lock, at a configuration where motions to first order are finite ones.

At a singular configuration, such as a flat sheet, ranks say little of the motion. Advice is given at another then,
on the motion branch that the user names, or that the assignment chooses (`general_configuration`).

Rates of M freedoms are the columns of a matrix with a row for each joint. To lock joints takes as many freedoms as
the rank of their rows, so the sets that take one each are the independent sets of a matroid, the dual of that of
the closure columns (Oxley, Matroid Theory, 2.1). Those of one size, with fewer than M joints or as many, are the
bases of its truncation: there the greedy choice is the cheapest (Edmonds 1971). Theory: docs/theory/advice.md.
"""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from heapq import heappop, heappush
from itertools import count
from math import degrees

import numpy as np

from graphs.convert.duality import SheetMechanism
from graphs.errors import NumericalError, UnsolvableError, numbered
from graphs.mechanism.sheet import Sheet
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.analysis.folding.configuration import SheetConfiguration
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.configuration import Configuration
from synth.analysis.motion.driven_motion import BranchChoice, beginning
from synth.analysis.motion.linkage import Linkage, linkage_of_sheet, moved
from synth.analysis.motion.singular.sampling import finite_rates
from synth.analysis.motion.singular.second_order import rates_at
from synth.analysis.motion.walk.step import Allowance
from synth.analysis.verdict.verdict import flaps_of


@dataclass(frozen=True, slots=True)
class GeneralConfiguration:
    """A linkage at a regular configuration.

    Attributes
    ----------
    linkage : Linkage
        At this configuration.
    rates : float[J, M]
        Orthonormal columns span the rates of its motions.
    branch : int or None
        The motion branch that leads to it; None where the input configuration is regular.
    sheet, mechanism : Sheet or None, SheetMechanism or None
        The placed sheet, and its mechanism.
    rigid : bool
        Whether it is proved that nothing moves from the input configuration, whatever rates there are.
    """

    linkage: Linkage
    rates: Floats
    branch: int | None
    sheet: Sheet | None = None
    mechanism: SheetMechanism | None = None
    rigid: bool = False

    @property
    def freedoms(self) -> int:
        """Finite ones, M."""
        return 0 if self.rigid else int(self.rates.shape[1])

    @property
    def flaps(self) -> tuple[int, ...]:
        """Places of the joints in no loop: of flaps, and of what hangs on them."""
        loose = set(flaps_of(self.linkage.graph))
        return tuple(place for place, joint in enumerate(self.linkage.graph.joints) if joint in loose)

    def __repr__(self) -> str:
        return f"<GeneralConfiguration: {self.freedoms} freedoms of {self.linkage!r}>"


def general_configuration(configuration: Configuration, branch: int | str | None = None) -> GeneralConfiguration:
    """Return a mechanism at a regular configuration near its own, which may be singular.

    The branch is a number or signs; by default the assignment chooses it. Raise `UnsolvableError` if no motion was
    found though that is not proved, or if there are too many joints or none, `NumericalError` if the configuration
    reached is singular too.
    """
    linkage, branches = configuration.linkage, configuration.branches
    if not configuration.joints:
        raise UnsolvableError("there is nothing to advise: no joints between links")
    if branches is None:
        raise UnsolvableError(
            "advice requires the motion branches, and for so large a mechanism not all are looked for"
        )
    sheet = configuration if isinstance(configuration, SheetConfiguration) else None
    here = (None, None) if sheet is None else (sheet.sheet, sheet.mechanism)
    if branches.no_motion == "proved":
        rates = rates_at(configuration.closure, linkage.angles)
        return GeneralConfiguration(linkage, rates, None, here[0], here[1], rigid=True)
    number, _ = beginning(configuration, BranchChoice(branch))
    chosen = branches.branch(number or 0)
    angles, rates = _regular(configuration, linkage.angles if number is None else chosen.sample, chosen.freedoms)
    if number is None:
        return GeneralConfiguration(linkage, rates, None, *here)
    if sheet is None:
        return GeneralConfiguration(moved(linkage, angles), rates, number)
    placed = sheet.at(angles)
    return GeneralConfiguration(linkage_of_sheet(placed, sheet.mechanism), rates, number, placed, sheet.mechanism)


def _regular(configuration: Configuration, angles: Floats, freedoms: int | None) -> tuple[Floats, Floats]:
    """Return a configuration of a branch and the rates there, float[J, M], if they are as many as freedoms.

    Of a linkage that is shaky in all its configurations, such as scissors on a polyhedron, more rates close to
    first order than it moves by; those that close to second order are taken then.
    """
    there = moved(configuration.linkage, angles)
    rates = rates_at(ClosureEquations(there), there.angles)
    if rates.shape[1] == freedoms:
        return angles, rates
    located, finite = finite_rates(configuration.linkage, configuration.closure, angles)
    if finite is not None and finite.shape[1] == freedoms:
        return located, finite
    first = numbered(rates.shape[1], "infinitesimal degree of freedom", "infinitesimal degrees of freedom")
    known = "an unknown number" if freedoms is None else str(freedoms)
    raise NumericalError(
        f"no regular configuration was found: {first} beside {known} of finite motion, "
        f"at fold angles up to {degrees(float(np.abs(angles).max())):.3g}°"
    )


Cost = tuple[float, ...]
"""Weights, the first above all; compared as words are."""


def held(rates: Floats, joints: Collection[int]) -> int:
    """Return how many freedoms a set of joints (rows of the rates) takes when it is locked.

    The columns of the rates, float[J, M], are an orthonormal basis of all motions.
    """
    return len(_greedy(rates, (), sorted(joints), rates.shape[1]))


def cheapest_sets(
    rates: Floats, size: int, costs: Sequence[Cost], allowed: Collection[int], allowance: Allowance | None = None
) -> Iterator[tuple[int, ...]]:
    """Yield all sets of joints of a size that take a freedom each, cheapest first; of equal cost by their places.

    The cheapest is found greedily. Its rivals are parted by the first joint in which they differ from it, and the
    cheapest of each part is found likewise (Lawler, Management Science 18, 1972).

    Parameters
    ----------
    rates : float[J, M]
        Columns span the rates of all motions, orthonormal.
    size : int
        Of each set, M at most.
    costs : sequence of tuple of float
        Of each joint.
    allowed : collection of int
        Joints that may be locked.
    allowance : Allowance, optional
        Work limit of the sets after the first, in joints.

    Examples
    --------
    >>> rates = np.array([[0.6, 0.0], [0.8, 0.0], [0.0, 1.0]])
    >>> list(cheapest_sets(rates, 2, [(2.0,), (1.0,), (1.0,)], range(3)))
    [(1, 2), (0, 2)]
    """
    order = sorted(allowed, key=lambda joint: (costs[joint], joint))
    # the cheapest set of each part, and the part: the sets that hold the joints kept, and none of those left out
    queue: list[tuple[Cost, tuple[int, ...], int, tuple[int, ...], int, frozenset[int]]] = []
    numbers = count()

    def enter(kept: tuple[int, ...], left_out: frozenset[int], allowance: Allowance | None) -> None:
        if len(order) - len(left_out) < size:
            return
        chosen = _greedy(rates, kept, [joint for joint in order if joint not in left_out], size, allowance)
        if len(chosen) == size:
            cost = tuple(map(sum, zip(*(costs[joint] for joint in chosen), strict=True)))
            heappush(queue, (cost, tuple(sorted(chosen)), next(numbers), chosen, len(kept), left_out))

    enter((), frozenset(), None)
    while queue:
        _, joints, _, chosen, kept, left_out = heappop(queue)
        yield joints
        for place in range(kept, size):
            enter(chosen[:place], left_out | {chosen[place]}, allowance)
            if allowance is not None and allowance.left < 0:
                return


def _greedy(
    rates: Floats, kept: tuple[int, ...], order: Sequence[int], size: int, allowance: Allowance | None = None
) -> tuple[int, ...]:
    """Return joints that take a freedom each: those kept, then each in order that adds to them, up to a size.

    There are fewer at the work limit.
    """
    free, chosen = np.array(rates), list[int]()
    for joint in (*kept, *order):
        if len(chosen) == size or (allowance is not None and not allowance.take()):
            break
        left = float(np.linalg.norm(free[joint]))
        if left <= DOUBLE.clear or joint in chosen:  # it holds nothing: play in the others would move it too
            continue
        along = free[joint] / left
        free -= np.outer(free @ along, along)
        chosen.append(joint)
    return tuple(chosen)
