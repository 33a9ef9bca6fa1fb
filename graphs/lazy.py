"""Faces of rooms: names that a folder offers, imported from its files when they are first asked for (PEP 562)."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from importlib import import_module

__all__ = ["offered"]


def offered(
    package: str, names: Mapping[str, str]
) -> tuple[Callable[[str], object], Callable[[], list[str]], list[str]]:
    """Return ``__getattr__``, ``__dir__`` and ``__all__`` of a folder that offers names of its files.

    Parameters
    ----------
    package : str
        Name of the folder's package.
    names : mapping of str to str
        For each file the names it has, parted by spaces; a file elsewhere with its packages.

    Examples
    --------
    >>> look_up, _, every = offered("graphs.loops", {"loop": "Centre Loop"})
    >>> every, look_up("Loop").__name__
    (['Centre', 'Loop'], 'Loop')
    """
    places = {
        name: file if "." in file else f"{package}.{file}" for file, here in names.items() for name in here.split()
    }

    def look_up(name: str) -> object:
        if name not in places:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        value: object = getattr(import_module(places[name]), name)
        setattr(sys.modules[package], name, value)  # found at once from now on
        return value

    def names_of_room() -> list[str]:
        return sorted({*vars(sys.modules[package]), *places})

    return look_up, names_of_room, sorted(places)
