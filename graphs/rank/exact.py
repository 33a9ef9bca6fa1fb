"""Exact generic mobility: loop closure of a random realisation, its rank modulo two primes, and overconstraint.

Round every independent loop the twists of the joints add up to zero: three equations if all axes pass through one
point, else six. M = J - rank, computed exactly over a field of about 2^61 numbers: never too large, and too small
with a probability of about (number of joints) / 2^58 per prime. It is the arbiter where counts are conjectures
(Wampler, Larson, Erdman 2007, on Eqs. 1 and 2). Each smallest dependent set of equations is an overconstrained
sub-mechanism; the kernel shows immobile joints and links that move as one. Theory: docs/theory/exact-mobility.md.
"""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise
from typing import Any

import networkx as nx
import numpy as np

from graphs.errors import NumericalError
from graphs.loops.loop import Centre, Loop, added_independent, signed_cycle
from graphs.mechanism.sc import SCGraph
from graphs.rank.dissection import KernelsModulo, matrices, rank_modulo, sparse_modulo
from graphs.rank.realisation import PRIMES, Field, GenericRealisation, Line, Point, PrimeField, realise
from graphs.types import Floats, Ints, JointId, LinkId

# Parts (direction, moment) and components of screws. The moments of axes through one point are linear in their
# directions, so that three equations say all six; in space all are independent.
_FINITE = [(0, 0), (0, 1), (0, 2)]
_SPATIAL = [*_FINITE, (1, 0), (1, 1), (1, 2)]


@dataclass(frozen=True, slots=True)
class Closure:
    """The closure equations: a column per joint, rows that map columns to coefficients, the loop of each row."""

    joints: tuple[JointId, ...]
    rows: tuple[dict[int, Any], ...]
    loops: tuple[tuple[JointId, ...], ...]


def independent_cycles(sc: SCGraph) -> tuple[Loop, ...]:
    """Return the loops of a mechanism, then cycles that complete them to a basis; these have no centre."""
    missing = sc.independent_loops - len(sc.loops)
    if not missing:
        return sc.loops
    forest = nx.Graph()
    forest.add_nodes_from(sc.nodes)
    tree: dict[frozenset[Any], JointId] = {}
    left = []
    parts = nx.utils.UnionFind(sc.nodes)
    for joint, (a, b) in sc.joints.items():
        if parts[a] == parts[b]:
            left.append(joint)
        else:
            parts.union(a, b)
            forest.add_edge(a, b)
            tree[frozenset((a, b))] = joint
    candidates = []
    for joint in left:
        a, b = sc.joints[joint]
        path = nx.bidirectional_shortest_path(forest, b, a)
        steps = pairwise(path)
        candidates.append((joint, *(tree[frozenset(step)] for step in steps)))
    chosen = added_independent([loop.joints for loop in sc.loops], candidates)
    return (*sc.loops, *(Loop(candidates[i], Centre.NONE) for i in chosen))


@dataclass(frozen=True, slots=True)
class SignedLoops:
    """Loops as arrays: the columns of the joints of loop l, in its order, are at begin[l] to begin[l + 1] of `joints`.

    A sign is 1 where the loop passes from a joint's first link to its second, else -1.
    """

    begin: Ints
    joints: Ints
    signs: Floats

    def by_length(self) -> list[tuple[Ints, Ints, Floats]]:
        """Return the loops of each length k: their numbers int[n], their joints and signs [n, k]."""
        lengths = np.diff(self.begin)
        groups = []
        for length in np.unique(lengths).tolist():
            loops = np.flatnonzero(lengths == length)
            places = self.begin[loops, None] + np.arange(length)
            groups.append((loops, self.joints[places], self.signs[places]))
        return groups


def signed_loops(sc: SCGraph, loops: Sequence[Loop]) -> SignedLoops:
    """Return loops of a mechanism, in cyclic order, as `graphs.loops.loop.signed_cycle` passes them."""
    column = {joint: place for place, joint in enumerate(sc.joints)}
    number = {link: place for place, link in enumerate(sc.nodes)}
    ends = np.array([(number[a], number[b]) for a, b in sc.joints.values()], dtype=np.int64).reshape(-1, 2)
    begin = np.cumsum([0, *(len(loop.joints) for loop in loops)], dtype=np.int64)
    joints: Ints = np.array([column[joint] for loop in loops for joint in loop.joints], dtype=np.int64)
    following = np.roll(joints, -1)
    following[begin[1:] - 1] = joints[begin[:-1]]
    ahead = (ends[joints, 1, None] == ends[following]).any(axis=1)
    back = begin[:-1][np.diff(begin) == 2] + 1  # two joints share both links: the second goes on from the first
    ahead[back] = ends[joints[back], 0] == ends[joints[back - 1], 1]
    return SignedLoops(begin, joints, np.where(ahead, 1.0, -1.0))


def closure_of(sc: SCGraph, axes: Mapping[JointId, Line], centres: Mapping[int, Point], field: Field) -> Closure:
    """Return the closure equations of a placed mechanism: 3 rows for a loop with a centre, 6 for one without.

    Axes map joints to (u, m), centres the index of each loop that has one to (x, y, z, w).
    """
    joints = sc.joints
    column = {joint: i for i, joint in enumerate(joints)}
    rows: list[dict[int, Any]] = []
    loops: list[tuple[JointId, ...]] = []
    for index, loop in enumerate(independent_cycles(sc)):
        signed = [(column[joint], sign, axes[joint]) for joint, sign in signed_cycle(loop.joints, joints)]
        for part, k in _equations(centres.get(index), field):
            row = {}
            for j, sign, axis in signed:
                value = axis[part][k]
                if value:
                    row[j] = value if sign == 1 else field.reduce(-value)
            rows.append(row)
            loops.append(loop.joints)
    return Closure(tuple(sc.joints), tuple(rows), tuple(loops))


def _equations(centre: Point | None, field: Field) -> list[tuple[int, int]]:
    """Return which coordinates of the twists must close: (0, k) of the directions, (1, k) of the moments.

    About a finite centre the moments are determined by the directions. For parallel axes one coordinate of the
    direction determines all three, and the moments are perpendicular to it.
    """
    if centre is None:
        return _SPATIAL
    if not field.is_zero(centre[3]):
        return _FINITE
    largest = max(range(3), key=lambda k: abs(centre[k]))
    return [(0, largest), *((1, k) for k in range(3) if k != largest)]


@dataclass(frozen=True, slots=True)
class ExactMobility:
    """The generic mobility of a type, with its evidence.

    Attributes
    ----------
    mobility, unknowns, rank : int
        M = unknowns - rank; the unknowns are the J joint rates, of a polyhedron model 3V - 6 velocities.
    primes : tuple of int
        The primes modulo which the rank was found, each time at another random realisation.
    forced : bool
        Whether the vertices of an SCD graph were placed too.

    Examples
    --------
    >>> exact = exact_mobility(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))]))
    >>> exact.mobility, exact.unknowns, exact.rank
    (1, 4, 3)
    """

    mobility: int
    unknowns: int
    rank: int
    primes: tuple[int, ...]
    forced: bool

    def to_json(self) -> dict[str, Any]:
        """Return the exact mobility as plain data (docs/command-json.md)."""
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
        Random seed; another seed gives another random realisation.

    Raises
    ------
    UnsolvableError
        If the type could not be placed (`graphs.rank.realisation.realise`).
    NumericalError
        If the primes give different ranks, which all but never happens; another seed settles it.

    Examples
    --------
    >>> exact_mobility(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])).mobility
    1
    """
    joints = len(mechanism.joints)
    closures = (closure_modulo(mechanism, prime, forced=forced, seed=seed) for prime in primes)
    ranks = [rank_modulo(closure.rows, joints, prime) for closure, prime in zip(closures, primes, strict=False)]
    rank = agreed_rank(ranks, primes)
    return ExactMobility(joints - rank, joints, rank, tuple(primes), forced)


def agreed_rank(ranks: Sequence[int], primes: Sequence[int]) -> int:
    """Return the rank modulo all primes; raises `NumericalError` if they differ."""
    if len(set(ranks)) > 1:
        raise NumericalError(
            f"the rank is {ranks} modulo {list(primes)}: an unlucky random realisation; try another seed"
        )
    return ranks[0]


def closure_modulo(mechanism: SCGraph, prime: int, *, forced: bool = True, seed: int = 0) -> Closure:
    """Return the closure equations of a random realisation modulo a prime."""
    field = PrimeField(prime, seed)
    placed = realise(mechanism, field, forced=forced)
    return closure_of(mechanism, placed.axes, centres_of_loops(mechanism, placed), field)


def centres_of_loops(mechanism: SCGraph, placed: GenericRealisation) -> dict[int, Any]:
    """Return the centre of each of the independent loops that has one."""
    classes = zip(placed.points, mechanism.centre_classes(), strict=False)  # vertices of SCD graphs follow
    return {loop: point for point, one in classes for loop in one.loops if loop < len(mechanism.loops)}


def matrix_modulo(closure: Closure, prime: int) -> Any:
    """Return the matrix of closure equations (`flint.nmod_mat`)."""
    return sparse_modulo(closure.rows, len(closure.joints), prime)


@dataclass(frozen=True, slots=True)
class Diagnosis:
    """Redundant closure equations of a random realisation, immobile joints, links that move as one.

    Attributes
    ----------
    mobility, idle : int
        Exact generic mobility; redundant closure equations: they follow from others.
    circuits : tuple of tuple of loops
        Smallest dependent sets of equations, one for each redundant equation: the loops they come from, each a
        tuple of joint ids.
    immobile : tuple of joint ids
        Joints that no motion turns.
    clusters : tuple of tuple of link ids
        Links that move as one, two or more together.

    Examples
    --------
    >>> diagnosis = diagnose(SCGraph(3, [(0, 1), (1, 2), (2, 0)], [Loop((0, 1, 2))]))  # three links do not move
    >>> diagnosis.mobility, diagnosis.idle, diagnosis.immobile
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
    """Find where a mechanism is overconstrained, its immobile joints and its rigid clusters of links.

    Parameters
    ----------
    mechanism : SCGraph or SCDGraph
    prime : int, optional
    forced, seed
        As for `exact_mobility`, as is the `UnsolvableError` of a type that could not be placed.

    Examples
    --------
    >>> from graphs.files.formats import read
    >>> from graphs.convert.conversions import to_sc
    >>> diagnosis = diagnose(to_sc(read("data/wiener/square-twist.fold")))  # rigid, no equation redundant
    >>> diagnosis.mobility, diagnosis.idle, len(diagnosis.immobile), len(diagnosis.clusters)
    (0, 0, 12, 1)
    """
    field = PrimeField(prime, seed)
    placed = realise(mechanism, field, forced=forced)
    closure = closure_of(mechanism, placed.axes, centres_of_loops(mechanism, placed), field)
    whole = len(closure.joints) <= _MOST_WHOLE
    rank, motions, dependent = (_kernels if whole else _kernels_by_parts)(closure, prime)
    return Diagnosis(
        mobility=len(closure.joints) - rank,
        idle=len(dependent),
        circuits=tuple(tuple(dict.fromkeys(closure.loops[row] for row in sorted(rows))) for rows in dependent),
        immobile=tuple(joint for joint, rates in motions.items() if not any(rates)),
        clusters=_clusters(mechanism, placed.axes, motions, prime),
    )


_MOST_WHOLE = 400
"""Joints of a mechanism whose matrix is not taken apart to find what depends on what: whole, it takes time
with their cube. What is found is the same."""


def _kernels(closure: Closure, prime: int) -> tuple[int, dict[JointId, list[int]], list[list[int]]]:
    """Return the rank, each joint's rates in a basis of all motions, and smallest dependent sets of rows."""
    matrix = matrix_modulo(closure, prime)
    kernel, freedoms = matrix.nullspace()
    motions = {joint: [int(kernel[j, k]) for k in range(freedoms)] for j, joint in enumerate(closure.joints)}
    rank = len(closure.joints) - freedoms if closure.joints else 0
    if not closure.rows:
        return rank, motions, []
    stresses, idle = matrix.transpose().nullspace()
    return rank, motions, [[i for i in range(len(closure.rows)) if int(stresses[i, k])] for k in range(idle)]


def _kernels_by_parts(closure: Closure, prime: int) -> tuple[int, dict[JointId, list[int]], list[list[int]]]:
    """Return the same of a large mechanism, with one general motion: what moves in it moves in some, and no other.

    Joints at rest, and links with equal twists, are so in all motions, but for one chance in the prime of each.
    """
    kernels = KernelsModulo(closure.rows, len(closure.joints), prime)
    motion = kernels.general_solution()
    return kernels.rank, {joint: [rate] for joint, rate in zip(closure.joints, motion, strict=True)}, kernels.circuits


def _clusters(
    mechanism: SCGraph, axes: Any, motions: dict[JointId, list[int]], prime: int
) -> tuple[tuple[LinkId, ...], ...]:
    """Return the links that have one twist in every motion, part by part of the mechanism."""
    together: dict[Any, list[LinkId]] = defaultdict(list)
    for link, (part, twist) in _twists_of_links(mechanism, axes, motions, prime).items():
        together[part, tuple(twist)].append(link)
    place = {link: i for i, link in enumerate(mechanism)}
    return tuple(tuple(sorted(links, key=place.__getitem__)) for links in together.values() if len(links) > 1)


def _twists_of_links(
    mechanism: SCGraph, axes: Any, motions: dict[JointId, list[int]], prime: int
) -> dict[LinkId, tuple[int, list[tuple[int, ...]]]]:
    """Return the part of each link, and its twist in each motion, against the first link of that part."""
    twists: dict[LinkId, tuple[int, list[tuple[int, ...]]]] = {}
    still: list[tuple[int, ...]] = [(0,) * 6 for _ in next(iter(motions.values()), [])]
    for part, links in enumerate(nx.connected_components(mechanism)):
        root = next(link for link in mechanism if link in links)
        twists[root] = part, still
        for a, b in nx.bfs_edges(mechanism, root):
            joint = next(iter(mechanism[a][b]))
            u, m = axes[joint]
            sign = 1 if mechanism.joints[joint] == (a, b) else -1
            twists[b] = (
                part,
                [
                    tuple((t + sign * rate * c) % prime for t, c in zip(before, (*u, *m), strict=True))
                    for before, rate in zip(twists[a][1], motions[joint], strict=True)
                ],
            )
    return twists


def relative_mobilities(
    mechanism: SCGraph, primes: Sequence[int] = PRIMES, *, forced: bool = True, seed: int = 0
) -> dict[frozenset[LinkId], int]:
    """Return the generic relative mobility of each two links of one part: the rank of their relative twists.

    That is 0 for links that move as one, 1 for neighbours whose joint moves, and at most the mobility of the type.

    Parameters
    ----------
    mechanism : SCGraph or SCDGraph
    primes, forced, seed
        As for `exact_mobility`, as are the errors.

    Returns
    -------
    dict of frozenset of two link ids to int

    Examples
    --------
    Opposite links of a spherical five-bar move against each other with both degrees of freedom, neighbours with one:

    >>> five_bar = SCGraph(5, [(0, 1), (1, 2), (2, 3), (3, 4), (4, 0)], [Loop((0, 1, 2, 3, 4))])
    >>> relative = relative_mobilities(five_bar)
    >>> relative[frozenset((0, 2))], relative[frozenset((0, 1))]
    (2, 1)
    """
    ranks: dict[frozenset[LinkId], list[int]] = defaultdict(list)
    for prime in primes:
        field = PrimeField(prime, seed)
        placed = realise(mechanism, field, forced=forced)
        closure = closure_of(mechanism, placed.axes, centres_of_loops(mechanism, placed), field)
        kernel, freedoms = matrix_modulo(closure, prime).nullspace()
        motions = {
            joint: [int(kernel[j, k]) for k in range(freedoms)] for j, joint in enumerate(closure.joints)
        }  # fmt: skip
        twists = _twists_of_links(mechanism, placed.axes, motions, prime)
        for (link, (part, own)), (other, (place, its)) in combinations(twists.items(), 2):
            if part == place:
                apart = [[(a - b) % prime for a, b in zip(*pair, strict=True)] for pair in zip(own, its, strict=True)]
                ranks[frozenset((link, other))].append(int(matrices()(apart, prime).rank()) if apart else 0)
    return {pair: agreed_rank(found, primes) for pair, found in ranks.items()}


def mobility_without(mechanism: SCGraph, joint: JointId, *, forced: bool = True, seed: int = 0) -> int:
    """Return the generic mobility once a joint is cut, all other axes left where they are.

    A joint is *critical* if that changes the mobility, *redundant* if not. Each part has a fixed link.

    Parameters
    ----------
    mechanism : SCGraph or SCDGraph
    joint : joint id
    forced, seed
        As for `graphs.rank.exact.exact_mobility`.

    Examples
    --------
    >>> mobility_without(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))]), 0)
    3
    """
    field = PrimeField(PRIMES[0], seed)
    placed = realise(mechanism, field, forced=forced)
    left = {other: ends for other, ends in mechanism.joints.items() if other != joint}
    cut = SCGraph(mechanism.nodes, left)
    axes = {other: placed.axes[other] for other in left}
    return len(left) - int(matrix_modulo(closure_of(cut, axes, {}, field), PRIMES[0]).rank())
