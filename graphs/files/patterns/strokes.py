"""What the strokes of a drawing stand for: origami colours; and which strokes were not understood.

Mountain red, valley blue, border black, cut green, flat (facet) yellow, unassigned magenta: the colours of Origami
Simulator. Dashes mean mountains and valleys in house styles that draw all in black, and differ from one to the
next: a dashed black line is not understood. A colour says what a line is, dashed or not.
"""

from __future__ import annotations

from collections import Counter
from colorsys import rgb_to_hsv
from typing import Any

__all__ = ["COLOURS", "described_strokes", "kind_of_stroke", "letter_of_colour", "letter_of_stroke"]

COLOURS = {
    "M": (255, 0, 0),
    "V": (0, 0, 255),
    "B": (0, 0, 0),
    "C": (0, 255, 0),
    "F": (255, 255, 0),
    "U": (255, 0, 255),
}
"""The colour of each assignment; joins are drawn as flat edges."""
_NEAR = 120
"""A stroke farther than this from every origami colour (in RGB) is no crease."""
_HUE = 15 / 360
"""A hue farther than this from that of its colour is another colour: orange is neither yellow nor red."""
_GREY = 60
"""Black has red, green and blue no more apart than this."""
_KINDS = 6
"""So many kinds of strokes are named."""


def letter_of_colour(red: int, green: int, blue: int) -> str | None:
    """Return the assignment that a stroke colour stands for, or None.

    >>> letter_of_colour(230, 10, 10), letter_of_colour(128, 128, 128), letter_of_colour(255, 165, 0)
    ('M', None, None)
    """
    colour = (red, green, blue)
    found, distance = min(
        ((letter, sum(abs(x - y) for x, y in zip(colour, pure, strict=True))) for letter, pure in COLOURS.items()),
        key=lambda item: item[1],
    )
    if distance > _NEAR:
        return None
    if found == "B":
        return found if max(colour) - min(colour) <= _GREY else None
    apart = abs(rgb_to_hsv(*colour)[0] - rgb_to_hsv(*COLOURS[found])[0])
    return found if min(apart, 1 - apart) <= _HUE else None


def letter_of_stroke(shape: Any) -> str | None:
    """Return the assignment that the stroke of an SVG shape stands for, or None if it is not understood."""
    letter = letter_of_colour(shape.stroke.red, shape.stroke.green, shape.stroke.blue)
    return None if letter == "B" and _is_dashed(shape) else letter


def kind_of_stroke(shape: Any) -> str:
    """Return how a stroke looks, for messages: ``#ffa500``, ``dashed #000000``."""
    colour = f"#{shape.stroke.red:02x}{shape.stroke.green:02x}{shape.stroke.blue:02x}"
    return f"dashed {colour}" if _is_dashed(shape) else colour


def described_strokes(kinds: Counter[str]) -> str:
    """Return the strokes that were not understood, by kind and number; empty if none.

    >>> described_strokes(Counter({"#ffa500": 3, "dashed #000000": 12}))
    '15 shape(s) with strokes not understood left out: 12 dashed #000000, 3 #ffa500'
    """
    if not kinds:
        return ""
    named = [f"{number} {kind}" for kind, number in kinds.most_common(_KINDS)]
    if len(kinds) > _KINDS:
        named.append(f"{len(kinds) - _KINDS} more kind(s)")
    return f"{kinds.total()} shape(s) with strokes not understood left out: {', '.join(named)}"


def _is_dashed(shape: Any) -> bool:
    """Tell whether a stroke has gaps; ``none`` and zeros are a solid line."""
    return any(digit in "123456789" for digit in str(shape.values.get("stroke-dasharray") or ""))
