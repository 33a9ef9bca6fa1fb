"""A sheet opened along its cuts.

A drawing gives the two sides of a slit one edge, or two that share their ends; so may parts that meet in a corner:
what comes apart on folding gets vertices of its own. Theory: docs/theory/folding.md.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

import networkx as nx

from graphs.convert.duality import SheetMechanism
from graphs.mechanism.sheet import Edge, Sheet, sides_of_face


def opened(sheet: Sheet, mechanism: SheetMechanism) -> Sheet:
    """Return a sheet in which panels share a vertex only if hinges join them there; new edges come last."""
    beside: dict[frozenset[int], list[int]] = {}
    for face, around in enumerate(sheet.faces):
        for side in sides_of_face(around):
            beside.setdefault(frozenset(side), []).append(face)
    corners = _corners(sheet, mechanism, beside)
    place: dict[tuple[int, int], int] = {}
    of: list[int] = list(range(sheet.vertices))  # the vertex that each was
    seen: set[int] = set()
    for together in nx.connected_components(corners):
        first = min(together, key=lambda corner: corner[1])
        vertex = first[0]
        if vertex in seen:
            of.append(vertex)
        here = len(of) - 1 if vertex in seen else vertex
        seen.add(vertex)
        place |= dict.fromkeys(together, here)
    if len(of) == sheet.vertices:
        return sheet
    faces = tuple(tuple(place[vertex, face] for vertex in sheet.faces[face]) for face in range(len(sheet.faces)))
    edges, letters, angles = _edges(sheet, place, beside)
    coordinates = None if sheet.coordinates is None else tuple(sheet.coordinates[vertex] for vertex in of)
    parted = replace(sheet, vertices=len(of), edges=edges, assignments=letters, faces=faces)
    return replace(parted, coordinates=coordinates, fold_angles=angles)


def _corners(sheet: Sheet, mechanism: SheetMechanism, beside: Mapping[frozenset[int], Sequence[int]]) -> nx.Graph:
    """Return the corners (vertex, face), joined where hinges or panels join the faces."""
    link_of = {face: link for link, faces in enumerate(mechanism.panels) for face in faces}
    hinges = {frozenset(edge) for pieces in mechanism.pieces.values() for edge in pieces}
    corners = nx.Graph()
    corners.add_nodes_from((vertex, face) for face, around in enumerate(sheet.faces) for vertex in around)
    for edge, faces in beside.items():
        for face, other in pairwise(faces):
            if edge in hinges or link_of[face] == link_of[other]:
                corners.add_edges_from(((vertex, face), (vertex, other)) for vertex in edge)
    return corners


def _edges(
    sheet: Sheet, place: Mapping[tuple[int, int], int], beside: Mapping[frozenset[int], Sequence[int]]
) -> tuple[tuple[Edge, ...], str, tuple[float | None, ...] | None]:
    """Return the edges with their new ends; those that two sides of a cut shared once more, at the end."""
    edges, more = [], []
    for number, (a, b) in enumerate(sheet.edges):
        ends = dict.fromkeys((place[a, face], place[b, face]) for face in beside.get(frozenset((a, b)), ()))
        first, *others = ends or [(a, b)]
        edges.append(first)
        more += [(other, number) for other in others]
    angles = sheet.fold_angles
    letters = sheet.assignments + "".join(sheet.assignments[number] for _, number in more)
    every = None if angles is None else (*angles, *(angles[number] for _, number in more))
    return (*edges, *(edge for edge, _ in more)), letters, every
