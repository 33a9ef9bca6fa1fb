"""SCD graphs: every valid placement of open edges on every SC graph, and on every plane tree.

The thesis stops at single examples of SCD graphs (section 3.4); here are all of a size, by the rules of
`graphs.mechanism.scd` and with the exact rank under the forced geometry (rule S3). Theory:
docs/theory/scd-enumeration.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from enumerate.kernel.centre_labels import FINITE, MOST_JOINTS, OUTER
from enumerate.kernel.map_texts import LABEL_LETTERS
from enumerate.runner.running import rows_of, total_of
from enumerate.scd.jobs import AllMechanisms, Drawn, Mechanisms, OneMechanism, SCDJob, scd_count_job
from enumerate.scd.query import PlacementQuery, SCDQuery
from graphs.count.report import mobility_report
from graphs.errors import InvariantError, UnsolvableError
from graphs.identity.drawings import map_code, map_id, mechanism_from_map_id
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph

__all__ = ["all_mechanisms", "count_scd_graphs", "mechanism_of", "scd_graphs", "scd_graphs_of", "scd_rows"]

_OPEN = 0


def scd_graphs(links: int, dof: int, max_degree: int, *, workers: int = 1, **options: Any) -> Iterator[SCDGraph]:
    """Yield all SCD graphs of N links and M degrees of freedom, in a fixed order.

    Parameters
    ----------
    links, dof : int
        With M = N - 1 open chains, else as for `enumerate.sc.graphs.sc_graphs`.
    max_degree : int
        The most sides of a link.
    workers : int
        Processes.
    **options
        Other fields of `PlacementQuery` and `SCDQuery`: ``sheets``, ``symmetric``, ``vertices``, ``spatial``,
        ``infinite``.

    Yields
    ------
    SCDGraph
        Graph attributes hold the row of `scd_rows`.

    Raises
    ------
    InvariantError
        If a number is out of its range.

    Examples
    --------
    >>> [scd.counts.vertices for scd in scd_graphs(4, 1, 4)]
    [8, 5, 6, 7, 7, 8, 9]
    """
    yield from _graphs(all_mechanisms(links, dof, max_degree, **options), workers)


def scd_graphs_of(mechanism: SCGraph, max_degree: int, *, workers: int = 1, **options: Any) -> Iterator[SCDGraph]:
    """Yield all SCD graphs of an SC graph; see `mechanism_of`.

    Parameters
    ----------
    mechanism, max_degree, **options
        As for `mechanism_of`.
    workers : int
        Processes.

    Yields
    ------
    SCDGraph
        Graph attributes hold the row of `scd_rows`.

    Raises
    ------
    UnsolvableError, InvariantError
        As of `mechanism_of`.

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> len(list(scd_graphs_of(four_bar, 4)))
    7
    """
    yield from _graphs(mechanism_of(mechanism, max_degree, **options), workers)


def _graphs(mechanisms: Mechanisms, workers: int) -> Iterator[SCDGraph]:
    for row in rows_of(SCDJob(mechanisms), workers=workers):
        scd = mechanism_from_map_id(row["code"])
        assert isinstance(scd, SCDGraph)
        scd.graph.update(row)
        yield scd


def scd_rows(
    links: int, dof: int, max_degree: int, *, workers: int = 1, **options: Any
) -> Iterator[dict[str, Any]]:
    """Yield a dictionary for each SCD graph.

    Keys: ``code`` (its id), ``sc`` (id of its SC graph), ``chain`` (id of the link-joint graph), ``links``,
    ``joints``, ``dof``, ``loops``, ``spatial``, ``centres``, ``infinite`` (as for
    `enumerate.sc.graphs.sc_rows`), ``sides`` (numbers of links with 3, 4, ... sides), ``open_edges``,
    ``vertices`` (of the polyhedron model), ``explicit``, ``implicit`` (centres of loops), ``symmetry``,
    ``exact_dof`` (joints minus rank, vertices placed too).

    Parameters
    ----------
    links, dof, max_degree, workers, **options
        As for `scd_graphs`.

    Yields
    ------
    dict of str to object

    Examples
    --------
    >>> [(row["sides"], row["open_edges"], row["symmetry"]) for row in scd_rows(4, 1, 3)]
    [([4], 4, 8)]
    """
    yield from rows_of(SCDJob(all_mechanisms(links, dof, max_degree, **options)), workers=workers)


def count_scd_graphs(
    links: int, dof: int, max_degree: int, method: str | None = None, *, workers: int = 1, **options: Any
) -> int:
    """Return the number of SCD graphs of N links and M degrees of freedom.

    Parameters
    ----------
    links, dof, max_degree, **options
        As for `scd_graphs`.
    method : {"burnside", "orbits"}, optional
        Two ways: ``orbits`` makes every placement and compares it with its images, ``burnside`` makes none.
    workers : int
        Processes.

    Raises
    ------
    InvariantError
        If a number is out of its range.
    UnsolvableError
        If the method does not count what is asked for, or a number is past counting.

    Examples
    --------
    >>> [count_scd_graphs(links, 1, 3) for links in (4, 6, 8)]
    [1, 1, 2]
    """
    return total_of(scd_count_job(all_mechanisms(links, dof, max_degree, **options), method), workers=workers)


def all_mechanisms(
    links: int, dof: int, max_degree: int, *, spatial: int = 0, infinite: bool = False, **options: Any
) -> AllMechanisms:
    """Return the mechanisms of a size as a source of `SCDJob`.

    Parameters
    ----------
    links, dof, max_degree, spatial, infinite, **options
        As for `scd_graphs`.

    Returns
    -------
    AllMechanisms

    Raises
    ------
    InvariantError
        If a number is out of its range.

    Examples
    --------
    Of the seven with four links and one freedom all but one are sheets:

    >>> [len(list(rows_of(SCDJob(all_mechanisms(4, 1, 4, sheets=only))))) for only in (False, True)]
    [7, 6]
    """
    query = SCDQuery(links, dof, PlacementQuery(max_degree, **options), spatial, infinite)
    return AllMechanisms(query)


def mechanism_of(mechanism: SCGraph, max_degree: int, **options: Any) -> OneMechanism:
    """Return a mechanism as a source of `SCDJob`; options are fields of `PlacementQuery`.

    Its loops are the bounded faces of a drawing. Of an SCD graph, the open edges are placed anew. Names and the
    ground link do not count. Raises `UnsolvableError` if the loops are not faces
    (`graphs.identity.drawings.map_id`), or the mobility cannot be counted, `InvariantError` if there are too many
    joints.
    """
    query = PlacementQuery(max_degree, **options)
    if len(mechanism.joints) + len(mechanism.loops) > MOST_JOINTS:
        raise InvariantError(
            "joints", f"{len(mechanism.joints)} joints and {len(mechanism.loops)} loops", f"{MOST_JOINTS} in all"
        )
    symbols, letters = map_code(mechanism)
    code = np.array([symbol for symbol in symbols if symbol != _OPEN], np.uint8)
    faces = len(mechanism.joints) - len(mechanism) + 1
    labels = [OUTER, *(LABEL_LETTERS.index(letter) for letter in letters or faces * LABEL_LETTERS[FINITE])]
    dof = mobility_report(mechanism).mobility
    if dof is None:
        raise UnsolvableError("the mobility of the mechanism cannot be counted")
    return OneMechanism(map_id(mechanism), dof, Drawn(code[None], np.array([labels], np.uint8)), query)
