"""Hoberman's scissors: pairs of kinked links joined by a pin, in rings and along the edges of polyhedra.

Both links of a pair reach from one ray to another with arms of one length; their kink is what makes the angle
between the rays the same at every opening. On each ray the far ends of all pairs meet in one point, and so do the
near ends. Source: Wampler, Larson, Erdman 2007, Figs. 13 to 18; Hoberman 1990. Theory: docs/theory/generators.md.
"""

from collections.abc import Sequence
from itertools import combinations, pairwise, product
from math import asin, cos, degrees, pi, sin, sqrt

import numpy as np

from graphs.errors import InvariantError
from graphs.geometry import unit
from graphs.joints.linkage import JointedLinkage, JointKind, JointPlace, plain_vector
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import Axis, HingedSolids
from graphs.tolerances import DOUBLE
from graphs.types import JointId, LinkId

_UP = (0.0, 0.0, 1.0)

Corners = Sequence[tuple[float, float, float]]

TETRAHEDRON: Corners = ((1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1))
CUBE: Corners = tuple((x, y, z) for x, y, z in product((-1, 1), repeat=3))
OCTAHEDRON: Corners = (
    (1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1),
)  # fmt: skip
"""Corners of regular polyhedra about the origin, of any size."""


def prism(sides: int) -> Corners:
    """Return the corners of a prism about the origin, all edges alike as seen from there."""
    cosine = cos(2 * pi / sides)
    up = sqrt((1.0 - cosine) / (3.0 - cosine))
    out = sqrt(1.0 - up * up)
    turns = [2 * pi * side / sides for side in range(sides)]
    return [(out * cos(turn), out * sin(turn), z) for z in (up, -up) for turn in turns]


def scissor_polyhedron(corners: Corners, opening: float) -> JointedLinkage:
    """Return a polyhedron with a pair of kinked scissors for each edge, joined by balls on the rays to corners.

    Arms are 1 long. `opening` is the angle (radians) between an arm and the perpendicular from the pin to its ray:
    0 where far and near ends meet, 90 degrees less half the angle of two rays where near ends all meet.
    """
    rays = unit(np.array(corners, dtype=float))
    nearest = max(float(ray @ other) for ray, other in combinations(rays, 2))
    edges = [
        pair
        for pair in combinations(range(len(rays)), 2)
        if rays[pair[0]] @ rays[pair[1]] > nearest - DOUBLE.same_point
    ]
    pin, far, near = _distances(sqrt((1.0 - nearest) / 2.0), opening)
    joints: dict[JointId, tuple[LinkId, LinkId]] = {}
    places: dict[JointId, JointPlace] = {}
    ends: dict[tuple[str, int], list[LinkId]] = {}
    for a, b in edges:
        links = f"{a}>{b}", f"{b}>{a}"  # called by the rays of its far and its near end
        joints[f"pin {a}-{b}"] = links
        normal = unit(np.cross(rays[a], rays[b]))
        places[f"pin {a}-{b}"] = JointPlace(plain_vector(pin * unit(rays[a] + rays[b])), (plain_vector(normal),))
        for link, (first, second) in zip(links, ((a, b), (b, a)), strict=True):
            ends.setdefault(("far", first), []).append(link)
            ends.setdefault(("near", second), []).append(link)
    distance = {"far": far, "near": near}
    for (which, ray), meeting in sorted(ends.items()):
        for number, pair in enumerate(pairwise(meeting), start=1):
            joints[f"{which} {ray}:{number}"] = pair
            places[f"{which} {ray}:{number}"] = JointPlace(plain_vector(distance[which] * rays[ray]))
    kinds = {joint: JointKind.REVOLUTE if places[joint].axes else JointKind.SPHERICAL for joint in joints}
    both = [link for a, b in edges for link in (f"{a}>{b}", f"{b}>{a}")]
    return JointedLinkage(SCGraph(both, joints), kinds, places)


def scissor_ring(scissors: int, opening: float) -> HingedSolids:
    """Return a ring of kinked scissors in a plane, arms 1 long; `opening` as for `scissor_polyhedron`."""
    half = pi / scissors
    pin, far, near = _distances(sin(half), opening)
    joints: dict[JointId, tuple[LinkId, LinkId]] = {}
    axes: dict[JointId, Axis] = {}
    loops = [Loop(tuple(f"{which} {i}" for i in range(scissors) for which in ("pin", "near")), Centre.INFINITE)]
    for i in range(scissors):
        after = (i + 1) % scissors
        names = f"pin {i}", f"far {after}", f"near {after}"
        ends = (f"{i}>", f"{i}<"), (f"{i}<", f"{after}>"), (f"{i}>", f"{after}<")
        joints |= dict(zip(names, ends, strict=True))
        for name, size, turn in zip(names, (pin, far, near), (2 * i + 1, 2 * i + 2, 2 * i + 2), strict=True):
            axes[name] = (size * cos(turn * half), size * sin(turn * half), 0.0), _UP
        loops.append(Loop((f"pin {i}", f"far {after}", f"pin {after}", f"near {after}"), Centre.INFINITE))
    links = [f"{i}{side}" for i in range(scissors) for side in "><"]
    return HingedSolids(SCGraph(links, joints, loops), axes)


def _distances(sine: float, opening: float) -> tuple[float, float, float]:
    """Return the distances of pins, far and near ends from the middle; `sine` is of half the angle of two rays."""
    pin = cos(opening) / sine
    along = pin * sqrt(1.0 - sine * sine)
    if along <= sin(opening):
        most = degrees(pi / 2 - asin(sine))
        what = f"opening = {degrees(opening):g} degrees, where near ends are past the middle"
        raise InvariantError("parameter", what, f"less than {most:.6g} degrees")
    return pin, along + sin(opening), along - sin(opening)
