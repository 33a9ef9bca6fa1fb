"""``synth enumerate conical``: rows, files, pictures, formulas, wrong words."""

from __future__ import annotations

import json
import re
import shlex

import pytest
from commands import run

from enumerate.runner.job import row_as_dict
from enumerate.runner.store import read_rows
from graphs.files.formats import read_linkage


def test_enumerate_conical(tmp_path, data):
    base = ("enumerate", "conical", "--chain", "stephenson")
    assert run(*base, "--count").stdout == run(*base, "--count", "--method", "orbits").stdout == "102\n"
    assert run(*base, "--ground", "all", "--count").stdout == "552\n"
    rows = json.loads(run(*base, "--json").stdout)
    assert len(rows) == 102
    assert list(rows[0]) == ["chain", "ground", "joins", "order", "slots", "symmetry", "loops", "circuits", "open_loops",
                             "density", "turns", "layers", "most_layers", "full_rank"]  # fmt: skip
    some = json.loads(run(*base, "--open", "2..", "--json").stdout)
    assert some == [row for row in rows if row["open_loops"] >= 2]
    assert run(*base, "--open", "2..", "--count").stdout == f"{len(some)}\n"
    file = data / "wiener" / "stephenson.json"
    assert run("enumerate", "conical", "--chain", file, "--ground", "none", "--count").stdout == "102\n"
    assert run("enumerate", "conical", "--chain", rows[0]["chain"], "--count").stdout == "102\n"
    placed = (*base, "--ground", 0, "--slots", 7, "--lambda", 20)
    files = {name: tmp_path / name for name in ("c.jsonl", "c.sqlite", "c.parquet", "folder")}
    for one in files.values():
        assert f"\nwritten: {one}\n" in run(*placed, "-o", one).output
    found = json.loads(run(*placed, "--json").stdout)
    assert run(*placed, "--quiet", "--force", "-o", files["c.jsonl"]).output == ""
    assert [json.loads(line) for line in files["c.jsonl"].read_text().splitlines()] == found
    assert [row_as_dict(found[0], row) for row in read_rows(files["c.sqlite"])] == found
    table = pytest.importorskip("pyarrow.parquet").read_table(files["c.parquet"]).to_pylist()
    assert [{**row, "link_angles_deg": json.loads(row["link_angles_deg"])} for row in table] == found
    assert found[0]["link_angles_deg"][0][:2] == ["0", "1"]
    for path, row in zip(sorted(files["folder"].iterdir()), found, strict=True):
        linkage = read_linkage(path)
        assert str(linkage.chain.ground) == row["ground"]
        mapped = json.loads(run("cone", "map", path, "--json").stdout)["cones"]
        assert mapped[0]["lambda_deg"] == pytest.approx(20)
        break
    ordered = json.loads(run(*placed, "--sort", "-least_singular_value", "--json").stdout)
    values = [row["least_singular_value"] for row in ordered]
    assert values == sorted(values, reverse=True)
    assert sorted(row["slots"] for row in ordered) == sorted(row["slots"] for row in found)


def test_a_file_of_a_candidate_behaves_as_its_row_says(tmp_path):
    words = ("--ground", 0, "--slots", 6, "--lambda", 25)
    rows = json.loads(run("enumerate", "conical", "--chain", "four-bar", *words, "--json").stdout)
    run("enumerate", "conical", "--chain", "four-bar", *words, "-o", tmp_path / "folder")
    for path, row in zip(sorted((tmp_path / "folder").iterdir()), rows, strict=True):
        if row["half_turn_steps"]:  # its link may take either half
            continue
        [report] = json.loads(run("cone", "behaviour", path, "--json").stdout)["linkages"]
        assert report["rank"] == row["rank"]
        told = {str(one["link"]): one["way"] for one in report["links"]}
        assert {link: way for link, way in row["ways"] if way != "fixed"} == {
            link: way for link, way in told.items() if link != str(report["ground"])
        }


def test_pictures(tmp_path):
    pytest.importorskip("matplotlib")
    folder = tmp_path / "pictures"
    run("enumerate", "conical", "--chain", "four-bar", "--pictures", folder, "--json")
    assert sorted(path.name for path in folder.iterdir()) == ["00001.png", "00002.png"]
    assert all(path.read_bytes().startswith(b"\x89PNG") for path in folder.iterdir())
    again = run("enumerate", "conical", "--chain", "four-bar", "--pictures", folder, code=2)
    assert "exists already" in again.stderr


def test_examples_of_the_help_text_run(tmp_path, monkeypatch, data):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "data").symlink_to(data)
    out = run("enumerate", "conical", "--help").stdout
    examples = re.findall(r"^ +synth (.*)$", out.partition("Example")[2], re.MULTILINE)
    assert len(examples) == 8
    for example in examples:
        if "--slots 12" not in example:  # the 249 600 of the benchmark
            run(*shlex.split(example))


def test_formulas():
    out = run("enumerate", "conical", "--chain", "four-bar", "--ground", 0, "--formulas").stdout
    assert "  2: " in out
    assert "link 0 fixed" in out


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--chain", "wat"], "neither a chain nor a file; expected four-bar"),
        (["--chain", "k1:!"], "'k1:!' is not the id of a chain"),
        (["--chain", "nowhere.json"], "nowhere.json: no such file"),
        (["--chain", "watt", "--ground", "9"], "9"),
        (["--chain", "watt", "--slots", 6], "6 slots for 7 joints"),
        (["--chain", "watt", "--slots", 2], "2 is not in the range"),
        (["--chain", "watt", "--lambda", 20], "without angles"),
        (["--chain", "watt", "--slots", 8, "--lambda", 90], "cone angle is 90 degrees"),
        (["--chain", "watt", "--rank", 6], "no column 'rank'"),
        (["--chain", "watt", "--sort", "rank"], "no column 'rank'"),
        (["--chain", "watt", "--formulas"], "--formulas requires --ground LINK"),
        (["--chain", "watt", "--method", "orbits"], "--method requires --count"),
        (["--chain", "watt", "--count", "--sort", "order"], "--count excludes --sort"),
        (["--chain", "watt", "--count", "--open", 2, "--method", "orbits"], "without filters"),
        (["--chain", "watt", "-o", "x.sqlite", "--resume", "--sort", "order"], "--resume excludes"),
        (["--chain", "watt", "-o", "x.g6"], "graph6 cannot hold angles"),
    ],
)
def test_candidates_that_cannot_be_listed(words, message, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert message in run("enumerate", "conical", *words, code=2).stderr
