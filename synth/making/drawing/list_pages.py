"""Catalogues: every mechanism of a store, a list or a folder, numbered, on pages.

Rows of an enumeration (a store, JSON lines, Parquet), graph6 files and folders are read one by one; pages are
written as a PDF, or one picture per page.
"""

import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, count, islice
from pathlib import Path
from textwrap import wrap
from typing import Any, TypeAlias

from enumerate.chains.names import name_of
from enumerate.runner.job import Limits, row_as_dict
from enumerate.runner.store import read_meta, read_rows
from enumerate.strings.panel_strings import ChainString
from graphs.errors import FileError, InvariantError, SynthedraError, numbered, shown
from graphs.files.formats import is_id, mechanism_of_id, read_all
from graphs.files.outputs import check_installed, check_writable, write_as
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from synth.exporters import EXPORTERS
from synth.linkages.conformed.orders import Row, order_of_row
from synth.linkages.conformed.rates import loops_of_chain
from synth.making.drawing.mechanisms.pictures import draw
from synth.making.drawing.scene.shapes import LARGE, Label, Layer, Point, moved, text_width
from synth.making.drawing.scene.writing import Pages, Scene

Realise: TypeAlias = Callable[[SCGraph], tuple[Sheet | None, str]]
"""From an SC or SCD graph to its sheet, if there is one, and what there is to say of it: why there is none."""

_STORES = (".sqlite", ".db")
_ROW_FILES = (*_STORES, ".jsonl", ".parquet")
"""Extensions of files that hold rows."""
_AT_ONCE = 1024
"""Rows of a Parquet file that are in memory."""
_CATALOGUES = (*_ROW_FILES, ".g6")
_IDS = ("code", "mechanism", "chain")
"""Columns that may hold an id, the most informative first."""
_WIDE, _HIGH = 595.0, 842.0
"""A4, points."""
_EDGE, _HEAD = 30.0, 26.0
_COLUMNS, _WITH_SHEETS, _ROWS = 4, 3, 6
"""Columns of a page, fewer where sheets stand beside graphs, and rows."""
_LETTERS = 5.0
_LINES, _MOST_LINES = 4, 9
"""Lines of text below a picture (number, id, properties): at least, and at most where a caption is long."""
_AIR = 6.0


def _rows_of_file(place: Path) -> Iterator[Row]:
    """Yield the rows of a file with an extension of `_ROW_FILES`, in order; none is kept in memory.

    Raise FileError if the file cannot be read, UnsolvableError if it is Parquet and pyarrow is not installed.
    """
    suffix = place.suffix.lower()
    if suffix in _STORES:
        columns = read_meta(place)["columns"]
        return (row_as_dict(columns, row) for row in read_rows(place))
    return _rows_of_parquet(place) if suffix == ".parquet" else _rows_of_lines(place)


def _rows_of_lines(place: Path) -> Iterator[Row]:
    try:
        with place.open(encoding="utf-8") as lines:
            for number, line in enumerate(lines, start=1):
                row = json.loads(line)
                if not isinstance(row, dict):
                    raise FileError(place, f"line {number}", f"{shown(row)} is not an object", "one object per line")
                yield row
    except OSError as error:
        raise FileError(place, "", f"cannot be read: {error.strerror}", "a readable file") from None
    except (ValueError, RecursionError) as error:
        raise FileError(place, "", f"is not JSON: {error}", "one object per line") from None


def _rows_of_parquet(place: Path) -> Iterator[Row]:
    check_installed("pyarrow", "Parquet")
    from pyarrow import ArrowException
    from pyarrow.parquet import ParquetFile

    try:
        with place.open("rb") as stream, ParquetFile(stream) as file:
            for batch in file.iter_batches(_AT_ONCE):
                yield from batch.to_pylist()
    except ArrowException as error:
        raise FileError(place, "", f"is not Parquet: {error}", "rows that an enumeration wrote") from None
    except OSError as error:
        raise FileError(place, "", f"cannot be read: {error.strerror}", "a readable file") from None


def drawable_of_type(kind: str, code: str) -> Any:
    """Return the mechanism of a type of an atlas, or its order of joints, by its kind and its id there.

    Raise InvariantError if there can be no such type.

    >>> drawable_of_type("sc", "m1:ab.ac.bd.cd")
    <SCGraph: 4 links, 4 joints, 1 centre>
    >>> drawable_of_type("order", "k1:Cr:0-2-1-3").names
    ['0', '1', '2', '3']
    """
    if not (isinstance(kind, str) and isinstance(code, str)):
        raise InvariantError("type", f"kind {shown(kind)}, id {shown(code)}", "texts")
    if kind == "string":
        return ChainString.parse(code)
    chain_code, _, joints = code.rpartition(":") if kind == "order" else (code, "", "")
    if not is_id(chain_code):
        raise InvariantError("type", f"{shown(code)} is not an id", "k1:... or m1:...")
    mechanism = mechanism_of_id(chain_code)
    if kind != "order":
        return mechanism
    order = joints.split("-")
    if sorted(order) != sorted(map(str, range(len(mechanism.joints)))):
        raise InvariantError("type", f"{shown(code)} is not an order of the joints of its chain", "each joint once")
    loops = [list(map(str, loop)) for loop in loops_of_chain(mechanism)]
    slots = [order.index(str(joint)) for joint in range(len(order))]
    row = {"order": order, "slots": slots, "loops": loops, "most_layers": None}  # as of a conical candidate
    return order_of_row(row, mechanism)


@dataclass(frozen=True, slots=True)
class CatalogueEntry:
    """One mechanism of a catalogue, by its number among all, from 1: those that a filter leaves out are counted.

    The mechanism is an SC graph, or whatever else can be drawn; `name` is its id or its origin, `said` its
    degrees of freedom, centres and symmetry, where known; `mode` is that of an R/- string that is listed by its
    modes.
    """

    number: int
    mechanism: Any
    name: str
    said: str
    mode: str | None = None


def is_catalogue(path: str | Path) -> bool:
    """Check whether a path names many mechanisms: a store, a list or a folder."""
    return not is_id(path) and (Path(path).suffix.lower() in _CATALOGUES or Path(path).is_dir())


def catalogue_entries(
    path: str | Path, where: Mapping[str, Limits | str] | None = None, failures: list[str] | None = None
) -> Iterator[CatalogueEntry]:
    """Yield the mechanisms of rows (.sqlite, .jsonl, .parquet), of a graph6 file or of a folder, in order.

    `where` selects rows: it maps columns to limits of numbers, or to text. Errors of files of a folder are added
    to `failures`; without it, they are raised. Raise FileError if the file cannot be read, or a row has no
    mechanism; InvariantError if there is no such column.
    """
    place = Path(path)
    if place.suffix.lower() in _ROW_FILES and not place.is_dir():
        for number, row in enumerate(_rows_of_file(place), start=1):
            if all(_admits(row, column, condition) for column, condition in (where or {}).items()):
                yield _entry_of_row(place, number, row)
        return
    if where:
        raise InvariantError("filter", f"{shown(str(path))} has no columns", f"rows: {', '.join(_ROW_FILES)}")
    files = sorted(file for file in place.iterdir() if file.is_file()) if place.is_dir() else [place]
    number = 0
    for file in files:
        try:
            for entry in read_all(file):
                number += 1
                yield CatalogueEntry(number, entry.mechanism, Path(entry.label).name, repr(entry.mechanism)[1:-1])
        except SynthedraError as error:
            if failures is None or not place.is_dir():
                raise
            failures.append(str(error))


def entry_numbered(path: str | Path, number: int) -> CatalogueEntry:
    """Return one mechanism of a catalogue by its number among all, from 1.

    Raise FileError if the file cannot be read, or holds fewer.
    """
    entry = None
    for entry in catalogue_entries(path):
        if entry.number == number:
            return entry
    largest = "none" if entry is None else str(entry.number)
    raise FileError(path, "", f"there is no mechanism {number}", f"a number up to {largest}")


def _admits(row: Row, column: str, condition: Limits | str) -> bool:
    if column not in row:
        raise InvariantError("filter", f"there is no column {shown(column)}", ", ".join(map(str, row)))
    value = row[column]
    if isinstance(condition, Limits):
        return isinstance(value, int) and value in condition
    text = ",".join(map(str, value)) if isinstance(value, list) else str(value)
    return text == condition


def _entry_of_row(place: Path, number: int, row: Row) -> CatalogueEntry:
    if isinstance(row.get("string"), str):
        mode = row["mode"] if isinstance(row.get("mode"), str) else None
        name = f"{row['string']} {mode}" if mode else row["string"]
        return CatalogueEntry(number, ChainString.parse(row["string"]), name, _said(row), mode)
    if "id" in row and "kind" in row:  # of an atlas
        name = row.get("name")
        said = ", ".join(filter(None, [name if isinstance(name, str) else "", _said(row)]))
        return CatalogueEntry(number, drawable_of_type(row["kind"], row["id"]), row["id"], said)
    for column in _IDS:
        code = row.get(column)
        if isinstance(code, str) and is_id(code):
            name = row.get("name") or name_of(str(row.get("chain", code)))
            said = f"{name}, {_said(row)}" if name else _said(row)
            mechanism: Any = mechanism_of_id(code)
            if "order" in row:
                try:
                    mechanism = order_of_row(row, mechanism)
                except (KeyError, TypeError, ValueError) as error:
                    problem = f"the order of the joints is invalid: {type(error).__name__} {error}"
                    columns = "columns order, loops, and slots or azimuths_deg"
                    raise FileError(place, f"row {number}", problem, columns) from None
            return CatalogueEntry(number, mechanism, code, said)
    raise FileError(
        place, f"row {number}", "has no id", f"an id in one of the columns {', '.join(_IDS)}, or id and kind"
    )


def _said(row: Row) -> str:
    """Return the degrees of freedom, centres, symmetry of a row, and what tells it from others, where it has them."""
    words = []
    if isinstance(row.get("order"), list):  # of the joints round a cone
        words.append("order " + " ".join(map(str, row["order"])))
    freedoms = row.get("exact_dof", row.get("dof"))
    if freedoms is not None:
        words.append(f"M = {freedoms}")
    if "centres" in row:
        words.append(numbered(row["centres"], "centre"))
    if "symmetry" in row:
        words.append(f"symmetry {row['symmetry']}")
    if row.get("joints") and isinstance(row["joints"], str):
        words.append(row["joints"])
    if isinstance(row.get("sides"), list | tuple):
        counts = [(count, sides) for sides, count in enumerate(row["sides"], start=3) if count]
        words += [f"{numbered(n, 'link') if i == 0 else n} of {sides} sides" for i, (n, sides) in enumerate(counts)]
    words += [said.format(_listed_numbers(row[column])) for column, said in _DIFFERING.items() if row.get(column)]
    return ", ".join(words)


_DIFFERING = {
    "assortment": "assortment {}",
    "loop_sizes": "loops {}",
    "open_edges": "{} open edges",
    "implicit": "{} implicit",
    "inversions": "{} inversions",
}
"""Columns in which types of one kind, size and mobility differ, and how a caption says them."""


def _listed_numbers(value: Any) -> str:
    return " + ".join(map(str, value)) if isinstance(value, list | tuple) else str(value)


def catalogue_pages(
    entries: Iterable[CatalogueEntry], title: str = "", kind: str | None = None, *, realise: Realise | None = None
) -> Iterator[Scene]:
    """Yield pages of 24 pictures, with a title above each; an entry is released when its page is made.

    `kind` is as for `synth.draw`. With `realise` (`synth.catalogue.realisation.sheet_of_type`), the graph of an SC or
    SCD type has its sheet beside it, or below it the reason why there is none; there are 18 then on a page.
    """
    rest = iter(entries)
    first = next(rest, None)
    if first is None:
        return
    rest = chain([first], rest)
    sheets = realise is not None and kind in (None, "graph") and _is_type(first.mechanism)
    columns = _WITH_SHEETS if sheets else _COLUMNS
    for number in count(1):
        on_page = list(islice(rest, columns * _ROWS))
        if not on_page:
            return
        layers: list[Layer] = []
        head = [Label((_EDGE, _EDGE), title, LARGE, anchor="start", bold=True, halo=False, widest=90)]
        head.append(Label((_WIDE - _EDGE - 40, _EDGE), f"page {number}", 7.0, "grey", "start", halo=False))
        texts: list[Label] = []
        realised = [
            _NO_SHEET if realise is None or not sheets or not _is_type(entry.mechanism) else realise(entry.mechanism)
            for entry in on_page
        ]
        across = _Cell(0, columns, _LINES).letters
        captions = [_caption(entry, said, across) for entry, (_, said) in zip(on_page, realised, strict=True)]
        lines = min(max(_LINES, *map(len, captions)), _MOST_LINES)
        for place, (entry, (sheet, _), caption) in enumerate(zip(on_page, realised, captions, strict=True)):
            picture, words = _in_cell(entry, sheet, caption[:lines], _Cell(place, columns, lines), kind)
            layers += picture
            texts += words
        rows = _ROWS if number > 1 else -(-len(on_page) // columns)  # one page is as high as its rows
        high = _HIGH - (_ROWS - rows) * _Cell(0, columns, lines).size[1]
        yield Scene(_WIDE, high, (*layers, Layer("text", (*head, *texts))), title)


def _is_type(mechanism: Any) -> bool:
    """Check for an SC or SCD graph whose centres are its own: panels can be drawn of it."""
    return isinstance(mechanism, SCGraph) and not getattr(mechanism, "centres_assumed", False)


_NO_SHEET: tuple[Sheet | None, str] = (None, "")


def _caption(entry: CatalogueEntry, more: str, across: int) -> list[str]:
    """Return the lines below a picture, of so many letters: number, name, properties, what there is to say more."""
    said = ", ".join(filter(None, [entry.said, more]))
    return [str(entry.number), *wrap(entry.name, across), *wrap(said, across)]


@dataclass(frozen=True, slots=True)
class _Cell:
    """A cell of a page by its number, from 0, with so many lines of text below the picture; sizes are in points."""

    number: int
    columns: int
    lines: int

    @property
    def size(self) -> Point:
        """Width and height."""
        return (_WIDE - 2 * _EDGE) / self.columns, (_HIGH - 2 * _EDGE - _HEAD) / _ROWS

    @property
    def corner(self) -> Point:
        """The left upper corner."""
        row, column = divmod(self.number, self.columns)
        return _EDGE + column * self.size[0], _EDGE + _HEAD + row * self.size[1]

    @property
    def box(self) -> Point:
        """Width and height for pictures."""
        return self.size[0] - _AIR, self.size[1] - self.lines * 1.4 * _LETTERS - _AIR

    @property
    def letters(self) -> int:
        """Number of letters on a line."""
        return int(self.box[0] / text_width("0", _LETTERS))


def _in_cell(
    entry: CatalogueEntry, beside: Sheet | None, caption: Sequence[str], cell: _Cell, kind: str | None
) -> tuple[list[Layer], list[Label]]:
    """Return the pictures of an entry in its cell of the page, and the text below."""
    (left, top), (wide, high) = cell.corner, cell.box
    across = wide if beside is None else (wide - _AIR) / 2
    scenes = [draw(entry.mechanism, kind, box=(across, high), caption=None)]
    if beside is not None:
        scenes.append(draw(beside, numbers=False, box=(across, high), caption=None))
    picture = []
    for number, scene in enumerate(scenes):
        right = left + number * (across + _AIR) + (across + _AIR - scene.width) / 2
        down = top + (high - scene.height) / 2
        picture += [moved(layer, right, down) for layer in scene.layers if layer.shapes]
    first = top + high + _AIR
    labels = []
    for i, text in enumerate(caption):
        at, colour = (left + _AIR, first + i * 1.35 * _LETTERS), "grey" if i else "ink"
        labels.append(Label(at, text, _LETTERS, colour, "start", bold=i == 0, halo=False, widest=cell.letters))
    return picture, labels


def write_catalogue(
    pages: Iterable[Scene], path: str | Path, *, paper: str = "light", force: bool = False
) -> list[Path]:
    """Write pages, taken one by one; return the files, in order: none if there are no pages.

    A path that ends in .pdf is one file; for .svg or .png there is a file per page, ``name-1.svg``, ..., or for
    one page the path itself. `paper` is "light" or "dark"; `force` overwrites existing files. Raise FileError if
    the extension is another, or a file exists or cannot be written; UnsolvableError if the library that writes PNG
    (matplotlib) or PDF (reportlab) is not installed.
    """
    check_writable(path, EXPORTERS["pictures"], force=force)
    place, rest = Path(path), iter(pages)
    first = next(rest, None)
    if first is None:
        return []
    second = None if place.suffix.lower() == ".pdf" else next(rest, None)
    if second is None:
        write_as(Pages(chain([first], rest), paper), place, EXPORTERS["pictures"], force=force)
        return [place]
    places = []
    for number, page in enumerate(chain((first, second), rest), start=1):
        places.append(place.with_name(f"{place.stem}-{number}{place.suffix}"))
        page.save(places[-1], paper=paper, force=force)
    return places
