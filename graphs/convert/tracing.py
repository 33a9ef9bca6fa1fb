"""From the lines of a planar crease pattern to its vertices, edges and faces.

Lines cross, meet in the middle of each other, stop short, and come twice. They are welded by a tolerance, split
where they meet, and the faces are walked round. Theory: docs/theory/crease-patterns.md.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from math import atan2

import networkx as nx
import numpy as np
import numpy.typing as npt
import shapely

from graphs.arrays import Floats
from graphs.errors import InvariantError
from graphs.mechanism.sheet import Edge, Sheet, sides_of_face

__all__ = ["MOST", "TOLERANCES", "Lines", "trace_sheet"]

TOLERANCES = (1e-6, 1e-5, 1e-4, 3e-4, 6e-4, 1e-3, 2e-3)
"""Welding tolerances that are tried, in units of the size of the pattern."""

MOST = 1e12
"""Largest coordinate that is traced: products of four of them stay finite."""

_RANK = "MVUFJBC"
"""Of two lines in one place the one whose letter comes first here counts."""


@dataclass(frozen=True)
class Lines:
    """Straight lines of a planar pattern.

    Attributes
    ----------
    ends : array of shape (n, 2, 2)
        Both ends of each line; any length unit.
    letters : str
        The assignment of each, as in FOLD.
    angles : tuple of float or None, optional
        The fold angle of each, in degrees as in files.
    """

    ends: Floats
    letters: str
    angles: tuple[float | None, ...] | None = None

    def __post_init__(self) -> None:
        if self.ends.shape != (len(self.letters), 2, 2):
            raise InvariantError("lines", f"{len(self.letters)} letters for ends of shape {self.ends.shape}")

    @property
    def size(self) -> float:
        """The larger side of the box round the pattern."""
        points = self.ends.reshape(-1, 2)
        return float(np.ptp(points, axis=0).max()) if len(points) else 0.0


@dataclass
class _Network:
    """Vertices and edges, after welding and splitting."""

    points: Floats
    edges: dict[Edge, str]
    tolerance: float
    angles: dict[Edge, float | None] = field(default_factory=dict)
    notes: Counter[str] = field(default_factory=Counter)
    dangling: int = 0


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
    Of the tolerances at which the fewest lines end nowhere, those count that give the most frequent number of
    faces; of these the one is taken that lies farthest below the shortest edge it leaves.

    Examples
    --------
    A square with both its diagonals:

    >>> corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> ends = [(corners[i - 1], corners[i]) for i in range(4)]
    >>> ends += [(corners[0], corners[2]), (corners[1], corners[3])]
    >>> sheet = trace_sheet(Lines(np.array(ends, dtype=float), "BBBBMV"))
    >>> sheet.vertices, len(sheet.edges), len(sheet.faces), sheet.repairs
    (5, 8, 4, ('1 crossing(s) split',))
    """
    if not len(lines.letters) or not lines.size:
        raise InvariantError("lines", "the pattern has no line of any length", "lines")
    networks = [_network(lines, t * lines.size) for t in ([tolerance] if tolerance else TOLERANCES)]
    network = _plateau(networks)
    faces = _faces(network)
    notes = [f"{number} {what}" for what, number in sorted(network.notes.items()) if number]
    if network.tolerance > 2 * TOLERANCES[0] * lines.size:
        notes.append(f"ends welded within {network.tolerance / lines.size:.0e} of the size")
    faces, holes = _without_holes(faces, network.edges)
    if holes:
        notes.append(f"{holes} face(s) with borders all round taken as holes")
    return _sheet(network, faces, title, tuple(notes))


def _plateau(networks: Sequence[_Network]) -> _Network:
    """Choose the network of the tolerance that stands: see the notes of :func:`trace_sheet`."""
    fewest = min(network.dangling for network in networks)
    able = [network for network in networks if network.dangling == fewest]
    (faces, _), *_ = Counter(map(_surplus, able)).most_common(1)
    return max((network for network in able if _surplus(network) == faces), key=_gap)


def _surplus(network: _Network) -> int:
    """Return edges less vertices, which is the number of faces but for the parts."""
    return len(network.edges) - len({v for edge in network.edges for v in edge})


def _gap(network: _Network) -> float:
    """Return how much longer the shortest edge is than the tolerance."""
    if not network.edges:
        return 0.0
    ends = network.points[np.array(list(network.edges))]
    return float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).min()) / network.tolerance


def _network(lines: Lines, tolerance: float) -> _Network:
    """Weld ends, split lines where they cross and where an end lies on them, prune what ends nowhere."""
    long = np.linalg.norm(lines.ends[:, 1] - lines.ends[:, 0], axis=1) > tolerance
    kept = [int(i) for i in np.flatnonzero(long)]
    letters = [lines.letters[i] for i in kept]
    angles = [None if lines.angles is None else lines.angles[i] for i in kept]
    notes = Counter({"line(s) of no length dropped": int((~long).sum())})
    ends = lines.ends[long]
    segments = shapely.linestrings(ends)
    tree = shapely.STRtree(segments)
    crossings = _crossings(ends, tree, segments, tolerance)
    points, of_point = _welded(np.concatenate([ends.reshape(-1, 2), crossings]), tolerance)
    notes["crossing(s) split"] = len(set(of_point[2 * len(ends) :]) - set(of_point[: 2 * len(ends)]))
    at = _points_on_lines(points, ends, tree, tolerance)
    ends_of = of_point[: 2 * len(ends)].reshape(-1, 2)
    edges: dict[Edge, str] = {}
    angle_of: dict[Edge, float | None] = {}
    true_ends = set(map(int, ends_of.ravel()))
    for line, letter in enumerate(letters):
        a, b = map(int, ends_of[line])
        inner = [v for v in at[line] if v not in (a, b)]
        notes["end(s) on a line: the line split"] += sum(v in true_ends for v in inner)
        direction = points[b] - points[a]
        path = [a, *sorted(inner, key=lambda v: float((points[v] - points[a]) @ direction)), b]
        for u, v in pairwise(path):
            if u == v:
                continue
            edge = _key(u, v)
            before = edges.get(edge)
            if before is not None:
                notes["line(s) drawn twice"] += 1
            if before is None or _RANK.index(letter) < _RANK.index(before):
                edges[edge] = letter
                angle_of[edge] = angles[line]
    network = _Network(points, edges, tolerance, angle_of, notes)
    _prune(network)
    _straighten(network)
    return network


def _crossings(ends: Floats, tree: shapely.STRtree, segments: npt.NDArray[np.object_], tolerance: float) -> Floats:
    """Return the points where two lines cross away from all four ends."""
    one, two = tree.query(segments, predicate="intersects")
    one, two = one[one < two], two[one < two]
    p, r = ends[one, 0], ends[one, 1] - ends[one, 0]
    q, s = ends[two, 0], ends[two, 1] - ends[two, 0]
    area = r[:, 0] * s[:, 1] - r[:, 1] * s[:, 0]
    slanted = np.abs(area) > 1e-12 * np.linalg.norm(r, axis=1) * np.linalg.norm(s, axis=1)
    p, r, q, s, area = p[slanted], r[slanted], q[slanted], s[slanted], area[slanted]
    gap = q - p
    t = (gap[:, 0] * s[:, 1] - gap[:, 1] * s[:, 0]) / area
    found: Floats = p + t[:, None] * r
    away = np.ones(len(found), dtype=bool)
    for end in (p, p + r, q, q + s):
        away &= np.linalg.norm(found - end, axis=1) > tolerance
    return found[away]


def _welded(points: Floats, tolerance: float) -> tuple[Floats, npt.NDArray[np.int64]]:
    """Make points that hang together within a tolerance one, at the place of the first; return which is which."""
    geometry = shapely.points(points)
    one, two = shapely.STRtree(geometry).query(geometry, predicate="dwithin", distance=tolerance)
    parts = nx.utils.UnionFind(range(len(points)))
    for a, b in zip(one[one < two].tolist(), two[one < two].tolist(), strict=True):
        parts.union(a, b)
    number: dict[int, int] = {}
    place = np.array([number.setdefault(parts[i], len(number)) for i in range(len(points))], dtype=np.int64)
    first = np.full(len(number), len(points))
    np.minimum.at(first, place, np.arange(len(points)))
    return points[first], place


def _points_on_lines(
    points: Floats, ends: Floats, tree: shapely.STRtree, tolerance: float
) -> dict[int, list[int]]:
    """Return, for each line, the points within a tolerance of it."""
    at: dict[int, list[int]] = defaultdict(list)
    which, line = tree.query(shapely.points(points), predicate="dwithin", distance=tolerance)
    for point, one in zip(which.tolist(), line.tolist(), strict=True):
        at[one].append(point)
    return at


def _prune(network: _Network) -> None:
    """Take off edges that end nowhere, again and again."""
    at: dict[int, set[Edge]] = defaultdict(set)
    for edge in network.edges:
        for vertex in edge:
            at[vertex].add(edge)
    loose = [vertex for vertex, edges in at.items() if len(edges) == 1]
    while loose:
        vertex = loose.pop()
        if len(at[vertex]) != 1:
            continue
        (edge,) = at[vertex]
        del network.edges[edge]
        network.dangling += 1
        for end in edge:
            at[end].discard(edge)
            if len(at[end]) == 1:
                loose.append(end)
    network.notes["line(s) that end nowhere pruned"] = network.dangling


def _straighten(network: _Network) -> None:
    """Take out vertices in the middle of a line: two edges of one kind, straight within the tolerance.

    They are left where an end was welded to a line that it only touches, or where two ends were.
    """
    at: dict[int, set[int]] = defaultdict(set)
    for a, b in network.edges:
        at[a].add(b)
        at[b].add(a)
    for vertex in [v for v, others in at.items() if len(others) == 2]:
        a, b = at[vertex]
        one, two = _key(a, vertex), _key(vertex, b)
        if b in at[a] or network.edges[one] != network.edges[two]:
            continue
        chord = network.points[b] - network.points[a]
        along = network.points[vertex] - network.points[a]
        off = abs(chord[0] * along[1] - chord[1] * along[0]) / np.hypot(*chord)
        if off > network.tolerance or not 0 < along @ chord < chord @ chord:
            continue
        network.edges[_key(a, b)] = network.edges.pop(one)
        network.angles[_key(a, b)] = network.angles[one]
        del network.edges[two]
        at[a] = at[a] - {vertex} | {b}
        at[b] = at[b] - {vertex} | {a}
        network.notes["vertex(es) in the middle of a line taken out"] += 1


def _key(a: int, b: int) -> Edge:
    return (a, b) if a < b else (b, a)


def _faces(network: _Network) -> list[tuple[int, ...]]:
    """Walk round the faces; those with the outside on their left are left out."""
    around: dict[int, list[int]] = defaultdict(list)
    for a, b in network.edges:
        around[a].append(b)
        around[b].append(a)
    for vertex, others in around.items():
        here = network.points[vertex]
        others.sort(key=lambda v, here=here: atan2(*(network.points[v] - here)[::-1]))  # type: ignore[misc]
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
        x, y = network.points[walk].T
        if np.dot(x, np.roll(y, -1)) > np.dot(y, np.roll(x, -1)):
            faces.append(tuple(walk))
    return faces


def _without_holes(faces: list[tuple[int, ...]], edges: dict[Edge, str]) -> tuple[list[tuple[int, ...]], int]:
    """Drop faces whose every side is a border with another face beyond it."""
    sides = [[_key(a, b) for a, b in sides_of_face(face)] for face in faces]
    beside = Counter(side for row in sides for side in row)
    kept = [
        face
        for face, row in zip(faces, sides, strict=True)
        if any(edges[side] not in "BC" or beside[side] < 2 for side in row)
    ]
    return kept, len(faces) - len(kept)


def _sheet(network: _Network, faces: list[tuple[int, ...]], title: str, notes: tuple[str, ...]) -> Sheet:
    used = sorted({v for edge in network.edges for v in edge})
    number = {v: i for i, v in enumerate(used)}
    return Sheet(
        len(used),
        tuple((number[a], number[b]) for a, b in network.edges),
        "".join(network.edges.values()),
        tuple(tuple(number[v] for v in face) for face in faces),
        tuple((float(x), float(y)) for x, y in network.points[used]),
        title,
        notes,
        None if not any(network.angles.values()) else tuple(network.angles[edge] for edge in network.edges),
    )
