"""Pages as PDF, through reportlab. Equal pages give equal files."""

from __future__ import annotations

from collections.abc import Sequence
from io import BytesIO
from typing import Any

from graphs.errors import UnsolvableError
from synth.drawing.scene.writing import PdfPainter
from synth.templates.lines import LOOKS, Text
from synth.templates.page import Page, Picture

__all__ = ["check_reportlab", "pdf_of_pages"]

_POINTS = 72 / 25.4
"""Points, the unit of PDF, in a millimetre."""
_BASELINE = 0.35


def check_reportlab() -> None:
    """Raise UnsolvableError if reportlab, which writes PDF, is not installed."""
    try:
        import reportlab  # noqa: F401
    except ImportError:
        raise UnsolvableError("PDF needs reportlab: pip install 'synthedra[draw]'") from None


def pdf_of_pages(pages: Sequence[Page], title: str = "") -> bytes:
    """Return a PDF file of pages, each as large as its paper.

    Raise UnsolvableError if reportlab is not installed.
    """
    check_reportlab()
    from reportlab.pdfgen.canvas import Canvas

    stream = BytesIO()
    canvas = Canvas(stream, invariant=1, pageCompression=1)
    canvas.setTitle(title)
    canvas.setViewerPreference("PrintScaling", "None")  # printers would shrink it to what they can reach
    for page in pages:
        canvas.setPageSize((page.paper.width * _POINTS, page.paper.height * _POINTS))
        canvas.setLineCap(1)
        for kind, look in LOOKS.items():
            canvas.setStrokeColor(look.colour)
            canvas.setLineWidth(look.width * _POINTS)
            canvas.setDash([part * _POINTS for part in look.dash])
            for stroke in page.strokes:
                if stroke.kind == kind:
                    ends = (*stroke.start, *stroke.end)
                    canvas.line(*(number * _POINTS for number in ends))
        canvas.setFillColor(page.ink)
        for text in page.texts:
            _write(canvas, text)
        if page.picture is not None:
            _paint(canvas, page.picture)
        canvas.showPage()
    canvas.save()
    return stream.getvalue()


def _write(canvas: Any, text: Text) -> None:
    canvas.setFont("Helvetica", text.size * _POINTS)
    place = canvas.drawCentredString if text.middle else canvas.drawString
    place(text.at[0] * _POINTS, (text.at[1] - _BASELINE * text.size) * _POINTS, text.words)


def _paint(canvas: Any, picture: Picture) -> None:
    scene = picture.scene
    canvas.saveState()
    canvas.translate(*(side * _POINTS for side in picture.corner))
    canvas.scale(picture.scale * _POINTS, picture.scale * _POINTS)
    canvas.setLineJoin(1)
    canvas.setDash([])
    painter = PdfPainter(canvas, "light", scene.height)
    for shape in scene.shapes():
        painter.paint(shape)
    canvas.restoreState()
