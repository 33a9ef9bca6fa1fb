"""What rounding leaves of a sum: the one measure, here and on cones and cylinders, of what is zero.

Link angles and lengths are known to the last digit that a float holds, so a sum of them with signs is known to
some last digits of the sum of their sizes, however small it comes out itself. There is no other zero: a bound
that does not shrink with the links takes small linkages for folding ones. Theory: docs/theory/rounding.md.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from graphs.types import Floats

__all__ = ["ILL_CONDITIONED", "rounding_of"]

ILL_CONDITIONED = "ill-conditioned"
"""What a caution begins with where figures within rounding of zero decide."""


def rounding_of(terms: npt.ArrayLike) -> Floats:
    """Return how far rounding may take sums of terms, whatever their signs.

    Parameters
    ----------
    terms : float[..., n]
        Any one unit.

    Returns
    -------
    float[...]
        (n + 4) eps of the sum of absolute values: a last digit for each term as it was given, three for what was
        computed of it, and one for each addition.

    Examples
    --------
    >>> sides = np.array([0.3, 0.1, 0.1, 0.1])
    >>> bool(abs(sides @ [1, -1, -1, -1]) <= rounding_of(sides))
    True
    >>> bool(rounding_of(1e-6 * sides) == 1e-6 * rounding_of(sides))
    True
    """
    sizes = np.abs(np.asarray(terms, dtype=float))
    return np.asarray((sizes.shape[-1] + 4) * np.finfo(float).eps * sizes.sum(axis=-1))
