"""Start to answer on big crease patterns, ranks and pose left out, against `json.load` of the same file.

    python benchmarks/big_mesh.py

makes n x n meshes of quadrilaterals as FOLD files, runs both as fresh processes, and writes medians, ratios and
peak memory to benchmarks/results/big_mesh.json.
"""

from __future__ import annotations

import json
import os
import platform
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median
from time import perf_counter

SIZES = [75, 150, 300]
RUNS = 5


def mesh(n: int) -> dict[str, object]:
    """Return a FOLD document of n x n quadrilaterals."""
    at = [[i * (n + 1) + j for j in range(n + 1)] for i in range(n + 1)]
    edges, letters = [], []
    for i in range(n + 1):
        for j in range(n + 1):
            if j < n:
                edges.append([at[i][j], at[i][j + 1]])
                letters.append("B" if i in (0, n) else "M")
            if i < n:
                edges.append([at[i][j], at[i + 1][j]])
                letters.append("B" if j in (0, n) else "V")
    return {
        "file_spec": 1.1,
        "vertices_coords": [[j + 0.1 * (i % 2), i] for i in range(n + 1) for j in range(n + 1)],
        "edges_vertices": edges,
        "edges_assignment": letters,
        "faces_vertices": [
            [at[i][j], at[i][j + 1], at[i + 1][j + 1], at[i + 1][j]] for i in range(n) for j in range(n)
        ],
    }


def measured(command: list[str]) -> tuple[float, float]:
    """Return wall seconds and peak memory in MB of one run."""
    start = perf_counter()
    with subprocess.Popen(command, stdout=subprocess.DEVNULL) as process:
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0
    return perf_counter() - start, usage.ru_maxrss / 1024


def main() -> None:
    """Run the sizes and store the figures."""
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for n in SIZES:
            path = Path(folder) / f"mesh-{n}.fold"
            path.write_text(json.dumps(mesh(n)), encoding="utf-8")
            ours = [sys.executable, "-m", "synth.cli", "mobility", "--no-exact", "--no-pose", str(path)]
            load = [sys.executable, "-c", f"import json; json.load(open({str(path)!r}))"]
            pairs = [(measured(ours), measured(load)) for _ in range(RUNS)]
            seconds, loading = (median(pair[k][0] for pair in pairs) for k in (0, 1))
            rows.append(
                {
                    "panels": n * n,
                    "synth_seconds": round(seconds, 3),
                    "json_load_seconds": round(loading, 3),
                    "ratio": round(seconds / loading, 1),
                    "synth_peak_mb": round(max(pair[0][1] for pair in pairs)),
                }
            )
            print(rows[-1])
    figures = {"python": platform.python_version(), "runs": RUNS, "sizes": rows}
    Path(__file__).with_name("results").joinpath("big_mesh.json").write_text(json.dumps(figures, indent=2) + "\n")


if __name__ == "__main__":
    main()
