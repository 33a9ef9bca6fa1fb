"""USD with physics: bodies as prims, all joints; those that close loops are excluded from the articulation.

*OpenUSD*, UsdPhysics. Poses of joints are 32-bit numbers there, so that axes are exact to 1e-7 only. Metres,
kilograms; angles of limits and drives in degrees, from the configuration of the file.
"""

import re
from collections.abc import Iterable, Iterator
from math import degrees

import numpy as np
from scipy.spatial.transform import Rotation

from graphs.geometry import frame_about, unit
from graphs.types import Floats
from synth.making.simulation.assembly import Assembly, driven_inertia
from synth.making.simulation.bodies import Bar, Body, Hinge, MassProperties, Plate, springs_and_moments
from synth.making.simulation.mjcf import SERVO
from synth.making.templates.solids import plate_of

_HEAD = """#usda 1.0
(
    defaultPrim = "mechanism"
    doc = "synthedra: joints that close loops are excluded from the articulation"
    kilogramsPerUnit = 1
    metersPerUnit = 1
    upAxis = "Z"
)

def PhysicsScene "scene"
{
    vector3f physics:gravityDirection = (0, 0, -1)
    float physics:gravityMagnitude = 9.81
}

def Xform "mechanism" (
    prepend apiSchemas = ["PhysicsArticulationRootAPI"]
)
{
"""


def usd_bytes(assembly: Assembly) -> bytes:
    """Return an assembly as USD, in its form as text."""
    names = _identifiers([*(body.name for body in assembly.bodies), *(hinge.name for hinge in assembly.hinges)])
    bodies, hinges = names[: len(assembly.bodies)], names[len(assembly.bodies) :]
    lines = [_HEAD]
    for number, (name, body) in enumerate(zip(bodies, assembly.bodies, strict=True)):
        lines += _body(name, body, assembly.origin(number))
    for base in assembly.bases:
        lines += [f'    def PhysicsFixedJoint "base_{bodies[base]}"', "    {"]
        lines += [f"        rel physics:body1 = </mechanism/{bodies[base]}>", "    }"]
    cut = {each.hinge for each in assembly.cuts}
    for number, hinge in enumerate(assembly.hinges):
        ends = (bodies[hinge.first], bodies[hinge.second])
        origins = (assembly.origin(hinge.first), assembly.origin(hinge.second))
        inertia = driven_inertia(assembly, number) if number in assembly.driven else 0.0
        lines += _joint(hinges[number], hinge, ends, origins, number in cut, inertia)
    return ("\n".join([*lines, "}"]) + "\n").encode()


def _identifiers(names: Iterable[str]) -> list[str]:
    """Return different names of letters, digits and underscores."""
    made: list[str] = []
    for name in names:
        word = re.sub(r"[^A-Za-z0-9_]", "_", name)
        while word in made:
            word += "_"
        made.append(word)
    return made


def _body(name: str, body: Body, origin: Floats) -> Iterator[str]:
    properties = body.properties
    moments, axes = _principal(properties)
    yield f'    def Xform "{name}" ('
    yield '        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]'
    yield "    )"
    yield "    {"
    yield f"        float physics:mass = {float(properties.mass)!r}"
    yield f"        point3f physics:centerOfMass = {_tuple(properties.centre - origin)}"
    yield f"        float3 physics:diagonalInertia = {_tuple(moments)}"
    yield f"        quatf physics:principalAxes = {_quaternion(axes)}"
    yield f"        double3 xformOp:translate = {_tuple(origin)}"
    yield '        uniform token[] xformOpOrder = ["xformOp:translate"]'
    flat = [part for shape in body.flat_shapes() for part in ([shape] if isinstance(shape, Bar) else shape)]
    for number, shape in enumerate(flat):
        name = f"shape_{number}"
        yield from _bar(name, shape, origin) if isinstance(shape, Bar) else _plate(name, shape, origin)
    yield "    }"


def _principal(properties: MassProperties) -> tuple[Floats, Floats]:
    """Return principal moments of inertia, and their axes as columns, right-handed."""
    moments, axes = np.linalg.eigh(properties.inertia)
    return moments, axes * np.array([1.0, 1.0, np.sign(np.linalg.det(axes))])


def _plate(name: str, plate: Plate, origin: Floats) -> Iterator[str]:
    mesh = plate_of(plate.plane.flat, plate.thickness, name)
    corners = mesh.corners @ plate.plane.axes.T + plate.plane.origin - origin
    yield f'        def Mesh "{name}" ('
    yield '            prepend apiSchemas = ["PhysicsCollisionAPI", "PhysicsMeshCollisionAPI"]'
    yield "        )"
    yield "        {"
    yield f"            float3[] extent = [{_tuple(corners.min(axis=0))}, {_tuple(corners.max(axis=0))}]"
    yield f"            int[] faceVertexCounts = [{', '.join('3' for _ in mesh.triangles)}]"
    yield f"            int[] faceVertexIndices = [{', '.join(map(str, mesh.triangles.ravel().tolist()))}]"
    yield f"            point3f[] points = [{', '.join(map(_tuple, corners))}]"
    yield '            uniform token physics:approximation = "convexDecomposition"'
    yield '            uniform token subdivisionScheme = "none"'
    yield "        }"


def _bar(name: str, bar: Bar, origin: Floats) -> Iterator[str]:
    along, length = bar.end - bar.start, float(np.linalg.norm(bar.end - bar.start))
    corner = np.array([bar.radius, bar.radius, length / 2.0])
    yield f'        def Cylinder "{name}" ('
    yield '            prepend apiSchemas = ["PhysicsCollisionAPI"]'
    yield "        )"
    yield "        {"
    yield '            uniform token axis = "Z"'
    yield f"            float3[] extent = [{_tuple(-corner)}, {_tuple(corner)}]"
    yield f"            double height = {length!r}"
    yield f"            double radius = {float(bar.radius)!r}"
    yield f"            quatd xformOp:orient = {_quaternion(_about(unit(along)))}"
    yield f"            double3 xformOp:translate = {_tuple((bar.start + bar.end) / 2.0 - origin)}"
    yield '            uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:orient"]'
    yield "        }"


def _joint(
    name: str, hinge: Hinge, ends: tuple[str, str], origins: tuple[Floats, Floats], closing: bool, inertia: float
) -> Iterator[str]:
    kind = "Prismatic" if hinge.slide else "Revolute"
    drive = "linear" if hinge.slide else "angular"
    yield f'    def Physics{kind}Joint "{name}"' + (" (" if inertia else "")
    if inertia:
        yield f'        prepend apiSchemas = ["PhysicsDriveAPI:{drive}"]'
        yield "    )"
    yield "    {"
    yield '        uniform token physics:axis = "Z"'
    if closing:
        yield "        bool physics:excludeFromArticulation = 1"
    turned = _quaternion(_about(hinge.direction))
    for side, (end, origin) in enumerate(zip(ends, origins, strict=True)):
        yield f"        rel physics:body{side} = </mechanism/{end}>"
        yield f"        point3f physics:localPos{side} = {_tuple(hinge.point - origin)}"
        yield f"        quatf physics:localRot{side} = {turned}"
    if hinge.limits is not None:
        low, high = (degrees(limit - hinge.angle) for limit in hinge.limits)
        yield f"        float physics:lowerLimit = {float(low)!r}"
        yield f"        float physics:upperLimit = {float(high)!r}"
    if inertia:
        factor = 1.0 if hinge.slide else np.pi / 180.0  # of a degree
        yield f"        float drive:{drive}:physics:stiffness = {float(inertia * SERVO**2 * factor)!r}"
        yield f"        float drive:{drive}:physics:damping = {float(2.0 * inertia * SERVO * factor)!r}"
        yield f"        float drive:{drive}:physics:targetPosition = 0"
        yield f'        uniform token drive:{drive}:physics:type = "force"'
    yield "    }"


def _about(direction: Floats) -> Floats:
    """Return a frame whose third axis is a direction, as columns."""
    first = frame_about(direction)[0]
    return np.column_stack([first, np.cross(direction, first), direction])


def _quaternion(axes: Floats) -> str:
    x, y, z, w = Rotation.from_matrix(axes).as_quat().tolist()
    return _tuple(np.array([w, x, y, z]))


def _tuple(numbers: Floats) -> str:
    return f"({', '.join(repr(number + 0.0) for number in numbers.tolist())})"


def lost_as_usd(assembly: Assembly) -> tuple[str, ...]:
    """Return what USD does not hold."""
    return ("digits of axes beyond 32 bits", *springs_and_moments(assembly.hinges))
