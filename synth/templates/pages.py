"""Pieces put on pages: whole, several on a page, or in tiles that overlap. Nothing is ever scaled to fit."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import prod

from graphs.errors import UnsolvableError
from graphs.printing import plain
from synth.templates.lines import Piece, Stroke, Text
from synth.templates.marks import footer
from synth.templates.note.page import note_page
from synth.templates.note.steps import PRINTING, TILES
from synth.templates.page import Page
from synth.templates.paper import FOOTER, MARGIN, Paper
from synth.templates.template import Template
from synth.templates.tiles import Tile, tiles_across, tiles_of

__all__ = ["laid_out", "pages_of"]

_APART = 6.0
"""Millimetres between pieces on a page."""
_MOST = 500
"""Pages at most: more were not meant."""
_LONGEST_TITLE = 40
_Laid = list[tuple[Piece, float, float]]


def pages_of(template: Template, paper: Paper) -> list[Page]:
    """Return the pages of a template, of the paper upright or turned, whichever needs fewer.

    First come those of pieces that fit on a page, then tiles, row by row from the top left, then the page of
    assembly if the template has one. Raise UnsolvableError if there would be more than 500 pages.
    """
    ways = (paper, paper.turned())
    most = [_pages_at_most(template, way) for way in ways]
    if min(most) > _MOST:
        raise UnsolvableError(f"{min(most)} pages: expected a size or a paper with at most {_MOST} of them")
    contents = [_contents(template, way) for way, pages in zip(ways, most, strict=True) if pages <= _MOST]
    way, sheets = min(contents, key=lambda one: len(one[1]))
    pages = [_page(template, way, content, number, len(sheets)) for number, content in enumerate(sheets, start=1)]
    if not template.steps:
        return pages
    tiled = any(isinstance(content, Tile) for content in sheets)
    steps = [PRINTING, *([TILES] if tiled else []), *template.steps]
    upright = min(paper, paper.turned(), key=lambda one: one.width)
    return [*pages, note_page(upright, plain(template.title, _LONGEST_TITLE), steps, template.picture)]


def laid_out(pieces: Sequence[Piece], width: float, height: float) -> Iterator[_Laid]:
    """Yield the content of each area of a width and a height (millimetres): pieces in rows, the highest first.

    Each item is (piece, right, up), how far it is moved. Every piece fits on the area; its lower left corner is
    the origin.
    """
    laid: _Laid = []
    right = up = row = 0.0
    for piece in sorted(pieces, key=lambda one: -one.size[1]):
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


def _pages_at_most(template: Template, paper: Paper) -> int:
    """Return how many pages there are where each piece has its own: told before any is made."""
    return sum(prod(tiles_across(piece.size, paper.window)) for piece in template.pieces)


def _contents(template: Template, paper: Paper) -> tuple[Paper, list[_Laid | Tile]]:
    """Return what each page holds: pieces laid out, or a tile of one."""
    fitting: list[Piece] = []
    larger: list[Piece] = []
    for piece in template.pieces:
        placed = piece.at_origin()
        ways = [way for way in (placed, placed.turned()) if _fits(way, paper)]
        (fitting if ways else larger).append(ways[0] if ways else placed)
    contents: list[_Laid | Tile] = list(laid_out(fitting, *paper.window))
    for number, piece in enumerate(larger, start=1):
        contents += tiles_of(piece, paper.window, str(number) if len(larger) > 1 else "")
    return paper, contents


def _fits(piece: Piece, paper: Paper) -> bool:
    return all(side <= most for side, most in zip(piece.size, paper.window, strict=True))


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


def _in_the_middle(laid: _Laid, paper: Paper) -> tuple[list[Stroke], list[Text]]:
    """Return the strokes and texts of pieces, moved to the middle of the page."""
    free = [
        most - max(shift[axis] + piece.size[axis] for piece, *shift in laid)
        for axis, most in enumerate(paper.window)
    ]
    moved = [
        piece.moved(MARGIN + free[0] / 2 + right, MARGIN + FOOTER + free[1] / 2 + up) for piece, right, up in laid
    ]
    return [one for piece in moved for one in piece.strokes], [one for piece in moved for one in piece.texts]
