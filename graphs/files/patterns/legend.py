"""The legend of a drawing: which lines are mountains, valleys, borders, ..., stated or seen; and those left out.

What is stated comes first, the most particular before the rest: a layer, dashes of a colour, dashes, a colour.
Then names of layers and groups that say it, then colours (:mod:`graphs.files.patterns.strokes`). Of a drawing that
has both, and no coloured folds, dash-dot black lines are mountains and dashed ones valleys: the notation of
Yoshizawa and Randlett. Otherwise black dashes are not understood: house styles that draw all in black differ.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias, cast, get_args

from graphs.errors import InvariantError, numbered, shown
from graphs.files.patterns.css_colours import Rgb, rgb_of_css
from graphs.files.patterns.strokes import Dash, Stroke, letter_of_colour, letter_of_name

__all__ = ["LEFT_OUT", "UNSTATED", "Legend", "Told", "Understood", "described_strokes"]

LEFT_OUT = "-"
"""In place of an assignment: lines that are no part of the pattern."""
_ASSIGNMENTS = "MVBCFUJ" + LEFT_OUT
_NEAR = 40
"""A colour that was stated is met within this (in RGB): programs round what they convert."""
_KINDS = 6
"""So many kinds of strokes are named."""
_YOSHIZAWA: Mapping[Dash, str] = {"dash-dot": "M", "dashed": "V"}
_NOT = "have strokes that are not understood"
_WAYS = (
    "origami colours (mountain red, valley blue, border black), or layers or groups named mountain, valley, "
    "border; state others by --colour M=#c1272d,V='dashed #000000' or --layer M=NAME (in Python colours=, "
    "layers=); '-' leaves lines out"
)
_READ_DASHES = "dash-dot lines read as mountains, dashed ones as valleys (Yoshizawa and Randlett)"

Told: TypeAlias = Mapping[str, str | Sequence[str]]
"""Assignments to looks, or to names of layers: one or several."""


class _Look(NamedTuple):
    """What is stated of a look; None is whatever it may be."""

    rgb: Rgb | None
    number: int | None
    dash: Dash | None

    def rank(self) -> int:
        """How particular it is."""
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
        return apart if apart <= _NEAR else None


class Understood(NamedTuple):
    """The assignment of each stroke, None of those that were not understood.

    `notes` says what was taken from dashes, and `left_out` which strokes were not understood, empty if all were.
    """

    letters: tuple[str | None, ...]
    notes: tuple[str, ...]
    left_out: str


@dataclass(frozen=True, slots=True)
class Legend:
    """What was stated of the strokes of a drawing.

    `looks` and `layers` are pairs of a letter and a look, or the name of a layer or a group.
    """

    looks: tuple[tuple[str, _Look], ...] = ()
    layers: tuple[tuple[str, str], ...] = ()

    @classmethod
    def of(cls, colours: Told | None = None, layers: Told | None = None) -> Legend:
        """Return a legend from letters and the looks or the names of layers that have them, one or several.

        A look is a colour of CSS, or the number of a colour in DXF, with or without the kind of dash before it, or
        the kind alone. Raise InvariantError if a letter or a look is none.

        >>> legend = Legend.of({"M": "#c1272d", "V": ["teal", "dashed #000000"]})
        >>> legend.understood([Stroke((0, 128, 128)), Stroke((0, 0, 0), "dashed"), Stroke((0, 0, 0))]).letters
        ('V', 'V', 'B')
        """
        looks = [(letter, _look(text)) for letter, text in _pairs(colours or {}, "colour")]
        return cls(tuple(looks), tuple(_pairs(layers or {}, "layer")))

    def understood(self, strokes: Sequence[Stroke]) -> Understood:
        """Return what the strokes of one drawing are.

        Raise InvariantError if more than half of the lines are in strokes that are not understood: what is left is
        not the pattern. It names the ways to state what they are.
        """
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
            raise InvariantError(
                "strokes", f"{missing} of {numbered(every, 'line')} {_NOT}: {_listed(kinds)}", _WAYS
            )
        return Understood(tuple(letters), notes, described_strokes(kinds))

    def _stated(self, stroke: Stroke) -> str | None:
        """Return what was stated of a stroke."""
        for name in stroke.names:
            for letter, layer in self.layers:
                if name.casefold() == layer.casefold():
                    return letter
        fits = [(-look.rank(), look.far(stroke), letter) for letter, look in self.looks]
        near = [(rank, far, letter) for rank, far, letter in fits if far is not None]
        return min(near, key=lambda fit: fit[:2])[2] if near else None


UNSTATED = Legend()
"""The legend of a drawing of which nothing was stated."""


def _pairs(told: Told, what: str) -> list[tuple[str, str]]:
    pairs = []
    for letter, texts in told.items():
        if letter not in _ASSIGNMENTS or len(letter) != 1:
            expected = f"one of {' '.join(_ASSIGNMENTS)}, the last for lines that are to be left out"
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
    """Return what the innermost name that says something says."""
    return next((letter for name in names if (letter := letter_of_name(name)) is not None), None)


def _by_colour(stroke: Stroke) -> str | None:
    """Return what a stroke is by its colour; black with gaps is nothing by itself."""
    if stroke.rgb is None:
        return None
    letter = letter_of_colour(*stroke.rgb)
    return None if letter == "B" and stroke.dash != "solid" else letter


def described_strokes(kinds: Counter[str]) -> str:
    """Return the strokes that were not understood, by kind and number; empty if none.

    >>> described_strokes(Counter({"#ffa500": 3, "dashed #000000": 12}))
    '15 shapes with strokes not understood left out: 12 dashed #000000, 3 #ffa500'
    """
    if not kinds:
        return ""
    return f"{numbered(kinds.total(), 'shape')} with strokes not understood left out: {_listed(kinds)}"


def _listed(kinds: Counter[str]) -> str:
    named = [f"{number} {kind}" for kind, number in kinds.most_common(_KINDS)]
    if len(kinds) > _KINDS:
        named.append(numbered(len(kinds) - _KINDS, "more kind"))
    return ", ".join(named)
