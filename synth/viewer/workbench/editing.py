"""Edits that a page asks for, as words, and what they make of a mechanism.

``lock:JOINT``, ``remove:JOINT``, ``ride-alongs``, and ``crease:END~END``, where an END is the number of a vertex,
or ``x,y`` or ``x,y,z``. Theory: docs/theory/viewer.md, docs/theory/edits.md.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from graphs.convert.table import Mechanism
from graphs.creasing.edits import crease_sheet, lock_crease, remove_crease, take_off_panels
from graphs.errors import UnsolvableError
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.reduce.ride_alongs import reduce

__all__ = ["are_edits", "edited"]

_MOST_EDITS = 200
_NUMBER = r"-?[0-9]{1,20}(?:\.[0-9]{0,20})?(?:e[+-]?[0-9]{1,2})?"
_END = rf"(?:[0-9]{{1,9}}|{_NUMBER},{_NUMBER}(?:,{_NUMBER})?)"
_EDIT = re.compile(rf"(?:lock|remove):[0-9]{{1,9}}|crease:{_END}~{_END}|ride-alongs")
_RIDE_ALONGS = "ride-alongs"


def are_edits(given: Sequence[str]) -> bool:
    """Say whether edits are of known kinds, and not too many.

    >>> are_edits(["lock:3", "crease:12~0.5,-1e-3", "ride-alongs"]), are_edits(["lock:-1"]), are_edits(["rm:1"])
    (True, False, False)
    """
    return len(given) <= _MOST_EDITS and all(_EDIT.fullmatch(edit) for edit in given)


def edited(thing: Mechanism, edits: Sequence[str]) -> Mechanism:
    """Return a mechanism after edits, one after the other, each with the ids that the last one left.

    `are_edits` knows their kinds. Of a sheet with several frames the first that has coordinates is edited. Raise
    InvariantError if there is no such joint, vertex or point; UnsolvableError if an edit cannot be made, or not on
    such a mechanism.
    """
    for edit in edits:
        thing = _without_ride_alongs(thing) if edit == _RIDE_ALONGS else _edited(thing, edit)
    return thing


def _edited(thing: Mechanism, edit: str) -> Sheet:
    if not isinstance(thing, Sheet):
        raise UnsolvableError("only crease patterns are edited here; other mechanisms by `synth edit`")
    what, _, given = edit.partition(":")
    sheet = _placed(thing)
    if what == "crease":
        start, end = map(_end, given.split("~"))
        return crease_sheet(sheet, start, end).sheet
    return (lock_crease if what == "lock" else remove_crease)(sheet, int(given)).sheet


def _end(given: str) -> int | tuple[float, ...]:
    return tuple(map(float, given.split(","))) if "," in given else int(given)


def _placed(sheet: Sheet) -> Sheet:
    return sheet if sheet.frames is None else sheet.frames.first_placed()


def _without_ride_alongs(thing: Mechanism) -> Mechanism:
    """Return a mechanism without ride-alongs: a sheet without their panels, solids, or else a graph."""
    thing = _placed(thing) if isinstance(thing, Sheet) else thing
    reduction = reduce(thing)
    if not reduction.steps:
        raise UnsolvableError("it has no ride-alongs that could be taken off")
    if isinstance(thing, Sheet):
        panels = {int(str(link)) for step in reduction.steps for link in step.removed}
        return take_off_panels(thing, panels).sheet
    if isinstance(thing, HingedSolids):
        axes = {joint: thing.axes[joint] for joint in reduction.graph.joints}
        return HingedSolids(reduction.graph, axes)
    return reduction.graph
