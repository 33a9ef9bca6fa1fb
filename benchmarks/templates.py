"""Templates: processor time of making and writing pages.

    python benchmarks/templates.py

makes a PDF of four pages and that of assembly, and one of 300 panels, and writes
benchmarks/results/templates.json. Both are `synth template` in a fresh process, start and reading included.
Processor time, since other work on the machine does not count in it.
"""

from __future__ import annotations

import json
import os
import platform
import subprocess
import sys
import tempfile
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage
from statistics import median

from graphs.files.formats import write
from graphs.mechanism.sheet import Sheet

RUNS = 3


def grid(rows: int, columns: int) -> Sheet:
    """Return a map of so many panels: rectangles, mountains and valleys by turns."""
    wide = columns + 1
    places = tuple((1.3 * x, 1.0 * y) for y in range(rows + 1) for x in range(wide))
    corners = [y * wide + x for y in range(rows) for x in range(columns)]
    faces = tuple((a, a + 1, a + wide + 1, a + wide) for a in corners)
    across = [(y * wide + x, y * wide + x + 1) for y in range(1, rows) for x in range(columns)]
    along = [(y * wide + x, (y + 1) * wide + x) for y in range(rows) for x in range(1, columns)]
    letters = "".join("MV"[(a // wide + a) % 2] for a, _ in (*across, *along))
    return Sheet(len(places), (*across, *along), letters, faces, places)


def seconds(*words: str) -> float:
    """Return the median of the processor time of a command."""
    times = []
    for _ in range(RUNS):
        before = getrusage(RUSAGE_CHILDREN)
        subprocess.run([sys.executable, "-m", "synth.cli", *words], check=True, capture_output=True)
        after = getrusage(RUSAGE_CHILDREN)
        times.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return median(times)


def main() -> None:
    """Measure both, print and write what was found."""
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    results = {}
    with tempfile.TemporaryDirectory() as folder:
        out = str(Path(folder, "t.pdf"))
        for name, rows, columns, size in (("four_pages", 3, 3, "340"), ("panels_300", 15, 20, "400")):
            source = Path(folder, f"{name}.fold")
            write(grid(rows, columns), source)
            results[name] = round(seconds("template", str(source), "--size", size, "--force", "-o", out), 2)
            pages = Path(out).read_bytes().count(b"/Type /Page\n")
            print(f"{name}: {results[name]} s of processor time, {pages} pages")
    found = {"python": platform.python_version(), "machine": platform.machine(), "seconds": results}
    place = Path(__file__).parent / "results" / "templates.json"
    place.write_text(json.dumps(found, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
