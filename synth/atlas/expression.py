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

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, NoReturn

from enumerate.runner.job import Column, ListColumn, stored
from graphs.edit.named import known
from graphs.errors import InvariantError, shown
from graphs.printing import plain

__all__ = ["Condition", "ExpressionError", "condition_of"]

_LONGEST, _DEEPEST = 10_000, 60
"""Most letters of an expression, and most nested brackets."""
_AROUND = 40
"""Letters shown of the word that is wrong, and on either side of it."""

_TOKEN = re.compile(
    r"""\s*(?:(?P<number>[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)(?![\w.])
        |(?P<text>'(?:[^']|'')*'|"(?:[^"]|"")*")
        |(?P<word>[^\W\d]\w*)
        |(?P<sign><=|>=|!=|<>|==|[=<>(),]))""",
    re.VERBOSE,
)
_SIGNS = {"=": "=", "==": "=", "!=": "<>", "<>": "<>", "<": "<", "<=": "<=", ">": ">", ">=": ">="}
_HELD = {int: "a number", str: "a text", tuple: "a list of numbers"}
_KEYWORDS = ("and", "or", "not", "in", "between", "like", "contains", "is", "known", "true", "false")


class ExpressionError(InvariantError):
    """A condition that cannot be read; the message shows the word in square brackets where it stands.

    Examples
    --------
    >>> try:
    ...     condition_of("links 8", {"links": int})
    ... except ExpressionError as error:
    ...     print(error)
    [links] 8: 'links' is not compared with anything; expected =, <, in, like, contains or is known ...
    """


class Condition(NamedTuple):
    """A condition as SQL, with a mark for each value, and the values."""

    sql: str
    values: tuple[Any, ...] = ()


@dataclass(frozen=True, slots=True)
class _Token:
    kind: str
    text: str
    start: int
    end: int


@dataclass(frozen=True, slots=True)
class _Value:
    """An operand: its SQL, and what it holds: int (numbers, yes or no), str, tuple, or the type of a column."""

    condition: Condition
    holds: type
    token: _Token
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
        self._tokens = self._split()
        self._next, self._depth = 0, 0

    def _split(self) -> list[_Token]:
        tokens, at = [], 0
        end = len(self._text.rstrip())
        while at < end:
            match = _TOKEN.match(self._text, at)
            if match is None or match.lastgroup is None:
                start = at + len(self._text[at:]) - len(self._text[at:].lstrip())
                odd = re.match(r"[\w.]+|.", self._text[start:], re.DOTALL)
                assert odd is not None
                what, expected = (
                    f"{shown(odd[0])} has no meaning here",
                    "a column, a number, a text in quotes, and, or, not",
                )
                if odd[0] in "'\"":
                    what, expected = "a text does not end", f"a second {odd[0]}"
                self._wrong(_Token("odd", odd[0], start, start + len(odd[0])), what, expected)
            tokens.append(_Token(match.lastgroup, match[match.lastgroup], *match.span(match.lastgroup)))
            at = match.end()
        tokens.append(_Token("end", "", end, end))
        return tokens

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
                inner = self._negation()
                return Condition(f"(NOT {inner.sql})", inner.values)
            if self._takes("("):
                inner = self._condition()
                self._must_take(")")
                return inner
            return self._comparison()
        finally:
            self._depth -= 1

    def _comparison(self) -> Condition:
        left = self._operand(None)
        token = self._peek()
        if token.text in _SIGNS:
            return self._chain(left)
        negated = self._takes("not")
        if left.column is None:
            self._wrong(left.token, f"{shown(left.token.text)} is no condition", "a column, or a comparison")
        for word, read in (
            ("in", self._in),
            ("between", self._between),
            ("like", self._like),
            ("contains", self._contains),
        ):
            if self._takes(word):
                condition = read(left)
                return Condition(f"(NOT {condition.sql})", condition.values) if negated else condition
        if negated:
            self._wrong(self._peek(), "not stands alone", "in, between, like or contains after it")
        if self._takes("is"):
            negated = self._takes("not")
            self._must_take("known")
            return Condition(f"{left.condition.sql} IS {'' if negated else 'NOT '}NULL")
        if self._columns[left.column] is not bool:
            what = f"{shown(left.column)} is not compared with anything"
            self._wrong(left.token, what, "=, <, in, like, contains or is known after it")
        return Condition(f"{left.condition.sql} = 1")

    def _chain(self, left: _Value) -> Condition:
        """Read one comparison or several in a row, as in 4 <= links <= 8."""
        parts: list[Condition] = []
        while self._peek().text in _SIGNS:
            sign = self._take()
            right = self._operand(left)
            parts.append(self._compared(left, sign, right))
            left = right
        return _together("and", parts)

    def _compared(self, left: _Value, sign: _Token, right: _Value) -> Condition:
        if left.column is None and right.column is None:
            self._wrong(sign, "no column is compared", "a column on one side")
        if left.holds is not right.holds:
            what = f"{_HELD[left.holds]} is compared with {_HELD[right.holds]}"
            self._wrong(right.token, what, f"{_HELD[left.holds]} on both sides")
        if left.holds is tuple and _SIGNS[sign.text] not in ("=", "<>"):
            self._wrong(sign, "lists are not ordered", "= or !=, or contains")
        sql = f"{left.condition.sql} {_SIGNS[sign.text]} {right.condition.sql}"
        return Condition(sql, left.condition.values + right.condition.values)

    def _in(self, left: _Value) -> Condition:
        self._must_take("(")
        items = [self._like_left(left)]
        while self._takes(","):
            items.append(self._like_left(left))
        self._must_take(")")
        marks = ", ".join(item.condition.sql for item in items)
        values = tuple(value for item in items for value in item.condition.values)
        return Condition(f"{left.condition.sql} IN ({marks})", values)

    def _between(self, left: _Value) -> Condition:
        low = self._like_left(left)
        self._must_take("and")
        high = self._like_left(left)
        values = low.condition.values + high.condition.values
        return Condition(f"{left.condition.sql} BETWEEN {low.condition.sql} AND {high.condition.sql}", values)

    def _like_left(self, left: _Value) -> _Value:
        """Read an operand that holds what a column holds."""
        value = self._operand(left)
        if value.holds is not left.holds:
            self._wrong(value.token, f"{shown(left.column)} holds {_HELD[left.holds]}", _HELD[left.holds])
        return value

    def _like(self, left: _Value) -> Condition:
        if left.holds is not str:
            self._wrong(left.token, f"{shown(left.column)} holds no text", "a column of text before like")
        value = self._like_left(left)
        return Condition(f"{left.condition.sql} LIKE {value.condition.sql}", value.condition.values)

    def _contains(self, left: _Value) -> Condition:
        assert left.column is not None
        column = self._columns[left.column]
        if not isinstance(column, ListColumn):
            self._wrong(left.token, f"{shown(left.column)} holds no lists", "a column of lists before contains")
        token = self._peek()
        value = self._operand(None, words=column.kind is str)
        if value.holds is not (str if column.kind is str else int) or value.column is not None:
            held = "a text" if column.kind is str else "a number"
            self._wrong(token, f"{shown(token.text)} is not what the lists hold", held)
        items = f"SELECT 1 FROM json_each({left.condition.sql}) AS item WHERE item.value = ?"
        return Condition(f"EXISTS ({items})", value.condition.values)

    def _operand(self, left: _Value | None, *, words: bool = False) -> _Value:
        """Read a column or a value; a word that names no column is a text where a text is compared with it."""
        token = self._take()
        if token.kind == "number":
            return _Value(Condition("?", (_number(token.text),)), int, token)
        if token.kind == "text":
            quote = token.text[0]
            return _Value(Condition("?", (token.text[1:-1].replace(quote * 2, quote),)), str, token)
        if token.text == "(" and left is not None and left.holds is tuple:
            return self._list(token)
        if token.kind != "word":
            what = f"{shown(token.text)} stands" if token.text else "it ends"
            self._wrong(token, f"{what} where a value belongs", "a column, a number, or a text in quotes")
        return self._word(token, words or (left is not None and left.holds is str))

    def _word(self, token: _Token, words: bool) -> _Value:
        word = token.text.lower()
        if word in ("true", "false"):
            return _Value(Condition("?", (int(word == "true"),)), int, token)
        if word in self._columns:
            column = self._columns[word]
            holds = tuple if isinstance(column, ListColumn) else str if column is str else int
            return _Value(Condition(f'"{word}"'), holds, token, word)
        if words and word not in _KEYWORDS:
            return _Value(Condition("?", (token.text,)), str, token)
        self._wrong(token, f"there is no column {shown(token.text)}", known(self._columns, word))

    def _list(self, opening: _Token) -> _Value:
        numbers: list[int | float] = []
        while not numbers or self._takes(","):
            token = self._take()
            if token.kind != "number":
                self._wrong(token, f"{shown(token.text)} in a list of numbers", "numbers, as in (4, 2)")
            numbers.append(_number(token.text))
        self._must_take(")")
        return _Value(Condition("?", (stored(tuple(numbers)),)), tuple, opening)


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
