"""A crease pattern with poses of it, as frames of one FOLD file."""

from __future__ import annotations

import json
from collections.abc import Sequence

from graphs.files.patterns.fold import fold_text
from graphs.files.text import json_text
from graphs.mechanism.sheet import Sheet

__all__ = ["fold_text_of_poses"]


def fold_text_of_poses(sheet: Sheet, poses: Sequence[Sheet]) -> str:
    """Return the text of a FOLD file whose key frame is a sheet, and whose other frames are poses of it.

    A pose is the same sheet with other coordinates and fold angles.

    >>> from dataclasses import replace
    >>> flat = Sheet(3, (), "", ((0, 1, 2),), ((0, 0), (1, 0), (0, 1)))
    >>> pose = replace(flat, coordinates=((0, 0, 0), (1, 0, 0), (0, 0, 1)))
    >>> document = json.loads(fold_text_of_poses(flat, [pose]))
    >>> document["file_frames"][0]["vertices_coords"]
    [[0, 0, 0], [1, 0, 0], [0, 0, 1]]
    """
    document = json.loads(fold_text(sheet))
    document["file_classes"] = ["animation"]
    document["file_frames"] = [
        {
            "frame_classes": ["foldedForm"],
            "frame_attributes": ["3D"],
            "frame_title": f"pose {number}",
            "frame_parent": 0,
            "frame_inherit": True,
            "vertices_coords": [list(place) for place in pose.coordinates or ()],
            **({} if pose.fold_angles is None else {"edges_foldAngle": list(pose.fold_angles)}),
        }
        for number, pose in enumerate(poses)
    ]
    return json_text(document)
