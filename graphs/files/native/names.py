"""Names of links, joints and vertices in native files."""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from typing import Any

from graphs.errors import UnsolvableError, shown
from graphs.files.check import Checker

__all__ = ["count_or_names", "head", "is_count", "names", "tuple_of", "written"]

VERSION = 1


def head(kind: str) -> dict[str, Any]:
    """Return the keys every native document starts with."""
    return {"format": f"synthedra/{kind}", "version": VERSION}


def written(name: Hashable) -> str | int:
    """Return a name as it is written in a file; UnsolvableError if it is neither text nor an integer."""
    if isinstance(name, bool) or not isinstance(name, str | int):
        raise UnsolvableError(f"the id {shown(name)} cannot be written: ids in files are text or integers")
    return name


def is_count(listed: Iterable[Hashable]) -> bool:
    """Tell whether names are just 0, 1, 2, ..."""
    return all(type(name) is int and name == i for i, name in enumerate(listed))


def count_or_names(listed: Iterable[Hashable]) -> int | list[str | int]:
    """Return how many names there are if they are 0, 1, 2, ..., else the names."""
    every = list(listed)
    return len(every) if is_count(every) else [written(name) for name in every]


def names(value: Any, key: str, check: Checker) -> list[Hashable]:
    """Read a list of names, or how many there are."""
    if isinstance(value, list):
        return [check.name(name, f"{key}[{i}]") for i, name in enumerate(value)]
    if isinstance(value, bool) or not isinstance(value, int):
        check.fail(key, value, "a list of names, or how many")
    return list(range(check.how_many(value, key)))


def tuple_of(
    value: Any, place: str, check: Checker, length: int | None = None, what: str = "a list of vertices"
) -> tuple[Hashable, ...]:
    """Read a list of names, of a given length if one is given."""
    listed = check.list(value, place, length, what)
    return tuple(check.name(v, f"{place}[{i}]", "a name (text or an integer)") for i, v in enumerate(listed))
