"""Maps of the sphere: which fixed axes keep orientations in order (Tipparthi and Larochelle 2011, Fig. 6)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

import numpy as np

from graphs.arrays import Floats
from graphs.errors import numbered
from graphs.geometry import signed_area
from synth.drawing.hammer import hammer, region
from synth.drawing.labels import spread
from synth.drawing.scene.frame import COLUMN, Frame, framed, page_of
from synth.drawing.scene.palette import FINE, NORMAL, SMALL
from synth.drawing.scene.shapes import Disc, Label, Layer, Line, Polygon, Scene, Shape
from synth.guidance.dyads import AxisCurve, Dyad
from synth.guidance.order import order_verdicts, pair_name
from synth.guidance.orientations import Orientations

__all__ = ["CCW", "CW", "NEITHER", "draw_map"]

CCW, CW, NEITHER = "class0", "class1", "body"
_DASHES = {CCW: (), CW: (2.0, 1.5)}
_MOST_LABELLED = 7
"""Orientations of which the relative axes are shown."""
_OVER = 0.3
"""How far points of a curve that follow each other are at most, where it does not go over the edge of the map."""
_REACH = 0.13


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
        Columns of the grid on which verdicts are asked for; borders between are found more finely.

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
    numbers = [
        (end, str(k), "mountain") for k, dyad in enumerate(dyads, start=1) for end in (dyad.fixed, -dyad.fixed)
    ]
    layers = [
        Layer("regions", tuple(_regions(orientations, frame, width))),
        Layer("lines", (*_graticule(frame), *_curves(frame, curves))),
        Layer("axes", tuple(_marks(frame, lines, numbers))),
        Layer("legend", tuple(_legend(frame))),
    ]
    said = f"order of {numbered(len(orientations), 'orientation')} by fixed axis; all of the sphere, z on top"
    if axes:
        said += "; dots: relative axes, both ends"
    page = Frame(1, 0, 0, 0, 0, frame.width, frame.height + 2 * SMALL)
    return page_of(page, layers, [said + ("; stars: fixed axes of dyads" if numbers else "")])


def _regions(orientations: Orientations, frame: Frame, width: int) -> list[Shape]:
    """Return the map and the regions on it, larger ones first, so that what lies in a hole lies on it."""
    turn = np.linspace(0.0, 2.0 * np.pi, 181)
    rim = np.column_stack([2 * np.sqrt(2.0) * np.cos(turn), np.sqrt(2.0) * np.sin(turn)])
    found: list[tuple[float, bool, Polygon]] = []
    for verdict, colour in ((1, CCW), (-1, CW)):
        for rings in region(lambda points, of=verdict: order_verdicts(orientations, points) == of, width):  # type: ignore[misc]
            for ring, hole in rings:
                shape = Polygon(frame.row(ring[:-1].tolist()), NEITHER if hole else colour, None)
                found.append((abs(float(signed_area(ring))), not hole, shape))
    found.sort(key=lambda item: (-item[0], item[1]))
    whole = Polygon(frame.row(rim[:-1].tolist()), NEITHER, None)
    outlines = [
        Line([*shape.points, shape.points[0]], "ink", FINE / 2, _DASHES[shape.fill])
        for _, _, shape in found
        if shape.fill in _DASHES
    ]
    return [whole, *(shape for _, _, shape in found), *outlines]


def _graticule(frame: Frame) -> list[Shape]:
    """Return circles of 30 degrees, and the edge of the map."""
    turn = np.linspace(-np.pi + 1e-9, np.pi - 1e-9, 181)
    half = np.linspace(-np.pi / 2, np.pi / 2, 91)
    shapes: list[Shape] = []
    for north in np.radians(np.arange(-60, 61, 30)):
        ring = np.stack(
            [np.cos(north) * np.cos(turn), np.cos(north) * np.sin(turn), np.full(181, np.sin(north))], 1
        )
        shapes.append(_line(frame, ring, "paper", FINE))
    for degrees in range(-180, 181, 30):
        east = np.radians(np.clip(degrees, -180 + 1e-6, 180 - 1e-6))
        ring = np.stack([np.cos(half) * np.cos(east), np.cos(half) * np.sin(east), np.sin(half)], 1)
        edge = abs(degrees) == 180
        shapes.append(_line(frame, ring, "ink" if edge else "paper", NORMAL if edge else FINE))
    return shapes


def _line(frame: Frame, points: Floats, colour: str, width: float) -> Line:
    return Line(frame.row(np.column_stack(hammer(points)).tolist()), colour, width)


def _curves(frame: Frame, curves: Iterable[AxisCurve]) -> list[Shape]:
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


def _marks(
    frame: Frame, lines: Sequence[tuple[Floats, str, str]], numbers: Sequence[tuple[Floats, str, str]]
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


def _legend(frame: Frame) -> list[Shape]:
    told = (
        ("in order, crank counter-clockwise", CCW),
        ("in order, crank clockwise (dashed rim)", CW),
        ("order defect", NEITHER),
    )
    shapes: list[Shape] = []
    for (text, colour), x in zip(told, (14.0, 136.0, 276.0), strict=True):
        y = frame.height + SMALL / 2
        box = [(x, y - 2.6), (x + 9, y - 2.6), (x + 9, y + 2.6), (x, y + 2.6)]
        shapes.append(Polygon(box, colour, "grey", FINE))
        shapes.append(Label((x + 12, y), text, 0.9 * SMALL, anchor="start", halo=False))
    return shapes
