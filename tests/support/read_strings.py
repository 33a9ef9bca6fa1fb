"""The string and the mode of a chain of panels, read off its SCD graph: what `chain_scd` draws, backwards."""

from itertools import pairwise

import networkx as nx

from enumerate.strings.panel_strings import ChainString
from graphs.errors import UnsolvableError, shown


def string_of_chain(scd):
    """The string of an open chain between two bodies, from the body that comes first in the graph, and its mode.

    Between its ends, a link whose two creases share a vertex belongs to a cluster; any other is a panel.

    >>> from enumerate.strings.panel_strings import chain_scd
    >>> chain, mode = string_of_chain(chain_scd(ChainString.parse("RR-RRR"), "D"))
    >>> chain.text, mode
    ('RR-RRR', 'D')
    """
    path, creases = _walk(scd)
    clusters, corners = [1], [-1]  # creases so far in each cluster, and the vertex in which they meet
    sides = []
    for before, link, after in zip(creases, path[1:-1], creases[1:], strict=False):
        common = set(scd.drawing.ends_of_joint(before)) & set(scd.drawing.ends_of_joint(after))
        if not common:
            clusters.append(1)
            corners.append(-1)
            continue
        (vertex,) = common
        if clusters[-1] == 1:
            row = scd.rotation[link]
            sides.append(row[(row.index(before) - 1) % len(row)] == after)
            corners[-1] = vertex
        elif corners[-1] != vertex:
            raise UnsolvableError(f"joint {shown(before)} meets the joints on its two sides in different points")
        clusters[-1] += 1
    mode = "".join("S" if before == after else "D" for before, after in pairwise(sides))
    return ChainString(tuple(clusters)), mode


def _walk(scd):
    """The links of an open chain from end to end, and the joints between them."""
    ends = [link for link in scd.nodes if scd.degree(link) == 1]
    if scd.independent_loops or len(ends) != 2 or any(scd.degree(link) > 2 for link in scd.nodes):
        raise UnsolvableError("the graph is not an open chain between two bodies")
    path = nx.shortest_path(scd, *ends)
    return path, [next(iter(scd[a][b])) for a, b in pairwise(path)]
