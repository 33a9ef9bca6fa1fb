"""Pictures: crease patterns, chains, graphs, models; loop sums, linkages on cones, orientations; folded panels.

Scenes are in `synth.drawing.scene`, places of links and joints in `synth.drawing.layout`, pictures of mechanisms
in `synth.drawing.mechanisms`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.drawing.conformed import draw_conformed as draw_conformed
    from synth.drawing.foldings import write_motion as write_motion
    from synth.drawing.mechanisms.pictures import draw as draw
    from synth.drawing.order_map import draw_map as draw_map
    from synth.drawing.scene.shapes import Scene as Scene
    from synth.drawing.scene.svg import svg_text as svg_text
    from synth.drawing.scene.writing import check_picture as check_picture
    from synth.drawing.scene.writing import save_scene as save_scene
    from synth.drawing.space.poses import save_moving_poses as save_moving_poses
    from synth.drawing.space.poses import strip_of_poses as strip_of_poses
    from synth.drawing.sphere import draw_hoop as draw_hoop
    from synth.drawing.sums import draw_loop_sums as draw_loop_sums
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "conformed": "draw_conformed",
            "foldings": "write_motion",
            "synth.drawing.mechanisms.pictures": "draw",
            "synth.drawing.space.poses": "save_moving_poses strip_of_poses",
            "synth.drawing.scene.shapes": "Scene",
            "synth.drawing.scene.svg": "svg_text",
            "synth.drawing.scene.writing": "check_picture save_scene",
            "order_map": "draw_map",
            "sphere": "draw_hoop",
            "sums": "draw_loop_sums",
        },
    )
