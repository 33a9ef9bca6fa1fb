"""MJCF: the tree of bodies at the reference configuration, and equalities that close loops.

*MuJoCo documentation*, XML reference. Two connections between two bodies are a hinge through both points; one is a
hinge where the joints between the bodies keep them in a plane, else a ball. A hinge that synthedra cut is named in
``<custom>``.
"""

from collections.abc import Iterator, Mapping
from itertools import pairwise
from math import radians
from pathlib import Path
from xml.etree.ElementTree import Element

import networkx as nx
import numpy as np

from graphs.errors import shown
from graphs.files.robots.reading import IDENTITY, WORLD, Frame, Robot, about, composed, xml_of
from graphs.geometry import unit
from graphs.joints.linkage import JointedLinkage, JointKind
from graphs.mechanism.solids import HingedSolids
from graphs.tolerances import DOUBLE
from graphs.types import Floats

_KINDS = {"hinge": JointKind.REVOLUTE, "slide": JointKind.PRISMATIC, "ball": JointKind.SPHERICAL}
_LEFT_OUT = {"tendon": "tendon section", "deformable": "deformable section"}
_BODY = {"body", "frame", "joint", "freejoint", "inertial", "geom", "site", "camera", "light"}
"""Elements of bodies that are read, or have nothing to do with joints."""


def read_mjcf(path: Path) -> HingedSolids | JointedLinkage:
    """Return the mechanism of a file of MuJoCo."""
    return _Reader(path, xml_of(path, "mujoco")).mechanism()


class _Reader:
    def __init__(self, path: Path, root: Element) -> None:
        self.robot, self.root = Robot(path), root
        compiler: dict[str, str] = {}
        for element in root.iter("compiler"):
            compiler |= element.attrib
        if root.find(".//include") is not None:
            self.robot.fail("<include>", "bodies in another file", "one file")
        if compiler.get("coordinate", "local") != "local":
            self.robot.fail("<compiler>", "global coordinates", "local ones")
        self.unit = 1.0 if compiler.get("angle", "degree") == "radian" else radians(1.0)
        self.sequence = compiler.get("eulerseq", "xyz")
        if len(self.sequence) != 3 or set(self.sequence.lower()) - set("xyz"):
            self.robot.fail("<compiler>", f"eulerseq {shown(self.sequence)}", "three of x, y, z")
        self.defaults = dict(_defaults(root))
        self.frames: dict[str, Frame] = {WORLD: IDENTITY}
        self.sites: dict[str, tuple[str, Floats]] = {}

    def mechanism(self) -> HingedSolids | JointedLinkage:
        """Return bodies, joints and loops as a mechanism."""
        for world in self.root.iter("worldbody"):
            self._walk(world)
        self._loops()
        for tag, name in _LEFT_OUT.items():
            self.robot.unread[name] += sum(len(element) > 0 for element in self.root.findall(tag))
        self.robot.unread = +self.robot.unread
        return self.robot.mechanism()

    def _walk(self, world: Element) -> None:
        """Read bodies; what waits is an element, the body it is in, its frame, and the class of its defaults."""
        waiting: list[tuple[Element, str, Frame, str]] = [(world, WORLD, IDENTITY, "main")]
        while waiting:
            element, body, frame, inherited = waiting.pop()
            here = element.get("childclass", inherited)
            for child in reversed(element):
                if child.tag == "frame":
                    waiting.append((child, body, composed(frame, self._frame(child)), here))
                elif child.tag == "body":
                    waiting.append((child, *self._body(child, body, frame, child.get("childclass", here)), here))
                elif child.tag not in _BODY:
                    self.robot.unread[f"<{child.tag}>"] += 1
            for site in element.findall("site"):
                point = self.robot.numbers(site.get("pos"), 3, "<site>", "0 0 0")
                self.sites[site.get("name", "")] = (body, composed(frame, (np.eye(3), point))[1])

    def _body(self, element: Element, parent: str, frame: Frame, inherited: str) -> tuple[str, Frame]:
        name = self.robot.add_body(element.get("name") or f"body {len(self.robot.bodies) + 1}")
        placed = self.frames[name] = composed(frame, self._frame(element))
        joints = [self._joint(joint, inherited) for joint in element.findall("joint")]
        if element.find("freejoint") is not None or any(joint["type"] == "free" for joint in joints):
            return name, placed
        if not joints:
            self.robot.fixed.append((parent, name))
        before = parent
        for number, joint in enumerate(joints, 1):
            after = name if number == len(joints) else self.robot.add_body(f"{name} {number}")
            self._add(joint, (before, after), placed, f"joint of {name}")
            before = after
        return name, placed

    def _joint(self, element: Element, inherited: str) -> Mapping[str, str]:
        given = self.defaults.get(element.get("class", inherited), {})
        return {"type": "hinge", **given, **element.attrib}

    def _add(self, joint: Mapping[str, str], ends: tuple[str, str], frame: Frame, place: str) -> None:
        name = joint.get("name", place)
        if joint["type"] not in _KINDS:
            self.robot.fail(f"joint {shown(name)}", f"the type {shown(joint['type'])}", "hinge, slide, ball or free")
        kind = _KINDS[joint["type"]]
        point = composed(frame, (np.eye(3), self.robot.numbers(joint.get("pos"), 3, name, "0 0 0")))[1]
        axes = (frame[0] @ self.robot.numbers(joint.get("axis"), 3, name, "0 0 1"),) if kind.axes else ()
        self.robot.add_joint(name, kind, ends, point, axes)

    def _frame(self, element: Element) -> Frame:
        numbers, place = self.robot.numbers, f"<{element.tag}> {shown(element.get('name', ''))}"
        point = numbers(element.get("pos"), 3, place, "0 0 0")
        if (text := element.get("quat")) is not None:
            w, *vector = numbers(text, 4, place)
            if not np.any(vector):
                return np.eye(3), point
            size = np.linalg.norm(vector)
            return about(np.array(vector), 2.0 * np.arctan2(size, w)), point
        if (text := element.get("axisangle")) is not None:
            *axis, angle = numbers(text, 4, place)
            return about(np.array(axis), angle * self.unit), point
        if (text := element.get("euler")) is not None:
            return self._euler(numbers(text, 3, place)), point
        if (text := element.get("xyaxes")) is not None:
            x, y = numbers(text, 6, place).reshape(2, 3)
            x, z = unit(x), unit(np.cross(x, y))
            return np.column_stack([x, np.cross(z, x), z]), point
        if (text := element.get("zaxis")) is not None:
            z = unit(numbers(text, 3, place))
            across = np.cross([0.0, 0.0, 1.0], z)
            angle = float(np.arctan2(np.linalg.norm(across), z[2]))
            return (about(across, angle) if np.any(across) else np.diag([1.0, z[2], z[2]])), point
        return np.eye(3), point

    def _euler(self, angles: Floats) -> Floats:
        """Return the rotation of Euler angles: capitals are axes that stay."""
        rotation = np.eye(3)
        for letter, angle in zip(self.sequence, (angles * self.unit).tolist(), strict=True):
            step = about(np.eye(3)["xyz".index(letter.lower())], angle)
            rotation = rotation @ step if letter.islower() else step @ rotation
        return rotation

    def _loops(self) -> None:
        """Read equalities: hinges that were cut, connections, welds."""
        cut = self._cut_hinges()
        points: dict[tuple[str, str], list[Floats]] = {}
        for section in self.root.findall("equality"):
            for element in section:
                name = element.get("name", "")
                if element.get("active") == "false" or any(name.startswith(f"{hinge}_") for hinge in cut):
                    continue
                if element.tag == "connect":
                    first, second, point = self._connect(element)
                    points.setdefault((first, second), []).append(point)
                elif element.tag == "weld":
                    self.robot.fixed.append(self._ends(element))
                else:
                    self.robot.unread[f"equality <{element.tag}>"] += 1
        for (first, second), together in points.items():
            self._hold(first, second, np.array(together))

    def _cut_hinges(self) -> set[str]:
        """Add the hinges that a writer of synthedra cut; return their names."""
        numerics = {numeric.get("name"): numeric.get("data") for numeric in self.root.iter("numeric")}
        names = set[str]()
        for group in self.root.iter("tuple"):
            name, data = group.get("name", ""), numerics.get(f"{group.get('name')}_axis")
            bodies = [element.get("objname", "") for element in group if element.get("objtype") == "body"]
            if data is None or len(bodies) != 2:
                continue
            point, axis = self.robot.numbers(data, 6, f"<numeric> {shown(name)}").reshape(2, 3)
            self.robot.add_joint(name, JointKind.REVOLUTE, (bodies[0], bodies[1]), point, (axis,))
            names.add(name)
        return names

    def _ends(self, element: Element) -> tuple[str, str]:
        place = f"<{element.tag}> {shown(element.get('name', ''))}"
        if element.get("site1") is not None:
            sites = (element.get("site1", ""), element.get("site2", ""))
            if not set(sites) <= set(self.sites):
                self.robot.fail(place, f"sites {shown(list(sites))}", "names of sites")
            return self.sites[sites[0]][0], self.sites[sites[1]][0]
        ends = (element.get("body1", ""), element.get("body2", WORLD))
        for end in ends:
            if end not in self.frames:
                self.robot.fail(place, f"there is no body {shown(end)}", "the name of one")
        return ends

    def _connect(self, element: Element) -> tuple[str, str, Floats]:
        first, second = self._ends(element)
        if element.get("site1") is not None:
            return first, second, self.sites[element.get("site1", "")][1]
        anchor = self.robot.numbers(element.get("anchor"), 3, "<connect>")
        return first, second, composed(self.frames[first], (np.eye(3), anchor))[1]

    def _hold(self, first: str, second: str, points: Floats) -> None:
        """Add what holds two bodies together at some points."""
        arms = points[1:] - points[0]
        sizes = np.linalg.norm(arms, axis=1)
        apart = arms[sizes > DOUBLE.same_point * max(1.0, float(np.abs(points).max()))]
        name = f"{first} to {second}"
        if not len(apart):
            normal = self._normal(first, second)
            kind = JointKind.SPHERICAL if normal is None else JointKind.REVOLUTE
            self.robot.add_joint(name, kind, (first, second), points[0], () if normal is None else (normal,))
            return
        axis = unit(apart[0])
        if np.linalg.norm(np.cross(unit(apart), axis), axis=1).max() > DOUBLE.meant:
            self.robot.fixed.append((first, second))
            return
        self.robot.add_joint(name, JointKind.REVOLUTE, (first, second), points[0], (axis,))

    def _normal(self, first: str, second: str) -> Floats | None:
        """Return the direction of the axes between two bodies, if all are parallel and slides go across them."""
        graph = nx.Graph(self.robot.fixed)
        for name, kind, one, other, _, axes in self.robot.joints:
            graph.add_edge(one, other, joint=(name, kind, axes))
        if first not in graph or second not in graph or not nx.has_path(graph, first, second):
            return None
        path = nx.shortest_path(graph, first, second)
        joints = [graph[a][b]["joint"] for a, b in pairwise(path) if "joint" in graph[a][b]]
        turning = [axes[0] for _, kind, axes in joints if kind is JointKind.REVOLUTE]
        sliding = [axes[0] for _, kind, axes in joints if kind is JointKind.PRISMATIC]
        if not turning or len(turning) + len(sliding) < len(joints):
            return None
        off = [np.linalg.norm(np.cross(axis, turning[0])) for axis in turning]
        off += [abs(axis @ turning[0]) for axis in sliding]
        return turning[0] if max(off) <= DOUBLE.meant else None


def _defaults(root: Element) -> Iterator[tuple[str, dict[str, str]]]:
    """Yield the attributes of joints of each class, with those of the classes round it."""
    for top in root.findall("default"):
        waiting: list[tuple[Element, dict[str, str]]] = [(top, {})]
        while waiting:
            element, outer = waiting.pop()
            own = element.find("joint")
            inner = outer | (dict(own.attrib) if own is not None else {})
            yield element.get("class", "main"), inner
            waiting += [(child, inner) for child in element.findall("default")]
