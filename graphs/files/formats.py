"""One path from a file to a mechanism and back: formats by extension.

To add a format, write a reader or a writer and enter it in ``READERS`` or ``WRITERS`` (CONTRIBUTING.md).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from graphs.convert.table import Mechanism, to_sc, to_sheet
from graphs.errors import FileError
from graphs.files.atomic import write_text
from graphs.files.bare import (
    as_sc,
    edge_list_text,
    graph6_text,
    graphml_text,
    read_edge_list,
    read_graph6,
    read_graphml,
)
from graphs.files.native.documents import dumps, from_document
from graphs.files.patterns.fold import fold_text, sheet_from_fold
from graphs.files.patterns.obj import obj_text, sheet_from_obj
from graphs.files.text import load_json
from graphs.mechanism.sheet import Sheet

__all__ = ["READERS", "WRITERS", "Entry", "read", "read_all", "read_frame", "write"]


@dataclass(frozen=True, slots=True)
class Entry:
    """One mechanism of a file.

    Attributes
    ----------
    label : str
        The file, and the line where it holds several.
    mechanism : SCGraph, SCDGraph, PolyhedronModel, VertexEdgeGraph or Sheet
    """

    label: str
    mechanism: Mechanism


def read_all(path: str | Path) -> Iterator[Entry]:
    """Yield every mechanism of a file; most files hold one, graph6 files one a line.

    Raises
    ------
    FileError
        If the file cannot be read.
    """
    path = Path(path)
    found = list(_reader(path)(path))
    for place, mechanism in found:
        yield Entry(f"{path}:{place}" if len(found) > 1 else str(path), mechanism)


def read(path: str | Path) -> Mechanism:
    """Return the one mechanism of a file.

    Raises
    ------
    FileError
        If the file cannot be read, or holds several mechanisms.

    Examples
    --------
    >>> read("no such file.json")
    Traceback (most recent call last):
    ...
    graphs.errors.FileError: no such file.json: no such file; expected a file
    """
    entries = list(read_all(path))
    if len(entries) != 1:
        raise FileError(path, "", f"{len(entries)} mechanisms", "one")
    return entries[0].mechanism


def read_frame(path: str | Path, frame: int | None = None) -> Sheet:
    """Return one frame of a FOLD file.

    Parameters
    ----------
    path : str or Path
    frame : int, optional
        Its number; if left out, the first that has a pattern and coordinates.

    Raises
    ------
    FileError
        If the file cannot be read or has no such frame.

    Examples
    --------
    >>> read_frame("no such file.fold", 1)
    Traceback (most recent call last):
    ...
    graphs.errors.FileError: no such file.fold: no such file; expected a file
    """
    path = Path(path)
    if path.suffix.lower() != ".fold":
        raise FileError(path, "", "has no frames", "a .fold file")
    document = load_json(path)
    if frame is not None:
        return sheet_from_fold(document, path, frame)
    first = sheet_from_fold(document, path)
    further = document.get("file_frames") or []
    for number in range(1, len(further) + 1):
        if first.coordinates is not None:
            break
        frame_here = {**document, **further[number - 1]}
        if frame_here.get("vertices_coords"):
            first = sheet_from_fold(document, path, number)
    return first


def write(mechanism: Mechanism, path: str | Path) -> tuple[str, ...]:
    """Write a mechanism in the format that the extension names.

    Parameters
    ----------
    mechanism : SCGraph, SCDGraph, PolyhedronModel, VertexEdgeGraph or Sheet
        A sheet written as ``.json`` becomes the SC graph of its mechanism.
    path : str or Path

    Returns
    -------
    tuple of str
        What the format could not hold.

    Raises
    ------
    FileError
        If the extension is not known or the file cannot be written.
    UnsolvableError
        If the format cannot hold the mechanism.
    """
    path = Path(path)
    writer = WRITERS.get(path.suffix.lower())
    if writer is None:
        raise FileError(path, "", _unknown(path), "one of " + " ".join(sorted(WRITERS)))
    text, lost = writer(mechanism)
    write_text(path, text)
    return lost


def _reader(path: Path) -> Callable[[Path], Iterator[tuple[str, Mechanism]]]:
    reader = READERS.get(path.suffix.lower())
    if reader is None and path.is_dir():
        raise FileError(path, "", "a directory", "a file")
    if reader is None and not path.exists():
        raise FileError(path, "", "no such file", "a file")
    if reader is None:
        raise FileError(path, "", _unknown(path), "one of " + " ".join(sorted(READERS)))
    return reader


def _unknown(path: Path) -> str:
    return f"files ending in {path.suffix!r} are not known" if path.suffix else "the name has no extension"


def _read_json(path: Path) -> Iterator[tuple[str, Mechanism]]:
    yield "", from_document(load_json(path), path)


def _read_fold(path: Path) -> Iterator[tuple[str, Mechanism]]:
    yield "", sheet_from_fold(load_json(path), path)


def _read_graph6(path: Path) -> Iterator[tuple[str, Mechanism]]:
    for line, graph in read_graph6(path):
        yield str(line), as_sc(graph, path, f"line {line}")


def _read_graphml(path: Path) -> Iterator[tuple[str, Mechanism]]:
    yield "", as_sc(read_graphml(path), path)


def _read_edges(path: Path) -> Iterator[tuple[str, Mechanism]]:
    yield "", as_sc(read_edge_list(path), path)


def _read_cp(path: Path) -> Iterator[tuple[str, Mechanism]]:
    from graphs.files.patterns.cp import sheet_from_cp  # tracing loads shapely

    yield "", sheet_from_cp(path)


def _read_svg(path: Path) -> Iterator[tuple[str, Mechanism]]:
    from graphs.files.patterns.svg import sheet_from_svg

    yield "", sheet_from_svg(path)


def _read_obj(path: Path) -> Iterator[tuple[str, Mechanism]]:
    yield "", sheet_from_obj(path)


READERS: dict[str, Callable[[Path], Iterator[tuple[str, Mechanism]]]] = {
    ".json": _read_json,
    ".fold": _read_fold,
    ".svg": _read_svg,
    ".cp": _read_cp,
    ".obj": _read_obj,
    ".g6": _read_graph6,
    ".s6": _read_graph6,
    ".graphml": _read_graphml,
    ".edges": _read_edges,
    ".txt": _read_edges,
}
"""Extension to the reader: path to (place in the file, mechanism)."""

_NO_LOOPS = ("loops and their centres",)


def _write_json(mechanism: Mechanism) -> tuple[str, tuple[str, ...]]:
    if isinstance(mechanism, Sheet):
        return dumps(to_sc(mechanism)), ("coordinates, and the shapes of the panels",)
    return dumps(mechanism), ()


def _write_fold(mechanism: Mechanism) -> tuple[str, tuple[str, ...]]:
    lost = () if isinstance(mechanism, Sheet) else ("names of links and joints",)
    return fold_text(to_sheet(mechanism)), lost


def _write_cp(mechanism: Mechanism) -> tuple[str, tuple[str, ...]]:
    from graphs.files.patterns.cp import cp_text

    sheet = to_sheet(mechanism)
    unknown = ("that creases are unassigned: they are written as valleys",) if "U" in sheet.assignments else ()
    return cp_text(sheet), ("which lines bound which face", *unknown)


def _write_svg(mechanism: Mechanism) -> tuple[str, tuple[str, ...]]:
    from graphs.files.patterns.svg import svg_text

    return svg_text(to_sheet(mechanism)), ("which lines bound which face",)


def _write_obj(mechanism: Mechanism) -> tuple[str, tuple[str, ...]]:
    return obj_text(to_sheet(mechanism)), ()


WRITERS: dict[str, Callable[[Mechanism], tuple[str, tuple[str, ...]]]] = {
    ".json": _write_json,
    ".fold": _write_fold,
    ".svg": _write_svg,
    ".cp": _write_cp,
    ".obj": _write_obj,
    ".g6": lambda m: (graph6_text(to_sc(m), sparse=False), (*_NO_LOOPS, "names")),
    ".s6": lambda m: (graph6_text(to_sc(m), sparse=True), (*_NO_LOOPS, "names")),
    ".graphml": lambda m: (graphml_text(to_sc(m)), _NO_LOOPS),
    ".edges": lambda m: (edge_list_text(to_sc(m)), _NO_LOOPS),
    ".txt": lambda m: (edge_list_text(to_sc(m)), _NO_LOOPS),
}
"""Extension to the writer: mechanism to text, and what the text could not hold."""
