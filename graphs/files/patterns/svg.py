"""Crease patterns as SVG: what strokes stand for is in :mod:`graphs.files.patterns.legend`.

Shapes, transforms and styles are read by svgelements; curves become polylines.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from io import BytesIO
from itertools import pairwise
from math import isfinite
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import ParseError
from xml.sax.saxutils import escape

import numpy as np

from graphs.convert.tracing import MOST
from graphs.convert.welding import Lines
from graphs.errors import FileError, UnsolvableError, shown
from graphs.files.check import Checker
from graphs.files.patterns.css_colours import rgb_of_css
from graphs.files.patterns.legend import LEFT_OUT, UNSTATED, Legend
from graphs.files.patterns.strokes import COLOURS, Stroke, dash_of_lengths, name_of_rgb
from graphs.files.patterns.svg_digits import precision_of_shapes
from graphs.files.patterns.svg_work import check_work_of_svg
from graphs.files.patterns.traced import traced_sheet
from graphs.files.text import read_text
from graphs.mechanism.precision import flat_places
from graphs.mechanism.sheet import Sheet, sides_of_face, with_all_edges
from graphs.printing import plain

__all__ = ["sheet_from_svg", "svg_text"]

_LONGEST_TITLE = 1_000
_DECIMALS = 12
"""Of fold angles in degrees: what is finer comes of dividing by 180."""
_LONGEST_LOOK = 40
_NAMES = (
    "class",
    "id",
    "data-name",
    "{http://www.inkscape.org/namespaces/inkscape}label",
)
"""Attributes with names of groups, layers and shapes: of Illustrator, of Inkscape."""
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,3})?")
_PIECES = 8
"""Straight pieces of a curved segment."""


def sheet_from_svg(path: Path, legend: Legend = UNSTATED) -> Sheet:
    """Read the lines of an SVG file and trace its faces; the legend says what strokes are, where that was stated.

    Raise FileError also if the lines make no pattern (:mod:`graphs.files.patterns.traced`), or most are not
    understood.
    """
    check = Checker(path)
    shapes = list(_stroked_shapes(path))
    strokes = [_stroke(shape, names) for shape, names in shapes]
    understood = check.build(lambda: legend.understood(strokes))
    ends: list[Any] = []
    letters: list[str] = []
    angles: list[float | None] = []
    drawn: list[Any] = []
    for (shape, _), letter in zip(shapes, understood.letters, strict=True):
        if letter is None or letter == LEFT_OUT:
            continue
        try:
            with np.errstate(all="ignore"):  # what is not finite is refused below
                pieces = _pieces(shape)
        except (ValueError, TypeError, IndexError, AttributeError, ArithmeticError) as error:
            raise FileError(path, "", f"a shape cannot be drawn: {shown(str(error))}", "SVG shapes") from None
        ends += pieces
        drawn.append(shape)
        letters += letter * len(pieces)
        angles += [_fold_angle(letter, _opacity(shape))] * len(pieces)
    array = np.array(ends, dtype=float).reshape(-1, 2, 2) * (1, -1)  # y points down in SVG
    if not np.all(np.abs(array) < MOST):
        raise FileError(path, "", "a coordinate that is not finite, or too large", "coordinates")
    lines = Lines(array, "".join(letters), tuple(angles))
    border = "border lines (black strokes)"
    precision = precision_of_shapes(drawn)
    sheet = traced_sheet(lines, check, border=border, understood=understood, precision=precision)
    return replace(sheet, assignments=_borders_of_cuts(sheet, lines.letters))


def _borders_of_cuts(sheet: Sheet, letters: str) -> str:
    """Return the assignments of a drawing: where nothing is a border, cuts with a face on one side only are."""
    if "B" in letters:
        return sheet.assignments
    sides = Counter(frozenset(side) for face in sheet.faces for side in sides_of_face(face))
    return "".join(
        "B" if letter == "C" and sides[frozenset(edge)] == 1 else letter
        for edge, letter in zip(sheet.edges, sheet.assignments, strict=True)
    )


def _stroked_shapes(path: Path) -> Iterator[tuple[Any, tuple[str, ...]]]:
    """Yield the shapes of an SVG file that have a stroke, transforms applied, with the names of their groups."""
    import svgelements

    text = read_text(path)
    try:
        check_work_of_svg(text, path)
        drawing = svgelements.SVG.parse(BytesIO(text.encode()), reify=True)
        drawn = list(_with_names(drawing)) if isinstance(drawing, svgelements.SVG) else None
    except ParseError as error:
        line, column = error.position
        raise FileError(path, f"line {line} column {column}", "not XML", "SVG") from None
    except FileError:
        raise
    except RecursionError:  # where the limit was raised beyond what Python's stack holds
        raise FileError(path, "", "elements nested more deeply than Python can follow", "fewer groups") from None
    except (ValueError, TypeError, KeyError, IndexError, AttributeError, ArithmeticError) as error:
        raise FileError(path, "", f"not SVG: {shown(str(error))}", "SVG") from None
    if drawn is None:
        raise FileError(path, "", "the outermost element is not svg", "SVG")
    for shape, names in drawn:
        if isinstance(shape, svgelements.Shape) and shape.stroke is not None and shape.stroke.value is not None:
            yield shape, names


def _with_names(drawing: Any) -> Iterator[tuple[Any, tuple[str, ...]]]:
    """Yield what is drawn with the names of itself and of the groups it is in, the innermost first."""
    waiting: list[tuple[Any, tuple[str, ...]]] = [(drawing, ())]
    while waiting:  # without recursion: files nest as deep as they like
        element, outer = waiting.pop()
        values = getattr(element, "values", None) or {}
        own = values if isinstance(element, list) else values.get("attributes") or {}
        names = tuple(str(own[key]) for key in _NAMES if own.get(key))
        names = (*(name for name in names if name not in outer), *outer)
        if isinstance(element, list):
            waiting += [(one, names) for one in reversed(element)]
        else:
            yield element, names


def _stroke(shape: Any, names: tuple[str, ...]) -> Stroke:
    """Return how a shape looks; what svgelements takes for black is read by ourselves."""
    rgb = (int(shape.stroke.red), int(shape.stroke.green), int(shape.stroke.blue))
    written = str(shape.values.get("stroke") or "")
    read = rgb_of_css(written) if written else rgb
    dash = dash_of_lengths(
        [float(word) for word in _NUMBER.findall(str(shape.values.get("stroke-dasharray") or ""))]
    )
    look = "stroke " + plain(written, _LONGEST_LOOK) if read is None else name_of_rgb(read)
    return Stroke(
        read, dash, names, kind=look if dash == "solid" else f"{dash} {look}", lines=_number_of_lines(shape)
    )


def _number_of_lines(shape: Any) -> int:
    """Return how many lines a shape draws, straight or curved."""
    import svgelements

    if isinstance(shape, svgelements.Path):
        return sum(not isinstance(segment, svgelements.Move) for segment in shape)
    if isinstance(shape, svgelements.Polyline | svgelements.Polygon):
        return max(1, len(shape) - isinstance(shape, svgelements.Polyline))
    return 4 if isinstance(shape, svgelements.Rect) else 1


def _opacity(shape: Any) -> float:
    """Return the opacity of a stroke as it is written; the colour holds it rounded to 255 steps."""
    opacity = 1.0
    for key in ("opacity", "stroke-opacity"):
        try:
            opacity *= float(shape.values.get(key, 1) or 0)
        except ValueError:
            return float(shape.stroke.opacity)
    return opacity if isfinite(opacity) else 1.0


def _fold_angle(letter: str, opacity: float) -> float | None:
    """Return the fold angle in degrees that a stroke's opacity stands for: valleys up, mountains down."""
    if letter not in "MV":
        return None
    return round((180 if letter == "V" else -180) * min(max(opacity, 0.0), 1.0), _DECIMALS) + 0.0


def svg_text(sheet: Sheet) -> str:
    """Return the SVG text of a flat sheet, a line for each edge; opacity tells the fold angle, full for 180.

    Raises
    ------
    UnsolvableError
        If the sheet has no coordinates, is not flat, or has no line.

    Examples
    --------
    >>> print(svg_text(Sheet(2, ((0, 1),), "M", (), ((0.0, 0.0), (2.0, 1.0)))).splitlines()[-2])
    <line x1="0.0" y1="1.0" x2="2.0" y2="0.0" stroke="#ff0000"/>
    """
    places = flat_places(sheet, "an SVG crease pattern")
    if not (sheet.edges or sheet.faces):
        raise UnsolvableError("an SVG crease pattern needs lines, and the sheet has none")
    sheet = with_all_edges(sheet)
    left, low = (min((place[k] for place in places), default=0.0) for k in (0, 1))
    right, high = (max((place[k] for place in places), default=0.0) for k in (0, 1))
    width, height = right - left, high - low
    rows = [
        '<svg xmlns="http://www.w3.org/2000/svg" '
        f'viewBox="0 0 {width!r} {height!r}" stroke-width="{max(width, height) / 400:.6g}">'
    ]
    if sheet.title:
        rows.append(f"<title>{escape(plain(sheet.title, _LONGEST_TITLE))}</title>")
    angles = sheet.fold_angles or (None,) * len(sheet.edges)
    for (a, b), letter, angle in zip(sheet.edges, sheet.assignments, angles, strict=True):
        red, green, blue = COLOURS["F" if letter == "J" else letter]
        ends = [(places[v][0] - left, high - places[v][1]) for v in (a, b)]
        opacity = ""
        if angle is not None and letter in "MV" and abs(angle) < 180:
            opacity = f' stroke-opacity="{abs(angle) / 180!r}"'
        rows.append(
            f'<line x1="{ends[0][0]!r}" y1="{ends[0][1]!r}" x2="{ends[1][0]!r}" y2="{ends[1][1]!r}" '
            f'stroke="#{red:02x}{green:02x}{blue:02x}"{opacity}/>'
        )
    return "\n".join([*rows, "</svg>"]) + "\n"


def _pieces(shape: Any) -> list[tuple[tuple[float, float], tuple[float, float]]]:
    """Return the straight pieces of a shape."""
    import svgelements

    pieces = []
    for segment in svgelements.Path(shape):
        if isinstance(segment, svgelements.Move) or segment.start is None or segment.end is None:
            continue
        if isinstance(segment, svgelements.Line | svgelements.Close):
            points = [segment.start, segment.end]
        else:
            points = [segment.point(k / _PIECES) for k in range(_PIECES + 1)]
        places = [(float(point.x), float(point.y)) for point in points]
        pieces += [(a, b) for a, b in pairwise(places) if a != b]
    return pieces
