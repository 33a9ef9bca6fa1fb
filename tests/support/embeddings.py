"""All embeddings of a graph in the sphere, the plainest way: every rotation system, kept if its genus is 0."""

from __future__ import annotations

from itertools import permutations, product

import networkx as nx

from graphs.identity.chains import chain_id


def spherical_embeddings(graph):
    """Yield the faces of each embedding, as tuples of edge indices, each set of faces once."""
    edges = [tuple(edge) for edge in graph.edges()]
    number = {frozenset(edge): i for i, edge in enumerate(edges)}
    nodes = list(graph)
    choices = []
    for node in nodes:
        first, *rest = [number[frozenset((node, other))] for other in graph[node]]
        choices.append([(first, *order) for order in permutations(rest)])
    seen = set()
    for rotation in product(*choices):
        after = {}
        for node, order in zip(nodes, rotation, strict=True):
            for edge, following in zip(order, (*order[1:], order[0]), strict=True):
                after[node, edge] = following
        faces = traced(edges, after)
        if len(nodes) - len(edges) + len(faces) != 2:
            continue
        key = frozenset(frozenset(face) for face in faces)
        if key not in seen:
            seen.add(key)
            yield faces


def traced(edges, after):
    """Follow every dart round its face."""
    left = {(a, i) for i, edge in enumerate(edges) for a in edge}
    faces = []
    while left:
        start = node, edge = left.pop()
        face = []
        while True:
            face.append(edge)
            a, b = edges[edge]
            node = b if node == a else a
            edge = after[node, edge]
            if (node, edge) == start:
                break
            left.remove((node, edge))
        faces.append(tuple(face))
    return faces


def face_code(links, joints, faces, outer):
    """A canonical label of an embedding with its outer face: faces as coloured nodes on their links and joints."""
    code = nx.Graph()
    for i, (a, b) in enumerate(joints):
        code.add_edges_from([(("l", a), ("j", i)), (("j", i), ("l", b))])
    for k, face in enumerate(faces):
        code.add_edges_from((("f", k), ("j", j)) for j in face)
        # pendant nodes tell faces from links, and the outer face from the others
        code.add_edges_from((("f", k), ("p", k, n)) for n in range(2 + (k == outer)))
    return chain_id(code)
