"""An open atlas: types by conditions, by SQL statements, and one type with all that is known of it.

The file is opened so that a statement, whoever wrote it, can read types and do nothing else: SQLite's authorizer
refuses all but SELECT on the views and tables of the atlas; the file is opened read-only, nothing is written
beside it, and a statement has limits of time, of rows, and of the length of a value. Theory: docs/theory/atlas.md.
"""

from __future__ import annotations

import re
import sqlite3
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from threading import TIMEOUT_MAX, Timer
from time import monotonic
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from enumerate.runner.store_units import COMPLAINTS, quoted, reading
from graphs.edit.named import known
from graphs.errors import InvariantError, StoreError, SynthedraError, UnsolvableError, numbered, shown
from graphs.plain_data import fields_to_json
from graphs.printing import Block, Printed, TableBlock, plain
from synth.synthesis.atlas.columns import COLUMNS, RELATIONS, SCHEMA, NamedType, named_types, text_values, value_of

if TYPE_CHECKING:
    import pandas

OwnValue: TypeAlias = bool | int | float | str | None
"""What a function for a column of one's own returns."""
_READABLE = {"type", "types", "relations", "atlas", "json_each", "json_tree"}
_ALLOWED = {sqlite3.SQLITE_SELECT, sqlite3.SQLITE_RECURSIVE}
_REFUSED = {
    "load_extension", "fts3_tokenizer", "randomblob", "zeroblob", "printf", "format", "trim", "ltrim", "rtrim",
}  # fmt: skip
"""Functions that do more than compute with values, make values of any length, or take long in a step."""

_STATEMENT = "statement"
"""The rule that a statement breaks which SQLite refuses."""
_EXPECTED = "one SELECT on types or relations"
_STEPS = 10_000
"""Steps of SQLite's machine between two checks of the clock."""
_LONGEST_VALUE = 300_000
"""Bytes of a value, ten times those of the largest file: the slowest function then takes a second in one step."""
_LONGEST_STATEMENT = 20_000
_LONGEST_PATTERN = 200

_QUOTED = re.compile(r"""'(?:[^']|'')*'|"(?:[^"]|"")*"|`(?:[^`]|``)*`|\[[^\]]*\]""")
"""A text or a name in quotes, in all four ways in which SQLite reads them."""
_CHAINED = re.compile(r"[<>]=?\s*\w+\s*[<>]")
_UNKNOWN_COLUMN = re.compile(r"no such column: (.+)")
_CONDITION = "an SQL expression such as links = 8 AND centres >= 3, with texts in single quotes"


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
        connection.execute("SELECT 1 FROM json_each('[]')")  # created at its first use, which is refused later
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
    """Return what a statement selects through a guarded connection, within limits; `values` are for placeholders.

    Raise InvariantError, with the message of SQLite, unless it selects from an atlas; UnsolvableError if it takes
    longer.
    """
    try:
        with _stopped_after(connection, seconds):
            cursor = connection.execute(statement, values)
            rows = cursor.fetchmany(limit + 1)
    except sqlite3.OperationalError as error:
        if getattr(error, "sqlite_errorcode", sqlite3.SQLITE_OK) & 0xFF == sqlite3.SQLITE_INTERRUPT:
            what = f"the query takes longer than {seconds:g} s"
            raise UnsolvableError(f"{what}; try a narrower one, or a longer time limit") from None
        raise InvariantError(_STATEMENT, _said(error), _EXPECTED) from None
    except (*COMPLAINTS, ValueError, OverflowError) as error:
        raise InvariantError(_STATEMENT, _said(error), _EXPECTED) from None
    if cursor.description is None:
        raise InvariantError(_STATEMENT, "the statement selects nothing", _EXPECTED)
    return Rows(tuple(head[0] for head in cursor.description), rows[:limit], len(rows) > limit)


def _where(condition: str) -> str:
    """Return the clause of a condition; InvariantError unless it is one expression.

    Brackets round it keep it apart from the statement that it becomes a part of. They hold only if its own brackets
    are balanced, and no comment or semicolon swallows what follows.
    """
    if not condition.strip():
        return ""
    bare = _QUOTED.sub("''", condition)
    depth = 0
    for sign in bare:
        depth += (sign == "(") - (sign == ")")
        if depth < 0:
            break
    if depth:
        raise InvariantError("condition", "its brackets do not match", _CONDITION)
    stray = next((sign for sign in ("--", "/*", ";") if sign in bare), None)
    if stray is not None:
        raise InvariantError("condition", f"{shown(stray)} is no part of an expression", _CONDITION)
    if _CHAINED.search(bare):
        # SQL compares the truth value of the first comparison with the third term: always true of 4 <= links <= 8
        raise InvariantError("condition", "two comparisons in a row", "links BETWEEN 4 AND 8, or AND between them")
    return f" WHERE ({condition})"


@contextmanager
def _condition_refused() -> Iterator[None]:
    """Say of what SQLite refuses that it is a condition, and list the columns where one is unknown."""
    try:
        yield
    except InvariantError as error:
        if error.rule != _STATEMENT:
            raise
        unknown = _UNKNOWN_COLUMN.fullmatch(error.offender)
        expected = _CONDITION if unknown is None else f"{known(COLUMNS, unknown[1])}; texts stand in single quotes"
        raise InvariantError("condition", error.offender, expected) from None


@contextmanager
def _stopped_after(connection: sqlite3.Connection, seconds: float) -> Iterator[None]:
    """Interrupt SQLite after some time, from another thread, since steps may be long.

    The check of the clock between many steps is for a statement that had not begun when it was interrupted.
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
    """Return the message of an error as one printable line: it may quote the statement."""
    text = " ".join(str(error).split())[:300] or type(error).__name__
    return text if text.isprintable() else ascii(text)[1:-1]


_MOST_NEIGHBOURS, _PRINTED = 200, 12
"""Neighbours that are listed, and those of each relation that are printed."""


@dataclass(frozen=True, slots=True)
class Neighbour:
    """A related type; `relation` is such as ``has the chain``, or ``is the chain of``.

    `there`: the atlas holds it.
    """

    relation: str
    id: str
    name: str | None
    there: bool

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return fields_to_json(self, keys={"there": "in_the_atlas"})


@dataclass(frozen=True, slots=True)
class TypeReport(Printed):
    """A type: its known values by column, its names, and its neighbours.

    `more` counts the neighbours that are not listed.
    """

    values: dict[str, Any]
    named: tuple[NamedType, ...]
    neighbours: tuple[Neighbour, ...]
    more: int

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on."""
        return {
            "type": {name: list(v) if isinstance(v, tuple) else v for name, v in self.values.items()},
            "names": [{"name": name.name, "source": name.source} for name in self.named],
            "neighbours": [neighbour.to_json() for neighbour in self.neighbours],
            "more_neighbours": self.more,
        }

    def blocks(self) -> list[Block]:
        """Return the lines that are printed."""
        lines: list[Block] = [f"{name.name}: {name.source}" for name in self.named]
        rows = [
            (name.replace("_", " "), value_text(value), COLUMNS[name].says)
            for name, value in self.values.items()
            if name != "fold_file"
        ]
        lines.append(TableBlock(("what", "value", "meaning"), rows))
        neighbours, unlisted = self.first_neighbours()
        if neighbours:
            lines.append(TableBlock(("relation", "id", "name", "in this atlas"), neighbours))
        if self.more + unlisted:
            lines.append(f"and {numbered(self.more + unlisted, 'more related type')}")
        return lines

    def first_neighbours(self) -> tuple[list[tuple[str, str, str, str]], int]:
        """Return rows of the first neighbours of each relation, named ones first; and the number of the others."""
        ranked = sorted(self.neighbours, key=lambda neighbour: (neighbour.relation, neighbour.name is None))
        rows: list[tuple[str, str, str, str]] = []
        listed: Counter[str] = Counter()
        for neighbour in ranked:
            listed[neighbour.relation] += 1
            if listed[neighbour.relation] <= _PRINTED:
                there = "" if neighbour.there else "no"
                rows.append((neighbour.relation, neighbour.id, neighbour.name or "", there))
        return rows, len(ranked) - len(rows)

    def __repr__(self) -> str:
        return f"<TypeReport: {plain(self.values['id'])}>"


def report_of(connection: sqlite3.Connection, code: str, path: Path) -> TypeReport | None:
    """Return the report of a type of an atlas by its id, or its name; None if there is none.

    Raise StoreError, with the path of the atlas, if it is damaged.
    """
    row = None
    for column in ("id", "name", "stands_for"):
        statement = f"SELECT {quoted(COLUMNS)} FROM type WHERE {column} = ? LIMIT 1"
        row = row or connection.execute(statement, (code,)).fetchone()
    if row is None:
        return None
    read = {name: value_of(path, name, value) for name, value in zip(COLUMNS, row, strict=True)}
    values = {name: value for name, value in read.items() if value is not None}
    neighbours, more = _neighbours(connection, values["id"], path)
    named = tuple(entry for entry in named_types() if entry.id == values["id"])
    return TypeReport(values, named, tuple(neighbours), more)


def _neighbours(connection: sqlite3.Connection, code: str, path: Path) -> tuple[list[Neighbour], int]:
    """Return the types to which a type is related, and those related to it; and the number of further ones."""
    known = "(SELECT name FROM type WHERE type.id = {0} LIMIT 1), EXISTS (SELECT 1 FROM type WHERE type.id = {0})"
    onward = connection.execute(
        f"SELECT relation, other, {known.format('other')} FROM relations WHERE id = ?", (code,)
    ).fetchall()
    backward = connection.execute(
        f"SELECT relation, id, {known.format('relations.id')} FROM relations WHERE other = ? AND id <> ? LIMIT ?",
        (code, code, _MOST_NEIGHBOURS + 1),
    ).fetchall()
    text_values(path, "the id of a related type", (related for _, related, *_ in (*onward, *backward)))
    neighbours = [
        Neighbour(relation, other, name, bool(there)) for relation, other, name, there in onward if other != code
    ]
    neighbours += [
        Neighbour(_REVERSED[relation], other, name, True) for relation, other, name, _ in backward[:_MOST_NEIGHBOURS]
    ]
    if len(backward) <= _MOST_NEIGHBOURS:
        return neighbours, 0
    [every] = connection.execute("SELECT count(*) FROM relations WHERE other = ? AND id <> ?", (code, code)).fetchone()
    return neighbours, every - _MOST_NEIGHBOURS


_REVERSED = dict(RELATIONS.values())


def value_text(value: Any) -> str:
    """Return a value of a column as it is printed; empty if it is unknown."""
    if isinstance(value, tuple):
        return ",".join(map(str, value))
    if isinstance(value, bool):
        return "yes" if value else "no"
    return "" if value is None else f"{value:.6g}" if isinstance(value, float) else plain(value, 10_000)


_LIMIT, _SECONDS = 1000, 30.0
"""Default limits of rows and seconds of a query."""
_WHOLE_FILE = "fold_file"
"""The column that is left out by default: a file each."""
_SHOWN = ("id", "kind", "name", "links", "joints", "dof", "centres", "all_explicit", "symmetry")
"""Columns that are printed by default."""


@dataclass(frozen=True, slots=True)
class AtlasRows(Printed):
    """Types that a query selects: for each, a value for each column.

    A value is None if it is unknown, or the kind of type has none; `more`: there are more than the limit.
    """

    columns: tuple[str, ...]
    rows: list[dict[str, Any]]
    more: bool

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return iter(self.rows)

    def to_json(self) -> list[dict[str, Any]]:
        """Return the rows as plain data."""
        return [{name: _plain_data(value) for name, value in row.items()} for row in self.rows]

    def with_columns(self, functions: Mapping[str, Callable[[Any], OwnValue]]) -> AtlasRows:
        """Return the rows with columns of one's own, each the value of a function for the mechanism of a row.

        Parameters
        ----------
        functions : mapping of str to callable
            Name of a column to a function, which takes an SC graph, an SCD graph, a string or an order of joints
            and returns a number, a text, a truth value or None.

        Raises
        ------
        InvariantError
            If a column of the name exists, or the rows have no columns ``kind`` and ``id``.
        UnsolvableError
            If a function fails, or returns anything else.

        Examples
        --------
        >>> rows = AtlasRows(("id", "kind"), [{"id": "k1:Cr", "kind": "chain"}], False)
        >>> rows.with_columns({"edges": lambda chain: len(chain.joints)}).rows
        [{'id': 'k1:Cr', 'kind': 'chain', 'edges': 4}]
        """
        if not {"id", "kind"} <= set(self.columns):
            raise InvariantError("query", "rows without id and kind", "both columns, for columns of one's own")
        for name in functions:
            if name in self.columns or name in COLUMNS:
                raise InvariantError("column", f"there is a column {shown(name)} already", "another name")
        rows = [
            {**row, **{name: _own_value(name, function, row) for name, function in functions.items()}}
            for row in self.rows
        ]
        return AtlasRows((*self.columns, *functions), rows, self.more)

    def to_frame(self) -> pandas.DataFrame:
        """Return the rows as a data frame; UnsolvableError if pandas is not installed."""
        try:
            import pandas
        except ImportError:
            raise UnsolvableError("a data frame needs pandas: pip install pandas") from None
        return pandas.DataFrame(self.rows, columns=list(self.columns))

    def blocks(self) -> list[Block]:
        """Return the table that is printed, and a line where there are more rows."""
        if not self.rows:
            return ["no types"]
        names = self.columns if set(self.columns) != set(_all_columns()) else _SHOWN
        numbers = [name for name in names if name in COLUMNS and COLUMNS[name].holds in (int, float)]
        texts = [[value_text(row[name]) for name in names] for row in self.rows]
        heads = tuple(name.replace("_", " ") for name in names)
        table = TableBlock(heads, texts, [name.replace("_", " ") for name in numbers])
        return [table, *["there are more types"] * self.more]

    def __repr__(self) -> str:
        return f"<AtlasRows: {numbered(len(self.rows), 'type')}{', of more' if self.more else ''}>"


def _own_value(name: str, function: Callable[[Any], OwnValue], row: Mapping[str, Any]) -> OwnValue:
    """Return the value of a function for the mechanism of a row."""
    from synth.making.drawing.list_pages import drawable_of_type

    mechanism = drawable_of_type(row["kind"], row["id"])
    try:
        value = function(mechanism)
    except Exception as error:  # any code of a user
        failed = f"column {shown(name)} failed for {row['id']}: {type(error).__name__}: {plain(error, 300)}"
        raise UnsolvableError(failed) from error
    value = value.item() if isinstance(value, np.generic) else value
    if value is not None and not isinstance(value, bool | int | float | str):
        got = f"column {shown(name)} of {row['id']} is of type {type(value).__name__}"
        raise UnsolvableError(f"{got}; expected a number, a text, a truth value or None")
    return value


@dataclass(frozen=True)
class Atlas:
    """An atlas in a file, opened anew for each question.

    Attributes
    ----------
    path : Path

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from synth.synthesis.atlas import AtlasPlan, build_atlas
    >>> with TemporaryDirectory() as folder:
    ...     _ = build_atlas(f"{folder}/a.sqlite", AtlasPlan(4, creases=0, orders_of=(), realised=False))
    ...     rows = Atlas(Path(folder) / "a.sqlite").query("all_explicit AND vertices <= 6")
    >>> [(row["id"], row["vertices"]) for row in rows]
    [('m1:a-b.ac-.b-d.cd-', 5), ('m1:a--b.ac-.b-d.cd-', 6)]
    """

    path: Path

    def query(
        self,
        condition: str = "",
        *,
        columns: Sequence[str] = (),
        sort: str = "",
        limit: int = _LIMIT,
        seconds: float = _SECONDS,
    ) -> AtlasRows:
        """Return the types that fulfil a condition.

        Parameters
        ----------
        condition : str, optional
            An SQL expression on columns; without it, all types. Lists are JSON: ``assortment = '[4,2]'``, or
            ``5 IN (SELECT value FROM json_each(loop_sizes))``. As in SQL, a type without a value fulfils no
            condition on it, negated or not, but ``IS NULL``.
        columns : sequence of str, optional
            By default all but the files.
        sort : str, optional
            A column; with ``-`` before it, descending. By default in the order in which types were listed.
        limit : int, optional
            Largest number of rows.
        seconds : float, optional
            Time limit.

        Raises
        ------
        InvariantError
            If there is no such column, the condition is no single expression, or SQLite refuses it.
        UnsolvableError
            If it takes longer.
        """
        selection = tuple(map(_column, columns)) or _all_columns()
        where, order = _where(condition), "rowid"
        if sort:
            name = _column(sort.removeprefix("-"))
            order = f'"{name}" {"DESC" if sort.startswith("-") else "ASC"} NULLS LAST, rowid'
        statement = f"SELECT {quoted(selection)} FROM type{where} ORDER BY {order} LIMIT {int(limit) + 1}"
        with _condition_refused():
            rows = self._selected(statement, limit, seconds)
        return AtlasRows(selection, [self._row(selection, row) for row in rows.rows], rows.more)

    def sql(self, statement: str, *, limit: int = _LIMIT, seconds: float = _SECONDS) -> AtlasRows:
        """Return the selection of a statement from ``types`` and ``relations``; values are as they are stored.

        Raise InvariantError if it is no SELECT, or SQLite refuses it; UnsolvableError if it takes longer.
        """
        rows = self._selected(statement, limit, seconds)
        return AtlasRows(rows.columns, [dict(zip(rows.columns, row, strict=True)) for row in rows.rows], rows.more)

    def show(self, code: str) -> TypeReport:
        """Return all that is known of a type, by its id or name, and of the types it is related to.

        Raise InvariantError if the atlas holds no such type.
        """
        with open_guarded(self.path) as connection:
            report = report_of(connection, code, self.path)
        if report is None:
            what = f"the atlas holds no type {shown(code)}"
            raise InvariantError("atlas", what, "an id or a name that synth atlas query prints")
        return report

    def about(self) -> dict[str, Any]:
        """Return the version of the schema and of synthedra, the command, and the numbers of types."""
        with open_guarded(self.path) as connection:
            row = connection.execute("SELECT schema, synthedra, command FROM atlas").fetchone()
            counts = dict(connection.execute("SELECT kind, count(*) FROM types GROUP BY kind"))
        schema, version, command = row or (None, None, None)
        text_values(self.path, "the command", [version, command])
        types = {value_of(self.path, "kind", kind): number for kind, number in counts.items()}
        return {"schema": schema, "synthedra": version, "command": command, "types": types}

    def ids(self, codes: Sequence[str]) -> list[dict[str, Any]]:
        """Return the rows of the types with some ids, in the order of the ids; of a string, that of its panels."""
        types: list[dict[str, Any]] = []
        with open_guarded(self.path) as connection:
            for code in dict.fromkeys(codes):
                for column in ("id", "panels"):
                    statement = f"SELECT {quoted(_all_columns())} FROM type WHERE {column} = ?"
                    rows = selected(connection, statement, (code,), limit=_LIMIT, seconds=_SECONDS)
                    types += [self._row(_all_columns(), row) for row in rows.rows]
        return types

    def _row(self, names: Sequence[str], row: Sequence[Any]) -> dict[str, Any]:
        return {name: value_of(self.path, name, value) for name, value in zip(names, row, strict=True)}

    def _selected(self, statement: str, limit: int, seconds: float) -> Rows:
        if limit < 1 or not seconds > 0:
            expected = "1 or more rows in more than 0 s"
            raise InvariantError("query", f"{numbered(limit, 'row')} in {seconds} s", expected)
        with open_guarded(self.path) as connection:
            return selected(connection, statement, (), limit=limit, seconds=seconds)

    def __repr__(self) -> str:
        return f"<Atlas: {plain(self.path, 200)}>"


def open_atlas(path: str | Path) -> Atlas:
    """Open an atlas that `synth atlas build` made.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    Atlas

    Raises
    ------
    StoreError
        If there is no such file, or it is no atlas of this version.

    Examples
    --------
    >>> open_atlas("nowhere.sqlite")
    Traceback (most recent call last):
    ...
    graphs.errors.StoreError: nowhere.sqlite: no such file
    """
    place = Path(path)
    with open_guarded(place) as connection:
        try:
            row = selected(connection, "SELECT schema, synthedra FROM atlas", (), limit=1, seconds=_SECONDS).rows
        except SynthedraError:
            what = "is no atlas, or one that is not finished; try synth atlas build -o FILE --resume"
            raise StoreError(f"{place}: {what}") from None
    if not row or row[0][0] != SCHEMA:
        version = f"version {shown(row[0][0])}, of synthedra {plain(row[0][1])}" if row else "no version"
        raise StoreError(f"{place}: is an atlas of {version}; expected version {SCHEMA}; try to build it again")
    return Atlas(place)


def _all_columns() -> tuple[str, ...]:
    return tuple(name for name in COLUMNS if name != _WHOLE_FILE)


def _column(name: str) -> str:
    if name not in COLUMNS:
        raise InvariantError("column", f"there is no column {shown(name)}", known(COLUMNS, name))
    return name


def _plain_data(value: Any) -> Any:
    if isinstance(value, tuple):
        return [_plain_data(item) for item in value]
    if isinstance(value, bytes):
        return value.hex()
    return None if isinstance(value, float) and not isfinite(value) else value
