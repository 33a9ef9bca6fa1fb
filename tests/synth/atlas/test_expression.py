"""Conditions in words: what they select, against Python; what is said of those that are none."""

from __future__ import annotations

import random
import re
import sqlite3
from typing import Any

import pytest

from enumerate.runner.job import ListColumn, stored
from graphs.errors import SynthedraError
from synth.atlas.columns import stored_columns
from synth.atlas.expression import ExpressionError, condition_of

COLUMNS = {"links": int, "angle": float, "kind": str, "planar": bool, "sizes": ListColumn(",")}
ROWS: list[dict[str, Any]] = [
    {"links": links, "angle": angle, "kind": kind, "planar": planar, "sizes": sizes}
    for links in (4, 6, None)
    for angle in (0.5, 6.0, None)
    for kind in ("sc", "a'b", None)
    for planar in (True, False, None)
    for sizes in ((4,), (4, 6), None)
]


@pytest.fixture(scope="module")
def table() -> sqlite3.Connection:
    connection = sqlite3.connect(":memory:", check_same_thread=False)
    connection.execute("CREATE TABLE type (number, links, angle, kind, planar, sizes)")
    for number, row in enumerate(ROWS):
        values = [stored(value) if name == "sizes" else value for name, value in row.items()]
        connection.execute("INSERT INTO type VALUES (?, ?, ?, ?, ?, ?)", (number, *values))
    return connection


def selected(table: sqlite3.Connection, expression: str) -> list[int]:
    made = condition_of(expression, COLUMNS)
    return [n for (n,) in table.execute(f"SELECT number FROM type WHERE {made.sql}", made.values)]


Truth = bool | None


def negated(value: Truth) -> Truth:
    return None if value is None else not value


def both(a: Truth, b: Truth) -> Truth:
    return False if a is False or b is False else None if a is None or b is None else True


def compared(value: Any, sign: str, other: Any) -> Truth:
    if value is None or other is None:
        return None
    return {
        "=": value == other, "!=": value != other, "<": value < other, "<=": value <= other,
        ">": value > other, ">=": value >= other,
    }[sign]  # fmt: skip


def random_condition(rng: random.Random, depth: int) -> tuple[str, Any]:
    """Return an expression and a function of a row that says true, false or not known."""
    if depth and rng.random() < 0.7:
        kind = rng.choice(("and", "or", "not"))
        text, function = random_condition(rng, depth - 1)
        if kind == "not":
            return f"not ({text})", lambda row: negated(function(row))
        other_text, other = random_condition(rng, depth - 1)
        if kind == "and":
            return f"({text} and {other_text})", lambda row: both(function(row), other(row))
        return f"({text} or {other_text})", lambda row: negated(both(negated(function(row)), negated(other(row))))
    sign = rng.choice(("=", "!=", "<", "<=", ">", ">="))
    return rng.choice(
        [
            (f"links {sign} 5", lambda row: compared(row["links"], sign, 5)),
            (f"5 {sign} links", lambda row: compared(5, sign, row["links"])),
            (f"links {sign} angle", lambda row: compared(row["links"], sign, row["angle"])),
            (f"kind {sign} 'a''b'", lambda row: compared(row["kind"], sign, "a'b")),
            ("kind = sc", lambda row: compared(row["kind"], "=", "sc")),
            ("4 <= links < 6", lambda row: both(compared(4, "<=", row["links"]), compared(row["links"], "<", 6))),
            ("planar", lambda row: row["planar"]),
            ("planar = false", lambda row: negated(row["planar"])),
            ("sizes = (4, 6)", lambda row: compared(row["sizes"], "=", (4, 6))),
            ("sizes contains 6", lambda row: row["sizes"] is not None and 6 in row["sizes"]),
            ("links in (4, 7)", lambda row: None if row["links"] is None else row["links"] in (4, 7)),
            ("angle between 0 and 1", lambda row: None if row["angle"] is None else 0 <= row["angle"] <= 1),
            ("kind is known", lambda row: row["kind"] is not None),
            ("kind is not known", lambda row: row["kind"] is None),
            ("kind like 's%'", lambda row: None if row["kind"] is None else row["kind"].startswith("s")),
        ]
    )


def test_random_conditions_select_what_python_does(table: sqlite3.Connection) -> None:
    rng = random.Random(26)
    chosen = set()
    for _ in range(400):
        expression, function = random_condition(rng, 3)
        expected = [number for number, row in enumerate(ROWS) if function(row) is True]
        assert selected(table, expression) == expected, expression
        chosen.add(len(expected))
    assert len(chosen) > 30


@pytest.mark.parametrize(
    ("expression", "marked", "told"),
    [
        ("links = 4 and cetnres > 2", "[cetnres]", "no column 'cetnres'; expected one of"),
        ("lnks = 4", "[lnks]", "the nearest is 'links'"),
        ("links = 'a'", "['a']", "a number is compared with a text"),
        ("links", "[links]", "not compared with anything"),
        ("links = 4 links = 6", "[links] = 6", "follows a whole condition"),
        ("(links = 4", "[]", "comes too early; expected )"),
        ("kind = 'a", "[']a", "does not end"),
        ("sizes < (4, 6)", "[<]", "not ordered"),
        ("links contains 4", "[links]", "holds no lists"),
        ("planar and", "[]", "where a value belongs"),
        ("3 = 4", "[=]", "no column is compared"),
        ("links in ('a')", "['a']", "holds a number"),
        ("not", "[]", "where a value belongs"),
        ("links @ 4", "[@]", "no meaning here"),
        ("links = 4; drop table type", "[;]", "no meaning here"),
    ],
)
def test_what_is_wrong_is_pointed_at(expression: str, marked: str, told: str) -> None:
    with pytest.raises(ExpressionError) as caught:
        condition_of(expression, COLUMNS)
    text = str(caught.value)
    assert marked in text
    assert told in text
    assert text.isprintable()


def test_brackets_in_brackets_end() -> None:
    with pytest.raises(ExpressionError, match="in each other"):
        condition_of("(" * 10_000, COLUMNS)
    with pytest.raises(ExpressionError, match="in each other"):
        condition_of("not " * 200 + "planar", COLUMNS)
    with pytest.raises(ExpressionError, match="letters"):
        condition_of("(" * 20_000, COLUMNS)


def test_a_long_condition_with_many_parts_is_read(table: sqlite3.Connection) -> None:
    expression = " or ".join(["links = 4"] * 500)
    assert selected(table, expression) == selected(table, "links = 4")


WORDS = [
    "links",
    "kind",
    "all_explicit",
    "and",
    "or",
    "not",
    "in",
    "between",
    "like",
    "contains",
    "is",
    "known",
    "true",
    "false",
    "(",
    ")",
    ",",
    "=",
    "!=",
    "<",
    ">=",
    "'a'",
    '"b"',
    "4",
    "-1",
    "1e999",
    "0x10",
    ".5",
    "99999999999999999999",
    ";",
    "--",
    "/*",
    "%",
    "''",
    "'",
    '"',
    "\\",
    "\x00",
    "\x1b",
    "\u202e",
    "é",
    "select",
    "union",
    "?",
    ":a",
    "@",
    "$",
    "[",
    "]",
    "{",
    "}",
]


def fuzzed(count: int, seed: int) -> None:
    rng = random.Random(seed)
    connection = sqlite3.connect(":memory:")
    columns = stored_columns()
    connection.execute(f"CREATE TABLE type ({', '.join(columns)})")
    read = 0
    for _ in range(count):
        joint = rng.choice((" ", " ", ""))
        expression = joint.join(rng.choice(WORDS) for _ in range(rng.randrange(1, 12)))
        try:
            made = condition_of(expression, columns)
        except SynthedraError as error:
            assert str(error).isprintable()
            continue
        assert not re.search(r"[';]|--", made.sql)  # values stay apart
        connection.execute(f"SELECT 1 FROM type WHERE {made.sql}", made.values).fetchall()
        read += 1
    assert read


def test_no_expression_is_a_traceback() -> None:
    fuzzed(3000, 1)


@pytest.mark.slow
def test_no_expression_is_a_traceback_of_many() -> None:
    fuzzed(200_000, 2)
