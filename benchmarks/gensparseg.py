"""Larsson's plug-in of nauty's geng, which lists chains as (3/2, 2)-tight graphs; built where pip and a compiler are.

nauty's sources come in the source distribution of pynauty; the plug-in from the folder that SYNTHEDRA_PEERS names.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
import tarfile
from pathlib import Path

from benchmarks.osbo import PEERS

_PYNAUTY = "pynauty==2.8.8.1"


def built(folder: Path) -> Path | None:
    """Return the program, built in a folder; None where something for that is not at hand."""
    plugin = PEERS / "nauty-laman-plugin"
    if not plugin.is_dir() or shutil.which("gcc") is None or shutil.which("make") is None:
        return None
    pip = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--no-binary", ":all:", "-d", str(folder)]
    if subprocess.run([*pip, _PYNAUTY], check=False, capture_output=True).returncode:
        return None
    with tarfile.open(next(folder.glob("pynauty-*.tar.gz"))) as archive:
        archive.extractall(folder, filter="data")
    sources = next(folder.rglob("geng.c")).parent
    program = folder / "gensparseg"
    plug = ["-O4", "-mpopcnt", "-march=native", "-I.", f"-I{plugin}", "-DMAXN=WORDSIZE", '-DPLUGIN="prunesparse.h"']
    for words in (["sh", "configure"], ["make", "nauty1.a"], ["gcc", "-o", str(program), *plug, "geng.c", "nauty1.a"]):
        subprocess.run(words, cwd=sources, check=True, capture_output=True)
    return program
