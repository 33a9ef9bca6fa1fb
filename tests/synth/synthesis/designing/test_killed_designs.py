"""Searches for designs that are killed at random moments go on from their store, and give the same list."""

import json
import random
import signal
import subprocess
from pathlib import Path

import pytest
from runs import SYNTH, contents, kill, units_in, wait_for

import synth
from synth.catalogue.patterns import generate

pytestmark = pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="looks for worker processes in /proc")

KILLS = 10
WISHES = {
    "format": "synthedra/wishes",
    "version": 1,
    "configurations": [{"name": "half", "inputs": {"0": 20}}, {"name": "open", "inputs": {"0": 40}}],
    "wishes": [
        {"kind": "angle", "at": "half", "joint": 3, "equals": 24},
        {"kind": "angle", "at": "open", "joint": 3, "equals": 50},
        {"kind": "arc", "joints": [0, 1], "at_least": 100},
        {"kind": "arc", "joints": [1, 2], "at_most": 40},
    ],
}


def command(folder, store, *words):
    files = (folder / "bar.json", folder / "wishes.json")
    return [*SYNTH, "design", *map(str, files), "--starts", "16", "--store", str(store), "--workers", "2", *words]


@pytest.mark.slow
def test_a_search_that_is_killed_ten_times_gives_the_same_list(tmp_path):
    synth.write(generate("four-bar").mechanism, tmp_path / "bar.json")
    (tmp_path / "wishes.json").write_text(json.dumps(WISHES))
    whole, store = tmp_path / "whole.sqlite", tmp_path / "killed.sqlite"
    undisturbed = subprocess.run(command(tmp_path, whole, "--json"), check=True, timeout=600, capture_output=True)
    dice, held = random.Random(44), []
    for _ in range(KILLS):
        held.append(units_in(store))
        words = ("--resume",) if store.exists() else ()
        process = subprocess.Popen(command(tmp_path, store, *words), stdout=subprocess.DEVNULL)
        if dice.random() < 0.7:
            wait_for(lambda before=held[-1], run=process: units_in(store) > before or run.poll() is not None)
            kill(process, dice, longest=0.3)
        else:
            kill(process, dice, longest=4.0)
        assert process.returncode in (-signal.SIGKILL, 0)
    assert held == sorted(held)
    assert held[-1] > 0
    resumed = command(tmp_path, store, "--json", "--resume")
    done = subprocess.run(resumed, check=True, timeout=600, capture_output=True)
    assert json.loads(done.stdout) == json.loads(undisturbed.stdout)
    assert contents(store) == contents(whole)
