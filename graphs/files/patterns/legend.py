"""The legend of a drawing: which lines are mountains, valleys, borders, ..., stated or seen; and those left out.

Statements come first, the most particular before the rest: a layer, dashes of a colour, dashes, a colour. Then
names of layers and groups, then colours as in Origami Simulator, then dashes (docs/files.md).
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from colorsys import hls_to_rgb, rgb_to_hsv
from dataclasses import dataclass
from functools import lru_cache
from math import isfinite, tau
from typing import Literal, NamedTuple, TypeAlias, cast, get_args

from graphs.errors import InvariantError, numbered, shown

Rgb: TypeAlias = tuple[int, int, int]

_HEX = re.compile(r"#(?:[0-9a-f]{3,4}|[0-9a-f]{6}|[0-9a-f]{8})")
_FUNCTION = re.compile(r"(rgb|hsl)a?\(([^()]{1,100})\)")
_TURNS = {"": 360.0, "deg": 360.0, "grad": 400.0, "rad": tau, "turn": 1.0}
_NUMBER = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+))(%|deg|grad|rad|turn)?")


@lru_cache(maxsize=1000)
def rgb_of_css(text: str) -> Rgb | None:
    """Return red, green and blue, 0 to 255, of a colour of CSS without its opacity; None if it is none."""
    text = text.replace("!important", "").strip().lower()
    if _HEX.fullmatch(text):
        digits = text[1:] if len(text) > 5 else "".join(2 * digit for digit in text[1:])
        return int(digits[:2], 16), int(digits[2:4], 16), int(digits[4:6], 16)
    if function := _FUNCTION.fullmatch(text):
        numbers = [_NUMBER.fullmatch(word) for word in re.split(r"[\s,/]+", function[2].strip())]
        parts = [(float(number[1]), number[2] or "") for number in numbers if number is not None]
        if len(parts) == len(numbers) and len(parts) in (3, 4):
            return _of_rgb(parts[:3]) if function[1] == "rgb" else _of_hsl(parts[:3])
        return None
    return _rgb_of_name(text)


def _of_rgb(parts: list[tuple[float, str]]) -> Rgb | None:
    if any(unit not in ("", "%") for _, unit in parts):
        return None
    red, green, blue = (_byte(value / 100 if unit else value / 255) for value, unit in parts)
    return red, green, blue


def _of_hsl(parts: list[tuple[float, str]]) -> Rgb | None:
    (hue, unit), (saturation, _), (lightness, _) = parts
    if unit not in _TURNS:
        return None
    unit_part = (min(max(value / 100, 0.0), 1.0) for value in (lightness, saturation))
    red, green, blue = (_byte(value) for value in hls_to_rgb(hue / _TURNS[unit] % 1.0, *unit_part))
    return red, green, blue


def _byte(part: float) -> int:
    return round(255 * min(max(part, 0.0), 1.0))


def _rgb_of_name(text: str) -> Rgb | None:
    """Return a colour by its name; svgelements takes every name that it does not know for black."""
    import svgelements

    if not text.isalpha() or text in ("none", "transparent"):
        return None
    colour = svgelements.Color(text)
    rgb = (int(colour.red), int(colour.green), int(colour.blue))
    return None if rgb == (0, 0, 0) and text != "black" else rgb


Dash: TypeAlias = Literal["solid", "dashed", "dotted", "dash-dot"]

COLOURS = {"M": (255, 0, 0), "V": (0, 0, 255), "B": (0, 0, 0), "C": (0, 255, 0), "F": (255, 255, 0), "U": (255, 0, 255)}
"""The colour of each assignment; joins are drawn as flat edges."""
_SWATCHES = {
    "C": ("008000", "009245", "39b54a", "00a651", "00a859", "009846"),
    "F": ("fff200", "fcee21", "fff500", "fff212"),
}
"""Greens and yellows of CSS, Illustrator and CorelDRAW that are farther from the pure ones than `_NEAR`, or whose
hue is."""
# Distance in RGB, summed: pure colours are 255 or more from each other, so that within less than half of that a stroke
# is near to one of them only. What is farther is that colour only by its hue, or as a swatch.
_NEAR = 120
_HUE = 15 / 360  # half of the 30 degrees between red and orange, orange and yellow: orange is neither
_HUES = {"M": (342 / 360, 17 / 360), "V": (193 / 360, 255 / 360)}
"""Hues that are red and blue: from crimson to vermilion, from process blue to indigo. Cyan (180 to 192), which
some programs draw auxiliary lines in, is neither, nor is violet."""
_STRONG = 0.5  # saturation from which a hue is seen: pink is no red
_BRIGHT = 0.3  # value from which it is: what is nearly black has a hue by chance
_GREY = 60  # difference of red, green and blue up to which a colour looks grey: inks and scans are no neutral grey
_DARK = 64  # greys darker than a quarter are meant as black; lighter ones are auxiliary lines
_SAME = 12  # distance in RGB, summed: conversions between colour spaces round each part by some units
_NAMES = {
    "B": "border borders boundary outline contour",
    "C": "cut cuts cutting",
    "M": "mountain mountains mountainfold mountainfolds",
    "V": "valley valleys valleyfold valleyfolds",
    "F": "flat facet facets auxiliary aux",
    "U": "unassigned",
}
_LETTERS = {name: letter for letter, names in _NAMES.items() for name in names.split()}
_DASH_DOT = ("DASHDOT", "CENTER", "PHANTOM", "DIVIDE", "ISO04", "ISO05", "ISO08", "ISO1")
"""Parts of the names of line types of AutoCAD and ISO 128 that have dashes and dots."""
_DOTTED = ("DOT", "ISO07")
"""Of those that have dots only; looked for after `_DASH_DOT`, whose names contain them."""


@dataclass(frozen=True, slots=True)
class Stroke:
    """How a line of a drawing looks.

    `rgb` is None if the colour cannot be read; `index` is the number of a colour in DXF. `names` are those of its
    groups or its layer, the innermost first; `letter` is the assignment that the file itself states. `kind`
    describes its look, for messages; `lines` is the number of lines, straight or curved.
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
    """Return the assignment that a stroke colour stands for, or None."""
    colour = (red, green, blue)
    far, nearest = min((_apart(colour, pure), letter) for letter, pure in COLOURS.items())
    hue, saturation, value = rgb_to_hsv(*(part / 255 for part in colour))
    if max(colour) - min(colour) <= _GREY and (max(colour) < _DARK or (nearest == "B" and far <= _NEAR)):
        return "B"
    if far <= _NEAR and nearest != "B":
        off = abs(hue - rgb_to_hsv(*COLOURS[nearest])[0])
        if min(off, 1 - off) <= _HUE:
            return nearest
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
    """Return the assignment that a word of the name of a layer or a group states; None if none or several do."""
    words = re.split(r"[^a-z]+", re.sub(r"_x[0-9a-f]{2}_", " ", name[:200].lower()))
    letters = {_LETTERS[word] for word in words if word in _LETTERS}
    return letters.pop() if len(letters) == 1 else None


def dash_of_lengths(lengths: Sequence[float]) -> Dash:
    """Return the kind of dash that strokes and gaps in turn make, as in SVG; without gaps a line is solid."""
    row = [length for length in lengths if isfinite(length)] * (1 + len(lengths) % 2)
    drawn, gaps = row[::2], row[1::2]
    if not any(gap > 0 for gap in gaps):
        return "solid"
    if min(drawn) <= max(drawn) / 2 and max(drawn) > 0:
        return "dash-dot"
    return "dotted" if 2 * max(drawn) <= max(gaps) else "dashed"


def dash_of_line_type(name: str) -> Dash:
    """Return the kind of dash of a line type of DXF; whatever is not continuous has gaps."""
    name = name.upper()
    if name in ("CONTINUOUS", "BYBLOCK"):
        return "solid"
    if any(word in name for word in _DASH_DOT):
        return "dash-dot"
    return "dotted" if any(word in name for word in _DOTTED) else "dashed"


def name_of_rgb(rgb: Rgb) -> str:
    """Return a colour as ``#ffa500``."""
    return "#{:02x}{:02x}{:02x}".format(*rgb)


LEFT_OUT = "-"
"""In place of an assignment: lines that are no part of the pattern."""
_ASSIGNMENTS = "MVBCFUJ" + LEFT_OUT
# Distance in RGB, summed: programs round what they convert, and a colour that was stated leaves nothing to be guessed.
_STATED_NEAR = 40
_KINDS = 6  # kinds of strokes named in a message, the most frequent: a drawing with text has dozens
_YOSHIZAWA: Mapping[Dash, str] = {"dash-dot": "M", "dashed": "V"}
_NOT = "have strokes that are not understood"
_WAYS = (
    "origami colours (mountain red, valley blue, border black), or layers or groups named mountain, valley, "
    "border; state others by --colour M=#c1272d,V='dashed #000000' or --layer M=NAME (in Python colours=, "
    "layers=); '-' leaves lines out"
)
_READ_DASHES = "dash-dot lines read as mountains, dashed ones as valleys (Yoshizawa and Randlett)"

Looks: TypeAlias = Mapping[str, str | Sequence[str]]
"""Assignments to looks, or to names of layers: one or several."""


class _Look(NamedTuple):
    """A look that is stated; None leaves a part of it open."""

    rgb: Rgb | None
    number: int | None
    dash: Dash | None

    def rank(self) -> int:
        """Return how particular the look is."""
        return 2 * (self.dash is not None) + (self.rgb is not None or self.number is not None)

    def far(self, stroke: Stroke) -> int | None:
        """Return how far the colour of a stroke is from it; None if the stroke does not look so."""
        if self.dash not in (None, stroke.dash) or self.number not in (None, stroke.index):
            return None
        if self.rgb is None:
            return 0
        if stroke.rgb is None:
            return None
        apart = sum(abs(x - y) for x, y in zip(self.rgb, stroke.rgb, strict=True))
        return apart if apart <= _STATED_NEAR else None


class Interpretation(NamedTuple):
    """The assignment of each stroke or None, notes on what dashes say, and the strokes left out in words."""

    letters: tuple[str | None, ...]
    notes: tuple[str, ...]
    left_out: str


@dataclass(frozen=True, slots=True)
class Legend:
    """The stated assignments of strokes: pairs of a letter and a look, or the name of a layer or a group."""

    looks: tuple[tuple[str, _Look], ...] = ()
    layers: tuple[tuple[str, str], ...] = ()

    @classmethod
    def of(cls, colours: Looks | None = None, layers: Looks | None = None) -> Legend:
        """Return a legend from letters and the looks or the names of layers that have them, one or several.

        A look is a colour of CSS, or the number of a colour in DXF, with or without the kind of dash before it.
        """
        looks = [(letter, _look(text)) for letter, text in _pairs(colours or {}, "colour")]
        return cls(tuple(looks), tuple(_pairs(layers or {}, "layer")))

    def understood(self, strokes: Sequence[Stroke]) -> Interpretation:
        """Return the assignments of the strokes of one drawing; InvariantError if most lines have none."""
        named = [_named(stroke.names) for stroke in strokes]
        if len(set(named)) == 1:  # a name that all lines have says nothing about any
            named = [None] * len(strokes)
        letters = [
            self._stated(stroke) or stroke.letter or name or _by_colour(stroke)
            for stroke, name in zip(strokes, named, strict=True)
        ]
        waiting = [number for number, letter in enumerate(letters) if letter is None and strokes[number].rgb]
        notes: tuple[str, ...] = ()
        dark = [number for number in waiting if letter_of_colour(*(strokes[number].rgb or ())) == "B"]
        if not set(letters) & set("MVU") and {strokes[number].dash for number in dark} >= set(_YOSHIZAWA):
            for number in dark:
                letters[number] = _YOSHIZAWA.get(strokes[number].dash)
            notes = (_READ_DASHES,)
        unread = [stroke for stroke, letter in zip(strokes, letters, strict=True) if letter is None]
        kinds = Counter(stroke.kind for stroke in unread)
        missing, every = (sum(stroke.lines for stroke in some) for some in (unread, strokes))
        if 2 * missing > every:
            raise InvariantError("strokes", f"{missing} of {numbered(every, 'line')} {_NOT}: {_listed(kinds)}", _WAYS)
        return Interpretation(tuple(letters), notes, described_strokes(kinds))

    def _stated(self, stroke: Stroke) -> str | None:
        """Return the stated assignment of a stroke."""
        for name in stroke.names:
            for letter, layer in self.layers:
                if name.casefold() == layer.casefold():
                    return letter
        fits = [(-look.rank(), look.far(stroke), letter) for letter, look in self.looks]
        near = [(rank, far, letter) for rank, far, letter in fits if far is not None]
        return min(near, key=lambda fit: fit[:2])[2] if near else None


UNSTATED = Legend()
"""The legend of a drawing without stated assignments."""


def _pairs(looks: Looks, what: str) -> list[tuple[str, str]]:
    """Return pairs of a letter and a look or the name of a layer; InvariantError if a letter is none."""
    pairs = []
    for letter, texts in looks.items():
        if letter not in _ASSIGNMENTS or len(letter) != 1:
            expected = f"one of {' '.join(_ASSIGNMENTS)}, the last to leave lines out"
            raise InvariantError(what, f"the assignment {shown(letter)}", expected)
        pairs += [(letter, text) for text in ([texts] if isinstance(texts, str) else texts)]
    return pairs


def _look(text: str) -> _Look:
    """Read a look: ``#c1272d``, ``dashed #000000``, ``dash-dot``, ``30`` (the number of a colour in DXF)."""
    first, _, rest = text.strip().partition(" ")
    dash, colour = (cast("Dash", first), rest.strip()) if first in get_args(Dash) else (None, text.strip())
    if dash is not None and not colour:
        return _Look(None, None, dash)
    if colour.isascii() and colour.isdigit() and len(colour) < 4:
        return _Look(None, int(colour), dash)
    rgb = rgb_of_css(colour)
    if rgb is None:
        kinds = ", ".join(get_args(Dash))
        expected = f"a colour of CSS such as #c1272d, the number of one in DXF, or a kind of dash ({kinds})"
        raise InvariantError("colour", f"the look {shown(text)}", f"{expected}, or both: 'dashed #000000'")
    return _Look(rgb, None, dash)


def _named(names: Sequence[str]) -> str | None:
    """Return the assignment that the innermost name with one states."""
    return next((letter for name in names if (letter := letter_of_name(name)) is not None), None)


def _by_colour(stroke: Stroke) -> str | None:
    """Return the assignment of a stroke by its colour; black with gaps has none by itself."""
    if stroke.rgb is None:
        return None
    letter = letter_of_colour(*stroke.rgb)
    return None if letter == "B" and stroke.dash != "solid" else letter


def described_strokes(kinds: Counter[str]) -> str:
    """Return the strokes that were not understood, by kind and number; empty if none."""
    if not kinds:
        return ""
    return f"{numbered(kinds.total(), 'shape')} with strokes not understood left out: {_listed(kinds)}"


def _listed(kinds: Counter[str]) -> str:
    named = [f"{number} {kind}" for kind, number in kinds.most_common(_KINDS)]
    if len(kinds) > _KINDS:
        named.append(numbered(len(kinds) - _KINDS, "more kind"))
    return ", ".join(named)
