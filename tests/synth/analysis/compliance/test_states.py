"""Compliance states: freedoms of each set of active members, classes, the command."""

import json
from itertools import combinations
from math import cos, pi, radians, sin

import numpy as np
import pytest
from commands import run
from sizes import slow

import synth
from graphs.edit.edits import lock_joint
from graphs.errors import InvariantError, UnsolvableError
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from graphs.rank.exact import independent_cycles
from synth.analysis.compliance.members import (
    NONE,
    Members,
    SmallestSets,
    released,
    smallest_sets,
    state_of,
    states_of_sets,
)
from synth.analysis.motion.linkage import linkage_of_axes
from synth.analysis.moving._configuration_of import configuration_of
from synth.catalogue.patterns import generate


def random_about_a_point(seed, links=6, joints=8):
    """A connected multigraph without double joints, axes through the origin: its linkage and the axes."""
    random = np.random.default_rng(seed)
    pairs = [(k, int(random.integers(k))) for k in range(1, links)]
    rest = [pair for pair in combinations(range(links), 2) if pair not in pairs and pair[::-1] not in pairs]
    pairs += [rest[place] for place in random.permutation(len(rest))[: joints - len(pairs)]]
    graph = SCGraph(links, pairs)
    graph = SCGraph(links, pairs, [Loop(loop.joints) for loop in independent_cycles(graph)])
    axes = {joint: ((0.0, 0.0, 0.0), tuple(random.normal(size=3))) for joint in graph.joints}
    return linkage_of_axes(graph, axes), {joint: np.array(axis) for joint, (_, axis) in axes.items()}


def by_velocities(graph, axes, held):
    """Freedoms by what each link turns with: no loops. Links turn with w; across a joint w differs along its axis."""
    place = {link: 3 * number for number, link in enumerate(graph.nodes)}
    rows = []
    for joint, (a, b) in graph.joints.items():
        across = np.eye(3) if joint in held else np.linalg.svd(axes[joint][None])[2][1:]
        for normal in across:
            row = np.zeros(3 * len(place))
            row[place[b] : place[b] + 3] = normal
            row[place[a] : place[a] + 3] = -normal
            rows.append(row)
    return 3 * len(place) - np.linalg.matrix_rank(np.array(rows), tol=1e-9) - 3


@pytest.mark.parametrize("seed", [*range(2), *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(2, 40))])
def test_freedoms_of_every_set_are_those_of_trying(seed):
    linkage, axes = random_about_a_point(seed)
    compliant = Members(tuple(np.random.default_rng(seed).permutation(8)[:5].tolist()))
    for state in states_of_sets(linkage, compliant):
        held = set(compliant.joints) - set(state.active.joints)
        assert state.freedoms == by_velocities(linkage.graph, axes, held), held
        assert state.certainty != "not known"


@pytest.mark.parametrize("held", [(0,), (0, 3), (2, 5, 6)])
def test_the_linkage_that_is_left_is_that_with_locked_joints(held):
    linkage = configuration_of(generate("miura", rows=3, columns=3, fold=radians(50)).mechanism).linkage
    names = [list(linkage.graph.joints)[place] for place in held]
    left = released(linkage, Members(tuple(names)), NONE)
    graph = linkage.graph
    for joint in names:
        graph = lock_joint(graph, joint).graph
    assert set(left.graph.joints) == set(graph.joints)
    assert len(left.graph) == len(graph)


def test_links_that_give_way_are_not_there():
    """A Miura sheet of 3 x 3 without its middle panel is a ring of eight links, six equations: two freedoms."""
    linkage = configuration_of(generate("miura", rows=3, columns=3, fold=radians(50)).mechanism).linkage
    found = states_of_sets(linkage, Members((), (4,)))
    assert [(one.freedoms, one.kind) for one in found] == [(1, "rigid mobile"), (2, "compliant mobile")]


def test_parts_that_only_active_links_hold_are_free_bodies():
    ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
    axes = {k: ((cos(k), sin(k), 0.1 * k), (0.3 * k, 1.0, cos(k))) for k in range(4)}
    state = state_of(linkage_of_axes(ring, axes), Members((), (0, 2)), Members((), (0, 2)))
    assert state.freedoms == 6


def polygon(sides, stretched=False):
    """A ring of parallel axes at the corners of a polygon; or of a triangle with a corner on each of some sides."""
    ring = SCGraph(sides, [(k, (k + 1) % sides) for k in range(sides)], [Loop(range(sides), "infinite")])
    points = [(cos(2 * pi * k / sides), sin(2 * pi * k / sides), 0.0) for k in range(sides)]
    if stretched:
        points[1] = tuple((np.array(points[0]) + np.array(points[2])) / 2.0)
    return HingedSolids(ring, {k: (point, (0.0, 0.0, 1.0)) for k, point in enumerate(points)})


def test_the_three_classes():
    """Of rings in the plane: n joints that turn leave n - 3 freedoms."""
    four, six = polygon(4), polygon(6)
    assert synth.states(four, joints=[0]).classes == ("compliant mechanism",)
    both = synth.states(four, joints=[0, 1])
    assert both.classes == ("compliant mechanism", "compliant locking")
    assert [one.after.active.joints for one in both.transitions] == [(0, 1), (0,), (1,)]
    varied = synth.states(six, joints=[0, 1])
    assert varied.classes == ("variable mobility",)
    assert [one.freedoms for one in varied.sets] == [1, 2, 2, 3]
    assert synth.states(six, joints=[0, 1, 2, 3, 4]).classes == ("compliant mechanism", "compliant locking")


def test_a_limit_pose_moves_to_first_order_and_is_told_immobile():
    """Three joints of a triangle and one on its side, where two links are in line: rates close, nothing moves."""
    found = synth.states(polygon(4, stretched=True), joints=[0])
    assert [(one.freedoms, one.kind) for one in found.sets] == [(0, "rigid immobile"), (1, "compliant mobile")]


def test_members_are_active_where_springs_are_not_at_rest():
    springs = synth.analysis.compliance.Springs({0: 1.0, 2: 1.0}, {0: 0.1})
    found = synth.states(polygon(4), springs=springs)
    assert found.now.active == Members((0,))
    assert found.now.kind == "compliant immobile"


def test_what_is_refused():
    four = polygon(4)
    with pytest.raises(UnsolvableError, match="nothing is compliant"):
        synth.states(four)
    with pytest.raises(UnsolvableError, match="11 compliant members with links have too many sets"):
        synth.states(polygon(12), joints=range(10), links=[11])
    with pytest.raises(UnsolvableError, match="1001 compliant members are too many; expected 1000 at most"):
        synth.states(polygon(1002), joints=range(1001))
    with pytest.raises(InvariantError, match="'9' is no joint"):
        synth.states(four, joints=["9"])
    with pytest.raises(InvariantError, match="hangs on one other"):
        synth.states(HingedSolids(SCGraph(2, [(0, 1)]), {0: ((0, 0, 0), (0, 0, 1))}), links=[1])
    with pytest.raises(UnsolvableError, match="requires coordinates"):
        synth.states(synth.read("k1:Cr"), joints=[0])


def sheet(name, size, **values):
    return configuration_of(generate(name, rows=size, columns=size, **values).mechanism).linkage


@pytest.mark.parametrize(
    ("linkage", "members"),
    [
        (sheet("miura", 3), 6), (sheet("miura", 3, fold=radians(50)), 8), (sheet("waterbomb", 1), 6),
        (configuration_of(polygon(7)).linkage, 7), (configuration_of(polygon(4, stretched=True)).linkage, 4),
        (random_about_a_point(0, 6, 9)[0], 7),
        slow(sheet("miura", 4), 8), slow(sheet("map", 3), 8),
        *(slow(random_about_a_point(seed, 8, 12)[0], 8) for seed in range(4)),
    ],
)  # fmt: skip
def test_smallest_sets_are_those_among_all(linkage, members):
    joints = list(linkage.graph.joints)
    for seed in range(2):
        chosen = np.sort(np.random.default_rng(seed).permutation(len(joints))[:members])
        compliant = Members(tuple(joints[place] for place in chosen))
        every = {state.active.joints: state.freedoms for state in states_of_sets(linkage, compliant)}
        states, smallest = smallest_sets(linkage, compliant)
        assert all(every[state.active.joints] == state.freedoms for state in states)
        releasing = [names for names, freedoms in every.items() if freedoms > every[()]]
        size = min(map(len, releasing), default=None)
        if size is None:
            assert smallest == SmallestSets((), 1, complete=True)
            continue
        found = {state.active.joints for state in smallest.states}
        assert all(state.freedoms > every[()] for state in smallest.states)
        assert smallest.at_least <= size <= min(map(len, found))
        if smallest.complete:
            assert found == {names for names in releasing if len(names) == size}


def test_of_many_members_the_smallest_sets_are_found():
    """Of 40 axes through a point ranks of velocities say which sets of one, two, three release a motion."""
    linkage, axes = random_about_a_point(3, links=25, joints=40)
    compliant = Members(tuple(range(5, 40)))
    _, smallest = smallest_sets(linkage, compliant)
    rest = by_velocities(linkage.graph, axes, set(compliant.joints))
    for size in range(1, 4):
        releasing = {
            chosen
            for chosen in combinations(compliant.joints, size)
            if by_velocities(linkage.graph, axes, set(compliant.joints) - set(chosen)) > rest
        }
        if releasing:
            break
    assert smallest.complete
    assert smallest.at_least == size
    assert {state.active.joints for state in smallest.states} == releasing


@pytest.mark.slow
def test_a_hundred_members_of_a_ring():
    """Any four joints turn."""
    ring = synth.states(polygon(100), joints=range(100))
    assert ring.classes == ("compliant mechanism", "compliant locking")
    assert ring.smallest.at_least == 4
    assert {(len(state.active), state.freedoms) for state in ring.smallest.states} == {(4, 1)}
    assert "the smallest that release a motion have 4 members; there are at least 1024" in str(ring)
    assert (len(ring.sets[-1].active), ring.sets[-1].freedoms) == (100, 97)


def test_a_hundred_creases():
    """A folded Miura sheet moves with all its creases only, a flat one with those of a straight line."""
    folded = generate("miura", rows=8, columns=8, fold=radians(50)).mechanism
    creases = configuration_of(folded).joints
    moving = synth.states(folded, joints=creases)
    assert (moving.smallest.complete, moving.smallest.at_least) == (True, 112)
    assert [len(state.active) for state in moving.smallest.states] == [112]
    told = moving.to_json()["smallest"]
    assert (told["at_least"], told["complete"], len(told["sets"])) == (112, True, 1)
    flat = synth.states(generate("miura", rows=8, columns=8).mechanism, joints=creases)
    [line] = flat.smallest.states  # seven vertices on a straight line of eight creases
    graph = flat.configuration.linkage.graph
    place = {joint: number for number, joint in enumerate(graph.joints)}
    directions = flat.configuration.linkage.directions[[place[joint] for joint in line.active.joints]]
    assert np.abs(np.cross(directions, directions[0])).max() < 1e-9
    assert (len(directions), line.freedoms, flat.smallest.at_least) == (8, 1, 5)
    assert "one with 8 releases a motion, and none of fewer than 5 does" in str(flat)


def test_the_command(tmp_path):
    file = tmp_path / "four-bar.json"
    run("generate", "four-bar", "-o", file)
    told = json.loads(run("states", file, "--joint", "0", "--joint", "2", "--json").stdout)
    assert told["classes"] == ["compliant mechanism", "compliant locking"]
    assert told["state"] == {
        "active": {"joints": [], "links": []}, "freedoms": 0, "kind": "rigid immobile", "certainty": "proved",
    }  # fmt: skip
    assert [one["freedoms"] for one in told["sets"]] == [0, 0, 0, 1]
    assert told["elastic"] is None
    out = run("states", file, "--stiffness", "1=2", "--drive", "0=40", "--frames", "4", "--mass", "1=1@1,0,0").stdout
    assert "load path of joint 0" in out
    assert "small motions about the equilibrium" in out
    assert "expected one or more compliant joints or links" in run("states", file, code=2).stderr
    assert "'1=1' is not LINK=M@X,Y,Z" in run("states", file, "--stiffness", "1=2", "--mass", "1=1", code=2).stderr
    assert "joint 1 has -2.0; expected a number, 0 or more" in run("states", file, "--stiffness", "1=-2", code=2).stderr
