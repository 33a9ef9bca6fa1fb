"""The jobs of SCD graph enumeration: how listing and counting are split into units."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from enumerate.runner.columns import Column
from enumerate.runner.job import Counting, Row, Unit
from enumerate.sc.jobs import UNIT_ROWS, MapPart, Maps, drawn_of, map_units
from enumerate.sc.listing import codes_of_all
from enumerate.sc.query import SCQuery
from enumerate.scd.choices import numbers_of_placements
from enumerate.scd.counting import count_placements
from enumerate.scd.plane_trees import plane_trees
from enumerate.scd.query import PlacementQuery, SCDQuery
from enumerate.scd.rows import SCD_COLUMNS, placements_on, scd_rows_of
from graphs.errors import UnsolvableError
from graphs.types import Bytes, Ints

__all__ = ["AllMechanisms", "Drawn", "Mechanisms", "OneMechanism", "SCDCountJob", "SCDJob", "scd_count_job"]

_PLACEMENTS = 40_000
"""Placements of a unit, about; symmetric ones counted apart."""

_MECHANISMS = 5_000
"""Mechanisms of a unit, about."""

_ALL = 1 << 62


@dataclass(frozen=True, slots=True)
class Drawn:
    """Mechanisms as codes without labels and open edges, uint8[r, D + N].

    Labels of the faces, uint8[r, F], are in the order in which the codes meet them, the outer one first.
    """

    codes: Bytes
    labels: Bytes

    def __len__(self) -> int:
        """Return the number of mechanisms."""
        return len(self.codes)

    def slice(self, start: int, end: int) -> Drawn:
        """Return some of them; what is pickled then holds no others."""
        return Drawn(self.codes[start:end], self.labels[start:end])

    def each(self) -> Iterator[tuple[Bytes, Ints]]:
        """Yield code and labels of each, as compiled functions take them."""
        yield from zip(self.codes, self.labels.astype(np.int64), strict=True)


Source = Maps | Drawn
"""Where some mechanisms come from: contracted maps, or they are there themselves."""


class Mechanisms(Protocol):
    """The mechanisms on which open edges are placed."""

    @property
    def dof(self) -> int:
        """Their degrees of freedom."""

    @property
    def placements(self) -> PlacementQuery:
        """What is asked of the placements."""

    @property
    def key(self) -> dict[str, Any]:
        """What they are, in JSON values."""

    def sources(self, size: int) -> Iterator[Unit]:
        """Yield units of about so many mechanisms, whose payloads are sources, without listing mechanisms."""

    def drawn(self, source: Source) -> Iterator[Drawn]:
        """Yield the mechanisms of a source."""


@dataclass(frozen=True)
class AllMechanisms:
    """The SC graphs, or plane trees, of a query."""

    query: SCDQuery

    @property
    def dof(self) -> int:
        """Degrees of freedom."""
        return self.query.dof

    @property
    def placements(self) -> PlacementQuery:
        """What is asked of the placements."""
        return self.query.placements

    @property
    def key(self) -> dict[str, Any]:
        """The query in JSON values."""
        return {"enumerate": "scd", **self.query.key}

    def sources(self, size: int) -> Iterator[Unit]:
        """Yield contracted maps, or trees."""
        if not self.query.tree:
            yield from map_units(self.query.sc, size)
            return
        codes = plane_trees(self.query.links, self.query.placements.max_degree)
        trees = Drawn(codes, np.zeros((len(codes), 1), np.uint8))
        for start in range(0, len(trees), size):
            some = trees.slice(start, start + size)
            yield Unit(some, len(some))

    def drawn(self, source: Source) -> Iterator[Drawn]:
        """Yield the SC graphs of each map, or the trees."""
        if isinstance(source, Drawn):
            yield source
        else:
            yield from (_drawn(self.query.sc, part) for part in source)


def _drawn(query: SCQuery, part: MapPart) -> Drawn:
    listed = drawn_of(query, part)
    codes, labels = codes_of_all(part.code, part.n, query.links, part.outer, listed.x, listed.labels)
    return Drawn(codes, labels.astype(np.uint8))


@dataclass(frozen=True)
class OneMechanism:
    """A mechanism of a file, by its id, and the placements on it."""

    name: str
    dof: int
    source: Drawn
    placements: PlacementQuery

    @property
    def key(self) -> dict[str, Any]:
        """What it is, in JSON values."""
        return {"enumerate": "scd", "of": self.name, **self.placements.key}

    def sources(self, size: int) -> Iterator[Unit]:
        """Yield the mechanism."""
        del size
        yield Unit(self.source)

    def drawn(self, source: Source) -> Iterator[Drawn]:
        """Yield the mechanism."""
        del source
        yield self.source


@dataclass(frozen=True, slots=True)
class _Placements:
    """Placements on some mechanisms: on one, those with some numbers, the last excluded; on several, all of them.

    Mechanisms are listed once, when units are made: the rows on each take far more room.
    """

    mechanisms: Drawn
    first: int = 0
    last: int = _ALL


@dataclass(frozen=True)
class SCDJob:
    """All placements of open edges on some mechanisms, as rows.

    Attributes
    ----------
    mechanisms : Mechanisms
    unit_rows : int
        Placements of a unit, about, symmetric ones counted apart; a mechanism with more is split.
    """

    mechanisms: Mechanisms
    unit_rows: int = _PLACEMENTS

    @property
    def columns(self) -> dict[str, Column]:
        """Names and types of the values of a row."""
        return SCD_COLUMNS

    @property
    def key(self) -> dict[str, Any]:
        """What the job is, in JSON values."""
        return self.mechanisms.key

    def units(self) -> list[Unit]:
        """Units of some thousands of placements each."""
        return list(_units(self.mechanisms, self.unit_rows))

    def work(self, payload: tuple[_Placements, ...]) -> list[Row]:
        """Return the rows of a unit."""
        query, dof = self.mechanisms.placements, self.mechanisms.dof
        return [
            row
            for part in payload
            for code, labels in part.mechanisms.each()
            for row in scd_rows_of(query, code, labels, dof, part.first, part.last)
        ]


def _units(mechanisms: Mechanisms, unit_rows: int) -> Iterator[Unit]:
    """Yield units whose payloads are placements, packed from `_ranges`."""
    held: list[_Placements] = []
    weight = number = 0
    for part, count in _ranges(mechanisms, unit_rows):
        size = len(part.mechanisms)
        if held and (weight + count > unit_rows or number + size > _MECHANISMS):
            yield Unit(tuple(held), weight)
            held, weight, number = [], 0, 0
        held.append(part)
        weight, number = weight + count, number + size
    if held:
        yield Unit(tuple(held), weight)


def _ranges(mechanisms: Mechanisms, unit_rows: int) -> Iterator[tuple[_Placements, int]]:
    """Yield ranges of no more placements than fit a unit, and their numbers."""
    most = mechanisms.placements.max_degree
    for source in mechanisms.sources(UNIT_ROWS):  # in other parts they would come in another order
        for drawn in mechanisms.drawn(source.payload):
            counts = numbers_of_placements(drawn.codes, drawn.labels.astype(np.int64), most).tolist()
            if min(counts, default=0) < 0:
                raise UnsolvableError(
                    f"one mechanism has more than 10^18 placements of open edges for links of up to {most} sides: "
                    "choose fewer"
                )
            yield from _ranges_on(drawn, counts, unit_rows)


def _ranges_on(drawn: Drawn, counts: list[int], unit_rows: int) -> Iterator[tuple[_Placements, int]]:
    """Yield ranges of the placements on mechanisms that have so many each."""
    start = weight = 0
    for row, count in zip(range(len(counts)), counts, strict=True):
        if weight and (weight + count > unit_rows or row - start >= _MECHANISMS):
            yield _Placements(drawn.slice(start, row)), weight
            start, weight = row, 0
        if count > 2 * unit_rows:
            for first in range(0, count, unit_rows):
                last = min(first + unit_rows, count)
                yield _Placements(drawn.slice(row, row + 1), first, last), last - first
            start = row + 1
        elif count == 0 and weight == 0:
            start = row + 1
        else:
            weight += count
    if weight:
        yield _Placements(drawn.slice(start, len(counts))), weight


@dataclass(frozen=True)
class SCDCountJob(Counting):
    """The number of placements of open edges on some mechanisms; rows are numbers to be added.

    Attributes
    ----------
    mechanisms : Mechanisms
    method : {"burnside", "orbits"}
        ``orbits`` makes the placements, ``burnside`` none.
    """

    mechanisms: Mechanisms
    method: str = "burnside"

    @property
    def key(self) -> dict[str, Any]:
        """What the job is, in JSON values."""
        return {"count": "scd", "method": self.method, **self.mechanisms.key}

    def units(self) -> Sequence[Unit]:
        """Units of some thousands of mechanisms, or of placements."""
        if self.method == "orbits":
            return list(_units(self.mechanisms, _PLACEMENTS))
        return list(self.mechanisms.sources(_MECHANISMS))

    def work(self, payload: Any) -> list[Row]:
        """Return the number of placements of a unit."""
        return [(self._listed(payload) if self.method == "orbits" else self._counted(payload),)]

    def _listed(self, payload: tuple[_Placements, ...]) -> int:
        query, dof = self.mechanisms.placements, self.mechanisms.dof
        return sum(
            len(placements_on(query, code, labels, dof, part.first, part.last)[0])
            for part in payload
            for code, labels in part.mechanisms.each()
        )

    def _counted(self, source: Source) -> int:
        query, dof = self.mechanisms.placements, self.mechanisms.dof
        total = 0
        for drawn in self.mechanisms.drawn(source):
            for code, labels in drawn.each():
                count = int(count_placements(code, labels, query.max_degree, dof, query.sheets))
                if count < 0:
                    raise UnsolvableError("one mechanism has more than 10^18 placements of open edges")
                total += count
        return total


def scd_count_job(mechanisms: Mechanisms, method: str | None = None) -> SCDCountJob:
    """Return the job that counts placements, by Burnside's lemma where it can.

    Parameters
    ----------
    mechanisms : AllMechanisms or OneMechanism
    method : {"burnside", "orbits"}, optional
        ``orbits`` makes the placements, ``burnside`` none.

    Returns
    -------
    SCDCountJob

    Raises
    ------
    UnsolvableError
        If Burnside's lemma is asked for what it does not count here.

    Examples
    --------
    Both ways to count:

    >>> from enumerate.runner.running import total_of
    >>> four = AllMechanisms(SCDQuery(4, 1, PlacementQuery(4)))
    >>> [total_of(scd_count_job(four, method)) for method in ("orbits", "burnside")]
    [7, 7]
    """
    counted = mechanisms.placements.counted
    if method == "burnside" and not counted:
        raise UnsolvableError("Burnside's lemma counts neither by vertices nor the symmetric ones alone")
    return SCDCountJob(mechanisms, method or ("burnside" if counted else "orbits"))
