"""Pages of the reference, one a room, made of what the rooms' faces offer; `conf.py` runs it."""

from __future__ import annotations

from importlib import import_module
from inspect import getdoc
from pathlib import Path
from pkgutil import iter_modules
from types import FunctionType, UnionType
from typing import get_args

from cross_links import with_links

__all__ = ["write_reference"]

_PACKAGES = ("graphs", "enumerate", "synth")
_INSIDE = ("cli", "ids", "lazy", "arrays")
"""Modules that are no part of the reference."""


def write_reference(folder: Path) -> list[tuple[str, object]]:
    """Write the pages of the rooms into a folder, the front door, and the list of them.

    Parameters
    ----------
    folder : Path
        ``reference`` of the documentation.

    Returns
    -------
    list of (str, object)
        The names under which functions and classes are documented, and these.
    """
    (folder / "rooms").mkdir(parents=True, exist_ok=True)
    place_of: dict[int, str] = {}
    made = []
    rooms = [f"{package}.{room}" for package in _PACKAGES for room in _rooms_of(package)]
    for module in (*rooms, "synth"):  # the face last: what a room has is documented there
        names = _offered_by(module)
        if names:
            made.append(module)
            _replace(folder / "rooms" / f"{module}.md", _page_of_room(module, names, place_of))
    _replace(folder / "index.md", _front_door(place_of, made))
    return [(name, _named(name)) for name in place_of.values()]


def _named(name: str) -> object:
    module, _, last = name.rpartition(".")
    return getattr(import_module(module), last)


def _rooms_of(package: str) -> list[str]:
    """Return the rooms of a package, those of a folder without a face by themselves: ``analysis.motion``."""
    rooms: list[str] = []
    for info in iter_modules(import_module(package).__path__):
        if info.ispkg and not hasattr(import_module(f"{package}.{info.name}"), "__all__"):
            rooms += [f"{info.name}.{inner}" for inner in _rooms_of(f"{package}.{info.name}")]
        elif info.name not in _INSIDE:
            rooms.append(info.name)
    return sorted(rooms)


def _offered_by(module: str) -> list[str]:
    """Return the functions and classes that a room offers."""
    room = import_module(module)
    return [name for name in getattr(room, "__all__", ()) if isinstance(getattr(room, name), FunctionType | type)]


def _page_of_room(module: str, names: list[str], place_of: dict[int, str]) -> str:
    """Return the page of a room; what another room has documented is named there only."""
    room = import_module(module)
    new = [
        name for name in names if place_of.setdefault(id(getattr(room, name)), f"{module}.{name}") == f"{module}.{name}"
    ]
    rows = [f"   {place_of[id(getattr(room, name))]}" for name in names]
    parts = [with_links(getdoc(room) or ""), ".. autosummary::\n   :nosignatures:\n\n" + "\n".join(rows)]
    parts += [_directive(module, name, getattr(room, name)) for name in new]
    return f"# {module}\n\n```{{eval-rst}}\n" + "\n\n".join(parts) + "\n```\n"


def _directive(module: str, name: str, thing: object) -> str:
    if isinstance(thing, FunctionType):
        return f".. autofunction:: {module}.{name}"
    return f".. autoclass:: {module}.{name}\n   :members:"


def _front_door(place_of: dict[int, str], rooms: list[str]) -> str:
    """Return the first page: what `import synth` offers, and the rooms."""
    synth = import_module("synth")
    rows = [_row(name, getattr(synth, name), place_of) for name in sorted(synth.__all__)]
    lines = [
        "# Reference",
        "",
        "```{eval-rst}",
        with_links(getdoc(synth) or ""),
        "",
        "What of this is stable, and how names are deprecated: :doc:`/stability`.",
        "",
        ".. list-table::",
        "   :widths: 25 75",
        "",
        *rows,
    ]
    lines += [
        "```",
        "",
        "```{toctree}",
        ":maxdepth: 1",
        ":caption: Rooms",
        "",
        *(f"rooms/{room}" for room in rooms),
        "```",
        "",
    ]
    return "\n".join(lines)


def _row(name: str, thing: object, place_of: dict[int, str]) -> str:
    """Return a row of the table of the front door: a name, linked to where it is documented, and what it does."""
    place = place_of.get(id(thing))
    told = f":py:obj:`{name} <{place}>`" if place else f"``{name}``"
    first = (getdoc(thing) or "").partition("\n\n")[0].replace("\n", " ")
    if isinstance(thing, UnionType):
        first = "Type: " + ", ".join(f"``{part.__name__}``" for part in get_args(thing)) + "."
    return f"   * - {told}\n     - {first}"


def _replace(place: Path, text: str) -> None:
    """Write a page if it is another: Sphinx reads again what is newer."""
    if not place.is_file() or place.read_text(encoding="utf-8") != text:
        place.write_text(text, encoding="utf-8")
