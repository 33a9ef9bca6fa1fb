"""A crease pattern folded along one of its branches, frame by frame, or given the assignment of a branch.

Theory: docs/theory/folding.md, docs/theory/verdict.md.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from graphs.creasing.edits import SheetEdit
from graphs.errors import UnsolvableError, check_argument
from graphs.files.mechanism_like import MechanismLike, mechanism_for
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.tolerances import DOUBLE
from graphs.types import JointId
from synth.analysis.folding.configuration import SheetConfiguration, configuration_of_sheet
from synth.analysis.motion.assigned_branch import disagreement_with
from synth.analysis.motion.driven_motion import BranchChoice, MotionOptions, beginning
from synth.analysis.motion.motion import FRAMES, SheetMotion, motion_of


def fold(
    mechanism: MechanismLike,
    *,
    drive: Mapping[JointId, float] | None = None,
    along: Mapping[JointId, float] | None = None,
    branch: int | str | None = None,
    frames: int = FRAMES,
    collisions: bool = False,
    precision: float | None = None,
    report: Callable[[int], None] | None = None,
) -> SheetMotion:
    """Fold a crease pattern from its configuration, panels rigid, until the driven creases have their angles.

    Parameters
    ----------
    mechanism : Sheet, or the path of its file
        With coordinates, flat or folded, and closed loops.
    drive : mapping of joint id to float, optional
        Fold angles, radians, valleys positive. By default the crease that moves most is folded as far as it goes.
    along : mapping of joint id to float, optional
        Initial rates of some creases, in place of driven ones; others begin as little as possible. The motion goes
        straight on, with several freedoms, until the crease that began to move most has gone as far as it goes.
    branch : int or str, optional
        Branch from a singular configuration, a flat one above all: its number among
        `synth.analysis.motion.branches_of`, or its signs. By default the one that agrees best with the letters of the
        edges.
    frames : int, optional
        Number of frames after the first.
    collisions : bool, optional
        End before the first frame on whose way panels pass through each other.
    precision : float, optional
        The error that a coordinate may have, in their unit; by default as they are written, or as the geometry
        shows. A Configuration has its own.
    report : callable, optional
        Called with the number of frames after each.

    Raises
    ------
    UnsolvableError
        If the sheet has no coordinates, its panels do not fit, or nothing moves.
    InvariantError
        If there is no such joint or branch, or an angle is out of range.

    Examples
    --------
    A vertex of four creases of which two are in line:

    >>> import numpy as np
    >>> corners = ((0, 0), (1, 0), (.5, 1), (-1, 0), (.5, -1))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> sheet = Sheet(5, ((0, 1), (0, 2), (0, 3), (0, 4)), "MVVV", faces, corners)
    >>> folded = fold(sheet, drive={1: np.pi / 2}, frames=3)
    >>> np.degrees(folded.path.angles[-1]).round(2).tolist(), folded.freedoms
    ([-48.19, 90.0, 48.19, 90.0], 1)
    """
    sheet = mechanism_for("fold", mechanism, Sheet)
    at = configuration_of_sheet(sheet, precision=precision)
    motion = motion_of(at, MotionOptions(drive or {}, along or {}, branch, frames, report), collisions=collisions)
    assert isinstance(motion, SheetMotion)  # the configuration has panels
    return motion


def assign_branch(mechanism: Sheet | SheetConfiguration, branch: int | str) -> SheetEdit:
    """Give a flat crease pattern the mountains and valleys with which a branch begins.

    Of a branch with several freedoms they are those nearest to the assignment it has, up to the sign of all.
    Creases that do not move on the branch become flat (F): panels stay one there, so that the pattern folds on
    this branch as assigned. Fold angles keep their size and take the sign of their crease.

    Parameters
    ----------
    mechanism : Sheet or SheetConfiguration
        With coordinates, flat.
    branch : int or str
        Its number as `synth fold --branches` and the answers of `mobility` have it, or its signs.

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
    check_argument("assign_branch", mechanism, Sheet | SheetConfiguration)
    at = mechanism if isinstance(mechanism, SheetConfiguration) else configuration_of_sheet(mechanism)
    if not at.flat:
        raise UnsolvableError("an assignment says how a flat sheet begins to fold, and this sheet is folded")
    number, _ = beginning(at, BranchChoice(branch))
    letters_of = dict(zip(at.joints, _letters(at, number or 0), strict=True))
    drawn = with_all_edges(at.drawn)
    pieces = [(edge, joint) for joint, edges in at.dual.pieces.items() if joint in letters_of for edge in edges]
    letter_at = {frozenset(edge): letters_of[joint] for edge, joint in pieces}
    drawn_edges = zip(drawn.edges, drawn.assignments, strict=True)
    letters = [letter_at.get(frozenset(edge), letter) for edge, letter in drawn_edges]
    angles = None if drawn.fold_angles is None else tuple(map(_turned, drawn.fold_angles, letters))
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
    late = late / np.abs(late).max(initial=DOUBLE.zero)  # joints without rates may yet move, later
    immobile = np.isin(np.arange(len(rates)), branch.immobile)
    first = np.where(immobile | (np.abs(rates) <= DOUBLE.zero_rate), 0.0, rates)
    begins = np.where(first != 0.0, first, np.where(np.abs(late) > DOUBLE.zero_rate, late, 0.0))
    return ["F" if rate == 0.0 else "V" if rate > 0.0 else "M" for rate in begins.tolist()]


def _turned(angle: float | None, letter: str) -> float | None:
    """Return a fold angle with the sign of its crease."""
    if angle is None or letter not in "MVF":
        return angle
    return {"M": -abs(angle), "V": abs(angle), "F": 0.0}[letter]
