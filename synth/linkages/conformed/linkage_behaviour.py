"""Behaviour of linkages in the conformed position: from sizes of links, from steps, or from a file.

Theory: docs/theory/behaviour.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import product
from math import degrees, pi
from typing import Any

import numpy as np

from graphs.edit.named import joint_named, link_named
from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.mechanism.closed_form import ClosedFormLinkage, PlacedChain
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.surfaces import Cone, Cylinder, Surface, SurfaceLinkage, as_planar, ring, surface_json
from graphs.printing import Block, Printed, TableBlock, plain
from graphs.types import Floats, JointId, LinkId
from synth.linkages.conformed.behaviours import (
    Behaviour,
    TableRow,
    Way,
    behaviour,
    half_turn_arcs,
    icrl,
    instant_centres,
    link_arcs,
    table_row,
    ways_over,
)
from synth.linkages.conformed.orders import SurfaceLike, surface_linkage_for
from synth.linkages.conformed.rates import ConformedChain
from synth.linkages.surfaces.circuit import HALF_TURN, azimuths, closing_step, wrapped
from synth.linkages.surfaces.linkage_maps import map_linkage
from synth.linkages.surfaces.loop_maps import map_to_cones, map_to_cylinders
from synth.linkages.surfaces.mapping import in_degrees, joints_text

_FAR = 1e12


@dataclass(frozen=True, slots=True)
class OnSurface(ClosedFormLinkage):
    """A linkage at its conformed position; without a surface, on any cone or cylinder.

    Attributes
    ----------
    chain : SCGraph
    places : float[J]
        Azimuths of the joints, radians, in the order of the chain's joints.
    surface : Cone, Cylinder or None
        None: any.
    arcs : mapping of link to joint
        For links that span half a turn, and may curve either way: the joint at which the arc begins, azimuths
        growing.

    Examples
    --------
    >>> loop_of_steps(np.radians([40, 50, 50])).behaviour().way_of(2)
    'outward'
    """

    chain: SCGraph
    places: Sequence[float]
    surface: Surface | None = None
    arcs: Mapping[LinkId, JointId] = field(default_factory=dict)

    @property
    def cone_angle(self) -> float | None:
        """lambda, radians, of a cone."""
        return self.surface.angle if isinstance(self.surface, Cone) else None

    def placed_chain(self, body: Floats | None = None) -> PlacedChain:
        """Return its axes at the conformed position; `UnsolvableError` if it fits any surface."""
        if self.surface is None:
            raise UnsolvableError("the linkage fits any cone or cylinder; expected a cone angle or a radius")
        return PlacedChain(self.chain, *self.surface.axes(self.places), self.surface.centre)

    def linkage(self) -> SurfaceLinkage:
        """Return the linkage by its steps and its surface, in the form that can be written to a file."""
        return SurfaceLinkage.placed(self.chain, self.places, self.surface)

    def curved(self, arcs: Mapping[str, str]) -> OnSurface:
        """Return the linkage with arcs chosen for links that span half a turn, by names.

        Arcs map a link to the joint at which its arc begins, azimuths growing. Raises `InvariantError` if there is
        no such link or joint, or the link does not span half a turn.
        """
        chosen = {link_named(self.chain, link): joint_named(self.chain, joint) for link, joint in arcs.items()}
        curved = replace(self, arcs={**self.arcs, **chosen})
        curved.begins(ConformedChain.of(self.chain))
        return curved

    def begins(self, chain: ConformedChain) -> dict[int, int]:
        """Return the arcs that are chosen by the numbers of links and joints."""
        halves = half_turn_arcs(chain, self.places)
        begins = {chain.links.index(link): chain.joints.index(joint) for link, joint in self.arcs.items()}
        for number, joint in begins.items():
            link = shown(chain.links[number])
            if number not in halves:
                raise InvariantError("arc", f"link {link} does not span half a turn", "one that can curve either way")
            if joint not in dict(halves[number]):
                first, second = (shown(chain.joints[begin]) for begin, _ in halves[number])
                offender = f"link {link} has no arc from joint {shown(chain.joints[joint])}"
                raise InvariantError("arc", offender, f"one from joint {first} or {second}")
        return begins

    def behaviour(self, ground: LinkId | None = None) -> LinkageBehaviour:
        """Return what the linkage does, one link fixed: its own ground link, or the first, if none is named."""
        chain = ConformedChain.of(self.chain, ground)
        places, begins = np.array(self.places), self.begins(chain)
        return LinkageBehaviour(
            chain, places, self.surface, behaviour(chain, places, link_arcs(chain, places, begins)), begins
        )


@dataclass(frozen=True, slots=True)
class ArcChoice:
    """One choice of arcs for links that span half a turn.

    Attributes
    ----------
    arcs : mapping of int to (int, int)
        Number of a link to those of the joints at which its arc begins and ends.
    intramobile, extramobile : bool
        Whether the linkage can move so that all its links stay inside, or outside.

    Examples
    --------
    >>> [choice.extramobile for choice in loop_of_steps(np.radians([40, 50, 90])).behaviour().choices()]
    [True, False]
    """

    arcs: Mapping[int, tuple[int, int]]
    intramobile: bool
    extramobile: bool


@dataclass(frozen=True, slots=True)
class LinkageBehaviour(Printed):
    """What a linkage does in the conformed position, one link fixed.

    Attributes
    ----------
    chain : ConformedChain
        Its first link is fixed.
    places : float[J]
        Azimuths of the joints, radians.
    surface : Cone, Cylinder or None
        None: any cone or cylinder.
    behaviour : Behaviour
    begins : mapping of int to int
        Number of a link that spans half a turn to the joint at which its arc begins, where that is chosen.
    """

    chain: ConformedChain
    places: Floats
    surface: Surface | None
    behaviour: Behaviour
    begins: Mapping[int, int] = field(default_factory=dict)

    def table_row(self) -> TableRow | None:
        """Return the row of Table 4 (Hyatt et al. 2021) of a four-bar that has one."""
        around = self._around()
        if around is None:
            return None
        try:
            return table_row(self.places[around])
        except InvariantError:  # two joints on one ruling line have no row
            return None

    def mobile(self) -> tuple[bool, bool]:
        """Return whether the linkage can be intramobile, and extramobile, with one choice of arcs or another."""
        choices = self.choices()
        return any(one.intramobile for one in choices), any(one.extramobile for one in choices)

    def choices(self) -> tuple[ArcChoice, ...]:
        """Return what the linkage can be with each choice of the arcs of links that span half a turn.

        To first order, but for joints half a turn from a fixed joint of their link, which go outward to second.
        """
        halves, outward = self._halves(), self._goes_outward()
        if not halves:
            row, both = self.table_row(), bool(self.behaviour.one_way)
            inward = both and not outward
            return (ArcChoice({}, inward, both) if row is None else ArcChoice({}, row.intramobile, row.extramobile),)
        choices = []
        for arcs in product(*halves.values()):
            chosen = dict(zip(halves, arcs, strict=True))
            ways = [Way(int(way)) for way in self.behaviour.ways]
            for number, arc in chosen.items():
                ways[number] = self._way_over(number, arc)
            moving = set(ways) - {Way.STILL}
            both = self.behaviour.motion.freedoms == 1 and moving in ({Way.INWARD}, {Way.OUTWARD})
            choices.append(ArcChoice(chosen, both and not outward, both))
        return tuple(choices)

    def _goes_outward(self) -> bool:
        """Check whether a joint moves along the surface, half a turn from a fixed joint of its link: outward."""
        fixed, t = set(self.chain.joints_of[0]), self.places
        return any(
            abs(float(wrapped(t[joint] - t[centre]))) >= HALF_TURN
            for number, joints in enumerate(self.chain.joints_of)
            if self.behaviour.ways[number] != Way.STILL
            for centre in fixed.intersection(joints)
            for joint in joints
        )

    def _halves(self) -> dict[int, tuple[tuple[int, int], ...]]:
        """Return the moving links that span half a turn, each with its arcs, or the one that is chosen."""
        return {
            number: tuple(arc for arc in arcs if self.begins.get(number, arc[0]) == arc[0])
            for number, arcs in half_turn_arcs(self.chain, self.places).items()
            if number
        }

    def _way_over(self, number: int, arc: tuple[int, int]) -> Way:
        """Return the way of a link that spans half a turn over one of its arcs."""
        if self.behaviour.ways[number] in (Way.UNKNOWN, Way.STILL):
            return Way(int(self.behaviour.ways[number]))
        spans = link_arcs(self.chain, self.places, {number: arc[0]})
        return Way(int(ways_over(self.behaviour.motion.motions, spans)[number]))

    def _around(self) -> list[int] | None:
        """Return the joints O, A, B, C of a four-bar whose ground link is C O."""
        chain = self.chain
        if len(chain.links) != 4 or len(chain.joints) != 4 or any(len(joints) != 2 for joints in chain.joints_of):
            return None
        c, o = chain.joints_of[0]
        a = next(sum(joints) - o for joints in chain.joints_of[1:] if o in joints)
        return [o, a, 6 - o - a - c, c]

    def way_of(self, link: int) -> str:
        """Return which way a link, by its number, can go: ``inward``, ``outward``, ..."""
        return Way(int(self.behaviour.ways[link])).name.lower()

    def blocks(self) -> list[Block]:
        """Return the printed lines and table."""
        row, chain = self.table_row(), self.chain
        blocks: list[Block] = [self._verdict()]
        if row is not None:
            special = ", a chord is a diameter" if row.special else ""
            blocks.append(f"Table 4: case {row.case}, {row.configuration}, {row.column}{special}")
        lines = icrl(self.behaviour.motion.motions)
        rows = [
            (
                plain(chain.links[number]) + ("" if arc is None else f", {self._names(arc)}"),
                joints_text([chain.joints[joint] for joint in chain.joints_of[number]]),
                "fixed" if number == 0 else way,
                "" if np.isnan(lines[number]) else f"{in_degrees([lines[number]])[0]:.6g}",
            )
            for number, arc, way in self._rows()
        ]
        return [*blocks, TableBlock(("link", "joints", "moves", "ICRL (deg)"), rows, ["ICRL (deg)"])]

    def _rows(self) -> Iterator[tuple[int, tuple[int, int] | None, str]]:
        """Yield the number of each link, its arc if it spans half a turn, and its way: a row for each arc."""
        halves = self._halves()
        for number in range(len(self.chain.links)):
            if number not in halves:
                yield number, None, self.way_of(number)
            for arc in halves.get(number, ()):
                yield number, arc, self._way_over(number, arc).name.lower()

    def _names(self, arc: tuple[int, int]) -> str:
        return "from {} to {}".format(*(plain(self.chain.joints[joint]) for joint in arc))

    def _verdict(self) -> str:
        """Return a line with the ways in which the linkage can move."""
        where = "any cone or cylinder" if self.surface is None else str(self.surface)
        motion = self.behaviour.motion
        freedoms = int(motion.freedoms)
        if motion.undecided:
            verdict = "indeterminate: a singular value is near the noise"
        elif freedoms == 1:
            verdict = "; ".join(map(self._told, self.choices()))
        else:
            verdict = f"{freedoms} infinitesimal degrees of freedom: no single direction of motion"
        if motion.nearly:
            more = numbered(int(motion.nearly), "more degree of freedom", "more degrees of freedom")
            verdict += f"; nearly mobile: {more} but for small errors"
        return f"{where}, link {plain(self.chain.links[0])} fixed: {verdict}"

    def _told(self, choice: ArcChoice) -> str:
        both = (("intramobile", choice.intramobile), ("extramobile", choice.extramobile))
        words = [word for word, so in both if so]
        verdict = "can be " + " or ".join(words) if words else "transmobile"
        arcs = [f"link {plain(self.chain.links[link])} {self._names(arc)}" for link, arc in choice.arcs.items()]
        return verdict + (f" with {' and '.join(arcs)}" if arcs else "")

    def to_json(self) -> dict[str, Any]:
        """Return the behaviour as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        motion, chain = self.behaviour.motion, self.chain
        lines, row = icrl(motion.motions), self.table_row()
        intra, extra = self.mobile()
        return {
            **surface_json(self.surface),
            "azimuths_deg": dict(zip(map(str, chain.joints), in_degrees(self.places.tolist()), strict=True)),
            "ground": chain.links[0],
            "freedoms": None if motion.undecided else int(motion.freedoms),
            "rank": None if motion.undecided else int(motion.rank()),
            "nearly_mobile": int(motion.nearly),
            "singular_values": motion.singular_values.tolist(),
            "intramobile": intra,
            "extramobile": extra,
            "choices": [
                {
                    "arcs": {str(chain.links[link]): self._joints(arc) for link, arc in one.arcs.items()},
                    "intramobile": one.intramobile,
                    "extramobile": one.extramobile,
                }
                for one in self.choices()
            ],
            "links": [
                {
                    "link": chain.links[number],
                    "joints": [chain.joints[joint] for joint in chain.joints_of[number]],
                    "arc": None if arc is None else self._joints(arc),
                    "way": way,
                    "icrl_deg": None if np.isnan(lines[number]) else degrees(lines[number]),
                    "instant_centre": _centre(motion.motions[number]),
                }
                for number, arc, way in self._rows()
            ],
            "tangent": [joint for joint, is_so in zip(chain.joints, self.behaviour.tangent, strict=True) if is_so],
            "table4": None
            if row is None
            else {"case": row.case, "configuration": row.configuration, "column": row.column, "diameter": row.special},
        }

    def _joints(self, arc: tuple[int, int]) -> list[JointId]:
        return [self.chain.joints[joint] for joint in arc]


def _centre(motion: Floats) -> list[float] | None:
    x, y = instant_centres(motion).tolist()
    return [x, y] if abs(x) < _FAR and abs(y) < _FAR else None


def linkage_on_surfaces(
    linkage: SurfaceLinkage, surface: Surface | None = None, *, tolerance: float = 1e-7, families: bool = False
) -> list[OnSurface]:
    """Return a linkage on each of its surfaces: from link angles or lengths, or from steps (then one).

    Parameters
    ----------
    linkage : SurfaceLinkage
    surface : Cone or Cylinder, optional
        For steps: by default that of the linkage, or any. For link angles or lengths: the one surface that is
        chosen of those on which they lie.
    tolerance : float, optional
        How well loops of known sizes must close together, radians.
    families : bool, optional
        After these, one of each interval of surfaces, its typical one.

    Examples
    --------
    >>> loops = linkage_on_surfaces(SurfaceLinkage.loop(np.radians([120, 95, 45, 85])))
    >>> [round(degrees(loop.cone_angle), 8) for loop in loops]
    [13.99835668, 29.04446943]
    """
    if linkage.steps is not None:
        return [OnSurface(linkage.chain, linkage.places(), surface or linkage.surface)]
    mapped = map_linkage(linkage, tolerance, surface)
    return [
        OnSurface(linkage.chain, [one.places[joint] for joint in linkage.chain.joints], one.surface)
        for one in (mapped.rows() if families else mapped.surfaces)
    ]


def one_on_surface(verb: str, mechanism: OnSurface | SurfaceLike, surface: Surface | None = None) -> OnSurface:
    """Return the linkage that a verb was called with on its one surface, or on the chosen one.

    Raise ArgumentError, by the name of the verb, for another object; UnsolvableError if it lies on no surface, or on
    several and none is chosen.
    """
    if isinstance(mechanism, OnSurface):
        return mechanism if surface is None else replace(mechanism, surface=surface)
    linkage = surface_linkage_for(verb, mechanism, surface)
    placed = linkage_on_surfaces(linkage, surface, families=surface is not None)
    if len(placed) == 1:
        return placed[0]
    where = numbered(len(placed), linkage.kind) + "".join(f", {each.surface}" for each in placed)
    raise UnsolvableError(
        f"{verb}: the linkage lies on {where}; expected one; try surface=synth.{_AN_EXAMPLE[linkage.kind]}"
    )


_AN_EXAMPLE = {"cone": "Cone(angle in radians)", "cylinder": "Cylinder(radius)"}
"""How a surface is chosen in Python."""


def surface_behaviours(
    mechanism: SurfaceLike, ground: LinkId | None = None, *, surface: Surface | None = None
) -> tuple[LinkageBehaviour, ...]:
    """Return which links leave each surface of a linkage inward, outward, or both ways, to first order.

    Parameters
    ----------
    mechanism : SurfaceLinkage, str, Path, dict, or the result of `realise_on_cone`
        By its steps, or by link angles or lengths; a file of it; a row of `conical_candidates`. `ArgumentError` for
        another object.
    ground : link id, optional
        The fixed link: by default the linkage's own, or the first.
    surface : Cone or Cylinder, optional
        Only this one, of those on which it lies.

    Examples
    --------
    >>> linkage = SurfaceLinkage.loop(np.radians([120, 95, 45, 85]))
    >>> [behaviour.way_of(2) for behaviour in surface_behaviours(linkage)]
    ['both', 'both']
    """
    linkage = surface_linkage_for("surface_behaviours", mechanism, surface)
    return tuple(placed.behaviour(ground) for placed in linkage_on_surfaces(linkage, surface))


def surface_of_number(surfaces: Sequence[OnSurface], number: int | None, kind: str = "cone") -> OnSurface:
    """Return the surface with a number, from 1, of those of a linkage; required where there are several.

    Raise `UnsolvableError` if there is none of the kind, or several and no number, or none of this number.
    """
    if not surfaces:
        raise UnsolvableError(f"the linkage lies on no {kind}")
    if number is None and len(surfaces) > 1:
        choices = ", ".join(str(loop.surface) for loop in surfaces)
        raise UnsolvableError(f"the linkage lies on {len(surfaces)} {kind}s, {choices}: --{kind} is required")
    if number is not None and number > len(surfaces):
        raise UnsolvableError(
            f"the linkage lies on {numbered(len(surfaces), kind)}: "
            f"expected --{kind} of {len(surfaces)} at most, got {number}"
        )
    return surfaces[(number or 1) - 1]


def loop_on_cones(
    angles: Sequence[float], cone_angle: float | None = None, *, families: bool = False
) -> list[OnSurface]:
    """Return a loop of link angles on each of its cones.

    Parameters
    ----------
    angles : float[n]
        Radians, in loop order.
    cone_angle : float, optional
        lambda of the one cone that is chosen of them, radians.
    families : bool, optional
        After these, one cone amid each interval of cones.

    Examples
    --------
    >>> [loop.behaviour().way_of(2) for loop in loop_on_cones(np.radians([120, 95, 45, 85]))]
    ['both', 'both']
    """
    mapped = map_to_cones(angles, cone_angle)
    return [
        OnSurface(ring(len(angles)), azimuths(cone.steps).tolist(), Cone(cone.size))
        for cone in (mapped.rows() if families else mapped.cones)
    ]


def loop_on_cylinders(
    lengths: Sequence[float], radius: float | None = None, *, families: bool = False
) -> list[OnSurface]:
    """Return a loop of lengths on each of its cylinders.

    Parameters
    ----------
    lengths : float[n]
        In loop order, any one unit.
    radius : float, optional
        Of the one cylinder that is chosen of them.
    families : bool, optional
        After these, one cylinder of each interval of radii.

    Examples
    --------
    >>> [str(loop.surface) for loop in loop_on_cylinders([4, 3, 5, 1])]
    ['radius 2.536145625', 'radius 2.590911136']
    """
    chain, mapped = as_planar(ring(len(lengths))), map_to_cylinders(lengths, radius)
    return [
        OnSurface(chain, azimuths(one.steps).tolist(), Cylinder(one.size))
        for one in (mapped.rows() if families else mapped.cylinders)
    ]


def loop_of_steps(steps: Sequence[float], surface: Surface | None = None) -> OnSurface:
    """Return a loop from its steps round the surface (radians); the last is added if the rest do not close.

    Parameters
    ----------
    steps : float[n]
        In [-pi, pi], none 0, else `InvariantError`. The sign of a step of half a turn is the way in which its link
        curves.
    surface : Cone or Cylinder, optional
        Any by default.

    Examples
    --------
    >>> np.degrees(loop_of_steps(np.radians([120, 95, 45])).places).round(9).tolist()
    [0.0, 120.0, 215.0, 260.0]
    """
    closed_steps = list(steps)
    for place, step in enumerate(closed_steps):
        if not 0.0 < abs(step) <= pi + 1e-12:
            offender = f"step {place + 1} is {degrees(step):.12g} degrees"
            raise InvariantError("step", offender, "between -180 and 180, and not 0")
    last = float(closing_step(closed_steps))
    if abs(last) > 1e-9:
        closed_steps.append(last)
    if len(closed_steps) < 3:
        raise InvariantError("step", f"{len(closed_steps)} steps", "three or more")
    chain = ring(len(closed_steps))
    joints = list(chain.joints)
    arcs: dict[LinkId, JointId] = {
        place + 1: joints[place if step > 0 else (place + 1) % len(joints)]
        for place, step in enumerate(steps)
        if abs(step) >= HALF_TURN
    }
    if isinstance(surface, Cylinder):
        chain = as_planar(chain)
    return OnSurface(chain, azimuths(closed_steps).tolist(), surface, arcs)
