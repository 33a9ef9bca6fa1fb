"""Random spherical and planar linkages of given graphs, and positions by Newton's method from random starts."""

import numpy as np

from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from graphs.rank.exact import independent_cycles
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.linkage import linkage_of_axes
from synth.analysis.moving._configuration_of import configuration_of

FOUR_BAR = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
WATT = SCGraph(6, [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)])
STEPHENSON = SCGraph(6, [(0, 1), (1, 2), (2, 3), (3, 0), (2, 4), (4, 5), (5, 0)])
"""Of Stephenson's joints 0 to 3 are of the four-bar loop, 4, 5, 6 of the path of three."""


def spherical(graph, random):
    """The graph with random axes through one point."""
    loops = [Loop(loop.joints) for loop in independent_cycles(SCGraph(graph.nodes, graph.joints))]
    axes = random.normal(size=(len(graph.joints), 3))
    places = {joint: ((0.0, 0.0, 0.0), axis.tolist()) for joint, axis in zip(graph.joints, axes, strict=True)}
    return linkage_of_axes(SCGraph(graph.nodes, graph.joints, loops), places)


def planar(graph, random):
    """The graph with random axes across one plane."""
    points = random.normal(size=(len(graph.joints), 2)).tolist()
    axes = {joint: ((*point, 0.0), (0.0, 0.0, 1.0)) for joint, point in zip(graph.joints, points, strict=True)}
    return configuration_of(HingedSolids(graph, axes)).linkage


def by_newton(linkage, drive, random, starts):
    """Positions that random starts come to: by closure equations of real numbers."""
    closure = ClosureEquations(linkage)
    names = list(linkage.graph.joints)
    held = [names.index(joint) for joint in drive]
    free = np.setdiff1d(np.arange(len(names)), held)
    found = []
    for _ in range(starts):
        angles = random.uniform(-np.pi, np.pi, len(names))
        angles[held] = list(drive.values())
        for _ in range(40):
            off, matrix = closure.at(angles)
            change = np.linalg.lstsq(matrix.toarray()[:, free], -off, rcond=None)[0]
            angles[free] += change * min(1.0, 1.0 / max(np.abs(change).max(), 1e-300))
            if np.abs(change).max() < 1e-12:
                break
        if closure.error(angles) < 1e-10:
            found.append(angles)
    return found


def is_among(angles, positions):
    """Whether a position is one of several, whole turns aside."""
    off = [np.abs(np.remainder(angles - one.angles + np.pi, 2 * np.pi) - np.pi).max() for one in positions]
    return min(off, default=np.inf) < 1e-6
