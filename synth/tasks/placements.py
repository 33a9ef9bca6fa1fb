"""Roles placed on the links of a type in all ways up to its automorphisms, and the automorphisms as permutations."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from itertools import permutations

from graphs.identity.chains import symmetries_of_links
from graphs.mechanism.sc import SCGraph
from graphs.types import LinkId

Placement = tuple[LinkId, ...]
"""The link of each role, in the order of the roles."""


def placements_of(mechanism: SCGraph, roles: int, *, alike: bool = True) -> list[Placement]:
    """Return placements of so many roles on different links, one of each orbit of the automorphisms.

    Parameters
    ----------
    mechanism : SCGraph
    roles : int
    alike : bool, optional
        Whether placements that an automorphism maps to each other count once. Members of an overconstrained family
        have less symmetry than their type, so of these all placements count.

    Returns
    -------
    list of tuple of link id
        The first of each orbit, by the order of the links.

    Examples
    --------
    Two roles on a four-bar: beside each other, or opposite.

    >>> from graphs.loops.loop import Loop
    >>> ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> placements_of(ring, 2)
    [(0, 1), (0, 2)]
    """
    links = list(mechanism.nodes)
    number = {link: place for place, link in enumerate(links)}
    generators = []
    if alike and roles:
        generators = [[number[moved[link]] for link in links] for moved in symmetries_of_links(mechanism)]
    first = _first_of_orbits(permutations(range(len(links)), roles), generators)
    return [tuple(links[place] for place in one) for one in first]


def _first_of_orbits(
    tuples: Iterator[tuple[int, ...]], generators: Collection[Sequence[int]]
) -> Iterator[tuple[int, ...]]:
    """Yield the first tuple of each orbit, in their order: all others are reached from it by generators."""
    reached: set[tuple[int, ...]] = set()
    for one in tuples:
        if one in reached:
            continue
        yield one
        front = [one]
        reached.add(one)
        while front:
            here = front.pop()
            for moved in generators:
                image = tuple(moved[place] for place in here)
                if image not in reached:
                    reached.add(image)
                    front.append(image)
