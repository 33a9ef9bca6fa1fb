"""A script that uses only the face has types: mypy, strict, infers no Any in it."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

import synth

ROOT = Path(__file__).resolve().parents[1]
SCRIPT = ROOT / "tests" / "support" / "typed_script.py"
CONFIGURATION = """
[mypy]
strict = true
mypy_path = {root}:{root}/tests/support/stubs
explicit_package_bases = true
follow_imports = silent
ignore_missing_imports = true
disallow_subclassing_any = false
"""
KNOWN = re.compile(r"numpy\.ndarray\[tuple\[Any, \.\.\.\]|numpy\.dtype\[Any\]|typing\.Mapping\[Any,")
"""Arrays whose number of axes is not part of their type; keys of mappings, which would have to be of one class."""
UNTYPED = {"load_ipython_extension"}
"""Functions with a parameter that has no type: the shell of IPython."""


def test_the_script_uses_every_name_of_the_face():
    used = set(re.findall(r"\bsynth\.(\w+)", SCRIPT.read_text(encoding="utf-8")))
    assert used == set(synth.__all__)


@pytest.fixture(scope="module")
def revealed(tmp_path_factory):
    """What mypy infers for the script, and for each name of the face."""
    tmp_path = tmp_path_factory.mktemp("typed")
    names = tmp_path / "names.py"
    names.write_text("\n".join(["import synth", *(f"reveal_type(synth.{name})" for name in sorted(synth.__all__))]))
    (tmp_path / "mypy.ini").write_text(CONFIGURATION.format(root=ROOT), encoding="utf-8")
    words = [
        "--config-file",
        tmp_path / "mypy.ini",
        "--cache-dir",
        ROOT / ".mypy_cache" / "typed_script",
        SCRIPT,
        names,
    ]
    done = subprocess.run([sys.executable, "-m", "mypy", *words], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    lines = [line for line in done.stdout.splitlines() if "Revealed type is" in line]
    of_script = [line for line in lines if "names.py" not in line]
    numbered = {int(line.split("names.py:")[1].split(":")[0]): line for line in lines if "names.py" in line}
    return of_script, {name: numbered[number] for number, name in enumerate(sorted(synth.__all__), start=2)}


def without_type(line):
    return re.search(r"\bAny\b", KNOWN.sub("", line)) is not None


def test_mypy_infers_no_any(revealed):
    lines, _ = revealed
    assert len(lines) == SCRIPT.read_text(encoding="utf-8").count("reveal_type(")
    assert list(filter(without_type, lines)) == []


def test_parameters_have_types(revealed):
    _, names = revealed
    assert {name for name, line in names.items() if without_type(line)} == UNTYPED
