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
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any, NamedTuple

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from graphs.files.formats import mechanism_of_id
from graphs.geometry import unit
from graphs.mechanism.solids import HingedSolids
from graphs.types import Floats
from synth.atlas import AtlasPlan, add_motions, build_atlas, like, open_atlas
from synth.atlas.motions import NearMotion
from synth.atlas.opened import Atlas
from synth.atlas.signatures import MotionCurve, angles_between, difference
from synth.designing.designs import DesignSearch
from synth.designing.problem import DesignStep
from synth.designing.wishes import LinkOrientation, WishedConfiguration, Wishes
from synth.members.circuits import Circuits, circuits_of, product, relative, spherical_of
from synth.motion.closure import ClosureEquations, corrected
from synth.motion.linkage import linkage_of_axes

CHAINS = ("k1:Cr", "k1:E`hW", "k1:E@zO")
NOISE, FRAMES, MANY, POSES = 1e-3, 64, 256, 16
"""Radians; frames of a motion with noise and without; poses of a design."""
WITHIN = 2.0 * np.sqrt(3.0) * NOISE
"""Root mean square of misses: errors of a pose and of the first one, about three axes, are sqrt(6) times the noise."""
TRIES, EXACT, ALONG = 8, 1e-9, 1e-4
"""Nearest members of each chain that are refined at poses; radians by which these may be missed, and by which circuits
may differ between them, where the motion is known by a spline."""
_LAST = 4.0 * np.finfo(float).eps


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
        """Return some frames, equally far apart."""
        step = len(motion) // POSES
        along = np.cumsum(angles_between(motion, np.roll(motion, -1, axis=0)))
        rows = Rotation.from_quat(motion[::step], scalar_first=True)
        parts = np.concatenate([[0.0], along[:-1]])[::step] / along[-1]
        return cls(rows[1:] * rows[0].inv(), parts)


def hidden(number: int, noise: float, frames: int) -> Hidden:
    """Return a member whose circuit closes, drawn by its number."""
    random = np.random.default_rng([2026, number])
    code = CHAINS[number % len(CHAINS)]
    chain = mechanism_of_id(code)
    while True:
        traced = circuits_of(chain, random.normal(size=(1, len(chain.joints), 3)), frames=frames)
        if traced.closed[0]:
            break
    turned = _to_the_last_digit(traced).rotations()
    pairs = [(a, b) for a in chain for b in chain if a < b and not chain.has_edge(a, b)]
    first, second = pairs[number // len(CHAINS) % len(pairs)]
    motion = relative(turned[first], turned[second])[0]
    left, right = unit(random.normal(size=(2, 4)))
    moved = product(product(np.broadcast_to(left, motion.shape), motion), np.broadcast_to(right, motion.shape))
    errors = Rotation.from_rotvec(noise * random.normal(size=(frames, 3)))
    noisy = (errors * Rotation.from_quat(moved, scalar_first=True)).as_quat(scalar_first=True)
    return Hidden(code, (first, second), noisy)


def _to_the_last_digit(traced: Circuits) -> Circuits:
    """Return the circuit of a member with loops closed at each frame; between its steps it comes by a spline."""
    axes = dict(zip(traced.chain.joints, traced.axes[0].tolist(), strict=True))
    linkage = linkage_of_axes(traced.chain, {joint: (axis, axis) for joint, axis in axes.items()})
    closure = ClosureEquations(linkage)
    closed = [corrected(closure, linkage.angles + row).angles - linkage.angles for row in traced.angles[0]]
    return replace(traced, angles=np.array([closed]))


class Placed(NamedTuple):
    """A member of the atlas that takes poses as well as it can, by their misses, seen from the first of two links.

    Angles, float[15, J], are those from the first pose.
    """

    off: float
    linkage: HingedSolids
    links: tuple[Any, Any]
    angles: Floats


def placed(near: NearMotion, poses: Poses) -> Placed:
    """Return a member where it takes poses best: it, its mirror image, or either with the two links exchanged.

    Angles between poses tell none of these from the others. The motion begins anywhere and goes either way.
    """
    axes = np.array(list(near.axes.values()))
    images = (axes, axes * [1.0, 1.0, -1.0])
    every = [_placed(near, one, pair, poses) for one in images for pair in (near.links, near.links[::-1])]
    return min(every, key=lambda one: one.off)


def _placed(near: NearMotion, axes: Floats, links: tuple[Any, Any], poses: Poses) -> Placed:
    chain = spherical_of(mechanism_of_id(near.chain))
    traced = circuits_of(chain, axes[None], frames=512)
    if not traced.closed[0]:
        return Placed(float("inf"), near.linkage, links, np.zeros((POSES - 1, len(axes))))
    turned = {link: rows[0] for link, rows in traced.rotations().items()}
    motion = relative(turned[links[0]], turned[links[1]])
    steps = angles_between(motion, np.roll(motion, -1, axis=0))
    along = np.concatenate([[0.0], np.cumsum(steps)])
    fits: list[tuple[float, Floats, Rotation]] = []
    for begin in range(len(motion)):
        for way in (1.0, -1.0):
            at = np.remainder(along[begin] + way * poses.parts * along[-1], along[-1])
            frames = np.minimum(np.searchsorted(along, at), len(motion) - 1)
            rows = Rotation.from_quat(motion[frames], scalar_first=True)
            turn, off = Rotation.align_vectors(_sines(poses.turns), _sines(rows[1:] * rows[0].inv()))
            fits.append((float(off), frames, turn))
    off, frames, turn = min(fits, key=lambda fit: fit[0])
    seen = {}
    for place, (joint, (one, _)) in enumerate(chain.joints.items()):
        body = relative(turned[links[0]][frames[:1]], turned[one][frames[:1]])
        direction = turn.apply(Rotation.from_quat(body[0], scalar_first=True).apply(traced.axes[0, place]))
        seen[joint] = ((0.0, 0.0, 0.0), tuple(direction.tolist()))
    return Placed(off, HingedSolids(chain, seen), links, traced.angles[0, frames[1:]] - traced.angles[0, frames[0]])


def _sines(turns: Rotation) -> Floats:
    """Return axes times sines of the angles: vectors that turn with the frame, smooth at half turns too."""
    rows = turns.as_quat(scalar_first=True)
    return np.asarray(2.0 * rows[:, :1] * rows[:, 1:])


def refined(near: NearMotion, poses: Poses, curve: MotionCurve) -> tuple[float, float]:
    """Return by how much a design that begins with a member misses poses, or opens its loops, and its circuit.

    The first is the most, the second a root mean square, infinite where the circuit does not close; in radians.
    """
    begun = placed(near, poses)
    first, second = begun.links
    names = [f"pose {number}" for number in range(2, POSES + 1)]
    wishes = Wishes(
        tuple(
            LinkOrientation(at=name, link=str(second), quaternion=tuple(row))
            for name, row in zip(names, poses.turns.as_quat(scalar_first=True).tolist(), strict=True)
        ),
        tuple(WishedConfiguration(name) for name in names),
    )
    problem = DesignSearch(begun.linkage, wishes, ground=first).problem

    def tried(unknowns: Floats) -> DesignStep:
        step = problem.tried(unknowns)
        assert step is not None  # a chain always is a mechanism
        return step

    found = least_squares(
        lambda unknowns: tried(unknowns).residual(1.0),
        problem.joined(problem.family.start, list(problem.zero + begun.angles)),
        lambda unknowns: tried(unknowns).jacobian(1.0),
        xtol=_LAST, ftol=_LAST, gtol=_LAST, max_nfev=300,
    )  # fmt: skip
    step = tried(found.x)
    off = float(np.abs(np.concatenate([step.closure, step.wishes])).max())
    traced = circuits_of(mechanism_of_id(near.chain), step.design.linkage.directions[None], frames=256)
    if off > WITHIN or not traced.closed[0]:
        return off, float("inf")
    turned = traced.rotations()
    rows = relative(turned[first], turned[second])[0]
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
        good = sorted((row for row in near if row.distance <= WITHIN), key=lambda row: len(mechanism_of_id(row.chain)))
        if options.exact:
            poses = Poses.of(one.motion)
            some = [row for code in CHAINS for row in [row for row in good if row.chain == code][:TRIES]]
            refinements = ((row, refined(row, poses, curve)) for row in some)
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
            one = hidden(number, 0.0, MANY) if options.exact else hidden(number, NOISE, FRAMES)
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
