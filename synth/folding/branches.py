"""Branches: the ways in which a linkage can move from a pose.

At a regular pose there is one. At a singular one, such as a flat sheet, the rates that agree to second order fall
into spaces (`synth.folding.second_order`), and what equations are left on one may part it into two halves that
only the pose joins. Each is followed to a fold of ten degrees; the freedoms there are those of the branch. Up to
the sign of all rates together; farther off, two branches may be one curve. Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import pi, radians, tan
from typing import Literal

import numpy as np

from graphs.arrays import Floats
from graphs.loops.loop import Centre
from graphs.rank.singular_values import spectrum
from synth.folding.closure import ClosureEquations
from synth.folding.linkage import PosedLinkage
from synth.folding.path import PathOptions, driven_path
from synth.folding.placement import moved
from synth.folding.second_order import Quadric, RateSpace, quadrics_of, rate_spaces, rates_at

__all__ = ["Branch", "Branches", "Certainty", "branches_of", "freedoms_at", "rates_towards"]

Certainty = Literal["proved", "numerical", "not known"]

FOLLOWED = radians(10.0)
"""How far each branch is followed, radians of the joint that moves most."""
_MOST = 4096
_STARTS = 60
"""Starts of the search for rates on which equations are left, for each pattern of signs."""
_AGREES = 1e-9
_STILL = 1e-7
_NEWTON, _ROUNDED = 30, 1e-14
_ERROR = 1e-10
"""Of the derivatives at a pose that closes to 1e-12."""


@dataclass(frozen=True, slots=True)
class Branch:
    """One way to move from a pose.

    Attributes
    ----------
    freedoms : int or None
        At a general pose of the branch, to second order: unless proved, there may be fewer where loops have
        self-stresses together. None where it could not be followed, or second order does not tell.
    certainty : {"proved", "numerical", "not known"}
        Proved: the pose is regular, or the branch is linear in tan(fold / 2). Numerical: followed with closed
        loops. Not known: rates agree to second order, and no motion was found.
    space : RateSpace
        The rates at which it can begin.
    rates : float[J]
        Of one motion along the branch, at the pose; the largest is 1 or -1.
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
    space: RateSpace
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
    complete : bool
        Whether the search came to its end.
    """

    branches: tuple[Branch, ...]
    exhaustive: bool
    regular: bool
    complete: bool


def branches_of(linkage: PosedLinkage, closure: ClosureEquations | None = None, most: int = _MOST) -> Branches:
    """Return the ways in which a linkage can move from its pose.

    Parameters
    ----------
    linkage : PosedLinkage
        Closed at its pose.
    closure : ClosureEquations, optional
        Of this linkage, where they are at hand.
    most : int, optional
        After so many the search ends.

    Examples
    --------
    Four creases that meet in a point, flat: two ways to fold.

    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.folding.linkage import linkage_of_sheet
    >>> corners = ((0, 0), (1, 0), (.5, .9), (-1, 0), (-.5, -.7))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> found = branches_of(linkage_of_sheet(Sheet(5, (), "", faces, corners)))
    >>> [(branch.freedoms, branch.certainty) for branch in found.branches], found.exhaustive
    ([(1, 'numerical'), (1, 'numerical')], False)
    """
    closure = closure or ClosureEquations(linkage)
    quadrics = quadrics_of(linkage)
    spaces, complete = rate_spaces(closure, linkage.angles, quadrics, most)
    whole = rates_at(closure, linkage.angles).shape[1]
    regular = len(spaces) == 1 and not spaces[0].left and spaces[0].basis.shape[1] == whole
    linear = _linear_in_half_tangents(linkage)
    proved = regular and _full_row_rank(closure, linkage.angles)
    branches: list[Branch] = []
    for space in spaces:
        follow = _in_half_tangents if linear and not space.left else _followed
        for rates in _samples(space):
            branches.append(follow(linkage, closure, space, rates / np.abs(rates).max()))
            if proved and branches[-1].freedoms is not None:
                branches[-1] = replace(branches[-1], certainty="proved")
    every = complete and (linear or regular) and not any(space.left for space in spaces)
    return Branches(tuple(branches), every, regular, complete)


def rates_towards(space: RateSpace, wanted: Floats) -> Floats:
    """Return rates of a space near wanted ones, the largest 1 or -1; zeros if there are none."""
    start = space.basis.T @ wanted
    if not start.any():
        return np.zeros_like(wanted)
    rates = _on_equations(space, np.asarray(start)) if space.left else space.basis @ start
    return np.zeros_like(wanted) if rates is None else np.asarray(rates / np.abs(rates).max())


def freedoms_at(linkage: PosedLinkage, closure: ClosureEquations, angles: Floats) -> int | None:
    """Return the freedoms of motions through a general closed pose, to second order; None if that does not tell.

    Rates that close to first order may be more than a linkage can use at every pose of a branch: a sheet that is
    folded along one straight line, for instance, has creases that lie in one plane.
    """
    spaces, _ = rate_spaces(closure, angles, quadrics_of(moved(linkage, angles)), _MOST)
    if len(spaces) != 1 or spaces[0].left:
        return None if spaces else 0
    return int(spaces[0].basis.shape[1])


def _followed(linkage: PosedLinkage, closure: ClosureEquations, space: RateSpace, rates: Floats) -> Branch:
    """Follow one branch and say what it is."""
    driver = int(np.abs(rates).argmax())
    goal = linkage.angles[driver] + FOLLOWED * np.sign(rates[driver])
    path = driven_path(closure, linkage.angles, [driver], goal, options=PathOptions(rates, straight=True))
    end, came = path.angles[-1], not path.stopped
    return Branch(
        freedoms_at(linkage, closure, end) if came else None,
        "numerical" if came else "not known",
        space,
        rates,
        _still(space),
        end,
        float(path.errors[-1]),
        float(np.abs(end - linkage.angles).max()),
    )


def _in_half_tangents(linkage: PosedLinkage, closure: ClosureEquations, space: RateSpace, rates: Floats) -> Branch:
    """Return a branch along which tan(fold / 2) is any of its rates: it has as many freedoms as these."""
    end = 2.0 * np.arctan(tan(FOLLOWED / 2.0) * rates)
    freedoms = space.basis.shape[1]
    return Branch(freedoms, "proved", space, rates, _still(space), end, closure.error(end), FOLLOWED)


def _still(space: RateSpace) -> tuple[int, ...]:
    return tuple(np.flatnonzero(np.abs(space.basis).max(axis=1) <= _STILL).tolist())


def _full_row_rank(closure: ClosureEquations, angles: Floats) -> bool:
    _, jacobian = closure.at(angles)
    return spectrum(jacobian.toarray(), _ERROR).rank == closure.rows


def _linear_in_half_tangents(linkage: PosedLinkage) -> bool:
    """Tell whether every loop is a flat vertex of four creases whose opposite sectors make 180 degrees."""
    flat = np.abs(linkage.angles).max(initial=0.0) <= _AGREES
    return bool(flat and all(_folds_flat(linkage, loop.joints, loop.centre) for loop in linkage.loops))


def _folds_flat(linkage: PosedLinkage, joints: Sequence[int], centre: Centre) -> bool:
    if centre is not Centre.FINITE or len(joints) != 4:
        return False
    apex = _meeting_point(linkage, joints)
    away = linkage.points[list(joints)] - apex
    at_apex = np.linalg.norm(away, axis=1, keepdims=True) <= _AGREES
    outward = np.where(at_apex, linkage.directions[list(joints)], away)
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    sectors: list[float] = [
        float(np.arccos(np.clip(a @ b, -1.0, 1.0))) for a, b in pairwise([*outward, outward[0]])
    ]
    return abs(sectors[0] + sectors[2] - pi) <= _AGREES and abs(sum(sectors) - 2 * pi) <= _AGREES


def _meeting_point(linkage: PosedLinkage, joints: Sequence[int]) -> Floats:
    """Return the point nearest to some axes."""
    axes, points = linkage.directions[list(joints)], linkage.points[list(joints)]
    across = np.eye(3) - axes[:, :, None] * axes[:, None, :]
    return np.asarray(np.linalg.lstsq(across.reshape(-1, 3), (across @ points[..., None]).ravel(), rcond=None)[0])


def _samples(space: RateSpace) -> list[Floats]:
    """Return general rates of a space, one for each part that its equations leave, up to sign."""
    chance = np.random.default_rng(space.basis.shape)
    if not space.left:
        return [space.basis @ _general(chance, space.basis.shape[1])]
    halves = [_half_of(space, quadric) for quadric in space.left]
    split = [half for half in halves if half is not None]
    found: dict[tuple[int, ...], Floats] = {}
    for _ in range(_STARTS * 2 ** min(len(split), 6)):
        rates = _on_equations(space, np.asarray(chance.normal(size=space.basis.shape[1])))
        if rates is None:
            continue
        signs = tuple(int(np.sign(half @ rates)) for half in split)
        if signs and signs[0] < 0:
            rates, signs = -rates, tuple(-one for one in signs)
        found.setdefault(signs, rates)
        if len(found) == 2 ** max(len(split) - 1, 0):
            break
    return [found[signs] for signs in sorted(found, reverse=True)]


def _general(chance: np.random.Generator, size: int) -> Floats:
    return np.asarray(chance.uniform(0.5, 1.0, size) * chance.choice([-1.0, 1.0], size))


def _on_equations(space: RateSpace, x: Floats) -> Floats | None:
    """Return rates of a space on which all equations left hold, by Newton's method from a start float[s]."""
    forms = np.array([space.basis[list(q.joints)].T @ q.form @ space.basis[list(q.joints)] for q in space.left])
    forms /= np.abs(forms).max(axis=(1, 2), keepdims=True)
    for _ in range(_NEWTON):
        x = x / np.linalg.norm(x)
        slopes = forms @ x
        off = slopes @ x
        if np.abs(off).max() <= _ROUNDED:
            return np.asarray(space.basis @ x)
        x = x - np.linalg.lstsq(2.0 * slopes, off, rcond=_AGREES)[0]
    return None


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
