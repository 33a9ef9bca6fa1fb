"""Pieces put on pages: whole, several on a page, or in tiles that overlap. Nothing is ever scaled to fit."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import ceil, prod
from operator import le
from textwrap import wrap

import numpy as np

from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.printing import plain
from graphs.types import Floats
from synth.making.drawing.scene.shapes import Label, Layer, Line, moved, part_in_box, scaled
from synth.making.drawing.scene.writing import Scene
from synth.making.templates.pieces import LOOKS, Kind, Piece, Point, TemplateLine, Text
from synth.making.templates.template import Template

MARGIN = 10.0
"""Millimetres of each side of a page on which nothing is printed: what printers leave free."""
FOOTER = 20.0
"""Millimetres at the foot of a page, above the margin, for the gauge and what the lines mean."""
OVERLAP = 10.0
"""Millimetres by which tiles on pages that meet overlap."""
_SIZES = {"a4": (210.0, 297.0), "a3": (297.0, 420.0), "letter": (215.9, 279.4)}
_SHORTEST_SIDE, _LONGEST_SIDE = 130.0, 5000.0
_WIDEST = 1000
"""Letters of a line of text, at most."""
_NUMBER = r"(\d{1,4}(?:\.\d{1,3})?)"


@dataclass(frozen=True)
class Paper:
    """A size of paper.

    Parameters
    ----------
    width, height : float
        Millimetres.

    Raises
    ------
    InvariantError
        If a side is shorter than 130 mm, which has no room for the gauge, or longer than 5 m.

    Examples
    --------
    >>> Paper(210, 297).window
    (190.0, 257.0)
    """

    width: float
    height: float

    def __post_init__(self) -> None:
        if not all(_SHORTEST_SIDE <= side <= _LONGEST_SIDE for side in (self.width, self.height)):
            paper = f"paper of {self.width:g} x {self.height:g} mm"
            raise InvariantError("paper", paper, f"sides from {_SHORTEST_SIDE:g} to {_LONGEST_SIDE:g} mm")

    @property
    def window(self) -> tuple[float, float]:
        """Width and height of what a page holds of a template: all but margins and footer."""
        return self.width - 2 * MARGIN, self.height - 2 * MARGIN - FOOTER

    def turned(self) -> Paper:
        """Return the same paper turned by a quarter."""
        return Paper(self.height, self.width)


def paper_named(name: str) -> Paper:
    """Return the paper of a name: A4, A3, Letter, or WIDTHxHEIGHT in millimetres.

    Parameters
    ----------
    name : str
        In any case of letters.

    Returns
    -------
    Paper

    Raises
    ------
    InvariantError
        If it is none of these.

    Examples
    --------
    >>> paper_named("letter"), paper_named("300x200")
    (Paper(width=215.9, height=279.4), Paper(width=300.0, height=200.0))
    """
    if name.lower() in _SIZES:
        return Paper(*_SIZES[name.lower()])
    match = re.fullmatch(f"{_NUMBER}x{_NUMBER}", name.strip().lower())
    if match is None:
        raise InvariantError("paper", f"paper {shown(name)}", "A4, A3, Letter, or WIDTHxHEIGHT in mm")
    return Paper(float(match[1]), float(match[2]))


@dataclass(frozen=True)
class Page:
    """A page: strokes and texts in millimetres from its lower left corner; the picture, from the upper left one.

    Nothing is cut from the page of assembly: it alone has a picture, and `is_note`.
    """

    paper: Paper
    strokes: tuple[TemplateLine, ...]
    texts: tuple[Text, ...]
    picture: Layer | None = None
    is_note: bool = False

    @property
    def scene(self) -> Scene:
        """The page as a picture in millimetres: a layer for each kind of stroke, for texts, for the picture."""
        # the colour of texts on pages to be cut is that of marks, which no machine cuts
        ink = LOOKS["CUT" if self.is_note else "MARKS"].colour
        layers = layers_of(self.strokes, self.texts, self.paper.height, ink)
        if self.picture is not None:
            layers.append(self.picture)
        return Scene(self.paper.width, self.paper.height, tuple(layers), unit="mm")


def layers_of(strokes: Sequence[TemplateLine], texts: Sequence[Text], height: float, ink: str) -> list[Layer]:
    """Return strokes by their kinds, and texts in an ink, on a page of a height; all in millimetres."""

    def down(at: Point) -> Point:
        return at[0], height - at[1]

    layers = []
    for kind, look in LOOKS.items():
        lines = [
            Line((down(stroke.start), down(stroke.end)), look.colour, look.width, look.dash)
            for stroke in strokes
            if stroke.kind == kind
        ]
        layers.append(Layer(kind, tuple(lines)))
    labels = [
        Label(
            down(text.at), text.words, text.size, ink, "middle" if text.middle else "start", halo=False, widest=_WIDEST
        )
        for text in texts
    ]
    return [layer for layer in (*layers, Layer("TEXT", tuple(labels))) if layer.shapes]


GAUGE = 100.0
"""Length of the gauge, millimetres."""
_TICK, _EACH = 1.5, 10
_ARM = 4.0
_ROWS = (3.0, 8.0, 12.0, 17.0)
"""Heights of gauge, two rows of legend and caption over the margin, millimetres; they fill the footer."""
_GAUGE_TEXT = 2.5


def gauge(at: Point) -> tuple[list[TemplateLine], list[Text]]:
    """Return a ruler of 100 mm with a tick each 10 mm, from its left end on; the first stroke is the gauge."""
    x, y = at
    strokes = [TemplateLine("MARKS", at, (x + GAUGE, y))]
    for tick in range(int(GAUGE) // _EACH + 1):
        place = x + tick * _EACH
        strokes.append(TemplateLine("MARKS", (place, y - _TICK), (place, y + _TICK)))
    return strokes, [Text((x + GAUGE + 2, y), f"{GAUGE:g} mm", _GAUGE_TEXT, middle=False)]


def footer(kinds: Iterable[Kind], caption: str) -> tuple[list[TemplateLine], list[Text]]:
    """Return the foot of a page: gauge, what its kinds of lines mean in words, caption.

    The meaning is in words only: a machine would cut or fold a line drawn to show it.
    """
    shown = set(kinds)
    strokes, texts = gauge((MARGIN, MARGIN + _ROWS[0]))
    meanings = [look.meaning for kind, look in LOOKS.items() if kind in shown and look.meaning]
    legend = ["; ".join(meanings[:2]), "; ".join(meanings[2:])]
    rows = zip(_ROWS[:0:-1], [caption, *legend], strict=True)
    texts += [Text((MARGIN, MARGIN + row), words, _GAUGE_TEXT, middle=False) for row, words in rows if words]
    return strokes, texts


def frame(window: tuple[float, float]) -> list[TemplateLine]:
    """Return the border of what a page shows of a larger piece: pages are laid together with it."""
    left, low = MARGIN, MARGIN + FOOTER
    right, high = left + window[0], low + window[1]
    corners = [(left, low), (right, low), (right, high), (left, high)]
    return [TemplateLine("MARKS", a, b) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]


def cross(at: Point, name: str) -> tuple[list[TemplateLine], Text]:
    """Return a cross with a name: crosses of one name on two pages lie over each other."""
    x, y = at
    strokes = [TemplateLine("MARKS", (x - _ARM, y), (x + _ARM, y)), TemplateLine("MARKS", (x, y - _ARM), (x, y + _ARM))]
    return strokes, Text((x + _ARM / 2, y + _ARM / 2), name, _GAUGE_TEXT)


_ALONG = (0.2, 0.8)
"""Where crosses are on an overlap, as parts of its length."""
_TINY = 1e-9


@dataclass(frozen=True)
class Tile:
    """The part of a larger piece that a page shows, in millimetres from the corner of the page.

    The strokes of the piece end at the border of the tile; the frame and the crosses are added. `where` is column
    and row, for the caption.
    """

    strokes: tuple[TemplateLine, ...]
    texts: tuple[Text, ...]
    where: str


def tiles_across(size: tuple[float, float], window: tuple[float, float]) -> tuple[int, int]:
    """Return how many columns and rows of windows cover a box, neighbours overlapping; all in millimetres."""
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
                (*(stroke.moved(right, up) for stroke in strokes), *frame(window)),
                tuple(text.moved(right, up) for text in texts),
                f"{f'piece {name}, ' if name else ''}column {column + 1} of {counts[0]} from the left, "
                f"row {counts[1] - row} of {counts[1]} from the top",
            )


def clipped(stroke: TemplateLine, area: tuple[float, float, float, float]) -> TemplateLine | None:
    """Return the part of a stroke in an area (left, low, right, high); None if it has no length."""
    start, end = stroke.start, stroke.end
    first, last = part_in_box(start, end, area)
    if last - first <= _TINY:
        return None

    def at(part: float) -> Point:
        return start[0] + part * (end[0] - start[0]), start[1] + part * (end[1] - start[1])

    # An end that is not cut off stays as it is, to the last digit.
    return TemplateLine(stroke.kind, at(first) if first > 0 else start, at(last) if last < 1 else end)


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


_PRINTING = "Print at 100 %, not fitted to the page, and measure the gauge: it is 100 mm long."
_TILES = "Lay the pages of a piece together, crosses of one name over each other, and tape them."
_STEP_SIZE, _LINE = 3.6, 5.2
"""Height of letters, and from line to line, millimetres."""
_LETTER = 0.5
"""Width of a letter in the mean, in units of its height."""
_TITLE = 5.0
"""Height of the letters of the title, millimetres."""
_AIR = 6.0
"""Millimetres between title, steps and picture."""
_LARGEST = 140.0
"""Millimetres of the longer side of the picture, at most."""


def note_page(paper: Paper, title: str, steps: Sequence[str], picture: Scene | None) -> Page:
    """Return the page that says how a template is put together; the steps are numbered here."""
    wide, high = paper.width - 2 * MARGIN, paper.height - 2 * MARGIN
    top = MARGIN + high
    heading = [Text((MARGIN, top - _TITLE / 2), title, _TITLE, middle=False)] if title else []
    texts, height = _written_steps(steps, (MARGIN, top - _TITLE - _AIR), wide)
    placed = None
    if picture is not None:
        room = max(high - _TITLE - 2 * _AIR - height, FOOTER)
        scale = min(wide / picture.width, room / picture.height, _LARGEST / max(picture.width, picture.height))
        left, down = MARGIN + (wide - scale * picture.width) / 2, MARGIN + _TITLE + 2 * _AIR + height
        placed = moved(scaled(Layer("PICTURE", tuple(picture.shapes())), scale), left, down)
    return Page(paper, (), (*heading, *texts), placed, is_note=True)


_APART = 6.0
"""Millimetres between pieces on a page."""
_MOST_PAGES = 500
"""Largest number of pages: more are a mistake."""
_LONGEST_TITLE = 40
_MOST_NESTED = 60
"""Number of pieces up to which those in rows are compared with nested ones."""
_CELL = 2.0
"""Millimetres of a cell of a raster in which pieces are nested."""
_HALF = 0.5
"""Cells in common below which there are none: sums of Fourier transforms are rounded."""
_Laid = list[tuple[Piece, float, float]]


def _written_steps(steps: Sequence[str], corner: tuple[float, float], width: float) -> tuple[list[Text], float]:
    """Return steps as lines of text, and the height that they take.

    `corner` is (left, top) and `width` the longest line; all in millimetres.
    """
    letters = int(width / (_LETTER * _STEP_SIZE))
    lines: list[str] = []
    for number, step in enumerate(steps, start=1):
        lines += wrap(step, letters, initial_indent=f"{number}. ", subsequent_indent=" " * 5)
    left, top = corner
    texts = [
        Text((left, top - (number + 0.5) * _LINE), line, _STEP_SIZE, middle=False) for number, line in enumerate(lines)
    ]
    return texts, len(lines) * _LINE


def pages_of(template: Template, paper: Paper) -> list[Page]:
    """Return the pages of a template, of the paper upright or turned, whichever needs fewer.

    First come those of pieces that fit on a page, then tiles, row by row from the top left, then the page of
    assembly if the template has one. Raise UnsolvableError if there would be more than 500 pages.
    """
    ways = (paper, paper.turned())
    # with one piece per page, which is known before any is made
    most = [sum(prod(tiles_across(piece.size, way.window)) for piece in template.pieces) for way in ways]
    if min(most) > _MOST_PAGES:
        raise UnsolvableError(
            f"{min(most)} pages; expected at most {_MOST_PAGES}; try a smaller --size or a larger --page"
        )
    contents = [_contents(template, way) for way, pages in zip(ways, most, strict=True) if pages <= _MOST_PAGES]
    way, sheets = min(contents, key=lambda content: len(content[1]))
    pages = [_page(template, way, content, number, len(sheets)) for number, content in enumerate(sheets, start=1)]
    if not template.steps:
        return pages
    tiled = any(isinstance(content, Tile) for content in sheets)
    steps = [_PRINTING, *([_TILES] if tiled else []), *template.steps]
    upright = min(paper, paper.turned(), key=lambda side: side.width)
    return [*pages, note_page(upright, plain(template.title, _LONGEST_TITLE), steps, template.picture)]


def laid_out(pieces: Sequence[Piece], width: float, height: float) -> Iterator[_Laid]:
    """Yield the content of each area of a width and a height (millimetres): pieces in rows, the highest first.

    Each item is (piece, right, up), how far it is moved. Every piece fits on the area; its lower left corner is
    the origin.
    """
    laid: _Laid = []
    right = up = row = 0.0
    for piece in sorted(pieces, key=lambda piece: -piece.size[1]):
        wide, high = piece.size
        if laid and right + wide > width:
            right, up, row = 0.0, up + row + _APART, 0.0
        if laid and up + high > height:
            yield laid
            laid, right, up, row = [], 0.0, 0.0, 0.0
        laid.append((piece, right, up))
        right, row = right + wide + _APART, max(row, high)
    if laid:
        yield laid


def nested(pieces: Sequence[Piece], width: float, height: float) -> list[_Laid]:
    """Return the contents of areas of a width and a height (millimetres) on which pieces lie in each other's bays.

    Items are as for `laid_out`, the pieces turned by quarters. Areas and pieces, widened by half of what keeps
    them apart, are rasters: the largest piece comes first, each to the lowest place that is free, found for all
    places at once by a product of Fourier transforms. Every piece fits on the area as it is.
    """
    shape = int((height + _APART) / _CELL), int((width + _APART) / _CELL)
    areas: list[tuple[Floats, _Laid]] = []
    for piece in sorted(pieces, key=lambda piece: -piece.covered.area):
        ways = [piece.at_origin()]
        for _ in range(3):
            ways.append(ways[-1].turned())
        rasters = [(way, raster) for way in ways if all(map(le, (raster := _raster(way)).shape, shape))]
        if not rasters:  # as large as the area, within half a cell
            areas.append((np.ones(shape), [(ways[0], 0.0, 0.0)]))
            continue
        for area in [*areas, (np.zeros(shape), list[tuple[Piece, float, float]]())]:
            places = [
                (*place, number) for number, (_, raster) in enumerate(rasters) for place in _lowest(area[0], raster)
            ]
            if places:
                break
        _, row, column, number = min(places)
        way, raster = rasters[number]
        taken, laid = area
        taken[row : row + raster.shape[0], column : column + raster.shape[1]] += raster
        if not laid:
            areas.append((taken, laid))
        laid.append((way, column * _CELL, row * _CELL))
    return [laid for _, laid in areas]


def _raster(piece: Piece) -> Floats:
    """Return 1 for each cell that a piece reaches, widened, and 0 for others: float[rows, columns], lowest first."""
    import shapely
    from shapely.affinity import translate

    wide = shapely.union(piece.covered, shapely.MultiLineString([(line.start, line.end) for line in piece.strokes]))
    wide = translate(wide.buffer(_APART / 2), _APART / 2, _APART / 2)
    shapely.prepare(wide)
    _, _, right, high = wide.bounds
    columns, rows = np.meshgrid(np.arange(ceil(right / _CELL)), np.arange(ceil(high / _CELL)))
    cells = shapely.box(columns * _CELL, rows * _CELL, (columns + 1) * _CELL, (rows + 1) * _CELL)
    return np.asarray(shapely.intersects(wide, cells), dtype=np.float64)


def _lowest(taken: Floats, raster: Floats) -> list[tuple[int, int, int]]:
    """Return the lowest free place of a raster, as its upper end, its row and its column; or none."""
    common = np.fft.rfft2(taken) * np.conj(np.fft.rfft2(raster, s=taken.shape))
    overlap = np.fft.irfft2(common, s=taken.shape)
    rows, columns = (whole - part + 1 for whole, part in zip(taken.shape, raster.shape, strict=True))
    free = np.argwhere(overlap[:rows, :columns] < _HALF)
    return [(int(row) + raster.shape[0], int(row), int(column)) for row, column in free[:1].tolist()]


def _contents(template: Template, paper: Paper) -> tuple[Paper, list[_Laid | Tile]]:
    """Return what each page holds: pieces laid out, in rows or if it saves a page nested, or a tile of one."""
    fitting: list[Piece] = []
    larger: list[Piece] = []
    for piece in template.pieces:
        placed = piece.at_origin()
        ways = [way for way in (placed, placed.turned()) if all(map(le, way.size, paper.window))]
        (fitting if ways else larger).append(ways[0] if ways else placed)
    laid = list(laid_out(fitting, *paper.window))
    if len(laid) > 1 and len(fitting) <= _MOST_NESTED:
        laid = min(laid, nested(fitting, *paper.window), key=len)
    contents: list[_Laid | Tile] = list(laid)
    for number, piece in enumerate(larger, start=1):
        contents += tiles_of(piece, paper.window, str(number) if len(larger) > 1 else "")
    return paper, contents


def _page(template: Template, paper: Paper, content: _Laid | Tile, number: int, count: int) -> Page:
    """Return a page with what it holds and its foot."""
    if isinstance(content, Tile):
        strokes, texts, where = list(content.strokes), list(content.texts), f": {content.where}"
    else:
        (strokes, texts), where = _in_the_middle(content, paper), ""
    title = plain(template.title, _LONGEST_TITLE)
    unit = "" if template.scale is None else f", a unit is {template.scale:.6g} mm"
    caption = f"{title + ', ' if title else ''}page {number} of {count}{where}{unit}"
    foot, words = footer((stroke.kind for piece in template.pieces for stroke in piece.strokes), caption)
    return Page(paper, (*strokes, *foot), (*texts, *words))


def _in_the_middle(laid: _Laid, paper: Paper) -> tuple[list[TemplateLine], list[Text]]:
    """Return the strokes and texts of pieces, moved to the middle of the page."""
    free = [
        most - max(shift[axis] + piece.size[axis] for piece, *shift in laid) for axis, most in enumerate(paper.window)
    ]
    left, low = MARGIN + free[0] / 2, MARGIN + FOOTER + free[1] / 2
    return strokes_and_texts((piece, left + right, low + up) for piece, right, up in laid)


def strokes_and_texts(laid: Iterable[tuple[Piece, float, float]]) -> tuple[list[TemplateLine], list[Text]]:
    """Return the strokes and texts of pieces, each moved to the right and up."""
    pieces = [piece.moved(right, up) for piece, right, up in laid]
    strokes = [stroke for piece in pieces for stroke in piece.strokes]
    return strokes, [text for piece in pieces for text in piece.texts]
