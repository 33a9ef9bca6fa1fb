"""Motion of any linkage from its pose: joints driven, all loops closed, joint angles frame by frame.

What `synth.folding.motion` does with crease patterns, whose panels have places. Theory: docs/theory/moving.md.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import degrees, tau
from typing import Any

import numpy as np

from graphs.convert.table import Mechanism
from graphs.errors import UnsolvableError, shown
from graphs.given import check_given
from graphs.ids import JointId
from graphs.printing import Block, Printed
from synth.conformed.linkages import OnCone
from synth.motion.beginning import MOST_JOINTS, search_for
from synth.motion.branches import Branch, Branches, branches_of
from synth.motion.closure import ClosureEquations
from synth.motion.driving import Asked, check_closed, driven_from
from synth.motion.linkage import PosedLinkage
from synth.motion.path import DrivenPath
from synth.moving.linkages import linkage_of

__all__ = ["Motion", "Movable", "move"]

Movable = PosedLinkage | Mechanism | OnCone
"""What has links and axes at a pose, or coordinates that tell them."""

_FRAMES = 20


@dataclass(frozen=True, slots=True, repr=False)
class Motion(Printed):
    """A linkage on its way.

    It prints as ``synth fold`` does of what is no crease pattern.

    Attributes
    ----------
    linkage : PosedLinkage
    branches : Branches or None
        The ways to move from the pose; None where they were not looked for.
    branch : int or None
        The one that was taken; None at a regular pose, or where they were not looked for.
    path : DrivenPath
        Joint angles, radians, of each frame; columns are the joints of the linkage's graph.
    driven : mapping of joint id to float
        The angles that were asked for, radians.
    """

    linkage: PosedLinkage
    branches: Branches | None
    branch: int | None
    path: DrivenPath
    driven: Mapping[JointId, float]

    @property
    def joints(self) -> tuple[JointId, ...]:
        """The joints, in the order of the columns of the path's angles."""
        return tuple(self.linkage.graph.joints)

    @property
    def closure(self) -> float:
        """By how much loops do not close, at most, over all frames."""
        return float(self.path.errors.max(initial=0.0))

    @property
    def taken(self) -> Branch | None:
        """The branch that was taken."""
        if self.branches is None or not self.branches.branches:
            return None
        return self.branches.branches[self.branch or 0]

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        found, taken = self.branches, self.taken
        return {
            "freedoms": None if taken is None else taken.freedoms,
            "certainty": None if taken is None else taken.certainty,
            "branches": None if found is None else [one.to_json(self.joints) for one in found.branches],
            "exhaustive": None if found is None else found.exhaustive,
            "branch": self.branch,
            "driven": {str(joint): degrees(angle) for joint, angle in self.driven.items()},
            "frames": len(self.path.angles),
            "closure": self.closure,
            "joint_angles_deg": {
                str(joint): np.degrees(column).tolist()
                for joint, column in zip(self.joints, self.path.angles.T, strict=True)
            },
            "stopped": self.path.stopped or None,
            "events": [event.to_json(self.joints) for event in self.path.events],
            "ranks_watched": self.path.watched,
        }

    def blocks(self) -> list[Block]:
        """Return the lines that are printed."""
        lines: list[Block] = []
        taken = self.taken
        if self.branch is not None and self.branches is not None and not self.branches.regular:
            how = "all there are" if self.branches.exhaustive else "those that were found"
            lines.append(f"from this pose {len(self.branches.branches)} way(s) to move, {how}; way {self.branch}")
        if taken is not None:
            freedoms = "freedoms not known" if taken.freedoms is None else f"{taken.freedoms} freedom(s)"
            lines.append(f"{freedoms}, {taken.certainty}")
        driven = ", ".join(f"joint {shown(joint)} to {degrees(angle):g}" for joint, angle in self.driven.items())
        lines.append(f"driven: {driven} degrees; {len(self.path.angles)} frames")
        lines.append(f"loops close to {self.closure:.1e}")
        ends = zip(self.joints, np.degrees(self.path.angles[-1]), strict=True)
        lines.append("joints: " + ", ".join(f"{shown(joint)} at {angle:.6g}" for joint, angle in ends))
        lines += [event.told(self.joints) for event in self.path.events]
        if self.path.stopped:
            lines.append(f"stopped: {self.path.stopped}")
        return lines

    def __repr__(self) -> str:
        return f"<Motion: {len(self.path.angles)} frames of {self.linkage!r}>"


def move(
    thing: Movable,
    *,
    drive: Mapping[JointId, float] | None = None,
    along: Mapping[JointId, float] | None = None,
    branch: int | str | None = None,
    frames: int = _FRAMES,
    report: Callable[[int], None] | None = None,
) -> Motion:
    """Move a linkage from its pose until driven joints have the angles asked for.

    Parameters
    ----------
    thing : PosedLinkage, or anything that `synth.moving.linkages.linkage_of` takes
        Loops closed at its pose.
    drive : mapping of joint id to float, optional
        Angles, radians, from the zero of each joint: of a crease from flat, of others from the pose. By default
        the joint that moves most is turned once round.
    along : mapping of joint id to float, optional
        In place of driven joints: rates at which some begin, others as little as may be. With several freedoms the
        motion goes straight on.
    branch : int or str, optional
        Which of the ways to move from a singular pose: its number among `synth.motion.branches_of`, or its signs.
    frames : int, optional
        How many after the first.
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
    check_given("move", thing, Movable)
    linkage = thing if isinstance(thing, PosedLinkage) else linkage_of(thing)
    closure = ClosureEquations(linkage)
    joints = tuple(linkage.graph.joints)
    if not joints:
        raise UnsolvableError("nothing moves: there are no joints")
    check_closed(closure, linkage)
    found = branches_of(linkage, closure, search_for(len(joints), None)) if len(joints) <= MOST_JOINTS else None
    marks = np.ones(len(joints))
    asked = Asked(drive or {}, tau, branch, marks, frames, limited=False, report=report, along=along or {})
    driven = driven_from(linkage, closure, found, asked)
    return Motion(linkage, found, driven.branch, driven.path, driven.goals)
