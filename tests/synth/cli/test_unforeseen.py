"""An exception that nobody foresaw: one line, status 70, the traceback where it is asked for."""

import subprocess
import sys
from pathlib import Path

import click
import pytest
from click.testing import CliRunner
from commands import run

from graphs.errors import UnsolvableError
from graphs.files import formats
from synth.cli.main import main

ROOT = Path(__file__).resolve().parents[3]


def broken(error):
    def read(_path):
        raise error

    return read


@pytest.mark.parametrize(
    "error",
    [ZeroDivisionError("by\nzero"), MemoryError(), RecursionError("deep"), OSError(5, "no disk"), KeyError("a")],
)
def test_a_fault_is_one_line_and_70(error, monkeypatch):
    monkeypatch.setattr(formats, "read", broken(error))
    monkeypatch.delenv("SYNTHEDRA_DEBUG", raising=False)
    [line] = run("fold", "a.fold", code=70).stderr.splitlines()
    assert line.startswith(f"synth: fault of the program, not of the input: {type(error).__name__}: ")
    assert "Reporting a fault" in line


@pytest.mark.parametrize(("words", "variable"), [(["--debug"], "0"), ([], "1")])
def test_the_traceback_is_for_those_who_ask(words, variable, monkeypatch):
    monkeypatch.setattr(formats, "read", broken(ZeroDivisionError("by zero")))
    monkeypatch.setenv("SYNTHEDRA_DEBUG", variable)
    lines = run(*words, "fold", "a.fold", code=70).stderr.splitlines()
    assert lines[0] == "Traceback (most recent call last):"
    assert lines[-2] == "ZeroDivisionError: by zero"
    assert lines[-1].startswith("synth: fault")


@pytest.mark.parametrize(
    ("error", "code"),
    [(UnsolvableError("no"), 2), (click.UsageError("no"), 2), (click.exceptions.Exit(1), 1), (SystemExit(1), 1)],
)
def test_what_was_foreseen_is_no_fault(error, code, monkeypatch):
    monkeypatch.setattr(formats, "read", broken(error))
    result = CliRunner().invoke(main, ["fold", "a.fold"])
    assert result.exit_code == code
    assert "fault" not in result.output


def test_a_process_ends_with_70_too():
    code = (
        "import sys, graphs.files.formats as formats\nfrom synth.cli.__main__ import run\n"
        "def read(_): raise ZeroDivisionError\nformats.read = read\nsys.argv = ['synth', 'fold', 'a.fold']\nrun()"
    )
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False, env={})
    assert (done.returncode, done.stdout, len(done.stderr.splitlines())) == (70, "", 1)


@pytest.mark.parametrize("file", ["docs/command-json.md", "docs/architecture.md", "README.md", "CONTRIBUTING.md"])
def test_the_status_is_listed(file):
    assert "70" in (ROOT / file).read_text(encoding="utf-8")
    assert "70, a fault of the program" in run("--help").stdout
