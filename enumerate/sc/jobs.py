"""The jobs of SC graph enumeration: how listing and counting are split into units."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from enumerate.contracted.binary_links import EVERY
from enumerate.contracted.embedded import outer_faces
from enumerate.contracted.maps import contracted_maps
from enumerate.kernel.maps import decode_map
from enumerate.runner.columns import Column
from enumerate.runner.job import Counting, Row, Unit
from enumerate.sc.listing import count_drawn, count_drawn_by_burnside, weight_of
from enumerate.sc.query import SCQuery
from enumerate.sc.rows import SC_COLUMNS, DrawnChains, sc_rows_of
from graphs.errors import UnsolvableError
from graphs.types import Bytes, Ints

__all__ = ["MapPart", "Maps", "SCCountJob", "SCJob", "drawn_of", "map_units", "maps_for", "sc_count_job"]

UNIT_ROWS = 20_000
"""SC graphs of a unit, about, where a job does not say otherwise."""

_MAPS = 256
"""Maps of a unit of counting."""

_NOWHERE = np.zeros(0, np.int64)
_RING: Bytes = np.zeros(0, np.uint8)


@dataclass(frozen=True, slots=True)
class MapPart:
    """SC graphs of one contracted map and outer face that begin in one way; an empty code is a ring."""

    code: Bytes
    n: int
    outer: int
    only: int = EVERY
    prefix: Ints = field(default_factory=lambda: _NOWHERE)


Maps = tuple[MapPart, ...]


def maps_for(query: SCQuery) -> Iterator[tuple[int, Bytes]]:
    """Yield the contracted maps whose chains can be among those asked for, most links first."""
    if not query.possible or query.loops < 2:
        return
    for n, codes in contracted_maps(query.loops):
        if n > query.links:
            continue
        if query.assortment is None:
            yield n, codes
        else:
            yield n, codes[[_admits(query, code, n) for code in codes]]


def _admits(query: SCQuery, code: Bytes, n: int) -> bool:
    degrees = Counter(np.bincount(decode_map(code)[1], minlength=n).tolist())
    degrees[2] = query.links - n
    return query.chains.admits_assortment(degrees)


def map_units(query: SCQuery, size: int = UNIT_ROWS) -> Iterator[Unit]:
    """Yield units whose payloads are `Maps`; their weights are numbers of drawn chains, about ``size`` at most."""
    if query.possible and query.loops == 1:
        degrees = Counter({2: query.links})
        if query.links in query.longest_string and query.chains.admits_assortment(degrees):
            yield Unit((MapPart(_RING, 0, 0),))
    held: list[MapPart] = []
    weight = 0
    for part, count in _parts(query, size):
        if held and weight + count > size:
            yield Unit(tuple(held), weight)
            held, weight = [], 0
        held.append(part)
        weight += count
    if held:
        yield Unit(tuple(held), weight)


def _parts(query: SCQuery, size: int) -> Iterator[tuple[MapPart, int]]:
    """Yield parts of no more than twice so many SC graphs, where it can be done, and their numbers."""
    for n, codes in maps_for(query):
        for code in codes:
            for outer in outer_faces(code).tolist():
                yield from _split(query, MapPart(code, n, outer), size)


def number_in(query: SCQuery, part: MapPart) -> int:
    """Return the number of drawn chains of a part."""
    return int(weight_of(part.code, part.n, part.outer, query.links, query.chains.most, part.only, part.prefix))


def _split(query: SCQuery, part: MapPart, size: int) -> Iterator[tuple[MapPart, int]]:
    count = number_in(query, part)
    if count <= 2 * size:
        if count:
            yield part, count
    elif part.only == EVERY:
        for only in range(query.links - part.n + 1):
            yield from _split(query, MapPart(part.code, part.n, part.outer, only), size)
    elif len(part.prefix) >= query.links - part.n:
        yield part, count
    else:
        joints = (len(part.code) - part.n) // 2
        for slot in range(part.prefix[-1] if len(part.prefix) else 0, joints):
            prefix = np.append(part.prefix, slot)
            yield from _split(query, MapPart(part.code, part.n, part.outer, part.only, prefix), size)


def drawn_of(query: SCQuery, part: MapPart) -> DrawnChains:
    """Return the SC graphs of a part."""
    return DrawnChains.of(query, part.code, part.n, part.outer, part.only, part.prefix)


@dataclass(frozen=True)
class SCJob:
    """All SC graphs that a query asks for, as rows.

    Attributes
    ----------
    query : SCQuery
    unit_rows : int
        SC graphs of a unit, about; a map with more is split.
    """

    query: SCQuery
    unit_rows: int = UNIT_ROWS

    @property
    def columns(self) -> dict[str, Column]:
        """Names and types of the values of a row."""
        return SC_COLUMNS

    @property
    def key(self) -> dict[str, Any]:
        """What the job is, in JSON values."""
        return {"enumerate": "sc", **self.query.key}

    def units(self) -> list[Unit]:
        """Units of some thousands of rows each."""
        return list(map_units(self.query, self.unit_rows))

    def work(self, payload: Maps) -> list[Row]:
        """Return the rows of a unit."""
        return [row for part in payload for row in sc_rows_of(self.query, drawn_of(self.query, part))]


@dataclass(frozen=True)
class SCCountJob(Counting):
    """The number of SC graphs of which nothing is asked but what their chains show; rows are numbers to be added.

    Attributes
    ----------
    query : SCQuery
    method : {"orbits", "burnside"}
    outside : bool
        Whether an outer face is chosen; else embeddings in the sphere are counted.
    """

    query: SCQuery
    method: str = "orbits"
    outside: bool = True

    @property
    def key(self) -> dict[str, Any]:
        """What the job is, in JSON values."""
        return {"count": "sc", "method": self.method, "outside": self.outside, **self.query.key}

    def units(self) -> Sequence[Unit]:
        """Units of some hundreds of maps each."""
        return [
            Unit((n, codes[i : i + _MAPS]), len(codes[i : i + _MAPS]))
            for n, codes in maps_for(self.query)
            for i in range(0, len(codes), _MAPS)
        ]

    def work(self, payload: tuple[int, Bytes]) -> list[Row]:
        """Return the number of SC graphs of a unit."""
        query, low = self.query, self.query.longest_string.least
        count = count_drawn_by_burnside if self.method == "burnside" else count_drawn

        def number(most: int) -> int:
            return int(count(payload[1], payload[0], query.links, most, self.outside))

        return [(number(query.chains.most) - (number(low - 1) if low > 0 else 0),)]


@dataclass(frozen=True)
class _ListedCountJob(Counting):
    """The number of SC graphs that have to be made to be counted."""

    query: SCQuery

    @property
    def key(self) -> dict[str, Any]:
        """What the job is, in JSON values."""
        return {"count": "sc", **self.query.key}

    def units(self) -> Sequence[Unit]:
        """Return those of the listing."""
        return list(map_units(self.query))

    def work(self, payload: Maps) -> list[Row]:
        """Return the number of SC graphs of a unit; nothing about them is worked out that is not asked for."""
        return [(sum(len(drawn_of(self.query, part).x) for part in payload),)]


def sc_count_job(query: SCQuery, method: str = "orbits", *, outside: bool = True) -> SCCountJob | _ListedCountJob:
    """Return the job that counts what a query asks for.

    Parameters
    ----------
    query : SCQuery
    method : {"orbits", "burnside"}, optional
    outside : bool, optional
        Whether an outer face is chosen; else embeddings in the sphere are counted.

    Returns
    -------
    Counting
        A job whose rows are numbers to be added.

    Raises
    ------
    UnsolvableError
        If it can only be counted by listing, and Burnside's lemma or embeddings without outer face are asked for.

    Examples
    --------
    Both ways to count:

    >>> from enumerate.runner.running import total_of
    >>> [total_of(sc_count_job(SCQuery(6, 1), method)) for method in ("orbits", "burnside")]
    [4, 4]
    """
    if query.unfiltered and query.loops > 1:
        return SCCountJob(query, method, outside)
    if method == "burnside" and query.loops > 1:
        raise UnsolvableError(
            "Burnside's lemma counts SC graphs with finite centres, by assortment and longest string; "
            "not by centres, symmetries, spatial loops or centres at infinity"
        )
    if not outside and query.loops > 1:
        raise UnsolvableError("embeddings without outer face have no centres yet to choose them by")
    return _ListedCountJob(query)
