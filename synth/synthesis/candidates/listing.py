"""Conical candidates of a chain in one call, as `synth enumerate conical` lists and counts them."""

from collections.abc import Iterable, Iterator, Sequence
from typing import Literal, TypeAlias

from enumerate.conical.query import ConicalCountJob, links_apart
from enumerate.runner._run import rows_of, total_of
from graphs.arguments import keywords_checked
from graphs.convert.conversions import Mechanism, graph_of
from graphs.convert.link_joint import sc_from_link_joint_graph
from graphs.files.mechanism_like import MechanismLike, mechanism_for
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.surfaces import Surface
from graphs.types import LinkId
from synth.synthesis.candidates.job import CandidateCountJob, CandidateJob, Filter

Grounds: TypeAlias = Sequence[LinkId | None] | Literal["all"] | None
"""Fixed links; "all" for each of those that no symmetry exchanges; None for that of the chain."""


@keywords_checked
def conical_candidates(
    mechanism: MechanismLike,
    *,
    grounds: Grounds = None,
    slots: int | None = None,
    opposites: bool = False,
    samples: int | None = None,
    seed: int = 0,
    surface: Surface | None = None,
    filters: Iterable[Filter] = (),
    workers: int = 1,
) -> Iterator[dict[str, object]]:
    """Yield the ways in which a chain can lie on one cone, each once, with what is known of it.

    Parameters
    ----------
    mechanism : Mechanism, str or Path
        Its chain is taken; without loops each face of a drawing of it gets one.
    grounds : sequence of (link id or None), or "all", optional
        Fixed links, of which each has candidates of its own; "all" for one of each set that symmetries exchange;
        None in the list for no fixed link. By default that of the chain.
    slots : int, optional
        Place the joints on so many equal slots round the cone; by default rows are cyclic orders.
    opposites : bool, optional
        Tell apart the orders of the joints and of the points opposite to them.
    samples : int, optional
        Number of random sets of angles per order.
    seed : int, optional
        Random seed for the samples.
    surface : Cone or Cylinder, optional
        For slots or samples: the surface of link angles or lengths, and of Grashof classes.
    filters : iterable of Filter, optional
        Only rows that meet all.
    workers : int, optional
        Processes.

    Yields
    ------
    dict of str to object
        Column to value: the order or the azimuths of the joints, circuits, layers, behaviour.

    Raises
    ------
    InvariantError
        If options exclude each other, or a filter or a ground names nothing.
    UnsolvableError
        If the chain has no loops, or there are too many candidates to list.

    Examples
    --------
    >>> [row["circuits"] for row in conical_candidates("k1:Cr", grounds=[0])]
    [['crossed'], ['open'], ['crossed']]
    """
    chain = chain_of(mechanism_for("conical_candidates", mechanism))
    fixed = _fixed(chain, grounds)
    job = CandidateJob(chain, fixed, slots, opposites, samples, seed, surface, tuple(filters))
    return iter(rows_of(job, workers=workers))


@keywords_checked
def count_conical_candidates(
    mechanism: MechanismLike,
    *,
    grounds: Grounds = None,
    slots: int | None = None,
    opposites: bool = False,
    filters: Iterable[Filter] = (),
    method: Literal["burnside", "orbits"] = "burnside",
    workers: int = 1,
) -> int:
    """Return the number of conical candidates of a chain, by formula unless there are filters.

    Parameters
    ----------
    mechanism, grounds, slots, opposites, filters, workers
        As in `conical_candidates`.
    method : {"burnside", "orbits"}, optional
        Without filters: Burnside's lemma, or each placement compared with its images.

    Raises
    ------
    InvariantError, UnsolvableError
        As `conical_candidates` does.

    Examples
    --------
    >>> count_conical_candidates("k1:Cr", grounds=[0], slots=12)
    275
    """
    chain = chain_of(mechanism_for("count_conical_candidates", mechanism))
    job = CandidateJob(chain, _fixed(chain, grounds), slots, opposites, filters=tuple(filters))
    counted = CandidateCountJob(job) if job.filters else ConicalCountJob(job.query, method)
    return total_of(counted, workers=workers)


def chain_of(mechanism: Mechanism) -> SCGraph:
    """Return the chain of a mechanism; without loops each face of a drawing of it gets one."""
    chain = graph_of(mechanism)
    return chain if chain.loops else sc_from_link_joint_graph(chain)


def _fixed(chain: SCGraph, grounds: Grounds) -> tuple[LinkId | None, ...]:
    if grounds is None:
        return (chain.ground,)
    return tuple(links_apart(chain.joints)) if grounds == "all" else tuple(grounds)
