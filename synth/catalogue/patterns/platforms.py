"""Platforms by the letters of their legs: UPS, RUS, UUU, SPS, RPS, UPU, CRR. Theory: docs/theory/joints.md."""

from collections.abc import Callable, Iterable, Sequence
from math import cos, isclose, pi, sin

import numpy as np

from graphs.errors import InvariantError
from graphs.geometry import unit
from graphs.joints.linkage import JointedLinkage, JointKind, JointPlace
from graphs.mechanism.sc import SCGraph
from graphs.tolerances import DOUBLE
from graphs.types import Floats, JointId, LinkId
from synth.catalogue.patterns.panels import rounded_vector

_UP = np.array([0.0, 0.0, 1.0])
_THIRD = 2 * pi / 3
_UPRIGHT = 3
"""With so many legs each head is over its foot, and no level direction is across them if the radii are equal."""

Joint = tuple[JointKind, JointPlace]
LegOf = Callable[[Floats, Floats, float], tuple[Joint, ...]]
"""From the foot, the head and how far the knee is out to the joints, from base to top."""


def platform(
    legs: str, number: int, base: float, top: float, height: float, gap: float = 0.0, out: float = 0.0
) -> JointedLinkage:
    """Return a base and a top above it, joined by three or six legs that are alike.

    `legs` are the joints of a leg from the base on; P slides along the leg, U next to it has one axis
    perpendicular to it. Six legs stand in pairs. Raise InvariantError if three legs are upright, so that their
    level axes have no direction.
    """
    if number == _UPRIGHT and isclose(base, top, rel_tol=DOUBLE.same_point):
        what = f"feet and heads both at {base:g}, so that legs stand upright"
        raise InvariantError("platform", what, "different radii of base and top")
    feet, heads = _azimuths(number, gap)
    return _on_legs(
        _LEGS[legs](_on_circle(base, foot, 0.0), _on_circle(top, head, height), out)
        for foot, head in zip(feet, heads, strict=True)
    )


def translating_platform(size: float, bent: float) -> JointedLinkage:
    """Return a platform on three C-R-R legs, each with its axes along an edge of a corner of a cube."""
    legs = []
    for leg in range(3):
        along, first, second = (np.eye(3)[(leg + turn) % 3] for turn in range(3))
        reach = first, first + cos(bent) * first + sin(bent) * second
        points = size * np.array([along, along + reach[0], along + reach[1]])
        legs.append([(JointKind(kind), _place(point, along)) for kind, point in zip("CRR", points, strict=True)])
    return _on_legs(legs)


def _on_legs(legs: Iterable[Sequence[Joint]]) -> JointedLinkage:
    """Return a base and a top joined by legs, each by its joints from the base on."""
    links: list[LinkId] = ["base", "top"]
    joints: dict[JointId, tuple[LinkId, LinkId]] = {}
    kinds: dict[JointId, JointKind] = {}
    places: dict[JointId, JointPlace] = {}
    for leg, leg_joints in enumerate(legs):
        row: list[LinkId] = ["base", *(f"leg{leg}-{part}" for part in range(1, len(leg_joints))), "top"]
        links += row[1:-1]
        for place, (kind, where) in enumerate(leg_joints):
            joint = f"{kind.value}{leg}-{place}"
            joints[joint] = (row[place], row[place + 1])
            kinds[joint], places[joint] = kind, where
    return JointedLinkage(SCGraph(links, joints, ground="base"), kinds, places)


def _azimuths(number: int, gap: float) -> tuple[list[float], list[float]]:
    """Return the azimuths of feet and heads: with six legs, the pairs of heads are between those of the feet."""
    if number == 3:
        return ([k * _THIRD for k in range(3)],) * 2
    sides = [(k, side) for k in range(3) for side in (-1, 1)]
    feet = [k * _THIRD + side * gap / 2 for k, side in sides]
    return feet, [k * _THIRD + side * (_THIRD - gap) / 2 for k, side in sides]


def _with_slide(first: JointKind, last: JointKind) -> LegOf:
    """Return legs with a prismatic joint along them in the middle."""

    def joints_of_leg(foot: Floats, head: Floats, _: float) -> tuple[Joint, ...]:
        along = unit(head - foot)
        level = unit(np.cross(_UP, along))
        across = np.cross(along, level)
        return (
            (first, _place(foot, *_held(first, level, across))),
            (JointKind.PRISMATIC, _place((foot + head) / 2, along)),
            (last, _place(head, *_held(last, level, across)[::-1])),
        )

    return joints_of_leg


def _held(kind: JointKind, level: Floats, across: Floats) -> tuple[Floats, ...]:
    """Return the axes of an end joint, from its end on: the second of a universal joint turns with the leg."""
    return {JointKind.UNIVERSAL: (level, across), JointKind.REVOLUTE: (level,)}.get(kind, ())


def _crank_and_rod(foot: Floats, head: Floats, out: float) -> tuple[Joint, ...]:
    """Return R at the base, U at the knee, S at the top."""
    level, knee = _knee(foot, head, out)
    rod = unit(head - knee)
    turned = unit(np.cross(level, rod))
    return (
        (JointKind.REVOLUTE, _place(foot, level)),
        (JointKind.UNIVERSAL, _place(knee, level, turned)),
        (JointKind.SPHERICAL, _place(head)),
    )


def _three_universal(foot: Floats, head: Floats, out: float) -> tuple[Joint, ...]:
    level, knee = _knee(foot, head, out)
    crank, rod = unit(knee - foot), unit(head - knee)
    return (
        (JointKind.UNIVERSAL, _place(foot, level, np.cross(crank, level))),
        (JointKind.UNIVERSAL, _place(knee, level, np.cross(rod, level))),
        (JointKind.UNIVERSAL, _place(head, np.cross(rod, level), level)),
    )


def _knee(foot: Floats, head: Floats, out: float) -> tuple[Floats, Floats]:
    """Return the level direction across a leg, and its knee, so far out from the middle of foot and head."""
    level = unit(np.cross(_UP, head - foot))
    outwards = unit(np.cross(head - foot, level))
    middle = (foot + head) / 2
    return level, middle + out * (outwards if outwards @ middle > 0.0 else -outwards)


_LEGS: dict[str, LegOf] = {
    "UPS": _with_slide(JointKind.UNIVERSAL, JointKind.SPHERICAL),
    "SPS": _with_slide(JointKind.SPHERICAL, JointKind.SPHERICAL),
    "RPS": _with_slide(JointKind.REVOLUTE, JointKind.SPHERICAL),
    "UPU": _with_slide(JointKind.UNIVERSAL, JointKind.UNIVERSAL),
    "RUS": _crank_and_rod,
    "UUU": _three_universal,
}


def _on_circle(radius: float, azimuth: float, height: float) -> Floats:
    return np.array([radius * cos(azimuth), radius * sin(azimuth), height])


def _place(point: Floats, *axes: Floats) -> JointPlace:
    return JointPlace(rounded_vector(point), tuple(map(rounded_vector, axes)))
