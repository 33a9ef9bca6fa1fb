"""Contracted maps: contracted graphs drawn on the sphere in all ways; planar chains drawn; plane trees.

A chain drawn on the sphere becomes, when its binary links are taken out, a 2-connected map in which every link has
three joints or more, parallel joints allowed. Maps come from each other like the graphs of
`enumerate.contracted.graphs`: cubic ones with one more loop by a joint across a face, the others by contracting
joints, where a map is 2-connected as long as no face meets a link twice. Codes are those of
`enumerate.kernel.maps`.

The map of a chain has the links of its contracted map first, then the binary links, string after string. The
joints of a string follow each other from the link of its even dart to that of its odd dart. Theory:
docs/theory/sc-enumeration.md.
"""

from collections.abc import Iterator

import numpy as np

from enumerate.contracted.binary_links import Frame, rigid_sets
from enumerate.contracted.graphs import Growth, cheapest_degree
from enumerate.kernel._compiled import compiled, empty_set, insert
from enumerate.kernel.maps import END, JOINT, canonical_map, decode_map, faces_of, from_turns, symmetries_of_map
from enumerate.machine_code.weights import expect, placing
from graphs.types import Bytes, Ints

MOST_MAP_LOOPS = 9
"""The maps of all levels are held in memory: 4 million for ten loops."""


def contracted_maps(loops: int) -> Iterator[tuple[int, Bytes]]:
    """Yield all contracted maps with a number of loops, those of equally many links together, most links first.

    Parameters
    ----------
    loops : int
        Independent loops L, 2 to 9: the maps have L + 1 faces.

    Yields
    ------
    links : int
        n, from 2 (L - 1) down to 2.
    codes : uint8[k, 3 n + 2 (L - 1)]
        One row a map, no two equal or mirror images on the sphere; `enumerate.kernel.maps.decode_map` gives the
        map.

    Raises
    ------
    InvariantError
        If there are too few or too many loops.

    Examples
    --------
    >>> {links: len(codes) for links, codes in contracted_maps(4)}
    {6: 4, 5: 4, 4: 5, 3: 2, 2: 1}
    """
    expect(placing(loops, 1))
    two_links_with_three_joints = np.array([[JOINT, JOINT + 1, JOINT + 2, END, JOINT, JOINT + 2, JOINT + 1, END]])
    yield from Growth(MOST_MAP_LOOPS, two_links_with_three_joints.astype(np.uint8), _extend_all, _contract_all).levels(
        loops
    )


@compiled
def map_symmetries(turn: Ints, vertex: Ints) -> tuple[Ints, Ints]:
    """Return the symmetries of a map, whichever face lies outside, as permutations of darts and of corners."""
    _, orders, sides = _canonical(turn, vertex)
    return symmetries_of_map(turn, orders, sides)


@compiled
def _canonical(turn: Ints, vertex: Ints) -> tuple[Bytes, Ints, Ints]:
    """Return canonical code and readings; roots are picked by the degrees of the links and faces about a dart."""
    darts = len(vertex)
    # Any key that symmetries keep will do; with fewer roots of the least key, fewer readings are compared.
    face, _ = faces_of(turn)
    degree, length = np.bincount(vertex), np.bincount(face)
    key = np.zeros((2, darts), np.int64)
    for d in range(darts):
        ends = 256 * degree[vertex[d]] + degree[vertex[d ^ 1]]
        left, right = length[face[d]], length[face[d ^ 1]]
        key[0, d] = 256 * (256 * ends + left) + right
        key[1, d] = 256 * (256 * ends + right) + left
    none = np.zeros(darts, np.int64)
    return canonical_map(turn, vertex, none, face, none[:0], key)


@compiled
def _extend_all(parents: Bytes, links: int) -> Bytes:
    """Return the codes of the cubic maps with two links more than these: with a joint across a face."""
    table, rows, used = empty_set(parents.shape[1] + 8)
    for parent in range(len(parents)):
        turn, vertex, _ = decode_map(parents[parent])
        face, _ = faces_of(turn)
        darts = turn.shape[1]
        for d in range(darts):
            for e in range(d, darts):
                if face[d] == face[e]:
                    after, ends = _bridged(turn, vertex, links, d, e)
                    code, _, _ = _canonical(from_turns(after), ends)
                    table, rows, used = insert(table, rows, used, code)
    return rows[:used].copy()


@compiled
def _bridged(turn: Ints, vertex: Ints, links: int, d: int, e: int) -> tuple[Ints, Ints]:
    """Return ``turn[0]`` and ``vertex`` with new links on the joints of two darts of a face, and a joint between.

    The joint of d may be that of e; both new links are then on it.
    """
    darts = len(vertex)
    after, ends = _longer(turn, vertex, 6)
    across = darts + 4
    _subdivide(after, ends, d, darts, links, across)
    _subdivide(after, ends, darts if e == d else e, darts + 2, links + 1, across + 1)
    return after, ends


@compiled
def _longer(turn: Ints, vertex: Ints, more: int) -> tuple[Ints, Ints]:
    """Return copies of ``turn[0]`` and ``vertex`` with room for more darts."""
    darts = len(vertex)
    after, ends = np.empty(darts + more, np.int64), np.empty(darts + more, np.int64)
    for d in range(darts):
        after[d], ends[d] = turn[0, d], vertex[d]
    return after, ends


@compiled
def _subdivide(after: Ints, ends: Ints, d: int, new: int, link: int, across: int) -> None:
    """Put a link on the joint of dart d, with the dart ``across`` on the left of d; ``new`` leads on from there.

    The joint of d keeps its dart d; its other dart moves to the new link. ``new ^ 1`` takes its place.
    """
    back = d ^ 1
    before = back
    while after[before] != back:
        before = after[before]
    after[new ^ 1] = after[back] if before != back else new ^ 1
    if before != back:
        after[before] = new ^ 1
    ends[new ^ 1] = ends[back]
    ends[back] = ends[new] = ends[across] = link
    after[new], after[across], after[back] = across, back, new


@compiled
def _contract_all(parents: Bytes, links: int) -> Bytes:
    """Return the codes of the maps that contracting a joint of a map gives, one row each.

    Any link with four joints or more can be split in two. So of the ways to get a map, only those are taken that
    undo the splitting off of a ternary link from a link of the degree for which there are the fewest ways.
    """
    table, rows, used = empty_set(parents.shape[1] - 3)
    for parent in range(len(parents)):
        turn, vertex, _ = decode_map(parents[parent])
        darts = turn.shape[1]
        face, faces = faces_of(turn)
        meets, degree = np.zeros((faces, links), np.bool_), np.bincount(vertex)
        for d in range(darts):
            meets[face[d], vertex[d]] = True
        for d in range(0, darts, 2):
            u, v = vertex[d], vertex[d ^ 1]
            if degree[u] != 3 and degree[v] != 3:
                continue
            common = 0  # faces that meet both links; with a third, the one link would meet that face twice
            for f in range(faces):
                common += meets[f, u] and meets[f, v]
            if common == 2 and degree[u] + degree[v] - 2 == cheapest_degree(degree, u, v, True):
                after, ends = _contracted(turn, vertex, d)
                code, _, _ = _canonical(from_turns(after), ends)
                table, rows, used = insert(table, rows, used, code)
    return rows[:used].copy()


@compiled
def _contracted(turn: Ints, vertex: Ints, d: int) -> tuple[Ints, Ints]:
    """Return ``turn[0]`` and ``vertex`` without the joint of an even dart d, its two links made one."""
    darts, kept, gone = len(vertex), vertex[d], vertex[d ^ 1]
    after = np.empty(darts, np.int64)
    for k in range(darts):
        after[k] = turn[0, k]
    after[turn[1, d]] = turn[0, d ^ 1]
    after[turn[1, d ^ 1]] = turn[0, d]
    child, ends = np.empty(darts - 2, np.int64), np.empty(darts - 2, np.int64)
    for k in range(darts):
        if k >> 1 != d >> 1:
            link = kept if vertex[k] == gone else vertex[k]
            place = k - 2 * (k > d)
            child[place] = after[k] - 2 * (after[k] > d)
            ends[place] = link - (link > gone)
    return child, ends


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
def outer_frame(code: Bytes, n: int, outer: int) -> tuple[Frame, Ints]:
    """Return the frame of a contracted map, and where its symmetries take each face: int64[s, F].

    They keep the outer face, unless that is -1. No two joints count as parallel; what symmetries do to links is
    left out.
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
    sets, needs = rigid_sets(joint_matrix(code, n), n)
    nothing = np.zeros((0, n), np.uint8)
    return Frame(ends, np.arange(m), moved[:kept], nothing, sets, needs, n), faces[:kept]


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
        joints += int(x[e])
    image = np.empty(2 * m, np.int64)
    for e in range(m):
        image[2 * e] = 2 * offset[e]
        image[2 * e + 1] = 2 * (offset[e] + x[e]) + 1
    darts = 2 * joints
    after, ends, sides = np.empty(darts, np.int64), np.empty(darts, np.int64), np.empty(darts, np.int64)
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
    darts = 2 * links
    after, ends, sides = np.empty(darts, np.int64), np.empty(darts, np.int64), np.empty(darts, np.int64)
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


def plane_trees(links: int, most: int) -> Bytes:
    """Return the codes of all plane trees with N >= 2 links, none with more joints than a limit."""
    codes = np.array([[JOINT, END, JOINT, END]], np.uint8)
    for size in range(2, links):
        codes = _with_leaves(codes, size, most)
    return codes


@compiled
def _with_leaves(parents: Bytes, links: int, most: int) -> Bytes:
    """Return the codes of the trees with one leaf more."""
    table, rows, used = empty_set(parents.shape[1] + 3)
    for parent in range(len(parents)):
        turn, vertex, _ = decode_map(parents[parent])
        degree = np.bincount(vertex)
        for d in range(len(vertex)):
            if degree[vertex[d]] < most:
                after, ends = _with_leaf(turn, vertex, links, d)
                none = np.zeros(len(ends), np.int64)
                code, _, _ = code_of(from_turns(after), ends, none, none, none[:0], 0)
                table, rows, used = insert(table, rows, used, code)
    return rows[:used].copy()


@compiled
def _with_leaf(turn: Ints, vertex: Ints, links: int, corner: int) -> tuple[Ints, Ints]:
    """Return ``turn[0]`` and ``vertex`` with a leaf in a corner."""
    darts = len(vertex)
    after, ends = _longer(turn, vertex, 2)
    after[darts], after[corner], after[darts + 1] = turn[0, corner], darts, darts + 1
    ends[darts], ends[darts + 1] = vertex[corner], links
    return after, ends
