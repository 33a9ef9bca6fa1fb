"""The verdict on what is too large for all its branches to be looked for: one motion, followed.

Theory: docs/theory/verdict.md.
"""

from __future__ import annotations

import numpy as np

from graphs.arrays import Floats
from graphs.tolerances import DOUBLE
from synth.motion.branches import Certainty, signs_of
from synth.motion.configuration import Configuration
from synth.motion.marked import Marked
from synth.motion.singular.nearest import begun_near
from synth.motion.singular.sampling import walked
from synth.motion.walk.freedoms import free_rates
from synth.verdict.verdict import Verdict, Way, clusters_of
from synth.verdict.words import Told, flaps_of, text_of_motion

__all__ = ["verdict_of_large"]


def verdict_of_large(configuration: Configuration, generic: int | None = None) -> Verdict:
    """Follow one motion, along the marks, and say how many freedoms it has at its end.

    Parameters
    ----------
    configuration : Configuration
    generic : int, optional
        The mobility of its type, with which the sentence compares.
    """
    linkage, closure = configuration.linkage, configuration.closure
    joints = list(linkage.graph.joints)
    if len(flaps_of(linkage.graph)) == len(joints):
        loose = Way("+" * len(joints), len(joints), "proved", (), 0.0)
        text = text_of_motion(Told(configuration, (loose,), None, True, generic, (), loose), len(joints), "proved")
        return Verdict(len(joints), "pose", "proved", text, (loose,), True)
    wanted = configuration.wanted
    begun = begun_near(closure, linkage, wanted)
    rates = begun.rates
    end = linkage.angles if rates is None else walked(linkage.angles, closure, rates)[0]
    far = float(np.abs(end - linkage.angles).max())
    if rates is None or far <= DOUBLE.moved:
        return _unmoved(configuration, begun.rigid, generic)
    moving = np.flatnonzero((np.abs(rates) > DOUBLE.zero_rate) | (np.abs(end - linkage.angles) > DOUBLE.immobile))
    basis = free_rates(closure, end, moving)
    freedoms = None if basis is None else basis.shape[1]
    still = tuple(joint for place, joint in enumerate(joints) if place not in set(moving.tolist()))
    way = Way(signs_of(rates), freedoms, "numerical", still, far)
    stiff = still if freedoms == 1 and not configuration.flat else ()
    told = Told(configuration, (way,), _as_marked(configuration.marks, rates), False, generic, stiff, way)
    text = text_of_motion(told, freedoms, "numerical")
    clusters = clusters_of(linkage.graph, stiff)
    return Verdict(freedoms, "motion", "numerical", text, (way,), False, stiff, clusters)


def _unmoved(configuration: Configuration, rigid: bool, generic: int | None) -> Verdict:
    """Return the verdict on what was not seen to move: rigid, if that is proved."""
    freedoms = 0 if rigid else None
    certainty: Certainty = "proved" if rigid else "not known"
    text = text_of_motion(Told(configuration, (), None, rigid, generic, (), None), freedoms, certainty)
    stiff = tuple(configuration.linkage.graph.joints) if rigid else ()
    return Verdict(
        freedoms, "motion", certainty, text, (), rigid, stiff, clusters_of(configuration.linkage.graph, stiff)
    )


def _as_marked(marks: Floats, rates: Floats) -> Marked | None:
    """Tell whether all marked joints turn as they are marked, or all against it; None where nothing is marked."""
    turned = (marks * rates)[marks != 0.0]
    if not len(turned):
        return None
    return "has" if (turned > DOUBLE.zero_rate).all() or (turned < -DOUBLE.zero_rate).all() else "none found"
