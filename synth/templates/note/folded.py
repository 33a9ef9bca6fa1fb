"""A pose in which a thing with panels is seen as what it becomes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from graphs.errors import SynthedraError, numbered
from graphs.mechanism.precision import lies_flat
from graphs.mechanism.sheet import Sheet
from synth.drawing.mechanisms.space import folded_scene
from synth.drawing.scene.shapes import Scene
from synth.drawing.space.panels import same_side_up
from synth.folding.motion import fold

__all__ = ["folded_picture", "folded_pose"]

_MOST = 60
"""Panels that are folded for a picture: more take longer than all the pages."""
_FRAMES = 2
"""Of a folding, the one half way is drawn: at its end panels lie on each other."""
_BOX = (420.0, 420.0)
"""Points of width and height that the picture takes at most."""


def folded_picture(sheet: Sheet) -> tuple[Scene | None, str]:
    """Return a picture of a folded sheet and its caption, or None and why there is no picture.

    The sheet has coordinates; it may have frames.
    """
    pose, seen = folded_pose(sheet)
    if pose is None:
        return None, seen
    sides = "; the printed side is grey, its back blue" if list(pose.faces) == same_side_up(pose.faces) else ""
    return folded_scene(pose, numbers=False, box=_BOX, caption=None), seen + sides


def folded_pose(sheet: Sheet) -> tuple[Sheet | None, str]:
    """Return a pose that shows what a thing becomes, and which it is; None, and why, where there is none.

    A thing that stands in space is such a pose, as is the middle one of the frames of its file that stand; else it
    is folded as its letters say.
    """
    placed = sheet if sheet.frames is None else sheet.frames.first_placed()
    if not lies_flat(placed):
        return placed, "as it stands"
    frames = [] if sheet.frames is None else [sheet.frames.frame(one) for one in range(1, sheet.frames.others + 1)]
    standing = [one for one in frames if one.coordinates is not None and one.faces and not lies_flat(one)]
    if standing:
        return standing[len(standing) // 2], "in a frame of its file"
    if len(placed.faces) > _MOST:
        return None, f"{numbered(len(placed.faces), 'panel')}: more than {_MOST} are not folded for a picture"
    try:
        folding = fold(replace(placed, title=""), frames=_FRAMES)
    except SynthedraError as error:
        return None, f"it was not folded: {error}"
    half_way = len(folding.places) // 2
    if not np.abs(folding.path.angles[half_way]).max() > 0:
        return None, "it was not folded: nothing turns"
    return folding.frames()[half_way], "folded half way"
