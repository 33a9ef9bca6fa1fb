"""The verdict on what is too large for all its branches to be looked for: one motion, followed.

Theory: docs/theory/verdict.md.
"""

from __future__ import annotations

import numpy as np

from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.motion.branches import Certainty, signs_of
from synth.motion.configuration import Configuration
from synth.motion.marked import Marked
from synth.motion.singular.sampling import walked
from synth.motion.walk.freedoms import free_rates
from synth.verdict.verdict import AsWritten, Verdict, Way, clusters_of
from synth.verdict.words import MotionFindings, text_of_motion

__all__ = ["verdict_of_large"]


def verdict_of_large(configuration: Configuration, generic: int | None = None) -> Verdict:
    """Trace one motion, near the assignment, and say how many degrees of freedom it has at its end.

    Parameters
    ----------
    configuration : Configuration
    generic : int, optional
        The mobility of its type, with which the sentence compares.
    """
    linkage, closure = configuration.linkage, configuration.closure
    joints = list(linkage.graph.joints)
    if not linkage.loops:
        loose = Way("+" * len(joints), len(joints), "proved", (), 0.0, configuration.misfit)
        findings = MotionFindings(configuration, (loose,), None, True, generic, (), loose)
        text = text_of_motion(findings, len(joints), "proved")
        return Verdict(len(joints), "pose", "proved", text, (loose,), True)
    begun = configuration.begun
    rates = begun.rates
    end = linkage.angles if rates is None else walked(linkage.angles, closure, rates)[0]
    far = float(np.abs(end - linkage.angles).max())
    if rates is None or far <= DOUBLE.moved:
        return _unmoved(configuration, begun.rigid, generic)
    moving = np.flatnonzero((np.abs(rates) > DOUBLE.zero_rate) | (np.abs(end - linkage.angles) > DOUBLE.immobile))
    basis = free_rates(closure, end, moving)
    freedoms = None if basis is None else basis.shape[1]
    turning = set(moving.tolist())
    still = tuple(joint for place, joint in enumerate(joints) if place not in turning)
    from_folded = None if begun.folded is None else (begun.folded.found_at, begun.folded.back_to)
    way = Way(signs_of(rates), freedoms, "numerical", still, far, configuration.misfit, from_folded)
    stiff = still if freedoms == 1 and not configuration.flat else ()
    findings = MotionFindings(
        configuration, (way,), _as_marked(configuration.marks, rates), False, generic, stiff, way
    )
    text = text_of_motion(findings, freedoms, "numerical")
    clusters = clusters_of(linkage.graph, stiff)
    return Verdict(freedoms, "motion", "numerical", text, (way,), False, stiff, clusters)


def _unmoved(configuration: Configuration, rigid: bool, generic: int | None) -> Verdict:
    """Return the verdict on what was not seen to move: rigid, if that is proved and coordinates are exact."""
    written = AsWritten(0, "proved") if rigid else None
    settled = rigid and configuration.exact
    freedoms = 0 if settled else None
    certainty: Certainty = "proved" if settled else "not known"
    findings = MotionFindings(configuration, (), None, rigid, generic, (), None, written)
    text = text_of_motion(findings, freedoms, certainty)
    stiff = tuple(configuration.linkage.graph.joints) if settled else ()
    clusters = clusters_of(configuration.linkage.graph, stiff)
    return Verdict(freedoms, "motion", certainty, text, (), settled, stiff, clusters, as_written=written)


def _as_marked(marks: Floats, rates: Floats) -> Marked | None:
    """Tell whether all marked joints turn as they are marked, or all against it; None where nothing is marked."""
    turned = (marks * rates)[marks != 0.0]
    if not len(turned):
        return None
    return "has" if (turned > DOUBLE.zero_rate).all() or (turned < -DOUBLE.zero_rate).all() else "none found"
