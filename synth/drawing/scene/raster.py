"""Scenes as pixels and PNG, by the renderer of matplotlib: paths are given to it as they are, without its figures.

A figure looks after ticks, layouts and events, which a scene has none of; without, a picture takes a tenth of the
time.
"""

from __future__ import annotations

from functools import lru_cache, singledispatchmethod
from io import BytesIO
from math import ceil
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError, UnsolvableError, shown
from synth.drawing.scene.palette import colour_of
from synth.drawing.scene.shapes import Disc, Label, Line, Point, Polygon, Scene, Shape

__all__ = ["check_matplotlib", "pixels", "png_bytes"]

_INCH = 72
_HALO = 0.3
_PACKED = 3
"""Of nine: files a tenth larger in a third of the time."""
_MIDDLE = 0.36
"""Of the height of letters: from the line they stand on to the middle of figures and capitals."""


def check_matplotlib() -> None:
    """Raise UnsolvableError if matplotlib is missing, or has no folder to write to.

    This is checked before a picture is computed.
    """
    try:
        import matplotlib.font_manager as _  # noqa: F401
    except ImportError:
        raise UnsolvableError("pictures need matplotlib: pip install 'synthedra[draw]'") from None
    except OSError:  # neither a home nor a temporary folder
        raise UnsolvableError("matplotlib needs a folder to write to: name one in MPLCONFIGDIR") from None


def png_bytes(scene: Scene, *, paper: str = "light", dots: float = 200) -> bytes:
    """Return a scene as a PNG file, with so many dots per inch.

    Raise UnsolvableError if matplotlib is not installed.
    """
    found = pixels(scene, paper=paper, dots=dots)
    from PIL import Image

    stream = BytesIO()
    Image.fromarray(found).save(stream, "PNG", dpi=(dots, dots), compress_level=_PACKED)
    return stream.getvalue()


def pixels(scene: Scene, *, paper: str = "light", dots: float = 200) -> npt.NDArray[np.uint8]:
    """Return a scene as pixels: uint8[height, width, 3], red, green and blue, with so many dots per inch.

    Raise UnsolvableError if matplotlib is not installed.
    """
    check_matplotlib()
    from matplotlib.backends.backend_agg import RendererAgg

    unit = dots / _INCH
    wide, high = ceil(scene.width * unit), ceil(scene.height * unit)
    renderer = RendererAgg(wide, high, dots)  # type: ignore[no-untyped-call]
    painter = _Painter(renderer, paper, unit, high)
    right, below = wide / unit, high / unit
    painter.paint(Polygon([(0, 0), (right, 0), (right, below), (0, below)], "paper"))
    for shape in scene.shapes():
        painter.paint(shape)
    return np.asarray(painter.renderer.buffer_rgba())[..., :3].copy()


class _Painter:
    """Shapes as paths, each over those before; y of the renderer goes upwards."""

    def __init__(self, renderer: Any, paper: str, unit: float, high: int) -> None:
        from matplotlib.transforms import Affine2D

        self.renderer = renderer
        self._paper = paper
        self._on_page = Affine2D().scale(unit, -unit).translate(0, high)

    @singledispatchmethod
    def paint(self, shape: Shape) -> None:
        raise InvariantError("shape", f"{shown(shape)} is no shape", "Line, Polygon, Disc or Label")

    @paint.register
    def _(self, shape: Line) -> None:
        pen = self._pen(shape.colour, shape.width)
        if shape.dash:
            pen.set_dashes(0, list(shape.dash))
        self.renderer.draw_path(pen, _path(shape.points), self._on_page)

    @paint.register
    def _(self, shape: Polygon) -> None:
        path = _path([*shape.points, shape.points[0]], closed=True)
        if shape.fill is not None:  # apart, for the outline is never transparent
            pen = self._pen(None, 0)
            pen.set_alpha(shape.opacity)
            self.renderer.draw_path(pen, path, self._on_page, self._rgb(shape.fill, shape.opacity))
        if shape.colour is not None:
            self.renderer.draw_path(self._pen(shape.colour, shape.width), path, self._on_page)

    @paint.register
    def _(self, shape: Disc) -> None:
        from matplotlib.path import Path
        from matplotlib.transforms import Affine2D

        place = Affine2D().scale(shape.radius).translate(*shape.centre) + self._on_page
        inside = None if shape.fill is None else self._rgb(shape.fill)
        self.renderer.draw_path(self._pen(shape.colour, shape.width), Path.unit_circle(), place, inside)

    @paint.register
    def _(self, shape: Label) -> None:
        from matplotlib.transforms import Affine2D

        path, wide = _letters(shape.text, shape.bold)
        left = shape.at[0] - (shape.size * wide / 2 if shape.anchor == "middle" else 0.0)
        place = Affine2D().scale(shape.size, -shape.size).translate(left, shape.at[1] + _MIDDLE * shape.size)
        if shape.halo:
            self.renderer.draw_path(self._pen("paper", _HALO * shape.size), path, place + self._on_page)
        self.renderer.draw_path(self._pen(None, 0), path, place + self._on_page, self._rgb(shape.colour))

    def _pen(self, colour: str | None, width: float) -> Any:
        pen = self.renderer.new_gc()
        pen.set_antialiased(True)
        pen.set_snap(False)  # letters of straight strokes would be moved to whole pixels
        pen.set_capstyle("round")
        pen.set_joinstyle("round")
        pen.set_linewidth(0 if colour is None else width)  # points, as dashes are
        if colour is not None:
            pen.set_foreground(colour_of(colour, self._paper))
        return pen

    def _rgb(self, name: str, opacity: float = 1.0) -> tuple[float, float, float, float]:
        code = colour_of(name, self._paper)
        red, green, blue = (int(code[i : i + 2], 16) / 255 for i in (1, 3, 5))
        return red, green, blue, opacity


def _path(points: Any, *, closed: bool = False) -> Any:
    from matplotlib.path import Path

    return Path(np.asarray(points, dtype=float), closed=closed)


@lru_cache(maxsize=2048)
def _letters(text: str, bold: bool) -> tuple[Any, float]:
    """Return the outlines of letters of height 1, y upwards, and how wide they are."""
    from matplotlib.font_manager import FontProperties
    from matplotlib.path import Path
    from matplotlib.textpath import TextToPath

    drawn_at = 100.0
    font = FontProperties(family="DejaVu Sans", weight="bold" if bold else "normal", size=drawn_at)
    maker = TextToPath()
    corners, codes = maker.get_text_path(font, text, ismath=False)
    wide, _, _ = maker.get_text_width_height_descent(text, font, ismath=False)
    scale = 1.0 / drawn_at
    path = Path(np.asarray(corners, dtype=float).reshape(-1, 2) * scale, codes) if len(corners) else Path(_NONE)
    return path, float(wide) * scale


_NONE: list[Point] = [(0.0, 0.0)]
