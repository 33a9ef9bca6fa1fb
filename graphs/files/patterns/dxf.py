"""Crease patterns as DXF: lines by the names of their layers, or else by their colours.

A file is pairs of lines, a group code and a value: *DXF Reference*, Autodesk. A pair with the code 0 begins a
record; records are in sections. Only text is read. It is not read by ezdxf, which refuses polylines without
subclass markers and tables without heads, and mends broken files without a word. Written is DXF R12 (AC1009), the
form that every program takes, with CONTINUOUS lines: machines cut along dashes dash by dash. R12 states no unit;
the remark does.
"""

import re
from collections.abc import Iterable, Iterator, Sequence
from colorsys import hsv_to_rgb
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from math import atan, ceil, cos, hypot, pi, radians, sin
from pathlib import Path
from typing import NamedTuple

import numpy as np

from graphs.convert.tracing import MOST, Lines
from graphs.errors import FileError, UnsolvableError, shown
from graphs.files.patterns.legend import LEFT_OUT, UNSTATED, Dash, Legend, Rgb, Stroke, dash_of_line_type
from graphs.files.patterns.lines import traced_sheet
from graphs.files.text import Checker, read_text
from graphs.mechanism.precision import flat_places
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.printing import plain

_CODE = re.compile(r"[ \t]*-?[0-9]{1,4}[ \t]*")
_BREAK = re.compile(r"\r\n|\n|\r")


@dataclass(frozen=True)
class Record:
    """A record of a DXF file with its groups (code, value); path and line, that of its start, are for messages."""

    section: str
    name: str
    groups: tuple[tuple[int, str], ...]
    path: Path
    line: int

    def word(self, code: int, default: str = "") -> str:
        """Return the first value of a group code."""
        return next((value for held, value in self.groups if held == code), default)

    def number(self, code: int, default: str | None = None) -> float:
        """Return the first value of a group code as a coordinate; FileError if it is none."""
        value = self.word(code, "" if default is None else default)
        if not value:
            raise self.fault(f"no group {code}")
        return self.as_number(code, value)

    def whole(self, code: int, default: int) -> int:
        """Return the first value of a group code as a whole number: flags, numbers of colours."""
        value = self.word(code, str(default))
        if re.fullmatch(r"[-+]?\d{1,9}", value) is None:
            raise self.fault(f"group {code} is {shown(value)}", "a whole number")
        return int(value)

    def as_number(self, code: int, value: str) -> float:
        """Return a value of the record as a number; FileError if it is no coordinate."""
        try:
            number = float(value)
        except ValueError:
            raise self.fault(f"group {code} is {shown(value)}", "a number") from None
        if not abs(number) < MOST:
            raise self.fault(f"group {code} is a number that is not finite, or too large", "a coordinate")
        return number

    def fault(self, found: str, expected: str = "a DXF record as R12 has it") -> FileError:
        """Return an error at the place of the record."""
        return FileError(self.path, f"{self.name} at line {self.line}", found, expected)


def records(text: str, path: Path) -> Iterator[Record]:
    """Yield the records of a DXF text that are in sections; a FileError names the line if it is not DXF."""
    section, name, begun = "", "", 0
    groups: list[tuple[int, str]] = []
    for line, code, value in _pairs(text, path):
        if code != 0:
            groups.append((code, value))
            continue
        if name == "SECTION":
            section = next((held for number, held in groups if number == 2), "")
        elif name == "ENDSEC":
            section = ""
        elif section and name:
            yield Record(section, name, tuple(groups), path, begun)
        name, begun, groups = value, line, []
    if name != "EOF":
        raise FileError(path, "", "it does not end with EOF", "a whole DXF file")


def _pairs(text: str, path: Path) -> Iterator[tuple[int, int, str]]:
    """Yield line numbers, codes and values."""
    lines = _BREAK.split(text)
    while lines and not lines[-1].strip():
        lines.pop()
    for at in range(0, len(lines), 2):
        if _CODE.fullmatch(lines[at]) is None:
            raise FileError(path, f"line {at + 1}", shown(lines[at].strip()), "a group code of DXF")
        if at + 1 == len(lines):
            raise FileError(path, f"line {at + 1}", "a group code without a value", "a whole DXF file")
        yield at + 1, int(lines[at]), lines[at + 1].strip()


Point = tuple[float, float]
DrawnShape = tuple[Record, list[tuple[Point, Point]] | None]
"""A record and its pieces; None for a record that is no known shape."""

_PIECES = 8  # straight pieces of a bulge and of a quarter circle: they stay within half a percent of the radius
_CLOSED = 1  # bit 1 of group 70 (DXF reference, POLYLINE)
# Bits of group 70 for curves in space, nets of surfaces and meshes: none is a row of creases.
_FLAT_POLYLINE = 8 | 16 | 64
_Corner = tuple[Point, float]
"""A corner of a polyline, and the bulge of the side after it: the tangent of a quarter of its angle."""


def drawn_shapes(records: Sequence[Record]) -> Iterator[DrawnShape]:
    """Yield the shapes among the records of the section ``ENTITIES``."""
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
            flags = record.whole(70, 0)
            in_plane = not flags & _FLAT_POLYLINE and _seen_from_above(record)
            yield record, _of_polyline(corners, closed=bool(flags & _CLOSED)) if in_plane else None
        else:
            yield record, _pieces(record)


def _pieces(record: Record) -> list[tuple[Point, Point]] | None:
    """Return the pieces of a shape of one record."""
    if record.name == "LINE":
        return [(_point(record, 10), _point(record, 11))]
    if not _seen_from_above(record):
        return None
    if record.name == "LWPOLYLINE":
        return _of_polyline(_corners(record), closed=bool(record.whole(70, 0) & _CLOSED))
    if record.name in ("CIRCLE", "ARC"):
        whole = record.name == "CIRCLE"
        start = 0.0 if whole else record.number(50)
        turn = 360.0 if whole else (record.number(51) - start) % 360.0 or 360.0
        return list(pairwise(_on_circle(_point(record, 10), record.number(40), radians(start), radians(turn))))
    return None


def _seen_from_above(record: Record) -> bool:
    """Return whether a shape lies in the plane of the drawing, not mirrored."""
    return (record.number(210, "0"), record.number(220, "0"), record.number(230, "1")) == (0.0, 0.0, 1.0)


def _point(record: Record, code: int) -> Point:
    """Return a point, which must be at height 0."""
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
    """Return a side of a polyline; an arc in pieces."""
    if start == end:
        return []
    if bulge == 0:
        return [(start, end)]
    turn = 4 * atan(bulge)
    # The centre of the circle is this far left of the chord, in chord lengths.
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


_FIRST = bytes.fromhex("ff0000 ffff00 00ff00 00ffff 0000ff ff00ff 000000 808080 c0c0c0")
"""Colours 1 to 9; 7 is black on white paper."""
_GREYS = {250: 51, 251: 91, 252: 132, 253: 173, 254: 214, 255: 255}
# Brightness of the five shades of a hue in the AutoCAD colour index, the darkest last.
_VALUES = (1.0, 0.65, 0.5, 0.3, 0.15)


@lru_cache(maxsize=300)
def rgb_of_number(number: int) -> Rgb | None:
    """Return a numbered colour; None if there is none."""
    if 1 <= number <= 9:
        red, green, blue = _FIRST[3 * number - 3 : 3 * number]
        return red, green, blue
    if number in _GREYS:
        return (_GREYS[number],) * 3
    if not 10 <= number < 250:
        return None
    # From 10 on each ten is a hue, 15 degrees from the last; odd numbers are pale.
    hue, shade = divmod(number - 10, 10)
    red, green, blue = (round(255 * part) for part in hsv_to_rgb(hue / 24, 1.0 - shade % 2 / 2, _VALUES[shade // 2]))
    return red, green, blue


_LONGEST_WORDS = 250  # letters of a text: release 12, which we write, allows 255 bytes


@dataclass(frozen=True, slots=True)
class DxfLayer:
    """A layer: its name, and the number of its colour (1 red, 2 yellow, 3 green, 5 blue, 6 magenta, 7 black)."""

    name: str
    colour: int


@dataclass(frozen=True, slots=True)
class DxfLine:
    """A line on a layer."""

    layer: str
    start: tuple[float, float]
    end: tuple[float, float]


@dataclass(frozen=True, slots=True)
class DxfWord:
    """A word on a layer: where its left end or its middle is, at half its height."""

    layer: str
    at: tuple[float, float]
    words: str
    size: float
    middle: bool


def dxf_of(
    layers: Sequence[DxfLayer], lines: Sequence[DxfLine], words: Iterable[DxfWord] = (), *, remark: str = ""
) -> str:
    """Return the DXF text of lines and words on layers; the remark is the first line of the file."""
    pairs: list[tuple[int, object]] = [(999, plain(remark, _LONGEST_WORDS))] if remark else []
    pairs += [(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1009"), *_extent(lines), (0, "ENDSEC")]
    pairs += [(0, "SECTION"), (2, "TABLES"), *_LINE_TYPES, *_layers(layers), *_STYLES, (0, "ENDSEC")]
    pairs += [(0, "SECTION"), (2, "BLOCKS"), (0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")]
    for line in lines:
        pairs += [(0, "LINE"), (8, line.layer), *_point_pairs(10, line.start), *_point_pairs(11, line.end)]
    for word in words:
        align = 1 if word.middle else 0
        pairs += [(0, "TEXT"), (8, word.layer), *_point_pairs(10, word.at), (40, float(word.size))]
        pairs += [(1, plain(word.words, _LONGEST_WORDS)), (72, align), *_point_pairs(11, word.at), (73, 2)]
    pairs += [(0, "ENDSEC"), (0, "EOF")]
    return "".join(f"{code}\n{value}\n" for code, value in pairs)


_LINE_TYPES: list[tuple[int, object]] = [
    *((0, "TABLE"), (2, "LTYPE"), (70, 1), (0, "LTYPE"), (2, "CONTINUOUS"), (70, 0), (3, "Solid line")),
    *((72, 65), (73, 0), (40, 0.0), (0, "ENDTAB")),
]
_STYLES: list[tuple[int, object]] = [
    *((0, "TABLE"), (2, "STYLE"), (70, 1), (0, "STYLE"), (2, "STANDARD"), (70, 0), (40, 0.0), (41, 1.0)),
    *((50, 0.0), (71, 0), (42, 2.5), (3, "txt"), (4, ""), (0, "ENDTAB")),
]


def _point_pairs(code: int, at: tuple[float, float]) -> list[tuple[int, object]]:
    return [(code, float(at[0])), (code + 10, float(at[1])), (code + 20, 0.0)]


def _extent(lines: Sequence[DxfLine]) -> list[tuple[int, object]]:
    ends = [end for line in lines for end in (line.start, line.end)] or [(0.0, 0.0)]
    low, high = ((pick(x for x, _ in ends), pick(y for _, y in ends)) for pick in (min, max))
    return [(9, "$EXTMIN"), *_point_pairs(10, low), (9, "$EXTMAX"), *_point_pairs(10, high)]


def _layers(layers: Sequence[DxfLayer]) -> list[tuple[int, object]]:
    rows: list[tuple[int, object]] = [(0, "TABLE"), (2, "LAYER"), (70, len(layers) + 1)]
    for layer in (DxfLayer("0", 7), *layers):
        rows += [(0, "LAYER"), (2, layer.name), (70, 0), (62, layer.colour), (6, "CONTINUOUS")]
    return [*rows, (0, "ENDTAB")]


_NAMES = {
    "B": "border borders boundary outline edge edges contour",
    "C": "cut cuts cutting",
    "M": "mountain mountains mountain_folds m",
    "V": "valley valleys valley_folds v",
    "F": "flat facet auxiliary aux",
    "J": "join joins",
    "U": "crease creases fold folds score hinge unassigned",
}
_LETTERS = {name: letter for letter, names in _NAMES.items() for name in names.split()}
_NOTES = ("TEXT", "MTEXT", "DIMENSION", "LEADER", "POINT", "HATCH", "VIEWPORT", "ATTDEF", "IMAGE")
"""Records that are no lines of a drawing, and are left out without a note."""
_WRITTEN = {
    "B": DxfLayer("BORDER", 7),
    "C": DxfLayer("CUT", 3),
    "M": DxfLayer("MOUNTAIN", 1),
    "V": DxfLayer("VALLEY", 5),
    "F": DxfLayer("FLAT", 2),
    "J": DxfLayer("JOIN", 2),
    "U": DxfLayer("UNASSIGNED", 6),
}
_BY_BLOCK = 0  # number of no colour: that of the block in which a shape is
_BY_LAYER = 256  # number of no colour: that of the layer, and what a shape without a colour has
_PAPER_SPACE = 67  # group code: 1 is for shapes of the printed sheet (frames, titles), which are no creases
_LONGEST_NAME = 40  # letters of names in messages: files of others have layers with paths of files in their names
_BORDER = "border lines (a layer CUT or BORDER, or black)"


class _Layer(NamedTuple):
    """The look that shapes of a layer take from it."""

    colour: int = 7
    line_type: str = "CONTINUOUS"


_PLAIN = _Layer()


def sheet_from_dxf(path: Path, legend: Legend = UNSTATED) -> Sheet:
    """Read the lines of a DXF file and trace its faces; the legend has the stated assignments of strokes."""
    check = Checker(path)
    all_records = list(records(read_text(path), path))
    layers = {
        record.word(2): _Layer(record.whole(62, 7), record.word(6, "CONTINUOUS"))
        for record in all_records
        if (record.section, record.name) == ("TABLES", "LAYER")
    }
    drawn = list(drawn_shapes([record for record in all_records if record.section == "ENTITIES"]))
    strokes = [_stroke(record, layers.get(record.word(8), _PLAIN), pieces) for record, pieces in drawn]
    understood = check.build(lambda: legend.understood(strokes))
    ends: list[tuple[tuple[float, float], tuple[float, float]]] = []
    letters = ""
    for (_, pieces), letter in zip(drawn, understood.letters, strict=True):
        if pieces is not None and letter is not None and letter != LEFT_OUT:
            ends += pieces
            letters += letter * len(pieces)
    array = np.array(ends, dtype=float).reshape(-1, 2, 2)
    if not np.all(np.abs(array) < MOST):
        raise FileError(path, "", "an arc that is too large", "coordinates")
    return traced_sheet(Lines(array, letters), check, border=_BORDER, understood=understood)


def _stroke(record: Record, layer: _Layer, pieces: Sequence[object] | None) -> Stroke:
    """Return the look of a record; hidden ones and notes have no colour, and count as no lines."""
    colour, name = _colour(record, layer), record.word(8, "0")
    kind = _kind(record, layer, shape=pieces is not None)
    hidden = colour < 0 or record.whole(_PAPER_SPACE, 0) != 0
    if hidden or pieces is None:
        return Stroke(None, kind=kind, lines=int(not hidden and record.name not in _NOTES))
    true = record.whole(420, -1)
    rgb = (true >> 16 & 255, true >> 8 & 255, true & 255) if true >= 0 else rgb_of_number(colour)
    letter = _LETTERS.get(name.lower())
    return Stroke(rgb, _dash(record, layer), (name,), None if true >= 0 else colour, letter, kind, len(pieces))


def _colour(record: Record, layer: _Layer) -> int:
    """Return the number of a shape's colour; below zero if its layer is off."""
    colour = record.whole(62, _BY_LAYER)
    if layer.colour < 0:
        return layer.colour
    return {_BY_LAYER: layer.colour, _BY_BLOCK: _PLAIN.colour}.get(colour, colour)


def _dash(record: Record, layer: _Layer) -> Dash:
    own = record.word(6, "BYLAYER").upper()
    return dash_of_line_type(layer.line_type if own == "BYLAYER" else own)


def _kind(record: Record, layer: _Layer, *, shape: bool) -> str:
    """Describe the look of a record, for messages about those left out."""
    name = plain(record.name, _LONGEST_NAME)
    if not shape:
        return name
    dash = _dash(record, layer)
    if dash != "solid":
        name = f"{dash} {name}"
    return f"{name} of colour {_colour(record, layer)} on layer {plain(record.word(8, '0'), _LONGEST_NAME)}"


def dxf_text(sheet: Sheet) -> str:
    """Return the DXF text (R12) of a flat sheet, a layer for each assignment."""
    places = flat_places(sheet, "a DXF crease pattern")
    if not (sheet.edges or sheet.faces):
        raise UnsolvableError("a DXF crease pattern needs lines, and the sheet has none")
    sheet = with_all_edges(sheet)
    lines = [
        DxfLine(_WRITTEN[letter].name, places[a], places[b])
        for (a, b), letter in zip(sheet.edges, sheet.assignments, strict=True)
    ]
    return dxf_of(list(_WRITTEN.values()), lines)
