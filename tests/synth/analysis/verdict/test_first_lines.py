"""The first line says what the count says, and one file has one M and one h, whoever is asked."""

import json

import pytest
from commands import run
from seeded import seed_file

import synth
from graphs.mechanism.polyhedron import PolyhedronModel, RemoteCentre
from synth.catalogue.patterns import generate


@pytest.mark.parametrize(("name", "freedoms"), [("rods-remote-4", 1), ("rods-remote-6", 3)])
def test_rods_to_a_remote_centre_count_as_the_count_does(name, freedoms):
    answer = synth.mobility(seed_file(name))
    assert (answer.verdict.freedoms, answer.mobility, answer.exact.mobility) == (freedoms, freedoms, freedoms)


def _n_bar_of_quadrilaterals(number: int) -> PolyhedronModel:
    """Quadrilaterals without diagonals: rods alone, none of which triangles make a body."""
    sides = [(row + str(i), row + str((i + 1) % number)) for i in range(number) for row in "ab"]
    joints = [(f"a{i}", f"b{i}") for i in range(number)]
    vertices = [f"{row}{i}" for row in "ab" for i in range(number)]
    return PolyhedronModel(vertices, [*joints, *sides], centres=[RemoteCentre(3, tuple(joints))])


def test_where_no_bodies_are_read_the_count_answers():
    answer = synth.mobility(_n_bar_of_quadrilaterals(5))
    assert answer.exact.mobility != answer.mobility
    assert (answer.verdict.freedoms, answer.verdict.basis) == (answer.mobility, "count")
    assert f"{answer.mobility} degrees of freedom (by count)" in answer.verdict.text
    assert any("rank of rods is not the mobility" in note for note in answer.warnings)


@pytest.mark.parametrize("vertices", [0, 1, 2])
def test_degrees_of_freedom_are_never_negative(vertices):
    answer = synth.mobility(PolyhedronModel(vertices, [(0, 1)] if vertices == 2 else []))
    assert answer.verdict.freedoms == 0
    assert answer.exact.mobility == 0
    assert "-" not in answer.verdict.text


def test_a_placed_rod_has_no_negative_freedoms_either():
    rod = PolyhedronModel(2, [(0, 1)], coordinates={0: (0, 0, 0), 1: (1, 2, 3)})
    answer = synth.mobility(rod)
    assert (answer.infinitesimal.dof, answer.verdict.freedoms) == (0, 0)
    (told,) = json.loads(run("mobility", seed_file("one-rod"), "--json").stdout)
    assert told["verdict"]["freedoms"] == 0


def test_all_axes_through_an_apex_are_one_centre():
    answer = synth.mobility(seed_file("watt-on-cone"))
    assert (answer.mechanism_class, answer.centres, answer.arrangement) == ("spherical", 1, "single")
    first = answer.equations["traditional_cgk"]
    assert (first.value, first.applies, answer.mobility, answer.exact.mobility) == (1, True, 1, 1)


def test_the_second_equation_has_the_sum_of_freedoms():
    second = synth.mobility(seed_file("rssr")).equations["modified_cgk"]
    assert (second.value, second.applies) == (2, True)
    assert "overrides Eq. 1" in second.why


def test_an_equation_without_a_value_does_not_apply():
    for name in ("hybrid-without-sides", "fortune-sc", "rssr", "one-rod", "watt-on-cone", "parallel-wrist"):
        for key, equation in synth.mobility(seed_file(name)).equations.items():
            assert not (equation.applies and equation.value is None), (name, key)


@pytest.mark.parametrize(("name", "count", "over"), [("parallel-wrist", 0, 3), ("crank-rocker", 1, 0)])
def test_explain_and_mobility_have_one_m_and_one_h(name, count, over):
    """They say so in the joints of the file."""
    answer, why = synth.mobility(seed_file(name)), synth.explain(seed_file(name))
    assert (answer.mobility, why.count) == (count, count)
    assert answer.overconstraint == why.overconstraint == over
    joints = set(synth.read(seed_file(name)).chain.joints)
    assert {joint for one in why.sets for loop in one.loops for joint in loop} <= joints
    assert {axis.joint for axis in why.tolerances} <= joints
    assert f"h = {over}" in str(why).splitlines()[0]


@pytest.mark.parametrize("name", ["bennett", "sarrus", "3-upu", "stewart", "miura-tube", "kresling"])
def test_generated_linkages_have_one_m_too(name):
    made = generate(name).mechanism
    answer, why = synth.mobility(made, exact=False, motion=False), synth.explain(made)
    assert (why.count, why.overconstraint) == (answer.mobility, answer.overconstraint)


def test_one_h_is_stated_where_the_motion_has_fewer_degrees_of_freedom_than_the_configuration():
    """Hoberman's cube: 1 degree of freedom and h = 19, of 3 infinitesimal ones."""
    made = generate("scissor-cube").mechanism
    lines = str(synth.mobility(made, exact=False)).splitlines()
    assert "h = 19" in lines[0]
    assert not any("h = 21" in line for line in lines)
