"""SC graphs: every planar chain, drawn on the sphere in every way, with every outer face.

A drawn chain is a contracted map (`enumerate.contracted.maps`) with binary links on its joints
(`enumerate.contracted.binary_links`); the bounded faces are its loops, with centres as general as the joints
allow. Work grows with the number of SC graphs. Numbers are found in two ways. Theory:
docs/theory/sc-enumeration.md.

Source: Wiener 2016, sections 3.3 and 6.4, which names an exhaustive type synthesis as the use of SC graphs.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from enumerate.runner.running import rows_of, total_of
from enumerate.sc.forms import FormJob
from enumerate.sc.jobs import SCJob, sc_count_job
from enumerate.sc.query import SCQuery
from graphs.identity.drawings import mechanism_from_map_id
from graphs.mechanism.sc import SCGraph

__all__ = ["chain_forms", "count_sc_graphs", "sc_graphs", "sc_rows"]


def sc_graphs(links: int, dof: int, *, workers: int = 1, **options: Any) -> Iterator[SCGraph]:
    """Yield all SC graphs of N links and M degrees of freedom, in a fixed order.

    Parameters
    ----------
    links, dof : int
        N >= 4 and M >= 1. N - 1 and M + 3 S must be both even or both odd, else there is none.
    workers : int
        Processes.
    **options
        Other fields of `SCQuery`: ``spatial``, ``infinite``, ``centres``, ``symmetry``, ``assortment``,
        ``longest_string``.

    Yields
    ------
    SCGraph
        The loops are the bounded faces. Graph attributes hold the row of `sc_rows`.

    Raises
    ------
    InvariantError
        If a number is out of its range.

    Examples
    --------
    >>> [len(sc.centre_classes()) for sc in sc_graphs(6, 1)]
    [2, 1, 1, 1]
    """
    for row in sc_rows(links, dof, workers=workers, **options):
        mechanism = mechanism_from_map_id(row["code"])
        mechanism.graph.update(row)
        yield mechanism


def sc_rows(links: int, dof: int, *, workers: int = 1, **options: Any) -> Iterator[dict[str, Any]]:
    """Yield a dictionary for each SC graph.

    Keys: ``code`` (its id), ``chain`` (id of the link-joint graph), ``links``, ``joints``, ``dof``, ``loops``,
    ``spatial`` (loops without a centre), ``centres`` (classes), ``infinite`` (how many of them lie at infinity),
    ``assortment`` (numbers of binary, ternary, ... links), ``loop_sizes``, ``outer_size`` (joints round the
    faces), ``symmetry`` (their number), ``reduced`` (id of the chain without ride-alongs), ``exact_dof`` (joints
    minus rank).

    Parameters
    ----------
    links, dof, workers, **options
        As for `sc_graphs`.

    Examples
    --------
    >>> sorted((row["loop_sizes"], row["outer_size"]) for row in sc_rows(6, 1))
    [([4, 4], 6), ([4, 5], 5), ([4, 6], 4), ([5, 5], 4)]
    """
    yield from rows_of(SCJob(SCQuery(links, dof, **options)), workers=workers)


def chain_forms(links: int, dof: int, *, workers: int = 1, **options: Any) -> Iterator[dict[str, Any]]:
    """Yield a dictionary for each planar chain: its number of SC graphs, and one with the most centres.

    Parameters
    ----------
    links, dof, workers, **options
        As for `sc_graphs`.

    Examples
    --------
    >>> [(row["name"], row["centres"]) for row in chain_forms(6, 1)]
    [('watt', 2), ('stephenson', 1)]
    """
    yield from rows_of(FormJob(SCQuery(links, dof, **options)), workers=workers)


def count_sc_graphs(
    links: int, dof: int, method: str = "orbits", *, outside: bool = True, workers: int = 1, **options: Any
) -> int:
    """Return the number of SC graphs of N links and M degrees of freedom.

    Parameters
    ----------
    links, dof, **options
        As for `sc_graphs`.
    method : {"orbits", "burnside"}
        Two ways that share the contracted maps and the conditions of rigidity only.
    outside : bool
        Whether an outer face is chosen; without it, embeddings of the chains in the sphere are counted.
    workers : int
        Processes.

    Raises
    ------
    InvariantError
        If a number is out of its range.
    UnsolvableError
        If the method does not count what is asked for.

    Examples
    --------
    >>> [count_sc_graphs(links, 1) for links in (4, 6, 8, 10)]
    [1, 4, 54, 1564]
    >>> [count_sc_graphs(links, 1, "burnside", outside=False) for links in (4, 6, 8)]
    [1, 2, 20]
    """
    return total_of(sc_count_job(SCQuery(links, dof, **options), method, outside=outside), workers=workers)
