"""The one decorator of compiled functions, and the arrays they work on."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar, cast

import numba
import numpy as np
import numpy.typing as npt

__all__ = ["compiled", "doubled"]


T = TypeVar("T", bound=np.generic)
F = TypeVar("F", bound=Callable[..., object])


def compiled(function: F) -> F:
    """Compile a function of numbers and arrays when it is first called, and keep the machine code on disk.

    The code goes to ``__pycache__`` beside the module, or to ``NUMBA_CACHE_DIR``; other threads run meanwhile.
    What is kept is renewed when the function's own file changes, not when a function it calls changes in another
    file: after an edit, ``make clean`` or the tests remove what may be old.
    """
    return cast(F, numba.njit(cache=True, nogil=True)(function))


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
