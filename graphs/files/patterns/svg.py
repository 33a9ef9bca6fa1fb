"""Crease patterns as SVG in origami colours (:mod:`graphs.files.patterns.strokes`).

Shapes, transforms and styles are read by svgelements; curves become polylines.
"""

from __future__ import annotations

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
from graphs.files.patterns.strokes import COLOURS, described_strokes, kind_of_stroke, letter_of_stroke
from graphs.files.patterns.svg_work import check_work_of_svg
from graphs.files.patterns.traced import traced_sheet
from graphs.files.text import read_text
from graphs.mechanism.plane import flat_places
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.plain_text import plain

__all__ = ["sheet_from_svg", "svg_text"]

_LONGEST_TITLE = 1_000
_DECIMALS = 12
"""Of fold angles in degrees: what is finer comes of dividing by 180."""
_PIECES = 8
"""Straight pieces of a curved segment."""


def sheet_from_svg(path: Path) -> Sheet:
    """Read the lines of an SVG file and trace its faces.

    Raise FileError also if the lines make no pattern (:mod:`graphs.files.patterns.traced`).
    """
    ends: list[Any] = []
    letters: list[str] = []
    angles: list[float | None] = []
    unread: Counter[str] = Counter()
    for shape in _stroked_shapes(path):
        letter = letter_of_stroke(shape)
        if letter is None:
            unread[kind_of_stroke(shape)] += 1
            continue
        try:
            with np.errstate(all="ignore"):  # what is not finite is refused below
                pieces = _pieces(shape)
        except (ValueError, TypeError, IndexError, AttributeError, ArithmeticError) as error:
            raise FileError(path, "", f"a shape cannot be drawn: {shown(str(error))}", "SVG shapes") from None
        ends += pieces
        letters += letter * len(pieces)
        angles += [_fold_angle(letter, _opacity(shape))] * len(pieces)
    array = np.array(ends, dtype=float).reshape(-1, 2, 2) * (1, -1)  # y points down in SVG
    if not np.all(np.abs(array) < MOST):
        raise FileError(path, "", "a coordinate that is not finite, or too large", "coordinates")
    left_out = described_strokes(unread)
    sheet = traced_sheet(
        Lines(array, "".join(letters), tuple(angles)),
        Checker(path),
        border="border lines (black strokes)",
        unread=f"; {left_out}" if left_out else "",
    )
    return replace(sheet, repairs=(*sheet.repairs, *([left_out] if left_out else [])))


def _stroked_shapes(path: Path) -> Iterator[Any]:
    """Yield the shapes of an SVG file that have a stroke, transforms applied."""
    import svgelements

    text = read_text(path)
    try:
        check_work_of_svg(text, path)
        drawing = svgelements.SVG.parse(BytesIO(text.encode()), reify=True)
        drawn = list(drawing.elements()) if isinstance(drawing, svgelements.SVG) else None
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
    for shape in drawn:
        if isinstance(shape, svgelements.Shape) and shape.stroke is not None and shape.stroke.value is not None:
            yield shape


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
