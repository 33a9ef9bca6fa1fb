"""What a terminal is shown while a run goes on, and while a store is looked through before it."""

import re
import sqlite3
from contextlib import closing

import click.testing
import pytest
from commands import run as command_line

from synth.cli import runner

CHAINS = ("enumerate", "chains", "--links", 8, "--dof", 1, "-o")


@pytest.fixture
def terminal(monkeypatch):
    """Standard error is a terminal, and nobody waits for progress."""
    monkeypatch.setattr(click.testing._NamedTextIOWrapper, "isatty", lambda stream: True, raising=False)
    monkeypatch.setattr(runner, "_PATIENCE", 0.0)


def altered(store):
    """Bytes of a store in which a number of a row is another."""

    with closing(sqlite3.connect(store)) as connection, connection:
        connection.execute("UPDATE type SET symmetry = symmetry + 1 WHERE rowid = 3")


def test_looking_through_a_store_is_shown_while_it_lasts(tmp_path, terminal):
    store = tmp_path / "chains.sqlite"
    assert "checking the store" not in command_line(*CHAINS, store).stderr
    shown = command_line(*CHAINS, store, "--resume").stderr
    line = "100%  checking the store, 0 s left"
    assert f"\r{line}\r{' ' * len(line)}\r" in shown
    assert command_line(*CHAINS, store, "--resume", "--quiet").stderr == ""


def test_damage_is_told_on_a_line_of_its_own(tmp_path, terminal):
    store = tmp_path / "chains.sqlite"
    command_line(*CHAINS, store)
    altered(store)
    shown = command_line(*CHAINS, store, "--resume").stderr
    assert re.search(rf" \r{store}: repaired a damaged store; kept \d of \d units\n", shown)


def test_how_long_looking_through_takes(capsys, monkeypatch):
    now = [0.0]
    monkeypatch.setattr(runner, "monotonic", lambda: now[0])
    meter = runner._Meter(silent=False)
    meter.look(0.0)
    assert capsys.readouterr().err == ""  # not yet
    now[0] = 30.0
    meter.look(0.25)
    assert capsys.readouterr().err == "\r 25%  checking the store, 1 min 30 s left"
    meter.look(0.26)
    assert capsys.readouterr().err == ""
    meter.tell("was damaged")
    assert capsys.readouterr().err.endswith("\rwas damaged\n")


def test_what_was_done_before_looking_began_is_not_counted(capsys, monkeypatch):
    now = [0.0]
    monkeypatch.setattr(runner, "monotonic", lambda: now[0])
    meter = runner._Meter(silent=False)
    now[0] = 100.0  # the units of a large job take long to be found
    meter.look(0.5)
    assert capsys.readouterr().err == "\r 50%  checking the store, ? left"
    now[0] = 110.0
    meter.look(0.75)
    assert "10 s left" in capsys.readouterr().err


def test_a_count_shows_units_and_the_time_left(terminal):
    """Also what is done before the first unit: contracted graphs take minutes where there are many loops."""
    words = ("enumerate", "chains", "--links", 12, "--dof", 1, "--count", "--workers", 1)
    shown = command_line(*words).stderr
    assert shown.startswith("\r  0%  listing the units of the job\r")
    lines = [line.rstrip() for line in shown.split("\r") if line.strip()]
    assert all(
        re.fullmatch(rf" *\d+%  {done} of 7 units counted, \d+ s left", line) for done, line in enumerate(lines[1:], 1)
    )
    assert lines[-1] == "100%  7 of 7 units counted, 0 s left"
    assert command_line(*words, "--quiet").stderr == ""


def test_rows_that_are_printed_have_no_progress_on_their_lines(terminal):
    assert "finding out" not in command_line("enumerate", "chains", "--links", 12, "--dof", 1).stderr
