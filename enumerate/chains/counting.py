"""Counting chains without listing them, by orbits and by Burnside's lemma, compiled.

Both walk the contracted graphs. *Orbits*: of the placements on a graph, those are counted that no automorphism
makes larger (`enumerate.contracted.orbits`). *Burnside*: the number of orbits is the mean, over the automorphisms,
of the number of placements that an automorphism leaves as they are; these are the placements on the cycles of
joints, so no placement is ever compared with another (`enumerate.contracted.fixed_placements`). Theory:
docs/theory/chains.md.
"""

import numpy as np

from enumerate.contracted.binary_links import (
    EVERY,
    Frame,
    PlacementRange,
    Units,
    conditions,
    frame_of,
    no_prefix,
    place,
)
from enumerate.contracted.fixed_placements import Cycles, count_left_in_place, cycles_of
from enumerate.contracted.orbits import count_orbits, count_with_a_link
from enumerate.contracted.states import order_of_classes
from enumerate.kernel._compiled import compiled, number_of_orbits
from graphs.types import Bytes, Ints


@compiled
def count_by_orbits(codes: Bytes, n: int, links: int, most: int, inversions: bool) -> int:
    """Return the number of chains, or of inversions, from some contracted graphs, one of each orbit of placements.

    Parameters
    ----------
    codes : uint8[k, m]
        Contracted graphs.
    n : int
        Their number of links.
    links : int
        Number of links N of the chains.
    most : int
        The longest string of binary links to allow.
    inversions : bool
        Count pairs of a chain and a link of it, up to isomorphism.

    Examples
    --------
    The chains of Watt and Stephenson come of two links with three joints:

    >>> from enumerate.contracted.graphs import cubic_graphs
    >>> count_by_orbits(cubic_graphs(2), 2, 6, 2, False)
    2
    """
    total = 0
    for c in range(len(codes)):
        frame = frame_of(codes[c], n)
        if inversions:
            total += count_with_a_link(frame, links - n, most)
        else:
            total += count_orbits(frame, links - n, most)
    return int(total)


@compiled
def count_of_graph(code: Bytes, n: int, links: int, most: int, only: int, prefix: Ints) -> int:
    """Return the number of chains of one contracted graph that begin in one way.

    `only`: placements with this number W of bound units only, or `EVERY`; `prefix`: where the first units lie.
    """
    return count_in(frame_of(code, n), PlacementRange(links, most, only), prefix)


@compiled
def count_in(frame: Frame, wanted: PlacementRange, prefix: Ints) -> int:
    """Return the number of placements with a prefix, the joints of the first units."""
    units, m = wanted.links - frame.links, len(frame.ends)
    if wanted.only == EVERY and len(prefix) == 0:
        return int(count_orbits(frame, units, wanted.most))
    nothing, nowhere = np.zeros((0, m), np.uint8), no_prefix()
    cost = np.ones(m, np.int64)
    total = 0
    for bound in range(max(frame.needs[-1], 0), min(units, 2 * m) + 1):
        if wanted.only in (EVERY, bound):
            room, weight = conditions(frame.ends, frame.sets, frame.needs, bound)
            left = Units(bound, units - bound, wanted.most)
            total += place(room, weight, cost, frame.first, left, frame.moved, prefix, nothing, nowhere)
    return int(total)


@compiled
def count_fixed(frame: Frame, moved: Bytes, links: int, most: int) -> int:
    """Return the number of placements that a permutation of the joints leaves as they are."""
    order = order_of_classes(frame, moved.reshape(1, -1))
    cycles = cycles_of(frame, moved, np.arange(frame.links).astype(np.uint8), order)
    return _in_place(cycles, frame.needs, links - frame.links, most)[0]


@compiled
def _in_place(cycles: Cycles, needs: Ints, units: int, most: int) -> tuple[int, int]:
    """Return the number of placements of so many binary links on cycles of joints, and of links that stay."""
    total = still = 0
    for bound in range(max(needs[-1], 0), min(units, 2 * cycles.cost.sum()) + 1):
        placements, links = count_left_in_place(cycles, needs, bound, units - bound, most)
        total += placements
        still += links
    return total, still


@compiled
def count_by_burnside(codes: Bytes, n: int, links: int, most: int, inversions: bool) -> int:
    """Return what `count_by_orbits` does, by Burnside's lemma.

    Parameters
    ----------
    codes, n, links, most, inversions
        As for `count_by_orbits`.

    Examples
    --------
    The chains of Watt and Stephenson come of two links with three joints:

    >>> from enumerate.contracted.graphs import cubic_graphs
    >>> count_by_burnside(cubic_graphs(2), 2, 6, 2, False)
    2
    """
    total = 0
    for c in range(len(codes)):
        frame = frame_of(codes[c], n)
        automorphisms = frame.automorphisms
        order = order_of_classes(frame, frame.moved[:1])
        fixed = 0
        for a in range(len(automorphisms)):
            cycles = cycles_of(frame, frame.moved[a], automorphisms[a], order)
            placements, still = _in_place(cycles, frame.needs, links - n, most)
            fixed += placements
            if inversions:
                fixed += still - placements
                for v in range(n):
                    fixed += placements * (automorphisms[a, v] == v)
        total += number_of_orbits(fixed, len(automorphisms))
    return int(total)
