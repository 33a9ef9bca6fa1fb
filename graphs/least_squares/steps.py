"""Steps of least squares: each minimises ``|J s + r|^2`` and some ``|s|^2``; residual r, Jacobian J, a damping.

A step with one damping for all unknowns is a sum of rows of J, so it has no part along which no residual changes,
and rounding adds none. Theory: docs/theory/least-squares.md.
"""

from collections.abc import Callable

import numpy as np

from graphs.tolerances import DOUBLE
from graphs.types import Floats

Bounds = tuple[Floats, Floats]
"""Least and greatest unknowns, float[n] each."""
Scaling = Callable[[Floats, Floats], Floats]
"""Of the diagonals of J' J, float[..., n], and dampings, float[...]: what is added to the diagonals."""


def damped_step(jacobian: Floats, residual: Floats, damping: float) -> Floats:
    """Return the step s that minimises ``|J s + r|^2 + damping |s|^2``.

    It is found by a QR decomposition with the residual beside the matrix: where the entries of J differ much in size,
    J' J would square the rounding errors too.

    Parameters
    ----------
    jacobian : float[m, n]
    residual : float[m]
    damping : float
        Not negative; zero only where J has n independent rows.

    Returns
    -------
    float[n]

    Raises
    ------
    numpy.linalg.LinAlgError
        If the damping is zero and J leaves an unknown free.

    Examples
    --------
    >>> damped_step(np.array([[1.0, 1.0]]), np.array([-2.0]), 1e-20).round(9).tolist()
    [1.0, 1.0]
    """
    rows, columns = jacobian.shape
    beside = np.zeros((rows + columns, columns + 1))
    beside[:rows, :columns], beside[:rows, columns] = jacobian, residual
    beside[rows + np.arange(columns), np.arange(columns)] = np.sqrt(damping)
    r: Floats = np.asarray(np.linalg.qr(beside, mode="r"))
    return np.asarray(-np.linalg.solve(r[:columns, :columns], r[:columns, columns]), dtype=np.float64)


def bounded_step(unknowns: Floats, jacobian: Floats, residual: Floats, bounds: Bounds, damping: float) -> Floats:
    """Return the unknowns after a damped step within bounds; those at a bound that push against it stay.

    Parameters
    ----------
    unknowns : float[n]
    jacobian : float[m, n]
    residual : float[m]
    bounds : (float[n], float[n])
    damping : float

    Returns
    -------
    float[n]

    Examples
    --------
    >>> low, high = np.zeros(2), np.ones(2)
    >>> bounded_step(np.array([1.0, 0.0]), np.array([[1.0, 1.0]]), np.array([-2.0]), (low, high), 1e-20).tolist()
    [1.0, 1.0]
    """
    low, high = bounds
    uphill = jacobian.T @ residual
    free = np.flatnonzero(~(((unknowns <= low) & (uphill > 0.0)) | ((unknowns >= high) & (uphill < 0.0))))
    moved = unknowns.copy()
    if len(free):
        moved[free] += damped_step(jacobian[:, free], residual, damping)
    return np.asarray(np.clip(moved, low, high))


def minimum_norm_step(jacobian: Floats, residual: Floats) -> Floats:
    """Return the shortest step s that minimises ``|J s + r|``: that of Gauss and Newton, undamped.

    Singular values below `Tolerances.zero` of the largest count as zero.

    Parameters
    ----------
    jacobian : float[m, n]
    residual : float[m]

    Returns
    -------
    float[n]

    Examples
    --------
    >>> minimum_norm_step(np.array([[1.0, 1.0], [2.0, 2.0]]), np.array([-2.0, -4.0])).round(9).tolist()
    [1.0, 1.0]
    """
    return np.asarray(-np.linalg.lstsq(jacobian, residual, rcond=DOUBLE.zero)[0])


def normal_step(jacobian: Floats, residual: Floats, damping: Floats, scaling: Scaling) -> Floats:
    """Return the damped steps of many problems of one shape, by normal equations.

    Half the digits are lost, which the next step gains back; many small problems are solved ten times as fast as by QR.

    Parameters
    ----------
    jacobian : float[..., m, n]
    residual : float[..., m]
    damping : float[...]
    scaling : callable
        `by_the_mean` or `by_each_unknown`: what is added to the diagonal of J' J.

    Returns
    -------
    float[..., n]

    Examples
    --------
    >>> both = np.array([[[2.0]], [[4.0]]])
    >>> normal_step(both, np.ones((2, 1)), np.zeros(2), by_the_mean).round(6).tolist()
    [[-0.5], [-0.25]]
    """
    transposed = np.swapaxes(jacobian, -1, -2)
    gram = transposed @ jacobian
    places = np.arange(gram.shape[-1])
    gram[..., places, places] += scaling(gram[..., places, places], damping)
    return np.asarray(-np.linalg.solve(gram, transposed @ residual[..., None])[..., 0])


def by_the_mean(diagonal: Floats, damping: Floats) -> Floats:
    """Damp all unknowns alike, over the mean of the diagonal (Levenberg): for unknowns of one unit."""
    # the least addend is for a problem whose residual no unknown changes: its step is zero, not undefined
    return np.asarray((damping * (diagonal.mean(axis=-1) + DOUBLE.zero))[..., None] * np.ones(diagonal.shape[-1]))


def by_each_unknown(diagonal: Floats, damping: Floats) -> Floats:
    """Damp each unknown over its own entry of the diagonal (Marquardt): for unknowns of different units."""
    # a part of the trace keeps the matrix regular where a residual does not depend on some unknown
    return np.asarray(damping[..., None] * diagonal + DOUBLE.clear * diagonal.sum(axis=-1, keepdims=True))
