"""Branches: the ways in which a linkage can move from a pose.

At a regular pose there is one. At a singular one, such as a flat sheet, the rates that agree to second order fall
into spaces (`synth.folding.second_order`), and what equations are left on one may part it into two halves that
only the pose joins. Each is followed to a fold of ten degrees; the freedoms there are those of the branch. Up to
the sign of all rates together; farther off, two branches may be one curve. Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import pi, radians
from typing import Literal

import numpy as np

from graphs.arrays import Floats
from graphs.loops.loop import Centre
from graphs.rank.singular_values import spectrum
from synth.folding.closure import ClosureEquations
from synth.folding.linkage import PosedLinkage
from synth.folding.path import driven_path
from synth.folding.second_order import Quadric, RateSpace, quadrics_of, rate_spaces, rates_at

__all__ = ["Branch", "Branches", "Certainty", "branches_of", "freedoms_at"]

Certainty = Literal["proved", "numerical", "not known"]

FOLLOWED = radians(10.0)
"""How far each branch is followed, radians of the joint that moves most."""
_MOST = 4096
_STARTS = 60
"""Starts of the search for rates on which equations are left, for each pattern of signs."""
_AGREES = 1e-9
_STILL = 1e-7
_ERROR = 1e-10
"""Of the derivatives at a pose that closes to 1e-12."""


@dataclass(frozen=True, slots=True)
class Branch:
    """One way to move from a pose.

    Attributes
    ----------
    freedoms : int or None
        At a general pose of the branch; None where it could not be followed, or singular values do not tell.
    certainty : {"proved", "numerical", "not known"}
        Proved: the pose is regular, or the branch is linear in tan(fold / 2). Numerical: followed with closed
        loops. Not known: rates agree to second order, and no motion was found.
    rates : float[J]
        Of a motion along the branch, at the pose; the largest is 1 or -1.
    still : tuple of int
        Places of the joints that do not move on it.
    sample : float[J]
        Joint angles of a pose on it, radians.
    error : float
        By how much loops do not close there.
    followed : float
        How far the joint that moves most has moved there, radians.
    """

    freedoms: int | None
    certainty: Certainty
    rates: Floats
    still: tuple[int, ...]
    sample: Floats
    error: float
    followed: float

    @property
    def signs(self) -> str:
        """How each joint begins: ``+`` valley, ``-`` mountain, ``0`` not at all."""
        return "".join("0" if abs(rate) <= _STILL else "+-"[int(rate < 0)] for rate in self.rates)


@dataclass(frozen=True, slots=True)
class Branches:
    """All branches that were found at a pose.

    Attributes
    ----------
    branches : tuple of Branch
    exhaustive : bool
        Whether there are no others: every choice of modes was tried, and rates that agree to second order are
        all there are.
    regular : bool
        Whether the pose is a general one, with one branch.
    """

    branches: tuple[Branch, ...]
    exhaustive: bool
    regular: bool


def branches_of(linkage: PosedLinkage, closure: ClosureEquations | None = None) -> Branches:
    """Return the ways in which a linkage can move from its pose.

    Parameters
    ----------
    linkage : PosedLinkage
        Closed at its pose.
    closure : ClosureEquations, optional
        Of this linkage, where they are at hand.

    Examples
    --------
    Four creases that meet in a point, flat: two ways to fold.

    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.folding.linkage import linkage_of_sheet
    >>> corners = ((0, 0), (1, 0), (.5, .9), (-1, 0), (-.5, -.7))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> found = branches_of(linkage_of_sheet(Sheet(5, (), "", faces, corners)))
    >>> [(branch.freedoms, branch.certainty) for branch in found.branches], found.exhaustive
    ([(1, 'numerical'), (1, 'numerical')], True)
    """
    closure = closure or ClosureEquations(linkage)
    quadrics = quadrics_of(linkage)
    spaces, complete = rate_spaces(closure, linkage.angles, quadrics, _MOST)
    whole = rates_at(closure, linkage.angles).shape[1]
    regular = len(spaces) == 1 and not spaces[0].left and spaces[0].basis.shape[1] == whole
    linear = _linear_in_half_tangents(linkage)
    branches: list[Branch] = []
    for space in spaces:
        proved = regular and _full_row_rank(closure, linkage.angles)
        proved = proved or (linear and not space.left)
        branches += [_followed(linkage, closure, space, rates, proved) for rates in _samples(space)]
    return Branches(tuple(branches), complete and (linear or regular) and all(not s.left for s in spaces), regular)


def freedoms_at(closure: ClosureEquations, angles: Floats) -> int | None:
    """Return the infinitesimal freedoms at a closed pose; None where singular values do not tell."""
    _, jacobian = closure.at(angles)
    rank = spectrum(jacobian.toarray(), _ERROR).rank
    return None if rank is None else closure.joints - rank


def _followed(
    linkage: PosedLinkage, closure: ClosureEquations, space: RateSpace, rates: Floats, proved: bool
) -> Branch:
    """Follow one branch and say what it is."""
    rates = rates / np.abs(rates).max()
    driver = int(np.abs(rates).argmax())
    goal = linkage.angles[driver] + FOLLOWED * np.sign(rates[driver])
    path = driven_path(closure, linkage.angles, driver, [goal], direction=rates, straight=True)
    end, error = path.angles[-1], float(path.errors[-1])
    came = float(np.abs(end - linkage.angles).max())
    still = tuple(np.flatnonzero(np.abs(space.basis).max(axis=1) <= _STILL).tolist())
    moved = not path.stopped
    freedoms = freedoms_at(closure, end) if moved else None
    known: Certainty = "proved" if proved and moved else "numerical" if moved else "not known"
    return Branch(freedoms, known, rates, still, end, error, came)


def _full_row_rank(closure: ClosureEquations, angles: Floats) -> bool:
    return freedoms_at(closure, angles) == closure.joints - closure.rows


def _linear_in_half_tangents(linkage: PosedLinkage) -> bool:
    """Tell whether every loop is a flat vertex of four creases whose opposite sectors make 180 degrees."""
    flat = np.abs(linkage.angles).max(initial=0.0) <= _AGREES
    return bool(flat and all(_folds_flat(linkage, loop.joints, loop.centre) for loop in linkage.loops))


def _folds_flat(linkage: PosedLinkage, joints: Sequence[int], centre: Centre) -> bool:
    if centre is not Centre.FINITE or len(joints) != 4:
        return False
    apex = _meeting_point(linkage, joints)
    away = linkage.points[list(joints)] - apex
    outward = away / np.linalg.norm(away, axis=1, keepdims=True)
    sectors = [float(np.arccos(np.clip(a @ b, -1.0, 1.0))) for a, b in pairwise([*outward, outward[0]])]
    return abs(sectors[0] + sectors[2] - pi) <= _AGREES and abs(sum(sectors) - 2 * pi) <= _AGREES


def _meeting_point(linkage: PosedLinkage, joints: Sequence[int]) -> Floats:
    """Return the point nearest to some axes."""
    axes, points = linkage.directions[list(joints)], linkage.points[list(joints)]
    across = np.eye(3) - axes[:, :, None] * axes[:, None, :]
    return np.linalg.lstsq(across.reshape(-1, 3), (across @ points[..., None]).ravel(), rcond=None)[0]


def _samples(space: RateSpace) -> list[Floats]:
    """Return general rates of a space, one for each part that its equations leave, up to sign."""
    chance = np.random.default_rng(space.basis.shape)
    if not space.left:
        return [space.basis @ _general(chance, space.basis.shape[1])]
    halves = [_half_of(space, quadric) for quadric in space.left]
    split = [half for half in halves if half is not None]
    found: dict[tuple[int, ...], Floats] = {}
    for _ in range(_STARTS * 2 ** min(len(split), 6)):
        rates = _on_all(space, chance)
        if rates is None:
            continue
        signs = tuple(int(np.sign(half @ rates)) for half in split)
        if signs and signs[0] < 0:
            rates, signs = -rates, tuple(-sign for sign in signs)
        found.setdefault(signs, rates)
        if len(found) == 2 ** max(len(split) - 1, 0):
            break
    return [found[signs] for signs in sorted(found, reverse=True)]


def _general(chance: np.random.Generator, size: int) -> Floats:
    return np.asarray(chance.uniform(0.5, 1.0, size) * chance.choice([-1.0, 1.0], size))


def _on_all(space: RateSpace, chance: np.random.Generator) -> Floats | None:
    """Return rates of a space on which all equations left hold, by Newton's method from a random start."""
    x = chance.normal(size=space.basis.shape[1])
    forms = [space.basis[list(q.joints)].T @ q.form @ space.basis[list(q.joints)] for q in space.left]
    for _ in range(30):
        x = x / np.linalg.norm(x)
        off = np.array([x @ form @ x for form in forms])
        if np.abs(off).max() < 1e-15 * max(np.abs(form).max() for form in forms) * len(x):
            break
        slopes = np.array([2.0 * form @ x for form in forms])
        x = x - np.linalg.lstsq(slopes, off, rcond=1e-12)[0]
    else:
        off = np.array([x @ form @ x for form in forms])
    if np.abs(off).max() > _AGREES * max(np.abs(form).max() for form in forms):
        return None
    return np.asarray(space.basis @ x)


def _half_of(space: RateSpace, quadric: Quadric) -> Floats | None:
    """Return what has one sign on one half of an equation's solutions, where these are two cones tip to tip."""
    local = space.basis[list(quadric.joints)]
    form = local.T @ quadric.form @ local
    values, vectors = np.linalg.eigh(form)
    there = np.abs(values) > _AGREES * np.abs(values).max()
    for sign in (1.0, -1.0):
        single = np.flatnonzero(there & (np.sign(values) == sign))
        if len(single) == 1:
            return np.asarray(space.basis @ vectors[:, single[0]])
    return None
