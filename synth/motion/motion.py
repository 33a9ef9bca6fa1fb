"""A motion: joints driven from a configuration, all loops closed, frame by frame.

Theory: docs/theory/folding.md, docs/theory/moving.md.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import degrees
from typing import Any

import numpy as np

from graphs.arrays import Floats
from graphs.errors import UnsolvableError, numbered, shown
from graphs.ids import JointId
from graphs.printing import Block, Printed
from graphs.tolerances import DOUBLE
from synth.motion.branches import Branch, Branches
from synth.motion.configuration import Configuration
from synth.motion.driving import Asked, Driven, driven_from
from synth.motion.linkage import PosedLinkage
from synth.motion.path import Path

__all__ = ["FRAMES", "Motion", "motion_along", "motion_of"]

FRAMES = 20
"""Frames after the first, where nothing else is asked for."""


@dataclass(frozen=True, eq=False, repr=False)
class Motion(Printed):
    """A mechanism on its way.

    It prints as ``synth fold`` does.

    Attributes
    ----------
    configuration : Configuration
        Where it began; of a sheet with what was done to its coordinates.
    branch : int or None
        Number of the branch that was taken; None at a regular configuration, or where they were not looked for.
    path : Path
        Joint angles, radians, of each frame; columns are the joints of the configuration.
    driven : mapping of joint id to float
        The angles that were asked for, radians.
    places : float[F, n, 3]
        Of the vertices of a sheet in each frame, else of a point on each axis, in the unit of the coordinates.
    apart : float
        By how much panels disagree on the place of a vertex, at most, in units of the extent.

    Examples
    --------
    >>> import synth
    >>> motion = synth.move(synth.generate("miura", rows=2, columns=2).mechanism, frames=3)
    >>> motion.places.shape, motion.apart < 1e-12, motion.freedoms
    ((4, 9, 3), True, 1)
    """

    configuration: Configuration
    branch: int | None
    path: Path
    driven: Mapping[JointId, float]
    places: Floats
    apart: float

    @property
    def linkage(self) -> PosedLinkage:
        """Links and axes where it began."""
        return self.configuration.linkage

    @property
    def joints(self) -> tuple[JointId, ...]:
        """The joints, in the order of the columns of the path's angles."""
        return self.configuration.joints

    @property
    def branches(self) -> Branches | None:
        """The ways to move from where it began; None where they were not looked for."""
        return self.configuration.branches

    @property
    def taken(self) -> Branch | None:
        """The branch that was taken."""
        return self.configuration.branch(self.branch or 0)

    @property
    def freedoms(self) -> int | None:
        """Of the branch that was taken."""
        return None if self.taken is None else self.taken.freedoms

    @property
    def closure(self) -> float:
        """By how much loops do not close, at most, over all frames."""
        return float(self.path.errors.max(initial=0.0))

    def frames(self) -> list[Any]:
        """Return the mechanism in each frame: a sheet with coordinates in space and fold angles, or a linkage."""
        every = zip(self.path.angles, self.places, strict=True)
        return [self.configuration.at(angles, points) for angles, points in every]

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        found, taken = self.branches, self.taken
        return {
            "configuration": self.configuration.to_json(taken),
            "freedoms": self.freedoms,
            "certainty": None if taken is None else taken.certainty,
            "branches": None if found is None else [one.to_json(self.joints) for one in found.branches],
            "exhaustive": None if found is None else found.exhaustive,
            "search": None if found is None else found.method,
            "branch": self.branch,
            "driven": {str(joint): degrees(angle) for joint, angle in self.driven.items()},
            "frames": len(self.path.angles),
            "closure": self.closure,
            "panels_apart": self.apart,
            "joint_angles_deg": {
                str(joint): np.degrees(column).tolist()
                for joint, column in zip(self.joints, self.path.angles.T, strict=True)
            },
            "stopped": self.path.stopped or None,
            "mended": list(self.configuration.mended),
            "events": [event.to_json(self.joints) for event in self.path.events],
            "ranks_watched": self.path.watched,
        }

    def blocks(self) -> list[Block]:
        """Return the lines that are printed."""
        lines: list[Block] = [f"mended: {repair}" for repair in self.configuration.mended]
        lines += self._lines_of_branch()
        driven = ", ".join(f"joint {shown(joint)} to {degrees(angle):g}" for joint, angle in self.driven.items())
        largest = np.degrees(np.abs(self.path.angles[-1]).max(initial=0.0))
        lines.append(
            f"driven: {driven} degrees; {len(self.path.angles)} frames, angles up to {largest:.4g} degrees"
        )
        if self.configuration.limited:
            lines.append(f"loops close to {self.closure:.1e}, panels meet to {self.apart:.1e} of the extent")
        else:
            ends = zip(self.joints, np.degrees(self.path.angles[-1]), strict=True)
            lines.append(f"loops close to {self.closure:.1e}")
            lines.append("joints: " + ", ".join(f"{shown(joint)} at {angle:.6g}" for joint, angle in ends))
        lines += [event.told(self.joints) for event in self.path.events]
        if not self.path.watched:
            lines.append("rank drops on the way were not looked for: there are too many joints")
        if self.path.stopped:
            lines.append(f"stopped: {self.path.stopped}")
        return lines

    def _lines_of_branch(self) -> list[Block]:
        found, taken = self.branches, self.taken
        if found is None or taken is None:
            return []
        lines: list[Block] = []
        which = ""
        if not found.regular:
            how = "all there are" if found.exhaustive else f"those that were found ({found.method})"
            how += "" if found.complete else "; there may be many more"
            lines.append(f"from this pose {numbered(len(found.branches), 'way')} to move, {how}")
            which = f"way {self.branch}: "
        freedoms = "freedoms not known" if taken.freedoms is None else numbered(taken.freedoms, "freedom")
        lines.append(f"{which}{freedoms}, {taken.certainty}; signs {taken.signs}")
        return lines

    def __repr__(self) -> str:
        return f"<Motion: {len(self.path.angles)} frames of {self.linkage!r}>"


def motion_of(configuration: Configuration, asked: Asked, *, collisions: bool = False) -> Motion:
    """Return the motion that is asked for from a configuration.

    Parameters
    ----------
    configuration : Configuration
    asked : Asked
    collisions : bool, optional
        End before the first frame on whose way panels pass through each other.

    Raises
    ------
    UnsolvableError
        If nothing moves, or not with the driven joints; if collisions are asked for of what has no panels.
    InvariantError
        If there is no such joint or branch, or an angle is out of range.
    """
    if not configuration.joints:
        raise UnsolvableError(
            "nothing folds: the sheet has no creases between panels"
            if configuration.limited
            else "nothing moves: there are no joints"
        )
    if collisions:
        asked = replace(asked, events=(*asked.events, configuration.collision()))
    return motion_along(configuration, driven_from(configuration, asked))


def motion_along(configuration: Configuration, driven: Driven) -> Motion:
    """Return a motion with its points in each frame, as far as panels hold together.

    Loops close by the axes of creases. One of several pieces that are in line but for rounding has one axis, and
    panels part at the other pieces.

    Parameters
    ----------
    configuration : Configuration
    driven : Driven
        A motion of its linkage.
    """
    path = driven.path
    points, apart = configuration.placed(path.angles)
    if (apart > DOUBLE.same_point).any():
        kept = int(np.argmax(apart > DOUBLE.same_point))
        reason = (
            f"panels come apart by {apart[kept]:.1e} of the extent in frame {kept}: creases between them are bent"
        )
        path = replace(path.up_to(kept), stopped=reason + configuration.doubt)
    kept = len(path.angles)
    return Motion(
        configuration, driven.branch, path, driven.goals, points[:kept], float(apart[:kept].max(initial=0.0))
    )
