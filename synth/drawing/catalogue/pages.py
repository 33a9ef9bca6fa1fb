"""Pages of a catalogue: pictures in rows and columns, each with its number, its id and what is known of it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import count, islice

from synth.drawing.catalogue.entries import CatalogueEntry
from synth.drawing.mechanisms.pictures import draw
from synth.drawing.scene.moving import moved
from synth.drawing.scene.palette import LARGE
from synth.drawing.scene.shapes import Label, Layer, Scene, text_width

__all__ = ["catalogue_pages"]

_WIDE, _HIGH = 595.0, 842.0
"""A4, points."""
_EDGE, _HEAD = 30.0, 26.0
_COLUMNS, _ROWS = 4, 6
_LETTERS = 5.0
_LINES = 3
"""Lines of text below a picture: number, id, what is known."""
_AIR = 6.0


def catalogue_pages(
    entries: Iterable[CatalogueEntry], title: str = "", kind: str | None = None
) -> Iterator[Scene]:
    """Yield pages of 24 pictures; an entry is let go when its page is made.

    Parameters
    ----------
    entries : iterable of CatalogueEntry
    title : str, optional
        Goes above each page.
    kind : str, optional
        As for `synth.draw`.

    Examples
    --------
    >>> from graphs.files.formats import mechanism_of_id
    >>> four_bar = CatalogueEntry(1, mechanism_of_id("k1:Cr"), "k1:Cr", "M = 1")
    >>> [label.text for label in next(catalogue_pages([four_bar])).labels()][-4:]
    ['page 1', '1', 'k1:Cr', 'M = 1']
    """
    rest = iter(entries)
    for number in count(1):
        on_page = list(islice(rest, _COLUMNS * _ROWS))
        if not on_page:
            return
        layers: list[Layer] = []
        head = [Label((_EDGE, _EDGE), title, LARGE, anchor="start", bold=True, halo=False, widest=90)]
        head.append(Label((_WIDE - _EDGE - 40, _EDGE), f"page {number}", 7.0, "grey", "start", halo=False))
        texts: list[Label] = []
        for place, entry in enumerate(on_page):
            layers += _picture(entry, place, kind)
            texts += _text(entry, place)
        yield Scene(_WIDE, _HIGH, (*layers, Layer("text", (*head, *texts))), title)


def _cell(place: int) -> tuple[float, float, float, float]:
    """Return left, top, width and height of a place on the page."""
    wide = (_WIDE - 2 * _EDGE) / _COLUMNS
    high = (_HIGH - 2 * _EDGE - _HEAD) / _ROWS
    return _EDGE + place % _COLUMNS * wide, _EDGE + _HEAD + place // _COLUMNS * high, wide, high


def _picture(entry: CatalogueEntry, place: int, kind: str | None) -> list[Layer]:
    left, top, wide, high = _cell(place)
    box = wide - _AIR, high - _LINES * 1.4 * _LETTERS - _AIR
    scene = draw(entry.mechanism, kind, box=box, caption=None)
    right, down = left + (wide - scene.width) / 2, top + (box[1] - scene.height) / 2
    return [moved(layer, right, down) for layer in scene.layers if layer.shapes]


def _text(entry: CatalogueEntry, place: int) -> list[Label]:
    left, top, wide, high = _cell(place)
    first = top + high - _LINES * 1.4 * _LETTERS
    most = int((wide - _AIR) / text_width("0", _LETTERS))
    lines = [(str(entry.number), True), (entry.name, False), (entry.said, False)]
    return [
        Label(
            (left + _AIR, first + i * 1.35 * _LETTERS),
            text,
            _LETTERS,
            "ink" if bold else "grey",
            "start",
            bold,
            False,
            most,
        )
        for i, (text, bold) in enumerate(lines)
    ]
