"""Families of special geometry: flat sheets that may fold, axes in space that may move, although counts say no.

A family of sheets draws the type with further conditions: flat-foldable vertices, a symmetry, straight lines,
parallel creases. A family of axes adds conditions to those of the type: a symmetry, groups of axes that are
parallel or meet, equal links, configurations along a motion that close.

Axes that meet conditions are found by damped least squares. The unknowns are rows of six numbers: a point and a
direction for each joint, then for each centre, of which a finite one uses the point, one at infinity the direction.
Conditions are polynomials that are to be zero; they take complex numbers and leading dimensions, so that all
derivatives come from one call (a complex step, exact for polynomials). Theory: docs/theory/realisation.md.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations, islice
from math import ceil, cos, lcm, pi, radians, sin
from typing import Any

import networkx as nx
import numpy as np
import numpy.typing as npt

from graphs.errors import UnsolvableError, numbered
from graphs.geometry import lines_meet, unit
from graphs.least_squares.levenberg_marquardt import LevenbergMarquardt, System, least_squares
from graphs.loops.loop import Centre, signed_cycle
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.rank.exact import independent_cycles
from graphs.tolerances import DOUBLE, leading
from graphs.types import Floats
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.derivatives import dependence_on_axes
from synth.analysis.motion.linkage import Linkage, linkage_of_axes
from synth.analysis.motion.walk.step import Allowance
from synth.catalogue.realisation.conditions import (
    Condition,
    DrawingConditions,
    agreeing_ratios,
    bent_line,
    bundles,
    flat_folding,
    panels_between_vertices,
    parallel_creases,
    straight_lines,
    symmetries,
)
from synth.catalogue.realisation.drawing import drawings
from synth.catalogue.realisation.pattern import Pattern, sheet_of_places

Unknowns = npt.NDArray[Any]
"""Float or complex [..., rows, 6]."""
AxisCondition = Callable[[Unknowns], Unknowns]
"""Of unknowns [..., rows, 6]: numbers [..., n] that are to be zero."""

_STEP = 2.0**-100
"""Complex step: its square is lost beside 1, and polynomials have no other error."""


@dataclass(frozen=True, slots=True)
class AxisGroup:
    """Axes, by their places, that meet in a finite centre, or are parallel for one at infinity."""

    joints: tuple[int, ...]
    centre: Centre


@dataclass(frozen=True, slots=True)
class AxisSymmetry:
    """An isometry about the origin, float[3, 3], that takes each row of the unknowns to another."""

    image: tuple[int, ...]
    matrix: Floats


def derivatives(condition: AxisCondition, unknowns: Floats) -> Floats:
    """Return the derivatives of a condition by all unknowns: float[n, 6 rows]."""
    size = unknowns.size
    steps = (1j * _STEP * np.eye(size)).reshape(size, *unknowns.shape)
    return np.asarray(condition(unknowns + steps).imag.T / _STEP)


def normal(joints: int) -> AxisCondition:
    """Return that directions are unit vectors, and the points of the axes about 1 from the origin."""

    def condition(rows: Unknowns) -> Unknowns:
        points, directions = rows[..., :joints, :3], rows[..., 3:]
        size = (points**2).sum(axis=(-1, -2))[..., None] / joints - 1.0
        return np.concatenate([(directions**2).sum(axis=-1) - 1.0, size], axis=-1)

    return condition


def meeting(groups: Sequence[AxisGroup], joints: int) -> AxisCondition:
    """Return that the axes of each group meet in its centre; row ``joints + k`` is the centre of group k."""

    def condition(rows: Unknowns) -> Unknowns:
        parts = [np.zeros((*rows.shape[:-2], 0))]
        for number, group in enumerate(groups):
            axes, centre = rows[..., list(group.joints), :], rows[..., joints + number, None, :]
            if group.centre is Centre.FINITE:
                parts.append(_flat(np.cross(axes[..., :3] - centre[..., :3], axes[..., 3:])))
            else:
                parts.append(_flat(np.cross(axes[..., 3:], np.broadcast_to(centre[..., 3:], axes[..., 3:].shape))))
        return np.concatenate(parts, axis=-1)

    return condition


def symmetric(motion: AxisSymmetry, joints: int) -> AxisCondition:
    """Return that an isometry takes each axis, and each centre, to its image."""
    image = list(motion.image)

    def condition(rows: Unknowns) -> Unknowns:
        moved = np.concatenate([rows[..., :3] @ motion.matrix.T, rows[..., 3:] @ motion.matrix.T], axis=-1)
        there = rows[..., image, :]
        apart = moved[..., :3] - there[..., :3]
        parallel = np.cross(moved[..., 3:], there[..., 3:])
        on_axes = np.cross(apart[..., :joints, :], there[..., :joints, 3:])
        return np.concatenate([_flat(parallel), _flat(on_axes), _flat(apart[..., joints:, :])], axis=-1)

    return condition


def equal_links(loop: Sequence[int]) -> AxisCondition:
    """Return that the links of a loop have right twists, equal lengths and no offsets.

    Points of axes are then the feet of both common normals.
    """
    here, after = list(loop), [*loop[1:], loop[0]]

    def condition(rows: Unknowns) -> Unknowns:
        axis, following = rows[..., here, :], rows[..., after, :]
        between = following[..., :3] - axis[..., :3]
        squares = (between**2).sum(axis=-1)
        return np.concatenate(
            [
                (between * axis[..., 3:]).sum(axis=-1),
                (between * following[..., 3:]).sum(axis=-1),
                (axis[..., 3:] * following[..., 3:]).sum(axis=-1),
                squares - squares[..., :1] / 2.0 - squares[..., -1:] / 2.0,
            ],
            axis=-1,
        )

    return condition


def _flat(vectors: Unknowns) -> Unknowns:
    return vectors.reshape(*vectors.shape[:-2], -1)


@dataclass(frozen=True, slots=True, kw_only=True)
class _MotionSearch:
    """Configurations along a motion at which loops have to close, and what a step costs."""

    turn: float
    most: int
    unit_of_work: float


_MOTION = _MotionSearch(
    turn=radians(12.0),  # of the driven joint: rates lead so far, and what is immobile does not close there
    most=5,  # configurations besides the reference: after these more equations than any linkage has dimensions
    unit_of_work=60.0,  # unknowns of a step that is a unit of work; one with more counts in proportion
)

_CONDITIONS = LevenbergMarquardt(
    first=1e-2,  # a start is random, with axes about 1 from each other
    least=1e-16,  # conditions may be dependent where they hold, so that some damping is needed to the end
    most=1e6,  # steps are then a millionth of the gradient
    raised=4.0,
    lowered=(8.0,),  # twice what one rejected step takes back: random starts have few
    required=1e-3,  # a search that gains less has come to rest, where conditions contradict each other
    most_steps=40,  # a start that needs more is not near a member, and another one costs as much
)
"""Axes that meet conditions."""


def linkage_at(graph: SCGraph, axes: Floats) -> Linkage:
    """Return a linkage with axes float[J, 6], a point and a direction each."""
    pairs = zip(graph.joints, axes.tolist(), strict=True)
    return linkage_of_axes(graph, {joint: (axis[:3], axis[3:]) for joint, axis in pairs})


def axes_meeting(conditions: Sequence[AxisCondition], start: Floats, work: Allowance) -> Floats | None:
    """Return unknowns near a start, float[rows, 6], that meet conditions; None if none were found."""
    solution = _solved(lambda unknowns: _stacked(conditions, unknowns.reshape(start.shape)), start.ravel(), work)
    return None if solution is None else solution.reshape(start.shape)


def axes_along_a_motion(
    graph: SCGraph, conditions: Sequence[AxisCondition], start: Floats, work: Allowance
) -> Floats | None:
    """Return unknowns near a start that meet conditions, with loops that close at configurations along one motion.

    The start, float[rows, 6], meets the conditions. None if not all configurations closed.
    """
    # The axes at the reference, and the joint angles of the configurations, are unknowns of one problem: one joint
    # is driven by twelve degrees from one configuration to the next. One is added when those before close.
    joints = len(graph.joints)
    closure = ClosureEquations(linkage_at(graph, start[:joints]))
    jacobian = closure.at(np.zeros(joints))[1].toarray()
    rates = np.linalg.eigh(jacobian.T @ jacobian)[1][:, 0]
    configurations = _Configurations(graph, conditions, start.shape, leading(rates))
    rates = rates / rates[configurations.driver]
    rows, angles = start, np.zeros((1, joints))
    # each configuration adds equations: after so many no dimension, or a few, is left to choose
    each = closure.rows - (closure.joints - 1)
    needed = min(_MOTION.most, ceil((4 * closure.joints - 7) / max(each, 1)) + 1)
    for number in range(1, needed + 1):
        angles = np.vstack([angles, angles[-1] + rates * _MOTION.turn])
        solution = _solved(configurations.system(number), configurations.joined(rows, angles[1:]), work)
        if solution is None:
            return None
        rows, at_configurations = configurations.parted(solution, number)
        angles = np.vstack([np.zeros((1, joints)), at_configurations])
        rates = (angles[-1] - angles[-2]) / _MOTION.turn
    return rows


@dataclass(frozen=True)
class _Configurations:
    """Unknowns of axes, and of the angles of all joints but the driven one at each configuration."""

    graph: SCGraph
    conditions: Sequence[AxisCondition]
    shape: tuple[int, ...]
    driver: int

    @property
    def _free(self) -> list[int]:
        return [place for place in range(len(self.graph.joints)) if place != self.driver]

    def joined(self, rows: Floats, angles: Floats) -> Floats:
        """Return axes and angles, float[K, J], as one vector of unknowns."""
        return np.concatenate([rows.ravel(), angles[:, self._free].ravel()])

    def parted(self, unknowns: Floats, number: int) -> tuple[Floats, Floats]:
        """Return axes and angles of a number of configurations."""
        size = int(np.prod(self.shape))
        angles = np.zeros((number, len(self.graph.joints)))
        angles[:, self._free] = unknowns[size:].reshape(number, -1)
        angles[:, self.driver] = _MOTION.turn * np.arange(1, number + 1)
        return unknowns[:size].reshape(self.shape), angles

    def system(self, number: int) -> System:
        """Return the system of conditions and closure equations for a number of configurations."""
        joints, free = len(self.graph.joints), self._free

        def system(unknowns: Floats) -> tuple[Floats, Floats]:
            rows, angles = self.parted(unknowns, number)
            linkage = linkage_at(self.graph, rows[:joints])
            closure, by_numbers = ClosureEquations(linkage), dependence_on_axes(linkage).twists
            residual, by_rows = _stacked(self.conditions, rows)
            residuals, size = [residual], rows.size
            jacobians = [np.hstack([by_rows, np.zeros((len(residual), number * len(free)))])]
            for place, at in enumerate(angles):
                residual, by_angles = closure.at(at)
                jacobian = np.zeros((len(residual), size + number * len(free)))
                jacobian[:, : 6 * joints] = (closure.by_axes(at) @ by_numbers).toarray()
                jacobian[:, size + place * len(free) : size + (place + 1) * len(free)] = by_angles.toarray()[:, free]
                residuals.append(residual)
                jacobians.append(jacobian)
            return np.concatenate(residuals), np.vstack(jacobians)

        return system


def _stacked(conditions: Sequence[AxisCondition], rows: Floats) -> tuple[Floats, Floats]:
    """Return the residual of all conditions, and the Jacobian."""
    residuals = [np.asarray(condition(rows)) for condition in conditions]
    return np.concatenate(residuals), np.concatenate([derivatives(condition, rows) for condition in conditions])


def _solved(system: System, start: Floats, work: Allowance) -> Floats | None:
    """Return unknowns at which all is zero, near a start; None if the search came to rest elsewhere."""
    each = max(1.0, len(start) / _MOTION.unit_of_work)
    end = least_squares(system, start, _CONDITIONS, may_try=lambda: work.take(each))
    assert end is not None
    return end.at.unknowns if np.abs(end.at.residual).max(initial=0.0) <= DOUBLE.closed else None


_MODES = 4
"""Choices of modes tried per start: signs have to agree round panels too, which no condition ensures."""
_BENT = (radians(10.0), radians(40.0))
"""Range of the bend of lines that a symmetry allows to bend: in the most even drawing they are nearly straight."""


@dataclass(frozen=True)
class SheetFamily:
    """Flat sheets of a type that obey further conditions.

    Lines may be `bent` by a random angle; `ratios` of half-angle tangents may have to agree round panels, in
    random modes of the vertices.
    """

    name: str
    wishes: DrawingConditions
    bent: bool = False
    ratios: bool = False

    def members(self, pattern: Pattern, seed: int, tries: int, work: Allowance) -> Iterator[tuple[int, Sheet]]:
        """Yield drawings as sheets, the longer side about 1, with the number of the try."""
        if not (self.bent or self.ratios):
            for drawing in drawings(pattern, seed, tries, self.wishes, work):
                yield drawing.number, _sheet(pattern, drawing.places)
            return
        for number in range(_MODES * tries if self.ratios else tries):
            random = np.random.default_rng((seed, number))
            wishes = replace(self.wishes, others=(*self.wishes.others, *self._random(pattern, random)))
            first = number + self.ratios  # the most even drawing has ratios of nothing
            for drawing in drawings(pattern, seed, 1, wishes, work, first=first):
                yield number, _sheet(pattern, drawing.places)
            if work.used_up:
                return

    def _random(self, pattern: Pattern, random: np.random.Generator) -> Iterator[Condition]:
        if self.ratios:
            yield agreeing_ratios(pattern, (random.random(len(pattern.inner)) < 0.5).tolist())
        if self.bent:
            condition = bent_line(pattern, float(random.uniform(*_BENT) * random.choice([-1.0, 1.0])))
            assert condition is not None
            yield condition


def _sheet(pattern: Pattern, places: Floats) -> Sheet:
    places = places - places.min(axis=0)
    return sheet_of_places(pattern, places / places.max())


def sheet_families(pattern: Pattern) -> list[SheetFamily]:
    """Return the families to try, in order; flat-foldable ones only where all vertices can be flat-foldable."""
    conditions = _of_lines(pattern)
    groups, bendable = symmetries(pattern), bool(bundles(pattern))
    families = []
    for flat in (True, False) if _can_fold_flat(pattern) else (False,):
        head = ("flat-foldable",) if flat else ()
        families += [
            SheetFamily(", ".join((*head, name)), DrawingConditions(flat, None, on)) for name, on in conditions
        ]
        for group in groups:
            name = ", ".join((*head, str(group)))
            families.append(SheetFamily(name, DrawingConditions(flat, group)))
            if bendable:
                families.append(SheetFamily(f"{name}, lines bent", DrawingConditions(flat, group), bent=True))
        if flat:
            families.append(SheetFamily("flat-foldable", DrawingConditions(True)))
        if flat and panels_between_vertices(pattern):
            name = "flat-foldable, ratios that agree round panels"
            families.append(SheetFamily(f"{name}, lines bent", DrawingConditions(True), bent=True, ratios=True))
            families.append(SheetFamily(name, DrawingConditions(True), ratios=True))
    return families


def _of_lines(pattern: Pattern) -> list[tuple[str, tuple[Condition, ...]]]:
    """Return conditions on lines and parallel creases, with their names."""
    straight: list[tuple[str, tuple[Condition, ...]]] = [
        (f"lines {number} straight", (straight_lines(pattern, bundle),))
        for number, bundle in enumerate(bundles(pattern), 1)
    ]
    parallel = parallel_creases(pattern)
    if parallel is None:
        return straight
    name = "opposite creases of panels parallel"
    both = [(f"{lines}, {name}", (*conditions, parallel)) for lines, conditions in straight]
    return [*both, (name, (parallel,)), *straight]


def _can_fold_flat(pattern: Pattern) -> bool:
    try:
        flat_folding(pattern)
    except UnsolvableError:
        return False
    return True


_MOST_SYMMETRIES = 240
"""Most symmetries of a type that are listed; rings of six have twelve, types with more are very regular."""
_KINDS = 4
"""Most kinds of symmetry that are tried, those that move most joints first."""

Image = tuple[int, ...]


def named_motions(graph: SCGraph) -> list[tuple[str, AxisSymmetry]]:
    """Return isometries by which a realisation may be symmetric, for each kind of symmetry of the type.

    Images are those of the joints, then of the centre classes. A symmetry of order two is a half turn about a
    line, or a mirror; others are rotations about a line.
    """
    joints = len(graph.joints)
    motions = []
    for image in _kinds(_automorphisms(graph)):
        order = _order(image)
        if order > 2:
            name = f"turns by {360 / order:.6g} degrees about a line"
            angle = 2.0 * pi / order
            turn = np.array([[cos(angle), -sin(angle), 0.0], [sin(angle), cos(angle), 0.0], [0.0, 0.0, 1.0]])
            motions.append((name, AxisSymmetry(image, turn)))
            continue
        fixed = f"{numbered(sum(image[place] == place for place in range(joints)), 'joint')} and "
        fixed += f"{numbered(_links_kept(graph, image), 'link')} on themselves"
        for name, diagonal in (("line", [-1.0, -1.0, 1.0]), ("plane", [1.0, 1.0, -1.0])):
            motions.append((f"{name} symmetry, {fixed}", AxisSymmetry(image, np.diag(diagonal))))
    return motions


def _automorphisms(graph: SCGraph) -> list[Image]:
    """Return the images of joints and centre classes in every symmetry but the identity."""
    joints, classes, links = list(graph.joints), graph.centre_classes(), list(graph.nodes)
    first = len(joints) + len(classes)
    kinds = ["joint"] * len(joints) + [centre_class.centre.value for centre_class in classes] + ["link"] * len(links)
    whole = nx.Graph()
    whole.add_nodes_from((node, {"kind": kind}) for node, kind in enumerate(kinds))
    number_of = {link: first + number for number, link in enumerate(links)}
    for place, ends in enumerate(graph.joints.values()):
        whole.add_edges_from((place, number_of[link]) for link in ends)
    for number, centre_class in enumerate(classes):
        members = [place for place, joint in enumerate(joints) if joint in centre_class.joints]
        whole.add_edges_from((len(joints) + number, place) for place in members)
    same_kind = nx.isomorphism.categorical_node_match("kind", None)
    matcher = nx.isomorphism.GraphMatcher(whole, whole, same_kind)
    mappings = islice(matcher.isomorphisms_iter(), _MOST_SYMMETRIES)
    images = {tuple(mapping[place] for place in range(first)) for mapping in mappings}
    return sorted(images - {tuple(range(first))})


def _kinds(images: list[Image]) -> list[Image]:
    """Return one symmetry of each class of conjugates, those that move most first."""
    left, chosen = set(images), []
    for image in images:
        if image in left:
            chosen.append(image)
            left -= {_conjugate(image, by) for by in images} | {image}

    def key(image: Image) -> tuple[int, int, Image]:
        return sum(to == place for place, to in enumerate(image)), _order(image), image

    return sorted(chosen, key=key)[:_KINDS]


def _conjugate(image: Image, by: Image) -> Image:
    return tuple(to for _, to in sorted((by[place], by[to]) for place, to in enumerate(image)))


def _links_kept(graph: SCGraph, image: Image) -> int:
    """Return how many links have their joints taken to their own joints."""
    place = {joint: number for number, joint in enumerate(graph.joints)}
    of_links = [{place[joint] for _, _, joint in graph.edges(link, keys=True)} for link in graph.nodes]
    return sum({image[joint] for joint in joints} == joints for joints in of_links)


def _order(image: Image) -> int:
    """Return the order of a permutation: the least common multiple of the lengths of its cycles."""
    return lcm(*(len(cycle) for cycle in nx.strongly_connected_components(nx.DiGraph(enumerate(image)))))


_TRIPLES = (
    ("two triples of parallel axes", Centre.INFINITE, Centre.INFINITE),
    ("three parallel axes and three through a point", Centre.INFINITE, Centre.FINITE),
    ("two triples of axes through a point each", Centre.FINITE, Centre.FINITE),
)
_NOISE = 0.3
"""How far joints of equal links start from a circle: from arbitrary places loops fold up, with coinciding axes."""
_APART = 0.02
"""Axes, and centres, that differ by less than this part of the extent, and axes of a radian, count as the same."""


@dataclass(frozen=True)
class TypeOfAxes:
    """The conditions of a type on axes: which meet in which centre, and which loops have none.

    These begin at their least place, and go on to the lesser of its neighbours.
    """

    graph: SCGraph
    meetings: tuple[AxisGroup, ...]
    spatial: tuple[tuple[int, ...], ...]


def type_of_axes(graph: SCGraph) -> TypeOfAxes:
    """Return the conditions of a type on axes."""
    place = {joint: number for number, joint in enumerate(graph.joints)}
    meetings = tuple(
        AxisGroup(tuple(sorted(place[joint] for joint in centre_class.joints)), centre_class.centre)
        for centre_class in graph.centre_classes()
    )
    spatial = []
    for loop in independent_cycles(graph):
        if loop.centre is Centre.NONE:
            cycle = tuple(place[joint] for joint, _ in signed_cycle(loop.joints, graph.joints))
            first = cycle.index(min(cycle))
            turned = cycle[first:] + cycle[:first]
            spatial.append(min(turned, turned[:1] + turned[:0:-1]))
    return TypeOfAxes(graph, meetings, tuple(spatial))


@dataclass(frozen=True)
class AxisFamily:
    """Realisations of a type whose axes obey further conditions.

    `meetings` are axes that are parallel, or meet, besides those of the type; `motion` is a symmetry, `equal` are
    loops of equal links; `configurations`: loops have to close at several configurations.
    """

    name: str
    meetings: tuple[AxisGroup, ...] = ()
    motion: AxisSymmetry | None = None
    equal: tuple[tuple[int, ...], ...] = ()
    configurations: bool = field(default=False, kw_only=True)

    def member(self, of: TypeOfAxes, random: np.random.Generator, work: Allowance) -> Floats | None:
        """Return axes of a member, float[J, 6], from a random start; None if none was found."""
        joints = len(of.graph.joints)
        groups = (*of.meetings, *self.meetings)
        conditions: list[AxisCondition] = [normal(joints), meeting(groups, joints)]
        start = random.standard_normal((joints + len(groups), 6))
        if self.motion is not None:
            conditions.append(symmetric(self.motion, joints))
            start = _carried(start, self.motion)
        for loop in self.equal:
            conditions.append(equal_links(loop))
            angles = 2.0 * np.pi * np.arange(len(loop)) / len(loop)
            circle = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(len(loop))])
            start[list(loop), :3] = circle + _NOISE * start[list(loop), :3]
        start[:, 3:] = unit(start[:, 3:])
        rows = axes_meeting(conditions, start, work)
        if rows is not None and self.configurations:
            rows = axes_along_a_motion(of.graph, conditions, rows, work)
        return None if rows is None else rows[:joints]


def _carried(start: Floats, motion: AxisSymmetry) -> Floats:
    """Return rows of which each is the image of the row before it in its cycle."""
    rows, done = start.copy(), set()
    for first in range(len(motion.image)):
        place = first
        while place not in done:
            done.add(place)
            to = motion.image[place]
            if to not in done:
                rows[to] = np.concatenate([motion.matrix @ rows[place, :3], motion.matrix @ rows[place, 3:]])
            place = to
    return rows


def axis_families(of: TypeOfAxes) -> Iterator[AxisFamily]:
    """Yield the families to try, in order: groups of axes, equal links, symmetries, configurations that close."""
    for number, loop in enumerate(of.spatial):
        where = f" in loop {number}" if len(of.spatial) > 1 else ""
        for name, first, second in _TRIPLES if len(loop) == 6 else ():
            yield AxisFamily(name + where, meetings=(AxisGroup(loop[:3], first), AxisGroup(loop[3:], second)))
    if of.spatial and all(len(loop) > 5 for loop in of.spatial):
        yield AxisFamily("equal links, right twists and no offsets", equal=of.spatial)
    motions = named_motions(of.graph)
    for name, motion in motions:
        yield AxisFamily(name, motion=motion)
    for name, motion in motions:
        if np.allclose(motion.matrix @ motion.matrix, np.eye(3)):
            yield AxisFamily(f"{name}, poses that close", motion=motion, configurations=True)
    yield AxisFamily("poses that close", configurations=True)


def solids_of(of: TypeOfAxes, axes: Floats) -> HingedSolids:
    """Return a member as a linkage of hinged solids."""
    pairs = zip(of.graph.joints, axes.tolist(), strict=True)
    return HingedSolids(of.graph, {joint: (tuple(axis[:3]), tuple(axis[3:])) for joint, axis in pairs})


def degenerate(of: TypeOfAxes, axes: Floats) -> str | None:
    """Return why axes, float[J, 6], are of no member of the type, or of one with links of no length; else None."""
    points, directions = axes[:, :3], unit(axes[:, 3:])
    turned = np.linalg.norm(np.cross(directions[:, None], directions[None]), axis=2)
    apart = np.linalg.norm(np.cross(points[:, None] - points[None], directions[None]), axis=2)
    if (np.maximum(turned, apart)[np.triu_indices(len(axes), 1)] < _APART).any():
        return "two joints have one axis"
    for loop in of.spatial:
        on = list(loop)
        if turned[np.ix_(on, on)].max() < _APART:
            return "the axes of a spatial loop are parallel"
        if lines_meet(points[on], directions[on]).off.max() < _APART:
            return "the axes of a spatial loop meet in a point"
    finite, infinite = [], []
    for group in of.meetings:
        on = list(group.joints)
        if group.centre is Centre.INFINITE:
            infinite.append(directions[on[0]])
        elif np.linalg.norm(np.cross(directions[on], directions[on[0]]), axis=1).max() < _APART:
            return "axes that meet in a point are parallel"
        else:
            finite.append(lines_meet(points[on], directions[on]).point)
    if any(np.linalg.norm(centre - other) < _APART for centre, other in combinations(finite, 2)):
        return "two centres are one"
    if any(np.linalg.norm(np.cross(centre, other)) < _APART for centre, other in combinations(infinite, 2)):
        return "two centres at infinity are one"
    return None
