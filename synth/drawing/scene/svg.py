"""Scenes as SVG: plain text, equal for equal scenes, with nothing in it that runs or loads.

Each layer is a group with its name as class; shapes carry ``data-joint`` and ``data-link``. Numbers have two
decimals: a hundredth of a point is less than any printer shows.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import singledispatchmethod
from xml.sax.saxutils import escape, quoteattr

from graphs.errors import InvariantError, shown
from graphs.printing import LONGEST_CELL, plain
from synth.drawing.scene.palette import colour_of
from synth.drawing.scene.shapes import Disc, Label, Line, Point, Polygon, Scene, Shape

__all__ = ["svg_group", "svg_text"]

_FONT = "Helvetica, Arial, 'DejaVu Sans', sans-serif"
_BASELINE = 0.35
_HALO = 0.3


def svg_text(scene: Scene, *, paper: str = "light") -> str:
    r"""Return a scene as an SVG document.

    Parameters
    ----------
    scene : Scene
    paper : {"light", "dark"}, optional

    Raises
    ------
    InvariantError
        If a colour or the paper is not known, or a number is not finite.

    Examples
    --------
    >>> from synth.drawing.scene.shapes import Layer
    >>> text = svg_text(Scene(9, 9, (Layer("a", (Label((4, 4), "<script>"),)),), title="x"))
    >>> "&lt;script&gt;" in text, "<script" in text
    (True, False)
    """
    wide, high = _number(scene.width), _number(scene.height)
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{wide}pt" height="{high}pt" viewBox="0 0 {wide} {high}" '
        f'role="img" font-family="{_FONT}" stroke-linejoin="round" stroke-linecap="round">'
    )
    sheet = f'<rect width="{wide}" height="{high}" fill="{colour_of("paper", paper)}"/>'
    body = svg_group(scene, paper=paper)
    return "\n".join([head, f"<title>{escape(scene.title)}</title>", sheet, body, "</svg>", ""])


def svg_group(scene: Scene, *, paper: str = "light") -> str:
    r"""Return the layers of a scene as SVG groups, without a document round them.

    >>> from synth.drawing.scene.shapes import Layer
    >>> svg_group(Scene(9, 9, (Layer("a", (Line([(0, 0), (1, 0.5)]),)),)))
    '<g class="a">\n<path d="M0 0L1 .5" fill="none" stroke="#1a1a1a" stroke-width="1"/>\n</g>'
    """
    writer = _Writer(paper)
    rows = []
    for layer in scene.layers:
        rows.append(f"<g class={quoteattr(plain(layer.name))}>")
        rows += [writer.element(shape) for shape in layer.shapes]
        rows.append("</g>")
    return "\n".join(rows)


class _Writer:
    """Shapes as elements, in the colours of a paper."""

    def __init__(self, paper: str) -> None:
        self._paper = paper

    @singledispatchmethod
    def element(self, shape: Shape) -> str:
        raise InvariantError("shape", f"{shown(shape)} is no shape", "Line, Polygon, Disc or Label")

    @element.register
    def _(self, shape: Line) -> str:
        dash = f' stroke-dasharray="{" ".join(map(_number, shape.dash))}"' if shape.dash else ""
        pen = self._pen(shape.colour, shape.width)
        return f'<path{_data(shape)} d="{_way(shape.points)}" fill="none"{pen}{dash}/>'

    @element.register
    def _(self, shape: Polygon) -> str:
        pen, fill = self._pen(shape.colour, shape.width), self._fill(shape.fill)
        light = f' fill-opacity="{_number(shape.opacity)}"' if shape.opacity < 1 else ""
        return f'<path{_data(shape)} d="{_way(shape.points)}Z"{fill}{light}{pen}/>'

    @element.register
    def _(self, shape: Disc) -> str:
        x, y = map(_number, shape.centre)
        pen, fill = self._pen(shape.colour, shape.width), self._fill(shape.fill)
        return f'<circle{_data(shape)} cx="{x}" cy="{y}" r="{_number(shape.radius)}"{fill}{pen}/>'

    @element.register
    def _(self, shape: Label) -> str:
        x, y = _number(shape.at[0]), _number(shape.at[1] + _BASELINE * shape.size)
        look = f' font-size="{_number(shape.size)}" text-anchor="{shape.anchor}"' + self._fill(shape.colour)
        if shape.bold:
            look += ' font-weight="bold"'
        if shape.halo:
            look += self._pen("paper", _HALO * shape.size) + ' paint-order="stroke"'
        return f'<text{_data(shape)} x="{x}" y="{y}"{look}>{escape(shape.text)}</text>'

    def _pen(self, colour: str | None, width: float) -> str:
        if colour is None:
            return ""
        return f' stroke="{colour_of(colour, self._paper)}" stroke-width="{_number(width)}"'

    def _fill(self, colour: str | None) -> str:
        return ' fill="none"' if colour is None else f' fill="{colour_of(colour, self._paper)}"'


def _data(shape: Shape) -> str:
    return "".join(f" data-{key}={quoteattr(plain(value, LONGEST_CELL))}" for key, value in shape.data)


def _way(points: Sequence[Point]) -> str:
    return "M" + "L".join(f"{_number(x)} {_number(y)}" for x, y in points)


def _number(value: float) -> str:
    """Return a number with two decimals at most, without zeros that say nothing."""
    if not abs(value) < 1e7:
        raise InvariantError("picture", f"a coordinate is {shown(value)}", "a number of points below 1e7")
    text = f"{value:.2f}".rstrip("0").rstrip(".")
    if text in ("-0", ""):
        return "0"
    return text.replace("0.", ".", 1) if text.startswith(("0.", "-0.")) else text
