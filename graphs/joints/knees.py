"""Slides that three parallel revolutes stand for: a *knee*, its middle axis at equal arms from the two beside it.

A prismatic joint between two binary links, with axes beyond them that are parallel to each other and across the
slide, moves one end against the other in all ways of a plane; so do three parallel revolutes. Theory:
docs/theory/joints.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from graphs.geometry import frame_about, unit
from graphs.joints.kinds import JointKind
from graphs.joints.linkage import JointedLinkage, legs
from graphs.mechanism.precision import precision_of_axes
from graphs.tolerances import Tolerances
from graphs.types import Floats, JointId

__all__ = ["Knee", "KneeEnd", "knees_of_type", "placed_knees"]

_ENDS = (JointKind.REVOLUTE, JointKind.UNIVERSAL, JointKind.SPHERICAL)


@dataclass(frozen=True, slots=True)
class KneeEnd:
    """A joint beside a slide.

    Attributes
    ----------
    joint : joint id
    place : int
        0 if its first link is beside the slide, 1 if its second is.
    axis : int or None
        Which of its axes is to be across the slide; None of a spherical joint, which has one that way anyhow.
    """

    joint: JointId
    place: int
    axis: int | None


@dataclass(frozen=True, slots=True)
class Knee:
    """A slide, and the joints before and after it."""

    slide: JointId
    ends: tuple[KneeEnd, KneeEnd]


def knees_of_type(linkage: JointedLinkage) -> list[Knee]:
    """Return the slides that knees can stand for, if axes are chosen so; each joint serves one of them.

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> row = SCGraph(4, [(0, 1), (1, 2), (2, 3)])
    >>> [knee.slide for knee in knees_of_type(JointedLinkage(row, {1: JointKind.PRISMATIC}))]
    [1]
    """
    return list(_taken_once(_possible(linkage)))


def placed_knees(linkage: JointedLinkage) -> list[tuple[Knee, Floats]]:
    """Return the slides that knees can stand for as the joints lie, each with the direction of its axes.

    Parameters
    ----------
    linkage : JointedLinkage
        With places.
    """
    points = np.array([place.point for place in linkage.places.values()])
    axes = np.array([axis for place in linkage.places.values() for axis in place.axes]).reshape(-1, 3)
    parallel = Tolerances.of(precision_of_axes(points, axes).size).parallel
    normals = ((knee, _normal(linkage, knee, parallel)) for knee in _possible(linkage))
    fitting = {knee: normal for knee, normal in normals if normal is not None}
    return [(knee, fitting[knee]) for knee in _taken_once(iter(fitting))]


def _possible(linkage: JointedLinkage) -> Iterator[Knee]:
    """Yield the slides that have a joint of the right kind on both sides, binary links between."""
    for leg in legs(linkage.chain):
        for place in range(1, len(leg.joints) - 1):
            before, slide, after = leg.joints[place - 1 : place + 2]
            if linkage.kinds[slide] is JointKind.PRISMATIC:
                ends = _end(linkage, before, leg.links[place]), _end(linkage, after, leg.links[place + 1])
                if all(linkage.kinds[end.joint] in _ENDS for end in ends):
                    yield Knee(slide, ends)


def _end(linkage: JointedLinkage, joint: JointId, beside: object) -> KneeEnd:
    place = 0 if linkage.chain.joints[joint][0] == beside else 1
    axis = {JointKind.UNIVERSAL: place, JointKind.SPHERICAL: None}.get(linkage.kinds[joint], 0)
    return KneeEnd(joint, place, axis)


def _taken_once(knees: Iterator[Knee]) -> Iterator[Knee]:
    serving: set[JointId] = set()
    for knee in knees:
        joints = {end.joint for end in knee.ends}
        if not joints & serving:
            serving |= joints
            yield knee


def _normal(linkage: JointedLinkage, knee: Knee, parallel: float) -> Floats | None:
    """Return the direction across the slide that the axes beside it have in common, None if they have none."""
    slide = unit(linkage.places[knee.slide].axes[0])
    given = [unit(linkage.places[end.joint].axes[end.axis]) for end in knee.ends if end.axis is not None]
    if not given:
        return np.asarray(frame_about(slide)[1])
    if any(abs(one @ slide) > parallel or np.linalg.norm(np.cross(one, given[0])) > parallel for one in given):
        return None
    return given[0]
