"""Kinematic chains: all link-joint graphs of N links and M degrees of freedom without rigid sub-chains.

A chain with L >= 2 loops is a contracted graph (`enumerate.contracted.graphs`) with binary links placed on its
joints (`enumerate.contracted.binary_links`), so work grows with the number of chains and not with that of graphs;
a chain of one loop is a ring. Numbers are found in two ways (`enumerate.chains.counting`). Theory:
docs/theory/chains.md.

Source: Yan and Hwang, *The specialization of mechanisms*, Mech. Mach. Theory 26 (1991), for the words. OEIS
A233288 has the numbers for M = 1.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import networkx as nx

from enumerate.chains.jobs import ChainJob, count_job
from enumerate.chains.query import ChainQuery
from enumerate.runner.running import rows_of, total_of
from graphs.identity.chains import chain_from_id

__all__ = ["chain_rows", "chains", "count_chains"]


def chains(links: int, dof: int, *, workers: int = 1, **options: Any) -> Iterator[nx.Graph]:
    """Yield all kinematic chains of N links and M degrees of freedom, in a fixed order.

    Parameters
    ----------
    links, dof : int
        N >= 4 and M >= 1. N - 1 and M must be both even or both odd, else there is none.
    workers : int
        Processes.
    **options
        Other fields of `ChainQuery`: ``fractionated``, ``assortment``, ``planar``, ``longest_string``,
        ``symmetry``.

    Yields
    ------
    networkx.Graph
        Links are 0 to N - 1, numbered canonically. Graph attributes hold the row of `chain_rows`.

    Raises
    ------
    InvariantError
        If a number is out of its range.

    Examples
    --------
    >>> [graph.graph["assortment"] for graph in chains(6, 1)]
    [[4, 2], [4, 2]]
    >>> next(chains(6, 1)).graph["code"]
    'k1:E`hW'
    """
    for row in chain_rows(links, dof, workers=workers, **options):
        graph = chain_from_id(row["code"])
        graph.graph.update(row)
        yield graph


def chain_rows(links: int, dof: int, *, workers: int = 1, **options: Any) -> Iterator[dict[str, Any]]:
    """Yield a dictionary for each kinematic chain, or inversion, or choice of inputs.

    Keys are ``code`` (the id), ``links``, ``joints``, ``dof``, ``loops``, ``assortment`` (numbers of binary,
    ternary, ... links), ``longest_string``, ``symmetry`` (number of automorphisms), ``inversions`` (how many there
    are), ``planar``, ``fractionated``; with ``inversions`` or ``inputs``, ``ground`` (a link); with ``inputs``,
    ``inputs`` (joints, each as its two links).

    Parameters
    ----------
    links, dof, workers, **options
        As for `chains`, and ``inversions`` and ``inputs``.

    Examples
    --------
    >>> len(list(chain_rows(8, 1, inversions=True)))
    71
    """
    yield from rows_of(ChainJob(ChainQuery(links, dof, **options)), workers=workers)


def count_chains(links: int, dof: int, method: str = "orbits", *, workers: int = 1, **options: Any) -> int:
    """Return the number of kinematic chains of N links and M degrees of freedom.

    Parameters
    ----------
    links, dof, **options
        As for `chain_rows`.
    method : {"orbits", "burnside"}
        Two ways that share the contracted graphs and the conditions of rigidity only: ``orbits`` compares each
        placement with its images, ``burnside`` compares none.
    workers : int
        Processes.

    Raises
    ------
    InvariantError
        If a number is out of its range.
    UnsolvableError
        If Burnside's lemma is asked for what it does not count here.

    Examples
    --------
    >>> [count_chains(links, 1) for links in (4, 6, 8, 10)]
    [1, 2, 16, 230]
    >>> count_chains(9, 2, "burnside", fractionated=True)
    40
    """
    return total_of(count_job(ChainQuery(links, dof, **options), method), workers=workers)
