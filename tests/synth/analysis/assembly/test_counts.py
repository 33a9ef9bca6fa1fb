"""How many positions there are: by theorems, by curves of members, by a trace test, and by two methods of the tests.

These share no code with the first: a homotopy for planar linkages, and elimination modulo a prime.
"""

import json
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from elimination import number_of_positions, plates_of, random_plates, residue
from planar_homotopy import positions_of
from spherical import FOUR_BAR, STEPHENSON, WATT, planar, spherical

from enumerate.chains.jobs import chains
from graphs.errors import UnsolvableError
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from graphs.tolerances import DOUBLE
from synth.analysis.assembly import general as module, positions
from synth.analysis.assembly.counts import in_plane, on_sphere, root_count
from synth.analysis.assembly.cutting import with_own_joints
from synth.analysis.assembly.ends import solutions
from synth.analysis.assembly.family import family_of
from synth.analysis.assembly.general import general_positions, traced
from synth.analysis.assembly.precise import certified, followed
from synth.analysis.moving._configuration_of import configuration_of

slow = pytest.mark.slow
CASES = Path(__file__).parents[4].parent / "shared" / "cases"
UP = (0.0, 0.0, 1.0)


def bars(points, edges):
    """Bars between points of the plane: at each point all are joined to the first of them."""
    ids = [f"{a}-{b}" for a, b in edges]
    joints, axes = {}, {}
    for vertex, place in points.items():
        first, *others = (name for name, edge in zip(ids, edges, strict=True) if vertex in edge)
        for number, other in enumerate(others):
            joints[f"{vertex}.{number}"] = (first, other)
            axes[f"{vertex}.{number}"] = ((*map(float, place), 0.0), UP)
    return HingedSolids(SCGraph(ids, joints), axes)


PRISM = bars(
    {0: (0, 0), 1: (6, 0), 2: (3, 5), 3: (1, 1), 4: (4, 1), 5: (2, 3)},
    [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
)
BIPARTITE = bars(
    {0: (0, 0), 1: (2, 0.3), 2: (4, -0.4), 3: (0.5, 2), 4: (1.9, 2.7), 5: (4.2, 1.6)},
    [(a, b) for a in (0, 1, 2) for b in (3, 4, 5)],
)


def plates(*sets):
    return [frozenset(one) for one in sets]


# Of trusses without freedom and without a smaller one, by the number of links; the counts in the plane are classic.
TRUSSES = {
    "5 links": (plates((0, 1, 2), (3, 4, 5), (0, 3), (1, 4), (2, 5)), 6, 8),
    "7 links, a quaternary one": (
        plates((0, 1, 2, 3), (4, 5, 6), (6, 7, 8), (0, 4), (1, 5), (2, 7), (3, 8)), 18, 32,
    ),
    "7 links, ternary in a row": (
        plates((0, 1, 2), (2, 3, 4), (4, 5, 6), (6, 7, 8), (0, 7), (1, 5), (3, 8)), 16, 24,
    ),
    "7 links, ternary round one": (
        plates((0, 1, 2), (3, 4, 5), (6, 7, 8), (2, 3, 6), (0, 4), (1, 7), (5, 8)), 14, 16,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", TRUSSES)
def test_trusses(name):
    """By theorem, in the plane and on the sphere; in the plane by a homotopy too, and by tracking."""
    links, in_the_plane, on_the_sphere = TRUSSES[name]
    assert (in_plane(links), on_sphere(links)) == (in_the_plane, on_the_sphere)
    random = np.random.default_rng(len(links))
    joints = {v: tuple(k for k, link in enumerate(links) if v in link) for v in sorted(set().union(*links))}
    linkage = planar(SCGraph(len(links), joints), random)
    found = positions(linkage, drive={})
    assert (found.general, len(found.positions) + found.imaginary, found.evidence) == (*[in_the_plane] * 2, "proved")
    # solutions that are not real come in pairs of conjugates: of an even number an even number is real
    assert len(found.positions) % 2 == 0
    if len(links) == 5:
        assert len(positions_of(linkage, {}, random)) == in_the_plane
        assert number_of_positions(partial(plates_of, linkage, {}), random) == in_the_plane


@pytest.mark.parametrize("name", ["5 links", *(pytest.param(name, marks=slow) for name in list(TRUSSES)[1:])])
def test_trusses_by_elimination(name):
    links, *numbers = TRUSSES[name]
    random = np.random.default_rng(len(links))
    assert [number_of_positions(partial(random_plates, links, n, 1), random) for n in (2, 3)] == numbers


def test_prism_and_complete_bipartite_graph():
    """Bars have mirror images: solutions come in pairs, and an odd number, as 13 of the prism, is impossible."""
    found = positions(PRISM, drive={})
    assert (found.general, len(found.positions), found.imaginary, found.evidence) == (24, 4, 20, "proved")
    other = positions(BIPARTITE, drive={})
    assert (other.general, len(other.positions) + other.imaginary, other.evidence) == (16, 16, "proved")
    for answer in (found, other):
        assert len(answer.positions) % 2 == 0
    linkage = configuration_of(PRISM).linkage
    assert number_of_positions(partial(plates_of, linkage, {}), np.random.default_rng(1)) == 24


@slow
def test_the_complete_bipartite_graph_by_elimination():
    linkage = configuration_of(BIPARTITE).linkage
    assert number_of_positions(partial(plates_of, linkage, {}), np.random.default_rng(1)) == 16


@pytest.mark.parametrize(("graph", "path"), [(WATT, ()), (STEPHENSON, (4, 5, 6))], ids=["Watt", "Stephenson"])
def test_six_bars_by_elimination(graph, path):
    """With any joint driven: Stephenson's in the path of three has 6 in the plane and 8 on the sphere, others 4."""
    random = np.random.default_rng(6)
    for made, in_the_path in ((planar, 6), (spherical, 8)):
        linkage = made(graph, random)
        for driver in graph.joints:
            number = in_the_path if driver in path else 4
            assert number_of_positions(partial(plates_of, linkage, {driver: 0.2}), random) == number
            assert root_count(family_of(linkage, [driver])[0]) == number


@slow
def test_eight_bars_by_elimination():
    """All sixteen, planar and spherical, with each joint driven."""
    random, numbers = np.random.default_rng(8), set()
    for chain in chains(links=8, dof=1):
        graph = SCGraph(chain.nodes, list(chain.edges()))
        for made in (planar, spherical):
            linkage = made(graph, random)
            for driver in graph.joints:
                bound = root_count(family_of(with_own_joints(linkage, DOUBLE), [driver])[0])
                assert number_of_positions(partial(plates_of, linkage, {driver: 0.3}), random) == bound
                numbers.add((made is planar, bound))
    assert numbers == {(True, n) for n in (8, 12, 14, 16, 18)} | {(False, n) for n in (8, 16, 24, 32)}


def test_elimination_says_so_where_positions_are_not_isolated():
    """A parallelogram with a third bar along two sides moves; without it a four-bar has two positions."""
    square = {0: (0, 0), 1: (1, 0), 2: (1, 1), 3: (0, 1), 4: (0.5, 0), 5: (0.5, 1)}
    sides = [(0, 4, 1), (1, 2), (2, 5, 3), (3, 0), (4, 5)]

    def plates(prime):
        return [{v: tuple(residue(x, prime) for x in square[v]) for v in side} for side in sides]

    assert number_of_positions(plates, np.random.default_rng(2)) is None


@pytest.mark.parametrize("seed", range(5))
def test_the_prism_from_five_seeds(seed):
    family, _ = family_of(with_own_joints(configuration_of(PRISM).linkage, DOUBLE), [])
    assert len(general_positions(family, seed).values) == root_count(family) == 24


def test_shared_cases():
    if not CASES.exists():
        pytest.skip("the shared cases are not here")
    for name, count, real in (("prism_j", 24, 4), ("prism_half", 12, 2)):
        found = positions(CASES / "positions" / f"{name}.json", drive={})
        assert (found.general, len(found.positions), found.evidence) == (count, real, "proved")


@slow
def test_shared_rigid_head():
    if not CASES.exists():
        pytest.skip("the shared cases are not here")
    head = positions(CASES / "robots" / "rigid-head.json", drive={"A0": np.radians(10)})
    assert (len(head.positions), head.evidence) == (4, "numerical (trace test)")


def test_a_redundant_bar_of_a_rigid_square():
    """Six bars between four points, one too many: the square and its mirror image."""
    points = {"A": (0, 0), "B": (3, 0.2), "C": (2.6, 2), "D": (0.4, 1.7)}
    braced = bars(points, [tuple(edge) for edge in ("AB", "BC", "CD", "AD", "AC", "BD")])
    found = positions(braced, drive={})
    assert (len(found.positions), found.imaginary, len(found.redundant)) == (2, 0, 1)
    assert found.evidence == "numerical (trace test)"
    document = json.loads(json.dumps(found.to_json()))
    assert (document["exhaustive"], document["misfits"]) == ("numerical (trace test)", found.misfits)
    closure = configuration_of(braced).closure
    assert all(closure.error(mode.angles) < 1e-9 for mode in found.positions)
    assert "with an elbow in the redundant link" in str(found)


@slow
def test_a_redundant_bar_in_a_rigid_head_needs_no_input():
    """A four-bar, and on its coupler BC two points on six bars, one too many: two modes, each with two heads."""
    points = {"A": (0, 0), "B": (0, 1), "C": (3, 2), "D": (3, 0), "E": (0.5, 2.5), "F": (3, 3.2)}
    edges = ["AD", "AB", "BC", "CD", "BE", "EF", "FC", "EC", "BF"]
    head = bars(points, [tuple(edge) for edge in edges])
    crank = next(joint for joint, links in head.chain.joints.items() if set(links) == {"A-D", "A-B"})
    found = positions(head, drive={crank: np.radians(10)})
    assert (len(found.positions), found.evidence, len(found.redundant)) == (4, "numerical (trace test)", 1)


def test_a_bar_that_is_needed_gets_no_elbow():
    """Two inputs of a four-bar are one too many."""
    with pytest.raises(UnsolvableError, match=r"2 joints driven; expected .* M = 1 by count"):
        positions(planar(FOUR_BAR, np.random.default_rng(1)), drive={0: 0.1, 2: 0.1})


def check_chain(graph, driver, random, *, in_the_plane, by_homotopy=6):
    """From five seeds as many as the theorem says; no more and no fewer by elimination, in the plane by a homotopy."""
    linkage = planar(graph, random) if in_the_plane else spherical(graph, random)
    family, _ = family_of(with_own_joints(linkage, DOUBLE), [driver])
    bound = root_count(family)
    assert bound is not None
    assert {len(general_positions(family, seed).values) for seed in range(5)} == {bound}
    found = positions(linkage, drive={driver: 0.3}, circuits=False)
    assert (found.general, found.lost) == (bound, 0)
    eliminated = number_of_positions(partial(plates_of, linkage, {driver: 0.3}), random)
    assert eliminated == len(found.positions) + found.imaginary
    if in_the_plane and len(graph.nodes) <= by_homotopy:
        other = positions_of(linkage, {driver: 0.3}, random)
        real = int((np.abs(np.abs(other) - 1.0).max(axis=1) < 1e-6).sum())
        assert (len(other), real) == (len(found.positions) + found.imaginary, len(found.positions))
    assert found.evidence is not None
    return bound


def random_chains(links, cases, random):
    """Chains of one freedom, each with a joint that determines the others."""
    every = list(chains(links=links, dof=1))
    while cases:
        chain = every[int(random.integers(len(every)))]
        yield SCGraph(chain.nodes, list(chain.edges())), int(random.integers(len(list(chain.edges()))))
        cases -= 1


@pytest.mark.parametrize(("links", "in_the_plane"), [(6, True), (6, False), (8, False)])
def test_random_chains(links, in_the_plane):
    random = np.random.default_rng(links)
    for graph, driver in random_chains(links, 1, random):
        check_chain(graph, driver, random, in_the_plane=in_the_plane)


@slow
@pytest.mark.parametrize(("links", "cases"), [(6, 125), (8, 125)])
@pytest.mark.parametrize("in_the_plane", [True, False])
def test_five_hundred_random_chains(links, cases, in_the_plane):
    random = np.random.default_rng(100 + links)
    for graph, driver in random_chains(links, cases, random):
        check_chain(graph, driver, random, in_the_plane=in_the_plane)


FAMILIES = [
    pytest.param(lambda random: spherical(FOUR_BAR, random), 0, 2, id="four-bar"),
    pytest.param(lambda random: planar(WATT, random), 0, 4, id="planar Watt", marks=slow),
    pytest.param(lambda random: spherical(WATT, random), 0, 4, id="Watt", marks=slow),
    pytest.param(lambda random: planar(STEPHENSON, random), 5, 6, id="planar Stephenson", marks=slow),
    pytest.param(lambda random: spherical(STEPHENSON, random), 5, 8, id="Stephenson", marks=slow),
]


@pytest.mark.parametrize(("made", "driver", "number"), FAMILIES)
def test_a_trace_test_without_a_theorem(made, driver, number, monkeypatch):
    """Of all positions it passes; begun with one of them it finds the others, and does not pass before."""
    family, _ = family_of(made(np.random.default_rng(1)), [driver])
    monkeypatch.setattr(module, "root_count", lambda family: None)
    general = general_positions(family)
    assert (general.bound, general.complete, len(general.values)) == (None, False, number)
    one = module.GeneralPositions(general.parameters, general.values[:1], 1, None, False)
    alone = traced(family, one)
    assert (len(alone.values), alone.complete) == (number, True)
    section = module._Section(family, general.parameters, np.random.default_rng(3))
    points = section.moved(section.member, section.first, section.points_of(alone.values))
    while not section.trace_is_linear(points):
        points = section.round(points)
    assert not any(section.trace_is_linear(np.delete(points, k, axis=0)) for k in range(len(points)))


def test_an_answer_without_theorem_and_trace_says_at_least(monkeypatch):
    """Watt's chain with two of its four general positions: what is listed is at least that."""
    linkage = planar(WATT, np.random.default_rng(4))
    general = general_positions(family_of(linkage, [0])[0])
    some = module.GeneralPositions(general.parameters, general.values[:2], 3, None, False)
    monkeypatch.setattr("synth.analysis.assembly.modes.kept_positions", lambda family, seed, trace=False: some)
    found = positions(linkage, drive={0: 0.1}, circuits=False)
    assert (found.evidence, found.exhaustive, found.to_json()["exhaustive"]) == (None, False, None)
    assert str(found).lstrip().startswith("at least ")
    assert "there may be more" in str(found)


def test_certificates():
    """Solutions are proved, points beside them are not; a singular one is not."""
    linkage = spherical(STEPHENSON, np.random.default_rng(6))
    family, axes = family_of(linkage, [5])
    member = family.member(axes, np.array([0.2]))
    ends = solutions(family, general_positions(family), member)
    assert certified(family, member, ends.values).all()
    assert not certified(family, member, ends.values + 1e-4).any()
    # a dead point: the closure equations of a stretched four-bar depend on each other
    stretched = bars({"A": (0, 0), "B": (1, 0), "C": (3, 0), "D": (4, 0)}, [tuple(s) for s in ("AB", "BC", "CD", "AD")])
    flat, axes = family_of(configuration_of(stretched).linkage, ["A.0"])
    assert not certified(flat, flat.member(axes, np.zeros(1)), np.zeros((1, 3), dtype=complex)).any()


def test_paths_with_more_digits_end_where_others_do():
    family, axes = family_of(spherical(FOUR_BAR, np.random.default_rng(6)), [0])
    general = general_positions(family)
    member, bend = family.member(axes, np.array([0.2])), np.zeros(len(general.parameters), dtype=complex)
    curve = (general.parameters, member, bend + 0.3j)
    many = tuple(np.tile(each, (2, 1)) for each in curve)
    paths = family.followed(many, general.values)
    for start, end, arrived in zip(general.values, paths.values, paths.arrived, strict=True):
        value, state = followed(family, curve, start)
        assert (state, arrived) == (1, True)
        np.testing.assert_allclose(value, end, atol=1e-8)
