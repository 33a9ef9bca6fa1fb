"""What was repaired when a drawing was read, on the crease pattern it became: a sign for each, at its place."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from graphs.mechanism.sheet import Reading, RepairKind, Sheet
from synth.drawing.mechanisms.creases import DrawnPattern, Overlay
from synth.drawing.scene.palette import NORMAL, STRONG
from synth.drawing.scene.shapes import Disc, Line, Point, Polygon, Shape

__all__ = ["overlay_of_repairs"]

_SIZE = 3.5
"""Half the size of a sign, points."""


def overlay_of_repairs(sheet: Sheet) -> Overlay:
    """Return the signs of what was done to a drawing; of a sheet that was not traced there are none.

    Signs are told apart by their shapes as well as their colours, and each kind is told with its sign.
    """
    reading = sheet.reading or Reading()
    repairs = [repair for repair in reading.repairs if repair.places]

    def shapes(drawn: DrawnPattern) -> list[Shape]:
        found = [
            shape
            for repair in repairs
            for place in repair.places
            for shape in _SIGNS[repair.kind][0](drawn.frame.row(place))
        ]
        return sorted(found, key=lambda shape: not isinstance(shape, Line))  # signs of points are seen above lines

    said = [f"{repair.what} ({_SIGNS[repair.kind][1]})" for repair in repairs]
    if reading.left_out:
        said.append(reading.left_out)
    beyond = tuple(point for repair in repairs for place in repair.places for point in place)
    return Overlay("repairs", shapes, tuple(said) or ("nothing was repaired when it was read",), beyond=beyond)


def _ring(points: list[Point]) -> list[Shape]:
    return [Disc(points[0], _SIZE, None, "class2", STRONG)]


def _square(points: list[Point]) -> list[Shape]:
    return [_outlined(points[0], ((-1, -1), (1, -1), (1, 1), (-1, 1)), "class1")]


def _triangle(points: list[Point]) -> list[Shape]:
    return [_outlined(points[0], ((0, -1.2), (1.1, 0.8), (-1.1, 0.8)), "class0")]


def _diamond(points: list[Point]) -> list[Shape]:
    return [_outlined(points[0], ((0, -1.1), (1.1, 0), (0, 1.1), (-1.1, 0)), "class6")]


def _cross(points: list[Point]) -> list[Shape]:
    (x, y), size = points[0], _SIZE
    ends = [[(x - size, y - size), (x + size, y + size)], [(x - size, y + size), (x + size, y - size)]]
    return [Line(row, "class7", STRONG) for row in ends]


def _band(points: list[Point]) -> list[Shape]:
    return [Line(points, "class5", 3 * STRONG)]


def _dotted(points: list[Point]) -> list[Shape]:
    return [Line(points, "class3", 2 * STRONG, (STRONG, 2 * STRONG))]


def _area(points: list[Point]) -> list[Shape]:
    return [Polygon(points, "class4", "class4", NORMAL, 0.35)]


def _outlined(at: Point, corners: tuple[tuple[float, float], ...], colour: str) -> Shape:
    return Polygon([(at[0] + _SIZE * x, at[1] + _SIZE * y) for x, y in corners], None, colour, STRONG)


_SIGNS: Mapping[RepairKind, tuple[Callable[[list[Point]], list[Shape]], str]] = {
    "crossing split": (_ring, "green rings"),
    "line split at an end": (_triangle, "blue triangles"),
    "ends welded": (_square, "orange squares"),
    "line drawn twice": (_band, "light blue bands"),
    "line of no length": (_cross, "purple crosses"),
    "line pruned": (_dotted, "pink dotted lines"),
    "vertex taken out": (_diamond, "brown diamonds"),
    "hole": (_area, "yellow areas"),
}
"""What makes the sign of a repair of its points on the page, and what it is called."""
