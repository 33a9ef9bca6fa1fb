"""Miura sheets folded by one crease: processor time of a frame, and of the first answer.

    python benchmarks/folding.py

folds n x n panels from flat to 120 degrees, all loops closed to 1e-12, takes the median of the frames, fits the
growth with the number of panels, and writes benchmarks/results/folding.json. The first answer is `synth fold` of a
10 x 10 sheet in a fresh process, four frames, start and reading included. Processor time, since other work on the
machine does not count in it.
"""

from __future__ import annotations

import json
import math
import os
import platform
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median
from time import process_time

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

from graphs.files.formats import write
from graphs.mechanism.sheet import Sheet
from synth.analysis.folding.motion import fold

SIZES = {5: 60, 10: 60, 20: 40, 32: 30, 50: 20, 75: 12}
"""Panels along each side, and frames."""
SECTOR = math.radians(60.0)
FOLDED = math.radians(120.0)


def miura(n: int) -> Sheet:
    """Return a flat Miura sheet of n x n panels; its creases that go straight up are edges n (n + 1) and later."""
    number = [[i * (n + 1) + j for j in range(n + 1)] for i in range(n + 1)]
    places = [(j * math.sin(SECTOR), i + j % 2 * math.cos(SECTOR)) for i in range(n + 1) for j in range(n + 1)]
    zigzag = [(number[i][j], number[i][j + 1]) for i in range(n + 1) for j in range(n)]
    straight = [(number[i][j], number[i + 1][j]) for i in range(n) for j in range(n + 1)]
    letters = ["B" if i in (0, n) else "MV"[i % 2] for i in range(n + 1) for j in range(n)]
    letters += ["B" if j in (0, n) else "VM"[(i + j) % 2] for i in range(n) for j in range(n + 1)]
    faces = [
        (number[i][j], number[i][j + 1], number[i + 1][j + 1], number[i + 1][j]) for i in range(n) for j in range(n)
    ]
    return Sheet((n + 1) ** 2, (*zigzag, *straight), "".join(letters), tuple(faces), tuple(places))


def frames(n: int, count: int) -> dict[str, float | int]:
    """Return what one size takes."""
    sheet = miura(n)
    driven = n  # the first zigzag crease that is no rim
    sign = 1.0 if sheet.assignments[driven] == "V" else -1.0
    times: list[float] = []
    start = process_time()
    folded = fold(sheet, drive={driven: sign * FOLDED}, frames=count, report=lambda _: times.append(process_time()))
    whole = process_time() - start
    assert folded.path.stopped == ""
    assert folded.closure < 1e-12
    return {
        "panels": n * n,
        "creases": len(folded.joints),
        "frames": count,
        "frame_ms": round(1000.0 * median(np.diff(times).tolist()), 2),
        "whole_seconds": round(whole, 2),
        "closure": folded.closure,
    }


def first_answer() -> float:
    """Return processor seconds of a fresh process that folds a sheet of 10 x 10 panels."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "miura.fold"
        write(miura(10), path)
        command = [sys.executable, "-m", "synth.cli", "fold", str(path), "--drive", "10=60", "--frames", "4"]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL) as process:
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0
    return round(usage.ru_utime + usage.ru_stime, 2)


def main() -> None:
    """Run the sizes and store the figures."""
    rows = []
    for n, count in SIZES.items():
        rows.append(frames(n, count))
        print(rows[-1])
    panels, times = ([math.log(row[key]) for row in rows[1:]] for key in ("panels", "frame_ms"))
    growth = round(float(np.polyfit(panels, times, 1)[0]), 2)
    figures = {
        "python": platform.python_version(),
        "first_answer_seconds": first_answer(),
        "growth": f"panels ** {growth}",
        "sizes": rows,
    }
    print(figures["growth"], figures["first_answer_seconds"])
    Path(__file__).with_name("results").joinpath("folding.json").write_text(json.dumps(figures, indent=2) + "\n")


if __name__ == "__main__":
    main()
