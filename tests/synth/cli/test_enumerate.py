"""The command line of the enumerators: rows, counts, files, and wrong words."""

from __future__ import annotations

import csv
import json
import re

import pytest
from commands import run

from enumerate.runner.job import row_as_dict
from enumerate.runner.store import read_rows
from graphs.files.formats import read
from graphs.identity.chains import chain_id
from graphs.identity.drawings import map_id


def test_enumerate_strings(tmp_path):
    rows = json.loads(run("enumerate", "strings", "--json").stdout)
    assert len(rows) == 20
    assert rows[-2]["string"] == "RR-R-RRR"
    assert rows[-2].keys() == {"creases", "string", "joints", "distance", "dof", "modes", "comment"}
    assert re.search(r"6 +RR-R-RRR +UPS +variable +6 +2", run("enumerate", "strings").stdout)
    assert run("enumerate", "strings", "--count").stdout == "20\n"
    assert json.loads(run("enumerate", "strings", "--count", "--json").stdout) == {"count": 20}
    assert run("enumerate", "strings", "--dof", 30, "--max-panels", "none", "--count").stdout == "26903492\n"
    assert run("enumerate", "strings", "--modes", "--max-dof", 6, "--count").stdout == "30\n"
    moded = json.loads(run("enumerate", "strings", "--dof", 6, "--modes", "--json").stdout)
    assert [row["mode"] for row in moded if row["string"] == "RR-RR-RR"] == ["SS", "DS", "DD"]
    run("enumerate", "strings", "-o", tmp_path / "s.jsonl")
    assert [json.loads(line) for line in (tmp_path / "s.jsonl").read_text().splitlines()] == rows
    many = run("enumerate", "strings", "--dof", 14, "--max-panels", "none").stdout.splitlines()
    assert many[0].split("\t")[:2] == ["creases", "string"]
    assert len(many) == 1 + int(run("enumerate", "strings", "--dof", 14, "--max-panels", "none", "--count").stdout)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--dof", 3, "--max-dof", 4], "--dof and --max-dof exclude each other"),
        (["--max-panels", "many"], "'many' is neither a number nor none"),
        (["--max-cluster", 0], "max_cluster is 0; expected 1 or more"),
        (["--dof", 0], "0 is not in the range"),
        (["-o", "strings.txt"], "strings.txt: files ending in '.txt' are not known; expected .jsonl"),
    ],
)
def test_strings_that_cannot_be_listed(words, message):
    assert message in run("enumerate", "strings", *words, code=2).stderr


def test_enumerate_chains(tmp_path):
    base = ("enumerate", "chains", "--links", 8, "--dof", 1)
    rows = json.loads(run(*base, "--json").stdout)
    assert len(rows) == 16
    assert rows[0].keys() == {"code", "links", "joints", "dof", "loops", "assortment", "longest_string", "symmetry",
                              "inversions", "planar", "fractionated"}  # fmt: skip
    assert run(*base, "--count").stdout == run(*base, "--count", "--method", "burnside").stdout == "16\n"
    for method in ("orbits", "burnside"):
        said = json.loads(run(*base, "--count", "--json", "--method", method).stdout)
        assert said == {"count": 16, "by_size": {"4": 9, "3": 5, "2": 2}}
        said = json.loads(run(*base, "--count", "--inversions", "--json", "--method", method).stdout)
        assert said == {"count": 71, "by_size": {"4": 35, "3": 31, "2": 5}}
    assert run(*base, "--count", "--inversions").stdout == "71\n"
    assert run(*base, "--count", "--assortment", "4,4").stdout == "9\n"
    filters = ("--symmetry", "4..", "--longest-string", "..2", "--planar")
    assert json.loads(run(*base, "--json", *filters).stdout) == [
        row for row in rows if row["symmetry"] >= 4 and row["longest_string"] <= 2 and row["planar"]
    ]
    printed = run(*base).stdout
    assert printed.startswith("links 8  joints 10  dof 1  loops 3  planar yes  fractionated no")
    assert re.search(r"k1:\S+ +4,4 +\d +\d+ +\d ", printed)
    many = run("enumerate", "chains", "--links", 12, "--dof", 1).stdout.splitlines()
    assert len(many) == 6857
    assert many[0].startswith("code\tname\tlinks\tjoints")
    files = {name: tmp_path / name for name in ("c.g6", "c.csv", "c.jsonl", "c.sqlite", "c.parquet", "folder")}
    for file in files.values():
        assert run(*base, "-o", file).output == f"16 rows\nwritten: {file}\n"
    assert run(*base, "-o", files["c.csv"], "--force", "--quiet").output == ""
    codes = [row["code"] for row in rows]
    assert ["k1:" + line for line in files["c.g6"].read_text().splitlines()] == codes
    assert [json.loads(line) for line in files["c.jsonl"].read_text().splitlines()] == rows
    table = list(csv.DictReader(files["c.csv"].read_text().splitlines()))
    assert [one["code"] for one in table] == codes
    assert [json.loads(one["assortment"]) for one in table] == [row["assortment"] for row in rows]
    assert [row[0] for row in read_rows(files["c.sqlite"])] == codes
    assert pytest.importorskip("pyarrow.parquet").read_table(files["c.parquet"]).to_pylist() == rows
    assert [chain_id(read(file)) for file in sorted(files["folder"].iterdir())] == codes
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(files)
    reports = json.loads(run("mobility", "--json", files["c.g6"]).stdout)
    assert [report["mobility"] for report in reports] == [1] * 16
    shown = re.findall(r"c\.g6:(\d+) ", run("mobility", "--no-exact", files["c.g6"]).stdout)
    assert shown == [str(line) for line in range(1, 17)]
    assert f"{files['c.g6']}:7\n" in run("mobility", f"{files['c.g6']}:7").stdout


def test_enumerate_inversions_and_inputs(tmp_path):
    base = ("enumerate", "chains", "--links", 6, "--dof", 1)
    grounds = json.loads(run(*base, "--inversions", "--json").stdout)
    assert [row["ground"] for row in grounds].count(0) == 2
    assert len(grounds) == 5
    inputs = json.loads(run(*base, "--inputs", "--json").stdout)
    assert {(row["code"], row["ground"]) for row in grounds} == {(row["code"], row["ground"]) for row in inputs}
    assert all(len(pair) == 2 for row in inputs for pair in row["inputs"])
    run(*base, "--inversions", "-o", tmp_path / "mechanisms")
    assert [read(file).ground for file in sorted((tmp_path / "mechanisms").iterdir())] == [r["ground"] for r in grounds]
    message = run(*base, "--inversions", "-o", tmp_path / "c.g6", code=2).stderr
    assert "graph6 cannot hold the ground link" in message


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("--links 3 --dof 1", "3 is not in the range x>=4"),
        ("--links 8 --dof 1 --assortment 4;4", "is not a list of numbers such as 4,2"),
        ("--links 8 --dof 1 --symmetry 4...", "neither a number nor a range such as 2..4"),
        ("--links 8 --dof 1 --symmetry 4..2", "the range 4 to 2; expected the smaller number first"),
        ("--links 8 --dof 1 --method orbits", "--method requires --count"),
        ("--links 8 --dof 1 --resume", "--resume requires -o FILE.sqlite"),
        ("--links 8 --dof 1 --json -o x.g6", "-o and --json exclude each other"),
        ("--links 8 --dof 1 --count -o x.g6", "--count keeps its counts in a store only"),
        ("--links 8 --dof 1 -o chains.xyz", "expected one of .csv .g6 .jsonl .parquet .sqlite .tex, or a folder"),
        (
            "--links 8 --dof 1 -o no/such/chains.g6",
            "no/such/chains.g6: there is no folder 'no/such'; expected a folder that exists",
        ),
        ("--links 8 --dof 1 -o /proc/chains.g6", "cannot be written"),
        ("--links 8 --dof 1 -o /proc/chains.sqlite", "unable to open database file"),
        ("--links 8 --dof 1 -o chains.g6 --resume", "only a .sqlite store can be resumed"),
        ("--links 30 --dof 1 --count", "30 links with M = 1 have 14 loops; expected 11 at most"),
        ("--links 8 --dof 1 --inputs --count --method burnside", "Burnside's lemma cannot count"),
        ("--links 8 --dof 1 --scheduler there", "no Dask scheduler at 'there'"),
    ],
)
def test_enumerate_chains_wrong_words(words, message, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert message in run("enumerate", "chains", *words.split(), code=2).stderr
    assert not list(tmp_path.iterdir())


def test_numbers_that_no_chain_has():
    result = run("enumerate", "chains", "--links", 8, "--dof", 2, "--count")
    assert result.stdout == "0\n"
    assert "N - 1 and M must be both even or both odd" in result.stderr


def test_enumerate_sc(tmp_path):
    base = ("enumerate", "sc", "--links", 8, "--dof", 1)
    rows = json.loads(run(*base, "--json").stdout)
    assert len(rows) == 54
    assert list(rows[0]) == ["code", "chain", "links", "joints", "dof", "loops", "spatial", "centres", "infinite",
                             "assortment", "loop_sizes", "outer_size", "symmetry", "reduced", "exact_dof"]  # fmt: skip
    assert run(*base, "--count").stdout == run(*base, "--count", "--method", "burnside").stdout == "54\n"
    assert run(*base, "--count", "--embeddings").stdout == "20\n"
    assert json.loads(run(*base, "--count", "--centres", "2..", "--json").stdout) == {"count": 10}
    assert json.loads(run(*base, "--centres", 3, "--json").stdout) == [row for row in rows if row["centres"] == 3]
    files = {name: tmp_path / name for name in ("c.jsonl", "c.sqlite", "c.parquet", "folder")}
    for file in files.values():
        assert run(*base, "-o", file).output == f"54 rows\nwritten: {file}\n"
    assert [json.loads(line) for line in files["c.jsonl"].read_text().splitlines()] == rows
    assert [row_as_dict(rows[0], row) for row in read_rows(files["c.sqlite"])] == rows
    assert pytest.importorskip("pyarrow.parquet").read_table(files["c.parquet"]).to_pylist() == rows
    assert [map_id(read(file)) for file in sorted(files["folder"].iterdir())] == [row["code"] for row in rows]
    assert "graph6 cannot hold a drawing" in run(*base, "-o", tmp_path / "c.g6", code=2).stderr
    forms = run("enumerate", "sc", "--links", 6, "--dof", 1, "--per-chain").stdout
    assert re.search(r"watt +2 +1", forms)
    assert re.search(r"stephenson +1 +2", forms)
    hybrids = json.loads(run("enumerate", "sc", "--links", 9, "--dof", 1, "--spatial", 1, "--json").stdout)
    assert len(hybrids) == 6
    nothing = run("enumerate", "sc", "--links", 7, "--dof", 1)
    assert (nothing.stdout, "N - 1 and M must be both even or both odd" in nothing.stderr) == ("none\n", True)


def test_enumerate_scd(tmp_path, data):
    base = ("enumerate", "scd", "--links", 4, "--dof", 1, "--max-degree", 4)
    rows = json.loads(run(*base, "--json").stdout)
    assert len(rows) == 7
    assert {"code", "sc", "chain", "sides", "vertices", "explicit", "implicit", "exact_dof"} <= rows[0].keys()
    assert run(*base, "--count").stdout == run(*base, "--count", "--method", "orbits").stdout == "7\n"
    assert [row["vertices"] for row in json.loads(run(*base, "--vertices", "..6", "--json").stdout)] == [5, 6]
    sheets = json.loads(run(*base, "--all-explicit", "--symmetric", "--json").stdout)
    assert sheets == [row for row in rows if row["explicit"] == 1 and row["symmetry"] > 1]
    run(*base, "-o", tmp_path / "folder")
    models = sorted((tmp_path / "folder").iterdir())
    assert [map_id(read(file)) for file in models] == [row["code"] for row in rows]
    for file in models:
        run("reconstruct", file, "-o", tmp_path / "model.json", "--force")
        [report] = json.loads(run("mobility", "--json", tmp_path / "model.json").stdout)
        assert report["exact"]["mobility"] == 1
    watt = data / "wiener" / "watt.json"
    assert run("enumerate", "scd", "--of", watt, "--max-degree", 4, "--count").stdout == "27\n"
    open_chains = json.loads(run("enumerate", "scd", "--links", 4, "--dof", 3, "--max-degree", 3, "--json").stdout)
    assert [row["loops"] for row in open_chains] == [0, 0, 0]


def test_enumerate_addenda(tmp_path, data):
    base = ("enumerate", "addenda", "--of", data / "wiener" / "watt.json")
    rows = json.loads(run(*base, "--json").stdout)
    assert len(rows) == 13
    assert {row["exact_dof"] for row in rows} == {1}
    assert run(*base, "--count", "--delta-dof", 1).stdout == "13\n"
    assert "mechanism" not in run(*base).stdout
    run(*base, "-o", tmp_path / "folder")
    reports = json.loads(run("mobility", "--json", *sorted((tmp_path / "folder").iterdir())).stdout)
    assert [report["mobility"] for report in reports] == [1] * 13


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["sc", "--links", 8, "--dof", 1, "--embeddings"], "--method and --embeddings require --count"),
        (["sc", "--links", 8, "--dof", 1, "--count", "--method", "burnside", "--centres", 2], "Burnside's lemma cannot count"),
        (["sc", "--links", 22, "--dof", 1], "9 at most"),
        (["sc", "--links", 8, "--dof", 1, "--per-chain", "--count"], "synth enumerate chains --planar"),
        (["scd", "--max-degree", 4], "one of --links and --of FILE is required"),
        (["scd", "--max-degree", 2, "--links", 4, "--dof", 1], "2 is not in the range"),
        (["scd", "--max-degree", 4, "--of", "nowhere.json"], "nowhere.json"),
        (["scd", "--max-degree", 4, "--of", "nowhere.json", "--links", 4], "--of excludes --links"),
        (["addenda", "--of", "nowhere.json"], "nowhere.json"),
        (["addenda", "--of", "x.json", "--delta-dof", -5], "-5 is not in the range"),
    ],
)  # fmt: skip
def test_types_that_cannot_be_listed(words, message):
    assert message in run("enumerate", *words, code=2).stderr
