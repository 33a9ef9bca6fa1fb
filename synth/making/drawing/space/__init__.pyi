from synth.making.drawing.space.panels import (
    View as View,
    panel_shapes as panel_shapes,
    panels_of as panels_of,
    view_from_above as view_from_above,
    view_of_motion as view_of_motion,
)
from synth.making.drawing.space.poses import (
    pose_scenes as pose_scenes,
    save_moving_poses as save_moving_poses,
    strip_of_poses as strip_of_poses,
)
