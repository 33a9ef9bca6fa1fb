"""The compliance states of a mechanism, and what springs do to it. Theory: docs/theory/compliance.md."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from sys import float_info

import numpy as np
from scipy.optimize import brentq

from graphs.errors import InvariantError, UnsolvableError, check_argument
from graphs.tolerances import DOUBLE
from graphs.types import Floats, JointId, LinkId
from synth.compliance.answer import Elastic, PathPose, RestPassed, States, Transition
from synth.compliance.equilibrium import LoadPath, equilibrium, load_path
from synth.compliance.freedoms import State, state_of, states_of_sets
from synth.compliance.members import Members
from synth.compliance.small_motions import Masses, small_motions
from synth.compliance.springs import ElasticLinkage, Springs
from synth.motion.driving import goals_of
from synth.motion.linkage import PosedLinkage
from synth.motion.placement import moved
from synth.moving.made import Movable, configuration_of

__all__ = ["Drive", "states"]

_FRAMES = 20


@dataclass(frozen=True, slots=True)
class Drive:
    """A joint that is driven.

    Attributes
    ----------
    joint : joint id
    to : float
        Radians, from the zero of the joint.
    frames : int
        Poses after the first.

    Examples
    --------
    >>> Drive(0, 0.5).frames
    20
    """

    joint: JointId
    to: float
    frames: int = _FRAMES


def states(
    thing: Movable,
    joints: Collection[JointId] = (),
    links: Collection[LinkId] = (),
    *,
    springs: Springs | None = None,
    drive: Drive | None = None,
    masses: Masses | None = None,
) -> States:
    """Say in which compliance states a mechanism can be, and what its springs do.

    Parameters
    ----------
    thing : Mechanism or PosedLinkage
        With coordinates; of a sheet with several frames the first that has them.
    joints, links : collection of ids
        Compliant members. Joints with a stiffness are compliant too.
    springs : Springs, optional
        At joints, with moments. The equilibrium is looked for from the pose given.
    drive : Drive, optional
        A joint whose load path is followed from the equilibrium.
    masses : Masses, optional
        For modes and frequencies of small motions about the equilibrium.

    Raises
    ------
    InvariantError
        If there is no such joint or link, or a number is out of range.
    UnsolvableError
        If it has no coordinates, nothing is compliant, there are too many members, or springs have nothing to
        move.
    NumericalError
        If springs come to no balance.

    Examples
    --------
    A four-bar with one flexure: rigid until that bends.

    >>> from synth.patterns import generate
    >>> found = states(generate("four-bar").mechanism, [0])
    >>> found.classes, [(len(one.active), one.freedoms) for one in found.sets]
    (('compliant mechanism',), [(0, 0), (1, 1)])
    """
    check_argument("states", thing, Movable)
    at = configuration_of(thing)
    linkage = at.linkage
    stiff = () if springs is None else tuple(one for one, value in springs.stiffness.items() if value)
    compliant = Members(tuple(dict.fromkeys((*joints, *stiff))), tuple(dict.fromkeys(links)))
    compliant.checked(linkage.graph)
    if not len(compliant):
        raise UnsolvableError("nothing is compliant: expected joints or links that are")
    if springs is None and (drive is not None or masses is not None):
        raise UnsolvableError("a load path and frequencies need springs: expected the stiffness of a joint")
    sets = tuple(states_of_sets(linkage, compliant))
    asked = _Asked(linkage, compliant, springs or Springs())
    active = asked.active(linkage.angles)
    now = next(one for one in sets if one.active.within(active) and active.within(one.active))
    elastic = None if springs is None else asked.elastic(drive, masses)
    return States(at, compliant, now, sets, tuple(_transitions(sets)), elastic)


@dataclass(frozen=True, slots=True)
class _Asked:
    """A linkage, its compliant members, and the springs at its joints."""

    linkage: PosedLinkage
    compliant: Members
    springs: Springs

    def off_rest(self, joint: JointId, angles: Floats) -> float:
        """Return how far a compliant joint is from rest, radians; without a spring it rests at the pose given."""
        place = list(self.linkage.graph.joints).index(joint)
        return float(angles[place]) - self.springs.rest.get(joint, float(self.linkage.angles[place]))

    def active(self, angles: Floats) -> Members:
        """Return the members that are not at rest. Links have no springs, and are told at rest."""
        return Members(tuple(one for one in self.compliant.joints if not _is_rest(self.off_rest(one, angles))))

    def elastic(self, drive: Drive | None, masses: Masses | None) -> Elastic:
        """Return what springs do."""
        if self.compliant.links and drive is not None:
            raise UnsolvableError("a load path has no links that give way: expected compliant joints only")
        bending = ElasticLinkage(self.linkage, self.springs)
        pose = equilibrium(bending)
        modes = None if masses is None else tuple(small_motions(bending, pose, masses))
        joints = tuple(self.linkage.graph.joints)
        if drive is None:
            return Elastic(joints, pose, modes=modes)
        if drive.frames < 1:
            raise InvariantError("frames", f"a path of {drive.frames} frames", "1 or more")
        [driver], goal = goals_of(joints, {drive.joint: drive.to}, float_info.max)
        values = np.linspace(pose.angles[driver], goal[0], drive.frames + 1)[1:]
        path = load_path(bending, pose.angles, driver, values)
        told = tuple(self.path_poses(path))
        passed = tuple(self.passed(bending, path))
        return Elastic(joints, pose, drive.joint, told, passed, path.stopped, modes)

    def path_poses(self, path: LoadPath) -> Iterator[PathPose]:
        """Yield the poses of a load path with their states."""
        for pose in path.poses:
            here = moved(self.linkage, pose.angles)
            yield PathPose(pose, state_of(here, self.compliant, self.active(pose.angles)))

    def passed(self, bending: ElasticLinkage, path: LoadPath) -> Iterator[RestPassed]:
        """Yield where compliant joints come to rest after the beginning."""
        for before, after in pairwise(path.poses):
            ends = [float(pose.angles[path.driver]) for pose in (before, after)]
            for joint in self.compliant.joints:
                was, now = (self.off_rest(joint, pose.angles) for pose in (before, after))
                if _is_rest(was) or (was * now > 0.0 and not _is_rest(now)):
                    continue

                def off(driven: float, joint: JointId = joint, start: Floats = before.angles) -> float:
                    between = load_path(bending, start, path.driver, [driven])
                    return self.off_rest(joint, between.poses[-1].angles)

                passed = ends[1] if _is_rest(now) else brentq(off, *ends, xtol=DOUBLE.same_configuration)
                yield RestPassed(joint, passed)


def _is_rest(off: float) -> bool:
    """Tell whether a joint that is so far from the angle of its spring, in radians, is at rest."""
    return abs(off) <= DOUBLE.same_configuration


def _transitions(sets: Sequence[State]) -> Iterator[Transition]:
    """Yield the transitions of each class: those to the smallest sets, or between sets that differ by a member."""
    rest = sets[0]
    moving = [one for one in sets[1:] if one.freedoms is not None and one.freedoms > (rest.freedoms or 0)]
    if rest.freedoms is not None and moving:
        name = "variable mobility" if rest.freedoms else "compliant mechanism"
        fewest = len(moving[0].active)
        yield from (Transition(name, rest, one) for one in moving if len(one.active) == fewest)
    locking = [
        Transition("compliant locking", before, after)
        for before in sets
        if before.freedoms
        for after in sets[1:]
        if after.freedoms == 0
        and len(after.active) == len(before.active) - 1
        and after.active.within(before.active)
    ]
    fewest = min((len(one.before.active) for one in locking), default=0)
    yield from (one for one in locking if len(one.before.active) == fewest)
