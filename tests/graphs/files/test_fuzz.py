"""Mutated files of every format: an answer or one line, in ten seconds of a processor and two gigabytes."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from graphs.files.formats import READERS

FUZZING = Path(__file__).resolve().parents[2] / "support" / "fuzzing.py"
FORMATS = sorted(READERS)
EACH = -(-100_000 // len(FORMATS))


def asked(questions, suffixes, number, seed, folder, data):
    """Ask so many files of each format in a process of its own; how many of each were answered and refused."""
    words = [questions, number, seed, folder, data, *suffixes]
    done = subprocess.run(
        [sys.executable, str(FUZZING), *map(str, words)],
        capture_output=True,
        text=True,
        check=False,
        env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path), "OPENBLAS_NUM_THREADS": "1"},
    )
    if done.returncode != 0:
        last = max(folder.glob("mutated*"), key=lambda path: path.stat().st_mtime_ns)
        pytest.fail(f"{last.name} holds {last.read_bytes()[:2000]!r}\n{done.stderr[-4000:]}")
    rows = [line.split() for line in done.stdout.splitlines()]
    counts = {suffix: (int(answered), int(refused)) for suffix, answered, refused, _ in rows}
    assert list(counts) == list(suffixes)
    assert all(sum(pair) == number for pair in counts.values())
    return counts


@pytest.mark.parametrize("suffixes", [FORMATS[::2], FORMATS[1::2]], ids=["even", "odd"])
def test_mutated_files(suffixes, tmp_path, data):
    """The front door: mobility with ranks and pose; of some files ids, reduction, conversion and reading again."""
    for answered, refused in asked("front", suffixes, 6, 1, tmp_path, data).values():
        assert min(answered, refused) > 0


@pytest.mark.slow
@pytest.mark.parametrize("suffix", FORMATS)
def test_a_hundred_thousand_mutated_files(suffix, tmp_path, data):
    """Of all formats together: a thousand seconds of a processor, some eight minutes on two idle cores."""
    asked("front", [suffix], EACH, 2, tmp_path, data)


@pytest.mark.slow
@pytest.mark.parametrize("suffix", FORMATS)
def test_ten_thousand_mutated_files_of_each_format_are_counted(suffix, tmp_path, data):
    asked("count", [suffix], 10_000, 3, tmp_path, data)
