"""The verdict on a mechanism at a configuration: its ways to move, followed or proved.

Theory: docs/theory/verdict.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from graphs.ids import JointId
from graphs.tolerances import DOUBLE
from synth.motion.branches import Branch, Branches, Certainty
from synth.motion.configuration import Configuration
from synth.motion.linkage import PosedLinkage
from synth.verdict.of_large import verdict_of_large
from synth.verdict.verdict import Basis, Verdict, Way, clusters_of
from synth.verdict.words import Told, text_of_motion

__all__ = ["verdict_of_motion"]


def verdict_of_motion(configuration: Configuration, generic: int | None = None) -> Verdict:
    """Say how a mechanism moves from a configuration.

    Parameters
    ----------
    configuration : Configuration
    generic : int, optional
        The mobility of its type, with which the sentence compares.

    Examples
    --------
    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.folding.configuration import configuration_of_sheet
    >>> corners = ((0, 0), (1, 0), (.5, 1), (-1, 0), (.5, -1))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> print(verdict_of_motion(configuration_of_sheet(Sheet(5, (), "", faces, corners)), 1))
    Folds with 1 freedom from flat, in 2 ways.

    A parallelogram of solids, its four axes parallel:

    >>> from graphs.loops.loop import Loop
    >>> from graphs.mechanism.sc import SCGraph
    >>> from graphs.mechanism.solids import HingedSolids
    >>> from synth.moving.made import configuration_of
    >>> ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop(range(4), "infinite")])
    >>> corners = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)]
    >>> solids = HingedSolids(ring, {joint: (corner, (0, 0, 1)) for joint, corner in enumerate(corners)})
    >>> print(verdict_of_motion(configuration_of(solids), 1))
    Moves with 1 freedom from its pose.
    """
    if not configuration.joints:
        why = "Nothing to fold: there are no creases between panels."
        return Verdict(
            0, "motion", "proved", why if configuration.limited else "Nothing moves: there are no joints."
        )
    if configuration.branches is None:
        return verdict_of_large(configuration, generic)
    verdict = _verdict(configuration, configuration.branches, generic)
    return replace(verdict, places=configuration.ends_of(verdict.stiff_joints))


def _verdict(configuration: Configuration, found: Branches, generic: int | None) -> Verdict:
    linkage = configuration.linkage
    ways = tuple(_way(linkage, branch) for branch in found.branches)
    known = found.complete and all(way.freedoms is not None for way in ways)
    still = _common(linkage, ways) if known else ()
    by_marks = configuration.marked
    way = _told_way(ways, by_marks.number)
    if way is None:
        freedoms: int | None = 0 if found.exhaustive else None
        certainty: Certainty = "proved" if found.exhaustive else "not known"
    else:
        freedoms, certainty = way.freedoms, way.certainty
    told = Told(configuration, ways, by_marks.marked, found.complete, generic, still, way)
    basis: Basis = "pose" if found.regular and certainty == "proved" else "motion"
    text = text_of_motion(told, freedoms, certainty)
    clusters = clusters_of(linkage.graph, still)
    return Verdict(freedoms, basis, certainty, text, ways, found.exhaustive, still, clusters)


def _way(linkage: PosedLinkage, branch: Branch) -> Way:
    joints = list(linkage.graph.joints)
    apart = np.abs(branch.sample - linkage.angles) > DOUBLE.immobile
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
