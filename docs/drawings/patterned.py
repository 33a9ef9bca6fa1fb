"""A crease pattern on the page, and where its vertices, creases and centres are there."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import networkx as nx
import numpy as np

import synth
from graphs.convert.duality import SheetMechanism, mechanism_of_sheet
from graphs.mechanism.sheet import Edge, Sheet, with_all_edges
from graphs.types import Floats, JointId
from synth.making.drawing import Scene
from synth.making.drawing.mechanisms.creases import places_on_page
from synth.making.drawing.scene.shapes import Point

__all__ = ["Patterned"]


class Patterned:
    """A crease pattern that is drawn in a square.

    Parameters
    ----------
    sheet : Sheet
        Flat.
    side : float
        Of the square, points.
    """

    def __init__(self, sheet: Sheet, side: float) -> None:
        self.sheet = sheet
        self.box = (side, side)
        self.places = places_on_page(sheet, self.box)
        self.mechanism: SheetMechanism = mechanism_of_sheet(sheet)
        self._hinges: Mapping[JointId, Edge] = dict(self.mechanism.hinges.items())

    @property
    def joints(self) -> list[JointId]:
        """Return the creases of its mechanism."""
        return list(self._hinges)

    def scene(self, **look: Any) -> Scene:
        """Return its picture without numbers and caption."""
        how: dict[str, Any] = {"colour": "none", "numbers": False, "box": self.box, "caption": None, **look}
        return synth.draw(self.sheet, **how)

    def crease(self, joint: JointId) -> list[Point]:
        """Return the ends of a crease."""
        return [self.places[vertex] for vertex in self._hinges[joint]]

    def middle_of_hole(self) -> Point:
        """Return the middle of the shorter of the two borders of a sheet with one hole."""
        whole = with_all_edges(self.sheet)
        sides = zip(whole.edges, whole.assignments, strict=True)
        borders = nx.connected_components(nx.Graph(edge for edge, letter in sides if letter == "B"))
        hole = min(([self.places[vertex] for vertex in border] for border in borders), key=np.ptp)
        x, y = np.mean(hole, axis=0).tolist()
        return x, y

    def shared(self, one: int, other: int) -> list[JointId]:
        """Return the creases that two loops, by their numbers, have in common."""
        loops = self.mechanism.sc.loops
        return [joint for joint in loops[one].joints if joint in loops[other].joints]

    def meeting(self, joints: Iterable[JointId]) -> Point:
        """Return the point through which creases pass: the nearest to all their lines."""
        matrix, right = np.zeros((2, 2)), np.zeros(2)
        for joint in joints:
            start, end = (np.array(place) for place in self.crease(joint))
            across: Floats = np.array([start[1] - end[1], end[0] - start[0]])
            across /= np.linalg.norm(across)
            matrix += np.outer(across, across)
            right += across * (across @ start)
        x, y = np.linalg.solve(matrix, right).tolist()
        return x, y

    def towards(self, joint: JointId, point: Point) -> list[Point]:
        """Return what is missing between a crease and a point on its line."""
        return [min(self.crease(joint), key=lambda end: np.hypot(end[0] - point[0], end[1] - point[1])), point]
