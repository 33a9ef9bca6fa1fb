"""The design sphere with orientations, relative axes, the hoop and what it crosses.

As Figs. 3 to 5 of Tipparthi and Larochelle 2011. The sphere is seen from far away (orthographic); what is on its
far side is dashed or open. Below it the crossings lie along the angle of the hoop.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from math import hypot

import numpy as np
import numpy.typing as npt

from graphs.arrays import Floats
from graphs.errors import UnsolvableError
from graphs.geometry import across, unit
from synth.drawing.labels import spread
from synth.drawing.scene.frame import Frame, page_of
from synth.drawing.scene.palette import FINE, NORMAL, SMALL, STRONG
from synth.drawing.scene.plot import Plot
from synth.drawing.scene.shapes import Disc, Label, Layer, Line, Point, Scene, Shape, text_width
from synth.drawing.space.view import View, view_from
from synth.guidance.order import Hoop, HoopCrossing, direction_words, pair_name
from synth.guidance.orientations import Orientations, unit_vector

__all__ = ["draw_hoop"]

NEEDED = "mountain"
_BODY = ("mountain", "cut", "valley")
"""Colours of the x, y and z axes of the body."""
_RADIUS, _SIDE = 140.0, 320.0
"""Of the sphere, and of the square that it takes, points."""
_STRIP = 76.0
_FINE = 181
_MOST_LABELLED = 7
"""Orientations; of more only the axes that decide are shown."""
_MOST_DRAWN = 15
_FAR = (2.0, 2.0)
_APART = hypot(text_width("S12", SMALL), SMALL) / _RADIUS
"""From name to name, in radii: as far as the letters of two reach, whichever way they lie."""


def draw_hoop(orientations: Orientations, axis: npt.ArrayLike, hoop: Hoop) -> Scene:
    """Return a picture of the design sphere with orientations, relative axes, the hoop and what it crosses.

    Parameters
    ----------
    orientations : Orientations
    axis : float[3]
        The fixed axis.
    hoop : Hoop
        Of :func:`synth.guidance.order.hoop`.

    Raises
    ------
    UnsolvableError
        If there are more than 15 orientations.

    Examples
    --------
    >>> from scipy.spatial.transform import Rotation
    >>> from synth.guidance.order import hoop
    >>> body = Rotation.from_euler("ZX", [(0, 0), (90, 30), (200, -20)], degrees=True)
    >>> given = Orientations.from_rotation(body)
    >>> [layer.name for layer in draw_hoop(given, (0, 0, 1), hoop(given, (0, 0, 1))).layers]
    ['sphere', 'hoop', 'orientations', 'axes', 'angles', 'caption']
    """
    g = unit_vector(axis, "fixed axis")
    if len(orientations) > _MOST_DRAWN:
        raise UnsolvableError(
            f"a picture of {len(orientations)} orientations shows nothing; {_MOST_DRAWN} at most"
        )
    start = unit(across(orientations.relative_axis(1, 2), g))
    beside = np.cross(g, start) * (1.0 if hoop.direction == "ccw" else -1.0)
    needed = set(hoop.required)
    shown = [c for c in hoop.crossings if c.pair in needed or len(orientations) <= _MOST_LABELLED]
    globe = _Globe(unit_vector(0.75 * beside + 0.45 * g + 0.25 * start))
    ends = _ends(orientations, g, start, beside, shown, needed)
    layers = [
        Layer("sphere", tuple(globe.graticule())),
        Layer("hoop", tuple(_hoops(globe, g, start, beside, hoop))),
        Layer("orientations", tuple(_bodies(globe, orientations))),
        Layer("axes", tuple(_marks(globe, ends, orientations))),
        Layer("angles", tuple(_strip(shown, needed))),
    ]
    verdict = "the order is kept" if hoop.in_order else "the order is not kept"
    said = [
        f"hoop about G, turning {direction_words(hoop.direction)} from S12: {verdict}; "
        "red, above the line: the axes that decide",
        "blue: the body's z axis at each orientation; red, green: towards its x, y; open or dashed: far side",
    ]
    return page_of(Frame(1, 0, 0, 0, 0, _SIDE, _SIDE + _STRIP), layers, said)


class _Globe:
    """The sphere as it is seen; G's axis is not tilted to a side."""

    def __init__(self, towards: Floats) -> None:
        upright = np.array([0.0, 0.0, 1.0]) if abs(towards[2]) < 0.9 else np.array([1.0, 0.0, 0.0])
        self._view: View = view_from(towards, upright)

    def row(self, points: Floats) -> list[Point]:
        """Return where points of the sphere lie on the page."""
        return [self.on_page(place) for place in self._view.places(points)]

    def on_page(self, place: Floats) -> Point:
        """Return where a place of the view lies."""
        return _SIDE / 2 + _RADIUS * float(place[0]), _SIDE / 2 - _RADIUS * float(place[1])

    def flat(self, points: Floats) -> tuple[Floats, list[bool]]:
        """Return places in the view, and whether points are on the near side."""
        return self._view.places(points), (self._view.near(points) >= 0.0).tolist()

    def curve(self, points: Floats, colour: str, width: float, *, far: bool = True) -> list[Shape]:
        """Return a curve, its pieces on the far side dashed, or left out."""
        row, (_, near) = self.row(points), self.flat(points)
        shapes: list[Shape] = []
        for here, run in groupby(range(len(row)), key=near.__getitem__):
            places = list(run)
            piece = row[max(places[0] - 1, 0) : places[-1] + 1]
            if here and len(piece) > 1:
                shapes.append(Line(piece, colour, width))
            elif far and len(piece) > 1:
                shapes.append(Line(piece, colour, 0.6 * width, _FAR))
        return shapes

    def graticule(self) -> list[Shape]:
        """Return the sphere with circles of 30 degrees on its near side."""
        turn = np.linspace(0.0, 2.0 * np.pi, 2 * _FINE - 1)
        shapes: list[Shape] = [Disc((_SIDE / 2, _SIDE / 2), _RADIUS, "front", "ink", NORMAL)]
        for north in np.radians(np.arange(-60, 61, 30)):
            ring = [np.cos(north) * np.cos(turn), np.cos(north) * np.sin(turn), np.full(len(turn), np.sin(north))]
            shapes += self.curve(np.stack(ring, 1), "faint", FINE, far=False)
        for east in np.radians(np.arange(0, 180, 30)):
            ring = [np.sin(turn) * np.cos(east), np.sin(turn) * np.sin(east), np.cos(turn)]
            shapes += self.curve(np.stack(ring, 1), "faint", FINE, far=False)
        return shapes


def _hoops(globe: _Globe, g: Floats, start: Floats, across: Floats, hoop: Hoop) -> list[Shape]:
    """Return the hoop where it starts, and where it crosses the axes that decide."""
    needed = set(hoop.required)
    half = np.linspace(0.0, np.pi, _FINE)[:, None]
    turned = [(0.0, "ink", STRONG), *((c.angle, NEEDED, NORMAL) for c in hoop.crossings if c.pair in needed)]
    shapes: list[Shape] = []
    for angle, colour, width in turned:
        side = np.cos(angle) * start + np.sin(angle) * across
        shapes += globe.curve(np.cos(half) * g + np.sin(half) * side, colour, width)
    return shapes


def _bodies(globe: _Globe, orientations: Orientations) -> list[Shape]:
    """Return orientations where the body's z axis meets the sphere, with short arcs towards its x and y axes."""
    reach = np.linspace(0.0, np.radians(11.0), 9)[:, None]
    shapes: list[Shape] = []
    for number, m in enumerate(orientations.matrices, start=1):
        for k in (0, 1):
            shapes += globe.curve(np.cos(reach) * m[:, 2] + np.sin(reach) * m[:, k], _BODY[k], 1.3)
        (at,) = globe.row(m[:, 2][None])
        near = globe.flat(m[:, 2][None])[1][0]
        shapes.append(Disc(at, 4.6, _BODY[2] if near else "paper", _BODY[2], NORMAL))
        shapes.append(Label(at, str(number), 0.8 * SMALL, "paper" if near else _BODY[2], bold=True, halo=False))
    return shapes


def _ends(
    orientations: Orientations, g: Floats, start: Floats, across: Floats, shown: Sequence[HoopCrossing],
    needed: set[tuple[int, int]],
) -> list[tuple[Floats, str, str]]:  # fmt: skip
    """Return the ends of axes that the hoop crosses, with their names and colours; that of S12 and of G."""
    first = orientations.relative_axis(1, 2)
    marks = [(np.copysign(1.0, first @ start) * first, "S12", "ink")]
    for crossing in shown:
        s = orientations.relative_axis(*crossing.pair)
        side = np.cos(crossing.angle) * start + np.sin(crossing.angle) * across
        colour = NEEDED if crossing.pair in needed else "ink"
        marks.append((s * np.copysign(1.0, s @ side), pair_name(crossing.pair), colour))
    return [*marks, (g, "G", "ink")]


def _marks(globe: _Globe, marks: Sequence[tuple[Floats, str, str]], orientations: Orientations) -> list[Shape]:
    """Return dots with names, which keep off each other and off the numbers of orientations."""
    at, near = globe.flat(np.array([point for point, _, _ in marks]))
    bodies, _ = globe.flat(orientations.matrices[:, :, 2])
    texts = spread(np.concatenate([at, bodies]), reach=0.085, gap=_APART)[: len(marks)]
    shapes: list[Shape] = []
    for spot, label_at, (_, name, colour), here in zip(at, texts, marks, near, strict=True):
        place, text_at = globe.on_page(spot), globe.on_page(label_at)
        shapes.append(Line([place, text_at], colour, FINE))
        shapes.append(Disc(place, 2.1, colour if here else "paper", colour, NORMAL))
        shapes.append(Label(text_at, name, SMALL, colour))
    return shapes


def _strip(shown: Sequence[HoopCrossing], needed: set[tuple[int, int]]) -> list[Shape]:
    """Return crossings along the angle of the hoop, those that decide above the line."""
    plot = Plot(6.0, _SIDE, _SIDE - 12.0, _STRIP - 26.0, (-13.0, 193.0), (-2.4, 2.4))
    shapes: list[Shape] = [Line([plot.at(-13.0, 0.0), plot.at(193.0, 0.0)], "ink", NORMAL)]
    deciding = [HoopCrossing((1, 2), 0.0), *(c for c in shown if c.pair in needed)]
    for crossings, sign, colour in (
        (deciding, 1.0, NEEDED),
        ([c for c in shown if c.pair not in needed], -1.0, "ink"),
    ):
        at = np.array([[np.degrees(c.angle) / 180.0, 0.0] for c in crossings]).reshape(-1, 2)
        text_at = 180.0 * spread(at, reach=0.0, gap=0.068, only_x=True)[:, 0]
        for crossing, x in zip(crossings, text_at.tolist(), strict=True):
            angle = float(np.degrees(crossing.angle))
            ends = [plot.at(angle, 0.0), plot.at(angle, 0.35 * sign), plot.at(x, 0.75 * sign)]
            shapes.append(Line(ends, colour, FINE))
            for line, text in enumerate((pair_name(crossing.pair), f"{angle:.1f}")):
                level = (0.85 + 0.32) * sign + 0.66 * ((1 - line) if sign > 0 else -line)
                shapes.append(Label(plot.at(x, level), text, 0.8 * SMALL, colour, halo=False))
    shapes += plot.below(range(0, 181, 30), "angle of the hoop from S12, degrees")
    return shapes
