"""Bare link-joint graphs: graph6 and sparse6 (nauty), GraphML, and edge lists.

Read, they get the faces of an embedding as loops with finite centres; GraphML with the type of each joint is a
linkage with joints of all kinds. Edge lists are lines ``link link [joint]``, those that networkx writes, and
tables of edges (CSV, pandas). Names that are text are integers if all of them are written as integers are.
"""

import csv
import re
import string
from collections import Counter
from collections.abc import Collection, Hashable, Iterable, Iterator, Mapping
from io import BytesIO
from pathlib import Path
from types import MappingProxyType
from xml.etree.ElementTree import ParseError

import networkx as nx

from graphs.convert.link_joint import sc_from_link_joint_graph
from graphs.errors import FileError, UnsolvableError, numbered, shown
from graphs.files.text import Checker, read_text
from graphs.joints.linkage import JointedLinkage, JointKind, kind_named
from graphs.mechanism.sc import SCGraph
from graphs.types import JointId

_INTEGER = re.compile(r"0|-?[1-9]\d{0,17}")
"""An integer as Python writes it: ``01`` is another name than ``1``."""


def names_from_text(words: Iterable[str]) -> dict[str, str | int]:
    """Return word to name: integers if all are, else the words."""
    every = list(dict.fromkeys(words))
    whole = all(map(_INTEGER.fullmatch, every))
    return {word: int(word) if whole else word for word in every}


def are_kept(names: Collection[Hashable]) -> bool:
    """Say whether names are the same when they are written as text and read again."""
    return list(names_from_text(map(str, names)).values()) == list(names)


_GRAPH6_OFFSET = 63  # graph6 adds it to each six bits: 63 to 126 are the printable letters from ? to ~
_LARGEST_SHORT = 62  # nodes that one letter announces: 63 is the sign that more letters follow


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
    """Return the graph6 line of the link-joint graph, which has no parallel joints, or its sparse6 line."""
    if sc.parallel_joints() and not sparse:
        raise UnsolvableError("graph6 cannot hold links that share several joints; write sparse6 (.s6)")
    numbered = nx.convert_node_labels_to_integers(nx.MultiGraph(sc))
    if sparse:
        return str(nx.to_sparse6_bytes(numbered, header=False).decode("ascii"))
    return str(nx.to_graph6_bytes(nx.Graph(numbered), header=False).decode("ascii"))


def read_graphml(path: Path) -> nx.MultiGraph:
    """Read the link-joint graph of a GraphML file; directions are dropped, of attributes ``type`` is kept."""
    text = read_text(path)
    try:
        graph = nx.read_graphml(BytesIO(text.encode("utf-8")), force_multigraph=True)
    except ParseError as error:
        line, column = error.position
        raise FileError(path, f"line {line} column {column}", "not XML", "GraphML") from None
    except (nx.NetworkXError, KeyError, TypeError, ValueError, AttributeError) as error:
        raise FileError(path, "", f"not GraphML: {shown(str(error))}", "GraphML") from None
    return _named_anew(nx.MultiGraph(graph))


_EDGE = re.compile(r"(?m)^\s*edge\b")


def read_gml(path: Path) -> nx.MultiGraph:
    """Read the link-joint graph of a GML file, links by their labels where all have one, else by their numbers."""
    text = read_text(path)
    Checker(path).how_many(len(_EDGE.findall(text)), "number of edges")
    try:
        graph = nx.parse_gml(text, label="id")
    except (nx.NetworkXError, LookupError, TypeError, ValueError, AttributeError, RecursionError) as error:
        raise FileError(path, "", f"not GML: {shown(str(error))}", "GML as networkx writes it") from None
    labels = {node: str(label) for node, label in graph.nodes(data="label") if label is not None}
    if len(set(labels.values())) != len(graph):
        labels = {node: str(node) for node in graph}
    named = nx.MultiGraph()
    named.add_nodes_from(labels.values())
    for number, (a, b, attributes) in enumerate(graph.edges(data=True)):
        kind = {"type": attributes["type"]} if "type" in attributes else {}
        named.add_edge(labels[a], labels[b], str(attributes.get("key", number)), **kind)
    return _named_anew(named)


def _named_anew(graph: nx.MultiGraph) -> nx.MultiGraph:
    """Give links and joints the names that their words stand for; joints without an id have a number already."""
    links = names_from_text(graph.nodes)
    keys = [key for *_, key in graph.edges(keys=True)]
    joints = names_from_text(keys) if all(isinstance(key, str) for key in keys) else {key: key for key in keys}
    named = nx.MultiGraph()
    named.add_nodes_from(links.values())
    for a, b, key, kind in graph.edges(keys=True, data="type"):
        named.add_edge(links[a], links[b], joints[key], **({} if kind is None else {"type": kind}))
    return named


def graphml_text(sc: SCGraph, kinds: Mapping[JointId, JointKind] = MappingProxyType({})) -> str:
    """Return the GraphML text of the link-joint graph, with the types of the joints in `kinds`."""
    for name in (*sc.nodes, *sc.joints):
        if re.search("[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]", str(name)):
            raise UnsolvableError(f"XML cannot hold the name {shown(name)}")
    named = nx.MultiGraph()
    named.add_nodes_from(map(str, sc.nodes))
    for joint, (a, b) in sc.joints.items():
        named.add_edge(str(a), str(b), str(joint), **({"type": kinds[joint].value} if joint in kinds else {}))
    return "\n".join(nx.generate_graphml(named)) + "\n"


def as_linkage(graph: nx.MultiGraph, path: Path) -> SCGraph | JointedLinkage:
    """Return the SC graph of a graph read from a file; if it has types of joints, a linkage without loops."""
    words = {key: str(kind) for *_, key, kind in graph.edges(keys=True, data="type") if kind is not None}
    if not words:
        return as_sc(graph, path)
    joints = {key: (a, b) for a, b, key in graph.edges(keys=True)}

    def linkage() -> JointedLinkage:
        kinds = {joint: kind_named(word) for joint, word in words.items()}
        return JointedLinkage(SCGraph(graph.nodes, joints), kinds)

    return Checker(path).build(linkage, lambda part: f"joint {shown(part[1])}")


def as_sc(graph: nx.Graph, path: Path, place: str = "") -> SCGraph:
    """Return a graph read from a file with its loops; refuse a self-joint by a FileError that names the place."""
    for link in nx.nodes_with_selfloops(graph):
        raise FileError(path, place, f"a joint joins link {shown(link)} to itself", "two links")
    return Checker(path).build(lambda: sc_from_link_joint_graph(graph), lambda _: place, place)


_NAMES_OF_ENDS = (("source", "target"), ("from", "to"))
"""Names of the two columns of a table of edges that hold its ends, in small letters."""
_NAMES_OF_JOINTS = ("joint", "joint id")
_EXPECTED = "two links, and perhaps a joint id"
_BEGINS_ATTRIBUTES = re.compile(r"[\s,;]\{")
_PARTS_NAMES = string.whitespace + ",;"
_WHOLE_NUMBER = re.compile(r"-?\d{1,18}")

Row = tuple[int, str]
"""The number of a line, and its text."""
Words = list[str]
"""Two links, and perhaps a joint."""


def read_edge_list(path: Path) -> nx.MultiGraph:
    """Read lines ``link link [joint id]``; ``#`` starts a comment, blanks, commas or semicolons part the names.

    A dictionary at the end of a line (networkx) is left alone. If the first line names columns for the ends of
    edges (source and target, from and to), the file is a table, of which these columns are read, and one called
    joint.
    """
    lines = [
        (number, line)
        for number, line in enumerate(read_text(path).splitlines(), start=1)
        if line.split("#", 1)[0].strip()
    ]
    if not lines:
        raise FileError(path, "", "no joints", "lines with two links each")
    parted_by = next((sign for sign in ";,\t" if sign in lines[0][1]), " ")
    columns = [name.strip(" \"'\r").lower() for name in lines[0][1].strip().split(parted_by)]
    ends = next((ends for ends in _NAMES_OF_ENDS if set(ends) <= set(columns)), None)
    if ends is None and len(columns) > 3 and {"code", "string"} & set(columns):
        wanted = "edges; rows of an enumeration are read from .jsonl, .sqlite or .parquet"
        raise FileError(path, "line 1", "columns of a list of mechanisms", wanted)
    if ends is None:
        return _graph_of(_rows_of_lines(lines, path), path)
    if len(lines) == 1:
        raise FileError(path, "", "no joints", "lines below the names of the columns")
    names = (*ends, *(name for name in _NAMES_OF_JOINTS if name in columns))
    numbers = [columns.index(name) for name in names]
    return _graph_of(_rows_of_table(lines[1:], parted_by, len(columns), numbers, path), path)


def _rows_of_lines(lines: list[Row], path: Path) -> list[Words]:
    """Return the words of lines ``link link [joint]``, comments and dictionaries taken off."""
    rows = []
    for number, line in lines:
        words = re.split(r"[\s,;]+", _names_of_line(line).strip())
        if len(words) not in (2, 3):
            raise FileError(path, f"line {number}", numbered(len(words), "word"), _EXPECTED)
        rows.append(words)
    (number, first), names = lines[0], rows[0][:2]
    others = [word for words in rows[1:] for word in words[:2]]
    names_are_text = not any(map(_WHOLE_NUMBER.fullmatch, names))
    if "," in first and others and names_are_text and all(map(_WHOLE_NUMBER.fullmatch, others)):
        wrong = f"columns called {shown(', '.join(names))}"
        raise FileError(path, f"line {number}", wrong, "source and target, or no names of columns")
    return rows


def _names_of_line(line: str) -> str:
    """Return a line without the dictionary at its end, which may hold a ``#``, or without its comment."""
    begins = _BEGINS_ATTRIBUTES.search(line)
    if begins and line.rstrip().endswith("}") and "#" not in line[: begins.start()]:
        return line[: begins.start()].rstrip(_PARTS_NAMES)
    return line.split("#", 1)[0]


def _rows_of_table(lines: list[Row], parted_by: str, width: int, columns: list[int], path: Path) -> list[Words]:
    """Return the cells of some columns of a table, by their numbers."""
    rows = []
    for number, text in lines:
        try:
            row = next(csv.reader([text.strip()], delimiter=parted_by, strict=True))
        except csv.Error as error:
            raise FileError(path, f"line {number}", f"no cells: {error}", "cells, quotes closed") from None
        cells = [cell.strip() for cell in row]
        if len(cells) != width:
            raise FileError(path, f"line {number}", numbered(len(cells), "cell"), f"{width}, one for each column")
        words = [cells[column] for column in columns]
        if not all(words):
            raise FileError(path, f"line {number}", "an empty cell", "the name of a link")
        rows.append(words)
    return rows


def _graph_of(rows: list[Words], path: Path) -> nx.MultiGraph:
    """Return the graph of rows of two links, and perhaps a joint."""
    links = names_from_text(word for words in rows for word in words[:2])
    ids = [words[2] if len(words) == 3 else str(i) for i, words in enumerate(rows)]
    again, times = Counter(ids).most_common(1)[0]
    if times > 1:
        raise FileError(path, "", f"the joint id {shown(again)} occurs twice", "distinct ids")
    joints = names_from_text(ids)
    graph = nx.MultiGraph()
    for words, joint in zip(rows, ids, strict=True):
        graph.add_edge(links[words[0]], links[words[1]], key=joints[joint])
    return graph


def edge_list_text(sc: SCGraph) -> str:
    """Return one line ``link link joint`` for each joint, if no name has blanks, commas or ``#``."""
    for name in (*sc.nodes, *sc.joints):
        if not re.fullmatch(r"[^\s,;#]+", str(name)):
            raise UnsolvableError(f"an edge list cannot hold the name {shown(name)}")
    if lonely := [link for link in sc.nodes if not sc.degree(link)]:
        raise UnsolvableError(f"an edge list cannot hold link {shown(lonely[0])}, which has no joint")
    return "".join(f"{a} {b} {joint}\n" for joint, (a, b) in sc.joints.items())
