"""The library closure_kernel.c: closure equations of a linkage, and their normal equations, factorised in one pattern.

Order of elimination and pattern of the factor are found once per linkage; each configuration has a factor of its own.
Whatever is here `synth.analysis.motion.closure` and `synth.analysis.motion.tangent` do with numpy and scipy too,
where there is no library.
"""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from ctypes import byref, c_double, c_int, c_int64, c_void_p
from pathlib import Path
from threading import Lock
from typing import Any
from weakref import finalize

import numpy as np
import numpy.typing as npt

from graphs.c_libraries import library
from graphs.loops.loop import Centre
from graphs.types import Floats, Ints

SOURCE = Path(__file__).with_name("closure_kernel.c")
_KINDS = {Centre.FINITE: 0, Centre.INFINITE: 1, Centre.NONE: 2}
_P = c_void_p
_FUNCTIONS: dict[str, tuple[Any, tuple[Any, ...]]] = {
    "equations_new": (_P, (c_int64, c_int64, *[_P] * 8)),
    "equations_free": (None, (_P,)),
    "equations_rows": (c_int64, (_P,)),
    "equations_entries": (c_int64, (_P,)),
    "equations_at": (None, (_P,) * 5),
    "equations_analysed": (c_int, (_P,)),
    "image_of": (None, (_P,) * 4),
    "sum_of_rows": (None, (_P,) * 4),
    "factor_new": (_P, (_P,)),
    "factor_free": (None, (_P, _P)),
    "factorised": (c_int, (_P, _P, _P, c_double)),
    "factor_solved": (c_int, (_P,) * 4),
    "factor_least": (c_int, (_P,) * 5),
    "factor_least_exactly": (c_int, (_P,) * 5),
    "factor_projected": (c_int, (_P,) * 5),
    "equations_corrected": (c_int, (_P,) * 8),
    "curve_walked": (c_int64, (*[_P] * 4, *[c_int64] * 3, *[_P] * 12)),
}
_OF_JOINTS = ("angles", "tangent", "bend", "across", "leaving", "arriving")


def kernel() -> ctypes.CDLL | None:
    """Return the library with the types of its functions; None where there is none."""
    found = library(SOURCE)
    if found is not None and found.equations_new.argtypes is None:
        for name, (result, arguments) in _FUNCTIONS.items():
            function = getattr(found, name)
            function.restype, function.argtypes = result, arguments
    return found


def _check(good: int | None) -> None:
    if not good:
        raise MemoryError("no memory for the closure equations of so many joints")


def _freed(equations: KernelEquations, factor: int) -> None:
    """Free a factor before its equations, which keep its room for the next."""
    equations.library.factor_free(equations.handle, factor)


class KernelEquations:
    """Closure equations of loops in the library: those of `joints`, of some kinds, with the parts of each.

    Loops stand one after the other, the joints of loop l at begin[l] to begin[l + 1]. Parts are the joints, signs,
    turning, axes and points of each joint of each loop, and a frame of each loop, as `synth.analysis.motion.closure`
    has them.
    """

    def __init__(
        self, library: ctypes.CDLL, joints: int, kinds: Sequence[Centre], begin: Ints, parts: dict[str, Floats]
    ) -> None:
        self.library, self.joints = library, joints
        real = ("signs", "turning", "axes", "points", "frames")
        arrays: list[npt.NDArray[Any]] = [
            np.ascontiguousarray(begin, dtype=np.int64),
            np.array([_KINDS[kind] for kind in kinds], dtype=np.int32),
            np.ascontiguousarray(parts["joints"], dtype=np.int32),
            *(np.ascontiguousarray(parts[name], dtype=float) for name in real),
        ]
        self.handle = library.equations_new(joints, len(kinds), *(array.ctypes.data for array in arrays))
        _check(self.handle)
        finalize(self, library.equations_free, self.handle)
        self.rows = int(library.equations_rows(self.handle))
        self._entries = int(library.equations_entries(self.handle))
        self._one_thread = Lock()

    def analysed(self) -> None:
        """Find the order of elimination and the pattern of the factor, once."""
        with self._one_thread:
            _check(self.library.equations_analysed(self.handle))

    def at(self, turned: Floats, freed: Floats | None) -> tuple[Floats, Floats]:
        """Return residuals float[rows] and derivatives float[derivatives] where joints have turned, float[J]."""
        residual, derivatives = np.empty(self.rows), np.empty(self._entries)
        turned = np.ascontiguousarray(turned, dtype=float)
        free = None if freed is None else freed.ctypes.data
        self.library.equations_at(self.handle, turned.ctypes.data, free, residual.ctypes.data, derivatives.ctypes.data)
        return residual, derivatives

    def corrected(
        self, manner: Floats, start: Floats, zero: Floats, freed: Floats | None
    ) -> tuple[Floats, Floats, float, int]:
        """Return angles float[J] found by Newton's method, derivatives there, what does not close, and the steps."""
        self.analysed()
        end, entries, error, steps = np.array(start, dtype=float), np.empty(self._entries), c_double(), c_int64()
        free = None if freed is None else freed.ctypes.data
        given = (manner.ctypes.data, zero.ctypes.data, free, end.ctypes.data, entries.ctypes.data)
        _check(self.library.equations_corrected(self.handle, *given, byref(error), byref(steps)))
        return end, entries, error.value, steps.value

    def walked(
        self, manner: Floats, place: dict[str, Any], most: int, zero: Floats, freed: Floats | None
    ) -> tuple[dict[str, Floats], int]:
        """Take up to so many steps of a walk; return what is known after each, the first being `place`, and how many.

        Of the place all but leaving, arriving and error, and whether it was `begun` and is `watched`, as
        closure_kernel.c says.
        """
        self.analysed()
        sizes = {"entries": self._entries, "image": self.rows, **dict.fromkeys(_OF_JOINTS, self.joints)}
        arrays: dict[str, Any] = {name: np.zeros((most + 1, size)) for name, size in sizes.items()}
        arrays["error"], arrays["length"] = np.zeros(most + 1), np.zeros(most + 1)
        arrays["steps"], arrays["singular"] = (np.zeros(most + 1, dtype=np.int64) for _ in range(2))
        for name in ("angles", "entries", "tangent", "bend", "across", "image", "length"):
            arrays[name][0] = place[name]
        order = ("angles", "entries", "tangent", "bend", "across", "image", "leaving", "arriving", "error", "length")
        places = [arrays[name].ctypes.data for name in (*order, "steps", "singular")]
        free = None if freed is None else freed.ctypes.data
        how = (manner.ctypes.data, zero.ctypes.data, free, place["begun"], place["watched"], most)
        taken = int(self.library.curve_walked(self.handle, *how, *places))
        _check(taken >= 0)
        return arrays, taken


class KernelFactor:
    """The normal equations of some derivatives, factorised: what `synth.analysis.motion.tangent.Factor` does."""

    def __init__(self, equations: KernelEquations, derivatives: Floats, regular: float) -> None:
        equations.analysed()
        self._equations, self._derivatives, self._library = equations, derivatives, equations.library
        self._handle = self._library.factor_new(equations.handle)
        _check(self._handle)
        finalize(self, _freed, equations, self._handle)
        _check(self._library.factorised(equations.handle, self._handle, derivatives.ctypes.data, regular))
        self.shape = (equations.rows, equations.joints)

    def _call(self, function: Any, given: Floats, wanted: int, *, derivatives: bool = True) -> Floats:
        given, result = np.ascontiguousarray(given, dtype=float), np.empty(wanted)
        inner = (self._derivatives.ctypes.data,) if derivatives else ()
        _check(function(self._equations.handle, self._handle, *inner, given.ctypes.data, result.ctypes.data))
        return result

    def image(self, rates: Floats) -> Floats:
        """Return by what loops part at rates float[J]: float[rows]."""
        rates, result = np.ascontiguousarray(rates, dtype=float), np.empty(self._equations.rows)
        places = (self._derivatives.ctypes.data, rates.ctypes.data, result.ctypes.data)
        self._library.image_of(self._equations.handle, *places)
        return result

    def sum_of_rows(self, forces: Floats) -> Floats:
        """Return the sum of rows, each as often as forces float[rows] say: float[J]."""
        forces, result = np.ascontiguousarray(forces, dtype=float), np.empty(self._equations.joints)
        places = (self._derivatives.ctypes.data, forces.ctypes.data, result.ctypes.data)
        self._library.sum_of_rows(self._equations.handle, *places)
        return result

    def solved(self, right_side: Floats) -> Floats:
        """Return the solution of the normal equations: float[J]."""
        return self._call(self._library.factor_solved, right_side, self._equations.joints, derivatives=False)

    def least(self, off: Floats) -> Floats:
        """Return the least rates at which loops part by float[rows], as a sum of rows: float[J]."""
        return self._call(self._library.factor_least, off, self._equations.joints)

    def least_exactly(self, off: Floats) -> Floats:
        """Return the same with all digits: float[J]."""
        return self._call(self._library.factor_least_exactly, off, self._equations.joints)

    def projected(self, rates: Floats) -> Floats:
        """Return the rates nearest to float[J] at which all loops stay closed to first order: float[J]."""
        return self._call(self._library.factor_projected, rates, self._equations.joints)
