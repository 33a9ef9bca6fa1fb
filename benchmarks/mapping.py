"""Mapping to cones and cylinders: closed form, loop sums, first-order behaviour, many linkages in one call.

    python benchmarks/mapping.py

writes times and counts to benchmarks/results/mapping.json.
"""

from __future__ import annotations

import json
import platform
from collections.abc import Callable
from pathlib import Path
from statistics import median
from time import perf_counter

import numpy as np

from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from synth.linkages.conformed.behaviours import behaviour
from synth.linkages.conformed.rates import ConformedChain
from synth.linkages.fourbar.closing import can_close
from synth.linkages.surfaces.circuit import link_angles
from synth.linkages.surfaces.loop_maps import cone_reach, cylinder_reach
from synth.linkages.surfaces.loop_sums import circumradii, cone_angles, loop_roots

RUNS = 5
WATT = SCGraph(
    6, [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)], [Loop((0, 1, 2, 3)), Loop((3, 4, 5, 6))], ground=0
)


def timed(job: Callable[[], object]) -> float:
    """Return the median time of a job."""
    taken = []
    for _ in range(RUNS):
        start = perf_counter()
        job()
        taken.append(perf_counter() - start)
    return round(median(taken), 3)


def loops_on_cones(rng: np.random.Generator, count: int, links: int) -> np.ndarray:
    """Return link angles of loops that lie on a cone."""
    places, lam = rng.uniform(-np.pi, np.pi, (count, links)), rng.uniform(0.05, 1.4, (count, 1))
    return link_angles(np.roll(places, -1, axis=1) - places, lam)


def closing(rng: np.random.Generator, count: int, links: int) -> np.ndarray:
    """Return link angles of loops that close on the sphere, on a cone or not."""
    angles = rng.uniform(0.02, np.pi - 0.02, (8 * count, links))
    return angles[can_close(angles)][:count]


def main() -> None:
    """Time everything and store the figures."""
    rng = np.random.default_rng(8)
    figures: dict[str, object] = {"python": platform.python_version(), "numpy": np.__version__, "runs": RUNS}
    angles, lengths = rng.uniform(0.0, np.pi, (1_000_000, 4)), rng.uniform(0.0, 1.0, (1_000_000, 4))
    figures["closed form, 1 000 000 spherical four-bars, seconds"] = timed(lambda: cone_angles(angles))
    figures["closed form, 1 000 000 planar four-bars, seconds"] = timed(lambda: circumradii(lengths))
    for name, given, base in (
        ("loop sums, 10 000 six-bar loops on cones", cone_reach(loops_on_cones(rng, 10_000, 6)), 1),
        ("loop sums, 10 000 six-bar loops, any that close", cone_reach(closing(rng, 10_000, 6)), 1),
        ("loop sums, 10 000 planar six-bar loops", cylinder_reach(rng.uniform(0.5, 1.0, (10_000, 6))), 0),
        ("loop sums, 10 000 four-bars", cone_reach(loops_on_cones(rng, 10_000, 4)), 1),
        ("loop sums, 100 ten-bar loops", cone_reach(loops_on_cones(rng, 100, 10)), 1),
    ):
        figures[name] = {
            "seconds": timed(lambda given=given, base=base: loop_roots(given, base)),
            "circles": len(loop_roots(given, base).loop),
        }
    chain, places = ConformedChain.of(WATT), rng.uniform(-np.pi, np.pi, (100_000, 7))
    figures["first-order behaviour, 100 000 Watt linkages, seconds"] = timed(lambda: behaviour(chain, places))
    for name, value in figures.items():
        print(name, value, flush=True)
    (Path(__file__).parent / "results" / "mapping.json").write_text(json.dumps(figures, indent=2) + "\n")


if __name__ == "__main__":
    main()
