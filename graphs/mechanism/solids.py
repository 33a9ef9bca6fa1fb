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
from graphs.types import JointId

Vector = tuple[float, float, float]
Axis = tuple[Vector, Vector]
"""A point of a joint axis and its direction."""


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

    Raises
    ------
    InvariantError
        If a joint has no axis, an axis no direction, or a number is not finite.

    Examples
    --------
    >>> HingedSolids(SCGraph(2, [(0, 1)]), {0: ((0, 0, 0), (0, 0, 1))})  # a door
    <HingedSolids: 2 links, 1 joint>
    """

    chain: SCGraph
    axes: Mapping[JointId, Axis]
    notes: tuple[str, ...] = field(default=(), compare=False)

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
        object.__setattr__(self, "axes", MappingProxyType(checked))

    def __repr__(self) -> str:
        links, joints = numbered(len(self.chain), "link"), numbered(len(self.axes), "joint")
        return f"<HingedSolids: {links}, {joints}>"


def _vector(joint: JointId, numbers: Sequence[float]) -> Vector:
    if len(numbers) != 3 or not in_reach(numbers):
        wrong = f"the axis of joint {shown(joint)} has {shown(list(numbers))}"
        raise InvariantError("axis", wrong, f"three numbers, none beyond {MOST:g}", ("axes", joint))
    return (float(numbers[0]), float(numbers[1]), float(numbers[2]))
