"""What holds panels at hinges: bores for screws through plies, pockets for inlaid living hinges, or tape.

Bores and pockets are taken from plies after the sweep: solids that do not meet do not meet with less material.
Theory: docs/theory/thick-panels.md.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from math import cos, degrees, pi, sin
from typing import Any

import numpy as np
import shapely

from graphs.errors import numbered
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.templates.pieces import Kind, Piece, TemplateLine, Text, point_of
from synth.thickening.plates import Plates, Ply, ThickPlates, polygons_of
from synth.thickening.techniques import HingeSeat

HINGES = ("screws", "living", "tape")
"""What joins panels: butt hinges with screws, flexible strips inlaid at the side of the axis, or tape."""
BORE, SETBACK = 0.3, 0.5
"""Diameter of bores for screws and their distance from the axis, as parts of the thickness: risers have room."""
POCKET = 0.1
"""Depth of a pocket for an inlaid strip, as a part of the thickness; it is a setback wide on each side."""
_SIDES = 12
"""Sides of a bore, a regular polygon about a circle of its diameter."""

_ALIGNING = (
    "Lines of hinges have the number of their crease at a quarter; glue plies so that lines of one crease coincide."
)

Bores = Mapping[int, Sequence[tuple[int, Floats]]]
"""Joint to the panel and the centre, float[2], of each bore at it, millimetres."""


def bores_of(plates: Plates, seats: Sequence[HingeSeat], thickness: float) -> dict[int, list[tuple[int, Floats]]]:
    """Return the bores for screws beside each hinge, where plies that reach its axis have room."""
    reach = DOUBLE.meant * thickness
    bores: dict[int, list[tuple[int, Floats]]] = {seat.joint: [] for seat in seats}
    sections = {panel: plates.sections(panel) for panel in set(plates.panels)}
    for seat in seats:
        if seat.gap:
            continue
        for panel in seat.panels:
            for low, high, outline in sections.get(panel, ()):
                if low - reach <= seat.height <= high + reach:
                    centres = seat.holes(outline, SETBACK * thickness, BORE * thickness)
                    known = [there for one, there in bores[seat.joint] if one == panel]
                    bores[seat.joint] += [
                        (panel, centre) for centre in centres
                        if all(np.abs(centre - there).max() > reach for there in known)
                    ]  # fmt: skip
    return bores


def bore_ring(centre: Floats, thickness: float) -> list[tuple[float, float]]:
    """Return the corners of a bore: a regular polygon round the circle of its diameter."""
    radius = BORE * thickness / 2.0 / cos(pi / _SIDES)
    turns = [2.0 * pi * (side + 0.5) / _SIDES for side in range(_SIDES)]
    return [(float(centre[0] + radius * cos(turn)), float(centre[1] + radius * sin(turn))) for turn in turns]


def drilled(plates: ThickPlates, seats: Sequence[HingeSeat], bores: Bores, thickness: float) -> ThickPlates:
    """Return plates with bores through the plies that reach the axis of their hinge."""
    rings: dict[int, list[tuple[float, shapely.Polygon]]] = defaultdict(list)
    for seat in seats:
        for panel, centre in bores[seat.joint]:
            rings[panel].append((seat.height, shapely.Polygon(bore_ring(centre, thickness))))
    reach = DOUBLE.meant * thickness
    plies = []
    for ply in plates.plies:
        through = [ring for height, ring in rings[ply.panel] if ply.low - reach <= height <= ply.high + reach]
        outline = shapely.difference(ply.outline, shapely.union_all(through)) if through else ply.outline
        plies.append(replace(ply, outline=outline))
    return replace(plates, plies=tuple(plies))


def pocketed(plates: ThickPlates, seats: Sequence[HingeSeat], thickness: float) -> ThickPlates:
    """Return plates with a pocket along each hinge at the side of its axis, into which a flexible strip is laid."""
    reach, depth = DOUBLE.meant * thickness, POCKET * thickness
    strips: dict[int, list[tuple[float, shapely.Polygon]]] = defaultdict(list)
    for seat in seats:
        for start, end in seat.lines:
            strip = shapely.LineString([start, end]).buffer(SETBACK * thickness, cap_style="flat")
            for panel in seat.panels:
                strips[panel].append((seat.height, strip))
    plies: list[Ply] = []
    for ply in plates.plies:
        sides = [
            shapely.union_all([strip for height, strip in strips[ply.panel] if abs(height - level) <= reach])
            for level in (ply.low, ply.high)
        ]
        levels = [ply.low, ply.low + depth, ply.high - depth, ply.high]
        layers = [sides[0], shapely.Polygon(), sides[1]]
        outlines = [shapely.difference(ply.outline, gone) for gone in layers]
        kept = [gone.intersects(ply.outline) and not gone.is_empty for gone in (sides[0], sides[1])]
        low, high = levels[1] if kept[0] else ply.low, levels[2] if kept[1] else ply.high
        plies += [replace(ply, low=ply.low, high=low, outline=outlines[0])] if kept[0] else []
        plies.append(replace(ply, low=low, high=high))
        plies += [replace(ply, low=high, high=ply.high, outline=outlines[2])] if kept[1] else []
    return replace(plates, plies=tuple(plies))


def parts_of(
    plates: Plates,
    seats: Sequence[HingeSeat],
    thickness: float,
    title: str,
    hinges: str,
    bores: Bores,
    clearance: float,
) -> tuple[list[Piece], tuple[str, ...]]:
    """Return pieces to cut out, one for each ply or section of a panel, and the note with the parts list.

    On each piece are the lines of the hinges over which it lies, each with the number of its crease at a quarter of
    the line, which says which end is which; plies of a panel are glued so that lines of one crease coincide.
    """
    pieces: list[Piece] = []
    steps = [f"{title}: all lengths in millimetres, heights over the plane of the sheet. {_ALIGNING}"]
    for panel in sorted(set(plates.panels)):
        own = [seat for seat in seats if panel in seat.panels]
        names = []
        for low, high, outline in plates.sections(panel):
            level = f"{_written(low)} to {_written(high)}" if high > low else f"at {_written(low)}"
            names.append(level)
            for polygon in polygons_of(outline):
                drawn = [] if isinstance(plates, ThickPlates) else [
                    bore_ring(centre, thickness) for seat in own for one, centre in bores.get(seat.joint, ())
                    if one == panel
                ]  # fmt: skip
                pieces.append(_piece(polygon, f"{panel}: {level}", own, thickness, drawn))
        work = "one board"
        if len(names) > 1:
            solid = isinstance(plates, ThickPlates)
            work = f"glue {len(names)} plies on each other" if solid else "one board, sides sawn between outlines"
        steps.append(f"Panel {panel}: {work}, {'; '.join(names)}.")
    return pieces, (*steps, *(_of_crease(seat, thickness, hinges, bores, clearance) for seat in seats))


def _piece(
    polygon: Any, name: str, own: Sequence[HingeSeat], thickness: float, rings: Sequence[Sequence[tuple[float, float]]]
) -> Piece:
    """Return a piece with its outline, the nearest hinge lines and their numbers, and its name."""
    strokes = [TemplateLine("CUT", *ends) for ring in (polygon.exterior, *polygon.interiors)
               for ends in pairwise(ring.coords)]  # fmt: skip
    strokes += [TemplateLine("CUT", *ends) for ring in rings for ends in pairwise([*ring, ring[0]])]
    far = {
        (seat.joint, place): shapely.LineString(line).distance(polygon)
        for seat in own for place, line in enumerate(seat.lines)
    }  # fmt: skip
    within = max(thickness / 2.0, min(far.values(), default=0.0) + DOUBLE.meant * thickness)
    middle, size = polygon.representative_point(), min(3.0, 0.5 * thickness)
    texts = [Text((middle.x, middle.y), name, size=size)]
    for seat in own:
        kind: Kind = "VALLEY" if seat.valley else "MOUNTAIN"
        for place, (start, end) in enumerate(seat.lines):
            if far[seat.joint, place] <= within:
                strokes.append(TemplateLine(kind, point_of(start), point_of(end)))
                number = str(seat.joint) if len(seat.lines) == 1 else f"{seat.joint}.{place + 1}"
                texts.append(Text(point_of(start + 0.25 * (end - start)), number, size=size))
    return Piece(tuple(strokes), tuple(texts), polygon)


def _of_crease(seat: HingeSeat, thickness: float, hinges: str, bores: Bores, clearance: float) -> str:
    """Return the line of the parts list on a hinge."""
    folded, count = "valley" if seat.valley else "mountain", len(bores.get(seat.joint, ()))
    text = f"Crease {seat.joint}, {folded}, panels {seat.panels[0]} and {seat.panels[1]}: "
    text += f"axis at {_written(seat.height)}, {seat.length:.4g} long"
    if seat.bevel:
        text += f", sides bevelled by {degrees(seat.bevel):.4g} degrees from upright"
    if seat.gap:
        text += f", a strip over a gap of {seat.gap:.4g}"
    elif hinges == "living":
        text += f", a strip {2.0 * SETBACK * thickness:.4g} wide and {POCKET * thickness:.4g} thick laid in"
    elif hinges == "screws" and count:
        screw = BORE * thickness - clearance
        text += f", {numbered(count, 'hole')} of {BORE * thickness:.3g} for screws of at most {screw:.3g}"
        text += f", {SETBACK * thickness:.4g} from the axis"
    else:
        text += ", tape" if hinges == "tape" else ", tape: no room for screws"
    return text + "."


def _written(length: float) -> str:
    """Return a length to a thousandth of a millimetre, without a sign for zero."""
    return f"{round(length, 3) + 0.0:.6g}"
