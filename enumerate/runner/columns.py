"""What the columns of rows hold: a number or text, or a list of them.

A list is a tuple in a row, of numbers or text, or of tuples of them. JSON and Parquet get it as a list, a store as
JSON text, and a table as the text that its column makes of it.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from graphs.printing import plain

__all__ = ["Column", "ListColumn", "RangeColumn", "row_as_dict", "stored", "unstored"]


@dataclass(frozen=True, slots=True)
class ListColumn:
    """A column of lists; `between` parts the items in a table.

    Where the items are lists themselves, `within` parts their values, else it is empty; `before_last` stands
    before the last of these, if it is something else: the name before a number. `kind` is the type of all values,
    None where they differ.

    >>> ListColumn(" ", "-", ":", None).text((("a", "b", 28.15), ("b", "c", 30.0)))
    'a-b:28.15 b-c:30'
    """

    between: str
    within: str = ""
    before_last: str = ""
    kind: type | None = int

    def text(self, values: tuple[Any, ...]) -> str:
        """Return how a table shows a list."""
        return self.between.join(map(self.item_text, values))

    def item_text(self, item: Any) -> str:
        """Return how a table shows an item; names come from files, so they may be long."""
        if not isinstance(item, tuple):
            return f"{item:.12g}" if isinstance(item, float) else plain(item)
        *first, last = map(self.item_text, item)
        return self.within.join(first) + (self.before_last or self.within) + last


@dataclass(frozen=True, slots=True)
class RangeColumn(ListColumn):
    """A column of lists of (least, greatest); a table shows those that are equal once.

    >>> RangeColumn(" ", "..").text(((0, 1), (1, 1)))
    '0..1 1'
    """

    def item_text(self, item: Any) -> str:
        """Return how a table shows least and greatest."""
        least, greatest = item
        return str(least) if least == greatest else f"{least}{self.within}{greatest}"


Column = type | ListColumn
"""int, str, bool or float; or a column of lists."""


def row_as_dict(columns: Iterable[str], row: tuple[Any, ...]) -> dict[str, Any]:
    """Return a row as a dictionary of its columns, with lists for tuples."""
    return {
        name: _as_list(value) if isinstance(value, tuple) else value
        for name, value in zip(columns, row, strict=True)
    }


def _as_list(value: Any) -> Any:
    return [_as_list(item) for item in value] if isinstance(value, tuple) else value


def stored(values: tuple[Any, ...] | None) -> str | None:
    """Return a list as compact JSON text; None where a row has none."""
    return None if values is None else json.dumps(values, separators=(",", ":"))


def unstored(text: str | None) -> tuple[Any, ...] | None:
    """Return the list of a JSON text, as it stands in a row."""
    return None if text is None else tuple(_as_tuple(item) for item in json.loads(text))


def _as_tuple(value: Any) -> Any:
    return tuple(map(_as_tuple, value)) if isinstance(value, list) else value
