"""Make every file under data/ but golden.json: the mechanisms of the source papers, and crease patterns.

``make data`` runs it; a test checks that the files are what it makes. The figures themselves are not at
hand: mechanisms are built from the text of the papers and from golden.json, and where the text leaves a
choice the index says which was taken.
"""

from __future__ import annotations

import json
from pathlib import Path

import linkages_on_surfaces
import patterns
import surfaces
import wampler_2007
import wiener_2016

from graphs.files.formats import write

HERE = Path(__file__).resolve().parent


ENTRIES = [*wiener_2016.ENTRIES, *wampler_2007.ENTRIES, *linkages_on_surfaces.ENTRIES]


def main(folder: Path = HERE) -> None:
    """Write the mechanisms, the crease patterns and index.json into a folder."""
    index = []
    for entry in ENTRIES:
        (folder / entry.file).parent.mkdir(exist_ok=True)
        write(entry.make(), folder / entry.file)
        index.append(entry.row())
    (folder / "patterns").mkdir(exist_ok=True)
    for name, sheet in {"bird-base": patterns.bird_base(), "four-bar-vertex": patterns.fourbar_vertex()}.items():
        write(sheet, folder / "patterns" / f"{name}.fold")
    surfaces.write_surfaces(folder / "surfaces")
    rows = ",\n".join("  " + json.dumps(row) for row in index)
    (folder / "index.json").write_text(f"[\n{rows}\n]\n", encoding="utf-8")


if __name__ == "__main__":
    main()
