import networkx as nx
import pytest
from sizes import slow

from enumerate.addenda import AddendumJob, addenda, addendum_count_job
from enumerate.runner._run import run
from enumerate.runner.sinks import CountSink
from graphs.edit.edits import add_ride_along
from graphs.errors import InvariantError
from graphs.files.formats import read
from graphs.identity.chains import class_code
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.sc import SCGraph
from graphs.rank.exact import exact_mobility
from graphs.reduce.ride_alongs import reduce

FILES = ["watt", "stephenson", "six-bar-loop-spherical", "eight-bar", "hybrid-ten-bar", "stephenson-planar"]


def mechanism(data, name):
    return read(data / "wiener" / f"{name}.json")


@pytest.mark.parametrize("delta", [-2, slow(-1), slow(0), 1, slow(2)])
@pytest.mark.parametrize("name", FILES)
def test_every_addendum_changes_the_mobility_by_the_number(data, name, delta):
    base = mechanism(data, name)
    before = exact_mobility(base).mobility
    codes = []
    for one in addenda(base, delta):
        assert exact_mobility(one.edit.graph, seed=5).mobility == one.mobility == before + delta
        new = set(one.edit.graph.nodes) - set(base.nodes)
        assert len(new) == delta + (5 if one.kind == "spatial loop" else 2)
        assert one.edit.predicted == delta
        codes.append(class_code(one.edit.graph, new))
        assert len(one.edit.graph.centre_classes()) >= len(base.centre_classes())
    assert len(set(codes)) == len(codes)


@pytest.mark.parametrize("name", FILES)
def test_ride_alongs_are_those_on_joints_up_to_symmetry(data, name):
    base = mechanism(data, name)
    listed = {class_code(one.edit.graph, _new(one)) for one in addenda(base, 0) if one.kind == "ride-along"}
    joints = {tuple(ends) for ends in base.joints.values() if base.number_of_edges(*ends) == 1}
    expected = set()
    for a, b in joints:
        edit = add_ride_along(base, a, b)
        new = set(edit.graph.nodes) - set(base.nodes)
        if exact_mobility(edit.graph).mobility == exact_mobility(base).mobility:
            expected.add(class_code(edit.graph, new))
    assert listed == expected


def _new(one):
    return set(one.edit.graph.nodes) - set(one.edit.before.nodes)


def test_ride_alongs_and_dyads_are_taken_off_again(data):
    base = mechanism(data, "stephenson")
    for one in addenda(base, 0):
        if one.kind == "ride-along":
            reduced = reduce(one.edit.graph, keep=base.nodes).graph
            assert class_code(reduced) == class_code(base)
        if one.kind == "dyad":
            reduced = reduce(one.edit.graph, rule="dyad", keep=base.nodes).graph
            assert nx.is_isomorphic(nx.Graph(reduced), nx.Graph(base))


def test_pairs_are_orbits(data):
    """One pair of links of each orbit: against all automorphisms of the link-joint graph that keep the loops."""
    base = mechanism(data, "watt")
    loops = {frozenset(loop.joints) for loop in base.loops}
    joint = {frozenset(ends): j for j, ends in base.joints.items()}
    orbits = {frozenset((a, b)): frozenset((a, b)) for a in base for b in base if a < b}
    matcher = nx.isomorphism.GraphMatcher(nx.Graph(base), nx.Graph(base))
    for moved in matcher.isomorphisms_iter():
        image = {j: joint[frozenset(moved[x] for x in ends)] for j, ends in base.joints.items()}
        if {frozenset(image[j] for j in loop) for loop in loops} == loops:
            for pair, least in orbits.items():
                other = frozenset(moved[x] for x in pair)
                orbits[pair] = min(least, orbits[other], key=sorted)
    for pair in list(orbits):
        while orbits[orbits[pair]] != orbits[pair]:
            orbits[pair] = orbits[orbits[pair]]
    assert len(AddendumJob(base, 0).pairs()) == len(set(orbits.values()))


def test_ground_and_kind_of_centre_count():
    ring = [(0, 1), (1, 2), (2, 3), (3, 0)]
    free = SCGraph(4, ring, [Loop(range(4))])
    fixed = SCGraph(4, ring, [Loop(range(4))], ground=0)
    assert len(list(addenda(fixed, 0))) > len(list(addenda(free, 0)))
    planar = SCGraph(4, ring, [Loop(range(4), Centre.INFINITE)])
    dyads = [one for one in addenda(planar, 0) if one.kind == "dyad"]
    assert all(one.edit.graph.loops[-1].centre is Centre.INFINITE for one in dyads)


def test_counting_and_errors(data):
    base = mechanism(data, "watt")
    sink = CountSink()
    run(addendum_count_job(AddendumJob(base, 0)), sink)
    assert sink.total == len(list(addenda(base, 0)))
    with pytest.raises(InvariantError, match="-2 or more"):
        AddendumJob(base, -3)
    with pytest.raises(InvariantError, match="2 parts"):
        AddendumJob(SCGraph(4, [(0, 1), (2, 3)]), 0)
