"""What readers of robots share: XML read safely, frames, and bodies with joints made a mechanism."""

from collections import Counter
from dataclasses import dataclass, field
from math import cos, sin
from pathlib import Path
from typing import NoReturn
from xml.etree import ElementTree

import networkx as nx
import numpy as np

from graphs.errors import FileError, numbered, shown
from graphs.files.text import Checker, read_text
from graphs.geometry import rotations, unit
from graphs.input_limits import how_to_raise, most
from graphs.joints.linkage import JointedLinkage, JointKind, JointPlace, plain_vector
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import Axis, HingedSolids
from graphs.types import Floats, JointId

WORLD = "world"
_LARGEST = 1e100  # squares of lengths, summed along a chain of bodies, stay below the largest double, 1.8e308
IDENTITY = (np.eye(3), np.zeros(3))
Frame = tuple[Floats, Floats]
"""Rotation float[3, 3] and origin float[3]."""


def xml_of(path: Path, root: str) -> ElementTree.Element:
    """Return the root of a file of XML; refuse document types, which define entities, and too many elements."""
    text = read_text(path)
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise FileError(path, "", "a document type, which may define entities", "XML without one")
    try:
        element = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        line, column = error.position
        raise FileError(path, f"line {line} column {column + 1}", "not XML", f"<{root}>") from None
    count = sum(1 for _ in element.iter())
    if count > most("nodes"):
        raise FileError(path, "", f"{count} elements", how_to_raise("nodes", count))
    if element.tag != root:
        raise FileError(path, "", f"the element {shown(element.tag)}", f"<{root}>")
    return element


@dataclass
class Robot:
    """Bodies and joints as a reader finds them.

    `joints` are (name, kind, first body, second body, point, axes); `fixed` are pairs of bodies that are one link;
    `unread` counts what is left out.
    """

    path: Path
    bodies: list[str] = field(default_factory=list)
    joints: list[tuple[str, JointKind, str, str, Floats, tuple[Floats, ...]]] = field(default_factory=list)
    fixed: list[tuple[str, str]] = field(default_factory=list)
    unread: Counter[str] = field(default_factory=Counter)

    def fail(self, place: str, found: str, expected: str) -> NoReturn:
        """Raise the error of a place in the file."""
        raise FileError(self.path, place, found, expected)

    def numbers(self, text: str | None, count: int, place: str, default: str | None = None) -> Floats:
        """Return the numbers of an attribute or element, as many as expected."""
        words = (text if text is not None else default or "").split()
        try:
            values = np.array([float(word) for word in words])
        except ValueError:
            values = np.full(count, np.inf)
        if len(values) != count or not np.isfinite(values).all():
            self.fail(place, shown(text), numbered(count, "number"))
        if float(np.abs(values).max(initial=0.0)) > _LARGEST:
            self.fail(place, "a number that is too large", f"numbers up to {_LARGEST:.0e}")
        return values

    def add_body(self, name: str) -> str:
        """Add a body; names are unique."""
        if name in self.bodies or name == WORLD:
            self.fail(f"body {shown(name)}", "the name occurs twice", "once")
        self.bodies.append(name)
        return name

    def add_joint(
        self, name: str, kind: JointKind, ends: tuple[str, str], point: Floats, axes: tuple[Floats, ...] = ()
    ) -> None:
        """Add a joint between two bodies, in the frame of the world."""
        for end in ends:
            if end not in self.bodies and end != WORLD:
                self.fail(f"joint {shown(name)}", f"there is no body {shown(end)}", "the name of one")
        for axis in axes:
            if not np.any(axis):
                self.fail(f"joint {shown(name)}", "the axis has no direction", "a vector that is not zero")
        names = {joint[0] for joint in self.joints}
        while name in names:
            name += "_"
        self.joints.append((name, kind, *ends, point, tuple(unit(axis) for axis in axes)))

    def mechanism(self) -> HingedSolids | JointedLinkage:
        """Return the mechanism: hinged solids if there are hinges only."""
        together = nx.Graph()
        together.add_nodes_from([*self.bodies, WORLD])
        together.add_edges_from(self.fixed)
        link_of: dict[str, str] = {}
        for part in nx.connected_components(together):
            first = next((body for body in self.bodies if body in part), WORLD)
            link_of |= dict.fromkeys(part, first)
        joints = {name: (link_of[first], link_of[second]) for name, _, first, second, *_ in self.joints}
        inside = [name for name, (first, second) in joints.items() if first == second]
        if inside:
            self.fail(f"joint {shown(inside[0])}", "both bodies are one link, by fixed joints", "two links")
        if not joints:
            self.fail("", "no joints", "hinges or other joints between bodies")
        used = {link for ends in joints.values() for link in ends}
        links = [link for link in dict.fromkeys([*map(link_of.get, self.bodies), WORLD]) if link in used]
        alone = len({link_of[body] for body in self.bodies} - used - {link_of[WORLD]})
        if alone:
            self.unread["body without a joint"] += alone
        ground = link_of[WORLD] if link_of[WORLD] in used else None
        chain = Checker(self.path).build(lambda: SCGraph(links, joints, ground=ground), lambda part: str(part[0]))
        notes = tuple(f"not read: {numbered(count, what)}" for what, count in self.unread.items())
        kinds: dict[JointId, JointKind] = {name: kind for name, kind, *_ in self.joints}
        if set(kinds.values()) == {JointKind.REVOLUTE}:
            lines: dict[JointId, Axis] = {
                name: (plain_vector(point), plain_vector(axes[0])) for name, _, _, _, point, axes in self.joints
            }
            return Checker(self.path).build(lambda: HingedSolids(chain, lines, notes), lambda part: str(part[0]))
        places: dict[JointId, JointPlace] = {
            name: JointPlace(plain_vector(point), tuple(map(plain_vector, axes)))
            for name, _, _, _, point, axes in self.joints
        }
        return Checker(self.path).build(lambda: JointedLinkage(chain, kinds, places, notes), lambda part: str(part[0]))


def composed(outer: Frame, inner: Frame) -> Frame:
    """Return a frame that is known in another."""
    return outer[0] @ inner[0], outer[1] + outer[0] @ inner[1]


def inverse(frame: Frame) -> Frame:
    """Return the frame of the world as seen from a frame."""
    return frame[0].T, -frame[0].T @ frame[1]


def of_rpy(angles: Floats) -> Floats:
    """Return the rotation of roll, pitch and yaw about fixed axes, radians; exact where they are zero."""
    rotation = np.eye(3)
    for place, angle in enumerate(angles.tolist()):
        i, j = (place + 1) % 3, (place + 2) % 3
        step = np.eye(3)
        step[[i, j], [i, j]], step[i, j], step[j, i] = cos(angle), -sin(angle), sin(angle)
        rotation = step @ rotation
    return rotation


def about(axis: Floats, angle: float) -> Floats:
    """Return the rotation about an axis."""
    return rotations(unit(axis), np.array(angle))
