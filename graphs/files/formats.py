"""One path from a file to a mechanism and back: formats by extension.

To add a format, write a reader or a writer and enter it in ``READERS`` or ``WRITERS`` (docs/architecture.md).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from graphs.convert.table import Mechanism, to_sc, to_sheet
from graphs.errors import FileError, OpenError, UnsolvableError, check_argument
from graphs.files.atomic import Beside
from graphs.files.bare import (
    as_linkage,
    as_sc,
    graph6_text,
    graphml_text,
    read_graph6,
    read_graphml,
)
from graphs.files.edge_lists import edge_list_text, read_edge_list
from graphs.files.ids import is_id, line_named, mechanism_of_id
from graphs.files.kept_type import change_of_type
from graphs.files.losses import (
    lost_as_bare_graph,
    lost_as_cp,
    lost_as_dxf,
    lost_as_fold,
    lost_as_json,
    lost_as_obj,
    lost_as_svg,
    lost_as_typed_graph,
)
from graphs.files.native.documents import dumps, from_document
from graphs.files.patterns.fold import fold_text, read_fold
from graphs.files.patterns.legend import UNSTATED, Legend, Told
from graphs.files.patterns.obj import obj_text, sheet_from_obj
from graphs.files.text import load_json
from graphs.joints.linkage import JointedLinkage
from graphs.mechanism.precision import flattened
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.surfaces import SurfaceLinkage

__all__ = ["READERS", "WRITERS", "Entry", "read", "read_all", "read_linkage", "write"]


@dataclass(frozen=True, slots=True)
class Entry:
    """One mechanism of a file.

    Attributes
    ----------
    label : str
        The file, and the line where it holds several.
    mechanism : SCGraph, SCDGraph, PolyhedronModel, VertexEdgeGraph or Sheet

    Examples
    --------
    >>> [entry] = read_all("k1:Cr")
    >>> entry.label, entry.mechanism.number_of_nodes()
    ('k1:Cr', 4)
    """

    label: str
    mechanism: Mechanism


def read_all(path: str | Path, *, colours: Told | None = None, layers: Told | None = None) -> Iterator[Entry]:
    """Yield every mechanism of a file; most files hold one, graph6 files one a line, an id is one.

    Parameters
    ----------
    path : str or Path
        A file of any extension of `READERS`, an id (``k1:...``, ``m1:...``), or a line of a graph6 file,
        ``chains.g6:7``.
    colours, layers : mapping of str to str or sequence of str, optional
        As in `read`.

    Yields
    ------
    Entry

    Raises
    ------
    FileError
        If the file cannot be read.
    InvariantError
        If an id is none, or a colour or an assignment.

    Examples
    --------
    Two chains in a file of graph6, with the lines they are on:

    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder, "chains.g6")
    ...     _ = path.write_text(chr(10).join(("Cr", "Bw")))
    ...     for entry in read_all(path):
    ...         print(entry.label.removeprefix(folder)[1:], len(entry.mechanism))
    chains.g6:1 4
    chains.g6:2 3
    """
    if is_id(path):
        yield Entry(str(path), mechanism_of_id(str(path)))
        return
    path, line = line_named(path)
    found = list(_reader(path, Legend.of(colours, layers))(path))
    for place, mechanism in found:
        if line in (None, place):
            yield Entry(f"{path}:{place}" if len(found) > 1 else str(path), mechanism)
    if line is not None and all(line != place for place, _ in found):
        raise FileError(path, f"line {line}", "no mechanism", f"one of {len(found)} lines")


def read(path: str | Path, *, colours: Told | None = None, layers: Told | None = None) -> Mechanism:
    """Return the one mechanism of a file, or of an id.

    Parameters
    ----------
    path : str or Path
        A file whose extension names its format, or an id, ``k1:...`` or ``m1:...`` (a file so named is written
        ``./k1:...``), or a line of a graph6 file, ``chains.g6:7``.
    colours : mapping of str to str or sequence of str, optional
        Of a drawing (SVG, DXF): assignment (M, V, B, C, F, U, J, or ``-`` for lines to leave out) to the look of
        its lines: a colour of CSS or the number of one in DXF, a kind of dash (``dashed``, ``dash-dot``,
        ``dotted``, ``solid``), or both, ``"dashed #000000"``. Other lines are read as they are by themselves.
    layers : mapping of str to str or sequence of str, optional
        Assignment to names of layers or groups; they count before colours.

    Raises
    ------
    FileError
        If the file cannot be read, or holds several mechanisms; if more than half of the lines of a drawing have
        strokes that are not understood; if colours or layers are stated of a file that is no drawing.
    InvariantError
        If a colour or an assignment is none.

    Examples
    --------
    >>> read("no such file.json")
    Traceback (most recent call last):
    ...
    graphs.errors.OpenError: no such file.json: no such file; expected a file
    """
    entries = list(read_all(path, colours=colours, layers=layers))
    if len(entries) != 1:
        named = f"one; name it by its line, {entries[0].label}" if entries else "one"
        raise FileError(path, "", f"{len(entries)} mechanisms", named)
    return entries[0].mechanism


def read_linkage(path: str | Path) -> SurfaceLinkage:
    """Return the linkage of a file of a linkage on a cone or a cylinder.

    Raise FileError if the file cannot be read, or has another mechanism, which has no angles.
    """
    linkage = read(path)
    if not isinstance(linkage, SurfaceLinkage):
        expected = "a linkage on a surface, 'synthedra/conical' or 'synthedra/cylindrical'"
        raise FileError(path, "", "a mechanism without angles", expected)
    return linkage


def write(
    mechanism: Mechanism,
    path: str | Path,
    *,
    lossy: bool = False,
    force: bool = False,
    made_of: Mechanism | None = None,
) -> tuple[str, ...]:
    """Write a mechanism in the format that the extension names.

    A file of another kind than the mechanism is read back before it is moved to its place.

    Parameters
    ----------
    mechanism : SCGraph, SCDGraph, PolyhedronModel, VertexEdgeGraph or Sheet
        A sheet written as ``.json`` becomes the SC graph of its mechanism.
    path : str or Path
    lossy : bool, optional
        Write also where the file is of another type: links, joints or centre classes do not correspond. What could
        not be read again is never written.
    force : bool, optional
        Replace a file that is there. Symbolic links and special files are never replaced.
    made_of : Mechanism, optional
        What ``mechanism`` was made of, whose type must be kept; by default itself.

    Returns
    -------
    tuple of str
        What the format could not hold, by kind and number.

    Raises
    ------
    FileError
        If the extension is not known, the file cannot be written, or is there already.
    UnsolvableError
        If the format cannot hold the mechanism, or not without another type.

    Examples
    --------
    A bare graph has no place for centres, so it is another type; ``lossy`` writes it all the same:

    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     four_bar = mechanism_of_id("m1:ab.ac.bd.cd")
    ...     write(four_bar, Path(folder, "four-bar.json")), write(four_bar, Path(folder, "bare.g6"), lossy=True)
    ((), ('1 loop and its centre',))
    """
    check_argument("write", mechanism, Mechanism)
    path = Path(path)
    suffix = path.suffix.lower()
    writer = WRITERS.get(suffix)
    if writer is None:
        raise FileError(path, "", _unknown(path), "one of " + " ".join(sorted(WRITERS)))
    text, lost = writer(mechanism)
    beside = Beside(path, force=force)
    try:
        beside.write(text.encode("utf-8"))
        if (made_of is not None and not lossy) or not _holds_all(suffix, mechanism):
            again = _read_back(beside.closed(), suffix, lost)
            if not lossy:
                _check_type(again, suffix, mechanism if made_of is None else made_of, lost)
        beside.commit()
    finally:
        beside.discard()
    return lost


def _holds_all(suffix: str, mechanism: Mechanism) -> bool:
    """Tell whether a format is the one made for such a mechanism; of a sheet, a native file is its mechanism."""
    return suffix == ".json" or (suffix == ".fold" and isinstance(mechanism, Sheet))


def _read_back(written: Path, suffix: str, lost: tuple[str, ...]) -> Mechanism:
    """Return what was written as it is read; what nobody could read is refused, however much may be lost."""
    try:
        ((_, again),) = READERS[suffix](written)
    except FileError as error:
        raise UnsolvableError(f"a {suffix} file could not be read again: {error.found}{_because(lost)}") from None
    return again


def _because(lost: tuple[str, ...]) -> str:
    return f", for it cannot hold {', '.join(lost)}" if lost else ""


def _check_type(again: Mechanism, suffix: str, mechanism: Mechanism, lost: tuple[str, ...]) -> None:
    """Refuse what is read back as another type."""
    change = change_of_type(mechanism, again)
    if change is not None:
        raise UnsolvableError(
            f"a {suffix} file would be of another type: {change}{_because(lost)}; write it all the same with "
            "--lossy (in Python lossy=True)"
        )


def _reader(path: Path, legend: Legend) -> Callable[[Path], Iterator[tuple[str, Mechanism]]]:
    suffix = path.suffix.lower()
    reader = READERS.get(suffix)
    if reader is not None and legend != UNSTATED:
        if suffix not in _DRAWINGS:
            raise FileError(path, "", "colours or layers are stated, and it has none", "an .svg or .dxf file")
        return partial(_DRAWINGS[suffix], legend=legend)
    if reader is None and path.is_dir():
        raise OpenError(path, "", "a directory", "a file")
    if reader is None and not path.exists():
        raise OpenError(path, "", "no such file", "a file")
    if reader is None:
        raise FileError(path, "", _unknown(path), "one of " + " ".join(sorted(READERS)))
    return reader


def _unknown(path: Path) -> str:
    return f"files ending in {path.suffix!r} are not known" if path.suffix else "the name has no extension"


def _read_json(path: Path) -> Iterator[tuple[str, Mechanism]]:
    yield "", from_document(load_json(path), path)


def _read_fold(path: Path) -> Iterator[tuple[str, Mechanism]]:
    yield "", read_fold(path)


def _read_graph6(path: Path) -> Iterator[tuple[str, Mechanism]]:
    for line, graph in read_graph6(path):
        yield str(line), as_sc(graph, path, f"line {line}")


def _read_graphml(path: Path) -> Iterator[tuple[str, Mechanism]]:
    yield "", as_linkage(read_graphml(path), path)


def _read_edges(path: Path) -> Iterator[tuple[str, Mechanism]]:
    yield "", as_sc(read_edge_list(path), path)


def _read_cp(path: Path) -> Iterator[tuple[str, Mechanism]]:
    from graphs.files.patterns.cp import sheet_from_cp  # tracing loads shapely

    yield "", sheet_from_cp(path)


def _read_opx(path: Path) -> Iterator[tuple[str, Mechanism]]:
    from graphs.files.patterns.opx import sheet_from_opx

    yield "", sheet_from_opx(path)


def _read_dxf(path: Path, legend: Legend = UNSTATED) -> Iterator[tuple[str, Mechanism]]:
    from graphs.files.patterns.dxf.sheets import sheet_from_dxf

    yield "", sheet_from_dxf(path, legend)


def _read_svg(path: Path, legend: Legend = UNSTATED) -> Iterator[tuple[str, Mechanism]]:
    from graphs.files.patterns.svg import sheet_from_svg

    yield "", sheet_from_svg(path, legend)


def _read_obj(path: Path) -> Iterator[tuple[str, Mechanism]]:
    yield "", sheet_from_obj(path)


READERS: dict[str, Callable[[Path], Iterator[tuple[str, Mechanism]]]] = {
    ".json": _read_json,
    ".fold": _read_fold,
    ".svg": _read_svg,
    ".cp": _read_cp,
    ".opx": _read_opx,
    ".dxf": _read_dxf,
    ".obj": _read_obj,
    ".g6": _read_graph6,
    ".s6": _read_graph6,
    ".graphml": _read_graphml,
    ".edges": _read_edges,
    ".csv": _read_edges,
    ".txt": _read_edges,
}
"""Extension to the reader: path to (place in the file, mechanism)."""

_DRAWINGS: dict[str, Callable[..., Iterator[tuple[str, Mechanism]]]] = {".svg": _read_svg, ".dxf": _read_dxf}
"""Readers that take a legend too: what lines are is told by how they look."""


def _write_json(mechanism: Mechanism) -> tuple[str, tuple[str, ...]]:
    held = to_sc(mechanism) if isinstance(mechanism, Sheet) else mechanism
    return dumps(held), lost_as_json(mechanism)


def _write_fold(mechanism: Mechanism) -> tuple[str, tuple[str, ...]]:
    return fold_text(to_sheet(mechanism)), lost_as_fold(mechanism)


def _write_cp(mechanism: Mechanism) -> tuple[str, tuple[str, ...]]:
    from graphs.files.patterns.cp import cp_text

    sheet = to_sheet(mechanism)
    return cp_text(sheet), (*lost_as_cp(mechanism, sheet), *_how_it_stood(sheet))


def _write_dxf(mechanism: Mechanism) -> tuple[str, tuple[str, ...]]:
    from graphs.files.patterns.dxf.sheets import dxf_text

    sheet = to_sheet(mechanism)
    return dxf_text(sheet), (*lost_as_dxf(mechanism, sheet), *_how_it_stood(sheet))


def _write_svg(mechanism: Mechanism) -> tuple[str, tuple[str, ...]]:
    from graphs.files.patterns.svg import svg_text

    sheet = to_sheet(mechanism)
    return svg_text(sheet), (*lost_as_svg(mechanism, sheet), *_how_it_stood(sheet))


def _how_it_stood(sheet: Sheet) -> tuple[str, ...]:
    """Say how a flat sheet stood in space, where it had to be turned to be drawn."""
    flat = flattened(sheet)
    return (f"how it stood in space: {flat.turned}",) if flat is not None and flat.turned else ()


def _write_obj(mechanism: Mechanism) -> tuple[str, tuple[str, ...]]:
    sheet = to_sheet(mechanism)
    return obj_text(sheet), lost_as_obj(mechanism, sheet)


def _write_graphml(mechanism: Mechanism) -> tuple[str, tuple[str, ...]]:
    if isinstance(mechanism, JointedLinkage):
        return graphml_text(mechanism.chain, mechanism.kinds), lost_as_typed_graph(mechanism)
    return graphml_text(to_sc(mechanism)), lost_as_bare_graph(mechanism, names=True)


WRITERS: dict[str, Callable[[Mechanism], tuple[str, tuple[str, ...]]]] = {
    ".json": _write_json,
    ".fold": _write_fold,
    ".svg": _write_svg,
    ".cp": _write_cp,
    ".dxf": _write_dxf,
    ".obj": _write_obj,
    ".g6": lambda m: (graph6_text(to_sc(m), sparse=False), lost_as_bare_graph(m, names=False)),
    ".s6": lambda m: (graph6_text(to_sc(m), sparse=True), lost_as_bare_graph(m, names=False)),
    ".graphml": _write_graphml,
    ".edges": lambda m: (edge_list_text(to_sc(m)), lost_as_bare_graph(m, names=True)),
    ".txt": lambda m: (edge_list_text(to_sc(m)), lost_as_bare_graph(m, names=True)),
}
"""Extension to the writer: mechanism to text, and what the text could not hold."""
