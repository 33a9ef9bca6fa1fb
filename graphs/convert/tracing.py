"""From the lines of a planar crease pattern to its vertices, edges and faces.

Lines are welded by a tolerance (ends that nearly meet become one vertex), split where they meet, loose ends are
pruned, and the faces are walked round. Theory: docs/theory/crease-patterns.md.
"""

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt
import shapely
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from graphs.errors import InvariantError, numbered
from graphs.geometry import signed_area
from graphs.input_limits import check_work
from graphs.mechanism.sheet import HINGES, Edge, Place, Reading, Repair, RepairKind, Sheet, sides_of_face
from graphs.types import Floats

# Part of the tolerance. A crossing computed from two pairs of lines differs by rounding only, far less than this; true
# crossings as near would be welded anyway, and so the list alone gets shorter.
_SAME = 1e-3
# Part of a tolerance. A crossing that stands for others is off by `_SAME`, two ends of a distance twice, and both ways:
# a distance within this of a tolerance may be on either side of it, so that both sides are tried.
_MARGIN = 4 * _SAME
_PIECE = 256  # lines whose meetings are searched at once: a fan has all pairs, a quarter of a million of 512 lines
_RANK = "MVUFJBC"
"""Of two lines in one place the one whose letter comes first here counts."""


@dataclass(frozen=True)
class Lines:
    """Straight lines of a planar pattern.

    `ends`, float[n, 2, 2], are their ends in any unit; `letters` has the assignment of each, as in FOLD, and
    `angles` the fold angle, in radians.
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
class Network:
    """Vertices, float[n, 2], and edges with their assignments, after welding and splitting.

    `tolerance` is the length within which ends were welded, `spread` the root mean square of how far ends of one
    vertex were apart; fold angles are in radians. `repairs` has the places of each kind of repair, `gathered`,
    float[m, 3], where ends were moved to and how far; `dangling` counts the lines that ended nowhere.
    """

    points: Floats
    edges: dict[Edge, str]
    tolerance: float
    angles: dict[Edge, float | None] = field(default_factory=dict)
    repairs: dict[RepairKind, list[Place]] = field(default_factory=dict)
    gathered: Floats = field(default_factory=lambda: np.zeros((0, 3)))
    dangling: int = 0
    spread: float = 0.0

    def repaired(self, kind: RepairKind, places: Iterable[Floats]) -> None:
        """Note repairs, each by its points."""
        row = [tuple((float(x), float(y)) for x, y in place) for place in places]
        if row:
            self.repairs[kind] = [*self.repairs.get(kind, []), *row]


def networks_of(lines: Lines, tolerances: Sequence[float]) -> list[Network]:
    """Weld ends, split lines where they meet, prune what ends nowhere, for each tolerance, the finest first.

    Tolerances are in the length unit of the lines; those that weld alike are welded once.
    """
    lines, again = _distinct(lines)
    networks = []
    for group in _alike(lines.ends, tolerances):
        welded = _welded_network(lines, group[0])
        welded.repaired("line drawn twice", again)
        _prune(welded)
        networks += [_straightened(welded, tolerance) for tolerance in group]
    return networks


def _alike(ends: Floats, tolerances: Sequence[float]) -> list[list[float]]:
    """Part tolerances into runs that weld alike: no distance of welding lies between them."""
    groups = [[tolerances[0]]]
    distances = _distances(ends, tolerances[0], tolerances[-1]) if len(tolerances) > 1 else np.empty(0)
    for finer, coarser in pairwise(tolerances):
        between = (distances >= finer * (1 - _MARGIN)) & (distances <= coarser * (1 + _MARGIN))
        if between.any():
            groups.append([])
        groups[-1].append(coarser)
    return groups


def _distances(ends: Floats, finest: float, coarsest: float) -> Floats:
    """Return the distances that welding compares with a tolerance, up to the coarsest.

    These are lengths of lines, and distances of crossings and ends from each other and from lines.
    """
    reach = coarsest * (1 + _MARGIN)
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    ends = ends[lengths > finest * (1 - _MARGIN)]  # the others are dropped whatever the tolerance
    segments = shapely.linestrings(ends)
    meetings, apart = _meeting_points(ends, segments)
    once = _once(meetings[apart > finest], finest)
    check_work("crossings", len(once), "crossings of lines")
    loose = shapely.points(np.unique(np.concatenate([ends.reshape(-1, 2), once]), axis=0))
    one, two = _pairs(shapely.STRtree(loose), loose, predicate="dwithin", distance=reach)
    point, line = shapely.STRtree(segments).query(loose, predicate="dwithin", distance=reach)
    between, off = shapely.distance(loose[one], loose[two]), shapely.distance(loose[point], segments[line])
    return np.concatenate([lengths, apart, between, off])


def _welded_network(lines: Lines, tolerance: float) -> Network:
    """Weld ends, and split lines where they cross and where an end lies on them."""
    long = np.linalg.norm(lines.ends[:, 1] - lines.ends[:, 0], axis=1) > tolerance
    kept = [int(i) for i in np.flatnonzero(long)]
    letters = [lines.letters[i] for i in kept]
    angles = [None if lines.angles is None else lines.angles[i] for i in kept]
    ends = lines.ends[long]
    tree = shapely.STRtree(shapely.linestrings(ends))
    meetings = crossings(ends, tolerance)
    check_work("crossings", len(meetings), "crossings of lines")
    loose = np.concatenate([ends.reshape(-1, 2), meetings])
    points, of_point = _welded(loose, tolerance)
    crossed = sorted(set(of_point[2 * len(ends) :].tolist()) - set(of_point[: 2 * len(ends)].tolist()))
    met, twice = list[int](), list[Edge]()
    at = _points_on_lines(points, ends, tree, tolerance)
    ends_of = of_point[: 2 * len(ends)].reshape(-1, 2)
    edges: dict[Edge, str] = {}
    angle_of: dict[Edge, float | None] = {}
    true_ends = set(map(int, ends_of.ravel()))
    for line, letter in enumerate(letters):
        a, b = map(int, ends_of[line])
        inner = [v for v in at[line] if v not in (a, b)]
        met += [v for v in inner if v in true_ends]
        direction = points[b] - points[a]
        path = [a, *sorted(inner, key=lambda v: float((points[v] - points[a]) @ direction)), b]
        for u, v in pairwise(path):
            if u == v:
                continue
            edge = either_way(u, v)
            before = edges.get(edge)
            if before is not None:
                twice.append(edge)
            if before is None or _RANK.index(letter) < _RANK.index(before):
                edges[edge] = letter
                angle_of[edge] = angles[line]
    moved = (loose - points[of_point])[: 2 * len(ends)]
    apart = np.linalg.norm(moved, axis=1)
    gathered = np.column_stack([points[of_point[: len(moved)]], apart])[apart > 0.0]
    spread = _spread(moved, of_point[: len(moved)])
    network = Network(points, edges, tolerance, angle_of, gathered=gathered, spread=spread)
    network.repaired("line of no length", lines.ends[~long])
    network.repaired("crossing split", points[crossed][:, None])
    network.repaired("line split at an end", points[met][:, None])
    network.repaired("line drawn twice", (points[list(edge)] for edge in twice))
    return network


def _spread(moved: Floats, vertices: npt.NDArray[np.int64]) -> float:
    """Return how far ends that share a vertex with others were moved to it, in the mean."""
    shared = np.bincount(vertices)[vertices] > 1
    return float(np.sqrt((moved[shared] ** 2).sum(axis=1).mean())) if shared.any() else 0.0


def crossings(ends: Floats, tolerance: float) -> Floats:
    """Return the points where two lines, float[n, 2, 2], cross farther than the tolerance from all four ends."""
    meetings, apart = _meeting_points(ends, shapely.linestrings(ends))
    return _once(meetings[apart > tolerance], tolerance)


def _meeting_points(ends: Floats, segments: npt.NDArray[np.object_]) -> tuple[Floats, Floats]:
    """Return where lines meet that are not parallel, and how far that is from the nearest of their ends."""
    one, two = _pairs(shapely.STRtree(segments), segments, predicate="intersects")
    p, r = ends[one, 0], ends[one, 1] - ends[one, 0]
    q, s = ends[two, 0], ends[two, 1] - ends[two, 0]
    area = r[:, 0] * s[:, 1] - r[:, 1] * s[:, 0]
    slanted = np.abs(area) > 1e-12 * np.linalg.norm(r, axis=1) * np.linalg.norm(s, axis=1)
    p, r, q, s, area = p[slanted], r[slanted], q[slanted], s[slanted], area[slanted]
    gap = q - p
    t = (gap[:, 0] * s[:, 1] - gap[:, 1] * s[:, 0]) / area
    meetings: Floats = p + t[:, None] * r
    apart: Floats = np.min([np.linalg.norm(meetings - end, axis=1) for end in (p, p + r, q, q + s)], axis=0)
    return meetings, apart


def _once(meetings: Floats, tolerance: float) -> Floats:
    """Leave one of equal crossings."""
    _, first = np.unique(np.round(meetings / (tolerance * _SAME)), axis=0, return_index=True)
    return meetings[np.sort(first)]


def _welded(points: Floats, tolerance: float) -> tuple[Floats, npt.NDArray[np.int64]]:
    """Return one point for each cluster within a tolerance, the first, and the cluster of each point."""
    geometry = shapely.points(points)
    pairs = _pairs(shapely.STRtree(geometry), geometry, predicate="dwithin", distance=tolerance)
    near = coo_array((np.ones(len(pairs[0]), dtype=np.int8), pairs), shape=(len(points), len(points)))
    _, part = connected_components(near, directed=False)
    _, first, place = np.unique(part, return_index=True, return_inverse=True)
    order = np.argsort(first)  # vertices are numbered as their first points are
    return points[first[order]], np.argsort(order)[place]


def _pairs(
    tree: shapely.STRtree, geometry: npt.NDArray[np.object_], **how: Any
) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """Return the pairs (i < k) of a tree's own members that a query finds, in pieces: they may be too many."""
    pieces, total = [np.empty((2, 0), dtype=np.int64)], 0
    for start in range(0, len(geometry), _PIECE):
        pairs = tree.query(geometry[start : start + _PIECE], **how)
        pairs[0] += start
        pieces.append(pairs[:, pairs[0] < pairs[1]])
        total += pieces[-1].shape[1]
        check_work("meetings", total, "or more pairs of lines that meet, or ends that are near each other")
    one, two = np.concatenate(pieces, axis=1)
    return one, two


def _distinct(lines: Lines) -> tuple[Lines, Floats]:
    """Leave one of lines that are equal, whichever end comes first; return also the ends of those left out."""
    there, back = lines.ends.reshape(-1, 4), lines.ends[:, ::-1].reshape(-1, 4)
    turned = (lines.ends[:, 0] > lines.ends[:, 1])[:, 0] | (
        (lines.ends[:, 0, 0] == lines.ends[:, 1, 0]) & (lines.ends[:, 0, 1] > lines.ends[:, 1, 1])
    )
    _, of_line = np.unique(np.where(turned[:, None], back, there), axis=0, return_inverse=True)
    rank = np.array([_RANK.index(letter) for letter in lines.letters])
    best = np.lexsort((rank, of_line.ravel()))
    first = np.concatenate([[True], np.diff(of_line.ravel()[best]) > 0]) if len(best) else np.empty(0, dtype=bool)
    kept = np.sort(best[first])
    angles = None if lines.angles is None else tuple(lines.angles[i] for i in kept)
    letters = "".join(lines.letters[i] for i in kept)
    return Lines(lines.ends[kept], letters, angles), np.delete(lines.ends, kept, axis=0)


def _points_on_lines(points: Floats, ends: Floats, tree: shapely.STRtree, tolerance: float) -> dict[int, list[int]]:
    """Return, for each line, the points within a tolerance of it."""
    at: dict[int, list[int]] = defaultdict(list)
    which, line = tree.query(shapely.points(points), predicate="dwithin", distance=tolerance)
    for point, one in zip(which.tolist(), line.tolist(), strict=True):
        at[one].append(point)
    return at


def _prune(network: Network) -> None:
    """Take off edges that end nowhere, again and again."""
    at: dict[int, set[Edge]] = defaultdict(set)
    for edge in network.edges:
        for vertex in edge:
            at[vertex].add(edge)
    loose = [vertex for vertex, edges in at.items() if len(edges) == 1]
    pruned = []
    while loose:
        vertex = loose.pop()
        if len(at[vertex]) != 1:
            continue
        (edge,) = at[vertex]
        del network.edges[edge]
        pruned.append(edge)
        for end in edge:
            at[end].discard(edge)
            if len(at[end]) == 1:
                loose.append(end)
    network.dangling = len(pruned)
    network.repaired("line pruned", (network.points[list(edge)] for edge in pruned))


def _straightened(welded: Network, tolerance: float) -> Network:
    """Take out vertices in the middle of a line: two edges of one kind, straight within the tolerance."""
    edges, angles, repairs = dict(welded.edges), dict(welded.angles), dict(welded.repairs)
    network = replace(welded, tolerance=tolerance, edges=edges, angles=angles, repairs=repairs)
    at: dict[int, set[int]] = defaultdict(set)
    for a, b in network.edges:
        at[a].add(b)
        at[b].add(a)
    taken_out: list[int] = []
    for vertex in [v for v, others in at.items() if len(others) == 2]:
        a, b = at[vertex]
        one, two = either_way(a, vertex), either_way(vertex, b)
        if b in at[a] or network.edges[one] != network.edges[two]:
            continue
        chord = network.points[b] - network.points[a]
        along = network.points[vertex] - network.points[a]
        off = abs(chord[0] * along[1] - chord[1] * along[0]) / np.hypot(*chord)
        if off > network.tolerance or not 0 < along @ chord < chord @ chord:
            continue
        network.edges[either_way(a, b)] = network.edges.pop(one)
        network.angles[either_way(a, b)] = network.angles[one]
        del network.edges[two]
        at[a] = at[a] - {vertex} | {b}
        at[b] = at[b] - {vertex} | {a}
        taken_out.append(vertex)
    network.repaired("vertex taken out", network.points[taken_out][:, None])
    return network


def either_way(a: int, b: int) -> Edge:
    """Return an edge as a key, whichever end comes first."""
    return (a, b) if a < b else (b, a)


TOLERANCES = (1e-6, 1e-5, 1e-4, 3e-4, 6e-4, 1e-3, 2e-3)
"""Welding tolerances that are tried, in units of the size of the pattern.

Programs write six digits, so that finer ones weld nothing; the coarsest is a stroke's width of a drawing, where details
begin to vanish. They are closer together where ends drawn by hand lie.
"""

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
    """Return the sheet that lines draw: crossings split, ends welded, lines pruned that end nowhere.

    Parameters
    ----------
    lines : Lines
        InvariantError if there is no line.
    title : str, optional
    tolerance : float, optional
        Ends closer than this, in units of the size of the pattern, are one. Without it the lines are welded at
        each of ``TOLERANCES``, and one network is chosen by the rules of docs/theory/crease-patterns.md.

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
    traced = [_TracedNetwork(network) for network in networks_of(lines, tried)]
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
class _TracedNetwork:
    """A network with its faces, which are walked round when they are first needed."""

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

    @cached_property
    def lengths(self) -> Floats:
        """The length of each edge."""
        ends = self.network.points[np.array(list(self.network.edges), dtype=int).reshape(-1, 2)]
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


def _standing(traced: Sequence[_TracedNetwork], short: float) -> _TracedNetwork:
    """Choose one of the networks, which are in the order of their tolerances.

    If a face of it comes back to a vertex, which no panel does, the networks of which that is true are left out,
    with those finer than the finest in which the fewest lines end nowhere, and the choice is made again.
    """
    chosen = _stablest(traced, short)
    if chosen.simple:
        return chosen
    dangling = [candidate.network.dangling for candidate in traced]
    coarse_enough = traced[dangling.index(min(dangling)) :]
    simple = [candidate for candidate in coarse_enough if candidate.simple]
    return _stablest(simple, short) if simple else chosen


def _stablest(traced: Sequence[_TracedNetwork], short: float) -> _TracedNetwork:
    left = _least(traced, lambda candidate: candidate.network.dangling)
    # edges less vertices are the number of faces, but for the parts
    left = _commonest(left, lambda candidate: len(candidate.network.edges) - candidate.vertices)
    left = _least(left, lambda candidate: candidate.signs_of_splits(short))
    left = _commonest(left, lambda candidate: candidate.vertices)
    return max(left, key=lambda candidate: candidate.gap)


def _least(traced: Sequence[_TracedNetwork], number: Callable[[_TracedNetwork], int]) -> list[_TracedNetwork]:
    least = min(map(number, traced))
    return [candidate for candidate in traced if number(candidate) == least]


def _commonest(traced: Sequence[_TracedNetwork], number: Callable[[_TracedNetwork], int]) -> list[_TracedNetwork]:
    (commonest, _), *_ = Counter(map(number, traced)).most_common(1)
    return [candidate for candidate in traced if number(candidate) == commonest]


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
