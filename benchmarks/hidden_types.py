"""Which type reproduces the motion of two links of a random member, given with noise.

    python benchmarks/hidden_types.py [--hidden N] [--from N] [--members N] [--fit N ...] [--third | --exact]
                                      [--workers N]

draws members of the chains of up to six links (their axes are random directions), takes the circuit of two links
that share no joint at 64 frames in unknown frames of reference, and turns each frame by errors of 1e-3 radians
about each axis. `synth atlas like --fit` finds the nearest members of an atlas and fits their axes: of 96 members,
and where none comes as near as the noise, of 1 000, then of 4 000. The first type, fewest links first, is one whose
circuit differs from the motion by no more than the noise; it is found if it has no more links than the hidden one.
With --third a third of each motion is given. With --exact there is no noise: fitted members are fitted further to 16
poses, and refined by the search of `synth design` (exact_motions.py), until one takes them to 1e-9 and the motion
between them is on its circuit; a motion that goes to and fro is an arc. Prints a line for each motion and writes a
file of benchmarks/results, with each miss.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from itertools import repeat
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any, NamedTuple

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from exact_motions import is_exact, one_way, refined
from scipy.spatial.transform import Rotation

from graphs.files.formats import mechanism_of_id
from graphs.geometry import unit
from graphs.types import Floats
from synth.analysis.members.circuits import MemberCircuits, circuits_of, product, relative
from synth.analysis.motion.closure import ClosureEquations, corrected
from synth.analysis.motion.linkage import linkage_of_axes
from synth.synthesis.atlas import AtlasPlan, add_motions, build_atlas, like, open_atlas
from synth.synthesis.atlas.atlas_file import Atlas
from synth.synthesis.atlas.signatures import MotionCurve

CHAINS = ("k1:Cr", "k1:E`hW", "k1:E@zO")
NOISE, FRAMES, MANY = 1e-3, 64, 256
"""Radians; frames of a motion with noise and without."""
WITHIN = 2.0 * np.sqrt(3.0) * NOISE
"""Root mean square of misses: errors of a pose and of the first one, about three axes, are sqrt(6) times the noise."""


class Hidden(NamedTuple):
    """A member: its chain, two links, and their motion with noise, unit quaternions float[64, 4]."""

    chain: str
    links: tuple[Any, Any]
    motion: Floats


def drawn(number: int, frames: int) -> tuple[str, MemberCircuits, np.random.Generator]:
    """Return the chain and the circuit of a member that closes, drawn by its number, and the generator it leaves."""
    random = np.random.default_rng([2026, number])
    code = CHAINS[number % len(CHAINS)]
    chain = mechanism_of_id(code)
    while True:
        traced = circuits_of(chain, random.normal(size=(1, len(chain.joints), 3)), frames=frames)
        if traced.closed[0]:
            return code, traced, random


def hidden(number: int, noise: float, frames: int) -> Hidden:
    """Return the motion of two links of a member, seen in frames of reference that are drawn too."""
    code, traced, random = drawn(number, frames)
    chain = mechanism_of_id(code)
    turned = _to_the_last_digit(traced).rotations()
    pairs = [(a, b) for a in chain for b in chain if a < b and not chain.has_edge(a, b)]
    first, second = pairs[number // len(CHAINS) % len(pairs)]
    motion = relative(turned[first], turned[second])[0]
    left, right = unit(random.normal(size=(2, 4)))
    moved = product(product(np.broadcast_to(left, motion.shape), motion), np.broadcast_to(right, motion.shape))
    errors = Rotation.from_rotvec(noise * random.normal(size=(frames, 3)))
    noisy = (errors * Rotation.from_quat(moved, scalar_first=True)).as_quat(scalar_first=True)
    return Hidden(code, (first, second), noisy)


def _to_the_last_digit(traced: MemberCircuits) -> MemberCircuits:
    """Return the circuit of a member with loops closed at each frame; between its steps it comes by a spline."""
    axes = dict(zip(traced.chain.joints, traced.axes[0].tolist(), strict=True))
    linkage = linkage_of_axes(traced.chain, {joint: (axis, axis) for joint, axis in axes.items()})
    closure = ClosureEquations(linkage)
    closed = [corrected(closure, linkage.angles + row).angles - linkage.angles for row in traced.angles[0]]
    return replace(traced, angles=np.array([closed]))


def answered(number: int, place: Path, options: argparse.Namespace) -> dict[str, Any]:
    """Return the row of a motion by its number."""
    one = hidden(number, 0.0, MANY) if options.exact else hidden(number, NOISE, FRAMES)
    return {"number": number, **answer(open_atlas(place), one, options)}


def answer(atlas: Atlas, one: Hidden, options: argparse.Namespace) -> dict[str, Any]:
    """Return the first type, fewest links first, that reproduces the motion, or a third of it."""
    begun = process_time()
    motion, closed, off = one.motion, not options.third, None
    if options.third:
        motion = motion[: FRAMES // 3 + 1]
    elif options.exact and (arc := one_way(motion)) is not None:
        motion, closed = arc, False
    curve = MotionCurve.of(motion, closed=closed)
    for fit in options.fit:
        near = like(atlas, curve, limit=fit, fit=fit).rows
        best: dict[str, float] = {}
        for row in near:
            best.setdefault(row.chain, row.distance)  # nearest first
        good = [code for code, off in best.items() if off <= WITHIN]
        good.sort(key=lambda code: len(mechanism_of_id(code)))
        if options.exact:
            for code in good:
                off = refined([row for row in near if row.chain == code and row.distance <= WITHIN], motion, curve)
                if is_exact(off):
                    break
            good = [code] if good and is_exact(off) else []
        if good:
            break
    first = min(good, key=lambda code: (len(mechanism_of_id(code)), code), default=None)
    return {
        "hidden": one.chain,
        "links": list(one.links),
        "length_deg": round(float(np.degrees(curve.length)), 1),
        "circuit": closed,
        "first": first,
        "found": first is not None and len(mechanism_of_id(first)) <= len(mechanism_of_id(one.chain)),
        "fit": fit,
        "fitted_deg": {code: round(float(np.degrees(angle)), 4) for code, angle in sorted(best.items())},
        "refined": off and [float(f"{one:.2e}") if np.isfinite(one) else None for one in off],
        "processor_seconds": round(process_time() - begun, 1),
    }


def main() -> None:
    """Hide members, look for them, print and write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--hidden", type=int, default=300)
    parser.add_argument("--members", type=int, default=5000)
    parser.add_argument("--from", type=int, default=0, dest="first")
    parser.add_argument("--fit", type=int, nargs="+", default=[96, 1000, 4000])
    parser.add_argument("--third", action="store_true", help="give a third of each motion")
    parser.add_argument("--exact", action="store_true", help="without noise; designs have to take poses to 1e-9")
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--atlas", type=Path, help="keep the atlas here")
    options = parser.parse_args()
    rows = []
    with TemporaryDirectory() as folder:
        place = options.atlas or Path(folder, "atlas.sqlite")
        if not place.exists():
            build_atlas(place, AtlasPlan(6, creases=0, orders_of=(), realised=False))
        add_motions(open_atlas(place), members=options.members)
        with ProcessPoolExecutor(options.workers) as pool:
            numbers = range(options.first, options.first + options.hidden)
            for row in pool.map(answered, numbers, repeat(place), repeat(options)):
                rows.append(row)
                print(json.dumps(row), flush=True)
    found = sum(row["found"] for row in rows)
    print(f"{found} of {len(rows)}")
    result = {
        "python": platform.python_version(),
        "members_of_each_chain": options.members,
        "hidden": len(rows),
        "found": found,
        "by_members_fitted": {str(fit): sum(row["found"] and row["fit"] == fit for row in rows) for fit in options.fit},
        "misses": [row for row in rows if not row["found"]],
        "processor_seconds": round(sum(row["processor_seconds"] for row in rows), 1),
        "median_seconds": float(np.median([row["processor_seconds"] for row in rows])),
    }
    kind = "_third" if options.third else "_exact" if options.exact else ""
    place = Path(__file__).with_name("results").joinpath(f"hidden_types{kind}.json")
    place.write_text(json.dumps(result, indent=2) + "\n")


if __name__ == "__main__":
    main()
