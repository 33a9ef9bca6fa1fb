"""What of a store is whole, and a store made of nothing else.

A store that is damaged is never written to: its units that are as they were written go into a new file, which
takes its place. The rows keep their numbers, so that units which are made again fill the gaps.
"""

from __future__ import annotations

import shutil
import sqlite3
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from enumerate.runner.store_units import COMPLAINTS, UnitTable, is_damage, make_tables, meta_in, named, reading
from graphs.errors import OpenError
from graphs.files.atomic import Unfinished, remove_folder

__all__ = ["Findings", "examined", "rebuilt"]


@dataclass(frozen=True, slots=True)
class Findings:
    """What a store says of itself (`meta`), and the numbers, rising, of its units that are as they were written.

    Sound: the file is a good database and holds these units, nothing else, and all of them if it says that it is
    complete.
    """

    meta: dict[str, Any]
    whole: tuple[int, ...]
    sound: bool


def examined(path: Path, units: int, looking: Callable[[float], None]) -> Findings:
    """Look at every page and every unit of a store whose job has so many units.

    `looking` takes the part of the rows that has been looked through, 0 to 1, after each unit. Raises `StoreError`
    if the file cannot be read as a store at all.
    """
    with reading(path) as connection:
        meta = meta_in(connection, path)
        table = UnitTable(connection, meta["columns"])
        whole = tuple(_whole(table, units, looking))
        sound = _is_good(connection) and _holds_only(connection, table, whole)
    return Findings(meta, whole, sound and (len(whole) == units or not meta["complete"]))


def _whole(table: UnitTable, units: int, looking: Callable[[float], None]) -> Iterator[int]:
    """Yield the numbers of the units that are as they were written."""
    total, seen = _promised(table), 0
    for number in range(units):
        rows = _rows(table, number)
        if rows is not None:
            yield number
            seen += len(rows)
            looking(min(seen / total, 1.0) if total > 0 else 1.0)


def _promised(table: UnitTable) -> float:
    """Return how many rows the entries of all units say; 0 if they cannot be read."""
    try:
        return table.promised()
    except COMPLAINTS as error:
        if not is_damage(error):
            raise
        return 0


def _rows(table: UnitTable, number: int) -> Sequence[Any] | None:
    """Return the rows of a unit; None if it is lost or altered."""
    try:
        return table.rows(number)
    except COMPLAINTS as error:
        if not is_damage(error):
            raise
        return None


def _is_good(connection: sqlite3.Connection) -> bool:
    try:
        return connection.execute("PRAGMA quick_check(1)").fetchall() == [("ok",)]
    except COMPLAINTS as error:
        if not is_damage(error):
            raise
        return False


def _holds_only(connection: sqlite3.Connection, table: UnitTable, whole: tuple[int, ...]) -> bool:
    """Return whether a good database has the units named, their rows, and no others."""
    if table.numbers() != list(whole):
        return False
    [rows] = connection.execute("SELECT count(*) FROM type").fetchone()
    return bool(table.promised() == rows)


def rebuilt(path: Path, findings: Findings) -> None:
    """Put a store that holds the whole units only in the place of a damaged one.

    Raises `StoreError` or `OpenError` if it cannot be written; the damaged one stays.
    """
    place = path.resolve()
    try:
        unfinished = Unfinished(place, folder=True)
    except OSError as error:
        raise OpenError(path, "", f"cannot be repaired: {error.strerror}", "a writable folder") from None
    made = unfinished.path / place.name
    try:
        with named(path):
            _copy(place, made, findings)
        shutil.copymode(place, made)
        for ending in ("-wal", "-shm", "-journal"):  # else SQLite would take them for those of the new one
            Path(f"{place}{ending}").unlink(missing_ok=True)
        made.replace(place)
    finally:
        remove_folder(unfinished.path)
        unfinished.release()


def _copy(source: Path, target: Path, findings: Findings) -> None:
    meta: Mapping[str, Any] = {**findings.meta, "complete": False}
    with closing(sqlite3.connect(target, isolation_level=None)) as made, reading(source) as damaged:
        made.execute("PRAGMA journal_mode=WAL")
        made.execute("BEGIN")
        make_tables(made, {key: value for key, value in meta.items() if key != "digest"})
        theirs, ours = UnitTable(damaged, meta["columns"]), UnitTable(made, meta["columns"])
        for number in findings.whole:
            unit, rows = theirs.entry(number), theirs.rows(number)
            assert unit is not None
            assert rows is not None  # they were read a moment ago
            ours.add(number, unit.first, rows, unit.seconds)
        made.execute("COMMIT")
