"""Conditions on types in the words of the columns, translated into SQL with the values apart.

::

    condition   = conjunction {"or" conjunction}
    conjunction = negation {"and" negation}
    negation    = "not" negation | "(" condition ")" | comparison
    comparison  = value {("=" | "!=" | "<" | "<=" | ">" | ">=") value}     as in 4 <= links <= 8
                | column ["not"] "in" "(" value {"," value} ")"
                | column ["not"] "between" value "and" value
                | column ["not"] "like" text                              % for any letters, _ for one
                | list column ["not"] "contains" value
                | column "is" ["not"] "known"
                | column                                                  of yes or no
    value       = number | text in quotes | word | column | "(" numbers ")" | "true" | "false"

A type for which a value is unknown fulfils no condition on it, negated or not. Theory: docs/theory/atlas.md.
"""

import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any, NamedTuple, NoReturn

from enumerate.runner.job import Column, ListColumn, stored
from graphs.edit.named import known
from graphs.errors import InvariantError, shown
from graphs.printing import plain

_LONGEST, _DEEPEST = 10_000, 60
"""Most letters of an expression, and most nested brackets."""
_AROUND = 40
"""Letters shown of the word that is wrong, and on either side of it."""

_TOKEN = re.compile(
    r"""\s*(?:(?P<number>[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)(?![\w.])
        |(?P<text>'(?:[^']|'')*'|"(?:[^"]|"")*")
        |(?P<word>[^\W\d]\w*)
        |(?P<sign><=|>=|!=|<>|==|[=<>(),])
        |(?P<odd>[\w.]+|\S))""",
    re.VERBOSE,
)
_SIGNS = {"=": "=", "==": "=", "!=": "<>", "<>": "<>", "<": "<", "<=": "<=", ">": ">", ">=": ">="}
_HELD = {int: "a number", str: "a text", tuple: "a list of numbers"}
_KEYWORDS = ("and", "or", "not", "in", "between", "like", "contains", "is", "known", "true", "false")


class ExpressionError(InvariantError):
    """A condition that cannot be read; the message shows the word in square brackets where it stands."""


class Condition(NamedTuple):
    """A condition as SQL, with a mark for each value, and the values."""

    sql: str
    values: tuple[Any, ...] = ()


class _Token(NamedTuple):
    """A part of an expression: the name of its group in `_TOKEN`, or ``end``, its text, and where it is."""

    kind: str
    text: str
    start: int
    end: int


class _Operand(NamedTuple):
    """A column or a value: its SQL, its values, what it holds (int for numbers, yes and no; str; tuple)."""

    token: _Token
    holds: type
    sql: str
    values: tuple[Any, ...] = ()
    column: str | None = None


def condition_of(expression: str, columns: Mapping[str, Column]) -> Condition:
    """Return the SQL of a condition.

    Parameters
    ----------
    expression : str
    columns : mapping of name to type or ListColumn

    Raises
    ------
    ExpressionError
        If it cannot be read, names no column, or compares numbers with text.

    Examples
    --------
    >>> columns = {"links": int, "kind": str, "planar": bool, "assortment": ListColumn(",")}
    >>> condition_of("links >= 8 and (planar or kind = 'sc')", columns)
    Condition(sql='("links" >= ? AND ("planar" = 1 OR "kind" = ?))', values=(8, 'sc'))
    """
    return _Reader(expression, columns).whole()


class _Reader:
    """Reads an expression from left to right."""

    def __init__(self, expression: str, columns: Mapping[str, Column]) -> None:
        self._text, self._columns = expression, columns
        if len(expression) > _LONGEST:
            raise ExpressionError("condition", f"{len(expression)} letters", f"{_LONGEST} at most")
        self._tokens = list(self._split())
        self._next, self._depth = 0, 0

    def _split(self) -> Iterator[_Token]:
        for match in _TOKEN.finditer(self._text):
            kind = str(match.lastgroup)
            token = _Token(kind, match[kind], *match.span(kind))
            if token.text in "'\"":
                self._wrong(token, "a text does not end", f"a second {token.text}")
            if kind == "odd":
                expected = "a column, a number, a text in quotes, and, or, not"
                self._wrong(token, f"{shown(token.text)} has no meaning here", expected)
            yield token
        end = len(self._text.rstrip())
        yield _Token("end", "", end, end)

    def whole(self) -> Condition:
        """Return the condition; nothing may be left."""
        if self._peek().kind == "end":
            raise ExpressionError("condition", "the condition is empty", "one such as links = 8 and centres >= 3")
        condition = self._condition()
        if self._peek().kind != "end":
            self._wrong(self._peek(), f"{shown(self._peek().text)} follows a whole condition", "and, or, the end")
        return condition

    def _peek(self) -> _Token:
        return self._tokens[self._next]

    def _take(self) -> _Token:
        token = self._tokens[self._next]
        self._next += token.kind != "end"
        return token

    def _takes(self, *words: str) -> bool:
        """Take the next token if it is one of the words or signs."""
        token = self._peek()
        if token.kind in ("word", "sign") and token.text.lower() in words:
            self._next += 1
            return True
        return False

    def _must_take(self, word: str) -> None:
        if not self._takes(word):
            token = self._peek()
            self._wrong(token, f"{shown(token.text) if token.text else 'the end'} comes too early", word)

    def _wrong(self, token: _Token, what: str, expected: str) -> NoReturn:
        before, after = self._text[: token.start], self._text[token.end :]
        left = ("..." if len(before) > _AROUND else "") + before[-_AROUND:]
        right = after[:_AROUND] + ("..." if len(after) > _AROUND else "")
        place = " ".join(f"{left}[{token.text[:_AROUND]}]{right}".split())
        raise ExpressionError("condition", f"{plain(place, 3 * _AROUND)}: {what}", expected)

    def _condition(self) -> Condition:
        return self._joined("or", lambda: self._joined("and", self._negation))

    def _joined(self, word: str, part: Callable[[], Condition]) -> Condition:
        parts = [part()]
        while self._takes(word):
            parts.append(part())
        return _together(word, parts)

    def _negation(self) -> Condition:
        token = self._peek()
        self._depth += 1
        if self._depth > _DEEPEST:
            self._wrong(token, "there are too many brackets or nots in each other", f"{_DEEPEST} at most")
        try:
            if self._takes("not"):
                return _negated(self._negation())
            if self._takes("("):
                inner = self._condition()
                self._must_take(")")
                return inner
            return self._comparison()
        finally:
            self._depth -= 1

    def _comparison(self) -> Condition:
        left = self._operand(None)
        if self._peek().text in _SIGNS:
            return self._chain(left)
        negated = self._takes("not")
        if left.column is None:
            self._wrong(left.token, f"{shown(left.token.text)} is no condition", "a column, or a comparison")
        readers = {"in": self._in, "between": self._between, "like": self._like, "contains": self._contains}
        for word, read in readers.items():
            if self._takes(word):
                condition = read(left)
                return _negated(condition) if negated else condition
        if negated:
            self._wrong(self._peek(), "not stands alone", "in, between, like or contains after it")
        if self._takes("is"):
            negated = self._takes("not")
            self._must_take("known")
            return Condition(f"{left.sql} IS {'' if negated else 'NOT '}NULL")
        if self._columns[left.column] is not bool:
            what = f"{shown(left.column)} is not compared with anything"
            self._wrong(left.token, what, "=, <, in, like, contains or is known after it")
        return Condition(f"{left.sql} = 1")

    def _chain(self, left: _Operand) -> Condition:
        """Read one comparison or several in a row, as in 4 <= links <= 8."""
        parts: list[Condition] = []
        while self._peek().text in _SIGNS:
            sign = self._take()
            right = self._operand(left)
            parts.append(self._compared(left, sign, right))
            left = right
        return _together("and", parts)

    def _compared(self, left: _Operand, sign: _Token, right: _Operand) -> Condition:
        if left.column is None and right.column is None:
            self._wrong(sign, "no column is compared", "a column on one side")
        if left.holds is not right.holds:
            what = f"{_HELD[left.holds]} is compared with {_HELD[right.holds]}"
            self._wrong(right.token, what, f"{_HELD[left.holds]} on both sides")
        if left.holds is tuple and _SIGNS[sign.text] not in ("=", "<>"):
            self._wrong(sign, "lists are not ordered", "= or !=, or contains")
        return Condition(f"{left.sql} {_SIGNS[sign.text]} {right.sql}", left.values + right.values)

    def _in(self, left: _Operand) -> Condition:
        self._must_take("(")
        items = [self._like_left(left)]
        while self._takes(","):
            items.append(self._like_left(left))
        self._must_take(")")
        marks = ", ".join(item.sql for item in items)
        return Condition(f"{left.sql} IN ({marks})", tuple(value for item in items for value in item.values))

    def _between(self, left: _Operand) -> Condition:
        low = self._like_left(left)
        self._must_take("and")
        high = self._like_left(left)
        return Condition(f"{left.sql} BETWEEN {low.sql} AND {high.sql}", low.values + high.values)

    def _like_left(self, left: _Operand) -> _Operand:
        """Read an operand that holds what a column holds."""
        operand = self._operand(left)
        if operand.holds is not left.holds:
            self._wrong(operand.token, f"{shown(left.column)} holds {_HELD[left.holds]}", _HELD[left.holds])
        return operand

    def _like(self, left: _Operand) -> Condition:
        if left.holds is not str:
            self._wrong(left.token, f"{shown(left.column)} holds no text", "a column of text before like")
        pattern = self._like_left(left)
        return Condition(f"{left.sql} LIKE {pattern.sql}", pattern.values)

    def _contains(self, left: _Operand) -> Condition:
        column = self._columns[str(left.column)]
        if not isinstance(column, ListColumn):
            self._wrong(left.token, f"{shown(left.column)} holds no lists", "a column of lists before contains")
        held = str if column.kind is str else int
        item = self._operand(None, words=held is str)
        if item.holds is not held or item.column is not None:
            self._wrong(item.token, f"{shown(item.token.text)} is not what the lists hold", _HELD[held])
        return Condition(f"EXISTS (SELECT 1 FROM json_each({left.sql}) AS item WHERE item.value = ?)", item.values)

    def _operand(self, left: _Operand | None, *, words: bool = False) -> _Operand:
        """Read a column or a value; a word that names no column is a text where a text is compared with it."""
        token = self._take()
        word = token.text.lower()
        if token.kind == "number":
            return _Operand(token, int, "?", (_number(token.text),))
        if token.kind == "text":
            quote = token.text[0]
            return _Operand(token, str, "?", (token.text[1:-1].replace(quote * 2, quote),))
        if token.text == "(" and left is not None and left.holds is tuple:
            return _Operand(token, tuple, "?", (stored(self._numbers()),))
        if token.kind != "word":
            what = f"{shown(token.text)} stands" if token.text else "it ends"
            self._wrong(token, f"{what} where a value belongs", "a column, a number, or a text in quotes")
        if word in ("true", "false"):
            return _Operand(token, int, "?", (int(word == "true"),))
        if word in self._columns:
            column = self._columns[word]
            holds = tuple if isinstance(column, ListColumn) else str if column is str else int
            return _Operand(token, holds, f'"{word}"', column=word)
        if (words or (left is not None and left.holds is str)) and word not in _KEYWORDS:
            return _Operand(token, str, "?", (token.text,))
        self._wrong(token, f"there is no column {shown(token.text)}", known(self._columns, word))

    def _numbers(self) -> tuple[int | float, ...]:
        """Read numbers parted by commas, and the bracket behind them."""
        numbers: list[int | float] = []
        while not numbers or self._takes(","):
            token = self._take()
            if token.kind != "number":
                self._wrong(token, f"{shown(token.text)} in a list of numbers", "numbers, as in (4, 2)")
            numbers.append(_number(token.text))
        self._must_take(")")
        return tuple(numbers)


def _negated(condition: Condition) -> Condition:
    return Condition(f"(NOT {condition.sql})", condition.values)


def _together(word: str, parts: list[Condition]) -> Condition:
    """Return several conditions joined by a word, ``and`` or ``or``."""
    if len(parts) == 1:
        return parts[0]
    sql = f" {word.upper()} ".join(part.sql for part in parts)
    return Condition(f"({sql})", tuple(value for part in parts for value in part.values))


def _number(text: str) -> int | float:
    try:
        whole = int(text)
    except ValueError:
        return float(text)
    return whole if abs(whole) < 1 << 63 else float(text)
