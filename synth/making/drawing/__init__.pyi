from synth.making.drawing.conformed import draw_conformed as draw_conformed
from synth.making.drawing.mechanisms.pictures import draw as draw
from synth.making.drawing.scene.writing import Scene as Scene, svg_text as svg_text
from synth.making.drawing.space.poses import (
    save_moving_poses as save_moving_poses,
    strip_of_poses as strip_of_poses,
    write_motion as write_motion,
)
from synth.making.drawing.sphere import draw_hoop as draw_hoop, draw_map as draw_map
from synth.making.drawing.sums import draw_loop_sums as draw_loop_sums
