"""Where everything is at joint angles: links as rigid motions from the pose, vertices of panels.

Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import networkx as nx
import numpy as np

from graphs.arrays import Floats
from graphs.convert.duality import SheetMechanism
from graphs.ids import LinkId
from graphs.mechanism.plane import in_space
from graphs.mechanism.sheet import Sheet
from synth.folding.closure import turns
from synth.folding.linkage import PosedLinkage

__all__ = ["link_motions", "moved", "vertex_places"]


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
    >>> from synth.folding.linkage import linkage_of_axes
    >>> hinge = linkage_of_axes(SCGraph(2, [(0, 1)]), {0: ((0, 0, 0), (0, 0, 1))})
    >>> rotation, _ = link_motions(hinge, np.array([[np.pi / 2]]))[1]
    >>> (rotation[0] @ [1.0, 0.0, 0.0]).round(12).tolist()
    [0.0, 1.0, 0.0]
    """
    graph = linkage.graph
    column = {joint: place for place, joint in enumerate(graph.joints)}
    between = nx.Graph()
    between.add_nodes_from(graph.nodes)
    for joint, (first, second) in graph.joints.items():
        between.add_edge(first, second, joint=joint)
    still = (np.broadcast_to(np.eye(3), (len(angles), 3, 3)), np.zeros((len(angles), 3)))
    motions: dict[LinkId, tuple[Floats, Floats]] = {}
    for root in [*([] if ground is None else [ground]), *graph.nodes]:
        if root in motions:
            continue
        motions[root] = still
        for near, far in nx.bfs_edges(between, root):
            place = column[between[near][far]["joint"]]
            sign = 1.0 if graph.joints[between[near][far]["joint"]][0] == near else -1.0
            turn = turns(linkage.directions[place], sign * (angles[:, place] - linkage.angles[place]))
            rotation, shift = motions[near]
            point = linkage.points[place]
            motions[far] = rotation @ turn, shift + (rotation @ (point - turn @ point)[..., None])[..., 0]
    return motions


def moved(linkage: PosedLinkage, angles: Floats) -> PosedLinkage:
    """Return the linkage with its axes where they are at joint angles float[J], radians: its pose is that one."""
    motions = link_motions(linkage, angles[None])
    points, directions = np.empty_like(linkage.points), np.empty_like(linkage.directions)
    for place, (first, _) in enumerate(linkage.graph.joints.values()):
        rotation, shift = motions[first]
        points[place] = rotation[0] @ linkage.points[place] + shift[0]
        directions[place] = rotation[0] @ linkage.directions[place]
    return replace(linkage, points=points, directions=directions, angles=angles)


def vertex_places(
    sheet: Sheet, mechanism: SheetMechanism, linkage: PosedLinkage, angles: Floats
) -> tuple[Floats, Floats]:
    """Return where the vertices of a crease pattern are, and how far panels disagree on that.

    Parameters
    ----------
    sheet : Sheet
        With coordinates.
    mechanism : SheetMechanism
        Of the sheet.
    linkage : PosedLinkage
        Of both.
    angles : float[F, J]
        Fold angles of many poses, radians.

    Returns
    -------
    places : float[F, vertices, 3]
        In the unit of the coordinates. Vertices of no face stay.
    apart : float[F]
        Largest distance between two places of one vertex, by different panels, in units of the extent.
    """
    assert sheet.coordinates is not None
    local = (in_space(sheet.coordinates) - linkage.middle) / linkage.extent
    motions = link_motions(linkage, angles, _largest(mechanism.panels))
    places = np.broadcast_to(local, (len(angles), *local.shape)).copy()
    placed = np.zeros(sheet.vertices, dtype=bool)
    apart = np.zeros(len(angles))
    for link, faces in enumerate(mechanism.panels):
        here = sorted({vertex for face in faces for vertex in sheet.faces[face]})
        rotation, shift = motions[link]
        moved = np.einsum("fij,vj->fvi", rotation, local[here]) + shift[:, None]
        known = placed[here]
        again = moved[:, known] - places[:, np.array(here)[known]]
        apart = np.maximum(apart, np.linalg.norm(again, axis=-1).max(axis=1, initial=0.0))
        places[:, np.array(here)[~known]] = moved[:, ~known]
        placed[here] = True
    return places * linkage.extent + linkage.middle, apart


def _largest(panels: Sequence[Sequence[Any]]) -> int:
    """Return the link of most faces: what a sheet is held by."""
    return max(range(len(panels)), key=lambda link: len(panels[link]))
