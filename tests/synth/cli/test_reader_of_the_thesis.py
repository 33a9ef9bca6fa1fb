"""What a reader of the thesis meets who has README and --help alone: defaults, names, numbers, next commands."""

import json
import re

import pytest
from commands import run
from sizes import slow


def test_defaults_are_printed_and_taken():
    for kind in ("chains", "sc", "scd"):
        text = run("enumerate", kind, "--help").stdout
        assert re.search(r"--dof M .{0,200}?\[default:\s+1", text, re.DOTALL), kind
        assert run("enumerate", kind, "--links", 6, "--count").stdout == (
            run("enumerate", kind, "--links", 6, "--dof", 1, "--count").stdout
        )
    assert re.search(r"--max-degree D .{0,150}?\[default:\s+4", run("enumerate", "scd", "--help").stdout)
    given = run("enumerate", "scd", "--links", 4, "--dof", 1, "--max-degree", 4).stdout
    assert run("enumerate", "scd", "--links", 4).stdout == given
    assert "one of --links and --of FILE is required" in run("enumerate", "scd", code=2).stderr


def test_lists_name_what_is_known():
    chains = run("enumerate", "chains", "--links", 6).stdout
    assert re.search(r"k1:E`hW +Watt chain", chains)
    assert re.search(r"k1:E@zO +Stephenson chain", chains)
    graphs = run("enumerate", "sc", "--links", 6).stdout
    assert re.search(r"m1:ab\.ac\.bde\.cfg\.dg\.ef +Stephenson six-bar", graphs)
    assert " name " not in run("enumerate", "chains", "--links", 7, "--dof", 2).stdout  # none of these has one


def test_names_are_those_of_the_file_of_names():
    from synth.synthesis.atlas.columns import name_of_id, named_types

    for entry in named_types():
        if entry.kind in ("chain", "sc"):
            assert entry.name in (name_of_id(entry.id) or "").split("; ")


def test_a_conical_row_says_which_links_its_joints_join(tmp_path):
    out = run("enumerate", "conical", "--chain", "four-bar", "--ground", 0).stdout
    assert "joins 0:0-1 1:0-2 2:1-3 3:2-3" in out
    file = tmp_path / "rows.jsonl"
    run("enumerate", "conical", "--chain", "four-bar", "--ground", 0, "-o", file)
    rows = [json.loads(line) for line in file.read_text().splitlines()]
    assert all(row["joins"] == [["0", "0", "1"], ["1", "0", "2"], ["2", "1", "3"], ["3", "2", "3"]] for row in rows)
    assert all({joint for joint, *_ in row["joins"]} == set(row["order"]) for row in rows)


@pytest.mark.parametrize("placed", [slow([]), ["--slots", 9]])
def test_two_commands_lead_from_a_candidate_to_a_linkage_that_moves(placed, tmp_path):
    file, linkage = tmp_path / "watt.jsonl", tmp_path / "watt.json"
    said = run("enumerate", "conical", "--chain", "watt", "--ground", 0, *placed, "-o", file).stdout
    assert "to move row K: synth cone move" in said
    moved = run("cone", "move", file, "--row", 2, "--lambda", 30).stdout
    assert "link 0 fixed" in moved
    assert "circuit closed" in moved
    said = run("realise", file, "--row", 2, "--as", "cone", "-o", linkage).stdout
    assert "1 infinitesimal degree of freedom" in said
    assert "next: synth cone move" in said
    assert "circuit closed" in run("cone", "move", linkage).stdout
    row, written = json.loads(file.read_text().splitlines()[1]), json.loads(linkage.read_text())
    assert [[one["id"], *map(str, one["links"])] for one in written["joints"]] == row["joins"]
    at = {written["steps"][0][0]: written.get("azimuth_deg", 0.0)}
    for first, second, step in written["steps"]:
        at[second] = at[first] + step
    turned = sorted(at, key=lambda joint: at[joint] % 360)
    first = turned.index(row["order"][0])
    assert turned[first:] + turned[:first] == row["order"]


def test_rows_are_of_candidates(tmp_path):
    assert "--row requires a FILE" in run("cone", "move", "--steps", "40,50,60", "--row", 1, code=2).stderr
    types = tmp_path / "chains.jsonl"
    run("enumerate", "chains", "--links", 6, "-o", types)
    assert "row 1 is no conical candidate" in run("cone", "move", types, "--row", 1, code=2).stderr


def test_strings_can_be_quiet(tmp_path):
    assert run("enumerate", "strings", "--dof", 2, "--quiet", "-o", tmp_path / "a.jsonl").stdout == ""
    assert "written" in run("enumerate", "strings", "--dof", 2, "-o", tmp_path / "b.jsonl").stdout


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({}, "key 'loops' is missing; expected a list of loops; a tree has none, \"loops\": []"),
        ({"joints": [[1, 2], [2, 3], [3, 4]], "loops": []}, "joints[2][1]: link 4 of 4 links; expected a link from 0 to 3"),
    ],
)  # fmt: skip
def test_errors_of_files_written_by_hand_say_what_is_meant(change, message, tmp_path):
    file = tmp_path / "a.json"
    joints = [[0, 1], [1, 2], [2, 3]]
    file.write_text(json.dumps({"format": "synthedra/sc", "version": 1, "links": 4, "joints": joints, **change}))
    assert message in run("mobility", file, code=2).stderr
    file.write_text(json.dumps({"format": "synthedra/sc", "version": 1, "links": 4, "joints": joints, "loops": []}))
    run("mobility", file)


def test_drawings_number_loops_as_options_do(data, tmp_path):
    """`synth edit --explicit LOOP` takes the number that stands beside the sign of the loop."""
    run("draw", data / "wiener" / "watt.json", "-o", tmp_path / "a.svg")
    labels = re.findall(r"<text[^>]*>([^<]*)<", (tmp_path / "a.svg").read_text())
    joints, links = [str(n) for n in range(7)], [str(n) for n in range(6)]
    rest = list(labels)
    for label in joints + links:
        rest.remove(label)
    assert rest[:2] == ["0", "1"]
    run("draw", data / "wiener" / "stephenson.json", "-o", tmp_path / "b.svg")
    assert {"0 = 1", "1 = 0"} <= set(re.findall(r"<text[^>]*>([^<]*)<", (tmp_path / "b.svg").read_text()))


def test_rows_of_conical_candidates_have_the_numbers_that_row_takes(tmp_path):
    printed = run("enumerate", "conical", "--chain", "four-bar", "--slots", 7, "--sort", "-grashof_loops").stdout
    assert printed.splitlines()[2].split()[:2] == ["row", "order"]
    numbers = [int(line.split()[0]) for line in printed.splitlines() if re.match(r" +\d+ +0 1", line)]
    assert numbers == list(range(1, 13))
    said = run("enumerate", "conical", "--chain", "four-bar", "--slots", 7, "-o", tmp_path / "a.jsonl").stdout
    assert f"to see the rows: the same command without -o, or synth draw {tmp_path / 'a.jsonl'} -o rows.pdf" in said
    run("draw", tmp_path / "a.jsonl", "-o", tmp_path / "rows.pdf")


def test_no_table_has_two_columns_of_one_name():
    head = run("enumerate", "sc", "--links", 6, "--per-chain").stdout.splitlines()[2].split()
    assert head == ["code", "name", "chain", "chain", "name", "centres", "forms"]


def test_names_of_types_are_none_of_files():
    from synth.synthesis.atlas.columns import named_types

    names = [entry.name for entry in named_types()]
    assert not [name for name in names if re.search(r"\bfig\d|\btable\d|\brow\d|\d bar|ride along|six bar", name)]
