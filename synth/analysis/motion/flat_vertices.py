"""Flat vertices of four creases and their two modes; lines along which a flat sheet folds straight.

Theory: docs/theory/folding.md.
"""

from math import pi

import networkx as nx
import numpy as np

from graphs.geometry import lines_meet, sectors, unit
from graphs.loops.loop import Centre
from graphs.tolerances import DOUBLE, MARGIN
from graphs.types import Floats, Ints
from synth.analysis.motion.linkage import Linkage, LinkageLoop


class FlatVertices:
    """The loops of a linkage that are flat vertices of four creases, each with two modes.

    In either mode one pair of opposite creases folds the same way and the other does not. `linear` says that in
    all loops opposite sectors make 180 degrees, and all creases are flat: tan(fold / 2) are in proportion in each
    mode.
    """

    def __init__(self, linkage: Linkage) -> None:
        self._loops = linkage.loops
        self._ways: list[Floats | None] = []
        flat = [np.abs(linkage.angles).max(initial=0.0) <= DOUBLE.parallel]
        for loop in linkage.loops:
            outward, folds = _outward(linkage, loop), None
            if outward is not None:  # 1 for creases that fold one way at a positive angle, -1 for others
                folds = np.sign((outward * linkage.directions[list(loop.joints)]).sum(axis=1)) * loop.signs
            # opposite sectors make 180 degrees
            flat.append(outward is not None and abs(sectors(outward)[::2].sum() - pi) <= DOUBLE.parallel)
            self._ways.append(folds)
        self.linear = bool(all(flat))

    def modes(self, rates: Floats) -> tuple[tuple[int, int] | None, ...]:
        """Return the opposite creases (places) that fold alike at each vertex, by general rates; else None."""
        return tuple(_mode(loop, ways, rates) for loop, ways in zip(self._loops, self._ways, strict=True))


def _mode(loop: LinkageLoop, ways: Floats | None, rates: Floats) -> tuple[int, int] | None:
    if ways is None:
        return None
    folds = rates[list(loop.joints)] * ways
    alike = folds[:2] * folds[2:]
    same = int(alike[1] > alike[0] + MARGIN * abs(float(alike[0])))
    first, second = sorted(loop.joints[same::2])
    return (first, second) if alike[same] > DOUBLE.zero_rate**2 else None


def _outward(linkage: Linkage, loop: LinkageLoop) -> Floats | None:
    """Return the directions of four creases away from a flat vertex: float[4, 3]; None of other loops."""
    joints = list(loop.joints)
    if loop.centre is not Centre.FINITE or len(joints) != 4:
        return None
    points = linkage.points[joints]
    away = points - lines_meet(points, linkage.directions[joints]).point
    if np.linalg.norm(away, axis=1).min() <= DOUBLE.same_point:  # no crease, but an axis through that point
        return None
    outward = unit(away)
    return outward if abs(sectors(outward).sum() - 2 * pi) <= DOUBLE.parallel else None


def straight_folds(linkage: Linkage) -> tuple[Ints, ...]:
    """Return for each family of parallel lines along which a flat sheet folds straight the line of each joint, int[J].

    It is -1 for joints that are on none. A line is of creases that go on straight at every vertex, and beyond holes;
    all its creases fold alike. Parallel lines meet at no vertex, so their angles are free. Whether loops round holes
    close then is left to the caller.
    """
    size = len(linkage.angles)
    next_to, ends = nx.Graph(), np.zeros(size, dtype=bool)
    next_to.add_nodes_from(range(size))
    by_size: dict[int, list[tuple[int, ...]]] = {}
    for loop in linkage.loops:
        by_size.setdefault(len(loop.joints), []).append(loop.joints)
    for joints in map(np.array, by_size.values()):
        along, at = linkage.directions[joints][:, :, None], linkage.points[joints]
        turned = np.abs(np.cross(along, along.transpose(0, 2, 1, 3))).max(axis=3)
        beside = np.abs(np.cross(along, at[:, :, None] - at[:, None])).max(axis=3)
        same = (turned <= DOUBLE.parallel) & (beside <= DOUBLE.same_point)
        ends[joints[same.sum(axis=2) == 1]] = True  # of itself alone: the line does not go on
        loops, one, other = np.nonzero(np.triu(same, 1))
        next_to.add_edges_from(zip(joints[loops, one].tolist(), joints[loops, other].tolist(), strict=True))
    whole = [sorted(line) for line in nx.connected_components(next_to) if not ends[list(line)].any()]
    families: list[tuple[Floats, list[list[int]]]] = []
    for line in sorted(whole):
        along = linkage.directions[line[0]]
        near = (lines for first, lines in families if np.abs(np.cross(first, along)).max() <= DOUBLE.parallel)
        family = next(near, None)
        if family is None:
            families.append((along, family := []))
        family.append(line)
    numbers = []
    for _, family in families:
        number = np.full(size, -1)
        for place, line in enumerate(family):
            number[line] = place
        numbers.append(number)
    return tuple(numbers)
