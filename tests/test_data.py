"""The files under data/ are what data/make.py makes."""

import csv
import json
import re
from pathlib import Path

import make
import pytest
import realised

from graphs.answer.identity import identify
from graphs.convert.conversions import to_sc, to_scd
from graphs.count.report import mobility_report
from graphs.files.formats import read
from graphs.identity.chains import chain_id
from graphs.identity.drawings import map_id
from graphs.mechanism.scd import SCDGraph
from graphs.rank.infinitesimal import infinitesimal_mobility

ROOT = Path(__file__).resolve().parent.parent


def test_the_data_are_what_the_script_makes(tmp_path, data):
    make.main(tmp_path)
    made = {path.relative_to(tmp_path): path.read_text() for path in tmp_path.rglob("*.*") if path.is_file()}
    kept = {path.relative_to(data): path.read_text() for sub in data.iterdir() if sub.is_dir()
            and sub.name not in ("realised", "wishes", "__pycache__") for path in sub.iterdir()}  # fmt: skip
    kept[Path("index.json")] = (data / "index.json").read_text()
    assert made == kept


def test_the_index_names_every_mechanism(data):
    rows = json.loads((data / "index.json").read_text(encoding="utf-8"))
    assert sorted(row["file"] for row in rows) == sorted(
        str(p.relative_to(data))
        for p in data.glob("*/*.*")
        if p.parent.name
        not in (
            "patterns",
            "surfaces",
            "orientations",
            "linkages",
            "joints",
            "realised",
            "wishes",
            "tasks",
            "__pycache__",
        )
    )


def realised_rows(data):
    return json.loads((data / "realised" / "index.json").read_text(encoding="utf-8"))


def test_what_is_realised_is_all_that_has_panels(data):
    rows = realised_rows(data)
    assert [row["of"] for row in rows] == [entry.file for entry in realised.sources()]
    assert {row["file"] for row in rows} == {path.name for path in (data / "realised").glob("*.fold")}


@pytest.mark.parametrize("every", [3, pytest.param(1, marks=pytest.mark.slow)])
def test_realised_mechanisms_keep_their_type_and_the_numbers_of_their_paper(every, data):
    of_paper = {row["file"]: row["M"] for row in json.loads((data / "index.json").read_text(encoding="utf-8"))}
    for row in realised_rows(data)[::every]:
        given, sheet = read(data / row["of"]), read(data / "realised" / row["file"])
        assert identify(sheet).drawing == row["drawing"]
        if isinstance(given, SCDGraph):
            assert map_id(given) == row["drawing"]
        assert chain_id(to_sc(sheet)) == chain_id(to_sc(given))
        assert mobility_report(to_scd(sheet)).mobility == row["mobility"] == of_paper[row["of"]], row["file"]
        assert infinitesimal_mobility(sheet).dof == row["freedoms"]
        assert set(sheet.assignments) <= ({*"UB"} if row["folds"] is False else {*"MVB"})


@pytest.mark.slow
def test_the_sheets_are_what_the_script_makes(tmp_path, data):
    """Byte for byte: `make test-machines` runs it under other kernels."""
    realised.main(tmp_path)
    made, kept = (
        {path.name: path.read_text() for path in folder.iterdir()} for folder in (tmp_path, data / "realised")
    )
    assert made == kept


def test_the_files_hold_nine_decimals(data):
    """But for what moves by its proportions alone, and orientations whose linkages hang on their last digits."""
    exact = {
        "bennett.json",
        "bricard-trihedral.json",
        "kaleidocycle-6.json",
        "kaleidocycle-8.json",
        "roberts.json",
        "crank-rocker.json",
    }
    files = [path for path in data.glob("*/*.*") if path.suffix in (".json", ".fold")]
    long = {path.name for path in files if re.search(r"\d\.\d{10}|\de-", path.read_text())}
    assert len(files) > 150
    assert long == exact


def test_golden_values_are_those_of_the_owner(golden):
    original = ROOT.parent / "shared" / "golden" / "golden.json"
    if not original.exists():
        pytest.skip("the owner's golden values are not at hand")
    assert golden == json.loads(original.read_text(encoding="utf-8"))


def test_crease_patterns_have_an_index(fold_folder):
    with (fold_folder / "INDEX.tsv").open(encoding="utf-8") as stream:
        names = [row["name"] for row in csv.DictReader(stream, delimiter="\t")]
    assert all((fold_folder / name).exists() for name in names)
