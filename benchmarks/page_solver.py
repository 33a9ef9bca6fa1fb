"""Miura sheets folded by the solver of the page, in node: time of a frame.

    python benchmarks/page_solver.py

folds n x n panels by a hundred degrees, a frame each degree, as a slider that is drawn slowly asks for it; takes
the median of the frames, and writes benchmarks/results/page_solver.json. Processor time, since other work on the
machine does not count in it.
"""

from __future__ import annotations

import json
import os
import platform
import subprocess
import sys
from pathlib import Path
from statistics import median

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.folding.derivatives import largest_panel
from synth.analysis.folding.motion import fold
from synth.catalogue.patterns.creases import miura
from synth.making.viewer.linkage import bodies_of_sheet, solver_data

HERE = Path(__file__).resolve().parent
ANSWERS = HERE.parent / "synth" / "making" / "viewer" / "web" / "src" / "answers.js"
SIZES = (5, 10, 20, 32)
SECTOR = np.radians(60.0)
FRAMES = 100


def question(n: int) -> dict[str, object]:
    """Return what the solver is asked of one size."""
    pattern = configuration_of_sheet(fold(miura(n, n, SECTOR), frames=9).frames()[1])  # 20 degrees of 179
    driver = int(np.abs(pattern.linkage.angles).argmax())
    begun = float(pattern.linkage.angles[driver])
    bodies = bodies_of_sheet(pattern.sheet, pattern.mechanism, pattern.linkage)
    ground = list(pattern.linkage.graph.nodes)[largest_panel(pattern.mechanism.panels)]
    return {
        "linkage": solver_data(pattern.linkage, limited=True, ground=ground),
        "anywhere": pattern.linkage.angles.tolist(),
        "near": pattern.linkage.angles.tolist(),
        "direction": None,
        "driver": driver,
        "held": [],
        "goals": [begun + np.sign(begun) * np.radians(degrees) for degrees in range(1, FRAMES + 1)],
        "vertices": bodies.vertices.tolist(),
        "owners": bodies.owners,
        "faces": [],
    }


def measured(n: int) -> dict[str, float | int]:
    """Return what one size takes in a process of its own."""
    run = subprocess.run(["node", ANSWERS], input=json.dumps([question(n)]), capture_output=True, text=True, check=True)
    (answer,) = json.loads(run.stdout)
    frames = answer["frames"]
    assert not any(frame["stopped"] for frame in frames), "a frame did not reach its angle"
    times = [frame["took"] for frame in frames]
    return {
        "panels": n * n,
        "frame_ms": round(median(times), 3),
        "slowest_ms": round(max(times), 3),
        "closure": max(frame["error"] for frame in frames),
    }


def main() -> None:
    """Measure and write."""
    version = subprocess.run(["node", "--version"], capture_output=True, text=True, check=True).stdout.strip()
    rows = []
    for n in SIZES:
        rows.append(measured(n))
        print(rows[-1], file=sys.stderr)
    place = HERE / "results" / "page_solver.json"
    told = {"machine": platform.machine(), "node": version, "sizes": rows}
    place.write_text(json.dumps(told, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
