"""Random sets of five orientations, which no four-bar takes, guided through by six-bars of Watt.

    python benchmarks/six_bars.py [--sets N] [--from N] [--tries N]

Set number k is five rotations drawn evenly with the seed [2026, k]; sets are left out that a four-bar of their dyads
takes without a defect (of the first 60 none). `synth.six_bars` looks for a six-bar; `synth.move` then turns its driven
joint from orientation 1 to each of the others by the axes alone, and the body is compared. Prints a line for each set
and writes benchmarks/results/six_bars.json.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
from math import degrees
from pathlib import Path
from time import process_time
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from scipy.spatial.transform import Rotation

import synth
from graphs.geometry import rotations
from synth.linkages.guidance import GuidedSixBar, Orientations, dyads_of_five, four_bars, six_bars

OUT = Path(__file__).parent / "results" / "six_bars.json"


def orientations_of(number: int) -> Orientations:
    """Return a set."""
    return Orientations.from_rotation(Rotation.random(5, np.random.default_rng([2026, number])))


def missed(six_bar: GuidedSixBar) -> float:
    """Return by how much the body misses an orientation where `synth.move` has turned the driven joint, radians."""
    m, misses = six_bar.orientations.matrices, []
    for place in range(1, 5):
        end = synth.move(six_bar.linkage, drive={0: float(six_bar.inputs[place])}, frames=30).path.angles[-1]
        turned = np.eye(3)
        for joint in range(3):
            turned = turned @ rotations(six_bar.axes[joint], end[joint])
        body = (turned if six_bar.driven == "ground" else turned.T) @ m[0]
        misses.append(float(Rotation.from_matrix(body.T @ m[place]).magnitude()))
    return max(misses)


def row_of(number: int, tries: int) -> dict[str, Any] | None:
    """Return the figures of a set; None if a four-bar takes it."""
    five = orientations_of(number)
    if not all(four_bar.defects for four_bar in four_bars(five, dyads_of_five(five).dyads)):
        return None
    start = process_time()
    found = six_bars(five, tries=tries)
    row: dict[str, Any] = {"set": number, "seconds": round(process_time() - start, 1), "tried": found.tried}
    for six_bar in found.six_bars:
        row |= {
            "driven": six_bar.driven,
            "turns_by_deg": round(degrees(six_bar.inputs[-1]), 1),
            "transmission_deg": round(degrees(six_bar.transmission), 2),
            "residual": six_bar.residual,
            "missed_by_walking": missed(six_bar),
        }
    return row


def main() -> None:
    """Run and write the figures."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--sets", type=int, default=50)
    parser.add_argument("--from", type=int, default=0, dest="first")
    parser.add_argument("--tries", type=int, default=60)
    options = parser.parse_args()
    rows: list[dict[str, Any]] = []
    number = options.first
    while len(rows) < options.sets:
        row = row_of(number, options.tries)
        number += 1
        if row is None:
            continue
        rows.append(row)
        print(row, flush=True)
        solved = [each for each in rows if "driven" in each]
        figures = {
            "machine": f"{platform.machine()}, Python {platform.python_version()}, one core",
            "sets": len(rows),
            "solved": len(solved),
            "solved_within_600_s": sum(each["seconds"] <= 600.0 for each in solved),
            "median_seconds": float(np.median([each["seconds"] for each in rows])),
            "worst_missed_by_walking": max((each["missed_by_walking"] for each in solved), default=None),
            "rows": rows,
        }
        OUT.write_text(json.dumps(figures, indent=1) + "\n")


if __name__ == "__main__":
    main()
