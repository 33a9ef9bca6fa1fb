"""Springs at the joints of a linkage and moments on them: energy, and how it bends on the closed poses.

Theory: docs/theory/compliance.md.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import isfinite

import numpy as np

from graphs.edit.named import known
from graphs.errors import InvariantError, NumericalError, UnsolvableError, shown
from graphs.rank.singular_values import split
from graphs.tolerances import DOUBLE
from graphs.types import Floats, JointId
from synth.motion.branches import MOST_JOINTS, branches_of, search_for
from synth.motion.closure import ClosureEquations
from synth.motion.driving import check_closed
from synth.motion.linkage import PosedLinkage

__all__ = ["Bent", "ElasticLinkage", "Springs", "Tangent"]

_NUDGE = 1e-5


@dataclass(frozen=True, slots=True)
class Springs:
    """Torsion springs and dead moments at joints, in one system of units: moment, moment a radian.

    Attributes
    ----------
    stiffness : mapping of joint id to float
        0 or more; other joints turn freely.
    rest : mapping of joint id to float
        Angles at which springs are at rest, radians, from the zero of each joint; by default those of the pose.
    moments : mapping of joint id to float
        That turn a joint's second link against its first, whatever its angle.

    Examples
    --------
    A spring at joint 0, at rest at 0.5 radians, and one at joint 2, at rest as it lies:

    >>> Springs({0: 2.0, 2: 1.0}, rest={0: 0.5}).moments
    {}
    """

    stiffness: Mapping[JointId, float] = field(default_factory=dict)
    rest: Mapping[JointId, float] = field(default_factory=dict)
    moments: Mapping[JointId, float] = field(default_factory=dict)

    def checked(self, joints: tuple[JointId, ...]) -> None:
        """Refuse joints that are none, numbers that are none, and springs that push with less than nothing.

        Raises
        ------
        InvariantError
        """
        for what in ("stiffness", "rest", "moments"):
            for joint, value in getattr(self, what).items():
                if joint not in joints:
                    raise InvariantError("joint", f"{shown(joint)} is no joint", known(joints, str(joint)))
                if not isfinite(value) or (what == "stiffness" and value < 0.0):
                    wanted = "a number, 0 or more" if what == "stiffness" else "a number"
                    raise InvariantError(what, f"joint {shown(joint)} has {value!r}", wanted)
                if what == "rest" and not self.stiffness.get(joint):
                    raise InvariantError("rest", f"joint {shown(joint)} has no spring", "a stiffness")


@dataclass(frozen=True, slots=True)
class Tangent:
    """Closed poses beside one: the derivatives float[rows, J], and the motions float[J, f], orthonormal rates."""

    jacobian: Floats
    rates: Floats


@dataclass(frozen=True, slots=True)
class Bent:
    """Energy on the closed poses beside one, to second order along n rates.

    `held` are the moments that keep held joints where they are.
    """

    slope: Floats
    curvature: Floats
    held: Floats


class ElasticLinkage:
    """A linkage with springs, from a regular closed pose; `freedoms` are those of finite motion.

    Raises `InvariantError` as :meth:`Springs.checked` does, `UnsolvableError` if loops are not closed, nothing
    moves, or the pose is singular.
    """

    def __init__(self, linkage: PosedLinkage, springs: Springs) -> None:
        joints = tuple(linkage.graph.joints)
        springs.checked(joints)
        self.linkage, self.closure = linkage, ClosureEquations(linkage)
        check_closed(self.closure, linkage)
        self.stiffness = np.array([springs.stiffness.get(joint, 0.0) for joint in joints])
        zero = zip(joints, linkage.angles.tolist(), strict=True)
        self.rest = np.array([springs.rest.get(joint, angle) for joint, angle in zero])
        self.moments = np.array([springs.moments.get(joint, 0.0) for joint in joints])
        self.freedoms = _freedoms_of_regular_pose(linkage, self.closure)

    def energy(self, angles: Floats) -> float:
        """Return the energy of springs and moments at joint angles, radians."""
        off = angles - self.rest
        return float(0.5 * self.stiffness @ off**2 - self.moments @ angles)

    def slopes(self, angles: Floats) -> Floats:
        """Return the derivatives of the energy by joint angles: float[J]."""
        return np.asarray(self.stiffness * (angles - self.rest) - self.moments)

    def tangent(self, angles: Floats) -> Tangent:
        """Return the closed poses beside one, to first order.

        Raises `NumericalError` if there are more rates than freedoms: the pose is singular.
        """
        jacobian = self.closure.at(angles)[1].toarray()
        if not len(jacobian):
            return Tangent(jacobian, np.eye(len(angles)))
        parts, rank = split(jacobian, DOUBLE.clear), len(angles) - self.freedoms
        if parts.rank < rank:
            raise NumericalError("springs led to a singular pose, where it is open which way the linkage goes")
        return Tangent(jacobian, parts.right[rank:].T)

    def bent(self, angles: Floats, tangent: Tangent, along: Floats, held: tuple[int, ...]) -> Bent:
        """Return how the energy bends on the closed poses along some rates.

        The closure equations pull with moments -J^T w that hold the slopes of the energy in balance; second
        derivatives of w . (closure) by rates along which loops stay closed are those of w . J. Angles are those of
        a closed pose, radians, the tangent is taken there; the rates float[J, n] are orthonormal and among those
        of the tangent; joints at the places `held` do not move along them.
        """
        slopes = self.slopes(angles)
        places = list(held)
        moments = np.linalg.lstsq(tangent.rates[places].T, tangent.rates.T @ slopes, rcond=None)[0]
        balance = slopes.copy()
        balance[places] -= moments
        weights = np.linalg.lstsq(tangent.jacobian.T, -balance, rcond=None)[0]
        curvature = along.T @ (self.stiffness[:, None] * along)
        for number, rates in enumerate(along.T):
            ahead, back = (self.closure.at(angles + way * _NUDGE * rates)[1] for way in (1.0, -1.0))
            curvature[number] += (ahead - back).T @ weights @ along / (2.0 * _NUDGE)
        return Bent(along.T @ slopes, (curvature + curvature.T) / 2.0, np.asarray(moments + 0.0))


def _freedoms_of_regular_pose(linkage: PosedLinkage, closure: ClosureEquations) -> int:
    joints = len(linkage.angles)
    if joints > MOST_JOINTS:
        raise UnsolvableError(f"springs are not worked out at {joints} joints: expected {MOST_JOINTS} at most")
    found = branches_of(linkage, closure, search_for(joints, None))
    if found.no_motion == "proved" or not joints:
        raise UnsolvableError("springs have nothing to move: all links are rigid against each other")
    if not found.regular or found.branches[0].freedoms is None:
        raise UnsolvableError(
            "springs need a regular pose, and from this one there are several ways to move or none is known: "
            "fold it a little first (synth fold)"
        )
    return found.branches[0].freedoms
