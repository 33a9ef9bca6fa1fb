"""Any mechanism moved, joints driven: frame by frame, into another configuration, and its frames as tables.

A mechanism is in another configuration in a frame of its file, or when it was moved until joints have stated angles.
Tables are comma-separated, one row per axis or vertex and frame; lengths are in the unit of the coordinates, angles in
degrees. Theory: docs/theory/moving.md.
"""

import csv
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from io import StringIO
from math import degrees
from types import MappingProxyType
from typing import Literal, NamedTuple, overload

import numpy as np

from graphs.convert.conversions import Mechanism
from graphs.errors import InvariantError, UnsolvableError, check_argument, numbered, shown
from graphs.files.mechanism_like import MechanismLike, mechanism_for
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import Frames, Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.tolerances import DOUBLE
from graphs.types import JointId
from synth.analysis.folding.configuration import SheetConfiguration
from synth.analysis.motion.driven_motion import MotionOptions
from synth.analysis.motion.linkage import moved
from synth.analysis.motion.motion import FRAMES, Motion, SheetMotion, motion_of
from synth.analysis.moving._configuration_of import Movable, configuration_of, sheet_of


@overload
def move(
    mechanism: Sheet | SheetConfiguration,
    *,
    drive: Mapping[JointId, float] | None = ...,
    along: Mapping[JointId, float] | None = ...,
    branch: int | str | None = ...,
    frames: int = ...,
    collisions: bool = ...,
    precision: float | None = ...,
    report: Callable[[int], None] | None = ...,
) -> SheetMotion: ...


@overload
def move(
    mechanism: Movable,
    *,
    drive: Mapping[JointId, float] | None = ...,
    along: Mapping[JointId, float] | None = ...,
    branch: int | str | None = ...,
    frames: int = ...,
    collisions: bool = ...,
    precision: float | None = ...,
    report: Callable[[int], None] | None = ...,
) -> Motion: ...


def move(
    mechanism: Movable,
    *,
    drive: Mapping[JointId, float] | None = None,
    along: Mapping[JointId, float] | None = None,
    branch: int | str | None = None,
    frames: int = FRAMES,
    collisions: bool = False,
    precision: float | None = None,
    report: Callable[[int], None] | None = None,
) -> Motion:
    """Move a mechanism from its configuration until the driven joints have their angles.

    Parameters
    ----------
    mechanism : Configuration, or anything that `synth.analysis.moving._configuration_of.configuration_of` makes one of
        For a sheet this is `synth.fold`.
    drive : mapping of joint id to float, optional
        Angles, radians, from the zero of each joint: of a crease from flat, of others from the configuration. By
        default the joint that moves most is turned once round, for a sheet as far as it folds.
    along, branch, frames, collisions, precision, report
        As in `synth.fold`: initial rates, motion branch, number of frames, end before a collision, error of a
        coordinate, callback.

    Raises
    ------
    UnsolvableError
        If it has no coordinates, its loops are not closed, or nothing moves, or not with the driven joints.
    InvariantError
        If there is no such joint or branch, or an angle is not finite.

    Examples
    --------
    >>> import numpy as np
    >>> from synth.catalogue.patterns import generate
    >>> motion = move(generate("bennett").mechanism, drive={0: np.pi / 6}, frames=2)
    >>> motion, np.degrees(motion.path.angles[-1, 0]).round(6).tolist(), motion.taken.freedoms
    (<Motion: 3 frames of 4 joints>, 30.0, 1)
    """
    check_argument("move", mechanism, Movable)
    at = configuration_of(mechanism, precision=precision)
    return motion_of(at, MotionOptions(drive or {}, along or {}, branch, frames, report), collisions=collisions)


_Cell = int | float | str
_AXES = ("frame", "joint", "first_link", "second_link", "x", "y", "z", "dx", "dy", "dz", "angle_deg")
_VERTICES = ("frame", "vertex", "x", "y", "z")


def table_text(mechanism: Mechanism, which: str) -> tuple[str, tuple[str, ...]]:
    """Return a table of a mechanism with coordinates, and what it leaves out.

    Parameters
    ----------
    mechanism : Mechanism
        Of a sheet with several frames, the same panels in other configurations are its motion.
    which : {"axes", "vertices"}
        Joint axes: a point, a unit vector and the angle of each, by which the second link is turned against the
        first, right-handed. Or the vertices of its panels.

    Returns
    -------
    text : str
        The first row names the columns.
    lost : tuple of str

    Raises
    ------
    InvariantError
        If there is no such table.
    UnsolvableError
        If it has no coordinates, or, for vertices, no panels.

    Examples
    --------
    >>> square = Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3)), ((0, 0), (2, 0), (2, 2), (0, 2)))
    >>> print(table_text(square, "vertices")[0].splitlines()[:2])
    ['frame,vertex,x,y,z', '0,0,0.0,0.0,0.0']
    """
    if which not in TABLES:
        raise InvariantError("table", f"there is no table {shown(which)}", ", ".join(TABLES))
    columns, rows, lost = TABLES[which]
    sheet = sheet_of(mechanism)
    frames, left_out = ([mechanism], 0) if sheet is None else configurations_of_file(sheet)[::2]
    stream = StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(columns)
    for number, frame in enumerate(frames):
        writer.writerows((number, *row) for row in rows(frame))
    return stream.getvalue(), (lost, *((numbered(left_out, "other frame"),) if left_out else ()))


class FileConfigurations(NamedTuple):
    """The configurations of a sheet in its file, in the order of their motion.

    Attributes
    ----------
    sheets : list of Sheet
    resting : int
        Place of the key frame among them.
    left_out : int
        Number of frames that show other panels.

    Examples
    --------
    >>> square = Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3)), ((0, 0), (2, 0), (2, 2), (0, 2)))
    >>> configurations_of_file(square).resting
    0
    """

    sheets: list[Sheet]
    resting: int
    left_out: int


def configurations_of_file(sheet: Sheet) -> FileConfigurations:
    """Return the configurations of a sheet that the frames of its file hold.

    The key frame is often the first of a motion again, or the last, as in files of `synth.fold`: then it is not
    there twice. Else it comes first.

    Parameters
    ----------
    sheet : Sheet
        As it was read; a sheet without other frames is its only configuration.

    Examples
    --------
    >>> square = Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3)), ((0, 0), (2, 0), (2, 2), (0, 2)))
    >>> len(configurations_of_file(square).sheets)
    1
    """
    if sheet.frames is None:
        return FileConfigurations([sheet], 0, 0)
    key = sheet.frames.first_placed()
    others = [sheet.frames.frame(number) for number in range(1, sheet.frames.others + 1)]
    panels = (key.vertices, key.faces, key.edges)
    same = [
        replace(key, coordinates=other.coordinates, fold_angles=other.fold_angles)
        for other in others
        if other.coordinates is not None and (other.vertices, other.faces, other.edges) == panels
    ]
    left_out = len(others) - len(same)
    for place in (0, len(same) - 1):
        if same and _stand_alike(same[place], key):
            return FileConfigurations(same, place, left_out)
    return FileConfigurations([key, *same], 0, left_out)


def _stand_alike(first: Sheet, second: Sheet) -> bool:
    """Tell whether two frames are one: the first frame of a motion is often the key frame again, to rounding."""
    one, other = (in_space(sheet.coordinates or ()) for sheet in (first, second))
    return bool(np.abs(one - other).max(initial=0.0) <= DOUBLE.same_point * np.ptp(one, axis=0).max(initial=0.0))


def _axes(mechanism: Mechanism) -> Iterator[tuple[_Cell, ...]]:
    linkage = configuration_of(mechanism).linkage
    points = linkage.points * linkage.extent + linkage.middle
    for number, (joint, (first, second)) in enumerate(linkage.graph.joints.items()):
        angle = degrees(float(linkage.angles[number]))
        row = (*points[number].tolist(), *linkage.directions[number].tolist(), angle)
        yield (str(joint), str(first), str(second), *(value + 0.0 for value in row))


def _vertices(mechanism: Mechanism) -> Iterator[tuple[_Cell, ...]]:
    sheet = sheet_of(mechanism)
    if sheet is None or sheet.coordinates is None:
        raise UnsolvableError(f"a table of vertices needs panels with coordinates, and {mechanism!r} has none")
    for number, place in enumerate(in_space(sheet.coordinates).tolist()):
        yield (number, *place)


_Rows = Callable[[Mechanism], Iterator[tuple[_Cell, ...]]]
TABLES: Mapping[str, tuple[tuple[str, ...], _Rows, str]] = MappingProxyType(
    {
        "axes": (_AXES, _axes, "all but joints, their axes and angles"),
        "vertices": (_VERTICES, _vertices, "all but the places of vertices"),
    }
)
"""Name of a table to its columns, what yields its rows, and what it does not hold."""


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
