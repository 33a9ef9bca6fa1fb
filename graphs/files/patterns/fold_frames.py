"""Frames of a FOLD file: the key frame, further ones, and what they inherit.

FOLD 1.1, "file_frames": a frame with ``frame_inherit`` takes every key it lacks from its ``frame_parent``, the key
frame (0) or an earlier or later one.
"""

from __future__ import annotations

from collections.abc import Container, Mapping
from typing import Any

from graphs.errors import FileError, numbered
from graphs.files.check import Checker

__all__ = ["resolved_frame"]

_OLD_NAMES = {
    "edges_foldAngles": "edges_foldAngle",
    "edges_lengths": "edges_length",
    "edges_crease_angle_os": "edges_foldAngle",
}
"""Names of FOLD 1.0 and of early Origami Simulator to those of today."""


def resolved_frame(
    document: Mapping[str, Any], check: Checker, frame: int | None = None
) -> tuple[dict[str, Any], list[str]]:
    """Return the frame that holds the pattern, and notes on how it was found.

    It is the key frame (number 0) if that has edges or faces, else the first frame that does; or the chosen frame.
    Raise FileError if there is no such frame, or frames are not as FOLD has them, or inherit in a circle.
    """
    frames = [document]
    if document.get("file_frames") is not None:
        listed = check.list(document["file_frames"], "file_frames", what="a list of frames")
        for i, one in enumerate(listed):
            if not isinstance(one, dict):
                check.fail(f"file_frames[{i}]", one, "a frame (an object)")
        frames += listed
    notes: list[str] = []
    if frame is not None:
        if frame >= len(frames):
            raise FileError(check.path, "", f"no frame {frame}", f"a frame from 0 to {len(frames) - 1}")
        return _inherited(frames, frame, check, notes), list(dict.fromkeys(notes))
    which = _first_with_pattern(frames, check, notes)
    chosen = _inherited(frames, which, check, notes)
    if which:
        notes.append(f"the key frame is empty; frame {which} of {len(frames) - 1} was read")
    elif len(frames) > 1:
        notes.append(f"{numbered(len(frames) - 1, 'more frame')} not read")
    return chosen, list(dict.fromkeys(notes))


_PATTERN = ("faces_vertices", "edges_vertices")


def _first_with_pattern(frames: list[Mapping[str, Any]], check: Checker, notes: list[str]) -> int:
    """Return the number of the first frame that has faces or edges, its own or inherited; else 0.

    What a frame has is found from what its parent has: a chain of frames is gone through once, not from each.
    """
    has: dict[int, dict[str, bool]] = {}
    for index in range(len(frames)):
        for one in reversed(_ancestors(frames, index, check, has)):
            own, parent = _named_today(frames[one], notes), _parent(frames, one, check)
            above = {} if parent is None else has[parent]
            has[one] = {key: bool(own[key]) if key in own else above.get(key, False) for key in _PATTERN}
        if any(has[index].values()):
            return index
    return 0


def _ancestors(
    frames: list[Mapping[str, Any]], index: int, check: Checker, known: Container[int] = ()
) -> list[int]:
    """Return a frame, its parent, and so on up to one that is known or inherits nothing."""
    chain: dict[int, None] = {}
    above: int | None = index
    while above is not None and above not in known:
        if above in chain:
            place = f"file_frames[{above - 1}].frame_parent"
            raise FileError(check.path, place, "frames inherit in a circle", "an end to it")
        chain[above] = None
        above = _parent(frames, above, check)
    return list(chain)


def _parent(frames: list[Mapping[str, Any]], index: int, check: Checker) -> int | None:
    frame = frames[index]
    if not index or frame.get("frame_inherit") is not True:
        return None
    place = f"file_frames[{index - 1}].frame_parent"
    return check.integer(frame.get("frame_parent", 0), place, most=len(frames) - 1)


def _inherited(frames: list[Mapping[str, Any]], index: int, check: Checker, notes: list[str]) -> dict[str, Any]:
    """Return a frame with what it inherits."""
    merged: dict[str, Any] = {}
    for one in reversed(_ancestors(frames, index, check)):
        merged |= _named_today(frames[one], notes)
    return merged


def _named_today(frame: Mapping[str, Any], notes: list[str]) -> dict[str, Any]:
    """Return a frame without old key names, null keys and the list of frames."""
    renamed = {}
    for key, value in frame.items():
        if key == "file_frames" or value is None:
            continue
        today = _OLD_NAMES.get(key, key)
        if today != key and today in frame:
            continue
        if today != key:
            notes.append(f"old key {key} read as {today}")
        renamed[today] = value
    return renamed
