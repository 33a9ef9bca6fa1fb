"""Planar loops with joints of several kinds: revolutes across the plane, slides and planar joints along it.

Theory: docs/theory/joints.md.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from graphs.geometry import unit
from graphs.ids import JointId
from graphs.joints.linkage import JointedLinkage, JointKind
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.precision import precision_of_axes
from graphs.mechanism.sc import SCGraph
from graphs.rank.closure import independent_cycles
from graphs.tolerances import Tolerances

__all__ = ["with_planar_loops"]


def with_planar_loops(linkage: JointedLinkage) -> JointedLinkage:
    """Return a linkage with the loops that are planar as it lies given an infinite centre.

    Loops that have a centre keep it. Without places nothing is found.

    Parameters
    ----------
    linkage : JointedLinkage

    Examples
    --------
    A slider-crank in the xy plane:

    >>> from graphs.joints.linkage import JointPlace
    >>> ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
    >>> places = {joint: JointPlace((joint, joint % 2, 0), ((0, 0, 1),)) for joint in range(3)}
    >>> places[3] = JointPlace((0, 0, 0), ((1, 0, 0),))
    >>> crank = JointedLinkage(ring, {3: JointKind.PRISMATIC}, places)
    >>> crank.mobility, with_planar_loops(crank).mobility
    (-2, 1)
    """
    if not linkage.places:
        return linkage
    chain = linkage.chain
    points = np.array([place.point for place in linkage.places.values()])
    axes = np.array([axis for place in linkage.places.values() for axis in place.axes]).reshape(-1, 3)
    parallel = Tolerances.of(precision_of_axes(points, axes).size).parallel
    loops = [
        Loop(loop.joints, Centre.INFINITE)
        if not loop.has_centre and _is_planar(linkage, loop.joints, parallel)
        else loop
        for loop in independent_cycles(chain)
    ]
    if sum(loop.has_centre for loop in loops) == len(chain.centred_loops):
        return linkage
    whole = SCGraph(chain.nodes, chain.joints, loops, closing=chain.closing, ground=chain.ground)
    return JointedLinkage(whole, linkage.kinds, linkage.places)


def _is_planar(linkage: JointedLinkage, joints: Sequence[JointId], parallel: float) -> bool:
    """Tell whether the joints of a loop move its links in one plane, and turn some of them."""
    if not all(linkage.kinds[joint].planar for joint in joints):
        return False
    turning = [joint for joint in joints if linkage.kinds[joint] is not JointKind.PRISMATIC]
    if not turning:
        return False
    axes = {joint: unit(linkage.places[joint].axes[0]) for joint in joints}
    normal = axes[turning[0]]
    if any(np.linalg.norm(np.cross(axes[joint], normal)) > parallel for joint in turning):
        return False
    return all(abs(axes[joint] @ normal) <= parallel for joint in joints if joint not in turning)
