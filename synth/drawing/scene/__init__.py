"""Scenes: what a picture shows, in layers, apart from how it is written; writers for SVG, PNG and PDF.

A scene is lines, polygons, discs and labels in typographic points, in colours that have names; the palette of the
paper, light or dark, says what they are when the scene is written.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.drawing.scene.shapes import Disc as Disc
    from synth.drawing.scene.shapes import Label as Label
    from synth.drawing.scene.shapes import Layer as Layer
    from synth.drawing.scene.shapes import Line as Line
    from synth.drawing.scene.shapes import Polygon as Polygon
    from synth.drawing.scene.shapes import Scene as Scene
    from synth.drawing.scene.svg import svg_text as svg_text
    from synth.drawing.scene.writing import save_scene as save_scene
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "shapes": "Disc Label Layer Line Polygon Scene",
            "svg": "svg_text",
            "writing": "save_scene",
        },
    )
