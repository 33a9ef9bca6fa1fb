"""SCD graphs as things: panels with coordinates, and how far they fold before panels meet.

Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from typing import Any, get_args

import numpy as np

from graphs.errors import SynthedraError
from graphs.files.formats import mechanism_of_id
from graphs.files.patterns.fold import fold_text
from synth.motion.driving import Asked
from synth.motion.motion import motion_of
from synth.realisation.realised import Kind, Realised, realise

__all__ = ["thing_of"]

_FRAMES = 24
"""Frames of the motion that says how far a type folds."""


def thing_of(code: str) -> dict[str, Any]:
    """Return what an atlas says of an SCD graph with coordinates, by its id; or that it was not realised.

    >>> thing_of("m1:a-b.ac-.b-d.cd-")["flat"]
    True
    """
    made = _made(code)
    if made is None:
        return {"realised": False}
    figures = made.figures.to_json()
    return {
        "realised": True,
        "flat": made.kind == "sheet",
        "least_angle_deg": figures["least_angle_deg"],
        "edge_ratio": figures["edge_ratio"],
        "fold_file": fold_text(made.sheet),
        **_folded(made),
    }


def _made(code: str) -> Realised | None:
    """Return a type as a flat sheet, or else as a pose in space; None if neither was found."""
    for kind in get_args(Kind):
        try:
            return realise(mechanism_of_id(code), kind=kind)
        except SynthedraError:
            continue
    return None


def _folded(made: Realised) -> dict[str, Any]:
    """Return how far the crease that turns most goes, degrees, and what is in the way."""
    try:
        motion = motion_of(made.configuration, Asked(frames=_FRAMES), collisions=True)
    except SynthedraError as error:
        return {"fold_deg": None, "fold_end": str(error)}
    reached = float(np.degrees(np.abs(motion.path.angles).max(initial=0.0)))
    return {"fold_deg": round(reached, 6), "fold_end": motion.path.stopped or "as far as it was driven"}
