"""Closure equations of complex unknowns, and solutions followed: by kernel.c, or by kernel.py where it was not built.

Both do the same; numba, which compiles the latter, is imported only then.
"""

import ctypes
from ctypes import c_double, c_int, c_int64, c_void_p
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.c_libraries import library
from graphs.types import Floats, Ints
from synth.analysis.assembly import kernel
from synth.analysis.assembly.kernel import CLOSED, Complexes, Line, Type

SOURCE = Path(__file__).with_name("kernel.c")
_P = c_void_p
_FUNCTIONS: dict[str, tuple[Any, ...]] = {
    "all_followed": (*[_P] * 5, c_int64, *[_P] * 4, c_double, c_double, *[_P] * 3),
    "all_corrected": (*[_P] * 5, c_int64, *[_P] * 2, c_int64, _P),
    "all_evaluated": (*[_P] * 5, *[_P] * 4),
}


def _library() -> ctypes.CDLL | None:
    """Return the library with the types of its functions; None where there is none."""
    found = library(SOURCE)
    if found is not None and found.all_followed.argtypes is None:
        for name, arguments in _FUNCTIONS.items():
            function = getattr(found, name)
            function.restype, function.argtypes = c_int, arguments
    return found


def followed_all(
    kind: Type,
    curves: tuple[Complexes, Complexes, Complexes],
    values: Complexes,
    small: float,
    line: Line | None = None,
) -> Ints:
    """Follow solutions along curves, each along its own, in place; return STOPPED, ARRIVED or FAR: int[P].

    With a line of members the curves are of hyperplanes, and solutions have one unknown more: see `kernel.Line`.
    """
    found = _library()
    if found is None:
        empty = np.empty(0, dtype=complex)
        return kernel.followed_all(kind, line or (empty, empty), curves, values, small)
    ends = np.empty(len(values), np.int64)
    whole = [np.ascontiguousarray(curve, dtype=complex) for curve in curves]
    members = whole[0].shape[1] if line is None else len(line[0])
    along = (None, None) if line is None else [np.ascontiguousarray(each, dtype=complex) for each in line]
    _called(found.all_followed, kind, members, len(values), *whole, values, small, CLOSED, ends, *along)
    return ends


def corrected_all(kind: Type, parameters: Complexes, values: Complexes, steps: int) -> Floats:
    """Correct solutions, in place; return their closure residuals: float[P]."""
    found = _library()
    if found is None:
        return kernel.corrected_all(kind, parameters, values, steps)
    errors, members = np.empty(len(values)), np.ascontiguousarray(parameters, dtype=complex)
    _called(found.all_corrected, kind, members.shape[1], len(values), members, values, steps, errors)
    return errors


def evaluated(kind: Type, parameters: Complexes, unknowns: Complexes, residual: Complexes, jacobian: Complexes) -> None:
    """Write the closure residual, complex[3 L], and its derivatives by the unknowns, complex[3 L, U]."""
    found = _library()
    if found is None:
        kernel.evaluated(kind, parameters, unknowns, residual, jacobian)
        return
    given = [np.ascontiguousarray(array, dtype=complex) for array in (parameters, unknowns)]
    _called(found.all_evaluated, kind, len(parameters), *given, residual, jacobian)


def _called(function: Any, kind: Type, parameters: int, *arguments: npt.NDArray[Any] | float | None) -> None:
    """Call a function of the library, arrays by their places; those that it writes are contiguous."""
    loops, signs, axes, column = kind
    unknowns = int((column >= 0).sum())
    sizes = np.array([*loops.shape, len(axes), unknowns, parameters], dtype=np.int64)
    arrays = [sizes, loops, signs, axes, column]
    places = [each.ctypes.data if isinstance(each, np.ndarray) else each for each in (*arrays, *arguments)]
    if not function(*places):
        raise MemoryError("no memory for the closure equations of so many joints")
