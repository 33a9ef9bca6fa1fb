"""Lines, polylines and arcs of a DXF file as straight pieces."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import atan, ceil, cos, hypot, pi, radians, sin

from graphs.files.patterns.dxf.records import Record

__all__ = ["Drawn", "drawn_shapes"]

Point = tuple[float, float]
Drawn = tuple[Record, list[tuple[Point, Point]] | None]
"""A record and its pieces; None of a record that is no shape which is understood."""

_PIECES = 8
"""Straight pieces of a bulge of a polyline, and of a quarter of a circle."""
_CLOSED = 1
_FLAT_POLYLINE = 8 | 16 | 64
"""Flags of polylines that are curves in space or meshes."""
_Corner = tuple[Point, float]
"""Where a corner of a polyline is, and the bulge of the side after it: the tangent of a quarter of its angle."""


def drawn_shapes(records: Sequence[Record]) -> Iterator[Drawn]:
    """Yield the shapes among the records of the section ``ENTITIES``.

    A FileError names the record if a number is missing or invalid, or points are at several heights.

    >>> from pathlib import Path
    >>> groups = ((10, "0"), (20, "0"), (11, "3"), (21, "4"))
    >>> [pieces for _, pieces in drawn_shapes([Record("ENTITIES", "LINE", groups, Path("a.dxf"), 1)])]
    [[((0.0, 0.0), (3.0, 4.0))]]
    """
    at = 0
    while at < len(records):
        record = records[at]
        at += 1
        if record.name == "POLYLINE":
            corners = []
            while at < len(records) and records[at].name == "VERTEX":
                corners.append((_point(records[at], 10), records[at].number(42, "0")))
                at += 1
            at += at < len(records) and records[at].name == "SEQEND"
            meant = not record.whole(70, 0) & _FLAT_POLYLINE and _seen_from_above(record)
            yield record, _of_polyline(corners, closed=bool(record.whole(70, 0) & _CLOSED)) if meant else None
        else:
            yield record, _pieces(record)


def _pieces(record: Record) -> list[tuple[Point, Point]] | None:
    """Return the pieces of a shape that is one record."""
    if record.name == "LINE":
        return [(_point(record, 10), _point(record, 11))]
    if not _seen_from_above(record):
        return None
    if record.name == "LWPOLYLINE":
        return _of_polyline(_corners(record), closed=bool(record.whole(70, 0) & _CLOSED))
    if record.name in ("CIRCLE", "ARC"):
        whole = record.name == "CIRCLE"
        start, end = (0.0, 360.0) if whole else (record.number(50), record.number(51))
        turn = 360.0 if whole else (end - start) % 360.0 or 360.0
        return list(pairwise(_on_circle(_point(record, 10), record.number(40), radians(start), radians(turn))))
    return None


def _seen_from_above(record: Record) -> bool:
    """Tell whether a shape lies in the plane of the drawing, not mirrored."""
    return (record.number(210, "0"), record.number(220, "0"), record.number(230, "1")) == (0.0, 0.0, 1.0)


def _point(record: Record, code: int) -> Point:
    """Return a point; those that are not at height 0 are no crease pattern."""
    if record.number(code + 20, "0") != 0:
        raise record.fault(f"a point at height {record.number(code + 20):g}", "height 0: a crease pattern is flat")
    return record.number(code), record.number(code + 10)


def _corners(record: Record) -> list[_Corner]:
    """Return the corners of a polyline of one record, whose groups come in turn."""
    corners: list[_Corner] = []
    for code, value in record.groups:
        if code == 10:
            corners.append(((record.as_number(code, value), 0.0), 0.0))
        elif code in (20, 42) and corners:
            (x, y), bulge = corners[-1]
            number = record.as_number(code, value)
            corners[-1] = ((x, number), bulge) if code == 20 else ((x, y), number)
    return corners


def _of_polyline(corners: Sequence[_Corner], *, closed: bool) -> list[tuple[Point, Point]]:
    sides = list(pairwise(corners))
    if closed and len(corners) > 2:
        sides.append((corners[-1], corners[0]))
    return [piece for (start, bulge), (end, _) in sides for piece in _side(start, end, bulge)]


def _side(start: Point, end: Point, bulge: float) -> list[tuple[Point, Point]]:
    """Return a side of a polyline, in pieces where it is an arc."""
    if start == end:
        return []
    if bulge == 0:
        return [(start, end)]
    turn = 4 * atan(bulge)
    # The middle of the circle is so far left of the chord, in chords.
    left = (1 / bulge - bulge) / 4
    wide, high = end[0] - start[0], end[1] - start[1]
    centre = ((start[0] + end[0]) / 2 - left * high, (start[1] + end[1]) / 2 + left * wide)
    arm = (start[0] - centre[0], start[1] - centre[1])
    inner = [_turned(centre, arm, turn * part / _PIECES) for part in range(1, _PIECES)]
    return list(pairwise([start, *inner, end]))


def _turned(centre: Point, arm: Point, angle: float) -> Point:
    x, y = arm
    return centre[0] + x * cos(angle) - y * sin(angle), centre[1] + x * sin(angle) + y * cos(angle)


def _on_circle(centre: Point, radius: float, start: float, turn: float) -> list[Point]:
    """Return points of an arc, the last one the first again where it is a circle."""
    number = max(1, ceil(_PIECES * turn / (pi / 2) - 1e-9))
    arm = (radius * cos(start), radius * sin(start))
    points = [_turned(centre, arm, turn * part / number) for part in range(number + 1)]
    if hypot(points[0][0] - points[-1][0], points[0][1] - points[-1][1]) <= 1e-12 * abs(radius):
        points[-1] = points[0]
    return points
