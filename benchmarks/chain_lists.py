"""Lists of kinematic chains written to files: processor time, wall time and memory of a row, by size and format.

    python benchmarks/chain_lists.py [FORMAT LINKS]

writes benchmarks/results/chain_lists.json; with a format (g6, sqlite, parquet) and a number of links that one only
is made anew. 12, 14 and 16 links are those of one freedom, 13 and 15 of two. Two workers; compiled code is warm.
The processor time is that of all processes, workers and the one that writes: on two idle cores a list takes about
half of it, which is what the limits are of (microseconds of a row: 5 for .g6, 10 with all attributes). It is told
with the load of the machine at the end, which makes both times longer.
"""

from __future__ import annotations

import json
import os
import platform
import resource
import subprocess
import sys
import tempfile
from pathlib import Path
from time import perf_counter
from typing import Any

RESULTS = Path(__file__).parent / "results" / "chain_lists.json"
FORMATS = ("g6", "sqlite", "parquet")
CHAINS = {12: 6856, 13: 27496, 14: 318162, 15: 1432730, 16: 19819281}
LIMITS = {"g6": 5, "sqlite": 10, "parquet": 10}


def written(form: str, links: int, folder: str) -> dict[str, Any]:
    """Write a list with the command, and return what it took."""
    place = Path(folder) / f"chains.{form}"
    words = f"enumerate chains --links {links} --dof {1 + links % 2} --workers 2 -o".split()
    command = [sys.executable, "-m", "synth.cli", *words, str(place)]
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), perf_counter()
    subprocess.run(command, check=True)
    wall, after = perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    size = place.stat().st_size
    place.unlink()
    return {
        "rows": CHAINS[links],
        "wall seconds": round(wall, 1),
        "processor seconds": round(processor, 1),
        "processor microseconds of a row": round(1e6 * processor / CHAINS[links], 2),
        "bytes of a row": round(size / CHAINS[links], 1),
        "megabytes of the largest process so far": after.ru_maxrss // 1024,
        "load": round(os.getloadavg()[0], 1),
    }


def main() -> None:
    """Write the lists, and store the figures as they come."""
    figures: dict[str, Any] = json.loads(RESULTS.read_text()) if RESULTS.exists() else {}
    figures |= {"python": platform.python_version(), "cores": os.cpu_count(), "limits on two idle cores": LIMITS}
    wanted = [(sys.argv[1], int(sys.argv[2]))] if sys.argv[1:] else [(f, n) for n in CHAINS for f in FORMATS]
    with tempfile.TemporaryDirectory() as folder:
        for form in dict.fromkeys(form for form, _ in wanted):
            written(form, 12, folder)  # compiled by then
        for form, links in wanted:
            figures.setdefault(form, {})[str(links)] = written(form, links, folder)
            print(form, links, figures[form][str(links)], flush=True)
            RESULTS.write_text(json.dumps(figures, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
