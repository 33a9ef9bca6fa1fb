"""From the lines of a planar crease pattern to its vertices, edges and faces.

Lines cross, meet in the middle of each other, stop short, and come twice. They are welded by a tolerance, split
where they meet, and the faces are walked round. Theory: docs/theory/crease-patterns.md.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from graphs.convert.welding import Lines, Network, either_way, networks_of
from graphs.errors import InvariantError, numbered
from graphs.geometry import signed_area
from graphs.mechanism.sheet import HINGES, Edge, Reading, Repair, RepairKind, Sheet, sides_of_face
from graphs.types import Floats

__all__ = ["MOST", "TOLERANCES", "trace_sheet"]

TOLERANCES = (1e-6, 1e-5, 1e-4, 3e-4, 6e-4, 1e-3, 2e-3)
"""Welding tolerances that are tried, in units of the size of the pattern."""

MOST = 1e12
"""Largest coordinate that is traced: products of four of them stay finite."""

_WHAT: Mapping[RepairKind, tuple[str, str]] = {
    "crossing split": ("crossing split", "crossings split"),
    "line split at an end": ("end on a line: the line split", "ends on a line: the line split"),
    "line drawn twice": ("line drawn twice", "lines drawn twice"),
    "line of no length": ("line of no length dropped", "lines of no length dropped"),
    "line pruned": ("line that ends nowhere pruned", "lines that end nowhere pruned"),
    "vertex taken out": ("vertex in the middle of a line removed", "vertices in the middle of a line removed"),
}
"""Repairs that are counted, in words for one and for several."""


def trace_sheet(lines: Lines, *, title: str = "", tolerance: float | None = None) -> Sheet:
    """Return the sheet that lines draw.

    Parameters
    ----------
    lines : Lines
    title : str, optional
    tolerance : float, optional
        Ends closer than this, in units of the size of the pattern, are one. Without it the tolerances of
        ``TOLERANCES`` are tried; see Notes.

    Returns
    -------
    Sheet
        With its repairs: crossings split, ends welded, lines pruned that end nowhere.

    Raises
    ------
    InvariantError
        If there is no line.

    Notes
    -----
    Without a tolerance the lines are welded at each of ``TOLERANCES``, and one network is chosen:

    1. Those in which the fewest lines end nowhere;
    2. of those, the ones with the most frequent number of edges less vertices: of faces, but for the parts.
    3. A vertex split in two by a short edge leaves that number as it is. So of those the ones that show the fewest
       signs of split vertices: edges shorter than the coarsest tolerance, and bends, vertices of two creases only;
    4. of those, the ones with the most frequent number of vertices;
    5. of those, the one whose tolerance lies farthest below its shortest edge.

    If a face of it comes back to a vertex, which no panel does, the networks of which that is true are left out,
    with those finer than the finest in 1, and the choice is made again.

    Examples
    --------
    A square with both its diagonals:

    >>> corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> ends = [(corners[i - 1], corners[i]) for i in range(4)]
    >>> ends += [(corners[0], corners[2]), (corners[1], corners[3])]
    >>> sheet = trace_sheet(Lines(np.array(ends, dtype=float), "BBBBMV"))
    >>> sheet.vertices, len(sheet.edges), len(sheet.faces), sheet.repairs
    (5, 8, 4, ('1 crossing split',))
    """
    if not len(lines.letters) or not lines.size:
        raise InvariantError("lines", "the pattern has no line of any length", "lines")
    tried = [t * lines.size for t in ([tolerance] if tolerance else TOLERANCES)]
    traced = [_Traced(network) for network in networks_of(lines, tried)]
    chosen = _standing(traced, TOLERANCES[-1] * lines.size)
    network = chosen.network
    repairs = [
        Repair(kind, numbered(len(places), *_WHAT[kind]), tuple(places))
        for kind, places in sorted(network.repairs.items(), key=lambda item: _WHAT[item[0]])
    ]
    finest = TOLERANCES[0] * lines.size
    if network.tolerance > 2 * finest:
        far = np.unique(network.gathered[network.gathered[:, 2] > finest, :2], axis=0)
        what = f"ends welded within {network.tolerance / lines.size:.0e} of the size"
        repairs.append(Repair("ends welded", what, tuple(((float(x), float(y)),) for x, y in far)))
    if chosen.holes:
        what = f"{numbered(len(chosen.holes), 'face')} with borders all round taken as holes"
        rows = (network.points[list(hole)].tolist() for hole in chosen.holes)
        repairs.append(Repair("hole", what, tuple(tuple((x, y) for x, y in row) for row in rows)))
    return _sheet(network, chosen.faces, title, Reading(tuple(repairs)))


@dataclass(frozen=True)
class _Traced:
    """A network, and what is seen of it only when it is walked round."""

    network: Network

    @cached_property
    def _all_faces(self) -> list[tuple[int, ...]]:
        return _faces(self.network)

    @cached_property
    def faces(self) -> list[tuple[int, ...]]:
        """The faces but for holes."""
        return _without_holes(self._all_faces, self.network.edges)

    @property
    def holes(self) -> list[tuple[int, ...]]:
        """The faces that are holes."""
        left = set(self.faces)
        return [face for face in self._all_faces if face not in left]

    @property
    def simple(self) -> bool:
        """Whether no face comes back to a vertex."""
        return all(len(set(face)) == len(face) for face in self.faces)

    @cached_property
    def vertices(self) -> int:
        """How many vertices have edges."""
        return len({v for edge in self.network.edges for v in edge})

    @property
    def surplus(self) -> int:
        """Edges less vertices, which is the number of faces but for the parts."""
        return len(self.network.edges) - self.vertices

    @cached_property
    def lengths(self) -> Floats:
        """The length of each edge."""
        if not self.network.edges:
            return np.zeros(0)
        ends = self.network.points[np.array(list(self.network.edges))]
        lengths: Floats = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        return lengths

    @property
    def gap(self) -> float:
        """How much longer the shortest edge is than the tolerance."""
        return float(self.lengths.min(initial=np.inf)) / self.network.tolerance

    def signs_of_splits(self, short: float) -> int:
        """Return how many edges are short, and how many vertices have two creases and nothing else."""
        at: dict[int, list[str]] = defaultdict(list)
        for edge, letter in self.network.edges.items():
            for vertex in edge:
                at[vertex].append(letter)
        bends = sum(len(letters) == 2 and set(letters) <= set(HINGES) for letters in at.values())
        return bends + int((self.lengths < short).sum())


def _standing(traced: Sequence[_Traced], short: float) -> _Traced:
    """Choose the network that stands, of some in the order of their tolerances: see :func:`trace_sheet`."""
    chosen = _stablest(traced, short)
    if chosen.simple:
        return chosen
    dangling = [one.network.dangling for one in traced]
    able = traced[dangling.index(min(dangling)) :]
    simple = [one for one in able if one.simple]
    return _stablest(simple, short) if simple else chosen


def _stablest(traced: Sequence[_Traced], short: float) -> _Traced:
    left = _least(traced, lambda one: one.network.dangling)
    left = _commonest(left, lambda one: one.surplus)
    left = _least(left, lambda one: one.signs_of_splits(short))
    left = _commonest(left, lambda one: one.vertices)
    return max(left, key=lambda one: one.gap)


def _least(traced: Sequence[_Traced], number: Callable[[_Traced], int]) -> list[_Traced]:
    numbers = [number(one) for one in traced]
    return [one for one, found in zip(traced, numbers, strict=True) if found == min(numbers)]


def _commonest(traced: Sequence[_Traced], number: Callable[[_Traced], int]) -> list[_Traced]:
    (commonest, _), *_ = Counter(map(number, traced)).most_common(1)
    return [one for one in traced if number(one) == commonest]


def _faces(network: Network) -> list[tuple[int, ...]]:
    """Walk round the faces; those with the outside on their left are left out."""
    around: dict[int, list[int]] = defaultdict(list)
    darts = [dart for a, b in network.edges for dart in ((a, b), (b, a))]
    for a, b in darts:
        around[a].append(b)
    arms = network.points[[b for _, b in darts]] - network.points[[a for a, _ in darts]]
    angle = dict(zip(darts, np.arctan2(arms[:, 1], arms[:, 0]).tolist(), strict=True))
    for vertex, others in around.items():
        others.sort(key=lambda v, here=vertex: angle[here, v])  # type: ignore[misc]
    after = {(vertex, other): others[i - 1] for vertex, others in around.items() for i, other in enumerate(others)}
    faces, seen = [], set()
    for start in after:
        if start in seen:
            continue
        walk, dart = [], start
        while dart not in seen:
            seen.add(dart)
            walk.append(dart[0])
            dart = (dart[1], after[dart[1], dart[0]])
        if signed_area(network.points[walk]) > 0.0:
            faces.append(tuple(walk))
    return faces


def _without_holes(faces: list[tuple[int, ...]], edges: dict[Edge, str]) -> list[tuple[int, ...]]:
    """Drop faces whose every side is a border with another face beyond it."""
    sides = [[either_way(a, b) for a, b in sides_of_face(face)] for face in faces]
    beside = Counter(side for row in sides for side in row)
    return [
        face
        for face, row in zip(faces, sides, strict=True)
        if any(edges[side] not in "BC" or beside[side] < 2 for side in row)
    ]


def _sheet(network: Network, faces: list[tuple[int, ...]], title: str, reading: Reading) -> Sheet:
    used = sorted({v for edge in network.edges for v in edge})
    number = {v: i for i, v in enumerate(used)}
    return Sheet(
        len(used),
        tuple((number[a], number[b]) for a, b in network.edges),
        "".join(network.edges.values()),
        tuple(tuple(number[v] for v in face) for face in faces),
        tuple((float(x), float(y)) for x, y in network.points[used]),
        title,
        tuple(repair.what for repair in reading.repairs),
        None if not any(network.angles.values()) else tuple(network.angles[edge] for edge in network.edges),
        spread=network.spread,
        reading=reading,
    )
