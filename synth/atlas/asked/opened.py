"""An atlas that is asked: types by conditions, by statements, one type with all that is known of it.

Theory: docs/theory/atlas.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from graphs.edit.named import known
from graphs.errors import InvariantError, StoreError, SynthedraError, UnsolvableError, shown
from graphs.printing import Block, Printed, TableBlock, plain
from synth.atlas.asked.expression import condition_of
from synth.atlas.asked.guarded import Rows, open_guarded, selected
from synth.atlas.asked.type_report import TypeReport, report_of
from synth.atlas.asked.values import text_values, value_of
from synth.atlas.columns import COLUMNS, SCHEMA, stored_columns

if TYPE_CHECKING:
    import pandas

__all__ = ["Atlas", "AtlasRows", "open_atlas"]

_LIMIT, _SECONDS = 1000, 30.0
"""Rows and seconds of a query, at most, where nothing else is said."""
_WHOLE_FILE = "fold_file"
"""The column that is left out where none are named: a file each."""
_SHOWN = ("id", "kind", "name", "links", "joints", "dof", "centres", "all_explicit", "symmetry")
"""Columns that are printed where none are named."""


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
            return ["none"]
        names = self.columns if set(self.columns) != set(_all_columns()) else _SHOWN
        numbers = [name for name in names if name in COLUMNS and COLUMNS[name].holds in (int, float)]
        texts = [[_cell(row[name]) for name in names] for row in self.rows]
        table = TableBlock(
            tuple(name.replace("_", " ") for name in names), texts, [n.replace("_", " ") for n in numbers]
        )
        return [table, *["there are more"] * self.more]

    def __repr__(self) -> str:
        return f"<AtlasRows: {len(self.rows)} types{', of more' if self.more else ''}>"


@dataclass(frozen=True)
class Atlas:
    """An atlas in a file, opened anew for each question.

    Attributes
    ----------
    path : Path

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from synth.atlas import AtlasPlan, build_atlas
    >>> with TemporaryDirectory() as folder:
    ...     _ = build_atlas(f"{folder}/a.sqlite", AtlasPlan(4, creases=0, orders_of=(), realised=False))
    ...     rows = Atlas(Path(folder) / "a.sqlite").query("all_explicit and vertices <= 6")
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
            In the words of `synth.atlas.asked.expression`; without it, all.
        columns : sequence of str, optional
            By default all but the files.
        sort : str, optional
            A column; with ``-`` before it, falling. By default in the order in which types were listed.
        limit : int, optional
        seconds : float, optional

        Raises
        ------
        ExpressionError
            If the condition cannot be read.
        InvariantError
            If there is no such column.
        UnsolvableError
            If it takes longer.
        """
        _check_limits(limit, seconds)
        wanted = tuple(map(_column, columns)) or _all_columns()
        where, values = ("", ())
        if condition.strip():
            made = condition_of(condition, stored_columns())
            where, values = f" WHERE {made.sql}", made.values
        order = "rowid"
        if sort:
            name = _column(sort.removeprefix("-"))
            order = f'"{name}" {"DESC" if sort.startswith("-") else "ASC"} NULLS LAST, rowid'
        names = ", ".join(f'"{name}"' for name in wanted)
        rows = self._selected(
            f"SELECT {names} FROM type{where} ORDER BY {order} LIMIT ?", (*values, limit + 1), limit, seconds
        )
        return AtlasRows(wanted, [self._row(wanted, row) for row in rows.rows], rows.more)

    def sql(self, statement: str, *, limit: int = _LIMIT, seconds: float = _SECONDS) -> AtlasRows:
        """Return what a statement selects from ``types`` and ``relations``; values are as they are stored.

        Raises
        ------
        InvariantError
            If it is no SELECT, or SQLite does not take it.
        UnsolvableError
            If it takes longer.
        """
        _check_limits(limit, seconds)
        rows = self._selected(statement, (), limit, seconds)
        return AtlasRows(rows.columns, [dict(zip(rows.columns, row, strict=True)) for row in rows.rows], rows.more)

    def show(self, code: str) -> TypeReport:
        """Return all that is known of a type, and of those it is related to.

        Parameters
        ----------
        code : str
            Its id, or a name.

        Raises
        ------
        InvariantError
            If the atlas holds no such type.
        """
        with open_guarded(self.path) as connection:
            found = report_of(connection, code, self.path)
        if found is None:
            raise InvariantError(
                "atlas", f"holds no type {shown(code)}", "an id or a name that synth atlas query prints"
            )
        return found

    def about(self) -> dict[str, Any]:
        """Return what the atlas says of itself: version of its schema, of synthedra, command, numbers of types."""
        with open_guarded(self.path) as connection:
            row = connection.execute("SELECT schema, synthedra, command FROM atlas").fetchone()
            counts = dict(connection.execute("SELECT kind, count(*) FROM types GROUP BY kind"))
        schema, version, command = row or (None, None, None)
        text_values(self.path, "the command", [version, command])
        types = {value_of(self.path, "kind", kind): number for kind, number in counts.items()}
        return {"schema": schema, "synthedra": version, "command": command, "types": types}

    def ids(self, codes: Sequence[str]) -> list[dict[str, Any]]:
        """Return the rows of the types with some ids, in the order of the ids; of a string, that of its panels."""
        names = ", ".join(f'"{name}"' for name in _all_columns())
        found = []
        with open_guarded(self.path) as connection:
            for code in dict.fromkeys(codes):
                for column in ("id", "panels"):
                    statement = f"SELECT {names} FROM type WHERE {column} = ?"
                    rows = selected(connection, statement, (code,), limit=_LIMIT, seconds=_SECONDS)
                    found += [self._row(_all_columns(), row) for row in rows.rows]
        return found

    def _row(self, names: Sequence[str], row: Sequence[Any]) -> dict[str, Any]:
        return {name: value_of(self.path, name, value) for name, value in zip(names, row, strict=True)}

    def _selected(self, statement: str, values: Sequence[Any], limit: int, seconds: float) -> Rows:
        with open_guarded(self.path) as connection:
            return selected(connection, statement, values, limit=limit, seconds=seconds)

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
            told = "is no atlas, or one that was not finished: synth atlas build -o FILE --resume"
            raise StoreError(f"{place}: {told}") from None
    if not row or row[0][0] != SCHEMA:
        version = f"version {shown(row[0][0])}, of synthedra {plain(row[0][1])}" if row else "no version"
        raise StoreError(f"{place}: is an atlas of {version}; this one reads version {SCHEMA}: build it again")
    return Atlas(place)


def _check_limits(limit: int, seconds: float) -> None:
    if limit < 1 or not seconds > 0:
        raise InvariantError("query", f"{limit} rows in {seconds} s", "1 or more rows, in more than 0 s")


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


def _cell(value: Any) -> str:
    if isinstance(value, tuple):
        return ",".join(map(str, value))
    if isinstance(value, bool):
        return "yes" if value else "no"
    return "" if value is None else f"{value:.6g}" if isinstance(value, float) else plain(value, 10_000)
