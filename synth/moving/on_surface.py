"""Motion of linkages on cones and cylinders from the conformed position: range, ways of links, circuits.

To first order the ways are told by `synth.conformed.behaviours`; here links are looked at all along.
Theory: docs/theory/moving.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from math import degrees, isfinite, tau
from typing import Any

import numpy as np

from graphs.edit.named import known, link_named
from graphs.errors import InvariantError, numbered, shown
from graphs.mechanism.surfaces import Cylinder, surface_json
from graphs.printing import Block, TableBlock, plain
from graphs.tolerances import signed
from graphs.types import Floats, JointId, LinkId
from synth.conformed.linkages import OnSurface
from synth.conformed.rates import ConformedChain
from synth.motion.configuration import Configuration
from synth.motion.driving import Driven
from synth.motion.motion import Motion, motion_along
from synth.motion.second_order import rates_at
from synth.moving.made import configuration_of
from synth.moving.surface_walk import (
    ROUND,
    Course,
    Position,
    Sense,
    Stretch,
    SurfaceLinks,
    positions_of,
)

__all__ = ["InstantAxis", "LinkPoint", "SurfaceMotion", "move_on_surface"]


@dataclass(frozen=True, slots=True)
class LinkPoint:
    """A point of a link, where it lies at the conformed position.

    Attributes
    ----------
    link : link id
    azimuth : float
        Of its ruling line, radians.
    along : float, optional
        Along the ruling line: from the apex of a cone; on a cylinder from the plane of the circle.

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
    """The axis about which a link turns against another, at a position.

    Attributes
    ----------
    first, second : link id
    direction : float[3] or None
        Unit vector: of linkages on cones through the apex. None where they do not turn against each other, or the
        rates are not told there: at a position with more freedoms to first order.
    point : float[3] or None
        On it, in the plane of the circle, for cylinders: the instant centre. None where it is at infinity.

    Examples
    --------
    >>> from synth.conformed.linkages import loop_on_cones
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
        return {
            "links": [self.first, self.second],
            "direction": None if self.direction is None else self.direction.tolist(),
            "point": None if self.point is None else self.point.tolist(),
        }


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
        At the turns that were asked for.
    points : tuple of LinkPoint
        Whose places at the positions are told.
    axes : tuple of (link, link)
        Whose instant axes at the positions are told.
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
        A point of link 2 goes round joint 2, if that is driven:

        >>> from synth.conformed.linkages import loop_on_cones
        >>> first, _ = loop_on_cones(np.radians([120, 95, 45, 85]))
        >>> motion = move_on_surface(first, driver="2", at=[0.0, 0.05])
        >>> places = motion.places_of(LinkPoint("2", 2.5))
        >>> hinge = motion.places_of(LinkPoint("1", first.places[1]))
        >>> bool(np.ptp((places * hinge).sum(axis=1)) < 1e-12), len(places)
        (True, 4)
        """
        surface = self.on_surface.surface
        assert surface is not None, "a linkage is moved from its surface"
        link = link_named(self.on_surface.chain, str(point.link))
        angles = np.array([each.angles for each in self.positions]).reshape(-1, len(self.joints))
        turn, shift = self._links().motions(angles)[link]
        return np.asarray(turn @ surface.place(point.azimuth, point.along, 0.0) + shift)

    def instant_axes(self, first: LinkId, second: LinkId) -> tuple[InstantAxis, ...]:
        """Return the instant axis of two links at each position, by the rates of the joints there.

        Examples
        --------
        That of neighbours is their joint:

        >>> from synth.conformed.linkages import loop_on_cylinders
        >>> open_one, _ = loop_on_cylinders([4, 3, 5, 1])
        >>> [axis] = move_on_surface(open_one, at=[0.0]).instant_axes("1", "2")
        >>> [(round(x, 4), round(z, 4)) for x, _, z in [axis.point.tolist()]]
        [(2.4596, -0.6182)]
        """
        names = [link_named(self.on_surface.chain, str(link)) for link in (first, second)]
        places = [self.chain.links.index(name) for name in names]
        return tuple(InstantAxis(names[0], names[1], *self._axis(each.angles, *places)) for each in self.positions)

    def _links(self) -> SurfaceLinks:
        return SurfaceLinks(self.on_surface, self.chain, self.configuration.linkage)

    def _axis(self, angles: Floats, first: int, second: int) -> tuple[Floats | None, Floats | None]:
        """Return direction and point of the axis of two links, by their numbers in the chain."""
        closure, linkage = self.configuration.closure, self.configuration.linkage
        rates = rates_at(closure, angles)
        if rates.shape[1] != 1:
            return None, None
        moved = self._links().motions(angles[None])
        points = linkage.points * linkage.extent + linkage.middle
        spin, speed = np.zeros(3), np.zeros(3)
        for joint, share in enumerate((self.chain.paths[second] - self.chain.paths[first]).tolist()):
            if share:
                turn, shift = (one[0] for one in moved[self._carrier(joint)])
                axis = share * rates[joint, 0] * (turn @ linkage.directions[joint])
                spin, speed = spin + axis, speed + np.cross(turn @ points[joint] + shift, axis)
        size = float(np.linalg.norm(spin))
        if size <= self.configuration.tolerances.zero_rate:
            return None, None
        along = signed(spin / size)
        if isinstance(self.on_surface.surface, Cylinder):
            return along, np.cross(spin, speed) / size**2
        return along, np.zeros(3)

    def _carrier(self, joint: int) -> LinkId:
        """Return a link that carries a joint, by its number."""
        return next(link for link, own in zip(self.chain.links, self.chain.joints_of, strict=True) if joint in own)

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
            (plain(link), _stretches(self.backward.ways[link]), _stretches(self.forward.ways[link]))
            for link in self.chain.links[1:]
        ]
        where = f"{self.on_surface.surface}, "
        return [
            f"{where}link {plain(self.chain.links[0])} fixed, joint {plain(self.driver)} driven",
            f"range {_side(self.backward)}, {_side(self.forward)}",
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
            "backward": _sense_json(self.backward),
            "forward": _sense_json(self.forward),
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
                for each, places, axes in zip(self.positions, self._all_places(), self._all_axes(), strict=True)
            ],
        }

    def _all_places(self) -> list[list[list[float]]]:
        """Return the places of all points at each position."""
        by_point = [self.places_of(one).tolist() for one in self.points]
        return [[places[number] for places in by_point] for number in range(len(self.positions))]

    def _all_axes(self) -> list[list[InstantAxis]]:
        """Return all instant axes at each position."""
        by_pair = [self.instant_axes(*pair) for pair in self.axes]
        return [[axes[number] for axes in by_pair] for number in range(len(self.positions))]


def move_on_surface(
    on_surface: OnSurface,
    ground: LinkId | None = None,
    driver: JointId | None = None,
    at: Sequence[float] = (),
    *,
    points: Sequence[LinkPoint] = (),
    axes: Sequence[tuple[LinkId, LinkId]] = (),
) -> SurfaceMotion:
    """Move a linkage on a cone or a cylinder, of any number of loops and one freedom, from its conformed position.

    Parameters
    ----------
    on_surface : OnSurface
        With a surface.
    ground : link id, optional
        The fixed link: by default the chain's own, or the first.
    driver : joint id, optional
        By default the first joint of the fixed link that moves.
    at : sequence of float, optional
        Turns of the driver from the conformed position, radians, at which positions are wanted: all those of the
        circuit.
    points : sequence of LinkPoint, optional
        Points of links whose places at the positions are told.
    axes : sequence of (link id, link id), optional
        Pairs of links whose instant axes at the positions are told.

    Raises
    ------
    UnsolvableError
        If the surface is not known, or the linkage has not just one freedom at the conformed position.
    InvariantError
        If the driver is no joint or does not move, a turn is not finite, or a link is none.

    Examples
    --------
    >>> from synth.conformed.linkages import loop_on_cones
    >>> first, _ = loop_on_cones(np.radians([120, 95, 45, 85]))
    >>> motion = move_on_surface(first)
    >>> motion.turns_fully, motion.closed, motion.driver
    (False, True, '1')
    >>> [round(degrees(sense.limit), 3) for sense in (motion.backward, motion.forward)]
    [-103.923, 5.655]
    """
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
    along = motion_along(configuration, Driven(None, [place], {}, ahead.circuit))
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
    asked = list(chain.joints_of[0]) if driver is None else [joints.index(driver)]
    found = [joint for joint in asked if moving[joint]]
    if not found:
        names = ", ".join(shown(joints[joint]) for joint in asked)
        raise InvariantError("driver", f"joint {names} is immobile at the conformed position", "one that moves")
    return found[0]


def _sense_json(sense: Sense) -> dict[str, Any]:
    keeps = sense.one_way
    return {
        "limit_deg": degrees(sense.limit),
        "ends": sense.ends,
        "one_way": None if keeps is None else {"way": keeps[0].name.lower(), "to_deg": degrees(keeps[1])},
        "links": {
            str(link): [{"way": each.way.name.lower(), "to_deg": degrees(each.end)} for each in stretches]
            for link, stretches in sense.ways.items()
        },
    }


def _side(sense: Sense) -> str:
    range_ = f"to {degrees(sense.limit):.10g}° ({sense.ends})"
    if sense.one_way is None:
        return range_
    way, end = sense.one_way
    return f"{range_}, all links {way.name.lower()} to {degrees(end):.6g}°"


def _circuit(motion: SurfaceMotion) -> str:
    if not motion.closed:
        return f"circuit not traced to its end: {motion.path.stopped}"
    turning = [f"joint {plain(joint)} {turns:+d}" for joint, turns in motion.turns.items() if turns]
    line = (
        f"circuit closed, loop-closure residual {motion.closure:.1e}; whole turns: {', '.join(turning) or 'none'}"
    )
    if motion.meets:
        line += "; another circuit meets it at " + ", ".join(f"{degrees(turn):.6g}°" for turn in motion.meets)
    return line


def _stretches(stretches: tuple[Stretch, ...]) -> str:
    return ", ".join(f"{each.way.name.lower()} to {degrees(each.end):.6g}" for each in stretches)


def _positions(motion: SurfaceMotion) -> list[Block]:
    joints = motion.joints
    heads = ("at", *(f"joint {joint}" for joint in joints), "without turning back")
    rows = [
        (
            f"{degrees(each.at):g}",
            *(f"{degrees(turn):.8g}" for turn in each.angles),
            "yes" if each.direct else "no",
        )
        for each in motion.positions
    ]
    inputs = {each.at for each in motion.positions}
    reached = f"{numbered(len(rows), 'configuration')} at {numbered(len(inputs), 'input angle')} within the range"
    return [TableBlock(heads, rows, ["at"]), reached]


def _places(motion: SurfaceMotion) -> list[Block]:
    rows = [
        (f"{degrees(each.at):g}", plain(one.link), f"{degrees(one.azimuth):g}", f"{one.along:g}", *_numbers(place))
        for each, places in zip(motion.positions, motion._all_places(), strict=True)
        for one, place in zip(motion.points, places, strict=True)
    ]
    numbers = ["at", "azimuth (deg)", "along", "x", "y", "z"]
    return ["points of links", TableBlock(("at", "link", *numbers[1:]), rows, numbers)]


def _axes(motion: SurfaceMotion) -> list[Block]:
    on_cylinder = isinstance(motion.on_surface.surface, Cylinder)
    rows = []
    for each, axes in zip(motion.positions, motion._all_axes(), strict=True):
        for axis in axes:
            vector = axis.point if on_cylinder else axis.direction
            cells = ["none"] * 3 if vector is None else _numbers(vector.tolist())
            rows.append((f"{degrees(each.at):g}", plain(axis.first), plain(axis.second), *cells))
    what = "instant centres, through which axes along y pass" if on_cylinder else "instant axes, through the apex"
    return [what, TableBlock(("at", "link", "and", "x", "y", "z"), rows, ["at", "x", "y", "z"])]


def _numbers(place: Sequence[float]) -> list[str]:
    return [f"{round(value, 12) + 0.0:.8g}" for value in place]
