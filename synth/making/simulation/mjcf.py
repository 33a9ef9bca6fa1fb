"""MJCF, the models of MuJoCo: a tree of bodies with exact hinges; points of the cut hinges are connected.

*MuJoCo documentation*, XML reference. All bodies have the axes of the world at the configuration of the file, so
that hinges are written as they are; joint angles there are ours (`ref`). Connections are soft: a four-bar gives way
by as much as its solver settings say, which are part of the file.
"""

from typing import Any

import numpy as np
import shapely

from graphs.errors import UnsolvableError, numbered
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.making.simulation.assembly import Assembly, driven_inertia
from synth.making.simulation.bodies import Bar, Body, Hinge, Plate, TreeJoint, springs_and_moments
from synth.making.simulation.connections import CutHinge
from synth.making.simulation.xml import Element, document

STEP = 0.00025
"""Time of a step, seconds. With twice as much the scissor octahedron opens by 1.8e-6 of its size near singular
configurations."""
_SOLVER: dict[str, Any] = {
    "timestep": STEP,
    "integrator": "RK4",
    "solver": "Newton",
    "iterations": 100,
    "tolerance": 1e-14,
    "jacobian": "auto",
}
_STIFF: dict[str, Any] = {"solref": [2.0 * STEP, 1.0], "solimp": [0.9999, 0.9999, 0.001, 0.5, 2.0]}
"""As stiff as the step allows: errors decay in two steps."""
_LIGHTEST = 1e-15
"""MuJoCo refuses moving bodies of a smaller mass or moment of inertia, kg and kg m2 (mjMINVAL)."""
SERVO = 50.0
"""Driven joints follow their input in 1/50 s."""


def mjcf_bytes(assembly: Assembly) -> bytes:
    """Return an assembly as MJCF; UnsolvableError if a moving body is too light for MuJoCo."""
    _check_weights(assembly)
    root = Element("mujoco", {"model": "mechanism"})
    root.add("compiler", angle="radian", autolimits=True, balanceinertia=False)
    option = root.add("option", **_SOLVER)
    option.add("flag", comment='for contact between panels, write contact="enable"', contact="disable")
    default = root.add("default")
    default.add("equality", comment="how stiff loops are closed", **_STIFF)
    default.add("geom", rgba="0.8 0.8 0.75 1")
    assets, world = root.add("asset"), root.add("worldbody")
    world.add("light", pos=[0.0, 0.0, 3.0 * assembly.size])
    _add_bodies(assembly, world, assets)
    _add_contacts(assembly, root)
    if assembly.cuts:
        equality = root.add("equality")
        for cut in assembly.cuts:
            _add_cut(assembly, cut, equality)
        _add_cut_hinges(assembly, root)
    moments = _with_moments(assembly)
    if assembly.driven or moments:
        actuator = root.add("actuator")
        for number in assembly.driven:
            _add_servo(assembly, number, actuator)
        for hinge in moments:
            actuator.add(
                "general", name=f"moment_{hinge.name}", joint=hinge.name, gainprm=0.0, biastype="affine",
                biasprm=[hinge.moment, 0.0, 0.0],
            )  # fmt: skip
    _add_keys(assembly, root, world)
    if not assets.children:
        root.children.remove(assets)
    return document(root, _head(assembly))


def _check_weights(assembly: Assembly) -> None:
    for joint in assembly.tree:
        body = assembly.bodies[joint.child]
        mass, moment = body.properties.mass, float(np.linalg.eigvalsh(body.properties.inertia)[0])
        if min(mass, moment) < _LIGHTEST:
            too_light = f"{body.name} has a mass of {mass:.2g} kg and a moment of inertia of {moment:.2g} kg m²"
            expected = f"MuJoCo requires {_LIGHTEST:g} of each"
            raise UnsolvableError(f"{too_light}, and {expected}; try a larger size, thickness or density")


def _head(assembly: Assembly) -> list[str]:
    freedoms, cuts = numbered(assembly.freedoms, "degree of freedom"), numbered(len(assembly.cuts), "cut hinge")
    freedoms = freedoms.replace("degree of freedoms", "degrees of freedom")
    rows = 3 * sum(len(cut.connects) for cut in assembly.cuts)
    rank = len(assembly.tree) - assembly.freedoms
    left_out = sum(cut.left_out for cut in assembly.cuts)
    lines = [
        f"synthedra: {freedoms}; {cuts}, connected by {rows} equations of rank {rank}",
        f"loop-closure residual {assembly.residual:.1e}; metres, kilograms, radians",
    ]
    if left_out:
        lines.append(f"{numbered(left_out, 'point')} of cut hinges left out: others hold them")
    return [*lines, *assembly.notes]


def _add_bodies(assembly: Assembly, world: Element, assets: Element) -> None:
    inside: dict[int, tuple[Element, Floats]] = {}
    for base in assembly.bases:
        inside[base] = (world.add("body", name=assembly.bodies[base].name), np.zeros(3))
        _add_shapes(assembly.bodies[base], *inside[base], assets)
    for joint in assembly.tree:
        hinge, (parent, origin) = assembly.hinges[joint.hinge], inside[joint.parent]
        body = assembly.bodies[joint.child]
        element = parent.add("body", name=body.name, pos=hinge.point - origin)
        inside[joint.child] = (element, hinge.point)
        _add_joint(hinge, joint, element)
        _add_shapes(body, element, hinge.point, assets)


def _add_joint(hinge: Hinge, joint: TreeJoint, element: Element) -> None:
    written = element.add(
        "joint", name=hinge.name, type="slide" if hinge.slide else "hinge", axis=joint.sense * hinge.direction,
        ref=hinge.angle,
    )  # fmt: skip
    if hinge.limits is not None:
        written.attributes["range"] = hinge.limits
    if hinge.stiffness:
        written.attributes |= {"stiffness": hinge.stiffness, "springref": hinge.rest}


def _add_shapes(body: Body, element: Element, origin: Floats, assets: Element) -> None:
    """Add the inertia of a body and its shapes; of a plate that is not convex, its triangles."""
    mass, inertia = body.properties, body.properties.inertia
    full = [*np.diag(inertia), inertia[0, 1], inertia[0, 2], inertia[1, 2]]
    element.add("inertial", pos=mass.centre - origin, mass=mass.mass, fullinertia=full)
    for number, shape in enumerate(body.flat_shapes()):
        name = f"{body.name}_{number}"
        if isinstance(shape, Bar):
            ends = [*(shape.start - origin), *(shape.end - origin)]
            element.add("geom", type="cylinder", fromto=ends, size=shape.radius)
            continue
        for part, corners in enumerate(part for plate in shape for part in convex_parts(plate)):
            mesh = f"{name}_{part}"
            assets.add("mesh", name=mesh, vertex=(corners - origin).ravel())
            element.add("geom", type="mesh", mesh=mesh)


def convex_parts(plate: Plate) -> list[Floats]:
    """Return the corners, float[n, 3], of convex prisms that make up a plate: itself, or a prism for each triangle."""
    polygon = shapely.Polygon(plate.plane.flat)
    whole = polygon.convex_hull.area - polygon.area <= DOUBLE.flat * polygon.area
    parts = [polygon] if whole else shapely.constrained_delaunay_triangles(polygon).geoms
    prisms = []
    for part in parts:
        flat = np.array(part.exterior.coords)[:-1]
        heights = np.repeat([-plate.thickness / 2.0, plate.thickness / 2.0], len(flat))
        prisms.append(plate.plane.origin + np.column_stack([np.tile(flat, (2, 1)), heights]) @ plate.plane.axes.T)
    return prisms


def _add_contacts(assembly: Assembly, root: Element) -> None:
    """Exclude contact between bodies that touch at all times."""
    pairs = assembly.neighbours()
    if pairs:
        contact = root.add("contact")
        for one, other in pairs:
            contact.add("exclude", body1=assembly.bodies[one].name, body2=assembly.bodies[other].name)


def _add_cut(assembly: Assembly, cut: CutHinge, equality: Element) -> None:
    hinge = assembly.hinges[cut.hinge]
    first, second = assembly.bodies[hinge.first], assembly.bodies[hinge.second]
    for number, connect in enumerate(cut.connects):
        redundant = numbered(3 - connect.rank, "redundant equation")
        equality.add(
            "connect", name=f"{hinge.name}_{'ab'[number]}", body1=first.name, body2=second.name,
            anchor=connect.point - assembly.origin(hinge.first), comment=f"{redundant}" if connect.rank < 3 else "",
        )  # fmt: skip
    if cut.left_out:
        held = f"{numbered(cut.left_out, 'point')} of {hinge.name} left out: held by the other equations"
        equality.children.append(Element("", comment=held))


def _add_cut_hinges(assembly: Assembly, root: Element) -> None:
    """Name the cut hinges for readers: their bodies, a point and the axis at the configuration of the file."""
    custom = root.add("custom", comment="hinges that the tree leaves out: point and axis, and the bodies")
    for cut in assembly.cuts:
        hinge = assembly.hinges[cut.hinge]
        custom.add("numeric", name=f"{hinge.name}_axis", data=[*hinge.point, *hinge.direction])
    for cut in assembly.cuts:
        hinge = assembly.hinges[cut.hinge]
        both = custom.add("tuple", name=hinge.name)
        for body in (hinge.first, hinge.second):
            both.add("element", objtype="body", objname=assembly.bodies[body].name)


def _add_servo(assembly: Assembly, number: int, actuator: Element) -> None:
    """Add an actuator that follows an angle, critically damped for the inertia that the whole mechanism has."""
    hinge, values = assembly.hinges[number], assembly.path[:, number]
    inertia = driven_inertia(assembly, number)
    servo = actuator.add(
        "position", name=f"drive_{hinge.name}", joint=hinge.name, kp=inertia * SERVO**2, kv=2.0 * inertia * SERVO
    )
    if np.ptp(values) > DOUBLE.same_configuration:  # else it is held
        servo.attributes["ctrlrange"] = [values.min(), values.max()]


def _with_moments(assembly: Assembly) -> list[Hinge]:
    """Return the hinges of the tree at which a constant moment acts."""
    hinges = (assembly.hinges[joint.hinge] for joint in assembly.tree)
    return [hinge for hinge in hinges if hinge.moment]


def _add_keys(assembly: Assembly, root: Element, world: Element) -> None:
    """Add the first and the last configuration of the motion."""
    if len(assembly.path) < 2:
        return
    number = {hinge.name: place for place, hinge in enumerate(assembly.hinges)}
    order = [number[str(element.attributes["name"])] for element in world.inside() if element.tag == "joint"]
    keys = root.add("keyframe")
    for name, row in (("start", assembly.path[0]), ("end", assembly.path[-1])):
        control = [*row[list(assembly.driven)], *(0.0 for _ in _with_moments(assembly))]
        keys.add("key", name=name, qpos=row[order], ctrl=control)


def lost_as_mjcf(assembly: Assembly) -> tuple[str, ...]:
    """Return what MJCF does not hold: joints that are connections have no limits and no springs."""
    cut = [assembly.hinges[each.hinge] for each in assembly.cuts]
    limits = sum(hinge.limits is not None for hinge in cut)
    lost = [numbered(limits, "limit")] if limits else []
    return tuple(f"{count} of cut hinges" for count in (*lost, *springs_and_moments(cut)))
