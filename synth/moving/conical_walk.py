"""Along the circuit of a linkage on a cone: how far a driving joint goes, and on which side of the cone links are.

A link lies over the shortest arc of the cone that has its joints. Theory: docs/theory/moving.md.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from math import cos, sin, tau

import numpy as np

from graphs.arrays import Flags, Floats
from graphs.ids import LinkId
from synth.conformed.behaviours import Way, link_arcs
from synth.conformed.linkages import OnCone
from synth.conformed.rates import ConformedChain
from synth.motion.closure import ClosureEquations
from synth.motion.linkage import PosedLinkage
from synth.motion.newton import Corrected, corrected
from synth.motion.placement import link_motions
from synth.moving.circuits import Circuit, place_between

__all__ = ["BACK", "ROUND", "ConicalWalk", "Position", "Sense", "Stretch"]

_OFF = 1e-9
"""Points of links that are this near to the cone, in units of their distance from the apex, lie in it."""
_SAME, _EXACT = 1e-7, 1e-13
_SHORT = 1e-6
"""A link that passes through the cone lies in it for less than this turn of the driving joint."""
BACK, ROUND = "turns back", "turns all round"
"""Why a driving joint goes no further."""


@dataclass(frozen=True, slots=True)
class Stretch:
    """A way that a link keeps, up to a turn of the driving joint from the conformed position, radians."""

    way: Way
    end: float


@dataclass(frozen=True, slots=True)
class Sense:
    """What happens while the driving joint turns one way from the conformed position.

    Attributes
    ----------
    limit : float
        How far it comes, radians, negative where it turns backward.
    ends : str
        Why no further: ``turns back``, ``turns all round`` (the pose is the conformed one again), or why the
        curve could not be followed.
    ways : mapping of link to tuple of Stretch
        Where each link lies all along, one stretch after the other.
    """

    limit: float
    ends: str
    ways: dict[LinkId, tuple[Stretch, ...]]

    @property
    def one_way(self) -> tuple[Way, float] | None:
        """The side of the cone that all moving links keep to from the beginning, and up to which turn."""
        moving = [each for each in self.ways.values() if each[0].way != Way.STILL]
        begin = {each[0].way for each in moving}
        if len(begin) != 1 or not begin <= {Way.INWARD, Way.OUTWARD}:
            return None
        return begin.pop(), min((each[0].end for each in moving), key=abs)


@dataclass(frozen=True, slots=True)
class Position:
    """A position at a given turn of the driving joint.

    Attributes
    ----------
    at : float
        The turn from the conformed position, radians.
    angles : float[J]
        Of all joints from there, radians.
    direct : bool
        Whether the driving joint comes there without turning back on the way.
    ways : mapping of link to Way
        On which side of the cone each link is.
    """

    at: float
    angles: Floats
    direct: bool
    ways: dict[LinkId, Way]


class ConicalWalk:
    """What is looked at along the circuit of one linkage."""

    def __init__(
        self, on_cone: OnCone, chain: ConformedChain, linkage: PosedLinkage, closure: ClosureEquations, driver: int
    ) -> None:
        assert on_cone.cone_angle is not None
        self._chain, self._linkage, self._closure, self._driver = chain, linkage, closure, driver
        self._tilt = on_cone.cone_angle
        self._arcs = link_arcs(chain, np.asarray(on_cone.places, dtype=float))

    def with_turning_points(self, circuit: Circuit) -> Circuit:
        """Return a circuit with the poses where the driving joint turns back among its own."""
        angles, rates = list(circuit.angles), list(circuit.rates)
        onwards = circuit.rates[:, self._driver] > 0.0
        for number in np.flatnonzero(onwards[:-1] != onwards[1:])[::-1].tolist():
            there = place_between(self._closure, circuit, number, partial(self._speed, circuit.rates[number]))
            angles.insert(number + 1, there)
            rates.insert(number + 1, (rates[number] + rates[number + 1]) / 2.0)
        return replace(circuit, angles=np.array(angles), rates=np.array(rates))

    def sense(self, circuit: Circuit, sign: float) -> Sense:
        """Return what happens until the driving joint turns back, or comes round."""
        last = self._last(circuit, sign)
        whole = last == len(circuit.angles) - 1
        ends = (circuit.stopped or ROUND) if whole else BACK
        seen = circuit.angles[1 : last + (0 if whole and circuit.closed else 1)]
        limit = float(circuit.angles[last, self._driver])
        spans = self._spans(seen)
        ways = {
            link: self._stretches(circuit, number, spans[:, number], limit)
            for number, link in enumerate(self._chain.links)
        }
        return Sense(limit, ends, ways)

    def positions(self, behind: Circuit, ahead: Circuit, turn: float) -> list[Position]:
        """Return the positions at a turn of the driving joint, whole turns aside."""
        found = self._crossings(ahead, turn, self._last(ahead, 1.0))
        if ahead.closed:
            back = len(ahead.angles) - 1 - self._last(behind, -1.0)
            found = [(number, pose, direct or number >= back) for number, pose, direct in found]
        else:
            found = [*self._crossings(behind, turn, self._last(behind, -1.0)), *found]
        kept: list[Position] = []
        for _, pose, direct in found:
            if not any(_same(pose, other.angles) for other in kept):
                ways = dict(zip(self._chain.links, map(_way, self._spans(pose[None])[0]), strict=True))
                kept.append(Position(turn, pose, direct, ways))
        return kept

    def _last(self, circuit: Circuit, sign: float) -> int:
        """Return the number of the pose at which the driving joint first turns back, or the last."""
        onwards = sign * np.diff(circuit.angles[:, self._driver]) > 0.0
        return len(onwards) if onwards.all() else int(onwards.argmin())

    def _crossings(self, circuit: Circuit, turn: float, last: int) -> list[tuple[int, Floats, bool]]:
        """Return where the driving joint has a turn: number of the pose before, pose, whether before the last."""
        turns = circuit.angles[:, self._driver]
        low, high = np.minimum(turns[:-1], turns[1:]), np.maximum(turns[:-1], turns[1:])
        wanted = turn + tau * np.ceil((low - turn) / tau)
        found = []
        for number in np.flatnonzero(wanted <= high).tolist():
            goal = float(wanted[number])
            near = place_between(self._closure, circuit, number, partial(self._beyond, goal))
            there = self._held(near, goal)
            found.append((number, there, number < last))
        return found

    def _held(self, near: Floats, turn: float) -> Floats:
        """Return the pose at which the driving joint has just a turn; beside a dead point the one that is near."""
        start = near.copy()
        start[self._driver] = turn
        pose = corrected(self._closure, start, [self._driver])
        if not pose.closed or abs(pose.angles[self._driver] - turn) > _EXACT:
            return near
        pose.angles[self._driver] = turn
        return pose.angles

    def _speed(self, onwards: Floats, pose: Corrected) -> float:
        return float(pose.space.projected(onwards)[self._driver])

    def _beyond(self, turn: float, pose: Corrected) -> float:
        return float(pose.angles[self._driver] - turn)

    def _span(self, link: int, side: int, pose: Corrected) -> float:
        return float(self._spans(pose.angles[None])[0, link, side])

    def _spans(self, angles: Floats) -> Floats:
        """Return how far links lie outside the cone, at least and at most: float[F, N, 2], less what is rounding.

        A point of a link at azimuth t lies at y = p cos t + q sin t + c, the cone itself at y = -sin(lambda).
        """
        motions = link_motions(self._linkage, angles, self._chain.links[0])
        spans = np.empty((len(angles), len(self._chain.links), 2))
        for number, (link, (begin, length)) in enumerate(zip(self._chain.links, self._arcs, strict=True)):
            row = motions[link][0][:, 1]
            p, q = cos(self._tilt) * row[:, 2], cos(self._tilt) * row[:, 0]
            off = sin(self._tilt) * (1.0 - row[:, 1])
            low, high = _extremes(p, q, float(begin), float(length))
            spans[:, number] = np.stack([low + off + _OFF, high + off - _OFF], axis=1)
        return spans

    def _stretches(self, circuit: Circuit, link: int, spans: Floats, limit: float) -> tuple[Stretch, ...]:
        """Return the ways of a link one after the other, each with the turn at which it ends.

        Its spans float[F, 2] are those from the second pose of the circuit on.
        """
        beyond = spans * [-1.0, 1.0] > 0.0
        stretches = []
        for number in np.flatnonzero((beyond[1:] != beyond[:-1]).any(axis=1)).tolist():
            here = beyond[number].copy()
            for turn, side in self._leaves(circuit, number + 1, link, beyond[number + 1] != here):
                stretches.append(Stretch(_way_of(here), turn))
                here[side] = not here[side]
        every = [*stretches, Stretch(_way_of(beyond[-1]), limit)]
        starts = [0.0, *(each.end for each in every)]
        return tuple(each for each, start in zip(every, starts, strict=False) if abs(each.end - start) > _SHORT)

    def _leaves(self, circuit: Circuit, number: int, link: int, sides: Flags) -> list[tuple[float, int]]:
        """Return where, after a pose, a link begins or ceases to be inside (0) or outside (1) of the cone."""
        found = []
        for side in np.flatnonzero(sides).tolist():
            there = place_between(self._closure, circuit, number, partial(self._span, link, side))
            found.append((float(there[self._driver]), side))
        return sorted(found, key=lambda each: abs(each[0]))


def _way(span: Floats) -> Way:
    return _way_of(span * [-1.0, 1.0] > 0.0)


def _way_of(beyond: Flags) -> Way:
    """Return the way of a link that is inside the cone, outside, both or neither: bool[2]."""
    inside, outside = beyond.tolist()
    return Way.BOTH if inside and outside else Way(int(outside) - int(inside))


def _extremes(p: Floats, q: Floats, begin: float, length: float) -> tuple[Floats, Floats]:
    """Return the least and greatest p cos t + q sin t over an arc."""
    size, top = np.hypot(p, q), np.arctan2(q, p)
    ends = p * cos(begin) + q * sin(begin), p * cos(begin + length) + q * sin(begin + length)
    high = np.where(np.remainder(top - begin, tau) < length, size, np.maximum(*ends))
    low = np.where(np.remainder(top + np.pi - begin, tau) < length, -size, np.minimum(*ends))
    return low, high


def _same(one: Floats, other: Floats) -> bool:
    gap = one - other
    return bool(np.abs(gap - tau * np.rint(gap / tau)).max() <= _SAME)
