"""The numbered colours of DXF, the AutoCAD colour index, as red, green and blue."""

from __future__ import annotations

from colorsys import hsv_to_rgb
from functools import lru_cache

from graphs.files.patterns.css_colours import Rgb

__all__ = ["rgb_of_number"]

_FIRST = {
    1: (255, 0, 0),
    2: (255, 255, 0),
    3: (0, 255, 0),
    4: (0, 255, 255),
    5: (0, 0, 255),
    6: (255, 0, 255),
    7: (0, 0, 0),
    8: (128, 128, 128),
    9: (192, 192, 192),
}
"""7 is black on white paper."""
_GREYS = {250: 51, 251: 91, 252: 132, 253: 173, 254: 214, 255: 255}
_VALUES = (1.0, 0.65, 0.5, 0.3, 0.15)


@lru_cache(maxsize=300)
def rgb_of_number(number: int) -> Rgb | None:
    """Return a numbered colour; None if there is none.

    From 10 on each ten is a hue, 15 degrees from the last; odd numbers are pale.

    >>> rgb_of_number(7), rgb_of_number(30), rgb_of_number(174), rgb_of_number(300)
    ((0, 0, 0), (255, 128, 0), (0, 0, 128), None)
    """
    if number in _FIRST:
        return _FIRST[number]
    if number in _GREYS:
        return (_GREYS[number],) * 3
    if not 10 <= number < 250:
        return None
    hue, shade = divmod(number - 10, 10)
    red, green, blue = hsv_to_rgb(hue / 24, 0.5 if shade % 2 else 1.0, _VALUES[shade // 2])
    return round(255 * red), round(255 * green), round(255 * blue)
