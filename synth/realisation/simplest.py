"""The simplest drawn type of what is given: of an SC graph or a chain the one with the fewest open edges.

Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

import networkx as nx

from enumerate.scd.jobs import mechanism_of, scd_graphs_of
from graphs.convert.table import Mechanism, to_scd
from graphs.errors import UnsolvableError, numbered
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph

__all__ = ["simplest_drawn"]

_MORE_SIDES = 4
"""Links get at most so many sides more than the joints of the link with the most."""


def simplest_drawn(mechanism: Mechanism) -> tuple[SCDGraph, tuple[str, ...]]:
    """Return the SCD graph that something is, has, or, of an SC graph, the first of the fewest open edges.

    With it come notes on what was chosen. Raises `UnsolvableError` if it has no drawing, or no valid placement of
    open edges.

    >>> from graphs.loops.loop import Loop
    >>> scd, notes = simplest_drawn(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))]))
    >>> scd.counts.open_edges, notes
    (4, ('an SCD graph of the fewest open edges was taken: 4 open edges',))
    """
    if isinstance(mechanism, SCDGraph) or not isinstance(mechanism, SCGraph):
        return to_scd(mechanism), ()
    if not nx.check_planarity(nx.Graph(mechanism))[0]:
        raise UnsolvableError("the chain is not planar: its panels cannot be drawn without crossings")
    widest = max(dict(mechanism.degree).values())
    for most in range(max(3, widest), widest + _MORE_SIDES + 1):
        mechanism_of(mechanism, most)  # which says what stands in the way
        found = list(scd_graphs_of(mechanism, most))
        if found:
            scd = min(found, key=lambda one: one.counts.open_edges)
            told = numbered(scd.counts.open_edges, "open edge")
            return scd, (f"an SCD graph of the fewest open edges was taken: {told}",)
    raise UnsolvableError(f"no placement of open edges with links of up to {widest + _MORE_SIDES} sides is valid")
