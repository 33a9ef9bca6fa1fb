"""Mutated files through the commands that work with coordinates: 0, 1 or 2, and never a traceback, warning or hang."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from fuzzed_verbs import fault_of

SUPPORT = Path(__file__).resolve().parents[2] / "support"
CORPUS = SUPPORT / "corpus"
FAILED = [(name, words) for name, words in json.loads((CORPUS / "commands.json").read_text(encoding="utf-8"))]
LONG = ("slivers.cp", "step-of-no-length.fold")
"""Files whose folds end when their allowance of steps is used up, after some seconds."""
FILES, PARTS = 5_000, 10


@pytest.mark.parametrize(
    ("name", "words"), [pytest.param(*one, marks=[pytest.mark.slow] * (one[0] in LONG)) for one in FAILED]
)
def test_what_failed_once(name, words, tmp_path):
    shutil.copy(CORPUS / name, tmp_path)
    assert fault_of(words, tmp_path / name) is None


def test_the_corpus_holds_what_is_asked():
    assert {name for name, _ in FAILED} | {"commands.json"} == {file.name for file in CORPUS.iterdir()}
    assert all(file.stat().st_size < 2_500 for file in CORPUS.iterdir())


def test_a_fault_is_seen(tmp_path, monkeypatch):
    """The check itself: an exit status of 70, and an output that a refused command left behind."""
    from graphs.files import formats

    def broken(_path):
        raise ZeroDivisionError

    monkeypatch.setattr(formats, "read", broken)
    assert fault_of(["fold", "{file}"], tmp_path / "a.fold").startswith("exit status 70")
    assert fault_of(["draw", "{file}"], tmp_path / "a.fold") is None


def faults(first, last, folder, data):
    """Ask the files from one number to another in processes of their own; what was wrong with them."""
    found = []
    while first < last:
        words = [SUPPORT / "fuzzed_verbs.py", folder, data, 8, first, last]
        done = subprocess.run(
            [sys.executable, *map(str, words)],
            capture_output=True,
            text=True,
            check=False,
            env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path), "OPENBLAS_NUM_THREADS": "1"},
        )
        lines = [json.loads(line) for line in done.stdout.splitlines()]
        found += [line for line in lines if line[2] not in ("began", "ended")]
        if done.returncode == 0:
            break
        number, asked, _ = lines[-1]  # a hang, or no memory: go on with the next file
        found.append([number, asked, f"ended by {done.returncode}: {done.stderr[-2000:]}"])
        first = number + 1
    return found


@pytest.mark.slow
@pytest.mark.parametrize("part", range(PARTS))
def test_five_thousand_mutated_files(part, tmp_path, data):
    """Two commands about each: some ten minutes of a processor for all."""
    first, last = FILES * part // PARTS, FILES * (part + 1) // PARTS
    assert faults(first, last, tmp_path, data) == []


def test_some_mutated_files(tmp_path, data):
    assert faults(0, 3, tmp_path, data) == []
