import networkx as nx
import pytest
from hypothesis import given
from strategies import sc_graphs

from graphs.convert.link_joint import sc_from_link_joint_graph
from graphs.count.report import mobility_report
from graphs.errors import FileError, InvariantError, UnsolvableError
from graphs.files.bare import edge_list_text, graph6_text, graphml_text
from graphs.files.formats import read, read_all, write
from graphs.mechanism.sc import SCGraph

PARALLEL = SCGraph(["A", "B", "C"], {"a": ("A", "B"), "b": ("A", "B"), "c": ("B", "C")})


def test_graph6_gives_loops_by_embedding(tmp_path):
    path = tmp_path / "chains.g6"
    path.write_text(">>graph6<<Cl\nEFz_\n\n", encoding="ascii")
    entries = list(read_all(path))
    assert [entry.label for entry in entries] == [f"{path}:1", f"{path}:2"]
    four_bar = mobility_report(entries[0].mechanism)
    assert (four_bar.mechanism_class, four_bar.mobility) == ("spherical", 1)
    k33 = entries[1].mechanism
    assert nx.is_isomorphic(nx.Graph(k33), nx.complete_bipartite_graph(3, 3))
    assert len(k33.loops) == k33.independent_loops == 4  # not planar: a shortest cycle basis


@pytest.mark.parametrize("suffix", [".s6", ".graphml", ".edges", ".txt"])
def test_parallel_joints_survive(suffix, tmp_path):
    path = tmp_path / f"a{suffix}"
    assert "that 1 loop has no centre" in write(PARALLEL, path, lossy=True)
    back = read(path)
    assert sorted(d for _, d in back.degree()) == [1, 2, 3]
    if suffix != ".s6":
        assert dict(back.joints) == dict(PARALLEL.joints)


@pytest.mark.parametrize(("suffix", "writes"), [(".gml", nx.write_gml), (".edgelist", nx.write_edgelist)])
def test_what_networkx_writes_is_read(suffix, writes, tmp_path):
    graph = nx.relabel_nodes(nx.petersen_graph(), str)
    writes(graph, tmp_path / f"a{suffix}")
    back = read(tmp_path / f"a{suffix}")
    assert nx.is_isomorphic(nx.Graph(back), graph)
    assert set(back) == set(range(10))
    there = read(nx.convert_node_labels_to_integers(graph))
    assert set(map(frozenset, back.edges())) == set(map(frozenset, there.edges()))


def test_graphs_of_networkx_are_read():
    two = nx.MultiGraph([("A", "B"), ("A", "B"), ("B", "C")])
    assert len(read(two).joints) == 3
    assert read(nx.DiGraph([(0, 1), (1, 0), (1, 2)])).number_of_edges() == 2
    assert read(PARALLEL) is PARALLEL
    with pytest.raises(InvariantError, match="itself"):
        read(nx.Graph([(0, 0)]))


@pytest.mark.parametrize(
    ("text", "words"),
    [("graph [", "not GML"), ("", "empty"), ("graph [ node [ id 0 ] edge [ source 0 target 1 ] ]", "not GML"),
     ('graph [ node [ id 0 label "a" ] edge [ source 0 target 0 ] ]', "to itself")],
)  # fmt: skip
def test_gml_that_is_none(text, words, tmp_path):
    (tmp_path / "a.gml").write_text(text)
    with pytest.raises(FileError, match=words):
        read(tmp_path / "a.gml")


def test_graph6_cannot_hold_parallel_joints():
    with pytest.raises(UnsolvableError, match=r"write sparse6 \(.s6\)"):
        graph6_text(PARALLEL, sparse=False)


def test_names_that_a_format_cannot_hold():
    with pytest.raises(UnsolvableError, match="an edge list cannot hold the name 'a b'"):
        edge_list_text(SCGraph(["a b", "c"], [("a b", "c")]))
    with pytest.raises(UnsolvableError, match="which has no joint"):
        edge_list_text(SCGraph(3, [(0, 1)]))
    with pytest.raises(UnsolvableError, match="XML cannot hold the name"):
        graphml_text(SCGraph(["\x01", "c"], [("\x01", "c")]))


def test_markup_in_names_is_escaped_in_graphml(tmp_path):
    sc = SCGraph(["<script>", "& \"'"], {"]]>": ("<script>", "& \"'")})
    write(sc, tmp_path / "a.graphml")
    assert "<script>" not in (tmp_path / "a.graphml").read_text(encoding="utf-8")
    assert read(tmp_path / "a.graphml").is_identical(sc)


@given(sc_graphs)
def test_bare_formats_keep_links_and_joints(tmp_path_factory, sc):
    folder = tmp_path_factory.mktemp("bare")
    plain = sc.relabel({link: i for i, link in enumerate(sc.nodes)})
    for suffix in (".s6", ".graphml", ".edges"):
        try:
            write(plain, folder / f"a{suffix}", lossy=True)
            back = read(folder / f"a{suffix}")
        except UnsolvableError as error:
            assert "no joint" in str(error)
            continue
        except FileError as error:
            assert "is empty" in str(error)
            continue
        edges = sorted(tuple(sorted((str(a), str(b)))) for a, b in back.edges())
        assert edges == sorted(tuple(sorted((str(a), str(b)))) for a, b in plain.edges())


def test_an_edge_list_may_have_comments_and_commas(tmp_path):
    path = tmp_path / "watt.edges"
    path.write_text("# Watt\nA,B\nB, C\nC D # here\nD A\nD E\nE F\nF A\n", encoding="utf-8")
    report = mobility_report(read(path))
    assert (report.links, report.joints, report.centres, report.mobility) == (6, 7, 2, 1)


def test_edge_keys_become_joint_ids():
    graph = nx.MultiGraph()
    graph.add_edge(0, 1, key="a")
    graph.add_edge(0, 1, key="b")
    assert set(sc_from_link_joint_graph(graph).joints) == {"a", "b"}


@pytest.mark.parametrize("suffix", [".graphml", ".edges"])
def test_integer_names_stay_integers(suffix, tmp_path):
    sc = SCGraph([7, -3, 10], {5: (7, -3), 2: (-3, 10)})
    assert write(sc, tmp_path / f"a{suffix}") == ()
    assert read(tmp_path / f"a{suffix}").is_identical(sc)


@pytest.mark.parametrize("suffix", [".graphml", ".edges"])
def test_kinds_of_names_that_text_cannot_tell_are_told(suffix, tmp_path):
    mixed = SCGraph([1, "a", 2], {"0": (1, "a"), "1": ("a", 2)})
    assert write(mixed, tmp_path / f"a{suffix}") == ("whether names of 3 links and 2 joints are text or integers",)
    assert list(read(tmp_path / f"a{suffix}").nodes) == ["1", "a", "2"]
    zeros = SCGraph(["01", "1"], {"x": ("01", "1")})
    assert write(zeros, tmp_path / f"b{suffix}") == ()
    assert read(tmp_path / f"b{suffix}").is_identical(zeros)
