"""Proofs that nothing moves, definite sums of forms, and the equations that several loops have together."""

import numpy as np
import pytest
from folding_patterns import pleated_hypar, spoked_cube

from synth.analysis.motion.branches import branches_of
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.linkage import linkage_of_axes, linkage_of_sheet
from synth.analysis.motion.singular.second_order import (
    Quadric,
    all_quadrics,
    definite_weights,
    local_forms,
    quadrics_of,
    rates_at,
    rigidity_of,
    shared_quadrics,
    spaces_within,
)
from synth.catalogue.patterns.cartons import box_pop_up
from synth.catalogue.patterns.creases import fan, kresling, miura


def disturbed(axes, rng):
    """Return axes, those that are one moved as one."""
    places = {direction: tuple(np.array(direction) + 0.1 * rng.normal(size=3)) for _, direction in axes.values()}
    return {joint: (point, places[direction]) for joint, (point, direction) in axes.items()}


def test_the_cube_is_rigid_by_a_stress_that_its_loops_have_together(rng):
    graph, axes = spoked_cube()
    cube = linkage_of_axes(graph, axes)
    assert quadrics_of(cube) == []
    found = rigidity_of(cube)
    assert (found.proof, found.flexes, len(found.equations)) == ("definite stress", 2, 1)
    assert found.margin > 0.5
    told = branches_of(cube)
    assert (told.branches, told.no_motion, told.exhaustive) == ((), "proved", True)
    general = branches_of(linkage_of_axes(graph, disturbed(axes, rng)))
    assert [(branch.freedoms, branch.certainty) for branch in general.branches] == [(1, "proved")]
    assert general.no_motion is None


@pytest.mark.parametrize("directions", [(0, 30, 70, 100), (0, 20, 50, 90, 130)])
def test_a_sector_of_more_than_half_a_turn(directions):
    found = rigidity_of(linkage_of_sheet(fan(np.radians(directions))))
    assert (found.proof, found.flexes) == ("definite stress", len(directions) - 2)
    linkage = linkage_of_sheet(fan(np.radians(directions)))
    tangent = rates_at(ClosureEquations(linkage), linkage.angles)
    form = sum(
        multiple * tangent[list(one.joints)].T @ one.form @ tangent[list(one.joints)]
        for multiple, one in zip(found.stress, found.equations, strict=True)
    )
    values = np.linalg.eigvalsh(form)
    assert values.min() > found.margin * values.max() * 0.999 > 0.0


def test_what_moves_is_not_proved_rigid():
    for sheet in (miura(3, 3, np.radians(60)), fan(np.radians([0, 60, 180, 300])), kresling(5, ends=0)):
        assert rigidity_of(linkage_of_sheet(sheet)).certainty == "not known"


def test_proofs_by_cases():
    """No sum of the equations is definite: in each mode of one vertex others are rigid."""
    sheet = miura(3, 3, np.radians(50))
    places = list(sheet.coordinates)
    places[5], places[10] = (0.77137, 1.64113), (1.50231, 1.90417)
    linkage = linkage_of_sheet(type(sheet)(sheet.vertices, sheet.edges, sheet.assignments, sheet.faces, tuple(places)))
    found = rigidity_of(linkage)
    assert (found.proof, found.stress) == ("cases", None)
    assert branches_of(linkage).no_motion == "proved"


@pytest.mark.parametrize(
    "linkage",
    [
        linkage_of_axes(*spoked_cube()),
        linkage_of_sheet(kresling(4, ends=1, turn=np.pi / 4)),
        linkage_of_sheet(pleated_hypar(1, middle_creased=False)),
        linkage_of_sheet(box_pop_up()),
    ],
)
def test_equations_are_those_of_differences(linkage, rng):
    """What is of second order in the closure equations, across all their derivatives, spans the same forms."""
    closure = ClosureEquations(linkage)
    _, jacobian = closure.at(linkage.angles)
    left, values, _ = np.linalg.svd(jacobian.toarray())
    across = left[:, (values > 1e-9).sum() :]
    tangent = rates_at(closure, linkage.angles)
    forms = local_forms(tangent, all_quadrics(linkage, tangent))
    samples, ours = [], []
    for _ in range(60):
        x, step = rng.normal(size=tangent.shape[1]), 1e-3
        rates = tangent @ x
        ends = [closure.at(linkage.angles + sign * step * rates)[0] for sign in (1, -1)]
        samples.append(across.T @ (ends[0] + ends[1]) / (2 * step**2))
        ours.append(np.einsum("i,nij,j->n", x, forms, x))
    samples, ours = np.array(samples), np.array(ours).reshape(60, -1)
    ranks = [np.linalg.matrix_rank(one, tol=1e-3) for one in (samples, ours, np.concatenate([samples, ours], axis=1))]
    assert ranks[0] == ranks[1] == ranks[2]


def test_flat_sheets_have_no_more_equations_than_vertices():
    linkage = linkage_of_sheet(miura(4, 4, np.radians(60)))
    tangent = rates_at(ClosureEquations(linkage), linkage.angles)
    alone = quadrics_of(linkage)
    assert len(alone) == 9
    assert shared_quadrics(linkage, tangent, alone) == []


def test_definite_sums_are_found_where_they_are(rng):
    for size, number in ((2, 2), (5, 4), (12, 30)):
        forms = rng.normal(size=(number, size, size))
        forms += forms.transpose(0, 2, 1)
        hidden = rng.normal(size=number)
        wanted = np.eye(size) + 0.1 * np.diag(rng.uniform(size=size))
        last = int(np.abs(hidden).argmax())
        forms[last] += (wanted - np.tensordot(hidden, forms, 1)) / hidden[last]
        weights, margin = definite_weights(forms, 1e-9)
        values = np.linalg.eigvalsh(np.tensordot(weights, forms, 1))
        assert values[0] / values[-1] == pytest.approx(margin)
        assert values[0] > 0.0


def test_equations_that_only_together_leave_nothing():
    """Each form has squares of both signs and is no product; the three add up to the sum of all squares."""
    forms = [np.diag(4.0 * np.eye(3)[place] - 1.0) for place in range(3)]
    equations = [Quadric((0, 1, 2), form) for form in forms]
    assert list(spaces_within(np.eye(3), equations)) == []
    [two] = spaces_within(np.eye(3), equations[:2])
    assert (two.basis.shape, len(two.left)) == ((3, 3), 2)


def test_no_definite_sum_where_all_vanish_somewhere(rng):
    for size, number in ((2, 1), (4, 3), (6, 8)):
        x = rng.normal(size=size)
        forms = rng.normal(size=(number, size, size))
        forms += forms.transpose(0, 2, 1)
        forms -= (np.einsum("i,nij,j->n", x, forms, x) / (x @ x))[:, None, None] * np.eye(size)
        assert definite_weights(forms, 1e-9) is None
