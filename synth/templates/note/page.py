"""The page of assembly: steps, and below them the picture."""

from __future__ import annotations

from collections.abc import Sequence

from synth.drawing.scene.shapes import Scene
from synth.templates.lines import Text
from synth.templates.note.steps import written_steps
from synth.templates.page import Page, Picture
from synth.templates.paper import FOOTER, MARGIN, Paper

__all__ = ["note_page"]

_TITLE = 5.0
"""Height of the letters of the title, millimetres."""
_AIR = 6.0
"""Millimetres between title, steps and picture."""
_LARGEST = 140.0
"""Millimetres of the longer side of the picture, at most."""


def note_page(paper: Paper, title: str, steps: Sequence[str], picture: Scene | None) -> Page:
    """Return the page that says how a template is put together; the steps are numbered here.

    >>> page = note_page(Paper(210, 297), "bird base", ["Cut it out.", "Fold it."], None)
    >>> [text.words for text in page.texts]
    ['bird base', '1. Cut it out.', '2. Fold it.']
    """
    wide, high = paper.width - 2 * MARGIN, paper.height - 2 * MARGIN
    top = MARGIN + high
    heading = [Text((MARGIN, top - _TITLE / 2), title, _TITLE, middle=False)] if title else []
    texts, taken = written_steps(steps, (MARGIN, top - _TITLE - _AIR), wide)
    placed = None
    if picture is not None:
        room = max(high - _TITLE - 2 * _AIR - taken, FOOTER)
        scale = min(wide / picture.width, room / picture.height, _LARGEST / max(picture.width, picture.height))
        left = MARGIN + (wide - scale * picture.width) / 2
        low = top - _TITLE - 2 * _AIR - taken - scale * picture.height
        placed = Picture(picture, (left, low), scale)
    return Page(paper, (), (*heading, *texts), placed, is_note=True)
