"""Crease patterns as SVG: what strokes stand for is in :mod:`graphs.files.patterns.legend`.

Shapes, transforms and styles are read by svgelements; curves become polylines.
"""

import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import replace
from io import BytesIO
from itertools import pairwise
from math import hypot, isfinite, pi, radians, sqrt
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree
from xml.etree.ElementTree import ParseError
from xml.sax.saxutils import escape

import numpy as np

from graphs.convert.tracing import MOST, Lines
from graphs.errors import FileError, UnsolvableError, shown
from graphs.files.patterns.legend import (
    COLOURS,
    LEFT_OUT,
    UNSTATED,
    Legend,
    Stroke,
    dash_of_lengths,
    name_of_rgb,
    rgb_of_css,
)
from graphs.files.patterns.lines import traced_sheet
from graphs.files.text import Checker, in_degrees, read_text
from graphs.input_limits import how_to_raise, most
from graphs.mechanism.precision import digits_of, flat_places
from graphs.mechanism.sheet import Sheet, WrittenPrecision, sides_of_face, with_all_edges
from graphs.printing import plain

_LINKS = ("href", "{http://www.w3.org/1999/xlink}href")

_LONG_NUMBER = re.compile(r"[0-9]{101}")


def check_work_of_svg(text: str, path: Path) -> None:
    """Refuse shapes that use shapes too often, or themselves, or nest too deeply, before any is drawn."""
    root = ElementTree.fromstring(text)
    named = {element.get("id"): element for element in root.iter() if element.get("id") is not None}
    drawn: dict[ElementTree.Element, int] = {}
    levels: dict[ElementTree.Element, int] = {}
    waiting, open_ones = [root], set[ElementTree.Element]()
    while waiting:  # depth first, without recursion: files nest as deep as they like
        element = waiting[-1]
        if element in drawn:
            waiting.pop()
            continue
        inner = [*element, *_used(element, named)]
        missing = [child for child in inner if child not in drawn]
        if not missing:
            drawn[element] = 1 + sum(drawn[child] for child in inner)
            levels[element] = 1 + max((levels[child] for child in inner), default=0)
            open_ones.discard(element)
            waiting.pop()
            continue
        open_ones.add(element)
        if around := [child for child in missing if child in open_ones]:
            raise FileError(path, "", f"the shape {shown(around[0].get('id'))} uses itself", "other shapes")
        waiting += missing
    for element in drawn:
        _check_text(element, path)
    _check(path, "shapes", drawn[root] - len(drawn), "shapes drawn by 'use'")
    _check(path, "levels", levels[root], "levels of elements in elements")


def _check_text(element: ElementTree.Element, path: Path) -> None:
    """Refuse text that the patterns by which svgelements reads it would look through again and again."""
    name = element.tag.rpartition("}")[2]
    for key, value in element.items():
        if key not in (*_LINKS, "id") and _LONG_NUMBER.search(value):
            raise FileError(path, f"{name}: {key}", "a number of more than 100 digits", "coordinates")
        if key == "transform":
            _check(path, "letters", len(value), "letters in a transform")
    if name == "style":
        text = element.text or ""
        _check(path, "letters", len(text), "letters in a style sheet")
        if "{" in text.rpartition("}")[2]:
            raise FileError(path, "style", "a rule that does not end", "'}' after the last rule")


def _check(path: Path, limit: str, needed: int, what: str) -> None:
    if needed > most(limit):
        raise FileError(path, "", f"{needed} {what}", how_to_raise(limit, needed))


def _used(element: ElementTree.Element, named: dict[str | None, ElementTree.Element]) -> list[ElementTree.Element]:
    if element.tag.rpartition("}")[2] != "use":
        return []
    targets = (element.get(key, "").removeprefix("#") for key in _LINKS)
    return [named[target] for target in targets if target in named][:1]


_WRITTEN = {
    "path": ("d",),
    "line": ("x1", "y1", "x2", "y2"),
    "polyline": ("points",),
    "polygon": ("points",),
    "rect": ("x", "y", "width", "height"),
    "circle": ("cx", "cy", "r"),
    "ellipse": ("cx", "cy", "rx", "ry"),
}
"""The attributes with coordinates, by element."""
_UNITS = {"px": 1.0, "pt": 4 / 3, "pc": 16.0, "mm": 96 / 25.4, "cm": 96 / 2.54, "in": 96.0}
_LENGTH = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)(px|pt|pc|mm|cm|in)?")
_COMMAND = re.compile(r"([MLHVCSQTAZmlhvcsqtaz])([^MLHVCSQTAZmlhvcsqtaz]*)")
_TO_A_STEP = {"h": 1, "v": 1, "c": 6, "s": 4, "q": 4, "a": 7}
"""Numbers of each step of a relative command; of the others two."""
_FUNCTION = re.compile(r"([a-zA-Z]+)\s*\(([^)]*)\)")
_SHIFT = slice(4, None)
# Decimals: entries of a matrix with fewer are turns by 0, 90 or 180 degrees and scales chosen by hand, hence exact.
_ROUNDED = 4


class _Shape(NamedTuple):
    """The numbers of a shape, by the factor of their unit; how many errors add up; its transform."""

    numbers: dict[float, list[float]]
    steps: int
    transform: str
    reach: float


def precision_of_shapes(shapes: Iterable[Any]) -> WrittenPrecision | None:
    """Return the precision of written shapes of svgelements, in the unit of the drawing; None if nothing says it.

    Errors of the numbers of relative commands are independent, so they add up as the root of their number.
    """
    written = [_as_written(shape) for shape in shapes]
    of_unit: defaultdict[float, list[float]] = defaultdict(list)
    for shape in written:
        for unit, numbers in shape.numbers.items():
            of_unit[unit] += numbers
    digits = {unit: digits_of(numbers, float(np.ptp(numbers)) / 2.0) for unit, numbers in of_unit.items()}
    transforms = {shape.transform for shape in written}
    of_matrices, of_shifts = _last_decimal(transforms, "matrix", slice(4), _ROUNDED), _last_shift(transforms)
    worst, source = 0.0, ""
    for shape in written:
        errors = [(row.error * unit, row.source) for unit in shape.numbers if (row := digits[unit]) is not None]
        length, why = max(errors, default=(0.0, ""))
        error = length * sqrt(shape.steps) * _stretch(shape.transform)
        error += _error_of_transform(shape.transform, of_matrices * shape.reach, of_shifts)
        if error > worst:
            worst, source = error, why or "digits of a transform"
    return WrittenPrecision(worst, source) if worst > 0.0 else None


def _as_written(shape: Any) -> _Shape:
    values = shape.values
    words = [str(values.get(name) or "") for name in _WRITTEN.get(str(values.get("tag")), ())]
    numbers: defaultdict[float, list[float]] = defaultdict(list)
    reach = 0.0
    for word in words:
        for number, unit in _LENGTH.findall(word):
            factor = _UNITS.get(unit, 1.0)
            numbers[factor].append(float(number))
            reach = max(reach, abs(float(number)) * factor)
    around = str(values.get("viewport_transform") or "")
    transform = str(values.get("transform") or "").removeprefix(around)
    if "scale" in around or "matrix" in around:
        # A view box moves all shapes alike; the digits of its size are not written, but those of a division.
        transform = f"scale({_stretch(around):.3g}) {transform}"
    steps = _steps(words[0]) if values.get("tag") == "path" and words else 1
    return _Shape(dict(numbers), steps, transform, reach)


def _steps(path: str) -> int:
    """Return the most numbers in turn that are relative to the last, and so add up their errors."""
    most = steps = 0
    for letter, numbers in _COMMAND.findall(path):
        if letter in "Zz":
            continue
        many = len(_LENGTH.findall(numbers))
        steps = steps + many // _TO_A_STEP.get(letter, 2) if letter.islower() else 1
        most = max(most, steps)
    return max(most, 1)


def _functions(transform: str) -> Iterator[tuple[str, list[str], str]]:
    """Yield the functions of a transform, the texts of their numbers, and the functions before each."""
    for match in _FUNCTION.finditer(transform):
        yield match[1].lower(), [number for number, _ in _LENGTH.findall(match[2])], transform[: match.start()]


def _error_of_transform(transform: str, of_matrices: float, of_shifts: float) -> float:
    """Return how far off a shape is drawn for the last digits of the matrices and shifts of its transform."""
    error = 0.0
    for name, numbers, before in _functions(transform):
        if name == "matrix" and len(numbers) == 6:
            error += _stretch(before) * (of_matrices + of_shifts)
        elif name == "translate":
            error += _stretch(before) * of_shifts
    return error


def _last_shift(transforms: set[str]) -> float:
    """Return half of what the last decimal of shifts is worth; 0 where all shapes are shifted alike."""
    if len(transforms) < 2:
        return 0.0
    shifts = [_last_decimal(transforms, "matrix", _SHIFT, 1), _last_decimal(transforms, "translate", slice(2), 1)]
    return min((shift for shift in shifts if shift), default=0.0)


def _last_decimal(transforms: set[str], function: str, part: slice, least: int) -> float:
    """Return half of what the last decimal of a function is worth; 0 of fewer decimals than the least."""
    numbers = [
        number
        for transform in transforms
        for name, row, _ in _functions(transform)
        if name == function
        for number in row[part]
    ]
    decimals = max((len(text.partition(".")[2]) for text in numbers if "e" not in text.lower()), default=0)
    return 0.5 * 10.0**-decimals if decimals >= least else 0.0


def _stretch(transform: str) -> float:
    """Return how much longer a transform makes a length, at most."""
    import svgelements

    matrix = svgelements.Matrix(transform)
    a, b, c, d = (float(x) for x in (matrix.a, matrix.b, matrix.c, matrix.d))
    # The larger singular value: half the sums of lengths of what turns and what mirrors.
    return (hypot(a + d, b - c) + hypot(a - d, b + c)) / 2.0


_BORDER = "border lines (black strokes)"
_LONGEST_TITLE = 1_000  # letters: a title is a line above the drawing; a FOLD file may have a story there
_DECIMALS = 12  # of fold angles in degrees: an opacity times 180 has rounding in the next, and 45 should read 45
_LONGEST_LOOK = 40  # letters of a stroke quoted in a message: some files have whole style sheets in it
_NAMES = ("class", "id", "data-name", "{http://www.inkscape.org/namespaces/inkscape}label")
"""Attributes with names of groups, layers and shapes: of Illustrator, of Inkscape."""
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,3})?")
_PIECES = 8  # straight pieces of a curve: a quarter circle stays within half a percent of its radius


def sheet_from_svg(path: Path, legend: Legend = UNSTATED) -> Sheet:
    """Read the lines of an SVG file and trace its faces; the legend has the stated assignments of strokes."""
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
            with np.errstate(all="ignore"):  # numbers that are not finite are refused below
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
    lines, precision = Lines(array, "".join(letters), tuple(angles)), precision_of_shapes(drawn)
    sheet = traced_sheet(lines, check, border=_BORDER, understood=understood, precision=precision)
    return replace(sheet, assignments=_borders_of_cuts(sheet, lines.letters))


def _borders_of_cuts(sheet: Sheet, letters: str) -> str:
    """Return the assignments of a drawing: without borders, cuts with a face on one side only are borders."""
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
    except RecursionError:  # the limit was raised beyond Python's stack
        raise FileError(path, "", "elements nested more deeply than Python can follow", "fewer groups") from None
    except (ValueError, TypeError, KeyError, IndexError, AttributeError, ArithmeticError) as error:
        raise FileError(path, "", f"not SVG: {shown(str(error))}", "SVG") from None
    if drawn is None:
        raise FileError(path, "", "the outermost element is not svg", "SVG")
    for shape, names in drawn:
        if isinstance(shape, svgelements.Shape) and shape.stroke is not None and shape.stroke.value is not None:
            yield shape, names


def _with_names(drawing: Any) -> Iterator[tuple[Any, tuple[str, ...]]]:
    """Yield drawn elements with their names and those of their groups, the innermost first."""
    waiting: list[tuple[Any, tuple[str, ...]]] = [(drawing, ())]
    while waiting:  # without recursion: files nest as deep as they like
        element, outer = waiting.pop()
        values = getattr(element, "values", None) or {}
        own = values if isinstance(element, list) else values.get("attributes") or {}
        names = tuple(str(own[key]) for key in _NAMES if own.get(key))
        names = (*(name for name in names if name not in outer), *outer)
        if isinstance(element, list):
            waiting += [(child, names) for child in reversed(element)]
        else:
            yield element, names


def _stroke(shape: Any, names: tuple[str, ...]) -> Stroke:
    """Return the look of a shape; svgelements takes unknown colours for black, so colours are read here."""
    written = str(shape.values.get("stroke") or "")
    stroke = shape.stroke
    rgb = rgb_of_css(written) if written else (int(stroke.red), int(stroke.green), int(stroke.blue))
    lengths = _NUMBER.findall(str(shape.values.get("stroke-dasharray") or ""))
    dash = dash_of_lengths([float(length) for length in lengths])
    look = "stroke " + plain(written, _LONGEST_LOOK) if rgb is None else name_of_rgb(rgb)
    kind = look if dash == "solid" else f"{dash} {look}"
    return Stroke(rgb, dash, names, kind=kind, lines=_number_of_lines(shape))


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
    """Return the fold angle that a stroke's opacity stands for: valleys up, mountains down."""
    if letter not in "MV":
        return None
    return radians(round((180 if letter == "V" else -180) * min(max(opacity, 0.0), 1.0), _DECIMALS) + 0.0)


def svg_text(sheet: Sheet) -> str:
    """Return the SVG text of a flat sheet, a line for each edge; full opacity is half a turn."""
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
        if angle is not None and letter in "MV" and abs(angle) < pi:
            opacity = f' stroke-opacity="{abs(in_degrees(angle)) / 180!r}"'
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
