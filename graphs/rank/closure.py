"""Loop closure: the linear equations between the rates of the joints of a mechanism.

Round every independent loop the twists of the joints add up to nothing. A loop whose axes all pass through one
point says that with three equations (no other point of space has to close), any other loop with six. M = J - rank.
Theory: docs/theory/exact-mobility.md.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import networkx as nx

from graphs.ids import JointId
from graphs.loops.cycle_space import added_independent, signed_cycle
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.sc import SCGraph
from graphs.rank.fields import Field
from graphs.rank.general_member import Line, Point

__all__ = ["Closure", "closure_of", "independent_cycles"]


_FINITE = [(0, 0), (0, 1), (0, 2)]
_SPATIAL = [*_FINITE, (1, 0), (1, 1), (1, 2)]


@dataclass(frozen=True, slots=True)
class Closure:
    """The closure equations, row by row.

    Attributes
    ----------
    joints : tuple of joint ids
        The unknowns: columns.
    rows : tuple of dict
        Column to coefficient; zeros are left out.
    loops : tuple of tuple of joint ids
        The loop of each row.
    """

    joints: tuple[JointId, ...]
    rows: tuple[dict[int, Any], ...]
    loops: tuple[tuple[JointId, ...], ...]


def independent_cycles(sc: SCGraph) -> tuple[Loop, ...]:
    """Return the loops of a mechanism, with cycles that complete them to a basis; these have no centre.

    Parameters
    ----------
    sc : SCGraph or SCDGraph

    Returns
    -------
    tuple of Loop
        Those of the mechanism first.

    Examples
    --------
    >>> [loop.centre.value for loop in independent_cycles(SCGraph(3, [(0, 1), (1, 2), (2, 0)]))]
    ['none']
    """
    missing = sc.independent_loops - len(sc.loops)
    if not missing:
        return sc.loops
    forest = nx.Graph()
    forest.add_nodes_from(sc.nodes)
    tree: dict[frozenset[Any], JointId] = {}
    left = []
    parts = nx.utils.UnionFind(sc.nodes)
    for joint, (a, b) in sc.joints.items():
        if parts[a] == parts[b]:
            left.append(joint)
        else:
            parts.union(a, b)
            forest.add_edge(a, b)
            tree[frozenset((a, b))] = joint
    candidates = []
    for joint in left:
        a, b = sc.joints[joint]
        path = nx.bidirectional_shortest_path(forest, b, a)
        steps = pairwise(path)
        candidates.append((joint, *(tree[frozenset(step)] for step in steps)))
    chosen = added_independent([loop.joints for loop in sc.loops], candidates)
    return (*sc.loops, *(Loop(candidates[i], Centre.NONE) for i in chosen))


def closure_of(sc: SCGraph, axes: Mapping[JointId, Line], centres: Mapping[int, Point], field: Field) -> Closure:
    """Return the closure equations of a placed mechanism.

    Parameters
    ----------
    sc : SCGraph
    axes : mapping of joint id to (u, m)
    centres : mapping of loop index to (x, y, z, w)
        The centre of each loop that has one.
    field : Field

    Returns
    -------
    Closure
        Rows of 3 equations for a loop with a centre, 6 for one without.

    Examples
    --------
    A general spherical four-bar, modulo a prime: three equations of four rates.

    >>> from graphs.rank.fields import PrimeField
    >>> from graphs.rank.general_member import realise
    >>> four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> field = PrimeField(101)
    >>> member = realise(four_bar, field)
    >>> closure = closure_of(four_bar, member.axes, {0: member.points[0]}, field)
    >>> len(closure.rows), closure.joints
    (3, (0, 1, 2, 3))
    """
    joints = sc.joints
    column = {joint: i for i, joint in enumerate(joints)}
    rows: list[dict[int, Any]] = []
    loops: list[tuple[JointId, ...]] = []
    for index, loop in enumerate(independent_cycles(sc)):
        signed = [(column[joint], sign, axes[joint]) for joint, sign in signed_cycle(loop.joints, joints)]
        for part, k in _equations(centres.get(index), field):
            row = {}
            for j, sign, axis in signed:
                value = axis[part][k]
                if value:
                    row[j] = value if sign == 1 else field.reduce(-value)
            rows.append(row)
            loops.append(loop.joints)
    return Closure(tuple(sc.joints), tuple(rows), tuple(loops))


def _equations(centre: Point | None, field: Field) -> list[tuple[int, int]]:
    """Return which coordinates of the twists must close: (0, k) of the directions, (1, k) of the moments.

    About a finite centre the moments are determined by the directions. For parallel axes one coordinate of
    the direction tells all three, and the moments are perpendicular to it.
    """
    if centre is None:
        return _SPATIAL
    if not field.is_zero(centre[3]):
        return _FINITE
    largest = max(range(3), key=lambda k: abs(centre[k]))
    return [(0, largest), *((1, k) for k in range(3) if k != largest)]
