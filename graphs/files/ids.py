"""What names a mechanism besides the name of its file: an id, or a line of a file of many."""

from __future__ import annotations

import re
from pathlib import Path

from graphs.convert.link_joint import sc_from_link_joint_graph
from graphs.errors import FileError, InvariantError
from graphs.identity.chains import chain_from_id
from graphs.identity.drawings import mechanism_from_map_id
from graphs.mechanism.sc import SCGraph

__all__ = ["is_id", "line_named", "mechanism_of_id"]

_IDS = ("k1:", "m1:")


def is_id(path: str | Path) -> bool:
    """Say whether the name of a file is the id of a mechanism.

    >>> is_id("k1:Cr"), is_id("./k1:Cr")
    (True, False)
    """
    return str(path).startswith(_IDS) and not isinstance(path, Path)


def mechanism_of_id(code: str) -> SCGraph:
    """Return the mechanism of an id; a chain gets finite centres, as a bare link-joint graph does.

    Raise FileError if it is not an id.
    """
    try:
        if code.startswith("k1:"):
            return sc_from_link_joint_graph(chain_from_id(code))
        return mechanism_from_map_id(code)
    except InvariantError as error:
        raise FileError(code, "", error.offender, error.expected) from None


_LINE = re.compile(r"(.+\.[gs]6):([1-9][0-9]{0,17})", re.IGNORECASE | re.DOTALL)


def line_named(path: str | Path) -> tuple[Path, str | None]:
    """Return the file of a line of a graph6 file, ``chains.g6:7``, and the line; None for a whole file.

    An existing file with the whole name takes precedence.

    >>> path, line = line_named("chains.g6:7")
    >>> path.name, line
    ('chains.g6', '7')
    """
    parts = _LINE.fullmatch(str(path))
    if parts is None or Path(path).exists():
        return Path(path), None
    return Path(parts[1]), parts[2]
