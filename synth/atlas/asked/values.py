"""Stored values of an atlas as what they mean; those that mean nothing are damage, reported with its place."""

from __future__ import annotations

from collections.abc import Iterable
from math import inf
from pathlib import Path
from typing import Any

from enumerate.runner.job import ListColumn, unstored
from graphs.errors import StoreError, shown
from graphs.plain_text import plain
from synth.atlas.columns import COLUMNS, KINDS

__all__ = ["damaged", "text_values", "value_of"]

_NAMES = {int: "a whole number", float: "a number", str: "a text", bool: "0 or 1"}
_NEVER_EMPTY = ("id", "kind")


def value_of(path: Path, name: str, stored: Any) -> Any:
    """Return the value of a column as stored by SQLite; None if it is unknown, or the kind of type has none.

    Raise StoreError, with the path of the atlas, if it is no value of this column.

    >>> value_of(Path("a.sqlite"), "assortment", "[4,2]"), value_of(Path("a.sqlite"), "planar", 1)
    ((4, 2), True)
    >>> value_of(Path("a.sqlite"), "links", "six")
    Traceback (most recent call last):
    ...
    graphs.errors.StoreError: a.sqlite: is damaged: links is 'six'; expected a whole number; build it again
    """
    if stored is None and name not in _NEVER_EMPTY:
        return None
    holds = COLUMNS[name].holds
    if isinstance(holds, ListColumn):
        return _list_of(path, name, stored, holds)
    if name == "kind" and stored not in KINDS:
        raise damaged(path, name, stored, f"one of {', '.join(KINDS)}")
    if not isinstance(stored, (int, float) if holds is float else int if holds is bool else holds):
        raise damaged(path, name, stored, _NAMES[holds])
    if (holds is bool and stored not in (0, 1)) or stored in (inf, -inf):
        raise damaged(path, name, stored, _NAMES[holds])
    return bool(stored) if holds is bool else stored


def text_values(path: Path, what: str, values: Iterable[Any]) -> None:
    """Check that values of the view of relations, or of a row of a statement, are texts.

    Raise StoreError if one is not.
    """
    for value in values:
        if not isinstance(value, str):
            raise damaged(path, what, value, "a text")


def damaged(path: Path, what: str, value: Any, expected: str) -> StoreError:
    """Return the error that tells of a value which nobody wrote."""
    return StoreError(
        f"{plain(path, 4096)}: is damaged: {what} is {shown(value)}; expected {expected}; build it again"
    )


def _list_of(path: Path, name: str, stored: Any, column: ListColumn) -> tuple[Any, ...]:
    kind = column.kind or object
    try:
        values = unstored(stored) if isinstance(stored, str) else None
    except (ValueError, TypeError, RecursionError):
        values = None
    if values is None or not all(isinstance(value, kind) for value in values):
        raise damaged(path, name, stored, "a list in JSON")
    return values
