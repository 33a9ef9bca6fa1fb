"""Rows of SC graphs: ids and attributes of the SC graphs of contracted maps."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np

from enumerate.chains.rows import assortment_of, chain_ids
from enumerate.contracted.binary_links import Wanted
from enumerate.kernel.map_texts import map_ids
from enumerate.runner.columns import Column, ListColumn
from enumerate.runner.job import Row
from enumerate.runner.limits import ANY_NUMBER
from enumerate.sc.listing import Centres, centres_of_all, describe, list_drawn
from enumerate.sc.query import SCQuery
from graphs.types import Bytes, Ints

__all__ = ["SC_COLUMNS", "DrawnChains", "sc_rows_of"]

SC_COLUMNS: dict[str, Column] = {
    "code": str,
    "chain": str,
    "links": int,
    "joints": int,
    "dof": int,
    "loops": int,
    "spatial": int,
    "centres": int,
    "infinite": int,
    "assortment": ListColumn(","),
    "loop_sizes": ListColumn(","),
    "outer_size": int,
    "symmetry": int,
    "reduced": str,
    "exact_dof": int,
}


@dataclass(frozen=True, slots=True)
class DrawnChains:
    """The SC graphs of one contracted map and outer face that a query asks for; a ring has an empty code.

    Binary links on each joint are uint8[r, m], labels of the faces int64[r, F] (`enumerate.kernel.centre_labels`);
    `order` is the number of symmetries.
    """

    code: Bytes
    n: int
    outer: int
    x: Bytes
    labels: Ints
    order: Ints

    @classmethod
    def of(cls, query: SCQuery, code: Bytes, n: int, outer: int, only: int, prefix: Ints) -> DrawnChains:
        """List them, or those that begin in one way (`enumerate.chains.counting.count_of_graph`)."""
        most = query.chains.most
        wanted, centres = Wanted(query.links, most, only), Centres(query.dof, query.spatial, query.infinite)
        x, labels, order = list_drawn(code, n, outer, wanted, prefix, centres)
        kept = query.symmetry.admitted(order)
        if len(code) and query.longest_string.least > 0:
            kept &= x.max(axis=1, initial=0) >= query.longest_string.least
        if query.centres != ANY_NUMBER:
            kept &= query.centres.admitted(centres_of_all(code, n, query.links, x, labels))
        return cls(code, n, outer, x[kept], labels[kept], order[kept])


def sc_rows_of(query: SCQuery, drawn: DrawnChains) -> list[Row]:
    """Return the rows of the SC graphs of a contracted map with an outer face; columns are `SC_COLUMNS`."""
    if not len(drawn.x):
        return []
    codes, joints, sizes, facts, left = describe(
        drawn.code, drawn.n, query.links, drawn.outer, drawn.x, drawn.labels, not query.plain
    )
    labels = 0 if query.plain else drawn.labels.shape[1]
    ids = map_ids(codes, np.full(len(codes), codes.shape[1]), labels)
    chains, _ = chain_ids(query.links, joints)
    degrees = Counter(np.bincount(joints[0].ravel()).tolist())
    common = query.links, query.chains.joints, query.dof, query.loops, query.spatial
    assortment = assortment_of(degrees)
    whole = (1 << query.chains.joints) - 1
    inner = np.sort(sizes[:, 1:], axis=1).tolist()
    return [
        (
            code,
            chain,
            *common,
            centres,
            infinite,
            assortment,
            tuple(loops),
            outer,
            symmetry,
            chain if kept == whole else _reduced(joints[i], kept),
            exact,
        )
        for i, (code, chain, (centres, infinite, exact), loops, outer, symmetry, kept) in enumerate(
            zip(
                ids,
                chains,
                facts.tolist(),
                inner,
                sizes[:, 0].tolist(),
                drawn.order.tolist(),
                left.tolist(),
                strict=True,
            )
        )
    ]


def _reduced(joints: Ints, kept: int) -> str:
    """Return the id of the chain of some of the joints."""
    pairs = [pair for k, pair in enumerate(joints.tolist()) if kept >> k & 1]
    number: dict[int, int] = {}
    named = [[number.setdefault(link, len(number)) for link in pair] for pair in pairs]
    return chain_ids(len(number), np.array([named], np.int64))[0][0]
