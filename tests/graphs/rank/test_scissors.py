"""Scissors elements that share vertices, or whose bars do not cross, by generic rank and at given coordinates."""

import random

import pytest
from sizes import slow

import synth
from graphs.count.equations import mobility_of_model
from graphs.errors import UnsolvableError
from graphs.mechanism.polyhedron import PolyhedronModel, RemoteCentre
from graphs.rank.infinitesimal import infinitesimal_mobility_of_model
from graphs.rank.rods import exact_mobility_of_model

SPHERICAL = [RemoteCentre(4)]
FLAT = {0: (0, 0, 0), 1: (0, 2, 0), 2: (3, 0.3, 0), 3: (3, 2.5, 0), 4: (4, 1, 0)}


@pytest.mark.parametrize("second", [(0, 1, 2, 4), (0, 1, 4, 2)])
def test_three_vertices_shared_about_one_centre(second):
    """Lines 2-3 and 2-4 meet in vertex 2, which is the centre; 0-1 passes through it.

    So the bar 1-2 is pivoted to the bars 0-3 and 0-4 in vertex 0: five freedoms, and two for each of the others,
    as counted: 3 x 5 + 4 - 2 x 5 - 6. The second element may name 2 as the end of another bar.
    """
    model = PolyhedronModel(5, centres=SPHERICAL, scissors=[(0, 1, 2, 3), second])
    assert exact_mobility_of_model(model).mobility == mobility_of_model(model) == 3
    answer = synth.mobility(model)
    assert answer.exact.mobility == answer.mobility == 3


def test_three_vertices_shared_without_a_centre():
    """Bars 0-3 and 0-4 are pivoted to one bar 1-2 in two places and joined in vertex 0: a triangle."""
    model = PolyhedronModel(5, scissors=[(0, 1, 2, 3), (0, 1, 2, 4)], coordinates=FLAT)
    assert exact_mobility_of_model(model).mobility == infinitesimal_mobility_of_model(model).dof == 0
    answer = synth.mobility(model)
    assert (answer.mobility, answer.exact.mobility, answer.infinitesimal.dof) == (-1, 0, 0)


def test_an_element_given_twice_is_one():
    places = {vertex: FLAT[vertex] for vertex in range(4)}
    for again in ((0, 1, 2, 3), (3, 2, 1, 0), (0, 2, 1, 3)):
        model = PolyhedronModel(4, scissors=[(0, 1, 2, 3), again], coordinates=places)
        assert exact_mobility_of_model(model).mobility == infinitesimal_mobility_of_model(model).dof == 1


@pytest.mark.parametrize(
    ("elements", "points"), [([(0, 1, 2, 3), (0, 2, 1, 3)], "0 1 2 3"), ([(0, 1, 2, 3), (0, 2, 4, 5)], "0 2")]
)
def test_vertices_that_would_be_one_point_are_named(elements, points):
    model = PolyhedronModel({v for four in elements for v in four}, centres=SPHERICAL, scissors=elements)
    with pytest.raises(UnsolvableError, match=f"make one point of vertices '{points}' \\(scissors '0 1'\\)"):
        exact_mobility_of_model(model)
    answer = synth.mobility(model)
    assert answer.exact is None
    assert answer.mobility == mobility_of_model(model)
    assert any(f"vertices '{points}'" in note for note in answer.warnings)


@pytest.mark.parametrize(
    ("places", "why"),
    [
        ([(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0)], "its bars are parallel or on one line"),
        ([(0, 0, 0), (0, 1, 0), (2, 1, 0), (2, 0, 0)], "its bars are parallel or on one line"),
        ([(0, 0, 0), (0, 1, 0), (1, 0, 1), (1, 1, 0)], "its bars pass each other"),
        ([(0, 0, 0), (1, 0, 0), (2, 1, 0), (0, 0, 0)], "one of its bars has no length"),
    ],
)
def test_bars_that_do_not_cross_are_told(places, why):
    model = PolyhedronModel(4, scissors=[(0, 1, 2, 3)], coordinates=dict(enumerate(places)))
    told = f"scissors element 0 has no pivot: {why}"
    with pytest.raises(UnsolvableError, match=told):
        infinitesimal_mobility_of_model(model)
    answer = synth.mobility(model)
    assert (answer.mobility, answer.exact.mobility, answer.infinitesimal) == (1, 1, None)
    assert any(told in note for note in answer.warnings)


def test_rounded_coordinates_still_cross():
    """Bars that miss each other by what a file rounds away."""
    turned = [(0.0, 0.0, 0.0), (0.1234568, 0.9876543, 0.3333333), (1.7654321, 0.1111111, 0.7777778)]
    fourth = tuple(round(b + c - 0.9 * a + 1e-7, 7) for a, b, c in zip(*turned, strict=True))
    model = PolyhedronModel(4, scissors=[(0, 1, 2, 3)], coordinates=dict(enumerate([*turned, fourth])))
    assert infinitesimal_mobility_of_model(model).dof == 1


@pytest.mark.parametrize("number", [12, slow(40)])
def test_the_order_of_vertices_and_elements_does_not_matter(number):
    rng = random.Random(1)
    ranked = 0
    for _ in range(number):
        elements = [tuple(rng.sample(range(7), 4)) for _ in range(rng.randint(2, 4))]
        vertices = sorted({v for four in elements for v in four})
        centres = rng.choice([[], SPHERICAL])
        found = set()
        for _ in range(2):
            rng.shuffle(vertices)
            rng.shuffle(elements)
            model = PolyhedronModel(vertices, centres=centres, scissors=elements)
            try:
                found.add(exact_mobility_of_model(model).mobility)
                ranked += 1
            except UnsolvableError as error:
                assert "make one point of vertices" in str(error)
                found.add(None)
        assert len(found) == 1, elements
    assert ranked > number
