"""A mechanism in another configuration: a frame of its file, or moved until joints have stated angles.

Theory: docs/theory/moving.md.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import degrees
from typing import Literal

from graphs.convert.table import Mechanism
from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.files.accepted import MechanismLike, mechanism_for
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sheet import Frames, Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.tolerances import DOUBLE
from graphs.types import JointId
from synth.motion.linkage import moved
from synth.motion.motion import Motion
from synth.moving.made import sheet_of
from synth.moving.motion import move


@dataclass(frozen=True, slots=True)
class _SingleFrame:
    """The one configuration of a sheet that was taken from a file of several, with the unit of the file."""

    sheet: Sheet
    unit: str | None
    others: int = 0
    left_out: tuple[str, ...] = ()

    def frame(self, number: int) -> Sheet:
        """Return the sheet; there is no other frame."""
        if number:
            raise InvariantError("frames", f"no frame {number}", "0: it was taken from its file alone")
        return self.sheet

    def first_placed(self) -> Sheet:
        """Return the sheet."""
        return self.sheet


def in_configuration(
    mechanism: MechanismLike,
    frame: int | Literal["last"] | None = None,
    *,
    angles: Mapping[JointId, float] | None = None,
    precision: float | None = None,
) -> Mechanism:
    """Return a mechanism in another configuration than that of its file.

    Parameters
    ----------
    mechanism : Mechanism, str or Path
        With coordinates.
    frame : int or "last", optional
        A frame of a FOLD file: 0 is the key frame.
    angles : mapping of joint id to float, optional
        Angles of joints, radians, from the zero of each: of a crease from flat, valleys positive, of another joint
        from the configuration of the file. The other joints follow as in `synth.move`, on the branch that it takes.
    precision : float, optional
        The error that a coordinate may have, in their unit.

    Returns
    -------
    Mechanism
        A sheet for a sheet, a model for a model of rods, else solids hinged along the axes where they are then.

    Raises
    ------
    InvariantError
        If there is no such frame or joint.
    UnsolvableError
        If it has no coordinates, or the joints do not come to these angles.

    Examples
    --------
    >>> from math import degrees, pi
    >>> import synth
    >>> miura = synth.generate("miura", rows=2, columns=2).mechanism
    >>> folded = in_configuration(miura, angles={1: -pi / 3})
    >>> folded, round(degrees(folded.fold_angles[1]), 9)
    (<Sheet: 4 faces, 4 creases, 9 vertices, in space>, -60.0)
    """
    read: Mechanism = mechanism_for("in_configuration", mechanism, Mechanism)
    frames = read.frames if isinstance(read, Sheet) else None
    if frame is not None:
        read = _in_frame(read, frames, frame)
    if not angles:
        return read
    motion = move(read, drive=angles, precision=precision)
    _check_reached(motion, angles)
    return _with_unit(_at_the_end(read, motion), frames)


def _in_frame(mechanism: Mechanism, frames: Frames | None, frame: int | Literal["last"]) -> Mechanism:
    """Return the sheet of a frame."""
    if frames is None:
        raise InvariantError("frames", "the file has no frames", "a .fold file, or the angle of a joint")
    return _with_unit(frames.frame(frames.others if frame == "last" else frame), frames)


def _with_unit(mechanism: Mechanism, frames: Frames | None) -> Mechanism:
    """Return a sheet that still knows the unit of its file."""
    if frames is None or not isinstance(mechanism, Sheet):
        return mechanism
    return mechanism.with_frames(_SingleFrame(mechanism, frames.unit))


def _check_reached(motion: Motion, angles: Mapping[JointId, float]) -> None:
    """Raise UnsolvableError where a joint does not have its angle at the end."""
    ends = dict(zip(motion.joints, motion.path.angles[-1].tolist(), strict=True))
    for joint, angle in motion.driven.items():
        if abs(ends[joint] - angle) > DOUBLE.same_configuration:
            reached = f"joint {shown(joint)} comes to {degrees(ends[joint]):.6g}°, not to {degrees(angle):g}°"
            raise UnsolvableError(f"{reached}: {motion.path.stopped or 'the motion ends there'}")


def _at_the_end(mechanism: Mechanism, motion: Motion) -> Mechanism:
    """Return a mechanism as it is in the last frame of its motion."""
    at, angles = motion.configuration, motion.path.angles[-1]
    if sheet_of(mechanism) is not None:
        sheet = at.at(angles, motion.places[-1])
        assert isinstance(sheet, Sheet)
        return sheet
    if isinstance(mechanism, PolyhedronModel):
        return _model_at_the_end(mechanism, motion)
    there = moved(at.linkage, angles)
    points = there.points * there.extent + there.middle
    lines = zip(points.tolist(), there.directions.tolist(), strict=True)
    return HingedSolids(there.graph, dict(zip(at.joints, lines, strict=True)))


def _model_at_the_end(model: PolyhedronModel, motion: Motion) -> PolyhedronModel:
    """Return a model of rods with the places of its vertices in the last frame."""
    places = {}
    for rod, ends in enumerate(model.edges):
        for vertex in ends:
            if vertex not in places:
                places[vertex] = tuple(motion.path_of(rod, model.coordinates[vertex])[-1].tolist())
    return PolyhedronModel(list(model.nodes), list(model.edges), coordinates=places)
