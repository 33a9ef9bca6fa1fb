"""Along the circuit of a linkage on a surface: how far a driving joint goes, and on which side of it links are.

A link lies over the shortest arc of the surface that has its joints. Theory: docs/theory/moving.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from math import ceil, cos, inf, sin, tau

import numpy as np

from graphs.tolerances import DOUBLE
from graphs.types import Flags, Floats, LinkId
from synth.conformed.behaviours import Way, link_arcs
from synth.conformed.linkages import OnSurface
from synth.conformed.rates import ConformedChain
from synth.motion.closure import ClosureEquations
from synth.motion.linkage import PosedLinkage
from synth.motion.newton import Corrected
from synth.motion.path import Path
from synth.motion.placement import link_motions
from synth.motion.walk.circuits import circuit_through
from synth.motion.walk.events import TurningPoint
from synth.motion.walk.step import Step
from synth.motion.walk.walking import Event, Walk

__all__ = ["ROUND", "Course", "Position", "Sense", "Stretch", "SurfaceLinks", "positions_of"]

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
        """The side of the surface that all moving links keep to from the beginning, and up to which turn."""
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
        On which side of the surface each link is.
    """

    at: float
    angles: Floats
    direct: bool
    ways: dict[LinkId, Way]


class SurfaceLinks:
    """The links of a linkage as arcs on its surface."""

    def __init__(self, on_surface: OnSurface, chain: ConformedChain, linkage: PosedLinkage) -> None:
        assert on_surface.surface is not None
        self.names, self.linkage, self._surface = chain.links, linkage, on_surface.surface
        places = np.asarray(on_surface.places, dtype=float)
        self._arcs = link_arcs(chain, places, on_surface.begins(chain))

    def ways(self, angles: Floats) -> dict[LinkId, Way]:
        """Return where each link lies at joint angles float[J]."""
        return dict(zip(self.names, map(_way, self.beyond(angles[None])[0]), strict=True))

    def beyond(self, angles: Floats) -> Flags:
        """Return whether links have points inside and outside of the surface at float[F, J]: bool[F, N, 2]."""
        return np.asarray(self.spans(angles) * [-1.0, 1.0] > 0.0)

    def motions(self, angles: Floats) -> dict[LinkId, tuple[Floats, Floats]]:
        """Return how links have moved from the surface: rotations float[F, 3, 3], shifts float[F, 3]."""
        extent, middle = self.linkage.extent, self.linkage.middle
        return {
            link: (turn, extent * shift + middle - turn @ middle)
            for link, (turn, shift) in link_motions(self.linkage, angles, self.names[0]).items()
        }

    def spans(self, angles: Floats) -> Floats:
        """Return how far links lie outside the surface, at least and at most: float[F, N, 2].

        What is rounding is taken off. Lengths are in units of the distance from the apex, or of the radius.
        """
        motions = self.motions(angles)
        spans = np.empty((len(angles), len(self.names), 2))
        for number, (link, (begin, length)) in enumerate(zip(self.names, self._arcs, strict=True)):
            p, q, off = self._surface.outward(*motions[link])
            low, high = _extremes(p, q, float(begin), float(length))
            spans[:, number] = np.stack([low + off + DOUBLE.same_point, high + off - DOUBLE.same_point], axis=1)
        return spans


@dataclass(frozen=True, eq=False)
class Crossing:
    """A piece of a walk on which a link comes to lie inside or outside of the surface, or ceases to.

    Where on it is found when it is asked for: the circuit goes on past the turning points of the driving joint.

    Attributes
    ----------
    links : SurfaceLinks
    driver : int
        Place of the driving joint.
    frame : int
        Number of the circuit's configuration before it.
    piece : Step
    link : int
    sides : list of int
        What changes: inside (0), outside (1), or both.
    """

    links: SurfaceLinks
    driver: int
    frame: int
    piece: Step
    link: int
    sides: list[int]

    @cached_property
    def turns(self) -> list[tuple[float, int]]:
        """The turn of the driving joint at which each side changes, radians, in the order of the walk."""
        places = sorted((self._zero(side), side) for side in self.sides)
        return [(float(self.piece.at(part).angles[self.driver]), side) for part, side in places]

    def _zero(self, side: int) -> float:
        def span(place: Corrected) -> float:
            return float(self.links.spans(place.angles[None])[0, self.link, side])

        part = self.piece.zero(span)
        assert part is not None, "a side that changes has a zero"
        return part


class SidesOfSurface(Event):
    """Links leave a side of the surface, or come to lie on it.

    Attributes
    ----------
    begun, now : bool[N, 2]
        Whether links are inside and outside soon after the start, and in the end.
    crossings : list of Crossing
    """

    def __init__(self, links: SurfaceLinks, driver: int) -> None:
        self._links, self._driver = links, driver
        self.begun = self.now = np.zeros((len(links.names), 2), dtype=bool)
        self.crossings: list[Crossing] = []

    def after(self, walk: Walk, step: Step) -> None:
        """Look at both halves of a step. Where the circuit is closed all links lie in the surface again."""
        parts = (0.5,) if walk.ended else (0.5, 1.0)
        beyond = self._links.beyond(np.array([step.at(part).angles for part in parts]))
        if len(walk.frames) == 1:
            self.begun = self.now = beyond[0]
        for part, now in zip(parts, beyond, strict=True):
            changed = now != self.now
            if changed.any():
                self._cross(len(walk.frames) - 1, step.piece(part - 0.5, part), changed)
            self.now = now

    def _cross(self, frame: int, piece: Step, changed: Flags) -> None:
        for link in np.flatnonzero(changed.any(axis=1)).tolist():
            sides = np.flatnonzero(changed[link]).tolist()
            self.crossings.append(Crossing(self._links, self._driver, frame, piece, link, sides))


class Turns(Event):
    """The driving joint has given turns, whole ones aside.

    Attributes
    ----------
    places : list of (int, float, float[J])
        Number of the circuit's configuration before, the turn, joint angles.
    """

    def __init__(self, driver: int, turns: Sequence[float]) -> None:
        self._driver, self._turns = driver, turns
        self.places: list[tuple[int, float, Floats]] = []

    def after(self, walk: Walk, step: Step) -> None:
        """Land on them, and go on from the end of the step; beside a dead point on what is near."""
        low, high = sorted(float(end.angles[self._driver]) for end in (step.before, step.after))
        for turn in self._turns:
            value = turn + tau * ceil((low - turn) / tau)
            if value <= high:
                place = step.landing(self._driver, value)
                if place is None:
                    place = step.at(step.zero(partial(self._beyond, value)) or 0.0)
                self.places.append((len(walk.frames) - 1, turn, place.angles))

    def _beyond(self, value: float, place: Corrected) -> float:
        return float(place.angles[self._driver] - value)


@dataclass(frozen=True, slots=True)
class Course:
    """One way along the circuit from the conformed position, with what is met: see the events above.

    Of a closed circuit passed back ``whole`` is the turn of the driving joint all the way round; crossings are
    those of the way forward, with the numbers of their configurations there.
    """

    circuit: Path
    begun: Flags
    now: Flags
    crossings: list[Crossing]
    places: list[tuple[int, float, Floats]]
    whole: float | None = None

    @classmethod
    def along(
        cls, closure: ClosureEquations, links: SurfaceLinks, towards: Floats, turns: Sequence[float], driver: int
    ) -> Course:
        """Return the course that begins towards some rates."""
        sides, at = SidesOfSurface(links, driver), Turns(driver, turns)
        circuit = circuit_through(closure, links.linkage.angles, towards, [TurningPoint(driver), sides, at])
        return cls(circuit, sides.begun, sides.now, sides.crossings, at.places)

    @property
    def last(self) -> int:
        """Number of the configuration at which the driving joint first turns back, or of the last one."""
        return next(iter(self.circuit.turning), len(self.circuit.angles) - 1)

    def reversed(self, driver: int) -> Course:
        """Return a closed circuit passed the other way, from the same configuration."""
        circuit, count = self.circuit, len(self.circuit.angles)
        whole = circuit.angles[-1] - circuit.angles[0]
        events = tuple(
            replace(event, frame=count - 1 - event.frame)
            for event in circuit.events
            if event.kind == "turning point"
        )[::-1]
        back = replace(circuit, angles=circuit.angles[::-1] - whole, events=events)
        return Course(back, self.now, self.begun, self.crossings, [], float(whole[driver]))

    def sense(self, links: SurfaceLinks, driver: int) -> Sense:
        """Return what happens until the driving joint turns back, or comes round."""
        ends = BACK if self.circuit.turning else self.circuit.stopped or ROUND
        limit = float(self.circuit.angles[self.last, driver])
        ways = {name: self._stretches(link, limit) for link, name in enumerate(links.names)}
        return Sense(limit, ends, ways)

    def _stretches(self, link: int, limit: float) -> tuple[Stretch, ...]:
        """Return the ways of a link one after the other, each with the turn at which it ends."""
        here, stretches = self.begun[link].copy(), []
        for turn, side in self._leaves(link):
            stretches.append(Stretch(_way(here), turn))
            here[side] = not here[side]
        every = [*stretches, Stretch(_way(here), limit)]
        starts = [0.0, *(each.end for each in every)]
        return tuple(
            each
            for each, start in zip(every, starts, strict=False)
            if abs(each.end - start) > DOUBLE.same_configuration
        )

    def _leaves(self, link: int) -> list[tuple[float, int]]:
        """Return the turns at which a link begins or ceases to be on a side, up to where the driver turns back."""
        here = [each for each in self.crossings if each.link == link]
        if self.whole is None:
            return [leaves for each in here if each.frame < self.last for leaves in each.turns]
        first = len(self.circuit.angles) - 1 - self.last
        back = [leaves for each in here if each.frame >= first for leaves in each.turns]
        return [(turn - self.whole, side) for turn, side in reversed(back)]


def positions_of(behind: Course, ahead: Course, links: SurfaceLinks, turns: Sequence[float]) -> list[Position]:
    """Return the positions at some turns of the driving joint, whole turns aside."""
    back = len(ahead.circuit.angles) - 1 - behind.last if not ahead.circuit.stopped else inf
    places = [(turn, angles, frame < behind.last) for frame, turn, angles in behind.places]
    places += [(turn, angles, frame < ahead.last or frame >= back) for frame, turn, angles in ahead.places]
    kept: list[Position] = []
    for turn in turns:
        begun = len(kept)
        for at, angles, direct in places:
            if at == turn and not any(_same(angles, other.angles) for other in kept[begun:]):
                kept.append(Position(turn, angles, direct, links.ways(angles)))
    return kept


def _way(beyond: Flags) -> Way:
    """Return the way of a link that is inside the surface, outside, both or neither: bool[2]."""
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
    return bool(np.abs(gap - tau * np.rint(gap / tau)).max() <= DOUBLE.same_configuration)
