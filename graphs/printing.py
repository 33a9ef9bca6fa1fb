"""What is printed: lines and tables, the same on a terminal, in a file, as text and as HTML.

An answer gives its *blocks*, lines of text and `TableBlock`; the command line prints them with rich, ``str`` and
``_repr_html_`` of the answer make text and HTML of them.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from html import escape
from io import StringIO
from typing import TYPE_CHECKING, Any, Literal

from graphs.plain_text import plain, plain_lines

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

__all__ = ["Block", "Printed", "TableBlock", "html_of", "plain", "rich_table", "text_of"]

UNWRAPPED = 10_000
"""Columns of a page whose lines are not to be wrapped: a file, a pipe, a string."""


@dataclass(frozen=True, slots=True)
class TableBlock:
    """A table of texts.

    Attributes
    ----------
    columns : tuple of str
    rows : tuple of tuple of str
    numbers : collection of str
        The columns that are set flush right.

    Examples
    --------
    >>> print(text_of(["one freedom", TableBlock(("links", "chains"), [("6", "2"), ("8", "16")], ["chains"])]))
    one freedom
    <BLANKLINE>
     links   chains
     ──────────────
     6            2
     8           16
    """

    columns: tuple[str, ...]
    rows: Sequence[Sequence[str]]
    numbers: Collection[str] = ()

    def __rich__(self) -> Table:
        made = rich_table(*self.columns, numbers=self.numbers)
        for row in self.rows:
            made.add_row(*row)
        return made


Block = str | TableBlock
"""A line, or a table."""


def rich_table(*columns: str, numbers: Iterable[str] = (), title: str | None = None) -> Table:
    """Return an empty table; columns named in ``numbers`` are set flush right.

    Parameters
    ----------
    *columns : str
        Heads of the columns.
    numbers : iterable of str, optional
        Heads of the columns that are set flush right.
    title : str, optional
        Set above the table; brackets are no markup.

    Returns
    -------
    rich.table.Table
        Without rows.

    Examples
    --------
    >>> table = rich_table("n", "name", numbers=["n"])
    >>> [column.justify for column in table.columns]
    ['right', 'left']
    """
    from rich.box import SIMPLE_HEAD
    from rich.table import Table
    from rich.text import Text

    made = Table(
        box=SIMPLE_HEAD, title=None if title is None else Text(title), title_justify="left", pad_edge=False
    )
    flush = set(numbers)
    for column in columns:
        justify: Literal["left", "right"] = "right" if column in flush else "left"
        made.add_column(Text(column), justify=justify, overflow="fold")
    return made


def console_for(stream: Any, width: int | None) -> Console:
    """Return a console to which brackets are no markup, and which prints no control characters."""
    from rich.console import Console
    from rich.text import Text

    class PlainConsole(Console):
        """Every text that is printed, cells of tables too, comes through here."""

        def render_str(self, text: str, **how: Any) -> Text:
            return super().render_str(plain_lines(text), **how)

    return PlainConsole(file=stream, markup=False, highlight=False, emoji=False, soft_wrap=False, width=width)


def text_of(blocks: Iterable[Block]) -> str:
    """Return blocks as text, a line of the table a line.

    Parameters
    ----------
    blocks : iterable of str or TableBlock

    Returns
    -------
    str
        Without spaces at the ends of lines; lines are not wrapped.

    Examples
    --------
    >>> print(text_of(["two rows", TableBlock(("n", "name"), [("1", "one"), ("2", "two")], ["n"])]))
    two rows
    <BLANKLINE>
     n   name
     ────────
     1   one
     2   two
    """
    stream = StringIO()
    out = console_for(stream, UNWRAPPED)
    for block in blocks:
        out.print(block)
    return "\n".join(line.rstrip() for line in stream.getvalue().rstrip().split("\n"))


def html_of(blocks: Iterable[Block]) -> str:
    """Return blocks as HTML; names are escaped.

    Parameters
    ----------
    blocks : iterable of str or TableBlock

    Returns
    -------
    str
        A paragraph for a line, a ``table`` for a table.

    Examples
    --------
    >>> html_of(["a < b"])
    '<p>a &lt; b</p>'
    """
    return "\n".join(
        _html_table(block) if isinstance(block, TableBlock) else f"<p>{_html_text(block)}</p>" for block in blocks
    )


class Printed:
    """An answer that is printed everywhere as the command line prints it.

    Examples
    --------
    >>> class Freedoms(Printed):
    ...     def blocks(self):
    ...         return ["one freedom"]
    >>> print(Freedoms())
    one freedom
    """

    __slots__ = ()

    def blocks(self) -> list[Block]:
        """Return the lines and tables that are printed."""
        raise NotImplementedError

    def __str__(self) -> str:
        return text_of(self.blocks())

    def _repr_html_(self) -> str:
        return html_of(self.blocks())


def _html_text(text: str) -> str:
    return escape(plain_lines(text))


def _html_table(table: TableBlock) -> str:
    flush = [' style="text-align: right"' if column in table.numbers else "" for column in table.columns]

    def cells(texts: Sequence[str], tag: str) -> str:
        return "".join(
            f"<{tag}{style}>{_html_text(text)}</{tag}>" for style, text in zip(flush, texts, strict=True)
        )

    rows = "".join(f"<tr>{cells(row, 'td')}</tr>" for row in table.rows)
    return f"<table><thead><tr>{cells(table.columns, 'th')}</tr></thead><tbody>{rows}</tbody></table>"
