"""Where the rows of an enumeration go: files, a folder of mechanisms, a store, a callback, or a sum.

Files are written beside their place and moved there when the run is complete; what a killed run left there
is removed by the next one to the same place. To add a format, write a sink and enter it in ``SINKS``.
"""

import csv
import io
import json
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Generic, TypeVar

from enumerate.runner.job import Column, Job, ListColumn, Row, Sink, Unit, row_as_dict, stored
from enumerate.runner.store import SqliteSink, read_rows
from graphs.errors import FileError, InvariantError, StoreError, shown
from graphs.files.atomic import Beside, FolderBeside, remove_left
from graphs.files.outputs import unknown_extension
from graphs.printing import plain

B = TypeVar("B", Beside, FolderBeside)


class RowSink:
    """A sink that calls a function with the columns and the rows of each unit.

    Parameters
    ----------
    function : callable
        Takes the names of the columns, and the list of rows of a unit.

    Examples
    --------
    >>> from enumerate.chains import ChainJob, ChainQuery
    >>> from enumerate.runner._run import run
    >>> codes = []
    >>> _ = run(ChainJob(ChainQuery(6, 1), bare=True), RowSink(lambda columns, rows: codes.extend(rows)))
    >>> codes
    [('k1:E`hW',), ('k1:E@zO',)]
    """

    def __init__(self, function: Callable[[tuple[str, ...], list[Row]], None]) -> None:
        self._function = function
        self._columns: tuple[str, ...] = ()

    def start(self, job: Job) -> Collection[int]:
        """Note the columns; nothing is there already."""
        self._columns = tuple(job.columns)
        return ()

    def take(self, number: int, rows: list[Row], seconds: float) -> None:
        """Call the function."""
        self._function(self._columns, rows)

    def finish(self) -> None:
        """Do nothing: nothing is open."""

    def abort(self) -> None:
        """Do nothing: nothing is open."""


class _Sorted:
    """A job whose rows come sorted, all in one unit: to a store, another job than the one it is made of."""

    def __init__(self, job: Job, column: str) -> None:
        self._job, self._column = job, column

    def __getattr__(self, name: str) -> Any:
        return getattr(self._job, name)

    @property
    def key(self) -> dict[str, Any]:
        """What the job is, and how its rows are sorted."""
        return {**self._job.key, "sort": self._column}

    def units(self) -> Sequence[Unit]:
        """One."""
        return [Unit(None)]


class SortedSink:
    """A sink that keeps all rows, and hands them to another when they are complete, sorted by one column.

    Parameters
    ----------
    inner : Sink
    column : str
        With ``-`` before it: falling. Rows that are equal there stay in their order.
    """

    def __init__(self, inner: Sink, column: str) -> None:
        self._inner, self._column = inner, column
        self._rows: list[Row] = []
        self._seconds = 0.0
        self._place = 0
        self._there = False

    def start(self, job: Job) -> Collection[int]:
        """Look the column up.

        Raises `InvariantError` if there is no such column.
        """
        names = tuple(job.columns)
        name = self._column.removeprefix("-")
        if name not in names:
            raise InvariantError("sort", f"no column {shown(name)}", " ".join(names))
        self._place = names.index(name)
        self._there = 0 in self._inner.start(_Sorted(job, self._column))
        return range(len(job.units())) if self._there else ()

    def take(self, number: int, rows: list[Row], seconds: float) -> None:
        """Keep the rows."""
        self._rows += rows
        self._seconds += seconds

    def finish(self) -> None:
        """Sort and hand over, unless they are there already."""
        place = self._place
        self._rows.sort(key=lambda row: row[place], reverse=self._column.startswith("-"))
        if not self._there:
            self._inner.take(0, self._rows, self._seconds)
        self._inner.finish()

    def abort(self) -> None:
        """Hand nothing over."""
        self._inner.abort()


class _BesideSink(Sink, Generic[B]):
    """A file or folder beside its place; what a unit becomes is the subclass's affair."""

    def __init__(self, path: Path, begin: Callable[[], B]) -> None:
        self._path = path
        self._begin: Callable[[], B] = begin
        self._columns: tuple[str, ...] = ()
        self._beside: B | None = None

    def start(self, job: Job) -> Collection[int]:
        """Begin it; raises `FileError` if what is at its place must stay."""
        self._columns = tuple(job.columns)
        remove_left(self._path)
        self._beside = self._begin()
        return ()

    @property
    def _begun(self) -> B:
        assert self._beside is not None
        return self._beside

    def finish(self) -> None:
        """Move it to its place."""
        self._begun.commit()

    def abort(self) -> None:
        """Remove what was written."""
        if self._beside is not None:
            self._beside.discard()


class _FileSink(_BesideSink[Beside]):
    def __init__(self, path: Path, *, force: bool = False) -> None:
        super().__init__(path, lambda: Beside(path, force=force))

    def _write(self, lines: Iterable[str]) -> None:
        self._begun.write("".join(lines).encode("utf-8"))


class Graph6Sink(_FileSink):
    """graph6: one canonical form a line, and nothing else."""

    def start(self, job: Job) -> Collection[int]:
        """Open the file."""
        if job.columns.get("code") is not str and "order" in job.columns:
            raise StoreError(f"{self._path}: graph6 cannot hold angles; try a .jsonl or .sqlite file")
        beyond = {"ground": "the ground link", "chain": "a drawing, centres and open edges"}
        for column, what in beyond.items():
            if column in job.columns:
                raise StoreError(f"{self._path}: graph6 cannot hold {what}; try a .jsonl or .sqlite file")
        return super().start(job)

    def take(self, number: int, rows: list[Row], seconds: float) -> None:
        """Write a line a row."""
        self._write(row[0].removeprefix("k1:") + "\n" for row in rows)


class JsonLinesSink(_FileSink):
    """JSON lines: one object per row."""

    def take(self, number: int, rows: list[Row], seconds: float) -> None:
        """Write a line a row."""
        self._write(json.dumps(dict(zip(self._columns, row, strict=True))) + "\n" for row in rows)


class CsvSink(_FileSink):
    """A table for spreadsheets: names of columns, then a line a row. Lists are JSON text, as in a store."""

    def start(self, job: Job) -> Collection[int]:
        """Open the file, and write the names."""
        there = super().start(job)
        self._write_table([self._columns])
        return there

    def take(self, number: int, rows: list[Row], seconds: float) -> None:
        """Write a line a row."""
        self._write_table([stored(value) if isinstance(value, tuple) else value for value in row] for row in rows)

    def _write_table(self, rows: Iterable[Iterable[Any]]) -> None:
        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerows(rows)
        self._write([text.getvalue()])


class LatexSink(_FileSink):
    """A table for a document of LaTeX: a longtable with the rules of booktabs, values as printed."""

    def start(self, job: Job) -> Collection[int]:
        """Open the file, and write the head of the table."""
        there = super().start(job)
        self._kinds = tuple(job.columns.values())
        sides = "".join("r" if kind in (int, float) else "l" for kind in self._kinds)
        head = " & ".join(rf"\textbf{{{_in_latex(name)}}}" for name in self._columns)
        self._write([
            "% requires \\usepackage{booktabs,longtable}\n",
            f"\\begin{{longtable}}{{{sides}}}\n\\toprule\n{head} \\\\\n\\midrule\n\\endhead\n",
            "\\bottomrule\n\\endfoot\n",
        ])  # fmt: skip
        return there

    def take(self, number: int, rows: list[Row], seconds: float) -> None:
        """Write a row of the table for each."""
        self._write(" & ".join(map(self._cell, self._kinds, row)) + " \\\\\n" for row in rows)

    def _cell(self, kind: Column, value: Any) -> str:
        if value is None:
            return ""
        if isinstance(kind, ListColumn):
            return _in_latex(kind.text(value))
        return rf"\texttt{{{_in_latex(value)}}}" if kind is str else f"{value:.6g}" if kind is float else str(value)

    def finish(self) -> None:
        """End the table, and move the file to its place."""
        self._write(["\\end{longtable}\n"])
        super().finish()


_LATEX = {character: rf"\{character}" for character in "#$%&_{}"} | {
    "\\": r"\textbackslash{}",
    "^": r"\textasciicircum{}",
    "~": r"\textasciitilde{}",
    "`": r"{\char96}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "|": r"\textbar{}",
    '"': r"{\char34}",
}


def _in_latex(text: str) -> str:
    return "".join(_LATEX.get(character, character) for character in plain(text, 10_000))


class ParquetSink(_FileSink):
    """Parquet, one row group a unit; needs pyarrow. A list of values of several types is JSON text."""

    def __init__(self, path: Path, *, force: bool = False) -> None:
        super().__init__(path, force=force)
        self._writer: Any = None
        self._mixed: set[int] = set()

    def start(self, job: Job) -> Collection[int]:
        """Open the file; raises `StoreError` if pyarrow is not installed."""
        try:
            import pyarrow as arrow
            from pyarrow import parquet
        except ImportError:
            raise StoreError(f"{self._path}: Parquet requires pyarrow; try pip install 'synthedra[parquet]'") from None
        super().start(job)
        self._schema = arrow.schema([(column, _arrow_type(kind)) for column, kind in job.columns.items()])
        kinds = enumerate(job.columns.values())
        self._mixed = {i for i, kind in kinds if isinstance(kind, ListColumn) and kind.kind is None}
        self._writer = parquet.ParquetWriter(self._begun.stream, self._schema)
        return ()

    def take(self, number: int, rows: list[Row], seconds: float) -> None:
        """Write the rows."""
        import pyarrow as arrow

        if not rows:
            return
        values = [
            [stored(value) for value in column] if i in self._mixed else list(column)
            for i, column in enumerate(zip(*rows, strict=True))
        ]
        table = arrow.Table.from_arrays(
            [arrow.array(v, field.type) for v, field in zip(values, self._schema, strict=True)], schema=self._schema
        )
        try:
            self._writer.write_table(table)
        except OSError as error:
            raise FileError(self._path, "", f"cannot be written: {error.strerror or error}") from None

    def finish(self) -> None:
        """Write the footer, and move the file to its place."""
        self._writer.close()
        super().finish()

    def abort(self) -> None:
        """Remove what was written; the writer would still want to write its footer when it is let go."""
        if self._writer is not None:
            self._writer.is_open = False
        super().abort()


def _arrow_type(kind: Column) -> Any:
    import pyarrow as arrow

    if not isinstance(kind, ListColumn):
        return {int: arrow.int64(), str: arrow.string(), bool: arrow.bool_(), float: arrow.float64()}[kind]
    if kind.kind is None:
        return arrow.string()
    items = _arrow_type(kind.kind)
    return arrow.list_(arrow.list_(items) if kind.within else items)


def mechanism_text(row: Mapping[str, Any]) -> str:
    """Return the native file of the mechanism of a row.

    Its column ``mechanism`` is the file itself, ``code`` the id of a drawn mechanism, or of a chain, which gets
    the faces of an embedding as loops.
    """
    if "mechanism" in row:
        return str(row["mechanism"])
    # Not at the head: what only counts, or lists ids, makes no mechanism.
    from graphs.convert.link_joint import sc_from_link_joint_graph
    from graphs.files.native import dumps
    from graphs.identity.chains import chain_from_id
    from graphs.identity.drawings import mechanism_from_map_id
    from graphs.mechanism.sc import SCGraph

    code = row["code"]
    if code.startswith("m1:"):
        return dumps(mechanism_from_map_id(code))
    sc = sc_from_link_joint_graph(chain_from_id(code))
    return dumps(SCGraph(sc.nodes, sc.joints, sc.loops, ground=row.get("ground")))


class FolderSink(_BesideSink[FolderBeside]):
    """A folder with a native file for each row, named by its number.

    Its text is that of `mechanism_text`, or of the job's own function of this name.
    """

    def __init__(self, path: Path) -> None:
        super().__init__(path, lambda: FolderBeside(path))
        self._number = 0

    def start(self, job: Job) -> Collection[int]:
        """Make a folder beside its place; raises `FileError` if there is something at its place."""
        self._text = getattr(job, "mechanism_text", mechanism_text)
        return super().start(job)

    def take(self, number: int, rows: list[Row], seconds: float) -> None:
        """Write a file a row."""
        for row in rows:
            self._number += 1
            self._write(f"{self._number:07d}.json", self._text(row_as_dict(self._columns, row)))

    def _write(self, name: str, text: str) -> None:
        try:
            (self._begun.path / name).write_text(text, encoding="utf-8")
        except OSError as error:
            raise FileError(self._path, "", f"cannot be written: {error.strerror}") from None


SINKS: dict[str, type[CsvSink | Graph6Sink | JsonLinesSink | LatexSink | ParquetSink]] = {
    ".csv": CsvSink,
    ".g6": Graph6Sink,
    ".jsonl": JsonLinesSink,
    ".parquet": ParquetSink,
    ".tex": LatexSink,
}
"""Extension to the sink of a file."""


def sink_for(
    path: str | Path,
    *,
    resume: bool = False,
    force: bool = False,
    tell: Callable[[str], None] | None = None,
    looking: Callable[[float], None] = lambda part: None,
) -> Sink:
    """Return the sink that a name calls for; a name without an extension is a folder.

    What is there already is refused when the sink is started, unless it is a store to be resumed, or a file that
    ``force`` lets it replace: at the end of the run, a store at its beginning.

    Parameters
    ----------
    path : str or Path
        Ending in ``.sqlite`` or a key of `SINKS`, or a folder.
    resume : bool
        Go on with a store.
    force : bool
        Replace a file that is there.
    tell : callable, optional
        Takes a line on the state of a store that the user should know (`SqliteSink`).
    looking : callable, optional
        Takes the part of a store to be resumed that has been looked through.

    Raises
    ------
    FileError
        If the extension is not known.
    StoreError
        If what it names cannot be resumed.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from enumerate.chains import ChainJob, ChainQuery
    >>> from enumerate.runner._run import run
    >>> with TemporaryDirectory() as folder:
    ...     _ = run(ChainJob(ChainQuery(6, 1), bare=True), sink_for(Path(folder, "six.jsonl")))
    ...     print(Path(folder, "six.jsonl").read_text().rstrip())
    {"code": "k1:E`hW"}
    {"code": "k1:E@zO"}
    """
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix == ".sqlite":
        return SqliteSink(path, resume=resume, force=force, tell=tell, looking=looking)
    if suffix and suffix not in SINKS:
        raise unknown_extension(path, sorted([*SINKS, ".sqlite"]), ", or a folder")
    if resume:
        raise StoreError(f"{path}: only a .sqlite store can be resumed")
    if not suffix:
        return FolderSink(path)
    return SINKS[suffix](path, force=force)


class CountSink:
    """A sink that adds up the first value of every row, apart for rows whose other values differ.

    Parameters
    ----------
    store : SqliteSink, optional
        Keeps the rows too. The numbers are then those of the store when it is complete: units that a run before
        this one has counted are among them, and each is there once.

    Attributes
    ----------
    total : int
        The sum of all; of a run with a store, once it is finished.
    parts : mapping
        The sums by the other values of the rows, in the order in which these first came.

    Examples
    --------
    >>> from enumerate.chains import ChainQuery, count_job
    >>> from enumerate.runner._run import run
    >>> sink = CountSink()
    >>> _ = run(count_job(ChainQuery(8, 1), "burnside"), sink)
    >>> sink.total
    16
    """

    def __init__(self, store: SqliteSink | None = None) -> None:
        self._store = store
        self._names: tuple[str, ...] = ()
        self.parts: Counter[Row] = Counter()

    @property
    def total(self) -> int:
        """The sum of all."""
        return self.parts.total()

    def start(self, job: Job) -> Collection[int]:
        """Open the store, if there is one; return the units that it holds."""
        self._names = tuple(job.columns)
        return () if self._store is None else self._store.start(job)

    def take(self, number: int, rows: list[Row], seconds: float) -> None:
        """Add the numbers, or store them."""
        if self._store is None:
            self._add(rows)
        else:
            self._store.take(number, rows, seconds)

    def finish(self) -> None:
        """Complete the store, and add up what it holds."""
        if self._store is not None:
            self._store.finish()
            self._add(read_rows(self._store.path))

    def abort(self) -> None:
        """Close the store; what it holds stays."""
        if self._store is not None:
            self._store.abort()

    def _add(self, rows: Any) -> None:
        for count, *rest in rows:
            self.parts[tuple(rest)] += count

    def by(self, column: str) -> dict[Any, int]:
        """Return the sums by the values of a column, the largest value first; none if the job has no such column.

        Examples
        --------
        >>> from enumerate.chains.jobs import count_job
        >>> from enumerate.chains.query import ChainQuery
        >>> from enumerate.runner._run import run
        >>> sink = CountSink()
        >>> progress = run(count_job(ChainQuery(8, 1), "orbits"), sink)
        >>> sink.by("contracted_links")
        {4: 9, 3: 5, 2: 2}
        """
        if column not in self._names[1:]:
            return {}
        place = self._names.index(column) - 1
        sums: Counter[Any] = Counter()
        for values, count in self.parts.items():
            sums[values[place]] += count
        return dict(sorted(sums.items(), reverse=True))
