"""R/- strings as graphs: the panels between two bodies, and back from a chain of panels to its string.

Source: Wiener 2016, sections 5.1.2 and 5.2. Theory: docs/theory/strings.md.
"""

from __future__ import annotations

from itertools import pairwise

from enumerate.strings.panel_strings import ChainString
from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.mechanism.drawing import Side
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.types import JointId, LinkId

__all__ = ["chain_sc", "chain_scd", "string_of_chain"]


def chain_sc(chain: ChainString) -> SCGraph:
    """Return the SC graph of a chain between two bodies: links 0 and n, and n - 1 panels between them.

    Parameters
    ----------
    chain : ChainString

    Returns
    -------
    SCGraph
        An open chain, without loops.

    Examples
    --------
    >>> len(chain_sc(ChainString.parse("RR-R-RRR")))
    7
    """
    return SCGraph(chain.creases + 1, [(i, i + 1) for i in range(chain.creases)])


def chain_scd(chain: ChainString, mode: str | None = None, ends: tuple[int, int] = (3, 3)) -> SCDGraph:
    """Return the SCD graph of a chain between two bodies.

    The link between two creases of a cluster is a triangle, the creases meeting in one of its vertices; a
    panel is a quadrilateral.

    Parameters
    ----------
    chain : ChainString
    mode : str, optional
        One letter for each gap between clusters of two or more: S, the next vertex lies on the same side, or
        D, on the other. All S without it.
    ends : (int, int), optional
        Numbers of sides of the two bodies.

    Raises
    ------
    InvariantError
        If the mode has not as many letters as there are gaps, or others, or a body has fewer than three sides.

    Examples
    --------
    >>> scd = chain_scd(ChainString.parse("RR-R-RRR"))
    >>> scd.counts.vertices, scd.counts.edges
    (11, 21)
    """
    gaps = max(sum(k >= 2 for k in chain.clusters) - 1, 0)
    letters = "S" * gaps if mode is None else mode
    if len(letters) != gaps or set(letters) - {"S", "D"}:
        raise InvariantError("mode", f"the mode {shown(letters)} of {chain.text}", f"{gaps} letters S or D")
    turns = iter(letters)
    rotation: dict[LinkId, list[Side]] = {0: [0, *[None] * (ends[0] - 1)]}
    above, seen, crease = False, False, 0
    for k in chain.clusters:
        if crease:  # the rectangular panel before this cluster
            rotation[crease] = [crease, None, crease - 1, None]
        if k >= 2 and seen:
            above ^= next(turns) == "D"
        seen |= k >= 2
        for _ in range(k - 1):
            crease += 1
            rotation[crease] = [crease, crease - 1, None] if above else [crease, None, crease - 1]
        crease += 1
    rotation[crease] = [crease - 1, *[None] * (ends[1] - 1)]
    return SCDGraph(crease + 1, [(i, i + 1) for i in range(crease)], rotation=rotation)


def string_of_chain(scd: SCDGraph) -> tuple[ChainString, str]:
    """Return the string and the mode of a chain of panels between two bodies.

    Parameters
    ----------
    scd : SCDGraph
        An open chain. Between its ends, a link whose two creases share a vertex belongs to a cluster; any
        other is a panel.

    Returns
    -------
    chain : ChainString
        From the body that comes first in the graph.
    mode : str

    Raises
    ------
    UnsolvableError
        If the graph is no open chain, or creases that meet one by one do not all meet in one point.

    Examples
    --------
    >>> chain, mode = string_of_chain(chain_scd(ChainString.parse("RR-RRR"), "D"))
    >>> chain.text, mode
    ('RR-RRR', 'D')
    """
    path, creases = _walk(scd)
    clusters, corners = [1], [-1]  # creases so far in each cluster, and the vertex in which they meet
    sides: list[bool] = []
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
    mode = "".join("S" if one == two else "D" for one, two in pairwise(sides))
    return ChainString(tuple(clusters)), mode


def _walk(scd: SCDGraph) -> tuple[list[LinkId], list[JointId]]:
    """Return the links of an open chain from end to end, and the joints between them."""
    ends = [link for link in scd.nodes if scd.degree(link) == 1]
    if scd.independent_loops or len(ends) != 2 or any(scd.degree(link) > 2 for link in scd.nodes):
        raise UnsolvableError("the graph is no open chain between two bodies")
    path: list[LinkId] = [ends[0]]
    creases: list[JointId] = []
    while path[-1] != ends[1]:
        here = path[-1]
        ((joint, link),) = (
            (joint, other) for _, other, joint in scd.edges(here, keys=True) if not creases or joint != creases[-1]
        )
        creases.append(joint)
        path.append(link)
    return path, creases
