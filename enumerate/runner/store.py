"""The store of an enumeration: one SQLite file, every unit with its rows in one transaction.

What is in it: `enumerate.runner.store_units`. During a run the file is in WAL mode: it can be read meanwhile, and
survives the death of the run at any moment. A complete store is one plain file, as soon as nobody else reads it.
A store is looked through before a run goes on with it, and each unit when it is read
(`enumerate.runner.store_units`).
"""

import sqlite3
import warnings
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from contextlib import contextmanager
from functools import lru_cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

from enumerate.runner import store_units
from enumerate.runner.job import Job, ListColumn, Row, stored, unstored
from graphs.errors import StoreError
from graphs.files.atomic import check_place, remove_left

_REMEMBERED = 4096
"""Lists of a column whose JSON text is kept: many rows share theirs, such as their assortments."""

_PATIENCE_AT_END = 200
"""Milliseconds for which readers are waited for when the store is complete: only its files depend on them, whether the
log is folded in or stays beside the store."""


class SqliteSink:
    """A sink that is an SQLite file; the only one that can be resumed.

    Parameters
    ----------
    path : str or Path
    resume : bool
        Go on with a store of the same job. Without it an existing file is refused.
    force : bool
        Remove a file that is there, and begin anew.
    tell : callable, optional
        Takes a line on what the user should know: the store was damaged, or is not one file. Without it, a
        warning.
    looking : callable, optional
        Takes, now and then, the part of a store to be resumed that has been looked through, 0 to 1.
    """

    _others: Sequence[str] = ()
    """Names of tables that are no rows of the job, and are kept when a store is repaired."""

    def __init__(
        self,
        path: str | Path,
        *,
        resume: bool = False,
        force: bool = False,
        tell: Callable[[str], None] | None = None,
        looking: Callable[[float], None] = lambda part: None,
    ) -> None:
        self.path, self._resume, self._force = Path(path), resume, force
        self._tell, self._looking = tell or _warn, looking
        self._connection: sqlite3.Connection | None = None
        self._units: store_units.UnitTable | None = None
        self._rows: dict[int, int] = {}
        self._complete = False
        self._next, self._first = 0, 1
        self._lists: list[tuple[int, Callable[[Any], Any]]] = []

    def start(self, job: Job) -> Collection[int]:
        """Make the file, or look through it; return the numbers of the units that it holds.

        A damaged store is repaired first, with a message. Raises `StoreError` if there is a file and it is not to
        be resumed, is no store or that of another job, or cannot be opened.
        """
        check_place(self.path, force=True)  # a file only, in a folder that is there
        if self.path.exists() and not (self._resume or self._force):
            raise StoreError(
                f"{self.path}: exists already; try --resume to continue it, --force to replace it, or another name"
            )
        if self._force:
            self._remove()
        remove_left(self.path)  # of a repair that was killed
        if self.path.exists() and _has_tables(self.path):
            self._look_through(job)
        with store_units.naming(self.path):
            self._connection = sqlite3.connect(self.path, isolation_level=None, timeout=store_units.PATIENCE)
            self._units = store_units.UnitTable(self._connection, list(job.columns))
            if not self._complete:  # else there is nothing to write
                self._connection.execute("PRAGMA journal_mode=WAL")
                self._connection.execute("PRAGMA synchronous=NORMAL")
                with self._transaction():
                    store_units.make_tables(self._connection, _meta_of(job))
            self._rows = dict(self._connection.execute("SELECT id, rows FROM unit ORDER BY id"))
        self._lists = _remembering(stored, _lists_in(job), job.columns)
        return self._rows.keys()

    def _remove(self) -> None:
        """Remove a store that is there, with the journals that a killed run left."""
        for end in ("", "-wal", "-shm"):
            try:
                self.path.with_name(self.path.name + end).unlink(missing_ok=True)
            except OSError as error:
                raise StoreError(f"{self.path}: cannot be replaced: {error.strerror}") from None

    def _look_through(self, job: Job) -> None:
        meta = read_meta(self.path)
        if meta["job"] != job.key:
            theirs = ", ".join(f"{key}={value}" for key, value in meta["job"].items())
            raise StoreError(f"{self.path}: holds another run ({theirs}); try another file name")
        if list(meta["columns"]) != list(job.columns):
            raise StoreError(f"{self.path}: {_columns_that_differ(meta['columns'], job)}")
        units = len(job.units())
        findings = store_units.examine_store(self.path, units, self._looking)
        self._complete = findings.sound and meta["complete"]
        if not findings.sound:
            store_units.rebuild_store(self.path, findings, self._others)
            whole = len(findings.whole)
            self._tell(f"{self.path}: repaired a damaged store; kept {whole} of {units} units")

    @contextmanager
    def _transaction(self) -> Iterator[None]:
        assert self._connection is not None
        with self._connection:  # commits at the end, or takes back what was written, whatever is raised
            self._connection.execute("BEGIN IMMEDIATE")
            yield

    def take(self, number: int, rows: list[Row], seconds: float) -> None:
        """Store a unit and its rows in one transaction; they come in the order of their numbers.

        Raises `StoreError` if they cannot be written; the file is as it was before.
        """
        assert self._units is not None
        first = self._first_row_of(number)
        with store_units.naming(self.path), self._transaction():
            texts = list(_replaced(rows, self._lists)) if self._lists else rows
            self._units.add(number, first, texts, round(seconds, 6))
        self._rows[number] = len(rows)

    def _first_row_of(self, number: int) -> int:
        """Return the number of the first row of a unit: all units before it are there."""
        while self._next < number:
            self._first += self._rows.get(self._next, 0)
            self._next += 1
        return self._first

    def finish(self) -> None:
        """Mark the store complete, after a look that every unit is there with its rows.

        Others who read it do not hinder that; only then its files stay as they are during a run, with a message.
        Raises `StoreError` if rows are missing.
        """
        assert self._connection is not None
        with store_units.naming(self.path):
            if not self._complete:
                self._mark_complete(self._connection)
            self._make_one_file(self._connection)
            self._connection.close()

    def _mark_complete(self, connection: sqlite3.Connection) -> None:
        with self._transaction():
            [units, last, promised] = connection.execute("SELECT count(*), max(id), sum(rows) FROM unit").fetchone()
            [rows, greatest] = connection.execute("SELECT count(*), max(rowid) FROM type").fetchone()
            if units and (units != last + 1 or not rows == promised == (greatest or 0)):
                raise StoreError(f"{self.path}: holds {rows} rows; expected {promised}, as its units say")
            connection.execute("UPDATE meta SET value = 'true' WHERE key = 'complete'")

    def _make_one_file(self, connection: sqlite3.Connection) -> None:
        connection.execute(f"PRAGMA busy_timeout={_PATIENCE_AT_END}")
        try:
            connection.execute("PRAGMA journal_mode=DELETE")
        except sqlite3.OperationalError as error:
            if error.sqlite_errorcode & 0xFF not in (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED):
                raise
            self._tell(
                f"{self.path}: complete, but another process has it open: {self.path.name}-wal belongs to it; "
                "try --resume to make it one file"
            )

    def abort(self) -> None:
        """Close the file; what it holds stays."""
        if self._connection is not None:
            self._connection.close()


def _columns_that_differ(columns: Collection[str], job: Job) -> str:
    """Return a line on a store that another version wrote, whose columns are not those of its job."""
    missing = [name for name in job.columns if name not in columns]
    foreign = [name for name in columns if name not in job.columns]
    parts = [f"{said} {', '.join(names)}" for said, names in (("without", missing), ("with", foreign)) if names] or [
        "in another order"
    ]
    return (
        f"another version wrote it, {' and '.join(parts)}; expected the columns of this version: "
        "try another file name, or --force to begin again"
    )


def read_meta(path: str | Path) -> dict[str, Any]:
    """Return what a store says of itself: ``job``, ``columns``, ``lists``, ``complete``, versions.

    Parameters
    ----------
    path : str or Path
        A ``.sqlite`` store; it may still be growing.

    Raises
    ------
    StoreError
        If the file is not a store that this version reads.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from enumerate.chains import ChainJob, ChainQuery
    >>> from enumerate.runner._run import run
    >>> with TemporaryDirectory() as folder:
    ...     store = Path(folder, "six.sqlite")
    ...     _ = run(ChainJob(ChainQuery(6, 1), bare=True), SqliteSink(store))
    ...     meta = read_meta(store)
    >>> meta["columns"], meta["complete"]
    (['code'], True)
    """
    with store_units.reading(Path(path)) as connection:
        return store_units.meta_in(connection, Path(path))


def job_in(path: str | Path) -> dict[str, Any] | None:
    """Return the key of the job that a store is of; None where there is no store, or nothing in it yet.

    Raises `StoreError` if there is a file that is not a store that this version reads.
    """
    path = Path(path)
    if not path.is_file() or not _has_tables(path):
        return None
    job: dict[str, Any] = read_meta(path)["job"]
    return job


def read_rows(path: str | Path) -> Iterator[Row]:
    """Yield the rows of a store, in order, as its columns say; a list is a tuple, as in the rows of a job.

    Parameters
    ----------
    path : str or Path
        A ``.sqlite`` store; of one that is growing, the units that are there.

    Raises
    ------
    StoreError
        If the file is not a store, or a unit is not as it was written: rows before it have been yielded.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from enumerate.chains import ChainJob, ChainQuery
    >>> from enumerate.runner._run import run
    >>> with TemporaryDirectory() as folder:
    ...     store = Path(folder, "six.sqlite")
    ...     _ = run(ChainJob(ChainQuery(6, 1), bare=True), SqliteSink(store))
    ...     print(*read_rows(store))
    ('k1:E`hW',) ('k1:E@zO',)
    """
    path = Path(path)
    with store_units.reading(path) as connection:
        meta = store_units.meta_in(connection, path)
        lists = _remembering(unstored, meta["lists"], meta["columns"])
        units = store_units.UnitTable(connection, meta["columns"])
        for number in units.numbers():
            rows = units.rows(number)
            if rows is None:
                raise StoreError(f"{path}: damaged at unit {number}; try the same command with --resume")
            yield from _replaced(rows, lists) if lists else rows


def _replaced(rows: Sequence[Row], functions: Sequence[tuple[int, Callable[[Any], Any]]]) -> Iterator[Row]:
    """Return rows with the values of some columns, named by their places, replaced by those of functions."""
    columns: list[Iterable[Any]] = list(zip(*rows, strict=True))
    if columns:
        for place, function in functions:
            columns[place] = map(function, columns[place])
    return zip(*columns, strict=True)


def _warn(line: str) -> None:
    warnings.warn(line, stacklevel=2)


def _has_tables(path: Path) -> bool:
    """Return whether there is anything in a database: a run may have died before it made the tables."""
    with store_units.reading(path) as connection:
        return bool(connection.execute("SELECT count(*) FROM sqlite_master").fetchone()[0])


def _meta_of(job: Job) -> dict[str, Any]:
    return {
        "format": store_units.FORMAT,
        "version": store_units.VERSION,
        "synthedra": version("synthedra"),
        "columns": list(job.columns),
        "lists": _lists_in(job),
        "job": job.key,
        "complete": False,
    }


def _lists_in(job: Job) -> list[str]:
    return [name for name, kind in job.columns.items() if isinstance(kind, ListColumn)]


def _remembering(
    function: Callable[[Any], Any], lists: Collection[str], columns: Iterable[str]
) -> list[tuple[int, Callable[[Any], Any]]]:
    """Return the place of each column of lists, and a function of their values.

    Each column remembers its own: lists that are equal, of numbers of different types, are not one text.
    """
    return [(place, lru_cache(_REMEMBERED)(function)) for place, name in enumerate(columns) if name in lists]
