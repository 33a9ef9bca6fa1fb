"""How contracted graphs and contracted maps come from each other: level by level, cubic ones first."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

from graphs.errors import InvariantError
from graphs.types import Bytes

__all__ = ["Growth"]


class Growth(NamedTuple):
    """A kind of cubic graphs or maps that extend to larger ones, and whose joints can be contracted.

    `smallest` returns the codes of those with two links and two loops; `extend` and `contract` take codes and
    their number of links, and return the codes of those with two links more, and one loop more, or with a link
    less.
    """

    most_loops: int
    smallest: Callable[[], Bytes]
    extend: Callable[[Bytes, int], Bytes]
    contract: Callable[[Bytes, int], Bytes]

    def cubic(self, loops: int) -> Bytes:
        """Return the codes of all cubic ones with so many loops.

        Raises `InvariantError` if these are too few or too many.
        """
        if not 2 <= loops <= self.most_loops:
            raise InvariantError("loops", f"{loops} loops", f"2 to {self.most_loops}")
        codes = self.smallest()
        for links in range(2, 2 * (loops - 1), 2):
            codes = self.extend(codes, links)
        return codes

    def levels(self, loops: int) -> Iterator[tuple[int, Bytes]]:
        """Yield numbers of links, most first, and the codes of all with so many links and loops."""
        codes = self.cubic(loops)
        most = 2 * (loops - 1)
        yield most, codes
        for links in range(most, 2, -1):
            codes = self.contract(codes, links)
            yield links - 1, codes
