"""Every mechanism under data/ has the numbers that its paper gives for it."""

import json
from pathlib import Path

import pytest
from counted import KEYS, counted_numbers

DATA = Path(__file__).resolve().parents[2] / "data"
INDEX = json.loads((DATA / "index.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("row", INDEX, ids=[row["file"] for row in INDEX])
def test_every_mechanism_has_the_numbers_of_its_paper(row, golden):
    expected = {key: value for key, value in row.items() if key in (*KEYS, "M")}
    assert "M" in expected
    assert expected.keys() | {"file", "source", "golden", "choice"} == row.keys() | {"choice"}
    found = counted_numbers(DATA / row["file"])
    assert {key: found[key] for key in expected} == expected
    if row["golden"] is not None:
        paper, name = row["golden"].split("/")
        assert name in golden[paper]


def test_the_printed_numbers_are_those_of_the_golden_file(golden):
    """Where the golden entry prints counts under the same names, the index agrees."""
    compared = 0
    for row in (row for row in INDEX if row["golden"] is not None):
        paper, name = row["golden"].split("/")
        printed = golden[paper][name].get("printed")
        if not isinstance(printed, dict) or row["golden"] in ("003/ex_4_2_5_3", "003/ex_4_2_5_4", "003/ex_4_2_5_5"):
            continue
        for key in row.keys() & printed.keys() & {*KEYS, "M"}:
            if isinstance(printed[key], int):
                assert row[key] == printed[key], (row["file"], key)
                compared += 1
    assert compared > 60
