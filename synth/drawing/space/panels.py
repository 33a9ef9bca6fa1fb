"""Panels in space: hidden by those before them, shaded by the light, their two sides in two colours."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from graphs.convert.duality import SheetMechanism, mechanism_of_sheet
from graphs.geometry import area_vector, unit
from graphs.mechanism.sheet import Sheet, sides_of_face, with_all_edges
from graphs.tolerances import DOUBLE
from graphs.types import Floats, JointId, LinkId
from synth.drawing.scene.palette import FINE, NORMAL, STRONG
from synth.drawing.scene.shapes import Line, Point, Polygon, Shape
from synth.drawing.space.view import View, drawn_order
from synth.folding.configuration import SheetConfiguration

__all__ = ["HINGE", "Panels", "front_up", "panel_shapes", "panels_made", "panels_of", "same_side_up"]

HINGE = "H"
"""The letter of an edge that is a hinge of solids."""
_LETTERS = {"M": "mountain", "V": "valley", "U": "ink", "C": "cut", "B": "ink", HINGE: "class1"}
_LIGHT = unit([0.35, -0.45, 0.82])
_DARKEST = 0.5
"""Of the shadow, on a panel that the light does not meet."""


@dataclass(frozen=True, slots=True)
class Panels:
    """What is drawn of a sheet, or of solids, in space, at any configuration.

    `faces` are the vertices round each panel, the front of all on one side of the paper; a set of two vertices has
    its joint and its letter. `solid`: faces are those of solids, their front outside, and those that look away
    from the eye are hidden.
    """

    faces: Sequence[Sequence[int]]
    link_of: Mapping[int, LinkId]
    joint_of: Mapping[frozenset[int], JointId]
    letters: Mapping[frozenset[int], str]
    solid: bool = False


def panels_made(sheet: Sheet | SheetConfiguration) -> tuple[Sheet, SheetMechanism]:
    """Return a sheet as it was given, and its mechanism, which a configuration holds."""
    if isinstance(sheet, SheetConfiguration):
        return sheet.drawn, sheet.dual
    return sheet, mechanism_of_sheet(sheet)


def panels_of(sheet: Sheet | SheetConfiguration) -> Panels:
    """Return the panels of a sheet.

    Examples
    --------
    >>> roof = Sheet(4, ((0, 1),), "M", ((0, 1, 2), (0, 1, 3)), ((0, 0, 1), (0, 2, 1), (1, 1, 0), (-1, 1, 0)))
    >>> panels = panels_of(roof)
    >>> panels.faces, panels.joint_of
    ([(0, 1, 2), (3, 1, 0)], {frozenset({0, 1}): 0})
    """
    given, mechanism = panels_made(sheet)
    whole = with_all_edges(given)
    letters = {frozenset(edge): letter for edge, letter in zip(whole.edges, whole.assignments, strict=True)}
    return Panels(
        same_side_up(whole.faces),
        {face: link for link, faces in enumerate(mechanism.panels) for face in faces},
        {frozenset(edge): joint for joint, edges in mechanism.pieces.items() for edge in edges},
        letters,
    )


def same_side_up(faces: Sequence[Sequence[int]]) -> list[tuple[int, ...]]:
    """Return faces turned over where needed, so that those side by side show the same side of the paper.

    The first of each piece stays as it is. A strip that is twisted into itself has one side only: somewhere on it
    the colours change.

    >>> same_side_up([(0, 1, 2), (0, 1, 3)])
    [(0, 1, 2), (3, 1, 0)]
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


def front_up(panels: Panels, points: Floats, view: View) -> Panels:
    """Return panels with the sides exchanged if more of the backs than of the fronts would be seen.

    >>> from synth.drawing.space.view import view_of_motion
    >>> corners = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0.0]])
    >>> panels = panels_of(Sheet(3, (), "", ((0, 2, 1),)))
    >>> front_up(panels, corners, view_of_motion(corners)).faces
    [(1, 2, 0)]
    """
    if sum(float(area_vector(points[list(face)]) @ view.towards) for face in panels.faces) >= 0:
        return panels
    return replace(panels, faces=[tuple(face[::-1]) for face in panels.faces])


def panel_shapes(
    panels: Panels, points: Floats, view: View, page: Sequence[Point]
) -> tuple[list[Shape], dict[int, list[Point]]]:
    """Return the shapes of panels, those behind first; and the places of the corners of each, in this order.

    Parameters
    ----------
    panels : Panels
    points : float[n, 3]
    view : View
    page : sequence of (x, y)
        Where the vertices lie on the page.
    """
    shapes: list[Shape] = []
    corners: dict[int, list[Point]] = {}
    seen = _seen(panels, points, view)
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
        shapes += [_edge(panels, (a, b), [page[a], page[b]]) for a, b in sides_of_face(row)]
    return shapes, corners


def _seen(panels: Panels, points: Floats, view: View) -> list[int]:
    """Return the faces that can be seen: of solids, those that look towards the eye."""
    every = range(len(panels.faces))
    if not panels.solid:
        return list(every)
    return [face for face in every if float(area_vector(points[list(panels.faces[face])]) @ view.towards) > 0]


def _edge(panels: Panels, ends: tuple[int, int], row: list[Point]) -> Line:
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
