"""All points in which quadratic forms vanish together, by continuation of all paths from a start system.

Forms q_1 ... q_m in m + 1 variables have 2^m common projective points if these are finitely many, multiplicities
counted (Bezout). The system x_i^2 = x_0^2 has as many; the path of each of its points, as the start system becomes
the other one, ends in a point of that (total-degree homotopy: A. J. Sommese, C. W. Wampler, The Numerical Solution
of Systems of Polynomials Arising in Engineering and Science, World Scientific 2005, chapter 8). All paths are
followed together, each with steps of its own, in projective space: no path goes to infinity. Theory:
docs/theory/branches.md.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.tolerances import EPSILON
from graphs.types import Floats, Ints

Complexes = npt.NDArray[np.complex128]

_FIRST = 0.02
"""First step of the parameter from 1 to 0: fifty steps are enough for a path that hardly bends."""
_LEAST = 1e-9
"""A path that needs shorter steps is given up: its end is singular, or nearly so."""
_MOST = 0.1
"""Longest step: longer ones could jump to a neighbouring path."""
_NEAR = 1e-4
"""Error that a predicted point may have, of unit vectors: Newton's method squares it in each correction."""
_ALIKE = 1e-9
"""Newton's method has to come as near in its corrections, and at the end."""
_ROUNDED = 1e-14
"""A smaller correction is rounding."""
_ROUNDS = 4000
"""Rounds of steps, all paths at once, after which those that are left count as lost."""
_CORRECTIONS = 3
"""Corrections of a predicted point: from `_NEAR` they reach rounding where the step was short enough."""
_POLISHED = 6
"""Corrections at the end, where no step waits for them."""
_ORDER = 5.0
"""The local error of the predictor (Runge and Kutta's) is of this order."""


@dataclass(frozen=True, slots=True)
class PathEnds:
    """The ends of all paths: unit vectors, complex[paths, s], and which of them Newton's method settles on."""

    points: Complexes
    arrived: npt.NDArray[np.bool_]


def path_ends(forms: Floats, seed: int = 0) -> PathEnds:
    """Return the ends of the 2^m paths to the common points of m quadratic forms, float[m, m + 1, m + 1]."""
    paths = _FromSquares(forms, np.random.default_rng((seed, *forms.shape)))
    ends = followed_to_end(paths, paths.starts())
    return PathEnds(ends.points @ paths.turn.T, ends.arrived)


def followed_to_end(paths: FormPath, points: Complexes) -> PathEnds:
    """Return where points, unit vectors complex[paths, s], come to as the parameter of forms goes from 1 to 0."""
    count = len(points)
    points = points.copy()
    times, steps, alive = np.ones(count), np.full(count, _FIRST), np.ones(count, dtype=bool)
    for _ in range(_ROUNDS):
        on = np.flatnonzero(alive & (times > 0.0))
        if not len(on):
            break
        step = np.minimum(steps[on], times[on])
        end, first, last = paths.stepped(points[on], times[on], step)
        good = (first <= _NEAR) & (last <= _ALIKE)
        points[on[good]], times[on[good]] = end[good], times[on[good]] - step[good]
        ratio = (_NEAR / 2.0 / np.maximum(first, _ROUNDED)) ** (1.0 / _ORDER)
        steps[on] = np.where(good, np.minimum(step * np.clip(ratio, 0.5, 2.0), _MOST), step / 2.0)
        alive[on] = good | (steps[on] > _LEAST)
    points, off = paths.corrected(points, np.zeros(count), _POLISHED)
    return PathEnds(points, (times <= 0.0) & (off <= _ALIKE))


class FormPath(ABC):
    """Quadratic forms that depend on a parameter: what steps along the paths of their common points need."""

    count: int
    size: int

    @abstractmethod
    def evaluated(self, points: Complexes, times: Floats) -> tuple[Complexes, Complexes, Complexes]:
        """Return the forms at points, half their slopes, and their derivatives by the parameter."""

    def _matrix(self, slopes: Complexes, points: Complexes) -> Complexes:
        return np.concatenate([2.0 * slopes, points.conj()[:, None, :]], axis=1)

    def _tangent(self, points: Complexes, times: Floats) -> Complexes:
        """Return the derivative of points by the parameter, across the points themselves."""
        _, slopes, by_time = self.evaluated(points, times)
        right = np.concatenate([-by_time, np.zeros((len(points), 1))], axis=1)
        return _solved(self._matrix(slopes, points), right)

    def stepped(self, points: Complexes, times: Floats, step: Floats) -> tuple[Complexes, Floats, Floats]:
        """Return points after a step, and the first and the last correction that Newton's method made there."""
        by, half = step[:, None], step / 2.0
        one = self._tangent(points, times)
        two = self._tangent(points - by / 2.0 * one, times - half)
        three = self._tangent(points - by / 2.0 * two, times - half)
        four = self._tangent(points - by * three, times - step)
        ahead = points - by / 6.0 * (one + 2.0 * two + 2.0 * three + four)
        ahead = ahead / np.linalg.norm(ahead, axis=1, keepdims=True)
        once, first = self.corrected(ahead, times - step, 1)
        twice, last = self.corrected(once, times - step, _CORRECTIONS - 1)
        return twice, first, last

    def corrected(self, points: Complexes, times: Floats, rounds: int) -> tuple[Complexes, Floats]:
        """Return points after some rounds of Newton's method, and the length of the last correction."""
        off = np.full(len(points), np.inf)
        for _ in range(rounds):
            values, slopes, _ = self.evaluated(points, times)
            right = np.concatenate([-values, np.zeros((len(points), 1))], axis=1)
            change = _solved(self._matrix(slopes, points), right)
            off = np.linalg.norm(change, axis=1)
            points = points + change
            points = points / np.linalg.norm(points, axis=1, keepdims=True)
        return points, off


class _FromSquares(FormPath):
    """The equations t c (x_i^2 - x_0^2) + (1 - t) q_i = 0 in coordinates that are turned at random."""

    def __init__(self, forms: Floats, chance: np.random.Generator) -> None:
        self.count, self.size = forms.shape[0], forms.shape[1]
        gauss: Any = chance.normal(size=(2, self.size, self.size))
        self.turn = np.linalg.qr(gauss[0] + 1j * gauss[1])[0]
        scale = np.sqrt((forms**2).sum(axis=(1, 2), keepdims=True))
        turned = self.turn.T @ (forms / scale) @ self.turn
        self.forms = turned.reshape(-1, self.size).T.copy()  # slopes of all forms are one product
        self.factor = np.exp(2j * np.pi * chance.uniform())

    def starts(self) -> Complexes:
        """Return the points at which all squares are alike, as unit vectors."""
        signs = np.array([(1.0, *others) for others in product((1.0, -1.0), repeat=self.count)])
        return np.asarray(signs / np.sqrt(self.size), dtype=complex)

    def evaluated(self, points: Complexes, times: Floats) -> tuple[Complexes, Complexes, Complexes]:
        """Return the equations, half their slopes, and their derivatives by t."""
        slopes = (points @ self.forms).reshape(len(points), self.count, self.size)
        goal = (slopes @ points[..., None])[..., 0]
        start = self.factor * (points[:, 1:] ** 2 - points[:, :1] ** 2)
        mixed = (1.0 - times)[:, None, None] * slopes
        rows: Ints = np.arange(self.count)
        weight = self.factor * times[:, None]
        mixed[:, rows, rows + 1] += weight * points[:, 1:]
        mixed[:, :, 0] -= weight * points[:, :1]
        return times[:, None] * start + (1.0 - times)[:, None] * goal, mixed, start - goal


def _solved(matrices: Complexes, right: Complexes) -> Complexes:
    """Return the solutions of many linear systems; far from any where a matrix is singular."""
    try:
        return np.asarray(np.linalg.solve(matrices, right[..., None])[..., 0])
    except np.linalg.LinAlgError:
        shifted = matrices + EPSILON * np.eye(matrices.shape[-1])
        return np.asarray(np.linalg.solve(shifted, right[..., None])[..., 0])
