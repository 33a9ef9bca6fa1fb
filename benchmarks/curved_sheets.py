"""Flat-foldable sheets of quadrilaterals that fold to a spherical cap and to a saddle, by Gaussian curvature.

    python benchmarks/curved_sheets.py

changes the numbers of two sides of a sheet (32 x 32 panels for the cap of curvatures 1 and 1, 26 x 22 for the saddle
of 0.1 and -0.1) from the linear perturbations of A. Sardas, M. Moshe and C. Maor (2024), arXiv 2405.07249, and
measures curvatures with their shape operator;
the verdict is that of the folded sheet. Their sheets, by their program: rms errors of 0.051 over the cap and 0.0022
over the saddle. Figures are written to benchmarks/results/curved_sheets.json.
"""

from __future__ import annotations

import json
import os
import platform
from dataclasses import replace
from math import cos, tan
from pathlib import Path
from time import process_time

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

from synth.analysis.verdict import mobility
from synth.synthesis.designing.quadrilaterals import (
    QuadrilateralSides,
    cell_curvatures,
    curved_sheet,
    folded,
    marched,
    miura_sides,
    sheet_of_sides,
)

SHEETS = {
    "cap": ((16, 16), 1.4, 2.4, (1.0, 2.0), (-0.15, 0.293), (-0.1, 0.269), (-1.0, -1.0), 0.051),
    "saddle": ((11, 13), 1.2, 2.2, (15.0, 15.0), (-0.4, 0.9), (0.5, -1.0), (0.1, -0.1), 0.0022),
}
"""Cells, sector, fold, width and height, how corners and how lengths change, curvatures, rms error of the paper."""


def start(
    cells: tuple[int, int], sector: float, fold: float, size: tuple[float, float], corners: tuple[float, float],
    lengths: tuple[float, float],
) -> QuadrilateralSides:  # fmt: skip
    """Return a Miura sheet with corners changed in proportion to columns, and every second height to rows."""
    across, up = cells
    sides = miura_sides(2 * up, 2 * across, sector, size[1] / up, size[0] / across, tan(fold / 2) / cos(sector))
    change = corners[0] + corners[1] * np.arange(2 * across + 1) / (2 * across)
    at_left = change[0] * (-1.0) ** np.arange(2 * up + 1)
    heights = sides.heights.copy()
    heights[1::2] *= 1.0 + lengths[0] + lengths[1] * np.arange(up) / up
    left, lower = sides.left + np.stack([at_left, -at_left]), sides.lower + np.stack([change[1:], -change[1:]])
    return QuadrilateralSides(left, lower, heights, sides.widths, sides.fold)


def rms(values: np.ndarray) -> float:
    """Return the root of the mean square."""
    return float(np.sqrt((values**2).mean()))


def row(name: str) -> dict[str, object]:
    """Return the figures of one sheet."""
    cells, sector, fold, size, corners, lengths, curvatures, theirs = SHEETS[name]
    first = start(cells, sector, fold, size, corners, lengths)
    gaussian, mean = curvatures[0] * curvatures[1], sum(curvatures) / 2
    begun = process_time()
    sheet = curved_sheet(first, curvatures)
    seconds = process_time() - begun
    flat, places = marched(sheet.sides)[0], folded(sheet.sides)
    edges = [
        np.linalg.norm(np.diff(places, axis=k), axis=2) - np.linalg.norm(np.diff(flat, axis=k), axis=2) for k in (0, 1)
    ]
    vertices = tuple(map(tuple, places.reshape(-1, 3).tolist()))
    verdict = str(mobility(replace(sheet_of_sides(sheet.sides), coordinates=vertices))).splitlines()[0]
    return {
        "panels": 4 * cells[0] * cells[1],
        "gaussian_rms_start": round(rms(cell_curvatures(folded(first))[0] - gaussian), 6),
        "gaussian_rms": float(f"{rms(sheet.gaussian - gaussian):.3g}"),
        "gaussian_rms_paper": theirs,
        "mean_rms": float(f"{rms(sheet.mean - mean):.3g}"),
        "values": list(sheet.gaussian.shape),
        "flat_size": np.ptp(flat.reshape(-1, 2), axis=0).round(4).tolist(),
        "folded_size": np.ptp(places.reshape(-1, 3), axis=0).round(4).tolist(),
        "largest_change_of_an_edge": float(f"{max(abs(part).max() for part in edges):.1e}"),
        "verdict": verdict,
        "seconds": round(seconds, 1),
    }


def main() -> None:
    """Measure both, print and write."""
    rows = {name: row(name) for name in SHEETS}
    for name, figures in rows.items():
        print(name, figures)
    result = {"python": platform.python_version(), "sheets": rows}
    Path(__file__).with_name("results").joinpath("curved_sheets.json").write_text(json.dumps(result, indent=2) + "\n")


if __name__ == "__main__":
    main()
