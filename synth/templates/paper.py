"""Sizes of paper."""

from __future__ import annotations

import re
from dataclasses import dataclass

from graphs.errors import InvariantError, shown

__all__ = ["FOOTER", "MARGIN", "OVERLAP", "Paper", "paper_named"]

MARGIN = 10.0
"""Millimetres of each side of a page on which nothing is printed: what printers leave free."""
FOOTER = 20.0
"""Millimetres at the foot of a page, above the margin, for the gauge and what the lines mean."""
OVERLAP = 10.0
"""Millimetres by which tiles on pages that meet overlap."""
_SIZES = {"a4": (210.0, 297.0), "a3": (297.0, 420.0), "letter": (215.9, 279.4)}
_LEAST, _MOST = 130.0, 5000.0
_NUMBER = r"(\d{1,4}(?:\.\d{1,3})?)"


@dataclass(frozen=True)
class Paper:
    """A size of paper.

    Parameters
    ----------
    width, height : float
        Millimetres.

    Raises
    ------
    InvariantError
        If a side is shorter than 130 mm, in which the gauge has no place, or longer than 5 m.

    Examples
    --------
    >>> Paper(210, 297).window
    (190.0, 257.0)
    """

    width: float
    height: float

    def __post_init__(self) -> None:
        if not all(_LEAST <= side <= _MOST for side in (self.width, self.height)):
            found = f"paper of {self.width:g} x {self.height:g} mm"
            raise InvariantError("paper", found, f"sides from {_LEAST:g} to {_MOST:g} mm")

    @property
    def window(self) -> tuple[float, float]:
        """Width and height of what a page holds of a template: all but margins and footer."""
        return self.width - 2 * MARGIN, self.height - 2 * MARGIN - FOOTER

    def turned(self) -> Paper:
        """Return the same paper turned by a quarter."""
        return Paper(self.height, self.width)


def paper_named(name: str) -> Paper:
    """Return the paper of a name: A4, A3, Letter, or WIDTHxHEIGHT in millimetres.

    Parameters
    ----------
    name : str
        In any case of letters.

    Returns
    -------
    Paper

    Raises
    ------
    InvariantError
        If it is none of these.

    Examples
    --------
    >>> paper_named("letter"), paper_named("300x200")
    (Paper(width=215.9, height=279.4), Paper(width=300.0, height=200.0))
    """
    if name.lower() in _SIZES:
        return Paper(*_SIZES[name.lower()])
    match = re.fullmatch(f"{_NUMBER}x{_NUMBER}", name.strip().lower())
    if match is None:
        raise InvariantError("paper", f"paper {shown(name)}", "A4, A3, Letter, or WIDTHxHEIGHT in mm")
    return Paper(float(match[1]), float(match[2]))
