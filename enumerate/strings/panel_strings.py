"""R/- strings: open chains of panels between two bodies, the joints they stand for, and their graphs.

``R`` is a crease; creases written together meet in one point (a *cluster*); ``-`` is a rectangular panel, whose
two creases are parallel. ``RR-R-RRR`` is a universal joint, a prismatic joint, a spherical joint: UPS. A chain and
its reverse are one. Source: Wiener 2016, sections 5.1 to 5.3, Tables 7 and 8, Appendix B. Theory:
docs/theory/strings.md.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from math import comb

from graphs.arguments import keywords_checked
from graphs.errors import InvariantError, numbered, shown
from graphs.mechanism.drawing import Side
from graphs.mechanism.scd import SCDGraph
from graphs.rank.realisation import PRIMES, PrimeField, join, null_vectors
from graphs.types import LinkId

MAX_PANELS = 2
"""Rectangular panels in the strings of Table 8, at most."""
MAX_CLUSTER = 3
"""Creases about one point in the strings of Table 8, at most: more of them give no more freedoms."""


@dataclass(frozen=True)
class ChainString:
    """A chain of panels, as the numbers of creases in its clusters.

    Parameters
    ----------
    clusters : tuple of int
        One or more numbers, each 1 or more.

    Raises
    ------
    InvariantError

    Examples
    --------
    >>> chain = ChainString((3, 1, 2))
    >>> chain.text, chain.canonical.text, chain.mechanism, chain.distance
    ('RRR-R-RR', 'RR-R-RRR', 'SPU', 'variable')
    """

    clusters: tuple[int, ...]

    def __post_init__(self) -> None:
        if not self.clusters or any(isinstance(k, bool) or not isinstance(k, int) or k < 1 for k in self.clusters):
            raise InvariantError("R/- string", f"clusters {shown(self.clusters)}", "numbers of 1 or more")

    @classmethod
    def parse(cls, text: str) -> ChainString:
        """Read an R/- string.

        Raises `InvariantError` with the position of what is wrong.

        Examples
        --------
        >>> ChainString.parse("R-RR").clusters
        (1, 2)
        """
        if odd := re.search("[^R-]", text):
            raise InvariantError(
                "R/- string", f"{shown(text)} has {shown(odd[0])} at position {odd.start() + 1}", "R and - only"
            )
        if not re.fullmatch("R+(-R+)*", text):
            raise InvariantError("R/- string", f"{shown(text)} has a panel without a crease", "R on both sides of -")
        return cls(tuple(map(len, text.split("-"))))

    @property
    def text(self) -> str:
        """The string, such as ``R-RR``."""
        return "-".join("R" * k for k in self.clusters)

    @property
    def reverse(self) -> ChainString:
        """The same chain from its other end."""
        return ChainString(self.clusters[::-1])

    @property
    def canonical(self) -> ChainString:
        """The chain or its reverse, whichever has the smaller clusters first."""
        return min(self, self.reverse, key=lambda chain: chain.clusters)

    @property
    def is_palindrome(self) -> bool:
        """Whether the chain reads the same from both ends."""
        return self.clusters == self.clusters[::-1]

    @property
    def creases(self) -> int:
        """Number of R, which Table 8 calls the degrees of freedom."""
        return sum(self.clusters)

    @property
    def panels(self) -> int:
        """Number of rectangular panels."""
        return len(self.clusters) - 1

    @cached_property
    def dof(self) -> int:
        """Freedoms between the two bodies: the generic rank of the twists of the creases.

        It is less than the number of creases where a cluster has more than three, where two spherical joints
        leave a rotation about the line through their centres, or where more than three creases are parallel.

        The axes are placed at random over the prime field of 2^61 - 1 elements: a crease beside a rectangular
        panel is parallel to the crease on the panel's other side. The rank is never too high; it is too low with a
        probability below 6 / 2^61.

        Examples
        --------
        >>> [ChainString.parse(text).dof for text in ("RR-R-RRR", "RRR-RRR", "RRRR", "R-R-R-R")]
        [6, 5, 3, 3]
        """
        field = PrimeField(PRIMES[0])

        def point(weight: int) -> tuple[int, int, int, int]:  # at infinity, a direction, if the weight is 0
            return field.random(), field.random(), field.random(), weight

        rows, first = [], point(0)
        for k in self.clusters:
            centre, directions = point(1), [first, *(point(0) for _ in range(k - 1))]
            first = directions[-1]
            rows += [[*u, *moment] for u, moment in (join(centre, direction, field) for direction in directions)]
        return 6 - len(null_vectors(rows, field))

    @property
    def mechanism(self) -> str:
        """The joints the chain stands for (section 5.1.2): RR is U, RRR is S, an inner R is P."""
        last = len(self.clusters) - 1
        return "".join(
            ("P" if 0 < i < last else "R") if k == 1 else {2: "U", 3: "S"}.get(k, f"({k}R)")
            for i, k in enumerate(self.clusters)
        )

    @property
    def distance(self) -> str:
        """How far apart the ends may be: ``coincident``, ``fixed`` or ``variable``."""
        return ("coincident", "fixed")[self.panels] if self.panels < 2 else "variable"

    @property
    def comment(self) -> str:
        """What Table 8 remarks, or should: axes that are parallel, freedoms that are fewer than the creases."""
        return "; ".join(filter(None, (self._parallel(), self._fewer())))

    def _fewer(self) -> str:
        if self.dof == self.creases:
            return ""
        if self.clusters == (3, 3):
            return "one freedom is a rotation about the line between the centres: 5 between the bodies"
        return f"{self.dof} freedoms between the bodies, {self.creases} creases"

    def _parallel(self) -> str:
        """Say which creases are parallel: those beside a panel are, and a single one is beside both its panels."""
        runs = [1]  # creases parallel to the last one of the first cluster
        for number, before in enumerate(self.clusters[:-1]):
            if before == 1 or not number:
                runs[-1] += 1
            else:
                runs.append(2)
        if max(runs) == self.creases > 1:
            return "all axes parallel"
        return ", ".join(f"{run} axes parallel" for run in runs if run > 2)

    def modes(self) -> list[str]:
        """Return the modes: for each gap between right-angled vertices, same side (S) or diagonal (D).

        A cluster of two or more creases is a vertex at one end of the creases beside it. Along the chain the next
        one lies on the same side or diagonally opposite. Palindromes are taken up to reversal.

        k such clusters have 2^(k - 1) modes, palindromes (2^(k - 1) + 2^ceil((k - 1) / 2)) / 2 (Table 7).

        Examples
        --------
        >>> ChainString.parse("RR-RR-RR").modes()
        ['SS', 'DS', 'DD']
        >>> ChainString.parse("R-R-R").modes()
        ['']
        """
        every = ("".join(choice) for choice in product("SD", repeat=self._gaps))
        if self.is_palindrome:
            every = (min(mode, mode[::-1]) for mode in every)
        return list(dict.fromkeys(every))

    def count_modes(self) -> int:
        """Return the number of modes by the formula.

        Examples
        --------
        >>> ChainString.parse("RR-RR-RR").count_modes()
        3
        """
        palindromic = (1 << self._gaps) + (1 << (self._gaps + 1) // 2)
        return palindromic // 2 if self.is_palindrome else 1 << self._gaps

    @property
    def _gaps(self) -> int:
        """Number of gaps between clusters of two creases or more."""
        return max(sum(k >= 2 for k in self.clusters) - 1, 0)


def joint_chain(text: str) -> ChainString:
    """Return the panel chain of a chain of joints (section 5.1.2).

    Parameters
    ----------
    text : str
        Letters R (at the ends), U, S, and P (between others), such as ``UPS``.

    Raises
    ------
    InvariantError
        With the position of a letter that cannot stand there.

    Examples
    --------
    >>> [joint_chain(text).text for text in ("S", "U", "RPR", "UPS")]
    ['RRR', 'RR', 'R-R-R', 'RR-R-RRR']
    """
    sizes = {"R": 1, "P": 1, "U": 2, "S": 3}
    for i, letter in enumerate(text):
        place = f"{shown(text)}, position {i + 1}: "
        inner = 0 < i < len(text) - 1
        if letter not in sizes:
            raise InvariantError("joint chain", f"{place}{shown(letter)}", "R, U, S or P")
        if letter == "P" and not inner:
            raise InvariantError("joint chain", f"{place}P at an end", "P between two joints: it needs two panels")
        if letter == "R" and inner:
            raise InvariantError("joint chain", f"{place}R between panels", "P: parallel creases make it prismatic")
    return ChainString(tuple(sizes[letter] for letter in text))


@keywords_checked
def strings(
    creases: int, *, max_panels: int | None = MAX_PANELS, max_cluster: int | None = MAX_CLUSTER
) -> Iterator[ChainString]:
    """Yield the strings of so many creases, canonical, each once, by panels, then by clusters, as in Table 8.

    Parameters
    ----------
    creases : int
        Number of R, 1 or more.
    max_panels, max_cluster : int or None, optional
        At most so many panels, and creases in a cluster; None for no limit. The defaults are those of Table 8.

    Raises
    ------
    InvariantError
        If a number is too small.

    Examples
    --------
    >>> [chain.text for chain in strings(4)]
    ['R-RRR', 'RR-RR', 'R-R-RR', 'R-RR-R']
    """
    longest, largest = _limits(creases, max_panels, max_cluster)
    for parts in range(1, longest + 1):
        for clusters in _compositions(creases, parts, largest):
            if clusters <= clusters[::-1]:
                yield ChainString(clusters)


@keywords_checked
def count_strings(creases: int, *, max_panels: int | None = MAX_PANELS, max_cluster: int | None = MAX_CLUSTER) -> int:
    """Return the number of strings by generating functions, without listing them.

    Compositions of n into m parts of at most c have the generating function (x + ... + x^c)^m, whose coefficients
    are sums of binomials; up to reversal there are half as many as compositions and palindromes together.

    Parameters
    ----------
    creases, max_panels, max_cluster
        As for `strings`.

    Examples
    --------
    >>> [count_strings(n) for n in range(1, 7)], count_strings(300, max_panels=None) > 10**70
    ([1, 2, 3, 4, 5, 5], True)
    """
    longest, largest = _limits(creases, max_panels, max_cluster)
    total = 0
    for parts in range(1, longest + 1):
        middles = range(1, min(largest, creases) + 1) if parts % 2 else (0,)
        halves = ((creases - k) // 2 for k in middles if (creases - k) % 2 == 0)
        total += _number_of_compositions(creases, parts, largest)
        total += sum(_number_of_compositions(half, parts // 2, largest) for half in halves)  # palindromes
    return total // 2


def _number_of_compositions(total: int, parts: int, largest: int) -> int:
    """Return how many `_compositions` there are; those with parts that are too large are taken off in turn."""
    if parts == 0:
        return int(total == 0)
    too_large = range(min((total - parts) // largest, parts) + 1)
    return sum((-1) ** k * comb(parts, k) * comb(total - k * largest - 1, parts - 1) for k in too_large)


def _limits(creases: int, max_panels: int | None, max_cluster: int | None) -> tuple[int, int]:
    """Return the most clusters and the most creases in one."""
    for name, value, least in (("creases", creases, 1), ("max_panels", max_panels, 0), ("max_cluster", max_cluster, 1)):
        if value is not None and value < least:
            raise InvariantError("R/- strings", f"{name} is {value}", f"{least} or more")
    longest = creases if max_panels is None else min(creases, max_panels + 1)
    return longest, creases if max_cluster is None else max_cluster


def _compositions(total: int, parts: int, largest: int) -> Iterator[tuple[int, ...]]:
    """Yield the compositions of a number into parts of 1 to ``largest``, in lexicographic order."""
    if parts == 1:
        if total <= largest:
            yield (total,)
        return
    least = max(1, total - largest * (parts - 1))
    for first in range(least, min(largest, total - parts + 1) + 1):
        for rest in _compositions(total - first, parts - 1, largest):
            yield (first, *rest)


def chain_scd(chain: ChainString, mode: str | None = None, ends: tuple[int, int] = (3, 3)) -> SCDGraph:
    """Return the SCD graph of a chain between two bodies.

    The link between two creases of a cluster is a triangle, the creases meeting in one of its vertices; a
    panel is a quadrilateral.

    Parameters
    ----------
    chain : ChainString
    mode : str, optional
        One letter for each gap between clusters of two or more: S, the next vertex lies on the same side, or
        D, on the other. All S without it.
    ends : (int, int), optional
        Numbers of sides of the two bodies.

    Raises
    ------
    InvariantError
        If the mode has not as many letters as there are gaps, or others, or a body has fewer than three sides.

    Examples
    --------
    >>> scd = chain_scd(ChainString.parse("RR-R-RRR"))
    >>> scd.counts.vertices, scd.counts.edges
    (11, 21)
    """
    letters = "S" * chain._gaps if mode is None else mode
    if len(letters) != chain._gaps or set(letters) - {"S", "D"}:
        expected = f"{numbered(chain._gaps, 'letter')} S or D"
        raise InvariantError("mode", f"the mode {shown(letters)} of {chain.text}", expected)
    turns = iter(letters)
    rotation: dict[LinkId, list[Side]] = {0: [0, *[None] * (ends[0] - 1)]}
    above, seen, crease = False, False, 0
    for k in chain.clusters:
        if crease:  # the rectangular panel before this cluster
            rotation[crease] = [crease, None, crease - 1, None]
        if k >= 2 and seen:
            above ^= next(turns) == "D"
        seen |= k >= 2
        for _ in range(k - 1):
            crease += 1
            rotation[crease] = [crease, crease - 1, None] if above else [crease, None, crease - 1]
        crease += 1
    rotation[crease] = [crease - 1, *[None] * (ends[1] - 1)]
    return SCDGraph(crease + 1, [(i, i + 1) for i in range(crease)], rotation=rotation)
