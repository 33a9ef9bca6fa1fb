"""A body guided through orientations: in order, by dyads, by four-bars."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import groupby

import numpy as np

import synth
from drawings.altered import cropped, legible, thinned
from drawings.examples import DATA
from drawings.pieces import in_rows, of_shapes
from drawings.together import beside, said
from graphs.types import Floats
from synth.linkages.guidance.dyads import Dyad
from synth.linkages.guidance.fourbars import GuidedFourBar
from synth.linkages.guidance.order import hoop
from synth.linkages.guidance.orientations import Orientations, read_orientations
from synth.making.drawing import Scene
from synth.making.drawing.scene.shapes import FINE, NORMAL, Disc, Label, Line, Point, Polygon, Shape
from synth.making.drawing.space.panels import View, view_from
from synth.making.drawing.sphere import draw_hoop, spread

__all__ = ["DRAWINGS"]

_CRANK_ROCKER = DATA / "orientations" / "crank-rocker.json"
_FAR = (2.0, 2.0)


@dataclass(frozen=True, slots=True)
class _Globe:
    """The sphere of directions, seen from far away.

    Attributes
    ----------
    view : View
    radius : float
        Points; the middle is at (0, 0).
    """

    view: View
    radius: float

    def at(self, point: Floats) -> Point:
        """Return where a point of the sphere is seen."""
        x, y = self.view.places(point).tolist()
        return self.radius * x, -self.radius * y

    def is_near(self, point: Floats) -> bool:
        """Return whether a point is on the side that is seen."""
        return bool(self.view.near(point) >= 0.0)

    def curve(self, points: Floats, colour: str, width: float) -> list[Shape]:
        """Return a curve, dashed where it is on the far side."""
        shapes: list[Shape] = []
        for near, run in groupby(range(len(points) - 1), key=lambda k: self.is_near(points[k] + points[k + 1])):
            places = list(run)
            row = [self.at(point) for point in points[places[0] : places[-1] + 2]]
            shapes.append(Line(row, colour, width if near else FINE, () if near else _FAR))
        return shapes

    def marked(self, points: Floats, colour: str) -> list[Shape]:
        """Return dots, empty on the far side, numbered from one; the numbers keep off each other."""
        places = [self.at(point) for point in points]
        shapes: list[Shape] = [
            Disc(place, 2.6, colour if self.is_near(point) else "paper", colour, NORMAL)
            for place, point in zip(places, points, strict=True)
        ]
        beside_them = spread(np.array(places), reach=7.5, gap=9.0).tolist()
        return shapes + [Label((x, y), str(number), bold=True) for number, (x, y) in enumerate(beside_them, start=1)]

    def whole(self) -> Disc:
        """Return the sphere itself."""
        return Disc((0.0, 0.0), self.radius, "front", "grey", NORMAL)


def order() -> Scene:
    """The hoop about a fixed axis that keeps the order of four orientations."""
    five = read_orientations(_CRANK_ROCKER)
    dyad = next(one for one in synth.guiding_dyads(five).dyads if one.in_order)
    orientations = Orientations(five.quaternions[:4])
    turning = hoop(orientations, dyad.fixed, dyad.direction or "ccw")
    return cropped(thinned(legible(draw_hoop(orientations, dyad.fixed, turning))))


def dyads() -> Scene:
    """All dyads of five orientations: the moving axis at each lies on a circle about the fixed one."""
    orientations = read_orientations(DATA / "orientations" / "tipparthi.json")
    pictures = []
    for number, dyad in enumerate(synth.guiding_dyads(orientations).dyads, start=1):
        kept = "in order" if dyad.in_order else "not in order"
        pictures.append(said(_circling(orientations, dyad), f"dyad {number}: {kept}"))
    return in_rows(pictures, 3, gap=18.0, down=8.0)


def _circling(orientations: Orientations, dyad: Dyad) -> Scene:
    """Return a dyad at all orientations: its fixed axis G, and its moving axis at each."""
    moving = orientations.matrices @ dyad.moving
    upright = np.eye(3)[int(np.abs(dyad.fixed).argmin())]
    globe = _Globe(view_from(0.92 * dyad.fixed + 0.39 * _across(dyad.fixed, upright), dyad.fixed), 62.0)
    first = _across(dyad.fixed, moving[0])
    turns = np.linspace(0.0, 2.0 * np.pi, 121)[:, None]
    round_it = np.cos(turns) * first + np.sin(turns) * np.cross(dyad.fixed, first)
    circle = np.cos(dyad.link_angle) * dyad.fixed + np.sin(dyad.link_angle) * round_it
    shapes: list[Shape] = [globe.whole(), *globe.curve(circle, "class0", NORMAL)]
    for point in moving:
        shapes += globe.curve(_arc(dyad.fixed, point), "grey", NORMAL)
    shapes += globe.marked(moving, "class0")
    x, y = globe.at(dyad.fixed)
    shapes += [Disc((x, y), 4.6, "ink", None), Label((x, y), "G", colour="paper", bold=True, halo=False)]
    return cropped(thinned(of_shapes(1.0, 1.0, shapes)))


def _across(axis: Floats, vector: Floats) -> Floats:
    """Return the part of a vector across an axis, of length one."""
    part = vector - (vector @ axis) * axis
    return np.asarray(part / np.linalg.norm(part))


def _arc(first: Floats, last: Floats) -> Floats:
    """Return the shorter arc from a point of the sphere to another: float[k, 3]."""
    angle = float(np.arccos(np.clip(first @ last, -1.0, 1.0)))
    turns = np.linspace(0.0, angle, 25)[:, None]
    return np.asarray(np.cos(turns) * first + np.sin(turns) * _across(first, last))


_SHOWN = (0, 2, 4)
"""Of five orientations."""


def guidance() -> Scene:
    """A four-bar without defect at three of the orientations through which it guides its coupler."""
    orientations = read_orientations(_CRANK_ROCKER)
    best = synth.four_bars(orientations, synth.guiding_dyads(orientations).dyads)[0]
    pictures = [
        said(_guided(orientations, best, number), f"orientation {number + 1}, driver at {_driver_at(best, number)}")
        for number in _SHOWN
    ]
    return beside(*pictures, gap=14.0)


def _driver_at(four_bar: GuidedFourBar, number: int) -> str:
    return f"{np.degrees(four_bar.angles[number]):.0f}°"


def _guided(orientations: Orientations, four_bar: GuidedFourBar, number: int) -> Scene:
    """Return a four-bar at an orientation, its body filled, and the body at the others."""
    matrices = orientations.matrices
    driver, follower = four_bar.driver, four_bar.follower
    corners = np.stack([driver.moving, follower.moving, _third(driver.moving, follower.moving)])
    bodies = np.einsum("nij,kj->nki", matrices, corners)
    middle = bodies.mean(axis=(0, 1)) + driver.fixed + follower.fixed
    globe = _Globe(view_from(middle, np.array([0.0, 0.0, 1.0])), 70.0)
    shapes: list[Shape] = [globe.whole()]
    for place, body in enumerate(bodies):
        rim = np.concatenate([_arc(body[k], body[(k + 1) % 3]) for k in range(3)])
        if place == number:
            shapes.append(Polygon([globe.at(point) for point in rim], "marked"))
        shapes += globe.curve(rim, "ink" if place == number else "flat", NORMAL if place == number else FINE)
    first, second, _ = bodies[number]
    shapes += globe.curve(_arc(driver.fixed, follower.fixed), "ground", 4.0)
    shapes += globe.curve(_arc(driver.fixed, first), "class0", 2.4)
    shapes += globe.curve(_arc(follower.fixed, second), "class1", 2.4)
    shapes += [Disc(globe.at(point), 2.2) for point in (driver.fixed, follower.fixed, first, second)]
    (ax, ay), (bx, by) = globe.at(driver.fixed), globe.at(follower.fixed)
    shapes += [Label((ax - 10.0, ay), "G1"), Label((bx, by + 9.0), "G2")]
    return cropped(thinned(of_shapes(1.0, 1.0, shapes)))


def _third(first: Floats, second: Floats) -> Floats:
    """Return a corner of the body beside its two axes, by which one sees how it is turned."""
    middle, aside = (first + second) / 2, np.cross(first, second)
    corner = middle / np.linalg.norm(middle) + 0.5 * aside / np.linalg.norm(aside)
    return np.asarray(corner / np.linalg.norm(corner))


DRAWINGS: dict[str, Callable[[], Scene]] = {"order": order, "dyads": dyads, "guidance": guidance}
