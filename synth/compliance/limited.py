"""Ride-alongs that go straight: what angles they leave to the joint they sit on, and the truss that remains.

Theory: docs/theory/activating-constraints.md.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from math import acos, atan2, inf, pi, tau

import numpy as np

from graphs.errors import UnsolvableError
from graphs.geometry import angles_between, lines_meet
from graphs.rank.singular_values import spectrum
from graphs.reduce.ride_alongs import ReductionStep, reduce
from graphs.tolerances import DOUBLE, Tolerances
from graphs.types import Floats, LinkId
from synth.compliance.freedoms import state_of
from synth.compliance.limits_answer import End, Limits, RideAlong, Truss
from synth.compliance.members import NONE, Members, released
from synth.motion.closure import ClosureEquations
from synth.motion.linkage import PosedLinkage
from synth.moving.made import Movable, configuration_of

__all__ = ["Corner", "angles_left", "limits"]


@dataclass(frozen=True, slots=True)
class Corner:
    """The two links of a joint and the ride-along on it, seen from where their four axes meet.

    Attributes
    ----------
    base : (float, float)
        From the joint to the axis of the ride-along on the first and on the second link.
    links : (float, float)
        From these axes to the middle one: the links of the ride-along.
    parallel : bool
        Whether the axes are parallel: the four numbers are lengths. Else they are angles, radians.
    """

    base: tuple[float, float]
    links: tuple[float, float]
    parallel: bool = False

    def cosines(self) -> tuple[float, float]:
        """Return the cosines of the angle between the base links at which the ride-along is stretched and folded.

        What is not between -1 and 1 is not reached. Law of cosines, in the plane or on the sphere.
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


def angles_left(corner: Corner, angle: float) -> tuple[End | None, End | None]:
    """Return the ends of the range of the angle between two links that a ride-along on them leaves.

    The angle is that between the base links now, radians from 0 to 2 pi: from the first axis to the second about
    the joint. Returns the lower and the upper end, with angles less than a turn from it; None where a full turn is
    left.
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


def limits(thing: Movable, keep: Collection[LinkId] = ()) -> Limits:
    """Say what range of angles the ride-alongs of a mechanism leave, and what remains where they are straight.

    Parameters
    ----------
    thing : Mechanism or PosedLinkage
        With coordinates; of a sheet with several frames the first that has them.
    keep : collection of link ids, optional
        Links that are not taken for those of a ride-along: of two four-bars with a joint in common either may be.

    Raises
    ------
    InvariantError
        If a link to keep is none.
    UnsolvableError
        If it has no coordinates, its loops are not closed, or it has no ride-alongs.

    Examples
    --------
    >>> from synth.patterns import generate
    >>> found = limits(generate("deployable-cylinder", pleats=3).mechanism)
    >>> found, found.truss.freedoms
    (<Limits: 6 ride-alongs>, 0)
    """
    at = configuration_of(thing)
    linkage = at.linkage
    steps = [step for step in reduce(linkage.graph, keep=keep).steps if step.joint is not None]
    if not steps:
        raise UnsolvableError("there are no ride-alongs: expected two binary links on two adjacent ones")
    middles = Members(tuple(step.joints[1] for step in steps))
    tolerances = Tolerances.of(at.precision.size)
    return Limits(at, tuple(_ride_alongs(linkage, steps, tolerances)), _truss(linkage, middles))


def _ride_alongs(linkage: PosedLinkage, steps: list[ReductionStep], tolerances: Tolerances) -> Iterator[RideAlong]:
    place = {joint: number for number, joint in enumerate(linkage.graph.joints)}
    for step in steps:
        assert step.joint is not None
        joint = place[step.joint]
        first, middle, last = (place[one] for one in step.joints)
        forwards = linkage.graph.joints[step.joint][0] == step.onto[0]
        corner, angle = _corner(linkage, (joint, first, middle, last), tolerances)
        now = float(linkage.angles[joint])
        ends = angles_left(corner, angle)
        turned = [None if end is None else _at_joint(end, now, angle, forwards=forwards) for end in ends]
        lower, upper = turned if forwards else turned[::-1]
        state = state_of(linkage, Members((step.joints[1],)), NONE)
        yield RideAlong(step.joints, step.joint, now, lower, upper, state.freedoms)


def _at_joint(end: End, now: float, angle: float, *, forwards: bool) -> End:
    """Return an end of the range of the angle between links as one of the joint's angle."""
    way = 1.0 if forwards else -1.0
    return End(now + way * (end.angle - angle), end.how)


def _corner(
    linkage: PosedLinkage, places: tuple[int, int, int, int], tolerances: Tolerances
) -> tuple[Corner, float]:
    """Return the corner of a joint and the three of a ride-along, and the angle of its base links, 0 to 2 pi."""
    points, axes = linkage.points[list(places)], linkage.directions[list(places)]
    parallel = float(np.abs(np.cross(axes, axes[0])).max()) <= tolerances.parallel
    rays = points - points[0] if parallel else _rays(points, axes, tolerances.same_point)
    along = axes[0]
    if parallel:
        rays = rays - np.outer(rays @ along, along)
        corner = Corner(*_pairs(rays, lambda a, b: float(np.linalg.norm(a - b))), parallel=True)
    else:
        corner = Corner(*_pairs(rays, lambda a, b: float(angles_between(a, b))))
    one, other = (ray - (ray @ along) * along for ray in (rays[1], rays[3]))
    return corner, atan2(float(np.cross(one, other) @ along), float(one @ other)) % tau


def _rays(points: Floats, axes: Floats, same: float) -> Floats:
    """Return unit vectors along axes from where they meet, towards their points where these lie off it."""
    out = ((points - lines_meet(points, axes).point) * axes).sum(axis=1)
    return np.asarray(axes * np.where(np.abs(out) > same, np.sign(out), 1.0)[:, None])


def _pairs(
    rays: Floats, apart: Callable[[Floats, Floats], float]
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return how far axes are apart: of both base links, and of both links of the ride-along."""
    joint, first, middle, last = rays
    return (apart(joint, first), apart(joint, last)), (apart(first, middle), apart(middle, last))


def _truss(linkage: PosedLinkage, middles: Members) -> Truss:
    """Return what is left of a linkage with all ride-alongs rigid, as they are where they are straight."""
    left = released(linkage, middles, NONE)
    closure = ClosureEquations(left)
    rank = spectrum(closure.at(left.angles)[1].toarray(), DOUBLE.derivative).rank
    redundant = None if rank is None else closure.rows - rank
    freedoms = state_of(linkage, middles, NONE).freedoms
    return Truss(middles.joints, len(left.graph), len(left.angles), rank, redundant, freedoms)
