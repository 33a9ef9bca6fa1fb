"""Graphs on which canonical labelling is hard: strongly regular ones, copies side by side, Cai-Furer-Immerman pairs."""

from itertools import combinations, product

import networkx as nx


def integers(graph):
    return nx.convert_node_labels_to_integers(graph)


def net_of(square):
    """The graph of the cells of a Latin square: those in one row, in one column or with one symbol are joined."""
    cells = [(i, j, symbol) for i, row in enumerate(square) for j, symbol in enumerate(row)]
    graph = nx.empty_graph(len(cells))
    pairs = combinations(range(len(cells)), 2)
    graph.add_edges_from((a, b) for a, b in pairs if any(x == y for x, y in zip(cells[a], cells[b], strict=True)))
    return graph


def cyclic_square(n):
    return [[(i + j) % n for j in range(n)] for i in range(n)]


def klein_square():
    return [[i ^ j for j in range(4)] for i in range(4)]


def switched_square(n, chance, times=50):
    """A Latin square of chance: cycles between two rows of the cyclic one are exchanged again and again."""
    square = cyclic_square(n)
    for _ in range(times):
        one, other = (square[row] for row in chance.sample(range(n), 2))
        column = first = chance.randrange(n)
        cycle = []
        while not cycle or column != first:
            cycle.append(column)
            column = one.index(other[column])
        for c in cycle if len(cycle) < n else []:
            one[c], other[c] = other[c], one[c]
    return square


def rook(n):
    return integers(nx.line_graph(nx.complete_bipartite_graph(n, n)))


def shrikhande():
    """The other strongly regular graph with the numbers of `rook(4)`."""
    steps = [(0, 1), (0, 3), (1, 0), (3, 0), (1, 1), (3, 3)]
    places = product(range(4), repeat=2)
    return nx.Graph((4 * a + b, 4 * ((a + x) % 4) + (b + y) % 4) for a, b in places for x, y in steps)


def cai_furer_immerman(base, twisted):
    """Refinement cannot tell the twisted graph from the other (Cai, Furer and Immerman 1992)."""
    graph = nx.Graph()
    for v in base:
        ends = [frozenset((v, u)) for u in base[v]]
        for size in range(0, len(ends) + 1, 2):
            for chosen in map(frozenset, combinations(ends, size)):
                graph.add_edges_from((("inner", v, chosen), (v, end, end in chosen)) for end in ends)
    for i, (a, b) in enumerate(base.edges()):
        end, cross = frozenset((a, b)), twisted and i == 0
        graph.add_edges_from(((a, end, side), (b, end, side ^ cross)) for side in (False, True))
    return integers(graph)


def plane_of(q):
    """Points and lines of the projective plane over the integers modulo a prime."""
    points = [p for p in product(range(q), repeat=3) if next((x for x in p if x), 0) == 1]
    graph = nx.empty_graph(2 * len(points))
    for (i, p), (j, line) in product(enumerate(points), repeat=2):
        if sum(a * b for a, b in zip(p, line, strict=True)) % q == 0:
            graph.add_edge(i, len(points) + j)
    return graph


def side_by_side(graphs):
    return nx.disjoint_union_all(list(graphs))


def different_cubic_graphs(number, nodes):
    """Cubic graphs side by side, of which refinement cannot tell a vertex from another."""
    return side_by_side(nx.random_regular_graph(3, nodes, seed=seed) for seed in range(number))
