"""How units lie in a store, digests that say whether they are as they were written, and the repair of a store.

Tables: ``meta(key, value)`` says what was enumerated; ``unit(id, state, first, rows, seconds, digest)`` which are
there, the row each begins with and how many it has; ``type`` holds the rows, numbered as if the units had come one
after the other, each with its unit, lists as JSON text. A digest is made of the entry of a unit and of its rows,
column by column, as they will be read.

A store that is damaged is never written to: its units that are as they were written go into a new file, which
takes its place. The rows keep their numbers, so that units which are computed again fill the gaps.
"""

import hashlib
import json
import marshal
import math
import shutil
import sqlite3
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass
from functools import partial
from itertools import count
from pathlib import Path
from typing import Any, TypeVar

from enumerate.runner.job import Row
from graphs.errors import OpenError, StoreError, shown
from graphs.files.atomic import Unfinished, remove_folder

T = TypeVar("T")

FORMAT = "synthedra/store"
# Of the tables of a store. Stores of other versions are refused: raise it with each change of what tables mean.
VERSION = 3
PATIENCE = 30.0
"""Seconds for which a lock of another process is waited for: longer than a transaction of ours takes on a slow disk."""

_DAMAGE = {
    sqlite3.SQLITE_ERROR,  # a table or column is not there
    sqlite3.SQLITE_IOERR,
    sqlite3.SQLITE_CORRUPT,
    sqlite3.SQLITE_TOOBIG,
    sqlite3.SQLITE_FORMAT,
    sqlite3.SQLITE_NOTADB,
}
COMPLAINTS = (sqlite3.Error, UnicodeDecodeError)
"""What SQLite raises; where it quotes a damaged name, Python cannot read its message."""

_CHANGING = ("complete", "digest")
"""What a store says of itself that its digest does not cover."""


@dataclass(frozen=True, slots=True)
class StoredUnit:
    """The entry of a unit.

    Its rows follow each other from number `first`, counted from 1; `seconds` is how long they took.
    """

    number: int
    state: str
    first: int
    rows: int
    seconds: float
    digest: str


class UnitTable:
    """The units of an open store, by their numbers, with these columns in their rows."""

    def __init__(self, connection: sqlite3.Connection, columns: Sequence[str]) -> None:
        self._connection = connection
        names, marks = quoted(columns), ", ".join("?" * len(columns))
        self._append = f"INSERT INTO type (unit, {names}) VALUES ({{number}}, {marks})"
        self._insert = f"INSERT INTO type (rowid, unit, {names}) VALUES (?, ?, {marks})"
        self._select = f"SELECT {names} FROM type WHERE unit = ? AND rowid BETWEEN ? AND ? ORDER BY rowid"
        self._count = "SELECT count(*) FROM type WHERE rowid BETWEEN ? AND ?"

    def numbers(self) -> list[int]:
        """Return the numbers of all units."""
        return [number for (number,) in self._connection.execute("SELECT id FROM unit ORDER BY id")]

    def promised(self) -> float:
        """Return how many rows the units say that they have, together."""
        return float(self._connection.execute("SELECT total(rows) FROM unit").fetchone()[0])

    def entry(self, number: int) -> StoredUnit | None:
        """Return the entry of a unit, if there is one, whatever its values are."""
        query = "SELECT id, state, first, rows, seconds, digest FROM unit WHERE id = ?"
        entry = self._connection.execute(query, (number,)).fetchone()
        return None if entry is None else StoredUnit(*entry)

    def add(self, number: int, first: int, rows: Sequence[Row], seconds: float) -> None:
        """Write a unit with its rows; the transaction is the caller's."""
        [last] = self._connection.execute("SELECT max(rowid) FROM type").fetchone()
        if (last or 0) == first - 1:  # SQLite numbers them itself, in half the time
            self._connection.executemany(self._append.format(number=int(number)), rows)
        else:
            self._connection.executemany(
                self._insert, ((place, number, *row) for place, row in zip(count(first), rows, strict=False))
            )
        entry = (number, "done", first, len(rows), float(seconds))
        self._connection.execute("INSERT INTO unit VALUES (?, ?, ?, ?, ?, ?)", (*entry, _digest(entry, rows)))

    def rows(self, number: int) -> list[Row] | None:
        """Return the rows of a unit, as they are stored; None if it is not as it was written."""
        try:
            return self._rows_as_written(number)
        except sqlite3.OperationalError as error:
            if getattr(error, "sqlite_errorcode", None) is not None:
                raise  # SQLite itself complains, not Python of what it got
            return None  # text that is no UTF-8: SQLite gives it, Python cannot read it

    def _rows_as_written(self, number: int) -> list[Row] | None:
        unit = self.entry(number)
        if unit is None or not all(isinstance(value, int) and value >= 0 for value in (unit.first, unit.rows)):
            return None
        last = unit.first + unit.rows - 1
        rows = self._connection.execute(self._select, (number, unit.first, last)).fetchall()
        [(within,)] = self._connection.execute(self._count, (unit.first, last))
        entry = (number, unit.state, unit.first, unit.rows, unit.seconds)
        return rows if within == len(rows) == unit.rows and _digest(entry, rows) == unit.digest else None


def _digest(entry: Row, rows: Sequence[Row]) -> str:
    """Return the digest of a unit, of rows that are to be written or have been read."""
    columns = [_column_read_back(column) for column in zip(*rows, strict=True)]
    # Version 2 writes the values and nothing else: not whether two are one object, as later ones do.
    return hashlib.blake2b(marshal.dumps((entry, columns), 2), digest_size=16).hexdigest()


def _column_read_back(column: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return values as SQLite gives them back: truth values as numbers, what is not a number as NULL."""
    types = set(map(type, column))
    if types <= {int, str}:
        return column
    return tuple(map(int, column)) if types <= {int, bool} else tuple(map(_read_back, column))


def _read_back(value: Any) -> Any:
    if isinstance(value, float):  # numpy's too
        return None if math.isnan(value) else float(value)
    return int(value) if isinstance(value, int) else value


def make_tables(connection: sqlite3.Connection, meta: Mapping[str, Any]) -> None:
    """Make the tables of a store where they are not there; the transaction is the caller's.

    `meta` is what the store says of itself, without its digest.
    """
    texts = {key: json.dumps(value) for key, value in meta.items()}
    texts["digest"] = json.dumps(_meta_digest(texts))
    connection.execute("CREATE TABLE IF NOT EXISTS meta (key TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID")
    connection.execute(
        "CREATE TABLE IF NOT EXISTS unit "
        "(id INTEGER PRIMARY KEY, state TEXT, first INTEGER, rows INTEGER, seconds REAL, digest TEXT)"
    )
    connection.execute(f"CREATE TABLE IF NOT EXISTS type (unit INTEGER, {quoted(meta['columns'])})")
    connection.executemany("INSERT OR IGNORE INTO meta VALUES (?, ?)", texts.items())


def _meta_digest(texts: Mapping[Any, Any]) -> str:
    """Return the digest of what a store says of itself, but for what changes while it grows."""
    fixed = sorted(repr(item) for item in texts.items() if item[0] not in _CHANGING)
    return hashlib.blake2b(repr(fixed).encode(), digest_size=16).hexdigest()


def meta_in(connection: sqlite3.Connection, path: Path) -> dict[str, Any]:
    """Return what a store says of itself.

    Raises `StoreError` if it is not a store that this version reads, or says so no more.
    """
    texts = dict(connection.execute("SELECT key, value FROM meta"))
    if texts.get("format") != json.dumps(FORMAT) or texts.get("version") != json.dumps(VERSION):
        raise StoreError(
            f"{path}: not a store that can be read here; expected format {FORMAT!r}, version {VERSION}, "
            f"got format {shown(texts.get('format'))}, version {shown(texts.get('version'))}"
        )
    if texts.get("digest") != json.dumps(_meta_digest(texts)) or texts.get("complete") not in ("true", "false"):
        raise StoreError(f"{path}: damaged: its table meta was altered; try another file")
    return {key: json.loads(text) for key, text in texts.items()}


@contextmanager
def reading(path: Path) -> Iterator[sqlite3.Connection]:
    """Open a store for reading, as it is at this moment, whatever other processes write meanwhile.

    Raises `StoreError` if there is no such file, or it cannot be read as a database.
    """
    if not path.is_file():
        raise StoreError(f"{path}: no such file")
    connection = None
    try:
        _take_back(path)
        connection = _opened(path, "ro")
        connection.execute("PRAGMA writable_schema=ON")  # else a file that was cut off is not opened at all
        connection.execute("BEGIN")
        yield connection
    except COMPLAINTS as error:
        raise StoreError(f"{path}: cannot be read as a store: {_said(error)}") from None
    finally:
        if connection is not None:
            connection.close()


def _opened(path: Path, mode: str) -> sqlite3.Connection:
    return sqlite3.connect(f"{path.resolve().as_uri()}?mode={mode}", uri=True, isolation_level=None, timeout=PATIENCE)


def _take_back(path: Path) -> None:
    """Undo what a killed run had half written without its log, which only a connection that may write can do."""
    if not path.with_name(f"{path.name}-journal").exists():
        return
    with suppress(sqlite3.Error), closing(_opened(path, "rw")) as connection:  # else reading says what is wrong
        connection.execute("SELECT count(*) FROM sqlite_master").fetchone()


def _said(error: Exception) -> str:
    """Return what SQLite says, in one printable line: it may quote a damaged name."""
    if isinstance(error, UnicodeDecodeError):
        return "its schema is damaged"
    text = str(error)
    return text if text.isprintable() else ascii(text)[1:-1]


@contextmanager
def naming(path: Path) -> Iterator[None]:
    """Turn what SQLite says into one line that names the file."""
    try:
        yield
    except sqlite3.IntegrityError:
        raise StoreError(f"{path}: another run is writing to it") from None
    except COMPLAINTS as error:
        code = getattr(error, "sqlite_errorcode", sqlite3.SQLITE_OK) & 0xFF
        if code in (sqlite3.SQLITE_FULL, sqlite3.SQLITE_IOERR):
            hint = "; try --resume when there is room: stored units are kept"
        elif code == sqlite3.SQLITE_BUSY:
            hint = ": another process holds it; try --resume when that has ended: stored units are kept"
        else:
            hint = ""
        raise StoreError(f"{path}: {_said(error)}{hint}") from None


def quoted(columns: Iterable[str]) -> str:
    """Return names of columns for a statement."""
    return ", ".join(f'"{column}"' for column in columns)


@dataclass(frozen=True, slots=True)
class Findings:
    """What a store says of itself (`meta`), and the numbers, rising, of its units that are as they were written.

    Sound: the file is a good database and holds these units, nothing else, and all of them if it says that it is
    complete.
    """

    meta: dict[str, Any]
    whole: tuple[int, ...]
    sound: bool


def examine_store(path: Path, units: int, looking: Callable[[float], None]) -> Findings:
    """Look at every page and every unit of a store whose job has so many units.

    `looking` takes the part of the rows that has been looked through, 0 to 1, after each unit. Raises `StoreError`
    if the file cannot be read as a store at all.
    """
    with reading(path) as connection:
        meta = meta_in(connection, path)
        table = UnitTable(connection, meta["columns"])
        whole = tuple(_whole(table, units, looking))
        check: list[Row] = _despite_damage(lambda: connection.execute("PRAGMA quick_check(1)").fetchall(), [])
        sound = check == [("ok",)] and _holds_only(connection, table, whole)
    return Findings(meta, whole, sound and (len(whole) == units or not meta["complete"]))


def _whole(table: UnitTable, units: int, looking: Callable[[float], None]) -> Iterator[int]:
    """Yield the numbers of the units that are as they were written."""
    total, seen = _despite_damage(table.promised, 0.0), 0
    for number in range(units):
        rows = _despite_damage(partial(table.rows, number), None)
        if rows is not None:
            yield number
            seen += len(rows)
            looking(min(seen / total, 1.0) if total > 0 else 1.0)


def _despite_damage(read: Callable[[], T], otherwise: T) -> T:
    """Return what is read, or something else if SQLite complains that it is damaged."""
    try:
        return read()
    except COMPLAINTS as error:
        code = getattr(error, "sqlite_errorcode", sqlite3.SQLITE_OK) & 0xFF
        if not isinstance(error, UnicodeDecodeError) and code not in _DAMAGE:  # of locks, rights or room
            raise
        return otherwise


def _holds_only(connection: sqlite3.Connection, table: UnitTable, whole: tuple[int, ...]) -> bool:
    """Return whether a good database has the units named, their rows, and no others."""
    if table.numbers() != list(whole):
        return False
    [rows] = connection.execute("SELECT count(*) FROM type").fetchone()
    return bool(table.promised() == rows)


def rebuild_store(path: Path, findings: Findings, others: Sequence[str] = ()) -> None:
    """Put a store that holds the whole units only in the place of a damaged one, and the rows of some other tables.

    Raises `StoreError` or `OpenError` if it cannot be written; the damaged one stays.
    """
    place = path.resolve()
    try:
        unfinished = Unfinished(place, folder=True)
    except OSError as error:
        raise OpenError(path, "", f"cannot be repaired: {error.strerror}", "a writable folder") from None
    repaired = unfinished.path / place.name
    try:
        with naming(path):
            _copy(place, repaired, findings, others)
        shutil.copymode(place, repaired)
        for ending in ("-wal", "-shm", "-journal"):  # else SQLite would take them for those of the new one
            Path(f"{place}{ending}").unlink(missing_ok=True)
        repaired.replace(place)
    finally:
        remove_folder(unfinished.path)
        unfinished.release()


def _copy(source: Path, target: Path, findings: Findings, others: Sequence[str]) -> None:
    meta: Mapping[str, Any] = {**findings.meta, "complete": False}
    with closing(sqlite3.connect(target, isolation_level=None)) as repaired, reading(source) as damaged:
        repaired.execute("PRAGMA journal_mode=WAL")
        repaired.execute("BEGIN")
        make_tables(repaired, {key: value for key, value in meta.items() if key != "digest"})
        theirs, ours = UnitTable(damaged, meta["columns"]), UnitTable(repaired, meta["columns"])
        for number in findings.whole:
            unit, rows = theirs.entry(number), theirs.rows(number)
            assert unit is not None
            assert rows is not None  # they were read a moment ago
            ours.add(number, unit.first, rows, unit.seconds)
        for name in others:
            _copy_table(damaged, repaired, name)
        repaired.execute("COMMIT")


def _copy_table(damaged: sqlite3.Connection, repaired: sqlite3.Connection, name: str) -> None:
    """Copy the rows of a table that can be read; whether they are as they were written its owner has to see."""
    listed = partial(damaged.execute, "SELECT sql FROM sqlite_master WHERE type = 'table' AND name = ?", (name,))
    statement = _despite_damage(lambda: listed().fetchone(), None)
    if statement is None:
        return
    repaired.execute(statement[0])
    numbers: list[tuple[int]] = _despite_damage(lambda: damaged.execute(f"SELECT rowid FROM {name}").fetchall(), [])
    for number in numbers:
        row = _despite_damage(partial(_row_of, damaged, name, number), None)
        if row is not None:
            repaired.execute(f"INSERT INTO {name} VALUES ({', '.join('?' * len(row))})", row)


def _row_of(damaged: sqlite3.Connection, name: str, number: tuple[int]) -> tuple[Any, ...] | None:
    found: tuple[Any, ...] | None = damaged.execute(f"SELECT * FROM {name} WHERE rowid = ?", number).fetchone()
    return found
