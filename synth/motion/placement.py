"""Where everything is at joint angles: links as rigid motions from the configuration given.

Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import networkx as nx
import numpy as np

from graphs.geometry import rotations
from graphs.types import Floats, LinkId
from synth.motion.linkage import PosedLinkage

__all__ = ["joints_outwards", "link_motions", "moved"]


def link_motions(
    linkage: PosedLinkage, angles: Floats, ground: LinkId | None = None
) -> dict[LinkId, tuple[Floats, Floats]]:
    """Return how each link has moved from the pose, along a tree of joints from a link that stays.

    Parameters
    ----------
    linkage : PosedLinkage
    angles : float[F, J]
        Joint angles of many poses, radians.
    ground : link, optional
        The link that stays; by default the first. Of a linkage in several parts, each has one.

    Returns
    -------
    dict of link to (float[F, 3, 3], float[F, 3])
        Rotation R and shift t: a point x of the link comes to R x + t, in units of the extent, about the middle.

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> from synth.motion.linkage import linkage_of_axes
    >>> hinge = linkage_of_axes(SCGraph(2, [(0, 1)]), {0: ((0, 0, 0), (0, 0, 1))})
    >>> rotation, _ = link_motions(hinge, np.array([[np.pi / 2]]))[1]
    >>> (rotation[0] @ [1.0, 0.0, 0.0]).round(12).tolist()
    [0.0, 1.0, 0.0]
    """
    still = (np.broadcast_to(np.eye(3), (len(angles), 3, 3)), np.zeros((len(angles), 3)))
    motions: dict[LinkId, tuple[Floats, Floats]] = {}
    for near, far, place, sign in joints_outwards(linkage, ground):
        value = sign * (angles[:, place] - linkage.angles[place])
        rotation, shift = motions.setdefault(near, still)
        if place in linkage.slides:
            motions[far] = rotation, shift + value[:, None] * (rotation @ linkage.directions[place])
            continue
        turn, point = rotations(linkage.directions[place], value), linkage.points[place]
        motions[far] = rotation @ turn, shift + (rotation @ (point - turn @ point)[..., None])[..., 0]
    return {link: motions.get(link, still) for link in linkage.graph.nodes}


def joints_outwards(
    linkage: PosedLinkage, ground: LinkId | None = None
) -> Iterator[tuple[LinkId, LinkId, int, float]]:
    """Yield joints that carry links, those nearer to the links that stay first.

    Yields a link, the link that it carries, the place of the joint between them in the list of joints, and 1 or
    -1: by which of its angle the far one is turned. The ground, by default the first link, stays; each part of a
    linkage in several parts has one link that does.

    >>> from graphs.mechanism.sc import SCGraph
    >>> from synth.motion.linkage import linkage_of_axes
    >>> hinge = linkage_of_axes(SCGraph(2, [(0, 1)]), {0: ((0, 0, 0), (0, 0, 1))})
    >>> list(joints_outwards(hinge, ground=1))
    [(1, 0, 0, -1.0)]
    """
    graph = linkage.graph
    column = {joint: place for place, joint in enumerate(graph.joints)}
    between = nx.Graph()
    between.add_nodes_from(graph.nodes)
    for joint, (first, second) in graph.joints.items():
        between.add_edge(first, second, joint=joint)
    carried: set[LinkId] = set()
    for root in [*([] if ground is None else [ground]), *graph.nodes]:
        if root in carried:
            continue
        carried.add(root)
        for near, far in nx.bfs_edges(between, root):
            carried.add(far)
            joint = between[near][far]["joint"]
            yield near, far, column[joint], 1.0 if graph.joints[joint][0] == near else -1.0


def moved(linkage: PosedLinkage, angles: Floats) -> PosedLinkage:
    """Return the linkage with its axes where they are at joint angles float[J], radians: its pose is that one."""
    motions = link_motions(linkage, angles[None])
    points, directions = np.empty_like(linkage.points), np.empty_like(linkage.directions)
    for place, (first, _) in enumerate(linkage.graph.joints.values()):
        rotation, shift = motions[first]
        points[place] = rotation[0] @ linkage.points[place] + shift[0]
        directions[place] = rotation[0] @ linkage.directions[place]
    return replace(linkage, points=points, directions=directions, angles=angles)
