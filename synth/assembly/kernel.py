"""Closure equations with complex unknowns, and solutions followed along parameters, of all paths at once.

A loop closes if the product of the quaternions of its joints is 1 or -1: its vector part is zero. About a finite
centre these are the quaternions of rotations; a plane is a sphere without curvature. Theory:
docs/theory/positions.md. `kernel.c` does the same path by path.
"""

import numpy as np
import numpy.typing as npt

from graphs.tolerances import DOUBLE
from graphs.types import Flags, Floats, Ints

Complexes = npt.NDArray[np.complex128]
Type = tuple[Ints, Floats, Ints, Ints]
"""The axes of each loop, int[L, K], filled up with -1; whether the loop passes them forwards (1) or backwards
(-1); the joint of each axis, and how its parameters give it, int[A, 2]; the place of each joint among the
unknowns, or of a driven one -1 - (its place among the driven)."""

DIRECTION, POINT, SLIDE = 0, 1, 2
"""How two parameters give an axis: tilt and turn of a direction, a point of the plane, the heading of a slide."""

Curves = tuple[Complexes, Complexes, Complexes]
"""Start, end and bend of the parameters of each path, complex[P, K]."""

STOPPED, ARRIVED, FAR = 0, 1, 2
"""What became of a path: it could not go on, is at its end, or went to infinity."""

_FIRST, _LARGEST, _LEAST = 0.05, 0.25, 1e-8
_NUDGE = 1e-6
_CORRECTIONS = 3
CLOSED = 100.0 * DOUBLE.closed
"""Loops that miss by no more are closed where angles are complex: sines, and rounding, are large there."""
_FAR, _FAR_ALONG = 30.0, 1e4
"""Imaginary part of an angle, and length of a slide in units of the extent, that have gone to infinity."""
_MOST = 5000


def placed_axes(kind: Type, parameters: Complexes, unknowns: Complexes) -> tuple[Complexes, Complexes]:
    """Return all axes, complex[P, A, 3], and the quaternions of the joints' rotations about them, complex[P, A, 4]."""
    _, _, axes_of, column = kind
    count = len(axes_of)
    direction, slide = axes_of[:, 1] == DIRECTION, axes_of[:, 1] == SLIDE
    # The driven come last, in reverse, so that place -1 is the first of them.
    values = np.concatenate([unknowns, parameters[:, : 2 * count - 1 : -1]], axis=1)[:, column[axes_of[:, 0]]]
    first, second = parameters[:, 0 : 2 * count : 2], parameters[:, 1 : 2 * count : 2]
    tilt, height = np.sin(first), np.cos(first)
    axes = np.stack(
        [
            np.where(direction, tilt * np.cos(second), np.where(slide, -tilt, first)),
            np.where(direction, tilt * np.sin(second), np.where(slide, height, second)),
            np.where(direction, height, np.where(slide, 0.0, 1.0)),
        ],
        axis=-1,
    )
    # a slide is a rotation by a small angle about an axis that is far away
    sine, cosine = np.where(slide, 0.5 * values, np.sin(0.5 * values)), np.where(slide, 1.0, np.cos(0.5 * values))
    return axes, np.concatenate([cosine[..., None], sine[..., None] * axes], axis=-1)


_FACTORS = np.array([[0, 1, 2, 3], [1, 0, 3, 2], [2, 3, 0, 1], [3, 2, 1, 0]])
"""Which part of a quaternion stands where in the matrix, [4, 4], that multiplies others by it from the right."""


def turned(kind: Type, quaternions: Complexes) -> Complexes:
    """Return the products of quaternions before and after each axis of each loop, complex[P, L, K + 1, 4]."""
    loops, signs, _, _ = kind
    sign, c = signs[..., None], _curved(kind)
    one = np.ones_like(c)
    own = np.array([[one, one, one, one], [-c, one, -one, c], [-c, one, one, -c], [-one, -one, one, one]])
    turns = quaternions[:, loops] * np.concatenate([np.ones_like(sign), sign, sign, sign], axis=-1)
    turns[:, loops < 0] = np.array([1.0, 0.0, 0.0, 0.0])  # loops are filled up with -1
    steps = turns[..., _FACTORS] * own.transpose(2, 0, 1)[:, None]
    products = np.zeros((len(turns), len(loops), loops.shape[1] + 1, 1, 4), complex)
    products[:, :, 0, 0, 0] = 1.0
    for passage in range(loops.shape[1]):
        products[:, :, passage + 1] = products[:, :, passage] @ steps[:, :, passage]
    return products[..., 0, :]


def residuals(kind: Type, parameters: Complexes, unknowns: Complexes) -> Complexes:
    """Return closure residuals, complex[P, 3 L]."""
    _, quaternions = placed_axes(kind, parameters, unknowns)
    return turned(kind, quaternions)[:, :, -1, 1:].reshape(len(unknowns), -1)


def evaluated(kind: Type, parameters: Complexes, unknowns: Complexes) -> tuple[Complexes, Complexes]:
    """Return closure residuals, complex[P, 3 L], and their derivatives by the unknowns, complex[P, 3 L, U]."""
    loops, signs, axes_of, column = kind
    axes, quaternions = placed_axes(kind, parameters, unknowns)
    products = turned(kind, quaternions)
    flat = np.ones((len(loops), 1, 3))
    flat[:, 0, 2] = _curved(kind)
    before, whole, own = products[:, :, :-1], products[:, :, -1:], axes[:, loops]
    # the axis where the joints before it have taken it, then seen from the end of the loop
    aside = _across(before, own, flat)
    columns = 0.5 * signs[..., None] * (own + 2.0 * (before[..., :1] * aside + _across(before, aside, flat)))
    columns = whole[..., :1] * columns - _across(whole, columns, flat)
    places = column[axes_of[loops, 0]]
    loop, passage = np.nonzero((loops >= 0) & (places >= 0))
    jacobian = np.zeros((len(unknowns), len(loops), unknowns.shape[1], 3), complex)
    jacobian[:, loop, places[loop, passage]] = columns[:, loop, passage]
    size = (len(unknowns), 3 * len(loops))
    return whole[:, :, 0, 1:].reshape(size), jacobian.swapaxes(2, 3).reshape(*size, unknowns.shape[1])


def _curved(kind: Type) -> Floats:
    """Return 1 for each loop about a finite centre, and 0 in a plane, float[L].

    There x and y are measured in a very large radius: products of two of them vanish.
    """
    return np.where(kind[2][kind[0][:, 0], 1] == DIRECTION, 1.0, 0.0)


def _across(quaternions: Complexes, vectors: Complexes, flat: Floats) -> Complexes:
    """Return the cross products of the vector parts of quaternions, complex[..., 4], with vectors, complex[..., 3]."""
    x, y, z = (quaternions[..., part] for part in (1, 2, 3))
    a, b, c = (vectors[..., part] for part in (0, 1, 2))
    return np.asarray(np.stack([y * c - z * b, z * a - x * c, x * b - y * a], axis=-1) * flat)


def solved(matrices: Complexes, right: Complexes) -> Complexes:
    """Return the solutions of square systems, complex[P, U]; not numbers where a matrix is singular."""
    good = np.flatnonzero(np.isfinite(matrices).all(axis=(1, 2)))
    good = good[np.linalg.slogdet(matrices[good])[0] != 0.0]
    found = np.full(right.shape, np.nan, complex)
    found[good] = np.linalg.solve(matrices[good], right[good, :, None])[..., 0]
    return found


def corrected(kind: Type, parameters: Complexes, unknowns: Complexes, steps: int) -> tuple[Floats, Floats]:
    """Correct unknowns in place; return the lengths of the first steps and the closure residuals, float[P].

    Both are infinite where a step is not determined; there the unknowns stay as they were before it.
    """
    first, good = np.zeros(len(unknowns)), np.ones(len(unknowns), dtype=bool)
    for step in range(steps):
        residual, jacobian = evaluated(kind, parameters, unknowns)
        change = solved(jacobian, residual)
        good &= np.isfinite(change).all(axis=1)
        unknowns[good] -= change[good]
        if step == 0:
            first = np.abs(change).max(axis=1, initial=0.0)
    error = np.abs(residuals(kind, parameters, unknowns)).max(axis=1, initial=0.0)
    return np.where(good, first, np.inf), np.where(good, error, np.inf)


def parameters_at(curves: Curves, s: Floats) -> Complexes:
    """Return the parameters at a place of each curve."""
    (start, end, bend), at = curves, s[:, None]
    return np.asarray(start + at * (end - start) + at * (1.0 - at) * bend)


def tangent(kind: Type, curves: Curves, s: Floats, unknowns: Complexes) -> Complexes:
    """Return the derivatives of the unknowns along curves; not numbers where these are not determined."""
    beside = residuals(kind, parameters_at(curves, s + _NUDGE), unknowns)
    here, jacobian = evaluated(kind, parameters_at(curves, s), unknowns)
    return solved(jacobian, (here - beside) / _NUDGE)


def gone_far(kind: Type, unknowns: Complexes) -> Flags:
    """Return of which paths an angle or a slide has gone to infinity."""
    _, _, axes_of, column = kind
    places = column[axes_of[:, 0]]
    values, slide = unknowns[:, places[places >= 0]], axes_of[places >= 0, 1] == SLIDE
    return np.asarray(np.where(slide, np.abs(values) > _FAR_ALONG, np.abs(values.imag) > _FAR).any(axis=1))


def followed_all(kind: Type, curves: Curves, values: Complexes, small: float) -> Ints:
    """Follow solutions along curves, each along its own, in place; return STOPPED, ARRIVED or FAR: int[P].

    Each path has its own step, which is halved where the first correction is not ``small``, radians.
    """
    ends = np.full(len(values), STOPPED)
    done, step, left = np.zeros(len(values)), np.full(len(values), _FIRST), np.arange(len(values))
    with np.errstate(all="ignore"):  # a path that cannot go on has what is no number
        for _ in range(_MOST):
            if not len(left):
                break
            here, s = values[left], done[left]
            curve = (curves[0][left], curves[1][left], curves[2][left])
            length = np.minimum(step[left], 1.0 - s)
            # predictor: Runge and Kutta's method of fourth order on the tangents
            rates = [tangent(kind, curve, s, here)]
            for part in (0.5 * length, 0.5 * length, length):
                rates.append(tangent(kind, curve, s + part, here + part[:, None] * rates[-1]))
            tried = here + length[:, None] / 6.0 * (rates[0] + 2.0 * rates[1] + 2.0 * rates[2] + rates[3])
            lands = length >= 1.0 - s
            onwards = np.where(lands, 1.0, s + length)
            # corrector: a first correction that is not small may lead to another path
            first, error = corrected(kind, parameters_at(curve, onwards), tried, _CORRECTIONS)
            good = (first <= small) & (error <= CLOSED)
            values[left[good]] = tried[good]
            far = good & gone_far(kind, tried)
            ends[left[good & lands]] = ARRIVED
            ends[left[far]] = FAR
            done[left] = np.where(good, onwards, s)
            step[left] = np.where(good, np.minimum(1.7 * length, _LARGEST), 0.5 * length)
            left = left[~far & ~(good & lands) & (good | (step[left] >= _LEAST))]
    return ends


def corrected_all(kind: Type, parameters: Complexes, values: Complexes, steps: int) -> Floats:
    """Correct solutions, in place; return their closure residuals: float[P]."""
    with np.errstate(all="ignore"):
        return corrected(kind, parameters, values, steps)[1]
