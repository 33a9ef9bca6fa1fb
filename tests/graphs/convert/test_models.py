"""Polyhedron models as SCD graphs: as they were written, and from triangles of rods."""

import random
from collections import Counter
from itertools import combinations

import pytest
from commands import run
from seeded import seed_file
from sizes import slow
from strategies import random_scd

import synth
from graphs.convert.models import scd_of_model
from graphs.convert.panels import polyhedron_of, scd_from_panels
from graphs.errors import UnsolvableError
from graphs.files.formats import read, write
from graphs.identity.drawings import map_id
from graphs.mechanism.bodies import rigid_sets
from graphs.mechanism.polyhedron import PolyhedronModel

SQUARES = [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]


@pytest.mark.parametrize("number", [60, slow(1500)])
def test_models_of_random_scd_graphs_are_these_again(number):
    """Implicit centres, finite and at infinity, spatial faces with more open edges than the outer one, flaps, trees."""
    outer = Counter()
    for seed in range(number):
        scd = random_scd(random.Random(seed), refused=Counter())
        model = polyhedron_of(scd)
        back = scd_of_model(model)
        outer[model.outer is not None] += 1
        assert back.counts == scd.counts
        assert str(synth.identify(back)) == str(synth.identify(scd)), seed
        assert Counter(loop.centre for loop in back.centred_loops) == Counter(loop.centre for loop in scd.centred_loops)
    assert number < 1500 or outer[True] > 3


def test_a_closed_surface_keeps_the_vertex_that_closes_it():
    cube = scd_from_panels(SQUARES)
    model = polyhedron_of(cube)
    assert len(model.outer) == 1
    back = scd_of_model(model)
    assert (len(back.closing), back.counts) == (1, cube.counts)


def test_an_implicit_centre_comes_back_from_its_file(tmp_path):
    model, back = tmp_path / "model.json", tmp_path / "back.json"
    run("convert", seed_file("implicit-centre"), model, "--to", "polyhedron")
    run("convert", model, back, "--to", "scd")
    assert map_id(read(back)) == map_id(read(seed_file("implicit-centre")))
    infinite = scd_from_panels({i: (f"a{i}", f"a{(i + 1) % 4}", f"b{(i + 1) % 4}", f"b{i}") for i in range(4)})
    planar = infinite.with_loops([synth.Loop(infinite.joints, "infinite")])
    write(polyhedron_of(planar), model, force=True)
    assert read(model).is_identical(polyhedron_of(planar))
    assert synth.convert(model, "scd").loops[0].centre is synth.Centre.INFINITE


def _ring_of_tetrahedra(number: int) -> PolyhedronModel:
    fours = [[(i, "a"), (i, "b"), ((i + 1) % number, "a"), ((i + 1) % number, "b")] for i in range(number)]
    rods = {frozenset(f"{letter}{i}" for i, letter in pair) for four in fours for pair in combinations(four, 2)}
    return PolyhedronModel(sorted(set().union(*rods)), [tuple(sorted(rod)) for rod in rods])


@pytest.mark.parametrize(
    ("rods", "bodies"),
    [
        ([(0, 1), (1, 2), (2, 0), (1, 3), (2, 3)], [(0, 1, 2), (1, 2, 3)]),  # a hinge
        (combinations(range(4), 2), [(0, 1, 2, 3)]),
        ([*combinations(range(4), 2), (1, 4), (2, 4), (3, 4)], [(0, 1, 2, 3, 4)]),  # two tetrahedra on one face
        ([*combinations(range(4), 2), (2, 4), (3, 4)], [(0, 1, 2, 3), (2, 3, 4)]),
        ([(0, 1), (1, 2)], []),
    ],
)
def test_bodies_that_rods_show(rods, bodies):
    assert rigid_sets(PolyhedronModel(5, rods)) == bodies


def test_links_of_rods_are_read_from_triangles():
    four = synth.convert(seed_file("rods-four-triangles"), "scd")
    assert (map_id(four), len(four)) == ("m1:a-b.ac-.b-d.cd-", 4)
    assert len(synth.reduce(seed_file("rods-four-triangles")).graph) == 4
    for name, links in (("rods-remote-4", 4), ("rods-remote-6", 6)):
        scd = synth.convert(seed_file(name), "scd")
        assert (len(scd), scd.counts.implicit_centres, len(scd.centred_loops)) == (links, 1, 1)
    for number in (4, 6):
        ring = scd_of_model(_ring_of_tetrahedra(number))
        assert (len(ring), ring.spatial_loops, ring.counts.open_edges) == (number, 1, 2 * number)


def test_declared_plates_and_triangles_together():
    model = PolyhedronModel(5, [*combinations(range(4), 2), (0, 4), (1, 4)], links={"plate": (0, 1, 2, 3)})
    assert set(scd_of_model(model).nodes) == {"plate", 0}


@pytest.mark.parametrize(
    ("model", "where"),
    [
        (PolyhedronModel(4, [(0, 1), (1, 2), (2, 0), (2, 3)]), "vertices 2, 3 are ambiguous.*no triangle"),
        (PolyhedronModel(5, [(0, 1), *((a, b) for a in (0, 1) for b in (2, 3, 4))]), "vertices 0, 1 .* 3 bodies"),
        (PolyhedronModel(5, [(0, 1), (1, 2), (2, 0), (2, 3), (3, 4), (4, 2)]), "vertex 2 .* in a point only"),
        (PolyhedronModel(4, [(0, 1), (1, 2), (2, 0)]), "vertex 3 .* in no triangle"),
    ],
)
def test_ambiguous_vertices_are_named(model, where):
    with pytest.raises(UnsolvableError, match=where):
        scd_of_model(model)
