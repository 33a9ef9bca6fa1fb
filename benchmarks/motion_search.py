"""Search by motion: a query among signatures of random members, and six-bars taken through inputs by `synth.sweep`.

    python benchmarks/motion_search.py [--signatures N] [--members N]

writes benchmarks/results/motion_search.json: seconds and processor seconds of a circuit and of a third of one among
so many signatures (1 000 000 by default, copies of few with noise), the largest memory, and processor seconds of so
many spherical six-bars (100 000 by default) at 64 inputs.
"""

from __future__ import annotations

import argparse
import json
import platform
import resource
import shutil
import sqlite3
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter, process_time
from typing import Any

import numpy as np

from graphs.files.formats import mechanism_of_id
from graphs.geometry import unit
from graphs.mechanism.solids import HingedSolids
from synth.analysis.members import circuits_of, sweep
from synth.analysis.members.circuits import relative, spherical_of
from synth.synthesis.atlas import AtlasPlan, add_motions, build_atlas, like, open_atlas
from synth.synthesis.atlas.motions import _blob, stored_motions

PLACE = Path(__file__).resolve().parent / "results" / "motion_search.json"
WATT = "k1:E`hW"
MOTIONS = 8
"""Pairs of links of a six-bar without a common joint."""


def timed(work: Callable[[], Any]) -> dict[str, float]:
    """Return seconds and processor seconds of some work."""
    wall, processor = perf_counter(), process_time()
    work()
    return {"seconds": perf_counter() - wall, "processor_seconds": process_time() - processor}


def filled(place: Path, signatures: int) -> None:
    """Add units of Watt's chain that are the first one with noise, until there are so many signatures."""
    random = np.random.default_rng(0)
    with closing(sqlite3.connect(place)) as connection, connection:
        row = connection.execute("SELECT * FROM motions WHERE chain = ? AND unit = 0", (WATT,)).fetchone()
        circuits, spans = (np.frombuffer(row[column][:-4], np.float32) for column in (6, 7))
        each = len(circuits) // 16
        for number in range(1, -(-signatures // each)):
            noisy = [
                _blob((array * random.uniform(0.9, 1.1, len(array))).astype(np.float32)) for array in (circuits, spans)
            ]
            values = (WATT, number, *row[2:6], *noisy, *row[8:])
            connection.execute("INSERT OR REPLACE INTO motions VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)", values)


def queries(signatures: int) -> dict[str, Any]:
    """Return what a circuit and a third of one cost among so many signatures."""
    with TemporaryDirectory() as folder:
        place = Path(folder, "atlas.sqlite")
        build_atlas(place, AtlasPlan(6, creases=0, orders_of=(), realised=False))
        atlas = open_atlas(place)
        tracing = timed(lambda: add_motions(atlas, members=256))
        whole = shutil.copy(place, Path(folder, "many.sqlite"))
        filled(Path(whole), signatures)
        many = open_atlas(whole)
        chain = mechanism_of_id(WATT)
        turned = circuits_of(chain, np.random.default_rng(9).normal(size=(1, 7, 3))).rotations()
        motion = relative(turned[0], turned[2])[0]
        return {
            "members_traced": tracing | {"members": 3 * 256},
            "signatures": stored_motions(many).motions,
            "circuit": timed(lambda: like(many, motion, closed=True)),
            "third": timed(lambda: like(many, motion[:85], closed=False)),
            "largest_memory_megabytes": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3,
        }


def swept(members: int) -> dict[str, Any]:
    """Return what so many six-bars at 64 inputs cost."""
    chain = spherical_of(mechanism_of_id(WATT))
    axes = unit(np.random.default_rng(1).normal(size=(members, 7, 3)))
    one = HingedSolids(
        chain, {joint: ((0.0, 0.0, 0.0), tuple(axis)) for joint, axis in zip(chain.joints, axes[0], strict=True)}
    )
    answers: list[Any] = []
    inputs = {next(iter(chain.joints)): np.linspace(0.0, 1.0, 64)}
    cost = timed(lambda: answers.append(sweep(one, {"axes": axes}, drive=inputs)))
    return cost | {"members": members, "inputs": 64, "closed": int(answers[0].closed.sum())}


def main() -> None:
    """Measure, and write the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--signatures", type=int, default=1_000_000)
    parser.add_argument("--members", type=int, default=100_000)
    options = parser.parse_args()
    figures = {
        "machine": platform.processor() or platform.machine(),
        "queries": queries(options.signatures),
        "sweep": swept(options.members),
    }
    PLACE.write_text(f"{json.dumps(figures, indent=1)}\n", encoding="utf-8")
    print(json.dumps(figures, indent=1))


if __name__ == "__main__":
    main()
