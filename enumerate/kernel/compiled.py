"""The one decorator of compiled functions, and the arrays they work on."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba
import numpy as np
import numpy.typing as npt

from enumerate.machine_code.kept import KeptCode
from enumerate.machine_code.sources import fingerprint

__all__ = ["compiled", "doubled", "kernels"]


T = TypeVar("T", bound=np.generic)
F = TypeVar("F", bound=Callable[..., object])


kernels: list[Callable[..., object]] = []
"""All functions compiled or to be compiled, of the modules imported so far."""


def compiled(function: F) -> F:
    """Compile a function of numbers and arrays when it is first called, and keep the machine code on disk.

    The code is kept for this user in ``~/.cache/synthedra``, or where ``SYNTHEDRA_CACHE`` or ``XDG_CACHE_HOME``
    says, and is renewed when the function's module changes or any own module that it imports. Other threads run
    meanwhile.
    """
    made: Any = numba.njit(nogil=True)(function)
    if fingerprint(function.__module__) and hasattr(made, "enable_caching"):  # without, numba compiles nothing
        made._cache = KeptCode(function)
    kernels.append(made)
    return cast(F, made)


@compiled
def doubled(rows: npt.NDArray[T]) -> npt.NDArray[T]:
    """Return an array of twice as many rows that begins with these.

    Written out, here and in other compiled functions: numba takes a second or more to compile one assignment to a
    slice, for the text of an error that cannot happen.
    """
    more = np.empty((2 * len(rows), rows.shape[1]), rows.dtype)
    for i in range(len(rows)):
        for j in range(rows.shape[1]):
            more[i, j] = rows[i, j]
    return more
