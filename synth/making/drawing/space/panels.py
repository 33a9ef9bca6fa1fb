"""Objects in space: panels hidden by those before them and shaded by the light, seen by an eye far away.

Hinged solids are drawn as the hulls of their hinges: a link with two hinges is a tetrahedron on them, or a plate
where they are parallel, which is what kaleidocycles and the linkages of Sarrus are made of. A file has axes only;
hinges are put where the axes of a link come nearest to each other.
"""

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from graphs.convert.duality import SheetMechanism, mechanism_of_sheet
from graphs.geometry import across, area_vector, frame_about, principal_axes, unit
from graphs.mechanism.sheet import Sheet, sides_of_face, with_all_edges
from graphs.tolerances import DOUBLE, trailing
from graphs.types import Floats, JointId, LinkId
from synth.analysis.folding.configuration import SheetConfiguration
from synth.analysis.motion.linkage import Linkage, link_motions
from synth.making.drawing.scene.shapes import FINE, NORMAL, STRONG, Line, Point, Polygon, Shape

HINGE = "H"
"""The letter of an edge that is a hinge of solids."""
INNER = "I"
"""The letter of a side of a triangle inside a plane face, which is not drawn."""
_LETTERS = {"M": "mountain", "V": "valley", "U": "ink", "C": "cut", "B": "ink", HINGE: "class1"}
_LIGHT = unit([0.35, -0.45, 0.82])
_DARKEST = 0.5
"""Opacity of the shadow on a panel edge-on to the light."""
_HALF = 0.5
"""Half the length of a hinge, in units of the median distance of neighbouring ones."""
_APART, _HALF_APART = 1.0, 0.35
"""Where all axes pass through one point: distance of hinges from it; half their length."""
_EYE = np.array([0.40, 0.62, 0.68])
"""Direction to the eye, along the axes in which an object is long, less long, and short."""
_ASLANT = np.array([0.41, -0.71, 0.57])
"""Direction to the eye for motions: 35 degrees above the ground."""


@dataclass(frozen=True, slots=True)
class View:
    """An eye far away: `right` and `up` in the picture, and `towards` the eye, unit vectors, float[3]."""

    right: Floats
    up: Floats
    towards: Floats

    def places(self, points: Floats) -> Floats:
        """Return points as they are seen: float[..., 2], x to the right and y upwards."""
        return np.asarray(points @ np.column_stack([self.right, self.up]))

    def near(self, points: Floats) -> Floats:
        """Return the nearness of points to the eye: float[...]."""
        return np.asarray(points @ self.towards)


def view_from(towards: Floats, upright: Floats) -> View:
    """Return the view from a direction, another one being upwards: float[3] of any length, not parallel."""
    towards, up = unit(towards), unit(across(upright, towards))
    return View(np.cross(up, towards), up, towards)


def view_from_above(points: Floats) -> View:
    """Return the view of points, float[n, 3], from above the plane in which they spread most.

    Points in a plane are seen straight from above.
    """
    axes, flat = _axes(points)
    return view_from(axes[2], axes[1]) if flat else view_from(axes.T @ _EYE, axes[2])


def _axes(points: Floats) -> tuple[Floats, bool]:
    """Return the directions in which points are long, less long and short; and whether they lie in a plane."""
    if len(points) < 3:
        return np.eye(3), False
    sizes, axes = principal_axes(points)
    if np.linalg.det(axes) < 0:
        axes[1] = -axes[1]
    return axes, bool(sizes[2] < DOUBLE.flat * sizes[0])


def view_of_motion(points: Floats) -> View:
    """Return the view of a motion from the points, float[n, 3], of its first frame.

    It is aslant from above their plane, or with z upwards if they lie in no plane.

    >>> view = view_of_motion(np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]]))
    >>> view.up.round(2).tolist()
    [-0.29, 0.49, 0.82]
    """
    axes, flat = _axes(points)
    upright = axes[2] if flat else np.array([0.0, 0.0, 1.0])
    # on the ground the axis of the coordinates that lies flattest: those of a square would be any
    ahead = unit(across(np.eye(3)[trailing(np.abs(upright))], upright))
    return view_from(_ASLANT @ np.stack([ahead, np.cross(upright, ahead), upright]), upright)


def drawn_order(places: Floats, near: Floats, faces: Sequence[Sequence[int]]) -> list[int]:
    """Return faces (vertex cycles) in the order in which they are drawn: those behind first.

    `places`, float[n, 2], are the vertices as they are seen, `near`, float[n], their nearness to the eye. Faces
    that overlap are compared where they do; if that goes round in a circle, which it can among three faces, the
    farthest of them is drawn first.
    """
    from shapely import STRtree
    from shapely.geometry import Polygon as Area

    areas = [Area(places[list(face)]).buffer(0) for face in faces]
    behind: dict[int, set[int]] = {i: set() for i in range(len(faces))}
    least = 1e-6 * float(np.ptp(places, axis=0).max() or 1.0) ** 2
    for a, b in zip(*STRtree(areas).query(areas, predicate="intersects"), strict=True):
        if a >= b:
            continue
        common = areas[a].intersection(areas[b])
        if common.area <= least:
            continue
        spot = common.representative_point()
        at = np.array([spot.x, spot.y])
        heights = [_height(at, places[list(faces[i])], near[list(faces[i])]) for i in (a, b)]
        if abs(heights[0] - heights[1]) > 1e-9 * max(1.0, abs(heights[0])):
            front, back = (int(a), int(b)) if heights[0] > heights[1] else (int(b), int(a))
            behind[front].add(back)
    order: list[int] = []
    left = sorted(behind, key=lambda i: (float(near[list(faces[i])].mean()), i))
    done: set[int] = set()
    while left:
        ready = next((i for i in left if behind[i] <= done), left[0])
        left.remove(ready)
        done.add(ready)
        order.append(ready)
    return order


def _height(at: Floats, corners: Floats, near: Floats) -> float:
    """Return the nearness of a panel to the eye at a place, by the plane through its corners."""
    terms = np.column_stack([corners, np.ones(len(corners))])
    plane = np.linalg.lstsq(terms, near, rcond=None)[0]
    return float(plane @ np.array([*at, 1.0]))


@dataclass(frozen=True, slots=True)
class SpatialPanels:
    """Faces of a sheet, or of solids, that can be drawn in space at any configuration.

    `faces` are the vertices round each panel, the front of all on one side of the paper; a set of two vertices
    has its joint and its letter. `solid`: faces are those of solids, their front outside, and those that look
    away from the eye are hidden.
    """

    faces: Sequence[Sequence[int]]
    link_of: Mapping[int, LinkId]
    joint_of: Mapping[frozenset[int], JointId]
    letters: Mapping[frozenset[int], str]
    solid: bool = False


def sheet_and_mechanism(sheet: Sheet | SheetConfiguration) -> tuple[Sheet, SheetMechanism]:
    """Return a sheet as it was read, and its mechanism, which a configuration holds."""
    if isinstance(sheet, SheetConfiguration):
        return sheet.drawn, sheet.dual
    return sheet, mechanism_of_sheet(sheet)


def panels_of(sheet: Sheet | SheetConfiguration) -> SpatialPanels:
    """Return the panels of a sheet."""
    drawn, mechanism = sheet_and_mechanism(sheet)
    whole = with_all_edges(drawn)
    letters = {frozenset(edge): letter for edge, letter in zip(whole.edges, whole.assignments, strict=True)}
    return SpatialPanels(
        same_side_up(whole.faces),
        {face: link for link, faces in enumerate(mechanism.panels) for face in faces},
        {frozenset(edge): joint for joint, edges in mechanism.pieces.items() for edge in edges},
        letters,
    )


def same_side_up(faces: Sequence[Sequence[int]]) -> list[tuple[int, ...]]:
    """Return faces turned over where needed, so that those side by side show the same side of the paper.

    The first of each piece stays as it is. A strip that is twisted into itself has one side only: somewhere on it
    the colours change.
    """
    beside: dict[frozenset[int], list[int]] = {}
    for number, face in enumerate(faces):
        for side in sides_of_face(face):
            beside.setdefault(frozenset(side), []).append(number)
    turned: dict[int, tuple[int, ...]] = {}
    for first in range(len(faces)):
        if first in turned:
            continue
        turned[first] = tuple(faces[first])
        waiting = deque([first])
        while waiting:
            here = waiting.popleft()
            for a, b in sides_of_face(turned[here]):
                for other in beside[frozenset((a, b))]:
                    if other not in turned:
                        same = (a, b) in sides_of_face(faces[other])
                        turned[other] = tuple(faces[other][::-1] if same else faces[other])
                        waiting.append(other)
    return [turned[number] for number in range(len(faces))]


def front_up(panels: SpatialPanels, points: Floats, view: View) -> SpatialPanels:
    """Return panels with the sides exchanged if more of the backs than of the fronts would be seen."""
    if sum(float(area_vector(points[list(face)]) @ view.towards) for face in panels.faces) >= 0:
        return panels
    return replace(panels, faces=[tuple(face[::-1]) for face in panels.faces])


def panel_shapes(
    panels: SpatialPanels, points: Floats, view: View, page: Sequence[Point]
) -> tuple[list[Shape], dict[int, list[Point]]]:
    """Return the shapes of panels, those behind first; and the places of the corners of each, in this order.

    Points are float[n, 3]; `page` are the places of the vertices on the page.
    """
    shapes: list[Shape] = []
    corners: dict[int, list[Point]] = {}
    seen = list(range(len(panels.faces)))
    if panels.solid:  # faces that look away from the eye are hidden
        seen = [face for face in seen if float(area_vector(points[list(panels.faces[face])]) @ view.towards) > 0]
    for place in drawn_order(view.places(points), view.near(points), [panels.faces[face] for face in seen]):
        face = seen[place]
        row = panels.faces[face]
        normal = _normal(points[list(row)])
        corners[face] = [page[v] for v in row]
        link = panels.link_of.get(face)
        data = () if link is None else (("link", str(link)),)
        side = "front" if float(normal @ view.towards) >= 0 else "back"
        dark = _DARKEST * (1.0 - abs(float(normal @ _LIGHT)))
        shapes.append(Polygon(corners[face], side, None, data=data))
        shapes.append(Polygon(corners[face], "shadow", None, opacity=dark))
        shapes += [
            _edge(panels, (a, b), [page[a], page[b]])
            for a, b in sides_of_face(row) if panels.letters.get(frozenset((a, b))) != INNER
        ]  # fmt: skip
    return shapes, corners


def _edge(panels: SpatialPanels, ends: tuple[int, int], row: list[Point]) -> Line:
    """Return a side of a panel: a hinge in the colour of its letter, another side fine."""
    joint = panels.joint_of.get(frozenset(ends))
    colour = _LETTERS.get(panels.letters.get(frozenset(ends), "B"), "grey")
    if joint is None:
        return Line(row, colour, FINE)
    width = STRONG if colour == _LETTERS[HINGE] else NORMAL
    return Line(row, colour, width, data=(("joint", str(joint)),))


def _normal(corners: Floats) -> Floats:
    """Return the unit normal of a panel; zeros if it has no area."""
    area = area_vector(corners)
    has_area = np.linalg.norm(area) > DOUBLE.same_point * float(np.ptp(corners)) ** 2
    return unit(area) if has_area else np.zeros(3)


def bodies_of(linkage: Linkage) -> tuple[SpatialPanels, Floats]:
    """Return the faces of all links, their front outside, and the corners at the configuration: float[2 J, 3].

    Corners 2 j and 2 j + 1 are the ends of hinge j, in units of the extent. A link with one hinge has no body.
    """
    corners = hinge_ends(linkage).reshape(-1, 3)
    faces: list[tuple[int, ...]] = []
    link_of: dict[int, LinkId] = {}
    for link, hinges in joints_of_links(linkage).items():
        own = [2 * hinge + end for hinge in hinges for end in (0, 1)]
        for face in _hull(corners[own]):
            link_of[len(faces)] = link
            faces.append(tuple(own[corner] for corner in face))
    joint_of = {frozenset((2 * i, 2 * i + 1)): joint for i, joint in enumerate(linkage.graph.joints)}
    return SpatialPanels(faces, link_of, joint_of, dict.fromkeys(joint_of, HINGE), solid=True), corners


def places_of_hinges(linkage: Linkage, angles: Floats) -> Floats:
    """Return the ends of hinges in many configurations, float[F, 2 J, 3], numbered as in `bodies_of`.

    Joint angles are float[F, J], radians.
    """
    motions = link_motions(linkage, angles)
    places = [
        ends @ np.swapaxes(motions[first][0], 1, 2) + motions[first][1][:, None]
        for ends, (first, _) in zip(hinge_ends(linkage), linkage.graph.joints.values(), strict=True)
    ]
    return np.concatenate(places, axis=1)


def hinge_ends(linkage: Linkage) -> Floats:
    """Return the ends of the piece of each axis that is drawn: float[J, 2, 3].

    Its middle is that of the feet of the common perpendiculars to the other axes of the two links.
    """
    hinges_of = joints_of_links(linkage)
    neighbours = [
        sorted({other for link in ends for other in hinges_of[link]} - {hinge})
        for hinge, ends in enumerate(linkage.graph.joints.values())
    ]
    feet = [
        [_foot(linkage, hinge, other) for other in others] or [linkage.points[hinge]]
        for hinge, others in enumerate(neighbours)
    ]
    middles = np.array([np.mean(each, axis=0) for each in feet]).reshape(-1, 3)
    apart = [
        float(np.linalg.norm(middles[i] - middles[j])) for i, others in enumerate(neighbours) for j in others if i < j
    ]
    half = _HALF * float(np.median(apart)) if apart else _HALF
    if half < DOUBLE.same_point:
        middles, half = middles + _APART * linkage.directions, _HALF_APART
    along = half * linkage.directions
    return np.stack([middles - along, middles + along], axis=1)


def joints_of_links(linkage: Linkage) -> dict[LinkId, list[int]]:
    """Return the indices of the joints of each link."""
    joints_of: dict[LinkId, list[int]] = {link: [] for link in linkage.graph.nodes}
    for joint, ends in enumerate(linkage.graph.joints.values()):
        for link in ends:
            joints_of[link].append(joint)
    return joints_of


def _foot(linkage: Linkage, hinge: int, other: int) -> Floats:
    """Return the point of an axis nearest to another; to a parallel one, nearest to its reference point."""
    p, d = linkage.points[hinge], linkage.directions[hinge]
    q, e = linkage.points[other], linkage.directions[other]
    across = np.cross(d, e)
    square = float(across @ across)
    if square < DOUBLE.parallel:
        return np.asarray(p + ((q - p) @ d) * d)
    return np.asarray(p + float(np.cross(q - p, e) @ across) / square * d)


def _hull(corners: Floats) -> list[list[int]]:
    """Return the faces of the hull of points, counter-clockwise seen from outside; of a plate its two sides."""
    if len(corners) < 3:
        return []
    sizes, axes = principal_axes(corners)
    if sizes[1] < DOUBLE.same_point * max(sizes[0], DOUBLE.same_point):
        return []
    if sizes[2] < DOUBLE.flat * sizes[0]:
        front = _around(corners, list(range(len(corners))), axes[2])
        return [front, front[::-1]]
    from scipy.spatial import ConvexHull

    hull = ConvexHull(corners)
    sides: dict[tuple[float, ...], set[int]] = {}
    for triangle, plane in zip(hull.simplices.tolist(), hull.equations, strict=True):
        sides.setdefault(tuple((plane.round(6) + 0.0).tolist()), set()).update(triangle)
    return [_around(corners, sorted(side), np.array(plane[:3])) for plane, side in sides.items()]


def _around(corners: Floats, chosen: Sequence[int], normal: Floats) -> list[int]:
    """Return the outer corners of points in a plane, counter-clockwise about its normal."""
    from scipy.spatial import ConvexHull

    flat = corners[list(chosen)] @ frame_about(normal)[:2].T
    return [chosen[corner] for corner in ConvexHull(flat).vertices.tolist()]
