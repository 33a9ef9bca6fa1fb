"""SDF, the models of Gazebo: bodies and all joints, those that close loops too.

*SDFormat specification* 1.9. All links have the axes of the world at the configuration of the file, where all joints
are zero. Panels are polygons of a height.
"""

import numpy as np

from graphs.errors import numbered
from graphs.types import Floats
from synth.making.simulation.assembly import Assembly
from synth.making.simulation.bodies import Bar, Body, Hinge
from synth.making.simulation.urdf import angles_of, frame_along
from synth.making.simulation.xml import Element, document


def sdf_bytes(assembly: Assembly) -> bytes:
    """Return an assembly as SDF."""
    root = Element("sdf", {"version": "1.9"})
    model = root.add("model", name="mechanism")
    for number, body in enumerate(assembly.bodies):
        _add_link(assembly, number, body, model)
    for base in assembly.bases:
        fixed = model.add("joint", name=f"base_{assembly.bodies[base].name}", type="fixed")
        fixed.add("parent", "world")
        fixed.add("child", assembly.bodies[base].name)
    carried = {joint.hinge: joint for joint in assembly.tree}
    for number, hinge in enumerate(assembly.hinges):
        joint = carried.get(number)
        ends = (hinge.first, hinge.second) if joint is None else (joint.parent, joint.child)
        _add_joint(assembly, hinge, ends, 1.0 if joint is None else joint.sense, model)
    closing = f"{numbered(len(assembly.cuts), 'joint')} to close loops"
    return document(root, [f"synthedra: {closing}", *assembly.notes])


def _add_link(assembly: Assembly, number: int, body: Body, model: Element) -> None:
    origin, properties = assembly.origin(number), body.properties
    link = model.add("link", name=body.name)
    link.add("pose", [*origin, 0.0, 0.0, 0.0])
    inertial = link.add("inertial")
    inertial.add("pose", [*(properties.centre - origin), 0.0, 0.0, 0.0])
    inertial.add("mass", properties.mass)
    inertia = inertial.add("inertia")
    names = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    for name, value in zip(names, properties.inertia[np.triu_indices(3)].tolist(), strict=True):
        inertia.add(name, value)
    flat = [part for shape in body.flat_shapes() for part in ([shape] if isinstance(shape, Bar) else shape)]
    for place, shape in enumerate(flat):
        for kind in ("visual", "collision"):
            element = link.add(kind, name=f"{kind}_{place}")
            if isinstance(shape, Bar):
                _add_cylinder(shape, origin, element)
                continue
            plane = shape.plane
            low = plane.origin - origin - shape.thickness / 2.0 * plane.normal
            element.add("pose", [*low, *angles_of(plane.axes)])
            line = element.add("geometry").add("polyline")
            for point in plane.flat:
                line.add("point", point)
            line.add("height", shape.thickness)


def _add_cylinder(bar: Bar, origin: Floats, element: Element) -> None:
    along = bar.end - bar.start
    element.add("pose", [*((bar.start + bar.end) / 2.0 - origin), *angles_of(frame_along(along))])
    cylinder = element.add("geometry").add("cylinder")
    cylinder.add("radius", bar.radius)
    cylinder.add("length", float(np.linalg.norm(along)))


def _add_joint(assembly: Assembly, hinge: Hinge, ends: tuple[int, int], sense: float, model: Element) -> None:
    kind = "prismatic" if hinge.slide else "revolute"
    joint = model.add("joint", name=hinge.name, type=kind)
    parent, child = (assembly.bodies[end].name for end in ends)
    joint.add("parent", parent)
    joint.add("child", child)
    joint.add("pose", [*(hinge.point - assembly.origin(ends[1])), 0.0, 0.0, 0.0])
    axis = joint.add("axis")
    axis.add("xyz", sense * hinge.direction)
    if hinge.limits is not None:
        limit = axis.add("limit")
        limit.add("lower", hinge.limits[0] - hinge.angle)
        limit.add("upper", hinge.limits[1] - hinge.angle)
    if hinge.stiffness:
        dynamics = axis.add("dynamics")
        dynamics.add("spring_stiffness", hinge.stiffness)
        dynamics.add("spring_reference", hinge.rest - hinge.angle)


def lost_as_sdf(assembly: Assembly) -> tuple[str, ...]:
    """Return what SDF does not hold: motors are plugins there."""
    actuators = [f"{numbered(len(assembly.driven), 'actuator')}, which are plugins"] if assembly.driven else []
    moments = sum(bool(hinge.moment) for hinge in assembly.hinges)
    return (*actuators, *([numbered(moments, "moment")] if moments else []))
