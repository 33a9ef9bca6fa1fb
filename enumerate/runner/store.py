"""The store of an enumeration: one SQLite file, every unit with its rows in one transaction.

Tables: ``meta(key, value)`` says what was enumerated; ``unit(id, state, rows, seconds)`` which units are there;
``type`` holds the rows, each with the unit it came from, lists as JSON text. During a run the file is in WAL mode:
it can be read meanwhile, and survives the death of the run at any moment. A complete store is one plain file.
"""

from __future__ import annotations

import json
import re
import sqlite3
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import lru_cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

from enumerate.runner.columns import Column, ListColumn, stored, unstored
from enumerate.runner.job import Job, Row
from graphs.errors import StoreError
from graphs.files.atomic import check_place

__all__ = ["SqliteSink", "read_meta", "read_rows"]

_FORMAT = "synthedra/store"
_VERSION = 2
_REMEMBERED = 4096
"""Lists of a column whose JSON text is kept: many rows share theirs."""


class SqliteSink:
    """A sink that is an SQLite file; the only one that can be resumed.

    Parameters
    ----------
    path : str or Path
    resume : bool
        Go on with a store of the same job. Without it an existing file is refused.
    force : bool
        Remove a file that is there, and begin anew.
    """

    def __init__(self, path: str | Path, *, resume: bool = False, force: bool = False) -> None:
        self.path, self._resume, self._force = Path(path), resume, force
        self._connection: sqlite3.Connection | None = None
        self._insert = ""
        self._lists: list[tuple[int, Callable[[Any], str]]] = []

    def start(self, job: Job) -> int:
        """Make the file, or look into it; return how many units it holds.

        Raises
        ------
        StoreError
            If there is a file and it is not to be resumed, is no store or that of another job, or cannot be
            opened.
        """
        check_place(self.path, force=True)  # a file only
        if self.path.exists() and not (self._resume or self._force):
            raise StoreError(
                f"{self.path}: exists already; continue it with --resume, begin anew with --force, "
                "or name another file"
            )
        if self._force:
            self._remove()
        if not self.path.parent.is_dir():
            raise StoreError(f"{self.path}: there is no folder {str(self.path.parent)!r}")
        with _named(self.path):
            self._connection = sqlite3.connect(self.path, isolation_level=None)
            [tables] = self._connection.execute("SELECT count(*) FROM sqlite_master").fetchone()
        if tables:
            self._check(job)
        with _named(self.path):
            self._connection.execute("PRAGMA journal_mode=WAL")
            self._connection.execute("PRAGMA synchronous=NORMAL")
            self._make_tables(job)
            self._lists = _texts_of_lists(job.columns)
            marks = ", ".join("?" * (len(job.columns) + 1))
            self._insert = f"INSERT INTO type (unit, {_quoted(job.columns)}) VALUES ({marks})"
            return int(self._connection.execute("SELECT count(*) FROM unit").fetchone()[0])

    def _remove(self) -> None:
        """Remove a store that is there, with the journals that a killed run left."""
        for end in ("", "-wal", "-shm"):
            try:
                self.path.with_name(self.path.name + end).unlink(missing_ok=True)
            except OSError as error:
                raise StoreError(f"{self.path}: cannot be replaced: {error.strerror}") from None

    def _check(self, job: Job) -> None:
        meta = read_meta(self.path)
        if meta["job"] != job.key:
            theirs = ", ".join(f"{key}={value}" for key, value in meta["job"].items())
            raise StoreError(f"{self.path}: holds another run ({theirs}); name another file")

    def _make_tables(self, job: Job) -> None:
        assert self._connection is not None
        meta = {
            "format": _FORMAT,
            "version": _VERSION,
            "synthedra": version("synthedra"),
            "columns": list(job.columns),
            "lists": [name for name, kind in job.columns.items() if isinstance(kind, ListColumn)],
            "job": job.key,
            "complete": False,
        }
        with self._transaction() as cursor:
            cursor.execute("CREATE TABLE IF NOT EXISTS meta (key TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID")
            cursor.execute(
                "CREATE TABLE IF NOT EXISTS unit (id INTEGER PRIMARY KEY, state TEXT, rows INTEGER, seconds REAL)"
            )
            cursor.execute(f"CREATE TABLE IF NOT EXISTS type (unit INTEGER, {_quoted(job.columns)})")
            cursor.executemany(
                "INSERT OR IGNORE INTO meta VALUES (?, ?)",
                [(key, json.dumps(value)) for key, value in meta.items()],
            )

    @contextmanager
    def _transaction(self) -> Iterator[sqlite3.Cursor]:
        assert self._connection is not None
        with self._connection:  # commits at the end, or takes back what was written, whatever is raised
            cursor = self._connection.cursor()
            cursor.execute("BEGIN IMMEDIATE")
            yield cursor

    def take(self, number: int, rows: list[Row], seconds: float) -> None:
        """Store a unit and its rows in one transaction.

        Raises
        ------
        StoreError
            If they cannot be written; the file is as it was before.
        """
        with _named(self.path), self._transaction() as cursor:
            cursor.executemany(self._insert, ((number, *self._told(row)) for row in rows))
            cursor.execute("INSERT INTO unit VALUES (?, 'done', ?, ?)", (number, len(rows), round(seconds, 6)))

    def _told(self, row: Row) -> Sequence[Any]:
        """Return the values of a row with lists as JSON text."""
        if not self._lists:
            return row
        values = list(row)
        for place, text in self._lists:
            values[place] = text(values[place])
        return values

    def finish(self) -> None:
        """Mark the store complete, after a look that every unit is there with its rows.

        Raises
        ------
        StoreError
            If rows are missing.
        """
        assert self._connection is not None
        with _named(self.path):
            [units, last, promised] = self._connection.execute(
                "SELECT count(*), max(id), sum(rows) FROM unit"
            ).fetchone()
            [rows] = self._connection.execute("SELECT count(*) FROM type").fetchone()
            if units and (units != last + 1 or rows != promised):
                raise StoreError(f"{self.path}: holds {rows} rows, its units say {promised}")
            with self._transaction() as cursor:
                cursor.execute("UPDATE meta SET value = 'true' WHERE key = 'complete'")
            self._connection.execute("PRAGMA journal_mode=DELETE")
            self._connection.close()

    def abort(self) -> None:
        """Close the file; what it holds stays."""
        if self._connection is not None:
            self._connection.close()


def read_meta(path: str | Path) -> dict[str, Any]:
    """Return what a store says of itself: ``job``, ``columns``, ``lists``, ``complete``, versions.

    Raises
    ------
    StoreError
        If the file is not a store that this version reads.
    """
    with _reading(Path(path)) as connection:
        meta = {key: json.loads(value) for key, value in connection.execute("SELECT key, value FROM meta")}
    if meta.get("format") != _FORMAT or meta.get("version") != _VERSION:
        raise StoreError(f"{path}: is not a store of version {_VERSION}")
    return meta


def read_rows(path: str | Path) -> Iterator[Row]:
    """Yield the rows of a store, in order, as its columns say; a list is a tuple, as in the rows of a job.

    Raises
    ------
    StoreError
        If the file is not a store.
    """
    meta = read_meta(path)
    columns, lists = meta["columns"], set(meta["lists"])
    read = lru_cache(_REMEMBERED)(unstored)
    with _reading(Path(path)) as connection:
        for row in connection.execute(f"SELECT {_quoted(columns)} FROM type ORDER BY rowid"):
            yield tuple(read(value) if name in lists else value for name, value in zip(columns, row, strict=True))


@contextmanager
def _reading(path: Path) -> Iterator[sqlite3.Connection]:
    if not path.is_file():
        raise StoreError(f"{path}: no such file")
    connection = None
    try:
        connection = sqlite3.connect(f"{path.resolve().as_uri()}?mode=ro", uri=True)
        yield connection
    except sqlite3.Error as error:
        raise StoreError(f"{path}: cannot be read as a store: {error}") from None
    finally:
        if connection is not None:
            connection.close()


@contextmanager
def _named(path: Path) -> Iterator[None]:
    """Turn what SQLite says into one line that names the file."""
    try:
        yield
    except sqlite3.IntegrityError:
        raise StoreError(f"{path}: another run is writing to it") from None
    except sqlite3.Error as error:
        hint = "; what was stored stays: make room and --resume" if re.search("full|I/O", str(error)) else ""
        raise StoreError(f"{path}: {error}{hint}") from None


def _texts_of_lists(columns: Mapping[str, Column]) -> list[tuple[int, Callable[[Any], str]]]:
    """Return the place of each column of lists, and what makes text of them.

    Each column remembers its own: lists that are equal, of numbers of different types, are not one text.
    """
    return [
        (place, lru_cache(_REMEMBERED)(stored))
        for place, kind in enumerate(columns.values())
        if isinstance(kind, ListColumn)
    ]


def _quoted(columns: Iterable[str]) -> str:
    return ", ".join(f'"{column}"' for column in columns)
