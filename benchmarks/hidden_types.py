"""Which type reproduces the motion of two links of a random member, given with noise.

    python benchmarks/hidden_types.py [--hidden N] [--members N] [--from N] [--fit N ...] [--third | --exact]

draws members of the chains of up to six links (their axes are random directions), takes the circuit of two links
that share no joint at 64 frames in unknown frames of reference, and turns each frame by errors of 1e-3 radians
about each axis. `synth atlas like --fit` finds the nearest members of an atlas and fits their axes: of 96 members,
and where none comes as near as the noise, of 1 000, then of 4 000. The first type, fewest links first, is one whose
circuit differs from the motion by no more than the noise; it is found if it has no more links than the hidden one.
With --third a third of each motion is given. With --exact there is no noise: the search of `synth design` refines
the fitted members at 16 poses, and one is found that takes them to 1e-9 on one circuit. Prints a line for each
motion and writes a file of benchmarks/results, with each miss.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any, NamedTuple

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from scipy.spatial.transform import Rotation

from graphs.files.formats import mechanism_of_id
from graphs.geometry import unit
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from graphs.types import Floats
from synth.atlas import AtlasPlan, add_motions, build_atlas, like, open_atlas
from synth.atlas.motions import NearMotion
from synth.atlas.opened import Atlas
from synth.atlas.signatures import MotionCurve, angles_between, difference
from synth.designing.designs import DesignSearch
from synth.designing.search import found_from, seeded
from synth.designing.wishes import LinkOrientation, WishedConfiguration, Wishes
from synth.members.circuits import Circuits, circuits_of, product, relative, spherical_of

CHAINS = ("k1:Cr", "k1:E`hW", "k1:E@zO")
NOISE, FRAMES, POSES = 1e-3, 64, 16
WITHIN = 2.0 * np.sqrt(3.0) * NOISE
"""Root mean square of misses: errors of a pose and of the first one, about three axes, are sqrt(6) times the noise."""
TRIES, EXACT, ALONG = 4, 1e-9, 1e-4
"""Nearest members that are refined at poses, radians; what their circuits may differ by between the poses, where the
motion is known by a spline."""
_SHIFTS = 96


class Hidden(NamedTuple):
    """A member: its chain, two links, and their motion with noise, unit quaternions float[64, 4]."""

    chain: str
    links: tuple[Any, Any]
    motion: Floats


class Poses(NamedTuple):
    """Some frames of a motion: turns from the first one, and how far on the circuit they are, as parts of it."""

    turns: Rotation
    parts: Floats

    @classmethod
    def of(cls, motion: Floats) -> Poses:
        """Return every fourth frame."""
        along = np.cumsum(angles_between(motion, np.roll(motion, -1, axis=0)))
        rows = Rotation.from_quat(motion[:: FRAMES // POSES], scalar_first=True)
        parts = np.concatenate([[0.0], along[:-1]])[:: FRAMES // POSES] / along[-1]
        return cls(rows[1:] * rows[0].inv(), parts)


def hidden(number: int, noise: float) -> Hidden:
    """Return a member whose circuit closes, drawn by its number."""
    random = np.random.default_rng([2026, number])
    code = CHAINS[number % len(CHAINS)]
    chain = mechanism_of_id(code)
    while True:
        traced = circuits_of(chain, random.normal(size=(1, len(chain.joints), 3)), frames=FRAMES)
        if traced.closed[0]:
            break
    turned = traced.rotations()
    pairs = [(a, b) for a in chain for b in chain if a < b and not chain.has_edge(a, b)]
    first, second = pairs[number // len(CHAINS) % len(pairs)]
    motion = relative(turned[first], turned[second])[0]
    left, right = unit(random.normal(size=(2, 4)))
    moved = product(product(np.broadcast_to(left, motion.shape), motion), np.broadcast_to(right, motion.shape))
    errors = Rotation.from_rotvec(noise * random.normal(size=(FRAMES, 3)))
    noisy = (errors * Rotation.from_quat(moved, scalar_first=True)).as_quat(scalar_first=True)
    return Hidden(code, (first, second), noisy)


def placed(near: NearMotion, poses: Poses) -> HingedSolids:
    """Return a member of the atlas where its two links take poses best, in the frame of the first link.

    It begins anywhere on its circuit and goes either way: of all, the frame and the turn of all axes that fit best.
    """
    chain = spherical_of(mechanism_of_id(near.chain))
    traced = circuits_of(chain, np.array([list(near.axes.values())]), frames=512)
    if not traced.closed[0]:
        return near.linkage
    turned = {link: rows[0] for link, rows in traced.rotations().items()}
    motion = relative(turned[near.links[0]], turned[near.links[1]])
    steps = angles_between(motion, np.roll(motion, -1, axis=0))
    along = np.concatenate([[0.0], np.cumsum(steps)])
    best: tuple[float, int, Rotation] | None = None
    goals = poses.turns.as_rotvec()
    for begin in range(0, len(motion), len(motion) // _SHIFTS or 1):
        for way in (1.0, -1.0):
            at = np.remainder(along[begin] + way * poses.parts * along[-1], along[-1])
            frames = np.minimum(np.searchsorted(along, at), len(motion) - 1)
            rows = Rotation.from_quat(motion[frames], scalar_first=True)
            own = (rows[1:] * rows[0].inv()).as_rotvec()
            turn, off = Rotation.align_vectors(goals, own)
            if best is None or off < best[0]:
                best = (float(off), begin, turn)
    assert best is not None
    return _at(chain, traced, turned, near.links[0], best[1], best[2])


def _at(
    chain: SCGraph, traced: Circuits, turned: dict[Any, Floats], ground: Any, frame: int, turn: Rotation
) -> HingedSolids:
    """Return a linkage at a frame of its circuit, seen from one link, turned."""
    axes = {}
    for place, (joint, (one, _)) in enumerate(chain.joints.items()):
        body = relative(turned[ground][[frame]], turned[one][[frame]])
        direction = turn.apply(Rotation.from_quat(body[0], scalar_first=True).apply(traced.axes[0, place]))
        axes[joint] = ((0.0, 0.0, 0.0), tuple(direction.tolist()))
    return HingedSolids(chain, axes)


def refined(near: NearMotion, poses: Poses, curve: MotionCurve) -> tuple[float, float]:
    """Return what the design that begins with a member is off: misses of poses, and of its circuit, radians.

    Both are root mean squares, that of the circuit infinite where it does not close, or poses are missed.
    """
    names = [f"pose {number}" for number in range(2, POSES + 1)]
    wishes = Wishes(
        tuple(
            LinkOrientation(at=name, link=str(near.links[1]), quaternion=tuple(row))
            for name, row in zip(names, poses.turns.as_quat(scalar_first=True).tolist(), strict=True)
        ),
        tuple(WishedConfiguration(name) for name in names),
    )
    search = DesignSearch(placed(near, poses), wishes, ground=near.links[0])
    found = found_from(search.problem, search.family.start, seeded("hidden", 0))
    if found is None or found.error > 1e-9:
        return float("inf"), float("inf")
    off = float(np.sqrt((found.step.wishes.reshape(POSES - 1, 9) ** 2).sum(axis=1).mean()))
    linkage = found.step.design.linkage
    traced = circuits_of(mechanism_of_id(near.chain), linkage.directions[None], frames=256)
    if off > WITHIN or not traced.closed[0]:
        return off, float("inf")
    turned = traced.rotations()
    rows = relative(turned[near.links[0]], turned[near.links[1]])[0]
    if angles_between(rows, np.roll(rows, -1, axis=0)).max() < NOISE:
        return off, float("inf")  # the two links do not move
    own = MotionCurve.of(rows, closed=True)
    rounds = round(curve.length / own.length)  # a four-bar within a six-bar may go round more than once
    return off, float(difference(curve, own if rounds < 2 else MotionCurve.of(np.tile(rows, (rounds, 1)), closed=True)))


def answer(atlas: Atlas, one: Hidden, options: argparse.Namespace) -> dict[str, Any]:
    """Return the first type, fewest links first, that reproduces the motion, or a third of it."""
    begun = process_time()
    curve = MotionCurve.of(one.motion[: FRAMES // 3 + 1] if options.third else one.motion, closed=not options.third)
    first, off = None, None
    for fit in options.fit:
        near = like(atlas, curve, limit=fit, fit=fit).rows
        fitted: dict[str, float] = {}
        for row in near:
            fitted.setdefault(row.chain, row.distance)  # nearest first
        good = [row for row in near if row.distance <= WITHIN]
        if options.exact:
            poses = Poses.of(one.motion)
            refinements = ((row, refined(row, poses, curve)) for row in good[:TRIES])
            exact = next(((row, both) for row, both in refinements if both[0] <= EXACT and both[1] <= ALONG), None)
            good, off = ([exact[0]], exact[1]) if exact else ([], None)
        if good:
            first = min((row.chain for row in good), key=lambda code: (len(mechanism_of_id(code)), code))
            break
    return {
        "hidden": one.chain,
        "links": list(one.links),
        "length_deg": round(float(np.degrees(curve.length)), 1),
        "first": first,
        "found": first is not None and len(mechanism_of_id(first)) <= len(mechanism_of_id(one.chain)),
        "fit": fit,
        "fitted_deg": {code: round(float(np.degrees(angle)), 4) for code, angle in sorted(fitted.items())},
        "refined": off and [float(f"{one:.2e}") for one in off],
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
    parser.add_argument("--atlas", type=Path, help="keep the atlas here")
    options = parser.parse_args()
    rows = []
    with TemporaryDirectory() as folder:
        place = options.atlas or Path(folder, "atlas.sqlite")
        if not place.exists():
            build_atlas(place, AtlasPlan(6, creases=0, orders_of=(), realised=False))
        atlas = open_atlas(place)
        add_motions(atlas, members=options.members)
        for number in range(options.first, options.first + options.hidden):
            one = hidden(number, 0.0 if options.exact else NOISE)
            rows.append({"number": number, **answer(atlas, one, options)})
            print(json.dumps(rows[-1]), flush=True)
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
