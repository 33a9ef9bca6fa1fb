"""How much work a file may call for: limits that are told when they are met, and can be raised.

A file of a few bytes can ask for hours: a number of links, shapes that use shapes, lines that all cross. What a
limit stops is refused with its name; ``SYNTHEDRA_MOST`` in the environment raises (or lowers) it,
``crossings=1000000`` or several of them with commas between. The table is in docs/files.md.
"""

from __future__ import annotations

import os
import re

from graphs.errors import FileError, InvariantError
from graphs.plain_text import shown

__all__ = ["LIMITS", "VARIABLE", "check_work", "how_to_raise", "most"]

VARIABLE = "SYNTHEDRA_MOST"
LIMITS = {
    "megabytes": 100,
    "nodes": 250_000,
    "basis": 250,
    "crossings": 10_000,
    "meetings": 1_000_000,
    "shapes": 30_000,
    "levels": 250,
    "letters": 10_000,
}
"""Name to the most that is allowed:

- ``megabytes``: of a file;
- ``nodes``: links or vertices that a bare number calls for;
- ``basis``: joints of a part that is not planar, of a bare graph, which needs a shortest cycle basis;
- ``crossings``: points where lines of a pattern cross;
- ``meetings``: pairs of lines that meet, and of ends that are near each other;
- ``shapes``: elements of an SVG file that ``use`` draws beyond those that are written there;
- ``levels``: groups in groups of an SVG file, what ``use`` draws among them;
- ``letters``: of a transform or a style sheet of an SVG file.
"""


def most(name: str) -> int:
    """Return the most that is allowed of something.

    Parameters
    ----------
    name : str
        A key of `LIMITS`.

    Returns
    -------
    int

    Raises
    ------
    FileError
        If ``SYNTHEDRA_MOST`` cannot be understood.

    Examples
    --------
    >>> most("shapes")
    30000
    """
    found = dict(LIMITS)
    for part in filter(None, os.environ.get(VARIABLE, "").split(",")):
        match = re.fullmatch(r" *(\w+) *= *(\d{1,15}) *", part, re.ASCII)
        if match is None or match[1] not in LIMITS:
            raise FileError(VARIABLE, "", shown(part), f"NAME=NUMBER, the name one of {' '.join(LIMITS)}")
        found[match[1]] = int(match[2])
    return found[name]


def how_to_raise(name: str, needed: int | None = None) -> str:
    """Return what to expect of something, and how to allow more of it.

    Parameters
    ----------
    name : str
        A key of `LIMITS`.
    needed : int, optional
        How much is called for; what is proposed is that, and at least twice the limit.

    Returns
    -------
    str

    Raises
    ------
    FileError
        As of `most`.

    Examples
    --------
    >>> how_to_raise("shapes", 200_000)
    'at most 30000 (SYNTHEDRA_MOST=shapes=200000 allows more)'
    """
    limit = most(name)
    return f"at most {limit} ({VARIABLE}={name}={max(needed or 0, 2 * limit)} allows more)"


def check_work(name: str, needed: int, what: str) -> None:
    """Refuse what calls for too much.

    Parameters
    ----------
    name : str
        A key of `LIMITS`.
    needed : int
        How much it calls for.
    what : str
        What there are so many of, for the message.

    Raises
    ------
    InvariantError
        With the limit, and how to raise it. A reader of files makes a FileError of it.

    Examples
    --------
    >>> check_work("basis", 4950, "joints in a part that is not planar")
    Traceback (most recent call last):
    ...
    graphs.errors.InvariantError: 4950 joints in a part that is not planar; expected at most 250 \
(SYNTHEDRA_MOST=basis=4950 allows more) [limit]
    """
    if needed > most(name):
        raise InvariantError("limit", f"{needed} {what}", how_to_raise(name, needed))
