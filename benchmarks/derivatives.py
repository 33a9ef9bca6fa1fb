"""A gradient of a folded Miura sheet by all its vertices, against a frame of the path on which it is folded.

    python benchmarks/derivatives.py

folds n x n panels from flat to 120 degrees by one crease, and at each of the last frames takes the gradient of a
linear function of all places of vertices by all coordinates: factorisation, test of the rank and adjoint included.
Processor time; medians, and the ratio, are written to benchmarks/results/derivatives.json.
"""

from __future__ import annotations

import json
import os
import platform
from pathlib import Path
from statistics import median
from time import process_time

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from folding import FOLDED, miura

from graphs.convert.duality import mechanism_of_sheet
from synth.analysis.folding.derivatives import SheetDerivatives
from synth.analysis.folding.motion import fold
from synth.analysis.motion.linkage import linkage_of_sheet

SIZES = {10: 40, 32: 30, 50: 20}
"""Panels along each side, and frames."""


def gradients(n: int, count: int) -> dict[str, float | int]:
    """Return what one size takes."""
    sheet = miura(n)
    driven = n  # the first zigzag crease that is no rim
    sign = 1.0 if sheet.assignments[driven] == "V" else -1.0
    frames: list[float] = []
    folded = fold(sheet, drive={driven: sign * FOLDED}, frames=count, report=lambda _: frames.append(process_time()))
    mechanism = mechanism_of_sheet(sheet)
    linkage = linkage_of_sheet(sheet, mechanism)
    begun = process_time()
    shape = SheetDerivatives(sheet, mechanism, linkage)
    once = process_time() - begun
    by_places = np.random.default_rng(n).normal(size=(sheet.vertices, 3))
    place = list(mechanism.sc.joints).index(driven)
    times = []
    for angles in folded.path.angles[-count // 2 :]:
        begun = process_time()
        gradient = shape.at(angles, [place]).adjoint(by_places=by_places)
        times.append(process_time() - begun)
        assert np.isfinite(gradient).all()
    frame, each = median(np.diff(frames).tolist()), median(times)
    return {
        "panels": n * n,
        "coordinates": 2 * sheet.vertices,
        "frame_ms": round(1000.0 * frame, 2),
        "gradient_ms": round(1000.0 * each, 2),
        "ratio": round(each / frame, 2),
        "once_ms": round(1000.0 * once, 2),
    }


def main() -> None:
    """Run the sizes and store the figures."""
    rows = []
    for n, count in SIZES.items():
        rows.append(gradients(n, count))
        print(rows[-1])
    figures = {"python": platform.python_version(), "sizes": rows}
    path = Path(__file__).with_name("results").joinpath("derivatives.json")
    path.write_text(json.dumps(figures, indent=2) + "\n")


if __name__ == "__main__":
    main()
