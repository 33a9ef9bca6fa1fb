"""Which joints to lock: sets that each take a freedom more, cheapest first.

Rates of M freedoms are the columns of a matrix with a row for each joint. To lock joints takes as many freedoms as
the rank of their rows, so the sets that take one each are the independent sets of a matroid, the dual of that of
the closure columns (Oxley, Matroid Theory, 2.1). Those of one size, with fewer than M joints or as many, are the
bases of its truncation: there the greedy choice is the cheapest (Edmonds 1971). Theory: docs/theory/advice.md.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from heapq import heappop, heappush

import numpy as np

from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.motion.walk.allowance import Allowance

__all__ = ["Cost", "cheapest_sets", "held"]

Cost = tuple[float, ...]
"""Weights, the first above all; compared as words are."""


@dataclass(frozen=True, slots=True)
class _Choices:
    """A part of all sets: those that hold the first joints of one, and not some others."""

    cost: Cost
    chosen: tuple[int, ...]
    kept: tuple[int, ...]
    left_out: frozenset[int]


def held(rates: Floats, joints: Collection[int]) -> int:
    """Return how many freedoms a set of joints (rows of the rates) takes when it is locked.

    The columns of the rates, float[J, M], are an orthonormal basis of all motions.

    >>> rates = np.array([[0.6, 0.0], [0.8, 0.0], [0.0, 1.0]])
    >>> held(rates, (0, 1)), held(rates, (1, 2))
    (1, 2)
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
        Joints that may be looked at for the sets after the first; the sets end where it is used up.

    Examples
    --------
    >>> rates = np.array([[0.6, 0.0], [0.8, 0.0], [0.0, 1.0]])
    >>> list(cheapest_sets(rates, 2, [(2.0,), (1.0,), (1.0,)], range(3)))
    [(1, 2), (0, 2)]
    """
    order = sorted(allowed, key=lambda joint: (costs[joint], joint))
    queue: list[tuple[Cost, tuple[int, ...], int, _Choices]] = []
    made = 0

    def enter(kept: tuple[int, ...], left_out: frozenset[int], allowance: Allowance | None) -> None:
        nonlocal made
        if len(order) - len(left_out) < size:
            return
        chosen = _greedy(rates, kept, [joint for joint in order if joint not in left_out], size, allowance)
        if len(chosen) == size:
            cost = tuple(map(sum, zip(*(costs[joint] for joint in chosen), strict=True)))
            made += 1
            heappush(queue, (cost, tuple(sorted(chosen)), made, _Choices(cost, chosen, kept, left_out)))

    enter((), frozenset(), None)
    while queue:
        _, joints, _, best = heappop(queue)
        yield joints
        for place in range(len(best.kept), size):
            enter(best.chosen[:place], best.left_out | {best.chosen[place]}, allowance)
            if allowance is not None and allowance.left < 0:
                return


def _greedy(
    rates: Floats,
    kept: tuple[int, ...],
    order: Sequence[int],
    size: int,
    allowance: Allowance | None = None,
) -> tuple[int, ...]:
    """Return joints that take a freedom each: those kept, then each in order that adds to them, up to a size.

    Where the allowance is used up on the way there are fewer.
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
