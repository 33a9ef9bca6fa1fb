"""All positions of spherical linkages: counted, against closed forms, and against Newton's method from random starts."""

from math import pi, radians

import numpy as np
import pytest
from spherical import FOUR_BAR, STEPHENSON, WATT, by_newton, is_among, spherical

from enumerate.chains.jobs import chains
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read
from graphs.mechanism.sc import SCGraph
from synth.analysis.assembly import positions
from synth.analysis.assembly.ends import solutions
from synth.analysis.assembly.family import family_of
from synth.analysis.assembly.general import general_positions
from synth.analysis.moving._configuration_of import configuration_of
from synth.catalogue.patterns import generate
from synth.catalogue.patterns.hinged_rings import spherical_ring
from synth.linkages.fourbar.position import output_spherical

slow = pytest.mark.slow
CASES = [
    *[pytest.param(WATT, joint, 4, marks=() if joint == 0 else slow) for joint in range(7)],
    *[pytest.param(STEPHENSON, joint, 4, marks=slow) for joint in range(4)],
    *[pytest.param(STEPHENSON, joint, 8, marks=() if joint == 5 else slow) for joint in range(4, 7)],
    (FOUR_BAR, 0, 2),
]


@pytest.mark.parametrize(("graph", "joint", "number"), CASES)
def test_how_many_positions_there_are(graph, joint, number):
    linkage = spherical(graph, np.random.default_rng(joint))
    family, _ = family_of(linkage, [joint])
    assert len(general_positions(family, seed=joint).values) == number


def found_in_random_cases(graph, joint, cases, starts):
    """Members with random axes: the pose of the axes, and what Newton's method comes to, is found, and nothing lost."""
    random = np.random.default_rng(cases + joint)
    family, _ = family_of(spherical(graph, random), [joint])
    general = general_positions(family)
    for case in range(cases):
        linkage = spherical(graph, random)
        _, axes = family_of(linkage, [joint])
        ends = solutions(family, general, family.member(axes, np.zeros(1)), seed=case)
        values = ends.values
        assert (ends.far, ends.singular, ends.lost) == (0, 0, 0)
        assert len(values) == len(general.values)
        off = np.abs(values - 2 * pi * np.rint(values.real / (2 * pi))).max(axis=1)
        assert off.min() < 1e-8
        real = values[np.abs(values.imag).max(axis=1) < 1e-7].real
        assert len(real) % 2 == 0
        if case % 10 == 0:
            for angles in by_newton(linkage, {joint: 0.0}, random, starts):
                near = real - np.delete(angles, joint)
                assert np.abs(np.remainder(near + pi, 2 * pi) - pi).max(axis=1).min() < 1e-6


@pytest.mark.parametrize(("graph", "joint"), [(FOUR_BAR, 0), (STEPHENSON, 4)])
def test_every_known_position_is_found(graph, joint):
    found_in_random_cases(graph, joint, 2, starts=2)


@slow
@pytest.mark.parametrize(("graph", "joint"), [(FOUR_BAR, 0), (WATT, 0), (STEPHENSON, 1), (STEPHENSON, 4)])
def test_every_known_position_is_found_in_ten_thousand_cases(graph, joint):
    found_in_random_cases(graph, joint, 2500, starts=8)


@slow
def test_eight_bars():
    """Of all sixteen: 8, 16, 24 or 32 by the driven joint; none that Newton's method comes to is missed."""
    random = np.random.default_rng(8)
    numbers = set()
    for chain in chains(links=8, dof=1):
        graph = SCGraph(chain.nodes, list(chain.edges()))
        for joint in random.choice(10, 3, replace=False).tolist():
            linkage = spherical(graph, random)
            found = positions(linkage, drive={joint: 0.3}, circuits=False)
            assert found.exhaustive
            assert all(is_among(angles, found.positions) for angles in by_newton(linkage, {joint: 0.3}, random, 15))
            numbers.add(found.general)
    assert numbers == {8, 16, 24, 32}


@pytest.mark.parametrize("turn", [-80, 10, 60])
def test_four_bars_by_their_closed_form(turn):
    """Input and output angles between links: of the ring's joints those beside the ground, link 3."""
    arcs = np.radians([60, 80, 75, 70])  # input, coupler, output, ground
    ring = spherical_ring(arcs)
    found = positions(ring, drive={0: radians(turn)}, circuits=False)
    axes = np.array([along for _, along in ring.axes.values()])

    def dihedral(first, middle, last):
        one, other = np.cross(axes[middle], axes[first]), np.cross(axes[middle], axes[last])
        return np.arctan2(np.cross(one, other) @ axes[middle], one @ other)

    zero = dihedral(3, 0, 1), dihedral(0, 3, 2)
    wanted = output_spherical(arcs[[3, 0, 1, 2]], np.array([zero[0] + radians(turn)] * 2), [1, -1])
    turned = np.array([zero[1] - one.angles[3] for one in found.positions])
    psi = np.pi - turned
    assert len(found.positions) == np.isfinite(wanted).sum() == 2
    for one in psi:
        assert np.abs(np.remainder(np.abs([one - wanted, one + wanted]) + pi, 2 * pi) - pi).min() < 1e-9


def test_inputs_out_of_reach_have_no_position():
    found = positions(spherical_ring(np.radians([100, 40, 40, 40])), drive={0: radians(150)}, circuits=False)
    assert (found.positions, found.imaginary, found.exhaustive) == ((), 2, True)
    assert "0 assembly modes" in str(found)


@pytest.mark.parametrize(
    ("arcs", "driver", "told"),
    [
        ((40, 60, 70, 100), 0, [(0, 0), (0, 1)]),
        pytest.param((30, 80, 70, 75), 0, [(0, 0), (1, 0)], marks=slow),
        pytest.param((30, 80, 70, 75), 3, [(0, 0), (0, 1)], marks=slow),
    ],
)
def test_circuits_and_branches_of_four_bars(arcs, driver, told):
    """A crank has a circuit for each of its two positions; without one there is one circuit, which turns back.

    A rocker beside a crank turns back twice on each circuit.
    """
    found = positions(spherical_ring(np.radians(arcs)), drive={driver: 0.0})
    assert [(one.circuit, one.branch) for one in found.positions] == told
    assert found.notes == ()


def test_creases_of_a_vertex(data):
    found = positions(read(data / "patterns" / "four-bar-vertex.fold"), drive={2: pi / 2}, circuits=False)
    assert [round(float(np.degrees(one.angles[0])), 4) for one in found.positions] == [-137.7883, -16.0831]
    told = found.to_json()
    assert (told["general"], told["exhaustive"], told["driven_deg"]) == (2, "proved", {"2": 90.0})
    assert told["positions"][0]["angles_deg"]["2"] == pytest.approx(90)


def test_several_inputs_and_another_seed():
    made = configuration_of(generate("five-bar").mechanism).linkage
    found = [positions(made, drive={0: 0.2, 1: -0.1}, seed=seed) for seed in (0, 1)]
    assert [len(one.positions) for one in found] == [2, 2]
    np.testing.assert_allclose(*([p.angles for p in one.positions] for one in found), atol=1e-9)
    assert found[0].positions[0].circuit is None


def test_what_cannot_be_answered_is_refused(data):
    ring = generate("four-bar").mechanism
    with pytest.raises(UnsolvableError, match=r"2 joints driven; expected .* M = 1 by count"):
        positions(ring, drive={0: 0.1, 1: 0.1})
    with pytest.raises(UnsolvableError, match="neither meet in a point nor are parallel"):
        positions(generate("bennett").mechanism, drive={0: 0.1})
    with pytest.raises(InvariantError, match="9 is no joint of a loop"):
        positions(ring, drive={9: 0.1})
    with pytest.raises(InvariantError, match="the angle of joint 0 is nan"):
        positions(ring, drive={0: float("nan")})
    stiff = SCGraph(6, [(0, 1), (1, 2), (2, 0), (0, 3), (3, 4), (4, 5), (5, 0)])  # a rigid loop of three
    with pytest.raises(UnsolvableError, match="do not determine the others"):
        positions(spherical(stiff, np.random.default_rng(1)), drive={0: 0.1})


def test_an_open_chain_has_no_positions_to_solve_for(data):
    with pytest.raises(UnsolvableError, match="positions requires a closed loop; here each joint moves by itself"):
        positions(read(data / "realised" / "chain-US.fold"), drive={})


@pytest.mark.parametrize(("name", "drive"), [("four-bar", (0,)), ("five-bar", (0, 2))])
def test_many_inputs_have_the_modes_of_each(name, drive):
    """Also where there are fewer real ones, or none: each input has a row, and counts say what became of the others."""
    mechanism = generate(name).mechanism
    random = np.random.default_rng(6)
    inputs = {joint: random.uniform(-pi, pi, 12) for joint in drive}
    table = positions(mechanism, drive=inputs)
    for row in range(12):
        alone = positions(mechanism, drive={joint: float(inputs[joint][row]) for joint in drive}, circuits=False)
        assert table.count[row] == len(alone.positions)
        assert table.exhaustive[row] == alone.exhaustive
        modes = table.angles[row, : table.count[row]]
        np.testing.assert_allclose(modes, np.array([one.angles for one in alone.positions]).reshape(modes.shape))
        assert np.isnan(table.angles[row, table.count[row] :]).all()
        assert (table.imaginary[row], table.far[row], table.lost[row]) == (alone.imaginary, alone.far, alone.lost)
    assert f"assembly modes at 12 inputs of joint {', '.join(map(str, drive))}" in str(table)
    told = table.to_json()
    assert [len(modes) for modes in told["positions"]] == table.count.tolist()


def test_dead_points_and_arrays_that_do_not_fit():
    ring = spherical_ring(np.radians([100, 40, 40, 40]))
    table = positions(ring, drive={0: [0.0, radians(150)]})
    assert table.count.tolist()[1] == 0
    with pytest.raises(InvariantError, match="circuits of many inputs; expected one input"):
        positions(ring, drive={0: [0.1]}, circuits=True)
    with pytest.raises(InvariantError, match=r"inputs of shapes \(2,\), \(3,\)"):
        positions(generate("five-bar").mechanism, drive={0: [0.1, 0.2], 1: [0.1, 0.2, 0.3]})
    with pytest.raises(InvariantError, match="the angle of joint 0 is nan"):
        positions(ring, drive={0: [0.1, float("nan")]})
