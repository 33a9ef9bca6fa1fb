"""The jobs of SCD graph enumeration: how listing and counting are split into units."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from enumerate.runner.columns import Column
from enumerate.runner.job import Counting, Row, Unit
from enumerate.sc.jobs import MapPart, drawn_of, map_units
from enumerate.sc.listing import codes_of_all
from enumerate.sc.query import SCQuery
from enumerate.scd.choices import numbers_of_placements
from enumerate.scd.counting import count_placements
from enumerate.scd.plane_trees import plane_trees
from enumerate.scd.query import PlacementQuery, SCDQuery
from enumerate.scd.rows import SCD_COLUMNS, placements_on, scd_rows_of
from graphs.arrays import Bytes, Ints
from graphs.errors import UnsolvableError

__all__ = ["Drawn", "Mechanisms", "OneMechanism", "SCDCountJob", "SCDJob", "scd_count_job"]

_PLACEMENTS = 40_000
"""Placements of a unit, about; symmetric ones counted apart."""

_MECHANISMS = 5_000
"""Mechanisms of a unit, at most."""

_ALL = 1 << 62


@dataclass(frozen=True, slots=True)
class Drawn:
    """Mechanisms as codes.

    Attributes
    ----------
    codes : uint8[r, D + N]
        Codes without labels and open edges.
    labels : int64[r, F]
        Labels of the faces as the codes meet them, the outer one first.
    """

    codes: Bytes
    labels: Ints


@dataclass(frozen=True, slots=True)
class _Range:
    """Placements on some mechanisms: on one, those with some numbers; on several, all of them.

    Attributes
    ----------
    source : MapPart or Drawn
    start, end : int
        Mechanisms with these places in the source, the end excluded.
    first, last : int
        Numbers of the placements, the last excluded.
    """

    source: MapPart | Drawn
    start: int
    end: int
    first: int = 0
    last: int = _ALL


class Mechanisms(Protocol):
    """Where the mechanisms come from on which open edges are placed."""

    @property
    def dof(self) -> int:
        """Their degrees of freedom."""

    @property
    def placements(self) -> PlacementQuery:
        """What is asked of the placements."""

    @property
    def key(self) -> dict[str, Any]:
        """What they are, in JSON values."""

    def sources(self) -> Iterator[MapPart | Drawn]:
        """Yield all mechanisms, in portions."""

    def drawn(self, source: MapPart | Drawn) -> Drawn:
        """Return the mechanisms of a portion."""


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

    def sources(self) -> Iterator[MapPart | Drawn]:
        """Yield the contracted maps, or the trees."""
        if self.query.tree:
            codes = plane_trees(self.query.links, self.query.placements.max_degree)
            yield Drawn(codes, np.zeros((len(codes), 1), np.int64))
        else:
            for unit in map_units(self.query.sc):
                yield from unit.payload

    def drawn(self, source: MapPart | Drawn) -> Drawn:
        """Return the SC graphs of a map, or the trees."""
        return source if isinstance(source, Drawn) else _drawn(self.query.sc, source)


def _drawn(query: SCQuery, part: MapPart) -> Drawn:
    found = drawn_of(query, part)
    return Drawn(*codes_of_all(part.code, part.n, query.links, part.outer, found.x, found.labels))


@dataclass(frozen=True)
class OneMechanism:
    """A mechanism of a file.

    Attributes
    ----------
    name : str
        Its id.
    dof : int
    source : Drawn
    placements : PlacementQuery
    """

    name: str
    dof: int
    source: Drawn
    placements: PlacementQuery

    @property
    def key(self) -> dict[str, Any]:
        """What it is, in JSON values."""
        return {"enumerate": "scd", "of": self.name, **self.placements.key}

    def sources(self) -> Iterator[MapPart | Drawn]:
        """Yield the mechanism."""
        yield self.source

    def drawn(self, source: MapPart | Drawn) -> Drawn:
        """Return the mechanism."""
        del source
        return self.source


@dataclass(frozen=True)
class SCDJob:
    """All placements of open edges on some mechanisms, as rows.

    Attributes
    ----------
    mechanisms : Mechanisms
    """

    mechanisms: Mechanisms

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
        return list(_units(self.mechanisms))

    def work(self, payload: tuple[_Range, ...]) -> list[Row]:
        """Return the rows of a unit."""
        mechanisms = self.mechanisms
        return [
            row
            for part, code, labels in _each(mechanisms, payload)
            for row in scd_rows_of(mechanisms.placements, code, labels, mechanisms.dof, part.first, part.last)
        ]


def _each(mechanisms: Mechanisms, payload: tuple[_Range, ...]) -> Iterator[tuple[_Range, Bytes, Ints]]:
    """Yield the mechanisms of a unit."""
    for part in payload:
        drawn = mechanisms.drawn(part.source)
        for row in range(part.start, part.end):
            yield part, drawn.codes[row], drawn.labels[row]


def _units(mechanisms: Mechanisms) -> Iterator[Unit]:
    """Yield units whose payloads are ranges."""
    held: list[_Range] = []
    weight = number = 0
    for part, count in _ranges(mechanisms):
        size = part.end - part.start
        if held and (weight + count > _PLACEMENTS or number + size > _MECHANISMS):
            yield Unit(tuple(held), weight)
            held, weight, number = [], 0, 0
        held.append(part)
        weight, number = weight + count, number + size
    if held:
        yield Unit(tuple(held), weight)


def _ranges(mechanisms: Mechanisms) -> Iterator[tuple[_Range, int]]:
    """Yield ranges of no more placements than fit a unit, and their numbers."""
    most = mechanisms.placements.max_degree
    for source in mechanisms.sources():
        drawn = mechanisms.drawn(source)
        counts = numbers_of_placements(drawn.codes, drawn.labels, most).tolist()
        start = weight = 0
        for row, count in enumerate(counts):
            if count < 0:
                raise UnsolvableError(
                    f"one mechanism has more than 10^18 placements of open edges for links of up to {most} sides: "
                    "choose fewer"
                )
            if weight and (weight + count > _PLACEMENTS or row - start >= _MECHANISMS):
                yield _Range(source, start, row), weight
                start, weight = row, 0
            if count > 2 * _PLACEMENTS:
                for first in range(0, count, _PLACEMENTS):
                    last = min(first + _PLACEMENTS, count)
                    yield _Range(source, row, row + 1, first, last), last - first
                start = row + 1
            elif count == 0 and weight == 0:
                start = row + 1
            else:
                weight += count
        if weight:
            yield _Range(source, start, len(counts)), weight


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
            return list(_units(self.mechanisms))
        found = []
        for source in self.mechanisms.sources():
            size = len(self.mechanisms.drawn(source).codes)
            found += [
                Unit((_Range(source, i, min(i + _MECHANISMS, size)),), min(_MECHANISMS, size - i))
                for i in range(0, size, _MECHANISMS)
            ]
        return found

    def work(self, payload: tuple[_Range, ...]) -> list[Row]:
        """Return the number of placements of a unit."""
        query, dof = self.mechanisms.placements, self.mechanisms.dof
        total = 0
        for part, code, labels in _each(self.mechanisms, payload):
            if self.method == "orbits":
                total += len(placements_on(query, code, labels, dof, part.first, part.last)[0])
                continue
            count = int(count_placements(code, labels, query.max_degree, dof, query.sheets))
            if count < 0:
                raise UnsolvableError("one mechanism has more than 10^18 placements of open edges")
            total += count
        return [(total,)]


def scd_count_job(mechanisms: Mechanisms, method: str | None = None) -> SCDCountJob:
    """Return the job that counts placements, by Burnside's lemma where it can.

    Raises
    ------
    UnsolvableError
        If Burnside's lemma is asked for what it does not count here.
    """
    counted = mechanisms.placements.counted
    if method == "burnside" and not counted:
        raise UnsolvableError("Burnside's lemma counts neither by vertices nor the symmetric ones alone")
    return SCDCountJob(mechanisms, method or ("burnside" if counted else "orbits"))
