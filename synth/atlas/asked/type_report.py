"""All that an atlas knows of one type, and of the types it is related to."""

from __future__ import annotations

import sqlite3
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from graphs.printing import Block, Printed, TableBlock, plain
from synth.atlas.asked.values import text_values, value_of
from synth.atlas.columns import COLUMNS
from synth.atlas.names import NamedType, named_types

__all__ = ["Neighbour", "TypeReport", "report_of"]

_MOST, _PRINTED = 200, 12
"""Neighbours that are listed, and those of each relation that are printed."""


@dataclass(frozen=True, slots=True)
class Neighbour:
    """A type to which another is related; `relation` is such as ``has the chain``, or ``is the chain of``.

    `there`: the atlas holds it.
    """

    relation: str
    id: str
    name: str | None
    there: bool

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {"relation": self.relation, "id": self.id, "name": self.name, "in_the_atlas": self.there}


@dataclass(frozen=True, slots=True)
class TypeReport(Printed):
    """A type: its known values by column, its names, and its neighbours.

    `more` counts the neighbours that are not listed.
    """

    values: dict[str, Any]
    named: tuple[NamedType, ...]
    neighbours: tuple[Neighbour, ...]
    more: int

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on."""
        return {
            "type": {name: list(v) if isinstance(v, tuple) else v for name, v in self.values.items()},
            "names": [{"name": one.name, "source": one.source} for one in self.named],
            "neighbours": [one.to_json() for one in self.neighbours],
            "more_neighbours": self.more,
        }

    def blocks(self) -> list[Block]:
        """Return the lines that are printed."""
        lines: list[Block] = [f"{one.name}: {one.source}" for one in self.named]
        rows = [
            (name.replace("_", " "), _told(value), COLUMNS[name].says)
            for name, value in self.values.items()
            if name != "fold_file"
        ]
        lines.append(TableBlock(("what", "value", "meaning"), rows))
        told, unlisted = self.told_neighbours()
        if told:
            lines.append(TableBlock(("relation", "id", "name", "in this atlas"), told))
        if self.more + unlisted:
            lines.append(f"and {self.more + unlisted} more that are related to it")
        return lines

    def told_neighbours(self) -> tuple[list[tuple[str, str, str, str]], int]:
        """Return rows of the first neighbours of each relation, named ones first; and how many are left."""
        ranked = sorted(self.neighbours, key=lambda one: (one.relation, one.name is None))
        rows: list[tuple[str, str, str, str]] = []
        listed: Counter[str] = Counter()
        for one in ranked:
            listed[one.relation] += 1
            if listed[one.relation] <= _PRINTED:
                rows.append((one.relation, one.id, one.name or "", "" if one.there else "no"))
        return rows, len(ranked) - len(rows)

    def __repr__(self) -> str:
        return f"<TypeReport: {plain(self.values['id'])}>"


def report_of(connection: sqlite3.Connection, code: str, path: Path) -> TypeReport | None:
    """Return the report of a type of an atlas by its id, or its name; None if there is none.

    Raise StoreError, with the path of the atlas, if it is damaged.
    """
    names = ", ".join(f'"{name}"' for name in COLUMNS)
    row = None
    for column in ("id", "name", "stands_for"):
        row = row or connection.execute(f"SELECT {names} FROM type WHERE {column} = ? LIMIT 1", (code,)).fetchone()
    if row is None:
        return None
    read = {name: value_of(path, name, value) for name, value in zip(COLUMNS, row, strict=True)}
    values = {name: value for name, value in read.items() if value is not None}
    neighbours, more = _neighbours(connection, values["id"], path)
    named = tuple(one for one in named_types() if one.id == values["id"])
    return TypeReport(values, named, tuple(neighbours), more)


def _neighbours(connection: sqlite3.Connection, code: str, path: Path) -> tuple[list[Neighbour], int]:
    """Return what a type is of others, and others of it; and how many more of these there are."""
    known = "(SELECT name FROM type WHERE type.id = {0} LIMIT 1), EXISTS (SELECT 1 FROM type WHERE type.id = {0})"
    onward = connection.execute(
        f"SELECT relation, other, {known.format('other')} FROM relations WHERE id = ?", (code,)
    ).fetchall()
    backward = connection.execute(
        f"SELECT relation, id, {known.format('relations.id')} FROM relations WHERE other = ? AND id <> ? LIMIT ?",
        (code, code, _MOST + 1),
    ).fetchall()
    text_values(path, "the id of a related type", (one for _, one, *_ in (*onward, *backward)))
    found = [
        Neighbour(relation, other, name, bool(there)) for relation, other, name, there in onward if other != code
    ]
    found += [Neighbour(f"{_REVERSED[relation]}", one, name, True) for relation, one, name, _ in backward[:_MOST]]
    if len(backward) <= _MOST:
        return found, 0
    [every] = connection.execute(
        "SELECT count(*) FROM relations WHERE other = ? AND id <> ?", (code, code)
    ).fetchone()
    return found, every - _MOST


_REVERSED = {
    "has the chain": "is the chain of",
    "is a drawing, with open edges, of": "is, without open edges,",
    "reduces to": "is what is left without ride-alongs of",
    "has the planar analogue": "is the planar analogue of",
    "has the spherical analogue": "is the spherical analogue of",
    "has the general form": "is the general form of",
}


def _told(value: Any) -> str:
    if isinstance(value, tuple):
        return ",".join(map(str, value))
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.6g}" if isinstance(value, float) else plain(value, 10_000)
