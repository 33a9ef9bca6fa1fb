"""The table of special geometry in docs and benchmarks: what is found of each type is what it says."""

import json
import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[5]
PROGRAM = runpy.run_path(str(ROOT / "benchmarks" / "special_geometry.py"))
ROWS = {row["type"]: row for row in json.loads((ROOT / "benchmarks/results/special_geometry.json").read_text())}
TYPES = dict(PROGRAM["types"]())


def test_every_type_has_a_row():
    assert list(ROWS) == list(TYPES)
    assert all(row["M"] <= 0 for row in ROWS.values())
    known = [name for name in TYPES if not name.startswith(("sheet:", "chain:"))]
    assert len(TYPES) - len(known) == 30
    assert all(ROWS[name]["found"] for name in known)


def test_the_page_has_the_table():
    page = (ROOT / "docs/theory/realisation.md").read_text(encoding="utf-8")
    lines = [line for line in page.splitlines() if line.startswith(("| sheet: ", "| chain: "))]
    for line in lines:
        name, *cells = (cell.strip() for cell in line.strip("|").split("|"))
        row = ROWS[name]
        found = row["found"][0]["family"] if row["found"] else "none found"
        assert cells[:2] == [f"{row['links']}, {row['joints']}", str(row["M"])], name
        assert cells[2].startswith(found), name
        assert cells[3:] == [str(row["families"]), str(row["starts"]), str(row["work"])], name
    assert len(lines) == 30


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in TYPES if ROWS[name]["found"]])
def test_what_was_found_is_found_again(name):
    row, told = PROGRAM["row"](name, TYPES[name]), ROWS[name]
    assert [one["family"] for one in row["found"]] == [one["family"] for one in told["found"]]
    assert all(one["freedoms"] == 1 and one["closure"] < 1e-12 for one in row["found"])
