"""The dyads of orientations, by the method that their number requires: five exactly, more by least squares.

Five: the four conditions G . (M_i - M_1) W = 0, multiplied by the components of G, are twelve linear equations in
the eighteen products G_a G_b W_j. Their kernel, of six dimensions, cut into three blocks by j, is a matrix pencil
whose eigenvectors are the solutions; it is regular whenever these are finitely many, so that none is missed. More:
the error at an orientation is how far the angle between G and M_i W is from its mean. Theory:
docs/theory/dyads.md.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.errors import NumericalError, UnsolvableError
from graphs.rank.singular_values import singular_values, split
from graphs.tolerances import DOUBLE, canonical_order
from graphs.types import Floats
from synth.linkages.guidance.dyads import Dyad, dyad_of
from synth.linkages.guidance.order import nearest_moving_axis
from synth.linkages.guidance.orientations import Orientations

Complexes = npt.NDArray[np.complex128]
Numbers = npt.NDArray[Any]
"""Real or complex."""

_SOLUTIONS = 6
SOLVED = 1e-13
"""Largest |G . (M_i - M_1) W| / |M_i - M_1| of a solution, of unit vectors: what Newton's steps reach."""
NEARLY_REAL = 1e-5
"""Imaginary part, of unit vectors, below which a real solution is looked for nearby: two that nearly coincide come
out of an eigenvalue problem as a complex pair, the root of the rounding error apart."""
_TRIES = 8
_NEWTON_STEPS = 30
_SQUARES = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)]
"""The products G_a G_b, in the order of the unknowns."""
PLACE = {pair: k for k, (a, b) in enumerate(_SQUARES) for pair in ((a, b), (b, a))}


@dataclass(frozen=True, slots=True)
class DyadsOfFive:
    """All dyads of five orientations, with evidence.

    Attributes
    ----------
    dyads : tuple of Dyad
        The real ones, by ascending components of the fixed axis; two that are one to within 1e-6 count once.
    complex_solutions : int
        How many of the six are complex.
    residual : float
        Largest ``|G . (M_i - M_1) W| / |M_i - M_1|`` of all six, complex ones included.
    smallest_singular_value : float
        The least of those that are zero where dyads are infinitely many: of the twelve equations, relative to the
        largest, and of the conditions on the other axis at each solution, but one.
    """

    dyads: tuple[Dyad, ...]
    complex_solutions: int
    residual: float
    smallest_singular_value: float


def dyads_of_five(orientations: Orientations) -> DyadsOfFive:
    """Return all RR dyads that guide a body through five orientations.

    Parameters
    ----------
    orientations : Orientations
        Five of them.

    Raises
    ------
    UnsolvableError
        If there are not five, or if infinitely many dyads take them (as where all are turns about one axis).
    NumericalError
        If six solutions could not be told apart.

    Examples
    --------
    >>> from scipy.spatial.transform import Rotation
    >>> turned = Rotation.from_euler("ZX", [(0, 0), (40, 10), (70, 60), (120, 100), (200, 170)], degrees=True)
    >>> every = dyads_of_five(Orientations.from_rotation(turned))
    >>> len(every.dyads) + every.complex_solutions
    6
    """
    if len(orientations) != 5:
        raise UnsolvableError(f"{len(orientations)} orientations; six dyads require 5")
    m = orientations.matrices
    conditions = m[1:] - m[0]
    conditions /= np.linalg.norm(conditions, axis=(1, 2), keepdims=True)  # small turns weigh as much as large ones
    kernel, gap = _kernel(conditions)
    if gap < DOUBLE.zero:
        raise _without_number(gap)
    forms = _forms(kernel)
    fixed, moving = _six(conditions, kernel, forms)
    gap = min(gap, *(_second_smallest(conditions, g, w) for g, w in zip(fixed, moving, strict=True)))
    if gap < DOUBLE.zero:
        raise _without_number(gap)
    residual = float(max(_misses(conditions, g, w) for g, w in zip(fixed, moving, strict=True)))
    real, number = _real_ones(conditions, fixed, moving)
    dyads = [dyad_of(orientations, g, w) for g, w in real]
    order = canonical_order([np.concatenate([dyad.fixed, dyad.moving]) for dyad in dyads])
    return DyadsOfFive(tuple(dyads[place] for place in order), _SOLUTIONS - number, residual, gap)


def _kernel(conditions: Floats) -> tuple[Floats, float]:
    """Return the kernel of the twelve equations, float[6, 3, 6]: by G_a G_b, by W_j, by vector of the kernel."""
    equations = np.zeros((4, 3, 6, 3))
    for i in range(3):
        for times in range(3):
            equations[:, times, PLACE[i, times]] += conditions[:, i]
    parts = split(equations.reshape(12, 18))
    return parts.right[12:].T.reshape(6, 3, 6), float(parts.values[11] / parts.values[0])


def _without_number(gap: float) -> UnsolvableError:
    return UnsolvableError(
        "infinitely many dyads, complex ones counted, take these orientations (are most of them turns about one "
        f"axis, or about axes of symmetry?): a singular value is {gap:.0e}"
    )


def _forms(kernel: Floats) -> Floats:
    """Return random pairs of linear forms in W, the most regular pencil first: float[tries, 2, 3].

    Raise `UnsolvableError` if every one is singular: then there are infinitely many solutions.
    """
    forms = _random_forms()
    sizes = singular_values(np.einsum("tfj,ajk->tfak", forms, kernel)[:, 1])
    ratios = sizes[:, -1] / sizes[:, 0]
    if ratios.max() < DOUBLE.zero:
        raise _without_number(float(ratios.max()))
    return np.asarray(forms[np.argsort(-ratios)])


def _random_forms() -> Floats:
    return np.random.default_rng(20110802).normal(size=(_TRIES, 2, 3))


def pencils(kernels: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the most regular pencil of each of many kernels, float[N, 6, 3, 6], and how regular it is, float[N]."""
    every = np.einsum("tfj,najk->ntfak", _random_forms(), kernels)
    sizes = singular_values(every[:, :, 1])
    ratios = sizes[..., -1] / sizes[..., 0]
    best = ratios.argmax(axis=1)
    chosen = every[np.arange(len(every)), best]
    return chosen[:, 0], chosen[:, 1], ratios[np.arange(len(every)), best]


def _second_smallest(conditions: Floats, g: Numbers, w: Numbers) -> float:
    """Return zero if one of the axes of a solution leaves the other a whole plane."""
    by_w, by_g = np.einsum("i,kij->kj", g, conditions), conditions @ w
    return float(min(singular_values(rows)[1] for rows in (by_w, by_g)))


def _six(conditions: Floats, kernel: Floats, forms: Floats) -> tuple[Complexes, Complexes]:
    """Return the six solutions as unit vectors, complex[6, 3] each, by the first pencil that tells them apart."""
    closest, worst = 0.0, np.inf
    for pair_of_forms in forms:
        solutions = [_polished(conditions, *pair) for pair in _eigenpairs(kernel, pair_of_forms)]
        fixed, moving = (np.array(axes) for axes in zip(*solutions, strict=True))
        worst = max(_misses(conditions, g, w) for g, w in solutions)
        products = np.einsum("ki,kj->kij", fixed, moving).reshape(_SOLUTIONS, 9)
        overlap = np.abs(products.conj() @ products.T) - np.eye(_SOLUTIONS)
        closest = float(np.sqrt(max(0.0, 1.0 - overlap.max())))
        # near a double solution the conditions lose rank: there two of the six may lie closer than the bound
        worst_condition = max(np.linalg.cond(_linearised(conditions, g, w)[0]) for g, w in solutions)
        double = worst_condition > 0.01 / DOUBLE.same_configuration
        if worst < SOLVED and (closest > DOUBLE.same_configuration or double):
            return fixed, moving
    raise NumericalError(
        f"six dyads could not be told apart: residual {worst:.0e}, two of them {closest:.0e} from each other"
    )


def _eigenpairs(kernel: Floats, forms: Floats) -> list[tuple[Complexes, Complexes]]:
    """Return G and W of the eigenvectors of the pencil that two linear forms in W make of the kernel.

    A kernel vector that belongs to a solution is the product of the squares of G and of W: a matrix of rank one.
    """
    from scipy.linalg import eig

    first, second = np.einsum("fj,ajk->fak", forms, kernel)
    _, vectors = eig(first, second)
    pairs = []
    for vector in vectors.T:
        products = kernel @ vector
        w = _longest(products)
        square = (products @ w.conj())[[PLACE[a, b] for a in range(3) for b in range(3)]].reshape(3, 3)
        pairs.append((_longest(square), w))
    return pairs


def _longest(rows: Complexes) -> Complexes:
    return np.asarray(rows[np.argmax(np.linalg.norm(rows, axis=1))])


def _polished(conditions: Floats, g: Numbers, w: Numbers) -> tuple[Numbers, Numbers]:
    """Return a solution as unit vectors, by Newton's method from one that is nearly right.

    Steps are orthogonal to G and to W: a solution is a pair of directions, lengths are free.
    """
    g, w = g / np.linalg.norm(g), w / np.linalg.norm(w)
    for _ in range(_NEWTON_STEPS):
        jacobian, value = _linearised(conditions, g, w)
        step = np.linalg.lstsq(jacobian, -np.concatenate([value, [0.0, 0.0]]), rcond=None)[0]
        g, w = g + step[:3], w + step[3:]
        g, w = g / np.linalg.norm(g), w / np.linalg.norm(w)
        if np.linalg.norm(step) < 1e-15:
            break
    return g, w


def _linearised(conditions: Floats, g: Numbers, w: Numbers) -> tuple[Numbers, Numbers]:
    """Return derivatives, complex[6, 6], and values, complex[4], of the conditions at a pair of unit vectors."""
    by_w = np.einsum("i,kij->kj", g, conditions)
    by_g = conditions @ w
    lengths = np.zeros((2, 6), dtype=np.result_type(g, w))
    lengths[0, :3], lengths[1, 3:] = g.conj(), w.conj()
    return np.vstack([np.hstack([by_g, by_w]), lengths]), by_w @ w


def _misses(conditions: Floats, g: Numbers, w: Numbers) -> float:
    return float(np.abs(np.einsum("i,kij,j->k", g, conditions, w)).max())


def _real_ones(conditions: Floats, fixed: Complexes, moving: Complexes) -> tuple[list[tuple[Floats, Floats]], int]:
    """Return the real solutions, each once, and how many of the six are real."""
    real: list[tuple[Floats, Floats]] = []
    number = 0
    for g, w in zip(map(_turned, fixed), map(_turned, moving), strict=True):
        apart = max(np.linalg.norm(g.imag), np.linalg.norm(w.imag))
        if apart > NEARLY_REAL:
            continue
        near = []
        for side in (0.0,) if apart < DOUBLE.same_configuration / 100.0 else (1.0, -1.0):
            start = g.real + side * g.imag, w.real + side * w.imag
            one = _polished(conditions, *start)
            if _misses(conditions, *one) < SOLVED and _apart(one, start) < 10.0 * NEARLY_REAL:
                near.append(one)
        number += bool(near)
        for one in near:
            if all(_apart(one, other) > DOUBLE.same_configuration for other in real):
                real.append(one)
    return real, number


def _turned(axis: Complexes) -> Complexes:
    """Return a complex direction times the number that makes it as real as it can be."""
    phase = np.sqrt(axis @ axis)
    return axis if phase == 0.0 else axis * (phase.conjugate() / abs(phase))


def _apart(pair: tuple[Floats, Floats], other: tuple[Floats, Floats]) -> float:
    return max(map(_sine_between, pair, other))


_GRID = 2000
_NEIGHBOURS = 7
_MOST_STARTS = 100
_MOST = 12
"""How many dyads are given; those that fit worse are left out."""


def dyads_by_least_squares(orientations: Orientations) -> tuple[Dyad, ...]:
    """Return dyads that guide a body nearly through orientations, those with the least error first.

    Each is a local minimum of the sum of squared errors. To find them all, the fixed axis is tried on a grid over
    the sphere, with the best moving axis for each; every point of the grid that is better than those around it is
    the start of a least-squares fit. Minima narrower than the grid (4 degrees) may be missed.

    Parameters
    ----------
    orientations : Orientations
        Five or more; `UnsolvableError` if infinitely many dyads take them without error.

    Examples
    --------
    >>> from scipy.spatial.transform import Rotation
    >>> angles = [(0, 0), (40, 10), (70, 60), (120, 100), (200, 170), (300, 10), (330, 99)]
    >>> turned = Orientations.from_rotation(Rotation.from_euler("ZX", angles, degrees=True))
    >>> dyads_by_least_squares(turned)[0].misfit < 1e-9
    True
    """
    if len(orientations) < 5:
        raise UnsolvableError(f"{len(orientations)} orientations have dyads without error; choose among those")
    minima: list[tuple[float, Dyad]] = []
    for start in _starts(orientations):
        error, dyad = _fitted(orientations, start)
        if all(
            min(_sine_between(dyad.fixed, d.fixed), 1.0) + _sine_between(dyad.moving, d.moving)
            > DOUBLE.same_configuration
            for _, d in minima
        ):
            minima.append((error, dyad))
    order = canonical_order([np.concatenate([[error], dyad.fixed, dyad.moving]) for error, dyad in minima])
    return tuple(minima[place][1] for place in order[:_MOST])


def fibonacci_sphere(count: int) -> Floats:
    """Return points spread evenly over the sphere: float[count, 3]."""
    k = np.arange(count) + 0.5
    z = 1.0 - 2.0 * k / count
    turn = k * np.pi * (3.0 - np.sqrt(5.0))
    across = np.sqrt(1.0 - z * z)
    return np.stack([across * np.cos(turn), across * np.sin(turn), z], axis=1)


def _starts(orientations: Orientations) -> Floats:
    """Return the points of a grid of fixed axes that are better than their neighbours."""
    from scipy.spatial import cKDTree

    grid = fibonacci_sphere(2 * _GRID)
    grid = grid[grid[:, 2] > 0.0]
    apart = orientations.matrices - orientations.matrices.mean(axis=0)
    moments = np.tensordot(apart, apart, axes=(0, 0))  # no array grows with both grid and orientations
    errors = np.linalg.eigvalsh(np.einsum("ma,ajbk,mb->mjk", grid, moments, grid))[:, 0]
    if np.median(errors) < DOUBLE.zero * np.trace(np.einsum("ajbj->ab", moments)):
        raise UnsolvableError("infinitely many dyads take these orientations (are they turns about one axis?)")
    both_ends = np.concatenate([grid, -grid])
    _, near = cKDTree(both_ends).query(grid, _NEIGHBOURS)
    lowest = np.flatnonzero(errors <= errors[near % len(grid)].min(axis=1))
    return np.asarray(grid[lowest[np.argsort(errors[lowest])][:_MOST_STARTS]])


def _fitted(orientations: Orientations, start: Floats) -> tuple[float, Dyad]:
    from scipy.optimize import least_squares

    m = orientations.matrices

    def errors(axes: Floats) -> Floats:
        g, w = axes[:3], axes[3:]
        lengths = np.array([np.linalg.norm(g), np.linalg.norm(w)])
        angles = np.arccos(np.clip(m @ w @ g / lengths.prod(), -1.0, 1.0))
        return np.concatenate([angles - angles.mean(), lengths - 1.0])

    best = least_squares(
        errors, np.concatenate([start, nearest_moving_axis(orientations, start)]), xtol=1e-15, ftol=1e-15, gtol=1e-15
    )
    return float(best.cost), dyad_of(orientations, best.x[:3], best.x[3:])


def _sine_between(a: Floats, b: Floats) -> float:
    return float(np.linalg.norm(np.cross(a, b)))
