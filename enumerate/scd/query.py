"""Which SCD graphs are to be enumerated."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from enumerate.runner.job import ANY_NUMBER, Limits, Query
from enumerate.sc.query import SCQuery
from graphs.errors import InvariantError, numbered

__all__ = ["PlacementQuery", "SCDQuery"]

_MOST_DEGREE = 60


@dataclass(frozen=True, slots=True)
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
    vertices: Limits = ANY_NUMBER

    def __post_init__(self) -> None:
        if not 3 <= self.max_degree <= _MOST_DEGREE:
            raise InvariantError("max degree", numbered(self.max_degree, "side"), f"3 to {_MOST_DEGREE}")
        self._keep_limits("vertices")

    @property
    def counted(self) -> bool:
        """Whether Burnside's lemma can count them."""
        return not self.symmetric and self.vertices == ANY_NUMBER


@dataclass(frozen=True, slots=True)
class SCDQuery:
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
