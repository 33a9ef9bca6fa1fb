"""The verdict on a mechanism at a configuration: its ways to move, followed or proved.

Theory: docs/theory/verdict.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from graphs.mechanism.precision import BY_DIGITS, ESTIMATED
from graphs.tolerances import DOUBLE
from graphs.types import JointId
from synth.folding.configuration import SheetConfiguration
from synth.motion.branches import Branch, Branches, Certainty
from synth.motion.configuration import Configuration
from synth.motion.linkage import PosedLinkage
from synth.motion.marked import Marked
from synth.verdict.of_large import verdict_of_large
from synth.verdict.verdict import AsWritten, Basis, Verdict, Way, WithinPrecision, clusters_of
from synth.verdict.words import MotionFindings, text_of_motion

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
    Rigid-foldable from the flat state: 1 degree of freedom. 2 folding branches.

    A parallelogram of solids, its four axes parallel:

    >>> from graphs.loops.loop import Loop
    >>> from graphs.mechanism.sc import SCGraph
    >>> from graphs.mechanism.solids import HingedSolids
    >>> from synth.moving.made import configuration_of
    >>> ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop(range(4), "infinite")])
    >>> corners = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)]
    >>> solids = HingedSolids(ring, {joint: (corner, (0, 0, 1)) for joint, corner in enumerate(corners)})
    >>> print(verdict_of_motion(configuration_of(solids), 1))
    Mobile from this configuration: 1 degree of freedom.
    """
    if not configuration.joints:
        lacking = "creases between panels" if configuration.limited else "joints"
        return Verdict(0, "motion", "proved", f"Rigid: there are no {lacking}.")
    verdict = _verdict(configuration, generic)
    return replace(verdict, places=configuration.ends_of(verdict.stiff_joints))


def _verdict(configuration: Configuration, generic: int | None) -> Verdict:
    found = configuration.branches
    if found is None or configuration.one_way:
        verdict = verdict_of_large(configuration, generic)
    else:
        verdict = _of_branches(configuration, found, generic)
    known = verdict.as_written or _as_written(configuration)
    written = known or AsWritten(verdict.freedoms, verdict.certainty)
    if not isinstance(configuration, SheetConfiguration):
        return replace(verdict, as_written=written)
    nearest = None if verdict.ways else configuration.nearest
    misfit = configuration.misfit if nearest is None else nearest.moved
    moves = bool(verdict.ways) or nearest is not None
    within = WithinPrecision(
        verdict.freedoms, verdict.certainty, misfit if moves else None, configuration.precision.size
    )
    return replace(verdict, as_written=written, within_precision=within)


def _as_written(configuration: Configuration) -> AsWritten | None:
    """Return what holds where no vertex is moved; None if that is what the verdict says."""
    if not isinstance(configuration, SheetConfiguration):
        return None
    found = configuration.branches
    if configuration.written is None:
        return AsWritten(0, "proved") if found is not None and found.no_motion == "proved" else None
    return _of_written(configuration.written)


def _of_written(written: SheetConfiguration) -> AsWritten:
    """Return what holds at the coordinates of a configuration; of what is large no motion was looked for."""
    found = written.branches
    if found is None:
        return AsWritten(None, "not known")
    way = _stated_way(_ways_of(written, found), written.marked.number)
    if way is None:
        return AsWritten(0, "proved") if found.no_motion == "proved" else AsWritten(None, "not known")
    return AsWritten(way.freedoms, way.certainty)


def _of_branches(configuration: Configuration, found: Branches, generic: int | None) -> Verdict:
    linkage = configuration.linkage
    ways = _ways_of(configuration, found)
    further = None if found.complete else len(found.branches) - len(ways)
    number, marked = _marked(configuration, len(ways))
    ways += tuple(_way_elsewhere(*one) for one in configuration.elsewhere)
    known = found.complete and all(way.freedoms is not None for way in ways)
    still = _common(linkage, ways) if known else ()
    way = _stated_way(ways, number)
    if way is None:
        freedoms, certainty = _unmoved(configuration, found)
    else:
        freedoms, certainty = way.freedoms, way.certainty
    if not ways and freedoms is None:
        still = ()
    findings = MotionFindings(
        configuration, ways, marked, found.complete, generic, still, way, _as_written(configuration)
    )
    basis: Basis = "pose" if found.regular and certainty == "proved" else "motion"
    text = text_of_motion(findings, freedoms, certainty)
    clusters = clusters_of(linkage.graph, still)
    exhaustive = found.exhaustive and not configuration.unsettled
    return Verdict(freedoms, basis, certainty, text, ways, exhaustive, still, clusters, further=further)


def _unmoved(configuration: Configuration, found: Branches) -> tuple[int | None, Certainty]:
    """Return the freedoms of what does not move, and how that is known: proved if nothing nearly moves either.

    Where the digits alone tell the precision, coordinates may have larger errors that nothing shows: a mechanism
    nearby is then what may be meant.
    """
    if not found.exhaustive or configuration.unsettled:
        return None, "not known"
    precision = configuration.precision
    doubtful = precision.source == ESTIMATED or (precision.evidence == BY_DIGITS and configuration.nearest)
    return 0, "numerical" if configuration.nearly or doubtful else "proved"


def _marked(configuration: Configuration, ways: int) -> tuple[int | None, Marked | None]:
    """Return the number of the branch that the assignment chooses, of all mechanisms, and whether one has it."""
    chosen = configuration.marked
    if chosen.marked not in (None, "has"):
        for place, (other, number) in enumerate(configuration.elsewhere):
            if other.marked.number == number:
                return ways + place, "has"
    return chosen.number, chosen.marked


def _ways_of(configuration: Configuration, found: Branches) -> tuple[Way, ...]:
    """Return the branches that were followed, which come first; of a longer search all."""
    return tuple(_way(configuration, branch) for branch in found.branches if branch.begun or configuration.more)


def _way_elsewhere(other: Configuration, number: int) -> Way:
    branch = other.branch(number)
    assert branch is not None
    return _way(other, branch)


def _way(configuration: Configuration, branch: Branch) -> Way:
    linkage = configuration.linkage
    joints = list(linkage.graph.joints)
    apart = np.abs(branch.sample - linkage.angles) > DOUBLE.immobile
    still = [joint for place, joint in enumerate(joints) if place in branch.still and not apart[place]]
    return Way(
        branch.signs, branch.freedoms, branch.certainty, tuple(still), branch.followed, configuration.misfit
    )


def _stated_way(ways: Sequence[Way], chosen: int | None) -> Way | None:
    """Return the branch whose freedoms are stated: the assigned one, or the freest; None if there is none."""
    if chosen is not None and chosen < len(ways):
        return ways[chosen]
    return max(ways, key=lambda way: (way.certainty != "not known", way.freedoms or 0), default=None)


def _common(linkage: PosedLinkage, ways: Sequence[Way]) -> tuple[JointId, ...]:
    """Return the joints that move on no way."""
    if not ways:
        return tuple(linkage.graph.joints)
    still = set(ways[0].stiff_joints).intersection(*(way.stiff_joints for way in ways))
    return tuple(joint for joint in linkage.graph.joints if joint in still)
