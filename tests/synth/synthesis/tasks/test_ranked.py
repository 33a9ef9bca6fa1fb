"""Designs of a task: each is checked by itself, a store continues and is asked again, empty answers say what is near."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner
from cranks import lines_apart
from scipy.spatial.transform import Rotation

import synth
from enumerate.runner import Interrupted, Limits
from graphs.errors import InvariantError, StoreError
from graphs.mechanism.sc import SCGraph
from synth.analysis.motion.linkage import link_motions
from synth.analysis.moving._configuration_of import configuration_of
from synth.cli.main import main
from synth.linkages.guidance.fourbars import four_bar_of, four_bars
from synth.linkages.guidance.orientations import Orientations
from synth.linkages.guidance.synthesis import dyads_of_five
from synth.synthesis.designing.defects import DefectKind
from synth.synthesis.tasks import candidates_of, ranked_types, read_task, report_page, structure_of, write_pages
from synth.synthesis.tasks.dimensioning import CandidateSearch, halved, is_watts
from synth.synthesis.tasks.ranking import Outcome

HEAD = {"format": "synthedra/task", "version": 1}


def lid(data, **keys):
    return {**json.loads((data / "tasks" / "lid.json").read_text()), **keys}


@pytest.fixture(scope="module")
def answer(data):
    return synth.task(data / "tasks" / "lid.json", starts=2, rounds=1)


def test_a_ranked_design_takes_the_poses(answer, data):
    design = answer.design(answer.best)
    linkage = configuration_of(design.mechanism).linkage
    base, output = answer.best.candidate.links
    wishes = read_task(data / "tasks" / "lid.json").wishes["wishes"]
    for angles, wish in zip(design.angles.values(), wishes, strict=True):
        turn = link_motions(linkage, np.array(list(angles.values()))[None], base)[output][0][0]
        off = turn - Rotation.from_quat(wish["quaternion"], scalar_first=True).as_matrix()
        assert np.abs(off).max() < 1e-8
    assert design.success
    assert design.freedoms == 1


def test_the_report_needs_nothing_else(answer):
    page = report_page(answer)
    assert page.count("<svg") == len(answer.ranked)
    assert not re.search(r"(src|href)=|@import|url\(", page)
    assert "1 of 2 types can do it" in page


def test_each_design_gets_a_page_and_a_template(data, tmp_path):
    task = ["task", str(data / "tasks" / "lid.json"), "--starts", "2", "--rounds", "1", "--workers", "1", "--pages"]
    result = CliRunner().invoke(main, [*task, "-o", str(tmp_path)])
    assert result.exit_code == 0
    assert {each.name for each in tmp_path.iterdir()} == {f"1-four-bar.{end}" for end in ("json", "html", "pdf")}
    design = synth.read(tmp_path / "1-four-bar.json")
    assert (tmp_path / "1-four-bar.html").read_text() == synth.view(design, title="1-four-bar").html
    assert (tmp_path / "1-four-bar.pdf").read_bytes().startswith(b"%PDF")
    refused = CliRunner().invoke(main, task)
    assert refused.exit_code == 2
    assert "--pages requires -o" in refused.stderr


@pytest.mark.parametrize("options", [["-o"], ["--store"], ["--pages", "-o"], ["-o", "designs", "--report"]])
@pytest.mark.parametrize("place", ["file", "file/x", "designs"])
def test_a_place_that_cannot_be_written_is_refused_in_a_line(options, place, data, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "file").write_text("kept")
    if place == "designs":
        (tmp_path / "designs").mkdir()
        (tmp_path / "designs" / "1-watt.json").write_text("kept")
        (tmp_path / "designs" / "round-0.sqlite").write_text("kept")
    task = [str(data / "tasks" / "lid.json"), "--starts", "1", "--rounds", "1", "--workers", "1"]
    result = CliRunner().invoke(main, ["task", *task, *options, place])
    assert result.exit_code == 2
    assert re.match(f"[^\n]*{place}[^\n]*: [^\n]*\n$", result.stderr)
    assert all(each.read_text() == "kept" for each in tmp_path.rglob("*") if each.is_file())


def test_a_design_without_a_template_is_named_with_the_reason(data, tmp_path):
    answer = synth.task(data / "tasks" / "skew-axes.json", starts=1, rounds=1)
    written, notes = write_pages(answer, tmp_path)
    assert [each.name for each in written] == ["1-bennett.html"]
    assert [note.startswith("no template of 1-bennett: ") for note in notes] == [True]


def test_a_store_gives_the_same_answer_when_it_was_stopped(data, tmp_path):
    task = lid(data, distance=[])
    task = {**task, "wishes": {**task["wishes"], "wishes": task["wishes"]["wishes"][:1]}}
    whole = synth.task(task, starts=2, rounds=1)
    times = []

    def stop(number, progress):
        times.append(progress.done)
        if len(times) == 1:
            raise Interrupted

    with pytest.raises(Interrupted):
        synth.task(task, starts=2, rounds=1, store=tmp_path / "store", report=stop)
    again = synth.task(task, starts=2, rounds=1, store=tmp_path / "store", resume=True)
    assert again.to_json() == whole.to_json()
    with pytest.raises(StoreError, match="holds the designs of a search"):
        synth.task(task, starts=2, rounds=1, store=tmp_path / "store")
    other = synth.task(lid(data), starts=1, rounds=1, store=tmp_path / "store", force=True)
    assert other.to_json() == synth.task(lid(data), starts=1, rounds=1).to_json()


def test_other_weights_rank_the_same_rows_anew(data):
    structure = structure_of(read_task(data / "tasks" / "lid.json"))
    rows = halved(structure, starts=2, rounds=1)
    row = next(row for row in rows if row["success"])
    figures = json.loads(row["record"])
    figures["figures"][1]["part"] = 0.5
    missed = [{**row, "record": json.dumps(figures)}]
    assert not ranked_types(structure, missed).ranked
    assert ranked_types(structure, missed, {1: 0.0}).ranked
    assert ranked_types(structure, missed).fell_out == {Outcome.MISSED: 1}


@pytest.mark.slow
def test_four_bars_through_five_orientations_fail_by_defects_as_all_pairs_of_dyads_do(data):
    """All four-bars of the dyads are the second method: none is free of defects."""
    task = read_task(data / "tasks" / "five-orientations.json")
    turns = [[1.0, 0.0, 0.0, 0.0], *(wish["quaternion"] for wish in task.wishes["wishes"])]
    orientations = Orientations(np.array(turns))
    dyads = dyads_of_five(orientations).dyads
    assert all(one.defects for one in four_bars(orientations, dyads))
    found = synth.task(replace(task, links=Limits(4, 4)), starts=4, rounds=1)
    assert not found.ranked
    [one] = found.missed
    assert sum(found.to_json()["missed"][0]["outcomes"].values()) == 4
    design = found.design(one)
    joints, axes = design.mechanism.chain.joints, design.mechanism.axes
    base, output = one.candidate.links

    def axis(first, second):
        return np.array(next(axes[joint][1] for joint, ends in joints.items() if set(ends) == {first, second}))

    pair = []
    for arm in set(design.mechanism.chain.nodes) - {base, output}:
        apart = [max(lines_apart(d.fixed, axis(base, arm)), lines_apart(d.moving, axis(arm, output))) for d in dyads]
        assert min(apart) < 1e-8
        pair.append(dyads[int(np.argmin(apart))])
    assert four_bar_of(orientations, *pair).circuit_defect == (
        DefectKind.CIRCUIT in {defect.kind for defect in one.defects}
    )


def test_an_empty_answer_says_what_was_nearest(data, tmp_path):
    """Neighbours turn about one axis: no spherical linkage takes them through two rotations about different axes."""
    place = tmp_path / "task.json"
    place.write_text(json.dumps(lid(data, distance=[{"roles": ["base", "output"], "number": 1}])))
    result = CliRunner().invoke(main, ["task", str(place), "--starts", "1", "--rounds", "1", "--workers", "1"])
    assert result.exit_code == 1, result.output
    assert "0 of 2 types can do it" in result.output
    assert "nearest: four-bar (base 0, output 1)" in " ".join(result.output.split())


def test_the_better_half_goes_on_with_twice_as_many_starts(data):
    task = read_task(data / "tasks" / "lid.json")
    task = replace(task, distances=(), links=task.links)
    structure = structure_of(task)
    assert len(candidates_of(structure)) == 2
    rows = halved(structure, starts=2, rounds=2)
    by_candidate = {number: [row["start"] for row in rows if row["candidate"] == number] for number in (0, 1)}
    done = next(row["candidate"] for row in rows if row["success"] and row["miss"] < 1e-9)
    assert by_candidate[done] == list(range(2))
    assert by_candidate[1 - done] == list(range(6))


@pytest.mark.parametrize(
    ("document", "options", "line"),
    [
        (HEAD, {}, "a task without wishes"),
        (None, {"weights": {5: 1.0}}, "there is no wish 6; expected 1 to 2"),
        (None, {"starts": 0}, "0 starts"),
        (None, {"scheduler": "tcp://x:1"}, "a scheduler without a store"),
    ],
)
def test_what_cannot_be_asked_is_one_line(document, options, line, data):
    with pytest.raises(InvariantError, match=line):
        synth.task(document or lid(data), **options)


def watts(task):
    """The candidates of a task that begin at six-bars that guide, each with its chain and body."""
    for candidate in candidates_of(structure_of(task)):
        chain, links = candidate.type_of(task).mechanism, dict(zip(task.roles, candidate.links, strict=True))
        if is_watts(SCGraph(chain.nodes, chain.joints, chain.loops, ground=links["base"]), links["output"]):
            yield candidate


def test_five_orientations_begin_at_six_bars_that_guide(data):
    task = read_task(data / "tasks" / "five-orientations.json")
    [candidate] = watts(task)
    assert len(candidate.type_of(task).mechanism) == 6
    assert candidate.links == (0, 5)


@pytest.mark.slow
def test_a_six_bar_of_a_task_takes_the_five_orientations_without_a_defect(data):
    """One of the populations of that start has one; as `synth sixbar`, but by links and joints of the type."""
    task = read_task(data / "tasks" / "five-orientations.json")
    [candidate] = watts(task)
    design = CandidateSearch(task, candidate, 0).design(1)
    assert design.success
    assert design.miss < 1e-12
    assert len(design.mechanism.chain.joints) == 7
