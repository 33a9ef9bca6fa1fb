"""A crease pattern with the mountain-valley assignment of one of its branches.

Theory: docs/theory/verdict.md.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from graphs.creasing.edits import SheetEdit
from graphs.errors import UnsolvableError, check_argument
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.tolerances import DOUBLE
from synth.folding.configuration import SheetConfiguration, configuration_of_sheet
from synth.motion.beginning import Wanted, beginning
from synth.motion.marked import disagreement_with

__all__ = ["assign_branch"]


def assign_branch(sheet: Sheet | SheetConfiguration, branch: int | str) -> SheetEdit:
    """Give a flat crease pattern the mountains and valleys with which a branch begins.

    Of a branch with several freedoms they are those nearest to the assignment it has, up to the sign of all.

    Parameters
    ----------
    sheet : Sheet or SheetConfiguration
        With coordinates, flat.
    branch : int or str
        Its number as `synth fold --branches` and the answers of `mobility` have it, or its signs.

    Returns
    -------
    SheetEdit
        Creases that do not move on the branch are flat (F): panels stay one there, so that the pattern folds on
        this branch as it is marked. Fold angles keep their size and take the sign of their crease.

    Raises
    ------
    UnsolvableError
        If the sheet has no coordinates, is not flat, or nothing moves; if it is too large to look for branches.
    InvariantError
        If there is no such branch.

    Examples
    --------
    A vertex of four creases, all of them marked as mountains:

    >>> corners = ((0, 0), (1, 0), (.5, 1), (-1, 0), (.5, -1))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> sheet = Sheet(5, ((0, 1), (0, 2), (0, 3), (0, 4)), "MMMM", faces, corners)
    >>> [assign_branch(sheet, number).sheet.assignments[:4] for number in (0, 1)]
    ['VMMM', 'MFMF']
    """
    check_argument("assign_branch", sheet, Sheet | SheetConfiguration)
    at = sheet if isinstance(sheet, SheetConfiguration) else configuration_of_sheet(sheet)
    if not at.flat:
        raise UnsolvableError("an assignment says how a flat sheet begins to fold, and this one is folded")
    number, _ = beginning(at, Wanted(branch))
    letters_of = dict(zip(at.joints, _letters(at, number or 0), strict=True))
    drawn = with_all_edges(at.drawn)
    letter_at = {
        frozenset(edge): letters_of[joint]
        for joint, pieces in at.dual.pieces.items()
        if joint in letters_of
        for edge in pieces
    }
    letters = [
        letter_at.get(frozenset(edge), letter) for edge, letter in zip(drawn.edges, drawn.assignments, strict=True)
    ]
    angles = drawn.fold_angles
    if angles is not None:
        angles = tuple(map(_turned, angles, letters))
    after = replace(drawn, assignments="".join(letters), fold_angles=angles, frames=None)
    return SheetEdit(f"assign branch {number or 0}", at.drawn, after)


def _letters(at: SheetConfiguration, number: int) -> list[str]:
    """Return the letter of each joint: M, V, or F where it does not move on the branch."""
    branch = at.branch(number)
    if branch is None:
        raise UnsolvableError("rigid: there is no branch whose assignment the sheet could have")
    near = disagreement_with(number, branch, at.marks)
    general = branch.rates * (-1.0 if branch.rates @ near.rates < 0.0 else 1.0)
    sizes = np.abs(near.rates)
    if not branch.space.left:
        least = sizes[sizes > DOUBLE.zero_rate].min(initial=1.0)
        rates = near.rates + 0.5 * least * general  # joints that can move do, and no other turns over
    else:  # sums of rates are none of the branch
        moving = np.abs(general) > DOUBLE.zero_rate
        rates = near.rates if (sizes[moving] > DOUBLE.zero_rate).all() else general
    late = (at.linkage.angles - branch.sample) * (-1.0 if general @ branch.rates > 0.0 else 1.0)
    late = late / np.abs(late).max(initial=DOUBLE.zero)  # joints without rates may still move, later
    still = np.isin(np.arange(len(rates)), branch.still)
    first = np.where(still | (np.abs(rates) <= DOUBLE.zero_rate), 0.0, rates)
    begins = np.where(first != 0.0, first, np.where(np.abs(late) > DOUBLE.zero_rate, late, 0.0))
    return ["F" if rate == 0.0 else "V" if rate > 0.0 else "M" for rate in begins.tolist()]


def _turned(angle: float | None, letter: str) -> float | None:
    """Return a fold angle with the sign of its crease."""
    if angle is None or letter not in "MVF":
        return angle
    return {"M": -abs(angle), "V": abs(angle), "F": 0.0}[letter]
