"""Lists in rows: in stores, in files and in tables."""

from __future__ import annotations

import json
import shutil
import sqlite3
import subprocess
from dataclasses import dataclass
from typing import Any, ClassVar

import pytest

from enumerate.chains.jobs import ChainJob
from enumerate.chains.query import ChainQuery
from enumerate.runner._run import run
from enumerate.runner.job import Column, ListColumn, RangeColumn, Row, Unit, row_as_dict, stored, unstored
from enumerate.runner.sinks import JsonLinesSink, LatexSink, ParquetSink, SortedSink
from enumerate.runner.store import SqliteSink, read_meta, read_rows

ROWS: list[Row] = [
    ("a", (4, 2), (4.0, 2.0), ((0, 1), (2, 3)), (("a", "b", 28.15),)),
    ("b", (4, 2), (30.5,), (), ()),
    ("c", (10,), (0.0,), ((5, 6),), (("a", "c", 1e-05), ("b", "c", 90.0))),
]
AS_JSON = [
    {"code": "a", "counts": [4, 2], "degrees": [4.0, 2.0], "pairs": [[0, 1], [2, 3]], "angles": [["a", "b", 28.15]]},
    {"code": "b", "counts": [4, 2], "degrees": [30.5], "pairs": [], "angles": []},
    {"code": "c", "counts": [10], "degrees": [0.0], "pairs": [[5, 6]], "angles": [["a", "c", 1e-05], ["b", "c", 90.0]]},
]  # fmt: skip


@dataclass(frozen=True)
class Listed:
    """A job whose rows hold lists."""

    columns: ClassVar[dict[str, Column]] = {
        "code": str,
        "counts": ListColumn(","),
        "degrees": ListColumn(" ", kind=float),
        "pairs": ListColumn(" ", "-"),
        "angles": ListColumn(" ", "-", ":", None),
    }
    key: ClassVar[dict[str, Any]] = {"enumerate": "lists"}

    def units(self):
        return [Unit(0)]

    def work(self, payload):
        return ROWS


def test_a_store_holds_compact_json_text_and_gives_the_rows_back(tmp_path):
    path = tmp_path / "lists.sqlite"
    run(Listed(), SqliteSink(path))
    assert list(read_rows(path)) == ROWS
    assert [type(row[2][0]) for row in read_rows(path)] == [float] * 3  # not the text of an equal list of integers
    assert read_meta(path)["lists"] == ["counts", "degrees", "pairs", "angles"]
    with sqlite3.connect(path) as connection:
        assert connection.execute("SELECT counts, degrees, pairs, angles FROM type LIMIT 1").fetchone() == (
            "[4,2]", "[4.0,2.0]", "[[0,1],[2,3]]", '[["a","b",28.15]]',
        )  # fmt: skip
        assert connection.execute("SELECT sum(json_extract(counts, '$[0]')) FROM type").fetchone() == (18,)
    connection.close()


def test_files_and_dictionaries_hold_lists(tmp_path):
    run(Listed(), JsonLinesSink(tmp_path / "lists.jsonl"))
    assert [json.loads(line) for line in (tmp_path / "lists.jsonl").read_text().splitlines()] == AS_JSON
    assert [row_as_dict(Listed.columns, row) for row in ROWS] == AS_JSON
    parquet = pytest.importorskip("pyarrow.parquet")
    run(Listed(), ParquetSink(tmp_path / "lists.parquet"))
    table = parquet.read_table(tmp_path / "lists.parquet").to_pylist()
    assert [{**row, "angles": json.loads(row["angles"])} for row in table] == AS_JSON


def test_a_table_for_a_document(tmp_path):
    """Every row has as many cells as the head; LaTeX sets it, where there is one."""
    run(Listed(), LatexSink(tmp_path / "lists.tex"))
    lines = (tmp_path / "lists.tex").read_text(encoding="utf-8").splitlines()
    cells = [line.count(" & ") for line in lines if line.endswith(r" \\")]
    assert cells == [len(Listed.columns) - 1] * (1 + len(ROWS))
    chains = tmp_path / "chains.tex"
    run(ChainJob(ChainQuery(8, 1)), LatexSink(chains))
    text = chains.read_text(encoding="utf-8")
    assert text.count(r"\texttt{k1:") == 16
    assert all(part in text for part in (r"longest\_string", r"{\char96}"))
    latex = shutil.which("pdflatex")
    if latex is not None:
        document = [r"\documentclass{article}\usepackage{booktabs,longtable}\begin{document}\tiny"]
        document += [rf"\input{{{place.name}}}" for place in (chains, tmp_path / "lists.tex")]
        (tmp_path / "all.tex").write_text("\n".join([*document, r"\end{document}"]), encoding="utf-8")
        words = [latex, "-interaction=nonstopmode", "-halt-on-error", "all.tex"]
        child = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=False)
        assert child.returncode == 0, child.stdout[-2000:]


def test_lists_are_sorted_as_lists(tmp_path):
    run(Listed(), SortedSink(JsonLinesSink(tmp_path / "sorted.jsonl"), "-counts"))
    lines = (tmp_path / "sorted.jsonl").read_text().splitlines()
    assert [json.loads(line)["code"] for line in lines] == ["c", "a", "b"]


def test_tables_show_text():
    shown = [
        [
            str(value) if isinstance(kind, type) else kind.text(value)
            for kind, value in zip(Listed.columns.values(), row, strict=True)
        ]
        for row in ROWS
    ]
    assert shown == [
        ["a", "4,2", "4 2", "0-1 2-3", "a-b:28.15"],
        ["b", "4,2", "30.5", "", ""],
        ["c", "10", "0", "5-6", "a-c:1e-05 b-c:90"],
    ]
    assert RangeColumn(" ", "..").text(((1, 1), (0, 2))) == "1 0..2"
    assert unstored(stored(((0, 1), (1, 1)))) == ((0, 1), (1, 1))
