"""The files under data/ are what data/make.py makes."""

import csv
import json
from pathlib import Path

import make
import pytest

ROOT = Path(__file__).resolve().parent.parent


def test_the_data_are_what_the_script_makes(tmp_path, data):
    make.main(tmp_path)
    made = {path.relative_to(tmp_path): path.read_text() for path in tmp_path.rglob("*.*") if path.is_file()}
    kept = {path.relative_to(data): path.read_text() for sub in data.iterdir() if sub.is_dir()
            and sub.name != "__pycache__" for path in sub.iterdir()}  # fmt: skip
    kept[Path("index.json")] = (data / "index.json").read_text()
    assert made == kept


def test_the_index_names_every_mechanism(data):
    rows = json.loads((data / "index.json").read_text(encoding="utf-8"))
    assert sorted(row["file"] for row in rows) == sorted(
        str(p.relative_to(data))
        for p in data.glob("*/*.*")
        if p.parent.name not in ("patterns", "surfaces", "orientations", "linkages", "__pycache__")
    )


def test_golden_values_are_those_of_the_owner(golden):
    original = ROOT.parent / "shared" / "golden" / "golden.json"
    if not original.exists():
        pytest.skip("the owner's golden values are not at hand")
    assert golden == json.loads(original.read_text(encoding="utf-8"))


def test_crease_patterns_have_an_index(fold_folder):
    with (fold_folder / "INDEX.tsv").open(encoding="utf-8") as stream:
        names = [row["name"] for row in csv.DictReader(stream, delimiter="\t")]
    assert all((fold_folder / name).exists() for name in names)
