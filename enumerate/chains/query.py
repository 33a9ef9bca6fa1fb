"""Which chains are to be enumerated: numbers of links and freedoms, kinds, and limits of what they look like."""

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypedDict

import networkx as nx
import numpy as np

from enumerate.contracted.graphs import MOST_LOOPS, decode
from enumerate.runner.job import ANY_NUMBER, ONE_OR_MORE, LimitField, LimitsLike, Query
from graphs.errors import InvariantError, numbered
from graphs.types import Bytes


class ChainOptions(TypedDict, total=False):
    """What a `ChainQuery` says besides its numbers of links and freedoms."""

    fractionated: bool
    inversions: bool
    inputs: bool
    assortment: tuple[int, ...] | None
    planar: bool | None
    longest_string: LimitsLike
    symmetry: LimitsLike


@dataclass(frozen=True)
class ChainQuery(Query):
    """The kinematic chains with N links and M degrees of freedom, no sub-chain rigid.

    Attributes
    ----------
    links, dof : int
        N >= 4 and M >= 1.
    fractionated : bool
        Also chains with links or joints that cut them in two.
    inversions : bool
        One result for each link that can be the ground link, up to isomorphism.
    inputs : bool
        One result for each choice of ground link and M input joints that leave no freedom when they are locked.
    assortment : tuple of int, optional
        Numbers of binary, ternary, ... links; missing ones are 0.
    planar : bool, optional
        Whether the chain can be drawn in the plane without crossings.
    longest_string : Limits, (int, int or None) or int
        Limits of the number of binary links in the longest row of them; a ring of N links counts N.
    symmetry : Limits, (int, int or None) or int
        Limits of the number of automorphisms.

    Raises
    ------
    InvariantError
        If a number is out of its range.

    Examples
    --------
    >>> ChainQuery(8, 1).loops
    3
    """

    links: int
    dof: int
    fractionated: bool = False
    inversions: bool = False
    inputs: bool = False
    assortment: tuple[int, ...] | None = None
    planar: bool | None = None
    longest_string: LimitField = LimitField(ANY_NUMBER)  # noqa: RUF009 - a descriptor
    symmetry: LimitField = LimitField(ONE_OR_MORE)  # noqa: RUF009 - a descriptor

    def __post_init__(self) -> None:
        if self.links < 4:
            raise InvariantError("links", numbered(self.links, "link"), "4 or more: a closed chain has no fewer")
        if self.dof < 1:
            raise InvariantError("dof", numbered(self.dof, "degree of freedom", "degrees of freedom"), "1 or more")
        if self.loops > MOST_LOOPS:
            wrong = f"{self.links} links with M = {self.dof} have {numbered(self.loops, 'loop')}"
            raise InvariantError("loops", wrong, f"{MOST_LOOPS} at most")
        if self.assortment is not None and any(count < 0 for count in self.assortment):
            raise InvariantError("assortment", f"the assortment {self.assortment}", "numbers of links")

    @property
    def possible(self) -> bool:
        """Whether N - 1 and M are both even or both odd, as J = (3 (N - 1) - M) / 2 needs, and there is a loop."""
        return (self.links - 1 - self.dof) % 2 == 0 and self.loops >= 1

    @property
    def loops(self) -> int:
        """Independent loops L = (N - 1 - M) / 2."""
        return (self.links - 1 - self.dof) // 2

    @property
    def joints(self) -> int:
        """Joints J = N - 1 + L."""
        return self.links - 1 + self.loops

    @property
    def most(self) -> int:
        """The longest string that can occur: M + 1 binary links; more would hold more freedoms than there are."""
        high = self.longest_string.most
        return self.dof + 1 if high is None else min(high, self.dof + 1)

    def admits_assortment(self, degrees: dict[int, int]) -> bool:
        """Tell whether a chain with these numbers of links (degree to number) has the assortment of the query."""
        if self.assortment is None:
            return True
        return Counter(dict(enumerate(self.assortment, 2))) == Counter(degrees)

    def admits_graph(self, code: Bytes, n: int) -> bool:
        """Tell whether the query may admit chains of a contracted graph."""
        if self.assortment is not None:
            degrees = Counter(decode(code, n).sum(axis=1).tolist())
            if not self.admits_assortment({2: self.links - n, **degrees}):
                return False
        return self.planar is None or is_planar(decode(code, n)) == self.planar

    def number_within(self, number_to: Callable[[int], int]) -> int:
        """Return how many chains have a longest string within the limits, from how many have none longer."""
        least = self.longest_string.least
        return number_to(self.most) - (number_to(least - 1) if least > 0 else 0)


def is_planar(adjacency: Bytes) -> bool:
    """Return whether the multigraph of a matrix is planar.

    >>> is_planar(1 - np.eye(5, dtype=np.uint8))
    False
    """
    simple = np.triu(adjacency, 1) > 0
    if len(adjacency) < 5 or simple.sum() < 9:  # K5 has five nodes, K33 nine edges
        return True
    planar: bool = nx.check_planarity(nx.Graph(np.argwhere(simple).tolist()))[0]
    return planar
