"""Rows of SCD graphs: ids and attributes of the placements of open edges on a mechanism."""

from __future__ import annotations

import numpy as np

from enumerate.chains.rows import chain_ids
from enumerate.kernel.centre_labels import SPATIAL
from enumerate.kernel.map_texts import map_ids
from enumerate.runner.columns import Column, ListColumn
from enumerate.runner.job import Row
from enumerate.runner.limits import ANY_NUMBER
from enumerate.scd.choices import outline
from enumerate.scd.listing import list_placements_of, sides_of_all
from enumerate.scd.query import PlacementQuery
from graphs.types import Bytes, Ints

__all__ = ["SCD_COLUMNS", "placements_on", "scd_rows_of"]

SCD_COLUMNS: dict[str, Column] = {
    "code": str,
    "sc": str,
    "chain": str,
    "links": int,
    "joints": int,
    "dof": int,
    "loops": int,
    "spatial": int,
    "centres": int,
    "infinite": int,
    "sides": ListColumn(","),
    "open_edges": int,
    "vertices": int,
    "explicit": int,
    "implicit": int,
    "symmetry": int,
    "exact_dof": int,
}


def placements_on(
    query: PlacementQuery, code: Bytes, labels: Ints, dof: int, first: int, last: int
) -> tuple[Bytes, Ints, Ints]:
    """Return the placements that a query asks for, as `enumerate.scd.listing.list_placements_of` does.

    The code is without open edges; labels begin with the outer face, and the last number is excluded.
    """
    codes, lengths, facts = list_placements_of(
        code, labels, query.max_degree, dof, first, last, query.sheets, query.symmetric
    )
    if query.vertices == ANY_NUMBER:
        return codes, lengths, facts
    kept = query.vertices.admitted(facts[:, 1])
    return codes[kept], lengths[kept], facts[kept]


def scd_rows_of(query: PlacementQuery, code: Bytes, labels: Ints, dof: int, first: int, last: int) -> list[Row]:
    """Return the rows of the placements on a mechanism; columns are `SCD_COLUMNS`. Arguments: `placements_on`."""
    codes, lengths, facts = placements_on(query, code, labels, dof, first, last)
    if not len(codes):
        return []
    faces = len(labels)
    text, joints, centres, infinite = outline(code, labels)
    links = int(joints.max()) + 1
    sc = map_ids(text[None], np.array([len(text)]), faces)[0]
    chain = chain_ids(links, joints[None])[0][0]
    spatial = int((labels == SPATIAL).sum())
    common = sc, chain, links, len(joints), dof, faces - 1, spatial, centres, infinite
    sides = sides_of_all(codes, lengths, faces, query.max_degree)[:, 3:].tolist()
    return [
        (code_text, *common, _without_last_zeros(degrees), *values)
        for code_text, degrees, values in zip(map_ids(codes, lengths, faces), sides, facts.tolist(), strict=True)
    ]


def _without_last_zeros(counts: list[int]) -> tuple[int, ...]:
    last = max(i for i, count in enumerate(counts) if count)
    return tuple(counts[: last + 1])
