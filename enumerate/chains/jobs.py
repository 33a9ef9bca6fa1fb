"""Kinematic chains: all link-joint graphs of N links and M degrees of freedom without rigid sub-chains.

A chain with L >= 2 loops is a contracted graph (`enumerate.contracted.graphs`) with binary links placed on its
joints (`enumerate.contracted.binary_links`), so work grows with the number of chains and not with that of graphs;
a chain of one loop is a ring. Numbers are found in two ways (`enumerate.chains.counting`). Listing and counting
are split into units. Theory: docs/theory/chains.md.

Source: Yan and Hwang, *The specialization of mechanisms*, Mech. Mach. Theory 26 (1991), for the words. OEIS
A233288 has the numbers for M = 1.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial
from itertools import islice
from typing import Any, Literal, Unpack

import networkx as nx
import numpy as np

from enumerate.chains import counting
from enumerate.chains.fractionated import Block, block_choices, count_connected, glued, shapes
from enumerate.chains.query import ChainOptions, ChainQuery
from enumerate.chains.rows import GraphChains, columns_of, rows_of_graph, rows_of_joints
from enumerate.contracted.binary_links import EVERY
from enumerate.contracted.graphs import contracted_graphs, cubic_graphs, descendants
from enumerate.machine_code.weights import CHAIN, placing
from enumerate.runner import job
from enumerate.runner._run import graphs_of, rows_of, total_of
from graphs.arguments import keywords_checked
from graphs.errors import UnsolvableError
from graphs.identity.chains import chain_from_id
from graphs.types import Bytes, Ints

_ROWS = 20_000
"""Rows of a unit, about; a contracted graph with more is split. A unit is what a stopped run does again, and what costs
one transaction of the store."""

_GRAPHS = 256
"""Contracted graphs of a unit of counting: enough that sending a unit to a worker costs little beside it."""

_STREAMED = 8
"""Loops from which on units make their contracted graphs themselves, to be counted on: of nine loops 7 million."""

_ANCESTORS = 4
"""Cubic graphs of such a unit, about: few, since each has hundreds of descendants or more (`_DESCENDANTS`)."""

_DESCENDANTS = 100
"""Contracted graphs that come of a cubic one, about, with eight loops; more with more."""

_CHOICES = 64
"""Choices of blocks of a unit of fractionated chains: most of them have few chains each."""


@dataclass(frozen=True, slots=True)
class _Graphs:
    """Chains of some contracted graphs, or of one of them those that begin in one way (`beginnings`)."""

    n: int
    codes: Bytes
    only: int = EVERY
    prefix: Ints = field(default_factory=lambda: np.zeros(0, np.int64))


Payload = _Graphs | tuple[tuple[Block, ...], ...] | None
"""Contracted graphs; choices of blocks, of which chains are put together; None: the chain of one loop, a ring."""


def _graphs(query: ChainQuery) -> Iterator[tuple[int, Bytes]]:
    """Yield the contracted graphs whose chains a query may admit, most links first."""
    if not query.possible or query.loops < 2:
        return
    yield from _admitted(query, contracted_graphs(query.loops))


def _admitted(query: ChainQuery, levels: Iterable[tuple[int, Bytes]]) -> Iterator[tuple[int, Bytes]]:
    """Yield those contracted graphs, by numbers of links, whose chains a query may admit."""
    for n, codes in levels:
        if n > query.links:
            continue
        if query.assortment is None and query.planar is None:
            yield n, codes
        else:
            admitted = [query.admits_graph(code, n) for code in codes]
            yield n, codes[np.array(admitted, bool)]


@dataclass(frozen=True)
class ChainJob(job.QueryJob[ChainQuery]):
    """All chains of a query, as rows.

    Attributes
    ----------
    query : ChainQuery
    bare : bool
        Ids alone, without attributes.
    """

    bare: bool = False
    listed = "chains"

    @cached_property
    def columns(self) -> dict[str, job.Column]:
        """Names and types of the values of a row."""
        return columns_of(self.query, self.bare)

    def units(self) -> list[job.Unit]:
        """Units of some thousands of rows each: chains that nothing cuts, then fractionated ones."""
        units: list[job.Unit] = []
        if not self.query.possible:
            return units
        if self.query.loops == 1:
            units.append(job.Unit(None))
        for n, codes in _graphs(self.query):
            units += self._units_of_level(n, codes)
        if self.query.fractionated:
            units += self._fractionated_units()
        return units

    def _units_of_level(self, n: int, codes: Bytes) -> Iterator[job.Unit]:
        """Split the contracted graphs of n links by the numbers of their chains."""
        query = self.query
        start = weight = 0
        for i, code in zip(range(len(codes)), codes, strict=True):
            count = counting.count_of_graph(code, n, query.links, query.most, EVERY, np.zeros(0, np.int64))
            if weight and weight + count > _ROWS:
                yield job.Unit(_Graphs(n, codes[start:i]), weight)
                start, weight = i, 0
            if count > 2 * _ROWS:  # the placements are split by where their first units lie
                number = partial(counting.count_of_graph, code, n, query.links, query.most)
                for only, prefix, part in beginnings(number, query.links - n, len(code), _ROWS):
                    yield job.Unit(_Graphs(n, code[None], only, prefix), part)
                start = i + 1
            else:
                weight += count
        if weight:
            yield job.Unit(_Graphs(n, codes[start:]), weight)

    def _fractionated_units(self) -> Iterator[job.Unit]:
        for shape in shapes(self.query.links, self.query.dof):
            choices = block_choices(shape, _blocks)
            while batch := tuple(islice(choices, _CHOICES)):
                yield job.Unit(batch, len(batch))

    def work(self, payload: Payload) -> list[job.Row]:
        """Return the rows of a unit."""
        query = self.query
        if isinstance(payload, _Graphs):
            return [row for part in self._chains(payload) for row in rows_of_graph(query, part, self.bare)]
        if payload is None:
            ring = [(i, (i + 1) % query.links) for i in range(query.links)]
            return rows_of_joints(query, ring, self.bare)
        chains = (joints for blocks in payload for joints in glued(blocks))
        return [row for joints in chains for row in rows_of_joints(query, joints, self.bare)]

    def interpreted(self, weight: int) -> float:
        """Return about how many seconds the job takes with kernels interpreted, for so many rows."""
        return placing(self.query.loops, self.query.dof) + CHAIN * weight

    def _chains(self, payload: _Graphs) -> Iterator[GraphChains]:
        for code in payload.codes:
            yield GraphChains.of(self.query, code, payload.n, payload.only, payload.prefix)

    def number(self, payload: Payload) -> int:
        """Return the number of rows of a unit; without labels where they are not needed."""
        query = self.query
        if not isinstance(payload, _Graphs) or query.inputs:
            return len(self.work(payload))
        if query.inversions:
            links = np.arange(query.links)  # a link is the least of its orbit, or not
            return sum(int((part.inversions(query.links) == links).sum()) for part in self._chains(payload))
        return sum(len(part.x) for part in self._chains(payload))


def beginnings(
    number: Callable[[int, Ints], int], units: int, slots: int, most: int
) -> Iterator[tuple[int, Ints, int]]:
    """Yield ways in which placements of binary links (`units`) on slots begin, of `most` placements each at most.

    A way is a number of bound units, or `EVERY`, and the slots of the first units, which never fall; with it comes
    the number of its placements, which `number` counts.
    """

    def split(only: int, prefix: tuple[int, ...]) -> Iterator[tuple[int, Ints, int]]:
        way = np.array(prefix, np.int64)
        count = number(only, way)
        if count <= most or len(prefix) >= units:
            if count:
                yield only, way, count
        elif only == EVERY:
            for bound in range(units + 1):
                yield from split(bound, ())
        else:
            for slot in range(prefix[-1] if prefix else 0, slots):
                yield from split(only, (*prefix, slot))

    return split(EVERY, ())


def _blocks(links: int, dof: int) -> Iterator[Block]:
    """Yield all chains that nothing cuts as blocks."""
    for row in rows_of(ChainJob(ChainQuery(links, dof), bare=True)):
        yield links, tuple(sorted(chain_from_id(row["code"]).edges()))


_COUNT_COLUMNS: dict[str, job.Column] = {"count": int, "contracted_links": int}
"""A number, and the number of links of the contracted graphs that it belongs to."""


@dataclass(frozen=True)
class CountJob(job.QueryCount[ChainQuery]):
    """The number of chains of a query; each row is a number to be added.

    Attributes
    ----------
    query : ChainQuery
    method : {"orbits", "burnside"}
    streamed : bool
        Units make their contracted graphs themselves, from cubic ones; else all are made first.
    """

    streamed: bool = False
    counted = "chains"
    columns = _COUNT_COLUMNS

    @property
    def details(self) -> dict[str, Any]:
        """How large the units are."""
        return {"cubic_graphs_of_a_unit": _ANCESTORS} if self.streamed else {"graphs_of_a_unit": _GRAPHS}

    def units(self) -> Sequence[job.Unit]:
        """Units of some hundreds of contracted graphs each, or of those that come from some cubic graphs."""
        if self.streamed:
            return self._streamed_units()
        return [
            job.Unit((n, some), len(some)) for n, codes in _graphs(self.query) for some in job.batches(codes, _GRAPHS)
        ]

    def _streamed_units(self) -> list[job.Unit]:
        """Deal the cubic graphs out: of those that are neighbours about equally many others come."""
        query = self.query
        if not query.possible or query.loops < 2:
            return []
        codes = cubic_graphs(query.loops)
        units = -(-len(codes) // _ANCESTORS)
        dealt = (codes[i::units] for i in range(units))
        return [job.Unit((2 * (query.loops - 1), each), _DESCENDANTS * len(each)) for each in dealt]

    def work(self, payload: tuple[int, Bytes]) -> list[job.Row]:
        """Return the numbers of chains of a unit, by the size of contracted graphs."""
        n, codes = payload
        levels = _admitted(self.query, descendants(codes, n)) if self.streamed else [(n, codes)]
        return [(self._number(some, links), links) for links, some in levels]

    def interpreted(self, weight: int) -> float:
        """Return about how many seconds the job takes with kernels interpreted, whatever its units weigh."""
        del weight
        return placing(self.query.loops, self.query.dof) * (self.query.links if self.query.inversions else 1)

    def _number(self, codes: Bytes, n: int) -> int:
        query = self.query
        count = counting.count_by_burnside if self.method == "burnside" else counting.count_by_orbits
        return query.number_within(lambda most: count(codes, n, query.links, most, query.inversions))


@dataclass(frozen=True)
class _ConnectedCountJob(job.QueryCount[ChainQuery]):
    """The number of chains, fractionated ones too, from cycle indices: one unit."""

    counted = "chains"

    def units(self) -> Sequence[job.Unit]:
        """One unit."""
        return [job.Unit(None)] if self.query.possible else []

    def interpreted(self, weight: int) -> float:
        """Return about how many seconds the job takes with kernels interpreted."""
        del weight
        return placing(self.query.loops, self.query.dof)

    def work(self, payload: None) -> list[job.Row]:
        """Return the number."""
        return [(count_connected(self.query.links, self.query.dof),)]


def count_job(
    query: ChainQuery, method: str, kept: Mapping[str, Any] | None = None
) -> CountJob | job.RowCount | _ConnectedCountJob:
    """Return the job that counts the chains of a query: its rows are numbers to be added.

    Parameters
    ----------
    query : ChainQuery
    method : {"orbits", "burnside"}
    kept : mapping, optional
        The key of a job to be resumed: the units are as large as it says, where there is a choice.

    Raises
    ------
    UnsolvableError
        If Burnside's lemma cannot count by all that the query limits.

    Examples
    --------
    >>> from enumerate.runner._run import total_of
    >>> [total_of(count_job(ChainQuery(8, 1), method)) for method in ("orbits", "burnside")]
    [16, 16]
    """
    by_rows = job.RowCount(ChainJob(query), {"count": "chains", **query.key})
    plain = query.symmetry == job.ONE_OR_MORE and not query.inputs
    streamed = query.loops >= _STREAMED and "graphs_of_a_unit" not in (kept or {})
    if method == "burnside":
        filtered = query.assortment is not None or query.planar is not None or query.longest_string != job.ANY_NUMBER
        if not plain or (query.fractionated and (filtered or query.inversions)):
            raise UnsolvableError(
                "Burnside's lemma cannot count by input joints or symmetries, nor a part of fractionated chains; "
                "try --method orbits"
            )
        if query.loops == 1 and not query.fractionated:
            return by_rows
        return _ConnectedCountJob(query, method) if query.fractionated else CountJob(query, method, streamed)
    if plain and not query.fractionated and query.loops > 1:
        return CountJob(query, method, streamed)
    return by_rows


class ChainGraph(nx.Graph):
    """The link-joint graph of a kinematic chain.

    Attributes
    ----------
    graph : dict of str to object
        The row of `chain_rows`.

    Examples
    --------
    >>> next(chains(6, 1)).graph["symmetry"]
    4
    """


@keywords_checked
def chains(links: int, dof: int, *, workers: int = 1, **options: Unpack[ChainOptions]) -> Iterator[ChainGraph]:
    """Yield all kinematic chains of N links and M degrees of freedom, in a fixed order.

    Parameters
    ----------
    links, dof : int
        N >= 4 and M >= 1. N - 1 and M must be both even or both odd, else there is none.
    workers : int
        Processes.
    **options
        Other fields of `ChainQuery`, with its errors: ``fractionated``, ``assortment``, ``planar``,
        ``longest_string``, ``symmetry``.

    Yields
    ------
    ChainGraph
        Links are 0 to N - 1, numbered canonically. Graph attributes hold the row of `chain_rows`.

    Examples
    --------
    >>> [graph.graph["assortment"] for graph in chains(6, 1)]
    [[4, 2], [4, 2]]
    >>> next(chains(6, 1)).graph["code"]
    'k1:E`hW'
    """
    rows = chain_rows(links, dof, workers=workers, **options)
    yield from graphs_of(rows, lambda code: ChainGraph(chain_from_id(code)))


@keywords_checked
def chain_rows(links: int, dof: int, *, workers: int = 1, **options: Unpack[ChainOptions]) -> Iterator[dict[str, Any]]:
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


@keywords_checked
def count_chains(
    links: int,
    dof: int,
    method: Literal["orbits", "burnside"] = "orbits",
    *,
    workers: int = 1,
    **options: Unpack[ChainOptions],
) -> int:
    """Return the number of kinematic chains of N links and M degrees of freedom.

    Parameters
    ----------
    links, dof, **options
        As for `chain_rows`.
    method : {"orbits", "burnside"}
        Two ways that share the contracted graphs and the conditions of rigidity only: ``orbits`` compares each
        placement with its images, ``burnside`` compares none. UnsolvableError as of `count_job`.
    workers : int
        Processes.

    Examples
    --------
    >>> [count_chains(links, 1) for links in (4, 6, 8, 10)]
    [1, 2, 16, 230]
    >>> count_chains(9, 2, "burnside", fractionated=True)
    40
    """
    return total_of(count_job(ChainQuery(links, dof, **options), method), workers=workers)
