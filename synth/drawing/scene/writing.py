"""Scenes written to files, whole or not at all: SVG, PNG or PDF, by the extension."""

from __future__ import annotations

from pathlib import Path

from graphs.errors import FileError
from graphs.files.atomic import Beside, check_place
from synth.drawing.scene.shapes import Scene

__all__ = ["check_picture", "save_scene", "scene_bytes"]

_KINDS = (".png", ".svg", ".pdf")


def check_picture(path: str | Path, *, force: bool = False) -> None:
    """Refuse a place where no picture can be written, before one is computed.

    Parameters
    ----------
    path : str or Path
    force : bool, optional
        A file that is there may be replaced.

    Raises
    ------
    FileError
        If the extension is not known, or something is there that must not be replaced.
    UnsolvableError
        If it is of pixels, and matplotlib is not installed.

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
        from synth.drawing.scene.raster import check_matplotlib

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
        Replace a file that is there.

    Raises
    ------
    FileError
        If the extension is another, or the file cannot be written, or is there already.
    UnsolvableError
        If what writes PNG (matplotlib) or PDF (reportlab) is not installed.

    Examples
    --------
    >>> save_scene(Scene(9, 9, ()), "a.bmp")
    Traceback (most recent call last):
    ...
    graphs.errors.FileError: a.bmp: the extension is not known; expected .png, .svg, .pdf
    """
    check_picture(path, force=force)
    place = Path(path)
    data = scene_bytes(scene, place.suffix.lower().lstrip("."), paper=paper)
    beside = Beside(place, force=force)
    try:
        beside.write(data)
        beside.commit()
    finally:
        beside.discard()


def scene_bytes(scene: Scene, kind: str, *, paper: str = "light") -> bytes:
    """Return a scene as a file: ``"svg"``, ``"png"`` or ``"pdf"``."""
    if kind == "png":
        from synth.drawing.scene.raster import png_bytes

        return png_bytes(scene, paper=paper)
    if kind == "pdf":
        from synth.drawing.scene.pdf import pdf_bytes

        return pdf_bytes(scene, paper=paper)
    from synth.drawing.scene.svg import svg_text

    return svg_text(scene, paper=paper).encode("utf-8")
