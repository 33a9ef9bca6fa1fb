"""An atlas opened so that a statement, whoever wrote it, can read types and do nothing else.

SQLite's authorizer refuses all but SELECT on the views and tables of the atlas; the file is opened read-only,
nothing is written beside it, and a statement has limits of time, of rows, and of the length of a value.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from threading import TIMEOUT_MAX, Timer
from time import monotonic
from typing import Any, NamedTuple

from enumerate.runner.store_units import COMPLAINTS, reading
from graphs.errors import InvariantError, UnsolvableError

__all__ = ["Rows", "open_guarded", "selected"]

_READABLE = {"type", "types", "relations", "atlas", "json_each", "json_tree"}
_ALLOWED = {sqlite3.SQLITE_SELECT, sqlite3.SQLITE_RECURSIVE}
_REFUSED = {
    "load_extension",
    "fts3_tokenizer",
    "randomblob",
    "zeroblob",
    "printf",
    "format",
    "trim",
    "ltrim",
    "rtrim",
}
"""Functions that do more than compute with what is there, or make values of any length, or take long in a step."""

_EXPECTED = "one SELECT on types or relations"
_STEPS = 10_000
"""Steps of SQLite's machine between two looks at the clock."""
_LONGEST_VALUE = 300_000
"""Bytes of a value, ten times those of the largest file: the slowest function then takes a second in one step."""
_LONGEST_STATEMENT = 20_000
_LONGEST_PATTERN = 200


class Rows(NamedTuple):
    """The rows that a statement selects; `more`: there are more than the limit."""

    columns: tuple[str, ...]
    rows: list[tuple[Any, ...]]
    more: bool


@contextmanager
def open_guarded(path: Path) -> Iterator[sqlite3.Connection]:
    """Open an atlas for statements that only select; StoreError if it is missing, or is no database."""
    with reading(path) as connection:
        connection.execute("PRAGMA temp_store=MEMORY")
        connection.execute("PRAGMA trusted_schema=OFF")
        connection.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, _LONGEST_VALUE)
        connection.setlimit(sqlite3.SQLITE_LIMIT_SQL_LENGTH, _LONGEST_STATEMENT)
        connection.setlimit(sqlite3.SQLITE_LIMIT_LIKE_PATTERN_LENGTH, _LONGEST_PATTERN)
        connection.setlimit(sqlite3.SQLITE_LIMIT_ATTACHED, 0)
        connection.execute("SELECT 1 FROM json_each('[]')")  # made when it is first used, which none may do later
        connection.set_authorizer(_authorized)
        yield connection


def _authorized(action: int, first: str | None, second: str | None, *_: str | None) -> int:
    if action in _ALLOWED:
        return sqlite3.SQLITE_OK
    if action == sqlite3.SQLITE_READ and (first or "").lower() in _READABLE:
        return sqlite3.SQLITE_OK
    if action == sqlite3.SQLITE_FUNCTION and (second or "").lower() not in _REFUSED:
        return sqlite3.SQLITE_OK
    return sqlite3.SQLITE_DENY


def selected(
    connection: sqlite3.Connection, statement: str, values: Sequence[Any], *, limit: int, seconds: float
) -> Rows:
    """Return what a statement selects, up to a limit of rows and of seconds; `values` are for its placeholders.

    The connection is from `open_guarded`. Raise InvariantError if the statement is no SELECT on what an atlas
    holds, with the message of SQLite; UnsolvableError if it takes longer.
    """
    try:
        with _stopped_after(connection, seconds):
            cursor = connection.execute(statement, values)
            rows = cursor.fetchmany(limit + 1)
    except sqlite3.OperationalError as error:
        if getattr(error, "sqlite_errorcode", sqlite3.SQLITE_OK) & 0xFF == sqlite3.SQLITE_INTERRUPT:
            raise UnsolvableError(
                f"the query takes longer than {seconds:g} s: narrow it, or give it more"
            ) from None
        raise InvariantError("statement", _said(error), _EXPECTED) from None
    except (*COMPLAINTS, ValueError, OverflowError) as error:
        raise InvariantError("statement", _said(error), _EXPECTED) from None
    if cursor.description is None:
        raise InvariantError("statement", "it selects nothing", _EXPECTED)
    return Rows(tuple(head[0] for head in cursor.description), rows[:limit], len(rows) > limit)


@contextmanager
def _stopped_after(connection: sqlite3.Connection, seconds: float) -> Iterator[None]:
    """Interrupt what SQLite does after some time.

    Another thread does so, since steps may be long. The look at the clock between many steps is for a statement
    that had not begun when the thread interrupted it.
    """
    end = monotonic() + seconds
    connection.set_progress_handler(lambda: monotonic() > end, _STEPS)
    timer = Timer(min(seconds, TIMEOUT_MAX), connection.interrupt)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
        timer.join()
        connection.set_progress_handler(None, 0)


def _said(error: Exception) -> str:
    """Return what is said of an error, in one printable line: it may quote the statement."""
    text = " ".join(str(error).split())[:300] or type(error).__name__
    return text if text.isprintable() else ascii(text)[1:-1]
