"""A type of linkage with driven joints, its members by arrays, and what becomes of them."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from graphs.types import Flags, Floats, Ints

CLOSED, TURNS_BACK, OPEN, BARRED = 0, 1, 2, 3
"""A member at given inputs: closed; its driven joint turns back before; not reached; unable to close."""
STRAY = 0.25
"""A corrected place is at most this part of its step from where it was expected."""
LEAST = 1e-4
"""Least step of a driven joint, radians: a turning point is known to that."""


@dataclass(frozen=True, slots=True)
class MemberType:
    """The loops of a type with driven joints.

    A loop passes its joints one after the other: `begin`, int[L + 1], says where the passages of each begin. Each
    passage, P in all, has the place of its `joint`, its `sign` (-1 backwards). Of the joints, J of them, `slides`
    says which slide, and `column` their places among the unknowns, or -1 - (that among the driven ones). `curved`,
    bool[L], says of which loops the axes meet in a point; those of the others are parallel.
    """

    begin: Ints
    joint: Ints
    sign: Floats
    slides: Flags
    column: Ints
    curved: Flags

    @property
    def unknowns(self) -> int:
        """Number of joints that are not driven."""
        return int((self.column >= 0).sum())

    @property
    def inputs(self) -> int:
        """Number of driven joints."""
        return len(self.column) - self.unknowns


@dataclass(frozen=True, slots=True)
class Members:
    """Members of a type, and where they begin.

    `axes`, float[P, 3] or float[N, P, 3], is the axis of each passage: a direction, or in a plane the point, with 1,
    or of a slide (-y, x, 0) of its heading. `start`, float[U + I] or float[N, U + I], are unknowns and inputs at
    which loops close. With `bends`, float[N, P], radians, the axes are those of one mechanism; members come of it by
    bending the link after each passage about its normal, of `normals`, float[P, 3].
    """

    axes: Floats
    start: Floats
    normals: Floats | None = None
    bends: Floats | None = None


class Swept(NamedTuple):
    """Angles float[N, F, O] of joints, loop-closure residuals float[N, F], nan where not closed; states int8[N, F]."""

    angles: Floats
    residuals: Floats
    status: npt.NDArray[np.int8]
