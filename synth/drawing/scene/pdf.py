"""Scenes as PDF, through reportlab: a scene a page, written as they come. Equal scenes give equal files."""

from __future__ import annotations

from collections.abc import Iterable
from functools import singledispatchmethod
from io import BytesIO
from typing import IO, Any
from zlib import compress

from graphs.errors import InvariantError, UnsolvableError, shown
from synth.drawing.scene.palette import colour_of
from synth.drawing.scene.shapes import Disc, Label, Line, Polygon, Scene, Shape

__all__ = ["Painter", "pdf_bytes", "write_pdf"]

_BASELINE = 0.35
_HALO = 0.3


def pdf_bytes(scene: Scene, *, paper: str = "light") -> bytes:
    """Return a scene as a PDF file of one page, as large as the scene.

    Raise UnsolvableError if reportlab is not installed.
    """
    stream = BytesIO()
    write_pdf([scene], stream, paper=paper)
    return stream.getvalue()


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
        painter = Painter(canvas, paper, scene.height)
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


class Painter:
    """Shapes on a page of a reportlab canvas, whose y goes upwards; the height is that of the scene, points."""

    def __init__(self, canvas: Any, paper: str, height: float) -> None:
        self._canvas, self._paper, self._height = canvas, paper, height

    @singledispatchmethod
    def paint(self, shape: Shape) -> None:
        """Draw a shape."""
        raise InvariantError("shape", f"{shown(shape)} is no shape", "Line, Polygon, Disc or Label")

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
        return _wide_font()
    return "Helvetica-Bold" if label.bold else "Helvetica"


def _wide_font() -> str:
    from pathlib import Path

    from matplotlib import get_data_path
    from reportlab.pdfbase import pdfmetrics
    from reportlab.pdfbase.ttfonts import TTFont

    name = "DejaVuSans"
    if name not in pdfmetrics.getRegisteredFontNames():
        pdfmetrics.registerFont(TTFont(name, str(Path(get_data_path(), "fonts", "ttf", f"{name}.ttf"))))
    return name
