"""What processes that were killed left beside a place, and what is not theirs."""

import os
import signal
import subprocess
import sys

import pytest

from graphs.files import atomic
from graphs.files.atomic import Beside, FolderBeside, remove_left

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no locks that end with a process")

_KILLED = """
import os, signal, sys
from pathlib import Path
from graphs.files.atomic import Beside, FolderBeside

file, folder = Beside(Path(sys.argv[1])), FolderBeside(Path(sys.argv[2]))
file.write(b"half")
(folder.path / "1.json").touch()
if sys.argv[3:]:
    begun, tell = os.pipe()
    pid = os.fork()
    if pid == 0:
        os.write(tell, b"1")  # it has given up the locks that it was forked with
        sys.stdin.read()  # a worker that lives on
        os._exit(0)
    os.read(begun, 1)
os.kill(os.getpid(), signal.SIGKILL)
"""


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def killed(*words):
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    process = subprocess.Popen([sys.executable, "-c", _KILLED, *words], env=environment, stdin=subprocess.PIPE)
    assert process.wait(timeout=60) == -signal.SIGKILL
    return process


@pytest.mark.parametrize("worker", [(), ("with a worker",)])
def test_what_a_killed_process_left_is_removed(tmp_path, worker):
    file, folder = tmp_path / "rows.jsonl", tmp_path / "rows"
    with killed(file, folder, *worker) as process:
        assert len(names(tmp_path)) == 2
        remove_left(file)
        [left] = tmp_path.iterdir()
        assert left.is_dir()
        remove_left(folder)
        assert names(tmp_path) == []
        process.stdin.close()


def test_what_is_not_left_over_stays(tmp_path):
    name = "rows of a run that has a very long name"
    mine, folder = Beside(tmp_path / name), FolderBeside(tmp_path / "rows")
    other = tmp_path / f".{name}, and another.01234567.unfinished"
    other.touch()
    (tmp_path / ".rows.settings").touch()
    (tmp_path / ".rows.old.01234567.unfinished").touch()
    (tmp_path / ".rows.01234567.unfinished").symlink_to(other)
    os.mkfifo(tmp_path / ".rows.76543210.unfinished")
    before = names(tmp_path)
    for place in (name, "rows"):
        remove_left(tmp_path / place)
        assert names(tmp_path) == before
    mine.write(b"whole")
    mine.commit()
    folder.commit()
    assert (tmp_path / name).read_bytes() == b"whole"
    assert (tmp_path / "rows").is_dir()


def test_long_names_that_begin_alike_are_not_taken_for_one(tmp_path):
    one, other = (tmp_path / f"{'x' * 40}{end}.jsonl" for end in "ab")
    killed(one, tmp_path / "rows").stdin.close()
    before = names(tmp_path)
    remove_left(other)
    assert names(tmp_path) == before
    remove_left(one)
    assert len(names(tmp_path)) == 1


def test_where_there_are_no_locks_nothing_is_taken_for_left_over(tmp_path, monkeypatch):
    def refuse(*_):
        raise OSError("no locks on this file system")

    monkeypatch.setattr(atomic.fcntl, "flock", refuse)
    beside = Beside(tmp_path / "rows.jsonl")
    left = tmp_path / ".rows.jsonl.01234567.unfinished"
    left.touch()
    remove_left(tmp_path / "rows.jsonl")
    assert left.exists()
    beside.write(b"whole")
    beside.commit()
    assert names(tmp_path) == [left.name, "rows.jsonl"]
