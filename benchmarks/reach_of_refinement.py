"""From how far the refinement of benchmarks/hidden_types.py returns to a hidden member: why some motions are missed.

    python benchmarks/reach_of_refinement.py [NUMBER ...]

turns each axis of a hidden member about a random direction by the same angle, refines the member that results as
`hidden_types.py --exact` refines a fitted one, and counts how often it takes the 16 poses to 1e-9 on one circuit. By
default for the motions that are missed. Writes benchmarks/results/reach_of_refinement.json.
"""

from __future__ import annotations

import argparse
import json
import platform
from pathlib import Path

import numpy as np
from exact_motions import is_exact, one_way, refined
from hidden_types import MANY, drawn, hidden
from scipy.spatial.transform import Rotation

from graphs.files.formats import mechanism_of_id
from graphs.geometry import unit
from synth.synthesis.atlas.motions import NearMotion
from synth.synthesis.atlas.signatures import MotionCurve

TURNS, TRIES = (0.3, 1.0, 3.0, 6.0), 12
"""Degrees; how often each is tried."""


def returned(number: int) -> dict[str, int]:
    """Return how often a member that is turned away is found again, by the angle in degrees."""
    one = hidden(number, 0.0, MANY)
    code, traced, _ = drawn(number, MANY)
    arc = one_way(one.motion)
    motion = one.motion if arc is None else arc
    curve = MotionCurve.of(motion, closed=arc is None)
    axes, joints = unit(traced.axes[0]), mechanism_of_id(code).joints
    random = np.random.default_rng(number)
    found = {}
    for angle in TURNS:
        found[str(angle)] = 0
        for _ in range(TRIES):
            turns = Rotation.from_rotvec(np.radians(angle) * unit(random.normal(size=axes.shape)))
            turned = {joint: tuple(axis) for joint, axis in zip(joints, turns.apply(axes).tolist(), strict=True)}
            near = NearMotion(0.0, code, None, (), one.links, turned, None)
            found[str(angle)] += is_exact(refined([near], motion, curve))
        print(number, angle, found[str(angle)], flush=True)
    return found


def main() -> None:
    """Turn axes, refine, and write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("number", type=int, nargs="*", default=[17, 41])
    result = {
        "python": platform.python_version(),
        "tries": TRIES,
        "found_by_degrees": {str(number): returned(number) for number in parser.parse_args().number},
    }
    place = Path(__file__).with_name("results").joinpath("reach_of_refinement.json")
    place.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
