"""What to lock, against trying all sets of joints."""

import json
import re
from itertools import combinations

import networkx as nx
import numpy as np
import pytest
from sizes import slow

from graphs.creasing.edits import lock_crease
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.rank.exact import independent_cycles
from graphs.rank.infinitesimal import infinitesimal_mobility
from synth.analysis.advice.advice import advise
from synth.analysis.advice.locks import general_configuration
from synth.analysis.moving._configuration_of import configuration_of
from synth.analysis.moving.motion import move
from synth.catalogue.patterns._generate import generate


def random_mechanism(seed, loops, joints):
    """Return links about a point, some of them flaps, and the closure columns of a basis of cycles of its own."""
    rng = np.random.default_rng(seed)
    links = joints - loops + 1
    tree = [(int(rng.integers(link)), link) for link in range(1, links)]
    pairs = tree + [tuple(map(int, rng.choice(links, 2, replace=False))) for _ in range(loops)]
    graph = SCGraph(links, pairs)
    spherical = graph.with_loops([Loop(loop.joints) for loop in independent_cycles(graph)])
    axes = rng.normal(size=(joints, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    columns = np.zeros((3 * loops, joints))
    climbing = nx.Graph(tree)
    place = {pair: joint for joint, pair in enumerate(tree)}
    for number, (start, end) in enumerate(pairs[links - 1 :]):
        columns[3 * number : 3 * number + 3, links - 1 + number] = axes[links - 1 + number]
        way = nx.shortest_path(climbing, end, start)
        for a, b in zip(way, way[1:], strict=False):
            joint = place.get((a, b), place.get((b, a)))
            columns[3 * number : 3 * number + 3, joint] = axes[joint] * (1 if (a, b) in place else -1)
    return HingedSolids(spherical, {joint: ((0, 0, 0), tuple(axes[joint])) for joint in range(joints)}), columns


def freedoms_without(columns, locked):
    """Freedoms left by a rank, of the closure columns of all other joints."""
    others = np.delete(columns, locked, axis=1)
    return others.shape[1] - np.linalg.matrix_rank(others, tol=1e-8)


def tried(columns, freedoms, allowed):
    """The smallest sets that leave so many freedoms, by trying all."""
    for size in range(len(allowed) + 1):
        sets = {locked for locked in combinations(allowed, size) if freedoms_without(columns, locked) == freedoms}
        if sets:
            return sets
    return set()


@pytest.mark.parametrize(("seed", "loops", "joints"), [(1, 2, 9), slow(3, 3, 12)])
def test_sets_are_the_smallest_and_all_of_them(seed, loops, joints):
    solids, columns = random_mechanism(seed, loops, joints)
    has = freedoms_without(columns, ())
    for wanted in range(max(0, has - 3), has):
        advice = advise(solids, wanted, limit=10_000)
        assert advice.freedoms == has
        assert not advice.more
        assert {lock.freedoms for lock in advice.locks} == {wanted}
        found = [lock.joints for lock in advice.locks]
        assert len(set(found)) == len(found)
        assert set(found) == tried(columns, wanted, range(joints))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(100, 140))
def test_sets_of_many_mechanisms_are_the_smallest(seed):
    rng = np.random.default_rng(seed)
    joints = int(rng.integers(6, 13))
    solids, columns = random_mechanism(seed, int(rng.integers(1, (joints - 1) // 3 + 1)), joints)
    has = freedoms_without(columns, ())
    for wanted in range(has):
        advice = advise(solids, wanted, limit=10_000)
        assert {lock.joints for lock in advice.locks} == tried(columns, wanted, range(joints))


@pytest.mark.parametrize("seed", [5, 7])
def test_the_cheapest_come_first_and_what_is_protected_stays(seed):
    solids, columns = random_mechanism(seed, 2, 10)
    weights = dict(enumerate(np.random.default_rng(seed).integers(0, 6, 10).tolist()))
    wanted = freedoms_without(columns, ()) - 2
    protected = [joint for joint in range(10) if joint != 3 and 0 not in solids.chain.joints[joint]][:2]
    allowed = [j for j in range(10) if j not in protected and 0 not in solids.chain.joints[j]]
    every = advise(solids, wanted, weights=weights, joints=protected, links=[0], limit=1000).locks
    expected = tried(columns, wanted, allowed)
    assert {lock.joints for lock in every} == expected
    assert [lock.weight for lock in every] == sorted(sum(weights[j] for j in joints) for joints in expected)
    few = advise(solids, wanted, weights=weights, joints=protected, links=[0], limit=3)
    assert (few.locks, few.more) == (every[:3], True)


@pytest.mark.parametrize(("name", "has"), [("waterbomb-base", 3), pytest.param("bird-base", 5, marks=pytest.mark.slow)])
def test_locked_creases_of_a_sheet_are_rigid_by_its_panels(name, has):
    """The sheet with the creases made flat: its mechanism is another, with fewer links."""
    sheet = generate(name).mechanism
    placed = general_configuration(configuration_of(sheet)).sheet
    assert infinitesimal_mobility(placed).dof == has
    for lock in advise(sheet, has - 2, limit=4).locks:
        held = placed
        for joint in lock.joints:
            held = lock_crease(held, joint).sheet
        assert infinitesimal_mobility(held).dof == has - 2 == lock.freedoms


def test_creases_left_out_may_leave_what_locked_ones_do_not():
    """A vertex of six creases, pairs of them in line: locked, any three hold all; of those left two may be in line."""
    at = [(0, 0), (1, 0), (0.5, 0.9), (-0.5, 0.9), (-1, 0), (-0.5, -0.9), (0.5, -0.9)]
    faces = tuple((0, 1 + k, 1 + (k + 1) % 6) for k in range(6))
    sheet = Sheet(7, tuple((0, k) for k in range(1, 7)), "MVVMVV", faces, tuple(at))
    locks = advise(sheet, 0, leave_out=True).locks
    assert len(locks) == 20
    for lock in locks:
        folds = set(range(6)) - set(lock.joints)
        assert (lock.freedoms, lock.left_out) == (0, int(any(k + 3 in folds for k in folds)))


def test_what_is_folded_is_locked_where_it_is():
    with pytest.raises(UnsolvableError, match="creases are left out of flat sheets"):
        advise(flapped(), 2, leave_out=True)


def test_a_pop_up_stops_with_any_of_its_creases():
    advice = advise(generate("box-pop-up").mechanism, 0)
    creases = {lock.joints[0] for lock in advice.locks}
    assert (advice.freedoms, len(creases), advice.more) == (1, 4, False)
    assert all(set(lock.immobile) == creases - set(lock.joints) for lock in advice.locks)


def flapped():
    """A folded vertex of five creases, and a flap on the first of its panels."""
    corners = ((0, 0, 0), (1, 0, 0.1), (0.2, 1, 0.3), (-1, 0.4, 0), (-0.6, -1, 0.4), (0.5, -0.9, 0), (1, 1, 0.7))
    faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5), (0, 5, 1), (2, 1, 6))
    edges = (*((0, k) for k in range(1, 6)), (1, 2))
    return Sheet(7, edges, "UUUUUU", faces, corners)


def test_flaps_are_told_apart():
    advice = advise(flapped(), 2)
    assert (advice.freedoms, advice.flaps) == (3, (5,))
    assert [lock.flaps for lock in advice.locks] == [()] * 5 + [(5,)]
    assert len(advise(flapped(), 2, flaps=False).locks) == 5


def test_what_is_protected_may_leave_too_little():
    with pytest.raises(
        UnsolvableError, match=r"at least 1 of 3 degrees of freedom remain: .* removes 2, and 3 are to be removed"
    ):
        advise(flapped(), 0, flaps=False)
    with pytest.raises(UnsolvableError, match=r"at least 3 of 3 degrees of freedom remain: .* removes 0, and 1 are"):
        advise(flapped(), 2, links=range(6))


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        ({"joints": [9]}, "9 is no joint"),
        ({"links": [8]}, "8 is no link"),
        ({"weights": {0: -1.0}}, "the weight of joint 0 is -1"),
        ({"limit": 0}, "limit: 0"),
    ],
)
def test_what_is_not_there_is_refused(asked, told):
    with pytest.raises(InvariantError, match=told):
        advise(flapped(), 1, **asked)


def test_as_many_as_there_are_need_nothing(data):
    assert "nothing to change" in str(advise(flapped(), 3))
    assert "0 degrees of freedom at this configuration; required: 0" in str(
        advise(read(data / "linkages" / "wampler-cube-locked.json"), 0)
    )


def same(table, entry, one):
    """Whether an entry of a table is what one call advises."""
    locks = [[one.configuration.joints.index(joint) for joint in lock.joints] for lock in one.locks]
    many = len(locks)
    assert table.freedoms[entry] == one.freedoms
    assert [[place for place in row if place >= 0] for row in table.locks[entry, :many].tolist()] == locks
    assert (table.locks[entry, many:] == -1).all()
    np.testing.assert_array_equal(table.weight[entry, :many], [lock.weight for lock in one.locks])
    np.testing.assert_array_equal(table.play[entry, :many], [lock.play for lock in one.locks])
    assert table.left[entry, :many].tolist() == [lock.freedoms for lock in one.locks]
    assert (table.more[entry], table.branch[entry]) == (one.more, -1 if one.branch is None else one.branch)


def test_advice_for_many_weights_is_that_for_each(data):
    sheet = read(data / "patterns" / "bird-base.fold")
    first, second = configuration_of(sheet).joints[:2]
    weights = {first: np.array([1.0, 0.0, 7.0]), second: 3.0}
    table = advise(sheet, 2, weights=weights, limit=3)
    for entry, cost in enumerate(weights[first].tolist()):
        same(table, entry, advise(sheet, 2, weights={first: cost, second: 3.0}, limit=3))
    assert len(table) == 3
    assert json.loads(json.dumps(table.to_json()))["weight"] == table.weight.tolist()
    assert "3 entries; required: 2" in str(table)


@pytest.mark.parametrize("name", ["five-bar", "waterbomb-base"])
def test_advice_at_many_configurations_is_that_at_each(name):
    mechanism = generate(name).mechanism
    at = configuration_of(mechanism)
    way = at.branches.branches[0].rates
    path = move(
        at, drive={at.joints[int(np.abs(way).argmax())]: at.linkage.angles[np.abs(way).argmax()] + 0.4}, frames=3
    )
    angles = np.vstack([path.path.angles[1:], np.full((1, len(at.joints)), 0.3), np.full((1, len(at.joints)), np.nan)])
    table = advise(mechanism, 0, at=angles, limit=2)
    for entry, one in enumerate(angles[:3]):
        same(table, entry, advise(at.at(one), 0, limit=2))
    assert table.why.keys() == {3, 4}
    assert table.why[4] == "no configuration: joint angles are no numbers"
    assert table.freedoms[3:].tolist() == [-1, -1]


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"weights": {0: [1.0, 2.0], 1: [1.0]}}, "arrays of shapes (1,), (2,)"),
        ({"at": np.zeros((2, 3))}, "an array of shape (2, 3); expected float[N, 5]"),
        ({"weights": {0: [1.0, -2.0]}}, "the weight of joint 0 is -2"),
        ({"weights": {0: [1.0]}, "leave_out": True}, "joints to lock only"),
    ],
)
def test_arrays_that_do_not_fit_are_refused(options, told):
    with pytest.raises(InvariantError, match=re.escape(told)):
        advise(generate("five-bar").mechanism, 1, **options)
