"""Text that leaves: one line, printable, not too long.

Names come from files. They may span lines, carry escape sequences, carriage returns and marks that turn the
direction of writing, hold millions of letters, or dollar signs that a picture takes for formulas. What is printed,
drawn, told in an error or put into a title goes through a function of this file; data that are written to be read
again (native files, stores, JSON) keep names as they are.
"""

from __future__ import annotations

__all__ = ["LONGEST_CELL", "plain", "plain_label", "plain_lines", "shown"]

LONGEST_CELL = 10_000
"""Most letters of a cell of a table: ids of large mechanisms are long, and are there to be copied."""
_WIDEST = 60
_CUT = "..."


def plain(value: object, widest: int = _WIDEST) -> str:
    r"""Return text that is safe to print: one line, no control characters, not too long.

    Parameters
    ----------
    value : object
        None becomes a dash.
    widest : int, optional
        Most letters; of longer text the head is left, and three dots.

    Returns
    -------
    str

    Examples
    --------
    >>> plain("\x1b[31mred")
    '\\x1b[31mred'
    >>> plain("a\u202eb", 6)
    'a\\u...'
    >>> plain(None)
    '-'
    """
    text = "-" if value is None else str(value)
    if len(text) <= widest and text.isprintable():
        return text
    text = _escaped(text[: widest + 1])  # escapes are not shorter than what they stand for
    return text if len(text) <= widest else text[: widest - len(_CUT)] + _CUT


def plain_lines(text: str) -> str:
    r"""Return text of several lines whose letters are all printable.

    Parameters
    ----------
    text : str

    Returns
    -------
    str
        Line feeds stay; other letters that do not print are written as escapes.

    Examples
    --------
    >>> plain_lines("one\r\ntwo\x07")
    'one\\r\ntwo\\x07'
    """
    return text if text.isprintable() else "\n".join(map(_escaped, text.split("\n")))


def plain_label(value: object, widest: int = _WIDEST) -> str:
    r"""Return text for a picture: as `plain` makes it, with dollar signs that begin no formula.

    Parameters
    ----------
    value : object
        None becomes a dash.
    widest : int, optional
        Most letters, before the dollar signs are marked.

    Returns
    -------
    str

    Examples
    --------
    >>> print(plain_label("$a$"))
    \$a\$
    """
    return plain(value, widest).replace("$", r"\$")


def shown(thing: object) -> str:
    r"""Return a short, one-line, printable form of anything in quotes, for use in messages.

    Parameters
    ----------
    thing : object
        Told by its ``repr``; of a long one the middle is left out.

    Returns
    -------
    str
        At most 60 letters.

    Examples
    --------
    >>> shown("A")
    "'A'"
    >>> shown("two\nlines")
    "'two\\nlines'"
    >>> len(shown("x" * 10_000))
    60
    """
    if isinstance(thing, str) and len(thing) > 2 * _WIDEST:
        thing = thing[:_WIDEST] + thing[-_WIDEST:]  # the middle is left out in any case
    text = ascii(thing) if isinstance(thing, str) and not thing.isprintable() else repr(thing)
    text = text if text.isprintable() else _escaped(text)  # what is no text may say of itself what it likes
    if len(text) > _WIDEST:
        half = (_WIDEST - len(_CUT)) // 2
        text = text[: _WIDEST - len(_CUT) - half] + _CUT + text[-half:]
    return text


def _escaped(text: str) -> str:
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode("ascii") for c in text)
