"""Solids hinged at edges: a linkage by the axes of its joints in space, at one configuration.

How it moves is worked out in ``synth.moving``. Theory: docs/theory/moving.md.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import hypot
from types import MappingProxyType

from graphs.errors import InvariantError, numbered, shown
from graphs.limits import LEAST, MOST, check_extent, in_reach
from graphs.mechanism.sc import SCGraph
from graphs.types import JointId, LinkId

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

    def __repr__(self) -> str:
        links, joints = numbered(len(self.chain), "link"), numbered(len(self.axes), "joint")
        return f"<HingedSolids: {links}, {joints}>"


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
