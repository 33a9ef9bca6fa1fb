"""Hervé's class of a linkage: trivial, exceptional or paradoxical. Theory: docs/theory/mobility-by-count.md.

Source: J. M. Hervé, "Analyse structurelle des mécanismes par groupe des déplacements", Mech. Mach. Theory 13, 1978.
The group of all displacements is that of the Lie algebra which the screws of the joints generate. Exceptional
linkages are told from paradoxical ones by random lengths and angles that keep parallel, concurrent and coplanar axes.
"""

from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any, Literal

import networkx as nx
import numpy as np

from graphs.errors import numbered
from graphs.geometry import lines_meet, unit
from graphs.joints.linkage import JointedLinkage
from graphs.loops.loop import Centre
from graphs.plain_data import fields_to_json
from graphs.rank.singular_values import rank_of, row_space
from graphs.tolerances import DOUBLE, Tolerances
from graphs.types import Floats
from synth.analysis.motion.closure import ClosureEquations, corrected
from synth.analysis.motion.configuration import Configuration
from synth.analysis.motion.linkage import Linkage, LinkageLoop, moved
from synth.analysis.motion.singular.sampling import closes_along_general_rates
from synth.analysis.overconstraint.mobility_of_joints import linkage_as_counted

MOST_AXES = 100
"""Axes of the largest linkage whose class is told: relations are looked for among all pairs of a loop."""
_MEMBERS = 3
"""Random linkages of which the one with the fewest degrees of freedom counts."""
_SPACE = 6
_STEP = 0.1
"""Radians of the joint that moves most, aside on a branch."""

Kind = Literal["trivial", "exceptional", "paradoxical"]


@dataclass(frozen=True, slots=True)
class HerveClass:
    """Why a linkage moves, by groups of displacements.

    Attributes
    ----------
    kind : {"trivial", "exceptional", "paradoxical"}
        One group, and Eq. 1 with its dimension gives the degrees of freedom; several groups; lengths and angles.
    dimension : int
        Of the group that holds all displacements: lambda.
    freedoms : int
        Degrees of freedom of the linkage.
    by_group, by_axes : int
        What Eq. 1 with lambda gives; degrees of freedom of a random linkage with the same parallel, concurrent and
        coplanar axes, of a paradoxical linkage at most.

    Examples
    --------
    >>> import synth
    >>> [herve_class(synth.move(synth.generate(name).mechanism).configuration).kind for name in ("sarrus", "bennett")]
    ['exceptional', 'paradoxical']
    """

    kind: Kind
    dimension: int
    freedoms: int
    by_group: int
    by_axes: int

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return fields_to_json(self, keys={"kind": "class", "dimension": "lambda"})

    def __str__(self) -> str:
        if self.kind == "trivial":
            why = f"one group of displacements, Eq. 1 with lambda = {self.dimension} gives {self.by_group}"
        else:
            which = "a random linkage with the same parallel, concurrent and coplanar axes"
            count = numbered(self.by_axes, "degree of freedom", "degrees of freedom")
            if self.kind == "exceptional":
                why = f"several groups of displacements: Eq. 1 gives {self.by_group}, {which} has {count}"
            else:
                has = f"has at most {count}" if self.by_axes else "is rigid"
                why = f"lengths and angles: {which} {has}"
        return f"Hervé's class: {self.kind} ({why})"


def herve_class(at: Configuration) -> HerveClass | None:
    """Return Hervé's class of a linkage at a configuration.

    Parameters
    ----------
    at : Configuration
        Judged on the branch that is taken, at a configuration on it.

    Returns
    -------
    HerveClass or None
        None for a rigid linkage, one of more than 100 axes, one that is singular all along, and where no random
        linkage with the same relations between axes could be placed.
    """
    found = _on_branch(at)
    if found is None or not len(found[0].angles):
        return None
    linkage, near = found
    screws = _screws(linkage.points, linkage.directions, linkage)
    joints = len(screws)
    freedoms = joints - _rank(linkage, screws)
    if freedoms <= 0:
        return None
    dimension = _dimension(screws, near)
    graph = linkage.graph
    by_group = dimension * (len(graph) - graph.components - joints) + joints
    if by_group == freedoms:
        return HerveClass("trivial", dimension, freedoms, by_group, freedoms)
    relations = _Relations(linkage, near)
    random = [relations.member(np.random.default_rng(seed)) for seed in range(_MEMBERS)]
    members = [member for member in random if member is not None]
    if not members:
        return None
    by_axes = min(_freedoms_of(member, freedoms) for member in members)
    kind: Kind = "exceptional" if by_axes >= freedoms else "paradoxical"
    return HerveClass(kind, dimension, freedoms, by_group, by_axes)


def _freedoms_of(member: Linkage, enough: int) -> int:
    """Return the degrees of freedom of a random linkage: its rates, if general ones close.

    Otherwise it is shaky and has fewer, so that the number is a bound.
    """
    rates = len(member.angles) - _rank(member, _screws(member.points, member.directions, member))
    if rates < enough:
        return rates
    closure = ClosureEquations(member)
    if closes_along_general_rates(closure, member.angles, np.arange(len(member.angles))):
        return rates
    return min(rates, enough) - 1


def _on_branch(at: Configuration) -> tuple[Linkage, float] | None:
    """Return a linkage on its branch, away from coincidences of the configuration, and how far axes may miss.

    None if it is too large, or has more rates there than the branch has degrees of freedom.
    """
    if len(at.linkage.angles) > MOST_AXES:
        return None
    if isinstance(at.given, JointedLinkage):  # slides take the place of linkages of Sarrus
        at = Configuration(linkage_as_counted(at).linkage, at.precision, at.exact)
    near = max(DOUBLE.zero_rate, Tolerances.of(at.precision.size).parallel)
    branch = at.branch(at.chosen)
    if branch is None:
        return at.linkage, near
    linkage = moved(at.linkage, _aside(at.closure, branch.sample))
    rates = len(linkage.angles) - _rank(linkage, _screws(linkage.points, linkage.directions, linkage))
    return None if branch.freedoms is not None and branch.freedoms != rates else (linkage, near)


def _aside(closure: ClosureEquations, angles: Floats) -> Floats:
    """Return joint angles a general step further on a branch: axes of different legs may have met by chance."""
    chance = np.random.default_rng(len(angles)).normal(size=len(angles))
    rates = corrected(closure, angles).space.projected(chance)
    size = float(np.abs(rates).max(initial=0.0))
    if size <= DOUBLE.zero_rate:
        return angles
    end = corrected(closure, angles + _STEP / size * rates)
    return end.angles if end.closed else angles


def _screws(points: Floats, directions: Floats, linkage: Linkage) -> Floats:
    """Return the screws of joints: float[J, 6], rotation and translation at the origin."""
    screws = np.hstack([directions, np.cross(points, directions)])
    slides = list(linkage.slides)
    screws[slides] = np.hstack([np.zeros_like(directions[slides]), directions[slides]])
    return screws


def _rank(linkage: Linkage, screws: Floats) -> int:
    """Return the rank of the closure equations of all loops, six each."""
    matrix = np.zeros((_SPACE * len(linkage.loops), len(screws)))
    for number, loop in enumerate(linkage.loops):
        columns = screws[list(loop.joints)] * np.array(loop.signs, dtype=float)[:, None]
        matrix[_SPACE * number : _SPACE * (number + 1), list(loop.joints)] = columns.T
    return rank_of(matrix, DOUBLE.singular)


def _dimension(screws: Floats, near: float) -> int:
    """Return the dimension of the Lie algebra that screws generate."""
    spans = row_space(screws, near).T
    while len(spans) < _SPACE:
        brackets = [_bracket(a, b) for a, b in combinations(spans, 2)]
        wider = row_space(np.vstack([spans, *brackets]), near).T
        if len(wider) == len(spans):
            break
        spans = wider
    return len(spans)


def _bracket(a: Floats, b: Floats) -> Floats:
    """Return the Lie bracket of two screws."""
    turn = np.cross(a[:3], b[:3])
    return np.concatenate([turn, np.cross(a[:3], b[3:]) + np.cross(a[3:], b[:3])])[None]


class _Relations:
    """Which axes of a loop are parallel, meet in a point or lie in a plane; random axes that do so too."""

    def __init__(self, linkage: Linkage, near: float) -> None:
        self._linkage, self._near = linkage, near
        self._parallel = nx.utils.UnionFind(range(len(linkage.angles)))
        self._meeting: list[set[int]] = []
        self._across: list[tuple[int, int]] = []  # a slide, and an axis that it is across
        self._planes: list[set[int]] = []
        for loop in linkage.loops:
            self._of_loop(loop)
        self._merge_points()

    def _of_loop(self, loop: LinkageLoop) -> None:
        linkage, slides = self._linkage, set(self._linkage.slides)
        for i, k in combinations(loop.joints, 2):
            sine = float(np.linalg.norm(np.cross(linkage.directions[i], linkage.directions[k])))
            if sine <= self._near:
                self._parallel.union(i, k)
        turning = [joint for joint in loop.joints if joint not in slides]
        if loop.centre is Centre.FINITE:
            self._meeting.append(set(loop.joints))
        elif loop.centre is Centre.INFINITE:
            self._across += [(joint, turning[0]) for joint in loop.joints if joint in slides and turning]
        else:
            self._meeting += self._points_of(turning)
            self._planes += self._planes_of(turning)

    def _points_of(self, turning: list[int]) -> list[set[int]]:
        """Return the sets of axes of a loop that meet in a point."""
        points, axes = self._linkage.points, self._linkage.directions
        found: list[tuple[Floats, set[int]]] = []
        for i, k in combinations(turning, 2):
            if self._parallel[i] == self._parallel[k]:
                continue
            met = lines_meet(points[[i, k]], axes[[i, k]])
            if float(met.off.max()) > self._near:
                continue
            for point, here in found:
                if float(np.linalg.norm(point - met.point)) <= self._near:
                    here.update((i, k))
                    break
            else:
                found.append((met.point, {i, k}))
        return [here for _, here in found]

    def _planes_of(self, turning: list[int]) -> list[set[int]]:
        """Return the sets of three axes and more in a plane, that neither all meet nor are all parallel."""
        points, axes = self._linkage.points, self._linkage.directions
        found: list[set[int]] = []
        for i, k in combinations(turning, 2):
            between = axes[k] if self._parallel[i] != self._parallel[k] else points[k] - points[i]
            normal = np.cross(axes[i], between)
            if float(np.linalg.norm(normal)) <= self._near or any({i, k} <= plane for plane in found):
                continue
            normal = unit(normal)
            off = np.abs(axes[turning] @ normal) + np.abs((points[turning] - points[i]) @ normal)
            plane = {joint for joint, far in zip(turning, off, strict=True) if far <= self._near}
            alike = len({self._parallel[joint] for joint in plane}) == 1
            if {i, k} <= plane and len(plane) > 2 and not alike and not any(plane <= here for here in self._meeting):
                found.append(plane)
        return found

    def _merge_points(self) -> None:
        """Make one of points that two axes which are not parallel have in common."""
        merged: list[set[int]] = []
        for here in self._meeting:
            new = set(here)
            while True:
                same = [other for other in merged if len({self._parallel[joint] for joint in other & new}) > 1]
                if not same:
                    break
                for other in same:
                    new |= other
                    merged.remove(other)
            merged.append(new)
        self._meeting = merged

    def member(self, random: np.random.Generator) -> Linkage | None:
        """Return the linkage with random axes; None if relations leave an axis no place."""
        number = len(self._linkage.angles)
        root = [self._parallel[joint] for joint in range(number)]
        ways = unit(random.normal(size=(number, 3)))
        points = random.normal(size=(number, 3))
        centres = random.normal(size=(len(self._meeting), 3))
        for plane in self._planes:
            self._flatten(plane, root, ways, points, centres, random)
        directions = ways[root]
        through: dict[int, list[int]] = {}
        for which, here in enumerate(self._meeting):
            for joint in here:
                through.setdefault(joint, []).append(which)
        if not _settle(through, [root.count(one) == 1 for one in root], centres, directions, random):
            return None
        for joint, its in through.items():
            points[joint] = centres[its[0]]
        for slide, axis in self._across:
            if root.count(root[slide]) == 1:
                directions[slide] = unit(np.cross(directions[axis], directions[slide]))
        zeros = np.zeros(number)
        return replace(self._linkage, points=points, directions=directions, angles=zeros)

    def _flatten(
        self,
        plane: set[int],
        root: list[int],
        ways: Floats,
        points: Floats,
        centres: Floats,
        random: np.random.Generator,
    ) -> None:
        """Put axes into a random plane, in place, as far as all their parallels and points are in it too."""
        normal, origin = unit(random.normal(size=3)), random.normal(size=3)
        for joint in plane:
            if all(other in plane for other, its in enumerate(root) if its == root[joint]):
                ways[root[joint]] = unit(ways[root[joint]] - (ways[root[joint]] @ normal) * normal)
            points[joint] -= ((points[joint] - origin) @ normal) * normal
        for which, here in enumerate(self._meeting):
            if len(here & plane) > 1:
                centres[which] -= ((centres[which] - origin) @ normal) * normal


def _settle(
    through: dict[int, list[int]], free: list[bool], centres: Floats, directions: Floats, random: np.random.Generator
) -> bool:
    """Put the points that axes pass through, by axis, on these, in place; False if one would have two places.

    Two points are the direction of an axis that is parallel to no other; more of them, and those of other axes, are
    put on its line.
    """
    placed: set[int] = set()
    for joint, here in through.items():
        first, *others = here
        if others and free[joint]:
            directions[joint] = unit(centres[others[0]] - centres[first])
            placed |= {first, others.pop(0)}
        if any(which in placed for which in others):
            return False
        for which in others:
            centres[which] = centres[first] + random.normal() * directions[joint]
        placed |= {first, *others} if len(here) > 1 else set()
    return True
