"""Make every file under data/ but golden.json: the mechanisms of the source papers, and crease patterns.

``make data`` runs it; a test checks that the files are what it makes. The figures themselves are not at
hand: mechanisms are built from the text of the papers and from golden.json, and where the text leaves a
choice the index says which was taken.
"""

from __future__ import annotations

import json
from pathlib import Path

import patterns
from mechanisms import ENTRIES

from graphs.files.formats import write

HERE = Path(__file__).resolve().parent


def main(folder: Path = HERE) -> None:
    """Write the mechanisms, the crease patterns and index.json into a folder."""
    for sub in ("wiener", "wampler", "patterns"):
        (folder / sub).mkdir(exist_ok=True)
    index = []
    for entry in ENTRIES:
        write(entry.make(), folder / entry.file)
        index.append(entry.row())
    for name, sheet in {
        "miura-3x3": patterns.miura(3, 3),
        "miura-4x5": patterns.miura(4, 5),
        "bird-base": patterns.bird_base(),
        "square-twist": patterns.square_twist(),
        "four-bar-vertex": patterns.fourbar_vertex(),
    }.items():
        write(sheet, folder / "patterns" / f"{name}.fold")
    rows = ",\n".join("  " + json.dumps(row) for row in index)
    (folder / "index.json").write_text(f"[\n{rows}\n]\n", encoding="utf-8")


if __name__ == "__main__":
    main()
