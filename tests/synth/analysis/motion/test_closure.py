"""Closure equations: derivatives against differences, kinds of loops against each other, Bennett's linkage."""

import numpy as np
import pytest

from graphs.errors import InvariantError, UnsolvableError
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.tolerances import Tolerances
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.motion.closure import ClosureEquations, corrected
from synth.analysis.motion.linkage import linkage_of_axes, linkage_of_sheet
from synth.analysis.motion.path import driven_path
from synth.analysis.motion.singular.sampling import freedoms_at
from synth.analysis.motion.tangent import SparseFactor, TangentSpace, closed_rates
from synth.catalogue.patterns import generate
from synth.catalogue.patterns.creases import fan, miura
from synth.catalogue.patterns.hinged_rings import bennett

RING = [(k, (k + 1) % 6) for k in range(6)]


def ring(centre, rng):
    """Six links in a ring; axes through a point, parallel, or anyhow."""
    directions = rng.normal(size=(6, 3))
    points = rng.normal(size=(6, 3))
    if centre == "finite":
        points = 2.0 + directions * rng.normal(size=(6, 1))
    if centre == "infinite":
        directions = np.outer(rng.choice([-1.0, 1.0], 6), directions[0])
    graph = SCGraph(6, RING, [Loop(range(6), centre)])
    return linkage_of_axes(graph, dict(enumerate(zip(points, directions, strict=True))))


@pytest.mark.parametrize("centre", ["finite", "infinite", "none"])
def test_derivatives_are_limits_of_differences_at_closed_poses(centre, rng):
    """At a closed pose; farther off the rotation vector has another derivative."""
    closure = ClosureEquations(ring(centre, rng))
    assert closure.rows == (6 if centre == "none" else 3)
    at = np.zeros(6)
    _, jacobian = closure.at(at)
    for joint in range(6):
        step = np.eye(1, 6, joint)[0] * 1e-6
        difference = (closure.at(at + step)[0] - closure.at(at - step)[0]) / 2e-6
        np.testing.assert_allclose(jacobian.toarray()[:, joint], difference, atol=1e-8)


def test_a_loop_with_a_centre_closes_where_six_equations_do(rng):
    with_centre = ring("finite", rng)
    axes = dict(enumerate(zip(with_centre.points, with_centre.directions, strict=True)))
    without = linkage_of_axes(SCGraph(6, RING), axes)
    path = driven_path(ClosureEquations(with_centre), np.zeros(6), [0], [0.3, 0.7])
    assert path.stopped == ""
    assert max(ClosureEquations(without).error(angles) for angles in path.angles) < 1e-11
    assert np.abs(path.angles[-1]).min() > 1e-3


@pytest.mark.parametrize("twists", [(0.7, 1.2), (0.4, 2.0)])
def test_bennetts_linkage_keeps_its_law(twists):
    """tan(first / 2) tan(second / 2) is constant, though six equations stand against four joints."""
    solids = bennett(1.0, *twists)
    linkage = linkage_of_axes(solids.chain, solids.axes)
    closure = ClosureEquations(linkage)
    assert freedoms_at(linkage, closure, linkage.angles) == 1
    path = driven_path(closure, linkage.angles, [0], np.linspace(0.0, 2.0, 9)[1:])
    assert path.stopped == ""
    assert path.errors.max() < 1e-12
    second = 2.0 * np.arctan2(np.sin(sum(twists) / 2), np.sin((twists[1] - twists[0]) / 2) * np.tan(0.5))
    law = np.tan((1.0 + path.angles[:, 0]) / 2) * np.tan((second + path.angles[:, 1]) / 2)
    np.testing.assert_allclose(law, law[0], rtol=1e-10)


def test_fold_angles_are_those_of_the_coordinates():
    rise = np.sin(np.radians(30))
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, -np.cos(np.radians(30)), rise), (1, -0.5, rise))
    book = Sheet(6, ((0, 1),), "V", ((0, 1, 2, 3), (1, 0, 4, 5)), corners)
    assert np.degrees(linkage_of_sheet(book).angles[0]) == pytest.approx(30, abs=8)
    other_way = Sheet(6, ((0, 1),), "V", ((0, 1, 2, 3), (0, 1, 5, 4)), corners)  # a face listed clockwise
    assert linkage_of_sheet(other_way).angles == pytest.approx(linkage_of_sheet(book).angles)


@pytest.mark.parametrize(("letter", "angle"), [("V", 180.0), ("M", -180.0)])
def test_panels_on_each_other_fold_as_the_file_says(letter, angle):
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 2, 0), (1, 2, 0))
    closed = Sheet(6, ((0, 1),), letter, ((0, 1, 2, 3), (1, 0, 4, 5)), corners)
    assert np.degrees(linkage_of_sheet(closed).angles) == pytest.approx([angle])


@pytest.mark.parametrize(("letter", "angle"), [("V", 180.0), ("M", -180.0)])
def test_rounded_panels_on_each_other_fold_as_the_file_says(letter, angle):
    """A narrow panel whose far corners were moved, by rounding, through the panel it lies on."""
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0.2, 5e-5), (1, 0.2, 5e-5))
    closed = Sheet(6, ((0, 1),), letter, ((0, 1, 2, 3), (1, 0, 4, 5)), corners)
    assert np.degrees(linkage_of_sheet(closed).angles) == pytest.approx([180.0 - np.degrees(5e-5 / 0.2)])
    assert np.degrees(linkage_of_sheet(closed, None, Tolerances.of(5e-5)).angles) == pytest.approx([angle])


def test_what_has_no_axis_is_refused():
    with pytest.raises(UnsolvableError, match="needs coordinates"):
        linkage_of_sheet(Sheet(3, (), "", ((0, 1, 2),)))
    two = SCGraph(2, [(0, 1)])
    with pytest.raises(InvariantError, match="joint 0 has no axis"):
        linkage_of_axes(two, {})
    with pytest.raises(InvariantError, match="no direction"):
        linkage_of_axes(two, {0: ((0, 0, 0), (0, 0, 0))})


def test_a_correction_factorises_once(monkeypatch):
    """Steps with the first matrix leave little enough."""
    solids = bennett(1.0, 0.7, 1.2)
    closure = ClosureEquations(linkage_of_axes(solids.chain, solids.axes))
    made, begin = [], TangentSpace.__init__
    monkeypatch.setattr(ClosureEquations, "corrected", lambda *_: None)  # the library takes the same steps
    monkeypatch.setattr(TangentSpace, "__init__", lambda space, matrix: (made.append(space), begin(space, matrix))[1])
    pose = corrected(closure, np.array([1e-4, 0.0, 0.0, -1e-4]))
    assert pose.closed
    assert pose.steps > 1
    assert len(made) == 1


def test_flat_sheets_close(rng):
    for sheet in (miura(3, 4, 1.0), fan(np.sort(rng.uniform(0, 2 * np.pi, 7)))):
        linkage = linkage_of_sheet(sheet)
        assert ClosureEquations(linkage).error(linkage.angles) == 0.0
        assert not linkage.angles.any()


@pytest.mark.parametrize("regular", [1e-9, 1e-6, 1e-3])
def test_rates_are_freed_of_what_regularisation_leaves(regular):
    """Nearly flat, a sheet has singular values far below the rest; the second method is a full decomposition."""
    at = configuration_of_sheet(generate("miura", rows=10, columns=10, fold=0.05).mechanism)
    jacobian = at.closure.at(at.linkage.angles)[1]
    _, values, vectors = np.linalg.svd(jacobian.toarray())
    freedoms = vectors[values < 1e-12]
    factor, rates = SparseFactor(jacobian, regular), np.random.default_rng(1).normal(size=at.closure.joints)
    once = factor.projected(rates)
    np.testing.assert_allclose(closed_rates(factor, once), freedoms.T @ (freedoms @ rates), atol=1e-9)
    assert (np.abs(jacobian @ once).max() > 1e-7) == (regular > 1e-9)
