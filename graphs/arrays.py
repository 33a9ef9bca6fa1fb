"""Types of the arrays that every room uses; shapes are told where an array is passed."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

__all__ = ["Bytes", "Flags", "Floats", "Ints", "Signs", "Words"]

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]
Flags = npt.NDArray[np.bool_]
Signs = npt.NDArray[np.int8]
Bytes = npt.NDArray[np.uint8]
Words = npt.NDArray[np.uint64]
