"""What holds panels at hinges: bores for screws, or tape; and the parts list.

Bores are taken from solids after the sweep: solids that do not meet do not meet with less material.
Theory: docs/theory/thick-panels.md.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from math import degrees, tan
from typing import Any

import numpy as np
import shapely

from graphs.errors import numbered
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.making.templates.pieces import Kind, Piece, TemplateLine, Text, point_of
from synth.making.thickening.plates import Plates, ThickPlates, polygons_of, ring_about
from synth.making.thickening.techniques import HingeSeat, TaperedPlates

HINGES = ("screws", "tape")
"""What joins panels: butt hinges with screws, or tape. Panels that are apart at hinges have a strip, and neither."""
BORE, SETBACK = 0.3, 0.5
"""Diameter of bores for screws and their distance from the axis, as parts of the thickness: risers have room."""

_ALIGNING = (
    "Lines of hinges have the number of their crease at a quarter; glue plies so that lines of one crease coincide."
)

Bores = Mapping[int, Sequence[tuple[int, Floats]]]
"""Joint to the panel and the centre, float[2], of each bore at it, millimetres."""


def bores_of(plates: Plates, seats: Sequence[HingeSeat], thickness: float) -> dict[int, list[tuple[int, Floats]]]:
    """Return the bores for screws beside each hinge, where plies that reach its axis have room.

    In a tapered panel they are farther from the axis by the width that is trimmed, and go through both of its sides.
    """
    reach = DOUBLE.meant * thickness
    bores: dict[int, list[tuple[int, Floats]]] = {seat.joint: [] for seat in seats}
    sections = {panel: plates.sections(panel) for panel in set(plates.panels)}
    for seat in seats:
        if seat.gap:
            continue
        for panel in seat.panels:
            if isinstance(plates, TaperedPlates):
                away = (SETBACK + tan(seat.bevel) / 2.0) * thickness
                for _, room in plates.rooms(panel):
                    bores[seat.joint] += [(panel, centre) for centre in seat.holes(room, away, BORE * thickness)]
                continue
            for low, high, outline in sections.get(panel, ()):
                if low - reach <= seat.height <= high + reach:
                    centres = seat.holes(outline, SETBACK * thickness, BORE * thickness)
                    known = [there for one, there in bores[seat.joint] if one == panel]
                    bores[seat.joint] += [
                        (panel, centre) for centre in centres
                        if all(np.abs(centre - there).max() > reach for there in known)
                    ]  # fmt: skip
    return bores


def drilled(plates: ThickPlates, seats: Sequence[HingeSeat], bores: Bores, thickness: float) -> ThickPlates:
    """Return plates with bores through the plies that reach the axis of their hinge."""
    rings: dict[int, list[tuple[float, shapely.Polygon]]] = defaultdict(list)
    for seat in seats:
        for panel, centre in bores[seat.joint]:
            rings[panel].append((seat.height, shapely.Polygon(ring_about(centre, BORE * thickness / 2.0))))
    reach = DOUBLE.meant * thickness
    plies = []
    for ply in plates.plies:
        through = [ring for height, ring in rings[ply.panel] if ply.low - reach <= height <= ply.high + reach]
        outline = shapely.difference(ply.outline, shapely.union_all(through)) if through else ply.outline
        plies.append(replace(ply, outline=outline))
    return replace(plates, plies=tuple(plies))


def bored(plates: TaperedPlates, bores: Bores, thickness: float) -> TaperedPlates:
    """Return tapered panels with bores from side to side."""
    through = [
        (number, ring_about(centre, BORE * thickness / 2.0))
        for holes in bores.values() for panel, centre in holes
        for number, room in plates.rooms(panel) if room.contains(shapely.Point(centre))
    ]  # fmt: skip
    return replace(plates, bores=tuple(through))


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
                holes = [centre for seat in own for one, centre in bores.get(seat.joint, ()) if one == panel]
                solid = isinstance(plates, ThickPlates)
                drawn = [] if solid else [ring_about(centre, BORE * thickness / 2.0) for centre in holes]
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
    elif hinges == "screws" and count:
        screw = BORE * thickness - clearance
        away = (SETBACK + tan(seat.bevel) / 2.0) * thickness
        text += f", {numbered(count, 'hole')} of {BORE * thickness:.3g} for screws of at most {screw:.3g}"
        text += f", {away:.4g} from the axis"
    else:
        text += ", tape: no room for screws" if hinges == "screws" else ", tape"
    return text + "."


def _written(length: float) -> str:
    """Return a length to a thousandth of a millimetre, without a sign for zero."""
    return f"{round(length, 3) + 0.0:.6g}"
