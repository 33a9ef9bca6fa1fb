"""Solids hinged at edges: a linkage by the axes of its joints in space, at one configuration.

How it moves is worked out in ``synth.analysis.moving``. Theory: docs/theory/moving.md.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import hypot
from types import MappingProxyType
from typing import Any

import numpy as np

from graphs.errors import InvariantError, numbered, shown
from graphs.input_limits import LEAST, MOST, check_extent, in_reach
from graphs.mechanism.sc import SCGraph
from graphs.tolerances import DOUBLE, MARGIN
from graphs.types import Floats, JointId, LinkId

Vector = tuple[float, float, float]
Axis = tuple[Vector, Vector]
"""A point of a joint axis and its direction."""


@dataclass(frozen=True, slots=True)
class LinkShape:
    """A closed plane-faced solid of a link, in the unit of the axes, at the configuration of the axes.

    Attributes
    ----------
    link : link id
    name : str
    corners : tuple of (float, float, float)
    triangles : tuple of (int, int, int)
        Places of corners, counter-clockwise seen from outside.

    Examples
    --------
    >>> corners = ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))
    >>> LinkShape(0, "wedge", corners, ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))).link
    0
    """

    link: LinkId
    name: str
    corners: tuple[Vector, ...]
    triangles: tuple[tuple[int, int, int], ...]


@dataclass(frozen=True, slots=True, repr=False)
class HingedSolids:
    """Links of any shape, and the axes of the hinges between them at one configuration.

    Parameters
    ----------
    chain : SCGraph
        Links and joints. Loops may have a centre; their axes meet there, or are parallel.
    axes : mapping of joint id to (point, direction)
        Three coordinates each, any unit of length. A positive angle of a joint turns its second link against its
        first, right-handed about the direction.
    notes : tuple of str, optional
        What a file had that was not read.
    shapes : tuple of LinkShape, optional
        Solids of links, where they are known.

    Raises
    ------
    InvariantError
        If a joint has no axis, an axis no direction, a number is not finite, or a shape is of no link, or has a
        triangle without a corner.

    Examples
    --------
    >>> HingedSolids(SCGraph(2, [(0, 1)]), {0: ((0, 0, 0), (0, 0, 1))})  # a door
    <HingedSolids: 2 links, 1 joint>
    """

    chain: SCGraph
    axes: Mapping[JointId, Axis]
    notes: tuple[str, ...] = field(default=(), compare=False)
    shapes: tuple[LinkShape, ...] = field(default=(), compare=False)

    def __post_init__(self) -> None:
        checked: dict[JointId, Axis] = {}
        for joint in self.axes:
            if joint not in self.chain.joints:
                raise InvariantError("axis", f"{shown(joint)} is no joint", "a joint id", ("axes", joint))
        for joint in self.chain.joints:
            if joint not in self.axes:
                raise InvariantError("axis", f"joint {shown(joint)} has no axis", "one for each joint")
            point, direction = (_vector(joint, one) for one in self.axes[joint])
            if not LEAST <= hypot(*direction) <= MOST:
                wrong = f"the axis of joint {shown(joint)} has the direction {shown(list(direction))}"
                raise InvariantError("axis", wrong, "a vector that is not zero", ("axes", joint))
            checked[joint] = (point, direction)
        check_extent([point for point, _ in checked.values()])
        for place, shape in enumerate(self.shapes):
            _check_shape(self.chain, shape, place)
        object.__setattr__(self, "axes", MappingProxyType(checked))

    @property
    def flat_panels(self) -> bool:
        """Whether links are solid panels side by side: all have shapes, all axes are level (along z = constant)."""
        solid = {shape.link for shape in self.shapes} >= set(self.chain.nodes)
        return solid and all(abs(axis[2]) <= DOUBLE.parallel * hypot(*axis) for _, axis in self.axes.values())

    def senses(self) -> dict[JointId, int]:
        """Return the sense in which each hinge of flat panels can turn: 1 for positive angles, -1 for negative ones.

        Where most material of both links at the hinge lies below the axis they fold upwards, where it lies above it
        downwards. It is 0 where neither is so, or no solid reaches the axis.

        Examples
        --------
        >>> import synth
        >>> thick = synth.thicken(synth.generate("miura").mechanism, thickness=0.05, collisions=False)
        >>> [thick.solids.senses()[joint] for joint in (1, 5)] == [1 if j in thick.valleys else -1 for j in (1, 5)]
        True
        """
        rings = {link: np.zeros((0, 3, 3)) for link in self.chain.nodes}
        for shape in self.shapes:
            solid = np.array(shape.corners, dtype=float)[np.array(shape.triangles)]
            rings[shape.link] = np.concatenate([rings[shape.link], solid])
        return {
            joint: _sense(*(_beside_axis(self.axes[joint], rings[link]) for link in links))
            for joint, links in self.chain.joints.items()
        }

    def __reduce__(self) -> tuple[Any, ...]:
        return HingedSolids, (self.chain, dict(self.axes), self.notes, self.shapes)

    def __repr__(self) -> str:
        links, joints = numbered(len(self.chain), "link"), numbered(len(self.axes), "joint")
        return f"<HingedSolids: {links}, {joints}>"


def _sense(first: tuple[int, int], second: tuple[int, int]) -> int:
    """Return the sense in which a hinge can turn, by where the material of its links is: (below or above, side)."""
    return -second[0] * second[1] if first[0] == second[0] else 0


def _beside_axis(axis: Axis, triangles: Floats) -> tuple[int, int]:
    """Return whether most material of a link at a level axis is below it, -1, or above, 1; and on which side of it.

    The side is 1 if a positive angle lifts it. Triangles are float[n, 3, 3].
    """
    point, direction = np.array(axis[0]), np.array(axis[1])
    along = direction / np.linalg.norm(direction)
    towards = triangles - point
    across, heights, ends = towards @ np.array([-along[1], along[0], 0.0]), towards[..., 2], towards @ along
    reach = DOUBLE.meant * float(np.abs(towards).max(initial=0.0))
    upright = np.abs(across) <= reach
    walls = upright.all(axis=1)
    on = upright & (np.abs(heights) <= reach)
    # Faces in the upright plane through the axis; a riser of another hinge may stand at an end of this one.
    middles = ends.mean(axis=1)
    there = walls & (middles > ends[on].min(initial=np.inf)) & (middles < ends[on].max(initial=-np.inf))
    if not there.any():  # where a strip is laid in along the axis, material begins beside it
        there, on = walls, upright
    sides = towards[there]
    areas = np.linalg.norm(np.cross(sides[:, 1] - sides[:, 0], sides[:, 2] - sides[:, 0]), axis=1)
    # A riser of another hinge, as wide as the panel is thick, may reach the axis on the other side near a vertex.
    above = float((areas * np.sign(heights[there].mean(axis=1))).sum())
    level = int(np.sign(above)) if abs(above) > MARGIN * areas.sum() else 0
    return level, int(np.sign(across[on.any(axis=1)].sum()))


def _check_shape(chain: SCGraph, shape: LinkShape, place: int) -> None:
    """Refuse the shape of a link that is not there, numbers that are not finite, and corners that are not there."""
    if shape.link not in chain.nodes:
        raise InvariantError("shape", f"{shown(shape.link)} is no link", "a link", ("shapes", place))
    for corner in shape.corners:
        if len(corner) != 3 or not in_reach(corner):
            wrong = f"a shape of link {shown(shape.link)} has the corner {shown(list(corner))}"
            raise InvariantError("shape", wrong, f"three numbers, none beyond {MOST:g}", ("shapes", place))
    for triangle in shape.triangles:
        if len(set(triangle)) != 3 or not all(0 <= corner < len(shape.corners) for corner in triangle):
            wrong = f"a shape of link {shown(shape.link)} has the triangle {shown(list(triangle))}"
            expected = f"three of its {numbered(len(shape.corners), 'corner')}"
            raise InvariantError("shape", wrong, expected, ("shapes", place))


def _vector(joint: JointId, numbers: Sequence[float]) -> Vector:
    if len(numbers) != 3 or not in_reach(numbers):
        wrong = f"the axis of joint {shown(joint)} has {shown(list(numbers))}"
        raise InvariantError("axis", wrong, f"three numbers, none beyond {MOST:g}", ("axes", joint))
    return (float(numbers[0]), float(numbers[1]), float(numbers[2]))
