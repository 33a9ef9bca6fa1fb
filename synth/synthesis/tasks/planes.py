"""Planes of motion: members of planar chains are turned so that the wishes about their links lie in the plane.

Links that parallel axes carry against the base move in one plane, whatever their dimensions are, and the search keeps
these axes parallel as they are. So a member with a random plane misses wishes in any other one at all starts.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import networkx as nx
import numpy as np

from graphs.geometry import angles_between, common_direction, crossing, rotated, unit
from graphs.joints.linkage import plain_vector
from graphs.loops.loop import Centre
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from graphs.rank.singular_values import null_space
from graphs.tolerances import DOUBLE
from graphs.types import Floats, JointId
from synth.synthesis.designing.wishes import POSE, LinkDirection, LinkOrientation, PointPlace, Wish


def turned_to_wishes(member: HingedSolids, wishes: Iterable[Wish]) -> HingedSolids:
    """Return a member of a chain whose planar motion against its ground is in a plane in which wishes lie.

    It is turned as a whole by the least angle. It stays where no link moves in a plane against the ground, or wishes
    for it lie in no common plane: then no member of the type meets all.

    Parameters
    ----------
    member : HingedSolids
    wishes : iterable of Wish
        Those about links by their names: orientations, directions, places.

    Examples
    --------
    A planar four-bar whose coupler is to turn about the axis x:

    >>> from graphs.loops.loop import Loop
    >>> chain = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3), "infinite")])
    >>> member = HingedSolids(chain, {joint: ((joint, joint**2, 0.0), (0.0, 0.0, 1.0)) for joint in range(4)})
    >>> wish = LinkOrientation(at="turned", link="2", quaternion=(0.9, 0.1, 0.0, 0.0))
    >>> [round(abs(part), 9) for part in turned_to_wishes(member, [wish]).axes[0][1]]
    [1.0, 0.0, 0.0]
    """
    every = list(wishes)
    for joints, links in planar_parts(member.chain):
        conditions = [row for wish in every for row in _across(wish, links)]
        if conditions:
            normal = common_direction(np.array([member.axes[joint][1] for joint in joints], dtype=float))
            normals = null_space(np.array(conditions), DOUBLE.same_configuration)
            return _turned(member, normal, _nearest(normal, normals)) if normals.size else member
    return member


def _nearest(direction: Floats, basis: Floats) -> Floats:
    """Return the unit vector of a space, float[3, k] its basis, nearest to a direction, so that random ones differ.

    All are equally near to one across the space; then it is the first of the basis.
    """
    along = basis.T @ direction
    return unit(basis @ along) if np.linalg.norm(along) > DOUBLE.same_configuration else basis[:, 0]


def planar_parts(chain: SCGraph) -> list[tuple[Sequence[JointId], frozenset[str]]]:
    """Return the parallel joints that carry links in a plane against the ground, with the names of these links.

    The ground is the first link where a chain has none. There is one part for each class of loops whose centre is at
    infinity and that has a joint on the ground.
    """
    ground = chain.ground if chain.ground is not None else next(iter(chain.nodes))
    parts: list[tuple[Sequence[JointId], frozenset[str]]] = []
    for one in chain.centre_classes():
        joints = [joint for joint in chain.joints if joint in one.joints]
        bodies = nx.Graph(chain.joints[joint] for joint in joints)
        if one.centre is Centre.INFINITE and ground in bodies:
            links = nx.node_connected_component(bodies, ground) - {ground}
            parts.append((joints, frozenset(map(str, links))))
    return parts


def _across(wish: Wish, links: frozenset[str]) -> list[Floats]:
    """Return vectors float[3] to which the normal of the plane must be perpendicular, for a wish about some links.

    A rotation in a plane is about its normal; changes of a direction and of a place from those of the file lie in it.
    """
    if wish.at == POSE:
        return []
    if isinstance(wish, LinkOrientation) and wish.link in links:
        axis = np.array(wish.quaternion[1:], dtype=float)
        turned = 2.0 * np.linalg.norm(axis) / np.linalg.norm(wish.quaternion) > DOUBLE.same_configuration
        return list(crossing(unit(axis))) if turned else []
    change = np.zeros(3)
    if isinstance(wish, LinkDirection) and wish.link in links:
        change = unit(wish.equals) - unit(wish.vector)
    elif isinstance(wish, PointPlace) and wish.point.link in links and None not in wish.equals:
        change = np.array(wish.equals, dtype=float) - np.array(wish.point.point)
    return [unit(change)] if np.linalg.norm(change) > DOUBLE.same_configuration else []


def _turned(member: HingedSolids, before: Floats, after: Floats) -> HingedSolids:
    """Return a member turned about the origin so that one direction comes to be another, or its opposite."""
    after = after if before @ after >= 0.0 else -after
    angle = float(angles_between(before, after))
    if angle <= DOUBLE.parallel:
        return member
    axis = unit(np.cross(before, after))
    axes = {}
    for joint, (point, direction) in member.axes.items():
        place, along = rotated(np.array([point, direction], dtype=float), axis, angle)
        axes[joint] = (plain_vector(place), plain_vector(along))
    return HingedSolids(member.chain, axes)
