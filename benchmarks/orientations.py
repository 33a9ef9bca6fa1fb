"""Order and dyads of orientations: a million fixed axes at once, one axis in full, all dyads of five.

    python benchmarks/orientations.py

writes the figures to benchmarks/results/orientations.json: seconds, medians of several runs, and for a known dyad
in 10 000 random problems how far the nearest dyad found is from it at most.
"""

from __future__ import annotations

import json
import platform
from collections.abc import Callable
from pathlib import Path
from statistics import median
from time import perf_counter

import numpy as np
from scipy.spatial.transform import Rotation

from synth.linkages.guidance.dyads import centre_axes
from synth.linkages.guidance.fourbars import four_bars
from synth.linkages.guidance.order import analyse_order, order_verdicts
from synth.linkages.guidance.orientations import Orientations, read_orientations
from synth.linkages.guidance.synthesis import dyads_by_least_squares, dyads_of_five

RUNS = 7
AXES = 1_000_000
PROBLEMS = 10_000
PAPER = Path(__file__).parents[1] / "data" / "orientations" / "tipparthi.json"


def timed(job: Callable[[], object], runs: int = RUNS) -> float:
    """Return the median time of a job."""
    taken = []
    for _ in range(runs):
        start = perf_counter()
        job()
        taken.append(perf_counter() - start)
    return median(taken)


def known_dyad(random: np.random.Generator) -> tuple[np.ndarray, np.ndarray, Orientations]:
    """Return G, W and five orientations of a random dyad."""
    g, w = (vector / np.linalg.norm(vector) for vector in random.normal(size=(2, 3)))
    crank, body = random.uniform(0.0, 2.0 * np.pi, (2, 5))
    first = Rotation.from_quat(random.normal(size=4))
    turned = Rotation.from_rotvec(np.outer(crank, g)) * first * Rotation.from_rotvec(np.outer(body, w))
    return g, w, Orientations.from_rotation(turned)


def farthest(problems: int) -> tuple[float, float]:
    """Return how far from a known dyad the nearest one found is at most, and the seconds a problem takes."""
    random = np.random.default_rng(10)
    worst = spent = 0.0
    for _ in range(problems):
        g, w, orientations = known_dyad(random)
        start = perf_counter()
        found = dyads_of_five(orientations).dyads
        spent += perf_counter() - start
        near = min(
            max(np.linalg.norm(np.cross(dyad.fixed, g)), np.linalg.norm(np.cross(dyad.moving, w))) for dyad in found
        )
        worst = max(worst, float(near))
    return worst, spent / problems


def main() -> None:
    """Time everything and store the figures."""
    five = read_orientations(PAPER)
    random = np.random.default_rng(2011)
    axes = random.normal(size=(AXES, 3))
    many = Orientations(np.linalg.qr(random.normal(size=(20, 4, 4)))[0][:, 0])
    dyads = dyads_of_five(five).dyads
    worst, each = farthest(PROBLEMS)
    figures = {
        "python": platform.python_version(),
        "seconds": {
            f"{AXES} axes, 5 orientations": round(timed(lambda: order_verdicts(five, axes)), 4),
            "one axis, three checks": round(timed(lambda: analyse_order(five, (1, 2, 3)), 200), 6),
            "all dyads of five orientations": round(each, 6),
            "30 four-bars of six dyads": round(timed(lambda: four_bars(five, dyads)), 4),
            "curves of four orientations, 360 points": round(timed(lambda: centre_axes(five.subset([1, 2, 3, 4]))), 4),
            "dyads of 20 orientations": round(timed(lambda: dyads_by_least_squares(many)), 4),
        },
        "known dyad": {"problems": PROBLEMS, "largest distance": float(f"{worst:.1e}")},
    }
    print(json.dumps(figures, indent=2))
    path = Path(__file__).with_name("results") / "orientations.json"
    path.write_text(json.dumps(figures, indent=2) + "\n")


if __name__ == "__main__":
    main()
