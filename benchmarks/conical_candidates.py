"""Conical candidates: counts, evaluation on slots, what orders allow over all angles; whole-process times.

    python benchmarks/conical_candidates.py

writes seconds, numbers of rows and rows a second to benchmarks/results/conical_candidates.json. Compiled code is
warm.
"""

from __future__ import annotations

import json
import os
import platform
import subprocess
import sys
import tempfile
from pathlib import Path
from time import perf_counter

from enumerate.chains.jobs import chains
from enumerate.conical.query import ConicalQuery, count_conical_orders
from enumerate.runner.store import read_rows

RESULTS = Path(__file__).parent / "results" / "conical_candidates.json"
JOBS = {
    "watt, every ground link, 12 slots": ("watt", "--ground", "all", "--slots", "12"),
    "stephenson, every ground link, 12 slots": ("stephenson", "--ground", "all", "--slots", "12"),
    "watt, every ground link, 12 slots, lambda 20, one worker": (
        "watt", "--ground", "all", "--slots", "12", "--lambda", "20", "--workers", "1"
    ),
    "watt, every ground link, all angles": ("watt", "--ground", "all"),
    "stephenson, every ground link, all angles": ("stephenson", "--ground", "all"),
    "watt, every ground link, opposites": ("watt", "--ground", "all", "--opposites"),
}  # fmt: skip


def run(chain: str, *words: str) -> dict[str, float]:
    """Return time and rows of one run into a store."""
    with tempfile.TemporaryDirectory() as folder:
        store = f"{folder}/store.sqlite"
        start = perf_counter()
        command = [sys.executable, "-m", "synth.cli", "enumerate", "conical", "--chain", chain, *words, "-o", store]
        subprocess.run(command, check=True)
        seconds = perf_counter() - start
        rows = sum(1 for _ in read_rows(store))
    return {"seconds": round(seconds, 2), "rows": rows, "rows a second": round(rows / seconds)}


def counted(method: str) -> dict[str, float]:
    """Return time and sum of the cyclic orders of all eight-link chains."""
    queries = [
        ConicalQuery(tuple(zip(range(graph.number_of_edges()), graph.edges(), strict=True))) for graph in chains(8, 1)
    ]
    start = perf_counter()
    total = sum(count_conical_orders(query, method) for query in queries)
    return {"seconds": round(perf_counter() - start, 2), "count": total}


def main() -> None:
    """Time everything and store the figures."""
    figures: dict[str, object] = {"python": platform.python_version(), "cores": os.cpu_count()}
    run("four-bar", "--ground", "all")
    run("four-bar", "--ground", "all", "--slots", "6")
    counted("orbits")
    for method in ("orbits", "burnside"):
        figures[f"cyclic orders of the 16 eight-link chains, {method}"] = counted(method)
    for name, words in JOBS.items():
        figures[name] = run(*words)
        print(name, figures[name], flush=True)
    RESULTS.write_text(json.dumps(figures, indent=2) + "\n")


if __name__ == "__main__":
    main()
