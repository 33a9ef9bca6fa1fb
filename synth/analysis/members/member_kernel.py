"""Members of a type by arrays, taken through inputs: by member_kernel.c, or by numpy where it was not built.

A loop closes if the quaternions of its joints, one after the other, undo one that links that were bent leave: the
vector part of the product is zero, as in `synth.analysis.assembly.kernel`, here of real numbers. Where joints are
driven, steps go along a cubic through the last places and are corrected by Newton's method; a step is halved if its
end is far from where it was expected, or the determinant of the derivatives has another sign, which is another
branch. Numpy takes all members in step, along tangents instead of cubics, and so in shorter steps; places, states and
turning points are the same. Theory: docs/theory/members.md.
"""

import ctypes
import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import nullcontext
from ctypes import c_int, c_int64, c_void_p
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from graphs.c_libraries import library
from graphs.tolerances import DOUBLE
from graphs.types import Flags, Floats, Ints

CLOSED, TURNS_BACK, OPEN, BARRED = 0, 1, 2, 3
"""A member at given inputs: closed; its driven joint turns back before; not reached; unable to close."""
STRAY = 0.25
"""A corrected place is at most this part of its step from where it was expected."""
LEAST = 1e-4
"""Least step of a driven joint, radians: a turning point is known to that."""


@dataclass(frozen=True, slots=True)
class MemberType:
    """The loops of a type with driven joints.

    A loop passes its joints one after the other: `begin`, int[L + 1], says where the passages of each begin. Each
    passage, P in all, has the place of its `joint`, its `sign` (-1 backwards). Of the joints, J of them, `slides`
    says which slide, and `column` their places among the unknowns, or -1 - (that among the driven ones). `curved`,
    bool[L], says of which loops the axes meet in a point; those of the others are parallel.
    """

    begin: Ints
    joint: Ints
    sign: Floats
    slides: Flags
    column: Ints
    curved: Flags

    @property
    def unknowns(self) -> int:
        """Number of joints that are not driven."""
        return int((self.column >= 0).sum())

    @property
    def inputs(self) -> int:
        """Number of driven joints."""
        return len(self.column) - self.unknowns


@dataclass(frozen=True, slots=True)
class MemberArrays:
    """Members of a type, and where they begin.

    `axes`, float[P, 3] or float[N, P, 3], is the axis of each passage: a direction, or in a plane the point, with 1,
    or of a slide (-y, x, 0) of its heading. `start`, float[U + I] or float[N, U + I], are unknowns and inputs at
    which loops close. With `bends`, float[N, P], radians, the axes are those of one mechanism; members come of it by
    bending the link after each passage about its normal, of `normals`, float[P, 3].
    """

    axes: Floats
    start: Floats
    normals: Floats | None = None
    bends: Floats | None = None


class Swept(NamedTuple):
    """Angles float[N, F, O] of joints, loop-closure residuals float[N, F], nan where not closed; states int8[N, F]."""

    angles: Floats
    residuals: Floats
    status: npt.NDArray[np.int8]


_CORRECTIONS, _MOST_STEPS = 8, 400


class _Equations(NamedTuple):
    """What does not close, float[N, 3 L], and derivatives by unknowns, float[N, U, U], and inputs, float[N, U, I]."""

    residual: Floats
    by_unknowns: Floats
    by_inputs: Floats

    @property
    def error(self) -> Floats:
        """The largest of each member, float[N]."""
        return np.asarray(np.abs(self.residual).max(axis=1, initial=0.0))

    @property
    def sign(self) -> Floats:
        """The sign of the determinant of each member: another one is another branch."""
        return np.asarray(np.linalg.slogdet(self.by_unknowns)[0])

    def solved(self, right: Floats) -> Floats:
        """Return the solutions of right sides float[N, U]; nan where derivatives are singular."""
        good = self.sign != 0.0
        found = np.full(right.shape, np.nan)
        found[good] = np.linalg.solve(self.by_unknowns[good], right[good, :, None])[..., 0]
        return found

    def rates(self, onwards: Floats) -> Floats:
        """Return the rates of unknowns while inputs go on, float[N, I]."""
        return -self.solved(np.einsum("nui,ni->nu", self.by_inputs, onwards))


@dataclass(slots=True)
class _Batch:
    """Members in step: axes, quaternions left by bent links, unknowns and inputs of each."""

    kind: MemberType
    axes: Floats
    undone: Floats
    unknowns: Floats
    inputs: Floats

    def at(self, who: Ints, unknowns: Floats, inputs: Floats) -> _Equations:
        """Return the closure equations of some members."""
        kind = self.kind
        values = np.concatenate([unknowns, inputs[:, ::-1]], axis=1)[:, kind.column]
        sine = np.where(kind.slides, values / 2.0, np.sin(values / 2.0))
        cosine = np.where(kind.slides, 1.0, np.cos(values / 2.0))
        residual = np.zeros((len(who), 3 * len(kind.curved)))
        columns = np.zeros((len(who), 3 * len(kind.curved), len(kind.column)))
        for loop, curved in enumerate(kind.curved.astype(float)):
            rows = slice(3 * loop, 3 * loop + 3)
            turned = self.undone[who, loop]
            for passage in range(kind.begin[loop], kind.begin[loop + 1]):
                joint, sign = kind.joint[passage], kind.sign[passage]
                axis = self.axes[who, passage]
                columns[:, rows, joint] += sign * _turned(turned, axis, curved)
                turn = np.concatenate([cosine[:, joint, None], sign * sine[:, joint, None] * axis], axis=1)
                turned = _product(turned, turn, curved)
            residual[:, rows] = np.where(turned[:, :1] < 0.0, -2.0, 2.0) * turned[:, 1:]
        free = np.argsort(np.where(kind.column >= 0, kind.column, len(kind.column)))[: kind.unknowns]
        driven = np.argsort(np.where(kind.column < 0, -1 - kind.column, len(kind.column)))[: kind.inputs]
        return _Equations(residual, columns[:, :, free], columns[:, :, driven])

    def corrected(self, who: Ints, unknowns: Floats, inputs: Floats) -> tuple[Floats, _Equations]:
        """Return unknowns found by Newton's method, and the equations there."""
        unknowns = unknowns.copy()
        for _ in range(_CORRECTIONS):
            equations = self.at(who, unknowns, inputs)
            left = ~(equations.error <= DOUBLE.closed / 100.0)
            if not left.any():
                break
            change = equations.solved(equations.residual)
            unknowns[left] -= change[left]
        return unknowns, self.at(who, unknowns, inputs)

    def bent(self, members: MemberArrays, who: Ints, part: Floats) -> None:
        """Bend the links of some members by a part, float[n], of what they are to be bent by."""
        assert members.bends is not None
        assert members.normals is not None
        for loop in range(len(self.kind.curved)):
            turned = np.tile([1.0, 0.0, 0.0, 0.0], (len(who), 1))
            for passage in range(self.kind.begin[loop], self.kind.begin[loop + 1]):
                self.axes[who, passage] = _turned(turned, np.broadcast_to(members.axes[passage], (len(who), 3)), 1.0)
                half = part[:, None] * members.bends[who, passage, None] / 2.0
                turn = np.concatenate([np.cos(half), np.sin(half) * members.normals[passage]], axis=1)
                turned = _product(turned, turn, 1.0)
            self.undone[who, loop] = turned


def swept_by_numpy(kind: MemberType, members: MemberArrays, inputs: Floats, columns: Ints, answer: Swept) -> None:
    """Write into the answer what `swept` returns."""
    count, rows, _ = answer.angles.shape
    batch = _Batch(
        kind,
        np.array(np.broadcast_to(members.axes, (count, *members.axes.shape[-2:]))),
        np.tile([1.0, 0.0, 0.0, 0.0], (count, len(kind.curved), 1)),
        *np.split(np.array(np.broadcast_to(members.start, (count, members.start.shape[-1]))), [kind.unknowns], axis=1),
    )
    everyone = np.arange(count)
    equations = batch.at(everyone, batch.unknowns, batch.inputs)
    sign = equations.sign
    good = (equations.error <= DOUBLE.closed) & (sign != 0.0)
    if members.bends is not None:
        good[good] = _became(batch, members, np.flatnonzero(good), sign)
    low, high = np.full(count, -np.inf), np.full(count, np.inf)
    for f in range(rows):
        goal = np.array(np.broadcast_to(inputs[..., f, :], (count, kind.inputs)))
        beyond = (goal[:, 0] >= high) | (goal[:, 0] <= low) if kind.inputs == 1 else np.zeros(count, dtype=bool)
        who = np.flatnonzero(good & ~beyond)
        reached = np.zeros(count, dtype=bool)
        reached[who] = _went(batch, who, goal[who], sign)
        if kind.inputs == 1:
            failed = good & ~beyond & ~reached
            before = batch.inputs[:, 0]
            high = np.where(failed & (goal[:, 0] > before), goal[:, 0], high)
            low = np.where(failed & (goal[:, 0] < before), goal[:, 0], low)
        _write(batch, reached, good, columns, answer, f)


def _write(batch: _Batch, reached: Flags, good: Flags, columns: Ints, answer: Swept, f: int) -> None:
    """Write one configuration of all members."""
    error = batch.at(np.arange(len(good)), batch.unknowns, batch.inputs).error
    values = np.concatenate([batch.unknowns, batch.inputs[:, ::-1]], axis=1)[:, columns]
    answer.angles[:, f] = np.where(reached[:, None], values, np.nan)
    answer.residuals[:, f] = np.where(reached, error, np.nan)
    answer.status[:, f] = np.where(reached, CLOSED, np.where(good, TURNS_BACK, OPEN))


def _went(batch: _Batch, who: Ints, goal: Floats, sign: Floats) -> Flags:
    """Take members to inputs float[n, I]; return which came there. The others stay where they are."""
    start, begun = batch.inputs[who], batch.unknowns[who]
    whole = np.abs(goal - start).max(axis=1, initial=0.0)
    onwards = np.divide(goal - start, whole[:, None], out=np.zeros_like(start), where=whole[:, None] > 0.0)
    here, done, length = begun.copy(), np.zeros(len(who)), whole.copy()
    reached = whole == 0.0
    left = np.flatnonzero(~reached)
    for _ in range(_MOST_STEPS):
        if not len(left):
            break
        some = who[left]
        step = np.minimum(length[left], whole[left] - done[left])
        lands = length[left] >= whole[left] - done[left]
        at = start[left] + done[left, None] * onwards[left]
        rates = batch.at(some, here[left], at).rates(onwards[left])
        expected = here[left] + step[:, None] * rates
        given = np.where(lands[:, None], goal[left], at + step[:, None] * onwards[left])
        tried, equations = batch.corrected(some, expected, given)
        good = _accepted(tried, expected, here[left], equations, sign[some], step)
        here[left[good]] = tried[good]
        done[left[good]] += step[good]
        reached[left[good & lands]] = True
        length[left] = np.where(good, 2.0 * step, step / 2.0)
        left = left[~(good & lands) & (length[left] >= LEAST)]
    batch.unknowns[who] = np.where(reached[:, None], here, begun)
    batch.inputs[who] = np.where(reached[:, None], goal, start)
    return np.asarray(reached)


def _became(batch: _Batch, members: MemberArrays, who: Ints, sign: Floats) -> Flags:
    """Bend links to those of members while inputs stay; return of which loops stay closed."""
    assert members.bends is not None
    most = np.abs(members.bends[who]).max(axis=1, initial=0.0)
    done, length = np.zeros(len(who)), np.ones(len(who))
    became, left = np.zeros(len(who), dtype=bool), np.arange(len(who))
    for _ in range(_MOST_STEPS):
        if not len(left):
            break
        some = who[left]
        step = np.minimum(length[left], 1.0 - done[left])
        lands = length[left] >= 1.0 - done[left]
        batch.bent(members, some, done[left] + step)
        here, given = batch.unknowns[some], batch.inputs[some]
        equations = batch.at(some, here, given)
        expected = here - equations.solved(equations.residual)
        tried, equations = batch.corrected(some, expected, given)
        good = _accepted(tried, expected, here, equations, sign[some], np.full(len(some), LEAST))
        batch.unknowns[some[good]] = tried[good]
        done[left[good]] += step[good]
        became[left[good & lands]] = True
        length[left] = np.where(good, 2.0 * step, step / 2.0)
        left = left[~(good & lands) & (length[left] * most[left] >= LEAST)]
    return became


def _accepted(
    tried: Floats, expected: Floats, here: Floats, equations: _Equations, sign: Floats, least: Floats
) -> Flags:
    """Tell of which members loops close on the same branch, and not far from where they were expected."""
    astray = np.abs(tried - expected).max(axis=1, initial=0.0)
    chord = np.maximum(np.abs(tried - here).max(axis=1, initial=0.0), least)
    with np.errstate(invalid="ignore"):
        near = astray <= STRAY * chord
    return np.asarray((equations.error <= DOUBLE.closed) & (equations.sign == sign) & near)


def _turned(turn: Floats, axis: Floats, curved: float) -> Floats:
    """Return axes float[n, 3] turned by quaternions float[n, 4]: in a plane products of two lengths vanish."""
    w, x, y, z = turn.T
    a, b, c = axis.T
    u, v, t = y * c - z * b, z * a - x * c, curved * (x * b - y * a)
    return np.stack([a, b, c], axis=1) + 2.0 * np.stack(
        [w * u + y * t - z * v, w * v + z * u - x * t, w * t + curved * (x * v - y * u)], axis=1
    )


def _product(one: Floats, other: Floats, curved: float) -> npt.NDArray[np.float64]:
    """Return products of quaternions, float[n, 4]."""
    w, x, y, z = one.T
    p, q, r, s = other.T
    return np.stack(
        [
            w * p - curved * (x * q + y * r) - z * s,
            w * q + x * p + y * s - z * r,
            w * r - x * s + y * p + z * q,
            w * s + curved * (x * r - y * q) + z * p,
        ],
        axis=1,
    )


SOURCE = Path(__file__).with_name("member_kernel.c")
_AT_ONCE = 2048
"""Members that a thread takes at a time."""


def swept(
    kind: MemberType,
    members: MemberArrays,
    inputs: Floats,
    count: int,
    columns: Ints,
    report: Callable[[int], None] | None = None,
) -> Swept:
    """Take members through inputs, float[F, I] or float[N, F, I], and return where they are.

    Written are the angles of those joints whose `columns` are given, int[O], as `MemberType.column` has them.
    """
    rows = inputs.shape[-2]
    answer = Swept(
        np.empty((count, rows, len(columns))), np.empty((count, rows)), np.empty((count, rows), dtype=np.int8)
    )
    found = library(SOURCE)
    if found is None:
        swept_by_numpy(kind, members, inputs, columns, answer)
    elif count:
        _in_library(found, kind, members, inputs, columns, answer, report)
    return answer


def _in_library(
    found: ctypes.CDLL,
    kind: MemberType,
    members: MemberArrays,
    inputs: Floats,
    columns: Ints,
    answer: Swept,
    report: Callable[[int], None] | None,
) -> None:
    if found.members_swept.argtypes is None:
        found.members_swept.restype = c_int
        found.members_swept.argtypes = [*[c_void_p] * 14, *[c_int64] * 2, *[c_void_p] * 3]
    count, rows, out = answer.angles.shape
    own = (members.axes.ndim == 3, members.start.ndim == 2, inputs.ndim == 3)
    sizes = np.array([len(kind.curved), len(kind.column), kind.unknowns, kind.inputs, rows, out, *own], dtype=np.int64)
    numbers = np.array([DOUBLE.closed, STRAY, LEAST])
    whole = [np.ascontiguousarray(one, np.int64) for one in (kind.begin, kind.joint)]
    whole += [np.ascontiguousarray(one, np.int64) for one in (kind.slides, kind.column, kind.curved, columns)]
    begin, joint, slides, column, curved, written = whole
    real = [kind.sign, members.axes, members.normals, members.bends, members.start, inputs]
    sign, axes, normals, bends, start, given = (
        None if one is None else np.ascontiguousarray(one, dtype=float) for one in real
    )
    arrays: list[npt.NDArray[Any] | None] = [sizes, numbers, begin, joint, sign, slides, column, curved, written]
    arrays += [axes, normals, bends, start, given]
    places = [None if one is None else one.ctypes.data for one in arrays]
    outputs = [one.ctypes.data for one in answer]
    threads = min(_cores(), -(-count // _AT_ONCE))  # one has no use for a pool

    def part(first: int) -> int:
        last: int = min(first + _AT_ONCE, count)
        if not found.members_swept(*places, first, last, *outputs):
            raise MemoryError("no memory for a member of so many joints")
        return last

    with ThreadPoolExecutor(threads) if threads > 1 else nullcontext() as pool:
        firsts = range(0, count, _AT_ONCE)
        for last in map(part, firsts) if pool is None else pool.map(part, firsts):
            if report is not None:
                report(last)


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
