"""SDF: the links of a model and all its joints, loops too.

*SDFormat specification*: poses are relative to the model, or to the link, joint or frame that they name.
"""

from pathlib import Path
from xml.etree.ElementTree import Element

import numpy as np

from graphs.errors import shown
from graphs.files.robots.reading import IDENTITY, WORLD, Frame, Robot, composed, of_rpy, xml_of
from graphs.joints.linkage import JointedLinkage, JointKind
from graphs.mechanism.solids import HingedSolids

_KINDS = {
    "revolute": JointKind.REVOLUTE, "continuous": JointKind.REVOLUTE, "prismatic": JointKind.PRISMATIC,
    "ball": JointKind.SPHERICAL, "universal": JointKind.UNIVERSAL, "fixed": None,
}  # fmt: skip
_MODEL = "__model__"
_KNOWN = {"link", "joint", "frame", "pose", "static", "self_collide", "allow_auto_disable", "plugin", "enable_wind"}
"""Elements of models that are read, or have nothing to do with joints."""


def read_sdf(path: Path) -> HingedSolids | JointedLinkage:
    """Return the mechanism of the model of a file of Gazebo."""
    root, robot = xml_of(path, "sdf"), Robot(path)
    models = root.findall("model") or root.findall("world/model")
    if len(models) != 1:
        robot.fail("", f"{len(models)} models", "1")
    (model,) = models
    robot.unread.update(f"<{element.tag}> in the model" for element in model if element.tag not in _KNOWN)
    robot.unread["static model"] += (model.findtext("static") or "").strip() in ("true", "1")
    robot.unread = +robot.unread
    for link in model.findall("link"):
        robot.add_body(link.get("name", ""))
    frames = _Frames(robot, model)
    for joint in model.findall("joint"):
        _add(robot, joint, frames)
    return robot.mechanism()


class _Frames:
    """Where links, joints and frames of a model are."""

    def __init__(self, robot: Robot, model: Element) -> None:
        self._robot, self._placed = robot, {_MODEL: IDENTITY, "": IDENTITY, WORLD: IDENTITY}
        self._own: dict[str, Element] = {}
        for tag in ("link", "joint", "frame"):
            self._own |= {element.get("name", ""): element for element in model.findall(tag)}

    def of(self, name: str) -> Frame:
        """Return the frame of a name, those that it is relative to first."""
        chain: list[str] = []
        while name not in self._placed:
            if name not in self._own or name in chain:
                self._robot.fail(f"frame {shown(name)}", "no such frame, or one relative to itself", "a frame")
            chain.append(name)
            name = self._base(self._own[name])
        for inner in reversed(chain):
            pose = self._own[inner].find("pose")
            text = None if pose is None else pose.text
            numbers = self._robot.numbers(text, 6, f"<pose> of {shown(inner)}", "0 0 0 0 0 0")
            here = (of_rpy(numbers[3:]), numbers[:3])
            self._placed[inner] = composed(self._placed[self._base(self._own[inner])], here)
        return self._placed[chain[0] if chain else name]

    def _base(self, element: Element) -> str:
        """Return the name of the frame in which the pose of an element is."""
        pose = element.find("pose")
        named = "" if pose is None else pose.get("relative_to", "")
        if named or element.tag == "link":
            return named
        child = element.find("child")
        return element.get("attached_to", "") if element.tag == "frame" else "" if child is None else child.text or ""


def _add(robot: Robot, joint: Element, frames: _Frames) -> None:
    name, word = joint.get("name", ""), joint.get("type", "")
    place = f"joint {shown(name)}"
    if word not in _KINDS:
        robot.fail(place, f"the type {shown(word)}", f"one of {', '.join(_KINDS)}")
    parent, child = ((joint.findtext(tag) or "").strip() for tag in ("parent", "child"))
    for end in (parent, child):
        if end not in robot.bodies and end != WORLD:
            robot.fail(place, f"there is no link {shown(end)}", "the name of one")
    kind, frame = _KINDS[word], frames.of(name)
    if kind is None:
        robot.fixed.append((parent, child))
        return
    axes = []
    for tag in ("axis", "axis2")[: kind.axes]:
        element = joint.find(f"{tag}/xyz")
        numbers = robot.numbers(None if element is None else element.text, 3, place, "0 0 1")
        within = "" if element is None else element.get("expressed_in", "")
        axes.append((frames.of(within)[0] if within else frame[0]) @ numbers)
    robot.add_joint(name, kind, (parent, child), np.asarray(frame[1]), tuple(axes))
