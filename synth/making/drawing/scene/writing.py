"""Scenes: pictures in layers, and their writers for SVG, PNG and PDF.

Equal scenes give equal files, whole or not at all. SVG is plain text with nothing in it that runs or loads. Each
layer is a group with its name as class; shapes carry ``data-joint`` and ``data-link``. Numbers have two decimals:
a hundredth of a point is less than any printer shows. Raster images are drawn by the renderer of matplotlib,
without its figures: these look after ticks, layouts and events, and would take ten times as long. PDF is written
by reportlab, page by page.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from io import BytesIO
from math import ceil
from pathlib import Path
from typing import Any, Literal, NamedTuple
from xml.sax.saxutils import escape, quoteattr
from zlib import compress

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError, shown
from graphs.files.outputs import write_as
from graphs.printing import LONGEST_CELL, plain
from synth.exporters import EXPORTERS
from synth.making.drawing.scene.shapes import Disc, Label, Layer, Line, Point, Polygon, Shape, colour_of, scaled

_FONT = "Helvetica, Arial, 'DejaVu Sans', sans-serif"
_BASELINE = 0.35
"""From the middle of letters down to the line they stand on, in SVG and PDF, in units of their size."""
_HALO = 0.3
"""Width of the rim of letters, in units of their size."""
_INCH = 72
_MILLIMETRE = 72 / 25.4
"""Points."""
_DECIMALS = {"pt": 2, "mm": 6}
_DOTS = 200.0
_PACKED = 3
"""Compression level of PNG, of nine: files a tenth larger in a third of the time."""
_MIDDLE = 0.36
"""Height of the middle of figures and capitals of matplotlib, in units of the size of letters."""


@dataclass(frozen=True, slots=True)
class Scene:
    """A picture before it is written.

    Attributes
    ----------
    width, height : float
        Points, 72 to an inch, or millimetres.
    layers : tuple of Layer
        From below to above.
    title : str
        Description for those who cannot see the picture; it is not drawn.
    unit : {"pt", "mm"}
        Of all lengths. A scene in millimetres is for printers and machines: no paper is painted below it, and in
        SVG its layers are layers of drawing programs, with six decimals.

    Examples
    --------
    >>> Scene(100, 50, (Layer("links", (Disc((50, 25), 4),)),)).layers[0].name
    'links'
    """

    width: float
    height: float
    layers: tuple[Layer, ...]
    title: str = ""
    unit: Literal["pt", "mm"] = "pt"

    def __post_init__(self) -> None:
        object.__setattr__(self, "title", plain(self.title, 400))

    def shapes(self) -> Iterator[Shape]:
        """Yield the shapes of all layers, from below to above."""
        for layer in self.layers:
            yield from layer.shapes

    def labels(self) -> list[Label]:
        """Return the labels of all layers."""
        return [shape for shape in self.shapes() if isinstance(shape, Label)]

    def save(self, path: str | Path, *, paper: str = "light", force: bool = False) -> None:
        """Write the picture in the format of the extension; equal pictures give equal files.

        Parameters
        ----------
        path : str or Path
            Ends in .png, .svg or .pdf.
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
        >>> from tempfile import TemporaryDirectory
        >>> import synth
        >>> with TemporaryDirectory() as folder:
        ...     synth.draw(synth.read("k1:Cr")).save(f"{folder}/four-bar.svg")
        ...     print(Path(folder, "four-bar.svg").read_text()[:4])
        <svg
        """
        write_as(Pages([self], paper), path, EXPORTERS["pictures"], force=force)


def in_points(scene: Scene) -> Scene:
    """Return a scene with all lengths in points."""
    if scene.unit == "pt":
        return scene
    layers = tuple(scaled(layer, _MILLIMETRE) for layer in scene.layers)
    return replace(scene, width=_MILLIMETRE * scene.width, height=_MILLIMETRE * scene.height, layers=layers, unit="pt")


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
    >>> text = svg_text(Scene(9, 9, (Layer("a", (Label((4, 4), "<script>"),)),), title="x"))
    >>> "&lt;script&gt;" in text, "<script" in text
    (True, False)
    """
    writer = _SvgWriter(paper, _DECIMALS[scene.unit])
    wide, high = writer.number(scene.width), writer.number(scene.height)
    for_machines = scene.unit == "mm"
    inkscape = ' xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"' if for_machines else ""
    rows = [
        f'<svg xmlns="http://www.w3.org/2000/svg"{inkscape} width="{wide}{scene.unit}" '
        f'height="{high}{scene.unit}" viewBox="0 0 {wide} {high}" role="img" font-family="{_FONT}" '
        'stroke-linejoin="round" stroke-linecap="round">',
        f"<title>{escape(scene.title)}</title>",
    ]
    if not for_machines:
        rows.append(f'<rect width="{wide}" height="{high}" fill="{colour_of("paper", paper)}"/>')
    for layer in scene.layers:
        name = quoteattr(plain(layer.name))
        look = f'id={name} inkscape:groupmode="layer" inkscape:label={name}' if for_machines else f"class={name}"
        rows += [f"<g {look}>", *(_painted(writer, shape) for shape in layer.shapes), "</g>"]
    return "\n".join([*rows, "</svg>", ""])


def _painted(painter: _SvgWriter | _RasterPainter | _PdfPainter, shape: Shape) -> Any:
    """Draw a shape by the method for its kind; in SVG return its element."""
    match shape:
        case Line():
            return painter.line(shape)
        case Polygon():
            return painter.polygon(shape)
        case Disc():
            return painter.disc(shape)
        case Label():
            return painter.label(shape)
    raise InvariantError("shape", f"{shown(shape)} is not a shape", "Line, Polygon, Disc or Label")


class _SvgWriter:
    """Shapes as elements, in the colours of a paper; numbers have at most so many decimals."""

    def __init__(self, paper: str, decimals: int) -> None:
        self._paper, self._decimals = paper, decimals

    def number(self, value: float) -> str:
        """Return a number without zeros that say nothing."""
        if not abs(value) < 1e7:
            raise InvariantError("picture", f"a coordinate is {shown(value)}", "a number of points below 1e7")
        text = f"{value:.{self._decimals}f}".rstrip("0").rstrip(".")
        if text in ("-0", ""):
            return "0"
        return text.replace("0.", ".", 1) if text.startswith(("0.", "-0.")) else text

    def line(self, shape: Line) -> str:
        dash = f' stroke-dasharray="{" ".join(map(self.number, shape.dash))}"' if shape.dash else ""
        pen = self._pen(shape.colour, shape.width)
        return f'<path{_data(shape)} d="{self._path_data(shape.points)}" fill="none"{pen}{dash}/>'

    def polygon(self, shape: Polygon) -> str:
        pen, fill = self._pen(shape.colour, shape.width), self._fill(shape.fill)
        light = f' fill-opacity="{self.number(shape.opacity)}"' if shape.opacity < 1 else ""
        return f'<path{_data(shape)} d="{self._path_data(shape.points)}Z"{fill}{light}{pen}/>'

    def disc(self, shape: Disc) -> str:
        x, y = map(self.number, shape.centre)
        pen, fill = self._pen(shape.colour, shape.width), self._fill(shape.fill)
        return f'<circle{_data(shape)} cx="{x}" cy="{y}" r="{self.number(shape.radius)}"{fill}{pen}/>'

    def label(self, shape: Label) -> str:
        x, y = self.number(shape.at[0]), self.number(shape.at[1] + _BASELINE * shape.size)
        look = f' font-size="{self.number(shape.size)}" text-anchor="{shape.anchor}"' + self._fill(shape.colour)
        if shape.bold:
            look += ' font-weight="bold"'
        if shape.halo:
            look += self._pen("paper", _HALO * shape.size) + ' paint-order="stroke"'
        return f'<text{_data(shape)} x="{x}" y="{y}"{look}>{escape(shape.text)}</text>'

    def _path_data(self, points: Sequence[Point]) -> str:
        return "M" + "L".join(f"{self.number(x)} {self.number(y)}" for x, y in points)

    def _pen(self, colour: str | None, width: float) -> str:
        if colour is None:
            return ""
        return f' stroke="{colour_of(colour, self._paper)}" stroke-width="{self.number(width)}"'

    def _fill(self, colour: str | None) -> str:
        return ' fill="none"' if colour is None else f' fill="{colour_of(colour, self._paper)}"'


def _data(shape: Shape) -> str:
    return "".join(f" data-{key}={quoteattr(plain(value, LONGEST_CELL))}" for key, value in shape.data)


def pixels(scene: Scene, *, paper: str = "light", dots: float = _DOTS) -> npt.NDArray[np.uint8]:
    """Return a scene as pixels: uint8[height, width, 3], red, green and blue; `dots` per inch."""
    from matplotlib.backends.backend_agg import RendererAgg

    scene = in_points(scene)
    unit = dots / _INCH
    wide, high = ceil(scene.width * unit), ceil(scene.height * unit)
    renderer = RendererAgg(wide, high, dots)  # type: ignore[no-untyped-call]
    painter = _RasterPainter(renderer, paper, unit, high)
    right, below = wide / unit, high / unit
    painter.polygon(Polygon([(0, 0), (right, 0), (right, below), (0, below)], "paper"))
    for shape in scene.shapes():
        _painted(painter, shape)
    return np.asarray(painter.renderer.buffer_rgba())[..., :3].copy()


class _RasterPainter:
    """Shapes as paths, each over those before; y of the renderer goes upwards."""

    def __init__(self, renderer: Any, paper: str, unit: float, high: int) -> None:
        from matplotlib.transforms import Affine2D

        self.renderer = renderer
        self._paper = paper
        self._on_page = Affine2D().scale(unit, -unit).translate(0, high)

    def line(self, shape: Line) -> None:
        pen = self._pen(shape.colour, shape.width)
        if shape.dash:
            pen.set_dashes(0, list(shape.dash))
        self.renderer.draw_path(pen, _path(shape.points), self._on_page)

    def polygon(self, shape: Polygon) -> None:
        path = _path([*shape.points, shape.points[0]], closed=True)
        if shape.fill is not None:  # apart, for the outline is never transparent
            pen = self._pen(None, 0)
            pen.set_alpha(shape.opacity)
            self.renderer.draw_path(pen, path, self._on_page, self._rgb(shape.fill, shape.opacity))
        if shape.colour is not None:
            self.renderer.draw_path(self._pen(shape.colour, shape.width), path, self._on_page)

    def disc(self, shape: Disc) -> None:
        from matplotlib.path import Path
        from matplotlib.transforms import Affine2D

        place = Affine2D().scale(shape.radius).translate(*shape.centre) + self._on_page
        inside = None if shape.fill is None else self._rgb(shape.fill)
        self.renderer.draw_path(self._pen(shape.colour, shape.width), Path.unit_circle(), place, inside)

    def label(self, shape: Label) -> None:
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
    path = Path(np.asarray(corners, dtype=float).reshape(-1, 2) * scale, codes) if len(corners) else Path([(0.0, 0.0)])
    return path, float(wide) * scale


def pdf_bytes(scenes: Iterable[Scene], *, paper: str = "light") -> bytes:
    """Return scenes as the pages of a PDF file; a scene is released when its page is written."""
    from reportlab.pdfgen.canvas import Canvas

    canvas = Canvas(BytesIO(), invariant=1)
    for number, scene in enumerate(scenes):
        page = in_points(scene)
        if number == 0:
            canvas.setTitle(scene.title)
            if scene.unit == "mm":
                canvas.setViewerPreference("PrintScaling", "None")  # printers would shrink it to what they reach
        canvas.setPageSize((page.width, page.height))
        canvas.setLineJoin(1)
        canvas.setLineCap(1)
        if scene.unit == "pt":
            canvas.setFillColor(colour_of("paper", paper))
            canvas.rect(0, 0, page.width, page.height, stroke=0, fill=1)
        painter = _PdfPainter(canvas, paper, page.height)
        for shape in page.shapes():
            _painted(painter, shape)
        _finish_page(canvas)
    data: bytes = canvas.getpdfdata()
    return data


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


class _PdfPainter:
    """Shapes on a page of a reportlab canvas, whose y goes upwards; the height is that of the scene, points."""

    def __init__(self, canvas: Any, paper: str, height: float) -> None:
        self._canvas, self._paper, self._height = canvas, paper, height

    def line(self, shape: Line) -> None:
        self._canvas.setDash(list(shape.dash))
        self._draw(shape, closed=False, inside=None)
        self._canvas.setDash([])

    def polygon(self, shape: Polygon) -> None:
        self._draw(shape, closed=True, inside=shape.fill, opacity=shape.opacity)

    def disc(self, shape: Disc) -> None:
        self._pens(shape.colour, shape.width, shape.fill)
        x, y = shape.centre
        self._canvas.circle(x, self._height - y, shape.radius, **_used(shape.colour, shape.fill))

    def label(self, shape: Label) -> None:
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
        self._canvas.drawPath(path, **_used(shape.colour, inside))

    def _pens(self, colour: str | None, width: float, inside: str | None, opacity: float = 1.0) -> None:
        if colour is not None:
            self._canvas.setStrokeColor(colour_of(colour, self._paper))
            self._canvas.setLineWidth(width)
        if inside is not None:
            # with the colour: reportlab makes each colour opaque that comes without
            self._canvas.setFillColor(colour_of(inside, self._paper), alpha=opacity)


def _used(colour: str | None, inside: str | None) -> dict[str, int]:
    return {"stroke": int(colour is not None), "fill": int(inside is not None)}


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


class Pages(NamedTuple):
    """What a picture file holds: a scene, or in a PDF one for each page, in the colours of a paper."""

    scenes: Iterable[Scene]
    paper: str = "light"


def png_bytes(pages: Pages) -> bytes:
    """Return the one scene of some pages as PNG."""
    from PIL import Image  # comes with matplotlib

    (scene,) = pages.scenes
    stream = BytesIO()
    image = Image.fromarray(pixels(scene, paper=pages.paper))
    image.save(stream, "PNG", dpi=(_DOTS, _DOTS), compress_level=_PACKED)
    return stream.getvalue()


def svg_bytes(pages: Pages) -> bytes:
    """Return the one scene of some pages as SVG."""
    (scene,) = pages.scenes
    return svg_text(scene, paper=pages.paper).encode("utf-8")


def pdf_of_pages(pages: Pages) -> bytes:
    """Return scenes as PDF, a page each."""
    return pdf_bytes(pages.scenes, paper=pages.paper)
