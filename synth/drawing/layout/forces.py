"""Plane graphs pulled into shape: sides of one length, bodies regular, nodes apart; nothing is turned over."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from graphs.types import Flags, Floats, Ints
from synth.drawing.layout.embedding import Node
from synth.drawing.layout.plane import PlaneGraph

__all__ = ["Springs", "pulled", "springs_of"]

_ROUNDS = 80
_LOOKS = 8
"""Rounds between two looks at the outer face."""
_STILL = 2e-3
_SPRING, _PUSH = 0.2, 0.06
_OF_HEIGHT = 0.45
_OPEN, _LOW = 0.04, 0.3
"""How hard, and below which height, triangles are opened, in units of a side's length."""
_APART, _AWAY = 0.5, 0.8
"""How near nodes may come to edges before they are pushed, and how hard, in units of a side's length."""
_UPRIGHT = np.array([-1.0, 1.0])
_HUB_PULL = 0.5
_LARGE = 250
"""Nodes of which more are left where the barycentres are."""


@dataclass(frozen=True, slots=True)
class Springs:
    """Pairs of nodes with the distance they would have.

    Attributes
    ----------
    pairs : int64[s, 2]
    lengths : float[s]
    stiffness : float[s]
    """

    pairs: Ints
    lengths: Floats
    stiffness: Floats


def springs_of(edges: Sequence[tuple[int, int]], bodies: Sequence[Sequence[int]]) -> Springs:
    """Return springs of edges, of length 1, and of bodies, whose corners would be regular polygons of sides 1.

    >>> springs_of([(0, 1)], [(1, 2, 3, 4)]).lengths.round(3).tolist()
    [1.0, 1.0, 1.414, 1.0, 1.0, 1.414, 1.0]
    """
    pairs, lengths, stiffness = [*edges], [1.0] * len(edges), [1.0] * len(edges)
    for body in bodies:
        size = len(body)
        for i in range(size):
            for k in range(i + 1, size):
                pairs.append((body[i], body[k]))
                lengths.append(float(np.sin(np.pi * (k - i) / size) / np.sin(np.pi / size)))
                stiffness.append(2.0)
    return Springs(np.array(pairs, np.int64).reshape(-1, 2), np.array(lengths), np.array(stiffness))


def pulled(
    graph: PlaneGraph, places: Floats, springs: Springs, mirror: Mapping[Node, Node] | None = None
) -> Floats:
    """Return places, float[n, 2] in side lengths, after the nodes moved under forces.

    The drawing has no crossings before, and the same faces and none after. `mirror` is the symmetry of which its
    places are mirror images, upright: that is kept to the last digit, where rounding alone would let what is under
    pressure bend to one side.
    """
    size = np.linalg.norm(places[graph.edges[:, 0]] - places[graph.edges[:, 1]], axis=1).mean()
    here: Floats = places / size
    if len(here) > _LARGE:
        return here
    forces = _Forces(graph, springs)
    image = None if mirror is None else _images(graph, mirror)
    whole = here  # the last drawing whose outer face was found not to cross itself
    for number in range(_ROUNDS):
        longest = 0.2 * (1 - number / _ROUNDS) + 0.005
        move = forces.at(here)
        length = np.sqrt((move**2).sum(axis=1))
        most = np.minimum(longest, _free_way(graph.triangles, here))
        move *= np.minimum(1.0, most / np.maximum(length, 1e-12))[:, None]
        if image is not None:
            move = (move + move[image] * _UPRIGHT) / 2
        here = here + move
        if number % _LOOKS == _LOOKS - 1:
            if _crosses_itself(here[graph.outer]):
                return whole
            whole = here
            if length.max() < _STILL:
                break
    return whole


def _images(graph: PlaneGraph, mirror: Mapping[Node, Node]) -> Ints:
    """Return the number of the image of each node, hubs included."""
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
    """What pulls and pushes the nodes of a graph; sums over nodes are products with matrices made once."""

    def __init__(self, graph: PlaneGraph, springs: Springs) -> None:
        size = len(graph.nodes)
        self._graph, self._springs, self._own = graph, springs, graph.own
        self._spans = _differences(springs.pairs, size)
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
        pull = _SPRING * self._springs.stiffness * (1 - self._springs.lengths / length)
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
        push = np.minimum(_OPEN * np.maximum(1 / height - 1 / _LOW, 0.0), 1.0) / length
        inward = np.stack([-opposite[:, :, 1], opposite[:, :, 0]], axis=2) * push[:, :, None]
        np.add.at(force, triangles, inward - np.roll(inward, 1, axis=1) / 2 - np.roll(inward, 2, axis=1) / 2)


def _differences(pairs: Ints, size: int) -> Floats:
    """Return the matrix that takes places to the vectors from the first of each pair to the second."""
    matrix = np.zeros((len(pairs), size))
    rows = np.arange(len(pairs))
    matrix[rows, pairs[:, 1]] = 1
    matrix[rows, pairs[:, 0]] = -1
    return matrix


def _free_way(triangles: Ints, here: Floats) -> Floats:
    """Return how far each node may go so that no triangle is turned over, wherever the others go: float[n].

    A triangle keeps its sense while no corner moves half its least height.
    """
    corners = here[triangles]
    sides = np.roll(corners, -1, axis=1) - corners
    twice_area = np.abs(sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0])
    height = twice_area / np.sqrt((sides**2).sum(axis=2).max(axis=1))
    way = np.full(len(here), np.inf)
    np.minimum.at(way, triangles, height[:, None])
    return _OF_HEIGHT * way


def _crosses_itself(ring: Floats) -> bool:
    """Whether two sides of a polygon that have no corner in common meet."""
    ends = np.roll(ring, -1, axis=0)
    sides = _turn(ring[:, None], ends[:, None], ring[None]) * _turn(ring[:, None], ends[:, None], ends[None])
    crossed: Flags = (sides <= 0) & (sides.T <= 0)
    count = len(ring)
    step = (np.arange(count)[:, None] - np.arange(count)[None]) % count
    crossed &= (step > 1) & (step < count - 1)
    return bool(crossed.any())


def _turn(a: Floats, b: Floats, c: Floats) -> Floats:
    turn: Floats = (b[..., 0] - a[..., 0]) * (c[..., 1] - a[..., 1]) - (b[..., 1] - a[..., 1]) * (
        c[..., 0] - a[..., 0]
    )
    return turn
