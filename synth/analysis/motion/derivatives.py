"""Derivatives of a closed configuration by the dimensions of the mechanism, driven joints held.

`Sensitivity` says how joint angles follow where axes are moved, forward and adjoint; `AxisDependence` how axes
move with lines, coordinates or parameters; `BodyTree` where a tree of joints puts each link, and how that changes.
Vertices of sheets: `synth.analysis.folding.derivatives`. Theory: docs/theory/derivatives.md.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy

from graphs import geometry
from graphs.errors import UnsolvableError
from graphs.geometry import crossing
from graphs.loops.loop import Centre
from graphs.tolerances import DOUBLE
from graphs.types import Floats, Ints, LinkId
from synth.analysis.motion.closure import ClosureEquations, carried
from synth.analysis.motion.linkage import Linkage, joints_outwards
from synth.analysis.motion.tangent import TangentSpace

_NUDGE = 1e-4
"""Radians, of the differences that say whether ranks change: their error is 1e-8."""
_COMPLEX = 1e-40
_STEPS = (1.0 / 64, 1.0 / 128, 1.0 / 256)
_ALIKE = 1e-5
"""A complex step is believed if it agrees so far with differences: a modulus or a conjugate would spoil it."""


@dataclass(frozen=True, slots=True)
class AxisChange:
    """A change of the axes of a linkage at its configuration, or the gradient of a number by it.

    Attributes
    ----------
    twists : float[6 J]
        Rotation about the origin and shift of each axis in turn, in units of the extent about the middle.
    zeros : float[J]
        Change of the angles that joints have at the configuration, radians.

    Examples
    --------
    >>> tilted = AxisChange(np.eye(6)[0], np.zeros(1))
    >>> (tilted + tilted).twists.tolist()
    [2.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    """

    twists: Floats
    zeros: Floats

    def __add__(self, other: AxisChange) -> AxisChange:
        return AxisChange(self.twists + other.twists, self.zeros + other.zeros)


@dataclass(frozen=True, slots=True)
class ConfigurationChange:
    """Changes of joint angles, radians, and what the closure equations miss whatever they are: float[rows]."""

    angles: Floats
    residual: Floats


class Sensitivity:
    """The derivative of a closed configuration by the axes of its joints, driven joints held at their angles.

    Where redundant equations stay consistent this is the derivative of the configuration; the inconsistent part is
    returned as a residual. Freedoms beyond the driven joints take the least change of all joint angles.

    Parameters
    ----------
    closure : ClosureEquations
        Without locked joints: the held joints are driven.
    angles : float[J]
        A closed configuration, radians.
    driven : sequence of int, optional
        Places of the joints whose angles are held.

    Raises
    ------
    UnsolvableError
        If loops are not closed, or driven joints cannot be held: one is immobile or at a turning point, or they
        depend on each other.

    Examples
    --------
    A square four-bar in the plane, the first joint held, the second moved along x; the change of the last angle:

    >>> from graphs.loops.loop import Loop
    >>> from graphs.mechanism.sc import SCGraph
    >>> from synth.analysis.motion.linkage import linkage_of_axes
    >>> square = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3), "infinite")])
    >>> corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    >>> linkage = linkage_of_axes(square, {j: (corners[j], (0, 0, 1)) for j in range(4)})
    >>> at = Sensitivity(ClosureEquations(linkage), np.array([0.5, -0.5, 0.5, -0.5]), [0])
    >>> dependence, along_x = dependence_on_axes(linkage), np.eye(24)[6]
    >>> change, gradient = at.forward(dependence.forward(along_x)), dependence.adjoint(at.adjoint(np.eye(4)[3]))
    >>> bool(np.abs(change.residual).max() < 1e-15), bool(abs(gradient @ along_x - change.angles[3]) < 1e-14)
    (True, True)
    """

    def __init__(self, closure: ClosureEquations, angles: Floats, driven: Sequence[int] = ()) -> None:
        self.closure = closure
        self.angles = angles
        self.driven = list(driven)
        closure.check_closed(angles)
        self._jacobian = closure.at(angles)[1]
        self._space = TangentSpace(self._jacobian)
        units = np.eye(closure.joints)[self.driven]
        self._moves = np.array([self._space.free(unit) for unit in units]).reshape(units.shape).T
        products = self._moves[self.driven]
        if len(products) and float(np.linalg.eigvalsh(products)[0]) < DOUBLE.zero:
            reasons = "one is immobile or at a turning point, or they depend on each other"
            raise UnsolvableError(f"the driven joints cannot be held at this configuration: {reasons}")
        self._shares = np.linalg.inv(products)

    @cached_property
    def _by_twists(self) -> scipy.sparse.csr_matrix:
        return self.closure.by_axes(self.angles)

    @cached_property
    def degenerate(self) -> bool:
        """Whether the rank of the closure equations is below that of neighbouring configurations: no derivative.

        It is seen in the second derivatives: a self-stress w, rates r and s that keep loops closed to first order,
        and w . D^2 f (r, s) is not zero. Some infinitesimal motion begins no motion then, or motion branches meet.
        """
        first, second = self._flexes
        if not first.any():
            return False
        return self._bent(self._along(first) @ second) > DOUBLE.singular

    @cached_property
    def _flexes(self) -> Floats:
        """Two general flexes, largest rates 1; zeros if there are none. What vanishes for these does for all."""
        ways = np.random.default_rng(0).normal(size=(2, self.closure.joints))
        flexes = np.array([self._space.free(way) for way in ways])
        largest = np.abs(flexes).max(axis=1, initial=0.0, keepdims=True)
        moving = largest > DOUBLE.singular * np.abs(ways).max(axis=1, initial=0.0, keepdims=True)
        return np.where(moving, flexes / np.where(moving, largest, 1.0), 0.0)

    def _along(self, rates: Floats) -> scipy.sparse.csr_matrix:
        """Return how the derivatives of the closure equations change along rates: sparse float[rows, J]."""
        ahead, back = (self.closure.at(self.angles + way * _NUDGE * rates)[1] for way in (1.0, -1.0))
        return (ahead - back) / (2.0 * _NUDGE)

    def _bent(self, off: Floats) -> float:
        return float(np.abs(self._space.beyond(off)).max(initial=0.0))

    def _regular(self) -> None:
        if self.degenerate:
            reason = "the rank of its closure equations is below that of its neighbours"
            raise UnsolvableError(f"the configuration is singular and has no derivative: {reason}")

    def forward(self, axes: AxisChange) -> ConfigurationChange:
        """Return how the configuration follows a change of the axes.

        Raises `UnsolvableError` if the configuration is degenerate, `NumericalError` if it is nearly so.
        """
        self._regular()
        off = self._jacobian @ axes.zeros - self._by_twists @ axes.twists
        least, residual = self._space.solution(off)
        angles = least - self._moves @ (self._shares @ least[self.driven])
        angles[self.driven] = 0.0
        return ConfigurationChange(angles, -residual)

    def adjoint(self, by_angles: Floats) -> AxisChange:
        """Return the gradient by the axes of a number whose gradient by the joint angles is float[J].

        Raises `UnsolvableError` if the configuration is degenerate, `NumericalError` if it is nearly so.
        """
        self._regular()
        loads = by_angles.copy()
        loads[self.driven] = 0.0
        loads[self.driven] -= self._shares @ (self._moves.T @ loads)
        forces = self._space.forces(loads)
        return AxisChange(-(self._by_twists.T @ forces), self._jacobian.T @ forces)

    def rank_residual(self, axes: AxisChange, change: ConfigurationChange) -> float:
        """Return by how much redundant equations cease to be so with a change of the axes, and what follows it.

        Loops may stay closed to first order, and no motion be left: at a linkage's own configuration they always do.
        The number is the largest rate at which loops part, per unit of the change and of the largest joint rate;
        zero is: the change is one of mobile mechanisms.
        """
        flex = self._flexes[0]
        if not flex.any():
            return 0.0
        nudged = [self.angles + way * _NUDGE * flex for way in (1.0, -1.0)]
        ahead, back = (self.closure.by_axes(angles) @ axes.twists for angles in nudged)
        return self._bent(self._along(change.angles - axes.zeros) @ flex + (ahead - back) / (2.0 * _NUDGE))


@dataclass(frozen=True)
class AxisDependence:
    """How the axes of a linkage at its configuration change with the numbers it is made of.

    Attributes
    ----------
    twists : sparse float[6 J, n]
    zeros : sparse float[J, n]
        As of `AxisChange`, by each number.

    Examples
    --------
    A hinge along z through (r, 0, 0), by r:

    >>> from graphs.mechanism.sc import SCGraph
    >>> from synth.analysis.motion.linkage import linkage_of_axes
    >>> hinge = linkage_of_axes(SCGraph(2, [(0, 1)]), {0: ((2, 0, 0), (0, 0, 1))})
    >>> dependence_on_axes(hinge).after(np.eye(6)[:, :1]).forward(np.array([1.0])).twists.tolist()
    [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]
    """

    twists: scipy.sparse.csr_matrix
    zeros: scipy.sparse.csr_matrix

    @cached_property
    def arrays(self) -> tuple[Floats, Floats]:
        """Twists and zeros as full matrices."""
        return self.twists.toarray(), self.zeros.toarray()

    def forward(self, change: Floats) -> AxisChange:
        """Return the change of the axes with one of the numbers, float[n]."""
        return AxisChange(np.asarray(self.twists @ change), np.asarray(self.zeros @ change))

    def adjoint(self, gradient: AxisChange) -> Floats:
        """Return the gradient by the numbers, float[n], of what has a gradient by the axes."""
        return np.asarray(self.twists.T @ gradient.twists + self.zeros.T @ gradient.zeros)

    def after(self, slopes: Floats) -> AxisDependence:
        """Return the same by the m parameters on which these numbers depend, by their derivatives float[n, m]."""
        inner = scipy.sparse.csr_matrix(slopes)
        return AxisDependence((self.twists @ inner).tocsr(), (self.zeros @ inner).tocsr())


def dependence_on_axes(linkage: Linkage) -> AxisDependence:
    """Return how a linkage depends on its axes: a point and a direction of each joint in turn, float[6 J].

    Points are in the unit of the coordinates, directions are unit vectors; changes along an axis or of its length
    change nothing. Joint angles are counted from the configuration.

    Parameters
    ----------
    linkage : Linkage

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> from synth.analysis.motion.linkage import linkage_of_axes
    >>> hinge = linkage_of_axes(SCGraph(2, [(0, 1)]), {0: ((0, 0, 0), (0, 0, 1))})
    >>> dependence_on_axes(hinge).forward(np.array([0, 0, 0, 1.0, 0, 0])).twists.tolist()
    [0.0, 1.0, 0.0, 0.0, 0.0, 0.0]
    """
    turn, points = crossing(linkage.directions), crossing(linkage.points)
    blocks = np.zeros((len(turn), 6, 6))
    blocks[:, 3:, :3] = np.eye(3) / linkage.extent
    blocks[:, :3, 3:] = turn  # w = direction x change of direction
    blocks[:, 3:, 3:] = points @ turn  # v = - w x point
    joints = len(blocks)
    twists = scipy.sparse.bsr_matrix((blocks, np.arange(joints), np.arange(joints + 1)), shape=(6 * joints,) * 2)
    return AxisDependence(twists.tocsr(), scipy.sparse.csr_matrix((joints, 6 * joints)))


def spatial(linkage: Linkage) -> Linkage:
    """Return the linkage with six equations for each loop.

    Loops about a centre close with three, which do not see whether axes still meet there, or are parallel. With
    six the residual of a change does.

    Parameters
    ----------
    linkage : Linkage

    Examples
    --------
    >>> from synth.analysis.moving._configuration_of import configuration_of
    >>> from synth.catalogue.patterns import generate
    >>> linkage = configuration_of(generate("miura", rows=2, columns=2).mechanism).linkage
    >>> ClosureEquations(linkage).rows, ClosureEquations(spatial(linkage)).rows
    (3, 6)
    """
    return replace(linkage, loops=tuple(replace(loop, centre=Centre.NONE) for loop in linkage.loops))


@dataclass(frozen=True, slots=True)
class ParameterDerivatives:
    """Derivatives of n numbers by m parameters, float[n, m], by "complex step" or "differences".

    The error estimates the largest one: what the last extrapolation changed; none but rounding for a complex step.
    """

    matrix: Floats
    method: str
    error: float


def derivatives_by_parameters(function: Callable[[Floats], Floats], parameters: Floats) -> ParameterDerivatives:
    """Return the derivatives of coordinates or axes by the parameters of a generator.

    By complex steps if the function takes complex numbers and is analytic there, else by central differences of
    steps 1/64, 1/128 and 1/256 of a parameter, or of one if that is larger, extrapolated (Richardson).

    Parameters
    ----------
    function : callable
        Takes float[m], returns an array of n numbers of any shape.
    parameters : float[m]

    Examples
    --------
    >>> def corner(p):
    ...     return np.array([p[0] * np.cos(p[1]), p[0] * np.sin(p[1])])
    >>> slopes = derivatives_by_parameters(corner, np.array([2.0, np.pi / 2]))
    >>> (slopes.matrix + 0.0).round(12).tolist(), slopes.method
    ([[0.0, -2.0], [1.0, 0.0]], 'complex step')
    """
    parameters = np.asarray(parameters, dtype=float)
    columns = [_by_differences(function, parameters, place) for place in range(len(parameters))]
    matrix = np.array([column for column, _ in columns]).T.reshape(-1, len(parameters))
    error = max((error for _, error in columns), default=0.0)
    exact = _by_complex_steps(function, parameters)
    if exact is not None and np.abs(exact - matrix).max(initial=0.0) <= _ALIKE * np.abs(matrix).max(initial=1.0):
        return ParameterDerivatives(exact, "complex step", 0.0)
    return ParameterDerivatives(matrix, "differences", error)


def _by_differences(function: Callable[[Floats], Floats], parameters: Floats, place: int) -> tuple[Floats, float]:
    """Return the derivative by one parameter, and how far the last two extrapolations are apart."""
    size = max(abs(float(parameters[place])), 1.0)
    rows = []
    for step in _STEPS:
        way = np.eye(len(parameters))[place] * step * size
        ahead, back = (np.ravel(function(parameters + sign * way)) for sign in (1.0, -1.0))
        rows.append((ahead - back) / (2.0 * step * size))
    first, second = (4.0 * rows[1] - rows[0]) / 3.0, (4.0 * rows[2] - rows[1]) / 3.0
    best = (16.0 * second - first) / 15.0
    return best, float(np.abs(best - second).max(initial=0.0))


def _by_complex_steps(function: Callable[[Floats], Floats], parameters: Floats) -> Floats | None:
    """Return the derivatives by complex steps; None if the function does not take or return complex numbers."""
    columns = []
    for way in np.eye(len(parameters)):
        with warnings.catch_warnings():
            warnings.simplefilter("error", np.exceptions.ComplexWarning)
            try:
                values = np.ravel(function(parameters + 1j * _COMPLEX * way))
            except (TypeError, np.exceptions.ComplexWarning):
                return None
        if not np.iscomplexobj(values):
            return None
        columns.append(values.imag / _COMPLEX)
    return np.array(columns).T.reshape(-1, len(parameters))


class BodyTree:
    """A tree of joints that carry links, from one that stays, level by level.

    Parameters
    ----------
    linkage : Linkage
    ground : link, optional
        The fixed link; by default the first. Of a linkage in several parts, each has one.

    Attributes
    ----------
    row : dict of link to int
        The place of each link in arrays of links.

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> from synth.analysis.motion.linkage import linkage_of_axes
    >>> hinge = linkage_of_axes(SCGraph(2, [(0, 1)]), {0: ((0, 0, 0), (0, 0, 1))})
    >>> bodies = BodyTree(hinge).at(np.array([np.pi / 2]))
    >>> bodies.places(np.array([1]), np.array([[1.0, 0.0, 0.0]])).round(12).tolist()
    [[0.0, 1.0, 0.0]]
    """

    def __init__(self, linkage: Linkage, ground: LinkId | None = None) -> None:
        self.linkage = linkage
        self.row = {link: row for row, link in enumerate(linkage.graph.nodes)}
        level = dict.fromkeys(linkage.graph.nodes, 0)
        edges = []
        for near, far, place, sign in joints_outwards(linkage, ground):
            level[far] = level[near] + 1
            edges.append((level[far], self.row[near], self.row[far], place, int(sign)))
        edges.sort(key=lambda edge: edge[0])
        table = np.array(edges, dtype=np.int64).reshape(-1, 5)
        starts = np.flatnonzero(np.diff(table[:, 0], prepend=0))
        self.near, self.far, self.joints, self.signs = table[:, 1:].T
        self.levels = [slice(a, b) for a, b in zip(starts, [*starts[1:], len(table)], strict=True)]

    def at(self, angles: Floats) -> BodyPoses:
        """Return where the links are at joint angles float[J], radians."""
        linkage, joints = self.linkage, self.joints
        turned = self.signs * (angles - linkage.angles)[joints]
        steps = geometry.rotations(linkage.directions[joints], turned)
        points = linkage.points[joints]
        offsets = points - np.einsum("eij,ej->ei", steps, points)
        rotations = np.tile(np.eye(3), (len(self.row), 1, 1))
        shifts = np.zeros((len(self.row), 3))
        for level in self.levels:
            near, far = self.near[level], self.far[level]
            rotations[far] = rotations[near] @ steps[level]
            shifts[far] = shifts[near] + np.einsum("eij,ej->ei", rotations[near], offsets[level])
        return BodyPoses(self, rotations, shifts)


@dataclass(frozen=True, slots=True)
class BodyPoses:
    """Links at a configuration, as rigid motions from the configuration of the linkage.

    Twists of links are (w, v), rotation about the origin and shift, where the links now are; places are in units
    of the extent, about the middle. A point x of a link comes to R x + t, with R of `rotations` and t of `shifts`.
    """

    tree: BodyTree
    rotations: Floats
    shifts: Floats

    def _screws(self) -> Floats:
        """Return the axis of each joint of the tree where it now is, turned outwards: float[e, 6]."""
        tree = self.tree
        rotations = self.rotations[tree.near]
        axes = np.einsum("eij,ej->ei", rotations, tree.linkage.directions[tree.joints]) * tree.signs[:, None]
        points = np.einsum("eij,ej->ei", rotations, tree.linkage.points[tree.joints]) + self.shifts[tree.near]
        return np.concatenate([axes, np.cross(points, axes)], axis=1)

    def _by_axes(self) -> Floats:
        """Return the twists of far links by small motions of the axes of their joints: float[e, 6, 6]."""
        moved = carried(self.rotations, self.shifts)
        return np.asarray(moved[self.tree.near] - moved[self.tree.far])

    def forward(self, angles: Floats, axes: AxisChange) -> Floats:
        """Return the twists of links with changes of joint angles, radians, and axes: float[L, 6]."""
        tree = self.tree
        turned = (angles - axes.zeros)[tree.joints, None] * self._screws()
        steps = turned + np.einsum("eij,ej->ei", self._by_axes(), axes.twists.reshape(-1, 6)[tree.joints])
        twists = np.zeros((len(self.shifts), 6))
        for level in tree.levels:
            twists[tree.far[level]] = twists[tree.near[level]] + steps[level]
        return twists

    def derivatives(self, dependence: AxisDependence) -> tuple[Floats, Floats]:
        """Return the derivatives of all twists: by joint angles, float[L, 6, J], and by numbers, float[L, 6, n].

        These numbers are those on which the axes depend; the joint angles are held.
        """
        tree, screws = self.tree, self._screws()
        axes, zeros = dependence.arrays
        joints, numbers = zeros.shape
        own = axes.reshape(joints, 6, numbers)[tree.joints]
        steps = self._by_axes() @ own - screws[:, :, None] * zeros[tree.joints][:, None, :]
        by_angles, by_numbers = np.zeros((len(self.shifts), 6, joints)), np.zeros((len(self.shifts), 6, numbers))
        for level in tree.levels:
            near, far = tree.near[level], tree.far[level]
            by_angles[far], by_numbers[far] = by_angles[near], by_numbers[near] + steps[level]
            by_angles[far, :, tree.joints[level]] += screws[level]
        return by_angles, by_numbers

    def adjoint(self, wrenches: Floats) -> tuple[Floats, AxisChange]:
        """Return the gradients by joint angles, and by axes with these held, from that by twists, float[L, 6]."""
        tree = self.tree
        borne = wrenches.copy()
        for level in reversed(tree.levels):  # a joint bears what all links beyond it bear
            np.add.at(borne, tree.near[level], borne[tree.far[level]])
        beyond = borne[tree.far]
        angles = np.zeros(len(tree.linkage.angles))
        angles[tree.joints] = (self._screws() * beyond).sum(axis=1)
        twists = np.zeros((len(angles), 6))
        twists[tree.joints] = np.einsum("eij,ei->ej", self._by_axes(), beyond)
        return angles, AxisChange(twists.ravel(), -angles)

    def places(self, links: Ints, points: Floats) -> Floats:
        """Return where points float[N, 3] of links int[N] (rows) are: float[N, 3]."""
        return np.asarray(np.einsum("nij,nj->ni", self.rotations[links], points) + self.shifts[links])

    def places_forward(self, links: Ints, points: Floats, twists: Floats, changes: Floats) -> Floats:
        """Return how places change, float[N, 3], with twists of links and changes of the points of the linkage."""
        there, twist = self.places(links, points), twists[links]
        own = np.einsum("nij,nj->ni", self.rotations[links], changes)
        return np.asarray(np.cross(twist[:, :3], there) + twist[:, 3:] + own)

    def places_adjoint(self, links: Ints, points: Floats, by_places: Floats) -> tuple[Floats, Floats]:
        """Return the gradients by twists of links, float[L, 6], and by the points at the configuration, float[N, 3]."""
        there = self.places(links, points)
        wrenches = np.zeros((len(self.shifts), 6))
        np.add.at(wrenches, links, np.concatenate([np.cross(there, by_places), by_places], axis=1))
        return wrenches, np.einsum("nij,ni->nj", self.rotations[links], by_places)
