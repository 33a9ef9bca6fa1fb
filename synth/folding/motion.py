"""A crease pattern folded along one of its branches, panels rigid, frame by frame.

Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from graphs.errors import check_argument
from graphs.mechanism.sheet import Sheet
from graphs.types import JointId
from synth.folding.configuration import configuration_of_sheet
from synth.motion.driving import Asked
from synth.motion.motion import FRAMES, Motion, motion_of

__all__ = ["fold"]


def fold(
    sheet: Sheet,
    *,
    drive: Mapping[JointId, float] | None = None,
    along: Mapping[JointId, float] | None = None,
    branch: int | str | None = None,
    frames: int = FRAMES,
    collisions: bool = False,
    precision: float | None = None,
    report: Callable[[int], None] | None = None,
) -> Motion:
    """Fold a crease pattern from its pose, panels rigid, until driven creases have the angles asked for.

    Parameters
    ----------
    sheet : Sheet
        With coordinates, flat or folded; loops closed at its pose.
    drive : mapping of joint id to float, optional
        Fold angles, radians, valleys positive. By default the crease that moves most is folded as far as it goes.
    along : mapping of joint id to float, optional
        In place of driven creases: rates at which some begin, others as little as may be. The motion goes straight
        on, with several freedoms, until the crease that began to move most has gone as far as it goes.
    branch : int or str, optional
        Which of the ways to move from a singular pose, a flat one above all: its number among
        `synth.motion.branches_of`, or its signs. By default the one that agrees best with the letters of the
        edges.
    frames : int, optional
        How many after the first.
    collisions : bool, optional
        End before the first frame on whose way panels pass through each other.
    precision : float, optional
        The error that a coordinate may have, in their unit; by default as they are written, or as the geometry
        shows. A Configuration has its own.
    report : callable, optional
        Called with the number of frames after each.

    Raises
    ------
    UnsolvableError
        If the sheet has no coordinates, its panels do not fit at its pose, or nothing moves.
    InvariantError
        If there is no such joint or branch, or an angle is out of range.

    Examples
    --------
    A vertex of four creases of which two are in line:

    >>> import numpy as np
    >>> from math import radians
    >>> corners = ((0, 0), (1, 0), (.5, 1), (-1, 0), (.5, -1))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> sheet = Sheet(5, ((0, 1), (0, 2), (0, 3), (0, 4)), "MVVV", faces, corners)
    >>> folded = fold(sheet, drive={1: radians(90)}, frames=3)
    >>> np.degrees(folded.path.angles[-1]).round(2).tolist(), folded.freedoms
    ([-48.19, 90.0, 48.19, 90.0], 1)
    """
    check_argument("fold", sheet, Sheet)
    return motion_of(
        configuration_of_sheet(sheet, precision=precision),
        Asked(drive or {}, along or {}, branch, frames, report),
        collisions=collisions,
    )
