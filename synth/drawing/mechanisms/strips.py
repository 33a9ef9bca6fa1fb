"""R/- strings as strips of paper between two bodies: fans of creases that meet in a point."""

from __future__ import annotations

from itertools import pairwise

from enumerate.strings.panel_strings import ChainString
from synth.drawing.scene.frame import COLUMN, captions_of, framed, page_of
from synth.drawing.scene.palette import NORMAL
from synth.drawing.scene.shapes import Layer, Line, Polygon, Scene, Shape

__all__ = ["strip_scene"]

_HIGH, _PANEL, _FAN, _BODY = 1.0, 0.8, 0.55, 0.6
_UNIT = 34.0


def strip_scene(
    chain: ChainString, *, box: tuple[float, float] = (COLUMN, COLUMN), caption: str | None = ""
) -> Scene:
    """Return a picture of an R/- string: the bodies at its ends are grey, a fan meets at the lower edge.

    It is at most as large as the box, in points. The caption comes before the line that describes the picture;
    with None there is neither.
    """
    creases = _creases(chain)
    right = max(top for _, top in creases) + _BODY
    sides = [(0.0, 0.0), *creases, (right, right)]
    frame = framed([(0, 0), (right, _HIGH)], _UNIT, box)
    panels: list[Shape] = []
    for number, ((b0, t0), (b1, t1)) in enumerate(pairwise(sides)):
        corners = [(b0, 0.0), (b1, 0.0), (t1, _HIGH), (t0, _HIGH)]
        row = frame.row(dict.fromkeys(corners))  # the corners of a triangle once
        end = number in (0, len(sides) - 2)
        panels.append(Polygon(row, "ground" if end else "body", "ink", NORMAL, data=(("link", str(number)),)))
    lines = tuple(
        Line(frame.row([(bottom, 0.0), (top, _HIGH)]), "class0", 1.4 * NORMAL, data=(("joint", str(number)),))
        for number, (bottom, top) in enumerate(creases)
    )
    said = f"{chain.text}: {chain.creases} creases"
    return page_of(frame, [Layer("panels", tuple(panels)), Layer("creases", lines)], captions_of(caption, said))


def _creases(chain: ChainString) -> list[tuple[float, float]]:
    """Return where each crease meets the lower and the upper edge."""
    found = []
    left = _BODY
    for size in chain.clusters:
        wide = _FAN * (size - 1)
        found += [(left + wide / 2, left + _FAN * i) for i in range(size)]
        left += wide + _PANEL
    return found
