"""The command line as a process: standard output that is full or closed, and signals."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from commands import run as command_line

from enumerate.chains.jobs import ChainJob

SIGNALS = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]
SYNTH = [sys.executable, "-m", "synth.cli"]
CHAINS = ["enumerate", "chains", "--links", "6", "--dof", "1"]
FULL = Path("/dev/full")


def told(words, **streams):
    """Exit status and lines of standard error."""
    done = subprocess.run([*SYNTH, *words], stderr=subprocess.PIPE, text=True, check=False, **streams)
    return done.returncode, [x for x in done.stderr.splitlines() if not x.startswith("synth: compiling")]


@pytest.mark.skipif(not FULL.exists(), reason="has no /dev/full")
@pytest.mark.parametrize(
    "words",
    [
        ["--help"],
        pytest.param(CHAINS, marks=pytest.mark.slow),
        pytest.param([*CHAINS, "--json"], marks=pytest.mark.slow),
        pytest.param(["mobility", "--help"], marks=pytest.mark.slow),
        pytest.param(["--version"], marks=pytest.mark.slow),
        pytest.param(["mobility", "k1:Bw"], marks=pytest.mark.slow),
    ],
)
def test_a_full_standard_output_gives_one_line(words):
    with FULL.open("w") as full:
        assert told(words, stdout=full) == (2, ["standard output: cannot be written: No space left on device"])


def test_a_standard_output_that_nobody_reads_any_more():
    read, write = os.pipe()
    os.close(read)
    try:
        assert told(["--version"], stdout=write) == (128 + signal.SIGPIPE, [])
    finally:
        os.close(write)


def test_a_closed_standard_output():
    command = ["sh", "-c", 'exec "$@" >&-', "sh", *SYNTH, "--version"]
    done = subprocess.run(command, stderr=subprocess.PIPE, text=True, check=False)
    assert (done.returncode, done.stderr) == (2, "standard output: cannot be written: it is closed\n")


@pytest.mark.slow
def test_a_file_is_written_without_standard_output(tmp_path):
    out = tmp_path / "chains.g6"
    command = ["sh", "-c", 'exec "$@" >&-', "sh", *SYNTH, *CHAINS, "-o", str(out)]
    assert subprocess.run(command, check=False).returncode == 0
    assert out.read_text().count("\n") == 2


@pytest.mark.parametrize("number", SIGNALS)
@pytest.mark.parametrize(
    ("name", "words"), [("", ""), ("c.jsonl", "stopped; nothing was written"), ("c.sqlite", "go on with --resume")]
)
def test_signals_have_their_exit_status(tmp_path, monkeypatch, number, name, words):
    monkeypatch.setattr(ChainJob, "work", lambda job, payload: os.kill(os.getpid(), number))
    output = ["-o", tmp_path / name] if name else []
    result = command_line(*CHAINS, "--workers", 1, *output, code=128 + number)
    assert result.stderr.endswith(f"{words}\n")
    assert len(result.stderr.splitlines()) == 1
    assert [path.name for path in tmp_path.iterdir()] == ([name] if name == "c.sqlite" else [])


@pytest.mark.slow
@pytest.mark.parametrize("number", SIGNALS)
def test_a_stopped_command_says_so_and_leaves_no_folder(tmp_path, number):
    command = [*SYNTH, "enumerate", "chains", "--links", "14", "--dof", "1", "--workers", "2", "-o", tmp_path / "f"]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    while not any(any(folder.iterdir()) for folder in tmp_path.iterdir()):
        assert process.poll() is None
        time.sleep(0.01)
    process.send_signal(number)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 128 + number
    assert errors.splitlines()[-1] == "stopped; nothing was written"
    assert list(tmp_path.iterdir()) == []
