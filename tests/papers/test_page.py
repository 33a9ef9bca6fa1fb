"""docs/papers.md: every row is asked, the figure that comes out is the one that is due, and stands on the page."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest
from examples import agree
from paper_rows.page import numbered, page, shown
from paper_rows.row import agrees, value_of

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "papers.md").read_text(encoding="utf-8")
GOLDEN = json.loads((ROOT / "data" / "golden.json").read_text(encoding="utf-8"))
ROWS = list(numbered())
OURS = 5
"""The column of the page with our figure, from 0."""


def lines_of(text):
    """Number of a row to its cells."""
    rows = [line.strip("|\n").split(" | ") for line in text.splitlines() if re.match(r"\| \d+ \|", line)]
    return {int(cells[0]): cells for cells in rows}


def asked():
    for number, paper, row in ROWS:
        if not (row.why or row.same):
            marks = [pytest.mark.slow] if row.slow else []
            yield pytest.param(number, row, id=f"{number} {paper} {row.place}", marks=marks)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with the project's data in it, where commands write."""
    path = tmp_path_factory.mktemp("rows")
    (path / "data").symlink_to(ROOT / "data")
    return path


@pytest.mark.parametrize(("number", "row"), list(asked()))
def test_row(number, row, folder, monkeypatch):
    monkeypatch.chdir(folder)
    found, second = value_of(row)
    due = row.due if second is None else second
    assert due is not None
    assert agrees(found, due, row.within), (found, due)
    if row.misprint and row.printed is not None:
        assert not agrees(found, row.printed, row.within)
    assert agree([lines_of(PAGE)[number][OURS]], [shown(found)])


def test_the_page_is_made_of_the_rows():
    """All but our figures, which the rows' own tests compare."""

    def without_ours(text):
        return [line for line in text.splitlines() if not re.match(r"\| \d+ \|", line)], {
            number: cells[:OURS] + cells[OURS + 1 :] for number, cells in lines_of(text).items()
        }

    assert without_ours(PAGE) == without_ours(page(dict.fromkeys(range(1, len(ROWS) + 1), 0)))
    assert all(len(cells) == OURS + 2 for cells in lines_of(PAGE).values())


def test_rows_shown_above_are_asked_there():
    """They name a row of a paper that a test runs, and all items of the independent pass are here or there."""
    numbers = {id(row): number for number, _, row in ROWS}
    pointing = [(number, row) for number, _, row in ROWS if row.same]
    assert len(pointing) > 10
    for number, row in pointing:
        assert not row.same.why
        assert lines_of(PAGE)[number][3] == f"row {numbers[id(row.same)]}"
        assert numbers[id(row.same)] < number


def test_rows_cover_the_golden_values_and_the_misprints():
    """Each golden entry that has a printed figure, and each item of docs/misprints.md, is in a row."""
    listed = {"/".join(name.split("/")[:2]) for _, _, row in ROWS for name in row.golden.split()}
    entries = {f"{paper}/{name}": one for paper in GOLDEN if paper.isdigit() for name, one in GOLDEN[paper].items()
               if isinstance(one, dict)}  # fmt: skip
    assert listed <= entries.keys()
    assert {name for name, one in entries.items() if one.get("printed") is not None} <= listed
    items = re.findall(r"^\| (\d{3}-\d+)", (ROOT / "docs" / "misprints.md").read_text(encoding="utf-8"), re.MULTILINE)
    told = " ".join(f"{row.misprint} {row.remark}" for _, _, row in ROWS)
    assert len(items) > 30
    assert {item for item in items if not re.search(rf"{item}\b", told)} == set()


def test_printed_figures_are_those_of_the_golden_file():
    """Where a row says in which entry its printed figure is; the others have one that is part of a sentence there."""
    compared = 0
    for _, _, row in ROWS:
        paper, name, *key = row.golden.split(" ")[0].split("/") if row.golden else ("", "")
        if key:
            printed = GOLDEN[paper][name]["printed"]
            wanted = printed[key[0]] if key[0] else printed
            assert agrees(wanted, row.printed, 1e-12), row.golden
            compared += 1
    assert compared > 20


def test_rows_that_print_counts_have_those_of_the_golden_file():
    """Rows of Wiener's examples name what they count: N, J, V, ... as the golden file does."""
    compared = 0
    for _, _, row in ROWS:
        keys = row.what.split(" of ")[0].split(", ")
        if (
            row.golden
            and isinstance(row.printed, list)
            and set(keys) <= {"N", "J", "V", "C", "E_ext", "E_int", "M", "E"}
        ):
            paper, name = row.golden.split("/")
            printed = GOLDEN[paper][name]["printed"]
            if isinstance(printed, dict):
                known = [(value, printed[key]) for key, value in zip(keys, row.printed, strict=True) if key in printed]
                assert all(one == other for one, other in known), row.golden
                compared += len(known)
    assert compared > 60


def test_expressions_run_as_they_stand():
    """In a Python of its own, after the imports that the page names: every dotted name in them is found."""
    dotted = {
        name
        for _, _, row in ROWS
        for text in (row.ask if not row.ask.startswith("synth ") else "", row.figure, row.second)
        for name in re.findall(r"\b(?:graphs|synth)(?:\.[A-Za-z_]\w*)+", text)
    }
    assert len(dotted) > 20
    program = "import json, graphs, synth\nimport numpy as np\nfor name in json.loads(input()): eval(name)"
    run = subprocess.run(
        [sys.executable, "-c", program], check=False, input=json.dumps(sorted(dotted)), capture_output=True, text=True
    )
    assert run.returncode == 0, run.stderr
