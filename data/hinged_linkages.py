"""Linkages with the axes of their joints, for data/linkages/: closed loops that move although counts say no.

Sources: G. T. Bennett, "A new mechanism" (1903); R. Bricard, "Lecons de cinematique" (1927), three of his mobile
hexagons; kaleidocycles, P. Schatz (1929); P. T. Sarrus (1853). Angles and lengths are chosen here.
"""

from __future__ import annotations

from itertools import product
from math import atan2, cos, dist, hypot, pi, sin, sqrt, tan

import numpy as np

from graphs.convert.table import Mechanism
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids

Point = tuple[float, ...]
Line = tuple[Point, Point]

_DIGITS = 14
"""Special proportions are kept to these: rounding more would close the loops at one pose only."""


def ring(lines: list[Line]) -> HingedSolids:
    """Return a ring of solids with the given axes: joint i turns solid i against solid i - 1."""
    n = len(lines)
    chain = SCGraph(n, [((i - 1) % n, i) for i in range(n)])
    return HingedSolids(chain, {i: (_rounded(point), _rounded(along)) for i, (point, along) in enumerate(lines)})


def bennett(first: float = 1.0, twists: tuple[float, float] = (0.7, 1.2)) -> HingedSolids:
    """Return Bennett's linkage: opposite solids alike, lengths in proportion to the sines of the twists."""
    a, b = twists
    second = 2 * atan2(sin((b + a) / 2), sin((b - a) / 2) * tan(first / 2))
    frame, lines = np.eye(4), []
    for angle, twist in zip((first, second, 2 * pi - first, 2 * pi - second), (a, b, a, b), strict=True):
        lines.append((tuple(frame[:3, 3]), tuple(frame[:3, 2])))
        step = np.eye(4)
        step[0, 3] = sin(twist)
        frame = frame @ _turned(angle, 2) @ step @ _turned(twist, 0)
    return ring(lines)


def line_symmetric() -> HingedSolids:
    """Return Bricard's line-symmetric linkage: half a turn about the z axis takes axes 0, 1, 2 to 3, 4, 5."""
    half: list[Line] = [
        ((1, 0, 0.2), (0.3, 1, 2)),
        ((0.6, 1.1, -0.1), (1, -0.4, 0.7)),
        ((-0.7, 0.9, 0.5), (1, 1, -1)),
    ]
    return ring([*half, *(((-x, -y, z), (-u, -v, w)) for (x, y, z), (u, v, w) in half)])


def plane_symmetric() -> HingedSolids:
    """Return Bricard's plane-symmetric linkage: axes 0 and 3 in the plane y = 0, 5 and 4 the images of 1 and 2."""
    first, last = ((1.2, 0, 0), (0.4, 0, 1)), ((-1, 0, 0.3), (-0.5, 0, 1))
    half: list[Line] = [((0.7, 0.9, 0.1), (1, 0.3, 0.8)), ((-0.5, 1.1, -0.2), (0.2, 1, 1.1))]
    images = [((x, -y, z), (u, -v, w)) for (x, y, z), (u, v, w) in half]
    return ring([first, *half, last, images[1], images[0]])


def trihedral() -> HingedSolids:
    """Return Bricard's trihedral linkage: right twists, no offsets, the squares of alternate lengths alike in sum.

    Axes 0, 2, 4 have the directions of the corners of a spherical triangle, 1, 3, 5 those of its polar triangle.
    Each side goes across its two axes; three lengths close the hexagon, and then the sums are equal.
    """
    a, b, c = (np.array(one) / hypot(*one) for one in ((4.0, 1.0, 0.0), (-1.0, 3.0, 1.0), (0.0, -1.0, 3.0)))
    across = _around(a, b, c)
    lengths = _closing(np.cross(across, np.roll(across, -1, axis=0)))
    return _right_angled(across, lengths)


def kaleidocycle(solids: int, tilt: float = 0.9) -> HingedSolids:
    """Return a ring of an even number of solids with right twists and lengths 1, turned inside out so far."""
    m = solids // 2
    corners = [np.array((sin(tilt) * cos(t), sin(tilt) * sin(t), cos(tilt))) for t in np.arange(m) * 2 * pi / m]
    return _right_angled(_around(*corners), np.tile([1.0, -1.0], m))


def kaleidocycle_of_seven() -> HingedSolids:
    """Return a ring of seven solids with right twists and lengths 1: closed by Newton's method."""
    angles = np.array([2.2, -2.0, 1.9, -2.3, 2.1, -1.8, 2.4])
    for _ in range(60):
        end = _end_of(angles)
        slopes = np.array([(_end_of(angles + d) - _end_of(angles - d)) / 2e-6 for d in 1e-6 * np.eye(7)]).T
        angles = angles - np.linalg.lstsq(slopes, end, rcond=None)[0]
    frame, lines = np.eye(4), []
    for angle in angles:
        lines.append((tuple(frame[:3, 3]), tuple(frame[:3, 2])))
        frame = frame @ _link(angle)
    return ring([(_rounded(point, 12), _rounded(along, 12)) for point, along in lines])


def sarrus() -> HingedSolids:
    """Return the linkage of Sarrus by its axes: three along x, then three along y."""
    x, y = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
    return ring(
        [
            ((0, 1, 0), x),
            ((0, 1.6, 0.8), x),
            ((0, 1, 1.6), x),
            ((1.2, 0, 1.6), y),
            ((2.1, 0, 0.8), y),
            ((1.2, 0, 0), y),
        ]
    )


def sarrus_panels() -> Sheet:
    """Return the linkage of Sarrus of six panels: two plates, and two pairs of panels between them."""
    out = 0.6
    corners = [(x, y, z) for z in (0.0, 1.6) for x, y in ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))]
    knees = [(0.0, -out, 0.8), (1.0, -out, 0.8), (1.0 + out, 0.0, 0.8), (1.0 + out, 1.0, 0.8)]
    faces = ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 9, 8), (8, 9, 5, 4), (1, 2, 11, 10), (10, 11, 6, 5))
    return _panels((*corners, *knees), faces, "Linkage of Sarrus")


def fig_1(opening: float, flap: float = 0.0) -> Sheet:
    """Return Wampler's Fig. 1: two rectangles hinged on GH, a pair of triangles at either end.

    The rectangles stand at ``opening`` to their mirror plane. At 0 they lie on each other, and the lower pair of
    triangles may be turned by ``flap`` about its side.
    """
    width, height, corner = 1.0, 1.5, 1.1
    x, y = width * cos(opening), width * sin(opening)
    reach = cos(corner) / cos(opening)
    drop = sqrt(1 - reach * reach)
    low = (reach, drop * sin(flap), -drop * cos(flap))
    points = [
        low,
        (x, y, 0),
        (x, y, height),
        (reach, 0, height + drop),
        (x, -y, height),
        (x, -y, 0),
        (0, 0, 0),
        (0, 0, height),
    ]
    a, b, c, d, e, f, g, h = range(8)
    faces = ((b, c, h, g), (f, e, h, g), (a, g, b), (a, g, f), (d, h, c), (d, h, e))
    return _panels(tuple(points), faces, "Wampler 2007, Fig. 1")


def locked_cube() -> PolyhedronModel:
    """Return Wampler's collapsible cube, locked: the edges of a cube, and a rod from its middle to each corner."""
    corners = dict(enumerate(product((-1.0, 1.0), repeat=3)))
    edges = [(a, b) for a in corners for b in range(a) if dist(corners[a], corners[b]) == 2.0]
    return PolyhedronModel(9, [*edges, *((v, 8) for v in corners)], coordinates={**corners, 8: (0.0, 0.0, 0.0)})


def _around(*corners: np.ndarray) -> np.ndarray:
    """Return directions round a spherical polygon: a corner, the pole of its side, the next corner, ..."""
    directions = []
    for here, there in zip(corners, (*corners[1:], corners[0]), strict=True):
        pole = np.cross(here, there)
        directions += [here, pole / np.linalg.norm(pole)]
    return np.array(directions)


def _right_angled(across: np.ndarray, lengths: np.ndarray) -> HingedSolids:
    """Return a ring with axes along directions, each across the next; solid i has a length along their product."""
    sides = lengths[:, None] * np.cross(across, np.roll(across, -1, axis=0))
    feet = np.concatenate([np.zeros((1, 3)), np.cumsum(sides, axis=0)[:-1]])
    assert abs(sides.sum(axis=0)).max() < 1e-12, "the ring does not close"
    return ring([(tuple(foot), tuple(along)) for foot, along in zip(feet, across, strict=True)])


def _closing(sides: np.ndarray) -> np.ndarray:
    """Return six lengths along given directions that close, the first three chosen."""
    chosen = np.array([1.0, 0.8, 1.3])
    return np.concatenate([chosen, -np.linalg.solve(sides[3:].T, sides[:3].T @ chosen)])


def _link(angle: float) -> np.ndarray:
    step = np.eye(4)
    step[0, 3] = 1.0
    return _turned(angle, 2) @ step @ _turned(pi / 2, 0)


def _end_of(angles: np.ndarray) -> np.ndarray:
    """Return what does not close of a chain of solids with right twists and lengths 1: six numbers."""
    frame = np.eye(4)
    for angle in angles:
        frame = frame @ _link(angle)
    return np.array(
        [*frame[:3, 3], frame[2, 1] - frame[1, 2], frame[0, 2] - frame[2, 0], frame[1, 0] - frame[0, 1]]
    )


def _turned(angle: float, axis: int) -> np.ndarray:
    made = np.eye(4)
    a, b = [(1, 2), (2, 0), (0, 1)][axis]
    made[a, a] = made[b, b] = cos(angle)
    made[a, b], made[b, a] = -sin(angle), sin(angle)
    return made


def _rounded(vector: Point, digits: int = _DIGITS) -> Point:
    return tuple(round(float(x), digits) + 0.0 for x in vector)


def _panels(points: tuple[Point, ...], faces: tuple[tuple[int, ...], ...], title: str) -> Sheet:
    sides: dict[tuple[int, int], int] = {}
    for face in faces:
        for a, b in zip(face, face[1:] + face[:1], strict=True):
            sides[min(a, b), max(a, b)] = sides.get((min(a, b), max(a, b)), 0) + 1
    letters = "".join("U" if number == 2 else "B" for number in sides.values())
    return Sheet(len(points), tuple(sides), letters, faces, tuple(map(_rounded, points)), title)


LINKAGES: dict[str, Mechanism] = {
    "bennett.json": bennett(),
    "bricard-line-symmetric.json": line_symmetric(),
    "bricard-plane-symmetric.json": plane_symmetric(),
    "bricard-trihedral.json": trihedral(),
    "kaleidocycle-6.json": kaleidocycle(6),
    "kaleidocycle-7.json": kaleidocycle_of_seven(),
    "kaleidocycle-8.json": kaleidocycle(8),
    "sarrus.json": sarrus(),
    "sarrus-panels.fold": sarrus_panels(),
    "wampler-fig1-open.fold": fig_1(0.5),
    "wampler-fig1-folded.fold": fig_1(0.0, 0.7),
    "wampler-fig1-coplanar.fold": fig_1(0.0),
    "wampler-cube-locked.json": locked_cube(),
}
"""Name of a file to what it holds."""
