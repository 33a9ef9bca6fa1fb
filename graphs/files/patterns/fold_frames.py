"""Frames of a FOLD file: the key frame, further ones, and what they inherit.

FOLD 1.1, "file_frames": a frame with ``frame_inherit`` takes every key it lacks from its ``frame_parent``, the key
frame (0) or an earlier or later one.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from graphs.errors import FileError
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

    It is the key frame if that has edges or faces, else the first frame that does; or the frame asked for.

    Parameters
    ----------
    document : mapping
        The parsed file.
    check : Checker
    frame : int, optional
        Number of the frame to return: 0 is the key frame.

    Raises
    ------
    FileError
        If there is no such frame, or frames are not as FOLD has them, or inherit in a circle.
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
    chosen, which = _named_today(document, notes), 0
    for index in range(len(frames)):
        found = _inherited(frames, index, check, notes)
        if found.get("faces_vertices") or found.get("edges_vertices"):
            chosen, which = found, index
            break
    if which:
        notes.append(f"the key frame is empty; frame {which} of {len(frames) - 1} was read")
    elif len(frames) > 1:
        notes.append(f"{len(frames) - 1} more frame(s) left alone")
    return chosen, list(dict.fromkeys(notes))


def _inherited(frames: list[Mapping[str, Any]], index: int, check: Checker, notes: list[str]) -> dict[str, Any]:
    """Return a frame with what it inherits."""
    chain, seen = [], set()
    while True:
        place = f"file_frames[{index - 1}]"
        if index in seen:
            raise FileError(check.path, f"{place}.frame_parent", "frames inherit in a circle", "an end to it")
        seen.add(index)
        frame = frames[index]
        chain.append(_named_today(frame, notes))
        if not index or frame.get("frame_inherit") is not True:
            break
        index = check.integer(frame.get("frame_parent", 0), f"{place}.frame_parent", most=len(frames) - 1)
    merged: dict[str, Any] = {}
    for frame in reversed(chain):
        merged |= {key: value for key, value in frame.items() if value is not None}
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
