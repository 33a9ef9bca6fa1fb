"""A linkage as the page shows and moves it: what is seen of it, its spherical centres, and the data of the solver.

A crease pattern shows its panels, hinged solids the shapes of their links. Other linkages have axes only: each joint
shows a piece of its axis, each link the hull of the pieces of its joints, the least body that carries them. Links on a
cone or a cylinder are curved shells that lie over their arcs of it. Theory: docs/theory/viewer.md,
docs/theory/centre-classes.md.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from itertools import chain as chained, pairwise
from math import ceil
from typing import Any, Literal

import numpy as np
import scipy.sparse
from scipy.sparse.linalg import splu
from scipy.spatial import ConvexHull

from graphs.convert.duality import SheetMechanism
from graphs.geometry import lines_meet, principal_axes
from graphs.loops.classes import CentreClass
from graphs.loops.loop import Centre
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import Sheet, sides_of_face
from graphs.mechanism.solids import HingedSolids
from graphs.mechanism.surfaces import Cylinder, Surface
from graphs.plain_data import plain_data
from graphs.tolerances import DOUBLE, EPSILON, Tolerances
from graphs.types import Floats, Ints, LinkId
from synth.analysis.folding.configuration import SheetConfiguration
from synth.analysis.motion.closure import frames_of
from synth.analysis.motion.configuration import Configuration
from synth.analysis.motion.linkage import Linkage, LinkageLoop, joints_outwards
from synth.linkages.conformed.behaviours import link_arcs
from synth.linkages.conformed.linkage_behaviour import OnSurface
from synth.linkages.conformed.rates import ConformedChain
from synth.making.drawing.space.panels import joints_of_links, same_side_up
from synth.making.drawing.space.solids import faces_of_shapes

_HALF = 0.2
"""Half the length of the piece of an axis that is shown, in mean distances between the joints of a link."""
_FROM_APEX = (0.35, 1.0)
"""Distances from the common point of all axes between which each is shown."""
_FACET = np.pi / 60
"""Widest facet of a curved shell, radians of azimuth."""
_LAYER = 0.012
"""Distance between layers of links, in lengths of the ruling lines."""
_AXIS, _BODY = "-", "|"
"""Letters of lines that are not edges of a crease pattern: pieces of axes, sides of bodies."""


@dataclass(frozen=True, slots=True)
class Bodies:
    """Corners, float[V, 3], faces and lines at the configuration, in units of the extent, about the middle.

    Links and joints are indices, -1 for none: the owner of a corner is the link that carries it, a face is (link,
    vertices), and an edge (vertex, vertex, letter of the crease pattern's edge, joint). `surface` has the corners of
    triangles of the cone or cylinder on which the linkage lies, float[T, 3, 3]; None if it lies on none.
    """

    vertices: Floats
    owners: list[int]
    faces: list[tuple[int, list[int]]]
    edges: list[tuple[int, int, str, int]]
    surface: Floats | None = None

    def to_json(self) -> dict[str, Any]:
        """Return plain data: `BodyData` of web/src/page/types.js."""
        return {
            "vertices": self.vertices.tolist(),
            "owners": self.owners,
            "faces": [{"link": link, "vertices": around} for link, around in self.faces],
            "edges": [{"ends": [a, b], "letter": letter, "joint": joint} for a, b, letter, joint in self.edges],
            "surface": plain_data(self.surface),
        }


def bodies_of_sheet(sheet: Sheet, mechanism: SheetMechanism, linkage: Linkage) -> Bodies:
    """Return the panels of a crease pattern with coordinates and all its edges, with its mechanism and linkage."""
    assert sheet.coordinates is not None
    number = {joint: index for index, joint in enumerate(linkage.graph.joints)}
    joint_at = {frozenset(edge): number[joint] for joint, edges in mechanism.pieces.items() for edge in edges}
    owners = [-1] * sheet.vertices
    faces = []
    fronts = same_side_up(sheet.faces)
    places = in_space(sheet.coordinates)
    if sum(float(np.cross(places[a], places[b])[2]) for face in fronts for a, b in sides_of_face(face)) < 0.0:
        fronts = [face[::-1] for face in fronts]  # more of the fronts than of the backs is seen from above
    for link, panel in enumerate(mechanism.panels):
        for face in panel:
            faces.append((link, list(fronts[face])))
            for vertex in sheet.faces[face]:
                owners[vertex] = link if owners[vertex] < 0 else owners[vertex]
    edges = [
        (a, b, letter, joint_at.get(frozenset((a, b)), -1))
        for (a, b), letter in zip(sheet.edges, sheet.assignments, strict=True)
    ]
    local = (in_space(sheet.coordinates) - linkage.middle) / linkage.extent
    return Bodies(local, owners, faces, edges)


def bodies_of_linkage(linkage: Linkage) -> Bodies:
    """Return bodies that carry the axes of a linkage; a link with two skew axes is a tetrahedron."""
    number = {link: place for place, link in enumerate(linkage.graph.nodes)}
    ends = _pieces(linkage)
    vertices: list[Floats] = []
    owners: list[int] = []
    faces: list[tuple[int, list[int]]] = []
    edges: list[tuple[int, int, str, int]] = []
    shown: set[int] = set()
    for link, joints in joints_of_links(linkage).items():
        first = len(owners)
        corners = ends[joints].reshape(-1, 3)
        vertices.append(corners)
        owners += [number[link]] * len(corners)
        for place, joint in enumerate(joints):
            if joint not in shown:
                edges.append((first + 2 * place, first + 2 * place + 1, _AXIS, joint))
                shown.add(joint)
        hull = [[first + corner for corner in face] for face in hull_faces(corners)]
        faces += [(number[link], face) for face in hull]
        sides = {(min(side), max(side)) for face in hull for side in sides_of_face(face)}
        sides -= {(first + 2 * place, first + 2 * place + 1) for place in range(len(joints))}  # those are axes
        edges += [(a, b, _BODY, -1) for a, b in sorted(sides)]
    return Bodies(np.concatenate([np.zeros((0, 3)), *vertices]), owners, faces, edges)


def bodies_of_shapes(solids: HingedSolids, linkage: Linkage) -> Bodies:
    """Return the shapes of the links of hinged solids, and the piece of each axis at which there is material."""
    shown = faces_of_shapes(solids, linkage)
    corners, owners = [shown.corners], list(shown.owners)
    on_hinges: dict[int, list[int]] = {}
    for side, joint in shown.hinges.items():
        on_hinges.setdefault(joint, []).extend(side)
    edges = [(a, b, _BODY, -1) for a, b in shown.sides]
    pieces = _pieces(linkage)
    number = {link: place for place, link in enumerate(linkage.graph.nodes)}
    for joint, (first, _) in enumerate(linkage.graph.joints.values()):
        ends = pieces[joint]
        if joint in on_hinges:
            along = linkage.directions[joint]
            reach = (shown.corners[on_hinges[joint]] - linkage.points[joint]) @ along
            ends = linkage.points[joint] + np.array([[reach.min()], [reach.max()]]) * along
        edges.append((len(owners), len(owners) + 1, _AXIS, joint))
        owners += [number[first]] * 2
        corners.append(ends)
    return Bodies(np.concatenate(corners), owners, shown.faces, edges)


def bodies_on_surface(on_surface: OnSurface, linkage: Linkage) -> Bodies:
    """Return links as shells that lie over their arcs of a cone or a cylinder, in layers, and that surface."""
    surface = on_surface.surface
    assert surface is not None, "a linkage at a configuration lies on one surface"
    chain = ConformedChain.of(on_surface.chain)
    number = {link: place for place, link in enumerate(linkage.graph.nodes)}
    azimuths = np.remainder(np.asarray(on_surface.places, dtype=float), 2 * np.pi)
    arcs = link_arcs(chain, azimuths, on_surface.begins(chain))
    near, far = surface.spans
    vertices: list[Floats] = []
    owners: list[int] = []
    faces: list[tuple[int, list[int]]] = []
    edges: list[tuple[int, int, str, int]] = []
    shown: set[int] = set()
    for link, joints, (begin, length), layer in zip(chain.links, chain.joints_of, arcs, _layers(arcs), strict=True):
        first, owner = len(owners), number[link]
        inside = np.remainder(azimuths[list(joints)] - begin, 2 * np.pi)
        inside[inside > length + DOUBLE.same_configuration] = 0.0  # a full turn less rounding
        around = np.unique(np.concatenate([np.linspace(0.0, length, 1 + max(1, ceil(length / _FACET))), inside]))
        height = _LAYER * (layer + 1) * (far - near)
        vertices.append(surface.place(begin + around[:, None], np.array([[near, far]]), height).reshape(-1, 3))
        owners += [owner] * (2 * len(around))
        corner = range(first, first + 2 * len(around), 2)
        for a, b in pairwise(corner):
            faces.append((owner, [a, b, b + 1, a + 1]))
            edges += [(a, b, _BODY, -1), (a + 1, b + 1, _BODY, -1)]
        for joint, at in zip(joints, inside, strict=True):
            if joint not in shown:
                a = corner[int(np.abs(around - at).argmin())]
                edges.append((a, a + 1, _AXIS, joint))
                shown.add(joint)
    local = (np.concatenate(vertices) - linkage.middle) / linkage.extent
    return Bodies(local, owners, faces, edges, (_surface_triangles(surface) - linkage.middle) / linkage.extent)


def _layers(arcs: Floats) -> list[int]:
    """Return the layer of each link, the lowest in which its arc, float[N, 2], overlaps no arc before it."""
    layers: list[int] = []
    for place, (begin, length) in enumerate(arcs):
        taken = {
            layers[other]
            for other, (start, width) in enumerate(arcs[:place])
            if np.remainder(start - begin, 2 * np.pi) < length - DOUBLE.same_configuration
            or np.remainder(begin - start, 2 * np.pi) < width - DOUBLE.same_configuration
        }
        layers.append(next(layer for layer in range(place + 1) if layer not in taken))
    return layers


def _surface_triangles(surface: Surface) -> Floats:
    """Return triangles of a cone from its apex on, or of a cylinder, all round: float[T, 3, 3]."""
    near, far = surface.spans
    turns = np.linspace(0.0, 2 * np.pi, 1 + ceil(2 * np.pi / _FACET))
    low, high = (surface.place(turns, along, 0.0) for along in (near if isinstance(surface, Cylinder) else 0.0, far))
    one = np.stack([low[:-1], high[:-1], high[1:]], axis=1)
    other = np.stack([low[:-1], high[1:], low[1:]], axis=1)
    return np.concatenate([one, other])


def hull_faces(corners: Floats) -> list[list[int]]:
    """Return the faces of the convex hull of points, float[n, 3]: one polygon if planar, none if on a line."""
    if len(corners) < 3:
        return []
    sizes, axes = principal_axes(corners)
    spread = sizes > DOUBLE.same_point * max(float(sizes[0]), DOUBLE.same_point)
    if not spread[1]:
        return []
    if spread[2]:
        return [[int(corner) for corner in face] for face in ConvexHull(corners).simplices]
    around = [int(corner) for corner in ConvexHull(corners @ axes[:2].T).vertices]
    at = around.index(min(around))
    around = around[at:] + around[:at]
    return [around if around[1] < around[-1] else [around[0], *around[:0:-1]]]


def _pieces(linkage: Linkage) -> Floats:
    """Return the ends of the pieces of the axes that are shown: float[J, 2, 3]."""
    points, directions = linkage.points, linkage.directions
    if np.abs(points - points.mean(axis=0)).max(initial=0.0) <= DOUBLE.same_point:
        return points[:, None] + np.array(_FROM_APEX)[:, None] * directions[:, None]
    neighbours = [pair for joints in joints_of_links(linkage).values() for pair in pairwise(joints)]
    apart = np.array([np.linalg.norm(points[first] - points[second]) for first, second in neighbours])
    apart = apart[apart > DOUBLE.same_point]
    half = _HALF * (float(apart.mean()) if len(apart) else 1.0)
    return points[:, None] + np.array([-half, half])[:, None] * directions[:, None]


Kind = Literal["explicit", "implicit", "finite", "infinite"]


@dataclass(frozen=True, slots=True)
class ShownCentre:
    """The centre of a centre class, the joints whose axes pass through it, and a link that carries it.

    `CentreData` of the page. A vertex of panels round which a loop goes is explicit; a centre that the panels
    do not reach is implicit. Of other linkages, whose links have no shape, centres are finite, or infinite:
    the axes are parallel to `direction`. The place, float[3], is that at the configuration, in units of the
    extent, about the middle; for an infinite centre, a place among those of its axes that the link carries.
    Link and joints are indices; `loops` is a count.
    """

    kind: Kind
    place: Floats
    direction: Floats | None
    link: int
    joints: tuple[int, ...]
    loops: int


def centres_of(configuration: Configuration) -> tuple[ShownCentre, ...]:
    """Return the centres of a mechanism, one for each centre class."""
    at_vertices: set[int] = set()
    unreached: Kind = "finite"
    if isinstance(configuration, SheetConfiguration):
        mechanism = configuration.mechanism
        loops = len(mechanism.sc.loops)
        closing = range(loops, loops + len(mechanism.sc.closing))  # of closed surfaces: they go round vertices too
        at_vertices, unreached = {*range(len(mechanism.loop_vertices)), *closing}, "implicit"
    return tuple(
        _shown_centre(configuration.linkage, centre, "explicit" if at_vertices & set(centre.loops) else unreached)
        for centre in configuration.linkage.graph.centre_classes()
    )


def _shown_centre(linkage: Linkage, centre: CentreClass, finite: Kind) -> ShownCentre:
    number = {joint: index for index, joint in enumerate(linkage.graph.joints)}
    joints = sorted(number[joint] for joint in centre.joints)
    pairs = list(linkage.graph.joints.values())
    # the link with most of the joints carries the centre: their axes pass through it as the link moves
    carrier = Counter(link for joint in joints for link in pairs[joint]).most_common(1)[0][0]
    link = list(linkage.graph.nodes).index(carrier)
    points, directions = linkage.points[joints], linkage.directions[joints]
    if centre.centre is Centre.INFINITE:
        carried = [joint for joint in joints if carrier in pairs[joint]]
        middle = linkage.points[carried].mean(axis=0)  # among axes that the carrier takes along, so it stays there
        return ShownCentre("infinite", middle, directions[0], link, tuple(joints), len(centre.loops))
    place = lines_meet(points, directions).point
    return ShownCentre(finite, place, None, link, tuple(joints), len(centre.loops))


def solver_data(linkage: Linkage, *, limited: bool, ground: LinkId | None = None) -> dict[str, Any]:
    """Return plain data with which the page's solver moves a closed linkage.

    It is `LinkageData` of web/src/solver/types.js. Loops of one kind and length come together, so that residuals
    of both solvers have the same rows. `limited`: joints end at 180 degrees, where panels lie on each other;
    `ground` is the fixed link, by default the first. Angles are in radians, lengths in units of the extent. The
    tolerances are those of closed configurations, which are solved for in double precision whatever the file
    says.
    """
    number = {link: place for place, link in enumerate(linkage.graph.nodes)}
    tree = [
        (number[near], number[far], joint, int(sign)) for near, far, joint, sign in joints_outwards(linkage, ground)
    ]
    kinds: dict[tuple[Centre, int], list[LinkageLoop]] = {}
    for loop in linkage.loops:
        kinds.setdefault((loop.centre, len(loop.joints)), []).append(loop)
    return {
        "points": linkage.points.tolist(),
        "directions": linkage.directions.tolist(),
        "angles": linkage.angles.tolist(),
        "loops": [_loop(linkage, loop) for loops in kinds.values() for loop in loops],
        "order": factor_order(len(linkage.angles), [loop.joints for loop in linkage.loops]).tolist(),
        "limited": limited,
        "tree": tree,
        "links": len(number),
        "tolerances": asdict(Tolerances.of(EPSILON, len(linkage.angles))),
    }


def factor_order(joints: int, loops: Sequence[Sequence[int]]) -> Ints:
    """Return the index of each joint, int[J], in sparse factors of the normal equations, by minimum degree.

    The joints of a loop, indices, are neighbours. The page does not compute this order: minimum degree is not
    ported.
    """
    if not joints:
        return np.zeros(0, dtype=np.int64)
    columns = np.fromiter(chained.from_iterable(loops), dtype=np.int64)
    rows = np.repeat(np.arange(len(loops)), [len(loop) for loop in loops])
    seen = scipy.sparse.csr_matrix((np.ones(len(columns)), (rows, columns)), shape=(len(loops), joints))
    pattern = (seen.T @ seen + scipy.sparse.identity(joints)).tocsc()
    options = {"SymmetricMode": True}
    factors = splu(pattern, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)
    return np.asarray(factors.perm_c, dtype=np.int64)


def _loop(linkage: Linkage, loop: LinkageLoop) -> dict[str, Any]:
    parallel = loop.centre is Centre.INFINITE
    return {
        "joints": list(loop.joints),
        "signs": list(loop.signs),
        "centre": str(loop.centre.value),
        "frame": frames_of(linkage.directions[None, list(loop.joints)])[0].tolist() if parallel else None,
    }
