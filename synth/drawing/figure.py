"""Pictures: a matplotlib figure, and writing it whole or not at all."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import Any

from graphs.errors import FileError, UnsolvableError
from graphs.files.atomic import Beside, check_place

__all__ = ["COLOURS", "check_picture", "new_figure", "save_figure"]

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c564b", "#6a3d9a")
"""Colours of links and curves that people of all kinds of sight tell apart, the first eight."""
_UNDATED = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
_KINDS = ("png", "svg", "pdf")


def new_figure(width: float, height: float) -> Any:
    """Return an empty matplotlib figure.

    Parameters
    ----------
    width, height : float
        Inches.

    Raises
    ------
    UnsolvableError
        If matplotlib is not installed, or finds no folder that it can write to.

    Examples
    --------
    >>> float(new_figure(4, 3).get_figwidth())
    4.0
    """
    try:
        from matplotlib.figure import Figure
    except ImportError:
        raise UnsolvableError("pictures need matplotlib: pip install 'synthedra[draw]'") from None
    except OSError:  # neither a home nor a temporary folder
        raise UnsolvableError("matplotlib needs a folder to write to: name one in MPLCONFIGDIR") from None
    return Figure(figsize=(width, height), layout="constrained")


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

    Examples
    --------
    >>> check_picture("a.bmp")
    Traceback (most recent call last):
    ...
    graphs.errors.FileError: a.bmp: the extension is not known; expected .png, .svg, .pdf
    """
    place = Path(path)
    if _kind(place) not in _KINDS:
        raise FileError(place, "", "the extension is not known", ", ".join(f".{one}" for one in _KINDS))
    check_place(place, force=force)


def _kind(place: Path) -> str:
    return place.suffix.lower().lstrip(".")


def save_figure(figure: Any, path: str | Path, *, force: bool = False) -> None:
    """Write a figure as PNG, SVG or PDF, by the extension. Equal figures give equal files.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    path : str or Path
    force : bool, optional
        Replace a file that is there.

    Raises
    ------
    FileError
        If the extension is another, or the file cannot be written, or is there already.

    Examples
    --------
    >>> save_figure(new_figure(1, 1), "a.bmp")
    Traceback (most recent call last):
    ...
    graphs.errors.FileError: a.bmp: the extension is not known; expected .png, .svg, .pdf
    """
    check_picture(path, force=force)
    from matplotlib import rc_context

    place = Path(path)
    kind = _kind(place)
    stream = BytesIO()
    with rc_context({"svg.hashsalt": "synthedra"}):
        figure.savefig(stream, format=kind, dpi=150, metadata=_UNDATED.get(kind))
    beside = Beside(place, force=force)
    try:
        beside.write(stream.getvalue())
        beside.commit()
    finally:
        beside.discard()
