"""Text that leaves: printable and not too long, as lines and tables, for a terminal, a file, a page.

Names come from files: they may span lines, carry escape sequences, hold millions of letters. Whatever is printed,
drawn or put into an error or a title goes through this file; data that are written to be read again (native files,
stores, JSON) keep names as they are. An answer has *blocks*, lines of text and `TableBlock`; the command line
prints them with rich, ``str`` and ``_repr_html_`` of the answer make text and HTML of them.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from html import escape
from io import StringIO
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

__all__ = [
    "LONGEST_CELL",
    "Block",
    "Printed",
    "TableBlock",
    "html_of",
    "plain",
    "plain_lines",
    "rich_table",
    "shown",
    "text_of",
]

LONGEST_CELL = 10_000
"""Most letters of a cell of a table: ids of large mechanisms are long, and are there to be copied."""
_WIDEST = 60  # letters of a value in a sentence: with the sentence round it a line of a terminal, 80 columns
_CUT = "..."


def plain(value: object, widest: int = _WIDEST) -> str:
    r"""Return text that is safe to print: one line of at most ``widest`` printable letters; None is a dash.

    >>> plain("\x1b[31mred"), plain("a\u202eb", 6), plain(None)
    ('\\x1b[31mred', 'a\\u...', '-')
    """
    text = "-" if value is None else str(value)
    if len(text) <= widest and text.isprintable():
        return text
    text = _escaped(text[: widest + 1])  # escapes are not shorter than what they stand for
    return text if len(text) <= widest else text[: widest - len(_CUT)] + _CUT


def plain_lines(text: str) -> str:
    r"""Return text of several lines: line feeds stay, other letters that do not print are written as escapes.

    >>> plain_lines("one\r\ntwo\x07")
    'one\\r\ntwo\\x07'
    """
    return text if text.isprintable() else "\n".join(map(_escaped, text.split("\n")))


def shown(value: object) -> str:
    r"""Return the ``repr`` of a value in one printable line of at most 60 letters, for messages.

    >>> shown("two\nlines"), len(shown("x" * 10_000))
    ("'two\\nlines'", 60)
    """
    if isinstance(value, str) and len(value) > 2 * _WIDEST:
        value = value[:_WIDEST] + value[-_WIDEST:]  # the middle is left out in any case
    text = ascii(value) if isinstance(value, str) and not value.isprintable() else repr(value)
    text = text if text.isprintable() else _escaped(text)  # the repr of other objects may hold any letters
    if len(text) > _WIDEST:
        half = (_WIDEST - len(_CUT)) // 2
        text = text[: _WIDEST - len(_CUT) - half] + _CUT + text[-half:]
    return text


def _escaped(text: str) -> str:
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode("ascii") for c in text)


UNWRAPPED = 10_000
"""Columns of a page whose lines are not to be wrapped: a file, a pipe, a string."""


@dataclass(frozen=True, slots=True)
class TableBlock:
    """A table of texts; columns named in ``numbers`` are set flush right."""

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
    """Return an empty table with heads of columns; those named in ``numbers`` are set flush right.

    Brackets in the title are no markup.
    """
    from rich.box import SIMPLE_HEAD
    from rich.table import Table
    from rich.text import Text

    made = Table(box=SIMPLE_HEAD, title=None if title is None else Text(title), title_justify="left", pad_edge=False)
    flush = set(numbers)
    for column in columns:
        justify: Literal["left", "right"] = "right" if column in flush else "left"
        made.add_column(Text(column), justify=justify, overflow="fold")
    return made


def console_for(stream: Any, width: int | None) -> Console:
    """Return a console to which brackets are no markup, and which prints no control characters.

    In a notebook it writes to the stream too, instead of beside it.
    """
    from rich.console import Console
    from rich.text import Text

    class PlainConsole(Console):
        """Every text that is printed, cells of tables too, comes through here."""

        def render_str(self, text: str, **how: Any) -> Text:
            return super().render_str(plain_lines(text), **how)

    return PlainConsole(
        file=stream, markup=False, highlight=False, emoji=False, soft_wrap=False, width=width, force_jupyter=False
    )


def text_of(blocks: Iterable[Block]) -> str:
    """Return blocks as text, without spaces at the ends of lines; lines are not wrapped.

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
    """Return blocks as HTML, a paragraph per line and a ``table`` per table; names are escaped.

    >>> html_of(["a < b"])
    '<p>a &lt; b</p>'
    """
    return "\n".join(
        _html_table(block) if isinstance(block, TableBlock) else f"<p>{_html_text(block)}</p>" for block in blocks
    )


class Printed:
    """An answer that is printed everywhere as the command line prints it; subclasses define `blocks`."""

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
    flush = [f' style="text-align: {"right" if column in table.numbers else "left"}"' for column in table.columns]

    def cells(texts: Sequence[str], tag: str) -> str:
        return "".join(f"<{tag}{style}>{_html_text(text)}</{tag}>" for style, text in zip(flush, texts, strict=True))

    rows = "".join(f"<tr>{cells(row, 'td')}</tr>" for row in table.rows)
    return f"<table><thead><tr>{cells(table.columns, 'th')}</tr></thead><tbody>{rows}</tbody></table>"
