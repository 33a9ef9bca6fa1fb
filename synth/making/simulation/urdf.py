"""URDF, the models of ROS: a tree; and beside it a file of JSON with what closes the loops.

*URDF XML specification*, ROS wiki. All frames have the axes of the world at the configuration of the file, where
all joints are zero; the file beside says which angles of ours these are. A joint whose angle follows that of the
driven one in proportion mimics it; other functions are tables, for a cubic spline. Panels are STL files.
"""

import json
from collections.abc import Mapping
from math import pi
from typing import Any

import numpy as np

from graphs.errors import UnsolvableError, numbered
from graphs.files.solids.meshes import SolidMesh, stl_bytes
from graphs.geometry import frame_about, unit
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.making.simulation.assembly import Assembly
from synth.making.simulation.bodies import Bar, Body, Plate, springs_and_moments
from synth.making.simulation.tables import MotionTable, motion_table
from synth.making.simulation.xml import Element, document
from synth.making.templates.solids import plate_of

_EFFORT, _VELOCITY, _FAR = 1000.0, 100.0, 2.0
"""URDF asks for limits of joints that have none: moments, speeds, slides up to so many extents."""
_ABOUT = {
    "driven": "joints with actuators",
    "loops": "hinges that the tree leaves out: both links have the point and the axis, each in its own frame",
    "zero": "our angle of each joint where URDF has 0, radians; of slides metres",
    "functions": "angles of all joints (as in URDF) at values of the driven one, for a cubic spline; error: radians",
}


def urdf_bytes(assembly: Assembly) -> bytes:
    """Return the file of the tree of a model alone."""
    return urdf_files(assembly)[".urdf"]


def urdf_files(assembly: Assembly) -> Mapping[str, bytes]:
    """Return the files of a model, by what their names end in."""
    table = _table(assembly)
    root = Element("robot", {"name": "mechanism"})
    meshes: dict[str, bytes] = {}
    for number, body in enumerate(assembly.bodies):
        _add_link(assembly, number, body, root, meshes)
    for joint in assembly.tree:
        _add_joint(assembly, joint.hinge, root, table)
    if len(assembly.bases) > 1:
        root.add("link", name="base")
        for base in assembly.bases:
            _add_fixed(assembly.bodies[base].name, root)
    beside = json.dumps(loops_to_json(assembly, table), indent=1).encode()
    comments = [f"synthedra: {numbered(len(assembly.cuts), 'loop')} closed by the file of JSON beside this one"]
    return {".urdf": document(root, comments), ".loops.json": beside, **meshes}


def _table(assembly: Assembly) -> MotionTable | None:
    """Return the motion of the driven joint; None with several freedoms, or where it cannot be followed."""
    try:
        return motion_table(assembly)
    except UnsolvableError:
        return None


def _add_fixed(name: str, root: Element) -> None:
    fixed = root.add("joint", name=f"base_{name}", type="fixed")
    fixed.add("parent", link="base")
    fixed.add("child", link=name)


def _add_link(assembly: Assembly, number: int, body: Body, root: Element, meshes: dict[str, bytes]) -> None:
    origin, link = assembly.origin(number), root.add("link", name=body.name)
    properties = body.properties
    inertial = link.add("inertial")
    inertial.add("origin", xyz=properties.centre - origin, rpy=np.zeros(3))
    inertial.add("mass", value=properties.mass)
    names = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    inertial.add("inertia", **dict(zip(names, properties.inertia[np.triu_indices(3)].tolist(), strict=True)))
    for place, shape in enumerate(body.flat_shapes()):
        for kind in ("visual", "collision"):
            element = link.add(kind)
            if isinstance(shape, Bar):
                middle, length = (shape.start + shape.end) / 2.0, float(np.linalg.norm(shape.end - shape.start))
                element.add("origin", xyz=middle - origin, rpy=angles_of(frame_along(shape.end - shape.start)))
                element.add("geometry").add("cylinder", radius=shape.radius, length=length)
            else:
                ending = f".{body.name}-{place}.stl"
                meshes[ending] = stl_bytes([_mesh(plate, origin) for plate in shape])
                element.add("geometry").add("mesh", filename=FILE + ending, scale=[0.001, 0.001, 0.001])


FILE = "%FILE%"
"""Stands for the name of the file, without its ending, until it is written."""


def _mesh(plate: Plate, origin: Floats) -> SolidMesh:
    """Return a plate in the frame of its link, millimetres."""
    flat = plate_of(plate.plane.flat, plate.thickness, "panel")
    corners = flat.corners @ plate.plane.axes.T + plate.plane.origin - origin
    return SolidMesh(flat.name, 1000.0 * corners, flat.triangles)


def frame_along(direction: Floats) -> Floats:
    """Return axes whose third is a direction, as columns."""
    along = unit(direction)
    first = frame_about(along)[0]
    return np.column_stack([first, np.cross(along, first), along])


def angles_of(axes: Floats) -> Floats:
    """Return roll, pitch and yaw of a frame whose axes are columns."""
    level = float(np.hypot(axes[0, 0], axes[1, 0]))
    pitch = np.arctan2(-axes[2, 0], level)
    if level <= DOUBLE.parallel:  # upright: roll and yaw are one
        return np.array([np.arctan2(-axes[1, 2], axes[1, 1]), pitch, 0.0])
    return np.array([np.arctan2(axes[2, 1], axes[2, 2]), pitch, np.arctan2(axes[1, 0], axes[0, 0])])


def _add_joint(assembly: Assembly, number: int, root: Element, table: MotionTable | None) -> None:
    hinge = assembly.hinges[number]
    tree = next(joint for joint in assembly.tree if joint.hinge == number)
    kind = "prismatic" if hinge.slide else "continuous" if hinge.limits is None else "revolute"
    joint = root.add("joint", name=hinge.name, type=kind)
    joint.add("parent", link=assembly.bodies[tree.parent].name)
    joint.add("child", link=assembly.bodies[tree.child].name)
    joint.add("origin", xyz=hinge.point - assembly.origin(tree.parent), rpy=np.zeros(3))
    joint.add("axis", xyz=tree.sense * hinge.direction)
    far = _FAR * assembly.size
    low, high = (-far, far) if hinge.slide else hinge.limits or (-pi, pi)
    limit: dict[str, Any] = {"effort": _EFFORT, "velocity": _VELOCITY}
    if kind != "continuous":
        start = 0.0 if hinge.slide else hinge.angle
        limit |= {"lower": low - start, "upper": high - start}
    joint.add("limit", **limit)
    factor = None if table is None or number == table.driver else _factor(table, number)
    if factor is not None and table is not None:
        joint.add(
            "mimic",
            joint=assembly.hinges[table.driver].name,
            multiplier=factor,
            offset=_offset(assembly, table, number, factor),
        )


def _factor(table: MotionTable, number: int) -> float | None:
    """Return by how much a joint turns for each radian of the driver, if that is the same everywhere."""
    driver, values = table.angles[:, table.driver], table.angles[:, number]
    factor = float((values[-1] - values[0]) / (driver[-1] - driver[0]))
    off = np.abs(values - values[0] - factor * (driver - driver[0])).max()
    return factor if off <= DOUBLE.same_point else None


def _offset(assembly: Assembly, table: MotionTable, number: int, factor: float) -> float:
    """Return the angle in the file of a joint in proportion where that of the driver is 0."""
    driver = table.angles[0, table.driver] - assembly.hinges[table.driver].angle
    off = float(table.angles[0, number] - assembly.hinges[number].angle - factor * driver)
    return off if abs(off) > DOUBLE.same_point else 0.0


def loops_to_json(assembly: Assembly, table: MotionTable | None) -> dict[str, Any]:
    """Return what the tree of a model leaves out."""
    loops = []
    for cut in assembly.cuts:
        hinge = assembly.hinges[cut.hinge]
        ends = [(assembly.bodies[body].name, assembly.origin(body)) for body in (hinge.first, hinge.second)]
        loops.append({
            "joint": hinge.name,
            "type": "revolute",
            "links": [name for name, _ in ends],
            "points": [(hinge.point - origin).tolist() for _, origin in ends],
            "axis": hinge.direction.tolist(),
            "length": 2.0 * hinge.reach,
        })  # fmt: skip
    document: dict[str, Any] = {
        "format": "synthedra/loops",
        "version": 1,
        "about": _ABOUT,
        "freedoms": assembly.freedoms,
        "driven": [assembly.hinges[number].name for number in assembly.driven],
        "loops": loops,
        "zero": {hinge.name: hinge.angle for hinge in assembly.hinges},
    }
    if table is not None:
        zero = np.array([hinge.angle for hinge in assembly.hinges])
        columns = (table.angles - zero).T.tolist()
        names = [hinge.name for hinge in assembly.hinges]
        document["functions"] = {
            "driver": names[table.driver],
            "angles": dict(zip(names, columns, strict=True)),
            "error": table.cubic,
        }
    return document


def lost_as_urdf(assembly: Assembly) -> tuple[str, ...]:
    """Return what URDF does not hold."""
    loops = [f"{numbered(len(assembly.cuts), 'loop')}, but in the file beside"] if assembly.cuts else []
    return (*loops, *springs_and_moments(assembly.hinges))
