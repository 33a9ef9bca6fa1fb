"""What an atlas says of a type: its columns, what they hold, and of which kinds of types.

Theory: docs/theory/atlas.md.
"""

from __future__ import annotations

from dataclasses import dataclass

from enumerate.runner.job import Column, ListColumn
from graphs.mechanism.arrangement import ARRANGEMENTS

__all__ = ["COLUMNS", "KINDS", "SCHEMA", "AtlasColumn", "stored_columns"]

SCHEMA = 2
"""Version of the columns and of what they mean."""

KINDS = ("chain", "sc", "scd", "string", "order")
"""Kinds of types: kinematic chains, SC graphs, SCD graphs, R/- strings, cyclic orders of joints round a cone."""

_GRAPHS = ("chain", "sc", "scd", "order")
_DRAWN = ("sc", "scd")


@dataclass(frozen=True, slots=True)
class AtlasColumn:
    """A column of the table of types; `says` describes its value in words.

    `kinds` are those of types that have a value there; with an index rows are found by it without a full scan.
    """

    holds: Column
    says: str
    kinds: tuple[str, ...] = KINDS
    indexed: bool = False


COLUMNS: dict[str, AtlasColumn] = {
    "id": AtlasColumn(str, "canonical id; of an order, the chain's and the joints in order", indexed=True),
    "kind": AtlasColumn(str, "chain, sc, scd, string or order", indexed=True),
    "name": AtlasColumn(str, "what the literature calls it", indexed=True),
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
    "ride_alongs": AtlasColumn(int, "ride-alongs that can be taken off", _DRAWN, indexed=True),
    "chain_id": AtlasColumn(str, "id of the kinematic chain", ("sc", "scd", "order"), indexed=True),
    "sc_id": AtlasColumn(str, "id of the SC graph", ("scd",), indexed=True),
    "reduced": AtlasColumn(str, "id of the chain that is left without ride-alongs", _DRAWN, indexed=True),
    "planar_analogue": AtlasColumn(str, "id of the SC graph with all centres at infinity", ("sc",)),
    "spherical_analogue": AtlasColumn(str, "id of the SC graph with one centre for all loops", ("sc",)),
    "general_form": AtlasColumn(str, "id of the SC graph with centres as different as can be", ("sc",)),
    "stands_for": AtlasColumn(str, "joints that a string stands for, such as UPS", ("string",)),
    "panels": AtlasColumn(str, "id of a string as panels", ("string",), indexed=True),
    "distance": AtlasColumn(str, "of the ends of a string: coincident, fixed or variable", ("string",)),
    "modes": AtlasColumn(int, "ways in which the vertices of a string may lie", ("string",)),
    "comment": AtlasColumn(str, "of a string: axes that are parallel, freedoms fewer than creases", ("string",)),
    "circuits": AtlasColumn(ListColumn(" ", kind=str), "how each loop winds round the cone", ("order",)),
    "open_loops": AtlasColumn(int, "loops that are open circuits", ("order",)),
    "layers": AtlasColumn(int, "fewest layers on the cone", ("order",)),
    "most_layers": AtlasColumn(int, "most layers on the cone", ("order",)),
    "full_rank": AtlasColumn(bool, "no first-order motion beyond the count on the cone", ("order",)),
    "realised": AtlasColumn(bool, "whether panels with coordinates were found", ("scd",), indexed=True),
    "flat": AtlasColumn(bool, "realised as a flat sheet; else as a pose in space", ("scd",)),
    "least_angle_deg": AtlasColumn(float, "least angle of a panel", ("scd",)),
    "edge_ratio": AtlasColumn(float, "shortest edge by longest", ("scd",)),
    "fold_deg": AtlasColumn(float, "how far the crease that turns most folds before panels meet", ("scd",)),
    "fold_end": AtlasColumn(str, "what ends that motion", ("scd",)),
    "fold_file": AtlasColumn(str, "the realised type (FOLD)", ("scd",)),
}
"""By their names, in the order in which they are stored."""


def stored_columns() -> dict[str, Column]:
    """Return the columns as the runner of enumerations takes them."""
    return {name: column.holds for name, column in COLUMNS.items()}
