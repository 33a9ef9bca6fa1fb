"""Folding: a crease pattern taken along one of its branches, frame by frame.

Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import degrees, radians
from typing import Any

import numpy as np

from graphs.arrays import Floats
from graphs.errors import UnsolvableError, shown
from graphs.given import check_given
from graphs.ids import JointId
from graphs.mechanism.sheet import Sheet
from graphs.printing import Block, Printed
from synth.folding.collisions import Collision, Panels
from synth.folding.mending.repair import Mended
from synth.folding.prepared import Prepared, prepared
from synth.folding.vertices import vertex_places
from synth.motion.branches import Branches
from synth.motion.driving import Asked, Driven, driven_from
from synth.motion.linkage import PosedLinkage
from synth.motion.path import DrivenPath

__all__ = ["Folding", "fold", "folding_along"]

_FRAMES = 20
_WHOLE = radians(179.0)
"""How far a pattern is folded if nothing is said; at 180 degrees panels lie on each other."""

_TOGETHER = 1e-10
"""Panels that disagree by more on the place of a vertex, in units of the extent, do not hold together."""


@dataclass(frozen=True, slots=True, repr=False)
class Folding(Printed):
    """A crease pattern on its way.

    It prints as ``synth fold`` does.

    Attributes
    ----------
    sheet : Sheet
        As it was given, with vertices of their own for what cuts part.
    linkage : PosedLinkage
    branches : Branches or None
        The ways to move from the pose; None where they were not looked for.
    branch : int or None
        The one that was taken; None at a regular pose, or where all were not looked for.
    joints : tuple of joint ids
        Columns of the angles.
    path : DrivenPath
        Fold angles, radians, of each frame.
    driven : mapping of joint id to float
        The fold angles that were asked for, radians.
    apart : float
        How far panels disagree on the place of a vertex, at most, in units of the extent.
    places : float[F, vertices, 3]
        Of the vertices in each frame, in the unit of the coordinates.
    repairs : tuple of Mended
        What was done to rounded coordinates before they were moved.

    Examples
    --------
    >>> corners = ((0, 0), (1, 0), (.5, 1), (-1, 0), (.5, -1))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> folding = fold(Sheet(5, (), "", faces, corners), frames=3)
    >>> folding.places.shape, folding.apart < 1e-12
    ((4, 5, 3), True)
    """

    sheet: Sheet
    linkage: PosedLinkage
    branches: Branches | None
    branch: int | None
    joints: tuple[JointId, ...]
    path: DrivenPath
    driven: Mapping[JointId, float]
    apart: float
    places: Floats
    repairs: tuple[Mended, ...] = ()

    @property
    def closure(self) -> float:
        """By how much loops do not close, at most, over all frames."""
        return float(self.path.errors.max(initial=0.0))

    @property
    def freedoms(self) -> int | None:
        """Of the branch that was taken."""
        if self.branches is None or not self.branches.branches:
            return None
        return self.branches.branches[self.branch or 0].freedoms

    def frames(self) -> list[Sheet]:
        """Return the sheet in each frame, with coordinates in space and fold angles."""
        column = {joint: place for place, joint in enumerate(self.joints)}
        made = []
        for places, angles in zip(self.places, self.path.angles, strict=True):
            turned = tuple(
                degrees(float(angles[column[edge]])) if edge in column else None
                for edge in range(len(self.sheet.edges))
            )
            made.append(replace(self.sheet, coordinates=tuple(map(tuple, places.tolist())), fold_angles=turned))
        return made

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        found = self.branches
        return {
            "freedoms": self.freedoms,
            "branches": None if found is None else [one.to_json(self.joints) for one in found.branches],
            "exhaustive": None if found is None else found.exhaustive,
            "search": None if found is None else found.method,
            "branch": self.branch,
            "driven": {str(joint): degrees(angle) for joint, angle in self.driven.items()},
            "frames": len(self.path.angles),
            "closure": self.closure,
            "panels_apart": self.apart,
            "fold_angles_deg": {
                str(joint): np.degrees(column).tolist()
                for joint, column in zip(self.joints, self.path.angles.T, strict=True)
            },
            "stopped": self.path.stopped or None,
            "mended": [str(repair) for repair in self.repairs],
            "events": [event.to_json(self.joints) for event in self.path.events],
            "ranks_watched": self.path.watched,
        }

    def blocks(self) -> list[Block]:
        """Return the lines that are printed."""
        lines: list[Block] = [f"mended: {repair}" for repair in self.repairs]
        if self.branches is not None and not self.branches.regular:
            how = (
                "all there are" if self.branches.exhaustive else f"those that were found ({self.branches.method})"
            )
            how += "" if self.branches.complete else "; there may be many more"
            lines.append(f"from this pose {len(self.branches.branches)} way(s) to move, {how}")
        if self.branch is not None and self.branches is not None:
            taken = self.branches.branches[self.branch]
            lines.append(f"way {self.branch}: {taken.freedoms} freedom(s), {taken.certainty}; signs {taken.signs}")
        driven = ", ".join(f"joint {shown(joint)} to {degrees(angle):g}" for joint, angle in self.driven.items())
        largest = np.degrees(np.abs(self.path.angles[-1]).max(initial=0.0))
        lines.append(
            f"driven: {driven} degrees; {len(self.path.angles)} frames, folds up to {largest:.4g} degrees"
        )
        lines.append(f"loops close to {self.closure:.1e}, panels meet to {self.apart:.1e} of the extent")
        lines += [event.told(self.joints) for event in self.path.events]
        if not self.path.watched:
            lines.append("rank drops on the way were not looked for: there are too many joints")
        if self.path.stopped:
            lines.append(f"stopped: {self.path.stopped}")
        return lines

    def __repr__(self) -> str:
        return f"<Folding: {len(self.path.angles)} frames of {self.sheet!r}>"


def fold(
    sheet: Sheet,
    *,
    drive: Mapping[JointId, float] | None = None,
    along: Mapping[JointId, float] | None = None,
    branch: int | str | None = None,
    frames: int = _FRAMES,
    collisions: bool = False,
    report: Callable[[int], None] | None = None,
) -> Folding:
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

    >>> from math import radians
    >>> corners = ((0, 0), (1, 0), (.5, 1), (-1, 0), (.5, -1))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> sheet = Sheet(5, ((0, 1), (0, 2), (0, 3), (0, 4)), "MVVV", faces, corners)
    >>> folded = fold(sheet, drive={1: radians(90)}, frames=3)
    >>> np.degrees(folded.path.angles[-1]).round(2).tolist(), folded.freedoms
    ([-48.19, 90.0, 48.19, 90.0], 1)
    """
    check_given("fold", sheet, Sheet)
    pattern = prepared(sheet)
    linkage = pattern.linkage
    if not linkage.graph.joints:
        raise UnsolvableError("nothing folds: the sheet has no creases between panels")
    asked = Asked(
        drive=drive or {},
        whole=_WHOLE,
        branch=branch,
        marks=pattern.wanted,
        frames=frames,
        limited=True,
        doubt=pattern.doubt,
        report=report,
        along=along or {},
        events=[_collision(pattern)] if collisions else (),
    )
    driven = driven_from(linkage, pattern.closure, pattern.branches, asked)
    return folding_along(pattern, driven)


def folding_along(pattern: Prepared, driven: Driven) -> Folding:
    """Return a pattern with its vertices in each frame of a motion, as far as panels hold together.

    Parameters
    ----------
    pattern : Prepared
    driven : Driven
        A motion of its linkage.
    """
    sheet, linkage = pattern.sheet, pattern.linkage
    vertices, apart = vertex_places(sheet, pattern.mechanism, linkage, driven.path.angles)
    path = _together(driven.path, apart, pattern.doubt)
    vertices, parted = vertices[: len(path.angles)], float(apart[: len(path.angles)].max())
    return Folding(
        sheet=sheet,
        linkage=linkage,
        branches=pattern.branches,
        branch=driven.branch,
        joints=tuple(linkage.graph.joints),
        path=path,
        driven=driven.goals,
        apart=parted,
        places=vertices,
        repairs=pattern.repairs,
    )


def _together(path: DrivenPath, apart: Floats, doubt: str) -> DrivenPath:
    """Return a path as far as panels agree on the places of vertices.

    Loops close by the axes of creases. One of several pieces that are in line but for rounding has one axis, and
    panels part at the other pieces.
    """
    kept = int(np.argmax(apart > _TOGETHER)) if (apart > _TOGETHER).any() else len(apart)
    if kept == len(apart):
        return path
    told = f"panels come apart by {apart[kept]:.1e} of the extent in frame {kept}: creases between them are bent"
    events = tuple(event for event in path.events if event.frame < kept - 1)
    return replace(path, angles=path.angles[:kept], errors=path.errors[:kept], stopped=told + doubt, events=events)


def _collision(pattern: Prepared) -> Collision:
    """Return what ends a walk before panels of a pattern pass through each other."""
    sheet, mechanism = pattern.sheet, pattern.mechanism

    def places(angles: Floats) -> Floats:
        return vertex_places(sheet, mechanism, pattern.linkage, angles)[0]

    panel_of = {face: panel for panel, faces in enumerate(mechanism.panels) for face in faces}
    of_faces = [panel_of[face] for face in range(len(sheet.faces))]
    return Collision(Panels(sheet.faces, of_faces, places(pattern.linkage.angles[None])[0]), places)
