"""Members of a type taken through inputs: by kernel.c, or by numpy (`lockstep`) where it was not built.

A loop closes if the quaternions of its joints, one after the other, undo one that links that were bent leave: the
vector part of the product is zero, as in `synth.assembly.kernel`, here of real numbers. Where joints are driven,
steps go along a cubic through the last places and are corrected by Newton's method; a step is halved if its end is
far from where it was expected, or the determinant of the derivatives has another sign, which is another branch. Both
versions do the same, apart from how they halve steps. Theory: docs/theory/members.md.
"""

import ctypes
import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from ctypes import c_int, c_int64, c_void_p
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.compiled import library
from graphs.tolerances import DOUBLE
from graphs.types import Floats, Ints
from synth.members.lockstep import swept_by_numpy
from synth.members.member_type import LEAST, STRAY, Members, MemberType, Swept

SOURCE = Path(__file__).with_name("kernel.c")
_AT_ONCE = 2048
"""Members that a thread takes at a time."""


def swept(
    kind: MemberType,
    members: Members,
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
    members: Members,
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
    threads = min(_cores(), -(-count // _AT_ONCE))

    def part(first: int) -> int:
        last: int = min(first + _AT_ONCE, count)
        if not found.members_swept(*places, first, last, *outputs):
            raise MemoryError("no memory for a member of so many joints")
        return last

    with ThreadPoolExecutor(threads) as pool:
        for last in pool.map(part, range(0, count, _AT_ONCE)):
            if report is not None:
                report(last)


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
