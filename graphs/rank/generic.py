"""Exact generic mobility: joints minus the rank of the loop closure of a random member, modulo two primes.

The rank is the arbiter where counts are conjectures (Wampler, Larson, Erdman 2007, on Eqs. 1 and 2). It is
computed exactly, over a field of about 2^61 numbers, at a random member of the type: never too large, and too
small with a probability of about (number of joints) / 2^58 a prime. Theory: docs/theory/exact-mobility.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from flint import nmod_mat

from graphs.errors import NumericalError
from graphs.loops.classes import class_of_loop
from graphs.mechanism.sc import SCGraph
from graphs.rank.closure import Closure, closure_of
from graphs.rank.fields import PRIMES, PrimeField
from graphs.rank.general_member import Realisation, realise

__all__ = ["ExactMobility", "closure_modulo", "exact_mobility", "matrix_modulo"]


@dataclass(frozen=True, slots=True)
class ExactMobility:
    """The generic mobility of a type, and what shows it.

    Attributes
    ----------
    mobility : int
        M = unknowns - rank.
    unknowns : int
        Joint rates J; of a polyhedron model 3V - 6 velocities.
    rank : int
    primes : tuple of int
        The primes modulo which the rank was found, each time at another random member.
    forced : bool
        Whether the vertices of an SCD graph were placed too.

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> found = exact_mobility(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))]))
    >>> found.mobility, found.unknowns, found.rank
    (1, 4, 3)
    """

    mobility: int
    unknowns: int
    rank: int
    primes: tuple[int, ...]
    forced: bool

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on, and the rank."""
        return {"mobility": self.mobility, "primes": list(self.primes), "rank": self.rank}


def exact_mobility(
    mechanism: SCGraph, primes: Sequence[int] = PRIMES, *, forced: bool = True, seed: int = 0
) -> ExactMobility:
    """Return the generic mobility of an SC or SCD graph.

    Parameters
    ----------
    mechanism : SCGraph or SCDGraph
        Each part that is not joined to the others has a fixed link of its own.
    primes : sequence of int, optional
    forced : bool, optional
        Place the vertices of an SCD graph too, not only its centres.
    seed : int, optional
        Another seed is another random member.

    Raises
    ------
    UnsolvableError
        If the type could not be placed (`graphs.rank.general_member.realise`).
    NumericalError
        If the primes give different ranks, which all but never happens; another seed settles it.

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> stephenson = SCGraph(6, [(0, 1), (1, 2), (2, 3), (3, 0), (2, 4), (4, 5), (5, 0)],
    ...                      [Loop((0, 1, 2, 3)), Loop((2, 3, 6, 5, 4))])
    >>> exact_mobility(stephenson).mobility
    1
    """
    ranks = [closure_modulo(mechanism, prime, forced=forced, seed=seed)[1].rank() for prime in primes]
    if len(set(ranks)) > 1:
        raise NumericalError(
            f"the rank is {ranks} modulo {list(primes)}: an unlucky random member; try another seed"
        )
    joints = len(mechanism.joints)
    return ExactMobility(joints - ranks[0], joints, ranks[0], tuple(primes), forced)


def closure_modulo(mechanism: SCGraph, prime: int, *, forced: bool = True, seed: int = 0) -> tuple[Closure, Any]:
    """Return the closure equations of a random member modulo a prime, and their matrix (`flint.nmod_mat`)."""
    field = PrimeField(prime, seed)
    placed = realise(mechanism, field, forced=forced)
    closure = closure_of(mechanism, placed.axes, centres_of_loops(mechanism, placed), field)
    return closure, matrix_modulo(closure, prime)


def centres_of_loops(mechanism: SCGraph, placed: Realisation) -> dict[int, Any]:
    """Return the centre of each of the independent loops that has one."""
    classes = class_of_loop(mechanism.centre_classes())
    return {loop: placed.points[index] for loop, index in classes.items() if loop < len(mechanism.loops)}


def matrix_modulo(closure: Closure, prime: int) -> Any:
    """Return the matrix of closure equations: an empty one, with the nonzeros set, which is the fast way."""
    matrix = nmod_mat(max(len(closure.rows), 1), max(len(closure.joints), 1), prime)
    for i, row in enumerate(closure.rows):
        for j, value in row.items():
            matrix[i, j] = value
    return matrix
