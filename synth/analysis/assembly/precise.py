"""Closure equations in ball arithmetic: solutions certified, and paths followed with more digits.

Theory: docs/theory/positions.md.
"""

from typing import Any

import numpy as np

from graphs.tolerances import DOUBLE
from graphs.types import Flags
from synth.analysis.assembly.family import SMALL, Family
from synth.analysis.assembly.kernel import ARRIVED, DIRECTION, FAR, SLIDE, STOPPED, Complexes

_BITS = 160
_RADIUS = 2.0**-70
"""Half the side of the box in which a solution is proved to be, and to be the only one: radians and extents."""
_NEWTON = 6
_NUDGE = 1e-18
_FIRST = 0.02
"""First step of the parameter from 0 to 1."""
_LARGEST = 0.1
"""Longest step: longer ones could jump to a neighbouring path."""
_LEAST = 1e-14
"""A path that needs shorter steps is lost: with 160 bits such steps are still resolved."""
_MOST = 1500
_FAR = 45.0
"""Imaginary part of an angle, and logarithm of the length of a slide, that have gone to infinity."""


class _Equations:
    """Closure of a family, in numbers of python-flint: complex balls."""

    def __init__(self, family: Family) -> None:
        from flint import acb, acb_mat, ctx

        self.acb, self.matrix, self.context = acb, acb_mat, ctx
        self.loops = [[int(axis) for axis in loop if axis >= 0] for loop in family.loops]
        self.signs = [[int(sign) for sign in signs] for signs in family.signs]
        self.kinds, self.column = family.axes.tolist(), family.column.tolist()
        self.unknowns = family.unknowns

    def numbers(self, values: Complexes) -> list[Any]:
        return [self.acb(float(value.real), float(value.imag)) for value in values]

    def at(self, given: list[Any], unknowns: list[Any]) -> tuple[Any, Any]:
        """Return the residual, [3 L], and its derivatives, [3 L, U], as matrices: as `kernel.evaluated` does."""
        acb, cuts = self.acb, given[len(given) - 4 * len(self.loops) :]
        axes, turns = zip(*(self._placed(number, given, unknowns) for number in range(len(self.kinds))), strict=True)
        rows = [[acb(0)] * self.unknowns for _ in range(3 * len(self.loops))]
        residual: list[Any] = []
        for number, (loop, signs) in enumerate(zip(self.loops, self.signs, strict=True)):
            curved = int(self.kinds[loop[0]][1] == DIRECTION)
            whole = (acb(1), acb(0), acb(0), acb(0))
            own: dict[int, tuple[Any, ...]] = {}
            for axis, sign in zip(loop, signs, strict=False):
                place = self.column[self.kinds[axis][0]]
                if place >= 0:
                    # a derivative puts half the axis, a quaternion without real part, before the rotation about it
                    half = (acb(0), *(part * sign / 2 for part in axes[axis]))
                    own[place] = product(product(whole, half, curved), conjugate(whole), curved)
                turn = (turns[axis][0], *(part * sign for part in turns[axis][1:]))
                whole = product(whole, turn, curved)
            whole = product(whole, conjugate(tuple(cuts[4 * number : 4 * number + 4])), curved)
            residual += whole[1:]
            for place, half in own.items():
                for k, part in enumerate(product(half, whole, curved)[1:]):
                    rows[3 * number + k][place] = part
        return self.matrix([[value] for value in residual]), self.matrix(rows)

    def _placed(self, axis: int, given: list[Any], unknowns: list[Any]) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
        """Return an axis and the quaternion of the rotation about it."""
        acb, (joint, kind) = self.acb, self.kinds[axis]
        place = self.column[joint]
        value = unknowns[place] if place >= 0 else given[2 * len(self.kinds) - 1 - place]
        first, second = given[2 * axis], given[2 * axis + 1]
        sine, cosine = (value / 2).sin(), (value / 2).cos()
        if kind == DIRECTION:
            line = (first.sin() * second.cos(), first.sin() * second.sin(), first.cos())
        elif kind == SLIDE:
            line, sine, cosine = (-first.sin(), first.cos(), acb(0)), value / 2, acb(1)
        else:
            line = (first, second, acb(1))
        return line, (cosine, *(sine * part for part in line))


def product(one: tuple[Any, ...], other: tuple[Any, ...], curved: int) -> tuple[Any, ...]:
    """Return the product of two quaternions; of a plane, where `curved` is 0, parts 1 and 2 times each other vanish."""
    (w, x, y, z), (p, q, r, s) = one, other
    return (
        w * p - curved * (x * q + y * r) - z * s,
        w * q + x * p + y * s - z * r,
        w * r - x * s + y * p + z * q,
        w * s + curved * (x * r - y * q) + z * p,
    )


def conjugate(quaternion: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return the conjugate."""
    w, x, y, z = quaternion
    return w, -x, -y, -z


def certified(family: Family, parameters: Complexes, values: Complexes) -> Flags:
    """Return of which approximate solutions, complex[N, U], it is proved that one is there, near and alone: bool[N].

    Krawczyk's test in a box about each, after some steps of Newton's method. Where the parameters are real and an
    approximate solution is, the box is symmetric, so that the solution is real too.
    """
    equations = _Equations(family)
    before, equations.context.prec = equations.context.prec, _BITS
    try:
        given = equations.numbers(parameters)
        return np.array([_is_certified(equations, given, solution) for solution in values], dtype=bool)
    finally:
        equations.context.prec = before


def _is_certified(equations: _Equations, given: list[Any], solution: Complexes) -> bool:
    acb, matrix = equations.acb, equations.matrix
    middle = equations.numbers(solution)
    try:
        for _ in range(_NEWTON):
            middle, length = _newton(equations, given, middle)
            if length < _RADIUS:  # the next step, which would be as its square, is far smaller than the box
                break
        if np.abs(solution.imag).max(initial=0.0) == 0.0:
            middle = [acb(value.real) for value in middle]
        around = f"0 +/- {_RADIUS}"
        sides = [value + acb(around, around) for value in middle]
        residual, derivatives = equations.at(given, middle)
        inverse = _exact(derivatives, acb, matrix).inv()
        inverse = _exact(inverse, acb, matrix)
        spread = equations.at(given, sides)[1]
    except ZeroDivisionError:
        return False
    box = matrix([[side - value] for side, value in zip(sides, middle, strict=True)])
    unit = matrix([[acb(int(i == j)) for j in range(len(middle))] for i in range(len(middle))])
    moved = (unit - inverse * spread) * box - inverse * residual
    near = max(abs(value - complex(number)) for value, number in zip(map(complex, middle), solution, strict=True))
    inside = all(_within(moved[k, 0].real) and _within(moved[k, 0].imag) for k in range(len(middle)))
    return bool(inside and near <= DOUBLE.same_configuration)


def _within(part: Any) -> bool:
    """Whether a ball lies in the open interval from minus to plus the radius of the box."""
    return bool(abs(part) < _RADIUS)


def _exact(numbers: Any, acb: Any, matrix: Any) -> Any:
    """Return the middles of a matrix of balls."""
    rows = range(numbers.nrows())
    return matrix([[acb(numbers[i, j].real.mid(), numbers[i, j].imag.mid()) for j in rows] for i in rows])


def _newton(equations: _Equations, given: list[Any], unknowns: list[Any]) -> tuple[list[Any], float]:
    """Return the middles of unknowns after a step, and its length."""
    residual, derivatives = equations.at(given, unknowns)
    step = derivatives.solve(residual)
    changed = [value - step[k, 0] for k, value in enumerate(unknowns)]
    length = max((float(abs(step[k, 0]).mid()) for k in range(len(unknowns))), default=0.0)
    return [equations.acb(value.real.mid(), value.imag.mid()) for value in changed], length


def followed(family: Family, curve: tuple[Complexes, Complexes, Complexes], values: Complexes) -> tuple[Complexes, int]:
    """Follow one solution, complex[U], along a curve of members as `Family.followed` does; return its end, and how."""
    equations = _Equations(family)
    before, equations.context.prec = equations.context.prec, _BITS
    try:
        start, end, bend = (equations.numbers(each) for each in curve)
        return _followed(equations, (start, end, bend), equations.numbers(values))
    finally:
        equations.context.prec = before


def _followed(equations: _Equations, curve: tuple[list[Any], ...], here: list[Any]) -> tuple[Complexes, int]:
    acb = equations.acb
    slides = {equations.column[joint] for joint, kind in equations.kinds if kind == SLIDE}

    def member(s: Any) -> list[Any]:
        return [a + s * (b - a) + s * (1 - s) * c for a, b, c in zip(*curve, strict=True)]

    s, step, state = 0.0, _FIRST, STOPPED
    for _ in range(_MOST):
        onwards = 1.0 if s + step >= 1.0 else s + step
        try:
            tried = _predicted(equations, member, here, s, onwards)
            tried, first = _newton(equations, member(acb(onwards)), tried)
            tried, second = _newton(equations, member(acb(onwards)), tried)
            good = first <= SMALL / 10.0 and second <= first * SMALL
        except ZeroDivisionError:
            good = False
        if not good:
            step *= 0.5
            if step < _LEAST:
                break
            continue
        here, s, step = tried, onwards, min(1.7 * step, _LARGEST)
        sizes = [_size(value, place in slides) for place, value in enumerate(map(complex, here))]
        if max(sizes, default=0.0) > _FAR:
            state = FAR
            break
        if s == 1.0:
            state = ARRIVED
            break
    return np.array([complex(value) for value in here]), state


def _size(value: complex, slides: bool) -> float:
    return float(np.log(max(abs(value), 1.0))) * 3.0 if slides else abs(value.imag)


def _predicted(equations: _Equations, member: Any, here: list[Any], start: float, end: float) -> list[Any]:
    """Return where the rule of the midpoint puts the unknowns."""
    acb, half = equations.acb, 0.5 * (start + end)
    middle = [
        value + (half - start) * rate for value, rate in zip(here, _rates(equations, member, here, start), strict=True)
    ]
    rates = _rates(equations, member, middle, half)
    moved = [value + (end - start) * rate for value, rate in zip(here, rates, strict=True)]
    return [acb(value.real.mid(), value.imag.mid()) for value in moved]


def _rates(equations: _Equations, member: Any, unknowns: list[Any], s: float) -> list[Any]:
    residual, derivatives = equations.at(member(equations.acb(s)), unknowns)
    beside, _ = equations.at(member(equations.acb(s) + _NUDGE), unknowns)
    rates = derivatives.solve((residual - beside) * equations.acb(1.0 / _NUDGE))
    return [rates[k, 0] for k in range(len(unknowns))]
