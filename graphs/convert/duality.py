"""From a sheet to its mechanism, by duality.

Panels are links, creases are joints and an interior vertex is a finite centre; leftover loops (holes, handles)
are spatial. Theory: docs/theory/crease-patterns.md.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass, field
from math import dist

import networkx as nx
import numpy as np

from graphs.convert.hinges import HingeLines, lines_of_hinges
from graphs.errors import InvariantError
from graphs.loops.cycle_space import split_dependent
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import FLAT, HINGES, Edge, Sheet, in_one_plane, sides_of_face

__all__ = ["SheetMechanism", "mechanism_of_sheet"]

ROUNDED = 1e-9
"""Panels farther off their planes than this, in units of their extent, are told of."""


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
        The vertex that is the centre of each loop of ``sc.loops``.
    repairs, warnings : tuple of str
    """

    sc: SCGraph
    panels: tuple[tuple[int, ...], ...]
    interior_vertices: int
    hinges: Mapping[int, Edge]
    loop_vertices: tuple[int, ...]
    repairs: tuple[str, ...] = ()
    warnings: tuple[str, ...] = field(default=())


def mechanism_of_sheet(sheet: Sheet, *, hinge_flat: bool = False) -> SheetMechanism:
    """Return the mechanism of a sheet.

    Parameters
    ----------
    sheet : Sheet
    hinge_flat : bool, optional
        Make hinges of flat edges too; without it they merge the faces they part.

    Returns
    -------
    SheetMechanism

    Raises
    ------
    InvariantError
        If an edge belongs to more than two faces.

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
    joint_of_edge, joints, idle, lines = _joints(sheet, faces_at, assignment, hinges, panel_of_face)
    if idle:
        notes.warnings.append(f"{idle} crease(s) end inside a panel and fold nothing")
    centre_of = _vertex_cycles(sheet, faces_at, joint_of_edge, panel_of_face)
    cycles = list(centre_of)
    kept, closing = split_dependent(cycles)
    sc = SCGraph(
        len(panels),
        joints,
        [Loop(cycles[i], Centre.FINITE) for i in kept],
        closing=[Loop(cycles[i], Centre.FINITE) for i in closing],
    )
    split = sum(joint is not None for joint in joint_of_edge.values()) - len(joints)
    if split:
        notes.repairs.append(f"{split} collinear split hinge(s) joined")
    notes.repairs += lines.repairs
    notes.warnings += lines.warnings
    if sheet.coordinates is not None and in_one_plane(sheet.coordinates):
        notes.warnings.append("flat state: the sheet has more infinitesimal freedoms as drawn than when folded")
    elif (off := _off_plane(sheet)) > ROUNDED:
        notes.warnings.append(f"rounded coordinates: a panel is off its plane by {off:.0e} of its size")
    return SheetMechanism(
        sc,
        panels,
        len(cycles),
        _hinge_ends(sheet, joint_of_edge),
        tuple(centre_of[cycles[i]] for i in kept),
        (*sheet.repairs, *notes.repairs),
        tuple(notes.warnings),
    )


def _hinge_ends(sheet: Sheet, joint_of_edge: Mapping[Edge, int | None]) -> dict[int, Edge]:
    """Return the ends of each joint; of a split hinge, those of its longest piece."""
    ends: dict[int, tuple[float, Edge]] = {}
    for (a, b), joint in joint_of_edge.items():
        if joint is None:
            continue
        length = 0.0 if sheet.coordinates is None else dist(sheet.coordinates[a], sheet.coordinates[b])
        if joint not in ends or length > ends[joint][0]:
            ends[joint] = length, (a, b)
    return {joint: edge for joint, (_, edge) in ends.items()}


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
        notes.repairs.append(f"{twice} edge(s) listed twice: a crease counts before a border or a flat edge")
    unlisted = cuts = 0
    for edge, here in faces_at.items():
        if len(here) > 2:
            raise InvariantError("edge of faces", f"the edge {edge} belongs to {len(here)} faces", "two at most")
        if edge not in assignment:
            assignment[edge] = ("U" if len(here) == 2 else "B", len(sheet.edges) + unlisted)
            unlisted += len(here) == 2
        cuts += len(here) == 2 and assignment[edge][0] in "BC"
    if unlisted:
        notes.repairs.append(
            f"{unlisted} side(s) between two faces not listed as edges: taken as unassigned creases"
        )
    if cuts:
        notes.warnings.append(f"{cuts} border or cut edge(s) between two faces: taken as cuts")
    return faces_at, assignment, notes


def _merge_flat(
    sheet: Sheet,
    faces_at: Mapping[Edge, list[int]],
    assignment: Mapping[Edge, tuple[str, int]],
    hinges: str,
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
    panel_of_face = [0] * len(sheet.faces)
    for panel, faces in enumerate(members.values()):
        for face in faces:
            panel_of_face[face] = panel
    return panel_of_face, tuple(tuple(faces) for faces in members.values())


def _joints(
    sheet: Sheet,
    faces_at: Mapping[Edge, list[int]],
    assignment: Mapping[Edge, tuple[str, int]],
    hinges: str,
    panel_of_face: Sequence[int],
) -> tuple[dict[Edge, int | None], dict[int, tuple[int, int]], int, HingeLines]:
    """Return the joint of each hinged edge (None for one inside a panel), the joints, how many are idle, lines."""
    joint_of_edge: dict[Edge, int | None] = {}
    between: dict[tuple[int, int], list[tuple[int, Edge]]] = defaultdict(list)
    idle = 0
    for edge, here in faces_at.items():
        letter, index = assignment[edge]
        if len(here) < 2 or letter not in hinges:
            continue
        a, b = panel_of_face[here[0]], panel_of_face[here[1]]
        if a == b:
            joint_of_edge[edge] = None
            idle += 1
        else:
            between[(a, b) if a < b else (b, a)].append((index, edge))
    joints: dict[int, tuple[int, int]] = {}
    bundles = sorted((sorted(hinged), pair) for pair, hinged in between.items())
    lines = lines_of_hinges(sheet.coordinates, [[edge for _, edge in hinged] for hinged, _ in bundles])
    for (hinged, pair), groups in zip(bundles, lines.groups, strict=True):
        for group in groups:
            first, _ = hinged[group[0]]
            joints[first] = pair
            for place in group:
                joint_of_edge[hinged[place][1]] = first
    return joint_of_edge, joints, idle, lines


def _vertex_cycles(
    sheet: Sheet,
    faces_at: Mapping[Edge, list[int]],
    joint_of_edge: Mapping[Edge, int | None],
    panel_of_face: Sequence[int],
) -> dict[tuple[int, ...], int]:
    """Return the cycles of joints round the interior vertices, and the vertex of each.

    The faces at a vertex form fans; a fan that closes is an interior vertex. Where a panel comes back to the
    vertex (its faces are merged elsewhere) the walk falls into several cycles with the same centre.
    """
    cycles: list[tuple[tuple[int, ...], int]] = []
    for vertex, fan in _closed_fans(sheet, faces_at):
        walk: list[tuple[int, int]] = []  # (panel entered, joint crossed into it)
        for edge, face in fan:
            if edge in joint_of_edge:
                joint = joint_of_edge[edge]
                if joint is not None:
                    walk.append((panel_of_face[face], joint))
            elif len({panel_of_face[f] for f in faces_at[edge]}) > 1:
                break  # a cut: the fan is open after all
        else:
            cycles += [(cycle, vertex) for cycle in _simple_cycles(walk)]
    # Hinges that are one joint may meet another joint twice; the loop of the two is one loop.
    distinct = {frozenset(cycle): (cycle, vertex) for cycle, vertex in reversed(cycles)}
    return dict(list(distinct.values())[::-1])


def _closed_fans(sheet: Sheet, faces_at: Mapping[Edge, list[int]]) -> list[tuple[int, list[tuple[Edge, int]]]]:
    """Return each vertex with faces all round, with its edges and the faces entered across them, in order."""
    at_vertex: dict[int, list[tuple[int, Edge, Edge]]] = defaultdict(list)
    for index, around in enumerate(sheet.faces):
        sides = [(a, b) if a < b else (b, a) for a, b in sides_of_face(around)]
        for i, vertex in enumerate(around):
            at_vertex[vertex].append((index, sides[i - 1], sides[i]))
    fans = []
    for centre, corners in at_vertex.items():
        sides_of = {face: (one, two) for face, one, two in corners}
        left = dict.fromkeys(sides_of)
        while left:
            start = next(iter(left))
            fan: list[tuple[Edge, int]] = []
            edge, face = sides_of[start][1], start
            while True:
                left.pop(face, None)
                here = faces_at[edge]
                if len(here) < 2:
                    _drop_fan(start, sides_of, faces_at, left)
                    break
                face = here[0] if here[1] == face else here[1]
                fan.append((edge, face))
                if face == start:
                    fans.append((centre, fan))
                    break
                one, two = sides_of[face]
                edge = two if edge == one else one
    return fans


def _drop_fan(
    start: int,
    sides_of: Mapping[int, tuple[Edge, Edge]],
    faces_at: Mapping[Edge, list[int]],
    left: dict[int, None],
) -> None:
    """Take the other half of an open fan off the list."""
    face, edge = start, sides_of[start][0]
    while True:
        beyond = [f for f in faces_at[edge] if f != face]
        if not beyond:
            return
        face = beyond[0]
        left.pop(face, None)
        one, two = sides_of[face]
        edge = two if edge == one else one


def _simple_cycles(walk: Sequence[tuple[int, int]]) -> list[tuple[int, ...]]:
    """Cut a closed walk of (panel entered, joint crossed) into cycles that visit each panel once."""
    if len({panel for panel, _ in walk}) == len(walk):
        around = tuple(joint for _, joint in walk)
        return [around] if len(set(around)) == len(around) > 1 else []
    cycles: list[tuple[int, ...]] = []
    path: list[tuple[int, int]] = []
    entered: dict[Hashable, int] = {walk[-1][0]: 0}  # the walk starts in the panel it ends in
    for panel, joint in walk:
        path.append((panel, joint))
        if panel in entered:
            start = entered[panel]
            part = path[start:]
            del path[start:]
            for inner, _ in part:
                if inner != panel:
                    entered.pop(inner, None)
            around = tuple(j for _, j in part)
            if len(set(around)) == len(around) > 1:
                cycles.append(around)
        else:
            entered[panel] = len(path)
    return cycles


def _off_plane(sheet: Sheet) -> float:
    """Return how far the first four vertices of a panel are off a plane at most, in units of their extent."""
    if sheet.coordinates is None:
        return 0.0
    quads = [face[:4] for face in sheet.faces if len(face) > 3]
    if not quads:
        return 0.0
    corners = np.asarray(sheet.coordinates, dtype=float)[np.array(quads)]
    arms = corners[:, 1:] - corners[:, :1]
    sizes = np.linalg.norm(arms, axis=2).max(axis=1)
    volumes = np.abs(np.linalg.det(arms))
    return float(np.max(volumes / np.maximum(sizes, 1e-300) ** 3))
