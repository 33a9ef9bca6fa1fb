"""Many types realised at once: runs go on where they were stopped, and every type is accounted for."""

import json
from itertools import islice

import pytest
from read_strings import string_of_chain

from enumerate.runner._run import run
from enumerate.runner.job import row_as_dict
from enumerate.runner.store import read_rows
from enumerate.sc.jobs import sc_rows
from enumerate.scd.jobs import scd_rows
from enumerate.strings.panel_strings import ChainString
from graphs.convert.conversions import to_scd
from graphs.convert.panels import scd_from_panels
from graphs.errors import StoreError
from graphs.files.formats import read, write
from graphs.files.patterns.fold import fold_text
from graphs.identity.drawings import mechanism_from_map_id
from synth.catalogue.realisation._realise import realise
from synth.synthesis.atlas.realisation_job import COLUMNS, RealisationFolder, RealisationJob, store_beside, summary_of

CUBE = [(0, 1, 2, 3), (7, 6, 5, 4), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)]
OPTIONS = (("kind", "space"), ("tries", 1))


class _StoppedAfterOne(RealisationFolder):
    """A run that is stopped when one unit is there."""

    def take(self, number, rows, seconds):
        if number:
            raise KeyboardInterrupt
        super().take(number, rows, seconds)


def _list_of(codes, place):
    place.write_text("".join(json.dumps({"code": code}) + "\n" for code in codes))
    return str(place)


def test_a_stopped_run_goes_on_and_gives_equal_files(tmp_path):
    codes = [row["code"] for row in islice(scd_rows(4, 1, 4), 6)]
    source, things = _list_of(codes, tmp_path / "types.jsonl"), tmp_path / "things"
    with pytest.raises(KeyboardInterrupt):
        run(RealisationJob(source, OPTIONS, 2400), _StoppedAfterOne(things))
    assert len(list(things.iterdir())) == 4
    (things / "0000002.fold").unlink()
    progress = run(RealisationJob(source, OPTIONS, 2400), RealisationFolder(things, resume=True))
    assert progress.rows == 2
    for place in (2, 6):
        found = realise(mechanism_from_map_id(codes[place - 1]), **dict(OPTIONS))
        assert (things / f"{place:07d}.fold").read_text() == fold_text(found.sheet)
    rows = [row_as_dict(COLUMNS, row) for row in read_rows(store_beside(things))]
    assert [row["code"] for row in rows] == codes
    assert summary_of(rows)["realised"] == 6


def test_units_take_about_a_second(tmp_path):
    """Forty types of ten joints with a drawing, or five without, of which the panels are bent."""
    drawn = _list_of((row["code"] for row in islice(scd_rows(8, 1, 4), 100)), tmp_path / "drawn.jsonl")
    bare = _list_of((row["code"] for row in islice(sc_rows(8, 1), 12)), tmp_path / "bare.jsonl")
    sizes = [[len(unit.payload) for unit in RealisationJob(source).units()] for source in (drawn, bare)]
    assert sizes == [[40, 40, 20], [5, 5, 2]]
    (together,) = RealisationJob(bare, unit_weight=10**9).units()
    assert len(together.payload) == 12
    assert RealisationJob(bare).key != RealisationJob(bare, unit_weight=10**9).key


def test_other_types_or_options_are_another_run(tmp_path):
    source = _list_of(["m1:a-b.ac-.b-d.cd-"], tmp_path / "types.jsonl")
    run(RealisationJob(source, OPTIONS), RealisationFolder(tmp_path / "things"))
    with pytest.raises(StoreError, match="another run"):
        run(RealisationJob(source), RealisationFolder(tmp_path / "things", resume=True))


def test_what_is_not_realised_is_told_with_its_reason(tmp_path):
    folder = tmp_path / "types"
    folder.mkdir()
    write(scd_from_panels(CUBE), folder / "cube.json")
    (folder / "broken.json").write_text("{")
    job = RealisationJob(str(folder))
    [row] = [row_as_dict(COLUMNS, row) for unit in job.units() for row in job.work(unit.payload)]
    assert (row["name"], row["outcome"], row["mechanism"]) == ("cube.json", "refused", None)
    assert "without a border" in row["reason"]
    [failure] = job.failures
    assert "broken.json" in failure


@pytest.mark.slow
def test_two_processes_give_what_one_gives(tmp_path):
    codes = [row["code"] for row in islice(scd_rows(4, 1, 5), 20)]
    job = RealisationJob(_list_of(codes, tmp_path / "types.jsonl"), OPTIONS)
    for workers in (1, 2):
        run(job, RealisationFolder(tmp_path / f"by-{workers}"), workers=workers)
    one, two = (list(read_rows(tmp_path / f"by-{workers}.sqlite")) for workers in (1, 2))
    assert one == two


def test_rows_of_strings_are_realised_in_the_modes_that_they_name(tmp_path):
    rows = tmp_path / "strings.jsonl"
    rows.write_text("".join(f'{{"string": "RR-RR", "mode": "{mode}"}}\n' for mode in "SD"))
    run(RealisationJob(str(rows)), RealisationFolder(tmp_path / "things"))
    things = [read(tmp_path / "things" / f"{number:07d}.fold") for number in (1, 2)]
    assert [string_of_chain(to_scd(thing)) for thing in things] == [
        (ChainString((2, 2)), "S"),
        (ChainString((2, 2)), "D"),
    ]


def test_rows_of_conical_candidates_are_refused_one_by_one(tmp_path):
    rows = tmp_path / "orders.jsonl"
    row = {"chain": "k1:Cr", "order": ["0", "1", "3", "2"], "slots": [0, 1, 3, 2], "loops": [["0", "1", "3", "2"]]}
    rows.write_text(json.dumps(row) + "\n")
    job = RealisationJob(str(rows))
    summary = summary_of(row_as_dict(COLUMNS, one) for unit in job.units() for one in job.work(unit.payload))
    assert summary["refused"] == 1
    assert "round a cone" in summary["types"][0]["reason"]
    assert len(job.key["realise"]) == 64
