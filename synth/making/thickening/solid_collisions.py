"""Plane-faced solids that move on hinges: exact distances, and the range until two of them meet, without sampling.

Solids are convex pieces. Two of them are as far apart as the largest gap between planes across a direction; the
directions to try are those of faces, of products of edges, and between corners and edges. Along a motion a pair is
apart from one configuration to another if it is across one direction at both ends, by more than corners leave the
chords of their paths; else the stretch is halved (conservative advancement). Theory: docs/theory/thick-panels.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees, pi, tau
from typing import Any

import networkx as nx
import numpy as np
import scipy.spatial
from scipy.spatial.transform import Rotation

from graphs.geometry import unit
from graphs.tolerances import DOUBLE, MARGIN
from graphs.types import Flags, Floats, Ints
from synth.analysis.motion.closure import ClosureEquations, corrected

_BLOCK = 4096
"""Pairs of pieces compared at a time."""
_FINEST = MARGIN
"""A stretch of the motion is not halved if no hinge turns by more on it, in radians."""
_HALVINGS = 50
"""Until a place is known to rounding."""
_UNSEEN = 2.0
"""How much farther than in the middle of a stretch a fold angle may be from the chord of its path."""


@dataclass(frozen=True, eq=False)
class ConvexPieces:
    """Convex plane-faced pieces of bodies, all in the flat state.

    Attributes
    ----------
    bodies : int[P]
        The body of each piece.
    corners : float[P, N, 3]
        Filled up by repetition, as are the others.
    normals, edges : float[P, M, 3], float[P, K, 3]
        Unit directions across faces and along edges, one of those that are parallel.

    Examples
    --------
    >>> cube = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
    >>> pieces = pieces_of([cube, cube + np.array([3.0, 4.0, 0.0])], [0, 1])
    >>> float(distances(pieces, np.array([0]), np.array([1]), np.eye(3)[None], np.zeros((1, 3)))[0].round(9))
    3.605551275
    """

    bodies: Ints
    corners: Floats
    normals: Floats
    edges: Floats

    def __len__(self) -> int:
        return len(self.bodies)


def pieces_of(solids: Sequence[Floats], bodies: Sequence[int]) -> ConvexPieces:
    """Return convex pieces by their corners, float[n, 3] each, and the body of each.

    Examples
    --------
    >>> corner = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    >>> pieces_of([corner], [0]).edges.shape
    (1, 6, 3)
    """
    hulls = [scipy.spatial.ConvexHull(corners) for corners in solids]
    corners = [hull.points[hull.vertices] for hull in hulls]
    normals = [_parted(hull.equations[:, :3]) for hull in hulls]
    edges = [_parted(unit(_edges(hull))) for hull in hulls]
    return ConvexPieces(np.array(bodies, dtype=np.int64), _filled(corners), _filled(normals), _filled(edges))


def _edges(hull: Any) -> Floats:
    """Return the edges of a hull as vectors: sides of triangles whose faces are not in one plane."""
    beside = hull.equations[hull.neighbors, :3]
    bent = np.abs(np.cross(hull.equations[:, None, :3], beside)).max(axis=2) > DOUBLE.parallel
    facet, across = np.nonzero(bent)
    ends = hull.points[hull.simplices[facet]]
    kept = np.arange(len(facet))
    return np.asarray(ends[kept, (across + 1) % 3] - ends[kept, (across + 2) % 3])


def _parted(directions: Floats) -> Floats:
    """Return directions without those that are parallel to one before."""
    parallel = np.abs(np.cross(directions[:, None], directions[None])).max(axis=2) <= DOUBLE.parallel
    return np.asarray(directions[~np.tril(parallel, -1).any(axis=1)])


def _filled(rows: Sequence[Floats]) -> Floats:
    most = max(map(len, rows), default=1)
    return np.array([np.concatenate([row, np.repeat(row[:1], most - len(row), axis=0)]) for row in rows])


def _gaps_across(axes: Floats, corners: Floats, others: Floats) -> tuple[Floats, Floats]:
    """Return the gap between two sets of corners, float[Q, N, 3], across unit directions, float[Q, X, 3], signed."""
    one, other = corners @ axes.swapaxes(1, 2), others @ axes.swapaxes(1, 2)
    ahead = other.min(axis=1) - one.max(axis=1)
    behind = one.min(axis=1) - other.max(axis=1)
    return np.maximum(ahead, behind), np.where(ahead >= behind, 1.0, -1.0)


def separations(
    pieces: ConvexPieces, first: Ints, second: Ints, turns: Floats, shifts: Floats
) -> tuple[Floats, Floats]:
    """Return the largest gaps between pairs of pieces across faces and products of edges, and their directions.

    The second piece of each pair is turned by float[Q, 3, 3], then translated by float[Q, 3]. A gap that is not
    positive is, with its sign changed, how far the pieces are in each other; gaps are not more than distances.
    """
    gaps, directions = np.empty(len(first)), np.empty((len(first), 3))
    for start in range(0, len(first), _BLOCK):
        block = slice(start, start + _BLOCK)
        a, b, turn = first[block], second[block], turns[block].swapaxes(1, 2)
        others = pieces.corners[b] @ turn + shifts[block, None]
        edges, beside = pieces.edges[a], pieces.edges[b] @ turn
        products = np.cross(edges[:, :, None], beside[:, None]).reshape(len(a), -1, 3)
        sizes = np.linalg.norm(products, axis=2, keepdims=True)
        products = np.where(sizes > DOUBLE.parallel, products / np.maximum(sizes, DOUBLE.parallel), edges[:, :1] * 0.0)
        axes = np.concatenate([pieces.normals[a], pieces.normals[b] @ turn, products], axis=1)
        every, signs = _gaps_across(axes, pieces.corners[a], others)
        every = np.where((axes * axes).sum(axis=2) > 0.0, every, -np.inf)
        best = every.argmax(axis=1)
        rows = np.arange(len(a))
        gaps[block] = every[rows, best]
        directions[block] = axes[rows, best] * signs[rows, best, None]
    return gaps, directions


def distances(pieces: ConvexPieces, first: Ints, second: Ints, turns: Floats, shifts: Floats) -> Floats:
    """Return the exact distances of pairs of pieces, 0 if they touch or overlap; arguments as of `separations`."""
    gaps, _ = separations(pieces, first, second, turns, shifts)
    for place in np.flatnonzero(gaps > 0.0):
        here = pieces.corners[first[place]]
        there = pieces.corners[second[place]] @ turns[place].T + shifts[place]
        between = (here[:, None] - there[None]).reshape(-1, 3)
        axes = [between]
        for along in (pieces.edges[first[place]], pieces.edges[second[place]] @ turns[place].T):
            axes.append((between[:, None] - (between @ along.T)[:, :, None] * along).reshape(-1, 3))
        every = np.concatenate(axes)
        sizes = np.linalg.norm(every, axis=1)
        every = every[sizes > 0.0] / sizes[sizes > 0.0, None]
        across, _ = _gaps_across(every[None], here[None], there[None])
        gaps[place] = max(gaps[place], float(across.max(initial=0.0)))
    return np.maximum(gaps, 0.0)


def overlap(corners: Floats, others: Floats) -> float:
    """Return the volume that two convex pieces, float[n, 3] and float[m, 3], have in common.

    Corners of what they have in common are ends of the parts of edges of one that lie in the other.
    """
    inside = [_clipped(here, scipy.spatial.ConvexHull(there).equations)
              for here, there in ((corners, others), (others, corners))]  # fmt: skip
    common = np.concatenate(inside)
    if len(common) <= 3 or np.ptp(common, axis=0).max() <= 0.0:
        return 0.0
    return float(scipy.spatial.ConvexHull(common, qhull_options="QJ").volume)


def _clipped(corners: Floats, planes: Floats) -> Floats:
    """Return the ends of the parts of segments between corners that lie below planes, float[P, 4]."""
    heights = corners @ planes[:, :3].T + planes[:, 3]
    first, second = np.triu_indices(len(corners), 1)
    start, rise = heights[first], heights[second] - heights[first]
    with np.errstate(divide="ignore", invalid="ignore"):
        at = -start / rise
    low = np.where(rise < 0.0, at, 0.0).max(axis=1, initial=0.0)
    high = np.where(rise > 0.0, at, 1.0).min(axis=1, initial=1.0)
    there = (low <= high) & ~((rise == 0.0) & (start > 0.0)).any(axis=1)
    along = corners[second] - corners[first]
    return np.concatenate([corners[first][there] + part[there, None] * along[there] for part in (low, high)])


class FoldCourse:
    """The fold angles of a motion at any place between its frames, 0 to F - 1, and bounds of their rates.

    If the tangents of half the fold angles keep their ratios, as at flat-foldable vertices of four creases, angles
    and bounds follow from these; else loops are closed anew at each place, from the chord between two frames, and
    fold angles leave the chord of a stretch by no more than twice as far as in its middle.
    """

    def __init__(self, closure: ClosureEquations, frames: Floats) -> None:
        self.closure, self.frames = closure, frames
        self._known: dict[float, Floats] = {}
        self._ratios = _ratios(frames)
        self._driver = int(np.abs(frames[-1]).argmax()) if len(frames) else 0

    @property
    def end(self) -> float:
        """The place of the last frame."""
        return float(len(self.frames) - 1)

    def at(self, places: Floats) -> Floats:
        """Return fold angles, float[Q, J], at places float[Q]."""
        before = np.clip(np.floor(places).astype(int), 0, max(len(self.frames) - 2, 0))
        part = (places - before)[:, None]
        after = np.minimum(before + 1, len(self.frames) - 1)
        chords = (1.0 - part) * self.frames[before] + part * self.frames[after]
        if self._ratios is not None:
            return np.asarray(2.0 * np.arctan(self._ratios * np.tan(chords[:, [self._driver]] / 2.0)))
        for place, chord in zip(places.tolist(), chords, strict=True):
            if place not in self._known:
                self._known[place] = chord if place.is_integer() else corrected(self.closure, chord).angles
        return np.array([self._known[place] for place in places.tolist()]).reshape(len(places), -1)

    def up_to(self, angle: float) -> FoldCourse:
        """Return the course up to the first place at which a fold angle is so large, in radians, in as many frames."""
        most = np.abs(self.frames).max(axis=1, initial=0.0)
        beyond = np.flatnonzero(most > angle)
        if not len(beyond):
            return self
        low, high = max(float(beyond[0]) - 1.0, 0.0), float(beyond[0])
        for _ in range(_HALVINGS):
            middle = (low + high) / 2.0
            if np.abs(self.at(np.array([middle]))).max() > angle:
                high = middle
            else:
                low = middle
        return FoldCourse(self.closure, self.at(np.linspace(0.0, low, len(self.frames))))

    def bounds(self, low: Floats, high: Floats) -> tuple[Floats, Floats]:
        """Return how far hinges turn at most on stretches, and how far they leave the chord: float[Q, J] each."""
        start, end = self.at(low), self.at(high)
        if self._ratios is None:
            off = _UNSEEN * np.abs(self.at((low + high) / 2.0) - (start + end) / 2.0)
            return np.abs(end - start) + 4.0 * off, off
        # With d the angle of the driver, the rate is 2 k / (1 + k^2 + (1 - k^2) cos d): both it and its derivative
        # are largest where the denominator is least, at an end, but for the sine.
        k = np.abs(self._ratios)
        drive = np.abs(np.stack([start[:, self._driver], end[:, self._driver]]))
        width = np.abs(drive[1] - drive[0])[:, None]
        least = (1.0 + k**2 + (1.0 - k**2) * np.cos(drive)[..., None]).min(axis=0)
        quarter = (drive.min(axis=0) < pi / 2) & (drive.max(axis=0) > pi / 2)
        sine = np.where(quarter, 1.0, np.sin(drive).max(axis=0))[:, None]
        rate, bend = 2.0 * k / least, 2.0 * k * np.abs(1.0 - k**2) * sine / least**2
        return rate * width, bend * width**2 / 8.0


def _ratios(frames: Floats) -> Floats | None:
    """Return the ratios of the tangents of half the fold angles to the largest, if all frames have the same."""
    if len(frames) < 2:
        return None
    driver = int(np.abs(frames[-1]).argmax())
    halves = np.tan(frames / 2.0)
    turned = np.abs(frames[:, driver]) > DOUBLE.same_configuration
    if not turned[1:].all() or turned[0] or np.abs(frames).max() >= pi:
        return None
    ratios = halves[turned] / halves[turned][:, [driver]]
    middle = ratios[len(ratios) // 2]
    return middle if np.abs(ratios - middle).max() < DOUBLE.same_point else None


@dataclass(frozen=True)
class FirstContact:
    """Where on a motion the first two solids meet.

    Attributes
    ----------
    place : float
        Between frames; the last frame if none meet.
    angle : float
        The largest fold angle there, radians.
    panels : tuple of 2 int, or None
        None if no solids meet.
    """

    place: float
    angle: float
    panels: tuple[int, int] | None

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {"angle_deg": degrees(self.angle), "panels": None if self.panels is None else list(self.panels)}


class MovingPieces:
    """Convex pieces of bodies joined by hinges, and a motion of these.

    Parameters
    ----------
    pieces : ConvexPieces
    hinges : sequence of (int, int)
        The bodies of each hinge: a positive angle turns the second about the direction.
    points, directions : float[J, 3]
        The axes in the flat state.
    course : FoldCourse
    """

    def __init__(
        self, pieces: ConvexPieces, hinges: Sequence[tuple[int, int]], points: Floats, directions: Floats,
        course: FoldCourse,
    ) -> None:  # fmt: skip
        self.pieces, self.hinges, self.points, self.directions = pieces, list(hinges), points, unit(directions)
        self.course = course
        self.bodies = 1 + max((body for pair in hinges for body in pair), default=0)
        self.bodies = max(self.bodies, int(pieces.bodies.max(initial=0)) + 1)
        self._joint = {frozenset(pair): joint for joint, pair in enumerate(self.hinges)}
        self._graph = nx.Graph([tuple(pair) for pair in self.hinges])
        self._graph.add_nodes_from(range(self.bodies))
        self._of = [np.flatnonzero(pieces.bodies == body) for body in range(self.bodies)]
        self._centre = pieces.corners.mean(axis=1)
        self._radius = np.linalg.norm(pieces.corners - self._centre[:, None], axis=2).max(axis=1)
        self._places: dict[float, int] = {}
        self._turns, self._shifts = np.zeros((0, self.bodies, 3, 3)), np.zeros((0, self.bodies, 3))

    def poses(self, places: Floats) -> tuple[Floats, Floats]:
        """Return rotations, float[Q, B, 3, 3], and translations, float[Q, B, 3], of bodies; the first rests."""
        new = sorted({place for place in places.tolist() if place not in self._places})
        if new:
            turns, shifts = body_poses(
                self.bodies, self.hinges, self.points, self.directions, self.course.at(np.array(new))
            )
            self._places.update({place: len(self._turns) + number for number, place in enumerate(new)})
            self._turns = np.concatenate([self._turns, turns])
            self._shifts = np.concatenate([self._shifts, shifts])
        rows = [self._places[place] for place in places.tolist()]
        return self._turns[rows], self._shifts[rows]

    def relative(self, places: Floats, first: Ints, second: Ints) -> tuple[Floats, Floats]:
        """Return poses of second bodies as seen from first ones, at places: float[Q, 3, 3], float[Q, 3]."""
        distinct, rows = np.unique(places, return_inverse=True)
        every, moved = self.poses(distinct)
        turns, shifts = every[rows, first].swapaxes(1, 2), moved[rows]
        across = np.take_along_axis(shifts, second[:, None, None].repeat(3, axis=2), axis=1)[:, 0]
        apart = across - np.take_along_axis(shifts, first[:, None, None].repeat(3, axis=2), axis=1)[:, 0]
        return turns @ every[rows, second], (turns @ apart[..., None])[..., 0]

    def first_meeting(self) -> FirstContact:
        """Return the first place at which two solids meet, to a millionth of a radian; the end if none do."""
        first, panels = self.course.end, None
        for body in range(self.bodies):
            place, other = self._met_by(body, first)
            if other is not None:
                first, panels = place, (body, other)
        angle = float(np.abs(self.course.at(np.array([first]))).max(initial=0.0))
        return FirstContact(first, angle, panels)

    def overlaps(self, places: Floats) -> Floats:
        """Return the volume that bodies have in common at places, float[Q]."""
        volumes = np.zeros(len(places))
        for number, place in enumerate(places.tolist()):
            first, second = self.near(place)
            at = np.full(len(first), place)
            turns, shifts = self.relative(at, self.pieces.bodies[first], self.pieces.bodies[second])
            gaps, _ = separations(self.pieces, first, second, turns, shifts)
            for pair in np.flatnonzero(gaps < -DOUBLE.same_point * self._radius[first]):
                there = self.pieces.corners[second[pair]] @ turns[pair].T + shifts[pair]
                volumes[number] += overlap(self.pieces.corners[first[pair]], there)
        return volumes

    def clear_of_hinges(self, first: Ints, second: Ints) -> Floats:
        """Return up to which fold angle pieces of bodies that are hinged are apart: they lie in wedges on its axis.

        Float[Q], 0 for pieces of bodies that are not hinged to each other.
        """
        clear = np.zeros(len(first))
        for number, (one, other) in enumerate(zip(first.tolist(), second.tolist(), strict=True)):
            pair = (int(self.pieces.bodies[one]), int(self.pieces.bodies[other]))
            joint = self._joint.get(frozenset(pair))
            if joint is not None:
                clear[number] = self._wedges(joint, one, other)
        return clear

    def joint_of(self, first: int, second: int) -> int | None:
        """Return the hinge of two bodies."""
        return self._joint.get(frozenset((first, second)))

    def near(self, place: float, within: float = 0.0) -> tuple[Ints, Ints]:
        """Return pairs of pieces of different bodies whose balls are within a length, the lesser body first."""
        turns, shifts = self.poses(np.array([place]))
        bodies = self.pieces.bodies
        centres = np.einsum("pij,pj->pi", turns[0, bodies], self._centre) + shifts[0, bodies]
        tree = scipy.spatial.cKDTree(centres)
        pairs = tree.query_pairs(2.0 * float(self._radius.max()) + within, output_type="ndarray")
        first, second = pairs[:, 0], pairs[:, 1]
        reach = self._radius[first] + self._radius[second] + within
        near = np.linalg.norm(centres[first] - centres[second], axis=1) < reach
        near &= bodies[first] != bodies[second]
        first, second = first[near], second[near]
        swapped = bodies[first] > bodies[second]
        return np.where(swapped, second, first), np.where(swapped, first, second)

    def _wedges(self, joint: int, one: int, other: int) -> float:
        """Return by how much a wedge on a hinge can turn, as the motion goes, until it meets that of another piece."""
        along = self.directions[joint]
        across = unit(np.cross(np.array([0.0, 0.0, 1.0]), along))
        up = np.cross(along, across)
        arcs = []
        for piece in (one, other):
            towards = self.pieces.corners[piece] - self.points[joint]
            away = np.column_stack([towards @ across, towards @ up])
            far = away[np.hypot(*away.T) > DOUBLE.same_point * self._radius[piece]]
            angles = np.sort(np.arctan2(far[:, 1], far[:, 0]))
            steps = np.diff([*angles, angles[0] + tau])
            widest = int(steps.argmax())
            span = tau - float(steps[widest])
            if span > pi + DOUBLE.meant:
                return 0.0
            arcs.append((float(angles[(widest + 1) % len(angles)]), span))
        first_moves = self.hinges[joint][1] == self.pieces.bodies[one]
        (rest, rest_span), (moved, moved_span) = arcs[::-1] if first_moves else arcs
        # A margin for rounding, so that arcs that touch do not seem to be a whole turn apart.
        ahead = (rest - moved - moved_span + DOUBLE.meant) % tau - DOUBLE.meant
        behind = (moved - rest - rest_span + DOUBLE.meant) % tau - DOUBLE.meant
        if ahead + behind + rest_span + moved_span > tau + DOUBLE.meant:
            return 0.0
        turned = self.course.frames[-1, joint] if len(self.course.frames) else 0.0
        return max(ahead if turned >= 0.0 else behind, 0.0)

    def _met_by(self, body: int, until: float) -> tuple[float, int | None]:
        """Return the first place before one at which a body meets another of a higher number, and that body."""
        pieces = self.pieces
        others = np.flatnonzero(pieces.bodies > body)
        mine = self._of[body]
        if not len(others) or not len(mine) or until <= 0.0:
            return until, None
        joints, reaches = self._chains(body)
        first, second = (grid.ravel() for grid in np.meshgrid(mine, others, indexing="ij"))
        clear = self.clear_of_hinges(first, second)
        hinge = np.array([-1 if (j := self.joint_of(body, int(b))) is None else j for b in pieces.bodies[second]])
        frames = np.arange(int(np.ceil(until)))
        pair = np.tile(np.arange(len(first)), len(frames))
        low = np.repeat(frames.astype(float), len(first))
        high = np.minimum(low + 1.0, self.course.end)
        met: int | None = None
        while len(pair):
            a, b = first[pair], second[pair]
            stretches, rows = np.unique(np.column_stack([low, high]), axis=0, return_inverse=True)
            turned, bent = self.course.bounds(stretches[:, 0], stretches[:, 1])
            most = turned.max(axis=1, initial=0.0)[rows]
            folded = np.abs(self.course.at(stretches[:, 1]))
            at_hinge = np.where(hinge[pair] >= 0, folded[rows, hinge[pair]], np.inf)
            undone = at_hinge > clear[pair] + DOUBLE.parallel
            pair, rows, a, b = (one[undone] for one in (pair, rows, a, b))
            low, high, most = (one[undone] for one in (low, high, most))
            # Rates of the joints of the chain, 0 for the joint that fills it up.
            turned, bent = (
                np.column_stack([one, np.zeros(len(one))])[rows[:, None], joints[b]] for one in (turned, bent)
            )
            sums, swept = turned.sum(axis=1), (turned * reaches[b]).sum(axis=1)
            chained = np.where((joints[b] < len(self.hinges)).sum(axis=1) > 1, 2.0, 1.0)
            off = chained * sums * swept / 8.0 + (bent * reaches[b]).sum(axis=1)
            apart, middle = self._apart(body, a, b, low, high, off, swept)
            overlapping = ~apart & (middle < -DOUBLE.same_point * self._radius[b])
            finest = ~apart & ~overlapping & (most <= _FINEST)
            for ended, at in ((overlapping, (low + high) / 2.0), (finest, low)):
                if ended.any() and at[ended].min() < until:
                    earliest = np.flatnonzero(ended)[at[ended].argmin()]
                    until, met = float(at[earliest]), int(pieces.bodies[b[earliest]])
            left = ~apart & (low < until) & (most > _FINEST)
            middles = (low[left] + high[left]) / 2.0
            pair = np.tile(pair[left], 2)
            low, high = np.concatenate([low[left], middles]), np.concatenate([middles, high[left]])
            pair, low, high = (one[low < until] for one in (pair, low, high))
        return until, met

    def _apart(
        self, body: int, first: Ints, second: Ints, low: Floats, high: Floats, off: Floats, swept: Floats
    ) -> tuple[Flags, Floats]:
        """Return which pairs are apart all along stretches of the motion, and their gaps in the middle, if not."""
        bodies = np.full(len(first), body)
        middle = (low + high) / 2.0
        turns, shifts = self.relative(middle, bodies, self.pieces.bodies[second])
        centres = (turns @ self._centre[second][..., None])[..., 0] + shifts
        between = np.linalg.norm(centres - self._centre[first], axis=1)
        apart = between - self._radius[first] - self._radius[second] > swept
        gaps = np.full(len(first), np.inf)
        near = np.flatnonzero(~apart)
        gap, across = separations(self.pieces, first[near], second[near], turns[near], shifts[near])
        gaps[near] = gap
        least = np.full(len(near), np.inf)
        for place in (low, high):
            turns, shifts = self.relative(place[near], bodies[near], self.pieces.bodies[second[near]])
            there = self.pieces.corners[second[near]] @ turns.swapaxes(1, 2) + shifts[:, None]
            ahead = (there @ across[..., None])[..., 0].min(axis=1)
            least = np.minimum(
                least, ahead - (self.pieces.corners[first[near]] @ across[..., None])[..., 0].max(axis=1)
            )
        apart[near] = (least > off[near]) | (gap > swept[near])
        return apart, gaps

    def _chains(self, body: int) -> tuple[Ints, Floats]:
        """Return the hinges between a body and each piece, int[P, D], and how far corners are from them at most.

        Chains are shortest ones, from the piece back to the body, filled up by the number of hinges. Distances,
        float[P, D], hold in all configurations: they add up from the piece to a point of each axis of the chain.
        """
        parents = nx.predecessor(self._graph, body)
        count, here = len(self.hinges), self.pieces.bodies.copy()
        via = np.full(self.bodies, count)
        back = np.arange(self.bodies)
        for other, before in parents.items():
            if before:
                back[other], via[other] = before[0], self._joint[frozenset((other, before[0]))]
        corners = self.pieces.corners
        point, reach = self._centre.copy(), self._radius.copy()
        points = np.concatenate([self.points, np.zeros((1, 3))])
        along = np.concatenate([self.directions, np.zeros((1, 3))])
        joints: list[Ints] = []
        reaches: list[Floats] = []
        while (via[here] < count).any():
            joint = via[here]
            foot = points[joint] + ((point - points[joint]) * along[joint]).sum(axis=1, keepdims=True) * along[joint]
            away = np.linalg.norm(foot - point, axis=1)
            if not joints:  # the nearest axis: how far corners are from it is exact
                towards = corners - points[joint][:, None]
                towards -= (towards * along[joint][:, None]).sum(axis=2, keepdims=True) * along[joint][:, None]
                far = np.linalg.norm(towards, axis=2).max(axis=1)
            else:
                far = away + reach
            there = joint < count
            joints.append(joint)
            reaches.append(np.where(there, far, 0.0))
            reach = np.where(there, reach + away, reach)
            point = np.where(there[:, None], foot, point)
            here = back[here]
        if not joints:
            return np.full((len(corners), 1), count), np.zeros((len(corners), 1))
        return np.column_stack(joints), np.column_stack(reaches)


def body_poses(
    bodies: int, hinges: Sequence[tuple[int, int]], points: Floats, directions: Floats, angles: Floats
) -> tuple[Floats, Floats]:
    """Return how bodies stand at joint angles float[F, J], by a tree of hinges from body 0.

    Rotations, float[F, B, 3, 3], and translations, float[F, B, 3].
    """
    turns = np.tile(np.eye(3), (len(angles), bodies, 1, 1))
    shifts = np.zeros((len(angles), bodies, 3))
    graph = nx.Graph()
    graph.add_nodes_from(range(bodies))
    for joint, (first, second) in enumerate(hinges):
        if not graph.has_edge(first, second):
            graph.add_edge(first, second, joint=joint)
    for near, far in nx.bfs_edges(graph, 0):
        joint = graph.edges[near, far]["joint"]
        sign = 1.0 if hinges[joint][0] == near else -1.0
        vectors = sign * angles[:, joint, None] * directions[joint]
        turned = Rotation.from_rotvec(vectors).as_matrix()
        turns[:, far] = turns[:, near] @ turned
        offset = points[joint] - turned @ points[joint]
        shifts[:, far] = (turns[:, near] @ offset[..., None])[..., 0] + shifts[:, near]
    return turns, shifts
