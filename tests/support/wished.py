"""Random mechanisms with wishes that they meet: two of their links moved as they move, at eight inputs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation
from spherical import FOUR_BAR, STEPHENSON, WATT, spherical

from graphs.mechanism.sc import SCGraph
from synth.analysis.folding.motion import fold
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.path import driven_path
from synth.catalogue.patterns.generators import GENERATORS
from synth.linkages.conformed.linkage_behaviour import loop_on_cones
from synth.synthesis.designing.dimensions import AxisDimensions, ConeDimensions, Dimensions, ParameterDimensions
from synth.synthesis.designing.placement import DesignConfiguration, DesignFrame, DesignPoint
from synth.synthesis.designing.problem import DesignProblem
from synth.synthesis.designing.wishes import LinkOrientation, PointPlace, WishedConfiguration, Wishes

INPUTS = 8
_STEP, _TRIES, _STEPS, _FEWEST = 0.1, 400, 14, 12


@dataclass
class Wished:
    """A problem, numbers of a mechanism that meets its wishes, and numbers that are 10 % off."""

    problem: DesignProblem
    truth: np.ndarray
    start: np.ndarray


def _of_chain(graph):
    def make(rng):
        linkage = spherical(graph, rng)
        lines = np.hstack([linkage.points * linkage.extent + linkage.middle, linkage.directions])
        return AxisDimensions(linkage.graph, lines), None

    return make


EIGHT = SCGraph(8, [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0), (5, 6), (6, 7), (7, 0)])
"""Three four-bars in a row: eight links, one freedom."""
EIGHT_OTHER = SCGraph(8, [(0, 1), (1, 2), (2, 3), (3, 0), (2, 4), (4, 5), (5, 0), (5, 6), (6, 7), (7, 1)])
"""A Stephenson chain with a dyad: eight links, one freedom."""


def _of_generator(name):
    def make(rng):
        generator = GENERATORS[name]
        chosen = {}
        for one in generator.parameters:
            if one.unit != "count":
                middle, reach = one.default, 0.15 * abs(one.default)
                chosen[one.name] = float(np.clip(middle + reach * rng.uniform(-1, 1), one.least, one.most))
        return ParameterDimensions(generator, chosen), None

    return make


def _on_cone(rng):
    """A four-bar on a cone; angles about the cone that close on none are drawn again."""
    linkages = []
    while not linkages:
        linkages = loop_on_cones(np.radians(rng.uniform(40, 130, 4)))
    return ConeDimensions(linkages[0]), None


def _of_sheet(name, **counts):
    """A sheet of a generator, folded along its assigned branch from a quarter of the way on."""

    def make(rng):
        generator = GENERATORS[name]
        chosen = dict(counts)
        for one in generator.parameters:
            if one.unit != "count":
                chosen[one.name] = float(np.clip(one.default * rng.uniform(0.9, 1.1), one.least, one.most))
        return ParameterDimensions(generator, chosen), "sheet"

    return make


MAKERS = {
    "four-bar": _of_chain(FOUR_BAR),
    "Watt": _of_chain(WATT),
    "Stephenson": _of_chain(STEPHENSON),
    "eight links": _of_chain(EIGHT),
    "eight links with a five-bar": _of_chain(EIGHT_OTHER),
    "on a cone": _on_cone,
    "bennett": _of_generator("bennett"),
    "miura": _of_sheet("miura", rows=3, columns=3),
}
KINDS = list(MAKERS)


def wished(kind: str, seed: int) -> Wished:
    """A random mechanism of a kind with its wishes, and a start that is 10 % off."""
    for number in range(_TRIES):
        rng = np.random.default_rng((seed, number, KINDS.index(kind)))
        family, how = MAKERS[kind](rng)
        travelled = _travelled(family, how)
        if travelled is not None:
            return _with_wishes(family, *travelled, rng)
    raise AssertionError(f"no {kind} moves so far")


def _travelled(family: Dimensions, how):
    """Eight configurations of a mechanism, evenly over its travel, and the driven joint; None if it hardly moves."""
    design = family.linkage(family.start)
    if how == "sheet":
        sheet = family.mechanism(family.start)
        angles = fold(sheet, frames=30).path.angles[5:26]
        driver = int(np.abs(angles[-1]).argmax())
    else:
        closure, zero, driver = ClosureEquations(design.linkage), design.linkage.angles, 0
        goals = _STEP * np.arange(1, _STEPS + 1)[:, None]
        ways = [driven_path(closure, zero, [driver], way * goals) for way in (1, -1)]
        angles = np.array(
            [angles for path in ways for angles in path.angles[1 : len(path.angles) - bool(path.stopped)]]
        )
        if len(angles) < _FEWEST:
            return None
        angles = angles[angles[:, driver].argsort()]
    picked = np.linspace(0, len(angles) - 1, INPUTS).round().astype(int)
    return angles[picked], driver


def _with_wishes(family, angles, driver, rng):
    design = family.linkage(family.start)
    frame = DesignFrame(family, design)
    joint = str(frame.joints[driver])
    links = [link for link in frame.graph.nodes if link != family.ground]
    two = rng.choice(len(links), 2, replace=False)
    configurations, wishes = [], []
    for number, at in enumerate(angles):
        name = f"input {number + 1}"
        configurations.append(WishedConfiguration(name, {joint: float(at[driver])}))
        pose = DesignConfiguration(frame, design, at)
        for link in (links[place] for place in two):
            matrix = pose.rotation(frame.row(str(link))).values.reshape(3, 3)
            quaternion = tuple(Rotation.from_matrix(matrix).as_quat(scalar_first=True).tolist())
            wishes.append(LinkOrientation(at=name, link=str(link), quaternion=quaternion))
            if not _about_a_point(frame):
                point = DesignPoint(str(link), (0.3, 0.2, 0.1))
                place = tuple(pose.places([point]).values.tolist())
                wishes.append(PointPlace(at=name, point=point, equals=place))
    problem = DesignProblem(family, Wishes(tuple(wishes), tuple(configurations)))
    off = 0.1 * family.scales * rng.normal(size=len(family.start)) / np.sqrt(2.0)
    low, high = family.bounds
    return Wished(problem, family.start, np.clip(family.start + off, low, high))


def _about_a_point(frame):
    return all(loop.has_centre for loop in frame.graph.loops) and frame.family.sheet is None
