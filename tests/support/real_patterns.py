"""The crease patterns by other people: where they are, and which there are."""

import os
from pathlib import Path

from graphs.files.formats import READERS

_ROOT = Path(__file__).resolve().parents[2]


def folder_of_patterns():
    """Return the folder, which may not be there."""
    return Path(os.environ.get("SYNTHEDRA_FOLD", _ROOT.parent / "shared" / "fold"))


def names_of_patterns(most_bytes=10**9):
    """Return the names of the files that have a reader, up to a size, for tests with a file each; in order."""
    folder = folder_of_patterns()
    if not folder.is_dir():
        return []
    files = (file for file in folder.iterdir() if file.suffix in READERS and file.stat().st_size < most_bytes)
    return sorted(file.name for file in files)
