"""Reduction: time against the number of panels of a strip of quadrilaterals, two wide.

    python benchmarks/reduce_strip.py

writes the times and the slope in log-log to benchmarks/results/reduce_strip.json. The strip is a four-bar with a
chain of ride-alongs. Building the graph and undoing are timed apart. Smaller strips fit into the processor's
caches and take about half as long a panel, so that a fit over them too would measure the caches.
"""

from __future__ import annotations

import json
import platform
from pathlib import Path
from statistics import median
from time import perf_counter

import numpy as np

from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.reduce.ride_alongs import reduce

SIZES = [12_500, 25_000, 50_000, 100_000, 200_000, 400_000]
RUNS = 3


def strip(panels: int) -> SCGraph:
    """Return a double strip of the given number of panels."""
    rows = panels // 2
    joints = {f"r{i}": (2 * i, 2 * i + 1) for i in range(rows)}
    joints |= {f"{side}{i}": (2 * i + k, 2 * i + 2 + k) for i in range(rows - 1) for k, side in enumerate("ab")}
    loops = [Loop((f"r{i}", f"b{i}", f"r{i + 1}", f"a{i}")) for i in range(rows - 1)]
    return SCGraph(panels, joints, loops)


def main() -> None:
    """Time the sizes and store the figures."""
    rows = []
    for size in SIZES:
        start = perf_counter()
        sc = strip(size)
        built = perf_counter() - start
        times = []
        for _ in range(RUNS):
            start = perf_counter()
            reduction = reduce(sc)
            times.append(perf_counter() - start)
            assert len(reduction.graph) == 4
        start = perf_counter()
        back = reduction.undo()
        undone = perf_counter() - start
        assert back.is_identical(sc)
        rows.append({"panels": size, "build": built, "reduce": median(times), "undo": undone})
        del sc, reduction, back
        print({key: round(value, 3) for key, value in rows[-1].items()})
    slope = float(np.polyfit(np.log([r["panels"] for r in rows]), np.log([r["reduce"] for r in rows]), 1)[0])
    figures = {
        "python": platform.python_version(),
        "seconds": [{key: round(value, 4) for key, value in row.items()} for row in rows],
        "slope_log_log": round(slope, 3),
    }
    Path(__file__).with_name("results").joinpath("reduce_strip.json").write_text(json.dumps(figures, indent=2) + "\n")
    print("slope", figures["slope_log_log"])


if __name__ == "__main__":
    main()
