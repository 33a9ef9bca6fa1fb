"""A piece that is larger than a page, in tiles that overlap, with crosses that meet."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import ceil

from synth.templates.lines import Piece, Point, Stroke, Text
from synth.templates.marks import cross, frame
from synth.templates.paper import FOOTER, MARGIN, OVERLAP

__all__ = ["Tile", "clipped", "tiles_across", "tiles_of"]

_ALONG = (0.2, 0.8)
"""Where crosses are on an overlap, as parts of its length."""
_TINY = 1e-9


@dataclass(frozen=True)
class Tile:
    """The part of a larger piece that a page shows, in millimetres from the corner of the page.

    The strokes of the piece end at the border of the tile; the frame and the crosses are added. `where` is column
    and row, for the caption.
    """

    strokes: tuple[Stroke, ...]
    texts: tuple[Text, ...]
    where: str


def tiles_across(size: tuple[float, float], window: tuple[float, float]) -> tuple[int, int]:
    """Return how many columns and rows of windows cover a box, neighbours overlapping; all in millimetres.

    >>> tiles_across((500, 100), (190, 261))
    (3, 1)
    """
    wide, high = (
        1 if side <= most else ceil((side - OVERLAP) / (most - OVERLAP) - _TINY)
        for side, most in zip(size, window, strict=True)
    )
    return wide, high


def tiles_of(piece: Piece, window: tuple[float, float], name: str = "") -> Iterator[Tile]:
    """Yield the tiles of a piece, row by row from the top left, without those that it does not reach.

    The lower left corner of the piece is the origin; `window` is (width, height) of a tile in millimetres. `name`
    is that of the piece if several have tiles.
    """
    from shapely import box

    counts = tiles_across(piece.size, window)
    sides = zip(counts, piece.size, window, strict=True)
    # All tiles together have the piece in their middle.
    starts = [(side - (count * (most - OVERLAP) + OVERLAP)) / 2 for count, side, most in sides]
    steps = [side - OVERLAP for side in window]
    crosses = list(_crosses(counts, starts, window, name))
    for row in reversed(range(counts[1])):
        for column in range(counts[0]):
            corner = (starts[0] + column * steps[0], starts[1] + row * steps[1])
            area = (*corner, corner[0] + window[0], corner[1] + window[1])
            if not piece.covered.intersects(box(*area)):
                continue
            strokes = [kept for stroke in piece.strokes if (kept := clipped(stroke, area)) is not None]
            texts = [text for text in piece.texts if _holds(area, text.at)]
            for at, label in crosses:
                if _holds(area, at):
                    arms, text = cross(at, label)
                    strokes += arms
                    texts.append(text)
            right, up = MARGIN - corner[0], MARGIN + FOOTER - corner[1]
            yield Tile(
                (*(one.moved(right, up) for one in strokes), *frame(window)),
                tuple(replace(one, at=(one.at[0] + right, one.at[1] + up)) for one in texts),
                f"{f'piece {name}, ' if name else ''}column {column + 1} of {counts[0]} from the left, "
                f"row {counts[1] - row} of {counts[1]} from the top",
            )


def clipped(stroke: Stroke, area: tuple[float, float, float, float]) -> Stroke | None:
    """Return the part of a stroke in an area (left, low, right, high); None if it has no length.

    The method is that of Liang and Barsky.

    >>> clipped(Stroke("CUT", (-5, 0), (5, 10)), (0, 0, 20, 8))
    Stroke(kind='CUT', start=(0.0, 5.0), end=(3.0, 8.0))
    """
    start, end = stroke.start, stroke.end
    first, last = 0.0, 1.0
    for axis in (0, 1):
        way = end[axis] - start[axis]
        low, high = area[axis] - start[axis], area[axis + 2] - start[axis]
        if way == 0:
            if low > 0 or high < 0:
                return None
            continue
        enter, leave = sorted((low / way, high / way))
        first, last = max(first, enter), min(last, leave)
    if last - first <= _TINY:
        return None

    def at(part: float) -> Point:
        return start[0] + part * (end[0] - start[0]), start[1] + part * (end[1] - start[1])

    # An end that is not cut off stays as it is, to the last digit.
    return Stroke(stroke.kind, at(first) if first > 0 else start, at(last) if last < 1 else end)


def _crosses(
    counts: tuple[int, int], starts: list[float], window: tuple[float, float], name: str
) -> Iterator[tuple[Point, str]]:
    """Yield crosses in the overlaps of neighbouring tiles, in the middle across, with their names."""
    number = 0
    for axis in (0, 1):
        other = 1 - axis
        for seam in range(1, counts[axis]):
            across = starts[axis] + seam * (window[axis] - OVERLAP) + OVERLAP / 2
            for place in range(counts[other]):
                for part in _ALONG:
                    along = starts[other] + place * (window[other] - OVERLAP) + part * window[other]
                    number += 1
                    yield ((across, along) if axis == 0 else (along, across)), name + _letters(number)


def _letters(number: int) -> str:
    """Return A, B, ..., Z, AA, ... for 1, 2, ...: numbers are for edges that are glued."""
    letters = ""
    while number:
        number, place = divmod(number - 1, 26)
        letters = chr(ord("A") + place) + letters
    return letters


def _holds(area: tuple[float, float, float, float], at: Point) -> bool:
    return area[0] <= at[0] <= area[2] and area[1] <= at[1] <= area[3]
