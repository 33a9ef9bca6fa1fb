"""Scenes written: equal files, whole or not at all, and a line where something is missing."""

import os
import subprocess
import sys

import pytest

from graphs.errors import FileError
from synth.making.drawing.scene.shapes import Label, Layer, Line
from synth.making.drawing.scene.writing import Scene

SCENE = Scene(60, 20, (Layer("a", (Line([(0, 0), (20, 9)]), Label((30, 10), "a"))),))


@pytest.mark.parametrize("kind", ["png", "svg", "pdf"])
def test_equal_scenes_give_equal_files(tmp_path, kind):
    """No date in them."""
    pytest.importorskip({"svg": "xml", "png": "matplotlib", "pdf": "reportlab"}[kind])
    for name in "ab":
        SCENE.save(tmp_path / f"{name}.{kind}")
    one, other = ((tmp_path / f"{name}.{kind}").read_bytes() for name in "ab")
    assert one == other
    assert b"dc:date" not in one


def test_a_folder_that_is_not_there(tmp_path):
    with pytest.raises(FileError, match="nowhere"):
        SCENE.save(tmp_path / "nowhere" / "a.svg")


def test_pictures_of_other_kinds_are_refused(tmp_path):
    with pytest.raises(FileError, match=r"files ending in '\.jpeg' are not known; expected one of \.png \.svg \.pdf"):
        SCENE.save(tmp_path / "a.jpeg")


def test_a_user_who_can_write_nowhere_is_told(tmp_path):
    """matplotlib wants a folder for its list of fonts when it is imported."""
    pytest.importorskip("matplotlib")
    closed = tmp_path / "a file, no folder"
    closed.write_text("")
    code = f"""
import tempfile
tempfile._candidate_tempdir_list = lambda: [{str(closed / "tmp")!r}]
from graphs.errors import UnsolvableError
from graphs.files.outputs import check_writable
from synth.exporters import EXPORTERS
try:
    check_writable("a.png", EXPORTERS["pictures"])
except UnsolvableError as error:
    print(error)
"""
    nowhere = dict.fromkeys(("HOME", "MPLCONFIGDIR", "XDG_CONFIG_HOME", "XDG_CACHE_HOME"), str(closed / "home"))
    done = subprocess.run(
        [sys.executable, "-c", code], env=os.environ | nowhere, capture_output=True, text=True, check=False
    )
    assert done.stdout == "matplotlib requires a folder to write to; try to name one in MPLCONFIGDIR\n", done.stderr
