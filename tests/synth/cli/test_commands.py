"""The command line: words, exit status, JSON, and harm done by odd input (none)."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import jsonschema
import pytest
from commands import run
from strategies import ODD_NAMES

import synth
from graphs.errors import InvariantError
from graphs.files.formats import read, write
from graphs.loops.loop import Loop
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Sheet

KEYS = {"file", "class", "links", "joints", "loops", "centres", "mobility", "equations", "exact", "pose",
        "repairs", "warnings"}  # fmt: skip


def test_mobility_of_one_file(data):
    out = run("mobility", data / "wiener" / "hybrid-ten-bar.json").stdout
    assert "mobility M = 2   (hybrid)" in out
    assert re.search(r"spherical system \(Wiener Eq. 3\) +5 +no", out)
    assert "exact generic mobility 2   (rank 9 modulo two primes)" in out
    assert "exact" not in run("mobility", "--no-exact", data / "wiener" / "hybrid-ten-bar.json").stdout


def test_mobility_of_several_files(data):
    out = run("mobility", "--no-exact", data / "wiener" / "watt.json", data / "wampler" / "fig9.json").stdout
    assert re.search(r"spherical system +1 +6 +7 +2 +2 +1", out)
    assert re.search(r"polyhedron model +1 +- +- +- +0 +1", out)


def test_mobility_json_has_the_promised_keys(data):
    files = sorted(data.glob("w*/*.json")) + sorted(data.glob("patterns/*.fold"))
    reports = json.loads(run("mobility", "--json", *files).stdout)
    assert [report["file"] for report in reports] == list(map(str, files))
    for report in reports:
        assert report.keys() >= KEYS
        assert report["exact"]["primes"] == [2**61 - 1, 2**61 - 31]
        assert report["exact"]["mobility"] >= report["mobility"]
        if report["file"].endswith(".fold"):
            assert report["pose"].keys() >= {"dof", "gap", "h"}
            assert report["pose"]["h"] == report["pose"]["dof"] - report["mobility"]
        else:
            assert report["pose"] is None
        for one in report["equations"].values():
            assert one.keys() == {"value", "applies", "why"}
            assert isinstance(one["applies"], bool)
    watt = next(r for r in reports if r["file"].endswith("watt.json"))
    assert (watt["links"], watt["joints"], watt["loops"], watt["centres"], watt["mobility"]) == (6, 7, 2, 2, 1)


def test_good_files_are_reported_and_bad_ones_named(data, tmp_path):
    (tmp_path / "bad.json").write_text("{", encoding="utf-8")
    (tmp_path / "three.fold").write_text('{"faces_vertices": [[0,1,2],[0,1,3],[0,1,4]]}', encoding="utf-8")
    good = data / "wiener" / "watt.json"
    result = run("mobility", "--json", tmp_path / "bad.json", good, tmp_path / "three.fold", code=2)
    assert [report["file"] for report in json.loads(result.stdout)] == [str(good)]
    lines = result.stderr.splitlines()
    assert len(lines) == 2
    assert lines[0].startswith(f"{tmp_path}/bad.json: line 1 column 2: not JSON")
    assert "three.fold: the edge (0, 1) belongs to 3 faces" in lines[1]
    assert "watt.json" in run("mobility", tmp_path / "bad.json", good, code=2).stdout


def test_a_crease_pattern_tells_its_flaps_and_its_flat_edges(tmp_path):
    path = tmp_path / "a.fold"
    path.write_text(
        '{"vertices_coords": [[0,0],[1,0],[1,1],[0,1],[2,0]], "faces_vertices": [[0,1,2],[0,2,3],[1,4,2]],'
        ' "edges_vertices": [[0,2],[1,2]], "edges_assignment": ["F","M"]}',
        encoding="utf-8",
    )
    out = run("mobility", path).stdout
    assert "mobility M = 1" in out
    assert "2 flap(s), panels with one hinge: a freedom each" in out
    assert "with flat edges hinged: links 3, joints 2, M 2" in out
    assert "with flat edges merged: links 2, joints 1, M 1" in run("mobility", "--hinge-flat", path).stdout
    (report,) = json.loads(run("mobility", "--json", path).stdout)
    assert report["counts"]["flaps"] == 2


def test_the_report_of_a_crease_pattern_has_its_counts(data):
    (report,) = json.loads(run("mobility", "--json", data / "patterns" / "bird-base.fold").stdout)
    assert report["counts"]["interior_vertices"] == 5
    assert report["counts"]["parts"] == 1
    out = run("mobility", data / "patterns" / "bird-base.fold").stdout
    assert "interior vertices 5" in out
    assert "flat state" in out


def test_a_table_is_sorted_with_totals_and_failures_at_the_end(data, tmp_path):
    (tmp_path / "b.fold").write_text("{}", encoding="utf-8")
    files = [data / "wiener" / "watt.json", tmp_path / "b.fold", data / "wiener" / "six-bar.json"]
    result = run("mobility", "--no-exact", *files, code=2)
    assert result.stdout.index("six-bar.json") < result.stdout.index("watt.json")
    assert "2 mechanism(s) reported, 1 failed" in result.stdout
    assert result.output.rstrip().splitlines()[-1].startswith(f"{tmp_path}/b.fold: faces_vertices: missing")


def test_a_terminal_shows_progress_where_it_takes_long(data, monkeypatch, capsys):
    import io

    from synth.cli import output

    class Terminal(io.StringIO):
        def isatty(self):
            return True

    screen = Terminal()
    monkeypatch.setattr("sys.stderr", screen)
    files = [str(data / "wiener" / name) for name in ("watt.json", "six-bar.json")]
    assert len(list(output.entries(files, [], patience=-1.0))) == 2
    assert "1 of 2 files" in screen.getvalue()
    assert screen.getvalue().endswith("\r")
    assert not capsys.readouterr().out


def test_a_file_of_many_graphs(tmp_path):
    (tmp_path / "two.g6").write_text("Cl\nC~\n", encoding="ascii")
    reports = json.loads(run("mobility", "--json", tmp_path / "two.g6").stdout)
    assert [report["file"].rsplit(":", 1)[1] for report in reports] == ["1", "2"]


@pytest.mark.parametrize("name", ODD_NAMES)
def test_odd_names_do_no_harm(name, tmp_path):
    path = tmp_path / "odd.json"
    sc = SCGraph([name, "b"], {name: (name, "b"), "other": (name, "b")}, [Loop((name, "other"), name=name)])
    write(sc, path)
    out = run("mobility", path).stdout
    assert all(len(line) < 200 for line in out.splitlines())
    assert "\x1b" not in out
    json.loads(run("mobility", "--json", path).stdout)
    scd = SCDGraph([name, "b"], {"j": (name, "b")}, rotation={name: ("j", None, None), "b": ("j", None, None)})
    write(scd, path, force=True)
    out = run("reconstruct", path).stdout
    assert all(len(line) < 200 for line in out.splitlines())
    json.loads(run("reconstruct", "--json", path).stdout)
    write(SCGraph([name, "b"], {"x": (name, "b"), "y": (name, "b")}, [Loop(("x",))] * 0), path, force=True)
    path.write_text(path.read_text(encoding="utf-8").replace('"b"]', '"gone"]', 1), encoding="utf-8")
    result = run("mobility", path, code=2)
    assert len(result.stderr.splitlines()) == 1
    assert len(result.stderr) < 400 + len(str(path))


def test_terminal_control_in_names_is_not_printed(tmp_path):
    path = tmp_path / "a.json"
    scd = SCDGraph(
        ["\x1b[2Jx", "b"], [("\x1b[2Jx", "b")], rotation={"\x1b[2Jx": (0, None, None), "b": (0, None, None)}
    )
    write(scd, path)
    assert "\x1b" not in run("reconstruct", path).stdout


def test_convert_round_trip(data, tmp_path):
    scd = tmp_path / "scd.json"
    run("convert", data / "patterns" / "bird-base.fold", scd, "--to", "scd")
    assert isinstance(read(scd), SCDGraph)
    run("convert", scd, tmp_path / "back.fold")
    run("convert", tmp_path / "back.fold", tmp_path / "sc.json")
    sc = read(tmp_path / "sc.json")
    assert (len(sc), len(sc.joints), len(sc.loops)) == (16, 20, 5)
    run("convert", data / "wiener" / "miura-3x3.fold", tmp_path / "model.json", "--to", "polyhedron")
    model = read(tmp_path / "model.json")
    assert isinstance(model, PolyhedronModel)
    assert len(model.coordinates) == 16
    run("convert", data / "wiener" / "nine-bar-mesh.json", tmp_path / "ve.json", "--to", "vertex-edge")
    run("convert", tmp_path / "ve.json", tmp_path / "sc2.json", "--to", "sc")
    assert len(read(tmp_path / "sc2.json")) == 9


def test_convert_tells_what_is_lost(data, tmp_path):
    watt = data / "wiener" / "watt.json"
    assert "not stored: 2 loops and their centres" in run("convert", watt, tmp_path / "watt.graphml").stdout
    told = json.loads(run("convert", watt, tmp_path / "watt.g6", "--json").stdout)
    assert told["lost"] == ["2 loops and their centres"]
    assert told["kind"] == "SCGraph"
    result = run("convert", watt, tmp_path / "watt.fold", code=2)
    assert result.stderr.splitlines() == [
        f"{watt}: the order of the sides of the links is not known: write an SCD graph or a sheet"
    ]
    assert not (tmp_path / "watt.fold").exists()


@pytest.mark.parametrize(("form", "centres"), [("planar", 1), ("spherical", 1), ("general", 2)])
def test_convert_changes_the_centres(form, centres, data, tmp_path):
    out = tmp_path / "out.json"
    run("convert", data / "wiener" / "watt.json", out, "--form", form)
    (report,) = json.loads(run("mobility", "--json", out).stdout)
    assert (report["centres"], report["mobility"]) == (centres, 1)


def test_reduce_shows_chains_and_writes_what_is_left(data, tmp_path):
    out = run("reduce", data / "wiener" / "fortune-teller.json", "-o", tmp_path / "eight.json").stdout
    assert "before  links 16, joints 20, mobility 5" in out
    assert "after   links 8, joints 8, mobility 5" in out
    assert "4 step(s) in 4 adjunct addenda" in out
    assert len(read(tmp_path / "eight.json")) == 8
    told = json.loads(run("reduce", "--json", data / "wiener" / "fortune-teller.json").stdout)
    assert told["before"] == {"links": 16, "joints": 20, "mobility": 5}
    assert told["after"] == {"links": 8, "joints": 8, "mobility": 5}
    assert [step["sits_on"] for step in told["steps"]] == [None] * 4
    assert (
        "nothing to take off" in run("reduce", data / "wiener" / "watt.json", "--keep", "1", "--keep", "4").stdout
    )
    assert (
        "after   links 2, joints 1, mobility 1"
        in run("reduce", "--fully", data / "wampler" / "fig12-scd.json").stdout
    )
    result = run("reduce", data / "wiener" / "watt.json", "--keep", "sky", code=2)
    assert "'sky' is no link; expected one of 0, 1, 2, 3, 4, 5" in result.stderr
    stephenson = data / "wiener" / "stephenson.json"
    assert (
        "needs --ground LINK and an --input JOINT" in run("reduce", "--rule", "assur", stephenson, code=2).stderr
    )
    words = ("reduce", stephenson, "--rule", "assur", "--ground", 0, "--input", 0)
    out = run(*words).stdout
    assert re.search(r"group 1: links 1, joints 0, input 0\n", out)
    assert out.count("(taken off)") == 2
    told = json.loads(run(*words, "--json").stdout)
    assert (told["before"]["mobility"], told["after"]["mobility"], told["after"]["links"]) == (1, 1, 2)
    assert "belong to --rule assur" in run("reduce", stephenson, "--input", 0, code=2).stderr
    assert "need one centre" in run("reduce", data / "wiener" / "watt.json", *words[2:], code=2).stderr


def test_edit_tells_predicted_and_counted_change(data, tmp_path):
    six = data / "wiener" / "six-bar.json"
    out = run("edit", six, "--add-ride-along", "0,1", "--lock", "0", "-o", tmp_path / "out.json").stdout
    assert re.search(r"ride-along on \d and \d +Eq. 7 +0 +0 +1", out)
    assert re.search(r"lock joint 0 +Eq. 7 +-1 +-1 +0", out)
    assert isinstance(read(tmp_path / "out.json"), SCDGraph)
    told = json.loads(run("edit", "--json", data / "wiener" / "watt.json", "--add-loop", "0,1,3", "--add-spatial-loop",
                          "0,1,4", "--add-crease", "2:1").stdout)["edits"]  # fmt: skip
    assert [(one["predicted"], one["counted"], one["equation"]) for one in told] == [
        (1, 1, "Eq. 6"), (1, 1, "Eq. 6"), (-1, -1, "Eq. 5")
    ]  # fmt: skip
    fan = tmp_path / "fan.json"
    run("convert", data / "patterns" / "four-bar-vertex.fold", fan, "--to", "scd")
    moved = json.loads(run("edit", "--json", fan, "--implicit", "0", "-o", tmp_path / "away.json").stdout)["edits"]
    assert [one["predicted"] for one in moved] == [0]
    run("edit", tmp_path / "away.json", "--explicit", "0", "-o", tmp_path / "back.json")
    assert read(tmp_path / "back.json").is_identical(read(fan))
    mesh = data / "wiener" / "nine-bar-mesh.json"
    a, _, b, _ = read(mesh).vertices[4]
    assert re.search(r"crease in 4 +Eq. 7 +1 +1 +1", run("edit", mesh, "--add-crease", f"4:{a},{b}").stdout)


def test_an_edited_pattern_is_a_pattern(data, tmp_path):
    bird, out = data / "patterns" / "bird-base.fold", tmp_path / "x.fold"
    words = ["--lock", "3", "--add-crease", "-1,0.3:1,0.3", "--remove-crease", "0", "--lock", "8,10"]
    told = json.loads(run("edit", bird, *words, "-o", out, "--json").stdout)
    assert [one["what"].split(" ")[0] for one in told["edits"]] == ["lock", "lock", "crease", "remove"]
    assert told["lost"] == []
    edited = read(out)
    assert isinstance(edited, Sheet)
    [report] = json.loads(run("mobility", out, "--json").stdout)
    assert report["mobility"] == told["edits"][-1]["mobility"]
    before, after = (sum(letter == "F" for letter in sheet.assignments) for sheet in (read(bird), edited))
    assert after >= before + 2
    ridden = tmp_path / "ridden.json"
    run("edit", bird, "--add-ride-along", "0,1", "-o", ridden)
    assert isinstance(read(ridden), SCGraph)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--lock", "99"], "'99' is no edge; expected one of 0, 1, 2, 3, 5, 6, "),
        (["--add-crease", "0"], "'0' is not A:B, two vertices or points X,Y of the pattern"),
        (["--add-crease", "0:sky"], "'sky' is neither a vertex nor a point X,Y"),
        (
            ["--add-crease", "0.3,0.1:2"],
            "the nearest are vertex 9 (0.585786, 0) and edge 0 (V) from vertex 0 (0, 0)",
        ),
        (["--remove-crease", "0", "--add-ride-along", "0,1"], "--remove-crease is for crease patterns"),
    ],
)
def test_edits_of_patterns_that_cannot_be(words, message, data):
    assert message in run("edit", data / "patterns" / "bird-base.fold", *words, code=2).stderr


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--lock", "99"], "'99' is no joint; expected one of 0, 1, 2, 3, 4, 5, 6"),
        (["--implicit", "0"], "--implicit needs the sides of the links: an SCD graph"),
        (["--add-ride-along", "0"], "'0' has 1 part(s), not 2"),
        (["--add-ride-along", "0,sky"], "'sky' is no link"),
        (["--add-loop", "0,1,x"], "'x' is not a number"),
        ([], "name an edit"),
    ],
)
def test_edits_that_cannot_be(words, message, data):
    assert message in run("edit", data / "wiener" / "watt.json", *words, code=2).stderr


def test_reconstruct_writes_the_model(data, tmp_path):
    out = run("reconstruct", data / "wiener" / "table3-row3.json", "-o", tmp_path / "model.json").stdout
    assert "V = 9, C = 1, E = 15 external + 8 internal, M = 1" in out
    assert "explicit centre" in out
    told = json.loads(run("reconstruct", data / "wiener" / "table3-row3.json", "--json").stdout)
    assert [v["vertex"] for v in told["vertices"]] == list(range(9))
    (report,) = json.loads(run("mobility", "--json", tmp_path / "model.json").stdout)
    assert (report["mobility"], report["centres"], report["counts"]["edges"]) == (1, 1, 23)
    schema = Path(__file__).resolve().parents[3] / "graphs" / "schema" / "polyhedron.schema.json"
    jsonschema.validate(json.loads((tmp_path / "model.json").read_text()), json.loads(schema.read_text()))


def test_reconstruct_needs_the_sides_of_the_links(data):
    result = run("reconstruct", data / "wiener" / "watt.json", code=2)
    assert "the order of the sides of the links is not known" in result.stderr


@pytest.mark.parametrize(
    "words", [[], ["mobility"], ["nonsense"], ["convert", "a.json"], ["mobility", "--pose", "-1", "a.json"]]
)
def test_usage_errors_keep_clicks_format(words):
    result = run(*words, code=2)
    assert "Usage:" in result.output


def test_frames_of_a_fold_file(tmp_path):
    square = {"vertices_coords": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]],
              "faces_vertices": [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]]}  # fmt: skip
    folded = {"frame_inherit": True, "frame_parent": 0,
              "vertices_coords": [[0, 0, 0], [1, 0, 0.1], [0, 1, 0.4], [-1, 0, 0.2], [0, -1, 0.3]]}  # fmt: skip
    file = tmp_path / "two-frames.fold"
    file.write_text(json.dumps({**square, "file_frames": [folded]}))
    dofs = [json.loads(run("mobility", "--json", "--pose", n, file).stdout)[0]["pose"]["dof"] for n in (0, 1)]
    assert dofs == [2, 1]
    assert "flat state: more infinitesimal freedoms" in run("mobility", file).stdout
    assert "no frame 2; expected a frame from 0 to 1" in run("mobility", "--pose", 2, file, code=2).stderr
    bare = {key: value for key, value in square.items() if key != "vertices_coords"}
    file.write_text(json.dumps({**bare, "file_frames": [folded]}))
    assert json.loads(run("mobility", "--json", file).stdout)[0]["pose"]["dof"] == 1
    assert "need coordinates" in run("mobility", "--pose", 0, file, code=2).stderr


def test_a_pattern_without_frames_lies_one_way(data, tmp_path):
    drawing = tmp_path / "bird.svg"
    run("convert", data / "patterns" / "bird-base.fold", drawing)
    assert json.loads(run("mobility", "--json", "--pose", 0, drawing).stdout)[0]["pose"]["dof"] == 10
    assert "has no frames; expected a .fold file" in run("mobility", "--pose", 1, drawing, code=2).stderr


def test_a_pose_of_what_has_none(data):
    assert "no freedoms at a pose" in run("mobility", "--pose", 0, data / "wiener" / "watt.json").stdout


def test_overconstraint_is_located(data):
    out = run("mobility", data / "wiener" / "mesh-4x4-edge-creases.json").stdout
    assert re.search(
        r"exact generic mobility is 2, the count says 1: 1 closure equation\(s\) idle, among joints", out
    )
    assert "17 joint(s) stiff in general" in out


@pytest.mark.parametrize(
    "command",
    [
        "mobility",
        "id",
        "reduce",
        "edit",
        "enumerate",
        "cone",
        "cylinder",
        "convert",
        "reconstruct",
        "order",
        "dyads",
        "fourbar",
    ],
)
def test_every_help_text_has_an_example(command):
    out = run(command, "--help").stdout
    assert re.search(rf"Examples?:\n +synth {command} ", out)
    assert "--json" in out or command in ("enumerate", "cone", "cylinder")


def test_help_needs_neither_networkx_nor_rich():
    code = (
        "import sys; from synth.cli.main import main\n"
        "try: main(['--help'])\n"
        "except SystemExit: pass\n"
        "heavy = {'networkx', 'numpy', 'rich', 'graphs.mechanism.sc'} & set(sys.modules)\n"
        "sys.exit(f'imported: {heavy}' if heavy else 0)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_a_closed_pipe_leaves_no_traceback(data):
    """As with `synth mobility ... | head -1`."""
    files = sorted(map(str, data.glob("w*/*.json"))) * 4
    with subprocess.Popen(
        [sys.executable, "-m", "synth.cli", "mobility", "--json", *files],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=os.environ | {"PYTHONUNBUFFERED": "1"},
    ) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.readline()
        process.stdout.close()
        assert b"Traceback" not in process.stderr.read()


def test_shell_completion_knows_the_commands():
    env = os.environ | {"_SYNTH_COMPLETE": "bash_complete", "COMP_WORDS": "synth ", "COMP_CWORD": "1"}
    code = "from synth.cli.main import main; main(prog_name='synth')"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, env=env)
    assert set(re.findall(r"plain,(\w+)", done.stdout)) == {
        "mobility",
        "fold",
        "positions",
        "explain",
        "states",
        "limits",
        "advise",
        "atlas",
        "draw",
        "view",
        "reduce",
        "edit",
        "enumerate",
        "cone",
        "cylinder",
        "convert",
        "reconstruct",
        "id",
        "generate",
        "realise",
        "template",
        "order",
        "dyads",
        "fourbar",
    }


def test_names_that_are_near_are_told():
    assert "Did you mean 'mobility'?" in run("mobilty", "x.fold", code=2).output
    assert "Did you mean 'miura'?" in run("generate", "miurra", code=2).output
    assert "Did you mean" not in run("xyzzy", code=2).output


def test_versions_of_what_matters_are_told():
    told = run("--version").output
    assert re.search(r"^synth, version \d+\.\d+", told)
    assert "numpy" in told
    assert "Python" in told


def test_angles_that_look_like_radians_are_told():
    assert "2.09 looks like radians: 119.7 degrees" in run("cone", "map", "--angles", "2.09,1.66,0.79,1.48").output
    assert "looks like" not in run("cone", "map", "--angles", "120,95,45,85").output
    with pytest.raises(InvariantError, match="120 looks like degrees"):
        synth.map_to_cones([120, 95, 45, 85])
