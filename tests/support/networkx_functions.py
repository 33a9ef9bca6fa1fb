"""Functions of networkx that make a graph of a graph: found in its public interface, with arguments by their names."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from functools import partial
from itertools import islice

import networkx as nx

_ARGUMENTS = {
    "nbunch": lambda graph: list(graph)[:2],
    "nodes": lambda graph: list(graph)[:2],
    "edges": lambda graph: list(graph.edges(keys=True))[:1],
    "mapping": lambda graph: {link: f"({link})" for link in graph},
    "n": lambda graph: next(iter(graph)),
    "u": lambda graph: next(iter(graph)),
    "v": lambda graph: list(graph)[1],
    "edge": lambda graph: next(iter(graph.edges())),
    "H": lambda graph: graph,
    "G2": lambda graph: graph,
    "source": lambda graph: next(iter(graph)),
    "k": lambda graph: 2,
    "r": lambda graph: 1,
    "node": lambda graph: next(iter(graph)),
    "self_nodes": lambda graph: next(iter(graph)),
    "terminal_nodes": lambda graph: list(graph)[:2],
    "partition": lambda graph: [{link} for link in graph],
    "stretch": lambda graph: 3,
}
"""What is passed for a parameter without a default."""

_SLOW = frozenset({"degree_pearson_correlation_coefficient", "display", "chromatic_polynomial", "tutte_polynomial"})
"""Functions that make no graph and take long, or start another program."""


def graph_functions(graph: nx.MultiGraph) -> Iterator[tuple[str, Callable[[], object]]]:
    """Yield the public functions that can be called with a graph, and the call."""
    for name in dir(nx):
        function = getattr(nx, name)
        if name.startswith(("_", "write_", "draw", "generate_")) or name in _SLOW or not callable(function):
            continue
        try:
            parameters = list(inspect.signature(function).parameters.values())
        except (TypeError, ValueError):
            continue
        if inspect.isclass(function) or not parameters or parameters[0].name not in ("G", "graph", "U", "graphs"):
            continue
        needed = [p.name for p in parameters[1:] if p.default is p.empty and p.kind is p.POSITIONAL_OR_KEYWORD]
        if set(needed) <= set(_ARGUMENTS):
            first = [graph, graph] if parameters[0].name == "graphs" else graph
            yield name, partial(function, first, *(_ARGUMENTS[one](graph) for one in needed))


def graphs_made(graph: nx.MultiGraph) -> Iterator[tuple[str, nx.Graph]]:
    """Yield what those functions make of a graph, where it is a graph; what networkx refuses is left out."""
    for name, call in graph_functions(graph):
        try:
            result = call()
            if inspect.isgenerator(result):
                result = list(islice(result, 2))
        except Exception:
            continue
        results = result if isinstance(result, list | tuple) else [result]
        yield from ((name, one) for one in results if isinstance(one, nx.Graph))
