"""Canonical numbers and symmetries of coloured graphs: the definition of ids, in plain Python.

Cells of vertices are refined, one vertex of a cell gets a cell of its own, cells are refined again, and so on, until
each vertex has its own: a leaf. Each refinement has a certificate, what it meets; the canonical leaf is one whose
certificates, level after level, are the greatest. That is bliss's leaf too: pruning does not change which these are.
Components, cells that are joined to other cells wholly or not at all, do not depend on each other: the greatest
leaf has the greatest of each, one after the other.

The search in C (leaves.c) is the same, step by step, and stands in its place where it was built
(`graphs.identity.numbering`). Source: Junttila and Kaski, *Engineering an efficient canonical labeling tool for large
and sparse graphs*, ALENEX 2007; *Conflict propagation and component recursion for canonical labeling*, TAPAS 2011.
Theory: docs/theory/chains.md.
"""

from __future__ import annotations

from collections import Counter, defaultdict, deque
from collections.abc import Generator, Iterable, Sequence
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
_SPLIT = 0  # entries are compared in this order by bliss: changed, all ids would change
_EDGE = 1  # after splits, see there
# Vertices with the greatest level in a row before the search goes on below one. More cost a refinement each, once for
# each level of a graph whose vertices are alike; with fewer a greater level is overlooked more often, in one case of 16
# where half of the vertices have it, and the search below is in vain. leaves.c has the same number.
_LOOKED_AT = 4


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
    """A leaf: the certificates of its levels from the root on, the vertices singled out, the cells, all of one vertex.

    `size` counts the symmetries that leave in place what the step that returns it began with; `equal` says that its
    levels are those of the bound of that step.
    """

    levels: list[_Certificate]
    path: frozenset[int]
    cells: _Cells
    size: float
    equal: bool


_Step = Generator["_Step", _Leaf | None, _Leaf | None]
"""A step of the search: it yields a step whose greatest leaf it needs, and returns its own."""


class _Orbits:
    """Orbits of the vertices of a cell under the symmetries found up to now; each is known by its first vertex.

    Of the symmetries found before, those count that leave in place what was singled out on the way to the cell; what is
    found later does so anyway.
    """

    def __init__(self, members: list[int], moves: list[dict[int, int]], path: frozenset[int]) -> None:
        self._first = {vertex: vertex for vertex in members}
        self._moves, self._known = moves, len(moves)
        for one in moves:
            if path.isdisjoint(one):
                self._join(one)

    def _find(self, vertex: int) -> int:
        first = self._first
        while first[vertex] != vertex:
            first[vertex] = vertex = first[first[vertex]]
        return vertex

    def _join(self, moves: dict[int, int]) -> None:
        for vertex, image in moves.items():
            if vertex in self._first:
                a, b = self._find(vertex), self._find(image)
                self._first[max(a, b)] = min(a, b)

    def first(self, vertex: int) -> int:
        """Return the first vertex of the orbit of a vertex."""
        for one in self._moves[self._known :]:
            self._join(one)
        self._known = len(self._moves)
        return self._find(vertex)

    def size(self, vertex: int) -> int:
        """Return how many vertices the orbit of a vertex has."""
        first = self.first(vertex)
        return sum(self._find(other) == first for other in self._first)


class _Search:
    """The search for the greatest leaf of a graph.

    `moves` are the symmetries met on the way, each as the vertices that it moves and their images.
    """

    def __init__(self, graph: ColouredGraph) -> None:
        neighbours: list[set[int]] = [set() for _ in range(graph.nodes)]
        for a, b in graph.edges:
            neighbours[a].add(b)
            neighbours[b].add(a)
        self.neighbours = neighbours
        self.colours = graph.colours or [0] * graph.nodes
        self.moves: list[dict[int, int]] = []

    def run(self) -> Symmetries:
        """Return canonical numbers and symmetries. Steps are on a stack of ours: Python's own is too low for some."""
        every = range(len(self.neighbours))
        root = _Leaf([], frozenset(), self.start(), 1.0, False)
        steps, leaf = [self.greatest(root, set(every), None)], None
        while steps:
            try:
                steps.append(steps[-1].send(leaf))
                leaf = None
            except StopIteration as ended:
                leaf = ended.value
                steps.pop()
        assert leaf is not None
        generators = [[moves.get(vertex, vertex) for vertex in every] for moves in self.moves]
        return Symmetries(leaf.cells.place, generators, leaf.size)

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
        self.refine(cells, None)
        return cells

    def refine(self, cells: _Cells, bound: _Certificate | None) -> tuple[_Certificate, int]:
        """Split cells until the vertices of each have equally many neighbours in any other.

        Returned are the certificate, and how it compares with a bound: -1 less, and then nothing more was done, 0
        equal, 1 greater, or no bound.
        """
        certificate: _Certificate = []
        order, compared = 1 if bound is None else 0, 0
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
            if bound is not None and order == 0:
                here, there = certificate[compared:], bound[compared : len(certificate)]
                if here < there:
                    return certificate, -1
                order, compared = int(here > there), len(certificate)
        return certificate, -1 if bound is not None and order == 0 and compared < len(bound) else order

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

    def greatest(self, node: _Leaf, region: set[int], bound: list[_Certificate] | None) -> _Step:
        """Return the greatest leaf of a region, component after component; None if it is less than a bound.

        Of leaves that equal the bound any one is returned: then the region is isomorphic to that of the bound.
        """
        leaf, size, rest = node, 1.0, bound
        while found := self.component(leaf.cells, region):
            part = yield self.greatest_of_component(leaf, *found, rest)
            if part is None:
                return None
            if rest is not None and not part.equal:
                # Greater than the bound. Where earlier components equalled it, their symmetries are not known.
                if leaf is not node:
                    return (yield self.greatest(node, region, None))
                rest = None
            leaf, size = part, size * part.size
        return leaf._replace(size=size, equal=rest is not None)

    def greatest_of_component(
        self, node: _Leaf, chosen: int, component: set[int], bound: list[_Certificate] | None
    ) -> _Step:
        """Return the greatest leaf of a component, each vertex of a cell singled out in turn.

        Vertices that symmetries exchange have equal leaves, and the first of them is enough; a leaf that equals the
        greatest up to now gives a symmetry. Those found further down keep the cells here, so they count here too.
        """
        members, depth = sorted(node.cells.at[chosen]), len(node.levels)
        alike = len(members) == len(component) and self.all_alike(component)
        orbits = _Orbits(members, self.moves, node.path)
        best: _Leaf | None = None
        todo, origin = deque(members[:1] if alike else members), -1
        while todo:
            vertex = todo.popleft()
            if orbits.first(vertex) != vertex:
                continue
            below, order = self.child(node, chosen, vertex, None if bound is None else bound[depth])
            if order < 0:
                continue
            if order > 0 and len(below.cells.at) < len(self.neighbours):
                vertex, below = self.look_on(node, chosen, (vertex, below), todo, orbits)
            leaf = yield self.greatest(below, component, None if order else bound)
            if leaf is None:
                continue
            if order or not leaf.equal:
                best, bound, origin = leaf, leaf.levels, vertex
            elif best is None:
                return leaf
            else:
                self.moves.append(self.exchange(best.cells, leaf.cells, component))
        if best is None:
            return None
        if alike:
            first, second = members[:2]
            self.moves.append({first: second, second: first})  # those of the others were found below
            return best._replace(size=best.size * len(members), equal=False)
        # Orbit-stabiliser: each symmetry takes the vertex to one of its orbit, those below leave it in place.
        return best._replace(size=best.size * orbits.size(origin), equal=False)

    def child(self, node: _Leaf, chosen: int, vertex: int, bound: _Certificate | None) -> tuple[_Leaf, int]:
        """Return what lies below a vertex that is singled out, and how its level compares with a bound (`refine`)."""
        cells = node.cells.copy()
        cells.single_out(chosen, vertex)
        level, order = self.refine(cells, bound)
        return _Leaf([*node.levels, level], node.path | {vertex}, cells, 1.0, False), order

    def look_on(
        self, node: _Leaf, chosen: int, first: tuple[int, _Leaf], todo: deque[int], orbits: _Orbits
    ) -> tuple[int, _Leaf]:
        """Return the vertex with the greatest level among some, and drop those before it from those to do.

        What is found below a vertex counts for nothing once there is a greater one. So before the search goes on
        below a vertex, it looks for a greater one, until some in a row are as great.
        """
        found, equal, before = first, 0, 0
        for i, vertex in enumerate(todo):
            if orbits.first(vertex) != vertex:
                continue
            below, order = self.child(node, chosen, vertex, found[1].levels[-1])
            if order > 0:
                found, equal, before = (vertex, below), 0, i + 1
            equal += order == 0
            if equal == _LOOKED_AT:
                break
        for _ in range(before):
            todo.popleft()
        return found

    def all_alike(self, cell: set[int]) -> bool:
        """Check whether a cell that is a component is complete or empty: then all its permutations are symmetries."""
        inside = len(self.neighbours[min(cell)] & cell)
        return inside in (0, len(cell) - 1)

    def exchange(self, first: _Cells, second: _Cells, component: set[int]) -> dict[int, int]:
        """Return what the permutation moves that takes each vertex of a component to that with the same place."""
        images = {vertex: second.at[first.place[vertex]][0] for vertex in component}
        return {vertex: image for vertex, image in images.items() if image != vertex}


def greatest_leaf(graph: ColouredGraph) -> Symmetries:
    """Return canonical numbers, generators and number of automorphisms of a coloured graph.

    >>> greatest_leaf(ColouredGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])).size
    8.0
    """
    return _Search(graph).run()
