"""A linkage on a cone, as it is given: a chain with link angles, or with steps between its joint axes.

How it lies on cones is worked out in ``synth.surfaces``. Theory: docs/theory/multiloop.md.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import degrees, pi, remainder, tau

from graphs.errors import InvariantError, shown
from graphs.ids import JointId
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph

__all__ = ["ConicalLinkage", "Pair", "places_of_steps", "ring"]

Pair = tuple[JointId, JointId]
"""Two joints of one link."""


@dataclass(frozen=True, slots=True, repr=False)
class ConicalLinkage:
    """A linkage whose joint axes are ruling lines of a cone.

    Attributes
    ----------
    chain : SCGraph
    angles : mapping of (joint, joint) to float, or None
        Link angles, radians.
    steps : mapping of (joint, joint) to float, or None
        Signed projected angles, radians; they lead to every joint.
    cone_angle : float or None
        lambda, radians, where the file gives one.

    Examples
    --------
    >>> chain = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
    >>> ConicalLinkage(chain, steps={(0, 1): 1.0, (1, 2): 0.5, (0, 3): -1.0}).places()
    [0.0, 1.0, 1.5, -1.0]
    """

    chain: SCGraph
    angles: Mapping[Pair, float] | None = None
    steps: Mapping[Pair, float] | None = None
    cone_angle: float | None = None

    @classmethod
    def loop(cls, angles: Sequence[float]) -> ConicalLinkage:
        """Return one loop of link angles: link i, counted from 1, lies between joints i and i + 1.

        Parameters
        ----------
        angles : float[n]
            Link angles in loop order, radians.

        Raises
        ------
        InvariantError
            If a link angle is none between two axes.

        Examples
        --------
        >>> linkage = ConicalLinkage.loop([2.1, 1.7, 0.8, 1.5])
        >>> linkage.chain, linkage.angles[("2", "3")]
        (<SCGraph: 4 links, 4 joints, 1 centre>, 1.7)
        """
        for number, angle in enumerate(angles, start=1):
            if not 0.0 < angle < pi:
                told = f"link angle {number} is {degrees(angle):.12g} degrees"
                raise InvariantError("link angle", told, "the angle between two axes, between 0 and 180")
        chain = ring(len(angles))
        joints = list(chain.joints)
        after = [*joints[1:], joints[0]]
        return cls(chain, angles=dict(zip(zip(joints, after, strict=True), map(float, angles), strict=True)))

    @classmethod
    def placed(cls, chain: SCGraph, places: Sequence[float], cone_angle: float | None = None) -> ConicalLinkage:
        """Return a linkage whose joints lie at given azimuths, by the steps from each joint to the next.

        Parameters
        ----------
        chain : SCGraph
        places : float[J]
            Azimuths of the joints, radians, in the order of the chain's joints.
        cone_angle : float, optional
            lambda, radians.

        Examples
        --------
        >>> ConicalLinkage.placed(ring(3), [0.0, 1.5, 1.0]).steps
        {('1', '2'): 1.5, ('2', '3'): -0.5}
        """
        steps = (_shorter_way(float(b) - float(a)) for a, b in pairwise(places))
        return cls(chain, steps=dict(zip(pairwise(chain.joints), steps, strict=True)), cone_angle=cone_angle)

    def __repr__(self) -> str:
        given = "link angles" if self.steps is None else "steps between its axes"
        return f"<ConicalLinkage: {self.chain!r}, {given}>"

    def places(self) -> list[float]:
        """Return the azimuths of the joints, radians, in the order of the chain's joints.

        Raises
        ------
        InvariantError
            If the steps disagree, or do not lead to every joint.
        """
        placed = places_of_steps(self.steps or {})
        return [placed[joint] for joint in self.chain.joints]


def _shorter_way(step: float) -> float:
    """Return a step in (-pi, pi]."""
    turned = remainder(step, tau)
    return pi if turned <= -pi + 1e-15 else turned


def ring(links: int) -> SCGraph:
    """Return a loop whose link i lies between joints i and i + 1, counted from 1.

    >>> dict(ring(4).joints)
    {'1': (4, 1), '2': (1, 2), '3': (2, 3), '4': (3, 4)}
    """
    joints = {str(i + 1): ((i - 1) % links + 1, i + 1) for i in range(links)}
    return SCGraph(range(1, links + 1), joints, [Loop(tuple(joints))])


def places_of_steps(steps: Mapping[Pair, float], tolerance: float = 1e-7) -> dict[JointId, float]:
    """Return the azimuths of joints from signed steps between pairs of them.

    A step is the projected angle from the first joint to the second, radians; the first joint named is at 0.
    Raises `InvariantError` if steps that lead to one joint two ways disagree by more than the tolerance, or leave
    joints unconnected.

    >>> places_of_steps({("O", "A"): -0.5, ("B", "A"): 0.25}) == {"O": 0.0, "A": -0.5, "B": -0.75}
    True
    """
    placed: dict[JointId, float] = {}
    left = dict(steps)
    if left:
        placed[next(iter(left))[0]] = 0.0
    while left:
        ready = next((pair for pair in left if pair[0] in placed or pair[1] in placed), None)
        if ready is None:
            a, b = next(iter(left))
            raise InvariantError(
                "steps", f"no steps lead from joint {shown(next(iter(placed)))} to {shown(a)}", "connected steps"
            )
        (a, b), step = ready, left.pop(ready)
        if a not in placed:
            placed[a] = placed[b] - step
        elif b not in placed:
            placed[b] = placed[a] + step
        elif abs(off := remainder(placed[a] + step - placed[b], tau)) > tolerance:
            raise InvariantError(
                "steps",
                f"the step from {shown(a)} to {shown(b)} misses by {degrees(off):.6g} degrees",
                "steps that agree",
            )
    return placed
