"""Joints of all kinds as revolutes and slides in a row: as many elements as freedoms, and no loops of their own.

`graphs.joints.revolutes` has revolutes alone, where the linkage of Sarrus stands for a slide; its own redundant
equation is none of the linkage. Theory: docs/theory/overconstraint.md.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from graphs.answer.mobility_of_joints import with_planar_loops
from graphs.geometry import frame_about
from graphs.joints.linkage import JointedLinkage, JointKind, JointPlace, plain_vector
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import Axis
from graphs.types import JointId, LinkId
from synth.analysis.motion.linkage import Linkage, linkage_of_axes


@dataclass(frozen=True, slots=True)
class SerialLinkage:
    """A linkage of revolutes and slides in a row for each joint: `joint_of` names the joint of each element."""

    linkage: Linkage
    joint_of: dict[JointId, JointId]


def serial_linkage(mechanism: JointedLinkage) -> SerialLinkage:
    """Return a placed linkage with revolutes and slides for its joints; loops that are planar have their centre.

    Parameters
    ----------
    mechanism : JointedLinkage
        With places.
    """
    counted = with_planar_loops(mechanism)
    links: list[LinkId] = list(counted.chain.nodes)
    names = {str(name) for name in (*links, *counted.chain.joints)}
    joints: dict[JointId, tuple[LinkId, LinkId]] = {}
    axes: dict[JointId, Axis] = {}
    slides: list[JointId] = []
    joint_of: dict[JointId, JointId] = {}
    elements: dict[JointId, list[JointId]] = {}
    for joint, (first, last) in counted.chain.joints.items():
        row = list(_row(mechanism.kinds[joint], mechanism.places[joint]))
        ids = [joint] if len(row) == 1 else _new_names(joint, len(row), names)
        ends = [first, *ids[1:], last]  # a link between two elements is called as the element after it
        links += ids[1:]
        elements[joint] = ids
        for name, a, b, (axis, slide) in zip(ids, ends, ends[1:], row, strict=False):
            joints[name], axes[name], joint_of[name] = (a, b), axis, joint
            slides += [name] * slide
    loops = [
        Loop(tuple(one for joint in loop.joints for one in elements[joint]), loop.centre, loop.name, loop.at)
        for loop in counted.chain.loops
        if loop.has_centre
    ]
    graph = SCGraph(links, joints, loops, ground=counted.chain.ground)
    return SerialLinkage(linkage_of_axes(graph, axes, slides=slides), joint_of)


def _row(kind: JointKind, place: JointPlace) -> Iterator[tuple[Axis, bool]]:
    """Yield the elements of a joint: axis or direction, and whether it slides."""
    point = place.point
    if kind is JointKind.SPHERICAL:
        yield from (((point, plain_vector(axis)), False) for axis in np.eye(3))
        return
    if kind is JointKind.PLANAR:
        yield from (((point, plain_vector(way)), True) for way in frame_about(np.array(place.axes[0]))[:2])
    if kind in (JointKind.PRISMATIC, JointKind.CYLINDRICAL):
        yield (point, place.axes[0]), True
    if kind is not JointKind.PRISMATIC:
        yield from (((point, axis), False) for axis in place.axes)


def _new_names(joint: JointId, number: int, names: set[str]) -> list[JointId]:
    """Return names for the elements of a joint that neither links nor joints have."""
    found: list[JointId] = []
    for place in range(1, number + 1):
        name = f"{joint}:{place}"
        while name in names:
            name += "'"
        names.add(name)
        found.append(name)
    return found
