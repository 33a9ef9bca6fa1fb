"""The verdict on a crease pattern that is too large for all its branches to be looked for: one motion, followed.

Theory: docs/theory/verdict.md.
"""

from __future__ import annotations

import numpy as np

from graphs.arrays import Floats, Ints
from synth.folding.branches import Certainty
from synth.folding.closure import ClosureEquations
from synth.folding.newton import TangentSpace
from synth.folding.prepared import Prepared
from synth.folding.singular.nearest import begun_near
from synth.folding.singular.sampling import MOVED, walked
from synth.verdict.marked import Marked
from synth.verdict.verdict import Verdict, Way, clusters_of
from synth.verdict.words import Posed, Told, flaps_of, text_of_motion

__all__ = ["freedoms_by_projection", "verdict_of_large"]

_STILL = 1e-9
_BLOCK, _MOST = 8, 512
_FREE = 1e-4
"""Projected random rates have singular values above this part of the largest, or none: it is far from both."""


def verdict_of_large(pattern: Prepared, generic: int | None = None) -> Verdict:
    """Follow one motion, along the marks, and say how many freedoms it has at its end.

    Parameters
    ----------
    pattern : Prepared
    generic : int, optional
        The mobility of its type, with which the sentence compares.
    """
    linkage, closure = pattern.linkage, pattern.closure
    posed = Posed(linkage, "Folds", pattern.flat, pattern.doubt)
    joints = list(linkage.graph.joints)
    if len(flaps_of(linkage.graph)) == len(joints):
        loose = Way("+" * len(joints), len(joints), "proved", (), 0.0)
        text = text_of_motion(Told(posed, (loose,), None, True, generic, (), loose), len(joints), "proved")
        return Verdict(len(joints), "pose", "proved", text, (loose,), True)
    wanted = pattern.wanted
    begun = begun_near(closure, linkage, wanted)
    rates = begun.rates
    end = linkage.angles if rates is None else walked(linkage.angles, closure, rates)[0]
    far = float(np.abs(end - linkage.angles).max())
    if rates is None or far <= MOVED:
        return _unmoved(posed, begun.rigid, generic)
    moving = np.flatnonzero(np.maximum(np.abs(rates), np.abs(end - linkage.angles)) > _STILL)
    freedoms = freedoms_by_projection(closure, end, moving)
    still = tuple(joint for place, joint in enumerate(joints) if place not in set(moving.tolist()))
    signs = "".join("0" if abs(rate) <= _STILL else "+-"[int(rate < 0)] for rate in rates)
    way = Way(signs, freedoms, "numerical", still, far)
    stiff = still if freedoms == 1 and not posed.flat else ()
    told = Told(posed, (way,), _as_marked(pattern.marks, rates), False, generic, stiff, way)
    text = text_of_motion(told, freedoms, "numerical")
    clusters = clusters_of(linkage.graph, stiff)
    return Verdict(freedoms, "motion", "numerical", text, (way,), False, stiff, clusters)


def _unmoved(posed: Posed, rigid: bool, generic: int | None) -> Verdict:
    """Return the verdict on what was not seen to move: rigid, if that is proved."""
    freedoms = 0 if rigid else None
    certainty: Certainty = "proved" if rigid else "not known"
    text = text_of_motion(Told(posed, (), None, rigid, generic, (), None), freedoms, certainty)
    stiff = tuple(posed.linkage.graph.joints) if rigid else ()
    return Verdict(freedoms, "motion", certainty, text, (), rigid, stiff, clusters_of(posed.linkage.graph, stiff))


def freedoms_by_projection(closure: ClosureEquations, angles: Floats, moving: Ints | None = None) -> int | None:
    """Return how many rates a pose has, by random ones projected onto them; None where they are too many.

    Parameters
    ----------
    closure : ClosureEquations
    angles : float[J]
        A closed pose, radians.
    moving : int[n], optional
        The joints that move, of a branch on which others are still: these may have rates of their own at its
        poses, which begin other branches. By default all.

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> from synth.folding.linkage import linkage_of_axes
    >>> ring = SCGraph(8, [(link, (link + 1) % 8) for link in range(8)])
    >>> axes = {j: (np.cos([j, j + 2.0, 2.0 * j]), np.sin([3.0 * j, j, j + 1.0])) for j in range(8)}
    >>> linkage = linkage_of_axes(ring, axes)
    >>> freedoms_by_projection(ClosureEquations(linkage), linkage.angles)
    2
    """
    jacobian = closure.at(angles)[1]
    space = TangentSpace(jacobian if moving is None else jacobian[:, moving])
    size = len(angles) if moving is None else len(moving)
    chance = np.random.default_rng(size)
    found: list[Floats] = []
    while len(found) < min(_MOST, size):
        found += [space.projected(chance.normal(size=size)) for _ in range(_BLOCK)]
        sizes = np.linalg.svd(np.array(found), compute_uv=False)
        rank = int((sizes > _FREE * np.sqrt(size)).sum())
        if rank < len(found):
            return rank
    return None


def _as_marked(marks: Floats, rates: Floats) -> Marked | None:
    """Tell whether all marked joints turn as they are marked, or all against it; None where nothing is marked."""
    turned = (marks * rates)[marks != 0.0]
    if not len(turned):
        return None
    return "has" if (turned > _STILL).all() or (turned < -_STILL).all() else "none found"
