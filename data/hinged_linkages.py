"""Linkages with the axes of their joints, for data/linkages/: closed loops that move although counts say no.

Bennett's, Bricard's, kaleidocycles and Sarrus's panels are made by `synth.catalogue.patterns`; angles and lengths are chosen here.
"""

from __future__ import annotations

from itertools import product
from math import cos, dist, sin, sqrt

from graphs.convert.conversions import Mechanism
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from synth.catalogue.patterns.hinged_rings import (
    bennett,
    kaleidocycle,
    line_symmetric,
    plane_symmetric,
    ring,
    sarrus as sarrus_panels,
    trihedral,
)
from synth.catalogue.patterns.panels import sheet_of_faces
from synth.catalogue.patterns.platforms import platform


def sarrus() -> HingedSolids:
    """Return the linkage of Sarrus by its axes: three along x, then three along y."""
    x, y = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
    return ring(
        [((0, 1, 0), x), ((0, 1.6, 0.8), x), ((0, 1, 1.6), x), ((1.2, 0, 1.6), y), ((2.1, 0, 0.8), y), ((1.2, 0, 0), y)]
    )


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
    return sheet_of_faces(points, faces, "Wampler 2007, Fig. 1")


def locked_cube() -> PolyhedronModel:
    """Return Wampler's collapsible cube, locked: the edges of a cube, and a rod from its middle to each corner."""
    corners = dict(enumerate(product((-1.0, 1.0), repeat=3)))
    edges = [(a, b) for a in corners for b in range(a) if dist(corners[a], corners[b]) == 2.0]
    return PolyhedronModel(9, [*edges, *((v, 8) for v in corners)], coordinates={**corners, 8: (0.0, 0.0, 0.0)})


LINKAGES: dict[str, Mechanism] = {
    "bennett.json": bennett(1.0, 0.7, 1.2),
    "bricard-line-symmetric.json": line_symmetric(),
    "bricard-plane-symmetric.json": plane_symmetric(),
    "bricard-trihedral.json": trihedral(),
    "kaleidocycle-6.json": kaleidocycle(6),
    "kaleidocycle-7.json": kaleidocycle(7),
    "kaleidocycle-8.json": kaleidocycle(8),
    "sarrus.json": sarrus(),
    "sarrus-panels.fold": sarrus_panels(),
    "stewart.json": platform("UPS", 6, 1.0, 0.6, 1.0, gap=0.5),
    "wampler-fig1-open.fold": fig_1(0.5),
    "wampler-fig1-folded.fold": fig_1(0.0, 0.7),
    "wampler-fig1-coplanar.fold": fig_1(0.0),
    "wampler-cube-locked.json": locked_cube(),
}
"""Name of a file to what it holds."""
