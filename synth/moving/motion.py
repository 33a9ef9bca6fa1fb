"""Any mechanism moved from its configuration: joints driven, all loops closed, frame by frame.

Theory: docs/theory/moving.md.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from graphs.errors import check_argument
from graphs.types import JointId
from synth.motion.driving import Asked
from synth.motion.motion import FRAMES, Motion, motion_of
from synth.moving.made import Movable, configuration_of

__all__ = ["move"]


def move(
    thing: Movable,
    *,
    drive: Mapping[JointId, float] | None = None,
    along: Mapping[JointId, float] | None = None,
    branch: int | str | None = None,
    frames: int = FRAMES,
    collisions: bool = False,
    precision: float | None = None,
    report: Callable[[int], None] | None = None,
) -> Motion:
    """Move a mechanism from its configuration until driven joints have the angles asked for.

    Parameters
    ----------
    thing : Configuration, or anything that `synth.moving.made.configuration_of` makes one of
        Of a sheet this is `synth.fold`.
    drive : mapping of joint id to float, optional
        Angles, radians, from the zero of each joint: of a crease from flat, of others from the pose. By default
        the joint that moves most is turned once round, of a sheet as far as it folds.
    along : mapping of joint id to float, optional
        In place of driven joints: rates at which some begin, others as little as may be. With several freedoms the
        motion goes straight on.
    branch : int or str, optional
        Which of the ways to move from a singular pose: its number among `synth.motion.branches_of`, or its signs.
    frames : int, optional
        How many after the first.
    collisions : bool, optional
        Of a sheet, end before the first frame on whose way panels pass through each other.
    precision : float, optional
        The error that a coordinate may have, in their unit; by default as they are written, or as the geometry
        shows. A Configuration has its own.
    report : callable, optional
        Called with the number of frames after each.

    Raises
    ------
    UnsolvableError
        If it has no coordinates, its loops are not closed, or nothing moves, or not with the driven joints.
    InvariantError
        If there is no such joint or branch, or an angle is not finite.

    Examples
    --------
    A parallelogram in the plane:

    >>> import numpy as np
    >>> from graphs.loops.loop import Loop
    >>> from graphs.mechanism.sc import SCGraph
    >>> from graphs.mechanism.solids import HingedSolids
    >>> ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop(range(4), "infinite")])
    >>> corners = [(0, 0, 0), (2, 0, 0), (2.5, 1, 0), (0.5, 1, 0)]
    >>> four_bar = HingedSolids(ring, {joint: (corners[joint], (0, 0, 1)) for joint in range(4)})
    >>> moved = move(four_bar, drive={0: np.pi / 6}, frames=2)
    >>> np.degrees(moved.path.angles[-1]).round(6).tolist(), moved.taken.freedoms
    ([30.0, -30.0, 30.0, -30.0], 1)
    """
    check_argument("move", thing, Movable)
    at = configuration_of(thing, precision=precision)
    return motion_of(at, Asked(drive or {}, along or {}, branch, frames, report), collisions=collisions)
