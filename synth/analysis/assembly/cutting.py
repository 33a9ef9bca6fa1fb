"""Loops as they can be cut open without leaving the type: each at a joint of its own.

A member whose loops close to any quaternion is a linkage of the type if the joint beside the cut is in no other loop,
and no other joint of its link has the same axis: then the cut only moves that axis in that link. Theory:
docs/theory/positions.md.
"""

from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

import networkx as nx
import numpy as np

from graphs.loops.loop import Centre
from graphs.tolerances import DOUBLE, Tolerances
from synth.analysis.motion.linkage import Linkage, LinkageLoop, centre_of

_Passage = tuple[int, int, int]
"""A joint, and the links, by their numbers, from which and to which a loop passes it."""


def with_own_joints(linkage: Linkage, tolerances: Tolerances) -> Linkage:
    """Return the linkage with loops each of which begins or ends with a joint to be cut at, where there are such.

    Loops that share joints are replaced by those of a tree of links, if they are all about centres, or in one plane.
    """
    cuts = _Cuts(linkage, tolerances)
    together = nx.Graph()
    for number, loop in enumerate(linkage.loops):
        together.add_edges_from((("loop", number), joint) for joint in loop.joints)
    loops: list[LinkageLoop] = []
    for part in nx.connected_components(together):
        own = [linkage.loops[node[1]] for node in sorted(node for node in part if isinstance(node, tuple))]
        centres = {centre_of(linkage, loop, tolerances) for loop in own}
        (centre, *others) = centres
        passed = [cuts.passages(loop) for loop in own]
        begun = [
            cuts.begun(loop, [joint for one in passed if one is not loop for joint, _, _ in one]) for loop in passed
        ]
        if None in begun and not others and cuts.in_one_plane(own, centre):
            begun = list(cuts.of_tree(passed))
        for loop, given, found in zip(own, passed, begun, strict=True):
            order = found or given
            signs = tuple(1 if near == cuts.ends[joint][0] else -1 for joint, near, _ in order)
            loops.append(replace(loop, joints=tuple(joint for joint, _, _ in order), signs=signs))
    return replace(linkage, loops=tuple(loops))


class _Cuts:
    """At which links joints may be cut off."""

    def __init__(self, linkage: Linkage, tolerances: Tolerances) -> None:
        number = {link: place for place, link in enumerate(linkage.graph.nodes)}
        self._linkage = linkage
        self.ends = [(number[one], number[other]) for one, other in linkage.graph.joints.values()]
        self._at: dict[int, list[int]] = {}
        for joint in sorted({joint for loop in linkage.loops for joint in loop.joints}):
            for link in self.ends[joint]:
                self._at.setdefault(link, []).append(joint)
        flat = [loop for loop in linkage.loops if centre_of(linkage, loop, tolerances) is Centre.INFINITE]
        self._in_plane = {joint for loop in flat for joint in loop.joints}

    def in_one_plane(self, loops: Sequence[LinkageLoop], centre: Centre) -> bool:
        turning = [joint for loop in loops for joint in loop.joints if joint not in self._linkage.slides]
        axes = self._linkage.directions[turning]
        return centre is Centre.FINITE or bool(np.abs(np.cross(axes, axes[0])).max() <= DOUBLE.meant)

    def free(self, joint: int, link: int) -> bool:
        """Whether no other joint of a link has the axis of this one."""
        points, directions = self._linkage.points, self._linkage.directions
        for other in self._at[link]:
            if other == joint or np.abs(np.cross(directions[other], directions[joint])).max() > DOUBLE.same_point:
                continue
            apart = np.cross(points[other] - points[joint], directions[joint])
            if joint not in self._in_plane or np.abs(apart).max() <= DOUBLE.same_point:
                return False
        return True

    def passages(self, loop: LinkageLoop) -> list[_Passage]:
        return [
            (joint, *(self.ends[joint] if sign > 0 else self.ends[joint][::-1]))
            for joint, sign in zip(loop.joints, loop.signs, strict=True)
        ]

    def begun(self, loop: Sequence[_Passage], elsewhere: Sequence[int]) -> list[_Passage] | None:
        """Return a loop begun, or ended, with a joint that is not elsewhere and can be cut off; None without one."""
        for place, (joint, near, far) in enumerate(loop):
            if joint in elsewhere:
                continue
            if self.free(joint, near):
                return [*loop[place:], *loop[:place]]
            if self.free(joint, far):
                return [*loop[place + 1 :], *loop[: place + 1]]
        return None

    def of_tree(self, loops: Sequence[Sequence[_Passage]]) -> Iterator[list[_Passage] | None]:
        """Yield the loops that joints beside a tree of links close; joints that cannot be cut off are in the tree."""
        joints = sorted({joint for loop in loops for joint, _, _ in loop})
        firm = [joint for joint in joints if not any(self.free(joint, link) for link in self.ends[joint])]
        tree, parts = nx.Graph(), nx.utils.UnionFind()
        beside: dict[int, list[int]] = {}
        for joint in joints:
            for link in self.ends[joint]:
                beside.setdefault(link, []).append(joint)

        def joined(joint: int) -> bool:
            first, second = self.ends[joint]
            if parts[first] == parts[second]:
                return False
            parts.union(first, second)
            tree.add_edge(first, second, joint=joint)
            return True

        for joint in firm:
            joined(joint)
        waiting = deque(sorted(beside, key=lambda link: -len(beside[link])))
        while waiting:  # breadth first from the link with most joints, so that loops are short
            for joint in beside[waiting.popleft()]:
                joined(joint)
        used = {joint for _, _, joint in tree.edges(data="joint")}
        for joint in joints:
            if joint not in used:
                first, second = self.ends[joint]
                path = nx.shortest_path(tree, second, first)
                back = [(tree[a][b]["joint"], a, b) for a, b in pairwise(path)]
                yield self.begun([(joint, first, second), *back], [other for other, _, _ in back])
