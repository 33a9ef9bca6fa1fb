"""`synth mobility`: one file, many, what scripts rely on."""

from __future__ import annotations

import json
import re

from commands import run

import synth
from graphs.answer import mobility as counting
from synth.analysis.verdict import mobility_of_type

KEYS = {"file", "class", "links", "joints", "loops", "centres", "mobility", "equations", "exact", "pose",
        "repairs", "warnings"}  # fmt: skip


def test_mobility_of_one_file(data):
    out = run("mobility", "--verbose", data / "wiener" / "hybrid-ten-bar.json").stdout
    assert "mobility M = 2   (hybrid)" in out
    assert re.search(r"spherical system \(Wiener Eq. 3\) +5 +no", out)
    assert "generic realisation: mobility 2   (exact rank 9 modulo two primes)" in out
    assert "exact" not in run("mobility", "--no-exact", data / "wiener" / "hybrid-ten-bar.json").stdout


def test_mobility_of_several_files(data):
    out = run("mobility", "--no-exact", data / "wiener" / "watt.json", data / "wampler" / "fig9.json").stdout
    assert re.search(r"spherical system +1 +6 +7 +2 +2 +1", out)
    assert re.search(r"polyhedron model +1 +- +- +- +0 +1", out)


def test_mobility_json_has_the_promised_keys(data):
    files = sorted([*data.glob("wampler/*.json"), *data.glob("wiener/*.json")]) + sorted(data.glob("patterns/*.fold"))
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
    assert "2 flaps (panels with one hinge): 1 degree of freedom each" in out
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
    assert "2 mechanisms reported, 1 failed" in result.stdout
    assert result.output.rstrip().splitlines()[-1].startswith(f"{tmp_path}/b.fold: faces_vertices: missing")


def test_a_terminal_shows_progress_where_it_takes_long(data, monkeypatch, capsys):
    import io

    from synth.cli import reading

    class Terminal(io.StringIO):
        def isatty(self):
            return True

    screen = Terminal()
    monkeypatch.setattr("sys.stderr", screen)
    files = [str(data / "wiener" / name) for name in ("watt.json", "six-bar.json")]
    assert len(list(reading.entries(files, [], patience=-1.0))) == 2
    assert "1 of 2 files" in screen.getvalue()
    assert screen.getvalue().endswith("\r")
    assert not capsys.readouterr().out


def test_a_file_of_many_graphs(tmp_path):
    (tmp_path / "two.g6").write_text("Cl\nC~\n", encoding="ascii")
    reports = json.loads(run("mobility", "--json", tmp_path / "two.g6").stdout)
    assert [report["file"].rsplit(":", 1)[1] for report in reports] == ["1", "2"]


def test_frames_of_a_fold_file(tmp_path):
    square = {"vertices_coords": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]],
              "faces_vertices": [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]]}  # fmt: skip
    folded = {"frame_inherit": True, "frame_parent": 0,
              "vertices_coords": [[0, 0, 0], [1, 0, 0.1], [0, 1, 0.4], [-1, 0, 0.2], [0, -1, 0.3]]}  # fmt: skip
    file = tmp_path / "two-frames.fold"
    file.write_text(json.dumps({**square, "file_frames": [folded]}))
    dofs = [json.loads(run("mobility", "--json", "--pose", n, file).stdout)[0]["pose"]["dof"] for n in (0, 1)]
    assert dofs == [2, 1]
    assert "flat state: fewer once folded" in run("mobility", file).stdout
    assert "no frame 2; expected a frame from 0 to 1" in run("mobility", "--pose", 2, file, code=2).stderr
    bare = {key: value for key, value in square.items() if key != "vertices_coords"}
    file.write_text(json.dumps({**bare, "file_frames": [folded]}))
    assert json.loads(run("mobility", "--json", file).stdout)[0]["pose"]["dof"] == 1
    assert "require coordinates" in run("mobility", "--pose", 0, file, code=2).stderr


def test_a_pattern_without_frames_lies_one_way(data, tmp_path):
    drawing = tmp_path / "bird.svg"
    run("convert", data / "patterns" / "bird-base.fold", drawing)
    assert json.loads(run("mobility", "--json", "--pose", 0, drawing).stdout)[0]["pose"]["dof"] == 10
    assert "has no frames; expected a .fold file" in run("mobility", "--pose", 1, drawing, code=2).stderr


def test_a_pose_of_what_has_none(data):
    assert (
        "no degrees of freedom at a configuration" in run("mobility", "--pose", 0, data / "wiener" / "watt.json").stdout
    )


def test_overconstraint_is_located(data):
    out = run("mobility", data / "wiener" / "mesh-4x4-edge-creases.json").stdout
    assert re.search(r"exact generic mobility is 2, by count 1: 1 redundant closure equation, among joints", out)
    assert "17 joints generically immobile" in out


def test_overconstraint_of_a_large_sheet_is_located_on_request_up_to_a_limit(monkeypatch):
    sheet = synth.generate("miura", rows=18, columns=18).mechanism

    def note(**options):
        return mobility_of_type(sheet, **options).warnings[-1]

    assert note() == "the exact generic mobility is 0, by count -255; --exact says where equations are redundant"
    assert "is 0, by count -255: 255 redundant closure equations, among joints" in note(exact=True)
    assert "612 joints generically immobile" in note(exact=True)
    monkeypatch.setattr(counting, "_MOST_DIAGNOSED", 600)
    assert note(exact=True).endswith("where equations are redundant is not looked for among more than 600 joints")
