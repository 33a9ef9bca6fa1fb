"""Which SC graphs are to be enumerated."""

from dataclasses import dataclass
from typing import TypedDict

from enumerate.chains.query import ChainQuery
from enumerate.contracted.maps import MOST_MAP_LOOPS
from enumerate.kernel.centres import MOST_JOINTS
from enumerate.runner.job import ANY_NUMBER, ONE_OR_MORE, LimitField, LimitsLike, Query
from graphs.errors import InvariantError, numbered


class SCOptions(TypedDict, total=False):
    """What an `SCQuery` says besides its numbers of links and freedoms."""

    spatial: int
    infinite: bool
    centres: LimitsLike
    symmetry: LimitsLike
    assortment: tuple[int, ...] | None
    longest_string: LimitsLike


@dataclass(frozen=True)
class SCQuery(Query):
    """The SC graphs of N links and M degrees of freedom: drawn chains with an outer face and centres.

    Attributes
    ----------
    links, dof : int
        N >= 4 and M >= 1.
    spatial : int
        Number of loops without a centre; each takes three freedoms more than a loop with one.
    infinite : bool
        Also centres at infinity: every choice of classes of which no two share a joint.
    centres : Limits, (int, int or None) or int
        Limits of the number of classes of loops with one centre.
    symmetry : Limits, (int, int or None) or int
        Limits of the number of symmetries.
    assortment, longest_string
        As for `enumerate.chains.query.ChainQuery`.

    Raises
    ------
    InvariantError
        If a number is out of its range.

    Examples
    --------
    >>> SCQuery(9, 1, spatial=1).loops
    2
    """

    links: int
    dof: int
    spatial: int = 0
    infinite: bool = False
    centres: LimitField = LimitField(ANY_NUMBER)  # noqa: RUF009 - a descriptor
    symmetry: LimitField = LimitField(ONE_OR_MORE)  # noqa: RUF009 - a descriptor
    assortment: tuple[int, ...] | None = None
    longest_string: LimitField = LimitField(ANY_NUMBER)  # noqa: RUF009 - a descriptor

    def __post_init__(self) -> None:
        if self.spatial < 0:
            raise InvariantError("spatial loops", numbered(self.spatial, "spatial loop"), "0 or more")
        if self.dof < 1:
            raise InvariantError("dof", numbered(self.dof, "degree of freedom", "degrees of freedom"), "1 or more")
        if self.chains.loops > MOST_MAP_LOOPS:
            raise InvariantError(
                "loops",
                f"{self.links} links with M = {self.dof} have {numbered(self.loops, 'loop')}",
                f"{MOST_MAP_LOOPS} at most",
            )
        if self.chains.joints > MOST_JOINTS:
            raise InvariantError("joints", numbered(self.chains.joints, "joint"), f"{MOST_JOINTS} at most")

    @property
    def chains(self) -> ChainQuery:
        """The chains to be drawn: with a loop of three equations in the place of each spatial one."""
        return ChainQuery(
            self.links, self.dof + 3 * self.spatial, assortment=self.assortment, longest_string=self.longest_string
        )

    @property
    def loops(self) -> int:
        """Independent loops."""
        return self.chains.loops

    @property
    def possible(self) -> bool:
        """Whether there can be any: N - 1 - M - 3 S is even, and there are loops, S of them spatial."""
        return self.chains.possible and self.loops >= self.spatial

    @property
    def plain(self) -> bool:
        """Whether all loops have finite centres, so that there is one labelling."""
        return self.spatial == 0 and not self.infinite

    @property
    def unfiltered(self) -> bool:
        """Whether SC graphs are chosen only by what the placement of binary links shows."""
        return self.plain and self.centres == ANY_NUMBER and self.symmetry == ONE_OR_MORE
