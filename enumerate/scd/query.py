"""Which SCD graphs are to be enumerated."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, TypedDict

import numpy as np

from enumerate.contracted.maps import plane_trees
from enumerate.machine_code.weights import growing, placing
from enumerate.runner.job import ANY_NUMBER, LimitField, LimitsLike, Query, Unit, batches
from enumerate.sc.jobs import Maps, drawn_of, map_units
from enumerate.sc.listing import codes_of_all
from enumerate.sc.query import SCQuery
from graphs.errors import InvariantError, numbered
from graphs.types import Bytes, Ints

# Sides of a link: codes are as wide as it allows, and enumerations end far below it.
_MOST_DEGREE = 60


class PlacementOptions(TypedDict, total=False):
    """What a `PlacementQuery` says besides the largest number of sides."""

    sheets: bool
    symmetric: bool
    vertices: LimitsLike


class SCDOptions(PlacementOptions, total=False):
    """What an `SCDQuery` says besides numbers of links, freedoms and sides."""

    spatial: int
    infinite: bool


@dataclass(frozen=True)
class PlacementQuery(Query):
    """Which placements of open edges are to be enumerated, on any mechanism.

    Attributes
    ----------
    max_degree : int
        The most sides of a link, joints and open edges together; 3 at least.
    sheets : bool
        Only all-explicit ones: every bounded face is a vertex of the links round it, so that the mechanism is one
        sheet without holes.
    symmetric : bool
        Only those with a symmetry other than the identity.
    vertices : Limits, (int, int or None) or int
        Limits of the number of vertices of the polyhedron model.

    Raises
    ------
    InvariantError
        If a number is out of its range.

    Examples
    --------
    >>> PlacementQuery(4, vertices=(8, None)).vertices
    Limits(least=8, most=None)
    """

    max_degree: int
    sheets: bool = False
    symmetric: bool = False
    vertices: LimitField = LimitField(ANY_NUMBER)  # noqa: RUF009 - a descriptor

    def __post_init__(self) -> None:
        if not 3 <= self.max_degree <= _MOST_DEGREE:
            raise InvariantError("max degree", numbered(self.max_degree, "side"), f"3 to {_MOST_DEGREE}")

    @property
    def counted(self) -> bool:
        """Whether Burnside's lemma can count them."""
        return not self.symmetric and self.vertices == ANY_NUMBER


@dataclass(frozen=True, slots=True)
class CodedMechanisms:
    """Mechanisms as codes without labels and open edges, uint8[r, D + N].

    Labels of the faces, uint8[r, F], are in the order in which the codes meet them, the outer one first.
    """

    codes: Bytes
    labels: Bytes

    def __len__(self) -> int:
        """Return the number of mechanisms."""
        return len(self.codes)

    def slice(self, start: int, end: int) -> CodedMechanisms:
        """Return some of them; what is pickled then holds no others."""
        return CodedMechanisms(self.codes[start:end], self.labels[start:end])

    def each(self) -> Iterator[tuple[Bytes, Ints]]:
        """Yield code and labels of each, as compiled functions take them."""
        yield from zip(self.codes, self.labels.astype(np.int64), strict=True)


Source = Maps | CodedMechanisms
"""Where some mechanisms come from: contracted maps, or they are there themselves."""


@dataclass(frozen=True)
class SCDQuery(Query):
    """The SCD graphs of N links and M degrees of freedom.

    Attributes
    ----------
    links, dof : int
        With M = N - 1 the mechanisms are open chains: trees of N >= 2 links.
    placements : PlacementQuery
    spatial, infinite
        As for `enumerate.sc.query.SCQuery`.

    Raises
    ------
    InvariantError
        If a number is out of its range.

    Examples
    --------
    >>> SCDQuery(4, 3, PlacementQuery(3)).tree
    True
    """

    links: int
    dof: int
    placements: PlacementQuery
    spatial: int = 0
    infinite: bool = False

    def __post_init__(self) -> None:
        if self.tree:
            if self.links < 2:
                raise InvariantError("links", numbered(self.links, "link"), "2 or more")
        else:
            self.sc  # noqa: B018 - its own checks

    @property
    def tree(self) -> bool:
        """Whether the mechanisms are open chains."""
        return self.spatial == 0 and self.dof == self.links - 1

    @property
    def sc(self) -> SCQuery:
        """The SC graphs on which open edges are placed."""
        return SCQuery(self.links, self.dof, spatial=self.spatial, infinite=self.infinite)

    @property
    def key(self) -> dict[str, Any]:
        """The query in JSON values."""
        return {
            "links": self.links,
            "dof": self.dof,
            "spatial": self.spatial,
            "infinite": self.infinite,
            **self.placements.key,
        }

    @property
    def interpreted(self) -> float:
        """About how many seconds it takes to list the mechanisms with kernels interpreted."""
        return growing(self.links) if self.tree else placing(self.sc.loops, self.dof)

    def sources(self, size: int) -> Iterator[Unit]:
        """Yield units of about so many mechanisms: contracted maps, without listing mechanisms, or trees."""
        if not self.tree:
            yield from map_units(self.sc, size)
            return
        for codes in batches(plane_trees(self.links, self.placements.max_degree), size):
            yield Unit(CodedMechanisms(codes, np.zeros((len(codes), 1), np.uint8)), len(codes))

    def drawn(self, source: Source) -> Iterator[CodedMechanisms]:
        """Yield the SC graphs of each map, or the trees."""
        if isinstance(source, CodedMechanisms):
            yield source
            return
        for part in source:
            listed = drawn_of(self.sc, part)
            codes, labels = codes_of_all(part.code, part.n, self.links, part.outer, listed.x, listed.labels)
            yield CodedMechanisms(codes, labels.astype(np.uint8))


@dataclass(frozen=True)
class OneMechanism(Query):
    """A mechanism of a file, by its id, and the placements on it."""

    name: str
    dof: int
    source: CodedMechanisms
    placements: PlacementQuery

    @property
    def key(self) -> dict[str, Any]:
        """What it is, in JSON values."""
        return {"of": self.name, **self.placements.key}

    def sources(self, _size: int) -> Iterator[Unit]:
        """Yield the mechanism."""
        yield Unit(self.source)

    def drawn(self, _source: Source) -> Iterator[CodedMechanisms]:
        """Yield the mechanism."""
        yield self.source

    @property
    def interpreted(self) -> float:
        """No seconds: the mechanism is there."""
        return 0.0


Mechanisms = SCDQuery | OneMechanism
"""The mechanisms on which open edges are placed."""
