"""Layer orders of published patterns, beside Flat-Folder in node: processor seconds, file after file, in turn.

Patterns are taken from the folder that SYNTHEDRA_LAYERS names, or from ../shared/layers, Flat-Folder from the one that
SYNTHEDRA_PEERS names, or from ../shared/peers. Its limit is off; the files whose published numbers have one are
listed apart, and it is not asked about them.
"""

from __future__ import annotations

import csv
import json
import os
import subprocess
import sys
from pathlib import Path
from time import process_time

import synth

_SHARED = Path(__file__).resolve().parents[2] / "shared"
LAYERS = Path(os.environ.get("SYNTHEDRA_LAYERS", _SHARED / "layers"))
PEERS = Path(os.environ.get("SYNTHEDRA_PEERS", _SHARED / "peers"))


def of_flat_folder(path: Path) -> tuple[str, float] | None:
    """Return the states that Flat-Folder finds, and its seconds; None where it is not at hand."""
    program = PEERS / "flat-folder"
    if not program.exists():
        return None
    script = Path(__file__).with_name("flat_folder.mjs")
    words = ["node", "--max-old-space-size=8192", str(script), str(program), "0", str(path)]
    run = subprocess.run(words, capture_output=True, text=True, check=True)
    answer = json.loads(run.stdout.splitlines()[-1])
    return answer["states"], answer["seconds"]


def main() -> None:
    """Print a line per file, and the sums of those that both count."""
    with (LAYERS / "INDEX.tsv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file, delimiter="\t"))
    sums = [0.0, 0.0]
    synth.layers(LAYERS / rows[0]["name"])  # imports
    for row in sorted(rows, key=lambda row: row["limited"]):
        path = LAYERS / row["name"]
        begin = process_time()
        answer = synth.layers(path, explain=False)
        ours = process_time() - begin
        theirs = of_flat_folder(path) if row["limited"] == "no limit" and "--alone" not in sys.argv else None
        if theirs is not None:
            sums[0] += ours
            sums[1] += theirs[1]
            assert int(theirs[0]) == answer.orders, path
        beside = "" if theirs is None else f"{theirs[1]:10.3f}"
        print(f"{row['title'] or path.stem[:30]:32} {answer.orders:28} {ours:9.3f} {beside}", flush=True)
    print(f"{'sum of the files that both count':32} {'':28} {sums[0]:9.3f} {sums[1]:10.3f}")


if __name__ == "__main__":
    main()
