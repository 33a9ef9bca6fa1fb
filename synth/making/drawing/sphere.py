"""Orientations of a body on the sphere: the hoop and the axes that it crosses; maps of axes that keep the order.

The design sphere with the hoop is as in Figs. 3 to 5 of Tipparthi and Larochelle 2011: it is seen from far away
(orthographic), curves on its far side are dashed, points open; below it the crossings lie along the angle of the
hoop. The map is that of Hammer, which keeps areas (as Fig. 6 there).
"""

from collections.abc import Callable, Iterable, Sequence
from itertools import groupby, pairwise
from math import hypot
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.errors import UnsolvableError, numbered
from graphs.files.outputs import check_installed
from graphs.geometry import across, signed_area, unit
from graphs.types import Flags, Floats
from synth.linkages.guidance.dyads import AxisCurve, Dyad
from synth.linkages.guidance.order import Hoop, HoopCrossing, direction_words, order_verdicts, pair_name
from synth.linkages.guidance.orientations import Orientations, unit_vector
from synth.making.drawing.scene.frame import COLUMN, PictureFrame, Plot, framed, page_of
from synth.making.drawing.scene.shapes import (
    FINE,
    NORMAL,
    SMALL,
    STRONG,
    Disc,
    Label,
    Layer,
    Line,
    Point,
    Polygon,
    Shape,
    text_width,
)
from synth.making.drawing.scene.writing import Scene
from synth.making.drawing.space.panels import View, view_from

CCW, CW, NEITHER = "class0", "class1", "body"
"""Colours of regions of the map: in order with a crank that turns so, or not in order."""
_NEEDED = "mountain"
"""Colour of the axes that decide."""
_BODY = ("mountain", "cut", "valley")
"""Colours of the x, y and z axes of the body."""
_DASHES = {CCW: (), CW: (2.0, 1.5)}
_RADIUS, _SIDE = 140.0, 320.0
"""Radius of the sphere, and side of its square, points."""
_STRIP = 76.0
"""Height of the line of crossings below the sphere, points."""
_FINE = 181
_MOST_LABELLED = 7
"""Largest number of orientations of which all relative axes are shown; of more only the axes that decide."""
_MOST_DRAWN = 15
_FAR = (2.0, 2.0)
_APART = hypot(text_width("S12", SMALL), SMALL) / _RADIUS
"""Distance of names, in radii: the diagonal of a name, so that they are free in any direction."""
_OVER = 0.3
"""Largest distance on the map of neighbouring points of a curve that does not go over the edge of the map."""
_REACH = 0.13
_ROUNDS = 400
_WIDE, _HIGH = 2.0 * np.sqrt(2.0), np.sqrt(2.0)
_BISECTIONS = 12
_ROUND = 1e-4
"""Largest change of simplified outlines, in units of the sphere's radius."""


def draw_hoop(orientations: Orientations, axis: npt.ArrayLike, hoop: Hoop) -> Scene:
    """Return a picture of the design sphere with orientations, relative axes, the hoop and what it crosses.

    Parameters
    ----------
    orientations : Orientations
    axis : float[3]
        The fixed axis.
    hoop : Hoop
        Result of :func:`synth.linkages.guidance.order.hoop`.

    Raises
    ------
    UnsolvableError
        If there are more than 15 orientations.

    Examples
    --------
    >>> from scipy.spatial.transform import Rotation
    >>> from synth.linkages.guidance.order import hoop
    >>> body = Rotation.from_euler("ZX", [(0, 0), (90, 30), (200, -20)], degrees=True)
    >>> task = Orientations.from_rotation(body)
    >>> [layer.name for layer in draw_hoop(task, (0, 0, 1), hoop(task, (0, 0, 1))).layers]
    ['sphere', 'hoop', 'orientations', 'axes', 'angles', 'caption']
    """
    g = unit_vector(axis, "fixed axis")
    if len(orientations) > _MOST_DRAWN:
        raise UnsolvableError(f"{len(orientations)} orientations are too many for a picture; at most {_MOST_DRAWN}")
    start = unit(across(orientations.relative_axis(*hoop.start), g))
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
        f"hoop about G, turning {direction_words(hoop.direction)} from {pair_name(hoop.start)}: {verdict}; "
        "red, above the line: the axes that decide",
        "blue: the body's z axis at each orientation; red, green: towards its x, y; open or dashed: far side",
    ]
    return page_of(PictureFrame(1, 0, 0, 0, 0, _SIDE, _SIDE + _STRIP), layers, said)


class _Globe:
    """The sphere as it is seen; the axis G is not tilted to a side."""

    def __init__(self, towards: Floats) -> None:
        upright = np.array([0.0, 0.0, 1.0]) if abs(towards[2]) < 0.9 else np.array([1.0, 0.0, 0.0])
        self._view: View = view_from(towards, upright)

    def row(self, points: Floats) -> list[Point]:
        """Return the places of points of the sphere on the page."""
        return [self.on_page(place) for place in self._view.places(points)]

    def on_page(self, place: Floats) -> Point:
        """Return the place on the page of a place of the view."""
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
            shapes += self.curve(_parallel(north, turn), "faint", FINE, far=False)
        for east in np.radians(np.arange(0, 180, 30)):
            ring = [np.sin(turn) * np.cos(east), np.sin(turn) * np.sin(east), np.cos(turn)]
            shapes += self.curve(np.stack(ring, 1), "faint", FINE, far=False)
        return shapes


def _parallel(north: float, turn: Floats) -> Floats:
    """Return points of a circle of latitude, float[n, 3], radians."""
    ring = [np.cos(north) * np.cos(turn), np.cos(north) * np.sin(turn), np.full(len(turn), np.sin(north))]
    return np.stack(ring, 1)


def _hoops(globe: _Globe, g: Floats, start: Floats, across: Floats, hoop: Hoop) -> list[Shape]:
    """Return the hoop where it starts, and where it crosses the axes that decide."""
    needed = set(hoop.required)
    half = np.linspace(0.0, np.pi, _FINE)[:, None]
    turned = [(0.0, "ink", STRONG), *((c.angle, _NEEDED, NORMAL) for c in hoop.crossings if c.pair in needed)]
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
    """Return the ends of axes that the hoop crosses, of S12 and of G, with their names and colours."""
    first = orientations.relative_axis(1, 2)
    marks = [(np.copysign(1.0, first @ start) * first, "S12", "ink")]
    for crossing in shown:
        s = orientations.relative_axis(*crossing.pair)
        side = np.cos(crossing.angle) * start + np.sin(crossing.angle) * across
        colour = _NEEDED if crossing.pair in needed else "ink"
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
        (deciding, 1.0, _NEEDED),
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


def draw_map(
    orientations: Orientations, dyads: Iterable[Dyad] = (), curves: Iterable[AxisCurve] = (), width: int = 600
) -> Scene:
    """Return a map of the sphere: the order-defect verdict of each fixed axis, with relative axes and dyads.

    Parameters
    ----------
    orientations : Orientations
    dyads : iterable of Dyad, optional
        Their fixed axes are marked and numbered from 1.
    curves : iterable of AxisCurve, optional
        Curves of fixed axes, where there are four orientations.
    width : int, optional
        Columns of the grid on which verdicts are computed; borders between them are found more finely.

    Examples
    --------
    >>> from scipy.spatial.transform import Rotation
    >>> body = Rotation.from_euler("ZX", [(0, 0), (90, 30), (200, -20)], degrees=True)
    >>> [layer.name for layer in draw_map(Orientations.from_rotation(body), width=60).layers]
    ['regions', 'lines', 'axes', 'legend', 'caption']
    """
    frame = framed([(-2 * 2**0.5, -(2**0.5)), (2 * 2**0.5, 2**0.5)], COLUMN, (COLUMN, COLUMN), margin=14.0)
    axes = orientations.relative_axes() if len(orientations) <= _MOST_LABELLED else {}
    lines = [(end, pair_name(pair), "ink") for pair, s in axes.items() for end in (s, -s)]
    numbers = [(end, str(k), "mountain") for k, dyad in enumerate(dyads, start=1) for end in (dyad.fixed, -dyad.fixed)]
    layers = [
        Layer("regions", tuple(_regions(orientations, frame, width))),
        Layer("lines", (*_graticule_of_map(frame), *_curves(frame, curves))),
        Layer("axes", tuple(_marks_on_map(frame, lines, numbers))),
        Layer("legend", tuple(_legend(frame))),
    ]
    said = f"order of {numbered(len(orientations), 'orientation')} by fixed axis; all of the sphere, z on top"
    if axes:
        said += "; dots: relative axes, both ends"
    page = PictureFrame(1, 0, 0, 0, 0, frame.width, frame.height + 2 * SMALL)
    return page_of(page, layers, [said + ("; stars: fixed axes of dyads" if numbers else "")])


def _regions(orientations: Orientations, frame: PictureFrame, width: int) -> list[Shape]:
    """Return the map and its regions, larger ones first, so that a region inside a hole lies above it."""
    turn = np.linspace(0.0, 2.0 * np.pi, 181)
    rim = np.column_stack([2 * np.sqrt(2.0) * np.cos(turn), np.sqrt(2.0) * np.sin(turn)])
    regions: list[tuple[float, bool, Polygon]] = []
    for verdict, colour in ((1, CCW), (-1, CW)):
        for rings in _region(lambda points, of=verdict: order_verdicts(orientations, points) == of, width):  # type: ignore[misc]
            for ring, hole in rings:
                shape = Polygon(frame.row(ring[:-1].tolist()), NEITHER if hole else colour, None)
                regions.append((abs(float(signed_area(ring))), not hole, shape))
    regions.sort(key=lambda item: (-item[0], item[1]))
    whole = Polygon(frame.row(rim[:-1].tolist()), NEITHER, None)
    outlines = [
        Line([*shape.points, shape.points[0]], "ink", FINE / 2, _DASHES[shape.fill])
        for _, _, shape in regions
        if shape.fill in _DASHES
    ]
    return [whole, *(shape for _, _, shape in regions), *outlines]


def _graticule_of_map(frame: PictureFrame) -> list[Shape]:
    """Return circles of 30 degrees, and the edge of the map."""
    turn = np.linspace(-np.pi + 1e-9, np.pi - 1e-9, 181)
    half = np.linspace(-np.pi / 2, np.pi / 2, 91)
    shapes: list[Shape] = []
    for north in np.radians(np.arange(-60, 61, 30)):
        shapes.append(_line(frame, _parallel(north, turn), "paper", FINE))
    for degrees in range(-180, 181, 30):
        east = np.radians(np.clip(degrees, -180 + 1e-6, 180 - 1e-6))
        ring = np.stack([np.cos(half) * np.cos(east), np.cos(half) * np.sin(east), np.sin(half)], 1)
        edge = abs(degrees) == 180
        shapes.append(_line(frame, ring, "ink" if edge else "paper", NORMAL if edge else FINE))
    return shapes


def _line(frame: PictureFrame, points: Floats, colour: str, width: float) -> Line:
    return Line(frame.row(np.column_stack(hammer(points)).tolist()), colour, width)


def _curves(frame: PictureFrame, curves: Iterable[AxisCurve]) -> list[Shape]:
    """Return closed curves, broken where they go over the edge of the map."""
    shapes: list[Shape] = []
    for curve in curves:
        for ends in (curve.fixed, -curve.fixed):
            places = np.column_stack(hammer(np.concatenate([ends, ends[:1]])))
            over = np.flatnonzero(np.hypot(*np.diff(places, axis=0).T) > _OVER) + 1
            for first, last in pairwise([0, *over.tolist(), len(places)]):
                if last - first > 1:
                    shapes.append(Line(frame.row(places[first:last].tolist()), "ink", NORMAL))
    return shapes


def _marks_on_map(
    frame: PictureFrame, lines: Sequence[tuple[Floats, str, str]], numbers: Sequence[tuple[Floats, str, str]]
) -> list[Shape]:
    every = [*lines, *numbers]
    if not every:
        return []
    at = np.column_stack(hammer(np.array([point for point, _, _ in every])))
    places = spread(at, reach=_REACH, gap=_REACH)
    shapes: list[Shape] = []
    for k, (spot, label_at, (_, name, colour)) in enumerate(zip(at, places, every, strict=True)):
        here, there = frame.at(spot.tolist()), frame.at(label_at.tolist())
        shapes.append(Line([here, there], colour, FINE / 2))
        if k < len(lines):
            shapes.append(Disc(here, 1.3, colour, "paper", FINE))
        else:
            shapes.append(_star(here, colour))
        shapes.append(Label(there, name, 0.8 * SMALL, colour))
    return shapes


def _star(at: tuple[float, float], colour: str) -> Polygon:
    turns = np.pi * np.arange(10) / 5
    radii = np.where(np.arange(10) % 2, 1.5, 3.6)
    corners = zip((at[0] + radii * np.sin(turns)).tolist(), (at[1] - radii * np.cos(turns)).tolist(), strict=True)
    return Polygon(list(corners), colour, "paper", FINE)


def _legend(frame: PictureFrame) -> list[Shape]:
    entries = (
        ("in order, crank counter-clockwise", CCW),
        ("in order, crank clockwise (dashed rim)", CW),
        ("order defect", NEITHER),
    )
    shapes: list[Shape] = []
    for (text, colour), x in zip(entries, (14.0, 136.0, 276.0), strict=True):
        y = frame.height + SMALL / 2
        box = [(x, y - 2.6), (x + 9, y - 2.6), (x + 9, y + 2.6), (x, y + 2.6)]
        shapes.append(Polygon(box, colour, "grey", FINE))
        shapes.append(Label((x + 12, y), text, 0.9 * SMALL, anchor="start", halo=False))
    return shapes


def hammer(points: Floats) -> tuple[Floats, Floats]:
    """Return points of the sphere, float[n, 3], z upwards, on the Hammer map: x and y.

    There |x| <= 2 sqrt 2, |y| <= sqrt 2.
    """
    east, north = np.arctan2(points[:, 1], points[:, 0]), np.arcsin(np.clip(points[:, 2], -1.0, 1.0))
    scale = np.sqrt(2.0 / (1.0 + np.cos(north) * np.cos(east / 2.0)))
    return 2.0 * scale * np.cos(north) * np.sin(east / 2.0), scale * np.sin(north)


def hammer_inverse(x: Floats, y: Floats) -> tuple[Floats, npt.NDArray[np.bool_]]:
    """Return the points of the sphere, float[..., 3], at places of the Hammer map, and whether there are any."""
    inside = x * x / 8.0 + y * y / 2.0 <= 1.0
    z = np.sqrt(np.maximum(1.0 - (x / 4.0) ** 2 - (y / 2.0) ** 2, 0.5))
    east = 2.0 * np.arctan2(z * x, 2.0 * (2.0 * z * z - 1.0))
    north = np.arcsin(np.clip(z * y, -1.0, 1.0))
    return np.stack([np.cos(north) * np.cos(east), np.cos(north) * np.sin(east), np.sin(north)], axis=-1), inside


def _region(holds: Callable[[Floats], Flags], columns: int) -> list[list[tuple[Floats, bool]]]:
    """Return the region of the map in which a predicate holds: polygons, each an outline and then its holes.

    Each ring is its corners on the map, float[k, 2], and whether it is a hole. `holds` takes points of the
    sphere, float[n, 3], and returns bool[n]; it is evaluated on a grid with half as many rows as columns, whose
    contours have their corners half way between two places that differ. Along these sides of the grid the border is
    found by bisection, so that outlines are no steps; parts narrower than the grid may be missed.
    """
    from shapely import make_valid, union_all
    from shapely.geometry import Polygon as Area

    turn = np.linspace(0.0, 2.0 * np.pi, 361)[:-1]
    whole = Area(np.column_stack([_WIDE * np.cos(turn), _HIGH * np.sin(turn)]))
    polygons = [make_valid(Area(outline, holes)) for outline, *holes in _contours(holds, columns)]
    area = union_all(polygons).intersection(whole).simplify(_ROUND)
    parts: list[Any] = list(getattr(area, "geoms", [area]))
    return [
        [(np.asarray(part.exterior.coords), False), *((np.asarray(hole.coords), True) for hole in part.interiors)]
        for part in parts
        if part.geom_type == "Polygon" and not part.is_empty
    ]


def _contours(holds: Callable[[Floats], Flags], columns: int) -> list[list[Floats]]:
    """Return the outline and the holes, float[k, 2], of each part of the region in which a predicate holds."""
    check_installed("contourpy", "a map of the sphere")
    from contourpy import FillType, contour_generator

    grid = np.linspace(-_WIDE, _WIDE, columns), np.linspace(-_HIGH, _HIGH, max(2, columns // 2))

    def on_map(places: Floats) -> Flags:
        points, _ = hammer_inverse(places[..., 0], places[..., 1])
        return np.asarray(holds(points.reshape(-1, 3)), dtype=bool).reshape(places.shape[:-1])

    flags = on_map(np.stack(np.meshgrid(*grid), axis=-1))
    # Between 0, inside, and 1 the level 1/2 lies half way: in steps of the grid corners have whole and half numbers.
    # Where two places on a diagonal are inside, the middle is at the level and counts as inside: narrow parts hold.
    x, y = (np.arange(len(line)) for line in grid)
    generator = contour_generator(x=x, y=y, z=(~flags).astype(float), fill_type=FillType.OuterOffset)
    parts = []
    for corners, ends in zip(*generator.filled(-1.0, 0.5), strict=True):
        one, other = np.floor(corners).astype(int), np.ceil(corners).astype(int)
        inside = flags[one[:, 1], one[:, 0]][:, None]
        first, second = (np.column_stack([grid[0][at[:, 0]], grid[1][at[:, 1]]]) for at in (one, other))
        yes, no = np.where(inside, first, second), np.where(inside, second, first)
        for _ in range(_BISECTIONS):
            middle = (yes + no) / 2.0
            there = on_map(middle)[:, None]
            yes, no = np.where(there, middle, yes), np.where(there, no, middle)
        parts.append(np.split((yes + no) / 2.0, ends[1:-1]))
    return parts


def spread(points: Floats, reach: float, gap: float, only_x: bool = False) -> Floats:
    """Return a place for the label of each point, both float[n, 2].

    Labels start at a distance `reach` from their points, away from the middle of all, and push each other away
    (only left and right with `only_x`), and off the points, until none are nearer than `gap`.
    """
    if not len(points):
        return points
    random = np.random.default_rng(7)  # parts points that coincide
    away = unit(points - points.mean(axis=0) + 1e-3 * random.normal(size=points.shape))
    places = points + max(reach, 1e-3 * gap) * away
    if only_x:
        places[:, 1] = points[:, 1]
    for _ in range(_ROUNDS):
        push = _pushes(places, places, gap)
        if only_x:
            push[:, 1] = 0.0
        else:
            push += _pushes(places, points, 0.7 * gap)
        if np.abs(push).max(initial=0.0) < 1e-4 * gap:
            break
        places = places + 0.5 * push
    return np.asarray(places)


def _pushes(places: Floats, others: Floats, gap: float) -> Floats:
    """Return the sum of the pushes on each place by others nearer than the gap."""
    apart = places[:, None] - others[None]
    distance = np.linalg.norm(apart, axis=2)
    short = np.where((distance > 0.0) & (distance < gap), gap - distance, 0.0)
    return np.asarray((apart / np.maximum(distance, 1e-12)[:, :, None] * short[:, :, None]).sum(axis=1))
