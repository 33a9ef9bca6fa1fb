"""The jobs of chain enumeration: how listing and counting are split into units."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import islice
from typing import Any

import numpy as np

from enumerate.chains.counting import (
    count_by_burnside,
    count_by_orbits,
    count_inversions_by_orbits,
    count_of_graph,
)
from enumerate.chains.cycle_index import count_connected
from enumerate.chains.fractionated import Block, block_choices, glued, shapes
from enumerate.chains.query import ChainQuery
from enumerate.chains.rows import GraphChains, columns_of, rows_of_graph, rows_of_joints
from enumerate.contracted.binary_links import EVERY
from enumerate.contracted.descent import descendants
from enumerate.contracted.graphs import contracted_graphs, cubic_graphs
from enumerate.runner.columns import Column
from enumerate.runner.job import Counting, Row, Unit
from enumerate.runner.limits import ANY_NUMBER, ONE_OR_MORE
from enumerate.runner.running import rows_of
from graphs.errors import UnsolvableError
from graphs.identity.chains import chain_from_id
from graphs.types import Bytes, Ints

__all__ = ["ChainJob", "CountJob", "count_job"]

_ROWS = 20_000
"""Rows of a unit, about; a contracted graph with more is split."""

_GRAPHS = 256
"""Contracted graphs of a unit of counting."""

_STREAMED = 8
"""Loops from which on units make their contracted graphs themselves, to be counted on: of nine loops 7 million."""

_ANCESTORS = 4
"""Cubic graphs of such a unit, about."""

_DESCENDANTS = 100
"""Contracted graphs that come of a cubic one, about, with eight loops; more with more."""

_CHOICES = 64
"""Choices of blocks of a unit of fractionated chains."""


@dataclass(frozen=True, slots=True)
class _Graphs:
    """Chains of some contracted graphs."""

    n: int
    codes: Bytes


@dataclass(frozen=True, slots=True)
class _Descendants:
    """Chains of some cubic graphs, and of the contracted graphs that come from them."""

    n: int
    codes: Bytes


@dataclass(frozen=True, slots=True)
class _Part:
    """Chains of one contracted graph that begin in one way."""

    n: int
    code: Bytes
    only: int
    prefix: Ints


@dataclass(frozen=True, slots=True)
class _Ring:
    """The chain of one loop."""


@dataclass(frozen=True, slots=True)
class _Glued:
    """Chains put together from blocks."""

    choices: tuple[tuple[Block, ...], ...]


Payload = _Graphs | _Part | _Ring | _Glued


def _graphs(query: ChainQuery) -> Iterator[tuple[int, Bytes]]:
    """Yield the contracted graphs whose chains can be among those asked for, most links first."""
    if not query.possible or query.loops < 2:
        return
    yield from _asked_for(query, contracted_graphs(query.loops))


def _asked_for(query: ChainQuery, levels: Iterable[tuple[int, Bytes]]) -> Iterator[tuple[int, Bytes]]:
    """Yield of contracted graphs with so many links those whose chains can be among those asked for."""
    for n, codes in levels:
        if n > query.links:
            continue
        if query.assortment is None and query.planar is None:
            yield n, codes
        else:
            kept = [query.admits_graph(code, n) for code in codes]
            yield n, codes[np.array(kept, bool)]


@dataclass(frozen=True)
class ChainJob:
    """All chains that a query asks for, as rows.

    Attributes
    ----------
    query : ChainQuery
    bare : bool
        Ids alone, without attributes.
    """

    query: ChainQuery
    bare: bool = False

    @cached_property
    def columns(self) -> dict[str, Column]:
        """Names and types of the values of a row."""
        return columns_of(self.query, self.bare)

    @property
    def key(self) -> dict[str, Any]:
        """What the job is, in JSON values."""
        return {"enumerate": "chains", **self.query.key}

    def units(self) -> list[Unit]:
        """Units of some thousands of rows each: chains that nothing cuts, then fractionated ones."""
        found: list[Unit] = []
        if not self.query.possible:
            return found
        if self.query.loops == 1:
            found.append(Unit(_Ring()))
        for n, codes in _graphs(self.query):
            found += self._units_of_level(n, codes)
        if self.query.fractionated:
            found += self._fractionated_units()
        return found

    def _units_of_level(self, n: int, codes: Bytes) -> Iterator[Unit]:
        """Split the contracted graphs of n links by the numbers of their chains."""
        query = self.query
        start = weight = 0
        for i, code in zip(range(len(codes)), codes, strict=True):
            count = count_of_graph(code, n, query.links, query.most, EVERY, np.zeros(0, np.int64))
            if weight and weight + count > _ROWS:
                yield Unit(_Graphs(n, codes[start:i]), weight)
                start, weight = i, 0
            if count > 2 * _ROWS:
                yield from self._parts(n, code)
                start = i + 1
            else:
                weight += count
        if weight:
            yield Unit(_Graphs(n, codes[start:]), weight)

    def _parts(self, n: int, code: Bytes) -> Iterator[Unit]:
        """Split the placements on one contracted graph by where their first units lie."""
        query = self.query

        def split(only: int, prefix: tuple[int, ...]) -> Iterator[Unit]:
            array = np.array(prefix, np.int64)
            count = count_of_graph(code, n, query.links, query.most, only, array)
            if count > _ROWS:
                for slot in range(prefix[-1] if prefix else 0, len(code)):
                    yield from split(only, (*prefix, slot))
            elif count:
                yield Unit(_Part(n, code, only, array), count)

        for only in range(query.links - n + 1):
            yield from split(only, ())

    def _fractionated_units(self) -> Iterator[Unit]:
        for shape in shapes(self.query.links, self.query.dof):
            choices = block_choices(shape, _blocks)
            while batch := tuple(islice(choices, _CHOICES)):
                yield Unit(_Glued(batch), len(batch))

    def work(self, payload: Payload) -> list[Row]:
        """Return the rows of a unit."""
        query = self.query
        if isinstance(payload, _Part):
            part = GraphChains.of(query, payload.code, payload.n, payload.only, payload.prefix)
            return rows_of_graph(query, part, self.bare)
        if isinstance(payload, _Graphs):
            rows = []
            for code in payload.codes:
                chains = GraphChains.of(query, code, payload.n, EVERY, np.zeros(0, np.int64))
                rows += rows_of_graph(query, chains, self.bare)
            return rows
        if isinstance(payload, _Ring):
            ring = [(i, (i + 1) % query.links) for i in range(query.links)]
            return rows_of_joints(query, ring, self.bare)
        return [
            row
            for blocks in payload.choices
            for joints in glued(blocks)
            for row in rows_of_joints(query, joints, self.bare)
        ]


def _blocks(links: int, dof: int) -> Iterator[Block]:
    """Yield all chains that nothing cuts as blocks."""
    for row in rows_of(ChainJob(ChainQuery(links, dof), bare=True)):
        yield links, tuple(sorted(chain_from_id(row["code"]).edges()))


@dataclass(frozen=True)
class CountJob(Counting):
    """The number of chains that a query asks for; each row is a number to be added.

    Attributes
    ----------
    query : ChainQuery
    method : {"orbits", "burnside"}
    streamed : bool
        Units make their contracted graphs themselves, from cubic ones; else all are made first.
    """

    query: ChainQuery
    method: str = "orbits"
    streamed: bool = False

    @property
    def columns(self) -> dict[str, type]:
        """A number, and the number of links of the contracted graphs that it belongs to."""
        return {"count": int, "contracted_links": int}

    @property
    def key(self) -> dict[str, Any]:
        """What the job is, in JSON values, and how large its units are."""
        size = {"cubic_graphs_of_a_unit": _ANCESTORS} if self.streamed else {"graphs_of_a_unit": _GRAPHS}
        return {"count": "chains", "method": self.method, **size, **self.query.key}

    def units(self) -> Sequence[Unit]:
        """Units of some hundreds of contracted graphs each, or of those that come from some cubic graphs."""
        if self.streamed:
            return self._streamed_units()
        return [
            Unit(_Graphs(n, codes[i : i + _GRAPHS]), len(codes[i : i + _GRAPHS]))
            for n, codes in _graphs(self.query)
            for i in range(0, len(codes), _GRAPHS)
        ]

    def _streamed_units(self) -> list[Unit]:
        """Deal the cubic graphs out: of those that are neighbours about equally many others come."""
        query = self.query
        if not query.possible or query.loops < 2:
            return []
        codes = cubic_graphs(query.loops)
        units = -(-len(codes) // _ANCESTORS)
        dealt = (codes[i::units] for i in range(units))
        return [Unit(_Descendants(2 * (query.loops - 1), each), _DESCENDANTS * len(each)) for each in dealt]

    def work(self, payload: _Graphs | _Descendants) -> list[Row]:
        """Return the numbers of chains of a unit, by the size of contracted graphs."""
        if isinstance(payload, _Graphs):
            return [(self._number(payload.codes, payload.n), payload.n)]
        levels = _asked_for(self.query, descendants(payload.codes, payload.n))
        return [(self._number(codes, n), n) for n, codes in levels]

    def _number(self, codes: Bytes, n: int) -> int:
        low = self.query.longest_string.least
        total = self._number_to(codes, n, self.query.most)
        return total - self._number_to(codes, n, low - 1) if low > 0 else total

    def _number_to(self, codes: Bytes, n: int, most: int) -> int:
        """Return the number of chains of contracted graphs with no string longer than some."""
        if self.method == "burnside":
            return count_by_burnside(codes, n, self.query.links, most, self.query.inversions)
        count = count_inversions_by_orbits if self.query.inversions else count_by_orbits
        return count(codes, n, self.query.links, most)


@dataclass(frozen=True)
class _RowCountJob(Counting):
    """The number of rows of a job, where they have to be made to be counted."""

    rows: ChainJob

    @property
    def key(self) -> dict[str, Any]:
        """What the job is, in JSON values."""
        return {"count": "chains", **self.rows.query.key}

    def units(self) -> Sequence[Unit]:
        """Return those of the job."""
        return self.rows.units()

    def work(self, payload: Payload) -> list[Row]:
        """Return the number of rows of a unit; labels are not worked out where nothing asks for them."""
        query = self.rows.query
        if not isinstance(payload, _Graphs | _Part) or query.inputs:
            return [(len(self.rows.work(payload)),)]
        codes = payload.codes if isinstance(payload, _Graphs) else payload.code[None]
        only, prefix = (
            (EVERY, np.zeros(0, np.int64)) if isinstance(payload, _Graphs) else (payload.only, payload.prefix)
        )
        total = 0
        for code in codes:
            chains = GraphChains.of(query, code, payload.n, only, prefix)
            if query.inversions:
                total += int((chains.inversions(query.links) == np.arange(query.links)).sum())
            else:
                total += len(chains.x)
        return [(total,)]


@dataclass(frozen=True)
class _ConnectedCountJob(Counting):
    """The number of chains, fractionated ones too, from cycle indices: one unit."""

    query: ChainQuery

    @property
    def key(self) -> dict[str, Any]:
        """What the job is, in JSON values."""
        return {"count": "chains", "method": "burnside", **self.query.key}

    def units(self) -> Sequence[Unit]:
        """One unit."""
        return [Unit(None)] if self.query.possible else []

    def work(self, payload: None) -> list[Row]:
        """Return the number."""
        return [(count_connected(self.query.links, self.query.dof),)]


def count_job(
    query: ChainQuery, method: str, kept: Mapping[str, Any] | None = None
) -> CountJob | _RowCountJob | _ConnectedCountJob:
    """Return the job that counts what a query asks for.

    Parameters
    ----------
    query : ChainQuery
    method : {"orbits", "burnside"}
    kept : mapping, optional
        The key of a job that is to be gone on with: the units are as large as it says, where there is a choice.

    Returns
    -------
    Counting
        A job whose rows are numbers to be added.

    Raises
    ------
    UnsolvableError
        If Burnside's lemma is asked for what it does not count here.

    Examples
    --------
    Both ways to count:

    >>> from enumerate.runner.running import total_of
    >>> [total_of(count_job(ChainQuery(8, 1), method)) for method in ("orbits", "burnside")]
    [16, 16]
    """
    plain = query.symmetry == ONE_OR_MORE and not query.inputs
    streamed = query.loops >= _STREAMED and "graphs_of_a_unit" not in (kept or {})
    if method == "burnside":
        filtered = query.assortment is not None or query.planar is not None or query.longest_string != ANY_NUMBER
        if not plain or (query.fractionated and (filtered or query.inversions)):
            raise UnsolvableError(
                "Burnside's lemma counts chains and inversions, by assortment, planarity and longest string, "
                "or all fractionated chains; not input joints, symmetries, or parts of the fractionated ones"
            )
        if query.loops == 1 and not query.fractionated:
            return _RowCountJob(ChainJob(query))
        return _ConnectedCountJob(query) if query.fractionated else CountJob(query, method, streamed)
    if plain and not query.fractionated and query.loops > 1:
        return CountJob(query, method, streamed)
    return _RowCountJob(ChainJob(query))
