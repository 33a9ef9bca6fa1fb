"""SC and SCD graphs: how many a second, compiled and as rows with ids, on one core.

    python benchmarks/types_of_mechanisms.py

writes rates to benchmarks/results/types_of_mechanisms.json. Compiled code is warm: each job runs once before it
is timed, and medians of three runs are kept. "compiled" is listing with all attributes and codes as arrays, and
for SCD graphs the ranks under the forced geometry; "rows" is what a store is given, ids as text and the id of
the chain. There is no program to compare with: none that lists SC or SCD graphs is known.
"""

from __future__ import annotations

import json
import os
import platform
from collections.abc import Callable
from pathlib import Path
from statistics import median
from time import perf_counter

from enumerate.machine_code.kernels import use_machine_code
from enumerate.sc.jobs import UNIT_ROWS, SCJob, count_sc_graphs, drawn_of
from enumerate.sc.listing import describe
from enumerate.sc.query import SCQuery
from enumerate.scd.jobs import SCDJob, all_mechanisms, placements_on
from enumerate.scd.query import SCDQuery

RESULTS = Path(__file__).parent / "results" / "types_of_mechanisms.json"
RUNS = 3


def timed(work: Callable[[], int]) -> dict[str, float]:
    """Return the number of outputs, median seconds and outputs a second of a job."""
    number = work()
    taken = []
    for _ in range(RUNS):
        start = perf_counter()
        work()
        taken.append(perf_counter() - start)
    seconds = median(taken)
    return {"outputs": number, "seconds": round(seconds, 4), "a second": round(number / seconds)}


def sc_compiled(links: int, dof: int) -> int:
    """List all SC graphs with their attributes as arrays."""
    query = SCQuery(links, dof)
    total = 0
    for unit in SCJob(query).units():
        for part in unit.payload:
            drawn = drawn_of(query, part)
            total += len(describe(part.code, part.n, links, part.outer, drawn.x, drawn.labels, False)[0])
    return total


def sc_rows(links: int, dof: int) -> int:
    """Make all rows."""
    job = SCJob(SCQuery(links, dof))
    return sum(len(job.work(unit.payload)) for unit in job.units())


def scd_compiled(mechanisms: SCDQuery) -> int:
    """List all placements with their attributes as arrays."""
    total = 0
    for source in mechanisms.sources(UNIT_ROWS):
        for drawn in mechanisms.drawn(source.payload):
            for code, labels in drawn.each():
                total += len(placements_on(mechanisms.placements, mechanisms.dof, code, labels, 0, 1 << 62)[0])
    return total


def scd_rows(mechanisms: SCDQuery) -> int:
    """Make all rows."""
    job = SCDJob(mechanisms)
    return sum(len(job.work(unit.payload)) for unit in job.units())


def main() -> None:
    """Time the jobs and store the figures."""
    use_machine_code()
    figures: dict[str, object] = {"python": platform.python_version(), "cores": os.cpu_count()}
    for links, dof in ((10, 1), (12, 1), (11, 2)):
        figures[f"SC {links} links M={dof}, compiled"] = timed(lambda n=links, m=dof: sc_compiled(n, m))
        figures[f"SC {links} links M={dof}, rows"] = timed(lambda n=links, m=dof: sc_rows(n, m))
    figures["SC 14 links M=1, counted"] = timed(lambda: count_sc_graphs(14, 1))
    for links, dof, most in ((8, 1, 5), (6, 1, 6), (12, 1, 4), (8, 7, 4)):
        mechanisms = all_mechanisms(links, dof, most)
        name = f"SCD {links} links M={dof} D={most}"
        figures[f"{name}, compiled"] = timed(lambda one=mechanisms: scd_compiled(one))
        figures[f"{name}, rows"] = timed(lambda one=mechanisms: scd_rows(one))
    figures["limits"] = {"SC a second": 20_000, "SCD a second": 100_000}
    for name, value in figures.items():
        print(name, value)
    RESULTS.write_text(json.dumps(figures, indent=2) + "\n")


if __name__ == "__main__":
    main()
