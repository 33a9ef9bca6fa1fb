"""Start-up: whole-process time of `synth --help` against importing networkx, in one process tree.

    python benchmarks/help_time.py

writes medians and their ratio to benchmarks/results/help_time.json.
"""

from __future__ import annotations

import json
import platform
import subprocess
import sys
from pathlib import Path
from statistics import median
from time import perf_counter

RUNS = 25
JOBS = {
    "synth --help": [sys.executable, "-m", "synth.cli", "--help"],
    "import networkx": [sys.executable, "-c", "import networkx"],
    "bare python": [sys.executable, "-c", "pass"],
}


def seconds(command: list[str]) -> float:
    """Return the wall time of one run."""
    start = perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return perf_counter() - start


def main() -> None:
    """Run the jobs in turn and store the figures."""
    times: dict[str, list[float]] = {name: [] for name in JOBS}
    for _ in range(RUNS):
        for name, command in JOBS.items():
            times[name].append(seconds(command))
    medians = {name: round(median(taken), 4) for name, taken in times.items()}
    figures = {
        "python": platform.python_version(),
        "runs": RUNS,
        "median_seconds": medians,
        "ratio": round(medians["synth --help"] / medians["import networkx"], 3),
    }
    Path(__file__).with_name("results").joinpath("help_time.json").write_text(json.dumps(figures, indent=2) + "\n")
    print(json.dumps(figures, indent=2))


if __name__ == "__main__":
    main()
