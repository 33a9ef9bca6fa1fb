"""Which creases are marked otherwise than a branch begins: bands below them on the crease pattern."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from graphs.errors import UnsolvableError, numbered
from graphs.mechanism.sheet import Sheet
from graphs.types import JointId
from synth.drawing.mechanisms.creases import DrawnPattern, Overlay, width_of_lines
from synth.drawing.scene.shapes import Line, Shape
from synth.folding.configuration import SheetConfiguration
from synth.motion.beginning import Wanted, beginning
from synth.motion.marked import disagreement_with
from synth.moving.made import configuration_of

__all__ = ["overlay_of_marks"]

_BAND = 6.0
"""Width of a band, in widths of a crease."""


def overlay_of_marks(sheet: Sheet | SheetConfiguration, branch: int | str | None = None) -> Overlay:
    """Return bands for the creases that disagree with a branch: its number or signs, or by default the nearest.

    Raise UnsolvableError if nothing is assigned, the sheet is not flat, or nothing moves; InvariantError if there
    is no such branch.
    """
    at = configuration_of(sheet)
    if not at.flat or not isinstance(at, SheetConfiguration) or not _is_assigned(at):
        raise UnsolvableError("marks are those of a flat crease pattern, mountains and valleys, and it has none")
    number, _ = beginning(at, Wanted(branch))
    taken = at.branch(number or 0)
    near = at.disagreement
    if taken is None or near is None:
        raise UnsolvableError("the branches of so large a pattern are not looked for")
    if branch is not None:
        near = disagreement_with(number or 0, taken, at.marks)
    opposite, immobile = ({at.joints[place] for place in some} for some in (near.opposite, near.immobile))

    def shapes(drawn: DrawnPattern) -> list[Shape]:
        return [*_bands(drawn, opposite, "marked"), *_bands(drawn, immobile, "class5", dotted=True)]

    freedoms = "freedoms not known" if taken.freedoms is None else numbered(taken.freedoms, "freedom")
    which = f"branch {near.number} ({freedoms})"
    if not near.size:
        return Overlay("marks", shapes, (f"all creases are marked as {which} begins",))
    other, still = len(near.opposite), len(near.immobile)
    bands = [f"{other} turn{'s' * (other == 1)} the other way (yellow bands)"] if other else []
    bands += [f"{still} {'does' if still == 1 else 'do'} not move (light blue dots)"] if still else []
    every = numbered(int(np.count_nonzero(at.marks)), "assigned crease")
    told = f"{near.size} of {every} disagree{'s' * (near.size == 1)} with {which}: {', '.join(bands)}"
    return Overlay("marks", shapes, (told,))


def _is_assigned(at: SheetConfiguration) -> bool:
    return any(at.sheet.assignments[joint] in "MV" for joint in at.mechanism.hinges if joint < len(at.sheet.edges))


def _bands(drawn: DrawnPattern, joints: Collection[JointId], colour: str, *, dotted: bool = False) -> list[Shape]:
    """Return a band along each piece of joints; its ends are round, and so are dots."""
    wide = _BAND * max(width_of_lines(drawn), 0.4)
    dash = (wide / 10, 1.6 * wide) if dotted else ()
    return [
        Line([drawn.places[v] for v in edge], colour, wide, dash, (("joint", str(joint)),))
        for joint, pieces in drawn.mechanism.pieces.items()
        if joint in joints
        for edge in pieces
    ]
