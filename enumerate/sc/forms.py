"""The most general spherical-system form of every planar chain: the SC graphs with the most centres.

Source: Wiener 2016, section 3.3.5: Watt's chain has two centres, Stephenson's one.
Theory: docs/theory/sc-enumeration.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from enumerate.chains.names import name_of
from enumerate.contracted.embedded import joint_matrix, outer_faces
from enumerate.contracted.graphs import graph_key
from enumerate.runner.columns import Column, ListColumn
from enumerate.runner.job import Row, Unit
from enumerate.sc.jobs import UNIT_ROWS, MapPart, Maps, drawn_of, map_units, maps_for, number_in
from enumerate.sc.query import SCQuery
from enumerate.sc.rows import SC_COLUMNS, sc_rows_of

__all__ = ["FormJob"]

_COLUMNS: dict[str, Column] = {
    "code": str,
    "chain": str,
    "name": str,
    "links": int,
    "joints": int,
    "dof": int,
    "loops": int,
    "assortment": ListColumn(","),
    "sc_graphs": int,
    "centres": int,
    "forms": int,
}
_CODE, _CHAIN, _CENTRES = (list(SC_COLUMNS).index(name) for name in ("code", "chain", "centres"))


@dataclass(frozen=True)
class FormJob:
    """One row for each planar chain: how many SC graphs it has, and one with the most centres.

    ``centres`` of the query limits what counts as a form: chains without such SC graphs have no row.
    """

    query: SCQuery

    @property
    def columns(self) -> dict[str, Column]:
        """Names and types of the values of a row."""
        return _COLUMNS

    @property
    def key(self) -> dict[str, Any]:
        """What the job is, in JSON values."""
        return {"enumerate": "sc forms", **self.query.key}

    def units(self) -> Sequence[Unit]:
        """Units of whole contracted graphs: all drawings of a chain are in one."""
        found = [Unit((unit.payload,), unit.weight) for unit in map_units(self.query) if self.query.loops == 1]
        held: list[Maps] = []
        weight = 0
        for maps, count in self._graphs():
            if held and weight + count > UNIT_ROWS:
                found.append(Unit(tuple(held), weight))
                held, weight = [], 0
            held.append(maps)
            weight += count
        return [*found, Unit(tuple(held), weight)] if held else found

    def _graphs(self) -> Iterator[tuple[Maps, int]]:
        """Yield the maps of each contracted graph, with all their outer faces, and the number of SC graphs."""
        for n, codes in maps_for(self.query):
            graphs: dict[bytes, list[MapPart]] = {}
            for code in codes:
                parts = [MapPart(code, n, outer) for outer in outer_faces(code).tolist()]
                graphs.setdefault(graph_key(joint_matrix(code, n), n).tobytes(), []).extend(parts)
            for maps in graphs.values():
                count = sum(number_in(self.query, part) for part in maps)
                if count:
                    yield tuple(maps), count

    def work(self, payload: tuple[Maps, ...]) -> list[Row]:
        """Return the rows of a unit."""
        return [row for maps in payload for row in self._forms(maps)]

    def _forms(self, maps: Maps) -> list[Row]:
        """Return a row for each chain drawn in some maps."""
        rows = [row for part in maps for row in sc_rows_of(self.query, drawn_of(self.query, part))]
        chains: dict[str, list[Row]] = {}
        for row in rows:
            chains.setdefault(row[_CHAIN], []).append(row)
        found = []
        for chain, drawings in chains.items():
            most = max(row[_CENTRES] for row in drawings)
            forms = sorted(row[_CODE] for row in drawings if row[_CENTRES] == most)
            kept = dict(zip(SC_COLUMNS, drawings[0], strict=True))
            kept |= {"code": forms[0], "name": name_of(chain), "sc_graphs": len(drawings), "centres": most}
            kept["forms"] = len(forms)
            found.append(tuple(kept[column] for column in _COLUMNS))
        return found
