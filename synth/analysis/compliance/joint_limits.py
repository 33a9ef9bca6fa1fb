"""The joint limits that ride-alongs impose where they go straight, and the truss that remains.

Theory: docs/theory/activating-constraints.md.
"""

from collections.abc import Collection, Iterator
from dataclasses import dataclass
from math import acos, atan2, degrees, inf, pi, tau
from typing import Any, Literal

import numpy as np

from graphs.errors import UnsolvableError, check_argument, numbered, shown
from graphs.geometry import angles_between, lines_meet
from graphs.plain_data import fields_to_json
from graphs.printing import Block, Printed, TableBlock
from graphs.rank.singular_values import spectrum
from graphs.reduce.ride_alongs import ReductionStep, reduce
from graphs.tolerances import DOUBLE, Tolerances
from graphs.types import JointId, LinkId
from synth.analysis.compliance.members import NONE, Members, freedoms_text, number_or_unknown, released, state_of
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.configuration import Configuration
from synth.analysis.motion.linkage import Linkage
from synth.analysis.moving._configuration_of import Movable, configuration_of

_LISTED = 40

_OTHER_QUESTION = "limits looks at ride-alongs, each with the links that it sits on, and at no branch"


@dataclass(frozen=True, slots=True)
class End:
    """An end of a range of angles, radians: a ride-along is in line, "stretched" or "folded" onto itself."""

    angle: float
    how: Literal["stretched", "folded"]


@dataclass(frozen=True, slots=True)
class RideAlong:
    """A ride-along, and the range of angles that it leaves to the joint it sits on.

    The second of its own `joints` is between its links. `angle`, radians, is that of `joint` at the
    configuration; `lower` and `upper` end the range of this that holds it, None where it may make a full turn.
    `freedoms` are those of the mechanism with the ride-along rigid; None where they are unknown.
    """

    joints: tuple[JointId, JointId, JointId]
    joint: JointId
    angle: float
    lower: End | None
    upper: End | None
    freedoms: int | None

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "joints": list(self.joints),
            "joint": self.joint,
            "angle_deg": degrees(self.angle),
            **{
                side: None if end is None else {"at_deg": degrees(end.angle), "how": end.how}
                for side, end in (("lower", self.lower), ("upper", self.upper))
            },
            "freedoms": self.freedoms,
        }


@dataclass(frozen=True, slots=True)
class Truss:
    """What remains with all ride-alongs rigid: `locked` are the joints between their links.

    Rank is that of the closure equations at the configuration, `redundant` counts those that follow from others,
    `freedoms` are those of finite motion; None where they are unknown.
    """

    locked: tuple[JointId, ...]
    links: int
    joints: int
    rank: int | None
    redundant: int | None
    freedoms: int | None

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return fields_to_json(self)


@dataclass(frozen=True, slots=True, repr=False)
class JointLimits(Printed):
    """The joint limits that the ride-alongs of a mechanism impose. It prints as ``synth limits`` does.

    Attributes
    ----------
    configuration : Configuration
        The input.
    ride_alongs : tuple of RideAlong
        Those that sit on others come before these.
    truss : Truss

    Examples
    --------
    >>> from synth.catalogue.patterns import generate
    >>> limits(generate("deployable-cylinder", pleats=3).mechanism)
    <JointLimits: 6 ride-alongs>
    """

    configuration: Configuration
    ride_alongs: tuple[RideAlong, ...]
    truss: Truss

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return fields_to_json(self, configuration=self.configuration.to_json(other_question=_OTHER_QUESTION))

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        rows = [
            (
                shown(ride_along.joint),
                " ".join(map(shown, ride_along.joints)),
                _end(ride_along.lower),
                f"{degrees(ride_along.angle):.6g}",
                _end(ride_along.upper),
                number_or_unknown(ride_along.freedoms),
            )
            for ride_along in self.ride_alongs[:_LISTED]
        ]
        columns = ("on joint", "joints", "from (deg)", "now (deg)", "to (deg)", "DOF if held")
        table = TableBlock(columns, rows, ("now (deg)", "DOF if held"))
        lines: list[Block] = [numbered(len(self.ride_alongs), "ride-along"), table]
        if len(rows) < len(self.ride_alongs):
            lines.append(f"and {len(self.ride_alongs) - len(rows)} more")
        truss = self.truss
        parts = f"{numbered(truss.links, 'link')}, {numbered(truss.joints, 'joint')}"
        evidence = f"rank {number_or_unknown(truss.rank)}, {number_or_unknown(truss.redundant)} redundant"
        return [
            *lines,
            f"with all of them held at this configuration: {freedoms_text(truss.freedoms)} ({parts}; {evidence})",
        ]

    def __repr__(self) -> str:
        return f"<JointLimits: {numbered(len(self.ride_alongs), 'ride-along')}>"


def _end(end: End | None) -> str:
    return "any" if end is None else f"{degrees(end.angle):.6g}, {end.how}"


@dataclass(frozen=True, slots=True)
class RideAlongCorner:
    """The two links of a joint and the ride-along on it: lengths if all axes are `parallel`, else angles, radians.

    `base` is from the joint to the axis of the ride-along on the first and on the second link, `links` from these
    axes to the middle one.
    """

    base: tuple[float, float]
    links: tuple[float, float]
    parallel: bool = False

    def cosines(self) -> tuple[float, float]:
        """Return the cosines of the angle between the base links with the ride-along stretched and folded.

        They are by the law of cosines, planar or spherical; a value outside -1 to 1 is not reached.
        """
        (a, b), (c, d) = self.base, self.links
        if self.parallel:
            apart = ((c + d) ** 2, (c - d) ** 2)
            over = 2.0 * a * b
            ends = [a * a + b * b - square for square in apart]
        else:
            over = float(np.sin(a) * np.sin(b))
            ends = [float(np.cos(far) - np.cos(a) * np.cos(b)) for far in (c + d, c - d)]
        stretched, folded = (end / over if over else inf * end for end in ends)
        return stretched, folded


def angles_left(corner: RideAlongCorner, angle: float) -> tuple[End | None, End | None]:
    """Return both ends of the range of angles between two base links that a ride-along on them leaves.

    The present angle is in radians from 0 to 2 pi, from the first axis to the second about the joint. The ends are
    less than a turn from it; None where a full turn is left.
    """
    low, high = corner.cosines()
    if low <= -1.0 + DOUBLE.parallel and high >= 1.0 - DOUBLE.parallel:
        return None, None
    widest = pi if low <= -1.0 + DOUBLE.parallel else acos(min(low, 1.0))
    narrowest = 0.0 if high >= 1.0 - DOUBLE.parallel else acos(max(high, -1.0))
    mirrored = angle > pi
    if narrowest == 0.0:
        turn = tau if mirrored else 0.0
        return End(turn - widest, "stretched"), End(turn + widest, "stretched")
    if widest == pi:
        return End(narrowest, "folded"), End(tau - narrowest, "folded")
    if mirrored:
        return End(tau - widest, "stretched"), End(tau - narrowest, "folded")
    return End(narrowest, "folded"), End(widest, "stretched")


def limits(mechanism: Movable, *, keep: Collection[LinkId] = ()) -> JointLimits:
    """Find the joint limits that ride-alongs impose, and the truss that remains where they are straight.

    Parameters
    ----------
    mechanism : Mechanism or Linkage
        With coordinates; of a sheet with several frames the first that has them.
    keep : collection of link ids, optional
        Links that are no ride-along's: of two four-bars with a joint in common either may be.

    Raises
    ------
    InvariantError
        If a link to keep does not exist.
    UnsolvableError
        If it has no coordinates, its loops are not closed, or it has no ride-alongs.

    Examples
    --------
    >>> from synth.catalogue.patterns import generate
    >>> limits(generate("deployable-cylinder", pleats=3).mechanism).truss.freedoms
    0
    """
    check_argument("compliance.limits", mechanism, Movable)
    at = configuration_of(mechanism)
    linkage = at.linkage
    steps = [step for step in reduce(linkage.graph, keep=keep).steps if step.joint is not None]
    if not steps:
        raise UnsolvableError("there are no ride-alongs; expected two binary links on two adjacent ones")
    ride_alongs = tuple(_ride_alongs(linkage, steps, Tolerances.of(at.precision.size)))
    # the truss is what is left of the linkage with all ride-alongs rigid, as they are where they are straight
    middles = Members(tuple(step.joints[1] for step in steps))
    left = released(linkage, middles, NONE)
    closure = ClosureEquations(left)
    rank = spectrum(closure.at(left.angles)[1].toarray(), DOUBLE.derivative).rank
    redundant = None if rank is None else closure.rows - rank
    freedoms = state_of(linkage, middles, NONE).freedoms
    truss = Truss(middles.joints, len(left.graph), len(left.angles), rank, redundant, freedoms)
    return JointLimits(at, ride_alongs, truss)


def _ride_alongs(linkage: Linkage, steps: list[ReductionStep], tolerances: Tolerances) -> Iterator[RideAlong]:
    place = {joint: number for number, joint in enumerate(linkage.graph.joints)}
    for step in steps:
        assert step.joint is not None
        joint = place[step.joint]
        first, middle, last = (place[other] for other in step.joints)
        forwards = linkage.graph.joints[step.joint][0] == step.onto[0]
        corner, angle = _corner(linkage, (joint, first, middle, last), tolerances)
        now = float(linkage.angles[joint])
        sense = 1.0 if forwards else -1.0  # by which the joint turns while the angle between the links grows
        turned = [
            None if end is None else End(now + sense * (end.angle - angle), end.how)
            for end in angles_left(corner, angle)
        ]
        lower, upper = turned if forwards else turned[::-1]
        state = state_of(linkage, Members((step.joints[1],)), NONE)
        yield RideAlong(step.joints, step.joint, now, lower, upper, state.freedoms)


def _corner(
    linkage: Linkage, places: tuple[int, int, int, int], tolerances: Tolerances
) -> tuple[RideAlongCorner, float]:
    """Return the corner of a joint and the three of a ride-along, and the angle of its base links, 0 to 2 pi."""
    points, axes = linkage.points[list(places)], linkage.directions[list(places)]
    parallel = float(np.abs(np.cross(axes, axes[0])).max()) <= tolerances.parallel
    along = axes[0]
    if parallel:
        rays = points - points[0]
        rays = rays - np.outer(rays @ along, along)
    else:  # unit vectors from where the axes meet, towards their points where these lie off it
        out = ((points - lines_meet(points, axes).point) * axes).sum(axis=1)
        rays = axes * np.where(np.abs(out) > tolerances.same_point, np.sign(out), 1.0)[:, None]

    def apart(a: int, b: int) -> float:
        return float(np.linalg.norm(rays[a] - rays[b]) if parallel else angles_between(rays[a], rays[b]))

    corner = RideAlongCorner((apart(0, 1), apart(0, 3)), (apart(1, 2), apart(2, 3)), parallel)
    first, last = (ray - (ray @ along) * along for ray in (rays[1], rays[3]))
    return corner, atan2(float(np.cross(first, last) @ along), float(first @ last)) % tau
