"""Canonical numbers and symmetries of coloured graphs as bliss gives them, in plain Python.

bliss refines cells of vertices, gives one vertex of a cell a cell of its own, refines again, and so on, until each
vertex has its own: a leaf. Each refinement has a certificate, what it meets; of all leaves bliss takes one whose
certificates, level after level, are the greatest, and its pruning does not change which these are. Components,
cells that are joined to other cells wholly or not at all, do not depend on each other: the greatest leaf has the
greatest of each, one after the other.

This is the second road to the ids: it shares no code with bliss or `enumerate.kernel.bliss_order`, takes graphs of
any size, and stands in where bliss is not installed. Source: Junttila and Kaski, *Engineering an efficient
canonical labeling tool for large and sparse graphs*, ALENEX 2007; *Conflict propagation and component recursion
for canonical labeling*, TAPAS 2011. Theory: docs/theory/chains.md.
"""

from __future__ import annotations

from collections import Counter, defaultdict, deque
from collections.abc import Iterable, Sequence
from typing import NamedTuple


class ColouredGraph(NamedTuple):
    """A simple graph whose nodes 0, 1, ... may have colours; edges are pairs of nodes, no pair twice.

    Labels and automorphisms keep the colours, one for each node; if there are none, all nodes are alike.
    """

    nodes: int
    edges: Iterable[Sequence[int]]
    colours: Sequence[int] = ()


class Symmetries(NamedTuple):
    """Canonical numbers of nodes, permutations of nodes that generate the automorphisms, how many these are."""

    labels: list[int]
    generators: list[list[int]]
    size: float


_Certificate = list[tuple[int, int, int]]
_SPLIT, _EDGE = 0, 1


class _Cells:
    """Ordered cells of vertices; a cell is named by its place, the number of vertices in the cells before it.

    `at` holds the vertices of each cell, `place` the cell of each vertex, `waiting` the cells by which the others
    are still to be refined.
    """

    def __init__(self, at: dict[int, list[int]], place: list[int]) -> None:
        self.at, self.place = at, place
        self.waiting: deque[int] = deque()

    def copy(self) -> _Cells:
        return _Cells(self.at.copy(), self.place.copy())

    def put(self, place: int, members: list[int]) -> None:
        """Let vertices be the cell at a place."""
        self.at[place] = members
        for vertex in members:
            self.place[vertex] = place

    def wait(self, place: int, size: int) -> None:
        """Let a cell wait: before all others if it is one vertex, else behind them."""
        (self.waiting.appendleft if size == 1 else self.waiting.append)(place)

    def single_out(self, place: int, vertex: int) -> None:
        """Give a vertex of a cell a cell of its own, behind the others; what is one vertex now waits."""
        others = [other for other in self.at[place] if other != vertex]
        self.at[place] = others
        self.put(place + len(others), [vertex])
        if len(others) == 1:
            self.wait(place, 1)
        self.wait(place + len(others), 1)

    def split(self, place: int, counts: dict[int, int]) -> list[int]:
        """Split a cell by numbers of its vertices, lowest first, and return the places of its parts."""
        members = self.at[place]
        parts: dict[int, list[int]] = defaultdict(list)
        for vertex in members:
            parts[counts.get(vertex, 0)].append(vertex)
        if len(parts) == 1:
            return [place]
        waits, end = place in self.waiting, place + len(members)
        places = []
        for count in sorted(parts):
            self.put(place, parts[count])
            places.append(place)
            place += len(parts[count])
        if waits:
            for new in places[1:]:
                self.wait(new, end - new)  # for bliss, it still holds the vertices behind it
            return places
        # All wait but the largest, which waits only if it is one vertex: then its edges belong to the certificate.
        largest = places[0]
        for new in places[1:]:
            size, most = len(self.at[new]), len(self.at[largest])
            if size > most or (size == most and max(parts) == 1):  # of counts 0 and 1, the first of equals waits
                self.wait(largest, most)
                largest = new
            else:
                self.wait(new, size)
        if len(self.at[largest]) == 1:
            self.wait(largest, 1)
        return places


class _Leaf(NamedTuple):
    """The certificates of the levels of some cells, the cells, all of one vertex now, and their symmetries."""

    levels: list[_Certificate]
    cells: _Cells
    size: float


class _Search:
    """The search for the greatest leaf of a graph; `generators` are those of the symmetries met on the way."""

    def __init__(self, graph: ColouredGraph) -> None:
        neighbours: list[set[int]] = [set() for _ in range(graph.nodes)]
        for a, b in graph.edges:
            neighbours[a].add(b)
            neighbours[b].add(a)
        self.neighbours = neighbours
        self.colours = graph.colours or [0] * graph.nodes
        self.generators: list[list[int]] = []

    def run(self) -> Symmetries:
        """Return canonical numbers and symmetries."""
        leaf = self.greatest(self.start(), set(range(len(self.neighbours))), None)
        assert leaf is not None
        return Symmetries(leaf.cells.place, self.generators, leaf.size)

    def start(self) -> _Cells:
        """Return cells of equal colours and degrees, refined."""
        alike: dict[tuple[int, int], list[int]] = defaultdict(list)
        for vertex, beside in enumerate(self.neighbours):
            alike[self.colours[vertex], len(beside)].append(vertex)
        cells, place = _Cells({}, [0] * len(self.neighbours)), 0
        for kind in sorted(alike):
            cells.put(place, alike[kind])
            cells.wait(place, len(alike[kind]))
            place += len(alike[kind])
        self.refine(cells)
        return cells

    def refine(self, cells: _Cells) -> _Certificate:
        """Split cells until the vertices of each have equally many neighbours in any other; return what is met."""
        certificate: _Certificate = []
        while cells.waiting:
            place = cells.waiting.popleft()
            splitter = cells.at[place]
            counts = Counter(beside for vertex in splitter for beside in self.neighbours[vertex])
            for touched in sorted({cells.place[vertex] for vertex in counts}):
                if len(splitter) == 1:
                    # The neighbours of a vertex come last in their cell: these edges have their final numbers.
                    last = cells.split(touched, counts)[-1]
                    certificate += [(_EDGE, place, last + i) for i in range(len(cells.at[last]))]
                elif len(cells.at[touched]) > 1:
                    certificate += [(_SPLIT, p, len(cells.at[p])) for p in cells.split(touched, counts)]
        return certificate

    def component(self, cells: _Cells, region: set[int]) -> tuple[int, set[int]] | None:
        """Return the cell to split next, that with most neighbour cells, and the vertices of its component.

        The component is that of the first cell in a region that has two vertices or more; cells belong together
        where their vertices are neighbours of some, not all, vertices of the other. None: there is no such cell.
        """
        first = min((cells.place[v] for v in region if len(cells.at[cells.place[v]]) > 1), default=None)
        if first is None:
            return None
        beside: dict[int, list[int]] = {}
        todo = [first]
        while todo:
            place = todo.pop()
            if place in beside:
                continue
            numbers = Counter(cells.place[vertex] for vertex in self.neighbours[cells.at[place][0]])
            beside[place] = [other for other, number in numbers.items() if number < len(cells.at[other])]
            todo += beside[place]
        chosen = min(beside, key=lambda place: (-len(beside[place]), place))
        return chosen, {vertex for place in beside for vertex in cells.at[place]}

    def greatest(self, cells: _Cells, region: set[int], bound: list[_Certificate] | None) -> _Leaf | None:
        """Return the greatest leaf of a region, component after component; None if it is less than a bound.

        Of leaves that equal the bound any one is returned: then the region is isomorphic to that of the bound.
        """
        levels: list[_Certificate] = []
        leaf, size, rest = cells, 1.0, bound
        while found := self.component(leaf, region):
            part = self.greatest_of_component(leaf, *found, rest)
            if part is None:
                return None
            if rest is not None:
                if part.levels != rest[: len(part.levels)]:
                    # Greater than the bound. Where earlier components equalled it, their symmetries are not known.
                    if levels:
                        return self.greatest(cells, region, None)
                    rest = None
                else:
                    rest = rest[len(part.levels) :]
            levels += part.levels
            leaf, size = part.cells, size * part.size
        return _Leaf(levels, leaf, size)

    def greatest_of_component(
        self, cells: _Cells, chosen: int, component: set[int], bound: list[_Certificate] | None
    ) -> _Leaf | None:
        """Return the greatest leaf of a component, each vertex of a cell singled out in turn.

        Vertices that symmetries exchange have equal leaves, and one of them is enough; a leaf that equals the
        greatest up to now gives a symmetry. Those found further down keep the cells here, so they count here too.
        """
        members, before = cells.at[chosen], len(self.generators)
        best: _Leaf | None = None
        origin, tried = -1, set[int]()
        for vertex in members:
            if vertex in self.images(tried, before):
                continue
            tried.add(vertex)
            child = cells.copy()
            child.single_out(chosen, vertex)
            level = self.refine(child)
            if bound is not None and level < bound[0]:
                continue
            below = self.greatest(child, component, bound[1:] if bound is not None and level == bound[0] else None)
            if below is None:
                continue
            leaf = _Leaf([level, *below.levels], below.cells, below.size)
            if bound is None or leaf.levels != bound[: len(leaf.levels)]:
                best, bound, origin = leaf, leaf.levels, vertex
            elif best is None:
                return leaf
            else:
                self.generators.append(self.exchange(best.cells, leaf.cells, component))
        # Orbit-stabiliser: each symmetry takes the vertex to one of its orbit, those below leave it in place.
        return best and best._replace(size=best.size * len(self.images({origin}, before)))

    def images(self, vertices: set[int], before: int) -> set[int]:
        """Return all vertices to which symmetries take some vertices: those found after so many others."""
        images, todo = set(vertices), list(vertices)
        while todo:
            vertex = todo.pop()
            new = {generator[vertex] for generator in self.generators[before:]} - images
            images |= new
            todo += new
        return images

    def exchange(self, first: _Cells, second: _Cells, component: set[int]) -> list[int]:
        """Return the permutation that takes each vertex of a component to that with the same place."""
        permutation = list(range(len(self.neighbours)))
        for vertex in component:
            permutation[vertex] = second.at[first.place[vertex]][0]
        return permutation


def greatest_leaf(graph: ColouredGraph) -> Symmetries:
    """Return canonical numbers, generators and number of automorphisms of a coloured graph.

    >>> greatest_leaf(ColouredGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])).size
    8.0
    """
    return _Search(graph).run()
