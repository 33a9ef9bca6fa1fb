"""A linkage on a cone or a cylinder, as it is given: a chain with its links' sizes, or steps between joint axes.

How it lies on surfaces is worked out in ``synth.surfaces``. Theory: docs/theory/multiloop.md.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import degrees, isfinite, pi, remainder, tau
from typing import Literal

from graphs.errors import InvariantError, shown
from graphs.ids import JointId
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.surfaces import Cylinder, Surface

__all__ = ["Pair", "SurfaceLinkage", "as_planar", "places_of_steps", "ring"]

Pair = tuple[JointId, JointId]
"""Two joints of one link."""


@dataclass(frozen=True, slots=True, repr=False)
class SurfaceLinkage:
    """A linkage whose joint axes are ruling lines of a cone or a cylinder: a developable mechanism.

    It is given by the sizes of its links, link angles of a spherical linkage or lengths of a planar one, which
    tell the surfaces; or by steps round a surface.

    Attributes
    ----------
    chain : SCGraph
        On a cylinder all its loops have their centre at infinity.
    angles : mapping of (joint, joint) to float, or None
        Link angles, radians: on a cone.
    steps : mapping of (joint, joint) to float, or None
        Signed projected angles, radians; they lead to every joint.
    surface : Cone, Cylinder or None
        With steps, where it is known.
    lengths : mapping of (joint, joint) to float, or None
        Distances of joints, any one unit: on a cylinder.

    Examples
    --------
    >>> chain = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
    >>> SurfaceLinkage(chain, steps={(0, 1): 1.0, (1, 2): 0.5, (0, 3): -1.0}).places()
    [0.0, 1.0, 1.5, -1.0]
    """

    chain: SCGraph
    angles: Mapping[Pair, float] | None = None
    steps: Mapping[Pair, float] | None = None
    surface: Surface | None = None
    lengths: Mapping[Pair, float] | None = None

    @classmethod
    def loop(cls, sizes: Sequence[float], kind: Literal["cone", "cylinder"] = "cone") -> SurfaceLinkage:
        """Return one loop of links: link i, counted from 1, lies between joints i and i + 1.

        Parameters
        ----------
        sizes : float[n]
            In loop order: link angles, radians; on a cylinder lengths.
        kind : {"cone", "cylinder"}, optional

        Raises
        ------
        InvariantError
            If a link angle is none between two axes, or a length is not positive.

        Examples
        --------
        >>> linkage = SurfaceLinkage.loop([2.1, 1.7, 0.8, 1.5])
        >>> linkage.chain, linkage.angles[("2", "3")]
        (<SCGraph: 4 links, 4 joints, 1 centre>, 1.7)
        >>> SurfaceLinkage.loop([4, 3, 5, 1], "cylinder").lengths[("3", "4")]
        5.0
        """
        for number, size in enumerate(sizes, start=1):
            if kind == "cone" and not 0.0 < size < pi:
                told = f"link angle {number} is {degrees(size):.12g} degrees"
                raise InvariantError("link angle", told, "the angle between two axes, between 0 and 180")
            if not (size > 0.0 and isfinite(size)):
                raise InvariantError("length", f"length {number} is {size:.12g}", "a length above 0")
        chain = ring(len(sizes))
        joints = list(chain.joints)
        after = [*joints[1:], joints[0]]
        given = dict(zip(zip(joints, after, strict=True), map(float, sizes), strict=True))
        return cls(chain, angles=given) if kind == "cone" else cls(as_planar(chain), lengths=given)

    @classmethod
    def placed(cls, chain: SCGraph, places: Sequence[float], surface: Surface | None = None) -> SurfaceLinkage:
        """Return a linkage whose joints lie at given azimuths, by the steps from each joint to the next.

        Parameters
        ----------
        chain : SCGraph
        places : float[J]
            Azimuths of the joints, radians, in the order of the chain's joints.
        surface : Cone or Cylinder, optional

        Examples
        --------
        >>> SurfaceLinkage.placed(ring(3), [0.0, 1.5, 1.0]).steps
        {('1', '2'): 1.5, ('2', '3'): -0.5}
        """
        steps = (_shorter_way(float(b) - float(a)) for a, b in pairwise(places))
        if isinstance(surface, Cylinder):
            chain = as_planar(chain)
        return cls(chain, steps=dict(zip(pairwise(chain.joints), steps, strict=True)), surface=surface)

    @property
    def kind(self) -> Literal["cone", "cylinder"]:
        """Whether it lies on cones or on cylinders; steps alone, where no centre is at infinity, on cones."""
        planar = bool(self.chain.loops) and all(loop.centre is Centre.INFINITE for loop in self.chain.loops)
        if self.lengths is not None or isinstance(self.surface, Cylinder):
            return "cylinder"
        return "cylinder" if planar and self.angles is None and self.surface is None else "cone"

    @property
    def sizes(self) -> Mapping[Pair, float] | None:
        """The link angles, or the lengths."""
        return self.lengths if self.angles is None else self.angles

    def __repr__(self) -> str:
        given = "steps between its axes"
        if self.steps is None:
            given = "link angles" if self.lengths is None else "lengths"
        return f"<SurfaceLinkage: {self.chain!r}, {given}>"

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


def as_planar(chain: SCGraph) -> SCGraph:
    """Return a chain with the centres of all loops at infinity: all axes are parallel.

    >>> as_planar(ring(4)).loops[0].centre.value
    'infinite'
    """
    return chain.with_loops([replace(loop, centre=Centre.INFINITE) for loop in chain.loops])


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
