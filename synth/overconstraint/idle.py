"""Which loops hold an equation that follows from others: smallest sets of loops, and what second order asks.

An idle equation is a self-stress, a sum of closure equations that is zero at the pose whatever joints do. Theory:
docs/theory/overconstraint.md.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from graphs.errors import NumericalError
from graphs.loops.loop import Centre
from graphs.rank.singular_values import row_space, singular_values, spectrum, split
from graphs.tolerances import DOUBLE, Tolerances, canonical_basis
from graphs.types import Floats, Ints
from synth.motion.closure import ClosureEquations
from synth.motion.linkage import PosedLinkage, PosedLoop, axis_lengths

__all__ = ["FirstOrder", "active_at_second_order", "first_order", "loop_alone", "smallest_sets"]

_NUDGE = 1e-4


@dataclass(frozen=True, slots=True)
class FirstOrder:
    """Closure equations at a pose.

    Attributes
    ----------
    matrix : float[rows, J]
        Derivatives, the loops of the linkage one after the other.
    loop_of : int[rows]
    rates : float[J, f]
        Orthonormal: all motions of first order.
    stresses : float[rows, idle]
        Orthonormal: sums of equations that are zero.
    smallest : float
        The smallest singular value that counts.
    gap : float
        It over the largest that does not; infinite where there is none.
    tolerances : Tolerances
        By which the rank was told.
    """

    matrix: Floats
    loop_of: Ints
    rates: Floats
    stresses: Floats
    smallest: float
    gap: float
    tolerances: Tolerances


def first_order(linkage: PosedLinkage, tolerances: Tolerances = DOUBLE) -> FirstOrder:
    """Return the closure equations at the pose of a linkage, with their rank.

    Parameters
    ----------
    linkage : PosedLinkage
    tolerances : Tolerances, optional
        Of its coordinates.

    Raises
    ------
    NumericalError
        If singular values do not tell the rank.

    Examples
    --------
    >>> from synth.moving.made import configuration_of
    >>> from synth.patterns import generate
    >>> found = first_order(configuration_of(generate("bennett").mechanism).linkage)
    >>> found.rates.shape[1], found.stresses.shape[1]
    (1, 3)
    """
    matrix, loop_of = _by_loops(linkage, linkage.angles)
    found = spectrum(matrix, np.maximum(tolerances.derivative, 2.0 * tolerances.precision / axis_lengths(linkage)))
    if found.rank is None:
        raise NumericalError("the rank of the closure equations at this configuration is unclear")
    parts = split(matrix)
    smallest = float(parts.values[found.rank - 1]) if found.rank else 0.0
    rates, stresses = canonical_basis(parts.right[found.rank :].T), canonical_basis(parts.left[:, found.rank :])
    return FirstOrder(matrix, loop_of, rates, stresses, smallest, found.gap, tolerances)


def smallest_sets(linkage: PosedLinkage, order: FirstOrder) -> list[tuple[tuple[int, ...], int]]:
    """Return sets of loops, none larger than it must be, whose equations are idle, and how many are in each.

    A set is grown from a loop, nearest loops first, until it holds an idle equation that no earlier set does; then
    loops without which it still does are left out, farthest first.
    """
    wanted = order.stresses.shape[1]
    nearest = _nearest_first(linkage)
    sets: list[tuple[tuple[int, ...], int]] = []
    known = np.zeros((len(order.loop_of), 0))
    for size in range(1, len(linkage.loops) + 1):
        for seed in range(len(linkage.loops)):
            if known.shape[1] == wanted:
                return sets
            chosen = nearest[seed][:size]
            while (new := _new_stresses(order, chosen, known)).shape[1]:
                for loop in chosen[::-1]:
                    fewer = [one for one in chosen if one != loop]
                    if fewer and (left := _new_stresses(order, fewer, known)).shape[1]:
                        chosen, new = fewer, left
                sets.append((tuple(sorted(chosen)), new.shape[1]))
                known = np.hstack([known, new])
                chosen = nearest[seed][:size]
    return sets


def active_at_second_order(linkage: PosedLinkage, order: FirstOrder) -> int:
    """Return how many idle equations ask something of the motions at second order, and so are not idle there.

    Each self-stress makes a quadratic form of the rates; as many are active as forms are independent.
    """
    rates, stresses = order.rates, order.stresses
    forms = []
    for k in range(rates.shape[1]):
        ahead, back = (_by_loops(linkage, linkage.angles + way * _NUDGE * rates[:, k])[0] for way in (1.0, -1.0))
        forms.append(stresses.T @ (ahead - back) / (2 * _NUDGE) @ rates)
    if not forms or not stresses.shape[1]:
        return 0
    stacked = np.stack(forms, axis=1)  # [idle, f, f]
    symmetric = (stacked + stacked.transpose(0, 2, 1)).reshape(stresses.shape[1], -1)
    return int((singular_values(symmetric) > order.tolerances.clear).sum())  # of unit rates and stresses


def loop_alone(linkage: PosedLinkage, loop: PosedLoop) -> PosedLinkage:
    """Return a linkage of which only one loop has to close."""
    return replace(linkage, loops=(loop,))


def _by_loops(linkage: PosedLinkage, angles: Floats) -> tuple[Floats, Ints]:
    """Return the derivatives of closure equations, loop after loop, and the loop of each row."""
    rows, loop_of = [np.zeros((0, len(angles)))], []
    for number, loop in enumerate(linkage.loops):
        rows.append(ClosureEquations(loop_alone(linkage, loop)).at(angles)[1].toarray())
        loop_of += [number] * (6 if loop.centre is Centre.NONE else 3)
    return np.vstack(rows), np.array(loop_of, dtype=np.int64)


def _nearest_first(linkage: PosedLinkage) -> list[list[int]]:
    """Return, for each loop, all loops in the order of their distance from it, by joints in common."""
    joints = [set(loop.joints) for loop in linkage.loops]
    orders = []
    for seed in range(len(joints)):
        order, seen = [seed], {seed}
        for one in order:
            near = [other for other in range(len(joints)) if other not in seen and joints[one] & joints[other]]
            near.sort(key=lambda other: (-sum(bool(joints[other] & joints[k]) for k in order), other))
            order += near
            seen.update(near)
        orders.append(order + [other for other in range(len(joints)) if other not in seen])
    return orders


def _new_stresses(order: FirstOrder, loops: list[int], known: Floats) -> Floats:
    """Return self-stresses of some loops alone that are independent of known ones: float[rows, n]."""
    inside = np.isin(order.loop_of, loops)
    part = order.matrix[inside]
    alone = split(part, order.tolerances.zero).cokernel
    found = np.zeros((len(order.loop_of), alone.shape[1]))
    found[inside] = alone
    return row_space((found - known @ (known.T @ found)).T, order.tolerances.zero**0.5, scale=1.0)
