"""Motions in which creases that look alike fold alike: those that keep a symmetry of a flat pattern.

Motions of the plane that take the whole pattern to itself make a group; its orbits, and those of its subgroups,
are classes of creases. A piece of a tessellation has more that agree wherever the pattern and its image overlap.
With several freedoms the least rates that move one crease lead off every symmetric motion: so a pattern is folded
to an angle first along the motions that keep a symmetry, which have few freedoms or one. Theory:
docs/theory/folding.md.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations_with_replacement, islice
from math import degrees
from typing import Any

import numpy as np
import scipy.sparse
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from graphs.errors import UnsolvableError
from graphs.geometry import lines_meet, principal_axes, unit
from graphs.loops.loop import Centre
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import Sheet, sides_of_face
from graphs.tolerances import DOUBLE, Tolerances, leading
from graphs.types import Flags, Floats, Ints
from synth.analysis.folding.configuration import SheetConfiguration, configuration_of_sheet
from synth.analysis.motion.assigned_branch import rates_as_marked
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.driven_motion import BranchChoice, DrivenMotion, beginning
from synth.analysis.motion.linkage import Linkage, axis_lengths
from synth.analysis.motion.motion import Motion, motion_along
from synth.analysis.motion.path import PathOptions, driven_path
from synth.analysis.motion.singular.motion_near_rates import spaces_near
from synth.analysis.motion.singular.sampling import rates_towards
from synth.analysis.motion.singular.second_order import quadrics_of, rates_at
from synth.analysis.motion.tangent import TangentSpace
from synth.analysis.motion.walk.step import Allowance

_LARGEST_GROUP = 24
"""Motions of a group whose pairs are tried as generators of subgroups: those of a polygon of twelve sides."""


@dataclass(frozen=True, slots=True)
class _Plane:
    """A flat pattern in its plane, in extents: middles and directions of creases, float[J, 2], and its border.

    Middles and directions closer than `same` are one: both arms that a motion takes to each other may err.
    """

    middles: Floats
    directions: Floats
    marks: Floats
    sides: Floats
    same: float

    def inside(self, places: Floats) -> Flags:
        """Tell which places float[n, 2] are within the border: a ray crosses it an odd number of times."""
        (x1, y1), (x2, y2) = self.sides[:, 0].T, self.sides[:, 1].T
        x, y = places[:, :1], places[:, 1:]
        spans = (y1 > y) != (y2 > y)
        crossing = x1 + (y - y1) * (x2 - x1) / np.where(y2 == y1, 1.0, y2 - y1)
        odd = (spans & (crossing > x)).sum(axis=1) % 2 == 1
        along = np.stack([x2 - x1, y2 - y1], axis=-1)
        lengths = np.maximum((along**2).sum(axis=-1), self.same**2)
        part = np.clip(((x - x1) * along[:, 0] + (y - y1) * along[:, 1]) / lengths, 0.0, 1.0)
        off = np.hypot(x - x1 - part * along[:, 0], y - y1 - part * along[:, 1])
        return np.asarray(odd & (off.min(axis=1, initial=np.inf) > self.same))


@dataclass(frozen=True, slots=True)
class _Vertex:
    """A vertex that creases surround: its place, the creases in their order, and their directions outwards."""

    place: Floats
    joints: Ints
    outwards: Floats


def alike_classes(sheet: Sheet, linkage: Linkage, marks: Floats, tolerances: Tolerances = DOUBLE) -> list[Ints]:
    """Return classes of creases of a flat sheet that look alike, int[J] each, those of the largest symmetry first.

    First those that are alike in the tessellation that the pattern is a piece of, then the orbits of all motions
    that take the pattern to itself, then those of their subgroups; none that leave all creases by themselves. A
    motion keeps marks, float[J]: 1 for valleys, -1 for mountains, 0 without a mark.
    """
    plane, count = _plane(sheet, linkage, marks, tolerances), len(marks)
    maps = list(_maps(plane, _vertices(plane, linkage)))
    whole = [joints for joints in maps if (joints >= 0).all()]
    choices = [maps, whole]
    if len(whole) <= _LARGEST_GROUP:
        choices += [list(pair) for pair in combinations_with_replacement(whole, 2)]
    orbits = [_joined(choice, count) for choice in choices]
    distinct = {classes.tobytes(): classes for classes in orbits if classes.max(initial=0) + 1 < count}
    first = orbits[0].tobytes()  # alike in the tessellation
    return sorted(distinct.values(), key=lambda classes: (classes.tobytes() != first, int(classes.max())))


def _plane(sheet: Sheet, linkage: Linkage, marks: Floats, tolerances: Tolerances) -> _Plane:
    assert sheet.coordinates is not None
    local = (in_space(sheet.coordinates) - linkage.middle) / linkage.extent
    used = sorted({vertex for face in sheet.faces for vertex in face})
    across = principal_axes(local[used])[1][:2]
    count: dict[frozenset[int], int] = {}
    for face in sheet.faces:
        for side in sides_of_face(face):
            count[frozenset(side)] = count.get(frozenset(side), 0) + 1
    border = [sorted(side) for side, faces in count.items() if faces == 1 and len(side) == 2]
    sides = (local @ across.T)[np.array(border, dtype=np.int64).reshape(-1, 2)]
    same = 2.0 * tolerances.parallel / float(axis_lengths(linkage).min(initial=1.0))
    return _Plane(linkage.points @ across.T, linkage.directions @ across.T, marks, sides, same)


def _vertices(plane: _Plane, linkage: Linkage) -> list[_Vertex]:
    """Return the vertices about which loops close: where the lines of their creases meet."""
    vertices = []
    for loop in linkage.loops:
        if loop.centre is not Centre.FINITE:
            continue
        joints = np.array(loop.joints, dtype=np.int64)
        place = lines_meet(plane.middles[joints], plane.directions[joints]).point
        vertices.append(_Vertex(place, joints, unit(plane.middles[joints] - place)))
    return vertices


def _maps(plane: _Plane, vertices: list[_Vertex]) -> Iterator[Ints]:
    """Yield the motions of the plane that take a vertex to a vertex and agree wherever pattern and image overlap.

    Each as the crease that each crease is taken to, -1 for none: int[J].
    """
    tree = cKDTree(plane.middles) if len(plane.middles) else None
    first: dict[int, _Vertex] = {}
    for vertex in vertices:
        start = first.setdefault(len(vertex.joints), vertex)
        arm = start.outwards[0]
        for goal in vertex.outwards:
            for mirror in (1.0, -1.0):
                seen = arm * (1.0, mirror)
                cos, sin = float(seen @ goal), float(seen[0] * goal[1] - seen[1] * goal[0])
                matrix = np.array([[cos, -sin], [sin, cos]]) * (1.0, mirror)
                shift = vertex.place - matrix @ start.place
                near, same = _nearest(plane, tree, matrix, shift, start.joints)
                if not same.all() or set(near.tolist()) != set(vertex.joints.tolist()):
                    continue
                there = _taken(plane, tree, matrix, shift)
                if there is not None and _taken(plane, tree, matrix.T, -matrix.T @ shift) is not None:
                    yield there


def _taken(plane: _Plane, tree: cKDTree, matrix: Floats, shift: Floats) -> Ints | None:
    """Return the crease that each is taken to, -1 where it leaves the sheet; None if one is taken to no crease."""
    every = np.arange(len(plane.middles))
    there, same = _nearest(plane, tree, matrix, shift, every)
    if plane.inside(plane.middles[~same] @ matrix.T + shift).any():
        return None
    return np.where(same, there, -1)


def _nearest(plane: _Plane, tree: cKDTree, matrix: Floats, shift: Floats, joints: Ints) -> tuple[Ints, Flags]:
    """Return the crease nearest to where a motion takes each of some, int[n], and whether it is taken to that."""
    directions = plane.directions[joints] @ matrix.T
    off, there = tree.query(plane.middles[joints] @ matrix.T + shift)
    across = directions[:, 0] * plane.directions[there, 1] - directions[:, 1] * plane.directions[there, 0]
    same = (off <= plane.same) & (np.abs(across) <= plane.same) & (plane.marks[joints] == plane.marks[there])
    return there, same


def _joined(maps: list[Ints], count: int) -> Ints:
    """Return the classes of joints that some maps take to each other, in the order of their first members."""
    starts = np.concatenate([np.zeros(0, np.int64), *(np.flatnonzero(joints >= 0) for joints in maps)])
    ends = np.concatenate([np.zeros(0, np.int64), *(joints[joints >= 0] for joints in maps)])
    between = coo_matrix((np.ones(len(starts)), (starts, ends)), shape=(count, count))
    labels = connected_components(between, directed=False)[1]
    _, first, where = np.unique(labels, return_index=True, return_inverse=True)
    return np.asarray(np.argsort(np.argsort(first))[where], dtype=np.int64)


class AlikeClosure(ClosureEquations):
    """Closure equations of a linkage, and one for each joint whose angle is that of another of its class.

    Any motion of these is a motion of the linkage; rounding cannot lead off the motions that keep the angles of a
    class equal, since an inequality is an error like a loop that does not close.
    """

    def __init__(self, linkage: Linkage, classes: Ints) -> None:
        super().__init__(linkage)
        first = np.unique(classes, return_index=True)[1][np.unique(classes, return_inverse=True)[1]]
        others = np.flatnonzero(first != np.arange(self.joints))
        every = scipy.sparse.identity(self.joints, format="csr")
        self._unlike = (every[others] - every[first[others]]).tocsr()
        self.rows += len(others)

    def evaluated(self, angles: Floats) -> tuple[Floats, Floats]:
        """Return residuals of loops and classes at joint angles, and the entries of the derivatives of loops."""
        residual, entries = super().evaluated(angles)
        return np.concatenate([residual, self._unlike @ angles]), entries

    def matrix(self, entries: Floats) -> scipy.sparse.csr_matrix:
        """Return the derivatives of loops and classes."""
        return scipy.sparse.vstack([super().matrix(entries), self._unlike], format="csr")

    def space(self, entries: Floats) -> TangentSpace:
        """Return the rates where derivatives have these entries."""
        return TangentSpace(self.matrix(entries))

    def dense(self, angles: Floats) -> Floats:
        """Return the derivatives of loops and classes in full."""
        return np.asarray(self.matrix(self.evaluated(angles)[1]).toarray())

    def corrected(self, angles: Floats) -> None:
        """Leave Newton's method to Python: the library knows nothing of classes."""

    def walked(self, manner: Floats, place: dict[str, Any], most: int) -> None:
        """Leave walks to Python."""


_WEIGHTS = (1.01, 0.8, 2.0, 0.5, 4.0, 0.25)
"""Weights of valleys against mountains in the rates from which a motion is looked for: where both weigh alike,
two motions of a symmetric vertex are as near, and rounding would choose."""
_DEAD_ENDS = 4
"""Spaces of rates that are tried for each of these."""
_DRIVERS = 3
"""Creases that are driven in turn, of different classes, where the one that moves most turns back."""
MOST_ALIKE = 1200
"""Creases that look alike are looked for up to so many: the motions of the plane that are tried grow with them."""
_STEPS = 1000
"""Steps of one path: 170 degrees take 20 to 100."""


@dataclass(frozen=True, slots=True)
class _Start:
    """Equations of all motions, or of those that keep classes of joints alike, and rates with which one begins."""

    pattern: SheetConfiguration
    closure: ClosureEquations
    rates: Floats
    classes: Ints
    branch: int | None = None


def fold_to(sheet: Sheet, angle: float) -> Motion:
    """Fold a flat pattern as assigned until the crease that moves most has an angle, radians, above 0.

    Raises `UnsolvableError` if nothing folds, or all motions of `folded_towards` end before; the farthest is named.
    """
    motion = folded_towards(sheet, angle)
    if motion.path.stopped:
        driver = motion.configuration.joints.index(next(iter(motion.driven)))
        reached = degrees(float(abs(motion.path.angles[-1, driver])))
        limit = f"the pattern folds to {reached:.6g}°; expected {degrees(angle):.6g}°"
        raise UnsolvableError(f"{limit}: {motion.path.stopped}")
    return motion


def folded_towards(sheet: Sheet, angle: float, frames: int = 1) -> Motion:
    """Return the motion of a flat pattern that folds to an angle, radians, above 0; else the one that gets farthest.

    Tried are, until one leads there: the motion on which creases that look alike fold alike; those that keep less
    of the symmetry; the branch that agrees best with the marks; others that agree with them. Each goes straight on
    first, then by the least rates that move the driven crease; where that turns back, the next one is driven.
    The motion has so many frames after the flat one, at equal steps of the driven crease. Raises `UnsolvableError`
    if nothing folds.
    """
    farthest, best = -1.0, None
    for start in _starts(sheet):
        for driver in _drivers(start):
            for straight in (True, False):
                motion = _followed(start, driver, angle, frames, straight=straight)
                if not motion.path.stopped:
                    return motion
                reached = float(abs(motion.path.angles[-1, driver]))
                if reached > farthest + DOUBLE.same_configuration:
                    farthest, best = reached, motion
    if best is None:
        raise UnsolvableError("found no motion that folds the pattern with its assignment")
    return best


def _starts(sheet: Sheet) -> Iterator[_Start]:
    """Yield motions, the most symmetric one first; all ways to move are looked for only when these are used up."""
    pattern = configuration_of_sheet(sheet)
    if pattern.flat and len(pattern.joints) <= MOST_ALIKE:
        meant = Tolerances.of(pattern.precision.size)
        for classes in alike_classes(pattern.sheet, pattern.linkage, pattern.marks, meant):
            closure = AlikeClosure(pattern.linkage, classes)
            rates = _as_marked(pattern, closure)
            if rates is not None:
                yield _Start(pattern, closure, rates, classes)
    apart = np.arange(len(pattern.linkage.angles))
    number, rates = beginning(pattern, BranchChoice())
    yield _Start(pattern, pattern.closure, rates, apart, number)
    for other, branch in enumerate(() if pattern.branches is None else pattern.branches.branches):
        rates = rates_as_marked(branch, pattern.wanted)
        if other != (number or 0) and not _against(rates, pattern.marks):
            yield _Start(pattern, pattern.closure, rates, apart, other)


def _as_marked(pattern: SheetConfiguration, closure: ClosureEquations) -> Floats | None:
    """Return rates of a motion on which no marked joint goes against its mark, the largest 1 or -1.

    By factors of the equations of second order, and Newton's method in a basis of the rates that close to first
    order: the regularised steps of `rates_near` leave seven digits of them.
    """
    quadrics = quadrics_of(pattern.linkage)
    tangent = rates_at(closure, pattern.linkage.angles)
    for weight in _WEIGHTS:
        wanted = np.where(pattern.wanted > 0.0, weight, 1.0) * pattern.wanted
        for space in islice(spaces_near(tangent, quadrics, wanted), _DEAD_ENDS):
            rates = None if space is None else rates_towards(space, wanted)
            if rates is None or not rates.any():
                continue
            rates = np.where(np.abs(rates) <= DOUBLE.zero_rate, 0.0, rates)
            if not _against(rates, pattern.marks) and np.abs(rates[rates != 0.0]).min() >= DOUBLE.moved:
                return rates
    return None


def _against(rates: Floats, marks: Floats) -> bool:
    return bool((rates * marks < -DOUBLE.zero_rate).any())


def _drivers(start: _Start) -> list[int]:
    """Return the joints that move most, of different classes, the first of those that move alike."""
    left, drivers = np.abs(start.rates) > DOUBLE.zero_rate, list[int]()
    while left.any() and len(drivers) < _DRIVERS:
        drivers.append(leading(np.where(left, start.rates, 0.0)))
        left &= start.classes != start.classes[drivers[-1]]
    return drivers


def _followed(start: _Start, driver: int, angle: float, frames: int, *, straight: bool) -> Motion:
    """Drive a joint to an angle on a motion."""
    pattern, joints = start.pattern, start.pattern.joints
    goal = float(np.sign(start.rates[driver])) * angle
    limited = np.ones(len(joints), dtype=bool)
    immobile, allowance = tuple[int, ...](), Allowance(_STEPS)
    if start.branch is not None and pattern.branches is not None:
        immobile = pattern.branches.branch(start.branch).immobile
    options = PathOptions(start.rates, limited, straight, names=joints, allowance=allowance, locked=immobile)
    goals = [[goal * (number + 1) / frames] for number in range(frames)]
    path = driven_path(start.closure, pattern.linkage.angles, [driver], goals, options=options)
    return motion_along(pattern, DrivenMotion(start.branch, [driver], {joints[driver]: goal}, path))
