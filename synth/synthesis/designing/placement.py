"""A design at a configuration: where its links and points are, with derivatives by joint angles and numbers.

Theory: docs/theory/design.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from graphs.convert.duality import mechanism_of_sheet
from graphs.edit.named import joint_named, known, link_named
from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.geometry import crossing
from graphs.loops.loop import Centre
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.analysis.folding.panel_collisions import Collision, shapes_of_panels
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.derivatives import BodyPoses, BodyTree, spatial
from synth.analysis.motion.linkage import Linkage
from synth.synthesis.designing.dimensions import DesignedLinkage, Dimensions


@dataclass(frozen=True, slots=True)
class DesignPoint:
    """A point of a link, by its place at the configuration of the file; or a vertex of a sheet.

    Attributes
    ----------
    link : str or None
    point : (float, float, float)
        In the unit of the file.
    vertex : int or None

    Examples
    --------
    >>> print(DesignPoint("2", (0.0, 0.0, 1.0)), DesignPoint(vertex=4), sep="; ")
    point (0, 0, 1) of link 2; vertex 4
    """

    link: str | None = None
    point: tuple[float, float, float] = (0.0, 0.0, 0.0)
    vertex: int | None = None

    def __str__(self) -> str:
        if self.vertex is not None:
            return f"vertex {self.vertex}"
        return f"point ({', '.join(f'{x:g}' for x in self.point)}) of link {self.link}"


@dataclass(frozen=True, slots=True)
class Derived:
    """m numbers of a configuration, float[m], and their derivatives by J joint angles and n numbers of a design."""

    values: Floats
    by_angles: Floats
    by_numbers: Floats

    def __sub__(self, other: Derived) -> Derived:
        return Derived(self.values - other.values, self.by_angles - other.by_angles, self.by_numbers - other.by_numbers)

    def through(self, values: Floats, slopes: Floats) -> Derived:
        """Return other numbers that depend on these, by their derivatives float[k, m]."""
        return Derived(values, slopes @ self.by_angles, slopes @ self.by_numbers)


def stacked(parts: Sequence[Derived]) -> Derived:
    """Return the numbers of several in one row."""
    return Derived(
        np.concatenate([part.values for part in parts]),
        np.concatenate([part.by_angles for part in parts]),
        np.concatenate([part.by_numbers for part in parts]),
    )


class DesignFrame:
    """What all designs of a family have in common: links, joints, the tree that carries links, vertices on links.

    Parameters
    ----------
    family : Dimensions
    first : DesignedLinkage
        Any member.
    """

    def __init__(self, family: Dimensions, first: DesignedLinkage) -> None:
        self.family = family
        self.graph = first.linkage.graph
        self.extent, self.middle = first.linkage.extent, first.linkage.middle
        self.joints = list(self.graph.joints)
        self._tree = BodyTree(first.linkage, family.ground)
        self._equations: dict[int, ClosureEquations] = {}
        sheet = family.sheet
        self.drawn = first.vertices * self.extent + self.middle
        self.link_of = np.zeros(0, dtype=np.int64)
        self.placed = np.zeros(0, dtype=np.int64)
        if sheet is not None:
            panels = mechanism_of_sheet(sheet).panels
            self.link_of = np.full(sheet.vertices, -1, dtype=np.int64)
            for link in reversed(range(len(panels))):
                around = [vertex for face in panels[link] for vertex in sheet.faces[face]]
                self.link_of[around] = self._tree.row[list(self.graph.nodes)[link]]
            self.placed = np.flatnonzero(self.link_of >= 0)

    def tree(self, design: DesignedLinkage) -> BodyTree:
        """Return the tree of joints with the axes of a design."""
        tree = copy(self._tree)
        tree.linkage = design.linkage
        return tree

    def closure(self, design: DesignedLinkage, copies: int = 1) -> ClosureEquations:
        """Return the closure equations of a design at several configurations, joint angles one after the other.

        Of a sheet there are six for loops of creases that are parallel now, which numbers may turn. Loops are the same
        in all designs, so they are taken apart once for each number of configurations.
        """
        linkage = self._copied(design, copies)
        if copies not in self._equations:
            self._equations[copies] = ClosureEquations(linkage)
        return self._equations[copies].with_axes(linkage)

    def _copied(self, design: DesignedLinkage, copies: int) -> Linkage:
        """Return a design several times over, as one linkage whose joints stand one after the other."""
        linkage = design.linkage
        if self.family.sheet is not None and any(loop.centre is Centre.INFINITE for loop in linkage.loops):
            linkage = spatial(linkage)
        if copies == 1:
            return linkage
        loops = [
            replace(loop, joints=tuple(joint + copy * len(self.joints) for joint in loop.joints))
            for copy in range(copies)
            for loop in linkage.loops
        ]
        points, directions = (np.tile(part, (copies, 1)) for part in (linkage.points, linkage.directions))
        angles = np.tile(linkage.angles, copies)
        return replace(linkage, points=points, directions=directions, angles=angles, loops=tuple(loops))

    def collision(self, design: DesignedLinkage) -> Collision:
        """Return what finds panels of a design that pass through each other on a walk."""
        sheet, points = self.family.sheet, self.all_vertices()
        assert sheet is not None

        def places(angles: Floats) -> Floats:
            every = np.zeros((len(angles), sheet.vertices, 3))
            for row, one in enumerate(angles):
                every[row, self.placed] = DesignConfiguration(self, design, one).places(points).values.reshape(-1, 3)
            return every

        here = places(design.linkage.angles[None])[0]
        return Collision(shapes_of_panels(sheet, mechanism_of_sheet(sheet), here, DOUBLE), places)

    def joint(self, name: str) -> int:
        """Return the place of a joint by its name; `InvariantError` if there is none."""
        return self.joints.index(joint_named(self.graph, name))

    def row(self, name: str) -> int:
        """Return the row of a link by its name; `InvariantError` if there is none."""
        return self._tree.row[link_named(self.graph, name)]

    def row_of_joint(self, joint: int) -> int:
        """Return the row of the first link of a joint."""
        return self._tree.row[self.graph.joints[self.joints[joint]][0]]

    def check_point(self, point: DesignPoint) -> None:
        """Raise `InvariantError` if there is no such link or vertex."""
        if point.vertex is None:
            if point.link is None:
                raise InvariantError("point", "a point without link and vertex", "a link or a vertex")
            self.row(point.link)
        elif not 0 <= point.vertex < len(self.link_of) or self.link_of[point.vertex] < 0:
            names = [str(vertex) for vertex in self.placed.tolist()]
            raise InvariantError("vertex", f"there is no vertex {point.vertex} of a panel", known(names, ""))

    def all_vertices(self) -> list[DesignPoint]:
        """Return the vertices of all panels; `UnsolvableError` if it has none."""
        if not len(self.placed):
            raise UnsolvableError("the mechanism has no vertices; expected points of its links")
        return [DesignPoint(vertex=int(vertex)) for vertex in self.placed]


class DesignConfiguration:
    """A design at joint angles float[J], radians, closed or not."""

    def __init__(self, frame: DesignFrame, design: DesignedLinkage, angles: Floats) -> None:
        self.frame, self.design, self.angles = frame, design, angles
        self.bodies: BodyPoses = frame.tree(design).at(angles)

    @cached_property
    def _twists(self) -> tuple[Floats, Floats]:
        return self.bodies.derivatives(self.design.dependence)

    def rotation(self, row: int) -> Derived:
        """Return the nine entries of the rotation of a link from the file's configuration, row after row."""
        matrix = self.bodies.rotations[row]
        by = -crossing(matrix.T).swapaxes(0, 1).reshape(9, 3)  # a column m changes by w x m
        by_angles, by_numbers = (part[row, :3] for part in self._twists)
        return Derived(matrix.ravel(), by @ by_angles, by @ by_numbers)

    def direction(self, row: int, vector: Floats, by_numbers: Floats) -> Derived:
        """Return where a vector of a link of the file points now, float[3]; its derivatives by numbers: float[3, n]."""
        there = self.bodies.rotations[row] @ vector
        turn = -crossing(there)
        by, direct = (part[row, :3] for part in self._twists)
        own = self.bodies.rotations[row] @ by_numbers
        return Derived(there, turn @ by, turn @ direct + own)

    def axis(self, joint: int) -> Derived:
        """Return where the direction of a joint axis points."""
        linkage, frame = self.design.linkage, self.frame
        row = frame.row_of_joint(joint)  # both links agree where loops are closed
        along = linkage.directions[joint]
        by = -crossing(along) @ self.design.dependence.arrays[0][6 * joint : 6 * joint + 3]
        return self.direction(row, along, by)

    def places(self, points: Sequence[DesignPoint]) -> Derived:
        """Return where points are, three coordinates each, in the unit of the file: float[3 P]."""
        frame, design = self.frame, self.design
        count, numbers = len(points), design.dependence.twists.shape[1]
        rows = np.zeros(count, dtype=np.int64)
        local, own = np.zeros((count, 3)), np.zeros((count, 3, numbers))
        for place, point in enumerate(points):
            if point.vertex is not None:
                rows[place] = frame.link_of[point.vertex]
                local[place], own[place] = design.vertices[point.vertex], design.by_vertices[point.vertex]
            else:
                rows[place] = frame.row(str(point.link))
                local[place] = (np.array(point.point) - frame.middle) / frame.extent
        rotations = self.bodies.rotations[rows]
        there = np.einsum("nij,nj->ni", rotations, local) + self.bodies.shifts[rows]
        turn = -crossing(there)
        by_angles, by_numbers = (turn @ part[rows, :3] + part[rows, 3:] for part in self._twists)
        by_numbers = by_numbers + rotations @ own
        extent = frame.extent
        values = (there * extent + frame.middle).ravel()
        return Derived(values, extent * by_angles.reshape(3 * count, -1), extent * by_numbers.reshape(3 * count, -1))

    def angle(self, joint: int) -> Derived:
        """Return the angle of a joint, radians: float[1]."""
        unit = np.eye(len(self.angles))[[joint]]
        return Derived(self.angles[[joint]], unit, np.zeros((1, self.design.dependence.twists.shape[1])))


def check_names(names: Sequence[str], known_names: Sequence[str], what: str) -> None:
    """Raise `InvariantError` for the first name that is not known."""
    for name in names:
        if name not in known_names:
            raise InvariantError(what, f"there is no {what} {shown(name)}", known(known_names, name))
