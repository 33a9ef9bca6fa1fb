"""What is printed beside the lines of a template: the gauge, what the lines mean, crosses where tiles meet."""

from __future__ import annotations

from collections.abc import Iterable

from synth.templates.lines import LOOKS, Kind, Point, Stroke, Text
from synth.templates.paper import FOOTER, MARGIN

__all__ = ["GAUGE", "cross", "footer", "frame", "gauge"]

GAUGE = 100.0
"""Length of the gauge, millimetres."""
_TICK, _EACH = 1.5, 10
_ARM = 4.0
_ROWS = (3.0, 8.0, 12.0, 17.0)
"""Heights of gauge, two rows of legend and caption over the margin, millimetres; they fill the footer."""
_GAUGE_TEXT = 2.5


def gauge(at: Point) -> tuple[list[Stroke], list[Text]]:
    """Return a ruler of 100 mm with a tick each 10 mm, from its left end on; the first stroke is the gauge itself.

    >>> gauge((10, 20))[0][0]
    Stroke(kind='MARKS', start=(10, 20), end=(110.0, 20))
    """
    x, y = at
    strokes = [Stroke("MARKS", at, (x + GAUGE, y))]
    for tick in range(int(GAUGE) // _EACH + 1):
        place = x + tick * _EACH
        strokes.append(Stroke("MARKS", (place, y - _TICK), (place, y + _TICK)))
    return strokes, [Text((x + GAUGE + 2, y), f"{GAUGE:g} mm", _GAUGE_TEXT, middle=False)]


def footer(kinds: Iterable[Kind], caption: str) -> tuple[list[Stroke], list[Text]]:
    """Return the foot of a page: gauge, what its kinds of lines mean in words, caption.

    The meaning is told in words only: a line drawn to show it would be cut or folded by a machine.
    """
    shown = set(kinds)
    strokes, texts = gauge((MARGIN, MARGIN + _ROWS[0]))
    meanings = [look.meaning for kind, look in LOOKS.items() if kind in shown and look.meaning]
    legend = ["; ".join(meanings[:2]), "; ".join(meanings[2:])]
    rows = zip(_ROWS[:0:-1], [caption, *legend], strict=True)
    texts += [Text((MARGIN, MARGIN + row), words, _GAUGE_TEXT, middle=False) for row, words in rows if words]
    return strokes, texts


def frame(window: tuple[float, float]) -> list[Stroke]:
    """Return the border of what a page shows of a larger piece: pages are laid together with it."""
    left, low = MARGIN, MARGIN + FOOTER
    right, high = left + window[0], low + window[1]
    corners = [(left, low), (right, low), (right, high), (left, high)]
    return [Stroke("MARKS", a, b) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]


def cross(at: Point, name: str) -> tuple[list[Stroke], Text]:
    """Return a cross with a name: crosses of one name on two pages lie over each other."""
    x, y = at
    strokes = [Stroke("MARKS", (x - _ARM, y), (x + _ARM, y)), Stroke("MARKS", (x, y - _ARM), (x, y + _ARM))]
    return strokes, Text((x + _ARM / 2, y + _ARM / 2), name, _GAUGE_TEXT)
