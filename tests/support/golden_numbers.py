"""The checked numbers of the source papers, which remember the entries that were read."""

import json
import os
from pathlib import Path

PLACE = Path(__file__).resolve().parents[2] / "data" / "golden.json"
RECORD = "SYNTHEDRA_GOLDEN_READ"
"""Names a file; each entry that a test reads is a line of it."""


class Paper(dict):
    """The entries of a paper. Whether one is there, and which there are, reads none."""

    def __init__(self, number, entries):
        super().__init__(entries)
        self.number = number

    def __getitem__(self, name):
        if RECORD in os.environ:
            with Path(os.environ[RECORD]).open("a", encoding="utf-8") as record:
                record.write(f"{self.number}/{name}\n")
        return super().__getitem__(name)


def golden_numbers():
    """Return the entries of all papers, by their numbers, and what the file says of itself."""
    whole = json.loads(PLACE.read_text(encoding="utf-8"))
    return {number: Paper(number, entries) for number, entries in whole.items()}
