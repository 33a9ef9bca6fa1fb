"""Two cores: sheets folded in turn, in two threads, in two processes; and a sweep, whose members use all cores.

    python benchmarks/two_cores.py

writes the shortest waits of all runs, in seconds, and what is gained, to benchmarks/results/two_cores.json. Other work
on the machine makes waits longer and gains smaller: the jobs take turns, and the best run of each counts.
"""

from __future__ import annotations

import json
import os
import platform
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path
from time import perf_counter, process_time

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

import synth

RUNS, SHEETS, PANELS, MEMBERS = 4, 4, 16, 20_000


def main() -> None:
    """Run the jobs in turn and store the figures."""
    sheets = [synth.generate("miura", rows=PANELS, columns=PANELS).mechanism] * SHEETS
    ring = synth.generate("four-bar").mechanism
    arcs = np.radians(np.array([30.0, 80.0, 70.0, 75.0]) + np.random.default_rng(1).uniform(-5.0, 5.0, (MEMBERS, 4)))
    turn = np.linspace(0.0, 2.0 * np.pi, 64)
    with ProcessPoolExecutor(2) as processes, ThreadPoolExecutor(2) as threads:
        jobs: dict[str, Callable[[], object]] = {
            "in turn": lambda: [synth.fold(sheet) for sheet in sheets],
            "two threads": lambda: list(threads.map(synth.fold, sheets)),
            "two processes": lambda: list(processes.map(synth.fold, sheets)),
        }
        for job in jobs.values():
            job()
        waits: dict[str, list[float]] = {name: [] for name in jobs}
        busy = []
        for _ in range(RUNS):
            for name, job in jobs.items():
                begun = perf_counter()
                job()
                waits[name].append(perf_counter() - begun)
            begun, spent = perf_counter(), process_time()
            synth.sweep(ring, {"arcs": arcs}, drive={0: turn})
            busy.append((process_time() - spent) / (perf_counter() - begun))
    best = {name: round(min(taken), 3) for name, taken in waits.items()}
    figures = {
        "python": platform.python_version(),
        "cores": os.cpu_count(),
        "runs": RUNS,
        "folds": f"{SHEETS} Miura sheets of {PANELS * PANELS} panels",
        "seconds": best,
        "gain": {name: round(best["in turn"] / wait, 2) for name, wait in best.items()},
        "cores_busy_in_sweep": round(max(busy), 2),
    }
    Path(__file__).with_name("results").joinpath("two_cores.json").write_text(json.dumps(figures, indent=2) + "\n")
    print(json.dumps(figures, indent=2))


if __name__ == "__main__":
    main()
