"""Which loops of a linkage are spherical or planar, by the axes of its joints.

Theory: docs/theory/moving.md.
"""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from itertools import combinations

import networkx as nx
import numpy as np

from graphs.geometry import lines_meet, unit
from graphs.loops.loop import Centre, Loop, added_independent
from graphs.mechanism.precision import extent_of
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import Axis
from graphs.tolerances import Tolerances
from graphs.types import Floats, JointId, LinkId

# Sine of the angle between two axes. Errors of directions move their common point by 1 / sine: below this, fifty times,
# other axes through it would be missed, or others taken for them.
_ACROSS = 0.02
_MOST = 40  # joints about one centre whose shortest cycles are listed: there may be 2^40 cycles, and any basis is right


def centred_by_axes(
    chain: SCGraph, axes: Mapping[JointId, Axis], precision: float, slides: Collection[JointId] = ()
) -> SCGraph:
    """Return the chain with a centre for each loop whose axes meet in a point, or are parallel, as drawn.

    Loops that have a centre keep it. Cycles of joints about one point, or of parallel ones and of slides across them,
    come next, and complete a basis together with what is left. The precision is that of coordinates, in extents.
    """
    if not chain.independent_loops or len(chain.centred_loops) == chain.independent_loops:
        return chain
    names = [joint for joint in chain.joints if joint in axes]
    points = np.array([axes[joint][0] for joint in names], dtype=float).reshape(-1, 3)
    points = (points - points.mean(axis=0)) / (extent_of(points) or 1.0)
    directions = unit(np.array([axes[joint][1] for joint in names], dtype=float).reshape(-1, 3))
    lines = _Lines(chain, names, points, directions, frozenset(slides), Tolerances.of(precision).meant)
    declared = [loop for loop in chain.loops if loop.has_centre]
    candidates = [loop for loop in lines.loops() if lines.centre(loop.joints) is loop.centre]
    candidates.sort(key=lambda loop: len(loop.joints))
    chosen = added_independent([loop.joints for loop in declared], [loop.joints for loop in candidates])
    found = [*declared, *(candidates[place] for place in chosen)]
    if len(found) == len(declared):
        return chain
    others = [loop for loop in chain.loops if not loop.has_centre]
    found += [others[k] for k in added_independent([one.joints for one in found], [one.joints for one in others])]
    return SCGraph(chain.nodes, chain.joints, found, closing=chain.closing, ground=chain.ground, special=chain.special)


class _Lines:
    """Joints, their axes, and which of them meet."""

    def __init__(
        self, chain: SCGraph, names: Sequence[JointId], points: Floats, directions: Floats,
        slides: frozenset[JointId], meant: float,
    ) -> None:  # fmt: skip
        self._chain, self._names, self._slides = chain, names, slides
        self._points, self._directions, self._meant = points, directions, meant
        self._place = {joint: place for place, joint in enumerate(names)}
        self._at: dict[LinkId, list[int]] = {}
        for place, joint in enumerate(names):
            for link in chain.joints[joint]:
                self._at.setdefault(link, []).append(place)

    def loops(self) -> Iterator[Loop]:
        for joints in self._parallel():
            yield from self._cycles(joints, Centre.INFINITE)
        for joints in self._meeting():
            yield from self._cycles(joints, Centre.FINITE)

    def centre(self, joints: Iterable[JointId]) -> Centre:
        """Return the centre about which joints move links."""
        places = np.array([self._place[joint] for joint in joints])
        turns = np.array([self._names[place] not in self._slides for place in places])
        if not turns.any():
            return Centre.NONE
        axes, along = self._directions[places[turns]], self._directions[places[~turns]]
        off = max(np.abs(np.cross(axes, axes[0])).max(), np.abs(along @ axes[0]).max(initial=0.0))
        if off <= self._meant:
            return Centre.INFINITE
        meet = turns.all() and float(lines_meet(self._points[places], axes).off.max()) <= self._meant
        return Centre.FINITE if meet else Centre.NONE

    def _parallel(self) -> Iterator[list[JointId]]:
        """Yield the joints that turn about each direction, with those that slide across it."""
        turning = [place for place, joint in enumerate(self._names) if joint not in self._slides]
        sliding = [place for place, joint in enumerate(self._names) if joint in self._slides]
        if not turning:
            return
        both = np.concatenate([self._directions[turning], -self._directions[turning]])
        for part in _near(both, self._meant):
            if part.min() < len(turning):
                members = sorted({turning[place % len(turning)] for place in part.tolist()})
                normal = both[part.min()]
                members += [place for place in sliding if abs(self._directions[place] @ normal) <= self._meant]
                yield [self._names[place] for place in members]

    def _meeting(self) -> Iterator[list[JointId]]:
        """Yield the joints whose axes pass through a point in which two of one link meet."""
        pairs = [
            pair
            for places in self._at.values()
            for pair in combinations([place for place in places if self._names[place] not in self._slides], 2)
        ]
        if not pairs:
            return
        ends = np.array(sorted(set(pairs)))
        clear = np.linalg.norm(np.cross(*self._directions[ends.T]), axis=1) > _ACROSS
        ends = ends[clear]
        if not len(ends):
            return
        met = lines_meet(self._points[ends], self._directions[ends])
        near = met.off.max(axis=1) <= self._meant
        ends, places = ends[near], met.point[near]
        for part in _near(places, self._meant / _ACROSS):
            yield [self._names[place] for place in np.unique(ends[part]).tolist()]

    def _cycles(self, joints: Sequence[JointId], centre: Centre) -> Iterator[Loop]:
        """Yield a basis of the cycles of some joints: the shortest ones, where these joints are few."""
        ends = {joint: self._chain.joints[joint] for joint in joints}
        number: dict[LinkId, int] = {}
        about = nx.Graph()
        for joint, (first, second) in ends.items():
            one, other = number.setdefault(first, len(number)), number.setdefault(second, len(number))
            if about.has_edge(one, other):  # two joints between two links are a loop by themselves
                yield Loop((about[one][other]["joint"], joint), centre)
            else:
                about.add_edge(one, other, joint=joint)
        if about.number_of_edges() > _MOST:
            for ring in nx.cycle_basis(about):
                sides = zip(ring, [*ring[1:], ring[0]], strict=True)
                yield Loop(tuple(about[one][other]["joint"] for one, other in sides), centre)
            return
        for cycle in nx.minimum_cycle_basis(about):  # shortest cycles have no chords
            yield Loop(tuple(joint for _, _, joint in about.subgraph(cycle).edges(data="joint")), centre)


def _near(points: Floats, distance: float) -> list[Floats]:
    """Return the places of points that are near each other, or near such that are: int arrays."""
    from scipy.spatial import cKDTree  # not at the head: a question about one vertex would wait for it

    joined = nx.Graph()
    joined.add_nodes_from(range(len(points)))
    joined.add_edges_from(cKDTree(points).query_pairs(distance))
    return [np.array(sorted(part)) for part in nx.connected_components(joined)]
