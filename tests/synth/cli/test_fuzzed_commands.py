"""Mutated files given to the command itself: it answers, or says in a line what is wrong with which file."""

import json
import os
import random
import subprocess
import sys

import pytest
from mutated_files import mutated, seeds
from sizes import night, slow

from graphs.convert.conversions import CONVERSIONS, FORMS
from graphs.errors import SynthedraError
from graphs.files.formats import READERS, WRITERS, read_all

FORMATS = sorted(READERS)
HANGS = 120
"""Seconds after which a command is taken to hang."""

EDITS = ["--lock 0", "--add-crease 0:1", "--add-ride-along 0,1", "--add-loop 0,1,2", "--add-spatial-loop 0,1,3",
         "--implicit 0", "--explicit 0", "--remove-crease 0", "--lock 0,1 --add-ride-along 0,1"]  # fmt: skip


def words_of(rng, file, folder):
    """A command about a file, and the file that it is to write, if any."""
    out = folder / f"out{rng.choice(sorted(WRITERS))}"
    kinds = {
        "mobility": [],
        "id": [],
        "reconstruct": ["-o", out],
        "convert": [out, *rng.choice([[], ["--to", rng.choice(sorted(CONVERSIONS))], ["--form", rng.choice(sorted(FORMS))]])],
        "reduce": ["--rule", rng.choice(["ride-along", "dyad"]), "-o", out],
        "edit": [*rng.choice(EDITS).split(), "-o", out],
    }  # fmt: skip
    name = rng.choice(list(kinds))
    as_json, writes = rng.random() < 0.5, out in kinds[name]
    lossy = ["--lossy"] if writes and rng.random() < 0.7 else []
    words = [name, file, *kinds[name], *lossy, *(["--json"] if as_json else [])]
    return [str(word) for word in words], out if writes else None, as_json


def check_command(rng, seed, suffix, folder):
    """Run one command on one mutated file; whatever it says, what it leaves behind is whole."""
    folder.mkdir()
    file = folder / f"mutated{suffix}"
    raw = mutated(seed, rng)
    file.write_bytes(raw)
    words, out, as_json = words_of(rng, file, folder)
    here = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    command = [sys.executable, "-m", "synth.cli", *words]
    done = subprocess.run(command, capture_output=True, check=False, timeout=HANGS, env=here)
    told, failed = (stream.decode("utf-8") for stream in (done.stdout, done.stderr))
    about = f"{' '.join(words)}\n{raw[:2000]!r}\n{failed[-3000:]}"
    assert done.returncode in (0, 2), about
    if done.returncode == 2:
        assert len(failed.splitlines()) == 1, about
        assert failed.startswith(str(file)), about
        assert sorted(folder.iterdir()) == [file], about
        return 2
    assert all(line.startswith(f"{file}: ") for line in failed.splitlines()), about  # what was left out of it
    assert told, about
    if as_json:
        json.loads(told)
    assert sorted(folder.iterdir()) == sorted([file, *([out] if out else [])]), about
    if out:
        try:
            list(read_all(out))
        except SynthedraError as error:
            pytest.fail(f"{error}\n{about}")
    return 0


@pytest.mark.parametrize("files_of_all_formats", [slow(250), night(1_000)])
@pytest.mark.parametrize("suffix", FORMATS)
def test_mutated_files_through_the_command(suffix, files_of_all_formats, tmp_path, data):
    rng = random.Random(f"{suffix} 4")
    files = seeds(data, tmp_path)[suffix]
    codes = {
        check_command(rng, rng.choice(files), suffix, tmp_path / str(i))
        for i in range(-(-files_of_all_formats // len(FORMATS)))
    }
    assert codes <= {0, 2}
    assert len(codes) == 2 or files_of_all_formats < 1_000  # of few files all may be answered, or none
