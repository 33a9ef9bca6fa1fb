"""Bodies at one configuration: where a tree of joints puts each link, and how that changes.

Links are handled level by level, those that as many joints carry from the ground together. Theory:
docs/theory/derivatives.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphs import geometry
from graphs.types import Floats, Ints, LinkId
from synth.motion.closure import carried
from synth.motion.derivatives import AxisChange
from synth.motion.linkage import PosedLinkage
from synth.motion.placement import joints_outwards

__all__ = ["BodyPoses", "BodyTree"]


class BodyTree:
    """A tree of joints that carry links, from one that stays.

    Parameters
    ----------
    linkage : PosedLinkage
    ground : link, optional
        The link that stays; by default the first. Of a linkage in several parts, each has one.

    Attributes
    ----------
    row : dict of link to int
        The place of each link in arrays of links.

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> from synth.motion.linkage import linkage_of_axes
    >>> hinge = linkage_of_axes(SCGraph(2, [(0, 1)]), {0: ((0, 0, 0), (0, 0, 1))})
    >>> bodies = BodyTree(hinge).at(np.array([np.pi / 2]))
    >>> bodies.places(np.array([1]), np.array([[1.0, 0.0, 0.0]])).round(12).tolist()
    [[0.0, 1.0, 0.0]]
    """

    def __init__(self, linkage: PosedLinkage, ground: LinkId | None = None) -> None:
        self.linkage = linkage
        self.row = {link: row for row, link in enumerate(linkage.graph.nodes)}
        level = dict.fromkeys(linkage.graph.nodes, 0)
        edges = []
        for near, far, place, sign in joints_outwards(linkage, ground):
            level[far] = level[near] + 1
            edges.append((level[far], self.row[near], self.row[far], place, int(sign)))
        edges.sort(key=lambda edge: edge[0])
        table = np.array(edges, dtype=np.int64).reshape(-1, 5)
        starts = np.flatnonzero(np.diff(table[:, 0], prepend=0))
        self.near, self.far, self.joints, self.signs = table[:, 1:].T
        self.levels = [slice(a, b) for a, b in zip(starts, [*starts[1:], len(table)], strict=True)]

    def at(self, angles: Floats) -> BodyPoses:
        """Return where the links are at joint angles float[J], radians."""
        linkage, joints = self.linkage, self.joints
        turned = self.signs * (angles - linkage.angles)[joints]
        steps = geometry.rotations(linkage.directions[joints], turned)
        points = linkage.points[joints]
        offsets = points - np.einsum("eij,ej->ei", steps, points)
        rotations = np.tile(np.eye(3), (len(self.row), 1, 1))
        shifts = np.zeros((len(self.row), 3))
        for level in self.levels:
            near, far = self.near[level], self.far[level]
            rotations[far] = rotations[near] @ steps[level]
            shifts[far] = shifts[near] + np.einsum("eij,ej->ei", rotations[near], offsets[level])
        return BodyPoses(self, rotations, shifts)


@dataclass(frozen=True, slots=True)
class BodyPoses:
    """Links at a configuration, as rigid motions from the pose of the linkage.

    Twists of links are (w, v), rotation about the origin and shift, where the links now are; places are in units
    of the extent, about the middle. A point x of a link comes to R x + t, with R of `rotations` and t of `shifts`.
    """

    tree: BodyTree
    rotations: Floats
    shifts: Floats

    def _screws(self) -> Floats:
        """Return the axis of each joint of the tree where it now is, turned outwards: float[e, 6]."""
        tree = self.tree
        rotations = self.rotations[tree.near]
        axes = np.einsum("eij,ej->ei", rotations, tree.linkage.directions[tree.joints]) * tree.signs[:, None]
        points = np.einsum("eij,ej->ei", rotations, tree.linkage.points[tree.joints]) + self.shifts[tree.near]
        return np.concatenate([axes, np.cross(points, axes)], axis=1)

    def _by_axes(self) -> Floats:
        """Return the twists of far links by small motions of the axes of their joints: float[e, 6, 6]."""
        moved = carried(self.rotations, self.shifts)
        return np.asarray(moved[self.tree.near] - moved[self.tree.far])

    def forward(self, angles: Floats, axes: AxisChange) -> Floats:
        """Return the twists of links with changes of joint angles and axes, the ground held: float[L, 6].

        Changes of angles are in radians.
        """
        tree = self.tree
        turned = (angles - axes.zeros)[tree.joints, None] * self._screws()
        steps = turned + np.einsum("eij,ej->ei", self._by_axes(), axes.twists.reshape(-1, 6)[tree.joints])
        twists = np.zeros((len(self.shifts), 6))
        for level in tree.levels:
            twists[tree.far[level]] = twists[tree.near[level]] + steps[level]
        return twists

    def adjoint(self, wrenches: Floats) -> tuple[Floats, AxisChange]:
        """Return the gradients by joint angles and by axes of a number that depends on the poses of links.

        Its gradient by the twists of links is float[L, 6]; that by axes is for joint angles held.
        """
        tree = self.tree
        borne = wrenches.copy()
        for level in reversed(tree.levels):  # a joint bears what all links beyond it bear
            np.add.at(borne, tree.near[level], borne[tree.far[level]])
        beyond = borne[tree.far]
        angles = np.zeros(len(tree.linkage.angles))
        angles[tree.joints] = (self._screws() * beyond).sum(axis=1)
        twists = np.zeros((len(angles), 6))
        twists[tree.joints] = np.einsum("eij,ei->ej", self._by_axes(), beyond)
        return angles, AxisChange(twists.ravel(), -angles)

    def places(self, links: Ints, points: Floats) -> Floats:
        """Return where points float[N, 3] of links int[N] (rows) are: float[N, 3]."""
        return np.asarray(np.einsum("nij,nj->ni", self.rotations[links], points) + self.shifts[links])

    def places_forward(self, links: Ints, points: Floats, twists: Floats, changes: Floats) -> Floats:
        """Return how places change with twists of links, and of the points themselves: float[N, 3].

        The points, float[N, 3], and their changes are at the pose of the linkage.
        """
        there, twist = self.places(links, points), twists[links]
        own = np.einsum("nij,nj->ni", self.rotations[links], changes)
        return np.asarray(np.cross(twist[:, :3], there) + twist[:, 3:] + own)

    def places_adjoint(self, links: Ints, points: Floats, by_places: Floats) -> tuple[Floats, Floats]:
        """Return the gradients by twists of links, float[L, 6], and by the points at the pose, float[N, 3]."""
        there = self.places(links, points)
        wrenches = np.zeros((len(self.shifts), 6))
        np.add.at(wrenches, links, np.concatenate([np.cross(there, by_places), by_places], axis=1))
        return wrenches, np.einsum("nij,ni->nj", self.rotations[links], by_places)
