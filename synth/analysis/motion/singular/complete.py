"""The points that equations of second order leave on a space of rates: all of them, with the evidence.

Where there are as many forms as there are dimensions less one, all paths to their 2^m common points are followed. If as
many certified points are distinct, no others exist, by Bezout's theorem, and each is regular: a proof. With more forms,
or singular points, a few variables are eliminated: all points, numerically. Theory: docs/theory/branches.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from graphs.tolerances import canonical_basis, signed
from graphs.types import Floats
from synth.analysis.motion.singular.certificate import CertifiedPoint, FormBalls, all_distinct
from synth.analysis.motion.singular.elimination import real_points
from synth.analysis.motion.singular.homotopy import path_ends
from synth.analysis.motion.singular.second_order import RateSpace, local_forms

MOST_FORMS = 10
"""Of more forms 2^m paths are too many to follow: 1024 take two seconds."""
_EVALUATIONS = 2000.0
"""How often forms are evaluated along a path, with what is solved there, in products of numbers for each entry."""
_TRIES, _FEW_LOST = 3, 0.9
"""Where paths jumped to a neighbour, or a few are lost, all are followed again with another start system, so many
times; where more than a tenth are lost the points are no regular ones."""


@dataclass(frozen=True, slots=True)
class PointRates:
    """Rates, float[J], unit vectors up to their sign, at which the equations left on a space vanish.

    Proved: these are all, each alone and regular. Numerical: all, by elimination. Not known: there may be others.
    """

    rates: tuple[Floats, ...]
    evidence: Literal["proved", "numerical", "not known"]


def has_points_only(space: RateSpace) -> bool:
    """Tell whether the equations left on a space may leave points only: they are at least its dimensions less one."""
    return len(space.left) > 1 and len(space.left) >= space.basis.shape[1] - 1


def work_of(space: RateSpace) -> float:
    """Return the work of finding all points of a space by paths, in products of numbers."""
    count, size = len(space.left), space.basis.shape[1]
    return float(_EVALUATIONS * 2 ** min(size - 1, MOST_FORMS) * count * size**2)


def point_rates(space: RateSpace) -> PointRates | None:
    """Return the rates that the equations left on a space have; None if these are not points, or are too many."""
    forms = local_forms(space.basis, space.left)
    count, size = forms.shape[:2]
    if count == size - 1 and count <= MOST_FORMS:
        points = _all_by_paths(forms)
        if points is not None:
            return _of_space(space, points, "proved")
    points = real_points(forms)
    return None if points is None else _of_space(space, points, "numerical")


def _of_space(
    space: RateSpace, points: list[Floats], evidence: Literal["proved", "numerical", "not known"]
) -> PointRates:
    return PointRates(tuple(signed(space.basis @ point) for point in points), evidence)


def _all_by_paths(forms: Floats) -> list[Floats] | None:
    """Return all real common points of m forms in m + 1 variables, if 2^m points are certified to be distinct."""
    forms = forms / np.abs(forms).max(axis=(1, 2), keepdims=True)
    balls = FormBalls(forms)
    for seed in range(_TRIES):
        ends = path_ends(forms, seed)
        if ends.arrived.mean() < _FEW_LOST:
            return None  # singular points, or infinitely many
        points = [point for point in map(balls.certified, ends.points) if point is not None]
        if len(points) == len(ends.points) and all_distinct(points):
            return [_unit(point) for point in points if point.real]
    return None


def _unit(point: CertifiedPoint) -> Floats:
    return np.asarray(point.middle.real / np.linalg.norm(point.middle.real))


def line_of(rates: Floats) -> RateSpace:
    """Return the space of the multiples of some rates."""
    return RateSpace(canonical_basis((rates / np.linalg.norm(rates))[:, None]), ())
