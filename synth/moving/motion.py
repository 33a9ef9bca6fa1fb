"""Any mechanism moved from its configuration, joints driven, frame by frame; and its frames as tables.

Tables are comma-separated, one row per axis or vertex and frame; lengths are in the unit of the coordinates,
angles in degrees. Theory: docs/theory/moving.md.
"""

import csv
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from io import StringIO
from math import degrees
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from graphs.convert.table import Mechanism
from graphs.errors import InvariantError, UnsolvableError, check_argument, numbered, shown
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import Sheet
from graphs.tolerances import DOUBLE
from graphs.types import JointId
from synth.motion.driving import MotionOptions
from synth.motion.motion import FRAMES, Motion, motion_of
from synth.moving.made import Movable, configuration_of, sheet_of


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
    mechanism : Configuration, or anything that `synth.moving.made.configuration_of` makes one of
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
    >>> from synth.patterns import generate
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
    poses, left_out = ([mechanism], 0) if sheet is None else poses_of_file(sheet)[::2]
    stream = StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(columns)
    for number, pose in enumerate(poses):
        writer.writerows((number, *row) for row in rows(pose))
    return stream.getvalue(), (lost, *((numbered(left_out, "other frame"),) if left_out else ()))


class FilePoses(NamedTuple):
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
    >>> poses_of_file(square).resting
    0
    """

    sheets: list[Sheet]
    resting: int
    left_out: int


def poses_of_file(sheet: Sheet) -> FilePoses:
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
    >>> len(poses_of_file(square).sheets)
    1
    """
    if sheet.frames is None:
        return FilePoses([sheet], 0, 0)
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
            return FilePoses(same, place, left_out)
    return FilePoses([key, *same], 0, left_out)


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
