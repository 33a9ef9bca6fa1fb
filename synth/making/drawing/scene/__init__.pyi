from synth.making.drawing.scene.shapes import (
    Disc as Disc,
    Label as Label,
    Layer as Layer,
    Line as Line,
    Polygon as Polygon,
)
from synth.making.drawing.scene.writing import Scene as Scene, svg_text as svg_text
