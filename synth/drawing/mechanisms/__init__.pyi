from synth.drawing.mechanisms.chains import chain_scene as chain_scene
from synth.drawing.mechanisms.creases import crease_scene as crease_scene
from synth.drawing.mechanisms.pictures import draw as draw
from synth.drawing.mechanisms.sc_graphs import sc_scene as sc_scene
from synth.drawing.mechanisms.space import folded_scene as folded_scene, model_scene as model_scene
