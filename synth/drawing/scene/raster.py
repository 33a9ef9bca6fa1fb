"""Scenes as PNG, through matplotlib."""

from __future__ import annotations

from functools import singledispatchmethod
from io import BytesIO
from typing import Any

from graphs.errors import InvariantError, shown
from synth.drawing.figure import new_figure
from synth.drawing.scene.palette import colour_of
from synth.drawing.scene.shapes import Disc, Label, Line, Polygon, Scene, Shape

__all__ = ["png_bytes"]

_INCH = 72
_HALO = 0.3


def png_bytes(scene: Scene, *, paper: str = "light", dots: float = 200) -> bytes:
    r"""Return a scene as a PNG file.

    Parameters
    ----------
    scene : Scene
    paper : {"light", "dark"}, optional
    dots : float, optional
        Pixels an inch.

    Raises
    ------
    UnsolvableError
        If matplotlib is not installed.

    Examples
    --------
    >>> png_bytes(Scene(72, 36, ()))[:4]
    b'\x89PNG'
    """
    figure = new_figure(scene.width / _INCH, scene.height / _INCH)
    figure.set_layout_engine("none")
    figure.set_facecolor(colour_of("paper", paper))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0, scene.width), ylim=(scene.height, 0))
    axes.axis("off")
    painter = _Painter(axes, paper)
    for height, shape in enumerate(scene.shapes()):
        painter.paint(shape, height)
    stream = BytesIO()
    figure.savefig(stream, format="png", dpi=dots, facecolor=figure.get_facecolor(), metadata={"Software": None})
    return stream.getvalue()


class _Painter:
    """Shapes as artists of matplotlib, each at its height."""

    def __init__(self, axes: Any, paper: str) -> None:
        self._axes, self._paper = axes, paper

    @singledispatchmethod
    def paint(self, shape: Shape, height: int) -> None:
        raise InvariantError("shape", f"{shown(shape)} is no shape", "Line, Polygon, Disc or Label")

    @paint.register
    def _(self, shape: Line, height: int) -> None:
        x, y = zip(*shape.points, strict=True)
        style: Any = (0, [length / shape.width for length in shape.dash]) if shape.dash else "-"
        self._axes.plot(
            x, y, color=self._colour(shape.colour), linewidth=shape.width, linestyle=style, zorder=height,
            solid_capstyle="round", solid_joinstyle="round", clip_on=False,
        )  # fmt: skip

    @paint.register
    def _(self, shape: Polygon, height: int) -> None:
        from matplotlib.patches import Polygon as Patch

        inside, rim = self._colour(shape.fill), self._colour(shape.colour)
        common: dict[str, Any] = {"closed": True, "joinstyle": "round", "zorder": height, "clip_on": False}
        if shape.fill is not None:  # apart, for the outline is never transparent
            self._axes.add_patch(Patch(shape.points, facecolor=inside, linewidth=0, alpha=shape.opacity, **common))
        if shape.colour is not None:
            self._axes.add_patch(Patch(shape.points, fill=False, edgecolor=rim, linewidth=shape.width, **common))

    @paint.register
    def _(self, shape: Disc, height: int) -> None:
        from matplotlib.patches import Circle

        self._axes.add_patch(
            Circle(
                shape.centre,
                shape.radius,
                facecolor=self._colour(shape.fill),
                edgecolor=self._colour(shape.colour),
                linewidth=0 if shape.colour is None else shape.width,
                zorder=height,
                clip_on=False,
            )
        )

    @paint.register
    def _(self, shape: Label, height: int) -> None:
        from matplotlib.patheffects import withStroke

        rim = [withStroke(linewidth=_HALO * shape.size, foreground=self._colour("paper"))] if shape.halo else []
        self._axes.text(
            *shape.at, shape.text, fontsize=shape.size, color=self._colour(shape.colour), parse_math=False,
            ha="center" if shape.anchor == "middle" else "left", va="center_baseline", zorder=height,
            fontweight="bold" if shape.bold else "normal", path_effects=rim, clip_on=False,
        )  # fmt: skip

    def _colour(self, name: str | None) -> str:
        return "none" if name is None else colour_of(name, self._paper)
