from synth.making.drawing.conformed import draw_conformed as draw_conformed
from synth.making.drawing.mechanisms.pictures import draw as draw
from synth.making.drawing.scene.writing import Scene as Scene, svg_text as svg_text
from synth.making.drawing.space.motion_files import (
    save_moving_frames as save_moving_frames,
    strip_of_frames as strip_of_frames,
    write_motion as write_motion,
)
from synth.making.drawing.sphere import draw_hoop as draw_hoop, draw_map as draw_map
from synth.making.drawing.sums import draw_loop_sums as draw_loop_sums
