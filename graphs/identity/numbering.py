"""Canonical numbers and symmetries of coloured graphs: the search of `graphs.identity.leaves`, in C where it was built.

Where there is no library of C, bliss gives the numbers if it is installed (the extra ``bliss``), else Python. All
three have the same canonical form, so ids do not depend on what is installed. The library and Python agree in each
number and generator; numbers by bliss may differ from theirs by a symmetry of the graph, so generators, of which
drawings are made, never come from it. Theory: docs/theory/chains.md.
"""

import ctypes
from ctypes import POINTER, byref, c_double, c_int, c_int64, c_void_p
from pathlib import Path
from typing import Any

import numpy as np

from graphs.c_libraries import library
from graphs.identity.leaves import ColouredGraph, Symmetries, greatest_leaf
from graphs.types import Ints

SOURCE = Path(__file__).with_name("leaves.c")
_P = c_void_p
_N = c_int64
_FUNCTIONS: dict[str, tuple[Any, tuple[Any, ...]]] = {
    "leaves_of_graph": (c_int, (_N, _N, _P, _P, _P, _P, _P, POINTER(_P))),
    "leaves_of_rows": (c_int, (_N, _N, _N, _P, _P, _P)),
    "leaves_free": (None, (_P,)),
}


def labels_of(graph: ColouredGraph) -> list[int]:
    """Return the canonical number of each node."""
    found = by_library(graph)
    if found is None:
        return labels_by_bliss(graph) or greatest_leaf(graph).labels
    return found.labels


def symmetries_of(graph: ColouredGraph) -> Symmetries:
    """Return canonical numbers and automorphisms.

    >>> symmetries_of(ColouredGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [1, 0, 0, 0])).size
    2.0
    """
    return by_library(graph) or greatest_leaf(graph)


def numbers_of_rows(nodes: int, joints: Ints, automorphisms: Ints | None = None) -> Ints:
    """Return the canonical numbers of the nodes of many graphs of one size, int64[r, nodes].

    Joints, int64[r, J, 2], are pairs of nodes, no pair twice; `automorphisms` says how many each graph has, where that
    is known. Such a graph needs no search where each cell that is split is one orbit of the symmetries that are left:
    that is so if the lengths of these cells multiply to the number of automorphisms.

    >>> numbers_of_rows(3, np.array([[[0, 1], [0, 2]]])).tolist()
    [[2, 1, 0]]
    """
    found = _library()
    if found is None:
        rows = [labels_of(ColouredGraph(nodes, row)) for row in joints.tolist()]
        return np.array(rows, np.int64).reshape(len(joints), nodes)
    sizes = np.ones(len(joints), np.int64) if automorphisms is None else automorphisms
    arrays = [np.ascontiguousarray(array, np.int64) for array in (joints, sizes)]
    numbers = np.empty((len(joints), nodes), np.int64)
    places = [array.ctypes.data for array in (*arrays, numbers)]
    if not found.leaves_of_rows(nodes, joints.shape[1], len(joints), *places):
        raise MemoryError("no memory for graphs of so many links")
    return numbers


def by_library(graph: ColouredGraph) -> Symmetries | None:
    """Return canonical numbers and automorphisms by the library of C; None where there is none."""
    found = _library()
    if found is None:
        return None
    edges = np.array(list(graph.edges), np.int64).reshape(-1, 2)
    colours = np.array(graph.colours, np.int32) if graph.colours else None
    labels = np.empty(graph.nodes, np.int64)
    size, count, generators = c_double(), c_int64(), c_void_p()
    places = (edges.ctypes.data, None if colours is None else colours.ctypes.data, labels.ctypes.data)
    if not found.leaves_of_graph(graph.nodes, len(edges), *places, byref(size), byref(count), byref(generators)):
        raise MemoryError("no memory for a graph of so many nodes")
    try:
        rows: list[list[int]] = []
        if count.value:
            address = ctypes.cast(generators, POINTER(c_int64))
            rows = np.ctypeslib.as_array(address, (count.value, graph.nodes)).tolist()
    finally:
        found.leaves_free(generators)
    return Symmetries(labels.tolist(), rows, size.value)


def labels_by_bliss(graph: ColouredGraph) -> list[int] | None:
    """Return the canonical number of each node by bliss; None where it is not installed."""
    try:
        import bliss_bind
    except ImportError:
        return None
    built = bliss_bind.Graph(0 if graph.colours else graph.nodes)
    for colour in graph.colours:
        built.add_vertex(colour)
    # The order in which cells are split is part of the ids: the first of those with most neighbour cells.
    built.set_splitting_heuristic(bliss_bind.Graph.SplittingHeuristic.shs_fm)
    for a, b in graph.edges:
        built.add_edge(a, b)
    labels: list[int] = built.canonical_form()[0]
    return labels


def _library() -> ctypes.CDLL | None:
    """Return the library with the types of its functions; None where there is none."""
    found = library(SOURCE)
    if found is not None and found.leaves_of_graph.argtypes is None:
        for name, (result, arguments) in _FUNCTIONS.items():
            function = getattr(found, name)
            function.restype, function.argtypes = result, arguments
    return found
