"""What make writes: committed files only where it says so."""

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
CHANGED = ROOT / ".ci" / "changed"


def test_files_that_a_command_changes_are_named(tmp_path):
    for name in ("same", "other", "gone"):
        (tmp_path / name).write_text(name)
    command = [str(CHANGED), ".", "--", "sh", "-c", "echo new > other; rm gone; echo a > made; exit 3"]
    child = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert child.returncode == 3
    assert child.stdout.splitlines()[1:] == ["  ./gone", "  ./made", "  ./other"]
    child = subprocess.run([str(CHANGED), ".", "--", "true"], cwd=tmp_path, capture_output=True, text=True, check=True)
    assert child.stdout == "Nothing changed under .\n"


@pytest.mark.skipif(shutil.which("make") is None, reason="make is not here")
def test_only_targets_that_name_what_they_change_write_committed_files():
    """The scripts that write such files are called through `.ci/changed`, and none by `make docs`."""
    writers = ("docs/pictures.sh", "docs/examples.py", "data/make.py")
    for target, script in zip(("pictures", "examples", "data"), writers, strict=True):
        commands = planned(target)
        assert script in commands
        assert ".ci/changed" in commands[: commands.index(script)]
    assert not any(script in planned("docs") for script in writers)


def planned(target):
    """The commands of a target, joined as the shell sees them; none is run."""
    command = ["make", "--no-print-directory", "-n", target]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
