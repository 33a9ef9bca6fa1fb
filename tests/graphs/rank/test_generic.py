import csv
import random
from itertools import combinations

import networkx as nx
import numpy as np
import pytest
from oracle import numeric_mobility
from rigidity import chains_by_geng
from sizes import slow
from strategies import random_sc

from graphs.convert.conversions import to_sc
from graphs.convert.link_joint import sc_from_link_joint_graph
from graphs.count.equations import loop_form
from graphs.count.report import mobility_report
from graphs.errors import SynthedraError, UnsolvableError
from graphs.files.formats import read
from graphs.loops.loop import Loop, signed_cycle
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.rank import exact
from graphs.rank.dissection import KernelsModulo, rank_modulo, sparse_modulo
from graphs.rank.exact import (
    Closure,
    closure_modulo,
    diagnose,
    exact_mobility,
    independent_cycles,
    matrix_modulo,
    mobility_without,
)
from graphs.rank.realisation import (
    PRIMES,
    Incidence,
    PrimeField,
    Reals,
    incidence_of,
    null_vectors,
    realise,
    realise_points,
)


def count(sc):
    return loop_form(len(sc.joints), len(sc.centred_loops), sc.spatial_loops)


def miura(rows, columns):
    """An m x n mesh of quadrilaterals as an SC graph: its inner vertices are centres."""
    number = {(i, j): i * columns + j for i in range(rows) for j in range(columns)}
    joints = {("h", i, j): (number[i, j], number[i, j + 1]) for i in range(rows) for j in range(columns - 1)}
    joints |= {("v", i, j): (number[i, j], number[i + 1, j]) for i in range(rows - 1) for j in range(columns)}
    loops = [
        Loop((("h", i, j), ("v", i, j + 1), ("h", i + 1, j), ("v", i, j)))
        for i in range(rows - 1)
        for j in range(columns - 1)
    ]
    return SCGraph(rows * columns, joints, loops)


EXCEPTIONS = {
    # Where the count is negative or a part of the mechanism is overconstrained.
    "mesh-4x4-edge-creases.json": (1, 2),
    "miura-3x4.fold": (-1, 0),
    "miura-4x4.fold": (-3, 0),
    "miura-5x5.fold": (-8, 0),
}


def test_all_mechanisms_of_the_papers(mechanisms):
    found = 0
    for file in mechanisms:
        mechanism = read(file)
        if isinstance(mechanism, Sheet):
            mechanism = to_sc(mechanism)
        if isinstance(mechanism, SCGraph):
            report = mobility_report(mechanism)
            pair = report.mobility, exact_mobility(mechanism).mobility
            assert pair == EXCEPTIONS.get(file.name, (report.mobility, report.mobility)), file
            found += 1
    assert found > 50


@pytest.mark.parametrize("seed", range(150))
def test_agrees_with_floating_point(seed):
    sc = random_sc(random.Random(seed))
    numeric = numeric_mobility(sc, seed=3)
    if numeric is not None:
        assert exact_mobility(sc).mobility == numeric


def test_random_members_do_not_matter():
    mesh = miura(5, 4)
    assert {exact_mobility(mesh, seed=seed).mobility for seed in range(5)} == {0}
    assert exact_mobility(mesh, [101]).mobility >= 0


@pytest.mark.parametrize("size", [(2, 2), (2, 7), (3, 3), (3, 4), (4, 4), (6, 5)])
def test_meshes(size):
    rows, columns = size
    mesh = miura(*size)
    assert exact_mobility(mesh).mobility == max(count(mesh), 0)
    assert count(mesh) == 1 - (rows - 2) * (columns - 2)


@pytest.mark.parametrize(
    ("links", "dof"), [(4, 1), (6, 1), (8, 1), (5, 2), (7, 2), (9, 2), (6, 3), (8, 3), slow(10, 1, id="10")]
)
def test_count_is_rank_on_chains_without_rigid_parts(links, dof):
    """Conjecture 2 of Wampler: one embedding of each planar chain, every joint moves."""
    for graph in chains_by_geng(links, dof):
        if nx.check_planarity(graph)[0]:
            sc = sc_from_link_joint_graph(graph)
            found = diagnose(sc)
            assert found.mobility == dof == count(sc)
            assert found.idle == 0
            assert found.immobile == ()


def test_three_centres_in_line():
    """Three loops that share a joint: their centres lie on its axis."""
    links = ["a", "b", *(f"{k}{i}" for k in range(3) for i in range(2))]
    joints = {"axis": ("a", "b")}
    loops = []
    for k in range(3):
        joints |= {f"a{k}": ("a", f"{k}0"), f"m{k}": (f"{k}0", f"{k}1"), f"b{k}": (f"{k}1", "b")}
        loops.append(Loop(("axis", f"a{k}", f"m{k}", f"b{k}")))
    sc = SCGraph(links, joints, loops)
    assert len(sc.centre_classes()) == 3
    placed = realise(sc, PrimeField(PRIMES[0]))
    p = np.array(placed.points, dtype=object)
    assert len(null_vectors(p.T.tolist(), PrimeField(PRIMES[0]))) == 1
    assert exact_mobility(sc).mobility == 1 == count(sc)


def test_points_that_cannot_be_placed():
    """Seven points and seven lines of three points, each pair of points on one: no such figure in space."""
    fano = [(0, 1, 2), (0, 3, 4), (0, 5, 6), (1, 3, 5), (1, 4, 6), (2, 3, 6), (2, 4, 5)]
    points = tuple((frozenset(k for k, line in zip(range(7), fano, strict=True) if p in line), False) for p in range(7))
    for field in (PrimeField(PRIMES[0]), Reals()):
        with pytest.raises(UnsolvableError, match="not realised"):
            realise_points(Incidence(tuple(range(7)), points), field)


@pytest.mark.parametrize("seed", range(60))
def test_placed_axes_pass_through_their_centres(seed):
    sc = random_sc(random.Random(seed))
    field = PrimeField(PRIMES[0])
    incidence = incidence_of(sc)
    placed = realise(sc, field)
    for (joints, infinite), point in zip(incidence.points, placed.points, strict=True):
        assert (point[3] == 0) == infinite
        for joint in joints:
            u, m = placed.axes[joint]
            x, w = point[:3], point[3]
            cross = [x[i] * u[j] - x[j] * u[i] - w * m[k] for i, j, k in ((1, 2, 0), (2, 0, 1), (0, 1, 2))]
            assert [value % field.prime for value in cross] == [0, 0, 0]


def test_spatial_loops_are_completed():
    cycles = independent_cycles(SCGraph(5, [(a, b) for a, b in combinations(range(5), 2)]))
    assert len(cycles) == 6
    sc = SCGraph(7, [(i, (i + 1) % 7) for i in range(7)])
    assert exact_mobility(sc).mobility == 1
    assert list(signed_cycle((0, 1, 2), {0: (0, 1), 1: (2, 1), 2: (2, 0)})) == [(0, 1), (1, -1), (2, 1)]


@pytest.mark.parametrize("rows", [8, pytest.param(12, marks=pytest.mark.slow)])
def test_larger_meshes(rows):
    for columns in range(2, rows + 1):
        assert exact_mobility(miura(rows, columns)).mobility == max(0, 1 - (rows - 2) * (columns - 2))


def test_concentric_loops_and_parts_apart(data):
    rings = read(data / "wiener" / "concentric-loops.json")
    assert exact_mobility(rings).mobility == mobility_report(rings).mobility
    two = SCGraph(8, [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4)],
                  [Loop((0, 1, 2, 3)), Loop((4, 5, 6, 7))])  # fmt: skip
    assert exact_mobility(two).mobility == 2
    found = diagnose(two)
    assert (found.mobility, found.clusters, found.immobile) == (2, (), ())


def test_panels_that_share_two_creases():
    """Two hinges between two panels are rigid, unless the loop they are has a centre: then they fold flat only."""
    pair = SCGraph(2, {0: (0, 1), 1: (0, 1)})
    assert exact_mobility(pair).mobility == 0
    about_a_point = SCGraph(2, {0: (0, 1), 1: (0, 1)}, [Loop((0, 1))])
    assert exact_mobility(about_a_point).mobility == 0
    assert count(about_a_point) == -1


def test_planar_loops():
    ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3), "infinite")])
    assert exact_mobility(ring).mobility == 1
    found = diagnose(ring)
    assert (found.idle, found.immobile) == (0, ())


def test_single_links_and_open_chains():
    assert exact_mobility(SCGraph(1)).mobility == 0
    assert exact_mobility(SCGraph(0)).mobility == 0
    assert exact_mobility(SCGraph(3, [(0, 1), (1, 2)])).mobility == 2
    assert exact_mobility(SCGraph(8, [(i, i ^ 1) for i in range(0, 8, 2)])).mobility == 4
    found = diagnose(SCGraph(3, [(0, 1)]))
    assert (found.mobility, found.idle, found.immobile, found.clusters) == (1, 0, (), ())


def test_where_a_mesh_is_overconstrained():
    found = diagnose(miura(4, 4))
    assert (found.mobility, found.idle, len(found.immobile)) == (0, 3, 24)
    assert found.clusters == (tuple(range(16)),)
    assert all(len(circuit) <= 9 for circuit in found.circuits)
    strip = diagnose(miura(2, 6))
    assert (strip.mobility, strip.idle, strip.regions) == (1, 0, ())


def test_overconstraint_stays_in_its_place(data):
    """A rigid three by three block with a four-bar hung on: the four-bar's joints are in no circuit."""
    block = miura(4, 4)
    joints = {**block.joints, "p": (0, 16), "q": (16, 17), "r": (17, 18), "s": (18, 1)}
    sc = SCGraph(19, joints, [*block.loops, Loop(("p", "q", "r", "s", ("h", 0, 0)))])
    found = diagnose(sc)
    assert found.mobility == 1
    assert set("pqrs").isdisjoint(set().union(*found.regions))
    assert set(found.immobile) == set(block.joints)
    assert tuple(range(16)) in found.clusters
    assert mobility_without(sc, "p") > found.mobility


@pytest.mark.parametrize("name", ["watt.json", "stephenson.json", "eight-bar.json"])
def test_cutting_a_joint(data, name):
    mechanism = read(data / "wiener" / name)
    whole = exact_mobility(mechanism).mobility
    assert all(mobility_without(mechanism, joint) >= whole for joint in mechanism.joints)


@pytest.mark.parametrize(("most", "least"), [(12, 25), slow(1000, 50)])
def test_crease_patterns_have_an_exact_mobility(fold_folder, most, least):
    """Exact is at least the count, and equal where no part is overconstrained."""
    checked = 0
    with (fold_folder / "INDEX.tsv").open(encoding="utf-8") as stream:
        for row in csv.DictReader(stream, delimiter="\t"):
            if not (row["N_panels(F merged)"] or "").isdigit() or int(row["N_panels(F merged)"]) > most:
                continue
            try:
                sc = to_sc(read(fold_folder / row["name"]))
            except SynthedraError:  # files that are refused are another test's affair
                continue
            exact = exact_mobility(sc).mobility
            assert exact >= max(mobility_report(sc).mobility or 0, 0)
            checked += 1
    assert checked > least


def random_rows(seed):
    """Bands, blocks that share nothing, and anything; some rows are empty, or sums of others."""
    rng = random.Random(seed)
    prime, columns = PRIMES[seed % 2], rng.randrange(60, 400)
    rows = []
    for number in range(rng.randrange(300, 600)):
        near = rng.randrange(columns) if seed % 4 == 0 else number * columns // 600
        reach = 6 if seed % 4 < 2 else 20
        places = {(near // reach * reach if seed % 4 == 3 else near) + rng.randrange(reach) for _ in range(4)}
        rows.append({place % columns: rng.randrange(1, prime) for place in places if number % 17})
        if number % 5 == 4:
            pair = [rows[rng.randrange(len(rows))], rows[-1]]
            total = {c: sum(row.get(c, 0) for row in pair) % prime for row in pair for c in row}
            rows.append({c: value for c, value in total.items() if value})
    return rows, columns, prime


@pytest.mark.parametrize("seed", range(8))
def test_matrices_that_are_taken_apart_have_the_rank_of_the_whole(seed):
    rows, columns, prime = random_rows(seed)
    whole = int(sparse_modulo(rows, columns, prime).rank())
    assert rank_modulo(rows, columns, prime) == whole
    random.Random(seed).shuffle(rows)
    assert rank_modulo(rows, columns, prime) == whole < len(rows)


@pytest.mark.parametrize("seed", [0, 1, 3, slow(2), slow(4), slow(5), slow(6), slow(7)])
def test_matrices_that_are_taken_apart_have_the_kernels_of_the_whole(seed):
    rows, columns, prime = random_rows(seed)
    kernels = KernelsModulo(rows, columns, prime)
    whole = sparse_modulo(rows, columns, prime)
    kernel, freedoms = whole.nullspace()
    assert kernels.rank == columns - freedoms
    values = kernels.general_solution()
    assert all(sum(value * values[column] for column, value in row.items()) % prime == 0 for row in rows)
    assert [value == 0 for value in values] == [
        not any(int(kernel[j, k]) for k in range(freedoms)) for j in range(columns)
    ]
    # As many sets as rows too many, each with a row that none after it has: they are independent, so they are all.
    first: set[int] = set()
    assert len(kernels.circuits) == len(rows) - kernels.rank
    for circuit in kernels.circuits:
        assert first.isdisjoint(circuit)
        first.add(circuit[0])
        part = sparse_modulo([rows[row] for row in circuit], columns, prime).transpose()
        stress, one = part.nullspace()
        assert one == 1
        assert all(int(stress[line, 0]) for line in range(len(circuit)))


def test_a_large_sheet_is_ranked_in_parts():
    closure = closure_modulo(miura(22, 21), PRIMES[1])
    assert len(closure.rows) > 1000
    assert rank_modulo(closure.rows, len(closure.joints), PRIMES[1]) == matrix_modulo(closure, PRIMES[1]).rank()


def blocks_in_a_ring(size, around):
    """Square meshes with two panels of each hinged to the next ones in a ring: each mesh is overconstrained alone."""
    links, joints, loops = 0, {}, []
    for k in range(around):
        mesh = miura(size, size)
        joints |= {(k, joint): (a + links, b + links) for joint, (a, b) in mesh.joints.items()}
        loops += [Loop(tuple((k, joint) for joint in loop.joints)) for loop in mesh.loops]
        joints[k, "next"] = links + size * size - 1, (links + size * size) % (around * size * size)
        links += size * size
    return SCGraph(links, joints, loops)


@pytest.mark.parametrize(("size", "around"), [(4, 9), slow(7, 9), slow(12, 8)])
def test_diagnoses_by_parts_are_those_of_the_whole(size, around, monkeypatch):
    mechanisms = [blocks_in_a_ring(size, around), miura(2, 60), *(random_sc(random.Random(seed)) for seed in range(40))]
    found = []
    for most in (0, 10**6):
        monkeypatch.setattr(exact, "_MOST_WHOLE", most)
        diagnoses = [diagnose(sc) for sc in mechanisms]
        found.append([(d.mobility, d.idle, d.immobile, d.clusters, set(d.regions)) for d in diagnoses])
        assert len(diagnoses[0].regions) == around
    assert found[0] == found[1]


@pytest.mark.parametrize("size", [30, slow(70)])
def test_a_large_mesh_is_rigid_and_overconstrained_as_counted(size):
    """By count M = 1 - (n - 2)^2, and nothing moves: all but one of these equations are redundant."""
    found = diagnose(miura(size, size))
    joints = 2 * size * (size - 1)
    assert (found.mobility, found.idle, len(found.immobile)) == (0, (size - 2) ** 2 - 1, joints)
    assert found.clusters == (tuple(range(size * size)),)
    assert len(found.regions) == 1


def test_circuits_are_smallest_dependent_sets():
    closure = closure_modulo(miura(5, 4), PRIMES[0])
    matrix = matrix_modulo(closure, PRIMES[0])
    stresses, idle = matrix.transpose().nullspace()
    assert idle == 5
    for k in range(idle):
        support = [i for i in range(len(closure.rows)) if int(stresses[i, k])]
        for left_out in (None, support[0], support[-1]):
            rows = [closure.rows[i] for i in support if i != left_out]
            part = matrix_modulo(Closure(closure.joints, tuple(rows), ()), PRIMES[0])
            assert part.rank() == len(support) - 1
