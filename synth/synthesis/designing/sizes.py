"""Wishes about sizes and shape: boxes of configurations; arcs of links; area, edges, corners, symmetry of a sheet.

Theory: docs/theory/design.md.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import cos, pi, sin
from typing import Literal

import numpy as np

from graphs.errors import InvariantError, UnsolvableError
from graphs.geometry import crossing
from graphs.mechanism.sheet import Sheet
from graphs.tolerances import DOUBLE
from graphs.types import Floats, Ints
from synth.synthesis.designing.placement import Derived, DesignConfiguration, DesignFrame
from synth.synthesis.designing.quadrilaterals import IMAGINARY, cell_curvatures
from synth.synthesis.designing.wishes import Goal, GoalWish, PointsWish, ShapeWish, Wish

Size = Literal["longest", "area", "radius"]
"""The longest edge of the box along principal axes, the product of its two longest, or the largest distance from the
middle."""


def _measured_size(which: Size, places: Derived, thickness: float) -> Derived:
    """Return the size of points, where the outermost ones are unique; edges are at least so long as the thickness."""
    points = places.values.reshape(-1, 3)
    count = len(points)
    centred = points - points.mean(axis=0)
    centring = (np.eye(count) - 1.0 / count)[:, None, :, None] * np.eye(3)[:, None, :]
    middle = centring.reshape(3 * count, 3 * count)
    if which == "radius":
        distances = np.linalg.norm(centred, axis=1)
        far = int(distances.argmax())
        along = centred[far] / distances[far]
        return places.through(np.array([distances[far]]), along[None] @ middle[3 * far : 3 * far + 3])
    values, axes = np.linalg.eigh(centred.T @ centred)
    edges, slopes = np.zeros(3), np.zeros((3, 3 * count))
    for place in range(3):
        along = centred @ axes[:, place]
        ends = (int(along.argmax()), int(along.argmin()))
        edges[place] = along[ends[0]] - along[ends[1]]
        slopes[place, 3 * ends[0] : 3 * ends[0] + 3] += axes[:, place]
        slopes[place, 3 * ends[1] : 3 * ends[1] + 3] -= axes[:, place]
        span = centred[ends[0]] - centred[ends[1]]
        for other in range(3):  # how the principal axis turns
            if other != place and abs(values[place] - values[other]) > DOUBLE.zero * values[2]:
                both = np.outer(axes[:, other], axes[:, place])
                turn = (centred @ (both + both.T)).ravel() / (values[place] - values[other])
                slopes[place] += (span @ axes[:, other]) * turn
        if edges[place] < thickness:
            edges[place], slopes[place] = thickness, 0.0
    slopes = slopes @ middle
    order = np.argsort(edges)[::-1]
    if which == "longest":
        return places.through(edges[order[:1]], slopes[order[:1]])
    first, second = order[:2]
    product = edges[second] * slopes[first] + edges[first] * slopes[second]
    return places.through(np.array([edges[first] * edges[second]]), product[None])


@dataclass(frozen=True, kw_only=True)
class BoxSize(GoalWish, PointsWish):
    """How large a configuration is: `longest`, `area` or `radius` of some points, by default all vertices.

    Attributes
    ----------
    at : str
        Name of a configuration.
    size_of : {"longest", "area", "radius"}
    goal : Goal
    points : tuple of DesignPoint
    thickness : float
        Edges of the box are at least so long.
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> print(BoxSize(at="stowed", size_of="radius", goal=Goal(at_most=1.0)))
    radius at stowed
    """

    size_of: Size
    thickness: float = 0.0

    def scale(self, extent: float) -> float:
        """Return the unit of its misses."""
        return extent**2 if self.size_of == "area" else extent

    def measured(self, configuration: DesignConfiguration) -> Derived:
        """Return the size."""
        return _measured_size(
            self.size_of, configuration.places(self.measured_points(configuration.frame)), self.thickness
        )

    def __str__(self) -> str:
        return f"{self.size_of} at {self.at}"


@dataclass(frozen=True, kw_only=True)
class SizeRatio(PointsWish):
    """The size at one configuration over that at another: stowed over deployed.

    Attributes
    ----------
    at : str
        Name of a configuration.
    over : str
        Name of the other configuration.
    size_of : {"longest", "area", "radius"}
    goal : Goal
    points : tuple of DesignPoint
    thickness : float
        Edges of the box are at least so long.
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> print(SizeRatio(at="stowed", over="deployed", size_of="area", goal=Goal(at_most=0.2)))
    area at stowed over deployed
    """

    over: str
    size_of: Size
    goal: Goal
    thickness: float = 0.0

    @property
    def configurations(self) -> tuple[str, ...]:
        """Both configurations."""
        return (self.at, self.over)

    def misses(self, configurations: Mapping[str, DesignConfiguration]) -> dict[str, Derived]:
        """Return how far the ratio is off, by both configurations."""
        points = self.measured_points(configurations[self.at].frame)
        one, other = (
            _measured_size(self.size_of, configurations[name].places(points), self.thickness)
            for name in self.configurations
        )
        ratio = one.values / other.values
        off = self.goal.misses(ratio)
        on = 1.0 if self.goal.equals is not None else (off != 0.0).astype(float)
        by = (on / other.values)[:, None]
        less = -by * ratio[:, None]
        numbers = by * one.by_numbers + less * other.by_numbers
        return {
            self.at: Derived(off, by * one.by_angles, numbers),
            self.over: Derived(off, less * other.by_angles, np.zeros_like(numbers)),
        }

    def __str__(self) -> str:
        return f"{self.size_of} at {self.at} over {self.over}"


@dataclass(frozen=True, kw_only=True)
class LinkArc(GoalWish, ShapeWish):
    """The angle between two axes of a link, radians.

    Attributes
    ----------
    at : str
        Name of a configuration.
    joints : (str, str)
    goal : Goal
        Radians.
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> print(LinkArc(joints=("0", "1"), goal=Goal(equals=1.0)))
    arc between joints 0 and 1
    """

    joints: tuple[str, str]
    unit = "angle"

    def check(self, frame: DesignFrame) -> None:
        """Check the joints: they must be on one link."""
        places = [frame.joint(name) for name in self.joints]
        if not set(frame.graph.joints[frame.joints[places[0]]]) & set(frame.graph.joints[frame.joints[places[1]]]):
            raise InvariantError("arc", f"joints {' and '.join(self.joints)} are on no one link", "two of one link")

    def measured(self, configuration: DesignConfiguration) -> Derived:
        """Return the arc."""
        first, second = (configuration.frame.joint(name) for name in self.joints)
        dependence, directions = configuration.design.dependence, configuration.design.linkage.directions
        turns = [
            -crossing(directions[joint]) @ dependence.arrays[0][6 * joint : 6 * joint + 3] for joint in (first, second)
        ]
        a, b = directions[first], directions[second]
        cross = np.cross(a, b)
        sine, cosine = float(np.linalg.norm(cross)), float(a @ b)
        if sine <= DOUBLE.parallel:
            raise UnsolvableError(
                f"the axes of joints {' and '.join(self.joints)} are parallel: their arc has no slope"
            )
        by_a = (cosine * np.cross(b, cross) / sine - sine * b) / (sine**2 + cosine**2)
        by_b = (cosine * np.cross(cross, a) / sine - sine * a) / (sine**2 + cosine**2)
        slope = by_a @ turns[0] + by_b @ turns[1]
        none = np.zeros((1, len(configuration.angles)))
        return Derived(np.array([np.arctan2(sine, cosine)]), none, slope[None])

    def __str__(self) -> str:
        return f"arc between joints {self.joints[0]} and {self.joints[1]}"


@dataclass(frozen=True, kw_only=True)
class EqualArcs(ShapeWish):
    """Two arcs that are equal, each between two axes of a link.

    Attributes
    ----------
    at : str
        Name of a configuration.
    arcs : ((str, str), (str, str))
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> print(EqualArcs(arcs=(("0", "1"), ("2", "3"))))
    arcs 0-1 and 2-3 equal
    """

    arcs: tuple[tuple[str, str], tuple[str, str]]
    unit = "angle"
    _any: Goal = field(default=Goal(at_least=0.0), init=False, repr=False)

    def check(self, frame: DesignFrame) -> None:
        """Check the joints."""
        for pair in self.arcs:
            LinkArc(joints=pair, goal=self._any).check(frame)

    def missed(self, configuration: DesignConfiguration) -> Derived:
        """Return the difference of the arcs."""
        one, other = (LinkArc(joints=pair, goal=self._any).measured(configuration) for pair in self.arcs)
        return one - other

    def __str__(self) -> str:
        return f"arcs {' and '.join('-'.join(pair) for pair in self.arcs)} equal"


@dataclass(frozen=True, kw_only=True)
class SheetArea(GoalWish, ShapeWish):
    """The area of the panels of a sheet, all together.

    Attributes
    ----------
    at : str
        Name of a configuration.
    goal : Goal
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> print(SheetArea(goal=Goal(at_most=4.0)))
    area of material
    """

    unit = "area"

    def check(self, frame: DesignFrame) -> None:
        """Check that there are panels."""
        frame.all_vertices()

    def measured(self, configuration: DesignConfiguration) -> Derived:
        """Return the area."""
        sheet = configuration.frame.family.sheet
        assert sheet is not None
        vertices, extent = configuration.design.vertices, configuration.frame.extent
        slope, total = np.zeros((len(vertices), 3)), 0.0
        for face in sheet.faces:
            around = list(face)
            after, before = around[1:] + around[:1], around[-1:] + around[:-1]
            vector = np.cross(vertices[around], vertices[after]).sum(axis=0) / 2.0
            size = float(np.linalg.norm(vector))
            total += size
            slope[around] += np.cross(vertices[after] - vertices[before], vector / size) / 2.0
        by = extent**2 * np.einsum("vi,vin->n", slope, configuration.design.by_vertices)
        none = np.zeros((1, len(configuration.angles)))
        return Derived(np.array([extent**2 * total]), none, by[None])

    def __str__(self) -> str:
        return "area of material"


def _sheet_of(frame: DesignFrame, what: str) -> Sheet:
    """Return the sheet of a frame; `UnsolvableError` if the mechanism is none."""
    sheet = frame.family.sheet
    if sheet is None:
        raise UnsolvableError(f"{what} are those of panels, and the mechanism is no sheet")
    return sheet


def _lengths(configuration: DesignConfiguration, edges: Ints) -> Derived:
    """Return the lengths of edges int[E, 2] of a sheet as it is drawn."""
    extent, design = configuration.frame.extent, configuration.design
    along = design.vertices[edges[:, 1]] - design.vertices[edges[:, 0]]
    sizes = np.linalg.norm(along, axis=1)
    by_ends = design.by_vertices[edges[:, 1]] - design.by_vertices[edges[:, 0]]
    slopes = np.einsum("ei,ein->en", along / sizes[:, None], by_ends)
    return Derived(extent * sizes, np.zeros((len(edges), len(configuration.angles))), extent * slopes)


def _check_edges(frame: DesignFrame, edges: tuple[tuple[int, int], ...]) -> None:
    """Raise `InvariantError` for two vertices without an edge between them."""
    known = {frozenset(edge) for edge in _sheet_of(frame, "edges").edges}
    for edge in edges:
        if frozenset(edge) not in known:
            raise InvariantError("edges", f"there is no edge between vertices {edge[0]} and {edge[1]}", "an edge")


@dataclass(frozen=True, kw_only=True)
class EdgeLengths(GoalWish, ShapeWish):
    """The lengths of edges of a sheet as it is drawn, by default of all: the least edge that can be made.

    Attributes
    ----------
    at : str
        Of no effect.
    goal : Goal
        Each of them.
    edges : tuple of (int, int)
        Two vertices each.
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> print(EdgeLengths(goal=Goal(at_least=0.5)), EdgeLengths(edges=((0, 1),), goal=Goal(equals=1.0)), sep="; ")
    lengths of edges; length of edge 0-1
    """

    edges: tuple[tuple[int, int], ...] = ()
    unit = "length"

    def check(self, frame: DesignFrame) -> None:
        """Check the edges."""
        _check_edges(frame, self.edges)

    def measured(self, configuration: DesignConfiguration) -> Derived:
        """Return the lengths."""
        return _lengths(configuration, np.array(self.edges or _sheet_of(configuration.frame, "edges").edges))

    def __str__(self) -> str:
        names = ", ".join(f"{a}-{b}" for a, b in self.edges)
        return f"length of edge{'s' if len(self.edges) > 1 else ''} {names}" if names else "lengths of edges"


@dataclass(frozen=True, kw_only=True)
class EqualLengths(ShapeWish):
    """Edges of a sheet that are equally long.

    Attributes
    ----------
    at : str
        Of no effect.
    edges : tuple of (int, int)
        Two vertices each, 2 edges or more.
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> print(EqualLengths(edges=((0, 1), (1, 2))))
    edges 0-1, 1-2 equal
    """

    edges: tuple[tuple[int, int], ...]
    unit = "length"

    def check(self, frame: DesignFrame) -> None:
        """Check the edges."""
        if len(self.edges) < 2:
            raise InvariantError("edges", f"{len(self.edges)} of equal length", "2 or more")
        _check_edges(frame, self.edges)

    def missed(self, configuration: DesignConfiguration) -> Derived:
        """Return the differences of each from the first."""
        lengths, count = _lengths(configuration, np.array(self.edges)), len(self.edges)
        less = np.hstack([-np.ones((count - 1, 1)), np.eye(count - 1)])
        return lengths.through(less @ lengths.values, less)

    def __str__(self) -> str:
        return f"edges {', '.join(f'{a}-{b}' for a, b in self.edges)} equal"


@dataclass(frozen=True, kw_only=True)
class PanelCorners(GoalWish, ShapeWish):
    """Angles of corners of panels, radians, by default of all: at least the least sector, at most pi if convex.

    Attributes
    ----------
    at : str
        Of no effect.
    goal : Goal
        Radians, each of them.
    corners : tuple of (int, int, int)
        Three vertices of a panel in turn, the corner in the middle.
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> print(PanelCorners(corners=((0, 1, 2),), goal=Goal(equals=1.5707963267948966)))
    corner 0-1-2
    """

    corners: tuple[tuple[int, int, int], ...] = ()
    unit = "angle"

    def check(self, frame: DesignFrame) -> None:
        """Check that the corners are those of panels."""
        self._places(_sheet_of(frame, "corners"))

    def _places(self, sheet: Sheet) -> list[tuple[int, int]]:
        """Return faces, and places of corners in them."""
        every = [(face, place) for face, around in enumerate(sheet.faces) for place in range(len(around))]
        if not self.corners:
            return every
        of: dict[tuple[int, frozenset[int]], tuple[int, int]] = {}
        for face, place in every:
            around = sheet.faces[face]
            ends = frozenset((around[place - 1], around[(place + 1) % len(around)]))
            of.setdefault((around[place], ends), (face, place))
        chosen = []
        for a, b, c in self.corners:
            if (b, frozenset((a, c))) not in of:
                raise InvariantError("corners", f"no panel has the corner {a}-{b}-{c}", "three vertices in turn")
            chosen.append(of[b, frozenset((a, c))])
        return chosen

    def measured(self, configuration: DesignConfiguration) -> Derived:
        """Return the angles, of re-entrant corners more than pi; a panel that was turned over has such ones."""
        sheet, vertices = _sheet_of(configuration.frame, "corners"), configuration.design.vertices
        faces = [list(around) for around in sheet.faces]
        corners = [(face, *_corner(faces[face], place)) for face, place in self._places(sheet)]
        face, a, b, c = np.array(corners).T
        now, first = (
            np.array([_normal(of[around]) for around in faces]) for of in (vertices, configuration.frame.drawn)
        )
        normals = (now * np.sign((now * first).sum(axis=1, keepdims=True)))[face]
        ahead, back = vertices[c] - vertices[b], vertices[a] - vertices[b]
        cosine, across = (ahead * back).sum(axis=1), np.cross(ahead, back)
        sine = (normals * across).sum(axis=1)
        square = (sine**2 + cosine**2)[:, None]
        # The normal turns about lines in the plane of the panel, so that sines do not change by that.
        by_ahead = (cosine[:, None] * np.cross(back, normals) - sine[:, None] * back) / square
        by_back = (cosine[:, None] * np.cross(normals, ahead) - sine[:, None] * ahead) / square
        by = configuration.design.by_vertices
        slopes = np.einsum("ci,cin->cn", by_ahead, by[c] - by[b]) + np.einsum("ci,cin->cn", by_back, by[a] - by[b])
        angles = np.remainder(np.arctan2(sine, cosine), 2.0 * pi)
        return Derived(angles, np.zeros((len(angles), len(configuration.angles))), slopes)

    def __str__(self) -> str:
        names = ", ".join(f"{a}-{b}-{c}" for a, b, c in self.corners)
        return f"corner{'s' if len(self.corners) > 1 else ''} {names}" if names else "corners of panels"


def _corner(around: list[int], place: int) -> tuple[int, int, int]:
    return around[place - 1], around[place], around[(place + 1) % len(around)]


def _normal(corners: Floats) -> Floats:
    """Return the unit normal of a panel, float[3], about which its corners follow each other counter-clockwise."""
    vector = np.cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0)
    return np.asarray(vector / np.linalg.norm(vector))


@dataclass(frozen=True, kw_only=True)
class Symmetry(ShapeWish):
    """A sheet that is its own image in a mirror line, or turned about a point; in the plane of its first coordinates.

    Which vertex is the image of which is read off the sheet as it is given, which need not be quite symmetric.

    Attributes
    ----------
    at : str
        Of no effect.
    mirror : ((float, float), (float, float)) or None
        Two points of a line.
    turns : int
        How many turns by equal angles are a whole one, 2 or more; without a mirror.
    centre : (float, float)
        The point about which it turns.
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> print(Symmetry(mirror=((0, 0), (0, 1))), Symmetry(turns=3), sep="; ")
    mirror symmetry about (0, 0)-(0, 1); symmetry of 3 turns about (0, 0)
    """

    mirror: tuple[tuple[float, float], tuple[float, float]] | None = None
    turns: int = 0
    centre: tuple[float, float] = (0.0, 0.0)
    unit = "length"

    def check(self, frame: DesignFrame) -> None:
        """Check the line or turns, and that vertices have images."""
        if (self.mirror is None) == (self.turns == 0) or (self.mirror is None and self.turns < 2):
            raise InvariantError("symmetry", "not one of a mirror and 2 turns or more", "mirror, or turns")
        if self.mirror is not None and self.mirror[0] == self.mirror[1]:
            raise InvariantError("symmetry", "a mirror line through a point twice", "two points")
        self._images(frame)

    def _moved(self) -> tuple[Floats, Floats]:
        """Return the isometry as a matrix float[3, 3] and a vector."""
        if self.mirror is None:
            angle, fixed = 2.0 * pi / self.turns, self.centre
            block = [[cos(angle), -sin(angle)], [sin(angle), cos(angle)]]
        else:
            fixed, end = self.mirror
            twice = 2.0 * np.arctan2(end[1] - fixed[1], end[0] - fixed[0])
            block = [[cos(twice), sin(twice)], [sin(twice), -cos(twice)]]
        matrix = np.eye(3)
        matrix[:2, :2] = block
        about = np.array([*fixed, 0.0])
        return matrix, about - matrix @ about

    def _images(self, frame: DesignFrame) -> Ints:
        """Return the image of each vertex: the nearest to where it comes; edges must come to edges."""
        sheet = _sheet_of(frame, "symmetries")
        matrix, shift = self._moved()
        there = frame.drawn @ matrix.T + shift
        images = np.array([int(((frame.drawn - place) ** 2).sum(axis=1).argmin()) for place in there])
        edges = {frozenset(edge) for edge in sheet.edges}
        onto = {frozenset((int(images[a]), int(images[b]))) for a, b in sheet.edges}
        if len(set(images.tolist())) < len(images) or onto != edges:
            raise InvariantError("symmetry", f"the sheet has no {self}", "a line or point that maps edges to edges")
        return images

    def missed(self, configuration: DesignConfiguration) -> Derived:
        """Return images of vertices less the vertices that they are to be, three coordinates each."""
        frame, design = configuration.frame, configuration.design
        images, (matrix, shift) = self._images(frame), self._moved()
        places = design.vertices * frame.extent + frame.middle
        off = places @ matrix.T + shift - places[images]
        slopes = frame.extent * (np.einsum("ij,vjn->vin", matrix, design.by_vertices) - design.by_vertices[images])
        return Derived(off.ravel(), np.zeros((off.size, len(configuration.angles))), slopes.reshape(off.size, -1))

    def __str__(self) -> str:
        if self.mirror is None:
            return f"symmetry of {self.turns} turns about ({self.centre[0]:g}, {self.centre[1]:g})"
        return "mirror symmetry about " + "-".join(f"({x:g}, {y:g})" for x, y in self.mirror)


@dataclass(frozen=True, kw_only=True)
class CellCurvatures(Wish):
    """Principal curvatures of a folded sheet of quadrilaterals, at all its cells of 2 x 2 panels.

    Misses are those of Gaussian and mean curvatures, in parts of the larger principal curvature (squared).

    Attributes
    ----------
    at : str
        Name of a configuration.
    principal : (float, float)
        One over the unit of length; both negative is the same surface seen from below.
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> print(CellCurvatures(at="folded", principal=(0.1, -0.1)))
    curvatures 0.1 and -0.1 at folded
    """

    principal: tuple[float, float]

    def check(self, frame: DesignFrame) -> None:
        """Check that there are cells, and a curvature."""
        grid = getattr(frame.family, "grid", None)
        if grid is None:
            raise UnsolvableError("curvatures are those of flat-foldable quadrilaterals; set closed_form")
        if any(count % 2 == 0 or count < 5 for count in grid):
            rows, columns = grid[0] - 1, grid[1] - 1
            raise InvariantError("curvature", f"a sheet of {rows} x {columns} panels", "even numbers, 4 or more")
        if not any(self.principal):
            raise InvariantError("curvature", "no curvature", "a principal curvature that is not 0")

    def missed(self, configuration: DesignConfiguration) -> Derived:
        """Return how far curvatures of all cells are off."""
        grid, frame = getattr(configuration.frame.family, "grid"), configuration.frame  # noqa: B009  # of that family alone
        there = configuration.places(frame.all_vertices())
        size = len(there.values)
        moved = there.values[:, None] + 1j * IMAGINARY * np.eye(size)
        off = self._off(moved.reshape(*grid, 3, size))
        return there.through(off[:, 0].real, off.imag / IMAGINARY)

    def _off(self, places: Floats) -> Floats:
        k, h = cell_curvatures(places)
        first, second = self.principal
        scale = max(map(abs, self.principal))
        parts = ((k - first * second) / scale**2, (h - (first + second) / 2.0) / scale)
        return np.concatenate([part.reshape(-1, *places.shape[3:]) for part in parts])

    def __str__(self) -> str:
        return f"curvatures {self.principal[0]:g} and {self.principal[1]:g} at {self.at}"
