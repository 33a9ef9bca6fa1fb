"""Derivatives of closure, rules and wishes by dimensions and joint angles, against central differences."""

import numpy as np
import pytest
from sizes import slow

from synth.catalogue.patterns import GENERATORS, generate
from synth.linkages.conformed.linkage_behaviour import loop_on_cones
from synth.synthesis.designing.dimensions import ConeDimensions, dimensions_of
from synth.synthesis.designing.placement import DesignPoint
from synth.synthesis.designing.problem import DesignProblem
from synth.synthesis.designing.sizes import (
    BoxSize,
    CellCurvatures,
    EdgeLengths,
    EqualArcs,
    EqualLengths,
    LinkArc,
    PanelCorners,
    SheetArea,
    SizeRatio,
    Symmetry,
)
from synth.synthesis.designing.targets import Formula, Mesh, Polyline
from synth.synthesis.designing.wishes import (
    Goal,
    JointAngle,
    LinkDirection,
    LinkOrientation,
    PointDistance,
    PointPlace,
    PointsOn,
    TransmissionAngle,
    WishedConfiguration,
    Wishes,
)

TETRAHEDRON = np.array([(3, 0, -1), (-2, 3, -1), (-2, -3, -1), (0, 0, 3)], dtype=float)
MESH = Mesh("tetrahedron", TETRAHEDRON[np.array([(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])])
PATH = Polyline(((0.0, 0.0, 0.0), (1.0, 2.0, 0.5), (3.0, 1.0, 1.0)))


def of_links(a, b, c, d):
    """Wishes about links of a ring, by its joints in order; link n is before joint n."""
    one, other = DesignPoint(a, (0.3, 0.2, 0.1)), DesignPoint(c, (1.0, 0.2, 0.1))
    return [
        JointAngle(at="a", joint=c, goal=Goal(equals=0.4)),
        LinkOrientation(at="a", link=b, quaternion=(1.0, 0.2, 0.1, 0.0)),
        LinkDirection(at="b", link=c, vector=(1, 0, 0), equals=(0, 1, 0)),
        PointPlace(at="b", point=other, equals=(1.0, None, 2.0)),
        PointDistance(at="a", points=(one, other), goal=Goal(at_least=9.0)),
        PointsOn(at="b", points=(one, other), target=Formula("x**2 + 2*y*z + sin(z) - 4")),
        PointsOn(at="a", points=(other,), target=MESH),
        PointsOn(at="b", points=(other,), target=PATH),
        TransmissionAngle(at="b", near=b, joint=c, far=d, at_least=1.6),
        LinkArc(joints=(a, b), goal=Goal(equals=1.0)),
        EqualArcs(arcs=((a, b), (c, d))),
    ]


def of_sheets():
    return [
        BoxSize(at="a", size_of="radius", goal=Goal(at_most=0.1)),
        BoxSize(at="b", size_of="area", goal=Goal(at_most=0.1)),
        BoxSize(at="b", size_of="longest", goal=Goal(at_most=0.1)),
        SizeRatio(at="a", over="b", size_of="area", goal=Goal(at_most=0.1)),
        SheetArea(goal=Goal(at_most=0.1)),
        EdgeLengths(goal=Goal(at_least=9.0)),
        PanelCorners(goal=Goal(equals=1.2)),
        PointsOn(at="b", target=Formula("x**2 + y**2 + (z - 1)**2 - 4")),
        PointPlace(at="pose", point=DesignPoint(vertex=3), equals=(1.0, 1.0, 1.0)),
    ]


def made(kind):
    if kind == "four-bar":
        return dimensions_of(generate("four-bar").mechanism), of_links("0", "1", "2", "3")
    if kind == "axes of a Bennett linkage":
        return dimensions_of(generate("bennett").mechanism), of_links("0", "1", "2", "3")
    if kind == "Bennett":
        return dimensions_of(GENERATORS["bennett"]), of_links("0", "1", "2", "3")
    if kind == "cone":
        first = loop_on_cones(np.radians([120, 95, 45, 85]))[0]
        return ConeDimensions(first), of_links("1", "2", "3", "4")
    if kind == "vertices":
        half = np.sqrt(3.0) / 4.0
        own = [
            EqualLengths(edges=((0, 1), (1, 5), (5, 9))),
            PanelCorners(corners=((0, 1, 5), (5, 9, 10)), goal=Goal(at_least=3.0)),
            Symmetry(turns=2, centre=(3.0 * half, 1.25)),
        ]
        return dimensions_of(generate("miura", rows=2, columns=3).mechanism), [*of_sheets(), *own]
    if kind == "quadrilaterals":
        first = dimensions_of(GENERATORS["miura"], parameters={"rows": 4, "columns": 4}, closed_form=True)
        return first, [*of_sheets(), CellCurvatures(at="b", principal=(2.0, -0.5))]
    if kind == "folded triangles":
        folded = generate("waterbomb", rows=1, columns=1, fold=0.6).mechanism
        return dimensions_of(folded), of_sheets()
    return dimensions_of(GENERATORS["miura-tube"]), of_sheets()


KINDS = [
    "four-bar",
    "axes of a Bennett linkage",
    "Bennett",
    "cone",
    "vertices",
    "folded triangles",
    "tube",
    "quadrilaterals",
]


def extrapolated(function, steps):
    """Central differences, Richardson extrapolated; of several steps the ones that agree best."""
    best = []
    for step in steps:
        rows = [(function(h) - function(-h)) / (2.0 * h) for h in (step, step / 2, step / 4)]
        first, second = (4 * rows[1] - rows[0]) / 3, (4 * rows[2] - rows[1]) / 3
        best.append((float(np.abs(second - first).max()), (16 * second - first) / 15))
    return min(best, key=lambda one: one[0])[1]


def check(kind, seed):
    """At unknowns that close nothing: derivatives are exact there too."""
    family, wishes = made(kind)
    rng = np.random.default_rng((seed, KINDS.index(kind)))
    first = str(next(iter(family.linkage(family.start).linkage.graph.joints)))
    configurations = (WishedConfiguration("a", {first: 0.3}), WishedConfiguration("b"))
    problem = DesignProblem(family, Wishes(tuple(wishes), configurations))
    unknowns = problem.start + 0.05 * rng.normal(size=problem.size)
    along = rng.normal(size=problem.size)
    if kind == "tube":  # its numbers have ranges
        unknowns[: problem.numbers] = problem.start[: problem.numbers]
    along /= np.linalg.norm(along)
    exact = problem.evaluated(unknowns).jacobian(1.0) @ along
    expected = extrapolated(lambda h: problem.evaluated(unknowns + h * along).residual(1.0), (2e-3, 5e-4, 1e-4))
    np.testing.assert_allclose(exact, expected, atol=1e-6 * max(1.0, np.abs(expected).max()))
    assert np.abs(expected).max() > 1e-2


@pytest.mark.parametrize("seed", [0, *(slow(seed) for seed in range(1, 30))])
@pytest.mark.parametrize("kind", KINDS)
def test_derivatives_are_exact(kind, seed):
    check(kind, seed)
