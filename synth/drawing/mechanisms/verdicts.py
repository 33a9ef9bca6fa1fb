"""Which creases of a pattern are still at its pose, and which panels move as one."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import networkx as nx
import numpy as np

from graphs.convert.duality import SheetMechanism
from graphs.ids import JointId, LinkId
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from synth.folding.branches import branches_of
from synth.folding.closure import ClosureEquations
from synth.folding.linkage import linkage_of_sheet
from synth.folding.second_order import rates_at

__all__ = ["Verdict", "clusters_of", "still_joints"]

_STILL = 1e-8
"""Of rates that are columns of length 1."""
_FEW = 40
"""Joints up to which branches are looked for: a second or so."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """Which joints are still.

    Attributes
    ----------
    still : frozenset of joint ids
    known : str
        How that is known.
    """

    still: frozenset[JointId] = frozenset()
    known: str = ""


def still_joints(sheet: Sheet, mechanism: SheetMechanism) -> Verdict:
    """Return the joints that do not move from the pose of a sheet.

    Of a small pattern those that are still on all branches that were found; of a large one those that no
    first-order motion turns, which are still, while others may be still too, at a flat pose above all.

    Parameters
    ----------
    sheet : Sheet
        With coordinates.
    mechanism : SheetMechanism
        Of this sheet.

    Raises
    ------
    UnsolvableError
        If the sheet has no coordinates, or its panels do not fit at its pose.

    Examples
    --------
    Three creases that meet in a point hold each other, flat as they lie:

    >>> from graphs.convert.duality import mechanism_of_sheet
    >>> tent = Sheet(4, (), "", ((0, 1, 2), (0, 2, 3), (0, 3, 1)), ((0, 0), (2, 0), (-1, 2), (-1, -2)))
    >>> verdict = still_joints(tent, mechanism_of_sheet(tent))
    >>> len(verdict.still), verdict.known
    (3, 'on all branches found')
    """
    linkage = linkage_of_sheet(sheet, mechanism)
    closure = ClosureEquations(linkage)
    joints = list(linkage.graph.joints)
    if len(joints) <= _FEW:
        found = branches_of(linkage, closure)
        if found.complete:
            common = set(range(len(joints))).intersection(*(branch.still for branch in found.branches))
            return Verdict(frozenset(joints[i] for i in common), "on all branches found")
    rates = rates_at(closure, linkage.angles)
    moving = np.abs(rates).max(axis=1, initial=0.0) > _STILL
    still = frozenset(joint for joint, moves in zip(joints, moving.tolist(), strict=True) if not moves)
    return Verdict(still, "to first order at this pose")


def clusters_of(sc: SCGraph, still: Collection[JointId]) -> list[list[LinkId]]:
    """Return the links that move as one: those of two and more that still joints hold together.

    Examples
    --------
    >>> clusters_of(SCGraph(4, [(0, 1), (1, 2), (2, 3)]), {0, 1})
    [[0, 1, 2]]
    """
    held = nx.Graph()
    held.add_nodes_from(sc.nodes)
    held.add_edges_from(sc.joints[joint] for joint in sc.joints if joint in still)
    place = {link: i for i, link in enumerate(sc.nodes)}
    groups = [sorted(group, key=place.__getitem__) for group in nx.connected_components(held) if len(group) > 1]
    return sorted(groups, key=lambda group: place[group[0]])
