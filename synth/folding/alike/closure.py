"""Loops that close, and joints of one class whose angles stay equal. Theory: docs/theory/folding.md."""

from __future__ import annotations

import numpy as np
import scipy.sparse

from graphs.types import Floats, Ints
from synth.motion.closure import ClosureEquations
from synth.motion.linkage import PosedLinkage

__all__ = ["AlikeClosure"]


class AlikeClosure(ClosureEquations):
    """Closure equations of a linkage, and an equation for each joint whose angle is that of another.

    What moves so is a motion of the linkage, whatever the classes are; its rank and its freedoms are those of the
    motions that keep the angles of a class equal. Rounding cannot lead off them, since what is not equal is an
    error as a loop is that does not close.

    Parameters
    ----------
    linkage : PosedLinkage
        Joints of a class have one angle at its pose.
    classes : int[J]
        The class of each joint.

    Examples
    --------
    A square with creases along both diagonals, all four of them alike, cannot fold:

    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.motion.linkage import linkage_of_sheet
    >>> corners = ((0, 0), (1, 0), (0, 1), (-1, 0), (0, -1))
    >>> square = linkage_of_sheet(Sheet(5, (), "", ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)), corners))
    >>> closure = AlikeClosure(square, np.zeros(4, dtype=np.int64))
    >>> closure.rows, closure.error(np.array([0.1, 0.0, 0.1, 0.0]))
    (6, 0.1)
    """

    def __init__(self, linkage: PosedLinkage, classes: Ints) -> None:
        super().__init__(linkage)
        first = np.unique(classes, return_index=True)[1][np.unique(classes, return_inverse=True)[1]]
        others = np.flatnonzero(first != np.arange(self.joints))
        every = scipy.sparse.identity(self.joints, format="csr")
        self._unlike = (every[others] - every[first[others]]).tocsr()
        self.rows += len(others)

    def at(self, angles: Floats) -> tuple[Floats, scipy.sparse.csr_matrix]:
        """Return what does not close or is not equal at joint angles, and its derivatives by them."""
        residual, jacobian = super().at(angles)
        both = scipy.sparse.vstack([jacobian, self._unlike], format="csr")
        return np.concatenate([residual, self._unlike @ angles]), both
