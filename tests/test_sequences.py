"""The terms of docs/sequences.md, each anew by both methods, as far as that is cheap."""

import json
import re
from pathlib import Path

import pytest
from commands import run
from sizes import slow

PAGE = Path(__file__).parent.parent / "docs" / "sequences.md"
ROW = re.compile(
    r"\| (?P<name>[^|]+) \| [LN] = (?P<first>\d+)(, (?P<second>\d+))? \| (?P<terms>[\d, ]+) \| `synth (?P<command>.+)` \|"
)
FIRST = 2
"""Terms of each row that are always counted; of the others those up to `MOST`, in a slow test."""

MOST = 60_000
HEAVY = {f"Chains with or without cuts, M = {dof}" for dof in (4, 5, 6)}
"""Rows whose first terms take seconds."""
MINUTES = {("SCD graphs, M = 1, D = 3", 5)}
"""Terms, by the row and their place in it, that are small and take minutes all the same."""


def rows():
    return [match for match in map(ROW.fullmatch, PAGE.read_text(encoding="utf-8").splitlines()) if match]


def words(command, index):
    """Return a command with a number for its letter: 2L+3, N, N-1."""

    def value(word):
        match = re.fullmatch(r"(\d*)[LN]([+-]\d+)?", word)
        return str(int(match[1] or 1) * index + int(match[2] or 0)) if match else word

    return [value(word) for word in command.split()]


def check(row, places):
    first = int(row["first"])
    step = int(row["second"]) - first if row["second"] else 1
    for place, term in numbered(row["terms"]):
        if place in places and term < MOST and (row["name"], place) not in MINUTES:
            command = words(row["command"], first + step * place)
            for method in ("orbits", "burnside"):
                said = json.loads(run(*command, "--method", method, "--json", "--workers", 1).stdout)
                assert said["count"] == term, (command, method)


def numbered(terms):
    numbers = list(map(int, terms.split(", ")))
    return zip(range(len(numbers)), numbers, strict=True)


def test_every_row_of_the_page_is_a_sequence():
    tables = [line for line in PAGE.read_text(encoding="utf-8").splitlines() if line.startswith("|")]
    heads = sum(line.startswith(("| sequence", "|---")) for line in tables)
    assert len(tables) - heads == len(rows()) > 40


@pytest.mark.parametrize(
    "row", [slow(row) if row["name"] in HEAVY else row for row in rows()], ids=lambda row: row["name"]
)
def test_terms(row):
    check(row, range(FIRST))


@pytest.mark.slow
@pytest.mark.parametrize("row", rows(), ids=lambda row: row["name"])
def test_larger_terms(row):
    check(row, range(FIRST, 100))
