"""Rates at a pose as a basis, found by projection: nothing dense is made of the equations of large linkages.

Theory: docs/theory/folding.md.
"""

from __future__ import annotations

import numpy as np

from graphs.rank.singular_values import row_space
from graphs.tolerances import DOUBLE, pivots
from graphs.types import Floats, Ints
from synth.motion.closure import ClosureEquations
from synth.motion.newton import TangentSpace

__all__ = ["free_rates", "independent_joints"]

_BLOCK, _MOST = 8, 512


def free_rates(closure: ClosureEquations, angles: Floats, moving: Ints | None = None) -> Floats | None:
    """Return a basis of the rates that a pose has, by random ones projected onto them; None if they are too many.

    Parameters
    ----------
    closure : ClosureEquations
    angles : float[J]
        A closed pose, radians.
    moving : int[n], optional
        The joints that move, of a branch on which others are still: these may have rates of their own at its
        poses, which begin other branches. By default all.

    Returns
    -------
    float[n, F] or None
        Orthonormal columns, rows for the joints that move.

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> from synth.motion.linkage import linkage_of_axes
    >>> ring = SCGraph(8, [(link, (link + 1) % 8) for link in range(8)])
    >>> axes = {j: (np.cos([j, j + 2.0, 2.0 * j]), np.sin([3.0 * j, j, j + 1.0])) for j in range(8)}
    >>> linkage = linkage_of_axes(ring, axes)
    >>> free_rates(ClosureEquations(linkage), linkage.angles).shape
    (8, 2)
    """
    jacobian = closure.at(angles)[1]
    space = TangentSpace(jacobian if moving is None else jacobian[:, moving])
    size = len(angles) if moving is None else len(moving)
    chance = np.random.default_rng(size)
    found: list[Floats] = []
    while len(found) < min(_MOST, size):
        found += [space.projected(chance.normal(size=size)) for _ in range(_BLOCK)]
        # projected random rates have singular values of their number's root, or none
        basis = row_space(np.array(found), DOUBLE.singular, float(np.sqrt(size)))
        if basis.shape[1] < len(found):
            return basis
    return None


def independent_joints(basis: Floats, first: int) -> list[int]:
    """Return joints whose rates say those of all others, a given one first, the others as far apart as may be.

    Parameters
    ----------
    basis : float[n, F]
        Of the rates, by columns.
    first : int
        Row of a joint that moves; it is left out where it does not.

    Examples
    --------
    >>> basis = np.array([[1.0, 0.0], [1.0, 1e-9], [0.0, 0.0], [0.3, 1.0]])
    >>> independent_joints(basis, 0), independent_joints(basis, 1), independent_joints(basis, 2)
    ([0, 3], [1, 3], [3, 0])
    """
    chosen = []
    left = basis
    own = basis[first]
    if basis.size and np.linalg.norm(own) > DOUBLE.clear:
        chosen = [first]
        left = basis - np.outer(basis @ own, own) / (own @ own)
    return [*chosen, *pivots(left)]
