"""Which rates at a singular pose can be the beginning of a motion: what second order says.

Rates at which loops close to first order form a space. To second order each self-stress of the closure equations
adds one quadratic equation on it: where the creases of a flat vertex turn at rates r in their cyclic order, these
sum to zero as vectors, and the sum over pairs i < j of r_i r_j (d_i x d_j) has to vanish too. Where an equation is
a product of two linear ones the rates fall into two subspaces: the two modes of a vertex of four creases. The
solutions are found by taking one mode or the other, as long as anything is left. Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import scipy.linalg
import scipy.sparse

from graphs.arrays import Floats
from graphs.loops.loop import Centre
from synth.folding.closure import ClosureEquations
from synth.folding.linkage import PosedLinkage, PosedLoop
from synth.folding.newton import TangentSpace

__all__ = ["Quadric", "RateSpace", "quadrics_of", "rate_spaces", "rates_at", "rates_near"]

_ZERO = 1e-9
"""Singular values and eigenvalues below this part of the largest are zero."""
_CLOSED, _STEPS = 1e-11, 40
_SAME, _LOST = 1e-6, 10.0
"""Spaces that are this close are one."""


@dataclass(frozen=True, slots=True)
class Quadric:
    """A quadratic equation between the rates of a few joints.

    Attributes
    ----------
    joints : int[k]
        Places of the joints.
    form : float[k, k]
        Symmetric; ``r @ form @ r`` has to vanish.
    """

    joints: tuple[int, ...]
    form: Floats


@dataclass(frozen=True, slots=True)
class RateSpace:
    """Rates that agree to second order: a linear space, on which a few equations may be left.

    Attributes
    ----------
    basis : float[J, s]
        Orthonormal columns.
    left : tuple of Quadric
        Equations that are no products of linear ones on this space.
    """

    basis: Floats
    left: tuple[Quadric, ...]


def quadrics_of(linkage: PosedLinkage) -> list[Quadric]:
    """Return what second order adds to the closure of each loop at the pose.

    Each loop has its own self-stresses: vectors across all twists of its joints. Those that
    only several loops have together are not looked for.
    """
    quadrics = []
    for loop in linkage.loops:
        joints, twists = list(loop.joints), _twists(linkage, loop)
        stresses = scipy.linalg.null_space(twists.T, rcond=_ZERO)
        if not stresses.shape[1]:
            continue
        brackets = _brackets(twists)
        for stress in stresses.T:
            upper = np.triu(brackets @ stress, 1)  # twist i comes before twist j
            if np.abs(upper).max(initial=0.0) > _ZERO:
                quadrics.append(Quadric(tuple(joints), (upper + upper.T) / 2.0))
    return quadrics


def _twists(linkage: PosedLinkage, loop: PosedLoop) -> Floats:
    """Return the twists of a loop's joints at the pose, as the loop passes them: float[6, k]."""
    joints = list(loop.joints)
    axes = linkage.directions[joints] * np.array(loop.signs, dtype=float)[:, None]
    points = linkage.points[joints] - linkage.points[joints].mean(axis=0)
    moments = np.cross(points, axes)
    if loop.centre is Centre.FINITE:  # about the centre there are none
        moments = np.zeros_like(moments)
    return np.concatenate([axes, moments], axis=1).T


def _brackets(twists: Floats) -> Floats:
    """Return the Lie brackets of all pairs of twists: float[k, k, 6]."""
    turn, shift = twists[:3].T, twists[3:].T
    return np.concatenate(
        [
            np.cross(turn[:, None], turn[None]),
            np.cross(turn[:, None], shift[None]) + np.cross(shift[:, None], turn[None]),
        ],
        axis=-1,
    )


def rate_spaces(
    closure: ClosureEquations, angles: Floats, quadrics: Sequence[Quadric], most: int = 4096, zero: float = _ZERO
) -> tuple[list[RateSpace], bool]:
    """Return the spaces of rates that agree to second order, none part of another, and whether these are all.

    Parameters
    ----------
    closure : ClosureEquations
    angles : float[J]
        The pose, radians.
    quadrics : sequence of Quadric
    most : int, optional
        After so many the search ends.
    zero : float, optional
        Singular values and eigenvalues below this part of the largest are zero: what coordinates can tell apart.
    """
    found: list[RateSpace] = []
    complete = True
    for number, space in enumerate(_split(rates_at(closure, angles, zero), tuple(quadrics), zero)):
        if number == most:
            complete = False
            break
        if not any(_within(space, other, zero) for other in found):
            found = [*(other for other in found if not _within(other, space, zero)), space]
    return found, complete


def rates_near(
    closure: ClosureEquations, angles: Floats, quadrics: Sequence[Quadric], wanted: Floats, zero: float = _CLOSED
) -> Floats | None:
    """Return rates that agree to second order, near wanted ones, by Newton's method; for linkages of any size.

    Parameters
    ----------
    closure, angles, quadrics
        As in `rate_spaces`.
    wanted : float[J]
        Rates, or their signs.
    zero : float, optional
        What is left of the equations, at most.

    Returns
    -------
    float[J] or None
        As long as the wanted ones; None where none were found near these.
    """
    _, jacobian = closure.at(angles)
    size = float(np.linalg.norm(wanted))
    rates = TangentSpace(jacobian).projected(wanted)
    rows = np.repeat(np.arange(len(quadrics)), [len(quadric.joints) for quadric in quadrics])
    columns = np.array([joint for quadric in quadrics for joint in quadric.joints], dtype=np.int64)
    for _ in range(_STEPS):
        if not np.linalg.norm(rates) > _SAME * size:
            return None
        rates = rates * (size / np.linalg.norm(rates))
        slopes = [quadric.form @ rates[list(quadric.joints)] for quadric in quadrics]
        values = np.concatenate([np.zeros(0), *slopes])
        quadratic = scipy.sparse.csr_matrix((values, (rows, columns)), shape=(len(quadrics), len(rates)))
        off = np.concatenate([jacobian @ rates, quadratic @ rates])
        if np.abs(off).max(initial=0.0) <= zero:
            return rates
        both = scipy.sparse.vstack([jacobian, 2.0 * quadratic], format="csr")
        rates = rates + TangentSpace(both).step(off)
    return None


def rates_at(closure: ClosureEquations, angles: Floats, zero: float = _ZERO) -> Floats:
    """Return the rates at which loops stay closed to first order: float[J, s], orthonormal columns."""
    _, jacobian = closure.at(angles)
    return np.asarray(scipy.linalg.null_space(jacobian.toarray(), rcond=zero))


def _within(space: RateSpace, other: RateSpace, zero: float) -> bool:
    """Tell whether all rates of one space are those of another."""
    if space.basis.shape[1] > other.basis.shape[1]:
        return False
    outside = space.basis - other.basis @ (other.basis.T @ space.basis)
    if np.abs(outside).max(initial=0.0) > max(_SAME, _LOST * zero):
        return False
    for theirs in other.left:
        if not any(mine is theirs for mine in space.left) and _on(space.basis, theirs, zero) is not None:
            return False
    return True


def _split(basis: Floats, quadrics: tuple[Quadric, ...], zero: float) -> Iterator[RateSpace]:
    """Yield the spaces of solutions within a space, depth first."""
    basis, left, factors = _simplified(basis, quadrics, zero)
    if not basis.shape[1]:
        return
    if factors is None:
        yield RateSpace(basis, left)
        return
    for normal in factors:
        yield from _split(_across(basis, normal), left, zero)


def _simplified(
    basis: Floats, quadrics: tuple[Quadric, ...], zero: float
) -> tuple[Floats, tuple[Quadric, ...], tuple[Floats, Floats] | None]:
    """Use up the equations that are linear on a space; return what is left, and one that is a product.

    An equation that is a product is among those left too: it vanishes on either part.
    """
    product: tuple[Floats, Floats] | None = None
    while True:
        left, product, normals = [], None, None
        for quadric in quadrics:
            kind = _on(basis, quadric, zero)
            if isinstance(kind, _Linear):
                normals = kind.normals
                break
            if kind is not None:
                left.append(quadric)
                if product is None and isinstance(kind, _Product):
                    product = kind.normals
        if normals is None:
            return basis, tuple(left), product
        basis = _across(basis, normals)
        if not basis.shape[1]:
            return basis, (), None


@dataclass(frozen=True, slots=True)
class _Linear:
    normals: Floats


@dataclass(frozen=True, slots=True)
class _Product:
    normals: tuple[Floats, Floats]


def _on(basis: Floats, quadric: Quadric, zero: float) -> _Linear | _Product | str | None:
    """Return what an equation is on a space: linear, a product, quadratic, or None where it always holds."""
    local = basis[list(quadric.joints)]
    form = local.T @ quadric.form @ local
    size = float(np.abs(quadric.form).max(initial=0.0))
    if np.abs(form).max(initial=0.0) <= zero * size:
        return None
    values, vectors = np.linalg.eigh(form)
    there = np.abs(values) > zero * np.abs(values).max()
    values, vectors = values[there], vectors[:, there]
    if (values > 0).all() or (values < 0).all():
        return _Linear(vectors)
    if len(values) == 2:
        plus, minus = np.sqrt(values[1]) * vectors[:, 1], np.sqrt(-values[0]) * vectors[:, 0]
        return _Product((plus + minus, plus - minus))
    return "quadratic"


def _across(basis: Floats, normals: Floats) -> Floats:
    """Return the part of a space across one normal, or several: float[J, s - rank]."""
    columns = normals.reshape(len(normals), -1)
    return np.asarray(basis @ scipy.linalg.null_space(columns.T, rcond=_ZERO))
