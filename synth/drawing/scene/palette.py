"""Colours by name, on light and on dark paper, for all kinds of sight; widths of lines and sizes of letters.

The eight colours of classes are those of Okabe and Ito, but for yellow, which is too light on paper; on dark
paper the darker ones are lightened. Whatever a colour tells is told by a dash, a sign or a number too.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from graphs.errors import InvariantError, shown

__all__ = ["CLASSES", "FINE", "LARGE", "NORMAL", "PAPERS", "SMALL", "STRONG", "colour_of", "colour_of_class"]

FINE, NORMAL, STRONG = 0.5, 1.0, 1.6
"""Widths of lines in points: what is beside the matter, what it is made of, what is to be seen first."""

SMALL, LARGE = 6.5, 9.0
"""Sizes of letters in points: numbers in a picture, titles."""

CLASSES = 8
"""Colours of classes; further classes take them again, and are told apart by their numbers."""

_LIGHT = {
    "paper": "#ffffff",
    "ink": "#1a1a1a",
    "grey": "#767676",
    "faint": "#d4d4d4",
    "body": "#e8ecf0",
    "ground": "#b9bec4",
    "front": "#f4f5f6",
    "back": "#a9d4ef",
    "shadow": "#4a535c",
    "marked": "#f5e27a",
    "mountain": "#c8242b",
    "valley": "#0a64ad",
    "cut": "#00795a",
    "unassigned": "#9a4f7c",
    "flat": "#b0b0b0",
    "class0": "#0072b2",
    "class1": "#d55e00",
    "class2": "#009e73",
    "class3": "#cc79a7",
    "class4": "#b8860b",
    "class5": "#56b4e9",
    "class6": "#8c564b",
    "class7": "#6a3d9a",
}
_DARK = {
    "paper": "#14171a",
    "ink": "#ececec",
    "grey": "#9d9d9d",
    "faint": "#42474c",
    "body": "#2b3238",
    "ground": "#59626b",
    "front": "#a5adb5",
    "back": "#5b9cc7",
    "shadow": "#101316",
    "marked": "#6b5c12",
    "mountain": "#ff6f6a",
    "valley": "#6cb4f5",
    "cut": "#3fcf9f",
    "unassigned": "#e3a0c8",
    "flat": "#6a6f75",
    "class0": "#4aa8e0",
    "class1": "#ff9147",
    "class2": "#35c79c",
    "class3": "#e3a0c8",
    "class4": "#e6b84a",
    "class5": "#8ccff5",
    "class6": "#c4938a",
    "class7": "#b08ee0",
}
PAPERS: Mapping[str, Mapping[str, str]] = MappingProxyType({"light": _LIGHT, "dark": _DARK})
"""Name of a paper to its colours."""


def colour_of(name: str, paper: str) -> str:
    """Return a colour as ``#rrggbb``; InvariantError if there is no such colour, or no such paper.

    >>> colour_of("paper", "light"), colour_of("paper", "dark")
    ('#ffffff', '#14171a')
    """
    if paper not in PAPERS:
        raise InvariantError("paper", f"the paper {shown(paper)} is not known", " or ".join(PAPERS))
    colours = PAPERS[paper]
    if name not in colours:
        raise InvariantError("colour", f"the colour {shown(name)} is not known", ", ".join(colours))
    return colours[name]


def colour_of_class(number: int) -> str:
    """Return the name of the colour of a class of joints, loops or links.

    >>> colour_of_class(9)
    'class1'
    """
    return f"class{number % CLASSES}"
