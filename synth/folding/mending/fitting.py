"""Vertices moved so that a crease pattern folds: poses along one motion, all of which have to close.

The vertices and the joint angles of every pose are unknowns of one least-squares problem, together with angles
that are meant to be alike and panels that are meant to be plane. A pose is added farther along whenever the ones
before close, from where the moved linkage nearly goes. Theory: docs/theory/mending.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import radians

import numpy as np
import scipy.sparse

from graphs.arrays import Floats
from graphs.canonical import leading
from graphs.tolerances import DOUBLE
from synth.folding.mending.angles import MeantAngles
from synth.folding.mending.places import VertexPlaces
from synth.motion.closure import ClosureEquations
from synth.motion.newton import TangentSpace, corrected

__all__ = ["Fitting"]

_TURNS = tuple(radians(turn) for turn in (12.0, 30.0, 55.0, 90.0))
"""Of the joint that moves most, at the poses that have to close."""
_STEP = radians(3.0)
_ENOUGH = 2
"""Poses without which nothing is said; further ones may be out of reach, where panels meet."""
_TIGHT = 1e-14
_ROUNDS, _SLOW, _IDLE = 40, 0.7, 3
_DEAR = 0.1
"""Vertices are moved rather than angles changed, by the inverse of this."""
_HELD = 1e-3
"""A driven joint keeps its turn to this: it is as dear as many others."""
_LEAST, _MOST, _SHARE = 1e-14, 1e-6, 0.1
"""Regularisation: a share of the error, between bounds. Equations may become dependent as they come to hold."""


@dataclass(frozen=True)
class _State:
    """Changes of the vertices, and poses."""

    by: Floats
    poses: Floats

    def onwards(self, step: Floats, weights: Floats) -> _State:
        """Return the state after a step in the unknowns of the least-squares problem."""
        n = len(self.by)
        return _State(self.by + _DEAR * step[:n], self.poses + step[n:].reshape(self.poses.shape) * weights)


class Fitting:
    """Vertices that are moved, as little as may be, until motions close and the angles that are meant agree.

    Motions start at joint angles `start`, radians; `corners`, float[V, 3], are in units of the extent, about the
    middle.
    """

    def __init__(self, places: VertexPlaces, angles: MeantAngles, start: Floats) -> None:
        self._places, self._angles, self._start = places, angles, start
        self._by: Floats = np.zeros(places.unknowns)

    @property
    def corners(self) -> Floats:
        """The vertices as they are now: float[V, 3]."""
        return self._places.moved(self._by)

    @property
    def moved(self) -> float:
        """The largest change of a coordinate, in units of the extent."""
        return float(np.abs(self.corners - self._places.given).max(initial=0.0))

    def at_the_pose(self) -> bool:
        """Move the vertices so that angles and panels are as they are meant; tell whether they are."""
        state = _State(self._by, np.zeros((0, len(self._start))))
        closed = self._closed(state, [])
        if closed is not None:
            self._by = closed.by
        return closed is not None

    def along(self, rates: Floats, most: float) -> bool:
        """Move the vertices so that a motion goes on that begins at rates float[J]; tell whether it does.

        A coordinate is moved by no more than `most`, in units of the extent.
        """
        driver = leading(rates)
        way = float(np.sign(rates[driver]))
        state = _State(self._by, np.zeros((0, len(self._start))))
        here, direction = self._start, rates
        for number, turn in enumerate(_TURNS):
            closure = ClosureEquations(self._places.linkage(self._places.moved(state.by)))
            there = _near(closure, here, direction, driver, float(self._start[driver] + way * turn))
            tried = self._closed(_State(state.by, np.vstack([state.poses, there])), [driver])
            if tried is None or np.abs(tried.by).max() > most:
                if number < _ENOUGH:
                    return False
                break
            state = tried
            direction, here = state.poses[-1] - here, state.poses[-1]
        self._by = state.by
        return True

    def _closed(self, state: _State, held: Sequence[int]) -> _State | None:
        """Return what closes near a state, by Newton's method."""
        weights = np.ones(len(self._start))
        weights[list(held)] = _HELD
        turns = np.abs(state.poses - self._start).max(axis=1, initial=0.0)
        sizes = np.minimum(1.0, turns) ** 2  # near a singular pose what does not close is of second order
        best, least, idle = state, np.inf, 0
        for _ in range(_ROUNDS):
            residual, matrix = self._equations(state, weights, sizes)
            error = float(np.abs(residual).max(initial=0.0))
            idle = idle + 1 if error > _SLOW * least else 0
            if error < least:
                best, least = state, error
            if error <= _TIGHT or idle == _IDLE:
                break
            regular = min(_MOST, max(_LEAST, _SHARE * error))
            state = state.onwards(TangentSpace(matrix, regular).step(residual), weights)
        error = float(np.abs(self._equations(best, weights, np.ones_like(sizes))[0]).max(initial=0.0))
        return best if error <= DOUBLE.closed else None

    def _equations(self, state: _State, weights: Floats, sizes: Floats) -> tuple[Floats, scipy.sparse.csr_matrix]:
        """Return what does not hold, and its derivatives by the unknowns."""
        corners = self._places.moved(state.by)
        closure = ClosureEquations(self._places.linkage(corners))
        axes = self._places.motions_of_axes(corners) * _DEAR
        off, planes = self._places.off_planes(corners)
        bent, lines = self._places.off_lines(corners)
        residuals = [off, bent, self._angles.off(corners)]
        columns = [planes * _DEAR, lines * _DEAR, self._angles.by_axes() @ axes]
        turning = [scipy.sparse.csr_matrix((sum(map(len, residuals)), 0))]
        for pose, size in zip(state.poses, sizes, strict=True):
            residual, jacobian = closure.at(pose)
            residuals.append(residual / size)
            columns.append(closure.by_axes(pose) @ axes / size)
            turning.append(jacobian @ scipy.sparse.diags(weights) / size)
        both = [scipy.sparse.vstack(columns), scipy.sparse.block_diag(turning)]
        return np.concatenate(residuals), scipy.sparse.hstack(both, format="csr")


def _near(closure: ClosureEquations, here: Floats, direction: Floats, driver: int, goal: float) -> Floats:
    """Return a pose that closes as well as it can, with the driven joint at its goal."""
    steps = max(1, int(np.ceil(abs(goal - here[driver]) / _STEP)))
    for at in np.linspace(here[driver], goal, steps + 1)[1:]:
        expected = here + direction * ((at - here[driver]) / direction[driver])
        expected[driver] = at
        there = corrected(closure, expected, [driver]).angles
        direction, here = there - here, there
    return here
