"""Compiled: closure equations with complex unknowns, and solutions followed along parameters.

A loop closes if the product of the quaternions of its joints, times the conjugate of the one that it has to close to,
is a number: its vector part is zero. About a finite centre these are the quaternions of rotations; a plane is a sphere
without curvature. Theory: docs/theory/positions.md.
"""

import numpy as np
import numpy.typing as npt

from enumerate.kernel._compiled import compiled
from graphs.tolerances import DOUBLE

Complexes = npt.NDArray[np.complex128]
Places = npt.NDArray[np.int64]
Signs = npt.NDArray[np.float64]
Type = tuple[Places, Signs, Places, Places]
"""The axes of each loop, int[L, K], filled up with -1; whether the loop passes them forwards (1) or backwards
(-1); the joint of each axis, and how its parameters give it, int[A, 2]; the place of each joint among the
unknowns, or of a driven one -1 - (its place among the driven)."""

Line = tuple[Complexes, Complexes]
"""Members base + s direction, complex[parameters] each, that differ in what loops close to alone; empty for none. Then
s is the last unknown, the parameters are weights[unknowns] and c, and the last equation says that the sum of weights
times tangents of half angles (of slides lengths) and s is c."""

DIRECTION, POINT, SLIDE = 0, 1, 2
"""How two parameters give an axis: tilt and turn of a direction, a point of the plane, the heading of a slide."""

STOPPED, ARRIVED, FAR = 0, 1, 2
"""What became of a path: it could not go on, is at its end, or went to infinity."""

_FIRST, _LARGEST, _LEAST = 0.05, 0.25, 1e-12
_NUDGE = 1e-6
_CORRECTIONS = 3
CLOSED = 100.0 * DOUBLE.closed
"""Loops that miss by no more are closed where angles are complex: sines, and rounding, are large there."""
_FAR, _FAR_ALONG = 30.0, 1e4
"""Imaginary part of an angle, and length of a slide in units of the extent, that have gone to infinity."""
_MOST = 5000


@compiled
def placed_axes(kind: Type, parameters: Complexes, unknowns: Complexes) -> tuple[Complexes, Complexes]:
    """Return all axes, complex[A, 3], and the quaternions of the joints' rotations about them, complex[A, 4]."""
    axes_of, column = kind[2], kind[3]
    count = len(axes_of)
    quaternions = np.empty((count, 4), np.complex128)
    axes = np.empty((count, 3), np.complex128)
    for i in range(count):
        place = column[axes_of[i, 0]]
        value = unknowns[place] if place >= 0 else parameters[2 * count - 1 - place]
        first, second = parameters[2 * i], parameters[2 * i + 1]
        sine, quaternions[i, 0] = np.sin(0.5 * value), np.cos(0.5 * value)
        if axes_of[i, 1] == DIRECTION:
            axes[i, 0], axes[i, 1] = np.sin(first) * np.cos(second), np.sin(first) * np.sin(second)
            axes[i, 2] = np.cos(first)
        elif axes_of[i, 1] == POINT:
            axes[i, 0], axes[i, 1], axes[i, 2] = first, second, 1.0
        else:  # a slide is a rotation by a small angle about an axis that is far away
            axes[i, 0], axes[i, 1], axes[i, 2] = -np.sin(first), np.cos(first), 0.0
            sine, quaternions[i, 0] = 0.5 * value, 1.0
        quaternions[i, 1:] = sine * axes[i]
    return axes, quaternions


@compiled
def evaluated(kind: Type, parameters: Complexes, unknowns: Complexes, residual: Complexes, jacobian: Complexes) -> None:
    """Write the closure residual, complex[3 L], and its derivatives by the unknowns, complex[3 L, U]."""
    loops, signs, axes_of, column = kind
    axes, quaternions = placed_axes(kind, parameters, unknowns)
    cuts = parameters[len(parameters) - 4 * len(loops) :]
    jacobian[:] = 0.0
    for loop in range(len(loops)):
        # in a plane x and y are measured in a very large radius: products of two of them vanish
        curved = 1.0 if axes_of[loops[loop, 0], 1] == DIRECTION else 0.0
        w, x, y, z = 1.0 + 0.0j, 0.0j, 0.0j, 0.0j
        for i in range(loops.shape[1]):
            j = loops[loop, i]
            if j < 0:
                break
            sign = signs[loop, i]
            place = column[axes_of[j, 0]]
            if place >= 0:  # the axis where the joints before it have taken it
                a, b, c = axes[j, 0], axes[j, 1], axes[j, 2]
                u, v, t = y * c - z * b, z * a - x * c, curved * (x * b - y * a)
                jacobian[3 * loop, place] = 0.5 * sign * (a + 2.0 * (w * u + y * t - z * v))
                jacobian[3 * loop + 1, place] = 0.5 * sign * (b + 2.0 * (w * v + z * u - x * t))
                jacobian[3 * loop + 2, place] = 0.5 * sign * (c + 2.0 * (w * t + curved * (x * v - y * u)))
            p, q = quaternions[j, 0], sign * quaternions[j, 1]
            r, s = sign * quaternions[j, 2], sign * quaternions[j, 3]
            w, x, y, z = (
                w * p - curved * (x * q + y * r) - z * s,
                w * q + x * p + y * s - z * r,
                w * r - x * s + y * p + z * q,
                w * s + curved * (x * r - y * q) + z * p,
            )
        p, q, r, s = cuts[4 * loop], -cuts[4 * loop + 1], -cuts[4 * loop + 2], -cuts[4 * loop + 3]
        w, x, y, z = (
            w * p - curved * (x * q + y * r) - z * s,
            w * q + x * p + y * s - z * r,
            w * r - x * s + y * p + z * q,
            w * s + curved * (x * r - y * q) + z * p,
        )
        residual[3 * loop], residual[3 * loop + 1], residual[3 * loop + 2] = x, y, z
        for i in range(loops.shape[1]):
            j = loops[loop, i]
            if j < 0:
                break
            place = column[axes_of[j, 0]]
            if place >= 0:
                a, b, c = jacobian[3 * loop, place], jacobian[3 * loop + 1, place], jacobian[3 * loop + 2, place]
                jacobian[3 * loop, place] = w * a + b * z - c * y
                jacobian[3 * loop + 1, place] = w * b + c * x - a * z
                jacobian[3 * loop + 2, place] = w * c + curved * (a * y - b * x)


@compiled
def equations(
    kind: Type, line: Line, parameters: Complexes, unknowns: Complexes, residual: Complexes, jacobian: Complexes
) -> None:
    """Write the residual and its derivatives, square: of a member, or where a hyperplane meets a line of them."""
    base, direction = line
    if len(base) == 0:
        evaluated(kind, parameters, unknowns, residual, jacobian)
        return
    loops, _, axes_of, column = kind
    n, s = len(unknowns) - 1, unknowns[-1]
    evaluated(kind, base + s * direction, unknowns[:n], residual[:n], jacobian[:n, :n])
    turning = np.ones(n, np.bool_)
    for i in range(len(axes_of)):
        place = column[axes_of[i, 0]]
        if place >= 0:
            turning[place] = axes_of[i, 1] != SLIDE
    residual[n] = parameters[n] * s - parameters[n + 1]
    for i in range(n):
        value, slope = unknowns[i], 1.0 + 0.0j
        if turning[i]:
            value = np.sin(0.5 * unknowns[i]) / np.cos(0.5 * unknowns[i])
            slope = 0.5 + 0.5 * value * value
        residual[n] += parameters[i] * value
        jacobian[n, i] = parameters[i] * slope
    jacobian[n, n] = parameters[n]
    # closure is linear in what loops close to: its derivative by s is that at the direction
    away, unused, begin = base.copy(), np.empty((n, n), np.complex128), len(base) - 4 * len(loops)
    away[begin:] = direction[begin:]
    by_s = np.empty(n, np.complex128)
    evaluated(kind, away, unknowns[:n], by_s, unused)
    jacobian[:n, n] = by_s


@compiled
def solved(matrix: Complexes, right: Complexes) -> bool:
    """Solve a square system, pivots chosen by column; the solution takes the place of the right side."""
    n = len(right)
    for k in range(n):
        best, size = k, 0.0
        for i in range(k, n):
            if abs(matrix[i, k]) > size:
                best, size = i, abs(matrix[i, k])
        if size == 0.0 or not np.isfinite(size):
            return False
        if best != k:
            for j in range(k, n):
                matrix[k, j], matrix[best, j] = matrix[best, j], matrix[k, j]
            right[k], right[best] = right[best], right[k]
        for i in range(k + 1, n):
            part = matrix[i, k] / matrix[k, k]
            for j in range(k + 1, n):
                matrix[i, j] -= part * matrix[k, j]
            right[i] -= part * right[k]
    for k in range(n - 1, -1, -1):
        for j in range(k + 1, n):
            right[k] -= matrix[k, j] * right[j]
        right[k] /= matrix[k, k]
    return True


@compiled
def corrected(kind: Type, line: Line, parameters: Complexes, unknowns: Complexes, steps: int) -> tuple[float, float]:
    """Correct unknowns in place; return the length of the first step and the closure residual."""
    n = len(unknowns)
    residual, jacobian = np.empty(n, np.complex128), np.empty((n, n), np.complex128)
    first = 0.0
    for step in range(steps):
        equations(kind, line, parameters, unknowns, residual, jacobian)
        if not solved(jacobian, residual):
            return np.inf, np.inf
        length = 0.0
        for i in range(n):
            unknowns[i] -= residual[i]
            length = max(length, abs(residual[i]))
        if step == 0:
            first = length
        if not np.isfinite(length):
            return np.inf, np.inf
    equations(kind, line, parameters, unknowns, residual, jacobian)
    error = 0.0
    for i in range(n):
        error = max(error, abs(residual[i]))
    return first, error


@compiled
def parameters_at(curve: tuple[Complexes, Complexes, Complexes], s: float) -> Complexes:
    """Return the parameters at a place of a curve of start, end and bend."""
    start, end, bend = curve
    return start + s * (end - start) + s * (1.0 - s) * bend


@compiled
def tangent(
    kind: Type,
    line: Line,
    curve: tuple[Complexes, Complexes, Complexes],
    s: float,
    unknowns: Complexes,
    rates: Complexes,
) -> bool:
    """Write the derivatives of the unknowns along a curve; False if these are not determined."""
    n = len(unknowns)
    beside, jacobian = np.empty(n, np.complex128), np.empty((n, n), np.complex128)
    equations(kind, line, parameters_at(curve, s + _NUDGE), unknowns, beside, jacobian)
    equations(kind, line, parameters_at(curve, s), unknowns, rates, jacobian)
    for i in range(n):
        rates[i] = (rates[i] - beside[i]) / _NUDGE
    return solved(jacobian, rates)


@compiled
def gone_far(kind: Type, unknowns: Complexes) -> bool:
    """Return whether an angle or a slide has gone to infinity."""
    _, _, axes_of, column = kind
    for axis in range(len(axes_of)):
        place = column[axes_of[axis, 0]]
        if place >= 0:
            if axes_of[axis, 1] == SLIDE and abs(unknowns[place]) > _FAR_ALONG:
                return True
            if axes_of[axis, 1] != SLIDE and abs(unknowns[place].imag) > _FAR:
                return True
    return False


@compiled
def followed(
    kind: Type, line: Line, curve: tuple[Complexes, Complexes, Complexes], unknowns: Complexes, small: float
) -> int:
    """Follow a solution along a curve, in place; return STOPPED, ARRIVED or FAR.

    A step is halved where the first correction is not ``small``, radians.
    """
    n = len(unknowns)
    rates, tried = np.empty((4, n), np.complex128), np.empty(n, np.complex128)
    s, step = 0.0, _FIRST
    for _ in range(_MOST):
        length = min(step, 1.0 - s)
        # predictor: Runge and Kutta's method of fourth order on the tangents
        good = tangent(kind, line, curve, s, unknowns, rates[0])
        for stage in range(1, 4):
            part = length if stage == 3 else 0.5 * length
            tried[:] = unknowns + part * rates[stage - 1]
            good = good and tangent(kind, line, curve, s + part, tried, rates[stage])
        if good:
            change = rates[0] + 2.0 * rates[1] + 2.0 * rates[2] + rates[3]
            tried[:] = unknowns + length / 6.0 * change
            onwards = 1.0 if length >= 1.0 - s else s + length
            # corrector: a first correction that is not small may lead to another path
            first, error = corrected(kind, line, parameters_at(curve, onwards), tried, _CORRECTIONS)
            if first <= small and error <= CLOSED:
                unknowns[:] = tried
                if gone_far(kind, unknowns):
                    return FAR
                if onwards == 1.0:
                    return ARRIVED
                s, step = onwards, min(1.7 * length, _LARGEST)
                continue
        step = 0.5 * length
        if step < _LEAST:
            return STOPPED
    return STOPPED


@compiled
def followed_all(
    kind: Type, line: Line, curves: tuple[Complexes, Complexes, Complexes], values: Complexes, small: float
) -> Places:
    """Follow solutions along curves, each along its own, in place; return STOPPED, ARRIVED or FAR: int[P]."""
    ends = np.empty(len(values), np.int64)
    for path in range(len(values)):
        curve = (curves[0][path], curves[1][path], curves[2][path])
        ends[path] = followed(kind, line, curve, values[path], small)
    return ends


@compiled
def corrected_all(kind: Type, parameters: Complexes, values: Complexes, steps: int) -> Signs:
    """Correct solutions, in place; return their closure residuals: float[P]."""
    errors, empty = np.empty(len(values)), np.empty(0, np.complex128)
    for path in range(len(values)):
        errors[path] = corrected(kind, (empty, empty), parameters[path], values[path], steps)[1]
    return errors
