"""Compiling ahead, and the word that is said where it was not done."""

import io
import json
import os
import signal
import subprocess
import sys
import time

import pytest

from enumerate.machine_code import folders
from synth.cli import __main__ as commands
from synth.cli.__main__ import run

FIRST = [
    "enumerate chains --links 10 --dof 1 --json",
    "enumerate sc --links 8 --dof 1 --json",
    "enumerate scd --links 4 --dof 1 --max-degree 4 --json",
    "enumerate conical --chain watt --slots 12 --json",
    "cone map --angles 120,95,45,85 --json",
]


def synth(*words, cache):
    """Run ``synth`` as a process that uses machine code, with a place for it."""
    environment = {**os.environ, "SYNTHEDRA_CACHE": str(cache), "SYNTHEDRA_MACHINE_CODE": "always"}
    line = [sys.executable, "-m", *words]
    return subprocess.run(line, env=environment, capture_output=True, text=True, check=True)


def said(folder):
    return f"synth: compiling code for the first use, up to a minute (kept in {folder})\n"


def test_compiling_is_said_once_on_standard_error(tmp_path, monkeypatch, capsys):
    def compile_twice(prog_name):
        for _ in range(2):
            folders.compiling()

    monkeypatch.setenv("SYNTHEDRA_CACHE", str(tmp_path))
    monkeypatch.setattr("synth.cli.main.main", compile_twice)
    monkeypatch.setattr("synth.cli.output.guard_output", lambda: None)  # capsys has no file to guard
    heeded = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)}
    try:
        run()
    finally:
        folders.on_compiling(None)
        for number, handler in heeded.items():
            signal.signal(number, handler)
    assert capsys.readouterr() == ("", said(tmp_path))


class Terminal(io.StringIO):
    """What a terminal is given."""

    def isatty(self):
        return True


def test_a_terminal_shows_how_many_functions_are_compiled_and_for_how_long(monkeypatch):
    """While one is compiled the line is written again and again; then it is gone, until the next."""
    monkeypatch.setattr(commands, "_EVERY", 0.01)
    monkeypatch.setattr(commands.sys, "stderr", Terminal())
    line = commands.CompilingLine()
    for done in (0, 1):
        line(done + 1, done)
        deadline = time.monotonic() + 5.0
        while f"compiling: {done} function{'' if done else 's'} done, 0 s" not in commands.sys.stderr.getvalue():
            assert time.monotonic() < deadline
            time.sleep(0.01)
        line(done + 1, done + 1)
        assert commands.sys.stderr.getvalue().endswith("\r\x1b[K")
    monkeypatch.setattr(commands.sys, "stderr", io.StringIO())
    commands._show_compiling(1, 0)
    assert commands._line == []


def test_compiling_ahead_can_be_stopped(tmp_path):
    line = [sys.executable, "-m", "synth.cli.ahead"]
    cache = {**os.environ, "SYNTHEDRA_CACHE": str(tmp_path)}
    with subprocess.Popen(line, env=cache, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        process.stdout.readline()
        process.send_signal(signal.SIGINT)
        told = process.communicate(timeout=60)[1]
    assert (process.returncode, told) == (1, "stopped; the rest is compiled at its first use\n")


@pytest.mark.slow
def test_an_answer_is_clean_where_something_is_compiled(tmp_path):
    line = ["synth.cli", "enumerate", "conical", "--chain", "four-bar", "--ground", "0", "--json", "--quiet"]
    first, second = synth(*line, cache=tmp_path), synth(*line, cache=tmp_path)
    assert (first.stderr, second.stderr) == (said(tmp_path), "")
    assert json.loads(first.stdout) == json.loads(second.stdout)


@pytest.mark.slow
def test_what_was_compiled_ahead_is_what_first_commands_need(tmp_path):
    told = synth("synth.cli.ahead", cache=tmp_path).stdout
    assert f"kept in {tmp_path}" in told
    for command in FIRST:
        done = synth("synth.cli", *command.split(), cache=tmp_path)
        assert done.stderr == "", command
        assert json.loads(done.stdout)
    assert "no functions were new" in synth("synth.cli.ahead", cache=tmp_path).stdout
