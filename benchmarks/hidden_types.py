"""Which type reproduces the motion of two links of a random member, given with noise.

    python benchmarks/hidden_types.py [--hidden N] [--members N] [--from N]

draws members of the chains of up to six links (their axes are random directions), takes the circuit of two links that
share no joint at 64 frames in unknown frames of reference, and turns each frame by errors of 1e-3 radians about each
axis. `synth atlas like` finds the nearest members of an atlas; the search of `synth design` refines them, fewest links
first, until one takes 16 poses to the noise and its own circuit differs from the motion by no more. Where the circuit
of the design is not the motion, or does not close, the whole circuit is fitted instead. It is found if that has no
more links than the hidden one. Prints a line for each and writes benchmarks/results/hidden_types.json, with each miss.
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
from synth.atlas.signatures import MotionCurve, _Around, angles_between, difference
from synth.designing.designs import DesignSearch
from synth.designing.search import found_from, seeded
from synth.designing.wishes import LinkOrientation, WishedConfiguration, Wishes
from synth.members.circuits import Circuits, circuits_of, product, relative, spherical_of

CHAINS = ("k1:Cr", "k1:E`hW", "k1:E@zO")
NOISE, FRAMES, POSES = 1e-3, 64, 16
WITHIN = 2.0 * np.sqrt(3.0) * NOISE
"""Root mean square of misses: errors of a pose and of the first one, about three axes, are sqrt(6) times the noise."""
TRIES = 4
"""Nearest members of each chain that are refined."""
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


def hidden(number: int) -> Hidden:
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
    errors = Rotation.from_rotvec(NOISE * random.normal(size=(FRAMES, 3)))
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
    own = MotionCurve.of(rows, closed=True)
    rounds = round(curve.length / own.length)  # a four-bar within a six-bar may go round more than once
    return off, float(difference(curve, own if rounds < 2 else MotionCurve.of(np.tile(rows, (rounds, 1)), closed=True)))


def led(near: NearMotion, curve: MotionCurve) -> float:
    """Return the difference from a motion to which axes of a member come whose whole circuit is fitted, radians.

    Levenberg and Marquardt's method for the angles between 24 places of the circuit, by two turns of each axis and by
    the place where it begins: so the motion is on one circuit that closes, while the search for poses may end
    at linkages that take them one by one.
    """
    circuit = _Circuit(near, curve)
    axes = np.array(list(near.axes.values()))
    begin, way = circuit.nearest(axes)
    off = circuit.misses(axes[None], np.array([begin]), way)[0]
    damping = 1e-2
    for _ in range(_STEPS):
        basis = _beside(axes)
        count = 2 * len(axes)
        tried = np.repeat(axes[None], count + 1, axis=0)
        tried[np.arange(count), np.arange(count) // 2] += _TURN * basis.reshape(count, 3)
        begins = np.full(count + 1, begin)
        begins[-1] += _TURN
        by = (circuit.misses(unit(tried), begins, way) - off).T / _TURN
        if not np.isfinite(by).all():
            break
        for _ in range(6):
            step = -np.linalg.solve(by.T @ by + damping * np.eye(count + 1), by.T @ off)
            moved = unit(axes + (step[:-1].reshape(-1, 2, 1) * basis).sum(axis=1))
            there = circuit.misses(moved[None], np.array([begin + step[-1]]), way)[0]
            if there @ there < off @ off:  # not if the circuit does not close: then it is infinite
                break
            damping *= 10.0
        else:
            break
        gained = 1.0 - (there @ there) / (off @ off)
        axes, begin, off, damping = moved, begin + float(step[-1]), there, damping / 10.0
        if gained < 1e-4:
            break
    return float(np.sqrt((off**2).mean()))


_STEPS, _TURN, _PLACES = 40, 1e-5, 24


def _beside(axes: Floats) -> Floats:
    """Return two unit vectors across each axis, float[J, 2, 3]."""
    other = np.where(np.abs(axes[:, :1]) < 0.6, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])
    first = unit(np.cross(axes, other))
    return np.stack([first, np.cross(axes, first)], axis=1)


class _Circuit:
    """The circuits of members of a chain, by angles between equidistant places, beside those of a motion."""

    def __init__(self, near: NearMotion, curve: MotionCurve) -> None:
        self.chain, self.links = mechanism_of_id(near.chain), near.links
        self.pairs = np.triu_indices(_PLACES, 1)
        self.wanted = self._angles(curve.at(curve.length * np.arange(_PLACES) / _PLACES)[None])[0]

    def _angles(self, rows: Floats) -> Floats:
        one, other = self.pairs
        return angles_between(rows[:, one], rows[:, other])

    def misses(self, axes: Floats, begins: Floats, way: float) -> Floats:
        """Return differences of angles, float[N, 276], infinite where a circuit does not close."""
        traced = circuits_of(self.chain, axes)
        turned = traced.rotations()
        rows = relative(turned[self.links[0]], turned[self.links[1]])
        off = np.full((len(axes), len(self.wanted)), np.inf)
        good = traced.closed
        if good.any():
            places = begins[good, None] + way * np.arange(_PLACES) / _PLACES
            off[good] = self._angles(_Around(rows[good]).at(places)) - self.wanted
        return off

    def nearest(self, axes: Floats) -> tuple[float, float]:
        """Return where a circuit begins and which way it goes where it is nearest to the motion."""
        shifts = np.arange(_SHIFTS) / _SHIFTS
        every = np.repeat(axes[None], _SHIFTS, axis=0)
        cost = [(self.misses(every, shifts, way) ** 2).sum(axis=1) for way in (1.0, -1.0)]
        way = int(cost[1].min() < cost[0].min())
        return float(shifts[int(cost[way].argmin())]), (1.0, -1.0)[way]


def answer(atlas: Atlas, one: Hidden) -> dict[str, Any]:
    """Return the first type, fewest links first, that reproduces the motion to the noise."""
    begun = process_time()
    curve = MotionCurve.of(one.motion, closed=True)
    poses = Poses.of(one.motion)
    near = like(atlas, curve, limit=32).rows
    tried: list[tuple[str, float, float]] = []
    first = None
    for code in sorted({row.chain for row in near}, key=lambda code: (len(mechanism_of_id(code)), code)):
        for row in [row for row in near if row.chain == code][:TRIES]:
            tried.append((code, *refined(row, poses, curve)))
            if max(tried[-1][1:]) > WITHIN:
                tried[-1] = (code, tried[-1][1], led(row, curve))
            if tried[-1][2] <= WITHIN:
                first = code
                break
        if first is not None:
            break
    links = len(mechanism_of_id(one.chain))
    return {
        "hidden": one.chain,
        "links": list(one.links),
        "length_deg": round(float(np.degrees(curve.length)), 1),
        "first": first,
        "found": first is not None and len(mechanism_of_id(first)) <= links,
        "nearest_deg": round(float(np.degrees(near[0].distance)), 3) if near else None,
        "refined": [[code, *(float(f"{one:.2e}") for one in off)] for code, *off in tried],
        "processor_seconds": round(process_time() - begun, 1),
    }


def main() -> None:
    """Hide members, look for them, print and write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--hidden", type=int, default=300)
    parser.add_argument("--members", type=int, default=2000)
    parser.add_argument("--from", type=int, default=0, dest="first")
    options = parser.parse_args()
    rows = []
    with TemporaryDirectory() as folder:
        place = Path(folder, "atlas.sqlite")
        build_atlas(place, AtlasPlan(6, creases=0, orders_of=(), realised=False))
        atlas = open_atlas(place)
        add_motions(atlas, members=options.members)
        for number in range(options.first, options.first + options.hidden):
            rows.append({"number": number, **answer(atlas, hidden(number))})
            print(json.dumps(rows[-1]), flush=True)
    found = sum(row["found"] for row in rows)
    print(f"{found} of {len(rows)}")
    result = {
        "python": platform.python_version(),
        "members_of_each_chain": options.members,
        "hidden": len(rows),
        "found": found,
        "misses": [row for row in rows if not row["found"]],
        "processor_seconds": round(sum(row["processor_seconds"] for row in rows), 1),
    }
    place = Path(__file__).with_name("results").joinpath("hidden_types.json")
    place.write_text(json.dumps(result, indent=2) + "\n")


if __name__ == "__main__":
    main()
