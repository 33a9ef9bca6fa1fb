"""Why a mechanism moves although counts say no. Theory: docs/theory/overconstraint.md."""

from __future__ import annotations

from graphs.convert.table import Mechanism
from graphs.errors import check_argument
from graphs.tolerances import Tolerances
from synth.motion.linkage import PosedLinkage
from synth.moving.made import Movable, configuration_of
from synth.overconstraint.answer import Explanation, IdleSet
from synth.overconstraint.idle import active_at_second_order, first_order, smallest_sets
from synth.overconstraint.reasons import reasons_of
from synth.overconstraint.tolerances import axis_tolerances
from synth.overconstraint.turning import turning_reasons

__all__ = ["explain"]


def explain(thing: Mechanism | PosedLinkage, *, precision: float | None = None) -> Explanation:
    """Say which loops of a mechanism at its pose hold idle equations, why, and how far its axes may err.

    Parameters
    ----------
    thing : Mechanism or PosedLinkage
        With coordinates; of a sheet with several frames the first that has them.
    precision : float, optional
        The error that a coordinate may have, in their unit; by default as they are written, or as the geometry
        shows.

    Raises
    ------
    UnsolvableError
        If it has no coordinates.
    NumericalError
        If singular values do not tell the rank at the pose.

    Examples
    --------
    >>> from synth.patterns import generate
    >>> found = explain(generate("bennett").mechanism)
    >>> found.freedoms, found.count, found.idle, found.sets[0].reasons[0]
    (1, -2, 3, 'opposite links equal, lengths proportional to the sines of the twists (Bennett)')
    """
    check_argument("explain", thing, Movable)
    at = configuration_of(thing, precision=precision)
    linkage = at.linkage
    order = first_order(linkage, at.tolerances)
    meant = Tolerances.of(at.precision.size)  # mended coordinates move, but are not all that they were meant to be
    names = list(linkage.graph.joints)
    active = active_at_second_order(linkage, order)
    sets = tuple(
        IdleSet(
            tuple(tuple(names[joint] for joint in linkage.loops[loop].joints) for loop in loops),
            number,
            tuple(reasons_of(linkage, loops, meant) or turning_reasons(linkage, order, loops, meant)),
        )
        for loops, number in smallest_sets(linkage, order)
    )
    freedoms, idle = order.rates.shape[1], order.stresses.shape[1]
    return Explanation(
        configuration=at,
        freedoms=freedoms,
        count=len(names) - len(order.loop_of),
        idle=idle,
        active=active,
        sets=sets,
        tolerances=tuple(axis_tolerances(linkage, order)) if idle and freedoms and not active else (),
        smallest=order.smallest,
        gap=order.gap,
    )
