"""Kinematic chains: whole-process times of `synth enumerate chains`, of nauty's geng, and of pylinkage.

    python benchmarks/chains.py [JOB ...]

writes medians, ratios and the cost of an output against the size to benchmarks/results/chains.json; with names of
jobs only those are timed anew. Compiled code is warm but for the job "cold". geng lists all 2-connected graphs
without triangles of the right size, of which the chains are a part; the time to pick these is not counted against
it. pylinkage is installed into a temporary folder; it lists 6 links, and did not end on 8 links within six
minutes.
"""

from __future__ import annotations

import json
import os
import platform
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median
from time import perf_counter

RESULTS = Path(__file__).parent / "results" / "chains.json"
RUNS = 5
CHAINS = {4: 1, 6: 2, 8: 16, 10: 230, 12: 6856, 14: 318162, 16: 19819281, 18: 1535380884}


def synth(links: int, *words: str) -> list[str]:
    """Return the command for chains of one freedom."""
    return [sys.executable, "-m", "synth.cli", "enumerate", "chains", "--links", str(links), "--dof", "1", *words]


def seconds(command: list[str], **environment: str) -> float:
    """Return the wall time of one run."""
    start = perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                   env={**os.environ, **environment})  # fmt: skip
    return perf_counter() - start


def times(command: list[str], runs: int = RUNS, **environment: str) -> float:
    """Return the median wall time."""
    return round(median(seconds(command, **environment) for _ in range(runs)), 3)


def our_jobs(folder: str) -> dict[str, list[str]]:
    """Return the jobs that are timed warm."""
    return {
        **{f"count {links}": synth(links, "--count") for links in (8, 10, 12, 14, 16, 18)},
        "count 16 burnside": synth(16, "--count", "--method", "burnside"),
        "count 14, inversions": synth(14, "--count", "--inversions"),
        "write 12 g6": synth(12, "-o", f"{folder}/12.g6", "--force"),
        "write 14 g6": synth(14, "-o", f"{folder}/14.g6", "--force"),
        "write 14 g6, one worker": synth(14, "-o", f"{folder}/14.g6", "--force", "--workers", "1"),
        "write 16 g6": synth(16, "-o", f"{folder}/16.g6", "--force"),
        "write 12 sqlite": synth(12, "-o", f"{folder}/12.sqlite", "--force"),
        "write 14 sqlite": synth(14, "-o", f"{folder}/14.sqlite", "--force"),
        "write 16 sqlite": synth(16, "-o", f"{folder}/16.sqlite", "--force"),
    }


def cold() -> float:
    """Return the time of a first run that compiles everything and writes 14-link chains."""
    with tempfile.TemporaryDirectory() as folder:
        return round(seconds(synth(14, "-o", f"{folder}/14.g6", "--force"), SYNTHEDRA_CACHE=folder), 3)


def geng(links: int) -> list[str] | None:
    """Return nauty's command for the graphs that hold all chains of so many links."""
    program = shutil.which("nauty-geng") or shutil.which("geng")
    joints = (3 * (links - 1) - 1) // 2
    return program and [program, "-Ctd2", "-q", str(links), f"{joints}:{joints}"]


def pylinkage(links: int) -> float | None:
    """Return the time pylinkage takes, if it installs."""
    with tempfile.TemporaryDirectory() as folder:
        install = [sys.executable, "-m", "pip", "install", "-q", "--target", folder, "--no-deps", "pylinkage", "tqdm"]
        if subprocess.run(install, check=False, capture_output=True).returncode:
            return None
        code = (
            "from pylinkage.topology.enumeration import enumerate_topologies as e; "
            f"assert len(e({links})) == {CHAINS[links]}"
        )
        return times([sys.executable, "-c", code], 1, PYTHONPATH=folder)


def main() -> None:
    """Time the jobs and store the figures."""
    wanted = sys.argv[1:]
    old = json.loads(RESULTS.read_text()) if wanted and RESULTS.exists() else {"seconds": {}}
    taken = old["seconds"]

    def note(name: str, measure: object) -> None:
        if not wanted or name in wanted:
            taken[name] = measure() if callable(measure) else measure
            print(name, taken[name], flush=True)

    with tempfile.TemporaryDirectory() as folder:
        for name, command in our_jobs(folder).items():
            seconds(synth(8, "-o", f"{folder}/8.g6", "--force"))
            note(name, lambda command=command, name=name: times(command, 1 if name.startswith("write 16") else RUNS))
    note("cold, write 14 g6", cold)
    for links in (12, 14, 16):
        command = geng(links)
        if command:
            note(f"geng {links}", lambda command=command, links=links: times(command, 1 if links == 16 else RUNS))
    for links in (6,):
        note(f"pylinkage {links}", lambda links=links: pylinkage(links))
    per_output = {
        name: round(1e9 * taken[name] / CHAINS[n], 1)
        for n in (12, 14, 16, 18)
        for name in (f"count {n}", f"write {n} g6", f"write {n} sqlite")
        if name in taken
    }
    ratios = {
        f"geng {n} / count": round(taken[f"geng {n}"] / taken[f"count {n}"], 1)
        for n in (12, 14, 16)
        if taken.get(f"geng {n}") and f"count {n}" in taken
    }
    if taken.get("pylinkage 6"):
        ratios["pylinkage 6 / count 8"] = round(taken["pylinkage 6"] / taken["count 8"], 1)
    figures = {
        "python": platform.python_version(),
        "cores": os.cpu_count(),
        "seconds": taken,
        "nanoseconds per output": per_output,
        "ratios": ratios,
        "limits": {
            "count 14": 4,
            "write 14 g6": 10,
            "write 16 g6": 100,
            "write 16 sqlite": 198,
            "count 16": 40,
            "count 18": 1200,
            "cold - warm": 20,
        },
    }
    RESULTS.write_text(json.dumps(figures, indent=2) + "\n")


if __name__ == "__main__":
    main()
