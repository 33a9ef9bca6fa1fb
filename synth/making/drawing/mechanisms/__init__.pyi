from synth.making.drawing.mechanisms.chains import chain_scene as chain_scene
from synth.making.drawing.mechanisms.creases import crease_scene as crease_scene
from synth.making.drawing.mechanisms.flat_folded import (
    check_order_path as check_order_path,
    fault_scene as fault_scene,
    flat_folded_scene as flat_folded_scene,
    write_order as write_order,
)
from synth.making.drawing.mechanisms.pictures import draw as draw
from synth.making.drawing.mechanisms.sc_graphs import sc_scene as sc_scene
from synth.making.drawing.mechanisms.space import folded_scene as folded_scene, model_scene as model_scene
