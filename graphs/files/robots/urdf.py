"""URDF: a tree of links with all joints at zero, and the loops that a file of JSON beside it has.

*URDF XML specification*, ROS wiki. The file beside ``arm.urdf`` is ``arm.loops.json``, as
`synth.making.simulation.urdf` writes it.
"""

from pathlib import Path
from typing import Any
from xml.etree.ElementTree import Element

import numpy as np

from graphs.errors import shown
from graphs.files.robots.reading import IDENTITY, WORLD, Frame, Robot, composed, of_rpy, xml_of
from graphs.files.text import load_json
from graphs.joints.linkage import JointedLinkage, JointKind
from graphs.mechanism.solids import HingedSolids

_KINDS = {
    "revolute": JointKind.REVOLUTE, "continuous": JointKind.REVOLUTE, "prismatic": JointKind.PRISMATIC,
    "planar": JointKind.PLANAR, "fixed": None, "floating": None,
}  # fmt: skip
_KNOWN = {"link", "joint", "material", "transmission", "gazebo", "mujoco", "sensor"}
"""Elements of robots that are read, or have nothing to do with joints."""


def read_urdf(path: Path) -> HingedSolids | JointedLinkage:
    """Return the mechanism of a file of URDF."""
    root, robot = xml_of(path, "robot"), Robot(path)
    for link in root.findall("link"):
        robot.add_body(link.get("name", "") if link.get("name") != WORLD else f"{WORLD} link")
    carried: dict[str, tuple[str, Element]] = {}
    for joint in root.findall("joint"):
        parent, child = (_end(robot, joint, tag) for tag in ("parent", "child"))
        if child in carried:
            robot.fail(f"joint {shown(joint.get('name', ''))}", f"link {shown(child)} hangs on two joints", "a tree")
        carried[child] = (parent, joint)
    frames = _frames(robot, carried)
    for child, (parent, joint) in carried.items():
        _add(robot, joint, (parent, child), frames[child])
    beside = path.with_suffix(".loops.json")
    if beside.is_file():
        _add_loops(robot, load_json(beside), frames, beside)
    else:
        robot.unread["mimic joint"] += len(root.findall("joint/mimic"))
    robot.unread.update(f"<{element.tag}>" for element in root if element.tag not in _KNOWN)
    robot.unread = +robot.unread
    return robot.mechanism()


def _end(robot: Robot, joint: Element, tag: str) -> str:
    element = joint.find(tag)
    name = "" if element is None else element.get("link", "")
    name = f"{WORLD} link" if name == WORLD else name
    if name not in robot.bodies:
        robot.fail(f"joint {shown(joint.get('name', ''))}", f"no <{tag}> {shown(name)}", "the name of a link")
    return name


def _frames(robot: Robot, carried: dict[str, tuple[str, Element]]) -> dict[str, Frame]:
    """Return where links are, from those that hang on nothing."""
    hanging: dict[str, list[str]] = {}
    for child, (parent, _) in carried.items():
        hanging.setdefault(parent, []).append(child)
    frames = {name: IDENTITY for name in robot.bodies if name not in carried}
    waiting = list(frames)
    while waiting:
        parent = waiting.pop()
        for child in hanging.get(parent, ()):
            frames[child] = composed(frames[parent], _origin(robot, carried[child][1]))
            waiting.append(child)
    missing = [name for name in robot.bodies if name not in frames]
    if missing:
        robot.fail(f"link {shown(missing[0])}", "a loop of joints", "a tree; loops are in a file beside it")
    return frames


def _origin(robot: Robot, joint: Element) -> Frame:
    origin = joint.find("origin")
    attributes = {} if origin is None else origin.attrib
    place = f"joint {shown(joint.get('name', ''))}"
    angles = robot.numbers(attributes.get("rpy"), 3, place, "0 0 0")
    return of_rpy(angles), robot.numbers(attributes.get("xyz"), 3, place, "0 0 0")


def _add(robot: Robot, joint: Element, ends: tuple[str, str], frame: Frame) -> None:
    name, word = joint.get("name", ""), joint.get("type", "")
    if word not in _KINDS:
        robot.fail(f"joint {shown(name)}", f"the type {shown(word)}", f"one of {', '.join(_KINDS)}")
    kind = _KINDS[word]
    if kind is None:
        if word == "fixed":
            robot.fixed.append(ends)
        return
    axis = joint.find("axis")
    text = None if axis is None else axis.get("xyz")
    robot.add_joint(name, kind, ends, frame[1], (frame[0] @ robot.numbers(text, 3, f"joint {shown(name)}", "1 0 0"),))


def _add_loops(robot: Robot, value: Any, frames: dict[str, Frame], path: Path) -> None:
    """Add the hinges that a file of JSON has beside a tree."""
    beside = Robot(path)
    if not isinstance(value, dict) or value.get("format") != "synthedra/loops" or value.get("version") != 1:
        beside.fail("", "not the loops of a tree", "'synthedra/loops', version 1")
    loops = value.get("loops")
    for number, loop in enumerate(loops if isinstance(loops, list) else beside.fail("loops", shown(loops), "a list")):
        place = f"loops[{number}]"
        try:
            first, second = loop["links"]
            joint, points, axis = str(loop["joint"]), loop["points"], loop["axis"]
            along = np.array(axis, dtype=float).reshape(3)
            point = np.array(points[0], dtype=float).reshape(3)
        except (KeyError, TypeError, ValueError, IndexError):
            beside.fail(place, "not a loop", "joint, links, points and axis")
        if first not in frames or second not in frames or not np.isfinite([*along, *point]).all():
            beside.fail(place, f"links {shown([first, second])}", "links of the tree, and finite numbers")
        rotation, _ = frames[first]
        robot.add_joint(
            joint,
            JointKind.REVOLUTE,
            (first, second),
            composed(frames[first], (np.eye(3), point))[1],
            (rotation @ along,),
        )
