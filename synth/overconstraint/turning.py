"""Idle equations of turning: self-stresses that are couples, which the directions of axes decide.

Theory: docs/theory/overconstraint.md.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from graphs.geometry import unit
from graphs.joints.kinds import JointKind
from graphs.joints.linkage import JointedLinkage, Leg, legs, plain_vector
from graphs.joints.recognising import recognised
from graphs.loops.loop import Centre
from graphs.mechanism.solids import HingedSolids
from graphs.rank.singular_values import null_space
from graphs.tolerances import DOUBLE, Tolerances
from graphs.types import Floats
from synth.motion.linkage import PosedLinkage, axis_lengths
from synth.overconstraint.idle import FirstOrder

__all__ = ["turning_reasons"]

_SCREW = 6


def turning_reasons(
    linkage: PosedLinkage, order: FirstOrder, loops: tuple[int, ...], tolerances: Tolerances = DOUBLE
) -> Iterator[str]:
    """Yield why equations of turning in a set of spatial loops depend on each other, if only these do."""
    if any(linkage.loops[loop].centre is not Centre.NONE for loop in loops):
        return
    if not _couples_only(order, loops):
        return
    near = float(tolerances.parallel / axis_lengths(linkage).min()) * len(linkage.directions)
    if _legs_are_parallel(linkage, near):
        yield (
            "axes parallel in each leg: each leg rotates its end about one direction, "
            "together they prevent every rotation"
        )
    else:
        yield "directions of axes alone: the rotational closure equations are dependent"


def _couples_only(order: FirstOrder, loops: tuple[int, ...]) -> bool:
    """Tell whether self-stresses of some loops hold no forces, in loops that have none by themselves."""
    rows = np.flatnonzero(np.isin(order.loop_of, loops))
    stresses = null_space(order.matrix[rows].T, DOUBLE.singular)
    shared = [loop for loop in loops if len(loops) == 1 or not _stressed(order, loop)]
    forces = [stresses[order.loop_of[rows] == loop][_SCREW // 2 :] for loop in shared]
    if not shared or not stresses.size:
        return False
    return bool(np.abs(np.concatenate(forces)).max() <= DOUBLE.singular)


def _stressed(order: FirstOrder, loop: int) -> bool:
    """Tell whether a loop has a self-stress of its own."""
    return bool(null_space(order.matrix[order.loop_of == loop].T, DOUBLE.singular).size)


def _legs_are_parallel(linkage: PosedLinkage, near: float) -> bool:
    """Tell whether each row of joints between binary links turns about one direction, however it slides."""
    axes = {
        joint: (plain_vector(point), plain_vector(axis))
        for joint, point, axis in zip(linkage.graph.joints, linkage.points, linkage.directions, strict=True)
    }
    seen = recognised(HingedSolids(linkage.graph, axes))
    rows = [leg for leg in legs(seen.chain) if len(leg.joints) > 1]
    return len(rows) > 1 and all(_turns_about_one(seen, row, near) for row in rows)


def _turns_about_one(seen: JointedLinkage, row: Leg, near: float) -> bool:
    """Tell whether all that turns in a leg turns about one direction."""
    kinds = [seen.kinds[joint] for joint in row.joints]
    if JointKind.SPHERICAL in kinds:
        return False
    turning = [joint for joint in row.joints if seen.kinds[joint] is not JointKind.PRISMATIC]
    directions: Floats = unit([axis for joint in turning for axis in seen.places[joint].axes])
    return bool(np.linalg.norm(np.cross(directions, directions[0]), axis=1).max() <= near) if turning else False
