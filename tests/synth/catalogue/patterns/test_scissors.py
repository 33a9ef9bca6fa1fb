"""Scissors of kinked links: lengths by coordinates, one freedom each beside the flexes of first order."""

from itertools import combinations
from math import acos, radians, sqrt

import numpy as np
import pytest
from sizes import slow

from graphs.errors import InvariantError
from graphs.tolerances import DOUBLE
from synth.analysis.advice import advise
from synth.analysis.compliance import states
from synth.analysis.motion.singular import freedoms_at
from synth.analysis.motion.singular.second_order import rates_at
from synth.analysis.moving._configuration_of import configuration_of
from synth.catalogue.patterns import generate
from synth.catalogue.patterns.scissors import CUBE, OCTAHEDRON, TETRAHEDRON, prism, scissor_polyhedron, scissor_ring


def lengths(linkage):
    """Distances between the joints of each link: {(link, joint, joint): distance}."""
    of = {link: [] for link in linkage.chain.nodes}
    for joint, ends in linkage.chain.joints.items():
        for link in ends:
            of[link].append(joint)
    at = {joint: np.array(place.point) for joint, place in linkage.places.items()}
    return {
        (link, a, b): np.linalg.norm(at[a] - at[b]) for link, joints in of.items() for a, b in combinations(joints, 2)
    }


@pytest.mark.parametrize("corners", [CUBE, OCTAHEDRON, TETRAHEDRON, prism(3), prism(5)])
def test_links_keep_their_lengths_at_all_openings(corners):
    """So all openings are one linkage that moves."""
    first, second = (lengths(scissor_polyhedron(corners, opening)) for opening in (0.2, 0.55))
    assert first == pytest.approx(second, abs=1e-14)
    arms = [value for (_, a, b), value in first.items() if a.startswith("pin") or b.startswith("pin")]
    assert arms == pytest.approx([1.0] * len(arms))


def test_the_cube_has_the_links_of_the_paper():
    cube = scissor_polyhedron(CUBE, 0.6)
    assert (len(cube.chain), cube.kinds_in_words) == (24, "12 revolute, 32 spherical")
    pins = [np.linalg.norm(place.point) for joint, place in cube.places.items() if joint.startswith("pin")]
    assert pins == pytest.approx([np.cos(0.6) * sqrt(3.0)] * 12)


def test_near_ends_do_not_pass_the_middle():
    with pytest.raises(InvariantError, match=r"opening = 40 degrees.*; expected less than 35\.2644 degrees"):
        scissor_polyhedron(TETRAHEDRON, radians(40))
    with pytest.raises(InvariantError, match="less than 30 degrees"):
        scissor_ring(3, radians(31))


@pytest.mark.parametrize(("sides", "flexes"), [(3, 2), slow(4, 3)])
def test_a_configuration_beside_the_branch_has_the_freedoms_of_the_branch(sides, flexes):
    """Closed to 1e-12 as those of a path are, and 1e-6 off it along what closes to first order only."""
    at = configuration_of(scissor_polyhedron(prism(sides), 0.5))
    rates = rates_at(at.closure, at.linkage.angles)
    assert rates.shape[1] == flexes
    for seed in range(2):
        beside = at.linkage.angles + 3e-6 * rates @ np.random.default_rng(seed).normal(size=flexes)
        assert at.closure.error(beside) <= DOUBLE.closed
        assert freedoms_at(at.linkage, at.closure, beside) == 1


def freedoms(linkage):
    (way,) = configuration_of(linkage).branches.branches
    assert way.certainty in ("proved", "numerical")
    return way.freedoms


def test_rings_and_the_tetrahedron_have_one_freedom():
    for scissors in (4, 7, 10):
        assert freedoms(generate("scissor-ring", scissors=scissors).mechanism) == 1
    assert freedoms(generate("scissor-tetrahedron").mechanism) == 1


@pytest.mark.slow
@pytest.mark.parametrize("pin", np.linspace(1.2, 1.6, 9))
def test_the_cube_has_one_freedom_at_nine_configurations(pin):
    cube = scissor_polyhedron(CUBE, acos(pin / sqrt(3.0)))
    at = configuration_of(cube)
    assert rates_at(at.closure, at.linkage.angles).shape[1] == 3
    assert freedoms(cube) == 1


@pytest.mark.slow
@pytest.mark.parametrize("opening", [0.1, 0.3, 0.5])
@pytest.mark.parametrize("corners", [OCTAHEDRON, TETRAHEDRON, prism(3), prism(5)])
def test_other_polyhedra_have_one_freedom(corners, opening):
    assert freedoms(scissor_polyhedron(corners, opening)) == 1


@pytest.mark.parametrize("pin", [slow(1.2), 1.6])
def test_advice_and_states_of_the_cube_follow_its_one_freedom(pin):
    cube = scissor_polyhedron(CUBE, acos(pin / sqrt(3.0)))
    answer = advise(cube, 0)
    assert answer.freedoms == 1
    assert all(len(lock.joints) == 1 for lock in answer.locks)
    assert answer.locks[0].joints[0].startswith("pin")
    locked = states(cube, joints=answer.locks[0].joints)
    assert [state.freedoms for state in locked.sets] == [0, 1]
