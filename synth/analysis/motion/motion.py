"""A motion: joints driven from a configuration, all loops closed, frame by frame.

Theory: docs/theory/folding.md, docs/theory/moving.md.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import degrees
from typing import Any

import numpy as np

from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.mechanism.sheet import Sheet
from graphs.printing import Block, Printed, TableBlock
from graphs.tolerances import DOUBLE
from graphs.types import Floats, JointId, LinkId
from synth.analysis.motion.closure import corrected
from synth.analysis.motion.configuration import Configuration, listed
from synth.analysis.motion.driven_motion import DrivenMotion, MotionOptions, driven_from
from synth.analysis.motion.germ import Branch, Branches, Method
from synth.analysis.motion.linkage import Linkage, link_motions, moved
from synth.analysis.motion.path import Path, RestingPanels

FRAMES = 20
"""Frames after the first, by default."""
_LISTED = 12
"""Frames that are named, at most."""
_SEARCHES: dict[Method, str] = {
    "regular pose": "regular configuration",
    "all modes": "all combinations of modes",
    "all solutions": "all solutions of the second-order equations",
    "second order": "second-order search",
    "random starts": "search from random starts",
}


@dataclass(frozen=True, eq=False, repr=False)
class Motion(Printed):
    """A motion of a mechanism: driven joints and all frames.

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
        The angles of the driven joints to reach, radians.
    places : float[F, n, 3]
        Of the vertices of a sheet in each frame, else of a point on each axis, in the unit of the coordinates.
    apart : float
        Largest distance between the places of a vertex by two panels, in units of the extent.
    crossing : tuple of int
        Numbers of the frames in which panels pass through each other.
    resting : RestingPanels, optional
        Panels that lie on each other in the last frame; None if none do.

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
    crossing: tuple[int, ...] = ()
    resting: RestingPanels | None = None

    @property
    def linkage(self) -> Linkage:
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
        """Degrees of freedom of the branch that was taken."""
        return None if self.taken is None else self.taken.freedoms

    @property
    def closure(self) -> float:
        """The largest loop-closure residual of all frames."""
        return self.path.error

    def frames(self) -> Sequence[Sheet] | Sequence[Linkage]:
        """Return the mechanism in each frame, all of one kind: sheets with fold angles (`SheetMotion`), or linkages."""
        return [moved(self.linkage, angles) for angles in self.path.angles]

    def sheets(self) -> list[Sheet]:
        """Return the sheet in each frame: `frames` of what has panels, typed so.

        Raises
        ------
        UnsolvableError
            If it has no panels.

        Examples
        --------
        >>> import synth
        >>> [sheet.fold_angles is None for sheet in synth.fold(synth.generate("miura").mechanism, frames=1).sheets()]
        [False, False]
        """
        raise UnsolvableError("frames are sheets of a crease pattern only, and this mechanism has no panels")

    def path_of(self, link: LinkId, point: Sequence[float]) -> Floats:
        """Return where a point of a link is in each frame, the first link held: a coupler curve, float[F, 3].

        Parameters
        ----------
        link : link id
        point : sequence of 2 or 3 floats
            Where the point is in the initial configuration, in the unit of the coordinates.

        Raises
        ------
        InvariantError
            If there is no such link, or the point has another number of coordinates.

        Examples
        --------
        >>> import synth
        >>> motion = synth.move(synth.generate("bennett").mechanism, frames=3)
        >>> motion.path_of(1, (0.0, 0.0, 1.0)).shape
        (4, 3)
        """
        if link not in self.linkage.graph:
            raise InvariantError("link", f"{shown(link)} is no link", "a link id")
        place = np.zeros(3)
        if len(point) not in (2, 3):
            raise InvariantError("point", f"{len(point)} coordinates", "two or three")
        place[: len(point)] = point
        rotation, shift = link_motions(self.linkage, self.path.angles)[link]
        local = (place - self.linkage.middle) / self.linkage.extent
        return np.asarray((rotation @ local + shift) * self.linkage.extent + self.linkage.middle)

    def beside_thin(self) -> tuple[Floats, float] | None:
        """Return the angles of the thin sheet beside those of solid panels; None for other mechanisms.

        Returns
        -------
        (float[F, J], float) or None
            The nearest fold angles, radians, at which the thin sheet closes in each frame, and its largest
            loop-closure residual at the angles of the solids.

        Examples
        --------
        >>> import synth
        >>> miura = synth.generate("miura", rows=2, columns=2).mechanism
        >>> motion = synth.move(synth.thicken(miura, thickness=0.05, collisions=False).solids, frames=3)
        >>> angles, residual = motion.beside_thin()
        >>> angles.shape, residual < 1e-9
        ((4, 4), True)
        """
        thin = self.configuration.thin
        if thin is None:
            return None
        nearest = np.array([corrected(thin, angles).angles for angles in self.path.angles])
        return nearest, max(thin.error(angles) for angles in self.path.angles)

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        branches, taken, reading = self.branches, self.taken, self.configuration.reading
        columns = zip(self.joints, np.degrees(self.path.angles.T).tolist(), strict=True)
        return {
            "configuration": self.configuration.to_json(taken),
            "freedoms": self.freedoms,
            "certainty": None if taken is None else taken.certainty,
            "branches": None if branches is None else [one.to_json(self.joints) for one in branches.branches],
            "exhaustive": None if branches is None else branches.exhaustive,
            **(dict.fromkeys(("count", "at_least", "proved")) if branches is None else branches.count_to_json()),
            "search": None if branches is None else branches.method,
            "branch": self.branch,
            "driven": {str(joint): degrees(angle) for joint, angle in self.driven.items()},
            "frames": len(self.path.angles),
            "closure": self.closure,
            "panels_apart": self.apart,
            "joint_angles_deg": {str(joint): column for joint, column in columns},
            "stopped": self.path.stopped or None,
            "mended": list(self.configuration.mended),
            "assignment": self.configuration.nearest_to_json(),
            "reading": None if reading is None else reading.to_json(),
            "events": [event.to_json(self.joints) for event in self.path.events],
            "ranks_watched": self.path.watched,
            "assignment_kept": self._of_assignment(),
            "crossing_frames": list(self.crossing),
            "resting": None if self.resting is None else self.resting.to_json(),
            **self._thin_to_json(),
        }

    def _thin_to_json(self) -> dict[str, Any]:
        beside = self.beside_thin()
        if beside is None:
            return {}
        columns = zip(self.joints, np.degrees(beside[0].T).tolist(), strict=True)
        return {"thin": {"closure": beside[1], "joint_angles_deg": {str(joint): column for joint, column in columns}}}

    def _lines_beside_thin(self) -> list[Block]:
        """Return the final fold angles of solid panels beside those of the thin sheet."""
        beside = self.beside_thin()
        if beside is None:
            return []
        thin, residual = np.degrees(beside[0]), beside[1]
        solid = np.degrees(self.path.angles)
        same = residual <= self.configuration.tolerances.closed
        which = "those of the thin sheet" if same else "not those of the thin sheet"
        most = f"largest difference {np.abs(solid - thin).max():.2g}°"
        rows = [
            (shown(joint), f"{one + 0.0:.6g}", f"{other + 0.0:.6g}")
            for joint, one, other in zip(self.joints, solid[-1].tolist(), thin[-1].tolist(), strict=True)
        ]
        columns = ("crease", "solids in degrees", "thin sheet in degrees")
        return [
            f"fold angles: {which}, whose loops close at them to {residual:.1g}; {most}",
            TableBlock(columns, rows, columns),
        ]

    def blocks(self) -> list[Block]:
        """Return the lines that are printed."""
        reading = self.configuration.reading
        lines: list[Block] = [reading.warning] if reading is not None and reading.warning else []
        lines.append(self._answer())
        if self.path.stopped:
            lines.append(f"stopped: {self.path.stopped}")
        lines += self._lines_of_branch()
        mismatch = f"; relative vertex mismatch {self.apart:.1e}" if self.configuration.has_panels else ""
        lines.append(f"loop-closure residual {self.closure:.1e}{mismatch}")
        lines += self._lines_beside_thin()
        if not self.configuration.limited:
            ends = zip(self.joints, np.degrees(self.path.angles[-1]), strict=True)
            angles = ", ".join(f"{shown(joint)} = {angle:.6g}°" for joint, angle in ends)
            lines.append(f"final joint angles: {angles}")
        lines += [event.line(self.joints) for event in self.path.events]
        lines += self._lines_of_assignment()
        if self.crossing:
            frames = ", ".join(map(str, self.crossing[:_LISTED])) + (", ..." if self.crossing[_LISTED:] else "")
            lines.append(f"panels pass through each other in frames {frames}; --collisions ends the path before")
        if self.resting is not None:
            lines.append(self.resting.line())
        if not self.path.watched:
            lines.append("did not check for singular configurations on the path: there are too many joints")
        lines += [f"repaired: {repair}" for repair in self.configuration.mended]
        return lines

    def _answer(self) -> str:
        """Return the first line: what was driven, and how far the motion came."""
        to = "towards" if self.path.stopped else "to"
        goals = [f"joint {shown(joint)} {to} {degrees(angle):g}°" for joint, angle in self.driven.items()]
        largest = np.degrees(np.abs(self.path.angles[-1]).max(initial=0.0))
        angle = "fold angle" if self.configuration.limited else "joint angle"
        frames = numbered(len(self.path.angles), "frame")
        return f"drove {', '.join(goals)}: {frames}, largest final {angle} {largest:.4g}°"

    def _of_assignment(self) -> dict[str, Any] | None:
        """Return how the frames keep the mountains and valleys, as plain data; None where nothing is assigned."""
        marks = self.configuration.marks
        if not self.configuration.limited or not marks.any():
            return None
        turned = marks * self.path.angles[1:] if self.configuration.flat else marks * self.path.angles
        sides = [(turned * side < -DOUBLE.zero_rate) for side in (1.0, -1.0)]
        reverse = bool(sides[1].any(axis=0).sum() < sides[0].any(axis=0).sum())
        against = sides[int(reverse)]
        offset = len(self.path.angles) - len(against)
        first = next((frame + offset for frame, row in enumerate(against) if row.any()), None)
        return {
            "kept": not against.any(),
            "reversed": reverse,
            "first_frame_against": first,
            "against": [self.joints[place] for place in np.flatnonzero(against.any(axis=0)).tolist()],
        }

    def _lines_of_assignment(self) -> list[Block]:
        report = self._of_assignment()
        if report is None:
            return []
        lines: list[Block] = []
        if report["reversed"]:
            lines.append("the assignment is reversed: mountains fold as valleys, valleys as mountains")
        if report["against"]:
            creases = report["against"]
            noun, frame = "crease" if len(creases) == 1 else "creases", report["first_frame_against"]
            lines.append(f"against the assignment, from frame {frame} on: {noun} {listed(creases)}")
        return lines

    def _lines_of_branch(self) -> list[Block]:
        branches, taken = self.branches, self.taken
        if branches is None or taken is None:
            return []
        which = "" if branches.regular else f"branch {self.branch}: "
        if taken.freedoms is None:
            freedoms = "degrees of freedom unknown"
        else:
            evidence = "not proved" if taken.certainty == "not known" else taken.certainty
            freedoms = f"{numbered(taken.freedoms, 'degree of freedom', 'degrees of freedom')} ({evidence})"
        lines: list[Block] = [f"{which}{freedoms}; signs {taken.signs}"]
        if not branches.regular:
            flat = self.configuration.flat
            kind, start = ("folding branch", "the flat state") if flat else ("motion branch", "this configuration")
            all_found = "all there are" if branches.exhaustive else "not proved exhaustive"
            more = "" if branches.complete else "; there may be many more"
            count = ("at least " if branches.at_least else "") + numbered(branches.count, kind, f"{kind}es")
            apart = f"; {len(branches.parts)} separate parts" if branches.parts else ""
            lines.append(f"{count} from {start} ({_SEARCHES[branches.method]}{apart}; {all_found}{more})")
        if self.configuration.disagreeing:
            lines.append(self.configuration.disagreeing)
        return lines

    def __repr__(self) -> str:
        return f"<Motion: {numbered(len(self.path.angles), 'frame')} of {numbered(len(self.joints), 'joint')}>"


@dataclass(frozen=True, eq=False, repr=False)
class SheetMotion(Motion):
    """A motion of a crease pattern: its frames are sheets.

    Attributes are those of `Motion`.

    Examples
    --------
    >>> import synth
    >>> synth.fold(synth.generate("miura").mechanism, frames=1).frames()[-1]
    <Sheet: 9 faces, 12 creases, 16 vertices, in space>
    """

    def frames(self) -> list[Sheet]:
        """Return the sheet in each frame, with coordinates in space and fold angles."""
        every = zip(self.path.angles, self.places, strict=True)
        frames = (self.configuration.at(angles, points) for angles, points in every)
        return [frame for frame in frames if isinstance(frame, Sheet)]

    def sheets(self) -> list[Sheet]:
        """Return the sheet in each frame, as `frames`."""
        return self.frames()


def motion_of(configuration: Configuration, options: MotionOptions, *, collisions: bool = False) -> Motion:
    """Return the motion from a configuration; with `collisions` it ends before panels pass through each other.

    Raises `UnsolvableError` if nothing moves, or not with the driven joints, or there are no panels to collide;
    `InvariantError` if there is no such joint or branch, or an angle is out of range.
    """
    if not configuration.joints:
        missing = "the sheet has no creases between panels" if configuration.limited else "there are no joints"
        raise UnsolvableError(f"rigid: {missing}")
    if options.branch is not None:  # it may exist only with other vertices within the precision
        configuration, branch = configuration.of_branch(options.branch)
        options = replace(options, branch=branch)
    if collisions:
        options = replace(options, events=(*options.events, configuration.collision()))
    motion = motion_along(configuration, driven_from(configuration, options))
    return _before_crossing(motion) if collisions and motion.crossing else motion


def _before_crossing(motion: Motion) -> Motion:
    """Return a motion until panels come to lie on each other in no order: where they lie still, none cross before."""
    kept = max(motion.crossing[0], 1)
    event = next(event for event in motion.path.events if event.kind == "collision")
    path = motion.path.up_to(kept)
    stopped = "panels pass through each other" + (" at the start" if motion.crossing[0] == 0 else "")
    event = replace(event, frame=kept - 1)
    path = replace(path, stopped=f"{stopped}: {event.line(motion.joints)}", events=(*path.events, event))
    resting = motion.resting if kept == len(motion.path.angles) else None
    return replace(motion, path=path, places=motion.places[:kept], crossing=(), resting=resting)


def motion_along(configuration: Configuration, driven: DrivenMotion) -> Motion:
    """Return a motion with its points in each frame, until panels part at creases that rounding has bent."""
    path = driven.path
    points, apart = configuration.placed(path.angles)
    if (apart > DOUBLE.same_point).any():
        kept = int(np.argmax(apart > DOUBLE.same_point))
        reason = f"panels come apart by {apart[kept]:.1e} of the extent in frame {kept}"
        stopped = f"{reason}: creases between them are bent{configuration.doubt}"
        path = replace(path.up_to(kept), stopped=stopped)
    kept = len(path.angles)
    passed = configuration.passed(path, points[:kept], driven.places[0])
    far = float(apart[:kept].max(initial=0.0))
    places = points[:kept]
    kind = SheetMotion if configuration.has_panels else Motion
    return kind(configuration, driven.branch, passed.path, driven.goals, places, far, passed.frames, passed.resting)
