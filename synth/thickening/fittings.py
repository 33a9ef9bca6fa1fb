"""What holds panels at hinges: bores for screws, knuckles on pins, pockets for inlaid living hinges, or tape.

Bores and pockets are taken from solids after the sweep: solids that do not meet do not meet with less material.
Knuckles add material, so the motion is swept again with them.
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
from graphs.geometry import unit
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.templates.pieces import Kind, Piece, TemplateLine, Text, point_of
from synth.thickening.plates import Knuckle, Plates, Ply, ThickPlates, grid_of, polygons_of, ring_about
from synth.thickening.techniques import HingeSeat, TaperedPlates

HINGES = ("screws", "pins", "living", "tape")
"""What joins panels: butt hinges with screws, knuckles on a pin, flexible strips inlaid at the axis, or tape."""
BARREL = 0.6
"""Diameter of knuckles as a part of the thickness; their bores are as wide as those for screws."""
BORE, SETBACK = 0.3, 0.5
"""Diameter of bores for screws and their distance from the axis, as parts of the thickness: risers have room."""
POCKET = 0.1
"""Depth of a pocket for an inlaid strip, as a part of the thickness; it is a setback wide on each side."""

_BORNE = (0.25, 0.75)
"""A panel bears a part of an axis if it has material beside it between these parts of its length."""

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


def knuckled(plates: ThickPlates, seats: Sequence[HingeSeat], thickness: float, clearance: float) -> ThickPlates:
    """Return plates whose panels bear each hinge in turns, as knuckles on a pin, where there is room.

    A part of the axis that both panels reach has three, the outer ones of the first panel; one that a single panel
    reaches has one. Its own panel ends at its block, the other one outside the circle that the barrel needs.
    """
    knuckles: list[Knuckle] = []
    taken: dict[int, list[tuple[float, float, Any]]] = defaultdict(list)
    for seat in seats:
        for start, end in seat.lines:
            for knuckle, parted in _knuckles_of(plates, seat, (start, end), thickness, clearance):
                knuckles.append(knuckle)
                for panel, around in parted.items():
                    taken[panel].append((seat.height - around[0], seat.height + around[0], around[1]))
    reach = DOUBLE.meant * thickness
    plies = []
    for ply in plates.plies:
        gone = [part for low, high, part in taken[ply.panel] if low < ply.high - reach and high > ply.low + reach]
        grid = grid_of(ply.outline)
        rest = shapely.difference(ply.outline, shapely.union_all(gone), grid_size=grid) if gone else ply.outline
        plies.append(replace(ply, outline=rest))
    return replace(plates, plies=tuple(plies), knuckles=tuple(knuckles))


def _knuckles_of(
    plates: ThickPlates, seat: HingeSeat, line: tuple[Floats, Floats], thickness: float, clearance: float
) -> list[tuple[Knuckle, dict[int, tuple[float, Any]]]]:
    """Return the knuckles on a part of an axis, with what each takes from both panels: height and outline."""
    radius, gap, reach = BARREL * thickness / 2.0, 1.5 * clearance, DOUBLE.meant * thickness
    start, along = line[0], unit(line[1] - line[0])
    length = float(np.linalg.norm(line[1] - line[0]))
    normal = np.array([-along[1], along[0]])
    bearing = {}
    for panel in seat.panels:
        own = [ply for ply in plates.plies if ply.panel == panel]
        plies = [ply for ply in own if ply.low - reach <= seat.height <= ply.high + reach]
        for side in (1.0, -1.0):
            beside = [start + part * length * along + side * radius * normal for part in _BORNE]
            at = [ply for ply in plies if ply.outline.covers(shapely.LineString(beside))]
            if at:
                bearing[panel] = (side, min(ply.low for ply in at), max(ply.high for ply in at))
    count = 2 * len(bearing) - 1
    # Knuckles of creases that meet at a vertex keep off each other there.
    corner = max(0.1 * length, thickness)
    ends = [
        corner if count == 3 or place is last else gap / 2.0
        for place, last in zip(line, (seat.lines[0][0], seat.lines[-1][1]), strict=True)
    ]
    each = (length - sum(ends)) / max(count, 1)
    if not bearing or each < 2.0 * radius + gap:
        return []
    knuckles = []
    for number in range(count):
        panel = list(bearing)[number % 2]
        side, low, high = bearing[panel]
        first, last = ends[0] + number * each + gap / 2.0, ends[0] + (number + 1) * each - gap / 2.0
        inward = side * normal
        # To the right of the inward direction as seen from above, the axis goes along or against the line.
        ahead = float(inward[1] * along[0] - inward[0] * along[1]) > 0.0
        foot = start + (first if ahead else last) * along
        knuckle = Knuckle(
            seat.joint, panel, np.array([*foot, seat.height]), np.array([*inward, 0.0]), last - first, radius,
            BORE * thickness / 2.0, low - seat.height, high - seat.height,
        )  # fmt: skip
        other = next(one for one in seat.panels if one != panel)
        base, top = start + first * along, start + last * along
        block = _strip(base, top, radius * inward)
        clear = _strip(base - gap * along, top + gap * along, -(radius + gap) * inward)
        knuckles.append((knuckle, {panel: (radius, block), other: (radius + gap, clear)}))
    return knuckles


def _strip(start: Floats, end: Floats, width: Floats) -> Any:
    """Return a rectangle beside a segment, and half as much on the other side, so that no sliver is left there."""
    return shapely.Polygon([start - 0.5 * width, end - 0.5 * width, end + width, start + width])


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
    return pieces, (*steps, *(_of_crease(seat, thickness, hinges, bores, clearance, plates) for seat in seats))


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


def _of_crease(seat: HingeSeat, thickness: float, hinges: str, bores: Bores, clearance: float, plates: Plates) -> str:
    """Return the line of the parts list on a hinge."""
    knuckles = [one for one in plates.knuckles if one.joint == seat.joint] if isinstance(plates, ThickPlates) else []
    folded, count = "valley" if seat.valley else "mountain", len(bores.get(seat.joint, ()))
    text = f"Crease {seat.joint}, {folded}, panels {seat.panels[0]} and {seat.panels[1]}: "
    text += f"axis at {_written(seat.height)}, {seat.length:.4g} long"
    if seat.bevel:
        text += f", sides bevelled by {degrees(seat.bevel):.4g} degrees from upright"
    if seat.gap:
        text += f", a strip over a gap of {seat.gap:.4g}"
    elif hinges == "living" and isinstance(plates, ThickPlates):
        text += f", a strip {2.0 * SETBACK * thickness:.4g} wide and {POCKET * thickness:.4g} thick laid in"
    elif knuckles:
        pin = BORE * thickness - clearance
        lengths = ", ".join(f"panel {one.panel} {one.length:.4g}" for one in knuckles)
        text += f", a pin of at most {pin:.3g} through knuckles of {BARREL * thickness:.3g}: {lengths} long"
    elif hinges == "screws" and count:
        screw = BORE * thickness - clearance
        away = (SETBACK + tan(seat.bevel) / 2.0) * thickness
        text += f", {numbered(count, 'hole')} of {BORE * thickness:.3g} for screws of at most {screw:.3g}"
        text += f", {away:.4g} from the axis"
    else:
        text += f", tape: no room for {hinges}" if hinges in ("screws", "pins") else ", tape"
    return text + "."


def _written(length: float) -> str:
    """Return a length to a thousandth of a millimetre, without a sign for zero."""
    return f"{round(length, 3) + 0.0:.6g}"
