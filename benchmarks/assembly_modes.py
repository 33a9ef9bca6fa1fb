"""Random planar and spherical chains of six and eight links: assembly modes from five seeds, and by elimination.

    python benchmarks/assembly_modes.py [--chains N] [--seeds N] [--trace]

Chain number k is one of the enumerated types, with random dimensions, driven joint and input, drawn with the seed
[2026, k]; even numbers are planar, every other pair has eight links. `synth.positions` answers from five seeds of its
own for each chain: the general positions, what became of them, and the real modes are to be the same. The tests'
elimination modulo a prime (tests/support/elimination.py), which shares no code with it, then says how many positions
there are, real or not. With --trace no theorem says how many there are, so that trace tests have to. Prints a line for
each chain and writes benchmarks/results/assembly_modes.json, or assembly_modes_trace.json.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import sys
import tempfile
from collections import Counter
from functools import cache, partial
from pathlib import Path
from time import process_time
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

import synth
from enumerate.chains.jobs import chains
from graphs.mechanism.sc import SCGraph
from synth.analysis.assembly import general

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "support"))

from elimination import number_of_positions, plates_of
from spherical import planar, spherical

RESULTS = Path(__file__).parent / "results"


@cache
def types(links: int) -> list[SCGraph]:
    """Return the chains of one degree of freedom."""
    return [SCGraph(chain.nodes, list(chain.edges())) for chain in chains(links=links, dof=1)]


def row_of(number: int, seeds: int) -> dict[str, Any]:
    """Return what both methods say of a chain, and processor seconds."""
    random = np.random.default_rng([2026, number])
    links, in_the_plane = (6, 8)[number // 2 % 2], number % 2 == 0
    place = int(random.integers(len(types(links))))
    graph = types(links)[place]
    driven, angle = int(random.integers(len(graph.joints))), float(random.uniform(-0.5, 0.5))
    linkage = (planar if in_the_plane else spherical)(graph, random)
    begun = process_time()
    answers = [
        synth.positions(linkage, drive={driven: angle}, circuits=False, seed=seeds * number + seed)
        for seed in range(seeds)
    ]
    middle = process_time()
    eliminated = number_of_positions(partial(plates_of, linkage, {driven: angle}), random)
    first, *others = answers
    modes = np.array([mode.angles for mode in first.positions])
    same = all(
        len(other.positions) == len(first.positions)
        and (not len(modes) or np.allclose(np.array([mode.angles for mode in other.positions]), modes, atol=1e-7))
        for other in others
    )
    return {
        "chain": number,
        "kind": "planar" if in_the_plane else "spherical",
        "links": links,
        "type": place,
        "driven": driven,
        "general": sorted({answer.general for answer in answers}),
        "complex": sorted({len(answer.positions) + answer.imaginary for answer in answers}),
        "real": sorted({len(answer.positions) for answer in answers}),
        "same_modes": same,
        "evidence": sorted({str(answer.evidence) for answer in answers}),
        "elimination": eliminated,
        "seconds": round(middle - begun, 2),
        "seconds_of_elimination": round(process_time() - middle, 2),
    }


def agrees(row: dict[str, Any]) -> bool:
    """Whether all seeds and the elimination say the same."""
    return bool(
        row["general"] == row["complex"] == [row["elimination"]] and len(row["real"]) == 1 and row["same_modes"]
    )


def says_too_much(row: dict[str, Any]) -> bool:
    """Whether a list is called complete where the elimination finds more, or no number."""
    eliminated = row["elimination"]
    return row["evidence"] != ["None"] and (eliminated is None or eliminated > min(row["complex"]))


def written(rows: list[dict[str, Any]], seeds: int) -> str:
    """Return the totals and all rows as JSON, a chain in a line."""
    totals = {
        "python": platform.python_version(),
        "chains": len(rows),
        "seeds": seeds,
        "agree": sum(map(agrees, rows)),
        "evidence": Counter(" or ".join(row["evidence"]) for row in rows),
        "exhaustive_where_elimination_finds_more": [row["chain"] for row in rows if says_too_much(row)],
        "seconds": round(sum(row["seconds"] for row in rows), 1),
        "seconds_of_elimination": round(sum(row["seconds_of_elimination"] for row in rows), 1),
    }
    lines = ",\n  ".join(map(json.dumps, rows))
    return f'{json.dumps(totals, indent=1)[:-2]},\n "rows": [\n  {lines}\n ]\n}}\n'


def main() -> None:
    """Ask all chains, print and write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--chains", type=int, default=500)
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--trace", action="store_true", help="count general positions by trace tests alone")
    given = parser.parse_args()
    out = RESULTS / ("assembly_modes_trace.json" if given.trace else "assembly_modes.json")
    if given.trace:
        general.root_count = lambda family: None
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        os.environ["SYNTHEDRA_CACHE"] = folder
        for number in range(given.chains):
            rows.append(row_of(number, given.seeds))
            print(json.dumps(rows[-1]), flush=True)
            out.write_text(written(rows, given.seeds))


if __name__ == "__main__":
    main()
