"""Edge lists as networkx and pandas write them."""

import networkx as nx
import pytest

from graphs.errors import FileError
from graphs.files.formats import read

STEPHENSON = nx.Graph([(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (4, 5), (5, 2)])


def same(sc, graph):
    assert set(sc.nodes) == set(graph.nodes)
    assert sorted(map(sorted, sc.joints.values())) == sorted(sorted(edge[:2]) for edge in graph.edges)


@pytest.mark.parametrize("attributes", [{}, {"weight": 2.5, "colour": "#ff0000", "note": "a, b"}])
@pytest.mark.parametrize("delimiter", [" ", ",", "\t"])
def test_networkx_write_edgelist(attributes, delimiter, tmp_path):
    graph = nx.MultiGraph(STEPHENSON)
    graph.add_edge(0, 1)  # parallel
    nx.set_edge_attributes(graph, dict.fromkeys(graph.edges, attributes))
    nx.write_edgelist(graph, tmp_path / "a.edges", delimiter=delimiter)
    same(read(tmp_path / "a.edges"), graph)


HEADS = ["source,target", ",source,target", "source,target,weight", '"source";"target"', "From,To", "source target"]


@pytest.mark.parametrize("suffix", [".csv", ".txt", ".edges"])
@pytest.mark.parametrize("head", HEADS)
def test_tables_of_edges(head, suffix, tmp_path):
    parted_by = next((sign for sign in ";," if sign in head), " ")
    rows = [head]
    for i, (a, b) in enumerate(STEPHENSON.edges):
        cells = [str(a), str(b)]
        if head.startswith(","):
            cells.insert(0, str(i))
        if "weight" in head:
            cells.append("1.0")  # the same in all rows: no joint id
        rows.append(parted_by.join(cells))
    (tmp_path / f"a{suffix}").write_text("\r\n".join(rows) + "\r\n", encoding="utf-8")
    same(read(tmp_path / f"a{suffix}"), STEPHENSON)


def test_names_with_commas_and_ids_of_joints_in_a_table(tmp_path):
    (tmp_path / "a.csv").write_text('joint,source,target\na,"left, arm",base\nb,base,c\nd,c,"left, arm"\n')
    assert dict(read(tmp_path / "a.csv").joints) == {
        "a": ("left, arm", "base"),
        "b": ("base", "c"),
        "d": ("left, arm", "c"),
    }


BAD = {
    "cells": ("source,target\n0,1\n2\n", r"line 3: 1 cell; expected 2, one for each column"),
    "empty": ("source,target\n0,\n", "line 2: an empty cell; expected the name of a link"),
    "quotes": ('source,target\n"0,1\n', "line 2: no cells: .*; expected cells, quotes closed"),
    "names": ("alpha,beta\n0,1\n1,2\n", "line 1: columns called 'alpha, beta'; expected source and target"),
    "nothing below": ("source,target\n", "no joints; expected lines below the names of the columns"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_tables(name, tmp_path):
    text, message = BAD[name]
    (tmp_path / "a.csv").write_text(text, encoding="utf-8")
    with pytest.raises(FileError, match=message):
        read(tmp_path / "a.csv")
