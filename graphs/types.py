"""Types that every room uses: arrays, whose shapes are stated where they are passed, ids of links and joints."""

from collections.abc import Hashable, Mapping

import numpy as np
import numpy.typing as npt

__all__ = ["Bytes", "Flags", "Floats", "Ints", "JointId", "Joints", "LinkId", "Signs", "Words"]

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]
Flags = npt.NDArray[np.bool_]
Signs = npt.NDArray[np.int8]
Bytes = npt.NDArray[np.uint8]
Words = npt.NDArray[np.uint64]


JointId = Hashable
"""Name of a joint: text or a number, or anything hashable."""

LinkId = Hashable
"""Name of a link."""

Joints = Mapping[JointId, tuple[LinkId, LinkId]]
"""The joints of a graph: the two links of each."""
