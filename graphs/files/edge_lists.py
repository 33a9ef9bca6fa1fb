"""Edge lists: lines ``link link [joint]``, those that networkx writes, and tables of edges (CSV, pandas).

networkx's ``write_edgelist`` ends each line with a dictionary of what it knows of the edge; pandas writes a line
of column names, and often a column of row numbers before them. Neither names joints: they are numbered.
"""

from __future__ import annotations

import csv
import re
import string
from collections import Counter
from pathlib import Path

import networkx as nx

from graphs.errors import FileError, UnsolvableError, shown
from graphs.files.names_as_text import names_from_text
from graphs.files.text import read_text
from graphs.mechanism.sc import SCGraph

__all__ = ["edge_list_text", "read_edge_list"]

_NAMES_OF_ENDS = (("source", "target"), ("from", "to"))
"""Names of the two columns of a table of edges that hold its ends, in small letters."""
_NAMES_OF_JOINTS = ("joint", "joint id")
_EXPECTED = "two links, and perhaps a joint id"
_BEGINS_ATTRIBUTES = re.compile(r"[\s,;]\{")
_PARTS_NAMES = string.whitespace + ",;"
_INTEGER = re.compile(r"-?\d{1,18}")

Row = tuple[int, str]
"""The number of a line, and its text."""
Words = list[str]
"""Two links, and perhaps a joint."""


def read_edge_list(path: Path) -> nx.MultiGraph:
    """Read lines ``link link [joint id]``; ``#`` starts a comment, blanks, commas or semicolons part the names.

    A dictionary at the end of a line (networkx) is left alone. If the first line names columns for the ends of
    edges (source and target, from and to), the file is a table, of which these columns are read, and one called
    joint if there is one. Names of links that are all integers become integers, and so do those of joints. A
    FileError names the line.
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
    if ends is None:
        return _graph_of(_rows_of_lines(lines, path), path)
    if len(lines) == 1:
        raise FileError(path, "", "no joints", "lines below the names of the columns")
    wanted = [columns.index(name) for name in (*ends, *(name for name in _NAMES_OF_JOINTS if name in columns))]
    return _graph_of(_rows_of_table(lines[1:], parted_by, len(columns), wanted, path), path)


def _rows_of_lines(lines: list[Row], path: Path) -> list[Words]:
    """Return the words of lines ``link link [joint]``, comments and dictionaries taken off."""
    rows = []
    for number, line in lines:
        words = re.split(r"[\s,;]+", _names_of_line(line).strip())
        if len(words) not in (2, 3):
            raise FileError(path, f"line {number}", f"{len(words)} word(s)", _EXPECTED)
        rows.append(words)
    (number, first), names = lines[0], rows[0][:2]
    others = [word for words in rows[1:] for word in words[:2]]
    if (
        "," in first
        and others
        and not any(map(_INTEGER.fullmatch, names))
        and all(map(_INTEGER.fullmatch, others))
    ):
        found = f"columns called {shown(', '.join(names))}"
        raise FileError(path, f"line {number}", found, "source and target, or no names of columns")
    return rows


def _names_of_line(line: str) -> str:
    """Return a line without the dictionary at its end, which may hold a ``#``, or without its comment."""
    begins = _BEGINS_ATTRIBUTES.search(line)
    if begins and line.rstrip().endswith("}") and "#" not in line[: begins.start()]:
        return line[: begins.start()].rstrip(_PARTS_NAMES)
    return line.split("#", 1)[0]


def _rows_of_table(lines: list[Row], parted_by: str, width: int, wanted: list[int], path: Path) -> list[Words]:
    """Return the cells of the columns that are wanted."""
    rows = []
    for line in lines:
        cells = _cells(line, parted_by, path)
        if len(cells) != width:
            raise FileError(path, f"line {line[0]}", f"{len(cells)} cell(s)", f"{width}, one for each column")
        words = [cells[column] for column in wanted]
        if not all(words):
            raise FileError(path, f"line {line[0]}", "an empty cell", "the name of a link")
        rows.append(words)
    return rows


def _cells(line: Row, parted_by: str, path: Path) -> Words:
    """Return the cells of a line of a table."""
    number, text = line
    try:
        return [cell.strip() for cell in next(csv.reader([text.strip()], delimiter=parted_by, strict=True))]
    except csv.Error as error:
        raise FileError(path, f"line {number}", f"no cells: {error}", "cells, quotes closed") from None


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
    """Return one line ``link link joint`` for each joint.

    Raise UnsolvableError if a name has blanks, commas or ``#``, or a link has no joint.
    """
    for name in (*sc.nodes, *sc.joints):
        if not re.fullmatch(r"[^\s,;#]+", str(name)):
            raise UnsolvableError(f"an edge list cannot hold the name {shown(name)}")
    if lonely := [link for link in sc.nodes if not sc.degree(link)]:
        raise UnsolvableError(f"an edge list cannot hold link {shown(lonely[0])}, which has no joint")
    return "".join(f"{a} {b} {joint}\n" for joint, (a, b) in sc.joints.items())
