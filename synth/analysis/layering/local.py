"""Local conditions of flat folding: each vertex by itself, and whether the image closes.

Round a vertex inside the sheet every other sector adds up to 180 degrees (Kawasaki), mountains and valleys differ by
two (Maekawa), and sectors can be crimped one after the other: a sector no larger than its neighbours, between a
mountain and a valley, is folded away. Sources: T. Kawasaki (1989); J. Justin (1986); M. Bern and B. Hayes, The
complexity of flat origami (1996), for crimps. Theory: docs/theory/layer-orders.md.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees, floor, log10, pi
from typing import Any

import numpy as np
from scipy.sparse import csr_array, eye_array
from scipy.sparse.linalg import spsolve

from graphs.convert.duality import SheetMechanism
from graphs.errors import numbered
from graphs.mechanism.precision import Precision, extent_of
from graphs.mechanism.sheet import Sheet, sides_of_face
from graphs.tolerances import DOUBLE, EPSILON, Tolerances
from graphs.types import Floats

_STEPS = 8
"""Steps of Newton's method to vertices at which all alternating sums are 0."""


@dataclass(frozen=True, slots=True)
class FlatVertex:
    """A vertex inside the sheet, and whether its surroundings fold flat.

    Attributes
    ----------
    vertex : int
    place : (x, y)
    creases : tuple of int
        The joints round it, counter-clockwise; ends are the other vertices of their pieces.
    ends : tuple of int
    letters : str
        The assignment of each crease.
    angles : tuple of float
        The sectors after each crease, in radians.
    off : float
        How far the sum of every other sector is from 180 degrees, in radians; 180 degrees for an odd number.
    allowed : float
        What coordinates of this precision leave open of it.

    Examples
    --------
    >>> FlatVertex(0, (0.0, 0.0), (0, 1), (1, 2), "MV", (pi, pi), 0.0, 1e-9).fault
    '1 mountain and 1 valley'
    """

    vertex: int
    place: tuple[float, float]
    creases: tuple[int, ...]
    ends: tuple[int, ...]
    letters: str
    angles: tuple[float, ...]
    off: float
    allowed: float

    @property
    def kawasaki(self) -> bool:
        """Whether every other sector adds up to 180 degrees, within the precision."""
        return len(self.creases) % 2 == 0 and self.off <= self.allowed

    def allowed_by(self, points: Floats, length: float) -> float:
        """Return what ends that are off by a length, each across its crease, leave open of the sums, in radians."""
        return _allowed(points[list(self.ends)] - points[self.vertex], length)

    @property
    def difference(self) -> int:
        """Mountains less valleys."""
        return self.letters.count("M") - self.letters.count("V")

    @property
    def maekawa(self) -> bool:
        """Whether mountains and valleys differ by two, or can: unassigned creases may be either."""
        free = len(self.letters) - self.letters.count("M") - self.letters.count("V")
        return any(abs(self.difference + free - 2 * valleys) == 2 for valleys in range(free + 1))

    @property
    def crimps(self) -> bool:
        """Whether the vertex folds flat by itself as assigned, or as unassigned creases can be."""
        return self.kawasaki and folds_alone(self.angles, self.letters, self.allowed)

    @property
    def fault(self) -> str:
        """What is wrong, in words; empty if nothing is."""
        if len(self.creases) % 2:
            return f"{len(self.creases)} creases, an odd number"
        if not self.kawasaki:
            # so many decimals that the two sums differ, and show two digits of what is missing
            decimals = max(3, 1 - floor(log10(degrees(self.off))))
            more, less = (f"{degrees(pi + off):.{decimals}f}".rstrip("0").rstrip(".") for off in (self.off, -self.off))
            return f"every other sector adds up to {more} or {less} degrees"
        if not self.maekawa:
            mountains, valleys = (
                numbered(self.letters.count("M"), "mountain"),
                numbered(self.letters.count("V"), "valley"),
            )
            number = f"{mountains} and {valleys}"
            return number if set(self.letters) <= set("MV") else f"{number} among {len(self.letters)} creases"
        return "" if self.crimps else "its creases cannot be crimped as they are assigned"

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "vertex": self.vertex,
            "place": list(self.place),
            "creases": list(self.creases),
            "kawasaki_off_deg": degrees(self.off),
            "mountains_less_valleys": self.difference,
            "fault": self.fault or None,
        }


def folds_alone(angles: Sequence[float], letters: str, allowed: float) -> bool:
    """Return whether a vertex with these sectors, in radians, folds flat; U is a mountain or a valley.

    The sector after each crease; those that differ by no more than `allowed` are equal.

    Examples
    --------
    >>> folds_alone([1.0, 1.0, 2.14159265, 2.14159265], "MVMM", 1e-6)
    True
    >>> folds_alone([0.8, 1.0, 2.34159265, 2.14159265], "MMVM", 1e-6)
    False
    """
    if len(letters) == 2:
        return not {"M", "V"} <= set(letters)
    least = min(angles)
    count = len(angles)
    for place in range(count):  # some smallest sector is crimped in each flat folding: between creases of two kinds
        if angles[place] > least + allowed:
            continue
        one, other = letters[place], letters[(place + 1) % count]
        if one == other and one in "MV":
            continue
        before, after = angles[place - 1], angles[(place + 1) % count]
        rest_angles = [angles[(place + 2 + k) % count] for k in range(count - 3)]
        rest = "".join(letters[(place + 2 + k) % count] for k in range(count - 2))
        if folds_alone([*rest_angles, before + after - angles[place]], rest, allowed):
            return True
        if "U" not in (one, other):
            return False  # any crimp of equal sectors leaves the same vertex
    return False


def flat_vertices(sheet: Sheet, mechanism: SheetMechanism, points: Floats, precision: Precision) -> list[FlatVertex]:
    """Return the vertices inside the sheet that creases meet, in order of their numbers.

    `points`, float[V, 2], are their places in the plane of the pattern. Creases are joints of different panels.
    """
    near = Tolerances.of(precision.size).same_point * extent_of(points)
    of = {face: panel for panel, faces in enumerate(mechanism.panels) for face in faces}
    joint_of = {frozenset(edge): joint for joint, pieces in mechanism.pieces.items() for edge in pieces}
    letter_of = {frozenset(edge): letter for edge, letter in zip(sheet.edges, sheet.assignments, strict=True)}
    beside: dict[frozenset[int], list[int]] = {}
    for face, around in enumerate(sheet.faces):
        for side in sides_of_face(around):
            beside.setdefault(frozenset(side), []).append(of[face])
    edges_at: dict[int, list[frozenset[int]]] = {}
    for edge in beside:
        for vertex in edge:
            edges_at.setdefault(vertex, []).append(edge)
    found = []
    for vertex, edges in sorted(edges_at.items()):
        if any(len(beside[edge]) < 2 for edge in edges):
            continue
        ends = [next(iter(edge - {vertex})) for edge in edges if edge in joint_of and len(set(beside[edge])) == 2]
        if not ends:
            continue
        arms = points[ends] - points[vertex]
        order = np.argsort(np.arctan2(arms[:, 1], arms[:, 0]), kind="stable")
        ends, arms = [ends[place] for place in order], arms[order]
        angles = _sectors(arms) if len(ends) > 1 else np.array([2.0 * pi])
        off = abs(float(angles[::2].sum()) - pi) if len(ends) % 2 == 0 else pi
        allowed = _allowed(arms, near)
        met = [frozenset((vertex, end)) for end in ends]
        found.append(
            FlatVertex(
                vertex,
                (float(points[vertex, 0]), float(points[vertex, 1])),
                tuple(joint_of[edge] for edge in met),
                tuple(ends),
                "".join(letter_of[edge] for edge in met),
                tuple(angles.tolist()),
                off,
                allowed,
            )
        )
    return found


def _allowed(arms: Floats, length: float) -> float:
    """Return by how much ends of arms, float[n, 2], that are off by a length turn them together, in radians."""
    return float((2.0 * length / np.linalg.norm(arms, axis=1)).sum())


def sums_off(points: Floats, vertices: Sequence[FlatVertex]) -> Floats:
    """Return how far every other sector of each vertex is from 180 degrees at places float[V, 2], in radians."""
    arms = (points[list(vertex.ends)] - points[vertex.vertex] for vertex in vertices)
    return np.array([float(_sectors(one)[::2].sum()) - pi for one in arms])


def closing_points(points: Floats, vertices: Sequence[FlatVertex]) -> Floats:
    """Return the nearest places of vertices, float[V, 2], at which every other sector adds up to 180 degrees."""
    moved = points.copy()
    for _ in range(_STEPS):
        rows, columns, entries, off = list[int](), list[int](), list[float](), list[float]()
        for number, vertex in enumerate(vertices):
            arms = moved[list(vertex.ends)] - moved[vertex.vertex]
            across = np.column_stack([-arms[:, 1], arms[:, 0]]) / (arms**2).sum(axis=1)[:, None]
            off.append(float(_sectors(arms)[::2].sum()) - pi)
            by = np.where(np.arange(len(arms)) % 2 == 0, -1.0, 1.0)[:, None] * across
            for end, gradient in zip((*vertex.ends, vertex.vertex), (*by, -by.sum(axis=0)), strict=True):
                rows += [number, number]
                columns += [2 * end, 2 * end + 1]
                entries += gradient.tolist()
        if np.abs(off).max(initial=0.0) <= DOUBLE.closed:
            break
        jacobian = csr_array((entries, (rows, columns)), shape=(len(vertices), points.size))
        normal = (jacobian @ jacobian.T).tocsc()
        dependent = EPSILON * normal.diagonal().max()  # conditions that follow from others are met with them
        weights = spsolve(normal + dependent * eye_array(len(vertices), format="csc"), np.array(off))
        moved = moved - (jacobian.T @ weights).reshape(points.shape)
    return moved


def _sectors(arms: Floats) -> Floats:
    """Return the angles, 0 to 2 pi, from each arm, float[n, 2], to the next counter-clockwise."""
    angles = np.arctan2(arms[:, 1], arms[:, 0])
    found: Floats = np.mod(np.roll(angles, -1) - angles, 2.0 * pi)
    return found
