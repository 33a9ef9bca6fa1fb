"""Rods that share their ends, as a linkage of hinges: polyhedron models that do not say what their links are.

A rod may turn about itself, which says nothing of the model. So the rods are joined along a tree, and there each
has just the hinges that its direction needs: two where it meets the rod before it, across it and each other, one
where that is the first of all, whose own turning is that of the whole. Where rods meet beside the tree, three
hinges stand for the ball between them. So the freedoms are those of the model: 3 V - 6 less what is idle.
Theory: docs/theory/moving.md.
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field
from typing import Any

import networkx as nx
import numpy as np

from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.geometry import frame_about, unit
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.precision import precision_of
from graphs.mechanism.sc import SCGraph
from graphs.tolerances import Tolerances, leading
from graphs.types import Floats
from synth.motion.linkage import PosedLinkage, linkage_of_axes

__all__ = ["linkage_of_rods"]


@dataclass
class _Hinges:
    """Links and hinges as they are added."""

    links: list[Hashable]
    joints: dict[Hashable, tuple[Hashable, Hashable]] = field(default_factory=dict)
    axes: dict[Hashable, tuple[list[float], list[float]]] = field(default_factory=dict)

    def join(self, first: int, second: int, point: Floats, directions: Floats) -> None:
        """Join two rods at a point, by hinges one after the other; small bodies lie between these."""
        name = f"{first}-{second}"
        between: list[Hashable] = [f"{name}.{number}" for number in range(1, len(directions))]
        self.links += between
        ends = [first, *between, second]
        for number, direction in enumerate(directions):
            joint = name if len(directions) == 1 else f"{name}.{'abc'[number]}"
            self.joints[joint] = (ends[number], ends[number + 1])
            self.axes[joint] = (point.tolist(), direction.tolist())


def linkage_of_rods(model: PolyhedronModel) -> PosedLinkage:
    """Return the linkage of hinges that moves as the rods of a polyhedron model do.

    Parameters
    ----------
    model : PolyhedronModel
        With coordinates; rods only.

    Returns
    -------
    PosedLinkage
        Links are the rods, by their place in the list of rods, and bodies between hinges.

    Raises
    ------
    UnsolvableError
        If it has no coordinates, more than rods, or comes in several parts.
    InvariantError
        If a rod has no length.

    Examples
    --------
    A square of four rods, in the plane: a hinge of it folds out of the plane.

    >>> corners = {0: (0, 0, 0), 1: (1, 0, 0), 2: (1, 1, 0), 3: (0, 1, 0)}
    >>> square = PolyhedronModel(4, [(0, 1), (1, 2), (2, 3), (3, 0)], coordinates=corners)
    >>> linkage = linkage_of_rods(square)
    >>> from synth.motion.closure import ClosureEquations
    >>> closure = ClosureEquations(linkage)
    >>> closure.joints - closure.rows  # one freedom in the plane, one out of it
    2
    """
    _check_only_rods(model)
    rods = list(model.edges)
    ends = np.array([[model.coordinates[v] for v in rod] for rod in rods], dtype=float)
    directions = _directions(rods, ends)
    tolerances = Tolerances.of(precision_of(list(model.coordinates.values())).size)
    hinges = _Hinges(list(range(len(rods))))
    meetings = _meetings(model, rods)
    tree = _tree(meetings, directions, tolerances.parallel)
    for first, second, vertex in tree:
        across = _across(directions[first], directions[second], tolerances.parallel)
        hinges.join(first, second, _at(model, vertex), across[:1] if not hinges.joints else across)
    for first, second, vertex in _others(meetings, tree):
        hinges.join(first, second, _at(model, vertex), np.eye(3))
    return linkage_of_axes(SCGraph(hinges.links, hinges.joints), hinges.axes)


def _check_only_rods(model: PolyhedronModel) -> None:
    if not model.coordinates:
        raise UnsolvableError(f"to move needs coordinates, and {model!r} has none")
    more = {
        "remote centres": model.centres,
        "points on lines": model.on_line,
        "points on planes": model.on_plane,
        "scissors": model.scissors,
        "a ground link": model.ground,
    }
    found = [name for name, here in more.items() if here]
    if found:
        raise UnsolvableError(f"the polyhedron model has {' and '.join(found)}: expected rods only")
    if len(model) > 1 and not nx.is_connected(model):
        raise UnsolvableError("the polyhedron model comes in several parts: expected one")
    if not model.number_of_edges():
        raise UnsolvableError("the polyhedron model has no rods: nothing moves")


def _directions(rods: list[tuple[Any, Any]], ends: Floats) -> Floats:
    """Return the unit vectors along rods: float[rods, 3]."""
    along = ends[:, 1] - ends[:, 0]
    sizes = np.abs(along).max(axis=1)
    for rod in np.flatnonzero(sizes == 0.0):
        raise InvariantError("rod", f"the rod between vertices {shown(rods[rod])} has no length")
    return unit(along / sizes[:, None])


def _meetings(model: PolyhedronModel, rods: list[tuple[Any, Any]]) -> dict[Hashable, list[int]]:
    """Return the rods at each vertex."""
    meetings: dict[Hashable, list[int]] = {vertex: [] for vertex in model.nodes}
    for number, (a, b) in enumerate(rods):
        meetings[a].append(number)
        meetings[b].append(number)
    return meetings


def _tree(
    meetings: dict[Hashable, list[int]], directions: Floats, parallel: float
) -> list[tuple[int, int, Hashable]]:
    """Return a tree of the rods, (rod, next rod, vertex) from the first; the first two are not in line."""
    touching = nx.Graph()
    touching.add_nodes_from(range(len(directions)))
    for vertex, here in meetings.items():
        for place, first in enumerate(here):
            touching.add_edges_from((first, second, {"vertex": vertex}) for second in here[place + 1 :])
    root, turn = _beginning(touching, directions, parallel)
    order = [(root, turn), *nx.bfs_edges(touching, root)] if turn is not None else []
    seen, tree = {root}, []
    for first, second in order:
        if second not in seen:
            seen.add(second)
            tree.append((first, second, touching[first][second]["vertex"]))
    return tree


def _beginning(touching: nx.Graph, directions: Floats, parallel: float) -> tuple[int, int | None]:
    """Return two rods that meet, at the largest angle there is; None for the second if there is but one rod."""
    if len(directions) == 1:
        return 0, None
    pairs = list(touching.edges)
    ends = np.array(pairs).T
    sines = np.linalg.norm(np.cross(directions[ends[0]], directions[ends[1]]), axis=1)
    best = leading(sines)
    if sines[best] <= parallel:
        raise UnsolvableError("all rods are in line: their plane is not known")
    first, second = pairs[best]
    return int(first), int(second)


def _others(
    meetings: dict[Hashable, list[int]], tree: list[tuple[int, int, Hashable]]
) -> list[tuple[int, int, Hashable]]:
    """Return the meetings that the tree leaves out: at each vertex all rods are joined, without circles."""
    left = []
    for vertex, here in meetings.items():
        joined = nx.Graph([(a, b) for a, b, at in tree if at == vertex])
        joined.add_nodes_from(here)
        parts = [min(part) for part in nx.connected_components(joined)]
        left += [(parts[0], other, vertex) for other in parts[1:]]
    return left


def _across(first: Floats, second: Floats, parallel: float) -> Floats:
    """Return two directions across a rod: that across the rod before it too, if they are not in line, first."""
    normal = np.cross(first, second)
    if np.linalg.norm(normal) <= parallel:
        return frame_about(second)[:2]
    return np.stack([unit(normal), np.cross(second, unit(normal))])


def _at(model: PolyhedronModel, vertex: Hashable) -> Floats:
    return np.array(model.coordinates[vertex], dtype=float)
