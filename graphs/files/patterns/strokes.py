"""How lines of a drawing look, and what looks stand for by themselves: colours, names of layers and groups.

Mountain red, valley blue, border black, cut green, flat (facet) yellow, unassigned magenta: the colours of Origami
Simulator. Hues near red and blue count as these, since drawing programs have reds and blues of their own; green
and yellow count only where they are nearly pure, or a swatch of such a program. What was stated of a drawing comes
first: :mod:`graphs.files.patterns.legend`.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from colorsys import rgb_to_hsv
from dataclasses import dataclass
from functools import lru_cache
from math import isfinite
from typing import Literal, TypeAlias

from graphs.files.patterns.css_colours import Rgb

__all__ = [
    "COLOURS",
    "Dash",
    "Stroke",
    "dash_of_lengths",
    "dash_of_line_type",
    "letter_of_colour",
    "letter_of_name",
    "name_of_rgb",
]

Dash: TypeAlias = Literal["solid", "dashed", "dotted", "dash-dot"]

COLOURS = {
    "M": (255, 0, 0),
    "V": (0, 0, 255),
    "B": (0, 0, 0),
    "C": (0, 255, 0),
    "F": (255, 255, 0),
    "U": (255, 0, 255),
}
"""The colour of each assignment; joins are drawn as flat edges."""
_SWATCHES = {
    "C": ("008000", "009245", "39b54a", "00a651", "00a859", "009846"),
    "F": ("fff200", "fcee21", "fff500", "fff212"),
}
"""Greens and yellows of CSS, Illustrator and CorelDRAW that are farther from the pure ones than `_NEAR`, or whose
hue is."""
_NEAR = 120
"""A stroke farther than this from an origami colour (in RGB) is that colour only by its hue, or as a swatch."""
_HUE = 15 / 360
"""A hue farther than this from that of its colour is another colour: orange is neither yellow nor red."""
_HUES = {"M": (342 / 360, 17 / 360), "V": (193 / 360, 255 / 360)}
"""Hues that are red and blue: from crimson to vermilion, from process blue to indigo. Cyan (180 to 192), which
some programs draw auxiliary lines in, is neither, nor is violet."""
_STRONG, _BRIGHT = 0.5, 0.3
"""Saturation and value from which a hue is seen: pink and nearly black are no red."""
_GREY, _DARK = 60, 64
"""Black has red, green and blue no more apart than the first; dark greys below the second are black."""
_SAME = 12
"""A swatch is met within this (in RGB)."""
_NAMES = {
    "B": "border borders boundary outline contour",
    "C": "cut cuts cutting",
    "M": "mountain mountains mountainfold mountainfolds",
    "V": "valley valleys valleyfold valleyfolds",
    "F": "flat facet facets auxiliary aux",
    "U": "unassigned",
}
_LETTERS = {name: letter for letter, names in _NAMES.items() for name in names.split()}
_DASH_DOT, _DOTTED = (
    ("DASHDOT", "CENTER", "PHANTOM", "DIVIDE", "ISO04", "ISO05", "ISO08", "ISO1"),
    ("DOT", "ISO07"),
)


@dataclass(frozen=True, slots=True)
class Stroke:
    """How a line of a drawing looks.

    `rgb` is None where the colour cannot be read, as that of a gradient; `index` is the number of a colour in DXF.
    `names` are those of the groups or the layer that it is in, the innermost first; `letter` is what the file
    itself says that it is. `kind` is how it looks, for messages; `lines` is how many lines, straight or curved, it
    draws.
    """

    rgb: Rgb | None
    dash: Dash = "solid"
    names: tuple[str, ...] = ()
    index: int | None = None
    letter: str | None = None
    kind: str = ""
    lines: int = 1


@lru_cache(maxsize=1000)
def letter_of_colour(red: int, green: int, blue: int) -> str | None:
    """Return the assignment that a stroke colour stands for, or None.

    >>> letter_of_colour(230, 10, 10), letter_of_colour(128, 128, 128), letter_of_colour(255, 165, 0)
    ('M', None, None)

    Reds and blues of Illustrator, and the black of CorelDRAW:

    >>> [letter_of_colour(*colour) for colour in ((193, 39, 45), (0, 113, 188), (41, 171, 226), (55, 52, 53))]
    ['M', 'V', 'V', 'B']
    """
    colour = (red, green, blue)
    found, far = min(
        ((letter, _apart(colour, pure)) for letter, pure in COLOURS.items()), key=lambda item: item[1]
    )
    hue, saturation, value = rgb_to_hsv(*(part / 255 for part in colour))
    if max(colour) - min(colour) <= _GREY and (max(colour) < _DARK or (found == "B" and far <= _NEAR)):
        return "B"
    if far <= _NEAR and found != "B":
        off = abs(hue - rgb_to_hsv(*COLOURS[found])[0])
        if min(off, 1 - off) <= _HUE:
            return found
    if saturation >= _STRONG and value >= _BRIGHT:
        for letter, (first, last) in _HUES.items():
            if first <= hue <= last or (first > last and not last < hue < first):
                return letter
    swatches = ((letter, bytes.fromhex(text)) for letter, row in _SWATCHES.items() for text in row)
    return next((letter for letter, swatch in swatches if _apart(colour, swatch) <= _SAME), None)


def _apart(one: Sequence[int], other: Sequence[int]) -> int:
    return sum(abs(x - y) for x, y in zip(one, other, strict=True))


@lru_cache(maxsize=1000)
def letter_of_name(name: str) -> str | None:
    """Return the assignment that the name of a layer or a group tells by one of its words, if it tells one.

    >>> letter_of_name("Mountain_x5F_folds-2"), letter_of_name("valley folds"), letter_of_name("mountain + valley")
    ('M', 'V', None)
    """
    words = re.split(r"[^a-z]+", re.sub(r"_x[0-9a-f]{2}_", " ", name[:200].lower()))
    letters = {_LETTERS[word] for word in words if word in _LETTERS}
    return letters.pop() if len(letters) == 1 else None


def dash_of_lengths(lengths: Sequence[float]) -> Dash:
    """Return the kind of dash that strokes and gaps in turn make, as in SVG; without gaps a line is solid.

    >>> dash_of_lengths([]), dash_of_lengths([4, 2]), dash_of_lengths([6, 2, 1, 2]), dash_of_lengths([0, 3])
    ('solid', 'dashed', 'dash-dot', 'dotted')
    """
    row = [length for length in lengths if isfinite(length)] * (1 + len(lengths) % 2)
    drawn, gaps = row[::2], row[1::2]
    if not any(gap > 0 for gap in gaps):
        return "solid"
    if min(drawn) <= max(drawn) / 2 and max(drawn) > 0:
        return "dash-dot"
    return "dotted" if 2 * max(drawn) <= max(gaps) else "dashed"


def dash_of_line_type(name: str) -> Dash:
    """Return the kind of dash of a line type of DXF; whatever is not continuous has gaps.

    >>> dash_of_line_type("Continuous"), dash_of_line_type("HIDDEN2"), dash_of_line_type("ACAD_ISO10W100")
    ('solid', 'dashed', 'dash-dot')
    """
    name = name.upper()
    if name in ("CONTINUOUS", "BYBLOCK"):
        return "solid"
    if any(word in name for word in _DASH_DOT):
        return "dash-dot"
    return "dotted" if any(word in name for word in _DOTTED) else "dashed"


def name_of_rgb(rgb: Rgb) -> str:
    """Return a colour as ``#ffa500``."""
    return "#{:02x}{:02x}{:02x}".format(*rgb)
