"""Members that take the motion of two links exactly: fitted to poses on their circuits, then refined by design.

A member of an atlas that was fitted by angles may be 1e-4 radians from poses that it takes to 1e-7 by angles, where
the motion hardly leaves one axis; and a design that begins there, with its joint angles free at each pose, tends to
linkages with two freedoms (two pairs of equal axes), which take any poses. So axes are changed first while the motion
stays on the circuit, which closes with one freedom; what this finds is refined, and checked, as a design.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import chain, islice
from typing import Any, NamedTuple

import numpy as np
from scipy.interpolate import make_interp_spline
from scipy.optimize import least_squares, minimize_scalar
from scipy.spatial.transform import Rotation

from graphs.files.formats import mechanism_of_id
from graphs.mechanism.solids import HingedSolids
from graphs.types import Floats
from synth.analysis.members.circuits import MemberCircuits, across, circuits_of, relative, spherical_of
from synth.synthesis.atlas.motions import NearMotion
from synth.synthesis.atlas.signatures import MotionCurve, angles_between, difference
from synth.synthesis.designing.designs import DesignSearch
from synth.synthesis.designing.problem import DesignStep
from synth.synthesis.designing.wishes import LinkOrientation, WishedConfiguration, Wishes

EXACT, ALONG, POSES = 1e-9, 1e-4, 16
"""Radians by which poses may be missed, and by which circuits may differ between them, where the motion is known by a
spline; number of poses."""
_AS_PLACED, _STAGES = 8, ((24, 30), (8, 100), (3, 600))
"""How many fits of a chain, the nearest, are refined as they are; how many, the best, are continued by how many
evaluations."""
_THERE, _NUDGE, _FINE, _BEYOND = 1e-5, 1e-6, 512, 8
"""Miss below which a fit is refined as a design (splines of sharp motions are 4e-7 off or more); step of differences;
frames of a circuit, and those beyond its ends by which it is continued for a spline."""
_LAST = 4.0 * np.finfo(float).eps
"""End of a refinement, relative."""


class Poses(NamedTuple):
    """Some frames of a motion: turns from the first one, and how far along the motion they are, radians."""

    turns: Rotation
    along: Floats

    @classmethod
    def of(cls, motion: Floats) -> Poses:
        """Return some frames, equally far apart."""
        step = len(motion) // POSES
        along = np.concatenate([[0.0], np.cumsum(angles_between(motion[:-1], motion[1:]))])
        return cls(_from_first(motion[::step][:POSES]), along[::step][:POSES])


def one_way(motion: Floats) -> Floats | None:
    """Return the frames of a circuit from one end to the other if it goes to and fro; None if it goes round.

    Such a motion is an arc of any circuit that goes further.
    """
    curve = MotionCurve.of(motion, closed=True)
    apart = curve.length / 2.0 * np.linspace(0.0, 1.0, 60)

    def miss(turning: float) -> float:
        return float(angles_between(curve.at(turning + apart), curve.at(turning - apart)).max())

    gap = curve.length / 800
    turning = min(gap * np.arange(400), key=miss)
    found = minimize_scalar(miss, bounds=(turning - gap, turning + gap), method="bounded", options={"xatol": EXACT})
    if found.fun > ALONG:
        return None
    steps = angles_between(motion, np.roll(motion, -1, axis=0))
    along = np.concatenate([[0.0], np.cumsum(steps[:-1])]) * curve.length / steps.sum()
    order = np.argsort(np.remainder(along - found.x, curve.length), kind="stable")
    return np.asarray(motion[order[: int((np.remainder(along - found.x, curve.length) < curve.length / 2.0).sum())]])


class Course(NamedTuple):
    """The circuit of a member, and where on it two of its links take poses: places float[16], in frames.

    The poses are those from the first one, turned by `turn`; `off` is the root mean square of misses, radians.
    """

    traced: MemberCircuits
    links: tuple[Any, Any]
    places: Floats
    turn: Rotation
    off: float

    @classmethod
    def of(cls, near: NearMotion, poses: Poses) -> Course:
        """Return where a member takes poses best: it, its mirror image, or either with the two links exchanged.

        Angles between poses tell none of these from the others. The motion begins anywhere and goes either way.
        """
        linkage, axes = spherical_of(mechanism_of_id(near.chain)), np.array(list(near.axes.values()))
        images = [circuits_of(linkage, [image], frames=_FINE) for image in (axes, axes * [1.0, 1.0, -1.0])]
        every = [
            _of_frames(traced, pair, poses)
            for traced in images
            if traced.closed[0]
            for pair in (near.links, near.links[::-1])
        ]
        return min(every, key=lambda one: one.off).fitted(poses, most=30, axes=False)

    def configurations(self) -> MemberCircuits:
        """Return the configurations at the places, between frames by a quintic spline."""
        angles = self.traced.angles[0]
        count = len(angles)
        wound = 2.0 * np.pi * np.round((2.0 * angles[-1] - angles[-2]) / (2.0 * np.pi))
        knots = np.arange(-_BEYOND, count + _BEYOND)
        spline = make_interp_spline(knots, angles[knots % count] + (knots // count)[:, None] * wound, k=5)
        rows = spline(np.remainder(self.places, count)) + np.floor(self.places / count)[:, None] * wound
        return replace(self.traced, angles=rows[None])

    def misses(self, poses: Poses) -> Floats:
        """Return rotation vectors by which poses are missed, float[15 * 3]; a circuit that is not closed misses far."""
        if not self.traced.closed[0]:
            return np.full(3 * (POSES - 1), np.pi)
        turned = self.configurations().rotations()
        rows = relative(turned[self.links[0]][0], turned[self.links[1]][0])
        missed = poses.turns.inv() * self.turn * _from_first(rows) * self.turn.inv()
        return np.asarray(missed.as_rotvec().ravel())

    def fitted(self, poses: Poses, *, most: int, axes: bool = True) -> Course:
        """Change places and turn, and axes, until poses are missed least, by some evaluations at most."""
        held = np.zeros(0 if axes else self.traced.axes[0].size // 3 * 2)
        start = np.concatenate([np.zeros(self.traced.axes[0].size // 3 * 2 - len(held)), self.places, np.zeros(3)])

        def there(rows: Floats) -> list[Course]:
            return self._moved(np.hstack([np.broadcast_to(held, (len(rows), len(held))), rows]))

        def slopes(unknowns: Floats) -> Floats:
            rows = np.vstack([unknowns, unknowns + _NUDGE * np.eye(len(unknowns))])
            misses = np.array([one.misses(poses) for one in there(rows)])
            return np.asarray((misses[1:] - misses[0]).T / _NUDGE)

        found = least_squares(
            lambda unknowns: there(unknowns[None])[0].misses(poses), start, slopes,
            x_scale="jac", xtol=_LAST, ftol=1e-6, gtol=_LAST, max_nfev=most,
        )  # fmt: skip
        return there(found.x[None])[0]._replace(off=float(np.sqrt((found.fun**2).mean())))

    def _moved(self, unknowns: Floats) -> list[Course]:
        """Return courses by rows of unknowns: two turns of each axis, 16 places, a rotation vector."""
        axes = self.traced.axes[0]
        turns = unknowns[:, : 2 * len(axes)].reshape(len(unknowns), -1, 2, 1)
        vectors = (turns * across(axes)).sum(axis=2).reshape(-1, 3)
        moved = Rotation.from_rotvec(vectors).apply(np.tile(axes, (len(unknowns), 1))).reshape(-1, *axes.shape)
        traced = circuits_of(self.traced.chain, moved, frames=_FINE)
        return [
            self._replace(
                traced=replace(traced, axes=traced.axes[[k]], angles=traced.angles[[k]], closed=traced.closed[[k]]),
                places=row[2 * len(axes) : -3],
                turn=Rotation.from_rotvec(row[-3:]) * self.turn,
            )
            for k, row in enumerate(unknowns)
        ]

    def linkage(self) -> tuple[HingedSolids, Floats]:
        """Return the linkage at the first pose, seen from the first link, and joint angles from there, float[15, J]."""
        there, linkage = self.configurations(), self.traced.chain
        turned = there.rotations()
        seen = {}
        for place, (joint, (one, _)) in enumerate(linkage.joints.items()):
            body = relative(turned[self.links[0]][0, :1], turned[one][0, :1])
            direction = self.turn.apply(Rotation.from_quat(body[0], scalar_first=True).apply(there.axes[0, place]))
            seen[joint] = ((0.0, 0.0, 0.0), tuple(direction.tolist()))
        return HingedSolids(linkage, seen), there.angles[0, 1:] - there.angles[0, 0]


def _of_frames(traced: MemberCircuits, links: tuple[Any, Any], poses: Poses) -> Course:
    """Return the frame with which poses begin, and the way, that miss them least."""
    turned = {link: rows[0] for link, rows in traced.rotations().items()}
    motion = relative(turned[links[0]], turned[links[1]])
    steps = angles_between(motion, np.roll(motion, -1, axis=0))
    along = np.concatenate([[0.0], np.cumsum(steps)])
    fits = []
    for begin in range(len(motion)):
        for way in (1.0, -1.0):
            at = along[begin] + way * poses.along
            rounds = np.floor(at / along[-1])
            places = np.interp(at - rounds * along[-1], along, np.arange(len(along))) + rounds * len(motion)
            rows = motion[np.round(places).astype(int) % len(motion)]
            turn, off = Rotation.align_vectors(_sines(poses.turns), _sines(_from_first(rows)))
            fits.append(Course(traced, links, places, turn, float(off)))
    return min(fits, key=lambda fit: fit.off)


def _from_first(rows: Floats) -> Rotation:
    """Return rotations from the first one to the others."""
    turns = Rotation.from_quat(rows, scalar_first=True)
    return turns[1:] * turns[0].inv()


def _sines(turns: Rotation) -> Floats:
    """Return axes times sines of the angles: vectors that turn with the frame, smooth at half turns too."""
    rows = turns.as_quat(scalar_first=True)
    return np.asarray(2.0 * rows[:, :1] * rows[:, 1:])


def _part(off: tuple[float, float]) -> float:
    """Return the worse of both misses in parts of what they may be: poses alone are taken by any two freedoms."""
    return max(off[0] / EXACT, off[1] / ALONG)


def is_exact(off: tuple[float, float] | None) -> bool:
    """Whether poses are taken, and the motion between them is on the circuit."""
    return off is not None and _part(off) <= 1.0


def refined(rows: Sequence[NearMotion], motion: Floats, curve: MotionCurve) -> tuple[float, float]:
    """Return by how much the best design that begins with members of a chain misses poses, or its loops, and a circuit.

    The first is the most, the second a root mean square, infinite where the circuit does not close; in radians. The
    motion is a circuit, or the arc of the curve.
    """
    poses = Poses.of(motion)
    apart = {f"{row.distance:.2e}": row for row in reversed(rows)}  # equal ones are one linkage found again
    nearest = sorted(apart.values(), key=lambda row: row.distance)[: _STAGES[0][0]]
    best = (float("inf"), float("inf"))
    ended: list[tuple[tuple[float, float], Course]] = []
    placed: list[Course] = []
    for row in nearest[:_AS_PLACED]:
        placed.append(Course.of(row, poses))
        best = min(best, _designed(placed[-1], poses, curve, most=300), key=_part)
        if is_exact(best):
            return best
    begun: Iterable[Course] = chain(placed, (Course.of(row, poses) for row in nearest[_AS_PLACED:]))
    for kept, evaluations in _STAGES:
        courses = []
        for one in islice(begun, kept):
            courses.append(one.fitted(poses, most=evaluations))
            if courses[-1].off <= _THERE:
                ended.append((_designed(courses[-1], poses, curve, most=300), courses[-1]))
                best = min(best, ended[-1][0], key=_part)
                if is_exact(best):
                    return best
        begun = sorted(courses, key=lambda one: one.off)
    nearly = sorted((pair for pair in ended if pair[0][0] > EXACT), key=lambda pair: pair[0])[:3]
    further = (_designed(one, poses, curve, most=5000) for _, one in nearly)
    return next(filter(is_exact, further), best)


def _designed(course: Course, poses: Poses, curve: MotionCurve, *, most: int) -> tuple[float, float]:
    """Return by how much the design misses poses, and its circuit the motion, that begins with a fit."""
    begun, angles = course.linkage()
    first, second = course.links
    names = [f"pose {number}" for number in range(2, POSES + 1)]
    wishes = Wishes(
        tuple(
            LinkOrientation(at=name, link=str(second), quaternion=tuple(row))
            for name, row in zip(names, poses.turns.as_quat(scalar_first=True).tolist(), strict=True)
        ),
        tuple(WishedConfiguration(name) for name in names),
    )
    problem = DesignSearch(begun, wishes, ground=first).problem

    def tried(unknowns: Floats) -> DesignStep:
        step = problem.tried(unknowns)
        assert step is not None  # a chain always is a mechanism
        return step

    found = least_squares(
        lambda unknowns: tried(unknowns).residual(1.0),
        problem.joined(problem.family.start, list(problem.zero + angles)),
        lambda unknowns: tried(unknowns).jacobian(1.0),
        xtol=_LAST, ftol=_LAST, gtol=_LAST, max_nfev=most,
    )  # fmt: skip
    step = tried(found.x)
    off = float(np.abs(np.concatenate([step.closure, step.wishes])).max())
    traced = circuits_of(course.traced.chain, step.design.linkage.directions[None], frames=256)
    if not traced.closed[0]:
        return off, float("inf")
    turned = traced.rotations()
    rows = relative(turned[first], turned[second])[0]
    own = MotionCurve.of(rows, closed=True)
    rounds = round(curve.length / own.length)  # a four-bar within a six-bar may go round more than once
    if curve.closed and rounds > 1:
        own = MotionCurve.of(np.tile(rows, (rounds, 1)), closed=True)
    return off, float(difference(curve, own))
