"""From a sheet to its mechanism, by duality; a sheet opened along its cuts.

Panels are links, creases are joints and an interior vertex is a finite centre. Loops round holes and cuts have a
centre where their axes are parallel or meet; other loops are spatial. A drawing gives the two sides of a slit one edge,
or two that share their ends; so may parts that meet in a corner: what comes apart on folding gets vertices of its own.
Theory: docs/theory/crease-patterns.md, docs/theory/folding.md.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain, pairwise
from math import dist

import networkx as nx
import numpy as np
import scipy

from graphs.convert.cycles import HingedFaces, boundary_cycles, loops_with_centres, vertex_cycles
from graphs.convert.hinges import HingeLines, lines_of_hinges
from graphs.errors import InvariantError, numbered
from graphs.loops.loop import Centre, Loop, added_independent, split_dependent
from graphs.mechanism.precision import off_panel_planes, precision_of
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import FLAT, HINGES, Edge, Sheet, corners_of_faces, panel_of_faces, sides_of_face
from graphs.tolerances import DOUBLE
from graphs.types import Ints


@dataclass(frozen=True)
class SheetMechanism:
    """The mechanism of a sheet.

    Attributes
    ----------
    sc : SCGraph
        Links are numbered in the order of the faces; joint ids are edge indices (the first of a split hinge).
    panels : tuple of tuple of int
        The faces that make up each link.
    interior_vertices : int
        Vertices with a loop of hinges round them.
    hinges : mapping of joint id to (vertex, vertex)
        The ends of each joint; of a split hinge, those of its longest piece.
    loop_vertices : tuple of int
        The vertex that is the centre of each of the first loops of ``sc.loops``; others have theirs by geometry.
    repairs, warnings : tuple of str
    pieces : mapping of joint id to tuple of (vertex, vertex)
        All the edges that make up each joint: more than one of a split hinge.

    Examples
    --------
    Four triangles round vertex 0:

    >>> mechanism = mechanism_of_sheet(Sheet(5, (), "", ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))))
    >>> mechanism.interior_vertices, mechanism.loop_vertices, len(mechanism.hinges)
    (1, (0,), 4)
    """

    sc: SCGraph
    panels: tuple[tuple[int, ...], ...]
    interior_vertices: int
    hinges: Mapping[int, Edge]
    loop_vertices: tuple[int, ...]
    repairs: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    pieces: Mapping[int, tuple[Edge, ...]] = field(default_factory=dict)


def mechanism_of_sheet(sheet: Sheet, *, hinge_flat: bool = False, geometry: bool = True) -> SheetMechanism:
    """Return the mechanism of a sheet.

    Parameters
    ----------
    sheet : Sheet
        InvariantError if an edge belongs to more than two faces.
    hinge_flat : bool, optional
        Make hinges of flat edges too; without it they merge the faces they part.
    geometry : bool, optional
        Give loops along boundaries the centre where their axes meet or are parallel, if the sheet has coordinates.

    Examples
    --------
    >>> from graphs.count.report import mobility_report
    >>> fan = Sheet(5, ((0, 1), (0, 2), (0, 3), (0, 4)), "MVVV", ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)))
    >>> mobility_report(mechanism_of_sheet(fan).sc).mobility
    1
    """
    hinges = HINGES + ("F" if hinge_flat else "")
    faces_at, assignment, notes = _edges_of_faces(sheet)
    panel_of_face, panels = _merge_flat(sheet, faces_at, assignment, hinges)
    joint_of_edge, joints, inside, lines = _joints(sheet, faces_at, assignment, hinges, panel_of_face)
    if len(panels) == 1 and not joints:
        notes.warnings.append("one panel: no crease joins it to another")
    if inside:
        notes.warnings.append(f"{numbered(inside, 'crease')} inside a panel: no effect on folding")
    hinged = HingedFaces(faces_at, joint_of_edge, panel_of_face)
    centre_of = vertex_cycles(sheet, hinged)
    cycles = list(centre_of)
    kept, closing = split_dependent(cycles)
    sc = SCGraph(
        len(panels),
        joints,
        [Loop(cycles[i], Centre.FINITE) for i in kept],
        closing=[Loop(cycles[i], Centre.FINITE) for i in closing],
    )
    pieces = _pieces(joint_of_edge)
    places = sheet.coordinates or ((),) * sheet.vertices
    ends = {
        joint: some[0] if len(some) == 1 else max(some, key=lambda ends: dist(*(places[v] for v in ends)))
        for joint, some in pieces.items()
    }
    if geometry and sheet.coordinates is not None and sc.spatial_loops:
        sc = _with_loops(sc, loops_with_centres(sheet, boundary_cycles(sheet, hinged), ends), notes)
    split = sum(joint is not None for joint in joint_of_edge.values()) - len(joints)
    if split:
        notes.repairs.append(f"{numbered(split, 'collinear split hinge')} joined")
    notes.repairs += lines.repairs
    notes.warnings += lines.warnings
    if (off := off_panel_planes(sheet)) > DOUBLE.same_point:
        notes.warnings.append(f"rounded coordinates: a panel is off its plane by {off:.0e} of the extent")
    return SheetMechanism(
        sc,
        panels,
        len(cycles),
        ends,
        tuple(centre_of[cycles[i]] for i in kept),
        (*sheet.repairs, *notes.repairs),
        tuple(notes.warnings),
        pieces,
    )


def _pieces(joint_of_edge: Mapping[Edge, int | None]) -> dict[int, tuple[Edge, ...]]:
    """Return the edges that make up each joint."""
    pieces: dict[int, tuple[Edge, ...]] = {}
    for edge, joint in joint_of_edge.items():
        if joint is not None:
            pieces[joint] = (*pieces.get(joint, ()), edge)
    return pieces


def _with_loops(sc: SCGraph, loops: Sequence[Loop], notes: _Notes) -> SCGraph:
    """Add loops that are independent of the present ones and do not contradict their centres; note them."""
    added = {Centre.FINITE: 0, Centre.INFINITE: 0}
    for loop in loops:
        if not added_independent([one.joints for one in sc.loops], [loop.joints]):
            continue
        try:
            more = SCGraph(sc.nodes, sc.joints, [*sc.loops, loop], closing=sc.closing)
            more.centre_classes()
        except InvariantError as error:
            notes.warnings.append(f"geometry: {loop.label} stays spatial: {error}")
            continue
        sc = more
        added[loop.centre] += 1
    for centre, meet in ((Centre.INFINITE, "are parallel: planar"), (Centre.FINITE, "meet in a point: spherical")):
        if added[centre]:
            notes.warnings.append(f"geometry: the axes of {numbered(added[centre], 'loop')} round holes or cuts {meet}")
    return sc


@dataclass
class _Notes:
    repairs: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)


def _edges_of_faces(sheet: Sheet) -> tuple[dict[Edge, list[int]], dict[Edge, tuple[str, int]], _Notes]:
    """Return the faces at each edge, and the assignment and index of each edge."""
    notes = _Notes()
    faces_at: dict[Edge, list[int]] = defaultdict(list)
    for index, face in enumerate(sheet.faces):
        for a, b in sides_of_face(face):
            faces_at[(a, b) if a < b else (b, a)].append(index)
    assignment: dict[Edge, tuple[str, int]] = {}
    twice = 0
    for index, ((a, b), letter) in enumerate(zip(sheet.edges, sheet.assignments, strict=True)):
        edge = (a, b) if a < b else (b, a)
        if edge not in assignment:
            assignment[edge] = (letter, index)
            continue
        twice += 1
        if letter in HINGES and assignment[edge][0] not in HINGES:
            assignment[edge] = (letter, assignment[edge][1])
    if twice:
        notes.repairs.append(f"{numbered(twice, 'edge')} listed twice: a crease counts before a border or a flat edge")
    unlisted = cuts = 0
    for edge, here in faces_at.items():
        if len(here) > 2:
            raise InvariantError("edge of faces", f"the edge {edge} belongs to {len(here)} faces", "two at most")
        if edge not in assignment:
            assignment[edge] = ("U" if len(here) == 2 else "B", len(sheet.edges) + unlisted)
            unlisted += len(here) == 2
        cuts += len(here) == 2 and assignment[edge][0] in "BC"
    loose = sum(letter in HINGES and edge not in faces_at for edge, (letter, _) in assignment.items())
    if loose:
        notes.warnings.append(f"{numbered(loose, 'crease line')} on no face dropped")
    if unlisted:
        notes.repairs.append(
            f"{numbered(unlisted, 'side')} between two faces not listed as edges: taken as unassigned creases"
        )
    if cuts:
        notes.warnings.append(f"{numbered(cuts, 'border or cut edge')} between two faces: taken as cuts")
    return faces_at, assignment, notes


def _merge_flat(
    sheet: Sheet, faces_at: Mapping[Edge, list[int]], assignment: Mapping[Edge, tuple[str, int]], hinges: str
) -> tuple[list[int], tuple[tuple[int, ...], ...]]:
    """Merge faces across flat edges; return the panel of each face, and the faces of each panel."""
    if not any(letter in sheet.assignments for letter in FLAT if letter not in hinges):
        return list(range(len(sheet.faces))), tuple((face,) for face in range(len(sheet.faces)))
    merged = nx.utils.UnionFind(range(len(sheet.faces)))
    for edge, here in faces_at.items():
        letter = assignment[edge][0]
        if len(here) == 2 and letter in FLAT and letter not in hinges:
            merged.union(*here)
    members: dict[int, list[int]] = {}
    for face in range(len(sheet.faces)):
        members.setdefault(merged[face], []).append(face)
    number = {root: panel for panel, root in enumerate(members)}
    return [number[merged[face]] for face in range(len(sheet.faces))], tuple(map(tuple, members.values()))


def _joints(
    sheet: Sheet,
    faces_at: Mapping[Edge, list[int]],
    assignment: Mapping[Edge, tuple[str, int]],
    hinges: str,
    panel_of_face: Sequence[int],
) -> tuple[dict[Edge, int | None], dict[int, tuple[int, int]], int, HingeLines]:
    """Return the joint of each hinged edge (None inside a panel), the joints, how many are inside, and lines."""
    joint_of_edge: dict[Edge, int | None] = {}
    between: dict[tuple[int, int], list[tuple[int, Edge]]] = defaultdict(list)
    inside = 0
    for edge, here in faces_at.items():
        letter, index = assignment[edge]
        if len(here) < 2 or letter not in hinges:
            continue
        a, b = panel_of_face[here[0]], panel_of_face[here[1]]
        if a == b:
            joint_of_edge[edge] = None
            inside += 1
        else:
            between[(a, b) if a < b else (b, a)].append((index, edge))
    joints: dict[int, tuple[int, int]] = {}
    bundles = sorted((sorted(hinged), pair) for pair, hinged in between.items())
    rounding = 0.0 if sheet.coordinates is None else precision_of(sheet.coordinates).size
    edges = [[edge for _, edge in hinged] for hinged, _ in bundles]
    lines = lines_of_hinges(sheet.coordinates, edges, rounding=rounding)
    for (hinged, pair), groups in zip(bundles, lines.groups, strict=True):
        for group in groups:
            first, _ = hinged[group[0]]
            joints[first] = pair
            for place in group:
                joint_of_edge[hinged[place][1]] = first
    return joint_of_edge, joints, inside, lines


def opened(sheet: Sheet, mechanism: SheetMechanism) -> Sheet:
    """Return a sheet in which panels share a vertex only if hinges join them there; new edges come last."""
    if _corners_together(sheet, mechanism) == len(set(chain.from_iterable(sheet.faces))):
        return sheet
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


def _corners_together(sheet: Sheet, mechanism: SheetMechanism) -> int:
    """Return the number of groups of corners that `_corners` joins: that of the vertices where none comes apart."""
    vertex, after, face = corners_of_faces(sheet.faces)
    panel = panel_of_faces(mechanism.panels)[face]

    def key(ends: Ints) -> Ints:
        return np.asarray(ends.min(axis=1) * sheet.vertices + ends.max(axis=1))

    sides = key(np.stack([vertex, vertex[after]], axis=1))
    pieces = list(chain.from_iterable(mechanism.pieces.values()))
    hinged = np.isin(sides, key(np.array(pieces, dtype=np.int64).reshape(-1, 2)))
    order = np.argsort(sides, kind="stable")  # the faces at a side stay in their order
    one, other = order[:-1], order[1:]
    beside = (sides[one] == sides[other]) & (hinged[one] | (panel[one] == panel[other]))
    one, other = one[beside], other[beside]
    straight = vertex[one] == vertex[other]  # both faces pass the side in one direction
    begins, ends = np.where(straight, other, after[other]), np.where(straight, after[other], other)
    pairs = np.concatenate([one, after[one]]), np.concatenate([begins, ends])
    joined = scipy.sparse.csr_matrix((np.ones(len(pairs[0])), pairs), shape=(len(vertex),) * 2)
    return int(scipy.sparse.csgraph.connected_components(joined, directed=False)[0])


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
