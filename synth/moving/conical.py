"""Motion of linkages on cones from the conformed position: range of a driving joint, ways of links, circuits.

To first order the ways are told by `synth.conformed.behaviours`; here links are looked at all along.
Theory: docs/theory/moving.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from math import degrees, isfinite, tau
from typing import Any

import numpy as np

from graphs.edit.named import known
from graphs.errors import InvariantError, numbered, shown
from graphs.ids import JointId, LinkId
from graphs.printing import Block, TableBlock, plain
from synth.conformed.linkages import OnCone
from synth.conformed.rates import ConformedChain
from synth.motion.configuration import Configuration
from synth.motion.driving import Driven
from synth.motion.motion import Motion, motion_along
from synth.motion.second_order import rates_at
from synth.moving.conical_walk import (
    ROUND,
    ConicalLinks,
    Course,
    Position,
    Sense,
    Stretch,
    positions_of,
)
from synth.moving.made import configuration_of

__all__ = ["ConicalMotion", "move_on_cone"]


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class ConicalMotion(Motion):
    """A linkage of one freedom on its cone, moved from the conformed position.

    Its path is the circuit: all configurations that can be reached, the driving joint beginning forward.

    Attributes
    ----------
    on_cone : OnCone
    chain : ConformedChain
        Its first link is fixed.
    driver : joint id
    backward, forward : Sense
    positions : tuple of Position
        At the turns that were asked for.
    """

    on_cone: OnCone
    chain: ConformedChain
    driver: JointId
    backward: Sense
    forward: Sense
    positions: tuple[Position, ...]

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
        angle = self.on_cone.cone_angle
        where = "" if angle is None else f"lambda {degrees(angle):.10g} degrees, "
        return [
            f"{where}link {plain(self.chain.links[0])} fixed, joint {plain(self.driver)} driven",
            f"range {_side(self.backward)}, {_side(self.forward)}",
            _circuit(self),
            TableBlock(("link", "backward", "forward"), rows),
            *(_positions(self) if self.positions else []),
        ]

    def __repr__(self) -> str:
        return f"<ConicalMotion: {self.linkage!r}, joint {self.driver!r} driven>"

    def to_json(self) -> dict[str, Any]:
        """Return the motion as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        joints = list(map(str, self.joints))
        return {
            **super().to_json(),
            "lambda_deg": None if self.on_cone.cone_angle is None else degrees(self.on_cone.cone_angle),
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
                }
                for each in self.positions
            ],
        }


def move_on_cone(
    on_cone: OnCone, ground: LinkId | None = None, driver: JointId | None = None, at: Sequence[float] = ()
) -> ConicalMotion:
    """Move a linkage on a cone, of any number of loops and one freedom, from its conformed position.

    Parameters
    ----------
    on_cone : OnCone
        With a cone angle.
    ground : link id, optional
        The fixed link: by default the chain's own, or the first.
    driver : joint id, optional
        By default the first joint of the fixed link that moves.
    at : sequence of float, optional
        Turns of the driver from the conformed position, radians, at which positions are wanted: all those of the
        circuit.

    Raises
    ------
    UnsolvableError
        If the cone angle is not known, or the linkage has not just one freedom at the conformed position.
    InvariantError
        If the driver is no joint or does not move, or a turn is not finite.

    Examples
    --------
    >>> from synth.conformed.linkages import loop_on_cones
    >>> first, _ = loop_on_cones(np.radians([120, 95, 45, 85]))
    >>> motion = move_on_cone(first)
    >>> motion.turns_fully, motion.closed, motion.driver
    (False, True, '1')
    >>> [round(degrees(sense.limit), 3) for sense in (motion.backward, motion.forward)]
    [-103.923, 5.655]
    """
    chain, configuration = ConformedChain.of(on_cone.chain, ground), configuration_of(on_cone)
    linkage, closure = configuration.linkage, configuration.closure
    place = _driver(configuration, chain, driver)
    for turn in at:
        if not isfinite(turn):
            raise InvariantError("turn", f"a position is asked for at {turn}", "a finite angle")
    links = ConicalLinks(on_cone, chain, linkage)
    towards = np.eye(1, closure.joints, place)[0]
    ahead = Course.along(closure, links, towards, at, place)
    closed = not ahead.circuit.stopped
    behind = ahead.reversed(place) if closed else Course.along(closure, links, -towards, at, place)
    along = motion_along(configuration, Driven(None, [place], {}, ahead.circuit))
    return ConicalMotion(
        **{part.name: getattr(along, part.name) for part in fields(Motion)},
        on_cone=on_cone,
        chain=chain,
        driver=configuration.joints[place],
        backward=behind.sense(links, place),
        forward=ahead.sense(links, place),
        positions=tuple(positions_of(behind, ahead, links, at)),
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
        raise InvariantError("driver", f"joint {names} does not move at the conformed position", "one that does")
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
    told = f"to {degrees(sense.limit):.10g} degrees ({sense.ends})"
    if sense.one_way is None:
        return told
    way, end = sense.one_way
    return f"{told}, all links {way.name.lower()} to {degrees(end):.6g}"


def _circuit(motion: ConicalMotion) -> str:
    if not motion.closed:
        return f"circuit not followed to its end: {motion.path.stopped}"
    turning = [f"joint {plain(joint)} {turns:+d}" for joint, turns in motion.turns.items() if turns]
    line = f"circuit closed, loops to {motion.closure:.1e}; whole turns: {', '.join(turning) or 'none'}"
    if motion.meets:
        line += "; another circuit meets it at " + ", ".join(f"{degrees(turn):.6g}" for turn in motion.meets)
    return line


def _stretches(stretches: tuple[Stretch, ...]) -> str:
    return ", ".join(f"{each.way.name.lower()} to {degrees(each.end):.6g}" for each in stretches)


def _positions(motion: ConicalMotion) -> list[Block]:
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
    asked = {each.at for each in motion.positions}
    reached = f"{numbered(len(rows), 'position')} at {numbered(len(asked), 'turn')} that are reached"
    return [TableBlock(heads, rows, ["at"]), reached]
