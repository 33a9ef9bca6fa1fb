"""The command line: words, exit status, help, and harm done by odd input (none)."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys

import pytest
from commands import run
from strategies import ODD_NAMES

import synth
from graphs.errors import InvariantError
from graphs.files.formats import write
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from synth.cli.main import main

WITHOUT_JSON = ("enumerate", "cone", "cylinder", "atlas", "realise", "template", "draw", "view")
"""Groups, whose commands have it, and what only writes files."""


@pytest.mark.parametrize("name", ODD_NAMES)
def test_odd_names_do_no_harm(name, tmp_path):
    path = tmp_path / "odd.json"
    sc = SCGraph([name, "b"], {name: (name, "b"), "other": (name, "b")}, [Loop((name, "other"), name=name)])
    write(sc, path)
    out = run("mobility", path).stdout
    assert all(len(line) < 200 for line in out.splitlines())
    assert "\x1b" not in out
    json.loads(run("mobility", "--json", path).stdout)
    scd = SCDGraph([name, "b"], {"j": (name, "b")}, rotation={name: ("j", None, None), "b": ("j", None, None)})
    write(scd, path, force=True)
    out = run("reconstruct", path).stdout
    assert all(len(line) < 200 for line in out.splitlines())
    json.loads(run("reconstruct", "--json", path).stdout)
    write(SCGraph([name, "b"], {"x": (name, "b"), "y": (name, "b")}, [Loop(("x",))] * 0), path, force=True)
    path.write_text(path.read_text(encoding="utf-8").replace('"b"]', '"gone"]', 1), encoding="utf-8")
    result = run("mobility", path, code=2)
    assert len(result.stderr.splitlines()) == 1
    assert len(result.stderr) < 400 + len(str(path))


def test_terminal_control_in_names_is_not_printed(tmp_path):
    path = tmp_path / "a.json"
    scd = SCDGraph(["\x1b[2Jx", "b"], [("\x1b[2Jx", "b")], rotation={"\x1b[2Jx": (0, None, None), "b": (0, None, None)})
    write(scd, path)
    assert "\x1b" not in run("reconstruct", path).stdout


@pytest.mark.parametrize(
    "words", [[], ["mobility"], ["nonsense"], ["convert", "a.json"], ["mobility", "--pose", "-1", "a.json"]]
)
def test_usage_errors_keep_clicks_format(words):
    result = run(*words, code=2)
    assert "Usage:" in result.output


@pytest.mark.parametrize("command", main.list_commands(None))
def test_every_help_text_has_an_example(command):
    out = run(command, "--help").stdout
    assert re.search(rf"Examples?:\n(?: +synth .*\n)*? +synth {command} ", out)
    assert "--json" in out or command in WITHOUT_JSON


@pytest.mark.parametrize(
    ("words", "heavy"),
    [
        (["--help"], ["networkx", "numpy", "rich", "graphs.mechanism.sc"]),
        (["generate", "miura", "--help"], ["scipy.optimize", "numba"]),
    ],
)
def test_help_loads_nothing_heavy(words, heavy):
    code = (
        "import sys; from synth.cli.main import main\n"
        f"try: main({words})\n"
        "except SystemExit: pass\n"
        f"heavy = set({heavy}) & set(sys.modules)\n"
        "sys.exit(f'imported: {heavy}' if heavy else 0)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_a_closed_pipe_leaves_no_traceback(data):
    """As with `synth mobility ... | head -1`."""
    files = sorted(map(str, data.glob("w*/*.json"))) * 4
    with subprocess.Popen(
        [sys.executable, "-m", "synth.cli", "mobility", "--json", *files],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=os.environ | {"PYTHONUNBUFFERED": "1"},
    ) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.readline()
        process.stdout.close()
        assert b"Traceback" not in process.stderr.read()


def test_shell_completion_knows_the_commands():
    env = os.environ | {"_SYNTH_COMPLETE": "bash_complete", "COMP_WORDS": "synth ", "COMP_CWORD": "1"}
    code = "from synth.cli.main import main; main(prog_name='synth')"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, env=env)
    assert set(re.findall(r"plain,(\w+)", done.stdout)) == {
        "look",
        "design",
        "task",
        "thicken",
        "mobility",
        "fold",
        "layers",
        "positions",
        "explain",
        "states",
        "limits",
        "advise",
        "atlas",
        "draw",
        "view",
        "reduce",
        "edit",
        "enumerate",
        "cone",
        "cylinder",
        "convert",
        "reconstruct",
        "id",
        "generate",
        "realise",
        "template",
        "order",
        "dyads",
        "fourbar",
        "sixbar",
    }


def test_names_that_are_near_are_told():
    assert "Did you mean 'mobility'?" in run("mobilty", "x.fold", code=2).output
    assert "Did you mean 'miura'?" in run("generate", "miurra", code=2).output
    assert "Did you mean" not in run("xyzzy", code=2).output


def test_versions_of_what_matters_are_told():
    told = run("--version").output
    assert re.search(r"^synth, version \d+\.\d+", told)
    assert "numpy" in told
    assert "Python" in told


def test_angles_that_look_like_radians_are_told():
    assert "2.09 looks like radians: 119.7 degrees" in run("cone", "map", "--angles", "2.09,1.66,0.79,1.48").output
    assert "looks like" not in run("cone", "map", "--angles", "120,95,45,85").output
    with pytest.raises(InvariantError, match="120 looks like degrees"):
        synth.map_to_cones([120, 95, 45, 85])


@pytest.mark.parametrize(("given", "threads"), [({}, "1"), ({"OPENBLAS_NUM_THREADS": "3"}, "3")])
def test_a_command_has_one_thread_of_blas_unless_the_user_says_otherwise(given, threads):
    code = (
        "import os, sys; sys.argv = ['synth', '--version']; from synth.cli.__main__ import run\n"
        "try: run()\n"
        "except SystemExit: print(os.environ['OPENBLAS_NUM_THREADS'])\n"
    )
    environment = {name: value for name, value in os.environ.items() if name != "OPENBLAS_NUM_THREADS"} | given
    shown = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    assert shown.stdout.splitlines()[-1] == threads
