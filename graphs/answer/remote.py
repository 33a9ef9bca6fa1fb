"""Declared remote centres S_{+k} compared with coordinates: loops of scissors, rods that meet.

Two scissors that share two ends are a pair; with arms a, b to these ends and a', b' of the other they open together
if a = a' and b = b' (identical scissors, or asymmetric ones and their mirror images: Wampler, Larson, Erdman 2007,
Fig. 14b). The ray through the ends meets the ray at the other side of a scissors in a point that divides the
distance of the ends in one ratio at all openings. Where all pairs of a loop open together and their ratios agree, the
rays keep one centre and k = 4. Theory: docs/theory/polyhedron-model.md.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

import networkx as nx
import numpy as np

from graphs.errors import numbered, shown
from graphs.geometry import lines_meet, unit
from graphs.mechanism.polyhedron import PolyhedronModel, RemoteCentre, VertexId
from graphs.mechanism.precision import extent_of, precision_of
from graphs.tolerances import DOUBLE, Tolerances
from graphs.types import Floats

# k of a loop of scissors that keeps its centre: of the six freedoms that closing costs by count, two are not there,
# since far and near ends lie on rays from one centre (docs/theory/polyhedron-model.md).
_OF_SCISSORS = 4


@dataclass(frozen=True, slots=True)
class ScissorsPair:
    """Two scissors that share two ends.

    Attributes
    ----------
    scissors : (int, int)
        Their places in the model's list.
    ends : (vertex, vertex)
        The shared ends.
    arms : ((float, float), (float, float))
        a, b and a', b': from the pivot of each to these ends, in the unit of the coordinates.
    ratios : (float, float)
        The distance of the ends over that of the first end from the centre, where the ray meets the ray at the other
        side of each scissors; 0 where they are parallel.
    off : (float, float)
        The largest difference of arms, and that of the ratios times the distance of the ends: units of the extent.
    """

    scissors: tuple[int, int]
    ends: tuple[VertexId, VertexId]
    arms: tuple[tuple[float, float], tuple[float, float]]
    ratios: tuple[float, float]
    off: tuple[float, float]

    @property
    def differs(self) -> float:
        """The larger of both differences."""
        return max(self.off)

    def __str__(self) -> str:
        (a, b), (other_a, other_b) = self.arms
        one, other = self.scissors
        lengths = f"a = {a:.6g}, a' = {other_a:.6g}, b = {b:.6g}, b' = {other_b:.6g}"
        text = f"scissors {one} and {other} at vertices {shown(self.ends[0])}, {shown(self.ends[1])}: {lengths}"
        arms, centres = self.off
        if centres <= max(arms, DOUBLE.same_point):
            return text
        first, second = self.ratios
        rays = f"the rays at their other sides meet this one at {_share(first)} and {_share(second)}"
        return f"{text}, but {rays} of the distance of its ends"


def _share(ratio: float) -> str:
    return f"{1.0 / ratio:.6g}" if ratio else "infinity"


def scissors_pairs(model: PolyhedronModel) -> list[ScissorsPair]:
    """Return the pairs of scissors of a placed model that share two ends, with their arms.

    Parameters
    ----------
    model : PolyhedronModel
        With coordinates; scissors whose bars do not cross are in no pair.

    Examples
    --------
    >>> row = {0: (0, 0, 0), 1: (0, 1, 0), 2: (1, 0, 0), 3: (1, 1, 0), 4: (2, 0, 0), 5: (2, 1, 0)}
    >>> model = PolyhedronModel(6, coordinates=row, scissors=[(0, 1, 2, 3), (2, 3, 4, 5)])
    >>> print(scissors_pairs(model)[0])
    scissors 0 and 1 at vertices 2, 3: a = 0.707107, a' = 0.707107, b = 0.707107, b' = 0.707107
    """
    places = {vertex: np.array(place) for vertex, place in model.coordinates.items()}
    extent = extent_of(np.array(list(places.values()))) or 1.0
    pairs = []
    for (one, four), (other, fours) in combinations(enumerate(model.scissors), 2):
        shared = [vertex for vertex in four if vertex in fours]
        if len(shared) != 2:
            continue
        seen = [_seen_from(shared, ends, places) for ends in (four, fours)]
        if any(side is None for side in seen):
            continue
        (arms, ratio), (other_arms, other_ratio) = (side for side in seen if side is not None)
        apart = float(np.linalg.norm(places[shared[1]] - places[shared[0]]))
        off = abs(ratio - other_ratio) * apart / extent
        lengths = max(abs(a - b) for a, b in zip(arms, other_arms, strict=True)) / extent
        ends = shared[0], shared[1]
        pairs.append(ScissorsPair((one, other), ends, (arms, other_arms), (ratio, other_ratio), (lengths, off)))
    return pairs


def _seen_from(
    shared: list[VertexId], four: tuple[VertexId, ...], places: dict[VertexId, Floats]
) -> tuple[tuple[float, float], float] | None:
    """Return the arms of a scissors to two of its ends, and the ratio of the ray through them (`ScissorsPair`).

    None if its bars do not cross, or the ends are those of one bar. With arms a, b to these ends and c, d beyond the
    pivot on the same bars, a u (1 - t) + b t w is on the ray of the other ends for 1 / t = (a d - b c) / (a d + c d),
    whatever the directions u and w of the bars.
    """
    first, second, third, last = four
    bars = {first: last, last: first, second: third, third: second}
    far = [bars[vertex] for vertex in shared]
    if far[0] in shared:
        return None
    points = np.array([places[vertex] for vertex in shared])
    ways = np.array([places[vertex] for vertex in far]) - points
    if not ways.any(axis=1).all() or not np.cross(*unit(ways)).any():
        return None
    pivot = lines_meet(points, unit(ways)).point
    a, b = (float(np.linalg.norm(point - pivot)) for point in points)
    c, d = (float(np.linalg.norm(places[vertex] - pivot)) for vertex in far)
    return (a, b), (a * d - b * c) / (d * (a + c))


def notes_on_centres(model: PolyhedronModel) -> Iterator[str]:
    """Yield what coordinates say of the remote centres that a model declares, or of loops of scissors without any."""
    of_scissors = [centre for centre in model.centres if not centre.rods]
    if not model.coordinates:
        if of_scissors and model.scissors:
            declared = ", ".join(dict.fromkeys(f"k = {centre.k}" for centre in of_scissors))
            yield f"declared {declared}, not checked: no coordinates"
        return
    precision = Tolerances.of(precision_of(list(model.coordinates.values())).size)
    for centre in model.centres:
        if centre.rods:
            yield from _on_rods(model, centre, precision)
    yield from _on_scissors(model, of_scissors, precision)


def _on_rods(model: PolyhedronModel, centre: RemoteCentre, tolerances: Tolerances) -> Iterator[str]:
    """Yield whether the lines of the rods of a centre meet in a point, or are parallel."""
    ends = np.array([[model.coordinates[vertex] for vertex in rod] for rod in centre.rods], dtype=float)
    extent = extent_of(np.array(list(model.coordinates.values()))) or 1.0
    ways = unit(ends[:, 1] - ends[:, 0])
    if centre.infinite:
        off = float(np.linalg.norm(np.cross(ways, ways[0]), axis=1).max())
        what, close = f"largest sine {off:.1g}", off <= tolerances.parallel
    else:
        off = float(lines_meet(ends[:, 0] / extent, ways).off.max())
        what, close = f"off by at most {off:.1g} of the extent", off <= tolerances.same_point
    how = "are parallel" if centre.infinite else "meet in a point"
    rods = numbered(len(centre.rods), "rod")
    if close:
        yield f"declared k = {centre.k}: the lines of its {rods} {how} ({what})"
    else:
        yield f"declared k = {centre.k}, refused: the lines of its {rods} do not {how.replace('are', 'run')} ({what})"


def _on_scissors(model: PolyhedronModel, centres: list[RemoteCentre], tolerances: Tolerances) -> Iterator[str]:
    """Yield what k the loops of scissors have, against the centres that are declared for them."""
    pairs = scissors_pairs(model)
    joined = nx.Graph()
    joined.add_nodes_from(range(len(model.scissors)))
    joined.add_edges_from(pair.scissors for pair in pairs)
    loops = joined.number_of_edges() - len(joined) + nx.number_connected_components(joined) if len(joined) else 0
    if not loops:
        if centres:
            yield "declared remote centres without rods, not checked: the scissors form no loop"
        return
    odd = max(pairs, key=lambda pair: pair.differs)
    if odd.differs > tolerances.same_point:
        refused = ", ".join(dict.fromkeys(f"k = {centre.k}" for centre in centres))
        what = f"declared {refused}, refused" if centres else f"no S+{_OF_SCISSORS}"
        yield f"{what}: a pair of scissors does not open with the others, {odd}"
        return
    arms = (
        f"a = a' and b = b' at all {numbered(len(pairs), 'pair')} (largest difference {odd.differs:.1g} of the extent)"
    )
    found = numbered(loops, "independent loop")
    if not centres:
        yield f"k = {_OF_SCISSORS} found for {found} of scissors, not declared: {arms}"
        return
    wrong = [centre.k for centre in centres if centre.k != _OF_SCISSORS]
    if wrong or len(centres) != loops:
        declared = " + ".join(str(centre.k) for centre in centres)
        yield f"declared k = {declared}, refused: k = {_OF_SCISSORS} for each of {found} of scissors, {arms}"
    else:
        yield f"declared k = {_OF_SCISSORS}, confirmed: {arms}"
