"""Templates written to files, whole or not at all: PDF, SVG or DXF, by the extension."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import chain
from math import inf, sqrt
from pathlib import Path

from graphs.files.atomic import check_place
from graphs.files.outputs import check_writable, write_as
from graphs.files.patterns.dxf import DxfLayer, DxfLine, DxfWord, dxf_of
from graphs.printing import plain
from synth.exporters import EXPORTERS
from synth.making.drawing.scene.shapes import Label, Line
from synth.making.drawing.scene.writing import Pages, Scene
from synth.making.templates.laser import LASER_LAYERS, laser_scene, with_kerf
from synth.making.templates.pages import Page, Paper, gauge, laid_out, layers_of, pages_of, strokes_and_texts
from synth.making.templates.pieces import LOOKS
from synth.making.templates.template import Template

_BELOW = -8.0
"""Height of the gauge, millimetres; the pieces begin at 0."""
_ROW = 1.5
"""A row of pieces is so much longer than the side of a square of their boxes."""
_LAYERS = [DxfLayer(kind, look.number) for kind, look in LOOKS.items()]


def laser_dxf_bytes(pages: Pages) -> bytes:
    """Return a template for laser cutters as DXF."""
    return dxf_bytes(pages, _LASER_DXF)


def dxf_bytes(pages: Pages, layers: Sequence[DxfLayer] = _LAYERS) -> bytes:
    """Return a template on one page as DXF R12 in millimetres; texts are on the last layer, of marks or engravings."""
    (scene,) = pages.scenes
    lines: list[DxfLine] = []
    words: list[DxfWord] = []
    for layer in scene.layers:
        for shape in layer.shapes:
            if isinstance(shape, Line):
                start, end = ((x, scene.height - y) for x, y in shape.points)
                lines.append(DxfLine(layer.name, start, end))
            elif isinstance(shape, Label):
                at = (shape.at[0], scene.height - shape.at[1])
                words.append(DxfWord(layers[-1].name, at, shape.text, shape.size, shape.anchor == "middle"))
    return dxf_of(list(layers), lines, words, remark="millimetres").encode("ascii", "replace")


def _side_by_side(template: Template) -> Scene:
    """Return all pieces of a template in rows without end, on no page, with the gauge below."""
    pieces = [piece.at_origin() for piece in template.pieces]
    widest = max(piece.size[0] for piece in pieces)
    width = max(widest, _ROW * sqrt(sum(piece.size[0] * piece.size[1] for piece in pieces)))
    strokes, texts = strokes_and_texts(chain.from_iterable(laid_out(pieces, width, inf)))
    ruler, words = gauge((0.0, _BELOW))
    layers = layers_of([*strokes, *ruler], [*texts, *words], 0.0, LOOKS["MARKS"].colour)
    return Scene(0.0, 0.0, tuple(layers), unit="mm")


_LASER_DXF = [DxfLayer(name, number) for name, (_, number) in LASER_LAYERS.items()]
_LONGEST_TITLE = 200
_A4 = Paper(210.0, 297.0)


def write_template(
    template: Template,
    path: str | Path,
    *,
    paper: Paper = _A4,
    laser: bool = False,
    kerf: float = 0.0,
    force: bool = False,
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
    laser : bool, optional
        Write one drawing at full size, without pages and note, its lines in layers to cut (red), score (blue) and
        engrave (black).
    kerf : float, optional
        Width of the cut, millimetres: outlines move outward, and into holes, by half of it.
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
        If there would be too many pages, reportlab is not installed, or the kerf is wider than a gap.
    InvariantError
        If the kerf is out of range.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.making.templates.template import template_of
    >>> square = Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3)), ((0, 0), (1, 0), (1, 1), (0, 1)))
    >>> with TemporaryDirectory() as folder:
    ...     written = write_template(template_of(square, size=50), Path(folder, "square.svg"))
    ...     print([(path.name, path.read_text()[:4]) for path in written])
    [('square.svg', '<svg'), ('square-note.svg', '<svg')]
    """
    place = Path(path)
    check_writable(place, EXPORTERS["templates"], force=force)
    suffix = place.suffix.lower()
    template = with_kerf(template, kerf)
    if laser:
        write_as(Pages([laser_scene(template)]), place, EXPORTERS["laser templates"], force=force)
        return (place,)
    if suffix == ".dxf":
        files = {place: Pages([_side_by_side(template)])}
    elif suffix == ".pdf":
        first, *rest = (page.scene for page in pages_of(template, paper))
        files = {place: Pages([replace(first, title=plain(template.title, _LONGEST_TITLE)), *rest])}
    else:
        files = {name: Pages([page.scene]) for name, page in _svg_files(pages_of(template, paper), place)}
    for name in files:
        check_place(name, force=force)
    for name, pages in files.items():
        write_as(pages, name, EXPORTERS["templates"], force=force)
    return tuple(files)


def _svg_files(pages: list[Page], place: Path) -> Iterator[tuple[Path, Page]]:
    """Yield the name of each page with it; that of assembly is a file of its own, of which nothing is cut."""
    to_cut = [page for page in pages if not page.is_note]
    for number, page in enumerate(to_cut, start=1):
        yield (place if len(to_cut) == 1 else place.with_name(f"{place.stem}-{number}{place.suffix}")), page
    for page in pages[len(to_cut) :]:
        yield place.with_name(f"{place.stem}-note{place.suffix}"), page
