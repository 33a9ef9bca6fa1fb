"""Motion of linkages on cones and cylinders from the conformed position: range, behaviour of links, circuits.

To first order `synth.linkages.conformed.behaviours` says how links behave; here they are followed all along the
circuit: how far a driving joint goes, and on which side of it links are. A link lies over the shortest arc of the
surface that has its joints. Theory: docs/theory/moving.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property, partial
from math import ceil, degrees, inf, isfinite, tau
from typing import Any

import numpy as np

from graphs.edit.named import known, link_named
from graphs.errors import InvariantError, numbered, shown
from graphs.mechanism.surfaces import Cylinder, Surface, surface_json
from graphs.printing import Block, TableBlock, plain
from graphs.tolerances import DOUBLE, signed
from graphs.types import Flags, Floats, JointId, LinkId
from synth.analysis.motion.closure import ClosureEquations, Corrected
from synth.analysis.motion.configuration import Configuration
from synth.analysis.motion.driven_motion import DrivenMotion
from synth.analysis.motion.linkage import Linkage, link_motions
from synth.analysis.motion.motion import Motion, motion_along
from synth.analysis.motion.path import Path, circuit_through
from synth.analysis.motion.singular.second_order import rates_at
from synth.analysis.motion.walk.events import TurningPoint
from synth.analysis.motion.walk.step import Step
from synth.analysis.motion.walk.walking import Event, Walk
from synth.analysis.moving._configuration_of import configuration_of
from synth.analysis.moving.arcs import heights_about, heights_over
from synth.analysis.moving.senses import BACK, ROUND, Sense, Stretch, range_line, sense_json, stretches_text
from synth.linkages.conformed.behaviours import Way, link_arcs
from synth.linkages.conformed.linkage_behaviour import OnSurface, one_on_surface
from synth.linkages.conformed.orders import SurfaceLike
from synth.linkages.conformed.rates import ConformedChain


@dataclass(frozen=True, slots=True)
class Position:
    """A configuration at a turn of the driving joint from the conformed position.

    `at` and the angles of all joints, float[J], count from there, radians; `direct`: the driving joint comes there
    without turning back on the way; `ways` has the side of the surface on which each link is.
    """

    at: float
    angles: Floats
    direct: bool
    ways: dict[LinkId, Way]


class SurfaceLinks:
    """The links of a linkage as arcs on its surface."""

    def __init__(self, on_surface: OnSurface, chain: ConformedChain, linkage: Linkage) -> None:
        assert on_surface.surface is not None
        self.names, self.linkage, self._surface = chain.links, linkage, on_surface.surface
        places = np.asarray(on_surface.places, dtype=float)
        self._arcs = link_arcs(chain, places, on_surface.begins(chain))
        fixed = [sorted(set(joints).intersection(chain.joints_of[0])) for joints in chain.joints_of]
        self._pivots = [None if len(joints) != 1 else float(places[joints[0]]) for joints in fixed]

    def ways(self, angles: Floats) -> dict[LinkId, Way]:
        """Return where each link lies at joint angles float[J]."""
        return dict(zip(self.names, map(_way, self.beyond(angles[None])[0]), strict=True))

    def beyond(self, angles: Floats) -> Flags:
        """Return whether links have points inside and outside of the surface at float[F, J]: bool[F, N, 2]."""
        return np.asarray(self.spans(angles) * [-1.0, 1.0] > 0.0)

    def motions(self, angles: Floats) -> dict[LinkId, tuple[Floats, Floats]]:
        """Return how links have moved from the surface: rotations float[F, 3, 3], shifts float[F, 3]."""
        extent, middle = self.linkage.extent, self.linkage.middle
        moved = link_motions(self.linkage, angles, self.names[0])
        return {link: (turn, extent * shift + middle - turn @ middle) for link, (turn, shift) in moved.items()}

    def spans(self, angles: Floats, rounding: float = DOUBLE.same_point) -> Floats:
        """Return how far links lie outside the surface, least and most, less rounding: float[F, N, 2].

        For a link that turns about a joint of the fixed link: how far in proportion to the distance from there.
        """
        motions = self.motions(angles)
        spans = np.empty((len(angles), len(self.names), 2))
        for number, (link, (begin, length)) in enumerate(zip(self.names, self._arcs, strict=True)):
            p, q, off = self._surface.outward(*motions[link])
            pivot = self._pivots[number]
            if pivot is None:
                low, high = heights_over(p, q, float(begin), float(length))
            else:
                low, high = heights_about(pivot, p, q, float(begin), float(length))
                off = np.zeros_like(off)
            spans[:, number] = np.stack([low + off + rounding, high + off - rounding], axis=1)
        return spans


@dataclass(frozen=True, eq=False)
class Crossing:
    """A piece of a walk, after configuration `frame`, on which a link changes `sides`: inside (0), outside (1)."""

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
        # a side counts from beyond the rounding on, but where it changes is where the height itself is zero; one
        # that only touches zero has no such place, and that of the rounding is taken
        for rounding in (0.0, DOUBLE.same_point):
            part = self.piece.zero(partial(self._height, side, rounding))
            if part is not None:
                return part
        raise AssertionError("a side that changes has a zero")

    def _height(self, side: int, rounding: float, place: Corrected) -> float:
        return float(self.links.spans(place.angles[None], rounding)[0, self.link, side])


class SidesOfSurface(Event):
    """Links leave a side of the surface, or come to lie on it: bool[N, 2] soon after the start, and `now`."""

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
                frame, piece = len(walk.frames) - 1, step.piece(part - 0.5, part)
                for link in np.flatnonzero(changed.any(axis=1)).tolist():
                    sides = np.flatnonzero(changed[link]).tolist()
                    self.crossings.append(Crossing(self._links, self._driver, frame, piece, link, sides))
            self.now = now


class TurnsPassed(Event):
    """The driving joint has one of some turns: `places` are the configuration before, the turn, joint angles."""

    def __init__(self, driver: int, turns: Sequence[float]) -> None:
        self._driver, self._turns = driver, turns
        self.places: list[tuple[int, float, Floats]] = []

    def after(self, walk: Walk, step: Step) -> None:
        """Land on the turns, and go on from the end of the step; beside a dead point on what is near."""
        low, high = sorted(float(end.angles[self._driver]) for end in (step.before, step.after))
        for turn in self._turns:
            value = turn + tau * ceil((low - turn) / tau)
            if value <= high:
                place = step.landing(self._driver, value)
                if place is None:
                    place = step.at(step.zero(partial(self._past, value)) or 0.0)
                self.places.append((len(walk.frames) - 1, turn, place.angles))

    def _past(self, value: float, place: Corrected) -> float:
        return float(place.angles[self._driver] - value)


@dataclass(frozen=True, slots=True)
class Course:
    """One sense of the circuit from the conformed position, with its events.

    Of a closed circuit passed backward `whole` is the turn of the driving joint all the way round; crossings are
    those of the forward sense, with the numbers of their configurations there.
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
        sides, at = SidesOfSurface(links, driver), TurnsPassed(driver, turns)
        circuit = circuit_through(
            closure, links.linkage.angles, towards=towards, events=[TurningPoint(driver), sides, at]
        )
        return cls(circuit, sides.begun, sides.now, sides.crossings, at.places)

    @property
    def last(self) -> int:
        """Number of the configuration at which the driving joint first turns back, or of the last one."""
        return next(iter(self.circuit.turning), len(self.circuit.angles) - 1)

    def reversed(self, driver: int) -> Course:
        """Return a closed circuit passed the other way, from the same configuration."""
        circuit, count = self.circuit, len(self.circuit.angles)
        whole = circuit.angles[-1] - circuit.angles[0]
        turning = [event for event in reversed(circuit.events) if event.kind == "turning point"]
        events = tuple(replace(event, frame=count - 1 - event.frame) for event in turning)
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
        lengths = [abs(each.end - start) for each, start in zip(every, starts, strict=False)]
        least = DOUBLE.same_configuration
        return tuple(each for each, length in zip(every, lengths, strict=True) if length > least)

    def _leaves(self, link: int) -> list[tuple[float, int]]:
        """Return the turns at which a link comes to a side or leaves it, up to where the driver turns back."""
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


def _same(one: Floats, other: Floats) -> bool:
    gap = one - other
    return bool(np.abs(gap - tau * np.rint(gap / tau)).max() <= DOUBLE.same_configuration)


@dataclass(frozen=True, slots=True)
class LinkPoint:
    """A point of a link, where it lies at the conformed position.

    Attributes
    ----------
    link : link id
    azimuth : float
        Angle of its ruling line, radians.
    along : float, optional
        Distance along the ruling line: from the apex of a cone; on a cylinder from the plane of the circle.

    Examples
    --------
    >>> LinkPoint(2, 0.5).along
    1.0
    """

    link: LinkId
    azimuth: float
    along: float = 1.0


@dataclass(frozen=True, slots=True)
class InstantAxis:
    """The axis about which a link turns against another, at a configuration.

    Attributes
    ----------
    first, second : link id
    direction : float[3] or None
        Unit vector: of linkages on cones through the apex. None where the links do not turn against each other, or
        where the rates are not unique: at a configuration with more freedoms to first order.
    point : float[3] or None
        On it, in the plane of the circle, for cylinders: the instant centre. None where it is at infinity.

    Examples
    --------
    >>> from synth.linkages.conformed.linkage_behaviour import loop_on_cones
    >>> motion = move_on_surface(loop_on_cones(np.radians([120, 95, 45, 85]))[0], at=[0.0])
    >>> motion.instant_axes(1, 3)[0].point.tolist()
    [0.0, 0.0, 0.0]
    """

    first: LinkId
    second: LinkId
    direction: Floats | None
    point: Floats | None

    def to_json(self) -> dict[str, Any]:
        """Return the axis as plain data."""
        vectors = {"direction": self.direction, "point": self.point}
        plain_vectors = {name: None if vector is None else vector.tolist() for name, vector in vectors.items()}
        return {"links": [self.first, self.second], **plain_vectors}


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class SurfaceMotion(Motion):
    """A linkage of one freedom on its cone or cylinder, moved from the conformed position.

    Its path is the circuit: all configurations that can be reached, the driving joint beginning forward.

    Attributes
    ----------
    on_surface : OnSurface
    chain : ConformedChain
        Its first link is fixed.
    driver : joint id
    backward, forward : Sense
    positions : tuple of Position
        Configurations at the input angles.
    points : tuple of LinkPoint
        Points that are located at the positions.
    axes : tuple of (link, link)
        Pairs of links whose instant axes are computed at the positions.
    """

    on_surface: OnSurface
    chain: ConformedChain
    driver: JointId
    backward: Sense
    forward: Sense
    positions: tuple[Position, ...]
    points: tuple[LinkPoint, ...] = ()
    axes: tuple[tuple[LinkId, LinkId], ...] = ()

    def places_of(self, point: LinkPoint) -> Floats:
        """Return where a point of a link is at the positions: float[P, 3] (Hyatt et al. 2020, Eqs. 19, 21, 23).

        The frame is that of `graphs.mechanism.surfaces`: the y axis along the axis of the surface, the first link
        fixed.

        Examples
        --------
        >>> from synth.linkages.conformed.linkage_behaviour import loop_on_cones
        >>> motion = move_on_surface(loop_on_cones(np.radians([120, 95, 45, 85]))[0], driver="2", at=[0.0, 0.05])
        >>> motion.places_of(LinkPoint("2", 2.5)).shape
        (4, 3)
        """
        surface = self.on_surface.surface
        assert surface is not None, "a linkage is moved from its surface"
        link = link_named(self.on_surface.chain, str(point.link))
        angles = np.array([each.angles for each in self.positions]).reshape(-1, len(self.joints))
        turn, shift = self._links.motions(angles)[link]
        return np.asarray(turn @ surface.place(point.azimuth, point.along, 0.0) + shift)

    def instant_axes(self, first: LinkId, second: LinkId) -> tuple[InstantAxis, ...]:
        """Return the instant axis of two links at each position, by the rates of the joints there."""
        names = [link_named(self.on_surface.chain, str(link)) for link in (first, second)]
        places = [self.chain.links.index(name) for name in names]
        return tuple(InstantAxis(names[0], names[1], *self._axis(each.angles, *places)) for each in self.positions)

    @cached_property
    def _links(self) -> SurfaceLinks:
        return SurfaceLinks(self.on_surface, self.chain, self.configuration.linkage)

    def _axis(self, angles: Floats, first: int, second: int) -> tuple[Floats | None, Floats | None]:
        """Return direction and point of the axis of two links, by their numbers in the chain."""
        closure, linkage = self.configuration.closure, self.configuration.linkage
        rates = rates_at(closure, angles)
        if rates.shape[1] != 1:
            return None, None
        moved = self._links.motions(angles[None])
        links = list(zip(self.chain.links, self.chain.joints_of, strict=True))
        points = linkage.points * linkage.extent + linkage.middle
        spin, speed = np.zeros(3), np.zeros(3)
        for joint, share in enumerate((self.chain.paths[second] - self.chain.paths[first]).tolist()):
            if share:
                carrier = next(link for link, own in links if joint in own)
                turn, shift = (motion[0] for motion in moved[carrier])
                axis = share * rates[joint, 0] * (turn @ linkage.directions[joint])
                spin, speed = spin + axis, speed + np.cross(turn @ points[joint] + shift, axis)
        size = float(np.linalg.norm(spin))
        if size <= self.configuration.tolerances.zero_rate:
            return None, None
        along = signed(spin / size)
        on_cylinder = isinstance(self.on_surface.surface, Cylinder)
        return along, np.cross(spin, speed) / size**2 if on_cylinder else np.zeros(3)

    @property
    def closed(self) -> bool:
        """Whether the circuit comes back to where it began."""
        return not self.path.stopped

    @property
    def turns_fully(self) -> bool:
        """Whether the driving joint turns all round."""
        return self.forward.ends == ROUND

    @property
    def meets(self) -> list[float]:
        """Turns of the driving joint at which another circuit meets this one: the linkage may go on either way."""
        place = self.joints.index(self.driver)
        return [float(angles[place]) for angles in self.path.meets]

    @property
    def turns(self) -> dict[JointId, int]:
        """How often each joint turns round while the circuit is passed once; of one that is not closed, none."""
        if not self.closed:
            return {}
        whole = np.rint((self.path.angles[-1] - self.path.angles[0]) / tau).astype(int).tolist()
        return dict(zip(self.joints, whole, strict=True))

    def blocks(self) -> list[Block]:
        """Return the lines and tables that are printed."""
        rows = [
            (plain(link), stretches_text(self.backward.ways[link]), stretches_text(self.forward.ways[link]))
            for link in self.chain.links[1:]
        ]
        ground, driver = plain(self.chain.links[0]), plain(self.driver)
        return [
            f"{self.on_surface.surface}, link {ground} fixed, joint {driver} driven",
            range_line(self.backward, self.forward),
            _circuit(self),
            TableBlock(("link", "backward", "forward"), rows),
            *(_positions(self) if self.positions else []),
            *(_places(self) if self.positions and self.points else []),
            *(_axes(self) if self.positions and self.axes else []),
        ]

    def __repr__(self) -> str:
        return f"<SurfaceMotion: {self.linkage!r}, joint {self.driver!r} driven>"

    def to_json(self) -> dict[str, Any]:
        """Return the motion as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        joints = list(map(str, self.joints))
        return {
            **super().to_json(),
            **surface_json(self.on_surface.surface),
            "ground": self.chain.links[0],
            "driver": str(self.driver),
            "range_deg": [degrees(self.backward.limit), degrees(self.forward.limit)],
            "turns_fully": self.turns_fully,
            "backward": sense_json(self.backward),
            "forward": sense_json(self.forward),
            "closed": self.closed,
            "turns": {str(joint): turns for joint, turns in self.turns.items()},
            "meets_deg": list(map(degrees, self.meets)),
            "positions": [
                {
                    "at_deg": degrees(each.at),
                    "joint_angles_deg": dict(zip(joints, np.degrees(each.angles).tolist(), strict=True)),
                    "direct": each.direct,
                    "ways": {str(link): way.name.lower() for link, way in each.ways.items()},
                    "points": [
                        {"link": one.link, "azimuth_deg": degrees(one.azimuth), "along": one.along, "place": place}
                        for one, place in zip(self.points, places, strict=True)
                    ],
                    "instant_axes": [axis.to_json() for axis in axes],
                }
                for each, places, axes in self._located
            ],
        }

    @cached_property
    def _located(self) -> list[tuple[Position, list[list[float]], list[InstantAxis]]]:
        """Each position with the places of all points, and all instant axes."""
        places = [self.places_of(point).tolist() for point in self.points]
        axes = [self.instant_axes(*pair) for pair in self.axes]
        numbered_positions = enumerate(self.positions)
        return [(each, [row[n] for row in places], [row[n] for row in axes]) for n, each in numbered_positions]


def move_on_surface(
    mechanism: OnSurface | SurfaceLike,
    ground: LinkId | None = None,
    driver: JointId | None = None,
    at: Sequence[float] = (),
    *,
    points: Sequence[LinkPoint] = (),
    axes: Sequence[tuple[LinkId, LinkId]] = (),
    surface: Surface | None = None,
) -> SurfaceMotion:
    """Move a linkage on a cone or a cylinder, of any number of loops and one freedom, from its conformed position.

    Parameters
    ----------
    mechanism : SurfaceLinkage, str, Path, dict, or the result of `realise_on_cone`
        On one surface: by its steps, or by link angles or lengths; a file of it; a row of `conical_candidates`, with
        `surface`. An OnSurface of `synth.linkages.conformed`, too.
    ground : link id, optional
        The fixed link: by default the chain's own, or the first.
    driver : joint id, optional
        By default the first joint of the fixed link that moves.
    at : sequence of float, optional
        Input angles, from the conformed position, radians: all positions of the circuit there are listed.
    points : sequence of LinkPoint, optional
        Points of links to locate at the positions.
    axes : sequence of (link id, link id), optional
        Pairs of links whose instant axes to compute at the positions.
    surface : Cone or Cylinder, optional
        For a linkage by its steps, and a row: the surface that it lies on, by default its own. For one by link angles
        or lengths: which of several surfaces.

    Raises
    ------
    ArgumentError
        If it is no linkage on a surface.
    UnsolvableError
        If the surface is not known, or it is one of several, or the linkage has not just one freedom at the
        conformed position.
    InvariantError
        If the driver is no joint or does not move, a turn is not finite, or a link is none.

    Examples
    --------
    >>> from synth.linkages.conformed.linkage_behaviour import loop_on_cones
    >>> motion = move_on_surface(loop_on_cones(np.radians([120, 95, 45, 85]))[0])
    >>> motion.turns_fully, motion.closed, motion.driver
    (False, True, '1')
    >>> [round(degrees(sense.limit), 3) for sense in (motion.backward, motion.forward)]
    [-103.923, 5.655]

    A row of `conical_candidates` is laid on a cone, and moves there:

    >>> from synth.synthesis.candidates.listing import conical_candidates
    >>> from synth.catalogue.realisation.on_cone import realise_on_cone
    >>> row = next(conical_candidates("k1:Cr", slots=7))
    >>> move_on_surface(realise_on_cone(row)).closed
    True
    """
    on_surface = one_on_surface("move_on_surface", mechanism, surface)
    chain, configuration = ConformedChain.of(on_surface.chain, ground), configuration_of(on_surface)
    linkage, closure = configuration.linkage, configuration.closure
    place = _driver(configuration, chain, driver)
    for turn in at:
        if not isfinite(turn):
            raise InvariantError("turn", f"the input angle is {turn}", "a finite angle")
    for link in (*(point.link for point in points), *(link for pair in axes for link in pair)):
        link_named(on_surface.chain, str(link))
    links = SurfaceLinks(on_surface, chain, linkage)
    towards = np.eye(1, closure.joints, place)[0]
    ahead = Course.along(closure, links, towards, at, place)
    closed = not ahead.circuit.stopped
    behind = ahead.reversed(place) if closed else Course.along(closure, links, -towards, at, place)
    along = motion_along(configuration, DrivenMotion(None, [place], {}, ahead.circuit))
    return SurfaceMotion(
        **{part.name: getattr(along, part.name) for part in fields(Motion)},
        on_surface=on_surface,
        chain=chain,
        driver=configuration.joints[place],
        backward=behind.sense(links, place),
        forward=ahead.sense(links, place),
        positions=tuple(positions_of(behind, ahead, links, at)),
        points=tuple(points),
        axes=tuple(axes),
    )


def _driver(configuration: Configuration, chain: ConformedChain, driver: JointId | None) -> int:
    joints = configuration.joints
    if driver is not None and driver not in joints:
        raise InvariantError("driver", f"{shown(driver)} is no joint", known(joints, str(driver)))
    rates = np.abs(rates_at(configuration.closure, configuration.linkage.angles)).max(axis=1, initial=0.0)
    moving = rates > configuration.tolerances.zero_rate * rates.max(initial=0.0)
    possible = list(chain.joints_of[0]) if driver is None else [joints.index(driver)]
    drivers = [joint for joint in possible if moving[joint]]
    if not drivers:
        names = ", ".join(shown(joints[joint]) for joint in possible)
        raise InvariantError("driver", f"joint {names} is immobile at the conformed position", "one that moves")
    return drivers[0]


def _circuit(motion: SurfaceMotion) -> str:
    if not motion.closed:
        return f"circuit not traced to its end: {motion.path.stopped}"
    turning = [f"joint {plain(joint)} {turns:+d}" for joint, turns in motion.turns.items() if turns]
    turns = ", ".join(turning) or "none"
    line = f"circuit closed, loop-closure residual {motion.closure:.1e}; whole turns: {turns}"
    if motion.meets:
        line += "; another circuit meets it at " + ", ".join(f"{degrees(turn):.6g}°" for turn in motion.meets)
    return line


def _positions(motion: SurfaceMotion) -> list[Block]:
    place = motion.joints.index(motion.driver)  # whose angle is the input
    heads = ("at", *(f"joint {joint}" for joint in motion.joints if joint != motion.driver), "without turning back")
    rows = []
    for each in motion.positions:
        others = np.delete(each.angles, place)
        angles = [f"{0.0 if abs(turn) < DOUBLE.same_configuration else degrees(turn):.8g}" for turn in others]
        rows.append((f"{degrees(each.at):g}", *angles, "yes" if each.direct else "no"))
    inputs = {each.at for each in motion.positions}
    reached = f"{numbered(len(rows), 'configuration')} at {numbered(len(inputs), 'input angle')} within the range"
    return [TableBlock(heads, rows, ["at"]), reached]


def _places(motion: SurfaceMotion) -> list[Block]:
    rows = [
        (f"{degrees(each.at):g}", plain(one.link), f"{degrees(one.azimuth):g}", f"{one.along:g}", *_numbers(place))
        for each, places, _ in motion._located
        for one, place in zip(motion.points, places, strict=True)
    ]
    numbers = ["at", "azimuth (deg)", "along", "x", "y", "z"]
    return ["points of links", TableBlock(("at", "link", *numbers[1:]), rows, numbers)]


def _axes(motion: SurfaceMotion) -> list[Block]:
    on_cylinder = isinstance(motion.on_surface.surface, Cylinder)
    rows = []
    for each, _, axes in motion._located:
        for axis in axes:
            vector = axis.point if on_cylinder else axis.direction
            cells = ["none"] * 3 if vector is None else _numbers(vector.tolist())
            rows.append((f"{degrees(each.at):g}", plain(axis.first), plain(axis.second), *cells))
    what = "instant centres, through which axes along y pass" if on_cylinder else "instant axes, through the apex"
    return [what, TableBlock(("at", "link", "and", "x", "y", "z"), rows, ["at", "x", "y", "z"])]


def _numbers(place: Sequence[float]) -> list[str]:
    return [f"{round(value, 12) + 0.0:.8g}" for value in place]
