"""Vertices moved so that a crease pattern folds: configurations along its motions, all of which have to close.

The vertices and the joint angles of every configuration are unknowns of one least-squares problem, together with
angles that are meant to be alike (sectors that agree within the precision of the coordinates, creases that go
straight on) and panels that are meant to be planar. A configuration is added farther along whenever the ones
before close, then wherever a motion that is followed stays open most. About flat vertices only angles between
creases count for motion. Theory: docs/theory/mending.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import pi, radians
from typing import NamedTuple

import numpy as np
import scipy

from graphs.convert.duality import SheetMechanism
from graphs.geometry import crossing, principal_axes, unit
from graphs.least_squares.gauss_newton import GaussNewton, find_root
from graphs.least_squares.stop_reason import StopReason
from graphs.loops.loop import Centre
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import Sheet
from graphs.rank.singular_values import row_space, split
from graphs.tolerances import DOUBLE, EPSILON, leading
from graphs.types import Floats, Ints
from synth.analysis.folding.derivatives import axis_motions
from synth.analysis.motion.closure import ClosureEquations, corrected
from synth.analysis.motion.linkage import Linkage
from synth.analysis.motion.tangent import TangentSpace
from synth.analysis.motion.walk.step import Allowance


class VertexPlaces:
    """Vertices that may be moved: in the plane of a flat sheet, else in space with panels kept planar.

    Lengths are in units of the extent, about the middle. `given`, float[V, 3], are the places as written, `ends`,
    int[J, 2], the vertices at the ends of each crease; `along`, float[2 or 3, 3], are the directions in which
    vertices may be moved, `unknowns` their number.
    """

    def __init__(self, sheet: Sheet, mechanism: SheetMechanism, linkage: Linkage) -> None:
        assert sheet.coordinates is not None
        self.given: Floats = (in_space(sheet.coordinates) - linkage.middle) / linkage.extent
        self.loops = linkage.loops
        parallel = Centre.INFINITE  # such axes need not stay parallel
        loops = (replace(loop, centre=Centre.NONE) if loop.centre is parallel else loop for loop in linkage.loops)
        self._linkage = replace(linkage, loops=tuple(loops))
        ends = [mechanism.hinges[joint] for joint in linkage.graph.joints]  # type: ignore[index]
        self.ends: Ints = np.array(ends, dtype=np.int64).reshape(-1, 2)
        ways = ((self.given[self.ends[:, 1]] - self.given[self.ends[:, 0]]) * linkage.directions).sum(axis=1)
        self._ways: Floats = np.sign(ways)
        sizes, directions = principal_axes(self.given)
        self.along: Floats = directions[:2] if sizes[2] <= DOUBLE.same_point * sizes[0] else np.eye(3)
        self._on_lines = np.array(list(_between(mechanism, linkage)), dtype=np.int64).reshape(-1, 3)
        self._panels = [] if len(self.along) == 2 else [panel for panel in sheet.faces if len(panel) > 3]
        self.unknowns = len(self.given) * len(self.along)
        self._into_space = scipy.sparse.kron(scipy.sparse.eye(len(self.given)), self.along.T, "csr")

    @property
    def bent(self) -> float:
        """How far vertices on creases of several pieces are off their lines, at most."""
        return float(np.abs(self.line_residual(self.given)[0]).max(initial=0.0))

    @property
    def lengths(self) -> Floats:
        """The lengths of the creases: float[J]."""
        return np.asarray(np.linalg.norm(self.given[self.ends[:, 1]] - self.given[self.ends[:, 0]], axis=1))

    def moved(self, shifts: Floats) -> Floats:
        """Return the vertices, moved by unknowns float[unknowns]: float[V, 3]."""
        return np.asarray(self.given + shifts.reshape(len(self.given), -1) @ self.along)

    def linkage(self, corners: Floats) -> Linkage:
        """Return the linkage with vertices at float[V, 3]; loops with parallel axes close with six equations."""
        ends = corners[self.ends]
        along = ends[:, 1] - ends[:, 0]
        directions = unit(along) * self._ways[:, None]
        return replace(self._linkage, points=ends.mean(axis=1), directions=directions)

    def motions_of_axes(self, corners: Floats) -> scipy.sparse.csr_matrix:
        """Return how each axis turns and shifts with the unknowns: sparse float[6 J, unknowns]."""
        return (axis_motions(self.ends, corners) @ self._into_space).tocsr()

    def line_residual(self, corners: Floats) -> tuple[Floats, scipy.sparse.csr_matrix]:
        """Return how far vertices on creases of several pieces are off their lines, with the Jacobian."""
        vertices, near, far = corners[self._on_lines.T]
        along = far - near
        sizes = np.linalg.norm(along, axis=1, keepdims=True)
        direction = along / np.where(sizes == 0.0, 1.0, sizes)
        residual = np.cross(vertices - near, direction)
        part = ((vertices - near) * direction).sum(axis=1, keepdims=True) / np.where(sizes == 0.0, 1.0, sizes)
        across = -crossing(direction) @ self.along.T
        count, free = len(vertices), len(self.along)
        rows = np.broadcast_to((3 * np.arange(count)[:, None] + np.arange(3))[..., None], across.shape).ravel()
        jacobian = scipy.sparse.csr_matrix((3 * count, self.unknowns))
        for share, which in zip((np.ones_like(part), part - 1.0, -part), self._on_lines.T, strict=True):
            columns = np.broadcast_to((free * which[:, None] + np.arange(free))[:, None], across.shape).ravel()
            values = (share[..., None] * across).ravel()
            jacobian = jacobian + scipy.sparse.csr_matrix((values, (rows, columns)), shape=jacobian.shape)
        return residual.ravel(), jacobian.tocsr()

    def plane_residual(self, corners: Floats) -> tuple[Floats, scipy.sparse.csr_matrix]:
        """Return how far vertices are off the planes of their panels, with the Jacobian by the unknowns."""
        residuals: list[Floats] = [np.zeros(0)]
        blocks: list[scipy.sparse.csr_matrix] = [scipy.sparse.csr_matrix((0, self.unknowns))]
        for panel in self._panels:
            around = np.array(panel)
            middle = corners[around] - corners[around].mean(axis=0)
            *inside, normal = principal_axes(middle)[1]
            here = middle @ normal
            # to first order the best plane takes up what is linear along the panel
            linear = np.column_stack([np.ones(len(around)), middle @ np.transpose(inside)])
            basis = row_space(linear.T)
            across = np.eye(len(around)) - basis @ basis.T
            residuals.append(across @ here)
            values = np.einsum("ij,c->ijc", across, normal).reshape(len(around), -1)
            rows, columns = np.arange(len(around))[:, None], (3 * around[:, None] + np.arange(3)).ravel()
            where = (np.broadcast_to(rows, values.shape).ravel(), np.tile(columns, len(around)))
            blocks.append(scipy.sparse.csr_matrix((values.ravel(), where), shape=(len(around), self.unknowns)))
        jacobian = scipy.sparse.vstack(blocks, format="csr")
        jacobian.eliminate_zeros()
        return np.concatenate(residuals), jacobian


def _between(mechanism: SheetMechanism, linkage: Linkage) -> Iterator[tuple[int, int, int]]:
    """Yield vertices on creases of several pieces, each with the ends of its crease."""
    for joint in linkage.graph.joints:
        near, far = mechanism.hinges[joint]  # type: ignore[index]
        inside = {vertex for edge in mechanism.pieces[joint] for vertex in edge} - {near, far}  # type: ignore[index]
        yield from ((vertex, near, far) for vertex in sorted(inside))


_ROUNDING = 3.0
"""Angles differ by this times what a coordinate's precision makes of them, at most, if they are meant to agree: both
ends of a crease are rounded, in two directions, and sums of such errors reach three times one of them."""


@dataclass(frozen=True, slots=True)
class _Sum:
    """The sum of some headings of creases, some of them reversed, modulo 180 degrees."""

    joints: tuple[int, ...]
    signs: tuple[int, ...]
    value: float


@dataclass(frozen=True, slots=True)
class _Sector:
    """From one crease to the next about a vertex: angle and error, radians."""

    joints: tuple[int, int]
    angle: float
    error: float

    @property
    def acute(self) -> float:
        """The angle, or what is left of it to 180 degrees."""
        return min(self.angle, pi - self.angle)


class MeantAngles:
    """Equations between the headings of creases of a flat sheet, by the precision of a coordinate in extents."""

    def __init__(self, places: VertexPlaces, precision: float) -> None:
        self._places = places
        self._precision = _ROUNDING * precision
        self._sums: list[_Sum] = []
        if len(places.along) == 2:
            self._normal = np.cross(*places.along)
            sectors = []
            for loop in places.loops:
                if loop.centre is Centre.FINITE:
                    round_vertex = self._sectors(loop.joints)
                    sectors += round_vertex
                    self._sums += _straight(round_vertex)
                elif loop.centre is Centre.INFINITE:
                    first, *others = loop.joints
                    self._sums += [_Sum((joint, first), (1, -1), 0.0) for joint in others]
            self._sums += _alike(sectors)

    def __len__(self) -> int:
        return len(self._sums)

    def _sectors(self, joints: Sequence[int]) -> list[_Sector]:
        """Return the sectors about the vertex in which creases meet, counterclockwise; none if they do not."""
        ends = self._places.ends[list(joints)]
        shared = set(ends[0].tolist()).intersection(*(set(pair.tolist()) for pair in ends))
        if len(shared) != 1 or len(joints) < 2:
            return []
        (vertex,) = shared
        others = np.where(ends[:, 0] == vertex, ends[:, 1], ends[:, 0])
        away = (self._places.given[others] - self._places.given[vertex]) @ self._places.along.T
        headings, errors = np.arctan2(away[:, 1], away[:, 0]), self._precision / np.linalg.norm(away, axis=1)
        order = np.argsort(headings)
        sectors = []
        for i, j in zip(order, np.roll(order, -1), strict=True):
            angle, error = float(headings[j] - headings[i]) % (2 * pi), float(errors[i] + errors[j])
            sectors.append(_Sector((joints[i], joints[j]), angle, error))
        return sectors

    def residual(self, corners: Floats) -> Floats:
        """Return by how much the equations do not hold with vertices at float[V, 3], radians."""
        ends = corners[self._places.ends]
        along = (ends[:, 1] - ends[:, 0]) @ self._places.along.T
        headings = np.arctan2(along[:, 1], along[:, 0])
        sums = [float(np.dot(headings[list(total.joints)], total.signs)) - total.value for total in self._sums]
        return np.asarray((np.array(sums) + pi / 2) % pi - pi / 2)

    def by_axes(self) -> scipy.sparse.csr_matrix:
        """Return the derivatives by small motions of the axes: sparse float[rows, 6 J]."""
        terms = [
            (row, 6 * joint + c, sign * float(self._normal[c]))
            for row, total in enumerate(self._sums)
            for joint, sign in zip(total.joints, total.signs, strict=True)
            for c in range(3)
        ]
        rows, columns, values = zip(*terms, strict=True) if terms else ((), (), ())
        shape = (len(self._sums), 6 * len(self._places.ends))
        return scipy.sparse.csr_matrix((values, (rows, columns)), shape=shape)


def _straight(sectors: Sequence[_Sector]) -> list[_Sum]:
    """Return what keeps creases straight that go on through a vertex."""
    sums = []
    for first in range(len(sectors)):
        angle, error = 0.0, sectors[first].error
        for sector in sectors[first:]:
            angle += sector.angle
            if abs(angle - pi) <= error + sector.error:
                sums.append(_Sum((sectors[first].joints[0], sector.joints[1]), (-1, 1), pi))
    return sums


def _alike(sectors: Sequence[_Sector]) -> list[_Sum]:
    """Return what makes sectors equal, or supplements, that are so within their errors."""
    convex = [sector for sector in sectors if 0.0 < sector.angle < pi - sector.error]
    rising = sorted(convex, key=lambda sector: sector.acute)
    sums: list[_Sum] = []
    for before, sector in zip([None, *rising], rising, strict=False):
        first, last = sector.joints
        if pi / 2 - sector.acute <= sector.error:
            sums.append(_Sum((first, last), (-1, 1), pi / 2))
        elif before is not None and sector.acute - before.acute <= sector.error + before.error:
            same = (sector.angle < pi / 2) == (before.angle < pi / 2)
            ours, theirs = (-1, 1), (1, -1) if same else (-1, 1)
            sums.append(_Sum((first, last, *before.joints), (*ours, *theirs), 0.0))
    return sums


def _shortest_step(
    residual: Floats, by_vertices: Floats, configurations: Sequence[_FittedConfiguration], least: float
) -> list[Floats]:
    """Return the least change of the vertices, float[u], and of the angles of each configuration, to leave no residual.

    The derivatives by the angles of a configuration are taken apart, T = U S V'. Then its equations say of each
    angle along V alone how far it has to turn for a change u of the vertices, (r + B u) / s along U, where r is its
    residual and B are the derivatives by the vertices: a least-squares problem in u alone, in which an equation
    that no angle takes away (s = 0) weighs most. Equations between vertices alone have the residual float[n] and
    derivatives float[n, u]. Singular values below `least` count as that.
    """
    unknowns = by_vertices.shape[1]
    rows, right_sides = [by_vertices / least, np.eye(unknowns)], [-residual / least, np.zeros(unknowns)]
    eliminated = []
    for configuration in configurations:
        parts = split(configuration.by_angles.toarray())
        sizes = np.full(len(configuration.residual), least)
        count = len(parts.values)
        sizes[:count] = np.maximum(parts.values, least)
        own, jacobian = (
            parts.left.T @ (configuration.residual / configuration.size),
            parts.left.T @ configuration.by_vertices.toarray(),
        )
        rows.append(jacobian / sizes[:, None])
        right_sides.append(-own / sizes)
        shares = parts.values / sizes[:count] ** 2  # of values below the least only a part: no angle turns far
        eliminated.append((parts.right[:count], shares, own[:count], jacobian[:count]))
    change = np.linalg.lstsq(np.concatenate(rows), np.concatenate(right_sides), rcond=EPSILON)[0]
    turns = (-right.T @ (shares * (own + jacobian @ change)) for right, shares, own, jacobian in eliminated)
    return [change, *turns]


FARTHEST_PATTERN = 0.01
"""Vertices are displaced by this part of the extent at most: what is nearest farther off is another pattern."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Motions:
    """At which configurations along a motion loops have to close."""

    turns: tuple[float, ...]
    beside: tuple[float, ...]
    followed: tuple[float, ...]
    added: int
    beyond: float
    step: float
    enough: int


_MOTIONS = _Motions(
    turns=tuple(map(radians, (12.0, 30.0, 55.0, 90.0))),  # of the joint that moves most: the first is where rates lead
    beside=tuple(map(radians, (15.0, 50.0))),  # along further motions of a branch with several freedoms: fewer suffice
    followed=tuple(map(radians, (5.0, 20.0, 40.0, 70.0, 100.0))),  # where motions are examined: between these turns
    added=6,  # most configurations added where a motion stays open: bounds the work on what has no such motion
    beyond=30.0,  # a residual of more times the displacement of vertices is out of reach, where panels meet
    step=radians(3.0),  # of the driven joint on the way to a configuration: Newton's method stays on its branch
    enough=2,  # configurations without which nothing is said; further ones may be out of reach, where panels meet
)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Closing(GaussNewton):
    """How vertices and angles are changed until all loops close."""

    dear: float
    least_turn: float
    held: float
    least_value: float
    least: float
    most: float
    share: float
    dense: int


_CLOSING = _Closing(
    most_steps=39,  # equations that become dependent as they hold halve their residual with each step
    solved=1e-14,
    slow=0.7,  # halving is fast enough
    patience=3,  # one or two steps may be slow where the active equations change
    dear=0.1,  # vertices are moved rather than angles changed, by the inverse: these are only to follow
    least_turn=0.02,  # radians: loops whose joints turn by less count so, else the flat state would divide by zero
    held=1e-3,  # a driven joint keeps its turn to this part: configurations are to stay apart
    least_value=1e-9,  # singular values count as this at least, or a share of the residual
    least=1e-14,  # the same of large sheets, in normal equations: as a part of the largest square
    most=1e-6,  # above it steps would be too short where the residual is large
    share=0.1,  # of the residual: equations may become dependent as they come to hold
    dense=400,  # equations of a configuration, or between vertices, whose matrices are taken apart as full ones
)
"""To where all configurations close."""


@dataclass(frozen=True)
class _State:
    """Changes of the vertices, configurations float[K, J], and how readily their angles change, float[K, J]."""

    shifts: Floats
    configurations: Floats
    weights: Floats

    def with_configuration(self, angles: Floats, motion: _Motion) -> _State:
        """Return the state with one more configuration of a motion."""
        weights = np.ones_like(angles)
        weights[motion.driver], weights[list(motion.immobile)] = _CLOSING.held, 0.0
        return _State(self.shifts, np.vstack([self.configurations, angles]), np.vstack([self.weights, weights]))

    def onwards(self, step: Floats) -> _State:
        """Return the state after a step in the unknowns of the least-squares problem."""
        n = len(self.shifts)
        turned = step[n:].reshape(self.configurations.shape) * self.weights
        return _State(self.shifts + _CLOSING.dear * step[:n], self.configurations + turned, self.weights)


class _Motion(NamedTuple):
    """A motion that begins at rates float[J], the joint that moves most, and those that do not move."""

    rates: Floats
    driver: int
    immobile: tuple[int, ...]

    def at(self, start: Floats, turn: float) -> float:
        """Return the angle of the driven joint after a turn, radians."""
        return float(start[self.driver] + np.sign(self.rates[self.driver]) * turn)


class Fitting:
    """Vertices that are moved, as little as may be, until motions close and the angles that are meant agree.

    Motions start at joint angles `start`, radians; `corners`, float[V, 3], are in units of the extent, about the
    middle. The allowance counts unknowns in each round. `error` says by how much the last attempt that failed did
    not close, 0 where it did not fail, infinite where the allowance was used up; `displaced` how far a vertex was
    then.
    """

    def __init__(self, places: VertexPlaces, angles: MeantAngles, start: Floats, allowance: Allowance) -> None:
        self._places, self._angles, self._start, self._allowance = places, angles, start, allowance
        self._state = _State(np.zeros(places.unknowns), np.zeros((0, len(start))), np.zeros((0, len(start))))
        self.error = self.displaced = 0.0

    @property
    def corners(self) -> Floats:
        """The vertices as they are now: float[V, 3]."""
        return self._places.moved(self._state.shifts)

    @property
    def moved(self) -> float:
        """The largest displacement of a vertex, in units of the extent."""
        return self._displacement(self._state)

    def at_configuration(self) -> bool:
        """Move the vertices so that angles and panels are as they are meant; tell whether they are."""
        closed = self._closed(self._state)
        if closed is not None:
            self._state = closed
        return closed is not None

    def along(self, motions: Sequence[Floats], most: float = FARTHEST_PATTERN) -> Fitting | None:
        """Return a fitting along motions too, which begin at rates float[J] each; None where there is none.

        Joints whose rate is zero are locked: the equations of what lies flat while other joints move are squares.
        A vertex is displaced by no more than `most`, in units of the extent. What closed before is kept.
        """
        fitted = Fitting(self._places, self._angles, self._start, self._allowance)
        self.error = 0.0
        state: _State | None = self._state
        begun = [_Motion(rates, leading(rates), tuple(np.flatnonzero(rates == 0.0).tolist())) for rates in motions]
        for number, motion in enumerate(begun):
            if state is not None:
                state = self._with_motion(state, motion, most, _MOTIONS.beside if number else _MOTIONS.turns)
        for _ in range(_MOTIONS.added):
            if state is None:
                return None
            worst = self._most_open(state, begun)
            if worst is None:
                fitted._state = state
                return fitted
            state = self._refitted(state.with_configuration(*worst), most)
        return None

    def _displacement(self, state: _State) -> float:
        shifts = self._places.moved(state.shifts) - self._places.given
        return float(np.linalg.norm(shifts, axis=1).max(initial=0.0))

    def _with_motion(self, state: _State, motion: _Motion, most: float, turns: Sequence[float]) -> _State | None:
        """Return the state with configurations along a motion, all closed; None if the first ones do not close."""
        here, direction = self._start, motion.rates
        for number, turn in enumerate(turns):
            closure = self._closure(state).locked(motion.immobile)
            there = _near(closure, here, direction, motion.driver, motion.at(self._start, turn))
            tried = self._refitted(state.with_configuration(there, motion), most)
            if tried is None:
                return None if number < min(_MOTIONS.enough, len(turns) - 1) else state
            state = tried
            direction, here = state.configurations[-1] - here, state.configurations[-1]
        return state

    def _refitted(self, state: _State, most: float) -> _State | None:
        """Return what closes near a state with vertices displaced by `most` at most."""
        closed = self._closed(state)
        return None if closed is None or self._displacement(closed) > most else closed

    def _closure(self, state: _State) -> ClosureEquations:
        return ClosureEquations(self._places.linkage(self._places.moved(state.shifts)))

    def _most_open(self, state: _State, motions: Sequence[_Motion]) -> tuple[Floats, _Motion] | None:
        """Return the configuration along the motions that stays open most, with its motion."""
        closure, worst = self._closure(state), DOUBLE.closed
        most_open = None
        for motion in motions:
            locked, here, direction = closure.locked(motion.immobile), self._start, motion.rates
            for turn in _MOTIONS.followed:
                there = _near(locked, here, direction, motion.driver, motion.at(self._start, turn))
                error = closure.error(there)
                if error > _MOTIONS.beyond * max(self._displacement(state), DOUBLE.closed):
                    break
                if error > worst:
                    most_open, worst = (there, motion), error
                direction, here = there - here, there
        return most_open

    def _closed(self, state: _State) -> _State | None:
        """Return what closes near a state, by Gauss and Newton's method; None where it does not or work is used up."""

        def may_step() -> bool:
            return self._allowance.take(len(state.shifts) + state.configurations.size)

        end = find_root(_FittingIterate(self, state), _CLOSING, may_step=may_step) if may_step() else None
        if end is None or end.reason is StopReason.ALLOWANCE:
            self.error = np.inf
            return None
        equations = end.at.equations
        if (
            _largest([equations.fixed, *(configuration.residual for configuration in equations.configurations)])
            > DOUBLE.closed
        ):
            self.error, self.displaced = end.at.error, self._displacement(end.at.state)
            return None
        return end.at.state

    def equations(self, state: _State) -> _Equations:
        """Return what does not hold, and its derivatives by the unknowns."""
        corners = self._places.moved(state.shifts)
        closure = ClosureEquations(self._places.linkage(corners))
        axes = self._places.motions_of_axes(corners) * _CLOSING.dear
        warped, by_planes = self._places.plane_residual(corners)
        bent, by_lines = self._places.line_residual(corners)
        fixed = np.concatenate([warped, bent, self._angles.residual(corners)])
        both = [by_planes * _CLOSING.dear, by_lines * _CLOSING.dear]
        by_vertices = scipy.sparse.vstack([*both, self._angles.by_axes() @ axes]).tocsr()
        configurations = []
        for configuration, weights in zip(state.configurations, state.weights, strict=True):
            residual, jacobian = closure.at(configuration)
            size = _sizes(jacobian, np.abs(configuration - self._start))
            scale = scipy.sparse.diags(1.0 / size)
            by_angles = (scale @ jacobian @ scipy.sparse.diags(weights)).tocsr()
            configurations.append(
                _FittedConfiguration(residual, size, scale @ (closure.by_axes(configuration) @ axes), by_angles)
            )
        return _Equations(fixed, by_vertices, configurations)


@dataclass(frozen=True)
class _FittingIterate:
    """A state as an iterate of Gauss and Newton's method."""

    fitting: Fitting
    state: _State

    @cached_property
    def equations(self) -> _Equations:
        """The equations at the state."""
        return self.fitting.equations(self.state)

    @property
    def error(self) -> float:
        """The largest residual, as divided."""
        return self.equations.error

    def onwards(self) -> _FittingIterate:
        """Return the iterate after the shortest step."""
        return _FittingIterate(self.fitting, self.equations.solved(self.state))


class _FittedConfiguration(NamedTuple):
    """Equations of one configuration: what does not close, by what it is divided, and the divided derivatives."""

    residual: Floats
    size: Floats
    by_vertices: scipy.sparse.csr_matrix
    by_angles: scipy.sparse.csr_matrix


class _Equations(NamedTuple):
    """Residuals and derivatives of equations between vertices alone, and the equations of all configurations."""

    fixed: Floats
    by_vertices: scipy.sparse.csr_matrix
    configurations: list[_FittedConfiguration]

    @property
    def error(self) -> float:
        """The largest residual, as divided."""
        return _largest(
            [self.fixed, *(configuration.residual / configuration.size for configuration in self.configurations)]
        )

    def solved(self, state: _State) -> _State:
        """Return the state after the least step that takes all away."""
        if (
            max([len(self.fixed), *(len(configuration.residual) for configuration in self.configurations)])
            > _CLOSING.dense
        ):
            return self._solved_sparse(state)
        least = max(_CLOSING.least_value, _CLOSING.share * self.error)
        return state.onwards(
            np.concatenate(_shortest_step(self.fixed, self.by_vertices.toarray(), self.configurations, least))
        )

    def _solved_sparse(self, state: _State) -> _State:
        """Return the same by regularised normal equations, of large sheets."""
        regular = min(_CLOSING.most, max(_CLOSING.least, _CLOSING.share * self.error))
        residual = np.concatenate(
            [self.fixed, *(configuration.residual / configuration.size for configuration in self.configurations)]
        )
        turning = [
            scipy.sparse.csr_matrix((len(self.fixed), 0)),
            *(configuration.by_angles for configuration in self.configurations),
        ]
        columns = scipy.sparse.vstack(
            [self.by_vertices, *(configuration.by_vertices for configuration in self.configurations)]
        )
        matrix = scipy.sparse.hstack([columns, scipy.sparse.block_diag(turning)], format="csr")
        return state.onwards(TangentSpace(matrix, regular).step(residual))


def _largest(residuals: Sequence[Floats]) -> float:
    return max(float(np.abs(residual).max(initial=0.0)) for residual in residuals)


def _sizes(jacobian: scipy.sparse.csr_matrix, turned: Floats) -> Floats:
    """Return how large residuals may be, float[rows]: squares of the largest turn of the joints of the loop."""
    starts, ends = jacobian.indptr[:-1], jacobian.indptr[1:]
    largest = np.zeros(len(starts))
    some = ends > starts
    largest[some] = np.maximum.reduceat(turned[jacobian.indices], starts[some])
    return np.asarray(np.clip(largest, _CLOSING.least_turn, 1.0) ** 2)


def _near(closure: ClosureEquations, here: Floats, direction: Floats, driver: int, goal: float) -> Floats:
    """Return a configuration that closes as well as it can, with the driven joint at its goal."""
    steps = max(1, int(np.ceil(abs(goal - here[driver]) / _MOTIONS.step)))
    for at in np.linspace(here[driver], goal, steps + 1)[1:]:
        expected = here + direction * ((at - here[driver]) / direction[driver])
        expected[driver] = at
        there = corrected(closure, expected, [driver]).angles
        direction, here = there - here, there
    return here
