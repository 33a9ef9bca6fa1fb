"""Cones and cylinders: linkages on them, where loops close, what rounding leaves open, several loops, steps."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import cos, degrees, hypot, pi, radians, sin

import numpy as np

import synth
from drawings.altered import cropped, legible, thinned
from drawings.examples import DATA
from drawings.pieces import arrow, head, of_shapes
from drawings.together import above, beside, said
from graphs.errors import InvariantError
from graphs.mechanism.surfaces import Cone
from graphs.types import Floats
from synth.linkages.conformed.linkage_behaviour import OnSurface, linkage_on_surfaces, loop_of_steps, loop_on_cones
from synth.linkages.conformed.rates import ConformedChain
from synth.linkages.conformed.rates_over_angles import links_in_layers
from synth.linkages.surfaces.circuit import link_angles, loop_steps, wrapped
from synth.linkages.surfaces.loop_maps import cone_reach, map_to_cones
from synth.linkages.surfaces.loop_sums import loop_sum, sum_rounding
from synth.making.drawing import Scene
from synth.making.drawing.conformed import surface_layer
from synth.making.drawing.mechanisms.chains import ChainLook, chain_scene
from synth.making.drawing.scene.frame import PictureOptions, Plot, round_steps, signed
from synth.making.drawing.scene.shapes import (
    FINE,
    NORMAL,
    STRONG,
    Disc,
    Label,
    Layer,
    Line,
    Point,
    Polygon,
    Shape,
    arc_points,
)
from synth.making.drawing.sums import draw_loop_sums

__all__ = ["DRAWINGS"]

_CONE = 200.0
"""Of the square of a cone, points."""


@dataclass(frozen=True, slots=True)
class _Circle:
    """The circle seen from the apex: azimuths 0 on top, counter-clockwise.

    Attributes
    ----------
    radius : float
        Points; the middle is at (0, 0).
    """

    radius: float

    def at(self, azimuth: float, part: float = 1.0) -> Point:
        """Return a place at an azimuth, on a part of the radius."""
        far = part * self.radius
        return -far * sin(azimuth), -far * cos(azimuth)

    def arc(self, first: float, last: float, part: float) -> list[Point]:
        """Return the places of an arc."""
        return arc_points((0.0, 0.0), part * self.radius, -first - pi / 2, -last - pi / 2)

    def joints(self, azimuths: Sequence[float], names: Sequence[str], part: float = 1.16) -> list[Shape]:
        """Return joints with their names outside."""
        shapes: list[Shape] = [Disc(self.at(azimuth), 2.4, "paper", "ink", NORMAL) for azimuth in azimuths]
        return shapes + [Label(self.at(azimuth, part), name) for azimuth, name in zip(azimuths, names, strict=True)]

    def ring(self) -> Disc:
        """Return the circle itself."""
        return Disc((0.0, 0.0), self.radius, None, "grey", FINE)


def _cone_of(linkage: OnSurface, side: float = _CONE) -> Scene:
    """Return a linkage on its cone."""
    if linkage.surface is None:
        raise InvariantError("cone", "a linkage that is on any cone", "one with a cone angle")
    chain, places = ConformedChain.of(linkage.chain), np.asarray(linkage.places)
    layer = surface_layer(chain, places, links_in_layers(chain, places), linkage.surface, side)
    scene = cropped(thinned(Scene(side, side, (_without_title(layer),)), 0.12))
    return said(scene, f"cone of λ = {degrees(linkage.cone_angle or 0.0):.4g}°")


def _without_title(layer: Layer) -> Layer:
    """Return a layer without labels that name nothing in it."""
    return Layer(layer.name, tuple(one for one in layer.shapes if not isinstance(one, Label) or one.data))


def _polygon(azimuths: Sequence[float], names: Sequence[str], told: Sequence[str], radius: float = 56.0) -> Scene:
    """Return a loop on its circle, each link with what is told of it."""
    circle = _Circle(radius)
    ends = list(pairwise([*azimuths, azimuths[0]]))
    shapes: list[Shape] = [circle.ring()]
    shapes += [Line([circle.at(a), circle.at(b)], "ink", STRONG) for a, b in ends]
    for (a, b), text in zip(ends, told, strict=True):
        (ax, ay), (bx, by) = circle.at(a), circle.at(b)
        # long links of a crossed loop are near each other in the middle; beside short ones there is room outside
        along = (ax + 0.36 * (bx - ax), ay + 0.36 * (by - ay))
        short = hypot(bx - ax, by - ay) < radius
        shapes.append(Label(circle.at(a + float(wrapped(b - a)) / 2, 1.17) if short else along, text))
    return cropped(of_shapes(1.0, 1.0, [*shapes, *circle.joints(azimuths, names)]))


_FOUR_BAR = (120.0, 95.0, 45.0, 85.0)
"""Link angles, degrees, of a four-bar with an open and a crossed cone."""


def mapping() -> Scene:
    """A four-bar on each of its cones, and each seen along the axis."""
    angles = np.radians(_FOUR_BAR)
    columns = []
    for linkage, cone in zip(loop_on_cones(angles), map_to_cones(angles).cones, strict=True):
        told = [f"{angle:.0f}°" for angle in np.degrees(link_angles(cone.steps, cone.size))]
        polygon = _polygon(linkage.places, list(map(str, linkage.chain.joints)), told)
        columns.append(said(above(_cone_of(linkage), polygon, gap=8.0), f"seen along the axis: {cone.circuit}"))
    return beside(*columns, gap=40.0)


def loop_sums() -> Scene:
    """The sums of a four-bar against lambda, and the circles where one is a multiple of 360 degrees."""
    angles = np.radians(_FOUR_BAR)
    mapped = map_to_cones(angles)
    circles = []
    for linkage, cone in zip(loop_on_cones(angles), mapped.cones, strict=True):
        told = [f"{signed(round(step))}°" for step in np.degrees(cone.steps)]
        signs = "".join("+" if sign > 0 else "−" for sign in cone.signs)
        polygon = _polygon(linkage.places, [""] * 4, told, 48.0)
        circles.append(said(polygon, f"{signs} at λ = {degrees(cone.size):.4g}°:", f"sum {360 * cone.turns}°"))
    return beside(cropped(thinned(draw_loop_sums(mapped))), above(*circles, gap=10.0), gap=8.0)


_TOUCHING = (115.0, 105.0, 55.0, 105.0, 41.55416091566444)
"""Link angles, degrees: with signs + - + - + their sum touches 0 where it is least, as well as floats can say."""


def rounding() -> Scene:
    """A loop sum that touches zero: all of it, and so near that only its rounding is left to see."""
    angles = np.radians(_TOUCHING)
    [touching] = [cone for cone in map_to_cones(angles).cones if cone.double]
    reach, signs = cone_reach(angles), np.array(touching.signs)

    def sum_at(lam: Floats) -> Floats:
        return np.degrees(loop_sum(np.tan(lam) ** 2, reach, signs, 1))

    size = touching.size
    lowest, highest = touching.bounds
    far = np.linspace(0.0, float(np.arctan(np.sqrt(reach.min()))), 200)
    near = np.linspace(lowest - 0.8 * (size - lowest), highest + 0.8 * (highest - size), 240)
    whole, close = sum_at(far), sum_at(near)
    band = float(np.degrees(sum_rounding(np.tan(size) ** 2, reach, signs, 1)))
    left = Plot(26.0, 16.0, 170.0, 120.0, (0.0, degrees(far[-1])), (-2.0, float(whole.max())))
    dot = Disc(left.at(degrees(size), 0.0), 2.8, "class1", "paper", FINE)
    shapes: list[Shape] = [_level(left), Line(left.row(np.degrees(far), whole), "class0", STRONG), dot]
    shapes += left.below(round_steps(*left.x), "cone angle λ (degrees)")
    shapes += left.beside([0.0, 5.0, 10.0], "loop sum (degrees)")
    nearer = round((far[-1] - far[0]) / (near[-1] - near[0]), -5)
    return beside(
        thinned(of_shapes(205.0, 160.0, shapes)),
        arrow(f"{nearer:,.0f}".replace(",", " "), "times nearer"),
        thinned(_band(np.degrees(near - size), close, band)),
        gap=6.0,
    )


def _level(plot: Plot) -> Line:
    return Line([plot.at(plot.x[0], 0.0), plot.at(plot.x[1], 0.0)], "grey", FINE, (4.0, 3.0))


def _band(off: Floats, sums: Floats, band: float) -> Scene:
    """Return a sum near zero, in units of 1e-13 degrees against 1e-6 degrees, with the band of its rounding."""
    across, up = off * 1e6, sums * 1e13
    rim = band * 1e13
    plot = Plot(26.0, 16.0, 170.0, 120.0, (float(across[0]), float(across[-1])), (-1.6 * rim, float(up.max())))
    inside = np.flatnonzero(sums <= band)
    edges = [float(across[inside[0]]), float(across[inside[-1]])]
    corners = [(plot.x[0], -rim), (plot.x[1], -rim), (plot.x[1], rim), (plot.x[0], rim)]
    shapes: list[Shape] = [Polygon([plot.at(*corner) for corner in corners], "marked")]
    shapes += [
        Line([plot.at(edge, plot.y[0]), plot.at(edge, 1.8 * rim)], "class1", NORMAL, (2.0, 2.0)) for edge in edges
    ]
    shapes += [_level(plot), Line(plot.row(across, up), "class0", NORMAL)]
    shapes.append(Label(plot.at(0.0, 2.3 * rim), "a circle may be between"))
    shapes.append(Label(plot.at(0.7 * plot.x[0], 0.5 * rim), "rounding"))
    shapes += plot.below(round_steps(*plot.x, 5), "λ less that of the dot (1e-6 degrees)")
    shapes += plot.beside(round_steps(*plot.y, 4), "loop sum (1e-13 degrees)")
    return of_shapes(205.0, 160.0, shapes)


def multiloop() -> Scene:
    """A Stephenson linkage: its chain, its two loops on one circle, and on a cone."""
    linkage = synth.read(DATA / "surfaces" / "fig11-stephenson.json")
    places = linkage.places()
    names = [str(joint) for joint in linkage.chain.joints]
    chain = chain_scene(linkage.chain, PictureOptions(box=(140, 140), caption=None), look=ChainLook(link_numbers=False))
    circle = _Circle(58.0)
    shapes: list[Shape] = [circle.ring()]
    told = []
    looks: list[tuple[str, tuple[float, ...]]] = [("class0", ()), ("class1", (5.0, 2.0))]
    for loop, (colour, dash) in zip(loop_steps(linkage.chain, places), looks, strict=True):
        corners = [circle.at(places[names.index(str(joint))]) for joint in (*loop.joints, loop.joints[0])]
        shapes.append(Line(corners, colour, STRONG, dash))
        how = "open" if loop.circuits.open else "crossed"
        name = " ".join(map(str, loop.joints)) + (" (dashed)" if dash else "")
        told.append(f"{name}: {how}, sum {360 * int(loop.circuits.turns)}°")
    drawn = cropped(of_shapes(1.0, 1.0, [*shapes, *circle.joints(places, names)]))
    [on_cone] = linkage_on_surfaces(linkage)
    return beside(
        said(cropped(legible(chain, joints=True)), "the chain"), said(drawn, *told), _cone_of(on_cone, 160.0), gap=16.0
    )


def conformed() -> Scene:
    """A four-bar at its conformed position: on the cone, and along its axis with the steps."""
    linkage = loop_of_steps(np.radians([40, 60, 70]), Cone(radians(35)))
    names = list(map(str, linkage.chain.joints))
    [loop] = loop_steps(linkage.chain, linkage.places)
    circle = _Circle(60.0)
    shapes: list[Shape] = [circle.ring()]
    shapes += [Line([(0.0, 0.0), circle.at(place)], "grey", FINE, (2.0, 2.0)) for place in linkage.places]
    corners = [circle.at(place) for place in linkage.places]
    shapes.append(Line([*corners, corners[0]], "ink", STRONG))
    for joint, step in zip(loop.joints, loop.steps.tolist(), strict=True):
        shapes += _step(circle, linkage.places[names.index(str(joint))], step)
    drawn = cropped(of_shapes(1.0, 1.0, [*shapes, *circle.joints(linkage.places, names)]))
    total = f"steps along the axis: their sum is {360 * int(loop.circuits.turns)}°"
    return beside(_cone_of(linkage), said(drawn, total), gap=30.0)


def _step(circle: _Circle, first: float, step: float) -> list[Shape]:
    """Return a step with its degrees, an arrow round the circle; those that lead back are farther out."""
    part = 1.36 if step > 0 else 1.66
    air = 0.05 if step > 0 else -0.05
    last = first + step - air
    return [
        Line(circle.arc(first + air, last, part), "class0", NORMAL),
        head(circle.at(last - air, part), circle.at(last, part), "class0"),
        Label(circle.at(first + step / 2, part), f"{'+' * (step > 0)}{signed(round(degrees(step)))}°"),
    ]


DRAWINGS: dict[str, Callable[[], Scene]] = {
    "mapping": mapping,
    "loop-sums": loop_sums,
    "rounding": rounding,
    "multiloop": multiloop,
    "conformed": conformed,
}
