"""Quadratic equations between the rates at a pose: what each self-stress of the closure equations asks for.

Round a loop the twists x_i of the joints, at rates r_i, sum to zero to first order. To second order the sum over
i < j of r_i r_j [x_i, x_j] has to be made up for by accelerations, and what is across all twists sees none of
these: a self-stress w gives the equation w . sum r_i r_j [x_i, x_j] = 0. A loop has self-stresses of its own (a
flat vertex, the one across the sheet); several loops may have more together, since their accelerations are shared.
Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from graphs.loops.loop import Centre
from graphs.rank.singular_values import null_space, row_space
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.motion.linkage import PosedLinkage, PosedLoop

__all__ = [
    "MOST_ROWS",
    "Quadric",
    "all_quadrics",
    "local_forms",
    "quadrics_of",
    "rows_of",
    "shared_quadrics",
]

MOST_ROWS = 600
"""Self-stresses of several loops together are looked for up to so many closure equations."""


@dataclass(frozen=True, slots=True)
class Quadric:
    """A quadratic equation between the rates r of k joints: ``r @ form @ r`` has to vanish, the form symmetric."""

    joints: tuple[int, ...]
    form: Floats


def quadrics_of(linkage: PosedLinkage, zero: float = DOUBLE.zero) -> list[Quadric]:
    """Return what the self-stresses of each loop alone ask of the rates at the pose.

    Singular values below `zero` times the largest are zero, and forms whose entries are below it.
    """
    quadrics = []
    for loop in linkage.loops:
        twists = _twists(linkage, loop)
        stresses = null_space(twists.T, zero)
        if not stresses.shape[1]:
            continue
        for form in np.moveaxis(_second_order(twists) @ stresses, -1, 0):
            if np.abs(form).max(initial=0.0) > zero:
                quadrics.append(Quadric(loop.joints, form))
    return quadrics


def shared_quadrics(
    linkage: PosedLinkage, tangent: Floats, alone: Sequence[Quadric], zero: float = DOUBLE.zero
) -> list[Quadric]:
    """Return what self-stresses of several loops ask for beyond those of the loops alone.

    The equations are for the rates that agree to first order, orthonormal columns float[J, s]; none is a sum of
    others, or of those of the loops alone (`quadrics_of`), on these rates. The matrix of all closure equations is
    dense here: for `rows_of` up to `MOST_ROWS`.
    """
    size = tangent.shape[1]
    twists = [_twists(linkage, loop) for loop in linkage.loops]
    rows = np.cumsum([0, *map(len, twists)])
    matrix = np.zeros((rows[-1], len(tangent)))
    seen = np.zeros((size, size, rows[-1]))  # by each closure equation, on the tangent space
    for loop, block, start, end in zip(linkage.loops, twists, rows, rows[1:], strict=False):
        joints = list(loop.joints)
        matrix[start:end, joints] = block
        here = tangent[joints]
        seen[:, :, start:end] = np.einsum("ia,ijw,jb->abw", here, _second_order(block), here, optimize=True)
    stresses = null_space(matrix.T, zero) if size and rows[-1] else np.zeros((rows[-1], 0))
    if not stresses.shape[1]:
        return []
    forms = (seen @ stresses).reshape(size * size, -1).T
    known = local_forms(tangent, alone).reshape(-1, size * size)
    return [
        Quadric(tuple(range(len(tangent))), tangent @ form.reshape(size, size) @ tangent.T)
        for form in _beyond(forms, known, zero)
    ]


def all_quadrics(linkage: PosedLinkage, tangent: Floats, zero: float = DOUBLE.zero) -> list[Quadric]:
    """Return the equations of the loops alone and, up to `MOST_ROWS` closure equations, `shared_quadrics`.

    Which loops without a centre are listed is a choice among many: where others are sought, those that they have
    alone are among these.
    """
    if rows_of(linkage) > MOST_ROWS:
        return quadrics_of(linkage, zero)
    centred = replace(linkage, loops=tuple(loop for loop in linkage.loops if loop.centre is not Centre.NONE))
    alone = quadrics_of(centred, zero)
    return alone + shared_quadrics(linkage, tangent, alone, zero)


def rows_of(linkage: PosedLinkage) -> int:
    """Return the number of closure equations: three of a loop about a point, six of any other."""
    return sum(3 if loop.centre is Centre.FINITE else 6 for loop in linkage.loops)


def local_forms(basis: Floats, quadrics: Sequence[Quadric]) -> Floats:
    """Return the forms of equations on a space of rates, each as part of its size: float[n, s, s]."""
    made = np.zeros((len(quadrics), basis.shape[1], basis.shape[1]))
    for number, quadric in enumerate(quadrics):
        local = basis[list(quadric.joints)]
        made[number] = local.T @ quadric.form @ local / np.abs(quadric.form).max()
    return made


def _beyond(rows: Floats, known: Floats, zero: float) -> Floats:
    """Return orthonormal rows that span, together with known ones, what all rows span."""
    if len(known):
        spanned = row_space(known, zero)
        rows = rows - (rows @ spanned) @ spanned.T
    return row_space(rows, zero, scale=1.0).T  # stresses and rates are unit vectors, brackets of the size of one


def _twists(linkage: PosedLinkage, loop: PosedLoop) -> Floats:
    """Return the twists of a loop's joints at the pose, as the loop passes them: float[3 or 6, k]."""
    joints = list(loop.joints)
    axes = linkage.directions[joints] * np.array(loop.signs, dtype=float)[:, None]
    if loop.centre is Centre.FINITE:  # about the centre there are no moments
        return np.asarray(axes.T)
    points = linkage.points[joints] - linkage.points[joints].mean(axis=0)
    return np.concatenate([axes, np.cross(points, axes)], axis=1).T


def _second_order(twists: Floats) -> Floats:
    """Return the forms of r -> sum over i < j of r_i r_j [x_i, x_j], one for each coordinate: float[k, k, e]."""
    turn, shift = twists[:3].T, twists[3:].T
    brackets = np.cross(turn[:, None], turn[None])
    if len(twists) > 3:
        moments = np.cross(turn[:, None], shift[None]) + np.cross(shift[:, None], turn[None])
        brackets = np.concatenate([brackets, moments], axis=-1)
    upper = brackets * np.triu(np.ones(brackets.shape[:2]), 1)[..., None]  # twist i comes before twist j
    return np.asarray(upper + upper.transpose(1, 0, 2)) / 2.0
