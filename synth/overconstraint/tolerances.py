"""How far axes may err before an idle equation counts. Theory: docs/theory/overconstraint.md.

An error of an axis leaves the loops closed at the pose, and makes what was idle an equation of the rates: its
singular value grows from zero in proportion. Where it reaches the smallest one that counts, the linkage is locked
by it as by any other equation.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import numpy as np

from graphs.geometry import crossing
from graphs.tolerances import DOUBLE, canonical_order
from graphs.types import Floats, JointId
from synth.motion.closure import ClosureEquations
from synth.motion.linkage import PosedLinkage
from synth.overconstraint.idle import FirstOrder, loop_alone

__all__ = ["Tolerance", "axis_tolerances"]

_NUDGE = 1e-4


@dataclass(frozen=True, slots=True)
class Tolerance:
    """Errors of one joint axis at which a freedom is as good as gone.

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


def axis_tolerances(linkage: PosedLinkage, order: FirstOrder) -> list[Tolerance]:
    """Return how far each axis may err, least first; axes that may err alike in the order of the joints.

    >>> from synth.moving.made import configuration_of
    >>> from synth.overconstraint.idle import first_order
    >>> from synth.patterns import generate
    >>> linkage = configuration_of(generate("bennett").mechanism).linkage
    >>> len(axis_tolerances(linkage, first_order(linkage)))
    4
    """
    growth = growths(linkage, order)
    found = []
    for place, joint in enumerate(linkage.graph.joints):
        axis, point = linkage.directions[place], linkage.points[place]
        across = np.eye(3) - np.outer(axis, axis)
        turned, shifted = growth[:, 6 * place : 6 * place + 3], growth[:, 6 * place + 3 : 6 * place + 6]
        about_itself = (turned + shifted @ crossing(point)) @ across
        found.append(
            Tolerance(
                joint,
                _allowed(order.smallest, about_itself),
                _allowed(order.smallest, shifted @ across) * linkage.extent,
            )
        )
    least = np.array([[min(one.turn, one.shift / linkage.extent)] for one in found]).reshape(-1, 1)
    return [found[place] for place in canonical_order(list(np.log(np.clip(least, 1e-300, 1e300))))]


def growths(linkage: PosedLinkage, order: FirstOrder) -> Floats:
    """Return what idle equations say of the rates for small motions of the axes: float[idle f, 6 J].

    By a rotation about the origin and a shift of each axis in turn; f rates.
    """
    stresses, rates = order.stresses, order.rates
    found = []
    for k in range(rates.shape[1]):
        ahead, back = (
            np.vstack(
                [ClosureEquations(loop_alone(linkage, loop)).by_axes(angles).toarray() for loop in linkage.loops]
            )
            for angles in (linkage.angles + way * _NUDGE * rates[:, k] for way in (1.0, -1.0))
        )
        found.append(stresses.T @ (ahead - back) / (2 * _NUDGE))
    return np.vstack([np.zeros((0, 6 * len(linkage.angles))), *found])


def _allowed(smallest: float, growth: Floats) -> float:
    """Return the error that makes the singular value grow to the smallest that counts."""
    largest = float(np.linalg.norm(growth, 2)) if growth.size else 0.0
    return smallest / largest if largest > DOUBLE.zero_rate else inf  # else it does no harm to first order
