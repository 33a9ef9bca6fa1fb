"""Scenes written as SVG, PNG or PDF: equal scenes give equal files, whole or not at all.

SVG is plain text with nothing in it that runs or loads. Each layer is a group with its name as class; shapes
carry ``data-joint`` and ``data-link``. Numbers have two decimals: a hundredth of a point is less than any printer
shows. Raster images are drawn by the renderer of matplotlib, without its figures: these look after ticks, layouts
and events, and would take ten times as long. PDF is written by reportlab, page by page.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from functools import lru_cache, singledispatchmethod
from io import BytesIO
from math import ceil
from pathlib import Path
from typing import IO, Any
from xml.sax.saxutils import escape, quoteattr
from zlib import compress

import numpy as np
import numpy.typing as npt

from graphs.errors import FileError, InvariantError, UnsolvableError, shown
from graphs.files.atomic import Beside, check_place
from graphs.printing import LONGEST_CELL, plain
from synth.drawing.scene.shapes import Disc, Label, Line, Point, Polygon, Scene, Shape, colour_of

__all__ = [
    "PdfPainter",
    "check_matplotlib",
    "check_picture",
    "pixels",
    "save_scene",
    "svg_group",
    "svg_text",
    "whole_file",
    "write_pdf",
]

_FONT = "Helvetica, Arial, 'DejaVu Sans', sans-serif"
_KINDS = (".png", ".svg", ".pdf")
_BASELINE = 0.35
"""From the middle of letters down to the line they stand on, in SVG and PDF, in units of their size."""
_HALO = 0.3
"""Width of the rim of letters, in units of their size."""
_INCH = 72
_DOTS = 200.0
_PACKED = 3
"""Compression level of PNG, of nine: files a tenth larger in a third of the time."""
_MIDDLE = 0.36
"""Height of the middle of figures and capitals of matplotlib, in units of the size of letters."""


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
    """Return the layers of a scene as SVG groups, without a document round them."""
    writer = _SvgWriter(paper)
    rows = []
    for layer in scene.layers:
        rows.append(f"<g class={quoteattr(plain(layer.name))}>")
        rows += [writer.element(shape) for shape in layer.shapes]
        rows.append("</g>")
    return "\n".join(rows)


class _SvgWriter:
    """Shapes as elements, in the colours of a paper."""

    def __init__(self, paper: str) -> None:
        self._paper = paper

    @singledispatchmethod
    def element(self, shape: Shape) -> str:
        raise InvariantError("shape", f"{shown(shape)} is not a shape", "Line, Polygon, Disc or Label")

    @element.register
    def _(self, shape: Line) -> str:
        dash = f' stroke-dasharray="{" ".join(map(_number, shape.dash))}"' if shape.dash else ""
        pen = self._pen(shape.colour, shape.width)
        return f'<path{_data(shape)} d="{_path_data(shape.points)}" fill="none"{pen}{dash}/>'

    @element.register
    def _(self, shape: Polygon) -> str:
        pen, fill = self._pen(shape.colour, shape.width), self._fill(shape.fill)
        light = f' fill-opacity="{_number(shape.opacity)}"' if shape.opacity < 1 else ""
        return f'<path{_data(shape)} d="{_path_data(shape.points)}Z"{fill}{light}{pen}/>'

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


def _path_data(points: Sequence[Point]) -> str:
    return "M" + "L".join(f"{_number(x)} {_number(y)}" for x, y in points)


def _number(value: float) -> str:
    """Return a number with two decimals at most, without zeros that say nothing."""
    if not abs(value) < 1e7:
        raise InvariantError("picture", f"a coordinate is {shown(value)}", "a number of points below 1e7")
    text = f"{value:.2f}".rstrip("0").rstrip(".")
    if text in ("-0", ""):
        return "0"
    return text.replace("0.", ".", 1) if text.startswith(("0.", "-0.")) else text


def check_matplotlib() -> None:
    """Raise UnsolvableError if matplotlib is missing or has no folder to write to."""
    try:
        import matplotlib.font_manager as _  # noqa: F401
    except ImportError:
        raise UnsolvableError("pictures need matplotlib: pip install 'synthedra[draw]'") from None
    except OSError:  # neither a home nor a temporary folder
        raise UnsolvableError("matplotlib needs a folder to write to: name one in MPLCONFIGDIR") from None


def pixels(scene: Scene, *, paper: str = "light", dots: float = _DOTS) -> npt.NDArray[np.uint8]:
    """Return a scene as pixels: uint8[height, width, 3], red, green and blue; `dots` per inch.

    Raise UnsolvableError if matplotlib is not installed.
    """
    check_matplotlib()
    from matplotlib.backends.backend_agg import RendererAgg

    unit = dots / _INCH
    wide, high = ceil(scene.width * unit), ceil(scene.height * unit)
    renderer = RendererAgg(wide, high, dots)  # type: ignore[no-untyped-call]
    painter = _RasterPainter(renderer, paper, unit, high)
    right, below = wide / unit, high / unit
    painter.paint(Polygon([(0, 0), (right, 0), (right, below), (0, below)], "paper"))
    for shape in scene.shapes():
        painter.paint(shape)
    return np.asarray(painter.renderer.buffer_rgba())[..., :3].copy()


class _RasterPainter:
    """Shapes as paths, each over those before; y of the renderer goes upwards."""

    def __init__(self, renderer: Any, paper: str, unit: float, high: int) -> None:
        from matplotlib.transforms import Affine2D

        self.renderer = renderer
        self._paper = paper
        self._on_page = Affine2D().scale(unit, -unit).translate(0, high)

    @singledispatchmethod
    def paint(self, shape: Shape) -> None:
        raise InvariantError("shape", f"{shown(shape)} is not a shape", "Line, Polygon, Disc or Label")

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
    path = (
        Path(np.asarray(corners, dtype=float).reshape(-1, 2) * scale, codes)
        if len(corners)
        else Path([(0.0, 0.0)])
    )
    return path, float(wide) * scale


def write_pdf(scenes: Iterable[Scene], stream: IO[bytes], *, paper: str = "light") -> None:
    """Write scenes as the pages of a PDF file; a scene is released when its page is written.

    Raise UnsolvableError if reportlab is not installed.
    """
    try:
        from reportlab.pdfgen.canvas import Canvas
    except ImportError:
        raise UnsolvableError("PDF needs reportlab: pip install 'synthedra[draw]'") from None
    canvas = Canvas(stream, invariant=1)
    for number, scene in enumerate(scenes):
        if number == 0:
            canvas.setTitle(scene.title)
        canvas.setPageSize((scene.width, scene.height))
        canvas.setLineJoin(1)
        canvas.setLineCap(1)
        canvas.setFillColor(colour_of("paper", paper))
        canvas.rect(0, 0, scene.width, scene.height, stroke=0, fill=1)
        painter = PdfPainter(canvas, paper, scene.height)
        for shape in scene.shapes():
            painter.paint(shape)
        _finish_page(canvas)
    canvas.save()


def _finish_page(canvas: Any) -> None:
    """End a page and pack its contents: reportlab would keep the text of all pages until the file is made."""
    from reportlab.pdfbase.pdfdoc import PDFArray, PDFDictionary, PDFName, PDFStream

    document = canvas._doc
    name = document.thisPageName()
    canvas.showPage()
    page = document.idToObject[name]
    packed = PDFDictionary({"Filter": PDFArray([PDFName("FlateDecode")])})
    page.Contents = PDFStream(packed, compress(page.stream.encode("latin-1")))
    page.stream = None


class PdfPainter:
    """Shapes on a page of a reportlab canvas, whose y goes upwards; the height is that of the scene, points."""

    def __init__(self, canvas: Any, paper: str, height: float) -> None:
        self._canvas, self._paper, self._height = canvas, paper, height

    @singledispatchmethod
    def paint(self, shape: Shape) -> None:
        """Draw a shape."""
        raise InvariantError("shape", f"{shown(shape)} is not a shape", "Line, Polygon, Disc or Label")

    @paint.register
    def _(self, shape: Line) -> None:
        self._canvas.setDash(list(shape.dash))
        self._draw(shape, closed=False, inside=None)
        self._canvas.setDash([])

    @paint.register
    def _(self, shape: Polygon) -> None:
        self._draw(shape, closed=True, inside=shape.fill, opacity=shape.opacity)

    @paint.register
    def _(self, shape: Disc) -> None:
        self._pens(shape.colour, shape.width, shape.fill)
        x, y = shape.centre
        self._canvas.circle(
            x,
            self._height - y,
            shape.radius,
            stroke=int(shape.colour is not None),
            fill=int(shape.fill is not None),
        )

    @paint.register
    def _(self, shape: Label) -> None:
        self._canvas.setFont(_font_of(shape), shape.size)
        place = self._canvas.drawCentredString if shape.anchor == "middle" else self._canvas.drawString
        x, y = shape.at[0], self._height - shape.at[1] - _BASELINE * shape.size
        if shape.halo:
            self._pens("paper", _HALO * shape.size, "paper")
            place(x, y, shape.text, mode=2)
        self._pens(None, 0, shape.colour)
        place(x, y, shape.text, mode=0)

    def _draw(self, shape: Line | Polygon, *, closed: bool, inside: str | None, opacity: float = 1.0) -> None:
        self._pens(shape.colour, shape.width, inside, opacity)
        path = self._canvas.beginPath()
        for number, (x, y) in enumerate(shape.points):
            (path.lineTo if number else path.moveTo)(x, self._height - y)
        if closed:
            path.close()
        self._canvas.drawPath(path, stroke=int(shape.colour is not None), fill=int(inside is not None))

    def _pens(self, colour: str | None, width: float, inside: str | None, opacity: float = 1.0) -> None:
        if colour is not None:
            self._canvas.setStrokeColor(colour_of(colour, self._paper))
            self._canvas.setLineWidth(width)
        if inside is not None:
            # with the colour: reportlab makes each colour opaque that comes without
            self._canvas.setFillColor(colour_of(inside, self._paper), alpha=opacity)


def _font_of(label: Label) -> str:
    """Return a font that has the letters: Helvetica, which every reader has, or the one that matplotlib brings."""
    try:
        label.text.encode("latin-1")
    except UnicodeEncodeError:
        from matplotlib import get_data_path
        from reportlab.pdfbase import pdfmetrics
        from reportlab.pdfbase.ttfonts import TTFont

        name = "DejaVuSans"
        if name not in pdfmetrics.getRegisteredFontNames():
            pdfmetrics.registerFont(TTFont(name, str(Path(get_data_path(), "fonts", "ttf", f"{name}.ttf"))))
        return name
    return "Helvetica-Bold" if label.bold else "Helvetica"


def check_picture(path: str | Path, *, force: bool = False) -> None:
    """Refuse a place where no picture can be written, before one is computed.

    Parameters
    ----------
    path : str or Path
    force : bool, optional
        Whether an existing file may be overwritten.

    Raises
    ------
    FileError
        If the extension is unknown, or the file exists and must not be overwritten.
    UnsolvableError
        If it is a raster image, and matplotlib is not installed.

    Examples
    --------
    >>> check_picture("a.bmp")
    Traceback (most recent call last):
    ...
    graphs.errors.FileError: a.bmp: the extension is not known; expected .png, .svg, .pdf
    """
    place = Path(path)
    kind = place.suffix.lower()
    if kind not in _KINDS:
        raise FileError(place, "", "the extension is not known", ", ".join(_KINDS))
    check_place(place, force=force)
    if kind == ".png":
        check_matplotlib()


def save_scene(scene: Scene, path: str | Path, *, paper: str = "light", force: bool = False) -> None:
    """Write a scene; equal scenes give equal files.

    Parameters
    ----------
    scene : Scene
    path : str or Path
        Ends in .svg, .png or .pdf.
    paper : {"light", "dark"}, optional
    force : bool, optional
        Overwrite an existing file.

    Raises
    ------
    FileError
        If the extension is another, or the file exists already or cannot be written.
    UnsolvableError
        If the library that writes PNG (matplotlib) or PDF (reportlab) is not installed.

    Examples
    --------
    >>> save_scene(Scene(9, 9, ()), "a.bmp")
    Traceback (most recent call last):
    ...
    graphs.errors.FileError: a.bmp: the extension is not known; expected .png, .svg, .pdf
    """
    check_picture(path, force=force)
    place = Path(path)
    kind = place.suffix.lower()
    if kind == ".pdf":
        stream = BytesIO()
        write_pdf([scene], stream, paper=paper)
        data = stream.getvalue()
    elif kind == ".png":
        image = pixels(scene, paper=paper)
        from PIL import Image  # comes with matplotlib

        stream = BytesIO()
        Image.fromarray(image).save(stream, "PNG", dpi=(_DOTS, _DOTS), compress_level=_PACKED)
        data = stream.getvalue()
    else:
        data = svg_text(scene, paper=paper).encode("utf-8")
    with whole_file(place, force=force) as beside:
        beside.write(data)


@contextmanager
def whole_file(place: Path, *, force: bool) -> Iterator[Beside]:
    """Yield a file beside its place, which is moved there when all is written, and removed after an error."""
    beside = Beside(place, force=force)
    try:
        yield beside
        beside.commit()
    finally:
        beside.discard()
