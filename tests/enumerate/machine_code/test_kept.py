"""Machine code of a toy package: kept, renewed, and not crossed by two processes at once."""

import os

import pytest
from toy_kernels import edit, make_toy, run

from enumerate.machine_code.folders import read_whole, write_whole

forks = pytest.mark.skipif(not hasattr(os, "fork"), reason="the processes are forks")

CALL = """
import json
from toy.outer import outer
value = outer(4)
print(json.dumps([value, sum(outer.stats.cache_hits.values()), sum(outer.stats.cache_misses.values())]))
"""

ROUNDS = """
import json, os, time
from toy.outer import outer

def child(numbers, begin):
    pid = os.fork()
    if pid:
        return pid
    time.sleep(max(0.0, begin - time.time()))
    right = all(outer(x) == 10 * (x + 1) and type(outer(x)) is type(x) for x in numbers)
    os._exit(not right or any(outer.stats.cache_misses.values()) and len(numbers) > 1)

wrong = []
for number in range(1):
    os.environ["SYNTHEDRA_CACHE"] = f"{os.environ['BASE']}/{number}"
    begin = time.time() + 0.05
    both = [child([4], begin), child([4.5], begin)]
    wrong += [os.waitpid(pid, 0)[1] for pid in both]
    wrong.append(os.waitpid(child([4, 4.5], 0.0), 0)[1])
print(json.dumps(wrong))
"""

FILES = """
import json, os
from enumerate.machine_code.cache import CodeFiles

def child(mine):
    pid = os.fork()
    if not pid:
        files = CodeFiles("toy-" + "0" * 32, "outer")
        for number in range(100):
            files.save((mine, number), [mine] * 1000)
            if files.load((mine, number)) != [mine] * 1000:
                os._exit(1)
        os._exit(0)
    return pid

print(json.dumps([os.waitpid(pid, 0)[1] for pid in [child("int64"), child("float64")]]))
"""


def test_code_is_renewed_when_a_function_it_calls_changes(tmp_path):
    package, cache = make_toy(tmp_path), tmp_path / "cache"
    assert run(CALL, tmp_path, cache)[0] == [50, 0, 1]
    assert run(CALL, tmp_path, cache)[0] == [50, 1, 0]
    times = (package / "inner.py").stat()
    edit(package / "inner.py", "x + 1", "x + 2")
    os.utime(package / "inner.py", ns=(times.st_atime_ns, times.st_mtime_ns))
    assert run(CALL, tmp_path, cache)[0] == [60, 0, 1]
    assert {file.suffix for file in package.rglob("*")} == {".py"}  # nothing is written beside the modules


@forks
@pytest.mark.slow
def test_two_processes_compile_different_signatures_at_once(tmp_path, monkeypatch):
    make_toy(tmp_path)
    monkeypatch.setenv("BASE", str(tmp_path / "rounds"))
    assert run(ROUNDS, tmp_path, tmp_path / "cache")[0] == [0] * 3


@forks
def test_two_processes_save_and_load_at_once(tmp_path):
    """Without compiling in between they meet often: with the files of numba's own cache, a few times in a hundred."""
    assert run(FILES, tmp_path, tmp_path / "cache")[0] == [0, 0]


def test_a_damaged_file_is_no_file(tmp_path):
    file = tmp_path / "a.nbc"
    assert write_whole(file, b"machine code")
    assert read_whole(file) == b"machine code"
    assert os.name == "nt" or file.stat().st_mode & 0o777 == 0o600
    for spoilt in (b"", file.read_bytes()[:-1], file.read_bytes() + b"!"):
        file.write_bytes(spoilt)
        assert read_whole(file) is None
    assert read_whole(tmp_path / "none") is None
    assert not write_whole(tmp_path / "no folder" / "a.nbc", b"")
    assert [path.name for path in tmp_path.iterdir()] == ["a.nbc"]


@pytest.mark.skipif(os.name == "nt", reason="files have no modes")
def test_a_file_that_others_may_write_is_no_file(tmp_path):
    file = tmp_path / "a.nbc"
    assert write_whole(file, b"machine code")
    file.chmod(0o620)
    assert read_whole(file) is None
