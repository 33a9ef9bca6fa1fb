"""How many positions a general member of a family has at most, by theorems about realisations of plates and bars.

Links that driven joints hold together are one plate, whose vertices are its other joints; a binary link is a bar. In
the plane the realisations are the points in which a linear space meets the inverse of another (Capco, Gallet,
Grasegger, Koutschan, Lubbes, Schicho 2018), on the sphere their number is the degree of a product of forgetful maps
between spaces of marked rational curves (Gallet, Grasegger, Schicho 2020). Both are recursions over integers. Theory:
docs/theory/positions.md.
"""

from collections.abc import Iterator, Sequence
from functools import cache
from math import prod

import networkx as nx
import numpy as np

from graphs.rank.dissection import matrices
from graphs.rank.realisation import PRIMES
from synth.analysis.assembly.family import Family
from synth.analysis.assembly.kernel import DIRECTION, SLIDE

Plates = list[frozenset[int]]
Quadruple = tuple[int, ...]

_MOST_PLATES, _MOST_VERTICES = 12, 10
"""Plates in the plane and vertices on the sphere, less dyads, that are counted: of more it would take minutes."""


def root_count(family: Family) -> int | None:
    """Return how many isolated positions a member has at most, and a general one exactly; None if no theorem says.

    Loops that share no unknown joint are counted apart. A loop with three unknown joints has two positions, whatever
    kinds of joints they are: a slide is the limit of a rotation.
    """
    numbers = [_of_part(family, loops) for loops in _parts(family)]
    return None if any(number is None for number in numbers) else prod(number or 0 for number in numbers)


def _parts(family: Family) -> Iterator[list[int]]:
    """Yield the loops of each part; two loops are of one part if they share an unknown joint."""
    shared = nx.Graph()
    for number in range(len(family.loops)):
        shared.add_node(("loop", number))
        shared.add_edges_from((("loop", number), joint) for joint in _unknown_joints(family, number))
    for part in nx.connected_components(shared):
        yield sorted(node[1] for node in part if isinstance(node, tuple))


def _axes_of_loop(family: Family, loop: int) -> list[int]:
    return [axis for axis in family.loops[loop].tolist() if axis >= 0]


def _unknown_joints(family: Family, loop: int) -> list[int]:
    joints = family.axes[_axes_of_loop(family, loop), 0]
    return [int(joint) for joint in joints[family.column[joints] >= 0]]


def _of_part(family: Family, loops: Sequence[int]) -> int | None:
    axes = sorted({axis for loop in loops for axis in _axes_of_loop(family, loop)})
    kinds = set(family.axes[axes, 1].tolist())
    slides = {axis for axis in axes if family.axes[axis, 1] == SLIDE and family.column[family.axes[axis, 0]] >= 0}
    if _one_by_one(family, loops):
        return int(2 ** len(loops))
    if slides or (DIRECTION in kinds and len(kinds) > 1):
        return None
    plates = _plates(family, axes)
    plates, dyads = _without_dyads(plates)
    counted = on_sphere if kinds == {DIRECTION} else in_plane
    rest = counted(plates) if plates else 1
    return None if not rest else int(rest * 2**dyads)


def _one_by_one(family: Family, loops: Sequence[int]) -> bool:
    """Whether the loops can be solved one after the other, each with three unknown joints left."""
    known: set[int] = set()
    left = {loop: set(_unknown_joints(family, loop)) for loop in loops}
    while left:
        ready = [loop for loop, joints in left.items() if len(joints - known) == 3]
        if not ready:
            return False
        known |= left.pop(ready[0])
    return True


def _plates(family: Family, axes: Sequence[int]) -> Plates:
    """Return the vertices of each plate: links that driven joints hold together; axes that coincide are one vertex."""
    held, of_link = nx.utils.UnionFind(), dict[int, set[int]]()
    for axis in axes:
        joint = int(family.axes[axis, 0])
        first, second = family.links[joint].tolist()
        if family.column[joint] < 0:
            held.union(first, second)
        for link in (first, second) if family.column[joint] >= 0 else ():
            of_link.setdefault(link, set()).add(int(family.alike[axis, 0]))
    plates: dict[int, set[int]] = {}
    for link, vertices in of_link.items():
        plates.setdefault(held[link], set()).update(vertices)
    return [frozenset(vertices) for vertices in plates.values()]


def _without_dyads(plates: Plates) -> tuple[Plates, int]:
    """Return plates less pairs of bars at a vertex that is in no third one, each with two places; and how many.

    Vertices that are in one plate only are left out, but for the plate that remains of all.
    """
    here, dyads = [set(plate) for plate in plates], 0
    while True:
        at: dict[int, list[set[int]]] = {}
        for plate in here:
            for vertex in plate:
                at.setdefault(vertex, []).append(plate)
        alone = next((v for v, those in at.items() if len(those) == 1 and len(those[0]) > 2), None)
        dyad = next((v for v, those in at.items() if len(those) == 2 and all(len(one) == 2 for one in those)), None)
        if alone is not None:
            at[alone][0].discard(alone)
        elif dyad is not None:
            here = [plate for plate in here if dyad not in plate]
            dyads += 1
        else:
            break
    return ([] if len(here) <= 1 else [frozenset(plate) for plate in here]), dyads


def in_plane(plates: Sequence[frozenset[int]]) -> int | None:
    """Return in how many ways plates in general position fit together in the plane; 0 if they do not, or move.

    Turned by unit complex numbers t of their own, plates close along loops if t is in a linear space V and 1/t in
    another V', of the same matroid. By the cited theorem, here for the linear spaces of plates instead of bars (its
    proof uses ranks only), the number is a sum over the ways to part all plates but one.
    """
    if len(plates) > _MOST_PLATES:
        return None
    vertices = sorted(set().union(*plates))
    place, random = {vertex: len(plates) + k for k, vertex in enumerate(vertices)}, np.random.default_rng(len(vertices))
    prime, rows = PRIMES[0], []
    for number, plate in enumerate(plates):
        first, *others = sorted(plate)
        for vertex in others:
            row = [0] * (len(plates) + len(vertices))
            row[place[first]], row[place[vertex]], row[number] = -1 % prime, 1, int(random.integers(1, prime))
            rows.append(row)

    @cache
    def left_out(these: int) -> int:
        keep = [column for column in range(len(rows[0])) if not these >> column & 1]
        return int(matrices()([[row[column] for column in keep] for row in rows], prime).rank())

    def rank(these: int) -> int:  # of the coordinates of V: those that are not determined by the others
        return these.bit_count() - left_out(0) + left_out(these)

    @cache
    def number_of(left: int, one: int, other: int) -> int:
        """Points with coordinates `left`, of minors of V and V' in which `one` and `other` are contracted."""
        places = [1 << k for k in range(left.bit_length()) if left >> k & 1]
        if any(rank(one | p) == rank(one) or rank(other | p) == rank(other) for p in places):
            return 0
        if rank(one | left) - rank(one) + rank(other | left) - rank(other) != len(places) + 1:
            return 0
        if len(places) == 1:
            return 1
        first, rest, total = places[0], left & ~places[0], 0
        part = rest
        while True:  # all parts of the rest, and what is left of it
            others = rest & ~part
            if not others:
                total += number_of(rest, one, other | first)
            elif not part:
                total += number_of(rest, one | first, other)
            else:
                found = number_of(others, one | first | part, other)
                total += found and found * number_of(part, one, other | first | others)
            if not part:
                return total
            part = (part - 1) & rest

    return int(number_of((1 << len(plates)) - 1, 0, 0))


def on_sphere(plates: Sequence[frozenset[int]]) -> int | None:
    """Return in how many ways plates in general position fit together on the sphere; 0 if they do not, or move.

    The complex sphere is pairs of points of a conic, and a distance a cross ratio of two pairs: realisations are the
    inverse images of a general point under a product of maps, each of which forgets all marked points but four. A
    plate is bars between its vertices, in triangles, each of which could be turned over.
    """
    vertices = sorted(set().union(*plates))
    if len(vertices) > _MOST_VERTICES:
        return None
    bars, triangles = set[tuple[int, int]](), 0
    for plate in plates:
        first, second, *others = sorted(plate)
        bars |= {(first, second), *((corner, vertex) for vertex in others for corner in (first, second))}
        triangles += len(others)
    if len(bars) != sum(2 * len(plate) - 3 for plate in plates):
        return 0  # two plates share a side
    place = {vertex: 2 * k for k, vertex in enumerate(vertices)}
    quadruples = [(place[a], place[a] + 1, place[b], place[b] + 1) for a, b in sorted(bars)]
    return int(_degree(2 * len(vertices), tuple(quadruples))) // int(2**triangles)


@cache
def _degree(marked: int, quadruples: tuple[Quadruple, ...]) -> int:
    """Return the degree of the map from curves with marked points to the cross ratios of quadruples of them.

    One cross ratio is moved to where its first two points come together: there the curve has two components, with
    those between them, and each other quadruple has three points at least on one of them.
    """
    if len(quadruples) != marked - 3:
        return 0
    if not quadruples:
        return 1
    total = 0
    for near in _components(marked, quadruples):
        far = [point for point in range(marked) if point not in near]
        there = [sum(point in near for point in four) > 2 for four in quadruples[1:]]
        if sum(there) != len(near) - 2:
            continue
        sides = []
        for side, taken in ((sorted(near), True), (far, False)):
            number = {point: k for k, point in enumerate(side)}
            fours = (four for four, is_near in zip(quadruples[1:], there, strict=True) if is_near == taken)
            kept = sorted(tuple(sorted(number.get(point, len(side)) for point in four)) for four in fours)
            sides.append((len(side) + 1, tuple(kept)))
        (size, fours_near), (others, fours_far) = sides
        found = _degree(size, fours_near)
        total += found and found * _degree(others, fours_far)
    return total


def _components(marked: int, quadruples: tuple[Quadruple, ...]) -> Iterator[frozenset[int]]:
    """Yield the marked points that may lie with the first two of the first quadruple, apart from its last two."""
    (a, b, c, d), others = quadruples[0], quadruples[1:]
    side = {a: True, b: True, c: False, d: False}
    of_point: dict[int, list[Quadruple]] = {point: [] for point in range(marked)}
    for four in others:
        for point in four:
            of_point[point].append(four)
    order = [point for point in range(marked) if point not in side]

    def fits(point: int) -> bool:  # no quadruple is parted into two and two
        return all(
            not (all(other in side for other in four) and sum(side[other] for other in four) == 2)
            for four in of_point[point]
        )

    def placed(rank: int) -> Iterator[frozenset[int]]:
        if rank == len(order):
            yield frozenset(point for point, near in side.items() if near)
            return
        for near in (True, False):
            side[order[rank]] = near
            if fits(order[rank]):
                yield from placed(rank + 1)
        del side[order[rank]]

    if all(fits(point) for point in (a, b, c, d)):
        yield from placed(0)
