"""Bare link-joint graphs: graph6 and sparse6 (nauty), and GraphML; edge lists: :mod:`graphs.files.edge_lists`.

GraphML may say the type of each joint (``type`` of its edge), and then is a linkage with joints of all kinds.
Other such files hold links and joints and no loops. Read, they get the faces of an embedding as loops with finite
centres (:func:`graphs.convert.link_joint.sc_from_link_joint_graph`); written, loops and centres are lost.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from io import BytesIO
from pathlib import Path
from types import MappingProxyType
from xml.etree.ElementTree import ParseError

import networkx as nx

from graphs.convert.link_joint import sc_from_link_joint_graph
from graphs.errors import FileError, UnsolvableError, shown
from graphs.files.check import Checker
from graphs.files.names_as_text import names_from_text
from graphs.files.text import read_text
from graphs.joints.kinds import JointKind, kind_named
from graphs.joints.linkage import JointedLinkage
from graphs.mechanism.sc import SCGraph
from graphs.types import JointId

__all__ = [
    "as_linkage",
    "as_sc",
    "graph6_text",
    "graphml_text",
    "read_graph6",
    "read_graphml",
]

_GRAPH6_OFFSET = 63
_LARGEST_SHORT = 62


def read_graph6(path: Path) -> Iterator[tuple[int, nx.Graph]]:
    """Yield line number and graph for each line of a graph6 or sparse6 file; a FileError names the line."""
    for number, line in enumerate(read_text(path).splitlines(), start=1):
        text = re.sub(r"^>>(graph6|sparse6)<<", "", line.strip())
        if not text:
            continue
        place = f"line {number}"
        if not all(_GRAPH6_OFFSET <= ord(letter) <= 126 for letter in text.removeprefix(":")):
            raise FileError(path, place, f"not graph6: {shown(text)}", "graph6 or sparse6")
        order = _order(text.removeprefix(":"))
        if order is None:
            raise FileError(path, place, "the number of nodes is missing", "graph6 or sparse6")
        Checker(path).how_many(order, f"{place}: number of nodes")
        parse = nx.from_sparse6_bytes if text.startswith(":") else nx.from_graph6_bytes
        try:
            yield number, parse(text.encode("ascii"))
        except (nx.NetworkXError, ValueError, IndexError) as error:
            raise FileError(path, place, f"not graph6: {error}".splitlines()[0], "graph6 or sparse6") from None


def _order(text: str) -> int | None:
    """Return the number of nodes that a graph6 or sparse6 line announces."""
    digits = [ord(letter) - _GRAPH6_OFFSET for letter in text]
    if digits and digits[0] <= _LARGEST_SHORT:
        return digits[0]
    body = digits[2:8] if digits[1:2] == [63] else digits[1:4]
    if len(body) < 3 or (digits[1:2] == [63] and len(body) < 6):
        return None
    return sum(digit << 6 * i for i, digit in enumerate(reversed(body)))


def graph6_text(sc: SCGraph, *, sparse: bool) -> str:
    """Return the graph6 (or sparse6) line of the link-joint graph; links become 0, 1, 2, ...

    Raise UnsolvableError if two links share several joints and the form is graph6, which cannot express them.
    """
    if sc.parallel_joints() and not sparse:
        raise UnsolvableError("graph6 cannot hold links that share several joints; write sparse6 (.s6)")
    numbered = nx.convert_node_labels_to_integers(nx.MultiGraph(sc))
    if sparse:
        return str(nx.to_sparse6_bytes(numbered, header=False).decode("ascii"))
    return str(nx.to_graph6_bytes(nx.Graph(numbered), header=False).decode("ascii"))


def read_graphml(path: Path) -> nx.MultiGraph:
    """Read the link-joint graph of a GraphML file; directions are dropped, of attributes ``type`` is kept.

    Names of links that are all integers become integers, and so do those of joints.
    """
    text = read_text(path)
    try:
        graph = nx.read_graphml(BytesIO(text.encode("utf-8")), force_multigraph=True)
    except ParseError as error:
        line, column = error.position
        raise FileError(path, f"line {line} column {column}", "not XML", "GraphML") from None
    except (nx.NetworkXError, KeyError, TypeError, ValueError, AttributeError) as error:
        raise FileError(path, "", f"not GraphML: {shown(str(error))}", "GraphML") from None
    return _named_anew(nx.MultiGraph(graph))


def _named_anew(graph: nx.MultiGraph) -> nx.MultiGraph:
    """Give links and joints the names that their words stand for; joints without an id have a number already."""
    links = names_from_text(graph.nodes)
    keys = [key for *_, key in graph.edges(keys=True)]
    joints = names_from_text(keys) if all(isinstance(key, str) for key in keys) else {key: key for key in keys}
    named = nx.MultiGraph()
    named.add_nodes_from(links.values())
    for a, b, key, told in graph.edges(keys=True, data=True):
        named.add_edge(links[a], links[b], joints[key], **({"type": told["type"]} if "type" in told else {}))
    return named


def graphml_text(sc: SCGraph, kinds: Mapping[JointId, JointKind] = MappingProxyType({})) -> str:
    """Return the GraphML text of the link-joint graph, with the types of joints that are given.

    Raise UnsolvableError if a name has a character that XML does not allow.
    """
    for name in (*sc.nodes, *sc.joints):
        if re.search("[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]", str(name)):
            raise UnsolvableError(f"XML cannot hold the name {shown(name)}")
    named = nx.MultiGraph()
    named.add_nodes_from(map(str, sc.nodes))
    for joint, (a, b) in sc.joints.items():
        named.add_edge(str(a), str(b), str(joint), **({"type": kinds[joint].value} if joint in kinds else {}))
    return "\n".join(nx.generate_graphml(named)) + "\n"


def as_linkage(graph: nx.MultiGraph, path: Path) -> SCGraph | JointedLinkage:
    """Return the SC graph of a graph read from a file; if it has types of joints, a linkage without loops.

    The errors are those of `as_sc`.
    """
    told = {key: kind for *_, key, kind in graph.edges(keys=True, data="type") if kind is not None}
    if not told:
        return as_sc(graph, path)
    joints = {key: (a, b) for a, b, key in graph.edges(keys=True)}

    def made() -> JointedLinkage:
        kinds = {joint: kind_named(str(kind)) for joint, kind in told.items()}
        return JointedLinkage(SCGraph(graph.nodes, joints), kinds)

    return Checker(path).build(made, lambda part: f"joint {shown(part[1])}")


def as_sc(graph: nx.Graph, path: Path, place: str = "") -> SCGraph:
    """Return a graph read from a file with its loops; refuse a self-joint by a FileError that names the place."""
    for link in nx.nodes_with_selfloops(graph):
        raise FileError(path, place, f"a joint joins link {shown(link)} to itself", "two links")
    return Checker(path).build(lambda: sc_from_link_joint_graph(graph), lambda _: place, place)
