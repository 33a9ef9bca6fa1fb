import os
import subprocess
import sys

import pytest

from graphs.errors import FileError
from synth.drawing.figure import new_figure, save_figure


@pytest.mark.parametrize("kind", ["png", "svg", "pdf"])
def test_equal_figures_give_equal_files(tmp_path, kind):
    """Neither a date nor random names of parts."""
    pytest.importorskip("matplotlib")
    written = []
    for name in "ab":
        figure = new_figure(2, 2)
        axes = figure.subplots()
        axes.plot([0, 1, 2], [1, 0, 2], clip_on=True)
        save_figure(figure, tmp_path / f"{name}.{kind}")
        written.append((tmp_path / f"{name}.{kind}").read_bytes())
    assert written[0] == written[1]
    assert not any(word in written[0] for word in (b"dc:date", b"CreationDate"))


def test_a_folder_that_is_not_there(tmp_path):
    pytest.importorskip("matplotlib")
    with pytest.raises(FileError, match="nowhere"):
        save_figure(new_figure(1, 1), tmp_path / "nowhere" / "a.png")


def test_a_user_who_can_write_nowhere_is_told(tmp_path):
    """matplotlib wants a folder for its list of fonts when it is imported."""
    pytest.importorskip("matplotlib")
    closed = tmp_path / "a file, no folder"
    closed.write_text("")
    code = f"""
import tempfile
tempfile._candidate_tempdir_list = lambda: [{str(closed / "tmp")!r}]
from graphs.errors import UnsolvableError
from synth.drawing.figure import new_figure
try:
    new_figure(1, 1)
except UnsolvableError as error:
    print(error)
"""
    nowhere = dict.fromkeys(("HOME", "MPLCONFIGDIR", "XDG_CONFIG_HOME", "XDG_CACHE_HOME"), str(closed / "home"))
    done = subprocess.run(
        [sys.executable, "-c", code], env=os.environ | nowhere, capture_output=True, text=True, check=False
    )
    assert done.stdout == "matplotlib needs a folder to write to: name one in MPLCONFIGDIR\n", done.stderr
