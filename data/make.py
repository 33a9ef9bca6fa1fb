"""Make every file under data/ but golden.json: mechanisms of the source papers, crease patterns, orientations.

``make data`` runs it; a test checks that the files are what it makes. The figures themselves are not at
hand: mechanisms are built from the text of the papers and from golden.json, and where the text leaves a
choice the index says which was taken.
"""

from __future__ import annotations

import json
from pathlib import Path

import hinged_linkages
import jointed
import linkages_on_surfaces
import orientation_tasks
import patterns
import surfaces
import task_examples
import wampler_2007
import wiener_2016
from decimals import with_few_decimals

from graphs.files.formats import write
from graphs.files.native import orientations_document
from graphs.files.text import json_text

HERE = Path(__file__).resolve().parent


ENTRIES = [*wiener_2016.ENTRIES, *wampler_2007.ENTRIES, *linkages_on_surfaces.ENTRIES]


def main(folder: Path = HERE) -> None:
    """Write the mechanisms, the crease patterns, the orientations and index.json into a folder."""
    index = []
    for entry in ENTRIES:
        (folder / entry.file).parent.mkdir(exist_ok=True)
        write(with_few_decimals(entry.make()), folder / entry.file, force=True)
        index.append(entry.row())
    (folder / "patterns").mkdir(exist_ok=True)
    for name, sheet in {"bird-base": patterns.bird_base(), "four-bar-vertex": patterns.fourbar_vertex()}.items():
        write(with_few_decimals(sheet), folder / "patterns" / f"{name}.fold", force=True)
    (folder / "linkages").mkdir(exist_ok=True)
    for name, linkage in hinged_linkages.LINKAGES.items():
        write(with_few_decimals(linkage), folder / "linkages" / name, force=True)
    (folder / "joints").mkdir(exist_ok=True)
    for name, linkage in jointed.LINKAGES.items():
        write(with_few_decimals(linkage), folder / "joints" / name, force=True)
    surfaces.write_surfaces(folder / "surfaces")
    (folder / "tasks").mkdir(exist_ok=True)
    for name in task_examples.TASKS:
        (folder / "tasks" / f"{name}.json").write_text(json_text(task_examples.document(name)))
    (folder / "orientations").mkdir(exist_ok=True)
    for name, quaternions in orientation_tasks.TASKS.items():
        (folder / "orientations" / f"{name}.json").write_text(json_text(orientations_document(quaternions)))
    rows = ",\n".join("  " + json.dumps(row) for row in index)
    (folder / "index.json").write_text(f"[\n{rows}\n]\n", encoding="utf-8")


if __name__ == "__main__":
    main()
