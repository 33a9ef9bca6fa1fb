"""Places of the nodes of a plane graph: barycentric, then pulled into shape by forces.

Tutte's theorem: if the outer face is a convex polygon and every other node lies in a weighted mean of its
neighbours, weights positive, then a plane graph whose inner faces are triangles is drawn without crossings. Here
every inner face has a *hub*, a node joined to all its corners, and weights even out the lengths. Then nodes move
under forces: sides of one length, bodies regular, nodes apart. No move may turn a triangle over, so that none
makes a crossing. Both steps treat mirror images alike. Theory: docs/theory/pictures.md.

Source: W. T. Tutte, How to draw a graph, Proc. London Math. Soc. 13 (1963).
"""

from collections.abc import Mapping, Sequence
from itertools import combinations

import numpy as np
from shapely import LinearRing

from graphs.types import Floats, Ints
from synth.making.drawing.layout.embedding import Node, faces_of

_ROUNDS = 12
_HUB_WEIGHT = 0.25
_STEPS = 80
_LOOKS = 8
"""Steps between two checks of the outer face."""
_STILL = 2e-3
_SPRING, _PUSH = 0.2, 0.06
_OF_HEIGHT = 0.45
_OPEN, _OPEN_BODIES = (0.04, 0.3), (0.6, 0.9)
"""How hard, and below which height, triangles are opened, in units of a side's length: of dots, and of bodies."""
_APART, _AWAY = 0.5, 0.8
"""How near nodes may come to edges before they are pushed, and how hard, in units of a side's length."""
_UPRIGHT = np.array([-1.0, 1.0])
_HUB_PULL = 0.5
_LARGE = 250
"""Number of nodes above which the barycentric places are kept."""


class PlaneGraph:
    """A biconnected plane graph in numbers, with hubs in its inner faces.

    It is made from the neighbours of each node, counter-clockwise, and one of the faces as `faces_of` has it, to
    be outside: clockwise then. `nodes` has the `own` nodes of the graph first, then a hub for each inner face of
    more than three corners; `hub_of` is that of each inner face. `edges`, int64[m, 2], leave out hubs; `spokes`,
    int64[s, 2], go from corners to hubs. `triangles`, int64[t, 3], and the outer face, int64[k], are
    counter-clockwise.
    """

    def __init__(self, around: Mapping[Node, Sequence[Node]], outer: Sequence[Node]) -> None:
        number = {node: i for i, node in enumerate(around)}
        self.nodes: list[Node] = list(around)
        self.own = len(number)
        self.faces = [tuple(number[node] for node in face) for face in faces_of(around)]
        outside = tuple(number[node] for node in outer)
        self.faces.remove(outside)
        edges = [(number[a], number[b]) for a, row in around.items() for b in row if number[a] < number[b]]
        spokes, triangles = [], []
        self.hub_of: list[int | None] = []
        for face in self.faces:
            hub = None if len(face) == 3 else len(self.nodes)
            self.hub_of.append(hub)
            if hub is None:
                triangles.append(face)
            else:
                self.nodes.append(("hub", hub))
                spokes += [(corner, hub) for corner in face]
                triangles += [(a, b, hub) for a, b in zip(face, (*face[1:], face[0]), strict=True)]
        self.edges: Ints = np.array(edges, np.int64).reshape(-1, 2)
        self.spokes: Ints = np.array(spokes, np.int64).reshape(-1, 2)
        self.triangles: Ints = np.array(triangles, np.int64).reshape(-1, 3)
        self.outer: Ints = np.array(outside[::-1], np.int64)


def barycentric(graph: PlaneGraph, mirror: Mapping[Node, Node] | None = None) -> Floats:
    """Return places, float[n, 2], with the outer face a regular polygon, and weights that make lengths more even.

    `mirror` is a symmetry that reverses the graph and its outer face; its mirror line is upright.
    """
    corners = len(graph.outer)
    start = 0.0  # the index in the outer face of the node on top, on the mirror line; it may lie between two
    if mirror is not None:
        row = [graph.nodes[i] for i in graph.outer.tolist()]
        start = row.index(mirror[row[0]]) / 2
    angles = np.pi / 2 + 2 * np.pi * (np.arange(corners) - start) / corners
    places = np.zeros((len(graph.nodes), 2))
    places[graph.outer] = np.column_stack([np.cos(angles), np.sin(angles)])
    inner = np.setdiff1d(np.arange(len(places)), graph.outer)
    if not len(inner):
        return places
    pairs = np.concatenate([graph.edges, graph.spokes])
    weights: Floats = np.concatenate([np.ones(len(graph.edges)), np.full(len(graph.spokes), _HUB_WEIGHT)])
    for _ in range(_ROUNDS):
        places[inner] = _balanced(pairs, weights, places, inner, graph.outer)
        lengths = np.linalg.norm(places[pairs[:, 0]] - places[pairs[:, 1]], axis=1)
        own = lengths[: len(graph.edges)]
        weights[: len(own)] *= np.clip(own / own.mean(), 0.2, 3.0)
        weights = weights.clip(1e-3, 1e3)
    return places


def _balanced(pairs: Ints, weights: Floats, places: Floats, inner: Ints, outer: Ints) -> Floats:
    """Return the places of the inner nodes where each is the weighted mean of its neighbours."""
    size = len(places)
    laplacian = np.zeros((size, size))
    np.add.at(laplacian, (pairs[:, 0], pairs[:, 1]), -weights)
    np.add.at(laplacian, (pairs[:, 1], pairs[:, 0]), -weights)
    np.fill_diagonal(laplacian, -laplacian.sum(axis=1))
    pulled: Floats = -laplacian[np.ix_(inner, outer)] @ places[outer]
    return np.asarray(np.linalg.solve(laplacian[np.ix_(inner, inner)], pulled), dtype=np.float64)


def pulled(
    graph: PlaneGraph,
    places: Floats,
    sides: Sequence[tuple[int, int]],
    bodies: Sequence[Sequence[int]],
    mirror: Mapping[Node, Node] | None = None,
) -> Floats:
    """Return places, float[n, 2] in side lengths, after the nodes moved under forces.

    Springs make sides 1 long, and bodies, by the nodes round them, regular with such sides. The drawing must have
    no crossings; its faces stay the same, without crossings. `mirror` is the symmetry of which its places are
    mirror images, upright: that is kept to the last digit, where rounding alone would let parts under pressure
    bend to one side.
    """
    size = np.linalg.norm(places[graph.edges[:, 0]] - places[graph.edges[:, 1]], axis=1).mean()
    here: Floats = places / size
    if len(here) > _LARGE:
        return here
    forces = _Forces(graph, sides, bodies)
    image = None if mirror is None else _images(graph, mirror)
    whole = here  # the last drawing whose outer face was found not to cross itself
    for number in range(_STEPS):
        longest = 0.2 * (1 - number / _STEPS) + 0.005
        move = forces.at(here)
        length = np.sqrt((move**2).sum(axis=1))
        most = np.minimum(longest, _free_way(graph.triangles, here))
        move *= np.minimum(1.0, most / np.maximum(length, 1e-12))[:, None]
        if image is not None:
            move = (move + move[image] * _UPRIGHT) / 2
        here = here + move
        if number % _LOOKS == _LOOKS - 1:
            if len(graph.outer) > 3 and not LinearRing(here[graph.outer]).is_simple:
                return whole
            whole = here
            if length.max() < _STILL:
                break
    return whole


def _images(graph: PlaneGraph, mirror: Mapping[Node, Node]) -> Ints:
    """Return the index of the image of each node, hubs included."""
    number = {node: i for i, node in enumerate(graph.nodes)}
    image: Ints = np.arange(len(graph.nodes))
    for i, node in enumerate(graph.nodes[: graph.own]):
        image[i] = number[mirror[node]]
    hub_at = dict(zip(map(frozenset, graph.faces), graph.hub_of, strict=True))
    for face, hub in zip(graph.faces, graph.hub_of, strict=True):
        if hub is not None:
            there = hub_at[frozenset(image[list(face)].tolist())]
            assert there is not None  # the image of a face has as many corners
            image[hub] = there
    return image


class _Forces:
    """Forces on the nodes of a graph; sums over nodes are products with matrices made once."""

    def __init__(self, graph: PlaneGraph, sides: Sequence[tuple[int, int]], bodies: Sequence[Sequence[int]]) -> None:
        size = len(graph.nodes)
        self._graph, self._own = graph, graph.own
        self._open_by, self._low = _OPEN_BODIES if bodies else _OPEN
        springs = [(side, 1.0, 1.0) for side in sides]
        for body in bodies:
            for i, k in combinations(range(len(body)), 2):
                length = float(np.sin(np.pi * (k - i) / len(body)) / np.sin(np.pi / len(body)))
                springs.append(((body[i], body[k]), length, 2.0))
        pairs, self._lengths, self._stiffness = (np.array(part) for part in zip(*springs, strict=True))
        self._spans = np.eye(size)[pairs[:, 1]] - np.eye(size)[pairs[:, 0]]
        ends = graph.edges
        nodes = np.arange(graph.own)[:, None]
        self._beside = (nodes != ends[:, 0]) & (nodes != ends[:, 1])
        self._ends = np.zeros((len(ends), graph.own))
        self._ends[np.arange(len(ends))[:, None], ends] = 0.5
        self._hubs = [hub for hub in graph.hub_of if hub is not None]
        self._means = np.zeros((len(self._hubs), size))
        hubbed = [face for face, hub in zip(graph.faces, graph.hub_of, strict=True) if hub is not None]
        for row, face in zip(self._means, hubbed, strict=True):
            row[list(face)] = 1 / len(face)

    def at(self, here: Floats) -> Floats:
        """Return the force on each node: float[n, 2]."""
        apart = self._spans @ here
        length = np.maximum(np.sqrt((apart**2).sum(axis=1)), 1e-9)
        pull = _SPRING * self._stiffness * (1 - self._lengths / length)
        force: Floats = -self._spans.T @ (pull[:, None] * apart)
        own = here[: self._own]
        between = own[:, None, :] - own[None, :, :]
        square = (between**2).sum(axis=-1)
        np.fill_diagonal(square, np.inf)
        force[: self._own] += ((_PUSH / square**1.5)[:, :, None] * between).sum(axis=1)
        force[: self._own] += self._off_edges(own)
        self._open(force, here)
        force[self._hubs] += _HUB_PULL * (self._means @ here - here[self._hubs])
        return force

    def _off_edges(self, own: Floats) -> Floats:
        """Push nodes off edges that they come near to, and the edges off them."""
        a, b = own[self._graph.edges[:, 0]], own[self._graph.edges[:, 1]]
        along = b - a
        off = own[:, None, :] - a
        part = (off * along).sum(axis=-1) / np.maximum((along**2).sum(axis=-1), 1e-12)
        off = off - np.clip(part, 0, 1)[:, :, None] * along
        distance = np.sqrt((off**2).sum(axis=-1))
        near = (distance < _APART) & self._beside
        size = np.where(near, _AWAY * (_APART - distance) / np.maximum(distance, 1e-6), 0.0)
        pushes = size[:, :, None] * off
        force: Floats = pushes.sum(axis=1) - self._ends.T @ pushes.sum(axis=0)
        return force

    def _open(self, force: Floats, here: Floats) -> None:
        """Push the corners of low triangles off their opposite sides: a flat one would hold its corners fast."""
        triangles = self._graph.triangles
        corners = here[triangles]
        opposite = np.roll(corners, -2, axis=1) - np.roll(corners, -1, axis=1)
        length = np.maximum(np.sqrt((opposite**2).sum(axis=2)), 1e-12)
        twice_area = opposite[:, 0, 0] * opposite[:, 1, 1] - opposite[:, 0, 1] * opposite[:, 1, 0]
        height = np.maximum(twice_area[:, None] / length, 1e-9)
        push = np.minimum(self._open_by * np.maximum(1 / height - 1 / self._low, 0.0), 1.0) / length
        inward = np.stack([-opposite[:, :, 1], opposite[:, :, 0]], axis=2) * push[:, :, None]
        np.add.at(force, triangles, inward - np.roll(inward, 1, axis=1) / 2 - np.roll(inward, 2, axis=1) / 2)


def _free_way(triangles: Ints, here: Floats) -> Floats:
    """Return the distance that each node may move: float[n].

    No triangle is turned over, wherever the others go: it keeps its sense while no corner moves half its least
    height.
    """
    corners = here[triangles]
    sides = np.roll(corners, -1, axis=1) - corners
    twice_area = np.abs(sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0])
    height = twice_area / np.sqrt((sides**2).sum(axis=2).max(axis=1))
    way = np.full(len(here), np.inf)
    np.minimum.at(way, triangles, height[:, None])
    return _OF_HEIGHT * way
