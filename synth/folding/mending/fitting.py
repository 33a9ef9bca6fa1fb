"""Vertices moved so that a crease pattern folds: configurations along its motions, all of which have to close.

The vertices and the joint angles of every configuration are unknowns of one least-squares problem, together with
angles that are meant to be alike and panels that are meant to be plane. A configuration is added farther along
whenever the ones before close, from where the moved linkage nearly goes, and then wherever a motion that is
followed stays open most. Theory: docs/theory/mending.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import radians
from typing import NamedTuple

import numpy as np
import scipy.sparse

from graphs.tolerances import DOUBLE, leading
from graphs.types import Floats
from synth.folding.mending.angles import MeantAngles
from synth.folding.mending.places import VertexPlaces
from synth.folding.mending.steps import Block, least_step
from synth.motion.closure import ClosureEquations
from synth.motion.newton import TangentSpace, corrected
from synth.motion.walk.allowance import Allowance

__all__ = ["FARTHEST_PATTERN", "Fitting"]

_TURNS = tuple(radians(turn) for turn in (12.0, 30.0, 55.0, 90.0))
"""Of the joint that moves most, at the configurations that have to close along the first motion."""
_BESIDE = tuple(radians(turn) for turn in (15.0, 50.0))
"""The same along further motions of a branch with several freedoms."""
_FOLLOWED = tuple(radians(turn) for turn in (5.0, 20.0, 40.0, 70.0, 100.0))
"""Where motions are looked at when all configurations close."""
_ADDED = 6
"""So many configurations are added, at most, where a motion stays open."""
_BEYOND = 30.0
"""What stays open by more than this times what vertices were moved by is out of reach, where panels meet."""
FARTHEST_PATTERN = 0.01
"""Vertices are displaced by this part of the extent at most: what is nearest farther off is another pattern."""
_STEP = radians(3.0)
_ENOUGH = 2
"""Configurations without which nothing is said; further ones may be out of reach, where panels meet."""
_TIGHT = 1e-14
_ROUNDS, _SLOW, _IDLE = 40, 0.7, 3
_DEAR = 0.1
"""Vertices are moved rather than angles changed, by the inverse of this."""
_STILL = 0.02
"""Loops whose joints turn by less, radians, count as if they turned by this."""
_HELD = 1e-3
"""A driven joint keeps its turn to this: it is as dear as many others."""
_LEAST_VALUE = 1e-9
_LEAST, _MOST, _SHARE = 1e-14, 1e-6, 0.1
"""Regularisation: a share of the error, between bounds. Equations may become dependent as they come to hold."""
_DENSE = 400
"""Up to so many equations of a configuration, or between vertices, matrices are full."""


@dataclass(frozen=True)
class _State:
    """Changes of the vertices, configurations float[K, J], and how readily their angles change, float[K, J]."""

    by: Floats
    poses: Floats
    weights: Floats

    def with_pose(self, angles: Floats, motion: _Motion) -> _State:
        """Return the state with one more configuration of a motion."""
        weights = np.ones_like(angles)
        weights[motion.driver], weights[list(motion.still)] = _HELD, 0.0
        return _State(self.by, np.vstack([self.poses, angles]), np.vstack([self.weights, weights]))

    def onwards(self, step: Floats) -> _State:
        """Return the state after a step in the unknowns of the least-squares problem."""
        n = len(self.by)
        turned = step[n:].reshape(self.poses.shape) * self.weights
        return _State(self.by + _DEAR * step[:n], self.poses + turned, self.weights)


class _Motion(NamedTuple):
    """A motion that begins at rates float[J], the joint that moves most, and those that do not move."""

    rates: Floats
    driver: int
    still: tuple[int, ...]

    @classmethod
    def begun(cls, rates: Floats) -> _Motion:
        """Return the motion that begins at some rates, of which some may be zero."""
        return cls(rates, leading(rates), tuple(np.flatnonzero(rates == 0.0).tolist()))

    def at(self, start: Floats, turn: float) -> float:
        """Return the angle of the driven joint after a turn, radians."""
        return float(start[self.driver] + np.sign(self.rates[self.driver]) * turn)


class Fitting:
    """Vertices that are moved, as little as may be, until motions close and the angles that are meant agree.

    Motions start at joint angles `start`, radians; `corners`, float[V, 3], are in units of the extent, about the
    middle. The allowance counts unknowns in each round. `error` says by how much the last attempt that failed did
    not close, 0 where it did not fail, and `displaced` how far a vertex was then; the error is infinite where the
    allowance was used up.
    """

    def __init__(self, places: VertexPlaces, angles: MeantAngles, start: Floats, allowance: Allowance) -> None:
        self._places, self._angles, self._start, self._allowance = places, angles, start, allowance
        self._state = _State(np.zeros(places.unknowns), np.zeros((0, len(start))), np.zeros((0, len(start))))
        self.error = self.displaced = 0.0

    @property
    def corners(self) -> Floats:
        """The vertices as they are now: float[V, 3]."""
        return self._places.moved(self._state.by)

    @property
    def moved(self) -> float:
        """The largest displacement of a vertex, in units of the extent."""
        return self._displacement(self._state)

    def at_the_pose(self) -> bool:
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
        begun = [_Motion.begun(rates) for rates in motions]
        for number, motion in enumerate(begun):
            if state is not None:
                state = self._with_motion(state, motion, most, _BESIDE if number else _TURNS)
        for _ in range(_ADDED):
            if state is None:
                return None
            worst = self._most_open(state, begun)
            if worst is None:
                fitted._state = state
                return fitted
            state = self._refitted(state.with_pose(*worst), most)
        return None

    def _displacement(self, state: _State) -> float:
        shifts = self._places.moved(state.by) - self._places.given
        return float(np.linalg.norm(shifts, axis=1).max(initial=0.0))

    def _with_motion(self, state: _State, motion: _Motion, most: float, turns: Sequence[float]) -> _State | None:
        """Return the state with configurations along a motion, all closed; None if the first ones do not close."""
        here, direction = self._start, motion.rates
        for number, turn in enumerate(turns):
            closure = self._closure(state).locked(motion.still)
            there = _near(closure, here, direction, motion.driver, motion.at(self._start, turn))
            tried = self._refitted(state.with_pose(there, motion), most)
            if tried is None:
                return None if number < min(_ENOUGH, len(turns) - 1) else state
            state = tried
            direction, here = state.poses[-1] - here, state.poses[-1]
        return state

    def _refitted(self, state: _State, most: float) -> _State | None:
        """Return what closes near a state with vertices displaced by `most` at most."""
        closed = self._closed(state)
        return None if closed is None or self._displacement(closed) > most else closed

    def _closure(self, state: _State) -> ClosureEquations:
        return ClosureEquations(self._places.linkage(self._places.moved(state.by)))

    def _most_open(self, state: _State, motions: Sequence[_Motion]) -> tuple[Floats, _Motion] | None:
        """Return the configuration along the motions that stays open most, with its motion."""
        closure, worst = self._closure(state), DOUBLE.closed
        found = None
        for motion in motions:
            locked, here, direction = closure.locked(motion.still), self._start, motion.rates
            for turn in _FOLLOWED:
                there = _near(locked, here, direction, motion.driver, motion.at(self._start, turn))
                error = closure.error(there)
                if error > _BEYOND * max(self._displacement(state), DOUBLE.closed):
                    break
                if error > worst:
                    found, worst = (there, motion), error
                direction, here = there - here, there
        return found

    def _closed(self, state: _State) -> _State | None:
        """Return what closes near a state, by Newton's method."""
        best, least, idle = state, np.inf, 0
        for _ in range(_ROUNDS):
            if not self._allowance.take(len(state.by) + state.poses.size):
                self.error = np.inf
                return None
            equations = self._equations(state)
            error = equations.error
            idle = idle + 1 if error > _SLOW * least else 0
            if error < least:
                best, least = state, error
            if error <= _TIGHT or idle == _IDLE:
                break
            state = equations.solved(state)
        if self._equations(best).unscaled > DOUBLE.closed:
            self.error, self.displaced = least, self._displacement(best)
            return None
        return best

    def _equations(self, state: _State) -> _Equations:
        """Return what does not hold, and its derivatives by the unknowns."""
        corners = self._places.moved(state.by)
        closure = ClosureEquations(self._places.linkage(corners))
        axes = self._places.motions_of_axes(corners) * _DEAR
        off, planes = self._places.off_planes(corners)
        bent, lines = self._places.off_lines(corners)
        fixed = np.concatenate([off, bent, self._angles.off(corners)])
        by_vertices = scipy.sparse.vstack([planes * _DEAR, lines * _DEAR, self._angles.by_axes() @ axes]).tocsr()
        poses = []
        for pose, weights in zip(state.poses, state.weights, strict=True):
            residual, jacobian = closure.at(pose)
            size = _sizes(jacobian, np.abs(pose - self._start))
            scale = scipy.sparse.diags(1.0 / size)
            by_angles = (scale @ jacobian @ scipy.sparse.diags(weights)).tocsr()
            poses.append(_Pose(residual, size, scale @ (closure.by_axes(pose) @ axes), by_angles))
        return _Equations(fixed, by_vertices, poses)


class _Pose(NamedTuple):
    """Equations of one configuration: what does not close, by what it is divided, and the divided derivatives."""

    residual: Floats
    size: Floats
    by_vertices: scipy.sparse.csr_matrix
    by_angles: scipy.sparse.csr_matrix


class _Equations(NamedTuple):
    """What does not hold between vertices alone, its derivatives, and the equations of all configurations."""

    fixed: Floats
    by_vertices: scipy.sparse.csr_matrix
    poses: list[_Pose]

    @property
    def error(self) -> float:
        """By how much equations do not hold, at most, as they are divided."""
        return max(
            float(np.abs(one).max(initial=0.0)) for one in (self.fixed, *(p.residual / p.size for p in self.poses))
        )

    @property
    def unscaled(self) -> float:
        """The same in radians and units of the extent."""
        return _largest([self.fixed, *(pose.residual for pose in self.poses)])

    def solved(self, state: _State) -> _State:
        """Return the state after the least step that takes all away."""
        if max([len(self.fixed), *(len(pose.residual) for pose in self.poses)]) > _DENSE:
            return self._solved_sparse(state)
        blocks = [Block(p.residual / p.size, p.by_vertices.toarray(), p.by_angles.toarray()) for p in self.poses]
        least = max(_LEAST_VALUE, _SHARE * self.error)
        change, turns = least_step(self.fixed, self.by_vertices.toarray(), blocks, least)
        return state.onwards(np.concatenate([change, *turns]))

    def _solved_sparse(self, state: _State) -> _State:
        """Return the same by regularised normal equations, of large sheets."""
        regular = min(_MOST, max(_LEAST, _SHARE * self.error))
        residual = np.concatenate([self.fixed, *(pose.residual / pose.size for pose in self.poses)])
        turning = [scipy.sparse.csr_matrix((len(self.fixed), 0)), *(pose.by_angles for pose in self.poses)]
        columns = scipy.sparse.vstack([self.by_vertices, *(pose.by_vertices for pose in self.poses)])
        matrix = scipy.sparse.hstack([columns, scipy.sparse.block_diag(turning)], format="csr")
        return state.onwards(TangentSpace(matrix, regular).step(residual))


def _largest(residuals: Sequence[Floats]) -> float:
    return max(float(np.abs(one).max(initial=0.0)) for one in residuals)


def _sizes(jacobian: scipy.sparse.csr_matrix, turned: Floats) -> Floats:
    """Return how large what does not close may be in each equation: near a singular pose it is of second order.

    That of the largest turn of a joint of its loop, float[rows]: some loops may move much less than others.
    """
    starts, ends = jacobian.indptr[:-1], jacobian.indptr[1:]
    largest = np.zeros(len(starts))
    some = ends > starts
    largest[some] = np.maximum.reduceat(turned[jacobian.indices], starts[some])
    return np.asarray(np.clip(largest, _STILL, 1.0) ** 2)


def _near(closure: ClosureEquations, here: Floats, direction: Floats, driver: int, goal: float) -> Floats:
    """Return a pose that closes as well as it can, with the driven joint at its goal."""
    steps = max(1, int(np.ceil(abs(goal - here[driver]) / _STEP)))
    for at in np.linspace(here[driver], goal, steps + 1)[1:]:
        expected = here + direction * ((at - here[driver]) / direction[driver])
        expected[driver] = at
        there = corrected(closure, expected, [driver]).angles
        direction, here = there - here, there
    return here
