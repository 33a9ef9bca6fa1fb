"""The terms of docs/sequences.md, each anew by both methods, as far as that is cheap."""

import json
import re
from pathlib import Path

import pytest
from commands import run
from folded_sheets import unassigned_map
from sizes import slow

import synth
from synth.analysis.layering.sweep import count_by_cells

PAGE = Path(__file__).parent.parent / "docs" / "sequences.md"
ROW = re.compile(
    r"\| (?P<name>[^|]+) \| [LN] = (?P<first>\d+)(, (?P<second>\d+))? \| (?P<terms>[\d, ]+) \| `synth (?P<command>.+)` \|"
)
MAPS = re.compile(r"\| (?P<name>[^|]+) \| N = 1 \| (?P<terms>[\d, ]+) \| `orders\((?P<rows>\w), N\)` \|")
FIRST = 2
"""Terms of each row that are always counted; of the others those up to `MOST`, in a slow test."""

MOST = 60_000
FEW = 2_000
"""Foldings of maps up to which a term is always counted; the others are slow."""
ALL_PANELS = 16
"""Panels of a map up to which the second method counts the orders of all, whichever is the lowest."""
HEAVY = {f"Chains with or without cuts, M = {dof}" for dof in (4, 5, 6)}
"""Rows whose first terms take seconds."""
MINUTES = {("SCD graphs, M = 1, D = 3", 5)}
"""Terms, by the row and their place in it, that are small and take minutes all the same."""


def rows(pattern=ROW):
    return [match for match in map(pattern.fullmatch, PAGE.read_text(encoding="utf-8").splitlines()) if match]


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
    assert len(tables) - heads == len(rows()) + len(rows(MAPS)) > 40


@pytest.mark.parametrize(
    "row", [slow(row) if row["name"] in HEAVY else row for row in rows()], ids=lambda row: row["name"]
)
def test_terms(row):
    check(row, range(FIRST))


@pytest.mark.slow
@pytest.mark.parametrize("row", rows(), ids=lambda row: row["name"])
def test_larger_terms(row):
    check(row, range(FIRST, 100))


def map_terms():
    """Rows of maps with each of their terms; those that are not small are slow."""
    for row in rows(MAPS):
        for place, term in numbered(row["terms"]):
            case = (row["name"], int(row["rows"]) if row["rows"] != "N" else place + 1, place + 1, term)
            yield case if term < FEW else slow(*case)


@pytest.mark.parametrize(("name", "rows", "columns", "term"), list(map_terms()), ids=str)
def test_maps(name, rows, columns, term):
    """By the code of the page, and by the second method.

    Layers of a map can be shifted cyclically, so that each panel is the lowest of equally many orders: of larger maps
    the second method counts those of one panel.
    """
    code = re.search(r"```py\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    page = {}
    exec(code[1], page)
    assert page["orders"](rows, columns) == term, name
    image = synth.layers(unassigned_map(rows, columns), explain=False).image
    panels = rows * columns
    if panels <= ALL_PANELS:
        assert count_by_cells(image, {}) == term, name
    else:
        lowest = {(0, 0, panel): False for panel in range(1, panels)}
        assert panels * count_by_cells(image, {}, lowest) == term, name
