"""The verdict on a linkage at a pose, crease patterns above all: its ways to move, followed or proved.

Theory: docs/theory/verdict.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from graphs.arrays import Floats
from graphs.errors import UnsolvableError
from graphs.ids import JointId
from graphs.mechanism.precision import Precision
from synth.folding.mending.repair import doubt_of
from synth.folding.prepared import Prepared
from synth.motion.beginning import MOST_JOINTS, search_for
from synth.motion.branches import Branch, Branches, Certainty, branches_of
from synth.motion.linkage import PosedLinkage
from synth.verdict.marked import MarkedWay, marked_way
from synth.verdict.of_large import verdict_of_large
from synth.verdict.verdict import Basis, Verdict, Way, clusters_of
from synth.verdict.words import Posed, Told, text_of_motion

__all__ = ["verdict_of_linkage", "verdict_of_motion"]

_STILL = 1e-9


def verdict_of_motion(pattern: Prepared, generic: int | None = None) -> Verdict:
    """Say how a crease pattern moves from its pose.

    Parameters
    ----------
    pattern : Prepared
    generic : int, optional
        The mobility of its type, with which the sentence compares.

    Examples
    --------
    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.folding.prepared import prepared
    >>> corners = ((0, 0), (1, 0), (.5, 1), (-1, 0), (.5, -1))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> print(verdict_of_motion(prepared(Sheet(5, (), "", faces, corners)), 1))
    Folds with 1 freedom from flat, in 2 ways.
    """
    if not pattern.linkage.graph.joints:
        return Verdict(0, "motion", "proved", "Nothing to fold: there are no creases between panels.")
    if pattern.branches is None:
        return verdict_of_large(pattern, generic)
    posed = Posed(pattern.linkage, "Folds", pattern.flat, pattern.doubt)
    verdict = _verdict(posed, pattern.branches, pattern.marks, generic)
    return replace(verdict, places=_places(pattern, verdict.stiff_joints))


def verdict_of_linkage(linkage: PosedLinkage, precision: Precision, generic: int | None = None) -> Verdict:
    """Say how a linkage moves from its pose, of solids or rods or on a cone.

    Parameters
    ----------
    linkage : PosedLinkage
    precision : Precision
        Of its coordinates.
    generic : int, optional
        The mobility of its type, with which the sentence compares.

    Returns
    -------
    Verdict

    Raises
    ------
    UnsolvableError
        If it has too many joints.

    Examples
    --------
    A parallelogram of solids, its four axes parallel:

    >>> from graphs.loops.loop import Loop
    >>> from graphs.mechanism.precision import precision_of
    >>> from graphs.mechanism.sc import SCGraph
    >>> from graphs.mechanism.solids import HingedSolids
    >>> from synth.moving.linkages import linkage_of
    >>> ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop(range(4), "infinite")])
    >>> corners = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)]
    >>> solids = HingedSolids(ring, {joint: (corner, (0, 0, 1)) for joint, corner in enumerate(corners)})
    >>> print(verdict_of_linkage(linkage_of(solids), precision_of(corners), 1))
    Moves with 1 freedom from its pose.
    """
    joints = len(linkage.graph.joints)
    if joints > MOST_JOINTS:
        raise UnsolvableError(f"branches of more than {MOST_JOINTS} joints are not looked for")
    found = branches_of(linkage, None, search_for(joints, None))
    return _verdict(Posed(linkage, "Moves", False, doubt_of(precision)), found, np.zeros(joints), generic)


def _verdict(posed: Posed, found: Branches, marks: Floats, generic: int | None) -> Verdict:
    linkage = posed.linkage
    ways = tuple(_way(linkage, branch) for branch in found.branches)
    known = found.complete and all(way.freedoms is not None for way in ways)
    still = _common(linkage, ways) if known else ()
    by_marks = MarkedWay(None, None)
    if posed.flat and marks.any() and ways:
        by_marks = marked_way(found, linkage, marks)
    way = _told_way(ways, by_marks.number)
    if way is None:
        freedoms: int | None = 0 if found.exhaustive else None
        certainty: Certainty = "proved" if found.exhaustive else "not known"
    else:
        freedoms, certainty = way.freedoms, way.certainty
    told = Told(posed, ways, by_marks.marked, found.complete, generic, still, way)
    basis: Basis = "pose" if found.regular and certainty == "proved" else "motion"
    text = text_of_motion(told, freedoms, certainty)
    clusters = clusters_of(linkage.graph, still)
    return Verdict(freedoms, basis, certainty, text, ways, found.exhaustive, still, clusters)


def _way(linkage: PosedLinkage, branch: Branch) -> Way:
    joints = list(linkage.graph.joints)
    apart = np.abs(branch.sample - linkage.angles) > _STILL
    still = [joint for place, joint in enumerate(joints) if place in branch.still and not apart[place]]
    return Way(branch.signs, branch.freedoms, branch.certainty, tuple(still), branch.followed)


def _told_way(ways: Sequence[Way], chosen: int | None) -> Way | None:
    """Return the way whose freedoms are told: that which marks choose, or the freest; None if there is none."""
    if chosen is not None:
        return ways[chosen]
    return max(ways, key=lambda way: (way.certainty != "not known", way.freedoms or 0), default=None)


def _common(linkage: PosedLinkage, ways: Sequence[Way]) -> tuple[JointId, ...]:
    """Return the joints that move on no way."""
    if not ways:
        return tuple(linkage.graph.joints)
    still = set(ways[0].stiff_joints).intersection(*(way.stiff_joints for way in ways))
    return tuple(joint for joint in linkage.graph.joints if joint in still)


def _places(
    pattern: Prepared, joints: Sequence[JointId]
) -> dict[JointId, tuple[tuple[float, ...], tuple[float, ...]]]:
    corners = pattern.sheet.coordinates
    assert corners is not None
    ends = {joint: pattern.mechanism.hinges[joint] for joint in joints}  # type: ignore[index]
    return {joint: (tuple(corners[a]), tuple(corners[b])) for joint, (a, b) in ends.items()}
