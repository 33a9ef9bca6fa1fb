"""The columns of an atlas, their values as they are stored, and the types that the literature names.

A value that no atlas writes is damage, reported with its place. Names are in ``synth/synthesis/atlas/named.json``
with their sources; the theory says how the file is made. Theory: docs/theory/atlas.md.
"""

import json
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from math import inf
from pathlib import Path
from typing import Any

from enumerate.runner.job import Column, ListColumn, unstored
from enumerate.strings.panel_strings import ChainString
from graphs.errors import StoreError, shown
from graphs.mechanism.sc import ARRANGEMENTS
from graphs.printing import plain

SCHEMA = 2
"""Version of the columns and of what they mean."""

KINDS = ("chain", "sc", "scd", "string", "order")
"""Kinds of types: kinematic chains, SC graphs, SCD graphs, R/- strings, cyclic orders of joints round a cone."""

_GRAPHS = ("chain", "sc", "scd", "order")
_DRAWN = ("sc", "scd")


@dataclass(frozen=True, slots=True)
class AtlasColumn:
    """A column of the table of types; `says` describes its value in words.

    `kinds` are the kinds of types that have a value there; an indexed column finds rows without a full scan.
    """

    holds: Column
    says: str
    kinds: tuple[str, ...] = KINDS
    indexed: bool = False


COLUMNS: dict[str, AtlasColumn] = {
    "id": AtlasColumn(str, "canonical id; of an order, the chain's and the joints in order", indexed=True),
    "kind": AtlasColumn(str, "chain, sc, scd, string or order", indexed=True),
    "name": AtlasColumn(str, "name in the literature", indexed=True),
    "links": AtlasColumn(int, "links; of a string, panels and both bodies", indexed=True),
    "joints": AtlasColumn(int, "joints (creases)", indexed=True),
    "dof": AtlasColumn(int, "degrees of freedom by count; of a string, between its ends", indexed=True),
    "exact_dof": AtlasColumn(int, "exact generic mobility", _DRAWN),
    "loops": AtlasColumn(int, "independent loops", _GRAPHS, indexed=True),
    "spatial": AtlasColumn(int, "loops without a centre", _DRAWN),
    "centres": AtlasColumn(int, "spherical centres, classes of loops with one centre", _DRAWN, indexed=True),
    "arrangement": AtlasColumn(str, "how centres are arranged: " + ", ".join(ARRANGEMENTS), _DRAWN, indexed=True),
    "infinite": AtlasColumn(int, "centres at infinity", _DRAWN),
    "explicit": AtlasColumn(int, "centres that are vertices of the links", ("scd",)),
    "implicit": AtlasColumn(int, "remote centres, which the links do not reach", ("scd",)),
    "all_explicit": AtlasColumn(bool, "one sheet without holes", ("scd",), indexed=True),
    "open_edges": AtlasColumn(int, "sides of links without a joint", ("scd",)),
    "sides": AtlasColumn(ListColumn(","), "numbers of links with 3, 4, ... sides", ("scd",)),
    "max_sides": AtlasColumn(int, "most sides of a link, joints and open edges together", ("scd",)),
    "vertices": AtlasColumn(int, "vertices of the polyhedron model", ("scd",)),
    "assortment": AtlasColumn(ListColumn(","), "numbers of binary, ternary, ... links", ("chain", "sc")),
    "loop_sizes": AtlasColumn(ListColumn(","), "joints of each loop with a centre", ("sc",)),
    "outer_size": AtlasColumn(int, "joints round the outside of the drawing", ("sc",)),
    "longest_string": AtlasColumn(int, "binary links in the longest row of them", ("chain",)),
    "symmetry": AtlasColumn(int, "number of symmetries, the identity among them", _GRAPHS, indexed=True),
    "planar": AtlasColumn(bool, "whether the link-joint graph is planar", ("chain",)),
    "fractionated": AtlasColumn(bool, "whether one link or joint cuts it in two", ("chain",)),
    "inversions": AtlasColumn(int, "links that differ as ground", ("chain",), indexed=True),
    "grounds": AtlasColumn(ListColumn(","), "one ground link of each inversion", ("chain",)),
    "ride_alongs": AtlasColumn(int, "ride-alongs that can be removed", _DRAWN, indexed=True),
    "chain_id": AtlasColumn(str, "id of the kinematic chain", ("sc", "scd", "order"), indexed=True),
    "sc_id": AtlasColumn(str, "id of the SC graph", ("scd",), indexed=True),
    "reduced": AtlasColumn(str, "id of the chain that is left without ride-alongs", _DRAWN, indexed=True),
    "planar_analogue": AtlasColumn(str, "id of the SC graph with all centres at infinity", ("sc",)),
    "spherical_analogue": AtlasColumn(str, "id of the SC graph with one centre for all loops", ("sc",)),
    "general_form": AtlasColumn(str, "id of the SC graph with as many different centres as possible", ("sc",)),
    "stands_for": AtlasColumn(str, "joints that a string stands for, such as UPS", ("string",)),
    "panels": AtlasColumn(str, "id of a string as panels", ("string",), indexed=True),
    "distance": AtlasColumn(str, "distance of the ends of a string: coincident, fixed or variable", ("string",)),
    "modes": AtlasColumn(int, "arrangements of the vertices of a string", ("string",)),
    "comment": AtlasColumn(str, "for a string: parallel axes, fewer freedoms than creases", ("string",)),
    "circuits": AtlasColumn(ListColumn(" ", kind=str), "how each loop winds round the cone", ("order",)),
    "open_loops": AtlasColumn(int, "loops that are open circuits", ("order",)),
    "layers": AtlasColumn(int, "fewest layers on the cone", ("order",)),
    "most_layers": AtlasColumn(int, "most layers on the cone", ("order",)),
    "full_rank": AtlasColumn(bool, "no first-order motion beyond the count on the cone", ("order",)),
    "realised": AtlasColumn(bool, "whether panels with coordinates were found", ("scd",), indexed=True),
    "flat": AtlasColumn(bool, "realised as a flat sheet; else in space", ("scd",)),
    "least_angle_deg": AtlasColumn(float, "least angle of a panel", ("scd",)),
    "edge_ratio": AtlasColumn(float, "shortest edge by longest", ("scd",)),
    "fold_deg": AtlasColumn(float, "largest fold angle before panels collide", ("scd",)),
    "fold_end": AtlasColumn(str, "reason for the end of that motion", ("scd",)),
    "fold_file": AtlasColumn(str, "the realised type (FOLD)", ("scd",)),
}
"""By their names, in the order in which they are stored."""


RELATIONS = {
    "chain_id": ("has the chain", "is the chain of"),
    "sc_id": ("is a drawing, with open edges, of", "is, without open edges,"),
    "reduced": ("reduces to", "is what is left without ride-alongs of"),
    "planar_analogue": ("has the planar analogue", "is the planar analogue of"),
    "spherical_analogue": ("has the spherical analogue", "is the spherical analogue of"),
    "general_form": ("has the general form", "is the general form of"),
}
"""Columns that hold the id of another type, with the relation to it, and its relation to this one."""


def stored_columns() -> dict[str, Column]:
    """Return the columns in the form of the runner of enumerations."""
    return {name: column.holds for name, column in COLUMNS.items()}


_NAMES = {int: "a whole number", float: "a number", str: "a text", bool: "0 or 1"}
_NEVER_EMPTY = ("id", "kind")


def value_of(path: Path, name: str, stored: Any) -> Any:
    """Return the value of a column as stored by SQLite; None if it is unknown, or the kind of type has none.

    Raise StoreError, with the path of the atlas, if it is no value of this column.
    """
    if stored is None and name not in _NEVER_EMPTY:
        return None
    holds = COLUMNS[name].holds
    if isinstance(holds, ListColumn):
        return _list_of(path, name, stored, holds)
    if name == "kind" and stored not in KINDS:
        raise damaged(path, name, stored, f"one of {', '.join(KINDS)}")
    is_of_type = isinstance(stored, (int, float) if holds is float else int if holds is bool else holds)
    if not is_of_type or (holds is bool and stored not in (0, 1)) or stored in (inf, -inf):
        raise damaged(path, name, stored, _NAMES[holds])
    return bool(stored) if holds is bool else stored


def text_values(path: Path, what: str, values: Iterable[Any]) -> None:
    """Check that values of the view of relations, or of a statement, are texts; StoreError if one is not."""
    for value in values:
        if not isinstance(value, str):
            raise damaged(path, what, value, "a text")


def damaged(path: Path, what: str, value: Any, expected: str) -> StoreError:
    """Return the error for a value that no atlas writes."""
    return StoreError(
        f"{plain(path, 4096)}: is damaged: {what} is {shown(value)}; expected {expected}; try to build it again"
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


@dataclass(frozen=True, slots=True)
class NamedType:
    """A type that has a name, and the source that uses it."""

    kind: str
    id: str
    name: str
    source: str


@cache
def named_types() -> tuple[NamedType, ...]:
    """Return all types of the file, in its order.

    Returns
    -------
    tuple of NamedType

    Examples
    --------
    >>> next(entry for entry in named_types() if entry.name == "Watt chain").id
    'k1:E`hW'
    """
    text = files("synth.synthesis.atlas").joinpath("named.json").read_text(encoding="utf-8")
    return tuple(NamedType(**entry) for entry in json.loads(text))


@cache
def _names() -> dict[tuple[str, str], str]:
    names: dict[tuple[str, str], list[str]] = {}
    for entry in named_types():
        names.setdefault((entry.kind, entry.id), []).append(entry.name)
    return {key: "; ".join(dict.fromkeys(every)) for key, every in names.items()}


def name_of_type(kind: str, code: str) -> str | None:
    """Return the name of a type, or None; a string has the name of the joints for which it stands."""
    if kind == "string":
        return ChainString.parse(code).mechanism
    return _names().get((kind, code))


def name_of_id(code: str) -> str | None:
    """Return the name of a chain, an SC or an SCD graph by its id, or None.

    Examples
    --------
    >>> name_of_id("k1:E`hW"), name_of_id("m1:ab.ac.bde.cfg.dg.ef"), name_of_id("k1:E?")
    ('Watt chain', 'Stephenson six-bar', None)
    """
    return next(filter(None, (name_of_type(kind, code) for kind in ("chain", "sc", "scd"))), None)
