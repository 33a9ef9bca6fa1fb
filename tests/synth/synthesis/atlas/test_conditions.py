"""Conditions: what they select, against Python; what is said of those that are none."""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import Any

import pytest

from graphs.errors import InvariantError, SynthedraError
from synth.synthesis.atlas.atlas_file import Atlas

Truth = bool | None
Selects = Callable[[dict[str, Any]], Truth]


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


def random_condition(rng: random.Random, depth: int) -> tuple[str, Selects]:
    """Return a condition and a function of a row that says true, false or not known."""
    if depth and rng.random() < 0.7:
        kind = rng.choice(("AND", "OR", "NOT"))
        text, function = random_condition(rng, depth - 1)
        if kind == "NOT":
            return f"NOT ({text})", lambda row: negated(function(row))
        other_text, other = random_condition(rng, depth - 1)
        if kind == "AND":
            return f"({text} AND {other_text})", lambda row: both(function(row), other(row))
        return f"({text} OR {other_text})", lambda row: negated(both(negated(function(row)), negated(other(row))))
    sign = rng.choice(("=", "!=", "<", "<=", ">", ">="))
    return rng.choice(
        [
            (f"links {sign} 5", lambda row: compared(row["links"], sign, 5)),
            (f"5 {sign} centres", lambda row: compared(5, sign, row["centres"])),
            (f"links {sign} joints", lambda row: compared(row["links"], sign, row["joints"])),
            (f"kind {sign} 'sc'", lambda row: compared(row["kind"], sign, "sc")),
            ("name = 'a''b) -- ;'", lambda row: compared(row["name"], "=", "a'b) -- ;")),
            ("all_explicit", lambda row: row["all_explicit"]),
            ("all_explicit = 0", lambda row: negated(row["all_explicit"])),
            ("assortment = '[4]'", lambda row: compared(row["assortment"], "=", (4,))),
            (
                "loop_sizes IS NOT NULL AND 5 IN (SELECT value FROM json_each(loop_sizes))",
                lambda row: row["loop_sizes"] is not None and 5 in row["loop_sizes"],
            ),
            ("links IN (4, 7)", lambda row: row["links"] in (4, 7)),
            ("symmetry BETWEEN 2 AND 4", lambda row: None if row["symmetry"] is None else 2 <= row["symmetry"] <= 4),
            ("centres IS NULL", lambda row: row["centres"] is None),
            ("name LIKE 'w%'", lambda row: None if row["name"] is None else row["name"].lower().startswith("w")),
        ]
    )


def test_random_conditions_select_what_python_does(small_atlas: Atlas) -> None:
    rng = random.Random(26)
    rows = small_atlas.query(limit=10_000).rows
    chosen = set()
    for _ in range(150):
        condition, function = random_condition(rng, 3)
        expected = [row["id"] for row in rows if function(row) is True]
        assert [row["id"] for row in small_atlas.query(condition, columns=["id"])] == expected, condition
        chosen.add(len(expected))
    assert len(chosen) > 20


@pytest.mark.parametrize(
    ("condition", "told"),
    [
        ("links = 4 AND cetnres > 2", "the nearest is 'centres'"),
        ("kind = scd", "texts stand in single quotes"),
        ("links = 4 links = 6", "syntax error"),
        ("(links = 4", "brackets do not match"),
        ("links = 4) OR (1", "brackets do not match"),
        ("kind = 'a", "unrecognized token"),
        ("4 <= links <= 8", "BETWEEN"),
        ("links = 4; DROP TABLE type", "';' is no part"),
        ("links = 4 --", "'--' is no part"),
        ("links = 4 /* )", "do not match"),
        ("links = 4 /*", "'/*' is no part"),
        ("links = 4 ORDER BY links", "syntax error"),
        ("links = ?", "bindings"),
        ("1 = (SELECT count(*) FROM sqlite_master)", "not authorized"),
        ("1 = (SELECT count(*) FROM unit)", "not authorized"),
        ("printf('%d', links) = '4'", "not authorized"),
        ("count(*) > 1", "misuse of aggregate"),
        ("links = (4, 2)", "row value misused"),
        ("(" * 9000 + "1" + ")" * 9000, "[condition]"),
        ("links = 4\x00", "null character"),
    ],
)
def test_what_is_no_condition_is_one_line(small_atlas: Atlas, condition: str, told: str) -> None:
    with pytest.raises(InvariantError) as caught:
        small_atlas.query(condition)
    text = str(caught.value)
    assert told in text
    assert text.endswith("[condition]")
    assert text.isprintable()


WORDS = [
    "links",
    "kind",
    "all_explicit",
    "AND",
    "OR",
    "NOT",
    "IN",
    "BETWEEN",
    "LIKE",
    "IS",
    "NULL",
    "TRUE",
    "(",
    ")",
    ",",
    "=",
    "!=",
    "<",
    ">=",
    "'a'",
    '"b"',
    '"links"',
    "`kind`",
    "[id]",
    "4",
    "-1",
    "1e999",
    ".5",
    "99999999999999999999",
    ";",
    "--",
    "/*",
    "*/",
    "%",
    "''",
    "'",
    '"',
    "`",
    "[",
    "]",
    "\\",
    "\x00",
    "\x1b",
    "\u202e",
    "é",
    "SELECT",
    "FROM",
    "type",
    "UNION",
    "?",
    ":a",
    "@",
    "$",
    "{",
    "}",
    "ORDER",
    "BY",
    "LIMIT",
]


def fuzzed(atlas: Atlas, count: int, seed: int) -> None:
    rng = random.Random(seed)
    read = 0
    for _ in range(count):
        joint = rng.choice((" ", " ", ""))
        condition = joint.join(rng.choice(WORDS) for _ in range(rng.randrange(1, 12)))
        try:
            rows = atlas.query(condition, columns=["id"])
        except SynthedraError as error:
            assert str(error).isprintable()
            continue
        assert rows.columns == ("id",)  # no statement of its own
        read += 1
    assert read


def test_no_condition_is_a_traceback(small_atlas: Atlas) -> None:
    fuzzed(small_atlas, 500, 1)


@pytest.mark.slow
def test_no_condition_is_a_traceback_of_many(small_atlas: Atlas) -> None:
    fuzzed(small_atlas, 50_000, 2)
