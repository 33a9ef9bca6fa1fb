"""Chains drawn on the sphere: contracted maps with binary links on their joints, compiled.

A chain has the links of its contracted map first, then the binary links, string after string. The joints of a
string follow each other from the link of its even dart to that of its odd dart. Theory:
docs/theory/sc-enumeration.md.
"""

from __future__ import annotations

import numpy as np

from enumerate.contracted.binary_links import rigid_sets
from enumerate.contracted.maps import map_symmetries
from enumerate.kernel.compiled import compiled
from enumerate.kernel.maps import canonical_map, decode_map, faces_of, from_turns
from graphs.types import Bytes, Ints

__all__ = ["code_of", "expanded", "joint_matrix", "outer_faces", "outer_frame", "ring", "sets_of"]


@compiled
def outer_faces(code: Bytes) -> Ints:
    """Return one face of each orbit of faces of a contracted map: those that can be the outer one."""
    turn, vertex, _ = decode_map(code)
    face, faces = faces_of(turn)
    _, corners = map_symmetries(turn, vertex)
    least = np.arange(faces)
    for a in range(len(corners)):
        for d in range(len(face)):
            least[face[d]] = min(least[face[d]], face[corners[a, d]])
    return np.flatnonzero(least == np.arange(faces))


@compiled
def outer_frame(code: Bytes, outer: int) -> tuple[Bytes, Bytes, Ints]:
    """Return of a contracted map the links of its joints, and its symmetries that keep a face, the identity first.

    Symmetries are where they take each joint, uint8[s, m], and each face, int64[s, F]; all of them if the face is
    -1.
    """
    turn, vertex, _ = decode_map(code)
    face, count = faces_of(turn)
    darts, corners = map_symmetries(turn, vertex)
    m = len(vertex) // 2
    ends = np.empty((m, 2), np.uint8)
    for e in range(m):
        ends[e, 0], ends[e, 1] = vertex[2 * e], vertex[2 * e + 1]
    moved = np.empty((len(darts), m), np.uint8)
    faces = np.empty((len(darts), count), np.int64)
    kept = 0
    for a in range(len(darts)):
        for d in range(2 * m):
            faces[kept, face[d]] = face[corners[a, d]]
        if outer >= 0 and faces[kept, outer] != outer:
            continue
        for e in range(m):
            moved[kept, e] = darts[a, 2 * e] >> 1
        kept += 1
    return ends, moved[:kept], faces[:kept]


@compiled
def sets_of(code: Bytes, n: int) -> tuple[Ints, Ints]:
    """Return the sets of links that could become rigid, and what each needs, as `rigid_sets` does."""
    return rigid_sets(joint_matrix(code, n), n)


@compiled
def joint_matrix(code: Bytes, n: int) -> Bytes:
    """Return the numbers of joints between the links of a map: uint8[n, n]."""
    _, vertex, _ = decode_map(code)
    adjacency = np.zeros((n, n), np.uint8)
    for d in range(len(vertex)):
        adjacency[vertex[d], vertex[d ^ 1]] += 1
    return adjacency


@compiled
def expanded(code: Bytes, n: int, x: Bytes) -> tuple[Ints, Ints, Ints]:
    """Return the map of a chain: turn int64[2, D], vertex int64[D] and the face of each dart int64[D].

    Faces have the numbers that they have in the contracted map.
    """
    turn, vertex, _ = decode_map(code)
    face, _ = faces_of(turn)
    m = len(x)
    joints = m
    offset = np.empty(m, np.int64)
    for e in range(m):
        offset[e] = 0 if e == 0 else offset[e - 1] + x[e - 1] + 1
        joints += x[e]
    image = np.empty(2 * m, np.int64)
    for e in range(m):
        image[2 * e] = 2 * offset[e]
        image[2 * e + 1] = 2 * (offset[e] + x[e]) + 1
    after, ends, sides = (
        np.empty(2 * joints, np.int64),
        np.empty(2 * joints, np.int64),
        np.empty(2 * joints, np.int64),
    )
    for d in range(2 * m):
        after[image[d]] = image[turn[0, d]]
        ends[image[d]] = vertex[d]
    link = n
    for e in range(m):
        for k in range(offset[e], offset[e] + x[e] + 1):
            sides[2 * k], sides[2 * k + 1] = face[2 * e], face[2 * e + 1]
        for k in range(offset[e], offset[e] + x[e]):
            ends[2 * k + 1] = ends[2 * k + 2] = link
            after[2 * k + 1], after[2 * k + 2] = 2 * k + 2, 2 * k + 1
            link += 1
    return from_turns(after), ends, sides


@compiled
def ring(links: int) -> tuple[Ints, Ints, Ints]:
    """Return the map of a chain of one loop, as `expanded` does; face 0 is the outer one."""
    after, ends, sides = (
        np.empty(2 * links, np.int64),
        np.empty(2 * links, np.int64),
        np.empty(2 * links, np.int64),
    )
    for k in range(links):
        following = 2 * ((k + 1) % links)
        ends[2 * k], ends[2 * k + 1] = k, (k + 1) % links
        after[2 * k + 1], after[following] = following, 2 * k + 1
        sides[2 * k], sides[2 * k + 1] = 0, 1
    return from_turns(after), ends, sides


@compiled
def code_of(
    turn: Ints, vertex: Ints, open_edges: Ints, face: Ints, labels: Ints, outer: int
) -> tuple[Bytes, Ints, Ints]:
    """Return the canonical code of a map with an outer face, as `canonical_map` does; roots lie beside it."""
    key = np.full((2, len(vertex)), -1, np.int64)
    for d in range(len(vertex)):
        if face[d] == outer:
            key[0, d] = 0
            key[1, turn[0, d]] = 0
    return canonical_map(turn, vertex, open_edges, face, labels, key)
