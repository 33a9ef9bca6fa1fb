"""Why mechanisms move although counts say no: idle equations, their loops, reasons, errors that lock."""

import json
from collections import Counter
from dataclasses import replace
from math import inf, pi, radians

import numpy as np
import pytest
from commands import run
from sizes import first_quick, slow

import synth
from graphs.errors import UnsolvableError
from graphs.joints import JointedLinkage, JointPlace
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.moving._configuration_of import configuration_of
from synth.analysis.overconstraint import explain
from synth.analysis.overconstraint.reasons import reasons_of
from synth.analysis.overconstraint.redundancy import first_order_closure, growths
from synth.catalogue.patterns import generate

RINGS = {
    "bennett": (-2, 3, "Bennett"), "sarrus": (0, 1, "Sarrus"), "goldberg": (-1, 2, None),
    "myard": (-1, 2, "plane symmetry"), "bricard-line-symmetric": (0, 1, "line symmetry"),
    "bricard-plane-symmetric": (0, 1, "plane symmetry"), "bricard-trihedral": (0, 1, "trihedral"),
    "kaleidocycle": (0, 1, "kaleidocycle"),
}  # fmt: skip


@pytest.mark.parametrize("name", RINGS)
def test_rings_that_move_and_why(name):
    count, idle, why = RINGS[name]
    found = explain(generate(name).mechanism)
    assert (found.freedoms, found.count, found.idle, found.active) == (1, count, idle, 0)
    assert [(len(one.loops), one.idle) for one in found.sets] == [(1, idle)]
    assert any(why in reason for reason in found.sets[0].reasons) if why else found.sets[0].reasons == ()


@pytest.mark.parametrize(("rows", "columns"), [(2, 2), (3, 3), pytest.param(4, 5, marks=pytest.mark.slow)])
def test_a_miura_sheet_has_an_idle_equation_round_every_inner_panel(rows, columns):
    """(r - 2)(c - 2) of them; each in the four vertices of one panel, all other sheets of four vertices being stiff."""
    sheet = generate("miura", rows=rows, columns=columns, fold=radians(60)).mechanism
    found = explain(sheet)
    assert found.idle == len(found.sets) == (rows - 2) * (columns - 2)
    panels = {tuple(sorted(map(str, (joint for loop in one.loops for joint in loop)))) for one in found.sets}
    assert len(panels) == len(found.sets)
    for one in found.sets:
        assert (len(one.loops), one.idle) == (4, 1)
        shared = [set(a) & set(b) for a in one.loops for b in one.loops if a != b]
        assert sum(map(len, shared)) == 8  # each of the four has a crease in common with two
        assert "flat-foldable" in one.reasons[0]


@pytest.mark.parametrize("decimals", [slow(6), 4, slow(3)])
@pytest.mark.parametrize("size", [3, slow(4)])
def test_a_rounded_sheet_moves_for_the_reasons_of_the_exact_one(size, decimals):
    sheet = generate("miura", rows=size, columns=size, fold=radians(60)).mechanism
    places = tuple(tuple(round(one, decimals) for one in place) for place in sheet.coordinates)
    exact, rounded = explain(sheet), explain(replace(sheet, coordinates=places))
    assert (rounded.freedoms, rounded.idle, rounded.active) == (exact.freedoms, exact.idle, exact.active)
    assert rounded.sets == exact.sets
    assert all("flat-foldable" in one.reasons[0] for one in rounded.sets)


def test_equations_of_a_flat_sheet_are_active_at_second_order():
    found = explain(generate("miura", rows=3, columns=3).mechanism)
    assert (found.freedoms, found.idle, found.active) == (4, 4, 4)
    assert {one.reasons for one in found.sets} == {("all axes in one plane, at this configuration",)}
    assert found.tolerances == ()
    assert "at second order 4 of 4 redundant closure equations" in str(found)


def test_a_general_linkage_has_nothing_idle():
    found = explain(generate("four-bar").mechanism)
    assert (found.freedoms, found.count, found.idle, found.sets) == (1, 1, 0, ())
    assert "no closure equation is redundant" in str(found)
    with pytest.raises(UnsolvableError, match="requires coordinates"):
        explain(synth.read("k1:Cr"))


def test_vertices_that_do_not_fold_flat_are_no_reason():
    """A folded vertex of a Miura sheet turned a little out of its law."""
    linkage = configuration_of(generate("miura", rows=3, columns=3, fold=radians(60)).mechanism).linkage
    assert reasons_of(linkage, (0, 1, 2, 3))
    directions = linkage.directions.copy()
    joint = linkage.loops[2].joints[1]
    directions[joint] = np.array([0.6, 0.0, 0.8])
    assert reasons_of(replace(linkage, directions=directions), (0, 1, 2, 3)) == []


def changed(solids, joint, turn, shift):
    """Solids with one axis turned about its own point and shifted, by small vectors."""
    axes = dict(solids.axes)
    point, along = (np.array(one, dtype=float) for one in axes[joint])
    along /= np.linalg.norm(along)
    axes[joint] = (tuple(point + shift), tuple(along + np.cross(turn, along)))
    return HingedSolids(solids.chain, axes)


@pytest.mark.parametrize("name", ["bennett", "bricard-trihedral", "goldberg"])
def test_what_was_idle_grows_with_errors_as_foretold(name):
    """By the singular values of linkages built with the error: none beyond, the worst of many ways near it."""
    solids = generate(name).mechanism
    linkage = configuration_of(solids).linkage
    order = first_order_closure(linkage)
    allowed = {one.joint: one for one in explain(solids).tolerances}
    rank = len(order.matrix[0]) - order.rates.shape[1]
    error = 1e-5
    for joint in list(solids.chain.joints)[:1]:
        for by_turn in (True, False):
            worst = 0.0
            across = np.linalg.svd(np.array([solids.axes[joint][1]]))[2][1:]
            zero = np.zeros(3)
            for turn in np.linspace(0.0, pi, 12, endpoint=False):
                way = error * (np.cos(turn) * across[0] + np.sin(turn) * across[1])
                built = changed(solids, joint, way if by_turn else zero, zero if by_turn else way)
                values = np.linalg.svd(first_order_matrix(built, linkage), compute_uv=False)
                worst = max(worst, values[rank])
            limit = allowed[joint].turn if by_turn else allowed[joint].shift
            foretold = 0.0 if limit == inf else order.smallest / limit * error
            assert worst <= 1.02 * foretold + 1e-9
            assert worst >= 0.95 * foretold - 1e-9


def first_order_matrix(solids, like):
    """In the frame of the linkage without the error: other extents would be other units."""
    made = configuration_of(solids).linkage
    points = (made.points * made.extent + made.middle - like.middle) / like.extent
    return ClosureEquations(replace(made, points=points)).at(made.angles)[1].toarray()


def test_growth_is_that_of_rates_for_each_axis():
    order = first_order_closure(linkage := configuration_of(generate("bennett").mechanism).linkage)
    assert growths(linkage, order).shape == (3, 24)


@pytest.mark.parametrize("seed", first_quick(1, range(3)))
def test_a_platform_that_does_not_turn_owes_it_to_the_directions_of_its_axes(seed):
    """Three C-R-R legs, however they lie in space: 3 equations of turning, in the joints of the file."""
    turn = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    made = generate("3-crr").mechanism
    places = {
        joint: JointPlace(tuple(turn @ place.point), tuple(tuple(turn @ axis) for axis in place.axes))
        for joint, place in made.places.items()
    }
    found = explain(JointedLinkage(made.chain, made.kinds, places))
    assert (found.freedoms, found.count, found.idle, found.active) == (3, 0, 3, 0)
    assert {joint for one in found.sets for loop in one.loops for joint in loop} <= set(made.chain.joints)
    assert {axis.joint for axis in found.tolerances} == set(made.chain.joints)
    by_reason = Counter(one.reasons[0].split(":")[0] for one in found.sets for _ in range(one.idle))
    assert by_reason == {"axes parallel in each leg": 3}


def test_axes_of_a_leg_that_are_not_parallel_are_not_said_to_be():
    """A ring of two directions, three and two axes: one equation of turning, and no legs."""
    axes = [((0, 0, 0), (0, 0, 1)), ((1, 0, 0), (0, 0, 1)), ((1, 1, 0), (0, 0, 1)), ((0, 2, 1), (1, 0, 0)),
            ((0, 1, 3), (1, 0, 0))]  # fmt: skip
    ring = SCGraph(5, [(i, (i + 1) % 5) for i in range(5)])
    found = explain(HingedSolids(ring, dict(enumerate(axes))))
    (one,) = found.sets
    assert one.reasons == ("directions of axes alone: the rotational closure equations are dependent",)


def test_the_command(tmp_path, data):
    told = json.loads(run("explain", data / "linkages" / "bennett.json", "--json").stdout)
    assert (told["freedoms"], told["count"], told["h"], told["active_at_second_order"]) == (1, -2, 3, 0)
    assert told["sets"][0]["loops"] == [[3, 0, 1, 2]]
    assert {one["joint"] for one in told["tolerances"]} == {0, 1, 2, 3}
    printed = run("explain", data / "linkages" / "bennett.json").stdout
    assert "3 redundant equations in 1 loop of joints 3, 0, 1, 2: opposite links equal" in printed
    assert "requires coordinates" in run("explain", "k1:Cr", code=2).stderr
