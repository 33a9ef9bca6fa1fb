"""Definite sums of quadratic forms: whether some multiples of several forms add up to one that is positive.

The values that the forms take together, at unit vectors and mixtures of these, make a convex set. If its point
nearest to zero is w, not zero itself, then the sum with multiples w is at least |w|^2 everywhere; if it is zero,
no sum is definite. It is looked for by Wolfe's method: the least point of the hull of values seen so far says
where to look next, at the eigenvector of its least eigenvalue. P. Wolfe, Finding the nearest point in a polytope,
Mathematical Programming 11 (1976). Theory: docs/theory/folding.md.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import nnls

from graphs.rank.singular_values import inertia
from graphs.types import Floats

__all__ = ["definite_weights"]

_MOST = 300
"""Eigenvectors looked at; beyond, what is left to gain is next to nothing."""
_NEAR, _GAINS = 1e-5, 1e-9
"""Where the hull comes so near to zero, or a further value brings it no nearer, there is no clear definite sum."""


def definite_weights(forms: Floats, clear: float) -> tuple[Floats, float] | None:
    """Return multiples of symmetric forms, float[n, s, s], whose sum is positive definite, and how clearly.

    How clearly is the smallest eigenvalue as part of the largest, which must be more than `clear`; None where no
    such multiples were found.
    """
    if not len(forms) or not forms.shape[1]:
        return None
    size = float(np.abs(forms).max())
    seen = np.trace(forms, axis1=1, axis2=2)[None] / forms.shape[1]
    for _ in range(_MOST):
        shares = _shares(seen / size)
        if shares is None:
            return None
        weights = shares @ seen
        found = inertia(np.tensordot(weights, forms, 1), clear)
        if (found.signs > 0).all():
            return weights, float(found.values[0] / found.values[-1])
        new = np.einsum("i,nij,j->n", found.vectors[:, 0], forms, found.vectors[:, 0])
        if np.linalg.norm(weights) <= _NEAR * size or weights @ (weights - new) <= _GAINS * (weights @ weights):
            return None
        seen = np.concatenate([seen[shares > 0.0], new[None]])
    return None


def _shares(points: Floats) -> Floats | None:
    """Return the shares of points in the point of their convex hull that is nearest to zero: float[points].

    None where it is so near to zero that they cannot be told.
    """
    with_sum = np.concatenate([points, np.ones((len(points), 1))], axis=1)
    try:
        shares = nnls(with_sum.T, np.eye(1, with_sum.shape[1], points.shape[1])[0], maxiter=30 * len(points))[0]
    except RuntimeError:  # its iterations do not end
        return None
    return np.asarray(shares / shares.sum())
