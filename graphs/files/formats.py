"""One path from a file to a mechanism and back: formats by extension, ids, lines of files of many.

To add a format, enter a reader in ``READERS``, or a `Format` in ``WRITERS`` (docs/architecture.md).
"""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any, TypeAlias, TypeVar, overload

import networkx as nx

from graphs.convert.conversions import Mechanism, mechanism_of_graph, to_sc, to_sheet
from graphs.convert.link_joint import sc_from_link_joint_graph
from graphs.errors import (
    ArgumentError,
    FileError,
    InvariantError,
    OpenError,
    UnsolvableError,
    check_argument,
    numbered,
    shown,
)
from graphs.files import losses
from graphs.files.atomic import Beside
from graphs.files.bare import (
    as_linkage,
    as_sc,
    edge_list_text,
    graph6_text,
    graphml_text,
    read_edge_list,
    read_gml,
    read_graph6,
    read_graphml,
)
from graphs.files.native import dumps, from_document
from graphs.files.outputs import Format, Lost, format_of, formats_by_suffix, unknown_extension
from graphs.files.patterns.fold import fold_text, read_fold
from graphs.files.patterns.legend import UNSTATED, Legend, Looks
from graphs.files.patterns.obj import obj_text, sheet_from_obj
from graphs.files.text import load_json
from graphs.identity.chains import chain_from_id
from graphs.identity.drawings import mechanism_from_map_id
from graphs.joints.linkage import JointedLinkage
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.mechanism.surfaces import SurfaceLinkage
from graphs.mechanism.vertex_edge import VertexEdgeGraph

_IDS = ("k1:", "m1:")


def is_id(path: str | Path) -> bool:
    """Say whether the name of a file is the id of a mechanism."""
    return str(path).startswith(_IDS) and not isinstance(path, Path)


def mechanism_of_id(code: str) -> SCGraph:
    """Return the mechanism of an id; a chain gets finite centres, as a bare link-joint graph does.

    Raise FileError if it is not an id.
    """
    try:
        if code.startswith("k1:"):
            return sc_from_link_joint_graph(chain_from_id(code))
        return mechanism_from_map_id(code)
    except InvariantError as error:
        raise FileError(code, "", error.offender, error.expected) from None


_LINE = re.compile(r"(.+\.[gs]6):([1-9][0-9]{0,17})", re.IGNORECASE | re.DOTALL)


def line_named(path: str | Path) -> tuple[Path, str | None]:
    """Return the file of a line of a graph6 file, ``chains.g6:7``, and the line; None for a whole file.

    An existing file with the whole name takes precedence.
    """
    parts = _LINE.fullmatch(str(path))
    if parts is None or Path(path).exists():
        return Path(path), None
    return Path(parts[1]), parts[2]


Reader: TypeAlias = Callable[[Path], Iterator[tuple[str, Mechanism]]]


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


def read_all(path: str | Path, *, colours: Looks | None = None, layers: Looks | None = None) -> Iterator[Entry]:
    """Yield every mechanism of a file: one of most files, one per line of a graph6 file, or that of an id.

    Parameters
    ----------
    path : str or Path
        A file of any extension of `READERS`, an id (``k1:...``, ``m1:...``), or a line of a graph6 file,
        ``chains.g6:7``.
    colours, layers : mapping of str to str or sequence of str, optional
        As in `read`.

    Raises
    ------
    FileError
        If the file cannot be read.
    InvariantError
        If an id, a colour or an assignment is not valid.

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
    mechanisms = list(_reader(path, Legend.of(colours, layers))(path))
    for place, mechanism in mechanisms:
        if line in (None, place):
            yield Entry(f"{path}:{place}" if len(mechanisms) > 1 else str(path), mechanism)
    if line is not None and all(line != place for place, _ in mechanisms):
        raise FileError(path, f"line {line}", "no mechanism", f"one of {numbered(len(mechanisms), 'line')}")


_Kind = TypeVar(
    "_Kind", SCGraph, SCDGraph, PolyhedronModel, VertexEdgeGraph, Sheet, HingedSolids, SurfaceLinkage, JointedLinkage
)


@overload
def read(
    path: str | Path | nx.Graph, *, colours: Looks | None = None, layers: Looks | None = None, kind: None = None
) -> Mechanism: ...


@overload
def read(
    path: str | Path | nx.Graph, *, colours: Looks | None = None, layers: Looks | None = None, kind: type[_Kind]
) -> _Kind: ...


def read(
    path: str | Path | nx.Graph,
    *,
    colours: Looks | None = None,
    layers: Looks | None = None,
    kind: type[Any] | None = None,
) -> Mechanism:
    """Return the one mechanism of a file, of an id, or of a graph of networkx.

    Parameters
    ----------
    path : str, Path or networkx.Graph
        A file whose extension names its format, or an id, ``k1:...`` or ``m1:...`` (a file so named is written
        ``./k1:...``), or a line of a graph6 file, ``chains.g6:7``. A graph has links as nodes and joints as edges;
        of a multigraph the keys name the joints. What networkx made of a mechanism is read by its attributes; any
        other graph gets finite centres, as from a file without any.
    colours : mapping of str to str or sequence of str, optional
        For a drawing (SVG, DXF): assignment (M, V, B, C, F, U, J, or ``-`` for lines to leave out) to the look of
        its lines: a colour of CSS or the number of one in DXF, a kind of dash (``dashed``, ``dash-dot``,
        ``dotted``, ``solid``), or both, ``"dashed #000000"``. Other lines are read as they are by themselves.
    layers : mapping of str to str or sequence of str, optional
        Assignment to names of layers or groups; they count before colours.
    kind : class, optional
        The kind that the mechanism must have, such as `Sheet` or `SCGraph`, which type checkers know it to be then.

    Raises
    ------
    FileError
        If the file cannot be read, holds several mechanisms, or one of another kind; if more than
        half of the lines of a drawing have strokes that are not understood; if colours or layers are stated for a
        file that is no drawing.
    InvariantError
        If a colour or an assignment is not valid.
    ArgumentError
        If the kind is not a class.

    Examples
    --------
    >>> read("no such file.json")
    Traceback (most recent call last):
    ...
    graphs.errors.OpenError: no such file.json: no such file; expected a file
    """
    if kind is not None and not isinstance(kind, type):
        raise ArgumentError(f"read: the kind {shown(kind)}; expected a class of mechanisms, such as synth.Sheet")
    mechanism = _read_one(path, colours, layers)
    if kind is not None and not isinstance(mechanism, kind):
        raise FileError(str(path), "", f"a mechanism of the kind {type(mechanism).__name__}", kind.__name__)
    return mechanism


def _read_one(path: str | Path | nx.Graph, colours: Looks | None, layers: Looks | None) -> Mechanism:
    """Return the one mechanism of a file, an id or a graph, of whatever kind."""
    if isinstance(path, nx.Graph):
        return mechanism_of_graph(path)
    entries = list(read_all(path, colours=colours, layers=layers))
    if len(entries) != 1:
        expected = f"one; try its line, {entries[0].label}" if entries else "one"
        raise FileError(path, "", f"{len(entries)} mechanisms", expected)
    return entries[0].mechanism


def read_linkage(path: str | Path) -> SurfaceLinkage:
    """Return the linkage of a file of a linkage on a cone or a cylinder.

    Raise FileError if the file cannot be read, or has another mechanism.
    """
    linkage = read(path)
    if not isinstance(linkage, SurfaceLinkage):
        expected = "a linkage on a surface, 'synthedra/conical' or 'synthedra/cylindrical'"
        raise FileError(path, "", "a mechanism without angles", expected)
    return linkage


def write(
    mechanism: Mechanism | nx.Graph | str | Path, path: str | Path, *, lossy: bool = False, force: bool = False
) -> tuple[str, ...]:
    """Write a mechanism in the format that the extension names.

    A file of another kind than the mechanism is read back before it is moved to its place.

    Parameters
    ----------
    mechanism : Mechanism, networkx.Graph, str or Path
        A sheet written as ``.json`` becomes the SC graph of its mechanism.
    path : str or Path
    lossy : bool, optional
        Write even if the file reads back as another type: links, joints or centre classes do not correspond.
        A file that could not be read again is never written.
    force : bool, optional
        Replace an existing file, but never a symbolic link or special file.

    Returns
    -------
    tuple of str
        What the format cannot hold, by kind and number.

    Raises
    ------
    FileError
        If the extension is not known, the file cannot be written, or exists already.
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
    mechanism = read(mechanism) if isinstance(mechanism, str | Path | nx.Graph) else mechanism
    check_argument("write", mechanism, Mechanism)
    return write_converted(mechanism, path, None, lossy=lossy, force=force)


def write_converted(
    mechanism: Mechanism, path: str | Path, made_of: Mechanism | None, *, lossy: bool = False, force: bool = False
) -> tuple[str, ...]:
    """Write a mechanism that was made of another, if any, whose type must then be kept too; else as `write`."""
    path = Path(path)
    written = format_of(path, WRITERS, _ELSEWHERE)
    data, lost = written.to_bytes(mechanism), written.lost(mechanism)
    beside = Beside(path, force=force)
    try:
        beside.write(data)
        # the format made for a mechanism holds it all; the native file of a sheet is its mechanism
        made_for = written.suffix == ".json" or (written.suffix == ".fold" and isinstance(mechanism, Sheet))
        if (made_of is not None and not lossy) or not made_for:
            again = _read_back(beside.closed(), written.suffix, lost)
            change = None if lossy else losses.change_of_type(mechanism if made_of is None else made_of, again)
            if change is not None:
                wrong = f"a {written.suffix} file would be read back as another type: {change}{_because(lost)}"
                raise UnsolvableError(f"{wrong}; try --lossy (in Python lossy=True)")
        beside.commit()
    finally:
        beside.discard()
    return lost


def _read_back(written: Path, suffix: str, lost: tuple[str, ...]) -> Mechanism:
    """Return the mechanism of a written file; refuse one that cannot be read, however much may be lost."""
    try:
        ((_, again),) = READERS[suffix](written)
    except FileError as error:
        raise UnsolvableError(f"a {suffix} file could not be read again: {error.found}{_because(lost)}") from None
    return again


def _because(lost: tuple[str, ...]) -> str:
    return f"; it cannot hold {', '.join(lost)}" if lost else ""


def _reader(path: Path, legend: Legend) -> Reader:
    suffix = path.suffix.lower()
    reader = READERS.get(suffix)
    if reader is not None and legend != UNSTATED:
        if suffix not in _DRAWINGS:
            raise FileError(path, "", "the file has no colours or layers", "an .svg or .dxf file")
        return _with_legend(suffix, legend)
    if reader is None and path.is_dir():
        raise OpenError(path, "", "a directory", "a file")
    if reader is None and not path.exists():
        raise OpenError(path, "", "no such file", "a file")
    if reader is None:
        raise unknown_extension(path, sorted(READERS))
    return reader


def _of(file: str, name: str) -> Callable[..., Any]:
    """Return a function of a file of `graphs.files`, imported when it is called: most files are of other formats."""

    def function(*arguments: object) -> Any:
        return getattr(import_module(f"graphs.files.{file}"), name)(*arguments)

    return function


def _read_graph6(path: Path) -> Iterator[tuple[str, Mechanism]]:
    for line, graph in read_graph6(path):
        yield str(line), as_sc(graph, path, f"line {line}")


def _one_of(read_one: Callable[[Path], Mechanism]) -> Reader:
    """Return the reader of files that hold one mechanism."""
    return lambda path: iter([("", read_one(path))])


def _with_legend(suffix: str, legend: Legend) -> Reader:
    return _one_of(lambda path: _DRAWINGS[suffix](path, legend))


_DRAWINGS: dict[str, Callable[[Path, Legend], Mechanism]] = {
    ".svg": _of("patterns.svg", "sheet_from_svg"),
    ".dxf": _of("patterns.dxf", "sheet_from_dxf"),
}
"""Readers that take a legend too: the look of a line says what it is."""

READERS: dict[str, Reader] = {
    ".json": _one_of(lambda path: from_document(load_json(path), path)),
    ".fold": _one_of(read_fold),
    **{suffix: _with_legend(suffix, UNSTATED) for suffix in _DRAWINGS},
    ".cp": _one_of(_of("patterns.lines", "sheet_from_cp")),
    ".opx": _one_of(_of("patterns.lines", "sheet_from_opx")),
    ".obj": _one_of(sheet_from_obj),
    ".g6": _read_graph6,
    ".s6": _read_graph6,
    ".xml": _one_of(_of("robots.mjcf", "read_mjcf")),
    ".urdf": _one_of(_of("robots.urdf", "read_urdf")),
    ".sdf": _one_of(_of("robots.sdf", "read_sdf")),
    ".graphml": _one_of(lambda path: as_linkage(read_graphml(path), path)),
    ".gml": _one_of(lambda path: as_linkage(read_gml(path), path)),
    **dict.fromkeys((".edges", ".edgelist", ".csv", ".txt"), _one_of(lambda path: as_sc(read_edge_list(path), path))),
}
"""Extension to the reader: path to (place in the file, mechanism)."""


def _json_text(mechanism: Mechanism) -> str:
    return dumps(to_sc(mechanism) if isinstance(mechanism, Sheet) else mechanism)


def _graphml_text(mechanism: Mechanism) -> str:
    if isinstance(mechanism, JointedLinkage):
        return graphml_text(mechanism.chain, mechanism.kinds)
    return graphml_text(to_sc(mechanism))


def _of_sheet(text_of: Callable[[Sheet], str]) -> Callable[[Mechanism], str]:
    return lambda mechanism: text_of(to_sheet(mechanism))


def _text_format(
    suffix: str, name: str, text_of: Callable[[Mechanism], str], lost: Callable[[Mechanism], Lost]
) -> Format[Mechanism]:
    return Format(suffix, name, lambda mechanism: text_of(mechanism).encode("utf-8"), lost)


WRITERS = formats_by_suffix(
    _text_format(".cp", "crease pattern", _of_sheet(_of("patterns.lines", "cp_text")), losses.lost_as_cp),
    _text_format(".dxf", "crease pattern, DXF R12", _of_sheet(_of("patterns.dxf", "dxf_text")), losses.lost_as_dxf),
    _text_format(".edges", "list of edges", lambda m: edge_list_text(to_sc(m)), losses.lost_as_bare_graph),
    _text_format(".fold", "crease pattern, FOLD", _of_sheet(fold_text), losses.lost_as_fold),
    _text_format(".g6", "graph6", lambda m: graph6_text(to_sc(m), sparse=False), losses.lost_as_nameless_graph),
    _text_format(".graphml", "GraphML", _graphml_text, losses.lost_as_graphml),
    _text_format(".json", "native", _json_text, losses.lost_as_json),
    _text_format(".obj", "surface, OBJ", _of_sheet(obj_text), losses.lost_as_obj),
    _text_format(".s6", "sparse6", lambda m: graph6_text(to_sc(m), sparse=True), losses.lost_as_nameless_graph),
    _text_format(".svg", "crease pattern, SVG", _of_sheet(_of("patterns.svg", "svg_text")), losses.lost_as_svg),
    _text_format(".txt", "list of edges", lambda m: edge_list_text(to_sc(m)), losses.lost_as_bare_graph),
)
"""Suffix to the format in which mechanisms are written."""
_ELSEWHERE = (
    "; with panels .stl .3mf .gltf (synth convert), with a motion .csv (synth convert --table), "
    "for simulators and CAD .xml .urdf .sdf .usda .step (synth convert --as)"
)
"""Suffixes that commands write by another table: `synth.exporters.EXPORTERS`."""
