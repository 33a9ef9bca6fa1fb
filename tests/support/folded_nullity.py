"""The nullity of closure equations at folded configurations along a branch: a second opinion on degrees of freedom.

Nothing of the search for branches is used but the motion itself: the matrix at each fold is decomposed, and its
spectrum is read at its widest gap, with creases that are immobile on the whole branch welded.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from graphs.mechanism.sheet import Sheet
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.motion.driven_motion import MotionOptions
from synth.analysis.motion.motion import motion_of
from synth.analysis.motion.singular.sampling import located

FOLDS = 5
_LARGEST_ZERO = 1e-6
"""Zeros of folded sheets are 1e-12 of the largest value and less; the softest sheets known have values of 1e-5."""
_ROUNDED = 1e-16


@dataclass(frozen=True)
class FoldedNullity:
    """Nullities at the folds of one motion, with immobile creases welded, and the least gap, in powers of ten.

    `freedoms` are those that the branch is said to have; None where branches were not looked for.
    """

    freedoms: int | None
    nullities: tuple[int, ...]
    gap: float


def nullity_at_gap(matrix: np.ndarray) -> tuple[int, float]:
    """Return the nullity of a matrix where its spectrum has the widest gap above small values, and that gap."""
    size = matrix.shape[1]
    if not matrix.size:
        return size, np.inf
    values = scipy.linalg.svdvals(matrix)
    parts = np.maximum(np.pad(values, (0, max(size - len(values), 0))) / max(values[0], _ROUNDED), _ROUNDED)
    if parts[0] <= _ROUNDED:
        return size, np.inf
    ratios = np.where(parts[1:] <= _LARGEST_ZERO, parts[:-1] / parts[1:], 0.0)
    if not ratios.any():
        return 0, np.inf
    place = int(np.argmax(ratios))
    return size - place - 1, float(np.log10(ratios[place]))


def folded_nullity(sheet: Sheet) -> FoldedNullity:
    """Fold a sheet as `synth fold` does and read the nullity at its first folds.

    Frames at which panels already lie on each other, or nothing has moved, are left out.
    """
    at = configuration_of_sheet(sheet)
    motion = motion_of(at, MotionOptions(frames=FOLDS + 1))
    angles = motion.path.angles
    welded = np.zeros(len(at.joints), dtype=bool)
    if motion.taken is None:  # one motion stands for all: what it leaves at rest is all that is known
        welded = np.abs(angles - angles[0]).max(axis=0) <= 1e-7
    else:
        welded[list(motion.taken.immobile)] = True
    each = [nullity_at_gap(_matrix(at.closure, fold)[:, ~welded]) for fold in angles[1 : FOLDS + 1]]
    nullities, gaps = tuple(nullity for nullity, _ in each), [gap for _, gap in each]
    return FoldedNullity(motion.freedoms, nullities, min(gaps, default=np.inf))


def _matrix(closure, fold):
    return closure.at(located(closure, fold))[1].toarray()
