"""Derivatives of closed configurations: against configurations of mechanisms that were changed, forward and adjoint."""

from dataclasses import replace
from math import exp

import numpy as np
import pytest
from made_of import KINDS, random_made
from sizes import slow, slow_but

from graphs.convert.duality import mechanism_of_sheet
from graphs.errors import NumericalError, UnsolvableError
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from synth.analysis.folding.derivatives import SheetDerivatives, dependence_on_vertices
from synth.analysis.folding.motion import fold
from synth.analysis.motion import tangent
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.derivatives import Sensitivity, dependence_on_axes, derivatives_by_parameters, spatial
from synth.analysis.motion.linkage import linkage_of_axes, linkage_of_sheet
from synth.analysis.motion.path import driven_path
from synth.catalogue.patterns.creases import fan, folded_miura, miura
from synth.catalogue.patterns.hinged_rings import bennett
from synth.catalogue.patterns.panels import sheet_of_faces

QUICK = [
    "spherical six-bar", "spherical Stephenson", "on a cone", "planar five-bar", "spatial 8R", "Bennett",
    "Bricard, line", "Sarrus", "vertex of five", "folded Miura", "waterbomb", "triangles",
]  # fmt: skip
STRAIGHT = 1
"""A crease of a Miura sheet across its zigzags, between its first two panels."""
SIZES = (1e-2, 2e-3, 4e-4)


def nearest(closure, angles, driven):
    """The nearest closed configuration with driven joints held: Gauss and Newton's, ranks as at the first one.

    By singular value decompositions: nothing of `TangentSpace` is in it.
    """
    free = np.setdiff1d(np.arange(len(angles)), driven)
    found, rank = angles.copy(), None
    for _ in range(8):
        off, jacobian = closure.at(found)
        left, sizes, right = np.linalg.svd(jacobian.toarray()[:, free], full_matrices=False)
        rank = int((sizes > 1e-4 * sizes[0]).sum()) if rank is None else rank
        found[free] -= right[:rank].T @ ((left[:, :rank].T @ off) / sizes[:rank])
    assert closure.error(found) < 1e-12
    return found


def extrapolated(function):
    """The derivative of a function at zero: central differences of three steps, extrapolated.

    Of steps of several sizes those are taken whose last two extrapolations agree best.
    """
    estimates = []
    for size in SIZES:
        rows = [(function(step) - function(-step)) / (2 * step) for step in (size, size / 2, size / 4)]
        first, second = (4 * rows[1] - rows[0]) / 3, (4 * rows[2] - rows[1]) / 3
        estimates.append((float(np.abs(second - first).max()), (16 * second - first) / 15))
    return min(estimates, key=lambda one: one[0])[1]


def configuration(made):
    """Joint angles and places along the direction in which a mechanism is changed, in one row."""

    def at(step):
        numbers = made.numbers + step * made.direction
        angles = nearest(ClosureEquations(made.linkage(numbers)), made.angles, made.driven)
        return np.concatenate([angles, made.where(numbers, angles).ravel()])

    return at


def check(made):
    """Forward and adjoint against differences of whole mechanisms, and against each other."""
    expected = extrapolated(configuration(made))
    angles, places, residual, rank = made.forward(made.direction)
    size = np.abs(expected).max()
    assert size > 1e-2
    assert not made.at.degenerate
    assert np.abs(np.concatenate([angles, places.ravel()]) - expected).max() < 1e-7 * size
    assert np.abs(residual).max() < 1e-9 * size
    assert rank < 1e-5 * max(size, 1.0)
    assert (angles[made.driven] == 0.0).all()

    functional = np.random.default_rng(len(expected)).normal(size=len(expected))
    by_angles, by_places = functional[: len(angles)], functional[len(angles) :].reshape(places.shape)
    gradient = made.adjoint(by_angles, by_places)
    along = gradient @ made.direction
    assert abs(along - functional @ expected) < 1e-7 * np.linalg.norm(functional) * size
    forward = by_angles @ angles + (by_places * places).sum()
    scale = np.linalg.norm(gradient) * np.linalg.norm(made.direction) + np.linalg.norm(functional) * size
    assert abs(along - forward) < 1e-11 * scale
    return np.abs(np.concatenate([angles, places.ravel()]) - expected).max() / size


@pytest.mark.parametrize("kind", slow_but(["spherical six-bar", "on a cone", "Bennett", "folded Miura"], QUICK))
def test_derivatives_are_those_of_mechanisms_that_were_changed(kind):
    check(random_made(kind, 0))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("kind", KINDS)
def test_derivatives_of_many_mechanisms(kind, seed):
    check(random_made(kind, seed))


# --- what has no derivative, and what is inconsistent


def folded_sheet(sheet, angle, joint):
    """The derivatives of a sheet, frames in which it is folded until a crease has an angle, and its place."""
    mechanism = mechanism_of_sheet(sheet)
    linkage = linkage_of_sheet(sheet, mechanism)
    angles = fold(sheet, drive={joint: angle}, frames=2).path.angles
    return SheetDerivatives(sheet, mechanism, linkage), angles, list(linkage.graph.joints).index(joint)


def test_fold_angles_of_a_miura_sheet_change_as_its_closed_form_says():
    """tan(a / 2) = tan(b / 2) / cos(sector), b held, a on the zigzags: Miura 1985."""
    sector, b = 1.0, 0.9
    shape, angles, place = folded_sheet(miura(3, 4, sector), b, STRAIGHT)
    along = derivatives_by_parameters(lambda p: np.array(miura(3, 4, p[0]).coordinates), np.array([sector])).matrix
    change = shape.at(angles[-1], [place]).forward(along.reshape(-1, 2))
    half = np.tan(b / 2) / np.cos(sector)
    zigzag = np.isclose(np.abs(angles[-1]), 2 * np.arctan(half), atol=1e-9)
    assert zigzag.sum() == 8
    expected = 2 * half * np.tan(sector) / (1 + half**2)
    np.testing.assert_allclose((change.angles * np.sign(angles[-1]))[zigzag], expected, atol=1e-10)
    assert np.abs(change.angles[~zigzag]).max() < 1e-10


def test_a_flat_sheet_is_degenerate_and_a_folded_one_is_not():
    shape, angles, place = folded_sheet(miura(3, 3, 1.0), 0.8, STRAIGHT)
    flat, *folded = (shape.at(frame, [place]) for frame in angles)
    assert flat.degenerate
    assert [one.degenerate for one in folded] == [False, False]
    with pytest.raises(UnsolvableError, match="singular and has no derivative"):
        flat.forward(np.zeros((16, 2)))
    with pytest.raises(UnsolvableError, match="singular and has no derivative"):
        flat.adjoint(by_angles=np.zeros(12))


def test_a_nearly_flat_sheet_is_said_to_be_nearly_singular():
    shape, angles, place = folded_sheet(miura(3, 3, 1.0), 1e-6, STRAIGHT)
    with pytest.raises(NumericalError, match="nearly singular"):
        shape.at(angles[-1], [place]).forward(np.zeros((16, 2)))


def four_bar(points):
    """A planar four-bar, and its closure."""
    graph = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3), "infinite")])
    linkage = linkage_of_axes(graph, {j: ((*point, 0.0), (0, 0, 1)) for j, point in enumerate(points)})
    return linkage, ClosureEquations(linkage)


def test_a_parallelogram_in_one_line_is_degenerate():
    """Two ways to move meet there."""
    _, closure = four_bar([(0, 0), (2, 0), (3, 0), (1, 0)])
    at = Sensitivity(closure, np.zeros(4), [0])
    assert at.degenerate
    assert not Sensitivity(four_bar([(0, 0), (2, 0), (3, 1), (1, 1)])[1], np.zeros(4), [0]).degenerate


def test_a_driver_at_a_dead_point_cannot_be_held():
    """The crank and the coupler in line: the joint opposite turns back."""
    _, closure = four_bar([(0, 0), (1, 0), (3, 0), (2.5, 2)])
    with pytest.raises(UnsolvableError, match="cannot be held"):
        Sensitivity(closure, np.zeros(4), [3])
    assert not Sensitivity(closure, np.zeros(4), [0]).degenerate


def test_two_drivers_of_one_freedom_cannot_be_held():
    _, closure = four_bar([(0, 0), (1, 0.2), (3, 0), (2.5, 2)])
    with pytest.raises(UnsolvableError, match="depend on each other"):
        Sensitivity(closure, np.zeros(4), [0, 1])


def test_loops_have_to_be_closed():
    _, closure = four_bar([(0, 0), (1, 0.2), (3, 0), (2.5, 2)])
    with pytest.raises(UnsolvableError, match="loop-closure residual is"):
        Sensitivity(closure, np.array([0.1, 0.0, 0.0, 0.0]), [0])


def bennett_linkage():
    """Bennett's linkage away from its pose."""
    solids = bennett(1.0, 0.7, 1.2)
    linkage = linkage_of_axes(solids.chain, solids.axes)
    closure = ClosureEquations(linkage)
    return linkage, closure, driven_path(closure, linkage.angles, [0], [[0.2], [0.5]]).angles


def test_the_inconsistent_part_of_a_change_is_what_no_angles_close(rng):
    """Against self-stresses by a singular value decomposition: six equations of four joints have three."""
    linkage, closure, frames = bennett_linkage()
    at, made = Sensitivity(closure, frames[-1], [0]), dependence_on_axes(linkage).forward(rng.normal(size=24))
    change = at.forward(made)
    off = closure.by_axes(frames[-1]) @ made.twists
    left, sizes, _ = np.linalg.svd(closure.at(frames[-1])[1].toarray())
    stresses = left[:, int((sizes > 1e-9).sum()) :]
    assert stresses.shape[1] == 3
    np.testing.assert_allclose(change.residual, stresses @ (stresses.T @ off), atol=1e-12)
    np.testing.assert_allclose(closure.at(frames[-1])[1] @ change.angles + off, change.residual, atol=1e-12)
    assert np.abs(change.residual).max() > 1e-2


def test_forward_and_adjoint_agree_for_changes_that_are_not_consistent(rng):
    linkage, closure, frames = bennett_linkage()
    made = dependence_on_axes(linkage)
    for at in (Sensitivity(closure, angles, [0]) for angles in frames):
        along, functional = rng.normal(size=24), rng.normal(size=4)
        forward = functional @ at.forward(made.forward(along)).angles
        assert abs(made.adjoint(at.adjoint(functional)) @ along - forward) < 1e-11


def test_a_change_at_the_pose_closes_and_may_still_lock_it(rng):
    """Loops close at the pose whatever axes there are; Bennett's proportions are what keeps them closed."""
    parameters = np.array([1.0, 0.7, 1.2])

    def lines(p):
        axes = bennett(*p).axes.values()
        return np.array([[*point, *np.array(along) / np.linalg.norm(along)] for point, along in axes])

    linkage, closure, _ = bennett_linkage()
    at, made = Sensitivity(closure, linkage.angles, [0]), dependence_on_axes(linkage)
    slopes = derivatives_by_parameters(lines, parameters).matrix
    for along, locked in [*((column, False) for column in slopes.T), (rng.normal(size=24), True)]:
        axes = made.forward(along)
        change = at.forward(axes)
        assert np.abs(change.residual).max() < 1e-14
        assert (at.rank_residual(axes, change) > 1e-2) == locked
        assert locked or at.rank_residual(axes, change) < 1e-6


def test_freedoms_that_are_not_driven_take_the_least_change(rng):
    """It has no part along the flexes at which driven joints stay."""
    made = random_made("spatial 8R", 0)
    change, *_ = made.forward(made.direction)
    jacobian = made.at.closure.at(made.angles)[1].toarray()
    held = np.vstack([jacobian, np.eye(8)[made.driven]])
    flex = np.linalg.svd(held)[2][np.linalg.matrix_rank(held) :]
    assert flex.shape == (1, 8)
    assert np.abs(flex @ change).max() < 1e-12 * np.abs(change).max()


def test_six_equations_see_axes_that_no_longer_meet():
    """Three do not: about a centre only directions count."""
    made = random_made("spherical four-bar", 0)
    linkage = made.linkage(made.numbers)
    change = dependence_on_axes(linkage).forward(np.eye(24)[6:9].sum(axis=0))  # the second axis moved off the centre
    residuals = []
    for one in (linkage, spatial(linkage)):
        at = Sensitivity(ClosureEquations(one), made.angles, made.driven)
        residuals.append(np.abs(at.forward(change).residual).max())
    assert residuals[0] < 1e-14
    assert residuals[1] > 1e-2


def test_fold_angles_that_a_folded_sheet_has_change_with_its_vertices(rng):
    """Along any change, panels bent too; flat sheets stay at zero in their plane."""
    sheet = folded_miura(2, 3, 0.7, 1.1)
    mechanism = mechanism_of_sheet(sheet)
    places, along = np.array(sheet.coordinates), rng.normal(size=(12, 3))

    def angles(step):
        moved = replace(sheet, coordinates=tuple(map(tuple, (places + step * along).tolist())))
        return linkage_of_sheet(moved, mechanism).angles

    made = dependence_on_vertices(sheet, mechanism, linkage_of_sheet(sheet, mechanism))
    np.testing.assert_allclose(made.forward(along.ravel()).zeros, extrapolated(angles), rtol=1e-8, atol=1e-9)
    flat = miura(2, 3, 1.1)
    mechanism = mechanism_of_sheet(flat)
    assert abs(dependence_on_vertices(flat, mechanism, linkage_of_sheet(flat, mechanism)).zeros).max() == 0.0


def test_creases_of_a_tube_that_are_turned_out_of_parallel_are_inconsistent():
    """A loop of parallel creases closes with three equations, of which none sees it."""
    corners = [(x, y, z) for z in (0.0, 1.5) for x, y in [(0.0, 0.0), (1.0, 0.0), (1.2, 1.0), (0.2, 1.0)]]
    faces = [(i, (i + 1) % 4, (i + 1) % 4 + 4, i + 4) for i in range(4)]
    sheet = sheet_of_faces(corners, faces)
    mechanism = mechanism_of_sheet(sheet)
    linkage = linkage_of_sheet(sheet, mechanism)
    assert [loop.centre.value for loop in linkage.loops] == ["infinite"]
    angles = driven_path(ClosureEquations(linkage), linkage.angles, [0], [linkage.angles[:1] + 0.3]).angles[-1]
    at = SheetDerivatives(sheet, mechanism, linkage).at(angles, [0])
    sheared, turned = np.zeros((8, 3)), np.zeros((8, 3))
    sheared[[2, 6], 0] = 1.0
    turned[6, 0] = 1.0
    assert np.abs(at.forward(sheared).residual).max() < 1e-14
    assert np.abs(at.forward(turned).residual).max() > 1e-2


def test_vertices_of_no_panel_stay_where_their_coordinates_are():
    sheet = fan([0.0, 1.5, 3.0, 4.7])
    with_one_more = replace(sheet, vertices=6, coordinates=(*sheet.coordinates, (3.0, 4.0)))
    shape, angles, place = folded_sheet(with_one_more, 0.7, 1)
    at = shape.at(angles[-1], [place])
    by_places = np.zeros((6, 3))
    by_places[5] = 1.0, 2.0, 3.0
    gradient = at.adjoint(by_places=by_places)
    assert gradient[5].tolist() == [1.0, 2.0]
    assert np.abs(gradient[:5]).max() == 0.0
    moved = np.zeros((6, 2))
    moved[5] = 0.5, 0.25
    assert at.forward(moved).places[5].tolist() == [0.5, 0.25, 0.0]


@pytest.mark.parametrize("size", [3, slow(6)])
def test_a_gradient_takes_one_factorisation(size, monkeypatch):
    shape, angles, place = folded_sheet(miura(size, size, 1.0), 0.8, STRAIGHT)
    counted = []
    begin = tangent.TangentSpace.__init__
    monkeypatch.setattr(tangent.TangentSpace, "__init__", lambda *given: counted.append(given) or begin(*given))
    shape.at(angles[-1], [place]).adjoint(by_places=np.ones(((size + 1) ** 2, 3)))
    assert len(counted) == 1


@pytest.mark.parametrize(
    ("function", "method"),
    [
        (lambda p: p[:1] * np.exp(p[1:]), "complex step"),
        (lambda p: np.array([p[0] * exp(p[1])]), "differences"),  # takes no complex numbers
        (lambda p: np.array([p[0] * np.exp(p[1])], dtype=float), "differences"),  # drops imaginary parts
        (lambda p: np.abs(p[:1]) * np.exp(p[1:]) + 0 * p[:1], "differences"),  # is not analytic
    ],
)
def test_slopes_are_by_complex_steps_where_they_can_be(function, method):
    slopes = derivatives_by_parameters(function, np.array([0.7, 0.3]))
    assert slopes.method == method
    np.testing.assert_allclose(slopes.matrix, [[np.exp(0.3), 0.7 * np.exp(0.3)]], rtol=1e-11)
    assert slopes.error <= 1e-8
