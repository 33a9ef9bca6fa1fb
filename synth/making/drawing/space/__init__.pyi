from synth.making.drawing.space.motion_files import (
    frame_scenes as frame_scenes,
    save_moving_frames as save_moving_frames,
    strip_of_frames as strip_of_frames,
)
from synth.making.drawing.space.panels import (
    View as View,
    panel_shapes as panel_shapes,
    panels_of as panels_of,
    view_from_above as view_from_above,
    view_of_motion as view_of_motion,
)
