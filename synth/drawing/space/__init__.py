"""Panels in space: from where they are seen, which hide others, light and sides; strips and moving pictures."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.drawing.space.panels import panel_shapes as panel_shapes
    from synth.drawing.space.panels import panels_of as panels_of
    from synth.drawing.space.poses import pose_scenes as pose_scenes
    from synth.drawing.space.poses import save_moving_poses as save_moving_poses
    from synth.drawing.space.poses import strip_of_poses as strip_of_poses
    from synth.drawing.space.view import View as View
    from synth.drawing.space.view import view_from_above as view_from_above
    from synth.drawing.space.view import view_of_motion as view_of_motion
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "panels": "panel_shapes panels_of",
            "poses": "pose_scenes save_moving_poses strip_of_poses",
            "view": "View view_from_above view_of_motion",
        },
    )
