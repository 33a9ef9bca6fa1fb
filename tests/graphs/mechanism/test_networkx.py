"""Whatever networkx makes of a mechanism is that mechanism, a plain graph that says what it is, or an error."""

import copy
import json
import pickle
from contextlib import redirect_stdout
from io import StringIO

import networkx as nx
import pytest
from networkx_functions import graphs_made

import synth
from graphs.convert.conversions import mechanism_of_graph
from graphs.errors import InvariantError, SynthedraError
from graphs.files.native import dumps
from graphs.loops.loop import Loop
from graphs.mechanism.attributes import LoopPlace
from graphs.mechanism.polyhedron import PointConstraint, PolyhedronModel, RemoteCentre
from graphs.mechanism.sc import SCGraph, SpecialGeometry
from graphs.mechanism.scd import SCDGraph
from synth.making.drawing.scene.writing import svg_text

WATT = [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)]
LOOPS = [Loop((0, 1, 2, 3)), Loop((3, 4, 5, 6))]
OUTER = Loop((0, 1, 2, 4, 5, 6))

TYPES = {
    "watt": SCGraph(6, WATT, LOOPS),
    "grounded": SCGraph(6, WATT, LOOPS, ground=3),
    "planar": SCGraph(6, WATT, [Loop(loop.joints, "infinite") for loop in LOOPS]),
    "one centre": SCGraph(6, WATT, [Loop(loop.joints, at="O") for loop in LOOPS]),
    "named loops": SCGraph(6, WATT, [Loop(loop.joints, name=name) for loop, name in zip(LOOPS, "ab", strict=True)]),
    "closed": SCGraph(6, WATT, LOOPS, closing=[OUTER]),
    "one spatial": SCGraph(6, WATT, LOOPS[:1]),
    "all spatial": SCGraph(6, WATT, []),
    "names": SCGraph(6, WATT, LOOPS).relabel({0: "frame", 3: "a b"}, {2: "hinge"}),
    "parallel joints": SCGraph(3, {"a": (0, 1), "b": (1, 0), "c": (1, 2)}, [Loop(("a", "b"))]),
    "tree": SCGraph(3, [(0, 1), (1, 2)]),
    "two parts": SCGraph(8, [*WATT[:4], (4, 5), (5, 6), (6, 7), (7, 4)], [Loop((0, 1, 2, 3)), Loop((4, 5, 6, 7))]),
    "marked": SCGraph(4, [*WATT[:3], (3, 0)], [], special=SpecialGeometry(1, ["Bennett"])),
    "assumed": mechanism_of_graph(nx.ladder_graph(4)),
    "turned": SCGraph([2, 1, 0], {"x": (2, 0), "y": (0, 1), "z": (1, 2)}, [Loop(("z", "y", "x"))]),
}
FILES = """
wiener/fortune-teller wiener/stephenson wiener/concentric-loops wiener/hybrid-ten-bar wiener/remote-5-bar
wiener/table3-row3 wiener/chain-RSR wiener/held-ride-along wampler/fig12-scd
"""


@pytest.fixture(scope="module", params=[*TYPES, *FILES.split()])
def mechanism(request):
    name = request.param
    return TYPES[name] if name in TYPES else synth.read(f"data/{name}.json")


def answers(mechanism):
    """What is said of a mechanism, but for the names of its links."""
    report = synth.mobility(mechanism, motion=False)
    identity = synth.identify(mechanism)
    return (
        report.to_json(),
        (identity.chain, identity.drawing),
        [(len(step.removed), step.joints) for step in synth.reduce(mechanism).steps],
        svg_text(synth.draw(mechanism, numbers=False, caption=False)),
    )


def test_every_function_of_networkx_gives_one_of_three_things(mechanism):
    """The mechanism itself, a plain graph of networkx with the attributes that it copied, or an error of ours."""
    with redirect_stdout(StringIO()):
        made = list(graphs_made(mechanism))
    assert len(made) >= 25, [name for name, _ in made]
    same = set()
    for name, graph in made:
        if isinstance(graph, SCGraph):
            assert graph is mechanism, name
        assert len({type(graph)} & {nx.Graph, nx.MultiGraph, nx.DiGraph, nx.MultiDiGraph, nx.PlanarEmbedding}) or (
            graph is mechanism
        )
        try:
            read = mechanism_of_graph(graph)
        except SynthedraError as error:
            assert "\n" not in str(error), name
            continue
        assert len(read.joints) == read.number_of_edges() <= graph.number_of_edges(), name
        if not read.centres_assumed and read.is_identical(mechanism):
            same.add(name)
            assert list(read.joints.items()) == list(mechanism.joints.items())
            assert dumps(read) == dumps(mechanism)
    assert mechanism.centres_assumed or same >= {"freeze", "to_undirected", "to_directed", "subgraph_view", "compose"}


def test_renamed_links_are_the_same_mechanism_everywhere(mechanism):
    there = {link: f"({place})" for place, link in enumerate(mechanism)}
    graph = nx.relabel_nodes(mechanism, there)
    assert type(graph) is nx.MultiGraph
    renamed = mechanism.relabel(there)
    assert mechanism_of_graph(graph).is_identical(renamed)
    assert answers(graph) == answers(renamed)
    assert answers(mechanism.copy()) == answers(mechanism)


@pytest.mark.parametrize(
    "copied",
    [copy.copy, copy.deepcopy, lambda g: pickle.loads(pickle.dumps(g)), nx.freeze],
    ids=["copy", "deepcopy", "pickle", "freeze"],
)
def test_copies_of_the_object_are_mechanisms(copied, mechanism):
    back = copied(mechanism)
    assert type(back) is type(mechanism)
    assert nx.is_frozen(back)
    assert back.is_identical(mechanism)
    assert dumps(back) == dumps(mechanism)


@pytest.mark.parametrize(
    "made",
    [
        lambda g: g.copy(),
        lambda g: g.copy(as_view=True),
        lambda g: g.to_undirected(),
        lambda g: g.to_undirected(as_view=True),
        lambda g: g.to_directed(),
        nx.MultiGraph,
        nx.subgraph_view,
        lambda g: g.edge_subgraph(g.edges(keys=True)) if all(d for _, d in g.degree) else g.copy(),
        lambda g: nx.node_link_graph(json.loads(json.dumps(nx.node_link_data(g)))),
    ],
)
def test_plain_graphs_are_read_back(made, mechanism):
    graph = made(mechanism)
    assert not isinstance(graph, SCGraph)
    read = mechanism_of_graph(graph)
    assert type(read) is type(mechanism)
    assert read.is_identical(mechanism)


def test_two_mechanisms_in_one_graph_are_both():
    two = SCGraph(nx.disjoint_union(TYPES["one centre"], TYPES["one centre"]))
    assert (len(two), len(two.joints), len(two.loops), len(two.centre_classes())) == (12, 14, 4, 2)
    other = SCGraph(nx.disjoint_union(TYPES["watt"], TYPES["planar"]))
    assert [loop.centre.value for loop in other.loops].count("infinite") == 2
    with pytest.raises(InvariantError, match=r"links 3 and 9 are both the ground link"):
        SCGraph(nx.disjoint_union(TYPES["grounded"], TYPES["grounded"]))


@pytest.mark.parametrize(
    "verb",
    [
        synth.mobility,
        synth.reduce,
        synth.identify,
        synth.look,
        synth.draw,
        synth.convert,
        lambda g: synth.edit(g, lock=[0]),
    ],
)
def test_a_part_that_cuts_a_loop_is_refused(verb):
    watt = TYPES["watt"]
    for part in (watt.subgraph([0, 1, 2]), nx.restricted_view(watt, [], [(0, 1, 0)]), nx.contracted_nodes(watt, 0, 1)):
        with pytest.raises(InvariantError, match=r"loop 0 has|to itself"):
            verb(part)


def test_a_part_that_cuts_no_loop_is_a_mechanism():
    watt = TYPES["marked"]
    part = watt.subgraph([0, 1, 2])
    assert SCGraph(part).special is None
    whole = SCGraph(nx.union(TYPES["watt"], nx.MultiGraph(SCGraph(["x", "y"], [("x", "y")]))))
    assert len(SCGraph(whole.subgraph(range(6))).loops) == 2
    assert len(SCGraph(whole.subgraph(["x", "y"])).loops) == 0


def test_a_graph_written_by_hand_is_a_mechanism():
    graph = nx.MultiGraph()
    graph.add_edge("base", "a", loops=[("A", 0)])
    graph.add_edge("a", "b", loops=[("A", 1)])
    graph.add_edge("b", "base", loops=[("A", 2, 3, "infinite")])
    with pytest.raises(InvariantError, match=r"loop 'A' has 1 of its 3 joints"):
        SCGraph(graph)
    graph.edges["b", "base", 0]["loops"] = [("A", 2)]
    graph.nodes["base"]["ground"] = True
    sc = SCGraph(graph)
    assert (sc.ground, sc.loops[0].joints) == ("base", (0, 2, 1))
    assert sc.edges["base", "a", 0]["loops"] == (LoopPlace(0, 0, 3),)
    assert nx.get_edge_attributes(sc, "loops")


def test_own_attributes_are_kept():
    graph = TYPES["watt"].copy()
    graph.nodes[0]["colour"], graph.edges[0, 1, 0]["width"], graph.graph["title"] = "red", 2, "Watt"
    sc = SCGraph(graph)
    assert (sc.nodes[0]["colour"], sc.edges[0, 1, 0]["width"], sc.graph["title"]) == ("red", 2, "Watt")


def test_graphs_without_loops_need_them():
    bare = nx.MultiGraph()
    bare.add_edges_from((a, b, key) for key, (a, b) in enumerate(WATT))
    with pytest.raises(InvariantError, match=r"2 independent cycles and no loops; expected loops=\[...\]"):
        SCGraph(bare)
    assert SCGraph(bare, loops=LOOPS).is_identical(SCGraph(bare.nodes, bare.edges, LOOPS))
    assert SCGraph(bare, loops=[]).spatial_loops == 2
    assert len(SCGraph(nx.path_graph(4)).joints) == 3
    simple = nx.cycle_graph(4)
    assert SCGraph(simple.nodes, simple.edges, [Loop(range(4))]).number_of_edges() == 4
    assert set(SCGraph(nx.MultiGraph(WATT), loops=[]).joints) == set(range(7))
    by_links = SCGraph(nx.Graph(WATT), loops=[(0, 1, 2, 3), (3, 4, 5, 0)])
    there = {frozenset(ends): joint for joint, ends in by_links.joints.items()}
    renamed = {joint: there[frozenset(ends)] for joint, ends in enumerate(WATT)}
    assert by_links.is_identical(SCGraph(6, WATT, LOOPS).relabel({}, renamed))
    for nameless in (nx.Graph(WATT), nx.MultiGraph(WATT)):
        with pytest.raises(InvariantError, match=r"no ids by which a Loop could name them; expected loops by their"):
            SCGraph(nameless, loops=LOOPS)
    with pytest.raises(InvariantError, match=r"links 0 and 2 share 0 joints; expected one"):
        SCGraph(nx.Graph(WATT), loops=[(0, 2, 3)])
    assert synth.read(bare).centres_assumed
    with pytest.raises(InvariantError, match="joints beside a graph"):
        SCGraph(bare, WATT)
    with pytest.raises(InvariantError, match=r"a joint is 'ab'"):
        SCGraph(2, ["ab", (0, 1, 2)])


def test_joints_keep_their_ids():
    graph = TYPES["watt"].copy()
    for a, b in ((2, 6), (6, 7), (7, 3)):
        graph.add_edge(a, b, loops=())
    more = SCGraph(graph, loops=[*LOOPS, (2, 6, 7, 3)])
    assert {joint: ends for joint, ends in more.joints.items() if joint < 7} == dict(enumerate(WATT))
    assert set(more.joints) == set(range(10))
    two = SCGraph(nx.disjoint_union(TYPES["watt"], TYPES["watt"]))
    assert {joint: two.joints[joint] for joint in range(7)} == dict(enumerate(WATT))
    with pytest.raises(InvariantError, match=r"in 4 places; expected each joint once; for two mechanisms joined"):
        SCGraph(nx.compose(TYPES["watt"], nx.relabel_nodes(TYPES["watt"], {1: 6, 2: 7, 3: 8, 4: 9, 5: 10})))


def test_edges_with_and_without_loops_are_refused():
    graph = TYPES["watt"].copy()
    graph.add_edge(1, 4)
    with pytest.raises(InvariantError, match=r"has no attribute 'loops', and others have one"):
        SCGraph(graph)
    graph.edges[0, 1, 0]["loops"] = 3
    with pytest.raises(InvariantError, match=r"has the attribute 'loops' 3; expected a list of \(loop, place"):
        SCGraph(nx.edge_subgraph(graph, list(TYPES["watt"].edges)))


def test_an_empty_call_is_what_networkx_fills():
    assert type(SCGraph()) is type(SCDGraph()) is nx.MultiGraph
    assert type(PolyhedronModel()) is nx.Graph


SQUARES = PolyhedronModel(
    "ABCDEF",
    ["AB", "BC", "CD", "DA", "AC", "EF", "BE"],
    coordinates={v: (i, i * i, i % 2) for i, v in enumerate("ABCDEF")},
    centres=[RemoteCentre(3, (("A", "B"), ("C", "D")), "O"), RemoteCentre(1)],
    on_line=[PointConstraint("E", ("A", "B"))],
    on_plane=[PointConstraint("F", "ground")],
    scissors=["ABCD"],
    ground="CD",
    links={"panel": "ABCD", 1: "EF"},
)


def test_polyhedron_models_survive_networkx():
    for model in (SQUARES, synth.read("data/wampler/fig12.json"), synth.read("data/wampler/crs-platform.json")):
        for made in (model.copy(), nx.Graph(model), model.copy(as_view=True), model.to_directed()):
            assert mechanism_of_graph(made).is_identical(model)
        for same in (copy.copy(model), copy.deepcopy(model), pickle.loads(pickle.dumps(model))):
            assert type(same) is PolyhedronModel
            assert same.is_identical(model)
        there = {vertex: f"({vertex})" for vertex in model}
        assert PolyhedronModel(nx.relabel_nodes(model, there)).is_identical(model.relabel(there))
        assert synth.mobility(model.copy()).to_json() == synth.mobility(model).to_json()
        with pytest.raises(InvariantError, match=r"for a part of it try PolyhedronModel\(graph.nodes, graph.edges\)"):
            synth.mobility(model.subgraph(list(model)[:3]))
    assert PolyhedronModel(nx.cycle_graph(4)).number_of_edges() == 4


VERBS = [
    synth.mobility,
    synth.look,
    synth.identify,
    synth.convert,
    synth.reconstruct,
    synth.draw,
    synth.realise,
    synth.realise_on_cone,
    synth.template,
    synth.view,
    synth.explain,
    synth.move,
    synth.fold,
    synth.layers,
    synth.in_configuration,
    synth.map_linkage,
    synth.count_conical_candidates,
    lambda mechanism: synth.edit(mechanism, lock=[0]),
    lambda mechanism: list(synth.addenda(mechanism, -1)),
    lambda mechanism: synth.advise(mechanism, 1),
    lambda mechanism: synth.positions(mechanism, drive={0: 0.5}),
    lambda mechanism: synth.types_of([mechanism]),
    lambda mechanism: synth.reduce(mechanism, keep=[1]),
]


def outcome(verb, mechanism):
    try:
        answer = verb(mechanism)
    except SynthedraError as error:
        return str(error)
    return answer.to_json() if hasattr(answer, "to_json") else repr(answer)


@pytest.mark.parametrize("verb", VERBS, ids=lambda verb: verb.__name__)
def test_every_verb_takes_a_plain_graph(verb):
    """And answers as of the mechanism, or refuses it by the same words."""
    for mechanism in (TYPES["watt"], synth.read("data/wampler/fig12-scd.json"), synth.read("data/wampler/fig1.json")):
        assert outcome(verb, mechanism.copy()) == outcome(verb, mechanism)


def test_a_plain_graph_is_written_as_the_mechanism(tmp_path):
    for mechanism in (TYPES["names"], synth.read("data/wampler/fig12-scd.json"), SQUARES):
        for graph, name in ((mechanism, "a.json"), (mechanism.copy(), "b.json")):
            synth.write(graph, tmp_path / name, force=True)
        assert (tmp_path / "a.json").read_bytes() == (tmp_path / "b.json").read_bytes()


def test_help_on_graphs_is_their_own():
    for kind in (synth.SCGraph, synth.SCDGraph):
        for name in ("__init__", "__repr__", "__str__"):
            assert getattr(kind, name).__doc__ not in (None, getattr(nx.MultiGraph, name).__doc__)
    assert "    frame : int, optional\n" in synth.mobility.__doc__
