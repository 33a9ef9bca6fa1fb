"""What an atlas is to hold: which kinds of types, up to which size.

Theory: docs/theory/atlas.md.
"""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

from enumerate.chains.jobs import ChainJob
from enumerate.chains.names import chain_named
from enumerate.chains.query import ChainQuery
from enumerate.runner.job import Job
from enumerate.sc.jobs import SCJob
from enumerate.sc.query import SCQuery
from enumerate.scd.jobs import AllMechanisms, SCDJob
from enumerate.scd.query import PlacementQuery, SCDQuery
from enumerate.strings.panel_strings import strings
from graphs.errors import InvariantError
from graphs.files.formats import mechanism_of_id
from synth.candidates.job import CandidateJob

__all__ = ["AtlasPlan"]

_FEWEST = 4
"""Links of a chain, at least: fewer are rigid, or not closed."""
_REALISED_AT_ONCE, _AT_ONCE = 8, 2000
"""Placements of a unit where each is realised, which takes long, and where none is."""


@dataclass(frozen=True)
class AtlasPlan:
    """Which types an atlas is to hold.

    Attributes
    ----------
    max_links : int
        SC and SCD graphs of 4 links to so many.
    dofs : tuple of int
        Degrees of freedom of chains, SC and SCD graphs.
    max_degree : int
        Most sides of a link of an SCD graph.
    chain_links : int, optional
        Chains of 4 links to so many; by default as of SC graphs.
    creases : int
        R/- strings of one crease to so many, with the limits of `enumerate.strings`; 0 for none.
    orders_of : tuple of str
        Chains, by name or id, whose joints are put round a cone in every order.
    spatial : int
        Also hybrids, with one spatial loop to so many.
    infinite : bool
        Also centres at infinity.
    realised : bool
        Whether SCD graphs get coordinates, and are folded.

    Raises
    ------
    InvariantError
        If a number is out of its range.

    Examples
    --------
    >>> [kind for kind, job in AtlasPlan(6).parts()]
    ['chain', 'chain', 'sc', 'sc', 'scd', 'scd', 'order', 'order']
    """

    max_links: int = 8
    dofs: tuple[int, ...] = (1,)
    max_degree: int = 4
    chain_links: int | None = None
    creases: int = 6
    orders_of: tuple[str, ...] = ("watt", "stephenson")
    spatial: int = 0
    infinite: bool = False
    realised: bool = True

    def __post_init__(self) -> None:
        for name, value, least in (
            ("max links", self.max_links, _FEWEST),
            ("links of chains", self.most_chain_links, _FEWEST),
            ("creases", self.creases, 0),
            ("spatial loops", self.spatial, 0),
        ):
            if value < least:
                raise InvariantError("atlas", f"{name} {value}", f"{least} or more")
        if not self.dofs or len(set(self.dofs)) != len(self.dofs) or min(self.dofs) < 1:
            raise InvariantError(
                "atlas", f"degrees of freedom {list(self.dofs)}", "numbers of 1 or more, each once"
            )
        for _, job in self.parts():
            _ = job.key  # queries check themselves when they are made

    @property
    def most_chain_links(self) -> int:
        """Links of the largest chains."""
        return self.max_links if self.chain_links is None else self.chain_links

    @property
    def key(self) -> dict[str, Any]:
        """The plan in JSON values."""
        values = asdict(self)
        return {**values, "dofs": list(self.dofs), "orders_of": list(self.orders_of)}

    @property
    def command(self) -> str:
        """The command that builds it.

        Examples
        --------
        >>> AtlasPlan(6, realised=False).command
        'synth atlas build --max-links 6 --dof 1 --max-degree 4 --chain-links 6 --creases 6 --orders-of watt ...'
        """
        words = ["synth atlas build", f"--max-links {self.max_links}", *(f"--dof {dof}" for dof in self.dofs)]
        words += [f"--max-degree {self.max_degree}", f"--chain-links {self.most_chain_links}"]
        words += [f"--creases {self.creases}", *(f"--orders-of {shlex.quote(name)}" for name in self.orders_of)]
        words += ["--orders-of none"] * (not self.orders_of) + [f"--spatial {self.spatial}"] * (self.spatial > 0)
        words += ["--infinite"] * self.infinite + ["--no-realise"] * (not self.realised)
        return " ".join(words)

    def parts(self) -> Iterator[tuple[str, Job]]:
        """Yield the jobs that list what the atlas holds, but for strings, and the kinds of their types."""
        for links, dof in self._sizes(self.most_chain_links):
            query = ChainQuery(links, dof, fractionated=dof > 1)
            if query.possible:
                yield "chain", ChainJob(query)
        for links, dof, spatial in self._drawn_sizes():
            yield "sc", SCJob(SCQuery(links, dof, spatial=spatial, infinite=self.infinite))
        size = _REALISED_AT_ONCE if self.realised else _AT_ONCE
        for links, dof, spatial in self._drawn_sizes():
            placements = PlacementQuery(self.max_degree)
            scd = SCDQuery(links, dof, placements, spatial=spatial, infinite=self.infinite)
            yield "scd", SCDJob(AllMechanisms(scd), size)
        for name in self.orders_of:
            chain = mechanism_of_id(name if name.startswith("k1:") else chain_named(name))
            if len(chain) <= self.max_links:
                yield "order", CandidateJob(chain)

    def strings(self) -> Iterator[Any]:
        """Yield the strings, shortest first."""
        for creases in range(1, self.creases + 1):
            yield from strings(creases)

    def _sizes(self, most: int) -> Iterator[tuple[int, int]]:
        for dof in self.dofs:
            for links in range(_FEWEST, most + 1):
                yield links, dof

    def _drawn_sizes(self) -> Iterator[tuple[int, int, int]]:
        """Yield links, degrees of freedom and spatial loops of which there are SC graphs."""
        for links, dof in self._sizes(self.max_links):
            for spatial in range(self.spatial + 1):
                if links - 1 > dof and SCQuery(links, dof, spatial=spatial).possible:
                    yield links, dof, spatial
