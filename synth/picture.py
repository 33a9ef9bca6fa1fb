"""Pictures: a figure to draw on and a file to keep it in. matplotlib is an extra, ``draw``."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from graphs.errors import FileError, UnsolvableError
from graphs.files.source import Beside

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["SUFFIXES", "check_suffix", "new_figure", "save_picture"]

SUFFIXES = (".svg", ".png", ".pdf")


def new_figure(width: float, height: float) -> Figure:
    """Return an empty figure, size in inches; no window is opened.

    Raises
    ------
    UnsolvableError
        If matplotlib is not installed.
    """
    try:
        from matplotlib.figure import Figure
    except ImportError:
        raise UnsolvableError("pictures need matplotlib: pip install 'synthedra[draw]'") from None
    return Figure(figsize=(width, height), layout="constrained")


def save_picture(figure: Figure, path: str | Path) -> None:
    """Write a figure in the format that the extension names; equal figures give equal files.

    Raises
    ------
    FileError
        If the extension is not known or the file cannot be written.
    """
    import matplotlib as mpl

    path = Path(path)
    check_suffix(path)
    suffix = path.suffix.lower()
    picture = BytesIO()
    no_date = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(suffix[1:], {})
    with mpl.rc_context({"svg.hashsalt": "synthedra", "svg.fonttype": "none"}):
        figure.savefig(picture, format=suffix[1:], dpi=150, metadata=no_date)
    beside = Beside(path)
    try:
        beside.write(picture.getvalue())
        beside.commit()
    finally:
        beside.discard()


def check_suffix(path: str | Path) -> None:
    """Refuse a file whose extension names no format of pictures, before anything is computed.

    Raises
    ------
    FileError

    Examples
    --------
    >>> check_suffix("sphere.jpeg")
    Traceback (most recent call last):
    ...
    graphs.errors.FileError: sphere.jpeg: the extension is not known; expected one of .svg .png .pdf
    """
    if Path(path).suffix.lower() not in SUFFIXES:
        raise FileError(path, "", "the extension is not known", "one of " + " ".join(SUFFIXES))
