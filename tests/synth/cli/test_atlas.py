"""`synth atlas`."""

import json

import pytest

from graphs.files.formats import read
from tests.support.commands import run


@pytest.fixture(scope="module")
def atlas(tmp_path_factory):
    place = tmp_path_factory.mktemp("atlas") / "atlas.sqlite"
    told = run("atlas", "build", "-o", place, "--max-links", 4, "--creases", 2, "--workers", 1, "--quiet").output
    assert "7  scd" in told
    return place


def test_query(atlas):
    assert "four-bar chain" in run("atlas", "query", atlas, "kind = 'chain'").output
    rows = json.loads(run("atlas", "query", atlas, "all_explicit AND fold_deg > 170", "--json").output)
    assert rows
    assert all(row["all_explicit"] is True for row in rows)
    assert run("atlas", "query", atlas, "links > 100").output.strip() == "no types"
    [row] = json.loads(run("atlas", "query", atlas, "--sql", "SELECT count(*) AS n FROM types", "--json").output)
    assert row["n"] == 12
    assert "the nearest is 'links'" in run("atlas", "query", atlas, "linsk = 4", code=2).output
    assert "not authorized" in run("atlas", "query", atlas, "--sql", "DELETE FROM type", code=2).output
    assert "more than 2 rows" in run("atlas", "query", atlas, "--limit", 2).output
    assert "meaning" in run("atlas", "query", atlas, "--columns", "help").output


def test_query_writes(atlas, tmp_path):
    run("atlas", "query", atlas, "--columns", "id,links", "-o", tmp_path / "rows.csv")
    assert (tmp_path / "rows.csv").read_text().splitlines()[1] == "k1:Cr,4"
    assert "exists already" in run("atlas", "query", atlas, "-o", tmp_path / "rows.csv", code=2).output
    run("atlas", "query", atlas, "kind = 'scd'", "-o", tmp_path / "types")
    assert len(list((tmp_path / "types").iterdir())) == 7


def test_show_and_find(atlas, tmp_path, data):
    assert "Reuleaux" in run("atlas", "show", atlas, "k1:Cr").output
    row = json.loads(run("atlas", "query", atlas, "kind = 'scd' AND all_explicit", "--json").output)[0]
    run("atlas", "show", atlas, row["id"], "-o", tmp_path / "type.fold")
    [found] = json.loads(run("atlas", "find", atlas, tmp_path / "type.fold", "--json").output)
    assert found["drawing"] == row["id"]
    assert [one["id"] for one in found["types"]] == [row["id"], "k1:Cr"]
    assert read(tmp_path / "type.fold") is not None
    assert "no coordinates" in run("atlas", "show", atlas, "k1:Cr", "-o", tmp_path / "no.fold", code=2).output
    assert "fortune teller" in run("atlas", "find", atlas, data / "wiener" / "fortune-teller.json").output


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("build",), "an atlas requires -o FILE.sqlite"),
        (("build", "-o", "a.sqlite", "--max-links", 3), "4 or more"),
        (("build", "-o", "a.sqlite", "--dof", 0), "1 or more"),
        (("query", "nowhere.sqlite"), "no such file"),
        (("show", "nowhere.sqlite", "k1:Cr"), "no such file"),
        (("page", "nowhere.sqlite", "-o", "site"), "no such file"),
    ],
)
def test_what_cannot_be_is_one_line(tmp_path, monkeypatch, words, told):
    monkeypatch.chdir(tmp_path)
    output = run("atlas", *words, code=2).output
    assert told in output
    assert list(tmp_path.iterdir()) == []


def test_columns_of_ones_own(atlas, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "my_columns.py").write_text(
        "def edges(mechanism):\n    return len(mechanism.joints)\n"
        "def fails(mechanism):\n    return 1 // 0\n"
        "def wrong(mechanism):\n    return [1]\n"
    )
    words = ("atlas", "query", atlas, "kind IN ('chain', 'sc')", "--columns", "id,kind,joints")
    rows = json.loads(run(*words, "--column", "edges=my_columns:edges", "--json").output)
    assert rows
    assert all(row["edges"] == row["joints"] for row in rows)
    run(*words, "--column", "edges=my_columns:edges", "-o", tmp_path / "rows.csv")
    assert (tmp_path / "rows.csv").read_text().splitlines()[0] == "id,kind,joints,edges"
    run(*words, "--column", "edges=my_columns:edges", "-o", tmp_path / "rows.tex")
    assert "edges" in (tmp_path / "rows.tex").read_text()
    for column, said in (
        ("edges", "is not NAME=MODULE:FUNCTION"),
        ("edges=nowhere:edges", "cannot be imported"),
        ("links=my_columns:edges", "already"),
        ("e=my_columns:fails", "ZeroDivisionError"),
        ("e=my_columns:wrong", "of type list"),
        ("e=my_columns:__name__", "is not a function"),
    ):
        assert said in run(*words, "--column", column, code=2).output
