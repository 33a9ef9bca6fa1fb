"""Redundant closure equations: the smallest sets of loops that hold them, second order, errors of axes.

A redundant equation is a self-stress: a sum of closure equations that is zero at all joint rates. Theory:
docs/theory/overconstraint.md.
"""

from dataclasses import dataclass, replace
from math import inf

import numpy as np

from graphs.errors import NumericalError
from graphs.geometry import crossing
from graphs.loops.loop import Centre
from graphs.rank.singular_values import row_space, singular_values, spectrum, split
from graphs.tolerances import DOUBLE, Tolerances, canonical_basis, canonical_order
from graphs.types import Floats, Ints, JointId
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.linkage import Linkage, LinkageLoop, axis_lengths

_NUDGE = 1e-4


@dataclass(frozen=True, slots=True)
class FirstOrderClosure:
    """Closure equations at a pose.

    `matrix`, float[rows, J], are the derivatives, the loops of the linkage one after the other, int[rows] in
    `loop_of`. Orthonormal columns: `rates`, float[J, f], all motions of first order, and `stresses`, float[rows,
    idle], sums of equations that are zero. `smallest` is the smallest singular value that counts, `gap` its ratio
    to the largest that does not, infinite where there is none; the rank was decided by `tolerances`.
    """

    matrix: Floats
    loop_of: Ints
    rates: Floats
    stresses: Floats
    smallest: float
    gap: float
    tolerances: Tolerances


def first_order_closure(linkage: Linkage, tolerances: Tolerances = DOUBLE) -> FirstOrderClosure:
    """Return the closure equations of a linkage with their rank; `NumericalError` if that is undecided."""
    matrix, loop_of = _by_loops(linkage, linkage.angles)
    ranked = spectrum(matrix, np.maximum(tolerances.derivative, 2.0 * tolerances.precision / axis_lengths(linkage)))
    if ranked.rank is None:
        raise NumericalError("the rank of the closure equations at this configuration is unclear")
    parts = split(matrix)
    smallest = float(parts.values[ranked.rank - 1]) if ranked.rank else 0.0
    rates, stresses = canonical_basis(parts.right[ranked.rank :].T), canonical_basis(parts.left[:, ranked.rank :])
    return FirstOrderClosure(matrix, loop_of, rates, stresses, smallest, ranked.gap, tolerances)


def smallest_sets(linkage: Linkage, order: FirstOrderClosure) -> list[tuple[tuple[int, ...], int]]:
    """Return sets of loops, none larger than necessary, that hold redundant equations, and how many are in each.

    A set is grown from a loop, nearest loops first, until it holds a redundant equation that no earlier set does;
    then loops without which it still does are left out, farthest first.
    """
    total = order.stresses.shape[1]
    nearest = _nearest_first(linkage)
    sets: list[tuple[tuple[int, ...], int]] = []
    known = np.zeros((len(order.loop_of), 0))
    for size in range(1, len(linkage.loops) + 1):
        for seed in range(len(linkage.loops)):
            if known.shape[1] == total:
                return sets
            chosen = nearest[seed][:size]
            while (new := _new_stresses(order, chosen, known)).shape[1]:
                for loop in chosen[::-1]:  # farthest first: the near ones are more likely to be the cause
                    fewer = [other for other in chosen if other != loop]
                    if fewer and (left := _new_stresses(order, fewer, known)).shape[1]:
                        chosen, new = fewer, left
                sets.append((tuple(sorted(chosen)), new.shape[1]))
                known = np.hstack([known, new])
                chosen = nearest[seed][:size]
    return sets


def active_at_second_order(linkage: Linkage, order: FirstOrderClosure) -> int:
    """Return how many redundant equations constrain the motions at second order, and so are not redundant there.

    Each self-stress makes a quadratic form of the rates; as many are active as forms are independent.
    """
    rates, stresses = order.rates, order.stresses
    forms = []
    for rate in rates.T:
        ahead, back = (_by_loops(linkage, linkage.angles + sign * _NUDGE * rate)[0] for sign in (1.0, -1.0))
        forms.append(stresses.T @ (ahead - back) / (2 * _NUDGE) @ rates)
    if not forms or not stresses.shape[1]:
        return 0
    stacked = np.stack(forms, axis=1)  # [idle, f, f]
    symmetric = (stacked + stacked.transpose(0, 2, 1)).reshape(stresses.shape[1], -1)
    return int((singular_values(symmetric) > order.tolerances.clear).sum())  # of unit rates and stresses


def loop_alone(linkage: Linkage, loop: LinkageLoop) -> Linkage:
    """Return a linkage of which only one loop has to close."""
    return replace(linkage, loops=(loop,))


def _by_loops(linkage: Linkage, angles: Floats) -> tuple[Floats, Ints]:
    """Return the derivatives of closure equations, loop after loop, and the loop of each row."""
    rows, loop_of = [np.zeros((0, len(angles)))], []
    for number, loop in enumerate(linkage.loops):
        rows.append(ClosureEquations(loop_alone(linkage, loop)).at(angles)[1].toarray())
        loop_of += [number] * (6 if loop.centre is Centre.NONE else 3)
    return np.vstack(rows), np.array(loop_of, dtype=np.int64)


def _nearest_first(linkage: Linkage) -> list[list[int]]:
    """Return, for each loop, all loops in the order of their distance from it, by joints in common."""
    joints = [set(loop.joints) for loop in linkage.loops]
    orders = []
    for seed in range(len(joints)):
        order, seen = [seed], {seed}
        for loop in order:
            near = [other for other in range(len(joints)) if other not in seen and joints[loop] & joints[other]]
            near.sort(key=lambda other: (-sum(bool(joints[other] & joints[k]) for k in order), other))
            order += near
            seen.update(near)
        orders.append(order + [other for other in range(len(joints)) if other not in seen])
    return orders


def _new_stresses(order: FirstOrderClosure, loops: list[int], known: Floats) -> Floats:
    """Return self-stresses of some loops alone that are independent of known ones: float[rows, n]."""
    inside = np.isin(order.loop_of, loops)
    part = order.matrix[inside]
    alone = split(part, order.tolerances.zero).cokernel
    stresses = np.zeros((len(order.loop_of), alone.shape[1]))
    stresses[inside] = alone
    return row_space((stresses - known @ (known.T @ stresses)).T, order.tolerances.zero**0.5, scale=1.0)


@dataclass(frozen=True, slots=True)
class Tolerance:
    """Errors of one joint axis at which a redundant equation constrains as much as the weakest independent one.

    Attributes
    ----------
    joint : joint id
    turn : float
        Of its direction, about its own point, the worst way: radians; infinite if it does no harm to first order.
    shift : float
        Across itself, the worst way, in the unit of the coordinates.
    """

    joint: JointId
    turn: float
    shift: float


def axis_tolerances(linkage: Linkage, order: FirstOrderClosure) -> list[Tolerance]:
    """Return how far each axis may err, least first; axes that may err alike in the order of the joints.

    An error of an axis leaves the loops closed at the configuration, and makes a redundant equation one of the rates:
    its singular value grows from zero in proportion. Where it reaches the smallest that counts, the linkage is locked.
    """
    growth = growths(linkage, order)
    tolerances = []
    for place, joint in enumerate(linkage.graph.joints):
        axis, point = linkage.directions[place], linkage.points[place]
        across = np.eye(3) - np.outer(axis, axis)
        turned, shifted = growth[:, 6 * place : 6 * place + 3], growth[:, 6 * place + 3 : 6 * place + 6]
        about_itself = (turned + shifted @ crossing(point)) @ across
        turn, shift = (_allowed(order.smallest, error) for error in (about_itself, shifted @ across))
        tolerances.append(Tolerance(joint, turn, shift * linkage.extent))
    least = np.array([[min(axis.turn, axis.shift / linkage.extent)] for axis in tolerances]).reshape(-1, 1)
    return [tolerances[place] for place in canonical_order(list(np.log(np.clip(least, 1e-300, 1e300))))]


def growths(linkage: Linkage, order: FirstOrderClosure) -> Floats:
    """Return what redundant equations say of the f rates for small motions of the axes: float[idle f, 6 J].

    By a rotation about the origin and a shift of each axis in turn.
    """
    loops = [ClosureEquations(loop_alone(linkage, loop)) for loop in linkage.loops]
    growth = [np.zeros((0, 6 * len(linkage.angles)))]
    for rates in order.rates.T:
        ahead, back = (
            np.vstack([loop.by_axes(linkage.angles + sign * _NUDGE * rates).toarray() for loop in loops])
            for sign in (1.0, -1.0)
        )
        growth.append(order.stresses.T @ (ahead - back) / (2 * _NUDGE))
    return np.vstack(growth)


def _allowed(smallest: float, growth: Floats) -> float:
    """Return the error that makes the singular value grow to the smallest that counts."""
    largest = float(np.linalg.norm(growth, 2)) if growth.size else 0.0
    return smallest / largest if largest > DOUBLE.zero_rate else inf  # else it does no harm to first order
