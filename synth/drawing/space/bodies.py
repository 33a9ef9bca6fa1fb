"""Hinged solids as bodies that can be drawn: each link is the hull of the pieces of axis that are its hinges.

A link with two hinges is a tetrahedron on them, or a plate where they are parallel, which is what kaleidocycles
and the linkages of Sarrus are made of. A file tells axes, not where on them hinges are: they are put where the
axes of a link come nearest to each other.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from graphs.geometry import frame_about, principal_axes
from graphs.tolerances import DOUBLE
from graphs.types import Floats, LinkId
from synth.drawing.space.panels import HINGE, Panels
from synth.motion.linkage import PosedLinkage
from synth.motion.placement import link_motions

__all__ = ["bodies_of", "hinge_ends", "places_of_hinges"]

_HALF = 0.5
"""Half the length of a hinge, in units of the median distance of neighbouring ones."""
_APART, _HALF_APART = 1.0, 0.35
"""Where all axes pass through one point: how far from it hinges are; half their length."""


def bodies_of(linkage: PosedLinkage) -> tuple[Panels, Floats]:
    """Return the faces of all links, their front outside, and the corners at the pose: float[2 J, 3].

    Corners 2 j and 2 j + 1 are the ends of hinge j, in units of the extent. A link with one hinge has no body.
    """
    corners = hinge_ends(linkage).reshape(-1, 3)
    faces: list[tuple[int, ...]] = []
    link_of: dict[int, LinkId] = {}
    for link, hinges in _hinges_of_links(linkage).items():
        own = [2 * hinge + end for hinge in hinges for end in (0, 1)]
        for face in _hull(corners[own]):
            link_of[len(faces)] = link
            faces.append(tuple(own[corner] for corner in face))
    joint_of = {frozenset((2 * i, 2 * i + 1)): joint for i, joint in enumerate(linkage.graph.joints)}
    return Panels(faces, link_of, joint_of, dict.fromkeys(joint_of, HINGE), solid=True), corners


def places_of_hinges(linkage: PosedLinkage, angles: Floats) -> Floats:
    """Return the ends of hinges in many configurations, float[F, 2 J, 3], numbered as in `bodies_of`.

    Joint angles are float[F, J], radians.
    """
    motions = link_motions(linkage, angles)
    found = [
        ends @ np.swapaxes(motions[first][0], 1, 2) + motions[first][1][:, None]
        for ends, (first, _) in zip(hinge_ends(linkage), linkage.graph.joints.values(), strict=True)
    ]
    return np.concatenate(found, axis=1)


def hinge_ends(linkage: PosedLinkage) -> Floats:
    """Return the ends of the piece of each axis that is drawn: float[J, 2, 3].

    Its middle is that of the feet of the common perpendiculars to the other axes of the two links.
    """
    neighbours = _neighbours(linkage)
    middles = np.array(
        [
            np.mean([_foot(linkage, hinge, other) for other in others], axis=0)
            if others
            else linkage.points[hinge]
            for hinge, others in enumerate(neighbours)
        ]
    ).reshape(-1, 3)
    apart = [
        float(np.linalg.norm(middles[i] - middles[j]))
        for i, others in enumerate(neighbours)
        for j in others
        if i < j
    ]
    half = _HALF * float(np.median(apart)) if apart else _HALF
    if half < DOUBLE.same_point:
        middles, half = middles + _APART * linkage.directions, _HALF_APART
    along = half * linkage.directions
    return np.stack([middles - along, middles + along], axis=1)


def _hinges_of_links(linkage: PosedLinkage) -> dict[LinkId, list[int]]:
    found: dict[LinkId, list[int]] = {link: [] for link in linkage.graph.nodes}
    for hinge, ends in enumerate(linkage.graph.joints.values()):
        for link in ends:
            found[link].append(hinge)
    return found


def _neighbours(linkage: PosedLinkage) -> list[list[int]]:
    """Return the other hinges of the two links of each hinge."""
    of_links = _hinges_of_links(linkage)
    return [
        sorted({other for link in ends for other in of_links[link]} - {hinge})
        for hinge, ends in enumerate(linkage.graph.joints.values())
    ]


def _foot(linkage: PosedLinkage, hinge: int, other: int) -> Floats:
    """Return the point of an axis that is nearest to another; of a parallel one, to the point given of it."""
    p, d = linkage.points[hinge], linkage.directions[hinge]
    q, e = linkage.points[other], linkage.directions[other]
    across = np.cross(d, e)
    square = float(across @ across)
    if square < DOUBLE.parallel:
        return np.asarray(p + ((q - p) @ d) * d)
    return np.asarray(p + float(np.cross(q - p, e) @ across) / square * d)


def _hull(corners: Floats) -> list[list[int]]:
    """Return the faces of the hull of points, counter-clockwise seen from outside; of a plate its two sides."""
    if len(corners) < 3:
        return []
    sizes, axes = principal_axes(corners)
    if sizes[1] < DOUBLE.same_point * max(sizes[0], DOUBLE.same_point):
        return []
    if sizes[2] < DOUBLE.flat * sizes[0]:
        front = _around(corners, list(range(len(corners))), axes[2])
        return [front, front[::-1]]
    from scipy.spatial import ConvexHull

    hull = ConvexHull(corners)
    sides: dict[tuple[float, ...], set[int]] = {}
    for triangle, plane in zip(hull.simplices.tolist(), hull.equations, strict=True):
        sides.setdefault(tuple((plane.round(6) + 0.0).tolist()), set()).update(triangle)
    return [_around(corners, sorted(side), np.array(plane[:3])) for plane, side in sides.items()]


def _around(corners: Floats, chosen: Sequence[int], normal: Floats) -> list[int]:
    """Return the outer corners of points in a plane, counter-clockwise about its normal."""
    from scipy.spatial import ConvexHull

    flat = corners[list(chosen)] @ frame_about(normal)[:2].T
    return [chosen[corner] for corner in ConvexHull(flat).vertices.tolist()]
