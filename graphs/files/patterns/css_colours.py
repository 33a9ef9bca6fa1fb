"""Colours as CSS writes them: ``#c1272d``, ``rgb()``, ``hsl()``, names."""

from __future__ import annotations

import re
from colorsys import hls_to_rgb
from functools import lru_cache
from math import tau
from typing import TypeAlias

__all__ = ["Rgb", "rgb_of_css"]

Rgb: TypeAlias = tuple[int, int, int]

_HEX = re.compile(r"#(?:[0-9a-f]{3,4}|[0-9a-f]{6}|[0-9a-f]{8})")
_FUNCTION = re.compile(r"(rgb|hsl)a?\(([^()]{1,100})\)")
_TURNS = {"": 360.0, "deg": 360.0, "grad": 400.0, "rad": tau, "turn": 1.0}
_NUMBER = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+))(%|deg|grad|rad|turn)?")


@lru_cache(maxsize=1000)
def rgb_of_css(text: str) -> Rgb | None:
    """Return red, green and blue, 0 to 255, of a colour of CSS without its opacity; None if it is none.

    >>> rgb_of_css("#C1272D"), rgb_of_css("hsl(240deg 100% 50% / 0.5)"), rgb_of_css("crimson !important")
    ((193, 39, 45), (0, 0, 255), (220, 20, 60))
    >>> rgb_of_css("url(#gradient)"), rgb_of_css("none")
    (None, None)
    """
    text = text.replace("!important", "").strip().lower()
    if _HEX.fullmatch(text):
        digits = text[1:] if len(text) > 5 else "".join(2 * digit for digit in text[1:])
        return int(digits[:2], 16), int(digits[2:4], 16), int(digits[4:6], 16)
    if found := _FUNCTION.fullmatch(text):
        numbers = [_NUMBER.fullmatch(word) for word in re.split(r"[\s,/]+", found[2].strip())]
        parts = [(float(one[1]), one[2] or "") for one in numbers if one is not None]
        if len(parts) == len(numbers) and len(parts) in (3, 4):
            return _of_rgb(parts[:3]) if found[1] == "rgb" else _of_hsl(parts[:3])
        return None
    return _named(text)


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


def _named(text: str) -> Rgb | None:
    """Return a colour by its name; svgelements takes every name that it does not know for black."""
    import svgelements

    if not text.isalpha() or text in ("none", "transparent"):
        return None
    colour = svgelements.Color(text)
    found = (int(colour.red), int(colour.green), int(colour.blue))
    return None if found == (0, 0, 0) and text != "black" else found
