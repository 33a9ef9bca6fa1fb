"""Mutated files of every format: an answer or one line, in five seconds and a gigabyte."""

import subprocess
import sys
from pathlib import Path

import pytest

from graphs.files.formats import READERS

FUZZING = Path(__file__).resolve().parents[2] / "support" / "fuzzing.py"


def run(suffix: str, number: int, seed: int, data: Path) -> tuple[int, int]:
    done = subprocess.run(
        [sys.executable, str(FUZZING), suffix, str(number), str(seed), str(data)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-4000:]
    answered, refused = map(int, done.stdout.split())
    assert answered + refused == number
    return answered, refused


@pytest.mark.parametrize("suffix", sorted(READERS))
def test_mutated_files(suffix, data):
    answered, refused = run(suffix, 50, 1, data)
    assert answered > 0
    assert refused > 0


@pytest.mark.slow
@pytest.mark.parametrize("suffix", sorted(READERS))
def test_a_hundred_thousand_mutated_files(suffix, data):
    run(suffix, 100_000, 2, data)
