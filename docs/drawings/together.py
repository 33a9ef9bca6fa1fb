"""Pictures put beside and above each other, with a line below each."""

from __future__ import annotations

from collections.abc import Sequence

from synth.making.drawing.scene.shapes import SMALL, Label, Layer, moved, text_width
from synth.making.drawing.scene.writing import Scene

__all__ = ["above", "beside", "said"]

GAP = 18.0
LINE = 1.5 * SMALL


def beside(*scenes: Scene, gap: float = GAP, title: str = "") -> Scene:
    """Return pictures in a row, their middles at one height.

    Parameters
    ----------
    *scenes : Scene
    gap : float, optional
        Between them, points.
    title : str, optional
        What is seen; without it the titles of the pictures.
    """
    high = max(scene.height for scene in scenes)
    layers: list[Layer] = []
    right = 0.0
    for scene in scenes:
        layers += _placed(scene, right, (high - scene.height) / 2)
        right += scene.width + gap
    return Scene(right - gap, high, tuple(layers), title or _titles(scenes))


def above(*scenes: Scene, gap: float = GAP, title: str = "") -> Scene:
    """Return pictures in a column, their middles on one line."""
    wide = max(scene.width for scene in scenes)
    layers: list[Layer] = []
    down = 0.0
    for scene in scenes:
        layers += _placed(scene, (wide - scene.width) / 2, down)
        down += scene.height + gap
    return Scene(wide, down - gap, tuple(layers), title or _titles(scenes))


def said(scene: Scene, *lines: str) -> Scene:
    """Return a picture with lines of text below its middle."""
    wide = max(scene.width, *(text_width(line, SMALL) for line in lines))
    labels = tuple(
        Label((wide / 2, scene.height + (number + 0.7) * LINE), line, SMALL, "grey", halo=False, widest=120)
        for number, line in enumerate(lines)
    )
    layers = (*_placed(scene, (wide - scene.width) / 2, 0.0), Layer("said", labels))
    return Scene(wide, scene.height + (len(lines) + 0.4) * LINE, layers, scene.title)


def _placed(scene: Scene, right: float, down: float) -> list[Layer]:
    return [moved(layer, right, down) for layer in scene.layers if layer.shapes]


def _titles(scenes: Sequence[Scene]) -> str:
    return "; ".join(scene.title for scene in scenes if scene.title)
