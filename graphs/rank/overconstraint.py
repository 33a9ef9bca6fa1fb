"""Where a mechanism is overconstrained, and what in it cannot move.

Closure equations that depend on each other are idle: each smallest dependent set of them is an overconstrained
sub-mechanism, given by the joints of its loops. From the kernel come the joints that no motion turns and the
links that move as one. All of a random member, modulo a prime. Theory: docs/theory/exact-mobility.md.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from typing import Any

import networkx as nx

from graphs.ids import JointId, LinkId
from graphs.mechanism.sc import SCGraph
from graphs.rank.closure import closure_of
from graphs.rank.fields import PRIMES, PrimeField
from graphs.rank.general_member import realise
from graphs.rank.generic import centres_of_loops, matrix_modulo

__all__ = ["Diagnosis", "diagnose", "mobility_without"]


@dataclass(frozen=True, slots=True)
class Diagnosis:
    """What the closure equations of a general member say beside its mobility.

    Attributes
    ----------
    mobility : int
        Exact generic mobility.
    idle : int
        Closure equations that follow from others.
    circuits : tuple of tuple of loops
        Smallest dependent sets of equations, one for each idle equation: the loops they come from, each a tuple of
        joint ids.
    immobile : tuple of joint ids
        Joints that no motion turns.
    clusters : tuple of tuple of link ids
        Links that move as one, two or more together.

    Examples
    --------
    Three links round a centre do not move:

    >>> from graphs.loops.loop import Loop
    >>> found = diagnose(SCGraph(3, [(0, 1), (1, 2), (2, 0)], [Loop((0, 1, 2))]))
    >>> found.mobility, found.idle, found.immobile
    (0, 0, (0, 1, 2))
    """

    mobility: int
    idle: int
    circuits: tuple[tuple[tuple[JointId, ...], ...], ...]
    immobile: tuple[JointId, ...]
    clusters: tuple[tuple[LinkId, ...], ...]

    @property
    def regions(self) -> tuple[frozenset[JointId], ...]:
        """Joints of the overconstrained sub-mechanisms; circuits that share a loop are one."""
        parts: nx.utils.UnionFind[int] = nx.utils.UnionFind(range(len(self.circuits)))
        owner: dict[tuple[JointId, ...], int] = {}
        for index, circuit in enumerate(self.circuits):
            for loop in circuit:
                parts.union(owner.setdefault(loop, index), index)
        joints: dict[int, set[JointId]] = defaultdict(set)
        for index, circuit in enumerate(self.circuits):
            joints[parts[index]].update(joint for loop in circuit for joint in loop)
        return tuple(frozenset(region) for region in joints.values())


def diagnose(mechanism: SCGraph, prime: int = PRIMES[0], *, forced: bool = True, seed: int = 0) -> Diagnosis:
    """Say where a mechanism is overconstrained and what in it cannot move.

    Parameters
    ----------
    mechanism : SCGraph or SCDGraph
    prime : int, optional
    forced : bool, optional
        As for `graphs.rank.generic.exact_mobility`.
    seed : int, optional

    Raises
    ------
    UnsolvableError
        If the type could not be placed.

    Examples
    --------
    A square twist of nine panels: as many equations as joints, none idle, and nothing moves.

    >>> from graphs.files.formats import read
    >>> from graphs.convert.table import to_sc
    >>> found = diagnose(to_sc(read("data/wiener/square-twist.fold")))
    >>> found.mobility, found.idle, len(found.immobile), len(found.clusters)
    (0, 0, 12, 1)
    """
    field = PrimeField(prime, seed)
    placed = realise(mechanism, field, forced=forced)
    closure = closure_of(mechanism, placed.axes, centres_of_loops(mechanism, placed), field)
    matrix = matrix_modulo(closure, prime)
    kernel, freedoms = matrix.nullspace()
    motions = [[int(kernel[j, k]) for k in range(freedoms)] for j in range(len(closure.joints))]
    stresses: Any = None
    idle = 0
    if closure.rows:
        stresses, idle = matrix.transpose().nullspace()
    circuits = tuple(
        tuple(dict.fromkeys(closure.loops[i] for i in range(len(closure.rows)) if int(stresses[i, k])))
        for k in range(idle)
    )
    return Diagnosis(
        mobility=freedoms if closure.joints else 0,
        idle=idle,
        circuits=circuits,
        immobile=tuple(joint for joint, rates in zip(closure.joints, motions, strict=True) if not any(rates)),
        clusters=_clusters(mechanism, placed.axes, dict(zip(closure.joints, motions, strict=True)), prime),
    )


def _clusters(
    mechanism: SCGraph, axes: Any, motions: dict[JointId, list[int]], prime: int
) -> tuple[tuple[LinkId, ...], ...]:
    """Return the links that have one twist in every motion, part by part of the mechanism."""
    together: dict[Any, list[LinkId]] = defaultdict(list)
    twist: dict[LinkId, list[tuple[int, ...]]] = {}
    still: list[tuple[int, ...]] = [(0,) * 6 for _ in next(iter(motions.values()), [])]
    for part, root in enumerate(_roots(mechanism)):
        twist[root] = still
        together[part, tuple(still)].append(root)
        for a, b, joint in _tree(mechanism, root):
            u, m = axes[joint]
            sign = 1 if mechanism.joints[joint] == (a, b) else -1
            twist[b] = [
                tuple((t + sign * rate * c) % prime for t, c in zip(before, (*u, *m), strict=True))
                for before, rate in zip(twist[a], motions[joint], strict=True)
            ]
            together[part, tuple(twist[b])].append(b)
    place = {link: i for i, link in enumerate(mechanism)}
    return tuple(tuple(sorted(links, key=place.__getitem__)) for links in together.values() if len(links) > 1)


def _roots(mechanism: SCGraph) -> list[LinkId]:
    return [next(link for link in mechanism if link in part) for part in nx.connected_components(mechanism)]


def _tree(mechanism: SCGraph, root: LinkId) -> list[tuple[LinkId, LinkId, JointId]]:
    """Return the steps of a spanning tree, each from a link already met to a new one."""
    return [(a, b, next(iter(mechanism[a][b]))) for a, b in nx.bfs_edges(mechanism, root)]


def mobility_without(mechanism: SCGraph, joint: JointId, *, forced: bool = True, seed: int = 0) -> int:
    """Return the generic mobility once a joint is cut, all other axes left where they are.

    A joint is *critical* if that changes the mobility, *redundant* if not. Links that fall apart count as in
    `graphs.rank.generic.exact_mobility`: a fixed link for each part.

    Parameters
    ----------
    mechanism : SCGraph or SCDGraph
    joint : joint id
    forced, seed
        As for `graphs.rank.generic.exact_mobility`.

    Returns
    -------
    int

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> mobility_without(four_bar, 0)
    3
    """
    field = PrimeField(PRIMES[0], seed)
    placed = realise(mechanism, field, forced=forced)
    left = {other: ends for other, ends in mechanism.joints.items() if other != joint}
    cut = SCGraph(mechanism.nodes, left)
    axes = {other: placed.axes[other] for other in left}
    return len(left) - int(matrix_modulo(closure_of(cut, axes, {}, field), PRIMES[0]).rank())
