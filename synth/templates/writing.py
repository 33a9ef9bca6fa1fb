"""Templates written to files, whole or not at all: PDF, SVG or DXF, by the extension."""

from __future__ import annotations

from collections.abc import Sequence
from io import BytesIO
from math import sqrt
from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape

from graphs.errors import FileError, UnsolvableError
from graphs.files.atomic import Beside, check_place
from graphs.files.patterns.dxf import DxfLayer, DxfLine, DxfWord, dxf_of
from graphs.printing import plain
from synth.drawing.scene.writing import PdfPainter, svg_group
from synth.templates.pages import Page, Paper, Picture, gauge, laid_out, pages_of
from synth.templates.pieces import LOOKS, Piece, Stroke, Text
from synth.templates.template import Template

__all__ = ["check_template", "svg_of_page", "write_template"]


_BELOW = -8.0
"""Height of the gauge, millimetres; the pieces begin at 0."""
_ROW = 1.5
"""A row of pieces is so much longer than the side of a square of their boxes."""
_LAYERS = [DxfLayer(kind, look.number) for kind, look in LOOKS.items()]


def dxf_of_template(template: Template) -> str:
    """Return a template as DXF R12 in millimetres."""
    pieces = [piece.at_origin() for piece in template.pieces]
    strokes, texts = _side_by_side(pieces)
    ruler, words = gauge((0.0, _BELOW))
    lines = [DxfLine(stroke.kind, stroke.start, stroke.end) for stroke in (*strokes, *ruler)]
    named = [DxfWord("MARKS", text.at, text.words, text.size, text.middle) for text in (*texts, *words)]
    return dxf_of(_LAYERS, lines, named, remark="millimetres")


def _side_by_side(pieces: list[Piece]) -> tuple[list[Stroke], list[Text]]:
    """Return the strokes and texts of all pieces, in rows without end."""
    widest = max(piece.size[0] for piece in pieces)
    width = max(widest, _ROW * sqrt(sum(piece.size[0] * piece.size[1] for piece in pieces)))
    moved = [piece.moved(right, up) for laid in laid_out(pieces, width, float("inf")) for piece, right, up in laid]
    return [one for piece in moved for one in piece.strokes], [one for piece in moved for one in piece.texts]


_POINTS = 72 / 25.4
"""Points, the unit of PDF, in a millimetre."""
_BASELINE = 0.35


def check_reportlab() -> None:
    """Raise UnsolvableError if reportlab, which writes PDF, is not installed."""
    try:
        import reportlab  # noqa: F401
    except ImportError:
        raise UnsolvableError("PDF requires reportlab; try pip install 'synthedra[draw]'") from None


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


_DIGITS = 6


def svg_of_page(page: Page) -> str:
    """Return a page as SVG; a unit of its coordinates is a millimetre.

    >>> from synth.templates.pages import Paper
    >>> print(svg_of_page(Page(Paper(200, 300), (Stroke("CUT", (10, 10), (60, 10)),), ())).splitlines()[2])
    <line x1="10" y1="290" x2="60" y2="290"/>
    """
    width, height = page.paper.width, page.paper.height
    rows = [
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" '
        f'width="{width:g}mm" height="{height:g}mm" viewBox="0 0 {width:g} {height:g}">'
    ]
    for kind, look in LOOKS.items():
        strokes = [stroke for stroke in page.strokes if stroke.kind == kind]
        if not strokes:
            continue
        dash = f' stroke-dasharray="{" ".join(f"{part:g}" for part in look.dash)}"' if look.dash else ""
        rows.append(
            f'<g id="{kind}" inkscape:groupmode="layer" inkscape:label="{kind}" fill="none" '
            f'stroke="{look.colour}" stroke-width="{look.width:g}" stroke-linecap="round"{dash}>'
        )
        rows += [_line(stroke, height) for stroke in strokes]
        rows.append("</g>")
    if page.texts:
        rows.append('<g id="TEXT" inkscape:groupmode="layer" inkscape:label="TEXT" font-family="sans-serif">')
        rows += [_text(text, height, page.ink) for text in page.texts]
        rows.append("</g>")
    if page.picture is not None:
        rows.append(_picture(page.picture, height))
    return "\n".join([*rows, "</svg>"]) + "\n"


def _line(stroke: Stroke, height: float) -> str:
    (x1, y1), (x2, y2) = stroke.start, stroke.end
    return f'<line x1="{_put(x1)}" y1="{_put(height - y1)}" x2="{_put(x2)}" y2="{_put(height - y2)}"/>'


def _text(text: Text, height: float, ink: str) -> str:
    x, y = text.at
    anchor = ' text-anchor="middle"' if text.middle else ""
    low = height - y + _BASELINE * text.size
    return (
        f'<text x="{_put(x)}" y="{_put(low)}" font-size="{text.size:g}" fill="{ink}"{anchor}>'
        f"{escape(text.words)}</text>"
    )


def _picture(picture: Picture, height: float) -> str:
    scene, (left, low) = picture.scene, picture.corner
    wide, high = (picture.scale * side for side in (scene.width, scene.height))
    head = (
        f'<svg x="{_put(left)}" y="{_put(height - low - high)}" width="{_put(wide)}" height="{_put(high)}" '
        f'viewBox="0 0 {_put(scene.width)} {_put(scene.height)}" stroke-linejoin="round" stroke-linecap="round">'
    )
    return "\n".join([head, svg_group(scene), "</svg>"])


def _put(number: float) -> str:
    """Write a number to a millionth of a millimetre, without zeros at its end."""
    return f"{round(number, _DIGITS) + 0.0:.{_DIGITS}f}".rstrip("0").rstrip(".")


_KINDS = (".pdf", ".svg", ".dxf")
_LONGEST_TITLE = 200
_A4 = Paper(210.0, 297.0)


def check_template(path: str | Path, *, force: bool = False) -> None:
    """Refuse a path where no template can be written, before one is made.

    Raise FileError if the extension is unknown, or an existing file must not be replaced; UnsolvableError for a
    PDF if reportlab is not installed.

    >>> check_template("a.doc")
    Traceback (most recent call last):
    ...
    graphs.errors.FileError: a.doc: the extension is not known; expected .pdf, .svg, .dxf
    """
    place = Path(path)
    suffix = place.suffix.lower()
    if suffix not in _KINDS:
        raise FileError(place, "", "the extension is not known", ", ".join(_KINDS))
    if suffix == ".pdf":
        check_reportlab()
    check_place(place, force=force)


def write_template(
    template: Template, path: str | Path, *, paper: Paper = _A4, force: bool = False
) -> tuple[Path, ...]:
    """Write a template; equal templates give equal files.

    Parameters
    ----------
    template : Template
    path : str or Path
        ``.pdf``: a file with all pages, that of assembly last. ``.svg``: a file, or one for each page,
        ``t-1.svg``, ``t-2.svg``, ..., and ``t-note.svg``. ``.dxf``: one drawing at full size; no pages, no note.
    paper : Paper, optional
        A4 by default; it is turned if that saves pages.
    force : bool, optional
        Overwrite existing files.

    Returns
    -------
    tuple of Path
        The written files.

    Raises
    ------
    FileError
        If the extension is unknown, or a file cannot be written or exists.
    UnsolvableError
        If there would be too many pages, or reportlab is not installed.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.templates.template import template_of
    >>> square = Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3)), ((0, 0), (1, 0), (1, 1), (0, 1)))
    >>> with TemporaryDirectory() as folder:
    ...     written = write_template(template_of(square, size=50), Path(folder, "square.svg"))
    ...     print([(path.name, path.read_text()[:4]) for path in written])
    [('square.svg', '<svg'), ('square-note.svg', '<svg')]
    """
    place = Path(path)
    check_template(place, force=force)
    suffix = place.suffix.lower()
    if suffix == ".dxf":
        files = {place: dxf_of_template(template).encode("ascii", "replace")}
    elif suffix == ".pdf":
        files = {place: pdf_of_pages(pages_of(template, paper), plain(template.title, _LONGEST_TITLE))}
    else:
        files = _svg_files(pages_of(template, paper), place)
    for one in files:
        check_place(one, force=force)
    for one, data in files.items():
        beside = Beside(one, force=force)
        try:
            beside.write(data)
            beside.commit()
        finally:
            beside.discard()
    return tuple(files)


def _svg_files(pages: list[Page], place: Path) -> dict[Path, bytes]:
    """Return the name and content of each page; that of assembly is a file of its own, of which nothing is cut."""
    lines = [page for page in pages if not page.is_note]
    names = [place]
    if len(lines) > 1:
        names = [place.with_name(f"{place.stem}-{number}{place.suffix}") for number in range(1, len(lines) + 1)]
    files = dict(zip(names, lines, strict=True))
    files |= {place.with_name(f"{place.stem}-note{place.suffix}"): page for page in pages if page.is_note}
    return {name: svg_of_page(page).encode() for name, page in files.items()}
