from synth.drawing.scene.shapes import (
    Disc as Disc,
    Label as Label,
    Layer as Layer,
    Line as Line,
    Polygon as Polygon,
    Scene as Scene,
)
from synth.drawing.scene.writing import save_scene as save_scene, svg_text as svg_text
