"""Axes and vertices of a thing as tables of comma-separated values, a row for each in each frame of its motion.

Lengths are in the unit of the coordinates, angles in degrees. Theory: docs/theory/moving.md.
"""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from io import StringIO
from math import degrees
from types import MappingProxyType

import numpy as np

from graphs.convert.table import Mechanism
from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import Sheet
from graphs.tolerances import DOUBLE
from synth.moving.made import configuration_of, sheet_of

__all__ = ["TABLES", "table_text"]

_Cell = int | float | str
_AXES = ("frame", "joint", "first_link", "second_link", "x", "y", "z", "dx", "dy", "dz", "angle_deg")
_VERTICES = ("frame", "vertex", "x", "y", "z")


def table_text(thing: Mechanism, which: str) -> tuple[str, tuple[str, ...]]:
    """Return a table of a thing with coordinates, and what it does not hold.

    Parameters
    ----------
    thing : Mechanism
        Of a sheet with several frames, the same panels in other poses are its motion.
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
        raise InvariantError("table", f"the table {shown(which)} is not known", ", ".join(TABLES))
    columns, rows, lost = TABLES[which]
    poses, left_out = _poses(thing)
    stream = StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(columns)
    for number, pose in enumerate(poses):
        writer.writerows((number, *row) for row in rows(pose))
    return stream.getvalue(), (lost, *((numbered(left_out, "other frame"),) if left_out else ()))


def _poses(thing: Mechanism) -> tuple[list[Mechanism], int]:
    """Return a thing in each frame of its motion, and how many frames show something else."""
    sheet = sheet_of(thing)
    if sheet is None or sheet.frames is None:
        return [thing], 0
    first = sheet.frames.first_placed()
    others = [sheet.frames.frame(number) for number in range(1, sheet.frames.others + 1)]
    same = [
        replace(first, coordinates=one.coordinates, fold_angles=one.fold_angles)
        for one in others
        if one.coordinates is not None
        and (one.vertices, one.faces, one.edges) == (first.vertices, first.faces, first.edges)
    ]
    shown_first = bool(same) and _stand_alike(same[0], first)
    poses: list[Mechanism] = [*([] if shown_first else [first]), *same]
    return poses, 1 + len(others) - len(poses) - shown_first


def _stand_alike(first: Sheet, second: Sheet) -> bool:
    """Tell whether two poses are one: the first frame of a motion is often the key frame again, to rounding."""
    one, other = (in_space(sheet.coordinates or ()) for sheet in (first, second))
    return bool(np.abs(one - other).max(initial=0.0) <= DOUBLE.same_point * np.ptp(one, axis=0).max(initial=0.0))


def _axes(thing: Mechanism) -> Iterator[tuple[_Cell, ...]]:
    linkage = configuration_of(thing).linkage
    points = linkage.points * linkage.extent + linkage.middle
    for number, (joint, (first, second)) in enumerate(linkage.graph.joints.items()):
        angle = degrees(float(linkage.angles[number]))
        row = (*points[number].tolist(), *linkage.directions[number].tolist(), angle)
        yield (str(joint), str(first), str(second), *(one + 0.0 for one in row))


def _vertices(thing: Mechanism) -> Iterator[tuple[_Cell, ...]]:
    sheet = sheet_of(thing)
    if sheet is None or sheet.coordinates is None:
        raise UnsolvableError(f"a table of vertices needs panels with coordinates, and {thing!r} has none")
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
