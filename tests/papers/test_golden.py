"""Every checked number of a paper is read by a test of that paper, and the tests that read it pass."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from golden_numbers import RECORD, golden_numbers

HERE = Path(__file__).resolve().parent
TESTS = {
    "000": ["papers/test_hyatt_2020.py"],
    "001": ["papers/test_hyatt_2021.py"],
    "002": ["papers/test_tipparthi_2011.py"],
    "003": ["papers/test_wiener_2016.py", "synth/analysis/moving/test_closed_forms.py"],
    "004": ["papers/test_wampler_2007.py"],
}


@pytest.mark.slow
@pytest.mark.parametrize("paper", TESTS)
def test_every_entry_of_a_paper_is_read(paper, tmp_path):
    record = tmp_path / "read.txt"
    files = [str(HERE.parent / name) for name in TESTS[paper]]
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *files]
    environment = {**os.environ, RECORD: str(record)}
    run = subprocess.run(command, cwd=HERE.parents[1], env=environment, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout[-2000:]
    read = set(record.read_text(encoding="utf-8").split())
    entries = {f"{paper}/{name}" for name in golden_numbers()[paper] if name != "_title"}
    assert entries - read == set()


def test_reading_an_entry_is_recorded(tmp_path, monkeypatch):
    monkeypatch.setenv(RECORD, str(tmp_path / "read.txt"))
    paper = golden_numbers()["001"]
    assert "fig3" in paper
    assert len(list(paper)) > 10
    assert not (tmp_path / "read.txt").exists()
    assert paper["fig3"]["printed"] == 25.21
    assert (tmp_path / "read.txt").read_text() == "001/fig3\n"
